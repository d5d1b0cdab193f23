//! Ropes in a system: forces, tangent, energy, what they remember, what steps may not do.

use super::System;
use super::equations::{add, add_corner};
use super::tangent_layout::TangentLayout;
use crate::error::Error;
use crate::math::blocks::{Block, Blocks};
use crate::mechanics::force::rope::line::{self, Line, PRODUCTS, Products};
use crate::mechanics::force::rope::tensions::{MOST_SPANS, MOST_WHEELS};
use crate::mechanics::force::rope::{Pull, Rope};
use crate::mechanics::geometry::marker_jacobian::{MarkerMatrix, MarkerVector};
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::{Configuration, Passage, TimeStep};
use crate::mechanics::marker::own_velocity;
use crate::mechanics::marker::pose_gradient::{of_side, pull_back};

/// The lines of all spans of a rope; none: a span is impossible.
type Lines = [Option<Line>; MOST_SPANS];

/// Energies of ropes over a step, J.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RopeEnergy {
    /// Elastic energy at the end.
    pub elastic: f64,
    /// Energy that moving frames give.
    pub by_frames: f64,
    /// Energy that comes with the rope that drums pay out.
    pub by_drums: f64,
    /// Energy that damping and friction take.
    pub dissipated: f64,
}

impl System {
    /// Appends the blocks of ropes to the tangent: one for each pair of the parts of a rope.
    pub(super) fn push_rope_blocks(&self, blocks: &mut Blocks) {
        for rope in &self.ropes {
            for (row, column) in rope.parts.iter().flat_map(|row| rope.parts.iter().map(move |column| (row, column))) {
                blocks.push(Block { row: row.start, column: column.start, rows: row.len(), columns: column.len() });
            }
        }
    }

    /// Number of the blocks of ropes.
    pub(super) fn rope_blocks(&self) -> usize {
        self.ropes.iter().map(|rope| rope.parts.len() * rope.parts.len()).sum()
    }

    // Functions of their own handle a rope: machines without ropes have no arrays of ropes on the stack.

    /// Adds `factor` times the forces of ropes, internal minus external, at `c` as `passage` says.
    pub(super) fn add_rope_forces(&self, c: &Configuration, passage: &Passage, factor: f64, forces: &mut [f64]) {
        self.ropes.iter().for_each(|rope| add_forces(rope, c, passage, factor, forces));
    }

    /// [`Self::add_rope_forces`], and sets the blocks of ropes to `scale` times their derivative; over a step twice
    /// that by the coordinates at its end.
    pub(super) fn add_ropes_and_set_tangent(
        &self,
        c: &Configuration,
        passage: &Passage,
        scale: f64,
        forces: &mut [f64],
        tangent: &mut Blocks,
    ) {
        self.each_with_first_block(|rope, first| {
            add_forces_and_set_tangent(rope, c, passage, scale, forces, (first, tangent));
        });
    }

    /// Adds `factor` times the derivative of the forces with respect to the velocities, at an instant with the
    /// velocities `velocity`, to the blocks of ropes in `tangent`.
    pub(super) fn add_rope_damping(&self, c: &Configuration, velocity: &[f64], factor: f64, tangent: &mut Blocks) {
        self.each_with_first_block(|rope, first| {
            if rope.elasticity.damping != 0.0 {
                add_damping(rope, c, velocity, factor, (first, tangent));
            }
        });
    }

    /// Calls `take` with each rope and the number of its first block.
    fn each_with_first_block(&self, mut take: impl FnMut(&Rope, usize)) {
        let mut first = TangentLayout::of(self).first_rope();
        for rope in &self.ropes {
            take(rope, first);
            first += rope.parts.len() * rope.parts.len();
        }
    }

    /// Elastic energy of all ropes at `c`, J.
    pub(super) fn rope_energy(&self, c: &Configuration) -> f64 {
        self.ropes.iter().map(|rope| energy(rope, c)).sum()
    }

    /// Adds the forces of ropes over `step`, whose middle is `c`. Returns what they do to the energies.
    pub(super) fn finish_ropes(&self, c: &Configuration, step: &TimeStep, forces: &mut [f64]) -> RopeEnergy {
        let mut found = RopeEnergy::default();
        self.ropes.iter().for_each(|rope| finish(rope, c, step, forces, &mut found));
        found
    }

