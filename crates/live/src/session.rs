//! A simulation that goes on while a reader drags points of the mechanism: a spring and a damper between the pointer
//! and the point.
//!
//! The force is an input, constant in each communication step. Such a force could pump energy into a light point of a
//! heavy mechanism. The step's own response bounds it: with the mobility `m` of the point, the change of its speed in a
//! step of length `h` by a force of 1 N, the spring has the stiffness `k / (1 + k m h)` and the damper `c / (1 + c m)`.
//! Then `k m h < 1` and `c m < 1`, for which `v += m (k e - c v)`, `e -= h v` is stable (`k m h < 2 (2 - c m)`).

use super::grips::{self, Grip};
use super::request::Request;
use super::run::told;
use ancf14::fmi::{Failure, Model, Value};
use ancf14::model::simulation::Simulation;
use ancf14::model::view::Recording;
use serde_json::{Value as Json, json};

/// Communication steps in a second of the clock.
const STEPS: f64 = 120.0;
/// Time constant of the spring with the whole mass, seconds of the clock.
const TIME_CONSTANT: f64 = 0.1;
/// The spring lifts the whole weight with a stretch of this share of the mechanism's size.
const LIFT: f64 = 0.05;
/// Damping of the spring with the whole mass, as a share of the critical one.
const DAMPING: f64 = 0.7;
/// A pointer that is farther away pulls no harder, as a share of the mechanism's size.
const REACH: f64 = 0.5;
/// The force that finds the mobility of a point stretches the spring by this share of the mechanism's size.
const PROBE: f64 = 1e-2;

/// A point that is dragged.
#[derive(Clone, Copy, Debug)]
struct Hold {
    grip: usize,
    /// Change of the point's speed in a communication step by a force, m/s of each N.
    mobility: f64,
    /// Where the pointer is, global, m.
    target: [f64; 3],
}

/// A run that a reader plays with.
#[derive(Debug)]
pub struct Session {
    simulation: Simulation,
    recording: Recording,
    grips: Vec<Grip>,
    /// Of each grip: references of its force, position and velocity.
    references: Vec<[[usize; 3]; 3]>,
    /// Length of a communication step, s.
    step: f64,
    /// Stiffness, N/m, and damping, N s/m, of the spring for the whole mass.
    spring: [f64; 2],
    hold: Option<Hold>,
}

impl Session {
    /// Builds the model of a request with its grips, and finds its initial state. `pace` is how many seconds of the run
    /// pass in one of the clock.
    ///
    /// # Errors
    /// What is wrong with the model, or that nothing in it moves.
    pub fn start(request: &Request, pace: f64) -> Result<Self, String> {
        if !(pace > 0.0 && pace.is_finite()) {
            return Err(format!("error: the speed is {pace} seconds of the run in a second; it must be positive"));
        }
        let (plain, _) = request.load()?;
        let scene = Recording::new(&plain).scene;
        if !scene.is_dynamic {
            return Err(String::from(
                "There is nothing to drag: a static analysis has no motion. Set simulation.analysis to \"dynamic\".",
            ));
        }
        let grips = grips::grips(&scene);
        let prefix = grips::prefix(&request.text);
        let text = grips::with_grips(&request.text, &prefix, &grips);
        let (mut simulation, _) = Request { text, ..request.clone() }.load()?;
        simulation.initialize(0.0).map_err(|failure| told(&simulation, &failure))?;
        let reference = |name: String| {
            let found = simulation.variables().iter().position(|variable| variable.name == name);
            found.ok_or_else(|| format!("error: the model with grips has no variable {name}"))
        };
        let mut references = Vec::with_capacity(grips.len());
        for number in 0..grips.len() {
            let mut own = [[0; 3]; 3];
            for (row, axis) in (0..3).flat_map(|row| (0..3).map(move |axis| (row, axis))) {
                let name = match row {
                    0 => format!("{prefix}{number}.force[{}]", axis + 1),
                    1 => format!("{prefix}place_{number}.position[{}]", axis + 1),
                    _ => format!("{prefix}place_{number}.velocity[{}]", axis + 1),
                };
                own[row][axis] = reference(name)?;
            }
            references.push(own);
        }
        let mass = simulation.system().mass;
        let gravity = length(scene.gravity);
        let time = TIME_CONSTANT * pace;
        let stiffness = mass * (1.0 / (time * time)).max(gravity / (LIFT * scene.size));
        let spring = [stiffness, 2.0 * DAMPING * (stiffness * mass).sqrt()];
        let recording = Recording::new(&simulation);
        let step = (pace / STEPS).max(simulation.shortest_step());
        Ok(Self { simulation, recording, grips, references, step, spring, hold: None })
    }

