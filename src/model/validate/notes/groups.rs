//! Things in groups of what is connected.

/// The numbers 0 to n - 1 in groups.
pub struct Groups {
    /// For each thing the next one on the way to the first of its group.
    parents: Vec<usize>,
}

impl Groups {
    /// `count` things, of which each of `pairs` connects two.
    pub fn new(count: usize, pairs: impl IntoIterator<Item = (usize, usize)>) -> Self {
        let mut groups = Self { parents: (0..count).collect() };
        for (a, b) in pairs {
            let (a, b) = (groups.first(a), groups.first(b));
            groups.parents[a.max(b)] = a.min(b);
        }
        groups
    }

    /// The first thing of the group of `thing`.
    pub fn first(&self, mut thing: usize) -> usize {
        while self.parents[thing] != thing {
            thing = self.parents[thing];
        }
        thing
    }

    /// Whether two things are in one group.
    pub fn are_connected(&self, a: usize, b: usize) -> bool {
        self.first(a) == self.first(b)
    }
}
