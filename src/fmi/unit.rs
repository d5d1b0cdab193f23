//! Unit labels: `kg.m2/s2`, `N.m`, `rad/s`, `1/m` to exponents of kg, m, s, K, rad, and the units hosts like to show.
//!
//! A label is a product of powers, `.` between factors, `/` once, everything after it in the denominator: the way
//! FMI's examples and Modelica write units. A factor is a unit with an optional decimal prefix and an integer power.

use super::variable::{Exponents, Quantity};

/// A unit: `1 label = scale` coherent SI units of these exponents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Exponents of the SI base units.
    pub exponents: Exponents,
    /// Power of ten in the scale, kept apart so that decimal scales stay exact.
    power_of_ten: i32,
    /// The rest of the scale: 1 for all but degrees, turns, minutes and hours.
    rest: f64,
}

/// Symbol, exponents of kg m s K rad, power of ten, rest of the scale, and whether decimal prefixes go with it.
const SYMBOLS: [(&str, [i32; 5], i32, f64, bool); 16] = [
    ("m", [0, 1, 0, 0, 0], 0, 1.0, true),
    ("g", [1, 0, 0, 0, 0], -3, 1.0, true),
    ("s", [0, 0, 1, 0, 0], 0, 1.0, true),
    ("K", [0, 0, 0, 1, 0], 0, 1.0, true),
    ("rad", [0, 0, 0, 0, 1], 0, 1.0, true),
    ("N", [1, 1, -2, 0, 0], 0, 1.0, true),
    ("Pa", [1, -1, -2, 0, 0], 0, 1.0, true),
    ("J", [1, 2, -2, 0, 0], 0, 1.0, true),
    ("W", [1, 2, -3, 0, 0], 0, 1.0, true),
    ("Hz", [0, 0, -1, 0, 0], 0, 1.0, true),
    ("t", [1, 0, 0, 0, 0], 3, 1.0, false),
    ("deg", [0, 0, 0, 0, 1], 0, std::f64::consts::PI / 180.0, false),
    ("rev", [0, 0, 0, 0, 1], 0, 2.0 * std::f64::consts::PI, false),
    ("rpm", [0, 0, -1, 0, 1], 0, 2.0 * std::f64::consts::PI / 60.0, false),
    ("min", [0, 0, 1, 0, 0], 0, 60.0, false),
    ("h", [0, 0, 1, 0, 0], 0, 3600.0, false),
];

/// Decimal prefixes and their powers of ten.
const PREFIXES: [(&str, i32); 8] =
    [("k", 3), ("M", 6), ("G", 9), ("c", -2), ("m", -3), ("u", -6), ("µ", -6), ("n", -9)];

/// What hosts show instead of an SI unit, per coherent label.
const NATURAL: [(&str, &[&str]); 20] = [
    ("m", &["mm"]),
    ("m2", &["mm2"]),
    ("m4", &["mm4"]),
    ("m/s", &["mm/s"]),
    ("m/s2", &["mm/s2"]),
    ("1/m", &["1/mm"]),
    ("rad", &["deg"]),
    ("rad/s", &["deg/s", "rpm"]),
    ("rad/s2", &["deg/s2"]),
    ("rad/m", &["deg/m"]),
    ("s", &["ms"]),
    ("kg", &["g"]),
    ("kg/m3", &["kg/mm3"]),
    ("N", &["kN"]),
    ("N.m", &["N.mm", "kN.m"]),
    ("N/m", &["N/mm", "kN/m"]),
    ("N.m/rad", &["N.m/deg", "kN.m/rad"]),
    ("Pa", &["MPa", "GPa"]),
    ("J", &["mJ", "kJ"]),
    ("W", &["kW"]),
];

impl Unit {
    /// Parses a label; `1` and the empty text are the dimensionless unit. None where it is no unit known here.
    pub fn parse(label: &str) -> Option<Self> {
        let none = Self { exponents: Exponents::default(), power_of_ten: 0, rest: 1.0 };
        let (above, below) = label.split_once('/').unwrap_or((label, ""));
        let above = if above == "1" || label.is_empty() { Some(none) } else { product(none, above, 1) }?;
        match below {
            "" if label.contains('/') => None,
            "" => Some(above),
            below => product(above, below.strip_prefix('(').and_then(|b| b.strip_suffix(')')).unwrap_or(below), -1),
        }
    }

    /// Whether it is a coherent SI unit: scale 1.
    pub fn is_coherent(&self) -> bool {
        self.power_of_ten == 0 && self.rest == 1.0
    }

    fn times(mut self, other: Self, power: i32) -> Self {
        self.exponents.kg += power * other.exponents.kg;
        self.exponents.m += power * other.exponents.m;
        self.exponents.s += power * other.exponents.s;
        self.exponents.kelvin += power * other.exponents.kelvin;
        self.exponents.rad += power * other.exponents.rad;
        self.power_of_ten += power * other.power_of_ten;
        self.rest *= other.rest.powi(power);
        self
    }
}

/// `start` times each factor of `text`, to the power `sign`.
fn product(start: Unit, text: &str, sign: i32) -> Option<Unit> {
    text.split('.').try_fold(start, |unit, factor| {
        let digits = factor.find(|c: char| c.is_ascii_digit() || c == '-').unwrap_or(factor.len());
        let (symbol, power) = factor.split_at(digits);
        let power: i32 = if power.is_empty() { 1 } else { power.parse().ok()? };
        let in_bounds = power != 0 && power.abs() <= 9; // no beam has more, and sums cannot overflow
        in_bounds.then_some(unit.times(symbol_unit(symbol)?, sign * power))
    })
}

