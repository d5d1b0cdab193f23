//! The mesh error of equilibria: Newton finds them again on a mesh twice as fine, with quadratic twist.
//!
//! On a path by arc length it looks for the nearest point of the finer mesh's path. Under the same load there may be
//! none near a limit point, or a far one; the same arc length is another point on every mesh.

use super::levels::{self, Level, Override};
use crate::error::Error;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::model::builder;
use crate::model::file::document::Document;
use crate::model::variables::{Moment, Table};
use crate::solve::statics::Statics;
use crate::solve::step::response::Response;

/// Newton ends at a correction below this: what is left is far below what a mesh leaves.
const TOLERANCE: f64 = 1e-7;

/// A mechanism with twice the elements.
#[derive(Debug)]
pub struct Finer {
    table: Table,
    system: System,
    drawn: State,
    statics: Statics,
    /// Whether the equilibria are those of a path by arc length.
    is_path: bool,
}

impl Finer {
    /// Builds the mechanism of `document`, which was read with `overrides`, with twice the elements, as drawn at
    /// `start`, s; none if a beam has no such mesh.
    pub fn new(document: &Document, overrides: &[Override], start: f64) -> Option<Self> {
        let other = levels::changed(document, overrides, Level::DoubleElements.overrides(document)?)?;
        let built = builder::build(&other, document.drawn_at(start)).ok()?;
        let statics = Statics::new(&built.system, TOLERANCE);
        let is_path = document.follows_arc_length();
        let statics = if is_path { statics.follow_path(Vec::new()) } else { statics };
        Some(Self { table: Table::new(&other), system: built.system, drawn: built.state, statics, is_path })
    }

    /// The equilibrium near `state`, an equilibrium of `system`; none where its shape cannot be taken.
    ///
    /// # Errors
    /// Newton does not find it.
    pub fn settled(&mut self, system: &System, state: &State) -> Result<Option<State>, Error> {
        let mut own = self.drawn.clone();
        if !self.system.take_shape(&mut own, system, state) {
            return Ok(None);
        }
        match self.is_path {
            true => self.statics.settle_across(&self.system, &mut own)?,
            false => self.statics.settle(&self.system, &mut own)?,
        }
        Ok(Some(own))
    }

    /// The results of an equilibrium that has been [settled](Self::settled).
    pub fn results(&self, settled: &State) -> Vec<f64> {
        let mut response = Response::default();
        response.set_at_rest(settled);
        let (mut frames, mut results) = (FrameCache::default(), Vec::new());
        let moment = Moment { system: &self.system, state: settled, response: &response, fibers: &[] };
        self.table.measure(&moment, &mut frames, &mut results);
        results
    }

    /// Whether an equilibrium that has been [settled](Self::settled) is unstable.
    pub fn is_unstable(&mut self, settled: &State) -> bool {
        self.statics.is_unstable(&self.system, settled)
    }

    /// The time at which the path near two equilibria of `system` becomes unstable, s; none where that is not found.
    pub fn critical_time(&mut self, system: &System, path: &[State; 2]) -> Option<f64> {
        let [first, second] = path.each_ref().map(|state| self.settled(system, state).ok().flatten());
        self.statics.critical_time_by(&self.system, [&first?, &second?])
    }
}
