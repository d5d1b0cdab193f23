//! Every numeric key of the format: one row each, with meaning, unit, allowed range, and whether it may change while the model runs.

use super::range::{Limit, Range};
use crate::model::expression::Variable;

/// The rule for a numeric key.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// The key as written in the file.
    pub key: &'static str,
    /// What the number is.
    pub meaning: &'static str,
    /// Unit label; empty: dimensionless.
    pub unit: &'static str,
    /// Allowed values.
    pub range: Range,
    /// A count.
    pub integer: bool,
    /// The solver takes a change between two steps.
    pub tunable: bool,
    /// What it may depend on: t, along a curve s, of a temperature both, in the law of a spring x and v.
    pub variable: Variable,
}

const fn rule(key: &'static str, meaning: &'static str, unit: &'static str) -> Rule {
    Rule { key, meaning, unit, range: Range::ALL, integer: false, tunable: false, variable: Variable::None }
}

impl Rule {
    const fn above(mut self, limit: f64) -> Self {
        self.range.lower = Some(Limit { value: limit, included: false });
        self
    }

    const fn below(mut self, limit: f64) -> Self {
        self.range.upper = Some(Limit { value: limit, included: false });
        self
    }

    const fn from(mut self, limit: f64) -> Self {
        self.range.lower = Some(Limit { value: limit, included: true });
        self
    }

    const fn to(mut self, limit: f64) -> Self {
        self.range.upper = Some(Limit { value: limit, included: true });
        self
    }

    const fn count(mut self) -> Self {
        self.integer = true;
        self
    }

    const fn tunable(mut self) -> Self {
        self.tunable = true;
        self
    }

    const fn in_time(mut self) -> Self {
        self.variable = Variable::Time;
        self
    }

    const fn in_control(mut self) -> Self {
        self.variable = Variable::Control;
        self
    }

    const fn over_elongation(mut self) -> Self {
        self.variable = Variable::Elongation;
        self
    }

    const fn over_coordinate(mut self) -> Self {
        self.variable = Variable::Followed;
        self
    }

    const fn along_beam(mut self) -> Self {
        self.variable = Variable::Curve;
        self
    }

    const fn along_in_time(mut self) -> Self {
        self.variable = Variable::AlongInTime;
        self
    }

    const fn along_curve(mut self) -> Self {
        self.variable = Variable::Curve;
        self
    }
}

pub const GRAVITY: Rule = rule("gravity", "acceleration of gravity in global axes", "m/s2").tunable();

pub const YOUNG: Rule = rule("young", "Young's modulus", "Pa").above(0.0);
pub const POISSON: Rule = rule("poisson", "Poisson's ratio", "").above(-1.0).below(0.5);
pub const SHEAR: Rule = rule("shear", "shear modulus", "Pa").above(0.0);
pub const EXPANSION: Rule = rule("expansion", "thermal expansion", "1/K");
pub const DENSITY: Rule = rule("density", "density", "kg/m3").above(0.0);
pub const MATERIAL_DAMPING: Rule =
    rule("damping", "viscous stress per strain rate, over the modulus", "s").from(0.0).tunable();

pub const MASS_DAMPING: Rule =
    rule("mass_damping", "damping in proportion to mass: force over mass and velocity", "1/s").from(0.0).tunable();
pub const DAMPING_RATIOS: Rule =
    rule("damping_ratios", "ratio of critical damping at each of two frequencies", "").from(0.0).tunable();
pub const DAMPING_FREQUENCIES: Rule =
    rule("damping_frequencies", "frequency at which a ratio of critical damping is given", "Hz").above(0.0).tunable();

pub const WIDTH: Rule = rule("width", "width of the section along its y", "m").above(0.0).along_beam();
pub const HEIGHT: Rule = rule("height", "height of the section along its z", "m").above(0.0).along_beam();
pub const RADIUS: Rule = rule("radius", "radius of the section", "m").above(0.0).along_beam();
pub const INNER: Rule = rule("inner", "inner radius of the section", "m").from(0.0).along_beam();
pub const OUTER: Rule = rule("outer", "outer radius of the section", "m").above(0.0).along_beam();
pub const WALL: Rule = rule("wall", "thickness of the walls of the section", "m").above(0.0).along_beam();
pub const WEB: Rule = rule("web", "thickness of the web of the section", "m").above(0.0).along_beam();
pub const FLANGE: Rule = rule("flange", "thickness of the flanges of the section", "m").above(0.0).along_beam();
pub const AREA: Rule = rule("area", "area of the section", "m2").above(0.0).along_beam();
pub const SECOND_MOMENT_Y: Rule =
    rule("second_moment_y", "second moment of area, integral of z^2", "m4").above(0.0).along_beam();
