//! Adds what acts on the free coordinates of joints by conditions: drives, locks and gears; and the switches that
//! engage and release these and joints.

use super::SystemBuilder;
use crate::mechanics::beam::ancf14::paid_out::PaidOut;
use crate::mechanics::beam::ancf14::payout::Payout;
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::constraint::driven::Driven;
use crate::mechanics::constraint::gear::{CamLaw, GearSide};
use crate::mechanics::constraint::joint::{Held, Holding, Joint};
use crate::mechanics::input::guide::{Drive, Guide};
use crate::mechanics::input::switch::Switch;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::relative_coordinate::RelativeCoordinate;
use crate::mechanics::system::{Lock, Winch};

impl SystemBuilder {
    /// Adds a switch and returns its number; `target` is its value at the start, where a host gives it.
    pub fn add_switch(&mut self, switch: Switch, target: f64) -> usize {
        self.system.switches.push(switch);
        self.targets.switches.push(target);
        self.system.switches.len() - 1
    }

    /// Adds a drive of b against a along or about their first axis, which a `switch` may engage and release, and
    /// returns its number; `target` is its value or rate at the start, where a host gives it.
    pub fn add_drive(
        &mut self,
        name: &str,
        [a, b]: [Marker; 2],
        driven: Driven,
        (guide, target): (Guide, f64),
        switch: Option<usize>,
    ) -> usize {
        let number = self.system.drives.len();
        let coordinate = self.add_relative_coordinate(a, b, driven.measure());
        self.drive_joints.push(Joint {
            name: format!("drive {name}"),
            a,
            b,
            primitives: driven.primitives(),
            drive: Some(number),
            gear: None,
            slide: None,
            holding: switch.map(|switch| Holding { switch, held: Held::Coordinate(coordinate) }),
        });
        self.system.drives.push(Drive { name: name.into(), coordinate: Some(coordinate), guide, switch });
        self.targets.drives.push(target);
        number
    }

    /// Lets beam `beam`, of ANCF14 with the same section everywhere, be paid out at its end, or at its start; arguments
    /// as of [`Self::add_drive`].
    pub fn add_winch(&mut self, name: &str, (beam, at_end): (usize, bool), (guide, target): (Guide, f64)) {
        let drive = self.system.drives.len();
        let range = self.system.beams[beam].element_range();
        let length = self.system.mesh.elements[range.clone()].iter().map(|element| element.length()).sum();
        let payout = Payout { drive, length, far_end: if at_end { 0.0 } else { length } };
        let mut begin = 0.0;
        for element in &mut self.system.mesh.elements[range] {
            let AnyElement::Ancf14(drawn) = element else { continue };
            let own = drawn.length;
            *element = AnyElement::PaidOut(Box::new(PaidOut::new(drawn.clone(), begin, payout)));
            begin += own;
        }
        self.system.drives.push(Drive { name: name.into(), coordinate: None, guide, switch: None });
        self.system.winches.push(Winch { beam, drive, length });
        self.targets.drives.push(target);
    }

    /// Adds drive `drive` to what joint `joint` of the model file consists of.
    pub fn add_drive_of(&mut self, joint: usize, drive: usize) {
        self.system.joint_parts[joint].drives.push(drive);
    }

    /// Adds a lock of b against a along or about their first axis, and returns its number.
    pub fn add_lock(&mut self, name: &str, [a, b]: [Marker; 2], driven: Driven, switch: usize) -> usize {
        let coordinate = self.add_relative_coordinate(a, b, driven.measure());
        self.lock_joints.push(Joint {
            name: format!("lock {name}"),
            a,
            b,
            primitives: driven.primitives(),
            drive: None,
            gear: None,
            slide: None,
            holding: Some(Holding { switch, held: Held::Coordinate(coordinate) }),
        });
        self.system.locks.push(Lock { coordinate, switch });
        self.system.locks.len() - 1
    }

    /// Adds lock `lock` to what joint `joint` of the model file consists of.
    pub fn add_lock_of(&mut self, joint: usize, lock: usize) {
        self.system.joint_parts[joint].locks.push(lock);
    }

    /// Adds a gear between relative coordinates, `x_first − ratio·x_second = 0`, or with a law
    /// `x_first − f(x_second) = 0`, and returns its number.
    pub fn add_gear(&mut self, name: &str, coordinates: [usize; 2], ratio: f64, law: Option<CamLaw>) -> usize {
        let gear = self.gear_joints.len() / 2;
        let sides = [(coordinates[0], 1.0, None, false), (coordinates[1], -ratio, law, true)];
        for (coordinate, factor, law, is_second) in sides {
            let RelativeCoordinate { a, b, measure } = self.system.relative_coordinates[coordinate].clone();
            let side = GearSide { gear, coordinate, factor, law, is_second };
            self.gear_joints.push(Joint {
                name: format!("gear {name}"),
                a,
                b,
                primitives: GearSide::primitives(measure),
                drive: None,
                gear: Some(side),
                slide: None,
                holding: None,
            });
        }
        gear
    }

    /// Adds a side of gear `gear` to what joint `joint` of the model file consists of.
    pub fn add_gear_of(&mut self, joint: usize, gear: usize, is_second: bool) {
        self.system.joint_parts[joint].gears.push((gear, is_second));
    }
}
