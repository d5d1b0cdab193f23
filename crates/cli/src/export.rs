//! `pack` and `header`: what leaves for other programs.

use super::output::{self, Input};
use super::picture::undrawn;
use super::{INPUTS, MODEL_FILE, Stop, complain, load, name, page, say, tune};
use ancf14::fmi::lifecycle::Standard;
use ancf14::fmi::{Model, header};
use ancf14::model::drawing::Drawing;
use ancf14::model::file::{Folder, Reach};
use ancf14::model::notes;
use ancf14::model::refinement::leaves_mesh;
use ancf14::model::simulation::Simulation;
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

/// The libraries of an FMU: that of this platform, given or next to `program`, and those of others that are given.
pub struct Libraries<'a> {
    pub own: Option<&'a Path>,
    pub others: Vec<(Platform, PathBuf)>,
    pub program: Option<&'a Path>,
}

/// The libraries of an FMU of a version of the standard, that of this platform first: those that are given, and those
/// that lie beside it.
pub fn gather(
    standard: Standard,
    Libraries { own: library, others, program }: Libraries<'_>,
) -> Result<Vec<(Platform, PathBuf)>, Stop> {
    let executable = match program {
        Some(program) => program.to_owned(),
        None => std::env::current_exe()
            .map_err(|reason| Stop::Failed(format!("error: this program cannot find itself: {reason}")))?,
    };
    // A path without a library is a wrong argument; a failed write is not.
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
    Ok(packed)
}

/// How an FMU shows its mechanism.
#[derive(Debug)]
pub struct Look {
    pub icon: Vec<u8>,
    pub page: String,
    pub drawing: String,
    pub legend: String,
}

impl Look {
    /// The mechanism as drawn.
    pub fn of(simulation: &Simulation) -> Result<Self, Stop> {
        let drawing = Drawing::new(simulation.document());
        Ok(Self {
            icon: picture::icon(&drawing).map_err(|reason| undrawn(&*reason))?,
            page: page(&Film::drawn(simulation))?,
            drawing: draw::svg(&drawing, "", Projection::default()),
            legend: draw::legend(&drawing),
        })
    }
}

/// How meshes that the file leaves to the program are found.
#[derive(Clone, Copy, Debug)]
pub struct Meshes<'a> {
    /// They stay as they begin.
    pub no_refine: bool,
    /// A table of inputs for the runs that find them; none: inputs keep their start values.
    pub inputs: Option<&'a Path>,
}

/// Packs the model `file` as an FMU of a version of the standard, with the libraries that are given or lie beside that
/// of this platform. Meshes that are left to the program are found first, unless they are to stay as they begin.
pub fn pack(
    standard: Standard,
    (file, reach): (&Path, Reach),
    output: &Path,
    meshes: Meshes<'_>,
    libraries: Libraries<'_>,
) -> Result<(), Stop> {
    if !output.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("fmu")) {
        let shown = output.display();
        return Err(Stop::Bad(format!("error: an FMU has a name that ends in .fmu, {shown} does not")));
    }
    let (mut simulation, mut text) = load(file, &[], reach)?;
    let packed = gather(standard, libraries)?;
    let read = packed.iter().map(|(_, path)| ("a library to pack", path.as_path()));
    let read: Vec<Input<'_>> =
        read.chain([(MODEL_FILE, file)]).chain(meshes.inputs.map(|path| (INPUTS, path))).collect();
    output::spare(&read, &[output.to_owned()])?;
    if !meshes.no_refine
        && let Some(found) = found(&simulation, (file, reach), meshes.inputs)?
    {
        (simulation, text) = found;
    }
    let look = Look::of(&simulation)?;
    let contents = Contents {
        model: &text,
        linear: None,
        state: simulation.first_state().map(|state| &*state.bytes),
        licences: LICENCES,
        icon: &look.icon,
        page: &look.page,
        drawing: &look.drawing,
        legend: &look.legend,
    };
    let bytes = libraries::read(&packed).map_err(|reason| Stop::Bad(format!("error: {reason}")))?;
    let fmu = package::fmu(standard, simulation.about(), simulation.variables(), &contents, &bytes);
    output::write(output, &fmu.map_err(|reason| Stop::Failed(format!("error: {reason}")))?)?;
    for note in notes::notes(simulation.document()) {
        complain(&format!("warning: {note}"));
    }
    let ranges = simulation.ranges().list;
    if !ranges.is_empty() {
        let names: Vec<&str> = ranges.iter().map(|range| &*range.name).collect();
        let told = "ranges over time are no variables of an FMU, which leaves out";
        say(&format!("{told} {}; add outputs without `summary` for single points", notes::listed(&names)))?;
    }
    let packed: Vec<_> =
        packed.iter().map(|(platform, path)| format!("{} ({})", platform.name(), path.display())).collect();
    say(&format!("{} packed for {}", output.display(), packed.join(", ")))
}

