//! What the equations of [`super::stick`] hold, as functions of the windup w, on short pieces that are made where a run comes by.
//!
//! Later arcs are cut into [`EQUAL`] equal pieces. On the first N ~ w^(10/9) and rho ~ w^(1/9) are singular at w = 0: there pieces
//! are eighths of an octave of w over its end, so that the singularity lies 17 to 31 of their half lengths away and degree 6
//! leaves out 1e-11. Below the last octave one piece reaches to w = 0, where forces are 1e-4 of those at the end of the arc and it
//! leaves out parts in a thousand of them. The tension below first contact ([`WedgeCurve::mirrored`]) is cut like the first arc.

use super::model::Model;
use crate::numeric::pieces::Basis;
#[cfg(doc)]
use crate::wedge::WedgeCurve;
use crate::wedge::WedgePoint;
use std::sync::LazyLock;

/// Degree of a piece, in the forces.
const DEGREE: usize = 6;
const POINTS: usize = DEGREE + 1;
/// Degree in what varies by parts in a hundred over an arc, or weighs by such parts: masses of the sprags, lever arms. A
/// cubic leaves out 1e-6 of that.
const GENTLE: usize = 3;
/// Pieces of a later arc.
const EQUAL: usize = 24;
/// Octaves of the first arc.
const OCTAVES: usize = 12;
/// log2 of the pieces of an octave.
const CUTS: u32 = 3;

/// What a piece holds, the slopes of the masses apart.
const LANES: usize = 12;
/// Exponent and leading bits of the mantissa of 2^-[`OCTAVES`].
const LOWEST: u64 = (1.0_f64.to_bits() >> (52 - CUTS)) - ((OCTAVES as u64) << CUTS);

static BASIS: LazyLock<Basis<POINTS>> = LazyLock::new(Basis::new);

/// Masses of the sprags in rolling, kg m^2, F, N m, and slopes by w.
#[derive(Debug, Clone, Copy)]
pub(super) struct Motion {
    pub(super) f: f64,
    pub(super) a: f64,
    pub(super) b: f64,
    pub(super) d: f64,
    pub(super) a_slope: f64,
    pub(super) b_slope: f64,
    pub(super) d_slope: f64,
}

/// What the forces at the contacts follow from.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contacts {
    /// N_bi, N.
    pub(super) n_bi: f64,
    /// 1/(n_s OA), 1/m.
    pub(super) per_oa: f64,
    /// 1/(n_s OB), 1/m.
    pub(super) per_ob: f64,
    /// Pure number.
    pub(super) sigma: f64,
    /// N_be = this + its rises by n_s T_bi OA, by -n_s T_be OB and by (Omega + phi')^2; N, 1/m, 1/m, kg m.
    pub(super) outer: f64,
    pub(super) outer_by_inner: f64,
    pub(super) outer_by_outer: f64,
    pub(super) centrifugal: f64,
}

/// One piece, in powers of v: `forces[k]` of F, N_bi and [`Contacts::outer`], `masses[k]` of A, B, D and their slopes by w,
/// `arms[k]` of the other lanes of [`Contacts`].
#[derive(Debug, Clone)]
pub(super) struct Piece {
    /// v = (w - middle) scale lies in [-1, 1].
    middle: f64,
    scale: f64,
    f: [f64; POINTS],
    forces: [[f64; 2]; POINTS],
    masses: [[f64; 6]; GENTLE + 1],
    arms: [[f64; 6]; GENTLE + 1],
}

/// Where nothing has been made.
const NONE: u32 = u32::MAX;

pub(super) struct Table<'a> {
    model: &'a Model,
    /// Every piece made, in the order in which runs came by.
    made: Vec<Piece>,
    /// Which of them is piece i of arc k: `places[k][i]`, or [`NONE`]; tension comes after the last arc.
    places: Vec<Vec<u32>>,
    arc: usize,
    /// Ends of the present arc.
    from: f64,
    until: f64,
    /// One over the way between them, 1/rad.
    per_length: f64,
    /// Whether that is the first arc or the tension below it.
    about_first_contact: bool,
}

