//! The line of a rope, as drawn and as it moves: its spans, and its arcs on sheaves as straight pieces.

use crate::math::Vec3;
use crate::math::elementary::{cos, sin};
use crate::mechanics::force::rope::Rope;
use crate::mechanics::force::rope::line::{Wheel, products, stretched};
use crate::mechanics::geometry::pose::Pose;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::Configuration;
use crate::model::file::document::Document;
use crate::model::file::entries::rope::{End, RopeSpec};
use crate::model::file::entries::surface::Shape;
use crate::model::shape::Lines;
use std::f64::consts::{PI, TAU};

/// Largest angle of a piece of an arc, rad.
const PIECE: f64 = PI / 12.0;
/// Pieces of an arc that moves, whatever its angle.
const MOVING_PIECES: usize = 16;

/// The points that a rope runs through as drawn, global, m; none: it cannot be drawn.
pub(super) fn points(document: &Document, lines: &Lines, rope: &RopeSpec) -> Option<Vec<Vec3>> {
    let mut wheels = rope.wheels().map(|(surface, turn)| {
        let spec = document.surfaces.get(surface)?;
        let (Shape::Sheave { radius, .. } | Shape::Cylinder { radius, .. }) = spec.shape else { return None };
        let place = lines.carried(document, spec.on, spec.offset(&document.numbers))?;
        let radius = document.value(radius) + document.value(rope.radius);
        Some((Pose { place, axes: spec.axes(&document.numbers) }, Wheel { radius, turn: turn as f64 }))
    });
    let mut seats = Vec::new();
    for (number, end) in rope.ends.into_iter().enumerate() {
        if number == 1 {
            for _ in &rope.over {
                seats.push(wheels.next()??);
            }
        }
        match end {
            // The ground itself is the origin.
            End::Point(anchor) => {
                let place = lines.place(document, anchor).unwrap_or_else(Vec3::zeros);
                seats.push((Pose { place, ..Pose::default() }, Wheel::POINT));
            }
            End::Drum(_) => seats.push(wheels.next()??),
        }
    }
    through(&seats, |wrap| (wrap / PIECE).ceil().max(1.0) as usize)
}

/// The points that a rope of the system runs through at `c`, of the state, m: as many at each instant.
pub(super) fn moving(rope: &Rope, c: &Configuration) -> Vec<Vec3> {
    let seats: Vec<_> = rope.seats.iter().map(|seat| (seat.marker.pose(c), seat.wheel)).collect();
    through(&seats, |_| MOVING_PIECES).unwrap_or_else(|| vec![seats[0].0.place; moving_points(rope)])
}

/// Number of the points of [`moving`].
pub(super) fn moving_points(rope: &Rope) -> usize {
    seats(rope).count()
}

/// The marker that each point of [`moving`] follows.
pub(super) fn seats(rope: &Rope) -> impl Iterator<Item = &Marker> {
    let points = |seat: usize| match seat {
        0 => 1,
        _ if seat == rope.spans() => 1,
        _ => MOVING_PIECES + 1,
    };
    rope.seats.iter().enumerate().flat_map(move |(number, seat)| std::iter::repeat_n(&seat.marker, points(number)))
}

/// The points of a rope over the wheels and ends `seats`, with as many pieces in an arc as `pieces` says of its angle,
/// rad; none: a span is impossible.
fn through(seats: &[(Pose, Wheel)], pieces: impl Fn(f64) -> usize) -> Option<Vec<Vec3>> {
    let mut found = Vec::new();
    let mut reached: Option<f64> = None;
    for pair in seats.windows(2) {
        let [(a, first), (b, second)] = [pair[0], pair[1]];
        let (_, [leaves, reaches]) = stretched([first, second], &products(&a, &b))?;
        if let Some(reached) = reached {
            let wrap = (first.turn * (leaves - reached)).rem_euclid(TAU);
            let pieces = pieces(wrap);
            let along = |piece: usize| reached + first.turn * wrap * (piece as f64 / pieces as f64);
            found.extend((1..pieces).map(|piece| on_rim(&a, first, along(piece))));
        }
        found.extend([on_rim(&a, first, leaves), on_rim(&b, second, reaches)]);
        reached = Some(reaches);
    }
    Some(found)
}

/// The point of a wheel at an angle.
fn on_rim(pose: &Pose, wheel: Wheel, angle: f64) -> Vec3 {
    pose.place + (pose.axis(1) * cos(angle) + pose.axis(2) * sin(angle)) * wheel.radius
}