    /// Sets what ropes remember at the end of what `passage` says.
    pub(super) fn remember_ropes(&self, c: &Configuration, passage: &Passage, memory: &mut [f64]) {
        self.ropes.iter().for_each(|rope| remember(rope, c, passage, memory));
    }

    /// Checks that the spans of ropes at `c` are possible, and that their free lengths have not been used up.
    ///
    /// # Errors
    /// One is not.
    pub(super) fn check_ropes(&self, c: &Configuration, time: f64) -> Result<(), Error> {
        self.ropes.iter().try_for_each(|rope| check(rope, c, time))
    }

    /// The first span of a rope that is impossible at `c`, in words.
    pub(super) fn impossible_rope(&self, c: &Configuration) -> Option<String> {
        self.ropes.iter().find_map(|rope| {
            let span = rope.impossible_span(c)?;
            let [a, b] = [span, span + 1].map(|seat| rope.seats[seat].name.as_str());
            Some(format!("span {} of rope {}, whose ends {a} and {b} are inside each other,", span + 1, rope.name))
        })
    }
}

/// Adds `factor` times the forces of a rope.
#[inline(never)]
fn add_forces(rope: &Rope, c: &Configuration, passage: &Passage, factor: f64, forces: &mut [f64]) {
    let Some(pull) = rope.pull(c, passage) else { return undefined(rope, forces) };
    for span in 0..rope.spans() {
        let tension = pull.pulls[rope.stretch_of(span)].value * factor;
        if tension != 0.0 {
            let Some(line) = rope.line(span, c) else { return undefined(rope, forces) };
            add_span(rope, span, c, &(line.reach_by * tension), forces);
        }
    }
}

/// Adds the forces of a span whose tension has the derivatives `weights` by its scalar products.
#[inline(never)]
fn add_span(rope: &Rope, span: usize, c: &Configuration, weights: &Products, forces: &mut [f64]) {
    let parts = gradient(rope, span, c, weights);
    for (seat, part) in rope.seats[span..].iter().zip(&parts) {
        let Some(own) = seat.part else { continue };
        let range = &rope.parts[own];
        add(forces, range.start, &part.as_slice()[..range.len()]);
    }
}

/// Adds the forces of a rope, and sets its blocks from `first` on to `scale` times their derivative.
#[inline(never)]
fn add_forces_and_set_tangent(
    rope: &Rope,
    c: &Configuration,
    passage: &Passage,
    scale: f64,
    forces: &mut [f64],
    (first, tangent): (usize, &mut Blocks),
) {
    let count = rope.parts.len() * rope.parts.len();
    (first..first + count).for_each(|block| tangent.block_mut(block).fill(0.0));
    let Some(pull) = rope.pull(c, passage) else { return undefined(rope, forces) };
    let here = lines(rope, c);
    for (span, line) in here.iter().enumerate().take(rope.spans()) {
        let tension = pull.pulls[rope.stretch_of(span)].value;
        if tension != 0.0 {
            let Some(line) = line else { return undefined(rope, forces) };
            add_span(rope, span, c, &(line.reach_by * tension), forces);
            add_turning(rope, span, c, line, tension * scale, (first, tangent));
        }
    }
    let by_strain = |stretch: usize| pull.pulls[stretch].by_strain;
    match passage {
        Passage::Step(step) => {
            let ends = [(c, &here), (step.end, &lines(rope, step.end))];
            add_stretching(rope, ends, &pull, |stretch| 2.0 * scale * by_strain(stretch), (first, tangent));
        }
        _ => {
            let ends = [(c, &here), (c, &here)];
            add_stretching(rope, ends, &pull, |stretch| scale * by_strain(stretch), (first, tangent));
        }
    }
}

/// Adds `factor` times the derivative of the forces of a rope with respect to the velocities to its blocks from `first`
/// on.
#[inline(never)]
fn add_damping(rope: &Rope, c: &Configuration, velocity: &[f64], factor: f64, (first, tangent): (usize, &mut Blocks)) {
    if let Some(pull) = rope.pull(c, &Passage::with_velocity(velocity)) {
        let here = lines(rope, c);
        let by_rate = |stretch: usize| factor * pull.pulls[stretch].by_rate;
        add_stretching(rope, [(c, &here), (c, &here)], &pull, by_rate, (first, tangent));
    }
}

