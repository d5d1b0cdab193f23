//! docs/campaign.md: how many answers were right, refused, warned of and silently wrong, and which ones.

use super::family::{ROUGH_SHARE, SMALL_FORCE};
use super::machine::{Machine, SETTINGS, Setting};
use super::reference::AGREEMENT;
use super::verdict::{Error, Fault, GROSS, Judged, RIGHT, RIGHT_WITH_COARSE_MESH, Verdict};
use super::warning;
use std::fmt::Write;

/// What stands before the definitions.
const HEAD: &str = include_str!("head.md");

/// A row of the first table: what it counts, and which verdicts.
type Count = (&'static str, fn(&Judged, &Verdict) -> bool);

const COUNTS: [Count; 11] = [
    ("right", |_, verdict| matches!(verdict, Verdict::Right { is_warned: false })),
    ("right, but warned of", |_, verdict| matches!(verdict, Verdict::Right { is_warned: true })),
    ("of these where the reference knows all results", |machine, verdict| {
        is_known(machine) && matches!(verdict, Verdict::Right { is_warned: true })
    }),
    ("wrong and warned of", |_, verdict| matches!(verdict, Verdict::Warned(..))),
    ("refused", |_, verdict| matches!(verdict, Verdict::Refused(_))),
    ("**silently wrong**", |_, verdict| matches!(verdict, Verdict::SilentlyWrong(_))),
    ("of these by more than 10 %", |_, verdict| matches!(verdict, Verdict::SilentlyWrong(error) if error.size > GROSS)),
    ("without an end", |_, verdict| matches!(verdict, Verdict::Endless)),
    ("panic", |_, verdict| matches!(verdict, Verdict::Panicked(_))),
    ("no reference", |_, verdict| matches!(verdict, Verdict::NoReference(_))),
    ("no such setting", |_, verdict| matches!(verdict, Verdict::NotApplicable)),
];

/// The page.
pub fn page(judged: &[Judged]) -> String {
    let sections = [
        HEAD.to_owned(),
        definitions(),
        totals(judged),
        groups(judged),
        silent(judged),
        unknown(judged),
        every(judged),
    ];
    let texts: Vec<&str> = sections.iter().map(|section| section.trim_end()).filter(|text| !text.is_empty()).collect();
    texts.join("\n\n") + "\n"
}

/// The head of a table with a column for each setting.
fn header(first: &str) -> String {
    let titles: String = SETTINGS.iter().map(|setting| format!(" {} |", setting.title())).collect();
    format!("| {first} |{titles}\n|---|{}\n", "---|".repeat(SETTINGS.len()))
}

/// What the verdicts mean.
fn definitions() -> String {
    let words: Vec<String> = warning::counted().map(|words| format!("\"{words}\"")).collect();
    format!(
        "- **own**: as the file of the machine says. **defaults**: without its `integrator`, and without its `step` where a file may leave it out. \
           **step x N**: with a fixed step N times as large. **mesh / N**: with one element instead of N.\n\
         - The **reference** has a mesh twice as fine, and a fourth and an eighth of the step; a sixteenth follows where these two disagree. For each family of \
           columns it is known as far as the two finest levels agree to {} of the scale; later rows are not compared. There is no reference where the \
           finest level warns that its steps are too large. Between two rows one level takes an even number of steps and the next an odd one: what \
           alternates from step to step would pass for agreement otherwise. Where refinement is known to make the machine's own integrator worse, the \
           reference uses another one.\n\
         - A **family** is all components of an output, or all energies. Its **scale** is that of its largest component: how far positions and angles \
           change, how large velocities, forces and energies get. The scale of a force or moment is at least {} of the largest one in the machine. The \
           **error** is the largest difference in any row over the scale; forces, strains, stresses and accelerations may be off by more in {} of the rows.\n\
         - **right**: the error is at most {}; with a coarser mesh at most {}. Only results that the reference knows count (\"known\" is their share, families times rows): a \
           machine that is right, but warned of, may be wrong where the reference knows nothing.\n\
         - **refused**: the run ended with an error message. **wrong and warned of**: a warning said that the numbers are not to be trusted. **silently \
           wrong**: neither. These warnings count, found by words in them: {}.\n\
         - **without an end**: the campaign gave the run up after many times the steps that it should take.\n\
         - **(mesh)**, **(step)**: what causes the error of the own settings. With the same steps and a mesh twice as fine the machine is right (mesh), or more than half \
           of the error is left (step).",
        bound(AGREEMENT),
        bound(SMALL_FORCE),
        bound(ROUGH_SHARE),
        bound(RIGHT),
        bound(RIGHT_WITH_COARSE_MESH),
        words.join(", ")
    )
}

/// A bound as it was set: `0.2 %`.
fn bound(share: f64) -> String {
    format!("{} %", (1e5 * share).round() / 1e3)
}

fn totals(judged: &[Judged]) -> String {
    let mut text = format!("## Verdicts\n\n{} machines.\n\n{}", judged.len(), header("verdict"));
    for (title, counts) in COUNTS {
        let _ = write!(text, "| {title} |");
        for place in 0..SETTINGS.len() {
            let _ = write!(
                text,
                " {} |",
                judged.iter().filter(|machine| counts(machine, &machine.verdicts[place])).count()
            );
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
                    matches!(verdict, Verdict::Right { .. } | Verdict::Warned(..) | Verdict::SilentlyWrong(_))
                })
                .collect();
            let silent = known.iter().filter(|verdict| matches!(verdict, Verdict::SilentlyWrong(_))).count();
            let _ = write!(text, " {silent} of {} |", known.len());
        }
        text.push('\n');
    }
    text
}

