//! The line of a rope as drawn: its spans, and its arcs on drums and sheaves as straight pieces.

use crate::math::Vec3;
use crate::mechanics::force::rope::line::{Wheel, products, stretched};
use crate::mechanics::geometry::pose::Pose;
use crate::model::file::document::Document;
use crate::model::file::entries::rope::{End, RopeSpec};
use crate::model::file::entries::surface::Shape;
use crate::model::shape::Lines;
use std::f64::consts::{PI, TAU};

/// Largest angle of a piece of an arc, rad.
const PIECE: f64 = PI / 12.0;

/// The points that a rope runs through, global, m; none: it cannot be drawn.
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
    let mut found = Vec::new();
    let mut reached: Option<f64> = None;
    for pair in seats.windows(2) {
        let [(a, first), (b, second)] = [pair[0], pair[1]];
        let (_, [leaves, reaches]) = stretched([first, second], &products(&a, &b))?;
        if let Some(reached) = reached {
            let wrap = (first.turn * (leaves - reached)).rem_euclid(TAU);
            let pieces = (wrap / PIECE).ceil().max(1.0) as usize;
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
    pose.place + (pose.axis(1) * angle.cos() + pose.axis(2) * angle.sin()) * wheel.radius
}
