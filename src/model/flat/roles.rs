//! What the keys of the format hold: names of other things, words, or numbers, and which of these turn with a copy.

use super::tables::PLACES;

/// What a key holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// Words of the format, free text, `true` or `false`: the same in every copy.
    Word,
    /// Numbers that a turn does not change.
    Number,
    /// A position, global.
    Position,
    /// The offset of a point: a position where it is on the ground, a direction on a frame, else numbers in the axes of what it is on.
    Offset,
    /// A direction, a velocity, a force: global components.
    Direction,
    /// Three values along the global axes as drawn.
    AlongAxes,
    /// Three directions, global.
    Axes,
    /// The table of a curve.
    Curve,
    /// The name of a thing of a section, or of a place or a point of it; a position where it is a list.
    Name(&'static str),
    /// The name of a part or a point of it, whatever it is.
    Part,
}

/// The roles of all keys: section, key, role. Where a section is not said, the key has its role everywhere.
const ROLES: [(&str, &str, Role); 115] = [
    ("function", "argument", Role::Word),
    ("function", "table", Role::Number),
    ("function", "file", Role::Word),
    ("function", "column", Role::Word),
    ("function", "interpolation", Role::Word),
    ("function", "outside", Role::Word),
    ("material", "young", Role::Number),
    ("material", "poisson", Role::Number),
    ("material", "shear", Role::Number),
    ("material", "density", Role::Number),
    ("material", "damping", Role::Number),
    ("section", "shape", Role::Word),
    ("section", "width", Role::Number),
    ("section", "height", Role::Number),
    ("section", "radius", Role::Number),
    ("section", "inner", Role::Number),
    ("section", "outer", Role::Number),
    ("section", "area", Role::Number),
    ("section", "second_moment_y", Role::Number),
    ("section", "second_moment_z", Role::Number),
    ("section", "torsion_constant", Role::Number),
    ("section", "polar_moment", Role::Number),
    ("section", "fourth_moments", Role::Number),
    ("body", "mass", Role::Number),
    ("body", "inertia", Role::Number),
    ("", "axes", Role::Axes),
    ("point", "offset", Role::Offset),
    ("", "position", Role::Position),
    ("", "velocity", Role::Direction),
    ("", "angular_velocity", Role::Direction),
    ("beam", "material", Role::Name("material")),
    ("beam", "section", Role::Name("section")),
    ("beam", "from", Role::Position),
    ("beam", "to", Role::Position),
    ("beam", "curve", Role::Curve),
    ("beam", "spacing", Role::Word),
    ("beam", "y_axis", Role::Direction),
    ("beam", "pretwist", Role::Number),
    ("beam", "elements", Role::Number),
    ("beam", "element", Role::Word),
    ("beam", "strain", Role::Word),
    ("beam", "twist", Role::Word),
    ("beam", "torsion", Role::Word),
    ("beam", "ancf24_poisson", Role::Word),
    ("beam", "ancf24_shear", Role::Word),
    ("frame", "rotation", Role::Direction),
    ("", "active", Role::Number),
    ("", "input", Role::Word),
    ("joint", "type", Role::Word),
    ("gear", "a", Role::Name("joint")),
    ("gear", "b", Role::Name("joint")),
    ("", "a", Role::Name(PLACES)),
    ("", "b", Role::Name(PLACES)),
    ("output", "at", Role::Part),
    ("", "at", Role::Name(PLACES)),
    ("", "on", Role::Name(PLACES)),
    ("", "joint", Role::Name("joint")),
    ("joint", "axis", Role::Direction),
    ("joint", "axis2", Role::Direction),
    ("", "coordinate", Role::Word),
    ("actuator", "effort", Role::Number),
    ("gear", "a_coordinate", Role::Word),
    ("gear", "b_coordinate", Role::Word),
    ("gear", "ratio", Role::Number),
    ("gear", "law", Role::Number),
    ("spring", "force", Role::Number),
    ("spring", "rest", Role::Number),
    ("spring", "only", Role::Word),
    ("friction", "coulomb", Role::Number),
    ("friction", "viscous", Role::Number),
    ("friction", "speed", Role::Number),
    ("stop", "lower", Role::Number),
    ("stop", "upper", Role::Number),
    ("load", "force", Role::Direction),
    ("load", "moment", Role::Direction),
    ("load", "follower", Role::Word),
    ("output", "in", Role::Name(PLACES)),
    ("output", "of", Role::Name(PLACES)),
    ("output", "quantities", Role::Word),
    ("material", "mass_damping", Role::Number),
    ("material", "damping_ratios", Role::Number),
    ("material", "damping_frequencies", Role::Number),
    ("material", "expansion", Role::Number),
    ("section", "product_moment", Role::Number),
    ("section", "wall", Role::Number),
    ("section", "web", Role::Number),
    ("section", "flange", Role::Number),
    ("section", "turn", Role::Number),
    ("section", "EA", Role::Number),
    ("section", "EI_y", Role::Number),
    ("section", "EI_z", Role::Number),
    ("section", "EI_yz", Role::Number),
    ("section", "tension_center", Role::Number),
    ("section", "GJ", Role::Number),
    ("section", "line_density", Role::Number),
    ("section", "polar_inertia", Role::Number),
    ("section", "expansion", Role::Number),
    ("section", "mass_damping", Role::Number),
    ("section", "damping_ratios", Role::Number),
    ("section", "damping_frequencies", Role::Number),
    ("beam", "pretension", Role::Number),
    ("beam", "free_curvature", Role::Number),
    ("beam", "free_torsion", Role::Number),
    ("beam", "tension_damping", Role::Number),
    ("beam", "temperature", Role::Number),
    ("beam", "temperature_gradient", Role::Number),
    ("beam", "temperature_input", Role::Word),
    ("", "stiffness", Role::Number),
    ("", "damping", Role::Number),
    ("", "rotational_stiffness", Role::Number),
    ("", "rotational_damping", Role::Number),
    ("", "value", Role::Number),
    ("", "rate", Role::Number),
    ("", "length", Role::Number),
    ("", "stations", Role::Number),
];

/// The keys of a bushing have a component for each global axis.
const OF_BUSHING: [&str; 4] = ["stiffness", "damping", "rotational_stiffness", "rotational_damping"];

/// What a key of a section holds; of a key that is not known, numbers.
pub(super) fn role(section: &str, key: &str, is_list: bool) -> Role {
    if section == "joint" && is_list && OF_BUSHING.contains(&key) {
        return Role::AlongAxes;
    }
    let fits = |(of, name, _): &&(&str, &str, Role)| (of.is_empty() || *of == section) && *name == key;
    match ROLES.iter().find(fits).map(|(.., role)| *role) {
        Some(Role::Name(_) | Role::Part) if is_list => Role::Position,
        Some(role) => role,
        None => Role::Number,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::text::keys::keys_of;
    use crate::model::text::names::SECTIONS;

    /// A key without a role would be taken for a number: its names would stay those of the original in every copy.
    #[test]
    fn every_key_of_the_format_has_a_role() {
        for (section, _) in SECTIONS {
            for key in keys_of(section) {
                let is_known = ROLES.iter().any(|(of, name, _)| (of.is_empty() || *of == section) && name == key);
                assert!(is_known, "the key {key} of [{section}.NAME] has no role");
            }
        }
    }
}
