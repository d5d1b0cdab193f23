//! A sparse matrix as a fixed list of dense blocks: what mechanics writes and the linear solver reads.

use std::ops::Range;

/// Where a dense block sits: `rows × columns` from (`row`, `column`) on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block {
    /// First row.
    pub row: usize,
    /// First column.
    pub column: usize,
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
}

/// A sum of dense blocks, which may overlap. Values are column-major within a block, blocks in the order of their
/// pushing.
#[derive(Clone, Debug, Default)]
pub struct Blocks {
    layout: Vec<Block>,
    offsets: Vec<usize>,
    values: Vec<f64>,
    /// Blocks off the diagonal that the next one is the place of the transpose of, and not the transpose itself.
    mirrored: Vec<usize>,
    /// Blocks that are zero most of the time.
    occasional: Range<usize>,
}

impl Blocks {
    /// Adds a block of zeros and returns its number.
    pub fn push(&mut self, block: Block) -> usize {
        self.layout.push(block);
        self.offsets.push(self.values.len());
        self.values.resize(self.values.len() + block.rows * block.columns, 0.0);
        self.layout.len() - 1
    }

    /// Adds a block of zeros, and behind it the position of its transpose, whose values are others:
    /// [`Self::symmetric_part`] takes the mean of both.
    pub fn push_mirrored(&mut self, block: Block) {
        let Block { row, column, rows, columns } = block;
        let number = self.push(block);
        self.push(Block { row: column, column: row, rows: columns, columns: rows });
        self.mirrored.push(number);
    }

    /// Adds a block that is zero most of the time, behind others of this kind.
    pub fn push_occasional(&mut self, block: Block) {
        let number = self.push(block);
        let first = if self.occasional.is_empty() { number } else { self.occasional.start };
        self.occasional = first..number + 1;
    }

    /// The blocks of this kind that are not zero now, by their numbers.
    pub fn awake(&self) -> impl Iterator<Item = usize> + '_ {
        self.occasional.clone().filter(|number| self.block(*number).iter().any(|value| *value != 0.0))
    }

    /// The blocks but for those that are zero now as most of the time, each with the position of its first value.
    pub fn in_use(&self) -> impl Iterator<Item = (usize, &Block)> + '_ {
        let mut awake = self.awake().peekable();
        self.layout.iter().enumerate().filter_map(move |(number, block)| {
            let is_used = !self.occasional.contains(&number) || awake.next_if_eq(&number).is_some();
            is_used.then_some((self.offsets[number], block))
        })
    }

    /// Gives back the memory that further blocks would take.
    pub fn shrink_to_fit(&mut self) {
        self.layout.shrink_to_fit();
        self.offsets.shrink_to_fit();
        self.values.shrink_to_fit();
    }

    /// The blocks in order.
    pub fn layout(&self) -> &[Block] {
        &self.layout
    }

    /// All values, block after block.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The values of block `number`, column-major.
    pub fn block_mut(&mut self, number: usize) -> &mut [f64] {
        let Block { rows, columns, .. } = self.layout[number];
        let start = self.offsets[number];
        &mut self.values[start..start + rows * columns]
    }

    /// The values of block `number`, column-major.
    pub fn block(&self, number: usize) -> &[f64] {
        let Block { rows, columns, .. } = self.layout[number];
        let start = self.offsets[number];
        &self.values[start..start + rows * columns]
    }

    /// Sets all values to zero.
    pub fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// The blocks that lie in the first `size` rows and columns, in their order.
    #[must_use]
    pub fn leading(&self, size: usize) -> Self {
        let mut own = Self::default();
        for (number, block) in self.layout.iter().enumerate() {
            if block.row + block.rows <= size && block.column + block.columns <= size {
                let copy = own.push(*block);
                own.block_mut(copy).copy_from_slice(self.block(number));
            }
        }
        own
    }

    /// The same with the sizes of all values.
    #[must_use]
    pub fn sizes(&self) -> Self {
        let mut own = self.clone();
        own.values.iter_mut().for_each(|value| *value = value.abs());
        own
    }

    /// Sets the blocks that [`Self::leading`] copies to those of such a copy.
    pub fn set_leading(&mut self, size: usize, leading: &Self) {
        let mut copy = 0;
        for number in 0..self.layout.len() {
            let block = self.layout[number];
            if block.row + block.rows <= size && block.column + block.columns <= size {
                self.block_mut(number).copy_from_slice(leading.block(copy));
                copy += 1;
            }
        }
    }

    /// Changes the sign of all values.
    pub fn negate(&mut self) {
        self.values.iter_mut().for_each(|value| *value = -*value);
    }

    /// `target += self · vector`.
    pub fn multiply_add(&self, vector: &[f64], target: &mut [f64]) {
        let mut value = 0;
        for block in &self.layout {
            for column in 0..block.columns {
                let factor = vector[block.column + column];
                for row in 0..block.rows {
                    target[block.row + row] += self.values[value] * factor;
                    value += 1;
                }
            }
        }
    }

    /// The symmetric part: [`Self::symmetrize`].
    #[must_use]
    pub fn symmetric_part(&self) -> Self {
        let mut sum = self.clone();
        sum.symmetrize();
        sum
    }

    /// Becomes its symmetric part, where blocks off the diagonal come in pairs that are each other's transposes, but
    /// for mirrored ones.
    pub fn symmetrize(&mut self) {
        let Self { layout, offsets, values, mirrored, .. } = self;
        let mut set_mean = |own: usize, other: usize| {
            let mean = 0.5 * (values[own] + values[other]);
            (values[own], values[other]) = (mean, mean);
        };
        for (block, start) in layout.iter().zip(&*offsets) {
            if block.row == block.column && block.rows == block.columns {
                for column in 0..block.columns {
                    for row in 0..column {
                        set_mean(start + column * block.rows + row, start + row * block.rows + column);
                    }
                }
            }
        }
        for number in mirrored {
            let Block { rows, columns, .. } = layout[*number];
            let [first, second] = [offsets[*number], offsets[*number + 1]];
            for column in 0..columns {
                for row in 0..rows {
                    set_mean(first + column * rows + row, second + row * columns + column);
                }
            }
        }
    }

    /// `aᵀ self b` of the leading part that the vectors belong to.
    pub fn form(&self, a: &[f64], b: &[f64]) -> f64 {
        self.terms(a, b, |left, value, right| left * value * right)
    }

    /// `|vector|ᵀ |self| |vector|` of the leading part: what the form would be if nothing canceled, the measure of its
    /// round-off.
    pub fn magnitude(&self, vector: &[f64]) -> f64 {
        self.terms(vector, vector, |left, value, right| (left * value * right).abs())
    }

    /// The sum of `term` over all entries of the leading part.
    fn terms(&self, a: &[f64], b: &[f64], term: impl Fn(f64, f64, f64) -> f64) -> f64 {
        let mut sum = 0.0;
        for (block, start) in self.layout.iter().zip(&self.offsets) {
            if block.row + block.rows > a.len() || block.column + block.columns > b.len() {
                continue;
            }
            let values = &self.values[*start..start + block.rows * block.columns];
            for (entry, value) in values.iter().enumerate() {
                sum += term(a[block.row + entry % block.rows], *value, b[block.column + entry / block.rows]);
            }
        }
        sum
    }
}
