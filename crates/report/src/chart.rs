//! A chart as an SVG picture: lines and dots over two axes, ticks that can be read, a legend beside it.

use crate::numbers::trimmed;
use crate::panels::panels;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::error::Error;

/// Size of a chart on the screen, pixels.
const SHOWN: (u32, u32) = (960, 540);
/// Units of the drawing to a pixel: the backend knows whole units only, and a curve in whole pixels is a staircase.
pub(crate) const FINE: i32 = 10;
/// Size of a chart, and of the column for the legend in it; these and all other lengths in units of the drawing.
const SIZE: (u32, u32) = (SHOWN.0 * FINE as u32, SHOWN.1 * FINE as u32);
const LEGEND: i32 = 210 * FINE;
/// Border around the axes, height of the labels below and width of those on the left.
pub(crate) const MARGIN: i32 = 14 * FINE;
pub(crate) const BELOW: i32 = 48 * FINE;
const LEFT: i32 = 84 * FINE;
/// Height of the title: the height that remains for the axes depends on it.
const TITLE: i32 = 36 * FINE;
/// Height of one of several panels, and what is free above and below its axes.
const PANEL: i32 = 190 * FINE;
const BETWEEN: i32 = 8 * FINE;
/// First line of the legend, distance of its lines, and how many there is room for.
const FIRST: i32 = 64 * FINE;
const SPACING: i32 = 24 * FINE;
const NAMES: usize = 18;
/// Widths of curves and of all other lines.
const BOLD: u32 = 2 * FINE as u32;
pub(crate) const THIN: u32 = FINE as u32;
const HEAVY: u32 = 5 * FINE as u32;
/// A dash and the gap behind it.
const DASH: i32 = 10 * FINE;
const GAP: i32 = 6 * FINE;

/// Colors that everybody can tell apart (Okabe and Ito).
pub(crate) const COLORS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(60, 60, 60),
];
pub(crate) const INK: RGBColor = RGBColor(50, 50, 50);
pub(crate) const GRID: RGBColor = RGBColor(225, 225, 225);

/// Points of a line that are drawn; of more the lowest and highest of each interval.
const POINTS: usize = 4000;

/// A chart.
#[derive(Debug)]
pub struct Chart {
    /// Above it.
    pub title: String,
    /// What the axes say.
    pub axes: [String; 2],
    /// How the axes are laid out.
    pub layout: Layout,
    /// Lines in the order of the legend.
    pub lines: Vec<Line>,
}

/// How the axes of a chart are laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// One pair of axes for all lines.
    Single,
    /// The same, and a length is the same along both axes: shapes.
    Shape,
    /// A panel for the lines of each size, one below the other: no line looks flat because another one is large.
    Panels,
    /// By the logarithm of the frequency, the first half of the lines, magnitudes, above the other half, phases in
    /// degrees.
    Bode,
}

/// A line of a chart.
#[derive(Debug)]
pub struct Line {
    /// In the legend; empty: not there.
    pub name: String,
    /// How it is drawn.
    pub stroke: Stroke,
    /// Number of its color; lines with the same one look alike.
    pub color: usize,
    /// Its points; gaps where they are not finite are closed.
    pub points: Vec<(f64, f64)>,
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stroke {
    /// From point to point.
    Solid,
    /// The same in dashes.
    Dashed,
    /// The same, thick.
    Heavy,
    /// The same, thin.
    Thin,
    /// A dot at each point.
    Dots,
}

impl Chart {
    /// The picture.
    ///
    /// # Errors
    /// It cannot be drawn.
    pub fn svg(&self) -> Result<String, Box<dyn Error>> {
        let panels = match self.layout {
            Layout::Single | Layout::Shape => vec![(0..self.lines.len()).collect()],
            Layout::Panels => panels(&self.lines.iter().map(Line::span).collect::<Vec<_>>()),
            Layout::Bode => {
                let half = self.lines.len() / 2;
                vec![(0..half).collect(), (half..self.lines.len()).collect()]
            }
        };
        let panels: Vec<Vec<&Line>> =
            panels.into_iter().map(|panel| panel.into_iter().map(|line| &self.lines[line]).collect()).collect();
        let shown = match panels.len() {
            0 | 1 => SHOWN,
            count => (SHOWN.0, ((HEAD + PANEL * count as i32 + BELOW - BETWEEN) / FINE) as u32),
        };
        let size = (shown.0 * FINE as u32, shown.1 * FINE as u32);
        let mut text = String::new();
        self.draw(&SVGBackend::with_string(&mut text, size).into_drawing_area(), &panels)?;
        let words = |(width, height)| format!("width=\"{width}\" height=\"{height}\"");
        Ok(text.replacen(&words(size), &words(shown), 1))
    }

