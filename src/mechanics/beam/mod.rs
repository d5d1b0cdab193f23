//! Beams: their design, nodes and elements, and the element formulations.

pub mod ancf14;
pub mod ancf24;
pub mod balance;
pub mod centerline;
pub mod configuration;
pub mod design;
pub mod division;
pub mod element;
pub mod line_load;
pub mod material;
pub mod mesh;
pub mod node;
pub mod profile;
pub mod resultants;
pub mod section;
pub mod walls;

use self::division::Division;
use self::profile::Profile;
use self::section::Section;
use std::ops::Range;

/// A beam: a run of nodes and elements.
#[derive(Clone, Debug, PartialEq)]
pub struct Beam {
    /// Name in the model file.
    pub name: String,
    /// Its first node.
    pub first_node: usize,
    /// Its first element.
    pub first_element: usize,
    /// Where the ends of its elements are; a node is at each.
    pub division: Division,
    /// The ends of elements at which two nodes meet that are welded, ascending.
    pub corners: Vec<usize>,
    /// Its section; where it varies that of the start.
    pub section: Section,
    /// The section along it; none where it is the same everywhere.
    pub profile: Option<Profile>,
    /// Damping in proportion to mass: force over mass and velocity, 1/s.
    pub mass_damping: f64,
    /// Young's modulus, Pa.
    pub young: f64,
    /// Twist rate above which its energy has no lower bound, rad/m (MECHANICS, trap 9); infinite where there is none.
    pub twist_limit: f64,
}

impl Beam {
    /// Its section at a fraction of its length, 0 to 1.
    pub fn section_at(&self, fraction: f64) -> Section {
        self.profile.as_ref().map_or(self.section, |profile| profile.at(fraction))
    }

    /// Number of elements.
    pub fn elements(&self) -> usize {
        self.division.elements()
    }

    /// Its elements.
    pub fn element_range(&self) -> Range<usize> {
        self.first_element..self.first_element + self.elements()
    }

    /// Its nodes.
    pub fn node_range(&self) -> Range<usize> {
        self.first_node..self.first_node + self.elements() + 1 + self.corners.len()
    }

    /// The node at end `end` of its elements, counted from 0; at a corner the side towards the start.
    pub fn node(&self, end: usize) -> usize {
        self.first_node + end + self.corners.partition_point(|corner| *corner < end)
    }

    /// The end of its elements, counted from 0, at which `node` is.
    pub fn end_of(&self, node: usize) -> usize {
        let local = node - self.first_node;
        // Corner number k moves all nodes behind its first one by k + 1.
        let corners = self.corners.iter().enumerate().take_while(|(k, corner)| *corner + k < local);
        local - corners.count()
    }

    /// The elements that end and that begin at `node`.
    pub fn elements_at(&self, node: usize) -> [Option<usize>; 2] {
        let end = self.end_of(node);
        let is_corner = self.corners.binary_search(&end).is_ok();
        let before = end > 0 && (!is_corner || node == self.node(end));
        let after = end < self.elements() && (!is_corner || node != self.node(end));
        [before.then(|| self.first_element + end - 1), after.then(|| self.first_element + end)]
    }
}
