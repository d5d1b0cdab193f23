//! Does a model that is legal but hardly ever meant so get a note, and a sound one none? A wrong code is silent about a
//! part that falls away, or cries wolf.

use ancf14::model::document::Document;
use ancf14::model::notes::notes;

const BEAMS: &str = r#"format = 1
model.name = "Notes"
[material.steel]
young = 2.1e11
poisson = 0.3
density = 7850
[section.strip]
shape = "circle"
radius = 0.01
[beam.left]
material = "steel"
section = "strip"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 2
[beam.right]
material = "steel"
section = "strip"
from = [1, 0, 0]
to = [2, 0, 0]
elements = 2
[body.bob]
mass = 1
position = [3, 0, 0]
inertia = [1, 1, 1]
[simulation]
stop = 1
step = 0.1
"#;
const ROOT: &str = "[joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"left.start\"\n";
const MIDDLE: &str = "[joint.middle]\ntype = \"weld\"\na = \"left.end\"\nb = \"right.start\"\n";
const HINGE: &str = "[joint.middle]\ntype = \"spherical\"\na = \"left.end\"\nb = \"right.start\"\n";
const ROPE: &str = "[spring.rope]\na = \"right.end\"\nb = \"bob\"\nstiffness = 1\n";
const HAND: &str =
    "[frame.hand]\nposition = [0, 0, 0]\n[joint.grip]\ntype = \"weld\"\na = \"hand\"\nb = \"left.start\"\n";

