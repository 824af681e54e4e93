//! Races that bend between unlike sprags: what each is pressed with, given where all of them stand.
//!
//! alpha_i says where sprag i stands, and with that how far its contacts have come together, its approach D(alpha_i), the integral of
//!
//!   D' = T_bi/N_bi OA (rho_i + rho_e),      T_bi/N_bi = OB sin beta/(OB cos beta - OA),
//!
//! so that N_bi D' is the U' of statics. On its own curve all of D is its own: N_own = N(D). Between races that bend, the tracks recede at
//! i by u_i = sum_j M_ij N_j beside the law of even sprags ([`crate::race::RingInfluence`], as `sharing` has it, a force along a track
//! the part of the normal force that it is under the largest load), and
//!
//!   N_i = N(h_i),      h_i = D(alpha_i) - u_i,      0 where h_i <= 0:
//!
//! n equations for n forces, solved by Newton's method at every evaluation. M is symmetric, so the forces have the potential
//! sum [U(alpha_i) + E(h_i) - E(D(alpha_i))] + 1/2 sum N_i M_ij N_j, E' = N: on alpha_i acts U' + (N_i - N_own) D', and energy is kept.
//! With equal sprags u = 0 and nothing changes, to the bit.
//!
//! The rings have no inertia here. A ring driven at f bends by 1/(1 - (f/f_2)^2) of what it bends at rest, f_2 its
//! lowest mode ([`crate::race::Race::lowest_mode_hz`]): what is left out is the part (f/f_2)^2 of u. Left out beside
//! that: what u changes in OA and OB, some 1e-4 of them, and how the part T/N of a track's force changes with the
//! load or in slip.

use super::approach::{KnownRoot, NO_ROOT, SpragApproach, ratio};
use super::{EACH, HEAD, SpragGroup, SpragMotion};
use crate::dynamics::model::{Model, Place};
use crate::wedge::WedgePoint;
use nalgebra::DMatrix;
use std::sync::Arc;

/// Steps of the Newton method.
const MOST: usize = 60;
/// What counts as solved, as a part of the approach at the curve's end.
const SOLVED: f64 = 1e-14;
/// The same where rounding lets it come no nearer: at a junction N of one arc goes over into that of the next.
const NEARLY: f64 = 1e-11;
/// What may be missed where Newton's method goes on by itself, as a part of the approach at the curve's end, and the least part of a step
/// that is tried on the way there.
const NEAR: f64 = 1e-3;
const LEAST_PART: f64 = 1e-6;
/// Columns that are added at a time.
const COLUMNS: usize = 4;
/// A step that is not this much shorter than the one before asks for new slopes.
const SLOW: f64 = 0.1;

/// `sum` becomes the matrix of these `columns` times `x`, [`COLUMNS`] at a time; all are as long as a whole number of these.
fn multiply(columns: &[f64], x: &[f64], sum: &mut [f64]) {
    let n = sum.len();
    sum.fill(0.0);
    for (four, [u, v, w, x]) in columns.chunks_exact(COLUMNS * n).zip(x.as_chunks::<COLUMNS>().0) {
        let (a, four) = four.split_at(n);
        let (b, four) = four.split_at(n);
        let (c, d) = four.split_at(n);
        for ((((sum, a), b), c), d) in sum.iter_mut().zip(a).zip(b).zip(c).zip(d) {
            *sum += (a * u + b * v) + (c * w + d * x);
        }
    }
}

/// Races that bend between groups of one sprag each.
#[derive(Debug, Clone)]
pub struct Rings {
    /// M by rows, m/N: how far both tracks together recede at one sprag for a newton of N_bi of another. Symmetric.
    pub opens_m_per_n: Vec<f64>,
    /// Of each group's own curve.
    pub approaches: Vec<Arc<SpragApproach>>,
    /// Lowest mode of inner and outer race, Hz.
    pub lowest_mode_hz: [f64; 2],
}

