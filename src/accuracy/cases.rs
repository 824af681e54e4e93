//! The cases of the stability map: corners and random places of a wide box, from a seed.

use crate::clutch::{Clutch, Friction, Scenario, ScenarioKind, Start};
use crate::numeric::rounded;

/// One axis of the box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// Name with its SI unit.
    pub key: &'static str,
    /// Smallest value above zero.
    pub low: f64,
    /// Largest value.
    pub high: f64,
    /// Whether zero stands at the lower end instead of `low`.
    pub zero: bool,
}

const fn axis(key: &'static str, low: f64, high: f64, zero: bool) -> Parameter {
    Parameter { key, low, high, zero }
}

/// 60 000 rpm.
const FASTEST_RAD_S: f64 = 2000.0 * std::f64::consts::PI;

/// The axes, in the order of [`Case::values`]. The box is a choice: well beyond any clutch on every side.
pub const PARAMETERS: [Parameter; 12] = [
    axis("friction_static", 0.02, 0.5, false),
    axis("friction_kinetic_over_static", 0.3, 1.0, false),
    axis("friction_decay_s_per_m", 1e-2, 1e4, true),
    axis("preload_nm", 0.1, 200.0, true),
    axis("amplitude_nm", 0.1, 300.0, true),
    axis("frequency_hz", 1.0, 5e3, false),
    axis("abutment_stiffness_nm_per_rad", 1e1, 1e9, false),
    axis("viscous_damping_nm_s_per_rad", 1e-3, 10.0, true),
    axis("inner_inertia_kg_m2", 1e-6, 1e2, false),
    axis("outer_inertia_kg_m2", 1e-6, 1e2, false),
    axis("speed_rad_s", 1.0, FASTEST_RAD_S, true),
    axis("spring_stiffness_nm_per_rad", 1e-3, 1e3, true),
];

/// One place in the box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Case {
    /// Number, from 0: with the seed it makes the case, whatever the others are.
    pub number: usize,
    /// Values by [`PARAMETERS`], rounded to four digits, so that what is printed is what was run.
    pub values: [f64; PARAMETERS.len()],
}

/// Every so many cases, one lies in a corner of the whole box.
const CORNER_EVERY: usize = 4;
/// Elsewhere each parameter is at either end this often.
const AT_AN_END: f64 = 0.15;
/// Periods of a run, and its longest duration, s. The fastest corner swings a million times a second: longer runs would
/// only meet the limit of work more often.
const PERIODS: f64 = 10.0;
const LONGEST_S: f64 = 0.1;

/// `count` cases from `seed`.
pub fn cases(seed: u64, count: usize) -> Vec<Case> {
    (0..count).map(|number| case(seed, number)).collect()
}

fn case(seed: u64, number: usize) -> Case {
    // Neighbouring seeds of one generator: 2^64 over the golden ratio keeps them apart.
    let own = seed.wrapping_add((number as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
    let mut random = fastrand::Rng::with_seed(own);
    let corner = number.is_multiple_of(CORNER_EVERY);
    let values = PARAMETERS.map(|p| {
        let (where_, along) = (random.f64(), random.f64());
        let low = if p.zero { 0.0 } else { p.low };
        let end = if corner { 0.5 } else { AT_AN_END };
        if where_ < end {
            low
        } else if where_ < 2.0 * end {
            p.high
        } else {
            // Evenly in the logarithm.
            rounded((p.low.ln() + along * (p.high / p.low).ln()).exp(), 4)
        }
    });
    Case { number, values }
}

impl Case {
    /// The scenario of this case on `clutch`.
    pub fn scenario(&self, clutch: &Clutch) -> Scenario {
        let [mu, ratio, decay, preload, amplitude, frequency, abutment, damping, inner, outer, speed, spring] =
            self.values;
        let mut clutch = clutch.clone();
        clutch.friction = Friction {
            static_: mu,
            kinetic: mu * ratio,
            decay_s_per_m: decay,
            outer_holds: clutch.friction.outer_holds,
        };
        clutch.races.viscous_damping_nm_s_per_rad = damping;
        clutch.races.inner_inertia_kg_m2 = inner;
        clutch.races.outer_inertia_kg_m2 = outer;
        clutch.spring.stiffness_nm_per_rad = spring;
        Scenario {
            name: format!("case {}", self.number),
            kind: ScenarioKind::TorsionalExcitation {
                preload_nm: preload,
                amplitude_nm: amplitude,
                frequency_hz: frequency,
                abutment_stiffness_nm_per_rad: abutment,
                duration_s: (PERIODS / frequency).min(LONGEST_S),
                speed_rad_s: speed,
            },
            // As the paper's scenes, on which the study stands.
            start: Start::WithoutSpring,
            clutch,
            overrides: Vec::new(),
            torque_history: None,
            speed_history: None,
            drivetrain: Vec::new(),
        }
    }

    /// `key value, ...` of every parameter.
    pub fn described(&self) -> String {
        let each = PARAMETERS.iter().zip(self.values).map(|(p, v)| format!("{} {v}", p.key));
        each.collect::<Vec<_>>().join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_makes_the_same_cases_in_the_box_with_its_ends() {
        let all = cases(7, 400);
        assert_eq!(all[..100], cases(7, 100));
        assert_ne!(all[0].values, cases(8, 1)[0].values);
        for (i, p) in PARAMETERS.iter().enumerate() {
            let low = if p.zero { 0.0 } else { p.low };
            let count = |v: f64| all.iter().filter(|c| c.values[i] == v).count();
            assert!(count(low) > 50 && count(p.high) > 50, "{}", p.key);
            let inside = |v: f64| v == low || (0.999 * p.low..=p.high).contains(&v);
            assert!(all.iter().all(|c| inside(c.values[i])), "{}", p.key);
        }
    }

    // The first value of a known seed: another version of the generator must not change the map unseen.
    #[test]
    fn the_generator_is_the_one_the_reports_were_made_with() {
        let mut random = fastrand::Rng::with_seed(1);
        let first: Vec<u64> = (0..2).map(|_| random.u64(..)).collect();
        assert_eq!(first, [0xa833bdcdb6d1beb1, 0x88dc97e5aab5fe3d]);
    }
}
