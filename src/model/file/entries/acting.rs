//! All that acts on the coordinates of joints and on the distances between points.

use super::Parts;
use super::actuator::Action;
use crate::model::text::diagnostic::Place;
use crate::model::text::names::Kind;

/// A drive, an actuator, a gear at one of its joints, a spring, friction, a stop or a lock.
#[derive(Clone, Copy, Debug)]
pub struct Acting<'a> {
    /// The kind.
    pub kind: Kind,
    /// Its index among those of its kind.
    pub index: usize,
    /// Its name.
    pub name: &'a str,
    /// Where the name stands.
    pub place: Place,
    /// The coordinate or the points that it acts on.
    pub action: Action,
}

impl Parts {
    /// All that acts on coordinates; gears twice, first at the joint that follows.
    pub fn acting(&self) -> impl Iterator<Item = Acting<'_>> {
        let mut all = Vec::new();
        for (index, own) in self.drives.iter().enumerate() {
            let action = Action::Joint { joint: own.joint, coordinate: own.coordinate };
            all.push(Acting { kind: Kind::Drive, index, name: &own.name, place: own.place, action });
        }
        for (index, own) in self.actuators.iter().enumerate() {
            let action = own.action;
            all.push(Acting { kind: Kind::Actuator, index, name: &own.name, place: own.place, action });
        }
        for (index, own) in self.gears.iter().enumerate() {
            for (joint, coordinate) in own.sides {
                let action = Action::Joint { joint, coordinate };
                all.push(Acting { kind: Kind::Gear, index, name: &own.name, place: own.place, action });
            }
        }
        for (index, own) in self.springs.iter().enumerate() {
            let action = own.action;
            all.push(Acting { kind: Kind::Spring, index, name: &own.name, place: own.place, action });
        }
        for (index, own) in self.frictions.iter().enumerate() {
            let action = own.action;
            all.push(Acting { kind: Kind::Friction, index, name: &own.name, place: own.place, action });
        }
        for (index, own) in self.stops.iter().enumerate() {
            let action = own.action;
            all.push(Acting { kind: Kind::Stop, index, name: &own.name, place: own.place, action });
        }
        for (index, own) in self.locks.iter().enumerate() {
            let action = Action::Joint { joint: own.joint, coordinate: own.coordinate };
            all.push(Acting { kind: Kind::Lock, index, name: &own.name, place: own.place, action });
        }
        all.into_iter()
    }
}
