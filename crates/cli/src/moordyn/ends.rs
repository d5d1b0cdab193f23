//! Attachments of lines and rods: points and bodies of MoorDyn.

use super::deck::{Deck, Row};
use super::text::{Text, listed, shown};
use std::collections::BTreeMap;

/// The attachment of an end of a line.
#[derive(Clone, Debug, PartialEq)]
pub enum Held {
    /// The ground.
    Ground,
    /// The frame or body of this name.
    Part(String),
    /// Nothing but the other lines that end there: the number of a point.
    Lines(String),
}

/// Where a line ends.
#[derive(Clone, Debug)]
pub struct End {
    /// Position, m.
    pub at: [f64; 3],
    /// Its attachment.
    pub held: Held,
}

/// A part that moves freely in the water.
#[derive(Clone, Debug)]
struct Float {
    name: String,
    mass: f64,
    /// The center of mass, m.
    at: [f64; 3],
    inertia: [f64; 3],
    volume: f64,
    drag_areas: [f64; 3],
    added: [f64; 3],
}

/// All of them.
#[derive(Clone, Debug, Default)]
pub struct Ends {
    points: BTreeMap<String, End>,
    /// Positions and parts of bodies.
    bodies: BTreeMap<String, End>,
    floats: Vec<Float>,
    /// Frames that a host moves, with their positions.
    frames: Vec<(String, [f64; 3])>,
    notes: Vec<String>,
    density: f64,
}

/// The frame that carries all coupled points.
const VESSEL: &str = "vessel";
/// The first letters of the names of bodies that are points.
pub const POINT: &str = "point";
/// Density of a point whose volume is 0, kg/m³: steel.
const STEEL: f64 = 7850.0;

/// The words of MoorDyn for what holds a part, in small letters.
const FIXED: [&str; 4] = ["fixed", "fix", "anchor", "ground"];
const COUPLED: [&str; 8] = ["coupled", "vessel", "ves", "cpld", "fair", "fairlead", "coupledpinned", "cpldpin"];
const FREE: [&str; 5] = ["free", "point", "connect", "con", "connection"];

/// The meaning of a word for a part.
pub enum Attachment {
    /// It is held by the ground.
    Fixed,
    /// A host moves it.
    Coupled,
    /// It moves freely.
    Free,
    /// It is a part of the body of this number.
    Body(String),
}

/// The meaning of a word.
///
/// # Errors
/// It has none, as a sentence.
pub fn attachment(row: &Row, word: &str) -> Result<Attachment, String> {
    let small = word.to_lowercase();
    let is = |words: &[&str]| words.contains(&small.as_str());
    if is(&FIXED) || small == "pinned" {
        return Ok(Attachment::Fixed);
    }
    if is(&COUPLED) {
        return Ok(Attachment::Coupled);
    }
    if is(&FREE) {
        return Ok(Attachment::Free);
    }
    match small.strip_prefix("body") {
        Some(number) => {
            let number = number.trim_end_matches("pinned");
            Ok(Attachment::Body(number.to_owned()))
        }
        None => Err(format!("line {}: \"{word}\" is none of Fixed, Coupled, Free and Body1", row.line)),
    }
}

impl Ends {
    /// Reads points and bodies.
    ///
    /// # Errors
    /// A row cannot be read, as a sentence.
    pub fn read(deck: &Deck) -> Result<Self, String> {
        let density = deck.option(&["wtrdnsty", "rhow"])?.unwrap_or(super::DENSITY);
        let mut ends = Self { density, ..Self::default() };
        for row in deck.rows("bodies") {
            ends.read_body(row)?;
        }
        for row in deck.rows("points") {
            ends.read_point(row)?;
        }
        Ok(ends)
    }

    fn read_body(&mut self, row: &Row) -> Result<(), String> {
        let number = row.needed("id")?.to_owned();
        let (name, at) = (format!("body{number}"), row.vector(["x", "y", "z"])?);
        if ["r0", "p0", "y0"].into_iter().any(|key| row.number_or_zero(key).is_ok_and(|angle| angle != 0.0)) {
            self.notes.push(format!("Body {number} (line {}) is drawn without its rotation.", row.line));
        }
        let held = match attachment(row, row.needed("attachment")?)? {
            Attachment::Fixed => Held::Ground,
            Attachment::Coupled => {
                self.frames.push((name.clone(), at));
                Held::Part(name)
            }
            Attachment::Body(_) => return Err(format!("line {}: a body cannot be a part of a body", row.line)),
            Attachment::Free => {
                let [along, inertia] = [row.three("cg")?, row.three("i")?];
                let is_height = !row.word("cg").is_some_and(|word| word.contains('|'));
                let along = if is_height { [0.0, 0.0, along[2]] } else { along };
                let center = std::array::from_fn(|i| at[i] + along[i]);
                self.add_float(row, &name, center, inertia)?;
                Held::Part(name)
            }
        };
        self.bodies.insert(number, End { at, held });
        Ok(())
    }