fn of(text: &str) -> Vec<String> {
    notes(&Document::parse("m.toml", text, &[]).unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

/// Joints, springs and frames hold, the ground at the end of the chain; what is left loose is named.
#[test]
fn regression_loose_parts_are_named() {
    let all = "m.toml, line 10: nothing holds the mechanism: no joint or spring connects it to the ground or to a frame, and it moves \
               freely. If it should be held, add a joint with a = \"ground\"";
    for (parts, expected) in [
        (vec![ROOT, MIDDLE, ROPE], None),
        (vec![HAND, MIDDLE, ROPE], None),
        (
            vec![ROOT, MIDDLE],
            Some(
                "m.toml, line 22: body bob is connected to nothing: it moves freely. Connect it by a joint or a spring",
            ),
        ),
        (
            vec![ROOT, ROPE],
            Some(
                "m.toml, line 16: no joint or spring connects beam right and body bob to the ground or to a frame: they move freely. Add a joint or a \
                 spring",
            ),
        ),
        (vec![MIDDLE, ROPE], Some(all)),
        (vec![], Some(all)),
    ] {
        let found = of(&format!("{BEAMS}{}", parts.concat()));
        assert_eq!(found.iter().map(String::as_str).collect::<Vec<_>>(), Vec::from_iter(expected), "{parts:?}");
    }
}

/// Water carries beams, and bodies with a volume.
#[test]
fn what_floats_is_not_loose() {
    let buoy = |volume: &str| {
        format!(
            "format = 1\n[model]\nname = \"Buoy\"\n[water]\ndensity = 1025\ndepth = 40\n\
             [body.buoy]\nmass = 2000\nposition = [0, 0, 0]\ninertia = [800, 800, 800]\n{volume}\
             [simulation]\nstop = 20\n"
        )
    };
    assert_eq!(of(&buoy("volume = 4.2\n")), [] as [String; 0]);
    assert!(of(&buoy(""))[0].contains("nothing holds the mechanism"));
}

/// Moduli in MPa and GPa and densities in g/cm³, kg/mm³ or t/mm³ are told with the number to write, those of rubber are not;
/// statics do not ask for the density.
#[test]
fn regression_materials_in_other_units_are_told() {
    let held = format!("{BEAMS}{ROOT}{MIDDLE}{ROPE}");
    for (from, to, expected) in [
        (
            "young = 2.1e11",
            "young = 210000",
            "m.toml, line 4: steel.young = 210000 Pa is unusually soft. If this is in MPa, write 2.1e11",
        ),
        (
            "young = 2.1e11",
            "young = 70",
            "m.toml, line 4: steel.young = 70 Pa is unusually soft. If this is in GPa, write 7e10",
        ),
        (
            "young = 2.1e11",
            "young = 5e6",
            "m.toml, line 4: steel.young = 5000000 Pa is unusually soft. Rubber has poisson = 0.49",
        ),
        (
            "density = 7850",
            "density = 7.85",
            "m.toml, line 6: steel.density = 7.85 kg/m3 is unusually light. If this is in g/cm3, write 7850",
        ),
        (
            "density = 7850",
            "density = 7.85e-9",
            "m.toml, line 6: steel.density = 7.85e-9 kg/m3 is unusually light. If this is in t/mm3, write 7850",
        ),
        (
            "density = 7850",
            "density = 7.85e-6",
            "m.toml, line 6: steel.density = 7.85e-6 kg/m3 is unusually light. If this is in kg/mm3, write 7850",
        ),
        (
            "density = 7850",
            "density = 49",
            "m.toml, line 6: steel.density = 49 kg/m3 is unusually light. The unit is kg/m3",
        ),
    ] {
        assert_eq!(of(&held.replace(from, to)), [expected]);
    }
    let set = [("steel.density".to_owned(), "7.85".to_owned())];
    let found = notes(&Document::parse("m.toml", &held, &set).unwrap());
    assert!(found.len() == 1 && found[0].starts_with("steel.density=7.85: steel.density"), "{found:?}");
    for sound in [
        held.clone(),
        held.replace("young = 2.1e11", "young = 1e7"),
        held.replace("young = 2.1e11\npoisson = 0.3", "young = 1e6\npoisson = 0.49"),
        held.replace("young = 2.1e11\npoisson = 0.3", "young = 1e6\nshear = 3.4e5"),
        held.replace("density = 7850", "density = 50"),
        // Stiffness alone.
        held.replace("density = 7850", "density = 1e-3"),
        held.replace("density = 7850", "density = 1").replace("step = 0.1", "step = 0.1\nanalysis = \"static\""),
    ] {
        assert_eq!(of(&sound), Vec::<String>::new());
    }
}

/// The models and templates that come along are sound.
#[test]
fn models_have_no_notes() {
    let mut count = 0;
    for folder in ["models", "crates/cli/templates"] {
        for entry in std::fs::read_dir(format!("{}/{folder}", env!("CARGO_MANIFEST_DIR"))).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|extension| extension == "toml") {
                let found = of(&std::fs::read_to_string(&path).unwrap());
                assert!(found.is_empty(), "{}: {found:?}", path.display());
                count += 1;
            }
        }
    }
    assert!(count > 15, "{count} models were looked at");
}

/// The model with a driven hinge, whose beams have a velocity: the start of the drive is no blow.
fn driven(motion: &str) -> String {
    let hinge = "[joint.root]\ntype = \"revolute\"\na = \"ground\"\nb = \"left.start\"\naxis = [0, 0, 1]\n\
                 [drive.crank]\njoint = \"root\"\ncoordinate = \"angle\"\n";
    let beams = BEAMS.replace("elements = 2", "elements = 2\nangular_velocity = [0, 0, 1]");
    format!("{beams}{hinge}{motion}\n{MIDDLE}{ROPE}")
}

