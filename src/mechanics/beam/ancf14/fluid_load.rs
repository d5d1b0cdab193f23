//! Forces of a fluid along an element (MECHANICS 11): buoyancy, drag, and the inertia of the fluid around it, per
//! undeformed length, at four Gauss points of each part that is wet.
//!
//! `f = s [−ρA g + ρA u̇ + b_n (u̇ − v̇)_n + b_t (u̇ − v̇)_t + d_n |w_n| w_n + d_t |w_t| w_t]`, with the wet share `s`,
//! the velocity `v` of the axis, that of the fluid `u`, `w = u − v`, and parts across (`n`) and along (`t`) the
//! tangent.

use super::coordinates::{ELEMENT, SHAPE_PLACES};
use super::element::Element;
use crate::math::quadrature::FOUR_POINTS;
use crate::math::vectors::{add_vec3, vec3};
use crate::math::{Mat3, Vec3, hermite};
use crate::mechanics::beam::balance::Acting;
use crate::mechanics::beam::configuration::{BeamConfiguration, Passage};
use crate::mechanics::fluid::flow::{Flow, Seen};
use crate::mechanics::fluid::medium::Medium;
use crate::mechanics::fluid::wet_section::{WetSection, WetSections};
use crate::mechanics::fluid::wet_share::{AxisPoint, WetPoint, each_wet_point};
use crate::mechanics::input::excitation::Wrench;

/// Speed below all that matters, m/s: the direction of a flow that is at rest needs no case of its own.
const STILL: f64 = 1e-30;

/// `X_a` of an element, or their derivatives by time.
type Shapes = [Vec3; 4];

/// The fluid as an element sees it.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings<'a> {
    /// The fluid.
    pub medium: &'a Medium,
    /// The element's sections.
    pub sections: &'a WetSections,
    /// Gravity, m/s².
    pub gravity: Vec3,
    /// Time, s.
    pub time: f64,
    /// Share of the drag that acts, 0 to 1: less than 1 on the way to an equilibrium.
    pub share: f64,
    /// The fluid at the four points of the rule, where it is looked at once a step.
    pub seen: Option<&'a [Seen; 4]>,
    /// Whether it has no waves: in equilibria.
    pub is_still: bool,
}

impl Surroundings<'_> {
    /// The height of the surface at `xi` in an element, which is at `position`.
    fn height(&self, xi: f64, position: &Vec3) -> f64 {
        match self.seen {
            Some(points) => points.iter().zip(cubic(xi)).map(|(own, weight)| own.height * weight).sum(),
            None if self.is_still => self.medium.still(position, self.time).height,
            None => self.medium.height(position, self.time),
        }
    }

    /// The motion of the fluid there.
    fn flow(&self, xi: f64, position: &Vec3) -> Flow {
        match self.seen {
            Some(points) => Seen::between(points, &cubic(xi)).flow,
            None if self.is_still => self.medium.still(position, self.time).flow,
            None => self.medium.flow(position, self.time),
        }
    }
}

/// Values at `xi` of the cubic Lagrange polynomials on the four points.
fn cubic(xi: f64) -> [f64; 4] {
    std::array::from_fn(|k| {
        let others = FOUR_POINTS.iter().enumerate().filter(|(other, _)| *other != k);
        others.map(|(_, point)| (xi - point) / (FOUR_POINTS[k] - point)).product()
    })
}

/// How an element moves where the forces are taken.
#[derive(Clone, Copy, Debug)]
pub struct Moving {
    q: Shapes,
    velocity: Shapes,
    acceleration: Shapes,
}

/// Factors of velocities and accelerations in the derivative of the forces with respect to the coordinates, 1/s and
/// 1/s².
#[derive(Clone, Copy, Debug, Default)]
pub struct ByCoordinates {
    /// 1/s.
    pub velocity: f64,
    /// 1/s².
    pub acceleration: f64,
}

impl ByCoordinates {
    /// As `passage` says; over a step for twice the derivative with respect to the coordinates at its end.
    pub fn of(passage: &Passage) -> Self {
        match passage {
            Passage::Rest | Passage::Corrected(_) => Self::default(),
            Passage::Instant { velocity_by_q, .. } => Self { velocity: *velocity_by_q, acceleration: 0.0 },
            Passage::Step(step) => {
                Self { velocity: 2.0 / step.duration, acceleration: 4.0 / (step.duration * step.duration) }
            }
        }
    }
}