pub const SECOND_MOMENT_Z: Rule =
    rule("second_moment_z", "second moment of area, integral of y^2", "m4").above(0.0).along_beam();
pub const TORSION_CONSTANT: Rule =
    rule("torsion_constant", "Saint-Venant torsion constant", "m4").above(0.0).along_beam();
pub const PRODUCT_MOMENT: Rule = rule("product_moment", "product of area, integral of y z", "m4").along_beam();
pub const POLAR_MOMENT: Rule = rule("polar_moment", "polar second moment of area", "m4").above(0.0).along_beam();
pub const FOURTH_MOMENTS: Rule =
    rule("fourth_moments", "fourth moment of area (yyyy, yyzz, zzzz)", "m6").from(0.0).along_beam();
pub const SECTION_TURN: Rule = rule("turn", "turn of the section about the tangent", "rad").along_beam();
pub const AXIAL_RIGIDITY: Rule = rule("EA", "axial rigidity", "N").above(0.0).along_beam();
pub const BENDING_RIGIDITY_Y: Rule = rule("EI_y", "bending rigidity about y", "N.m2").above(0.0).along_beam();
pub const BENDING_RIGIDITY_Z: Rule = rule("EI_z", "bending rigidity about z", "N.m2").above(0.0).along_beam();
pub const BENDING_COUPLING: Rule =
    rule("EI_yz", "bending rigidity between y and z, integral of E y z", "N.m2").along_beam();
pub const TENSION_CENTER: Rule =
    rule("tension_center", "tension center of the section along its y and z, from the axis of the beam", "m")
        .along_beam();
pub const TORSION_RIGIDITY: Rule = rule("GJ", "torsion rigidity", "N.m2").above(0.0).along_beam();
pub const LINE_DENSITY: Rule = rule("line_density", "mass per length", "kg/m").above(0.0).along_beam();
pub const POLAR_INERTIA: Rule =
    rule("polar_inertia", "polar moment of inertia per length", "kg.m").above(0.0).along_beam();

pub const FROM: Rule = rule("from", "start of the beam, global", "m");
pub const TO: Rule = rule("to", "end of the beam, global", "m");
pub const CURVE_X: Rule = rule("x", "global x of the beam along its curve", "m").along_curve();
pub const CURVE_Y: Rule = rule("y", "global y of the beam along its curve", "m").along_curve();
pub const CURVE_Z: Rule = rule("z", "global z of the beam along its curve", "m").along_curve();
pub const CURVE_S: Rule = rule("s", "curve parameter at the start and at the end of the beam", "");
pub const CURVE_POINTS: Rule = rule("points", "points of the beam's curve, global", "m");
pub const Y_AXIS: Rule = rule("y_axis", "direction of the section's y at the start, global", "");
/// More elements than this are a slip of the finger.
const MOST_ELEMENTS: f64 = 1e5;
pub const ELEMENTS: Rule = rule("elements", "number of elements", "").from(1.0).to(MOST_ELEMENTS).count();
pub const PRETWIST: Rule = rule("pretwist", "additional turn of the section from start to end", "rad");
pub const PRETENSION: Rule = rule("pretension", "axial force of the beam as drawn, tension positive", "N");
pub const FREE_CURVATURE: Rule =
    rule("free_curvature", "curvature of the beam without stress, about the section's y and z", "1/m");
pub const FREE_TORSION: Rule = rule("free_torsion", "torsion of the beam without stress", "rad/m");
pub const TENSION_DAMPING: Rule =
    rule("tension_damping", "damping of the axial strain, beyond that of the material", "s").from(0.0).tunable();
pub const TEMPERATURE: Rule =
    rule("temperature", "temperature of the beam, above that at which it is as drawn", "K").along_in_time();
pub const TEMPERATURE_GRADIENT: Rule =
    rule("temperature_gradient", "gradient of the temperature along the section's y and z", "K/m").along_in_time();
pub const VELOCITY: Rule = rule("velocity", "initial velocity of the start, global axes", "m/s");
pub const ANGULAR_VELOCITY: Rule = rule("angular_velocity", "initial angular velocity, global axes", "rad/s");

pub const MASS: Rule = rule("mass", "mass", "kg").above(0.0);
pub const CENTER: Rule = rule("position", "center of mass as drawn, global", "m");
pub const PRINCIPAL_INERTIA: Rule =
    rule("inertia", "moment of inertia about the center of mass, body axes", "kg.m2").above(0.0);
