//! Are adjoint derivatives the transposed of directional ones, with respect to time those of FMI 2.0, and dependencies
//! those of the description?
#![allow(unsafe_code, reason = "tests of the C ABI")]

use ancf14::{
    ffi::{fmi3::*, fmi3_types::*, fmi3_values::*},
    fmi::{Model, arrays::arrays, variable::Causality},
};

use super::host::{ERROR, HELD, OK, Place, Unit};

/// `Jᵀ seeds` of outputs with respect to knowns.
fn adjoint(unit: &Unit<'_>, unknowns: &[u32], knowns: &[u32], seeds: &[f64], count: usize) -> (fmi3Status, Vec<f64>) {
    let mut changes = vec![f64::NAN; count];
    let (unknown, known, seed) = (unknowns.as_ptr(), knowns.as_ptr(), seeds.as_ptr());
    let (many, few) = (unknowns.len(), knowns.len());
    // SAFETY: the unit is live; the arrays have the lengths that are passed.
    let status = unsafe {
        fmi3GetAdjointDerivative(unit.c, unknown, many, known, few, seed, seeds.len(), changes.as_mut_ptr(), count)
    };
    (status, changes)
}

fn moved(place: &Place) -> Unit<'_> {
    let unit = Unit::new(place);
    unit.initialize();
    let given = ["hand.position", "hand.rotation", "push.force"].map(|name| place.reference(name));
    assert_eq!(unit.set(&given, &[1e-4, 0.0, 0.0, 0.0, 1e-3, 0.0, 0.5, 0.0, 1.0]), OK);
    unit.whole_step(0.0, 5e-3);
    unit
}

/// `seedᵀ (J v) = (Jᵀ seed)ᵀ v`, for every known by itself: both are sums of the same products.
#[test]
fn adjoint_is_the_transposed() {
    let place = Place::new(HELD);
    let unit = moved(&place);
    let ((outputs, many), (inputs, few)) = (place.of(Causality::Output), place.of(Causality::Input));
    let seeds: Vec<f64> = (0..many).map(|k| (k as f64).sin()).collect();
    let (status, transposed) = adjoint(&unit, &outputs, &inputs, &seeds, few);
    assert_eq!(status, OK, "{:?}", unit.lines());
    let mut other_than_zero = 0;
    for (known, transposed) in transposed.into_iter().enumerate() {
        let unit_vector: Vec<f64> = (0..few).map(|k| f64::from(u8::from(k == known))).collect();
        let column = unit.directional(&inputs, &unit_vector);
        let expected: f64 = column.iter().zip(&seeds).map(|(derivative, seed)| derivative * seed).sum();
        assert_eq!(transposed, expected, "input {known}"); // the same sum, in the same order
        other_than_zero += usize::from(expected != 0.0);
    }
    assert_eq!(other_than_zero, few);
}

/// In Initialization Mode too, where knowns are parameters: the tip is at the end of the arm as drawn.
#[test]
fn adjoint_of_the_start() {
    let place = Place::new(HELD);
    let unit = Unit::new(&place);
    // SAFETY: the unit is live.
    assert_eq!(unsafe { fmi3EnterInitializationMode(unit.c, 0, 0.0, 0.0, 0, 0.0) }, OK);
    let (tip, end) = (place.reference("tip.position"), place.reference("arm.to"));
    let (status, changes) = adjoint(&unit, &[tip], &[end], &[1.0, 2.0, 3.0], 3);
    assert_eq!(status, OK, "{:?}", unit.lines());
    // Differences of initial states are right to four digits, as the documentation says.
    for (change, expected) in changes.iter().zip([1.0, 2.0, 3.0]) {
        assert!((change - expected).abs() < 1e-3 * expected, "{changes:?}");
    }
}

/// Wrong roles, numbers of seeds and seeds write nothing.
#[test]
fn wrong_arguments_write_nothing() {
    let place = Place::new(HELD);
    let unit = moved(&place);
    let (tip, force) = (place.reference("tip.position"), place.reference("push.force"));
    for (unknowns, knowns, seeds, count) in [
        (&[force][..], &[tip][..], &[1.0; 3][..], 3),
        (&[tip], &[force], &[1.0; 2], 3),
        (&[tip], &[force], &[1.0; 3], 2),
        (&[tip], &[force], &[1.0, f64::NAN, 1.0], 3),
        (&[9999], &[force], &[1.0], 3),
    ] {
        let (status, changes) = adjoint(&unit, unknowns, knowns, seeds, count);
        assert_eq!(status, ERROR);
        assert!(changes.iter().all(|change| change.is_nan()));
    }
    let unit = Unit::new(&place);
    assert_eq!(adjoint(&unit, &[tip], &[force], &[1.0; 3], 3).0, ERROR); // before the initialization
}

