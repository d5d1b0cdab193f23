//! Section forces of the constitutive law must be in equilibrium with the loads as well as the mesh allows, and be the
//! derivatives of the energy by the strains; the stress must be the largest on the outline. A wrong sign, axis or coupling gives errors of the size of
//! the forces themselves.

use crate::random::Random;
use crate::support::machines::{ancf14, ancf14_elements, clamp, design, load};
use crate::support::oracle::Scalar;
use ancf14::math::Vec3;
use ancf14::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
use ancf14::mechanics::beam::ancf14::section;
use ancf14::mechanics::beam::ancf14::strain::{Stiffness, Strain};
use ancf14::mechanics::beam::design::BeamDesign;
use ancf14::mechanics::beam::material::Material;
use ancf14::mechanics::beam::resultants::{SectionForces, SectionStrains, largest_stress};
use ancf14::mechanics::beam::section::{Outline, Section};
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::solve::statics::Statics;
use nalgebra::{SVector, Vector4};
use std::f64::consts::{PI, TAU};

const STRAINS: [Strain; 3] = [Strain::Small, Strain::Large, Strain::LargeTruncated];

/// Section forces at `fraction` of the cantilever `beam` with a dead force and moment at its end, beside force and
/// moment that the loads demand there, in section axes of the deformed beam: `[N, T, M_y, M_z]` each.
fn found_and_demanded(beam: &BeamDesign, fraction: f64, force: Vec3, moment: Vec3) -> (Vector4<f64>, Vector4<f64>) {
    let mut builder = SystemBuilder::default();
    let number = builder.add_beam(beam);
    clamp(&mut builder, number);
    load(&mut builder, number, 1.0, force, moment);
    for fraction in [fraction, 1.0] {
        builder.add_sensor(number, fraction);
    }
    let (system, mut state) = builder.finish(Vec3::zeros());
    let mut statics = Statics::new(&system, 1e-10);
    for share in [0.25, 0.5, 0.75, 1.0] {
        statics.find(&system, &mut state, share).unwrap();
    }
    let mut snapshot = FrameCache::default();
    let c = snapshot.of(&system, &state);
    let [here, tip] = [0, 1].map(|i| system.sensors[i].marker.pose(&c));
    // At a node the mean of both elements, whose errors of the slope are opposite.
    let sides = system.sensors[0].sections();
    let stiffness = &ancf14_elements(&system).next().unwrap().stiffness;
    let found = sides.iter().fold(Vector4::zeros(), |sum, side| {
        let SectionForces { axial, moment: [t, my, mz] } = section::forces(stiffness, &side.strains(&c));
        sum + Vector4::new(axial, t, my, mz) / sides.len() as f64
    });
    let demanded_moment = here.axes.tr_mul(&((tip.place - here.place).cross(&force) + moment));
    let along = here.axes.column(0).dot(&force);
    (found, Vector4::new(along, demanded_moment[0], demanded_moment[1], demanded_moment[2]))
}

/// A bar in tension, bending both ways and torsion, small: the linear theory. Cubic elements have it exactly, the bound
/// is the square of the tip's turn, 1e-3.
#[test]
fn cantilever_under_small_loads() {
    for strain in STRAINS {
        let beam = BeamDesign { elements: ancf14(strain, Twist::Linear), ..design("beam", 8) };
        // Ends, a node, the middle of an element and any place in it.
        for fraction in [0.0, 0.25, 0.3125, 0.4, 1.0] {
            let arm = 1.0 - fraction;
            for (force, moment, expected) in [
                (Vec3::x() * 100.0, Vec3::zeros(), [100.0, 0.0, 0.0, 0.0]),
                (Vec3::x() * -100.0, Vec3::zeros(), [-100.0, 0.0, 0.0, 0.0]),
                (Vec3::zeros(), Vec3::x() * 0.1, [0.0, 0.1, 0.0, 0.0]),
                (Vec3::y() * 0.2, Vec3::zeros(), [0.0, 0.0, 0.0, 0.2 * arm]),
                (Vec3::z() * 0.2, Vec3::zeros(), [0.0, 0.0, -0.2 * arm, 0.0]),
                (Vec3::zeros(), Vec3::y() * 0.2, [0.0, 0.0, 0.2, 0.0]),
            ] {
                let (found, demanded) = found_and_demanded(&beam, fraction, force, moment);
                let scale = force.norm() + moment.norm();
                for (found, expected) in [(found, Vector4::from(expected)), (demanded, Vector4::from(expected))] {
                    assert!((found - expected).amax() < 1e-3 * scale, "{strain:?} at {fraction}: {found} {expected}");
                }
            }
        }
    }
}

