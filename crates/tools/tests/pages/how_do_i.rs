//! Who copies a model of docs/how-do-i/ gets one that runs to its end without a warning, mesh error included, and the
//! figures that the page states.

use ancf14::fmi::{About, Model};
use ancf14::model::simulation::Simulation;
use ancf14_testing::pages;
use ancf14_testing::running::value;

/// The page that lists the entries of all others.
const INDEX: &str = include_str!("../../../../docs/how-do-i.md");

/// The name, the result at the end, its value by a closed form, and the tolerance of the comparison.
const STATED: [(&str, &str, f64, f64); 21] = [
    // Winkler: F (k/(4 EI))^0.25/(2 k); the supports stand 0.25 m apart and the ends are free: 1 %.
    ("RailOnBed", "settlement.displacement[3]", -1.187e-3, 1e-2),
    // Frýba's series with the rotary inertia of Rayleigh's beam: the accuracy, 1e-3 of a range ten times as large.
    ("CrossingLoad", "middle.displacement[3]", 1.067797e-3, 1e-2),
    // A catenary of 10 m over 9 m. The bending stiffness bends the rope less within sqrt(EI/T) = 0.045 m: 2e-3.
    ("HangingCable", "middle.position[3]", -1.907, 2e-3),
    // g (m1 - m2)/(m1 + m2 + J/r^2), rigid: the default accuracy of the steps.
    ("Atwood", "motion.distance_acceleration", -9.81 / 5.5, 1e-3),
    // (4 F - m g)/(m + 16 e) t^2/2, once the rope has stretched, by 0.1 mm in a share of the time: 2e-3.
    ("BlockAndTackle", "load.displacement[3]", 61.9 / 18.0 * 0.08, 2e-3),
    // -sqrt(m g/drag), reached to 2 exp(-2 g t/v) = 3.4e-6: the default accuracy of the steps.
    ("FallingBall", "fall.distance_rate", -4.42945, 1e-3),
    // (5 F L^3/(48 EI) - gap)/(L^3/(3 EI) + 1/stiffness) = (0.044643 - 0.01)/(4.7619e-4 + 1e-6) N, for small
    // deflections; squares of slopes of 0.02 leave 1e-3.
    ("TipOnPost", "at_post.force", -72.598, 1e-3),
    // x'' = (6 t - 10)/2 from 5/3 s to 2 s; the 10 micrometers of sticking are 6e-4 of it, and the accuracy 1e-3.
    ("BlockThatHolds", "block_motion.distance", 1.0 / 54.0, 3e-3),
    // A strut of 2e4 N/m that is shortened from 0.45 m to 0.4 m: round-off.
    ("SpringDamperUnit", "in_strut.force", -1000.0, 1e-12),
    // The wanted angle, 0.4 s after its motion ends: 0.9 kg m2 with gains 400 and 30 decay as exp(-16 t), to 2e-3 of a
    // lag of 0.1 rad.
    ("LinkWithController", "motion.angle", 1.2, 1e-3),
    // 100 N e^(0.3 pi): a half turn with eight elements, 5e-3.
    ("RopeOnPost", "pulled.reaction_force[3]", -256.633, 5e-3),
    // A third of the torque. Elements of a fifth of the radius, and a belt that lies 2 micrometers inside: 1e-3.
    ("BeltOnPulleys", "held.effort", -20.0 / 3.0, 1e-3),
    // The elastic catenary that ends on a rigid seabed. The soil gives by 9 mm of 50 m, which raises the force: 2e-3.
    ("MooringLine", "top.reaction_force[1]", 92094.9, 2e-3),
    // density drag diameter velocity^2 L^4/(16 EI), small deflections: squares of slopes of 3e-3, and of the motion.
    ("PileInCurrent", "top.displacement[1]", 0.0450960, 1e-3),
    // The integral of q(z) z^2 (3 L - z)/(6 EI) of the profile; squares of slopes of 0.018, and the kink of the wind at
    // the foot.
    ("MastInWind", "top.displacement[1]", 0.2667525, 1e-3),
    // -A W^2/(w^2 - W^2) (cos(W t) - cos(w t)) with 33/140 of the mast's mass: the accuracy, 1e-3 of a range twice as
    // large.
    ("ShakenMast", "head_motion.displacement[1]", 0.0219337, 2e-3),
    // 4 pi + atan2(cos(0.5) sin(10), cos(10)): the accuracy of the steps, and a twist of 1e-6 rad.
    ("CardanShaft", "turned.angle", 9.942084, 1e-3),
    // m L^2 Omega^2/2, and 1e-4 more because of the elongation: the default accuracy of the steps.
    ("BladeAtSpeed", "root.section_force[1]", 34_560.0, 1e-3),
    // m a + k x + 50 N at an angle of 20 rad, 40 cos(20) N and 15 (1 - cos(20)) N: the accuracy of the steps.
    ("Cam", "on_cam.effort", 60.5111, 1e-3),
    // 0.4 50^2/(2 20): the accuracy of the steps.
    ("Brake", "turn.angle", 25.0, 1e-3),
    // The complex amplitude of both masses at 20 rad/s, after ten time constants: the accuracy, 1e-3 of a range that is
    // four times as large.
    ("TunedMassDamper", "machine_motion.displacement[3]", -7.94767e-3, 4e-3),
];

/// The simulation of a model after its last row, and all that the run is told.
fn ran(text: &str) -> (Simulation, Vec<String>) {
    let mut simulation = Simulation::load("page.toml", text, &[]).unwrap();
    simulation.ask_for_mesh_error(|companion| Box::new(companion));
    let About { start, stop, output_step, .. } = *simulation.about();
    simulation.initialize(start).unwrap();
    for row in 1..=(stop / output_step).round() as u32 {
        simulation.advance(f64::from(row) * output_step).unwrap();
    }
    simulation.conclude();
    let warnings = simulation.take_warnings();
    (simulation, warnings)
}

#[test]
fn models_run_without_a_warning() {
    let pages = pages::pages_in("docs/how-do-i");
    let listings = pages.iter().flat_map(|(_, page)| pages::listings(page, "toml"));
    let mut compared = 0;
    for text in listings.filter(|text| text.starts_with("format = 1")) {
        let (simulation, warnings) = ran(text);
        let name = simulation.about().name.clone();
        assert!(warnings.is_empty(), "{name}: {warnings:#?}");
        for (_, result, stated, tolerance) in STATED.iter().filter(|(own, ..)| *own == name) {
            let found = value(&simulation, result);
            assert!((found - stated).abs() <= tolerance * stated.abs(), "{name}: {result} is {found}, not {stated}");
            compared += 1;
        }
    }
    assert_eq!(compared, STATED.len(), "a model of the list is on no page");
}

/// Each entry of the tables leads to a heading of a page, and each heading is in one of them.
#[test]
fn contents_are_those_of_the_pages() {
    let mut headings = Vec::new();
    for (path, page) in pages::pages_in("docs/how-do-i") {
        let path = path.strip_prefix("docs/").unwrap().to_owned();
        let own = page.lines().filter_map(|line| line.strip_prefix("## "));
        headings.extend(own.map(|heading| format!("{path}#{}", heading.to_lowercase().replace(' ', "-"))));
    }
    let table = INDEX.lines().filter(|line| line.starts_with("| ["));
    let links = table.filter_map(|line| line.split_once("](how-do-i/")?.1.split_once(')'));
    let mut links: Vec<_> = links.map(|(link, _)| format!("how-do-i/{link}")).collect();
    headings.sort();
    links.sort();
    assert_eq!(links, headings);
}
