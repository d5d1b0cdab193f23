//! A straight, round rod wound into a helix of 1.5 turns by its exact end wrench: curvature, torsion and the holonomy
//! of the frame all act together, and everything is known in closed form.
//!
//! With the Darboux vector `d = w e` (e along the helix's axis, w per unit of undeformed length, psi between axis and
//! tangent) the curve has the curvature `w sin(psi)` and the geometric torsion `w cos(psi)`. Kirchhoff's rod stands in
//! equilibrium with the material torsion `tau` under the force `n = w (GJ tau − EI w cos(psi)) e/(1 + eps)`,
//! `eps = n·t/EA`, and the moment `GJ tau t + EI w sin(psi) b` at its end.

use crate::support::machines::ancf14;
use crate::support::machines::{clamp, design};
use ancf14::math::jet::Jet;
use ancf14::math::{Vec3, rotation};
use ancf14::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
use ancf14::mechanics::beam::ancf14::strain::Strain;
use ancf14::mechanics::beam::design::BeamDesign;
use ancf14::mechanics::beam::section::Section;
use ancf14::mechanics::force::load::{Direction, Load, LoadGuide, Site};
use ancf14::mechanics::input::signal::Signal;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::solve::statics::Statics;
use std::sync::Arc;

const PSI: f64 = 1.0;
/// Material torsion over geometric torsion: any value has its wrench.
const TORSION: f64 = 0.4;
const STEPS: u32 = 40;

struct Helix {
    bending: f64,
    torsion: f64,
    axial: f64,
}

impl Helix {
    fn of(design: &BeamDesign) -> Self {
        let (material, section) = (&design.material, &design.section);
        Self {
            bending: material.young * section.second_moment_y,
            torsion: material.shear * section.torsion_constant,
            axial: material.young * section.area,
        }
    }

    /// The axis; the rod starts along x and curves towards y.
    fn axis() -> Vec3 {
        Vec3::new(PSI.cos(), 0.0, PSI.sin())
    }

    /// Force on the end and axial strain.
    fn force(&self, w: f64) -> (Vec3, f64) {
        let size = w * w * PSI.cos() * (self.torsion * TORSION - self.bending);
        let mut strain = 0.0;
        for _ in 0..50 {
            strain = size / (1.0 + strain) * PSI.cos() / self.axial;
        }
        (Self::axis() * (size / (1.0 + strain)), strain)
    }

    /// Moment on the end of a rod of 1 m.
    fn moment(&self, w: f64) -> Vec3 {
        let turn = rotation::rotation_matrix(&(Self::axis() * w));
        let local = Vec3::new(self.torsion * TORSION * w * PSI.cos(), 0.0, self.bending * w * PSI.sin());
        turn * local
    }

    /// Place of the end of a rod of 1 m.
    fn end(&self, w: f64) -> Vec3 {
        let (axis, t) = (Self::axis(), Vec3::x());
        let along = axis * axis.dot(&t);
        let place = along + (t - along) * (w.sin() / w) + axis.cross(&t) * ((1.0 - w.cos()) / w);
        place * (1.0 + self.force(w).1)
    }
}

/// Distance of the end from where it should be, m.
fn error(elements: usize, twist: Twist) -> f64 {
    let design = BeamDesign {
        section: Section::circle(1e-3),
        elements: ancf14(Strain::Small, twist),
        ..design("rod", elements)
    };
    let helix = Helix::of(&design);
    let mut builder = SystemBuilder::default();
    let beam = builder.add_beam(&design);
    clamp(&mut builder, beam);
    let winding = 3.0 * std::f64::consts::PI;
    let signal = |value: fn(&Helix, f64) -> Vec3| {
        [0, 1, 2].map(|i| {
            let own = Helix { ..helix };
            Signal::Function(Arc::new(move |time| Jet::constant(value(&own, winding * time)[i])))
        })
    };
    let load = Load {
        name: "wrench".into(),
        site: Site::Point(builder.section_at(beam, 1.0)),
        guide: LoadGuide::Signals {
            force: signal(|helix, w| helix.force(w).0),
            moment: signal(|helix, w| if w == 0.0 { Vec3::zeros() } else { helix.moment(w) }),
        },
        direction: Direction::Global,
    };
    builder.add_load(load);
    let (system, mut state) = builder.finish(Vec3::zeros());
    let mut statics = Statics::new(&system, 1e-10);
    for step in 1..=STEPS {
        statics.find(&system, &mut state, f64::from(step) / f64::from(STEPS)).unwrap();
    }
    let end = Vec3::from_column_slice(&state.q[7 * elements..7 * elements + 3]);
    (end - helix.end(winding)).norm()
}

#[test]
fn order_four() {
    for twist in [Twist::Linear, Twist::Quadratic] {
        let errors = [16, 32, 64].map(|elements| error(elements, twist));
        println!("{twist:?} twist: tip errors with 16, 32, 64 elements {errors:?}");
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            // The next order counts a little at 16 elements, which turn by 34 degrees each.
            assert!((order - 4.0).abs() < 0.2, "order {order}");
        }
    }
}