/// Elastic energy of a rope, J.
#[inline(never)]
fn energy(rope: &Rope, c: &Configuration) -> f64 {
    rope.pull(c, &Passage::Rest).map_or(f64::NAN, |pull| rope.energy(&pull))
}

/// Adds the forces of a rope over a step, and its energies to `found`.
#[inline(never)]
fn finish(rope: &Rope, c: &Configuration, step: &TimeStep, forces: &mut [f64], found: &mut RopeEnergy) {
    let Some(pull) = rope.pull(c, &Passage::Step(*step)) else { return };
    let has_frame = rope.seats.iter().any(|seat| matches!(seat.marker, Marker::Frame { .. }));
    let mut of_parts = 0.0;
    for span in 0..rope.spans() {
        let tension = pull.pulls[rope.stretch_of(span)].value;
        if tension == 0.0 {
            continue;
        }
        let Some(line) = rope.line(span, c) else { return undefined(rope, forces) };
        let weights = line.reach_by * tension;
        add_span(rope, span, c, &weights, forces);
        if has_frame {
            let parts = gradient(rope, span, c, &weights);
            let markers = rope.seats[span..].iter().map(|seat| &seat.marker);
            of_parts +=
                markers.zip(&parts).map(|(own, part)| part.dot(&own_velocity(c, own, step.increment))).sum::<f64>();
        }
    }
    let elastic = rope.energy(&pull);
    let work: f64 = (0..rope.stretches()).map(|k| pull.pulls[k].value * pull.ways[k]).sum();
    let given = rope.given_by_drums(&pull);
    found.elastic += elastic;
    found.by_drums += given;
    found.dissipated += work + given - (elastic - rope.energy_at_start(&pull));
    found.by_frames += if has_frame { work - of_parts } else { 0.0 };
}

/// Sets what a rope remembers.
#[inline(never)]
fn remember(rope: &Rope, c: &Configuration, passage: &Passage, memory: &mut [f64]) {
    if let Some(pull) = rope.pull(c, passage) {
        rope.remember(&pull, memory);
    }
}

/// Checks a rope: see [`System::check_ropes`].
#[inline(never)]
fn check(rope: &Rope, c: &Configuration, time: f64) -> Result<(), Error> {
    if let Some(span) = rope.impossible_span(c) {
        let [a, b] = [span, span + 1].map(|seat| rope.seats[seat].name.clone());
        return Err(Error::RopeThroughWheel { time, rope: rope.name.clone(), a, b });
    }
    let Some(pull) = rope.pull(c, &Passage::Rest) else { return Ok(()) };
    let free = &pull.tensions.free[..rope.stretches()];
    match free.iter().position(|own| *own <= 0.0) {
        Some(span) => Err(Error::RopeUsedUp { time, rope: rope.name.clone(), span: span + 1 }),
        None => Ok(()),
    }
}

/// Marks the forces of a rope that has no way over its wheels.
fn undefined(rope: &Rope, forces: &mut [f64]) {
    rope.parts.iter().for_each(|part| forces[part.clone()].fill(f64::NAN));
}

/// The lines of a rope at `c`.
fn lines(rope: &Rope, c: &Configuration) -> Lines {
    let mut found = [None; MOST_SPANS];
    found.iter_mut().enumerate().take(rope.spans()).for_each(|(span, own)| *own = rope.line(span, c));
    found
}

/// The derivative of `weights · y` of a span with respect to the coordinates of both its sides.
fn gradient(rope: &Rope, span: usize, c: &Configuration, weights: &Products) -> [MarkerVector; 2] {
    let [a, b] = rope.poses(span, c);
    let by_poses = line::by_poses(&a, &b, weights);
    let sides = rope.poses_q(span, c);
    [0, 1].map(|side| sides[side].generalized(&of_side(&by_poses, side)))
}

