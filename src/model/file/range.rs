//! The values that a number may have.

/// An end of a range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// Where the range ends.
    pub value: f64,
    /// Whether the end itself is allowed.
    pub included: bool,
}

/// Allowed values of a number.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Range {
    /// The lower end.
    pub lower: Option<Limit>,
    /// The upper end.
    pub upper: Option<Limit>,
}

impl Range {
    /// Every finite number.
    pub const ALL: Self = Self { lower: None, upper: None };

    /// Whether a number lies in the range.
    pub fn contains(self, value: f64) -> bool {
        let above = self.lower.is_none_or(|limit| value > limit.value || (limit.included && value == limit.value));
        let below = self.upper.is_none_or(|limit| value < limit.value || (limit.included && value == limit.value));
        above && below
    }

    /// `greater than -1 and less than 0.5`.
    pub fn words(self) -> String {
        let lower = self.lower.map(|limit| (if limit.included { "at least" } else { "greater than" }, limit.value));
        let upper = self.upper.map(|limit| (if limit.included { "at most" } else { "less than" }, limit.value));
        let words: Vec<_> = lower.iter().chain(&upper).map(|(word, value)| format!("{word} {value}")).collect();
        words.join(" and ")
    }
}
