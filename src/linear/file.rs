//! The file of a linear system: a text in TOML with all digits, which `resources/` of its FMU holds.

use super::amplitude::{Amplitude, MOST_KINDS};
use super::matrix::Matrix;
use crate::fmi::variable::{Causality, Quantity, Variability, Variable};
use crate::fmi::{About, Credits, Failure, LogCategory, Value};
use std::fmt::Write;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

/// The most states of such a file. The matrices of a new step length would take seconds beyond.
pub const MOST_STATES: usize = 300;
/// The format of the file.
const FORMAT: i64 = 1;

/// An input or an output.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Signal {
    /// Its name.
    pub name: String,
    /// Its unit, empty where there is none.
    pub unit: String,
    /// Meaning, axes and sign.
    pub description: String,
    /// Its value in the state that the system is about.
    pub value: f64,
    /// Smallest allowed value.
    pub min: Option<f64>,
    /// Largest allowed value.
    pub max: Option<f64>,
    /// Order of magnitude.
    pub nominal: Option<f64>,
    /// Unit that a host shows by default.
    pub display_unit: Option<String>,
}

/// A linear system with names: `dz/dt = A z + B (u − u₀)`, `y − y₀ = C z + D (u − u₀)`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct File {
    /// Names and default experiment. The GUID is that of the text.
    pub about: About,
    /// Inputs.
    pub inputs: Vec<Signal>,
    /// Outputs.
    pub outputs: Vec<Signal>,
    /// Meanings of the states; empty: they are not known.
    pub states: Vec<String>,
    /// `A`.
    pub a: Matrix,
    /// `B`.
    pub b: Matrix,
    /// `C`.
    pub c: Matrix,
    /// `D`.
    pub d: Matrix,
    /// How nonlinear the motions of its states are; none: that is not known.
    pub amplitude: Option<Amplitude>,
}

impl Signal {
    /// Its row of the variable table.
    pub(super) fn variable(&self, causality: Causality, found_from: Option<Vec<usize>>) -> Variable {
        Variable {
            name: self.name.clone(),
            description: self.description.clone(),
            causality,
            variability: Variability::Continuous,
            start: Value::Real(self.value),
            min: self.min,
            max: self.max,
            quantity: Quantity::new("", &self.unit),
            nominal: self.nominal,
            display_unit: self.display_unit.clone(),
            found_from,
            derivative_of: None,
            follows_from: Vec::new(),
        }
    }
}

impl File {
    /// The text of the file.
    pub fn text(&self) -> String {
        let mut text = String::from("# A linear system about a state, for small motions; made by ancf14.\n");
        self.write(&mut text).expect("a String takes every text");
        text
    }

    fn write(&self, text: &mut String) -> std::fmt::Result {
        let About { name, identifier, description, credits, stop, output_step, tolerance, .. } = &self.about;
        writeln!(text, "format = {FORMAT}\nversion = {}", quoted(env!("CARGO_PKG_VERSION")))?;
        for (key, word) in [("name", name), ("identifier", identifier), ("description", description)] {
            writeln!(text, "{key} = {}", quoted(word))?;
        }
        for (key, word) in CREDITS.iter().zip(parts(credits)) {
            if let Some(word) = word {
                writeln!(text, "{key} = {}", quoted(word))?;
            }
        }
        writeln!(text, "stop = {stop:?}\noutput_step = {output_step:?}\ntolerance = {tolerance:?}")?;
        if !self.states.is_empty() {
            let states: Vec<String> = self.states.iter().map(|state| quoted(state)).collect();
            writeln!(text, "states = [{}]", states.join(", "))?;
        }
        let own = [("a", &self.a), ("b", &self.b), ("c", &self.c), ("d", &self.d)];
        for (name, matrix) in own.into_iter().chain(self.amplitude.iter().flat_map(Amplitude::parts)) {
            writeln!(text, "{name} = [")?;
            for row in 0..matrix.rows {
                let row: Vec<String> =
                    (0..matrix.columns).map(|column| format!("{:?}", matrix.at(row, column))).collect();
                writeln!(text, "  [{}],", row.join(", "))?;
            }
            writeln!(text, "]")?;
        }
        for (word, signals) in [("input", &self.inputs), ("output", &self.outputs)] {
            for signal in signals {
                writeln!(text, "\n[[{word}]]\nname = {}\nunit = {}", quoted(&signal.name), quoted(&signal.unit))?;
                writeln!(text, "description = {}\nvalue = {:?}", quoted(&signal.description), signal.value)?;
                for (key, number) in [("min", signal.min), ("max", signal.max), ("nominal", signal.nominal)] {
                    if let Some(number) = number {
                        writeln!(text, "{key} = {number:?}")?;
                    }
                }
                if let Some(unit) = &signal.display_unit {
                    writeln!(text, "display_unit = {}", quoted(unit))?;
                }
            }
        }
        Ok(())
    }

