//! What does a user read who made a mistake? Every file in `tests/errors` has one kind of mistake; beside it stands the
//! message that must come, to the letter: position, underlining, what was expected, the nearest name. A wrong code
//! gives a different text, or takes the file.
//!
//! `ANCF14_BLESS=1 cargo test` writes the messages anew; read the difference before it is committed.

use crate::language::model_parts::EVERYTHING;
use ancf14::model::document::Document;
use ancf14::model::drawing::Drawing;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::fs;
use std::path::Path;

fn directory() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/errors")
}

#[test]
fn messages_are_as_agreed() {
    let mut files: Vec<_> =
        fs::read_dir(directory()).expect("tests/errors").map(|entry| entry.expect("entry").path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    assert!(files.len() >= 25, "only {} mistakes are looked at", files.len());
    let mut different = Vec::new();
    for path in files {
        let name = path.file_name().expect("a file").to_string_lossy().into_owned();
        let text = fs::read_to_string(&path).expect("text");
        let message = match Document::parse(&name, &text, &[]) {
            Ok(_) => panic!("{name} was taken, but it has a mistake"),
            Err(diagnostics) => format!("{diagnostics}\n"),
        };
        let golden = path.with_extension("txt");
        if std::env::var_os("ANCF14_BLESS").is_some() {
            fs::write(&golden, &message).expect("write");
        }
        if fs::read_to_string(&golden).unwrap_or_default() != message {
            different.push(format!("--- {name}\n{message}"));
        }
    }
    assert!(different.is_empty(), "messages differ from the golden ones:\n{}", different.join("\n"));
}

/// Mistakes in overrides: key and value, and what the message must contain.
#[test]
fn overrides_are_named_in_their_messages() {
    let text = include_str!("../../../models/princeton_beam.toml");
    for (key, value, expected) in [
        ("alumnium.young", "1e9", "did you mean `aluminium`?"),
        ("aluminium.yuong", "1e9", "did you mean `young`?"),
        ("aluminium.young", "-1", "`aluminium.young` must be greater than 0"),
        ("aluminium.young", "2*Q", "unknown name `Q`"),
        ("angle_dg", "3", "did you mean `angle_deg`?"),
        ("stop", "2", "did you mean `simulation.stop`?"),
        ("gravity[4]", "3", "`gravity[4]` has no such component"),
        ("aluminium.young[1]", "3", "`young` is not a list"),
        ("arm.from[1]", "true", "`arm.from[1]` is true"),
        ("arm.strain", "tiny", "unknown strain \"tiny\""),
        ("arm.elements", "2.5", "`arm.elements` must be a whole number"),
        ("arm.curve", "{ points = [[0, 0, 0], [1, 0, 0]] }", "`curve` and what is in it cannot be set"),
        ("arm.curve.s[2]", "1", "`curve` and what is in it cannot be set"),
        ("simulation.stpo", "3", "did you mean `stop`?"),
        ("gravity", "[0, 0]", "`gravity` is a list of 2"),
        ("P", "1e3", "`P` must be at least 0 and at most 20"),
        ("P", "angle_deg", "this gives 45 N"),
    ] {
        let overrides = [(key.to_owned(), value.to_owned())];
        let message = Document::parse("m.toml", text, &overrides).expect_err(key).to_string();
        assert!(message.contains(expected), "{key}={value}: {message}");
        // The words are right for every caller: the command line, a program, a host.
        assert!(message.contains("--> in the changes to the model file"), "{key}={value}: {message}");
        assert!(
            message.contains(&format!("| {key}={value}")) && !message.contains("--set"),
            "{key}={value}: {message}"
        );
    }
}

/// The same key twice is one too many, as in the file.
#[test]
fn an_override_is_given_once() {
    let pair = |value: &str| ("P".to_owned(), value.to_owned());
    let text = include_str!("../../../models/princeton_beam.toml");
    let message = Document::parse("m.toml", text, &[pair("1"), pair("2")]).expect_err("twice").to_string();
    assert!(message.contains("`P` is set twice"), "{message}");
    // A component and its list overlap too, and an index is written in one way only.
    let text = include_str!("../../../models/cantilever.toml");
    for (keys, expected) in [
        (["gravity[3]", "gravity"], "`gravity` is set twice"),
        (["gravity[3]", "gravity[3]"], "`gravity[3]` is set twice"),
        (["gravity[1]", "gravity[03]"], "`gravity[03]` has no such component"),
        (["gravity[1]", "gravity[+3]"], "`gravity[+3]` has no such component"),
    ] {
        let value = |key: &str| if key == "gravity" { "[0, 0, 1]" } else { "1" };
        let overrides = keys.map(|key| (key.to_owned(), value(key).to_owned()));
        let message = Document::parse("m.toml", text, &overrides).expect_err("twice").to_string();
        assert!(message.contains(expected), "{message}");
    }
    let apart = ["gravity[1]", "gravity[3]"].map(|key| (key.to_owned(), "1".to_owned()));
    assert!(Document::parse("m.toml", text, &apart).is_ok());
}

fn mutated(text: &str, changes: &[(u8, usize, usize)]) -> String {
    let mut bytes = text.as_bytes().to_vec();
    for &(kind, a, b) in changes {
        let (at, to) = (a % bytes.len().max(1), b % bytes.len().max(1));
        match kind {
            0 => bytes[at] ^= 1 << (b % 7),
            1 => drop(bytes.drain(at..(at + b % 12).min(bytes.len()))),
            2 => bytes.swap(at, to),
            3 => {
                let piece: Vec<u8> = bytes[at..(at + b % 20).min(bytes.len())].to_vec();
                bytes.splice(to..to, piece);
            }
            _ => drop(bytes.splice(at..at, "\u{e4}\t{}[]\"".bytes().take(2 + b % 7))),
        }
        if bytes.is_empty() {
            break;
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Two tokens of the file exchanged.
fn exchanged(text: &str, a: usize, b: usize) -> String {
    let mut tokens: Vec<&str> = text.split_inclusive([' ', '\n', ',', ']', '"']).collect();
    let count = tokens.len();
    tokens.swap(a % count, b % count);
    tokens.concat()
}

// A fixed seed: the same cases in every run.
proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..ProptestConfig::default() })]


    /// Whatever stands in the file: a model or messages, never a panic; and the messages say something.
    #[test]
    fn broken_files_do_not_panic(changes in prop::collection::vec((0_u8..5, any::<usize>(), any::<usize>()), 1..6)) {
        let text = mutated(include_str!("../../../models/princeton_beam.toml"), &changes);
        match Document::parse("m.toml", &text, &[]) {
            // What was taken is sound: no number of it is out of range or undefined.
            Ok(document) => prop_assert_eq!(document.check(), Ok(())),
            Err(diagnostics) => prop_assert!(diagnostics.to_string().starts_with("error: ")),
        }
    }

    #[test]
    fn exchanged_tokens_do_not_panic(a in any::<usize>(), b in any::<usize>(), c in any::<usize>(), d in any::<usize>()) {
        let text = exchanged(&exchanged(include_str!("../../../models/pendulum.toml"), a, b), c, d);
        match Document::parse("m.toml", &text, &[]) {
            Ok(document) => prop_assert_eq!(document.check(), Ok(())),
            Err(diagnostics) => prop_assert!(diagnostics.to_string().starts_with("error: ")),
        }
    }

    #[test]
    fn broken_parts_do_not_panic(
        changes in prop::collection::vec((0_u8..5, any::<usize>(), any::<usize>()), 0..3),
        tokens in prop::collection::vec((any::<usize>(), any::<usize>()), 0..3),
    ) {
        let swapped = tokens.iter().fold(EVERYTHING.to_owned(), |text, (a, b)| exchanged(&text, *a, *b));
        match Document::parse("m.toml", &mutated(&swapped, &changes), &[]) {
            Ok(document) => {
                prop_assert_eq!(document.check(), Ok(()));
                Drawing::new(&document);
            }
            Err(diagnostics) => prop_assert!(diagnostics.to_string().starts_with("error: ")),
        }
    }

    #[test]
    fn overrides_do_not_panic(key in "[a-zP.\\[\\]0-9_]{0,16}", value in "[-+*a-z0-9.\\[\\]{}\", =P\u{e4}]{0,16}") {
        let text = include_str!("../../../models/princeton_beam.toml");
        for key in [key.as_str(), "weight.force[2]", "P", "gravity"] {
            if let Err(diagnostics) = Document::parse("m.toml", text, &[(key.to_owned(), value.clone())]) {
                prop_assert!(diagnostics.to_string().starts_with("error: "));
            }
        }
    }
}

