//! Which elements of which variables an element depends on (FMI 3.0, section 2.2.10).
//!
//! At a communication point an output depends on no input. Until the end of the initialization it depends on what its
//! initial value is found from, and in Model Exchange on states and inputs at every instant.

use super::Instance;
use crate::fmi::{
    Model,
    error::Error,
    lifecycle::{Call, Kind, Mode},
    variable::Causality,
};

impl<M: Model> Instance<M> {
    /// The number of dependencies of a variable, a pair of elements each.
    ///
    /// # Errors
    /// The mode does not allow it, or the variable is not calculated.
    pub fn count_dependencies(&self, dependent: u32) -> Result<usize, Error> {
        self.check(Call::GetNumberOfVariableDependencies)?;
        let mut count = 0;
        self.each_dependency(dependent, |_, _, _| count += 1)?;
        Ok(count)
    }

    /// Whether `given` places take the dependencies of a variable.
    ///
    /// # Errors
    /// The mode does not allow it, the variable is not calculated, or it has another number of dependencies.
    pub fn check_dependencies(&self, dependent: u32, given: usize) -> Result<(), Error> {
        self.check(Call::GetVariableDependencies)?;
        let needed = self.count_dependencies(dependent)?;
        match given == needed {
            true => Ok(()),
            false => Err(Error::DependenciesDiffer { needed, given }),
        }
    }

    /// The dependencies of a variable: the element of it, the variable that it depends on, and the element of that one,
    /// from 1.
    ///
    /// # Errors
    /// The mode does not allow it, the variable is not calculated, or the lists are of another length; nothing is
    /// written then.
    pub fn dependencies(
        &self,
        dependent: u32,
        elements: &mut [usize],
        references: &mut [u32],
        others: &mut [usize],
    ) -> Result<(), Error> {
        self.check_dependencies(dependent, elements.len())?;
        let mut place = 0;
        self.each_dependency(dependent, |element, reference, other| {
            (elements[place], references[place], others[place]) = (element, reference, other);
            place += 1;
        })
    }

    fn each_dependency(&self, dependent: u32, mut see: impl FnMut(usize, u32, usize)) -> Result<(), Error> {
        let count = self.elements(dependent)?;
        let variables = self.model.variables();
        let variable = self.row(dependent)?;
        let is_calculated = matches!(variable.causality, Causality::Output | Causality::CalculatedParameter);
        if !is_calculated && variable.derivative_of.is_none() {
            return Err(Error::NotCalculated { name: variable.name.clone() });
        }
        let starts = matches!(self.mode(), Mode::Instantiated | Mode::Initialization);
        if !starts && self.kind == Kind::CoSimulation {
            return Ok(());
        }
        for element in 0..count {
            let own = &variables[(dependent + element) as usize];
            let found_from = if starts { own.found_from.as_deref() } else { Some(own.follows_from.as_slice()) };
            // The array that a row is in, with the place of the row there.
            let mut first = 0;
            for (row, known) in variables.iter().enumerate() {
                if self.arrays.lengths[row] > 0 {
                    first = row;
                }
                let given = matches!(known.causality, Causality::Parameter | Causality::Input) || known.is_state();
                if given && found_from.is_none_or(|rows| rows.binary_search(&row).is_ok()) {
                    see(element as usize + 1, first as u32, row - first + 1);
                }
            }
        }
        Ok(())
    }
}
