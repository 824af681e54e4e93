//! Both contacts roll: two degrees of freedom instead of four, and a right-hand side that costs a tenth.
//!
//! With w = theta_be - theta_bi up to a constant, so that w is the windup W(alpha), and e = theta_be, rolling leaves
//!
//!   alpha' = kappa w',  phi' = e' - sigma w',   kappa = 1/(rho_i + rho_e),  sigma = rho_e kappa,
//!
//! and the kinetic energy (m_ww w'^2 + 2 m_we w' e' + m_ee e'^2)/2 with
//!
//!   m_ww = I_bi + A,  m_we = B - I_bi,  m_ee = I_bi + I_be + D,
//!   A = n_s [I_g (kappa - sigma)^2 + m_g OC_g^2 sigma^2],  B = n_s [I_g (kappa - sigma) - m_g OC_g^2 sigma],
//!   D = n_s [I_g + m_g OC_g^2],
//!
//! all functions of w ([`super::stick_table`]). Lagrange's equations, which are (13) and (15) under these constraints:
//!
//!   m_ww w'' + m_we e'' = -C_bi - F(w) - C_rl w' - A' w'^2/2 + D' (e'^2/2 + Omega e')
//!   m_we w'' + m_ee e'' = C_bi + C_be - k_ab e - B' w'^2 - D' w' (e' + Omega)
//!
//! F = C(w) - n_s kappa K_r (alpha_max - alpha): the clutch's torque at Omega less what the spring gives. What rolling asks of the
//! contacts is read off the races, n_s T_bi OA = I_bi (e'' - w'') - C_rl w' - C_bi.
//!
//! Below first contact the curve goes on in tension, as in [`super::rolling()`]. This is the run of a search. It says nothing where the
//! motion leaves the curve or asks for more than these equations hold; then [`super::rolling()`] is asked, which is also what it is
//! tested against.

use super::beat::Beat;
use super::crossing::scaled;
use super::drive::Ramp;
use super::events::FIGURES;
use super::model::{Model, Place, State};
use super::probes::Grid;
use super::run::{Peaks, RunSettings};
use super::settled::Settled;
use super::stick_table::{Contacts, Motion, Table};
use super::watch::highest;
use crate::numeric::root;
use crate::ode::dop853::{Dense, PROBES, Step};
use crate::ode::rhs::RightHandSide;
use crate::ode::step::{Counters, Tolerance};

/// w, e, w', e'; rad, rad/s.
pub(super) type Pair = [f64; 4];

/// What comes of such a run.
#[derive(Debug, Clone)]
pub(super) struct Stuck {
    pub(super) peaks: Peaks,
    /// Its steps.
    pub(super) legs: Vec<Leg>,
    /// Where each figure was largest.
    pub(super) largest: [Largest; FIGURES],
    pub(super) counters: Counters,
    /// Junctions passed.
    pub(super) passed: u64,
    /// Whether it was stopped from outside.
    pub(super) interrupted: bool,
    /// Time reached, s.
    pub(super) t_s: f64,
}

/// One step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leg {
    /// Time at which it begins, its length and time up to which it was taken, s.
    pub(super) from_s: f64,
    pub(super) length_s: f64,
    pub(super) until_s: f64,
    /// Whether it ends before that, at a junction.
    pub(super) passes: bool,
    /// Whether it ends at a knot of the torque's course, where figures jump.
    pub(super) breaks: bool,
}

/// Where a figure was largest.
#[derive(Debug, Clone, Copy)]
pub(super) struct Largest {
    /// Number of the step, and where that sets out.
    pub(super) leg: usize,
    pub(super) from: Outset,
    /// Time, s.
    pub(super) t_s: f64,
    /// Whether that is its very start or its very end.
    pub(super) edge: Option<Edge>,
}

/// End of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Edge {
    Start,
    End,
}

/// What is seen at one instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sight {
    pub(super) t: f64,
    pub(super) y: Pair,
    /// w'' and e''.
    pub(super) rates: [f64; 2],
    pub(super) figures: [f64; FIGURES],
}

/// Where a step begins: what is seen there, the arc and the piece of C_bi's course that it lies on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Outset {
    pub(super) now: Sight,
    arc: usize,
    inner: Ramp,
}

