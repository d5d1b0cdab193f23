//! Reads the quantities of outputs off a moment of a run.

use super::measure::Measure;
use crate::math::Vec3;
use crate::math::elementary::{acos, atan2};
use crate::mechanics::force::spring::Spring;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::output::joint_loads::JointLoads;
use crate::mechanics::output::section_loads::SectionLoads;
use crate::mechanics::output::section_stress::WorstFiber;
use crate::mechanics::state::State;
use crate::mechanics::state::energy_account::EnergyAccount;
use crate::mechanics::system::System;
use crate::mechanics::system::energy::Part;
use crate::model::file::quantity::Quantity;
use crate::model::text::names::Kind;
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
    /// The fibers of all sensors that bear most in a state nearby: their stresses are told, which have no kinks. Empty:
    /// the largest ones are.
    pub fibers: &'a [WorstFiber],
}

/// Appends a quantity of a point.
pub(super) fn push_point(
    values: &mut Vec<f64>,
    moment: &Moment,
    loads: &JointLoads,
    number: usize,
    quantity: Quantity,
) {
    let c = loads.c;
    let Moment { system, state, response, .. } = *moment;
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
        Quantity::Tilt => values.push(sensor.tilt(rotation)),
        Quantity::Twist => values.push(sensor.twist(system, c)),
        Quantity::Declination => values.push(acos(sensor.marker.pose(c).axis(0).z.clamp(-1.0, 1.0))),
        Quantity::Azimuth => {
            let tangent = sensor.marker.pose(c).axis(0);
            values.push(atan2(tangent.y, tangent.x));
        }
        Quantity::Submergence
        | Quantity::Clearance
        | Quantity::FluidVelocity
        | Quantity::Drag
        | Quantity::Elevation => {
            push_of_water(values, moment, c, number, quantity);
        }
        Quantity::ContactPressure => {
            let point = sensor.in_element().expect("the file is refused: only points of beams touch surfaces");
            values.push(system.contact_pressure(point, c, loads.passage));
        }
        Quantity::SectionForce
        | Quantity::SectionMoment
        | Quantity::EffectiveTension
        | Quantity::WallTension
        | Quantity::Stress
        | Quantity::AxialStrain
        | Quantity::Curvature
        | Quantity::Torsion => push_section(values, moment, loads, number, quantity),
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
        | Quantity::NormalForce
        | Quantity::FrictionForce
        | Quantity::Penetration
        | Quantity::ContactLength
        | Quantity::WrapAngle
        | Quantity::Sliding
        | Quantity::Tension
        | Quantity::SpanLength
        | Quantity::Slip
        | Quantity::Length
        | Quantity::KineticEnergy
        | Quantity::ElasticEnergy
        | Quantity::GravityEnergy
        | Quantity::Touchdown
        | Quantity::LaidLength => unreachable!("the file is refused: these belong to whole parts"),
    }
}

/// Appends a quantity of the water or the air at a point.
fn push_of_water(values: &mut Vec<f64>, moment: &Moment, c: &Configuration, number: usize, quantity: Quantity) {
    let Moment { system, state, .. } = *moment;
    let (sensor, time) = (&system.sensors[number], state.instant());
    let position = sensor.marker.pose(c).place;
    if quantity == Quantity::FluidVelocity {
        return values.extend(system.flow_at(&position, time).iter());
    }
    if quantity == Quantity::Drag {
        let drag = sensor.in_element().map(|point| system.drag_at(point, c, &state.velocity, time));
        return values.extend(drag.unwrap_or_else(Vec3::zeros).iter());
    }
    let medium = &system.water().expect("the file is refused: without water it has no such quantity").medium;
    match quantity {
        Quantity::Submergence => values.push(medium.height(&position, time) - position.z),
        Quantity::Clearance => {
            let bottom = medium.bottom(&position).expect("the file is refused: the water has a depth");
            values.push(position.z - bottom);
        }
        _ => values.push(medium.height(&position, time) + system.origin.z),
    }
}