/// A soft and thick beam that is stretched by 3 %, bent by 0.4 rad and twisted: equilibrium at the deformed place. The
/// moments' errors are those of the element, of order 2; the axial force without `|r'|`, or a dropped coupling, would
/// leave 2e-2 whatever the elements.
#[test]
fn cantilever_under_large_loads() {
    let (force, moment) = (Vec3::new(60.0, -4.0, 10.0), Vec3::new(0.7, 1.0, -1.5));
    for strain in STRAINS {
        for fraction in [0.25, 0.5] {
            let errors = [8, 16, 32].map(|elements| {
                let beam = BeamDesign {
                    elements: ancf14(strain, Twist::Linear),
                    material: Material { young: 1e5, shear: 4e4, density: 1.0, damping: 0.0 },
                    section: Section::rectangle(0.1, 0.2),
                    ..design("beam", elements)
                };
                let (found, demanded) = found_and_demanded(&beam, fraction, force, moment);
                (found - demanded).component_div(&Vector4::new(60.0, 1.0, 1.0, 1.0)).abs()
            });
            let sizes = errors.map(|error| error.amax());
            println!("{strain:?} at {fraction}: {sizes:?}");
            assert!(sizes[1] < 0.3 * sizes[0] && sizes[2] < 0.3 * sizes[1], "{strain:?} at {fraction}: {sizes:?}");
            assert!(sizes[2] < 2e-3, "{strain:?} at {fraction}: {sizes:?}");
        }
    }
}

fn stiffness(section: &Section, young: f64, shear: f64, strain: Strain) -> Stiffness {
    let large = if strain == Strain::Small { 0.0 } else { young };
    let fourth = if strain == Strain::Large { young } else { 0.0 };
    Stiffness {
        twist: Twist::Linear,
        strain,
        axial: young * section.area,
        bending_y: young * section.second_moment_y,
        bending_z: young * section.second_moment_z,
        torsion: shear * section.torsion_constant,
        wagner: large * section.polar_moment,
        fourth: section.fourth_moments.map(|moment| fourth * moment),
        damping: 0.0,
    }
}

fn random_strains(random: &mut Random) -> SectionStrains {
    SectionStrains {
        axial: 0.2 * random.signed(),
        curvature: [20.0 * random.signed(), 20.0 * random.signed()],
        torsion: 20.0 * random.signed(),
    }
}

/// Energy per length, J/m, of a rectangle at `[axial, torsion, about y, about z]`: the integral of `E e11²/2` over the
/// section with `e11` the strain of the fiber at (y, z), and Saint-Venant's. Three Gauss points each way integrate the
/// quartic exactly.
fn energy<D: Scalar>(size: [f64; 2], moduli: [f64; 2], strain: Strain, strains: &[D]) -> D {
    let [axial, torsion, about_y, about_z] = [0, 1, 2, 3].map(|i| strains[i]);
    let points = [(-(0.6_f64.sqrt()), 5.0 / 18.0), (0.0, 8.0 / 18.0), (0.6_f64.sqrt(), 5.0 / 18.0)];
    let jt = Section::rectangle(size[0], size[1]).torsion_constant;
    let mut sum = torsion * torsion * (0.5 * moduli[1] * jt);
    for (y, weight_y) in points {
        for (z, weight_z) in points {
            let (y, z) = (0.5 * size[0] * y, 0.5 * size[1] * z);
            let linear = about_y * z - about_z * y;
            let square = (linear * linear + torsion * torsion * (y * y + z * z)) * 0.5;
            let density = match strain {
                Strain::Small => (axial + linear) * (axial + linear),
                Strain::Large | Strain::LargeTruncated => {
                    let e11 = axial + axial * axial * 0.5 + linear * (axial + 1.0) + square;
                    let dropped = if strain == Strain::Large { 0.0 } else { 1.0 };
                    e11 * e11 - square * square * dropped
                }
            };
            sum += density * (0.5 * moduli[0] * size[0] * size[1] * weight_y * weight_z);
        }
    }
    sum
}

