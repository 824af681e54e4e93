//! Limits that each sprag has of its own: pressure, grip, end of the profile. Off centre the worst sprag is held against
//! them too. Shear below a contact and compression of the body would be such as well; there they follow from the pressure
//! and the force that are shown.

use super::held::When;
use crate::design::{Design, Limits};
use crate::wedge::StaticPoint;

/// One limit on what a sprag bears.
pub(super) struct OfSprag {
    pub code: &'static str,
    /// Name for people.
    pub name: fn(&Limits) -> &'static str,
    /// Unit as printed, and by what SI is multiplied for it.
    pub unit: (&'static str, f64),
    /// Torque at which it is held.
    pub when: When,
    /// Allowable, SI.
    pub allowed: fn(&Design, &Limits) -> Option<f64>,
    /// Demand of a static state, SI.
    pub demand: fn(&Design, &Limits, &StaticPoint) -> f64,
    /// What states below that torque demand, SI, where the largest on the way counts.
    pub on_the_way: Option<fn(&StaticPoint) -> f64>,
}

const NOMINAL: OfSprag = OfSprag {
    code: "hertz-nominal-inner",
    name: |_| "Hertz pressure, inner contact, nominal torque",
    unit: ("MPa", 1e-6),
    when: When::Nominal,
    allowed: |_, l| l.hertz_nominal_pa,
    demand: |_, _, p| p.hertz_inner_pa,
    on_the_way: None,
};

const PEAK: OfSprag = OfSprag {
    code: "hertz-peak-inner",
    name: |_| "Hertz pressure, inner contact, peak torque",
    when: When::Peak,
    allowed: |_, l| l.hertz_peak_pa,
    ..NOMINAL
};

/// Pressure at nominal torque, A and B.
pub(super) const NOMINAL_PRESSURE: [OfSprag; 2] = [
    NOMINAL,
    OfSprag {
        code: "hertz-nominal-outer",
        name: |_| "Hertz pressure, outer contact, nominal torque",
        demand: |_, _, p| p.hertz_outer_pa,
        ..NOMINAL
    },
];

/// Pressure at peak torque, A and B.
pub(super) const PEAK_PRESSURE: [OfSprag; 2] = [
    PEAK,
    OfSprag {
        code: "hertz-peak-outer",
        name: |_| "Hertz pressure, outer contact, peak torque",
        demand: |_, _, p| p.hertz_outer_pa,
        ..PEAK
    },
];

const GRIP_INNER: OfSprag = OfSprag {
    code: "grip-inner",
    name: |l| match l.axial_load_n {
        None => "largest static tan omega up to peak torque against mu_s",
        Some(_) => {
            "friction for torque and axial load at A, peak torque, or tan omega below it, against mu_s"
        }
    },
    unit: ("1", 1.0),
    when: When::Peak,
    allowed: |d, _| Some(d.clutch.friction.static_),
    demand: |d, l, p| grip(d, l, p)[0],
    on_the_way: Some(|p| p.tan_omega),
};

/// Friction at A and B: that of the torque alone on the way, with the axial load at the peak (it grows without bound as
/// the load goes to 0; `axial-from` says from where on it is carried).
pub(super) const GRIP: [OfSprag; 2] = [
    GRIP_INNER,
    OfSprag {
        code: "grip-outer",
        name: |l| match l.axial_load_n {
            None => "largest static tan nu up to peak torque against mu_s",
            Some(_) => {
                "friction for torque and axial load at B, peak torque, or tan nu below it, against mu_s"
            }
        },
        demand: |d, l, p| grip(d, l, p)[1],
        on_the_way: Some(|p| p.tan_nu),
        ..GRIP_INNER
    },
];

/// Turn left on the profile.
pub(super) const END_OF_PROFILE: OfSprag = OfSprag {
    code: "end-of-profile",
    name: |_| "contact turn on the profile, peak torque",
    unit: ("rad", 1.0),
    when: When::Peak,
    allowed: |d, _| d.clutch.sprags.inner_arcs.last().map(|a| a.until_rad),
    demand: |_, _, p| p.contact_turn_rad,
    on_the_way: None,
};

/// All of them.
pub(super) fn of_sprag() -> impl Iterator<Item = &'static OfSprag> {
    NOMINAL_PRESSURE.iter().chain(&PEAK_PRESSURE).chain(&GRIP).chain([&END_OF_PROFILE])
}

impl OfSprag {
    /// The demand at `peak`, or at one of the states `below` where one of those is larger, SI.
    pub fn largest(
        &self,
        design: &Design,
        limits: &Limits,
        peak: &StaticPoint,
        below: &[StaticPoint],
    ) -> f64 {
        let way = self.on_the_way.into_iter().flat_map(|way| below.iter().map(way));
        way.fold((self.demand)(design, limits, peak), f64::max)
    }
}

/// Friction that A and B need: sqrt(F_t^2 + F_a^2)/F_n. The axial load goes from race to sprag to race, so each
/// sprag hands F_a = load/n_s through both of its contacts.
pub(super) fn grip(design: &Design, limits: &Limits, p: &StaticPoint) -> [f64; 2] {
    let axial_n = limits.axial_load_n.unwrap_or(0.0) / design.clutch.sprags.count as f64;
    let need = |tangential: f64, normal_n: f64| match axial_n > 0.0 {
        true if normal_n > 0.0 => tangential.hypot(axial_n / normal_n),
        true => f64::MAX,
        false => tangential,
    };
    [need(p.tan_omega, p.normal_inner_n), need(p.tan_nu, p.normal_outer_n)]
}
