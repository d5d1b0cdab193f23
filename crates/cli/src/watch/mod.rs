//! `view --watch`: shows a model in the browser, and anew whenever one of its files is saved.

mod files;
mod news;
mod server;

use super::keeper::end_on_interrupt;
use super::view::{Filmed, filmed};
use super::{ModelArguments, Stop, complain, is_piped, say, unwritten, voice};
use ancf14_view::Effort;
use files::Files;
use news::News;
use std::cell::Cell;
use std::time::{Duration, Instant};

/// How often a run looks whether its files have changed.
const LOOK: Duration = Duration::from_millis(200);

/// Serves the page of a model until Ctrl-C; with `modes` it shows so many natural modes, too.
pub fn watch(model: &ModelArguments, modes: Option<u16>) -> Result<(), Stop> {
    if is_piped(&model.file) {
        return Err(Stop::Bad(
            "error: --watch needs a file that can be saved again, not the standard input".to_owned(),
        ));
    }
    if voice::is_json() {
        return Err(Stop::Bad("error: --watch writes no document; leave out --json".to_owned()));
    }
    let impossible =
        |what: &str, reason: &dyn std::fmt::Display| Stop::Failed(format!("error: cannot {what}: {reason}"));
    end_on_interrupt().map_err(|reason| impossible("wait for Ctrl-C", &reason))?;
    let news = News::default();
    let address =
        server::start(&model.name(), news.clone()).map_err(|reason| impossible("serve the page", &*reason))?;
    voice::print(&format!("{}: open {address} in a browser on this computer; Ctrl-C ends it", model.name()))?;
    let mut files = Files::default();
    loop {
        files = Files::of(model, &files);
        news.begin();
        match shown(model, modes, &files, &news) {
            Ok(Some(instants)) => {
                files.forget_unlisted(model);
                say(&format!("{instants} instants; waiting for changes"))?;
            }
            Ok(None) => {}
            Err(stop) => complain(&stop.to_string()),
        }
        files.wait();
    }
}

/// Simulates, and brings the run into the page; the number of its instants, none of a run that was abandoned because
/// its files have changed.
fn shown(model: &ModelArguments, modes: Option<u16>, files: &Files, news: &News) -> Result<Option<usize>, Stop> {
    // Those of an abandoned run.
    drop(voice::take_warnings());
    let mut looked = Instant::now();
    let is_abandoned = Cell::new(false);
    // A run of files that have changed in the meantime ends at once.
    let look = |share: f64| {
        if looked.elapsed() < LOOK {
            return Ok(());
        }
        looked = Instant::now();
        news.proceed(share);
        is_abandoned.set(files.have_changed());
        if is_abandoned.get() { Err(Stop::Failed(String::new())) } else { Ok(()) }
    };
    let outcome = simulated(model, modes, look);
    if is_abandoned.get() {
        return Ok(None);
    }
    match outcome {
        Ok((instants, data, outcome)) => {
            news.end(Some(data), outcome.as_ref().err().map(Stop::to_string), voice::take_warnings());
            outcome.map(|()| Some(instants))
        }
        Err(stop) => {
            news.end(None, Some(stop.to_string()), voice::take_warnings());
            Err(stop)
        }
    }
}

/// Instants and data of a run, and how it has ended.
type Run = (usize, String, Result<(), Stop>);

fn simulated(
    model: &ModelArguments,
    modes: Option<u16>,
    look: impl FnMut(f64) -> Result<(), Stop>,
) -> Result<Run, Stop> {
    // Whoever edits a file waits for its picture, not for its last digits.
    let Filmed { film, outcome, .. } = filmed(model.load()?.0, modes, false, look)?;
    let data = film.data(Effort::Soon).map_err(|reason| unwritten(&reason))?;
    Ok((film.instants(), data, outcome))
}
