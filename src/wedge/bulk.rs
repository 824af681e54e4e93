//! What the body of a sprag gives beyond the disc that law `elastic` takes it for.
//!
//! In: outline, places of both contacts. Out: compliance along the strut beyond the disc's, and its slopes along both
//! profiles. Absent: local contact, which is the same on disc and sprag. Equations: none of the paper's; nothing is fitted.
//!
//! # Body
//! A plane body under unit forces e at A and -e at B along the strut (Muskhelishvili, *Some basic problems*, 32 and 80):
//!
//!   2 mu (u + iv) = kappa phi - z conj(phi') - conj(psi),   phi + z conj(phi') + conj(psi) = f on the outline,
//!
//! where f is constant along each free side and steps by i e at the contacts. A force e at z_0 of a straight side gives
//!
//!   phi = -e/(2 pi) ln(z - z_0),   psi = conj(e)/(2 pi) ln(z - z_0) + e conj(z_0)/(2 pi (z - z_0))
//!
//! (Flamant). What flanks and curved sides change is regular: phi and psi as polynomials about the middle, their
//! coefficients by least squares of f on points that crowd towards the corners. The compliance C is the approach of A
//! and B along e, without what each force does at its own place, less the same of the disc whose diameter is the height:
//! [(kappa + 1) ln 2 - kappa]/pi. Ten terms have it to 0.01, some 0.03 % of windup (test
//! `more_terms_and_points_change_little`).
//!
//! # Where the force lies
//! Along a profile C has a slope, dC/ds = 2 du/ds with the strut kept in its direction (reciprocity), so the surface
//! under a patch leans and the force lies R N/2 dC/ds behind the contact point, R the effective radius: away from a flank
//! that comes near. That is what makes the work of the moment on the turn of the sprag that of the stored energy.
//!
//! # Left out
//! What a corner within a patch's width does to the pressure; plane strain around a patch, where C is 1 - nu^2 as large.

use nalgebra::{Complex, DMatrix, DVector};
use std::cell::RefCell;
use std::f64::consts::PI;
use std::sync::Arc;

use crate::clutch::{Clutch, ContactLaw, StressState};
use crate::material::PlaneState;
use crate::numeric::dual::Dual;
use crate::profile::{Flanks, Outline, Profile, ProfileArc, Segment};

type Point = Complex<f64>;

/// Terms of phi and of psi, points on each of the four sides, places along the profile: choices.
const TERMS: usize = 10;
const POINTS: usize = 20;
const PLACES: usize = 6;
/// How far before first contact the places begin, in parts of the profile: contacts of sprags that stand apart.
const BEFORE: f64 = 0.05;

/// Where the range is held, in parts of its half: a choice.
const HELD: f64 = 1.02;

/// C, dC/ds at A and dC/ds at B in the sense of engagement, for one sprag of its length.
#[derive(Debug, Clone)]
pub(super) struct Bulk {
    /// Middle and half of the range of s, the way rolled on the inner profile, m.
    middle_m: f64,
    half_m: f64,
    /// Polynomials in u = (s - middle)/half, lowest power first.
    powers: [[f64; PLACES]; 3],
}

/// C in m/N, its slopes in 1/N; derivatives by N_bi.
pub(super) struct BulkAt {
    pub(super) along_m_per_n: Dual,
    pub(super) slopes_per_n: [Dual; 2],
}

/// Of the sprags of `clutch`; `None` for a law that takes no disc, and where no flanks close the outline.
pub(super) fn of(clutch: &Clutch, profile: &Profile) -> Option<Arc<Bulk>> {
    let ContactLaw::Elastic { state } = clutch.contact else { return None };
    let flanks = clutch.sprags.flanks?;
    let plane = match state {
        StressState::PlaneStrain => PlaneState::Strain,
        StressState::Layer | StressState::PlaneStress => PlaneState::Stress,
    };
    let (sprag, races) = (clutch.materials.sprag, &clutch.races);
    let poisson = sprag.poisson_ratio;
    let shear_m_per_n = (1.0 + poisson) / (sprag.youngs_modulus_pa * clutch.sprags.length_m);
    let height_m = races.outer_radius_m - races.inner_radius_m;
    let key = (profile.clone(), flanks, [plane.kolosov(poisson), height_m, shear_m_per_n]);
    LAST.with_borrow_mut(|last| match last {
        Some((known, bulk)) if *known == key => bulk.clone(),
        _ => {
            let (profile, flanks, [kappa, height_m, shear_m_per_n]) = &key;
            let outline = Outline::closed(profile, flanks).ok();
            let bulk = outline.and_then(|o| Bulk::new(profile, &o, *height_m, *kappa, *shear_m_per_n));
            let bulk = bulk.map(Arc::new);
            *last = Some((key, bulk.clone()));
            bulk
        }
    })
}

