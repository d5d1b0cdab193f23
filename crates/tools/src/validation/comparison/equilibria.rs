//! Both elements on the spring and on the Princeton beam; the element of 2001, which locks.

use super::super::{Section, critical, line, plot, princeton, study};
use super::{BENCHMARKS, Benchmark, ELEMENTS, SAME_MESH, same_mesh, tips};
use ancf14_testing::curves::Curves;
use std::fmt::Write;

const STRIP: &str = include_str!("../strip.toml");

/// Meshes of the spring.
const SPRING_MESHES: [u32; 4] = [20, 40, 80, 160];
/// Meshes of the Princeton beam.
const PRINCETON_MESHES: [u32; 5] = [2, 4, 8, 16, 32];
/// The element of 2001, as a model file writes it.
const OF_2001: [(&str, &str); 2] = [("arm.ancf24_poisson", "true"), ("arm.ancf24_shear", "continuum")];
/// The load of the table of the element of 2001, N, and its angle, degrees.
const LOAD: (f64, f64) = (8.896, 45.0);

pub fn write(section: &mut Section) {
    section.say(
        "The paper compares ANCF14 with ANCF24, the beam of Yakoub and Shabana (2001), which has the three slopes of a section as coordinates: 12 a node instead of 7, \
         shear and a deformable section. Here both run in the same program: the same joints, solver, steps and tolerances, only the element differs \
         (`--set arm.element=ancf24`; [the theory](../mechanics.md), section 10). ANCF14 is the paper's: linear twist, `strain = \"small\"`. ANCF24 is corrected, without Poisson's \
         coupling and with its shear moduli scaled so that its torsional stiffness is the section's; below is what it does without.\n\n\
         With the mesh of the paper, step of [the benchmarks](paper.md). `unknowns`: coordinates and multipliers of the constraints; three more at each node that a joint holds, because the \
         section of ANCF24 must be kept from deforming there. Errors are those of the benchmarks: of the spring the largest error of the force, of the Princeton beam \
         that of the displacement in the stiff direction; its iterations are those of all 21 cases.",
    );
    let [spring, beam, ..] = &BENCHMARKS;
    let springs = ELEMENTS.map(|element| SPRING_MESHES.map(|n| spring.run(element, n, &[])));
    let beams = ELEMENTS.map(|element| PRINCETON_MESHES.map(|n| beam.run(element, n, &[])));
    let mut table = String::from(SAME_MESH);
    table += &same_mesh(spring, [&springs[0][0], &springs[1][0]]);
    table += &same_mesh(beam, [&beams[0][2], &beams[1][2]]);
    section.say(&table);

    section.say("Helical spring, largest error of the force over the elements:");
    let columns = [0, 1].map(|k| (title(k), springs[k].iter().map(|runs| (spring.error)(runs)).collect::<Vec<f64>>()));
    section.say(&study::table("elements", &SPRING_MESHES.map(f64::from), &columns));
    let of = |name: &str| springs[0][0][0].last(name);
    section.say(&format!(
        "ANCF24 is too stiff with few elements. Its axis is a cubic, but the slopes across are linear along the element: the curvature is constant within it, and axis and section do not \
         stay perpendicular, which costs the energy of a shear that is not there. A finer mesh cures that. It passes through the reference on its way; what is left with many elements \
         is a difference of the two theories: a thick curved wire with shear, whose inner fibers are shorter than its outer ones, differs from the rod by a part of \
         the square of wire over coil radius, {}.",
        study::small((of("wire.radius") / of("radius")).powi(2))
    ));

    section
        .say("Princeton beam, largest error over all 21 cases, relative to the largest value of the same component:");
    for (_, label, _, value) in princeton::COMPONENTS {
        section.say(&format!("*{label}*"));
        let of = |k: usize| beams[k].iter().map(|runs| princeton::error(&tips(runs), value)).collect::<Vec<f64>>();
        section.say(&study::table(
            "elements",
            &PRINCETON_MESHES.map(f64::from),
            &[(title(0), of(0)), (title(1), of(1))],
        ));
    }
    section.picture("elements_princeton", errors_over_coordinates(beam, &beams));
    locking(section, beam, &beams);
}

fn title(element: usize) -> String {
    ELEMENTS[element].to_uppercase()
}

