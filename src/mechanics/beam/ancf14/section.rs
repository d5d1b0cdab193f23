//! Strains and section forces, the derivatives of the energy per undeformed length by the strains of a section.

use super::along::SectionAt;
use super::element::Element;
use super::energy::axial;
use super::energy::bending;
use super::energy::eccentricity;
use super::energy::fourth_moments;
use super::energy::quadratic_twist;
use super::energy::torsion;
use super::kinematics::Kinematics;
use super::kinematics::curve_point::CurvePoint;
use super::over_step::STRAINS;
use super::strain::{Stiffness, Strain, Strains};
use crate::math::elementary::sin_cos;
use crate::math::hermite;
use crate::math::quadrature::{GAUSS_POINTS, LOBATTO_POINTS, LOBATTO_WEIGHTS, collocation, lagrange};
use crate::mechanics::beam::configuration::BeamConfiguration;
use crate::mechanics::beam::resultants::{SectionForces, SectionShape, SectionStrains};
use nalgebra::{Matrix4, Vector4};

/// The section of `element` at `xi`, with the element's `kinematics`; `bubble` is the internal coordinate of the
/// quadratic twist, rad.
pub fn shape(element: &Element, c: &BeamConfiguration, kinematics: &Kinematics, xi: f64, bubble: f64) -> SectionShape {
    let q = element.own(c.q);
    let (shape_x, shape_xx) = (hermite::shape_x(xi, element.length), hermite::shape_xx(xi, element.length));
    let point = CurvePoint::new(&kinematics.shape, &shape_x, &shape_xx);
    let inner = collocation(xi).map(|a| a * element.length);
    let alpha = kinematics.alpha_at(q, xi, &inner) + bubble * quadratic_twist::shape(xi);
    let (sin, cos) = sin_cos(alpha);
    let [kappa1, kappa2] = point.curvatures;
    // (2.14): gamma1 is the curvature about z, −gamma2 the one about y.
    let [gamma1, gamma2] = [cos * kappa1 + sin * kappa2, cos * kappa2 - sin * kappa1];
    let twist_xi = kinematics.twist + bubble * quadratic_twist::shape_xi(xi);
    SectionShape { stretch: point.stretch, curvature: [-gamma2, gamma1], torsion: twist_xi / element.length }
}

/// Strains at `xi`: the axial one is the quadratic through the axial points.
pub fn strains(element: &Element, c: &BeamConfiguration, xi: f64, drawn: &SectionShape) -> SectionStrains {
    let evaluation = element.evaluation(c);
    let of_energy: f64 =
        lagrange(&LOBATTO_POINTS, xi).iter().zip(evaluation.axial_strains()).map(|(weight, e)| weight * e).sum();
    let axial = match element.stiffness.strain {
        Strain::Small => of_energy,
        // Green's strain as an elongation.
        Strain::Large | Strain::LargeTruncated => (1.0 + 2.0 * of_energy).max(0.0).sqrt() - 1.0,
    };
    let now = shape(element, c, &evaluation.kinematics, xi, evaluation.bubble);
    let (j0, turn) = (drawn.stretch, element.along.as_ref().map_or(0.0, |along| along.at(xi).turn));
    let (curvature, torsion) = element.unstressed_beyond(c, xi, drawn, turn);
    let bent = turned([0, 1].map(|i| now.curvature[i] / j0 - drawn.curvature[i] / j0), turn);
    SectionStrains {
        axial,
        // The curvature as drawn, by the same interpolation, is divided alike: without loads all strains are 0 exactly.
        curvature: [0, 1].map(|i| bent[i] - curvature[i]),
        torsion: (evaluation.kinematics.twist - element.reference_twist
            + evaluation.bubble * quadratic_twist::shape_xi(xi))
            / (element.length * j0)
            - torsion,
    }
}

/// Force and moments of the section of `element` at `xi` with the strains `strains`.
pub fn forces_at(element: &Element, xi: f64, strains: &SectionStrains) -> SectionForces {
    forces_of(&element.section_at(xi), strains)
}

