//! A machine of the campaign: a model file with a name, and the settings that are derived from it.

use super::edit;
use ancf14::model::simulation::Simulation;

/// A machine of the catalogue.
#[derive(Clone, Debug)]
pub struct Machine {
    /// Its name, one of a kind in the catalogue.
    pub name: String,
    /// What it has in common with others.
    pub group: &'static str,
    /// The model file. Its `step` is the one that an engineer would take, and `stop` is absolute.
    pub text: String,
    /// When it starts, s.
    pub start: f64,
    /// The integrator of its reference, where the file's own one is known to be wrong.
    pub judge: Option<&'static str>,
}

/// How a machine is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setting {
    /// As its file says.
    Own,
    /// Without `integrator`, and without `step` where a file may leave it out.
    Defaults,
    /// With a fixed step so many times as large.
    Step(u32),
    /// With one element instead of so many.
    Mesh(u32),
    /// As its file says, with a mesh twice as fine: to find out whose fault an error is.
    FinerMesh,
    /// As a reference: with so many steps instead of one, and a mesh twice as fine.
    Finer(u32),
}

/// The settings that are judged, in the order of the tables.
pub const SETTINGS: [Setting; 7] = [
    Setting::Own,
    Setting::Defaults,
    Setting::Step(3),
    Setting::Step(10),
    Setting::Step(30),
    Setting::Mesh(2),
    Setting::Mesh(4),
];

/// A coarser mesh is tried where the longest beam has so many elements or more.
const FEWEST_TO_COARSEN: u32 = 4;
/// Refinement of the mesh of references.
const FINER_MESH: u32 = 2;
/// The level of references that has an odd number of steps between two rows.
const ODD_LEVEL: u32 = 8;

impl Setting {
    /// `step x 3`.
    pub fn title(self) -> String {
        match self {
            Self::Own => String::from("own"),
            Self::Defaults => String::from("defaults"),
            Self::Step(factor) => format!("step x {factor}"),
            Self::Mesh(divisor) => format!("mesh / {divisor}"),
            Self::FinerMesh => format!("mesh x {FINER_MESH}"),
            Self::Finer(divisor) => format!("step / {divisor}, mesh x {FINER_MESH}"),
        }
    }

    /// `step-times-3`: for file names.
    pub fn file_stem(self) -> String {
        self.title().replace(" x ", "-times-").replace(" / ", "-over-").replace(", ", "-")
    }

    /// The step of this setting, s.
    pub fn step(self, machine: &Machine) -> f64 {
        match self {
            Self::Step(factor) => machine.step() * f64::from(factor),
            Self::Finer(divisor) => machine.output_step() / finer_steps(machine, divisor),
            Self::Own | Self::Defaults | Self::Mesh(_) | Self::FinerMesh => machine.step(),
        }
    }

    /// Rows of the machine's table between two rows of this setting: so many that each is at the end of a step.
    pub fn rows_apart(self, machine: &Machine) -> usize {
        let Self::Step(factor) = self else { return 1 };
        let steps = machine.output_step() / machine.step();
        let is_whole = |rows: &usize| {
            let count = *rows as f64 * steps / f64::from(factor);
            count > 0.5 && (count - count.round()).abs() < 1e-6
        };
        (1..=factor as usize).find(is_whole).unwrap_or((f64::from(factor) / steps).ceil() as usize)
    }
}

/// Steps between two rows of a reference: an even number of the coarser levels, an odd one of the next. What alternates
/// from step to step would look the same in every row of two levels otherwise, and pass for agreement.
fn finer_steps(machine: &Machine, divisor: u32) -> f64 {
    let steps = (f64::from(divisor) * machine.output_step() / machine.step()).round();
    if divisor == ODD_LEVEL { 2.0 * (steps / 2.0).floor() + 1.0 } else { 2.0 * (steps / 2.0).ceil() }
}

