//! A picture of a mechanism: oblique projection, x to the right, z up, y into the depth.

use ancf14::model::drawing::{Arrow, ArrowKind, Drawing, LineKind, Mark, MarkKind};
use std::fmt::Write;

/// What a picture is drawn on, pixels. Marks have the same size on each.
struct Sheet {
    width: f64,
    height: f64,
    /// Room for what stands around points, names above all.
    border: f64,
    /// Length of an arrow.
    arrow: f64,
}

/// With names.
const PAGE: Sheet = Sheet { width: 960.0, height: 640.0, border: 110.0, arrow: 58.0 };
/// Without: small, so that lines and marks are large beside it.
const ICON: Sheet = Sheet { width: 200.0, height: 150.0, border: 28.0, arrow: 28.0 };

/// The depth axis on paper: direction and shortening.
const DEPTH: [f64; 2] = [0.42, 0.30];

/// From meters to pixels.
struct View {
    sheet: &'static Sheet,
    scale: f64,
    center: [f64; 2],
}

/// A point on paper before scaling, z up.
pub fn flat(point: [f64; 3]) -> [f64; 2] {
    [point[0] + DEPTH[0] * point[1], point[2] + DEPTH[1] * point[1]]
}

impl View {
    fn of(drawing: &Drawing, sheet: &'static Sheet) -> Self {
        let lines = drawing.lines.iter().flat_map(|line| &line.points);
        let points: Vec<_> = lines.chain(drawing.marks.iter().map(|mark| &mark.at)).map(|point| flat(*point)).collect();
        let extreme = |axis: usize, pick: fn(f64, f64) -> f64, start: f64| {
            points.iter().map(|point| point[axis]).fold(start, pick)
        };
        let low = [0, 1].map(|axis| extreme(axis, f64::min, f64::INFINITY));
        let high = [0, 1].map(|axis| extreme(axis, f64::max, f64::NEG_INFINITY));
        let room = [sheet.width - 2.0 * sheet.border, sheet.height - 2.0 * sheet.border];
        let scale = [0, 1].map(|axis| room[axis] / (high[axis] - low[axis])).into_iter().fold(f64::INFINITY, f64::min);
        let center = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]));
        if scale.is_finite() && center.iter().all(|c| c.is_finite()) {
            Self { sheet, scale, center }
        } else {
            Self { sheet, scale: 100.0, center: [0.0; 2] }
        }
    }

    fn place(&self, point: [f64; 3]) -> [f64; 2] {
        let [x, y] = flat(point);
        let [right, down] = [self.scale * (x - self.center[0]), -self.scale * (y - self.center[1])];
        [0.5 * self.sheet.width + right, 0.5 * self.sheet.height + down]
    }
}

/// The picture; every name that can be read in it is one of the model file.
pub fn svg(drawing: &Drawing, title: &str) -> String {
    let view = View::of(drawing, &PAGE);
    let mut page = Page::new(view.sheet);
    page.title(title);
    page.mechanism(drawing, &view);
    page.write_names();
    page.axes();
    page.scale(view.scale);
    page.end()
}

/// The picture without names, nodes, axes and outputs, for a place as small as an icon.
pub fn icon(drawing: &Drawing) -> String {
    let mut drawing = drawing.clone();
    drawing.lines.iter_mut().for_each(|line| line.nodes.clear());
    drawing.marks.retain(|mark| mark.kind != MarkKind::Output);
    drawing.arrows.retain(|arrow| arrow.kind != ArrowKind::Axis);
    let view = View::of(&drawing, &ICON);
    let mut page = Page::new(view.sheet);
    page.mechanism(&drawing, &view);
    page.end()
}

/// The page of [`svg`] without names, for pictures that have no text.
pub fn unnamed(drawing: &Drawing) -> String {
    let view = View::of(drawing, &PAGE);
    let mut page = Page::new(view.sheet);
    page.mechanism(drawing, &view);
    page.end()
}

