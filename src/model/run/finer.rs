//! How far equilibria are off because of the mesh: they are found again on a mesh twice as fine, with quadratic twist.

use super::levels::{self, Level, Override};
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
}

impl Finer {
    /// That of `document`, which was read with `overrides`; none where its beams have no such mesh.
    pub fn new(document: &Document, overrides: &[Override]) -> Option<Self> {
        let finer = Level::DoubleElements.overrides(document)?;
        let elements: Vec<String> = finer.iter().map(|(key, _)| key.clone()).collect();
        let overrides = levels::merged(&document.remaining(overrides), finer);
        let mut other = Document::parse(&document.model.name, document.text(), &overrides).ok()?;
        // What a host has set since.
        for index in 0..other.parameters().len() {
            let parameter = &other.parameters()[index];
            let name = &parameter.variable.name;
            let own = document.parameters().iter().position(|own| own.variable.name == *name);
            if let Some(own) = own.filter(|_| !parameter.is_calculated() && !elements.contains(name)) {
                other.set_parameter(index, document.parameter_value(own)).ok()?;
            }
        }
        let built = builder::build(&other, 0.0).ok()?;
        let statics = Statics::new(&built.system, TOLERANCE);
        Some(Self { table: Table::new(&other), system: built.system, drawn: built.state, statics })
    }

    /// The results of the equilibrium near `state`, an equilibrium of `system`; none where Newton does not find it.
    pub fn results(&mut self, system: &System, state: &State) -> Option<Vec<f64>> {
        let mut own = self.drawn.clone();
        if !self.system.take_shape(&mut own, system, state) {
            return None;
        }
        self.statics.settle(&self.system, &mut own).ok()?;
        let mut response = Response::default();
        response.set_at_rest(&own);
        let (mut frames, mut results) = (FrameCache::default(), Vec::new());
        let moment = Moment { system: &self.system, state: &own, response: &response, fibers: &[] };
        self.table.measure(&moment, &mut frames, &mut results);
        Some(results)
    }
}
