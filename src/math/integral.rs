//! Integrals to round-off: Gauss' and Kronrod's rules of 7 and 15 points on intervals that are halved where the two
//! differ.

/// Positions of Kronrod's 15 points in [-1, 1], from the outermost to the middle; every second one is Gauss'.
const PLACES: [f64; 8] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_4,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_5,
    0.0,
];
/// Kronrod's weights.
const KRONROD: [f64; 8] = [
    0.022_935_322_010_529_22,
    0.063_092_092_629_978_55,
    0.104_790_010_322_250_18,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_4,
    0.204_432_940_075_298_9,
    0.209_482_141_084_727_82,
];
/// Gauss' weights, of every second position.
const GAUSS: [f64; 4] =
    [0.129_484_966_168_869_7, 0.279_705_391_489_276_67, 0.381_830_050_505_118_9, 0.417_959_183_673_469_4];
/// For every position, what the values at minus it and at it add to the polynomial through all 15 values at 1.
const AT_END: [[f64; 2]; 8] = [
    [0.006_238_528_645_340_283, 1.453_983_731_103_312_4],
    [-0.018_451_577_046_963_43, -0.706_673_993_404_573_8],
    [0.030_438_309_530_367_934, 0.420_047_199_720_882_9],
    [-0.043_250_815_978_173_98, -0.291_418_695_919_990_6],
    [0.057_719_118_618_911_436, 0.221_175_970_224_892_72],
    [-0.073_778_979_644_262_46, -0.174_570_351_562_241_32],
    [0.091_687_296_848_570_96, 0.139_783_431_782_908_36],
    [-0.112_929_172_918_981_48, 0.0],
];
/// How much of half an interval lies between its outermost position and its end, where the rules see nothing.
const UNSEEN: f64 = 1.0 - PLACES[0];
/// Intervals at most: more than a jump on every side needs; what oscillates faster than that is not resolved by any
/// step.
const MOST_INTERVALS: u32 = 2_000;
/// Halvings at most: an interval of this share of the whole holds a jump of the function to round-off.
const DEEPEST: u32 = 52;
/// The rules agree if they differ by less than this share of the integral of the function's size.
const AGREEMENT: f64 = 1e-14;

/// `∫ f` from `from` to `to`, jumps of `f` included. Not-a-number where `f` is.
pub fn integral(f: &impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    integral_within(f, from, to, 0.0)
}

/// `∫ f` as above; the rules need not agree further than to `error`: the round-off of an `f` whose terms cancel is not
/// pursued.
pub fn integral_within(f: &impl Fn(f64) -> f64, from: f64, to: f64, error: f64) -> f64 {
    Integral::of(f, from, to, error).value
}

/// `∫ f` as above, also where a kink or a jump lies so near to `from` or `to` that the rules, whose outermost places
/// are inside, do not see it. The rules need not agree further than to `error`, the round-off of an `f` whose terms
/// cancel. At most `most` intervals are halved, a jump takes 52.
pub fn integral_to_ends(f: &impl Fn(f64) -> f64, from: f64, to: f64, error: f64, most: u32) -> f64 {
    let mut sum = Integral { at: from, ..Integral::default() };
    if from == to {
        return 0.0;
    }
    let rules = |f: &_, from, to| rules_to_ends(f, from, to);
    let (value, size, difference) = rules(f, from, to);
    let mut intervals = most;
    let bound = f64::max(AGREEMENT * size, error);
    sum.refined(f, (from, to), (value, difference), bound, 0, (&mut intervals, &rules))
}

/// An integral, and how well it is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Integral {
    /// Its value.
    pub value: f64,
    /// By how much the rules differ where no halving helped: a pole, or oscillations without end.
    pub missed: f64,
    /// Where they differ most.
    pub at: f64,
    /// By how much they do there.
    pub most: f64,
}

