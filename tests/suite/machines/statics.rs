//! Machines at rest: forces, stiffnesses and work against closed forms.

use super::{check, column, last, machine_with, results};
use std::f64::consts::PI;

const ANTI_ROLL_BAR: &str = include_str!("../../machines/anti_roll_bar.toml");
const BOW: &str = include_str!("../../machines/bow.toml");
const FLEXURE_STAGE: &str = include_str!("../../machines/flexure_stage.toml");
const HOT_RAIL: &str = include_str!("../../../models/hot_rail.toml");
const SCISSOR_LIFT: &str = include_str!("../../machines/scissor_lift.toml");
const TENSEGRITY: &str = include_str!("../../machines/tensegrity_prism.toml");
const VALVE_SPRING: &str = include_str!("../../machines/valve_spring.toml");

/// Half of the bar by the energy method: a unit force at the link bends the arm over its length and the back to the
/// bushing and beyond, and twists the back; the bushings are at 0.2333 m from the arms, where the nodes are, and
/// antisymmetric bending ends in the middle. Springs of the bushings included.
#[test]
fn anti_roll_bar_has_the_stiffness_of_the_energy_method() {
    let (young, shear) = (206e9, 206e9 / 2.6);
    let second: f64 = PI * 0.011_f64.powi(4) / 4.0;
    let (arm, half) = (0.25_f64, 0.5_f64);
    // 30 elements share the pieces of 0.25, 1 and 0.25 m: 5, 20 and 5 of 0.05 m; node 8 is 0.15 m inside of the corner.
    let outside = 3.0 * 0.05;
    let inside = half - outside;
    // Moments of a unit force: x over the arm, s over the outer part of the back, falling to 0 in the middle.
    let bending = arm.powi(3) / 3.0 + outside.powi(3) / 3.0 + outside.powi(2) * inside / 3.0;
    let torsion = arm * arm * half;
    // The bushing bears 1 + outside/inside of the force along z, at a distance that multiplies its give by the same
    // factor.
    let lever = 1.0 + outside / inside;
    let give = bending / (young * second) + torsion / (shear * 2.0 * second) + lever * lever / 5e6;
    // Small travel: the arms stay level, as the energy method has them.
    let results = results(ANTI_ROLL_BAR, &[("travel", "1e-4")]);
    let stiffness = last(&results, "force.effort") / 1e-4;
    // The rotational springs of the bushings, 10 N m/rad against GJ/L of 1.8e3, and their share of the arm's turn
    // remain.
    check("stiffness of a side", stiffness, 1.0 / give, 0.01);
}

/// What the archer does by hand is what limbs and string hold: the trapezoidal sum of force and way has an error of
/// second order of the 20 steps.
#[test]
fn bow_stores_the_work_of_the_archer() {
    let results = results(BOW, &[]);
    let (way, force) = (column(&results, "pull.distance"), column(&results, "pull.effort"));
    let work: f64 = (1..way.len()).map(|k| 0.5 * (force[k] + force[k - 1]) * (way[k] - way[k - 1])).sum();
    let change = last(&results, "energy.elastic") - column(&results, "energy.elastic")[0];
    check("stored energy", change, work, 2e-3);
}

/// Two leaves guided at both ends: `24 EI/L³` less the weight's `2·6/5 (P/2)/L`; with `th` thin, stretching stiffens
/// nothing at small way. The stage sinks by `3/5 d²/L` because the leaves keep their lengths.
#[test]
fn flexure_stage_has_stiffness_and_parasitic_motion_of_leaf_springs() {
    let second = 0.02 * 0.3e-3_f64.powi(3) / 12.0;
    let weight = 0.12 * 9.81;
    let stiffness = 24.0 * 200e9 * second / 0.05_f64.powi(3) - 1.2 * weight / 0.05;
    let small = results(FLEXURE_STAGE, &[("force", "0.01")]);
    let moved = last(&small, "stage.displacement[1]") - column(&small, "stage.displacement[1]")[0];
    // Half of the leaves' own weight (0.5 % of the stage's stiffness against it) is left out of the hand calculation:
    // 1.2*0.046*9.81/2/0.05 = 5.4 N/m of 1.7 kN/m.
    check("stiffness", 0.01 / moved, stiffness, 4e-3);
    let large = results(FLEXURE_STAGE, &[]);
    let way = last(&large, "stage.displacement[1]");
    let sinks = column(&large, "stage.displacement[3]")[0] - last(&large, "stage.displacement[3]");
    // The next term of the shape is of the order of (d/L)², 0.2 %.
    check("parasitic motion", sinks, 0.6 * way * way / 0.05, 4e-3);
}

