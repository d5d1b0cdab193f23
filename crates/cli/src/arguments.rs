//! Values of arguments that are more than a number or a word, and messages of their parser.

use std::io::ErrorKind;

/// `KEY=VALUE` of `--set`.
pub fn key_and_value(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() && !value.trim().is_empty() => {
            Ok((key.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("KEY=VALUE was expected, like steel.young=2.1e11".to_owned()),
    }
}

/// The value of `--budget`.
pub fn budget(text: &str) -> Result<f64, String> {
    let budget = text.parse().ok().filter(|budget| (1.0..=1e6).contains(budget));
    budget.ok_or_else(|| String::from("how many times the cost of the first run was expected, from 1 to 1e6, like 20"))
}

/// Shows a message of the argument parser: help and version are what was asked for, the rest is a mistake.
pub fn shown(text: &clap::Error) -> u8 {
    match text.print() {
        Err(reason) if reason.kind() != ErrorKind::BrokenPipe => 1,
        _ => u8::try_from(text.exit_code()).unwrap_or(2),
    }
}