impl Integral {
    /// `∫ f`; the rules need not agree further than to `error`.
    pub fn of(f: &impl Fn(f64) -> f64, from: f64, to: f64, error: f64) -> Self {
        let mut sum = Self { at: from, ..Self::default() };
        if from != to {
            let (value, size, difference) = rules(f, from, to);
            let mut intervals = MOST_INTERVALS;
            let bound = f64::max(AGREEMENT * size, error);
            sum.value = sum.refined(f, (from, to), (value, difference), bound, 0, (&mut intervals, &rules));
        }
        sum
    }

    /// With the next piece.
    pub fn and(self, next: Self) -> Self {
        let worst = if next.most > self.most { next } else { self };
        Self { value: self.value + next.value, missed: self.missed + next.missed, ..worst }
    }

    /// The integral over an interval; what is missed of it is noted.
    fn refined<F: Fn(f64) -> f64>(
        &mut self,
        f: &F,
        (from, to): (f64, f64),
        (sum, difference): (f64, f64),
        bound: f64,
        depth: u32,
        (intervals, rules): (&mut u32, &impl Fn(&F, f64, f64) -> (f64, f64, f64)),
    ) -> f64 {
        let middle = 0.5 * (from + to);
        if difference <= bound {
            return sum;
        }
        // Not-a-number agrees with nothing, and no halving mends it.
        if depth == DEEPEST || *intervals == 0 || !difference.is_finite() {
            self.missed += difference;
            if difference > self.most {
                (self.most, self.at) = (difference, middle);
            }
            return sum;
        }
        *intervals -= 1;
        [(from, middle), (middle, to)]
            .into_iter()
            .map(|(from, to)| {
                let (sum, _, difference) = rules(f, from, to);
                self.refined(f, (from, to), (sum, difference), bound, depth + 1, (&mut *intervals, rules))
            })
            .sum()
    }
}

/// The values of `f` at the positions of Kronrod's rule, below and above the middle.
fn values(f: &impl Fn(f64) -> f64, from: f64, to: f64) -> [[f64; 2]; 8] {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    PLACES.map(|node| {
        let below = f(middle - half * node);
        [below, if node == 0.0 { below } else { f(middle + half * node) }]
    })
}

/// The integral by Kronrod's rule, that of `|f|`, and how far Gauss' rule is off.
fn rules(f: &impl Fn(f64) -> f64, from: f64, to: f64) -> (f64, f64, f64) {
    sums(&values(f, from, to), 0.5 * (to - from))
}

fn sums(values: &[[f64; 2]; 8], half: f64) -> (f64, f64, f64) {
    let (mut sum, mut size, mut gauss) = (0.0, 0.0, 0.0);
    for (number, (values, weight)) in values.iter().zip(KRONROD).enumerate() {
        // The middle counts once.
        let values = if PLACES[number] == 0.0 { &values[..1] } else { values };
        for value in values {
            sum += weight * value;
            size += weight * value.abs();
            if number % 2 == 1 {
                gauss += GAUSS[number / 2] * value;
            }
        }
    }
    (sum * half, size * half.abs(), ((sum - gauss) * half).abs())
}

