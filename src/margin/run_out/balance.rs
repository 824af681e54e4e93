//! Which windup, and which shift of a race that is not held, carry a torque.

use super::{RunOut, rotated};
use crate::clutch::Carrier;
use crate::numeric::root;
use crate::wedge::{EndReason, StaticPoint, WedgeCurve};
use nalgebra::{Matrix3, Vector2, Vector3};

/// One sprag under load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpragLoad {
    /// Where it engaged, index of a seat.
    pub engaged: usize,
    /// Where it stands.
    pub seat: usize,
    /// N_bi, N; 0: no load.
    pub normal_n: f64,
    /// T_bi OA, torque on the inner race about its axis, N m.
    pub torque_nm: f64,
    /// Force on the inner race, N: x towards the widest gap, y a quarter turn on.
    pub force_n: [f64; 2],
}

/// All sprags at one windup.
#[derive(Debug, Clone, PartialEq)]
pub struct Round {
    /// By how many places the sprags have moved on since they engaged.
    pub turned: usize,
    /// Windup since every sprag touched, rad.
    pub windup_rad: f64,
    /// How far the inner race has given way, m, as the forces count; 0 where it is held.
    pub shift_m: [f64; 2],
    /// The sprags by where they engaged.
    pub loads: Vec<SpragLoad>,
}

impl Round {
    /// Torque on the inner race about its axis, N m.
    pub fn torque_nm(&self) -> f64 {
        self.loads.iter().map(|l| l.torque_nm).sum()
    }

    /// Resultant of the contact forces on the inner race, N: what its bearings have to hold.
    pub fn radial_n(&self) -> [f64; 2] {
        let sum = self.loads.iter().map(|l| Vector2::from(l.force_n)).sum::<Vector2<f64>>();
        sum.into()
    }

    /// Largest normal force over the mean of all sprags, and whose it is.
    pub fn share(&self) -> (f64, SpragLoad) {
        let mean = self.loads.iter().map(|l| l.normal_n).sum::<f64>() / self.loads.len() as f64;
        let most = self.loads.iter().fold(self.loads[0], |a, l| if l.normal_n > a.normal_n { *l } else { a });
        (if mean > 0.0 { most.normal_n / mean } else { 1.0 }, most)
    }

    /// Sprags that carry nothing.
    pub fn unloaded(&self) -> usize {
        self.loads.iter().filter(|l| l.normal_n <= 0.0).count()
    }
}

/// Where a clutch off centre comes to its end: the first sprag comes to the end of its own curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OffCentreEnd {
    /// Torque of the whole clutch there, N m.
    pub torque_nm: f64,
    /// The sprag's place, index of a seat; `None`: no sprag carries at all.
    pub seat: Option<usize>,
    /// Why; `NoConvergence`: no balance of the race that gives way was found.
    pub reason: EndReason,
}

/// All rounds at one torque, with the static state of every sprag.
#[derive(Debug, Clone)]
pub struct Survey {
    /// Torque, N m.
    pub torque_nm: f64,
    /// Rounds.
    pub rounds: Vec<Round>,
    /// State of each sprag of each round; unloaded ones are left out.
    points: Vec<(SpragLoad, StaticPoint)>,
}

impl Survey {
    /// Largest value of `demand`, and the sprag it belongs to.
    pub fn worst(&self, demand: impl Fn(&StaticPoint) -> f64) -> Option<(f64, SpragLoad)> {
        let values = self.points.iter().map(|(load, p)| (demand(p), *load));
        values.max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The round with the largest share of one sprag.
    pub fn worst_round(&self) -> &Round {
        let first = &self.rounds[0];
        self.rounds.iter().fold(first, |a, r| if r.share().0 > a.share().0 { r } else { a })
    }

    /// Largest resultant of all rounds, N.
    pub fn radial_n(&self) -> f64 {
        self.rounds.iter().map(|r| Vector2::from(r.radial_n()).norm()).fold(0.0, f64::max)
    }

    /// Most sprags without load in one round.
    pub fn unloaded(&self) -> usize {
        self.rounds.iter().map(Round::unloaded).max().unwrap_or(0)
    }
}

impl RunOut {
    /// All sprags, moved on by `turned` places, at `windup_rad` with the inner race shifted by `shift_m`.
    ///
    /// # Errors
    /// The seat whose curve ends before.
    pub fn round(&self, turned: usize, windup_rad: f64, shift_m: [f64; 2]) -> Result<Round, usize> {
        let loads = (0..self.seats.len()).map(|engaged| self.load(engaged, turned, windup_rad, shift_m));
        Ok(Round { turned, windup_rad, shift_m, loads: loads.collect::<Result<_, _>>()? })
    }

    /// Index of the seat to which a sprag has come.
    fn moved_on(&self, engaged: usize, turned: usize) -> usize {
        (engaged + turned) % self.seats.len()
    }

