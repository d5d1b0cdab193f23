//! How the pose of a marker changes in time, with the coordinates and by prescribed motion.

use super::configuration::Configuration;
use super::{Marker, own_velocity};
use crate::mechanics::geometry::pose::PoseVector;

impl Marker {
    /// First derivatives by time of the vectors of the pose, at the velocities of all coordinates.
    pub fn pose_rate(&self, c: &Configuration, velocity: &[f64]) -> PoseVector {
        self.pose_q(c).times(&own_velocity(c, self, velocity)) + self.pose_t(c)[0].vectors()
    }

    /// Second derivatives by time of the vectors of the pose, at the velocities of all coordinates and their
    /// derivatives `acceleration`.
    pub fn pose_acceleration(&self, c: &Configuration, velocity: &[f64], acceleration: &[f64]) -> PoseVector {
        let pose_q = self.pose_q(c);
        let [velocity, acceleration] = [velocity, acceleration].map(|list| own_velocity(c, self, list));
        pose_q.times(&acceleration) + pose_q.convective(self, c, &velocity) + self.pose_t(c)[1].vectors()
    }
}