/// A drive that comes to rest at 90 or that ends there in statics means degrees, and so does one that gets there at 90
/// a second; a shaft that turns on, and any other angle, does not. Rates are integrated.
#[test]
fn angles_in_degrees_are_told() {
    let still = "value = [{ until = 0.5, is = \"180*t\" }, { is = 90 }]";
    let are = "Angles are in radians: 90 degrees are \"90*pi/180\"";
    for (text, expected) in [
        (driven(still), "crank.value reaches 90 rad, 14.3 turns."),
        (driven("value = \"45*(1 - cos(pi*t))\""), "crank.value reaches 90 rad, 14.3 turns."),
        (
            driven("value = \"-90*t\"").replace("step = 0.1", "analysis = \"static\""),
            "crank.value reaches 90 rad, 14.3 turns.",
        ),
        (driven("value = \"90*t\""), "crank.value reaches 90 rad, 14.3 turns."),
        (driven("rate = \"45*pi*sin(pi*t)\""), "crank.rate turns by 90 rad, 14.3 turns."),
        (driven("rate = [{ until = 0.5, is = 180 }, { is = 0 }]"), "crank.rate turns by 90 rad, 14.3 turns."),
        (driven("rate = -90"), "crank.rate is 90 rad/s, 14.3 turns until the end."),
    ] {
        assert_eq!(of(&text), [format!("m.toml, line 39: {expected} {are}")]);
    }
    for sound in [
        driven("value = \"91*t\""),
        driven("rate = 30"),
        driven("rate = 90").replace("stop = 1", "stop = 1.1"),
        driven("value = \"31*t\"").replace("step = 0.1", "analysis = \"static\""),
        driven("value = \"0.25*pi*(1 - cos(pi*t))\""),
        driven("value = [{ until = 0.5, is = \"20*pi*t\" }, { is = \"10*pi\" }]"),
    ] {
        assert_eq!(of(&sound), Vec::<String>::new());
    }
}

/// The same of frames that turn, of stops, of springs on an angle and of pretwists; not of distances.
#[test]
fn other_angles_in_degrees_are_told() {
    let hinge = ROOT.replace("weld", "revolute") + "axis = [0, 0, 1]\n";
    let stop = "[stop.end]\njoint = \"root\"\ncoordinate = \"angle\"\nstiffness = 1\n";
    let spring = "[spring.back]\njoint = \"root\"\ncoordinate = \"angle\"\nstiffness = 1\n";
    let held = |parts: &str| format!("{BEAMS}{parts}{MIDDLE}{ROPE}");
    let twisted = |angle: &str| held(ROOT).replacen("elements = 2", &format!("elements = 100\npretwist = {angle}"), 1);
    for (text, name) in [
        (
            held(&HAND.replace(
                "position = [0, 0, 0]\n",
                "position = [0, 0, 0]\nrotation = [0, 0, \"45*(1 - cos(pi*t))\"]\n",
            )),
            "hand.rotation[3]",
        ),
        (held(&format!("{hinge}{stop}upper = 90\n")), "end.upper"),
        (held(&format!("{hinge}{stop}lower = -90\n")), "end.lower"),
        (held(&format!("{hinge}{spring}rest = 90\n")), "back.rest"),
        (twisted("90"), "left.pretwist"),
    ] {
        let found = of(&text);
        assert!(
            found.len() == 1 && found[0].contains(name) && found[0].contains("90 degrees are"),
            "{name}: {found:?}"
        );
    }
    let slide = ROOT.replace("weld", "prismatic") + "axis = [1, 0, 0]\n";
    for sound in [
        held(&format!("{hinge}{stop}upper = 1.5\n")),
        held(&format!("{slide}{stop}upper = 90\n").replace("\"angle\"", "\"distance\"")),
        twisted("89"),
    ] {
        assert_eq!(of(&sound), Vec::<String>::new());
    }
}

/// A drive that sets off at once strikes a mechanism at rest; one that begins slowly does not, nor one whose mechanism
/// moves along.
#[test]
fn jumps_of_velocity_are_told() {
    let at_rest = |motion: &str| driven(motion).replace("angular_velocity = [0, 0, 1]\n", "");
    for (motion, key) in [("value = \"3*t\"", "value"), ("rate = \"3 + t\"", "rate")] {
        let found = of(&at_rest(motion));
        let expected =
            format!("m.toml, line 37: crank.{key} begins with a jump of velocity: drive crank starts at 3 rad/s");
        assert!(found.len() == 1 && found[0].starts_with(&expected), "{found:?}");
    }
    for sound in [
        at_rest("value = \"3*t^2\""),
        at_rest("rate = 0.1"),
        driven("rate = 3"),
        at_rest("value = \"3*t\"").replace("step = 0.1", "analysis = \"static\""),
    ] {
        assert_eq!(of(&sound), Vec::<String>::new());
    }
}

