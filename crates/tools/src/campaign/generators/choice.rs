//! Random choices of an engineer: numbers of three digits, so that a file can be read.

use ancf14_testing::random::Random;

/// Seeded by a name.
pub struct Choice(Random);

impl Choice {
    /// The choices that go with a name.
    pub fn of(name: &str) -> Self {
        // FNV-1a: names that differ in a letter have nothing in common.
        let seed = name
            .bytes()
            .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
        Self(Random(seed))
    }

    /// Uniform between two numbers.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        round(low + 0.5 * (self.0.signed() + 1.0) * (high - low))
    }

    /// Between two numbers, with any power of ten as likely as the next.
    pub fn scale(&mut self, low: f64, high: f64) -> f64 {
        let share = 0.5 * (self.0.signed() + 1.0);
        round(low * (high / low).powf(share))
    }

    /// A whole number between two, both included.
    pub fn whole(&mut self, low: usize, high: usize) -> usize {
        low + self.0.below(high - low + 1)
    }

    /// One of a list.
    pub fn pick<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.0.below(list.len())]
    }

    /// A material damping, s: often none.
    pub fn damping(&mut self) -> f64 {
        self.pick(&[0.0, 0.0, 1e-6, 1e-5, 1e-4])
    }
}

/// Three digits.
pub fn round(value: f64) -> f64 {
    format!("{value:.2e}").parse().expect("a number that was printed")
}
