//! Which quantities are alike: forces, rates, what jumps, what depends on who looks.

use super::quantity::Quantity;

impl Quantity {
    /// Whether it is all that a joint or a frame transmits, or a part of it.
    pub fn is_transmitted(self) -> bool {
        use Quantity::*;
        matches!(self, ReactionForce | ReactionMoment | AppliedForce | AppliedMoment)
    }

    /// Whether it is what a section bears, or its strains, which follow from what it bears.
    pub fn is_of_section(self) -> bool {
        use Quantity::*;
        matches!(
            self,
            SectionForce | SectionMoment | EffectiveTension | WallTension | Stress | AxialStrain | Curvature | Torsion
        )
    }

    /// Whether it differs between the sides of a section at which something acts; the largest stress is that of both.
    pub fn has_sides(self) -> bool {
        self.is_of_section() && self != Self::Stress
    }

    /// Whether only a model with water has it.
    pub fn is_of_water(self) -> bool {
        use Quantity::*;
        matches!(self, WallTension | Submergence | Clearance | Elevation)
    }

    /// Whether it is of the flow of water or air.
    pub fn is_of_flow(self) -> bool {
        matches!(self, Self::FluidVelocity | Self::Drag)
    }

    /// Whether it is of a line on the seabed.
    pub fn is_of_seabed(self) -> bool {
        matches!(self, Self::Touchdown | Self::LaidLength)
    }

    /// Whether it is given along axes that can be chosen: it depends on who looks.
    pub fn has_axes(self) -> bool {
        use Quantity::*;
        let is_motion = matches!(
            self,
            Position | Displacement | Velocity | Acceleration | Rotation | Quaternion | AngularVelocity | Tilt
        );
        is_motion || self.is_transmitted()
    }

    /// Whether it holds the fast oscillations that a step does not resolve, and jumps where the motion only bends:
    /// strains, forces, accelerations.
    pub fn is_rough(self) -> bool {
        use Quantity::*;
        let is_strain = matches!(self, AxialStrain | Curvature | Torsion | Stress);
        let is_force = matches!(
            self,
            SectionForce
                | SectionMoment
                | EffectiveTension
                | WallTension
                | Drag
                | ContactPressure
                | Effort
                | Power
                | Force
                | NormalForce
                | FrictionForce
                | Penetration
                | Sliding
                | Tension
        ) || self.is_transmitted();
        is_strain || is_force || self.is_acceleration()
    }

    /// Whether it jumps along a beam, at positions that no mesh hits.
    pub fn jumps_along_beam(self) -> bool {
        self == Self::ContactPressure
    }

    /// Whether it tells where the mechanism is, or an energy: neither how fast it moves nor which strains and forces
    /// there are.
    pub fn is_configuration(self) -> bool {
        use Quantity::*;
        let is_place =
            matches!(self, Position | Displacement | Rotation | Quaternion | Tilt | Twist | Angle | Distance)
                || matches!(self, Declination | Azimuth | Submergence | Clearance | Elevation);
        is_place || matches!(self, Energy | KineticEnergy | ElasticEnergy | GravityEnergy)
    }

    /// Whether it is a second derivative by time.
    pub fn is_acceleration(self) -> bool {
        use Quantity::*;
        matches!(self, Acceleration | AngleAcceleration | DistanceAcceleration)
    }

    /// Whether it is a free coordinate of a joint, or its rate.
    pub fn is_coordinate(self) -> bool {
        use Quantity::*;
        matches!(self, Angle | Distance) || self.is_rate()
    }

    /// Whether it is the rate of a free coordinate of a joint.
    pub fn is_rate(self) -> bool {
        use Quantity::*;
        matches!(self, AngleRate | DistanceRate)
    }
}