/// Force and moments of the section `here` with the strains `strains`.
fn forces_of(here: &SectionAt, strains: &SectionStrains) -> SectionForces {
    if here.principal == 0.0 && here.eccentricity.is_none() {
        return forces(&here.stiffness, strains);
    }
    let along_axes = SectionStrains { curvature: turned(strains.curvature, here.principal), ..*strains };
    let SectionForces { mut axial, moment: [mut torque, mut about_y, mut about_z] } =
        forces(&here.stiffness, &along_axes);
    if let Some(moments) = &here.eccentricity {
        let by_strain =
            eccentricity::gradient(here.stiffness.strain, moments, &strains_of_energy(&here.stiffness, &along_axes));
        axial += by_strain[3] * stretch(&here.stiffness, strains);
        torque += by_strain[2];
        about_y -= by_strain[1];
        about_z += by_strain[0];
    }
    let [about_y, about_z] = turned([about_y, about_z], -here.principal);
    SectionForces { axial, moment: [torque, about_y, about_z] }
}

/// The strains at which the elastic stress of the section of `element` at `xi` and the viscous one, that of strains
/// `viscous`, bear `forces`, near `strains`; none: there are none. Strains that nothing resists stay what they are.
pub fn strains_under(
    element: &Element,
    xi: f64,
    forces: &SectionForces,
    [viscous, strains]: [&SectionStrains; 2],
) -> Option<SectionStrains> {
    let here = element.section_at(xi);
    // The viscous stress is linear in the rates.
    let viscous = vector_of_forces(&forces_of(&linear(&here), viscous));
    bearing(&here, vector_of_forces(forces) - viscous, strains)
}

/// The strains at which the section of `element` at `xi` would bear `forces` if its law were linear, near `strains`.
/// Young's modulus times the strain of a fiber is then the stress of beam theory, `N/A + M z/I`.
pub fn linear_strains_under(
    element: &Element,
    xi: f64,
    forces: &SectionForces,
    strains: &SectionStrains,
) -> Option<SectionStrains> {
    bearing(&linear(&element.section_at(xi)), vector_of_forces(forces), strains)
}

/// The section `here` with a linear law.
fn linear(here: &SectionAt) -> SectionAt {
    SectionAt { stiffness: Stiffness { strain: Strain::Small, fourth: [0.0; 3], ..here.stiffness }, ..*here }
}

/// The strains at which the elastic stress of the section `here` bears `wanted`, near `strains`; none: there are none.
fn bearing(here: &SectionAt, wanted: Vector4<f64>, strains: &SectionStrains) -> Option<SectionStrains> {
    let stiffness = &here.stiffness;
    let bending = stiffness.bending_y.max(stiffness.bending_z).max(stiffness.torsion);
    // The size of curvatures that strain fibers by 1.
    let per_length = (stiffness.axial / bending).sqrt().clamp(f64::MIN_POSITIVE, f64::MAX);
    let scales = Vector4::new(1.0, per_length, per_length, per_length);
    let borne =
        |strains: &Vector4<f64>| vector_of_forces(&forces_of(here, &strains_of(&strains.component_mul(&scales))));
    let mut found = vector_of_strains(strains).component_div(&scales);
    for _ in 0..MOST_CORRECTIONS {
        let mut residual = wanted - borne(&found);
        let mut tangent = Matrix4::zeros();
        for column in 0..4 {
            let mut aside = Vector4::zeros();
            aside[column] = ASIDE;
            tangent.set_column(column, &((borne(&(found + aside)) - borne(&(found - aside))) / (2.0 * ASIDE)));
            if tangent.column(column) == Vector4::zeros() {
                (tangent[(column, column)], residual[column]) = (1.0, 0.0);
            }
        }
        let correction = tangent.lu().solve(&residual)?;
        found += correction;
        if correction.amax() <= CONVERGED * found.amax() {
            return Some(strains_of(&found.component_mul(&scales)));
        }
    }
    None
}

/// Corrections after which a section whose law is not linear is given up.
const MOST_CORRECTIONS: usize = 12;
/// Strains on both sides between which a section is taken as linear, 1.
const ASIDE: f64 = 1e-6;
/// A correction of this share of the strains is round-off.
const CONVERGED: f64 = 1e-13;

fn vector_of_forces(&SectionForces { axial, moment: [torque, about_y, about_z] }: &SectionForces) -> Vector4<f64> {
    Vector4::new(axial, torque, about_y, about_z)
}

fn vector_of_strains(
    &SectionStrains { axial, torsion, curvature: [about_y, about_z] }: &SectionStrains,
) -> Vector4<f64> {
    Vector4::new(axial, torsion, about_y, about_z)
}

fn strains_of(vector: &Vector4<f64>) -> SectionStrains {
    SectionStrains { axial: vector[0], torsion: vector[1], curvature: [vector[2], vector[3]] }
}

