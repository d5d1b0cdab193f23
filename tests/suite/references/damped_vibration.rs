//! Kelvin-Voigt damping gives every small vibration the damping ratio `c omega / 2` (MECHANICS 3.8), damping in
//! proportion to mass `a / (2 omega)`: the logarithmic decrement of a cantilever's first bending, torsional and axial
//! vibration must be that of theory, with numerical dissipation and without. What moves rigidly must not be damped: a
//! damping of coordinates instead of strains would bring a spinning beam to rest.

use crate::running::{start, vector};
use crate::support::machines::ancf14;
use crate::support::machines::{clamp, design, energies, integrate};
use crate::support::oscillation::{period_and_decrement, theory};
use ancf14::fmi::Model;
use ancf14::math::Vec3;
use ancf14::mechanics::beam::ancf14::coordinates::{NODE, P, R, THETA};
use ancf14::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
use ancf14::mechanics::beam::ancf14::strain::Strain;
use ancf14::mechanics::beam::design::BeamDesign;
use ancf14::mechanics::beam::material::Material;
use ancf14::mechanics::system::builder::SystemBuilder;
use std::f64::consts::PI;

const KINDS: [(f64, Strain); 2] = [(1.0, Strain::Small), (0.9, Strain::Large)];
const RATIO: f64 = 0.02;
/// Steps a period: the midpoint rule then is off by `(2 pi/100)^2/12`, 3e-4.
const STEPS: u32 = 100;
const ELEMENTS: usize = 8;

/// First vibration of a cantilever of 1 m: circular frequency of theory, the coordinate of the tip that shows it, and
/// its shape at `x`: velocity of that coordinate, and of the slope that goes with it.
struct Mode {
    name: &'static str,
    omega: f64,
    coordinate: usize,
    slope: Option<usize>,
    shape: fn(f64) -> [f64; 2],
}

fn modes(beam: &BeamDesign) -> [Mode; 3] {
    let (material, section) = (&beam.material, &beam.section);
    let bar = |stiffness: f64, inertia: f64| 0.5 * PI * (stiffness / inertia).sqrt();
    let quarter = |x: f64| [(0.5 * PI * x).sin(), 0.5 * PI * (0.5 * PI * x).cos()];
    [
        Mode {
            name: "bending",
            omega: BENDING.powi(2)
                * (material.young * section.second_moment_y / (material.density * section.area)).sqrt(),
            coordinate: R + 2,
            slope: Some(P + 2),
            shape: |x| {
                let sigma = (BENDING.cosh() + BENDING.cos()) / (BENDING.sinh() + BENDING.sin());
                let (z, b) = (BENDING * x, BENDING);
                let value = z.cosh() - z.cos() - sigma * (z.sinh() - z.sin());
                [0.5 * value, 0.5 * b * (z.sinh() + z.sin() - sigma * (z.cosh() - z.cos()))]
            },
        },
        Mode {
            name: "torsion",
            omega: bar(material.shear * section.torsion_constant, material.density * section.polar_moment),
            coordinate: THETA,
            slope: None,
            shape: quarter,
        },
        Mode {
            name: "axial",
            omega: bar(material.young, material.density),
            coordinate: R,
            slope: Some(P),
            shape: quarter,
        },
    ]
}

/// The first root of `cos b cosh b = -1`.
const BENDING: f64 = 1.875_104_068_711_961;

#[test]
fn vibrations_decay_as_theory_says() {
    for ((radius, strain), by_mass) in KINDS.into_iter().zip([false; 2]).chain(KINDS.into_iter().zip([true; 2])) {
        let still = BeamDesign { elements: ancf14(strain, Twist::Linear), ..design("beam", ELEMENTS) };
        for mode in modes(&still) {
            let by_stiffness = if by_mass { 0.0 } else { 2.0 * RATIO / mode.omega };
            let mass_damping = if by_mass { 2.0 * RATIO * mode.omega } else { 0.0 };
            let material = Material { damping: by_stiffness, ..still.material };
            let mut builder = SystemBuilder::default();
            let beam = builder.add_beam(&BeamDesign { material, mass_damping, ..still.clone() });
            clamp(&mut builder, beam);
            let (system, mut state) = builder.finish(Vec3::zeros());
            // An amplitude of 1e-4: squares, which theory leaves out, count 1e-8.
            for node in 0..=ELEMENTS {
                let [value, slope] = (mode.shape)(node as f64 / ELEMENTS as f64).map(|shape| shape * 1e-4 * mode.omega);
                state.velocity[NODE * node + mode.coordinate] = value;
                if let Some(place) = mode.slope {
                    state.velocity[NODE * node + place] = slope;
                }
            }
            let step = 2.0 * PI / mode.omega / f64::from(STEPS);
            let tip = NODE * ELEMENTS + mode.coordinate;
            let drawn = state.q[tip];
            let mut samples = Vec::new();
            integrate(&system, &mut state, radius, (step, 5 * STEPS), |state| samples.push(state.q[tip] - drawn))
                .unwrap();
            let (period, decrement) = period_and_decrement(&samples, step);
            let (period_expected, decrement_expected) = theory(mode.omega, RATIO);
            let errors = [period / period_expected - 1.0, decrement / decrement_expected - 1.0];
            println!("{radius} {}: period off by {:.1e}, decrement by {:.1e}", mode.name, errors[0], errors[1]);
            // Frequencies of 8 elements: 1.6e-3 in torsion (MECHANICS 9), less elsewhere; the damping ratio goes with
            // them.
            assert!(errors[0].abs() < 3e-3 && errors[1].abs() < 1e-2, "{}: {errors:?}", mode.name);
        }
    }
}