/// Appends what the section at a point of a beam bears, or its strains.
fn push_section(values: &mut Vec<f64>, moment: &Moment, loads: &JointLoads, number: usize, quantity: Quantity) {
    let Moment { system, response, fibers, .. } = *moment;
    let sensor = &system.sensors[number];
    let loads = SectionLoads { joints: loads, acceleration: &response.acceleration };
    if quantity == Quantity::Stress {
        let stress = match fibers.get(number) {
            Some(fiber) => sensor.stress_of(fiber, &loads),
            None => sensor.stress(&loads),
        };
        values.push(stress.expect("the file is refused: a general section has no stress"));
        return;
    }
    let section = sensor.section(&loads).expect("the file is refused: only points of beams have sections");
    match quantity {
        Quantity::SectionForce => values.extend(section.wrench.force),
        Quantity::EffectiveTension => values.push(section.wrench.force[0]),
        Quantity::WallTension => {
            let position = sensor.marker.pose(loads.joints.c).place;
            let pressure = sensor.in_element().map_or(0.0, |point| system.outer_pressure(point, &position));
            values.push(section.wrench.force[0] - pressure);
        }
        Quantity::SectionMoment => values.extend(section.wrench.moment),
        Quantity::AxialStrain => values.push(section.strains().axial),
        Quantity::Curvature => values.extend(section.strains().curvature),
        _ => values.push(section.strains().torsion),
    }
}

/// Appends a quantity of a joint; the springs of the system from `first_spring` on belong to joints.
pub(super) fn push_joint(
    values: &mut Vec<f64>,
    number: usize,
    quantity: Quantity,
    moment: &Moment,
    loads: &JointLoads,
    first_spring: usize,
) {
    let Moment { system, .. } = *moment;
    let parts = &system.joint_parts[number];
    match quantity {
        quantity if quantity.is_transmitted() => push_wrench(values, loads.reaction(parts), quantity),
        Quantity::Energy => {
            let own = parts.springs.iter().filter(|spring| **spring >= first_spring);
            let energies = own.map(|spring| of_spring(&system.springs[*spring], quantity, moment, loads));
            // From +0: of no spring 0, not -0.
            values.push(energies.fold(0.0, |sum, energy| sum + energy));
        }
        Quantity::Effort => {
            let drives = parts.drives.iter().map(|drive| loads.effort(*drive));
            let actuators = parts.actuators.iter().map(|actuator| loads.actuator_effort(*actuator));
            values.push(drives.chain(actuators).sum());
        }
        _ => {
            use Quantity::{Angle, AngleAcceleration, AngleRate};
            let is_angle = matches!(quantity, Angle | AngleRate | AngleAcceleration);
            let slid = parts.joint.and_then(|joint| system.way_slid(joint, loads.c, &moment.state.velocity));
            if let Some([way, rate]) = slid {
                values.push(if quantity.is_rate() { rate } else { way });
                return;
            }
            let coordinate = if is_angle { parts.angle } else { parts.distance };
            let coordinate = coordinate.expect("the file is refused: the joint leaves no such coordinate free");
            values.push(coordinate_of(coordinate, quantity, moment, loads.c));
        }
    }
}

/// Appends a quantity of a contact.
pub(super) fn push_contact(
    values: &mut Vec<f64>,
    number: usize,
    quantity: Quantity,
    moment: &Moment,
    loads: &JointLoads,
) {
    let found = moment.system.contact_loads(number, loads.c, loads.passage);
    values.push(match quantity {
        Quantity::NormalForce => found.normal,
        Quantity::FrictionForce => found.friction,
        Quantity::Penetration => found.penetration,
        Quantity::ContactLength => found.length,
        Quantity::WrapAngle => found.wrap,
        Quantity::Sliding => found.sliding,
        Quantity::Energy => found.energy,
        _ => return push_wrench(values, (found.force, found.moment), quantity),
    });
}

/// Appends a quantity of a foundation.
pub(super) fn push_foundation(
    values: &mut Vec<f64>,
    number: usize,
    quantity: Quantity,
    moment: &Moment,
    loads: &JointLoads,
) {
    let found = moment.system.foundation_loads(number, loads.c, loads.passage);
    match quantity {
        Quantity::Energy => values.push(found.energy),
        _ => push_wrench(values, (found.force, found.moment), quantity),
    }
}

/// Appends a quantity of a rope.
pub(super) fn push_rope(values: &mut Vec<f64>, number: usize, quantity: Quantity, moment: &Moment, loads: &JointLoads) {
    let rope = &moment.system.ropes[number];
    // An impossible rope ends a run before anybody reads it.
    let Some(pull) = rope.pull(loads.c, loads.passage) else { return values.push(f64::NAN) };
    let (spans, sheaves) = (rope.spans(), 1..rope.spans());
    match quantity {
        Quantity::Tension => values.extend((0..spans).map(|span| pull.pulls[rope.stretch_of(span)].value)),
        Quantity::SpanLength => values.extend(&pull.laid.lengths[..spans]),
        Quantity::WrapAngle => values.extend(sheaves.map(|seat| rope.wrap(seat, &pull.laid))),
        Quantity::Slip => values.extend(sheaves.map(|seat| rope.slipped(seat, &pull, loads.c))),
        Quantity::Energy => values.push(rope.energy(&pull)),
        _ => values.push(rope.length(&pull.laid)),
    }
}

