//! Small motions of the drivetrain with the clutch engaged: eigenfrequencies, damping, shapes.
//!
//! About the equilibrium at alpha both contacts stick, so that a sprag follows the races,
//!
//!   alpha' = (theta_be' - theta_bi')/(rho_i + rho_e),   phi' = theta_bi' + rho_i alpha',
//!
//! and the clutch is a spring dC/dW between the races, with the sprags' inertia, contact damping and gyroscopic moment put on
//! them by those rates. With the shafts that makes M x'' + D x' + K x = 0 on the shaft of the races; what has a given speed
//! stands still. Torques that go with an angle (orders, gas) are excitation and left out.

use super::{BODIES, Motion, Train};
use crate::dynamics::{Model, Place, settled_point};
use crate::numeric::eigen::eigenvalues;
use nalgebra::{Complex, DMatrix, DVector, Matrix2};

/// A small free motion of the engaged train.
#[derive(Debug, Clone, PartialEq)]
pub struct TrainMode {
    /// Undamped, Hz.
    pub frequency_hz: f64,
    /// Share of critical damping; 1 where it creeps.
    pub damping_ratio: f64,
    /// What holds most of the kinetic energy: `inner race`, `outer race`, or an inertia's name.
    pub moves: String,
    /// Amplitude of the races and of every inertia on a shaft by its own angle, the largest 1.
    pub shape: Vec<(String, f64)>,
}

/// Squares of frequencies below this part of the largest are lost in its rounding: a choice, some hundred roundings.
const LOST: f64 = 1e-13;

impl Model {
    /// Eigenfrequencies with the clutch engaged at `alpha_rad` of its curve, under `torque_nm` > 0 there, lowest first; the
    /// train as one piece, which turns freely, is none. `None` beyond the curve.
    pub fn train_modes(&self, torque_nm: f64, alpha_rad: f64) -> Option<Vec<TrainMode>> {
        let clutch_nm_per_rad = settled_point(self, torque_nm, alpha_rad)?.k_tangent_nm_per_rad;
        let train = self.drive.train.as_ref();
        let bodies = train.map_or(0, |t| t.bodies.len());
        // Number of each freedom.
        let mut free = [None; BODIES];
        let mut count = 0;
        for (b, freedom) in free.iter_mut().enumerate().take(2 + bodies) {
            let moves = b < 2 || train.is_some_and(|t| matches!(t.bodies[b - 2].motion, Motion::Free(_)));
            if moves {
                *freedom = Some(count);
                count += 1;
            }
        }
        let [mut mass, mut damping, mut stiffness] = [(); 3].map(|()| DMatrix::<f64>::zeros(count, count));
        let races = self.races_in_stick(alpha_rad);
        for (of, into) in [(races.mass, &mut mass), (races.damping, &mut damping)] {
            into.view_mut((0, 0), (2, 2)).copy_from(&of);
        }
        mass[(0, 0)] += self.inner_inertia_kg_m2;
        mass[(1, 1)] += self.outer_inertia_kg_m2;
        spring(&mut damping, Some(0), Some(1), self.damping_nm_s_per_rad);
        spring(&mut stiffness, Some(0), Some(1), clutch_nm_per_rad);
        stiffness[(1, 1)] += self.loads.abutment_nm_per_rad;
        for (race, fixed) in train.iter().flat_map(|t| t.rigid.iter().enumerate()) {
            damping[(race, race)] += fixed.drag_nm_s_per_rad;
        }
        for (b, body) in (2..).zip(train.iter().flat_map(|t| &t.bodies)) {
            spring(&mut stiffness, free[b], free[body.parent], body.stiffness_nm_per_rad);
            spring(&mut damping, free[b], free[body.parent], body.damping_nm_s_per_rad);
            if let Some(i) = free[b] {
                mass[(i, i)] += body.fixed.inertia_kg_m2;
                damping[(i, i)] += body.fixed.drag_nm_s_per_rad;
            }
        }
        // The clutch joins all of it: nothing but an abutment or a given speed keeps the whole from turning.
        let given = train.is_some_and(|t| (2..2 + t.bodies.len()).any(|b| free[b].is_none()));
        let turns = self.loads.abutment_nm_per_rad == 0.0 && !given;
        let found = eigen(&mass, &damping, &stiffness, turns)?;
        Some(found.into_iter().map(|one| one.named(train, &free, &mass)).collect())
    }

    /// What the sprags put on the two races: mass, damping, gyroscopic moment.
    fn races_in_stick(&self, alpha_rad: f64) -> OnRaces {
        let place = Place::Arc(self.curve.arc_at(alpha_rad));
        let p = self.point(place, alpha_rad);
        let rho = p.rho_i + p.rho_e;
        let speed = self.mean_speed(0.0).0;
        // (alpha', phi') of the races' rates.
        let follow = Matrix2::new(-1.0 / rho, 1.0 / rho, 1.0 - p.rho_i / rho, p.rho_i / rho);
        let (n, own) = (self.count, self.inertia_kg_m2);
        let orbit = self.mass_kg * p.oc_g * p.oc_g;
        let turning = 2.0 * n * self.mass_kg * p.oc_g * p.oc_g_slope * speed;
        // Linear as long as the damped force does not pull.
        const SLOW: f64 = 1e-9;
        let of_alpha = -n * self.damped(&p, speed, SLOW).1 / SLOW;
        let mass = n * Matrix2::new(own, own, own, own + orbit);
        let damping = Matrix2::new(of_alpha, -turning, turning, 0.0);
        let on_races = |m: Matrix2<f64>| follow.transpose() * m * follow;
        OnRaces { mass: on_races(mass), damping: on_races(damping) }
    }
}