/// The two equations on one arc.
pub(super) struct Rolls<'a> {
    model: &'a Model,
    table: Table<'a>,
    pub(super) probed: [Sight; PROBES.len()],
    /// Whether a step is looked at between its ends.
    pub(super) looks: bool,
    beat: Beat,
    /// C_bi by the straight piece of its course that a step lies on.
    inner: Ramp,
}

impl<'a> Rolls<'a> {
    /// On arc `arc`, with the start that `state` is.
    pub(super) fn new(model: &'a Model, arc: usize, state: &State) -> (Self, Pair) {
        let windup = model.curve.in_arc(arc, state[0]).windup;
        let y: Pair = [windup, state[3], state[7] - state[6], state[7]];
        let nothing = Sight { t: 0.0, y, rates: [f64::NAN; 2], figures: [f64::NAN; FIGURES] };
        let beat = Beat::new(model.loads.omega_rad_s, model.loads.amplitude_nm, 0.0);
        let (table, inner) =
            (Table::new(model, arc), Ramp { start_nm: model.loads.inner_nm, rate_nm_per_s: 0.0 });
        let mut rolls = Self { model, table, probed: [nothing; PROBES.len()], looks: true, beat, inner };
        rolls.pass_knot(0.0);
        (rolls, y)
    }

    /// Where `outset` is.
    pub(super) fn at(model: &'a Model, outset: &Outset, state: &State) -> Self {
        let (mut rolls, _) = Self::new(model, 0, state);
        rolls.table.enter(outset.arc);
        rolls.inner = outset.inner;
        rolls
    }

    fn outset(&self) -> Outset {
        Outset { now: self.probed[0], arc: self.table.arc(), inner: self.inner }
    }

    /// On to the piece of the torque's course that begins at a knot at `t` (s); where none is there the piece stays.
    pub(super) fn pass_knot(&mut self, t: f64) {
        let Some(course) = &self.model.drive.torque_nm else { return };
        let (nm, rate) = course.at(course.past_knot(t));
        self.inner = Ramp { start_nm: self.model.loads.inner_nm - nm + rate * t, rate_nm_per_s: -rate };
    }

    /// Whether a step that ended at `t` (s) ended at a knot of the torque's course, to rounding.
    fn is_knot(&self, t: f64) -> bool {
        self.model.drive.torque_nm.as_ref().is_some_and(|c| c.past_knot(t) > t)
    }

    /// Next knot of the torque's course after `t`, s.
    pub(super) fn next_knot_s(&self, t: f64) -> f64 {
        let course = self.model.drive.torque_nm.as_ref();
        course.and_then(|c| c.next_knot(c.past_knot(t))).unwrap_or(f64::INFINITY)
    }

    /// Ready for a step from `now`, and the slope there.
    pub(super) fn set_out(&mut self, now: Sight) -> Pair {
        self.probed[0] = now;
        self.beat = Beat::new(self.model.loads.omega_rad_s, self.model.loads.amplitude_nm, now.t);
        [now.y[2], now.y[3], now.rates[0], now.rates[1]]
    }

    /// Accelerations (w'', e'') under the torques `outside` (C_bi, C_be).
    #[inline(always)]
    fn accelerations(model: &Model, m: &Motion, y: &Pair, [c_bi, c_be]: [f64; 2]) -> [f64; 2] {
        let speed = model.curve.speed_rad_s();
        let [_, e, u, v] = *y;
        let (m_ww, m_we, m_ee) = masses(model, m);
        let q_w = -c_bi - m.f - model.damping_nm_s_per_rad * u - 0.5 * m.a_slope * u * u
            + m.d_slope * v * (0.5 * v + speed);
        let q_e = c_bi + c_be
            - model.loads.abutment_nm_per_rad * e
            - m.b_slope * u * u
            - m.d_slope * u * (v + speed);
        let inverse = 1.0 / (m_ww * m_ee - m_we * m_we);
        [(q_w * m_ee - q_e * m_we) * inverse, (m_ww * q_e - m_we * q_w) * inverse]
    }

