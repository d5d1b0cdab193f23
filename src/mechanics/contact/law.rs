//! The normal force of a contact per length of beam, from a potential: over a step its mean over the way of the
//! penetration, so that it works as much as its energy changes.

/// How hard a contact is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    /// Force per length of beam and penetration, N/m².
    pub stiffness: f64,
    /// Share of the force that is added for each unit of the rate of the penetration, s/m.
    pub damping: f64,
    /// Force per length of beam that is added for each unit of the rate of the penetration, N s/m²: the damper of a
    /// seabed. Over a step it acts on the share of the way that is inside.
    pub viscosity: f64,
}

/// A force per length and its derivative with respect to the penetration at the end of the step, or at the instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pressure {
    /// N/m, at least 0.
    pub force: f64,
    /// N/m².
    pub slope: f64,
    /// The part of the force that the potential has, N/m.
    pub elastic: f64,
}

impl Law {
    /// Whether it takes energy.
    pub fn is_damped(&self) -> bool {
        self.damping != 0.0 || self.viscosity != 0.0
    }

    /// Energy per length at a penetration, J/m.
    pub fn energy(&self, penetration: f64) -> f64 {
        0.5 * self.stiffness * penetration.max(0.0).powi(2)
    }

    /// The pressure at an instant, with the rate of the penetration, m/s.
    pub fn at(&self, penetration: f64, rate: f64) -> Pressure {
        if penetration <= 0.0 {
            return Pressure::default();
        }
        let elastic = self.stiffness * penetration;
        let factor = (1.0 + self.damping * rate).max(0.0);
        let own = Pressure { force: elastic * factor, slope: self.stiffness * factor, elastic };
        own.damped(self.viscosity * rate, 0.0)
    }

    /// Derivative of the force at an instant with respect to the rate of the penetration, N s/m².
    pub fn by_rate(&self, penetration: f64, rate: f64) -> f64 {
        let by_rate = self.stiffness * penetration * self.damping + self.viscosity;
        if penetration <= 0.0 || self.at(penetration, rate).force <= 0.0 { 0.0 } else { by_rate }
    }

    /// The pressure over a step of `duration` s from one penetration to another.
    pub fn over(&self, [start, end]: [f64; 2], duration: f64) -> Pressure {
        let own = self.elastic_over([start, end], duration);
        if self.viscosity == 0.0 {
            return own;
        }
        let by_end = if end > 0.0 { self.viscosity / duration } else { 0.0 };
        own.damped(self.viscosity * (end.max(0.0) - start.max(0.0)) / duration, by_end)
    }

    /// The same without viscosity.
    fn elastic_over(&self, [start, end]: [f64; 2], duration: f64) -> Pressure {
        let Pressure { force: elastic, slope, .. } = self.mean(start, end);
        if self.damping == 0.0 || elastic == 0.0 {
            return Pressure { force: elastic, slope, elastic };
        }
        let factor = 1.0 + self.damping * (end - start) / duration;
        if factor <= 0.0 {
            return Pressure { elastic, ..Pressure::default() };
        }
        Pressure { force: elastic * factor, slope: slope * factor + elastic * self.damping / duration, elastic }
    }

    /// The mean of the elastic force over the way: `(φ(p₁) − φ(p₀))/(p₁ − p₀)` without cancellation.
    fn mean(&self, start: f64, end: f64) -> Pressure {
        let half = 0.5 * self.stiffness;
        let [force, slope] = match (start > 0.0, end > 0.0) {
            (true, true) => [half * (start + end), half],
            (false, true) => {
                let share = end / (end - start);
                [half * end * share, half * share * (2.0 - share)]
            }
            (true, false) => {
                let share = start / (start - end);
                [half * start * share, half * share * share]
            }
            (false, false) => [0.0; 2],
        };
        Pressure { force, slope, elastic: force }
    }
}

impl Pressure {
    /// Adds a `viscous` force and its slope; together they never pull.
    fn damped(self, viscous: f64, by_end: f64) -> Self {
        if viscous == 0.0 {
            return self;
        }
        let force = self.force + viscous;
        if force <= 0.0 {
            return Self { elastic: self.elastic, ..Self::default() };
        }
        Self { force, slope: self.slope + by_end, elastic: self.elastic }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean force works as much as the energy changes, to round-off; its slope is the derivative, to the square of
    /// the step of the differences.
    #[test]
    fn energy_and_slope() {
        let own = Law { stiffness: 2e4, damping: 0.0, viscosity: 0.0 };
        for [start, end] in [[-0.01, 0.02], [0.02, -0.01], [0.01, 0.03], [-0.02, -0.01], [0.0, 0.01]] {
            let found = own.over([start, end], 1.0);
            let work = found.force * (end - start);
            assert!((work - (own.energy(end) - own.energy(start))).abs() < 1e-12, "{start} {end}");
            let [plus, minus] = [1e-7, -1e-7].map(|change| own.over([start, end + change], 1.0).force);
            assert!((found.slope - (plus - minus) / 2e-7).abs() < 1e-3, "{start} {end}");
        }
    }

    /// Damping never pulls, and takes energy on both ways.
    #[test]
    fn damping() {
        let own = Law { stiffness: 2e4, damping: 0.5, viscosity: 0.0 };
        for [start, end] in [[0.01, 0.02], [0.02, 0.01], [0.02, -0.03]] {
            let Pressure { force, elastic, .. } = own.over([start, end], 0.01);
            assert!(force >= 0.0 && (force - elastic) * (end - start) > 0.0, "{start} {end}: {force} {elastic}");
        }
        assert_eq!(own.over([0.02, -0.03], 0.01).force, 0.0);
    }

    /// A viscous bed too never pulls and takes energy on both ways; its force begins at 0 where a step only just
    /// touches, and its slope is the derivative.
    #[test]
    fn viscosity() {
        let own = Law { stiffness: 2e4, damping: 0.0, viscosity: 1e3 };
        for [start, end] in [[0.01, 0.02], [0.02, 0.015], [-0.02, 0.01], [0.02, -0.03]] {
            let Pressure { force, elastic, slope } = own.over([start, end], 0.1);
            assert!(force >= 0.0 && (force - elastic) * (end - start) > 0.0, "{start} {end}: {force} {elastic}");
            let [plus, minus] = [1e-7, -1e-7].map(|change| own.over([start, end + change], 0.1).force);
            assert!((slope - (plus - minus) / 2e-7).abs() < 1e-3, "{start} {end}");
        }
        assert!(own.over([-0.02, 1e-9], 0.1).force < 1e-4);
        assert_eq!((own.at(0.01, -1.0).force, own.by_rate(0.01, -1.0)), (0.0, 0.0));
        assert_eq!((own.at(0.01, 1.0).force, own.by_rate(0.01, 1.0)), (1200.0, 1e3));
    }
}
