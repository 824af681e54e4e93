//! Where the axis of the inner race lies beside that of the outer, and may move: how far the races turn against one another for it
//! while a sprag keeps its normal force.
//!
//! On its own curve, that between concentric races, a sprag at N_bi has rolled by W(N). With the axis of the inner race at d against
//! that of the outer it bears the same N_bi where the races have turned by
//!
//!   W(N) + G_A(N, d) + G_B(N, d),      G_A = -(inner turn at d - at 0),  G_B = outer turn at d - at 0,
//!
//! the turns those of rigid bodies that end in the same places (`off_centre`): the strut keeps its length, so to first order
//! G = -d AB/(|AB| OA sin omega). alpha here stays what it is on the own curve at N: the coordinate of the normal force. G is all that
//! dynamics needs: the rolling constraints are those of the own curve with G_A and G_B added, and by virtual work the forces in these
//! constraints turn the sprag, the races and push the axes; energy is kept whatever G is, for it is a function of the place alone.
//!
//! G is tabled over alpha as a polynomial of the third degree in d as the sprag sees it: x along the line OG (as it lies at first
//! contact) outward, y across it in the positive sense. What that leaves out is measured ([`AxisTurns::error_rad`]): the fourth power,
//! and that a contact which d brings over a junction is taken to stay on its arc (Delta r times the square of the turn beyond, over 2).
//! Where an arc begins G is that at the end of the one before.

use super::closure::{FIRST_CONTACT_N, NoClosure, Statics};
use super::curve::WedgeCurve;
use super::table::levelled;
use crate::numeric::panels::Panels;
use crate::numeric::pieces::Pieces;
use crate::numeric::quadrature;
use nalgebra::{SMatrix, SVector};
use std::f64::consts::TAU;

/// Powers of x and y up to the third degree, without the constant.
const POWERS: [[i32; 2]; TERMS] = [[1, 0], [0, 1], [2, 0], [1, 1], [0, 2], [3, 0], [2, 1], [1, 2], [0, 3]];
const TERMS: usize = 9;
const LANES: usize = 2 * TERMS;
/// Coefficients, their slopes and the slopes of these.
const READ: usize = 3 * LANES;
/// Places of the axis that the polynomial is fitted to: eight at the reach, four halfway.
const PLACES: usize = 12;
/// Pieces of an arc over which rho_e is integrated.
const PIECES: u32 = 4;
/// Panels of the first arc in s, as fractions of its end.
const FIRST_BREAKS: [f64; 4] = [0.0, 0.3, 0.6, 1.0];

/// G_A or G_B at one place; derivatives by alpha, x and y.
#[derive(Debug, Clone, Copy, Default)]
pub struct AxisTurn {
    /// rad.
    pub value: f64,
    /// By alpha (pure number), x and y (rad/m).
    pub first: [f64; 3],
    /// Second ones, symmetric.
    pub second: [[f64; 3]; 3],
}

/// G of one curve.
#[derive(Debug, Clone)]
pub struct AxisTurns {
    arcs: Vec<Pieces<READ>>,
    alpha0: f64,
    exponent: f64,
    reach_m: f64,
    /// Largest difference of G to rigid rolling on the arcs that the contact is on, as far as the axis may lie off, rad.
    pub error_rad: f64,
}

/// Places of the axis as a part of the reach.
fn places() -> [[f64; 2]; PLACES] {
    std::array::from_fn(|i| {
        let (radius, angle) =
            if i < 8 { (1.0, TAU * i as f64 / 8.0) } else { (0.5, TAU * (i as f64 + 0.5) / 4.0) };
        [radius * angle.cos(), radius * angle.sin()]
    })
}

/// By `powf`: a `powi` is rounded once where the compiler knows its number and at each product where it does not, so that the last bit
/// hangs on what was inlined.
fn terms([x, y]: [f64; 2]) -> [f64; TERMS] {
    POWERS.map(|[a, b]| x.powf(f64::from(a)) * y.powf(f64::from(b)))
}

fn rotated([x, y]: [f64; 2], angle_rad: f64) -> [f64; 2] {
    let (s, c) = angle_rad.sin_cos();
    [x * c - y * s, x * s + y * c]
}

impl Statics {
    /// Turns of inner and outer race against the line OC_e at N_bi on arc `arc`, rad, and the turn of the contact, rad; the axis at
    /// `offset_m` (along that line, across) as it is, whatever has turned.
    fn turns_at(
        &mut self,
        arc: usize,
        n: f64,
        speed: f64,
        shift: f64,
        offset_m: [f64; 2],
    ) -> Result<[f64; 3], NoClosure> {
        (self.offset_m, self.offset_stays) = (offset_m, true);
        let c = self.closure(arc, n.max(FIRST_CONTACT_N), speed, shift)?;
        let turn = c.rotation - (c.beta - self.profile.beta0_rad);
        Ok([self.inner_turn(arc, c.rotation, turn).v, self.outer_turn(c.rotation).v, turn.v])
    }
}

