//! Drawings as the pixels of a PNG picture.

use crate::draw::{self, Projection};
use ancf14::model::drawing::Drawing;
use resvg::{
    render,
    tiny_skia::{Pixmap, Transform},
    usvg::{Options, Tree},
};
use std::error::Error;

/// Pixels for each unit of the drawing: of an icon, of a page.
const ICON: f32 = 4.0;
const PAGE: f32 = 2.0;

/// The icon of a mechanism, a PNG picture.
///
/// # Errors
/// It cannot be drawn.
pub fn icon(drawing: &Drawing) -> Result<Vec<u8>, Box<dyn Error>> {
    png(&draw::icon(drawing), ICON)
}

/// A mechanism as drawn, without names, a PNG picture.
///
/// # Errors
/// It cannot be drawn.
pub fn page(drawing: &Drawing, projection: Projection) -> Result<Vec<u8>, Box<dyn Error>> {
    png(&draw::unnamed(drawing, projection), PAGE)
}

/// The bytes of a PNG picture of an SVG drawing without text: no font is read, the same drawing gives the same bytes.
fn png(svg: &str, enlarged: f32) -> Result<Vec<u8>, Box<dyn Error>> {
    let tree = Tree::from_str(svg, &Options::default())?;
    let [width, height] = [tree.size().width(), tree.size().height()].map(|length| (enlarged * length).round() as u32);
    let mut pixels = Pixmap::new(width, height).ok_or("it has no size")?;
    render(&tree, Transform::from_scale(enlarged, enlarged), &mut pixels.as_mut());
    Ok(pixels.encode_png()?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ancf14::model::drawing::{Line, LineKind};

    /// A beam along x is a blue bar across the middle of a white picture, at every call the same.
    #[test]
    fn a_beam_is_a_bar() {
        let ends = vec![[0.0; 3], [2.0, 0.0, 0.0]];
        let line = Line { name: "arm".to_owned(), kind: LineKind::Beam, points: ends.clone(), nodes: ends };
        let drawing = Drawing { lines: vec![line], ..Drawing::default() };
        let bytes = icon(&drawing).unwrap();
        assert_eq!(bytes, icon(&drawing).unwrap());
        let pixels = Pixmap::decode_png(&bytes).unwrap();
        assert_eq!((pixels.width(), pixels.height()), (800, 600));
        let color = |x, y| {
            let pixel = pixels.pixel(x, y).unwrap();
            [pixel.red(), pixel.green(), pixel.blue(), pixel.alpha()]
        };
        assert_eq!(color(400, 300), [0, 0x72, 0xb2, 255]);
        assert_eq!(color(400, 340), [255; 4]);
        assert_eq!(color(20, 300), [255; 4]);
    }
}
