//! Whether an equilibrium is stable: how many motions that the constraints allow release energy, counted by the inertia
//! of the stiffness. Followed along a static path, the count changes where the path buckles.
//!
//! What buckles, and when, is found from the softest motion of the unstable one: its eigenvalue there, and what the
//! same motion costs at the stable one. Beside very stiff springs round-off may count a motion too many: the softest
//! one then costs energy, and nothing is told.

use crate::error::decimal;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::mass::MassAt;
use crate::solve::modes;
use crate::solve::modes::subspace::Subspace;
use crate::solve::newton::kkt::Kkt;

/// Vectors for the softest motion: two that come together, as a round strut's, and two to keep the others away.
const BLOCK: usize = 4;
/// Most sweeps for it.
const MOST_SWEEPS: usize = 50;
/// What an unstable mode of the stiffness means under loads that have no potential.
const UNDECIDED: &str = "forces without a potential act (follower loads, moments, drag, friction), and the \
                         stiffness alone does not decide: the equilibrium may be stable all the same, or flutter \
                         earlier; a dynamic analysis with a small disturbance shows it";

/// Round-off of an eigenvalue over the sum of the sizes that cancel in it: a rope that can slide along its post has
/// nothing else.
const ROUND_OFF: f64 = 1e-10;
/// Error of a vector at which its eigenvalue, which has the square of it, is known.
const ACCURATE: f64 = 1e-3;

/// What is known of an equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StabilityRecord {
    /// Its time, s.
    pub time: f64,
    /// How many motions release energy.
    pub unstable: usize,
    /// The same as counted from the state alone, without the correction by [`Stability::mark_stable`].
    pub counted: usize,
}

/// The softest motion about an equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct Softest {
    /// Its `ω²`, 1/s².
    pub eigenvalue: f64,
    /// Its round-off, 1/s².
    pub round_off: f64,
    /// Whether it is surely the softest one.
    pub is_found: bool,
    /// The motion, a change of the coordinates with `xᵀ M x = 1`.
    pub shape: Vec<f64>,
}

impl Softest {
    /// Whether no motion releases energy, because this one does not.
    pub fn is_stable(&self) -> bool {
        self.is_found && self.eigenvalue >= -self.round_off
    }
}

/// Follows the stability along a path of equilibria. Scratch memory, but for remarks that are not taken yet.
#[derive(Debug, Default)]
pub struct Stability {
    known: Option<StabilityRecord>,
    remarks: Vec<Remark>,
    critical: Option<f64>,
}

/// A sentence to be told.
#[derive(Debug)]
struct Remark {
    text: String,
    /// Whether it is of the stability, which a finer mesh tells better.
    is_of_stability: bool,
}

impl Stability {
    /// What is known of the last equilibrium judged.
    pub fn known(&self) -> Option<StabilityRecord> {
        self.known
    }

    /// When the path has become unstable for the first time, s.
    pub fn critical(&self) -> Option<f64> {
        self.critical
    }

    fn tell(&mut self, text: String) {
        self.remarks.push(Remark { text, is_of_stability: true });
    }

    /// The next equilibrium does not follow from the last one judged.
    pub fn forget(&mut self) {
        self.known = None;
    }

    /// The equilibrium of `time`, s, is stable: it was counted wrong.
    pub fn mark_stable(&mut self, time: f64) {
        if let Some(known) = self.known.as_mut().filter(|known| known.time == time) {
            known.unstable = 0;
        }
    }

    /// Records that the equilibrium of `time`, s, is stable.
    pub fn record_stable(&mut self, time: f64) {
        self.known = Some(StabilityRecord { time, unstable: 0, counted: 0 });
    }

    /// Judges the equilibrium of `time`, s, whose matrix `kkt` has and has factorized.
    pub fn judge(&mut self, system: &System, kkt: &mut Kkt, time: f64) {
        self.known =
            kkt.releasing_motions(system).map(|unstable| StabilityRecord { time, unstable, counted: unstable });
    }

    /// Whether the last equilibrium judged is unstable and the one of `before` is not, or the other way round.
    pub fn differs(&self, before: StabilityRecord) -> bool {
        self.known.is_some_and(|now| (now.unstable == 0) != (before.unstable == 0))
    }

    /// Adds a sentence to what there is to be told.
    pub fn add_remark(&mut self, remark: String) {
        self.remarks.push(Remark { text: remark, is_of_stability: false });
    }

