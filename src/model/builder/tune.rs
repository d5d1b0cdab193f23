//! What may change while the system runs: gravity, loads, actuators, springs and dampers, and where a host wants drives
//! and frames to be.

use super::{contacts, foundations, heat, ropes, signal, vector};
use crate::math::elementary::hypot;
use crate::math::jet::Jet;
use crate::math::rotation::{quaternion_matrix, rotation_matrix, rotation_matrix_jet};
use crate::math::{Mat3, Vec3};
use crate::mechanics::force::actuator::EffortGuide;
use crate::mechanics::force::effort_law::EffortFunction;
use crate::mechanics::force::load::LoadGuide;
use crate::mechanics::geometry::pose::{Pose, angular_velocity};
use crate::mechanics::input::excitation::{HostEffort, HostWrench, Wrench};
use crate::mechanics::input::host_motion::Targets;
use crate::mechanics::system::System;
use crate::model::file::document::Document;
use crate::model::file::entries::drive::{DriveSpec, Motion};
use crate::model::file::entries::frame::{FrameSpec, Orientation};
use crate::model::file::entries::switch::SwitchSpec;
use crate::model::file::number::Number;
use crate::model::shape::sections;
use nalgebra::Quaternion;
use std::sync::Arc;

/// An effort as a function of time and of what it reads, with its derivative with respect to one of these.
pub(super) fn effort(document: &Document, number: Number) -> Arc<EffortFunction> {
    let function = document.function(number);
    let numbers = function.readings();
    Arc::new(move |time: f64, values: &[f64], by: usize| {
        let jet = function.with_readings(time, &|number: usize| {
            let place = numbers.partition_point(|own| *own < number);
            if place == by { Jet::variable(values[place]) } else { Jet::constant(values[place]) }
        });
        [jet.value, jet.first]
    })
}

/// Brings a built system to the tunable parameters of now.
pub fn retune(document: &Document, system: &mut System) {
    system.gravity = vector(document, document.model.gravity);
    for (load, written) in system.loads.iter_mut().zip(&document.loads) {
        if let LoadGuide::Signals { force, moment } = &mut load.guide {
            *force = written.force.map(|number| signal(document, number));
            *moment = written.moment.map(|number| signal(document, number));
        }
    }
    for (actuator, written) in system.actuators.iter_mut().zip(&document.actuators) {
        match &mut actuator.guide {
            EffortGuide::Signal(effort) => *effort = signal(document, written.effort),
            EffortGuide::Law(law) => {
                law.signal = signal(document, written.effort);
                law.function = effort(document, written.effort);
                law.has_corners = document.function(written.effort).has_corners();
            }
            EffortGuide::Host => {}
        }
    }
    system.collect_breaks();
    for (beam, written) in system.beams.iter_mut().zip(&document.beams) {
        let Some([damping, mass_damping]) = sections::damping(document, written) else { continue };
        beam.mass_damping = mass_damping;
        let tension_damping = written.tension_damping.map_or(0.0, |number| document.value(number));
        for element in &mut system.mesh.elements[beam.element_range()] {
            element.set_damping(damping, tension_damping);
        }
    }
    set_springs(document, system);
    contacts::retune(document, system);
    foundations::retune(document, system);
    ropes::retune(document, system);
}

/// Sets the numbers of springs, friction and stops.
pub(super) fn set_springs(document: &Document, system: &mut System) {
    let System { springs, joint_parts, size, .. } = system;
    // The springs of the file are built before those of joints.
    for (spring, (.., own)) in springs.iter_mut().zip(document.springs_in_system(&document.numbers, *size)) {
        (spring.stiffness, spring.damping, spring.law) = (own.stiffness, own.damping, own.law);
        spring.rest = own.rest.unwrap_or(spring.rest);
    }
    for (parts, joint) in joint_parts.iter().zip(&document.joints) {
        for (number, (_, values)) in parts.springs.iter().zip(joint.springs()) {
            let spring = &mut springs[*number];
            [spring.stiffness, spring.damping] = values.map(|number| document.value(number));
            spring.law = None;
        }
    }
}

/// The frames that a host gives a quaternion of length 0 for the end of a step from `begin` to `end`, s, which says
/// nothing of their orientation.
pub fn undirected(
    document: &Document,
    line: impl Fn(Number) -> (f64, f64),
    [begin, end]: [f64; 2],
) -> impl Iterator<Item = (&FrameSpec, [Number; 4])> {
    document.frames.iter().filter_map(move |frame| match frame.orientation {
        Orientation::Quaternion(numbers) => {
            let at_end = |number: Number| line(number).0 + line(number).1 * (end - begin);
            axes(frame.orientation, at_end).is_none().then_some((frame, numbers))
        }
        Orientation::Rotation(_) => None,
    })
}

