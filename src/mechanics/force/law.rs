//! Laws of springs, dampers, friction and stops: a force `f(x, v)` against an increase of `x`, N or N m. `x` is the
//! elongation, m or rad, and `v` its rate.
//!
//! `f(x, 0)` is elastic and has the energy `∫ f(x, 0) dx`. The rest, `f(x, v) − f(x, 0)`, is viscous. Over a step, both
//! are means over the way from the elongation at its start to that at its end: the elastic part works exactly as much
//! as the energy changes, and where the law has a kink or a jump, the force of the step is still a continuous function
//! of the end.

use super::dry_friction::DryFriction;
use crate::math::elementary::hypot;
use crate::math::integral::{integral_to_ends, integral_within};
use std::fmt;
use std::sync::Arc;

/// A function of the elongation and its rate: force, and its derivatives with respect to both.
pub type Function = Arc<dyn Fn(f64, f64) -> [f64; 3] + Send + Sync>;

/// A law that is not linear.
#[derive(Clone)]
pub enum Law {
    /// A linear spring and damper that act on one side of the free length only.
    OneSided {
        /// 1: while it is longer; -1: while it is shorter.
        sign: f64,
        /// N/m.
        stiffness: f64,
        /// N s/m.
        damping: f64,
    },
    /// A function of elongation and rate.
    Function {
        /// The function.
        function: Function,
        /// Whether it depends on the rate.
        has_rate: bool,
    },
    /// Dry friction that holds, and `viscous v`. The dry part depends on what the spring remembers: it is no function
    /// of elongation and rate.
    Friction {
        /// The dry part.
        dry: DryFriction,
        /// N s/m or N m s/rad.
        viscous: f64,
    },
    /// Friction without memory: `coulomb v/√(v² + speed²) + viscous v`.
    SmoothFriction {
        /// N or N m.
        coulomb: f64,
        /// N s/m or N m s/rad.
        viscous: f64,
        /// Below this rate it is not yet all there, m/s or rad/s.
        speed: f64,
    },
    /// Stops at one or both ends of the way: `stiffness p (1 + damping w)` at the penetration `p`, which grows at the
    /// rate `w`; it never pulls (Hunt and Crossley 1975).
    Stop {
        /// The lower one, which may be at minus infinity, and the upper one, m or rad.
        limits: [f64; 2],
        /// N/m or N m/rad.
        stiffness: f64,
        /// s/m or s/rad.
        damping: f64,
    },
}

impl fmt::Debug for Law {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OneSided { sign, stiffness, damping } => write!(f, "OneSided({sign}, {stiffness}, {damping})"),
            Self::Function { has_rate, .. } => write!(f, "Function(has_rate: {has_rate})"),
            Self::Friction { dry, viscous } => write!(f, "Friction({dry:?}, {viscous})"),
            Self::SmoothFriction { coulomb, viscous, speed } => {
                write!(f, "SmoothFriction({coulomb}, {viscous}, {speed})")
            }
            Self::Stop { limits, stiffness, damping } => write!(f, "Stop({limits:?}, {stiffness}, {damping})"),
        }
    }
}

/// The force of a law, at an instant or over a step, with its derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LawForce {
    /// The part without the rate, N or N m.
    pub elastic: f64,
    /// What the rate adds, N or N m.
    pub viscous: f64,
    /// Derivative of the sum with respect to the elongation, over a step to that at its end; the rate is fixed.
    pub by_x: f64,
    /// Derivative of the sum with respect to the rate.
    pub by_v: f64,
}

/// Intervals at most of the integral of a law over a step, and from 0 on: room for two jumps, and for ten.
const INTERVALS_OF_STEP: u32 = 120;
const INTERVALS_OF_ENERGY: u32 = 600;
/// Share of a derivative up to which it is integrated: no result depends on it, only how fast Newton converges.
const SLOPE_ERROR: f64 = 1e-10;
/// Where the force changes by less than this share over a step, the derivative of its mean is an integral: the
/// difference of the two would have lost too many digits.
const CANCELLATION: f64 = 1e-6;