impl Moving {
    /// `element` as it passes through `c`. The acceleration over a step is the change of the velocity in its first half
    /// over that time; at an instant there is none, as the mass matrix has it.
    pub fn new(element: &Element, c: &BeamConfiguration, passage: &Passage) -> Self {
        let none = [Vec3::zeros(); 4];
        let q = shapes(element.own(c.q));
        match passage {
            Passage::Rest | Passage::Corrected(_) => Self { q, velocity: none, acceleration: none },
            Passage::Instant { velocity, .. } => {
                Self { q, velocity: shapes(element.own(velocity)), acceleration: none }
            }
            Passage::Step(step) => {
                let velocity = shapes(element.own(step.increment)).map(|own| own / step.duration);
                let before = shapes(element.own(step.velocity));
                let lead = if step.velocity_lead.is_empty() { none } else { shapes(element.own(step.velocity_lead)) };
                let half = 2.0 / step.duration;
                let acceleration = std::array::from_fn(|a| (velocity[a] - before[a] - lead[a]) * half);
                Self { q, velocity, acceleration }
            }
        }
    }

    /// The same with these velocities and accelerations of all coordinates.
    pub fn with(element: &Element, q: &[f64], velocity: &[f64], acceleration: &[f64]) -> Self {
        let [q, velocity, acceleration] = [q, velocity, acceleration].map(|all| shapes(element.own(all)));
        Self { q, velocity, acceleration }
    }

    /// The same at rest.
    pub fn at_rest(element: &Element, q: &[f64]) -> Self {
        let none = [Vec3::zeros(); 4];
        Self { q: shapes(element.own(q)), velocity: none, acceleration: none }
    }
}

/// The fluid at a point of the axis.
struct At {
    shape: [f64; 4],
    shape_x: [f64; 4],
    /// Length that the point stands for, m.
    length: f64,
    wet: WetPoint,
    section: WetSection,
    position: Vec3,
    tangent: Vec3,
    by_stretch: f64,
    /// Velocity of the fluid relative to the beam, m/s, and its acceleration, and that relative to the beam, m/s².
    relative: Vec3,
    acceleration: Vec3,
    relative_acceleration: Vec3,
}

impl At {
    /// Speed across the beam, the velocity across, and the velocity along it.
    fn flow(&self) -> (f64, Vec3, f64) {
        let along = self.relative.dot(&self.tangent);
        let across = self.relative - self.tangent * along;
        (across.norm() + STILL, across, along)
    }

    /// The force per length of a section that is all wet, N/m.
    fn force(&self, fluid: &Surroundings) -> Vec3 {
        let (speed, across, along) = self.flow();
        let WetSection { displaced, drag: [drag_n, drag_t], added: [added_n, added_t], .. } = self.section;
        let drag = across * (drag_n * speed) + self.tangent * (drag_t * along.abs() * along);
        let surge = self.relative_acceleration.dot(&self.tangent) * (added_t - added_n);
        let inertia = self.acceleration * displaced + self.relative_acceleration * added_n + self.tangent * surge;
        drag * fluid.share + inertia - fluid.gravity * displaced
    }

    /// The drag per length, N/m.
    fn drag(&self) -> Vec3 {
        let (speed, across, along) = self.flow();
        let [drag_n, drag_t] = self.section.drag;
        (across * (drag_n * speed) + self.tangent * (drag_t * along.abs() * along)) * self.wet.share
    }

    /// The added mass per length, kg/m.
    fn added_mass(&self) -> Mat3 {
        let [added_n, added_t] = self.section.added;
        let along = self.tangent * self.tangent.transpose() * (added_t - added_n);
        (along + Mat3::identity() * added_n) * self.wet.share
    }

    /// Derivative of the drag with respect to the velocity of the beam, N s/m².
    fn force_v(&self, fluid: &Surroundings) -> Mat3 {
        let (speed, across, along) = self.flow();
        let [drag_n, drag_t] = self.section.drag;
        let t = self.tangent * self.tangent.transpose();
        let normal = (Mat3::identity() - t) * speed + across * across.transpose() / speed;
        (normal * drag_n + t * (2.0 * drag_t * along.abs())) * (-self.wet.share * fluid.share)
    }

