//! The constrained linear system `[A Bᵀ; C 0] [x; y] = [f; g]`: coordinates first, then one row a constraint condition.

use super::definite::Definite;
use super::yielding::stiffnesses;
use crate::error::Error;
use crate::math::blocks::{Block, Blocks};
use crate::mechanics::constraint::joint::{Joint, JointGradient};
use crate::mechanics::geometry::marker_jacobian::MarkerMatrix;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::system::{System, copy_corner, copy_transposed};
use crate::solve::linear::direct::DirectSolver;
use crate::solve::linear::elimination_tree::Unknowns;
use crate::solve::linear::sparse_ldl::SparseLdl;
use crate::solve::linear::sparse_lu::SparseLu;
use crate::solve::linear::units::Units;
use crate::solve::linear::{Regularity, Singular, irregular};

/// Shift of the scaled diagonal that makes a singular matrix regular: small against honest entries, large against
/// round-off.
const SHIFT: f64 = 1e-10;

/// How far scaled conditions give way under a unit of their force where motions are counted: so little that no soft
/// motion notices, so much that the round-off of conditions (1e-16 over it) stays below the softest motions.
const YIELDING: f64 = 1e-5;

/// How the springs are measured that stand for conditions.
#[derive(Clone, Copy, Debug)]
enum Springs {
    /// The softest coordinate that a condition acts on measures them; the stiffest one of all those of bodies.
    OfTheMatrix,
    /// Those of bodies by the springs of their joints ([`stiffnesses`]).
    OfTheJoints,
}

const SPRINGS: [Springs; 2] = [Springs::OfTheMatrix, Springs::OfTheJoints];

/// Matrix and factorization of one constrained system.
#[derive(Debug)]
pub struct Kkt {
    /// The matrix; the system's tangent blocks come first.
    pub blocks: Blocks,
    /// First of each joint's constraint blocks: columns of a and b, rows of a and b, and of a joint with a switch the
    /// diagonal of its multipliers.
    joints: Vec<usize>,
    /// First of each joint's four stiffness blocks, where the system has them.
    curvatures: Vec<usize>,
    solver: DirectSolver,
    /// Second derivatives of one joint.
    parts: Box<[MarkerMatrix; 4]>,
    /// Each made when it is first asked for.
    definite: Option<Option<Definite>>,
    inertia: Option<Inertia>,
}

/// The matrix of the coordinates alone, constraints included as springs.
#[derive(Debug)]
struct Inertia {
    /// Which blocks of the whole matrix are in it.
    kept: Vec<usize>,
    /// The second sides of gears, by their numbers among the joints, each with the first of its eight blocks that
    /// connect the two sides.
    gears: Vec<(usize, usize)>,
    blocks: Blocks,
    ldl: SparseLdl,
}

impl Inertia {
    /// For `system` and the blocks `whole` of its matrix.
    fn new(system: &System, whole: &Blocks) -> Option<Self> {
        let coordinates = system.coordinates();
        let inside = |block: &Block| block.row < coordinates && block.column < coordinates;
        let (mut kept, mut blocks) = (Vec::new(), Blocks::default());
        for (number, block) in whole.layout().iter().enumerate().filter(|(_, block)| inside(block)) {
            kept.push(number);
            blocks.push(*block);
        }
        let mut gears = Vec::new();
        for (number, pair) in system.joints.windows(2).enumerate().filter(|(_, pair)| pair[1].is_second_side()) {
            gears.push((number + 1, blocks.layout().len()));
            for slot in 0..4 {
                let [first, second] = [(&pair[0], slot / 2), (&pair[1], slot % 2)].map(|(joint, side)| {
                    let marker = if side == 0 { &joint.a } else { &joint.b };
                    marker.coordinates(&system.mesh)
                });
                for (rows, columns) in [(&first, &second), (&second, &first)] {
                    let (row, column) = (rows.start, columns.start);
                    blocks.push(Block { row, column, rows: rows.len(), columns: columns.len() });
                }
            }
        }
        let ldl = SparseLdl::new(coordinates, &blocks).ok()?;
        Some(Self { kept, gears, blocks, ldl })
    }
}

impl Kkt {
    /// For projections on the constraints: no second derivatives of them.
    pub fn for_projections(system: &System) -> Self {
        let (blocks, joints) = constraint_layout(system);
        Self::finish(system, blocks, joints, Vec::new(), true)
    }

