//! Forces over a step (MECHANICS 7.6): the resultants of the mean strains of both ends, along the derivatives of the
//! strains in the middle.
//!
//! With the strains `e0`, `e1` of the step's ends, `ē` their mean, `B = ∂e/∂q` in the middle and the constant
//! rigidities `D` the force is `Bᵀ [U_e(ē) + (c/h) D (e1 − e0) + chi D (e1 − e0 − h ė) + psi D (e1 − e0 − h ė0)]`, with
//! the damping `c` of the material, the rates `ė` over the last step and `ė0` at the start. `B` annihilates rigid
//! motions, so that momenta are kept, and a rigid motion changes no strain. The last two terms, the numerical
//! dissipation, are of second order in the step: they take what the step does not resolve.

use super::coordinates::{CHORD_PLACES, ELEMENT, ElementColumns, ElementVector, NODE, P, THETA, slopes};
use super::element::{Element, Evaluation};
use super::energy::quadratic_twist::{self, Twist};
use super::frame::NodeFrame;
use super::natural::{Natural, curvature_about};
use super::strain::Resultants;
use crate::math::{Mat3, Vec3};
use crate::mechanics::beam::configuration::{BeamConfiguration, TimeStep};

/// Strains of an element: three axial points, then `g1`, `g2`, `tau` of each bending point.
pub const STRAINS: usize = 12;

/// The strains of an element at an end of a step; those of its start stay what they are while its end is sought.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EndStrains {
    /// In the order of the rates: 1, 1/m, rad/m.
    strains: [f64; STRAINS],
    /// Total twist, rad.
    twist: f64,
    /// Internal coordinate of the quadratic twist, rad.
    bubble: f64,
}

impl EndStrains {
    /// Of an element at that end.
    #[inline(always)]
    pub fn new(evaluation: &Evaluation) -> Self {
        let mut strains = [0.0; STRAINS];
        for m in 0..3 {
            strains[m] = evaluation.axial_strain(m);
            for i in 0..3 {
                strains[3 + 3 * m + i] = evaluation.strains[m][i];
            }
        }
        Self { strains, twist: evaluation.kinematics.twist, bubble: evaluation.bubble }
    }

    /// Strain of axial point `m`, 1.
    pub fn axial_strain(&self, m: usize) -> f64 {
        self.strains[m]
    }
}

/// What a step adds to the elastic resultants of the mean strains, or the damping of the material to those of an
/// instant, quadrature weights included.
#[derive(Clone, Copy, Debug, Default)]
pub struct Added {
    /// Of the axial points, by their strain, N m.
    pub axial: [f64; 3],
    /// Of the bending points.
    pub bending: [Resultants; 3],
    /// Twice the derivative of the added resultants by the strains at the end of the step, over the rigidities `D`, 1;
    /// at an instant their derivative through the velocities.
    pub stiffening: f64,
    /// The same of the axial strains by themselves.
    pub axial_stiffening: f64,
    /// Derivatives of the added resultants of the axial points with respect to the slopes there, through the rates of
    /// the strains, N m; none over a step.
    pub axial_rate_changes: Option<[Vec3; 3]>,
    /// Not added but taken off in the Hessian: what the axial strains have beyond those of its axial forces, 1
    /// (MECHANICS 7.12).
    pub excess: [f64; 3],
    /// Rates of the strains, 1/s, 1/m/s, rad/m/s.
    pub rates: [f64; STRAINS],
}

impl Added {
    /// Sets all but the rates, which are known, for `element` over `step`.
    fn set(&mut self, element: &Element, step: &TimeStep) {
        let (duration, [tension, viscosity]) = (step.duration, element.viscosities());
        self.stiffening = 2.0 * (viscosity / duration + step.dissipation.sum());
        self.axial_stiffening = 2.0 * (tension / duration + step.dissipation.sum());
        let (last, start) = (element.own_rates(step.strain_rates), element.own_rates(step.predicted_rates));
        self.set_resultants(element, |rates, i, viscosity| {
            let unpredicted = step.dissipation.unpredicted(rates[i], [last[i], start[i]]);
            viscosity * rates[i] + duration * unpredicted
        });
    }