/// A damped beam that spins about its largest inertia comes to a steady stretch, and from then on keeps its energy to
/// round-off; what it loses until then is the axial vibration of its sudden start, `rho w^2 L^2 / E` of its energy.
#[test]
fn a_spinning_beam_is_not_damped() {
    for (radius, strain) in KINDS {
        let spin = Vec3::y() * 5.0;
        let base = design("beam", 4);
        // A damping ratio of 0.5 of the first bending vibration, of 107 rad/s.
        let material = Material { damping: 0.01, ..base.material };
        let beam = BeamDesign {
            elements: ancf14(strain, Twist::Linear),
            material,
            velocity: Vec3::new(0.4, 0.1, -0.3) - spin.cross(&Vec3::x()) * 0.5,
            angular_velocity: spin,
            ..base
        };
        let mut builder = SystemBuilder::default();
        builder.add_beam(&beam);
        let (system, mut state) = builder.finish(Vec3::zeros());
        let (mut begin, mut steady) = (f64::NAN, f64::NAN);
        let (mut lost, mut drift) = (0.0_f64, 0.0_f64);
        integrate(&system, &mut state, radius, (2e-3, 2000), |state| {
            let energy: f64 = energies(&system, state).iter().sum();
            if state.time == 0.0 {
                begin = energy;
            }
            if state.time <= 1.0 {
                steady = energy;
            }
            lost = lost.max((energy / begin - 1.0).abs());
            drift = drift.max((energy / steady - 1.0).abs());
        })
        .unwrap();
        let strained = beam.material.density * 25.0 / beam.material.young;
        println!("{radius}: energy changed by {lost:.1e} in all, by {drift:.1e} when steady; strain {strained:.1e}");
        // The strain energy, EA L strain^2, of 2e-5 J, and of the false strain at 5e-4 s as much again, against 2 J.
        assert!(lost < 1e-5, "{radius}: {lost:e}");
        // Round-off of 4000 steps, and of the axial strain.
        assert!(drift < 1e-9, "{radius}: {drift:e}");
    }
}

/// Coefficients from ratios at two frequencies: `ζ = c ω/2 + a/(2 ω)` at both, so that both files give the same motion;
/// with `generalized_alpha` too.
#[test]
fn ratios_at_two_frequencies_are_coefficients() {
    let file = |keys: &str, integrator: &str| {
        format!(
            "format = 1
            [model]
            name = \"arm\"
            gravity = [0, 0, -9.81]
            [material.steel]
            young = 2.1e11
            poisson = 0.3
            density = 7850
            {keys}
            [section.flat]
            shape = \"rectangle\"
            width = 0.02
            height = 0.01
            [beam.arm]
            material = \"steel\"
            section = \"flat\"
            from = [0, 0, 0]
            to = [2, 0, 0]
            elements = 4
            [joint.root]
            type = \"weld\"
            a = \"ground\"
            b = \"arm.start\"
            [output.tip]
            at = \"arm.end\"
            quantities = [\"displacement\"]
            [simulation]
            stop = 1
            step = 0.005
            integrator = \"{integrator}\""
        )
    };
    let ([z1, z2], [w1, w2]) = ([0.05, 0.03], [2.0 * PI * 2.0, 2.0 * PI * 13.0]);
    // From the two equations, by Cramer's rule.
    let determinant = 0.25 * (w1 / w2 - w2 / w1);
    let stiffness = (z1 * 0.5 / w2 - z2 * 0.5 / w1) / determinant;
    let mass = (0.5 * w1 * z2 - 0.5 * w2 * z1) / determinant;
    for (by, w) in [(z1, w1), (z2, w2)] {
        assert!((0.5 * stiffness * w + 0.5 * mass / w - by).abs() < 1e-12);
    }
    let ratios = "damping_ratios = [0.05, 0.03]\ndamping_frequencies = [2, 13]";
    let coefficients = format!("damping = {stiffness}\nmass_damping = {mass}");
    for integrator in ["conserving", "generalized_alpha"] {
        let [one, other] = [ratios, &coefficients].map(|keys| {
            let mut simulation = start(&file(keys, integrator));
            simulation.advance(1.0).unwrap_or_else(|failure| panic!("{}", failure.message));
            vector(&simulation, "tip.displacement")
        });
        assert!((one - other).norm() < 1e-9 && one.norm() > 0.01, "{one} {other}");
    }
}
