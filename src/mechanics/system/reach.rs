//! How far differences may move a system.

use super::System;
use crate::mechanics::beam::Beam;
use crate::mechanics::beam::section::Section;
use crate::mechanics::marker::relative_coordinate::Measure;

/// Share of the elastic way of dry friction within which its force is taken for linear.
const SMOOTH_SHARE: f64 = 1e-3;
/// Penetration of a contact over the radius of its surface, or over the size of the system.
const PRESSED: f64 = 1e-4;
/// Sections of a beam that varies, from its start to its end, of which the most slender one counts.
const SECTIONS: u8 = 8;
/// Error of differences of fourth order that the stretch of slender beams may leave.
const STRETCHED: f64 = 1e-10;

impl System {
    /// Changes of coordinates up to `largest`, over the system's size or rad, along which differences of fourth order
    /// are right to `STRETCHED`. A straight change `r` stretches what turns by `r²`; the axial force of that leaves
    /// `r⁴ EA L²/EI` beside the force of bending.
    pub fn straight_reach(&self, largest: f64) -> f64 {
        let slenderness = |section: Section| {
            let Section { area, second_moment_y, second_moment_z, limp, .. } = section;
            let softest = second_moment_y.min(second_moment_z);
            // The tension of a chain is all of its stiffness.
            if limp.bending || softest <= 0.0 { 0.0 } else { area * self.size * self.size / softest }
        };
        let along = |beam: &Beam| {
            let at = |place: u8| slenderness(beam.section_at(f64::from(place) / f64::from(SECTIONS)));
            let sections = if beam.profile.is_some() { SECTIONS } else { 0 };
            (0..=sections).map(at).fold(0.0, f64::max)
        };
        let most = self.beams.iter().map(along).fold(0.0, f64::max);
        if most > 0.0 { largest.min((STRETCHED / most).sqrt().sqrt()) } else { largest }
    }

    /// Changes of coordinates up to `largest`, over the system's size or rad, of which forces are smooth functions: dry
    /// friction turns from sticking to sliding within its elastic way.
    pub fn smooth_reach(&self, largest: f64) -> f64 {
        let ways = self.springs.iter().filter_map(|spring| {
            let dry = spring.law.as_ref()?.dry().filter(|dry| dry.limit > 0.0)?;
            let measure = self.relative_coordinates[spring.coordinate].measure;
            let is_angle = matches!(measure, Measure::Angle(_) | Measure::Rotation(_));
            Some(if is_angle { dry.largest } else { dry.largest / self.size })
        });
        let contacts = self.contacts.iter().filter_map(|contact| {
            let friction = contact.friction.filter(|own| own.coefficient > 0.0)?;
            // Nobody knows yet how far it will be pressed in.
            let pressed = PRESSED * contact.surface.shape.radius().min(self.size);
            Some(friction.coefficient * contact.law.stiffness / friction.stiffness * pressed / self.size)
        });
        ways.chain(contacts).fold(largest, |reach, way| reach.min(SMOOTH_SHARE * way))
    }
}