    /// Figures as in [`super::events::Probe`] where the accelerations are `a`.
    #[inline(always)]
    fn figures(model: &Model, c: &Contacts, y: &Pair, a: [f64; 2], outside: [f64; 2]) -> [f64; FIGURES] {
        let ([_, e, u, v], [u_rate, v_rate], [c_bi, c_be]) = (*y, a, outside);
        let drag = model.damping_nm_s_per_rad * u;
        // n_s T_bi OA and n_s T_be OB.
        let inner = model.inner_inertia_kg_m2 * (v_rate - u_rate) - drag - c_bi;
        let outer = c_be - drag - model.loads.abutment_nm_per_rad * e - model.outer_inertia_kg_m2 * v_rate;
        let orbit = model.curve.speed_rad_s() + v - c.sigma * u;
        let n_be =
            c.outer + c.outer_by_inner * inner - c.outer_by_outer * outer + c.centrifugal * orbit * orbit;
        let ratio = |t: f64, n: f64| if n > 0.0 { t.abs() / n } else { 0.0 };
        [ratio(inner * c.per_oa, c.n_bi), ratio(outer * c.per_ob, n_be), -c.n_bi, c.n_bi, n_be]
    }

    #[inline(always)]
    fn slope_of(y: &Pair, [u_rate, v_rate]: [f64; 2]) -> Result<Pair, ()> {
        let finite = (0.0 * u_rate + 0.0 * v_rate) == 0.0;
        if finite { Ok([y[2], y[3], u_rate, v_rate]) } else { Err(()) }
    }

    /// C_bi and C_be at `t`, N m: no flange acts here.
    #[inline(always)]
    fn torques_nm(&self, t: f64) -> [f64; 2] {
        [self.inner.at(t), self.beat.at(t)]
    }

    /// Everything at (t, y).
    #[inline(always)]
    pub(super) fn sight(&mut self, t: f64, y: &Pair) -> Sight {
        let outside = self.torques_nm(t);
        let piece = self.table.piece(y[0]);
        let (m, c) = (piece.motion(y[0]), piece.contacts(y[0]));
        let a = Self::accelerations(self.model, &m, y, outside);
        Sight { t, y: *y, rates: a, figures: Self::figures(self.model, &c, y, a, outside) }
    }
}

/// (m_ww, m_we, m_ee) of the kinetic energy.
#[inline(always)]
fn masses(model: &Model, m: &Motion) -> (f64, f64, f64) {
    let (i_i, i_e) = (model.inner_inertia_kg_m2, model.outer_inertia_kg_m2);
    (i_i + m.a, m.b - i_i, i_i + i_e + m.d)
}

impl RightHandSide<4> for Rolls<'_> {
    type Failure = ();

    #[inline(always)]
    fn slope(&mut self, t: f64, y: &Pair) -> Result<Pair, ()> {
        let m = self.table.motion(y[0]);
        Self::slope_of(y, Self::accelerations(self.model, &m, y, self.torques_nm(t)))
    }

    #[inline(always)]
    fn slope_at_probe(&mut self, probe: usize, t: f64, y: &Pair) -> Result<Pair, ()> {
        if !self.looks && probe + 1 < PROBES.len() {
            return self.slope(t, y);
        }
        self.probed[probe] = self.sight(t, y);
        Self::slope_of(y, self.probed[probe].rates)
    }
}

/// Shortest step, as a part of the longest, before the general run, which has implicit steps as well, is the better one; and where
/// motions pass first contact.
const SHORTEST: [f64; 2] = [1e-3, 1e-6];
/// A step whose right-hand side had no value, as a part of itself the next time.
const SHRUNK: f64 = 0.1;
/// How far beyond a junction that lies ahead a step goes, in parts of the way there and of the longest step: what lies
/// beyond is lost.
const BEYOND: [f64; 2] = [1.05, 0.01];
/// Steps about first contact, where forces are not smooth: as parts of the time until then and since then, and their least as a part
/// of the longest.
const BEFORE: f64 = 0.67;
const AFTER: f64 = 2.0;
const NEAREST: f64 = 0.03;
/// Weighted error up to which a step is taken.
const MOST: f64 = 1.5;

