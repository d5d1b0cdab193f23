//! Small machines that several tests use, built without a model file.

use ancf14::error::Error;
use ancf14::math::jet::Jet;
use ancf14::math::{Mat3, Vec3};
use ancf14::mechanics::beam::ancf14::element;
use ancf14::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
use ancf14::mechanics::beam::ancf14::natural::Prestress;
use ancf14::mechanics::beam::ancf14::strain::Strain;
use ancf14::mechanics::beam::ancf24;
use ancf14::mechanics::beam::centerline::Centerline;
use ancf14::mechanics::beam::design::{BeamDesign, Elements, Torsion};
use ancf14::mechanics::beam::element::AnyElement;
use ancf14::mechanics::beam::material::Material;
use ancf14::mechanics::beam::section::Section;
use ancf14::mechanics::constraint::joint::Joint;
use ancf14::mechanics::constraint::primitive::Primitive;
use ancf14::mechanics::constraint::weld;
use ancf14::mechanics::force::load::{Direction, Load, LoadGuide, Site};
use ancf14::mechanics::geometry::pose::Pose;
use ancf14::mechanics::input::signal::Signal;
use ancf14::mechanics::marker::Marker;
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::model::builder;
use ancf14::model::document::Document;
use ancf14::solve::dynamics::midpoint::Midpoint;
use ancf14::solve::dynamics::start::{self, Dynamics};
use ancf14::solve::step::integrator::Integrator;
use std::sync::Arc;

/// ANCF14 that may twist.
pub fn ancf14(strain: Strain, twist: Twist) -> Elements {
    Elements::Ancf14 { strain, twist, torsion: Torsion::Free }
}

/// The elements of a machine that has only those of ANCF14.
pub fn ancf14_elements(system: &System) -> impl Iterator<Item = &element::Element> {
    system.mesh.elements.iter().map(|element| match element {
        AnyElement::Ancf14(element) => element,
        AnyElement::PaidOut(_) | AnyElement::Ancf24(_) => panic!("another element than one of ANCF14"),
    })
}

/// The elements of a machine that has only those of ANCF24.
pub fn ancf24_elements(system: &System) -> impl Iterator<Item = &ancf24::element::Element> {
    system.mesh.elements.iter().map(|element| match element {
        AnyElement::Ancf24(element) => &**element,
        AnyElement::Ancf14(_) | AnyElement::PaidOut(_) => panic!("an element of ANCF14"),
    })
}

/// A steel-like beam of 1 m along x.
pub fn design(name: &str, elements: usize) -> BeamDesign {
    BeamDesign {
        name: name.into(),
        line: Centerline::straight(Vec3::zeros(), Vec3::x(), elements),
        y_axis: Vec3::y(),
        pretwist: 0.0,
        material: Material { young: 2e11, shear: 8e10, density: 7800.0, damping: 0.0 },
        section: Section::rectangle(0.01, 0.02),
        profile: None,
        mass_damping: 0.0,
        tension_damping: 0.0,
        prestress: Prestress::default(),
        elements: ancf14(Strain::Small, Twist::Linear),
        velocity: Vec3::zeros(),
        angular_velocity: Vec3::zeros(),
        rotary_inertia: false,
    }
}

/// A joint of `primitives` between the ground and the node of `beam` at `fraction`, at that node.
pub fn hold(
    builder: &mut SystemBuilder,
    name: &str,
    beam: usize,
    fraction: f64,
    axes: &Mat3,
    primitives: &'static [Primitive],
) {
    let node = builder.node_at(beam, fraction).unwrap();
    let place = builder.drawn(&builder.section_at(beam, fraction)).place;
    let joint = Joint {
        name: format!("joint {name}"),
        a: Marker::Ground(Pose { place, axes: *axes }),
        b: builder.tied(&builder.node(node), &Pose { place, axes: *axes }),
        primitives,
        drive: None,
        gear: None,
        slide: None,
        holding: None,
    };
    builder.add_joint(joint);
}

/// Clamps the start of `beam`.
pub fn clamp(builder: &mut SystemBuilder, beam: usize) {
    hold(builder, "root", beam, 0.0, &Mat3::identity(), weld::PRIMITIVES);
}

/// A dead force and moment on the section of `beam` at `fraction`; they grow in proportion to time and are there in
/// full at 1 s.
pub fn load(builder: &mut SystemBuilder, beam: usize, fraction: f64, force: Vec3, moment: Vec3) {
    let marker = builder.section_at(beam, fraction);
    let growing = |v: Vec3| {
        [0, 1, 2].map(|i| Signal::Function(Arc::new(move |time| Jet { value: v[i] * time, first: v[i], second: 0.0 })))
    };
    builder.add_load(Load {
        name: "load".into(),
        site: Site::Point(marker),
        guide: LoadGuide::Signals { force: growing(force), moment: growing(moment) },
        direction: Direction::Global,
    });
}

/// Small enough that what Newton leaves of a step does not show in momenta and energies: what it leaves is a hundredth
/// of it, and ten thousand times it of the first correction.
const TOLERANCE: f64 = 1e-12;

/// Integrates from the state as drawn by the midpoint rule: see [`march`].
pub fn integrate(
    system: &System,
    state: &mut State,
    spectral_radius: f64,
    steps: (f64, u32),
    watch: impl FnMut(&State),
) -> Result<(), Error> {
    march(system, state, &mut Midpoint::new(system, spectral_radius, steps.0, TOLERANCE), steps, watch)
}

/// Integrates from the state as drawn: projects the velocities, takes `count` steps of `step` and shows each state to
/// `watch`.
pub fn march(
    system: &System,
    state: &mut State,
    integrator: &mut (impl Integrator + Dynamics),
    (step, count): (f64, u32),
    mut watch: impl FnMut(&State),
) -> Result<(), Error> {
    start::check_assembled(system, state)?;
    start::set_motion(system, integrator, state)?;
    let begin = state.time;
    watch(state);
    for number in 1..=count {
        integrator.step(system, state, step, begin + f64::from(number) * step)?;
        watch(state);
    }
    Ok(())
}

/// The system and the state that a model file draws.
pub fn built(text: &str) -> (System, State) {
    let document = Document::parse("model.toml", text, &[]).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let built = builder::build(&document, 0.0).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    (built.system, built.state)
}

/// Runs a model by `steps.1` internal steps of `steps.0` s with the spectral radius `radius`: by what its energy
/// changes beyond the work that is accounted for, J, and by how much it changes, J.
pub fn drift(text: &str, radius: f64, steps: (f64, u32)) -> [f64; 2] {
    let document = Document::parse("model.toml", text, &[]).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let built = builder::build(&document, 0.0).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let (system, mut state) = (built.system, built.state);
    let mut energies = Vec::new();
    // Newton leaves 1e-11 of the first correction of a step, which is 1e-3.
    let mut midpoint = Midpoint::new(&system, radius, steps.0, 1e-14);
    march(&system, &mut state, &mut midpoint, steps, |state| {
        energies.extend(state.balance.last.map(|last| last.kinetic + last.elastic));
    })
    .unwrap_or_else(|failure| panic!("{failure}"));
    [state.balance.drift(), energies[energies.len() - 1] - energies[0]]
}

/// Kinetic, elastic and gravity energy, J.
pub fn energies(system: &System, state: &State) -> [f64; 3] {
    let mut snapshot = FrameCache::default();
    let configuration = snapshot.of(system, state);
    [
        system.kinetic_energy(&configuration, &state.velocity),
        system.elastic_energy(&configuration),
        system.gravity_energy(&configuration),
    ]
}
