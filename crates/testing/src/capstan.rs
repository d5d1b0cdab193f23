//! A rope on a post, pulled until it slides.

use crate::running::{run, start, value, vector};
use std::f64::consts::PI;

/// Radius of the post, m.
pub const POST: f64 = 0.1;
/// Radii of thick ropes, m, with the ratio of forces at which half a turn of them slides.
pub const THICK: [(f64, f64); 2] = [(0.005, 2.444_801_275_87), (0.01, 2.340_859_559_31)];

/// A rope that slides.
pub struct Pulled {
    /// The force at the pulled end over that at the other.
    pub ratio: f64,
    /// Share of the cells that slide.
    pub sliding: f64,
    /// Angle on which it touches, rad.
    pub wrapped: f64,
}

/// A rope of `radius` around a post by `angle`, with eight elements on half a turn, loaded by 100 N at one end and pulled
/// at the other until it slides.
pub fn pulled(angle: f64, radius: f64) -> Pulled {
    let mut simulation = start(&model(angle, radius));
    run(&mut simulation, 0.02, 1.0, |_| {});
    Pulled {
        ratio: vector(&simulation, "high.reaction_force").norm() / 100.0,
        sliding: value(&simulation, "wrapped.sliding"),
        wrapped: value(&simulation, "wrapped.wrap_angle"),
    }
}

/// The model of [`pulled`].
pub fn model(angle: f64, radius: f64) -> String {
    let (post, tail, axial) = (POST, 0.15, 1e5);
    let elements = ((angle / PI * 8.0).round() as usize).max(3);
    let ring = post + radius;
    let arc = ring * angle;
    let (sine, cosine) = angle.sin_cos();
    let count = elements + 2 * (tail / (arc / elements as f64)).round() as usize;
    let end = [ring * cosine - tail * sine, ring * sine + tail * cosine];
    let along = |first: &str, second: &str, third: &str| {
        format!("if(s < {tail}, {first}, if(s < {}, {second}, {third}))", tail + arc)
    };
    let x = along(
        &format!("{ring}"),
        &format!("{ring}*cos((s - {tail})/{ring})"),
        &format!("{} - {sine}*(s - {})", ring * cosine, tail + arc),
    );
    let z = along(
        &format!("s - {tail}"),
        &format!("{ring}*sin((s - {tail})/{ring})"),
        &format!("{} + {cosine}*(s - {})", ring * sine, tail + arc),
    );
    // Far enough that all of it slides: three times what stretches the rope, and what friction gives.
    let most = 100.0 * (0.3 * angle).exp();
    let pull = 3.0 * most * (arc + tail) / axial + 0.9 * most / ring / 1e7;
    format!(
        "format = 1\n[model]\nname = \"Capstan\"\ngravity = [0, 0, 0]\n\
         [section.s]\nshape = \"rigidities\"\nEA = {axial}\nEI_y = 1e-4\nEI_z = 1e-4\nGJ = 1e-4\nline_density = 0.1\n\
         [beam.rope]\nsection = \"s\"\ncurve = {{ x = \"{x}\", y = \"0\", z = \"{z}\", s = [0, {}] }}\nelements = {count}\n\
         [surface.post]\nshape = \"cylinder\"\naxis = [0, 1, 0]\nradius = {post}\n\
         [contact.wrap]\nof = \"rope\"\nwith = \"post\"\nstiffness = 1e7\nradius = {radius}\nfriction = 0.3\n\
         [load.low]\nat = \"rope.start\"\nforce = [0, 0, -100]\n\
         [frame.pull]\nposition = [\"{} - {sine}*{pull}*t\", 0, \"{} + {cosine}*{pull}*t\"]\n\
         [joint.hold]\ntype = \"spherical\"\na = \"pull\"\nb = \"rope.end\"\n\
         [output.high]\nat = \"hold\"\nquantities = [\"reaction_force\"]\n\
         [output.wrapped]\nat = \"wrap\"\nquantities = [\"wrap_angle\", \"sliding\"]\n\
         [simulation]\nanalysis = \"static\"\ninitial = \"equilibrium\"\nstop = 1\nstep = 0.02\n",
        2.0 * tail + arc,
        end[0],
        end[1]
    )
}
