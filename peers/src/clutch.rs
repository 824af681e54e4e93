//! What every integrator of others gets: the right-hand side and event functions of the present mode, our rule for the
//! next one, a restart there.

use std::cell::Cell;

use sprag_design::dynamics::{Mode, N_STATE, State, events, next_mode};
use sprag_design::scenario::Prepared;

/// Number of event functions.
pub const EVENTS: usize = 4;
/// Their names, in order.
const NAMES: [&str; EVENTS] = ["alpha at the lower end", "alpha at the upper end", "grip at A", "grip at B"];
/// An event function that is not positive right after a change (a contact just released: v = 0) counts from this time
/// on, s: it has risen by then or the mode is wrong. Peers have no such rule of their own.
const COUNTS_AFTER_S: f64 = 1e-9;
/// Work and changes of mode after which a run is given up.
const MOST_RHS: u64 = 4_000_000;
const MOST_CHANGES: u64 = 1_000;
/// Sizes below which increments of a Jacobian do not follow the state: as in our own.
const SMALL: f64 = 1e-3;

/// How a piece of a run, in one mode, ended.
pub enum Piece {
    /// At its end.
    End(State),
    /// At an event; which, where the integrator says so.
    Event(Option<usize>, f64, State),
}

/// A finished run.
#[derive(Debug, Clone, Copy)]
pub struct Answer {
    pub theta_rad: f64,
    pub rhs: u64,
    pub changes: u64,
}

/// A run as its integrator sees it.
pub struct Clutch<'a> {
    pub prepared: &'a Prepared,
    mode: Cell<Mode>,
    waits: Cell<[bool; EVENTS]>,
    begun_s: Cell<f64>,
    /// State at the start of the piece.
    pub start: Cell<State>,
    rhs: Cell<u64>,
    /// Right-hand side kept for the columns of one Jacobian.
    base: Cell<Option<(f64, State, State)>>,
}

impl<'a> Clutch<'a> {
    fn new(prepared: &'a Prepared) -> Self {
        Self {
            prepared,
            mode: Cell::new(prepared.mode),
            waits: Cell::new([false; EVENTS]),
            begun_s: Cell::new(0.0),
            start: Cell::new(prepared.state),
            rhs: Cell::new(0),
            base: Cell::new(None),
        }
    }

    fn begin(&self, mode: Mode, t: f64, y: State) {
        self.mode.set(mode);
        self.begun_s.set(t);
        self.start.set(y);
        self.base.set(None);
        self.waits.set(events(&self.prepared.model, &mode, t, &y).map(|e| e <= 0.0));
    }

    /// The right-hand side; peers know none that fails, so a failure is NaN to them.
    pub fn slope(&self, t: f64, y: &State) -> State {
        let count = self.rhs.get() + 1;
        self.rhs.set(count);
        if count > MOST_RHS {
            return [f64::NAN; N_STATE];
        }
        self.prepared.model.slope(&self.mode.get(), t, y).unwrap_or([f64::NAN; N_STATE])
    }

    /// Whether the limit of work is met.
    pub fn exhausted(&self) -> bool {
        self.rhs.get() > MOST_RHS
    }

    /// The event functions.
    pub fn events(&self, t: f64, y: &State) -> [f64; EVENTS] {
        let mut now = events(&self.prepared.model, &self.mode.get(), t, y);
        if t < self.begun_s.get() + COUNTS_AFTER_S {
            for (e, waits) in now.iter_mut().zip(self.waits.get()) {
                if waits {
                    *e = 1.0;
                }
            }
        }
        now
    }

    /// Derivative of the right-hand side along `v` by a forward difference.
    pub fn along(&self, t: f64, y: &State, v: &State) -> State {
        let size = v.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        if size == 0.0 {
            return [0.0; N_STATE];
        }
        let base = match self.base.get() {
            Some((at, x, base)) if at == t && x == *y => base,
            _ => self.slope(t, y),
        };
        self.base.set(Some((t, *y, base)));
        let length = y.iter().zip(v).fold(SMALL, |m, (y, v)| m.max((y * v / size).abs()));
        let h = f64::EPSILON.sqrt() * length / size;
        let moved = self.slope(t, &std::array::from_fn(|i| y[i] + h * v[i]));
        std::array::from_fn(|i| (moved[i] - base[i]) / h)
    }

    /// Which event function reaches zero first at its present rate.
    fn first(&self, t: f64, y: &State) -> usize {
        let (dt, slope) = (1e-9, self.slope(t, y));
        let now = self.events(t, y);
        let later = self.events(t + dt, &std::array::from_fn(|i| y[i] + dt * slope[i]));
        let left = |i: usize| {
            let fall = (now[i] - later[i]) / dt;
            if fall > 0.0 { now[i] / fall } else { f64::INFINITY }
        };
        (0..EVENTS).min_by(|&a, &b| left(a).total_cmp(&left(b))).unwrap_or(0)
    }
}

/// Run a scene piece by piece: `piece` integrates from a time and state up to a time or its first event.
pub fn drive(
    prepared: &Prepared,
    mut piece: impl FnMut(&Clutch, f64, &State, f64) -> Result<Piece, String>,
) -> Result<Answer, String> {
    let clutch = Clutch::new(prepared);
    let drive = &prepared.model.drive;
    let (mut mode, mut t, mut y, mut changes) = (prepared.mode, 0.0, prepared.state, 0);
    let at = |t: f64| format!("at {:.7} ms", 1e3 * t);
    loop {
        t = drive.past_break_s(t);
        if prepared.duration_s - t < 1e-15 {
            break;
        }
        let until = prepared.duration_s.min(drive.next_break_s(t));
        clutch.begin(mode, t, y);
        let found = piece(&clutch, t, &y, until);
        if clutch.exhausted() {
            return Err(format!("more than {MOST_RHS} right-hand sides, in a piece begun {}", at(t)));
        }
        match found.map_err(|why| format!("{why}, in a piece begun {}", at(t)))? {
            Piece::End(end) => {
                if end.iter().any(|v| !v.is_finite()) {
                    return Err(format!("no number, in a piece begun {}", at(t)));
                }
                let left = clutch.events(until, &end);
                if let Some(i) = (0..EVENTS).find(|&i| left[i] < 0.0) {
                    return Err(format!("missed an event ({}), in a piece begun {}", NAMES[i], at(t)));
                }
                (t, y) = (until, end);
            }
            Piece::Event(which, when, there) => {
                if !(when >= t && there.iter().all(|v| v.is_finite())) {
                    return Err(format!("no number at an event, in a piece begun {}", at(t)));
                }
                changes += 1;
                if changes > MOST_CHANGES {
                    return Err(format!("more than {MOST_CHANGES} changes of mode {}", at(when)));
                }
                let which = which.unwrap_or_else(|| clutch.first(when, &there));
                let next = next_mode(&prepared.model, &mode, which, when, &there);
                (mode, y) = next.map_err(|stop| format!("{} {}", stop.name(), at(when)))?;
                t = when;
            }
        }
    }
    Ok(Answer { theta_rad: y[2], rhs: clutch.rhs.get(), changes })
}

/// Absolute tolerances as our own for a relative one: angles (rad), rates (rad/s), slip (m).
pub fn absolute(tolerance: f64) -> State {
    let (angle, rate, slip) = (1e-2 * tolerance, 10.0 * tolerance, 1e-3 * tolerance);
    [angle, angle, angle, angle, rate, rate, rate, rate, slip, slip]
}
