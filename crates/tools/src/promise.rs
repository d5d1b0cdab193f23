//! What a run promises, measured: a model file without steps and meshes runs with the defaults of the program, and the
//! results of its last run are compared with a finer run of the same model.

use super::campaign::verdict::RIGHT;
use super::campaign::warning;

use ancf14::fmi::Model;
use ancf14::model::file::{Folder, Reach};
use ancf14::model::refinement::{Outcome, Refinement};
use ancf14::model::rows;
use ancf14::model::run::accuracy::{Differences, Inexact};
use ancf14::model::run::levels;
use ancf14::model::simulation::Simulation;
use std::fmt;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

/// By what the reference is finer than the last run: its meshes, and the parts of its steps.
const FINER: f64 = 2.0;
const PARTS: u32 = 4;

/// Words of warnings that tell which equilibria the run has found, not how exact it is.
const OF_EQUILIBRIA: [&str; 7] = [
    "found far from where the mechanism is drawn",
    "passes a limit point",
    "passes a branch point",
    "another path crosses",
    "goes over to the path that crosses",
    "becomes unstable",
    "becomes stable again",
];

/// How a run with the defaults compares with its reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Kept {
    /// The result with the largest error, and its error as a share of its scale; none: there is no reference, for this
    /// reason.
    pub error: Result<Option<Inexact>, String>,
    /// What the run says of itself; none: it is not repeated.
    pub outcome: Option<Outcome>,
    /// The first warning about the accuracy.
    pub doubt: Option<String>,
    /// Processor time of the first run and of all runs, s.
    pub times: [f64; 2],
}

/// The text without `step`, and without `elements` and `twist` of beams, also of those that copies draw; nodes of these
/// beams become the fractions where they are.
pub fn stripped(text: &str) -> String {
    let mut section = "";
    let (mut kept, mut meshes) = (String::new(), Vec::new());
    for line in text.lines() {
        let trimmed = line.trim();
        if trimmed.starts_with('[') && !trimmed.contains('=') {
            section = trimmed.trim_start_matches('[').split(']').next().unwrap_or("");
        }
        let (key, value) = trimmed.split_once('=').map_or(("", ""), |(key, value)| (key.trim(), value));
        let beam = section.rsplit_once("beam.").map(|(_, beam)| beam);
        if let (Some(beam), "elements") = (beam, key) {
            meshes.push((beam, value.split('#').next().unwrap_or("").trim().trim_matches('"')));
        }
        if !(beam.is_some() && matches!(key, "elements" | "twist") || section == "simulation" && key == "step") {
            kept += line;
            kept.push('\n');
        }
    }
    meshes.iter().fold(kept, |text, (beam, elements)| with_fractions(&text, beam, elements))
}

/// The text with `BEAM@(k)/(elements)` in place of `BEAM.node[k]`; a beam of copies may have its number between.
fn with_fractions(text: &str, beam: &str, elements: &str) -> String {
    const NODE: &str = ".node[";
    let (mut changed, mut rest) = (String::new(), text);
    while let Some((before, after)) = rest.split_once(NODE) {
        changed += before;
        let named = before.rsplit('"').next().unwrap_or("").split('[').next();
        match after.split_once("]\"").filter(|_| named == Some(beam)) {
            Some((node, after)) => {
                changed += &format!("@({node})/({elements})\"");
                rest = after;
            }
            None => {
                changed += NODE;
                rest = after;
            }
        }
    }
    changed + rest
}

/// Runs the file at `path` with `budget`, stripped, and compares it with its reference. Runs end after `limit` of
/// processor time in all.
///
/// # Errors
/// The first run failed, for this reason.
pub fn measure(path: &Path, budget: Option<f64>, limit: Duration) -> Result<Kept, String> {
    let text = fs::read_to_string(path).map_err(|reason| reason.to_string())?;
    let folder = Folder::new(path.parent().unwrap_or(Path::new("")), Reach::Anywhere);
    let name = path.display().to_string();
    let first = Simulation::load_in(Some(folder), &name, &stripped(&text), &[]);
    let mut first = first.map_err(|failure| failure.message)?;
    let clock = Clock::start(limit);
    first.ask_for_mesh_error(|companion| Box::new(companion));
    let mut refinement = Refinement::of(&mut first, budget);
    let mut warnings = Vec::new();
    let mut rows = run(&mut first, &clock, |own| refinement.iter_mut().for_each(|refinement| refinement.look(own)))?;
    let mut last = Box::new(first);
    let time_of_first = clock.passed();
    warnings.append(&mut last.take_warnings());
    while let Some(refinement) = &mut refinement
        && let Some(mut next) = refinement.judge(&last)
    {
        match run(&mut next, &clock, |own| refinement.look(own)) {
            Ok(found) => {
                warnings = next.take_warnings();
                (last, rows) = (next, found);
            }
            Err(reason) => refinement.fail(reason),
        }
    }
    let outcome = refinement.map(|refinement| refinement.outcome(&last));
    warnings.extend(outcome.as_ref().and_then(Outcome::warning));
    let times = [time_of_first, clock.passed()];
    warnings.retain(|warning| OF_EQUILIBRIA.iter().all(|words| !warning.contains(words)));
    let doubt = warning::doubt_of_numbers(&warnings).cloned();
    Ok(Kept { error: against_reference(&last, &rows, &Clock::start(limit)), outcome, doubt, times })
}

