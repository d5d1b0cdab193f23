//! The whole machine: residual, tangent and constraints, summed over its parts in file order. Never changes in a run but for
//! gravity and the size of loads.

use super::beam::coordinates::{ELEMENT, NODE, P, R, THETA, vec3};
use super::beam::element::{Element, Evaluation};
use super::beam::frame::{NodeFrame, Triad};
use super::beam::kinematics::{Holonomy, Kinematics};
use super::joint::{Joint, JointGradient};
use super::load::{Excitation, Load};
use super::marker::{Configuration, MARKER};
use super::sensor::{Sensor, Snapshot};
use super::state::State;
use crate::error::Error;
use crate::math::Vec3;
use crate::math::blocks::{Block, Blocks};

/// A beam: a run of nodes and elements.
#[derive(Clone, Debug, PartialEq)]
pub struct Beam {
    /// Name in the model file.
    pub name: String,
    /// Its first node.
    pub first_node: usize,
    /// Its first element.
    pub first_element: usize,
    /// Number of elements; it has one node more.
    pub elements: usize,
    /// Largest twist rate that `strain = "large_truncated"` bears, rad/m (MECHANICS, trap 9); infinite for the other strains.
    pub twist_limit: f64,
}

/// Slopes `|r'|` in which the element means something: outside it is stretched or squeezed beyond any beam theory (MECHANICS 7.4).
const STRETCHES: std::ops::RangeInclusive<f64> = 0.3..=3.0;
/// Smallest `1 + t_0·t_1` of an element's ends: 143 degrees between them, near the singularity of the minimal rotation (MECHANICS 2.6).
const SMALLEST_COSINE: f64 = 0.2;
/// Largest change of the holonomy angle or of the twist of an element in a step, rad: the branch is safe below pi (MECHANICS 2.6).
const LARGEST_TWIST_CHANGE: f64 = 2.0;

/// The machine.
#[derive(Clone, Debug)]
pub struct System {
    /// Beams in file order.
    pub beams: Vec<Beam>,
    /// Elements of all beams.
    pub elements: Vec<Element>,
    /// Joints in file order.
    pub joints: Vec<Joint>,
    /// Loads in file order.
    pub loads: Vec<Load>,
    /// Watched points in the order of their adding.
    pub sensors: Vec<Sensor>,
    /// Largest extent of the machine as drawn, m: what lengths are compared with.
    pub size: f64,
    /// Gravity, m/s².
    pub gravity: Vec3,
}

impl System {
    /// Of its parts; `gravity` in m/s².
    pub fn new(
        beams: Vec<Beam>,
        elements: Vec<Element>,
        joints: Vec<Joint>,
        loads: Vec<Load>,
        sensors: Vec<Sensor>,
        gravity: Vec3,
        size: f64,
    ) -> Self {
        Self { beams, elements, joints, loads, sensors, size, gravity }
    }

    /// Sets `excitation` to what acts at `time`, s.
    pub fn excite(&self, time: f64, excitation: &mut Excitation) {
        excitation.gravity = self.gravity;
        excitation.wrenches.clear();
        excitation.wrenches.extend(self.loads.iter().map(|load| load.at(time)));
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.beams.iter().map(|beam| beam.elements + 1).sum()
    }

    /// Number of coordinates.
    pub fn coordinates(&self) -> usize {
        NODE * self.nodes()
    }

    /// Number of constraint conditions.
    pub fn constraints(&self) -> usize {
        self.joints.iter().map(Joint::rows).sum()
    }

    /// Frames of all nodes at `q` relative to the reference `triads`.
    pub fn frames(&self, q: &[f64], triads: &[Triad], frames: &mut Vec<NodeFrame>) {
        frames.clear();
        frames.extend(q.chunks_exact(NODE).zip(triads).map(|(q, triad)| NodeFrame::new(q, triad)));
    }

