//! The lists of numbers of a state, which small changes add to. A new list is one row here: clones, comparisons,
//! variations and saved states follow.

use serde::{Deserialize, Serialize};

/// How long a list is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Length {
    /// The same in all states of a system.
    Same,
    /// As many as there are coordinates, or none.
    CoordinatesOrNone,
    /// As many as there are strain rates, or none.
    RatesOrNone,
}

macro_rules! lists {
    ($($(#[$doc:meta])* $name:ident: $length:ident,)*) => {
        /// Lists of numbers; those of a small change are in units over those of whatever it is a derivative by.
        #[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
        pub struct Lists {
            $($(#[$doc])* pub $name: Vec<f64>,)*
        }

        impl Lists {
            const LENGTHS: &[Length] = &[$(Length::$length),*];

            /// All lists, in one order.
            pub fn each(&self) -> [&Vec<f64>; Self::LENGTHS.len()] {
                [$(&self.$name),*]
            }

            /// All lists, in the same order.
            pub fn each_mut(&mut self) -> [&mut Vec<f64>; Self::LENGTHS.len()] {
                [$(&mut self.$name),*]
            }
        }
    };
}

lists! {
    /// Coordinates: m, 1, rad.
    q: Same,
    /// Velocities of the coordinates, 1/s each.
    velocity: Same,
    /// Momenta of the coordinates, in charts centered at the nodes' own tangents.
    momentum: Same,
    /// Multipliers of the joints' conditions at the start of the last midpoint step, or at `time` by generalized-alpha,
    /// N or N m.
    multipliers: Same,
    /// The part of the momentum that the constraints do not allow, by their conditions: `s` of `P = M v + Gᵀ s`
    /// (MECHANICS 7.1, where it is `nu`), N s or N m s.
    constraint_momenta: Same,
    /// Rates over the last midpoint step, or at the start: of each element of ANCF14 three axial strains (1/s), then
    /// `g1`, `g2`, `tau` of each bending point (1/m/s, rad/m/s); then of the rates of all relative coordinates that
    /// have a spring (m/s, rad/s).
    strain_rates: Same,
    /// Numbers that forces remember, each force in its own units.
    memory: Same,
    /// By how much the rates that velocities make have led those over the step before, at the start of the last step,
    /// in the order of `strain_rates`; none before the first step of a motion and behind a switch.
    newest_leads: RatesOrNone,
    /// The same at the start of the step before.
    older_leads: RatesOrNone,
    /// The same a step earlier.
    oldest_leads: RatesOrNone,
    /// Rates of strains at `time`, as midpoint steps show them, in the order of `strain_rates`; none before the first
    /// step, and of systems without material damping.
    viscous_rates: RatesOrNone,
    /// The same at the start of the last step, between those over it and over the step before.
    viscous_rates_at_start: RatesOrNone,
    /// Second derivatives of the coordinates at `time`, which the equations hold for, 1/s² each: of generalized-alpha.
    acceleration: CoordinatesOrNone,
    /// The algorithmic ones, which velocities and coordinates follow from.
    algorithmic_acceleration: CoordinatesOrNone,
    /// The velocities that the accelerations of added mass are counted from less the projected ones (MECHANICS 11), 1/s
    /// each; none: before the first step, and of systems without water.
    velocity_lead: CoordinatesOrNone,
}

impl Lists {
    /// Whether all lists are as long as those of another state of the same system may be.
    pub fn has_the_shape_of(&self, other: &Self) -> bool {
        let lengths = self.each().into_iter().zip(other.each()).zip(Self::LENGTHS);
        let are_possible = lengths.into_iter().all(|((own, other_own), length)| match length {
            Length::Same => own.len() == other_own.len(),
            Length::CoordinatesOrNone => own.is_empty() || own.len() == other.q.len(),
            Length::RatesOrNone => own.is_empty() || own.len() == other.strain_rates.len(),
        });
        let [newest, older, oldest] = self.leads();
        let are_alike = |one: &[f64], other: &[f64]| one.len() == other.len();
        are_possible
            && are_alike(newest, older)
            && are_alike(older, oldest)
            && are_alike(&self.viscous_rates, &self.viscous_rates_at_start)
    }

    /// Sets all lists to zeros, as long as those of `other`.
    pub fn set_zero(&mut self, other: &Self) {
        for (own, other) in self.each_mut().into_iter().zip(other.each()) {
            own.clear();
            own.resize(other.len(), 0.0);
        }
    }

    /// Adds `factor` times `change`.
    pub fn add(&mut self, factor: f64, change: &Self) {
        for (own, change) in self.each_mut().into_iter().zip(change.each()) {
            own.iter_mut().zip(change).for_each(|(own, change)| *own += factor * change);
        }
    }

    /// Adds `weight` times what lies between `from` and `to`.
    pub fn add_between(&mut self, weight: f64, from: &Self, to: &Self) {
        for ((own, from), to) in self.each_mut().into_iter().zip(from.each()).zip(to.each()) {
            for ((own, from), to) in own.iter_mut().zip(from).zip(to) {
                *own += weight * (to - from);
            }
        }
    }

    /// The leads of rates, the newest first.
    pub fn leads(&self) -> [&Vec<f64>; 3] {
        [&self.newest_leads, &self.older_leads, &self.oldest_leads]
    }

    /// The leads of rates, the newest first.
    pub fn leads_mut(&mut self) -> [&mut Vec<f64>; 3] {
        [&mut self.newest_leads, &mut self.older_leads, &mut self.oldest_leads]
    }

    /// The rates of strains at `time`, where steps have shown any.
    pub fn known_viscous_rates(&self) -> Option<&[f64]> {
        (!self.viscous_rates.is_empty()).then_some(&self.viscous_rates)
    }
}

impl Clone for Lists {
    fn clone(&self) -> Self {
        let mut own = Self::default();
        own.clone_from(self);
        own
    }

    /// Keeps the memory that is there.
    fn clone_from(&mut self, source: &Self) {
        self.each_mut().into_iter().zip(source.each()).for_each(|(own, source)| own.clone_from(source));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lists that may be empty have the length of their kind or none, and those that belong together have one length.
    #[test]
    fn shapes() {
        let whole = || Lists { q: vec![1.0; 3], strain_rates: vec![1.0; 2], ..Lists::default() };
        let has_shape = |change: fn(&mut Lists)| {
            let mut own = whole();
            change(&mut own);
            own.has_the_shape_of(&whole())
        };
        assert!(has_shape(|_| {}));
        assert!(has_shape(|own| own.acceleration = vec![0.0; 3]));
        assert!(has_shape(|own| own.leads_mut().into_iter().for_each(|list| list.resize(2, 0.0))));
        assert!(!has_shape(|own| own.q.push(0.0)));
        assert!(!has_shape(|own| own.memory.push(0.0)));
        assert!(!has_shape(|own| own.acceleration = vec![0.0; 2]));
        assert!(!has_shape(|own| own.newest_leads = vec![0.0; 2]));
        assert!(!has_shape(|own| own.viscous_rates = vec![0.0; 2]));
    }
}
