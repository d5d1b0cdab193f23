//! Joints, rigid bodies and drives: conditions with their derivatives by coordinates and time against automatic
//! differentiation of the definitions, at random pose, offset and axes, between everything that can be joined.

use crate::random::Random;
use crate::support::marker_oracle::{All, COUNT, Dual, Machine, ROUNDING, SIDES, any_marker, deep, measure, spread};
use crate::support::oracle::{self, Scalar};
use ancf14::math::jet::Jet;
use ancf14::mechanics::constraint::cylindrical;
use ancf14::mechanics::constraint::driven::Driven;
use ancf14::mechanics::constraint::gear::{CamLaw, GearSide};
use ancf14::mechanics::constraint::inline;
use ancf14::mechanics::constraint::inplane;
use ancf14::mechanics::constraint::joint::{Joint, JointGradient};
use ancf14::mechanics::constraint::primitive::Primitive;
use ancf14::mechanics::constraint::prismatic;
use ancf14::mechanics::constraint::revolute;
use ancf14::mechanics::constraint::rigidity;
use ancf14::mechanics::constraint::spherical;
use ancf14::mechanics::constraint::universal;
use ancf14::mechanics::constraint::weld;
use ancf14::mechanics::geometry::marker_jacobian::MarkerMatrix;
use ancf14::mechanics::marker::relative_coordinate::Measure;
use nalgebra::SVector;
use std::sync::Arc;

/// lambda · phi of a joint over any dual number.
fn weighted_conditions<D: Scalar>(machine: &Machine, joint: &Joint, lambda: &[f64], q: &[D]) -> D {
    let (a, b) = (machine.pose(&joint.a, q), machine.pose(&joint.b, q));
    let mut rows = Vec::new();
    for primitive in joint.primitives {
        match *primitive {
            Primitive::Coincident => {
                let apart: [D; 3] = std::array::from_fn(|i| a[0][i] - b[0][i]);
                rows.extend((0..3).map(|axis| oracle::dot(&a[1 + axis], &apart)));
            }
            Primitive::Parallel(i) => {
                rows.extend([1, 2].map(|next| oracle::dot(&a[1 + i], &b[1 + (i + next) % 3])));
            }
            Primitive::Unturned(i) => rows.push(oracle::dot(&a[1 + (i + 1) % 3], &b[1 + (i + 2) % 3])),
            Primitive::Perpendicular(i, j) => rows.push(oracle::dot(&a[1 + i], &b[1 + j])),
            Primitive::Measured(kind) => {
                let prescribed = if joint.drive.is_some() { machine.driven(q) } else { D::from(0.0) };
                let value = measure(kind, &a, &b) - prescribed;
                // Angles are compared within half a turn.
                let turns =
                    if matches!(kind, Measure::Angle(_)) { (value.re() / std::f64::consts::TAU).round() } else { 0.0 };
                let value = value - std::f64::consts::TAU * turns;
                rows.push(match &joint.gear {
                    None => value,
                    Some(GearSide { factor, law: None, .. }) => value * *factor,
                    Some(GearSide { factor, .. }) => cam(value) * *factor,
                });
            }
            Primitive::Rigid(i, j) if i == j => rows.push((oracle::dot(&b[1 + i], &b[1 + i]) - 1.0) * 0.5),
            Primitive::Rigid(i, j) => rows.push(oracle::dot(&b[1 + i], &b[1 + j])),
        }
    }
    assert_eq!(rows.len(), lambda.len());
    rows.into_iter().zip(lambda).fold(D::from(0.0), |sum, (row, lambda)| sum + row * *lambda)
}

/// The law of a cam, over any dual number.
fn cam<D: Scalar>(x: D) -> D {
    x * CAM[0] + x * x * CAM[1] + x * x * x * CAM[2]
}

/// Its coefficients.
const CAM: [f64; 3] = [0.3, 0.7, -0.2];

/// The same with two derivatives.
fn cam_law() -> CamLaw {
    let [a, b, c] = CAM;
    CamLaw(Arc::new(move |x| Jet {
        value: x * (a + x * (b + x * c)),
        first: a + x * (2.0 * b + x * 3.0 * c),
        second: 2.0 * b + x * 6.0 * c,
    }))
}

