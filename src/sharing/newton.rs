//! Which windup of each sprag, of the races, and which shift of a race that is not held, carry a torque.

use super::{Bears, Shared, Unlike, rotated};
use crate::clutch::Carrier;
use crate::numeric::root;
use crate::wedge::{Borne, EndReason, SpragDeviation, Statics};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::{PI, TAU};

/// Steps of Newton's method: it needs 4 to 12, more where many sprags come off.
const STEPS: usize = 80;
/// What counts as balanced: of the windup, the torque, the sum of normal forces.
const BALANCED: f64 = 1e-12;
/// The same where rounding lets it come no nearer.
const NEARLY: f64 = 1e-9;

/// Parts of a torque from which it is approached.
const APPROACH: [f64; 3] = [0.6, 0.3, 0.1];
/// Step of that at which it ends, as a part of the torque.
const NARROW: f64 = 1e-3;

/// What is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Asked {
    /// This torque, N m > 0.
    Torque(f64),
    /// The torque at which this sprag begins to carry.
    Touch(usize),
}

/// Why the torque is not shared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NotShared {
    /// No sprag can carry.
    NoneCarries,
    /// A sprag comes to its end before: its number, why.
    End(usize, EndReason),
    /// The torque is so small that rounding hides it.
    Faint,
    /// Nothing holds the race, and no sprag stands opposite of those that carry.
    OneSided,
    /// No balance was found.
    NoBalance,
}

/// Part of the torque at the curve's end below which rounding may hide a torque.
const FAINT: f64 = 1e-8;

impl NotShared {
    /// In words.
    pub fn words(self) -> String {
        match self {
            Self::NoneCarries => "no sprag carries".to_owned(),
            Self::End(i, reason) => format!("sprag {} comes to its end first, {}", i + 1, reason.name()),
            Self::Faint => "too small a torque: rounding hides it".to_owned(),
            Self::OneSided => {
                "nothing holds the race, and no sprag opposite keeps it in its place".to_owned()
            }
            Self::NoBalance => "its balance of forces was not found by the method".to_owned(),
        }
    }
}

/// All sprags at trial values of the unknowns.
struct Trial {
    shared: Shared,
    /// What is missed: each sprag's windup, rad, torque or touch, forces, in units of [`BALANCED`].
    miss: DVector<f64>,
    /// dN_bi/dy of each sprag, N/rad.
    stiffness: Vec<f64>,
    /// Each sprag alike at its force: dN_be, dT_bi, dT_be over dN_bi.
    follow: Vec<[f64; 3]>,
    /// d(g_i - g)/dN_bi, rad/N.
    stray: Vec<f64>,
    /// dg_i over what inner and outer track recede, rad/m.
    opens: Vec<[f64; 2]>,
    /// dg_i over the shift, rad/m.
    shifts: Vec<[f64; 2]>,
    /// d(T OA)/dN, m; dF/dN.
    rises: Vec<[f64; 3]>,
}

/// Scales of torque and forces, and of the shift, so that all rows are pure numbers near 1.
#[derive(Clone, Copy)]
struct NewtonScales {
    windup_rad: f64,
    torque_nm: f64,
    normal_n: f64,
    shift_m: f64,
}

/// What is solved.
#[derive(Clone, Copy)]
struct BalanceCase {
    asked: Asked,
    turned_rad: f64,
    scales: NewtonScales,
    stiffness_n_per_m: f64,
}

