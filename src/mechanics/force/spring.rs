//! Springs and dampers: `stiffness (x − rest) + damping x'` against a relative coordinate `x`, N or N m.
//!
//! Two-point springs, springs on the coordinate of a joint and the six of a bushing are all of this kind. A law takes
//! the place of both terms: a rope, a function, friction or a stop.

use crate::mechanics::force::dry_friction::DryFriction;
use crate::mechanics::force::law::{Law, LawForce};
use crate::mechanics::geometry::marker_jacobian::{MarkerMatrix, MarkerVector};
use crate::mechanics::geometry::pose_pair::PairVector;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::{Configuration, Passage, TimeStep};
use crate::mechanics::marker::relative_coordinate::Measure;
use crate::mechanics::marker::relative_coordinate::RelativeCoordinate;

/// A spring with a damper.
#[derive(Clone, Debug)]
pub struct Spring {
    /// Name in the model file, of the spring or of its joint.
    pub name: String,
    /// What it acts on, by the number of the relative coordinate.
    pub coordinate: usize,
    /// Stiffness, N/m or N m/rad.
    pub stiffness: f64,
    /// Damping, N s/m or N m s/rad.
    pub damping: f64,
    /// Value of the coordinate at which it is free of force, m or rad.
    pub rest: f64,
    /// How easily a step moves the coordinate from where it is drawn: one over the mass or the moment of inertia behind
    /// it, which stiffness adds to, 1/kg or 1/(kg m²); 0 where it is not known.
    pub mobility: f64,
    /// Its law, if it is not linear: stiffness and damping are 0 then.
    pub law: Option<Law>,
    /// Where the elastic displacement of its dry friction is in the memory of a state; none: it remembers nothing.
    pub memory: Option<usize>,
}

impl Spring {
    /// Its elastic energy, J.
    pub fn energy(&self, coordinate: &RelativeCoordinate, c: &Configuration) -> f64 {
        if self.is_idle() {
            return 0.0;
        }
        let stretch = self.value(coordinate, c) - self.rest;
        match &self.law {
            Some(Law::Friction { dry, .. }) => dry.energy(dry.displaced(self.remembered(c), self.way(coordinate, c))),
            Some(law) => law.energy(stretch),
            None => 0.5 * self.stiffness * stretch * stretch,
        }
    }

    fn value(&self, coordinate: &RelativeCoordinate, c: &Configuration) -> f64 {
        coordinate.value(c, c.relative_values[self.coordinate])
    }

    /// Its force against the growing of the coordinate, N or N m; over a step that of the mean value at both ends, with
    /// what numerical dissipation adds.
    pub fn tension(&self, coordinate: &RelativeCoordinate, c: &Configuration, passage: &Passage) -> f64 {
        if let Some(law) = &self.law {
            let force = self.law_force(law, coordinate, c, passage);
            return force.elastic + force.viscous;
        }
        let elastic = match passage {
            Passage::Rest | Passage::Corrected(_) | Passage::Instant { .. } => self.value(coordinate, c) - self.rest,
            Passage::Step(step) => {
                let [start, end] = [step.start, step.end].map(|end| self.value(coordinate, end));
                let rate = (end - start) / step.duration;
                let number = c.mesh.relative_rate_index(self.coordinate);
                let unpredicted = step.unpredicted(rate, number);
                0.5 * (start + end) - self.rest + step.duration * unpredicted
            }
        };
        self.stiffness * elastic + self.damping * self.rate(coordinate, c, passage)
    }

    /// The elastic displacement of its dry friction at the last accepted state, m or rad.
    fn remembered(&self, c: &Configuration) -> f64 {
        self.memory.map_or(0.0, |place| c.memory[place])
    }

    /// The way of its coordinate since the last accepted state, m or rad.
    pub fn way(&self, coordinate: &RelativeCoordinate, c: &Configuration) -> f64 {
        self.value(coordinate, c) - c.relative_values[self.coordinate]
    }

    /// The way of its coordinate over a step, m or rad.
    fn way_over(&self, coordinate: &RelativeCoordinate, step: &TimeStep) -> f64 {
        self.value(coordinate, step.end) - self.value(coordinate, step.start)
    }

