//! The crate diffsol: BDF, TR-BDF2, ESDIRK34 and Tsitouras 5(4), with its root finding.

use diffsol::{
    DiffsolError, NalgebraContext, NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquations,
    OdeEquationsImplicit, OdeSolverMethod, OdeSolverProblem, OdeSolverStopReason, Tableau,
};
use sprag_design::dynamics::{N_STATE, State};
use sprag_design::scenario::Prepared;

use crate::clutch::{Answer, Clutch, EVENTS, Piece, absolute, drive};

type M = NalgebraMat<f64>;
type V = NalgebraVec<f64>;
type Lu = NalgebraLU<f64>;

/// Which of its methods.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    Bdf,
    TrBdf2,
    Esdirk34,
    Tsit45,
}

fn state(x: &[f64]) -> State {
    std::array::from_fn(|i| x[i])
}

/// One run.
pub fn run(p: &Prepared, kind: Kind, tolerance: f64) -> Result<Answer, String> {
    drive(p, |clutch, t, _, until| {
        // Built anew for each mode: the crate's documented way to restart. It takes microseconds.
        let problem = OdeBuilder::<M>::new()
            .t0(t)
            .rtol(tolerance)
            .atol(absolute(tolerance))
            .rhs_implicit(
                |x, _p, t, y| y.copy_from_slice(&clutch.slope(t, &state(x))),
                |x, _p, t, v, y| y.copy_from_slice(&clutch.along(t, &state(x), &state(v))),
            )
            .init(|_p, _t, y| y.copy_from_slice(&clutch.start.get()), N_STATE)
            .root(|x, _p, t, g| g.copy_from_slice(&clutch.events(t, &state(x))), EVENTS)
            .build()
            .map_err(|e| e.to_string())?;
        piece(&problem, kind, until, clutch).map_err(|e| e.to_string())
    })
}

fn piece<E>(
    problem: &OdeSolverProblem<E>,
    kind: Kind,
    until: f64,
    clutch: &Clutch,
) -> Result<Piece, DiffsolError>
where
    E: OdeEquationsImplicit<T = f64, V = V, M = M, C = NalgebraContext>,
{
    match kind {
        Kind::Bdf => walk(problem.bdf_solver::<Lu>(problem.bdf_state::<Lu>()?)?, until, clutch),
        Kind::TrBdf2 => {
            walk(problem.tr_bdf2_solver::<Lu>(problem.rk_state(&Tableau::tr_bdf2())?)?, until, clutch)
        }
        Kind::Esdirk34 => {
            walk(problem.esdirk34_solver::<Lu>(problem.rk_state(&Tableau::esdirk34())?)?, until, clutch)
        }
        Kind::Tsit45 => walk(problem.tsit45_solver(problem.rk_state(&Tableau::tsit45())?)?, until, clutch),
    }
}

/// Step by step to the end or the first root.
fn walk<'a, E, S>(mut solver: S, until: f64, clutch: &Clutch) -> Result<Piece, DiffsolError>
where
    E: OdeEquations<T = f64, V = V> + 'a,
    S: OdeSolverMethod<'a, E>,
{
    solver.set_stop_time(until)?;
    loop {
        match solver.step()? {
            OdeSolverStopReason::RootFound(t, which) => {
                let y = solver.interpolate(t)?;
                return Ok(Piece::Event(Some(which), t, state(y.batch_as_slice(0))));
            }
            OdeSolverStopReason::TstopReached => {
                return Ok(Piece::End(state(solver.state().y.batch_as_slice(0))));
            }
            OdeSolverStopReason::InternalTimestep => {
                let y = solver.state().y;
                // It goes on with NaN: the limit of work and the end of the piece name that.
                if y.batch_as_slice(0).iter().any(|v| !v.is_finite()) || clutch.exhausted() {
                    return Ok(Piece::End(state(y.batch_as_slice(0))));
                }
            }
        }
    }
}
