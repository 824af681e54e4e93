//! The crate differential-equations: DOP853 and Radau 5.
//!
//! Its own root finder misplaces zeros of functions that are not straight (`tests/peers_alone.rs`), so the comparison
//! locates them by ours on its dense output; its own is kept beside that for DOP853.

use differential_equations::control::ControlFlag;
use differential_equations::error::Error;
use differential_equations::interpolate::Interpolation;
use differential_equations::linalg::Matrix;
use differential_equations::ode::{ODE, OrdinaryNumericalMethod, solve_ode};
use differential_equations::prelude::{ExplicitRungeKutta, IVP, ImplicitRungeKutta};
use differential_equations::solout::{CrossingDirection, Event, EventConfig, Solout};
use differential_equations::solution::Solution;
use differential_equations::status::Status;
use sprag_design::dynamics::{N_STATE, State};
use sprag_design::numeric::root;
use sprag_design::scenario::Prepared;

use crate::clutch::{Answer, Clutch, EVENTS, Piece, absolute, drive};

const MOST_STEPS: usize = 2_000_000;

impl ODE<f64, State> for Clutch<'_> {
    fn diff(&self, t: f64, y: &State, dydt: &mut State) {
        *dydt = self.slope(t, y);
    }

    /// By differences as the crate's own default, with increments that suit angles of a hundredth of a radian.
    fn jacobian(&self, t: f64, y: &State, j: &mut Matrix<f64>) {
        for column in 0..N_STATE {
            let unit: State = std::array::from_fn(|i| if i == column { 1.0 } else { 0.0 });
            for (row, value) in self.along(t, y, &unit).into_iter().enumerate() {
                j[(row, column)] = value;
            }
        }
    }
}

/// Fractions of a step at which event functions are looked at: its end, as by the crate's own events.
const END: &[f64] = &[1.0];
/// As in our own driver.
const QUARTERS: &[f64] = &[0.25, 0.5, 0.75, 1.0];

/// Looks at the event functions and ends the run at the first zero.
struct Located<'a> {
    clutch: &'a Clutch<'a>,
    looks: &'static [f64],
    before: Option<[f64; EVENTS]>,
    found: Option<(usize, f64, State)>,
    end: State,
}

impl Solout<f64, State> for Located<'_> {
    fn solout<I>(
        &mut self,
        t_curr: f64,
        t_prev: f64,
        y_curr: &State,
        _: &State,
        interpolator: &mut I,
        _: &mut Solution<f64, State>,
    ) -> ControlFlag<f64, State>
    where
        I: Interpolation<f64, State> + ?Sized,
    {
        self.end = *y_curr;
        let Some(mut before) = self.before else {
            self.before = Some(self.clutch.events(t_curr, y_curr));
            return ControlFlag::Continue;
        };
        let mut from = t_prev;
        for &look in self.looks {
            let to = if look == 1.0 { t_curr } else { t_prev + look * (t_curr - t_prev) };
            let now = match interpolator.interpolate(to) {
                Ok(y) if look < 1.0 => self.clutch.events(to, &y),
                _ => self.clutch.events(to, y_curr),
            };
            for i in (0..EVENTS).filter(|&i| before[i] > 0.0 && now[i] < 0.0) {
                let value =
                    |t: f64| interpolator.interpolate(t).map_or(f64::NAN, |y| self.clutch.events(t, &y)[i]);
                let zero = root::bracketed(from, to, before[i], now[i], 1e-13 * (t_curr - t_prev), value);
                if let Some(t) = zero
                    && self.found.is_none_or(|first| t < first.1)
                    && let Ok(y) = interpolator.interpolate(t)
                {
                    self.found = Some((i, t, y));
                }
            }
            if self.found.is_some() {
                return ControlFlag::Terminate;
            }
            (from, before) = (to, now);
        }
        self.before = Some(before);
        ControlFlag::Continue
    }
}

fn located<S>(
    mut method: S,
    looks: &'static [f64],
    clutch: &Clutch,
    (t, y, until): (f64, &State, f64),
) -> Result<Piece, String>
where
    S: OrdinaryNumericalMethod<f64, State> + Interpolation<f64, State>,
{
    let mut events = Located { clutch, looks, before: None, found: None, end: *y };
    solve_ode(&mut method, clutch, t, until, y, &mut events).map_err(failure)?;
    Ok(match events.found {
        Some((which, t, y)) => Piece::Event(Some(which), t, y),
        None => Piece::End(events.end),
    })
}

/// DOP853; `often`: event functions are looked at four times a step.
pub fn dop853(p: &Prepared, tolerance: f64, longest_s: f64, often: bool) -> Result<Answer, String> {
    let looks = if often { QUARTERS } else { END };
    drive(p, |clutch, t, y, until| {
        let method = ExplicitRungeKutta::dop853()
            .rtol(tolerance)
            .atol(absolute(tolerance))
            .h_max(longest_s)
            .max_steps(MOST_STEPS);
        located(method, looks, clutch, (t, y, until))
    })
}

/// Radau IIA of order 5. A relative tolerance given as one number is transformed once per state and ends near 1e-3 whatever
/// it was (`tests/peers_alone.rs`): it gets one per state.
pub fn radau5(p: &Prepared, tolerance: f64, longest_s: f64) -> Result<Answer, String> {
    drive(p, |clutch, t, y, until| {
        let method = ImplicitRungeKutta::radau5()
            .rtol([tolerance; N_STATE])
            .atol(absolute(tolerance))
            .h_max(longest_s)
            .max_steps(MOST_STEPS);
        located(method, END, clutch, (t, y, until))
    })
}

/// The least of the event functions: it falls through zero where the first of them does.
struct Least<'a>(&'a Clutch<'a>);

impl Event<f64, State> for Least<'_> {
    fn config(&self) -> EventConfig {
        EventConfig::new(CrossingDirection::Negative, Some(1))
    }

    fn event(&self, t: f64, y: &State) -> f64 {
        self.0.events(t, y).into_iter().fold(f64::INFINITY, f64::min)
    }
}

/// DOP853 with the crate's own root finder.
pub fn dop853_own_events(p: &Prepared, tolerance: f64, longest_s: f64) -> Result<Answer, String> {
    drive(p, |clutch, t, y, until| {
        let method = ExplicitRungeKutta::dop853()
            .rtol(tolerance)
            .atol(absolute(tolerance))
            .h_max(longest_s)
            .max_steps(MOST_STEPS);
        let least = Least(clutch);
        let solution =
            IVP::ode(clutch, t, until, *y).event(&least).method(method).solve().map_err(failure)?;
        let (Some(&t), Some(&y)) = (solution.t.last(), solution.y.last()) else {
            return Err("no point".to_owned());
        };
        match solution.status {
            Status::Interrupted => Ok(Piece::Event(None, t, y)),
            _ => Ok(Piece::End(y)),
        }
    })
}

fn failure(e: Error<f64, State>) -> String {
    match e {
        Error::StepSize { t, .. } => format!("step too small at {:.7} ms", 1e3 * t),
        Error::Stiffness { t, .. } => format!("gave up as stiff at {:.7} ms", 1e3 * t),
        Error::MaxSteps { t, .. } => format!("too many steps by {:.7} ms", 1e3 * t),
        Error::LinearAlgebra { t, msg, .. } => format!("{msg} at {:.7} ms", 1e3 * t),
        Error::BadInput { msg } => msg,
        _ => "another error".to_owned(),
    }
}
