//! Line types as sections, lines and rods as beams.

use super::deck::{Deck, Row};
use super::ends::{Attachment, End, Ends, Held, POINT, attachment};
use super::text::{Text, listed, name, shown};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

/// Elements of a line, and of a rod.
const ELEMENTS: usize = 20;
const ELEMENTS_OF_ROD: usize = 4;
/// Young's modulus of rods, which MoorDyn takes for rigid, Pa: steel.
const STEEL: f64 = 2.1e11;
/// A line whose ends are this share of its length apart, seen from above, hangs in a fold.
const UPRIGHT: f64 = 1e-3;

/// The type of a line by its name.
fn kind<'a>(deck: &'a Deck, row: &Row) -> Result<&'a Row, String> {
    let word = row.needed("linetype")?;
    let found = deck.rows("line types").iter().find(|own| own.word("name") == Some(word));
    found.ok_or_else(|| format!("line {}: there is no line type \"{word}\"", row.line))
}

/// The axial rigidity of a line type; of a list a|b that for slow motions.
fn rigidity(row: &Row, out: &mut Text) -> Result<f64, String> {
    let word = row.needed("ea")?;
    if let Some((first, _)) = word.split_once('|') {
        let note = format!("EA = {word} (line {}) is viscoelastic: the line takes {first} N.", row.line);
        out.note(&note);
        return first.parse().map_err(|_| format!("line {}: `EA` is \"{word}\"", row.line));
    }
    row.number("ea").map_err(|_| {
        format!("line {}: `EA` is \"{word}\": tables of the tension are not carried over; give a number", row.line)
    })
}

/// Writes a section for each line type and rod type that is used.
pub fn write_sections(deck: &Deck, out: &mut Text) -> Result<(), String> {
    let used: BTreeSet<&str> = deck.rows("lines").iter().filter_map(|row| row.word("linetype")).collect();
    for row in deck.rows("line types") {
        let word = row.needed("name")?;
        if !used.contains(word) {
            continue;
        }
        let bending = match row.word("ei") {
            None => 0.0,
            Some(_) => row.number("ei").map_err(|message| message + ": tables are not carried over")?,
        };
        if bending > 0.0 {
            out.note("MoorDyn has no torsion: GJ of lines with EI is set to EI.");
        }
        let axial = rigidity(row, out)?;
        let of_line = [axial, bending, row.number("mass")?, row.number("diam")?];
        write_section(row, word, of_line, out)?;
    }
    let used: BTreeSet<&str> = deck.rows("rods").iter().filter_map(|row| row.word("rodtype")).collect();
    for row in deck.rows("rod types") {
        let word = row.needed("name")?;
        if !used.contains(word) {
            continue;
        }
        out.note("Rods are elastic beams with the rigidity of solid steel, without the drag of their ends.");
        let diameter = row.number("diam")?;
        let area = PI / 4.0 * diameter * diameter;
        let of_rod = [STEEL * area, STEEL * area * diameter * diameter / 16.0, row.number("mass")?, diameter];
        write_section(row, word, of_rod, out)?;
    }
    Ok(())
}

fn write_section(
    row: &Row,
    word: &str,
    [axial, bending, mass, diameter]: [f64; 4],
    out: &mut Text,
) -> Result<(), String> {
    out.section(&format!("section.{}", name(word)));
    out.key("shape", "\"rigidities\"", "");
    out.key("EA", &shown(axial), "N");
    let comment = if bending == 0.0 { "a chain: neither bending nor torsion" } else { "N m2" };
    for key in ["EI_y", "EI_z", "GJ"] {
        out.key(key, &shown(bending), if key == "EI_y" { comment } else { "" });
    }
    out.key("line_density", &shown(mass), "kg/m, in air");
    out.key("outer_diameter", &shown(diameter), "m, of the displaced volume");
    let [drag, along] = [row.number_or_zero("cd")?, row.number_or_zero("cdax")?];
    out.key("drag", &format!("[{}, {}]", shown(drag), shown(along)), "across, along");
    out.key("drag_area", "\"circumference\"", "as MoorDyn has it");
    let [added, along] = [row.number_or_zero("ca")?, row.number_or_zero("caax")?];
    out.key("added_mass", &format!("[{}, {}]", shown(added), shown(along)), "across, along");
    Ok(())
}

/// Adds the frame of the vessel where rods are coupled.
pub fn find_vessel(deck: &Deck, ends: &mut Ends) -> Result<(), String> {
    for row in deck.rows("rods") {
        if let Attachment::Coupled = attachment(row, row.needed("attachment")?)? {
            ends.need_vessel();
        }
    }
    Ok(())
}

