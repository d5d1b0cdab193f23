//! Model files that somebody could have spoilt: good ones with a few changes, most of which leave them readable.

use crate::random::Random;
use std::ops::Range;

/// Numbers at the limits of what a number, a count or a machine can be.
const EXTREMES: [&str; 27] = [
    "0",
    "-1",
    "-0.0",
    "1",
    "2",
    "7",
    "0.5",
    "5e-324",
    "1e-320",
    "1e-300",
    "1e-150",
    "1e-30",
    "1e-9",
    "1e9",
    "1e30",
    "1e150",
    "1e300",
    "1.7e308",
    "-1e308",
    "nan",
    "inf",
    "-inf",
    "1e999",
    "100000",
    "2147483648",
    "9223372036854775808",
    "-40",
];

/// Numbers as text: expressions that have no value, or an odd one.
const EXPRESSIONS: [&str; 19] = [
    "\"1/0\"",
    "\"sqrt(-1)\"",
    "\"log(0)\"",
    "\"0*t\"",
    "\"t\"",
    "\"s\"",
    "\"t^-1\"",
    "\"exp(1e5*t)\"",
    "\"sqrt(t)\"",
    "\"abs(t - 0.002)\"",
    "\"sin(1e300*t)\"",
    "\"1e308*t\"",
    "\"(-8)^(1/3)\"",
    "\"atan2(0, 0)\"",
    "\"tan(pi/2)\"",
    "\"min(t, 0.001)\"",
    "\"\"",
    "[{ until = 0.002, is = \"t\" }, { is = 0.002 }]",
    "[{ until = 0.002, is = 0 }, { until = 0.001, is = 1 }, { is = \"t\" }]",
];

/// What text may hold besides ASCII: controls, marks, other digits and minus signs, what turns the direction of
/// writing.
const CHARACTERS: [&str; 16] = [
    "\0",
    "\u{1b}[31m",
    "\u{feff}",
    "\u{202e}",
    "\u{e9}",
    "\u{1d51b}",
    "\u{1f469}\u{200d}\u{1f467}",
    "\u{ffff}",
    "\u{10ffff}",
    "\r",
    "\t",
    "\u{2028}",
    "\u{201c}",
    "\u{2212}",
    "\u{301}",
    "\u{2460}",
];

/// Lines that change what a section is, with the kind of section that they belong to.
const LINES: [(&str, &str); 27] = [
    ("beam", "element = \"ancf24\""),
    ("beam", "twist = \"quadratic\""),
    ("beam", "strain = \"small\""),
    ("beam", "strain = \"large_truncated\""),
    ("beam", "pretwist = 3"),
    ("beam", "y_axis = [1, 1, 1]"),
    ("beam", "velocity = [0, 1, 0]"),
    ("beam", "angular_velocity = [0, 0, 5]"),
    ("beam", "curve = { x = \"s\", y = \"s^2\", z = 0, s = [0, 1] }"),
    ("beam", "curve = { points = [[0, 0, 0], [1, 0, 0.5], [1, 1, 0]] }"),
    ("beam", "spacing = \"s\""),
    ("simulation", "analysis = \"static\""),
    ("simulation", "initial = \"equilibrium\""),
    ("simulation", "spectral_radius = 1"),
    ("simulation", "integrator = \"generalized_alpha\""),
    ("simulation", "tolerance = 1e-4"),
    ("simulation", "tolerance = 1e-14"),
    ("load", "follower = true"),
    ("load", "input = true"),
    ("frame", "input = \"rotation\""),
    ("joint", "stiffness = 10"),
    ("joint", "damping = 0.1"),
    ("joint", "rotational_stiffness = 3"),
    ("joint", "at = [0, 0, 0]"),
    ("material", "damping = 1e-3"),
    ("body", "angular_velocity = [0, 0, 50]"),
    ("section", "fourth_moments = [1e-12, 1e-12, 1e-12]"),
];

/// One of `files` with some changes, some of them from the others.
pub fn mutated(random: &mut Random, files: &[&str]) -> String {
    let mut text = one(random, files).to_owned();
    for _ in 0..1 + random.below(3) {
        text = changed(random, &text, files);
    }
    text
}