/// Run `model` from `state` on arc `place` with both contacts rolling. `None` where that begins at first contact, leaves the curve or asks
/// for more than these equations hold: a course of speed, a drivetrain, damped contacts, a contact B that holds whatever it takes.
pub(super) fn stuck(model: &Model, state: &State, place: Place, settings: &RunSettings) -> Option<Stuck> {
    let Place::Arc(arc) = place else { return None };
    let plain = model.drive.speed_rad_s.is_none()
        && model.drive.flanges.is_none()
        && model.drive.train.is_none()
        && model.hunt_crossley_s_per_m == 0.0
        && !model.outer_holds;
    if !plain || settings.samples > 0 || settings.energy {
        return None;
    }
    let (mut rolls, y) = Rolls::new(model, arc, state);
    if rolls.table.is_at_first_contact(y[0]) {
        return None;
    }
    let mut run = Stuck {
        peaks: Peaks::NONE,
        legs: Vec::new(),
        largest: [Largest { leg: 0, from: rolls.outset(), t_s: 0.0, edge: Some(Edge::Start) }; FIGURES],
        counters: Counters::default(),
        passed: 0,
        interrupted: false,
        t_s: 0.0,
    };
    integrate(&mut rolls, y, settings, &mut run).then_some(run)
}

/// False where the run leaves what these equations hold.
fn integrate(rolls: &mut Rolls, mut y: Pair, settings: &RunSettings, run: &mut Stuck) -> bool {
    let tolerance = tolerance(settings);
    // When w last passed first contact, once it does.
    let mut crossed_s: Option<f64> = None;
    let longest = settings.longest_step_s;
    let (mut t, mut h) = (0.0, longest);
    let mut step = Step::new();
    let mut now = rolls.sight(t, &y);
    run.largest.iter_mut().for_each(|largest| largest.from.now = now);
    run.counters.rhs_evaluations += 1;
    let loads = &rolls.model.loads;
    let repeats = if loads.amplitude_nm == 0.0 { 0.0 } else { loads.omega_rad_s };
    let damped = rolls.model.damping_nm_s_per_rad > 0.0;
    let mut settled = Settled::new(repeats, settings.duration_s);
    settings.follow.begin_run();
    while t < settings.duration_s {
        if settings.follow.stopped() {
            run.interrupted = true;
            break;
        }
        settings.follow.tell(t);
        if run.counters.steps + run.counters.rejections >= settings.most_steps {
            return false;
        }
        let knot_s = rolls.next_knot_s(t);
        let rest = settings.duration_s.min(knot_s) - t;
        let ahead = rolls.table.junction_ahead_s(&y, now.rates[0]);
        let mut trial = h.min(longest).min(rest).min(BEYOND[0] * ahead + BEYOND[1] * longest);
        if let Some(crossed_s) = crossed_s {
            let least = NEAREST * longest;
            trial = trial.min((AFTER * (t - crossed_s)).max(least));
            let ahead = rolls.table.first_contact_ahead_s(&y, now.rates[0]);
            if ahead > least {
                trial = trial.min((BEFORE * ahead).max(least));
            }
        }
        let slope = rolls.set_out(now);
        let taken = step.take(rolls, t, &y, &slope, trial, &tolerance, MOST, &mut run.counters);
        if trial < SHORTEST[usize::from(crossed_s.is_some())] * longest.min(rest) {
            return false;
        }
        // A step of many swings may leave what has values.
        if taken.is_err() || step.error.is_nan() {
            run.counters.rejections += 1;
            h = SHRUNK * trial;
            continue;
        }
        // A step that was cut short says nothing against a longer one.
        h = if trial < h { h.max(step.next_h()) } else { step.next_h() };
        if step.error > MOST {
            run.counters.rejections += 1;
            h = step.next_h().min(0.9 * trial);
            continue;
        }
        let mut dense = None;
        let Some(end) = first_passage(rolls, &step, &mut dense, &mut run.counters) else { return false };
        if let (Some(theta), Some(d)) = (end, &dense)
            && rolls.table.is_first_contact(d.after(theta * trial)[0])
        {
            // The first step that came there once more, by steps as later ones are.
            if crossed_s.is_none() {
                crossed_s = Some(f64::NEG_INFINITY);
                run.counters.rejections += 1;
                continue;
            }
            crossed_s = Some(t + theta * trial);
        }
        run.counters.steps += 1;
        let until_s = if trial == rest { settings.duration_s.min(knot_s) } else { t + trial };
        let breaks = end.is_none() && rolls.is_knot(until_s);
        run.legs.push(Leg { from_s: t, length_s: trial, until_s, passes: end.is_some(), breaks });
        let range = range(&rolls.probed);
        if !watch(rolls, &step, end, &range, &mut dense, settings, run) {
            return false;
        }
        let reached_s = end.map_or(until_s, |theta| t + theta * trial);
        if damped && settled.after(rolls, [reached_s, settings.duration_s], &range, &run.peaks.figures()) {
            run.t_s = reached_s;
            break;
        }
        match (end, &dense) {
            (Some(theta), Some(d)) => {
                t += theta * trial;
                y = d.after(theta * trial);
                if !rolls.pass(&mut y) {
                    return false;
                }
                run.passed += 1;
                rolls.pass_knot(t);
                now = rolls.sight(t, &y);
                run.counters.rhs_evaluations += 1;
            }
            _ => {
                t = until_s;
                y = step.y1;
                now = rolls.probed[PROBES.len() - 1];
                if breaks {
                    rolls.pass_knot(t);
                    now = rolls.sight(t, &y);
                    run.counters.rhs_evaluations += 1;
                }
            }
        }
        run.t_s = t;
    }
    true
}

