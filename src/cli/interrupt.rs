//! Ctrl-C: the first asks loops to stop at the next safe point, the second ends the program at once.

use super::exit::Exit;
use super::output;
use std::sync::atomic::{AtomicBool, Ordering};

static STOP: AtomicBool = AtomicBool::new(false);

/// Whether the user has asked to stop. Copies share one flag.
#[derive(Debug, Clone, Copy)]
pub struct Interrupt(&'static AtomicBool);

impl Interrupt {
    /// Listen to Ctrl-C (and termination) from now on.
    ///
    /// # Errors
    /// The message where the system refuses a handler; Ctrl-C then ends the program as it always does.
    pub fn install() -> Result<Self, String> {
        ctrlc::set_handler(|| {
            if STOP.swap(true, Ordering::SeqCst) {
                std::process::exit(i32::from(Exit::Interrupted.code()));
            }
            output::note("\nstopping at the next safe point; Ctrl-C again stops at once");
        })
        .map_err(|e| format!("Ctrl-C cannot be caught: {e}"))?;
        Ok(Self(&STOP))
    }

    /// A flag that nobody sets.
    pub fn never() -> Self {
        static NEVER: AtomicBool = AtomicBool::new(false);
        Self(&NEVER)
    }

    /// Whether to stop.
    pub fn requested(self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// The flag itself, for loops of rooms that know no command line.
    pub fn flag(self) -> &'static AtomicBool {
        self.0
    }
}
