//! A compiled expression: a flat list of operations on a stack of jets, evaluated without allocation.

use super::table::Table;
use crate::math::jet::Jet;
use std::sync::Arc;

/// Height of the evaluation stack: the parser refuses expressions that need more.
pub const STACK: usize = 64;
/// Operations of a program with those of all functions that it calls: functions that call one another twice would
/// double the work with each.
pub const MOST_OPERATIONS: usize = 100_000;
/// Functions that call one another: each needs a stack of its own.
pub const DEEPEST: usize = 30;

/// One operation; it takes its arguments from the stack and leaves its result there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operation {
    /// A number.
    Constant(f64),
    /// A parameter, by its number in the list that the caller gives.
    Parameter(usize),
    /// The variable, t, s or x.
    Variable,
    /// The rate v of the variable x.
    Rate,
    /// A coordinate of the mechanism or its rate, by its number.
    Reading(usize),
    /// A function of one argument.
    Unary(Unary),
    /// A function of two arguments.
    Binary(Binary),
    /// A function of three arguments.
    Ternary(Ternary),
    /// A function of the file, by its number in the list of those that the program calls.
    Call(usize),
}

/// Functions of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "each is the function of its name")]
pub enum Unary {
    Negate,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Ln,
    Sqrt,
    Abs,
    Sign,
    Log10,
    Floor,
    Ceil,
}

/// Functions of two arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "each is the function of its name")]
pub enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Atan2,
    Min,
    Max,
    Mod,
    Step,
    Less,
    AtMost,
    Greater,
    AtLeast,
    Equal,
    Unequal,
    And,
    Or,
}

/// Functions of three arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "each is the function of its name")]
pub enum Ternary {
    If,
    Smoothstep,
}

/// What a function name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Callable {
    /// Exactly one argument.
    One(Unary),
    /// Exactly two arguments.
    Two(Binary),
    /// Two or more arguments, folded from the left.
    Many(Binary),
    /// Exactly three arguments.
    Three(Ternary),
}

/// Functions whose names are not reserved: without a parenthesis behind it each is the name of a parameter.
pub const MORE_FUNCTIONS: [(&str, Callable); 7] = [
    ("log10", Callable::One(Unary::Log10)),
    ("floor", Callable::One(Unary::Floor)),
    ("ceil", Callable::One(Unary::Ceil)),
    ("mod", Callable::Two(Binary::Mod)),
    ("step", Callable::Two(Binary::Step)),
    ("if", Callable::Three(Ternary::If)),
    ("smoothstep", Callable::Three(Ternary::Smoothstep)),
];

/// The functions of the expression language whose names are reserved.
pub const FUNCTIONS: [(&str, Callable); 17] = [
    ("sin", Callable::One(Unary::Sin)),
    ("cos", Callable::One(Unary::Cos)),
    ("tan", Callable::One(Unary::Tan)),
    ("asin", Callable::One(Unary::Asin)),
    ("acos", Callable::One(Unary::Acos)),
    ("atan", Callable::One(Unary::Atan)),
    ("atan2", Callable::Two(Binary::Atan2)),
    ("sinh", Callable::One(Unary::Sinh)),
    ("cosh", Callable::One(Unary::Cosh)),
    ("tanh", Callable::One(Unary::Tanh)),
    ("exp", Callable::One(Unary::Exp)),
    ("ln", Callable::One(Unary::Ln)),
    ("sqrt", Callable::One(Unary::Sqrt)),
    ("abs", Callable::One(Unary::Abs)),
    ("sign", Callable::One(Unary::Sign)),
    ("min", Callable::Many(Binary::Min)),
    ("max", Callable::Many(Binary::Max)),
];

/// A function of the file, `[function.NAME]`: it has one argument.
#[derive(Debug, PartialEq)]
pub struct Called {
    /// Its name.
    pub name: String,
    /// What it is.
    pub body: Body,
}

/// What a function of the file is.
#[derive(Debug, PartialEq)]
pub enum Body {
    /// An expression, of which the argument is the variable.
    Expression(Program),
    /// A table.
    Table(Table),
}

