//! What the runs beside the first one tell of one column: the largest differences over all rows.
//!
//! Differences of single rows pass through zero, and say nothing there; the largest ones do not.

/// One column at one row: the first run's own value, and those of the others where they have one.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sample {
    /// Of the first run.
    pub own: f64,
    /// With half the step, and with twice the step.
    pub half_step: Option<f64>,
    /// With twice the step.
    pub double_step: Option<f64>,
    /// With quadratic twist; the first run's own where no beam has linear twist.
    pub quadratic: Option<f64>,
    /// With twice the elements.
    pub double_elements: Option<f64>,
    /// With half the elements.
    pub half_elements: Option<f64>,
}

/// The largest difference of two runs, and of the two before it in the row of levels; none: there are no two to
/// compare.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pair {
    /// From the coarsest level to the middle one.
    pub coarse: Option<f64>,
    /// From the middle level to the finest one.
    pub fine: Option<f64>,
}

/// The row at which the differences of step and mesh are largest together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Worst {
    /// When, s.
    pub time: f64,
    /// Difference to half the step there.
    pub step: f64,
    /// Difference to twice the elements there.
    pub mesh: f64,
}

/// A column over all rows so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tally {
    /// Lowest value of the first run.
    pub low: f64,
    /// Highest value of the first run.
    pub high: f64,
    /// Levels of the step.
    pub step: Pair,
    /// Levels of the elements, with quadratic twist.
    pub elements: Pair,
    /// From the first run to the one with quadratic twist.
    pub twist: Option<f64>,
    /// From the first run to the one with twice the elements.
    pub mesh: Option<f64>,
    /// Where both are largest together.
    pub worst: Worst,
}

impl Default for Tally {
    fn default() -> Self {
        Self {
            low: f64::INFINITY,
            high: f64::NEG_INFINITY,
            step: Pair::default(),
            elements: Pair::default(),
            twist: None,
            mesh: None,
            worst: Worst::default(),
        }
    }
}

impl Tally {
    /// Adds a row.
    pub fn add(&mut self, time: f64, sample: Sample) {
        let Sample { own, half_step, double_step, quadratic, double_elements, half_elements } = sample;
        self.low = self.low.min(own);
        self.high = self.high.max(own);
        let own = Some(own);
        raise(&mut self.step.coarse, distance(double_step, own));
        raise(&mut self.step.fine, distance(own, half_step));
        raise(&mut self.elements.coarse, distance(half_elements, quadratic));
        raise(&mut self.elements.fine, distance(quadratic, double_elements));
        raise(&mut self.twist, distance(own, quadratic));
        raise(&mut self.mesh, distance(own, double_elements));
        let [step, mesh] = [half_step, double_elements].map(|other| distance(own, other).unwrap_or(0.0));
        if step + mesh > self.worst.step + self.worst.mesh {
            self.worst = Worst { time, step, mesh };
        }
    }

    /// From the lowest to the highest value of the first run.
    pub fn range(&self) -> f64 {
        self.high - self.low
    }

    /// The largest size of the first run.
    pub fn size(&self) -> f64 {
        self.low.abs().max(self.high.abs())
    }
}

fn distance(one: Option<f64>, other: Option<f64>) -> Option<f64> {
    Some((one? - other?).abs())
}

fn raise(largest: &mut Option<f64>, found: Option<f64>) {
    // None is below every number.
    if found > *largest {
        *largest = found;
    }
}
