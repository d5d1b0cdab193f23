//! Reads the quantities of outputs off a moment of a run.

use crate::math::Vec3;
use crate::mechanics::beam::resultants::Fiber;
use crate::mechanics::force::spring::Spring;
use crate::mechanics::marker::configuration::{Configuration, Passage};
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::energy::Part;
use crate::model::file::quantity::Quantity;
use crate::solve::step::response::Response;

/// A state with all that results are read from.
#[derive(Clone, Copy, Debug)]
pub struct Moment<'a> {
    /// The system.
    pub system: &'a System,
    /// Its state.
    pub state: &'a State,
    /// Accelerations and multipliers at the time of the state; needed where `Table::needs_response`.
    pub response: &'a Response,
    /// The fibers of all sensors that bear most in a state nearby: their stresses are told, which have no kinks. Empty: the largest ones are.
    pub fibers: &'a [Fiber],
}

/// Appends a quantity of a point.
pub(super) fn push_point(values: &mut Vec<f64>, moment: &Moment, c: &Configuration, number: usize, quantity: Quantity) {
    let Moment { system, state, response, fibers } = *moment;
    let sensor = &system.sensors[number];
    let rotation = &state.rotations[number];
    let mut push = |v: Vec3| values.extend(v.iter());
    match quantity {
        Quantity::Position => match sensor.observer {
            Some(_) => push(sensor.seen_position(c)),
            None => push(system.global(sensor.seen_position(c))),
        },
        Quantity::Displacement => push(sensor.seen_displacement(c)),
        Quantity::Velocity => push(sensor.seen_motion(c, &state.velocity).0),
        Quantity::Acceleration => push(sensor.seen_acceleration(c, &state.velocity, &response.acceleration)),
        Quantity::Rotation => push(*rotation),
        Quantity::Quaternion => values.extend(sensor.quaternion(rotation)),
        Quantity::AngularVelocity => push(sensor.seen_motion(c, &state.velocity).1),
        Quantity::Twist => values.push(sensor.twist(system, c)),
        Quantity::AxialStrain => values.push(sensor.strains(c).axial),
        Quantity::Curvature => values.extend(sensor.strains(c).curvature),
        Quantity::Torsion => values.push(sensor.strains(c).torsion),
        Quantity::SectionForce => values.push(sensor.section_forces(c).axial),
        Quantity::SectionMoment => values.extend(sensor.section_forces(c).moment),
        Quantity::Stress => {
            let stress = match fibers.get(number) {
                Some(fiber) => sensor.stress_of(fiber, system, c),
                None => sensor.stress(system, c),
            };
            values.push(stress.expect("the file is refused: a general section has no stress"));
        }
        Quantity::ReactionForce
        | Quantity::ReactionMoment
        | Quantity::AppliedForce
        | Quantity::AppliedMoment
        | Quantity::Angle
        | Quantity::Distance
        | Quantity::AngleRate
        | Quantity::DistanceRate
        | Quantity::AngleAcceleration
        | Quantity::DistanceAcceleration
        | Quantity::Effort
        | Quantity::Power
        | Quantity::Force
        | Quantity::Energy
        | Quantity::KineticEnergy
        | Quantity::ElasticEnergy
        | Quantity::GravityEnergy => unreachable!("the file is refused: these belong to whole parts"),
    }
}

/// A quantity of a drive or an actuator with the effort `effort` on a coordinate.
pub(super) fn of_effort(
    effort: impl Fn() -> f64,
    coordinate: usize,
    quantity: Quantity,
    moment: &Moment,
    c: &Configuration,
) -> f64 {
    match quantity {
        Quantity::Effort => effort(),
        Quantity::Power => effort() * moment.system.relative_coordinates[coordinate].rate(c, &moment.state.velocity),
        _ => coordinate_of(coordinate, quantity, moment, c),
    }
}

/// A quantity of a spring, friction or a stop.
pub(super) fn of_spring(spring: &Spring, quantity: Quantity, moment: &Moment, c: &Configuration) -> f64 {
    let Moment { system, state, .. } = moment;
    let coordinate = &system.relative_coordinates[spring.coordinate];
    match quantity {
        Quantity::Effort => 0.0 - spring.tension(coordinate, c, &Passage::of(state)), // 0 where it is 0, not -0
        Quantity::Force => spring.tension(coordinate, c, &Passage::of(state)),
        Quantity::Energy => spring.energy(coordinate, c),
        Quantity::Power => spring.dissipation(coordinate, c, &state.velocity),
        _ => coordinate_of(spring.coordinate, quantity, moment, c),
    }
}

/// An energy of a beam or a body, J.
pub(super) fn of_part(part: Part, quantity: Quantity, moment: &Moment, c: &Configuration) -> f64 {
    let Moment { system, state, .. } = moment;
    match quantity {
        Quantity::KineticEnergy => system.kinetic_energy_of(part, c, &state.velocity),
        Quantity::GravityEnergy => system.gravity_energy_of(part, c),
        _ => system.elastic_energy_of(part, c),
    }
}

/// A free coordinate of a joint, rad or m, its rate, rad/s or m/s, or its second derivative, rad/s² or m/s².
pub(super) fn coordinate_of(coordinate: usize, quantity: Quantity, moment: &Moment, c: &Configuration) -> f64 {
    let Moment { system, state, response, .. } = moment;
    let own = &system.relative_coordinates[coordinate];
    if quantity.is_acceleration() {
        own.acceleration(c, &state.velocity, &response.acceleration)
    } else if quantity.is_rate() {
        own.rate(c, &state.velocity)
    } else {
        state.relative_values[coordinate]
    }
}

/// Appends the force or the moment of a joint or a frame.
pub(super) fn push_wrench(values: &mut Vec<f64>, (force, moment): (Vec3, Vec3), quantity: Quantity) {
    let wanted = match quantity {
        Quantity::ReactionForce => force,
        Quantity::ReactionMoment => moment,
        Quantity::AppliedForce => Vec3::zeros() - force, // 0 where it is 0, not -0
        _ => Vec3::zeros() - moment,
    };
    values.extend(wanted.iter());
}
