//! A point and a frame that joints, loads and sensors hold on to: on the ground, at a node, inside an element.
//!
//! Whatever holds on to a marker needs three things of it: its pose, how it moves with the coordinates (`motion`), and how
//! the generalized force of a wrench changes with the coordinates (`wrench_stiffness`).

use super::beam::coordinates::{NODE, P, R, SHAPE_PLACES, THETA, interpolate, vec3};
use super::beam::element::Element;
use super::beam::frame::NodeFrame;
use super::beam::kinematics::Kinematics;
use crate::math::rotation::{carry, half_turn, half_turn_by_first, half_turn_by_second, normal_projector};
use crate::math::{Mat3, Vec3, hermite, quadrature};
use nalgebra::SMatrix;
use std::ops::Range;

/// Most coordinates a marker can depend on: two nodes.
pub const MARKER: usize = 14;

/// A vector quantity by a marker's coordinates, 3×14; columns past the marker's own count are zero.
pub type ByCoordinates = SMatrix<f64, 3, MARKER>;
/// Stiffness in a marker's coordinates, 14×14.
pub type MarkerMatrix = SMatrix<f64, MARKER, MARKER>;

/// The machine at one instant: what every part computes from.
#[derive(Clone, Copy, Debug)]
pub struct Configuration<'a> {
    /// All coordinates.
    pub q: &'a [f64],
    /// Frames of all nodes at `q`.
    pub frames: &'a [NodeFrame],
    /// Holonomy angles of all elements at the last accepted state, rad.
    pub holonomy: &'a [f64],
    /// All elements.
    pub elements: &'a [Element],
}

impl<'a> Configuration<'a> {
    /// Coordinates (14) of an element.
    pub fn element_q(&self, element: &Element) -> &'a [f64] {
        &self.q[NODE * element.node..NODE * (element.node + 2)]
    }

    /// Frames of an element's two nodes.
    pub fn element_frames(&self, element: &Element) -> [&'a NodeFrame; 2] {
        [&self.frames[element.node], &self.frames[element.node + 1]]
    }

    /// In-element kinematics of element `number`.
    pub fn kinematics(&self, number: usize) -> Kinematics {
        let element = &self.elements[number];
        let [first, second] = self.element_frames(element);
        Kinematics::new(element, self.element_q(element), first, second, self.holonomy[number])
    }
}

/// Where a marker is and how it is turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Position, m.
    pub place: Vec3,
    /// Axes as columns.
    pub axes: Mat3,
}

/// How a marker moves with its coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// `∂place/∂q`, 3×14.
    pub place_q: ByCoordinates,
    /// `∂φ/∂q`, 3×14: the turn in space, rad.
    pub turn_q: ByCoordinates,
}

/// A point and a frame of the machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Marker {
    /// Fixed in space.
    Ground(Pose),
    /// Rigidly tied to a node.
    Node {
        /// Number of the node.
        node: usize,
        /// Place relative to the node, in section axes, m.
        offset: Vec3,
        /// Axes relative to the section axes.
        axes: Mat3,
    },
    /// A section inside an element, with the section's own axes.
    Section {
        /// Number of the element.
        element: usize,
        /// Place in the element, 0 to 1.
        xi: f64,
    },
}

impl Marker {
    /// The coordinates that the marker depends on.
    pub fn coordinates(&self, elements: &[Element]) -> Range<usize> {
        match self {
            Self::Ground(_) => 0..0,
            Self::Node { node, .. } => NODE * node..NODE * (node + 1),
            Self::Section { element, .. } => {
                let node = elements[*element].node;
                NODE * node..NODE * (node + 2)
            }
        }
    }

    /// Place and axes.
    pub fn pose(&self, c: &Configuration) -> Pose {
        match self {
            Self::Ground(pose) => *pose,
            Self::Node { node, offset, axes } => {
                let section = &c.frames[*node].section;
                Pose { place: vec3(c.q, NODE * node + R) + section * offset, axes: section * axes }
            }
            Self::Section { element, xi } => SectionPoint::new(c, *element, *xi).pose(c),
        }
    }

