//! The integrators by names of tests: `conserving`, `undamped`, which is `conserving` without numerical dissipation,
//! and `generalized_alpha`.

/// The override of a model file that takes the integrator.
pub fn setting(name: &str) -> (&'static str, &'static str) {
    match name {
        "conserving" => ("simulation.integrator", "conserving"),
        "undamped" => ("simulation.spectral_radius", "1"),
        "generalized_alpha" => ("simulation.integrator", "generalized_alpha"),
        _ => panic!("no integrator {name}"),
    }
}

/// The line of `[simulation]` that takes it.
pub fn line(name: &str) -> &'static str {
    match name {
        "conserving" => "integrator = \"conserving\"",
        "undamped" => "spectral_radius = 1",
        "generalized_alpha" => "integrator = \"generalized_alpha\"",
        _ => panic!("no integrator {name}"),
    }
}
