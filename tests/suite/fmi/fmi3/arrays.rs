//! Which rows of the variable table are elements of one array? All of them and nothing else: an array whose elements
//! stand in another order, or are of another kind, would give a host numbers of other places.

use ancf14::fmi::{
    Value,
    arrays::{Array, arrays},
    variable::{Causality, Quantity, Variability, Variable},
};

use super::host::{HELD, Place};

fn row(name: &str, causality: Causality) -> Variable {
    Variable {
        name: name.to_owned(),
        description: String::new(),
        causality,
        variability: Variability::Continuous,
        start: Value::Real(0.0),
        min: None,
        max: None,
        quantity: Quantity::new("Force", "N"),
        nominal: None,
        display_unit: None,
        found_from: None,
        derivative_of: None,
        follows_from: Vec::new(),
    }
}

/// The names of the arrays that rows of these names make, with their extents.
fn named(names: &[&str], causality: Causality) -> Vec<(String, Vec<usize>)> {
    let rows: Vec<Variable> = names.iter().map(|name| row(name, causality)).collect();
    arrays(&rows).into_iter().map(|Array { name, dimensions, .. }| (name.to_owned(), dimensions)).collect()
}

#[test]
fn complete_indices_make_an_array() {
    use Causality::Output;
    let one = |name: &str, extents: &[usize]| vec![(name.to_owned(), extents.to_vec())];
    assert_eq!(named(&["a.f[1]", "a.f[2]", "a.f[3]"], Output), one("a.f", &[3]));
    assert_eq!(named(&["a.f[1]"], Output), one("a.f", &[1]));
    assert_eq!(named(&["a.f[1,1]", "a.f[1,2]", "a.f[2,1]", "a.f[2,2]"], Output), one("a.f", &[2, 2]));
    assert_eq!(named(&["r[2].f[1]", "r[2].f[2]"], Output), one("r[2].f", &[2]));
    assert_eq!(named(&["a.f"], Output), one("a.f", &[]));
    let two = [("a.f".to_owned(), vec![2]), ("b.f".to_owned(), vec![1])];
    assert_eq!(named(&["a.f[1]", "a.f[2]", "b.f[1]"], Output), two);
}

/// Rows of an array that is not whole, or not in order, stay scalars under their full names.
#[test]
fn other_indices_stay_scalars() {
    for names in [
        &["a.f[2]", "a.f[3]"][..],
        &["a.f[1]", "a.f[3]"],
        &["a.f[1]", "a.f[3]", "a.f[2]"],
        &["a.f[1,1]", "a.f[1,2]", "a.f[2,1]"],
        &["a.f[1,1]", "a.f[2,1]", "a.f[1,2]", "a.f[2,2]"],
        &["a.f[x]"],
        &["a.f[0]", "a.f[1]"],
    ] {
        let made = named(names, Causality::Output);
        let first = (names[0].to_owned(), Vec::new());
        assert_eq!(made[0], first, "{names:?}");
    }
}

/// Of a vector with one expression two components are parameters: a host that set an array of two would not see which.
#[test]
fn two_parameters_are_not_a_vector() {
    let names = ["a.f[1]", "a.f[2]"];
    assert_eq!(named(&names, Causality::Parameter).len(), 2);
    assert_eq!(named(&names, Causality::Input).len(), 2);
    assert_eq!(named(&names, Causality::Output).len(), 1);
    assert_eq!(named(&["a.f[1]", "a.f[2]", "a.f[3]"], Causality::Parameter).len(), 1);
}

/// An array has one unit, range, type and variability.
#[test]
fn elements_are_alike() {
    let changes: [fn(&mut Variable); 6] = [
        |row| row.quantity = Quantity::new("Torque", "N.m"),
        |row| row.min = Some(0.0),
        |row| row.max = Some(0.0),
        |row| row.start = Value::Integer(0),
        |row| row.variability = Variability::Discrete,
        |row| row.display_unit = Some("kN".to_owned()),
    ];
    for change in changes {
        let mut rows: Vec<Variable> = ["a.f[1]", "a.f[2]", "a.f[3]"].map(|name| row(name, Causality::Output)).into();
        assert_eq!(arrays(&rows).len(), 1);
        change(&mut rows[2]);
        // The first two are an array all the same.
        assert_eq!(arrays(&rows).len(), 2);
    }
}

/// Every row is an element of exactly one variable, in order.
#[test]
fn every_row_is_there_once() {
    let place = Place::new(HELD);
    let variables = ancf14::fmi::Model::variables(&place.model);
    let mut next = 0;
    for array in arrays(variables) {
        assert_eq!(array.first, next);
        next += array.elements();
    }
    assert_eq!(next, variables.len());
    let list = arrays(variables);
    let extents = |name: &str| list.iter().find(|array| array.name == name).unwrap().dimensions.clone();
    assert_eq!(extents("hand.position"), [3]);
    assert_eq!(extents("push.force"), [3]);
    assert_eq!(extents("tip.quaternion"), [4]);
    assert_eq!(extents("line.displacement"), [3, 3]);
    assert_eq!(extents("line.axial_strain"), [3]);
}