/// Strains whose elastic forces would be the viscous ones of the section of `element` at `xi`, where the strains of its
/// points have the rates `rates`.
pub fn viscous(element: &Element, xi: f64, rates: &[f64; STRAINS]) -> SectionStrains {
    let [tension, all] = element.viscosities();
    let along = |weights: [f64; 3], first: usize, stride: usize| -> f64 {
        weights.iter().enumerate().map(|(point, weight)| weight * rates[first + stride * point]).sum()
    };
    let of_points = lagrange(&GAUSS_POINTS, xi);
    let [about_z, minus_about_y, torsion] = [0, 1, 2].map(|strain| all * along(of_points, 3 + strain, 3));
    SectionStrains {
        axial: tension * along(lagrange(&LOBATTO_POINTS, xi), 0, 1),
        // The strains of points are those in principal axes.
        curvature: turned([-minus_about_y, about_z], -element.section_at(xi).principal),
        torsion,
    }
}

/// Turn of the section at `xi` of `element`, whose twist is linear, under the torque `torque`, N m, of its sections,
/// rad: the twist of the torque less the mean one, the torsion being a parabola of the element.
pub fn turn_of_torque(element: &Element, xi: f64, torque: &dyn Fn(f64) -> f64) -> f64 {
    let torsion = LOBATTO_POINTS.map(|xi| torque(xi) / element.section_at(xi).stiffness.torsion);
    let weighted = |weights: [f64; 3]| -> f64 { weights.iter().zip(torsion).map(|(weight, own)| weight * own).sum() };
    let (square, cube) = (xi * xi, xi * xi * xi);
    let up_to =
        [xi - 1.5 * square + 2.0 / 3.0 * cube, 2.0 * square - 4.0 / 3.0 * cube, 2.0 / 3.0 * cube - 0.5 * square];
    let turn = element.length * (weighted(up_to) - xi * weighted(LOBATTO_WEIGHTS));
    // Of a section that nothing resists, the turn is not known.
    if turn.is_finite() { turn } else { 0.0 }
}

/// The components about y and z along axes that are turned by `angle`, rad, about the tangent.
pub(super) fn turned([about_y, about_z]: [f64; 2], angle: f64) -> [f64; 2] {
    if angle == 0.0 {
        return [about_y, about_z];
    }
    let (sin, cos) = sin_cos(angle);
    [cos * about_y + sin * about_z, cos * about_z - sin * about_y]
}

/// Force and moments at the strains `strains` in principal axes, couplings of large strain included.
pub fn forces(stiffness: &Stiffness, strains: &SectionStrains) -> SectionForces {
    let of_energy = strains_of_energy(stiffness, strains);
    let (stretching, bending) = (stiffness.at_axial_point(), stiffness.at_bending_point());
    let by_strain = bending::gradient(&bending, &of_energy)
        + torsion::gradient(&bending, &of_energy)
        + fourth_moments::gradient(&bending, &of_energy);
    let [by_axial, by_torsion] = match stiffness.strain {
        Strain::Small => [axial::small::force(&stretching, strains.axial), 0.0],
        Strain::Large | Strain::LargeTruncated => {
            axial::large::gradient(&stretching, of_energy[3], strains.torsion).into()
        }
    };
    SectionForces {
        axial: (by_axial + by_strain[3]) * stretch(stiffness, strains),
        moment: [by_torsion + by_strain[2], -by_strain[1], by_strain[0]],
    }
}

/// The derivative of the axial strain of the energy by the elongation, 1: Green's strain grows by `|r'|` with it.
fn stretch(stiffness: &Stiffness, strains: &SectionStrains) -> f64 {
    match stiffness.strain {
        Strain::Small => 1.0,
        Strain::Large | Strain::LargeTruncated => 1.0 + strains.axial,
    }
}

/// The same strains in the order and with the signs of the energy densities (`g1` the curvature about z, `−g2` the one
/// about y); the axial one is Green's where the energy's is.
fn strains_of_energy(stiffness: &Stiffness, strains: &SectionStrains) -> Strains {
    let [about_y, about_z] = strains.curvature;
    let axial = match stiffness.strain {
        Strain::Small => strains.axial,
        Strain::Large | Strain::LargeTruncated => strains.axial + 0.5 * strains.axial * strains.axial,
    };
    Strains::new(about_z, -about_y, strains.torsion, axial)
}
