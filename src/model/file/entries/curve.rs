//! The line of a `[beam.NAME]`: straight by `from` and `to`, or a `curve`.

use crate::mechanics::beam::centerline::Spacing;
use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::schema::Rule;
use crate::model::text::diagnostic::Place;
use crate::model::text::names::Kind;

pub(super) const FROM: Rule = Rule::new("from", "start of the beam, global", "m");
pub(super) const TO: Rule = Rule::new("to", "end of the beam, global", "m");
const LAY_LENGTH: Rule = Rule::new("length", "length of the line without stress", "m").above(0.0);
const CURVE_X: Rule = Rule::new("x", "global x of the beam along its curve", "m").along_beam();
const CURVE_Y: Rule = Rule::new("y", "global y of the beam along its curve", "m").along_beam();
const CURVE_Z: Rule = Rule::new("z", "global z of the beam along its curve", "m").along_beam();
const CURVE_S: Rule = Rule::new("s", "curve parameter at the start and at the end of the beam", "");
const CURVE_POINTS: Rule = Rule::new("points", "points of the beam's curve, global", "m");
const CURVE_RADIUS: Rule =
    Rule::new("radius", "distance of the beam's axis from the surfaces; by default that of its contact", "m").from(0.0);

/// What the beam follows.
#[derive(Clone, Debug)]
pub enum Line {
    /// A straight line.
    Straight {
        /// Start, global, m.
        from: [Number; 3],
        /// End, global, m.
        to: [Number; 3],
    },
    /// As a flexible line hangs between both ends; straight when free of stress.
    Laid {
        /// Where the length is written.
        place: Place,
        /// Start, global, m.
        from: [Number; 3],
        /// End, global, m.
        to: [Number; 3],
        /// m.
        length: Number,
    },
    /// A curve.
    Curved(CurveSpec),
}

/// A `curve`.
#[derive(Clone, Debug)]
pub struct CurveSpec {
    /// Where it is written.
    pub place: Place,
    /// What it goes through.
    pub shape: Shape,
    /// true: straight pieces, welded at the corners.
    pub polyline: bool,
    /// How the ends of the elements are spaced.
    pub spacing: Spacing,
}

/// What a curve goes through.
#[derive(Clone, Debug)]
pub enum Shape {
    /// Coordinates as functions of the curve parameter.
    Expressions {
        /// x, y, z, global, m.
        coordinates: [Number; 3],
        /// The parameter at the start and at the end.
        range: [Number; 2],
    },
    /// Points, global, m: two or more.
    Points(Vec<[Number; 3]>),
    /// Surfaces that it is tight over.
    Over(TightSpec),
}

/// A line that is tight over surfaces.
#[derive(Clone, Debug)]
pub struct TightSpec {
    /// Where the surfaces are written.
    pub location: Place,
    /// The surfaces in their order, by their numbers.
    pub over: Vec<usize>,
    /// The turn about each surface: 1 where the line is right-handed about the axis, else -1, and more for whole turns
    /// beyond the arc; none: closed around all of them from outside.
    pub turns: Option<Vec<i64>>,
    /// Its ends, global, m; none: it is closed.
    pub ends: Option<[[Number; 3]; 2]>,
    /// Distance of the axis from the surfaces, m; none: that of the contact with them.
    pub radius: Option<Number>,
}

/// The words of `spacing`.
pub(super) const SPACINGS: [(&str, Spacing); 2] = [("arc", Spacing::Arc), ("s", Spacing::Parameter)];
/// The lay of a line in a message.
const LAY: &str = "{ length = 410 }";
/// What a curve looks like.
const FORMS: &str =
    "{ x = .., y = .., z = .., s = [0, 1] }, { points = [[0, 0, 0], ..] } or { over = [\"SURFACE\", ..], .. }";

/// The turns of a closed curve.
const CLOSED_TURNS: &str = "for each surface in its order, 1 where the curve runs right-handed about the axis, \
                            -1 where it runs left-handed";
/// The turns of a curve from end to end.
const OPEN_TURNS: &str = "for each surface in its order, 1 where the curve runs right-handed about the axis, \
                          -1 where it runs left-handed; 3 or -3 with two whole turns beyond the arc";

impl Line {
    /// Whether it is straight when free of stress, unless the beam says otherwise: where it only lies as it is drawn.
    pub fn is_straight_without_stress(&self) -> bool {
        matches!(self, Self::Laid { .. } | Self::Curved(CurveSpec { shape: Shape::Over(_), .. }))
    }

