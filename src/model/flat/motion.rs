//! Where a copy is: its original, turned and then moved, `R (x - center) + center + move`; in nested copies one motion
//! after the other.

use super::scalar::Scalar;
use super::tables::{Role, role};
use crate::model::text::source::Place;
use crate::model::text::tree::{Entry, Item, Node};

/// A turn and a move: `x` to `turn x + shift`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Motion {
    turn: [[Scalar; 3]; 3],
    shift: [Scalar; 3],
}

/// How far stiffnesses that differ may be off the global axes, over the largest.
const OFF_AXES: f64 = 1e-12;

/// Why a part cannot be turned: where, and in words.
pub(super) type Refusal = (Place, &'static str, &'static str);

impl Motion {
    /// No motion.
    pub fn none() -> Self {
        Self { turn: [0, 1, 2].map(|i| [0, 1, 2].map(|j| Scalar::Number(f64::from(u8::from(i == j))))), shift: zeros() }
    }

    /// A move.
    pub fn shifted(shift: [Scalar; 3]) -> Self {
        Self { shift, ..Self::none() }
    }

    /// A turn about an axis through `center`; none: the axis has no direction.
    pub fn turned(axis: [f64; 3], angle: &Scalar, center: &[Scalar; 3]) -> Option<Self> {
        let length = axis.iter().map(|part| part * part).sum::<f64>().sqrt();
        if length == 0.0 || !length.is_finite() {
            return None;
        }
        let n = axis.map(|part| part / length);
        let [sin, cos] = angle.sin_cos();
        let rest = Scalar::Number(1.0).minus(&cos);
        // Rodrigues: R = cos I + sin [n] + (1 - cos) n n'.
        let cross = [[0.0, -n[2], n[1]], [n[2], 0.0, -n[0]], [-n[1], n[0], 0.0]];
        let entry = |i: usize, j: usize| {
            let unit = if i == j { cos.clone() } else { Scalar::Number(0.0) };
            let product = n[i] * n[j];
            // About a coordinate axis, 1 itself instead of cos + (1 - cos).
            if i == j && product == 1.0 {
                return Scalar::Number(1.0);
            }
            unit.plus(&Scalar::Number(cross[i][j]).times(&sin)).plus(&Scalar::Number(product).times(&rest))
        };
        let turn = [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)));
        let about = Self { turn, shift: zeros() };
        let moved = about.direction(center);
        let shift = [0, 1, 2].map(|i| center[i].minus(&moved[i]));
        Some(Self { shift, ..about })
    }

    /// First `inner`, then this one.
    pub fn after(&self, inner: &Self) -> Self {
        let column = |j: usize| self.direction(&[0, 1, 2].map(|i| inner.turn[i][j].clone()));
        let columns = [column(0), column(1), column(2)];
        Self { turn: [0, 1, 2].map(|i| [0, 1, 2].map(|j| columns[j][i].clone())), shift: self.position(&inner.shift) }
    }

    /// Whether anything moves.
    pub fn moves(&self) -> bool {
        *self != Self::none()
    }

    /// Whether directions stay as they are.
    fn keeps_directions(&self) -> bool {
        self.turn == Self::none().turn
    }

    fn direction(&self, v: &[Scalar; 3]) -> [Scalar; 3] {
        [0, 1, 2].map(|i| {
            let row = &self.turn[i];
            row[0].times(&v[0]).plus(&row[1].times(&v[1])).plus(&row[2].times(&v[2]))
        })
    }

    fn position(&self, x: &[Scalar; 3]) -> [Scalar; 3] {
        let turned = self.direction(x);
        [0, 1, 2].map(|i| turned[i].plus(&self.shift[i]))
    }

    /// Where the origin goes; none: it stays.
    pub fn origin(&self) -> Option<&[Scalar; 3]> {
        (self.shift != zeros()).then_some(&self.shift)
    }

    /// Moves a part of a section: its keys are those of the original, with names and numbers of the copy. `on_frame`:
    /// it is a point on a frame.
    ///
    /// # Errors
    /// Something in it cannot be turned.
    pub fn apply(&self, section: &str, place: Place, on_frame: bool, entries: &mut Vec<Entry>) -> Result<(), Refusal> {
        if !self.moves() {
            return Ok(());
        }
        let is_follower =
            entries.iter().any(|entry| entry.key == "follower" && matches!(entry.item.node, Node::Boolean(true)));
        // Numbers along the axes of sections turn with the beam.
        let is_of_section = entries
            .iter()
            .any(|entry| entry.key == "axes" && matches!(&entry.item.node, Node::Text(word) if word == "section"));
        if !self.keeps_directions() {
            add_defaults(section, place, entries);
        }
        let is_on_ground = is_on_ground(entries);
        for entry in entries {
            let is_list = matches!(entry.item.node, Node::Array(_));
            match role(section, &entry.key, is_list) {
                Role::Position => self.move_list(&mut entry.item, true)?,
                Role::Offset if is_on_ground => self.move_list(&mut entry.item, true)?,
                // The rotation vector of a turned frame turns along, which leaves axes along the global ones where they
                // are.
                Role::Offset if on_frame => self.move_list(&mut entry.item, false)?,
                Role::Direction if !is_follower => self.move_list(&mut entry.item, false)?,
                Role::AlongAxes if !is_of_section => self.turn_diagonal(&mut entry.item)?,
                Role::Axes => self.move_rows(&mut entry.item, false)?,
                Role::Curve => self.move_curve(&mut entry.item)?,
                _ => {}
            }
        }
        Ok(())
    }

    /// Moves a list of three; anything else is left for the reader to refuse.
    fn move_list(&self, item: &mut Item, is_position: bool) -> Result<(), Refusal> {
        let Node::Array(items) = &mut item.node else { return Ok(()) };
        let [x, y, z] = items.as_mut_slice() else { return Ok(()) };
        self.move_components([x, y, z], is_position)
    }

    fn move_rows(&self, item: &mut Item, is_position: bool) -> Result<(), Refusal> {
        let Node::Array(rows) = &mut item.node else { return Ok(()) };
        rows.iter_mut().try_for_each(|row| self.move_list(row, is_position))
    }

    fn move_curve(&self, item: &mut Item) -> Result<(), Refusal> {
        let Node::Table(entries) = &mut item.node else { return Ok(()) };
        if let Some(points) = entries.iter_mut().find(|entry| entry.key == "points") {
            return self.move_rows(&mut points.item, true);
        }
        for end in entries.iter_mut().filter(|entry| matches!(entry.key.as_str(), "from" | "to")) {
            self.move_list(&mut end.item, true)?;
        }
        let mut coordinates: [Option<&mut Item>; 3] = [None, None, None];
        for entry in entries {
            if let Some(at) = ["x", "y", "z"].iter().position(|key| *key == entry.key) {
                coordinates[at] = Some(&mut entry.item);
            }
        }
        match coordinates {
            [Some(x), Some(y), Some(z)] => self.move_components([x, y, z], true),
            _ => Ok(()),
        }
    }

    /// Moves three components, which may be in pieces.
    fn move_components(&self, items: [&mut Item; 3], is_position: bool) -> Result<(), Refusal> {
        let moved = |v: &[Scalar; 3]| if is_position { self.position(v) } else { self.direction(v) };
        if let [Some(x), Some(y), Some(z)] = items.each_ref().map(|item| Scalar::of(item)) {
            for (item, value) in items.into_iter().zip(moved(&[x, y, z])) {
                item.node = value.node();
            }
            return Ok(());
        }
        if self.keeps_directions() && !is_position {
            return Ok(());
        }
        let place = items[0].place;
        let Some(pieces) = common_pieces(&items) else {
            let label = "they must have the same `until` everywhere";
            return Err((place, "the components of this vector are in pieces that a turn would mix", label));
        };
        let lists = items.each_ref().map(|item| match &item.node {
            Node::Array(list) => Some(list.clone()),
            _ => None,
        });
        let mut result: [Vec<Item>; 3] = [Vec::new(), Vec::new(), Vec::new()];
        for piece in 0..pieces {
            let value = |i: usize| match &lists[i] {
                Some(list) => is_of(&list[piece]).and_then(Scalar::of),
                None => Scalar::of(items[i]),
            };
            // What is wrong in a piece is for the reader to say.
            let (Some(x), Some(y), Some(z)) = (value(0), value(1), value(2)) else { return Ok(()) };
            let Some(template) = lists.iter().flatten().next().map(|list| list[piece].clone()) else { return Ok(()) };
            for (list, scalar) in result.iter_mut().zip(moved(&[x, y, z])) {
                let mut item = template.clone();
                if let Node::Table(entries) = &mut item.node {
                    entries.iter_mut().filter(|entry| entry.key == "is").for_each(|is| is.item.node = scalar.node());
                }
                list.push(item);
            }
        }
        for (item, list) in items.into_iter().zip(result) {
            item.node = Node::Array(list);
        }
        Ok(())
    }

    /// Turns values along the global axes; they must lie along them again.
    fn turn_diagonal(&self, item: &mut Item) -> Result<(), Refusal> {
        let Node::Array(items) = &mut item.node else { return Ok(()) };
        let [x, y, z] = items.as_mut_slice() else { return Ok(()) };
        let (Some(a), Some(b), Some(c)) = (Scalar::of(x), Scalar::of(y), Scalar::of(z)) else { return Ok(()) };
        if a == b && b == c || self.keeps_directions() {
            return Ok(());
        }
        let refusal = (
            item.place,
            "a bushing has its values along the global axes, and this copy is turned away from them",
            "equal values in the plane of the turn were expected",
        );
        let numbers = |row: &[Scalar; 3]| -> Option<[f64; 3]> {
            let [Scalar::Number(x), Scalar::Number(y), Scalar::Number(z)] = row else { return None };
            Some([*x, *y, *z])
        };
        let [Some(r0), Some(r1), Some(r2)] = self.turn.each_ref().map(numbers) else { return Err(refusal) };
        let turn = [r0, r1, r2];
        let values = [a, b, c];
        // A turn by right angles permutes them, whatever they are.
        let from = |i: usize| turn[i].iter().position(|entry| entry.abs() == 1.0);
        if let [Some(i), Some(j), Some(k)] = [from(0), from(1), from(2)] {
            for (item, from) in [x, y, z].into_iter().zip([i, j, k]) {
                item.node = values[from].node();
            }
            return Ok(());
        }
        let Some(k) = numbers(&values) else { return Err(refusal) };
        let entry = |i: usize, j: usize| (0..3).map(|m| turn[i][m] * k[m] * turn[j][m]).sum::<f64>();
        let largest = k.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
        if [(0, 1), (1, 2), (2, 0)].iter().any(|(i, j)| entry(*i, *j).abs() > OFF_AXES * largest) {
            return Err(refusal);
        }
        for (i, item) in [x, y, z].into_iter().enumerate() {
            item.node = Scalar::Number(entry(i, i)).node();
        }
        Ok(())
    }
}

