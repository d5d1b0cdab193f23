//! Lists of numbers as text: bytes sorted into planes, deflated (zlib), in base64 (docs/viewer/data.md).
//!
//! The deflate of this crate does not look at the processor: the same numbers make the same text everywhere.

use ancf14::model::view::Track;

/// Largest number that a quantized value becomes.
const LAST: f64 = 65535.0;
/// How much is done to make the text short.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// For a file, which is kept and mailed.
    Small,
    /// For a page that is open: it unpacks the text at once and throws it away.
    Soon,
}

impl Effort {
    /// Level of the compression, of 10. Level 8 takes a quarter to a third of the time of the simulation, level 1 a
    /// fifth of that; its text is 15 to 30 % longer.
    fn level(self) -> u8 {
        match self {
            Self::Small => 8,
            Self::Soon => 1,
        }
    }
}

/// Range of each component, and the values as text.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Quantized {
    /// Numbers of each thing.
    pub components: usize,
    /// Number of things.
    pub things: usize,
    /// Lowest and highest value of each component.
    pub ranges: Vec<[f64; 2]>,
    /// The values.
    pub data: String,
}

/// The values of a track, each as one of 65536 steps from the lowest to the highest of its component. Component after
/// component, thing after thing, instant after instant; of these integers differences are taken, twice from instant to
/// instant and twice from thing to thing: motions are smooth, and so are beams.
pub fn quantized(track: &Track, effort: Effort) -> Quantized {
    let Track { components, things, values, .. } = track;
    let width = components * things;
    let instants = values.len().checked_div(width).unwrap_or(0);
    let mut words = Vec::with_capacity(values.len());
    let ranges: Vec<[f64; 2]> = (0..*components).map(|component| range(values, component, *components)).collect();
    for (component, [low, high]) in ranges.iter().enumerate() {
        let span = high - low;
        let word = |instant: usize, thing: usize| -> u16 {
            let value = values[instant * width + thing * components + component];
            if span > 0.0 { (LAST * ((value - low) / span)).round() as u16 } else { 0 }
        };
        let begin = words.len();
        words.extend((0..*things).flat_map(|thing| (0..instants).map(move |instant| word(instant, thing))));
        let own = &mut words[begin..];
        for _ in 0..2 {
            own.chunks_mut(instants.max(1)).for_each(|of_thing| difference(of_thing, 1));
            difference(own, instants);
        }
    }
    let folded = || words.iter().map(|word| zigzag(*word));
    let planes: Vec<u8> = folded().map(|word| (word >> 8) as u8).chain(folded().map(|word| word as u8)).collect();
    Quantized { components: *components, things: *things, ranges, data: packed(&planes, effort) }
}

/// Takes from each number the one `stride` places before it, modulo 65536.
fn difference(words: &mut [u16], stride: usize) {
    for place in (stride..words.len()).rev() {
        words[place] = words[place].wrapping_sub(words[place - stride]);
    }
}

/// Doubles, exactly: each as its bits exclusive-or those before, the bytes of one place after those of another, the
/// highest first.
pub fn doubles(values: &[f64], effort: Effort) -> String {
    let mut before = 0;
    let changes: Vec<u64> = values
        .iter()
        .map(|value| {
            let bits = value.to_bits();
            bits ^ std::mem::replace(&mut before, bits)
        })
        .collect();
    let planes: Vec<u8> =
        (0..8).rev().flat_map(|place| changes.iter().map(move |bits| (bits >> (8 * place)) as u8)).collect();
    packed(&planes, effort)
}

fn range(values: &[f64], component: usize, components: usize) -> [f64; 2] {
    let own = values.iter().skip(component).step_by(components);
    let [low, high] =
        own.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(*value), high.max(*value)]);
    // A difference that overflows has no steps.
    if (high - low).is_finite() { [low, high] } else { [0.0; 2] }
}

/// Small changes of either sign as small numbers.
fn zigzag(change: u16) -> u16 {
    (change << 1) ^ (0_u16.wrapping_sub(change >> 15))
}

