//! Models that a mesh, a step or a static analysis cannot follow must say so, with the part, a number and a way out: a
//! result that nobody questions, or a message about something else, is worse than none.

use crate::curves::Curves;
use crate::running::{start, try_start, value};
use ancf14::fmi::{Model, Value};
use ancf14::model::simulation::Simulation;

const HEAD: &str = "format = 1\n[model]\nname = \"Limit\"\n";

fn warnings(text: &str, times: &[f64]) -> Vec<String> {
    let mut simulation = start(text);
    for time in times {
        simulation.advance(*time).unwrap_or_else(|failure| panic!("{}", failure.message));
    }
    simulation.take_warnings()
}

/// A mass between two springs under a growing load: the limit load 3.0191 N is reached at t = 0.99. The last increment
/// of 0.05 lands on the other branch.
#[test]
fn regression_a_jump_over_a_limit_point_is_told() {
    let frames = "[frame.left]\nposition = [-1, 0, 0]\n[frame.right]\nposition = [1, 0, 0]\n";
    let springs = "[spring.one]\na = \"left\"\nb = \"b\"\nstiffness = 1000\n[spring.two]\na = \"right\"\nb = \"b\"\nstiffness = 1000\n";
    let text = |load: &str| {
        format!(
            "{HEAD}[body.b]\nmass = 1\nposition = [0, 0, 0.2]\ninertia = [1, 1, 1]\n{frames}{springs}\
             [joint.p]\ntype = \"prismatic\"\na = \"ground\"\nb = \"b\"\naxis = [0, 0, 1]\n\
             [load.weight]\nat = \"b\"\nforce = [0, 0, \"{load}\"]\n\
             [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 0.05\n"
        )
    };
    let times: Vec<f64> = (1..=20).map(|number| 0.05 * f64::from(number)).collect();
    let found = warnings(&text("-3.0494*t"), &times);
    assert!(
        matches!(&found[..], [one] if one.starts_with("the equilibrium jumps to another branch between t = 0.9875 s and 1 s")),
        "{found:?}"
    );
    // Up to 98 % of the limit load the path is smooth, however fast it becomes; a load that pulls has no limit point,
    // also if it comes at once.
    assert_eq!(warnings(&text("-2.96*t"), &times), Vec::<String>::new());
    assert_eq!(warnings(&text("3*t"), &[1.0]), Vec::<String>::new());
    assert_eq!(warnings(&text("30*t"), &times), Vec::<String>::new());
}

/// Beck's column is stable to 20.05 E I/L²; its stiffness has an unstable mode from π² on, which does not decide.
#[test]
fn regression_follower_loads_are_not_called_unstable() {
    let text = format!(
        "{HEAD}[parameters]\nEI = \"2.1e11*0.02*0.005^3/12\"\n[material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\n\
         [section.strip]\nshape = \"rectangle\"\nwidth = 0.02\nheight = 0.005\n\
         [beam.arm]\nmaterial = \"steel\"\nsection = \"strip\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 8\n\
         [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"arm.start\"\n\
         [load.tip]\nat = \"arm.end\"\nforce = [\"-EI*t\", 0, 0]\nfollower = true\n\
         [simulation]\nanalysis = \"static\"\nstop = 12\nstep = 0.5\n"
    );
    let times: Vec<f64> = (1..=24).map(|number| 0.5 * f64::from(number)).collect();
    let found = warnings(&text, &times);
    assert!(
        matches!(&found[..], [one] if one.starts_with("the stiffness gets an unstable mode") && one.contains("does not decide")),
        "{found:?}"
    );
}

