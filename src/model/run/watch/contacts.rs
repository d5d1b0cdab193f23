//! Whether contacts are stiff enough for what presses them.

use crate::error::decimal;
use crate::mechanics::contact::Ground;
use crate::mechanics::contact::mutual::BeamContact;
use crate::mechanics::marker::configuration::{Configuration, Passage};
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
        if self.warned || !system.has_contacts() {
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
        let on_surface = found.map(|(contact, depth, of)| {
            let on = format!("on surface {}", contact.surface.name);
            let sizes = [contact.law.stiffness, depth, contact.radius];
            (&contact.name, sizes, on, of, "the beam outside of the surface")
        });
        let mutual = || system.beam_contacts.iter().find_map(|contact| soft_beams(contact, &c));
        let (name, [stiffness, depth, radius], on, of, apart) = on_surface.or_else(mutual)?;
        self.warned = true;
        let remedy = match radius > 0.0 {
            true => format!(", draw {apart}, or set a smaller {name}.radius, which is {radius} m"),
            false => format!(", or draw {apart}"),
        };
        Some(format!(
            "contact {name} is penetrated by {depth:.2e} m {on} at t = {} s, more than {of}: its stiffness of \
             {stiffness:.2e} N/m2 decides the answer; raise {name}.stiffness{remedy}",
            decimal(state.instant()),
        ))
    }
}

/// A contact that is penetrated too far: name; stiffness, depth and radius of the beam; where, the bound, and what to
/// draw instead.
type Soft<'a> = (&'a String, [f64; 3], String, &'static str, &'static str);

/// Beams that are too deep inside each other.
fn soft_beams<'a>(contact: &'a BeamContact, c: &Configuration) -> Option<Soft<'a>> {
    let mut deepest = 0.0_f64;
    contact.each_meeting(c, &Passage::Rest, &mut |meeting| deepest = deepest.max(meeting.penetration));
    let thinner = contact.strands[0].radius.min(contact.strands[1].radius);
    let on = String::from("between beams");
    let sizes = [contact.law.stiffness, deepest, thinner];
    let soft = (&contact.name, sizes, on, "5 % of the radius of a beam", "the beams apart");
    (deepest > OF_BEAM * thinner).then_some(soft)
}
