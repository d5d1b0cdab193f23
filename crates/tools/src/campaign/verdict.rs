//! The verdict on a machine in a setting.

use super::family::Family;
use super::machine::{Machine, SETTINGS, Setting};
use super::reference::Reference;
use super::run::{End, Record};
use super::warning;

/// Largest error that is right, of the family's scale.
pub const RIGHT: f64 = 0.01;
/// The same with a coarser mesh: whoever takes a quarter of the elements wants an impression.
pub const RIGHT_WITH_COARSE_MESH: f64 = 0.05;
/// An error beyond which nobody would call the results rough.
pub const GROSS: f64 = 0.1;

/// What becomes of a machine in a setting.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// Within the bound; `is_warned`: it was warned of all the same.
    Right {
        /// Whether a warning doubted the numbers.
        is_warned: bool,
    },
    /// Wrong, and a warning doubted the numbers: this one.
    Warned(Error, String),
    /// Wrong without a word.
    SilentlyWrong(Error),
    /// It ended with an error.
    Refused(String),
    /// It had to be stopped.
    Endless,
    /// It ended with a panic.
    Panicked(String),
    /// Nobody knows what is right, for this reason.
    NoReference(String),
    /// There is no such setting of this machine.
    NotApplicable,
}

/// The largest error of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Error {
    /// The family that it is in.
    pub family: String,
    /// Its size, of the family's scale.
    pub size: f64,
}

/// Whose fault an error is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// With the same steps a finer mesh is right.
    Mesh,
    /// With the same steps a finer mesh has more than half of the error, or there is no mesh.
    Step,
    /// Some of both.
    Both,
}

/// What is known of a machine when all its settings have run.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// Its name.
    pub name: String,
    /// Its group.
    pub group: &'static str,
    /// A verdict for each of [`SETTINGS`].
    pub verdicts: Vec<Verdict>,
    /// Whose fault it is, where its author's own settings are silently wrong.
    pub fault: Option<Fault>,
    /// Share of its results that the reference knows; none: no reference.
    pub known: Option<f64>,
    /// The first warning of it that the campaign does not know.
    pub unknown_warning: Option<String>,
}

/// Runs a machine in all settings, and judges.
pub fn judged(machine: &Machine) -> Judged {
    let reference = Reference::new(machine);
    let mut unknown_warning = None;
    let mut verdicts: Vec<Verdict> = Vec::new();
    for setting in SETTINGS {
        let text = machine.text(setting);
        let same = |earlier: &Setting| machine.text(*earlier) == text && earlier.step(machine) == setting.step(machine);
        let earlier = SETTINGS[..verdicts.len()].iter().position(|earlier| text.is_some() && same(earlier));
        verdicts.push(match (earlier, text) {
            (Some(place), _) => verdicts[place].clone(),
            (None, None) => Verdict::NotApplicable,
            (None, Some(text)) => {
                let record = Record::new(machine, setting, &text);
                unknown_warning = unknown_warning.or_else(|| warning::unknown(&record.warnings).cloned());
                verdict(setting, &record, &reference)
            }
        });
    }
    let own = SETTINGS.iter().position(|setting| *setting == Setting::Own).map(|place| &verdicts[place]);
    let fault = match own {
        Some(Verdict::SilentlyWrong(error)) => Some(fault(machine, error, &reference)),
        _ => None,
    };
    let known = reference.ok().map(|reference| reference.share());
    Judged { name: machine.name.clone(), group: machine.group, verdicts, fault, known, unknown_warning }
}

/// Whose fault an error of the machine's own settings is.
fn fault(machine: &Machine, own: &Error, reference: &Result<Reference, String>) -> Fault {
    let setting = Setting::FinerMesh;
    let finer = machine.text(setting).filter(|text| *text != machine.text);
    let verdict = finer.map(|text| verdict(setting, &Record::new(machine, setting, &text), reference));
    match verdict {
        Some(Verdict::Right { .. }) => Fault::Mesh,
        Some(Verdict::SilentlyWrong(error) | Verdict::Warned(error, _)) if error.size < 0.5 * own.size => Fault::Both,
        _ => Fault::Step,
    }
}

