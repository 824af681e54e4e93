//! How far a simulation is, told while it runs.

use std::sync::atomic::{AtomicU64, Ordering};

/// Written by the runs of one simulation, read from another thread.
#[derive(Debug, Default)]
pub struct Clock {
    /// Bits of the time reached, s.
    t_s: AtomicU64,
    runs: AtomicU64,
    pass: AtomicU64,
    /// Bits of the tolerance of the pass.
    tolerance: AtomicU64,
}

/// What a [`Clock`] shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Told {
    /// Time that the present run has reached, s.
    pub t_s: f64,
    /// Number of the present run within its pass, from 1: the scene, then those that tell what it demands.
    pub run: u64,
    /// Number of the pass, from 1: all runs at one tolerance of the steps.
    pub pass: u64,
    /// That tolerance, pure number.
    pub tolerance: f64,
}

impl Clock {
    /// At nothing yet.
    pub const fn new() -> Self {
        Self {
            t_s: AtomicU64::new(0),
            runs: AtomicU64::new(0),
            pass: AtomicU64::new(0),
            tolerance: AtomicU64::new(0),
        }
    }

    /// A pass at `tolerance` begins; the `first` of a simulation or one more.
    pub fn begin_pass(&self, first: bool, tolerance: f64) {
        let pass = if first { 1 } else { self.pass.load(Ordering::Relaxed) + 1 };
        self.pass.store(pass, Ordering::Relaxed);
        self.tolerance.store(tolerance.to_bits(), Ordering::Relaxed);
        self.runs.store(0, Ordering::Relaxed);
    }

    /// A run begins.
    pub(super) fn begin_run(&self) {
        self.runs.fetch_add(1, Ordering::Relaxed);
        self.tell(0.0);
    }

    /// The run has reached `t_s`, s.
    pub(super) fn tell(&self, t_s: f64) {
        self.t_s.store(t_s.to_bits(), Ordering::Relaxed);
    }

    /// How far it is.
    pub fn told(&self) -> Told {
        let number = |bits: &AtomicU64| f64::from_bits(bits.load(Ordering::Relaxed));
        Told {
            t_s: number(&self.t_s),
            run: self.runs.load(Ordering::Relaxed),
            pass: self.pass.load(Ordering::Relaxed),
            tolerance: number(&self.tolerance),
        }
    }
}
