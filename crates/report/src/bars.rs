//! Errors as horizontal bars over a logarithmic scale: for each column one bar of the step and one of the mesh.

use crate::chart::{BELOW, COLORS, FINE, GRID, INK, MARGIN, THIN, text};
use ancf14::model::verification::Row;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::error::Error;

/// Columns that are drawn: the worst ones.
const DRAWN: usize = 30;
/// Widths of the picture and of the names in it, heights of a column, of the title and of what stands beside it,
/// pixels.
const WIDTH: u32 = 960;
const NAMES: u32 = 260;
const ROW: u32 = 26;
const TITLE: u32 = 64;
/// Errors below this share of the range are drawn as this: bars need an end to begin from.
const LEAST: f64 = 1e-9;
/// Thickness of a bar, of a row's height.
const THICKNESS: f64 = 0.36;

/// The errors of some columns.
#[derive(Debug)]
pub struct Bars {
    /// Names with the parts of step and mesh, relative; the first one is drawn on top.
    rows: Vec<(String, [f64; 2])>,
    wanted: f64,
}

impl Bars {
    /// Of the worst columns of `rows`, which come worst first, beside the accuracy `wanted`.
    pub fn of(rows: &[&Row], wanted: f64) -> Self {
        let part = |row: &&Row| (row.name.clone(), [row.estimate.step / row.scale, row.estimate.mesh / row.scale]);
        Self { rows: rows.iter().take(DRAWN).map(part).collect(), wanted }
    }

    /// The picture.
    ///
    /// # Errors
    /// It cannot be drawn.
    pub fn svg(&self) -> Result<String, Box<dyn Error>> {
        let shown = (WIDTH, TITLE + ROW * self.rows.len().max(1) as u32 + (BELOW + 2 * MARGIN) as u32 / FINE as u32);
        let size = (shown.0 * FINE as u32, shown.1 * FINE as u32);
        let mut svg = String::new();
        self.draw(&SVGBackend::with_string(&mut svg, size).into_drawing_area())?;
        let words = |(width, height)| format!("width=\"{width}\" height=\"{height}\"");
        Ok(svg.replacen(&words(size), &words(shown), 1))
    }

    fn draw(&self, root: &DrawingArea<SVGBackend<'_>, Shift>) -> Result<(), Box<dyn Error>> {
        root.fill(&WHITE)?;
        let (above, below) = root.split_vertically((TITLE * FINE as u32) as i32);
        self.title(&above)?;
        let decades = self.decades();
        let count = self.rows.len().max(1) as f64;
        let mut chart = ChartBuilder::on(&below)
            .margin(MARGIN)
            .x_label_area_size(BELOW)
            .y_label_area_size((NAMES * FINE as u32) as i32)
            .build_cartesian_2d(decades.0..decades.1, count..0.0)?;
        chart
            .configure_mesh()
            .disable_y_mesh()
            .y_labels(0)
            .x_labels((decades.1 - decades.0) as usize + 1)
            .max_light_lines(0)
            .bold_line_style(GRID.stroke_width(THIN))
            .axis_style(INK.stroke_width(THIN))
            .label_style(text(14).color(&INK))
            .axis_desc_style(text(16).color(&INK))
            .x_desc("error over the range of the quantity")
            .x_label_formatter(&|decade| format!("1e{decade:.0}"))
            .draw()?;
        for (part, color) in COLORS.iter().enumerate().take(2) {
            let bars =
                self.rows.iter().enumerate().filter(|(_, (_, parts))| parts[part] > LEAST).map(|(k, (_, parts))| {
                    let top = k as f64 + 0.5 - THICKNESS * (1.0 - part as f64);
                    Rectangle::new([(decades.0, top), (parts[part].log10(), top + THICKNESS)], color.filled())
                });
            chart.draw_series(bars)?;
        }
        let wanted = self.wanted.log10();
        chart.draw_series(LineSeries::new([(wanted, 0.0), (wanted, count)], INK.stroke_width(THIN)))?;
        let right = Pos::new(HPos::Right, VPos::Center);
        for (k, (name, _)) in self.rows.iter().enumerate() {
            let (x, y) = chart.backend_coord(&(decades.0, k as f64 + 0.5));
            root.draw(&Text::new(name.clone(), (x - 8 * FINE, y), text(14).color(&INK).pos(right)))?;
        }
        root.present()?;
        Ok(())
    }

    /// The title, and below it what the colors and the line mean.
    fn title(&self, area: &DrawingArea<SVGBackend<'_>, Shift>) -> Result<(), Box<dyn Error>> {
        let from = (NAMES * FINE as u32) as i32 + MARGIN;
        area.draw(&Text::new("Estimated errors", (from, 10 * FINE), text(22).color(&INK)))?;
        let y = 46 * FINE;
        let names = ["step".to_owned(), "mesh".to_owned(), format!("wanted: {:e}", self.wanted)];
        for (k, name) in names.into_iter().enumerate() {
            let x = from + 110 * FINE * k as i32;
            let sample = [(x, y), (x + 20 * FINE, y + 10 * FINE)];
            match k {
                2 => area.draw(&PathElement::new(
                    [(x + 10 * FINE, y), (x + 10 * FINE, y + 10 * FINE)],
                    INK.stroke_width(THIN),
                ))?,
                _ => area.draw(&Rectangle::new(sample, COLORS[k].filled()))?,
            }
            area.draw(&Text::new(name, (x + 28 * FINE, y - 3 * FINE), text(15).color(&INK)))?;
        }
        Ok(())
    }

    /// The powers of ten that the scale spans.
    fn decades(&self) -> (f64, f64) {
        let errors = self.rows.iter().flat_map(|(_, parts)| *parts).filter(|error| *error > LEAST);
        let (low, high) =
            errors.chain([self.wanted]).fold((1.0_f64, LEAST), |(low, high), error| (low.min(error), high.max(error)));
        (low.log10().floor().min(high.log10().ceil() - 1.0), high.log10().ceil())
    }
}
