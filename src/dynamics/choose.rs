//! The next mode where one or both contacts have zero slip velocity.
//!
//! With v = 0 the contact either sticks (|T| <= mu_s N) or begins to slip in the sense in which it is
//! accelerated (T = -sgn(v') mu_s N): a two-contact Coulomb complementarity problem. The friction at v = 0 is
//! mu_s on both sides; at most nine candidates are tried and the one that violates least is taken, sticking first.
//!
//! It is a mixed complementarity problem in x = (n T_bi OA, -n T_be OB): v' = b + G x, G = J M^-1 J^T for the rows
//! J_A = (rho_i, -1, 1, 0), J_B = (-rho_e, -1, 0, 1) of the slip rates. G is positive definite (M is, and the rows are
//! independent by alpha and phi alone, whatever moves the races; the test measures it), so with fixed limits mu N the problem is that of
//! minimising a strictly convex quadratic over a box: one solution, no Painleve paradox. N_bi is fixed by alpha. N_be
//! is not: N_be cos gamma = press + T_bi sin(beta+gamma) - T_be sin gamma, so the box moves with x. Stick-stick
//! (det G > 0), slip at A (G_BB > 0) and slip at both stay solvable; with A in stick and B in slip T_be follows
//! T_bi by s kappa, and the sign of that branch stays while
//!
//!   G_AA > |G_AB| (OB/OA) kappa,   kappa = mu sin(beta+gamma)/(cos gamma - mu |sin gamma|) > 0.
//!
//! Then all branches of the piecewise linear map are oriented alike. The left side exceeds the right by a
//! factor of some hundred in the random clutches of the test, where exactly one candidate is consistent in each case.
//! Where no candidate is consistent the least violation is still a mode and is counted (`inconsistent_choices`); the run then
//! goes on by `choose_again`, bounded by the limit of events.

use super::model::{Forces, Grip, Mode, Model, Place};
use crate::wedge::WedgePoint;

/// What is known of one contact before the choice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Known {
    /// Slips with this sign.
    Slips(f64),
    /// v = 0: stick or either slip.
    Still,
    /// v = 0 and just released by reaching its limit: it slips with this sign.
    Released(f64),
}

/// What was chosen.
#[derive(Debug, Clone, Copy)]
pub(super) struct Choice {
    pub(super) mode: Mode,
    /// Forces in it.
    pub(super) forces: Option<Forces>,
    /// Whether nothing of it contradicts itself.
    pub(super) consistent: bool,
}

/// Violation up to which a candidate counts as consistent: rounding of forces that all but cancel.
const CONSISTENT: f64 = 1e-9;

/// What a stick may ask for beyond its limit, as a part of that: rounding.
pub(super) const EXCESS: f64 = 1e-9;

/// What keeps a slip behind a stick that is as consistent.
const LATER: f64 = 1e-300;
/// Violation up to which nothing contradicts itself at all: no later candidate is better.
const FREE: f64 = 2.0 * LATER;

const STILL: [Grip; 3] = [Grip::Stick, Grip::Slip(1.0), Grip::Slip(-1.0)];

/// Eq. (11) without a band of zero velocity: the mode at (t, y), where the curve is `p`, by complementarity,
/// |T| <= mu_s N and v' = 0 in stick, T against v' in slip. Signs as in [`super::published()`], opposite at A and B.
#[doc(alias = "Eq. (11)")]
pub(super) fn choose<const N: usize>(
    model: &Model,
    t: f64,
    y: &[f64; N],
    p: &WedgePoint,
    place: Place,
    inner: Known,
    outer: Known,
) -> Choice {
    choose_by(model, p, place, inner, outer, alone(model, t, y, p))
}

/// The same where `forces` says what a mode comes to: the rate of alpha (rad/s) and the forces.
pub(super) fn choose_by(
    model: &Model,
    p: &WedgePoint,
    place: Place,
    inner: Known,
    outer: Known,
    forces: impl FnMut(&Mode) -> (f64, Forces),
) -> Choice {
    let mode = Mode { place, inner: Grip::Stick, outer: Grip::Stick };
    let mut best = Choice { mode, forces: None, consistent: false };
    let mut least = f64::INFINITY;
    weigh(model, p, place, inner, outer, forces, &mut |mode, forces, violation| {
        if violation < least {
            (best.mode, best.forces, least) = (mode, Some(forces), violation);
        }
        least > FREE
    });
    best.consistent = least < CONSISTENT;
    best
}

/// What a mode comes to where all sprags are in it.
fn alone<const N: usize>(
    model: &Model,
    t: f64,
    y: &[f64; N],
    p: &WedgePoint,
) -> impl Fn(&Mode) -> (f64, Forces) {
    move |mode| {
        let rates = model.rates(mode, p, y);
        (rates[0], model.forces_at(mode, t, y, p, &rates))
    }
}