/// Whether the reference knows all results of a machine, to half a percent.
fn is_known(machine: &Judged) -> bool {
    machine.known.is_some_and(|known| known >= 0.995)
}

/// The machines that are silently wrong in any setting.
fn silent(judged: &[Judged]) -> String {
    let lead = "The worst family of columns and its error, of the family's scale. `cargo run --release --bin campaign -- --only NAME --write DIR` writes the model files of a machine.";
    let titles: String = SETTINGS.iter().map(|setting| format!(" {} |", setting.title())).collect();
    let mut text = format!(
        "## The silently wrong ones\n\n{lead}\n\n| machine | known |{titles}\n|---|---|{}\n",
        "---|".repeat(SETTINGS.len())
    );
    for machine in judged {
        if is_silently_wrong(machine) {
            text += &line(machine);
        }
    }
    text
}

/// Whether a machine is silently wrong in any setting.
pub fn is_silently_wrong(machine: &Judged) -> bool {
    machine.verdicts.iter().any(|verdict| matches!(verdict, Verdict::SilentlyWrong(_)))
}

/// The line of a machine.
pub fn line(machine: &Judged) -> String {
    let fault = |setting: Setting| match machine.fault.filter(|_| setting == Setting::Own) {
        Some(Fault::Mesh) => " (mesh)",
        Some(Fault::Step) => " (step)",
        Some(Fault::Both) => " (mesh and step)",
        None => "",
    };
    let cells = SETTINGS.iter().zip(&machine.verdicts);
    let cells: String = cells.map(|(setting, verdict)| format!(" {}{} |", cell(verdict), fault(*setting))).collect();
    format!("| {} | {} |{cells}\n", machine.name, known(machine))
}

/// The share of all results that the reference knows.
fn known(machine: &Judged) -> String {
    machine.known.map_or(String::from("-"), |known| format!("{:.0} %", 100.0 * known))
}

