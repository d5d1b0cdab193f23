//! Friction of a contact: an elastic sticking displacement in each cell of an element, up to the limit at which the
//! surfaces slide (MECHANICS 7.6).
//!
//! A cell has one force, at the center of its pressure. What it remembers is the displacement in the axes of the
//! carrier. Both surfaces slip by `Δs = P (Δy' + r n × Δφ)`: the surface of the beam is its radius away from its axis
//! and turns with its section, so that friction turns the section too. A step takes the force half a step behind its
//! end, as dry friction of joints does.

use super::pieces::CELLS;
use super::touch::{Arms, Touch, arm};
use super::{Contact, Ground};
use crate::math::{Mat3, Vec3, hermite};
use crate::mechanics::beam::ancf14::coordinates::{ELEMENT, SHAPE_PLACES, interpolate};
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::body::kinematics::{self, BODY};
use crate::mechanics::geometry::pose::{Pose, angular_velocity, axis_place};
use crate::mechanics::marker::configuration::{Configuration, Passage};
use nalgebra::SMatrix;

/// Numbers that an element remembers: a displacement for each of its cells.
pub const REMEMBERED: usize = 3 * CELLS;

/// Share of the largest displacement from which on both surfaces slide: the normal that it is seen along has turned
/// since it was set.
const SLIDING: f64 = 1.0 - 1e-3;

/// Dry friction of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// Force over pressure while the surfaces slide, 1: the larger one of both directions.
    pub coefficient: f64,
    /// The coefficients along and across the beam over the larger one: limits are an ellipse.
    pub shares: [f64; 2],
    /// Force per length and displacement while they stick, N/m².
    pub stiffness: f64,
    /// The first number that it remembers.
    pub memory: usize,
}

/// The pressure in a cell.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pressing {
    /// Force, N.
    force: f64,
    /// The force times the position where it acts, N.
    moment: f64,
    /// Integral of the square of the force per length, N²/m.
    squares: f64,
    /// Derivative of the force with respect to `y'`, over a step at its end, N/m.
    by_position: Vec3,
}

/// The pressure in each cell of an element.
pub type Cells = [Pressing; CELLS];

impl Pressing {
    /// Adds a point.
    pub fn add(cells: &mut Cells, touch: &Touch) {
        let own = &mut cells[touch.cell];
        own.force += touch.pressing;
        own.moment += touch.pressing * touch.xi;
        own.squares += touch.pressing * touch.pressing / touch.length;
        own.by_position += touch.by_position;
    }

    /// The length that the force is spread over, m: the whole length of a force that is the same everywhere. Where the
    /// force is small, it does not count: the length changes without a jump while parts of the element lift off.
    fn length(&self) -> f64 {
        self.force * self.force / self.squares
    }
}

/// A vector in the axes of the carrier by the coordinates of an element.
pub type ByElement = SMatrix<f64, 3, ELEMENT>;
/// The same by those of a body.
pub type ByBody = SMatrix<f64, 3, BODY>;

/// Friction of a cell.
#[derive(Clone, Debug)]
pub struct Grip {
    /// The cell.
    pub cell: usize,
    /// Position in the element, 0 to 1.
    pub xi: f64,
    /// Friction in the axes of the carrier, against the slip, N.
    pub force: Vec3,
    /// Its derivative with respect to the slip, at the end of a step, N/m.
    pub by_slip: Mat3,
    /// Its derivative with respect to `y'` by the pressure, N/m.
    pub by_position: Mat3,
    /// How the slip depends on the coordinates of the element.
    pub by_element: ByElement,
    /// How `y'` does.
    pub position_by_element: ByElement,
    /// How the slip depends on the coordinates of the body that carries the surface.
    pub by_body: ByBody,
    /// How `y'` does.
    pub position_by_body: ByBody,
    /// Slip since the last accepted state, m.
    pub slip: Vec3,
    /// The part of it by moving frames, m.
    pub by_frame: Vec3,
    /// The displacement after it, m.
    pub displaced: Vec3,
    /// Whether the surfaces slide.
    pub slides: bool,
    /// Axes of the carrier, for the force in space.
    pub axes: Mat3,
    /// Lever from the axis of the beam to where the surfaces touch, in the axes of the carrier, m.
    pub lever: Vec3,
}

