//! The picture of a mechanism that `check --draw` writes.

use super::{Stop, output};
use ancf14::model::drawing::Drawing;
use ancf14_report::draw::{self, PROJECTIONS, Projection};
use ancf14_report::picture;
use std::path::Path;

/// A picture that is asked for: its kind follows from the ending of its name.
#[derive(Clone, Copy, Debug)]
pub struct Target<'a> {
    path: &'a Path,
    kind: Kind,
    view: Projection,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Svg,
    Png,
}

impl<'a> Target<'a> {
    /// The picture `path`, if it can be made, from a side.
    pub fn of(path: &'a Path, view: Projection) -> Result<Self, Stop> {
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
        Ok(Self { path, kind, view })
    }

    /// Draws the mechanism, and says so.
    pub fn draw(self, drawing: &Drawing, title: &str) -> Result<String, Stop> {
        let Self { path, kind, view } = self;
        let shown = path.display();
        match kind {
            Kind::Svg => {
                output::write(path, draw::svg(drawing, title, view).as_bytes()).map(|()| format!("drawn in {shown}"))
            }
            Kind::Png => output::write(path, &picture::page(drawing, view).map_err(|reason| undrawn(&*reason))?)
                .map(|()| format!("drawn in {shown}, without names: an SVG picture has them")),
        }
    }
}

/// The value of `--view`.
pub fn view(text: &str) -> Result<Projection, String> {
    let known = PROJECTIONS.map(|(word, _)| word);
    let found = PROJECTIONS.iter().find(|(word, _)| *word == text).map(|(_, view)| *view);
    found.ok_or_else(|| format!("one of {} was expected", known.join(", ")))
}

/// The message about a mechanism that cannot be drawn.
pub fn undrawn(reason: &dyn std::error::Error) -> Stop {
    Stop::Failed(format!("error: cannot draw the mechanism: {reason}"))
}