impl Rings {
    /// Whether there is one force of each sprag wherever all of them stand: I + M diag(N') has the eigenvalues of I + N'^1/2 M N'^1/2, above 0
    /// where the least one of M times the steepest N' is above -1. It is not where a law of contact is stiffer than what even sprags bend
    /// the rings, which it should contain: two sprags under law `roller`.
    pub fn has_one_solution(&self) -> bool {
        let n = self.approaches.len();
        let least = DMatrix::from_row_slice(n, n, &self.opens_m_per_n).symmetric_eigenvalues().min();
        let steepest = self.approaches.iter().map(|of| of.steepest()).fold(0.0, f64::max);
        least * steepest > -1.0
    }
}

/// Work of finding it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct BendingWork {
    /// Places of all sprags at which it was sought.
    pub solutions: u64,
    /// Forces of all and what the tracks recede by them.
    pub passes: u64,
    /// Steps by the inverse of the slopes.
    pub products: u64,
    /// Inverses of them.
    pub inversions: u64,
}

/// What the races' bending is where the sprags stand now; solved anew where they stand otherwise.
#[derive(Debug, Clone)]
pub(super) struct Bent<'a> {
    rings: &'a Rings,
    /// M by rows, filled up with zeros to a whole number of [`COLUMNS`], as are all matrices and what they are multiplied with.
    opens: Vec<f64>,
    side: usize,
    /// Where it was solved.
    alphas: Vec<f64>,
    /// Whether each carries where pressed, and its arc.
    seats: Vec<Option<usize>>,
    /// Whether what was solved last is what the sprags have moved on from, on the same seats.
    near: bool,
    /// D(alpha), m; N(D), N.
    approach: Vec<f64>,
    own_n: Vec<f64>,
    /// Of alpha - alpha_0 and of h, near by.
    roots: [Vec<KnownRoot>; 2],
    /// h, m; N(h), N; its slope, N/m; u, m.
    h: Vec<f64>,
    normal: Vec<f64>,
    slopes: Vec<f64>,
    recede: Vec<f64>,
    step: Vec<f64>,
    between: Vec<f64>,
    /// (I + M diag(N'))^-1 by columns.
    inverse: Vec<f64>,
    order: Vec<usize>,
    inverted: bool,
    pub(super) work: BendingWork,
}

impl<'a> Bent<'a> {
    pub(super) fn new(rings: &'a Rings) -> Self {
        let n = rings.approaches.len();
        let side = n.next_multiple_of(COLUMNS);
        let mut opens = vec![0.0; side * side];
        for (to, from) in opens.chunks_mut(side.max(1)).zip(rings.opens_m_per_n.chunks(n.max(1))) {
            to[..n].copy_from_slice(from);
        }
        let zeros = || vec![0.0; side];
        Self {
            rings,
            opens,
            side,
            alphas: vec![f64::NAN; n],
            seats: vec![None; n],
            near: false,
            approach: vec![0.0; n],
            own_n: vec![0.0; n],
            roots: [vec![NO_ROOT; n], vec![NO_ROOT; n]],
            h: vec![0.0; n],
            normal: zeros(),
            slopes: zeros(),
            recede: zeros(),
            step: zeros(),
            between: zeros(),
            inverse: vec![0.0; side * side],
            order: (0..side).collect(),
            inverted: false,
            work: BendingWork::default(),
        }
    }

    /// Where sprags stand as `y` and `motions` have it. A sprag that waits or is open carries nothing.
    pub(super) fn stand(&mut self, groups: &[SpragGroup], motions: &[SpragMotion], y: &[f64]) {
        let mut moved = false;
        for (g, motion) in motions.iter().enumerate() {
            let seat = match motion.mode.place {
                Place::Arc(k) if !motion.waits => Some(k),
                _ => None,
            };
            moved |= self.place(g, y[HEAD + EACH * g], seat, &groups[g].model);
        }
        if moved {
            self.solve();
        }
    }

