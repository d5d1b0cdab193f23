//! The balance of an element at an instant (MECHANICS 3.12): the moment at a node is that of the forces on its vectors
//! in a rigid turn.

use super::coordinates::{ELEMENT, NODE, R, X, Y, Z};
use super::damping;
use super::element::Element;
use crate::math::quadrature::{FIVE_POINTS, FIVE_WEIGHTS};
use crate::math::vectors::{add_vec3, vec3};
use crate::math::{Vec3, hermite};
use crate::mechanics::beam::ancf24::coordinates::{AXIS_PLACES, Y_PLACES, Z_PLACES};
use crate::mechanics::beam::balance::{Acting, Balance, Instant};
use crate::mechanics::beam::configuration::BeamConfiguration;

impl Element {
    /// The balance at `instant`; `inside` is the generalized force of what acts between its nodes.
    pub(super) fn balance_with(&self, c: &BeamConfiguration, instant: &Instant, inside: &[f64]) -> Balance {
        let Instant { velocity, acceleration, gravity, mass_damping, .. } = *instant;
        let [q, velocity, acceleration] = [c.q, velocity, acceleration].map(|all| self.own(all));
        let mut supplied: [f64; ELEMENT] = std::array::from_fn(|index| -inside[index]);
        self.add_gradient(q, None, &mut supplied);
        let rates: [f64; ELEMENT] = std::array::from_fn(|index| acceleration[index] + mass_damping * velocity[index]);
        self.mass.add_times(&rates, &mut supplied);
        if self.properties.damping != 0.0 {
            damping::add_force(self, q, velocity, &mut supplied);
        }
        for (start, weight) in AXIS_PLACES.into_iter().zip(self.weight(&gravity)) {
            add_vec3(&mut supplied, start, &-weight);
        }
        let end = |node: usize| {
            let start = node * NODE;
            let turned = |part: usize| vec3(q, start + part).cross(&vec3(&supplied, start + part));
            Acting {
                position: vec3(q, start + R),
                force: vec3(&supplied, start + R),
                moment: turned(X) + turned(Y) + turned(Z),
            }
        };
        let mut points = FIVE_POINTS.into_iter().zip(FIVE_WEIGHTS);
        let stations = std::array::from_fn(|_| {
            let (xi, weight) = points.next().expect("there are five stations");
            self.station(xi, weight * self.length, [q, &rates], &gravity)
        });
        Balance { ends: [end(0), end(1)], stations }
    }

    /// Weight and inertia of the length `share`, m, at `xi`.
    fn station(&self, xi: f64, share: f64, [q, rates]: [&[f64]; 2], gravity: &Vec3) -> Acting {
        let shape = hermite::shape(xi, self.length);
        let axis = |own: &[f64]| -> Vec3 {
            AXIS_PLACES.into_iter().zip(shape).map(|(start, weight)| vec3(own, start) * weight).sum()
        };
        let director =
            |[first, second]: [usize; 2], own: &[f64]| vec3(own, first) * (1.0 - xi) + vec3(own, second) * xi;
        let turned = |ends: [usize; 2], inertia: f64| director(ends, q).cross(&director(ends, rates)) * inertia;
        let [about_y, about_z] = self.properties.section_inertia;
        Acting {
            position: axis(q),
            force: (gravity - axis(rates)) * (self.properties.line_density * share),
            moment: (turned(Y_PLACES, about_y) + turned(Z_PLACES, about_z)) * -share,
        }
    }
}