/// A damper of 1e6 N s/m stops 1 kg within a microsecond: at the end of a step of 1 ms it is at rest, and the run says
/// that the way is not resolved. Taken in the middle of the step it would turn the velocity round for ever.
#[test]
fn regression_a_stiff_damper_stops_what_it_holds() {
    let text = |damping: &str| {
        format!(
            "{HEAD}[body.b]\nmass = 1\nposition = [0, 0, 0]\ninertia = [1, 1, 1]\nvelocity = [1, 0, 0]\n\
             [joint.rail]\ntype = \"prismatic\"\na = \"ground\"\nb = \"b\"\naxis = [1, 0, 0]\ndamping = {damping}\n\
             [output.P]\nat = \"b\"\nquantities = [\"position\", \"velocity\"]\n[simulation]\nstop = 0.01\nstep = 1e-3\n"
        )
    };
    let mut stiff = start(&text("1e6"));
    let told = stiff.take_warnings();
    assert!(
        matches!(&told[..], [one] if one.starts_with("the damper of rail stops what it holds within 1.0e-6 s")),
        "{told:?}"
    );
    stiff.advance(0.01).unwrap_or_else(|failure| panic!("{}", failure.message));
    // The factor a step is 0 to round-off; the way is at most half of what one step would be without the damper.
    assert!(value(&stiff, "P.velocity[1]").abs() < 1e-12 && value(&stiff, "P.position[1]") < 0.51e-3);
    // Up to `c h/m` = 2 the damper is taken in the middle, with its error of second order: 1/(1 + z/2)·(1 − z/2) for
    // exp(−z).
    let mild = Curves::run(&text("1000"), &[]);
    let velocity = mild.column("P.velocity[1]")[1];
    assert!((velocity - 0.5 / 1.5).abs() < 1e-12, "{velocity}");
    assert_eq!(start(&text("1000")).take_warnings(), Vec::<String>::new());
}

/// A damper beyond `c h/m` = 2 beside a spring leaves the resting place of the spring as it is.
#[test]
fn stiff_dampers_do_not_change_where_springs_rest() {
    let text = format!(
        "{HEAD}gravity = [-9.81, 0, 0]\n[body.b]\nmass = 1\nposition = [0, 0, 0]\ninertia = [1, 1, 1]\n\
         [joint.rail]\ntype = \"prismatic\"\na = \"ground\"\nb = \"b\"\naxis = [1, 0, 0]\nstiffness = 1e3\ndamping = 5e3\n\
         [output.P]\nat = \"b\"\nquantities = [\"position\"]\n[simulation]\nstop = 60\nstep = 1e-2\noutput_step = 60\n"
    );
    // It creeps there with the time constant 5 s: after 60 s 6e-6 of the way is left.
    let place = Curves::run(&text, &[]).last("P.position[1]");
    assert!((place / (-9.81 / 1e3) - 1.0).abs() < 1e-5, "{place}");
}

fn hanging(radius: &str, elements: u32) -> Vec<String> {
    let text = format!(
        "{HEAD}gravity = [0, 0, -9.81]\n[material.nylon]\nyoung = 2e9\npoisson = 0.4\ndensity = 1150\n\
         [section.thread]\nshape = \"circle\"\nradius = {radius}\n\
         [beam.line]\nmaterial = \"nylon\"\nsection = \"thread\"\nfrom = [0, 0, 0]\nto = [0, 0, -20]\nelements = {elements}\n\
         [joint.top]\ntype = \"universal\"\na = \"ground\"\nb = \"line.start\"\naxis = [1, 0, 0]\naxis2 = [0, 1, 0]\n\
         [simulation]\ninitial = \"equilibrium\"\nstop = 1\nstep = 1e-2\n"
    );
    start(&text).modes(10).unwrap_or_else(|failure| panic!("{}", failure.message)).warnings
}

/// The last element of a thin hanging line has a mode of its own, which no line has. The mesh that the warning asks for
/// is free of it.
#[test]
fn regression_modes_of_a_single_element_are_told() {
    for (radius, elements, mode) in [("2e-4", 10, "mode 3"), ("1e-4", 10, "mode 1"), ("2e-4", 20, "mode 7")] {
        let found = hanging(radius, elements);
        let [told] = &found[..] else { panic!("{found:?}") };
        assert!(told.starts_with(mode) && told.contains(&format!("element {} of line", elements - 1)), "{told}");
        let enough =
            told.split("take ").nth(1).and_then(|rest| rest.split(' ').next()).and_then(|count| count.parse().ok());
        assert_eq!(hanging(radius, enough.unwrap()), Vec::<String>::new());
    }
}