    /// Reads a text; `name` is what messages call the file.
    ///
    /// # Errors
    /// The text is not such a file, with the key that is wrong.
    pub fn read(name: &str, text: &str) -> Result<Self, Failure> {
        let read = || -> Result<Self, String> {
            let table = DeTable::parse(text).map_err(|error| error.message().to_owned())?;
            Reader(table.get_ref()).file()
        };
        let mut file = read().map_err(|problem| Failure {
            message: format!("{name} is not the file of a linear system: {problem}; pack the FMU again"),
            category: LogCategory::StatusError,
            line: None,
        })?;
        let content = format!("ancf14 {}\n{text}", env!("CARGO_PKG_VERSION"));
        file.about.guid = format!("{{{}}}", uuid::Uuid::new_v5(&uuid::Uuid::NAMESPACE_URL, content.as_bytes()));
        Ok(file)
    }
}

/// Keys of the credits.
const CREDITS: [&str; 5] = ["author", "model_version", "license", "copyright", "date"];

fn parts(credits: &Credits) -> [&Option<String>; 5] {
    let Credits { author, version, license, copyright, date } = credits;
    [author, version, license, copyright, date]
}

/// A text as TOML has it.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for character in text.chars() {
        match character {
            '"' | '\\' => quoted.extend(['\\', character]),
            _ if character.is_control() => quoted.push_str(&format!("\\U{:08X}", u32::from(character))),
            _ => quoted.push(character),
        }
    }
    quoted + "\""
}

/// A table of the file.
struct Reader<'a, 'b>(&'a DeTable<'b>);

impl<'a, 'b> Reader<'a, 'b> {
    fn file(&self) -> Result<File, String> {
        let format = self.number("format")?;
        if format != FORMAT as f64 {
            return Err(format!("its format is {format}, and this library reads format {FORMAT}"));
        }
        let inputs = self.signals("input")?;
        let outputs = self.signals("output")?;
        let order = self.list("a")?.len();
        if order == 0 || order > MOST_STATES {
            return Err(format!("it has {order} states, and 1 to {MOST_STATES} are possible"));
        }
        let [author, version, license, copyright, date] = CREDITS.map(|key| self.optional_text(key));
        let credits =
            Credits { author: author?, version: version?, license: license?, copyright: copyright?, date: date? };
        let about = About {
            name: self.text("name")?,
            identifier: self.text("identifier")?,
            description: self.text("description")?,
            credits,
            guid: String::new(),
            start: 0.0,
            stop: self.number("stop")?,
            output_step: self.number("output_step")?,
            tolerance: self.number("tolerance")?,
        };
        if about.output_step <= 0.0 {
            return Err(format!("`output_step` is {}, and must be positive", about.output_step));
        }
        Ok(File {
            a: self.matrix("a", order, order)?,
            b: self.matrix("b", order, inputs.len())?,
            c: self.matrix("c", outputs.len(), order)?,
            d: self.matrix("d", outputs.len(), inputs.len())?,
            amplitude: self.amplitude(order)?,
            about,
            inputs,
            outputs,
            states: self.states(order)?,
        })
    }

    fn value(&self, key: &str) -> Option<&'a DeValue<'b>> {
        self.0.get(key).map(Spanned::get_ref)
    }

    fn optional_text(&self, key: &str) -> Result<Option<String>, String> {
        match self.value(key) {
            None => Ok(None),
            Some(DeValue::String(text)) => Ok(Some(text.to_string())),
            Some(_) => Err(format!("`{key}` is not a text")),
        }
    }

    fn text(&self, key: &str) -> Result<String, String> {
        self.optional_text(key)?.ok_or_else(|| format!("`{key}` is missing"))
    }

    fn optional_number(&self, key: &str) -> Result<Option<f64>, String> {
        let Some(value) = self.value(key) else { return Ok(None) };
        number(value).map(Some).ok_or_else(|| format!("`{key}` is not a finite number"))
    }

