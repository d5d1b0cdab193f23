//! All machines of the campaign: those of files, then those of the generators.

use super::generators;
use super::machine::Machine;

/// A name and the text of a model file.
type File = (&'static str, &'static str);

/// The models that come with the program.
const SHIPPED: [File; 12] = [
    ("pendulum", include_str!("../../../../models/pendulum.toml")),
    ("cantilever", include_str!("../../../../models/cantilever.toml")),
    ("princeton_beam", include_str!("../../../../models/princeton_beam.toml")),
    ("rotating_shaft", include_str!("../../../../models/rotating_shaft.toml")),
    ("lateral_buckling", include_str!("../../../../models/lateral_buckling.toml")),
    ("four_bar", include_str!("../../../../models/four_bar.toml")),
    ("crane", include_str!("../../../../models/crane.toml")),
    ("roll_up", include_str!("../../../../models/roll_up.toml")),
    ("elastica", include_str!("../../../../models/elastica.toml")),
    ("ring", include_str!("../../../../models/ring.toml")),
    ("helical_spring", include_str!("../../../../models/helical_spring.toml")),
    ("bend_45", include_str!("../../../../models/bend_45.toml")),
];

/// Machines as engineers build them.
const ENGINEERED: [File; 22] = [
    ("anti_roll_bar", include_str!("machines/anti_roll_bar.toml")),
    ("bicycle_wheel", include_str!("machines/bicycle_wheel.toml")),
    ("bow", include_str!("machines/bow.toml")),
    ("cardan_shaft", include_str!("machines/cardan_shaft.toml")),
    ("drill_string", include_str!("machines/drill_string.toml")),
    ("engine_mount", include_str!("machines/engine_mount.toml")),
    ("fishing_rod", include_str!("machines/fishing_rod.toml")),
    ("flexible_robot", include_str!("machines/flexible_robot.toml")),
    ("gantry_crane", include_str!("machines/gantry_crane.toml")),
    ("guide_wire", include_str!("machines/guide_wire.toml")),
    ("guitar_string", include_str!("machines/guitar_string.toml")),
    ("hot_rail", include_str!("machines/hot_rail.toml")),
    ("mems_resonator", include_str!("machines/mems_resonator.toml")),
    ("parallel_flexure", include_str!("machines/parallel_flexure.toml")),
    ("satellite", include_str!("machines/satellite.toml")),
    ("scissor_lift", include_str!("machines/scissor_lift.toml")),
    ("slack_cable", include_str!("machines/slack_cable.toml")),
    ("spinning_top", include_str!("machines/spinning_top.toml")),
    ("tensegrity_prism", include_str!("machines/tensegrity_prism.toml")),
    ("trampoline_net", include_str!("machines/trampoline_net.toml")),
    ("valve_spring", include_str!("machines/valve_spring.toml")),
    ("wind_turbine", include_str!("machines/wind_turbine.toml")),
];

/// Machines that were wrong without a word at some time, or refused without a reason.
const FORMER_DEFECTS: [File; 21] = [
    ("alpha_crankshaft", include_str!("machines/alpha_crankshaft.toml")),
    ("alpha_rotor", include_str!("machines/alpha_rotor.toml")),
    ("alpha_spinning_body", include_str!("machines/alpha_spinning_body.toml")),
    ("axial_load_inside", include_str!("machines/axial_load_inside.toml")),
    ("beck", include_str!("machines/beck.toml")),
    ("conserving_flat_shaft", include_str!("machines/conserving_flat_shaft.toml")),
    ("conserving_spinning_strip", include_str!("machines/conserving_spinning_strip.toml")),
    ("drive_jump", include_str!("machines/drive_jump.toml")),
    ("drive_slope_not_finite", include_str!("machines/drive_slope_not_finite.toml")),
    ("far_from_origin", include_str!("machines/far_from_origin.toml")),
    ("general_section_torque", include_str!("machines/general_section_torque.toml")),
    ("hanging_line", include_str!("machines/hanging_line.toml")),
    ("load_pulse", include_str!("machines/load_pulse.toml")),
    ("micro_linkage", include_str!("machines/micro_linkage.toml")),
    ("nothing_is_held", include_str!("machines/nothing_is_held.toml")),
    ("rate_bell", include_str!("machines/rate_bell.toml")),
    ("rate_pulse", include_str!("machines/rate_pulse.toml")),
    ("redundant_loop", include_str!("machines/redundant_loop.toml")),
    ("snap_through", include_str!("machines/snap_through.toml")),
    ("spinning_blade", include_str!("machines/spinning_blade.toml")),
    ("stiff_damper", include_str!("machines/stiff_damper.toml")),
];

/// Machines of files whose reference needs another integrator, because refinement does not cure their own one: spinning
/// flat beams gain energy with the midpoint rules the sooner the finer the mesh is.
const JUDGES: [(&str, &str); 3] = [
    ("conserving_flat_shaft", "generalized_alpha"),
    ("conserving_spinning_strip", "generalized_alpha"),
    ("spinning_blade", "generalized_alpha"),
];

/// Every machine, in the order of the page.
pub fn machines() -> Vec<Machine> {
    let groups = [("shipped", &SHIPPED[..]), ("engineered", &ENGINEERED[..]), ("former defects", &FORMER_DEFECTS[..])];
    let files = groups.into_iter().flat_map(|(group, files)| files.iter().map(move |file| from_file(group, file)));
    files.chain(generators::machines()).collect()
}

fn from_file(group: &'static str, (name, text): &File) -> Machine {
    let judge = JUDGES.iter().find(|(own, _)| own == name).map(|(_, judge)| *judge);
    Machine { name: (*name).to_owned(), group, text: (*text).to_owned(), start: 0.0, judge }
}
