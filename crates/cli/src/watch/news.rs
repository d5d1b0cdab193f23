//! What the page is told of the model: viewer/src/watch.ts reads it.

use serde_json::json;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The news, of which server and simulation have a copy each.
#[derive(Clone, Debug, Default)]
pub struct News(Arc<Mutex<State>>);

#[derive(Debug, Default)]
struct State {
    /// Number of the run that is there to be shown; 0: none yet.
    run: u64,
    /// Its data.
    data: Arc<[u8]>,
    /// The share of the present run that is done; none: it has ended.
    share: Option<f64>,
    /// What is wrong with the model; empty: nothing.
    error: String,
    warnings: Vec<String>,
}

impl News {
    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Tells the page that a run begins.
    pub fn begin(&self) {
        self.proceed(0.0);
    }

    /// Tells the page the share of the run that is done.
    pub fn proceed(&self, share: f64) {
        self.state().share = Some(share);
    }

    /// Tells the page that a run has ended; without data the page keeps the one before.
    pub fn end(&self, data: Option<String>, error: Option<String>, warnings: Vec<String>) {
        let mut state = self.state();
        if let Some(data) = data {
            state.data = data.into_bytes().into();
            state.run += 1;
        }
        state.share = None;
        state.error = error.unwrap_or_default();
        state.warnings = warnings;
    }

    /// Returns all but the data, as JSON.
    pub fn text(&self) -> Arc<[u8]> {
        let State { run, share, error, warnings, .. } = &*self.state();
        json!({ "run": run, "share": share, "error": error, "warnings": warnings }).to_string().into_bytes().into()
    }

    /// Returns the data of the run, as JSON.
    pub fn data(&self) -> Arc<[u8]> {
        Arc::clone(&self.state().data)
    }
}