impl Unlike<'_> {
    /// The sprags at what is asked, the widest gap turned on by `turned_rad` since they engaged.
    ///
    /// # Errors
    /// [`NotShared`], which is an answer.
    pub fn carrying(&self, asked: Asked, turned_rad: f64) -> Result<Shared, NotShared> {
        let lags = self.lag_rad.iter().flatten();
        let first = lags.copied().fold(f64::INFINITY, f64::min);
        if first.is_infinite() {
            return Err(NotShared::NoneCarries);
        }
        let (x, scales) = self.guess(asked, first)?;
        let case = BalanceCase { asked, turned_rad, scales, stiffness_n_per_m: self.stiffness_n_per_m };
        let found = match (self.balanced(&x, case), asked) {
            (Err(NotShared::NoBalance), Asked::Torque(wanted)) => self.approached(wanted, first, case),
            (found, _) => found.map(|(_, found)| found),
        };
        found.and_then(|found| self.finished(found)).map_err(|why| self.reason(why, asked))
    }

    /// The same where no balance was found at once: from a part of the torque on, each balance the start of the next; how far that leads
    /// says which sprag comes to its end.
    fn approached(&self, wanted: f64, first: f64, case: BalanceCase) -> Result<Shared, NotShared> {
        let begin = APPROACH.iter().find_map(|part| {
            let (x, scales) = self.guess(Asked::Torque(part * wanted), first).ok()?;
            let case = BalanceCase { asked: Asked::Torque(part * wanted), scales, ..case };
            let (x, found) = self.balanced(&x, case).ok()?;
            Some((*part, x, scales, found))
        });
        let (mut part, mut x, scales, mut found) = begin.ok_or(NotShared::NoBalance)?;
        let (mut step, mut why) = (0.5 * (1.0 - part), NotShared::NoBalance);
        while part < 1.0 && step > NARROW {
            let next = (part + step).min(1.0);
            let asked = Asked::Torque(next * wanted);
            match self.balanced(&x, BalanceCase { asked, scales, ..case }) {
                Ok(there) => (part, (x, found)) = (next, there),
                Err(not) => {
                    why = not;
                    step *= 0.5;
                }
            }
        }
        if part == 1.0 {
            return Ok(found);
        }
        let (worst, own_rad) = found.worst(|l| l.own_rad);
        match why {
            NotShared::NoBalance if own_rad > 0.9 * self.curve.end_windup_rad() => {
                Err(NotShared::End(worst, self.curve.end().0))
            }
            why => Err(why),
        }
    }

    /// What lies behind a torque that is not carried.
    fn reason(&self, why: NotShared, asked: Asked) -> NotShared {
        let faint = matches!(asked, Asked::Torque(torque) if torque < FAINT * self.curve.end_torque_nm());
        match why {
            _ if self.stiffness_n_per_m == 0.0 && self.one_sided() => NotShared::OneSided,
            NotShared::NoBalance if faint => NotShared::Faint,
            why => why,
        }
    }

    /// Whether all sprags that can carry stand in one half of the circumference.
    fn one_sided(&self) -> bool {
        let able = self.sprags.iter().zip(&self.idle).filter(|(_, idle)| idle.is_none());
        let mut at: Vec<f64> = able.map(|(sprag, _)| sprag.azimuth_rad.rem_euclid(TAU)).collect();
        at.sort_by(f64::total_cmp);
        let round = at.first().map(|first| first + TAU);
        let next = at.iter().copied().skip(1).chain(round);
        at.iter().zip(next).any(|(from, to)| to - from > PI)
    }

    fn balanced(&self, x: &DVector<f64>, case: BalanceCase) -> Result<(DVector<f64>, Shared), NotShared> {
        let scales = case.scales;
        let direct = self.solved(x, case);
        if direct.is_ok() || self.stiffness_n_per_m.is_infinite() {
            return direct;
        }
        // A race that floats comes to rest far from where it was held: it is let go by and by.
        let mut x = x.clone();
        let stiff = scales.normal_n / scales.shift_m;
        for part in (-2..=8).map(|k| 0.1_f64.powi(k) * stiff).filter(|k| *k > self.stiffness_n_per_m) {
            x = self.solved(&x, BalanceCase { stiffness_n_per_m: part, ..case }).or(direct.clone())?.0;
        }
        self.solved(&x, case).or(direct)
    }

    /// Newton's method from `x`.
    fn solved(&self, x: &DVector<f64>, case: BalanceCase) -> Result<(DVector<f64>, Shared), NotShared> {
        let mut x = x.clone();
        let mut statics = vec![(self.statics().clone(), 0); self.sprags.len()];
        let mut trial = self.trial(&mut statics, &x, case)?;
        let mut steps = 0;
        for step in 0..STEPS {
            let off = trial.miss.amax();
            let Some(change) = self.jacobian(&trial, case).lu().solve(&trial.miss) else { break };
            // The last step is for the digits, and is taken where it helps.
            let least = if off < BALANCED { 1.0 } else { 1e-4 };
            let bounded = self.bounded(&x, &change);
            let mut share = 1.0;
            let next = loop {
                let there = &x - &bounded * share;
                // A trial in which nothing carries any more says not where to go.
                let carries =
                    |found: &Trial| found.shared.torque_nm > 0.0 || matches!(case.asked, Asked::Touch(_));
                match self.trial(&mut statics, &there, case).ok().filter(carries) {
                    // Sprags that come and go bend the rows: now and then a step is taken that gains nothing.
                    Some(found)
                        if found.miss.amax() < off || off > BALANCED && share > 0.9 && step % 8 == 5 =>
                    {
                        break Some((there, found));
                    }
                    _ if share <= least => break None,
                    _ => share *= 0.5,
                }
            };
            let Some((there, found)) = next else { break };
            (x, trial, steps) = (there, found, step + 1);
            if off < BALANCED {
                break;
            }
        }
        match trial.miss.amax() < NEARLY {
            true => Ok((x, Shared { steps, ..trial.shared })),
            false => Err(self.why_not(&trial)),
        }
    }

    fn finished(&self, found: Shared) -> Result<Shared, NotShared> {
        let on = |l: &Bears| l.own_rad <= 0.0 || self.statics().on_profile(l.turn_rad);
        match found.loads.iter().position(|l| !on(l)) {
            Some(i) => Err(NotShared::End(i, EndReason::OffProfile)),
            None => Ok(found),
        }
    }

    /// A sprag that is driven against the end of the curve stops the search there.
    fn why_not(&self, trial: &Trial) -> NotShared {
        let end = self.curve.end_windup_rad();
        let (worst, own) = trial.shared.worst(|l| l.own_rad);
        let off =
            trial.shared.loads.iter().position(|l| l.own_rad > 0.0 && !self.statics().on_profile(l.turn_rad));
        match off {
            Some(i) => NotShared::End(i, EndReason::OffProfile),
            None if own > 0.9 * end => NotShared::End(worst, self.curve.end().0),
            None => NotShared::NoBalance,
        }
    }

    /// A step that takes no sprag beyond 0.9 of its way to the end of the curve.
    fn bounded(&self, x: &DVector<f64>, change: &DVector<f64>) -> DVector<f64> {
        let end = self.curve.end_windup_rad();
        let room =
            (0..self.sprags.len()).filter(|&i| change[i] < 0.0).map(|i| 0.9 * (end - x[i]) / -change[i]);
        change * room.fold(1.0, f64::min).max(0.0)
    }

    /// Windups at which sprags with their lags, races stiff and held, carry what is asked.
    fn guess(&self, asked: Asked, first: f64) -> Result<(DVector<f64>, NewtonScales), NotShared> {
        let end = self.curve.end_windup_rad();
        let own = |w: f64, lag: f64| (w - lag).min(end * (1.0 - 1e-9));
        let torque = |w: f64| -> f64 {
            let at = |&lag: &f64| self.curve.at_windup(own(w, lag)).map_or(0.0, |(p, _)| p.t_static * p.oa);
            self.lag_rad.iter().flatten().map(at).sum()
        };
        let last = self.lag_rad.iter().flatten().copied().fold(first, f64::max) + end;
        let windup_rad = match asked {
            Asked::Torque(wanted) if torque(last) <= wanted => last,
            Asked::Torque(wanted) => {
                let miss = |w: f64| torque(w) - wanted;
                root::bracketed(first, last, -wanted, miss(last), 1e-9 * end, miss).unwrap_or(last)
            }
            Asked::Touch(i) => self.lag_rad[i].ok_or(NotShared::NoneCarries)?,
        };
        let n = self.sprags.len();
        let held = self.stiffness_n_per_m.is_infinite();
        let mut x = DVector::zeros(n + if held { 1 } else { 3 });
        let mut normal_n = 0.0;
        for (i, lag) in self.lag_rad.iter().enumerate() {
            let Some(lag) = lag else { continue };
            x[i] = own(windup_rad, *lag);
            normal_n += self.curve.at_windup(x[i]).map_or(0.0, |(p, _)| p.n_bi);
        }
        x[n] = windup_rad;
        let torque_nm = match asked {
            Asked::Torque(wanted) => wanted,
            Asked::Touch(_) => torque(windup_rad).max(1e-9),
        };
        // Rounding of angles is 1e-16.
        let windup_rad = (windup_rad - first).max(1e-3);
        let normal_n = normal_n.max(1e-6);
        // A shift by that is about as much to a sprag as all the windup: OA tan omega.
        Ok((x, NewtonScales { windup_rad, torque_nm, normal_n, shift_m: windup_rad * torque_nm / normal_n }))
    }

    /// `statics`: each sprag's own, and the arc that its contact was on in the trial before.
    fn trial(
        &self,
        statics: &mut [(Statics, usize)],
        x: &DVector<f64>,
        case: BalanceCase,
    ) -> Result<Trial, NotShared> {
        let BalanceCase { asked, turned_rad, scales, stiffness_n_per_m } = case;
        let n = self.sprags.len();
        let windup_rad = x[n];
        let shift_m =
            if x.len() > n + 1 { [x[n + 1] * scales.shift_m, x[n + 2] * scales.shift_m] } else { [0.0; 2] };
        let axis = self.axis_m(turned_rad);
        let axis_m = [axis[0] + shift_m[0], axis[1] + shift_m[1]];
        let none = vec![[0.0; 2]; n];
        let mut t = Trial {
            shared: Shared {
                torque_nm: 0.0,
                windup_rad,
                turned_rad,
                shift_m,
                radial_n: [0.0; 2],
                loads: vec![Bears::default(); n],
                steps: 0,
            },
            miss: DVector::zeros(x.len()),
            stiffness: vec![0.0; n],
            follow: vec![[0.0; 3]; n],
            stray: vec![0.0; n],
            opens: none.clone(),
            shifts: none,
            rises: vec![[0.0; 3]; n],
        };
        let mut alike = vec![None; n];
        // All that carry nothing stand alike.
        let mut unloaded: Option<Borne> = None;
        for i in self.able() {
            let own_rad = x[i];
            t.shared.loads[i].own_rad = own_rad;
            let normal = match own_rad > 0.0 {
                true => self.curve.at_windup(own_rad).ok_or(NotShared::NoBalance)?.0.n_bi,
                false => 0.0,
            };
            let borne = match unloaded.filter(|_| normal == 0.0) {
                Some(known) => known,
                None => self.statics().borne_near(normal, statics[i].1).ok_or(NotShared::NoBalance)?,
            };
            if normal == 0.0 {
                unloaded = Some(borne);
            }
            let c = borne.closure;
            if own_rad > 0.0 {
                t.stiffness[i] = 1.0 / c.windup_slope();
                t.follow[i] = [c.n_be.d, c.t_bi.d, c.t_be.d];
                let load = &mut t.shared.loads[i];
                (load.normal_inner_n, load.normal_outer_n) = (normal, c.n_be.v);
                (load.tangent_inner_n, load.tangent_outer_n) = (c.t_bi.v, c.t_be.v);
            }
            alike[i] = Some(borne);
        }
        let given = self.given_way(&t.shared.loads);
        for i in self.able() {
            let (bent_m, along_rad) = given[i];
            let made_m = self.made_m(i, turned_rad);
            let [inner_m, outer_m] = [bent_m[0] + made_m[0], bent_m[1] + made_m[1]];
            let offset_m = self.offset_at(i, axis_m);
            let size_m = self.sprags[i].size_m;
            let (own, arc) = &mut statics[i];
            own.set_apart(SpragDeviation { size_m, inner_m, outer_m, offset_m, carrier: self.carrier });
            let load = &mut t.shared.loads[i];
            let b = own.borne_near(load.normal_inner_n, *arc).ok_or(NotShared::NoBalance)?;
            *arc = b.arc;
            let (c, Some(alike)) = (b.closure, &alike[i]) else { continue };
            t.miss[i] =
                (load.own_rad + b.rolled.v - alike.rolled.v - windup_rad - self.start_rad[i] - along_rad)
                    / scales.windup_rad;
            // The strut keeps its length: what parts the tracks along it is made up by windup (`wedge::off_centre`).
            let omega = (c.t_bi.v / c.n_bi).atan();
            let nu = omega - c.beta.v;
            let lever = match self.carrier {
                Carrier::OuterRace => c.lengths.oa.v * omega.sin(),
                Carrier::InnerRace => c.lengths.ob.v * nu.sin(),
            };
            t.opens[i] = [omega.cos() / lever, nu.cos() / lever];
            let stands_rad = self.sprags[i].azimuth_rad + self.turned_rad[i] - c.carried_rad;
            t.shifts[i] = rotated([-nu.cos() / lever, nu.sin() / lever], stands_rad);
            load.bent_m = bent_m;
            load.turn_rad = b.turn_rad;
            if load.own_rad <= 0.0 {
                continue;
            }
            t.stray[i] = b.rolled.d - alike.rolled.d;
            let torque = c.t_bi * c.lengths.oa;
            let (sin, cos) = c.beta.v.sin_cos();
            let force = |n: f64, t: f64| rotated([-n * cos - t * sin, -n * sin + t * cos], stands_rad);
            let [fx, fy] = force(c.n_bi, c.t_bi.v);
            let [dx, dy] = force(1.0, c.t_bi.d);
            t.rises[i] = [torque.d, dx, dy];
            t.shared.torque_nm += torque.v;
            t.shared.radial_n[0] += fx;
            t.shared.radial_n[1] += fy;
            *load = Bears {
                torque_nm: torque.v,
                tan_omega: c.t_bi.v / c.n_bi,
                tan_nu: c.t_be.v / c.n_be.v,
                hertz_inner_pa: b.hertz_inner_pa,
                hertz_outer_pa: b.hertz_outer_pa,
                ..*load
            };
        }
        t.miss[n] = match asked {
            Asked::Torque(wanted) => (t.shared.torque_nm - wanted) / scales.torque_nm,
            Asked::Touch(i) => x[i] / scales.windup_rad,
        };
        for (k, shift_m) in shift_m.iter().enumerate().take(x.len() - n - 1) {
            t.miss[n + 1 + k] = (t.shared.radial_n[k] - stiffness_n_per_m * shift_m) / scales.normal_n;
        }
        match t.miss.iter().all(|m| m.is_finite()) {
            true => Ok(t),
            false => Err(NotShared::NoBalance),
        }
    }

    fn able(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.sprags.len()).filter(|&i| self.idle[i].is_none())
    }

    /// What both tracks recede at each sprag beside the law of even sprags, inner first, m, and the windup that they give along
    /// the tracks, rad.
    fn given_way(&self, loads: &[Bears]) -> Vec<([f64; 2], f64)> {
        let (r_i, r_e) = self.tracks_m();
        let place = |i: usize| {
            let mut moved = [[0.0; 2]; 2];
            for (j, load) in loads.iter().enumerate() {
                let forces = [
                    [load.normal_inner_n, load.tangent_inner_n],
                    [load.normal_outer_n, -load.tangent_outer_n],
                ];
                for race in [0, 1] {
                    let g = &self.bending[race].matrix[i][j];
                    for row in [0, 1] {
                        moved[race][row] += g[row][0] * forces[race][0] + g[row][1] * forces[race][1];
                    }
                }
            }
            ([moved[0][0], moved[1][0]], moved[1][1] / r_e - moved[0][1] / r_i)
        };
        (0..loads.len()).map(place).collect()
    }

    fn tracks_m(&self) -> (f64, f64) {
        let elastic = &self.statics().elastic;
        (elastic.inner_race.track_m(), elastic.outer_race.track_m())
    }

    /// Slopes of the misses by y, W and the shift, each in its unit.
    fn jacobian(&self, t: &Trial, case: BalanceCase) -> DMatrix<f64> {
        let BalanceCase { asked, scales, stiffness_n_per_m, .. } = case;
        let n = self.sprags.len();
        let (r_i, r_e) = self.tracks_m();
        let size = t.miss.len();
        let mut slopes = DMatrix::zeros(size, size);
        for i in 0..n {
            if self.idle[i].is_some() {
                slopes[(i, i)] = 1.0;
                continue;
            }
            for j in self.able() {
                let (inner, outer) = (&self.bending[0].matrix[i][j], &self.bending[1].matrix[i][j]);
                let [n_e, t_i, t_e] = t.follow[j];
                let recede = [inner[0][0] + inner[0][1] * t_i, outer[0][0] * n_e - outer[0][1] * t_e];
                let along =
                    (outer[1][0] * n_e - outer[1][1] * t_e) / r_e - (inner[1][0] + inner[1][1] * t_i) / r_i;
                let by_force = t.opens[i][0] * recede[0] + t.opens[i][1] * recede[1] - along;
                slopes[(i, j)] = by_force * t.stiffness[j] / scales.windup_rad;
            }
            slopes[(i, i)] += (1.0 + t.stray[i] * t.stiffness[i]) / scales.windup_rad;
            slopes[(i, n)] = -1.0 / scales.windup_rad;
            let rows = [
                t.rises[i][0] / scales.torque_nm,
                t.rises[i][1] / scales.normal_n,
                t.rises[i][2] / scales.normal_n,
            ];
            slopes[(n, i)] = rows[0] * t.stiffness[i];
            for k in 0..size - n - 1 {
                slopes[(i, n + 1 + k)] = t.shifts[i][k] * scales.shift_m / scales.windup_rad;
                slopes[(n + 1 + k, i)] = rows[1 + k] * t.stiffness[i];
            }
        }
        if let Asked::Touch(i) = asked {
            slopes.row_mut(n).fill(0.0);
            slopes[(n, i)] = 1.0 / scales.windup_rad;
        }
        for k in n + 1..size {
            slopes[(k, k)] = -stiffness_n_per_m * scales.shift_m / scales.normal_n;
        }
        slopes
    }
}
