//! Damping of tension: it must damp the axial strain alone, linear in its rate, and its energy must be accounted for.

use crate::curves::Curves;

/// A wire of 1 m with a block at its end, pulled along the wire by 2 N until the start and across by 0.02 N.
fn wire(more: &str, integrator: &str) -> String {
    format!(
        "format = 1
        [model]
        name = \"wire\"
        [section.wire]
        shape = \"rigidities\"
        EA = 1e4
        EI_y = 1
        EI_z = 1
        GJ = 1
        line_density = 0.003
        [beam.wire]
        section = \"wire\"
        from = [0, 0, 0]
        to = [1, 0, 0]
        elements = 4
        {more}
        [body.block]
        mass = 1
        position = [1, 0, 0]
        inertia = [1e-6, 1e-6, 1e-6]
        [joint.root]
        type = \"weld\"
        a = \"ground\"
        b = \"wire.start\"
        [joint.end]
        type = \"weld\"
        a = \"wire.end\"
        b = \"block\"
        [load.hand]
        at = \"wire.end\"
        force = [[{{ until = 0, is = \"2*(t + 1)\" }}, {{ is = 0 }}], [{{ until = 0, is = \"0.02*(t + 1)\" }}, {{ is = 0 }}], 0]
        [output.end]
        at = \"wire.end\"
        quantities = [\"displacement\"]
        [simulation]
        initial = \"equilibrium\"
        preload = 1
        stop = 0.5
        {integrator}
        output_step = 1e-3
        totals = [\"energy\", \"work\"]"
    )
}

/// One mass on a spring EA/L with the damper c EA/L: `ω² = EA/L/(m + ρ A L/3)`, and amplitudes fall as
/// `exp(−c ω² t/2)`. The wire's own waves, and steps of 0.02 of a period, leave 1e-3.
#[test]
fn stretching_decays_as_a_mass_on_a_damped_spring() {
    let damping = 1e-3;
    for integrator in ["step = 2e-4", "step = 2e-4\nintegrator = \"generalized_alpha\"\nspectral_radius = 1"] {
        // Across it would be shorter by the square of its bending.
        let text = wire(&format!("tension_damping = {damping}"), integrator).replace("0.02*(t + 1)", "0");
        let curves = Curves::run(&text, &[]);
        let along = curves.column("end.displacement[1]");
        let square: f64 = 1e4 / (1.0 + 0.003 / 3.0);
        let decay = 0.5 * damping * square;
        let frequency = (square - decay * decay).sqrt();
        let error = curves.time.iter().zip(&along).fold(0.0_f64, |error, (time, found)| {
            let wanted =
                (-decay * time).exp() * ((frequency * time).cos() + decay / frequency * (frequency * time).sin());
            error.max((found / along[0] - wanted).abs())
        });
        println!("{integrator}: {error:e}");
        assert!(error < 1e-3, "{integrator}: {error:e}");
    }
}

/// What the damper takes is missing from the energy. The rest is what the steps take, of second order in 0.02 rad: 1e-4
/// of the energy at most.
#[test]
fn its_energy_is_accounted_for() {
    let curves = Curves::run(&wire("tension_damping = 1e-3", "step = 2e-4"), &[]);
    let [total, taken] = ["energy.total", "work.dissipated"].map(|name| curves.column(name));
    let rest = |(now, taken): (&f64, &f64)| (now - total[0] + taken.abs()).abs();
    let worst = total.iter().zip(&taken).map(rest).fold(0.0, f64::max);
    let last = taken.last().copied().unwrap_or_default().abs();
    println!("{worst:e} of {} J, taken {last}", total[0]);
    assert!(last > 0.5 * total[0] && worst < 1e-4 * total[0], "{worst:e} {last} {}", total[0]);
}

/// A swing across the wire, so small that it does not stretch it, keeps its amplitude where a material with the same
/// coefficient loses it.
#[test]
fn bending_is_not_damped() {
    let across = |more: &str| {
        let curves =
            Curves::run(&wire(more, "step = 2e-3\nspectral_radius = 1").replace("stop = 0.5", "stop = 8"), &[]);
        let found = curves.column("end.displacement[2]");
        found.iter().rev().take(4000).fold(0.0_f64, |most, value| most.max(value.abs())) / found[0].abs()
    };
    let [tension, none] = [across("tension_damping = 1e-2"), across("")];
    println!("{tension} {none}");
    assert!((tension / none - 1.0).abs() < 1e-3, "{tension} {none}");
}
