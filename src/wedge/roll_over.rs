//! Beyond the end of the curve: the sprag goes on over its highest place, and the torque falls.
//!
//! In: a curve and where the sprag's surfaces end. Out: [`RollOver`]: the falling branch, with the torque at its peak and what
//! remains. Absent: friction (a contact that needs more than there is slips first), a material that yields.
//!
//! Each place of the sprag asks for one approach of its contacts, so one force: N over the turn of the body is a function where N over the
//! torque is none. The contact rolls on over what is left of the arcs, then pivots over the edge at their end, an arc without a radius,
//! which is taken to give as the arc before it. With law `elastic` the torque steps up where A comes upon its edge, by 3.8 % for
//! huang2017-elastic: rolling on towards a flank brings up what the body gives more there (`bulk.rs`), pivoting does not. T is dU/dW
//! on both sides.
//!
//! Without a step it would be, and lower, with a patch that ends where the body does. Its half width a is 0.36 mm there, and from d = a
//! on, d the way that the contact point has left, it hangs over. Of two half-planes, the pressure of one of which ends at the edge, the
//! patch is then 2 L long, 3 L^2 - 2 d L = a^2, pressed by
//!
//!   p(u) ~ ((L + u)/(L - u))^(1/2) (2 L - d - u),   -L < u < L from its middle,
//!
//! whose resultant lies 2 m^2/(L + 2 m), m = L - d, behind the contact point: nothing at d = a, smoothly more from there, 0.385 a = 0.14 mm
//! with the contact point on the edge. The step is one of 0.02 mm. So about the edge the torque is too high here by up to some 30 %, its
//! peak with it, whatever the law. Not taken in: a corner gives more than a half-plane, C (`bulk.rs`) means little there, and steel
//! yields under the 6.7 GPa that are there without the edge. The curve ends 0.4 mm before it.
//!
//! While beta > 0 N rises; it is largest where A, B and the axis lie on one line, the sprag stands upright and has no torque. From there
//! on beta < 0: the sprag drives the races on and N falls, until contact is lost or a flank lies on its race. Without loss what was
//! stored comes back: int C dW from first contact to the loss
//! of contact is 0, to parts in a thousand with (6), which takes N_bi for both halves of the body.

use super::closure::{Closure, FIRST_CONTACT_N, Statics};
use super::curve::{EndReason, WedgeCurve};
use super::table::{ArcTable, LANES, Layout, lanes_of, later_windup};
use crate::numeric::dual::Dual;
use crate::numeric::golden::top;
use crate::numeric::panels::Panels;
use crate::numeric::{pieces::Pieces, quadrature, root};
use crate::profile::Brink;
use std::f64::consts::{PI, TAU};

named! {
    /// How the way over the highest place ends.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum OverEnd {
        /// The sprag is shorter than the gap again.
        ContactLost = "contact-lost",
        /// A flank lies on its race.
        OnFlank = "on-flank",
        /// No equilibrium was found.
        NoConvergence = "no-convergence",
    }
    /// Name for reports and JSON.
    pub fn name;
}

/// A place on the way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OverPoint {
    /// alpha, rad.
    pub alpha_rad: f64,
    /// Windup, rad.
    pub windup_rad: f64,
    /// Torque of equilibrium, N m; below 0 the sprags drive the races on.
    pub torque_nm: f64,
    /// N_bi, N.
    pub normal_inner_n: f64,
    /// |T_bi|/N_bi.
    pub tan_omega: f64,
    /// Energy stored in all contacts, races and sprags, J.
    pub stored_j: f64,
}

/// What comes after the end of a curve.
#[derive(Debug, Clone)]
pub struct RollOver {
    /// Where the torque is largest.
    pub peak: OverPoint,
    /// Where the sprags stand upright: no torque, the largest force. `None`: the way ends before.
    pub upright: Option<OverPoint>,
    /// Where the torque is least: below 0, as much turned the other way brings the sprags back.
    pub least: OverPoint,
    /// Where the way ends.
    pub last: OverPoint,
    /// Why it ends there.
    pub end: OverEnd,
    /// The way from the end of the curve on, both ends included.
    pub branch: Vec<OverPoint>,
    /// The curve with this after its end, for a run that goes on: places beyond its arcs.
    pub(crate) curve: WedgeCurve,
}

