//! Rings under equally spaced contacts, beyond the mean pressure: the exact plane elasticity of the higher harmonics.
//!
//! n contacts load the track with p(theta) = p_mean [1 + 2 sum_k f_k cos(k n theta)]. The mean is Lame's; each
//! harmonic m = k n is a plane problem of the ring, solved with Michell's stress function
//! phi = (A r^m + B r^(m+2) + C r^-m + D r^(2-m)) cos m theta, other rim free or held (Barber, *Elasticity*, table 9.1;
//! Timoshenko & Goodier, art. 43). For large m it is the half-plane with u_m = 2 (1-nu^2) R/(E m) p_m, whose sum is
//! the local contact; what the ring adds is the sum of the differences, which dies out within a few harmonics.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::f64::consts::{PI, TAU};
use std::rc::Rc;

use nalgebra::{Matrix2, Matrix4, Vector2, Vector4};

use super::rim::Rim;
use super::ring::Race;
use crate::material::PlaneState;

/// Harmonics after which ring and half-plane are the same to rounding or the exponential has died: at m = 60 the
/// other rim of the thinnest sensible ring no longer matters.
const HARMONICS: usize = 40;

/// Response of one rim to the pressure cos(m theta) on it, other rim free.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Harmonic {
    /// Radial displacement away from the load over that of the half-plane.
    displacement_ratio: f64,
    /// Hoop stress at the loaded rim over the pressure; -1 for the half-plane.
    hoop_loaded: f64,
    /// Hoop stress at the other rim over the pressure.
    hoop_other: f64,
}

/// Solve one harmonic on a ring whose loaded rim has radius 1 and whose other rim has radius `other` (0: disc).
fn harmonic(m: f64, other: f64, poisson: f64, plane: PlaneState, rim: Rim) -> Option<Harmonic> {
    let kappa = plane.kolosov(poisson);
    harmonic_with(m, other, poisson, plane, conditions(m, other, kappa, rim))
}

/// Rows that vanish but for the load in the first: stress across and along the track, then at the other rim stresses where it is
/// free, displacements where it is held.
fn conditions(m: f64, other: f64, kappa: f64, rim: Rim) -> [[f64; 4]; 4] {
    let mut rows = tractions(m, other);
    if rim == Rim::Held {
        let at_rim = [0, 1, 2, 3].map(|i| scale(other, exponents(m)[i], other, exponents(m)[i] - 1.0));
        let (lift, drift) = (lifts(m, kappa), drifts(m, kappa));
        rows[2] = [0, 1, 2, 3].map(|i| lift[i] * at_rim[i]);
        rows[3] = [0, 1, 2, 3].map(|i| drift[i] * at_rim[i]);
    }
    rows
}

fn harmonic_with(
    m: f64,
    other: f64,
    poisson: f64,
    plane: PlaneState,
    rows: [[f64; 4]; 4],
) -> Option<Harmonic> {
    let exponents = exponents(m);
    let kappa = plane.kolosov(poisson);
    let hoop = |k: f64, s: f64| k * (k - 1.0) * scale(other, k, s, k - 2.0);
    // 2 mu u_r of each term.
    let lift = lifts(m, kappa);
    let half_plane = plane.half_plane_ratio(poisson) / m;
    let report = |x: &[f64], terms: &[usize]| {
        let sum = |f: &dyn Fn(usize) -> f64| terms.iter().zip(x).map(|(&i, x)| x * f(i)).sum::<f64>();
        let outward = sum(&|i| lift[i] * scale(other, exponents[i], 1.0, exponents[i] - 1.0));
        Harmonic {
            // Pressure pushes the rim away from the gap: outward for a bore, inward for an outside.
            displacement_ratio: if other > 1.0 { outward } else { -outward } / half_plane,
            hoop_loaded: sum(&|i| hoop(exponents[i], 1.0)),
            hoop_other: if other > 0.0 { sum(&|i| hoop(exponents[i], other)) } else { 0.0 },
        }
    };
    if other == 0.0 {
        // A solid shaft keeps the two terms that stay finite at the centre.
        let (a, b) = (radial_free(m, m), radial_free(m + 2.0, m));
        let (c, d) = (m * (m - 1.0), m * (m + 1.0));
        let determinant = a * d - b * c;
        let x = [-d / determinant, c / determinant];
        let outward = x[0] * lift[0] + x[1] * lift[1];
        let hoop_loaded = x[0] * m * (m - 1.0) + x[1] * (m + 2.0) * (m + 1.0);
        return Some(Harmonic { displacement_ratio: -outward / half_plane, hoop_loaded, hoop_other: 0.0 });
    }
    let matrix = Matrix4::from_fn(|i, j| rows[i][j]);
    let x = matrix.lu().solve(&Vector4::new(-1.0, 0.0, 0.0, 0.0))?;
    Some(report(x.as_slice(), &[0, 1, 2, 3]))
}

