//! Loads that move along a beam.

use crate::random::Random;
use crate::running::{run, start, try_start, value, vector};
use crate::support::machines::built;
use crate::support::tangent::forces_under;
use ancf14::mechanics::beam::division::Division;
use ancf14::mechanics::force::track::Track;
use ancf14::mechanics::input::excitation::Excitation;
use ancf14::mechanics::input::signal::Signal;
use ancf14::model::document::Document;
use ancf14::model::notes::notes;
use ancf14::model::simulation::Simulation;
use std::f64::consts::PI;

/// A beam of 20 m with EI = 2e8 N m² and 400 kg/m without its weight, hinged at both ends.
fn girder(elements: usize, rest: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Girder\"\ngravity = [0, 0, 0]\n\
         [section.s]\nshape = \"rigidities\"\nEA = 1e10\nEI_y = 2e8\nEI_z = 2e8\nGJ = 1e8\nline_density = 400\n\
         [beam.girder]\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [20, 0, 0]\nelements = {elements}\n\
         [joint.left]\ntype = \"revolute\"\na = \"ground\"\nb = \"girder.start\"\naxis = [0, 1, 0]\n\
         [joint.right]\ntype = \"inline\"\na = \"ground\"\nb = \"girder.end\"\naxis = [1, 0, 0]\n{rest}"
    )
}

/// The deflection of the middle under a force of 5e4 N that crosses the girder at `speed`: the series of its modes
/// (Frýba, Vibration of Solids and Structures under Moving Loads, chapter 1), and free vibration behind it.
fn deflection(time: f64, speed: f64) -> f64 {
    let (length, mass, crossing) = (20.0, 400.0, 20.0 / speed);
    let sum = (1..200).step_by(2).map(|n| {
        let wave = f64::from(n) * PI / length;
        let (own, forced) = (wave * wave * (2e8_f64 / mass).sqrt(), wave * speed);
        let size = 2.0 * 5e4 / (mass * length) / (own * own - forced * forced);
        let on = |t: f64| size * ((forced * t).sin() - forced / own * (own * t).sin());
        let rate = size * forced * ((forced * crossing).cos() - (own * crossing).cos());
        let behind = time - crossing;
        let q = match behind <= 0.0 {
            true => on(time),
            false => on(crossing) * (own * behind).cos() + rate / own * (own * behind).sin(),
        };
        q * (f64::from(n) * PI / 2.0).sin()
    });
    sum.sum()
}

/// A force that crosses a hinged beam, and the vibration that it leaves: within 1e-3 of the largest deflection. Steps of
/// 1 ms are a sixtieth of the period of the third mode, which has 1/81 of the deflection.
#[test]
fn force_that_crosses_a_beam() {
    let rest = "[load.truck]\non = \"girder\"\nstation = \"t\"\nforce = [0, 0, -5e4]\n\
        [output.middle]\nat = \"girder@0.5\"\nquantities = [\"displacement\"]\n\
        [simulation]\nstep = 1e-3\nstop = 1.5\n";
    let mut own = start(&girder(16, rest));
    let (mut largest, mut worst) = (0.0_f64, 0.0_f64);
    run(&mut own, 0.02, 1.5, |own| {
        let exact = deflection(own.state().time, 20.0);
        largest = largest.max(exact);
        worst = worst.max((-vector(own, "middle.displacement").z - exact).abs());
    });
    assert!(largest > 0.045, "{largest}");
    assert!(worst < 1e-3 * largest, "{:e}", worst / largest);
}

/// Influence lines: the sag at a node is exact for a force anywhere, also inside an element, and the moment of a section
/// is `F b x/L` on one side of the force, `F a (L - x)/L` on the other. With five elements the section at 0.5 and the
/// force at 0.42 to 0.58 are in one element. The force turns the beam by 1e-6: squares are left out.
#[test]
fn influence_lines() {
    let rest = "[load.truck]\non = \"girder\"\nstation = \"0.1 + 0.8*t\"\nforce = [0, 0, -10]\n\
        [output.node]\nat = \"girder.node[2]\"\nquantities = [\"displacement\"]\n\
        [output.section]\nat = \"girder@0.5\"\nquantities = [\"section_moment\", \"section_force\"]\n\
        [simulation]\nanalysis = \"static\"\nstop = 1\n";
    let mut own = start(&girder(5, rest));
    let (length, force) = (20.0, 10.0);
    let mut rows = 0;
    run(&mut own, 0.05, 1.0, |own| {
        let a = length * (0.1 + 0.8 * own.state().time);
        let (x, b) = (8.0, length - a);
        let sag = |x: f64, b: f64| force * b * x * (length * length - b * b - x * x) / (6.0 * 2e8 * length);
        let expected = if x <= a { sag(x, b) } else { sag(length - x, a) };
        let found = -vector(own, "node.displacement").z;
        assert!((found / expected - 1.0).abs() < 1e-6, "a = {a}: {found:e}, {expected:e}");
        let moment = if a >= 10.0 { force * b * 10.0 / length } else { force * a * 10.0 / length };
        let found = vector(own, "section.section_moment").y.abs();
        assert!((found / moment - 1.0).abs() < 1e-6, "a = {a}: moment {found:e}, {moment:e}");
        // The side towards the end is told: at the force itself the reaction of the right support acts there.
        let shear = if a > 10.0 + 1e-9 { force * b / length } else { force * a / length };
        let found = vector(own, "section.section_force").z.abs();
        assert!((found / shear - 1.0).abs() < 1e-6, "a = {a}: shear {found:e}, {shear:e}");
        rows += 1;
    });
    assert!(rows >= 20, "{rows}");
}

