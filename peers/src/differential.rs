//! The crate differential-equations: DOP853 and Radau 5, events that fall, located on the dense output.

use differential_equations::error::Error;
use differential_equations::linalg::Matrix;
use differential_equations::ode::ODE;
use differential_equations::prelude::{ExplicitRungeKutta, IVP, ImplicitRungeKutta};
use differential_equations::solout::{CrossingDirection, Event, EventConfig};
use differential_equations::solution::Solution;
use differential_equations::status::Status;
use sprag_design::dynamics::{N_STATE, State};
use sprag_design::scenario::Prepared;

use crate::clutch::{Answer, Clutch, Piece, absolute, drive};

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

/// DOP853.
pub fn dop853(p: &Prepared, tolerance: f64, longest_s: f64) -> Result<Answer, String> {
    drive(p, |clutch, t, y, until| {
        let method = ExplicitRungeKutta::dop853()
            .rtol(tolerance)
            .atol(absolute(tolerance))
            .h_max(longest_s)
            .max_steps(MOST_STEPS);
        let least = Least(clutch);
        ended(IVP::ode(clutch, t, until, *y).event(&least).method(method).solve())
    })
}

/// Radau IIA of order 5.
pub fn radau5(p: &Prepared, tolerance: f64, longest_s: f64) -> Result<Answer, String> {
    drive(p, |clutch, t, y, until| {
        let method = ImplicitRungeKutta::radau5()
            .rtol(tolerance)
            .atol(absolute(tolerance))
            .h_max(longest_s)
            .max_steps(MOST_STEPS);
        let least = Least(clutch);
        ended(IVP::ode(clutch, t, until, *y).event(&least).method(method).solve())
    })
}

fn ended(found: Result<Solution<f64, State>, Error<f64, State>>) -> Result<Piece, String> {
    let solution = found.map_err(|e| match e {
        Error::StepSize { t, .. } => format!("step too small at {:.7} ms", 1e3 * t),
        Error::Stiffness { t, .. } => format!("gave up as stiff at {:.7} ms", 1e3 * t),
        Error::MaxSteps { t, .. } => format!("too many steps by {:.7} ms", 1e3 * t),
        Error::LinearAlgebra { t, msg, .. } => format!("{msg} at {:.7} ms", 1e3 * t),
        Error::BadInput { msg } => msg,
        _ => "another error".to_owned(),
    })?;
    let (Some(&t), Some(&y)) = (solution.t.last(), solution.y.last()) else {
        return Err("no point".to_owned());
    };
    match solution.status {
        Status::Interrupted => Ok(Piece::Event(None, t, y)),
        _ => Ok(Piece::End(y)),
    }
}
