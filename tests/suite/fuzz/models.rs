//! Model files with random changes: is every one of them either refused in words, or a machine that can be used? A file
//! that is taken is described, started, stepped, saved and read again, differentiated, and asked for its modes. Nothing
//! may panic, every number that is handed out is finite, a failed step leaves the machine as it was, and the same file
//! gives the same answers twice.

use super::mutations::{mutated, shrunk};
use super::requirements::{is_readable, is_sentence, same, values};
use super::{caught, round};
use crate::pages::{listings, pages_in};
use crate::random::Random;
use ancf14::fmi::variable::Causality;
use ancf14::fmi::{Failure, Model, header};
use ancf14::model::document::Document;
use ancf14::model::drawing::Drawing;
use ancf14::model::entries::output::Target;
use ancf14::model::notes::notes;
use ancf14::model::simulation::Simulation;
use ancf14_pack::description;
use std::cell::RefCell;
use std::fmt::Write;

/// What files are made of.
const FILES: [&str; 20] = [
    include_str!("../../../models/pendulum.toml"),
    include_str!("../../../models/cantilever.toml"),
    include_str!("../../../models/princeton_beam.toml"),
    include_str!("../../../models/rotating_shaft.toml"),
    include_str!("../../../models/lateral_buckling.toml"),
    include_str!("../../../models/four_bar.toml"),
    include_str!("../../../models/robot.toml"),
    include_str!("../../../models/crane.toml"),
    include_str!("../../../models/roll_up.toml"),
    include_str!("../../../models/elastica.toml"),
    include_str!("../../../models/ring.toml"),
    include_str!("../../../models/helical_spring.toml"),
    include_str!("../../../models/bend_45.toml"),
    include_str!("../../../models/derrick.toml"),
    include_str!("../../../models/belt_drive.toml"),
    include_str!("../../../models/mooring.toml"),
    include_str!("../../../models/capstan.toml"),
    include_str!("../../../models/jumper.toml"),
    include_str!("../../everything.toml"),
    include_str!("../fmi/both_elements.toml"),
];

/// Larger machines are refused here: they would only take longer.
const MOST_ELEMENTS: f64 = 200.0;
const MOST_STATIONS: usize = 1_000;
/// Machines whose modes are asked for.
const MOST_WITH_MODES: usize = 20;
/// Internal steps of a call at most.
const MOST_PARTS: u32 = 3_000;
/// Ends of the communication steps, in internal steps: whole ones and parts.
const ENDS: [f64; 5] = [1.0, 2.0, 2.4, 2.4 + 1e-7, 4.0];

/// How far a file got.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Reached {
    Refused,
    TooLarge,
    Loaded,
    Started,
    Stepped,
}

/// Messages and values, to compare with those of a second time.
type Log = RefCell<String>;

fn tell(log: &Log, values: &[f64]) {
    values.iter().for_each(|value| write!(log.borrow_mut(), "{:x} ", value.to_bits()).unwrap());
}

/// The message of a failure, which is a sentence.
fn told(log: &Log, failure: &Failure) -> Result<(), String> {
    log.borrow_mut().push_str(&failure.message);
    is_readable(&failure.message)
}

/// Whether a file may be built: what it would need is bounded.
fn is_small(document: &Document) -> bool {
    let elements: f64 = document.beams.iter().map(|beam| document.value(beam.elements)).sum();
    let stations = |target: Target| if let Target::On { stations, .. } = target { stations } else { 1 };
    elements <= MOST_ELEMENTS
        && document.outputs.iter().map(|output| stations(output.target)).sum::<usize>() <= MOST_STATIONS
}

/// Does everything with a file that can be done, and says what is wrong with an answer.
fn used(text: &str, log: &Log) -> Result<Reached, String> {
    match Document::parse("m.toml", text, &[]) {
        Err(mistakes) => {
            log.borrow_mut().push_str(&mistakes.to_string());
            return is_readable(&mistakes.to_string()).map(|()| Reached::Refused);
        }
        Ok(document) if !is_small(&document) => return Ok(Reached::TooLarge),
        Ok(document) => {
            Drawing::new(&document);
            notes(&document).iter().try_for_each(|note| is_sentence(note))?;
        }
    }
    let mut simulation = match Simulation::load("m.toml", text, &[]) {
        Err(failure) => return told(log, &failure).map(|()| Reached::Refused),
        Ok(simulation) => simulation,
    };
    is_described(&simulation)?;
    if let Err(failure) = simulation.check().and_then(|()| simulation.initialize(0.0)) {
        return told(log, &failure).map(|()| Reached::Loaded);
    }
    tell(log, &values(&simulation)?);
    are_modes_sound(&simulation, log)?;
    if !steps(&mut simulation, log)? {
        return Ok(Reached::Started);
    }
    is_the_same_from_bytes(&mut simulation, text)?;
    are_derivatives_finite(&mut simulation, log)?;
    Ok(Reached::Stepped)
}