fn check_joint(machine: &Machine, joint: &Joint, random: &mut Random) {
    let rows = joint.rows();
    let lambda: Vec<f64> = (0..rows).map(|_| random.signed()).collect();
    let conditions = |q: All<Dual>| weighted_conditions(machine, joint, &lambda, q.as_slice());
    let (value, gradient, hessian) = num_dual::hessian(conditions, &machine.all());
    let c = machine.configuration();
    let weighted = |rows: &[f64]| rows.iter().zip(&lambda).map(|(row, lambda)| row * lambda).sum::<f64>();
    let mut phi = vec![0.0; rows];
    joint.phi(&c, &mut phi);
    assert!((weighted(&phi) - value).abs() < ROUNDING);

    let mut own = JointGradient::default();
    joint.phi_q(&c, &mut own);
    let mut closed = SVector::<f64, COUNT>::zeros();
    for (marker, block) in [(&joint.a, own.a), (&joint.b, own.b)] {
        for (local, index) in marker.coordinates(&machine.mesh).enumerate() {
            closed[index] += (0..rows).map(|row| lambda[row] * block[(row, local)]).sum::<f64>();
        }
    }
    assert!((closed - gradient.fixed_rows::<COUNT>(0)).amax() < ROUNDING * gradient.amax().max(1.0));

    let (mut same, mut blocks) = (JointGradient::default(), [MarkerMatrix::zeros(); 4]);
    joint.phi_q_and_qq(&c, &lambda, &mut same, &mut blocks);
    assert_eq!(same, own);
    let closed = spread(machine, [&joint.a, &joint.b], &blocks);
    let error = (closed - hessian.fixed_view::<COUNT, COUNT>(0, 0)).amax() / hessian.amax().max(1.0);
    assert!(error < ROUNDING, "{error:e}");

    let mut phi_t = vec![0.0; rows];
    joint.phi_t(&c, &mut phi_t);
    assert!((weighted(&phi_t) - gradient[COUNT]).abs() < ROUNDING);

    // Along q + v t, as frames and drives move: the second derivative by t.
    let mut along = All::<f64>::zeros();
    along.fixed_rows_mut::<COUNT>(0).copy_from(&machine.velocity);
    along[COUNT] = 1.0;
    let mut phi_tt = vec![0.0; rows];
    joint.phi_tt(&c, machine.velocity.as_slice(), &mut phi_tt);
    let expected = along.dot(&(hessian * along));
    assert!((weighted(&phi_tt) - expected).abs() < ROUNDING * hessian.amax().max(1.0) * 100.0, "{phi_tt:?} {expected}");
}

#[test]
fn joint_derivatives() {
    deep(check_joint_derivatives);
}

fn check_joint_derivatives() {
    let kinds: [(&'static [Primitive], usize); 9] = [
        (weld::PRIMITIVES, 6),
        (spherical::PRIMITIVES, 3),
        (revolute::PRIMITIVES, 5),
        (cylindrical::PRIMITIVES, 4),
        (prismatic::PRIMITIVES, 5),
        (universal::PRIMITIVES, 4),
        (inline::PRIMITIVES, 2),
        (inplane::PRIMITIVES, 1),
        (rigidity::PRIMITIVES, 6),
    ];
    let mut random = Random(7);
    for (primitives, rows) in kinds {
        for sides in SIDES {
            let machine = Machine::new(&mut random);
            let [a, b] = sides.map(|kind| any_marker(&mut random, kind));
            let joint =
                Joint { name: "joint".into(), a, b, primitives, drive: None, gear: None, slide: None, holding: None };
            assert_eq!(joint.rows(), rows);
            check_joint(&machine, &joint, &mut random);
        }
    }
}

/// Drives: the condition of an angle or a distance that is prescribed in time.
#[test]
fn drive_derivatives() {
    deep(check_drive_derivatives);
}

fn check_drive_derivatives() {
    let mut random = Random(17);
    for driven in [Driven::Angle, Driven::Distance] {
        for sides in SIDES {
            let machine = Machine::new(&mut random);
            let [a, b] = sides.map(|kind| any_marker(&mut random, kind));
            let joint = Joint {
                name: "drive".into(),
                a,
                b,
                primitives: driven.primitives(),
                drive: Some(0),
                gear: None,
                slide: None,
                holding: None,
            };
            check_joint(&machine, &joint, &mut random);
        }
    }
}

/// Sides of gears: a coordinate, or a function of it, times a factor.
#[test]
fn gear_derivatives() {
    deep(check_gear_derivatives);
}

fn check_gear_derivatives() {
    let mut random = Random(27);
    for measure in [Measure::Angle(0), Measure::Distance(0)] {
        for (sides, law) in SIDES.into_iter().flat_map(|sides| [(sides, None), (sides, Some(cam_law()))]) {
            let machine = Machine::new(&mut random);
            let [a, b] = sides.map(|kind| any_marker(&mut random, kind));
            let gear = Some(GearSide { gear: 0, coordinate: 0, factor: -2.5, law, is_second: true });
            let primitives = GearSide::primitives(measure);
            check_joint(
                &machine,
                &Joint { name: "gear".into(), a, b, primitives, drive: None, gear, slide: None, holding: None },
                &mut random,
            );
        }
    }
}
