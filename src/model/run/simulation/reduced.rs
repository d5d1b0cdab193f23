//! Linear systems with fewer states, and the responses of whole ones.

use super::linear::{Linear, Pole, PoleKind, Signal, check_poles, not_found};
use super::{Simulation, wrong};
use crate::fmi::Failure;
use crate::solve::linearization::split::{Origin, Refusal, Whole, split};
use crate::solve::linearization::state_space::StateSpace;
use crate::solve::linearization::truncation::{self, Rule, Truncated};
use crate::solve::linearization::{component_modes, responses};

pub use crate::solve::linearization::responses::Responses;
pub use crate::solve::linearization::truncation::Size;

/// How states are left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Those that inputs move and outputs see least.
    Balanced,
    /// Modes with the smallest peaks, whose static responses stay.
    Modal,
    /// All but the softest vibrations with prescribed motions held, and the static responses to inputs.
    CraigBampton,
}

/// A linear system with fewer states.
#[derive(Clone, Debug)]
pub struct Reduced {
    /// The system; [`Linear::poles`] are those of the whole one.
    pub linear: Linear,
    /// Its poles.
    pub poles: Vec<Pole>,
    /// How many states the whole system has.
    pub whole: usize,
    /// How many states are kept exactly: those of poles that do not fade.
    pub kept: usize,
    /// The bound of the error over the response to a sudden change of an input; none: the method has none.
    pub bound: Option<f64>,
    /// The largest error that the responses at many frequencies show, over the same.
    pub error: f64,
}

impl Linear {
    /// The same system with fewer states.
    ///
    /// # Errors
    /// There are no inputs or outputs, too many states, or more poles that do not fade than states are wanted.
    pub fn reduce(&self, simulation: &Simulation, size: Size, method: Method) -> Result<Reduced, Failure> {
        let (states, whole) = (self.states.len(), self.whole(simulation, "a reduction")?);
        let zeros = whole.zeros;
        let found = match method {
            Method::Balanced => truncation::reduce(&whole, size, Rule::Balanced),
            Method::Modal => truncation::reduce(&whole, size, Rule::Modal),
            Method::CraigBampton => {
                component_modes::reduce(&whole, &self.second_order(simulation, &whole.matrices)?, size)
            }
        };
        let Truncated { matrices, origins, kept, bound, error } = found.map_err(|refusal| match refusal {
            Refusal::NotFound => not_found(),
            Refusal::Kept(kept) => wrong(format!(
                "{kept} states have poles that do not fade, and a reduction keeps them; ask for at least {kept} \
                 states, or give materials and joints their damping"
            )),
            Refusal::Held(held) => wrong(format!(
                "craig-bampton keeps the static responses to the inputs, poles that do not fade, and values and rates \
                 of prescribed motions, which are {held} states here; ask for at least {held}, or take \
                 --method balanced"
            )),
            Refusal::Asymmetric(share) => wrong(format!(
                "craig-bampton needs a symmetric stiffness, and {share:.1e} of that about this state is not: loads \
                 that follow the motion, efforts by readings, sliding friction and damping that rotates do this; take \
                 --method balanced"
            )),
        })?;
        if error.is_infinite() {
            let message = "the reduced system has other undamped motions than the whole one, and its error is not \
                           known; give motions that take no load a stiffness, or take --method balanced";
            return Err(wrong(message.to_owned()));
        }
        let rest = match method {
            // Those at 0 have a block of their own, the first one.
            Method::Balanced | Method::Modal => {
                let own: Vec<usize> = (zeros..matrices.a.rows).collect();
                matrices.a.rows_of(&own).transposed().rows_of(&own).transposed()
            }
            Method::CraigBampton => {
                let own = Whole { matrices: matrices.clone(), ..whole };
                split(&own).map_err(|_| not_found())?.2.a
            }
        };
        let found = rest.eigenvectors().map_err(|_| not_found())?.into_iter().map(|(value, _)| [value.re, value.im]);
        let found = found.filter(|value| value[1] >= 0.0).map(pole);
        let mut poles: Vec<Pole> = vec![pole([0.0; 2]); zeros].into_iter().chain(found).collect();
        poles.sort_by(|a, b| a.natural_frequency().total_cmp(&b.natural_frequency()));
        let mut numbers = [0; 5];
        let mut name = |origin: &Origin| {
            let (number, word, ending) = match *origin {
                Origin::State(state) => return self.states[state].clone(),
                Origin::Mode => (0, "mode", ""),
                Origin::ModeRate => (1, "mode", ".rate"),
                Origin::Static => (2, "static", ""),
                Origin::StaticRate => (3, "static", ".rate"),
                Origin::Balanced => (4, "balanced", ""),
            };
            numbers[number] += 1;
            Signal { name: format!("{word}[{}]{ending}", numbers[number]), unit: String::new(), value: 0.0 }
        };
        let signals = origins.iter().map(&mut name).collect();
        let StateSpace { a, b, c, d } = matrices;
        let mut linear = self.clone();
        linear.states = signals;
        (linear.a, linear.b, linear.c, linear.d) = (a, b, c, d);
        Ok(Reduced { linear, poles, whole: states, kept, bound, error })
    }
}

impl Linear {
    /// The responses to inputs that vibrate, between two frequencies, rad/s; none: about the softest vibrations.
    ///
    /// # Errors
    /// There are no inputs or outputs, or too many states.
    pub fn responses(&self, simulation: &Simulation, range: Option<[f64; 2]>) -> Result<Responses, Failure> {
        let whole = self.whole(simulation, "a response")?;
        responses::responses(&whole, range).map_err(|_| not_found())
    }

    /// The system with its poles at 0 counted, for `what`.
    fn whole(&self, simulation: &Simulation, what: &str) -> Result<Whole, Failure> {
        if self.inputs.is_empty() || self.outputs.is_empty() {
            return Err(wrong(format!(
                "{what} needs inputs and outputs, and this system lacks them; name them with --inputs and --outputs"
            )));
        }
        check_poles(self.states.len())?;
        let (rigid, others): (Vec<Pole>, Vec<Pole>) =
            self.poles(simulation)?.into_iter().partition(|pole| pole.kind == PoleKind::Rigid);
        let slowest = others.first().map_or(1.0, Pole::natural_frequency);
        let rigid: usize = rigid.iter().map(|pole| if pole.value[1] > 0.0 { 2 } else { 1 }).sum();
        let Self { a, b, c, d, .. } = self.clone();
        let integrators = self.integrators();
        let kind = |output: &Signal| self.outputs.iter().position(|other| other.unit == output.unit);
        let kinds = self.outputs.iter().filter_map(kind).collect();
        let matrices = StateSpace { a, b, c, d };
        Ok(Whole { matrices, zeros: rigid + integrators, slowest, integrators, kinds })
    }
}

/// A pole without a shape.
fn pole(value: [f64; 2]) -> Pole {
    let kind = match value {
        [0.0, 0.0] => PoleKind::Rigid,
        [real, _] if real > 0.0 => PoleKind::Unstable,
        [_, swing] if swing > 0.0 => PoleKind::Oscillating,
        _ => PoleKind::Overdamped,
    };
    Pole { value, kind, shape: Vec::new(), parts: [Vec::new(), Vec::new()] }
}
