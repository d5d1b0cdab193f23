//! `--set steel.young=2.1e11`: an override replaces or adds a value in the tree, before anything is read. So it is
//! read, checked and reported as if it stood in the file, except that messages quote the override.

use super::entries::{SINGLE, keys_of};
use crate::model::text::diagnostic::{Place, Report};
use crate::model::text::names::{SECTIONS, is_legal, suggestion};
use crate::model::text::tree::{Entry, Item, Node, parse_override};

/// Components of a list that the file does not write: a vector. The one list that may be longer, an inertia, is always
/// written.
const VECTOR: usize = 3;
/// Components that a list of numbers may have.
const COUNTS: [usize; 2] = [VECTOR, 6];
/// The key whose value is a table: its rows are no numbers.
const TABLE: &str = "axes";
/// The key whose value is a section of its own, of which nothing is a parameter.
const SECTION: &str = "curve";

/// What an override sets.
#[derive(Clone, Debug, PartialEq)]
struct Target {
    section: &'static str,
    /// The name of the thing; none in a section without names.
    name: Option<String>,
    key: String,
}

/// Puts the overrides into the tree, in their order.
pub fn apply(tree: &mut [Entry], overrides: &[(String, String)], report: &mut Report<'_>) {
    let mut earlier: Vec<(Target, Option<usize>)> = Vec::new();
    for (k, (key, value)) in overrides.iter().enumerate() {
        if report.source.has_applied(k) {
            continue;
        }
        let source = k + 1;
        let place = Place { source, start: 0, end: key.len() };
        let item = parse_override(value, source, place.end + 1, report);
        let (path, index) = match split_index(key) {
            Ok(split) => split,
            Err(message) => {
                report.error(place, &message, "an index from 1 to the length of the list was expected", "");
                continue;
            }
        };
        let Some(target) = find(tree, path, place, report) else { continue };
        let overlaps = |other: Option<usize>| other.is_none() || index.is_none() || other == index;
        if earlier.iter().any(|(other, component)| *other == target && overlaps(*component)) {
            report.error(place, &format!("`{key}` is set twice"), "the second one", "");
            continue;
        }
        if let Some(entries) = target.entries(tree) {
            store((entries, &target.key), index, item, place, report);
        }
        earlier.push((target, index));
    }
}

/// Puts those overrides into the tree that can decide what there is: entries of `[parameters]`, the `count` of things
/// in the section `copies`, and the `file` of things in the section `functions`. Says which ones these are.
pub fn apply_early(
    tree: &mut [Entry],
    [copies, functions]: [&str; 2],
    overrides: &[(String, String)],
    report: &mut Report<'_>,
) -> Vec<bool> {
    let mut applied = Vec::with_capacity(overrides.len());
    for (k, (key, value)) in overrides.iter().enumerate() {
        let place = Place { source: k + 1, start: 0, end: key.len() };
        let (name, last) = key.split_once('.').unwrap_or((key, ""));
        let (word, key_in) = match last {
            "" => ("parameters", name),
            "file" => (functions, last),
            _ => (copies, last),
        };
        let entries = section(tree, word).and_then(|entries| match last {
            "" => Some(entries),
            "count" | "file" => table(entries, name),
            _ => None,
        });
        let Some(entries) = entries.filter(|entries| entries.iter().any(|entry| entry.key == key_in)) else {
            applied.push(false);
            continue;
        };
        if overrides[..k].iter().any(|(other, _)| other == key) {
            report.error(place, &format!("`{key}` is set twice"), "the second one", "");
        }
        let item = parse_override(value, k + 1, place.end + 1, report);
        store((entries, key_in), None, item, place, report);
        applied.push(true);
    }
    applied
}