    fn load(
        &self,
        engaged: usize,
        turned: usize,
        windup_rad: f64,
        shift_m: [f64; 2],
    ) -> Result<SpragLoad, usize> {
        let seat = self.moved_on(engaged, turned);
        let none = SpragLoad { engaged, seat, normal_n: 0.0, torque_nm: 0.0, force_n: [0.0; 2] };
        let Some((curve, lag)) = self.lag(engaged, seat) else { return Ok(none) };
        // As the race that carries the offset sees it; sprags stand at even azimuths when they touch.
        let rests = self.seats[seat].azimuth_rad + self.seats[engaged].turned_rad;
        let (own, carried) = match shift_m {
            [0.0, 0.0] => (windup_rad + lag, None),
            _ => {
                let (more, carried) = self.yielded(curve, windup_rad + lag, shift_m, rests);
                (windup_rad + lag + more, Some(carried))
            }
        };
        if own <= 0.0 {
            return Ok(none);
        }
        let (p, along_curve) = curve.at_windup(own).ok_or(seat)?;
        // A race that gives way rolls no sprag on.
        let carried = carried.unwrap_or(along_curve);
        let (sin, cos) = (p.beta_gamma - p.gamma).sin_cos();
        // On the inner race, along the radius at C_e and across it: -N n_A + T t_A.
        let along = -p.n_bi * cos - p.t_static * sin;
        let across = -p.n_bi * sin + p.t_static * cos;
        let force_n = rotated([along, across], rests - carried);
        Ok(SpragLoad { normal_n: p.n_bi, torque_nm: p.t_static * p.oa, force_n, ..none })
    }

    /// Windup, rad, that shortens the strut of a sprag wound up by `own` as the inner race moved by `shift_m` does: the part
    /// of the shift along AB over OA sin omega, or over OB sin nu where the inner race carries the offset. Of first order in
    /// the shift. Beside it how far the sprag has rolled on.
    fn yielded(&self, curve: &WedgeCurve, own: f64, shift_m: [f64; 2], rests_rad: f64) -> (f64, f64) {
        let end = curve.end_windup_rad();
        // A sprag without load takes what it has at its touch.
        let Some((p, carried)) = curve.at_windup(own.clamp(1e-6 * end, end)) else {
            return (0.0, 0.0);
        };
        let omega = (p.t_static / p.n_bi).atan();
        let nu = omega - (p.beta_gamma - p.gamma);
        let [along, across] = rotated(shift_m, carried - rests_rad);
        let lever = match self.carrier {
            Carrier::OuterRace => p.oa * omega.sin(),
            Carrier::InnerRace => p.ob * nu.sin(),
        };
        ((along * nu.cos() - across * nu.sin()) / lever, carried)
    }

    /// The curve of a sprag's present place and by how much its own windup exceeds the common one: g where it
    /// engaged less g where it stands. `None`: it did not touch when the clutch engaged, or has no gap to stand in now.
    fn lag(&self, engaged: usize, seat: usize) -> Option<(&WedgeCurve, f64)> {
        let (from, to) = (&self.seats[engaged], &self.seats[seat]);
        let (Ok(_), Ok(curve)) = (&from.curve, &to.curve) else { return None };
        let here = match engaged == seat {
            true => to.touch_windup_rad,
            // It has not rolled on since it engaged.
            false => curve.statics().touch_windup_rad(rotated(to.offset_m, -from.turned_rad))?,
        };
        Some((curve, from.touch_windup_rad - here))
    }

    /// Windup at which the first sprag takes load and that at which the first comes to the end of its curve, with its seat.
    fn windups(&self, turned: usize) -> Option<(f64, f64, usize)> {
        let mut range: Option<(f64, f64, usize)> = None;
        for engaged in 0..self.seats.len() {
            let seat = self.moved_on(engaged, turned);
            let Some((curve, lag)) = self.lag(engaged, seat) else { continue };
            let (from, until) = (-lag, curve.end_windup_rad() - lag);
            let (a, b, at) = range.unwrap_or((from, until, seat));
            range = Some((a.min(from), b.min(until), if until < b { seat } else { at }));
        }
        range
    }

    pub(super) fn find_end(&self) -> OffCentreEnd {
        let ends = self.turns.iter().map(|&turned| self.end_of(turned));
        let held = ends.min_by(|a, b| a.torque_nm.total_cmp(&b.torque_nm)).unwrap_or(OffCentreEnd::EMPTY);
        let balanced = |torque: f64| self.survey(torque).is_ok();
        if self.stiffness_n_per_m.is_infinite() || balanced(held.torque_nm * (1.0 - 1e-9)) {
            return held;
        }
        let (mut last, mut beyond) = (0.0, held.torque_nm);
        for _ in 0..16 {
            let torque = 0.5 * (last + beyond);
            if balanced(torque) { last = torque } else { beyond = torque }
        }
        OffCentreEnd { torque_nm: last, ..held }
    }

    fn end_of(&self, turned: usize) -> OffCentreEnd {
        let Some((from, until, seat)) = self.windups(turned) else { return OffCentreEnd::EMPTY };
        let reason = self.seats[seat].curve.as_ref().map_or(EndReason::NoConvergence, |c| c.end().0);
        // A sprag at its end before any other touches: nothing is carried.
        let last = self.round(turned, until, [0.0; 2]).ok().filter(|_| until > from);
        OffCentreEnd { torque_nm: last.map_or(0.0, |r| r.torque_nm()), seat: Some(seat), reason }
    }

