//! `--set steel.young=2.1e11`: an override replaces or adds a value in the tree, before anything is read. So it is read, checked
//! and reported as if it stood in the file, except that messages quote the override.

use super::diagnostic::{OVERRIDE, Place, Report};
use super::names::{SECTIONS, is_legal, suggestion};
use super::tree::{Entry, Item, Node, parse_override};

/// Components of a list that the file does not write: a vector. The one list that may be longer, an inertia, is always written.
const VECTOR: usize = 3;
/// Components that a list of numbers may have.
const COUNTS: [usize; 2] = [VECTOR, 6];
/// The key whose value is a table: its rows are no numbers.
const TABLE: &str = "axes";
/// The key whose value is a section of its own, of which nothing is a parameter.
const SECTION: &str = "curve";

/// The keys of the section [simulation] that are often set, and as often without its name.
const SIMULATION: [&str; 9] =
    ["analysis", "initial", "stop", "step", "accuracy", "output_step", "integrator", "tolerance", "verify"];

/// Puts the overrides into the tree, in their order.
pub fn apply(tree: &mut [Entry], overrides: &[(String, String)], report: &mut Report<'_>) {
    for (k, (key, value)) in overrides.iter().enumerate() {
        let source = k + 1;
        let start = OVERRIDE.len();
        let place = Place { source, start, end: start + key.len() };
        let item = parse_override(value, source, place.end + 1, report);
        let (path, index) = match split_index(key) {
            Ok(split) => split,
            Err(message) => {
                report.error(place, &message, "an index from 1 to the length of the list was expected", "");
                continue;
            }
        };
        let earlier = overrides[..k].iter().filter_map(|(key, _)| split_index(key).ok());
        let overlaps = |other: Option<usize>| other.is_none() || index.is_none() || other == index;
        if earlier.into_iter().any(|(other, component)| other == path && overlaps(component)) {
            report.error(place, &format!("`{key}` is set twice"), "the second one", "");
            continue;
        }
        if let Some(target) = find(tree, path, place, report) {
            store(target, index, item, place, report);
        }
    }
}

/// `gravity[3]` to `gravity` and 3.
fn split_index(key: &str) -> Result<(&str, Option<usize>), String> {
    let Some((path, rest)) = key.split_once('[') else { return Ok((key, None)) };
    // The one way to write an index: `[+3]` and `[03]` are mistakes.
    let digits = rest.strip_suffix(']').filter(|digits| !digits.starts_with(['0', '+']));
    match digits.and_then(|digits| digits.parse::<usize>().ok()) {
        Some(index) if (1..=COUNTS[1]).contains(&index) => Ok((path, Some(index))),
        _ => Err(format!("`{key}` has no such component")),
    }
}

/// The table and the key that a path means; the key may not exist yet.
fn find<'t, 'k>(
    tree: &'t mut [Entry],
    path: &'k str,
    place: Place,
    report: &mut Report<'_>,
) -> Option<(&'t mut Vec<Entry>, &'k str)> {
    if path == "gravity" {
        return Some((section(tree, "model")?, "gravity"));
    }
    let names = names(tree);
    let message = match path.split_once('.') {
        Some(("simulation", key)) => return Some((section(tree, "simulation")?, key)),
        Some((name, key)) => {
            let kind = SECTIONS.iter().map(|(word, _)| *word).find(|word| names.contains(&(*word, name.to_owned())));
            match kind {
                Some(kind) => return Some((table(section(tree, kind)?, name)?, key)),
                None => format!("nothing in the file is named `{name}`"),
            }
        }
        None if names.contains(&("parameters", path.to_owned())) => return Some((section(tree, "parameters")?, path)),
        None => format!("there is no parameter `{path}`"),
    };
    let head = path.split_once('.').map_or(path, |(name, _)| name);
    let wanted = |kind: &str| path.contains('.') != (kind == "parameters");
    let known = names.iter().filter(|(kind, _)| wanted(kind)).map(|(_, name)| name.as_str());
    let near = match SIMULATION.contains(&path) {
        true => format!("did you mean `simulation.{path}`?"),
        false => suggestion(head, known.chain(if path.contains('.') { ["simulation"] } else { ["gravity"] })),
    };
    report.error(place, &message, &near, "set NAME.key, gravity, simulation.key or an entry of [parameters]");
    None
}

/// Every name of the tree with the section it stands in.
fn names(tree: &[Entry]) -> Vec<(&'static str, String)> {
    let mut names = Vec::new();
    for kind in SECTIONS.iter().map(|(word, _)| *word).chain(["parameters"]) {
        let Some(entry) = tree.iter().find(|entry| entry.key == kind) else { continue };
        if let Node::Table(entries) = &entry.item.node {
            names.extend(entries.iter().filter(|entry| is_legal(&entry.key)).map(|entry| (kind, entry.key.clone())));
        }
    }
    names
}

fn section<'t>(tree: &'t mut [Entry], word: &str) -> Option<&'t mut Vec<Entry>> {
    tree.iter_mut().find(|entry| entry.key == word).and_then(|entry| table_of(&mut entry.item))
}

fn table<'t>(entries: &'t mut [Entry], name: &str) -> Option<&'t mut Vec<Entry>> {
    entries.iter_mut().find(|entry| entry.key == name).and_then(|entry| table_of(&mut entry.item))
}

fn table_of(item: &mut Item) -> Option<&mut Vec<Entry>> {
    match &mut item.node {
        Node::Table(entries) => Some(entries),
        _ => None,
    }
}

/// Writes the value; a parameter given as a table keeps its unit and bounds.
fn store(
    (entries, key): (&mut Vec<Entry>, &str),
    index: Option<usize>,
    item: Item,
    place: Place,
    report: &mut Report<'_>,
) {
    if key == SECTION || key.strip_prefix(SECTION).is_some_and(|rest| rest.starts_with('.')) {
        let help = "set the parameters that are used in it";
        report.error(place, &format!("`{SECTION}` and what is in it cannot be set"), "", help);
        return;
    }
    if index.is_some() && key == TABLE {
        let help = "set it as a whole: a list of 3 rows of 3 numbers";
        report.error(place, &format!("`{key}` is a table: its components cannot be set one by one"), "", help);
        return;
    }
    let at = match entries.iter().position(|entry| entry.key == key) {
        Some(at) => at,
        None if index.is_some_and(|index| index > VECTOR) => return no_component(VECTOR, place, report),
        None => {
            entries.push(Entry { key: key.to_owned(), key_place: place, item: Item { place, node: Node::Missing } });
            entries.len() - 1
        }
    };
    let old = &mut entries[at].item;
    match (index, &mut old.node) {
        (None, Node::Table(inner)) => match inner.iter_mut().find(|entry| entry.key == "value") {
            Some(value) => value.item = item,
            None => inner.push(Entry { key: "value".to_owned(), key_place: place, item }),
        },
        (None, _) => *old = item,
        (Some(index), Node::Array(items)) if COUNTS.contains(&items.len()) => match items.get_mut(index - 1) {
            Some(component) => *component = item,
            None => no_component(items.len(), place, report),
        },
        (Some(index), Node::Missing) => {
            let missing = Item { place, node: Node::Missing };
            let mut items = vec![missing; VECTOR];
            items[index - 1] = item;
            old.node = Node::Array(items);
        }
        (Some(_), _) => report.error(place, &format!("`{key}` is not a list"), "it has no components", ""),
    }
}

fn no_component(count: usize, place: Place, report: &mut Report<'_>) {
    let message = format!("`{}` has no such component", report.source.slice(place));
    report.error(place, &message, &format!("an index from 1 to {count} was expected"), "");
}
