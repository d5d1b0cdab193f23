//! The paper's Figures 2 and 3: normals of a curve with an inflexion and a straight piece, by Serret and Frenet and by
//! Bishop.

use super::{Section, line, shapes};
use ancf14::math::Vec3;
use ancf14::math::bishop;
use ancf14::math::curve::Curve;
use ancf14::math::jet::Jet;
use ancf14_report::chart::Chart;
use std::sync::Arc;

/// An S in a plane: cubic to both sides of a straight piece.
fn curve() -> Curve {
    let coordinates = |s: f64| {
        let s = Jet::variable(s);
        let side = if s.value.abs() < STRAIGHT {
            Jet::constant(0.0)
        } else {
            let beyond = s - Jet::constant(STRAIGHT * s.value.signum());
            Jet::constant(0.6) * beyond * beyond * beyond
        };
        [s, side, Jet::constant(0.0)]
    };
    Curve::new(Arc::new(coordinates), [-1.5, 1.5], Vec::new())
}

/// Half of the length of the straight piece in x, m.
const STRAIGHT: f64 = 0.3;
/// Normals that are drawn, and their length, m.
const NORMALS: u32 = 41;
const LENGTH: f64 = 0.25;

pub fn write(section: &mut Section) {
    let curve = curve();
    let places: Vec<f64> = (0..NORMALS).map(|k| -1.5 + 3.0 * f64::from(k) / f64::from(NORMALS - 1)).collect();
    let frenet: Vec<_> = places.iter().map(|s| bishop::frenet(&curve, *s)).collect();
    let missing = frenet.iter().filter(|frame| frame.is_err()).count();
    let found: Vec<(f64, Vec3)> =
        places.iter().zip(&frenet).filter_map(|(s, frame)| frame.ok().map(|frame| (*s, frame.normal))).collect();
    let start = found[0].1;
    let carried: Vec<(f64, Vec3)> =
        places.iter().map(|s| (*s, bishop::carried(&curve, places[0], *s, &start))).collect();
    let turned = |normals: &[(f64, Vec3)]| {
        let angles = normals.windows(2).map(|pair| pair[0].1.angle(&pair[1].1).to_degrees());
        angles.fold(0.0, f64::max)
    };
    section.say(
        "What the paper's Figures 2 and 3 show (section 2), here along a curve of our own: where its middle piece is straight the normal of Serret and Frenet is not defined, and \
         beyond it points to the other side; Bishop's frame is carried along the whole curve without twist. `src/math/bishop.rs` has both, and says \
         where the former does not exist.",
    );
    section.picture("frames_frenet", hedgehog(&curve, "Figure 2: normals of the Serret-Frenet frame", &found));
    section.picture("frames_bishop", hedgehog(&curve, "Figure 3: normals of the Bishop frame", &carried));
    section.say(&format!(
        "Of {NORMALS} places {missing} have no Serret-Frenet frame. Neighboring normals differ by at most {:.1} degrees by Serret and Frenet and by {:.1} by \
         Bishop.",
        turned(&found),
        turned(&carried)
    ));
}

/// The curve with its normals, seen from above.
fn hedgehog(curve: &Curve, title: &str, normals: &[(f64, Vec3)]) -> Chart {
    let path = (0..=200).map(|k| curve.at(-1.5 + 3.0 * f64::from(k) / 200.0)[0]).map(|place| (place[0], place[1]));
    let mut lines = vec![line("curve", 6, path.collect())];
    for (k, (s, normal)) in normals.iter().enumerate() {
        let (foot, tip) = (curve.at(*s)[0], curve.at(*s)[0] + normal * LENGTH);
        let name = if k == 0 { "normals" } else { "" };
        lines.push(line(name, 0, vec![(foot[0], foot[1]), (tip[0], tip[1])]));
    }
    shapes(title, ["x (m)", "y (m)"], lines)
}
