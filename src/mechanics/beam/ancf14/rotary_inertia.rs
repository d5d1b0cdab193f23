//! Rotary inertia of sections that resist a turn about y and one about z differently (MECHANICS 3.3b).
//!
//! The smaller of both moments belongs to every turn of the tangent and is part of the constant mass matrix. The rest
//! belongs to turns of the tangent towards one axis of the section, `d`, and follows the section:
//! `T = ½ ∫ ρΔI (d·ṙ')² dx`. Between the nodes, `d dᵀ` is interpolated linearly.

use super::coordinates::{ELEMENT, ElementVector, NODE, P, SHAPE_PLACES, THETA};
use super::frame::NodeFrame;
use crate::math::elementary::{atan2, sin_cos};
use crate::math::quadrature::{FIVE_POINTS, FIVE_WEIGHTS};
use crate::math::vectors::{add_vec3, vec3};
use crate::math::{Vec3, hermite};

/// Second moments of mass per length, kg m: `[∫ρ y² dA, ∫ρ z² dA, ∫ρ y z dA]`.
pub type MassMoments = [f64; 3];

/// Moments whose difference is a smaller share than this are equal: round-off of their integrals.
const EQUAL: f64 = 1e-12;

/// Products of slopes, kg, kg m and kg m².
type Products = [[f64; 4]; 4];

/// The part of the rotary inertia that follows the section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotaryInertia {
    /// Cosine and sine of the angle from the section's y to `d`.
    axis: [f64; 2],
    /// `∫ ρΔI N'_a N'_b φ_n dx` of both nodes, with `φ` from 1 at the node to 0 at the other one.
    products: [Products; 2],
}

/// A node as this inertia sees it.
struct Seen {
    /// The axis `d`, `e = t × d`, and the tangent.
    d: Vec3,
    e: Vec3,
    t: Vec3,
    /// The `k` of its chart over its stretch, and one over the stretch.
    k: Vec3,
    by_stretch: f64,
}

impl Seen {
    /// The change of `d` with `slope` and `theta`: `−(t d·p + e k·p)/|p| + e theta`.
    fn change(&self, slope: &Vec3, theta: f64) -> Vec3 {
        self.e * (theta - self.k.dot(slope)) - self.t * (self.d.dot(slope) * self.by_stretch)
    }

    /// The transposed of [`Self::change`]: along the slope and along theta.
    fn force(&self, by_d: &Vec3) -> (Vec3, f64) {
        let along = self.e.dot(by_d);
        (-self.d * (self.t.dot(by_d) * self.by_stretch) - self.k * along, along)
    }
}

/// The constant part of the rotary inertia `moments` at [`FIVE_POINTS`] of an element of `length` m,
/// `∫ ρI N'_a N'_b dx`; the inertia of both parts that each point stands for, kg m²; and the part that follows the
/// section, if there is one.
pub fn rotary_inertia(moments: [MassMoments; 5], length: f64) -> (Products, [[f64; 2]; 5], Option<RotaryInertia>) {
    let mut sum = [0.0; 3];
    for (moments, weight) in moments.iter().zip(FIVE_WEIGHTS) {
        sum.iter_mut().zip(moments).for_each(|(sum, moment)| *sum += weight * moment);
    }
    let axis = largest_axis(&sum);
    let [cos, sin] = axis;
    let (mut constant, mut products) = ([[0.0; 4]; 4], [[[0.0; 4]; 4]; 2]);
    let (mut follows, mut points) = (false, [[0.0; 2]; 5]);
    for (((xi, weight), [yy, zz, yz]), point) in FIVE_POINTS.into_iter().zip(FIVE_WEIGHTS).zip(moments).zip(&mut points)
    {
        let (along, across) = (
            cos * cos * yy + 2.0 * cos * sin * yz + sin * sin * zz,
            sin * sin * yy - 2.0 * cos * sin * yz + cos * cos * zz,
        );
        let (shape_x, rest) = (hermite::shape_x(xi, length), along - across);
        follows |= rest.abs() > EQUAL * across;
        *point = [across, rest].map(|own| length * weight * own);
        for a in 0..4 {
            for b in 0..4 {
                let product = length * weight * shape_x[a] * shape_x[b];
                constant[a][b] += across * product;
                products[0][a][b] += (1.0 - xi) * rest * product;
                products[1][a][b] += xi * rest * product;
            }
        }
    }
    (constant, points, follows.then_some(RotaryInertia { axis, products }))
}