/// Ratio of a force to the next where the end of a piece is looked for.
const STRIDE: f64 = 1.03;
/// Strides at most: from rounding to any force.
const MOST: usize = 4000;
/// Part of the largest force below which contact counts as lost.
const LOST: f64 = 1e-6;
/// How far below the largest force pieces end, as a part of it: slopes by N are infinite there.
const SHY: f64 = 1e-13;
/// beta below which a place without equilibrium beyond it is the highest, rad.
const UPRIGHT_RAD: f64 = 1e-4;
/// Points of the branch on each piece.
const POINTS: usize = 24;
/// Breaks of a piece; the last ones for the end at which contact is lost, as N ~ x^1.1.
const BREAKS: [f64; 9] = [0.0, 0.25, 0.5, 0.75, 0.9, 0.97, 0.99, 0.998, 1.0];

/// What follows a piece.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Then {
    NextArc,
    OuterEdge,
    Upright,
    End(OverEnd),
}

/// Where the contacts are: inside on arc `k` or on the edge after the last, outside on the arc or on its edge.
#[derive(Debug, Clone, Copy)]
struct Seat {
    k: usize,
    /// Whether the contact outside has come to the edge.
    outer_edge: bool,
    /// Whether beta < 0.
    past: bool,
    /// Constant shift of the body angle that keeps alpha where one seat hands over to the next: rounding, and whole turns.
    shift: f64,
}

/// A way with the contacts on the same surfaces, beta of one sign.
struct Piece {
    seat: Seat,
    /// N, alpha.
    from: [f64; 2],
    to: [f64; 2],
    then: Then,
}

/// Before and past the highest place.
type Sides = [Statics; 2];

/// The statics of every piece.
struct Way {
    /// On the arcs, the last as long as the outline has it, and with the edge after it; then the same on the edge outside.
    seats: [[Sides; 2]; 2],
    speed: f64,
    /// Rotation of the body at which the outer arc ends, and at which the sprag has pivoted over its edge, rad.
    outer_rad: [f64; 2],
}

impl Way {
    fn new(curve: &WedgeCurve, brink: Option<&Brink>) -> Self {
        let mut arcs = curve.statics.clone();
        arcs.near_upright = true;
        if let (Some(last), Some(brink)) = (arcs.profile.arcs.last_mut(), brink) {
            last.until_rad = brink.edge_turn_rad.max(last.until_rad);
        }
        // A sprag of no known flanks is an edge for half a turn.
        let flat = brink.map_or(arcs.profile.end_turn_rad() + PI, |b| b.flank_turn_rad);
        let edge = arcs.clone().with_edge(flat);
        let sides = |of: &Statics| {
            let mut past = of.clone();
            past.past = true;
            [of.clone(), past]
        };
        let outside = |of: &Statics| match brink {
            Some(brink) => sides(&of.clone().on_outer_edge(brink.outer_edge_m)),
            None => sides(of),
        };
        let outer_rad = brink.map_or([PI, PI], |b| {
            let edge = -b.rear_azimuth_rad;
            [edge, edge + (-b.rear_flank_azimuth_rad - edge).rem_euclid(TAU)]
        });
        let seats = [[sides(&arcs), sides(&edge)], [outside(&arcs), outside(&edge)]];
        Self { seats, speed: curve.speed_rad_s, outer_rad }
    }

    fn edge_at(&self) -> usize {
        self.seats[0][0][0].profile.arcs.len()
    }

    fn closure(&self, seat: &Seat, n: f64) -> Option<Closure> {
        let on_edge = usize::from(seat.k >= self.edge_at());
        let statics = &self.seats[usize::from(seat.outer_edge)][on_edge][usize::from(seat.past)];
        statics.closure(seat.k, n, self.speed, seat.shift).ok()
    }

