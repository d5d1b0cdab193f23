//! What is made from a model without a run: modes, the drawing, the FMU, the text of a table.

use ancf14::fmi::lifecycle::Standard;
use ancf14::fmi::{Model, Value};
use ancf14::model::drawing::Drawing;
use ancf14::model::modes::Modes;
use ancf14::model::simulation::Simulation;
use ancf14_pack::contents::{Contents, LICENCES};
use ancf14_pack::libraries::{self, Platform};
use ancf14_pack::package;
use ancf14_pack::small::Small;
use ancf14_report::draw::{self, Projection};
use ancf14_report::modes::word;
use ancf14_report::{picture, results};
use ancf14_view::Film;
use pyo3::prelude::*;
use std::path::PathBuf;

/// A mode: kind, what it moves most, then angular frequency, growth rate, eigenvalue, modal mass, damping
/// ratio, and the error because of the mesh; not a number: not known; then the share of
/// shear, likewise.
type FoundMode = (&'static str, String, [f64; 7]);

/// Modes; names of the places; the positions of the places; displacements and turns of each mode at each place;
/// warnings.
pub type FoundModes = (Vec<FoundMode>, Vec<String>, Vec<[f64; 3]>, Vec<[f64; 3]>, Vec<[f64; 3]>, Vec<String>);

/// Natural modes in plain types.
pub fn modes(found: &Modes) -> FoundModes {
    let modes = found.modes.iter().map(|mode| {
        let numbers = [
            mode.angular_frequency(),
            mode.growth_rate(),
            mode.eigenvalue,
            mode.modal_mass,
            mode.damping_ratio,
            mode.mesh_error.unwrap_or(f64::NAN),
            mode.shear.unwrap_or(f64::NAN),
        ];
        (word(mode), mode.moves.clone(), numbers)
    });
    let motions = || found.modes.iter().flat_map(|mode| &mode.motions);
    (
        modes.collect(),
        found.places.iter().map(|place| place.name.clone()).collect(),
        found.places.iter().map(|place| place.position).collect(),
        motions().map(|motion| motion.displacement).collect(),
        motions().map(|motion| motion.turn).collect(),
        found.warnings.clone(),
    )
}

/// The drawing that `ancf14 check --draw` writes.
pub fn drawing(model: &Simulation) -> String {
    draw::svg(&Drawing::new(model.document()), &model.about().name, Projection::default())
}

/// The bytes of an FMU, of FMI 3.0 or 2.0, with the library of this platform and those of others beside it: of the
/// mechanism, or of a linear system of it.
pub fn fmu(model: &Simulation, small: Option<&Small>, library: PathBuf, fmi: u8) -> Result<Vec<u8>, String> {
    let standard = match fmi {
        2 => Standard::Fmi2,
        3 => Standard::Fmi3,
        _ => return Err(format!("there is no FMI {fmi} here; fmi is 2 or 3")),
    };
    let drawing = Drawing::new(model.document());
    let icon = picture::icon(&drawing).map_err(|reason| format!("cannot draw the mechanism: {reason}"))?;
    let page = Film::drawn(model).page(None).map_err(|reason| format!("cannot show the mechanism: {reason}"))?;
    let contents = Contents {
        model: small.map_or(model.document().text(), |small| &small.text),
        linear: small.map(|small| &small.origin),
        state: model.first_state().map(|state| &*state.bytes).filter(|_| small.is_none()),
        licences: LICENCES,
        icon: &icon,
        page: &page,
        drawing: &draw::svg(&drawing, "", Projection::default()),
        legend: &draw::legend(&drawing),
    };
    let mut files = libraries::find_others(&library);
    files.insert(0, (Platform::NATIVE, library));
    let libraries = libraries::read(&files).map_err(|reason| reason.to_string())?;
    let (about, variables) = match small {
        Some(small) => (small.unit.about(), small.unit.variables()),
        None => (model.about(), model.variables()),
    };
    package::fmu(standard, about, variables, &contents, &libraries).map_err(|reason| reason.to_string())
}

/// The text of results.csv, from columns: name, whether its values are whole numbers, values.
#[pyfunction]
pub fn table(times: Vec<f64>, columns: Vec<(String, bool, Vec<f64>)>) -> String {
    let row = |(row, time): (usize, &f64)| {
        let values = columns.iter().map(|(_, is_whole, values)| match is_whole {
            true => Value::Integer(values[row] as i32),
            false => Value::Real(values[row]),
        });
        (*time, values.collect())
    };
    results::table(columns.iter().map(|(name, ..)| name.as_str()), times.iter().enumerate().map(row))
}
