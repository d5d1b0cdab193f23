//! Motions that jump inside an expression: `step`, `if`, `floor`, a comparison. Jumps between pieces are told where the
//! run begins.

use super::Note;
use crate::math::range::Range;
use crate::model::expression::function::Function;
use crate::model::file::document::Document;
use crate::model::file::entries::drive::Motion;
use crate::model::file::entries::frame::Orientation;
use crate::model::file::number::Number;

/// Intervals that are searched for a jump, and halvings of each: to round-off of the time.
const INTERVALS: u32 = 1000;
const HALVINGS: usize = 60;
/// A change that halving the interval leaves as it is is a jump; so is one of at least this share of the change.
const LEFT: f64 = 0.5;
/// Jumps below this are round-off, m or rad.
const ROUND_OFF: f64 = 1e-9;

/// Names drives, winches and frames whose motion jumps inside an expression.
pub fn hidden_jumps(document: &Document) -> Vec<Note> {
    let drives = document.motions().filter(|(_, is_input)| !is_input).filter_map(|(motion, _)| match motion {
        Motion::Value(number) => Some(number),
        Motion::Rate(_) => None,
    });
    let frames = document.frames.iter().filter(|frame| !frame.input).flat_map(|frame| match frame.orientation {
        Orientation::Rotation(numbers) => frame.position.into_iter().chain(numbers),
        Orientation::Quaternion(_) => frame.position.into_iter().chain(frame.position),
    });
    let stop = document.value(document.simulation.stop);
    let note = |number: Number| {
        let (time, jump) = jump(&document.function(number), stop)?;
        let text = format!(
            "jumps by {jump:.4} at t = {time:.6} s, which no finite force can do: velocities and efforts mean nothing from there on. Let it move over several steps, with smoothstep(from, to, t)"
        );
        Some(Note::of(document, number, &text))
    };
    drives.chain(frames).filter_map(note).collect()
}

/// The first jump of a function up to `stop`, s, which is not between two of its pieces: when, and by how much.
fn jump(function: &Function, stop: f64) -> Option<(f64, f64)> {
    if function.is_constant() || !function.over(Range { low: 0.0, high: stop }).switches {
        return None;
    }
    let pieces = function.breaks([0.0, stop]);
    let at = |k: u32| stop * f64::from(k) / f64::from(INTERVALS);
    (0..INTERVALS).find_map(|k| {
        let (mut from, mut to) = (at(k), at(k + 1));
        let change = |from: f64, to: f64| (function.value(to) - function.value(from)).abs();
        let whole = change(from, to);
        if whole.is_nan() || whole <= ROUND_OFF {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle = from + 0.5 * (to - from);
            if middle <= from || middle >= to {
                break;
            }
            (from, to) = if change(from, middle) > change(middle, to) { (from, middle) } else { (middle, to) };
            // A smooth change is halved with the interval.
            if change(from, to) <= LEFT * whole {
                return None;
            }
        }
        let jump = change(from, to);
        let is_piece = pieces.iter().any(|piece| (from..=to).contains(piece));
        (jump > LEFT * whole && jump > ROUND_OFF && !is_piece).then_some((to, jump))
    })
}
