//! The variables of FMI 3.0: rows of the variable table that are elements of one array become one variable.
//!
//! The table has a row per element, `tip.force[1]` to `tip.force[3]` or `arm.strain[1,1]` to `arm.strain[9,3]`. An
//! array is named without the index, and its value reference is that of its first element: a variable has the same
//! reference in FMI 2.0 and 3.0.

use std::iter;

use super::variable::{Causality, Variable};

/// Parameters and inputs whose elements are fewer stay scalars: vectors have three components, and where two of them
/// are parameters the third is an expression.
const FEWEST_GIVEN: usize = 3;

/// A variable of FMI 3.0: a scalar or an array.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Array<'a> {
    /// Its name, without the index.
    pub name: &'a str,
    /// The row of its first element, which is its value reference.
    pub first: usize,
    /// Its extents; none: it is a scalar.
    pub dimensions: Vec<usize>,
}

impl Array<'_> {
    /// Number of its elements.
    pub fn elements(&self) -> usize {
        self.dimensions.iter().product()
    }
}

/// The variables that the rows of a table are elements of, in their order.
pub fn arrays(variables: &[Variable]) -> Vec<Array<'_>> {
    let mut list = Vec::new();
    let mut first = 0;
    while first < variables.len() {
        let array = array_at(variables, first);
        first += array.elements();
        list.push(array);
    }
    list
}

/// The value reference of the independent variable: its row, or the first one behind the table, which has none.
pub fn time_reference(variables: &[Variable]) -> usize {
    let is_time = |variable: &Variable| variable.causality == Causality::Independent;
    variables.iter().position(is_time).unwrap_or(variables.len())
}

/// The longest array whose first element is row `first`; else that row alone.
fn array_at(variables: &[Variable], first: usize) -> Array<'_> {
    let scalar = Array { name: &variables[first].name, first, dimensions: Vec::new() };
    let Some((name, start)) = split(scalar.name).filter(|(_, index)| index.iter().all(|number| *number == 1)) else {
        return scalar;
    };
    let rows = variables[first..].iter();
    let indices: Vec<Vec<usize>> = rows
        .map_while(|variable| {
            split(&variable.name).filter(|(other, _)| *other == name && alike(variable, &variables[first]))
        })
        .map(|(_, index)| index)
        .collect();
    // In the order of C: the last index runs first.
    let dimensions: Vec<usize> = (0..start.len())
        .map(|place| indices.iter().filter_map(|index| index.get(place)).copied().max().unwrap_or(1))
        .collect();
    let count = dimensions.iter().product::<usize>();
    let whole = count == indices.len()
        && indices.iter().enumerate().all(|(place, index)| *index == index_of(place, &dimensions));
    let given =
        matches!(variables[first].causality, Causality::Parameter | Causality::Input | Causality::CalculatedParameter);
    if whole && (!given || count >= FEWEST_GIVEN) { Array { name, first, dimensions } } else { scalar }
}

/// The index, from 1, of element `place` in an array.
fn index_of(place: usize, dimensions: &[usize]) -> Vec<usize> {
    let strides = (0..dimensions.len()).map(|at| dimensions[at + 1..].iter().product::<usize>());
    strides.zip(dimensions).map(|(stride, extent)| place / stride % extent + 1).collect()
}

/// A name and its last index: `tip.force` and 3, `arm.strain` and 2, 1.
fn split(name: &str) -> Option<(&str, Vec<usize>)> {
    let (name, index) = name.strip_suffix(']')?.rsplit_once('[')?;
    let index: Option<Vec<usize>> = index.split(',').map(|number| number.parse().ok()).collect();
    Some((name, index?))
}

/// Whether two rows can be elements of one array, which has one type, unit and range.
fn alike(a: &Variable, b: &Variable) -> bool {
    let kind = |variable: &Variable| (variable.causality, variable.variability, variable.type_name());
    let range = |variable: &Variable| (variable.min, variable.max);
    kind(a) == kind(b) && range(a) == range(b) && a.quantity == b.quantity && a.display_unit == b.display_unit
}

/// The number of elements of the variable whose reference is each row; 0 where a row is another element of an array.
pub(super) fn lengths(variables: &[Variable]) -> Vec<u32> {
    let of_array =
        |array: Array<'_>| iter::once(array.elements() as u32).chain(iter::repeat_n(0, array.elements() - 1));
    arrays(variables).into_iter().flat_map(of_array).collect()
}
