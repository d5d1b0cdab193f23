//! Dry friction that holds: an elastic sticking displacement, up to the limit at which it slides (MECHANICS 7.6).
//!
//! The displacement is what friction remembers. While both sides stick, it grows with their way against each other, and
//! the force `stiffness · displacement` holds. At the limit they slide, and the displacement stays what it is. A step
//! takes the force that it would have half a step behind its end, with the rate there: `stiffness (u₁ + h v₁/2)`, cut
//! off at the limit. Where sticking is far too fast for the step, both displacement and rate end at rest. With the
//! force of the end alone the rate would change its sign with every step for ever, and with the mean of both ends the
//! displacement too.

/// Dry friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DryFriction {
    /// Largest force, N or N m.
    pub limit: f64,
    /// Largest elastic displacement, m or rad; above 0.
    pub largest: f64,
}

/// Share of the largest displacement from which on both sides slide: less than this is round-off.
const SLIDING: f64 = 1.0 - 1e-9;

impl DryFriction {
    /// With the stiffness `stiffness` while both sides stick, N/m or N m/rad.
    pub fn with_stiffness(limit: f64, stiffness: f64) -> Self {
        // Compilers divide first and choose afterwards: not by 0, which hosts may trap.
        Self { limit, largest: if limit > 0.0 { limit / stiffness } else { 1.0 } }
    }

    /// Stiffness while both sides stick, N/m or N m/rad.
    pub fn stiffness(&self) -> f64 {
        self.limit / self.largest
    }

    /// The displacement after a way of `way` from the displacement `before`, m or rad.
    pub fn displaced(&self, before: f64, way: f64) -> f64 {
        // Nothing sticks without a limit: a brake that begins to act finds its sides free of force.
        if self.limit > 0.0 { (before + way).clamp(-self.largest, self.largest) } else { 0.0 }
    }

    /// Force after a way, N or N m.
    pub fn force(&self, before: f64, way: f64) -> f64 {
        self.stiffness() * self.displaced(before, way)
    }

    /// Force of a step of `duration` s with this way, whose sides have the rate `rate` at its start, and its derivative
    /// with respect to the way: N or N m.
    pub fn force_over(&self, before: f64, way: f64, rate: f64, duration: f64) -> [f64; 2] {
        let displaced = self.displaced(before, way);
        let beyond = way - 0.5 * duration * rate;
        let sticks = |displacement: f64| f64::from(displacement.abs() < self.largest);
        let slope = (sticks(before + way) + 1.0) * sticks(displaced + beyond);
        [self.force(displaced, beyond), self.stiffness() * slope]
    }

    /// Derivative of [`Self::force`] with respect to the way, N/m or N m/rad.
    pub fn slope(&self, before: f64, way: f64) -> f64 {
        if (before + way).abs() < self.largest { self.stiffness() } else { 0.0 }
    }

    /// Elastic energy of a displacement, J.
    pub fn energy(&self, displacement: f64) -> f64 {
        0.5 * self.stiffness() * displacement * displacement
    }

    /// What the displacement stores over a way, J.
    pub fn stored(&self, before: f64, way: f64) -> f64 {
        self.energy(self.displaced(before, way)) - self.energy(before)
    }

    /// Whether both sides slide with the rate `rate` at a displacement.
    pub fn slides(&self, displacement: f64, rate: f64) -> bool {
        displacement.abs() >= SLIDING * self.largest && displacement * rate > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A mass on friction alone, in steps far longer than sticking takes: it slides as far as `v²/(2 a)`, to a step's
    /// way, stops within one step, and rests at once, with a displacement within the limit. Work and energy balance to
    /// round-off.
    #[test]
    fn a_mass_stops_and_rests() {
        let (own, mass, step) = (DryFriction::with_stiffness(3.0, 1e12), 2.0, 1e-3);
        let (mut displacement, mut place, mut rate, mut taken) = (0.0, 0.0, 0.3, 0.0);
        for _ in 0..400 {
            // The force falls as the way grows: bisection.
            let residual =
                |way: f64| 2.0 * mass * (way / step - rate) / step + own.force_over(displacement, way, rate, step)[0];
            let (mut low, mut high) = (-1e-3, 1e-3);
            for _ in 0..200 {
                let middle = 0.5 * (low + high);
                if residual(middle) > 0.0 { high = middle } else { low = middle }
            }
            taken += own.force_over(displacement, low, rate, step)[0] * low - own.stored(displacement, low);
            displacement = own.displaced(displacement, low);
            (place, rate) = (place + low, 2.0 * low / step - rate);
        }
        assert!((place - 0.03).abs() < 0.3 * step, "{place}");
        assert!(rate.abs() < 1e-12 && displacement.abs() <= own.largest, "{rate} {displacement}");
        assert!((taken + own.energy(displacement) - 0.09).abs() < 1e-9, "{taken}");
    }

    /// At the limit both sides slide one way and stick the other.
    #[test]
    fn limits() {
        let own = DryFriction::with_stiffness(3.0, 600.0);
        assert_eq!(own.displaced(0.0, -1.0), -0.005);
        assert_eq!((own.force(-0.005, -1.0), own.slope(-0.005, -1.0)), (-3.0, 0.0));
        assert_eq!(own.slope(-0.005, 0.001), 600.0);
        assert!(own.slides(-0.005, -0.1) && !own.slides(-0.005, 0.1));
    }

    /// Without a limit it does nothing, and remembers nothing.
    #[test]
    fn no_limit_no_force() {
        let own = DryFriction::with_stiffness(0.0, 600.0);
        assert_eq!(own.displaced(0.0, 0.3), 0.0);
        assert_eq!(own.force(0.0, 0.3), 0.0);
        assert_eq!(own.force_over(0.0, 0.3, 1.0, 0.1), [0.0, 0.0]);
    }
}