    fn number(&self, key: &str) -> Result<f64, String> {
        self.optional_number(key)?.ok_or_else(|| format!("`{key}` is missing"))
    }

    fn list(&self, key: &str) -> Result<&'a DeArray<'b>, String> {
        match self.value(key) {
            Some(DeValue::Array(list)) => Ok(list),
            Some(_) => Err(format!("`{key}` is not a list")),
            None => Err(format!("`{key}` is missing")),
        }
    }

    fn signals(&self, key: &str) -> Result<Vec<Signal>, String> {
        if self.value(key).is_none() {
            return Ok(Vec::new());
        }
        let signal = |item: &'a Spanned<DeValue<'b>>| {
            let DeValue::Table(table) = item.get_ref() else {
                return Err(format!("an entry of `{key}` is not a table"));
            };
            let table = Reader(table);
            Ok(Signal {
                name: table.text("name")?,
                unit: table.text("unit")?,
                description: table.text("description")?,
                value: table.number("value")?,
                min: table.optional_number("min")?,
                max: table.optional_number("max")?,
                nominal: table.optional_number("nominal")?,
                display_unit: table.optional_text("display_unit")?,
            })
        };
        self.list(key)?.iter().map(signal).collect()
    }

    /// The meanings of the states, where the file has them.
    fn states(&self, order: usize) -> Result<Vec<String>, String> {
        if self.value("states").is_none() {
            return Ok(Vec::new());
        }
        let text = |item: &Spanned<DeValue<'_>>| match item.get_ref() {
            DeValue::String(text) => Some(text.to_string()),
            _ => None,
        };
        let states: Option<Vec<String>> = self.list("states")?.iter().map(text).collect();
        states.filter(|states| states.len() == order).ok_or_else(|| format!("`states` is not a list of {order} texts"))
    }

    /// How nonlinear motions are, where the file has it.
    fn amplitude(&self, order: usize) -> Result<Option<Amplitude>, String> {
        let keys = Amplitude::default().parts().map(|(key, _)| key);
        if keys.iter().all(|key| self.value(key).is_none()) {
            return Ok(None);
        }
        let [real, imaginary, linear, even, odd] = keys;
        let motions = self.list(real)?.len();
        if motions == 0 || motions > order {
            return Err(format!("`{real}` has {motions} rows, and 1 to {order} are possible"));
        }
        let kinds = self.list(linear)?.first().map_or(0, |row| match row.get_ref() {
            DeValue::Array(values) => values.len(),
            _ => 0,
        });
        if kinds == 0 || kinds > MOST_KINDS {
            return Err(format!("`{linear}` has {kinds} numbers in a row, and 1 to {MOST_KINDS} are possible"));
        }
        Ok(Some(Amplitude {
            real: self.matrix(real, motions, order)?,
            imaginary: self.matrix(imaginary, motions, order)?,
            linear: self.matrix(linear, motions, kinds)?,
            even: self.matrix(even, motions, kinds)?,
            odd: self.matrix(odd, motions, kinds)?,
        }))
    }

    fn matrix(&self, key: &str, rows: usize, columns: usize) -> Result<Matrix, String> {
        let list = self.list(key)?;
        let wrong = || format!("`{key}` is not a list of {rows} rows with {columns} finite numbers each");
        let is_wide =
            |item: &Spanned<DeValue<'_>>| matches!(item.get_ref(), DeValue::Array(values) if values.len() == columns);
        // Before any memory is asked for: a damaged file may name millions of signals.
        if list.len() != rows || !list.iter().all(is_wide) {
            return Err(wrong());
        }
        let mut matrix = Matrix::zeros(rows, columns);
        for (row, item) in list.iter().enumerate() {
            let DeValue::Array(values) = item.get_ref() else { return Err(wrong()) };
            for (column, value) in values.iter().enumerate() {
                *matrix.at_mut(row, column) = number(value.get_ref()).ok_or_else(wrong)?;
            }
        }
        Ok(matrix)
    }
}

/// A finite number.
fn number(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Integer(number) => {
            i64::from_str_radix(number.as_str(), number.radix()).ok().map(|number| number as f64)
        }
        DeValue::Float(number) => number.as_str().parse().ok().filter(|number: &f64| number.is_finite()),
        _ => None,
    }
}
