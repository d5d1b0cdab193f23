//! A column of results as its plot needs it: of many rows the lowest and the highest value in each interval of time.

/// A time, s, and a value.
pub type Point = (f64, f64);

/// A curve over time, in bounded memory.
#[derive(Clone, Debug)]
pub struct Trace {
    /// Intervals that are kept at most, an even number.
    room: usize,
    /// Rows in an interval, and in the last one so far.
    rows: u64,
    filled: u64,
    /// The lowest and the highest point of each interval.
    intervals: Vec<[Point; 2]>,
    ends: Option<[Point; 2]>,
}

impl Trace {
    /// An empty curve of at most `room` intervals, an even number.
    pub fn new(room: usize) -> Self {
        Self { room, rows: 1, filled: 0, intervals: Vec::new(), ends: None }
    }

    /// Adds a point later than all others; of a value that is not finite there is none.
    pub fn push(&mut self, time: f64, value: f64) {
        if !value.is_finite() {
            return;
        }
        let point = (time, value);
        self.ends = Some([self.ends.map_or(point, |[first, _]| first), point]);
        if let Some([low, high]) = self.intervals.last_mut()
            && self.filled < self.rows
        {
            *low = if value < low.1 { point } else { *low };
            *high = if value > high.1 { point } else { *high };
            self.filled += 1;
            return;
        }
        if self.intervals.len() == self.room {
            self.coarsen();
        }
        self.intervals.push([point; 2]);
        self.filled = 1;
    }

    /// Makes one interval of two.
    fn coarsen(&mut self) {
        let merged = self.intervals.chunks(2).map(|pair| {
            let (first, last) = (pair[0], pair[pair.len() - 1]);
            let low = if last[0].1 < first[0].1 { last[0] } else { first[0] };
            let high = if last[1].1 > first[1].1 { last[1] } else { first[1] };
            [low, high]
        });
        self.intervals = merged.collect();
        self.rows *= 2;
    }

    /// The lowest and the highest point, the first of each where there are several; none of an empty curve.
    pub fn extremes(&self) -> Option<[Point; 2]> {
        self.intervals.iter().copied().reduce(|[low, high], [lower, higher]| {
            [if lower.1 < low.1 { lower } else { low }, if higher.1 > high.1 { higher } else { high }]
        })
    }

    /// The points in their order, the first and the last one of all included.
    pub fn points(&self) -> Vec<Point> {
        let Some([first, last]) = self.ends else { return Vec::new() };
        let inner = self.intervals.iter().flat_map(|[a, b]| if a.0 <= b.0 { [*a, *b] } else { [*b, *a] });
        let mut points: Vec<Point> = std::iter::once(first).chain(inner).chain([last]).collect();
        points.dedup_by_key(|point| point.0);
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Few rows are all kept; of many, both ends and every peak, in the order of time and in bounded memory.
    #[test]
    fn peaks_and_ends_are_kept() {
        for count in [1, 2, 7, 8, 9, 1000, 100_000] {
            let mut trace = Trace::new(8);
            let peak = count / 3;
            (0..count).for_each(|k| trace.push(f64::from(k), if k == peak { 7.0 } else { 0.1 * f64::from(k % 2) }));
            let points = trace.points();
            assert!(trace.intervals.len() <= 8);
            assert!(points.windows(2).all(|pair| pair[0].0 < pair[1].0), "{points:?}");
            assert!(points.contains(&(f64::from(peak), 7.0)), "{count}: {points:?}");
            let first_low = if peak == 0 { f64::from(count.min(3) - 1) } else { 0.0 };
            let [low, high] = trace.extremes().unwrap();
            assert_eq!((low.0, high), (first_low, (f64::from(peak), 7.0)), "{count}");
            assert_eq!((points[0].0, points[points.len() - 1].0), (0.0, f64::from(count - 1)));
            assert!(count > 8 || points.len() == count as usize);
        }
    }
}