impl Law {
    /// Its elastic energy at the elongation `x`, J.
    pub fn energy(&self, x: f64) -> f64 {
        match self {
            Self::OneSided { sign, stiffness, .. } => 0.5 * stiffness * (sign * x).max(0.0).powi(2),
            Self::Function { function, .. } => {
                let error = x.abs() * round_off(function(x, 0.0), x);
                integral_to_ends(&|x| function(x, 0.0)[0], 0.0, x, error, INTERVALS_OF_ENERGY)
            }
            Self::Friction { .. } | Self::SmoothFriction { .. } => 0.0,
            Self::Stop { limits: [lower, upper], stiffness, .. } => {
                0.5 * stiffness * ((lower - x).max(0.0).powi(2) + (x - upper).max(0.0).powi(2))
            }
        }
    }

    /// Its force at an instant.
    pub fn at(&self, x: f64, v: f64) -> LawForce {
        match self {
            Self::Function { function, .. } => {
                let [elastic, ..] = function(x, 0.0);
                let [force, by_x, by_v] = function(x, v);
                LawForce { elastic, viscous: force - elastic, by_x, by_v }
            }
            // Of a way without length, either end has half of the derivative.
            _ => {
                let force = self.over(x, x, v);
                LawForce { by_x: 2.0 * force.by_x, ..force }
            }
        }
    }

    /// Its force over a step from the elongation `start` to `end`, at the mean rate `v`.
    pub fn over(&self, start: f64, end: f64, v: f64) -> LawForce {
        match self {
            Self::OneSided { sign, stiffness, damping } => {
                let contact = Contact::over(sign * start, sign * end);
                LawForce {
                    elastic: sign * stiffness * contact.depth,
                    viscous: damping * v * contact.share,
                    by_x: stiffness * contact.depth_by_end + sign * damping * v * contact.share_by_end,
                    by_v: damping * contact.share,
                }
            }
            Self::Function { function, has_rate } => {
                let [elastic, slope] = mean(|x| function(x, 0.0), [start, end]);
                if !has_rate {
                    return LawForce { elastic, viscous: 0.0, by_x: slope, by_v: 0.0 };
                }
                let [force, by_x] = mean(|x| function(x, v), [start, end]);
                let way = end - start;
                let by_v = |s: f64| function(start + s * way, v)[2];
                let by_v = integral_within(&by_v, 0.0, 1.0, SLOPE_ERROR * by_v(0.5).abs());
                LawForce { elastic, viscous: force - elastic, by_x, by_v }
            }
            Self::Friction { viscous, .. } => LawForce { viscous: viscous * v, by_v: *viscous, ..LawForce::default() },
            Self::SmoothFriction { coulomb, viscous, speed } => {
                let whole = hypot(v, *speed);
                let by_v = coulomb * (speed / whole).powi(2) / whole + viscous;
                LawForce { viscous: coulomb * v / whole + viscous * v, by_v, ..LawForce::default() }
            }
            Self::Stop { limits, stiffness, damping } => {
                let mut sum = LawForce::default();
                for (sign, limit) in [(-1.0, limits[0]), (1.0, limits[1])] {
                    if limit.is_infinite() {
                        continue;
                    }
                    let contact = Contact::over(sign * (start - limit), sign * (end - limit));
                    let push = stiffness * contact.depth;
                    let factor = (damping * sign * v).max(-1.0);
                    sum.elastic += sign * push;
                    sum.viscous += sign * push * factor;
                    sum.by_x += stiffness * contact.depth_by_end * (1.0 + factor);
                    sum.by_v += if factor > -1.0 { push * damping } else { 0.0 };
                }
                sum
            }
        }
    }

    /// Its viscous friction, N s/m or N m s/rad: of friction alone.
    pub fn viscosity(&self) -> f64 {
        match self {
            Self::Friction { viscous, .. } | Self::SmoothFriction { viscous, .. } => *viscous,
            _ => 0.0,
        }
    }

