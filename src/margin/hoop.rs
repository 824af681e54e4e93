//! Hoop stress of the races: Lame's mean and with the bending between the sprags.

use crate::design::Limits;
use crate::wedge::{Elastic, StaticPoint};

/// One limit on hoop stress.
pub(super) struct Hoop {
    pub code: &'static str,
    pub name: &'static str,
    /// Allowable, Pa, and whether it is one: bending without a limit of its own is shown beside that on the mean.
    pub allowed: fn(&Limits) -> Option<(f64, bool)>,
    /// Demand, Pa, of a clutch with that many sprags.
    pub demand: fn(&Elastic, usize, &StaticPoint) -> f64,
}

pub(super) const HOOPS: [Hoop; 4] = [
    Hoop {
        code: "hoop-inner",
        name: "mean hoop stress, inner race, peak torque (magnitude)",
        allowed: |l| l.hoop_inner_pa.map(|a| (a, true)),
        demand: |e, count, p| {
            let n = p.normal_inner_n;
            let bore = e.inner_race.hoop_at_bore_pa(count, n).abs();
            bore.max(e.inner_race.hoop_at_track_pa(count, n).abs())
        },
    },
    Hoop {
        code: "hoop-outer",
        name: "mean hoop stress, outer race, peak torque",
        allowed: |l| l.hoop_outer_pa.map(|a| (a, true)),
        demand: |e, count, p| e.outer_race.hoop_at_track_pa(count, p.normal_outer_n),
    },
    Hoop {
        code: "hoop-inner-bending",
        name: "hoop stress with ring bending, inner race, peak torque (magnitude)",
        allowed: |l| l.hoop_inner_bending_pa.map(|a| (a, true)).or(l.hoop_inner_pa.map(|a| (a, false))),
        demand: |e, count, p| e.inner_race.hoop_with_bending_pa(count, p.normal_inner_n).abs(),
    },
    Hoop {
        code: "hoop-outer-bending",
        name: "hoop stress with ring bending, outer race, peak torque",
        allowed: |l| l.hoop_outer_bending_pa.map(|a| (a, true)).or(l.hoop_outer_pa.map(|a| (a, false))),
        demand: |e, count, p| e.outer_race.hoop_with_bending_pa(count, p.normal_outer_n).abs(),
    },
];