    /// `seat` with the shift that makes it carry N at alpha, `from`.
    fn seated(&self, seat: Seat, [n, alpha]: [f64; 2]) -> Option<Seat> {
        let raw = self.closure(&seat, n)?;
        Some(Seat { shift: seat.shift + (alpha - raw.alpha.v), ..seat })
    }

    /// `seat` at `from` with the body fixed as it gives there: near the highest place the turn, and with it what an
    /// outline gives, goes with the root of the force, which no equilibrium at a given force follows.
    fn with_fixed_body(&mut self, seat: Seat, from: [f64; 2]) -> Option<Seat> {
        let turn = self.closure(&seat, from[0])?.turn_rad(self.seats[0][0][0].profile.beta0_rad);
        let rolled_m = self.seats[0][1][0].rolled_m(seat.k, Dual::constant(turn)).v;
        for statics in self.seats.iter_mut().flatten().flatten() {
            if statics.fixed_roll_m.replace(rolled_m).is_some() {
                return None;
            }
        }
        self.seated(seat, from)
    }

    /// Turn inside and rotation outside that are left, rad.
    fn left(&self, seat: &Seat, c: &Closure) -> [f64; 2] {
        let profile = &self.seats[0][1][0].profile;
        let turn = profile.arcs[seat.k].until_rad - c.turn_rad(profile.beta0_rad);
        [turn, self.outer_rad[usize::from(seat.outer_edge)] - c.rotation.v]
    }

    /// From `from` (N, alpha) to where `seat` ends.
    fn piece(&self, seat: Seat, from: [f64; 2]) -> Option<Piece> {
        let at = |n: f64| self.closure(&seat, n);
        let left = |n: f64| {
            at(n).map_or(f64::NAN, |c| self.left(&seat, &c).into_iter().fold(f64::INFINITY, f64::min))
        };
        let ratio = if seat.past { 1.0 / STRIDE } else { STRIDE };
        let (mut a, mut b) = (from[0], from[0] * ratio);
        let mut found = None;
        for _ in 0..MOST {
            let left_b = left(b);
            if left_b.is_nan() || left_b <= 0.0 || seat.past && b <= LOST * from[0] {
                found = Some(left_b);
                break;
            }
            (a, b) = (b, b * ratio);
        }
        let mut left_b = found?;
        let mut then = Then::End(OverEnd::ContactLost);
        if left_b.is_nan() {
            if seat.past {
                return None;
            }
            // The largest force: no closure beyond it.
            loop {
                let middle = 0.5 * (a + b);
                if middle <= a || middle >= b {
                    break;
                }
                if at(middle).is_some() { a = middle } else { b = middle }
            }
            (a, b) = (from[0], a * (1.0 - SHY));
            if at(b).is_none_or(|c| c.beta.v > UPRIGHT_RAD) {
                return None;
            }
            left_b = left(b);
            then = Then::Upright;
        }
        if left_b <= 0.0 {
            b = root::bracketed(a, b, left(a), left_b, 1e-14 * a, left)?;
            let [turn, rotation] = self.left(&seat, &at(b)?);
            then = match (turn <= rotation, seat.k == self.edge_at(), seat.outer_edge) {
                (true, false, _) => Then::NextArc,
                (false, _, false) => Then::OuterEdge,
                _ => Then::End(OverEnd::OnFlank),
            };
        }
        let to = [b, at(b)?.alpha.v];
        (to[1] > from[1]).then_some(Piece { seat, from, to, then })
    }

