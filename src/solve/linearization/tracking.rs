//! Modes of systems that differ a little, told apart by their vectors, never by their order: with the left and right
//! vectors `y` and `x` of both systems, `y₁ᵀ x₂ · y₂ᵀ x₁` is 1 for the same mode, 0 for different ones, and does not
//! depend on the sizes and phases of the vectors (modal assurance criterion). Poles that coincide have no vectors of
//! their own, but a space of them: the sum over a group is the number of modes that both spaces have in common.

use super::base::Base;
use super::independent::Selection;
use super::poles::{Kinds, PoleKind, shape};
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::mass::MassAt;
use crate::mechanics::system::rotation::Rotation;
use crate::solve::linear::Singular;
use crate::solve::linear::dense::{Complex, Dense};
use crate::solve::linear::eigen::Eigen;
use crate::solve::modes::subspace::dot;

/// Poles are one if they differ by less than this share.
const SAME: f64 = 1e-6;
/// Numbers of common modes that are so far from a whole number tell nothing: the best two of one mode are nearer than
/// 0.2 to each other.
const UNCLEAR: f64 = 0.4;
/// Round-off of a pole, over its product of vectors and matrix if nothing canceled, and over the pole.
const ROUND_OFF: f64 = 1e-14;
const LEAST_GROWTH: f64 = 1e-8;
/// A motion whirls if this share of it is a circle about the axis.
const WHIRLS: f64 = 0.05;

/// How a mode turns about the axis of a rotation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Whirl {
    /// The same way as the rotation.
    Forward,
    /// Against it.
    Backward,
    /// Nearly along a line: in a plane, about or along the axis; or nothing turns.
    None,
}

/// The modes of a system about a base.
#[derive(Debug)]
pub struct Spectrum {
    /// All of them, those of a pair too.
    pub modes: Vec<Eigen>,
    /// How each goes on.
    pub kinds: Vec<PoleKind>,
}

impl Spectrum {
    /// Finds those of the matrix `a`, about a rotation with `speed` rad/s: a pole in a frame that turns is a frequency
    /// less the speed, with the round-off of both.
    ///
    /// # Errors
    /// The eigenvalues are not found.
    pub fn new(system: &System, base: &Base, selection: &Selection, a: &Dense, speed: f64) -> Result<Self, Singular> {
        let modes = a.eigensystem()?;
        let judge = Kinds::new(system, base, modes.iter().map(|mode| mode.value));
        let kinds = modes.iter().map(|mode| {
            let least = LEAST_GROWTH * mode.size().max(speed.abs());
            let noise = || f64::max(ROUND_OFF * a.magnitude(&mode.left, &mode.right), least);
            judge.of_noisy(system, mode.value, &shape(selection, &mode.right).0, noise)
        });
        let kinds = kinds.collect();
        Ok(Self { modes, kinds })
    }

    /// The `count` softest vibrations: of each pair the one with the positive imaginary part. Those that have the pole
    /// of the last one belong to them: alone it would have no vectors of its own.
    pub fn softest(&self, count: usize) -> Vec<usize> {
        let vibrates = |own: &usize| self.modes[*own].value.im > 0.0 && self.kinds[*own] != PoleKind::Rigid;
        let mut chosen: Vec<usize> = (0..self.modes.len()).filter(vibrates).collect();
        chosen.sort_by(|a, b| self.modes[*a].size().total_cmp(&self.modes[*b].size()));
        let last = count.checked_sub(1).and_then(|last| chosen.get(last)).copied();
        let joins = |own: &&usize| last.is_some_and(|last| is_one(&self.modes[**own], &self.modes[last]));
        let all = count + chosen.iter().skip(count).take_while(joins).count();
        chosen.truncate(all);
        chosen
    }

    /// Whether a motion grows.
    pub fn is_unstable(&self) -> bool {
        self.kinds.contains(&PoleKind::Unstable)
    }
}