fn cell(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Right { is_warned: false } => String::from("right"),
        Verdict::Right { is_warned: true } => String::from("right, warned"),
        Verdict::Warned(..) => String::from("warned"),
        Verdict::SilentlyWrong(error) => format!("**{}** {}", percent(error.size), error.family),
        Verdict::Refused(_) => String::from("refused"),
        Verdict::Endless => String::from("endless"),
        Verdict::Panicked(_) => String::from("panic"),
        Verdict::NoReference(_) => String::from("no reference"),
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

/// Every verdict in a letter.
fn every(judged: &[Judged]) -> String {
    let lead = "How much of the machine's results the reference knows, and a letter for each setting, in the order of the tables: `r` right, `R` right but warned of, `w` wrong and warned of, `x` refused, `S` silently wrong, \
                `e` without an end, `p` panic, `?` no reference, `-` no such setting.";
    let lines: String = judged.iter().map(letters).collect();
    format!("## Every verdict\n\n{lead}\n\n```\n{lines}```")
}

/// The verdicts that a page has on `machines`, as far as it tells them: of warnings and refusals without their words.
/// None: it lacks a machine.
pub fn read(page: &str, machines: &[Machine]) -> Option<Vec<Judged>> {
    let letters = page.split("```").nth(1)?;
    let judged = machines.iter().map(|machine| {
        let own = letters.lines().find_map(|line| line.strip_suffix(&machine.name)?.strip_suffix(' '))?;
        let (own, known) = own.split_once(' ')?;
        if own.chars().count() != SETTINGS.len() {
            return None;
        }
        let row =
            page.lines().find_map(|line| line.strip_prefix(&format!("| {} | ", machine.name))?.strip_suffix(" |"));
        let mut cells = row.into_iter().flat_map(|row| row.split(" | "));
        let _known = cells.next();
        let cells: Vec<&str> = cells.collect();
        let verdicts = own.chars().enumerate().map(|(place, letter)| verdict(letter, cells.get(place).copied()));
        let own = cells.first().copied().unwrap_or_default();
        let faults = [("(mesh)", Fault::Mesh), ("(step)", Fault::Step), ("(mesh and step)", Fault::Both)];
        let unknown = page.lines().find_map(|line| line.strip_prefix(&format!("- {}: ", machine.name)));
        Some(Judged {
            name: machine.name.clone(),
            group: machine.group,
            known: share(known.trim()),
            verdicts: verdicts.collect::<Option<Vec<_>>>()?,
            fault: faults.into_iter().find(|(words, _)| own.ends_with(words)).map(|(_, fault)| fault),
            unknown_warning: unknown.map(str::to_owned),
        })
    });
    judged.collect()
}

/// The verdict of a letter, with the cell of its machine among the silently wrong ones.
fn verdict(letter: char, cell: Option<&str>) -> Option<Verdict> {
    let nothing = || Error { family: String::new(), size: 0.0 };
    Some(match letter {
        'r' => Verdict::Right { is_warned: false },
        'R' => Verdict::Right { is_warned: true },
        'w' => Verdict::Warned(nothing(), String::new()),
        'x' => Verdict::Refused(String::new()),
        'S' => {
            let (size, rest) = cell?.strip_prefix("**")?.split_once("** ")?;
            let family = rest.split(' ').next()?.to_owned();
            Verdict::SilentlyWrong(Error { family, size: share(size)? })
        }
        'e' => Verdict::Endless,
        'p' => Verdict::Panicked(String::new()),
        '?' => Verdict::NoReference(String::new()),
        '-' => Verdict::NotApplicable,
        _ => return None,
    })
}

/// A share that is written in percent.
fn share(text: &str) -> Option<f64> {
    Some(text.strip_suffix(" %")?.parse::<f64>().ok()? / 100.0)
}

/// The letters of a machine, with its name.
pub fn letters(machine: &Judged) -> String {
    let letter = |verdict: &Verdict| match verdict {
        Verdict::Right { is_warned: false } => 'r',
        Verdict::Right { is_warned: true } => 'R',
        Verdict::Warned(..) => 'w',
        Verdict::Refused(_) => 'x',
        Verdict::SilentlyWrong(_) => 'S',
        Verdict::Endless => 'e',
        Verdict::Panicked(_) => 'p',
        Verdict::NoReference(_) => '?',
        Verdict::NotApplicable => '-',
    };
    let letters: String = machine.verdicts.iter().map(letter).collect();
    format!("{letters} {:>5} {}\n", known(machine), machine.name)
}