/// Names of the file may be of any length, and its mistakes of any number: messages are for reading.
#[test]
fn regression_messages_are_bounded() {
    let base = include_str!("../../../models/cantilever.toml");
    let lines = |line: &dyn Fn(usize) -> String| (0..3000).map(line).collect::<Vec<_>>().join("\n");
    for (text, expected) in [
        (format!("{base}{} = 1\n", "k".repeat(1_000_000)), "unknown key"),
        (format!("{base}[parameters]\n{}", lines(&|k| format!("p{k} = \"p{}\"", (k + 1) % 3000))), "p2999 -> p0"),
        (
            format!("{base}[parameters]\n{}", lines(&|k| format!("p{k} = \"unknown_{k}\""))),
            "there are 2900 mistakes more",
        ),
    ] {
        let message = Document::parse("m.toml", &text, &[]).expect_err("mistakes").to_string();
        assert!(message.contains(expected), "{}", &message[..1000.min(message.len())]);
        assert!(message.len() < 40_000, "{} bytes", message.len());
    }
}

/// A failure of the solver is shown at the line of the part that it names, not at a word that happens to be a name.
#[test]
fn messages_find_their_part() {
    let text = include_str!("../../../models/cantilever.toml").replace("joint.root", "joint.find");
    let document = Document::parse("m.toml", &text, &[]).expect("a model");
    for (message, expected) in [
        (
            "the equations have no unique solution: joint find is redundant: other joints already impose its constraints",
            Some("[joint.find]"),
        ),
        ("arm.node[3] (along y) can move freely; hold it by a joint", Some("[beam.arm]")),
        ("element 3 of beam arm: it is bent", Some("[beam.arm]")),
        ("no find and no arm here", None),
    ] {
        let found = document.locate(message).map(|mistake| mistake.to_string());
        match expected {
            Some(line) => assert!(found.as_ref().is_some_and(|text| text.contains(line)), "{message}: {found:?}"),
            None => assert_eq!(found, None),
        }
    }
}