    /// The force of its dry friction, N or N m, and its derivative with respect to the coordinate; over a step that at
    /// its end.
    fn dry_force(
        &self,
        dry: &DryFriction,
        coordinate: &RelativeCoordinate,
        c: &Configuration,
        passage: &Passage,
    ) -> [f64; 2] {
        match passage {
            Passage::Step(step) => {
                // From the start of this step: the neighbor of a motion starts elsewhere.
                let (way, rate) = (self.way_over(coordinate, step), coordinate.rate(step.start, step.velocity));
                dry.force_over(self.remembered(c), way, rate, step.duration)
            }
            Passage::Rest | Passage::Corrected(_) | Passage::Instant { .. } => {
                let (before, way) = (self.remembered(c), self.way(coordinate, c));
                [dry.force(before, way), dry.slope(before, way)]
            }
        }
    }

    /// The force of its law; over a step its derivative with respect to the rate is that with respect to the mean rate
    /// of the step.
    fn law_force(&self, law: &Law, coordinate: &RelativeCoordinate, c: &Configuration, passage: &Passage) -> LawForce {
        let mut force = self.force_without_memory(law, coordinate, c, passage);
        if let Some(dry) = law.dry() {
            let [own, by_x] = self.dry_force(dry, coordinate, c, passage);
            force.elastic += own;
            force.by_x += by_x;
        }
        force
    }

    /// [`Self::law_force`] without dry friction that holds.
    fn force_without_memory(
        &self,
        law: &Law,
        coordinate: &RelativeCoordinate,
        c: &Configuration,
        passage: &Passage,
    ) -> LawForce {
        match passage {
            Passage::Rest | Passage::Corrected(_) => law.at(self.value(coordinate, c) - self.rest, 0.0),
            Passage::Instant { velocity, .. } => {
                law.at(self.value(coordinate, c) - self.rest, coordinate.rate(c, velocity))
            }
            Passage::Step(step) => {
                let [start, end] = [step.start, step.end].map(|end| self.value(coordinate, end) - self.rest);
                let rate = (end - start) / step.duration;
                let taken = |late: f64| match late {
                    0.0 => rate,
                    late => (1.0 + late) * rate - late * coordinate.rate(step.start, step.velocity),
                };
                let late = self.lateness_of(law, start, step.duration);
                let mut force = law.over_without_viscosity(start, end, taken(late));
                force.by_v *= 1.0 + late;
                // Beside dry friction, which stops within less than a step, viscous friction keeps its own time.
                let viscous = law.viscosity();
                if viscous != 0.0 {
                    let late = lateness(viscous * self.mobility, step.duration);
                    force.viscous += viscous * taken(late);
                    force.by_v += viscous * (1.0 + late);
                }
                // No numerical dissipation: it holds energy in proportion to the stiffness, which would come from
                // nothing where a law stiffens, as at a contact.
                force
            }
        }
    }

    /// [`Self::lateness`] of a law that a step begins at the elongation `start`.
    fn lateness_of(&self, law: &Law, start: f64, duration: f64) -> f64 {
        lateness(law.at(start, 0.0).by_v * self.mobility, duration)
    }

    /// The force of its damper alone.
    fn viscous(&self, coordinate: &RelativeCoordinate, c: &Configuration, passage: &Passage) -> f64 {
        match &self.law {
            Some(law) => self.force_without_memory(law, coordinate, c, passage).viscous,
            None => self.damping * self.rate(coordinate, c, passage),
        }
    }

    /// By how much its force over `step`, whose middle is `c`, exceeds that in the middle of the time, where the
    /// coordinate and its rate have the values `middle`: N or N m. Without what mean strains and numerical dissipation
    /// do to an elastic force that is linear.
    pub fn lag(&self, coordinate: &RelativeCoordinate, c: &Configuration, step: &TimeStep, middle: [f64; 2]) -> f64 {
        let passage = Passage::Step(*step);
        let [value, rate] = middle;
        let Some(law) = &self.law else {
            return self.damping * (self.rate(coordinate, c, &passage) - rate);
        };
        // A law may have a corner on the way: its mean is that of both halves of the time.
        let [start, end] = [step.start, step.end].map(|end| self.value(coordinate, end) - self.rest);
        let between = value - self.rest;
        let mean = |ends: [f64; 2]| {
            let force = law.over(ends[0], ends[1], 2.0 * (ends[1] - ends[0]) / step.duration);
            force.elastic + force.viscous
        };
        let force = self.force_without_memory(law, coordinate, c, &passage);
        if let Some(dry) = law.dry() {
            let [own, _] = self.dry_force(dry, coordinate, c, &passage);
            return own - dry.force(self.remembered(c), between - start) + force.viscous - law.viscosity() * rate;
        }
        let halves = 0.5 * (mean([start, between]) + mean([between, end]));
        RICHARDSON * (force.elastic + force.viscous - halves)
    }