impl Called {
    /// Operations with those of all functions that it calls.
    fn cost(&self) -> usize {
        match &self.body {
            Body::Expression(program) => program.cost,
            Body::Table(_) => 1,
        }
    }

    /// How many functions call one another, this one included.
    fn depth(&self) -> usize {
        match &self.body {
            Body::Expression(program) => 1 + program.depth(),
            Body::Table(_) => 1,
        }
    }

    /// Whether a parameter occurs.
    fn has_parameters(&self) -> bool {
        match &self.body {
            Body::Expression(program) => program.parameters().next().is_some(),
            Body::Table(_) => false,
        }
    }

    /// The same function with the parameters as numbers.
    fn bound(self: &Arc<Self>, parameters: &dyn Fn(usize) -> f64) -> Arc<Self> {
        match &self.body {
            Body::Expression(program) if self.has_parameters() => {
                Arc::new(Self { name: self.name.clone(), body: Body::Expression(program.bound(parameters)) })
            }
            _ => self.clone(),
        }
    }
}

/// Coordinates and rates of a mechanism as drawn.
const AS_DRAWN: fn(usize) -> Jet = |_| Jet::constant(0.0);

/// A compiled expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    operations: Vec<Operation>,
    /// The functions of the file that it calls, each once.
    calls: Vec<Arc<Called>>,
    /// Operations with those of all functions that it calls.
    cost: usize,
}

impl Program {
    /// The program that is one number.
    pub fn constant(value: f64) -> Self {
        Self { operations: vec![Operation::Constant(value)], calls: Vec::new(), cost: 1 }
    }

    /// From operations in the order of their execution; None if they need a higher stack than [`STACK`], more work than
    /// [`MOST_OPERATIONS`], or functions that call one another deeper than [`DEEPEST`].
    pub(super) fn new(operations: Vec<Operation>, calls: Vec<Arc<Called>>) -> Option<Self> {
        let mut height = 0_usize;
        let mut cost = 0_usize;
        for operation in &operations {
            height = match operation {
                Operation::Constant(_)
                | Operation::Parameter(_)
                | Operation::Variable
                | Operation::Rate
                | Operation::Reading(_) => height + 1,
                Operation::Unary(_) | Operation::Call(_) => height,
                Operation::Binary(_) => height - 1,
                Operation::Ternary(_) => height - 2,
            };
            cost = cost.saturating_add(match operation {
                Operation::Call(number) => calls[*number].cost(),
                _ => 1,
            });
            if height > STACK || cost > MOST_OPERATIONS {
                return None;
            }
        }
        assert_eq!(height, 1, "the parser leaves one result");
        Some(Self { operations, calls, cost }).filter(|program| program.depth() <= DEEPEST)
    }

    /// How many functions call one another.
    fn depth(&self) -> usize {
        self.calls.iter().map(|called| called.depth()).max().unwrap_or(0)
    }

    /// Whether neither the variable nor its rate occurs, nor a reading.
    pub fn is_constant(&self) -> bool {
        !self.operations.contains(&Operation::Variable) && !self.has_rate() && self.readings().next().is_none()
    }