fn exponents(m: f64) -> [f64; 4] {
    [m, m + 2.0, -m, 2.0 - m]
}

/// s^power/rim^k: each term is scaled to 1 at the rim where it is largest, so that large m stays regular.
fn scale(other: f64, k: f64, s: f64, power: f64) -> f64 {
    let rim = if k > 0.0 { other.max(1.0) } else { other.min(1.0) };
    (power * s.ln() - k * rim.ln()).exp()
}

/// 2 mu u_r of each term over cos(m theta).
fn lifts(m: f64, kappa: f64) -> [f64; 4] {
    [-m, kappa - m - 1.0, m, kappa + m - 1.0]
}

/// 2 mu u_theta of each term over sin(m theta).
fn drifts(m: f64, kappa: f64) -> [f64; 4] {
    [m, kappa + m + 1.0, m, m - kappa - 1.0]
}

/// Radial stress over cos(m theta) and shear over sin(m theta) of each term: at the track, at the other rim.
fn tractions(m: f64, other: f64) -> [[f64; 4]; 4] {
    let radial = |s: f64| exponents(m).map(|k| (k - m * m) * scale(other, k, s, k - 2.0));
    let shear = |s: f64| exponents(m).map(|k| m * (k - 1.0) * scale(other, k, s, k - 2.0));
    [radial(1.0), shear(1.0), radial(other), shear(other)]
}

/// Displacements of the track under pressure cos(m theta) and under shear sin(m theta) on it in the positive sense, other rim
/// as `rim` says; unit radius, unit modulus, plane stress. Rows: away from the load over cos(m theta), along the track over sin(m
/// theta).
pub(super) fn response(m: f64, other: f64, poisson: f64, rim: Rim) -> Option<[[f64; 2]; 2]> {
    let plane = PlaneState::Stress;
    let kappa = plane.kolosov(poisson);
    // u = (1 + nu)/E times 2 mu u; a bore is seen from within.
    let (per_e, sense) = (1.0 + poisson, if other > 1.0 { 1.0 } else { -1.0 });
    let at_track = |i: usize| scale(other, exponents(m)[i], 1.0, exponents(m)[i] - 1.0);
    let (lift, drift) = (lifts(m, kappa), drifts(m, kappa));
    let of = |x: &[f64]| {
        let sum = |by: &[f64; 4]| x.iter().enumerate().map(|(i, x)| x * by[i] * at_track(i)).sum::<f64>();
        [per_e * sense * sum(&lift), per_e * sum(&drift)]
    };
    // Traction on an outside is the stress, on a bore its reverse.
    let (pressed, sheared) = if other == 0.0 {
        let of = Matrix2::new(radial_free(m, m), radial_free(m + 2.0, m), m * (m - 1.0), m * (m + 1.0)).lu();
        (
            of.solve(&Vector2::new(-1.0, 0.0))?.as_slice().to_vec(),
            of.solve(&Vector2::new(0.0, 1.0))?.as_slice().to_vec(),
        )
    } else {
        let rows = conditions(m, other, kappa, rim);
        let of = Matrix4::from_fn(|i, j| rows[i][j]).lu();
        let shear = Vector4::new(0.0, -sense, 0.0, 0.0);
        (
            of.solve(&Vector4::new(-1.0, 0.0, 0.0, 0.0))?.as_slice().to_vec(),
            of.solve(&shear)?.as_slice().to_vec(),
        )
    };
    let ([up, vp], [ut, vt]) = (of(&pressed), of(&sheared));
    Some([[up, ut], [vp, vt]])
}

