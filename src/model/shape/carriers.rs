//! Where bodies and frames are as drawn.

use super::vector;
use crate::math::rotation::{quaternion_matrix, rotation_matrix};
use crate::math::{Mat3, Vec3};
use crate::model::file::document::Document;
use crate::model::file::entries::frame::Orientation;
use crate::model::file::number::Number;
use crate::model::file::reader::anchor::Spot;

/// Position of a body or a frame, global, m; none: of the ground, and of beams.
pub(super) fn position(document: &Document, spot: Spot) -> Option<Vec3> {
    match spot {
        Spot::Ground | Spot::Beam { .. } => None,
        Spot::Body(body) => Some(Vec3::from(document.vector(document.bodies.get(body)?.position))),
        Spot::Frame(frame) => Some(Vec3::from(drawn(document, document.frames.get(frame)?.position))),
    }
}

/// Axes of a body or a frame, global; none: of the ground, of beams, and where a number is wrong.
pub(super) fn axes(document: &Document, spot: Spot) -> Option<Mat3> {
    match spot {
        Spot::Ground | Spot::Beam { .. } => None,
        Spot::Body(body) => document.bodies.get(body)?.axes.map_or(Some(Mat3::identity()), |rows| {
            let [x, y, z] = rows.map(|row| vector(document, row));
            Some(Mat3::from_columns(&[x?, y?, z?]))
        }),
        Spot::Frame(frame) => frame_axes(document, document.frames.get(frame)?.orientation),
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
