//! Springs with laws: tangents against differences of the forces, at rest, at an instant and over a step. A factor that
//! belongs to the other kind of passage, or a rate whose lateness the tangent does not know, shows at 1e-2 or more.

use crate::random::Random;
use crate::support::marker_oracle::{COUNT, Machine, any_marker, deep, spread};
use ancf14::mechanics::beam::ancf14::coordinates::NODE;
use ancf14::mechanics::beam::ancf14::frame::NodeFrame;
use ancf14::mechanics::beam::configuration::Dissipation;
use ancf14::mechanics::force::law::Law;
use ancf14::mechanics::force::spring::Spring;
use ancf14::mechanics::geometry::marker_jacobian::{MarkerMatrix, MarkerVector};
use ancf14::mechanics::marker::Marker;
use ancf14::mechanics::marker::configuration::{Passage, TimeStep};
use ancf14::mechanics::marker::relative_coordinate::{Measure, RelativeCoordinate};
use nalgebra::SVector;
use std::sync::Arc;

type All = SVector<f64, COUNT>;

/// The machine at other coordinates.
fn moved(machine: &Machine, q: All) -> Machine {
    let Machine { velocity, triads, holonomy, mesh, prescribed, .. } = machine;
    let frame = |node: usize| NodeFrame::new(&q.as_slice()[NODE * node..NODE * (node + 1)], &triads[node]);
    Machine {
        q,
        velocity: *velocity,
        triads: *triads,
        holonomy: *holonomy,
        frames: std::array::from_fn(frame),
        mesh: mesh.clone(),
        prescribed: prescribed.clone(),
    }
}

fn scatter(machine: &Machine, sides: [&Marker; 2], parts: &[MarkerVector; 2]) -> All {
    let mut sum = All::zeros();
    for (marker, part) in sides.into_iter().zip(parts) {
        for (local, index) in marker.coordinates(&machine.mesh).enumerate() {
            sum[index] += part[local];
        }
    }
    sum
}

#[test]
fn tangents_of_laws() {
    deep(check_tangents);
}

/// Length of the differences: their error is its square times third derivatives of up to 1e3, and round-off over it.
const DIFFERENCE: f64 = 1e-5;
const BOUND: f64 = 3e-6;

fn check_tangents() {
    let mut random = Random(91);
    let smooth =
        |x: f64, v: f64| [x + x * x * x + 0.3 * v * x.cos(), 1.0 + 3.0 * x * x - 0.3 * v * x.sin(), 0.3 * x.cos()];
    let laws = [
        Law::Function { function: Arc::new(smooth), has_rate: true },
        Law::OneSided { sign: 1.0, stiffness: 4.0, damping: 0.7 },
        Law::OneSided { sign: -1.0, stiffness: 4.0, damping: 0.7 },
        Law::SmoothFriction { coulomb: 0.5, viscous: 0.2, speed: 0.4 },
        Law::Stop { limits: [-0.3, 0.2], stiffness: 3.0, damping: 0.4 },
    ];
    for law in laws {
        for kind in [Measure::Distance(0), Measure::Angle(1), Measure::Length] {
            for sides in [[0, 3], [3, 2], [1, 2]] {
                check(&mut random, &law, kind, sides);
            }
        }
    }
}

fn check(random: &mut Random, law: &Law, kind: Measure, sides: [usize; 2]) {
    let machine = Machine::new(random);
    let [a, b] = sides.map(|kind| any_marker(random, kind));
    let coordinate = RelativeCoordinate { a, b, measure: kind };
    let c = machine.configuration();
    let here = coordinate.value(&c, 0.0);
    let spring = Spring {
        name: "spring".into(),
        coordinate: 0,
        stiffness: 0.0,
        damping: 0.0,
        // On either side of its kinks.
        rest: here + 0.4 * random.signed(),
        mobility: 30.0,
        law: Some(law.clone()),
        memory: None,
    };
    let along = All::from_fn(|_, _| random.signed());
    let apart = |blocks: &[MarkerMatrix; 4]| spread(&machine, [&a, &b], blocks) * along;
    let close = |what: &str, found: All, expected: All| {
        let error = (found - expected).amax() / expected.amax().max(1.0);
        assert!(error < BOUND, "{law:?} {kind:?} {sides:?} {what}: {error:e}");
    };
    let velocity = machine.velocity.as_slice();
    for (what, passage) in [("at rest", Passage::Rest), ("at an instant", Passage::with_velocity(velocity))] {
        let [after, before] = [1.0, -1.0].map(|sign| {
            let other = moved(&machine, machine.q + along * (sign * DIFFERENCE));
            scatter(&machine, [&a, &b], &spring.gradient(&coordinate, &other.configuration(), &passage))
        });
        close(what, apart(&spring.hessian(&coordinate, &c, &passage)), (after - before) / (2.0 * DIFFERENCE));
    }
    let [faster, slower] = [1.0, -1.0].map(|sign| {
        let velocity = machine.velocity + along * (sign * DIFFERENCE);
        let passage = Passage::with_velocity(velocity.as_slice());
        scatter(&machine, [&a, &b], &spring.gradient(&coordinate, &c, &passage))
    });
    close(
        "by velocity",
        apart(&spring.damping_matrix(&coordinate, &c, velocity)),
        (faster - slower) / (2.0 * DIFFERENCE),
    );

    if kind == Measure::Length {
        // Steps take a length along the mean direction, whose change with the end the tangent leaves to the middle.
        return;
    }
    let start = moved(&machine, machine.q - machine.velocity * 0.05);
    let begin = start.configuration();
    let rates = [0.1; COUNT];
    let over = |end: &Machine, read: &mut dyn FnMut(&Passage)| {
        let end = end.configuration();
        read(&Passage::Step(TimeStep {
            start: &begin,
            end: &end,
            increment: &[],
            duration: 0.1,
            velocity,
            dissipation: Dissipation::new(0.8),
            strain_rates: &rates,
            predicted_rates: &rates,
            velocity_lead: &[],
            starts: &[],
        }));
    };
    let end = machine.q + machine.velocity * 0.05;
    let [after, before] = [1.0, -1.0].map(|sign| {
        let mut force = All::zeros();
        over(&moved(&machine, end + along * (sign * DIFFERENCE)), &mut |passage| {
            force = scatter(&machine, [&a, &b], &spring.gradient(&coordinate, &c, passage));
        });
        force
    });
    over(&moved(&machine, end), &mut |passage| {
        let middle = coordinate.hessian(&c, spring.tension(&coordinate, &c, passage));
        let by_end = apart(&spring.hessian(&coordinate, &c, passage)) - apart(&middle);
        // The tangent is twice the derivative with respect to the end.
        close("over a step", 0.5 * by_end, (after - before) / (2.0 * DIFFERENCE));
    });
}
