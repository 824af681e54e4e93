//! The paper's own scheme, kept as a reference: fixed-step RK4 with a narrow band of zero velocity.
//!
//! It does not converge at the paper's step: inside the band the contact creeps, and once the restoring force is
//! lost it runs away. Never the default.

use super::events::{figures, radial_m_s2};
use super::model::{Forces, Grip, Mode, Model, N_STATE, Place, State};
use super::run::{Run, Sample, Stop};
use crate::ode::rk4;

/// Settings of the published scheme.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PublishedSettings {
    /// End time, s.
    pub duration_s: f64,
    /// Step, s (the paper: 1e-5), rounded so that whole steps fill the duration.
    pub step_s: f64,
    /// Half width D_V of the band of zero velocity, m/s.
    pub band_m_s: f64,
    /// Number of equidistant samples to keep, each at the end of a step (0: none).
    pub samples: usize,
}

impl PublishedSettings {
    /// Number of steps.
    pub fn steps(&self) -> u64 {
        (self.duration_s / self.step_s).round().max(1.0) as u64
    }
}

/// Slope, mode and forces at one instant: rolling force inside the band, limited to mu_s N; slip outside.
///
/// The three lines of (11), with (12) in the last.
fn published_slope(model: &Model, t: f64, y: &State, band_m_s: f64) -> Option<(State, Mode, Forces)> {
    let curve = &model.curve;
    let alpha = y[0];
    let place =
        if alpha <= curve.first_contact_rad() { Place::Open } else { Place::Arc(curve.arc_at(alpha)) };
    let p = model.point(place, alpha);
    // Rates as they are: the band lets the contacts creep.
    let rates = [y[4], y[5], y[6], y[7]];
    let (v_a, v_b) = model.slip_velocities(&p, &rates);
    let grip = |v: f64| if v.abs() < band_m_s { Grip::Stick } else { Grip::Slip(v.signum()) };
    let outer = if model.outer_holds { Grip::Stick } else { grip(v_b) };
    let mut mode = Mode { place, inner: grip(v_a), outer };
    let mut f = model.forces_at(&mode, t, y, &p, &rates);
    let mu = model.friction.static_;
    // Stick-slip transition: T = mu_s N sgn(T_f). Slip(s) gives T_bi = -s mu_s N at A, T_be = s mu_s N at B
    // because s v is taken as 0 there.
    let mut limited = false;
    if mode.inner == Grip::Stick && place != Place::Open && f.t_bi.abs() > mu * f.n_bi {
        mode.inner = Grip::Slip(-f.t_bi.signum());
        limited = true;
    }
    if mode.outer == Grip::Stick && !model.outer_holds && f.t_be.abs() > mu * f.n_be {
        mode.outer = Grip::Slip(f.t_be.signum());
        limited = true;
    }
    if limited {
        f = model.forces_at(&mode, t, y, &p, &rates);
    }
    let a = f.acceleration;
    let slid = |v: f64| if place == Place::Open { 0.0 } else { v };
    let out = [y[4], y[5], y[6], y[7], a[0], a[1], a[2], a[3], slid(v_a), slid(v_b)];
    out.iter().all(|x| x.is_finite()).then_some((out, mode, f))
}