/// Every candidate with how far it is from consistent, while `go_on` says so.
fn weigh(
    model: &Model,
    p: &WedgePoint,
    place: Place,
    inner: Known,
    outer: Known,
    mut forces: impl FnMut(&Mode) -> (f64, Forces),
    go_on: &mut impl FnMut(Mode, Forces, f64) -> bool,
) {
    for &a in candidates(if place == Place::Open { Known::Slips(1.0) } else { inner }).iter().flatten() {
        let at_b = if model.outer_holds { [Some(Grip::Stick), None, None] } else { candidates(outer) };
        for &b in at_b.iter().flatten() {
            let mode = Mode { place, inner: a, outer: b };
            let (alpha_rate, f) = forces(&mode);
            let (da, db) = slip_accelerations(p, alpha_rate, &f);
            let mu = model.friction.static_;
            let mut violation = 0.0;
            if place != Place::Open {
                violation += violation_of(a, inner, f.t_bi, mu * f.n_bi, da);
            }
            if !model.outer_holds {
                violation += violation_of(b, outer, f.t_be, mu * f.n_be, db);
            }
            if !go_on(mode, f, violation) {
                return;
            }
        }
    }
}

fn candidates(known: Known) -> [Option<Grip>; 3] {
    match known {
        Known::Slips(s) | Known::Released(s) => [Some(Grip::Slip(s)), None, None],
        Known::Still => STILL.map(Some),
    }
}

/// How far a candidate is from consistent, relative; 0 is consistent.
fn violation_of(grip: Grip, known: Known, tangential: f64, limit: f64, (rate, scale): (f64, f64)) -> f64 {
    match (grip, known) {
        (_, Known::Slips(_) | Known::Released(_)) => 0.0,
        (Grip::Stick, _) => {
            let excess = tangential.abs() - limit;
            if excess <= EXCESS * limit { 0.0 } else { excess / (tangential.abs() + limit) }
        }
        (Grip::Slip(s), _) => (-s * rate).max(0.0) / scale + LATER,
    }
}