    fn draw(&self, root: &Area<'_>, panels: &[Vec<&Line>]) -> Result<(), Box<dyn Error>> {
        root.fill(&WHITE)?;
        if let [panel] = panels {
            let look = Look {
                title: &self.title,
                words: &self.axes[1],
                margins: [MARGIN; 2],
                below: BELOW,
                labels: 9,
                letters: 16,
                first: FIRST,
            };
            self.panel(root, panel, &look)?;
        } else {
            let (mut above, mut rest) = root.split_vertically(HEAD);
            let center = text(22).color(&INK).pos(Pos::new(HPos::Center, VPos::Center));
            let middle = (LEFT + MARGIN + SIZE.0 as i32 - LEGEND - MARGIN) / 2;
            above.draw(&Text::new(self.title.clone(), (middle, HEAD / 2), center))?;
            for (k, panel) in panels.iter().enumerate() {
                let is_last = k + 1 == panels.len();
                if is_last {
                    above = rest.clone();
                } else {
                    (above, rest) = rest.split_vertically(PANEL);
                }
                let below = if is_last { BELOW } else { BETWEEN };
                let phases = self.layout == Layout::Bode && is_last;
                let words = if phases { "phase (degrees)" } else { &self.axes[1] };
                let margins = [BETWEEN; 2];
                let look = Look { title: "", words, margins, below, labels: 5, letters: 14, first: 2 * BETWEEN };
                self.panel(&above, panel, &look)?;
            }
        }
        root.present()?;
        Ok(())
    }

    /// Draws axes with some of the lines, and the names of these.
    fn panel(&self, area: &Area<'_>, lines: &[&Line], look: &Look<'_>) -> Result<(), Box<dyn Error>> {
        let (left, right) = area.split_horizontally(SIZE.0 as i32 - LEGEND);
        let [across, along] = self.ranges(lines);
        let (width, height) = (across.1 - across.0, along.1 - along.0);
        let is_inner = look.below < BELOW;
        let mut builder = ChartBuilder::on(&left);
        if !look.title.is_empty() || !matches!(self.layout, Layout::Panels | Layout::Bode) {
            builder.caption(look.title, text(22).color(&INK));
        }
        let [top, bottom] = look.margins;
        let mut chart = builder
            .margin(MARGIN)
            .margin_top(top)
            .margin_bottom(bottom)
            .x_label_area_size(look.below)
            .y_label_area_size(LEFT)
            .build_cartesian_2d(across.0..across.1, along.0..along.1)?;
        let horizontal = |value: &f64| match self.layout {
            _ if is_inner => String::new(),
            Layout::Bode => trimmed(10.0_f64.powf(*value), frequency_digits(width)),
            _ => tick(*value, width),
        };
        let vertical = |value: &f64| tick(*value, height);
        let mut mesh = chart.configure_mesh();
        mesh.x_labels(9)
            .y_labels(look.labels)
            .max_light_lines(0)
            .bold_line_style(GRID.stroke_width(THIN))
            .axis_style(INK.stroke_width(THIN))
            .set_all_tick_mark_size(5 * FINE)
            .label_style(text(14).color(&INK))
            .axis_desc_style(text(look.letters).color(&INK))
            .y_desc(look.words)
            .x_label_formatter(&horizontal)
            .y_label_formatter(&vertical);
        if !is_inner {
            mesh.x_desc(&self.axes[0]);
        }
        mesh.draw()?;
        for line in lines {
            match line.stroke {
                Stroke::Solid | Stroke::Heavy | Stroke::Thin => {
                    chart.draw_series(LineSeries::new(thinned(&line.points), line.style()))?;
                }
                Stroke::Dashed => {
                    let dashes = DashedLineSeries::new(thinned(&line.points), DASH, GAP, line.style());
                    chart.draw_series(dashes)?;
                }
                Stroke::Dots => {
                    let dots = line.points.iter().filter(|(x, y)| x.is_finite() && y.is_finite());
                    chart.draw_series(dots.map(|point| Circle::new(*point, DOT, line.style())))?;
                }
            }
        }
        legend(&right, lines, look.first)
    }

