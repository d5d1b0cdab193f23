//! Loads, joints, springs, actuators and ropes that act on elements between their nodes: section forces change there.

use crate::mechanics::force::load::Site;
use crate::mechanics::marker::Marker;
use crate::mechanics::system::System;

/// Something that acts between the nodes of an element, by its number in the system; of what has two sides, whether it
/// is side b.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InnerPart {
    /// A load, at a point or along the element.
    Load(usize),
    /// The conditions of a joint.
    Joint(usize, bool),
    /// A spring.
    Spring(usize, bool),
    /// An actuator.
    Actuator(usize, bool),
    /// An end of a rope.
    Rope(usize, bool),
}

impl System {
    /// Finds the parts that act between the nodes of elements.
    pub fn find_inner_parts(&mut self) {
        let mut parts = Vec::new();
        let mut add = |marker: &Marker, part: InnerPart| {
            if let Marker::Section { element, .. } = marker {
                parts.push((*element, part));
            }
        };
        for (number, load) in self.loads.iter().enumerate() {
            match &load.site {
                Site::Point(marker) => add(marker, InnerPart::Load(number)),
                Site::Line(_) | Site::Moving(_) => {
                    load.elements().for_each(|element| add(&Marker::section(element, 0.0), InnerPart::Load(number)));
                }
            }
        }
        for (number, joint) in self.joints.iter().enumerate() {
            add(&joint.a, InnerPart::Joint(number, false));
            add(&joint.b, InnerPart::Joint(number, true));
        }
        let springs = self.springs.iter().map(|spring| spring.coordinate).enumerate();
        for (number, sides) in springs.map(|(number, coordinate)| (number, self.sides(coordinate))) {
            sides
                .into_iter()
                .zip([false, true])
                .for_each(|(marker, is_b)| add(marker, InnerPart::Spring(number, is_b)));
        }
        let actuators = self.actuators.iter().map(|actuator| actuator.coordinate).enumerate();
        for (number, sides) in actuators.map(|(number, coordinate)| (number, self.sides(coordinate))) {
            let sides = sides.into_iter().zip([false, true]);
            sides.for_each(|(marker, is_b)| add(marker, InnerPart::Actuator(number, is_b)));
        }
        for (number, rope) in self.ropes.iter().enumerate() {
            let ends = [rope.seats.first(), rope.seats.last()].into_iter().zip([false, true]);
            ends.for_each(|(seat, is_b)| {
                if let Some(seat) = seat {
                    add(&seat.marker, InnerPart::Rope(number, is_b));
                }
            });
        }
        parts.sort_by_key(|(element, _)| *element);
        self.inner_parts = parts;
    }

    /// The parts that act between the nodes of element `element`.
    pub fn inner_parts_of(&self, element: usize) -> impl Iterator<Item = InnerPart> + '_ {
        let first = self.inner_parts.partition_point(|(own, _)| *own < element);
        self.inner_parts[first..].iter().take_while(move |(own, _)| *own == element).map(|(_, part)| *part)
    }
}
