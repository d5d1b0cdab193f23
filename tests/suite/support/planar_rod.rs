//! Lee's frame as two extensible rods in a plane, integrated by Runge and Kutta's method and shot at the far hinge: the equilibrium near a given one.

/// The frame: a column upward, a girder from its head to the right, both of length `side`, hinged at both ends.
pub struct Frame {
    /// Length of column and girder, m.
    pub side: f64,
    /// `E I`, N m².
    pub bending: f64,
    /// `E A`, N.
    pub stretching: f64,
    /// Share of the girder at which the load acts.
    pub loaded: f64,
    /// Whether the load turns with the girder.
    pub follower: bool,
}

/// An equilibrium as another code has found it.
pub struct Point {
    /// Displacement of the loaded point, m.
    pub place: [f64; 2],
    /// The load, N.
    pub load: f64,
    /// Angle of the foot about the axis into the plane (rad), and what the ground exerts on it (N).
    pub foot: [f64; 3],
}

/// Steps of the integration in a stretch.
const STEPS: usize = 100;

impl Frame {
    /// The largest distance of inner `points` from the path of this frame, in the plane across the way from the point before to the point after: displacements over the side, the load over
    /// the critical one of a leg.
    pub fn distance_from(&self, points: &[Point]) -> f64 {
        let mut worst = 0.0;
        for three in points.windows(3) {
            let way: [f64; 3] = std::array::from_fn(|k| self.scaled(&three[2])[k] - self.scaled(&three[0])[k]);
            let own = self.scaled(&three[1]);
            let [angle, x, z] = three[1].foot;
            let mut unknowns = [angle, x, z, three[1].load];
            for _ in 0..20 {
                let (residual, place) = self.residual(&unknowns, &own, &way);
                let mut jacobian = nalgebra::Matrix4::zeros();
                for column in 0..4 {
                    let reach = 1e-6 * if column == 0 { 1.0 } else { self.bending / (self.side * self.side) };
                    let mut moved = unknowns;
                    moved[column] += reach;
                    let moved = self.residual(&moved, &own, &way).0;
                    jacobian.set_column(column, &((moved - residual) / reach));
                }
                let change = jacobian.lu().solve(&residual).expect("the plane is across the path");
                unknowns.iter_mut().zip(&change).for_each(|(value, change)| *value -= change);
                if residual.norm() < 1e-10 {
                    let off: f64 = own.iter().zip(&place).map(|(own, place)| (own - place).powi(2)).sum();
                    worst = f64::max(worst, off.sqrt());
                    break;
                }
            }
            let left = self.residual(&unknowns, &own, &way).0.norm();
            assert!(left < 1e-9, "the rod found no equilibrium near {own:?}: {left}");
        }
        worst
    }

    fn scaled(&self, point: &Point) -> [f64; 3] {
        self.scales(point.place, point.load)
    }

    fn scales(&self, [x, z]: [f64; 2], load: f64) -> [f64; 3] {
        // The load that Lee's frame bears is 18.5 of these.
        [x / self.side, z / self.side, load * self.side * self.side / (18.5 * self.bending)]
    }

    /// What the far hinge is off by, and how far the loaded point is from the plane through `own` across `way`; and where the loaded point is.
    fn residual(&self, unknowns: &[f64; 4], own: &[f64; 3], way: &[f64; 3]) -> (nalgebra::Vector4<f64>, [f64; 3]) {
        let [turn, x, z, load] = *unknowns;
        // Position, angle from the x axis, moment; a turn about the axis into the plane goes from z to x.
        let mut state = [0.0, 0.0, std::f64::consts::FRAC_PI_2 - turn, 0.0];
        let mut inner = [-x, -z];
        self.integrate(&mut state, inner, self.side);
        state[2] -= std::f64::consts::FRAC_PI_2;
        self.integrate(&mut state, inner, self.loaded * self.side);
        let direction = if self.follower { [state[2].sin(), -state[2].cos()] } else { [0.0, -1.0] };
        let place = [state[0] - self.loaded * self.side, state[1] - self.side];
        inner = [inner[0] - load * direction[0], inner[1] - load * direction[1]];
        self.integrate(&mut state, inner, (1.0 - self.loaded) * self.side);
        let place = self.scales(place, load);
        let off = (0..3).map(|k| (place[k] - own[k]) * way[k]).sum::<f64>();
        let moment = state[3] * self.side / self.bending;
        let hinge = [state[0] / self.side - 1.0, state[1] / self.side - 1.0];
        (nalgebra::Vector4::new(hinge[0], hinge[1], moment, off), place)
    }

    /// Carries position, angle and moment along a stretch that transmits the force `inner`.
    fn integrate(&self, state: &mut [f64; 4], inner: [f64; 2], length: f64) {
        let slope = |state: &[f64; 4]| {
            let (sine, cosine) = state[2].sin_cos();
            let stretch = 1.0 + (inner[0] * cosine + inner[1] * sine) / self.stretching;
            let [x, z] = [stretch * cosine, stretch * sine];
            [x, z, state[3] / self.bending, z * inner[0] - x * inner[1]]
        };
        let step = length / STEPS as f64;
        for _ in 0..STEPS {
            let moved = |slope: &[f64; 4], by: f64| -> [f64; 4] { std::array::from_fn(|k| state[k] + by * slope[k]) };
            let first = slope(state);
            let second = slope(&moved(&first, 0.5 * step));
            let third = slope(&moved(&second, 0.5 * step));
            let fourth = slope(&moved(&third, step));
            *state = std::array::from_fn(|k| {
                state[k] + step / 6.0 * (first[k] + 2.0 * second[k] + 2.0 * third[k] + fourth[k])
            });
        }
    }
}