/// The limit of friction: a circle, or an ellipse with the metric in which it is one.
#[derive(Clone, Copy, Debug)]
struct Limit {
    size: f64,
    metric: Option<Mat3>,
}

impl Limit {
    /// The size of a vector over that of the limit, times the limit.
    fn size_of(&self, vector: &Vec3) -> f64 {
        match self.metric {
            None => vector.norm(),
            Some(metric) => vector.dot(&(metric * vector)).sqrt(),
        }
    }

    /// A vector that is cut off at the limit, with its derivatives with respect to the vector and to the limit.
    fn cut(&self, vector: &Vec3) -> (Vec3, Mat3, Vec3) {
        let Some(metric) = self.metric else { return cut(vector, self.size) };
        let size = self.size_of(vector);
        if size <= self.size || size == 0.0 {
            return (*vector, Mat3::identity(), Vec3::zeros());
        }
        let along = vector / size;
        let across = Mat3::identity() - along * (metric * along).transpose();
        (along * self.size, across * (self.size / size), along)
    }
}

impl Friction {
    /// The metric of the ellipse of a beam along `tangent`; none: the limit is a circle.
    fn metric(&self, tangent: &Vec3, normal: &Vec3) -> Option<Mat3> {
        if self.shares[0] == self.shares[1] {
            return None;
        }
        let along = (tangent - normal * normal.dot(tangent)).normalize();
        let [by_along, by_across] = self.shares.map(|share| 1.0 / (share * share));
        Some(Mat3::identity() * by_across + along * along.transpose() * (by_along - by_across))
    }
}

/// A vector that is cut off at `limit`, with its derivatives with respect to the vector and to the limit.
fn cut(vector: &Vec3, limit: f64) -> (Vec3, Mat3, Vec3) {
    let size = vector.norm();
    if size <= limit || size == 0.0 {
        return (*vector, Mat3::identity(), Vec3::zeros());
    }
    let along = vector / size;
    let across = Mat3::identity() - along * along.transpose();
    (along * limit, across * (limit / size), along)
}

impl Contact {
    /// Calls `take` with the friction of each cell of `element`, number `number` of the mesh, in which `cells` press.
    pub fn each_grip(
        &self,
        number: usize,
        element: &AnyElement,
        c: &Configuration,
        passage: &Passage,
        cells: &Cells,
        mut take: impl FnMut(&Grip),
    ) {
        let Some(friction) = self.friction.filter(|own| own.coefficient > 0.0) else { return };
        for (cell, pressing) in cells.iter().enumerate().filter(|(_, pressing)| pressing.force > 0.0) {
            let first = friction.memory + REMEMBERED * (number - self.elements.start) + 3 * cell;
            let before = Vec3::new(c.memory[first], c.memory[first + 1], c.memory[first + 2]);
            take(&self.grip(friction, (cell, pressing, before), element, c, passage));
        }
    }

