//! What an output can measure: one row a quantity, with its components, unit and meaning.

/// A quantity of an output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Place in global axes.
    Position,
    /// Place minus the place as drawn, global axes.
    Displacement,
    /// Velocity in global axes.
    Velocity,
    /// Rotation vector from the orientation as drawn, continuous in time.
    Rotation,
    /// Orientation of the section, w x y z.
    Quaternion,
    /// Angular velocity in global axes.
    AngularVelocity,
    /// Material twist from the beam's start to here.
    Twist,
    /// Axial strain of the section.
    AxialStrain,
    /// Curvature about the section's y and z.
    Curvature,
    /// Twist rate minus its undeformed value.
    Torsion,
}

/// A row of the table of quantities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row {
    /// The quantity.
    pub quantity: Quantity,
    /// Its word in the file and in the names of variables.
    pub word: &'static str,
    /// Number of components.
    pub components: usize,
    /// Unit label; empty: dimensionless.
    pub unit: &'static str,
    /// What it is, with axes and sign; the point is named before it.
    pub meaning: &'static str,
}

const fn row(
    quantity: Quantity,
    word: &'static str,
    components: usize,
    unit: &'static str,
    meaning: &'static str,
) -> Row {
    Row { quantity, word, components, unit, meaning }
}

/// The quantities that can be asked for at a point of a beam.
pub const QUANTITIES: [Row; 10] = [
    row(Quantity::Position, "position", 3, "m", "position in global axes"),
    row(Quantity::Displacement, "displacement", 3, "m", "displacement from the place as drawn, in global axes"),
    row(Quantity::Velocity, "velocity", 3, "m/s", "velocity in global axes"),
    row(Quantity::Rotation, "rotation", 3, "rad", "rotation vector from the orientation as drawn, in global axes"),
    row(Quantity::Quaternion, "quaternion", 4, "", "orientation of the section as a quaternion w x y z"),
    row(Quantity::AngularVelocity, "angular_velocity", 3, "rad/s", "angular velocity in global axes"),
    row(Quantity::Twist, "twist", 1, "rad", "material twist between the start of the beam and here"),
    row(Quantity::AxialStrain, "axial_strain", 1, "", "axial strain of the section, extension positive"),
    row(Quantity::Curvature, "curvature", 2, "1/m", "curvature about the section's y and z, minus the undeformed one"),
    row(Quantity::Torsion, "torsion", 1, "rad/m", "twist rate of the section, minus the undeformed one"),
];

/// Quantities of the format that this version does not measure.
pub const LATER: [&str; 9] = [
    "acceleration",
    "section_force",
    "section_moment",
    "stress",
    "reaction_force",
    "reaction_moment",
    "angle",
    "distance",
    "effort",
];

impl Quantity {
    /// Its row of the table.
    pub fn row(self) -> &'static Row {
        QUANTITIES.iter().find(|row| row.quantity == self).expect("every quantity has a row")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `row` must find each one: the list of the enum and the table are the same list.
    #[test]
    fn every_quantity_is_its_own_row() {
        for row in &QUANTITIES {
            assert_eq!(row.quantity.row(), row);
        }
        assert_eq!(Quantity::Torsion as usize, QUANTITIES.len() - 1, "the last of the enum is the last of the table");
    }
}
