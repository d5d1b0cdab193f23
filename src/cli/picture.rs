//! From a drawing to the pixels of a PNG picture.

use super::Stop;
use resvg::{
    render,
    tiny_skia::{Pixmap, Transform},
    usvg::{Options, Tree},
};

/// Pixels for each unit of the drawing.
const ENLARGED: f32 = 4.0;

/// The bytes of a PNG picture of an SVG drawing without text: no font is read, the same drawing gives the same bytes.
pub fn png(svg: &str) -> Result<Vec<u8>, Stop> {
    let failed = |reason: &dyn std::fmt::Display| Stop::Failed(format!("error: cannot draw the mechanism: {reason}"));
    let tree = Tree::from_str(svg, &Options::default()).map_err(|reason| failed(&reason))?;
    let [width, height] = [tree.size().width(), tree.size().height()].map(|length| (ENLARGED * length).round() as u32);
    let mut pixels = Pixmap::new(width, height).ok_or_else(|| failed(&"it has no size"))?;
    render(&tree, Transform::from_scale(ENLARGED, ENLARGED), &mut pixels.as_mut());
    pixels.encode_png().map_err(|reason| failed(&reason))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::draw;
    use ancf14::model::drawing::{Drawing, Line, LineKind};

    /// A beam along x is a blue bar across the middle of a white picture, at every call the same.
    #[test]
    fn a_beam_is_a_bar() {
        let ends = vec![[0.0; 3], [2.0, 0.0, 0.0]];
        let line = Line { name: "arm".to_owned(), kind: LineKind::Beam, points: ends.clone(), nodes: ends };
        let drawing = Drawing { lines: vec![line], ..Drawing::default() };
        let bytes = png(&draw::icon(&drawing)).unwrap();
        assert_eq!(bytes, png(&draw::icon(&drawing)).unwrap());
        let pixels = Pixmap::decode_png(&bytes).unwrap();
        assert_eq!((pixels.width(), pixels.height()), (800, 600));
        let colour = |x, y| {
            let pixel = pixels.pixel(x, y).unwrap();
            [pixel.red(), pixel.green(), pixel.blue(), pixel.alpha()]
        };
        assert_eq!(colour(400, 300), [0, 0x72, 0xb2, 255]);
        assert_eq!(colour(400, 340), [255; 4]);
        assert_eq!(colour(20, 300), [255; 4]);
    }
}