fn rod(line: &str, elements: u32, rest: &str) -> String {
    format!(
        "{HEAD}gravity = [0, 0, -9.81]\n[material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\n\
         [section.rod]\nshape = \"circle\"\nradius = 0.005\n\
         [beam.arm]\nmaterial = \"steel\"\nsection = \"rod\"\n{line}\nelements = {elements}\n\
         [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"arm.start\"\n[simulation]\n{rest}stop = 1\nstep = 0.1\n"
    )
}

/// Two points of a drawing that are 10 micrometers apart: the short element is named, not a motion that nothing leaves
/// free.
#[test]
fn regression_a_short_element_is_named() {
    let line = "curve = { points = [[0, 0, 0], [0.5, 0, 0], [0.50001, 0, 0], [1, 0, 0]], polyline = true }";
    let message =
        try_start(&rod(line, 6, "analysis = \"static\"\n")).expect_err("doubles do not hold both stiffnesses");
    assert!(message.contains("element 3 of arm") && message.contains("too short for the others"), "{message}");
}

/// Elements of a thousandth of the section's thickness cost time and gain nothing.
#[test]
fn meshes_finer_than_the_beam_is_thick_are_told() {
    let line = "from = [0, 0, 0]\nto = [0.05, 0, 0]";
    let told = start(&rod(line, 2000, "")).take_warnings();
    assert!(
        matches!(&told[..], [one] if one.starts_with("the 2000 elements of arm are at most 2.5e-5 m long, 1/100")),
        "{told:?}"
    );
    assert_eq!(start(&rod(line, 20, "")).take_warnings(), Vec::<String>::new());
}

/// A drive of 1e9 rad/s in a static analysis is refused at once.
#[test]
fn regression_absurd_drives_are_refused_at_once() {
    let text = format!(
        "{HEAD}[body.b]\nmass = 1\nposition = [0.3, 0, 0]\ninertia = [1, 1, 1]\n\
         [joint.j]\ntype = \"revolute\"\na = \"ground\"\nb = \"b\"\nat = [0, 0, 0]\naxis = [0, 0, 1]\n\
         [drive.m]\njoint = \"j\"\ncoordinate = \"angle\"\nvalue = \"1e9*t\"\n\
         [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 0.1\n"
    );
    let mut simulation = start(&text);
    let failure = simulation.advance(0.1).expect_err("16 million turns");
    assert!(failure.message.contains("drive m turns 1.6e7 times"), "{}", failure.message);
    assert_eq!(value(&simulation, "statistics.iterations"), value(&start(&text), "statistics.iterations"));
}

/// A general section without fourth moments twists like the rectangle with its integrals; given too small, they are
/// guarded.
#[test]
fn regression_general_sections_stiffen_as_they_twist() {
    let text = |section: &str| {
        format!(
            "{HEAD}[material.aluminium]\nyoung = 73e9\npoisson = 0.3\ndensity = 2680\n[section.flat]\n{section}\n\
             [beam.strip]\nmaterial = \"aluminium\"\nsection = \"flat\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 4\n\
             [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"strip.start\"\n\
             [joint.chuck]\ntype = \"cylindrical\"\na = \"ground\"\nb = \"strip.end\"\naxis = [1, 0, 0]\n\
             [drive.motor]\njoint = \"chuck\"\ncoordinate = \"angle\"\nvalue = \"9*t\"\n\
             [output.M]\nat = \"motor\"\nquantities = [\"effort\"]\n[simulation]\nanalysis = \"static\"\nstop = 1\nstep = 0.1\n"
        )
    };
    let integrals = "shape = \"general\"\narea = 1e-3\nsecond_moment_y = 8.333333333333333e-7\nsecond_moment_z = 8.333333333333333e-9\n\
                     torsion_constant = 3.12e-8";
    let torque = |section: &str| Curves::run(&text(section), &[]).last("M.effort");
    let rectangle = torque("shape = \"rectangle\"\nwidth = 0.01\nheight = 0.1\ntorsion_constant = 3.12e-8");
    // The integrals have 16 digits.
    assert!((torque(integrals) / rectangle - 1.0).abs() < 1e-9, "{} {rectangle}", torque(integrals));
    let mut simulation = start(&text(&format!("{integrals}\nfourth_moments = [0, 0, 0]")));
    let failure = simulation.advance(1.0).expect_err("the energy has no lower bound above 8.2 rad/m");
    assert!(failure.message.contains("fourth_moments"), "{}", failure.message);
}

