//! Does docs/language/reference.md have every key that the program reads, with its words, ranges and units? The part
//! between two marks is made of the tables of keys of the sections. `ANCF14_BLESS=1 cargo test reference_of_keys`
//! writes it anew.

use ancf14::model::entries::{SECTIONS, SINGLE};
use ancf14::model::expression::Variable;
use ancf14::model::file::schema::{Key, Role, Rule};
use std::fmt::Write;
use std::fs;
use std::path::Path;

const BEGIN: &str = "<!-- keys: written by a test, see tests/suite/language/reference.rs -->\n";
const END: &str = "<!-- end of keys -->\n";

/// All that several rules say, once each.
fn all_of(rules: &[&Rule], of: impl Fn(&Rule) -> String) -> String {
    let mut list: Vec<String> = Vec::new();
    for text in rules.iter().map(|rule| of(rule)).filter(|text| !text.is_empty()) {
        if !list.contains(&text) {
            list.push(text);
        }
    }
    list.join("; ")
}

fn value(key: &Key) -> String {
    if !key.words.is_empty() {
        let quote = if key.words == ["true", "false"] { "" } else { "\"" };
        let quoted = |word: &&str| format!("`{quote}{word}{quote}`");
        return key.words.iter().map(quoted).collect::<Vec<_>>().join(" ");
    }
    let count = match (key.role, key.count) {
        (Role::Name("place"), _) => return String::from("name of a place"),
        (Role::Name(section), _) => return format!("name of a {section}"),
        (Role::Part, _) => return String::from("name of a part or a place"),
        (Role::Curve, _) => return String::from("table"),
        (Role::Word, _) => return String::from("text"),
        (_, "") if key.rules.is_empty() => return String::from("list"),
        (_, "") if key.rules.iter().any(|rule| rule.integer) => String::from("whole number"),
        (_, "") => String::from("number"),
        (_, count) => format!("{count} numbers"),
    };
    let range = all_of(key.rules, |rule| rule.range.words());
    if range.is_empty() { count } else { format!("{count}, {range}") }
}

fn variables(rule: &Rule) -> String {
    let words = match rule.variable {
        Variable::None => "",
        Variable::Time => "t",
        Variable::Curve => "s",
        Variable::AlongInTime => "t, s",
        Variable::Control => "t, coordinates of joints",
        Variable::Elongation => "x, v",
        Variable::Followed => "x",
        Variable::Height => "z, t",
    };
    String::from(words)
}

fn row(key: &Key) -> String {
    let unit = all_of(key.rules, |rule| String::from(rule.unit));
    let own = all_of(key.rules, |rule| String::from(rule.meaning));
    let meaning = if own.is_empty() { String::from(key.meaning) } else { own };
    let tunable = if key.rules.iter().any(|rule| rule.tunable) { "yes" } else { "" };
    format!("| `{}` | {} | {unit} | {} | {tunable} | {meaning} |\n", key.word, value(key), all_of(key.rules, variables))
}

fn reference() -> String {
    let mut text = String::new();
    for (section, keys) in SECTIONS {
        let name = if SINGLE.contains(section) { "" } else { ".NAME" };
        let head = "| key | value | unit | may depend on | tunable | meaning |\n|---|---|---|---|---|---|";
        writeln!(text, "\n## `[{section}{name}]`\n\n{head}").unwrap();
        text.extend(keys.iter().map(row));
    }
    text
}

/// A key without a line in the reference would be known to readers of the code only.
#[test]
fn reference_of_keys_is_current() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/language/reference.md");
    let page = fs::read_to_string(&path).unwrap();
    let (before, rest) = page.split_once(BEGIN).expect("the mark where the keys begin");
    let (_, behind) = rest.split_once(END).expect("the mark where they end");
    let wanted = format!("{before}{BEGIN}{}\n{END}{behind}", reference());
    if std::env::var_os("ANCF14_BLESS").is_some() {
        fs::write(&path, &wanted).unwrap();
    } else {
        assert!(
            page == wanted,
            "docs/language/reference.md is not what the tables of keys say: write it anew with ANCF14_BLESS=1"
        );
    }
}

/// One word has one row in a section, and numbers have a meaning and nothing else has.
#[test]
fn tables_of_keys_are_sound() {
    for (section, keys) in SECTIONS {
        for (number, key) in keys.iter().enumerate() {
            assert!(keys[..number].iter().all(|other| other.word != key.word), "{section}.{} twice", key.word);
            assert!(key.rules.iter().all(|rule| rule.key == key.word), "{section}.{}: a rule of another key", key.word);
            assert_ne!(key.rules.is_empty(), key.meaning.is_empty(), "{section}.{}: its meaning", key.word);
        }
    }
}