fn zeros() -> [Scalar; 3] {
    [0, 1, 2].map(|_| Scalar::Number(0.0))
}

/// Whether a point is on the ground, where it is if nothing else is said.
fn is_on_ground(entries: &[Entry]) -> bool {
    let on = entries.iter().find(|entry| entry.key == "on");
    on.is_none_or(|entry| matches!(&entry.item.node, Node::Text(name) if name == "ground"))
}

/// Directions that the format has where the file says nothing: a turned copy must say them.
fn add_defaults(section: &str, place: Place, entries: &mut Vec<Entry>) {
    let number = |value: f64| Item { place, node: Node::Float(value) };
    let unit =
        |k: usize| Item { place, node: Node::Array((0..3).map(|i| number(f64::from(u8::from(i == k)))).collect()) };
    let (key, item) = match section {
        "beam" => ("y_axis", unit(1)),
        "body" => ("axes", Item { place, node: Node::Array((0..3).map(unit).collect()) }),
        "point" if is_on_ground(entries) => ("axes", Item { place, node: Node::Array((0..3).map(unit).collect()) }),
        _ => return,
    };
    if entries.iter().all(|entry| entry.key != key) {
        entries.push(Entry { key: key.to_owned(), key_place: place, item });
    }
}

/// The number of the pieces that the components have; none: their limits differ. Components without pieces fit to all.
fn common_pieces(items: &[&mut Item; 3]) -> Option<usize> {
    let mut common: Option<Vec<Option<Scalar>>> = None;
    for item in items {
        let Node::Array(pieces) = &item.node else { continue };
        let limit = |piece: &Item| match &piece.node {
            Node::Table(entries) => {
                entries.iter().find(|entry| entry.key == "until").and_then(|entry| Scalar::of(&entry.item))
            }
            _ => None,
        };
        let limits: Vec<_> = pieces.iter().map(limit).collect();
        if common.get_or_insert_with(|| limits.clone()) != &limits {
            return None;
        }
    }
    common.map(|limits| limits.len())
}

/// The value of a piece.
fn is_of(piece: &Item) -> Option<&Item> {
    match &piece.node {
        Node::Table(entries) => entries.iter().find(|entry| entry.key == "is").map(|entry| &entry.item),
        _ => None,
    }
}
