//! A round rod in space, straight without stress and clamped at its start, whose end is turned about its tangent:
//! integrated by Runge and Kutta's method and shot at the end.

use crate::integrate::runge_kutta;
use ancf14::math::Vec3;
use nalgebra::{SMatrix, SVector};

/// A rod along x; the end comes to lie on the axis, or closes a ring.
pub struct TwistedRod {
    /// `E I`, N m².
    pub bending: f64,
    /// `G J`, N m².
    pub torsion: f64,
    /// `E A`, N.
    pub stretching: f64,
    pub length: f64,
    /// Whether the end is at the start: else it slides along x.
    pub is_ring: bool,
    /// Middle of the rod as drawn, m.
    pub middle: Vec3,
}

/// An equilibrium as another code has found it.
pub struct Point {
    /// Displacement of the middle, m.
    pub middle: Vec3,
    /// Turn of the end, rad.
    pub turn: f64,
    /// What holds the start exerts, N and N m.
    pub start: [Vec3; 2],
}

/// Steps of the integration.
const STEPS: usize = 400;
/// Force, moment, turn.
const UNKNOWNS: usize = 7;
/// Place (3), tangent (2), turn of the end; middle and quarter stay in the plane; across the way.
const CONDITIONS: usize = 9;

/// Place, tangent, a normal that is fixed to the rod, moment that the part behind exerts.
type State = [Vec3; 4];

impl TwistedRod {
    /// The largest distance of inner `points` from the path of this rod, in the plane across the way from the point
    /// before to the point after: displacements over the length, turns over a whole one.
    pub fn distance_from(&self, points: &[Point]) -> f64 {
        let mut worst = 0.0;
        for three in points.windows(3) {
            let [before, own, after] = [0, 1, 2].map(|k| self.scaled(&three[k].middle, three[k].turn));
            let way = after - before;
            let [force, moment] = three[1].start.map(|own| -own);
            let mut unknowns = SVector::<f64, UNKNOWNS>::zeros();
            unknowns.fixed_rows_mut::<3>(0).copy_from(&force);
            unknowns.fixed_rows_mut::<3>(3).copy_from(&moment);
            unknowns[6] = three[1].turn;
            let mut place = own;
            for _ in 0..20 {
                let (residual, here) = self.residual(&unknowns, &own, &way);
                place = here;
                if residual.norm() < 1e-10 {
                    break;
                }
                let mut jacobian = SMatrix::<f64, CONDITIONS, UNKNOWNS>::zeros();
                for column in 0..UNKNOWNS {
                    let size = [self.bending / self.length.powi(2), self.bending / self.length, 1.0][column / 3];
                    let mut moved = unknowns;
                    moved[column] += 1e-6 * size;
                    let moved = self.residual(&moved, &own, &way).0;
                    jacobian.set_column(column, &((moved - residual) / (1e-6 * size)));
                }
                // Of the equilibria that are alike but for a turn, or a shift along the ring, middle and quarter choose
                // one: more conditions than unknowns.
                let change = jacobian.svd(true, true).solve(&residual, 1e-12).expect("both factors are there");
                unknowns -= change;
            }
            let left = self.residual(&unknowns, &own, &way).0.norm();
            assert!(left < 1e-8, "the rod found no equilibrium near {own:?}: {left}");
            worst = f64::max(worst, (own - place).norm());
        }
        worst
    }

    fn scaled(&self, middle: &Vec3, turn: f64) -> SVector<f64, 4> {
        let middle = middle / self.length;
        SVector::<f64, 4>::new(middle.x, middle.y, middle.z, turn / std::f64::consts::TAU)
    }

    /// What the end is off by, and how far the middle is from the plane through `own` across `way`; and where the
    /// middle is.
    fn residual(
        &self,
        unknowns: &SVector<f64, UNKNOWNS>,
        own: &SVector<f64, 4>,
        way: &SVector<f64, 4>,
    ) -> (SVector<f64, CONDITIONS>, SVector<f64, 4>) {
        let part = |first: usize| Vec3::new(unknowns[first], unknowns[first + 1], unknowns[first + 2]);
        let (force, moment, turn) = (part(0), part(3), unknowns[6]);
        let mut state = [Vec3::zeros(), Vec3::x(), Vec3::y(), moment];
        let (mut middle, mut quarter) = (Vec3::zeros(), 0.0);
        for step in 0..STEPS {
            if 4 * step == STEPS && self.is_ring {
                quarter = state[0].z;
            }
            if 2 * step == STEPS {
                middle = state[0] - self.middle;
            }
            state = self.advanced(&state, &force);
        }
        let [place, tangent, normal, _] = state;
        let (sine, cosine) = turn.sin_cos();
        let here = self.scaled(&middle, turn);
        // Where the end slides nothing pulls along.
        let along = if self.is_ring { place.x } else { force.x * self.length.powi(2) / self.bending };
        let conditions = [
            along,
            place.y,
            place.z,
            tangent.y,
            tangent.z,
            normal.z * cosine - normal.y * sine,
            middle.z,
            quarter,
            (here - own).dot(way),
        ];
        (SVector::from(conditions), here)
    }

    /// The state a step further on; `force` is what the part behind exerts, the same everywhere.
    fn advanced(&self, state: &State, force: &Vec3) -> State {
        let slope = |[_, tangent, normal, moment]: &State| -> State {
            let twisting = moment.dot(tangent);
            let turn = (moment - tangent * twisting) / self.bending + tangent * (twisting / self.torsion);
            let along = tangent * (1.0 + force.dot(tangent) / self.stretching);
            [along, turn.cross(tangent), turn.cross(normal), force.cross(&along)]
        };
        runge_kutta(state, self.length / STEPS as f64, slope)
    }
}
