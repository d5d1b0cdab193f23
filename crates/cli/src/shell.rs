//! `completions` and `man`: what a shell and a manual know of the commands.

use super::{Arguments, Stop, output, voice};
use clap::CommandFactory;
use clap_complete::Shell;
use std::path::Path;

/// Prints the completions of a shell.
pub fn completions(shell: Shell) -> Result<(), Stop> {
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "ancf14", &mut text);
    voice::print(String::from_utf8_lossy(&text).trim_end())
}

/// Writes a manual page for the program and one for each command into `folder`.
pub fn manual(folder: &Path) -> Result<(), Stop> {
    std::fs::create_dir_all(folder).map_err(|reason| output::trouble(folder, &reason))?;
    let program = Arguments::command();
    for command in std::iter::once(None).chain(program.get_subcommands().map(Some)) {
        let (name, page) = match command {
            None => ("ancf14".to_owned(), program.clone()),
            Some(command) => {
                let (name, call) = (format!("ancf14-{}", command.get_name()), format!("ancf14 {}", command.get_name()));
                (name.clone(), command.clone().display_name(name).bin_name(call))
            }
        };
        let file = folder.join(format!("{name}.1"));
        let mut text = Vec::new();
        clap_mangen::Man::new(page).render(&mut text).map_err(|reason| output::trouble(&file, &reason))?;
        output::write(&file, &text)?;
    }
    voice::say(&format!("manual pages in {}: man -l {}", folder.display(), folder.join("ancf14.1").display()))
}