    /// What the axes span.
    fn ranges(&self, lines: &[&Line]) -> [(f64, f64); 2] {
        let points = || lines.iter().flat_map(|line| &line.points);
        let along = range(points().map(|point| point.1));
        if self.layout != Layout::Shape {
            // The same for all panels.
            let all = self.lines.iter().flat_map(|line| &line.points);
            return [extent(all.map(|point| point.0)).unwrap_or((0.0, 1.0)), along];
        }
        let across = range(points().map(|point| point.0));
        let [columns, rows] =
            [SIZE.0 as i32 - LEGEND - 2 * MARGIN - LEFT, SIZE.1 as i32 - 2 * MARGIN - BELOW - TITLE].map(f64::from);
        let scale = f64::max((across.1 - across.0) / columns, (along.1 - along.0) / rows);
        [(across, columns), (along, rows)].map(|((low, high), pixels)| {
            let (middle, half) = (0.5 * (low + high), 0.5 * scale * pixels);
            (middle - half, middle + half)
        })
    }
}

/// Draws samples and names beside axes, where they hide nothing.
fn legend(area: &Area<'_>, lines: &[&Line], first: i32) -> Result<(), Box<dyn Error>> {
    let label = || text(15).color(&INK);
    let named: Vec<&&Line> = lines.iter().filter(|line| !line.name.is_empty()).collect();
    for (k, line) in named.iter().take(NAMES).enumerate() {
        let y = first + SPACING * k as i32;
        match line.stroke {
            Stroke::Solid | Stroke::Heavy | Stroke::Thin => {
                area.draw(&PathElement::new([(4 * FINE, y), (30 * FINE, y)], line.style()))?;
            }
            Stroke::Dashed => {
                for start in [4 * FINE, 4 * FINE + DASH + GAP] {
                    area.draw(&PathElement::new([(start, y), (start + DASH, y)], line.style()))?;
                }
            }
            Stroke::Dots => area.draw(&Circle::new((17 * FINE, y), DOT, line.style()))?,
        }
        area.draw(&Text::new(line.name.clone(), (38 * FINE, y - 7 * FINE), label()))?;
    }
    if named.len() > NAMES {
        let y = first + SPACING * NAMES as i32;
        let rest = format!("and {} more", named.len() - NAMES);
        area.draw(&Text::new(rest, (38 * FINE, y - 7 * FINE), label()))?;
    }
    Ok(())
}

/// Digits of frequencies on an axis that spans so many decades: neighboring ticks differ in them.
fn frequency_digits(decades: f64) -> usize {
    (2.0 - decades.log10()).ceil().clamp(2.0, 9.0) as usize
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Height of the title above several panels.
const HEAD: i32 = TITLE + MARGIN;

/// How a panel looks.
struct Look<'a> {
    /// Above it; empty: it has no title of its own.
    title: &'a str,
    /// Beside its axis.
    words: &'a str,
    /// Above and below.
    margins: [i32; 2],
    /// Height of the labels below; less than [`BELOW`]: there are none.
    below: i32,
    /// Numbers at the axis on the left, and the height of the letters beside it.
    labels: usize,
    letters: i32,
    /// First line of the legend.
    first: i32,
}

/// Radius of a dot.
const DOT: i32 = 3 * FINE;

/// Letters of this height, pixels.
pub(crate) fn text(height: i32) -> FontDesc<'static> {
    ("sans-serif", height * FINE).into_font()
}

