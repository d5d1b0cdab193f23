//! An FMU of FMI 3.0 in the `fmi` crate of crates.io: prints all Float64 outputs after each communication step as CSV,
//! elements of arrays named as in FMI 2.0, for a comparison with results.csv of `ancf14 run`. A second instance must
//! give the same numbers. (Version 0.8 of the crate has no FMU states.)
//!
//!     host UNIT.fmu > results.csv

use std::error::Error;

use fmi::fmi3::import::Fmi3Import;
use fmi::fmi3::schema::{AbstractVariableTrait, ArrayableVariableTrait, Causality, Dimension, Variable};
use fmi::fmi3::{CoSimulation, Common, Fmi3Model, GetSet};
use fmi::traits::FmiImport;

/// Names of the elements of an array: `tip.position[2]`, `shape.strain[4,1]`.
fn names(name: &str, dimensions: &[usize]) -> Vec<String> {
    match dimensions {
        [] => vec![name.to_owned()],
        [rows] => (1..=*rows).map(|row| format!("{name}[{row}]")).collect(),
        [rows, columns] => {
            (1..=*rows).flat_map(|row| (1..=*columns).map(move |column| format!("{name}[{row},{column}]"))).collect()
        }
        more => panic!("{name} has {} dimensions", more.len()),
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("usage: host UNIT.fmu")?;
    let import: Fmi3Import = fmi::import::from_path(&path)?;
    let description = import.model_description();
    let experiment = description.default_experiment.as_ref().ok_or("no default experiment")?;
    let (stop, step) = (experiment.stop_time.ok_or("no stop time")?, experiment.step_size.ok_or("no step size")?);
    let (mut references, mut header) = (Vec::new(), vec![String::from("time")]);
    for variable in &description.model_variables.variables {
        let Variable::Float64(variable) = variable else { continue };
        if variable.causality() == Causality::Output {
            let fixed = |dimension: &Dimension| dimension.as_fixed().expect("dimensions are fixed") as usize;
            let dimensions: Vec<usize> = variable.dimensions().iter().map(fixed).collect();
            references.push(variable.value_reference());
            header.extend(names(variable.name(), &dimensions));
        }
    }
    let steps = (stop / step).round() as u32;
    let run = || -> Result<Vec<Vec<f64>>, Box<dyn Error>> {
        let mut unit = import.instantiate_cs("unit", false, true, false, false, &[])?;
        assert_eq!(unit.get_version(), "3.0");
        unit.enter_initialization_mode(None, 0.0, None)?;
        unit.exit_initialization_mode()?;
        let mut row = vec![0.0; header.len() - 1];
        unit.get_float64(&references, &mut row)?;
        let mut rows = vec![row.clone()];
        for k in 0..steps {
            let (mut event, mut end, mut early, mut reached) = (false, false, false, 0.0);
            unit.do_step(f64::from(k) * step, step, false, &mut event, &mut end, &mut early, &mut reached)?;
            assert!(!event && !end && !early);
            unit.get_float64(&references, &mut row)?;
            rows.push(row.clone());
        }
        unit.terminate()?;
        Ok(rows)
    };
    let rows = run()?;
    assert_eq!(run()?, rows, "a second instance gives other numbers");
    println!("{}", header.iter().map(|name| if name.contains(',') { format!("\"{name}\"") } else { name.clone() }).collect::<Vec<_>>().join(","));
    for (k, row) in rows.iter().enumerate() {
        let cells: Vec<String> = row.iter().map(|value| format!("{value:?}")).collect();
        println!("{:?},{}", k as f64 * step, cells.join(","));
    }
    Ok(())
}