impl Target {
    /// The entries among which the key stands; it may not exist yet.
    fn entries<'t>(&self, tree: &'t mut [Entry]) -> Option<&'t mut Vec<Entry>> {
        let entries = section(tree, self.section)?;
        match &self.name {
            Some(name) => table(entries, name),
            None => Some(entries),
        }
    }

    /// Whether the file has the key.
    fn is_written(&self, tree: &mut [Entry]) -> bool {
        self.entries(tree).is_some_and(|entries| entries.iter().any(|entry| entry.key == self.head()))
    }

    /// The key, of `curve.s` the first part.
    fn head(&self) -> &str {
        self.key.split('.').next().unwrap_or(&self.key)
    }

    fn is_possible(&self, tree: &mut [Entry]) -> bool {
        let has_it = |section: &str| keys_of(section).iter().any(|key| key.word == self.head());
        let of_rigidities = self.section == "section" && has_it("material");
        has_it(self.section) && (!of_rigidities || self.has_rigidities(tree))
    }

    /// Whether it is a section that has a material of its own.
    fn has_rigidities(&self, tree: &mut [Entry]) -> bool {
        let has_shape = |entry: &Entry| {
            entry.key == "shape" && matches!(&entry.item.node, Node::Text(word) if word == "rigidities")
        };
        self.entries(tree).is_some_and(|entries| entries.iter().any(has_shape))
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

/// What a path means: `gravity`, `simulation.step`, an entry of `[parameters]`, `arm.elements`, or `beam.arm.elements`.
fn find(tree: &mut [Entry], path: &str, place: Place, report: &mut Report<'_>) -> Option<Target> {
    let single = |section, key: &str| Some(Target { section, name: None, key: key.to_owned() });
    if path == "gravity" {
        return single("model", path);
    }
    let names = names(tree);
    let message = match path.split_once('.') {
        Some((name, key)) => {
            let has = |section: &str| section == "simulation" || tree.iter().any(|entry| entry.key == section);
            if let Some(section) = SINGLE.into_iter().find(|own| *own == name && has(own)) {
                return single(section, key);
            }
            let candidates = candidates(&names, name, key);
            if !candidates.is_empty() {
                return choose(tree, path, candidates, place, report);
            }
            format!("nothing in the file is named `{name}`")
        }
        None if names.contains(&("parameters", path.to_owned())) => return single("parameters", path),
        None => format!("there is no parameter `{path}`"),
    };
    let head = path.split_once('.').map_or(path, |(name, _)| name);
    let wanted = |kind: &str| path.contains('.') != (kind == "parameters");
    let known = names.iter().filter(|(kind, _)| wanted(kind)).map(|(_, name)| name.as_str());
    // The keys of [simulation] are often set without its name.
    let near = match keys_of("simulation").iter().any(|key| key.word == path) {
        true => format!("did you mean `simulation.{path}`?"),
        false => suggestion(head, known.chain(if path.contains('.') { ["simulation"] } else { ["gravity"] })),
    };
    report.error(place, &message, &near, "set NAME.key, gravity, simulation.key or an entry of [parameters]");
    None
}

/// What `NAME.key` can mean: a key of each thing with this name, or with a section in place of the name,
/// `SECTION.NAME.key`.
fn candidates(names: &[(&'static str, String)], name: &str, key: &str) -> Vec<Target> {
    let targets = |section: Option<&str>, name: &str, key: &str| -> Vec<Target> {
        let same = |(kind, known): &&(&'static str, String)| {
            *kind != "parameters" && known == name && section.is_none_or(|section| *kind == section)
        };
        let target = |kind| Target { section: kind, name: Some(name.to_owned()), key: key.to_owned() };
        names.iter().filter(same).map(|(kind, _)| target(*kind)).collect()
    };
    match key.split_once('.').map(|(inner, rest)| targets(Some(name), inner, rest)) {
        Some(list) if !list.is_empty() => list,
        _ => targets(None, name, key),
    }
}

/// The one of several things with the same name that has the key, or else that can have it.
fn choose(
    tree: &mut [Entry],
    path: &str,
    candidates: Vec<Target>,
    place: Place,
    report: &mut Report<'_>,
) -> Option<Target> {
    let title = |target: &Target| format!("[{}.{}]", target.section, target.name.as_deref().unwrap_or_default());
    let titles = |targets: &[Target]| targets.iter().map(title).collect::<Vec<_>>().join(" and ");
    if let [only] = candidates.as_slice() {
        return Some(only.clone());
    }
    let mut fitting: Vec<Target> = candidates.iter().filter(|target| target.is_written(tree)).cloned().collect();
    if fitting.is_empty() {
        fitting = candidates.iter().filter(|target| target.is_possible(tree)).cloned().collect();
    }
    match fitting.as_slice() {
        [one] => return Some(one.clone()),
        [] => {
            let key = candidates.first().map_or("", Target::head);
            let known = candidates.iter().flat_map(|target| keys_of(target.section));
            let known: Vec<&str> = known.map(|key| key.word).collect();
            let message = format!("unknown key `{key}` in {}", titles(&candidates));
            let help = format!("known here: {}", known.join(", "));
            report.error(place, &message, &suggestion(key, known.iter().copied()), &help);
        }
        [first, ..] => {
            let message = format!("`{path}` can be a key of {}", titles(&fitting));
            let help = format!("write the section too: {}.{path}", first.section);
            report.error(place, &message, "which one is not clear", &help);
        }
    }
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
