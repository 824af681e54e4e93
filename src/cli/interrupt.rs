//! Ctrl-C: the first asks loops to stop at the next safe point, the second ends the program at once.

use super::exit::{Exit, Failure};
use super::output;
use crate::follow::Follow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::sync::{Mutex, Once, PoisonError};
use std::time::Duration;

/// What Ctrl-C stops now: a program that carries this one may run several commands, one after another.
static NOW: Mutex<Follow> = Mutex::new(Follow::nobody());

/// Whether nothing is said of it.
static QUIET: AtomicBool = AtomicBool::new(false);

/// What Ctrl-C (and termination) stops from now on, with `quiet` without a word; where the system refuses a handler, Ctrl-C ends the program as it
/// always does, and a warning says so.
pub fn install(quiet: bool) -> Follow {
    static HANDLER: Once = Once::new();
    let follow = Follow::new();
    *NOW.lock().unwrap_or_else(PoisonError::into_inner) = follow.clone();
    QUIET.store(quiet, Ordering::Relaxed);
    HANDLER.call_once(|| {
        let handler = || {
            if NOW.lock().unwrap_or_else(PoisonError::into_inner).stop() {
                std::process::exit(i32::from(Exit::Interrupted.code()));
            }
            if QUIET.load(Ordering::Relaxed) {
                return;
            }
            output::note("\nstopping at the next safe point; Ctrl-C again stops at once");
        };
        if let Err(why) = ctrlc::set_handler(handler) {
            output::note(&format!("warning: Ctrl-C cannot be caught: {why}"));
        }
    });
    follow
}

/// What comes next, waited for so that Ctrl-C is heard; `None` where nothing more comes.
///
/// # Errors
/// [`Failure::Interrupted`].
pub fn next<T>(from: &Receiver<T>, follow: &Follow) -> Result<Option<T>, Failure> {
    loop {
        if follow.stopped() {
            return Err(Failure::Interrupted);
        }
        match from.recv_timeout(Duration::from_millis(20)) {
            Ok(it) => return Ok(Some(it)),
            Err(RecvTimeoutError::Disconnected) => return Ok(None),
            Err(RecvTimeoutError::Timeout) => {}
        }
    }
}
