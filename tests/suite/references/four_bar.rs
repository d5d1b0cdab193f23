//! The four-bar linkage with a tilted hinge: bars are bent by what would lock them. The moments that its hinges
//! transmit give nodes of little inertia a stiffness, `λ·g_qq`, a hundred times what the step resolves. Constraint
//! forces that are taken at the start of a step treat it explicitly: such a machine gained energy from 0.4 s on at 1, 2
//! and 4 ms. In the middle of the step it is harmless.

use crate::curves::{Curves, largest};

const MODEL: &str = include_str!("../../../models/four_bar.toml");

#[test]
fn a_tilted_hinge_does_not_shake_the_machine() {
    let [coarse, fine] =
        ["4e-3", "2e-3"].map(|step| Curves::run(MODEL, &[("simulation.step", step), ("simulation.stop", "3.0")]));
    for curves in [&coarse, &fine] {
        assert_eq!(curves.last("statistics.rejected"), 0.0);
        // The bars move at 7 cm/s: a millijoule; a few more from the sudden start.
        let kinetic = largest(&curves.column("energy.kinetic")[10..]);
        println!("kinetic energy up to {kinetic:.2e} J");
        assert!(kinetic < 2e-2, "{kinetic}");
    }
    // Bent slowly: the energy of the bars follows the angle, whatever the step.
    let (own, other) = (coarse.column("energy.elastic"), fine.column("energy.elastic"));
    let apart = coarse.difference(&own, &other, 3.0) / largest(&own);
    println!("elastic energy up to {:.2} J, apart by {apart:.1e}", largest(&own));
    assert!(largest(&own) > 4.0 && apart < 1e-2, "{apart}");
}

/// Without the tilt nothing is bent but by inertia.
#[test]
fn a_straight_hinge_bends_nothing() {
    let curves = Curves::run(MODEL, &[("tilt", "0"), ("simulation.stop", "1.0")]);
    assert!(largest(&curves.column("energy.elastic")) < 1e-2);
    assert!(largest(&curves.column("hinge.displacement[3]")) < 1e-12);
}