    /// None: a mistake, which is reported.
    pub(in crate::model) fn read(reader: &mut Reader<'_, '_>) -> Option<Self> {
        let curved = reader.has("curve");
        if reader.has("from") || reader.has("to") {
            reader.exclude("curve", "from` and `to");
        }
        if curved {
            reader.exclude("lay", "curve");
        }
        if reader.has("curve") {
            return CurveSpec::read(reader).map(Self::Curved);
        }
        // Of a curve that `from` and `to` exclude the spacing is none too many.
        match curved {
            true => drop(reader.take("spacing")),
            false => reader.refuse("spacing", "`spacing` belongs to a curve", "a straight beam has equal elements"),
        }
        // Beside a curve, one of the ends may be missing: which of the two was meant is not known.
        let stand_in = |reader: &mut Reader<'_, '_>, rule| match curved {
            true => reader.vector_or(rule, [0.0; 3]),
            false => reader.vector(rule),
        };
        let (from, to) = (stand_in(reader, &FROM), stand_in(reader, &TO));
        let written = reader.place_of("lay");
        let length = reader.inner("lay", LAY).map(|mut inner| {
            let length = inner.number(&LAY_LENGTH);
            inner.finish();
            length
        });
        let line = length.map_or(Self::Straight { from, to }, |length| Self::Laid { place: written, from, to, length });
        (!curved).then_some(line)
    }
}

impl CurveSpec {
    fn read(reader: &mut Reader<'_, '_>) -> Option<Self> {
        let location = reader.place_of("curve");
        let inner = reader.inner("curve", FORMS).map(Shape::read);
        // Without the table nobody knows whether a spacing belongs to it.
        let Some((shape, polyline)) = inner else {
            reader.take("spacing");
            return None;
        };
        if polyline && matches!(shape, Some(Shape::Points(_))) {
            let label = "between points elements are shared by length";
            reader.refuse("spacing", "`spacing` does not belong to a polyline of points", label);
        }
        let spacing = reader.word("spacing", &SPACINGS, Some(Spacing::Arc)).unwrap_or(Spacing::Arc);
        shape.map(|shape| Self { place: location, shape, polyline, spacing })
    }
}

impl Shape {
    /// The shape, none after a mistake, and whether it is a polyline.
    fn read(mut reader: Reader<'_, '_>) -> (Option<Self>, bool) {
        let expressions = ["x", "y", "z", "s"].map(|key| reader.has(key));
        let shape = if reader.has("over") {
            for key in ["x", "y", "z", "s", "points", "polyline"] {
                reader.exclude(key, "over");
            }
            TightSpec::read(&mut reader).map(Self::Over)
        } else if reader.has("points") {
            for key in ["x", "y", "z", "s"] {
                reader.exclude(key, "points");
            }
            Self::points(&mut reader)
        } else if expressions.contains(&true) {
            let coordinates = [&CURVE_X, &CURVE_Y, &CURVE_Z].map(|rule| reader.number(rule));
            let range = reader.list(&CURVE_S, "a list of 2");
            Some(Self::Expressions { coordinates, range })
        } else {
            reader.missing(
                "points",
                "or x, y, z as expressions of s, and s = [0, 1], or the surfaces that it is tight `over`",
            );
            None
        };
        let polyline = reader.boolean("polyline", false);
        reader.finish();
        (shape, polyline)
    }

    fn points(reader: &mut Reader<'_, '_>) -> Option<Self> {
        let (count, written) = (reader.length_of("points"), reader.place_of("points"));
        let points = reader.points(&CURVE_POINTS)?;
        if let Some(count) = count.filter(|count| *count < 2) {
            let message = format!("{} has {}", reader.title, if count == 1 { "a single point" } else { "no points" });
            reader.context.report.error(written, &message, "2 points or more were expected", "");
            return None;
        }
        // What is no point is reported.
        (Some(points.len()) == count).then_some(Self::Points(points))
    }
}

impl TightSpec {
    /// None: a mistake, which is reported.
    fn read(reader: &mut Reader<'_, '_>) -> Option<Self> {
        let location = reader.place_of("over");
        let over = reader.references("over", Kind::Surface);
        let closed = reader.boolean("closed", false);
        let ends = if closed {
            for key in [FROM.key, TO.key] {
                reader.exclude(key, "closed");
            }
            None
        } else {
            Some([reader.vector(&FROM), reader.vector(&TO)])
        };
        let at_turns = reader.place_of("turns");
        let turns = reader.has("turns").then(|| reader.whole_numbers("turns"));
        let radius = reader.optional(&CURVE_RADIUS);
        let over = over?;
        let most = if closed { 1 } else { u64::from(u16::MAX) };
        let is_fit =
            |turns: &Vec<i64>| turns.len() == over.len() && turns.iter().all(|turn| turn.unsigned_abs() <= most);
        if !closed && turns.is_none() {
            reader.missing("turns", OPEN_TURNS);
            return None;
        }
        if !turns.as_ref().is_none_or(is_fit) {
            let message = format!("the turns of {} do not fit its {} surfaces", reader.title, over.len());
            let numbers = if closed { "numbers 1 or -1" } else { "numbers" };
            let label = format!("a list of {} {numbers} was expected", over.len());
            let help = if closed { CLOSED_TURNS } else { OPEN_TURNS };
            reader.context.report.error(at_turns, &message, &label, help);
            return None;
        }
        Some(Self { location, over, turns, ends, radius })
    }
}