    /// What the page is told at the beginning: the grips, and which numbers a frame has.
    pub fn description(&self) -> Json {
        let tracks = self.recording.tracks.iter();
        let tracks: Vec<Json> = tracks.map(|track| json!([track.name, track.components, track.things])).collect();
        json!({ "grips": self.grips, "tracks": tracks, "step": self.step })
    }

    /// Takes hold of a point, and finds its mobility.
    ///
    /// # Errors
    /// The solver cannot step on.
    pub fn grab(&mut self, grip: usize) -> Result<(), String> {
        self.release();
        if grip >= self.grips.len() {
            return Err(format!("error: grip {grip} does not exist; there are {}", self.grips.len()));
        }
        let target = self.read(grip, 1);
        let probe = PROBE * self.spring[0] * self.recording.scene.size;
        let before = self.simulation.snapshot();
        let mut speeds = [[0.0; 3]; 4];
        for (case, speed) in speeds.iter_mut().enumerate() {
            let mut force = [0.0; 3];
            if case > 0 {
                force[case - 1] = probe;
            }
            let stepped = self.push(grip, force).and_then(|()| self.advance());
            *speed = self.read(grip, 2);
            self.simulation.restore(&before);
            stepped.map_err(|failure| told(&self.simulation, &failure))?;
        }
        let [rest, pushed @ ..] = speeds;
        let changes = pushed.map(|speed| length([0, 1, 2].map(|axis| speed[axis] - rest[axis])));
        // The norm of a symmetric matrix is at most that of its columns together.
        let mobility = length(changes) / probe;
        self.hold = Some(Hold { grip, mobility, target });
        Ok(())
    }

    /// Moves the pointer to a place, counted from the scene's origin, m.
    pub fn pull(&mut self, place: [f64; 3]) {
        let origin = self.recording.scene.origin;
        if let Some(hold) = &mut self.hold
            && place.iter().all(|part| part.is_finite())
        {
            hold.target = [0, 1, 2].map(|axis| place[axis] + origin[axis]);
        }
    }

    /// Lets go.
    pub fn release(&mut self) {
        if let Some(Hold { grip, .. }) = self.hold.take() {
            // Zero is in every range.
            let _ = self.push(grip, [0.0; 3]);
        }
    }

    /// Goes on by a communication step. After a failure the mechanism is where it was before, and nothing holds it.
    ///
    /// # Errors
    /// The solver's message.
    pub fn step(&mut self) -> Result<(), String> {
        let stepped = match self.hold {
            Some(hold) => {
                let force = self.force(&hold);
                self.push(hold.grip, force).and_then(|()| self.advance())
            }
            None => self.advance(),
        };
        // Nobody reads them while the mechanism moves, and they would pile up.
        let _ = self.simulation.take_warnings();
        stepped.map_err(|failure| {
            self.release();
            told(&self.simulation, &failure)
        })
    }

    /// Everything that moves, as single precision: time, places of the grips, tracks.
    pub fn frame(&mut self) -> Vec<u8> {
        self.recording.record(&self.simulation);
        self.recording.keep_last();
        let origin = self.recording.scene.origin;
        let places = (0..self.grips.len()).flat_map(|grip| {
            let place = self.read(grip, 1);
            [0, 1, 2].map(|axis| place[axis] - origin[axis])
        });
        let tracks = self.recording.tracks.iter().flat_map(|track| track.values.iter().copied());
        let numbers = std::iter::once(self.simulation.time()).chain(places).chain(tracks);
        numbers.flat_map(|number| (number as f32).to_le_bytes()).collect()
    }

    /// The force of spring and damper on a point.
    fn force(&self, hold: &Hold) -> [f64; 3] {
        let [stiffness, damping] = self.spring;
        let stiffness = stiffness / (1.0 + stiffness * hold.mobility * self.step);
        let damping = damping / (1.0 + damping * hold.mobility);
        let (place, speed) = (self.read(hold.grip, 1), self.read(hold.grip, 2));
        let apart = [0, 1, 2].map(|axis| hold.target[axis] - place[axis]);
        let share = (REACH * self.recording.scene.size / length(apart)).min(1.0);
        [0, 1, 2].map(|axis| stiffness * share * apart[axis] - damping * speed[axis])
    }

