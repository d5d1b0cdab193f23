//! Mistakes of forces on a joint that may be released: nothing can act on its coordinate then.

use super::entries::Parts;
use super::number::Numbers;
use crate::model::text::diagnostic::Report;
use crate::model::text::names::Kind;

/// Reports what would go on acting on a coordinate of a joint that may be released: the coordinate means nothing
/// between parts that fly on. Drives and locks are released with the joint.
pub(super) fn report(parts: &Parts, numbers: &Numbers, report: &mut Report<'_>) {
    const HELP: &str = "drives and locks may act on it: they are released with the joint. Put a spring or an actuator between two points, \
                        or on another joint";
    for own in parts.acting().filter(|own| !matches!(own.kind, Kind::Drive | Kind::Lock)) {
        let joint = own.action.joint().and_then(|joint| parts.joints.get(joint));
        let Some(joint) = joint.filter(|joint| joint.switch.is_some()) else { continue };
        let message = format!("{} {} acts on joint {}, which may be released", own.kind.word(), own.name, joint.name);
        let label = format!("the joint has `active` or `input`, line {}", report.source.line(joint.place));
        report.error(own.place, &message, &label, HELP);
    }
    for joint in parts.joints.iter().filter(|joint| joint.switch.is_some()) {
        let own = joint.angle.iter().chain(&joint.distance).flat_map(|own| [own.stiffness, own.damping]);
        for number in own.filter(|number| numbers.slots[number.0].listed.is_some()) {
            let slot = &numbers.slots[number.0];
            let message = format!("joint {} may be released, and has `{}`", joint.name, slot.meta.name);
            report.error(slot.place, &message, "its coordinate means nothing once the joint is released", HELP);
        }
    }
}