/// The model at `file` with the elements and steps that its loads, its drives and the `inputs` of a table ask for, and
/// its text; none: the file gives all elements, or the runs fail, so that the meshes stay as they begin.
fn found(
    model: &Simulation,
    (file, reach): (&Path, Reach),
    inputs: Option<&Path>,
) -> Result<Option<(Simulation, String)>, Stop> {
    if !leaves_mesh(model.document()) {
        if let Some(path) = inputs {
            let reason = "the model file gives the elements of all beams; leave out --inputs";
            complain(&format!("warning: the inputs of {} have no effect: {reason}", path.display()));
        }
        return Ok(None);
    }
    let search = match tune::search(load(file, &[], reach)?.0, inputs, None) {
        // Mistakes of the table.
        Err(stop @ (Stop::Mistaken(_) | Stop::Bad(_))) => return Err(stop),
        search => search,
    };
    let written = search.map_err(|stop| stop.reason()).and_then(|search| {
        let search = search.ok_or_else(|| String::from("the model begins with a state, or has too many results"))?;
        let text = search.found.written_flat(model.document())?;
        Ok((search, text))
    });
    let (search, text) = match written {
        Ok(written) => written,
        Err(reason) => {
            complain(&format!("warning: the FMU keeps its first automatic meshes: {reason}"));
            return Ok(None);
        }
    };
    search.outcome.warning().iter().for_each(|warning| complain(&format!("warning: {warning}")));
    let folder = file.parent().map(|path| Folder::new(path, reach));
    let loaded = Simulation::load_in(folder, &name(file), &text, &[]);
    let simulation = loaded.map_err(|failure| Stop::Failed(failure.message))?;
    let settings = search.found.settings().join(", ");
    let with = inputs.map_or(String::from("the model's own loads and drives"), |path| path.display().to_string());
    say(&format!("found with {with}: {settings} ({})", search.outcome.line()))?;
    Ok(Some((simulation, text)))
}

/// Writes the C header of the model `file`.
pub fn header(
    (file, reach): (&Path, Reach),
    output: &Path,
    meshes: Meshes<'_>,
    prefix: Option<&str>,
) -> Result<(), Stop> {
    let read: Vec<Input<'_>> =
        meshes.inputs.map(|path| (INPUTS, path)).into_iter().chain([(MODEL_FILE, file)]).collect();
    output::spare(&read, &[output.to_owned()])?;
    if output.extension().is_some_and(|ending| ending == "toml") {
        let shown = output.display();
        return Err(Stop::Bad(format!(
            "error: {shown} has the name of a model file; choose another name for the header"
        )));
    }
    let (mut simulation, _) = load(file, &[], reach)?;
    // A unit of this model has these numbers too, and its GUID with them.
    if !meshes.no_refine
        && let Some((found, _)) = found(&simulation, (file, reach), meshes.inputs)?
    {
        simulation = found;
    }
    let about = simulation.about();
    let prefix = prefix.unwrap_or(&about.identifier);
    let text =
        header::text(about, simulation.variables(), prefix).map_err(|reason| Stop::Bad(format!("error: {reason}")))?;
    output::write(output, text.as_bytes())?;
    say(&format!("{} written", output.display()))
}