    /// Derivatives of place and turn by the marker's coordinates.
    pub fn motion(&self, c: &Configuration) -> Motion {
        match self {
            Self::Ground(_) => Motion { place_q: ByCoordinates::zeros(), turn_q: ByCoordinates::zeros() },
            Self::Node { node, offset, .. } => node_motion(&c.frames[*node], offset),
            Self::Section { element, xi } => SectionPoint::new(c, *element, *xi).motion(c),
        }
    }

    /// `∂(place_qᵀ f + turn_qᵀ m)/∂q`, 14×14, of a force (N) and a moment (N m) frozen in space.
    pub fn wrench_stiffness(&self, c: &Configuration, force: &Vec3, moment: &Vec3) -> MarkerMatrix {
        match self {
            Self::Ground(_) => MarkerMatrix::zeros(),
            Self::Node { node, offset, .. } => node_wrench_stiffness(&c.frames[*node], offset, force, moment),
            Self::Section { element, xi } => SectionPoint::new(c, *element, *xi).moment_stiffness(c, moment),
        }
    }
}

fn node_motion(frame: &NodeFrame, offset: &Vec3) -> Motion {
    let mut turn_q = ByCoordinates::zeros();
    turn_q.fixed_columns_mut::<3>(P).copy_from(&frame.turn_p());
    turn_q.set_column(THETA, &frame.t);
    let arm = frame.section * offset;
    let mut place_q = -arm.cross_matrix() * turn_q;
    place_q.fixed_columns_mut::<3>(R).copy_from(&Mat3::identity());
    Motion { place_q, turn_q }
}

fn node_wrench_stiffness(frame: &NodeFrame, offset: &Vec3, force: &Vec3, moment: &Vec3) -> MarkerMatrix {
    let arm = frame.section * offset;
    let (by_p, along_p) = frame.moment_force_p(&(moment + arm.cross(force)));
    let mut sum = MarkerMatrix::zeros();
    sum.fixed_view_mut::<3, 3>(P, P).copy_from(&by_p);
    sum.fixed_view_mut::<1, 3>(THETA, P).copy_from(&along_p.transpose());
    // The arm turns: d(a × f) = (dφ × a) × f = (a fᵀ − (a·f) I) dφ.
    let turn_q = node_motion(frame, offset).turn_q;
    sum + turn_q.transpose() * (arm * force.transpose() - Mat3::identity() * arm.dot(force)) * turn_q
}

/// A section inside an element: MECHANICS 2.13, 2.17.
struct SectionPoint {
    element: usize,
    xi: f64,
    kinematics: Kinematics,
    shape: [f64; 4],
    shape_x: [f64; 4],
    /// `l A_h(ξ)`, m.
    collocation: [f64; 3],
    stretch: f64,
    t: Vec3,
    /// `kb(t_0, t)`.
    k: Vec3,
}

impl SectionPoint {
    fn new(c: &Configuration, number: usize, xi: f64) -> Self {
        let element = &c.elements[number];
        let shape_x = hermite::shape_x(xi, element.length);
        let p = interpolate(&shape_x, c.element_q(element));
        let stretch = p.norm();
        let t = p / stretch;
        Self {
            element: number,
            xi,
            kinematics: c.kinematics(number),
            shape: hermite::shape(xi, element.length),
            shape_x,
            collocation: quadrature::collocation(xi).map(|a| a * element.length),
            stretch,
            t,
            k: half_turn(&c.frames[element.node].t, &t),
        }
    }

    fn pose(&self, c: &Configuration) -> Pose {
        let element = &c.elements[self.element];
        let q = c.element_q(element);
        let first = &c.frames[element.node];
        let u = carry(&first.t, &self.t, &first.u);
        let v = self.t.cross(&u);
        let (sin, cos) = self.kinematics.alpha_at(q, self.xi, &self.collocation).sin_cos();
        let axes = Mat3::from_columns(&[self.t, u * cos + v * sin, v * cos - u * sin]);
        Pose { place: interpolate(&self.shape, q), axes }
    }