/// Description and header: text without what XML cannot hold.
fn is_described(simulation: &Simulation) -> Result<(), String> {
    let (about, variables) = (simulation.about(), simulation.variables());
    let xml = description::xml(about, variables).map_err(|error| format!("no description: {error}"))?;
    header::text(about, variables, "FUZZ").map_err(|error| format!("no header: {error}"))?;
    let mut reader = quick_xml::Reader::from_str(&xml);
    loop {
        match reader.read_event() {
            Ok(quick_xml::events::Event::Eof) => break,
            Ok(_) => (),
            Err(error) => return Err(format!("the description is no XML: {error}")),
        }
    }
    match xml.chars().find(|c| (c.is_control() && !"\n\t\r".contains(*c)) || matches!(c, '\u{fffe}' | '\u{ffff}')) {
        Some(character) => Err(format!("the description holds {character:?}")),
        None => Ok(()),
    }
}

fn are_modes_sound(simulation: &Simulation, log: &Log) -> Result<(), String> {
    if simulation.system().mesh.elements.len() > MOST_WITH_MODES {
        return Ok(());
    }
    match simulation.modes(3) {
        Err(failure) => told(log, &failure),
        Ok(found) => {
            found.warnings.iter().try_for_each(|warning| is_sentence(warning))?;
            for mode in &found.modes {
                let motions = mode.motions.iter().flat_map(|motion| motion.displacement.into_iter().chain(motion.turn));
                let numbers: Vec<f64> = motions.chain([mode.eigenvalue, mode.modal_mass]).collect();
                tell(log, &numbers);
                if !numbers.iter().all(|number| number.is_finite()) {
                    return Err(format!("a mode of {} with numbers that are none", mode.eigenvalue));
                }
            }
            Ok(())
        }
    }
}

/// Advances to `end`, s, or as far as so many internal steps lead: a machine that is stiff beyond reason takes millions
/// of them.
fn go_to(simulation: &mut Simulation, end: f64) -> Result<(), Failure> {
    simulation.begin_step(end)?;
    for _ in 0..MOST_PARTS {
        if simulation.take_part()? {
            return Ok(());
        }
    }
    simulation.end_step()
}

/// Takes all steps; false where one failed, which must leave the machine as it was.
fn steps(simulation: &mut Simulation, log: &Log) -> Result<bool, String> {
    let step = simulation.document().largest_step();
    for end in ENDS.map(|end| end * step).into_iter().filter(|end| end.is_finite()) {
        let (before, state) = (values(simulation)?, simulation.state().clone());
        let outcome = simulation.accept_step(end).and_then(|()| go_to(simulation, end));
        for warning in simulation.take_warnings() {
            is_sentence(&warning)?;
            log.borrow_mut().push_str(&warning);
        }
        let after = values(simulation)?;
        tell(log, &after);
        match outcome {
            Ok(()) if simulation.time() < state.time => return Err(format!("a step back from {} s", state.time)),
            Ok(()) => (),
            Err(_) if !same(&before, &after) || *simulation.state() != state => {
                return Err(format!("a failed step to {end} s leaves other values behind"));
            }
            Err(failure) => return told(log, &failure).map(|()| false),
        }
    }
    Ok(true)
}

