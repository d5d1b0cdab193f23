//! Springs and dampers: `stiffness (x − rest) + damping x'` against the reading `x` of a gauge, N or N m.
//!
//! Two-point springs, springs on the coordinate of a joint and the six of a bushing are all of this kind.

use super::configuration::{Configuration, Passage, TimeStep};
use super::gauge::{Gauge, Measure};
use super::joint::own_velocity;
use super::marker::{Marker, MarkerMatrix, MarkerVector};
use super::pair::{PairHessian, PairVector};
use super::pose::VECTORS;
use super::pose_gradient::{of_side, pull_back};

/// A spring with a damper.
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// Name in the model file, of the spring or of its joint.
    pub name: String,
    /// What it acts on, by the number of the gauge.
    pub gauge: usize,
    /// Stiffness, N/m or N m/rad.
    pub stiffness: f64,
    /// Damping, N s/m or N m s/rad.
    pub damping: f64,
    /// Reading at which it is free of force, m or rad.
    pub rest: f64,
    /// How easily a step moves the reading from where it is drawn: one over the mass or the moment of inertia behind it, which stiffness adds to, 1/kg or
    /// 1/(kg m²); 0 where it is not known.
    pub mobility: f64,
}

impl Spring {
    /// Its elastic energy, J.
    pub fn energy(&self, gauge: &Gauge, c: &Configuration) -> f64 {
        if self.is_idle() {
            return 0.0;
        }
        let stretch = self.reading(gauge, c) - self.rest;
        0.5 * self.stiffness * stretch * stretch
    }

    fn reading(&self, gauge: &Gauge, c: &Configuration) -> f64 {
        gauge.reading(c, c.readings[self.gauge])
    }

    /// Its force against the growing of the reading, N or N m; over a step that of the mean reading of both ends, with what numerical dissipation adds.
    pub fn tension(&self, gauge: &Gauge, c: &Configuration, passage: &Passage) -> f64 {
        let elastic = match passage {
            Passage::Rest | Passage::Instant(_) => self.reading(gauge, c) - self.rest,
            Passage::Step(step) => {
                let [start, end] = [step.start, step.end].map(|end| self.reading(gauge, end));
                let rate = (end - start) / step.duration;
                let unpredicted = step.unpredicted(step.dissipation, rate, c.mesh.gauge_rate(self.gauge));
                0.5 * (start + end) - self.rest + step.duration * unpredicted
            }
        };
        self.stiffness * elastic + self.damping * self.rate(gauge, c, passage)
    }

    /// The length of the vector between both sides in the middle of a step over the mean of both ends': a distance then works as much as its energy
    /// changes. 1 for everything else, and at an instant.
    fn shortening(&self, gauge: &Gauge, c: &Configuration, passage: &Passage) -> f64 {
        match passage {
            Passage::Step(step) if gauge.measure == Measure::Length => {
                let [start, end] = [step.start, step.end].map(|end| self.reading(gauge, end));
                2.0 * self.reading(gauge, c) / (start + end)
            }
            _ => 1.0,
        }
    }

    /// Rate of the reading, m/s or rad/s.
    fn rate(&self, gauge: &Gauge, c: &Configuration, passage: &Passage) -> f64 {
        if self.damping == 0.0 {
            return 0.0;
        }
        match passage {
            Passage::Rest => 0.0,
            Passage::Step(TimeStep { start, end, duration, velocity, .. }) => {
                let mean = (self.reading(gauge, end) - self.reading(gauge, start)) / duration;
                match self.lateness(*duration) {
                    0.0 => mean,
                    late => (1.0 + late) * mean - late * reading_rate(gauge, start, velocity),
                }
            }
            Passage::Instant(velocity) => reading_rate(gauge, c, velocity),
        }
    }

    /// Mean rate of the reading over a step, m/s or rad/s; 0 where it does nothing.
    pub fn step_rate(&self, gauge: &Gauge, step: &TimeStep) -> f64 {
        if self.is_idle() {
            return 0.0;
        }
        (self.reading(gauge, step.end) - self.reading(gauge, step.start)) / step.duration
    }

    /// How far from the middle of a step of `duration` s towards its end the damper's rate is taken, 0 to 1.
    ///
    /// In the middle, a damper `c` multiplies the rate of a mass `m` by `(1 − z/2)/(1 + z/2)` a step, `z = c h/m`: beyond `z = 2` the rate changes its
    /// sign with every step, and beyond 20 it hardly fades. Taken later by `1 − 2/z`, it makes the factor 0.
    fn lateness(&self, duration: f64) -> f64 {
        1.0 - 2.0 / (self.decay_rate() * duration).max(2.0)
    }