/// A clamped column that cannot give way: beyond `4π² EI/L²` it takes the length that is too much into its deflection,
/// `2/π √(L ΔL)`, of first order in the amplitude; the next term is `(π w/(4 L))²`/2, 2e-5. Before, the walls bear all
/// of the heat, `EA α ΔT`.
#[test]
fn hot_rail_buckles_as_eulers_column() {
    let (young, second, area, length): (f64, f64, f64, f64) = (210e9, 0.02 * 1e-6 / 12.0, 2e-4, 2.0);
    let critical = 4.0 * PI * PI * young * second / (length * length);
    let results = results(HOT_RAIL, &[]);
    let force = column(&results, "wall.reaction_force[1]");
    // At a tenth of the way, 0.29 of the critical force: the load bends the rail by w = 8.5e-5 m, which takes π² w²/(4
    // L²) = 4.5e-9 of the strain of 24e-6, 1.9e-4.
    check("force of the heat", -force[5], young * area * 12e-6 * 2.0, 2.5e-4);
    // Past buckling the force is the critical one, less what the load of 0.5 N bends by itself, 0.5 L³/(192 EI) = 6e-5
    // m of 16 mm: 3.7e-3.
    let alone = 0.5 * length.powi(3) / (192.0 * young * second);
    let middle = last(&results, "middle.displacement[3]");
    check("force of the walls", -force[force.len() - 1], critical * (1.0 - alone / middle), 5e-4);
    let excess = 12e-6 * 20.0 * length - critical * (1.0 - alone / middle) * length / (young * area);
    check("deflection", middle, 2.0 / PI * (length * excess).sqrt(), 1e-3);
}

/// Virtual work: with the foot of a stage pulled in, `F dx = W d(2 h)` for the platform, and `h/2` and `3h/2` for the
/// arms of the stages; `h² = L² − w²`.
#[test]
fn scissor_lift_needs_the_force_of_virtual_work() {
    let mut lift = machine_with(SCISSOR_LIFT, &[]);
    lift.initialize().unwrap();
    let (length, angle): (f64, f64) = (2.0, 0.3);
    let arm = 0.04 * 0.1 * length * 7850.0;
    let weight = 9.81 * (2.0 * 500.0 + 2.0 * arm * 0.5 + 2.0 * arm * 1.5);
    // The arms bend: 5e-4 of the height that the lever multiplies by cot(0.3)² ~ 10.
    let found = lift.value("screw.effort").unwrap();
    check("force of the screw", found.abs(), weight * length * angle.cos() / (length * angle.sin()), 5e-3);
}

/// Each corner in equilibrium: three families of tendons and the struts as force densities, with springs and struts
/// that give way. Its least energy over the turn and the height, minimized here by Newton's iteration of two variables,
/// is that of the machine; the bending of the struts is 0.
#[test]
fn tensegrity_prism_has_the_least_energy() {
    let (radius, height, turn): (f64, f64, f64) = (0.5, 1.0, 150.0_f64.to_radians());
    let third = 2.0 * PI / 3.0;
    let (tendon, strut_area) = (2e4, PI * (0.012_f64.powi(2) - 0.010_f64.powi(2)));
    let side = |r: f64, h: f64, a: f64| (h * h + 2.0 * r * r * (1.0 - a.cos())).sqrt();
    let strut_rest = side(radius, height, turn);
    let short = 0.98;
    let energy = |[r, h, a]: [f64; 3]| {
        let edge = 3.0_f64.sqrt();
        let spring = |length: f64, rest: f64| 0.5 * tendon * (length - rest).max(0.0).powi(2);
        let strut = side(r, h, a);
        // Green's strain of a straight bar.
        let strain = 0.5 * ((strut / strut_rest).powi(2) - 1.0);
        6.0 * spring(r * edge, short * radius * edge)
            + 3.0 * spring(side(r, h, a - third), short * side(radius, height, turn - third))
            + 3.0 * 0.5 * 70e9 * strut_area * strain * strain * strut_rest
    };
    // Newton's iteration by central differences: quadratic, so that their error of 1e-8 does not stay.
    let mut at = [radius, height, turn];
    for _ in 0..50 {
        let eps = 1e-5;
        let moved = |moves: &[(usize, f64)]| {
            let mut place = at;
            moves.iter().for_each(|(i, by)| place[*i] += by);
            energy(place)
        };
        let slope = nalgebra::Vector3::from_fn(|i, _| (moved(&[(i, eps)]) - moved(&[(i, -eps)])) / (2.0 * eps));
        let curve = nalgebra::Matrix3::from_fn(|i, j| {
            (moved(&[(i, eps), (j, eps)]) - moved(&[(i, eps), (j, -eps)]) - moved(&[(i, -eps), (j, eps)])
                + moved(&[(i, -eps), (j, -eps)]))
                / (4.0 * eps * eps)
        });
        let step = curve.lu().solve(&slope).unwrap();
        (0..3).for_each(|i| at[i] -= step[i]);
    }
    let results = results(TENSEGRITY, &[]);
    check("energy", last(&results, "energy.elastic"), energy(at), 1e-4);
    let strain = 0.5 * ((side(at[0], at[1], at[2]) / strut_rest).powi(2) - 1.0);
    let force = 70e9 * strut_area * strain * side(at[0], at[1], at[2]) / strut_rest;
    check("force of a strut", last(&results, "strut.section_force[1]"), force, 1e-3);
}

/// The formula of wound springs, `G d⁴ δ/(8 D³ n)`; of a thin wire with a slope of 0.098, whose square (1 %) the
/// formula leaves out, as it does the curvature of the wire, `(d/D)²` of 2 %.
#[test]
fn valve_spring_has_the_rate_of_wound_springs() {
    let mut spring = machine_with(VALVE_SPRING, &[]);
    spring.initialize().unwrap();
    let rate = 79e9 * 0.004_f64.powi(4) / (8.0 * 0.026_f64.powi(3) * 6.0);
    check("preload", spring.value("retainer.effort").unwrap().abs(), rate * 0.010, 0.03);
}
