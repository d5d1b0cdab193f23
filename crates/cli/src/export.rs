//! `pack` and `header`: what leaves for other programs.

use super::output::{self, Input};
use super::picture::undrawn;
use super::{MODEL_FILE, Stop, complain, load, page, say};
use ancf14::fmi::lifecycle::Standard;
use ancf14::fmi::{Model, header};
use ancf14::model::drawing::Drawing;
use ancf14::model::file::Reach;
use ancf14::model::notes;
use ancf14_pack::contents::{Contents, LICENCES};
use ancf14_pack::libraries::{self, Platform};
use ancf14_pack::package;
use ancf14_report::draw::{self, Projection};
use ancf14_report::picture;
use ancf14_view::Film;
use std::path::{Path, PathBuf};

/// `win64=ancf14.dll`.
pub fn platform_and_path(text: &str) -> Result<(Platform, PathBuf), String> {
    let found = text.split_once('=').and_then(|(name, path)| Some((Platform::from_name(name)?, PathBuf::from(path))));
    found.ok_or_else(|| {
        let names = Platform::ALL.map(Platform::name).join(", ");
        format!("PLATFORM=PATH was expected, with a platform of {names}")
    })
}

/// `2` or `3`.
pub fn standard(text: &str) -> Result<Standard, String> {
    match text {
        "2" | "2.0" => Ok(Standard::Fmi2),
        "3" | "3.0" => Ok(Standard::Fmi3),
        _ => Err(String::from("2 or 3 was expected")),
    }
}

/// Packs the model `file` as an FMU of a version of the standard, with the library of this platform, which lies next to
/// `program`, and with those of others that are given or lie beside it.
pub fn pack(
    standard: Standard,
    (file, reach): (&Path, Reach),
    output: &Path,
    library: Option<&Path>,
    others: Vec<(Platform, PathBuf)>,
    program: Option<&Path>,
) -> Result<(), Stop> {
    if !output.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("fmu")) {
        let shown = output.display();
        return Err(Stop::Bad(format!("error: an FMU has a name that ends in .fmu, {shown} does not")));
    }
    let executable = match program {
        Some(program) => program.to_owned(),
        None => std::env::current_exe()
            .map_err(|reason| Stop::Failed(format!("error: this program cannot find itself: {reason}")))?,
    };
    let (simulation, text) = load(file, &[], reach)?;
    // No library at the place that was given is a wrong argument; a failed write is not.
    let own = libraries::find_library(library, &executable).map_err(|reason| Stop::Bad(format!("error: {reason}")))?;
    let mut beside = libraries::find_others(&own);
    let fits = |platform: Platform| standard == Standard::Fmi3 || platform != Platform::Wasm;
    if others.iter().any(|(given, _)| !fits(*given)) {
        return Err(Stop::Bad("error: components of WebAssembly go into FMUs of FMI 3.0; add --fmi 3".to_owned()));
    }
    beside.retain(|(platform, _)| fits(*platform) && others.iter().all(|(given, _)| given != platform));
    let mut packed = vec![(Platform::NATIVE, own)];
    packed.extend(others);
    packed.extend(beside);
    let read = packed.iter().map(|(_, path)| ("a library to pack", path.as_path()));
    let inputs: Vec<Input<'_>> = read.chain([(MODEL_FILE, file)]).collect();
    output::spare(&inputs, &[output.to_owned()])?;
    let drawing = Drawing::new(simulation.document());
    let contents = Contents {
        model: &text,
        state: simulation.first_state().map(|state| &*state.bytes),
        licences: LICENCES,
        icon: &picture::icon(&drawing).map_err(|reason| undrawn(&*reason))?,
        page: &page(&Film::drawn(&simulation))?,
        drawing: &draw::svg(&drawing, "", Projection::default()),
        legend: &draw::legend(&drawing),
    };
    let bytes = libraries::read(&packed).map_err(|reason| Stop::Bad(format!("error: {reason}")))?;
    let fmu = package::fmu(standard, simulation.about(), simulation.variables(), &contents, &bytes);
    output::write(output, &fmu.map_err(|reason| Stop::Failed(format!("error: {reason}")))?)?;
    for note in notes::notes(simulation.document()) {
        complain(&format!("warning: {note}"));
    }
    let packed: Vec<_> =
        packed.iter().map(|(platform, path)| format!("{} ({})", platform.name(), path.display())).collect();
    say(&format!("{} packed for {}", output.display(), packed.join(", ")))
}

/// Writes the C header of the model `file`.
pub fn header((file, reach): (&Path, Reach), output: &Path, prefix: Option<&str>) -> Result<(), Stop> {
    output::spare(&[(MODEL_FILE, file)], &[output.to_owned()])?;
    if output.extension().is_some_and(|ending| ending == "toml") {
        let shown = output.display();
        return Err(Stop::Bad(format!(
            "error: {shown} has the name of a model file; choose another name for the header"
        )));
    }
    let (simulation, _) = load(file, &[], reach)?;
    let about = simulation.about();
    let prefix = prefix.unwrap_or(&about.identifier);
    let text =
        header::text(about, simulation.variables(), prefix).map_err(|reason| Stop::Bad(format!("error: {reason}")))?;
    output::write(output, text.as_bytes())?;
    say(&format!("{} written", output.display()))
}