/// As [`RunSettings::tolerance_in`] has it while both contacts stick.
fn tolerance(settings: &RunSettings) -> Tolerance<4> {
    let relative = 0.2 * settings.tolerance;
    let (angle, rate) = (1e-2 * relative, 5.0 * relative);
    Tolerance { relative, absolute: [angle, angle, rate, rate], integrated: [0.0; 4], datum: [0.0; 4] }
}

/// Where, as a fraction of the step, w leaves its arc first; `Some(None)`: nowhere. `None`: the right-hand side failed.
pub(super) fn first_passage(
    rolls: &mut Rolls,
    step: &Step<4>,
    dense: &mut Option<Dense<4>>,
    counters: &mut Counters,
) -> Option<Option<f64>> {
    let [from, until] = rolls.table.ends();
    // How far beyond an end, positive outside.
    let beyond = |w: f64| (from - w).max(w - until);
    // Most steps stay far inside: between two probes, no more than half a step apart, w rises by no more than half of the way that it
    // would go at the larger of its rates there.
    let (nearest, fastest) = rolls.probed.iter().fold((f64::NEG_INFINITY, 0.0_f64), |(near, fast), s| {
        (near.max(beyond(s.y[0])), fast.max(s.y[2].abs()))
    });
    if nearest + 0.25 * step.h * fastest <= 0.0 {
        return Some(None);
    }
    for j in 1..PROBES.len() {
        let [a, b] = [rolls.probed[j - 1].y, rolls.probed[j].y];
        let gap = (PROBES[j] - PROBES[j - 1]) * step.h;
        // Between two probes w may turn: of the parabola by its rates, half the gap times the product over the difference.
        let turns = a[2] * b[2] < 0.0;
        let rise = if turns { gap * (a[2] * b[2] / (a[2] - b[2])).abs() } else { 0.0 };
        if beyond(a[0]).max(beyond(b[0])) + rise <= 0.0 {
            continue;
        }
        if dense.is_none() {
            *dense = Some(step.dense(rolls, counters).ok()?);
        }
        let d = dense.as_ref()?;
        let at = |theta: f64| d.after(theta * step.h);
        let (low, mut high) = (PROBES[j - 1], PROBES[j]);
        if turns {
            let top = root::bracketed(low, high, a[2], at(high)[2], 1e-9, |theta| at(theta)[2]);
            high = top.filter(|&top| beyond(at(top)[0]) > 0.0).unwrap_or(high);
        }
        let (start, end) = (if j == 1 { beyond(a[0]) } else { beyond(at(low)[0]) }, beyond(at(high)[0]));
        if end <= 0.0 {
            continue;
        }
        if start >= 0.0 {
            // At the junction already, and leaving.
            return Some(Some(low));
        }
        return Some(root::bracketed(low, high, start, end, 1e-13, |theta| beyond(at(theta)[0])));
    }
    Some(None)
}

/// Least and most of each figure among `probes`.
fn range(probes: &[Sight]) -> [[f64; 2]; FIGURES] {
    let mut range = [[f64::INFINITY, f64::NEG_INFINITY]; FIGURES];
    for Sight { figures, .. } in probes {
        for ([low, high], f) in range.iter_mut().zip(figures) {
            *low = if f < low { *f } else { *low };
            *high = if f > high { *f } else { *high };
        }
    }
    range
}

