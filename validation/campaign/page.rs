//! docs/campaign.md: how many answers were right, refused, warned of and silently wrong, and which ones.

use super::machine::SETTINGS;
use super::verdict::{GROSS, Judged, Verdict};
use super::warning;
use std::fmt::Write;

/// What stands before the tables.
const HEAD: &str = include_str!("head.md");

/// A row of the first table: what it counts, and which verdicts.
type Count = (&'static str, fn(&Verdict) -> bool);

const COUNTS: [Count; 10] = [
    ("right", |verdict| matches!(verdict, Verdict::Right { is_warned: false })),
    ("right, but warned of", |verdict| matches!(verdict, Verdict::Right { is_warned: true })),
    ("wrong and warned of", |verdict| matches!(verdict, Verdict::Warned(_))),
    ("refused", |verdict| matches!(verdict, Verdict::Refused(_))),
    ("**silently wrong**", |verdict| matches!(verdict, Verdict::SilentlyWrong(_))),
    ("of these by more than 10 %", |verdict| matches!(verdict, Verdict::SilentlyWrong(error) if error.size > GROSS)),
    ("without an end", |verdict| matches!(verdict, Verdict::Endless)),
    ("panic", |verdict| matches!(verdict, Verdict::Panicked(_))),
    ("no reference", |verdict| matches!(verdict, Verdict::NoReference)),
    ("no such setting", |verdict| matches!(verdict, Verdict::NotApplicable)),
];

/// The page.
pub fn page(judged: &[Judged]) -> String {
    let sections =
        [HEAD.trim_end().to_owned(), warnings(judged), totals(judged), groups(judged), silent(judged), unknown(judged)];
    sections
        .iter()
        .map(|section| section.trim_end())
        .filter(|section| !section.is_empty())
        .collect::<Vec<_>>()
        .join("\n\n")
        + "\n"
}

/// The head of a table with a column for each setting.
fn header(first: &str) -> String {
    let titles: String = SETTINGS.iter().map(|setting| format!(" {} |", setting.title())).collect();
    format!("| {first} |{titles}\n|---|{}\n", "---|".repeat(SETTINGS.len()))
}

fn warnings(_judged: &[Judged]) -> String {
    let words: Vec<String> = warning::counted().map(|words| format!("\"{words}\"")).collect();
    format!("Warnings count where they hold these words: {}.", words.join(", "))
}

fn totals(judged: &[Judged]) -> String {
    let mut text = format!("## Verdicts\n\n{} machines.\n\n{}", judged.len(), header("verdict"));
    for (title, counts) in COUNTS {
        let _ = write!(text, "| {title} |");
        for place in 0..SETTINGS.len() {
            let _ = write!(text, " {} |", judged.iter().filter(|machine| counts(&machine.verdicts[place])).count());
        }
        text.push('\n');
    }
    text
}

/// The groups in the order of the machines.
fn group_names(judged: &[Judged]) -> Vec<&'static str> {
    let mut names: Vec<&'static str> = judged.iter().map(|machine| machine.group).collect();
    names.dedup();
    names
}

fn groups(judged: &[Judged]) -> String {
    let lead = "Silently wrong, of the machines that were judged (right, warned of or silently wrong):";
    let mut text = format!("## Silently wrong by group\n\n{lead}\n\n{}", header("group"));
    for group in group_names(judged) {
        let _ = write!(text, "| {group} |");
        for place in 0..SETTINGS.len() {
            let own = judged.iter().filter(|machine| machine.group == group).map(|machine| &machine.verdicts[place]);
            let known: Vec<_> = own
                .filter(|verdict| {
                    matches!(verdict, Verdict::Right { .. } | Verdict::Warned(_) | Verdict::SilentlyWrong(_))
                })
                .collect();
            let silent = known.iter().filter(|verdict| matches!(verdict, Verdict::SilentlyWrong(_))).count();
            let _ = write!(text, " {silent} of {} |", known.len());
        }
        text.push('\n');
    }
    text
}

/// The machines that are silently wrong in any setting.
fn silent(judged: &[Judged]) -> String {
    let lead = "The worst family of columns and its error, of the family's scale. \"known\" is the share of all results (families times rows) that the reference knows; `cargo run --release --example campaign -- --only NAME --write DIR` writes the model files of a machine.";
    let titles: String = SETTINGS.iter().map(|setting| format!(" {} |", setting.title())).collect();
    let mut text = format!(
        "## The silently wrong ones\n\n{lead}\n\n| machine | known |{titles}\n|---|---|{}\n",
        "---|".repeat(SETTINGS.len())
    );
    for machine in judged {
        if machine.verdicts.iter().any(|verdict| matches!(verdict, Verdict::SilentlyWrong(_))) {
            text += &line(machine);
        }
    }
    text
}

/// The line of a machine.
pub fn line(machine: &Judged) -> String {
    let cells: String = machine.verdicts.iter().map(|verdict| format!(" {} |", cell(verdict))).collect();
    let known = machine.known.map_or(String::from("-"), |known| format!("{:.0} %", 100.0 * known));
    format!("| {} | {known} |{cells}\n", machine.name)
}

fn cell(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Right { is_warned: false } => String::from("right"),
        Verdict::Right { is_warned: true } => String::from("right, warned"),
        Verdict::Warned(_) => String::from("warned"),
        Verdict::SilentlyWrong(error) => format!("**{}** {}", percent(error.size), error.family),
        Verdict::Refused(_) => String::from("refused"),
        Verdict::Endless => String::from("endless"),
        Verdict::Panicked(_) => String::from("panic"),
        Verdict::NoReference => String::from("no reference"),
        Verdict::NotApplicable => String::from("-"),
    }
}

/// An error with two digits.
fn percent(share: f64) -> String {
    match 100.0 * share {
        percent if percent < 10.0 => format!("{percent:.1} %"),
        percent if percent < 1000.0 => format!("{percent:.0} %"),
        percent => format!("{percent:.0e} %"),
    }
}

/// Warnings that the campaign does not know: somebody has to say whether they doubt numbers.
fn unknown(judged: &[Judged]) -> String {
    let mut text = String::new();
    for machine in judged {
        if let Some(warning) = &machine.unknown_warning {
            let _ = writeln!(text, "- {}: {warning}", machine.name);
        }
    }
    if text.is_empty() { text } else { format!("## Warnings that the campaign does not know\n\n{text}") }
}
