//! What an output can measure: one row a quantity, with where it can be measured, its components, unit and meaning.

use self::Site::{At, Whole};
use crate::model::text::names::Kind;

/// A quantity of an output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Place in global axes.
    Position,
    /// Position minus that as drawn, global axes.
    Displacement,
    /// Velocity in global axes.
    Velocity,
    /// Acceleration in global axes.
    Acceleration,
    /// Rotation vector from the orientation as drawn, continuous in time.
    Rotation,
    /// Orientation of the section, of the body axes or of the frame, w x y z.
    Quaternion,
    /// Angular velocity in global axes.
    AngularVelocity,
    /// Angle of the x axis from its direction as drawn.
    Tilt,
    /// Material twist from the beam's start to here.
    Twist,
    /// Axial strain of the section.
    AxialStrain,
    /// Curvature about the section's y and z.
    Curvature,
    /// Twist rate minus its undeformed value.
    Torsion,
    /// Axial force and shear forces in section axes.
    SectionForce,
    /// Torque and bending moments in section axes.
    SectionMoment,
    /// Largest von Mises stress over the outline.
    Stress,
    /// Axial force of the section, which in water is the effective tension.
    EffectiveTension,
    /// Axial force in the wall of the section.
    WallTension,
    /// Angle of the tangent to the vertical.
    Declination,
    /// Direction of the tangent, seen from above.
    Azimuth,
    /// Depth of the axis below the surface of the water.
    Submergence,
    /// Height of the axis above the bottom of the water.
    Clearance,
    /// Velocity of the water.
    FluidVelocity,
    /// Drag of the water per length.
    Drag,
    /// Normal force per length of the surfaces that a beam touches.
    ContactPressure,
    /// Height of the surface of the water.
    Elevation,
    /// Force of a joint on b, or that a frame must supply.
    ReactionForce,
    /// Moment of a joint on b, or that a frame must supply.
    ReactionMoment,
    /// Force of a joint on a, or on what moves a frame: the reaction with the other sign.
    AppliedForce,
    /// Moment of a joint on a, or on what moves a frame: the reaction with the other sign.
    AppliedMoment,
    /// Angle of a joint.
    Angle,
    /// Distance of a joint.
    Distance,
    /// Rate of the angle of a joint.
    AngleRate,
    /// Rate of the distance of a joint.
    DistanceRate,
    /// Second derivative of the angle of a joint.
    AngleAcceleration,
    /// Second derivative of the distance of a joint.
    DistanceAcceleration,
    /// Torque or force of a drive, an actuator, a gear, friction or a stop.
    Effort,
    /// Power of a drive or an actuator, or through a gear; what friction or the damper of a spring or a stop takes.
    Power,
    /// Tension of a spring.
    Force,
    /// Elastic energy of a spring, of a stop, of a rope, or of the springs of a joint.
    Energy,
    /// Sum of the normal forces of a contact.
    NormalForce,
    /// Sum of the friction of a contact.
    FrictionForce,
    /// Largest penetration of a contact.
    Penetration,
    /// Length of beam that touches.
    ContactLength,
    /// Angle by which beams are bent where they touch, or that a rope runs along each sheave.
    WrapAngle,
    /// Share of a contact that slides.
    Sliding,
    /// Tension of each span of a rope.
    Tension,
    /// Length of each span of a rope.
    SpanLength,
    /// How far a rope has slipped over each sheave.
    Slip,
    /// Length of a whole rope.
    Length,
    /// Kinetic energy of a whole beam or body.
    KineticEnergy,
    /// Strain energy of a whole beam.
    ElasticEnergy,
    /// Potential energy of gravity of a whole beam or body.
    GravityEnergy,
    /// Arc length at which a beam comes down on the seabed.
    Touchdown,
    /// Length of a beam that lies on the seabed.
    LaidLength,
}