pub const INERTIA: Rule =
    rule("inertia", "tensor of inertia about the center of mass, body axes (xx, yy, zz, xy, yz, zx)", "kg.m2");
pub const AXES: Rule = rule("axes", "body axes as drawn, global, one per row", "");
pub const BODY_VELOCITY: Rule = rule("velocity", "initial velocity of the center of mass, global axes", "m/s");

pub const FRAME_POSITION: Rule = rule("position", "place of the frame, global", "m").in_time();
pub const FRAME_ROTATION: Rule = rule("rotation", "rotation vector of the frame, global axes", "rad").in_time();
/// In the place of a rotation that the host gives.
pub const QUATERNION: Rule = rule("quaternion", "orientation of the frame", "");

pub const OFFSET: Rule = rule("offset", "place of the point relative to what it is on, in the axes of that", "m");
pub const POINT_AXES: Rule = rule("axes", "axes of the point as drawn, global, one per row", "");

pub const AT: Rule = rule("at", "place of the joint as drawn, global", "m");
pub const AXIS: Rule = rule("axis", "axis of the joint as drawn, global", "");
pub const AXIS2: Rule = rule("axis2", "second axis of the joint as drawn, global", "");
pub const ANGLE_STIFFNESS: Rule = rule("stiffness", "stiffness of the angle", "N.m/rad").from(0.0).tunable();
pub const ANGLE_DAMPING: Rule = rule("damping", "damping of the angle", "N.m.s/rad").from(0.0).tunable();
pub const DISTANCE_STIFFNESS: Rule = rule("stiffness", "stiffness of the distance", "N/m").from(0.0).tunable();
pub const DISTANCE_DAMPING: Rule = rule("damping", "damping of the distance", "N.s/m").from(0.0).tunable();
pub const BUSHING_STIFFNESS: Rule =
    rule("stiffness", "stiffness along the global axis as drawn", "N/m").from(0.0).tunable();
pub const BUSHING_DAMPING: Rule =
    rule("damping", "damping along the global axis as drawn", "N.s/m").from(0.0).tunable();
pub const ROTATIONAL_STIFFNESS: Rule =
    rule("rotational_stiffness", "stiffness against turning", "N.m/rad").from(0.0).tunable();
pub const ROTATIONAL_DAMPING: Rule =
    rule("rotational_damping", "damping of the turning", "N.m.s/rad").from(0.0).tunable();

pub const ACTIVE: Rule =
    rule("active", "engaged where it is at least 0.5, else released", "").from(0.0).to(1.0).in_time();

pub const ANGLE: Rule = rule("value", "angle that the drive prescribes", "rad").in_time();
pub const DISTANCE: Rule = rule("value", "distance that the drive prescribes", "m").in_time();
pub const ANGLE_RATE: Rule = rule("rate", "rate of the angle that the drive prescribes", "rad/s").in_time();
pub const DISTANCE_RATE: Rule = rule("rate", "rate of the distance that the drive prescribes", "m/s").in_time();

pub const PAID_OUT: Rule =
    rule("length", "length of the beam that the winch has paid out, beyond the one as drawn", "m").in_time();
pub const PAYOUT_RATE: Rule = rule("rate", "rate at which the winch pays out the beam", "m/s").in_time();

pub const TORQUE: Rule =
    rule("effort", "torque of the actuator on side b about the axis", "N.m").tunable().in_control();
pub const THRUST: Rule =
    rule("effort", "force of the actuator on side b, away from side a", "N").tunable().in_control();

pub const SPRING_STIFFNESS: Rule = rule("stiffness", "stiffness of the spring", "N/m").from(0.0).tunable();
pub const SPRING_DAMPING: Rule = rule("damping", "damping along the spring", "N.s/m").from(0.0).tunable();
pub const SPRING_LENGTH: Rule = rule("length", "unstretched length of the spring", "m").from(0.0).tunable();
pub const REST_ANGLE: Rule = rule("rest", "angle at which the spring is free of torque", "rad").tunable();
pub const REST_DISTANCE: Rule = rule("rest", "distance at which the spring is free of force", "m").tunable();
pub const SPRING_FORCE: Rule =
    rule("force", "tension of the spring, by its elongation x and the rate v", "N").tunable().over_elongation();
pub const SPRING_TORQUE: Rule =
    rule("force", "torque of the spring against the angle, by its elongation x and the rate v", "N.m")
        .tunable()
        .over_elongation();