    /// Where group `g` stands; whether that is new.
    pub(super) fn place(&mut self, g: usize, alpha: f64, seat: Option<usize>, model: &Model) -> bool {
        if self.alphas[g].to_bits() == alpha.to_bits() && self.seats[g] == seat {
            return false;
        }
        let of = &self.rings.approaches[g];
        let k = seat.unwrap_or_else(|| model.curve.arc_at(alpha).min(of.by_alpha.len() - 1));
        self.near &= self.seats[g] == seat;
        (self.alphas[g], self.seats[g]) = (alpha, seat);
        let (d, root) = of.rooted(k, alpha, &mut self.roots[0][g]);
        self.approach[g] = d;
        // Beyond the end of its curve the root is asked for at that end.
        let known = |of: f64| root.filter(|_| of == d);
        self.own_n[g] =
            of.normal_by(d, |within| known(within).unwrap_or_else(|| within.powf(1.0 / of.exponent))).0;
        true
    }

    /// Newton's method for h; without a solution forces are no numbers.
    pub(super) fn solve(&mut self) {
        let n = self.h.len();
        self.work.solutions += 1;
        if self.near {
            // From what was solved last along the tangents there.
            self.miss();
            self.lead_on();
            self.h.iter_mut().zip(&self.step).for_each(|(h, step)| *h -= step);
        } else {
            for i in 0..n {
                self.h[i] = self.approach[i] - self.recede[i];
            }
        }
        let solved = self.newton() || self.come_near() && self.newton();
        self.near = solved;
        if solved {
            // Along the tangents of the last step, which leaves its square.
            for i in 0..n {
                self.normal[i] -= self.slopes[i] * self.step[i];
                self.recede[i] = self.approach[i] - self.h[i];
            }
        } else {
            self.inverted = false;
            self.alphas.fill(f64::NAN);
            self.normal[..n].fill(f64::NAN);
            self.recede.fill(0.0);
        }
    }

    /// `step` becomes what h misses.
    fn miss(&mut self) {
        let n = self.h.len();
        self.step[n..].fill(0.0);
        for i in 0..n {
            self.step[i] = self.h[i] - self.approach[i] + self.recede[i];
        }
    }

    /// Its steps, from h on; whether they come to an end.
    fn newton(&mut self) -> bool {
        let scale = self.scale();
        let mut last = f64::INFINITY;
        for _ in 0..MOST {
            self.forces();
            self.miss();
            if !self.inverted && !self.invert() {
                return false;
            }
            self.lead_on();
            let size = self.step.iter().fold(0.0_f64, |most, s| most.max(s.abs()));
            // A largest one knows no NaN, and once kept it would stay: a trial step may stand anywhere.
            if !self.step.iter().all(|step| step.is_finite()) {
                return false;
            }
            self.h.iter_mut().zip(&self.step).for_each(|(h, step)| *h -= step);
            // Steps shrink at least as the last ones did: what the next one would be.
            let next = if last.is_finite() { size * (size / last) } else { size };
            if next <= SOLVED * scale || size <= NEARLY * scale && size >= 0.5 * last {
                return true;
            }
            if size > last {
                // It has gone too far: half of it back.
                self.h.iter_mut().zip(&self.step).for_each(|(h, step)| *h += 0.5 * step);
            }
            self.inverted = size <= SLOW * last;
            last = size;
        }
        false
    }