/// What the parts of a drawing stand for, of those that are in it.
pub fn legend(drawing: &Drawing) -> String {
    let line = |kind| drawing.lines.iter().any(|line| line.kind == kind);
    let mark = |kind| drawing.marks.iter().any(|mark| mark.kind == kind);
    let arrow = |kind| drawing.arrows.iter().any(|arrow| arrow.kind == kind);
    let parts = [
        (line(LineKind::Beam), "beams with their nodes (blue lines)"),
        (line(LineKind::Spring), "springs (dashed pink lines)"),
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

/// Where a name may stand beside its point, best first: directions on paper, and gaps in pixels.
const DIRECTIONS: [[f64; 2]; 8] =
    [[0.0, 1.0], [0.7, 0.8], [0.7, -0.8], [0.0, -1.0], [-0.7, 0.8], [-0.7, -0.8], [1.0, 0.0], [-1.0, 0.0]];
const DISTANCES: [f64; 4] = [10.0, 18.0, 28.0, 40.0];
/// Names that are written: for more there is no room.
const MOST_NAMES: usize = 150;

/// The picture while it is drawn.
struct Page {
    sheet: &'static Sheet,
    text: String,
    /// Points that a name must not cover: the lines, close enough to each other, and the names.
    occupied: Vec<[f64; 2]>,
    /// Names to write when all else is drawn: text, the point that it belongs to, color.
    names: Vec<(String, [f64; 2], &'static str)>,
}

/// Distance of the points that stand for a line, pixels.
const GRAIN: f64 = 5.0;
/// Points that stand for a line, at most: it crosses the page with fewer.
const MOST_GRAINS: f64 = 1000.0;
/// Height and mean width of a letter, pixels.
const LETTER: [f64; 2] = [8.4, 15.0];

impl Page {
    fn push(&mut self, element: std::fmt::Arguments<'_>) {
        // Writing into a String cannot fail.
        let _ = writeln!(self.text, "{element}");
    }

    fn new(sheet: &'static Sheet) -> Self {
        let mut page = Self { sheet, text: String::new(), occupied: Vec::new(), names: Vec::new() };
        let Sheet { width, height, .. } = sheet;
        page.push(format_args!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
             font-family=\"sans-serif\" font-size=\"15\">"
        ));
        page.push(format_args!("<rect width=\"100%\" height=\"100%\" fill=\"white\"/>"));
        page
    }

    fn end(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }

    fn title(&mut self, title: &str) {
        let title = escaped(title);
        if title.is_empty() {
            return;
        }
        self.push(format_args!("<text x=\"24\" y=\"36\" font-size=\"20\" fill=\"#323232\">{title}</text>"));
    }

    fn mechanism(&mut self, drawing: &Drawing, view: &View) {
        for line in &drawing.lines {
            let points: Vec<_> = line.points.iter().map(|point| view.place(*point)).collect();
            match line.kind {
                LineKind::Beam => {
                    let nodes: Vec<_> = line.nodes.iter().map(|node| view.place(*node)).collect();
                    self.beam(&line.name, &points, &nodes);
                }
                LineKind::Spring => self.spring(&line.name, &points),
                LineKind::Arm => self.arm(&points),
            }
        }
        for arrow in &drawing.arrows {
            self.arrow(arrow, view.place(arrow.at));
        }
        for mark in &drawing.marks {
            self.mark(mark, view.place(mark.at));
        }
    }

    fn occupy(&mut self, from: [f64; 2], to: [f64; 2]) {
        let steps = ((to[0] - from[0]).hypot(to[1] - from[1]) / GRAIN).ceil().clamp(1.0, MOST_GRAINS);
        for k in 0..=steps as usize {
            self.occupied.push([0, 1].map(|i| from[i] + (to[i] - from[i]) * k as f64 / steps));
        }
    }

    fn name(&mut self, name: &str, at: [f64; 2], color: &'static str) {
        if !name.is_empty() {
            self.names.push((name.to_owned(), at, color));
        }
    }

    fn beam(&mut self, name: &str, points: &[[f64; 2]], nodes: &[[f64; 2]]) {
        if points.is_empty() {
            return;
        }
        let path: Vec<_> = apart(points, 0.5).iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        let path = path.join(" ");
        self.push(format_args!("<polyline points=\"{path}\" fill=\"none\" stroke=\"#0072b2\" stroke-width=\"3.5\"/>"));
        for [x, y] in apart(nodes, 2.0) {
            self.push(format_args!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"white\" stroke=\"#0072b2\"/>"));
        }
        for pair in apart(points, GRAIN).windows(2) {
            self.occupy(pair[0], pair[1]);
        }
        // The middle one, or the middle of the two in the middle.
        let [a, b] = [(points.len() - 1) / 2, points.len() / 2].map(|k| points[k]);
        self.name(name, [0, 1].map(|i| 0.5 * (a[i] + b[i])), "#0072b2");
    }

    fn spring(&mut self, name: &str, points: &[[f64; 2]]) {
        let (Some(first), Some(last)) = (points.first(), points.last()) else { return };
        self.push(format_args!(
            "<line x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"#cc79a7\" stroke-width=\"2\" \
             stroke-dasharray=\"7 4\"/>",
            first[0], first[1], last[0], last[1]
        ));
        self.occupy(*first, *last);
        self.name(name, [0, 1].map(|i| 0.5 * (first[i] + last[i])), "#cc79a7");
    }

    fn arm(&mut self, points: &[[f64; 2]]) {
        let [[x, y], [to_x, to_y]] = points else { return };
        self.push(format_args!(
            "<line x1=\"{x:.1}\" y1=\"{y:.1}\" x2=\"{to_x:.1}\" y2=\"{to_y:.1}\" stroke=\"#777777\" stroke-width=\"2\"/>"
        ));
        self.occupy([*x, *y], [*to_x, *to_y]);
    }

    fn mark(&mut self, mark: &Mark, [x, y]: [f64; 2]) {
        match mark.kind {
            MarkKind::Support => {
                let (left, right, low) = (x - 12.0, x + 12.0, y + 18.0);
                self.push(format_args!(
                    "<path d=\"M{x:.1},{y:.1} L{left:.1},{low:.1} L{right:.1},{low:.1} Z\" fill=\"#dddddd\" stroke=\"#323232\"/>"
                ));
                for k in 0..4 {
                    let from = left + 8.0 * f64::from(k);
                    let (to, deep) = (from - 6.0, low + 7.0);
                    self.push(format_args!(
                        "<line x1=\"{from:.1}\" y1=\"{low:.1}\" x2=\"{to:.1}\" y2=\"{deep:.1}\" stroke=\"#323232\"/>"
                    ));
                }
                self.occupy([left, low], [right, low]);
                self.occupy([left, low + 7.0], [right, low + 7.0]);
                self.name(&mark.name, [x, y + 16.0], "#323232");
            }
            MarkKind::Joint => {
                self.push(format_args!(
                    "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"7\" fill=\"white\" stroke=\"#323232\" stroke-width=\"2\"/>"
                ));
                self.occupy([x - 7.0, y], [x + 7.0, y]);
                self.name(&mark.name, [x, y], "#323232");
            }
            MarkKind::Body => {
                let (left, right, low, high) = (x - 13.0, x + 13.0, y + 13.0, y - 13.0);
                self.push(format_args!(
                    "<path d=\"M{left:.1},{y:.1} H{right:.1} M{x:.1},{high:.1} V{low:.1}\" stroke=\"#0072b2\" stroke-width=\"1.5\"/>"
                ));
                self.push(format_args!(
                    "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"13\" fill=\"#0072b2\" fill-opacity=\"0.25\" stroke=\"#0072b2\" stroke-width=\"2.5\"/>"
                ));
                for end in [y - 8.0, y, y + 8.0] {
                    self.occupy([left, end], [right, end]);
                }
                self.name(&mark.name, [x, y], "#0072b2");
            }
            MarkKind::Frame => {
                let (left, top) = (x - 8.0, y - 8.0);
                self.push(format_args!(
                    "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"16\" height=\"16\" fill=\"none\" stroke=\"#323232\" stroke-width=\"1.5\" \
                     stroke-dasharray=\"3 2\"/>"
                ));
                self.occupy([left, y], [x + 8.0, y]);
                self.name(&mark.name, [x, y], "#323232");
            }
            MarkKind::Point => {
                self.push(format_args!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\" fill=\"#323232\"/>"));
                self.occupy([x - 3.5, y], [x + 3.5, y]);
                self.name(&mark.name, [x, y], "#323232");
            }
            MarkKind::Drive => {
                let (from, to) = (x - 12.0, x + 12.0);
                self.push(format_args!(
                    "<path d=\"M{from:.1},{y:.1} A12,12 0 1 1 {x:.1},{:.1}\" fill=\"none\" stroke=\"#d55e00\" stroke-width=\"2\"/>",
                    y + 12.0
                ));
                self.arrow_head([x - 3.0, y + 12.0], [-1.0, 0.0], "#d55e00");
                self.occupy([from, y], [to, y]);
                self.name(&mark.name, [x, y], "#d55e00");
            }
            MarkKind::Output => {
                let (left, right, low, high) = (x - 6.0, x + 6.0, y + 6.0, y - 6.0);
                self.push(format_args!(
                    "<path d=\"M{left:.1},{y:.1} L{x:.1},{high:.1} L{right:.1},{y:.1} L{x:.1},{low:.1} Z\" fill=\"#009e73\"/>"
                ));
                self.occupy([left, y], [right, y]);
                self.name(&mark.name, [x, y], "#009e73");
            }
        }
    }

    /// Forces end at their point, moments, axes and drives begin there; a moment has two heads.
    fn arrow(&mut self, arrow: &Arrow, at: [f64; 2]) {
        let [right, up] = flat(arrow.direction);
        let direction = unit([right, -up]);
        let (color, dashes) = match arrow.kind {
            ArrowKind::Force | ArrowKind::Moment | ArrowKind::Drive => ("#d55e00", ""),
            ArrowKind::Axis => ("#777777", " stroke-dasharray=\"5 4\""),
        };
        let along = |length: f64| [0, 1].map(|i| at[i] + length * direction[i]);
        let (tail, head) = match arrow.kind {
            ArrowKind::Force => (along(-self.sheet.arrow), along(-7.0)),
            ArrowKind::Moment | ArrowKind::Axis | ArrowKind::Drive => (along(7.0), along(self.sheet.arrow)),
        };
        self.push(format_args!(
            "<line x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"{color}\" stroke-width=\"2.5\"{dashes}/>",
            tail[0], tail[1], head[0], head[1]
        ));
        self.arrow_head(head, direction, color);
        if arrow.kind == ArrowKind::Moment {
            let second = [0, 1].map(|i| head[i] - 9.0 * direction[i]);
            self.arrow_head(second, direction, color);
        }
        self.occupy(tail, head);
        let free = if arrow.kind == ArrowKind::Force { tail } else { head };
        if arrow.kind != ArrowKind::Axis {
            self.name(&arrow.name, free, color);
        }
    }

    fn arrow_head(&mut self, tip: [f64; 2], direction: [f64; 2], color: &str) {
        let corner = |side: f64| {
            let x = tip[0] - 11.0 * direction[0] + side * 5.0 * direction[1];
            let y = tip[1] - 11.0 * direction[1] - side * 5.0 * direction[0];
            format!("{x:.1},{y:.1}")
        };
        let (left, right) = (corner(1.0), corner(-1.0));
        self.push(format_args!("<path d=\"M{:.1},{:.1} L{left} L{right} Z\" fill=\"{color}\"/>", tip[0], tip[1]));
    }

    /// Writes the names near their points, where they cover least.
    fn write_names(&mut self) {
        let names = std::mem::take(&mut self.names);
        for (name, point, color) in names.into_iter().take(MOST_NAMES) {
            let half = [0.5 * LETTER[0] * name.chars().count() as f64, 0.5 * LETTER[1]];
            let places = DISTANCES.iter().flat_map(|distance| {
                DIRECTIONS.iter().map(move |[right, up]| {
                    [point[0] + right * (half[0] + distance), point[1] - up * (half[1] + distance)]
                })
            });
            let [width, height] = [self.sheet.width, self.sheet.height];
            let covered = |at: &[f64; 2]| {
                let inside = at[0] > half[0] && at[0] < width - half[0] && at[1] > half[1] && at[1] < height - half[1];
                let points =
                    self.occupied.iter().filter(|p| [0, 1].iter().all(|&i| (p[i] - at[i]).abs() < half[i] + 4.0));
                (!inside, points.count())
            };
            let at = places.min_by_key(covered).unwrap_or(point);
            for y in [at[1] - 0.7 * half[1], at[1] + 0.7 * half[1]] {
                self.occupy([at[0] - half[0], y], [at[0] + half[0], y]);
            }
            let (x, y, name) = (at[0], at[1] + 5.0, escaped(&name));
            self.push(format_args!(
                "<text x=\"{x:.1}\" y=\"{y:.1}\" fill=\"{color}\" text-anchor=\"middle\">{name}</text>"
            ));
        }
    }

    /// The global axes, in the lower left corner.
    fn axes(&mut self) {
        let origin = [52.0, self.sheet.height - 46.0];
        for (name, direction) in [("x", [1.0, 0.0, 0.0]), ("y", [0.0, 1.0, 0.0]), ("z", [0.0, 0.0, 1.0])] {
            let [right, up] = flat(direction);
            let length = 40.0;
            let tip = [origin[0] + length * right, origin[1] - length * up];
            self.push(format_args!(
                "<line x1=\"{}\" y1=\"{}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"#323232\" stroke-width=\"1.5\"/>",
                origin[0], origin[1], tip[0], tip[1]
            ));
            self.arrow_head(tip, unit([right, -up]), "#323232");
            let (x, y) = (tip[0] + 9.0 * unit([right, -up])[0], tip[1] + 9.0 * unit([right, -up])[1] + 5.0);
            self.push(format_args!(
                "<text x=\"{x:.1}\" y=\"{y:.1}\" fill=\"#323232\" text-anchor=\"middle\">{name}</text>"
            ));
        }
    }

    /// A bar of a round length, in the lower right corner.
    fn scale(&mut self, scale: f64) {
        let length = round_length(150.0 / scale);
        let (right, y) = (self.sheet.width - 40.0, self.sheet.height - 46.0);
        let left = right - length * scale;
        self.push(format_args!(
            "<path d=\"M{left:.1},{:.1} V{y} H{right} V{:.1}\" fill=\"none\" stroke=\"#323232\" stroke-width=\"1.5\"/>",
            y - 6.0,
            y - 6.0
        ));
        let middle = 0.5 * (left + right);
        self.push(format_args!(
            "<text x=\"{middle:.1}\" y=\"{:.1}\" fill=\"#323232\" text-anchor=\"middle\">{length} m</text>",
            y + 20.0
        ));
    }
}

