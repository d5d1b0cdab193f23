//! Text to [`Program`], by recursive descent with a bounded depth.
//!
//! ```text
//! expression = all { "or" all }
//! all     = comparison { "and" comparison }
//! comparison = sum [ ("<" | "<=" | ">" | ">=" | "==" | "!=") sum ]
//! sum     = product { ("+" | "-") product }
//! product = sign { ("*" | "/") sign }
//! sign    = ("+" | "-") sign | power
//! power   = atom [ "^" sign ]
//! atom    = number | name | name "(" expression { "," expression } ")" | "(" expression ")"
//! ```

use super::Variable;
use super::program::{Binary, Callable, Called, FUNCTIONS, MORE_FUNCTIONS, Operation, Program, Unary};
use std::ops::Range;
use std::sync::Arc;

/// Depth of nesting; deep enough for every formula that someone writes, far from the end of the stack.
const DEPTH: usize = 60;
/// Longest text in bytes.
pub const LENGTH: usize = 4000;
/// The comparison operators; none is the beginning of a later one.
const COMPARATORS: [(&str, Binary); 6] = [
    ("<=", Binary::AtMost),
    (">=", Binary::AtLeast),
    ("==", Binary::Equal),
    ("!=", Binary::Unequal),
    ("<", Binary::Less),
    (">", Binary::Greater),
];

/// Why a text is no expression.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExpressionError {
    /// What is wrong.
    pub message: String,
    /// What stands below the underlined text: what was expected.
    pub label: String,
    /// The offending bytes of the text.
    pub range: Range<usize>,
    /// A name that is not known: the caller, who knows the names, offers the nearest.
    pub unknown: Option<String>,
    /// Whether it follows from another mistake, which is reported.
    pub is_reported: bool,
}

/// The names that an expression may use besides those of the language.
#[derive(Clone, Copy)]
pub struct Scope<'a> {
    /// The variable; empty: none.
    pub variable: &'a str,
    /// The rate of the variable, in laws of springs; empty: none.
    pub rate: &'a str,
    /// The place of a parameter.
    pub parameter: &'a dyn Fn(&str) -> Option<usize>,
    /// A function of the file.
    pub function: &'a dyn Fn(&str) -> Option<Callee>,
    /// The function of the file whose value the expression is; none: it stands elsewhere.
    pub inside: Option<&'a str>,
    /// The number of a coordinate of a part, `hinge.angle`, or why there is none, in two parts; none: coordinates are
    /// not known here.
    pub reading: Option<&'a ReadingLookup<'a>>,
}

/// See [`Scope::reading`].
pub type ReadingLookup<'a> = dyn Fn(&str, &str) -> Result<usize, [String; 2]> + 'a;

/// A function of the file, as a call finds it.
#[derive(Clone, Debug)]
pub enum Callee {
    /// It can be called.
    Sound(Arc<Called>),
    /// It has a mistake, which is reported.
    Broken,
}

/// Compiles `text` without functions of the file. `lookup` gives the place of a parameter by its name.
///
/// # Errors
/// The text is no expression, too long, too deep, or uses an unknown name.
pub fn compile(
    text: &str,
    variable: Variable,
    lookup: &dyn Fn(&str) -> Option<usize>,
) -> Result<Program, ExpressionError> {
    compile_in(
        text,
        Scope {
            variable: variable.word(),
            rate: variable.rate(),
            parameter: lookup,
            function: &|_| None,
            inside: None,
            reading: None,
        },
    )
}

/// Compiles `text` with the names of `scope`.
///
/// # Errors
/// Those of [`compile`], and calls of functions that have mistakes.
pub fn compile_in(text: &str, scope: Scope<'_>) -> Result<Program, ExpressionError> {
    if text.len() > LENGTH {
        let message = format!("the expression has {} bytes, the limit is {LENGTH}", text.len());
        return Err(error(message, "too long", 0..text.len()));
    }
    let mut parser = Parser { text, scope, at: 0, depth: 0, operations: Vec::new(), calls: Vec::new() };
    parser.skip_space();
    if parser.at == text.len() {
        return Err(error("the expression is empty", "a number or an expression was expected", 0..text.len()));
    }
    parser.expression()?;
    if parser.at < text.len() {
        return Err(parser.unexpected("an operator (+ - * / ^) or the end was expected"));
    }
    let has_calls = !parser.calls.is_empty();
    Program::new(parser.operations, parser.calls).ok_or_else(|| match has_calls {
        true => error("the functions called here are too long or call one another too deeply", "", 0..text.len()),
        false => error("the expression is nested too deeply", "too deep", 0..text.len()),
    })
}

