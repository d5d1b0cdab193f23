//! One ANCF14 element: its quadrature points, its strains, and the energy by the 14 coordinates (MECHANICS 3, 8).
//!
//! The densities live in axial.rs, bending.rs, torsion.rs, fourth_moments.rs, the derivatives of the strains by the
//! coordinates in strain_derivatives.rs; here they meet. Where the paper and this differ, MECHANICS 1 and 3 say why.

use super::along::Along;
use super::coordinates::{
    ELEMENT, ElementColumns, ElementMatrix, ElementVector, add_slope_force, complete, interpolate, slopes,
};
use super::energy::quadratic_twist::{self, Condensation, Twist};
use super::energy::{axial, bending, eccentricity, fourth_moments, stretching, torsion};
use super::frame::NodeFrame;
use super::inertia::{self, Inertia};
use super::kinematics::Kinematics;
use super::kinematics::corotated::{COROTATED, CorotatedVector};
use super::kinematics::points::{AxialPoint, AxialRule, BendingPoint, BendingRule};
use super::kinematics::strain_derivatives::{Couplings, Forces, Gradients};
use super::natural::{Heating, Natural, Prestressed};
use super::over_step::{Added, Turn};
use super::strain::{Eccentricity, Resultants, Rigidities, Stiffness, Strain, Strains};
use crate::math::quadrature::{GAUSS_POINTS, GAUSS_WEIGHTS, LOBATTO_POINTS, LOBATTO_WEIGHTS, collocation, lagrange};
use crate::math::{Vec3, hermite};
use crate::mechanics::beam::configuration::BeamConfiguration;
use std::sync::Arc;

/// Where an element's numbers are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// First coordinate of its first node; those of the second node follow.
    pub start: usize,
    /// Number of its first node's frame; the second one's is the next.
    pub frame: usize,
    /// Number of its holonomy angle.
    pub branch: usize,
}

/// One element of a beam; never changes but for its damping. The numbers that elements of one length and section have
/// in common are in memory once (shared.rs).
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// Where its numbers are.
    pub place: Place,
    /// Undeformed length l, m.
    pub length: f64,
    /// Section stiffness; where it varies that of the middle.
    pub stiffness: Stiffness,
    /// The three Lobatto points.
    pub axial: [AxialPoint; 3],
    /// The three Gauss points.
    pub bending: [BendingPoint; 3],
    /// `l w_g`, m: weights of the twist rate in the total twist (2.12).
    pub rate_weights: [f64; 3],
    /// Total twist `T` of the undeformed element, rad.
    pub reference_twist: f64,
    /// Mass matrix and weight, which other elements may share.
    pub inertia: Arc<Inertia>,
    /// The section along it; none where it is the same everywhere, in principal axes.
    pub along: Option<Along>,
    /// Odd moments of the section at the bending points; none where the tension center is on the axis.
    pub eccentricities: Option<Box<[Eccentricity; 3]>>,
    /// How it is under stress where it is drawn; none: not at all.
    pub prestress: Option<Box<Prestressed>>,
    /// How it expands with heat.
    pub heating: Option<Heating>,
    /// Damping of the axial strain beyond that of the material, s.
    pub tension_damping: f64,
}

impl Element {
    /// An element that is stress free at the coordinates `reference` (14) with the nodes' frames `first` and `second`.
    /// `density` is `[ρA, ρIp]` in kg/m and kg m; `holonomy` the holonomy angle of the reference's branch, rad.
    #[inline]
    pub fn new(
        place: Place,
        length: f64,
        stiffness: Stiffness,
        density: [f64; 2],
        reference: &[f64],
        frames: [&NodeFrame; 2],
        holonomy: f64,
    ) -> Self {
        let axial = std::array::from_fn(|m| {
            let shape_x = hermite::shape_x(LOBATTO_POINTS[m], length);
            let slope = interpolate(&shape_x, reference);
            let stretch = slope.norm();
            AxialPoint {
                weight: LOBATTO_WEIGHTS[m] * length * stretch,
                reference_stretch: stretch,
                reference_square: slope.norm_squared(),
                torsion_by_twist: 1.0 / (length * stretch),
                reference_torsion: 0.0,
                natural: 0.0,
                rule: Arc::new(AxialRule { shape_x, stiffness: stiffness.at_axial_point() }),
            }
        });
        let bending = std::array::from_fn(|g| {
            let xi = GAUSS_POINTS[g];
            let shape_x = hermite::shape_x(xi, length);
            let stretch = interpolate(&shape_x, reference).norm();
            let rule = BendingRule {
                xi,
                shape_x,
                shape_xx: hermite::shape_xx(xi, length),
                collocation: collocation(xi).map(|a| a * length),
                from_axial: lagrange(&LOBATTO_POINTS, xi),
                stiffness: stiffness.at_bending_point(),
                principal: 0.0,
                turn: 0.0,
            };
            BendingPoint {
                weight: GAUSS_WEIGHTS[g] * length * stretch,
                reference_stretch: stretch,
                torsion_by_twist: 1.0 / (length * stretch),
                reference: [0.0; 3],
                rule: Arc::new(rule),
            }
        });
        let mut element = Self {
            place,
            length,
            stiffness,
            axial,
            bending,
            rate_weights: GAUSS_WEIGHTS.map(|w| w * length),
            reference_twist: 0.0,
            inertia: Arc::new(Inertia::new(density, length)),
            along: None,
            eccentricities: None,
            prestress: None,
            heating: None,
            tension_damping: 0.0,
        };
        element.set_reference(reference, frames, holonomy);
        element
    }