    /// The damping of the material of `element` at an instant with the rates `rates` of the strains and velocities that
    /// change by `velocity_by_q` with the coordinates, 1/s.
    pub fn at_instant(element: &Element, rates: &[f64; STRAINS], velocity_by_q: f64) -> Self {
        let [axial_stiffening, stiffening] = element.viscosities().map(|viscosity| viscosity * velocity_by_q);
        let mut added = Self { stiffening, axial_stiffening, rates: *rates, ..Self::default() };
        added.set_resultants(element, |rates, i, viscosity| viscosity * rates[i]);
        added
    }

    /// Sets the resultants to the rigidities times what `strain` makes of the rates, of the number of a strain and of
    /// its viscosity.
    #[inline]
    fn set_resultants(&mut self, element: &Element, strain: impl Fn(&[f64; STRAINS], usize, f64) -> f64) {
        let (rates, rigidities, [tension, viscosity]) = (self.rates, element.rigidities(), element.viscosities());
        let strain = |i: usize, viscosity: f64| strain(&rates, i, viscosity);
        for m in 0..3 {
            self.axial[m] = rigidities[m] * strain(m, tension);
            for i in 0..3 {
                let place = 3 + 3 * m + i;
                self.bending[m][i] = rigidities[place] * strain(place, viscosity);
            }
        }
        if element.eccentricities.is_none() {
            return;
        }
        for Coupling { axial, point, curvature, rigidity } in element.couplings() {
            self.axial[axial] += rigidity * strain(3 + 3 * point + curvature, viscosity);
            self.bending[point][curvature] += rigidity * strain(axial, viscosity);
        }
    }

    /// What the damping of the material of `element` takes over `duration` s with these rates, J.
    pub fn taken(&self, element: &Element, duration: f64) -> f64 {
        let ([tension, viscosity], rates) = (element.viscosities(), &self.rates);
        if tension == 0.0 {
            return 0.0;
        }
        let taken = |(i, rigidity): (usize, &f64)| {
            let own = if i < 3 { tension } else { viscosity };
            own * duration * rigidity * rates[i] * rates[i]
        };
        let mut sum = element.rigidities().iter().enumerate().map(taken).sum();
        for Coupling { axial, point, curvature, rigidity } in element.couplings() {
            sum += 2.0 * viscosity * duration * rigidity * rates[axial] * rates[3 + 3 * point + curvature];
        }
        sum
    }
}

/// A rigidity that couples an axial strain with a curvature: that of a tension center off the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coupling {
    /// The axial point.
    pub axial: usize,
    /// The bending point.
    pub point: usize,
    /// Which of its curvatures: 0 or 1.
    pub curvature: usize,
    /// Quadrature weight included, N m².
    pub rigidity: f64,
}

/// The way from the coordinates at the end of a step to those in its middle that change the strains alike, where the
/// element turns as its first node does. Strains are the same functions of what a section sees, wherever it has turned
/// to: instead of their derivatives at the end those of the middle will do.
#[derive(Clone, Copy, Debug)]
pub struct Turn {
    /// From the directions of the end to those of the middle.
    pub(super) rotation: Mat3,
    /// What a change of the slope of each node, in the middle, turns the section by about the tangent more than at the
    /// end, rad.
    pub(super) spin: [Vec3; 2],
}

impl Turn {
    /// Between the frames of both nodes in the middle and at the end of the step.
    fn new(middle: [&NodeFrame; 2], end: [&NodeFrame; 2]) -> Self {
        let rotation = middle[0].section() * end[0].section().transpose();
        let spin = |node: usize| {
            let (here, there) = (middle[node], end[node]);
            rotation.tr_mul(&here.k) / here.stretch - there.k / there.stretch
        };
        Self { rotation, spin: [spin(0), spin(1)] }
    }

    /// Multiplies `row`, derivatives by the coordinates in the middle, from the right, without those by `r_0`.
    #[inline]
    pub fn of_end(&self, row: &ElementVector) -> ElementVector {
        let mut turned = *row;
        for (_, place) in CHORD_PLACES {
            turned.fixed_rows_mut::<3>(place).copy_from(&self.rotation.tr_mul(&row.fixed_rows::<3>(place)));
        }
        for (node, spin) in [0, NODE].into_iter().zip(&self.spin) {
            let mut slope = turned.fixed_rows_mut::<3>(node + P);
            slope += spin * row[node + THETA];
        }
        turned
    }