    fn grip(
        &self,
        friction: Friction,
        (cell, pressing, before): (usize, &Pressing, Vec3),
        element: &AnyElement,
        c: &Configuration,
        passage: &Passage,
    ) -> Grip {
        let xi = pressing.moment / pressing.force;
        // Before and after: of a step its ends.
        let earlier = c.accepted();
        let ends = match passage {
            Passage::Step(step) => [step.start, step.end],
            _ => [&earlier, c],
        };
        let carriers = ends.map(|end| self.carrier(end));
        let (seat, axes) = self.seat();
        let weights = hermite::shape(xi, element.length());
        let from = [0, 1].map(|end| arm(element, &weights, &carriers[end], ends[end]));
        let whole = [0, 1].map(|end| carriers[end].axes.tr_mul(&from[end]));
        let points = whole.map(|point| axes.tr_mul(&(point - seat)));
        let arms = match passage {
            Passage::Step(_) => Arms::over(carriers, from),
            _ => Arms::at(carriers[1], from[1]),
        };
        // An equilibrium is read where it ends: with another normal it would have another force.
        let seen = match passage {
            Passage::Step(_) => (points[0] + points[1]) * 0.5,
            _ => points[1],
        };
        let normal = axes * self.surface.shape.normal(&seen).normalize();
        let across = Mat3::identity() - normal * normal.transpose();
        // The surface of the beam is on the other side of its axis.
        let lever = normal * -self.lever();
        let rows = self.rows(element, c, xi, &arms, &across, &lever);
        let q = [0, 1].map(|end| &ends[end].beams.q[element.coordinates()]);
        let change = |number: usize| q[1][number] - q[0][number];
        let turned = sum(&rows.turn_by_element, change);
        let body = self.body();
        let body_turn = match body {
            Some(start) => {
                sum(&rows.turn_by_body, |number| ends[1].beams.q[start + number] - ends[0].beams.q[start + number])
            }
            None => self.carrier_turn(&carriers, &arms),
        };
        let moved = whole[1] - whole[0];
        let slip = across * (moved + (turned - body_turn).cross(&lever));
        // Half a step ahead of the end, with the rate there.
        let (rate, is_step) = match passage {
            Passage::Step(step) => {
                (self.slip_rate(&rows, element, ends[0], step.velocity, &arms, &lever, &across), true)
            }
            _ => (Vec3::zeros(), false),
        };
        let stiffness = friction.stiffness * pressing.length();
        // The tangent of the last state has no derivative.
        let tangent = interpolate(&hermite::shape_x(xi, element.length()), &ends[0].beams.q[element.coordinates()]);
        let limit = Limit {
            size: friction.coefficient * pressing.force,
            metric: friction.metric(&carriers[0].axes.tr_mul(&tangent), &normal),
        };
        let stuck = across * before + slip;
        let (mut force, first, first_by_limit) = limit.cut(&(stuck * stiffness));
        let (displaced, slides) = (force / stiffness, limit.size_of(&force) >= SLIDING * limit.size);
        let mut by_slip = first * across * stiffness;
        let mut by_limit = first_by_limit;
        if let (true, Passage::Step(step)) = (is_step, passage) {
            let further = slip - rate * (0.5 * step.duration);
            let (ahead, second, second_by_limit) = limit.cut(&(force + further * stiffness));
            force = ahead;
            by_slip = second * (first + Mat3::identity()) * across * stiffness;
            by_limit = second * by_limit + second_by_limit;
        }
        let by_position = by_limit * (pressing.by_position * friction.coefficient).transpose();
        let by_frame = match body {
            Some(_) => Vec3::zeros(),
            None => across * (carrier_move(&carriers, &arms) - body_turn.cross(&lever)),
        };
        Grip {
            cell,
            xi,
            force,
            by_slip,
            by_position,
            by_element: rows.by_element,
            position_by_element: rows.position_by_element,
            by_body: rows.by_body,
            position_by_body: rows.position_by_body,
            slip,
            by_frame,
            displaced,
            slides,
            axes: arms.axes,
            lever,
        }
    }

    /// Distance from the axis of the beam to where friction acts, m.
    fn lever(&self) -> f64 {
        match self.ground {
            Ground::Rigid => self.radius,
            Ground::Seabed { .. } => 0.0,
        }
    }

