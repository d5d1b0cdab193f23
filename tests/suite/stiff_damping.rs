//! A viscosity that stops a strain within far less than a step makes the midpoint rule turn its rate about at every step. The numerical dissipation must end that as fast as
//! vibrations that no step resolves: by the spectral radius a step.

use crate::running::{run, start, value};

const FORCE: f64 = 100.0;

/// A steel rod of 1 m along x, pulled at its end from the start on. Its strain grows to that of the force within a viscosity of 10 ms; its mass stops it within nanoseconds.
fn rod(spectral_radius: f64) -> String {
    format!(
        "format = 1\n[model]\nname = \"Rod\"\n\
         [material.steel]\nyoung = 2e11\npoisson = 0.3\ndensity = 7850\ndamping = 1e-2\n\
         [section.round]\nshape = \"circle\"\nradius = 0.005\n\
         [beam.rod]\nmaterial = \"steel\"\nsection = \"round\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 1\n\
         [joint.clamp]\ntype = \"weld\"\na = \"ground\"\nb = \"rod.start\"\n\
         [load.pull]\nat = \"rod.end\"\nforce = [{FORCE}, 0, 0]\n\
         [output.clamp_load]\nat = \"clamp\"\nquantities = [\"reaction_force\"]\n\
         [simulation]\nstop = 0.05\nstep = 1e-3\nspectral_radius = {spectral_radius}\n"
    )
}

/// The clamp bears the force. The rate of the strain starts with none, so that the first value is wrong by the whole force; what is left of it changes its sign and
/// becomes smaller by the spectral radius with every step, to what the step of 0.1 times the viscosity resolves of the strain that grows.
#[test]
fn the_force_of_a_clamp_settles_by_the_spectral_radius_a_step() {
    for spectral_radius in [0.9, 0.8, 0.6] {
        let mut errors = Vec::new();
        let mut simulation = start(&rod(spectral_radius));
        run(&mut simulation, 1e-3, 0.05, |simulation| {
            errors.push((value(simulation, "clamp_load.reaction_force[1]") + FORCE).abs() / FORCE);
        });
        for (step, error) in errors.iter().enumerate().skip(1) {
            let bound = 1.3 * f64::powi(spectral_radius, step as i32) + 0.01;
            assert!(*error < bound, "spectral radius {spectral_radius}, step {step}: {error} is not below {bound}");
        }
    }
}
