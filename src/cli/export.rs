//! `pack` and `header`: what leaves for other programs.

use super::{Stop, draw, picture, say, write};
use ancf14::fmi::package::{self, Contents, Platform};
use ancf14::fmi::{Model, error::Error, header};
use ancf14::model::drawing::Drawing;
use ancf14::model::simulation::Simulation;
use std::path::{Path, PathBuf};

/// Licences of all that is linked into the library; made by scripts/licenses.py.
const LICENCES: &str = include_str!("../../licenses/license.txt");

/// `win64=ancf14.dll`.
pub fn platform_and_path(text: &str) -> Result<(Platform, PathBuf), String> {
    let found = text.split_once('=').and_then(|(name, path)| Some((Platform::from_name(name)?, PathBuf::from(path))));
    found.ok_or_else(|| {
        let names = Platform::ALL.map(Platform::name).join(", ");
        format!("PLATFORM=PATH was expected, with a platform of {names}")
    })
}

/// Refuses to write over the model file itself.
pub fn spare(file: &Path, output: &Path) -> Result<(), Stop> {
    match (file.canonicalize(), output.canonicalize()) {
        (Ok(model), Ok(target)) if model == target => {
            Err(Stop::Bad(format!("error: {} is the model file; choose another name to write to", output.display())))
        }
        _ => Ok(()),
    }
}

/// Packs the model as an FMU, with the library of this platform and of others that are given.
pub fn pack(
    simulation: &Simulation,
    text: &str,
    output: &Path,
    library: Option<&Path>,
    others: Vec<(Platform, PathBuf)>,
) -> Result<(), Stop> {
    let executable = std::env::current_exe()
        .map_err(|reason| Stop::Failed(format!("error: this program cannot find itself: {reason}")))?;
    // No library at the place that was given is a wrong argument; a failed write is not.
    let own = package::find_library(library, &executable).map_err(|reason| Stop::Bad(format!("error: {reason}")))?;
    let mut libraries = vec![(Platform::NATIVE, own)];
    libraries.extend(others);
    let drawing = Drawing::new(simulation.document());
    let contents = Contents {
        model: text,
        licences: LICENCES,
        icon: &picture::png(&draw::icon(&drawing))?,
        drawing: &draw::svg(&drawing, ""),
        legend: &draw::legend(&drawing),
    };
    let bytes = package::read(&libraries).map_err(|reason| Stop::Bad(format!("error: {reason}")))?;
    package::write(output, simulation.about(), simulation.variables(), &contents, &bytes).map_err(failed)?;
    let packed: Vec<_> =
        libraries.iter().map(|(platform, path)| format!("{} ({})", platform.name(), path.display())).collect();
    say(&format!("{} packed for {}", output.display(), packed.join(", ")));
    Ok(())
}

/// Writes the C header of the model.
pub fn header(simulation: &Simulation, output: &Path, prefix: Option<&str>) -> Result<(), Stop> {
    let about = simulation.about();
    let prefix = prefix.unwrap_or(&about.identifier);
    let text =
        header::text(about, simulation.variables(), prefix).map_err(|reason| Stop::Bad(format!("error: {reason}")))?;
    write(output, &text)?;
    say(&format!("{} written", output.display()));
    Ok(())
}

fn failed(reason: Error) -> Stop {
    Stop::Failed(format!("error: {reason}"))
}
