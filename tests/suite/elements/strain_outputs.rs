//! Strains of a section carry the signs of the model file: each is positive under the load that works on it, and of the
//! size of the linear theory. A curvature about the wrong axis or with the wrong sign fails here.

use crate::support::machines::{clamp, design, load};
use crate::support::sections::loaded_section;
use ancf14::math::Vec3;
use ancf14::mechanics::beam::resultants::SectionStrains;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::solve::statics::Statics;

/// Strains at a fraction of a cantilever along x under a small force and moment at its end.
fn strains(fraction: f64, force: Vec3, moment: Vec3) -> SectionStrains {
    let mut builder = SystemBuilder::default();
    let beam = builder.add_beam(&design("beam", 4));
    clamp(&mut builder, beam);
    load(&mut builder, beam, 1.0, force, moment);
    builder.add_sensor(beam, fraction);
    let (system, mut state) = builder.finish(Vec3::zeros());
    Statics::new(&system, 1e-10).find(&system, &mut state, 1.0).unwrap();
    loaded_section(&system, &state, 0).1
}

#[test]
fn each_load_strains_its_own_way() {
    let beam = design("beam", 4);
    let (material, section) = (beam.material, beam.section);
    let size = 1e-3; // N or N m: strains of 1e-8 to 1e-4, whose squares are lost in the bound
    // At the ends, at an inner node and inside an element.
    for fraction in [0.0, 0.5, 0.6, 1.0] {
        let pulled = strains(fraction, Vec3::x() * size, Vec3::zeros());
        let twisted = strains(fraction, Vec3::zeros(), Vec3::x() * size);
        let about_y = strains(fraction, Vec3::zeros(), Vec3::y() * size);
        let about_z = strains(fraction, Vec3::zeros(), Vec3::z() * size);
        for (name, found, expected) in [
            ("axial", pulled.axial, size / (material.young * section.area)),
            ("torsion", twisted.torsion, size / (material.shear * section.torsion_constant)),
            ("curvature about y", about_y.curvature[0], size / (material.young * section.second_moment_y)),
            ("curvature about z", about_z.curvature[1], size / (material.young * section.second_moment_z)),
            ("curvature about z by a moment about y", about_y.curvature[1], 0.0),
            ("curvature about y by a moment about z", about_z.curvature[0], 0.0),
        ] {
            // Round-off of slopes over the element's length, 1e-15 in strain, beside the squares.
            assert!(
                (found - expected).abs() < 1e-4 * expected.abs() + 1e-12,
                "{name} at {fraction}: {found:e}, {expected:e}"
            );
        }
    }
}