    /// The piece over alpha, its windup from `windup_from` on.
    fn table(&self, piece: &Piece, windup_from: f64) -> Option<ArcTable> {
        let Piece { seat, from: [n_from, alpha_from], to: [n_to, alpha_to], .. } = piece;
        let breaks = BREAKS.map(|b| alpha_from + (alpha_to - alpha_from) * b);
        let layout = Layout::new(&breaks, &[]);
        let lanes: Panels<LANES> = layout
            .panels(|alpha| {
                let miss = |n: f64| self.closure(seat, n).map_or(f64::NAN, |c| c.alpha.v - alpha);
                let (at_from, at_to) = (miss(*n_from), miss(*n_to));
                let n = match (at_from >= 0.0, at_to <= 0.0) {
                    (true, _) => *n_from,
                    (_, true) => *n_to,
                    _ => root::bracketed(*n_from, *n_to, at_from, at_to, 1e-15 * n_from, miss).ok_or(())?,
                };
                self.closure(seat, n).map(|c| lanes_of(&c, n)).ok_or(())
            })
            .ok()?;
        let windup = later_windup(&lanes, &layout, windup_from);
        let table = Pieces::of(&lanes, &lanes.derivative([2, 3]), &windup);
        let end = self.closure(seat, *n_to)?;
        Some(ArcTable {
            alpha_until: *alpha_to,
            n_from: *n_from,
            n_until: *n_to,
            turn_until_rad: end.turn_rad(self.seats[0][0][0].profile.beta0_rad),
            torque_until_nm: end.torque_nm(self.seats[0][0][0].count).v,
            shift: seat.shift,
            edges: Vec::new(),
            cuts: 0,
            lanes,
            table,
        })
    }
}

impl RollOver {
    /// The curve with this after its end, for a run that goes on.
    pub fn followed_curve(&self) -> &WedgeCurve {
        &self.curve
    }

    /// The place at `windup_rad` beyond the end of the curve, without what is stored there; `None` before it and beyond the last.
    pub fn at_windup(&self, windup_rad: f64) -> Option<OverPoint> {
        let curve = &self.curve;
        let mut from = curve.arc_end_rad(curve.arcs.len().checked_sub(1)?);
        for (i, table) in curve.over.iter().enumerate() {
            let place = curve.arcs.len() + i;
            let miss = |alpha: f64| curve.in_arc(place, alpha).windup - windup_rad;
            let (low, high) = (miss(from), miss(table.alpha_until));
            if low <= 0.0 && high >= 0.0 {
                let alpha = root::bracketed(from, table.alpha_until, low, high, 1e-16, miss)?;
                return Some(curve.over_point(place, alpha, 0.0));
            }
            from = table.alpha_until;
        }
        None
    }
}

impl WedgeCurve {
    /// What comes after the end of this curve, the sprag's surfaces ending at `brink`; without one the edge lies where the profile of the
    /// file ends, and there is no flank. `None` where no equilibrium is found there, and between races whose axes do not meet.
    pub fn beyond(&self, brink: Option<&Brink>) -> Option<RollOver> {
        let mut curve = match self.end {
            EndReason::NotBuilt => Self::march(self.statics.clone(), self.speed_rad_s, None, None).ok()?,
            _ => self.clone(),
        };
        if curve.end == EndReason::NoConvergence || !curve.statics.is_concentric() {
            return None;
        }
        let mut way = Way::new(&curve, brink);
        let last = curve.arcs.last()?;
        let k = curve.first + curve.arcs.len() - 1;
        let mut seat = Seat { k, outer_edge: false, past: false, shift: last.shift };
        let mut from = [last.n_until, last.alpha_until];
        let [turn, _] = way.left(&seat, &way.closure(&seat, from[0])?);
        if turn <= 1e-12 {
            seat = way.seated(Seat { k: k + 1, shift: 0.0, ..seat }, from)?;
        }
        let (mut windup, mut stored_j) = (curve.windup_rad(from[1]), curve.stored_at_end_j()?);
        let (mut branch, mut begins, mut upright) = (Vec::new(), Vec::new(), None);
        let end = loop {
            let Some(piece) = way.piece(seat, from).or_else(|| {
                seat = way.with_fixed_body(seat, from)?;
                way.piece(seat, from)
            }) else {
                break OverEnd::NoConvergence;
            };
            let Some(table) = way.table(&piece, windup) else {
                break OverEnd::NoConvergence;
            };
            curve.over.push(table);
            begins.push(from[1]);
            let place = curve.place_count() - 1;
            let at = |i: usize| from[1] + (piece.to[1] - from[1]) * i as f64 / POINTS as f64;
            for i in usize::from(!branch.is_empty())..=POINTS {
                if i > 0 {
                    stored_j += curve.work_j(place, at(i - 1), at(i));
                }
                branch.push(curve.over_point(place, at(i), stored_j));
            }
            (from, windup) = (piece.to, curve.in_arc(place, piece.to[1]).windup);
            let next = match piece.then {
                Then::NextArc => Seat { k: seat.k + 1, shift: 0.0, ..seat },
                Then::OuterEdge => Seat { outer_edge: true, shift: 0.0, ..seat },
                Then::Upright => {
                    upright = branch.last().copied();
                    Seat { past: true, ..seat }
                }
                Then::End(end) => break end,
            };
            match way.seated(next, from) {
                Some(next) => seat = next,
                None => break OverEnd::NoConvergence,
            }
        };
        let last = *branch.last()?;
        let by = |a: &&OverPoint, b: &&OverPoint| a.torque_nm.total_cmp(&b.torque_nm);
        let peak = curve.sharpened(*branch.iter().max_by(by)?, &begins, 1.0);
        let least = curve.sharpened(*branch.iter().min_by(by)?, &begins, -1.0);
        Some(RollOver { peak, upright, least, last, end, branch, curve })
    }