    /// The part of friction that remembers.
    pub fn dry(&self) -> Option<&DryFriction> {
        if let Self::Friction { dry, .. } = self { Some(dry) } else { None }
    }

    /// Leaves of friction the viscous part.
    pub fn take_dry_friction_off(&mut self) {
        match self {
            Self::Friction { dry, .. } => dry.limit = 0.0,
            Self::SmoothFriction { coulomb, .. } => *coulomb = 0.0,
            _ => {}
        }
    }

    /// Dry friction at its largest, N or N m.
    pub fn coulomb(&self) -> f64 {
        match self {
            Self::Friction { dry, .. } => dry.limit,
            Self::SmoothFriction { coulomb, .. } => *coulomb,
            _ => 0.0,
        }
    }

    /// [`Self::over`] without [`Self::viscosity`].
    pub fn over_without_viscosity(&self, start: f64, end: f64, v: f64) -> LawForce {
        match self {
            Self::Friction { .. } => LawForce::default(),
            Self::SmoothFriction { coulomb, speed, .. } => {
                Self::SmoothFriction { coulomb: *coulomb, viscous: 0.0, speed: *speed }.over(start, end, v)
            }
            _ => self.over(start, end, v),
        }
    }

    /// Whether it has a part that depends on the rate.
    pub fn is_damped(&self) -> bool {
        match self {
            Self::OneSided { damping, .. } | Self::Stop { damping, .. } => *damping != 0.0,
            Self::Function { has_rate, .. } => *has_rate,
            Self::Friction { .. } | Self::SmoothFriction { .. } => self.coulomb() != 0.0 || self.viscosity() != 0.0,
        }
    }
}

/// What goes in depth over a step from `start` to `end`, where the depth is `max(y, 0)`.
struct Contact {
    /// Mean depth over the way.
    depth: f64,
    /// Its derivative with respect to the end.
    depth_by_end: f64,
    /// Share of the way that is in contact.
    share: f64,
    /// Its derivative with respect to the end.
    share_by_end: f64,
}

impl Contact {
    fn over(start: f64, end: f64) -> Self {
        match (start > 0.0, end > 0.0) {
            (true, true) => Self { depth: 0.5 * (start + end), depth_by_end: 0.5, share: 1.0, share_by_end: 0.0 },
            (false, false) => Self { depth: 0.0, depth_by_end: 0.0, share: 0.0, share_by_end: 0.0 },
            (false, true) => {
                let way = end - start;
                let share = end / way;
                let (depth, depth_by_end) = (0.5 * end * share, 0.5 * share * (2.0 - share));
                Self { depth, depth_by_end, share, share_by_end: (1.0 - share) / way }
            }
            (true, false) => {
                let way = start - end;
                let share = start / way;
                let (depth, depth_by_end) = (0.5 * start * share, 0.5 * share * share);
                Self { depth, depth_by_end, share, share_by_end: share / way }
            }
        }
    }
}

/// How exact a function is at `x` because of the round-off of `x` itself; `f` has value and derivative. None is known
/// where the derivative has no bounds.
fn round_off(f: [f64; 3], x: f64) -> f64 {
    let error = f64::EPSILON * (x * f[1]).abs();
    if error.is_finite() { error } else { 0.0 }
}

/// The mean of a function over the way from `start` to `end`, and its derivative with respect to the end; `f` has value
/// and derivative.
fn mean(f: impl Fn(f64) -> [f64; 3], [start, end]: [f64; 2]) -> [f64; 2] {
    let way = end - start;
    let last = f(end);
    let error = f64::max(round_off(f(start), start), round_off(last, end));
    let value = integral_to_ends(&|s| f(start + s * way)[0], 0.0, 1.0, error, INTERVALS_OF_STEP);
    let last = last[0];
    let change = last - value;
    let slope = if change.abs() > CANCELLATION * last.abs().max(value.abs()) {
        change / way
    } else {
        let middle = f(0.5 * (start + end))[1].abs();
        integral_within(&|s| s * f(start + s * way)[1], 0.0, 1.0, SLOPE_ERROR * middle)
    };
    [value, slope]
}
