//! All machines of the campaign, group by group.

use super::machine::Machine;

/// A machine from a file.
fn from_file(group: &'static str, name: &str, text: &str) -> Machine {
    Machine { name: name.to_owned(), group, text: text.to_owned(), start: 0.0, judge: None }
}

/// The models that come with the program.
fn shipped() -> Vec<Machine> {
    let files = [
        ("pendulum", include_str!("../../models/pendulum.toml")),
        ("cantilever", include_str!("../../models/cantilever.toml")),
        ("roll_up", include_str!("../../models/roll_up.toml")),
        ("four_bar", include_str!("../../models/four_bar.toml")),
        ("rotating_shaft", include_str!("../../models/rotating_shaft.toml")),
    ];
    files.map(|(name, text)| from_file("shipped", name, text)).into()
}

/// Every machine, in the order of the page.
pub fn machines() -> Vec<Machine> {
    shipped()
}