fn error(message: impl Into<String>, label: impl Into<String>, range: Range<usize>) -> ExpressionError {
    ExpressionError { message: message.into(), label: label.into(), range, unknown: None, is_reported: false }
}

struct Parser<'a> {
    text: &'a str,
    scope: Scope<'a>,
    at: usize,
    depth: usize,
    operations: Vec<Operation>,
    calls: Vec<Arc<Called>>,
}

impl Parser<'_> {
    fn skip_space(&mut self) {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
    }

    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }

    /// Takes `symbol` and the space after it, if it comes next.
    fn take(&mut self, symbol: char) -> bool {
        let found = self.peek() == Some(symbol);
        if found {
            self.at += symbol.len_utf8();
            self.skip_space();
        }
        found
    }

    fn unexpected(&self, label: &str) -> ExpressionError {
        match self.peek() {
            Some(c) => error(format!("unexpected `{c}` in the expression"), label, self.at..self.at + c.len_utf8()),
            None => error("the expression ends too early", label, self.at..self.at),
        }
    }

    fn enter(&mut self) -> Result<(), ExpressionError> {
        self.depth += 1;
        if self.depth > DEPTH {
            return Err(error("the expression is nested too deeply", format!("deeper than {DEPTH}"), self.at..self.at));
        }
        Ok(())
    }

    /// Takes a word and the space after it, if it comes next.
    fn take_word(&mut self, word: &str) -> bool {
        let is_end = |c: Option<char>| !c.is_some_and(|c| c.is_ascii_alphanumeric() || c == '_');
        let found = self.text[self.at..].strip_prefix(word).is_some_and(|rest| is_end(rest.chars().next()));
        if found {
            self.at += word.len();
            self.skip_space();
        }
        found
    }

    fn expression(&mut self) -> Result<(), ExpressionError> {
        self.all()?;
        while self.take_word("or") {
            self.all()?;
            self.operations.push(Operation::Binary(Binary::Or));
        }
        Ok(())
    }

    fn all(&mut self) -> Result<(), ExpressionError> {
        self.comparison()?;
        while self.take_word("and") {
            self.comparison()?;
            self.operations.push(Operation::Binary(Binary::And));
        }
        Ok(())
    }

    fn comparison(&mut self) -> Result<(), ExpressionError> {
        self.sum()?;
        let Some(operation) = self.comparator()? else { return Ok(()) };
        self.sum()?;
        self.operations.push(Operation::Binary(operation));
        let begin = self.at;
        match self.comparator()? {
            None => Ok(()),
            Some(_) => {
                let label = "write `a < b and b < c`";
                Err(error("two comparisons stand in a row", label, begin..self.at))
            }
        }
    }

    /// Takes a comparison operator and the space after it, if one comes next.
    fn comparator(&mut self) -> Result<Option<Binary>, ExpressionError> {
        let rest = &self.text[self.at..];
        let Some((sign, operation)) = COMPARATORS.iter().find(|(sign, _)| rest.starts_with(sign)) else {
            return match rest.starts_with('=') {
                true => Err(error("`=` is not a comparison", "equality is written ==", self.at..self.at + 1)),
                false => Ok(None),
            };
        };
        self.at += sign.len();
        self.skip_space();
        Ok(Some(*operation))
    }

    fn sum(&mut self) -> Result<(), ExpressionError> {
        self.enter()?;
        self.product()?;
        loop {
            let operation = match self.peek() {
                Some('+') => Binary::Add,
                Some('-') => Binary::Subtract,
                _ => break,
            };
            self.at += 1;
            self.skip_space();
            self.product()?;
            self.operations.push(Operation::Binary(operation));
        }
        self.depth -= 1;
        Ok(())
    }

    fn product(&mut self) -> Result<(), ExpressionError> {
        self.sign()?;
        loop {
            let operation = match self.peek() {
                Some('*') => Binary::Multiply,
                Some('/') => Binary::Divide,
                _ => return Ok(()),
            };
            self.at += 1;
            if operation == Binary::Multiply && self.peek() == Some('*') {
                return Err(error("`**` is no operator", "a power is written with ^", self.at - 1..self.at + 1));
            }
            self.skip_space();
            self.sign()?;
            self.operations.push(Operation::Binary(operation));
        }
    }

    fn sign(&mut self) -> Result<(), ExpressionError> {
        self.enter()?;
        if self.take('-') {
            self.sign()?;
            self.operations.push(Operation::Unary(Unary::Negate));
        } else if self.take('+') {
            self.sign()?;
        } else {
            self.power()?;
        }
        self.depth -= 1;
        Ok(())
    }

    fn power(&mut self) -> Result<(), ExpressionError> {
        self.atom()?;
        if self.take('^') {
            self.sign()?;
            self.operations.push(Operation::Binary(Binary::Power));
        }
        Ok(())
    }

    fn atom(&mut self) -> Result<(), ExpressionError> {
        match self.peek() {
            Some('(') => {
                self.take('(');
                self.expression()?;
                if self.take(')') { Ok(()) } else { Err(self.unexpected("`)` or an operator was expected")) }
            }
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if c.is_ascii_alphabetic() || c == '_' => self.name(),
            _ => Err(self.unexpected("a number, a name or `(` was expected")),
        }
    }

    fn number(&mut self) -> Result<(), ExpressionError> {
        let bytes = self.text.as_bytes();
        let start = self.at;
        let digits = |mut at: usize| {
            while bytes.get(at).is_some_and(u8::is_ascii_digit) {
                at += 1;
            }
            at
        };
        let mut end = digits(start);
        if bytes.get(end) == Some(&b'.') {
            end = digits(end + 1);
        }
        if matches!(bytes.get(end), Some(b'e' | b'E')) {
            let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
            let exponent_end = digits(end + 1 + sign);
            if exponent_end > end + 1 + sign {
                end = exponent_end;
            }
        }
        let value: f64 = self.text[start..end]
            .parse()
            .map_err(|_| error("this is no number", "a number was expected", start..end))?;
        if !value.is_finite() {
            return Err(error("the number is too large", "beyond 1.8e308", start..end));
        }
        self.at = end;
        if self.peek().is_some_and(|c| c.is_ascii_alphabetic() || c == '_' || c == '(') {
            return Err(self.unexpected("an operator was expected: a product is written with *"));
        }
        self.skip_space();
        self.operations.push(Operation::Constant(value));
        Ok(())
    }

    fn name(&mut self) -> Result<(), ExpressionError> {
        let start = self.at;
        let rest = &self.text[start..];
        let length = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(rest.len());
        let name = &rest[..length];
        let range = start..start + length;
        self.at = range.end;
        if let Some(key) =
            rest[length..].strip_prefix('.').filter(|key| key.starts_with(|c: char| c.is_ascii_alphabetic()))
        {
            return self.reading(name, key, start);
        }
        self.skip_space();
        if let Some((_, callable)) = FUNCTIONS.iter().find(|(function, _)| *function == name) {
            return self.call(name, *callable, range);
        }
        if self.peek() == Some('(')
            && let Some((_, callable)) = MORE_FUNCTIONS.iter().find(|(function, _)| *function == name)
        {
            return self.call(name, *callable, range);
        }
        if self.peek() == Some('(')
            && let Some(callee) = (self.scope.function)(name)
        {
            return self.call_of_file(name, callee, range);
        }
        let operation = match name {
            "pi" => Operation::Constant(std::f64::consts::PI),
            "e" => Operation::Constant(std::f64::consts::E),
            _ if name == self.scope.variable || name == self.scope.rate => {
                if !self.scope.rate.is_empty() && (self.scope.parameter)(name).is_some() {
                    let label = "rename the entry of [parameters]: in this law, x is the elongation and v its rate";
                    return Err(error(format!("`{name}` is both a variable and a parameter"), label, range));
                }
                if name == self.scope.variable { Operation::Variable } else { Operation::Rate }
            }
            "t" | "s" if let Some(function) = self.scope.inside => {
                let label = format!("{function} has the argument `{}`", self.scope.variable);
                return Err(error(format!("`{name}` is not known here"), label, range));
            }
            "t" => {
                return Err(error(
                    "`t` is not known here",
                    "time is known in loads, drives, frames, efforts of actuators, temperatures and `active` only",
                    range,
                ));
            }
            "s" => {
                return Err(error(
                    "`s` is not known here",
                    "`s` is known in x, y and z of a curve, in sections along a beam and in temperatures only",
                    range,
                ));
            }
            _ => match (self.scope.parameter)(name) {
                Some(place) => Operation::Parameter(place),
                None if (self.scope.function)(name).is_some() => {
                    let message = format!("`{name}` is a function");
                    return Err(error(message, format!("{name}(...) was expected"), range));
                }
                None => {
                    let label = "no entry of [parameters], no function, no constant has this name";
                    let mut unknown = error(format!("unknown name `{name}` in the expression"), label, range);
                    unknown.unknown = Some(name.to_owned());
                    return Err(unknown);
                }
            },
        };
        if self.peek() == Some('(') {
            let mut unknown = error(format!("`{name}` is no function"), "a product is written with *", range);
            unknown.unknown = Some(name.to_owned());
            return Err(unknown);
        }
        self.operations.push(operation);
        Ok(())
    }

    /// A coordinate of a part, whose name begins at `start`, or its rate; `key` begins the text behind the point.
    fn reading(&mut self, name: &str, key: &str, start: usize) -> Result<(), ExpressionError> {
        let key = &key[..key.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(key.len())];
        self.at += 1 + key.len();
        let range = start..self.at;
        self.skip_space();
        let Some(lookup) = self.scope.reading else {
            let label = "coordinates of joints are known in the effort of an actuator only; a [gear] ties two of them, by a ratio or a law";
            return Err(error(format!("`{name}.{key}` is not known here"), label, range));
        };
        let number = lookup(name, key).map_err(|[message, label]| error(message, label, range))?;
        self.operations.push(Operation::Reading(number));
        Ok(())
    }

    /// A call of a function of the file, behind its name.
    fn call_of_file(&mut self, name: &str, callee: Callee, range: Range<usize>) -> Result<(), ExpressionError> {
        let Callee::Sound(called) = callee else {
            return Err(ExpressionError { is_reported: true, ..error("", "", range) });
        };
        self.take('(');
        self.expression()?;
        if self.take(',') {
            return Err(error(format!("`{name}` has more than one argument here"), "it takes 1 argument", range));
        }
        if !self.take(')') {
            return Err(self.unexpected("`)` or an operator was expected"));
        }
        let known = self.calls.iter().position(|known| Arc::ptr_eq(known, &called));
        self.operations.push(Operation::Call(known.unwrap_or(self.calls.len())));
        if known.is_none() {
            self.calls.push(called);
        }
        Ok(())
    }

    fn call(&mut self, name: &str, callable: Callable, range: Range<usize>) -> Result<(), ExpressionError> {
        if !self.take('(') {
            return Err(error(format!("`{name}` is a function"), format!("{name}(...) was expected"), range));
        }
        let mut count = 1;
        self.expression()?;
        while self.take(',') {
            self.expression()?;
            count += 1;
            // At once, not at the end: so max of many needs a stack of two.
            if let Callable::Many(function) = callable {
                self.operations.push(Operation::Binary(function));
            }
        }
        if !self.take(')') {
            return Err(self.unexpected("`)`, `,` or an operator was expected"));
        }
        let (fits, wanted) = match callable {
            Callable::One(_) => (count == 1, "1 argument"),
            Callable::Two(_) => (count == 2, "2 arguments"),
            Callable::Three(_) => (count == 3, "3 arguments"),
            Callable::Many(_) => (count >= 2, "2 or more arguments"),
        };
        if !fits {
            return Err(error(format!("`{name}` has {count} argument(s) here"), format!("it takes {wanted}"), range));
        }
        match callable {
            Callable::One(function) => self.operations.push(Operation::Unary(function)),
            Callable::Two(function) => self.operations.push(Operation::Binary(function)),
            Callable::Three(function) => self.operations.push(Operation::Ternary(function)),
            Callable::Many(_) => {}
        }
        Ok(())
    }
}