impl AxisTurns {
    /// Of `curve`, the axis up to `reach_m` > 0 off.
    ///
    /// # Errors
    /// [`NoClosure`] where the sprag does not stand somewhere there: `RolledOver` where the gap is too narrow or too wide for it.
    pub fn new(curve: &WedgeCurve, reach_m: f64) -> Result<Self, NoClosure> {
        let places = places();
        let rows = SMatrix::<f64, PLACES, TERMS>::from_fn(|i, j| terms(places[i])[j]);
        let fit = rows.svd(true, true).pseudo_inverse(1e-12);
        let fit = fit.map_err(|_| NoClosure::NoConvergence { residual: 1.0 })?;
        let mut statics = curve.statics().clone();
        // A sprag of another size touches where G lies otherwise.
        let (speed, gamma0) = (curve.speed_rad_s(), curve.touch().gamma.v);
        let gamma_m = |alpha: f64, k: usize, place: [f64; 2]| {
            let gamma = curve.in_arc(k, alpha).gamma - gamma0;
            rotated(place.map(|part| part * reach_m), -gamma)
        };
        let mut at = |k: usize, alpha: f64| -> Result<[f64; LANES], NoClosure> {
            let (arc, n, shift) = (curve.first_arc() + k, curve.in_arc(k, alpha).n_bi, curve.shift_rad(k));
            let mut turns = |offset_m| statics.turns_at(arc, n, speed, shift, offset_m);
            let [inner, outer, _] = turns([0.0; 2])?;
            let mut values = [SVector::<f64, PLACES>::zeros(); 2];
            for (i, place) in places.iter().enumerate() {
                let there = turns(gamma_m(alpha, k, *place))?;
                (values[0][i], values[1][i]) = (inner - there[0], there[1] - outer);
            }
            let mut lanes = [0.0; LANES];
            for (lanes, values) in lanes.chunks_mut(TERMS).zip(&values) {
                lanes.copy_from_slice((fit * values).as_slice());
            }
            Ok(lanes)
        };
        let (alpha0, exponent) = (curve.first_contact_rad(), curve.exponent());
        let mut arcs: Vec<Pieces<READ>> = Vec::with_capacity(curve.arc_count());
        for k in 0..curve.arc_count() {
            let until = curve.arc_end_rad(k);
            let (breaks, more) = match arcs.last() {
                None => {
                    let end = (until - alpha0).powf(1.0 / exponent);
                    (FIRST_BREAKS.map(|part| part * end).to_vec(), [0.0; LANES])
                }
                Some(before) => {
                    let from = curve.arc_end_rad(k - 1);
                    let x = if k == 1 { (from - alpha0).powf(1.0 / exponent) } else { from };
                    let (end, begin) = (before.at(x), at(k, from)?);
                    let more = std::array::from_fn(|lane| end[lane] - begin[lane]);
                    (vec![from, 0.5 * (from + until), until], more)
                }
            };
            let panels: Panels<LANES> = Panels::build(&breaks, |x| {
                let alpha = if k == 0 { alpha0 + x.powf(exponent) } else { x };
                at(k, alpha).map(|lanes| std::array::from_fn(|lane| lanes[lane] + more[lane]))
            })?;
            let all: [usize; LANES] = std::array::from_fn(|lane| lane);
            let slopes = panels.derivative(all);
            arcs.push(Pieces::of(&panels, &slopes, &slopes.derivative(all)));
        }
        let mut found = Self { arcs, alpha0, exponent, reach_m, error_rad: 0.0 };
        let ends: Vec<f64> = statics.profile.arcs.iter().map(|arc| arc.until_rad).collect();
        for k in 0..curve.arc_count() {
            let from = if k == 0 { alpha0 } else { curve.arc_end_rad(k - 1) };
            for part in [0.25, 0.75] {
                let alpha = from + part * (curve.arc_end_rad(k) - from);
                let n = curve.in_arc(k, alpha).n_bi;
                for quarter in 0..8 {
                    let place = rotated([1.0, 0.0], TAU * (f64::from(quarter) + 0.5) / 8.0);
                    let seen = found.at(k, alpha, place.map(|part| part * reach_m));
                    let own = statics.turns_at(curve.first_arc() + k, n, speed, curve.shift_rad(k), [0.0; 2]);
                    let own = own.ok();
                    let there = (0..ends.len()).find_map(|arc| {
                        let turns = statics.turns_at(arc, n, speed, 0.0, gamma_m(alpha, k, place)).ok()?;
                        (arc + 1 == ends.len() || turns[2] < ends[arc]).then_some(turns)
                    });
                    let (Some(own), Some(there)) = (own, there) else { continue };
                    let exact = (there[1] - there[0]) - (own[1] - own[0]);
                    found.error_rad = found.error_rad.max((seen[0].value + seen[1].value - exact).abs());
                }
            }
        }
        Ok(found)
    }

    /// How far off the axis was looked at, m.
    pub fn reach_m(&self) -> f64 {
        self.reach_m
    }

