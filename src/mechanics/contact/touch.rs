//! One element that touches a surface: the force at each point of integration, with its derivative.
//!
//! In the axes of the carrier a point of the beam is at `y' = Bᵀ(x − c)`, with the position `c` and the axes `B` of the
//! carrier. Over a step `Δy' = B̄ᵀ Δ(x − c) + ΔBᵀ ē` holds exactly with the means `B̄` and `ē` of `B` and of the arm
//! `e = x − c`. A force `F'` along `Δy'` is `B̄ F'` on the point, `−B̄ F'` on the carrier's position and `F'ᵢ ē` on its
//! director `i`.

use super::Contact;
use super::law::Pressure;
use super::pieces::{Gap, Lying, Part, each_point};
use crate::math::{Mat3, Vec3, hermite};
use crate::mechanics::beam::ancf14::coordinates::interpolate;
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::body::kinematics;
use crate::mechanics::geometry::pose::Pose;
use crate::mechanics::marker::configuration::{Configuration, Passage, TimeStep};

/// How a carrier and a point of the beam lie to each other.
#[derive(Clone, Copy, Debug)]
pub struct Arms {
    /// Axes of the carrier over the step, or at the instant: `B̄`.
    pub axes: Mat3,
    /// Arm from the carrier to the point: `ē`, m.
    pub arm: Vec3,
    /// The same at the end of the step.
    pub end_axes: Mat3,
    /// The same at the end of the step, m.
    pub end_arm: Vec3,
}

/// A point of an element that touches a surface.
#[derive(Clone, Copy, Debug)]
pub struct Touch {
    /// Place in the element, 0 to 1.
    pub xi: f64,
    /// The cell of the element.
    pub cell: usize,
    /// Length that it stands for, m.
    pub length: f64,
    /// Size of the normal force, N.
    pub pressing: f64,
    /// Its derivative with respect to `y'`, over a step at its end, N/m.
    pub by_position: Vec3,
    /// Weights of the element's positions and slopes.
    pub weights: [f64; 4],
    /// Force on the beam in the axes of the carrier, N.
    pub force: Vec3,
    /// Minus the derivative of the force with respect to `y'` at the instant, or twice that at the end of a step, N/m.
    pub stiffness: Mat3,
    /// Minus the derivative of the force with respect to the rate of `y'` at the instant; over a step 0, N s/m.
    pub damping: Mat3,
    /// How carrier and point lie.
    pub arms: Arms,
    /// How far the point is inside, m.
    pub penetration: f64,
    /// Energy that the step takes, J.
    pub dissipated: f64,
    /// Energy of the penetration at the instant or at the end of the step, J.
    pub energy: f64,
}

impl Contact {
    /// Calls `take` with each point of `element` that touches the surface at `c`, through which the system passes as
    /// `passage` says.
    pub fn each_touch(&self, element: &AnyElement, c: &Configuration, passage: &Passage, mut take: impl FnMut(&Touch)) {
        // One copy of the search for all who ask.
        let take: &mut dyn FnMut(&Touch) = &mut take;
        match passage {
            Passage::Step(step) => self.each_touch_over(element, step, take),
            Passage::Rest | Passage::Corrected(_) => self.each_touch_at(element, c, None, take),
            Passage::Instant { velocity, velocity_by_q, .. } => {
                self.each_touch_at(element, c, Some((velocity, *velocity_by_q)), take);
            }
        }
    }

    /// The same over a step.
    fn each_touch_over(&self, element: &AnyElement, step: &TimeStep, take: &mut dyn FnMut(&Touch)) {
        let configurations = [step.start, step.end];
        let carriers = configurations.map(|c| self.carrier(c));
        if self.is_clear(element, &carriers, configurations) {
            return;
        }
        let lying = [0, 1].map(|end| self.lying(element, &carriers[end], configurations[end]));
        let (shape, radius, (_, axes)) = (&self.surface.shape, self.radius, self.seat());
        let gap = |own: &Lying, xi: f64| shape.distance(&own.point(xi)) - radius;
        let gaps: [Gap; 2] = [&|xi| gap(&lying[0], xi), &|xi| gap(&lying[1], xi)];
        let parts: [Part; 2] = [&|xi| shape.part(&lying[0].point(xi)), &|xi| shape.part(&lying[1].point(xi))];
        let parts = if shape.has_parts() { &parts[..] } else { &[] };
        each_point(&gaps, parts, lying[1].length, &mut |cell, xi, share| {
            let weights = hermite::shape(xi, element.length());
            let points = lying.map(|own| own.point(xi));
            let penetrations = points.map(|point| radius - shape.distance(&point));
            let Pressure { force, slope, elastic } = self.law.over(penetrations, step.duration);
            let secant = shape.secant(&points[0], &points[1]);
            let normal = shape.normal(&points[1]);
            let by_end = secant.direction * normal.transpose() * slope - secant.by_end * force;
            take(&Touch {
                xi,
                cell,
                length: share,
                pressing: share * force,
                by_position: axes * normal * (-share * slope),
                weights,
                force: axes * secant.direction * (share * force),
                stiffness: axes * by_end * axes.transpose() * (2.0 * share),
                damping: Mat3::zeros(),
                arms: Arms::over(
                    carriers,
                    [0, 1].map(|end| arm(element, &weights, &carriers[end], configurations[end])),
                ),
                penetration: penetrations[1],
                dissipated: share * (force - elastic) * (penetrations[1] - penetrations[0]),
                energy: share * self.law.energy(penetrations[1]),
            });
        });
    }

