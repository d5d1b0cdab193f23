//! Frames and arches as extensible rods in a plane, integrated by Runge and Kutta's method and shot at the far end: the
//! equilibrium near a given one.
//!
//! The plane is that of x and z; angles go from x to z, against turns about y.

use crate::integrate::runge_kutta;
use nalgebra::{Matrix4, Vector4};

/// A rod from one support to another.
pub struct Rod {
    /// `E I`, N m².
    pub bending: f64,
    /// `E A`, N.
    pub stretching: f64,
    /// Angle of the tangent at the start as drawn, rad.
    pub angle: f64,
    pub supports: [Support; 2],
    /// From the start to the end.
    pub pieces: Vec<Piece>,
    pub load: Load,
    /// Whether the load turns with the rod.
    pub follower: bool,
    /// What distances are compared with: a length (m) and a load (N or N/m).
    pub scales: [f64; 2],
}

/// What holds an end.
#[derive(Clone, Copy, PartialEq)]
pub enum Support {
    Hinge,
    Clamp,
}

/// A piece of constant curvature as drawn.
pub struct Piece {
    /// Angle between the piece before and this one, rad.
    pub corner: f64,
    pub length: f64,
    /// As drawn, 1/m.
    pub curvature: f64,
}

/// Forces are downward, or across the rod to its right.
#[derive(Clone, Copy, PartialEq)]
pub enum Load {
    /// At the start of a piece, N.
    At(usize),
    /// Along the whole rod, of its length as drawn, N/m; the place that is watched is the start of a piece.
    Along(usize),
}

/// An equilibrium as another code has found it.
pub struct Point {
    /// Displacement of the loaded or watched place, m.
    pub place: [f64; 2],
    /// The load, N or N/m.
    pub load: f64,
    /// Reactions at the start: its turn about y (rad) if it is hinged, the moment of the support about y (N m) if it is
    /// clamped; then the force of the support (N).
    pub start: [f64; 3],
}

/// Steps of the integration in a piece.
const STEPS: usize = 100;

/// Place, angle, moment, force that the part behind exerts.
type State = [f64; 6];

impl Rod {
    /// The largest distance of inner `points` from the path of this rod, [`Self::near`]: displacements and loads over
    /// the scales.
    pub fn distance_from(&self, points: &[Point]) -> f64 {
        let distance = |(own, place): (&Point, [f64; 3])| {
            let own = self.scaled(own);
            own.iter().zip(&place).map(|(own, place)| (own - place).powi(2)).sum::<f64>().sqrt()
        };
        points[1..].iter().zip(self.near(points)).map(distance).fold(0.0, f64::max)
    }

    /// The points of the path of this rod near the inner ones of `points`, each in the plane across the way from the
    /// point before to the point after: displacements and load over the scales.
    pub fn near(&self, points: &[Point]) -> Vec<[f64; 3]> {
        let mut found = Vec::new();
        for three in points.windows(3) {
            let way: [f64; 3] = std::array::from_fn(|k| self.scaled(&three[2])[k] - self.scaled(&three[0])[k]);
            let own = self.scaled(&three[1]);
            let [first, x, z] = three[1].start;
            let mut unknowns = [first, x, z, three[1].load];
            let reaches = match self.supports[0] {
                Support::Hinge => [1e-6, 1e-6 * self.force(), 1e-6 * self.force(), 1e-6 * self.scales[1]],
                Support::Clamp => [self.scales[0], 1.0, 1.0, 1.0].map(|reach| 1e-6 * reach * self.force()),
            };
            let mut place = own;
            for _ in 0..20 {
                let (residual, here) = self.residual(&unknowns, &own, &way);
                place = here;
                if residual.norm() < 1e-10 {
                    break;
                }
                let mut jacobian = Matrix4::zeros();
                for (column, reach) in reaches.into_iter().enumerate() {
                    let mut moved = unknowns;
                    moved[column] += reach;
                    let moved = self.residual(&moved, &own, &way).0;
                    jacobian.set_column(column, &((moved - residual) / reach));
                }
                let change = jacobian.lu().solve(&residual).expect("the plane is across the path");
                unknowns.iter_mut().zip(&change).for_each(|(value, change)| *value -= change);
            }
            let left = self.residual(&unknowns, &own, &way).0.norm();
            assert!(left < 1e-9, "the rod found no equilibrium near {own:?}: {left}");
            found.push(place);
        }
        found
    }

