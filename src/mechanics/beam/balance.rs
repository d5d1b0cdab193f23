//! The balance of an element at an instant: what its surroundings supply at its ends, and what acts between them
//! (MECHANICS 3.12). Forces and moments at its sections follow from it without any constitutive law.

use crate::math::Vec3;
use crate::math::quadrature::{FIVE_POINTS, shares_of_five};
use crate::mechanics::input::excitation::Wrench;

/// Number of the stations at which inertia and weight are taken: the five Gauss points.
pub const STATIONS: usize = FIVE_POINTS.len();

/// How beams move at an instant, and what acts on their mass.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a> {
    /// Whether anything moves: not in an equilibrium, whatever drives do.
    pub moves: bool,
    /// Velocities of all coordinates, 1/s each.
    pub velocity: &'a [f64],
    /// Their derivatives by time, 1/s² each.
    pub acceleration: &'a [f64],
    /// Rates of the strains of all elements, for material damping; none: they follow from the velocities.
    pub strain_rates: Option<&'a [f64]>,
    /// Gravity, m/s².
    pub gravity: Vec3,
    /// Damping in proportion to mass, 1/s.
    pub mass_damping: f64,
}

/// Force and moment at a point, in global axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Acting {
    /// Point of application, m.
    pub position: Vec3,
    /// Force, N.
    pub force: Vec3,
    /// Moment, N m.
    pub moment: Vec3,
}

impl Acting {
    /// Adds `share` of it, taken about `about`, to `sum`.
    pub fn add_about(&self, about: &Vec3, share: f64, sum: &mut Wrench) {
        sum.force += self.force * share;
        sum.moment += ((self.position - about).cross(&self.force) + self.moment) * share;
    }
}

/// The balance of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Balance {
    /// Forces that its surroundings supply at both ends.
    pub ends: [Acting; 2],
    /// Weight and inertia of what each of the five Gauss points stands for.
    pub stations: [Acting; STATIONS],
}

impl Balance {
    /// The sum of the first end, inertia and weight up to `xi`, about the point `about`.
    pub fn up_to(&self, xi: f64, about: &Vec3) -> Wrench {
        let mut sum = Wrench::default();
        self.ends[0].add_about(about, 1.0, &mut sum);
        for (station, share) in self.stations.iter().zip(shares_of_five(xi)) {
            station.add_about(about, share, &mut sum);
        }
        sum
    }
}