type Key = (Profile, Flanks, [f64; 3]);

thread_local! {
    /// That of the last clutch of this thread: its curves at several speeds share one.
    static LAST: RefCell<Option<(Key, Option<Arc<Bulk>>)>> = const { RefCell::new(None) };
}

impl Bulk {
    /// For a sprag of height `height_m` whose material has Kolosov's `kappa` and the compliance 1/(2 mu l),
    /// `shear_m_per_n`; `None` where its sides are not those of a sprag.
    pub(super) fn new(
        profile: &Profile,
        outline: &Outline,
        height_m: f64,
        kappa: f64,
        shear_m_per_n: f64,
    ) -> Option<Self> {
        let body = Body::new(profile, outline, 0.5 * height_m, (TERMS, POINTS))?;
        let end_m: f64 = profile.arcs.iter().map(length_m).sum();
        let (middle_m, half_m) = (0.5 * (1.0 - BEFORE) * end_m, 0.5 * (1.0 + BEFORE) * end_m);
        // Chebyshev's points, then powers: few enough to keep their digits.
        let at = |i: usize| (PI * (i as f64 + 0.5) / PLACES as f64).cos();
        let vandermonde = DMatrix::from_fn(PLACES, PLACES, |i, k| at(i).powi(k as i32));
        let mut values = DMatrix::zeros(PLACES, 3);
        for i in 0..PLACES {
            let of = body.give(middle_m + half_m * at(i), kappa)?;
            of.iter().enumerate().for_each(|(k, v)| values[(i, k)] = v * shear_m_per_n);
        }
        let powers = vandermonde.lu().solve(&values)?;
        let powers = [0, 1, 2].map(|k| std::array::from_fn(|i| powers[(i, k)]));
        powers.iter().flatten().all(|p: &f64| p.is_finite()).then_some(Self { middle_m, half_m, powers })
    }

    /// With the contact at A after `rolled_m` of the inner profile; held a little beyond the ends of the range, which the end of a curve must not see.
    pub(super) fn at(&self, rolled_m: Dual) -> BulkAt {
        let u = (rolled_m - self.middle_m) * self.half_m.recip();
        let u = if u.v.abs() <= HELD { u } else { Dual::constant(u.v.clamp(-HELD, HELD)) };
        let [along_m_per_n, a, b] = self.powers.map(|powers| {
            let (mut v, mut slope) = (0.0, 0.0);
            for p in powers.iter().rev() {
                slope = slope * u.v + v;
                v = v * u.v + p;
            }
            u.chain(v, slope)
        });
        BulkAt { along_m_per_n, slopes_per_n: [a, b] }
    }
}

fn length_m(arc: &ProfileArc) -> f64 {
    arc.radius_m * (arc.until_rad - arc.from_rad)
}

/// Which side a point of the outline lies on, and where: turn of the inner contact, azimuth of the outer one, rad.
#[derive(Clone, Copy)]
enum Side {
    Inner(f64),
    Front,
    Outer(f64),
    Rear,
}

/// An outline made ready for any places of the contacts. Lengths in `unit_m` from the middle.
struct Body<'a> {
    profile: &'a Profile,
    middle_m: Point,
    unit_m: f64,
    terms: usize,
    points: Vec<(Point, Side)>,
    /// Q and R of the conditions at the points.
    conditions: nalgebra::linalg::QR<f64, nalgebra::Dyn, nalgebra::Dyn>,
}