/// A load along a bar at an inner node: 100 N on one side, nothing on the other, also right beside it. At the node the
/// side is a matter of choice, the stress is the larger one.
#[test]
fn regression_axial_forces_beside_a_load_are_right() {
    let text = |place: &str, side: &str| {
        format!(
            "{HEAD}[material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\n[section.rod]\nshape = \"circle\"\nradius = 0.005\n\
             [beam.bar]\nmaterial = \"steel\"\nsection = \"rod\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 8\nstrain = \"small\"\n\
             [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"bar.start\"\n[load.pull]\nat = \"bar@0.5\"\nforce = [100, 0, 0]\n\
             [output.N]\nat = \"{place}\"\n{side}quantities = [\"section_force\", \"axial_strain\", \"stress\"]\n\
             [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 1\n"
        )
    };
    let area = std::f64::consts::PI * 0.005 * 0.005;
    for (place, side, force, stress) in [
        ("bar@0.4", "", 100.0, 100.0),
        ("bar@0.5", "side = \"before\"\n", 100.0, 100.0),
        ("bar@0.5", "", 0.0, 100.0),
        ("bar@0.6", "", 0.0, 0.0),
    ] {
        let mut simulation = start(&text(place, side));
        simulation.advance(1.0).unwrap();
        // Newton's remainder.
        let told = |name: &str, expected: f64, scale: f64| {
            let found = value(&simulation, &format!("N.{name}"));
            assert!((found - expected * scale).abs() < 1e-8 * 100.0 * scale, "{place} {side} {name}: {found}");
        };
        told("section_force[1]", force, 1.0);
        told("axial_strain", force, 1.0 / (2.1e11 * area));
        told("stress", stress, 1.0 / area);
    }
}

/// A damper at the end of a flexible beam, whose end node has next to no inertia, is not stiff: the stiffness of the
/// beam holds that inertia. The integrator keeps its order 2.
#[test]
fn dampers_on_beams_keep_the_order() {
    let text = format!(
        "{HEAD}gravity = [0, 0, -9.81]\n[material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\n\
         [section.rod]\nshape = \"circle\"\nradius = 0.005\n\
         [beam.arm]\nmaterial = \"steel\"\nsection = \"rod\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 12\n\
         [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"arm.start\"\n\
         [joint.dash]\ntype = \"bushing\"\na = \"ground\"\nb = \"arm.end\"\ndamping = [5, 5, 5]\n\
         [output.tip]\nat = \"arm.end\"\nquantities = [\"displacement\"]\n[simulation]\nstop = 0.4\nstep = 1e-3\noutput_step = 0.4\n"
    );
    let at = |step: &str| Curves::run(&text, &[("simulation.step", step)]).last("tip.displacement[3]");
    let [coarse, fine, reference] = ["16e-3", "4e-3", "2.5e-4"].map(at);
    let order = 0.5 * ((coarse - reference) / (fine - reference)).abs().log2();
    // Taken late, the damper would make it 1; the error of order 2 may be small beside those of higher orders.
    assert!(order > 1.8, "{order}: {coarse} {fine} {reference}");
}

/// Coarse increments of a path without a limit point jump over nothing.
#[test]
fn coarse_increments_are_no_jumps() {
    let model = include_str!("../../../models/roll_up.toml").replace("step = 0.05", "step = 1");
    assert!(model.contains("step = 1\n"), "the replacement finds nothing");
    assert_eq!(warnings(&model, &[1.0]), Vec::<String>::new());
}

