//! Orders of elimination that keep factors sparse.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;

/// An order in which to eliminate the vertices of a graph, given by the neighbors of each, so that few new neighbors
/// come up: the approximate minimum degree. None for want of memory.
pub fn minimum_degree(neighbors: &[Vec<usize>]) -> Option<Vec<usize>> {
    let count = neighbors.len();
    let mut starts = vec![0];
    starts.extend(neighbors.iter().scan(0, |sum, list| {
        *sum += list.len();
        Some(*sum)
    }));
    let list: Vec<usize> = neighbors.concat();
    let pattern = SymbolicSparseColMatRef::new_checked(count, count, &starts, None, &list);
    let mut memory = MemBuffer::try_new(amd::order_scratch::<usize>(count, list.len())).ok()?;
    let (mut order, mut places) = (vec![0; count], vec![0; count]);
    let stack = MemStack::new(&mut memory);
    amd::order(&mut order, &mut places, pattern, amd::Control::default(), stack).ok()?;
    Some(order)
}
