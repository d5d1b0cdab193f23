//! The campaign against silently wrong answers, in small: a dozen machines from all corners get the verdicts that
//! docs/campaign.md has for them. A verdict that changes is a solver, a warning or a machine that has changed: run the
//! campaign (`cargo run --release --bin campaign`) and look what else has.

use ancf14::model::simulation::Simulation;
use ancf14_tools::campaign::machine::{Machine, Setting};
use ancf14_tools::campaign::{catalogue, page, verdict};

const PAGE: &str = include_str!("../../../../docs/campaign.md");

/// Machines that take little time, with verdicts of all kinds among them.
const SMALL: [&str; 15] = [
    "spinning_top",
    "load_pulse",
    "stiff_damper",
    "redundant_loop",
    "spinning_body_4",
    "impacting_spring_2",
    "pendulums_elastic_3",
    "snapping_truss_4",
    "slack_chain_4",
    "redundant_rigid_1",
    "late_table_4",
    "statics_portal_1",
    "statics_portal_4",
    "statics_arch_2",
    "statics_column_2",
];

fn machine(name: &str) -> Machine {
    catalogue::machines().into_iter().find(|machine| machine.name == name).unwrap()
}

#[test]
fn verdicts_are_those_of_the_page() {
    let mut silent = 0;
    for name in SMALL {
        let judged = verdict::judged(&machine(name));
        let (letters, line) = (page::letters(&judged), page::line(&judged));
        println!("{letters}");
        assert!(PAGE.contains(&format!("\n{letters}")), "docs/campaign.md has another verdict than\n{letters}{line}");
        silent += usize::from(page::is_silently_wrong(&judged));
        assert_eq!(
            PAGE.contains(&line),
            page::is_silently_wrong(&judged),
            "docs/campaign.md has other errors than\n{line}"
        );
    }
    assert!(silent > 0, "no machine is left that shows whether errors are found");
}

/// The catalogue is large, its names are names, and a file of it is wrong at most where a defect made it so.
#[test]
fn the_catalogue_is_large_and_can_be_read() {
    let machines = catalogue::machines();
    let mut names: Vec<&str> = machines.iter().map(|machine| machine.name.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    assert!(
        names.len() == machines.len() && names.len() >= 300,
        "{} names of {} machines",
        names.len(),
        machines.len()
    );
    for machine in &machines {
        for setting in [Setting::Own, Setting::Finer(8)] {
            let Some(text) = machine.text(setting) else { continue };
            let loaded = Simulation::load("machine.toml", &text, &[]);
            assert!(loaded.is_ok(), "{}, {}: {}", machine.name, setting.title(), loaded.unwrap_err().message);
        }
    }
}

/// The page tells all that it takes to write it: a part of the campaign can renew it.
#[test]
fn the_page_can_be_read() {
    let judged = page::read(PAGE, &catalogue::machines()).unwrap();
    assert_eq!(page::page(&judged), PAGE);
}

/// The page has every machine of the catalogue, in its order.
#[test]
fn the_page_is_whole() {
    let letters = PAGE.split("```").nth(1).unwrap();
    let listed: Vec<&str> = letters.lines().filter_map(|line| line.rsplit_once(' ')).map(|(_, name)| name).collect();
    let machines = catalogue::machines();
    let names: Vec<&str> = machines.iter().map(|machine| machine.name.as_str()).collect();
    assert_eq!(listed, names);
}
