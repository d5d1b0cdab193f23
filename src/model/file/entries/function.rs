//! `[function.NAME]`: a function of one argument that expressions call, as an expression or as a table.

use crate::model::expression::program::{Body, Called};
use crate::model::expression::table::{Interpolation, MOST_ROWS, Outside, Table};
use crate::model::expression::{Callee, Program};
use crate::model::file::reader::{Context, Reader};
use crate::model::file::schema::{Key, Role, words_of};
use crate::model::text::diagnostic::Place;
use crate::model::text::names::{Kind, is_legal, is_reserved};
use crate::model::text::tree::{Entry, Item, Node};
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::sync::Arc;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::word("value", &[], "the expression of the function, by its argument"),
    Key::word("argument", &[], "the name of the argument in `value`"),
    Key::name("table", Role::Number, "rows of argument and value, instead of `value`"),
    Key::word("file", &[], "a file of rows of argument and value, instead of `value`"),
    Key::word("column", &[], "the column of the file that has the values"),
    Key::word("interpolation", &words_of(&INTERPOLATIONS), "how values between two rows are found"),
    Key::word("outside", &words_of(&OUTSIDES), "the values before the first and behind the last row"),
];

/// The argument where the file does not name it.
const ARGUMENT: &str = "x";
/// The words of `interpolation`.
const INTERPOLATIONS: [(&str, Interpolation); 2] =
    [("linear", Interpolation::Linear), ("monotone", Interpolation::Monotone)];
/// The words of `outside`.
const OUTSIDES: [(&str, Outside); 3] =
    [("hold", Outside::Hold), ("repeat", Outside::Repeat), ("error", Outside::Error)];

/// A function whose expression is not compiled yet.
struct Pending {
    name: String,
    argument: String,
    text: String,
    place: Place,
    /// The functions that it calls and that are not compiled yet, by their names.
    calls: Vec<String>,
}

/// Reads all functions of the file into the context. The names of the parameters must be in the list of numbers.
pub(in crate::model) fn read(context: &mut Context<'_>, sections: Vec<Entry>) {
    let mut pending = Vec::new();
    for Entry { key: name, key_place, item } in sections {
        let Node::Table(entries) = item.node else { continue };
        let reader = Reader::new(context, KEYS, format!("[function.{name}]"), format!("{name}."), key_place, entries);
        match section(&name, reader) {
            Some(Read::Body(body)) => put(context, name, Some(body)),
            Some(Read::Text { argument, text, place }) => {
                pending.push(Pending { name, argument, text, place, calls: Vec::new() });
            }
            None => put(context, name, None),
        }
    }
    let names: Vec<String> = pending.iter().map(|function| function.name.clone()).collect();
    for function in &mut pending {
        let found = RefCell::new(Vec::new());
        context.find_calls(&function.text, &function.argument, &|name| {
            if names.iter().any(|known| known == name) {
                found.borrow_mut().push(name.to_owned());
            }
        });
        function.calls = found.into_inner();
    }
    compile_all(context, pending);
}

/// Compiles functions in an order in which each calls only earlier ones; a circle is reported.
fn compile_all(context: &mut Context<'_>, mut pending: Vec<Pending>) {
    loop {
        let open: BTreeSet<String> = pending.iter().map(|function| function.name.clone()).collect();
        let is_ready = |function: &Pending| !function.calls.iter().any(|name| open.contains(name));
        let (ready, rest): (Vec<_>, Vec<_>) = pending.into_iter().partition(is_ready);
        pending = rest;
        if ready.is_empty() {
            break;
        }
        for function in ready {
            let program = context.function_program(&function.text, function.place, &function.name, &function.argument);
            put(context, function.name, program.map(Body::Expression));
        }
    }
    if let Some(first) = pending.first() {
        let (circle, place) = circle(first, &pending);
        let message = format!("the functions {circle} need each other");
        context.report.error(place, &message, "part of a cycle", "let one of them do without the others");
    }
    for function in pending {
        put(context, function.name, None);
    }
}

/// A circle of calls that `start` leads to, as text, and where one of its functions is written.
fn circle(start: &Pending, pending: &[Pending]) -> (String, Place) {
    let mut path = vec![start];
    loop {
        let last = path[path.len() - 1];
        let next = pending.iter().find(|other| last.calls.contains(&other.name));
        let next = next.expect("a function that is left calls another one that is left");
        if let Some(begin) = path.iter().position(|function| function.name == next.name) {
            let names: Vec<_> = path[begin..].iter().chain([&next]).map(|function| function.name.as_str()).collect();
            return (names.join(" -> "), next.place);
        }
        path.push(next);
    }
}

fn put(context: &mut Context<'_>, name: String, body: Option<Body>) {
    let callee = body.map_or(Callee::Broken, |body| Callee::Sound(Arc::new(Called { name: name.clone(), body })));
    context.functions.push((name, callee));
}

/// What a section gives.
enum Read {
    Body(Body),
    Text { argument: String, text: String, place: Place },
}

/// A section; none: a mistake, which is reported.
fn section(name: &str, mut reader: Reader<'_, '_>) -> Option<Read> {
    let read = if reader.has("file") {
        refuse_file(&mut reader);
        None
    } else if reader.has("table") {
        reader.exclude("value", "table");
        reader.exclude("argument", "table");
        table(name, &mut reader)
    } else {
        for key in ["interpolation", "outside"] {
            let message = format!("`{key}` in {} belongs to a table", reader.title);
            reader.refuse(key, &message, "this function is an expression");
        }
        expression(&mut reader)
    };
    reader.finish();
    read
}