impl<'a> Table<'a> {
    /// On arc `arc` of the curve of `model`.
    pub(super) fn new(model: &'a Model, arc: usize) -> Self {
        let arcs = model.curve.arc_count();
        let pieces = |k: usize| if k == 0 || k == arcs { (OCTAVES << CUTS) + 1 } else { EQUAL };
        let mut table = Self {
            model,
            made: Vec::new(),
            places: (0..=arcs).map(|k| vec![NONE; pieces(k)]).collect(),
            arc,
            from: 0.0,
            until: 0.0,
            per_length: 0.0,
            about_first_contact: false,
        };
        table.enter(arc);
        table
    }

    fn tension(&self) -> usize {
        self.places.len() - 1
    }

    /// The present arc; their number in tension.
    pub(super) fn arc(&self) -> usize {
        self.arc
    }

    /// On to arc `arc`, as [`Self::arc`] counts.
    pub(super) fn enter(&mut self, arc: usize) {
        let curve = &self.model.curve;
        let until = |k: usize| curve.in_arc(k, curve.arc_end_rad(k)).windup;
        self.arc = arc;
        let tension = arc == self.tension();
        self.from = match arc {
            0 => 0.0,
            _ if tension => -until(0),
            _ => until(arc - 1),
        };
        self.until = if tension { 0.0 } else { until(arc) };
        self.per_length = 1.0 / (self.until - self.from);
        self.about_first_contact = arc == 0 || tension;
    }

    /// Over the upper or lower end of the present arc; false where there is nothing.
    pub(super) fn pass(&mut self, up: bool) -> bool {
        let (arc, tension) = (self.arc, self.tension());
        let next = match up {
            true if arc == tension => Some(0),
            true => Some(arc + 1).filter(|next| *next < tension),
            false if arc == tension => None,
            false => Some(arc.checked_sub(1).unwrap_or(tension)),
        };
        if let Some(next) = next {
            self.enter(next);
        }
        next.is_some()
    }

    /// Whether the end of the present arc that is next to `w` (rad) is first contact.
    pub(super) fn is_first_contact(&self, w: f64) -> bool {
        self.about_first_contact && w.abs() < 0.5 * (self.until - self.from)
    }

    /// Whether `w` (rad) lies below the last octave of the first arc.
    pub(super) fn is_at_first_contact(&self, w: f64) -> bool {
        self.about_first_contact && w < self.until / f64::from(1 << OCTAVES)
    }

    /// Windup where the present arc begins and ends, rad.
    pub(super) fn ends(&self) -> [f64; 2] {
        [self.from, self.until]
    }

    /// When w reaches an end of its arc as its rate and acceleration `rate` (rad/s^2) have it, s.
    pub(super) fn junction_ahead_s(&self, y: &[f64; 4], rate: f64) -> f64 {
        let when = |end: f64| when(end - y[0], y[2], rate);
        when(self.from).min(when(self.until))
    }

    /// When w reaches first contact as they have it, s.
    pub(super) fn first_contact_ahead_s(&self, y: &[f64; 4], rate: f64) -> f64 {
        if self.about_first_contact { when(-y[0], y[2], rate) } else { f64::INFINITY }
    }

    #[inline(always)]
    pub(super) fn motion(&mut self, w: f64) -> Motion {
        self.piece(w).motion(w)
    }

    /// The piece of the present arc that holds `w`; the first and the last go on beyond its ends, but for first contact, beyond
    /// which lies tension.
    #[inline(always)]
    pub(super) fn piece(&mut self, w: f64) -> &Piece {
        let (arc, index) = if self.about_first_contact {
            // Exponent and leading bits of the mantissa count the pieces.
            let place = ((w * self.per_length).abs().to_bits() >> (52 - CUTS)) as i64;
            let index = (place - LOWEST as i64 + 1).clamp(0, (OCTAVES as i64) << CUTS) as usize;
            (if w < 0.0 { self.tension() } else { 0 }, index)
        } else {
            let share = (w - self.from) * self.per_length;
            // No number and negative ones become 0.
            (self.arc, ((share * EQUAL as f64) as i32).clamp(0, EQUAL as i32 - 1) as usize)
        };
        let place = self.places[arc][index];
        let place = if place == NONE { self.make(arc, index) } else { place };
        &self.made[place as usize]
    }

