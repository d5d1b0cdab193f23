//! A compiled expression: a flat list of operations on a stack of jets, evaluated without allocation.

use crate::math::jet::Jet;

/// Height of the evaluation stack: the parser refuses expressions that need more.
pub const STACK: usize = 64;

/// One operation; it takes its arguments from the stack and leaves its result there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operation {
    /// A number.
    Constant(f64),
    /// A parameter, by its place in the list that the caller gives.
    Parameter(usize),
    /// The variable, t or s.
    Variable,
    /// A function of one argument.
    Unary(Unary),
    /// A function of two arguments.
    Binary(Binary),
    /// A function of three arguments.
    Ternary(Ternary),
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

/// A compiled expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    operations: Vec<Operation>,
}

impl Program {
    /// The program that is one number.
    pub fn constant(value: f64) -> Self {
        Self { operations: vec![Operation::Constant(value)] }
    }

    /// From operations in the order of their execution; None if they need a higher stack than [`STACK`].
    pub(super) fn new(operations: Vec<Operation>) -> Option<Self> {
        let mut height = 0_usize;
        for operation in &operations {
            height = match operation {
                Operation::Constant(_) | Operation::Parameter(_) | Operation::Variable => height + 1,
                Operation::Unary(_) => height,
                Operation::Binary(_) => height - 1,
                Operation::Ternary(_) => height - 2,
            };
            if height > STACK {
                return None;
            }
        }
        assert_eq!(height, 1, "the parser leaves one result");
        Some(Self { operations })
    }

    /// Whether the variable does not occur.
    pub fn is_constant(&self) -> bool {
        !self.operations.contains(&Operation::Variable)
    }

    /// The parameters that occur, in the order of the text, repeats included.
    pub fn parameters(&self) -> impl Iterator<Item = usize> + '_ {
        self.operations.iter().filter_map(|operation| match operation {
            Operation::Parameter(place) => Some(*place),
            _ => None,
        })
    }

    /// The same program with the parameters as numbers: it needs no list any more.
    #[must_use]
    pub fn bound(&self, parameters: impl Fn(usize) -> f64) -> Self {
        let bind = |operation: &Operation| match *operation {
            Operation::Parameter(place) => Operation::Constant(parameters(place)),
            other => other,
        };
        let operations: Vec<_> = self.operations.iter().map(bind).collect();
        let bound = Self { operations };
        if bound.is_constant() { Self::constant(bound.value(0.0, |_| f64::NAN)) } else { bound }
    }

    /// `f`, with the variable and the parameters as given. NaN where a function is not defined.
    pub fn value(&self, variable: f64, parameters: impl Fn(usize) -> f64) -> f64 {
        self.jet(variable, parameters).value
    }

    /// `(f, f', f'')` by the variable.
    pub fn jet(&self, variable: f64, parameters: impl Fn(usize) -> f64) -> Jet {
        let mut stack = [Jet::default(); STACK];
        let mut height = 0;
        for operation in &self.operations {
            match *operation {
                Operation::Constant(value) => {
                    stack[height] = Jet::constant(value);
                    height += 1;
                }
                Operation::Parameter(place) => {
                    stack[height] = Jet::constant(parameters(place));
                    height += 1;
                }
                Operation::Variable => {
                    stack[height] = Jet::variable(variable);
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
            }
        }
        stack[0]
    }
}

fn unary(function: Unary, a: Jet) -> Jet {
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

fn binary(function: Binary, a: Jet, b: Jet) -> Jet {
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
