//! Sections along a beam: tapered, twisted, unsymmetric, of thin walls, and given by rigidities.

use crate::running::{run, start, value, vector};
use ancf14::fmi::Model;
use ancf14::mechanics::beam::section::{Outline, Section};
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use std::f64::consts::TAU;

/// A cantilever of 2 m along x with the section `section` and the other sections `more`.
fn cantilever(section: &str, elements: usize, more: &str) -> String {
    format!(
        "format = 1
        [model]
        name = \"cantilever\"
        [parameters]
        L = 2
        [material.steel]
        young = 2.1e11
        poisson = 0.3
        density = 7800
        [section.own]
        {section}
        [beam.arm]
        material = \"steel\"
        section = \"own\"
        from = [0, 0, 0]
        to = [\"L\", 0, 0]
        elements = {elements}
        [joint.root]
        type = \"weld\"
        a = \"ground\"
        b = \"arm.start\"
        {more}"
    )
}

const WEDGE: &str = "shape = \"rectangle\"\nwidth = 0.03\nheight = \"0.04*(1 - 0.5*s/L)\"";

/// Statics: a small force across the tip at the end of the run.
const PUSHED: &str = "
[load.tip]
at = \"arm.end\"
force = [0, \"t\", \"2*t\"]
[output.tip]
at = \"arm.end\"
quantities = [\"displacement\", \"rotation\"]
[output.root]
at = \"arm.start\"
quantities = [\"section_moment\"]
[simulation]
analysis = \"static\"
stop = 1
step = 1
";

fn pushed(section: &str, elements: usize, more: &str) -> [f64; 6] {
    let mut simulation = start(&cantilever(section, elements, &format!("{more}\n{PUSHED}")));
    simulation.advance(1.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    let (tip, turn) = (vector(&simulation, "tip.displacement"), vector(&simulation, "tip.rotation"));
    [tip.x, tip.y, tip.z, turn.x, turn.y, turn.z]
}

fn frequencies(section: &str, elements: usize, count: usize) -> Vec<f64> {
    let text = cantilever(section, elements, "[simulation]\nstop = 1");
    let found = start(&text).modes(count).unwrap_or_else(|failure| panic!("{}", failure.message));
    found.modes.iter().map(|mode| mode.eigenvalue.sqrt() / TAU).collect()
}

/// Exponents of the step by which errors fall from one entry to the next, where elements are halved.
fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect()
}

/// Deflection of a wedge whose height halves, by `∫ (L − x)²/EI(x) dx`: `P L³/EI₀ · 2 (4 ln 2 − 2.5)` across its height
/// and `2 (ln 2 − 0.5)` across its width. The rule must keep the element's order 4; forces so small that squares of the
/// rotation are below the last error.
#[test]
fn tapered_cantilevers_bend_as_they_must() {
    let stiffness = |other: f64, size: f64| 2.1e11 * other * size.powi(3) / 12.0;
    let log = 2.0_f64.ln();
    let exact =
        [8.0 / stiffness(0.04, 0.03) * 2.0 * (log - 0.5), 2.0 * 8.0 / stiffness(0.03, 0.04) * 2.0 * (4.0 * log - 2.5)];
    let errors = [2, 4, 8].map(|elements| {
        let found = pushed(WEDGE, elements, "");
        [found[1] / exact[0] - 1.0, found[2] / exact[1] - 1.0].map(f64::abs)
    });
    for axis in [0, 1] {
        let errors = errors.map(|error| error[axis]);
        println!("{errors:?} {:?}", orders(&errors));
        assert!(orders(&errors).iter().all(|order| *order > 3.4), "{errors:?}");
        assert!(errors[2] < 3e-5, "{errors:?}");
    }
}

/// Frequencies (Hz) of a cantilever of length 2 m by Ritz's method with ten polynomials: an independent model, exact to
/// 1e-9 for smooth sections. With the rotary inertia of steel.
fn ritz(rigidity: impl Fn(f64) -> f64, line_density: impl Fn(f64) -> f64) -> Vec<f64> {
    const TERMS: usize = 10;
    let (length, cells) = (2.0, 400);
    let (mut stiffness, mut mass) = (DMatrix::zeros(TERMS, TERMS), DMatrix::zeros(TERMS, TERMS));
    for cell in 0..cells {
        for (point, weight) in
            [(0.5 - 0.6_f64.sqrt() / 2.0, 5.0 / 18.0), (0.5, 4.0 / 9.0), (0.5 + 0.6_f64.sqrt() / 2.0, 5.0 / 18.0)]
        {
            let u = (f64::from(cell) + point) / f64::from(cells);
            // u² (2 u − 1)^k: zero with its slope at the root, and far from parallel.
            let shape = DVector::from_fn(TERMS, |k, _| u * u * (2.0 * u - 1.0).powi(k as i32));
            let second = DVector::from_fn(TERMS, |k, _| {
                let (v, k) = (2.0 * u - 1.0, k as i32);
                let power = |less: i32| if k < less { 0.0 } else { v.powi(k - less) };
                let k = f64::from(k);
                (2.0 * power(0) + 8.0 * k * u * power(1) + 4.0 * k * (k - 1.0) * u * u * power(2)) / (length * length)
            });
            let first = DVector::from_fn(TERMS, |k, _| {
                let (v, k) = (2.0 * u - 1.0, k as i32);
                let power = if k == 0 { 0.0 } else { 2.0 * f64::from(k) * u * u * v.powi(k - 1) };
                (2.0 * u * v.powi(k) + power) / length
            });
            let (x, share) = (u * length, weight * length / f64::from(cells));
            stiffness += &second * second.transpose() * (rigidity(x) * share);
            mass += &shape * shape.transpose() * (line_density(x) * share);
            mass += &first * first.transpose() * (7800.0 / 2.1e11 * rigidity(x) * share);
        }
    }
    let factor = mass.cholesky().unwrap().l();
    let left = factor.solve_lower_triangular(&stiffness).unwrap();
    let standard = factor.solve_lower_triangular(&left.transpose()).unwrap();
    let mut all: Vec<f64> = SymmetricEigen::new((&standard + standard.transpose()) / 2.0)
        .eigenvalues
        .iter()
        .map(|v| v.sqrt() / TAU)
        .collect();
    all.sort_by(f64::total_cmp);
    all
}

/// Mass and stiffness both vary: the two lowest frequencies in each plane, and the order of the first one.
#[test]
fn tapered_cantilevers_swing_as_they_must() {
    let height = |x: f64| 0.04 * (1.0 - 0.25 * x);
    let density = |x: f64| 7800.0 * 0.03 * height(x);
    let flat = ritz(|x| 2.1e11 * height(x) * 0.03_f64.powi(3) / 12.0, density);
    let tall = ritz(|x| 2.1e11 * 0.03 * height(x).powi(3) / 12.0, density);
    let mut exact = vec![flat[0], tall[0], flat[1], tall[1]];
    exact.sort_by(f64::total_cmp);
    let errors = [2, 4, 8].map(|elements| {
        let found = frequencies(WEDGE, elements, 4);
        println!("{elements}: {found:?} {exact:?}");
        found.iter().zip(&exact).map(|(found, exact)| (found / exact - 1.0).abs()).collect::<Vec<_>>()
    });
    assert!(errors[2].iter().all(|error| *error < 1e-3), "{errors:?}");
    let first = errors.map(|errors| errors[0]);
    assert!(orders(&first).iter().all(|order| *order > 3.5), "{first:?}");
}

/// What differs only in how it is written must agree to the accuracy of the equilibrium.
fn assert_alike(what: &str, one: [f64; 6], other: [f64; 6]) {
    let size = one.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let error = one.iter().zip(other).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
    assert!(error < 1e-8 * size, "{what}: {one:?} {other:?}");
}

#[test]
fn a_table_is_an_expression() {
    let table = "shape = \"rectangle\"\nwidth = 0.03\nheight = \"taper(s)\"";
    let rows = "[function.taper]\ntable = [[0, 0.04], [2, 0.02]]";
    assert_alike("table", pushed(WEDGE, 4, ""), pushed(table, 4, rows));
}

/// `EA`, `EI`, `GJ`, the mass and its moments of a rectangle, whose sum is the polar one, instead of shape and material;
/// the moduli of the material in the file.
#[test]
fn rigidities_stand_for_material_and_shape() {
    let (young, shear) = (2.1e11, 2.1e11 / 2.6);
    let Section { area, second_moment_y, second_moment_z, torsion_constant, .. } = Section::rectangle(0.03, 0.04);
    let rigid = format!(
        "shape = \"rigidities\"\nEA = {}\nEI_y = {}\nEI_z = {}\nGJ = {}\nline_density = {}\ninertia_y = {}\ninertia_z = {}",
        young * area,
        young * second_moment_y,
        young * second_moment_z,
        shear * torsion_constant,
        7800.0 * area,
        7800.0 * second_moment_y,
        7800.0 * second_moment_z
    );
    let plain = "shape = \"rectangle\"\nwidth = 0.03\nheight = 0.04";
    let without = |text: String| text.replace("material = \"steel\"", "");
    // The fibers of a rectangle, whose moments have parts of third order, stretch where rigidities do not say so.
    let at = |text: String| {
        let mut simulation = start(&text.replace("elements = 4", "elements = 4\nstrain = \"large\""));
        simulation.advance(1.0).unwrap_or_else(|failure| panic!("{}", failure.message));
        let (tip, turn) = (vector(&simulation, "tip.displacement"), vector(&simulation, "tip.rotation"));
        [tip.x, tip.y, tip.z, turn.x, turn.y, turn.z]
    };
    let bent = PUSHED.replace("2*t", "5e4*t") + "\n[load.turned]\nat = \"arm.end\"\nmoment = [\"1e4*t\", 0, 0]";
    assert_alike("statics", at(cantilever(plain, 4, &bent)), at(without(cantilever(&rigid, 4, &bent))));
    let frequencies = [plain, &rigid].map(|section| {
        let text = cantilever(section, 4, "[simulation]\nstop = 1");
        let text = if section == rigid { without(text) } else { text };
        let found = start(&text).modes(9).unwrap_or_else(|failure| panic!("{}", failure.message));
        found.modes.iter().map(|mode| mode.eigenvalue.sqrt()).collect::<Vec<_>>()
    });
    for (plain, rigid) in frequencies[0].iter().zip(&frequencies[1]) {
        assert!((plain / rigid - 1.0).abs() < 1e-8, "{frequencies:?}");
    }
}

/// A rectangle whose axes are turned by half a radian, and the same section by its integrals in axes that are not
/// turned.
#[test]
fn unsymmetric_bending_is_that_of_turned_axes() {
    let (sin, cos) = 0.5_f64.sin_cos();
    let Section { area, second_moment_y, second_moment_z, torsion_constant, .. } = Section::rectangle(0.02, 0.06);
    let general = format!(
        "shape = \"general\"\narea = {area}\nsecond_moment_y = {}\nsecond_moment_z = {}\nproduct_moment = {}\ntorsion_constant = {torsion_constant}",
        second_moment_z * sin * sin + second_moment_y * cos * cos,
        second_moment_z * cos * cos + second_moment_y * sin * sin,
        (second_moment_z - second_moment_y) * sin * cos
    );
    let turned = cantilever("shape = \"rectangle\"\nwidth = 0.02\nheight = 0.06", 4, PUSHED)
        .replace("elements =", &format!("y_axis = [0, {cos}, {sin}]\n        elements ="));
    let mut simulation = start(&turned);
    simulation.advance(1.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    let (tip, turn) = (vector(&simulation, "tip.displacement"), vector(&simulation, "tip.rotation"));
    assert_alike("turned", pushed(&general, 4, ""), [tip.x, tip.y, tip.z, turn.x, turn.y, turn.z]);
    // Moments in the axes of each section, of the same forces in space: the moment about global y and z at the root.
    let root = vector(&simulation, "root.section_moment");
    let mut simulation = start(&cantilever(&general, 4, PUSHED));
    simulation.advance(1.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    let global = vector(&simulation, "root.section_moment");
    let back = [cos * root.y - sin * root.z, cos * root.z + sin * root.y];
    assert!((global.y - back[0]).hypot(global.z - back[1]) < 1e-6 * global.norm(), "{global} {back:?}");
}

/// A linear twist is a pretwist; another one must converge with the element's order though elements twist linearly.
#[test]
fn sections_twist_along_a_beam() {
    let flat = "shape = \"rectangle\"\nwidth = 0.02\nheight = 0.06";
    let twisted = |twist: &str| format!("{flat}\nturn = \"{twist}\"");
    let pretwisted = cantilever(flat, 4, PUSHED).replace("elements =", "pretwist = 1\n        elements =");
    let mut simulation = start(&pretwisted);
    simulation.advance(1.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    let (tip, turn) = (vector(&simulation, "tip.displacement"), vector(&simulation, "tip.rotation"));
    assert_alike("linear", pushed(&twisted("0.5*s"), 4, ""), [tip.x, tip.y, tip.z, turn.x, turn.y, turn.z]);
    let curved = twisted("0.3*s^2");
    let found = [4, 8, 16, 32].map(|elements| pushed(&curved, elements, "")[2]);
    let changes: Vec<f64> = found.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    println!("{found:?} {:?}", orders(&changes));
    assert!(orders(&changes).iter().all(|order| *order > 3.5), "{found:?}");
}

/// A section that jumps where elements meet: `∫ (L − x)²/EI dx` in two pieces, of which cubic elements are exact.
#[test]
fn steps_of_a_shaft_are_exact_at_nodes() {
    let stepped = "shape = \"circle\"\nradius = [{ until = 1, is = 0.02 }, { is = 0.01 }]";
    let rigidity = |radius: f64| 2.1e11 * std::f64::consts::PI * radius.powi(4) / 4.0;
    let exact = 2.0 * ((8.0 - 1.0) / 3.0 / rigidity(0.02) + 1.0 / 3.0 / rigidity(0.01));
    let found = pushed(stepped, 2, "")[2];
    assert!((found / exact - 1.0).abs() < 1e-6, "{found} {exact}");
}

/// The weight of a wedge is carried by its root, and its center of mass is where it must be.
#[test]
fn tapered_beams_weigh_what_they_must() {
    let text = cantilever(WEDGE, 3, "[output.held]\nat = \"root\"\nquantities = [\"reaction_force\", \"reaction_moment\"]\n[simulation]\nanalysis = \"static\"\nstop = 1\nstep = 1")
        .replace("name = \"cantilever\"", "name = \"cantilever\"\ngravity = [0, 0, -1e-3]");
    let mut simulation = start(&text);
    simulation.advance(1.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    let (force, moment) = (vector(&simulation, "held.reaction_force"), vector(&simulation, "held.reaction_moment"));
    let mass = 7800.0 * 0.03 * 0.04 * 1.5;
    // ∫ x (1 − x/4) dx over ∫ (1 − x/4) dx.
    let arm = (2.0 - 2.0 / 3.0) / 1.5;
    assert!((force.z.abs() / (1e-3 * mass) - 1.0).abs() < 1e-9, "{force}");
    assert!((moment.y.abs() / (1e-3 * mass * arm) - 1.0).abs() < 1e-6, "{moment}");
}

/// A twisted wedge swings under its weight: energy is kept as for every beam, to the tolerance of the steps.
#[test]
fn tapered_beams_keep_energy() {
    let section = format!("{WEDGE}\nturn = \"0.4*s^2\"");
    let text = cantilever(&section, 4, "[simulation]\nstop = 0.5\nstep = 1e-3\nspectral_radius = 1\ntolerance = 1e-10")
        .replace("name = \"cantilever\"", "name = \"cantilever\"\ngravity = [0, 0, -9.81]");
    let mut simulation = start(&text);
    let (mut drift, mut kinetic) = (0.0_f64, 0.0_f64);
    let begin = value(&simulation, "energy.total");
    run(&mut simulation, 0.01, 0.5, |simulation| {
        drift = drift.max((value(simulation, "energy.total") - begin).abs());
        kinetic = kinetic.max(value(simulation, "energy.kinetic"));
    });
    println!("{drift:e} J of {kinetic} J");
    assert!(kinetic > 0.1 && drift < 1e-8 * kinetic, "{drift:e} {kinetic}");
}

/// `∫ y^a z^b dA` over a union of rectangles by a midpoint rule, about its centroid; its error with these cells is
/// below 1e-4 relative.
fn moments(inside: impl Fn(f64, f64) -> bool, [width, height]: [f64; 2]) -> impl Fn(i32, i32) -> f64 {
    const CELLS: u32 = 240;
    let mut points = Vec::new();
    for i in 0..CELLS {
        for j in 0..CELLS {
            let (y, z) =
                (width * (f64::from(i) + 0.5) / f64::from(CELLS), height * (f64::from(j) + 0.5) / f64::from(CELLS));
            if inside(y, z) {
                points.push((y, z));
            }
        }
    }
    let cell = width * height / f64::from(CELLS * CELLS);
    let count = points.len() as f64;
    let (y, z) = points.iter().fold((0.0, 0.0), |(sum_y, sum_z), (y, z)| (sum_y + y / count, sum_z + z / count));
    move |a, b| points.iter().map(|(own_y, own_z)| (own_y - y).powi(a) * (own_z - z).powi(b)).sum::<f64>() * cell
}

/// Whether y and z are in a section.
type Inside = Box<dyn Fn(f64, f64) -> bool>;

/// Areas, second moments and fourth moments of thin walls against a midpoint rule, the last ones in principal axes.
#[test]
fn integrals_of_walls_are_those_of_their_area() {
    let (w, h, web, flange) = (0.08, 0.12, 0.01, 0.015);
    let middle = move |y: f64| (y - w / 2.0).abs() < web / 2.0;
    let shapes: [(&str, Section, Inside); 5] = [
        ("i", Section::i_beam(w, h, web, flange), Box::new(move |y, z| z < flange || z > h - flange || middle(y))),
        ("box", Section::hollow(w, h, web), Box::new(move |y, z| y < web || y > w - web || z < web || z > h - web)),
        ("channel", Section::channel(w, h, web, flange), Box::new(move |y, z| y < web || z < flange || z > h - flange)),
        ("tee", Section::tee(w, h, web, flange), Box::new(move |y, z| z > h - flange || middle(y))),
        ("angle", Section::angle(w, h, web), Box::new(move |y, z| y < web || z < web)),
    ];
    for (name, section, inside) in &shapes {
        let moment = moments(inside, [w, h]);
        let (angle, [about_y, about_z]) = section.principal_axes();
        let (sin, cos) = angle.sin_cos();
        let near = |what: &str, found: f64, exact: f64, size: f64| {
            assert!((found - exact).abs() < 1e-3 * size, "{name}: {what} {found:e} {exact:e}");
        };
        near("area", section.area, moment(0, 0), section.area);
        let size = section.polar_moment;
        near("about y", section.second_moment_y, moment(0, 2), size);
        near("about z", section.second_moment_z, moment(2, 0), size);
        near("product", section.product_moment, moment(1, 1), size);
        near(
            "principal z",
            about_z,
            cos * cos * moment(2, 0) + 2.0 * sin * cos * moment(1, 1) + sin * sin * moment(0, 2),
            size,
        );
        near(
            "principal y",
            about_y,
            sin * sin * moment(2, 0) - 2.0 * sin * cos * moment(1, 1) + cos * cos * moment(0, 2),
            size,
        );
        // (cos y + sin z)^m (cos z − sin y)^n by the binomial theorem.
        let turned = |m: i32, n: i32| {
            let choose = |n: i32, k: i32| (1..=k).map(|i| f64::from(n + 1 - i) / f64::from(i)).product::<f64>();
            let mut sum = 0.0;
            for i in 0..=m {
                for j in 0..=n {
                    let factor =
                        choose(m, i) * choose(n, j) * cos.powi(m - i) * sin.powi(i) * cos.powi(n - j) * (-sin).powi(j);
                    sum += factor * moment(m - i + j, i + n - j);
                }
            }
            sum
        };
        let [yyyy, yyzz, zzzz] = section.fourth_moments;
        let size = yyyy + zzzz;
        near("yyyy", yyyy, turned(4, 0), size);
        near("yyzz", yyzz, turned(2, 2), size);
        near("zzzz", zzzz, turned(0, 4), size);
        // Every corner is a point of the outline, and none of the area is beyond them.
        let Outline::Walls { corners, .. } = section.outline else { panic!("{name} has walls") };
        let extent = |axis: usize| {
            let all = corners.iter().map(|corner| corner[axis]);
            all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
        };
        near("width", extent(0), w, w);
        near("height", extent(1), h, h);
    }
}

/// Bredt's and Saint-Venant's constants of thin walls, and the ellipse's, from the textbooks' formulas.
#[test]
fn torsion_constants_of_shapes() {
    // A thin square box: (a − t)³ t; its shear T/(2 A t).
    let tube = Section::hollow(0.1, 0.1, 0.002);
    assert!((tube.torsion_constant / (0.098_f64.powi(3) * 0.002) - 1.0).abs() < 1e-12);
    assert!((tube.outline.torsion_modulus().unwrap() / (2.0 * 0.098 * 0.098 * 0.002) - 1.0).abs() < 1e-12);
    // An open section: Σ b t³/3 (1 − 0.63 t/b).
    let open = Section::channel(0.06, 0.1, 0.004, 0.004);
    let piece = |b: f64, t: f64| b * t.powi(3) / 3.0 * (1.0 - 0.63 * t / b);
    assert!((open.torsion_constant / (piece(0.1, 0.004) + 2.0 * piece(0.056, 0.004)) - 1.0).abs() < 1e-3);
    // A round ellipse is a circle.
    let (round, circle) = (Section::ellipse(0.02, 0.02), Section::circle(0.01));
    for (a, b) in
        [(round.torsion_constant, circle.torsion_constant), (round.fourth_moments[1], circle.fourth_moments[1])]
    {
        assert!((a / b - 1.0).abs() < 1e-12);
    }
    assert!((round.outline.torsion_modulus().unwrap() / circle.outline.torsion_modulus().unwrap() - 1.0).abs() < 1e-12);
}