#[test]
fn section_forces_are_derivatives_of_the_section_integral() {
    let (size, moduli) = ([0.03, 0.05], [2e3, 0.7e3]);
    let section = Section::rectangle(size[0], size[1]);
    let mut random = Random(30);
    for strain in STRAINS {
        let stiffness = stiffness(&section, moduli[0], moduli[1], strain);
        for _ in 0..50 {
            let strains = random_strains(&mut random);
            let [about_y, about_z] = strains.curvature;
            let (_, gradient) = num_dual::gradient(
                |x: SVector<num_dual::DualSVec64<4>, 4>| energy(size, moduli, strain, x.as_slice()),
                &Vector4::new(strains.axial, strains.torsion, about_y, about_z),
            );
            let SectionForces { axial, moment: [t, my, mz] } = section::forces(&stiffness, &strains);
            let error = (Vector4::new(axial, t, my, mz) - gradient).component_div(&gradient.map(f64::abs)).amax();
            // Moments may nearly cancel; their own size is what rounding is relative to, times at most 1e3 here.
            assert!(error < 1e-11, "{strain:?}: {error:e}");
        }
    }
}

/// Stress in terms of force and moments, by the formulas of every handbook.
#[test]
fn stress_by_hand() {
    let (young, shear) = (2e11, 8e10);
    let mut random = Random(31);
    let (radius, inner) = (0.02_f64, 0.015_f64);
    let quarter = PI / 4.0;
    for _ in 0..50 {
        let strains = random_strains(&mut random);
        let stress = |section: &Section| {
            let stiffness = stiffness(section, young, shear, Strain::Small);
            let forces = section::forces(&stiffness, &strains);
            let torque = forces.moment[0];
            (largest_stress(&section.outline, young, torque, &strains).unwrap(), forces.axial, forces.moment)
        };
        let check = |found: f64, normal: f64, shear: f64| {
            let expected = (normal.powi(2) + 3.0 * shear.powi(2)).sqrt();
            assert!((found / expected - 1.0).abs() < 1e-3, "{found:e} {expected:e}");
        };
        // 2 × 1: k = 0.246 of the handbooks is 0.24593.
        let (b, h) = (0.02_f64, 0.01_f64);
        let (found, n, [t, my, mz]) = stress(&Section::rectangle(b, h));
        let normal = n.abs() / (b * h) + 6.0 * my.abs() / (b * h * h) + 6.0 * mz.abs() / (h * b * b);
        check(found, normal, t / (0.24593 * b * h * h));
        let (found, n, [t, my, mz]) = stress(&Section::circle(radius));
        let normal = n.abs() / (PI * radius.powi(2)) + my.hypot(mz) / (quarter * radius.powi(3));
        check(found, normal, t / (2.0 * quarter * radius.powi(3)));
        let (found, n, [t, my, mz]) = stress(&Section::tube(inner, radius));
        let fourth = radius.powi(4) - inner.powi(4);
        let normal = n.abs() / (PI * (radius.powi(2) - inner.powi(2))) + my.hypot(mz) * radius / (quarter * fourth);
        check(found, normal, t * radius / (2.0 * quarter * fourth));
        // A torsion constant that is given scales the torque, and the shear with it.
        let mut given = Section::circle(radius);
        given.torsion_constant *= 0.5;
        let (found, n, [t, my, mz]) = stress(&given);
        let normal = n.abs() / (PI * radius.powi(2)) + my.hypot(mz) / (quarter * radius.powi(3));
        check(found, normal, t / (2.0 * quarter * radius.powi(3)));
    }
}

/// The normal stress is the largest that the fibers on the outline have, by their places; an unknown outline has none.
#[test]
fn stress_is_the_largest_of_the_outline() {
    let (young, radius) = (2e11, 0.02);
    let corners: Vec<[f64; 2]> = vec![[0.01, 0.03], [-0.01, 0.03], [0.01, -0.03], [-0.01, -0.03]];
    let around: Vec<[f64; 2]> = (0..3600)
        .map(|i| (f64::from(i) * TAU / 3600.0).sin_cos())
        .map(|(sin, cos)| [radius * cos, radius * sin])
        .collect();
    let mut random = Random(32);
    for (section, places) in [
        (Section::rectangle(0.02, 0.06), &corners),
        (Section::circle(radius), &around),
        (Section::tube(0.01, radius), &around),
    ] {
        for _ in 0..50 {
            let strains = SectionStrains { torsion: 0.0, ..random_strains(&mut random) };
            let [about_y, about_z] = strains.curvature;
            let stresses = places.iter().map(|[y, z]| young * (strains.axial + z * about_y - y * about_z).abs());
            let largest = stresses.fold(0.0, f64::max);
            let found = largest_stress(&section.outline, young, 0.0, &strains).unwrap();
            // Points every 0.1 degrees miss the largest by less than 1e-6.
            assert!((found / largest - 1.0).abs() < 1e-6, "{found:e} {largest:e}");
            assert_eq!(largest_stress(&Outline::General, young, 0.0, &strains), None);
        }
    }
}