/// What an output looks at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Site {
    /// Something of this kind; of a beam a point, of a whole beam many.
    At(Kind),
    /// All of a beam without its points, or of a body without its motion.
    Whole(Kind),
}

impl Site {
    /// `a point of a beam`.
    pub fn words(self) -> String {
        match self {
            Self::At(Kind::Beam) => String::from("a point of a beam"),
            Self::At(kind @ (Kind::Point | Kind::Friction)) => format!("a [{}]", kind.word()),
            Self::At(Kind::Actuator) => String::from("an actuator"),
            Self::At(kind) => format!("a {}", kind.word()),
            Self::Whole(kind) => format!("a whole {} (of = \"{}\")", kind.word(), kind.word().to_uppercase()),
        }
    }
}

/// A row of the table of quantities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row {
    /// The quantity.
    pub quantity: Quantity,
    /// Its word in the file and in the names of variables.
    pub word: &'static str,
    /// Where it can be measured.
    pub sites: &'static [Site],
    /// Number of components.
    pub components: usize,
    /// Unit label; empty: dimensionless. An effort along a distance is in N.
    pub unit: &'static str,
    /// What it is, with axes and sign; the point is named before it.
    pub meaning: &'static str,
}

/// Rows of the same sites.
struct Rows(&'static [Site]);

impl Rows {
    const fn row(
        &self,
        quantity: Quantity,
        word: &'static str,
        components: usize,
        unit: &'static str,
        meaning: &'static str,
    ) -> Row {
        Row { quantity, word, sites: self.0, components, unit, meaning }
    }
}

const POINT: Rows = Rows(&[At(Kind::Beam), At(Kind::Body), At(Kind::Frame), At(Kind::Point)]);
const BEAM: Rows = Rows(&[At(Kind::Beam)]);
const HOLD: Rows = Rows(&[At(Kind::Joint), At(Kind::Frame), At(Kind::Contact), At(Kind::Foundation)]);
const FREE: Rows = Rows(&[
    At(Kind::Joint),
    At(Kind::Drive),
    At(Kind::Actuator),
    At(Kind::Spring),
    At(Kind::Friction),
    At(Kind::Stop),
    At(Kind::Lock),
]);
const EFFORT: Rows = Rows(&[
    At(Kind::Joint),
    At(Kind::Drive),
    At(Kind::Actuator),
    At(Kind::Gear),
    At(Kind::Friction),
    At(Kind::Stop),
    At(Kind::Lock),
]);
const POWER: Rows =
    Rows(&[At(Kind::Drive), At(Kind::Actuator), At(Kind::Gear), At(Kind::Spring), At(Kind::Friction), At(Kind::Stop)]);
const SPRING: Rows = Rows(&[At(Kind::Spring)]);
const STORE: Rows =
    Rows(&[At(Kind::Spring), At(Kind::Stop), At(Kind::Joint), At(Kind::Contact), At(Kind::Foundation), At(Kind::Rope)]);
const TOUCH: Rows = Rows(&[At(Kind::Contact)]);
const WRAP: Rows = Rows(&[At(Kind::Contact), At(Kind::Rope)]);
const ROPE: Rows = Rows(&[At(Kind::Rope)]);
const MASS: Rows = Rows(&[Whole(Kind::Beam), Whole(Kind::Body)]);
const WHOLE_BEAM: Rows = Rows(&[Whole(Kind::Beam)]);

/// Everything that can be asked for.
pub const QUANTITIES: [Row; 54] = [
    POINT.row(Quantity::Position, "position", 3, "m", "position in global axes"),
    POINT.row(Quantity::Displacement, "displacement", 3, "m", "displacement from the place as drawn, in global axes"),
    POINT.row(Quantity::Velocity, "velocity", 3, "m/s", "velocity in global axes"),
    POINT.row(Quantity::Acceleration, "acceleration", 3, "m/s2", "acceleration in global axes"),
    POINT.row(
        Quantity::Rotation,
        "rotation",
        3,
        "rad",
        "rotation vector from the orientation as drawn, in global axes",
    ),
    POINT.row(
        Quantity::Quaternion,
        "quaternion",
        4,
        "",
        "orientation of the section, body or frame as a quaternion w x y z",
    ),
    POINT.row(Quantity::AngularVelocity, "angular_velocity", 3, "rad/s", "angular velocity in global axes"),
    POINT.row(
        Quantity::Tilt,
        "tilt",
        1,
        "rad",
        "angle between the x axis of the section, body or frame and its direction as drawn, 0 to pi",
    ),
    BEAM.row(Quantity::Twist, "twist", 1, "rad", "material twist between the start of the beam and here"),
    BEAM.row(Quantity::AxialStrain, "axial_strain", 1, "", "axial strain of the section, extension positive"),
    BEAM.row(
        Quantity::Curvature,
        "curvature",
        2,
        "1/m",
        "curvature about the section's y and z, minus the undeformed one",
    ),
    BEAM.row(Quantity::Torsion, "torsion", 1, "rad/m", "twist rate of the section, minus the undeformed one"),
    BEAM.row(
        Quantity::SectionForce,
        "section_force",
        3,
        "N",
        "axial force, tension positive, and shear forces along the section's y and z, of the part towards the end on the part towards the start",
    ),
    BEAM.row(
        Quantity::SectionMoment,
        "section_moment",
        3,
        "N.m",
        "torque and moments about the section's y and z, of the part towards the end on the part towards the start",
    ),
    BEAM.row(
        Quantity::Stress,
        "stress",
        1,
        "Pa",
        "largest von Mises stress over the section's outline; of a twisted rectangle an upper bound",
    ),
    BEAM.row(
        Quantity::EffectiveTension,
        "effective_tension",
        1,
        "N",
        "axial force of the section, tension positive: in water the effective tension",
    ),
    BEAM.row(
        Quantity::WallTension,
        "wall_tension",
        1,
        "N",
        "axial force in the wall of the section, tension positive: the effective tension less the pressure of the \
         still water around it",
    ),
    BEAM.row(
        Quantity::Declination,
        "declination",
        1,
        "rad",
        "angle between the tangent, towards the end of the beam, and the upward vertical z, 0 to pi",
    ),
    BEAM.row(
        Quantity::Azimuth,
        "azimuth",
        1,
        "rad",
        "angle from x towards y of the tangent, towards the end of the beam, seen from above, -pi to pi",
    ),
    POINT.row(Quantity::Submergence, "submergence", 1, "m", "depth below the surface of the water, negative above it"),
    POINT.row(Quantity::Clearance, "clearance", 1, "m", "height above the bottom of the water"),
    POINT.row(
        Quantity::FluidVelocity,
        "fluid_velocity",
        3,
        "m/s",
        "velocity of the water in global axes, 0 above its surface",
    ),
    BEAM.row(Quantity::Drag, "drag", 3, "N/m", "drag of water and air per undeformed length, in global axes"),
    BEAM.row(
        Quantity::ContactPressure,
        "contact_pressure",
        1,
        "N/m",
        "normal force of the surfaces and the seabed that the beam touches, per undeformed length",
    ),
    POINT.row(
        Quantity::Elevation,
        "elevation",
        1,
        "m",
        "height z of the surface of the water, at the x and y of the point",
    ),
    HOLD.row(
        Quantity::ReactionForce,
        "reaction_force",
        3,
        "N",
        "force on side b of the joint, or that the frame must supply, in global axes",
    ),
    HOLD.row(
        Quantity::ReactionMoment,
        "reaction_moment",
        3,
        "N.m",
        "moment on side b of the joint, or that the frame must supply, about its place, in global axes",
    ),
    HOLD.row(
        Quantity::AppliedForce,
        "applied_force",
        3,
        "N",
        "force on side a of the joint, or on whatever moves the frame, in global axes: minus the reaction",
    ),
    HOLD.row(
        Quantity::AppliedMoment,
        "applied_moment",
        3,
        "N.m",
        "moment on side a of the joint, or on whatever moves the frame, about its place, in global axes: minus the reaction",
    ),
    FREE.row(Quantity::Angle, "angle", 1, "rad", "angle of b relative to a about the axis, 0 as drawn, counting turns"),
    FREE.row(Quantity::Distance, "distance", 1, "m", "distance of b from a along the axis, 0 as drawn"),
    FREE.row(Quantity::AngleRate, "angle_rate", 1, "rad/s", "rate of the angle of b relative to a about the axis"),
    FREE.row(Quantity::DistanceRate, "distance_rate", 1, "m/s", "rate of the distance of b from a along the axis"),
    FREE.row(
        Quantity::AngleAcceleration,
        "angle_acceleration",
        1,
        "rad/s2",
        "second derivative of the angle of b relative to a about the axis",
    ),
    FREE.row(
        Quantity::DistanceAcceleration,
        "distance_acceleration",
        1,
        "m/s2",
        "second derivative of the distance of b from a along the axis",
    ),
    EFFORT.row(Quantity::Effort, "effort", 1, "N.m", "torque or force of the drive or actuator on side b"),
    POWER.row(Quantity::Power, "power", 1, "W", "power of the drive or actuator: its effort times the rate of its coordinate"),
    SPRING.row(Quantity::Force, "force", 1, "N", "force or torque of the spring, positive where it pulls its sides together"),
    STORE.row(Quantity::Energy, "energy", 1, "J", "elastic energy of the spring or stop"),
    TOUCH.row(Quantity::NormalForce, "normal_force", 1, "N", "sum of the sizes of all normal forces of the contact"),
    TOUCH.row(Quantity::FrictionForce, "friction_force", 1, "N", "sum of the sizes of all friction of the contact"),
    TOUCH.row(Quantity::Penetration, "penetration", 1, "m", "largest penetration of the contact"),
    TOUCH.row(Quantity::ContactLength, "contact_length", 1, "m", "length of beam that touches"),
    WRAP.row(Quantity::WrapAngle, "wrap_angle", 1, "rad", "angle by which the beam is bent where it touches"),
    TOUCH.row(Quantity::Sliding, "sliding", 1, "", "share of what touches with friction that slides, 0 to 1"),
    ROPE.row(Quantity::Tension, "tension", 1, "N", "tension of each span of the rope, from its start on"),
    ROPE.row(Quantity::SpanLength, "span_length", 1, "m", "length of each span of the rope, between the sheaves"),
    ROPE.row(
        Quantity::Slip,
        "slip",
        1,
        "m",
        "way that the rope has slipped over each sheave since it was drawn, positive towards its end",
    ),
    ROPE.row(Quantity::Length, "length", 1, "m", "length of the rope along its spans and its arcs on sheaves"),
    MASS.row(Quantity::KineticEnergy, "kinetic_energy", 1, "J", "kinetic energy of the whole part"),
    WHOLE_BEAM.row(Quantity::ElasticEnergy, "elastic_energy", 1, "J", "strain energy of the whole beam"),
    MASS.row(
        Quantity::GravityEnergy,
        "gravity_energy",
        1,
        "J",
        "potential energy of gravity of the whole part, zero at the origin",
    ),
    WHOLE_BEAM.row(
        Quantity::Touchdown,
        "touchdown",
        1,
        "m",
        "arc length at which the beam comes down on the seabed, from its higher end; -1: it does not touch it",
    ),
    WHOLE_BEAM.row(Quantity::LaidLength, "laid_length", 1, "m", "length of the beam that lies on the seabed"),
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
        assert_eq!(
            Quantity::LaidLength as usize,
            QUANTITIES.len() - 1,
            "the last of the enum is the last of the table"
        );
    }
}