fn changed(random: &mut Random, text: &str, files: &[&str]) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let line = random.below(lines.len() + 1).min(lines.len().saturating_sub(1));
    match random.below(100) {
        0..40 => return with_number(random, text, scaled),
        40..50 => return with_number(random, text, |random, _| one(random, &EXTREMES).to_owned()),
        50..55 => return with_number(random, text, |random, _| one(random, &EXPRESSIONS).to_owned()),
        55..62 => return with_quoted(random, text, files),
        62..65 => return with_words_swapped(random, text),
        65..67 => return with_character(random, text),
        67..68 => return with_nesting(random, text),
        68..69 => return text[..boundary(random, text)].to_owned(),
        _ if lines.is_empty() => return text.to_owned(),
        69..73 => drop(lines.remove(line)),
        73..75 => lines.insert(line, lines[random.below(lines.len())].clone()),
        75..78 => {
            let other = random.below(lines.len());
            lines.swap(line, other);
        }
        78..90 => return with_line(random, text),
        90..94 => {
            let others: Vec<&str> = one(random, files).lines().collect();
            lines.insert(line, one(random, &others).to_owned());
        }
        _ => return with_section(random, text, files),
    }
    lines.join("\n") + "\n"
}

fn one<T: Clone>(random: &mut Random, list: &[T]) -> T {
    list[random.below(list.len())].clone()
}

/// A place between two characters.
fn boundary(random: &mut Random, text: &str) -> usize {
    let at = random.below(text.len() + 1);
    (0..=at).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0)
}

/// Words and numbers.
fn words(text: &str) -> Vec<Range<usize>> {
    let is_part = |c: char| c.is_alphanumeric() || "_.+-".contains(c);
    let mut words: Vec<Range<usize>> = Vec::new();
    for (at, c) in text.char_indices().filter(|(_, c)| is_part(*c)) {
        let end = at + c.len_utf8();
        match words.last_mut() {
            Some(word) if word.end == at => word.end = end,
            _ => words.push(at..end),
        }
    }
    words
}

fn replaced(text: &str, place: Range<usize>, by: &str) -> String {
    [&text[..place.start], by, &text[place.end..]].concat()
}

/// Another number for one of the numbers.
fn with_number(random: &mut Random, text: &str, other: impl Fn(&mut Random, f64) -> String) -> String {
    let numbers: Vec<_> =
        words(text).into_iter().filter_map(|word| Some((text[word.clone()].parse::<f64>().ok()?, word))).collect();
    if numbers.is_empty() {
        return text.to_owned();
    }
    let (number, place) = one(random, &numbers);
    replaced(text, place, &other(random, number))
}

/// A number not far from another: what a user may try. Counts mostly stay counts.
fn scaled(random: &mut Random, number: f64) -> String {
    let is_count = (2.0..100.0).contains(&number) && number.fract() == 0.0;
    match random.below(5) {
        _ if is_count && random.below(4) > 0 => format!("{}", 1 + random.below(2 * number as usize)),
        0 => format!("{}", -number),
        1 => format!("{}", number + f64::from(random.below(3) as i32 - 1)),
        2 => format!("{:e}", number * 10_f64.powi(random.below(13) as i32 - 6)),
        3 => format!("{:e}", number * (1.0 + 1e-9 * random.signed())),
        _ => format!("{}", 2.0 * number * random.signed()),
    }
}

/// What stands in quotes, with the quotes.
fn quoted(text: &str) -> Vec<Range<usize>> {
    let quotes: Vec<usize> = text.match_indices('"').map(|(at, _)| at).collect();
    quotes.chunks_exact(2).map(|pair| pair[0]..pair[1] + 1).collect()
}

/// A text in quotes for another: of this file or of one of the others.
fn with_quoted(random: &mut Random, text: &str, files: &[&str]) -> String {
    let from = if random.below(2) == 0 { text } else { one(random, files) };
    let (own, others) = (quoted(text), quoted(from));
    if own.is_empty() || others.is_empty() {
        return text.to_owned();
    }
    let (place, by) = (one(random, &own), one(random, &others));
    replaced(text, place, &from[by])
}