    /// The readings that occur, repeats included.
    pub fn readings(&self) -> impl Iterator<Item = usize> + '_ {
        self.operations.iter().filter_map(|operation| match operation {
            Operation::Reading(number) => Some(*number),
            _ => None,
        })
    }

    /// Whether the rate of the variable occurs.
    pub fn has_rate(&self) -> bool {
        self.operations.contains(&Operation::Rate)
    }

    /// The operations in the order of their execution.
    pub(super) fn operations(&self) -> &[Operation] {
        &self.operations
    }

    /// The function that [`Operation::Call`] means.
    pub(super) fn called(&self, number: usize) -> &Called {
        &self.calls[number]
    }

    /// The parameters that occur, in the order of the text, repeats included; then those of the functions that it
    /// calls.
    pub fn parameters(&self) -> Box<dyn Iterator<Item = usize> + '_> {
        let own = self.operations.iter().filter_map(|operation| match operation {
            Operation::Parameter(slot) => Some(*slot),
            _ => None,
        });
        Box::new(own.chain(self.calls.iter().flat_map(|called| match &called.body {
            Body::Expression(program) => program.parameters(),
            Body::Table(_) => Box::new(std::iter::empty()),
        })))
    }

    /// The same program with the parameters as numbers: it needs no list any more.
    #[must_use]
    pub fn bound(&self, parameters: &dyn Fn(usize) -> f64) -> Self {
        let bind = |operation: &Operation| match *operation {
            Operation::Parameter(slot) => Operation::Constant(parameters(slot)),
            other => other,
        };
        let operations: Vec<_> = self.operations.iter().map(bind).collect();
        let calls = self.calls.iter().map(|called| called.bound(parameters)).collect();
        Self { operations, calls, cost: self.cost }
    }

    /// The same program with the rate of the variable as a number.
    #[must_use]
    pub fn at_rate(mut self, rate: f64) -> Self {
        self.operations
            .iter_mut()
            .filter(|own| **own == Operation::Rate)
            .for_each(|own| *own = Operation::Constant(rate));
        self
    }

    /// The same program, as a number where the variable does not occur.
    #[must_use]
    pub fn folded(self) -> Self {
        if self.is_constant() { Self::constant(self.value(0.0, |_| f64::NAN)) } else { self }
    }

    /// `f`, with the variable and the parameters as given. NaN where a function is not defined.
    pub fn value(&self, variable: f64, parameters: impl Fn(usize) -> f64) -> f64 {
        self.jet(variable, parameters).value
    }

    /// `(f, f', f'')` by the variable, at the rate 0; all readings are 0.
    pub fn jet(&self, variable: f64, parameters: impl Fn(usize) -> f64) -> Jet {
        self.run([Jet::variable(variable), Jet::constant(0.0)], &AS_DRAWN, &parameters, &mut |_, _| {})
    }

    /// With the variable and its rate as they are. The parameters are bound.
    pub fn evaluated(&self, variable: Jet, rate: Jet) -> Jet {
        self.run([variable, rate], &AS_DRAWN, &|_| f64::NAN, &mut |_, _| {})
    }

    /// At the variable and the readings as they are. The parameters are bound.
    pub fn with_readings(&self, variable: f64, readings: &dyn Fn(usize) -> Jet) -> Jet {
        self.run([Jet::constant(variable), Jet::constant(0.0)], &readings, &|_| f64::NAN, &mut |_, _| {})
    }

    /// Whether a table that it calls has no values outside of its rows.
    pub fn may_be_undefined(&self) -> bool {
        self.calls.iter().any(|called| match &called.body {
            Body::Expression(program) => program.may_be_undefined(),
            Body::Table(table) => table.has_an_end(),
        })
    }

    /// The first call of a table without a value at its argument: its function and the argument. The parameters are
    /// bound.
    pub fn undefined(&self, variable: f64) -> Option<Undefined> {
        let mut found = None;
        self.run([Jet::variable(variable), Jet::constant(0.0)], &AS_DRAWN, &|_| f64::NAN, &mut |called, argument| {
            if let Body::Table(table) = &called.body
                && found.is_none()
                && table.is_undefined(argument)
            {
                found = Some(Undefined { name: called.name.clone(), argument, range: table.range() });
            }
        });
        found
    }

    fn run(
        &self,
        [variable, rate]: [Jet; 2],
        readings: &impl Fn(usize) -> Jet,
        parameters: &impl Fn(usize) -> f64,
        watch: &mut impl FnMut(&Called, f64),
    ) -> Jet {
        let mut stack = [Jet::default(); STACK];
        let mut height = 0;
        for operation in &self.operations {
            match *operation {
                Operation::Constant(value) => {
                    stack[height] = Jet::constant(value);
                    height += 1;
                }
                Operation::Parameter(slot) => {
                    stack[height] = Jet::constant(parameters(slot));
                    height += 1;
                }
                Operation::Variable => {
                    stack[height] = variable;
                    height += 1;
                }
                Operation::Rate => {
                    stack[height] = rate;
                    height += 1;
                }
                Operation::Reading(number) => {
                    stack[height] = readings(number);
                    height += 1;
                }
                Operation::Unary(function) => stack[height - 1] = unary(function, stack[height - 1]),
                Operation::Binary(function) => {
                    height -= 1;
                    stack[height - 1] = binary(function, stack[height - 1], stack[height]);
                }
                Operation::Ternary(function) => {
                    height -= 2;
                    stack[height - 1] = ternary(function, stack[height - 1], stack[height], stack[height + 1]);
                }
                Operation::Call(number) => {
                    let called = &*self.calls[number];
                    let argument = stack[height - 1];
                    watch(called, argument.value);
                    let result = match &called.body {
                        Body::Expression(program) => {
                            let inner = [Jet::variable(argument.value), Jet::constant(0.0)];
                            program.run(inner, readings, parameters, watch)
                        }
                        Body::Table(table) => table.jet(argument.value),
                    };
                    stack[height - 1] = argument.chain(result.value, result.first, result.second);
                }
            }
        }
        stack[0]
    }
}