impl<'a> Body<'a> {
    fn new(
        profile: &'a Profile,
        outline: &Outline,
        unit_m: f64,
        (terms, count): (usize, usize),
    ) -> Option<Self> {
        let (inner, sides) = outline.segments().split_at_checked(profile.arcs.len())?;
        let [Segment::Line { from_m: f0, to_m: f1 }, outer, Segment::Line { from_m: r0, to_m: r1 }] = sides
        else {
            return None;
        };
        let ends = |segment: &Segment| match *segment {
            Segment::Arc { from_azimuth_rad: from, sweep_rad, .. } => Some([from, from + sweep_rad]),
            Segment::Line { .. } => None,
        };
        let (low, high) = (ends(inner.first()?)?[0], ends(inner.last()?)?[1]);
        let [front, rear] = ends(outer)?;
        let turn = |azimuth: f64| profile.beta0_rad + PI - azimuth;
        let mut points = Vec::with_capacity(4 * count);
        for i in 0..count {
            let part = 0.5 - 0.5 * (PI * (i as f64 + 0.5) / count as f64).cos();
            let between = |a: f64, b: f64| a + part * (b - a);
            let line = |a: &nalgebra::Vector2<f64>, b: &nalgebra::Vector2<f64>| {
                Point::new(between(a.x, b.x), between(a.y, b.y))
            };
            let (at, azimuth) = (between(turn(low), turn(high)), between(front, rear));
            points.push((inner_at(profile, at), Side::Inner(at)));
            points.push((line(f0, f1), Side::Front));
            points.push((outer_at(profile, azimuth), Side::Outer(azimuth)));
            points.push((line(r0, r1), Side::Rear));
        }
        let middle_m = points.iter().map(|p| p.0).sum::<Point>() / points.len() as f64;
        points.iter_mut().for_each(|p| p.0 = (p.0 - middle_m) / unit_m);
        let mut conditions = DMatrix::zeros(2 * points.len(), 4 * terms + 1);
        for (i, (z, _)) in points.iter().enumerate() {
            let mut column = 0;
            on_outline(*z, terms, |f| {
                (conditions[(2 * i, column)], conditions[(2 * i + 1, column)]) = (f.re, f.im);
                column += 1;
            });
        }
        Some(Self { profile, middle_m, unit_m, terms, points, conditions: conditions.qr() })
    }

    /// C and its slopes per metre with the contact at A after `rolled_m`, in 1/(2 mu l).
    fn give(&self, rolled_m: f64, kappa: f64) -> Option<[f64; 3]> {
        let turn = turn_after(self.profile, rolled_m);
        let azimuth = self.profile.outer_contact_azimuth(turn);
        let a = (inner_at(self.profile, turn) - self.middle_m) / self.unit_m;
        let b = (outer_at(self.profile, azimuth) - self.middle_m) / self.unit_m;
        let length = (b - a).norm();
        let e = (b - a) / length;
        let step = Point::i() * e;
        let mut wanted = DVector::zeros(2 * self.points.len());
        for (i, &(z, side)) in self.points.iter().enumerate() {
            let ahead = match side {
                Side::Inner(at) => at > turn,
                Side::Front => true,
                Side::Outer(at) => at > azimuth,
                Side::Rear => false,
            };
            let whole = if ahead { step } else { Point::default() };
            let f = whole - flamant(z - a, e, -1.0) - flamant(z - b, -e, -1.0);
            (wanted[2 * i], wanted[2 * i + 1]) = (f.re, f.im);
        }
        self.conditions.q_tr_mul(&mut wanted);
        let unknowns = 4 * self.terms + 1;
        let terms = self.conditions.r().solve_upper_triangular(&wanted.rows(0, unknowns))?;
        // What the other force and the free sides do at a place.
        let moved = |z: Point, other: Point, force: Point| {
            let mut column = 0;
            let mut sum = flamant(z - other, force, kappa);
            displacements(z, self.terms, kappa, |u| {
                sum += u * terms[column];
                column += 1;
            });
            sum
        };
        let apart = (moved(a, b, -e) - moved(b, a, e)) * e.conj();
        // The strut keeps its direction: what A and B do across it is a turn of the whole.
        let slope = |way: Point, z: Point, other: Point, force: Point| {
            const STEP: f64 = 1e-4;
            let rise =
                (moved(z + way * STEP, other, force) - moved(z - way * STEP, other, force)) / (2.0 * STEP);
            (rise * e.conj()).re - (way * e.conj()).im * apart.im / length
        };
        let along = self.profile.contact_direction(turn);
        let way_a = Point::new(-along.y, along.x);
        let way_b = Point::new(-azimuth.cos(), azimuth.sin());
        let disc = ((kappa + 1.0) * 2f64.ln() - kappa) / PI;
        Some([
            apart.re - disc,
            2.0 * slope(way_a, a, b, -e) / self.unit_m,
            -2.0 * slope(way_b, b, a, e) / self.unit_m,
        ])
    }
}

/// kappa phi - z conj(phi') - conj(psi) of a force `e` at distance `d`, the cut outwards; -f with kappa = -1.
fn flamant(d: Point, e: Point, kappa: f64) -> Point {
    // A point at the force itself has a side of its own all the same.
    let d = if d.norm_sqr() > 1e-18 { d } else { e * 1e-9 };
    let log = (d / e).ln();
    let whole = -e * (log * kappa + log.conj()) + e.conj() * d / d.conj();
    let displacement = whole / (2.0 * PI);
    if kappa == -1.0 { -displacement } else { displacement }
}

