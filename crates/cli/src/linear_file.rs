//! The file of a linear system: matrices, or a small FMU.

use super::export::{self, Libraries, Look};
use super::{Stop, output};
use ancf14::fmi::Model;
use ancf14::fmi::lifecycle::Standard;
use ancf14::model::simulation::Simulation;
use ancf14_pack::contents::{Contents, LICENCES};
use ancf14_pack::libraries::{self, Platform};
use ancf14_pack::package;
use ancf14_pack::small::{Reduction, Small};
use ancf14_report::matrices::System;
use std::path::{Path, PathBuf};

/// The kinds of files.
#[derive(Clone, Copy, Debug)]
enum Format {
    Npz,
    Mat,
    Json,
    Modelica,
    Fmu,
}

impl Format {
    /// The kind that the ending of a file names.
    fn of(path: &Path) -> Result<Self, Stop> {
        let ending = path.extension().and_then(|extension| extension.to_str()).map(str::to_lowercase);
        match ending.as_deref() {
            Some("npz") => Ok(Self::Npz),
            Some("mat") => Ok(Self::Mat),
            Some("json") => Ok(Self::Json),
            Some("mo") => Ok(Self::Modelica),
            Some("fmu") => Ok(Self::Fmu),
            _ => Err(Stop::Bad(format!(
                "error: {} has no ending that says what it is; give a file that ends in .npz, .mat, .json, .mo or .fmu",
                path.display()
            ))),
        }
    }
}

/// The arguments of an FMU.
#[derive(clap::Args, Clone, Debug)]
pub struct Packing {
    /// Version of the standard of an FMU: 2 or 3
    #[arg(long, value_name = "VERSION", default_value = "2", value_parser = export::standard)]
    fmi: Standard,
    /// Shared library of an FMU [default: next to this program, or in ../lib]
    #[arg(long, value_name = "PATH")]
    library: Option<PathBuf>,
}

/// A file to write.
#[derive(Debug)]
pub struct Target<'a> {
    path: &'a Path,
    format: Format,
    standard: Standard,
    /// The libraries of an FMU.
    libraries: Vec<(Platform, PathBuf)>,
}

impl<'a> Target<'a> {
    /// The file `path`, which overwrites neither the file `model` nor a library; looks for libraries next to `program`.
    pub fn new(
        path: &'a Path,
        packing: &Packing,
        model: output::Input<'_>,
        program: Option<&Path>,
    ) -> Result<Self, Stop> {
        let format = Format::of(path)?;
        let libraries = match format {
            Format::Fmu => {
                let own = Libraries { own: packing.library.as_deref(), others: Vec::new(), program };
                export::gather(packing.fmi, own)?
            }
            _ if packing.library.is_some() => {
                return Err(Stop::Bad(format!(
                    "error: --library is for an FMU, and {} is a file of matrices; leave --library out, or write a file that \
                     ends in .fmu",
                    path.display()
                )));
            }
            _ => Vec::new(),
        };
        let read = libraries.iter().map(|(_, path)| ("a library to pack", path.as_path()));
        let inputs: Vec<output::Input<'_>> = read.chain([model]).collect();
        output::spare(&inputs, &[path.to_owned()])?;
        output::try_out(path)?;
        Ok(Self { path, format, standard: packing.fmi, libraries })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        self.path
    }

    /// Whether the file is an FMU.
    pub fn is_fmu(&self) -> bool {
        matches!(self.format, Format::Fmu)
    }

    /// Whether the file may have matrices of discrete time.
    pub fn may_be_sampled(&self) -> bool {
        !matches!(self.format, Format::Fmu | Format::Modelica)
    }

    /// Writes a system of `simulation`.
    pub fn write(
        &self,
        simulation: &Simulation,
        system: &System<'_>,
        reduction: Option<Reduction>,
    ) -> Result<(), Stop> {
        let bytes = match self.format {
            Format::Npz => {
                system.npz().map_err(|reason| Stop::Failed(format!("error: cannot write the archive: {reason}")))?
            }
            Format::Mat => system.mat(),
            Format::Json => system.json().into_bytes(),
            Format::Modelica => system.modelica().into_bytes(),
            Format::Fmu => self.fmu(simulation, system, reduction)?,
        };
        output::write(self.path, &bytes)
    }

    fn fmu(&self, simulation: &Simulation, system: &System<'_>, reduction: Option<Reduction>) -> Result<Vec<u8>, Stop> {
        let failed = |reason: &dyn std::fmt::Display| Stop::Failed(format!("error: {reason}"));
        let small = Small::new(simulation, system.linear, system.poles, reduction).map_err(|reason| failed(&reason))?;
        let look = Look::of(simulation)?;
        let contents = Contents {
            model: &small.text,
            linear: Some(&small.origin),
            state: None,
            licences: LICENCES,
            icon: &look.icon,
            page: &look.page,
            drawing: &look.drawing,
            legend: &look.legend,
        };
        let bytes = libraries::read(&self.libraries).map_err(|reason| failed(&reason))?;
        let fmu = package::fmu(self.standard, small.unit.about(), small.unit.variables(), &contents, &bytes);
        fmu.map_err(|reason| failed(&reason))
    }
}