    /// Makes it stress free at `reference`; arguments as of [`Self::new`].
    pub(super) fn set_reference(&mut self, reference: &[f64], frames: [&NodeFrame; 2], holonomy: f64) {
        self.bending.iter_mut().for_each(|point| point.reference = [0.0; 3]);
        // The reference strains are what the same interpolation finds in the reference itself: it is stress free
        // exactly.
        let at_rest = Evaluation::with_linear_twist(self, reference, None, frames, holonomy, &Natural::default());
        let (strains, twist) = (at_rest.strains, at_rest.kinematics.twist);
        self.reference_twist = twist;
        for (point, found) in self.bending.iter_mut().zip(strains) {
            point.reference = [found[0], found[1], found[2]];
        }
        for point in &mut self.axial {
            point.reference_torsion = twist * point.torsion_by_twist;
        }
    }

    /// Its coordinates (14) among those `q` of the whole system.
    pub fn own<'a>(&self, q: &'a [f64]) -> &'a [f64] {
        &q[self.place.start..self.place.start + ELEMENT]
    }

    /// The frames of its two nodes.
    pub fn frames<'a>(&self, c: &BeamConfiguration<'a>) -> [&'a NodeFrame; 2] {
        [&c.frames[self.place.frame], &c.frames[self.place.frame + 1]]
    }

    /// In-element kinematics.
    pub fn kinematics<'a>(&self, c: &BeamConfiguration<'a>) -> Kinematics<'a> {
        Kinematics::new(self, self.own(c.q), self.frames(c), c.holonomy[self.place.branch])
    }

    /// Strains at `c`.
    #[inline]
    pub fn evaluation<'a>(&'a self, c: &BeamConfiguration<'a>) -> Evaluation<'a> {
        Evaluation::new(self, self.own(c.q), self.frames(c), c.holonomy[self.place.branch], &self.natural(c))
    }

    /// Strains with linear twist, whatever the element's is: those that material damping sees at an instant.
    pub fn linear_evaluation<'a>(&'a self, c: &BeamConfiguration<'a>) -> Evaluation<'a> {
        let previous = c.holonomy[self.place.branch];
        Evaluation::with_linear_twist(self, self.own(c.q), None, self.frames(c), previous, &self.natural(c))
    }

    /// Strains with linear twist, where stretching is the mean of both ends' of a step, whose middle is `c`, with the
    /// `increment` of all coordinates and the `natural` strains of the step.
    pub(super) fn with_increment<'a>(
        &'a self,
        c: &BeamConfiguration<'a>,
        increment: &[f64],
        natural: &Natural,
    ) -> Evaluation<'a> {
        let own = Some(self.own(increment));
        Evaluation::with_linear_twist(self, self.own(c.q), own, self.frames(c), c.holonomy[self.place.branch], natural)
    }

    /// Generalized weight in the gravity field `gravity` (m/s²), 14×1.
    pub fn weight(&self, gravity: &Vec3) -> ElementVector {
        inertia::weight(&self.inertia.weights, gravity)
    }
}

