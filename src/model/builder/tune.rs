//! What may change while the system runs: gravity, loads, actuators, springs and dampers, and where a host wants drives and frames to be.

use super::{heat, signal, vector};
use crate::math::jet::Jet;
use crate::math::rotation::{quaternion_matrix, rotation_matrix, rotation_matrix_jet};
use crate::math::{Mat3, Vec3};
use crate::mechanics::force::actuator::EffortGuide;
use crate::mechanics::force::effort_law::EffortFunction;
use crate::mechanics::force::law::Law;
use crate::mechanics::force::load::LoadGuide;
use crate::mechanics::geometry::pose::{Pose, angular_velocity};
use crate::mechanics::input::excitation::{HostEffort, HostWrench, Wrench};
use crate::mechanics::input::host_motion::Targets;
use crate::mechanics::marker::relative_coordinate::Measure;
use crate::mechanics::system::System;
use crate::model::file::document::Document;
use crate::model::file::entries::actuator::Action;
use crate::model::file::entries::drive::{DriveSpec, Motion};
use crate::model::file::entries::frame::{FrameSpec, Orientation};
use crate::model::file::entries::joint::JointSpec;
use crate::model::file::entries::spring::{Only, SpringLaw};
use crate::model::file::entries::switch::SwitchSpec;
use crate::model::file::number::Number;
use crate::model::shape::sections;
use nalgebra::Quaternion;
use std::sync::Arc;

/// The numbers of a spring.
pub(super) struct Tuned {
    pub strength: Strength,
    /// The value of the coordinate at which it is free of force; none: the one as drawn.
    pub rest: Option<Number>,
}

/// What a spring of the system has its force from.
pub(super) enum Strength {
    Spring(SpringLaw),
    /// Dry, viscous, and the speed up to which dry friction grows.
    Friction([Number; 3]),
    Stop {
        limits: [Option<Number>; 2],
        stiffness: Number,
        damping: Number,
    },
}

/// What the file has of springs of the system, in the order of their building: springs, friction, stops; each with its name and what it acts on.
pub(super) fn springs_of_file(document: &Document) -> impl Iterator<Item = (&str, Action, Tuned)> {
    let springs = document
        .springs
        .iter()
        .map(|own| (own.name.as_str(), own.action, Tuned { strength: Strength::Spring(own.law), rest: own.rest }));
    let frictions = document.frictions.iter().map(|own| {
        let strength = Strength::Friction([own.coulomb, own.viscous, own.speed]);
        (own.name.as_str(), own.action, Tuned { strength, rest: None })
    });
    let stops = document.stops.iter().map(|own| {
        let (limits, stiffness, damping) = ([own.lower, own.upper], own.stiffness, own.damping);
        (own.name.as_str(), own.action, Tuned { strength: Strength::Stop { limits, stiffness, damping }, rest: None })
    });
    springs.chain(frictions).chain(stops)
}

impl Tuned {
    fn linear(stiffness: Number, damping: Number) -> Self {
        Self { strength: Strength::Spring(SpringLaw::Linear { stiffness, damping, only: None }), rest: None }
    }

    /// Stiffness, damping, and the law that takes their place where it is not linear.
    pub(super) fn numbers(&self, document: &Document) -> (f64, f64, Option<Law>) {
        let law = match self.strength {
            Strength::Spring(law) => law,
            Strength::Friction(numbers) => {
                let [coulomb, viscous, speed] = numbers.map(|number| document.value(number));
                return (0.0, 0.0, Some(Law::Friction { coulomb, viscous, speed }));
            }
            Strength::Stop { limits: [lower, upper], stiffness, damping } => {
                let limit = |number: Option<Number>, none: f64| number.map_or(none, |number| document.value(number));
                let limits = [limit(lower, f64::NEG_INFINITY), limit(upper, f64::INFINITY)];
                let [stiffness, damping] = [stiffness, damping].map(|number| document.value(number));
                return (0.0, 0.0, Some(Law::Stop { limits, stiffness, damping }));
            }
        };
        match law {
            SpringLaw::Linear { stiffness, damping, only } => {
                let [stiffness, damping] = [stiffness, damping].map(|number| document.value(number));
                let sign = match only {
                    None => return (stiffness, damping, None),
                    Some(Only::Tension) => 1.0,
                    Some(Only::Compression) => -1.0,
                };
                (0.0, 0.0, Some(Law::OneSided { sign, stiffness, damping }))
            }
            SpringLaw::Function(force) => {
                let function = document.function(force);
                let has_rate = function.has_rate();
                let function = Arc::new(move |x, v| function.with_rate(x, v));
                (0.0, 0.0, Some(Law::Function { function, has_rate }))
            }
        }
    }
}

/// The springs of a joint with what they measure, in the order of their building.
pub(super) fn springs_of(joint: &JointSpec) -> Vec<(Measure, Tuned)> {
    let coordinates = [(Measure::Angle(0), joint.angle), (Measure::Distance(0), joint.distance)];
    let on_coordinates = coordinates
        .into_iter()
        .filter_map(|(measure, own)| own.map(|own| (measure, Tuned::linear(own.stiffness, own.damping))));
    let mut springs: Vec<_> = on_coordinates.collect();
    if let Some(bushing) = joint.bushing {
        for axis in 0..3 {
            let (stiffness, damping) = (bushing.stiffness[axis], bushing.damping[axis]);
            springs.push((Measure::Distance(axis), Tuned::linear(stiffness, damping)));
        }
        for axis in 0..3 {
            let (stiffness, damping) = (bushing.rotational_stiffness[axis], bushing.rotational_damping[axis]);
            springs.push((Measure::Rotation(axis), Tuned::linear(stiffness, damping)));
        }
    }
    springs
}

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
    let System { springs, joint_parts, .. } = system;
    let mut set = |number: usize, tuned: Tuned| {
        let spring = &mut springs[number];
        (spring.stiffness, spring.damping, spring.law) = tuned.numbers(document);
        if let Some(rest) = tuned.rest {
            spring.rest = document.value(rest);
        }
    };
    // The springs of the file are built before those of joints.
    springs_of_file(document).enumerate().for_each(|(number, (.., tuned))| set(number, tuned));
    for (parts, joint) in joint_parts.iter().zip(&document.joints) {
        parts.springs.iter().zip(springs_of(joint)).for_each(|(number, (_, tuned))| set(*number, tuned));
    }
}

/// The frames that a host gives a quaternion of length 0 for the end of a step from `begin` to `end`, s, which says nothing of their orientation.
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

/// Sets what the host wants from `begin` to `end`, s: where drives and frames are to be at the end, and how loads and actuators act until then. `line` is the
/// value of an input and its derivative by time. A frame whose quaternion is 0 keeps its orientation.
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

/// All switches of the system in the order of their building: those of joints, of drives, of locks. None: a drive that only its joint releases.
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
            let length = Vec3::new(x, y, z).norm().hypot(w);
            (length > SHORTEST).then(|| quaternion_matrix([w, x, y, z].map(|part| part / length.max(SHORTEST))))
        }
    }
}

/// The angular velocity of an orientation whose numbers change, in global axes: of a quaternion `2 Im(q' q⁻¹)`; 0 where it has no direction.
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
