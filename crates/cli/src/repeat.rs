//! A simulation that is looked at row by row, and again with finer steps and meshes until its results are accurate.

use super::advance::advance;
use super::progress::last_row;
use super::{Stop, background, complain, failed, say, start};
use ancf14::fmi::Model;
use ancf14::model::refinement::{Found, Refinement, is_repeated};
use ancf14::model::simulation::Simulation;

/// The last run that counts, one that fails up to the failure.
pub struct Seen<L> {
    pub simulation: Simulation,
    /// Its looker.
    pub look: L,
    /// How it has ended.
    pub outcome: Result<(), Stop>,
    /// The steps and meshes that the runs have found; none: those of the file.
    pub found: Option<Found>,
    /// A repetition began, and failed: files that lookers write are those of no whole run.
    pub is_torn: bool,
}

/// Whether a run of the model is repeated, as `run` does where nothing else is asked for.
pub fn refines(simulation: &Simulation) -> bool {
    is_repeated(simulation.document()) && !simulation.document().simulation.verify
}

/// Simulates, and repeats the run if it `refines`. `begin` makes the looker of a run, which is at its start, and adds to
/// the warnings that are told at the end; `row` shows it a row.
pub fn repeat<L>(
    mut simulation: Simulation,
    refines: bool,
    mut begin: impl FnMut(&Simulation, &mut Vec<String>) -> Result<L, Stop>,
    mut row: impl FnMut(&mut L, u64, &Simulation) -> Result<(), Stop>,
) -> Result<Seen<L>, Stop> {
    let last = last_row(&simulation)?;
    let mut refinement = if refines {
        simulation.ask_for_mesh_error(background::start);
        Refinement::of(&mut simulation, None)
    } else {
        None
    };
    let holds = refinement.is_some();
    start(&mut simulation)?;
    let mut held = Vec::new();
    let mut look = begin(&simulation, &mut held)?;
    let mut seen = run(&mut simulation, last, refinement.as_mut(), holds.then_some(&mut held), |number, own| {
        row(&mut look, number, own)
    });
    if let (Err(End::Model(_)), Some(refinement)) = (&seen, refinement.as_mut()) {
        let mut next = refinement.rescue(&simulation);
        while let Some(mut own) = next.take() {
            let mut own_held = Vec::new();
            match again(&mut own, (last, &mut *refinement), &mut own_held, (&mut begin, &mut row)) {
                Ok(own_look) => (simulation, look, held, seen) = (*own, own_look, own_held, Ok(())),
                // The first failure is told.
                Err(End::Model(_)) => next = refinement.rescue(&own),
                Err(end) => seen = Err(end),
            }
        }
    }
    let mut outcome = seen.map_err(End::stop);
    let (mut found, mut is_torn) = (None, false);
    if let Some(refinement) = refinement.as_mut().filter(|_| outcome.is_ok()) {
        while let Some(mut next) = refinement.judge(&simulation) {
            let mut own = Vec::new();
            match again(&mut next, (last, &mut *refinement), &mut own, (&mut begin, &mut row)) {
                Ok(next_look) => (simulation, look, held, is_torn) = (*next, next_look, own, false),
                Err(End::Model(stop)) => {
                    is_torn = true;
                    refinement.fail(stop.reason());
                }
                Err(End::Look(stop)) => {
                    outcome = Err(stop);
                    break;
                }
            }
        }
        let told = refinement.outcome(&simulation);
        held.extend(told.warning());
        say(&told.line())?;
        found = Some(refinement.found(&simulation));
    }
    held.iter().for_each(|warning| complain(&format!("warning: {warning}")));
    Ok(Seen { simulation, look, outcome, found, is_torn })
}

/// Why a run ends early.
enum End {
    Model(Stop),
    Look(Stop),
}

impl End {
    fn stop(self) -> Stop {
        match self {
            Self::Model(stop) | Self::Look(stop) => stop,
        }
    }
}

/// Repeats a run; its warnings are `held`.
fn again<L>(
    next: &mut Simulation,
    (last, refinement): (u64, &mut Refinement),
    held: &mut Vec<String>,
    (begin, row): (
        &mut impl FnMut(&Simulation, &mut Vec<String>) -> Result<L, Stop>,
        &mut impl FnMut(&mut L, u64, &Simulation) -> Result<(), Stop>,
    ),
) -> Result<L, End> {
    let time = next.about().start;
    next.initialize(time).map_err(|failure| End::Model(failed(next, &failure)))?;
    next.take_warnings();
    let mut look = begin(next, held).map_err(End::Look)?;
    run(next, last, Some(refinement), Some(held), |number, own| row(&mut look, number, own))?;
    Ok(look)
}

/// Advances from the start to the end, and shows each row.
fn run(
    simulation: &mut Simulation,
    last: u64,
    mut refinement: Option<&mut Refinement>,
    held: Option<&mut Vec<String>>,
    mut row: impl FnMut(u64, &Simulation) -> Result<(), Stop>,
) -> Result<(), End> {
    let mut is_refused = false;
    let mut see = |number: u64, own: &Simulation| {
        refinement.iter_mut().for_each(|refinement| refinement.look(own));
        row(number, own).inspect_err(|_| is_refused = true)
    };
    see(0, simulation).map_err(End::Look)?;
    let outcome = advance(simulation, last, held, &mut see);
    outcome.map_err(|stop| if is_refused { End::Look(stop) } else { End::Model(stop) })
}