/// A beam that is short for its section is told, pieces of a long one and ANCF24 are not.
#[test]
fn stubby_beams_are_told() {
    let held = format!("{BEAMS}{ROOT}{MIDDLE}{ROPE}").replace("radius = 0.01", "radius = 0.201");
    let found = of(&held);
    assert!(
        found.len() == 1
            && found[0].starts_with("m.toml, line 10: beam left is 4.98 times as long as its section is large")
            && found[0].contains("The same holds for right."),
        "{found:?}"
    );
    for sound in [
        held.replace("radius = 0.201", "radius = 0.199"),
        // A leaf spring is stubby in its plane, in which it does not give way.
        held.replace("shape = \"circle\"\nradius = 0.201", "shape = \"rectangle\"\nwidth = 0.5\nheight = 0.01"),
        // A crank between slender beams.
        held.replace("from = [1, 0, 0]\nto = [2, 0, 0]", "from = [1, 0, 0]\nto = [20, 0, 0]").replace(MIDDLE, HINGE),
        held.replace("elements = 2", "elements = 2\nelement = \"ancf24\""),
    ] {
        assert_eq!(of(&sound), Vec::<String>::new());
    }
}

/// A load that has no bound is told with its time; narrow pulses and steep steps are bounded.
#[test]
fn poles_are_told() {
    let loaded =
        |load: &str| format!("{BEAMS}{ROOT}{MIDDLE}{ROPE}[load.push]\nat = \"left.end\"\nforce = [0, 0, \"{load}\"]\n");
    for pole in ["1/(t - 0.4321)", "tan(3.635245*t)", "1/(t - 0.4321)^2"] {
        let found = of(&loaded(pole));
        assert!(
            found.len() == 1 && found[0].contains("push.force[3] grows without bound near t = 0.4321 s"),
            "{pole}: {found:?}"
        );
    }
    for sound in ["exp(-((t - 0.4321)/1e-5)^2)", "tanh(1e9*(t - 0.4321))", "1/(1e-9 + (t - 0.4321)^2)", "5"] {
        assert_eq!(of(&loaded(sound)), Vec::<String>::new());
    }
}

/// Copies of one line have one note.
#[test]
fn copies_are_told_once() {
    let copies = "[copy.row]\ncount = 3\nmove = [0, \"k\", 0]\n[copy.row.beam.piece]\nmaterial = \"steel\"\nsection = \"strip\"\n\
                  from = [0, 0, 0]\nto = [1, 0, 0]\nelements = 100\npretwist = 90\n\
                  [copy.row.joint.hold]\ntype = \"weld\"\na = \"ground\"\nb = \"piece.start\"\n";
    let found = of(&format!("{BEAMS}{ROOT}{MIDDLE}{ROPE}{copies}"));
    assert!(found.len() == 1 && found[0].contains("piece_1.pretwist = 90 rad"), "{found:?}");
}

/// A step that is longer than a tenth of the motion is told, a tenth and an increment of statics are not.
#[test]
fn long_steps_are_told() {
    let held = format!("{BEAMS}{ROOT}{MIDDLE}{ROPE}");
    let found = of(&held.replace("step = 0.1", "step = 0.11"));
    assert!(found.len() == 1 && found[0].contains("simulation.step = 0.11 s is longer than a tenth"), "{found:?}");
    assert_eq!(of(&held), Vec::<String>::new());
    assert_eq!(of(&held.replace("step = 0.1", "step = 1\nanalysis = \"static\"")), Vec::<String>::new());
}