/// Adds `tension` times the second derivative of the reach of a span to the blocks of its rope from `first` on.
#[inline(never)]
fn add_turning(
    rope: &Rope,
    span: usize,
    c: &Configuration,
    line: &Line,
    tension: f64,
    (first, tangent): (usize, &mut Blocks),
) {
    let ends = &rope.seats[span..span + 2];
    let ([a, b], sides) = (rope.poses(span, c), rope.poses_q(span, c));
    let weights = line.reach_by * tension;
    let mut parts = [MarkerMatrix::zeros(); 4];
    let markers = [&ends[0].marker, &ends[1].marker];
    let by_poses = line::by_poses(&a, &b, &weights);
    pull_back(c, markers, &sides, &by_poses, &line::by_poses_twice(&weights), &mut parts);
    let curvature = line.reach_by_twice() * tension;
    let mut gradients = [[MarkerVector::zeros(); 2]; PRODUCTS];
    for (product, own) in gradients.iter_mut().enumerate() {
        if curvature.column(product).amax() > 0.0 {
            let mut unit = Products::zeros();
            unit[product] = 1.0;
            let by_poses = line::by_poses(&a, &b, &unit);
            *own = [0, 1].map(|side| sides[side].generalized(&of_side(&by_poses, side)));
        }
    }
    for product in (0..PRODUCTS).filter(|product| curvature.column(*product).amax() > 0.0) {
        let mut turned = [MarkerVector::zeros(); 2];
        for (other, own) in gradients.iter().enumerate() {
            (0..2).for_each(|side| turned[side] += own[side] * curvature[(product, other)]);
        }
        for (pair, part) in parts.iter_mut().enumerate() {
            part.ger(1.0, &gradients[product][pair / 2], &turned[pair % 2], 1.0);
        }
    }
    for (pair, part) in parts.iter().enumerate() {
        let (Some(row), Some(column)) = (ends[pair / 2].part, ends[pair % 2].part) else { continue };
        let block = tangent.block_mut(first + row * rope.parts.len() + column);
        add_corner(block, rope.parts[row].len(), part, 1.0);
    }
}

/// Adds `weight` of each stretch times the product of the gradient of its length at the first configuration and of the
/// gradient of its strain at the second one to the blocks of a rope from `first` on.
#[inline(never)]
fn add_stretching(
    rope: &Rope,
    [(c, here), (end, there)]: [(&Configuration, &Lines); 2],
    pull: &Pull,
    weight: impl Fn(usize) -> f64,
    (first, tangent): (usize, &mut Blocks),
) {
    let count = rope.parts.len();
    let mut strains = [[[0.0; MOST_SPANS]; 3]; MOST_SPANS];
    strains.iter_mut().enumerate().take(rope.spans()).for_each(|(span, own)| *own = rope.strains_by_span(pull, span));
    for stretch in 0..rope.stretches() {
        let weight = weight(stretch);
        if weight == 0.0 {
            continue;
        }
        let [mut rows, mut columns] = [[MarkerVector::zeros(); MOST_WHEELS]; 2];
        let take = |sums: &mut [MarkerVector; MOST_WHEELS], span: usize, parts: [MarkerVector; 2]| {
            for (seat, part) in rope.seats[span..].iter().zip(parts) {
                if let Some(own) = seat.part {
                    sums[own] += part;
                }
            }
        };
        for span in 0..rope.spans() {
            let (Some(line), Some(line_there)) = (&here[span], &there[span]) else { continue };
            if rope.stretch_of(span) == stretch {
                take(&mut rows, span, gradient(rope, span, c, &line.reach_by));
            }
            let [reach, leaves, reaches] = strains[span].map(|strains| strains[stretch]);
            if reach == 0.0 && leaves == 0.0 && reaches == 0.0 {
                continue;
            }
            let weights =
                line_there.reach_by * reach + line_there.angles_by[0] * leaves + line_there.angles_by[1] * reaches;
            take(&mut columns, span, gradient(rope, span, end, &weights));
        }
        for (row, column) in (0..count).flat_map(|row| (0..count).map(move |column| (row, column))) {
            let block = tangent.block_mut(first + row * count + column);
            let rows_of = rope.parts[row].len();
            for (target, by) in block.chunks_exact_mut(rows_of).zip(columns[column].iter()) {
                target.iter_mut().zip(rows[row].iter()).for_each(|(sum, own)| *sum += weight * own * by);
            }
        }
    }
}
