//! Does a template run as it is, under its own name? A file that is there is kept.

use crate::command_line::{ancf14, text};
use crate::printed;
use std::fs;

/// Every template: written, named after the file, without mistakes, notes or paths of this repository, and its run has
/// no warning.
#[test]
fn templates_run_as_they_are() {
    let directory = tempfile::tempdir().unwrap();
    let listed = printed(&ancf14(directory.path(), &["new", "--list"]));
    let names: Vec<&str> = listed.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert!(names.len() == 9 && names.contains(&"cable"), "{listed}");
    for template in names {
        let name = format!("my_{template}");
        let said = printed(&ancf14(directory.path(), &["new", &name, "--template", template]));
        assert!(said.contains(&format!("ancf14 view {name}.toml")), "{said}");
        let file = fs::read_to_string(directory.path().join(format!("{name}.toml"))).unwrap();
        let title = format!("name = \"My{}{}\"", template[..1].to_uppercase(), &template[1..]);
        assert!(file.contains(&title) && !file.contains("models/") && !file.contains("tests/"), "{file}");
        assert!(file.starts_with("# "), "{file}");
        let checked = ancf14(directory.path(), &["check", &format!("{name}.toml")]);
        assert!(checked.status.success() && checked.stderr.is_empty(), "{template}: {}", text(&checked.stderr));
        // Nor does the run warn, of its steps or its mesh.
        let ran = ancf14(directory.path(), &["run", &format!("{name}.toml")]);
        assert!(ran.status.success() && ran.stderr.is_empty(), "{template}: {}", text(&ran.stderr));
    }
}

#[test]
fn files_are_kept_and_names_are_checked() {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("here.toml"), "mine").unwrap();
    for (arguments, words) in [
        (&["new", "here"][..], "here.toml exists"),
        (&["new", "here.toml"], "here.toml exists"),
        (&["new", "there", "-t", "ship"], "the templates are beam, pendulum"),
        (&["new", "17"], "no name for a model"),
        (&["new"], "required"),
    ] {
        let ran = ancf14(directory.path(), arguments);
        assert!(
            ran.status.code() == Some(2) && text(&ran.stderr).contains(words),
            "{arguments:?}: {}",
            text(&ran.stderr)
        );
    }
    assert_eq!(fs::read_to_string(directory.path().join("here.toml")).unwrap(), "mine");
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
}

/// An input file of MoorDyn: a chain to a buoy, on to the vessel and to a weightless point, a rod on the ground.
const DECK: &str = "--------------------- MoorDyn Input File ----
a line, a buoy, a rod
----------------------- LINE TYPES ------------------------------------------
TypeName   Diam    Mass/m     EA         BA/-zeta    EI         Cd     Ca     CdAx    CaAx
(name)     (m)     (kg/m)     (N)        (N-s/-)     (N-m^2)    (-)    (-)    (-)     (-)
chain      0.252   390        1.674e9    -1.0        0          1.37   1.0    0.64    0.0
unused     0.1     10         1e9        0           0          1      1      0       0
---------------------- ROD TYPES ----------------------
TypeName   Diam    Mass/m    Cd    Ca    CdEnd    CaEnd
(name)     (m)     (kg/m)    (-)   (-)   (-)      (-)
pile       0.5     800       1.0   1.0   0.5      0.5
---------------------- RODS ----------------------
ID   RodType  Attachment  Xa   Ya   Za   Xb   Yb   Zb   NumSegs  Outputs
(#)  (name)   (#/key)     (m)  (m)  (m)  (m)  (m)  (m)  (-)      (-)
1    pile     Fixed       600  0    -50  600  0    -46  4        -
---------------------- POINT PROPERTIES --------------------------------
ID    Type      X       Y       Z       Mass   Volume  CdA    Ca
(#)   (-)       (m)     (m)     (m)     (kg)   (m3)    (m^2)  (-)
1     Free      200     0.0     -20.0   2e4    60.0    4.0    0.5
2     Vessel    0.0     0.0     0.0     0      0       0      0
---------------------- LINES ----------------------------------------
ID   LineType   AttachA  AttachB  UnstrLen  NumSegs  LineOutputs
(#)   (name)     (#)      (#)       (m)       (-)     (-)
1     chain      R1B      1         405       41      -
2     chain      1        2         202       20      p
---------------------- OPTIONS -----------------------------------------
2                    writeLog             Write a log file
1.0e5                kBot                 bottom stiffness (Pa/m)
1.0e4                cBot                 bottom damping (Pa-s/m)
1025.0               WtrDnsty             water density (kg/m^3)
50                   WtrDpth              water depth (m)
3                    WaveKin              waves from a file
0.5                  FrictionCoefficient  general bottom friction coefficient
------------------------- need this line --------------------------------------
";

/// An input file of MoorDyn becomes a model that finds its equilibrium and moves; what it leaves out is told.
#[test]
fn input_files_of_moordyn_are_converted() {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("lines.txt"), DECK).unwrap();
    let said = printed(&ancf14(directory.path(), &["new", "moored", "--from-moordyn", "lines.txt"]));
    assert!(said.contains("moored.toml written from lines.txt") && said.contains("wavekin = 3"), "{said}");
    assert!(said.contains("Rods are elastic beams"), "{said}");
    let file = fs::read_to_string(directory.path().join("moored.toml")).unwrap();
    for words in [
        "name = \"Moored\"",
        "# Made from lines.txt",
        "friction = 0.5",
        "contact = \"axis\"",
        "EA = 1.674e9",
        "drag_area = \"circumference\"",
        "lay = { length = 405 }",
        "a = \"rod1.end\"",
        "a = \"vessel\"",
        "volume = 60",
        "added_mass = [30750, 30750, 30750]",
    ] {
        assert!(file.contains(words), "{words}: {file}");
    }
    assert!(!file.contains("unused"), "{file}");
    let ran = ancf14(directory.path(), &["run", "moored.toml", "--no-mesh-error", "--set", "simulation.stop=1"]);
    assert!(ran.status.success(), "{}", text(&ran.stderr));
    // Nothing is overwritten, and what is wrong is told with its line.
    for (deck, words) in [
        ("format = 1", "no section LINES"),
        (&DECK.replace("R1B ", "R2B "), "line 24: there is no point and no rod R2B"),
        (&DECK.replace("chain      1   ", "wire       1   "), "line 25: there is no line type"),
        (&DECK.replace("-20.0   2e4", "-20.0   two"), "line 19: `mass` is"),
    ] {
        fs::write(directory.path().join("bad.txt"), deck).unwrap();
        let ran = ancf14(directory.path(), &["new", "other", "--from-moordyn", "bad.txt"]);
        assert!(ran.status.code() == Some(2) && text(&ran.stderr).contains(words), "{words}: {}", text(&ran.stderr));
        assert!(!directory.path().join("other.toml").exists());
    }
    let ran = ancf14(directory.path(), &["new", "moored", "--from-moordyn", "lines.txt"]);
    assert!(text(&ran.stderr).contains("moored.toml exists"), "{}", text(&ran.stderr));
}
