//! Irregular seas: components of the spectra of Pierson and Moskowitz and of JONSWAP.
//!
//! Every component has the same share of the energy. Its frequency is drawn within the range that has this share, so
//! that the sea never repeats itself, and its phase at random; both by splitmix64, which gives the same numbers on
//! every platform.

use crate::math::elementary::{exp, pow};
use std::f64::consts::TAU;

/// The range of frequencies, as multiples of that of the peak.
const RANGE: [f64; 2] = [0.2, 10.0];
/// Intervals of the range, of equal ratios, over which the energy is summed.
const INTERVALS: usize = 4000;

/// `S(f)` of JONSWAP but for its size, at the frequency `ratio` over that of the peak; a peakedness of 1 is Pierson and
/// Moskowitz's.
fn shape(ratio: f64, peakedness: f64) -> f64 {
    let width = if ratio <= 1.0 { 0.07 } else { 0.09 };
    let nearness = exp(-(ratio - 1.0).powi(2) / (2.0 * width * width));
    ratio.powi(-5) * exp(-1.25 * ratio.powi(-4)) * pow(peakedness, nearness)
}

/// Frequencies over that of the peak, with the energy up to each.
fn energies(peakedness: f64) -> Vec<[f64; 2]> {
    let [from, to] = RANGE;
    let at = |number: usize| from * pow(to / from, number as f64 / INTERVALS as f64);
    let (mut sum, mut list) = (0.0, vec![[from, 0.0]]);
    for number in 0..INTERVALS {
        let [first, last] = [at(number), at(number + 1)];
        let ends = shape(first, peakedness) + shape(last, peakedness);
        sum += (last - first) / 6.0 * (ends + 4.0 * shape(0.5 * (first + last), peakedness));
        list.push([last, sum]);
    }
    list
}

/// The spectral density at the frequency `frequency`, Hz, of a sea of the significant height `height`, m, m²/Hz.
pub fn density(frequency: f64, height: f64, peak_period: f64, peakedness: f64) -> f64 {
    let whole = energies(peakedness)[INTERVALS][1];
    height * height / 16.0 * peak_period * shape(frequency * peak_period, peakedness) / whole
}

/// `count` components of a sea, each its amplitude, m, its angular frequency, rad/s, and its phase, rad.
pub fn components(height: f64, peak_period: f64, peakedness: f64, count: usize, seed: u64) -> Vec<[f64; 3]> {
    let list = energies(peakedness);
    let whole = list[INTERVALS][1];
    let (mut random, amplitude) = (SplitMix(seed), height * (0.125 / count as f64).sqrt());
    let component = |number: usize| {
        let energy = whole * (number as f64 + random.next()) / count as f64;
        let index = list.partition_point(|[_, sum]| *sum <= energy).clamp(1, INTERVALS);
        let [[first, below], [last, above]] = [list[index - 1], list[index]];
        let ratio = first + (last - first) * (energy - below) / (above - below).max(f64::MIN_POSITIVE);
        [amplitude, TAU * ratio / peak_period, TAU * random.next()]
    };
    (0..count).map(component).collect()
}

/// The generator splitmix64 (Steele, Lea, Flood 2014).
struct SplitMix(u64);

impl SplitMix {
    /// The next number, 0 up to 1.
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        // The upper 53 bits, as many as a double has.
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first outputs of splitmix64 from 0, 16294208416658607535 and 7960286522194355700, and nothing else on any
    /// platform.
    #[test]
    fn the_generator() {
        let mut random = SplitMix(0);
        assert_eq!(random.next(), (16_294_208_416_658_607_535_u64 >> 11) as f64 / (1_u64 << 53) as f64);
        assert_eq!(random.next(), (7_960_286_522_194_355_700_u64 >> 11) as f64 / (1_u64 << 53) as f64);
    }

    /// Significant height 6 m, peak period 10 s, peakedness 3.3: the density at the peak by quadrature, and the mean
    /// period of zero crossings, 7.812 s, which the single component of the tail makes uncertain by 2 %.
    #[test]
    fn a_sea_of_jonswap() {
        assert!((density(0.1, 6.0, 10.0, 3.3) - 69.755_543).abs() < 1e-4);
        let sea = components(6.0, 10.0, 3.3, 200, 1);
        let moment = |power: i32| -> f64 { sea.iter().map(|[a, w, _]| 0.5 * a * a * (w / TAU).powi(power)).sum() };
        assert!((4.0 * moment(0).sqrt() - 6.0).abs() < 1e-12);
        assert!(((moment(0) / moment(2)).sqrt() / 7.812_470 - 1.0).abs() < 0.02);
        assert_eq!(sea, components(6.0, 10.0, 3.3, 200, 1));
        assert_ne!(sea, components(6.0, 10.0, 3.3, 200, 2));
    }
}