    /// From afar: h along the tangents where it stands, each step halved until less is missed, up to where Newton's method does the rest.
    /// Whether it comes there: with one solution ([`Rings::has_one_solution`]) it does.
    fn come_near(&mut self) -> bool {
        self.h.copy_from_slice(&self.approach);
        self.forces();
        self.miss();
        let missed = |step: &[f64]| step.iter().map(|miss| miss * miss).sum::<f64>();
        let (mut left, near) = (missed(&self.step), NEAR * self.scale());
        for _ in 0..MOST {
            if left <= near * near {
                self.inverted = false;
                return true;
            }
            if !self.invert() {
                return false;
            }
            self.lead_on();
            let (from, step, mut part) = (self.h.clone(), self.step.clone(), 1.0);
            loop {
                self.h
                    .iter_mut()
                    .zip(from.iter().zip(&step))
                    .for_each(|(h, (from, step))| *h = from - part * step);
                self.forces();
                self.miss();
                let there = missed(&self.step);
                if there < left {
                    left = there;
                    break;
                }
                part *= 0.5;
                if part < LEAST_PART {
                    return false;
                }
            }
        }
        false
    }

    /// Approach at the end of the longest curve, m.
    fn scale(&self) -> f64 {
        self.rings.approaches.iter().map(|of| of.ends[of.ends.len() - 1]).fold(0.0, f64::max)
    }

    /// N, its slope and u at h.
    fn forces(&mut self) {
        self.work.passes += 1;
        for (j, seat) in self.seats.iter().enumerate() {
            let (of, last) = (&self.rings.approaches[j], &mut self.roots[1][j]);
            (self.normal[j], self.slopes[j]) = match seat {
                Some(_) => of.normal_by(self.h[j], |d| of.root(d, last)),
                None => (0.0, 0.0),
            };
        }
        // Its columns are its rows.
        multiply(&self.opens, &self.normal, &mut self.recede);
    }

    /// (I + M diag(N'))^-1 by columns, those of its transpose I + diag(N') M by rows: Gauss and Jordan's elimination, rows exchanged;
    /// false: singular.
    fn invert(&mut self) -> bool {
        self.work.inversions += 1;
        let (n, a) = (self.side, &mut self.inverse);
        for i in 0..n {
            for j in 0..n {
                a[i * n + j] = f64::from(u8::from(i == j)) + self.slopes[i] * self.opens[i * n + j];
            }
        }
        for k in 0..n {
            let mut best = k;
            for i in k + 1..n {
                if a[i * n + k].abs() > a[best * n + k].abs() {
                    best = i;
                }
            }
            let pivot = a[best * n + k];
            if pivot == 0.0 || !pivot.is_finite() {
                return false;
            }
            self.order[k] = best;
            if best != k {
                for j in 0..n {
                    a.swap(k * n + j, best * n + j);
                }
            }
            a[k * n + k] = 1.0;
            let row = &mut a[k * n..(k + 1) * n];
            row.iter_mut().for_each(|f| *f /= pivot);
            self.between.copy_from_slice(row);
            for (_, row) in a.chunks_exact_mut(n).enumerate().filter(|(i, _)| *i != k) {
                let part = std::mem::replace(&mut row[k], 0.0);
                row.iter_mut().zip(&self.between).for_each(|(f, of)| *f -= part * of);
            }
        }
        for k in (0..n).rev().filter(|&k| self.order[k] != k) {
            a.chunks_exact_mut(n).for_each(|row| row.swap(k, self.order[k]));
        }
        self.inverted = true;
        true
    }

    /// `step` from what h misses to what takes it away along the tangents there were.
    fn lead_on(&mut self) {
        self.work.products += 1;
        multiply(&self.inverse, &self.step, &mut self.between);
        std::mem::swap(&mut self.step, &mut self.between);
    }

    /// N_i - N_own of group `g`, N.
    pub(super) fn more_n(&self, g: usize) -> f64 {
        self.normal[g] - self.own_n[g]
    }

    /// How far group `g` is pressed, as an angle from first contact, rad; below 0: it does not touch.
    pub(super) fn pressed_rad(&self, g: usize) -> f64 {
        self.h[g] / self.rings.approaches[g].slopes[0]
    }

    /// alpha at which group `g` would touch, rad.
    pub(super) fn touch_rad(&self, g: usize) -> f64 {
        self.rings.approaches[g].alpha_at(self.recede[g])
    }

