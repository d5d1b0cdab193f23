//! Where the ends of a beam's elements are, in fractions of its undeformed arc length.

/// How near to a node a position of a beam must be to be that node, in elements.
const AT_NODE: f64 = 1e-9;

/// How a beam is divided into elements. Ends of elements are counted from 0 at its start.
#[derive(Clone, Debug, PartialEq)]
pub enum Division {
    /// Into so many elements of equal length.
    Equal(usize),
    /// At these fractions, from 0 to 1.
    Graded(Vec<f64>),
}

impl Division {
    /// Into elements of the given lengths, m.
    pub fn graded(lengths: &[f64]) -> Self {
        let whole: f64 = lengths.iter().sum();
        let mut sum = 0.0;
        let inner = lengths[..lengths.len() - 1].iter().map(|length| {
            sum += length;
            sum / whole
        });
        Self::Graded([0.0].into_iter().chain(inner).chain([1.0]).collect())
    }

    /// Number of elements.
    pub fn elements(&self) -> usize {
        match self {
            Self::Equal(count) => *count,
            Self::Graded(fractions) => fractions.len() - 1,
        }
    }

    /// The fraction at which end `end` is; none: there are fewer.
    pub fn fraction(&self, end: usize) -> Option<f64> {
        match self {
            Self::Equal(count) => (end <= *count).then(|| end as f64 / *count as f64),
            Self::Graded(fractions) => fractions.get(end).copied(),
        }
    }

    /// The element that holds a fraction, 0 to 1, and the position in it, 0 to 1.
    pub fn place(&self, fraction: f64) -> (usize, f64) {
        match self {
            Self::Equal(count) => {
                let place = fraction * *count as f64;
                let element = (place.floor() as usize).min(count - 1);
                (element, place - element as f64)
            }
            Self::Graded(fractions) => {
                let element = fractions.partition_point(|end| *end <= fraction).clamp(1, fractions.len() - 1) - 1;
                let [begin, end] = [fractions[element], fractions[element + 1]];
                (element, (fraction - begin) / (end - begin))
            }
        }
    }

    /// The end of an element at a fraction, if there is one.
    pub fn end_at(&self, fraction: f64) -> Option<usize> {
        let (element, xi) = self.place(fraction);
        if xi.abs() <= AT_NODE { Some(element) } else { ((xi - 1.0).abs() <= AT_NODE).then_some(element + 1) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Equal lengths must be the same division, written either way; a fraction is a node to 1e-9 of an element.
    #[test]
    fn divisions_agree() {
        let graded = Division::graded(&[0.5; 4]);
        for division in [&Division::Equal(4), &graded] {
            assert_eq!((division.elements(), division.fraction(3), division.fraction(5)), (4, Some(0.75), None));
            assert_eq!(division.place(0.3125), (1, 0.25));
            assert_eq!((division.place(1.0), division.place(0.0)), ((3, 1.0), (0, 0.0)));
            let at = [0.0, 0.25, 0.25 + 1e-10, 0.5 - 1e-10, 0.25 + 1e-9, 1.0].map(|fraction| division.end_at(fraction));
            assert_eq!(at, [Some(0), Some(1), Some(1), Some(2), None, Some(4)]);
        }
        let uneven = Division::graded(&[1.0, 3.0, 4.0]);
        assert_eq!(uneven, Division::Graded(vec![0.0, 0.125, 0.5, 1.0]));
        assert_eq!((uneven.place(0.25), uneven.end_at(0.5)), ((1, 1.0 / 3.0), Some(2)));
    }
}