    /// G_A and G_B at `alpha` (rad) with the functions of arc `k`, the axis of the inner race at `axis_m` as the sprag sees it: along
    /// OG and across, m. Below first contact they stay what they are there.
    pub fn at(&self, k: usize, alpha: f64, axis_m: [f64; 2]) -> [AxisTurn; 2] {
        self.read(k, alpha, None, axis_m)
    }

    /// The same of the first arc at `alpha` below `from`, rad, along the tangents there: of a sprag that is pressed below its first contact. A
    /// slope that ended where no event is, with the rolling that hangs on it, would make energy.
    pub fn straight_on(&self, from: f64, alpha: f64, axis_m: [f64; 2]) -> [AxisTurn; 2] {
        self.read(0, from, Some(alpha - from), axis_m)
    }

    fn read(&self, k: usize, alpha: f64, on_rad: Option<f64>, axis_m: [f64; 2]) -> [AxisTurn; 2] {
        let reach = self.reach_m;
        let [x, y] = axis_m.map(|m| m / reach);
        // The variable of the table, its slope by alpha and the slope of that.
        let (variable, rise, bend) = if k > 0 {
            (alpha, 1.0, 0.0)
        } else {
            let (x, level) = levelled((alpha - self.alpha0).max(0.0));
            let s = x.powf(1.0 / self.exponent);
            let rise = if alpha > self.alpha0 { level * s / (self.exponent * x) } else { 0.0 };
            (s, rise, rise * level * (1.0 / self.exponent - 1.0) / x)
        };
        let v = self.arcs[k].at(variable);
        // Powers of x and y with their derivatives.
        let (xs, ys) = ([1.0, x, x * x, x * x * x], [1.0, y, y * y, y * y * y]);
        let (dx, dy) = ([0.0, 1.0, 2.0 * x, 3.0 * x * x], [0.0, 1.0, 2.0 * y, 3.0 * y * y]);
        let (ddx, ddy) = ([0.0, 0.0, 2.0, 6.0 * x], [0.0, 0.0, 2.0, 6.0 * y]);
        std::array::from_fn(|contact| {
            let mut g = AxisTurn::default();
            for (i, [a, b]) in POWERS.iter().enumerate() {
                let (a, b) = (*a as usize, *b as usize);
                let lane = contact * TERMS + i;
                let (c, slope, curl) = (v[lane], v[LANES + lane], v[2 * LANES + lane]);
                let (by_alpha, mut twice) = (slope * rise, curl * rise * rise + slope * bend);
                let mut c = c;
                if let Some(on_rad) = on_rad {
                    (c, twice) = (c + by_alpha * on_rad, 0.0);
                }
                let by = [xs[a] * ys[b], dx[a] * ys[b] / reach, xs[a] * dy[b] / reach];
                g.value += c * by[0];
                g.first[0] += by_alpha * by[0];
                g.first[1] += c * by[1];
                g.first[2] += c * by[2];
                g.second[0][0] += twice * by[0];
                g.second[0][1] += by_alpha * by[1];
                g.second[0][2] += by_alpha * by[2];
                g.second[1][1] += c * ddx[a] * ys[b] / (reach * reach);
                g.second[1][2] += c * dx[a] * dy[b] / (reach * reach);
                g.second[2][2] += c * xs[a] * ddy[b] / (reach * reach);
            }
            g.second[1][0] = g.second[0][1];
            g.second[2][0] = g.second[0][2];
            g.second[2][1] = g.second[1][2];
            g
        })
    }
}

impl WedgeCurve {
    /// By how much the outer race has turned against the line OG since first contact at this speed, B rolling: the integral of rho_e, rad.
    pub fn outer_roll_rad(&self, alpha: f64) -> f64 {
        let q = self.exponent();
        let mut sum = 0.0;
        for k in 0..=self.arc_at(alpha) {
            let until = self.arc_end_rad(k).min(alpha);
            // The first arc by s, alpha = alpha_0 + s^q.
            let (from, until) = match k {
                0 => (0.0, (until - self.first_contact_rad()).max(0.0).powf(1.0 / q)),
                k => (self.arc_end_rad(k - 1), until),
            };
            let rate = |x: f64| match k {
                0 => self.in_arc(0, self.first_contact_rad() + x.powf(q)).rho_e * q * x.powf(q - 1.0),
                k => self.in_arc(k, x).rho_e,
            };
            let piece = (until - from) / f64::from(PIECES);
            sum += (0..PIECES)
                .map(|i| from + piece * f64::from(i))
                .map(|at| quadrature::integral(at, at + piece, rate))
                .sum::<f64>();
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::terms;
    use std::hint::black_box;

    /// A cube whose product is rounded twice to another number.
    #[test]
    fn powers_are_rounded_once_whatever_the_compiler_knows() {
        let y = 0.3535533905932739;
        assert_ne!(y * y * y, 0.04419417382415927);
        assert_eq!(terms([1.0, y])[8], 0.04419417382415927);
        assert_eq!(terms(black_box([1.0, y]))[8], 0.04419417382415927);
    }
}