    /// What group `g` has stored beside its own curve, J.
    pub(super) fn beside_j(&self, g: usize) -> f64 {
        self.rings.approaches[g]
            .stored_j(self.approach[g], if self.seats[g].is_some() { self.h[g] } else { 0.0 })
    }

    /// What the races have stored beside the law of even sprags, J.
    pub(super) fn rings_j(&self) -> f64 {
        0.5 * self.normal.iter().zip(&self.recede).map(|(n, u)| n * u).sum::<f64>()
    }
}

impl SpragGroup {
    /// `point` of a sprag at `alpha` between races that bend, which press it by `more_n` (N) more than its own curve has there.
    ///
    /// Where contact is lost, and found, alpha is not that of first contact: the centrifugal potential and OC_g must be the same on both
    /// sides there, or energy jumps by F_c times what they differ by. Below first contact, where a curve's geometry is level, they are
    /// those of an open sprag; beyond, those of its arc, which an open one keeps. Standing still there is no such potential, and an open
    /// sprag has its own geometry everywhere.
    pub(super) fn between_bent(
        &self,
        place: Place,
        alpha: f64,
        mut point: WedgePoint,
        more_n: f64,
    ) -> WedgePoint {
        let (model, curve) = (&self.model, &self.model.curve);
        let speed = curve.speed_rad_s();
        // m_g OC_g OC_g' Omega^2 as a force along the track.
        let swings = |p: &WedgePoint, level: &WedgePoint| {
            model.mass_kg * p.oc_g * p.oc_g_slope * speed * speed / (level.oa * (level.rho_i + level.rho_e))
        };
        let below_rad = (curve.first_contact_rad() - alpha).max(0.0);
        if place == Place::Open {
            if speed != 0.0 && below_rad == 0.0 {
                let mut closed = curve.in_arc(curve.arc_at(alpha), alpha);
                closed.t_static += more_n * ratio(&closed);
                let stored = closed.t_static * closed.oa * (closed.rho_i + closed.rho_e);
                (point.oc_g, point.oc_g_slope) = (closed.oc_g, closed.oc_g_slope);
                point.t_static = stored / (point.oa * (point.rho_i + point.rho_e)) + swings(&closed, &point);
            }
            return point;
        }
        let level_n = point.t_static;
        point = pressed(point, more_n, below_rad);
        if below_rad > 0.0 {
            let open = curve.open(alpha);
            (point.oc_g, point.oc_g_slope) = (open.oc_g, open.oc_g_slope);
            if speed != 0.0 {
                point.t_static -= level_n + swings(&open, &point);
            }
        }
        point
    }
}

/// `point` of a sprag that is pressed by `more_n` (N) more than on its own curve, alpha `below_rad` below first contact.
pub(super) fn pressed(mut point: WedgePoint, more_n: f64, below_rad: f64) -> WedgePoint {
    point.t_static += more_n * ratio(&point);
    // Where contact is lost it is nothing but rounding.
    point.n_bi = (point.n_bi + more_n).max(0.0);
    point.windup -= (point.rho_i + point.rho_e) * below_rad;
    point
}

#[cfg(test)]
mod tests {
    use super::Bent;
    use crate::clutch::Sharing;
    use crate::design::Design;
    use crate::sprags::Many;
    use nalgebra::DMatrix;

    fn unlike() -> Many {
        let design =
            Design::parse(include_str!("../../../designs/huang2017-multi-arc.toml"), "m.toml").unwrap();
        let sharing = Sharing { seed: 1, size_within_m: 3e-6, ..Sharing::default() };
        Many::bending(design.scenario("low-6").unwrap(), &sharing).unwrap()
    }

    /// Each so far beyond its first contact, rad; what presses them, N.
    fn stand(many: &Many, bent: &mut Bent<'_>, beyond: &[f64]) -> Vec<f64> {
        for (g, (group, beyond)) in many.groups.iter().zip(beyond).enumerate() {
            let curve = &group.model.curve;
            let alpha = curve.first_contact_rad() + beyond;
            bent.place(g, alpha, Some(curve.arc_at(alpha).min(curve.arc_count() - 1)), &group.model);
        }
        bent.solve();
        bent.normal[..beyond.len()].to_vec()
    }

