//! Sprags that float open between races that a torque drives apart: whether any of them can still touch the inner race.
//!
//! In: an element whose sprags are open, the torque that acts. Out: yes or no. Absent: driven cages, the other ways out of reach.
//! Equations: those of [`Model::forces`](crate::dynamics::Model::forces), by their energy.
//!
//! Open sprags and outer race turn alone. Their angular momentum p about O grows by the torque C, p' = C, whatever B does. Where B
//! rolls, alpha is all that is left: with M = J_e + n(I_g + m_g OC_g^2), c = I_g(1 - rho_e) - m_g OC_g^2 rho_e and T the kinetic
//! energy it moves with the energy E = T - p^2/(2M) + V in the potential
//!
//!   V(alpha) = n K_r(alpha_max - alpha)^2/2 + p^2/(2M) + C integral of n c/M d alpha.
//!
//! E and V(touch) change by (p^2)'/(2M), each at its own alpha: with G farther out in the open than at the touch, and p^2 rising, E
//! falls against the wall at the touch. A sprag below that wall stays below it. Where B slides, friction takes from E more than
//! the lag of the sprags brings as long as mu N_be OB > (C/M)(I_g + m_g OC_g^2). An outer race that is held has J_e
//! without bound.

use crate::clutch::Clutch;
use crate::dynamics::{OPEN_REACH_RAD, Place};
use crate::element::Element;

/// Parts of the way from the touch to the end of reach.
const PARTS: usize = 64;
/// Share of the depth of the potential by which a sprag has to be below the wall, far above what an integration is off.
const BELOW: f64 = 1e-3;

/// What acts.
pub(super) struct Floating<'a> {
    /// The clutch that is to grip, without damping between its races.
    pub clutch: &'a Clutch,
    /// Torque that drives the races apart, N m.
    pub torque_nm: f64,
    /// Whether the outer race keeps its speed.
    pub outer_held: bool,
}

impl Floating<'_> {
    /// Whether the open sprags of `element` never touch the inner race again; false where that is not known.
    pub fn for_good(&self, element: &Element) -> bool {
        let model = element.model();
        let (y, mode) = (element.memory().state(), element.memory().mode());
        if mode.place != Place::Open || model.carried.is_some() {
            return false;
        }
        let sprags = &self.clutch.sprags;
        let (n, inertia) = (sprags.count as f64, sprags.inertia_kg_m2);
        let here = model.point(mode.place, y[0]);
        let [alpha_rate, phi_rate, _, outer_rate] = model.rates(&mode, &here, y);
        let speed_rad_s = model.curve.speed_rad_s() + outer_rate;
        // C/J_e and 1/J_e.
        let [drives, light] = match self.outer_held {
            true => [0.0; 2],
            false => [self.torque_nm, 1.0].map(|x| x / self.clutch.races.outer_inertia_kg_m2),
        };
        let orbit = |oc_g: f64| sprags.mass_kg * oc_g * oc_g;
        // M in units of J_e.
        let mass = |o: f64| 1.0 + light * n * (inertia + o);
        let o = orbit(here.oc_g);
        // Of the sprags against the outer race.
        let lag_rad_s = phi_rate - outer_rate;
        let turns_rad_s = alpha_rate + lag_rad_s;
        let momentum = n * (inertia * turns_rad_s + o * lag_rad_s);
        let kinetic_j = 0.5 * n * (inertia * turns_rad_s.powi(2) + o * lag_rad_s.powi(2))
            - 0.5 * light * momentum * momentum / mass(o);
        // p/J_e.
        let p_rad_s = mass(o) * speed_rad_s + light * momentum;
        if drives * p_rad_s < 0.0 {
            return false;
        }
        let touch_rad = model.curve.first_contact_rad();
        let touch = model.curve.open(touch_rad);
        let o_touch = orbit(touch.oc_g);
        let stretched = |alpha: f64| (model.alpha_max_rad - alpha).powi(2);
        let spring = 0.5 * n * self.clutch.spring.stiffness_nm_per_rad;
        // Parts of V - V(touch), J.
        let spring_j = |alpha: f64| spring * (stretched(alpha) - stretched(touch_rad));
        let centrifugal_j = |o: f64| 0.5 * p_rad_s * p_rad_s * n * (o_touch - o) / (mass(o) * mass(o_touch));
        let pushed_nm = |alpha: f64| {
            let p = model.curve.open(alpha);
            let o = orbit(p.oc_g);
            drives * n * (inertia * (1.0 - p.rho_e) - o * p.rho_e) / mass(o)
        };
        let step_rad = OPEN_REACH_RAD / PARTS as f64;
        let (mut pushed_j, mut before_nm) = (0.0, pushed_nm(touch_rad));
        let (mut at_sprag_j, mut depth_j, mut farthest) = (f64::NAN, 0.0_f64, o_touch);
        for k in 1..=PARTS {
            let alpha = touch_rad - step_rad * k as f64;
            let next_nm = pushed_nm(alpha);
            let last_j = pushed_j;
            pushed_j -= 0.5 * step_rad * (before_nm + next_nm);
            before_nm = next_nm;
            let o = orbit(model.curve.open(alpha).oc_g);
            let steady_j = spring_j(alpha) + pushed_j;
            // Where G is nearer to O than at the touch, E would rise against the wall.
            let falls = self.outer_held || o >= o_touch || steady_j + centrifugal_j(o) > 0.0;
            if !falls {
                return false;
            }
            // As deep as it is or gets while p grows, by its share of p^2.
            depth_j = depth_j.max((-steady_j).max(0.0) + (-centrifugal_j(o)).max(0.0));
            farthest = farthest.max(o);
            if alpha <= y[0] && at_sprag_j.is_nan() {
                let part = ((y[0] - alpha) / step_rad).clamp(0.0, 1.0);
                let pushed_j = pushed_j + part * (last_j - pushed_j);
                at_sprag_j = spring_j(y[0]) + pushed_j + centrifugal_j(orbit(here.oc_g));
            }
        }
        let below = kinetic_j + at_sprag_j < -BELOW * depth_j;
        if !below || self.outer_held || model.outer_holds {
            return below;
        }
        // All of that depth in their lag: the slowest that the sprags turn with the outer race.
        let lag_rad_s = (2.0 * depth_j * mass(farthest) / (n * o_touch)).sqrt();
        let slowest_rad_s = (p_rad_s.abs() / mass(farthest) - lag_rad_s).max(0.0);
        let friction = self.clutch.friction.kinetic.min(self.clutch.friction.static_);
        let presses_n = sprags.mass_kg * touch.oc_g * slowest_rad_s.powi(2) / (1.0 + friction);
        friction * presses_n * touch.ob > drives * (inertia + farthest)
    }
}
