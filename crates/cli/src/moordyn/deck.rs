//! Reads an input file of MoorDyn (version 1 or 2): sections with a line of names and a line of units, a row a thing.

use std::collections::BTreeMap;

/// A row: the line that it stands in, from 1, and its values by the names of their columns.
#[derive(Clone, Debug, Default)]
pub struct Row {
    /// The line of the file, from 1.
    pub line: usize,
    /// Its words.
    words: Vec<String>,
    /// The names of the columns, in small letters without signs.
    names: Vec<String>,
}

/// An input file.
#[derive(Clone, Debug, Default)]
pub struct Deck {
    /// The rows of the sections, by the words of [`SECTIONS`].
    rows: BTreeMap<&'static str, Vec<Row>>,
    /// The options: keys in small letters with their values and lines.
    options: Vec<(String, String, usize)>,
    /// Sections that are not known, with their lines.
    pub unknown: Vec<(String, usize)>,
}

/// The words of titles, and what they begin. The first that fits counts.
const SECTIONS: [(&str, &str); 18] = [
    ("LINE TYPES", "line types"),
    ("LINE DICTIONARY", "line types"),
    ("ROD TYPES", "rod types"),
    ("ROD DICTIONARY", "rod types"),
    ("BODIES", "bodies"),
    ("BODY", "bodies"),
    ("RODS", "rods"),
    ("ROD ", "rods"),
    ("POINT", "points"),
    ("CONNECTION", "points"),
    ("NODE", "points"),
    ("LINES", "lines"),
    ("LINE ", "lines"),
    ("OPTIONS", "options"),
    ("SOLVER OPTIONS", "options"),
    ("CONTROL", "control"),
    ("FAILURE", "failure"),
    ("OUTPUT", "outputs"),
];

/// The columns of a section whose line of names is not known, in the order of version 2.
fn usual(section: &str) -> &'static [&'static str] {
    match section {
        "line types" => &["name", "diam", "mass", "ea", "ba", "ei", "cd", "ca", "cdax", "caax"],
        "rod types" => &["name", "diam", "mass", "cd", "ca", "cdend", "caend"],
        "bodies" => &["id", "attachment", "x", "y", "z", "r0", "p0", "y0", "mass", "cg", "i", "volume", "cda", "ca"],
        "rods" => &["id", "rodtype", "attachment", "xa", "ya", "za", "xb", "yb", "zb", "numsegs"],
        "points" => &["id", "type", "x", "y", "z", "mass", "volume", "cda", "ca"],
        "lines" => &["id", "linetype", "attacha", "attachb", "length", "numsegs"],
        _ => &[],
    }
}

/// Names of columns in other versions, and those of here.
const ALIASES: [(&str, &str); 40] = [
    ("typename", "name"),
    ("linetype", "linetype"),
    ("diameter", "diam"),
    ("massden", "mass"),
    ("massdeninair", "mass"),
    ("massm", "mass"),
    ("m", "mass"),
    ("bazeta", "ba"),
    ("bbar", "ba"),
    ("ba", "ba"),
    ("cint", "ba"),
    ("can", "ca"),
    ("cat", "caax"),
    ("cdn", "cd"),
    ("cdt", "cdax"),
    ("cdan", "cd"),
    ("cdat", "cdax"),
    ("node", "id"),
    ("line", "id"),
    ("rodid", "id"),
    ("bodyid", "id"),
    ("attachment", "attachment"),
    ("attach", "attachment"),
    ("x0", "x"),
    ("y0", "y"),
    ("z0", "z"),
    ("v", "volume"),
    ("vol", "volume"),
    ("nodea", "attacha"),
    ("nodeanch", "attacha"),
    ("nodeb", "attachb"),
    ("nodefair", "attachb"),
    ("unstrlen", "length"),
    ("unstretchedlength", "length"),
    ("type", "type"),
    ("att", "type"),
    ("attachtype", "type"),
    ("cg", "cg"),
    ("cog", "cg"),
    ("ixyz", "i"),
];

