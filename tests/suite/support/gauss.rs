//! Gauss-Legendre rules of any number of points, for integrals that tests write a second time.

/// Points and weights on [0, 1]: zeros of the Legendre polynomial by Newton's iteration, from the known first guess.
pub fn gauss(count: usize) -> Vec<(f64, f64)> {
    let legendre = |x: f64| {
        let (mut last, mut here) = (1.0, x);
        for n in 1..count {
            let n = n as f64;
            (last, here) = (here, ((2.0 * n + 1.0) * x * here - n * last) / (n + 1.0));
        }
        (here, count as f64 * (x * here - last) / (x * x - 1.0))
    };
    (1..=count)
        .map(|number| {
            let mut x = -(std::f64::consts::PI * (number as f64 - 0.25) / (count as f64 + 0.5)).cos();
            for _ in 0..10 {
                let (value, slope) = legendre(x);
                x -= value / slope;
            }
            (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * legendre(x).1.powi(2)))
        })
        .collect()
}

/// `n` points integrate powers up to `2 n - 1` exactly and not the next; the tolerance is rounding.
#[test]
fn powers_are_integrated() {
    for count in 1..=6 {
        let integral = |power: i32| gauss(count).iter().map(|(x, weight)| weight * x.powi(power)).sum::<f64>();
        let error = |power: i32| (integral(power) - 1.0 / f64::from(power + 1)).abs();
        let highest = 2 * count as i32 - 1;
        assert!((0..=highest).all(|power| error(power) < 1e-14), "{count}");
        assert!(error(highest + 1) > 1e-8, "{count}");
    }
}
