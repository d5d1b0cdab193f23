//! `reduce`: the linear system of a mechanism with fewer states, as a file.

use super::linear_file::{Packing, Target};
use super::linearize::{self, Place};
use super::{ModelArguments, Stop, complain, failed, say, voice};
use ancf14::fmi::Model;
use ancf14::model::reduced::{Method, Reduced, Size};
use ancf14_pack::small::{Reduction, without_amplitude};
use ancf14_report::matrices::System;
use serde_json::json;
use std::path::{Path, PathBuf};

/// The arguments of `reduce`.
#[derive(clap::Args, Clone, Debug)]
pub struct Wishes {
    #[command(flatten)]
    place: Place,
    /// Largest error, as a share of the response to a sudden change of an input: 0.01 or 1% [default: 1%]
    #[arg(long, value_name = "ERROR", value_parser = error, conflicts_with = "order")]
    error: Option<f64>,
    /// Number of states instead
    #[arg(long, value_name = "N", value_parser = super::modes::count)]
    order: Option<u16>,
    /// How states are left out: balanced has a bound of the error; modal keeps the modes with the largest peaks, and
    /// the static responses of the others; craig-bampton keeps the softest modes and the static responses to the
    /// inputs, with symmetric matrices
    #[arg(long, value_enum, default_value_t)]
    method: Way,
    /// Print the largest error over many frequencies
    #[arg(long)]
    check: bool,
    /// The file: .npz for numpy and python-control, .mat for MATLAB and Octave, .json, .mo for Modelica, or .fmu for a
    /// small FMU
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    packing: Packing,
}

/// How states are left out.
#[derive(clap::ValueEnum, Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Way {
    #[default]
    Balanced,
    Modal,
    CraigBampton,
}

/// The error where nothing is asked for.
const ERROR: f64 = 0.01;

fn error(text: &str) -> Result<f64, String> {
    let (number, factor) = text.strip_suffix('%').map_or((text, 1.0), |number| (number, 0.01));
    let share = number.trim().parse().ok().map(|number: f64| factor * number);
    let share = share.filter(|share| *share > 0.0 && *share < 1.0);
    share.ok_or_else(|| "a share between 0 and 1 was expected, as in 0.01 or 1%".to_owned())
}

/// Reduces, and writes the file.
pub fn reduce(model: &ModelArguments, wishes: &Wishes, program: Option<&Path>) -> Result<(), Stop> {
    let target = Target::new(&wishes.output, &wishes.packing, model.input(), program)?;
    let (simulation, whole) = linearize::find(model, &wishes.place)?;
    let size = match wishes.order {
        Some(order) => Size::Order(usize::from(order)),
        None => Size::Error(wishes.error.unwrap_or(ERROR)),
    };
    let method = match wishes.method {
        Way::Balanced => Method::Balanced,
        Way::Modal => Method::Modal,
        Way::CraigBampton => Method::CraigBampton,
    };
    let mut found = whole.reduce(&simulation, size, method).map_err(|failure| failed(&simulation, &failure))?;
    if target.is_fmu()
        && let Err(reason) = found.linear.measure_amplitude(&whole, &simulation)
    {
        complain(&format!("warning: {}", without_amplitude(&reason)));
    }
    let name = simulation.about().name.clone();
    let version = env!("CARGO_PKG_VERSION");
    let system = System { linear: &found.linear, poles: &found.poles, model: &name, version, step: None };
    let Reduced { linear, whole, kept, bound, error, .. } = &found;
    let reduction = Reduction { whole: *whole, kept: *kept, bound: *bound, error: *error };
    target.write(&simulation, &system, Some(reduction))?;
    let order = linear.states.len();
    if voice::is_json() {
        let error = wishes.check.then_some(error);
        voice::deliver(json!({ "order": order, "states": whole, "kept": kept, "bound": bound, "error": error }));
        return Ok(());
    }
    let bound = bound.map_or_else(String::new, |bound| {
        format!(", the error is at most {bound:.1e} of the response to a sudden change")
    });
    let kept = if *kept > 0 { format!(", {kept} of them kept exactly") } else { String::new() };
    say(&format!("{whole} states reduced to {order}{kept}{bound}: {}", wishes.output.display()))?;
    if wishes.check || wishes.method != Way::Balanced {
        say(&format!(
            "the largest error at the frequencies that were looked at is {error:.1e} of the response to a sudden change"
        ))?;
    }
    Ok(())
}