/// Hoop stress at the track over cos(m theta) under the pressure cos(m theta) on it, and over sin(m theta) under the shear cos(m
/// theta) on it in the positive sense, m = n, 2n, ...; plane stress.
pub(super) fn track_hoops(race: &Race, contacts: usize) -> impl Iterator<Item = [f64; 2]> {
    let (other, nu, rim) = (race.other_rim_m() / race.track_m(), race.material().poisson_ratio, race.rim());
    let kappa = PlaneState::Stress.kolosov(nu);
    (1..=HARMONICS).map_while(move |k| {
        let m = (k * contacts) as f64;
        if other == 0.0 {
            return Some([-1.0, -2.0]);
        }
        track_hoop(m, other, conditions(m, other, kappa, rim))
    })
}

/// The same of a ring whose rim is free across itself and turns as one: so finite elements drive it.
#[cfg(test)]
pub(super) fn driven_hoops(race: &Race, contacts: usize) -> impl Iterator<Item = [f64; 2]> {
    let (other, nu) = (race.other_rim_m() / race.track_m(), race.material().poisson_ratio);
    let kappa = PlaneState::Stress.kolosov(nu);
    (1..=HARMONICS).map_while(move |k| {
        let m = (k * contacts) as f64;
        let mut rows = conditions(m, other, kappa, Rim::Free);
        rows[3] = conditions(m, other, kappa, Rim::Held)[3];
        track_hoop(m, other, rows)
    })
}

fn track_hoop(m: f64, other: f64, rows: [[f64; 4]; 4]) -> Option<[f64; 2]> {
    let of = Matrix4::from_fn(|i, j| rows[i][j]).lu();
    let hoop = |x: Vector4<f64>| -> f64 {
        let at_track = |(k, x): (&f64, &f64)| x * k * (k - 1.0) * scale(other, *k, 1.0, k - 2.0);
        exponents(m).iter().zip(x.iter()).map(at_track).sum()
    };
    // Traction on an outside is the stress, on a bore its reverse; a quarter wave on, sin is cos and cos is -sin.
    let sense = if other > 1.0 { 1.0 } else { -1.0 };
    let pressed = of.solve(&Vector4::new(-1.0, 0.0, 0.0, 0.0))?;
    let sheared = of.solve(&Vector4::new(0.0, sense, 0.0, 0.0))?;
    Some([hoop(pressed), hoop(sheared)])
}

fn radial_free(k: f64, m: f64) -> f64 {
    k - m * m
}

/// Number of contacts, radius of the other rim over that of the track, Poisson's ratio.
type Key = (usize, f64, f64, PlaneState, Rim);

thread_local! {
    /// Those of the last rings of this thread: clutches of a search mostly share them.
    static LAST: RefCell<VecDeque<(Key, Rc<[Harmonic]>)>> = const { RefCell::new(VecDeque::new()) };
}

/// Two rings in plane strain and in plane stress, of two clutches.
const KEPT: usize = 8;

/// The harmonics of a ring.
fn known(key: Key) -> Rc<[Harmonic]> {
    let (contacts, other, poisson, plane, rim) = key;
    LAST.with_borrow_mut(|last| {
        if let Some((_, all)) = last.iter().find(|(known, _)| *known == key) {
            return all.clone();
        }
        let of = |k: usize| harmonic((k * contacts) as f64, other, poisson, plane, rim);
        let all: Rc<[Harmonic]> = (1..=HARMONICS).map_while(of).collect();
        last.truncate(KEPT - 1);
        last.push_front((key, all.clone()));
        all
    })
}

impl Race {
    fn harmonics(&self, contacts: usize, plane: PlaneState) -> impl Iterator<Item = (f64, Harmonic)> {
        let other = self.other_rim_m() / self.track_m();
        let all = known((contacts, other, self.material().poisson_ratio, plane, self.rim()));
        (0..all.len()).map(move |i| ((i + 1) as f64, all[i]))
    }

    /// Depth d, m, at which a half-plane under one contact has the approach that the ring has between that contact
    /// and its own mean rim: with it the logarithmic law counts local compression and ring bending exactly, and
    /// (5) the mean growth, nothing twice.
    ///
    /// From sum_k (2 J_1(kx)/(kx))/k = ln(2/x) + 1/2 for the semi-elliptic pressure (x = n a/R small) and
    /// S = sum_k (c_k/c_k,half-plane - 1)/k:  ln(2d/a) - t/2 = ln(2R/(n a)) + 1/2 + S, so
    /// d = R/n exp(1/2 + S + t/2), t = nu/(1-nu) in plane strain, nu in plane stress.
    pub fn effective_depth_m(&self, contacts: usize, plane: PlaneState) -> f64 {
        let s: f64 = self.harmonics(contacts, plane).map(|(k, h)| (h.displacement_ratio - 1.0) / k).sum();
        let t = plane.transverse_ratio(self.material().poisson_ratio);
        self.track_m() / contacts as f64 * (0.5 + s + 0.5 * t).exp()
    }