/// A quantity of a drive, a lock, an actuator, a gear or a spring: its effort and power, or its coordinate.
pub(super) fn of_connection(kind: Kind, number: usize, quantity: Quantity, moment: &Moment, loads: &JointLoads) -> f64 {
    let Moment { system, state, .. } = *moment;
    let coordinate = match kind {
        Kind::Drive => system.drives[number].coordinate.expect("outputs look at drives of joints"),
        Kind::Lock => system.locks[number].coordinate,
        Kind::Actuator => system.actuators[number].coordinate,
        Kind::Gear => system.gear_coordinate(number),
        _ => return of_spring(&system.springs[number], quantity, moment, loads),
    };
    let effort = || match kind {
        Kind::Drive => loads.effort(number),
        Kind::Lock => loads.lock_effort(number),
        Kind::Actuator => loads.actuator_effort(number),
        _ => loads.gear_effort(number),
    };
    match quantity {
        Quantity::Effort => effort(),
        Quantity::Power => effort() * system.relative_coordinates[coordinate].rate(loads.c, &state.velocity),
        _ => coordinate_of(coordinate, quantity, moment, loads.c),
    }
}

/// Appends the energies, momenta or counts of the whole mechanism.
pub(super) fn push_total(values: &mut Vec<f64>, measure: &Measure, moment: &Moment, c: &Configuration) {
    let Moment { system, state, .. } = *moment;
    match measure {
        Measure::Energy => {
            let parts = [system.kinetic_energy(c, &state.velocity), system.elastic_energy(c), system.gravity_energy(c)];
            values.extend(parts);
            values.push(parts.iter().sum());
        }
        Measure::Account(in_fluid) => {
            let EnergyAccount { work, drift, .. } = state.balance.account.unwrap_or_default();
            values.extend([work.loads, work.actuators, work.drives, work.dissipated, drift]);
            values.extend(in_fluid.then_some(work.fluids));
        }
        Measure::Momentum => {
            let (linear, angular) = system.momentum(&state.q, &state.momentum);
            let [linear, angular] = system.with_transport([linear, angular], c, &state.velocity);
            values.extend(linear.iter().chain(angular.iter()));
        }
        Measure::Path => {
            let unstable = state.path.as_ref().map_or(0, |path| path.unstable);
            values.extend([state.instant(), unstable as f64]);
        }
        Measure::Statistics => {
            let counts = &state.statistics;
            // Counts are far below 2^53: exact.
            values.extend([counts.steps, counts.iterations, counts.rejected].map(|count| count as f64));
        }
        Measure::Sensors(..) | Measure::Frame(..) | Measure::Connection(..) => {}
        Measure::Rope(..) | Measure::Whole(..) => {}
    }
}

/// A quantity of a spring, friction or a stop.
pub(super) fn of_spring(spring: &Spring, quantity: Quantity, moment: &Moment, loads: &JointLoads) -> f64 {
    let (Moment { system, state, .. }, JointLoads { c, passage, .. }) = (moment, loads);
    let coordinate = &system.relative_coordinates[spring.coordinate];
    match quantity {
        Quantity::Effort => 0.0 - spring.tension(coordinate, c, passage), // 0 where it is 0, not -0
        Quantity::Force => spring.tension(coordinate, c, passage),
        Quantity::Energy => spring.energy(coordinate, c),
        Quantity::Power => spring.dissipation(coordinate, c, &state.velocity),
        _ => coordinate_of(spring.coordinate, quantity, moment, c),
    }
}

/// An energy of a beam or a body, J, or how a beam lies on the seabed, m.
pub(super) fn of_part(part: Part, quantity: Quantity, moment: &Moment, c: &Configuration) -> f64 {
    let Moment { system, state, .. } = moment;
    match (quantity, part) {
        (Quantity::Touchdown, Part::Beam(beam)) => return system.touchdown(beam, c),
        (Quantity::LaidLength, Part::Beam(beam)) => return system.laid_length(beam, c),
        _ => {}
    }
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