    fn add_float(&mut self, row: &Row, name: &str, at: [f64; 3], inertia: [f64; 3]) -> Result<(), String> {
        let (mass, volume) = (row.number("mass")?, row.number_or_zero("volume")?);
        if mass <= 0.0 {
            return Err(format!("line {}: {name} moves freely and has no mass; give it one", row.line));
        }
        // The three axes, of six numbers that MoorDyn takes too.
        let [drag_areas, coefficients] = [row.three("cda")?, row.three("ca")?];
        let added = coefficients.map(|own| own * self.density * volume);
        let sphere = 0.4
            * mass
            * (0.75 / std::f64::consts::PI * if volume > 0.0 { volume } else { mass / STEEL }).powf(2.0 / 3.0);
        let inertia = inertia.map(|own| if own > 0.0 { own } else { sphere });
        self.floats.push(Float { name: name.to_owned(), mass, at, inertia, volume, drag_areas, added });
        Ok(())
    }

    fn read_point(&mut self, row: &Row) -> Result<(), String> {
        let number = row.needed("id")?.to_owned();
        let at = row.vector(["x", "y", "z"])?;
        let word = row.word("type").or_else(|| row.word("attachment"));
        let end = match attachment(row, word.unwrap_or(""))? {
            Attachment::Fixed => End { at, held: Held::Ground },
            Attachment::Coupled => {
                self.need_vessel();
                End { at, held: Held::Part(VESSEL.to_owned()) }
            }
            Attachment::Body(body) => {
                let carrier = self.bodies.get(&body);
                let carrier = carrier.ok_or_else(|| format!("line {}: there is no body {body}", row.line))?;
                End { at: std::array::from_fn(|i| carrier.at[i] + at[i]), held: carrier.held.clone() }
            }
            Attachment::Free if row.number_or_zero("mass")? > 0.0 => {
                let name = format!("{POINT}{number}");
                self.add_float(row, &name, at, [0.0; 3])?;
                End { at, held: Held::Part(name) }
            }
            Attachment::Free => {
                if row.number_or_zero("volume")? > 0.0 {
                    return Err(format!("line {}: point {number} has a volume and no mass; give it one", row.line));
                }
                End { at, held: Held::Lines(number.clone()) }
            }
        };
        self.points.insert(number, end);
        Ok(())
    }

    /// The point of a number.
    pub fn point(&self, number: &str) -> Option<&End> {
        self.points.get(number)
    }

    /// The part that holds a rod; none: it moves freely.
    pub fn holder(&self, attachment: &Attachment) -> Option<Held> {
        match attachment {
            Attachment::Fixed => Some(Held::Ground),
            Attachment::Coupled => Some(Held::Part(VESSEL.to_owned())),
            Attachment::Body(body) => self.bodies.get(body).map(|body| body.held.clone()),
            Attachment::Free => None,
        }
    }

    /// Adds the frame of the vessel if it is not there.
    pub fn need_vessel(&mut self) {
        if self.frames.iter().all(|(name, _)| name != VESSEL) {
            self.frames.push((VESSEL.to_owned(), [0.0; 3]));
        }
    }

    /// The height of the lowest point, m.
    pub fn lowest(&self) -> Option<f64> {
        self.points.values().map(|point| point.at[2]).min_by(f64::total_cmp)
    }

    /// Writes frames and bodies.
    pub fn write(&self, out: &mut Text) {
        self.notes.iter().for_each(|note| out.note(note));
        for (name, at) in &self.frames {
            out.section(&format!("frame.{name}"));
            out.key("position", &listed(*at), "coupled points move with it, by the host");
            out.key("input", "true", "");
        }
        for float in &self.floats {
            out.section(&format!("body.{}", float.name));
            out.key("mass", &shown(float.mass), "kg");
            out.key("position", &listed(float.at), "center of mass");
            out.key("inertia", &listed(float.inertia), "kg m2");
            if float.volume > 0.0 {
                out.key("volume", &shown(float.volume), "m3, displaced");
                if float.drag_areas != [0.0; 3] {
                    out.key("drag_areas", &listed(float.drag_areas), "m2, coefficient times area along each axis");
                }
                if float.added != [0.0; 3] {
                    out.key("added_mass", &listed(float.added), "kg");
                }
            } else if float.drag_areas != [0.0; 3] {
                out.note(&format!("The drag of {} is not carried over: it displaces no water.", float.name));
            }
        }
    }
}
