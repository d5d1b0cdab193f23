//! Pictures of a mechanism, from several sides.

mod names;
mod page;
mod projection;
mod sheet;

pub use projection::{PROJECTIONS, Projection};

use ancf14::model::drawing::{ArrowKind, Drawing, LineKind, MarkKind};
use page::Page;
use sheet::{ICON, PAGE, View};

/// The picture; every name that can be read in it is one of the model file.
pub fn svg(drawing: &Drawing, title: &str, projection: Projection) -> String {
    picture(&View::of(drawing, PAGE, projection), drawing, title)
}

/// The picture on a page without a title that is only as high as the mechanism.
pub fn fitted(drawing: &Drawing, projection: Projection) -> String {
    picture(&View::fitted(drawing, projection), drawing, "")
}

fn picture(view: &View, drawing: &Drawing, title: &str) -> String {
    let mut page = Page::new(view);
    page.title(title);
    page.mechanism(drawing);
    page.write_names();
    page.axes();
    page.scale();
    page.end()
}

/// A mechanism is flat if it extends this little in one direction, as a share of the others.
const FLAT: f64 = 0.01;

/// The view that shows a flat mechanism as it is, and the oblique one of any other.
pub fn suited(drawing: &Drawing) -> Projection {
    let points = || drawing.lines.iter().flat_map(|line| &line.points).chain(drawing.marks.iter().map(|mark| &mark.at));
    let extents = [0, 1, 2].map(|axis| {
        let values = || points().map(|point| point[axis]);
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    });
    let is_thin = |axis: usize| (0..3).all(|other| other == axis || extents[axis] < FLAT * extents[other]);
    match [0, 1, 2].map(is_thin) {
        [true, false, false] => Projection::Side,
        [false, true, false] => Projection::Front,
        [false, false, true] => Projection::Top,
        _ => Projection::Oblique,
    }
}

/// The picture without names, nodes, axes and outputs, for a place as small as an icon.
pub fn icon(drawing: &Drawing) -> String {
    let mut drawing = drawing.clone();
    drawing.lines.iter_mut().for_each(|line| line.nodes.clear());
    drawing.marks.retain(|mark| mark.kind != MarkKind::Output);
    drawing.arrows.retain(|arrow| arrow.kind != ArrowKind::Axis);
    let view = View::of(&drawing, ICON, Projection::default());
    let mut page = Page::new(&view);
    page.mechanism(&drawing);
    page.end()
}

/// The page of [`svg`] without names, for pictures that have no text.
pub fn unnamed(drawing: &Drawing, projection: Projection) -> String {
    let view = View::of(drawing, PAGE, projection);
    let mut page = Page::new(&view);
    page.mechanism(drawing);
    page.end()
}

/// What the parts of a drawing stand for, of those that are in it.
pub fn legend(drawing: &Drawing) -> String {
    let line = |kind| drawing.lines.iter().any(|line| line.kind == kind);
    let mark = |kind| drawing.marks.iter().any(|mark| mark.kind == kind);
    let arrow = |kind| drawing.arrows.iter().any(|arrow| arrow.kind == kind);
    let parts = [
        (line(LineKind::Beam), "beams with their nodes (blue lines)"),
        (line(LineKind::Spring), "springs and ropes (dashed pink lines)"),
        (line(LineKind::Face), "surfaces (thin grey lines)"),
        (line(LineKind::Arm) && !mark(MarkKind::Point), "rigid arms of joints (grey lines)"),
        (line(LineKind::Arm) && mark(MarkKind::Point), "rigid arms of joints and points (grey lines)"),
        (mark(MarkKind::Body), "bodies at their centers of mass (blue disks)"),
        (mark(MarkKind::Support), "joints to the ground (hatched triangles)"),
        (mark(MarkKind::Joint), "joints between what moves (black circles)"),
        (mark(MarkKind::Frame), "moving frames (dashed squares)"),
        (mark(MarkKind::Point), "points (small black dots)"),
        (mark(MarkKind::Drive), "drives of angles (orange circular arrows)"),
        (arrow(ArrowKind::Drive), "drives of distances (orange arrows that begin at their joint)"),
        (arrow(ArrowKind::Force), "forces (orange arrows that end at their point)"),
        (arrow(ArrowKind::Moment), "moments about their axes (orange arrows with two heads)"),
        (arrow(ArrowKind::Axis), "axes of joints (dashed grey arrows)"),
        (mark(MarkKind::Output), "places of outputs (green diamonds)"),
    ];
    let there: Vec<_> = parts.iter().filter(|(there, _)| *there).map(|(_, words)| *words).collect();
    format!(
        "The mechanism as it is drawn in the model file, seen obliquely: x to the right, z up, y into the depth and shortened. It shows {}.",
        there.join(", ")
    )
}

