//! Races off centre in the margin check: words, JSON, what stays left out.

use crate::answer::left_out::LeftOut;
use crate::clutch::{Carrier, Sharing};
use crate::design::Design;
use crate::margin::{LoadState, Round, RunOut, Survey};
use crate::report::{Unit, significant};
use crate::sharing::Turn;
use serde::Serialize;

/// One sprag of the JSON.
#[derive(Debug, Clone, Serialize)]
pub struct SpragShare {
    /// Azimuth from the widest gap where it stands.
    pub azimuth_deg: f64,
    /// The same where it engaged.
    pub engaged_deg: f64,
    /// N_bi, N.
    pub normal_inner_n: f64,
    /// That over the mean of all sprags.
    pub share: f64,
}

/// One torque of the JSON: the round in which one sprag has the largest share.
#[derive(Debug, Clone, Serialize)]
pub struct At {
    /// nominal or peak.
    pub torque: &'static str,
    /// That torque, N m.
    pub torque_nm: f64,
    /// Windup, deg.
    pub windup_deg: f64,
    /// Largest normal force of a sprag over the mean.
    pub largest_share: f64,
    /// The same of sprags alike between races that bend under all of them, over a turn; null: they do not carry it.
    pub largest_share_coupled: Option<f64>,
    /// The same if the rings did not yield to uneven load at all, by first order.
    pub largest_share_rigid: f64,
    /// Sprags without load in any round.
    pub sprags_without_load: usize,
    /// Largest of all rounds.
    pub radial_force_n: f64,
    /// By how much the inner race gives way.
    pub shift_um: f64,
    /// Every sprag.
    pub sprags: Vec<SpragShare>,
    #[serde(skip)]
    words: String,
}

/// `run_out` of the JSON; null where the design names no eccentricity.
#[derive(Debug, Clone, Serialize)]
pub struct RunOutSection {
    /// Distance of the axes, um.
    pub offset_um: f64,
    /// What a dial indicator reads (TIR).
    pub indicator_um: f64,
    /// Whether the engaged clutch turns against the offset.
    pub turning: bool,
    /// The race that the offset stays with.
    pub stays_with: &'static str,
    /// Null: stiff.
    pub bearing_stiffness_n_per_um: Option<f64>,
    /// Torque at which the first sprag comes to its end, and why.
    pub end_torque_nm: f64,
    /// Why the first sprag comes to its end.
    pub end_reason: &'static str,
    /// Where a sprag does not touch both races.
    pub without_contact_deg: Vec<f64>,
    /// A torque beyond the end is absent.
    pub at: Vec<At>,
    #[serde(skip)]
    left_out: Vec<LeftOut>,
}

/// Part of what yields under a little more load that is growth of the rings, at a torque of the even clutch, pure number.
fn growing(state: &LoadState, torque_nm: f64) -> Option<f64> {
    let (_, c) = state.curve.closure_at_torque(torque_nm)?;
    let d = &c.deformations;
    let rings = d.race_inner.d + d.race_outer.d;
    Some(rings / (rings + d.contact_inner.d + d.contact_outer.d + d.body.d))
}

fn at(ring: &RunOut, state: &LoadState, turn: &Turn, torque: &'static str, survey: &Survey) -> At {
    let round = survey.worst_round();
    let (largest_share, worst) = round.share();
    let mean = round.loads.iter().map(|l| l.normal_n).sum::<f64>() / round.loads.len() as f64;
    let degrees = |seat: usize| Unit::Degree.from_si(ring.seats[seat].azimuth_rad);
    let sprag = |l: &crate::margin::SpragLoad| SpragShare {
        azimuth_deg: degrees(l.seat),
        engaged_deg: degrees(l.engaged),
        normal_inner_n: l.normal_n,
        share: l.normal_n / mean,
    };
    At {
        torque,
        torque_nm: survey.torque_nm,
        windup_deg: Unit::Degree.from_si(round.windup_rad),
        largest_share,
        largest_share_coupled: turn
            .at(survey.torque_nm)
            .ok()
            .map(|places| places.iter().flat_map(|shared| shared.shares()).fold(0.0, f64::max)),
        // A sprag that takes more than the mean is then opposed by the rest alone.
        largest_share_rigid: growing(state, survey.torque_nm)
            .map_or(largest_share, |part| 1.0 + (largest_share - 1.0) / (1.0 - part)),
        sprags_without_load: survey.unloaded(),
        radial_force_n: survey.radial_n(),
        shift_um: Unit::Micrometre.from_si(shift_m(round)),
        sprags: round.loads.iter().map(sprag).collect(),
        words: ring.words(&worst),
    }
}

fn shift_m(round: &Round) -> f64 {
    round.shift_m[0].hypot(round.shift_m[1])
}