    /// A force that bends it by about its size.
    fn force(&self) -> f64 {
        self.bending / self.scales[0].powi(2)
    }

    /// Displacement and load of a point over the scales.
    pub fn scaled(&self, point: &Point) -> [f64; 3] {
        self.scales(point.place, point.load)
    }

    fn scales(&self, [x, z]: [f64; 2], load: f64) -> [f64; 3] {
        let [length, force] = self.scales;
        [x / length, z / length, load / force]
    }

    /// What the far end is off by, and how far the watched place is from the plane through `own` across `way`; and
    /// where the watched place is.
    fn residual(&self, unknowns: &[f64; 4], own: &[f64; 3], way: &[f64; 3]) -> (Vector4<f64>, [f64; 3]) {
        let [first, x, z, load] = *unknowns;
        let (turn, moment) = if self.supports[0] == Support::Hinge { (first, 0.0) } else { (0.0, first) };
        let (end, place) = self.shoot([0.0, 0.0, self.angle - turn, moment, -x, -z], load);
        let (drawn, place_drawn) = self.shoot([0.0, 0.0, self.angle, 0.0, 0.0, 0.0], 0.0);
        let place = self.scales([place[0] - place_drawn[0], place[1] - place_drawn[1]], load);
        let off = (0..3).map(|k| (place[k] - own[k]) * way[k]).sum::<f64>();
        let size = self.scales[0];
        let held = match self.supports[1] {
            Support::Hinge => end[3] * size / self.bending,
            Support::Clamp => end[2] - drawn[2],
        };
        (Vector4::new((end[0] - drawn[0]) / size, (end[1] - drawn[1]) / size, held, off), place)
    }

    /// The state at the end and the watched place.
    fn shoot(&self, mut state: State, load: f64) -> (State, [f64; 2]) {
        let (Load::At(watched) | Load::Along(watched)) = self.load;
        let along = if matches!(self.load, Load::Along(_)) { load } else { 0.0 };
        let mut place = [0.0; 2];
        for (number, piece) in self.pieces.iter().enumerate() {
            state[2] += piece.corner;
            if number == watched {
                place = [state[0], state[1]];
                if self.load == Load::At(number) {
                    let [x, z] = self.direction(state[2]);
                    state[4] -= load * x;
                    state[5] -= load * z;
                }
            }
            self.integrate(&mut state, piece, along);
        }
        (state, place)
    }

    /// Direction of the load where the rod has this angle.
    fn direction(&self, angle: f64) -> [f64; 2] {
        if self.follower { [angle.sin(), -angle.cos()] } else { [0.0, -1.0] }
    }

    /// Carries the state along a piece under `load` N/m.
    fn integrate(&self, state: &mut State, piece: &Piece, load: f64) {
        let slope = |state: &State| -> State {
            let (sine, cosine) = state[2].sin_cos();
            let stretch = 1.0 + (state[4] * cosine + state[5] * sine) / self.stretching;
            let [x, z] = [stretch * cosine, stretch * sine];
            let [across_x, across_z] = self.direction(state[2]);
            let curvature = piece.curvature + state[3] / self.bending;
            [x, z, curvature, z * state[4] - x * state[5], -load * across_x, -load * across_z]
        };
        let step = piece.length / STEPS as f64;
        for _ in 0..STEPS {
            *state = runge_kutta(state, step, slope);
        }
    }
}