/// Bytes as text: deflated, in base64.
pub fn packed(bytes: &[u8], effort: Effort) -> String {
    base64(&miniz_oxide::deflate::compress_to_vec_zlib(bytes, effort.level()))
}

const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// RFC 4648, with padding.
fn base64(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let part = |place: usize| u32::from(chunk.get(place).copied().unwrap_or(0));
        let bits = part(0) << 16 | part(1) << 8 | part(2);
        for place in 0..4 {
            let digit = DIGITS[(bits >> (18 - 6 * place)) as usize & 63];
            text.push(if place > chunk.len() { '=' } else { char::from(digit) });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The examples of RFC 4648.
    #[test]
    fn base64_is_the_standard_one() {
        let texts = ["", "f", "fo", "foo", "foob", "fooba", "foobar"].map(|text| base64(text.as_bytes()));
        assert_eq!(texts, ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"]);
    }

    /// Changes of either sign, the largest too, are small where they are small.
    #[test]
    fn changes_are_folded() {
        let folded = [0_u16, 1, u16::MAX, 2, 0x7fff, 0x8000].map(zigzag);
        assert_eq!(folded, [0, 2, 1, 4, 0xfffe, 0xffff]);
    }

    /// No instant, nothing to show, and values that do not change make no division by zero and no panic.
    #[test]
    fn empty_and_constant_tracks_are_packed() {
        let track =
            |things: usize, values: &[f64]| Track { name: "stress", components: 1, things, values: values.to_vec() };
        let ranges = |track: &Track| quantized(track, Effort::Soon).ranges;
        assert_eq!(ranges(&track(0, &[])), [[0.0, 0.0]]);
        assert_eq!(ranges(&track(2, &[7.0; 6])), [[7.0, 7.0]]);
        assert_eq!(ranges(&track(1, &[-f64::MAX, f64::MAX])), [[0.0, 0.0]]);
    }

    /// Either effort packs the same bytes; the small one makes the shorter text.
    #[test]
    fn efforts_differ_in_length_only() {
        let values: Vec<f64> = (0..5000).map(|k| (0.01 * f64::from(k)).sin()).collect();
        let track = Track { name: "stress", components: 1, things: 5, values };
        let [small, soon] = [Effort::Small, Effort::Soon].map(|effort| quantized(&track, effort).data);
        assert!(small.len() < soon.len(), "{}, {}", small.len(), soon.len());
        let [small, soon] = [small, soon].map(|text| inflated(&text));
        assert!(small == soon && small.len() == 10_000);
    }

    /// The bytes of a text: the other side of `packed`.
    fn inflated(text: &str) -> Vec<u8> {
        let digits: Vec<u32> = text
            .bytes()
            .filter(|digit| *digit != b'=')
            .map(|digit| DIGITS.iter().position(|own| *own == digit).unwrap() as u32)
            .collect();
        let bytes = digits.chunks(4).flat_map(|four| {
            let bits = (0..4).fold(0, |bits, place| bits << 6 | four.get(place).copied().unwrap_or(0));
            bits.to_be_bytes()[1..four.len()].to_vec()
        });
        miniz_oxide::inflate::decompress_to_vec_zlib(&bytes.collect::<Vec<u8>>()).unwrap()
    }

    /// viewer/test/packed.json has what this side writes of given numbers; viewer/test/data.test.ts reads it.
    #[test]
    fn the_other_side_reads_what_is_written() {
        // Two things with two components at three instants: changes of either sign, beyond half of the range too.
        let values = vec![0.0, -5.0, 1.0, 7.0, 0.5, -4.5, 0.25, 5.0, 1.0, 7.0, 0.0, -5.0];
        let numbers = vec![0.1, 1e-300, -0.5, 1.0 / 3.0, 123_456.789, 1e21, 0.0];
        let track = Track { name: "stress", components: 2, things: 2, values: values.clone() };
        let written = serde_json::json!({
            "track": quantized(&track, Effort::Small), "values": values, "doubles": doubles(&numbers, Effort::Small), "numbers": numbers,
        });
        let text = format!("{}\n", serde_json::to_string_pretty(&written).unwrap());
        assert_eq!(text, include_str!("../../../viewer/test/packed.json"), "{text}");
    }
}
