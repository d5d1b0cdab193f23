//! What is told of the section at a sensor of an equilibrium.

use ancf14::mechanics::beam::resultants::SectionStrains;
use ancf14::mechanics::marker::configuration::Passage;
use ancf14::mechanics::output::joint_loads::JointLoads;
use ancf14::mechanics::output::section_loads::{SectionLoads, SectionWrench};
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::frame_cache::FrameCache;

/// Forces, moments and strains at sensor `number` of the equilibrium `state`.
pub fn loaded_section(system: &System, state: &State, number: usize) -> (SectionWrench, SectionStrains) {
    let mut snapshot = FrameCache::default();
    let c = snapshot.of(system, state);
    let passage = Passage::of(state);
    let joints = JointLoads::new((system, state), (&c, &passage), &state.multipliers);
    let acceleration = vec![0.0; state.q.len()];
    let loads = SectionLoads { joints: &joints, acceleration: &acceleration };
    let section = system.sensors[number].section(&loads).expect("the sensor is on a beam");
    (section.wrench, section.strains())
}