/// Writes rods as beams: `rod1`, from its end A to its end B.
pub fn write_rods(deck: &Deck, ends: &Ends, out: &mut Text) -> Result<(), String> {
    for row in deck.rows("rods") {
        let id = row.needed("id")?;
        let (from, to) = (row.vector(["xa", "ya", "za"])?, row.vector(["xb", "yb", "zb"])?);
        if from == to {
            return Err(format!("line {}: rod {id} has no length; give a point instead", row.line));
        }
        let word = row.needed("attachment")?;
        out.section(&format!("beam.rod{id}"));
        out.key("section", &format!("\"{}\"", name(row.needed("rodtype")?)), "");
        out.key("from", &listed(from), "m");
        out.key("to", &listed(to), "");
        out.key("elements", &ELEMENTS_OF_ROD.to_string(), "");
        let Some(held) = ends.holder(&attachment(row, word)?) else { continue };
        let kind = if word.to_lowercase().contains("pin") { "spherical" } else { "weld" };
        if matches!(attachment(row, word)?, Attachment::Body(_)) {
            out.note("Rods on bodies are drawn at global positions: check those of the rods.");
        }
        write_joint(&format!("rod{id}_a"), (kind, &held_by(&held)), &format!("rod{id}.start"), from, out);
    }
    Ok(())
}

/// The part that holds an end, by its name.
fn held_by(held: &Held) -> String {
    match held {
        Held::Ground => String::from("ground"),
        Held::Part(part) => part.clone(),
        Held::Lines(_) => String::new(),
    }
}

fn write_joint(joint: &str, (kind, holder): (&str, &str), end: &str, at: [f64; 3], out: &mut Text) {
    out.section(&format!("joint.{joint}"));
    out.key("type", &format!("\"{kind}\""), "");
    out.key("a", &format!("\"{holder}\""), "");
    out.key("b", &format!("\"{end}\""), "");
    // Frames and bodies reach to there.
    if holder != "ground" && !holder.contains('.') {
        out.key("at", &listed(at), "");
    }
}

/// An end of a line: a point, or `R1A` and `R1B`, the ends of rod 1.
fn end(deck: &Deck, ends: &Ends, row: &Row, column: &str) -> Result<End, String> {
    let word = row.needed(column)?;
    if let Some(point) = ends.point(word) {
        return Ok(point.clone());
    }
    let small = word.to_lowercase();
    let rod = small.strip_prefix(['r', 'n']).unwrap_or(&small);
    let (id, is_start) = match (rod.strip_suffix('a'), rod.strip_suffix('b')) {
        (Some(id), _) => (id, true),
        (_, Some(id)) => (id, false),
        _ => return Err(format!("line {}: there is no point {word}", row.line)),
    };
    let rod = deck.rows("rods").iter().find(|own| own.word("id") == Some(id));
    let rod = rod.ok_or_else(|| format!("line {}: there is no point and no rod {word}", row.line))?;
    let columns = if is_start { ["xa", "ya", "za"] } else { ["xb", "yb", "zb"] };
    let side = if is_start { "start" } else { "end" };
    Ok(End { at: rod.vector(columns)?, held: Held::Part(format!("rod{id}.{side}")) })
}

/// Writes lines as beams between joints without moments, with their tensions as outputs.
pub fn write_lines(deck: &Deck, ends: &Ends, out: &mut Text) -> Result<(), String> {
    let mut first_at: BTreeMap<String, String> = BTreeMap::new();
    for row in deck.rows("lines") {
        let id = row.needed("id")?;
        let line = format!("line{id}");
        let both = [end(deck, ends, row, "attacha")?, end(deck, ends, row, "attachb")?];
        write_line(deck, row, &line, &both, out)?;
        // One end keeps the line from spinning about itself.
        let is_steady = |end: &End| match &end.held {
            Held::Ground => true,
            Held::Part(part) => !part.starts_with(POINT),
            Held::Lines(_) => false,
        };
        let keeping = both.iter().position(is_steady);
        for (number, (end, [side, at])) in both.iter().zip([["a", "start"], ["b", "end"]]).enumerate() {
            let own = format!("{line}.{at}");
            let taken = match &end.held {
                Held::Lines(point) => Some(point),
                Held::Part(part) if part.starts_with(POINT) => Some(part),
                _ => None,
            };
            let first = taken.and_then(|point| first_at.get(point).cloned());
            if let (Some(point), None) = (taken, &first) {
                first_at.insert(point.clone(), own.clone());
            }
            let (kind, holder) = match (&end.held, first) {
                (Held::Lines(_), None) => continue,
                (Held::Lines(_), Some(first)) => ("spherical", first),
                // A point has no orientation: its body has that of the first line.
                (held @ Held::Part(part), None) if part.starts_with(POINT) => ("weld", held_by(held)),
                (held, _) => (if keeping == Some(number) { "universal" } else { "spherical" }, held_by(held)),
            };
            write_joint(&format!("{line}_{side}"), (kind, &holder), &own, end.at, out);
            if kind == "universal" {
                let [axis, axis2] = across([0, 1, 2].map(|i| both[1].at[i] - both[0].at[i]));
                out.key("axis", &listed(axis), "both across the line: it does not spin about itself");
                out.key("axis2", &listed(axis2), "");
            }
        }
    }
    for row in deck.rows("lines") {
        let id = row.needed("id")?;
        for (side, at) in [("a", "start"), ("b", "end")] {
            out.section(&format!("output.tension{id}_{side}"));
            out.key("at", &format!("\"line{id}.{at}\""), "");
            out.key("quantities", "[\"effective_tension\", \"declination\"]", "");
        }
    }
    Ok(())
}

