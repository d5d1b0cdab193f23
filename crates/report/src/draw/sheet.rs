//! The paper, and where points of a mechanism are on it.

use super::projection::Projection;
use ancf14::model::drawing::Drawing;

/// What a picture is drawn on, pixels. Marks have the same size on each.
#[derive(Clone, Copy, Debug)]
pub struct Sheet {
    pub width: f64,
    pub height: f64,
    /// Room for what stands around points, names above all.
    pub border: f64,
    /// Length of an arrow.
    pub arrow: f64,
}

/// With names.
pub const PAGE: Sheet = Sheet { width: 960.0, height: 640.0, border: 110.0, arrow: 58.0 };
/// Without: small, so that lines and marks are large beside it.
pub const ICON: Sheet = Sheet { width: 200.0, height: 150.0, border: 28.0, arrow: 28.0 };

/// The height of a page that is as low as its mechanism, at least.
const LOWEST: f64 = 300.0;

/// From meters to pixels.
pub struct View {
    pub sheet: Sheet,
    pub projection: Projection,
    pub scale: f64,
    center: [f64; 2],
}

impl View {
    /// Fills the sheet with the mechanism.
    pub fn of(drawing: &Drawing, sheet: Sheet, projection: Projection) -> Self {
        let (low, high) = extent(drawing, projection);
        let room = [sheet.width - 2.0 * sheet.border, sheet.height - 2.0 * sheet.border];
        let scale = [0, 1].map(|axis| room[axis] / (high[axis] - low[axis])).into_iter().fold(f64::INFINITY, f64::min);
        let center = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]));
        if scale.is_finite() && center.iter().all(|c| c.is_finite()) {
            Self { sheet, projection, scale, center }
        } else {
            Self { sheet, projection, scale: 100.0, center: [0.0; 2] }
        }
    }

    /// Fills a page that is only as high as it needs to be.
    pub fn fitted(drawing: &Drawing, projection: Projection) -> Self {
        let (low, high) = extent(drawing, projection);
        let needed = (PAGE.width - 2.0 * PAGE.border) * (high[1] - low[1]) / (high[0] - low[0]) + 2.0 * PAGE.border;
        let height = if needed.is_finite() { needed.clamp(LOWEST, PAGE.height) } else { PAGE.height };
        Self::of(drawing, Sheet { height, ..PAGE }, projection)
    }

    /// Where a point is on the sheet.
    pub fn place(&self, point: [f64; 3]) -> [f64; 2] {
        let [x, y] = self.projection.flat(point);
        let [right, down] = [self.scale * (x - self.center[0]), -self.scale * (y - self.center[1])];
        [0.5 * self.sheet.width + right, 0.5 * self.sheet.height + down]
    }
}

/// Lowest and highest place of a mechanism on paper.
fn extent(drawing: &Drawing, projection: Projection) -> ([f64; 2], [f64; 2]) {
    let lines = drawing.lines.iter().flat_map(|line| &line.points);
    let points: Vec<_> =
        lines.chain(drawing.marks.iter().map(|mark| &mark.at)).map(|point| projection.flat(*point)).collect();
    let extreme =
        |axis: usize, pick: fn(f64, f64) -> f64, start: f64| points.iter().map(|point| point[axis]).fold(start, pick);
    let low = [0, 1].map(|axis| extreme(axis, f64::min, f64::INFINITY));
    (low, [0, 1].map(|axis| extreme(axis, f64::max, f64::NEG_INFINITY)))
}
