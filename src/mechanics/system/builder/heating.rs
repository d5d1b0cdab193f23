//! Adds temperatures of beams.

use super::SystemBuilder;
use crate::mechanics::beam::ancf14::natural::Heating;
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::input::heat::Heat;
use crate::mechanics::input::heat_guide::HeatGuide;

impl SystemBuilder {
    /// A temperature that a host gives, `start` at the start.
    pub fn hosted_heat(&mut self, start: Heat) -> HeatGuide {
        self.targets.heats.push(start);
        HeatGuide::Host(self.targets.heats.len() - 1)
    }

    /// Lets `guides`, one for all elements or one for each, act on beam `beam`, of ANCF14, whose material expands by
    /// `expansion`, 1/K.
    pub fn heat(&mut self, beam: usize, guides: Vec<HeatGuide>, expansion: f64) {
        let first = self.system.heats.len();
        let elements = self.system.beams[beam].element_range();
        let (count, all) = (guides.len(), elements.len());
        assert!(count == 1 || count == all, "one temperature for the beam, or one for each element");
        self.prescribed.heats.extend(guides.iter().map(|guide| guide.start(self.start, &self.targets)));
        self.system.heats.extend(guides);
        for (place, element) in self.system.mesh.elements[elements].iter_mut().enumerate() {
            if let AnyElement::Ancf14(element) = element {
                element.heating = Some(Heating { number: first + place * count / all, expansion });
            }
        }
    }
}
