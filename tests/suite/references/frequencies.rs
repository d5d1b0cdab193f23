//! Cantilever frequencies from the constant mass matrix and the Hessian at rest, by a dense eigenproblem, against the
//! closed forms.

use crate::support::machines::design;
use ancf14::math::Vec3;
use ancf14::math::blocks::Blocks;
use ancf14::mechanics::beam::design::BeamDesign;
use ancf14::mechanics::input::excitation::Excitation;
use ancf14::mechanics::marker::configuration::Passage;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::mechanics::system::mass::MassAt;
use nalgebra::{DMatrix, SymmetricEigen};
use std::f64::consts::PI;

fn dense(system: &System, blocks: &Blocks) -> DMatrix<f64> {
    let size = system.coordinates();
    let mut matrix = DMatrix::zeros(size, size);
    let mut unit = vec![0.0; size];
    for column in 0..size {
        unit[column] = 1.0;
        blocks.multiply_add(&unit, matrix.column_mut(column).as_mut_slice());
        unit[column] = 0.0;
    }
    matrix
}

/// Angular frequencies of a cantilever, ascending, rad/s. A clamp leaves only the size of the root's slope free.
fn frequencies(beam: &BeamDesign) -> Vec<f64> {
    let mut builder = SystemBuilder::default();
    builder.add_beam(beam);
    let (system, state) = builder.finish(Vec3::zeros());
    let mut snapshot = FrameCache::default();
    let configuration = snapshot.of(&system, &state);
    let mut blocks = Blocks::default();
    system.push_tangent_blocks(&mut blocks);
    let mut forces = vec![0.0; system.coordinates()];
    system.forces_and_tangent(&configuration, &Passage::Rest, &Excitation::default(), 1.0, &mut forces, &mut blocks);
    let stiffness = dense(&system, &blocks);
    blocks.clear();
    system.add_mass(MassAt::CONSTANT, 1.0, &mut blocks);
    let mass = dense(&system, &blocks);
    let free: Vec<usize> = (0..system.coordinates()).filter(|i| *i == 3 || *i >= 7).collect();
    let pick = |matrix: &DMatrix<f64>| matrix.select_rows(&free).select_columns(&free);
    let factor = pick(&mass).cholesky().unwrap().l();
    let left = factor.solve_lower_triangular(&pick(&stiffness)).unwrap();
    let standard = factor.solve_lower_triangular(&left.transpose()).unwrap();
    let mut values: Vec<f64> =
        SymmetricEigen::new((&standard + standard.transpose()) / 2.0).eigenvalues.iter().map(|v| v.sqrt()).collect();
    values.sort_by(f64::total_cmp);
    values
}

/// Errors that MECHANICS 9 predicts for 8 elements: 2.1e-6, 8.0e-5, 1.6e-3, 6.2e-7; a consistent mass matrix with a
/// wrong entry misses by percents.
#[test]
fn eight_elements_find_the_closed_forms() {
    let beam = design("beam", 8);
    let found = frequencies(&beam);
    let (material, section) = (&beam.material, &beam.section);
    let bending =
        |root: f64, moment: f64| root * root * (material.young * moment / (material.density * section.area)).sqrt();
    let torsion =
        0.5 * PI * (material.shear * section.torsion_constant / (material.density * section.polar_moment)).sqrt();
    let axial = 0.5 * PI * (material.young / material.density).sqrt();
    let weak = section.second_moment_z;
    let cases = [
        ("first bending", bending(1.875_104_068_711_961, weak), 3e-6),
        ("second bending", bending(4.694_091_132_974_175, weak), 1e-4),
        ("first bending, stiff side", bending(1.875_104_068_711_961, section.second_moment_y), 3e-6),
        ("torsion", torsion, 2e-3),
        ("axial", axial, 1e-6),
    ];
    for (name, exact, bound) in cases {
        let nearest = found
            .iter()
            .fold(f64::INFINITY, |best: f64, f| if (f - exact).abs() < (best - exact).abs() { *f } else { best });
        let error = (nearest / exact - 1.0).abs();
        println!("{name}: {error:.2e}");
        assert!(error < bound, "{name}: {nearest} against {exact}: {error:e}");
    }
}