    /// The round that carries `torque_nm`.
    ///
    /// # Errors
    /// [`OffCentreEnd`] where a sprag comes to its end before, or no balance of a race that gives way was found.
    pub fn carrying(&self, turned: usize, torque_nm: f64) -> Result<Round, OffCentreEnd> {
        let held = self.on_fixed_axes(turned, torque_nm)?;
        if self.stiffness_n_per_m.is_infinite() {
            return Ok(held);
        }
        self.on_bearings(held, torque_nm)
    }

    /// The axes held: by bracketing in the windup.
    fn on_fixed_axes(&self, turned: usize, torque_nm: f64) -> Result<Round, OffCentreEnd> {
        let stop = self.end_of(turned);
        let (Some((from, until, _)), true) = (self.windups(turned), stop.torque_nm >= torque_nm) else {
            return Err(stop);
        };
        let miss = |w: f64| self.round(turned, w, [0.0; 2]).map_or(f64::NAN, |r| r.torque_nm() - torque_nm);
        let (a, b) = (miss(from), miss(until));
        let w = root::bracketed(from, until, a, b, 1e-15 * (until - from), miss).ok_or(stop)?;
        self.round(turned, w, [0.0; 2]).map_err(|_| stop)
    }

    /// The inner race on its bearings: radial forces of the sprags = stiffness times shift, by Newton in (windup, shift),
    /// each in units of what winds a sprag up alike.
    fn on_bearings(&self, held: Round, torque_nm: f64) -> Result<Round, OffCentreEnd> {
        let turned = held.turned;
        let none = OffCentreEnd { reason: EndReason::NoConvergence, ..self.end_of(turned) };
        // A shift of the race by `per_rad` is about as much to a sprag as a radian of windup: OA tan omega.
        let normal: f64 = held.loads.iter().map(|l| l.normal_n).sum();
        let per_rad = torque_nm / normal;
        let at = |x: &Vector3<f64>| self.round(turned, x[0], [x[1] * per_rad, x[2] * per_rad]).ok();
        // Torque and force, over torque and the sum of normal forces.
        let miss = |r: &Round| {
            let [fx, fy] = r.radial_n();
            let held_by = |f: f64, shift: f64| (f - self.stiffness_n_per_m * shift) / normal;
            let torque = r.torque_nm() / torque_nm - 1.0;
            Vector3::new(torque, held_by(fx, r.shift_m[0]), held_by(fy, r.shift_m[1]))
        };
        let mut x = Vector3::new(held.windup_rad, 0.0, 0.0);
        let mut round = held;
        let mut f = miss(&round);
        for _ in 0..60 {
            if f.amax() < 1e-11 {
                return Ok(round);
            }
            let mut slopes = Matrix3::zeros();
            let h = 1e-6 * x[0].abs();
            for k in 0..3 {
                let mut beside = x;
                // Downwards, so that the end of a curve is not passed.
                beside[k] -= h;
                let there = at(&beside).ok_or(none)?;
                slopes.set_column(k, &((f - miss(&there)) / h));
            }
            let step = slopes.lu().solve(&f).ok_or(none)?;
            let mut share = 1.0;
            let (next, r) = loop {
                let next = x - step * share;
                match at(&next) {
                    Some(r) if miss(&r).norm() < f.norm() => break (next, r),
                    // Rounding, or a kink where a sprag comes off that the step cannot cross.
                    _ if share < 1e-6 => return if f.amax() < 1e-8 { Ok(round) } else { Err(none) },
                    _ => share *= 0.5,
                }
            };
            f = miss(&r);
            (x, round) = (next, r);
        }
        Err(none)
    }

    /// All rounds at `torque_nm`.
    ///
    /// # Errors
    /// The [`OffCentreEnd`] of the round that ends first.
    pub fn survey(&self, torque_nm: f64) -> Result<Survey, OffCentreEnd> {
        let rounds = self.turns.iter().map(|&turned| self.carrying(turned, torque_nm));
        let mut kept = Vec::with_capacity(self.turns.len());
        let mut first: Option<OffCentreEnd> = None;
        for round in rounds {
            match round {
                Ok(round) => kept.push(round),
                Err(stop) => {
                    first = Some(first.map_or(stop, |f| if stop.torque_nm < f.torque_nm { stop } else { f }));
                }
            }
        }
        if let Some(stop) = first {
            return Err(stop);
        }
        let all = kept.iter().flat_map(|r| &r.loads);
        let points = all.filter_map(|l| {
            let curve = self.seats[l.seat].curve.as_ref().ok()?;
            // The table's end is the curve's to rounding.
            let n = l.normal_n.min(curve.arc_end_n(curve.arc_count() - 1));
            Some((*l, curve.at_normal(n).filter(|_| n > 0.0)?))
        });
        let points = points.collect();
        Ok(Survey { torque_nm, rounds: kept, points })
    }
}

impl OffCentreEnd {
    pub(super) const EMPTY: Self = Self { torque_nm: 0.0, seat: None, reason: EndReason::NoConvergence };
}
