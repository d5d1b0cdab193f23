//! The element's energy written a second time, straight from the definitions, over any dual number: automatic
//! differentiation of it is the oracle for the closed gradient and Hessian. It shares no formula with the closed form
//! but the definitions: vectors in space instead of components, no derivative by hand.

use ancf14::mechanics::beam::ancf14::element::Element;
use ancf14::mechanics::beam::ancf14::strain::Strain;
use ancf14::mechanics::geometry::triad::Triad;
use num_dual::DualNum;

/// Any dual number over f64.
pub trait Scalar: DualNum<Primitive = f64> + Copy {}
impl<D: DualNum<Primitive = f64> + Copy> Scalar for D {}

type Vector<D> = [D; 3];

pub fn constant<D: Scalar>(v: &ancf14::math::Vec3) -> Vector<D> {
    [D::from(v[0]), D::from(v[1]), D::from(v[2])]
}

pub fn dot<D: Scalar>(a: &Vector<D>, b: &Vector<D>) -> D {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross<D: Scalar>(a: &Vector<D>, b: &Vector<D>) -> Vector<D> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn scale<D: Scalar>(a: &Vector<D>, factor: D) -> Vector<D> {
    a.map(|x| x * factor)
}

pub fn sum<D: Scalar>(a: &Vector<D>, b: &Vector<D>) -> Vector<D> {
    std::array::from_fn(|i| a[i] + b[i])
}

/// P(a, b) w (MECHANICS 2.2).
pub fn carry<D: Scalar>(a: &Vector<D>, b: &Vector<D>, w: &Vector<D>) -> Vector<D> {
    let factor = -(dot(b, w) / (dot(a, b) + 1.0));
    sum(w, &scale(&sum(a, b), factor))
}

/// t, u and section axes y, z of a node (2.1-2.4).
pub struct Node<D> {
    pub t: Vector<D>,
    pub u: Vector<D>,
    pub y: Vector<D>,
    pub z: Vector<D>,
}

pub fn node<D: Scalar>(q: &[D], triad: &Triad) -> Node<D> {
    let p = [q[3], q[4], q[5]];
    let stretch = dot(&p, &p).sqrt();
    let t = scale(&p, stretch.recip());
    let u = carry(&constant(&triad.t), &t, &constant(&triad.u));
    let v = cross(&t, &u);
    let (sin, cos) = q[6].sin_cos();
    let y = sum(&scale(&u, cos), &scale(&v, sin));
    let z = cross(&t, &y);
    Node { t, u, y, z }
}

fn interpolate<D: Scalar>(weights: &[f64; 4], q: &[D]) -> Vector<D> {
    std::array::from_fn(|i| q[i] * weights[0] + q[3 + i] * weights[1] + q[7 + i] * weights[2] + q[10 + i] * weights[3])
}

/// Section axes at `xi` inside the element (2.10-2.13, with the internal coordinate `bubble` of 5.3), and the total
/// twist T.
pub fn inside<D: Scalar>(
    element: &Element,
    q: &[D],
    bubble: D,
    triads: &[Triad; 2],
    previous: f64,
    xi: f64,
) -> (Vector<D>, Vector<D>, D) {
    let (first, second) = (node(&q[..7], &triads[0]), node(&q[7..], &triads[1]));
    let rates: [D; 3] = std::array::from_fn(|g| {
        let p = interpolate(&element.bending[g].shape_x, q);
        let w = interpolate(&element.bending[g].shape_xx, q);
        let length = dot(&p, &p).sqrt();
        let t = scale(&p, length.recip());
        -(dot(&first.t, &cross(&p, &w)) / (length * length * (dot(&first.t, &t) + 1.0)))
    });
    let carried = carry(&first.t, &second.t, &first.u);
    let (s, c) = (dot(&second.u, &cross(&second.t, &carried)), dot(&second.u, &carried));
    let beta = (s * previous.cos() - c * previous.sin()).atan2(c * previous.cos() + s * previous.sin()) + previous;
    let weights = ancf14::math::quadrature::GAUSS_WEIGHTS;
    let twist =
        q[13] - q[6] + beta + (rates[0] * weights[0] + rates[1] * weights[1] + rates[2] * weights[2]) * element.length;
    let inner = ancf14::math::quadrature::collocation(xi);
    let alpha = q[6] + twist * xi - (rates[0] * inner[0] + rates[1] * inner[1] + rates[2] * inner[2]) * element.length
        + bubble * (4.0 * xi * (1.0 - xi));
    let p = interpolate(&ancf14::math::hermite::shape_x(xi, element.length), q);
    let t = scale(&p, dot(&p, &p).sqrt().recip());
    let u = carry(&first.t, &t, &first.u);
    let v = cross(&t, &u);
    let (sin, cos) = alpha.sin_cos();
    let y = sum(&scale(&u, cos), &scale(&v, sin));
    (t, y, twist)
}

/// Strains, undeformed values taken off (MECHANICS 2.16): three axial points, then g1, g2, tau of each bending point.
pub fn strains<D: Scalar>(element: &Element, q: &[D], bubble: D, triads: &[Triad; 2], previous: f64) -> [D; 12] {
    let mut all = [D::from(0.0); 12];
    for (m, point) in element.axial.iter().enumerate() {
        let p = interpolate(&point.shape_x, q);
        let square = dot(&p, &p) / (point.reference_stretch * point.reference_stretch);
        all[m] = match element.stiffness.strain {
            Strain::Small => square.sqrt() - 1.0,
            _ => (square - 1.0) * 0.5,
        };
    }
    for (g, point) in element.bending.iter().enumerate() {
        let j0 = point.reference_stretch;
        let (t, y, twist) = inside(element, q, bubble, triads, previous, point.xi);
        let z = cross(&t, &y);
        // Along the principal axes.
        let (sin, cos) = point.principal.sin_cos();
        let [y, z] = [
            sum(&scale(&y, cos.into()), &scale(&z, sin.into())),
            sum(&scale(&z, cos.into()), &scale(&y, (-sin).into())),
        ];
        let p = interpolate(&point.shape_x, q);
        let w = interpolate(&point.shape_xx, q);
        let length = dot(&p, &p).sqrt();
        all[3 + 3 * g] = dot(&y, &w) / length / j0 - point.reference[0];
        all[4 + 3 * g] = dot(&z, &w) / length / j0 - point.reference[1];
        let twist_xi = twist + bubble * (4.0 * (1.0 - 2.0 * point.xi));
        all[5 + 3 * g] = twist_xi / (element.length * j0) - point.reference[2];
    }
    all
}

/// Strain energy, J (MECHANICS 3.1, 3.2, 3.2b, 3.2c).
pub fn energy<D: Scalar>(element: &Element, q: &[D], bubble: D, triads: &[Triad; 2], previous: f64) -> D {
    let square = |x: D| x * x;
    let mut total = D::from(0.0);
    let strains = strains(element, q, bubble, triads, previous);
    let twist = inside(element, q, bubble, triads, previous, 0.5).2;
    for (m, point) in element.axial.iter().enumerate() {
        let k = &point.stiffness;
        let torsion = twist / (element.length * point.reference_stretch) - point.reference_torsion;
        total +=
            (square(strains[m]) * (0.5 * k.axial) + square(torsion) * strains[m] * (0.5 * k.wagner)) * point.weight;
    }
    for (g, point) in element.bending.iter().enumerate() {
        let k = &point.stiffness;
        let e = strains[0] * point.from_axial[0] + strains[1] * point.from_axial[1] + strains[2] * point.from_axial[2];
        let factor = match k.strain {
            Strain::Small => D::from(1.0),
            _ => e * 3.0 + 1.0,
        };
        let [yyyy, yyzz, zzzz] = k.fourth;
        let [g1, g2, tau] = [3, 4, 5].map(|i| square(strains[3 * g + i]));
        let fourth = square(tau) * (yyyy + 2.0 * yyzz + zzzz)
            + tau * (g1 * (yyyy + yyzz) + g2 * (zzzz + yyzz)) * 2.0
            + square(g1) * yyyy
            + g1 * g2 * (6.0 * yyzz)
            + square(g2) * zzzz;
        total += (factor * 0.5 * (g1 * k.bending_z + g2 * k.bending_y) + tau * (0.5 * k.torsion) + fourth * 0.125)
            * point.weight;
        if let Some(all) = &element.eccentricities {
            let ([s1, s2], [yyy, yyz, yzz, zzz]) = (all[g].first, all[g].third);
            let [g1, g2, tau] = [3, 4, 5].map(|i| strains[3 * g + i]);
            // ∫ y g r² dA and ∫ (y g)³ dA, one product after the other.
            let with_torsion = g1 * yyy + g1 * yzz + g2 * yyz + g2 * zzz;
            let cube =
                g1 * g1 * g1 * yyy + g1 * g1 * g2 * (3.0 * yyz) + g1 * g2 * g2 * (3.0 * yzz) + g2 * g2 * g2 * zzz;
            let stretch = match k.strain {
                Strain::Small => D::from(1.0),
                _ => (e * 2.0 + 1.0).sqrt(),
            };
            let odd = e * stretch * (g1 * s1 + g2 * s2) + square(tau) * with_torsion * 0.5 + cube * 0.5;
            total -= odd * point.weight;
        }
    }
    total
}