impl Line {
    /// Its lowest and highest value, if it has a point.
    fn span(&self) -> Option<(f64, f64)> {
        let values = self.points.iter().map(|point| point.1).filter(|value| value.is_finite());
        values.fold(None, |span, value| {
            let (low, high) = span.unwrap_or((value, value));
            Some((value.min(low), value.max(high)))
        })
    }

    fn style(&self) -> ShapeStyle {
        let color = COLORS[self.color % COLORS.len()];
        match self.stroke {
            Stroke::Solid | Stroke::Dashed => color.stroke_width(BOLD),
            Stroke::Heavy => color.stroke_width(HEAVY),
            Stroke::Thin => color.stroke_width(THIN),
            Stroke::Dots => color.filled(),
        }
    }
}

/// Lowest and highest finite value, if there is one.
fn extent(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let (low, high) = values
        .filter(|value| value.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    (low < high).then_some((low, high))
}

/// From the lowest to the highest finite value, with a margin; never empty.
fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values
        .filter(|value| value.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    if low > high {
        return (-1.0, 1.0);
    }
    // A constant with its round-off is a straight line in the middle, not noise from edge to edge.
    let least = 1e-9 * low.abs().max(high.abs());
    if high - low <= least {
        let half = if least > 0.0 { 0.1 * low.abs().max(high.abs()) } else { 1.0 };
        return (low - half, high + half);
    }
    let margin = 0.06 * (high - low);
    (low - margin, high + margin)
}

/// A number at an axis of this span: as many digits as tell neighbors apart, an exponent where numbers are large or
/// small.
fn tick(value: f64, span: f64) -> String {
    if value.abs() < 1e-9 * span {
        return "0".to_owned();
    }
    let size = span.max(value.abs());
    if !(1e-3..1e5).contains(&size) {
        let digits = (value.abs() / span * 20.0).log10().ceil().clamp(1.0, 6.0) as usize;
        return trimmed_exponent(&format!("{value:.digits$e}"));
    }
    let digits = (1.0 - span.log10()).ceil().clamp(0.0, 9.0) as usize;
    format!("{value:.digits$}")
}

/// `2.50e-4` to `2.5e-4`.
fn trimmed_exponent(text: &str) -> String {
    let Some((mantissa, exponent)) = text.split_once('e') else { return text.to_owned() };
    let mantissa = if mantissa.contains('.') { mantissa.trim_end_matches('0').trim_end_matches('.') } else { mantissa };
    format!("{mantissa}e{exponent}")
}

/// The finite points of a line; of very many the extremes of each interval, so that no peak gets lost.
fn thinned(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let points: Vec<_> = points.iter().copied().filter(|(x, y)| x.is_finite() && y.is_finite()).collect();
    if points.len() <= POINTS {
        return points;
    }
    let chunk = points.len().div_ceil(POINTS / 2);
    let mut kept = Vec::with_capacity(POINTS + 2);
    for part in points.chunks(chunk) {
        let low = part.iter().enumerate().min_by(|a, b| a.1.1.total_cmp(&b.1.1)).map_or(0, |(k, _)| k);
        let high = part.iter().enumerate().max_by(|a, b| a.1.1.total_cmp(&b.1.1)).map_or(0, |(k, _)| k);
        kept.push(part[low.min(high)]);
        kept.push(part[low.max(high)]);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Labels are short, differ from their neighbors, and zero is 0 whatever the round-off.
    #[test]
    fn ticks_are_readable() {
        assert_eq!(tick(-0.2, 1.5), "-0.2");
        assert_eq!(tick(1e-17, 1.0), "0");
        assert_eq!(tick(20.0, 100.0), "20");
        assert_eq!(tick(2.5e-7, 1e-6), "2.5e-7");
        assert_eq!(tick(1.5e8, 2e8), "1.5e8");
    }

    /// A wide range of frequencies has short numbers; on one of a twentieth all ticks differ.
    #[test]
    fn ticks_of_frequencies_differ() {
        assert_eq!(frequency_digits(3.0), 2);
        let ends: [f64; 2] = [49.0, 51.0];
        let decades = (ends[1] / ends[0]).log10();
        let ticks = (0..=8).map(|k| ends[0] * (ends[1] / ends[0]).powf(f64::from(k) / 8.0));
        let mut words: Vec<String> = ticks.map(|tick| trimmed(tick, frequency_digits(decades))).collect();
        words.dedup();
        assert_eq!(words.len(), 9, "{words:?}");
    }

    /// A straight line is drawn straight: from point to point it rises by the same, to a tenth of a pixel.
    #[test]
    fn regression_ramps_are_no_staircases() {
        let points = (0..=300).map(|k| (f64::from(k), 0.01 * f64::from(k))).collect();
        let line = Line { name: String::new(), stroke: Stroke::Solid, color: 0, points };
        let chart = Chart {
            title: String::new(),
            axes: [const { String::new() }; 2],
            layout: Layout::Single,
            lines: vec![line],
        };
        let svg = chart.svg().unwrap();
        assert!(svg.starts_with("<svg width=\"960\" height=\"540\" viewBox=\"0 0 9600 5400\""), "{}", &svg[..100]);
        let ramp =
            svg.split("points=\"").map(|rest| rest.split('"').next().unwrap_or("")).max_by_key(|points| points.len());
        let points: Vec<f64> =
            ramp.unwrap().split_whitespace().map(|point| point.split_once(',').unwrap().1.parse().unwrap()).collect();
        let rises: Vec<f64> = points.windows(2).map(|pair| pair[0] - pair[1]).collect();
        assert!(rises.len() == 300 && rises.iter().all(|rise| (rise - rises[0]).abs() <= 1.0), "{rises:?}");
    }

    /// A small curve next to a large one has a panel of its own, as high as that of the large one; the picture grows,
    /// and its names stay those of the curves.
    #[test]
    fn small_curves_have_a_panel() {
        let line = |name: &str, color, size: f64| {
            let points = (0..=100).map(|k| (f64::from(k), size * (0.1 * f64::from(k)).sin())).collect();
            Line { name: name.to_owned(), stroke: Stroke::Solid, color, points }
        };
        let axes = [const { String::new() }; 2];
        let lines = vec![line("x", 0, 5.0), line("y", 1, 4.0), line("z", 2, 7e-4)];
        let svg = Chart { title: String::from("tip"), axes, layout: Layout::Panels, lines }.svg().unwrap();
        assert!(svg.starts_with("<svg width=\"960\" height=\"470\" viewBox=\"0 0 9600 4700\""), "{}", &svg[..100]);
        let heights = ["#0072B2", "#D55E00", "#009E73"].map(|color| {
            let curves = svg.lines().filter(|line| line.contains("polyline") && line.contains(color));
            let points = curves.map(|line| line.split("points=\"").nth(1).unwrap().split('"').next().unwrap());
            let longest = points.max_by_key(|points| points.len()).unwrap();
            let heights =
                longest.split_whitespace().map(|point| point.split_once(',').unwrap().1.parse::<f64>().unwrap());
            let [low, high] = heights.fold([f64::INFINITY, 0.0], |[low, high], y| [low.min(y), y.max(high)]);
            high - low
        });
        // The height of a panel without its margins, a tenth of a pixel each.
        assert!(heights[2] > 0.99 * heights[0] && heights[1] < 0.9 * heights[0], "{heights:?}");
    }

    /// A single peak among many points survives.
    #[test]
    fn thinning_keeps_peaks() {
        let points: Vec<_> = (0..50_000).map(|k| (f64::from(k), if k == 12_345 { 7.0 } else { 0.0 })).collect();
        let points = thinned(&points);
        assert!(points.len() <= POINTS + 2);
        assert!(points.contains(&(12_345.0, 7.0)));
    }

    /// The axis of a constant is not its round-off.
    #[test]
    fn ranges_are_never_empty() {
        for values in [vec![], vec![0.0], vec![3.0, 3.0 + 1e-12], vec![f64::NAN]] {
            let (low, high) = range(values.iter().copied());
            assert!(high - low > 0.1, "{values:?}: {low} {high}");
        }
    }
}
