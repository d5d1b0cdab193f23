//! Motions that begin with a jump of velocity: the mechanism is at rest, and a drive is not.

use super::Note;
use crate::math::Vec3;
use crate::model::file::document::Document;
use crate::model::file::entries::drive::{DriveSpec, Motion};
use crate::model::file::entries::simulation::Analysis;
use crate::model::file::entries::winch::WinchSpec;
use crate::model::file::number::Number;
use crate::model::shape::{Lines, sections, shown};

/// Strain of the wave that a jump of velocity sends through a beam, its velocity over that of sound, from which it
/// matters: 60 MPa in steel.
const NOTABLE: f64 = 3e-4;

/// Names drives that begin at a rate that sends notable waves through beams at rest.
pub fn jumps(document: &Document, lines: &Lines) -> Vec<Note> {
    let is_given = |numbers: &[Number; 3]| numbers.iter().any(|number| document.value(*number) != 0.0);
    let moves = document.beams.iter().any(|beam| is_given(&beam.velocity) || is_given(&beam.angular_velocity))
        || document.bodies.iter().any(|body| is_given(&body.velocity) || is_given(&body.angular_velocity));
    if moves || document.simulation.analysis == Analysis::Static {
        return Vec::new();
    }
    let speeds = document.beams.iter().filter_map(|beam| {
        let (material, section) = (sections::material(document, beam)?, document.sections.get(beam.section)?);
        let section = sections::at_start(document, section);
        let [line_density, _] = section.densities(&material);
        Some((material.young * section.area / line_density).sqrt())
    });
    // Without beams there is nothing that a blow could excite.
    let Some(sound) = speeds.reduce(f64::min) else { return Vec::new() };
    let jump = |drive: &DriveSpec| {
        let number = drive.motion.number();
        let rate = rate_at_start(document, drive.motion);
        let (arm, unit) = if drive.is_angle() { (reach(document, lines, drive)?, "rad/s") } else { (1.0, "m/s") };
        let strain = rate.abs() * arm / sound;
        (!drive.input && strain > NOTABLE).then(|| {
            let text = format!(
                "begins with a jump of velocity: drive {} starts at {} {unit}, and the mechanism is at rest. This is a blow, with strains of about \
                 {:.1e}. Let the motion begin with rate 0, or give the parts that move the `velocity` and `angular_velocity` of the start",
                drive.name,
                shown(rate),
                strain
            );
            Note::of(document, number, &text)
        })
    };
    let reel = |winch: &WinchSpec| {
        let number = winch.motion.number();
        let rate = rate_at_start(document, winch.motion);
        (!winch.input && rate.abs() / sound > NOTABLE).then(|| {
            let text = format!(
                "begins with a jump of velocity: winch {} starts at {} m/s, and its beam is at rest. This is a blow. Let it begin with rate 0",
                winch.name,
                shown(rate)
            );
            Note::of(document, number, &text)
        })
    };
    document.drives.iter().filter_map(jump).chain(document.winches.iter().filter_map(reel)).collect()
}

/// The rate at the start of what a drive or a winch prescribes.
fn rate_at_start(document: &Document, motion: Motion) -> f64 {
    match motion {
        Motion::Value(number) => document.function(number).jet(0.0).first,
        Motion::Rate(number) => document.function(number).value(0.0),
    }
}

/// The largest distance of a beam that a joint holds from that joint, m; of all beams where it holds none.
fn reach(document: &Document, lines: &Lines, drive: &DriveSpec) -> Option<f64> {
    let joint = document.joints.get(drive.joint)?;
    let place = match joint.at {
        Some(at) => Vec3::from(document.vector(at)),
        None => lines.place(document, joint.b).or_else(|| lines.place(document, joint.a))?,
    };
    let beams = 0..document.beams.len();
    let nodes = beams.filter_map(|beam| lines.line(beam)).flat_map(|line| &line.nodes);
    nodes.map(|node| (node.place - place).norm()).reduce(f64::max)
}
