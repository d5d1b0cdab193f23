//! The functions that the page calls (viewer/src/worker.ts). They take and return numbers and addresses only: the page
//! writes a request to the address of
//! [`request`], and reads a reply at the address of [`reply`].
//!
//! A panic ends the module, which then has the message as its last reply: the page says it, and takes a new module for
//! the next run.

#![allow(unsafe_code, reason = "exported names must be unique in the program; nothing here follows a pointer")]

use super::request::{Description, Request};
use super::run::Run;
use super::session::Session;
use ancf14_view::SOLVER_MARK;
use serde_json::json;
use std::cell::RefCell;
use std::panic;

/// What the page and the solver hand over, and the run under way.
#[derive(Debug, Default)]
struct Desk {
    request: Vec<u8>,
    run: Option<Run>,
    session: Option<Session>,
}

thread_local! {
    static DESK: RefCell<Desk> = RefCell::default();
    // Apart from the desk: a panic comes while that is in use.
    static REPLY: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// What [`advance`] returns.
const GOES_ON: u32 = 0;
const ENDED: u32 = 1;
const FAILED: u32 = 2;

/// The address at which a request of `length` bytes is to be written.
#[unsafe(no_mangle)]
pub extern "C" fn request(length: usize) -> *mut u8 {
    DESK.with_borrow_mut(|desk| {
        desk.request = vec![0; length];
        desk.request.as_mut_ptr()
    })
}

/// The address of the last reply.
#[unsafe(no_mangle)]
pub extern "C" fn reply() -> *const u8 {
    REPLY.with_borrow(Vec::as_ptr)
}

/// Bytes of the last reply.
#[unsafe(no_mangle)]
pub extern "C" fn reply_length() -> usize {
    REPLY.with_borrow(Vec::len)
}

/// Reads the model of the request. The reply tells what can be set, or what is wrong with the model.
#[unsafe(no_mangle)]
pub extern "C" fn describe() {
    guard();
    DESK.with_borrow(|desk| {
        let loaded = Request::read(&desk.request).and_then(|request| request.load());
        say(match loaded {
            Ok((simulation, rows)) => json!({ "description": Description::new(&simulation, rows) }),
            Err(message) => json!({ "error": message }),
        });
    });
}

/// Reads the model of the request and finds its initial state. The reply tells what can be set, or what is wrong.
#[unsafe(no_mangle)]
pub extern "C" fn begin() {
    guard();
    DESK.with_borrow_mut(|desk| {
        desk.run = None;
        let begun = Request::read(&desk.request).and_then(|request| {
            let (simulation, rows) = request.load()?;
            let description = Description::new(&simulation, rows);
            Ok((description, Run::start(simulation, rows, request.modes)?))
        });
        say(match begun {
            Ok((description, run)) => {
                desk.run = Some(run);
                json!({ "description": description })
            }
            Err(message) => json!({ "error": message }),
        });
    });
}

/// Goes on by `count` rows of results, or to the end. Returns whether the run goes on (0), has ended (1) or has failed
/// (2).
#[unsafe(no_mangle)]
pub extern "C" fn advance(count: u32) -> u32 {
    DESK.with_borrow_mut(|desk| {
        let Some(run) = &mut desk.run else { return FAILED };
        match (0..count).try_fold(false, |ended, _| if ended { Ok(true) } else { run.advance() }) {
            Ok(false) => GOES_ON,
            Ok(true) => ENDED,
            Err(()) => FAILED,
        }
    })
}

/// Ends the run, early with `stopped` other than 0. The reply has the warnings, the error if there was one, and the
/// data of the page.
#[unsafe(no_mangle)]
pub extern "C" fn finish(stopped: u32) {
    DESK.with_borrow_mut(|desk| match desk.run.take() {
        Some(run) => REPLY.set(run.finish(stopped != 0).into_bytes()),
        None => say(json!({ "error": "no run is under way" })),
    });
}

/// Reads the model of the request for a reader who drags it; `pace` is how many seconds of the run pass in a second of
/// the clock. The reply tells what can be dragged and what a frame consists of, or what is wrong.
#[unsafe(no_mangle)]
pub extern "C" fn interact(pace: f64) {
    guard();
    DESK.with_borrow_mut(|desk| {
        desk.session = None;
        say(match Request::read(&desk.request).and_then(|request| Session::start(&request, pace)) {
            Ok(session) => {
                let told = json!({ "session": session.description() });
                desk.session = Some(session);
                told
            }
            Err(message) => json!({ "error": message }),
        });
    });
}

/// Takes hold of grip number `grip`. Returns 0, or 2 if that failed, with the error as the reply.
#[unsafe(no_mangle)]
pub extern "C" fn grab(grip: u32) -> u32 {
    play(|session| session.grab(grip as usize))
}

/// Moves the pointer that drags.
#[unsafe(no_mangle)]
pub extern "C" fn pull(x: f64, y: f64, z: f64) {
    play(|session| {
        session.pull([x, y, z]);
        Ok(())
    });
}

/// Lets go of what is dragged.
#[unsafe(no_mangle)]
pub extern "C" fn release() {
    play(|session| {
        session.release();
        Ok(())
    });
}

/// Lets the mechanism that is dragged go on by a communication step. Returns 0, or 2 if that failed, with the error as
/// the reply.
#[unsafe(no_mangle)]
pub extern "C" fn step() -> u32 {
    play(Session::step)
}

/// The reply is where everything is now, in single precision.
#[unsafe(no_mangle)]
pub extern "C" fn frame() {
    play(|session| {
        REPLY.set(session.frame());
        Ok(())
    });
}

fn play(act: impl FnOnce(&mut Session) -> Result<(), String>) -> u32 {
    DESK.with_borrow_mut(|desk| {
        let Some(session) = &mut desk.session else { return FAILED };
        match act(session) {
            Ok(()) => GOES_ON,
            Err(message) => {
                say(json!({ "error": message }));
                FAILED
            }
        }
    })
}

fn say(reply: serde_json::Value) {
    REPLY.set(reply.to_string().into_bytes());
}

/// Keeps the message of a panic, which ends a module of WebAssembly at once.
fn guard() {
    if cfg!(target_family = "wasm") {
        panic::set_hook(Box::new(|panic| {
            say(json!({ "panic": format!("{SOLVER_MARK} stopped on an internal error: {panic}") }));
        }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::Value;

    /// Puts a request in, as the page does.
    fn ask(asked: &Value) {
        let bytes = asked.to_string().into_bytes();
        request(bytes.len());
        DESK.with_borrow_mut(|desk| desk.request = bytes);
    }

    fn told() -> Value {
        REPLY.with_borrow(|reply| serde_json::from_slice(reply).unwrap())
    }

    fn cantilever(overrides: &[[&str; 2]]) -> Value {
        let text = include_str!("../../../models/cantilever.toml");
        json!({ "file": "cantilever.toml", "text": text, "overrides": overrides, "modes": null })
    }

    /// A request is simulated to its end; rows behind the end are none.
    #[test]
    fn a_run_goes_to_its_end() {
        ask(&cantilever(&[["simulation.stop", "0.05"], ["arm.elements", "2"]]));
        begin();
        assert_eq!(told()["description"]["rows"], 10);
        assert_eq!([advance(4), advance(0), advance(100)], [GOES_ON, GOES_ON, ENDED]);
        finish(0);
        let found = told();
        assert_eq!(found["data"]["instants"], 11);
        assert_eq!(found["data"]["notes"].as_array().unwrap().len(), 0);
        assert!(found["error"].is_null());
        assert_eq!(advance(1), FAILED, "the run is over");
    }

    /// A run that is stopped has its rows so far, and the page says where it ended.
    #[test]
    fn a_stopped_run_is_shown_so_far() {
        ask(&cantilever(&[["arm.elements", "2"]]));
        begin();
        assert_eq!(advance(3), GOES_ON);
        finish(1);
        let found = told();
        assert_eq!(found["data"]["instants"], 4);
        assert_eq!(found["data"]["notes"][0], "The run was stopped at t = 0.015 s.");
    }

    /// What is wrong is told with its line; so is a request that is none.
    #[test]
    fn mistakes_are_told() {
        ask(&cantilever(&[["steel.young", "-1"]]));
        describe();
        let message = told()["error"].as_str().unwrap().to_owned();
        assert!(message.starts_with("error: `steel.young` must be greater than 0"), "{message}");
        let text = include_str!("../../../models/cantilever.toml").replace("poisson", "poison");
        ask(&json!({ "file": "m.toml", "text": text, "overrides": [], "modes": 3 }));
        begin();
        let message = told()["error"].as_str().unwrap().to_owned();
        assert!(message.contains("--> m.toml:") && message.contains("poison"), "{message}");
        assert_eq!(advance(1), FAILED);
        finish(0);
        assert!(told()["error"].as_str().unwrap().contains("no run"));
        ask(&json!([1, 2]));
        begin();
        assert!(told()["error"].as_str().unwrap().starts_with("error: the request of the page"));
    }
}
