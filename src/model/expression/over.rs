//! Bounds of an expression over an interval of its variable: the operations of [`Program::run`], on bounds.

use super::program::{Binary, Body, Operation, Program, STACK, Ternary, Unary};
use crate::math::bounds::Bounds;

impl Program {
    /// Bounds over those of the variable. The parameters are bound.
    pub(super) fn over(&self, variable: Bounds) -> Bounds {
        let mut stack = [Bounds::default(); STACK];
        let mut height = 0;
        for operation in self.operations() {
            match *operation {
                Operation::Constant(value) => {
                    stack[height] = Bounds::constant(value);
                    height += 1;
                }
                Operation::Variable => {
                    stack[height] = variable;
                    height += 1;
                }
                Operation::Parameter(_) | Operation::Rate | Operation::Reading(_) => {
                    stack[height] = Bounds::unknown();
                    height += 1;
                }
                Operation::Unary(function) => stack[height - 1] = unary(function, stack[height - 1]),
                Operation::Binary(function) => {
                    height -= 1;
                    stack[height - 1] = binary(function, stack[height - 1], stack[height]);
                }
                Operation::Ternary(function) => {
                    height -= 2;
                    let [a, b, c] = [stack[height - 1], stack[height], stack[height + 1]];
                    stack[height - 1] = match function {
                        Ternary::If => Bounds::choice(a, b, c),
                        Ternary::Smoothstep => c.smoothstep(a, b),
                    };
                }
                Operation::Call(number) => {
                    let argument = stack[height - 1];
                    stack[height - 1] = match &self.called(number).body {
                        Body::Expression(program) => {
                            let inner = Bounds { follows: argument.follows, ..Bounds::variable(argument.value) };
                            argument.into_function(program.over(inner))
                        }
                        Body::Table(table) => argument.into_function(table.over(argument)),
                    };
                }
            }
        }
        stack[0]
    }
}

fn unary(function: Unary, a: Bounds) -> Bounds {
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

fn binary(function: Binary, a: Bounds, b: Bounds) -> Bounds {
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
        Binary::Step => Bounds::at_most(a, b),
        Binary::Less => Bounds::less(a, b),
        Binary::AtMost => Bounds::at_most(a, b),
        Binary::Greater => Bounds::less(b, a),
        Binary::AtLeast => Bounds::at_most(b, a),
        Binary::Equal => Bounds::equal(a, b),
        Binary::Unequal => Bounds::equal(a, b).complement(),
        Binary::And => Bounds::and(a, b),
        Binary::Or => Bounds::or(a, b),
    }
}
