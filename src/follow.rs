//! One handle by which a computation is followed and stopped from outside, also from another thread.
//!
//! In: a wish to stop, a closure that is told. Out: [`Follow`], given to whatever computes; [`News`], what that tells;
//! [`RunProgress`], how far a simulation is.
//! Absent: what is computed, signals, printing. Equations: none.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Whether to stop, who is told what begins and what is done, and where a simulation tells how far it is. Clones share all of it and
/// are cheap. The default never stops and tells nobody.
///
/// ```
/// use sprag_design::{Design, Follow, Settings, Stop, simulate};
///
/// let design = Design::read("designs/huang2017-multi-arc.toml".as_ref())?;
/// let scene = design.scenario("low-6").ok_or("no such scenario")?;
/// let follow = Follow::new();
/// let settings = Settings { follow: follow.clone(), ..Settings::default() };
/// // Mostly from another thread, while it computes.
/// follow.stop();
/// let answer = simulate(scene, &settings)?;
/// assert_eq!((answer.stop, answer.verdict), (Stop::Interrupted, None));
///
/// use std::sync::{Arc, atomic::{AtomicUsize, Ordering}};
/// let scenes = Arc::new(AtomicUsize::new(0));
/// let count = scenes.clone();
/// let follow = Follow::nobody().telling(move |_| { count.fetch_add(1, Ordering::Relaxed); });
/// design.check(&follow)?;
/// assert_eq!(scenes.load(Ordering::Relaxed), design.scenarios.len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Default)]
pub struct Follow {
    stop: Option<Arc<AtomicBool>>,
    clock: Option<Arc<Clock>>,
    told: Option<Arc<Told>>,
}

type Told = dyn Fn(News<'_>) + Send + Sync;

/// What a computation of many parts tells, from any of its threads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum News<'a> {
    /// A stretch of work of this name begins.
    Begins(&'a str),
    /// One more is done of what it is made of: scenes, states, points, evaluations.
    Done,
}

/// How far a simulation is, as a [`Follow`] shows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunProgress {
    /// Time that the present run has reached, s.
    pub t_s: f64,
    /// Number of the present run within its pass, from 1: the scene, then those that tell what it demands.
    pub run: u64,
    /// Number of the pass, from 1: all runs at one tolerance of the steps.
    pub pass: u64,
    /// That tolerance, pure number; 0: steps of one length.
    pub tolerance: f64,
}

/// Written by the runs of one simulation, read from another thread.
#[derive(Debug, Default)]
struct Clock {
    /// Bits of the time reached, s.
    t_s: AtomicU64,
    runs: AtomicU64,
    pass: AtomicU64,
    /// Bits of the tolerance of the pass.
    tolerance: AtomicU64,
}

impl Follow {
    /// One that can be stopped and shows how far one simulation at a time is.
    pub fn new() -> Self {
        Self { stop: Some(Arc::default()), clock: Some(Arc::default()), told: None }
    }

    /// Never stops, tells nobody: the default, for constants.
    pub const fn nobody() -> Self {
        Self { stop: None, clock: None, told: None }
    }

    /// Stops with this one, but tells nobody: for simulations that run side by side.
    pub fn unseen(&self) -> Self {
        Self { stop: self.stop.clone(), ..Self::nobody() }
    }

    /// The same, with `told` who hears what begins and what is done.
    pub fn telling(&self, told: impl Fn(News<'_>) + Send + Sync + 'static) -> Self {
        Self { told: Some(Arc::new(told)), ..self.clone() }
    }

    /// Ask what computes to stop at its next safe point; whether that was asked before. One that never stops stays so.
    pub fn stop(&self) -> bool {
        self.stop.as_ref().is_some_and(|flag| flag.swap(true, Ordering::SeqCst))
    }

    /// Whether to stop.
    pub fn stopped(&self) -> bool {
        self.stop.as_ref().is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    /// How far the simulation is; `None` where nobody is told, or before it has begun.
    pub fn progress(&self) -> Option<RunProgress> {
        let clock = self.clock.as_ref()?;
        let number = |bits: &AtomicU64| f64::from_bits(bits.load(Ordering::Relaxed));
        let progress = RunProgress {
            t_s: number(&clock.t_s),
            run: clock.runs.load(Ordering::Relaxed),
            pass: clock.pass.load(Ordering::Relaxed),
            tolerance: number(&clock.tolerance),
        };
        (progress.pass > 0).then_some(progress)
    }

    /// Tell.
    pub(crate) fn news(&self, news: News<'_>) {
        if let Some(told) = &self.told {
            told(news);
        }
    }

    /// A pass at `tolerance` begins; the `first` of a simulation or one more.
    pub(crate) fn begin_pass(&self, first: bool, tolerance: f64) {
        let Some(clock) = &self.clock else { return };
        let pass = if first { 1 } else { clock.pass.load(Ordering::Relaxed) + 1 };
        clock.t_s.store(0, Ordering::Relaxed);
        clock.pass.store(pass, Ordering::Relaxed);
        clock.tolerance.store(tolerance.to_bits(), Ordering::Relaxed);
        clock.runs.store(0, Ordering::Relaxed);
    }

    /// A run begins.
    pub(crate) fn begin_run(&self) {
        let Some(clock) = &self.clock else { return };
        clock.runs.fetch_add(1, Ordering::Relaxed);
        self.tell(0.0);
    }

    /// The run has reached `t_s`, s.
    pub(crate) fn tell(&self, t_s: f64) {
        if let Some(clock) = &self.clock {
            clock.t_s.store(t_s.to_bits(), Ordering::Relaxed);
        }
    }
}

impl std::fmt::Debug for Follow {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Follow").field("stopped", &self.stopped()).finish_non_exhaustive()
    }
}
