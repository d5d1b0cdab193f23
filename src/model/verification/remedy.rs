//! The cheapest setting that reaches a wanted accuracy, by the orders of the parts of the error.

use super::estimate::Parts;
use crate::math::elementary::pow;

/// Numbers of steps in place of one, and of elements in place of one, that are proposed: steps stay numbers of few
/// digits, and nodes stay where joints need them. Beyond the last ones the system, or its model, should be another one.
const STEPS: [u32; 16] = [1, 2, 4, 5, 8, 10, 20, 25, 40, 50, 80, 100, 200, 400, 500, 1000];
const ELEMENTS: [u32; 10] = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32];

/// What to change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Setting {
    /// Steps in place of one.
    pub steps: u32,
    /// Elements in place of one.
    pub elements: u32,
    /// Quadratic twist in all beams.
    pub quadratic: bool,
}

/// What one column asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demand {
    /// The parts of its error, in its unit.
    pub parts: Parts,
    /// The largest error wanted, in the same unit.
    pub allowed: f64,
}

impl Demand {
    /// The error that a setting leaves, in the column's unit.
    fn error(&self, setting: Setting) -> f64 {
        let Parts { step, twist, elements } = self.parts;
        let fallen = |(error, order): (f64, f64), finer: u32| error / pow(f64::from(finer), order);
        let twist = if setting.quadratic { 0.0 } else { fallen(twist, setting.elements) };
        fallen(step, setting.steps) + twist + fallen(elements, setting.elements)
    }
}

/// The setting with the least work, steps times elements, that meets all demands; among equals the one that changes
/// least. None: not one of those that are proposed.
pub fn cheapest(demands: &[Demand]) -> Option<Setting> {
    let meshes = [false, true].into_iter().flat_map(|quadratic| ELEMENTS.map(|elements| (quadratic, elements)));
    let settings = meshes.filter_map(|(quadratic, elements)| {
        let with = |steps: u32| Setting { steps, elements, quadratic };
        let steps = STEPS
            .into_iter()
            .find(|steps| demands.iter().all(|demand| demand.error(with(*steps)) <= demand.allowed))?;
        Some(with(steps))
    });
    settings.min_by_key(|setting| setting.steps * setting.elements)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn demand(step: f64, twist: f64, elements: f64) -> Demand {
        Demand { parts: Parts { step: (step, 2.0), twist: (twist, 2.0), elements: (elements, 4.0) }, allowed: 1.0 }
    }

    fn setting(steps: u32, elements: u32, quadratic: bool) -> Option<Setting> {
        Some(Setting { steps, elements, quadratic })
    }

    /// What limits is refined, by its order, and nothing else; quadratic twist costs nothing.
    #[test]
    fn the_limit_is_refined() {
        assert_eq!(cheapest(&[]), setting(1, 1, false));
        assert_eq!(cheapest(&[demand(3.9, 0.0, 0.0)]), setting(2, 1, false));
        assert_eq!(cheapest(&[demand(0.0, 0.0, 15.0)]), setting(1, 2, false));
        assert_eq!(cheapest(&[demand(0.0, 30.0, 0.5)]), setting(1, 1, true));
        assert_eq!(cheapest(&[demand(0.0, 30.0, 15.0)]), setting(1, 2, true));
    }

    /// Several columns are met together, each with what the others need.
    #[test]
    fn all_demands_are_met() {
        assert_eq!(cheapest(&[demand(3.9, 0.0, 0.0), demand(0.0, 0.0, 15.0)]), setting(2, 2, false));
        // Half of the error from each part: one of them must fall further.
        assert_eq!(cheapest(&[demand(0.9, 0.0, 0.9)]), setting(1, 2, false));
    }

    /// Where the order is low no setting is far enough.
    #[test]
    fn some_demands_are_never_met() {
        let slow = Parts { step: (50.0, 0.3), twist: (0.0, 2.0), elements: (0.0, 4.0) };
        assert_eq!(cheapest(&[Demand { parts: slow, allowed: 1.0 }]), None);
    }
}
