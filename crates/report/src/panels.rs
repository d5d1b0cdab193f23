//! Which curves share a panel of a chart: those whose sizes are alike, so that none looks flat because another one is
//! large.

/// A curve that spans less than this share of the axis looks flat: it gets a panel of its own.
const FLAT: f64 = 0.1;
/// A curve that spans less than this share of the largest value of all is constant but for round-off.
const ROUND_OFF: f64 = 1e-9;

/// Lowest and highest value of a curve.
pub type Span = (f64, f64);

/// The panels, from above: each with the numbers of its curves, in their order. A curve without a span has no points.
pub fn panels(spans: &[Option<Span>]) -> Vec<Vec<usize>> {
    let largest = spans.iter().flatten().map(|(low, high)| low.abs().max(high.abs())).fold(0.0, f64::max);
    let moves = |(low, high): Span| high - low > ROUND_OFF * largest;
    let mut order: Vec<usize> = (0..spans.len()).collect();
    let width = |curve: usize| spans[curve].map_or(0.0, |(low, high)| high - low);
    order.sort_by(|a, b| width(*b).total_cmp(&width(*a)));
    let mut panels: Vec<Vec<usize>> = Vec::new();
    for curve in order {
        let fits = |panel: &Vec<usize>| {
            let together = || panel.iter().chain([&curve]).filter_map(|other| spans[*other]);
            let [low, high] = together().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], (lower, higher)| {
                [low.min(lower), high.max(higher)]
            });
            together().filter(|span| moves(*span)).all(|(lower, higher)| higher - lower >= FLAT * (high - low))
        };
        match panels.iter().position(fits) {
            Some(panel) => panels[panel].push(curve),
            None => panels.push(vec![curve]),
        }
    }
    panels.iter_mut().for_each(|panel| panel.sort_unstable());
    panels.sort_unstable();
    panels
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sag of 0.7 mm is seen next to 5 m of travel; curves that are alike stay together, and zero goes with any of
    /// them.
    #[test]
    fn small_curves_are_not_flat() {
        let of = |spans: &[Span]| panels(&spans.iter().copied().map(Some).collect::<Vec<_>>());
        assert_eq!(of(&[(0.0, 5.0), (0.0, 0.0), (-7e-4, 0.0)]), [vec![0, 1], vec![2]]);
        assert_eq!(of(&[(5.0, 5.0007), (0.0, 0.0), (-7e-4, 0.0)]), [vec![0], vec![1, 2]]);
        assert_eq!(of(&[(0.0, 5.0), (-1.0, 1.0), (2.0, 3.0)]), [vec![0, 1, 2]]);
        assert_eq!(of(&[(0.0, 1e-3), (0.0, 1.0), (0.0, 1e3)]), [vec![0], vec![1], vec![2]]);
        assert_eq!(of(&[(5.0, 5.0), (1.0, 1.0)]), [vec![0, 1]]);
        // Round-off of the large one.
        assert_eq!(of(&[(0.0, 5.0), (-1e-16, 1e-17)]), [vec![0, 1]]);
        assert_eq!(panels(&[None, Some((0.0, 1.0))]), [vec![0, 1]]);
    }
}
