//! The whole system. Never changes in a run but for gravity, the size of loads, springs and dampers: what is tunable.

pub mod beam_contacts;
mod breaks;
pub mod builder;
mod contacts;
mod dampers;
mod efforts;
pub mod energy;
mod equations;
mod finer;
pub mod fluids;
mod fluids_on_bodies;
mod foundations;
pub mod frame_cache;
pub mod gyroscopic;
mod heating;
pub mod inner_parts;
pub mod joint_parts;
mod labels;
mod limits;
pub mod mass;
pub mod middle_forces;
mod reach;
mod ropes;
pub mod rotation;
mod slides;
pub mod step_starts;
mod sticking;
mod switching;
mod tangent_layout;
pub mod variation;
mod winches;
pub mod work;

pub use breaks::AT_BREAK;
pub use equations::{copy_corner, copy_transposed};
pub use switching::Lock;
pub use winches::Winch;

use self::frame_cache::FrameCache;
use self::inner_parts::InnerPart;
use self::joint_parts::JointParts;
use crate::math::Vec3;
use crate::math::jet::Jet;
use crate::mechanics::beam::Beam;
use crate::mechanics::beam::ancf14::coordinates::NODE;
use crate::mechanics::beam::ancf14::kinematics::Holonomy;
use crate::mechanics::beam::configuration::BeamConfiguration;
use crate::mechanics::beam::mesh::Mesh;
use crate::mechanics::beam::node::Node;
use crate::mechanics::body::kinematics::BODY;
use crate::mechanics::body::rigid_body::RigidBody;
use crate::mechanics::constraint::joint::Joint;
use crate::mechanics::contact::Contact;
use crate::mechanics::contact::mutual::BeamContact;
use crate::mechanics::fluid::Fluid;
use crate::mechanics::force::actuator::Actuator;
use crate::mechanics::force::foundation::Foundation;
use crate::mechanics::force::load::{Direction, Load, Site};
use crate::mechanics::force::rope::Rope;
use crate::mechanics::force::spring::Spring;
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::input::guide::{Drive, MovingFrame};
use crate::mechanics::input::heat::Heat;
use crate::mechanics::input::heat_guide::HeatGuide;
use crate::mechanics::input::host_motion::Targets;
use crate::mechanics::input::prescribed::Prescribed;
use crate::mechanics::input::switch::Switch;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::marker::relative_coordinate::{Measure, RelativeCoordinate};
use crate::mechanics::marker::sensor::Sensor;
use crate::mechanics::state::State;
use std::ops::Range;

/// Coordinates of a position, the first ones of every node and body.
const PLACE: usize = 3;

/// The system. Coordinates: those of all nodes, then those of all bodies.
#[derive(Clone, Debug, Default)]
pub struct System {
    /// Beams in file order.
    pub beams: Vec<Beam>,
    /// Nodes and elements of all beams.
    pub mesh: Mesh,
    /// Rigid bodies in file order.
    pub bodies: Vec<RigidBody>,
    /// Moving frames in file order.
    pub moving_frames: Vec<MovingFrame>,
    /// Temperatures of beams in file order: one a beam, or one an element where it is not the same along the beam.
    pub heats: Vec<HeatGuide>,
    /// Everything that holds the system together: joints, the rigidity of bodies, drives, each in file order.
    pub joints: Vec<Joint>,
    /// What is measured between two markers: by springs, drives, outputs.
    pub relative_coordinates: Vec<RelativeCoordinate>,
    /// Drives in file order, then those of winches.
    pub drives: Vec<Drive>,
    /// Beams that are paid out, in file order.
    pub winches: Vec<Winch>,
    /// What engages and releases joints, locks and drives.
    pub switches: Vec<Switch>,
    /// Locks in file order.
    pub locks: Vec<Lock>,
    /// Springs in file order, then those of joints.
    pub springs: Vec<Spring>,
    /// What the joints of the model file consist of, in file order.
    pub joint_parts: Vec<JointParts>,
    /// Loads in file order.
    pub loads: Vec<Load>,
    /// Actuators in file order.
    pub actuators: Vec<Actuator>,
    /// Contacts of beams with surfaces, in file order.
    pub contacts: Vec<Contact>,
    /// Contacts of beams with each other and with themselves, in file order.
    pub beam_contacts: Vec<BeamContact>,
    /// Elastic foundations, in file order.
    pub foundations: Vec<Foundation>,
    /// Ropes over sheaves, in file order.
    pub ropes: Vec<Rope>,
    /// Watched points in the order of their adding.
    pub sensors: Vec<Sensor>,
    /// Largest extent of the system as drawn, m: what lengths are compared with.
    pub size: f64,
    /// Length of a straight line that is as far from its middle, in the mean square, as nodes and bodies are from
    /// theirs as drawn, m: unlike `size` the same in all directions.
    pub spread: f64,
    /// Where the origin of all positions in the state is, global, m: 0, or in the middle of a mechanism far from there.
    /// Doubles keep positions to 1e-16 of their size; times the axial stiffness, that is a force.
    pub origin: Vec3,
    /// Mass of everything, kg.
    pub mass: f64,
    /// Mass of each beam, kg.
    pub beam_masses: Vec<f64>,
    /// Gravity, m/s².
    pub gravity: Vec3,
    /// The times at which pieces of loads, actuators, drives and frames meet, ascending, s: steps end there.
    pub breaks: Vec<f64>,
    /// Whether a load, a joint or a spring acts on each node.
    pub held: Vec<bool>,
    /// Parts that act between the nodes of elements, with the element, in the order of the elements.
    pub inner_parts: Vec<(usize, InnerPart)>,
    /// The fluids that beams and bodies are in.
    pub fluids: Vec<Fluid>,
}

