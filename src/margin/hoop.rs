//! Hoop stress of the races: Lame's mean and with the bending between the sprags.

use crate::design::{Clutch, Limits, TrackRun};
use crate::race::Race;
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

impl Hoop {
    /// Demand with what the fits add, Pa.
    ///
    /// A fitted race is one piece with its partner, so the load's share is Lame's of that piece, at the race's joint and at
    /// its track, and the fit's own stress is added at each place. The larger magnitude counts, loaded or at rest: a shaft
    /// stretches the inner race most without load. Bending adds what it adds without a fit.
    pub fn demand_pa(&self, clutch: &Clutch, elastic: &Elastic, p: &StaticPoint) -> f64 {
        let count = clutch.sprags.count;
        let plain = (self.demand)(elastic, count, p);
        let Some(running) = &clutch.running else { return plain };
        let inner = self.code.starts_with("hoop-inner");
        let (track, race, normal_n) = match inner {
            true => (&running.inner, &elastic.inner_race, p.normal_inner_n),
            false => (&running.outer, &elastic.outer_race, p.normal_outer_n),
        };
        if track.joint_pressure_pa == 0.0 {
            return plain;
        }
        let mean = HOOPS.iter().find(|h| h.code == if inner { "hoop-inner" } else { "hoop-outer" });
        let bending = plain - mean.map_or(plain, |h| (h.demand)(elastic, count, p));
        fitted_pa(track, race, count, normal_n) + bending
    }
}

fn fitted_pa(track: &TrackRun, race: &Race, count: usize, normal_n: f64) -> f64 {
    let places = [(race.track_m(), track.hoop_at_track_pa), (track.joint_m, track.hoop_at_joint_pa)];
    let worst = |(at_m, fit_pa): (f64, f64)| {
        fit_pa.abs().max((fit_pa + race.hoop_at_radius_pa(count, normal_n, at_m)).abs())
    };
    places.into_iter().map(worst).fold(0.0, f64::max)
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
