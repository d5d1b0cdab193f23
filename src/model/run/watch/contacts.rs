//! Whether contacts are stiff enough for what presses them.

use crate::error::decimal;
use crate::mechanics::contact::Ground;
use crate::mechanics::marker::configuration::Passage;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use serde::{Deserialize, Serialize};

/// Penetrations above these shares of the radius of the beam and of that of the surface are told.
const OF_BEAM: f64 = 0.05;
const OF_SURFACE: f64 = 0.01;
/// The same of the size of the system, for a beam without thickness on a plane.
const OF_SIZE: f64 = 0.01;

/// The contacts that a run has been warned of.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ContactWatch {
    warned: bool,
}

impl ContactWatch {
    /// Looks at a new state, and warns of a contact that is penetrated further than its answer should bear.
    pub fn look(&mut self, system: &System, state: &State, snapshot: &mut FrameCache) -> Option<String> {
        if self.warned || system.contacts.is_empty() {
            return None;
        }
        let c = snapshot.of(system, state);
        // Beams sink into a seabed as far as it gives.
        let mut rigid = system.contacts.iter().filter(|contact| contact.ground == Ground::Rigid);
        let found = rigid.find_map(|contact| {
            let thick = if contact.radius > 0.0 { OF_BEAM * contact.radius } else { f64::INFINITY };
            let bounds = [
                (OF_SURFACE * contact.surface.shape.radius(), "1 % of the radius of the surface"),
                (thick, "5 % of the radius of the beam"),
                (OF_SIZE * system.size, "1 % of the size of the mechanism"),
            ];
            let (most, of) = bounds.into_iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
            let mut deepest = 0.0_f64;
            for element in &system.mesh.elements[contact.elements.clone()] {
                contact.each_touch(element, &c, &Passage::Rest, |touch| deepest = deepest.max(touch.penetration));
            }
            (deepest > most).then_some((contact, deepest, of))
        });
        let (contact, depth, of) = found?;
        self.warned = true;
        Some(format!(
            "contact {} is penetrated by {depth:.2e} m on surface {} at t = {} s, more than {of}: its stiffness of \
             {:.2e} N/m2 decides the answer; raise {}.stiffness, or draw the beam outside of the surface",
            contact.name,
            contact.surface.name,
            decimal(state.instant()),
            contact.law.stiffness,
            contact.name
        ))
    }
}