/// The largest size of numbers.
#[derive(Clone, Copy, Debug, Default)]
struct Largest {
    so_far: f64,
    /// Not-a-number must win: comparisons let it pass, a sum does not.
    sum: f64,
}

impl Largest {
    #[inline]
    fn add(&mut self, values: &[f64]) {
        for size in values.iter().map(|value| value.abs()) {
            self.so_far = if size > self.so_far { size } else { self.so_far };
            self.sum += size;
        }
    }

    fn size(self) -> f64 {
        if self.sum.is_nan() { self.sum } else { self.so_far }
    }
}

impl System {
    /// Sets `excitation` to what acts at `time`, s; `targets` has what a host gives.
    pub fn excite(&self, time: f64, targets: &Targets, excitation: &mut Excitation) {
        (excitation.time, excitation.gravity) = (time, self.gravity);
        excitation.drag = if self.is_in_fluid() { 1.0 } else { 0.0 };
        excitation.wrenches.clear();
        excitation.wrenches.extend(self.loads.iter().zip(&targets.loads).map(|(load, target)| load.at(time, target)));
        excitation.stations.clear();
        excitation.stations.extend(self.loads.iter().map(|load| load.station(time)));
        excitation.efforts.clear();
        let actuators = self.actuators.iter().zip(&targets.efforts);
        excitation.efforts.extend(actuators.map(|(actuator, target)| actuator.at(time, target)));
    }

    /// Whether loads act at `excitation` that derive from no potential: follower loads, and moments about axes that
    /// stand still, drag of a current, and friction on surfaces. Stability is then no matter of the stiffness alone.
    pub fn follows_no_potential(&self, excitation: &Excitation) -> bool {
        self.loads.iter().zip(&excitation.wrenches).any(|(load, wrench)| {
            let follows = load.direction == Direction::Follower && wrench.force != Vec3::zeros();
            follows || wrench.moment != Vec3::zeros()
        }) || self
            .actuators
            .iter()
            .any(|actuator| actuator.readings().iter().any(|own| own.coordinate != actuator.coordinate))
            || self.fluids.iter().any(Fluid::drags)
            || self.has_contact_friction()
    }

    /// What drives and frames prescribe at the start, `time` s; `from` is where drives by a rate are, and what is held
    /// where.
    pub fn prescribe_start(&self, time: f64, from: &Prescribed, targets: &Targets) -> Prescribed {
        let drives = self.drives.iter().zip(&from.drives).zip(&targets.drives);
        let frames = self.moving_frames.iter().zip(&targets.frames);
        Prescribed {
            drives: drives.map(|((drive, from), target)| drive.start(time, from.value, *target)).collect(),
            frames: frames.map(|(frame, target)| frame.start(time, target)).collect(),
            heats: self.heats.iter().map(|heat| heat.start(time, targets)).collect(),
            holds: from.holds.clone(),
        }
    }

