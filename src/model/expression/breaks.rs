//! Where the tables in an expression have corners: there its derivative jumps, and a step of the solver should end.
//!
//! They are known where the argument of a table is `rate * x + start`, of which functions of the file pass on the
//! variable too; corners of a table whose argument is curved are found as the motion gets there, by bounds
//! ([`super::over`]).

use super::program::{Binary, Body, Operation, Program, STACK, Unary, binary, unary};
use crate::math::jet::Jet;

/// Corners at most of a table that repeats itself: far more than anybody has steps for, far less than memory holds.
const MOST: usize = 1_000_000;

/// `rate * x + start`.
#[derive(Clone, Copy, Debug)]
struct Line {
    rate: f64,
    start: f64,
}

impl Line {
    fn constant(start: f64) -> Self {
        Self { rate: 0.0, start }
    }

    fn at(self, x: f64) -> f64 {
        self.rate * x + self.start
    }
}

/// Whether a program may have corners, or jumps. Functions of the file may have them.
pub(super) fn has_corners(program: &Program) -> bool {
    let corners = |operation: &Operation| match operation {
        Operation::Unary(function) => matches!(function, Unary::Abs | Unary::Sign | Unary::Floor | Unary::Ceil),
        Operation::Binary(function) => !matches!(
            function,
            Binary::Add | Binary::Subtract | Binary::Multiply | Binary::Divide | Binary::Power | Binary::Atan2
        ),
        Operation::Ternary(_) | Operation::Call(_) => true,
        Operation::Constant(_)
        | Operation::Parameter(_)
        | Operation::Variable
        | Operation::Rate
        | Operation::Reading(_) => false,
    };
    program.operations().iter().any(corners)
}

/// The corners of a program with bound parameters, in any order; of tables that repeat themselves those in `range`.
pub(super) fn breaks(program: &Program, range: [f64; 2]) -> Vec<f64> {
    let mut found = Vec::new();
    walk(program, Line { rate: 1.0, start: 0.0 }, range, &mut found);
    found
}

/// What a program is of `variable`; none: it is no straight line.
fn walk(program: &Program, variable: Line, range: [f64; 2], found: &mut Vec<f64>) -> Option<Line> {
    let mut stack = [None; STACK];
    let mut height = 0;
    for operation in program.operations() {
        match *operation {
            Operation::Constant(value) => {
                stack[height] = Some(Line::constant(value));
                height += 1;
            }
            Operation::Parameter(_) | Operation::Rate | Operation::Reading(_) => {
                stack[height] = None;
                height += 1;
            }
            Operation::Variable => {
                stack[height] = Some(variable);
                height += 1;
            }
            Operation::Unary(function) => stack[height - 1] = stack[height - 1].and_then(|line| one(function, line)),
            Operation::Binary(function) => {
                height -= 1;
                let lines = stack[height - 1].zip(stack[height]);
                stack[height - 1] = lines.and_then(|(a, b)| two(function, a, b));
            }
            Operation::Ternary(_) => {
                height -= 2;
                stack[height - 1] = None;
            }
            Operation::Call(number) => {
                let argument = stack[height - 1];
                stack[height - 1] = match (&program.called(number).body, argument) {
                    (Body::Expression(inner), Some(argument)) => walk(inner, argument, range, found),
                    (Body::Table(table), Some(line)) if line.rate != 0.0 => {
                        let ends = range.map(|x| line.at(x));
                        let ends = if ends[0] <= ends[1] { ends } else { [ends[1], ends[0]] };
                        let corners = table.breaks(ends, MOST.saturating_sub(found.len()));
                        found.extend(corners.into_iter().map(|corner| (corner - line.start) / line.rate));
                        None
                    }
                    (Body::Table(table), Some(line)) => Some(Line::constant(table.jet(line.start).value)),
                    (_, None) => None,
                };
            }
        }
    }
    stack[0]
}

fn one(function: Unary, a: Line) -> Option<Line> {
    match function {
        Unary::Negate => Some(Line { rate: -a.rate, start: -a.start }),
        _ if a.rate == 0.0 => Some(Line::constant(unary(function, Jet::constant(a.start)).value)),
        _ => None,
    }
}

fn two(function: Binary, a: Line, b: Line) -> Option<Line> {
    match function {
        Binary::Add => Some(Line { rate: a.rate + b.rate, start: a.start + b.start }),
        Binary::Subtract => Some(Line { rate: a.rate - b.rate, start: a.start - b.start }),
        Binary::Multiply if b.rate == 0.0 => Some(Line { rate: a.rate * b.start, start: a.start * b.start }),
        Binary::Multiply if a.rate == 0.0 => Some(Line { rate: a.start * b.rate, start: a.start * b.start }),
        Binary::Divide if b.rate == 0.0 => Some(Line { rate: a.rate / b.start, start: a.start / b.start }),
        _ if a.rate == 0.0 && b.rate == 0.0 => {
            Some(Line::constant(binary(function, Jet::constant(a.start), Jet::constant(b.start)).value))
        }
        _ => None,
    }
}