    /// Multiplies `columns`, derivatives by the coordinates in the middle, from the right, without the rows and columns
    /// of `r_0`.
    #[inline]
    pub fn apply(&self, columns: &mut ElementColumns) {
        let rotation = &self.rotation;
        for (_, place) in CHORD_PLACES {
            let [x, y, z] = [columns[place], columns[place + 1], columns[place + 2]];
            for j in 0..3 {
                for row in P..ELEMENT {
                    columns[place + j][row] =
                        x[row] * rotation[(0, j)] + y[row] * rotation[(1, j)] + z[row] * rotation[(2, j)];
                }
            }
        }
        for (node, spin) in [0, NODE].into_iter().zip(&self.spin) {
            let by_angle = columns[node + THETA];
            for j in 0..3 {
                for row in P..ELEMENT {
                    columns[node + P + j][row] += by_angle[row] * spin[j];
                }
            }
        }
    }
}

impl Element {
    /// What multiplies the rates of the axial strains, and of the others, in the material's viscous stress, s.
    pub(super) fn viscosities(&self) -> [f64; 2] {
        [self.stiffness.damping + self.tension_damping, self.stiffness.damping]
    }

    /// `W D` of each strain, N m or N m³: what multiplies its square in twice the energy of small strains.
    #[inline]
    pub fn rigidities(&self) -> [f64; STRAINS] {
        let mut all = [0.0; STRAINS];
        for (g, (axial, bending)) in self.axial.iter().zip(&self.bending).enumerate() {
            let stiffness = &bending.stiffness;
            all[g] = axial.weight * axial.stiffness.axial;
            all[3 + 3 * g] = bending.weight * stiffness.bending_z;
            all[4 + 3 * g] = bending.weight * stiffness.bending_y;
            all[5 + 3 * g] = bending.weight * stiffness.torsion;
        }
        all
    }

