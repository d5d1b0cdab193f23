//! Names in a picture: each near its point, where it covers least; none over another one.

use super::sheet::Sheet;

/// Where a name may stand near its point, best first: directions on paper, and gaps in pixels.
const DIRECTIONS: [[f64; 2]; 8] =
    [[0.0, 1.0], [0.7, 0.8], [0.7, -0.8], [0.0, -1.0], [-0.7, 0.8], [-0.7, -0.8], [1.0, 0.0], [-1.0, 0.0]];
const DISTANCES: [f64; 5] = [10.0, 18.0, 28.0, 40.0, 52.0];
/// Names that are written: for more there is no room.
const MOST_NAMES: usize = 150;
/// Copies of one thing that have a name each; of more the first name stands for all of them.
const MOST_COPIES: usize = 4;
/// Distance of the points that stand for a line, pixels.
pub const GRAIN: f64 = 5.0;
/// Points that stand for a line, at most: it crosses the page with fewer.
const MOST_GRAINS: f64 = 1000.0;
/// Mean width and height of a letter, pixels.
const LETTER: [f64; 2] = [8.4, 15.0];
/// Room around a name, pixels.
const GAP: f64 = 3.0;

/// A name of something that is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Name {
    /// What is written.
    pub text: String,
    /// The point that it belongs to; when it is placed, its own middle.
    pub at: [f64; 2],
    /// Its color, which tells what it names.
    pub color: &'static str,
}

/// The names of a picture, and what they must not cover.
#[derive(Debug, Default)]
pub struct Names {
    names: Vec<Name>,
    /// The lines, as points that are close enough to each other.
    occupied: Vec<[f64; 2]>,
}

impl Names {
    /// Adds a name, unless it is empty.
    pub fn add(&mut self, name: &str, at: [f64; 2], color: &'static str) {
        if !name.is_empty() {
            self.names.push(Name { text: name.to_owned(), at, color });
        }
    }

    /// Marks a line that names should not cover.
    pub fn occupy(&mut self, from: [f64; 2], to: [f64; 2]) {
        let steps = ((to[0] - from[0]).hypot(to[1] - from[1]) / GRAIN).ceil().clamp(1.0, MOST_GRAINS);
        for k in 0..=steps as usize {
            self.occupied.push([0, 1].map(|i| from[i] + (to[i] - from[i]) * k as f64 / steps));
        }
    }

    /// The names where they are written, without those for which there is no room.
    pub fn placed(&self, sheet: &Sheet) -> Vec<Name> {
        let mut placed: Vec<(Name, [f64; 2])> = Vec::new();
        for name in self.without_copies().into_iter().take(MOST_NAMES) {
            let half = [0.5 * LETTER[0] * name.text.chars().count() as f64, 0.5 * LETTER[1]];
            let places = DISTANCES.iter().flat_map(|distance| {
                DIRECTIONS.iter().map(move |[right, up]| {
                    [name.at[0] + right * (half[0] + distance), name.at[1] - up * (half[1] + distance)]
                })
            });
            let (width, height) = (sheet.width, sheet.height);
            let cost = |at: &[f64; 2]| {
                let inside = at[0] > half[0] && at[0] < width - half[0] && at[1] > half[1] && at[1] < height - half[1];
                let is_over = |other: [f64; 2], size: [f64; 2]| {
                    [0, 1].iter().all(|&i| (other[i] - at[i]).abs() < half[i] + size[i] + GAP)
                };
                let names = placed.iter().filter(|(other, size)| is_over(other.at, *size)).count();
                let points = self.occupied.iter().filter(|point| is_over(**point, [0.0; 2])).count();
                (!inside, names, points)
            };
            let best = places.map(|at| (cost(&at), at)).min_by_key(|(cost, _)| *cost);
            if let Some(((_, 0, _), at)) = best {
                placed.push((Name { at, ..name }, half));
            }
        }
        placed.into_iter().map(|(name, _)| name).collect()
    }

    /// The names; of many copies of one thing the first one and the last one, in one.
    fn without_copies(&self) -> Vec<Name> {
        let stem =
            |name: &Name| name.text.trim_end_matches(|letter: char| letter.is_ascii_digit() || letter == '_').len();
        let levels = |name: &Name| name.text[stem(name)..].matches('_').count();
        let mut kept: Vec<Name> = Vec::new();
        for (place, name) in self.names.iter().enumerate() {
            let length = stem(name);
            let is_copy = |other: &&Name| {
                [name, other].iter().all(|one| one.text.len() > length)
                    && other.color == name.color
                    && stem(other) == length
                    && levels(other) == levels(name)
                    && other.text[..length] == name.text[..length]
            };
            let copies = || self.names.iter().filter(is_copy);
            if copies().count() <= MOST_COPIES {
                kept.push(name.clone());
            } else if self.names[..place].iter().find(is_copy).is_none()
                && let Some(last) = copies().next_back()
            {
                kept.push(Name { text: format!("{} \u{2026} {}", name.text, last.text), ..name.clone() });
            }
        }
        kept
    }
}

#[cfg(test)]
mod tests {
    use super::super::sheet::PAGE;
    use super::*;

    /// Names at one point stand around it, none over another one; those for which there is no room are left out.
    #[test]
    fn names_do_not_pile_up() {
        let mut names = Names::default();
        (0..200).for_each(|k| names.add(&format!("name{k}x"), [480.0, 320.0], "black"));
        let placed = names.placed(&PAGE);
        assert!((10..150).contains(&placed.len()), "{}", placed.len());
        for (k, a) in placed.iter().enumerate() {
            for b in &placed[..k] {
                let apart = (a.at[1] - b.at[1]).abs() >= LETTER[1] || (a.at[0] - b.at[0]).abs() >= 6.0 * LETTER[0];
                assert!(apart, "{a:?} {b:?}");
            }
        }
    }

    /// Of many copies one name is written; few have their own, and so has what is called by another word.
    #[test]
    fn copies_share_a_name() {
        let mut names = Names::default();
        for k in 1..=9 {
            names.add(&format!("spoke_{k}"), [0.0, 10.0 * f64::from(k)], "pink");
            names.add(&format!("hub_{k}"), [300.0, 10.0 * f64::from(k)], if k < 4 { "blue" } else { "black" });
        }
        names.add("spoke", [0.0; 2], "pink");
        names.add("spoke1", [0.0; 2], "pink");
        let texts: Vec<String> = names.without_copies().into_iter().map(|name| name.text).collect();
        assert_eq!(
            texts,
            ["spoke_1 \u{2026} spoke_9", "hub_1", "hub_2", "hub_3", "hub_4 \u{2026} hub_9", "spoke", "spoke1"]
        );
    }
}