/// Cosine and sine of the angle from y to the axis along which the moment is largest.
fn largest_axis(&[yy, zz, yz]: &MassMoments) -> [f64; 2] {
    match (yz == 0.0, yy >= zz) {
        (true, true) => [1.0, 0.0],
        (true, false) => [0.0, 1.0],
        (false, _) => {
            let (sin, cos) = sin_cos(0.5 * atan2(2.0 * yz, yy - zz));
            [cos, sin]
        }
    }
}

impl RotaryInertia {
    /// `d` along the `u` and `v` of a node.
    #[inline]
    fn turn(&self, frame: &NodeFrame) -> [f64; 2] {
        let ([cos, sin], [cos_theta, sin_theta]) = (self.axis, frame.turn);
        [cos * cos_theta - sin * sin_theta, cos * sin_theta + sin * cos_theta]
    }

    /// `d` at a node.
    #[inline]
    fn axis(&self, frame: &NodeFrame) -> Vec3 {
        let [along_u, along_v] = self.turn(frame);
        frame.u * along_u + frame.v * along_v
    }

    #[inline]
    fn seen(&self, frame: &NodeFrame) -> Seen {
        let [along_u, along_v] = self.turn(frame);
        Seen {
            d: frame.u * along_u + frame.v * along_v,
            e: frame.v * along_u - frame.u * along_v,
            t: frame.t,
            k: frame.k / frame.stretch,
            by_stretch: 1.0 / frame.stretch,
        }
    }

    /// Calls `with` for each node with its number, how it is seen, and its products.
    #[inline]
    fn each_node(&self, frames: [&NodeFrame; 2], mut with: impl FnMut(usize, &Seen, &Products)) {
        for (node, (frame, products)) in frames.into_iter().zip(&self.products).enumerate() {
            with(node, &self.seen(frame), products);
        }
    }

    /// Adds `factor D` to the column-major `block`, 14×14.
    #[inline]
    pub fn add(&self, frames: [&NodeFrame; 2], factor: f64, block: &mut [f64]) {
        let (columns, _) = block.as_chunks_mut::<ELEMENT>();
        let squares = frames.map(|frame| {
            let d = self.axis(frame);
            d * d.transpose() * factor
        });
        for (b, start) in SHAPE_PLACES.into_iter().enumerate() {
            for j in 0..3 {
                let column = &mut columns[start + j];
                for (a, row) in SHAPE_PLACES.into_iter().enumerate() {
                    let [first, second] = [self.products[0][a][b], self.products[1][a][b]];
                    for i in 0..3 {
                        column[row + i] += first * squares[0][(i, j)] + second * squares[1][(i, j)];
                    }
                }
            }
        }
    }

    /// Adds the matrix that acts along all axes as `D` does along `d` to the column-major `block`, 14×14.
    pub fn add_everywhere(&self, block: &mut [f64]) {
        for (b, column) in SHAPE_PLACES.into_iter().enumerate() {
            for (a, row) in SHAPE_PLACES.into_iter().enumerate() {
                let product = self.products[0][a][b] + self.products[1][a][b];
                (0..3).for_each(|axis| block[(column + axis) * ELEMENT + row + axis] += product);
            }
        }
    }

    /// Adds the product of the matrix of [`Self::add_everywhere`], less `D`, with `vector` (14) to `product` (14).
    #[inline]
    pub fn add_lacking_times(&self, frames: [&NodeFrame; 2], vector: &[f64], product: &mut [f64]) {
        let vectors = shapes(vector);
        let [d_0, d_1] = frames.map(|frame| self.axis(frame));
        let [first, second] = [(0, &d_0), (1, &d_1)].map(|(node, d)| multiply(&self.products[node], &vectors, d));
        for (a, start) in SHAPE_PLACES.into_iter().enumerate() {
            let both = [0, 1, 2, 3].map(|b| self.products[0][a][b] + self.products[1][a][b]);
            add_vec3(product, start, &(weighted(&vectors, &both) - d_0 * first[a] - d_1 * second[a]));
        }
    }

    /// Adds `factor D vector` to `product`; both have 14 numbers.
    #[inline]
    pub fn add_times(&self, frames: [&NodeFrame; 2], factor: f64, vector: &[f64], product: &mut [f64]) {
        let vectors = shapes(vector);
        let [d_0, d_1] = frames.map(|frame| self.axis(frame));
        let [first, second] = [(0, &d_0), (1, &d_1)].map(|(node, d)| multiply(&self.products[node], &vectors, d));
        for (a, start) in SHAPE_PLACES.into_iter().enumerate() {
            add_vec3(product, start, &(d_0 * (factor * first[a]) + d_1 * (factor * second[a])));
        }
    }