pub const RATIO: Rule = rule("ratio", "coordinate of joint a over that of joint b", "");
pub const RATIO_ANGLE_DISTANCE: Rule = rule("ratio", "angle of joint a over the distance of joint b", "rad/m");
pub const RATIO_DISTANCE_ANGLE: Rule = rule("ratio", "distance of joint a over the angle of joint b", "m/rad");
pub const LAW_OF_ANGLE: Rule = rule("law", "angle of joint a, by the coordinate x of joint b", "rad").over_coordinate();
pub const LAW_OF_DISTANCE: Rule =
    rule("law", "distance of joint a, by the coordinate x of joint b", "m").over_coordinate();

pub const COULOMB_TORQUE: Rule = rule("coulomb", "torque of dry friction", "N.m").from(0.0).tunable();
pub const COULOMB_FORCE: Rule = rule("coulomb", "force of dry friction", "N").from(0.0).tunable();
pub const VISCOUS_TORQUE: Rule = rule("viscous", "friction torque per rate", "N.m.s/rad").from(0.0).tunable();
pub const VISCOUS_FORCE: Rule = rule("viscous", "friction force per rate", "N.s/m").from(0.0).tunable();
pub const FRICTION_ANGLE_RATE: Rule =
    rule("speed", "rate at which dry friction has 71 % of its torque", "rad/s").above(0.0).tunable();
pub const FRICTION_RATE: Rule =
    rule("speed", "rate at which dry friction has 71 % of its force", "m/s").above(0.0).tunable();

pub const LOWER_ANGLE: Rule = rule("lower", "least angle without contact", "rad").tunable();
pub const UPPER_ANGLE: Rule = rule("upper", "largest angle without contact", "rad").tunable();
pub const LOWER_DISTANCE: Rule = rule("lower", "least distance without contact", "m").tunable();
pub const UPPER_DISTANCE: Rule = rule("upper", "largest distance without contact", "m").tunable();
pub const ANGLE_STOP_STIFFNESS: Rule = rule("stiffness", "stiffness of the stop", "N.m/rad").above(0.0).tunable();
pub const STOP_STIFFNESS: Rule = rule("stiffness", "stiffness of the stop", "N/m").above(0.0).tunable();
pub const ANGLE_STOP_DAMPING: Rule =
    rule("damping", "share of the elastic torque per rate of penetration", "s/rad").from(0.0).tunable();
pub const STOP_DAMPING: Rule =
    rule("damping", "share of the elastic force per rate of penetration", "s/m").from(0.0).tunable();

pub const FORCE: Rule = rule("force", "force", "N").tunable().in_time();
pub const MOMENT: Rule = rule("moment", "moment", "N.m").tunable().in_time();
pub const FORCE_PER_LENGTH: Rule = rule("force", "force per length", "N/m").tunable().in_time();
pub const MOMENT_PER_LENGTH: Rule = rule("moment", "moment per length", "N").tunable().in_time();
/// The number behind the `@` of a point of a beam.
pub const FRACTION: Rule = rule("at", "fraction of the beam's length", "").from(0.0).to(1.0);

/// More stations than this are a slip of the finger: each is a row of the table of variables.
const MOST_STATIONS: f64 = 1e4;
/// A count that is no parameter.
pub const STATIONS: Rule =
    rule("stations", "number of equally spaced points of the beam", "").from(2.0).to(MOST_STATIONS).count();

pub const STOP: Rule = rule("stop", "end of the simulation", "s").above(0.0);
pub const PRELOAD: Rule =
    rule("preload", "duration of the static path that leads to the initial equilibrium", "s").from(0.0);
pub const STEP: Rule = rule("step", "largest internal step", "s").above(0.0);
pub const ACCURACY: Rule = rule("accuracy", "error of a motion because of its steps, as a share of its range", "")
    .from(FINEST_ACCURACY)
    .to(COARSEST_ACCURACY);
/// What [`ACCURACY`] may be: below, round-off is more; above, the steps of a motion say nothing of it.
pub const FINEST_ACCURACY: f64 = 1e-9;
pub const COARSEST_ACCURACY: f64 = 0.1;
pub const OUTPUT_STEP: Rule = rule("output_step", "time between two rows of results", "s").above(0.0);
pub const TOLERANCE: Rule = rule("tolerance", "bound of the last Newton increment", "").from(1e-14).to(1e-3);
pub const CONSERVED_RADIUS: Rule =
    rule("spectral_radius", "share of the fastest oscillations that a step keeps", "").from(0.6).to(1.0);
pub const SPECTRAL_RADIUS: Rule =
    rule("spectral_radius", "share of the fastest oscillations that a step keeps", "").from(0.0).to(1.0);