    fn push(&mut self, grip: usize, force: [f64; 3]) -> Result<(), Failure> {
        let references = self.references[grip][0];
        (0..3).try_for_each(|axis| self.simulation.set_value(references[axis], Value::Real(force[axis])))
    }

    fn advance(&mut self) -> Result<(), Failure> {
        let end = self.simulation.time() + self.step;
        self.simulation.advance(end)
    }

    /// The position (1) or velocity (2) of a grip, global.
    fn read(&self, grip: usize, row: usize) -> [f64; 3] {
        self.references[grip][row].map(|reference| self.simulation.value(reference).number())
    }
}

fn length(vector: [f64; 3]) -> f64 {
    vector.iter().map(|part| part * part).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn request(name: &str) -> Request {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models");
        let path = std::path::Path::new(folder).join(name);
        let text = std::fs::read_to_string(&path).unwrap();
        Request { file: name.to_owned(), text, overrides: Vec::new(), modes: None }
    }

    fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
        length([0, 1, 2].map(|axis| a[axis] - b[axis]))
    }

    /// The free end of the pendulum follows the pointer, stays there but for the stretch that lifts the weight, and
    /// falls when it is released.
    #[test]
    fn a_point_follows_the_pointer_and_falls() {
        let mut session = Session::start(&request("pendulum.toml"), 1.0).unwrap();
        let tip = session.grips.iter().position(|grip| grip.at == "lower@1.0").unwrap();
        session.grab(tip).unwrap();
        let target = [0.3, 0.3, -0.6];
        session.pull(target);
        let before = distance(session.read(tip, 1), target);
        (0..360).for_each(|_| session.step().unwrap());
        let held = distance(session.read(tip, 1), target);
        // The whole weight stretches the spring by LIFT of the size; a light point has a softer spring, by less than
        // the factor 2.
        let stretch = 2.0 * LIFT * session.recording.scene.size;
        assert!(held < stretch && before > 5.0 * stretch, "{before} m, then {held} m");
        // A double pendulum is chaotic: when it is at its lowest depends on the last digits.
        let lowest = |session: &mut Session| {
            let mut height = || {
                session.step().unwrap();
                session.read(tip, 1)[2]
            };
            (0..240).map(|_| height()).fold(f64::INFINITY, f64::min)
        };
        let held = lowest(&mut session);
        session.release();
        let released = lowest(&mut session);
        // Nothing holds it there: it falls farther below where it swung before than the spring was stretched.
        assert!(released < held - stretch, "{held} m, then {released} m");
    }

    /// A pointer that jumps to and fro with a period near that of the spring, the worst that a hand can do, throws no
    /// grip out of reach, and stops no solver.
    #[test]
    fn a_wild_drag_does_not_blow_up() {
        for (name, at) in
            [("pendulum.toml", "lower@1.0"), ("four_bar.toml", ""), ("crane.toml", ""), ("robot.toml", "")]
        {
            let mut session = Session::start(&request(name), 1.0).unwrap();
            let grip = session.grips.iter().position(|grip| grip.at == at).unwrap_or(session.grips.len() - 1);
            let size = session.recording.scene.size;
            let start = session.read(grip, 1);
            session.grab(grip).unwrap();
            let mut farthest = 0.0_f64;
            for step in 0..96 {
                let side = if step / 12 % 2 == 0 { size } else { -size };
                session.hold.as_mut().unwrap().target = [start[0] + side, start[1] - side, start[2] + side];
                session.step().unwrap_or_else(|message| panic!("{name}, step {step}: {message}"));
                farthest = farthest.max(distance(session.read(grip, 1), start));
            }
            // It is pulled to places at a distance of √3 times the size.
            assert!(farthest < 4.0 * size, "{name}: {farthest} m, size {size} m");
        }
    }

    /// A static analysis has nothing to drag; so is a speed that is none told.
    #[test]
    fn what_cannot_be_dragged_is_told() {
        let message = Session::start(&request("elastica.toml"), 1.0).unwrap_err();
        assert!(message.starts_with("There is nothing to drag: a static analysis"), "{message}");
        let message = Session::start(&request("pendulum.toml"), f64::NAN).unwrap_err();
        assert!(message.contains("it must be positive"), "{message}");
        let mut session = Session::start(&request("pendulum.toml"), 1.0).unwrap();
        assert!(session.grab(999).unwrap_err().contains("grip 999 does not exist"));
    }
}