/// Rates of v_A/OA and v_B/OB (rad/s^2), each with the sum of the magnitudes of its terms.
fn slip_accelerations(p: &WedgePoint, alpha_rate: f64, f: &Forces) -> ((f64, f64), (f64, f64)) {
    let [a, ph, i, e] = f.acceleration;
    let inner = [i, -ph, p.rho_i * a, p.rho_i_slope * alpha_rate * alpha_rate];
    let outer = [e, -ph, -p.rho_e * a, -p.rho_e_slope * alpha_rate * alpha_rate];
    let sum = |terms: [f64; 4]| {
        (terms.iter().sum::<f64>(), terms.iter().map(|x| x.abs()).sum::<f64>() + f64::MIN_POSITIVE)
    };
    (sum(inner), sum(outer))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::Design;
    use crate::dynamics::{FlangeDrive, Loads, Ramp, State, alpha_max_rad};
    use crate::friction::Stribeck;
    use crate::wedge::WedgeCurve;
    use nalgebra::Matrix2;

    /// Numbers in [0, 1): Knuth's MMIX generator.
    fn random(seed: &mut u64) -> f64 {
        *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(seed: &mut u64, low: f64, high: f64) -> f64 {
        low * (high / low).powf(random(seed))
    }

    /// A clutch of the paper's shape with random inertias, friction and loads, at a random state with v = 0.
    fn case(curve: &WedgeCurve, clutch: &crate::clutch::Clutch, seed: &mut u64) -> (Model, State, Place) {
        let mut clutch = clutch.clone();
        clutch.sprags.mass_kg *= between(seed, 0.1, 10.0);
        clutch.sprags.inertia_kg_m2 *= between(seed, 0.1, 10.0);
        clutch.races.inner_inertia_kg_m2 = between(seed, 1e-6, 1e2);
        clutch.races.outer_inertia_kg_m2 = between(seed, 1e-6, 1e2);
        let loads = Loads {
            inner_nm: 400.0 * (random(seed) - 0.5),
            amplitude_nm: 300.0 * random(seed),
            omega_rad_s: 600.0,
            abutment_nm_per_rad: between(seed, 1e1, 1e6),
        };
        let mut model = Model::new(&clutch, curve.clone(), loads, alpha_max_rad(&clutch, curve), 0.0);
        let mu = between(seed, 0.02, 0.5);
        model.friction = Stribeck { static_: mu, kinetic: mu, decay_s_per_m: 0.0 };
        // Of eight flanges three are no torque but move their race.
        let moved = (8.0 * random(seed)) as usize;
        model.drive.flanges = Some([0, 1].map(|race| match moved == race || moved == 2 {
            true => FlangeDrive::Acceleration(2e3 * (random(seed) - 0.5)),
            false => FlangeDrive::Torque(Ramp::default()),
        }));
        let alpha = curve.end().1 * random(seed);
        let mut y = [0.0; 10];
        (y[0], y[2], y[3]) = (alpha, 1e-3 * (random(seed) - 0.5), 1e-3 * (random(seed) - 0.5));
        let place = Place::Arc(curve.arc_at(alpha));
        for v in &mut y[4..8] {
            *v = 2.0 * (random(seed) - 0.5);
        }
        let stuck = Mode { place, inner: Grip::Stick, outer: Grip::Stick };
        let rates = model.rates(&stuck, &model.point(place, alpha), &y);
        y[4..8].copy_from_slice(&rates);
        (model, y, place)
    }

    #[test]
    fn contact_accelerations_are_a_positive_definite_map_of_friction_and_one_choice_is_consistent() {
        let design = Design::parse(include_str!("../../designs/huang2017-multi-arc.toml"), "design").unwrap();
        let s = &design.clutch.sprags;
        let arcs: Vec<(f64, f64)> = s.inner_arcs.iter().map(|a| (a.radius_m, a.until_rad)).collect();
        let r = &design.clutch.races;
        let profile = crate::profile::Profile::new(
            s.outer_radius_m,
            s.centre_distance_m,
            &arcs,
            r.inner_radius_m,
            r.outer_radius_m,
        )
        .unwrap();
        let curve = WedgeCurve::build(&design.clutch, &profile, 0.0).unwrap();
        let mut seed = 20;
        let (mut room, mut least, mut modes) = (f64::INFINITY, f64::INFINITY, [0; 3]);
        for _ in 0..2000 {
            let (model, y, place) = case(&curve, &design.clutch, &mut seed);
            let p = model.point(place, y[0]);
            let n = model.count;
            // Slip rates and x in three modes: two differences give G.
            let seen = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0)].map(|(a, b)| {
                let mode = Mode { place, inner: Grip::Slip(a), outer: Grip::Slip(b) };
                let f = model.forces(&mode, 0.01, &y);
                let (a, b) = slip_accelerations(&p, model.rates(&mode, &p, &y)[0], &f);
                ([n * f.t_bi * p.oa, -n * f.t_be * p.ob], [a.0, b.0], f.n_be)
            });
            if p.n_bi < 1.0 || seen.iter().any(|s| s.2 <= 0.0) {
                continue;
            }
            let differences = |pick: &dyn Fn(usize) -> [f64; 2]| {
                let [o, u, v] = [pick(0), pick(1), pick(2)];
                Matrix2::new(u[0] - o[0], v[0] - o[0], u[1] - o[1], v[1] - o[1])
            };
            let x = differences(&|i| seen[i].0);
            let g = differences(&|i| seen[i].1) * x.try_inverse().unwrap();
            let scale = (g[(0, 0)] * g[(1, 1)]).sqrt();
            assert!((g[(0, 1)] - g[(1, 0)]).abs() < 1e-6 * scale, "{g}");
            let definite = 1.0 - g[(0, 1)] * g[(1, 0)] / (scale * scale);
            least = least.min(definite);
            assert!(g[(0, 0)] > 0.0 && g[(1, 1)] > 0.0 && definite > 0.0, "{g}");
            let mu = model.friction.static_;
            let kappa = mu * p.beta_gamma.sin().abs() / (p.gamma.cos() - mu * p.gamma.sin().abs());
            room = room.min(g[(0, 0)] / (g[(0, 1)].abs() * p.ob / p.oa * kappa));
            let mut consistent = Vec::new();
            let forces = alone(&model, 0.01, &y, &p);
            weigh(&model, &p, place, Known::Still, Known::Still, forces, &mut |mode, _, violation| {
                if violation < CONSISTENT {
                    consistent.push(mode);
                }
                true
            });
            assert_eq!(consistent.len(), 1, "{consistent:?}");
            let chosen = choose(&model, 0.01, &y, &p, place, Known::Still, Known::Still);
            assert_eq!((chosen.mode, chosen.consistent), (consistent[0], true));
            let slips = |g: Grip| usize::from(g != Grip::Stick);
            modes[slips(chosen.mode.inner) + slips(chosen.mode.outer)] += 1;
        }
        println!("1 - G_AB^2/(G_AA G_BB) >= {least:.3}, room {room:.1}, {modes:?} by number of slips");
        assert!(room > 1.0 && modes.iter().all(|&m| m > 20), "{room} {modes:?}");
    }
}