/// A damper that a host sets while the mechanism runs stops what it holds like one that is drawn.
#[test]
fn dampers_may_be_set_while_it_runs() {
    let text = format!(
        "{HEAD}[body.b]\nmass = 1\nposition = [0, 0, 0]\ninertia = [1, 1, 1]\nvelocity = [1, 0, 0]\n\
         [joint.rail]\ntype = \"prismatic\"\na = \"ground\"\nb = \"b\"\naxis = [1, 0, 0]\ndamping = 0\n\
         [output.P]\nat = \"b\"\nquantities = [\"velocity\"]\n[simulation]\nstop = 1\nstep = 1e-3\n"
    );
    let mut simulation = start(&text);
    let damping = simulation.variables().iter().position(|variable| variable.name == "rail.damping").unwrap();
    simulation.advance(0.01).unwrap_or_else(|failure| panic!("{}", failure.message));
    assert!((value(&simulation, "P.velocity[1]") - 1.0).abs() < 1e-12);
    simulation.set_value(damping, Value::Real(1e6)).unwrap_or_else(|failure| panic!("{}", failure.message));
    simulation.advance(0.011).unwrap_or_else(|failure| panic!("{}", failure.message));
    // The factor of the step is 0 to round-off.
    assert!(value(&simulation, "P.velocity[1]").abs() < 1e-12, "{}", value(&simulation, "P.velocity[1]"));
}

/// A slider on a spring with a pendulum straight below it moves linearly, until a load strikes it from the side:
/// corrections shrink as they never did before, and the pin must hold to round-off all the same.
#[test]
fn regression_a_blow_after_a_linear_motion_keeps_joints_closed() {
    let text = format!(
        "{HEAD}gravity = [0, 0, -9.81]\n[body.car]\nmass = 1\nposition = [0, 0, -1]\ninertia = [0.1, 0.1, 0.1]\n\
         [body.p]\nmass = 1\nposition = [0, 0, -1.5]\ninertia = [0.1, 0.1, 0.1]\n[frame.top]\nposition = [0, 0, 0]\n\
         [spring.coil]\na = \"top\"\nb = \"car\"\nstiffness = 1e3\n[joint.guide]\ntype = \"prismatic\"\na = \"ground\"\nb = \"car\"\naxis = [0, 0, 1]\n\
         [joint.pin]\ntype = \"revolute\"\na = \"car\"\nb = \"p\"\nat = [0, 0, -1]\naxis = [0, 1, 0]\n\
         [load.kick]\nat = \"p\"\nforce = [[{{ until = 0.5, is = 0 }}, {{ until = 0.52, is = 1000 }}, {{ is = 0 }}], 0, 0]\n\
         [simulation]\nstop = 1\nstep = 0.01\n"
    );
    let mut simulation = start(&text);
    let mut largest = 0.0_f64;
    for row in 1..=100 {
        simulation.advance(0.01 * f64::from(row)).unwrap_or_else(|failure| panic!("{}", failure.message));
        largest = largest.max(crate::support::parts::gap(simulation.system(), simulation.state()));
    }
    // Believing the ratio of the linear motion, the iteration left 1.6e-3.
    assert!(largest < 1e-12, "{largest:e}");
}

/// A line without bending stiffness between a ball joint and a guide: pushed by 1e-3 of its length it stands up with
/// `1e-3 EA`, where a real one folds; pulled, it is a line. The chain that hangs and swings pulls all the time.
#[test]
fn limp_lines_that_push_are_told() {
    let section = "[section.line]\nshape = \"rigidities\"\nEA = 1e4\nEI_y = 0\nEI_z = 0\nGJ = 0\nline_density = 1\n";
    let ended = |text: &str, stop: f64| {
        let mut simulation = start(text);
        simulation.advance(stop).unwrap_or_else(|failure| panic!("{}", failure.message));
        simulation.conclude();
        simulation.take_warnings()
    };
    let guided = |way: f64| {
        let text = format!(
            "{HEAD}{section}[beam.tether]\nsection = \"line\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 4\n\
             [joint.root]\ntype = \"spherical\"\na = \"ground\"\nb = \"tether.start\"\n\
             [joint.guide]\ntype = \"prismatic\"\na = \"ground\"\nb = \"tether.end\"\naxis = [1, 0, 0]\n\
             [drive.hand]\njoint = \"guide\"\ncoordinate = \"distance\"\nvalue = \"{way}*smoothstep(0, 1, t)\"\n\
             [simulation]\nstop = 1\nstep = 0.01\n"
        );
        ended(&text, 1.0)
    };
    let pushed = guided(-1e-3);
    assert!(
        matches!(&pushed[..], [one] if one.starts_with("beam tether has no bending stiffness and pushed with 1.0")),
        "{pushed:?}"
    );
    assert_eq!(guided(1e-3), Vec::<String>::new());
    let swinging = format!(
        "{HEAD}gravity = [0, 0, -9.81]\n{section}[beam.chain]\nsection = \"line\"\nfrom = [0, 0, 0]\nto = [0.1, 0, -1]\n\
         elements = 6\n[joint.root]\ntype = \"spherical\"\na = \"ground\"\nb = \"chain.start\"\n\
         [simulation]\nstop = 2\nstep = 2e-3\n"
    );
    let found = ended(&swinging, 2.0);
    assert!(!found.iter().any(|own| own.contains("pushed with")), "{found:?}");
}