    #[cold]
    #[inline(never)]
    fn make(&mut self, arc: usize, index: usize) -> u32 {
        let length = self.until - self.from;
        let tension = arc == self.tension();
        let [from, until] = if self.about_first_contact {
            let end = |i: usize| match i.checked_sub(1) {
                Some(i) => length * f64::from_bits((LOWEST + i as u64) << (52 - CUTS)),
                None => 0.0,
            };
            if tension { [-end(index + 1), -end(index)] } else { [end(index), end(index + 1)] }
        } else {
            [index, index + 1].map(|i| self.from + length * i as f64 / EQUAL as f64)
        };
        let (middle, scale) = (0.5 * (from + until), 2.0 / (until - from));
        let basis = &*BASIS;
        let mut lanes = [[0.0; LANES]; POINTS];
        // Newton along the nodes: dW = (rho_i + rho_e) d alpha.
        let curve = &self.model.curve;
        let at = |alpha: f64| if tension { curve.mirrored(alpha) } else { curve.in_arc(arc, alpha) };
        let first_rad = curve.first_contact_rad();
        let [alpha_from, alpha_until] = match arc {
            _ if tension => [first_rad, 2.0 * first_rad - curve.arc_end_rad(0)],
            0 => [first_rad, curve.arc_end_rad(0)],
            _ => [curve.arc_end_rad(arc - 1), curve.arc_end_rad(arc)],
        };
        let gone = if self.about_first_contact { middle.abs() } else { middle - self.from };
        let mut alpha = alpha_from + (alpha_until - alpha_from) * gone / length;
        let mut p = at(alpha);
        for (j, node) in basis.nodes.iter().enumerate() {
            let w = middle + node / scale;
            for _ in 0..20 {
                let rho = p.rho_i + p.rho_e;
                let straight = (w - p.windup) / rho;
                // To the second order: rho' bends the way there.
                let step = straight - 0.5 * (p.rho_i_slope + p.rho_e_slope) / rho * straight * straight;
                alpha += step;
                p = at(alpha);
                if step.abs() < 1e-5 * (alpha - alpha_from).abs() {
                    break;
                }
            }
            // What is left is of the order of the third power of the last step.
            lanes[j] = self.model.in_stick(&p, alpha);
        }
        let powers = basis.powers(&lanes);
        let cubic = gentle(&lanes);
        let mut masses = [[0.0; 6]; GENTLE + 1];
        let mut arms = [[0.0; 6]; GENTLE + 1];
        for k in 0..=GENTLE {
            masses[k][..3].copy_from_slice(&cubic[k][..3]);
            arms[k].copy_from_slice(&cubic[k][3..]);
            for lane in 0..3 {
                if k > 0 {
                    masses[k - 1][lane + 3] = k as f64 * scale * cubic[k][lane];
                }
            }
        }
        let place = self.made.len() as u32;
        self.made.push(Piece {
            middle,
            scale,
            f: powers.map(|row| row[0]),
            forces: powers.map(|row| [row[1], row[2]]),
            masses,
            arms,
        });
        self.places[arc][index] = place;
        place
    }
}

/// Cubics through the lanes from the fourth on, in powers of v, by least squares at the nodes: the first terms of their
/// Chebyshev series.
fn gentle(lanes: &[[f64; LANES]; POINTS]) -> [[f64; LANES - 3]; GENTLE + 1] {
    let nodes = &BASIS.nodes;
    let mut series = [[0.0; LANES - 3]; GENTLE + 1];
    for (row, v) in lanes.iter().zip(nodes) {
        let chebyshev = [1.0, *v, 2.0 * v * v - 1.0, (4.0 * v * v - 3.0) * v];
        for (k, t) in chebyshev.into_iter().enumerate() {
            let weight = if k == 0 { 1.0 } else { 2.0 } / POINTS as f64 * t;
            for (sum, value) in series[k].iter_mut().zip(&row[3..]) {
                *sum += weight * value;
            }
        }
    }
    let [c0, c1, c2, c3] = series;
    let of = |f: &dyn Fn(usize) -> f64| std::array::from_fn(f);
    [of(&|i| c0[i] - c2[i]), of(&|i| c1[i] - 3.0 * c3[i]), of(&|i| 2.0 * c2[i]), of(&|i| 4.0 * c3[i])]
}

