//! What the name of a column says: its quantity, the station along a beam, the component, and what a chart calls that.

use ancf14::model::quantity::{QUANTITIES, Quantity};
use ancf14::model::variables::is_of_account;

/// A name, `tip.velocity[2]` or `blade.stress[3]` or `blade.velocity[3,2]`, in its parts. Empty: it has none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Name<'a> {
    /// With its output: `tip.velocity`.
    pub quantity: &'a str,
    /// Number of the station along a beam.
    pub station: &'a str,
    /// Number of the component.
    pub component: &'a str,
}

impl<'a> Name<'a> {
    /// The parts of the name of a column.
    pub fn of(name: &'a str) -> Self {
        let (quantity, index) = name.split_once('[').unwrap_or((name, ""));
        let index = index.trim_end_matches(']');
        match index.split_once(',') {
            Some((station, component)) => Self { quantity, station, component },
            None if is_scalar(quantity) => Self { quantity, station: index, component: "" },
            None => Self { quantity, station: "", component: index },
        }
    }

    /// Whether it is an energy, a work, a momentum or a count of the whole mechanism, which no output asks for.
    pub fn is_total(self) -> bool {
        let kind = self.quantity.split_once('.').map(|(kind, _)| kind);
        matches!(kind, Some("energy" | "momentum" | "statistics")) || is_of_account(self.quantity)
    }

    /// What a chart calls its component: x, y or z where it is one of a vector.
    pub fn axis(self) -> &'a str {
        let names = of_word(word(self.quantity)).map_or(&AXES[..], components);
        let number: Option<usize> = self.component.parse().ok();
        let name = number.and_then(|number| names.get(number.checked_sub(1)?));
        name.unwrap_or(&self.component)
    }
}

const AXES: [&str; 3] = ["x", "y", "z"];

/// What the components of a quantity are called.
fn components(quantity: Quantity) -> &'static [&'static str] {
    match quantity {
        Quantity::Quaternion => &["w", "x", "y", "z"],
        Quantity::Curvature => &["about y", "about z"],
        Quantity::SectionMoment => &["torque", "about y", "about z"],
        _ => &AXES,
    }
}

/// The word behind the output.
fn word(quantity: &str) -> &str {
    quantity.rsplit_once('.').map_or(quantity, |(_, word)| word)
}

fn of_word(word: &str) -> Option<Quantity> {
    QUANTITIES.iter().find(|row| row.word == word).map(|row| row.quantity)
}

/// Whether a quantity has one component, so that a number behind it is that of a station.
fn is_scalar(quantity: &str) -> bool {
    of_word(word(quantity)).is_some_and(|quantity| quantity.row().components == 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A number in brackets is a station where the quantity is a scalar, and a component where it is a vector.
    #[test]
    fn names_have_parts() {
        for (name, parts, axis) in [
            ("tip.velocity[2]", ["tip.velocity", "", "2"], "y"),
            ("blade.velocity[13,3]", ["blade.velocity", "13", "3"], "z"),
            ("blade.stress[13]", ["blade.stress", "13", ""], ""),
            ("tip.twist", ["tip.twist", "", ""], ""),
            ("hub.quaternion[1]", ["hub.quaternion", "", "1"], "w"),
            ("root.section_moment[1]", ["root.section_moment", "", "1"], "torque"),
            ("root.curvature[2]", ["root.curvature", "", "2"], "about z"),
            ("momentum.linear[1]", ["momentum.linear", "", "1"], "x"),
        ] {
            let found = Name::of(name);
            assert_eq!([found.quantity, found.station, found.component], parts);
            assert_eq!(found.axis(), axis, "{name}");
        }
        for (name, is_total) in [
            ("energy.total", true),
            ("work.drift", true),
            ("momentum.linear[1]", true),
            ("door.energy", false),
            ("work.position[1]", false),
        ] {
            assert_eq!(Name::of(name).is_total(), is_total, "{name}");
        }
    }
}