    /// How slip and position depend on coordinates.
    fn rows(&self, element: &AnyElement, c: &Configuration, xi: f64, arms: &Arms, across: &Mat3, lever: &Vec3) -> Rows {
        let weights = hermite::shape(xi, element.length());
        let into = arms.axes.transpose();
        let mut rows = Rows::default();
        for (weight, start) in weights.iter().zip(SHAPE_PLACES) {
            rows.position_by_element.fixed_columns_mut::<3>(start).copy_from(&(into * *weight));
        }
        if self.lever() > 0.0 {
            let turn_q = element.section_jacobian(&c.beams, xi).turn_q;
            rows.turn_by_element = into * turn_q.fixed_columns::<ELEMENT>(0);
        }
        // (φ × lever) = −lever × φ.
        let by_turn = -lever.cross_matrix();
        rows.by_element = across * (rows.position_by_element + by_turn * rows.turn_by_element);
        if let Some(start) = self.body() {
            let directors = kinematics::pose(c.beams.q, start);
            rows.position_by_body.fixed_columns_mut::<3>(0).copy_from(&-into);
            for director in 0..3 {
                let point = axis_place(director);
                let mut turn = rows.turn_by_body.fixed_columns_mut::<3>(point);
                turn.copy_from(&(into * directors.axis(director).cross_matrix() * 0.5));
                let mut own = rows.position_by_body.fixed_rows_mut::<1>(director);
                own.fixed_columns_mut::<3>(point).copy_from(&arms.arm.transpose());
            }
            rows.by_body = across * (rows.position_by_body - by_turn * rows.turn_by_body);
        }
        rows
    }

    /// Turn of a moving frame between two poses, in its axes, rad.
    fn carrier_turn(&self, carriers: &[Pose; 2], arms: &Arms) -> Vec3 {
        let mean = Pose { place: Vec3::zeros(), axes: arms.axes };
        let change = Pose { place: Vec3::zeros(), axes: carriers[1].axes - carriers[0].axes };
        arms.axes.tr_mul(&angular_velocity(&mean, &change))
    }

    /// Rate of the slip at the start of a step, m/s.
    #[allow(clippy::too_many_arguments, reason = "what a grip is made of")]
    fn slip_rate(
        &self,
        rows: &Rows,
        element: &AnyElement,
        start: &Configuration,
        velocity: &[f64],
        arms: &Arms,
        lever: &Vec3,
        across: &Mat3,
    ) -> Vec3 {
        let own = &velocity[element.coordinates()];
        let of_element = sum(&rows.by_element, |number| own[number]);
        match self.body() {
            Some(body) => of_element + sum(&rows.by_body, |number| velocity[body + number]),
            None => {
                let moving = self.surface.marker.bare().pose_t(start)[0];
                let carrier = self.carrier(start);
                let turn = carrier.axes.tr_mul(&angular_velocity(&carrier, &moving));
                let moved = -carrier.axes.tr_mul(&moving.place) + moving.axes.tr_mul(&arms.arm);
                of_element + across * (moved - turn.cross(lever))
            }
        }
    }
}

/// How slip, position and turn depend on coordinates, in the axes of the carrier.
#[derive(Clone, Copy, Debug, Default)]
struct Rows {
    by_element: ByElement,
    position_by_element: ByElement,
    turn_by_element: ByElement,
    by_body: ByBody,
    position_by_body: ByBody,
    turn_by_body: ByBody,
}

/// The part of `Δy'` by what the carrier moves, m.
fn carrier_move(carriers: &[Pose; 2], arms: &Arms) -> Vec3 {
    let axes = carriers[1].axes - carriers[0].axes;
    axes.tr_mul(&arms.arm) - arms.axes.tr_mul(&(carriers[1].place - carriers[0].place))
}

fn sum<const COLUMNS: usize>(rows: &SMatrix<f64, 3, COLUMNS>, value: impl Fn(usize) -> f64) -> Vec3 {
    (0..COLUMNS).fold(Vec3::zeros(), |sum, number| sum + rows.column(number) * value(number))
}

impl Grip {
    /// Derivative of the friction with respect to the coordinates of the element at the end.
    pub fn by_end(&self) -> ByElement {
        self.by_slip * self.by_element + self.by_position * self.position_by_element
    }

    /// The same with respect to the coordinates of the body.
    pub fn by_body_end(&self) -> ByBody {
        self.by_slip * self.by_body + self.by_position * self.position_by_body
    }

    /// Friction on the beam at its axis, in global axes: force, N, and moment, N m.
    pub fn in_space(&self) -> [Vec3; 2] {
        [self.axes * -self.force, self.axes * -self.lever.cross(&self.force)]
    }
}
