//! `export`: simulates as `run` does, and writes files that ParaView and PyVista read.

use super::advance::advance;
use super::folder::Folder;
use super::output::Input;
use super::progress::last_row;
use super::{Stop, say, start};
use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;
use ancf14_vtk::{Export, File};
use std::path::Path;
use std::time::{Duration, Instant};

/// More instants than this are thousands of files for ParaView to open: whoever wants them says so.
const MOST: u64 = 10_000;

/// How often the lists are written during a run: an interrupted one can be looked at up to this time before the
/// interrupt.
const PACE: Duration = Duration::from_secs(1);

/// Simulates and writes one row in `every`, and the last one, into the folder `directory`; none: each row of at most
/// [`MOST`].
pub fn export(
    mut simulation: Simulation,
    directory: &Path,
    every: Option<u64>,
    inputs: &[Input<'_>],
) -> Result<(), Stop> {
    let last_row = last_row(&simulation)?;
    if every.is_none() && last_row >= MOST {
        let (rows, enough) = (last_row + 1, last_row.div_ceil(MOST - 1));
        return Err(Stop::Bad(format!(
            "error: the run has {rows} rows, and each needs several files; take --every={enough} for one row in {enough}, or --every=1 for all rows"
        )));
    }
    let every = every.unwrap_or(1);
    let instants = last_row.div_ceil(every) + 1;
    let mut export = Export::new(&simulation, instants);
    let Some(first) = export.parts().first().copied() else {
        return Err(Stop::Bad("error: the model has no beam, no body and nothing else to show".to_owned()));
    };
    let mut folder = Folder::open(directory)?;
    folder.claim("export", &simulation.about().guid, &export.names(instants), inputs)?;
    start(&mut simulation)?;
    // Each file replaces the one before as a whole, so that the lists are readable whenever a run is interrupted.
    let write = |files: Vec<File>| {
        files.into_iter().try_fold(0, |bytes, (name, content)| {
            folder.write(&name, &content)?;
            Ok(bytes + content.len())
        })
    };
    let mut bytes = write(export.look(&simulation))?;
    write(export.lists())?;
    let mut listed = Instant::now();
    let outcome = advance(&mut simulation, last_row, None, |row, simulation| {
        let is_due = row.is_multiple_of(every) || row == last_row;
        if is_due {
            bytes += write(export.look(simulation))?;
            if listed.elapsed() >= PACE {
                write(export.lists())?;
                listed = Instant::now();
            }
        }
        Ok(())
    });
    // A run that fails can be looked at up to the failure.
    let listed = write(export.lists());
    outcome?;
    bytes += listed?;
    let (parts, count, megabytes) = (export.parts().join(", "), export.instants(), bytes as f64 / 1e6);
    let list = directory.join(format!("{first}.pvd"));
    say(&format!("{count} instants of {parts}, {megabytes:.2} MB: open {} in ParaView", list.display()))
}

/// `--every`: a whole number.
pub fn every(text: &str) -> Result<u64, String> {
    let every = text.parse().ok().filter(|every| *every >= 1);
    every.ok_or_else(|| "a whole number from 1 on was expected".to_owned())
}