/// A load on a straight wire bounces: in the rebound the wire is pushed with 19 kN, and stands up. A wire with the
/// least load from the side buckles by itself, and a blow of 0.1 ms is over before anything buckles.
#[test]
fn straight_wires_that_are_pushed_are_told() {
    let hung = |kick: &str, side: f64| {
        let text = format!(
            "{HEAD}gravity = [0, 0, -9.81]\n[section.wire]\nshape = \"rigidities\"\nEA = 2.4e7\nEI_y = 214\nEI_z = 214\n\
             GJ = 160\nline_density = 0.89\n[beam.wire]\nsection = \"wire\"\nfrom = [0, 0, 0]\nto = [0, 0, -10]\n\
             elements = 8\n[body.load]\nmass = 500\nposition = [0, 0, -10]\ninertia = [50, 50, 50]\n\
             [joint.drum]\ntype = \"universal\"\na = \"ground\"\nb = \"wire.start\"\naxis = [1, 0, 0]\naxis2 = [0, 1, 0]\n\
             [joint.hook]\ntype = \"weld\"\na = \"wire.end\"\nb = \"load\"\n\
             [load.kick]\nat = \"load\"\nforce = [0, 0, \"{kick}\"]\n\
             [load.side]\nat = \"load\"\nforce = [{side}, 0, 0]\n\
             [simulation]\ninitial = \"equilibrium\"\nstop = 0.2\nstep = 1e-3\n"
        );
        let times: Vec<f64> = (1..=200).map(|row| f64::from(row) * 1e-3).collect();
        let found = warnings(&text, &times);
        found.into_iter().filter(|own| own.contains("stays straight")).collect::<Vec<_>>()
    };
    let bounce = "if(t > 0.1 and t < 0.13, 15000, 0)";
    let told = hung(bounce, 0.0);
    assert!(
        matches!(&told[..], [one] if one.starts_with("beam wire stays straight under a compression of 1.")),
        "{told:?}"
    );
    assert_eq!(hung(bounce, 0.1), Vec::<String>::new());
    assert_eq!(hung("if(t > 0.1 and t < 0.1001, 15000, 0)", 0.0), Vec::<String>::new());
}

/// A cantilever buckles under a sixteenth of what clamped ends bear. One that begins late has been pushed no longer for
/// that.
#[test]
fn pushed_cantilevers_are_told() {
    let told = |start: f64, span: f64| {
        let text = format!(
            "{HEAD}[section.strip]\nshape = \"rigidities\"\nEA = 8.4e6\nEI_y = 28\nEI_z = 2.8\nGJ = 5\nline_density = 0.314\n\
             [beam.column]\nsection = \"strip\"\nfrom = [0, 0, 0]\nto = [0, 0, 0.5]\nelements = 4\n\
             [joint.clamp]\ntype = \"weld\"\na = \"ground\"\nb = \"column.start\"\n\
             [load.weight]\nat = \"column.end\"\nforce = [0, 0, -276]\n\
             [simulation]\ninitial = \"equilibrium\"\nstop = 200\nstep = 1e-3\n"
        );
        let mut simulation = Simulation::load("column.toml", &text, &[]).unwrap();
        simulation.initialize(start).unwrap();
        for row in 1..=10 {
            simulation.advance(start + 0.1 * span * f64::from(row)).unwrap();
        }
        let found = simulation.take_warnings();
        found.iter().any(|own| own.contains("stays straight under a compression of 2.76"))
    };
    // The bow grows with 147/s: by e^15, and by e^1.5.
    assert_eq!([told(0.0, 0.1), told(100.0, 0.01)], [true, false]);
}
