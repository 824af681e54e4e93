//! Ctrl-C: the first asks loops to stop at the next safe point, the second ends the program at once.

use super::exit::Exit;
use super::output;
use crate::follow::Follow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, Once, PoisonError};

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