/// A symbol with or without a prefix.
fn symbol_unit(symbol: &str) -> Option<Unit> {
    let plain = |wanted: &str, power: i32, prefixed: bool| {
        SYMBOLS.iter().find(|(name, .., prefixes)| *name == wanted && (*prefixes || !prefixed)).map(
            |&(_, [kg, m, s, kelvin, rad], power_of_ten, rest, _)| Unit {
                exponents: Exponents { kg, m, s, kelvin, rad },
                power_of_ten: power_of_ten + power,
                rest,
            },
        )
    };
    plain(symbol, 0, false)
        .or_else(|| PREFIXES.iter().find_map(|(prefix, power)| plain(symbol.strip_prefix(prefix)?, *power, true)))
}

/// Exponents of a coherent SI label; none where the label is unknown or a conversion (`mm`).
pub fn exponents(label: &str) -> Option<Exponents> {
    Unit::parse(label).filter(Unit::is_coherent).map(|unit| unit.exponents)
}

/// FMI's factor of a display unit, `display value = factor * SI value`; none where the two do not measure the same.
pub fn display_factor(label: &str, display: &str) -> Option<f64> {
    let (shown, si) = (Unit::parse(display)?, Unit::parse(label)?);
    if shown.exponents != si.exponents || !si.is_coherent() {
        return None;
    }
    let scale = 10f64.powi(shown.power_of_ten.abs());
    Some(if shown.power_of_ten > 0 { 1.0 / scale / shown.rest } else { scale / shown.rest })
}

/// The units that hosts like to show instead of this coherent one.
pub fn natural(label: &str) -> &'static [&'static str] {
    NATURAL.iter().find(|(known, _)| *known == label).map_or(&[], |(_, shown)| shown)
}

impl Quantity {
    /// A quantity by the name of its type and its coherent unit label; an unknown label keeps its text, without
    /// exponents.
    pub fn new(name: &'static str, unit: &str) -> Self {
        let unit = if unit == "1" { "" } else { unit };
        let exponents = if unit.is_empty() { None } else { exponents(unit) };
        Self { name, unit: unit.to_owned(), exponents }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(kg: i32, m: i32, s: i32, rad: i32) -> Option<Exponents> {
        Some(Exponents { kg, m, s, kelvin: 0, rad })
    }

    /// Every coherent label of the model format has the exponents that physics gives it.
    #[test]
    fn coherent_labels_have_their_exponents() {
        assert_eq!(exponents("kg.m2/s2"), of(1, 2, -2, 0));
        assert_eq!(exponents("N.m"), of(1, 2, -2, 0));
        assert_eq!(exponents("Pa"), of(1, -1, -2, 0));
        assert_eq!(exponents("rad/s"), of(0, 0, -1, 1));
        assert_eq!(exponents("1/m"), of(0, -1, 0, 0));
        assert_eq!(exponents("m/s2"), of(0, 1, -2, 0));
        assert_eq!(exponents("N/m"), of(1, 0, -2, 0));
        assert_eq!(exponents("N.m/rad"), of(1, 2, -2, -1));
        assert_eq!(exponents("N.m.s/rad"), of(1, 2, -1, -1));
        assert_eq!(exponents("kg.m2/s"), of(1, 2, -1, 0));
        assert_eq!(exponents("kg/m3"), of(1, -3, 0, 0));
        assert_eq!(exponents("J"), of(1, 2, -2, 0));
        assert_eq!(exponents("m6"), of(0, 6, 0, 0));
        assert_eq!(exponents("kg/(m.s2)"), of(1, -1, -2, 0));
        assert_eq!(exponents("1/K"), Some(Exponents { kelvin: -1, ..Exponents::default() }));
        assert_eq!(exponents("K/m"), Some(Exponents { m: -1, kelvin: 1, ..Exponents::default() }));
    }

    /// A conversion or a word is no coherent unit; a trailing slash or an empty factor is no label at all.
    #[test]
    fn other_labels_are_refused() {
        for label in ["mm", "deg", "g", "t", "furlong", "m/", "m..s", "m2.", "m0", "m99", "kt", "m/s/s", "-", "/m"] {
            assert_eq!(exponents(label), None, "{label}");
        }
    }

    /// `display value = factor * SI value`, exact for decimal units.
    #[test]
    fn display_factors() {
        assert_eq!(display_factor("m", "mm"), Some(1000.0));
        assert_eq!(display_factor("N", "kN"), Some(1e-3));
        assert_eq!(display_factor("Pa", "MPa"), Some(1e-6));
        assert_eq!(display_factor("N.m", "N.mm"), Some(1000.0));
        assert_eq!(display_factor("1/m", "1/mm"), Some(1e-3));
        assert_eq!(display_factor("kg", "t"), Some(1e-3));
        assert_eq!(display_factor("rad", "deg"), Some(1.0 / (std::f64::consts::PI / 180.0)));
        assert_eq!(display_factor("m", "kN"), None);
        assert_eq!(display_factor("mm", "m"), None);
    }

    /// Every natural display unit measures what its SI unit measures.
    #[test]
    fn natural_display_units_fit() {
        for (label, shown) in NATURAL {
            for display in shown {
                assert!(display_factor(label, display).is_some_and(|factor| factor != 1.0), "{label} as {display}");
            }
        }
    }
}
