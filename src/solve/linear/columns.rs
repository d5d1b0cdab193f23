//! The pattern of a sparse matrix in compressed columns.

/// Entries of a square sparse matrix, sorted by columns and rows, each once.
pub(super) struct Columns {
    pub column_starts: Vec<usize>,
    pub rows: Vec<usize>,
    /// Where each of the given entries went.
    pub scatter: Vec<usize>,
}

impl Columns {
    /// Of `size` columns; `places` are column and row of each entry, in any order and number.
    pub fn new(size: usize, places: &[(usize, usize)]) -> Self {
        let mut starts = vec![0; size + 1];
        places.iter().for_each(|(column, _)| starts[column + 1] += 1);
        (0..size).for_each(|column| starts[column + 1] += starts[column]);
        let (mut next, mut by_column) = (starts.clone(), vec![0; places.len()]);
        for (number, (column, _)) in places.iter().enumerate() {
            by_column[next[*column]] = number;
            next[*column] += 1;
        }
        let (mut column_starts, mut rows, mut scatter) = (vec![0], Vec::new(), vec![0; places.len()]);
        // Of each row, the last column that had it, and where.
        let mut last = vec![(size, 0); size];
        for column in 0..size {
            let (own, first) = (&by_column[starts[column]..starts[column + 1]], rows.len());
            for (_, row) in own.iter().map(|number| places[*number]) {
                if last[row].0 != column {
                    last[row].0 = column;
                    rows.push(row);
                }
            }
            rows[first..].sort_unstable();
            (first..rows.len()).for_each(|place| last[rows[place]].1 = place);
            own.iter().for_each(|number| scatter[*number] = last[places[*number].1].1);
            column_starts.push(rows.len());
        }
        Self { column_starts, rows, scatter }
    }
}
