//! The next mode where one or both contacts have zero slip velocity.
//!
//! With v = 0 the contact either sticks (|T| <= mu_s N) or begins to slip in the sense in which it is
//! accelerated (T = -sgn(v') mu_s N): a two-contact Coulomb complementarity problem. The friction at v = 0 is
//! mu_s on both sides; at most nine candidates are tried and the one that violates least is taken, sticking first.
//!
//! It is a mixed complementarity problem in x = (T_bi, T_be): v' = b + G x, with G = J M^-1 J^T diag(n OA, -n OB) for
//! the rows J_A = (rho_i, -1, 1, 0), J_B = (-rho_e, -1, 0, 1) of the two slip velocities. J M^-1 J^T is positive
//! definite (M is, and the rows are independent through the races), so with fixed limits mu N the problem is that of
//! minimising a strictly convex quadratic over a box: one solution, no Painleve paradox. N_bi is fixed by alpha. N_be
//! is not: the radial equation makes it affine in T_bi and T_be, so the box moves with x. Its own share stays
//! solvable while cos gamma + s mu sin gamma > 0 (gamma is some -0.7 degrees); a moving box keeps the solution unique
//! while mu tan(beta + gamma) is small against the ratio of G's entries, which is not proved for every design.
//! Where no candidate is consistent the least violation is still a mode; the run then goes on by `give_way`,
//! bounded by the limit of events.

use super::model::{Forces, Grip, Mode, Model, Place, State};

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

const STILL: [Grip; 3] = [Grip::Stick, Grip::Slip(1.0), Grip::Slip(-1.0)];

/// Eq. (11) without a band of zero velocity: the mode at (t, y) by complementarity, |T| <= mu_s N and v' = 0 in
/// stick, T against v' in slip. Signs as in [`super::published()`], opposite at A and B.
#[doc(alias = "Eq. (11)")]
pub(super) fn choose(model: &Model, t: f64, y: &State, place: Place, inner: Known, outer: Known) -> Mode {
    let mut best = Mode { place, inner: Grip::Stick, outer: Grip::Stick };
    let mut least = f64::INFINITY;
    for &a in candidates(if place == Place::Open { Known::Slips(1.0) } else { inner }).iter().flatten() {
        let at_b = if model.outer_holds { [Some(Grip::Stick), None, None] } else { candidates(outer) };
        for &b in at_b.iter().flatten() {
            let mode = Mode { place, inner: a, outer: b };
            let f = model.forces(&mode, t, y);
            let (da, db) = model.slip_accelerations(&mode, y, &f);
            let mu = model.friction.static_;
            let mut violation = 0.0;
            if place != Place::Open {
                violation += violation_of(a, inner, f.t_bi, mu * f.n_bi, da);
            }
            if !model.outer_holds {
                violation += violation_of(b, outer, f.t_be, mu * f.n_be, db);
            }
            if violation < least {
                (best, least) = (mode, violation);
            }
        }
    }
    best
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
            if excess <= 1e-9 * limit { 0.0 } else { excess / (tangential.abs() + limit) }
        }
        (Grip::Slip(s), _) => (-s * rate).max(0.0) / scale + 1e-300,
    }
}

impl Model {
    /// Rates of v_A/OA and v_B/OB (rad/s^2), each with the sum of the magnitudes of its terms.
    pub(super) fn slip_accelerations(&self, mode: &Mode, y: &State, f: &Forces) -> ((f64, f64), (f64, f64)) {
        let p = self.point(mode.place, y[0]);
        let da = self.rates(mode, &p, y)[0];
        let [a, ph, i, e] = f.acceleration;
        let inner = [i, -ph, p.rho_i * a, p.rho_i_slope * da * da];
        let outer = [e, -ph, -p.rho_e * a, -p.rho_e_slope * da * da];
        let sum = |terms: [f64; 4]| {
            (terms.iter().sum::<f64>(), terms.iter().map(|x| x.abs()).sum::<f64>() + f64::MIN_POSITIVE)
        };
        (sum(inner), sum(outer))
    }
}
