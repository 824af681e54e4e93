//! Whose threads the parts of an evaluation may take while several climbs are under way.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use rayon::prelude::*;

/// Climbs under way side by side. As long as there is one for each thread, what belongs to a climb stays on its thread: one that waits
/// for a part which another has taken would begin a further climb meanwhile, and its own would be left over for the end, when the others
/// have nothing to do. Where the numbers come from is the same either way.
#[derive(Debug, Clone, Default)]
pub(super) struct SideBySide(Arc<AtomicUsize>);

impl SideBySide {
    /// `climb` from each of `starts`, in their order.
    pub fn climbs<T: Send, R: Send>(&self, starts: Vec<T>, climb: impl Fn(T) -> R + Sync) -> Vec<R> {
        self.0.fetch_add(starts.len(), Relaxed);
        let one = |start| {
            let end = climb(start);
            self.0.fetch_sub(1, Relaxed);
            end
        };
        starts.into_par_iter().with_max_len(1).map(one).collect()
    }

    /// Whether some thread has no climb of its own.
    pub fn leave_threads(&self) -> bool {
        self.0.load(Relaxed) < rayon::current_num_threads()
    }

    /// Whether the parts of an evaluation may be shared out: within what shares threads already. One that is asked for outside stays on
    /// the thread of who asks, so that a process that was forked needs no pool for it.
    fn spreads(&self) -> bool {
        rayon::current_thread_index().is_some() && self.leave_threads()
    }

    /// `of` each of `items`, in their order.
    pub fn each<T: Sync, R: Send>(&self, items: &[T], of: impl Fn((usize, &T)) -> R + Sync) -> Vec<R> {
        match self.spreads() {
            true => items.par_iter().enumerate().map(&of).collect(),
            false => items.iter().enumerate().map(of).collect(),
        }
    }

    /// Both of them.
    pub fn both<A: Send, B: Send>(
        &self,
        one: impl FnOnce() -> A + Send,
        other: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        if self.spreads() { rayon::join(one, other) } else { (one(), other()) }
    }
}
