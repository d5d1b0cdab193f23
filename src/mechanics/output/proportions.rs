//! Meshes that double precision or beam theory cannot follow: elements far shorter than their neighbors, or than their section is thick.

use crate::mechanics::beam::Beam;
use crate::mechanics::system::System;

/// An element below this share of the longest one of its beam has a bending stiffness, `E I/l³`, that hides the others' in double precision.
const UNEQUAL: f64 = 1e-3;

/// An element shorter than this share of its section's radius of gyration is finer than beam theory resolves.
const FINE: f64 = 0.02;

impl System {
    /// The shortest and the longest element of a beam: number in the beam, and length, m.
    fn extreme_elements(&self, beam: &Beam) -> [(usize, f64); 2] {
        let lengths = self.mesh.elements[beam.element_range()].iter().map(|element| element.length()).enumerate();
        let first = (0, self.mesh.elements[beam.first_element].length());
        lengths.fold([first; 2], |[shortest, longest], own| {
            [if own.1 < shortest.1 { own } else { shortest }, if own.1 > longest.1 { own } else { longest }]
        })
    }

    /// The element far shorter than the others of the beam that coordinate `index` belongs to, in words, if there is one.
    pub fn too_short_element(&self, index: usize) -> Option<String> {
        let node = (index < self.mesh.coordinates()).then(|| self.mesh.node_of(index))?;
        let beam = self.beams.iter().find(|beam| beam.node_range().contains(&node))?;
        let [(element, shortest), (_, longest)] = self.extreme_elements(beam);
        (shortest < UNEQUAL * longest)
            .then(|| format!("element {element} of {}, {:.1e} of the longest one,", beam.name, shortest / longest))
    }

    /// The beams whose elements are finer than beam theory resolves, each as a sentence: they take time, and come near to round-off.
    pub fn too_fine_meshes(&self) -> Vec<String> {
        let fine = self.beams.iter().filter_map(|beam| {
            let [_, (_, longest)] = self.extreme_elements(beam);
            let share = longest / beam.section.gyration();
            (share < FINE).then(|| {
                let enough = (beam.elements() as f64 * share / (5.0 * FINE)).ceil().max(1.0);
                format!(
                    "the elements of {} are at most {longest:.1e} m long, 1/{:.0} of the radius of gyration of its section: finer than beam theory \
                     resolves, slow, and near to round-off; {enough} elements are enough",
                    beam.name,
                    1.0 / share
                )
            })
        });
        fine.collect()
    }
}