    /// For steps in time: second derivatives of the constraints included.
    pub fn for_steps(system: &System) -> Self {
        Self::for_newton(system, true)
    }

    /// For equilibria, without inertia: second derivatives of the constraints included.
    pub fn for_equilibria(system: &System) -> Self {
        Self::for_newton(system, false)
    }

    fn for_newton(system: &System, inertia: bool) -> Self {
        let (mut blocks, joints) = constraint_layout(system);
        let mut curvatures = Vec::new();
        for joint in &system.joints {
            let (a, b) = (joint.a.coordinates(&system.mesh), joint.b.coordinates(&system.mesh));
            for (number, (rows, columns)) in [(&a, &a), (&a, &b), (&b, &a), (&b, &b)].into_iter().enumerate() {
                let block = Block { row: rows.start, column: columns.start, rows: rows.len(), columns: columns.len() };
                let slot = blocks.push(block);
                if number == 0 {
                    curvatures.push(slot);
                }
            }
        }
        Self::finish(system, blocks, joints, curvatures, inertia)
    }

    /// `inertia`: the matrix will have the masses in it.
    fn finish(system: &System, mut blocks: Blocks, joints: Vec<usize>, curvatures: Vec<usize>, inertia: bool) -> Self {
        blocks.shrink_to_fit();
        let solver = DirectSolver::new(unknowns(system, inertia), units(system), &blocks);
        let parts = Box::new([MarkerMatrix::zeros(); 4]);
        Self { blocks, joints, curvatures, solver, parts, definite: None, inertia: None }
    }

    /// Sets the constraint blocks: `scale` times `columns` transposed on the right, `rows` below.
    pub fn set_constraints(&mut self, system: &System, columns: &[JointGradient], rows: &[JointGradient], scale: f64) {
        for (number, joint) in system.joints.iter().enumerate() {
            let start = self.joints[number];
            let (count_a, count_b) = (joint.a.coordinates(&system.mesh).len(), joint.b.coordinates(&system.mesh).len());
            let conditions = joint.rows();
            let (right, below) = (&columns[number], &rows[number]);
            copy_transposed(self.blocks.block_mut(start), count_a, &right.a, scale);
            copy_transposed(self.blocks.block_mut(start + 1), count_b, &right.b, scale);
            copy_corner(self.blocks.block_mut(start + 2), conditions, &below.a, 1.0);
            copy_corner(self.blocks.block_mut(start + 3), conditions, &below.b, 1.0);
            if joint.holding.is_some() {
                // The multipliers of what is released are 0, by an equation of their own.
                let own = if right.is_released { 1.0 } else { 0.0 };
                let diagonal = self.blocks.block_mut(start + 4);
                (0..conditions).for_each(|row| diagonal[row * conditions + row] = own);
            }
        }
    }

    /// Sets the stiffness blocks of all joints: `factor · ∂²(multipliers·g)/∂q²` at `c`, and on the way `gradients` to
    /// `∂g/∂q`.
    pub fn set_curvatures_and_gradients(
        &mut self,
        system: &System,
        c: &Configuration,
        multipliers: &[f64],
        factor: f64,
        gradients: &mut Vec<JointGradient>,
    ) {
        gradients.resize(system.joints.len(), JointGradient::default());
        for (((joint, rows), gradient), first) in system.joints_with_rows().zip(gradients).zip(&self.curvatures) {
            let own = &multipliers[rows];
            let [a, b] = [joint.a.coordinates(&system.mesh).len(), joint.b.coordinates(&system.mesh).len()];
            let parts = &mut *self.parts;
            joint.phi_q_and_qq(c, own, gradient, parts);
            for (slot, (rows, part)) in [a, a, b, b].into_iter().zip(parts).enumerate() {
                copy_corner(self.blocks.block_mut(first + slot), rows, part, factor);
            }
        }
    }

    /// Factorizes and solves in place.
    ///
    /// # Errors
    /// The matrix is singular: the error names the part of the system that the lost direction moves most.
    pub fn solve(&mut self, system: &System, vector: &mut [f64], time: f64) -> Result<(), Error> {
        let solved = self.solver.factorize(&self.blocks).and_then(|()| self.solver.solve(&self.blocks, vector));
        solved.map_err(|Singular| self.singular(system, time))
    }

    /// Factorizes, for [`Self::solve_again`].
    ///
    /// # Errors
    /// The matrix is singular: the error names the part of the system that the lost direction moves most.
    pub fn factorize(&mut self, system: &System, time: f64) -> Result<(), Error> {
        let factorized = self.solver.factorize(&self.blocks);
        factorized.map_err(|Singular| self.singular(system, time))
    }