/// A table without a value where it is asked for one.
#[derive(Clone, Debug, PartialEq)]
pub struct Undefined {
    /// Its name.
    pub name: String,
    /// Where it is asked for a value.
    pub argument: f64,
    /// The arguments of its first and its last row.
    pub range: [f64; 2],
}

impl std::fmt::Display for Undefined {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { name, argument, range: [first, last] } = self;
        write!(f, "{name}({argument}) is outside of its table, which runs from {first} to {last}")
    }
}

pub(super) fn unary(function: Unary, a: Jet) -> Jet {
    match function {
        Unary::Negate => -a,
        Unary::Sin => a.sin(),
        Unary::Cos => a.cos(),
        Unary::Tan => a.tan(),
        Unary::Asin => a.asin(),
        Unary::Acos => a.acos(),
        Unary::Atan => a.atan(),
        Unary::Sinh => a.sinh(),
        Unary::Cosh => a.cosh(),
        Unary::Tanh => a.tanh(),
        Unary::Exp => a.exp(),
        Unary::Ln => a.ln(),
        Unary::Sqrt => a.sqrt(),
        Unary::Abs => a.abs(),
        Unary::Sign => a.sign(),
        Unary::Log10 => a.log10(),
        Unary::Floor => a.floor(),
        Unary::Ceil => a.ceil(),
    }
}

pub(super) fn binary(function: Binary, a: Jet, b: Jet) -> Jet {
    match function {
        Binary::Add => a + b,
        Binary::Subtract => a - b,
        Binary::Multiply => a * b,
        Binary::Divide => a / b,
        Binary::Power => a.power(b),
        Binary::Atan2 => a.atan2(b),
        Binary::Min => a.min(b),
        Binary::Max => a.max(b),
        Binary::Mod => a.modulo(b),
        Binary::Step => truth(a, b, |a, b| b >= a),
        Binary::Less => truth(a, b, |a, b| a < b),
        Binary::AtMost => truth(a, b, |a, b| a <= b),
        Binary::Greater => truth(a, b, |a, b| a > b),
        Binary::AtLeast => truth(a, b, |a, b| a >= b),
        Binary::Equal => truth(a, b, |a, b| a == b),
        Binary::Unequal => truth(a, b, |a, b| a != b),
        Binary::And => truth(a, b, |a, b| a != 0.0 && b != 0.0),
        Binary::Or => truth(a, b, |a, b| a != 0.0 || b != 0.0),
    }
}

/// 1 where it holds, else 0; NaN if one of the two is NaN.
fn truth(a: Jet, b: Jet, holds: impl Fn(f64, f64) -> bool) -> Jet {
    let is_known = !a.value.is_nan() && !b.value.is_nan();
    Jet::constant(if is_known { f64::from(u8::from(holds(a.value, b.value))) } else { f64::NAN })
}

fn ternary(function: Ternary, a: Jet, b: Jet, c: Jet) -> Jet {
    match function {
        Ternary::If if a.value.is_nan() => a,
        Ternary::If => {
            if a.value != 0.0 {
                b
            } else {
                c
            }
        }
        Ternary::Smoothstep => c.smoothstep(a, b),
    }
}