/// What a run is worth beside the reference.
pub fn verdict(setting: Setting, record: &Record, reference: &Result<Reference, String>) -> Verdict {
    match &record.end {
        End::Refused(reason) => return Verdict::Refused(reason.clone()),
        End::Endless => return Verdict::Endless,
        End::Panicked(words) => return Verdict::Panicked(words.clone()),
        End::Complete => (),
    }
    let reference = match reference {
        Ok(reference) => reference,
        Err(reason) => return Verdict::NoReference(reason.clone()),
    };
    let known = reference.families.iter().filter(|(_, rows)| *rows > 0);
    let errors = known.filter_map(|(family, rows)| error(family, *rows, record, &reference.record));
    let Some(worst) = errors.reduce(|worst, other| if other.size > worst.size { other } else { worst }) else {
        return Verdict::NoReference(String::from("its rows are further apart than the reference is known"));
    };
    let doubt = warning::doubt_of_numbers(&record.warnings);
    let bound = if matches!(setting, Setting::Mesh(_)) { RIGHT_WITH_COARSE_MESH } else { RIGHT };
    match (worst.size <= bound, doubt) {
        (true, doubt) => Verdict::Right { is_warned: doubt.is_some() },
        (false, Some(warning)) => Verdict::Warned(worst, warning.clone()),
        (false, None) => Verdict::SilentlyWrong(worst),
    }
}

/// The error of a family over the first `known` rows of the reference, but for the share of the rows that may be off.
/// None: no row is there.
fn error(family: &Family, known: usize, record: &Record, reference: &Record) -> Option<Error> {
    let scale = family.scale(reference, known);
    // Row 0 is not a result of any step.
    let rows = record.rows.iter().filter(|(number, _)| (1..known).contains(number));
    let mut differences: Vec<f64> =
        rows.filter_map(|(number, own)| Some(family.difference(own, reference.row(*number)?))).collect();
    differences.sort_by(f64::total_cmp);
    let off = (family.share() * differences.len() as f64) as usize;
    let worst = *differences.get(differences.len().checked_sub(1 + off)?)?;
    // A family without any size, where forces are zero throughout: what is zero is right.
    let size = if worst == 0.0 { 0.0 } else { worst / scale };
    Some(Error { family: family.name.clone(), size })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A reference of 101 rows of a velocity and a reaction, both of size 1, of which the first `rows` are known.
    fn reference(rows: usize) -> Result<Reference, String> {
        let record = swing(|_| 0.0, |_| 0.0);
        let families = Family::all(&record.columns).into_iter().map(|family| (family, rows)).collect();
        Ok(Reference { record, families, rows: 101 })
    }

    /// Swings, with an error of the velocity and one of the reaction in each row.
    fn swing(velocity: impl Fn(usize) -> f64, reaction: impl Fn(usize) -> f64) -> Record {
        let row = |number: usize| {
            let swing = (0.25 * std::f64::consts::PI * number as f64).cos();
            vec![swing + velocity(number), swing + reaction(number)]
        };
        Record::sample(&[("tip.velocity[1]", "m/s"), ("root.reaction_force[1]", "N")], (0..101).map(row))
    }

    fn judge(record: &Record) -> Verdict {
        verdict(Setting::Own, record, &reference(101))
    }

    /// An error is right up to its bound, and beyond it silently wrong, unless a warning doubts the numbers.
    #[test]
    fn errors_are_found_and_warnings_count() {
        assert_eq!(judge(&swing(|_| 0.009, |_| 0.0)), Verdict::Right { is_warned: false });
        let mut wrong = swing(|number| if number == 77 { 0.02 } else { 0.0 }, |_| 0.0);
        let Verdict::SilentlyWrong(error) = judge(&wrong) else { panic!("{:?}", judge(&wrong)) };
        assert!(error.family == "tip.velocity" && (error.size - 0.02).abs() < 1e-12, "{error:?}");
        assert_eq!(verdict(Setting::Mesh(2), &wrong, &reference(101)), Verdict::Right { is_warned: false });
        wrong.warnings.push(String::from("the given initial velocities are not used: the analysis is static"));
        assert_eq!(judge(&wrong), Verdict::SilentlyWrong(error.clone()));
        let warning = String::from("by t = 1 s the integrator has gained 3 J");
        wrong.warnings.push(warning.clone());
        assert_eq!(judge(&wrong), Verdict::Warned(error, warning));
    }

    /// Some rows of a force may be off, of a velocity none; rows that the reference does not know are not judged.
    #[test]
    fn forces_are_rough_and_unknown_rows_are_left_out() {
        let off = |rows: usize| swing(|_| 0.0, move |number| if number > 100 - rows { 0.5 } else { 0.0 });
        assert_eq!(judge(&off(5)), Verdict::Right { is_warned: false });
        assert!(matches!(judge(&off(6)), Verdict::SilentlyWrong(error) if error.family == "root.reaction_force"));
        let late = swing(|number| if number >= 60 { 0.5 } else { 0.0 }, |_| 0.0);
        assert_eq!(verdict(Setting::Own, &late, &reference(60)), Verdict::Right { is_warned: false });
        assert!(matches!(verdict(Setting::Own, &late, &reference(61)), Verdict::SilentlyWrong(_)));
    }
}
