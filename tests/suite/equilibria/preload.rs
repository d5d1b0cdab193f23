//! A motion that begins at the end of a path of equilibria: history counts, what holds the mechanism until the start
//! lets go there, and what a host drives has arrived.

use crate::curves::{Curves, load};
use crate::running::{start, value};
use ancf14::fmi::{Model, Value};

/// A block on a rail, with a spring of 400 N/m to the place where it is drawn.
fn block(more: &str, simulation: &str) -> String {
    format!(
        r#"format = 1
[model]
name = "Block"
[body.block]
mass = 4
position = [0, 0, 0]
inertia = [1, 1, 1]
[joint.rail]
type = "prismatic"
a = "ground"
b = "block"
axis = [1, 0, 0]
[spring.tie]
joint = "rail"
coordinate = "distance"
stiffness = 400
{more}
[output.B]
at = "rail"
quantities = ["distance", "distance_rate", "distance_acceleration"]
[simulation]
initial = "equilibrium"
stop = 0.6
output_step = 0.01
totals = ["energy", "work"]
{simulation}
"#
    )
}

/// A hand draws the block and lets go at the start: it swings as `x₀ cos ωt` from its first instant on, `ω = 10 rad/s`.
/// The error of the time steps is asked to be 1e-6 of the range; the account of energy begins there, and is complete.
#[test]
fn what_is_let_go_at_the_start_swings_from_there() {
    let hand =
        "[drive.hand]\njoint = \"rail\"\ncoordinate = \"distance\"\nvalue = \"0.3*min(t + 2, 1)\"\nactive = \"t < 0\"";
    let curves = Curves::run(&block(hand, "preload = 2\naccuracy = 1e-6"), &[]);
    let [way, acceleration] = ["B.distance", "B.distance_acceleration"].map(|name| curves.column(name));
    let [drives, drift, total] = ["work.drives", "work.drift", "energy.total"].map(|name| curves.column(name));
    assert!((way[0] - 0.3).abs() < 1e-12, "{}", way[0]);
    assert!((acceleration[0] + 30.0).abs() < 1e-9, "{}", acceleration[0]);
    for (row, time) in curves.time.iter().enumerate() {
        let wanted = 0.3 * (10.0 * time).cos();
        assert!((way[row] - wanted).abs() < 1e-5 * 0.6, "{time} s: {} {wanted}", way[row]);
        let given = total[row] - drift[row];
        assert!((given - 18.0).abs() < 1e-10 && drives[row] == 0.0, "{time} s: {given} {}", drives[row]);
    }
}

/// Two springs of 1 m to points 0.8 m away hold a block 0.6 m above them or 0.6 m below, and nowhere between: where a
/// hand has pushed it, it stays, also when the hand has let go on the way.
#[test]
fn a_truss_stays_where_the_path_has_snapped_it() {
    let truss = |push: f64| {
        format!(
            r#"format = 1
[model]
name = "Truss"
gravity = [0, 0, 0]
[body.block]
mass = 1
position = [0, 0, 0.6]
inertia = [1, 1, 1]
[joint.guide]
type = "prismatic"
a = "ground"
b = "block"
axis = [0, 0, 1]
[point.left]
on = "ground"
offset = [-0.8, 0, 0]
[point.right]
on = "ground"
offset = [0.8, 0, 0]
[spring.one]
a = "left"
b = "block"
stiffness = 1e3
[spring.two]
a = "right"
b = "block"
stiffness = 1e3
[drive.hand]
joint = "guide"
coordinate = "distance"
value = "{push}*min(t + 1, 0.5)/0.5"
active = "t < -0.25"
[output.B]
at = "block"
quantities = ["position"]
[simulation]
initial = "equilibrium"
preload = 1
stop = 0.01
"#
        )
    };
    for (push, wanted) in [(-0.1, 0.6), (-1.1, -0.6)] {
        let height = value(&start(&truss(push)), "B.position[3]");
        assert!((height - wanted).abs() < 1e-9, "{push}: {height}");
    }
}

/// A lock that engages on the way holds the block where it stands then, and its effort is the rest of the load: in
/// motion as on the path.
#[test]
fn a_lock_holds_where_the_path_was_when_it_engaged() {
    let more = "[load.push]\nat = \"block\"\nforce = [\"120*min(t + 1, 1)\", 0, 0]\n\
                [lock.brake]\njoint = \"rail\"\ncoordinate = \"distance\"\nactive = \"t >= -0.5\"\n\
                [output.L]\nat = \"brake\"\nquantities = [\"effort\"]";
    let curves = Curves::run(&block(more, "preload = 1"), &[]);
    let (way, effort) = (curves.column("B.distance"), curves.column("L.effort"));
    for (way, effort) in way.iter().zip(effort) {
        // At t = -0.5 s: 60 N over 400 N/m; the equilibria are 0.02 s apart, and one of them is there.
        assert!((way - 0.15).abs() < 1e-9, "{way}");
        assert!((effort + 60.0).abs() < 1e-8, "{effort}");
    }
}