    /// Spin about the tangent by the coordinates, 1×14 as a column: `dα + s_0·dt_0 − kb(t_0, t)·(dt_0 + dt)` (2.17).
    fn spin_q(&self, c: &Configuration) -> nalgebra::SVector<f64, MARKER> {
        let element = &c.elements[self.element];
        let [first, second] = c.element_frames(element);
        let points = self.kinematics.point_gradients(element);
        let mut spin = self.kinematics.twist_gradient(element, first, second, &points) * self.xi
            - self.kinematics.rate_gradient(&self.collocation, &points);
        spin[THETA] += 1.0;
        let mut slope = spin.fixed_rows_mut::<3>(P);
        slope -= (first.k + self.k) / first.stretch;
        for (weight, place) in self.shape_x.iter().zip(SHAPE_PLACES) {
            let mut rows = spin.fixed_rows_mut::<3>(place);
            rows -= self.k * (weight / self.stretch);
        }
        spin
    }

    fn motion(&self, c: &Configuration) -> Motion {
        let mut place_q = ByCoordinates::zeros();
        let mut turn_q = self.t * self.spin_q(c).transpose();
        let tilt = self.t.cross_matrix() / self.stretch;
        for (a, place) in SHAPE_PLACES.into_iter().enumerate() {
            place_q.fixed_columns_mut::<3>(place).copy_from(&(Mat3::identity() * self.shape[a]));
            let mut columns = turn_q.fixed_columns_mut::<3>(place);
            columns += tilt * self.shape_x[a];
        }
        Motion { place_q, turn_q }
    }

    fn moment_stiffness(&self, c: &Configuration, moment: &Vec3) -> MarkerMatrix {
        let element = &c.elements[self.element];
        let [first, second] = c.element_frames(element);
        let along = moment.dot(&self.t);
        let t_p = normal_projector(&self.t) / self.stretch;
        let tilt = moment.cross(&self.t) / self.stretch;
        let tilt_p = (moment.cross_matrix() * t_p - tilt * self.t.transpose()) / self.stretch;
        let mut sum = MarkerMatrix::zeros();
        // Second derivatives of the spin's exact part, α.
        for (g, point) in element.bending.iter().enumerate() {
            let rate = along * (self.xi * element.rate_weights[g] - self.collocation[g]);
            self.kinematics.base.add_hessian(
                &mut sum,
                first,
                &self.kinematics.points[g],
                &[0.0, 0.0, rate],
                &point.shape_x,
                &point.shape_xx,
            );
        }
        self.kinematics.holonomy.add_hessian(&mut sum, first, second, along * self.xi);
        // Its inexact part, −(k_0 + kb)·dp_0/|p_0| − kb·dp/|p|.
        let k_t0 = half_turn_by_first(&first.t, &self.t, &self.k);
        let k_t = half_turn_by_second(&first.t, &self.t, &self.k);
        let (l0, l) = (first.stretch, self.stretch);
        let mut base = sum.fixed_view_mut::<3, 3>(P, P);
        base -= ((first.k_t + k_t0) * first.t_p() / l0 - (first.k + self.k) * first.t.transpose() / (l0 * l0)) * along;
        let base_by_p = k_t * t_p * (along / l0);
        let p_by_base = k_t0 * first.t_p() * (along / l);
        let p_by_p = tilt_p - (k_t * t_p / l - self.k * self.t.transpose() / (l * l)) * along;
        for (a, row) in SHAPE_PLACES.into_iter().enumerate() {
            let mut view = sum.fixed_view_mut::<3, 3>(P, row);
            view -= base_by_p * self.shape_x[a];
            let mut view = sum.fixed_view_mut::<3, 3>(row, P);
            view -= p_by_base * self.shape_x[a];
            for (b, column) in SHAPE_PLACES.into_iter().enumerate() {
                let mut view = sum.fixed_view_mut::<3, 3>(row, column);
                view += p_by_p * (self.shape_x[a] * self.shape_x[b]);
            }
        }
        let spin = self.spin_q(c);
        let across = t_p * moment;
        for (weight, place) in self.shape_x.iter().zip(SHAPE_PLACES) {
            let mut columns = sum.fixed_columns_mut::<3>(place);
            columns += spin * across.transpose() * *weight;
        }
        sum
    }
}