impl RunOutSection {
    pub(super) fn new(design: &Design, state: &LoadState, ring: &RunOut) -> Self {
        let limits = &design.limits;
        let asked = [("nominal", limits.nominal_torque_nm), ("peak", limits.peak_torque_nm)];
        let found: Vec<(&'static str, Survey)> =
            asked.into_iter().filter_map(|(name, torque)| Some((name, ring.survey(torque?).ok()?))).collect();
        let stop = ring.end;
        let turn = Turn::new(&design.clutch, &Sharing::default(), &state.curve);
        let at = |(name, survey): &(&'static str, Survey)| at(ring, state, &turn, name, survey);
        let at: Vec<At> = found.iter().map(at).collect();
        Self {
            offset_um: Unit::Micrometre.from_si(ring.offset_m),
            indicator_um: Unit::Micrometre.from_si(2.0 * ring.offset_m),
            turning: ring.turns.len() > 1,
            stays_with: match ring.carrier {
                Carrier::OuterRace => "outer-race",
                Carrier::InnerRace => "inner-race",
            },
            // N/m to N/um.
            bearing_stiffness_n_per_um: Some(1e-6 * ring.stiffness_n_per_m).filter(|k| k.is_finite()),
            end_torque_nm: stop.torque_nm,
            end_reason: if stop.seat.is_some() { stop.reason.name() } else { "no-contact" },
            without_contact_deg: ring.empty_rad().into_iter().map(|a| Unit::Degree.from_si(a)).collect(),
            left_out: left_out(design, state, &found, &at),
            at,
        }
    }

    /// What stays left out although the sprags stand in their own gaps.
    pub fn left_out(&self) -> &[LeftOut] {
        &self.left_out
    }

    /// What is to be known of it, a line each.
    pub fn remarks(&self) -> Vec<String> {
        let kind = match (self.turning, self.bearing_stiffness_n_per_um) {
            (true, _) => "the engaged clutch turns against it",
            (false, Some(0.0)) => "the engaged race floats on the sprags",
            (false, _) => "it stays as it is",
        };
        let mut lines = vec![format!(
            "Axes apart by {} µm (indicator {} µm), {kind}; the first sprag comes to its end ({}) at {}",
            significant(self.offset_um, 4),
            significant(self.indicator_um, 4),
            self.end_reason,
            Unit::NewtonMetre.show(self.end_torque_nm, 4)
        )];
        lines.extend(self.at.iter().map(|at| {
            let shift = match self.bearing_stiffness_n_per_um {
                Some(_) => format!(", the race gives way by {} µm", significant(at.shift_um, 3)),
                None => String::new(),
            };
            format!(
                "Off centre at {} torque: largest normal force {} of the mean ({}; {}), \
                 {} of {} sprags without load, bearings hold {}{shift}",
                at.torque,
                significant(at.largest_share, 4),
                match at.largest_share_coupled {
                    Some(share) => format!("{} in races that bend under all sprags", significant(share, 4)),
                    None => "in races that bend under all sprags it is not carried".to_owned(),
                },
                at.words,
                at.sprags_without_load,
                at.sprags.len(),
                Unit::Newton.show(at.radial_force_n, 3)
            )
        }));
        if !self.without_contact_deg.is_empty() {
            let places: Vec<String> = self.without_contact_deg.iter().map(|a| format!("{a:.0}")).collect();
            lines.push(format!(
                "Sprags that do not touch both races, deg from the widest gap: {}",
                places.join(", ")
            ));
        }
        lines
    }
}

/// Terms with their size at the largest torque found.
fn left_out(design: &Design, state: &LoadState, found: &[(&str, Survey)], at: &[At]) -> Vec<LeftOut> {
    let share = found.iter().map(|(_, s)| s.worst_round().share().0).fold(1.0, f64::max);
    let torque = found.last().map(|(_, s)| s.torque_nm);
    let ring_part = torque.and_then(|t| growing(state, t));
    let percent = |x: f64| Unit::Percent.show(x, 2);
    let mut list = vec![
        LeftOut::new(
            "coupling of neighbouring sprags through the rings, off centre",
            "in rows run-out-* each sprag's growth of the rings follows its own force; rows sprag-* have races that bend",
            &ring_part.map_or("not estimated: no torque is asked for".to_owned(), |part| {
                let coupled = at.iter().map(|at| at.largest_share_coupled);
                let coupled = coupled.collect::<Option<Vec<f64>>>().map_or("not carried".to_owned(), |all| {
                    percent(all.into_iter().fold(1.0, f64::max) - 1.0)
                });
                format!(
                    "the worst sprag's excess over the mean, {}, is {coupled} in rows sprag-*; some {} if the rings stay round: \
                     their growth is {} of what yields",
                    percent(share - 1.0),
                    percent((share - 1.0) / (1.0 - part)),
                    percent(part)
                )
            }),
        ),
        LeftOut::new(
            "tilted and out-of-round tracks",
            "tracks are circles with parallel axes",
            "not estimated",
        ),
    ];
    let shift = found.iter().map(|(_, s)| s.worst_round()).map(shift_m).fold(0.0, f64::max);
    if shift > 0.0 {
        let tilt = shift / design.clutch.races.inner_radius_m / state.first_tan_omega;
        list.push(LeftOut::new(
            "the race's shift in the wedge angle",
            "where the bearings give way the windups follow the race, the curves are those of the offset as given",
            &format!("up to {} of tan ω and of a sprag's force", percent(tilt)),
        ));
    }
    list
}
