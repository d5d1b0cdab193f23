//! Where anchors are as drawn, as far as the file alone shows it.

use super::{Lines, carriers, vector};
use crate::math::rotation::rotation_matrix;
use crate::math::{Mat3, Vec3};
use crate::mechanics::geometry::triad::Triad;
use crate::model::file::document::Document;
use crate::model::file::reader::anchor::{Along, Anchor, Spot};

impl Lines {
    /// Place of an anchor as drawn, global, m; the ground itself has none.
    pub fn place(&self, document: &Document, anchor: Anchor) -> Option<Vec3> {
        let Some(point) = anchor.point else { return self.place_of(document, anchor.spot) };
        self.carried(document, anchor.spot, vector(document, document.points.get(point)?.offset)?)
    }

    /// Place as drawn, global, m, of what is `offset` away from a spot, in the axes of that.
    pub fn carried(&self, document: &Document, spot: Spot, offset: Vec3) -> Option<Vec3> {
        let axes = match spot {
            Spot::Ground => return Some(offset),
            Spot::Beam { beam, along } => self.section_axes(document, beam, along)?,
            Spot::Body(_) | Spot::Frame(_) => carriers::axes(document, spot)?,
        };
        Some(self.place_of(document, spot)? + axes * offset)
    }

    fn place_of(&self, document: &Document, spot: Spot) -> Option<Vec3> {
        match spot {
            Spot::Beam { beam, along } => {
                Some(self.line(beam)?.place(self.fraction(document, beam, along)?.clamp(0.0, 1.0)))
            }
            Spot::Ground | Spot::Body(_) | Spot::Frame(_) => carriers::position(document, spot),
        }
    }

    /// The section axes of a beam: exact at the nodes, between them as pictures need it.
    fn section_axes(&self, document: &Document, beam: usize, along: Along) -> Option<Mat3> {
        let (line, written) = (self.line(beam)?, document.beams.get(beam)?);
        let fraction = self.fraction(document, beam, along)?.clamp(0.0, 1.0);
        let mut triad = Triad::new(&line.nodes[0].tangent, &vector(document, written.y_axis)?);
        let mut turn = 0.0;
        for node in line.nodes.iter().take_while(|node| node.fraction <= fraction) {
            triad = triad.carried(&node.tangent);
            turn = node.turn;
        }
        let axes = Mat3::from_columns(&[triad.t, triad.u, triad.t.cross(&triad.u)]);
        let angle = turn + document.value(written.pretwist) * fraction;
        Some(axes * rotation_matrix(&(Vec3::x() * angle)))
    }
}
