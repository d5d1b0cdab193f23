//! The keys of the sections with a name: where several sections have one name, the key says which of them is meant.

/// Every section with the keys that it may have.
const KEYS: [(&str, &[&str]); 18] = [
    ("function", &["value", "argument", "table", "file", "column", "interpolation", "outside"]),
    (
        "material",
        &[
            "young",
            "poisson",
            "shear",
            "density",
            "damping",
            "mass_damping",
            "damping_ratios",
            "damping_frequencies",
            "expansion",
        ],
    ),
    (
        "section",
        &[
            "shape",
            "width",
            "height",
            "radius",
            "inner",
            "outer",
            "area",
            "second_moment_y",
            "second_moment_z",
            "torsion_constant",
            "polar_moment",
            "fourth_moments",
            "product_moment",
            "wall",
            "web",
            "flange",
            "turn",
            "EA",
            "EI_y",
            "EI_z",
            "EI_yz",
            "tension_center",
            "GJ",
            "line_density",
            "polar_inertia",
            "expansion",
            "damping",
            "mass_damping",
            "damping_ratios",
            "damping_frequencies",
        ],
    ),
    ("body", &["mass", "position", "inertia", "axes", "velocity", "angular_velocity"]),
    (
        "beam",
        &[
            "material",
            "section",
            "from",
            "to",
            "curve",
            "spacing",
            "y_axis",
            "pretwist",
            "elements",
            "element",
            "strain",
            "twist",
            "torsion",
            "ancf24_poisson",
            "ancf24_shear",
            "pretension",
            "free_curvature",
            "free_torsion",
            "tension_damping",
            "temperature",
            "temperature_gradient",
            "temperature_input",
            "velocity",
            "angular_velocity",
        ],
    ),
    ("frame", &["position", "rotation", "input"]),
    ("point", &["on", "offset", "axes"]),
    (
        "joint",
        &[
            "type",
            "a",
            "b",
            "at",
            "axis",
            "axis2",
            "stiffness",
            "damping",
            "rotational_stiffness",
            "rotational_damping",
            "active",
            "input",
        ],
    ),
    ("drive", &["joint", "coordinate", "value", "rate", "active", "input"]),
    ("winch", &["at", "length", "rate", "input"]),
    ("actuator", &["joint", "coordinate", "a", "b", "effort", "input"]),
    ("gear", &["a", "a_coordinate", "b", "b_coordinate", "ratio", "law"]),
    ("spring", &["a", "b", "joint", "coordinate", "stiffness", "damping", "length", "rest", "only", "force"]),
    ("friction", &["joint", "coordinate", "coulomb", "viscous", "speed"]),
    ("stop", &["joint", "coordinate", "lower", "upper", "stiffness", "damping"]),
    ("lock", &["joint", "coordinate", "active", "input"]),
    ("load", &["at", "on", "force", "moment", "follower", "input"]),
    ("output", &["at", "on", "of", "stations", "in", "quantities"]),
];

/// The keys of a section.
pub fn keys_of(section: &str) -> &'static [&'static str] {
    KEYS.iter().find(|(word, _)| *word == section).map_or(&[], |(_, keys)| keys)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;
    use std::path::Path;

    /// The keys of every section with a name in a file.
    fn check(file: &str, text: &str) -> usize {
        let table: toml::Table = text.parse().unwrap_or_else(|error| panic!("{file}: {error}"));
        let mut count = 0;
        for (section, known) in KEYS {
            let Some(things) = table.get(section).and_then(|things| things.as_table()) else { continue };
            for (name, thing) in things {
                for key in thing.as_table().expect("a section").keys() {
                    assert!(known.contains(&key.as_str()), "{file}: {key} of [{section}.{name}]");
                    count += 1;
                }
            }
        }
        count
    }

    /// Shipped models, and the example with every key in docs/model-file.md: a key that is missing here could not be set where a name is shared.
    #[test]
    fn keys_of_the_format_are_known() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let page = fs::read_to_string(root.join("docs/model-file.md")).expect("the page");
        let example = page.split("```toml").nth(1).and_then(|rest| rest.split("```").next()).expect("the example");
        let mut count = check("docs/model-file.md", example);
        for entry in fs::read_dir(root.join("models")).expect("models") {
            let path = entry.expect("entry").path();
            if path.extension().is_some_and(|extension| extension == "toml") {
                count += check(&path.to_string_lossy(), &fs::read_to_string(&path).expect("text"));
            }
        }
        assert!(count > 300, "only {count} keys are looked at");
    }
}
