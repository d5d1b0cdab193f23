//! Dry friction in a system: what it remembers.

use super::System;
use super::frame_cache::FrameCache;
use crate::mechanics::contact::grip::REMEMBERED;
use crate::mechanics::contact::{Contact, Ground};
use crate::mechanics::force::law::Law;
use crate::mechanics::force::rope::tensions::Hold;
use crate::mechanics::input::prescribed::Prescribed;
use crate::mechanics::marker::configuration::{Configuration, Passage};
use crate::mechanics::state::State;

impl System {
    /// Ends a step or an increment from `state` at the coordinates `q`, whose frames are `frames`, with what is
    /// `prescribed` there: forces remember what has changed, and references follow. `over` is the middle of a step and
    /// the step itself; none: of an increment.
    pub fn arrive(
        &self,
        state: &mut State,
        (q, frames, prescribed): (&[f64], &FrameCache, &Prescribed),
        over: Option<(&Configuration, &Passage)>,
    ) {
        if !state.memory.is_empty() {
            // Out of the state while the configuration looks at the rest of it.
            let mut memory = std::mem::take(&mut state.lists.memory);
            let reads = over.is_none() && (self.has_contact_friction() || !self.ropes.is_empty());
            let before = if reads { memory.clone() } else { Vec::new() };
            let end = Configuration { memory: &before, ..self.configuration(q, frames, state, prescribed) };
            self.remember(&end, over, &mut memory);
            state.lists.memory = memory;
        }
        state.q.copy_from_slice(q);
        state.prescribed.copy_from(prescribed);
        self.carry_references(state, frames);
    }

    /// Sets `memory`, that of the last accepted state, to what forces remember at `end`; `over` as [`Self::arrive`] has
    /// it. Without that, `end` has a copy of the memory.
    pub fn remember(&self, end: &Configuration, over: Option<(&Configuration, &Passage)>, memory: &mut [f64]) {
        for spring in &self.springs {
            if let (Some(index), Some(dry)) = (spring.memory, spring.law.as_ref().and_then(Law::dry)) {
                let way = spring.way(&self.relative_coordinates[spring.coordinate], end);
                memory[index] = dry.displaced(memory[index], way);
            }
        }
        self.remember_stations(end, memory);
        match over {
            Some((middle, passage)) => {
                self.remember_grips(middle, passage, memory);
                self.remember_ropes(middle, passage, memory);
            }
            None => {
                self.remember_grips(end, &Passage::Rest, memory);
                self.remember_ropes(end, &Passage::Rest, memory);
            }
        }
    }

    /// The names of the forces that remember, in the order of the memory of a state.
    pub fn memories(&self) -> impl Iterator<Item = String> + '_ {
        let springs = self.springs.iter().filter(|spring| spring.memory.is_some()).map(|spring| spring.name.clone());
        // A mesh of its own has cells of its own.
        let contacts = self.contacts.iter().filter(|contact| contact.friction.is_some()).flat_map(|contact| {
            let (count, beam) = (contact.elements.len(), &self.beam_of(contact.elements.start).0.name);
            let of_cell = move |number| format!("{} {beam} {} {count} {number}", contact.name, contact.surface.name);
            (0..count * REMEMBERED).map(of_cell)
        });
        let slides = self.slides().map(|(joint, _)| joint.name.clone());
        let ropes = self.ropes.iter().flat_map(|rope| {
            let of_seat = move |number| format!("{} {} {number}", rope.name, rope.seats.len());
            (0..rope.remembered()).map(of_seat)
        });
        springs.chain(contacts).chain(ropes).chain(slides)
    }

    /// Whether contacts have friction.
    pub fn has_contact_friction(&self) -> bool {
        self.contacts.iter().any(|contact| contact.friction.is_some())
    }

    /// Whether there is dry friction.
    pub fn has_dry_friction(&self) -> bool {
        self.contacts.iter().any(|contact| contact.friction.is_some_and(|own| own.coefficient != 0.0))
            || self.ropes.iter().any(|rope| matches!(rope.hold, Some(Hold::Friction(own)) if own != 0.0))
            || self.springs.iter().filter_map(|spring| spring.law.as_ref()).any(|law| law.coulomb() != 0.0)
    }

    /// The system without the friction of seabeds that begins behind the first equilibrium; none: it has no such
    /// friction.
    #[must_use]
    pub fn before_friction(&self) -> Option<Self> {
        let is_later = |contact: &Contact| contact.ground == Ground::Seabed { first: false };
        let is_rough = |contact: &Contact| contact.friction.is_some_and(|own| own.coefficient != 0.0);
        if !self.contacts.iter().any(|contact| is_later(contact) && is_rough(contact)) {
            return None;
        }
        let mut own = self.clone();
        let later = own.contacts.iter_mut().filter(|contact| is_later(contact));
        later.filter_map(|contact| contact.friction.as_mut()).for_each(|own| own.coefficient = 0.0);
        Some(own)
    }

    /// The system with the dry part of its friction taken off.
    #[must_use]
    pub fn without_dry_friction(&self) -> Self {
        let mut own = self.clone();
        own.contacts.iter_mut().filter_map(|contact| contact.friction.as_mut()).for_each(|own| own.coefficient = 0.0);
        for hold in own.ropes.iter_mut().filter_map(|rope| rope.hold.as_mut()) {
            if matches!(hold, Hold::Friction(_)) {
                *hold = Hold::Friction(0.0);
            }
        }
        own.springs.iter_mut().filter_map(|spring| spring.law.as_mut()).for_each(Law::take_dry_friction_off);
        own
    }
}