/// The largest error of the `rows` of `last`, as a share of its scale.
fn against_reference(last: &Simulation, rows: &[Vec<f64>], clock: &Clock) -> Result<Option<Inexact>, String> {
    let document = last.document();
    let changes = levels::finer(document, &vec![true; document.beams.len()], FINER).unwrap_or_default();
    if document.follows_arc_length() {
        return against_path(last, clock);
    }
    let is_motion = document.pacing(0.0).is_some();
    let finer = match is_motion {
        true => last.repeated(changes, Some(PARTS)),
        false => last.repeated_at_rest(changes),
    };
    let mut finer = finer.map_err(|failure| failure.message)?;
    let (mut differences, mut row) = (Differences::default(), 0);
    run(&mut finer, clock, |own| {
        rows.get(row).into_iter().for_each(|other| own.compare(other, &mut differences));
        row += 1;
    })?;
    let errors = finer.distances(&differences, |_, _| 1.0);
    Ok(errors.into_iter().max_by(|a, b| a.error.total_cmp(&b.error)))
}

/// The largest distance of the path from that of a mesh twice as fine.
fn against_path(last: &Simulation, clock: &Clock) -> Result<Option<Inexact>, String> {
    let mut own = last.repeated(Vec::new(), None).map_err(|failure| failure.message)?;
    let mut finer = own.twice_as_fine().ok_or("there is no finer mesh")?;
    let (mut differences, mut is_known) = (Differences::default(), true);
    run(&mut own, clock, |own| is_known &= own.compare_nearest(&mut finer, &mut differences).is_some())?;
    if !is_known {
        return Err(String::from("the path of the finer mesh is not found"));
    }
    let errors = own.distances(&differences, |_, _| 1.0);
    Ok(errors.into_iter().max_by(|a, b| a.error.total_cmp(&b.error)))
}

/// Runs to the end, and shows every row to `look`; returns the rows.
fn run(simulation: &mut Simulation, clock: &Clock, mut look: impl FnMut(&Simulation)) -> Result<Vec<Vec<f64>>, String> {
    let about = simulation.about().clone();
    let last = rows::last(&about).ok_or("too many rows")?;
    let mut found = Vec::new();
    for number in 0..=last {
        if clock.is_over() {
            return Err(String::from("out of time"));
        }
        let time = rows::time(&about, number, last);
        let outcome = if number == 0 { simulation.initialize(time) } else { simulation.advance(time) };
        outcome.map_err(|failure| failure.message)?;
        look(simulation);
        found.push(simulation.results().to_vec());
    }
    simulation.conclude();
    Ok(found)
}

/// The processor time of this thread, or the time on the wall where the system does not tell it.
struct Clock {
    begin: Duration,
    origin: Instant,
    limit: Duration,
}

impl Clock {
    fn start(limit: Duration) -> Self {
        let origin = Instant::now();
        Self { begin: Self::now(origin), origin, limit }
    }

    fn now(origin: Instant) -> Duration {
        let told = fs::read_to_string("/proc/thread-self/schedstat").ok();
        let nanoseconds = told.and_then(|text| text.split(' ').next()?.parse().ok());
        nanoseconds.map_or_else(|| origin.elapsed(), Duration::from_nanos)
    }

    fn passed(&self) -> f64 {
        (Self::now(self.origin).saturating_sub(self.begin)).as_secs_f64()
    }

    fn is_over(&self) -> bool {
        self.passed() > self.limit.as_secs_f64()
    }
}

impl Kept {
    /// The verdict in a word or two.
    pub fn verdict(&self) -> &'static str {
        let is_right = match &self.error {
            Err(_) => return if self.doubt.is_some() { "not known, warned" } else { "not known" },
            Ok(worst) => worst.as_ref().is_none_or(|worst| worst.error <= RIGHT),
        };
        match (is_right, &self.doubt) {
            (true, None) => "right",
            (true, Some(_)) => "right, warned",
            (false, Some(_)) => "wrong, warned",
            (false, None) => "silently wrong",
        }
    }
}

impl fmt::Display for Kept {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let told = |worst: &Option<Inexact>| {
            worst
                .as_ref()
                .map_or(String::from("nothing to judge"), |own| format!("{:.3} % {}", 100.0 * own.error, own.name))
        };
        let error = self.error.as_ref().map_or_else(|reason| reason.lines().next().unwrap_or("").to_owned(), told);
        let claim = self.outcome.as_ref().map_or(String::from("none"), |own| told(&own.worst));
        let (runs, elements) = self.outcome.as_ref().map_or((1, 0), |own| (own.runs, own.elements));
        let [first, all] = self.times;
        write!(
            f,
            "| {} | {error} | {claim} | {runs} | {elements} | {first:.2} | {:.1} |",
            self.verdict(),
            all / first
        )?;
        write!(f, " {} |", self.doubt.as_deref().unwrap_or_default().lines().next().unwrap_or_default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps and meshes go, what else is called so stays, and nodes keep their places.
    #[test]
    fn steps_and_meshes_are_left_out() {
        let text = "[beam.arm]\nelements = 4\ntwist = \"linear\"\nto = [1, 0, 0]\n[output.a]\nelements = 1\nat = \"arm.node[2*k]\"\n\
                    [simulation]\nstep = 1\noutput_step = 2\n";
        let left = "[beam.arm]\nto = [1, 0, 0]\n[output.a]\nelements = 1\nat = \"arm@(2*k)/(4)\"\n[simulation]\noutput_step = 2\n";
        assert_eq!(stripped(text), left);
    }
}