    /// Says that its law is not a finite number at the rate `v`; none: it is one.
    pub fn undefined(&self, coordinate: &RelativeCoordinate, c: &Configuration, v: f64) -> Option<String> {
        let law = self.law.as_ref()?;
        let x = self.value(coordinate, c) - self.rest;
        let force = law.at(x, v);
        let is_finite = [force.elastic, force.viscous, force.by_x, force.by_v].iter().all(|value| value.is_finite());
        (!is_finite)
            .then(|| format!("the force of spring {} or its derivative, at x = {x:.5} and v = {v:.5},", self.name))
    }

    /// The length of the vector between both sides in the middle of a step over the mean of both ends': a distance then
    /// works as much as its energy changes. 1 for everything else, and at an instant.
    fn shortening(&self, coordinate: &RelativeCoordinate, c: &Configuration, passage: &Passage) -> f64 {
        match passage {
            Passage::Step(step) if coordinate.measure == Measure::Length => {
                let [start, end] = [step.start, step.end].map(|end| self.value(coordinate, end));
                2.0 * self.value(coordinate, c) / (start + end)
            }
            _ => 1.0,
        }
    }

    /// Rate of the coordinate, m/s or rad/s.
    fn rate(&self, coordinate: &RelativeCoordinate, c: &Configuration, passage: &Passage) -> f64 {
        if self.damping == 0.0 {
            return 0.0;
        }
        match passage {
            Passage::Rest | Passage::Corrected(_) => 0.0,
            Passage::Step(TimeStep { start, end, duration, velocity, .. }) => {
                let mean = (self.value(coordinate, end) - self.value(coordinate, start)) / duration;
                match self.lateness(*duration) {
                    0.0 => mean,
                    late => (1.0 + late) * mean - late * coordinate.rate(start, velocity),
                }
            }
            Passage::Instant { velocity, .. } => coordinate.rate(c, velocity),
        }
    }

    /// Mean rate of the coordinate over a step, m/s or rad/s; 0 where it does nothing.
    pub fn step_rate(&self, coordinate: &RelativeCoordinate, step: &TimeStep) -> f64 {
        if self.is_idle() {
            return 0.0;
        }
        self.way_over(coordinate, step) / step.duration
    }

    /// How far from the middle of a step of `duration` s towards its end the damper's rate is taken, 0 to 1.
    ///
    /// In the middle, a damper `c` multiplies the rate of a mass `m` by `(1 − z/2)/(1 + z/2)` a step, `z = c h/m`:
    /// beyond `z = 2` the rate changes its sign with every step, and beyond 20 it hardly fades. Taken later by
    /// `1 − 2/z`, it makes the factor 0.
    fn lateness(&self, duration: f64) -> f64 {
        lateness(self.decay_rate(), duration)
    }

    /// How fast the damper takes the motion of the mass that it holds, `c/m`, 1/s; 0 where that mass is not known.
    pub fn decay_rate(&self) -> f64 {
        self.damping * self.mobility
    }

    /// Generalized forces against the motion of both sides, 24×1 each: the gradient of the energy, and the damper's
    /// part.
    pub fn gradient(&self, coordinate: &RelativeCoordinate, c: &Configuration, passage: &Passage) -> [MarkerVector; 2] {
        if self.is_idle() {
            return [MarkerVector::zeros(); 2];
        }
        let tension = self.tension(coordinate, c, passage) * self.shortening(coordinate, c, passage);
        coordinate.gradient(c).map(|by_side| by_side * tension)
    }

    /// Derivative of [`Self::gradient`] by the coordinates of both sides, blocks `aa, ab, ba, bb`; over a step twice
    /// that by the coordinates at its end. At an instant the velocities are fixed.
    pub fn hessian(&self, coordinate: &RelativeCoordinate, c: &Configuration, passage: &Passage) -> [MarkerMatrix; 4] {
        let mut blocks = [MarkerMatrix::zeros(); 4];
        self.set_hessian(coordinate, c, passage, &mut blocks);
        blocks
    }