    /// The error of a matrix that is singular: it names the part of the system that the lost direction moves most.
    fn singular(&self, system: &System, time: f64) -> Error {
        Error::Singular { time, what: self.lost_direction(system) }
    }

    /// Solves in place with the last factorization.
    ///
    /// # Errors
    /// The solution is not accurate.
    pub fn solve_again(&mut self, vector: &mut [f64]) -> Result<(), Singular> {
        self.solver.solve(&self.blocks, vector)
    }

    /// [`Self::solve_again`], with an error that names the part of the system that the lost direction moves most.
    ///
    /// # Errors
    /// The solution is not accurate: the matrix is singular.
    pub fn solve_more(&mut self, system: &System, vector: &mut [f64], time: f64) -> Result<(), Error> {
        self.solve_again(vector).map_err(|Singular| self.singular(system, time))
    }

    /// Sign of the determinant of the factorized matrix; 0: not known.
    pub fn sign(&self) -> i8 {
        self.solver.sign()
    }

    /// Solves in place with the last factorization, after it has been solved with, for a correction that is far smaller
    /// than what it corrects: not refined.
    ///
    /// # Errors
    /// The solution is not accurate.
    pub fn solve_roughly(&mut self, vector: &mut [f64]) -> Result<(), Singular> {
        self.solver.solve_roughly(&self.blocks, vector)
    }

    /// Whether it is certain that no motion that the constraints allow releases energy, by the symmetric part of the
    /// matrix that is set. A factorization is neither needed nor kept.
    pub fn holds_all_motions(&mut self, system: &System) -> bool {
        self.solver.set_scale(&self.blocks) && SPRINGS.into_iter().any(|springs| self.is_definite(system, springs))
    }

    /// The stiffness of the springs that stand for the conditions.
    fn springs(&self, system: &System, springs: Springs) -> Vec<f64> {
        let scale = |index| self.solver.scale(index);
        match springs {
            Springs::OfTheMatrix => {
                let coordinates = system.coordinates();
                (0..system.constraints()).map(|row| scale(coordinates + row).powi(2)).collect()
            }
            Springs::OfTheJoints => stiffnesses(system, &self.blocks, &self.joints, scale),
        }
    }

    /// Whether the matrix that [`Self::releasing_motions`] factorizes is positive definite up to round-off; where it is
    /// not, nothing is known.
    fn is_definite(&mut self, system: &System, springs: Springs) -> bool {
        let springs = self.springs(system, springs);
        let coordinates = system.coordinates();
        let definite = self.definite.get_or_insert_with(|| {
            // The second sides of gears share a condition with the joint before.
            let has_gears = system.joints.iter().any(Joint::is_second_side);
            if has_gears { None } else { Definite::new(coordinates, &self.blocks) }
        });
        let Some(definite) = definite else { return false };
        definite.take(&self.blocks);
        for ((joint, rows), first) in system.joints_with_rows().zip(&self.joints) {
            let sides = [(&joint.a, first + 2), (&joint.b, first + 3)];
            let sides = sides.map(|(marker, block)| (marker.coordinates(&system.mesh), self.blocks.block(block)));
            for (condition, row) in rows.clone().enumerate() {
                let gradient = sides.iter().flat_map(|(range, values)| {
                    range.clone().zip(values.iter().skip(condition).step_by(rows.len()).copied())
                });
                definite.add_spring(gradient, springs[row] / YIELDING);
            }
        }
        definite.is_definite()
    }

    /// How many independent motions that the constraints allow release energy, by the symmetric part of the matrix that
    /// is set and has been factorized: Sylvester's law of inertia counts them all, however many softer ones there are.
    /// None where a pivot vanishes.
    ///
    /// They are the negative pivots of `A + Bᵀ B/ε = L D Lᵀ`, the constraints being springs that are stiffer than
    /// anything else. Springs that give way count motions that the constraints forbid, and stiff ones those that their
    /// round-off hides: the lowest count of several springs is the nearest one.
    pub fn releasing_motions(&mut self, system: &System) -> Option<usize> {
        if SPRINGS.into_iter().any(|springs| self.is_definite(system, springs)) {
            return Some(0);
        }
        SPRINGS.into_iter().filter_map(|springs| self.negative_pivots(system, springs)).min()
    }