    /// Depth y, m, of a sharp change from plane strain to plane stress below a contact `contact_length_m` long, under which the ring
    /// has the approach of waves that change one by one: of the waves k n/R along its track `share` is plane stress, of wave number
    /// times width and Poisson's ratio, 1 for long waves and 0 for short ones.
    ///
    /// The waves' approach is sum_k [S_k/E + (1 - S_k) (1-nu^2)/E]/k, and a sharp change has the same where ln(R/(n y)) = sum_k S_k/k: a
    /// thin ring has the y of a half-plane, a thick one R/n, plane strain but for its mean growth.
    ///
    /// Left out: the curvature of the track in the waves, -(1 - S_k) nu^2/(m + 1) of a wave m: it would soften sprags by 0.1 to
    /// 0.25 % of windup, which finite elements of their outlines do not have. A race wider than its contacts is not loaded evenly over its
    /// width; from twice the width on it has the y of a half-plane, beside finite elements of such races to 0.45 % of windup, between in
    /// proportion.
    pub fn transition_m(
        &self,
        contacts: usize,
        contact_length_m: f64,
        share: impl Fn(f64, f64) -> f64,
    ) -> f64 {
        /// Wave number times width beyond which S falls as its inverse, and before which waves are long.
        const SHORT: f64 = 200.0;
        const LONG: f64 = 0.25;
        let nu = self.material().poisson_ratio;
        let sum = |wave: f64| {
            let count = (SHORT / wave).clamp(1.0, 4e3) as usize;
            let own: f64 = (1..=count).map(|k| share(k as f64 * wave, nu) / k as f64).sum();
            own + share((count as f64 + 0.5) * wave, nu)
        };
        let wave = contacts as f64 * self.width_m() / self.track_m();
        let even = sum(wave);
        let wider = (self.width_m() / contact_length_m - 1.0).clamp(0.0, 1.0);
        let of = match wider > 0.0 {
            true => even + wider * (sum(LONG) + (LONG / wave).ln() - even),
            false => even,
        };
        self.track_m() / contacts as f64 * (-of).exp()
    }

    /// Hoop stress at the track midway between two contacts, Pa, tension positive.
    ///
    /// Lame's mean plus the harmonics; the half-plane's part sums to + p_mean, because the mean stress holds the
    /// pressure that is absent between the contacts: -2 sum (-1)^k = 1 (Abel).
    pub fn hoop_between_pa(&self, contacts: usize, normal_n: f64) -> f64 {
        let rest: f64 = self
            .harmonics(contacts, PlaneState::Stress)
            .map(|(k, h)| 2.0 * (h.hoop_loaded + 1.0) * if k % 2.0 == 0.0 { 1.0 } else { -1.0 })
            .sum();
        self.hoop_at_track_pa(contacts, normal_n) + self.track_pressure_pa(contacts, normal_n) * (1.0 + rest)
    }

    /// Largest and smallest hoop stress at the rim away from the contacts, Pa: behind and between contacts.
    pub fn hoop_other_rim_pa(&self, contacts: usize, normal_n: f64) -> (f64, f64) {
        let mean = match self.other_rim_m() > self.track_m() {
            _ if self.rim() == Rim::Held => self.hoop_at_radius_pa(contacts, normal_n, self.other_rim_m()),
            // Lame at the outside of an outer race: the mean at its track less the pressure there.
            true => self.hoop_at_track_pa(contacts, normal_n) - self.track_pressure_pa(contacts, normal_n),
            false => self.hoop_at_bore_pa(contacts, normal_n),
        };
        let p = self.track_pressure_pa(contacts, normal_n);
        let sum = |between: bool| -> f64 {
            self.harmonics(contacts, PlaneState::Stress)
                .map(|(k, h)| 2.0 * h.hoop_other * if between && k % 2.0 == 1.0 { -1.0 } else { 1.0 })
                .sum()
        };
        let (behind, between) = (mean + p * sum(false), mean + p * sum(true));
        (behind.max(between), behind.min(between))
    }