    /// The rigidities beside the diagonal, of which [`Self::rigidities`] has none.
    pub fn couplings(&self) -> impl Iterator<Item = Coupling> + '_ {
        let points = self.eccentricities.iter().flat_map(|all| all.iter().zip(&self.bending).enumerate());
        points.flat_map(|(point, (own, rule))| {
            [0, 1, 2].into_iter().flat_map(move |axial| {
                [0, 1].map(|curvature| {
                    let rigidity = -rule.weight * rule.from_axial[axial] * own.first[curvature];
                    Coupling { axial, point, curvature, rigidity }
                })
            })
        })
    }

    /// The rates that `all`, those of the whole system, has of this element.
    pub fn own_rates_mut<'a>(&self, all: &'a mut [f64]) -> &'a mut [f64; STRAINS] {
        let (own, _) = all.as_chunks_mut::<STRAINS>();
        &mut own[self.place.branch]
    }

    /// [`Self::own_rates_mut`].
    pub fn own_rates<'a>(&self, all: &'a [f64]) -> &'a [f64; STRAINS] {
        let (own, _) = all.as_chunks::<STRAINS>();
        &own[self.place.branch]
    }

    /// Rates of the strains with the velocities `velocity` (14) of its own coordinates.
    pub fn strain_rates(&self, evaluation: &Evaluation, velocity: &[f64]) -> [f64; STRAINS] {
        // The internal coordinate of the quadratic twist follows the others.
        let bubble = match self.stiffness.twist {
            Twist::Linear => 0.0,
            Twist::Quadratic => evaluation.bubble_q().iter().zip(velocity).map(|(by_q, own)| by_q * own).sum(),
        };
        self.strain_rates_with(evaluation, velocity, bubble)
    }

    /// [`Self::strain_rates`] with the rate `bubble` of the internal coordinate of the quadratic twist, rad/s.
    #[inline]
    pub fn strain_rates_with(&self, evaluation: &Evaluation, velocity: &[f64], bubble: f64) -> [f64; STRAINS] {
        let Evaluation { kinematics, turn, gammahat, .. } = evaluation;
        let shape = kinematics.shape.along(velocity);
        let (mut curvatures, mut twist_rates) = ([[0.0; 2]; 3], [0.0; 3]);
        for (g, rule) in self.bending.iter().enumerate() {
            let (by_p, by_w) = (shape.interpolate(&rule.shape_x), shape.interpolate(&rule.shape_xx));
            (curvatures[g], twist_rates[g]) = kinematics.points[g].along(&by_p, &by_w);
        }
        let weighted = |weights: &[f64; 3]| weights.iter().zip(&twist_rates).map(|(w, rate)| w * rate).sum::<f64>();
        let twist = shape.twist + weighted(&self.rate_weights);
        let mut all = [0.0; STRAINS];
        let slope_rates = slopes(&self.axial[1].shape_x, velocity);
        for (m, slope) in evaluation.slopes.iter().enumerate() {
            all[m] = slope.strain_p(self.stiffness.strain).dot(&slope_rates[m]);
        }
        for (g, rule) in self.bending.iter().enumerate() {
            let ([cos, sin], [gamma1, gamma2], [by_1, by_2]) = (turn[g], gammahat[g], curvatures[g]);
            let alpha =
                shape.angle + rule.xi * twist - weighted(&rule.collocation) + bubble * quadratic_twist::shape(rule.xi);
            all[3 + 3 * g] = cos * by_1 + sin * by_2 + gamma2 * alpha;
            all[4 + 3 * g] = cos * by_2 - sin * by_1 - gamma1 * alpha;
            all[5 + 3 * g] = (twist + bubble * quadratic_twist::shape_xi(rule.xi)) * rule.torsion_by_twist;
        }
        all
    }

    /// Strains at an end of a step, `c`.
    pub fn end_strains(&self, c: &BeamConfiguration) -> EndStrains {
        let (natural, previous) = (self.natural(c), c.holonomy[self.place.branch]);
        match self.stiffness.twist {
            Twist::Linear => {
                let frames = self.frames(c);
                EndStrains::new(&Evaluation::with_linear_twist(self, self.own(c.q), None, frames, previous, &natural))
            }
            Twist::Quadratic => EndStrains::new(&self.evaluation(c)),
        }
    }

    /// What `with` makes of the element over a step whose middle is `c` and whose end has the strains `end`. An
    /// evaluation is large: it is not moved.
    #[inline]
    pub fn over_step<R>(
        &self,
        c: &BeamConfiguration,
        end: &EndStrains,
        step: &TimeStep,
        with: impl FnOnce(&Evaluation) -> R,
    ) -> R {
        let natural = match self.heating {
            Some(_) => self.natural(step.start).mean(&self.natural(step.end)),
            None => Natural::default(),
        };
        let mut middle = self.with_increment(c, step.increment, &natural);
        middle.set_step(end, step);
        with(&middle)
    }

    /// Work of heat over the step that `middle` is of, J: what the strains without stress change by, against the
    /// resultants.
    pub fn work_of_heat(&self, middle: &Evaluation, step: &TimeStep) -> f64 {
        let [before, after] = [step.start, step.end].map(|c| self.natural(c));
        let resultants = [0, 1, 2].map(|g| middle.resultants(g));
        let mut work = 0.0;
        for (g, point) in self.bending.iter().enumerate() {
            let axial = middle.strain_force(g, &resultants);
            let [[a1, a2], [b1, b2]] =
                [&after, &before].map(|natural| curvature_about(natural.curvature[g], point.principal - point.turn));
            work -= axial * (after.axial[g] - before.axial[g])
                + resultants[g][0] * (a1 - b1)
                + resultants[g][1] * (a2 - b2);
        }
        work
    }
}

impl Evaluation<'_> {
    /// Turns the strains of the middle of `step` into the means of those at its start and at its end, `end`, and sets
    /// what the step adds.
    fn set_step(&mut self, end: &EndStrains, step: &TimeStep) {
        let element = self.element;
        let start = &step.starts[element.place.branch];
        if element.stiffness.twist == Twist::Quadratic {
            self.set_bubble(0.5 * (start.bubble + end.bubble));
        }
        let per_duration = 1.0 / step.duration;
        for (mean, point) in self.mean_torsion.iter_mut().zip(&element.axial) {
            let torsion = |twist: f64| twist * point.torsion_by_twist - point.reference_torsion;
            *mean = 0.5 * (torsion(start.twist) + torsion(end.twist));
        }
        for i in 0..STRAINS {
            self.added.rates[i] = (end.strains[i] - start.strains[i]) * per_duration;
        }
        for g in 0..3 {
            // The axial strain, the last one, is the mean of both ends' already.
            for i in 0..3 {
                self.strains[g][i] = (start.strains[3 + 3 * g + i] + end.strains[3 + 3 * g + i]) * 0.5;
            }
        }
        self.turn_from_end = Some(Turn::new(self.kinematics.shape.frames, element.frames(step.end)));
        self.added.set(element, step);
    }
}