/// The numbers of the modes that continue the `known` ones, each with its vectors, and whether that is certain.
pub fn continued(known: &[Eigen], found: &[Eigen]) -> (Vec<usize>, bool) {
    let (from, to) = (groups(known), groups(found));
    let mut shares = Vec::new();
    let mut is_certain = true;
    for (group, members) in from.iter().enumerate() {
        let mut whole = 0.0;
        for (other, candidates) in to.iter().enumerate() {
            let pairs = members.iter().flat_map(|one| candidates.iter().map(move |next| (&known[*one], &found[*next])));
            let products = pairs.map(|(one, next)| product(&one.left, &next.right) * product(&next.left, &one.right));
            let share = products.sum::<Complex>().norm();
            whole += share.round();
            is_certain &= (share - share.round()).abs() <= UNCLEAR;
            shares.push((share, group, other));
        }
        is_certain &= whole == members.len() as f64;
    }
    // The largest shares first; within groups by frequency.
    shares.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut open: [Vec<Vec<usize>>; 2] = [from, to];
    let mut next = vec![usize::MAX; known.len()];
    let mut pairs: Vec<Vec<usize>> = vec![Vec::new(); open[0].len()];
    for (share, group, other) in shares {
        let mut count = share.round().max(1.0) as usize;
        while count > 0 && pairs[group].len() < open[0][group].len() && !open[1][other].is_empty() {
            pairs[group].push(open[1][other].remove(0));
            count -= 1;
        }
    }
    for (members, mut chosen) in open[0].iter_mut().zip(pairs) {
        chosen.sort_by(|a, b| found[*a].value.im.total_cmp(&found[*b].value.im));
        members.iter().zip(chosen).for_each(|(own, chosen)| next[*own] = chosen);
    }
    (next, is_certain)
}

/// Whether the poles of both modes are one.
fn is_one(own: &Eigen, other: &Eigen) -> bool {
    (other.value - own.value).norm() <= SAME * own.size()
}

/// The numbers of the modes whose poles are one, by rising frequency.
fn groups(modes: &[Eigen]) -> Vec<Vec<usize>> {
    let mut order: Vec<usize> = (0..modes.len()).collect();
    order.sort_by(|a, b| modes[*a].value.im.total_cmp(&modes[*b].value.im));
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for own in order {
        match groups.iter_mut().rev().find(|group| group.iter().any(|other| is_one(&modes[own], &modes[*other]))) {
            Some(group) => group.push(own),
            None => groups.push(vec![own]),
        }
    }
    groups
}

/// `leftᵀ right`.
fn product(left: &[Complex], right: &[Complex]) -> Complex {
    left.iter().zip(right).map(|(left, right)| left * right).sum()
}

/// How the motion of `mode` turns about the axis of `rotation`, by its [`circle`].
pub fn whirl(system: &System, base: &Base, rotation: &Rotation, selection: &Selection, mode: &Eigen) -> Whirl {
    match circle(system, base, rotation, selection, mode) {
        share if share > WHIRLS => Whirl::Forward,
        share if share < -WHIRLS => Whirl::Backward,
        _ => Whirl::None,
    }
}

/// The share of the motion of `mode` that is a circle about the axis of `rotation`, negative against it:
/// `Im(zᴴ M (ω × z))`. Where it is less than a twentieth, the same with `1/size²` of positions and 1 of all else in
/// place of `M` tells it: the director along the axis of a thin disk has no inertia, so that `M` does not see its tilt.
pub fn circle(system: &System, base: &Base, rotation: &Rotation, selection: &Selection, mode: &Eigen) -> f64 {
    if rotation.speed == 0.0 {
        return 0.0;
    }
    let (_, [real, imaginary]) = shape(selection, &mode.right);
    let state = &base.state;
    let mut frames = FrameCache::default();
    frames.set(system, &state.q, &state.triads);
    let mass = MassAt::new(&state.prescribed.drives, &frames);
    let by_mass = |vector: &[f64]| {
        let mut product = vec![0.0; vector.len()];
        system.mass_times(mass, vector, &mut product);
        product
    };
    let by_size = |vector: &[f64]| {
        let weight = |index: usize| if system.is_place(index) { system.size.powi(-2) } else { 1.0 };
        vector.iter().enumerate().map(|(index, value)| weight(index) * value).collect()
    };
    let turned = rotation.with_speed(1.0_f64.copysign(rotation.speed));
    let share = |times: &dyn Fn(&[f64]) -> Vec<f64>| {
        let circle = dot(&real, &times(&turned.cross(&imaginary))) - dot(&imaginary, &times(&turned.cross(&real)));
        let whole = dot(&real, &times(&real)) + dot(&imaginary, &times(&imaginary));
        // The other one of a pair has the conjugate vector.
        circle.copysign(circle * mode.value.im) / whole
    };
    let whirls = |share: &f64| share.abs() > WHIRLS;
    Some(share(&by_mass)).filter(whirls).unwrap_or_else(|| share(&by_size))
}

/// The part that a mode moves most, in words; without a direction where it whirls, since it then moves along all of
/// them.
pub fn moves(system: &System, base: &Base, rotation: &Rotation, selection: &Selection, mode: &Eigen) -> String {
    let (shape, _) = shape(selection, &mode.right);
    let mut snapshot = FrameCache::default();
    let most = system.most_moved(&snapshot.of(system, &base.state), &shape).what;
    let name = most.split(',').next().map(str::to_owned);
    match whirl(system, base, rotation, selection, mode) {
        Whirl::None => most,
        Whirl::Forward | Whirl::Backward => name.unwrap_or(most),
    }
}