/// When gap = u t + rate t^2/2, first root beyond 0, s.
fn when(gap: f64, u: f64, rate: f64) -> f64 {
    let inside = u * u + 2.0 * rate * gap;
    if inside < 0.0 {
        return f64::INFINITY;
    }
    let part = u + inside.sqrt().copysign(u);
    let both = [2.0 * gap / part, -part / rate];
    both.into_iter().filter(|t| *t > 1e-9).fold(f64::INFINITY, f64::min)
}

#[inline(always)]
fn horner<const M: usize, const D: usize>(powers: &[[f64; M]; D], v: f64) -> [f64; M] {
    let mut sum = powers[D - 1];
    for row in powers[..D - 1].iter().rev() {
        for lane in 0..M {
            sum[lane] = sum[lane] * v + row[lane];
        }
    }
    sum
}

impl Piece {
    #[inline(always)]
    pub(super) fn motion(&self, w: f64) -> Motion {
        let v = (w - self.middle) * self.scale;
        let f = self.f[..DEGREE].iter().rev().fold(self.f[DEGREE], |sum, c| sum * v + c);
        let [a, b, d, a_slope, b_slope, d_slope] = horner(&self.masses, v);
        Motion { f, a, b, d, a_slope, b_slope, d_slope }
    }

    #[inline(always)]
    pub(super) fn contacts(&self, w: f64) -> Contacts {
        let ([n_bi, outer], arms) = self.pressed((w - self.middle) * self.scale);
        let [per_oa, per_ob, sigma, outer_by_inner, outer_by_outer, centrifugal] = arms;
        Contacts { n_bi, per_oa, per_ob, sigma, outer, outer_by_inner, outer_by_outer, centrifugal }
    }

    /// Not inlined: lanes that go to memory together are summed two by two.
    #[inline(never)]
    fn pressed(&self, v: f64) -> ([f64; 2], [f64; 6]) {
        (horner(&self.forces, v), horner(&self.arms, v))
    }
}

impl Model {
    /// F, N_bi, [`Contacts::outer`]; A, B, D; the other lanes of [`Contacts`], at the point `p` of the curve at `alpha` (rad).
    fn in_stick(&self, p: &WedgePoint, alpha: f64) -> [f64; LANES] {
        let n = self.count;
        let kappa = 1.0 / (p.rho_i + p.rho_e);
        let sigma = p.rho_e * kappa;
        let orbit = self.mass_kg * p.oc_g * p.oc_g;
        let turn = kappa - sigma;
        let spring = self.spring_nm_per_rad * (self.alpha_max_rad - alpha);
        let f = n * (p.t_static * p.oa - kappa * spring);
        let a = n * (self.inertia_kg_m2 * turn * turn + orbit * sigma * sigma);
        let b = n * (self.inertia_kg_m2 * turn - orbit * sigma);
        let d = n * (self.inertia_kg_m2 + orbit);
        let (sin_bg, cos_bg) = p.beta_gamma.sin_cos();
        let (sin_g, cos_g) = p.gamma.sin_cos();
        let (per_oa, per_ob) = (1.0 / (n * p.oa), 1.0 / (n * p.ob));
        [
            f,
            p.n_bi,
            p.n_bi * cos_bg / cos_g,
            a,
            b,
            d,
            per_oa,
            per_ob,
            sigma,
            sin_bg / cos_g * per_oa,
            sin_g / cos_g * per_ob,
            self.mass_kg * p.oc_g / cos_g,
        ]
    }
}