    /// Sets `prescribed` to what drives and frames prescribe at `next` s, from the time and the motion of `state`.
    pub fn prescribe(&self, state: &State, next: f64, prescribed: &mut Prescribed) {
        let State { targets, prescribed: from, .. } = state;
        let time = state.instant();
        let drives = self.drives.iter().zip(&from.drives).enumerate();
        let advanced = drives.map(|(k, (drive, from))| match drive.switch {
            Some(switch) if self.releases(switch, state, next) => {
                drive.advanced_before(k, from.value, (time, next), targets)
            }
            _ => drive.advanced(k, from.value, (time, next), targets),
        });
        prescribed.drives.clear();
        prescribed.drives.extend(advanced);
        let frames = self.moving_frames.iter().enumerate();
        prescribed.frames.clear();
        prescribed.frames.extend(frames.map(|(k, frame)| frame.at(k, next, targets)));
        self.set_heats(next, targets, &mut prescribed.heats);
        prescribed.holds.clone_from(&from.holds);
    }

    /// The motion of a drive or a frame that is not finite at `time`, s, in words; of a drive the rate or the
    /// acceleration where that alone is not.
    fn undefined_motion(&self, time: f64) -> Option<String> {
        let targets = Targets {
            end: time,
            drives: vec![0.0; self.drives.len()],
            frames: vec![crate::mechanics::geometry::pose::Pose::default(); self.moving_frames.len()],
            heats: vec![Heat::default(); self.heats.len()],
            ..Targets::default()
        };
        let from = Prescribed { drives: vec![Jet::default(); self.drives.len()], ..Prescribed::default() };
        let motion = self.prescribe_start(time, &from, &targets);
        let drive = self.drives.iter().zip(&motion.drives).find(|(_, jet)| !jet.is_finite());
        let frame = self.moving_frames.iter().zip(&motion.frames).find(|(_, frame)| !frame.is_finite());
        let part = |jet: &Jet| match (jet.value.is_finite(), jet.first.is_finite()) {
            (false, _) => "motion",
            (true, false) => "rate",
            (true, true) => "acceleration",
        };
        let drive = drive.map(|(drive, jet)| format!("the {} of {}", part(jet), drive.label()));
        drive.or_else(|| frame.map(|(frame, _)| format!("the motion of frame {}", frame.name)))
    }

    /// Number of coordinates: those of the nodes, then those of the bodies.
    pub fn coordinates(&self) -> usize {
        self.mesh.coordinates() + BODY * self.bodies.len()
    }

    /// The coordinates of each node, then of each body; the first three of each are its position.
    fn parts(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        let bodies = self.bodies.iter().map(|body| body.start..body.start + BODY);
        self.mesh.nodes.iter().map(Node::coordinates).chain(bodies)
    }

    /// The relative coordinate of the first side of a gear.
    pub fn gear_coordinate(&self, gear: usize) -> usize {
        let mut sides = self.joints.iter().filter_map(|joint| joint.gear.as_ref());
        sides.find(|side| side.gear == gear).expect("every gear has both its sides").coordinate
    }

    /// Number of constraint conditions.
    pub fn constraints(&self) -> usize {
        self.joints_with_rows().last().map_or(0, |(_, rows)| rows.end)
    }

    /// The joints, each with the numbers of its conditions: both sides of a gear have the same one, and so have all
    /// elements that something slides along.
    pub fn joints_with_rows(&self) -> impl Iterator<Item = (&Joint, Range<usize>)> {
        let mut end = 0;
        self.joints.iter().map(move |joint| {
            let rows = joint.rows();
            let first = if joint.shares_conditions() { end - rows } else { end };
            end = first + rows;
            (joint, first..end)
        })
    }

    /// The numbers of joint `number` and of those that follow it and hold the same thing to other elements of a beam.
    pub fn entries(&self, number: usize) -> Range<usize> {
        let follows = |joint: &&Joint| joint.slide.as_ref().is_some_and(|slide| !slide.is_first());
        number..number + 1 + self.joints[number + 1..].iter().take_while(follows).count()
    }

