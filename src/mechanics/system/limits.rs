//! What elements, bodies and joints can bear in a step (MECHANICS 2.6, 6, 7.4).

use super::frame_cache::FrameCache;
use crate::error::Error;
use crate::math::elementary::atan2;
use crate::math::rotation::rotation_angle;
use crate::mechanics::body::kinematics;
use crate::mechanics::constraint::joint::Joint;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::marker::relative_coordinate::{Measure, RelativeCoordinate};
use crate::mechanics::state::State;
use crate::mechanics::system::System;

/// Slopes `|r'|` in which the element means something: outside it is stretched or squeezed beyond any beam theory
/// (MECHANICS 7.4).
const STRETCHES: std::ops::RangeInclusive<f64> = 0.3..=3.0;
/// Largest change of the twist of an element in a step, rad: the branch is safe below pi (MECHANICS 2.6).
const LARGEST_TWIST_CHANGE: f64 = 2.0;
/// Largest change of a joint's angle in a step, rad: beyond pi its turns could not be counted.
const LARGEST_ANGLE_CHANGE: f64 = 2.0;
/// Largest difference between a joint's angle and what its drive prescribes, rad: a turn missed is far beyond,
/// round-off far below.
const DRIVE_GAP: f64 = 0.1;

/// Largest turn of a bushing, degrees: its rotation vector has no direction at half a turn.
const LARGEST_BUSHING_ANGLE: f64 = 170.0;