    /// Trial steps stand where there is nothing: what is sought after one is what it would have been without.
    #[test]
    fn a_place_without_a_solution_leaves_nothing_behind() {
        let many = unlike();
        let rings = many.rings.as_ref().unwrap();
        let stand = |bent: &mut Bent<'_>, alpha: f64| stand(&many, bent, &[alpha; 12]);
        let (mut once, mut again) = (Bent::new(rings), Bent::new(rings));
        let expected = stand(&mut once, 0.02);
        for nowhere in [f64::NAN, f64::INFINITY, 1e200, -1e200] {
            stand(&mut again, 0.01);
            stand(&mut again, nowhere);
            for (found, expected) in stand(&mut again, 0.02).iter().zip(&expected) {
                assert!((found / expected - 1.0).abs() < 1e-12, "{nowhere}: {found} {expected}");
            }
        }
        // From near by, along the tangents, as from nothing.
        stand(&mut again, 0.0199);
        for (found, expected) in stand(&mut again, 0.02).iter().zip(&expected) {
            assert!((found / expected - 1.0).abs() < 1e-12 && *expected > 100.0, "{found} {expected}");
        }
    }

    /// Races that would bend so that M N' comes to -0.98 where N is steepest: the inverse is one to rounding, and a place is found from anywhere,
    /// some of the sprags off.
    #[test]
    fn bends_at_the_brink_of_what_has_one_solution_are_solved() {
        let many = unlike();
        let mut rings = many.rings.clone().unwrap();
        assert!(rings.has_one_solution());
        let n = rings.approaches.len();
        let most = DMatrix::from_row_slice(n, n, &rings.opens_m_per_n).symmetric_eigenvalues().max();
        let steepest = rings.approaches.iter().map(|of| of.steepest()).fold(0.0, f64::max);
        rings.opens_m_per_n.iter_mut().for_each(|m| *m *= -0.98 / (most * steepest));
        assert!(rings.has_one_solution());
        let curve = &many.groups[0].model.curve;
        let whole = curve.arc_end_rad(curve.arc_count() - 1) - curve.first_contact_rad();
        let mut random = fastrand::Rng::with_seed(1);
        let mut off = 0;
        for _ in 0..200 {
            let mut bent = Bent::new(&rings);
            let size = random.f64();
            let beyond: Vec<f64> = (0..n).map(|_| size * whole * random.f64()).collect();
            let normal = stand(&many, &mut bent, &beyond);
            off += normal.iter().filter(|n| **n == 0.0).count();
            for i in 0..n {
                let recedes: f64 = (0..n).map(|j| rings.opens_m_per_n[i * n + j] * normal[j]).sum();
                let expected = rings.approaches[i].normal(bent.approach[i] - recedes).0;
                assert!((normal[i] - expected).abs() < 1e-9 * (expected + 1.0), "{} {expected}", normal[i]);
            }
            bent.slopes[..n].fill(steepest);
            assert!(bent.invert());
            let x: Vec<f64> = (0..bent.side).map(|_| random.f64()).collect();
            let (mut of, mut back) = (vec![0.0; bent.side], vec![0.0; bent.side]);
            super::multiply(&bent.opens, &x, &mut of);
            of.iter_mut().zip(&x).for_each(|(of, x)| *of = x + steepest * *of);
            super::multiply(&bent.inverse, &of, &mut back);
            assert!(back.iter().zip(&x).all(|(back, x)| (back - x).abs() < 1e-13 / 0.02), "{back:?} {x:?}");
        }
        assert!(off > 0);
        rings.opens_m_per_n.iter_mut().for_each(|m| *m *= 1.03);
        assert!(!rings.has_one_solution());
    }
}
