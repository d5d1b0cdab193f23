//! Tables of numbers as text: a header, and rows of numbers separated by commas. Every cell knows its place for
//! messages.

use std::ops::Range;

/// A table as text.
#[derive(Debug)]
pub struct Csv<'t> {
    /// The names of the columns.
    pub header: Vec<Cell<'t>>,
    /// The numbers of all rows, one row behind the other.
    cells: Vec<(f64, Range<usize>)>,
}

/// A cell, without spaces and quotes around it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cell<'t> {
    /// Its text.
    pub text: &'t str,
    /// Its bytes in the table; of an empty cell where it would be.
    pub range: Range<usize>,
}

impl<'t> Cell<'t> {
    /// The text without a unit behind it: `time` of `time [s]`.
    pub fn name(&self) -> &'t str {
        let unit = self.text.strip_suffix(']').and_then(|text| text.rfind('['));
        unit.map_or(self.text, |at| self.text[..at].trim_end())
    }
}

/// What is wrong with a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// What is wrong.
    pub message: String,
    /// What stands behind the underlining.
    pub label: String,
    /// What to do.
    pub help: &'static str,
    /// The wrong bytes of the table.
    pub range: Range<usize>,
}

/// What the first line is for.
const HEADER: &str = "the first line names the columns, as in: time [s],speed [m/s]";

impl<'t> Csv<'t> {
    /// Reads a table. Empty lines are passed over.
    ///
    /// # Errors
    /// There is no header, or a row has another number of cells than the header, or a cell is not a finite number.
    pub fn read(text: &'t str) -> Result<Self, Mistake> {
        // Spreadsheets begin with a byte order mark.
        let begin = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
        let mut start = begin;
        let mut table: Option<Self> = None;
        for line in text[begin..].split_inclusive('\n') {
            let range = start..start + line.trim_end().len();
            start += line.len();
            if range.is_empty() {
                continue;
            }
            let cells = cells(text, range.clone());
            match &mut table {
                None => table = Some(Self { header: header(cells, range)?, cells: Vec::new() }),
                Some(table) => table.add(&cells, range)?,
            }
        }
        table.ok_or_else(|| mistake("the table is empty", "", HEADER, 0..0))
    }

    fn add(&mut self, cells: &[Cell<'_>], line: Range<usize>) -> Result<(), Mistake> {
        if cells.len() != self.header.len() {
            let message = format!("this row has {} cell(s), the header has {}", cells.len(), self.header.len());
            return Err(mistake(&message, "", "a decimal number has a point, and a comma ends a cell", line));
        }
        for cell in cells {
            match cell.text.parse::<f64>() {
                Ok(value) if value.is_finite() => self.cells.push((value, cell.range.clone())),
                _ if cell.text.is_empty() => return Err(mistake("a number is missing", "", "", cell.range.clone())),
                _ => {
                    let message = format!("`{}` is not a finite number", cell.text);
                    return Err(mistake(&message, "a number was expected", "", cell.range.clone()));
                }
            }
        }
        Ok(())
    }

    /// The rows, without the header.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[(f64, Range<usize>)]> {
        self.cells.chunks_exact(self.header.len())
    }
}

fn mistake(message: &str, label: &str, help: &'static str, range: Range<usize>) -> Mistake {
    Mistake { message: message.to_owned(), label: label.to_owned(), help, range }
}

/// The names of the columns: numbers are none.
fn header(cells: Vec<Cell<'_>>, line: Range<usize>) -> Result<Vec<Cell<'_>>, Mistake> {
    if let [only] = cells.as_slice()
        && only.text.contains([';', '\t'])
    {
        let help = "save the file with commas between the cells and points in the numbers";
        return Err(mistake("the columns are not separated by commas", "", help, line));
    }
    if let Some(number) = cells.iter().find(|cell| cell.text.parse::<f64>().is_ok()) {
        let message = format!("the table has no header: `{}` is a number", number.text);
        return Err(mistake(&message, "the name of a column was expected", HEADER, number.range.clone()));
    }
    if let Some(empty) = cells.iter().find(|cell| cell.name().is_empty()) {
        return Err(mistake("a column has no name", "", HEADER, empty.range.clone()));
    }
    Ok(cells)
}

/// The cells of a line. A comma between quotes ends no cell.
fn cells(text: &str, line: Range<usize>) -> Vec<Cell<'_>> {
    let mut cells = Vec::new();
    let mut start = line.start;
    let mut is_quoted = false;
    for (at, character) in text[line.clone()].char_indices() {
        match character {
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => {
                cells.push(cell(text, start..line.start + at));
                start = line.start + at + 1;
            }
            _ => {}
        }
    }
    cells.push(cell(text, start..line.end));
    cells
}

fn cell(text: &str, range: Range<usize>) -> Cell<'_> {
    let mut inner = text[range.clone()].trim();
    if let Some(bare) = inner.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')) {
        inner = bare.trim();
    }
    let start = inner.as_ptr() as usize - text.as_ptr() as usize;
    Cell { text: inner, range: start..start + inner.len() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_known_with_their_places() {
        let text = "\u{feff}time [s], \"speed, mean [m/s]\"\r\n0,1.5\r\n\r\n 1e-3 ,\"-2\"\n";
        let table = Csv::read(text).unwrap();
        assert_eq!(table.header.iter().map(Cell::name).collect::<Vec<_>>(), ["time", "speed, mean"]);
        let values: Vec<Vec<f64>> = table.rows().map(|row| row.iter().map(|(value, _)| *value).collect()).collect();
        assert_eq!(values, [[0.0, 1.5], [1e-3, -2.0]]);
        let places: Vec<&str> = table.rows().flatten().map(|(_, range)| &text[range.clone()]).collect();
        assert_eq!(places, ["0", "1.5", "1e-3", "-2"]);
    }

    #[test]
    fn mistakes_stand_where_they_are() {
        for (text, message, wrong) in [
            ("", "the table is empty", ""),
            ("0,1\n1,2\n", "the table has no header: `0` is a number", "0"),
            ("t;x\n0;1\n", "the columns are not separated by commas", "t;x"),
            ("t,[m]\n0,1\n", "a column has no name", "[m]"),
            ("t,x\n0,1\n1,5,5\n", "this row has 3 cell(s), the header has 2", "1,5,5"),
            ("t,x\n0,1\n1,inf\n", "`inf` is not a finite number", "inf"),
            ("t,x\n0,1\n1,\n", "a number is missing", ""),
        ] {
            let mistake = Csv::read(text).expect_err(text);
            assert_eq!((mistake.message.as_str(), &text[mistake.range]), (message, wrong), "{text}");
        }
    }
}
