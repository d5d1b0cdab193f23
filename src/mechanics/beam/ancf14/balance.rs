//! The balance of an element at an instant (MECHANICS 3.12).

use super::coordinates::{ElementVector, NODE, P, R, THETA, interpolate};
use super::element::Element;
use super::frame::NodeFrame;
use super::payout::Extent;
use crate::math::quadrature::FIVE_POINTS;
use crate::math::vectors::{add_vec3, vec3};
use crate::math::{Vec3, hermite};
use crate::mechanics::beam::balance::{Acting, Balance, Instant};
use crate::mechanics::beam::configuration::BeamConfiguration;

/// Material that passes through the mesh of an element (MECHANICS 3.11).
#[derive(Clone, Copy, Debug)]
pub(super) struct Passing {
    /// Free length.
    pub extent: Extent,
    /// Distance of the start of the element from the end that is not at the winch, m as drawn.
    pub distance: f64,
}

impl Element {
    /// The balance at `instant` with what acts besides strains, inertia and weight, as a force of the element: viscous
    /// stress, minus loads between its nodes, inertia of what passes through its mesh, which is `passing`.
    pub(super) fn balance_of(
        &self,
        c: &BeamConfiguration,
        instant: &Instant,
        acting: ElementVector,
        passing: Option<&Passing>,
    ) -> Balance {
        let Instant { velocity, acceleration, gravity, mass_damping, .. } = *instant;
        let [velocity, acceleration] = [velocity, acceleration].map(|all| self.own(all));
        let extent = passing.map_or(1.0, |passing| passing.extent.ratio);
        let inertia = self.inertia.mass.times(acceleration) * extent;
        let momentum = self.inertia.mass.times(velocity) * extent;
        let mut supplied = self.evaluation(c).gradient() + inertia + momentum * mass_damping;
        supplied += acting - self.weight(&gravity) * extent;
        let frames = self.frames(c);
        if let Some(rotary) = &self.inertia.rotary {
            let own = supplied.as_mut_slice();
            rotary.add_times(frames, 1.0, acceleration, own);
            rotary.add_times(frames, mass_damping, velocity, own);
            rotary.add_gradient(frames, -1.0, velocity, own);
            supplied += rotary.rate_times(frames, velocity);
        }
        for (frame, start) in frames.into_iter().zip([0, NODE]) {
            let (spin, rate) = (momentum[start + THETA], inertia[start + THETA]);
            let force = frame.gyroscopic_force(&vec3(velocity, start + P), spin) - frame.chart_force(rate);
            add_vec3(supplied.as_mut_slice(), start + P, &force);
        }
        let end = |node: usize| {
            let (start, frame) = (node * NODE, frames[node]);
            let (by_slope, by_angle) = (vec3(supplied.as_slice(), start + P), supplied[start + THETA]);
            Acting {
                position: vec3(self.own(c.q), start + R),
                force: vec3(supplied.as_slice(), start + R),
                moment: frame.moment_of(&by_slope, by_angle),
            }
        };
        let stations = self.stations(c, instant, passing);
        Balance { ends: [end(0), end(1)], stations }
    }

