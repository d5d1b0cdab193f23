//! The picture while it is drawn: lines, arrows and marks of a mechanism, the title, axes and a scale.

use super::escaped;
use super::names::{GRAIN, Name, Names};
use super::sheet::{Sheet, View};
use ancf14::model::drawing::{Arrow, ArrowKind, Drawing, LineKind, Mark, MarkKind};
use std::fmt::Write;

/// The picture while it is drawn.
pub struct Page<'a> {
    view: &'a View,
    text: String,
    /// Names to write when all else is drawn.
    names: Names,
}

/// An arrow that appears shorter than this share of its length is drawn from its end.
const END_ON: f64 = 0.05;

impl<'a> Page<'a> {
    fn push(&mut self, element: std::fmt::Arguments<'_>) {
        // Writing into a String cannot fail.
        let _ = writeln!(self.text, "{element}");
    }

    /// An empty page.
    pub fn new(view: &'a View) -> Self {
        let mut page = Self { view, text: String::new(), names: Names::default() };
        let Sheet { width, height, .. } = view.sheet;
        page.push(format_args!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
             font-family=\"sans-serif\" font-size=\"15\">"
        ));
        page.push(format_args!("<rect width=\"100%\" height=\"100%\" fill=\"white\"/>"));
        page
    }

    /// The text of the picture.
    pub fn end(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }

    /// Writes the title.
    pub fn title(&mut self, title: &str) {
        let title = escaped(title);
        if title.is_empty() {
            return;
        }
        self.push(format_args!("<text x=\"24\" y=\"36\" font-size=\"20\" fill=\"#323232\">{title}</text>"));
    }

    /// Draws all but the names.
    pub fn mechanism(&mut self, drawing: &Drawing) {
        let view = self.view;
        for line in &drawing.lines {
            let points: Vec<_> = line.points.iter().map(|point| view.place(*point)).collect();
            match line.kind {
                LineKind::Beam => {
                    let nodes: Vec<_> = line.nodes.iter().map(|node| view.place(*node)).collect();
                    self.beam(&line.name, &points, &nodes);
                }
                LineKind::Spring => self.spring(&line.name, &points),
                LineKind::Face => self.face(&line.name, &points),
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
            self.names.occupy(pair[0], pair[1]);
        }
        // The middle one, or the middle of the two in the middle.
        let [a, b] = [(points.len() - 1) / 2, points.len() / 2].map(|k| points[k]);
        self.names.add(name, [0, 1].map(|i| 0.5 * (a[i] + b[i])), "#0072b2");
    }

    fn face(&mut self, name: &str, points: &[[f64; 2]]) {
        let path: Vec<_> = points.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        let path = path.join(" ");
        self.push(format_args!("<polyline points=\"{path}\" fill=\"none\" stroke=\"#999999\" stroke-width=\"0.7\"/>"));
        if let (false, Some(at)) = (name.is_empty(), points.first()) {
            self.names.add(name, *at, "#777777");
        }
    }

    fn spring(&mut self, name: &str, points: &[[f64; 2]]) {
        let (Some(first), Some(last)) = (points.first(), points.last()) else { return };
        self.push(format_args!(
            "<line x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"#cc79a7\" stroke-width=\"2\" \
             stroke-dasharray=\"7 4\"/>",
            first[0], first[1], last[0], last[1]
        ));
        self.names.occupy(*first, *last);
        self.names.add(name, [0, 1].map(|i| 0.5 * (first[i] + last[i])), "#cc79a7");
    }

    fn arm(&mut self, points: &[[f64; 2]]) {
        let [[x, y], [to_x, to_y]] = points else { return };
        self.push(format_args!(
            "<line x1=\"{x:.1}\" y1=\"{y:.1}\" x2=\"{to_x:.1}\" y2=\"{to_y:.1}\" stroke=\"#777777\" stroke-width=\"2\"/>"
        ));
        self.names.occupy([*x, *y], [*to_x, *to_y]);
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
                self.names.occupy([left, low], [right, low]);
                self.names.occupy([left, low + 7.0], [right, low + 7.0]);
                self.names.add(&mark.name, [x, y + 16.0], "#323232");
            }
            MarkKind::Joint => {
                self.push(format_args!(
                    "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"7\" fill=\"white\" stroke=\"#323232\" stroke-width=\"2\"/>"
                ));
                self.names.occupy([x - 7.0, y], [x + 7.0, y]);
                self.names.add(&mark.name, [x, y], "#323232");
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
                    self.names.occupy([left, end], [right, end]);
                }
                self.names.add(&mark.name, [x, y], "#0072b2");
            }
            MarkKind::Frame => {
                let (left, top) = (x - 8.0, y - 8.0);
                self.push(format_args!(
                    "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"16\" height=\"16\" fill=\"none\" stroke=\"#323232\" stroke-width=\"1.5\" \
                     stroke-dasharray=\"3 2\"/>"
                ));
                self.names.occupy([left, y], [x + 8.0, y]);
                self.names.add(&mark.name, [x, y], "#323232");
            }
            MarkKind::Point => {
                self.push(format_args!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\" fill=\"#323232\"/>"));
                self.names.occupy([x - 3.5, y], [x + 3.5, y]);
                self.names.add(&mark.name, [x, y], "#323232");
            }
            MarkKind::Drive => {
                let (from, to) = (x - 12.0, x + 12.0);
                self.push(format_args!(
                    "<path d=\"M{from:.1},{y:.1} A12,12 0 1 1 {x:.1},{:.1}\" fill=\"none\" stroke=\"#d55e00\" stroke-width=\"2\"/>",
                    y + 12.0
                ));
                self.arrow_head([x - 3.0, y + 12.0], [-1.0, 0.0], "#d55e00");
                self.names.occupy([from, y], [to, y]);
                self.names.add(&mark.name, [x, y], "#d55e00");
            }
            MarkKind::Output => {
                let (left, right, low, high) = (x - 6.0, x + 6.0, y + 6.0, y - 6.0);
                self.push(format_args!(
                    "<path d=\"M{left:.1},{y:.1} L{x:.1},{high:.1} L{right:.1},{y:.1} L{x:.1},{low:.1} Z\" fill=\"#009e73\"/>"
                ));
                self.names.occupy([left, y], [right, y]);
                self.names.add(&mark.name, [x, y], "#009e73");
            }
        }
    }

    /// Forces end at their point, moments, axes and drives begin there; a moment has two heads.
    fn arrow(&mut self, arrow: &Arrow, at: [f64; 2]) {
        let projection = self.view.projection;
        let [right, up] = projection.flat(arrow.direction);
        let direction = unit([right, -up]);
        let (color, dashes) = match arrow.kind {
            ArrowKind::Force | ArrowKind::Moment | ArrowKind::Drive => ("#d55e00", ""),
            ArrowKind::Axis => ("#777777", " stroke-dasharray=\"5 4\""),
        };
        let toward = projection.toward(arrow.direction);
        if right.hypot(up) < END_ON * toward.abs() {
            self.end_on(at, toward > 0.0, color);
            if arrow.kind != ArrowKind::Axis {
                self.names.add(&arrow.name, at, color);
            }
            return;
        }
        let along = |length: f64| [0, 1].map(|i| at[i] + length * direction[i]);
        let (tail, head) = match arrow.kind {
            ArrowKind::Force => (along(-self.view.sheet.arrow), along(-7.0)),
            ArrowKind::Moment | ArrowKind::Axis | ArrowKind::Drive => (along(7.0), along(self.view.sheet.arrow)),
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
        self.names.occupy(tail, head);
        let free = if arrow.kind == ArrowKind::Force { tail } else { head };
        if arrow.kind != ArrowKind::Axis {
            self.names.add(&arrow.name, free, color);
        }
    }

    /// Draws an arrow that points at who looks, with its tip, or away, with its feathers.
    fn end_on(&mut self, [x, y]: [f64; 2], is_toward: bool, color: &str) {
        self.push(format_args!(
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"10\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2\"/>"
        ));
        if is_toward {
            self.push(format_args!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{color}\"/>"));
        } else {
            let [left, right, high, low] = [x - 7.1, x + 7.1, y - 7.1, y + 7.1];
            self.push(format_args!(
                "<path d=\"M{left:.1},{high:.1} L{right:.1},{low:.1} M{left:.1},{low:.1} L{right:.1},{high:.1}\" stroke=\"{color}\" \
                 stroke-width=\"2\"/>"
            ));
        }
        self.names.occupy([x - 10.0, y], [x + 10.0, y]);
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
    pub fn write_names(&mut self) {
        for Name { text, at: [x, y], color } in self.names.placed(&self.view.sheet) {
            let (y, text) = (y + 5.0, escaped(&text));
            self.push(format_args!(
                "<text x=\"{x:.1}\" y=\"{y:.1}\" fill=\"{color}\" text-anchor=\"middle\" stroke=\"white\" stroke-width=\"4\" \
                 stroke-linejoin=\"round\" paint-order=\"stroke\">{text}</text>"
            ));
        }
    }

    /// Draws the global axes, in the lower left corner.
    pub fn axes(&mut self) {
        let origin = [52.0, self.view.sheet.height - 46.0];
        let projection = self.view.projection;
        for (name, direction) in [("x", [1.0, 0.0, 0.0]), ("y", [0.0, 1.0, 0.0]), ("z", [0.0, 0.0, 1.0])] {
            let [right, up] = projection.flat(direction);
            if right.hypot(up) < END_ON {
                self.end_on(origin, projection.toward(direction) > 0.0, "#323232");
                let (x, y) = (origin[0] - 18.0, origin[1] + 18.0);
                self.push(format_args!(
                    "<text x=\"{x}\" y=\"{y}\" fill=\"#323232\" text-anchor=\"middle\">{name}</text>"
                ));
                continue;
            }
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

    /// Draws a bar of a round length, in the lower right corner.
    pub fn scale(&mut self) {
        let scale = self.view.scale;
        let length = round_length(150.0 / scale);
        let (right, y) = (self.view.sheet.width - 40.0, self.view.sheet.height - 46.0);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scale_bars_are_round() {
        for (length, round) in [(0.23, 0.2), (0.99, 0.5), (1.0, 1.0), (7e-4, 5e-4), (49.0, 20.0)] {
            assert_eq!(round_length(length), round);
        }
    }
}
