//! What the body of a sprag gives beyond the disc that law `elastic` takes it for.
//!
//! In: outline, places of both contacts. Out: compliance C(s) along the strut beyond the disc's, s the way rolled on the inner
//! profile, and dC/ds. Absent: local contact, which is the same on disc and sprag. Equations: none of the paper's; nothing is
//! fitted.
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
//! coefficients by least squares of f on points that crowd towards the corners. C is the approach of A
//! and B along e, without what each force does at its own place, less the same of the disc whose diameter is the height:
//! [(kappa + 1) ln 2 - kappa]/pi. Finite elements of the outline have it to 0.005 of 1/(2 mu l)
//! (`tests/reference/outline_give.py`), where the contacts of one sprag give 8.
//!
//! # One energy
//! C is made at a few places along the profile and is a polynomial in s from there on: a function of the state, so n^2 C(s)/2
//! with n = N_bi is an energy, and all that follows from it is consistent whatever C is: the body gives n C, and while the
//! sprag rolls on by ds the energy at held n rises by n^2 C' ds/2, which the forces bring up. As surfaces of radii r_i and R_i turn by ds/R against each other,
//! 1/R = 1/r_i + 1/R_i, the force lies R n C'/2 behind the contact point: away from a flank that comes near. R is
//! that of the curvature averaged over the patch, so nothing jumps at a junction. B rolls
//! with A: how the moment is parted between them changes N_be by 1e-5 and no torque; all of it is taken at A.
//!
//! # Left out
//! What a corner within a patch's width does to the pressure; plane strain around a patch, where C is 1 - nu^2 as large;
//! the part of n C along the tracks, tan^2 omega of it. The polynomial is off by 0.003 up to 0.85 of the profile and by 0.25 at its end,
//! where the patch hangs over the last arc and the law means little.

use nalgebra::{Cholesky, Complex, DMatrix, DVector, Dyn, SMatrix, SVector};
use std::cell::RefCell;
use std::f64::consts::PI;
use std::sync::Arc;

use crate::clutch::{Clutch, ContactLaw, StressState};
use crate::material::PlaneState;
use crate::numeric::dual::Dual;
use crate::profile::{Flanks, Outline, Profile, ProfileArc, Segment};

type Point = Complex<f64>;

/// Terms of phi and of psi, points on each of the four sides, places along the profile: choices.
const TERMS: usize = 12;
const POINTS: usize = 24;
const PLACES: usize = 5;
/// Where the places begin and end, in parts of the profile: beyond, patches hang over its end.
const RANGE: [f64; 2] = [0.0, 0.85];
/// Up to where C is followed, in halves of that range from its middle: a choice, so that the end of a curve does not see it. C goes
/// straight on from there.
const FOLLOWED: f64 = 1.4;
/// What is added to the diagonal of the normal equations, in parts of its largest: terms that the points cannot tell apart.
const TOLD_APART: f64 = 1e-13;

/// C over the way rolled, of sprags of one length.
#[derive(Debug, Clone)]
pub(super) struct Bulk {
    /// Middle and half of the range of s, the way rolled on the inner profile, m.
    middle_m: f64,
    half_m: f64,
    /// C in m/N as a polynomial in u = (s - middle)/half, lowest power first.
    powers_m_per_n: [f64; PLACES],
}