impl Deck {
    /// Reads the text.
    ///
    /// # Errors
    /// It has no lines in it, or a row that is cut off, as a sentence.
    pub fn read(text: &str) -> Result<Self, String> {
        let mut deck = Self::default();
        let mut lines = text.lines().enumerate().map(|(number, line)| (number + 1, line));
        let mut section: Option<(&'static str, Vec<String>)> = None;
        while let Some((number, line)) = lines.next() {
            let trimmed = line.trim();
            if trimmed.starts_with("---") || trimmed.starts_with("===") {
                let upper = trimmed.trim_matches(['-', '=', ' ']).to_uppercase();
                let found = SECTIONS.iter().find(|(word, _)| format!("{upper} ").starts_with(word));
                section = found.map(|(_, section)| (*section, Vec::new()));
                match &mut section {
                    Some(("options", _)) => {}
                    Some((section, names)) => {
                        let titles = lines.next().map(|(_, line)| line).unwrap_or_default();
                        *names = columns(section, titles);
                        lines.next();
                    }
                    // The first line, and the last one.
                    None if number > 2 && !upper.is_empty() && !upper.contains("NEED THIS LINE") => {
                        deck.unknown.push((upper, number));
                    }
                    None => {}
                }
                continue;
            }
            let (Some((section, names)), false) = (&section, trimmed.is_empty() || trimmed.starts_with('#')) else {
                continue;
            };
            let words: Vec<String> = trimmed.split_whitespace().map(String::from).collect();
            if *section == "options" {
                if let [value, key, ..] = words.as_slice() {
                    deck.options.push((key.to_lowercase(), value.clone(), number));
                }
                continue;
            }
            deck.rows.entry(section).or_default().push(Row { line: number, words, names: names.clone() });
        }
        match deck.rows("lines").is_empty() && deck.rows("rods").is_empty() {
            true => Err(String::from("it has no section LINES with a line in it: is it an input file of MoorDyn?")),
            false => Ok(deck),
        }
    }

    /// The rows of a section.
    pub fn rows(&self, section: &str) -> &[Row] {
        self.rows.get(section).map_or(&[], Vec::as_slice)
    }

    /// The value of the first of `keys` (small letters) that the options have.
    ///
    /// # Errors
    /// It is not a number, as a sentence.
    pub fn option(&self, keys: &[&str]) -> Result<Option<f64>, String> {
        let Some((key, value, line)) = self.options.iter().find(|(key, ..)| keys.contains(&key.as_str())) else {
            return Ok(None);
        };
        number(value).map(Some).ok_or_else(|| format!("line {line}: option {key} is \"{value}\", not a number"))
    }

    /// The options that are none of `known` (small letters), as they are written.
    pub fn other_options<'a>(&'a self, known: &'a [&str]) -> impl Iterator<Item = (&'a str, &'a str)> {
        let others = self.options.iter().filter(move |(key, ..)| !known.contains(&key.as_str()));
        others.map(|(key, value, _)| (key.as_str(), value.as_str()))
    }
}

/// A finite number.
fn number(word: &str) -> Option<f64> {
    word.replace(['d', 'D'], "e").parse::<f64>().ok().filter(|value| value.is_finite())
}

/// The names of the columns: those of the title line where it names all that a section needs.
fn columns(section: &str, titles: &str) -> Vec<String> {
    let plain = |word: &str| {
        let word: String = word.to_lowercase().chars().filter(char::is_ascii_alphanumeric).collect();
        ALIASES.iter().find(|(own, _)| *own == word).map_or(word, |(_, name)| (*name).to_owned())
    };
    let mut written: Vec<String> = titles.split_whitespace().map(plain).collect();
    // Version 1 calls the name of a type `LineType`.
    if section == "line types" && written.first().is_some_and(|own| own == "linetype") {
        written[0] = String::from("name");
    }
    let usual = usual(section);
    let needed = match section {
        "line types" => &["name", "diam", "mass", "ea"][..],
        "points" => &["id", "x", "y", "z"],
        "lines" => &["id", "attacha", "attachb", "length"],
        _ => &["no title is enough"],
    };
    match needed.iter().all(|name| written.iter().any(|own| own == name)) {
        true => written,
        false => usual.iter().map(|name| (*name).to_owned()).collect(),
    }
}

