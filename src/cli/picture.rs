//! From a drawing to the pixels of a PNG picture.

use super::{Stop, draw, output};
use ancf14::model::drawing::Drawing;
use resvg::{
    render,
    tiny_skia::{Pixmap, Transform},
    usvg::{Options, Tree},
};
use std::path::Path;

/// Pixels for each unit of the drawing: of an icon, of a page.
const ICON: f32 = 4.0;
const PAGE: f32 = 2.0;

/// A picture that is asked for: its kind follows from the ending of its name.
#[derive(Clone, Copy, Debug)]
pub struct Target<'a> {
    path: &'a Path,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Svg,
    Png,
}

impl<'a> Target<'a> {
    /// The picture `path`, if it can be made.
    pub fn of(path: &'a Path) -> Result<Self, Stop> {
        let ending = path.extension().map_or(String::new(), |ending| ending.to_string_lossy().to_ascii_lowercase());
        let kind = match ending.as_str() {
            "svg" => Kind::Svg,
            "png" => Kind::Png,
            _ => {
                let shown = path.display();
                return Err(Stop::Bad(format!(
                    "error: a drawing has a name that ends in .svg or .png, {shown} does not"
                )));
            }
        };
        Ok(Self { path, kind })
    }

    /// Draws the mechanism, and says so.
    pub fn draw(self, drawing: &Drawing, title: &str) -> Result<String, Stop> {
        let Self { path, kind } = self;
        let shown = path.display();
        match kind {
            Kind::Svg => {
                output::write(path, draw::svg(drawing, title).as_bytes()).map(|()| format!("drawn in {shown}"))
            }
            Kind::Png => output::write(path, &png(&draw::unnamed(drawing), PAGE)?)
                .map(|()| format!("drawn in {shown}, without names: an SVG picture has them")),
        }
    }
}

/// The icon of a mechanism, a PNG picture.
pub fn icon(drawing: &Drawing) -> Result<Vec<u8>, Stop> {
    png(&draw::icon(drawing), ICON)
}

/// The bytes of a PNG picture of an SVG drawing without text: no font is read, the same drawing gives the same bytes.
fn png(svg: &str, enlarged: f32) -> Result<Vec<u8>, Stop> {
    let failed = |reason: &dyn std::fmt::Display| Stop::Failed(format!("error: cannot draw the mechanism: {reason}"));
    let tree = Tree::from_str(svg, &Options::default()).map_err(|reason| failed(&reason))?;
    let [width, height] = [tree.size().width(), tree.size().height()].map(|length| (enlarged * length).round() as u32);
    let mut pixels = Pixmap::new(width, height).ok_or_else(|| failed(&"it has no size"))?;
    render(&tree, Transform::from_scale(enlarged, enlarged), &mut pixels.as_mut());
    pixels.encode_png().map_err(|reason| failed(&reason))
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
        let colour = |x, y| {
            let pixel = pixels.pixel(x, y).unwrap();
            [pixel.red(), pixel.green(), pixel.blue(), pixel.alpha()]
        };
        assert_eq!(colour(400, 300), [0, 0x72, 0xb2, 255]);
        assert_eq!(colour(400, 340), [255; 4]);
        assert_eq!(colour(20, 300), [255; 4]);
    }
}