/// C in m/N, dC/ds in 1/N; derivatives by N_bi.
pub(super) struct BulkAt {
    pub(super) give_m_per_n: Dual,
    pub(super) slope_per_n: Dual,
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
        let [from_m, until_m] = RANGE.map(|part| part * end_m);
        let (middle_m, half_m) = (0.5 * (from_m + until_m), 0.5 * (until_m - from_m));
        // Chebyshev's points, then powers: few enough to keep their digits.
        let at = |i: usize| (PI * (i as f64 + 0.5) / PLACES as f64).cos();
        let vandermonde = SMatrix::<f64, PLACES, PLACES>::from_fn(|i, k| at(i).powi(k as i32));
        let mut values = SVector::<f64, PLACES>::zeros();
        for i in 0..PLACES {
            values[i] = body.give(middle_m + half_m * at(i), kappa)? * shear_m_per_n;
        }
        let powers = vandermonde.lu().solve(&values)?;
        let powers_m_per_n = std::array::from_fn(|i| powers[i]);
        powers_m_per_n.iter().all(|p: &f64| p.is_finite()).then_some(Self {
            middle_m,
            half_m,
            powers_m_per_n,
        })
    }

    /// With the contact at A after `rolled_m` of the inner profile.
    pub(super) fn at(&self, rolled_m: Dual) -> BulkAt {
        let u = (rolled_m.v - self.middle_m) / self.half_m;
        let held = u.clamp(-FOLLOWED, FOLLOWED);
        let [mut value, mut slope, mut bend] = [0.0; 3];
        for p in self.powers_m_per_n.iter().rev() {
            bend = bend * held + 2.0 * slope;
            slope = slope * held + value;
            value = value * held + p;
        }
        if u != held {
            (value, bend) = (value + slope * (u - held), 0.0);
        }
        let (slope, bend) = (slope / self.half_m, bend / (self.half_m * self.half_m));
        BulkAt { give_m_per_n: rolled_m.chain(value, slope), slope_per_n: rolled_m.chain(slope, bend) }
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
    /// The conditions at the points, and their normal equations.
    conditions: DMatrix<f64>,
    normal: Cholesky<f64, Dyn>,
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
        let mut normal = conditions.transpose() * &conditions;
        let least = TOLD_APART * normal.diagonal().max();
        (0..normal.nrows()).for_each(|i| normal[(i, i)] += least);
        let normal = Cholesky::new(normal)?;
        Some(Self { profile, middle_m, unit_m, terms, points, conditions, normal })
    }

    /// C with the contact at A after `rolled_m`, in 1/(2 mu l).
    fn give(&self, rolled_m: f64, kappa: f64) -> Option<f64> {
        let pressed = self.pressed(rolled_m);
        let Pressed { at: [a, b], e, .. } = pressed;
        // What the other force and the free sides do at a place.
        let moved = |z: Point, other: Point, force: Point| {
            self.regular(&pressed, z, kappa) + flamant(z - other, force, kappa)
        };
        let apart = (moved(a, b, -e) - moved(b, a, e)) * e.conj();
        let disc = ((kappa + 1.0) * 2f64.ln() - kappa) / PI;
        Some(apart.re - disc).filter(|c| c.is_finite())
    }

    /// Unit forces along the strut, the contact at A after `rolled_m`.
    fn pressed(&self, rolled_m: f64) -> Pressed {
        let turn = turn_after(self.profile, rolled_m);
        let azimuth = self.profile.outer_contact_azimuth(turn);
        let a = (inner_at(self.profile, turn) - self.middle_m) / self.unit_m;
        let b = (outer_at(self.profile, azimuth) - self.middle_m) / self.unit_m;
        let e = (b - a) / (b - a).norm();
        let mut wanted = DVector::zeros(2 * self.points.len());
        for (i, &(z, side)) in self.points.iter().enumerate() {
            let ahead = match side {
                Side::Inner(at) => at > turn,
                Side::Front => true,
                Side::Outer(at) => at > azimuth,
                Side::Rear => false,
            };
            let whole = if ahead { Point::i() * e } else { Point::default() };
            let f = whole - flamant(z - a, e, -1.0) - flamant(z - b, -e, -1.0);
            (wanted[2 * i], wanted[2 * i + 1]) = (f.re, f.im);
        }
        Pressed { at: [a, b], e, terms: self.normal.solve(&self.conditions.tr_mul(&wanted)) }
    }

    /// 2 mu (u + iv) at `z` of what flanks and curved sides change.
    fn regular(&self, pressed: &Pressed, z: Point, kappa: f64) -> Point {
        let mut column = 0;
        let mut sum = Point::default();
        displacements(z, self.terms, kappa, |u| {
            sum += u * pressed.terms[column];
            column += 1;
        });
        sum
    }
}

/// A body under unit forces e at A, -e at B.
struct Pressed {
    at: [Point; 2],
    e: Point,
    /// Coefficients of the regular terms.
    terms: DVector<f64>,
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

    fn of(text: &str) -> (Profile, Outline, f64) {
        let clutch = Design::parse(text, "x").unwrap().clutch;
        let profile = clutch.profile().unwrap();
        let outline = Outline::closed(&profile, &clutch.sprags.flanks.unwrap()).unwrap();
        (profile, outline, clutch.races.outer_radius_m - clutch.races.inner_radius_m)
    }

    fn single() -> (Profile, Outline, f64) {
        of(include_str!("../../designs/huang2017-single-arc.toml"))
    }

