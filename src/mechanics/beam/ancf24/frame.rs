//! The section's triad from its gradients: `y` along `r_y`, `z` along what of `r_z` is perpendicular to it, `t = y × z`
//! its normal.
//!
//! Not along `r_x`: the axis leans against the section by its shear. What holds or turns a section must hold `r_y` and
//! `r_z`, to which bending moments belong; held by its tangent alone, a beam can bend at a clamp as if it were hinged,
//! the more the finer the mesh.

use super::coordinates::{Y, Z};
use crate::math::rotation::normal_projector;
use crate::math::vectors::vec3;
use crate::math::{Mat3, Vec3};
use crate::mechanics::geometry::marker_jacobian::{ByCoordinates, MarkerMatrix};

/// Where a vector comes from: first coordinates of vectors, with their weights.
pub type Sources<'a> = &'a [(usize, f64)];

/// The triad of a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionFrame {
    /// Its axes `[t y z]`.
    pub axes: Mat3,
    /// `|r_y|`, 1.
    width: f64,
    /// Length of what of `r_z` is perpendicular to `y`, 1.
    height: f64,
    /// `y · r_z`, 1.
    lean: f64,
}

/// `r_y` and `r_z` of a node.
const OF_NODE: [Sources; 2] = [&[(Y, 1.0)], &[(Z, 1.0)]];

impl SectionFrame {
    /// Of the gradients `r_y` and `r_z`.
    pub fn new(r_y: &Vec3, r_z: &Vec3) -> Self {
        let width = r_y.norm();
        let y = r_y / width;
        let lean = y.dot(r_z);
        let across = r_z - y * lean;
        let height = across.norm();
        let z = across / height;
        Self { axes: Mat3::from_columns(&[y.cross(&z), y, z]), width, height, lean }
    }

    /// Of a node whose coordinates `q` begins with.
    pub fn of_node(q: &[f64]) -> Self {
        Self::new(&vec3(q, Y), &vec3(q, Z))
    }

    fn axis(&self, number: usize) -> Vec3 {
        self.axes.column(number).into_owned()
    }

    /// Derivative of the turn by `r_y` and by `r_z`: `y × δy + y (t·δr_z − (y·r_z) t·δy)/|r_z⊥|`.
    pub fn turn_by(&self) -> [Mat3; 2] {
        let (t, y) = (self.axis(0), self.axis(1));
        let spin = y * t.transpose();
        [(y.cross_matrix() - spin * (self.lean / self.height)) / self.width, spin / self.height]
    }

    /// Derivatives by `r_y` and `r_z` of the generalized forces on `r_y` and on `r_z` of the moment `moment`, N m,
    /// frozen in space: `Q_y = m × y/|r_y| − t (y·m)(y·r_z)/(|r_y| |r_z⊥|)`, `Q_z = t (y·m)/|r_z⊥|`.
    fn moment_force_by(&self, moment: &Vec3) -> [[Mat3; 2]; 2] {
        let [t, y, z] = [0, 1, 2].map(|number| self.axis(number));
        let Self { width, height, lean, .. } = *self;
        let along = y.dot(moment);
        let by = self.turn_by();
        let y_by = normal_projector(&y) / width;
        // What each part changes by, with r_y and with r_z.
        let t_by = by.map(|turn| -t.cross_matrix() * turn);
        let along_by = [y_by * moment, Vec3::zeros()];
        let lean_by = [y_by * z * height, y];
        // r_z turns with the triad but for what it is changed by itself.
        let height_by = [-by[0].tr_mul(&t) * lean, z - by[1].tr_mul(&t) * lean];
        let width_by = [y, Vec3::zeros()];
        let tilt = moment.cross(&y) / width;
        let tilt_by = [(moment.cross_matrix() * y_by - tilt * y.transpose()) / width, Mat3::zeros()];
        let factor = along * lean / (width * height);
        let on_y = |i: usize| {
            let factor_by = (along_by[i] * lean + lean_by[i] * along) / (width * height)
                - (width_by[i] / width + height_by[i] / height) * factor;
            tilt_by[i] - t_by[i] * factor - t * factor_by.transpose()
        };
        let on_z = |i: usize| {
            let factor_by = along_by[i] / height - height_by[i] * (along / (height * height));
            t_by[i] * (along / height) + t * factor_by.transpose()
        };
        [[on_y(0), on_y(1)], [on_z(0), on_z(1)]]
    }

    /// `∂φ/∂q` where `r_y` and `r_z` have these `sources`: columns of their coordinates, the others zero.
    pub fn turn_q(&self, sources: [Sources; 2]) -> ByCoordinates {
        let mut turn_q = ByCoordinates::zeros();
        for (by, sources) in self.turn_by().iter().zip(sources) {
            for (place, weight) in sources {
                turn_q.fixed_columns_mut::<3>(*place).copy_from(&(by * *weight));
            }
        }
        turn_q
    }

    /// Adds `∂(turn_qᵀ m)/∂q` of the moment `moment`, N m, frozen in space to `sum`.
    pub fn add_moment_stiffness(&self, moment: &Vec3, sources: [Sources; 2], sum: &mut MarkerMatrix) {
        let by = self.moment_force_by(moment);
        for (rows, by) in sources.into_iter().zip(&by) {
            for (columns, by) in sources.into_iter().zip(by) {
                for (row, left) in rows {
                    for (column, right) in columns {
                        let mut view = sum.fixed_view_mut::<3, 3>(*row, *column);
                        view += by * (left * right);
                    }
                }
            }
        }
    }

    /// [`Self::turn_q`] of a node.
    pub fn node_turn_q(&self) -> ByCoordinates {
        self.turn_q(OF_NODE)
    }

    /// [`Self::add_moment_stiffness`] of a node.
    pub fn add_node_moment_stiffness(&self, moment: &Vec3, sum: &mut MarkerMatrix) {
        self.add_moment_stiffness(moment, OF_NODE, sum);
    }
}