/// The sum of the momenta of all nodes, kg m/s.
fn momentum(own: &Simulation) -> f64 {
    own.system().mesh.nodes.iter().map(|node| own.state().momentum[node.coordinates().start]).sum()
}

/// Steps end where a load comes and where it leaves: a free beam has the momentum `F` times the time on it, whatever the
/// steps, also where the load crosses it between two steps. The force is along the beam, which stays straight.
#[test]
fn no_impulse_is_lost_at_the_ends() {
    for (step, crossing) in [(7e-3, 0.5), (0.1, 0.5), (0.03, 1e-3)] {
        let text = girder(
            4,
            &format!(
                "[load.push]\non = \"girder\"\nstation = \"(t - 0.1234)/{crossing}\"\nforce = [400, 0, 0]\n\
                 [simulation]\nstep = {step}\nstop = 1\n"
            ),
        );
        let free: String =
            text.split("[joint.").next().unwrap().to_owned() + "[load." + text.split("[load.").nth(1).unwrap();
        let mut own = start(&free);
        run(&mut own, 1.0, 1.0, |_| {});
        let (found, expected) = (momentum(&own), 400.0 * crossing);
        assert!((found / expected - 1.0).abs() < 1e-9, "step {step}: {found}, {expected}");
    }
}

/// The work of a moving load is the energy of the beam, but for the share of the step: deflections of 1e-3 of the length
/// change the stiffness by their squares.
#[test]
fn work_is_energy() {
    let rest = "[load.truck]\non = \"girder\"\nstation = \"t\"\nforce = [0, 2e4, -5e4]\nmoment = [1e3, 0, 0]\n\
        [simulation]\nstep = 2e-3\nstop = 1.2\ntotals = [\"energy\", \"work\"]\nspectral_radius = 1\n";
    let mut own = start(&girder(6, rest));
    let (mut largest, mut worst) = (0.0_f64, 0.0_f64);
    run(&mut own, 0.05, 1.2, |own| {
        let energy = value(own, "energy.kinetic") + value(own, "energy.elastic");
        largest = largest.max(energy);
        worst = worst.max((energy - value(own, "work.loads")).abs());
    });
    assert!(largest > 100.0 && worst < 1e-6 * largest, "{largest}, {worst:e}");
}

/// The tangent of a moving follower load with a moment is the derivative of its force, in each element that it comes to.
#[test]
fn tangent_follows_the_load() {
    for station in [0.1, 0.45, 1.0] {
        let rest = format!(
            "[load.truck]\non = \"girder\"\nstation = {station}\nforce = [3e6, 2e6, -5e6]\nmoment = [1e6, 2e6, 3e6]\n\
             follower = true\n[simulation]\nanalysis = \"static\"\nstop = 1\n"
        );
        let (system, state) = built(&girder(3, &rest));
        let mut random = Random(5);
        let q: Vec<f64> = state.q.iter().map(|own| own + 1e-2 * random.signed()).collect();
        let direction: Vec<f64> = q.iter().map(|_| random.signed()).collect();
        let mut excitation = Excitation::default();
        system.excite(0.0, &state.targets, &mut excitation);
        let (_, tangent) = forces_under(&system, &state, &q, &excitation);
        let mut product = vec![0.0; q.len()];
        tangent.multiply_add(&direction, &mut product);
        let moved = |by: f64| -> Vec<f64> {
            let q: Vec<f64> = q.iter().zip(&direction).map(|(q, d)| q + by * d).collect();
            forces_under(&system, &state, &q, &excitation).0
        };
        // Central differences: rounding 1e-16/1e-6 of the largest, and 1e-12 of third derivatives.
        let (more, less) = (moved(1e-6), moved(-1e-6));
        let size = product.iter().fold(0.0_f64, |size, own| size.max(own.abs()));
        for (row, own) in product.iter().enumerate() {
            let difference = (more[row] - less[row]) / 2e-6;
            assert!((own - difference).abs() < 1e-7 * size, "{station}, row {row}: {own:e}, {difference:e}");
        }
    }
}

/// A load that stands beyond an end of its beam is refused.
#[test]
fn beyond_an_end() {
    for station in ["1.01", "-0.2"] {
        let rest =
            format!("[load.truck]\non = \"girder\"\nstation = {station}\nforce = [0, 0, 1]\n[simulation]\nstop = 1\n");
        let message = try_start(&girder(2, &rest)).expect_err("a refusal");
        assert!(message.contains("`truck.station` must be from 0 to 1"), "{message}");
    }
}

/// Who writes meters where a fraction belongs is told so; a load that crosses in a part of the run is not.
#[test]
fn stations_in_meters() {
    let notes = |station: &str| {
        let rest = format!(
            "[load.truck]\non = \"girder\"\nstation = \"{station}\"\nforce = [0, 0, 1]\n[simulation]\nstop = 1\n"
        );
        notes(&Document::parse("girder.toml", &girder(2, &rest), &[]).expect("a model")).join("\n")
    };
    assert!(
        notes("20*t").contains("truck.station is between 0 and 1, on the beam, for 5.0 % of the run"),
        "{}",
        notes("20*t")
    );
    assert!(!notes("5*t").contains("truck.station"), "{}", notes("5*t"));
}

/// A station that is no number does not take the load away without a word: the forces are no numbers then.
#[test]
fn station_that_is_no_number() {
    let (station, presence) = (Signal::Constant(f64::NAN), Signal::Constant(-1.0));
    let track = Track { first_element: 0, division: Division::Equal(2), station, presence };
    assert!(track.at(0.0).1);
}
