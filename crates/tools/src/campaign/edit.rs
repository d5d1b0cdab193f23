//! Changes of a model file as text, so that what runs can be written down and run again by `ancf14 run`: keys of a
//! section that stand on a line of their own, numbers of elements, and the nodes that joints name.

/// The name in a section's header: `[beam.arm]` is `beam.arm`.
fn header(line: &str) -> Option<&str> {
    let line = line.trim();
    let end = line.strip_prefix('[').and_then(|rest| rest.find(']'))?;
    (!line.contains('=')).then(|| &line[1..=end])
}

/// The key and the value of a line, without its remark.
fn entry(line: &str) -> Option<(&str, &str)> {
    let (key, value) = line.split_once('=')?;
    Some((key.trim(), value.split('#').next().unwrap_or(value).trim()))
}

/// Every line with the section that it stands in.
fn lines(text: &str) -> impl Iterator<Item = (&str, &str)> {
    let mut section = "";
    text.lines().map(move |line| {
        section = header(line).unwrap_or(section);
        (section, line)
    })
}

/// The value of `key` in `section`, as it is written.
pub fn value<'a>(text: &'a str, section: &str, key: &str) -> Option<&'a str> {
    let own = lines(text).filter(|(own, _)| *own == section);
    own.filter_map(|(_, line)| entry(line)).find(|(own, _)| *own == key).map(|(_, value)| value)
}

/// The value of `key` in `section`, where it is a number.
pub fn number(text: &str, section: &str, key: &str) -> Option<f64> {
    value(text, section, key)?.parse().ok()
}

/// The text without `key` in `section`.
pub fn without(text: &str, section: &str, key: &str) -> String {
    let is_other = |(own, line): &(&str, &str)| *own != section || entry(line).is_none_or(|(own, _)| own != key);
    lines(text).filter(is_other).map(|(_, line)| format!("{line}\n")).collect()
}

/// The text with `key = value` in `section`, at its beginning.
pub fn with(text: &str, section: &str, key: &str, value: &str) -> String {
    let mut changed = String::new();
    for line in without(text, section, key).lines() {
        changed += &format!("{line}\n");
        if header(line) == Some(section) {
            changed += &format!("{key} = {value}\n");
        }
    }
    changed
}

/// The name, and the number of elements, of every beam.
pub fn meshes(text: &str) -> Vec<(&str, u32)> {
    let beams = lines(text).filter_map(|(section, line)| Some((section.strip_prefix("beam.")?, entry(line)?)));
    let elements = beams.filter(|(_, (key, _))| *key == "elements");
    elements.filter_map(|(beam, (_, value))| Some((beam, value.parse().ok()?))).collect()
}

/// The text with `resize(elements)` elements in each beam of `elements`; none where a joint names a node that is not
/// there any more.
pub fn remeshed(text: &str, resize: impl Fn(u32) -> u32) -> Option<String> {
    let meshes = meshes(text);
    let mut changed = String::new();
    for (section, line) in lines(text) {
        let own = meshes.iter().find(|(beam, _)| section.strip_prefix("beam.") == Some(beam));
        changed += &match (own, entry(line)) {
            (Some((_, elements)), Some(("elements", _))) => format!("elements = {}", resize(*elements)),
            _ => renumbered(line, &meshes, &resize)?,
        };
        changed.push('\n');
    }
    Some(changed)
}

/// A line whose `BEAM.node[k]` is the same place in the other mesh.
fn renumbered(line: &str, meshes: &[(&str, u32)], resize: impl Fn(u32) -> u32) -> Option<String> {
    const NODE: &str = ".node[";
    let Some(place) = line.find(NODE) else { return Some(line.to_owned()) };
    let (before, rest) = (&line[..place], &line[place + NODE.len()..]);
    let (number, after) = rest.split_once(']')?;
    let number: u32 = number.parse().ok()?;
    let beam = before.rsplit(['"', ' ']).next()?;
    let (_, elements) = meshes.iter().find(|(own, _)| *own == beam)?;
    let moved = number * resize(*elements);
    moved.is_multiple_of(*elements).then(|| format!("{before}{NODE}{}]{after}", moved / elements))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str =
        "[beam.arm]\nelements = 8  # enough\n[joint.grip]\nb = \"arm.node[2]\"\n[simulation]\nstep=1e-3\nstop = 1\n";

    /// A key is found in its own section only, with or without blanks and remarks.
    #[test]
    fn keys_are_read_set_and_removed() {
        assert_eq!(number(TEXT, "simulation", "step"), Some(1e-3));
        assert_eq!(number(TEXT, "beam.arm", "step"), None);
        assert_eq!(number(&with(TEXT, "simulation", "step", "2e-3"), "simulation", "step"), Some(2e-3));
        assert_eq!(number(&without(TEXT, "simulation", "step"), "simulation", "step"), None);
        assert_eq!(without(TEXT, "simulation", "elements").lines().count(), TEXT.lines().count());
    }

    /// A node keeps its place in another mesh, or the mesh is refused.
    #[test]
    fn nodes_follow_the_mesh() {
        let half = remeshed(TEXT, |elements| elements / 2).unwrap();
        assert_eq!(meshes(&half), [("arm", 4)]);
        assert!(half.contains("arm.node[1]") && half.contains("stop = 1\n"));
        assert_eq!(remeshed(TEXT, |elements| elements / 8), None);
    }
}
