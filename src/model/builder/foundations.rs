//! Foundations of the file as parts of the system.

use super::{Builder, vector};
use crate::math::{Mat3, Vec3};
use crate::mechanics::system::System;
use crate::model::file::document::Document;
use crate::model::file::entries::foundation::{Action, Axes, FoundationSpec};

impl Builder<'_> {
    pub(super) fn add_foundation(&mut self, written: &FoundationSpec) {
        let axes = match written.action {
            Action::Sided { axes: Axes::Global, .. } => Some(Mat3::identity()),
            Action::Sided { axes: Axes::Section, .. } => None,
            Action::Pushing { direction, .. } => {
                let direction = vector(self.document, direction).normalize();
                Some(Mat3::from_columns(&[direction, Vec3::zeros(), Vec3::zeros()]))
            }
        };
        let numbers = &self.document.numbers;
        let over = (written.beam, written.fractions(numbers));
        self.system.add_foundation(&written.name, over, axes, written.bedding(numbers));
    }
}

/// Sets stiffness and damping of foundations to those of now.
pub(super) fn retune(document: &Document, system: &mut System) {
    for (foundation, written) in system.foundations.iter_mut().zip(&document.foundations) {
        foundation.bedding = written.bedding(&document.numbers);
    }
}