    /// Literature of its own: nine-node finite elements of the outline, which know nothing of Muskhelishvili.
    #[test]
    fn finite_elements_of_the_outline_give_as_much() {
        let table = include_str!("../../tests/reference/outline_give.csv");
        let narrow = of(include_str!("../../tests/reference/narrow_sprags.toml"));
        for (name, (profile, outline, height_m)) in [("single arc", single()), ("narrow sprags", narrow)] {
            let bulk = Bulk::new(&profile, &outline, height_m, KAPPA, 1.0).unwrap();
            let end_m: f64 = profile.arcs.iter().map(length_m).sum();
            let rows: Vec<[f64; 2]> = table
                .lines()
                .filter_map(|l| l.strip_prefix(name))
                .map(|l| {
                    let cells: Vec<f64> = l.split(',').skip(1).map(|c| c.parse().unwrap()).collect();
                    [cells[0], cells[1]]
                })
                .collect();
            assert_eq!(rows.len(), 5);
            for [share, want] in rows {
                let got = bulk.at(Dual::variable(share * end_m)).give_m_per_n.v;
                println!("{name} at {share}: {got:.4}, finite elements {want}");
                // Beyond the places the polynomial goes on.
                let within = if share < RANGE[1] { 0.01 } else { 0.15 };
                assert!((got - want).abs() < within, "{name} {share}: {got} {want}");
            }
        }
    }

    /// A sprag of two arcs about one centre, nearly a whole circle, is the disc.
    #[test]
    fn a_disc_gives_nothing_beyond_the_disc() {
        let (radius, height) = (4.169e-3, 8.33e-3);
        let profile = Profile::new(radius, 0.05e-3, &[(radius, 0.3)], 11.11e-3, 11.11e-3 + height).unwrap();
        let outline = Outline::new(&profile, 0.99 * radius, 0.99 * radius).unwrap();
        let body = Body::new(&profile, &outline, 0.5 * height, (TERMS, POINTS)).unwrap();
        for rolled_m in [0.0, 0.2 * radius] {
            let c = body.give(rolled_m, KAPPA).unwrap();
            println!("{c}");
            assert!(c.abs() < 0.01, "{c}");
        }
    }

    #[test]
    fn more_terms_and_points_change_little() {
        let (profile, outline, height_m) = single();
        let of = |sizes| Body::new(&profile, &outline, 0.5 * height_m, sizes).unwrap();
        let (law, fine) = (of((TERMS, POINTS)), of((24, 120)));
        for rolled_m in [0.0, 0.5e-3, 1e-3, 1.5e-3] {
            let [a, b] = [&law, &fine].map(|body| body.give(rolled_m, KAPPA).unwrap());
            println!("{rolled_m}: {a} {b}");
            assert!((a - b).abs() < 0.006, "{a} {b}");
        }
    }

    /// Betti: one pair of forces does on the displacements of another what that does on its.
    #[test]
    fn what_one_pair_moves_another_moves_it() {
        let (profile, outline, height_m) = single();
        let body = Body::new(&profile, &outline, 0.5 * height_m, (24, 120)).unwrap();
        let [one, other] = [0.2e-3, 1.2e-3].map(|s| body.pressed(s));
        let work = |by: &Pressed, on: &Pressed| {
            let [a, b] = by.at;
            let moved = |z: Point| {
                body.regular(by, z, KAPPA) + flamant(z - a, by.e, KAPPA) + flamant(z - b, -by.e, KAPPA)
            };
            ((moved(on.at[0]) - moved(on.at[1])) * on.e.conj()).re
        };
        let (there, back) = (work(&one, &other), work(&other, &one));
        println!("{there} {back}");
        assert!((there / back - 1.0).abs() < 3e-3, "{there} {back}");
    }

    /// dC/ds is the slope of C, and both go on without a step where C goes straight on.
    #[test]
    fn the_slope_is_that_of_the_compliance() {
        let (profile, outline, height_m) = single();
        let bulk = Bulk::new(&profile, &outline, height_m, KAPPA, 1.0).unwrap();
        let end_m: f64 = profile.arcs.iter().map(length_m).sum();
        let at = |s: f64| bulk.at(Dual::variable(s));
        for share in [-0.3, -0.05, 0.0, 0.4, 0.9, 1.0, 1.3] {
            let (s, h) = (share * end_m, 1e-5 * end_m);
            let (a, b, c) = (at(s - h), at(s), at(s + h));
            let rise = (c.give_m_per_n.v - a.give_m_per_n.v) / (2.0 * h);
            let bend = (c.slope_per_n.v - a.slope_per_n.v) / (2.0 * h);
            assert!((rise - b.slope_per_n.v).abs() * end_m < 1e-8 && b.give_m_per_n.d == b.slope_per_n.v);
            assert!(
                (bend - b.slope_per_n.d).abs() * end_m * end_m < 1e-6,
                "{share}: {bend} {}",
                b.slope_per_n.d
            );
        }
        let until_m = bulk.middle_m + FOLLOWED * bulk.half_m;
        let (a, b) = (at(until_m * (1.0 - 1e-12)), at(until_m * (1.0 + 1e-12)));
        assert!((a.give_m_per_n.v / b.give_m_per_n.v - 1.0).abs() < 1e-10);
        assert!((a.slope_per_n.v / b.slope_per_n.v - 1.0).abs() < 1e-10);
    }
}