/// Sets what the host wants from `begin` to `end`, s: where drives and frames are to be at the end, and how loads and
/// actuators act until then. `line` is the value of an input and its derivative by time. A frame whose quaternion is 0
/// keeps its orientation.
pub fn aim(
    document: &Document,
    origin: &Vec3,
    line: impl Fn(Number) -> (f64, f64),
    [begin, end]: [f64; 2],
    targets: &mut Targets,
) {
    let at_end = |number: Number| {
        let (value, slope) = line(number);
        value + slope * (end - begin)
    };
    targets.end = end;
    let departure = &mut targets.departure;
    let first = departure.is_first();
    let drives = targets.drives.iter_mut().zip(&mut departure.drives).zip(document.motions());
    for ((target, course), (motion, _)) in drives.filter(|(_, (_, is_input))| *is_input) {
        let number = motion.number();
        *target = at_end(number);
        if first && matches!(motion, Motion::Value(_)) {
            course.start_with(line(number).1);
        }
    }
    for ((target, course), frame) in targets.frames.iter_mut().zip(&mut departure.frames).zip(&document.frames) {
        if !frame.input {
            continue;
        }
        let axes = axes(frame.orientation, at_end).unwrap_or(target.axes);
        *target = Pose { place: Vec3::from(frame.position.map(at_end)) - origin, axes };
        if first {
            let velocity = Vec3::from(frame.position.map(|number| line(number).1));
            course.start_with([velocity, spin(frame.orientation, &line)]);
        }
    }
    for (target, load) in targets.loads.iter_mut().zip(&document.loads).filter(|(_, load)| load.input) {
        let lines = [load.force, load.moment].map(|numbers| numbers.map(&line));
        let part = |select: fn(&(f64, f64)) -> f64| {
            let [force, moment] = lines.each_ref().map(|line| Vec3::from_fn(|i, _| select(&line[i])));
            Wrench { force, moment }
        };
        *target = HostWrench { value: part(|line| line.0), rate: part(|line| line.1), since: begin };
    }
    let actuators = targets.efforts.iter_mut().zip(&document.actuators);
    for (target, actuator) in actuators.filter(|(_, actuator)| actuator.input) {
        let (value, rate) = line(actuator.effort);
        *target = HostEffort { value, rate, since: begin };
    }
    let heated = document.beams.iter().filter(|beam| beam.temperature_input);
    for ((target, departure), beam) in targets.heats.iter_mut().zip(&mut targets.departure.heats).zip(heated) {
        *target = heat::given(beam, at_end);
        if begin == end {
            *departure = *target;
        }
    }
    // In the order of their building.
    for (target, switch) in targets.switches.iter_mut().zip(switches(document)) {
        if let Some(SwitchSpec { active, input: true }) = switch {
            *target = line(active).0;
        }
    }
}

/// All switches of the system in the order of their building: those of joints, of drives, of locks. None: a drive that
/// only its joint releases.
pub fn switches(document: &Document) -> impl Iterator<Item = Option<SwitchSpec>> + '_ {
    let joints = document.joints.iter().map(|joint| joint.switch).filter(Option::is_some);
    let has_one = |drive: &&DriveSpec| drive.switch.is_some() || document.joints[drive.joint].switch.is_some();
    let drives = document.drives.iter().filter(has_one).map(|drive| drive.switch);
    joints.chain(drives).chain(document.locks.iter().map(|lock| Some(lock.switch)))
}

/// Shortest quaternion that has a direction.
const SHORTEST: f64 = 1e-9;

/// The axes of an orientation with the numbers `value`; none: its quaternion has no length.
pub(super) fn axes(orientation: Orientation, value: impl Fn(Number) -> f64) -> Option<Mat3> {
    match orientation {
        Orientation::Rotation(numbers) => Some(rotation_matrix(&Vec3::from(numbers.map(value)))),
        Orientation::Quaternion(numbers) => {
            let [w, x, y, z] = numbers.map(value);
            let length = hypot(Vec3::new(x, y, z).norm(), w);
            (length > SHORTEST).then(|| quaternion_matrix([w, x, y, z].map(|part| part / length.max(SHORTEST))))
        }
    }
}

/// The angular velocity of an orientation whose numbers change, in global axes: of a quaternion `2 Im(q' q⁻¹)`; 0 where
/// it has no direction.
fn spin(orientation: Orientation, line: impl Fn(Number) -> (f64, f64)) -> Vec3 {
    match orientation {
        Orientation::Rotation(numbers) => {
            let vector = numbers.map(&line).map(|(value, first)| Jet { value, first, second: 0.0 });
            let [now, change, _] = rotation_matrix_jet(&vector).map(|axes| Pose { place: Vec3::zeros(), axes });
            angular_velocity(&now, &change)
        }
        Orientation::Quaternion(numbers) => {
            let part = |select: fn((f64, f64)) -> f64| {
                let [w, x, y, z] = numbers.map(&line).map(select);
                Quaternion::new(w, x, y, z)
            };
            let (now, change) = (part(|line| line.0), part(|line| line.1));
            let square = now.norm_squared();
            let turn = (change * now.conjugate()).imag() * 2.0;
            if square > SHORTEST * SHORTEST { turn / square.max(SHORTEST * SHORTEST) } else { Vec3::zeros() }
        }
    }
}