/// A state that was saved as bytes goes on as the one that is there does.
fn is_the_same_from_bytes(simulation: &mut Simulation, text: &str) -> Result<(), String> {
    let snapshot = simulation.snapshot();
    let bytes = simulation.write(&snapshot, Vec::new());
    let mut other = Simulation::load("m.toml", text, &[]).map_err(|failure| failure.message)?;
    let read = other.read(&bytes).map_err(|failure| format!("the state cannot be read: {}", failure.message))?;
    other.restore(&read);
    if !same(&values(simulation)?, &values(&other)?) {
        return Err(String::from("other values from bytes"));
    }
    let end = 2.0 * simulation.time();
    if end.is_finite() && simulation.accept_step(end).is_ok() {
        let outcomes = [go_to(simulation, end), go_to(&mut other, end), {
            simulation.restore(&snapshot);
            go_to(simulation, end)
        }];
        if outcomes[0] != outcomes[1] || outcomes[0] != outcomes[2] || !same(&values(simulation)?, &values(&other)?) {
            return Err(format!("other results from a saved state: {outcomes:?}"));
        }
    }
    simulation.restore(&snapshot);
    simulation.take_warnings();
    Ok(())
}

/// Derivatives are numbers or refused, and leave the state alone.
fn are_derivatives_finite(simulation: &mut Simulation, log: &Log) -> Result<(), String> {
    let of = |wanted: Causality| -> Vec<usize> {
        let rows = simulation.variables().iter().enumerate();
        rows.filter(|(_, row)| row.causality == wanted && matches!(row.start, ancf14::fmi::Value::Real(_)))
            .map(|(number, _)| number)
            .collect()
    };
    let (outputs, inputs) = (of(Causality::Output), of(Causality::Input));
    let (before, state) = (values(simulation)?, simulation.state().clone());
    for &output in &outputs {
        let rate = simulation.output_derivative(output);
        let slopes = inputs.iter().map(|&input| simulation.partial_derivative(output, input)).collect::<Vec<_>>();
        for derivative in std::iter::once(rate).chain(slopes) {
            match derivative {
                Ok(number) if !number.is_finite() => return Err(format!("a derivative is {number}")),
                Ok(number) => tell(log, &[number]),
                Err(failure) => told(log, &failure)?,
            }
        }
    }
    if !same(&before, &values(simulation)?) || *simulation.state() != state {
        return Err(String::from("derivatives have changed the state"));
    }
    Ok(())
}

/// Uses a file twice.
fn judged(text: &str) -> Result<Reached, String> {
    let logs: [Log; 2] = Default::default();
    let [first, second] = [&logs[0], &logs[1]].map(|log| caught(|| used(text, log)));
    match logs[0] == logs[1] && first == second {
        true => first,
        false => first.and(Err(String::from("other answers the second time"))),
    }
}

/// The machines of the files, and of pages, which use what is newer, without comments.
fn files() -> Vec<String> {
    let pages = pages_in("docs/how-do-i");
    let listings = pages.iter().flat_map(|(_, page)| listings(page, "toml"));
    let whole = listings.filter(|text| text.contains("format = 1") && text.contains("[simulation]"));
    let line = |line: &&str| !line.starts_with('#');
    let bare = |text: &str| text.lines().filter(line).map(|line| format!("{line}\n")).collect();
    FILES.into_iter().chain(whole).map(bare).collect()
}

/// The files themselves get as far as they should, or changes of them try nothing.
#[test]
fn fuzzing_begins_with_machines_that_run() {
    for text in files() {
        let reached = judged(&text);
        let expected = if text.contains("\"Everything\"") { Reached::Loaded } else { Reached::Stepped };
        assert_eq!(reached, Ok(expected), "{text}");
    }
}

#[test]
fn model_files_are_refused_or_run() {
    let files = files();
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    let mut counts = [0_u64; 5];
    // What is tried last is there after an abort, too.
    let trace = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("fuzz-model.toml");
    let inputs = round("model files", 100, |seed| {
        let text = mutated(&mut Random(seed), &files);
        std::fs::write(&trace, &text).unwrap();
        match judged(&text) {
            Ok(reached) => {
                counts[reached as usize] += 1;
                Ok(())
            }
            Err(problem) => {
                let shortest = shrunk(&text, |text| {
                    judged(text).is_err_and(|other| other[..10.min(other.len())] == problem[..10.min(problem.len())])
                });
                Err(format!("{problem}\n{shortest}\n"))
            }
        }
    });
    println!("refused, too large, loaded, started, stepped: {counts:?}");
    assert!(10 * counts[Reached::Stepped as usize] > inputs, "too few machines that run: {counts:?}");
}