    /// Sets `blocks`, which are 0, to [`Self::hessian`].
    pub fn set_hessian(
        &self,
        coordinate: &RelativeCoordinate,
        c: &Configuration,
        passage: &Passage,
        blocks: &mut [MarkerMatrix; 4],
    ) {
        if self.is_idle() {
            return;
        }
        let shortening = self.shortening(coordinate, c, passage);
        if let Some(law) = &self.law {
            let force = self.law_force(law, coordinate, c, passage);
            coordinate.set_hessian(c, (force.elastic + force.viscous) * shortening, blocks);
            add_law_hessian(&force, coordinate, c, passage, blocks);
            return;
        }
        coordinate.set_hessian(c, self.tension(coordinate, c, passage) * shortening, blocks);
        let here = coordinate.gradient(c);
        match passage {
            Passage::Rest | Passage::Corrected(_) => add_products(&here, &here, self.stiffness, blocks),
            Passage::Step(TimeStep { end, duration, dissipation, .. }) => {
                let viscous = 2.0 * self.damping * (1.0 + self.lateness(*duration)) / duration;
                let stiffness = self.stiffness * (1.0 + 2.0 * dissipation.sum()) + viscous;
                add_products(&here, &coordinate.gradient(end), stiffness, blocks);
            }
            Passage::Instant { velocity, .. } => {
                add_products(&here, &here, self.stiffness, blocks);
                if self.damping != 0.0 {
                    add_products(&here, &coordinate.rate_gradient(c, velocity), self.damping, blocks);
                }
            }
        }
    }

    /// Derivative of [`Self::gradient`] with respect to the velocities of both sides, blocks `aa, ab, ba, bb`.
    pub fn damping_matrix(
        &self,
        coordinate: &RelativeCoordinate,
        c: &Configuration,
        velocity: &[f64],
    ) -> [MarkerMatrix; 4] {
        let damping = match &self.law {
            Some(law) => self.law_force(law, coordinate, c, &Passage::with_velocity(velocity)).by_v,
            None => self.damping,
        };
        damping_blocks(coordinate, c, damping)
    }

    /// [`Self::damping_matrix`] at rest. Of friction the viscous part alone: what dry friction takes is not in
    /// proportion to a velocity.
    pub fn damping_at_rest(&self, coordinate: &RelativeCoordinate, c: &Configuration) -> [MarkerMatrix; 4] {
        let damping = match &self.law {
            Some(law @ (Law::Friction { .. } | Law::SmoothFriction { .. })) => law.viscosity(),
            Some(law) => self.law_force(law, coordinate, c, &Passage::Rest).by_v,
            None => self.damping,
        };
        damping_blocks(coordinate, c, damping)
    }

    /// Power that its damper takes with the velocities `velocity`, W.
    pub fn dissipation(&self, coordinate: &RelativeCoordinate, c: &Configuration, velocity: &[f64]) -> f64 {
        if self.is_idle() {
            return 0.0;
        }
        let rate = coordinate.rate(c, velocity);
        (self.viscous(coordinate, c, &Passage::with_velocity(velocity)) + self.sliding(coordinate, c, rate)) * rate
    }

    /// The force of dry friction that slides at the rate `rate`, N or N m; while it sticks, it takes nothing.
    fn sliding(&self, coordinate: &RelativeCoordinate, c: &Configuration, rate: f64) -> f64 {
        let Some(dry) = self.law.as_ref().and_then(Law::dry) else { return 0.0 };
        let (before, way) = (self.remembered(c), self.way(coordinate, c));
        if dry.slides(dry.displaced(before, way), rate) { dry.force(before, way) } else { 0.0 }
    }

    /// Whether a side of its coordinate is a moving frame, which puts work in.
    fn is_framed(coordinate: &RelativeCoordinate) -> bool {
        [coordinate.a, coordinate.b].iter().any(|side| matches!(side, Marker::Frame { .. }))
    }