    /// The negative pivots with these springs; none where one vanishes.
    fn negative_pivots(&mut self, system: &System, springs: Springs) -> Option<usize> {
        let springs = self.springs(system, springs);
        if self.inertia.is_none() {
            self.inertia = Inertia::new(system, &self.blocks);
        }
        let Inertia { kept, gears, blocks, ldl } = self.inertia.as_mut()?;
        for (own, number) in kept.iter().enumerate() {
            blocks.block_mut(own).copy_from_slice(self.blocks.block(*number));
        }
        // Only the conditions of gears are between their sides.
        (kept.len()..blocks.layout().len()).for_each(|number| blocks.block_mut(number).fill(0.0));
        let stiffness = |condition: usize| springs[condition] / YIELDING;
        // Rows of a and of b; the four blocks of the joint's stiffness are aa, ab, ba, bb.
        let sides = |joint: usize| [2, 3].map(|side| self.blocks.block(self.joints[joint] + side));
        let mut second_sides = gears.iter().peekable();
        for (number, ((_, rows), curvature)) in system.joints_with_rows().zip(&self.curvatures).enumerate() {
            let own = kept.partition_point(|number| number < curvature);
            for slot in 0..4 {
                let pair = [sides(number)[slot / 2], sides(number)[slot % 2]];
                add_yielding(blocks.block_mut(own + slot), pair, rows.clone().map(stiffness));
            }
            if let Some((_, between)) = second_sides.next_if(|(joint, _)| *joint == number) {
                for slot in 0..4 {
                    let [first, second] = [sides(number - 1)[slot / 2], sides(number)[slot % 2]];
                    for (turn, pair) in [[first, second], [second, first]].into_iter().enumerate() {
                        add_yielding(blocks.block_mut(between + 2 * slot + turn), pair, rows.clone().map(stiffness));
                    }
                }
            }
        }
        ldl.negative_pivots(blocks, |index| self.solver.scale(index))
    }

    /// How many factorizations the general solver had to make.
    pub fn fallbacks(&self) -> u64 {
        self.solver.fallbacks()
    }

    /// Checks that the solution just found is the only one: a singular system may have one by chance, as a floating
    /// beam without loads has.
    ///
    /// # Errors
    /// A part of the system can move freely, or is held twice.
    pub fn check_unique(&mut self, system: &System, time: f64) -> Result<(), Error> {
        match self.solver.regularity(&self.blocks) {
            Regularity::Regular => Ok(()),
            Regularity::Singular(index) => Err(Error::Singular { time, what: advice(system, index) }),
            Regularity::Unknown => Err(Error::Singular { time, what: self.lost_direction(system) }),
        }
    }

    /// Adds `stiffness` to the diagonal at `unknown`, a coordinate.
    pub fn stiffen(&mut self, unknown: usize, stiffness: f64) {
        let contains = |block: &Block| {
            (block.row..block.row + block.rows).contains(&unknown)
                && (block.column..block.column + block.columns).contains(&unknown)
        };
        let Some(number) = self.blocks.layout().iter().position(contains) else { return };
        let Block { row, column, rows, .. } = self.blocks.layout()[number];
        self.blocks.block_mut(number)[(unknown - column) * rows + unknown - row] += stiffness;
    }

    /// Scaling of unknown `index` in the last factorization: what it is measured in.
    pub fn scale(&self, index: usize) -> f64 {
        self.solver.scale(index)
    }

    /// Factorizes the matrix and returns the unknown that a null vector moves most; none where the matrix is regular.
    ///
    /// # Errors
    /// The matrix is singular, and no motion of the system is a null vector: in words.
    pub fn find_free_unknown(&mut self, system: &System) -> Result<Option<usize>, String> {
        let regularity = match self.solver.factorize(&self.blocks) {
            Ok(()) => self.solver.regularity(&self.blocks),
            Err(Singular) => Regularity::Unknown,
        };
        let index = match regularity {
            Regularity::Regular => return Ok(None),
            Regularity::Singular(index) => index,
            Regularity::Unknown => self.lost_unknown(system)?,
        };
        if index >= system.coordinates() || system.too_short_element(index).is_some() {
            return Err(advice(system, index));
        }
        Ok(Some(index))
    }

    /// What a null vector of the matrix moves most, in words.
    fn lost_direction(&self, system: &System) -> String {
        self.lost_unknown(system).map_or_else(|what| what, |index| advice(system, index))
    }