/// [`rules`], and by how much more it may be off: where the values at the ends are not those of the polynomial through
/// the others, something happens before them.
fn rules_to_ends(f: &impl Fn(f64) -> f64, from: f64, to: f64) -> (f64, f64, f64) {
    let half = 0.5 * (to - from);
    let values = values(f, from, to);
    let (sum, size, difference) = sums(&values, half);
    let mut ends = [0.0; 2];
    for (values, [below, above]) in values.iter().zip(AT_END) {
        ends[0] += above * values[0] + below * values[1];
        ends[1] += below * values[0] + above * values[1];
    }
    let gap = (f(from) - ends[0]).abs() + (f(to) - ends[1]).abs();
    (sum, size, difference + UNSEEN * half.abs() * gap)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A drive given by its rate must end where the rate's integral says: smooth, kinked and jumping rates, to
    /// round-off.
    #[test]
    fn integrals_are_exact_to_round_off() {
        let close =
            |value: f64, exact: f64| assert!((value - exact).abs() < 1e-14 * (1.0 + exact.abs()), "{value} {exact}");
        close(integral(&|t| t * t * t - 2.0, -1.0, 3.0), 20.0 - 8.0);
        close(integral(&f64::exp, 0.0, 2.0), 2.0_f64.exp() - 1.0);
        close(integral(&|t: f64| (40.0 * t).sin(), 0.0, 1.0), (1.0 - 40.0_f64.cos()) / 40.0);
        close(integral(&|t: f64| (t - 0.3).abs(), 0.0, 1.0), 0.5 * (0.09 + 0.49));
        close(integral(&|t| if t < 0.123 { 2.0 } else { -1.0 }, 0.0, 1.0), 0.246 - 0.877);
        close(integral(&|_| 5.0, 0.25, 0.25), 0.0);
        assert!(integral(&|t: f64| (t - 0.5).sqrt(), 0.0, 1.0).is_nan());
    }

    /// A force law has its kinks anywhere in a step: next to the end of an interval the rules are blind.
    #[test]
    fn kinks_near_ends_are_seen() {
        for gap in [1e-2, 3e-3, 1e-4, 1e-6, 1e-9] {
            let kink = |x: f64| 1.0 + x + 7.0 * (x - (1.0 - gap)).max(0.0);
            let jump = |x: f64| if x < gap { 3.0 } else { 1.0 };
            let exact = [1.5 + 3.5 * gap * gap, 1.0 + 2.0 * gap];
            let found = [integral_to_ends(&kink, 0.0, 1.0, 0.0, 120), integral_to_ends(&jump, 0.0, 1.0, 0.0, 120)];
            assert!((found[0] - exact[0]).abs() < 1e-13 && (found[1] - exact[1]).abs() < 1e-13, "{gap}: {found:?}");
            let smooth = |x: f64| (3.0 * x).exp();
            assert!((integral_to_ends(&smooth, 0.0, gap, 0.0, 120) - (3.0 * gap).exp_m1() / 3.0).abs() < 1e-15);
        }
    }

    /// Where the terms of a law cancel, its round-off is not pursued without end, and its integral is right to that
    /// round-off.
    #[test]
    fn round_off_is_not_pursued() {
        let count = std::cell::Cell::new(0);
        let law = |x: f64| {
            count.set(count.get() + 1);
            1000.0 * (x - 0.1)
        };
        let found = integral_to_ends(&law, 0.1, 0.1 + 1e-9, 0.0, 120);
        // The round-off of 0.1, times the slope and the way.
        assert!((found - 5e-16).abs() < 1e-13 * 1e-9, "{found:e}");
        assert!(count.get() < 10_000, "{}", count.get());
    }

    /// What is no integral must be known as such, and where; a jump or a root at the edge is one.
    #[test]
    fn what_is_missed_is_known() {
        let pole = Integral::of(&|t: f64| (t - 0.3).powi(-2), 0.0, 1.0, 0.0);
        assert!(pole.missed > 0.1 * pole.value && (pole.at - 0.3).abs() < 1e-3, "{pole:?}");
        let wild = Integral::of(&|t: f64| (1e6 * t).cos().abs(), 0.0, 1.0, 0.0);
        assert!(wild.missed > 1e-3, "{wild:?}");
        let jump = Integral::of(&|t: f64| if t < 0.123 { 2.0 } else { -1.0 }, 0.0, 1.0, 0.0);
        assert_eq!(jump.missed, 0.0);
        assert!(Integral::of(&f64::sqrt, 0.0, 1.0, 0.0).missed < 1e-12);
        assert_eq!(jump.and(pole), Integral { value: jump.value + pole.value, ..pole });
    }
}