    /// How fast the damper takes the motion of the mass that it holds, `c/m`, 1/s; 0 where that mass is not known.
    pub fn decay_rate(&self) -> f64 {
        self.damping * self.mobility
    }

    /// Generalized forces against the motion of both sides, 24×1 each: the gradient of the energy, and the damper's part.
    pub fn gradient(&self, gauge: &Gauge, c: &Configuration, passage: &Passage) -> [MarkerVector; 2] {
        if self.is_idle() {
            return [MarkerVector::zeros(); 2];
        }
        let tension = self.tension(gauge, c, passage) * self.shortening(gauge, c, passage);
        reading_q(gauge, c).map(|by_side| by_side * tension)
    }

    /// Derivative of [`Self::gradient`] by the coordinates of both sides, blocks `aa, ab, ba, bb`; over a step twice that by
    /// the coordinates at its end. At an instant the velocities are fixed.
    pub fn hessian(&self, gauge: &Gauge, c: &Configuration, passage: &Passage) -> [MarkerMatrix; 4] {
        if self.is_idle() {
            return [MarkerMatrix::zeros(); 4];
        }
        let (a, b) = (gauge.a.pose(c), gauge.b.pose(c));
        let tension = self.tension(gauge, c, passage) * self.shortening(gauge, c, passage);
        let by_poses = gauge.measure.gradient(&a, &b);
        let mut hessian = PairHessian::default();
        gauge.measure.add_hessian(&a, &b, tension, &mut hessian);
        let mut blocks = [MarkerMatrix::zeros(); 4];
        let sides = [gauge.a.pose_q(c), gauge.b.pose_q(c)];
        pull_back(c, [&gauge.a, &gauge.b], &sides, &(by_poses * tension), &hessian, &mut blocks);
        let here = reading_q(gauge, c);
        match passage {
            Passage::Rest => add_products(&here, &here, self.stiffness, &mut blocks),
            Passage::Step(TimeStep { end, duration, dissipation, .. }) => {
                let viscous = 2.0 * self.damping * (1.0 + self.lateness(*duration)) / duration;
                let stiffness = self.stiffness * (1.0 + 2.0 * dissipation.sum()) + viscous;
                add_products(&here, &reading_q(gauge, end), stiffness, &mut blocks);
            }
            Passage::Instant(velocity) => {
                add_products(&here, &here, self.stiffness, &mut blocks);
                if self.damping != 0.0 {
                    add_products(&here, &reading_rate_q(gauge, c, velocity), self.damping, &mut blocks);
                }
            }
        }
        blocks
    }

    /// Derivative of [`Self::gradient`] by the velocities of both sides, blocks `aa, ab, ba, bb`.
    pub fn damping_matrix(&self, gauge: &Gauge, c: &Configuration) -> [MarkerMatrix; 4] {
        let here = reading_q(gauge, c);
        let mut blocks = [MarkerMatrix::zeros(); 4];
        add_products(&here, &here, self.damping, &mut blocks);
        blocks
    }

    /// What moving frames put into the system through the spring, and what the damper takes out, while the reading changes by `whole`, of which
    /// `sides_moved` is by the coordinates alone.
    fn outside_work(&self, gauge: &Gauge, tension: f64, viscous: f64, [sides_moved, whole]: [f64; 2]) -> [f64; 2] {
        let is_framed = [gauge.a, gauge.b].iter().any(|side| matches!(side, Marker::Frame { .. }));
        let by_frames = if is_framed { (tension - viscous) * (whole - sides_moved) } else { 0.0 };
        [by_frames, viscous * sides_moved]
    }

    /// Work over `step`, whose middle is `c`, J, as the step takes its forces: what moving frames put in less what the damper takes out.
    pub fn step_work(&self, gauge: &Gauge, c: &Configuration, step: &TimeStep) -> f64 {
        if self.is_idle() {
            return 0.0;
        }
        let passage = Passage::Step(*step);
        let (tension, viscous) = (self.tension(gauge, c, &passage), self.damping * self.rate(gauge, c, &passage));
        let whole = self.reading(gauge, step.end) - self.reading(gauge, step.start);
        let sides_moved = along(gauge, c, step.increment) * self.shortening(gauge, c, &passage);
        let [given, taken] = self.outside_work(gauge, tension, viscous, [sides_moved, whole]);
        given - taken
    }

