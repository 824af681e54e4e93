//! Whose threads the parts of an evaluation may take while several climbs are under way.

use std::cmp::Reverse;
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
    pub fn spreads(&self) -> bool {
        rayon::current_thread_index().is_some() && self.leave_threads()
    }

    /// `of` each of `items`, in their order; those of the most `work` begin first, so that none of them is left for the end.
    pub fn each<T: Sync, R: Send>(
        &self,
        items: &[T],
        work: impl Fn(&T) -> usize,
        of: impl Fn((usize, &T)) -> R + Sync,
    ) -> Vec<R> {
        if !self.spreads() {
            return items.iter().enumerate().map(of).collect();
        }
        let mut begun: Vec<(usize, &T, Option<R>)> =
            items.iter().enumerate().map(|(i, item)| (i, item, None)).collect();
        begun.sort_by_key(|(_, item, _)| Reverse(work(item)));
        rayon::in_place_scope_fifo(|scope| {
            for (i, item, found) in &mut begun {
                scope.spawn_fifo(|_| *found = Some(of((*i, *item))));
            }
        });
        begun.sort_by_key(|(i, ..)| *i);
        begun.into_iter().filter_map(|(_, _, found)| found).collect()
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