impl System {
    /// The first beam that is twisted beyond half of the rate above which its energy has no lower bound: its name,
    /// twist rate and bound, rad/m.
    pub fn twist_near_limit<'a>(&'a self, state: &'a State, snapshot: &mut FrameCache) -> Option<(&'a str, f64, f64)> {
        let mut limited = self.beams.iter().filter(|beam| beam.twist_limit.is_finite()).peekable();
        limited.peek()?;
        let configuration = snapshot.of(self, state);
        limited.find_map(|beam| {
            let elements = &self.mesh.elements[beam.element_range()];
            let rates = elements.iter().map(|element| element.largest_torsion(&configuration.beams).abs());
            let largest = rates.fold(0.0, f64::max);
            (largest > 0.5 * beam.twist_limit).then_some((beam.name.as_str(), largest, beam.twist_limit))
        })
    }

    /// Checks that no element twists further than the branch is safe for, from `before` to `after`.
    ///
    /// # Errors
    /// An element twists too far: an increment that large may end on another branch of equilibria.
    pub fn check_twist_change(&self, before: &Configuration, after: &Configuration, time: f64) -> Result<(), Error> {
        for (number, element) in self.mesh.elements.iter().enumerate() {
            if (element.twist(&after.beams, 1.0) - element.twist(&before.beams, 1.0)).abs() > LARGEST_TWIST_CHANGE {
                let (beam, place) = self.beam_of(number);
                return Err(Error::Distorted { time, beam: beam.name.clone(), element: place, what: "twisted" });
            }
        }
        Ok(())
    }

    /// Checks what elements, bodies and joints can bear at the end `c` of a step or increment from `state`; `turn` is
    /// the largest turn of a tangent, a section or a body, rad. Returns the largest turn of all, joints included, over
    /// what it may be.
    ///
    /// # Errors
    /// A tangent, a section, a body or an angle turned too far, an element is bent or twisted too far, a slope is out
    /// of range, a joint stands the wrong way round.
    pub fn check(&self, c: &Configuration, state: &State, turn: f64, time: f64) -> Result<f64, Error> {
        self.check_winches(c, time)?;
        let nodes = self.check_nodes(c, state, turn, time)?;
        self.check_elements(c, time)?;
        let bodies = self.check_bodies(c, state, turn, time)?;
        let joints = self.check_joints(c, state, time)?;
        self.check_contacts(c, state, time)?;
        self.check_slides(c, time)?;
        self.check_ropes(c, time)?;
        Ok((nodes / turn).max(bodies / turn).max(joints / LARGEST_ANGLE_CHANGE))
    }

    /// Returns the largest turn, rad.
    fn check_nodes(&self, c: &Configuration, state: &State, turn: f64, time: f64) -> Result<f64, Error> {
        let mut largest = 0.0_f64;
        for (number, node) in self.mesh.nodes.iter().enumerate() {
            let place = || self.describe_node(number);
            let [before, slope] = [node.slope(&state.q), node.slope(c.beams.q)];
            let stretch = slope.norm() / self.free_slope(number, c);
            if !stretch.is_finite() || !STRETCHES.contains(&stretch) {
                return Err(Error::Stretched { time, place: place(), stretch });
            }
            let angle = atan2(slope.cross(&before).norm(), slope.dot(&before));
            if angle > turn {
                return Err(Error::Turned { time, place: format!("the tangent at {}", place()), angle, limit: turn });
            }
            largest = largest.max(angle);
            let angle = node.section_turn(&state.q, c.beams.q);
            // Not-a-number must fail: `>` alone would let it pass.
            if angle > turn || angle.is_nan() {
                return Err(Error::Turned { time, place: format!("the section at {}", place()), angle, limit: turn });
            }
            largest = largest.max(angle);
        }
        Ok(largest)
    }

    fn check_elements(&self, c: &Configuration, time: f64) -> Result<(), Error> {
        for (number, element) in self.mesh.elements.iter().enumerate() {
            let (beam, place) = self.beam_of(number);
            if let Some(what) = element.distortion(&c.beams) {
                return Err(Error::Distorted { time, beam: beam.name.clone(), element: place, what });
            }
            if beam.twist_limit.is_finite() {
                let rate = element.largest_torsion(&c.beams);
                if rate.abs() > beam.twist_limit {
                    let limit = beam.twist_limit;
                    return Err(Error::TwistBeyondTruncation {
                        time,
                        beam: beam.name.clone(),
                        element: place,
                        rate,
                        limit,
                    });
                }
            }
        }
        Ok(())
    }

    /// Returns the largest turn, rad.
    fn check_bodies(&self, c: &Configuration, state: &State, turn: f64, time: f64) -> Result<f64, Error> {
        let mut largest = 0.0_f64;
        for body in &self.bodies {
            let (start, end) = (kinematics::pose(&state.q, body.start), kinematics::pose(c.beams.q, body.start));
            let angle = rotation_angle(&start.axes, &end.axes);
            // Not-a-number must fail: `>` alone would let it pass.
            if angle > turn || angle.is_nan() {
                return Err(Error::Turned { time, place: format!("body {}", body.name), angle, limit: turn });
            }
            largest = largest.max(angle);
        }
        Ok(largest)
    }

    /// Whether a joint between the sides of a relative coordinate is released: nothing counts its turns then.
    fn is_released(&self, coordinate: &RelativeCoordinate, c: &Configuration) -> bool {
        let is_own = |joint: &&Joint| joint.a == coordinate.a && joint.b == coordinate.b;
        self.joints.iter().filter(is_own).any(|joint| joint.drive.is_none() && joint.is_released(c))
    }

    /// Returns the largest turn, rad.
    fn check_joints(&self, c: &Configuration, state: &State, time: f64) -> Result<f64, Error> {
        let mut largest = 0.0_f64;
        if let Some(joint) = self.joints.iter().find(|joint| !joint.is_upright(c)) {
            return Err(Error::Flipped { time, joint: joint.name.clone() });
        }
        for (coordinate, previous) in self.relative_coordinates.iter().zip(&state.relative_values) {
            if !matches!(coordinate.measure, Measure::Angle(_)) {
                continue;
            }
            let angle = (coordinate.value(c, *previous) - previous).abs();
            if angle > LARGEST_ANGLE_CHANGE && !self.is_released(coordinate, c) {
                let place = self.describe_relative_coordinate(coordinate);
                return Err(Error::Turned { time, place, angle, limit: LARGEST_ANGLE_CHANGE });
            }
            largest = largest.max(angle);
        }
        for spring in self.springs.iter().filter(|spring| !spring.is_idle()) {
            let coordinate = &self.relative_coordinates[spring.coordinate];
            if !matches!(coordinate.measure, Measure::Rotation(_)) {
                continue;
            }
            let angle = rotation_angle(&coordinate.a.pose(c).axes, &coordinate.b.pose(c).axes).to_degrees();
            if angle > LARGEST_BUSHING_ANGLE {
                return Err(Error::BushingTurned { time, bushing: spring.name.clone(), angle });
            }
        }
        for joint in &self.joints {
            let Some(number) = joint.drive.filter(|_| !joint.is_released(c)) else { continue };
            let drive = &self.drives[number];
            let Some(coordinate) = drive.coordinate else { continue };
            let reading = self.relative_coordinates[coordinate].value(c, state.relative_values[coordinate]);
            let prescribed = joint.prescribed(c).value;
            if (reading - prescribed).abs() > DRIVE_GAP {
                return Err(Error::DriveMissed { time, drive: drive.name.clone(), prescribed, reading });
            }
        }
        Ok(largest)
    }
}
