//! `export`: simulates as `run` does, and writes files that ParaView and PyVista read.

use super::folder::Folder;
use super::progress::last_row;
use super::repeat::{self, Seen, repeat};
use super::{ModelArguments, Stop, say};
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
/// [`MOST`]. Runs that are repeated with finer steps and meshes write one after the other.
pub fn export(model: &ModelArguments, directory: &Path, every: Option<u64>, no_refine: bool) -> Result<(), Stop> {
    let (simulation, _) = model.load()?;
    let last_row = last_row(&simulation)?;
    if every.is_none() && last_row >= MOST {
        let (rows, enough) = (last_row + 1, last_row.div_ceil(MOST - 1));
        return Err(Stop::Bad(format!(
            "error: the run has {rows} rows, and each needs several files; take --every={enough} for one row in {enough}, or --every=1 for all rows"
        )));
    }
    let every = every.unwrap_or(1);
    let instants = last_row.div_ceil(every) + 1;
    let drawn = Export::new(&simulation, instants);
    let Some(first) = drawn.parts().first().copied() else {
        return Err(Stop::Bad("error: the model has no beam, no body and nothing else to show".to_owned()));
    };
    let mut folder = Folder::open(directory)?;
    folder.claim("export", &simulation.about().guid, &drawn.names(instants), &[model.input()])?;
    // Each file replaces the one before as a whole, so that the lists are readable whenever a run is interrupted.
    let write = |files: Vec<File>| {
        files.into_iter().try_fold(0, |bytes, (name, content)| {
            folder.write(&name, &content)?;
            Ok(bytes + content.len())
        })
    };
    let begin = |simulation: &Simulation, _: &mut Vec<String>| Ok(Writing::of(Export::new(simulation, instants)));
    let mut look = |own: &mut Writing, row: u64, simulation: &Simulation| {
        if row.is_multiple_of(every) || row == last_row {
            own.bytes += write(own.export.look(simulation))?;
            if row == 0 || own.listed.elapsed() >= PACE {
                write(own.export.lists())?;
                own.listed = Instant::now();
            }
        }
        Ok(())
    };
    let refines = !no_refine && repeat::refines(&simulation);
    let mut seen = repeat(simulation, refines, begin, &mut look)?;
    if seen.is_torn {
        say("a finer run has failed: the files are those of the first run")?;
        seen = repeat(model.load()?.0, false, begin, &mut look)?;
    }
    let Seen { look: Writing { export, mut bytes, .. }, outcome, .. } = seen;
    // A run that fails can be looked at up to the failure.
    let listed = write(export.lists());
    outcome?;
    bytes += listed?;
    let (parts, count, megabytes) = (export.parts().join(", "), export.instants(), bytes as f64 / 1e6);
    let list = directory.join(format!("{first}.pvd"));
    say(&format!("{count} instants of {parts}, {megabytes:.2} MB: open {} in ParaView", list.display()))
}

/// The files of a run.
struct Writing {
    export: Export,
    /// How long they are.
    bytes: usize,
    /// When the lists were written.
    listed: Instant,
}

impl Writing {
    fn of(export: Export) -> Self {
        Self { export, bytes: 0, listed: Instant::now() }
    }
}

/// `--every`: a whole number.
pub fn every(text: &str) -> Result<u64, String> {
    let every = text.parse().ok().filter(|every| *every >= 1);
    every.ok_or_else(|| "a whole number from 1 on was expected".to_owned())
}
