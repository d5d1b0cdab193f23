//! A rigid turn must not strain the beam: not once, not after many turns, and the large-strain energy must be what
//! section integration gives.

use crate::elements::element_derivatives::straight;
use crate::random::Random;
use ancf14::math::Vec3;
use ancf14::math::rotation;
use ancf14::math::vectors::{set_vec3, vec3};
use ancf14::mechanics::beam::ancf14::element::Evaluation;
use ancf14::mechanics::beam::ancf14::energy::axial::large;
use ancf14::mechanics::beam::ancf14::energy::bending;
use ancf14::mechanics::beam::ancf14::energy::fourth_moments;
use ancf14::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
use ancf14::mechanics::beam::ancf14::energy::torsion;
use ancf14::mechanics::beam::ancf14::frame::NodeFrame;
use ancf14::mechanics::beam::ancf14::kinematics::Holonomy;
use ancf14::mechanics::beam::ancf14::natural::Natural;
use ancf14::mechanics::beam::ancf14::strain::{Stiffness, Strain, Strains};
use ancf14::mechanics::beam::section::Section;
use ancf14::mechanics::geometry::triad::Triad;

/// 25 turns about an oblique axis in steps of 0.3 rad, references carried along: the energy of a bent and twisted
/// element stays within rounding (about 500 transports of 1e-16 each).
#[test]
fn many_turns_do_not_strain() {
    let mut random = Random(9);
    for strain in [Strain::Small, Strain::Large, Strain::LargeTruncated] {
        let element = straight(0.7, crate::elements::element_derivatives::stiffness(strain));
        let (mut q, mut triads, mut holonomy) =
            crate::elements::element_derivatives::random_element_state(&mut random, 0.7, 0.5, 1.0);
        let axis = random.direction();
        let turn = rotation::rotation_matrix(&(axis * 0.3));
        let energy = |q: &[f64], triads: &[Triad; 2], holonomy: f64| {
            let frames = [NodeFrame::new(&q[..7], &triads[0]), NodeFrame::new(&q[7..], &triads[1])];
            let energy = Evaluation::new(&element, q, [&frames[0], &frames[1]], holonomy, &Natural::default()).energy();
            let next = Holonomy::new(&frames[0], &frames[1], holonomy).angle;
            (energy, [frames[0].carried(), frames[1].carried()], next)
        };
        // Center the references first: then the carried normal is the reference's own.
        (_, triads, holonomy) = energy(q.as_slice(), &triads, holonomy);
        let (before, ..) = energy(q.as_slice(), &triads, holonomy);
        let steps = (25.0 * std::f64::consts::TAU / 0.3_f64).round() as usize;
        let mut after = 0.0;
        for _ in 0..steps {
            for place in [0, 3, 7, 10] {
                let turned = turn * vec3(q.as_slice(), place);
                set_vec3(q.as_mut_slice(), place, &turned);
            }
            // The section turns by the part of the turn that the carried frame does not take: found from the carried
            // triad.
            for node in 0..2 {
                let own = &q.as_slice()[7 * node..7 * node + 7];
                let frame = NodeFrame::new(own, &triads[node]);
                let u_turned = turn * triads[node].u;
                let angle = frame.v.dot(&u_turned).atan2(frame.u.dot(&u_turned));
                q[7 * node + 6] += angle;
            }
            (after, triads, holonomy) = energy(q.as_slice(), &triads, holonomy);
        }
        let change = (after / before - 1.0).abs();
        println!("{strain:?}: {change:.1e} after 25 turns");
        assert!(change < 1e-12, "{change:e}");
    }
}

/// With Jt = Ip the large-strain energy is the integral of E e11²/2 + G tau² r²/2 over the section, `e11` the Green
/// strain of the fiber at (y, z); a 3-point Gauss rule in y and z integrates the quartic exactly, 4 points are used.
#[test]
fn large_energy_is_the_section_integral() {
    let (width, height, young, shear) = (0.03, 0.05, 2.0, 0.7);
    let section = Section::rectangle(width, height);
    let stiffness = Stiffness {
        twist: Twist::Linear,
        strain: Strain::Large,
        axial: young * section.area,
        bending_y: young * section.second_moment_y,
        bending_z: young * section.second_moment_z,
        torsion: shear * section.polar_moment,
        wagner: young * section.polar_moment,
        fourth: section.fourth_moments.map(|moment| young * moment),
        damping: 0.0,
    };
    let bending = stiffness.at_bending_point();
    let gauss = {
        let (a, b) =
            ((3.0_f64 / 7.0 - 2.0 / 7.0 * 1.2_f64.sqrt()).sqrt(), (3.0_f64 / 7.0 + 2.0 / 7.0 * 1.2_f64.sqrt()).sqrt());
        let (wa, wb) = ((18.0 + 30.0_f64.sqrt()) / 72.0, (18.0 - 30.0_f64.sqrt()) / 72.0);
        [(-b / 2.0, wb), (-a / 2.0, wa), (a / 2.0, wa), (b / 2.0, wb)]
    };
    let mut random = Random(10);
    for _ in 0..50 {
        let (g1, g2, tau) = (20.0 * random.signed(), 20.0 * random.signed(), 20.0 * random.signed());
        let stretch: f64 = 1.0 + 0.2 * random.signed();
        let e = 0.5 * (stretch * stretch - 1.0);
        let mut integral = 0.0;
        for (y, weight_y) in gauss {
            for (z, weight_z) in gauss {
                let (y, z) = (y * width, z * height);
                // The fiber at (y, z): r' + y t_y' + z t_z' = (|r'| − g1 y − g2 z, −tau z, tau y).
                let fiber = Vec3::new(stretch - g1 * y - g2 * z, -tau * z, tau * y);
                let e11 = 0.5 * (fiber.norm_squared() - 1.0);
                let density = 0.5 * young * e11 * e11 + 0.5 * shear * tau * tau * (y * y + z * z);
                integral += density * weight_y * weight_z * width * height;
            }
        }
        let strains = Strains::new(g1, g2, tau, e);
        let closed = large::energy(&stiffness.at_axial_point(), e, tau)
            + bending::energy(&bending, &strains)
            + torsion::energy(&bending, &strains)
            + fourth_moments::energy(&bending, &strains);
        assert!((closed / integral - 1.0).abs() < 1e-12, "{closed} {integral}");
    }
}
