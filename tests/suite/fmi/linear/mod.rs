//! Linear systems as units: what the small FMU of a reduced mechanism computes.

mod amplitude;
mod damage;
mod exchange;
mod exchange_calls;
mod exchange_host;
mod loading;
mod mechanism;
mod oscillator;
mod states;

use ancf14::fmi::About;
use ancf14::fmi::instance::Instance;
use ancf14::linear::{File, Matrix, Signal, Unit};
use ancf14::packed::Packed;

fn matrix<const N: usize>(rows: &[[f64; N]]) -> Matrix {
    let values = (0..N).flat_map(|column| rows.iter().map(move |row| row[column])).collect();
    Matrix { rows: rows.len(), columns: N, values }
}

fn signal(name: &str, value: f64) -> Signal {
    Signal { name: name.to_owned(), unit: "m".to_owned(), value, ..Signal::default() }
}

/// Natural frequency, rad/s, and damping ratio of the oscillator.
const OMEGA: f64 = 7.0;
const ZETA: f64 = 0.05;
/// The input and the outputs in the state that it is about.
const U0: f64 = 0.3;
const Y0: [f64; 3] = [0.5, -2.0, 11.0];

/// A damped oscillator, `x'' + 2 ζ ω x' + ω² x = u`, with position, rate and acceleration as outputs.
fn oscillator() -> File {
    let (stiffness, damping) = (OMEGA * OMEGA, 2.0 * ZETA * OMEGA);
    File {
        amplitude: None,
        about: About {
            name: "Oscillator \"1\"\\\n\u{e9}".to_owned(),
            identifier: "oscillator".to_owned(),
            stop: 1.0,
            output_step: 1e-2,
            tolerance: 1e-6,
            ..About::default()
        },
        inputs: vec![signal("push.force", U0)],
        outputs: ["x.position", "x.velocity", "x.acceleration"]
            .iter()
            .zip(Y0)
            .map(|(name, value)| signal(name, value))
            .collect(),
        states: vec![String::from("x, m"), String::from("x.rate, m/s")],
        a: matrix(&[[0.0, 1.0], [-stiffness, -damping]]),
        b: matrix(&[[0.0], [1.0]]),
        c: matrix(&[[1.0, 0.0], [0.0, 1.0], [-stiffness, -damping]]),
        d: matrix(&[[0.0], [0.0], [1.0]]),
    }
}

/// An instance that has begun at t = 0.
fn begun(file: File) -> Instance<Packed> {
    let unit = Unit::load("linear.toml", &file.text()).unwrap_or_else(|failure| panic!("{}", failure.message));
    let mut instance = Instance::new(Packed::Linear(Box::new(unit)), false);
    instance.setup_experiment(None, 0.0, None).unwrap();
    instance.enter_initialization_mode().unwrap();
    instance.exit_initialization_mode().unwrap();
    instance
}

fn outputs<const N: usize>(instance: &mut Instance<Packed>, first: u32) -> [f64; N] {
    let mut values = [f64::NAN; N];
    let references: Vec<u32> = (first..first + N as u32).collect();
    instance.get_real(&references, &mut values).unwrap();
    values
}