    /// Weight and inertia of what each of the five Gauss points stands for: what the mass matrix and the weights sum
    /// up.
    fn stations(&self, c: &BeamConfiguration, instant: &Instant, passing: Option<&Passing>) -> [Acting; 5] {
        let Instant { velocity, acceleration, gravity, mass_damping, .. } = *instant;
        let [q, velocity, acceleration] = [c.q, velocity, acceleration].map(|all| self.own(all));
        let extent = passing.map_or(1.0, |passing| passing.extent.ratio);
        let frames = self.frames(c);
        let tangents = frames.map(|frame| frame.t);
        let tangent_rates = [0, 1].map(|node| frames[node].t_p() * vec3(velocity, node * NODE + P));
        let spin_rates = [velocity, acceleration].map(|own| [own[THETA], own[NODE + THETA]]);
        let station = |(xi, [mass, spin]): (f64, [f64; 2])| {
            let shape = hermite::shape(xi, self.length);
            let [position, speed, mut rate] = [q, velocity, acceleration].map(|own| interpolate(&shape, own));
            if let Some(passing) = passing {
                rate += self.passing_acceleration(passing, xi, q, velocity);
            }
            let along = |[first, second]: [f64; 2]| (1.0 - xi) * first + xi * second;
            let between = |[first, second]: [Vec3; 2]| first * (1.0 - xi) + second * xi;
            let [angle_rate, angle_acceleration] = spin_rates.map(along);
            let turning = between(tangents) * (angle_acceleration + mass_damping * angle_rate)
                + between(tangent_rates) * angle_rate;
            Acting {
                position,
                force: (gravity - rate - speed * mass_damping) * (mass * extent),
                moment: turning * (-spin * extent),
            }
        };
        let mut points = FIVE_POINTS.into_iter().zip(self.inertia.stations);
        let mut stations = std::array::from_fn(|_| station(points.next().expect("there are five stations")));
        self.add_rotary_moments(frames, [q, velocity, acceleration], mass_damping, &mut stations);
        stations
    }

    /// Adds the moments of the rotary inertia about y and z, minus the rates of the angular momenta
    /// `ρI r' × ṙ' + Σ_n φ_n ρΔI (d_n·ṙ') r' × d_n` (MECHANICS 3.3b).
    fn add_rotary_moments(
        &self,
        frames: [&NodeFrame; 2],
        [q, velocity, acceleration]: [&[f64]; 3],
        mass_damping: f64,
        stations: &mut [Acting; 5],
    ) {
        let axes = self.inertia.rotary.as_ref().map(|rotary| rotary.axes(frames, velocity));
        for ((station, xi), [all, following]) in stations.iter_mut().zip(FIVE_POINTS).zip(self.inertia.turning) {
            if all == 0.0 && following == 0.0 {
                continue;
            }
            let by_x = hermite::shape_x(xi, self.length);
            let [slope, rate, second] = [q, velocity, acceleration].map(|own| interpolate(&by_x, own));
            let second = second + rate * mass_damping;
            station.moment -= slope.cross(&second) * all;
            for ([d, d_rate], share) in axes.into_iter().flatten().zip([1.0 - xi, xi]) {
                let (along, along_rate) = (d.dot(&rate), d_rate.dot(&rate) + d.dot(&second));
                let turned = slope.cross(&d) * along_rate + (rate.cross(&d) + slope.cross(&d_rate)) * along;
                station.moment -= turned * (following * share);
            }
        }
    }

    /// Acceleration of the material at `xi` beyond that of the mesh, m/s².
    fn passing_acceleration(&self, passing: &Passing, xi: f64, q: &[f64], velocity: &[f64]) -> Vec3 {
        let (by_x, by_xx) = (hermite::shape_x(xi, self.length), hermite::shape_xx(xi, self.length));
        let distance = passing.distance - xi * self.length;
        let Extent { rate, acceleration, .. } = passing.extent;
        let speed = rate * distance;
        interpolate(&by_x, velocity) * (2.0 * speed)
            + interpolate(&by_x, q) * ((acceleration - 2.0 * rate * rate) * distance)
            + interpolate(&by_xx, q) * (speed * speed)
    }
}

impl NodeFrame {
    /// Force on the slope of a node whose sections have the spin momentum `spin`, kg m²/s, in the rate `slope_rate` of
    /// the slope (MECHANICS 7.2), N m.
    fn gyroscopic_force(&self, slope_rate: &Vec3, spin: f64) -> Vec3 {
        slope_rate.cross(&self.t) * (spin / (self.stretch * self.stretch))
    }

    /// Force on the slope, in charts that are not centered, of a spin momentum that changes at `rate`, N m.
    fn chart_force(&self, rate: f64) -> Vec3 {
        self.k * (rate / self.stretch)
    }
}