/// Eq. (11) in the printed form: T = T_f while |v| < D_V and |T_f| < mu_s N, mu_s N sgn(T_f) while |v| < D_V
/// beyond that, mu(v) N outside the band. Not as printed: sgn(Vel) stands at both contacts there, but
/// T_bi = -sgn(v_A) mu N_bi, T_be = +sgn(v_B) mu N_be, or one of them would feed energy.
///
/// Integrates from `state`. `go_on` is asked every 256 steps with their number so far; false ends the run.
///
/// Extremes and mode changes are those at the ends of steps, not located: it is the paper's scheme. Slip counts
/// where |v| exceeds the band; net slip includes the creep inside it.
#[doc(alias = "Eq. (11)")]
pub fn published(
    model: &Model,
    state: State,
    settings: &PublishedSettings,
    go_on: &mut dyn FnMut(u64) -> bool,
) -> Run {
    let steps = settings.steps();
    let h = settings.duration_s / steps as f64;
    let band = settings.band_m_s;
    let free = Mode { place: Place::Open, inner: Grip::Stick, outer: Grip::Stick };
    let mut run = Run::start(state, free, settings.samples);
    let (_, end_alpha) = model.curve.end();
    let mut open_s = 0.0;
    for i in 0..=steps {
        let t = i as f64 * h;
        let Some((slope, mode, forces)) = published_slope(model, t, &run.state, band) else {
            run.stop = Stop::NotFinite;
            break;
        };
        run.counters.rhs_evaluations += 1;
        run.t_s = t;
        open_s = if mode.place == Place::Open { open_s + if i > 0 { h } else { 0.0 } } else { 0.0 };
        if open_s > 0.0 {
            run.open_s += h;
            run.longest_open_s = run.longest_open_s.max(open_s);
        }
        note(model, &mut run, t, if i > 0 { h } else { 0.0 }, mode, &forces, band);
        keep(&mut run, t, mode, forces, settings, h);
        if !(run.state[0] < end_alpha && run.state[0] > -10.0) {
            run.stop = if run.state[0] > 0.0 { Stop::CurveEnd } else { Stop::FellAway };
            break;
        }
        if i == steps {
            break;
        }
        if i % 256 == 0 && !go_on(i) {
            run.stop = Stop::Interrupted;
            break;
        }
        let mut rhs = |t: f64, y: &[f64; N_STATE]| published_slope(model, t, y, band).map(|s| s.0).ok_or(());
        let Ok(next) = rk4::step(&mut rhs, t, &run.state, &slope, h) else {
            run.stop = Stop::NotFinite;
            break;
        };
        run.counters.steps += 1;
        run.counters.rhs_evaluations += 3;
        run.inner.distance_m += (next[8] - run.state[8]).abs();
        run.outer.distance_m += (next[9] - run.state[9]).abs();
        run.inner.net_m = next[8];
        run.outer.net_m = next[9];
        run.state = next;
    }
    run
}

/// Extremes, slip times and changes of mode at the end of a step of length `h`.
fn note(model: &Model, run: &mut Run, t: f64, h: f64, mode: Mode, f: &Forces, band: f64) {
    let closed = mode.place != Place::Open;
    if closed && f.v_a.abs() > band {
        run.inner.time_s += h;
    }
    if closed && f.v_b.abs() > band {
        run.outer.time_s += h;
    }
    let seen = figures(closed, f, 1.0);
    for (i, best) in run.peaks.figures().into_iter().enumerate() {
        if seen[i] > best {
            run.peaks.keep(i, t, seen[i], f.n_bi);
        }
    }
    let p = model.point(mode.place, run.state[0]);
    run.neglected.note(radial_m_s2(&mode, &p, f).abs(), f.n_be, run.state[7].abs());
    run.events += u64::from(t > 0.0 && mode != run.mode);
    run.mode = mode;
    run.note_engagement();
}

/// Samples and modes, where asked for.
fn keep(run: &mut Run, t: f64, mode: Mode, forces: Forces, settings: &PublishedSettings, h: f64) {
    if settings.samples == 0 {
        return;
    }
    if run.modes.last().is_none_or(|last| last.1 != mode) {
        run.modes.push((t, mode));
    }
    let due = settings.duration_s * run.samples.len() as f64 / (settings.samples.max(2) - 1) as f64;
    if run.samples.len() < settings.samples && t >= due - 0.5 * h {
        let slip_m = [run.inner.net_m, run.outer.net_m];
        run.samples.push(Sample { t, state: run.state, slip_m, forces, mode });
    }
}