/// Records of the step up to `end`; its probes lie within `whole`. False: the right-hand side failed.
fn watch(
    rolls: &mut Rolls,
    step: &Step<4>,
    end: Option<f64>,
    whole: &[[f64; 2]; FIGURES],
    dense: &mut Option<Dense<4>>,
    settings: &RunSettings,
    run: &mut Stuck,
) -> bool {
    // A figure is smooth over the step: between probes, of which the fastest swing that such steps follow has a dozen in a
    // period, it rises above them by far less than they differ.
    let best = run.peaks.figures();
    let may_hold_a_record = |range: &[[f64; 2]; FIGURES]| {
        std::array::from_fn::<bool, FIGURES, _>(|i| range[i][1] + (range[i][1] - range[i][0]) >= best[i])
    };
    if end.is_none() && !may_hold_a_record(whole).contains(&true) {
        return true;
    }
    let mut at = PROBES;
    let mut seen = rolls.probed;
    let mut count = PROBES.len();
    if let (Some(theta), Some(d)) = (end, dense.as_ref()) {
        count = PROBES.iter().filter(|&&l| l < theta).count().min(PROBES.len() - 2).max(1);
        let mut places = vec![theta];
        if count == 1 {
            places.insert(0, 0.5 * theta);
        }
        for theta in places {
            (at[count], seen[count]) =
                (theta, rolls.sight(step.t + theta * step.h, &d.after(theta * step.h)));
            count += 1;
            run.counters.rhs_evaluations += 1;
        }
    }
    let last = at[count - 1];
    at[..count].iter_mut().for_each(|a| *a /= last);
    let grid = Grid { at: &at[..count] };
    let length = last * step.h;
    let fine = 1e-3 * settings.tolerance;
    let may = may_hold_a_record(&range(&seen[..count]));
    let mut peaks = run.peaks;
    let (leg, outset) = (run.legs.len() - 1, rolls.outset());
    for (i, mut best) in run.peaks.figures().into_iter().enumerate() {
        if !may[i] {
            continue;
        }
        let value = |j: usize| seen[j].figures[i];
        for (j, edge) in [(0, Edge::Start), (count - 1, Edge::End)] {
            if value(j) > best {
                best = value(j);
                peaks.keep(i, seen[j].t, best, seen[j].figures[super::events::N_BI]);
                run.largest[i] = Largest { leg, from: outset, t_s: seen[j].t, edge: Some(edge) };
            }
        }
        for j in 0..count {
            let enough = best + fine * best.abs();
            let (left, right) = grid.beside(j);
            let top = value(j) >= value(left) && value(j) >= value(right);
            if !top || value(j) + grid.overshoot(j, value) <= enough {
                continue;
            }
            if dense.is_none() {
                let Ok(d) = step.dense(rolls, &mut run.counters) else { return false };
                *dense = Some(d);
            }
            let Some(d) = dense.as_ref() else { return false };
            let mut figures = |theta: f64| {
                let elapsed = theta * length;
                rolls.sight(step.t + elapsed, &d.after(elapsed)).figures
            };
            let (from, guess, until) = (at[left], grid.extreme(j, value), at[right]);
            let (theta, found) =
                highest(from, guess, until, enough, fine * value(j).abs(), |theta| figures(theta)[i]);
            if found > best {
                best = found;
                let t_s = step.t + theta * length;
                peaks.keep(i, t_s, best, figures(theta)[super::events::N_BI]);
                run.largest[i] = Largest { leg, from: outset, t_s, edge: None };
            }
        }
    }
    run.peaks = peaks;
    true
}

impl Rolls<'_> {
    /// Over the junction at which `y` is, into the next arc: e's momentum and kinetic energy are kept, as [`super::crossing`]
    /// has it. False where there is none.
    pub(super) fn pass(&mut self, y: &mut Pair) -> bool {
        let [from, until] = self.table.ends();
        let up = y[0] - 0.5 * (from + until) > 0.0;
        let [_, _, u, v] = *y;
        let junction = if up { until } else { from };
        let (ww, we, ee) = masses(self.model, &self.table.motion(junction));
        let momentum = we * u + ee * v;
        let before = ww - we * we / ee;
        if !self.table.pass(up) {
            return false;
        }
        let (ww, we, ee) = masses(self.model, &self.table.motion(junction));
        let u = scaled(u, before, ww - we * we / ee);
        *y = [junction, y[1], u, (momentum - we * u) / ee];
        true
    }
}
