//! The nodes and elements of all beams, and where their coordinates are.

use super::ancf14::coordinates::NODE;
use super::ancf14::frame::NodeFrame;
use super::ancf14::over_step::STRAINS;
use super::element::AnyElement;
use super::node::Node;
use crate::mechanics::geometry::triad::Triad;

/// Nodes and elements.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Nodes of all beams, in their order.
    pub nodes: Vec<Node>,
    /// Elements of all beams, in their order.
    pub elements: Vec<AnyElement>,
    /// First coordinate of each node that has a frame, by the number of the frame.
    pub framed: Vec<usize>,
    /// Number of holonomy angles: elements between nodes that have frames.
    pub branches: usize,
}

impl Mesh {
    /// Gives back the memory that further nodes and elements would take.
    pub fn shrink_to_fit(&mut self) {
        self.nodes.shrink_to_fit();
        self.elements.shrink_to_fit();
        self.framed.shrink_to_fit();
    }

    /// Number of coordinates.
    pub fn coordinates(&self) -> usize {
        self.nodes.last().map_or(0, |node| node.coordinates().end)
    }

    /// Whether the rates of all strains are known: elements of ANCF24 tell none.
    pub fn tells_strain_rates(&self) -> bool {
        self.elements.iter().all(|element| element.ancf14().is_some())
    }

    /// Number of strains of all elements that have a numerical dissipation: ANCF14's.
    pub fn strains(&self) -> usize {
        STRAINS * self.branches
    }

    /// Where the rate of relative coordinate number `coordinate` is among the rates of strains and relative
    /// coordinates.
    pub fn relative_rate_index(&self, coordinate: usize) -> usize {
        self.strains() + coordinate
    }

    /// The number of the node that coordinate `index` belongs to.
    pub fn node_of(&self, index: usize) -> usize {
        self.nodes.partition_point(|node| node.coordinates().end <= index)
    }

    /// Frames at `q` relative to the reference `triads`.
    pub fn set_frames(&self, q: &[f64], triads: &[Triad], frames: &mut Vec<NodeFrame>) {
        frames.resize(self.framed.len(), NodeFrame::default());
        for ((frame, start), triad) in frames.iter_mut().zip(&self.framed).zip(triads) {
            *frame = NodeFrame::new(&q[*start..start + NODE], triad);
        }
    }

    /// Those numbered `numbers` alone.
    pub fn set_frames_of(&self, numbers: &[usize], q: &[f64], triads: &[Triad], frames: &mut Vec<NodeFrame>) {
        frames.resize(self.framed.len(), NodeFrame::default());
        for number in numbers {
            let start = self.framed[*number];
            frames[*number] = NodeFrame::new(&q[start..start + NODE], &triads[*number]);
        }
    }
}
