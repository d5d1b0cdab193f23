//! Where anchors are as drawn, as far as the file alone shows it.

use super::{Lines, vector};
use crate::math::rotation::{quaternion_matrix, rotation_matrix};
use crate::math::{Mat3, Vec3};
use crate::mechanics::geometry::triad::Triad;
use crate::model::file::document::Document;
use crate::model::file::entries::frame::Orientation;
use crate::model::file::number::Number;
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
            Spot::Body(body) => document.bodies.get(body)?.axes.map_or(Some(Mat3::identity()), |rows| {
                let [x, y, z] = rows.map(|row| vector(document, row));
                Some(Mat3::from_columns(&[x?, y?, z?]))
            })?,
            Spot::Frame(frame) => frame_axes(document, document.frames.get(frame)?.orientation)?,
        };
        Some(self.place_of(document, spot)? + axes * offset)
    }

    fn place_of(&self, document: &Document, spot: Spot) -> Option<Vec3> {
        match spot {
            Spot::Ground => None,
            Spot::Beam { beam, along } => {
                Some(self.line(beam)?.place(self.fraction(document, beam, along)?.clamp(0.0, 1.0)))
            }
            Spot::Body(body) => Some(Vec3::from(document.vector(document.bodies.get(body)?.position))),
            Spot::Frame(frame) => Some(Vec3::from(drawn(document, document.frames.get(frame)?.position))),
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

/// Numbers of a frame as drawn: a preload begins before t = 0.
fn drawn(document: &Document, numbers: [Number; 3]) -> [f64; 3] {
    match document.simulation.preload {
        Some(_) => numbers.map(|number| document.function(number).value(document.drawn_at(0.0))),
        None => document.vector(numbers),
    }
}

/// The axes of a frame as drawn.
fn frame_axes(document: &Document, orientation: Orientation) -> Option<Mat3> {
    match orientation {
        Orientation::Rotation(numbers) => {
            vector(document, numbers).map(|_| rotation_matrix(&Vec3::from(drawn(document, numbers))))
        }
        Orientation::Quaternion(numbers) => {
            let parts = numbers.map(|number| document.value(number));
            let length = parts.iter().map(|part| part * part).sum::<f64>().sqrt();
            (length > 0.0).then(|| quaternion_matrix(parts.map(|part| part / length.max(f64::MIN_POSITIVE))))
        }
    }
}
