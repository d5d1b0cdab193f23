//! The place of a state: where its parts are, how they move and what is engaged; and how a state of another system with
//! the same parts takes it over.

use super::State;
use crate::mechanics::input::prescribed::MovingPose;

/// Where the values of a system are in the state of another one with the same parts, by their numbers there; none: the
/// other system does not have them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counterparts {
    /// Of the relative coordinates.
    pub relative_values: Vec<Option<usize>>,
    /// Of the sensors.
    pub rotations: Vec<Option<usize>>,
    /// Of the switches.
    pub holds: Vec<Option<usize>>,
    /// Of what forces remember.
    pub memory: Vec<Option<usize>>,
}

impl State {
    /// Takes from `source`, a state of the same parts, where these are and how they move, what drives and frames have
    /// come to and what is engaged: all that a motion or a path begins with. Values without a counterpart stay as
    /// drawn.
    pub fn take_place_of(&mut self, source: &Self, counterparts: &Counterparts) {
        self.time = source.time;
        self.q.clone_from(&source.q);
        self.velocity.clone_from(&source.velocity);
        self.triads.clone_from(&source.triads);
        self.holonomy.clone_from(&source.holonomy);
        self.prescribed.drives.clone_from(&source.prescribed.drives);
        self.prescribed.frames.clone_from(&source.prescribed.frames);
        take(&mut self.relative_values, &source.relative_values, &counterparts.relative_values);
        take(&mut self.rotations, &source.rotations, &counterparts.rotations);
        take(&mut self.prescribed.holds, &source.prescribed.holds, &counterparts.holds);
        take(&mut self.lists.memory, &source.lists.memory, &counterparts.memory);
    }

    /// Whether the lists of its place have the lengths of those of `other`, a state of the same parts. Relative values,
    /// rotations, holds and memories, of which systems with the same parts may have different numbers, have `lengths`.
    pub fn has_the_place_of(&self, other: &Self, lengths: [usize; 4]) -> bool {
        let of_parts = |state: &Self| {
            let Self { lists, triads, holonomy, prescribed, .. } = state;
            let motions = [prescribed.drives.len(), prescribed.frames.len()];
            ([lists.q.len(), lists.velocity.len(), triads.len(), holonomy.len()], motions)
        };
        let own =
            [self.relative_values.len(), self.rotations.len(), self.prescribed.holds.len(), self.lists.memory.len()];
        of_parts(self) == of_parts(other) && own == lengths
    }

    /// Whether any of its velocities is not 0.
    pub fn is_moving(&self) -> bool {
        self.velocity.iter().any(|value| *value != 0.0)
    }

    /// Whether all numbers of its position are finite.
    pub fn is_finite(&self) -> bool {
        let lists = [&self.q, &self.velocity, &self.momentum, &self.holonomy, &self.relative_values];
        let vectors = self.triads.iter().flat_map(|triad| [&triad.t, &triad.u]).chain(&self.rotations);
        self.time.is_finite()
            && lists.into_iter().flatten().all(|value| value.is_finite())
            && vectors.flatten().all(|value| value.is_finite())
            && self.prescribed.drives.iter().all(|drive| drive.is_finite())
            && self.prescribed.frames.iter().all(MovingPose::is_finite)
            && self.prescribed.holds.iter().all(|hold| hold.value.is_finite() && hold.pose.is_finite())
    }
}

/// Takes the values of `source` that have a counterpart there.
fn take<T: Copy>(own: &mut [T], source: &[T], counterparts: &[Option<usize>]) {
    for (own, number) in own.iter_mut().zip(counterparts) {
        if let Some(value) = number.and_then(|number| source.get(number)) {
            *own = *value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::input::switch::Hold;

    /// Values go to their counterparts, in another order and among others; values without one stay.
    #[test]
    fn values_go_to_their_counterparts() {
        let mut own = State { relative_values: vec![0.1, 0.2, 0.3], ..State::default() };
        own.prescribed.holds = vec![Hold::drawn(true); 2];
        let mut source = State { relative_values: vec![5.0, 6.0], ..State::default() };
        source.prescribed.holds = vec![Hold { value: 7.0, ..Hold::drawn(false) }];
        let counterparts = Counterparts {
            relative_values: vec![Some(1), None, Some(0)],
            holds: vec![None, Some(0)],
            ..Counterparts::default()
        };
        own.take_place_of(&source, &counterparts);
        assert_eq!(own.relative_values, [6.0, 0.2, 5.0]);
        assert_eq!(own.prescribed.holds, [Hold::drawn(true), source.prescribed.holds[0]]);
    }
}