    /// The unknown that a null vector of the matrix moves most, found by inverse iterations on the matrix with a
    /// slightly shifted diagonal.
    ///
    /// # Errors
    /// It is not found: why the matrix is singular, in words.
    fn lost_unknown(&self, system: &System) -> Result<usize, String> {
        let size = system.coordinates() + system.constraints();
        let mut shifted = self.blocks.clone();
        if shifted.values().iter().any(|value| !value.is_finite()) {
            return Err(String::from("a number in the equations is not finite; try a smaller step"));
        }
        for index in 0..size {
            let block = shifted.push(Block { row: index, column: index, rows: 1, columns: 1 });
            let sign = if index < system.coordinates() { 1.0 } else { -1.0 };
            shifted.block_mut(block)[0] = sign * SHIFT / self.solver.scale(index).powi(2);
        }
        let unnamed = || String::from("a part of the mechanism can move freely or is constrained twice");
        let Ok(mut solver) = SparseLu::new(&units(system), &shifted) else { return Err(unnamed()) };
        if solver.factorize(&shifted).is_err() {
            return Err(unnamed());
        }
        let mut vector: Vec<f64> = (0..size).map(|index| irregular(index) / self.solver.scale(index)).collect();
        for _ in 0..3 {
            if solver.solve(&mut vector).is_err() {
                return Err(unnamed());
            }
            let norm = vector.iter().fold(0.0_f64, |norm, value| norm.max(value.abs()));
            vector.iter_mut().for_each(|value| *value /= norm);
        }
        let scaled = vector.iter().enumerate().map(|(index, value)| (index, (value / self.solver.scale(index)).abs()));
        scaled.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index).ok_or_else(unnamed)
    }
}

/// Adds the products of the gradients of conditions on two sides, `left` and `right`, to the block between them: of
/// each condition by its own stiffness.
fn add_yielding(target: &mut [f64], [left, right]: [&[f64]; 2], stiffnesses: impl ExactSizeIterator<Item = f64>) {
    let conditions = stiffnesses.len();
    let (rows, columns) = (left.len() / conditions, right.len() / conditions);
    for (condition, stiffness) in stiffnesses.enumerate() {
        for column in 0..columns {
            let factor = stiffness * right[column * conditions + condition];
            for line in 0..rows {
                target[column * rows + line] += factor * left[line * conditions + condition];
            }
        }
    }
}

/// The unknowns of a system; `inertia`: the matrix has the masses in it.
pub fn unknowns(system: &System, inertia: bool) -> Unknowns {
    let nodes = system.mesh.coordinates();
    Unknowns { nodes, bodies: system.coordinates() - nodes, multipliers: system.constraints(), inertia }
}

/// The natural size of each unknown.
pub fn units(system: &System) -> Units {
    let coordinates = (0..system.coordinates()).map(|index| system.is_place(index));
    Units::new(system.size, coordinates.chain(std::iter::repeat_n(false, system.constraints())).collect())
}

/// What a null vector that is largest in unknown `index` means.
fn advice(system: &System, index: usize) -> String {
    let unknown = system.describe_unknown(index);
    if index < system.coordinates() {
        if let Some(short) = system.too_short_element(index) {
            return format!(
                "{short} is too short for the others: its stiffness hides that of {unknown}; make the elements more alike"
            );
        }
        format!("{unknown} can move freely; hold it by a joint")
    } else {
        format!(
            "{unknown} is redundant: other joints already impose its constraints; remove it, or take a joint with more \
             degrees of freedom"
        )
    }
}

/// The system's tangent blocks, then four constraint blocks a joint.
fn constraint_layout(system: &System) -> (Blocks, Vec<usize>) {
    let mut blocks = Blocks::default();
    system.push_tangent_blocks(&mut blocks);
    let mut joints = Vec::new();
    for (joint, rows) in system.joints_with_rows() {
        let row = system.coordinates() + rows.start;
        let (a, b) = (joint.a.coordinates(&system.mesh), joint.b.coordinates(&system.mesh));
        let conditions = joint.rows();
        joints.push(blocks.push(Block { row: a.start, column: row, rows: a.len(), columns: conditions }));
        blocks.push(Block { row: b.start, column: row, rows: b.len(), columns: conditions });
        blocks.push(Block { row, column: a.start, rows: conditions, columns: a.len() });
        blocks.push(Block { row, column: b.start, rows: conditions, columns: b.len() });
        if joint.holding.is_some() {
            blocks.push(Block { row, column: row, rows: conditions, columns: conditions });
        }
    }
    (blocks, joints)
}