/// Error of the stiff displacement over the number of coordinates, both as decimal logarithms.
fn errors_over_coordinates(beam: &Benchmark, beams: &[[Vec<Curves>; 5]; 2]) -> ancf14_report::chart::Chart {
    let twist = [("arm.twist", "quadratic")];
    let quadratic = PRINCETON_MESHES.map(|n| beam.run(ELEMENTS[0], n, &twist));
    let of = |element: &str, more: &[(&str, &str)], meshes: &[Vec<Curves>; 5]| {
        let point = |(n, runs): (&u32, &Vec<Curves>)| {
            ((beam.sizes(element, *n, more).coordinates as f64).log10(), (beam.error)(runs).log10())
        };
        PRINCETON_MESHES.iter().zip(meshes).map(point).collect::<Vec<_>>()
    };
    let lines = vec![
        line("ANCF14", 0, of(ELEMENTS[0], &[], &beams[0])),
        line("ANCF14, quadratic twist", 2, of(ELEMENTS[0], &twist, &quadratic)),
        line("ANCF24", 1, of(ELEMENTS[1], &[], &beams[1])),
    ];
    let axes = ["coordinates (decimal logarithm)", "error (decimal logarithm)"];
    plot("Princeton beam: error of the stiff displacement", axes, lines)
}

/// The element of 2001.
fn locking(section: &mut Section, beam: &Benchmark, beams: &[[Vec<Curves>; 5]; 2]) {
    let reference = princeton::reference();
    let case = reference.iter().position(|row| (row.0, row.1) == LOAD).unwrap();
    let mut table = String::from("| | elements | stiff (mm) | weak (mm) |\n|---|---|---|---|");
    let mut row = |name: &str, elements: &str, tip: &princeton::Tip| {
        // Writing into a String cannot fail.
        let _ = write!(table, "\n| {name} | {elements} | {:.2} | {:.2} |", 1e3 * tip.stiff, 1e3 * tip.weak);
    };
    let keys: Vec<_> = princeton::weight(LOAD.0, LOAD.1).into_iter().collect();
    for (k, n) in PRINCETON_MESHES.iter().enumerate().skip(2) {
        let elements = n.to_string();
        let mut all = vec![("arm.element", ELEMENTS[1]), ("arm.elements", &elements)];
        all.extend(OF_2001);
        all.extend(keys.iter().map(|(key, value)| (*key, value.as_str())));
        row("ANCF24 of 2001", &elements, &princeton::Tip::of(&Curves::run(beam.model, &all)));
        row("ANCF24, corrected", &elements, &tips(&beams[1][k])[case]);
        row("ANCF14", &elements, &tips(&beams[0][k])[case]);
    }
    row("exact rod", "", &reference[case].2);
    let of = |name: &str| beams[0][2][0].last(name);
    let poisson = of("aluminium.poisson");
    let (width, height, torsion) = (of("strip.width"), of("strip.height"), of("strip.torsion_constant"));
    let polar = width * height * (width * width + height * height) / 12.0;
    section.say(&format!(
        "**The element of 2001** has the full material law (`ancf24_poisson = true`, `ancf24_shear = \"continuum\"`), and locks. Its section stays linear: it cannot \
         become a trapezoid, as Poisson's effect has it in bending, so that it resists bending by lambda + 2 G instead of E, here {:.2} times too stiff. And it cannot warp, so \
         that it resists torsion by G (Iy + Iz) instead of G Jt, here {:.2} times too stiff. No mesh helps, because neither is an error of the mesh. The corrected element takes \
         both away. {} N at {} degrees:",
        (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
        polar / torsion,
        LOAD.0,
        LOAD.1
    ));
    section.say(&table);
    section.say(&format!(
        "The correction has a price. The same shear moduli that are scaled for torsion, here by {:.3}, carry the shear forces: the corrected element shears more than a \
         beam does. In the stiff direction that adds 3 EI/(G' A L^2) to the bending, {} of it for this strip, and more for a thinner one. For the strip of the lateral buckling \
         (`crates/tools/src/validation/strip.toml`, 8 elements, a force at its tip) the deflection shows it, the critical force does not:",
        torsion / polar,
        study::small(added_by_shear(poisson, [width, height, torsion], of("arm.to[1]")))
    ));
    section.say(&strip());
}

/// Deflection by shear of a cantilever under a force at its tip over that by bending, with ANCF24's scaled modulus.
fn added_by_shear(poisson: f64, [width, height, torsion]: [f64; 3], length: f64) -> f64 {
    let polar = width * height * (width * width + height * height) / 12.0;
    // E/G = 2 (1 + nu), Iy/A = h^2/12.
    6.0 * (1.0 + poisson) * height * height / 12.0 / (torsion / polar * length * length)
}

/// Deflection and critical force of the thin strip with both elements.
fn strip() -> String {
    let mut table = String::from(
        "| | upwards at 0.8 of the critical force (mm) | critical force over the exact one |\n|---|---|---|",
    );
    for element in ELEMENTS {
        let keys = [("strip.element", element), ("strip.elements", "8")];
        let end =
            Curves::run(STRIP, &[&keys[..], &[("simulation.stop", "0.8"), ("simulation.output_step", "0.8")]].concat());
        let _ = write!(
            table,
            "\n| {} | {:.3} | {:.4} |",
            element.to_uppercase(),
            1e3 * end.last("end.displacement[3]"),
            critical::time(STRIP, &keys, [0.8, 1.2])
        );
    }
    table
}