/// What a host drives goes to where the host wants it at the start, and stands there: the next communication step
/// begins at rest.
#[test]
fn what_a_host_drives_has_arrived_at_the_start() {
    for simulation in ["preload = 1", "preload = 1\nstep = 1e-3"] {
        let hand = "[drive.hand]\njoint = \"rail\"\ncoordinate = \"distance\"\ninput = \"value\"\n\
                    [output.E]\nat = \"hand\"\nquantities = [\"effort\"]";
        let mut model = load(&block(hand, simulation), &[]);
        let number = |model: &ancf14::model::simulation::Simulation, name: &str| {
            model.variables().iter().position(|variable| variable.name == name).unwrap()
        };
        let place = number(&model, "hand.value");
        model.set_value(place, Value::Real(0.25)).unwrap();
        model.initialize(5.0).unwrap();
        assert!((value(&model, "B.distance") - 0.25).abs() < 1e-12 && model.time() == 5.0);
        model.advance(5.1).unwrap();
        for (name, wanted) in [("B.distance", 0.25), ("B.distance_rate", 0.0), ("B.distance_acceleration", 0.0)] {
            assert!((value(&model, name) - wanted).abs() < 1e-9, "{name}: {}", value(&model, name));
        }
        // The state that is saved belongs to the same drawing.
        let bytes = Model::write(&model, &model.snapshot(), Vec::new());
        let saved = model.read(&bytes).unwrap();
        model.advance(5.2).unwrap();
        let once = value(&model, "E.effort");
        model.restore(&saved);
        model.advance(5.2).unwrap();
        assert_eq!(value(&model, "E.effort").to_bits(), once.to_bits());
    }
}

/// A drive by a rate has gone its way when the motion begins, and goes on from there; one whose rate the host gives has
/// stood still.
#[test]
fn drives_by_a_rate_go_on_from_where_the_path_ends() {
    let driven = |rate: &str| {
        let winch = format!("[drive.winch]\njoint = \"rail\"\ncoordinate = \"distance\"\n{rate}");
        load(&block(&winch, "preload = 2"), &[])
    };
    let mut by_function = driven("rate = \"0.1\"");
    let mut by_host = driven("input = \"rate\"");
    let rate = by_host.variables().iter().position(|variable| variable.name == "winch.rate").unwrap();
    by_host.set_value(rate, Value::Real(0.1)).unwrap();
    for (model, begin) in [(&mut by_function, 0.2), (&mut by_host, 0.0)] {
        model.initialize(0.0).unwrap();
        for time in [0.0, 0.3] {
            model.advance(time).unwrap();
            let (way, wanted) = (value(model, "B.distance"), begin + 0.1 * time);
            assert!((way - wanted).abs() < 1e-9, "{time} s: {way} {wanted}");
        }
    }
}

/// A frame that moves is drawn where it is when the path begins, and has carried its body along when the motion begins;
/// a state that is read back belongs to the same drawing.
#[test]
fn frames_are_drawn_where_the_path_begins() {
    let carried = r#"format = 1
[model]
name = "Carried"
[frame.hand]
position = ["0.4 + 0.1*min(t + 1, 1)", 0, 0]
rotation = [0, 0, "0.5*min(t + 1, 1)"]
[body.bob]
mass = 1
position = [0.4, 0.3, 0]
inertia = [0.1, 0.1, 0.1]
[joint.grip]
type = "weld"
a = "hand"
b = "bob"
[output.B]
at = "bob"
quantities = ["position", "velocity"]
[simulation]
initial = "equilibrium"
preload = 1
stop = 1
"#;
    let mut model = start(carried);
    let held = |model: &ancf14::model::simulation::Simulation| {
        let place = [1, 2].map(|i| value(model, &format!("B.position[{i}]")));
        let wanted = [0.5 - 0.3 * 0.5_f64.sin(), 0.3 * 0.5_f64.cos()];
        assert!(place.iter().zip(wanted).all(|(place, wanted)| (place - wanted).abs() < 1e-9), "{place:?} {wanted:?}");
    };
    held(&model);
    let bytes = Model::write(&model, &model.snapshot(), Vec::new());
    let mut other = load(carried, &[]);
    let saved = other.read(&bytes).unwrap();
    other.restore(&saved);
    model.advance(0.2).unwrap();
    other.advance(0.2).unwrap();
    held(&other);
    assert_eq!(value(&other, "B.position[1]").to_bits(), value(&model, "B.position[1]").to_bits());
}

/// A drawn bow gives all it holds to the arrow where limbs and string weigh next to nothing: `v = √(2 W/m)`, but for
/// what stays in the braced bow.
#[test]
fn a_light_bow_gives_its_energy_to_the_arrow() {
    const BOW: &str = include_str!("../../../models/bow.toml");
    let light = [("laminate.density", "40"), ("nock.mass", "2e-4"), ("laminate.damping", "0")];
    let shot = Curves::run(BOW, &light);
    let braced = Curves::run(BOW, &[("pull", "0"), ("simulation.stop", "1e-4")]);
    let (elastic, speed) = (shot.column("energy.elastic"), shot.column("flight.distance_rate"));
    let stored = elastic[0] - braced.column("energy.elastic")[0];
    let flying = 0.5 * 0.025 * speed[speed.len() - 1].powi(2);
    println!("stored {stored} J, flying {flying} J");
    assert!(flying < stored && flying > 0.95 * stored, "{flying} of {stored} J");
}