    /// Energy stored at the end of the arcs, J: int C dW.
    fn stored_at_end_j(&self) -> Option<f64> {
        const PARTS: u32 = 4;
        let mut sum = 0.0;
        for (k, arc) in self.arcs.iter().enumerate() {
            // dW/dN ~ N^-0.1 at first contact, analytic in z = N^0.1.
            let power = if k == 0 { 10 } else { 1 };
            let span = arc.n_until - arc.n_from;
            let mut found = true;
            for i in 0..PARTS {
                let [a, b] = [i, i + 1].map(|i| f64::from(i) / f64::from(PARTS));
                sum += quadrature::integral(a, b, |z| {
                    let c = self.closure_in(k, (arc.n_from + span * z.powi(power)).max(FIRST_CONTACT_N));
                    found &= c.is_some();
                    let slope = f64::from(power) * span * z.powi(power - 1);
                    c.map_or(0.0, |c| c.torque_nm(self.statics.count).v * c.windup_slope() * slope)
                });
            }
            found.then_some(())?;
        }
        Some(sum)
    }

    /// int C dW from one alpha to another at `place` after the end, J.
    fn work_j(&self, place: usize, from: f64, to: f64) -> f64 {
        quadrature::integral(from, to, |alpha| {
            let p = self.in_arc(place, alpha);
            self.statics.count as f64 * p.t_static * p.oa * (p.rho_i + p.rho_e)
        })
    }

    fn over_point(&self, place: usize, alpha_rad: f64, stored_j: f64) -> OverPoint {
        let p = self.in_arc(place, alpha_rad);
        // Where contact is lost the table is 0 to its own error.
        let normal_inner_n = p.n_bi.max(f64::MIN_POSITIVE);
        OverPoint {
            alpha_rad,
            windup_rad: p.windup,
            torque_nm: self.statics.count as f64 * p.t_static * p.oa,
            normal_inner_n,
            tan_omega: (p.t_static / normal_inner_n).abs().min(1.0),
            stored_j,
        }
    }

    /// The extreme (`sign` 1: largest, -1: least) of the torque beside `coarse`, by golden sections of the piece in
    /// which that lies; the pieces begin at `begins` (alpha).
    fn sharpened(&self, coarse: OverPoint, begins: &[f64], sign: f64) -> OverPoint {
        let mut best = coarse;
        for (i, &begin) in begins.iter().enumerate() {
            let (place, until) = (self.arcs.len() + i, self.over[i].alpha_until);
            if !(begin..=until).contains(&coarse.alpha_rad) {
                continue;
            }
            let step = (until - begin) / POINTS as f64;
            let (a, b) = ((coarse.alpha_rad - step).max(begin), (coarse.alpha_rad + step).min(until));
            let alpha = top(a, b, |alpha| sign * self.over_point(place, alpha, 0.0).torque_nm);
            let stored_j = coarse.stored_j + self.work_j(place, coarse.alpha_rad, alpha);
            let found = self.over_point(place, alpha, stored_j);
            if sign * found.torque_nm > sign * best.torque_nm {
                best = found;
            }
        }
        best
    }
}