    /// Power at an instant with the velocities `velocity`, W: what moving frames put in, and what the damper takes out.
    pub fn power(&self, gauge: &Gauge, c: &Configuration, velocity: &[f64]) -> [f64; 2] {
        if self.is_idle() {
            return [0.0; 2];
        }
        let passage = Passage::Instant(velocity);
        let (tension, viscous) = (self.tension(gauge, c, &passage), self.damping * self.rate(gauge, c, &passage));
        self.outside_work(gauge, tension, viscous, [along(gauge, c, velocity), reading_rate(gauge, c, velocity)])
    }

    /// Minus its forces on the vectors of both poses.
    pub fn tension_x(&self, gauge: &Gauge, c: &Configuration, passage: &Passage) -> PairVector {
        if self.is_idle() {
            return PairVector::zeros();
        }
        gauge.measure.gradient(&gauge.a.pose(c), &gauge.b.pose(c)) * self.tension(gauge, c, passage)
    }

    /// Whether it does nothing now. Its measure may have no meaning then: the rotation vector of parts that turn freely.
    pub fn is_idle(&self) -> bool {
        self.stiffness == 0.0 && self.damping == 0.0
    }
}

/// Reading of a gauge by the coordinates of both its sides, 24×1 each.
pub fn reading_q(gauge: &Gauge, c: &Configuration) -> [MarkerVector; 2] {
    let by_poses = gauge.measure.gradient(&gauge.a.pose(c), &gauge.b.pose(c));
    [gauge.a.pose_q(c).generalized(&of_side(&by_poses, 0)), gauge.b.pose_q(c).generalized(&of_side(&by_poses, 1))]
}

/// Change of the reading of a gauge when the coordinates change by `change`, to first order.
fn along(gauge: &Gauge, c: &Configuration, change: &[f64]) -> f64 {
    let sides = reading_q(gauge, c).into_iter().zip([&gauge.a, &gauge.b]);
    sides.map(|(by_side, marker)| by_side.dot(&own_velocity(c, marker, change))).sum()
}

/// Adds `factor` times the products of both sides of `left` and `right` to the blocks `aa, ab, ba, bb`.
fn add_products(left: &[MarkerVector; 2], right: &[MarkerVector; 2], factor: f64, blocks: &mut [MarkerMatrix; 4]) {
    for (number, block) in blocks.iter_mut().enumerate() {
        block.ger(factor, &left[number / 2], &right[number % 2], 1.0);
    }
}

/// How fast the poses of both sides change, 24×1.
fn pose_rates(gauge: &Gauge, c: &Configuration, velocity: &[f64]) -> PairVector {
    let mut rates = PairVector::zeros();
    for (side, marker) in [&gauge.a, &gauge.b].into_iter().enumerate() {
        let rate = marker.pose_q(c).times(&own_velocity(c, marker, velocity)) + marker.pose_t(c)[0].vectors();
        rates.fixed_columns_mut::<VECTORS>(VECTORS * side).copy_from(&rate);
    }
    rates
}

/// Rate of the reading of a gauge, m/s or rad/s.
pub fn reading_rate(gauge: &Gauge, c: &Configuration, velocity: &[f64]) -> f64 {
    gauge.measure.gradient(&gauge.a.pose(c), &gauge.b.pose(c)).dot(&pose_rates(gauge, c, velocity))
}

/// Derivative of the rate of the reading by the coordinates of both sides at fixed velocities, 24×1 each.
fn reading_rate_q(gauge: &Gauge, c: &Configuration, velocity: &[f64]) -> [MarkerVector; 2] {
    let (a, b) = (gauge.a.pose(c), gauge.b.pose(c));
    let by_poses = gauge.measure.gradient(&a, &b);
    let mut hessian = PairHessian::default();
    gauge.measure.add_hessian(&a, &b, 1.0, &mut hessian);
    let turned = hessian.times(&pose_rates(gauge, c, velocity));
    [(0, &gauge.a), (1, &gauge.b)].map(|(number, marker)| {
        let (own, pose_q) = (own_velocity(c, marker, velocity), marker.pose_q(c));
        let mut bend = MarkerMatrix::zeros();
        pose_q.add_bend(marker, c, &of_side(&by_poses, number), &mut bend);
        pose_q.generalized(&of_side(&turned, number)) + bend.tr_mul(&own)
    })
}