    /// Work over `step`, whose middle is `c`, J, as the step takes its forces: what moving frames put in, and what the
    /// damper takes out.
    pub fn step_work(&self, coordinate: &RelativeCoordinate, c: &Configuration, step: &TimeStep) -> [f64; 2] {
        if self.is_idle() {
            return [0.0; 2];
        }
        let passage = Passage::Step(*step);
        let whole = self.way_over(coordinate, step);
        let sides_moved = coordinate.change(c, step.increment) * self.shortening(coordinate, c, &passage);
        let is_framed = Self::is_framed(coordinate);
        let given = if is_framed { self.tension(coordinate, c, &passage) * (whole - sides_moved) } else { 0.0 };
        let moved = if is_framed { whole } else { sides_moved };
        let taken = self.viscous(coordinate, c, &passage) * moved;
        let Some(dry) = self.law.as_ref().and_then(Law::dry) else { return [given, taken] };
        let [force, _] = self.dry_force(dry, coordinate, c, &passage);
        [given, taken + force * moved - dry.stored(self.remembered(c), whole)]
    }

    /// Power at an instant with the velocities `velocity`, W: what moving frames put in, and what the damper takes out.
    pub fn power(&self, coordinate: &RelativeCoordinate, c: &Configuration, velocity: &[f64]) -> [f64; 2] {
        if self.is_idle() {
            return [0.0; 2];
        }
        let passage = Passage::with_velocity(velocity);
        let [sides_moved, whole] = [coordinate.change(c, velocity), coordinate.rate(c, velocity)];
        let is_framed = Self::is_framed(coordinate);
        let given = if is_framed { self.tension(coordinate, c, &passage) * (whole - sides_moved) } else { 0.0 };
        let moved = if is_framed { whole } else { sides_moved };
        [given, (self.viscous(coordinate, c, &passage) + self.sliding(coordinate, c, moved)) * moved]
    }

    /// Minus its forces on the vectors of both poses.
    pub fn tension_x(&self, coordinate: &RelativeCoordinate, c: &Configuration, passage: &Passage) -> PairVector {
        if self.is_idle() {
            return PairVector::zeros();
        }
        coordinate.measure.gradient(&coordinate.a.pose(c), &coordinate.b.pose(c)) * self.tension(coordinate, c, passage)
    }

    /// Whether it does nothing now. Its measure may have no meaning then: the rotation vector of parts that turn
    /// freely.
    pub fn is_idle(&self) -> bool {
        self.stiffness == 0.0 && self.damping == 0.0 && self.law.is_none()
    }

    /// Whether it has a damper.
    pub fn is_damped(&self) -> bool {
        self.law.as_ref().map_or(self.damping != 0.0, Law::is_damped)
    }
}

/// The mean force over a step minus that in time, over its difference from that of both halves: errors of means fall as
/// the square of the length.
const RICHARDSON: f64 = 4.0 / 3.0;

/// How far from the middle of a step of `duration` s towards its end the rate of a damper is taken that takes motion at
/// `decay_rate`, 1/s.
fn lateness(decay_rate: f64, duration: f64) -> f64 {
    1.0 - 2.0 / (decay_rate * duration).max(2.0)
}

/// The damping matrix of a damper of strength `damping`.
fn damping_blocks(coordinate: &RelativeCoordinate, c: &Configuration, damping: f64) -> [MarkerMatrix; 4] {
    let here = coordinate.gradient(c);
    let mut blocks = [MarkerMatrix::zeros(); 4];
    add_products(&here, &here, damping, &mut blocks);
    blocks
}

/// Adds the part of [`Spring::hessian`] by which the force of a law changes.
fn add_law_hessian(
    force: &LawForce,
    coordinate: &RelativeCoordinate,
    c: &Configuration,
    passage: &Passage,
    blocks: &mut [MarkerMatrix; 4],
) {
    let here = coordinate.gradient(c);
    match passage {
        Passage::Rest | Passage::Corrected(_) => add_products(&here, &here, force.by_x, blocks),
        Passage::Step(TimeStep { end, duration, .. }) => {
            let by_end = 2.0 * (force.by_x + force.by_v / duration);
            add_products(&here, &coordinate.gradient(end), by_end, blocks);
        }
        Passage::Instant { velocity, .. } => {
            add_products(&here, &here, force.by_x, blocks);
            add_products(&here, &coordinate.rate_gradient(c, velocity), force.by_v, blocks);
        }
    }
}

/// Adds `factor` times the products of both sides of `left` and `right` to the blocks `aa, ab, ba, bb`.
fn add_products(left: &[MarkerVector; 2], right: &[MarkerVector; 2], factor: f64, blocks: &mut [MarkerMatrix; 4]) {
    for (number, block) in blocks.iter_mut().enumerate() {
        block.ger(factor, &left[number / 2], &right[number % 2], 1.0);
    }
}