/// Two axes across a chord, the first one level.
fn across([x, y, z]: [f64; 3]) -> [[f64; 3]; 2] {
    let (level, whole) = (x.hypot(y), (x * x + y * y + z * z).sqrt());
    if level < UPRIGHT * whole {
        return [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    }
    let axes = [[-y / level, x / level, 0.0], [-x * z / (level * whole), -y * z / (level * whole), level / whole]];
    // Nine digits are enough for a right angle.
    axes.map(|axis| axis.map(|own| (own * 1e9).round() / 1e9))
}

/// Writes a line, as it hangs; a taut one is straight, with the tension of its stretch.
fn write_line(deck: &Deck, row: &Row, line: &str, [from, to]: &[End; 2], out: &mut Text) -> Result<(), String> {
    let (kind, length) = (kind(deck, row)?, row.number("length")?);
    let span: [f64; 3] = std::array::from_fn(|i| to.at[i] - from.at[i]);
    let chord = span.iter().map(|own| own * own).sum::<f64>().sqrt();
    if chord == 0.0 || length <= 0.0 {
        return Err(format!("line {}: {line} has no length", row.line));
    }
    out.section(&format!("beam.{line}"));
    out.key("section", &format!("\"{}\"", name(row.needed("linetype")?)), "");
    out.key("from", &listed(from.at), "m");
    out.key("to", &listed(to.at), "");
    let axial = rigidity(kind, out)?;
    if length <= chord {
        let pull = axial * (chord / length - 1.0);
        out.key("pretension", &shown(pull), &format!("N: it is {} m long without stress", shown(length)));
    } else if span[0].hypot(span[1]) < UPRIGHT * length {
        out.note(&format!(
            "Line {} (line {}) is {} m long, and its ends are above each other, {} m apart: it would hang in a fold, and is drawn straight.",
            row.needed("id")?,
            row.line,
            shown(length),
            shown(chord)
        ));
    } else {
        out.key("lay", &format!("{{ length = {} }}", shown(length)), "m, without stress");
    }
    let segments = row.number_or_zero("numsegs")?;
    out.key("elements", &ELEMENTS.to_string(), &format!("for {segments} segments"));
    write_damping(kind, axial, length / segments.max(1.0), out)
}

/// Writes the axial damping of a line with segments of `segment` m.
fn write_damping(kind: &Row, axial: f64, segment: f64, out: &mut Text) -> Result<(), String> {
    let written = match kind.word("ba") {
        None | Some("-") => 0.0,
        Some(word) if word.contains('|') => {
            out.note(&format!("BA = {word} (line {}) is not carried over.", kind.line));
            0.0
        }
        Some(_) => kind.number("ba")?,
    };
    let (time, comment) = match written {
        share if share < 0.0 => (
            -share * segment * (kind.number("mass")? / axial).sqrt(),
            format!("s: the share {} of the critical damping of a segment", shown(-share)),
        ),
        viscosity => (viscosity / axial, String::from("s: BA/EA")),
    };
    if time > 0.0 {
        // Digits beyond the fourth say nothing.
        let digits = 3 - time.log10().floor() as i32;
        let rounded = (time * 10f64.powi(digits)).round() / 10f64.powi(digits);
        out.key("tension_damping", &shown(rounded), &comment);
    }
    Ok(())
}