    /// `vectorᵀ D vector`.
    pub fn form(&self, frames: [&NodeFrame; 2], vector: &[f64]) -> f64 {
        let vectors = shapes(vector);
        let of_node = |(frame, products): (&NodeFrame, &Products)| {
            let d = self.axis(frame);
            let momenta = multiply(products, &vectors, &d);
            vectors.iter().zip(momenta).map(|(vector, momentum)| vector.dot(&d) * momentum).sum::<f64>()
        };
        frames.into_iter().zip(&self.products).map(of_node).sum()
    }

    /// Adds `factor ∂T/∂q` with the velocities `velocity` to `forces`; both have 14 numbers.
    #[inline]
    pub fn add_gradient(&self, frames: [&NodeFrame; 2], factor: f64, velocity: &[f64], forces: &mut [f64]) {
        let velocities = shapes(velocity);
        self.each_node(frames, |node, seen, products| {
            let by_d = weighted(&velocities, &multiply(products, &velocities, &seen.d));
            let (slope, theta) = seen.force(&(by_d * factor));
            add_vec3(forces, node * NODE + P, &slope);
            forces[node * NODE + THETA] += theta;
        });
    }

    /// `dD/dt v` with the velocities `velocity` (14), 14×1.
    pub fn rate_times(&self, frames: [&NodeFrame; 2], velocity: &[f64]) -> ElementVector {
        let (velocities, mut sum) = (shapes(velocity), ElementVector::zeros());
        self.each_node(frames, |node, seen, products| {
            let rate = seen.change(&vec3(velocity, node * NODE + P), velocity[node * NODE + THETA]);
            let momenta =
                multiply(products, &velocities, &seen.d).into_iter().zip(multiply(products, &velocities, &rate));
            for (start, (along_d, along_rate)) in SHAPE_PLACES.into_iter().zip(momenta) {
                add_vec3(sum.as_mut_slice(), start, &(seen.d * along_rate + rate * along_d));
            }
        });
        sum
    }

    /// The axis `d` of both nodes, with its rate at the velocities `velocity` (14).
    pub fn axes(&self, frames: [&NodeFrame; 2], velocity: &[f64]) -> [[Vec3; 2]; 2] {
        [0, 1].map(|node| {
            let seen = self.seen(frames[node]);
            [seen.d, seen.change(&vec3(velocity, node * NODE + P), velocity[node * NODE + THETA])]
        })
    }

    /// Adds `factor (B − Bᵀ)` to the column-major `block`, 14×14, where `B` has the derivatives of `D v` with respect
    /// to the angles of both nodes, at the velocities `velocity` (14). Those with respect to the slopes act along the
    /// tangent, where the beam is stiff: Newton's iteration does not miss them.
    #[inline]
    pub fn add_gyroscopic(&self, frames: [&NodeFrame; 2], velocity: &[f64], factor: f64, block: &mut [f64]) {
        let (velocities, (columns, _)) = (shapes(velocity), block.as_chunks_mut::<ELEMENT>());
        self.each_node(frames, |node, seen, products| {
            let column = node * NODE + THETA;
            let [along_d, along_e] = [seen.d, seen.e].map(|axis| multiply(products, &velocities, &axis));
            for ((row, along_d), along_e) in SHAPE_PLACES.into_iter().zip(along_d).zip(along_e) {
                let part = (seen.d * along_e + seen.e * along_d) * factor;
                for i in 0..3 {
                    columns[column][row + i] += part[i];
                    columns[row + i][column] -= part[i];
                }
            }
        });
    }
}

/// `X_a` of an element's coordinates.
fn shapes(vector: &[f64]) -> [Vec3; 4] {
    SHAPE_PLACES.map(|start| vec3(vector, start))
}

/// `Σ_b products_ab v_b · d`.
#[inline]
fn multiply(products: &Products, vectors: &[Vec3; 4], d: &Vec3) -> [f64; 4] {
    let along = vectors.each_ref().map(|vector| vector.dot(d));
    products.each_ref().map(|row| row.iter().zip(&along).map(|(product, along)| product * along).sum())
}

/// `Σ_a weight_a v_a`.
#[inline]
fn weighted(vectors: &[Vec3; 4], weights: &[f64; 4]) -> Vec3 {
    vectors.iter().zip(weights).fold(Vec3::zeros(), |sum, (vector, weight)| sum + vector * *weight)
}