impl Machine {
    /// The model file of a setting; none where the setting does not apply.
    pub fn text(&self, setting: Setting) -> Option<String> {
        let resized = || edit::with(&self.text, "simulation", "step", &format!("{:e}", setting.step(self)));
        match setting {
            Setting::Own => Some(self.text.clone()),
            Setting::Defaults => Some(self.with_defaults()),
            Setting::Step(_) => {
                let rows = self.output_step() * setting.rows_apart(self) as f64;
                Some(edit::with(&resized(), "simulation", "output_step", &format!("{rows:e}")))
            }
            Setting::Mesh(divisor) => {
                let coarser = |elements: u32| elements.div_ceil(divisor);
                let largest = edit::meshes(&self.text).into_iter().map(|(_, elements)| elements).max();
                let is_fine = largest.is_some_and(|elements| elements >= FEWEST_TO_COARSEN);
                let text = edit::remeshed(&self.text, coarser).filter(|_| is_fine)?;
                // A joint at a fraction of a beam where the coarser mesh has no node, or a corner too many, is no fault
                // of the solver.
                Simulation::load("machine.toml", &text, &[]).is_ok().then_some(text)
            }
            Setting::FinerMesh => edit::remeshed(&self.text, |elements| FINER_MESH * elements),
            Setting::Finer(_) => {
                let text = edit::remeshed(&resized(), |elements| FINER_MESH * elements)?;
                Some(match self.judge {
                    Some(word) => edit::with(&text, "simulation", "integrator", &format!("\"{word}\"")),
                    None => text,
                })
            }
        }
    }

    /// The file without what its author chose of the integration.
    fn with_defaults(&self) -> String {
        let rows = edit::with(&self.text, "simulation", "output_step", &format!("{:e}", self.output_step()));
        let chosen = ["spectral_radius", "integrator"];
        let text = chosen.iter().fold(rows, |text, key| edit::without(&text, "simulation", key));
        let without_step = edit::without(&text, "simulation", "step");
        if Simulation::load("machine.toml", &without_step, &[]).is_ok() { without_step } else { text }
    }

    /// The step of the file, s.
    pub fn step(&self) -> f64 {
        self.simulation("step")
    }

    /// The time between two rows, s.
    pub fn output_step(&self) -> f64 {
        edit::number(&self.text, "simulation", "output_step").unwrap_or_else(|| self.step())
    }

    /// When it ends, s.
    pub fn stop(&self) -> f64 {
        self.simulation("stop")
    }

    fn simulation(&self, key: &str) -> f64 {
        let number = edit::number(&self.text, "simulation", key);
        number.unwrap_or_else(|| panic!("{}: simulation.{key} is not a number on a line of its own", self.name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn machine(step: f64, output_step: f64) -> Machine {
        let text = format!("[simulation]\nstop = 1\nstep = {step}\noutput_step = {output_step}\n");
        Machine { name: String::from("machine"), group: "tests", text, start: 0.0, judge: None }
    }

    /// What alternates from step to step looks different in the rows of two levels.
    #[test]
    fn levels_of_a_reference_have_even_and_odd_steps_in_a_row() {
        for (step, output_step) in [(1e-3, 1e-3), (1e-3, 1e-2), (1e-3, 5e-3), (3e-3, 4e-3)] {
            let machine = machine(step, output_step);
            let steps = [4, 8, 16].map(|divisor| output_step / Setting::Finer(divisor).step(&machine));
            let parity = steps.map(|steps| (steps.round() as u32) % 2);
            assert_eq!(parity, [0, 1, 0], "{steps:?}");
            assert!(steps.iter().all(|steps| (steps - steps.round()).abs() < 1e-9), "{steps:?}");
        }
    }

    /// Rows of a coarse step are at its ends: a row between them would make it smaller.
    #[test]
    fn rows_of_coarse_steps_are_at_their_ends() {
        for (rows_a_step, factor, apart) in [(1.0, 3, 3), (5.0, 3, 3), (10.0, 10, 1), (5.0, 30, 6), (4.0, 30, 15)] {
            assert_eq!(
                Setting::Step(factor).rows_apart(&machine(1e-3, 1e-3 * rows_a_step)),
                apart,
                "{rows_a_step} {factor}"
            );
        }
    }
}