struct OnRaces {
    mass: Matrix2<f64>,
    damping: Matrix2<f64>,
}

/// A spring or damper between two freedoms; `None` stands still.
fn spring(matrix: &mut DMatrix<f64>, a: Option<usize>, b: Option<usize>, value: f64) {
    for i in [a, b].into_iter().flatten() {
        matrix[(i, i)] += value;
    }
    if let (Some(a), Some(b)) = (a, b) {
        matrix[(a, b)] -= value;
        matrix[(b, a)] -= value;
    }
}

/// A mode by its freedoms.
struct Eigenmode {
    rate_rad_s: f64,
    damping_ratio: f64,
    shape: DVector<f64>,
}

/// Modes of M x'' + D x' + K x = 0, M and K symmetric, by x = L^-T z with M = L L^T. The damped eigenvalue of a mode is the
/// one of next magnitude. Where the whole `turns` freely its own mode, the slowest, is left out.
fn eigen(
    mass: &DMatrix<f64>,
    damping: &DMatrix<f64>,
    stiffness: &DMatrix<f64>,
    turns: bool,
) -> Option<Vec<Eigenmode>> {
    if [mass, damping, stiffness].into_iter().flatten().any(|x| !x.is_finite()) {
        return None;
    }
    let lower = mass.clone().cholesky()?.l();
    let inverse = lower.try_inverse()?;
    let (d, k) = (&inverse * damping * inverse.transpose(), &inverse * stiffness * inverse.transpose());
    let k = 0.5 * (&k + k.transpose());
    let own = k.clone().symmetric_eigen();
    let fastest = own.eigenvalues.max();
    if !(fastest > 0.0 && fastest.is_finite()) {
        return None;
    }
    // Time by the fastest mode, so that all entries are near 1.
    let (n, scale) = (k.nrows(), fastest.sqrt());
    let mut first_order = DMatrix::zeros(2 * n, 2 * n);
    first_order.view_mut((0, n), (n, n)).fill_with_identity();
    first_order.view_mut((n, 0), (n, n)).copy_from(&(-&k / fastest));
    first_order.view_mut((n, n), (n, n)).copy_from(&(-d / scale));
    let mut damped: Vec<Complex<f64>> =
        eigenvalues(first_order)?.into_iter().filter(|l| l.im >= 0.0).collect();
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| own.eigenvalues[a].total_cmp(&own.eigenvalues[b]));
    order.drain(..usize::from(turns));
    order.retain(|&i| own.eigenvalues[i] > LOST * fastest);
    let mode = |i: usize| {
        let rate = own.eigenvalues[i].sqrt();
        let off = |l: &Complex<f64>| (l.norm() - rate / scale).abs();
        let next = (0..damped.len()).min_by(|&a, &b| off(&damped[a]).total_cmp(&off(&damped[b])));
        let damping_ratio = next.map_or(0.0, |j| {
            let l = damped.swap_remove(j);
            if l.im == 0.0 { 1.0 } else { -l.re / l.norm() }
        });
        let shape = inverse.transpose() * own.eigenvectors.column(i);
        Eigenmode { rate_rad_s: rate, damping_ratio, shape }
    };
    Some(order.into_iter().map(mode).collect())
}

impl Eigenmode {
    fn named(self, train: Option<&Train>, free: &[Option<usize>; BODIES], mass: &DMatrix<f64>) -> TrainMode {
        let races = [("inner race", 0, 1.0), ("outer race", 1, 1.0)];
        let nodes = train.iter().flat_map(|t| t.nodes.iter().filter(|n| n.shaft.is_some()));
        let all = races.into_iter().chain(nodes.map(|n| (n.name.as_str(), n.body, n.ratio)));
        let moving: Vec<(&str, usize, f64)> =
            all.filter_map(|(name, body, ratio)| Some((name, free[body]?, ratio))).collect();
        let energy = |i: usize| mass[(i, i)] * self.shape[i].powi(2);
        let most = moving.iter().max_by(|a, b| energy(a.1).total_cmp(&energy(b.1)));
        let own = |(_, i, ratio): &(&str, usize, f64)| ratio * self.shape[*i];
        let largest = moving.iter().map(own).fold(0.0, |m: f64, x| if x.abs() > m.abs() { x } else { m });
        TrainMode {
            frequency_hz: self.rate_rad_s / std::f64::consts::TAU,
            damping_ratio: self.damping_ratio,
            moves: most.map_or_else(String::new, |m| m.0.to_owned()),
            shape: moving.iter().map(|m| (m.0.to_owned(), own(m) / largest)).collect(),
        }
    }
}