    /// Derivative of the force with respect to the slope of the axis, N/m.
    fn force_p(&self, fluid: &Surroundings) -> Mat3 {
        let (speed, across, along) = self.flow();
        let (one, t) = (Mat3::identity(), self.tangent);
        let [drag_n, drag_t] = self.section.drag;
        let bend = one * speed + across * across.transpose() / speed;
        let normal = bend * -along - t * self.relative.transpose() * speed;
        let tangential = t * self.relative.transpose() * (2.0 * along.abs()) + one * (along.abs() * along);
        let [added_n, added_t] = self.section.added;
        let surge = self.relative_acceleration;
        let inertia = (one * surge.dot(&t) + t * surge.transpose()) * (added_t - added_n);
        let force_t = (normal * drag_n + tangential * drag_t) * fluid.share + inertia;
        force_t * (one - t * t.transpose()) * (self.wet.share * self.by_stretch)
    }
}

impl Element {
    /// Its axis at `xi` as the surface sees it.
    fn axis_in_fluid(&self, fluid: &Surroundings, moving: &Moving, xi: f64) -> AxisPoint {
        let (shape, shape_x) = (hermite::shape(xi, self.length), hermite::shape_x(xi, self.length));
        let (position, slope) = (weighted(&shape, &moving.q), weighted(&shape_x, &moving.q));
        AxisPoint {
            height: fluid.medium.side.sign() * (position.z - fluid.height(xi, &position)),
            rise: slope.z / slope.norm().max(f64::MIN_POSITIVE),
            radius: fluid.sections.at(xi).radius,
        }
    }

    /// The fluid at a point of its axis.
    fn fluid_at(&self, fluid: &Surroundings, moving: &Moving, wet: WetPoint) -> At {
        let (shape, shape_x) = (hermite::shape(wet.xi, self.length), hermite::shape_x(wet.xi, self.length));
        let (position, slope) = (weighted(&shape, &moving.q), weighted(&shape_x, &moving.q));
        let stretch = slope.norm().max(f64::MIN_POSITIVE);
        let Flow { velocity, acceleration } = fluid.flow(wet.xi, &position);
        At {
            length: wet.weight * self.length,
            section: fluid.sections.at(wet.xi),
            position,
            tangent: slope / stretch,
            by_stretch: 1.0 / stretch,
            relative: velocity - weighted(&shape, &moving.velocity),
            acceleration,
            relative_acceleration: acceleration - weighted(&shape, &moving.acceleration),
            shape,
            shape_x,
            wet,
        }
    }

    /// Sets `seen` to the fluid at its four points at the coordinates `q` of the system.
    pub fn look(&self, medium: &Medium, q: &[f64], time: f64, seen: &mut [Seen; 4]) {
        let own = shapes(self.own(q));
        for (seen, xi) in seen.iter_mut().zip(FOUR_POINTS) {
            *seen = medium.seen(&weighted(&hermite::shape(xi, self.length), &own), time);
        }
    }

    /// Calls `take` with the wet points up to `end`, 0 to 1.
    fn each_wet(&self, fluid: &Surroundings, moving: &Moving, end: f64, mut take: impl FnMut(&At)) {
        let axis = |xi: f64| self.axis_in_fluid(fluid, moving, xi);
        each_wet_point(end, axis, |wet| take(&self.fluid_at(fluid, moving, wet)));
    }

    /// Adds `factor` times the generalized force of the fluid to `forces`, its own.
    pub fn add_fluid(&self, fluid: &Surroundings, moving: &Moving, factor: f64, forces: &mut [f64]) {
        self.each_wet(fluid, moving, 1.0, |at| {
            let force = at.force(fluid) * (factor * at.length * at.wet.share);
            add_spread(&at.shape, &force, forces);
        });
    }

    /// [`Self::add_fluid`], and adds `scale` times its derivative with respect to the coordinates to the column-major
    /// `block`, 14×14.
    pub fn add_fluid_and_tangent(
        &self,
        fluid: &Surroundings,
        (moving, by): (&Moving, ByCoordinates),
        [factor, scale]: [f64; 2],
        forces: &mut [f64],
        block: &mut [f64],
    ) {
        self.each_wet(fluid, moving, 1.0, |at| {
            let whole = at.force(fluid);
            add_spread(&at.shape, &(whole * (factor * at.length * at.wet.share)), forces);
            let mut by_position = at.force_v(fluid) * by.velocity - at.added_mass() * by.acceleration;
            let share_z = fluid.medium.side.sign() * at.wet.share_z;
            by_position.set_column(2, &(by_position.column(2) + whole * share_z));
            let scale = scale * at.length;
            add_products(
                &at.shape,
                [&at.shape, &at.shape_x],
                [&(by_position * scale), &(at.force_p(fluid) * scale)],
                block,
            );
        });
    }