    /// Remarks that the equilibrium `state`, the first one, is unstable: what would leave it is `softest`.
    pub fn remark_start(&mut self, system: &System, state: &State, softest: &Softest) {
        let (time, moved) = (decimal(state.time), moved(system, state, softest));
        self.critical.get_or_insert(state.time);
        self.tell(if system.follows_no_potential(&state.excitation) {
            format!("the stiffness at t = {time} s has an unstable mode, which moves most at {moved}; {UNDECIDED}")
        } else {
            format!(
                "the equilibrium of t = {time} s is unstable: what would leave it moves most at {moved}; a small imperfection shows the stable ones"
            )
        });
    }

    /// Remarks what has changed from `before` to the last equilibrium judged; `softest` is the softest motion of the
    /// unstable one of the two, `state`, and `other` what that motion costs at the stable one, 1/s².
    pub fn remark(&mut self, system: &System, state: &State, before: StabilityRecord, softest: &Softest, other: f64) {
        let Some(now) = self.known else { return };
        let share = (other / (other - softest.eigenvalue)).clamp(0.0, 1.0);
        let (from, to) = if now.unstable > 0 { (before.time, now.time) } else { (now.time, before.time) };
        let critical = from + (to - from) * share;
        let (first, second) = (decimal(before.time), decimal(now.time));
        let when = format!("between t = {first} s and {second} s, by interpolation at t = {critical:.6} s");
        if now.unstable > 0 {
            self.critical.get_or_insert(critical);
        }
        self.tell(if system.follows_no_potential(&state.excitation) {
            let (change, moved) =
                (if now.unstable == 0 { "loses its" } else { "gets an" }, moved(system, state, softest));
            format!("the stiffness {change} unstable mode {when}, which moves most at {moved}; {UNDECIDED}")
        } else if now.unstable == 0 {
            format!("the equilibrium becomes stable again {when}")
        } else {
            let ways = if now.unstable > 1 { format!(", in {} ways at once", now.unstable) } else { String::new() };
            let moved = moved(system, state, softest);
            format!(
                "the equilibrium becomes unstable {when}{ways}: what buckles moves most at {moved}; the equilibria found beyond are \
                 unstable, a small imperfection shows the buckled ones"
            )
        });
    }

    /// What there is to be told, once; that of the stability if `of_stability`.
    pub fn take_remarks(&mut self, of_stability: bool) -> Vec<String> {
        let remarks = std::mem::take(&mut self.remarks).into_iter();
        remarks.filter(|own| of_stability || !own.is_of_stability).map(|own| own.text).collect()
    }
}

/// What a motion moves most at `state`.
fn moved(system: &System, state: &State, softest: &Softest) -> String {
    let mut snapshot = FrameCache::default();
    system.most_moved(&snapshot.of(system, state), &softest.shape).what
}

/// The softest motion about `state` of the system whose matrix `kkt` has and has factorized; it then has another one.
/// None where it is not found.
pub fn softest(system: &System, kkt: &mut Kkt, state: &State) -> Option<Softest> {
    let stiffness = kkt.blocks.symmetric_part();
    let mut cache = FrameCache::default();
    cache.set(system, &state.q, &state.triads);
    let mass = MassAt::new(&state.prescribed.drives, &cache).wet(&state.q, state.time);
    let shift = modes::first_shift(system, mass, &stiffness);
    modes::positive_shift(system, mass, kkt, &stiffness, shift, state.time).ok()?;
    let constraints = system.constraints() - system.released_constraints(&state.prescribed);
    let freedoms = system.coordinates().saturating_sub(constraints);
    let mut block = Subspace::new(system, mass, BLOCK.min(freedoms));
    let (mut sweep, mut is_found) = (0, false);
    while sweep < MOST_SWEEPS && !is_found {
        let ritz = block.sweep(system, mass, kkt).ok()?;
        // The first sweep has only brought the vectors to the constraints; the first vector is the lowest.
        is_found = sweep > 0 && ritz.first().is_some_and(|first| first.error < ACCURATE);
        sweep += 1;
    }
    let shape = block.vectors().first()?.clone();
    let (eigenvalue, round_off) = (stiffness.form(&shape, &shape), ROUND_OFF * stiffness.magnitude(&shape));
    Some(Softest { eigenvalue, round_off, is_found, shape })
}