/// phi + z conj(phi') + conj(psi) of every term.
fn on_outline(z: Point, terms: usize, mut add: impl FnMut(Point)) {
    displacements(z, terms, -1.0, |u| add(-u));
    add(Point::new(1.0, 0.0));
    add(Point::i());
}

/// kappa phi - z conj(phi') - conj(psi) of every term: z, z^n and i z^n in phi without a turn of the whole, then in psi.
fn displacements(z: Point, terms: usize, kappa: f64, mut add: impl FnMut(Point)) {
    add(z * (kappa - 1.0));
    let mut below = z;
    for n in 2..=terms {
        let power = below * z;
        let (phi, rest) = (power * kappa, z * below.conj() * n as f64);
        add(phi - rest);
        add((phi + rest) * Point::i());
        below = power;
    }
    let mut power = Point::new(1.0, 0.0);
    for _ in 1..=terms {
        power *= z;
        add(-power.conj());
        add(power.conj() * Point::i());
    }
}

fn turn_after(profile: &Profile, rolled_m: f64) -> f64 {
    let mut left = rolled_m;
    let last = profile.arcs.len() - 1;
    for (k, arc) in profile.arcs.iter().enumerate() {
        if left <= length_m(arc) || k == last {
            return arc.from_rad + left / arc.radius_m;
        }
        left -= length_m(arc);
    }
    0.0
}

fn inner_at(profile: &Profile, turn: f64) -> Point {
    let last = profile.arcs.len() - 1;
    let arc = &profile.arcs[profile.arcs.iter().position(|a| turn <= a.until_rad).unwrap_or(last)];
    let at = arc.centre_m + arc.radius_m * profile.contact_direction(turn);
    Point::new(at.x, at.y)
}

fn outer_at(profile: &Profile, azimuth: f64) -> Point {
    Point::new(azimuth.sin(), azimuth.cos()) * profile.outer_radius_m
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::Design;

    const KAPPA: f64 = 2.7 / 1.3;

    fn single() -> (Profile, Outline, f64) {
        let text = include_str!("../../designs/huang2017-single-arc.toml");
        let clutch = Design::parse(text, "single").unwrap().clutch;
        let profile = clutch.profile().unwrap();
        let outline = Outline::closed(&profile, &clutch.sprags.flanks.unwrap()).unwrap();
        (profile, outline, clutch.races.outer_radius_m - clutch.races.inner_radius_m)
    }

    #[test]
    fn more_terms_and_points_change_little() {
        let (profile, outline, height_m) = single();
        let of = |sizes| Body::new(&profile, &outline, 0.5 * height_m, sizes).unwrap();
        let (law, fine) = (of((TERMS, POINTS)), of((24, 120)));
        for rolled_m in [0.0, 0.5e-3, 1e-3] {
            let [a, b] = [&law, &fine].map(|body| body.give(rolled_m, KAPPA).unwrap());
            println!("{rolled_m}: {a:?} {b:?}");
            assert!((a[0] - b[0]).abs() < 0.01, "{a:?} {b:?}");
            // By the height: a lean of 0.05 is 0.03 % of tan omega at 2 GPa.
            assert!((1..3).all(|k| (a[k] - b[k]).abs() * height_m < 0.25), "{a:?} {b:?}");
        }
        // Flanks cut at 5 of 8.3 mm raise the bracket of each half by 0.04 in a finite-element solution of the outline:
        // 4 x 0.04/pi of 1/(2 mu l) (1 + nu).
        let [cut, ..] = fine.give(0.0, KAPPA).unwrap();
        assert!((0.04..0.06).contains(&cut), "{cut}");
    }

    #[test]
    fn the_slopes_are_those_of_the_compliance() {
        let (profile, outline, height_m) = single();
        let body = Body::new(&profile, &outline, 0.5 * height_m, (24, 120)).unwrap();
        // Along the path both contacts move: dC/ds of the whole.
        let (at, step) = (0.6e-3, 2e-5);
        let give = |s: f64| body.give(s, KAPPA).unwrap();
        let azimuth = |s: f64| profile.outer_contact_azimuth(turn_after(&profile, s));
        let outer_way = (azimuth(at - step) - azimuth(at + step)) * profile.outer_radius_m / (2.0 * step);
        let slope = (give(at + step)[0] - give(at - step)[0]) / (2.0 * step);
        let [_, a, b] = give(at);
        println!("{slope} {a} {b} {outer_way}");
        assert!((a + b * outer_way - slope).abs() * height_m < 0.05, "{} {slope}", a + b * outer_way);
    }
}
