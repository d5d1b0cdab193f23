//! Tables of functions that stand in files of their own: `file` and `column` of `[function.NAME]`.

use super::scope::entries_of;
use crate::model::expression::table::MOST_ROWS;
use crate::model::text::csv::{Cell, Csv, Mistake};
use crate::model::text::diagnostic::Place;
use crate::model::text::names::nearest;
use crate::model::text::tree::{Entry, Item, Node};

/// The file with the table of a function, its place, and what the function says of the column; none: it has no file.
pub(super) fn file_of(function: &Entry) -> Option<(&str, Place, Option<&Item>)> {
    let keys = entries_of(&function.item)?;
    let key = |key: &str| keys.iter().find(|entry| entry.key == key).map(|entry| &entry.item);
    match key("file")? {
        Item { node: Node::Text(name), place } => Some((name, *place, key("column"))),
        _ => None,
    }
}

/// The rows `[x, y]` of a file, text `number` of the model, which is named at `place`.
///
/// # Errors
/// Where and why it is no table, or does not have the column.
pub(super) fn rows(text: &str, number: usize, place: Place, column: Option<&Item>) -> Result<Item, (Place, Mistake)> {
    let within = |range: std::ops::Range<usize>| Place { source: number, start: range.start, end: range.end };
    let csv = Csv::read(text).map_err(|mistake| (within(mistake.range.clone()), mistake))?;
    let refused = |place: Place, message: String, label: String, help| {
        Err((place, Mistake { message, label, help, range: 0..0 }))
    };
    let column = match column {
        None if csv.header.len() < 2 => {
            let place = within(csv.header[0].range.clone());
            return refused(place, String::from("the table has one column only"), String::new(), COLUMNS);
        }
        None => 1,
        Some(Item { node: Node::Text(name), place }) => match column_of(&csv.header, name) {
            Some(column) => column,
            None => {
                let known: Vec<&str> = csv.header.iter().map(Cell::name).collect();
                let near = nearest(name, known.iter().copied());
                let meant = near.map_or(String::new(), |near| format!("did you mean `{near}`? "));
                let label = format!("{meant}known: {}", known.join(", "));
                return refused(*place, format!("the file has no column `{name}`"), label, COLUMNS);
            }
        },
        Some(Item { node, place }) => {
            let message = format!("`column` is {}", node.describe());
            return refused(*place, message, String::from("the name of a column in quotes was expected"), COLUMNS);
        }
    };
    if let Some(row) = csv.rows().nth(MOST_ROWS) {
        let message = format!("the table has {} rows", csv.rows().len());
        let help = "leave out rows that a straight line between their neighbors replaces";
        return refused(within(row[0].1.clone()), message, format!("the limit is {MOST_ROWS}"), help);
    }
    let number = |(value, range): &(f64, std::ops::Range<usize>)| Item {
        place: within(range.clone()),
        node: Node::Float(*value),
    };
    let row = |row: &[(f64, std::ops::Range<usize>)]| Item {
        place: within(row[0].1.start..row[row.len() - 1].1.end),
        node: Node::Array(vec![number(&row[0]), number(&row[column])]),
    };
    let rows: Vec<Item> = csv.rows().map(row).collect();
    Ok(Item { place, node: Node::Array(rows) })
}

/// What columns are for.
const COLUMNS: &str = "the first column is the argument, `column` names the one with the values";

/// The column with this name, written with or without its unit.
fn column_of(header: &[Cell<'_>], name: &str) -> Option<usize> {
    let exact = header.iter().position(|cell| cell.text == name);
    exact.or_else(|| header.iter().position(|cell| cell.name() == name))
}