    /// Hoop stress of largest magnitude away from the contacts, Pa, tension positive: midway between them at the
    /// track, behind and between them at the other rim. What the contacts do right under themselves is Hertz's.
    ///
    /// Held circular and free to slide, as in finite elements that turn the ring by its rim, the track of
    /// Table 1's outer race has 1.28 of the mean between sprags instead of the 1.34 of a free rim.
    pub fn hoop_with_bending_pa(&self, contacts: usize, normal_n: f64) -> f64 {
        let (largest, smallest) = self.hoop_other_rim_pa(contacts, normal_n);
        let between = self.hoop_between_pa(contacts, normal_n);
        [largest, smallest].into_iter().fold(between, |a, b| if b.abs() > a.abs() { b } else { a })
    }

    /// Extra growth of the loaded band per contact force, m/N, where the contacts are shorter than the race is
    /// wide: (5) with the race's own width spreads the load evenly over it, the harmonics along the axis put it
    /// back on the band. Half-plane in the axial section: u_k = 2(1-nu^2)/(E q_k) p_k, q_k = 2 pi k/w,
    /// p_k = 2 p_mean sinc(pi k l/w), averaged over the band with sinc again.
    pub fn band_compliance_m_per_n(&self, contacts: usize, contact_length_m: f64) -> f64 {
        let (w, l) = (self.width_m(), contact_length_m);
        if l >= w {
            return 0.0;
        }
        let sum: f64 = (1..=400)
            .map(|k| {
                let x = PI * f64::from(k) * l / w;
                2.0 * (x.sin() / x).powi(2) / f64::from(k)
            })
            .sum();
        let mean_pressure_per_n = self.track_pressure_pa(contacts, 1.0);
        mean_pressure_per_n * 2.0 * self.material().plane_strain_compliance() * w / TAU * sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Material;

    const STEEL: Material = Material { youngs_modulus_pa: 206e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };

    #[test]
    fn a_ring_is_a_half_plane_to_short_waves() {
        for plane in [PlaneState::Strain, PlaneState::Stress] {
            let h = harmonic(3000.0, 1.35, 0.3, plane, Rim::Free).unwrap();
            assert!((h.displacement_ratio - 1.0).abs() < 1e-3 && (h.hoop_loaded + 1.0).abs() < 1e-9);
            let h = harmonic(3000.0, 0.65, 0.3, plane, Rim::Free).unwrap();
            assert!((h.displacement_ratio - 1.0).abs() < 1e-3);
        }
    }

    #[test]
    fn a_thin_ring_bends_like_a_curved_beam() {
        // Ring of radius R, thickness h, load p cos(m theta): w = p R^4/(E I) /(m^2 - 1)^2 for h << R, I = h^3/12
        // per unit width (Timoshenko, *Strength of Materials* II, art. 15), outward load outward displacement.
        let (h, m) = (0.01, 2.0);
        let ring = harmonic(m, 1.0 + h, 0.3, PlaneState::Stress, Rim::Free).unwrap();
        let u = ring.displacement_ratio * PlaneState::Stress.half_plane_ratio(0.3) / m;
        // u is 2 mu u_r for unit pressure at unit radius, and 2 mu = E/(1 + nu); the load acts on the inner rim.
        let expected = 12.0 / h.powi(3) / (m * m - 1.0).powi(2) / 1.3 * (1.0 + 0.5 * h).powi(3);
        assert!((u / expected - 1.0).abs() < 0.01, "{u} {expected}");
    }

    #[test]
    fn a_solid_shaft_is_the_limit_of_a_small_bore() {
        let solid = harmonic(12.0, 0.0, 0.3, PlaneState::Strain, Rim::Free).unwrap();
        let bored = harmonic(12.0, 0.05, 0.3, PlaneState::Strain, Rim::Free).unwrap();
        assert!((solid.displacement_ratio - bored.displacement_ratio).abs() < 1e-9);
        assert!((solid.hoop_loaded - bored.hoop_loaded).abs() < 1e-9);
    }

    #[test]
    fn table_1_races_against_an_independent_script() {
        let outer = Race::outer(19.44e-3, 26.23e-3, 6e-3, STEEL).unwrap();
        let inner = Race::inner(7.21e-3, 11.11e-3, 6e-3, STEEL).unwrap();
        assert!((outer.effective_depth_m(12, PlaneState::Strain) - 3.668649141e-3).abs() < 1e-11);
        assert!((inner.effective_depth_m(12, PlaneState::Strain) - 1.842769196e-3).abs() < 1e-11);
        // Twice as many contacts see half the depth, nearly.
        let ratio =
            outer.effective_depth_m(24, PlaneState::Strain) / outer.effective_depth_m(12, PlaneState::Strain);
        assert!(ratio > 0.44 && ratio < 0.5, "{ratio}");
    }

    /// Sharp waves: sum_k e^(-k y n/R)/k = -ln(1 - e^(-y n/R)).
    #[test]
    fn a_thin_layer_changes_where_its_waves_do_and_a_thick_one_between_its_contacts() {
        let ring = Race::outer(19.44e-3, 40e-3, 6e-3, STEEL).unwrap();
        let (contacts, waves) = (40, 40.0 * 6e-3 / 19.44e-3);
        for depth in [0.1, 1.0, 10.0] {
            let sharp = ring.transition_m(contacts, 6e-3, |x, _| (-x * depth).exp());
            let found = sharp * waves / 6e-3 / (1.0 - (-depth * waves).exp());
            println!("{depth}: {found}");
            assert!((found - 1.0).abs() < 1e-3, "{depth}");
        }
        // Twice as wide as its contacts: the half-plane's depth, here 0.1 of the width.
        let wide = ring.transition_m(contacts, 3e-3, |x, _| (-0.1 * x).exp());
        assert!((wide / 0.6e-3 - 1.0).abs() < 0.02, "{wide}");
    }

    #[test]
    fn a_band_as_wide_as_the_race_adds_nothing() {
        let race = Race::outer(19.44e-3, 26.23e-3, 12e-3, STEEL).unwrap();
        assert_eq!(race.band_compliance_m_per_n(12, 12e-3), 0.0);
        let narrow = race.band_compliance_m_per_n(12, 3e-3);
        assert!(narrow > race.band_compliance_m_per_n(12, 6e-3) && narrow > 0.0);
    }

    /// Own finite elements of Table 1's clutch (one arc, plane stress, 16.8 Nm on the roller law's windup: N = 1852 N):
    /// hoop stress at the outer track midway between sprags 132.4 MPa, at the rim 71.1 MPa. There the rim is held
    /// circular.
    #[test]
    fn hoop_between_sprags_agrees_with_finite_elements_where_the_rim_is_held() {
        let outer = Race::outer(19.44e-3, 26.23e-3, 6e-3, STEEL).unwrap();
        let n = 1852.0;
        let (mean, p) = (outer.hoop_at_track_pa(12, n), outer.track_pressure_pa(12, n));
        let other = 26.23 / 19.44;
        let (mut track, mut rim) = (mean + p, mean - p);
        for k in 1..=HARMONICS {
            let m = 12.0 * k as f64;
            // It stays a circle that may grow and turns without shear: the boundary of that finite-element sector.
            let kappa = PlaneState::Stress.kolosov(0.3);
            let mut rows = conditions(m, other, kappa, Rim::Free);
            rows[2] = conditions(m, other, kappa, Rim::Held)[2];
            let h = harmonic_with(m, other, 0.3, PlaneState::Stress, rows).unwrap();
            let sign = if k % 2 == 0 { 2.0 } else { -2.0 };
            track += sign * p * (h.hoop_loaded + 1.0);
            rim += sign * p * h.hoop_other;
        }
        println!("track {:.1} rim {:.1} mean {:.1} MPa", track * 1e-6, rim * 1e-6, mean * 1e-6);
        assert!((track / 132.4e6 - 1.0).abs() < 0.015, "{track}");
        assert!((rim / 71.1e6 - 1.0).abs() < 0.06, "{rim}");
        // Free, it bends more; the inner bore of the independent finite elements, free, swings by 10 %.
        assert!((outer.hoop_between_pa(12, n) / mean - 1.34).abs() < 0.005);
        let inner = Race::inner(7.21e-3, 11.11e-3, 6e-3, STEEL).unwrap();
        let (high, low) = inner.hoop_other_rim_pa(12, n);
        let bore = inner.hoop_at_bore_pa(12, n);
        assert!(
            (low / bore - 1.10).abs() < 0.015 && (high / bore - 0.90).abs() < 0.015,
            "{high} {low} {bore}"
        );
        assert_eq!(inner.hoop_with_bending_pa(12, n), low);
        assert_eq!(outer.hoop_with_bending_pa(12, n), outer.hoop_between_pa(12, n));
    }
}
