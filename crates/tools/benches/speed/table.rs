//! The table that is printed, in Markdown: docs/performance.md holds it.

/// A row.
#[derive(Default)]
pub struct Row {
    /// What is measured, with our settings.
    pub what: String,
    /// Ours.
    pub ours: Amount,
    /// The peer's, and its settings.
    pub peer: Option<(Amount, String)>,
    /// Our error and the peer's, in words.
    pub errors: [String; 2],
    /// What is wanted.
    pub goal: &'static str,
}

/// A number with its unit.
#[derive(Clone, Copy, Debug, Default)]
pub enum Amount {
    /// Time, s.
    Time(f64),
    /// Memory, bytes.
    Memory(f64),
    /// A number without a unit.
    Number(f64),
    /// Could not be measured here.
    #[default]
    Unknown,
}

impl Amount {
    fn value(self) -> f64 {
        match self {
            Self::Time(value) | Self::Memory(value) | Self::Number(value) => value,
            Self::Unknown => f64::NAN,
        }
    }

    fn text(self) -> String {
        let scaled = |value: f64, units: [(f64, &str); 4]| {
            let (scale, unit) = units.into_iter().find(|(scale, _)| value >= *scale).unwrap_or(units[3]);
            format!("{} {unit}", digits(value / scale))
        };
        match self {
            Self::Time(value) => scaled(value, [(1.0, "s"), (1e-3, "ms"), (1e-6, "us"), (1e-9, "ns")]),
            Self::Memory(value) => scaled(value, [(1e9, "GB"), (1e6, "MB"), (1e3, "kB"), (1.0, "B")]),
            Self::Number(value) => digits(value),
            Self::Unknown => String::new(),
        }
    }
}

/// Three digits.
fn digits(value: f64) -> String {
    let decimals = (2.0 - value.abs().log10().floor()).clamp(0.0, 9.0) as usize;
    format!("{value:.decimals$}")
}

/// The lines above the rows.
pub const HEAD: &str =
    "| | ours | EXUDYN 1.13.6 | ratio | error, ours | error, EXUDYN | goal |\n|---|---|---|---|---|---|---|";

impl Row {
    /// Its line; the ratio is the peer's cost over ours.
    pub fn line(&self) -> String {
        let (peer, ratio) = match &self.peer {
            Some((amount, settings)) => {
                (format!("{}, {settings}", amount.text()), digits(amount.value() / self.ours.value()))
            }
            None => Default::default(),
        };
        let (what, ours, [own, other], goal) = (&self.what, self.ours.text(), &self.errors, self.goal);
        format!("| {what} | {ours} | {peer} | {ratio} | {own} | {other} | {goal} |")
    }
}