/// The rows of a file are read before: one that is left stands in a text without a folder, or in an override.
fn refuse_file(reader: &mut Reader<'_, '_>) {
    for key in ["value", "argument", "table"] {
        reader.exclude(key, "file");
    }
    for key in ["column", "interpolation", "outside"] {
        reader.take(key);
    }
    let Some((file, place)) = reader.text("file") else { return };
    let message = format!("`{file}` cannot be read: this model is a text without a folder");
    let help = "load the model from its file, or load the text that `ancf14 check --resolved` prints";
    reader.context.report.error(place, &message, "", help);
}

fn expression(reader: &mut Reader<'_, '_>) -> Option<Read> {
    let value = reader.take("value");
    let argument = match reader.has("argument") {
        true => argument(reader)?,
        false => ARGUMENT.to_owned(),
    };
    let Some(Entry { item, .. }) = value else {
        reader.missing("value", "value = \"2*x\", table = [[0, 0], [1, 5]] or file = \"wind.csv\"");
        return None;
    };
    if reader.context.numbers.parameter(&argument).is_some() {
        let message = format!("`{argument}` is both the argument of {} and an entry of [parameters]", reader.title);
        let place = reader.place;
        reader.context.report.error(place, &message, "", "name the argument differently: argument = \"u\"");
        return None;
    }
    match item.node {
        Node::Integer(value) => Some(Read::Body(Body::Expression(Program::constant(value as f64)))),
        Node::Float(value) => Some(Read::Body(Body::Expression(Program::constant(value)))),
        Node::Text(text) => Some(Read::Text { argument, text, place: item.place }),
        _ => {
            reader.context.wrong_type("value", &item, "an expression of the argument, in quotes,");
            None
        }
    }
}

fn argument(reader: &mut Reader<'_, '_>) -> Option<String> {
    let (argument, place) = reader.text("argument")?;
    // The variables of other places may be arguments.
    let is_variable = argument == "t" || argument == "s";
    if !is_legal(&argument) || is_reserved(Kind::Function, &argument) && !is_variable {
        let message = format!("`{argument}` cannot be the name of an argument");
        let help = "a name is a letter, then letters, digits and _; names of constants and functions are taken";
        reader.context.report.error(place, &message, "another name was expected", help);
        return None;
    }
    Some(argument)
}

fn table(name: &str, reader: &mut Reader<'_, '_>) -> Option<Read> {
    let interpolation = reader.word("interpolation", &INTERPOLATIONS, Some(Interpolation::Linear))?;
    let outside = reader.word("outside", &OUTSIDES, Some(Outside::Hold))?;
    let Entry { item, .. } = reader.take("table")?;
    let context = &mut *reader.context;
    let Node::Array(rows) = &item.node else {
        context.wrong_type(&format!("{name}.table"), &item, "a list of rows, [x, y] each,");
        return None;
    };
    if rows.len() < 2 {
        let message = format!("the table of {} has {} row(s)", reader.title, rows.len());
        context.report.error(item.place, &message, "at least 2 rows were expected", "table = [[0, 0], [1, 5]]");
        return None;
    }
    if rows.len() > MOST_ROWS {
        let message = format!("the table of {} has {} rows", reader.title, rows.len());
        let help = "leave out rows that a straight line between their neighbors replaces";
        context.report.error(rows[MOST_ROWS].place, &message, &format!("the limit is {MOST_ROWS}"), help);
        return None;
    }
    let (mut x, mut y) = (Vec::with_capacity(rows.len()), Vec::with_capacity(rows.len()));
    for (number, row) in rows.iter().enumerate() {
        let Some([argument, value]) = pair(row) else {
            context.wrong_type(&format!("{name}.table[{}]", number + 1), row, "a row of 2 numbers, [x, y],");
            return None;
        };
        if let Some(before) = x.last().copied().filter(|before| *before >= argument) {
            let message = format!("the arguments of {} do not ascend", reader.title);
            let label = format!("{argument} comes after {before}");
            let help = "each row needs a greater argument than the row before it";
            context.report.error(row.place, &message, &label, help);
            return None;
        }
        let steepness = x.last().zip(y.last()).map_or(0.0, |(before, last)| (value - last) / (argument - before));
        if !f64::is_finite(steepness) {
            let message = format!("the values of {} change too much from row to row", reader.title);
            context.report.error(row.place, &message, "the slope from the row before is not a finite number", "");
            return None;
        }
        x.push(argument);
        y.push(value);
    }
    Some(Read::Body(Body::Table(Table::new(x, y, interpolation, outside))))
}

/// The two numbers of a row.
fn pair(row: &Item) -> Option<[f64; 2]> {
    let number = |item: &Item| match item.node {
        Node::Integer(value) => Some(value as f64),
        Node::Float(value) => Some(value),
        _ => None,
    };
    match &row.node {
        Node::Array(items) => match items.as_slice() {
            [x, y] => Some([number(x)?, number(y)?]),
            _ => None,
        },
        _ => None,
    }
}
