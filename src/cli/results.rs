//! The table of results: rows in memory for the plots, and the same rows in results.csv.

use ancf14::error::decimal;
use ancf14::fmi::variable::{Causality, Variable};
use ancf14::fmi::{Model, Value};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// One column of the results.
#[derive(Debug)]
pub struct Column {
    /// Place in the variable table.
    reference: usize,
    /// Name of the variable.
    pub name: String,
    /// Unit label; empty: dimensionless.
    pub unit: String,
}

/// The results so far.
#[derive(Debug)]
pub struct Results {
    /// The outputs, in the order of the variable table.
    pub columns: Vec<Column>,
    /// Times, s.
    pub times: Vec<f64>,
    /// Values, one row per time, in the order of the columns.
    pub rows: Vec<Vec<f64>>,
    file: BufWriter<File>,
}

impl Results {
    /// Begins results.csv with its header.
    pub fn create(path: &Path, variables: &[Variable]) -> io::Result<Self> {
        let outputs = variables.iter().enumerate().filter(|(_, variable)| variable.causality == Causality::Output);
        let columns: Vec<_> = outputs
            .map(|(reference, variable)| Column {
                reference,
                name: variable.name.clone(),
                unit: variable.quantity.unit.clone(),
            })
            .collect();
        let mut file = BufWriter::new(File::create(path)?);
        write!(file, "time")?;
        for column in &columns {
            // A name with two indices has a comma in it.
            let quote = if column.name.contains(',') { "\"" } else { "" };
            write!(file, ",{quote}{}{quote}", column.name)?;
        }
        writeln!(file)?;
        Ok(Self { columns, times: Vec::new(), rows: Vec::new(), file })
    }

    /// Adds a row.
    pub fn record(&mut self, time: f64, model: &impl Model) -> io::Result<()> {
        let values: Vec<Value> = self.columns.iter().map(|column| model.value(column.reference)).collect();
        write!(self.file, "{}", shortest(decimal(time)))?;
        for value in &values {
            match value {
                Value::Real(value) => write!(self.file, ",{}", shortest(*value))?,
                Value::Integer(value) => write!(self.file, ",{value}")?,
            }
        }
        writeln!(self.file)?;
        self.times.push(time);
        self.rows.push(values.into_iter().map(Value::number).collect());
        Ok(())
    }

    /// Makes sure that the rows are on the disk.
    pub fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }

    /// The last value of a column, by its name.
    pub fn last(&self, name: &str) -> Option<f64> {
        let column = self.columns.iter().position(|column| column.name == name)?;
        self.rows.last().map(|row| row[column])
    }
}

/// The shortest text that reads back to the same double.
pub fn shortest(value: f64) -> String {
    let (plain, exponent) = (format!("{value}"), format!("{value:e}"));
    if exponent.len() < plain.len() { exponent } else { plain }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever the size, the text reads back exactly, and no other notation of Rust is shorter.
    #[test]
    fn shortest_text_reads_back() {
        for (value, text) in [
            (0.1, "0.1"),
            (-0.0, "-0"),
            (1e-300, "1e-300"),
            (1e21, "1e21"),
            (0.001, "1e-3"),
            (123456.75, "123456.75"),
            (1.0 / 3.0, "0.3333333333333333"),
            (5e-324, "5e-324"),
            (f64::MAX, "1.7976931348623157e308"),
        ] {
            assert_eq!(shortest(value), text);
            assert_eq!(text.parse::<f64>().map(f64::to_bits), Ok(value.to_bits()));
        }
    }
}