fn with_words_swapped(random: &mut Random, text: &str) -> String {
    let words = words(text);
    if words.is_empty() {
        return text.to_owned();
    }
    let (a, b) = (one(random, &words), one(random, &words));
    let (first, last) = if a.start <= b.start { (a, b) } else { (b, a) };
    if first.start == last.start {
        return text.to_owned();
    }
    replaced(&replaced(text, last.clone(), &text[first.clone()]), first, &text[last])
}

fn with_character(random: &mut Random, text: &str) -> String {
    let at = boundary(random, text);
    replaced(text, at..at, one(random, &CHARACTERS))
}

/// Something that opens, many times: what is read by recursion needs a limit.
fn with_nesting(random: &mut Random, text: &str) -> String {
    let opening = one(random, &["(", "-", "[", "{ a = ", "sin(", "1^", "a.", "\"", "1+", "-(", "[["]);
    let nest = opening.repeat(10_usize.pow(1 + random.below(5) as u32));
    match random.below(2) {
        0 => with_number(random, text, |_, _| format!("\"{nest}\"")),
        _ => with_number(random, text, |_, _| nest.clone()),
    }
}

/// Where sections begin and end.
fn sections(text: &str) -> Vec<Range<usize>> {
    let mut starts: Vec<usize> = text.match_indices("\n[").map(|(at, _)| at + 1).collect();
    starts.push(text.len());
    starts.windows(2).map(|pair| pair[0]..pair[1]).collect()
}

/// A line more in a section that it belongs to; in place of the one with the same key, if there is one.
fn with_line(random: &mut Random, text: &str) -> String {
    let (kind, line) = one(random, &LINES);
    let is_kind = |place: &Range<usize>| text[place.clone()].starts_with(&format!("[{kind}"));
    let fitting: Vec<_> = sections(text).into_iter().filter(is_kind).collect();
    if fitting.is_empty() {
        return text.to_owned();
    }
    let place = one(random, &fitting);
    let key = line.split_inclusive('=').next().unwrap_or(line);
    // A curve says where a beam is, as its ends do.
    let is_replaced =
        |own: &str| own.starts_with(key) || key == "curve =" && (own.starts_with("from =") || own.starts_with("to ="));
    let mut lines: Vec<&str> = text[place.clone()].lines().filter(|own| !is_replaced(own)).collect();
    lines.insert(lines.len().min(1), line);
    replaced(text, place, &(lines.join("\n") + "\n"))
}

/// One section less, one more, or another in its place.
fn with_section(random: &mut Random, text: &str, files: &[&str]) -> String {
    let other = one(random, files);
    let (own, others) = (sections(text), sections(other));
    if own.is_empty() || others.is_empty() {
        return text.to_owned();
    }
    let (place, by) = (one(random, &own), &other[one(random, &others)]);
    let kind = |section: &str| section.split(['.', ']']).next().map(str::to_owned);
    match random.below(4) {
        0 => replaced(text, place, ""),
        1 => replaced(text, place.start..place.start, by),
        2 => replaced(text, place, by),
        _ => {
            let alike: Vec<_> = own.into_iter().filter(|own| kind(&text[own.clone()]) == kind(by)).collect();
            if alike.is_empty() { text.to_owned() } else { replaced(text, one(random, &alike), by) }
        }
    }
}

/// The shortest text found that fails as `text` does, lines taken out.
pub fn shrunk(text: &str, fails: impl Fn(&str) -> bool) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    let mut size = lines.len().div_ceil(2);
    while size > 0 {
        let mut at = 0;
        while at < lines.len() {
            let end = (at + size).min(lines.len());
            let fewer: Vec<&str> = lines[..at].iter().chain(&lines[end..]).copied().collect();
            if fails(&fewer.join("\n")) {
                lines = fewer;
            } else {
                at = end;
            }
        }
        size /= 2;
    }
    lines.join("\n")
}