    /// The instant that `q`, `frames` and the accepted `holonomy` angles describe.
    pub fn configuration<'a>(
        &'a self,
        q: &'a [f64],
        frames: &'a [NodeFrame],
        holonomy: &'a [f64],
    ) -> Configuration<'a> {
        Configuration { q, frames, holonomy, elements: &self.elements }
    }

    /// Appends the blocks of the tangent: one an element, then one a load point.
    pub fn push_tangent_blocks(&self, blocks: &mut Blocks) {
        for element in &self.elements {
            let start = NODE * element.node;
            blocks.push(Block { row: start, column: start, rows: ELEMENT, columns: ELEMENT });
        }
        for (marker, _) in self.loads.iter().flat_map(|load| &load.points) {
            let range = marker.coordinates(&self.elements);
            blocks.push(Block { row: range.start, column: range.start, rows: range.len(), columns: range.len() });
        }
    }

    /// `∂U/∂q − F`: internal minus external forces. `increment`: the change of `q` over a step whose middle `c` is, or none.
    pub fn forces(&self, c: &Configuration, increment: Option<&[f64]>, excitation: &Excitation, forces: &mut [f64]) {
        self.add_external(c, excitation, forces);
        for (number, element) in self.elements.iter().enumerate() {
            let gradient = evaluation(c, number, increment).gradient();
            add(forces, NODE * element.node, gradient.as_slice());
        }
    }

    /// [`Self::forces`], and `scale` times their derivative by `q` into the first blocks of `tangent`
    /// (over a step: twice the derivative by the coordinates at its end).
    pub fn forces_and_tangent(
        &self,
        c: &Configuration,
        increment: Option<&[f64]>,
        excitation: &Excitation,
        scale: f64,
        forces: &mut [f64],
        tangent: &mut Blocks,
    ) {
        self.add_external(c, excitation, forces);
        for (number, element) in self.elements.iter().enumerate() {
            let (gradient, hessian) = evaluation(c, number, increment).gradient_and_hessian();
            add(forces, NODE * element.node, gradient.as_slice());
            for (target, value) in tangent.block_mut(number).iter_mut().zip(hessian.as_slice()) {
                *target = scale * value;
            }
        }
        let mut block = self.elements.len();
        for (load, wrench) in self.loads.iter().zip(&excitation.wrenches) {
            for (number, (marker, _)) in load.points.iter().enumerate() {
                let count = marker.coordinates(&self.elements).len();
                let force_q = load.force_q(c, number, wrench) * -scale;
                copy_corner(tangent.block_mut(block), count, count, |row, column| force_q[(row, column)]);
                block += 1;
            }
        }
    }

    /// Sets `forces` to minus the external forces.
    fn add_external(&self, c: &Configuration, excitation: &Excitation, forces: &mut [f64]) {
        forces.fill(0.0);
        for element in &self.elements {
            add(forces, NODE * element.node, (-element.weight(&excitation.gravity)).as_slice());
        }
        for (load, wrench) in self.loads.iter().zip(&excitation.wrenches) {
            for (number, (marker, _)) in load.points.iter().enumerate() {
                let range = marker.coordinates(&self.elements);
                let force = -load.force(c, number, wrench);
                add(forces, range.start, &force.as_slice()[..range.len()]);
            }
        }
    }

    /// Adds `factor` times the mass matrix to the elements' blocks of `tangent`.
    pub fn add_mass(&self, factor: f64, tangent: &mut Blocks) {
        for (number, element) in self.elements.iter().enumerate() {
            for (target, mass) in tangent.block_mut(number).iter_mut().zip(element.mass.as_slice()) {
                *target += factor * mass;
            }
        }
    }

    /// `product = M vector`.
    pub fn mass_times(&self, vector: &[f64], product: &mut [f64]) {
        product.fill(0.0);
        for element in &self.elements {
            let start = NODE * element.node;
            let own = nalgebra::SVector::<f64, ELEMENT>::from_column_slice(&vector[start..start + ELEMENT]);
            add(product, start, (element.mass * own).as_slice());
        }
    }

    /// Constraint conditions `g(q)`, zero when the joints hold; m or 1.
    pub fn constraint_conditions(&self, c: &Configuration, g: &mut [f64]) {
        let mut row = 0;
        for joint in &self.joints {
            joint.phi(c, &mut g[row..row + joint.rows()]);
            row += joint.rows();
        }
    }

    /// `∂g/∂q`, a pair of blocks a joint.
    pub fn constraint_gradients(&self, c: &Configuration, gradients: &mut Vec<JointGradient>) {
        gradients.clear();
        gradients.extend(self.joints.iter().map(|joint| joint.phi_q(c)));
    }

    /// `forces += factor · (∂g/∂q)ᵀ multipliers`.
    pub fn add_constraint_forces(
        &self,
        gradients: &[JointGradient],
        multipliers: &[f64],
        factor: f64,
        forces: &mut [f64],
    ) {
        let mut row = 0;
        for (joint, gradient) in self.joints.iter().zip(gradients) {
            for (marker, block) in [(&joint.a, &gradient.a), (&joint.b, &gradient.b)] {
                let range = marker.coordinates(&self.elements);
                for (local, coordinate) in range.enumerate() {
                    for condition in 0..joint.rows() {
                        forces[coordinate] += factor * block[(condition, local)] * multipliers[row + condition];
                    }
                }
            }
            row += joint.rows();
        }
    }

    /// Strain energy, J.
    pub fn elastic_energy(&self, c: &Configuration) -> f64 {
        (0..self.elements.len()).map(|number| evaluation(c, number, None).energy()).sum()
    }

    /// `vᵀ M v / 2`, J.
    pub fn kinetic_energy(&self, velocity: &[f64]) -> f64 {
        let product = |element: &Element| {
            let start = NODE * element.node;
            let own = nalgebra::SVector::<f64, ELEMENT>::from_column_slice(&velocity[start..start + ELEMENT]);
            own.dot(&(element.mass * own))
        };
        0.5 * self.elements.iter().map(product).sum::<f64>()
    }

    /// `−Σ m g·r`, J; zero at the origin.
    pub fn gravity_energy(&self, q: &[f64]) -> f64 {
        let lift = |element: &Element| {
            let own = &q[NODE * element.node..NODE * (element.node + 2)];
            own.iter().zip(&element.weight(&self.gravity)).map(|(q, weight)| q * weight).sum::<f64>()
        };
        // From +0: without gravity the energy is 0, not −0.
        self.elements.iter().fold(0.0, |sum, element| sum - lift(element))
    }

    /// Linear momentum (kg m/s) and angular momentum about the origin (kg m²/s): `Σ P_r`, `Σ r × P_r + p × P_p + P_θ t` (MECHANICS 7.2).
    pub fn momentum(&self, q: &[f64], momentum: &[f64]) -> (Vec3, Vec3) {
        let (mut linear, mut angular) = (Vec3::zeros(), Vec3::zeros());
        for (q, momentum) in q.chunks_exact(NODE).zip(momentum.chunks_exact(NODE)) {
            let (force, slope) = (vec3(momentum, R), vec3(q, P));
            linear += force;
            angular += vec3(q, R).cross(&force) + slope.cross(&vec3(momentum, P)) + slope.normalize() * momentum[THETA];
        }
        (linear, angular)
    }

    /// Ends a step at the coordinates in `state`: references and holonomy angles (2.6, 2.7) and the sensors' rotation vectors follow.
    /// `frames` belong to `state.q`.
    pub fn carry_references(&self, state: &mut State, frames: &[NodeFrame]) {
        let configuration = self.configuration(&state.q, frames, &state.holonomy);
        for (sensor, rotation) in self.sensors.iter().zip(&mut state.rotations) {
            *rotation = sensor.rotation(&configuration, rotation);
        }
        for (number, element) in self.elements.iter().enumerate() {
            let [first, second] = [&frames[element.node], &frames[element.node + 1]];
            state.holonomy[number] = Holonomy::new(first, second, state.holonomy[number]).angle;
        }
        for (triad, frame) in state.triads.iter_mut().zip(frames) {
            *triad = frame.carried();
        }
    }

    /// What unknown `index` of the linear system is, in words: coordinates first, then constraint conditions.
    pub fn describe_unknown(&self, index: usize) -> String {
        if index < self.coordinates() {
            let node = self.describe_node(index / NODE);
            return match index % NODE {
                place @ 0..3 => format!("{node} (along {})", ["x", "y", "z"][place]),
                THETA => format!("{node} (turning about the beam)"),
                _ => format!("{node} (its slope)"),
            };
        }
        let mut row = self.coordinates();
        for joint in &self.joints {
            row += joint.rows();
            if index < row {
                return format!("joint {}", joint.name);
            }
        }
        String::from("an unknown")
    }

    /// A node's name: `arm.start`, `arm.node[3]`, `arm.end`.
    pub fn describe_node(&self, node: usize) -> String {
        for beam in &self.beams {
            if (beam.first_node..=beam.first_node + beam.elements).contains(&node) {
                let place = node - beam.first_node;
                return match place {
                    0 => format!("{}.start", beam.name),
                    _ if place == beam.elements => format!("{}.end", beam.name),
                    _ => format!("{}.node[{place}]", beam.name),
                };
            }
        }
        format!("node {node}")
    }

    /// The beam of element `number` and the element's number in it.
    pub fn beam_of(&self, number: usize) -> (&Beam, usize) {
        let after = self.beams.partition_point(|beam| beam.first_element <= number);
        let beam = &self.beams[after.saturating_sub(1)];
        (beam, number - beam.first_element)
    }

    /// What is not finite in the equations of `time` (s), in words.
    pub fn describe_not_finite(&self, time: f64) -> String {
        match self.loads.iter().find(|load| !load.at(time).is_finite()) {
            Some(load) => format!("the force or moment of load {}", load.name),
            None => String::from("a number in the equations"),
        }
    }

    /// Size of a correction of the coordinates, and the coordinate where it is largest: lengths over the machine's size, slopes and angles as they are.
    pub fn correction_size(&self, correction: &[f64]) -> (f64, usize) {
        let mut largest = (0.0, 0);
        for (index, value) in correction[..self.coordinates()].iter().enumerate() {
            let size = if index % NODE < P { value.abs() / self.size } else { value.abs() };
            // Not-a-number must win: `>` alone would let it pass.
            if size > largest.0 || size.is_nan() {
                largest = (size, index);
            }
        }
        largest
    }

    /// The first beam with truncated strain that is twisted beyond half of what that energy bears: its name, twist rate and bound, rad/m.
    pub fn twist_near_limit<'a>(&'a self, state: &'a State, snapshot: &mut Snapshot) -> Option<(&'a str, f64, f64)> {
        let mut limited = self.beams.iter().filter(|beam| beam.twist_limit.is_finite()).peekable();
        limited.peek()?;
        let configuration = snapshot.of(self, state);
        limited.find_map(|beam| {
            let rates = (beam.first_element..beam.first_element + beam.elements)
                .map(|number| evaluation(&configuration, number, None).largest_torsion().abs());
            let largest = rates.fold(0.0, f64::max);
            (largest > 0.5 * beam.twist_limit).then_some((beam.name.as_str(), largest, beam.twist_limit))
        })
    }

    /// Checks that no element twists further than the branch is safe for, from `state` to the coordinates `q`; `frames` is scratch memory.
    ///
    /// # Errors
    /// An element twists too far: an increment that large may end on another branch of equilibria.
    pub fn check_twist_change(
        &self,
        state: &State,
        q: &[f64],
        frames: &mut Vec<NodeFrame>,
        time: f64,
    ) -> Result<(), Error> {
        for (number, element) in self.elements.iter().enumerate() {
            let mut twist = |q: &[f64]| {
                let nodes = element.node..element.node + 2;
                self.frames(&q[NODE * nodes.start..NODE * nodes.end], &state.triads[nodes.clone()], frames);
                let own = &q[NODE * nodes.start..NODE * nodes.end];
                Kinematics::new(element, own, &frames[0], &frames[1], state.holonomy[number]).twist
            };
            if (twist(q) - twist(&state.q)).abs() > LARGEST_TWIST_CHANGE {
                let (beam, place) = self.beam_of(number);
                return Err(Error::Distorted { time, beam: beam.name.clone(), element: place, what: "twisted" });
            }
        }
        Ok(())
    }

    /// Checks what the element can bear (MECHANICS 2.6, 7.4) at the end of a step or increment.
    ///
    /// # Errors
    /// A tangent turned by more than `turn` rad, an element bent or twisted too far, a slope out of range.
    pub fn check(&self, c: &Configuration, triads: &[Triad], turn: f64, time: f64) -> Result<(), Error> {
        for (node, (frame, triad)) in c.frames.iter().zip(triads).enumerate() {
            let place = || self.describe_node(node);
            if !frame.stretch.is_finite() || !STRETCHES.contains(&frame.stretch) {
                return Err(Error::Stretched { time, place: place(), stretch: frame.stretch });
            }
            let angle = frame.t.cross(&triad.t).norm().atan2(frame.t.dot(&triad.t));
            if angle > turn {
                return Err(Error::Turned { time, place: place(), angle, limit: turn });
            }
        }
        for (number, element) in self.elements.iter().enumerate() {
            let [first, second] = c.element_frames(element);
            let distorted = |what| {
                let (beam, place) = self.beam_of(number);
                Err(Error::Distorted { time, beam: beam.name.clone(), element: place, what })
            };
            if 1.0 + first.t.dot(&second.t) < SMALLEST_COSINE {
                return distorted("bent");
            }
            let holonomy = Holonomy::new(first, second, c.holonomy[number]);
            if (holonomy.angle - c.holonomy[number]).abs() > LARGEST_TWIST_CHANGE {
                return distorted("twisted");
            }
            let (beam, place) = self.beam_of(number);
            if beam.twist_limit.is_finite() {
                let rate = evaluation(c, number, None).largest_torsion();
                if rate.abs() > beam.twist_limit {
                    let limit = beam.twist_limit;
                    return Err(Error::TwistBeyondTruncation {
                        time,
                        beam: beam.name.clone(),
                        element: place,
                        rate,
                        limit,
                    });
                }
            }
        }
        Ok(())
    }
}

/// Strains of element `number`.
pub fn evaluation<'a>(c: &Configuration<'a>, number: usize, increment: Option<&[f64]>) -> Evaluation<'a> {
    let element = &c.elements[number];
    let own = increment.map(|increment| &increment[NODE * element.node..NODE * (element.node + 2)]);
    Evaluation::new(element, c.element_q(element), own, c.element_frames(element), c.holonomy[number])
}

/// `target[start..] += values`.
fn add(target: &mut [f64], start: usize, values: &[f64]) {
    for (target, value) in target[start..start + values.len()].iter_mut().zip(values) {
        *target += value;
    }
}

/// Fills a column-major `rows × columns` block.
pub fn copy_corner(block: &mut [f64], rows: usize, columns: usize, value: impl Fn(usize, usize) -> f64) {
    debug_assert!(rows <= MARKER && columns <= MARKER);
    for column in 0..columns {
        for row in 0..rows {
            block[column * rows + row] = value(row, column);
        }
    }
}