    /// The instant that `q` with its `frames` and `prescribed` describe, after the accepted `state`.
    pub fn configuration<'a>(
        &'a self,
        q: &'a [f64],
        frames: &'a FrameCache,
        state: &'a State,
        prescribed: &'a Prescribed,
    ) -> Configuration<'a> {
        let (holonomy, relative_values) = (&state.holonomy, &state.relative_values);
        Configuration {
            beams: BeamConfiguration {
                q,
                frames: &frames.frames,
                holonomy,
                heats: &prescribed.heats,
                drives: &prescribed.drives,
            },
            relative_values,
            accepted: (&state.q, &state.prescribed),
            memory: &state.lists.memory,
            prescribed,
            mesh: &self.mesh,
        }
    }

    /// Follows the coordinates and the prescribed motion in `state`: references and holonomy angles (2.6, 2.7), the
    /// sensors' rotation vectors and the relative coordinates follow. `frames` belong to `state.q`.
    pub fn carry_references(&self, state: &mut State, frames: &FrameCache) {
        // Out of the state while the configuration looks at the rest of it.
        let mut rotations = std::mem::take(&mut state.rotations);
        let mut relative_values = std::mem::take(&mut state.relative_values);
        let configuration = self.configuration(&state.q, frames, state, &state.prescribed);
        for (sensor, rotation) in self.sensors.iter().zip(&mut rotations) {
            *rotation = sensor.rotation(&configuration, rotation);
        }
        for (coordinate, value) in self.relative_coordinates.iter().zip(&mut relative_values) {
            *value = coordinate.value(&configuration, *value);
        }
        (state.rotations, state.relative_values) = (rotations, relative_values);
        for element in &self.mesh.elements {
            if let Some(element) = element.ancf14() {
                let [first, second] = [0, 1].map(|node| &frames.frames[element.place.frame + node]);
                let angle = &mut state.holonomy[element.place.branch];
                *angle = Holonomy::new(first, second, *angle).angle;
            }
        }
        for (triad, frame) in state.triads.iter_mut().zip(&frames.frames) {
            *triad = frame.carried();
        }
    }

    /// The relative coordinates of `state`, which is as drawn: lengths are what they are, coordinates of joints 0.
    fn drawn_values(&self, state: &State) -> Vec<f64> {
        let mut frames = FrameCache::default();
        let configuration = frames.of(self, state);
        let value = |own: &RelativeCoordinate| match own.measure {
            Measure::Length => own.value(&configuration, 0.0),
            _ => 0.0,
        };
        self.relative_coordinates.iter().map(value).collect()
    }

    /// A relative coordinate in words.
    fn describe_relative_coordinate(&self, coordinate: &RelativeCoordinate) -> String {
        let named = self.joints.iter().find(|joint| joint.a == coordinate.a && joint.b == coordinate.b);
        named.map_or_else(|| String::from("a spring"), |joint| joint.name.clone())
    }

    /// Whether coordinate `index` is of a position, m; the others are slopes, angles and directors.
    pub fn is_place(&self, index: usize) -> bool {
        let nodes = self.mesh.coordinates();
        if index < nodes {
            index - self.mesh.nodes[self.mesh.node_of(index)].coordinates().start < PLACE
        } else {
            (index - nodes) % BODY < PLACE
        }
    }

    /// The largest of changes of the coordinates: of positions over the system's size, and of slopes, angles and
    /// directors as they are.
    pub fn motion_sizes(&self, changes: &[f64]) -> [f64; 2] {
        let (mut places, mut others) = (Largest::default(), Largest::default());
        for part in self.parts() {
            let values = &changes[part];
            // The coordinates of a node of ANCF14: the compiler unrolls what it knows.
            if let Ok(node) = <&[f64; NODE]>::try_from(values) {
                places.add(&node[..PLACE]);
                others.add(&node[PLACE..]);
            } else {
                places.add(&values[..PLACE]);
                others.add(&values[PLACE..]);
            }
        }
        [places.size() / self.size, others.size()]
    }

    /// The larger one of [`Self::motion_sizes`].
    pub fn motion_size(&self, changes: &[f64]) -> f64 {
        let [places, others] = self.motion_sizes(changes);
        if places > others || places.is_nan() { places } else { others }
    }

    /// The coordinate that changes most: positions over the system's size, and all, as shares of `ranges`, which are as
    /// [`Self::motion_sizes`] has them.
    pub fn largest_change(&self, changes: &[f64], ranges: [f64; 2]) -> usize {
        let [position, other] = ranges.map(|range| range.max(f64::MIN_POSITIVE));
        let mut largest = (0.0, 0);
        for part in self.parts() {
            for (local, value) in changes[part.clone()].iter().enumerate() {
                let size = value.abs() / if local < PLACE { position * self.size } else { other };
                if size > largest.0 {
                    largest = (size, part.start + local);
                }
            }
        }
        largest.1
    }

    /// Size of a correction of the coordinates, as [`Self::motion_size`], and the coordinate where it is largest.
    pub fn correction_size(&self, correction: &[f64]) -> (f64, usize) {
        let mut largest = (0.0, 0);
        for part in self.parts() {
            for (local, value) in correction[part.clone()].iter().enumerate() {
                let size = value.abs() / if local < PLACE { self.size } else { 1.0 };
                // Not-a-number must win: `>` alone would let it pass.
                if size > largest.0 || size.is_nan() {
                    largest = (size, part.start + local);
                }
            }
        }
        largest
    }

    /// Sets [`Self::spread`] from the coordinates as drawn.
    fn set_spread(&mut self, q: &[f64]) {
        let places: Vec<Vec3> = self.parts().map(|part| Vec3::from_column_slice(&q[part][..PLACE])).collect();
        let count = places.len().max(1) as f64;
        let middle = places.iter().sum::<Vec3>() / count;
        let square = places.iter().map(|place| (place - middle).norm_squared()).sum::<f64>() / count;
        // A line of length l has the mean square l²/12.
        self.spread = if square > 0.0 { (12.0 * square).sqrt() } else { self.size };
    }

    /// The mean over nodes and bodies of the products of two changes of the coordinates: of positions over
    /// [`Self::spread`], of slopes, angles and directors as they are. It measures the lengths of paths, alike with any
    /// number of elements.
    pub fn mean_product(&self, one: &[f64], other: &[f64]) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0_f64);
        for part in self.parts() {
            let [(places, rest), (other_places, other_rest)] =
                [one, other].map(|list| list[part.clone()].split_at(PLACE));
            let product =
                |one: &[f64], other: &[f64]| one.iter().zip(other).map(|(one, other)| one * other).sum::<f64>();
            sum += product(places, other_places) / (self.spread * self.spread) + product(rest, other_rest);
            count += 1.0;
        }
        sum / count.max(1.0)
    }

    /// The frames of nodes that joints depend on, by their numbers.
    pub fn joint_frames(&self) -> Vec<usize> {
        self.frames_of(self.joints.iter().flat_map(|joint| [joint.a, joint.b]))
    }

    /// The frames of nodes that `markers` depend on, by their numbers.
    fn frames_of(&self, markers: impl Iterator<Item = Marker>) -> Vec<usize> {
        let frames = markers.flat_map(|marker| match marker {
            Marker::Node { node, .. } => match self.mesh.nodes[node] {
                Node::Ancf14 { frame, .. } => frame..frame + 1,
                Node::Ancf24 { .. } => 0..0,
            },
            Marker::Section { element, .. } => match self.mesh.elements[element].ancf14() {
                Some(element) => element.place.frame..element.place.frame + 2,
                None => 0..0,
            },
            Marker::Ground(_) | Marker::Frame { .. } | Marker::Body { .. } => 0..0,
        });
        let mut frames: Vec<usize> = frames.collect();
        frames.sort_unstable();
        frames.dedup();
        frames
    }

    /// Whether a load, a joint or a spring acts on a node.
    pub fn is_held(&self, node: usize) -> bool {
        self.held.get(node).copied().unwrap_or(false)
    }

    /// Finds the nodes on which something acts.
    pub fn find_held_nodes(&mut self) {
        let loads = self.loads.iter().filter_map(|load| match &load.site {
            Site::Point(marker) => Some(marker),
            Site::Line(_) | Site::Moving(_) => None,
        });
        let joints = self.joints.iter().flat_map(|joint| [&joint.a, &joint.b]);
        let springs = self.springs.iter().flat_map(|spring| self.sides(spring.coordinate));
        let actuators = self.actuators.iter().flat_map(|actuator| self.sides(actuator.coordinate));
        let mut held = vec![false; self.mesh.nodes.len()];
        let mut hold = |marker: &Marker| {
            if let Marker::Node { node, .. } = marker {
                held[*node] = true;
            }
        };
        loads.chain(joints).chain(springs).chain(actuators).for_each(&mut hold);
        self.ropes.iter().for_each(|rope| rope.seats.iter().for_each(|seat| hold(&seat.marker)));
        self.held = held;
    }
}
