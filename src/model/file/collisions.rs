//! Variables that would have the same name: `tie.damping` of a material and of a spring, `disk.position[1]` of a body
//! and of an output.

use super::entries::output::{OutputSpec, Target};
use super::number::Numbers;
use super::parameter::Parameter;
use crate::model::text::diagnostic::{Place, Report};
use crate::model::text::names::Names;
use std::collections::BTreeMap;

/// One variable, or several that differ in their indices only.
struct Variables {
    /// `disk.position`
    name: String,
    /// Where it is written.
    place: Place,
}

/// Reports, once for all its components, every variable that another one before it in the file has the name of.
pub(super) fn report(
    parameters: &[Parameter],
    numbers: &Numbers,
    outputs: &[OutputSpec],
    names: &Names,
    report: &mut Report<'_>,
) {
    let mut list: Vec<Variables> = Vec::new();
    let mut last = None;
    for parameter in parameters {
        let full = &parameter.variable.name;
        let slot = &numbers.slots[parameter.number.0];
        // An override has its place elsewhere; it is the file that makes it a parameter.
        let place = match slot.listed {
            Some(start) if slot.place.source > 0 && start < usize::MAX => Place::file(start..start + 1),
            _ => slot.place,
        };
        let name = full.split('[').next().unwrap_or(full);
        // The components of a vector follow one another.
        let number = (name.to_owned(), names.owner(name, place));
        if name.contains('.') && last.as_ref() != Some(&number) {
            list.push(Variables { name: name.to_owned(), place });
        }
        last = Some(number);
    }
    // The stations of a beam have two indices: no parameter has.
    for output in outputs.iter().filter(|output| !matches!(output.target, Target::On { .. })) {
        list.extend(output.quantities.iter().map(|quantity| Variables {
            name: format!("{}.{}", output.name, quantity.row().word),
            place: output.place,
        }));
    }
    list.sort_by_key(|variables| variables.place);
    let mut firsts: BTreeMap<&str, &Variables> = BTreeMap::new();
    for second in &list {
        let Some(first) = firsts.get(second.name.as_str()).copied() else {
            firsts.insert(&second.name, second);
            continue;
        };
        let title = |variables: &Variables| match names.owner(&variables.name, variables.place) {
            Some(owner) => format!("[{}.{}]", owner.kind.word(), owner.name),
            None => String::from("another section"),
        };
        let message = format!("{} and {} both have a variable `{}`", title(first), title(second), second.name);
        let label = format!("line {} has the other one", report.source.line(first.place));
        let free = names.owner(&second.name, second.place).map(|own| names.free_name(&own.name, own.kind));
        let proposal = free.map_or(String::new(), |free| format!(": call this one `{free}`, for instance"));
        let help = format!(
            "variables are named NAME.key and NAME.quantity, and hosts tell them apart by these names{proposal}"
        );
        report.error(second.place, &message, &label, &help);
    }
}