/// Velocities are the derivatives of positions, to the round-off of the differences that they are computed by.
#[test]
fn output_derivatives() {
    let place = Place::new(HELD);
    let unit = moved(&place);
    let tip = place.reference("tip.position");
    let get = |orders: [i32; 2], count: usize| {
        let mut values = [f64::NAN; 6];
        // SAFETY: the unit is live; the arrays have the lengths that are passed.
        let status = unsafe {
            fmi3GetOutputDerivatives(unit.c, [tip; 2].as_ptr(), 2, orders.as_ptr(), values.as_mut_ptr(), count)
        };
        (status, values)
    };
    let (status, rates) = get([1, 1], 6);
    assert_eq!(status, OK, "{:?}", unit.lines());
    let velocity = unit.value::<3>("tip.velocity");
    for (rate, velocity) in rates.iter().zip(velocity.iter().cycle()) {
        assert!((rate - velocity).abs() < 1e-9, "{rates:?} {velocity}"); // stencils of 1e-3 m leave 1e-12 of them, and rounding
    }
    assert!(velocity.iter().any(|value| value.abs() > 1e-4));
    assert_eq!(get([1, 2], 6).0, ERROR);
    assert_eq!(get([1, 0], 6).0, ERROR);
    assert_eq!(get([1, 1], 3).0, ERROR);
}

/// Element by element the dependencies are what the description says of the variables; after the initialization there
/// are none.
#[test]
fn dependencies() {
    let place = Place::new(HELD);
    let unit = Unit::new(&place);
    let variables = place.model.variables();
    let count = |reference: u32| {
        let mut count = usize::MAX;
        // SAFETY: the unit is live; one place.
        (unsafe { fmi3GetNumberOfVariableDependencies(unit.c, reference, &raw mut count) }, count)
    };
    let mut pairs = 0;
    for array in arrays(variables).iter().filter(|array| variables[array.first].causality == Causality::Output) {
        let reference = u32::try_from(array.first).unwrap();
        let (status, needed) = count(reference);
        assert_eq!(status, OK);
        let (mut own, mut other, mut kinds) = (vec![0; needed], vec![0; needed], vec![0; needed]);
        let mut references = vec![0; needed];
        let (first, second, third) = (own.as_mut_ptr(), references.as_mut_ptr(), other.as_mut_ptr());
        let fourth = kinds.as_mut_ptr();
        let ask = |places: usize| {
            // SAFETY: the unit is live; the arrays have the length that is passed, or that is refused before they are
            // touched.
            unsafe { fmi3GetVariableDependencies(unit.c, reference, first, second, third, fourth, places) }
        };
        // A wrong number is refused before anything is written: the arrays of such a host may be shorter than it says.
        for places in [needed.wrapping_sub(1), needed + 1, 1 << 40] {
            assert_eq!(ask(places), ERROR);
        }
        assert!([&own, &other].iter().all(|list| list.iter().all(|place| *place == 0)));
        assert_eq!(ask(needed), OK);
        assert!(kinds.iter().all(|kind| *kind == fmi3Dependent));
        // The same as rows of FMI 2.0's table.
        let mut found: Vec<(usize, usize)> =
            (0..needed).map(|k| (array.first + own[k] - 1, references[k] as usize + other[k] - 1)).collect();
        found.sort_unstable();
        let given = |row: &usize| matches!(variables[*row].causality, Causality::Parameter | Causality::Input);
        let all: Vec<usize> = (0..variables.len()).filter(given).collect();
        let rows = array.first..array.first + array.elements();
        let expected: Vec<(usize, usize)> = rows
            .flat_map(|row| {
                let from = variables[row].found_from.as_ref().unwrap_or(&all);
                from.iter().map(move |known| (row, *known)).collect::<Vec<_>>()
            })
            .collect();
        assert_eq!(found, expected, "{}", array.name);
        pairs += needed;
    }
    assert!(pairs > 100);
    assert_eq!(count(place.reference("push.force")).0, ERROR);
    unit.initialize();
    assert_eq!(count(place.reference("tip.position")), (OK, 0));
}