/// An element at one configuration, or over one step: strains first, then energy, gradient and Hessian as asked.
#[derive(Clone, Debug)]
pub struct Evaluation<'a> {
    pub(super) element: &'a Element,
    /// Curvatures and twist rates of the carried frame.
    pub kinematics: Kinematics<'a>,
    pub(super) slopes: [axial::Slope; 3],
    /// Axial strains of the axial points that bending points see: Green's; engineering ones of a tension center off the
    /// axis, else 0, for small strain.
    pub(super) seen: [f64; 3],
    pub(super) mean_torsion: [f64; 3],
    /// Internal coordinate `b` of the quadratic twist, rad; 0 for linear twist.
    pub bubble: f64,
    /// `cos α/J0` and `sin α/J0` at the bending points, `b` included in `α`.
    pub(super) turn: [[f64; 2]; 3],
    /// `gammahat` at the bending points, 1/m (2.16).
    pub(super) gammahat: [[f64; 2]; 3],
    /// Strains at the bending points, undeformed values taken off.
    pub strains: [Strains; 3],
    /// Strains by heat.
    pub(super) natural: Natural,
    /// What a step adds to the resultants of these strains.
    pub(super) added: Added,
    /// From the end of a step to its middle, or where damping sees an element that turns at an instant; else none.
    pub(super) turn_from_end: Option<Turn>,
}

/// First derivatives, shared by gradient and Hessian.
struct FirstOrder {
    /// Derivatives of the energy by the strains of the bending points, quadrature weights included.
    resultants: [Resultants; 3],
    /// By what strains are made of.
    forces: Forces,
}

