//! The table of estimated errors as CSV.

use crate::numbers::shortest;
use ancf14::error::decimal;
use ancf14::model::run::levels::Level;
use ancf14::model::verification::Report;
use ancf14::model::verification::estimate::Order;

/// The text of errors.csv: all columns, in the order of the results.
pub fn csv(report: &Report) -> String {
    let mut text = String::from(
        "column,unit,scale,error,relative_error,time,step_error,mesh_error,limited_by,order,order_is,kind,remedy\n",
    );
    for row in &report.rows {
        let estimate = &row.estimate;
        let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
        let name = if row.name.contains(',') { quoted(&row.name) } else { row.name.clone() };
        let (order, source) = match estimate.order {
            Order::Observed(order) => (format!("{order:.2}"), "observed"),
            Order::Assumed(order) => (order.to_string(), "assumed"),
        };
        let remedy = row.remedy.as_ref().map_or_else(|| String::from("none"), |settings| settings.join("; "));
        let fields = [
            name,
            row.unit.clone(),
            digits(row.scale),
            digits(estimate.error()),
            digits(row.relative()),
            shortest(decimal(estimate.time)),
            report.part(Level::HalfStep, estimate.step).map_or_else(String::new, digits),
            report.part(Level::DoubleElements, estimate.mesh).map_or_else(String::new, digits),
            estimate.limit.word().to_owned(),
            order,
            source.to_owned(),
            estimate.trust.word().to_owned(),
            if remedy.contains('"') { quoted(&remedy) } else { remedy },
        ];
        text.push_str(&fields.join(","));
        text.push('\n');
    }
    text
}

/// Three digits: an estimate has hardly one.
fn digits(value: f64) -> String {
    shortest(format!("{value:.2e}").parse().unwrap_or(value))
}
