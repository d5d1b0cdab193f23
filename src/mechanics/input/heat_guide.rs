//! Where temperatures come from: functions of time, the same along a beam or at the points of each element, or a host.

use super::heat::{Heat, POINTS};
use super::host_motion::Targets;
use super::signal::Signal;

/// Where a temperature comes from.
#[derive(Clone, Debug)]
pub enum HeatGuide {
    /// Functions of time, the same along a beam.
    Uniform {
        /// On the axis, K.
        temperature: Signal,
        /// Along y and z of the section, K/m.
        gradient: [Signal; 2],
    },
    /// Functions of time at the points of one element.
    Along(Box<HeatAlong>),
    /// A host gives it, the same along a beam; its number among the targets.
    Host(usize),
}

/// The temperature at the points of one element, as [`Heat`] has it.
#[derive(Clone, Debug)]
pub struct HeatAlong {
    /// On the axis, K.
    pub temperature: [Signal; POINTS],
    /// Along y and z of the section, K/m.
    pub gradient: [[Signal; 2]; POINTS],
}

impl HeatGuide {
    /// At the start, `time` s.
    pub fn start(&self, time: f64, targets: &Targets) -> Heat {
        match self {
            Self::Host(number) => targets.heats[*number],
            Self::Uniform { .. } | Self::Along(_) => self.at(time, targets),
        }
    }

    /// At `time`, s.
    pub fn at(&self, time: f64, targets: &Targets) -> Heat {
        match self {
            Self::Uniform { temperature, gradient } => {
                Heat::uniform(temperature.at(time), gradient.each_ref().map(|signal| signal.at(time)))
            }
            Self::Along(along) => Heat {
                temperature: along.temperature.each_ref().map(|signal| signal.at(time)),
                gradient: along.gradient.each_ref().map(|pair| pair.each_ref().map(|signal| signal.at(time))),
            },
            Self::Host(number) => targets.heat(*number, time),
        }
    }

    /// Its functions of time; none where a host gives it.
    pub fn signals(&self) -> impl Iterator<Item = &Signal> {
        let (temperature, gradient): (&[Signal], &[[Signal; 2]]) = match self {
            Self::Uniform { temperature, gradient } => {
                (std::slice::from_ref(temperature), std::slice::from_ref(gradient))
            }
            Self::Along(along) => (&along.temperature, &along.gradient),
            Self::Host(_) => (&[], &[]),
        };
        temperature.iter().chain(gradient.iter().flatten())
    }
}
