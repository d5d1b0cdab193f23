//! What a run is watched for: signs that its numbers should not be trusted. Each is warned of once.

mod alternation;
mod contacts;
mod ends;
mod limp;
mod mesh;
mod ropes;
mod stops;
mod struts;
mod switches;

use self::alternation::AlternationWatch;
use self::contacts::ContactWatch;
use self::ends::EndWatch;
use self::limp::LimpWatch;
use self::mesh::MeshWatch;
use self::ropes::RopeWatch;
use self::stops::StopWatch;
use self::struts::StrutWatch;
use crate::error::decimal;
use crate::mechanics::output::mesh_error::Deformation;
use crate::mechanics::state::State;
use crate::mechanics::state::energy_balance::Alarm;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::model::file::document::Document;
use crate::model::file::entries::simulation::IntegratorSpec;
use crate::model::run::scale::Beams;
use crate::model::variables::Table;
use serde::{Deserialize, Serialize};

/// What has been seen and warned of.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Watch {
    twist_warned: bool,
    energy_warned: bool,
    /// The integrator damps by itself: the energy may fall.
    damps: bool,
    mesh: MeshWatch,
    ends: EndWatch,
    limp: LimpWatch,
    alternation: AlternationWatch,
    stops: StopWatch,
    struts: StrutWatch,
    contacts: ContactWatch,
    ropes: RopeWatch,
}

impl Watch {
    /// Of a run of `document`.
    pub fn new(document: &Document) -> Self {
        let damps = match document.simulation.integrator {
            IntegratorSpec::Conserving { spectral_radius } => document.value(spectral_radius) < 1.0,
            IntegratorSpec::GeneralizedAlpha { .. } => true,
        };
        let analysis = document.simulation.analysis;
        let (mesh, alternation) = (MeshWatch::new(analysis), AlternationWatch::new(analysis));
        let (ends, struts) = (EndWatch::new(analysis), StrutWatch::new(analysis));
        Self { damps, mesh, ends, alternation, struts, ..Self::default() }
    }

    /// Looks at a new state and returns what the user should know of it; `table` has what is read off it, and `results`
    /// what was.
    pub fn look(
        &mut self,
        system: &System,
        state: &State,
        table: &Table,
        results: &[f64],
        frames: &mut FrameCache,
    ) -> Vec<String> {
        let twist = self.twist(system, state, frames);
        let mesh = self.mesh.look(system, state, frames);
        let ends = self.ends.look(system, state, frames);
        let alternation = self.alternation.look(system, state, (table, results), &self.mesh.beams);
        let stops = self.stops.look(system, state);
        let contacts = self.contacts.look(system, state, frames);
        let ropes = self.ropes.look(system, state, frames);
        let struts = self.struts.look(system, state, frames);
        self.limp.look(system, state, frames);
        let all = twist.into_iter().chain(mesh).chain(ends).chain(alternation).chain(stops).chain(contacts);
        all.chain(ropes).chain(struts).chain(self.energy(state.balance.alarm())).collect()
    }

    /// What the user should know at the end, `state`, of a run over `span`, s; `table` has what is read off the system.
    pub fn conclude(&mut self, system: &System, state: &State, table: &Table, span: [f64; 2]) -> Vec<String> {
        let judged = self.judge(system, table);
        let energy = self.energy(state.balance.at_end());
        judged
            .into_iter()
            .chain(energy)
            .chain(switches::idle(system, span))
            .chain(self.ropes.conclude(system))
            .chain(self.limp.conclude(system))
            .collect()
    }

    /// Judges by now what otherwise waits for the end: of a run that fails it may be the cause.
    pub fn judge(&mut self, system: &System, table: &Table) -> Vec<String> {
        let mesh = self.mesh.judge(system);
        let alternation = self.alternation.judge(system, table, &self.mesh.beams);
        mesh.into_iter().chain(alternation).collect()
    }

    /// Leaves the mesh to a comparison with another one.
    pub fn trust_mesh(&mut self) {
        self.mesh.trust();
    }

    /// Whether a mesh that may be too coarse was warned of.
    pub fn doubts_mesh(&self) -> bool {
        self.mesh.has_warned()
    }

    /// Strain energy of the last state that was looked at, J; 0: none was.
    pub fn strain_energy(&self) -> f64 {
        self.mesh.strain_energy
    }

    /// What quantities of beams amount to in the run so far.
    pub fn beams(&self) -> Beams {
        self.mesh.beams
    }

    /// Whether torsion is most of the energy that the mesh has left out where it left out most so far.
    pub fn is_torsion(&self) -> bool {
        self.mesh.most_left_out.1 == Some(Deformation::Torsion)
    }

    /// Warns of a beam that is twisted beyond half the rate above which its energy has no lower bound (MECHANICS 3.7).
    fn twist(&mut self, system: &System, state: &State, frames: &mut FrameCache) -> Option<String> {
        if self.twist_warned {
            return None;
        }
        let (beam, rate, limit) = system.twist_near_limit(state, frames)?;
        self.twist_warned = true;
        Some(format!(
            "beam {beam} is twisted by {rate:.3} rad/m at t = {} s: its torsion softens and fails above {limit:.3} rad/m, because \
             strain = \"large_truncated\" or the section's fourth_moments leave the stiffening by twist out; use strain = \"large\" with the \
             section's true fourth_moments",
            decimal(state.instant())
        ))
    }

    /// Warns of energy that cannot come from anywhere, or that has gone nowhere (MECHANICS 7.4: accuracy is the
    /// step's).
    fn energy(&mut self, alarm: Option<Alarm>) -> Option<String> {
        let Alarm { time, drift, largest } = alarm.filter(|_| !self.energy_warned)?;
        self.energy_warned = true;
        let (time, share) = (decimal(time), 100.0 * drift.abs() / largest.max(drift.abs()));
        Some(if self.damps && drift < 0.0 {
            format!(
                "numerical damping has taken {:.4e} J, {share:.1} % of the largest energy, by t = {time} s: the steps do not resolve the motion; take \
                 smaller steps (simulation.step or simulation.accuracy), or a larger spectral_radius if that motion matters",
                -drift
            )
        } else {
            let way = if drift > 0.0 { "gained" } else { "lost" };
            format!(
                "by t = {time} s the integrator has {way} {:.4e} J, {share:.1} % of the largest energy, that loads, drives and dampers do not account for: \
                 the steps are too large for this motion, and the results are not to be trusted; take smaller steps (simulation.step or simulation.accuracy) or material damping",
                drift.abs()
            )
        })
    }
}
