//! Convergence studies: errors over the number of elements, with the measured order.

use std::fmt::Write;

/// Below this an error is the round-off of the run and the digits of the reference: no order is measured there.
const ROUND_OFF: f64 = 1e-12;

/// The words of `twist` in a model file.
pub const TWISTS: [&str; 2] = ["linear", "quadratic"];

/// A table of `error(elements, twist)` over the numbers of elements, a row each, with both twists and their orders.
pub fn twists(elements: &[u32], error: impl Fn(u32, &str) -> f64) -> String {
    let columns = TWISTS.map(|twist| (format!("{twist} twist"), elements.iter().map(|n| error(*n, twist)).collect()));
    table("elements", &elements.iter().map(|n| f64::from(*n)).collect::<Vec<_>>(), &columns)
}

/// A table of errors over `sizes` (elements, or steps): a row each; a column each of `columns` and the order from row
/// to row.
pub fn table(first: &str, sizes: &[f64], columns: &[(String, Vec<f64>)]) -> String {
    let mut text = format!("| {first} |");
    for (name, _) in columns {
        let _ = write!(text, " {name} | order |");
    }
    text += "\n|---|";
    text += &"---|---|".repeat(columns.len());
    for (row, size) in sizes.iter().enumerate() {
        let _ = write!(text, "\n| {size} |");
        for (_, errors) in columns {
            let order = match row {
                0 => String::new(),
                _ => order([sizes[row - 1], *size], [errors[row - 1], errors[row]]),
            };
            let _ = write!(text, " {} | {order} |", small(errors[row]));
        }
    }
    text + "\n"
}

/// An error with two digits.
pub fn small(error: f64) -> String {
    if error.abs() < ROUND_OFF { String::from("round-off") } else { format!("{error:.1e}") }
}

/// The order by which an error falls from `coarse` to `fine` with twice, or any multiple, of the elements.
pub fn order([from, to]: [f64; 2], [coarse, fine]: [f64; 2]) -> String {
    if fine < ROUND_OFF || coarse < ROUND_OFF {
        return String::new();
    }
    format!("{:.2}", (coarse / fine).log2() / (to / from).log2().abs())
}