    /// The same at an instant, with the velocities of all coordinates and how these change with the coordinates, 1/s.
    fn each_touch_at(
        &self,
        element: &AnyElement,
        c: &Configuration,
        motion: Option<(&[f64], f64)>,
        take: &mut dyn FnMut(&Touch),
    ) {
        let carrier = self.carrier(c);
        if self.is_clear(element, &[carrier; 2], [c; 2]) {
            return;
        }
        let lying = self.lying(element, &carrier, c);
        let (shape, radius, (_, axes)) = (&self.surface.shape, self.radius, self.seat());
        let gap: Gap = &|xi| shape.distance(&lying.point(xi)) - radius;
        let part: &[Part] = &[&|xi| shape.part(&lying.point(xi))];
        let parts = if shape.has_parts() { part } else { &[] };
        each_point(&[gap], parts, lying.length, &mut |cell, xi, share| {
            let point = lying.point(xi);
            let penetration = radius - shape.distance(&point);
            let (weights, normal) = (hermite::shape(xi, element.length()), shape.normal(&point));
            let arms = Arms::at(carrier, arm(element, &weights, &carrier, c));
            let (velocity, velocity_by_q) = motion.unwrap_or((&[], 0.0));
            let rate = match motion {
                Some(_) if self.law.is_damped() => {
                    -normal.dot(&axes.tr_mul(&self.rate(element, &weights, &arms, c, velocity)))
                }
                _ => 0.0,
            };
            let by_rate = self.law.by_rate(penetration, rate);
            let stiff = velocity_by_q * by_rate;
            let Pressure { force, slope, .. } = self.law.at(penetration, rate);
            let by_position = normal * normal.transpose() * (slope + stiff) - shape.normal_by_position(&point) * force;
            take(&Touch {
                xi,
                cell,
                length: share,
                pressing: share * force,
                by_position: axes * normal * (-share * (slope + stiff)),
                weights,
                force: axes * normal * (share * force),
                stiffness: axes * by_position * axes.transpose() * share,
                damping: axes * normal * normal.transpose() * axes.transpose() * (share * by_rate),
                arms,
                penetration,
                dissipated: 0.0,
                energy: share * self.law.energy(penetration),
            });
        });
    }

    /// Rate of `y'` of a point of `element` with these `weights`, m/s.
    fn rate(&self, element: &AnyElement, weights: &[f64; 4], arms: &Arms, c: &Configuration, velocity: &[f64]) -> Vec3 {
        let moving = self.carrier_rate(c, velocity);
        let rate = interpolate(weights, &velocity[element.coordinates()]) - moving.place;
        arms.axes.tr_mul(&rate) + moving.axes.tr_mul(&arms.arm)
    }

    /// The derivative of the carrier by time.
    fn carrier_rate(&self, c: &Configuration, velocity: &[f64]) -> Pose {
        match self.body() {
            Some(start) => kinematics::pose(velocity, start),
            None => self.surface.marker.bare().pose_t(c)[0],
        }
    }

    /// Whether a point of `element` has run through the core of the surface over `step`.
    pub fn is_run_through(&self, element: &AnyElement, [start, end]: [&Configuration; 2]) -> bool {
        if self.surface.shape.radius().is_infinite() {
            return false;
        }
        let (configurations, carriers) = ([start, end], [start, end].map(|c| self.carrier(c)));
        if self.is_clear(element, &carriers, configurations) {
            return false;
        }
        let lying = [0, 1].map(|end| self.lying(element, &carriers[end], configurations[end]));
        /// Points of an element that are looked at: a beam does not bend around a core between them.
        const POINTS: usize = 5;
        (0..POINTS).any(|number| {
            let [start, end] = lying.map(|own| own.point(number as f64 / (POINTS - 1) as f64));
            self.surface.shape.is_run_through(&start, &end)
        })
    }
}

impl Arms {
    pub(super) fn over(carriers: [Pose; 2], [start, end]: [Vec3; 2]) -> Self {
        Self {
            axes: (carriers[0].axes + carriers[1].axes) * 0.5,
            arm: (start + end) * 0.5,
            end_axes: carriers[1].axes,
            end_arm: end,
        }
    }

    pub(super) fn at(carrier: Pose, arm: Vec3) -> Self {
        Self { axes: carrier.axes, arm, end_axes: carrier.axes, end_arm: arm }
    }
}

/// Arm from the carrier to the point of `element` with these `weights`, m.
pub(super) fn arm(element: &AnyElement, weights: &[f64; 4], carrier: &Pose, c: &Configuration) -> Vec3 {
    interpolate(weights, &c.beams.q[element.coordinates()]) - carrier.place
}

impl Touch {
    /// Force on the beam in global axes, N.
    pub fn in_space(&self) -> Vec3 {
        self.arms.axes * self.force
    }
}