impl<'a> Evaluation<'a> {
    /// Of `element` at the coordinates `q` (14), with its nodes' frames there and the holonomy angle `previous` of the
    /// last accepted state, rad, and `natural` strains.
    #[inline]
    pub fn new(element: &'a Element, q: &[f64], frames: [&'a NodeFrame; 2], previous: f64, natural: &Natural) -> Self {
        // As two ways out: what one of them returns is not copied.
        match element.stiffness.twist {
            Twist::Linear => Self::with_linear_twist(element, q, None, frames, previous, natural),
            Twist::Quadratic => {
                let mut evaluation = Self::with_linear_twist(element, q, None, frames, previous, natural);
                quadratic_twist::relax(&mut evaluation);
                evaluation
            }
        }
    }

    /// As [`Self::new`], but with linear twist whatever the element's is; `increment` is what the coordinates change by
    /// over a step whose middle is `q`, or none. It is built where the caller has it, and only what the caller uses of
    /// it.
    #[inline(always)]
    pub fn with_linear_twist(
        element: &'a Element,
        q: &[f64],
        increment: Option<&[f64]>,
        frames: [&'a NodeFrame; 2],
        previous: f64,
        natural: &Natural,
    ) -> Self {
        let kinematics = Kinematics::new(element, q, frames, previous);
        let [first, middle, last] = &element.axial;
        let here = slopes(&middle.shape_x, q);
        let changes = increment.map_or([Vec3::zeros(); 3], |increment| slopes(&middle.shape_x, increment));
        let slope = |m: usize, point: &AxialPoint| axial::Slope {
            middle: here[m],
            increment: changes[m],
            reference_stretch: point.reference_stretch,
            reference_square: point.reference_square,
            natural: point.natural + natural.axial[m],
        };
        let torsion = |point: &AxialPoint| kinematics.twist * point.torsion_by_twist - point.reference_torsion;
        let slopes = [slope(0, first), slope(1, middle), slope(2, last)];
        let seen = match (element.stiffness.strain, &element.eccentricities) {
            // Nothing depends on them.
            (Strain::Small, None) => [0.0; 3],
            (Strain::Small, Some(_)) => slopes.each_ref().map(axial::Slope::engineering_strain),
            _ => [slopes[0].green_strain(), slopes[1].green_strain(), slopes[2].green_strain()],
        };
        let mean_torsion = [torsion(first), torsion(middle), torsion(last)];
        let turned = |g: usize| element.bending[g].turn(kinematics.alpha[g], 0.0);
        let turn = [turned(0), turned(1), turned(2)];
        let strained = |g: usize| {
            let of_kinematics = (kinematics.points[g].curvatures, kinematics.twist);
            element.bending[g].strains(of_kinematics, 0.0, turn[g], natural.curvature[g], &seen)
        };
        let [(gamma0, strains0), (gamma1, strains1), (gamma2, strains2)] = [strained(0), strained(1), strained(2)];
        // All of it at once, where the caller has room for it: it is large, and nothing of it is copied.
        Self {
            element,
            kinematics,
            slopes,
            seen,
            mean_torsion,
            bubble: 0.0,
            turn,
            gammahat: [gamma0, gamma1, gamma2],
            strains: [strains0, strains1, strains2],
            natural: *natural,
            added: Added::default(),
            turn_from_end: None,
        }
    }

    /// Sets the internal coordinate of the quadratic twist, rad, and the strains that follow from it.
    #[inline]
    pub(super) fn set_bubble(&mut self, bubble: f64) {
        self.bubble = bubble;
        for (g, point) in self.element.bending.iter().enumerate() {
            self.turn[g] = point.turn(self.kinematics.alpha[g], bubble);
        }
        self.set_strains();
    }

    /// Adds to the internal coordinate a `correction` so small that its square is below rounding: the sine of such a
    /// turn is its angle.
    pub(super) fn correct_bubble(&mut self, correction: f64) {
        self.bubble += correction;
        for (turn, point) in self.turn.iter_mut().zip(&self.element.bending) {
            let ([cos, sin], angle) = (*turn, correction * quadratic_twist::shape(point.xi));
            *turn = [cos - sin * angle, sin + cos * angle];
        }
        self.set_strains();
    }

    /// Strains of the bending points, as `bubble` and `turn` are.
    #[inline]
    fn set_strains(&mut self) {
        let Self { kinematics, natural, seen, bubble, .. } = self;
        for (g, point) in self.element.bending.iter().enumerate() {
            let of_kinematics = (kinematics.points[g].curvatures, kinematics.twist);
            let found = point.strains(of_kinematics, *bubble, self.turn[g], natural.curvature[g], seen);
            (self.gammahat[g], self.strains[g]) = found;
        }
    }

    /// Strain energy, J.
    pub fn energy(&self) -> f64 {
        let mut sum = 0.0;
        for (point, strains) in self.element.bending.iter().zip(&self.strains) {
            let stiffness = &point.stiffness;
            sum += point.weight
                * (bending::energy(stiffness, strains)
                    + torsion::energy(stiffness, strains)
                    + if stiffness.strain == Strain::Large { fourth_moments::energy(stiffness, strains) } else { 0.0 });
        }
        for (g, own) in self.element.eccentricities.iter().flat_map(|all| all.iter().enumerate()) {
            sum += self.element.bending[g].weight
                * eccentricity::energy(self.element.stiffness.strain, own, &self.strains[g]);
        }
        for (m, point) in self.element.axial.iter().enumerate() {
            sum += point.weight
                * match self.element.stiffness.strain {
                    Strain::Small => axial::small::energy(&point.stiffness, &self.slopes[m]),
                    _ => axial::large::energy(&point.stiffness, self.seen[m], self.mean_torsion[m]),
                };
        }
        sum
    }

    /// `∂U/∂q`, 14×1, J per unit of each coordinate; over a step its force (MECHANICS 7.6).
    #[inline]
    pub fn gradient(&self) -> ElementVector {
        let first = self.first_order();
        let by_shape = first.forces.factors(self.element).gradient(self.element, &self.kinematics);
        self.with_axial_forces(&by_shape, &first.resultants)
    }

    /// Gradient and Hessian, 14×14; over a step twice the derivative of the force by the coordinates at its end
    /// (slightly unsymmetric).
    pub fn gradient_and_hessian(&self) -> (ElementVector, ElementMatrix) {
        let mut hessian = ElementMatrix::zeros();
        (self.gradient_and_set_hessian(1.0, &mut hessian.data.0), hessian)
    }

    /// The gradient; sets `hessian` to `scale` times the Hessian of [`Self::gradient_and_hessian`].
    #[inline]
    pub fn gradient_and_set_hessian(&self, scale: f64, hessian: &mut ElementColumns) -> ElementVector {
        let (element, first) = (self.element, self.first_order());
        let rigidities = [self.rigidities(0), self.rigidities(1), self.rigidities(2)];
        let gradients = Gradients::new(element, &self.kinematics);
        let torque_by_twist = stretching::torque_by_twist(self);
        let couplings = Couplings::new(self, &first.resultants, &rigidities, torque_by_twist);
        // At fixed strains of the axial points.
        let factors = first.forces.factors(element);
        let by_shape = gradients.weighted(&factors, element);
        let mut second = [[0.0; COROTATED]; COROTATED];
        gradients.add_frozen(&factors, element, &mut second);
        gradients.add_couplings(&couplings, &mut second);
        let condensation = (element.stiffness.twist == Twist::Quadratic)
            .then(|| Condensation::new(self, &gradients, &couplings, &rigidities));
        if let Some(condensation) = &condensation {
            condensation.condense(&mut second);
        }
        self.kinematics.shape.set_hessian(&by_shape, &mut second, scale, hessian);
        if let Some(turn) = &self.turn_from_end {
            turn.apply(hessian);
        }
        match (element.stiffness.strain, &element.eccentricities) {
            (Strain::Small, None) => stretching::add_small_hessian(self, scale, hessian),
            _ => {
                let first = stretching::Coupled {
                    evaluation: self,
                    resultants: &first.resultants,
                    rigidities: &rigidities,
                    gradients: &gradients,
                    condensation: condensation.as_ref(),
                };
                first.add_hessian(scale, hessian);
            }
        }
        complete(hessian);
        self.with_axial_forces(&by_shape, &first.resultants)
    }

    /// Derivatives of the energy by the strains of bending point `g`, quadrature weight included.
    #[inline]
    pub(super) fn resultants(&self, g: usize) -> Resultants {
        let (stiffness, strains) = (&self.element.bending[g].stiffness, &self.strains[g]);
        let mut density = bending::gradient(stiffness, strains) + torsion::gradient(stiffness, strains);
        if stiffness.strain == Strain::Large {
            density += fourth_moments::gradient(stiffness, strains);
        }
        if let Some(all) = &self.element.eccentricities {
            density += eccentricity::gradient(stiffness.strain, &all[g], strains);
        }
        density * self.element.bending[g].weight + self.added.bending[g]
    }

    /// Second derivatives of the energy by the strains of bending point `g`, quadrature weight included.
    #[inline]
    pub(super) fn rigidities(&self, g: usize) -> Rigidities {
        let (stiffness, strains) = (&self.element.bending[g].stiffness, &self.strains[g]);
        let mut density = bending::hessian(stiffness, strains) + torsion::hessian(stiffness, strains);
        density.stiffen(stiffness, self.added.stiffening);
        if stiffness.strain == Strain::Large {
            density = density + fourth_moments::hessian(stiffness, strains);
        }
        if let Some(all) = &self.element.eccentricities {
            density = density + eccentricity::hessian(stiffness.strain, &all[g], strains, self.added.stiffening);
        }
        density * self.element.bending[g].weight
    }

    fn first_order(&self) -> FirstOrder {
        let element = self.element;
        let resultants = [self.resultants(0), self.resultants(1), self.resultants(2)];
        let mut torques = [0.0; 3];
        if element.stiffness.strain != Strain::Small {
            for (m, point) in element.axial.iter().enumerate() {
                torques[m] =
                    point.weight * axial::large::gradient(&point.stiffness, self.seen[m], self.mean_torsion[m])[1];
            }
        }
        FirstOrder { resultants, forces: Forces::new(self, &resultants, &torques) }
    }

    /// The whole gradient, of which `by_shape` is the part of bending and torsion by the corotated shape.
    #[inline]
    fn with_axial_forces(&self, by_shape: &CorotatedVector, resultants: &[Resultants; 3]) -> ElementVector {
        let mut sum = self.kinematics.shape.gradient(by_shape);
        for (m, point) in self.element.axial.iter().enumerate() {
            add_slope_force(&point.shape_x, &self.axial_force(m, resultants), &mut sum);
        }
        sum
    }

    /// Derivative of the energy by `r'` at axial point `m`, N m.
    #[inline]
    fn axial_force(&self, m: usize, resultants: &[Resultants; 3]) -> Vec3 {
        self.slopes[m].strain_mean_p(self.element.stiffness.strain) * self.strain_force(m, resultants)
    }

    /// `F_m`, N m: derivative of the energy by the strain of axial point `m`.
    #[inline]
    pub(super) fn strain_force(&self, m: usize, resultants: &[Resultants; 3]) -> f64 {
        let (element, point) = (self.element, &self.element.axial[m]);
        let bending = || (0..3).map(|g| element.bending[g].from_axial[m] * resultants[g][3]).sum::<f64>();
        match (element.stiffness.strain, &element.eccentricities) {
            (Strain::Small, None) => self.engineering_force(m),
            (Strain::Small, Some(_)) => self.engineering_force(m) + bending(),
            _ => {
                let here = axial::large::gradient(&point.stiffness, self.seen[m], self.mean_torsion[m])[0];
                point.weight * here + bending() + self.added.axial[m]
            }
        }
    }

    /// `EA eps W`, N m: what the axial points give to the derivative of the small-strain energy by the strain of axial
    /// point `m`.
    #[inline]
    pub(super) fn engineering_force(&self, m: usize) -> f64 {
        let point = &self.element.axial[m];
        point.weight * axial::small::force(&point.stiffness, self.slopes[m].engineering_strain()) + self.added.axial[m]
    }
}
