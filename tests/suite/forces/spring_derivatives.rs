//! Springs, dampers and actuators: forces and their derivatives against automatic differentiation of energy and
//! measure, on every kind of measure.

use crate::random::Random;
use crate::support::marker_oracle::{All, COUNT, Dual, Machine, ROUNDING, SIDES, any_marker, deep, measure, spread};
use ancf14::mechanics::beam::ancf14::coordinates::NODE;
use ancf14::mechanics::beam::ancf14::frame::NodeFrame;
use ancf14::mechanics::beam::configuration::Dissipation;
use ancf14::mechanics::force::actuator;
use ancf14::mechanics::force::spring::Spring;
use ancf14::mechanics::geometry::marker_jacobian::MarkerVector;
use ancf14::mechanics::marker::configuration::{Passage, TimeStep};
use ancf14::mechanics::marker::relative_coordinate::Measure;
use ancf14::mechanics::marker::relative_coordinate::RelativeCoordinate;
use nalgebra::SVector;

/// Springs and dampers on every measure: at rest the gradient and Hessian of the energy; at an instant and over a step
/// the damper's too.
#[test]
fn spring_derivatives() {
    deep(check_spring_derivatives);
}

fn check_spring_derivatives() {
    let mut random = Random(27);
    let measures = [
        Measure::Distance(0),
        Measure::Distance(2),
        Measure::Angle(0),
        Measure::Angle(1),
        Measure::Length,
        Measure::Rotation(0),
        Measure::Rotation(1),
        Measure::Rotation(2),
    ];
    for kind in measures {
        for sides in SIDES {
            // Rotation vectors end at half a turn: directors that are not orthonormal may be beyond.
            let (machine, a, b) = loop {
                let machine = Machine::new(&mut random);
                let [a, b] = sides.map(|kind| any_marker(&mut random, kind));
                let [at_a, at_b] = [a, b].map(|marker| marker.pose(&machine.configuration()).axes);
                if (at_a.tr_mul(&at_b).trace() - 1.0).abs() < 1.8 {
                    break (machine, a, b);
                }
            };
            let coordinate = RelativeCoordinate { a, b, measure: kind };
            let spring = Spring {
                name: "spring".into(),
                coordinate: 0,
                stiffness: 0.7,
                damping: 0.3,
                rest: random.signed(),
                mobility: 0.0,
                law: None,
                memory: None,
            };
            let c = machine.configuration();
            let energy = |q: All<Dual>| {
                let value = measure(kind, &machine.pose(&a, q.as_slice()), &machine.pose(&b, q.as_slice()));
                (value - spring.rest) * (value - spring.rest) * 0.35
            };
            let (value, gradient, hessian) = num_dual::hessian(energy, &machine.all());
            assert!((spring.energy(&coordinate, &c) - value).abs() < ROUNDING, "{kind:?} {sides:?}: {value}");
            let scatter = |parts: [MarkerVector; 2]| {
                let mut sum = SVector::<f64, COUNT>::zeros();
                for (marker, part) in [&a, &b].into_iter().zip(&parts) {
                    for (local, index) in marker.coordinates(&machine.mesh).enumerate() {
                        sum[index] += part[local];
                    }
                }
                sum
            };
            let closed = scatter(spring.gradient(&coordinate, &c, &Passage::Rest));
            assert!(
                (closed - gradient.fixed_rows::<COUNT>(0)).amax() < ROUNDING * gradient.amax().max(1.0),
                "{kind:?}"
            );
            let at_rest = spread(&machine, [&a, &b], &spring.hessian(&coordinate, &c, &Passage::Rest));
            let error = (at_rest - hessian.fixed_view::<COUNT, COUNT>(0, 0)).amax() / hessian.amax().max(1.0);
            assert!(error < ROUNDING, "{kind:?}: {error:e}");

            // The rate is the derivative of the coordinate along (v, 1), and so is what it changes by with q.
            let reading =
                |q: All<Dual>| measure(kind, &machine.pose(&a, q.as_slice()), &machine.pose(&b, q.as_slice()));
            let (_, by_all, by_all_twice) = num_dual::hessian(reading, &machine.all());
            let mut along = All::<f64>::zeros();
            along.fixed_rows_mut::<COUNT>(0).copy_from(&machine.velocity);
            along[COUNT] = 1.0;
            let rate = by_all.dot(&along);
            // An effort works along the coordinate, and its force changes as the gradient does.
            let (effort, size) = (0.8, by_all_twice.amax().max(1.0));
            let force = scatter(actuator::force(&coordinate, &c, effort)) - by_all.fixed_rows::<COUNT>(0) * effort;
            assert!(force.amax() < ROUNDING * size, "{kind:?}: {force}");
            let force_q = spread(&machine, [&a, &b], &actuator::force_q(&coordinate, &c, effort));
            let error = force_q - by_all_twice.fixed_view::<COUNT, COUNT>(0, 0) * effort;
            assert!(error.amax() < ROUNDING * size, "{kind:?} {sides:?}: {:e}", error.amax());
            let rate_q = (by_all_twice * along).fixed_rows::<COUNT>(0).into_owned();
            let velocity = machine.velocity.as_slice();
            assert!((coordinate.rate(&c, velocity) - rate).abs() < ROUNDING * rate.abs().max(1.0));
            let moving = Passage::with_velocity(velocity);
            let damped = scatter(spring.gradient(&coordinate, &c, &moving));
            let by_q = by_all.fixed_rows::<COUNT>(0).into_owned();
            let size = by_all_twice.amax().max(1.0) * 10.0;
            assert!((damped - closed - by_q * (0.3 * rate)).amax() < ROUNDING * size);
            let tangent = spread(&machine, [&a, &b], &spring.hessian(&coordinate, &c, &moving)) - at_rest;
            let expected =
                by_all_twice.fixed_view::<COUNT, COUNT>(0, 0) * (0.3 * rate) + by_q * rate_q.transpose() * 0.3;
            assert!((tangent - expected).amax() < ROUNDING * size * size, "{kind:?}");
            let by_v = spread(&machine, [&a, &b], &spring.damping_matrix(&coordinate, &c, velocity));
            assert!((by_v - by_q * by_q.transpose() * 0.3).amax() < ROUNDING * size);

            // Over a step: rates are differences of the relative coordinates at its ends. Here the machine in the
            // middle is the one at the start.
            let other = Machine { q: machine.q + machine.velocity * 0.05, ..Machine::new(&mut random) };
            let other = Machine {
                triads: machine.triads,
                holonomy: machine.holonomy,
                frames: std::array::from_fn(|node| {
                    NodeFrame::new(&other.q.as_slice()[NODE * node..NODE * (node + 1)], &machine.triads[node])
                }),
                ..other
            };
            let end = other.configuration();
            let rates = [0.0; COUNT];
            let passage = Passage::Step(TimeStep {
                start: &c,
                end: &end,
                increment: &[],
                duration: 0.1,
                velocity: &[],
                dissipation: Dissipation::default(),
                strain_rates: &rates,
                predicted_rates: &rates,
                velocity_lead: &[],
                starts: &[],
            });
            let reading_end =
                |q: All<Dual>| measure(kind, &other.pose(&a, q.as_slice()), &other.pose(&b, q.as_slice()));
            let (end_value, end_q, _) = num_dual::hessian(reading_end, &other.all());
            let here =
                measure(kind, &machine.pose(&a, machine.all().as_slice()), &machine.pose(&b, machine.all().as_slice()));
            // Angles of both ends are read near the last accepted one, 0.
            let rate = (end_value - here) / 0.1;
            // The elastic force is that of the mean coordinate; a distance pulls along the mean direction, which is
            // shorter than 1.
            let mean = 0.5 * (end_value + here);
            let shortening = if coordinate.measure == Measure::Length { here / mean } else { 1.0 };
            let tension = (spring.stiffness * (mean - spring.rest) + 0.3 * rate) * shortening;
            let over = scatter(spring.gradient(&coordinate, &c, &passage));
            assert!((over - by_q * tension).amax() < ROUNDING * size * rate.abs().max(1.0), "{kind:?}");
            let tangent = spread(&machine, [&a, &b], &spring.hessian(&coordinate, &c, &passage));
            let end_q = end_q.fixed_rows::<COUNT>(0).into_owned();
            let expected = by_all_twice.fixed_view::<COUNT, COUNT>(0, 0) * tension
                + by_q * end_q.transpose() * (spring.stiffness + 0.3 * 2.0 / 0.1);
            assert!((tangent - expected).amax() < ROUNDING * size * size * rate.abs().max(10.0), "{kind:?}");
        }
    }
}