/// The points of a line that are not nearer than `distance` to each other, and its last one.
fn apart(points: &[[f64; 2]], distance: f64) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = Vec::new();
    for (k, point) in points.iter().enumerate() {
        let is_far = |last: &[f64; 2]| (point[0] - last[0]).hypot(point[1] - last[1]) >= distance;
        if k + 1 == points.len() || kept.last().is_none_or(is_far) {
            kept.push(*point);
        }
    }
    kept
}

/// A direction of length 1; of nothing nothing.
fn unit([x, y]: [f64; 2]) -> [f64; 2] {
    let length = x.hypot(y);
    if length > 0.0 { [x / length, y / length] } else { [0.0, 0.0] }
}

/// The largest of 1, 2, 5 times a power of ten that is not above `length`.
fn round_length(length: f64) -> f64 {
    let exponent = length.log10().floor() as i32;
    let mantissa = length / 10_f64.powi(exponent);
    let digit = if mantissa >= 5.0 {
        "5"
    } else if mantissa >= 2.0 {
        "2"
    } else {
        "1"
    };
    // By its text: 2e-1 is 0.2, but 2 * 10^-1 is not always.
    format!("{digit}e{exponent}").parse().unwrap_or(length)
}

/// Text of the file inside XML, which has no control characters.
pub fn escaped(text: &str) -> String {
    let text: String = text.chars().map(|character| if character.is_control() { ' ' } else { character }).collect();
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use ancf14::model::drawing::{Line, LineKind};

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
        let view = View::of(&drawing, &PAGE);
        for point in &drawing.lines[0].points {
            let [x, y] = view.place(*point);
            assert!((PAGE.border - 1e-9..=PAGE.width - PAGE.border + 1e-9).contains(&x), "{x}");
            assert!((PAGE.border - 1e-9..=PAGE.height - PAGE.border + 1e-9).contains(&y), "{y}");
        }
        let origin = view.place([0.0; 3]);
        assert!(view.place([1.0, 0.0, 0.0])[0] > origin[0] && view.place([0.0, 0.0, 1.0])[1] < origin[1]);
    }

    #[test]
    fn scale_bars_are_round() {
        for (length, round) in [(0.23, 0.2), (0.99, 0.5), (1.0, 1.0), (7e-4, 5e-4), (49.0, 20.0)] {
            assert_eq!(round_length(length), round);
        }
    }

    #[test]
    fn text_of_the_file_is_escaped() {
        assert!(svg(&Drawing::default(), "a < b & c").contains("a &lt; b &amp; c"));
    }
}