/// Text of the file inside XML, which has no control characters.
pub fn escaped(text: &str) -> String {
    let text: String = text.chars().map(|character| if character.is_control() { ' ' } else { character }).collect();
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use ancf14::model::drawing::{Arrow, Line};

    /// Every point is on the page, x points right and z up.
    #[test]
    fn the_picture_fits_its_page() {
        let line = Line {
            name: "arm".to_owned(),
            kind: LineKind::Beam,
            points: vec![[0.0; 3], [3.0, 1.0, 0.5], [1.0, -2.0, 7.0]],
            nodes: vec![[0.0; 3], [1.0, -2.0, 7.0]],
        };
        let drawing = Drawing { lines: vec![line], ..Drawing::default() };
        for (word, projection) in PROJECTIONS {
            let view = View::of(&drawing, PAGE, projection);
            for point in &drawing.lines[0].points {
                let [x, y] = view.place(*point);
                assert!((PAGE.border - 1e-9..=PAGE.width - PAGE.border + 1e-9).contains(&x), "{word}: {x}");
                assert!((PAGE.border - 1e-9..=PAGE.height - PAGE.border + 1e-9).contains(&y), "{word}: {y}");
            }
        }
        let view = View::of(&drawing, PAGE, Projection::default());
        let origin = view.place([0.0; 3]);
        assert!(view.place([1.0, 0.0, 0.0])[0] > origin[0] && view.place([0.0, 0.0, 1.0])[1] < origin[1]);
    }

    /// A flat mechanism is seen from the side where it is flat; one along a line, or in space, obliquely. A low one has
    /// a low page.
    #[test]
    fn views_suit_mechanisms() {
        let of = |points: &[[f64; 3]]| {
            let line = Line { name: String::new(), kind: LineKind::Beam, points: points.to_vec(), nodes: Vec::new() };
            Drawing { lines: vec![line], ..Drawing::default() }
        };
        let ends = [[0.0; 3], [1.0, 2.0, 0.0]];
        for (points, view) in [
            (&ends[..], Projection::Top),
            (&[[0.0; 3], [1.0, 0.0, 2.0]], Projection::Front),
            (&[[0.0; 3], [0.0, 1.0, 2.0]], Projection::Side),
            (&[[0.0; 3], [1.0, 0.0, 0.0]], Projection::Oblique),
            (&[[0.0; 3], [1.0, 1.0, 1.0]], Projection::Oblique),
        ] {
            assert_eq!(suited(&of(points)), view, "{points:?}");
        }
        let height = |projection| View::fitted(&of(&ends), projection).sheet.height;
        assert_eq!([Projection::Front, Projection::Top].map(height), [300.0, PAGE.height]);
    }

    #[test]
    fn text_of_the_file_is_escaped() {
        assert!(svg(&Drawing::default(), "a < b & c", Projection::default()).contains("a &lt; b &amp; c"));
    }

    /// A force along the line of sight has no length on paper: it is a circle, with a dot where it points at who looks,
    /// and a cross where it points away.
    #[test]
    fn arrows_are_seen_from_their_ends() {
        let arrow = |direction| Arrow { name: "push".to_owned(), kind: ArrowKind::Force, at: [0.0; 3], direction };
        let drawn = |direction, projection| {
            let drawing = Drawing { arrows: vec![arrow(direction)], ..Drawing::default() };
            unnamed(&drawing, projection)
        };
        let [toward, away] = [[0.0, -2.0, 0.0], [0.0, 2.0, 0.0]].map(|direction| drawn(direction, Projection::Front));
        assert!(toward.matches("<circle").count() == 2 && !toward.contains("<line"), "{toward}");
        assert!(away.matches("<circle").count() == 1 && !away.contains("<line"), "{away}");
        assert!(drawn([0.0, 2.0, 0.0], Projection::Top).contains("<line"));
    }
}
