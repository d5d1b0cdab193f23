//! The way of a load that moves along a beam.

use crate::mechanics::beam::division::Division;
use crate::mechanics::beam::mesh::Mesh;
use crate::mechanics::input::signal::Signal;
use crate::mechanics::marker::Marker;
use std::ops::Range;

/// Where on a beam a load is, as a function of time. Off the ends of the beam it acts on nothing.
#[derive(Clone, Debug)]
pub struct Track {
    /// The first element of the beam.
    pub first_element: usize,
    /// How the beam is divided into elements.
    pub division: Division,
    /// The station: a fraction of the beam's undeformed length.
    pub station: Signal,
    /// Not negative while the load is on the beam: steps end where it comes or goes.
    pub presence: Signal,
}

impl Track {
    /// The elements of the beam, by their numbers.
    pub fn elements(&self) -> Range<usize> {
        self.first_element..self.first_element + self.division.elements()
    }

    /// The station at `time` (s), and whether the load is on the beam there. Off the beam it is that of the nearer end.
    /// A station that is not a number is taken for one on the beam: the forces show it then.
    pub fn at(&self, time: f64) -> (f64, bool) {
        let station = self.station.at(time);
        (station.clamp(0.0, 1.0), station.is_nan() || self.presence.at(time) >= 0.0)
    }

    /// The section at a station, 0 to 1.
    pub fn marker(&self, station: f64) -> Marker {
        let (element, xi) = self.division.place(station);
        Marker::section(self.first_element + element, xi)
    }

    /// A section of every element, for what depends on all places that the load may come to.
    pub fn markers(&self, mesh: &Mesh) -> Vec<Marker> {
        debug_assert!(self.elements().end <= mesh.elements.len());
        self.elements().map(|element| Marker::section(element, 0.0)).collect()
    }
}