    /// Adds `factor` times the added mass matrix to the column-major `block`, 14×14.
    pub fn add_added_mass(&self, fluid: &Surroundings, moving: &Moving, factor: f64, block: &mut [f64]) {
        self.each_wet(fluid, moving, 1.0, |at| {
            add_products(&at.shape, [&at.shape], [&(at.added_mass() * (factor * at.length))], block);
        });
    }

    /// Adds the product of the added mass matrix with `vector` to `product`, its own of the system's; returns
    /// `vectorᵀ M_a vector`.
    pub fn add_added_mass_times(
        &self,
        fluid: &Surroundings,
        moving: &Moving,
        vector: &[f64],
        product: &mut [f64],
    ) -> f64 {
        let (vector, mut form) = (shapes(self.own(vector)), 0.0);
        self.each_wet(fluid, moving, 1.0, |at| {
            let value = weighted(&at.shape, &vector);
            let momentum = at.added_mass() * value * at.length;
            form += momentum.dot(&value);
            add_spread(&at.shape, &momentum, product);
        });
        form
    }

    /// Adds `factor` times the derivative of the forces with respect to the velocities to the column-major `block`,
    /// 14×14.
    pub fn add_fluid_damping(&self, fluid: &Surroundings, moving: &Moving, factor: f64, block: &mut [f64]) {
        self.each_wet(fluid, moving, 1.0, |at| {
            add_products(&at.shape, [&at.shape], [&(at.force_v(fluid) * (factor * at.length))], block);
        });
    }

    /// Adds the force and the moment about `about` of the fluid from the start to `xi` to `sum`, in space.
    pub fn add_fluid_up_to(&self, fluid: &Surroundings, moving: &Moving, xi: f64, about: &Vec3, sum: &mut Wrench) {
        self.each_wet(fluid, moving, xi, |at| {
            let force = at.force(fluid) * (at.length * at.wet.share);
            Acting { position: at.position, force, moment: Vec3::zeros() }.add_about(about, 1.0, sum);
        });
    }

    /// Drag on the section at `xi`, N/m, in space.
    pub fn drag_at(&self, fluid: &Surroundings, moving: &Moving, xi: f64) -> Vec3 {
        let (share, share_z) = self.axis_in_fluid(fluid, moving, xi).share();
        self.fluid_at(fluid, moving, WetPoint { xi, weight: 0.0, share, share_z }).drag()
    }
}

/// `X_a` of an element's coordinates.
fn shapes(vector: &[f64]) -> Shapes {
    SHAPE_PLACES.map(|start| vec3(vector, start))
}

/// `Σ_a weight_a X_a`.
#[inline]
fn weighted(weights: &[f64; 4], shapes: &Shapes) -> Vec3 {
    shapes[0] * weights[0] + shapes[1] * weights[1] + shapes[2] * weights[2] + shapes[3] * weights[3]
}

/// Adds `weights_a force` to the forces of an element.
#[inline]
fn add_spread(weights: &[f64; 4], force: &Vec3, own: &mut [f64]) {
    for (weight, start) in weights.iter().zip(SHAPE_PLACES) {
        add_vec3(own, start, &(force * *weight));
    }
}

/// Adds `rows_a Σ_k columns_kb matrix_k` to the column-major `block`, 14×14.
#[inline]
fn add_products<const N: usize>(rows: &[f64; 4], columns: [&[f64; 4]; N], matrices: [&Mat3; N], block: &mut [f64]) {
    let (target, _) = block.as_chunks_mut::<ELEMENT>();
    for (b, column) in SHAPE_PLACES.into_iter().enumerate() {
        let mut sum = matrices[0] * columns[0][b];
        for k in 1..N {
            sum += matrices[k] * columns[k][b];
        }
        for j in 0..3 {
            for (a, row) in SHAPE_PLACES.into_iter().enumerate() {
                for i in 0..3 {
                    target[column + j][row + i] += rows[a] * sum[(i, j)];
                }
            }
        }
    }
}
