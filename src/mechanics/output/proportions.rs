//! Meshes that double precision or beam theory cannot follow: elements far shorter than their neighbors, or than their
//! section is thick.

use crate::mechanics::beam::Beam;
use crate::mechanics::system::System;

/// An element below this share of the longest one of its beam has a bending stiffness, `E I/l³`, that hides the others'
/// in double precision.
const UNEQUAL: f64 = 1e-3;

/// An element shorter than this share of its section's radius of gyration is finer than beam theory resolves.
/// With the integrator `conserving` steps of a motion fail from about here on.
const FINE: f64 = 0.05;
/// Elements of this share of the radius of gyration are short enough.
const ENOUGH: f64 = 0.1;

impl System {
    /// The shortest and the longest element of a beam: number in the beam, and length, m.
    fn extreme_elements(&self, beam: &Beam) -> [(usize, f64); 2] {
        let lengths = self.mesh.elements[beam.element_range()].iter().map(|element| element.length()).enumerate();
        let first = (0, self.mesh.elements[beam.first_element].length());
        lengths.fold([first; 2], |[shortest, longest], own| {
            [if own.1 < shortest.1 { own } else { shortest }, if own.1 > longest.1 { own } else { longest }]
        })
    }

    /// The element far shorter than the others of the beam that coordinate `index` belongs to, in words, if there is
    /// one.
    pub fn too_short_element(&self, index: usize) -> Option<String> {
        let node = (index < self.mesh.coordinates()).then(|| self.mesh.node_of(index))?;
        let beam = self.beams.iter().find(|beam| beam.node_range().contains(&node))?;
        let [(element, shortest), (_, longest)] = self.extreme_elements(beam);
        (shortest < UNEQUAL * longest)
            .then(|| format!("element {element} of {}, {:.1e} of the longest one,", beam.name, shortest / longest))
    }

    /// The beams whose elements are finer than beam theory resolves, each as a sentence: they take time, and come near
    /// to round-off.
    pub fn too_fine_meshes(&self) -> Vec<String> {
        let fine = self.beams.iter().filter_map(|beam| {
            let [_, (_, longest)] = self.extreme_elements(beam);
            let share = longest / beam.section.gyration();
            (share < FINE).then(|| {
                let (name, count) = (&beam.name, beam.elements());
                let enough = (count as f64 * share / ENOUGH).ceil().max(1.0);
                format!(
                    "the {count} elements of {name} are at most {longest:.1e} m long, 1/{:.0} of the radius of gyration \
                     of its section: finer than beam theory resolves, and near to round-off. A step takes {:.0} times as \
                     long as with {enough} elements, which are enough, and steps of a motion fail and are repeated in up \
                     to 1024 parts: set {name}.elements to {enough}",
                    1.0 / share,
                    count as f64 / enough
                )
            })
        });
        fine.collect()
    }
}