impl Row {
    /// The word of a column; none: the row has none.
    pub fn word(&self, column: &str) -> Option<&str> {
        let at = self.names.iter().position(|name| name == column)?;
        self.words.get(at).map(String::as_str)
    }

    /// The word of a column that must be there.
    ///
    /// # Errors
    /// It is not, as a sentence.
    pub fn needed(&self, column: &str) -> Result<&str, String> {
        self.word(column).ok_or_else(|| format!("line {}: `{column}` is missing in this row", self.line))
    }

    /// The number of a column that must be there.
    ///
    /// # Errors
    /// It is not there, or is not a number, as a sentence.
    pub fn number(&self, column: &str) -> Result<f64, String> {
        let word = self.needed(column)?;
        number(word).ok_or_else(|| format!("line {}: `{column}` is \"{word}\", and a number is needed", self.line))
    }

    /// The number of a column, 0 where there is none.
    ///
    /// # Errors
    /// It is not a number, as a sentence.
    pub fn number_or_zero(&self, column: &str) -> Result<f64, String> {
        match self.word(column) {
            None | Some("-") => Ok(0.0),
            Some(_) => self.number(column),
        }
    }

    /// The numbers of a column with `|` between them: one stands for all three.
    ///
    /// # Errors
    /// One of them is not a number, as a sentence.
    pub fn three(&self, column: &str) -> Result<[f64; 3], String> {
        let Some(word) = self.word(column) else { return Ok([0.0; 3]) };
        let values: Option<Vec<f64>> = word.split('|').map(number).collect();
        match values.as_deref() {
            Some([one]) => Ok([*one; 3]),
            Some([x, y, z]) => Ok([*x, *y, *z]),
            _ => {
                Err(format!("line {}: `{column}` is \"{word}\", and one number or three, a|b|c, are needed", self.line))
            }
        }
    }

    /// The numbers of three columns.
    ///
    /// # Errors
    /// One of them is not a number, as a sentence.
    pub fn vector(&self, columns: [&str; 3]) -> Result<[f64; 3], String> {
        let [x, y, z] = columns.map(|column| self.number(column));
        Ok([x?, y?, z?])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Version 1 has other names and another order of columns, and no bending stiffness.
    #[test]
    fn columns_by_their_names() {
        let text = "--- MoorDyn\n---------- LINE DICTIONARY ----------\n\
                    LineType Diam MassDenInAir EA BA/-zeta Can Cat Cdn Cdt\n(-) (m) (kg/m) (N) (-) (-) (-) (-) (-)\n\
                    main 0.09 77.7 3.8e8 -0.8 1.0 0.1 1.6 0.2\n\
                    ------- LINE PROPERTIES -----\nLine LineType UnstrLen NumSegs NodeAnch NodeFair Flags\n(-)\n\
                    1 main 902.2 20 1 4 p\n---------- SOLVER OPTIONS ----------\n0.002 dtM step\n";
        let deck = Deck::read(text).unwrap();
        let kind = &deck.rows("line types")[0];
        let numbers = ["cd", "cdax", "ca", "caax", "ea"].map(|name| kind.number(name).unwrap());
        assert_eq!(numbers, [1.6, 0.2, 1.0, 0.1, 3.8e8]);
        assert_eq!(kind.word("ei"), None);
        let line = &deck.rows("lines")[0];
        assert_eq!(
            [line.number("attacha"), line.number("attachb"), line.number("length")],
            [Ok(1.0), Ok(4.0), Ok(902.2)]
        );
        assert_eq!(deck.option(&["dtm"]), Ok(Some(0.002)));
    }

    #[test]
    fn no_deck() {
        assert!(Deck::read("format = 1\n").unwrap_err().contains("no section LINES"));
    }
}
