//! The answer of `sharing` by its keys in JSON, and its tables.

use super::{HARMONICS, OneRow, SharingAnswer, largest};
use crate::answer::Said;
use crate::report::{Cell, Rows, Table, Unit};
use crate::sharing::{Bears, Loss, NotShared, PopPoint, Shared};
use serde::Serialize;

/// What follows the end of the first sprag.
#[derive(Debug, Clone, Serialize)]
pub struct BeyondEndBody<'a> {
    /// The torque as the races are turned on.
    pub course: Rows<&'a PopPoint>,
    /// What those carry that remain under the torque of the end, N m; null: nothing remains, or it is not known,
    /// as the last row of `popped` says.
    pub left_torque_nm: Option<f64>,
    /// Sprags beyond their end there.
    pub peak_over: usize,
    /// Largest torque as the races are turned on, N m.
    pub peak_torque_nm: f64,
    /// Windup there, deg.
    pub peak_windup_deg: f64,
    /// Sprags that go over under the torque of the end, one after another.
    pub popped: Rows<&'a Loss>,
}

/// Keys of `sharing`.
#[derive(Debug, Clone, Serialize)]
pub struct SharingBody<'a> {
    /// Hertz pressure allowed at the torque, MPa.
    pub allowed_mpa: Option<f64>,
    /// What follows the end; null where nothing ends it.
    pub beyond: Option<BeyondEndBody<'a>>,
    /// What ends it at the torque that is still carried at every place.
    pub end_reason: Option<String>,
    /// Torque that is carried at every place, N m, where that is less than the one asked for.
    pub end_torque_nm: Option<f64>,
    /// As the torque rises, at the worst place.
    pub engagement: Rows<&'a (f64, Result<Shared, NotShared>)>,
    /// Mean growth of the inner track and amplitudes of its radius in each harmonic from the second on, um.
    pub harmonics_inner_um: Vec<f64>,
    /// Mean growth of the outer track and amplitudes of its radius in each harmonic from the second on, um.
    pub harmonics_outer_um: Vec<f64>,
    /// Whether every sprag that carries is within its limits, over the turn.
    pub held: bool,
    /// One sprag lost after another, the most pressed first.
    pub losses: Rows<(usize, &'a Loss)>,
    /// How many sprags, the most pressed first, may be lost until a limit is passed; null: not known, but as many at least as rows of
    /// `losses` are held.
    pub may_be_lost: Option<usize>,
    /// Seed of what sets the sprags apart by chance.
    pub seed: Option<u64>,
    /// Every sprag at the worst place, a row of [`SharingAnswer::by_sprag`].
    pub sprags: Rows<(usize, &'a OneRow)>,
    /// Torque, N m.
    pub torque_nm: f64,
    /// Every place of a turn: forces, pressures, shares.
    pub turn: Rows<(&'a Shared, &'a f64, (usize, f64))>,
    /// The answer in a sentence.
    pub verdict: String,
}

impl<'a> BeyondEndBody<'a> {
    fn of(answer: &'a SharingAnswer<'_>) -> Option<Self> {
        let pops = answer.pops.as_ref()?;
        Some(Self {
            peak_torque_nm: pops.peak.torque_nm,
            peak_windup_deg: Unit::Degree.from_si(pops.peak.windup_rad),
            peak_over: pops.peak.over,
            left_torque_nm: pops.left_nm,
            popped: answer.popped(),
            course: answer.over(),
        })
    }
}

impl<'a> SharingBody<'a> {
    pub(super) fn of(answer: &'a SharingAnswer<'_>) -> Self {
        let um = |race: &Vec<f64>| race.iter().map(|m| Unit::Micrometre.from_si(*m)).collect();
        let [harmonics_inner_um, harmonics_outer_um] = answer.out_of_round_m.each_ref().map(um);
        Self {
            held: answer.is_held(),
            verdict: answer.verdict(),
            torque_nm: answer.torque_nm,
            seed: answer.design.sharing.as_ref().map(|s| s.seed),
            allowed_mpa: answer.allowed.map(|(pa, _)| Unit::Megapascal.from_si(pa)),
            may_be_lost: answer.may_be_lost(),
            end_torque_nm: answer.end.map(|(nm, _)| nm),
            end_reason: answer.end.map(|(_, why)| why.words()),
            sprags: answer.by_sprag(),
            turn: answer.places(),
            beyond: BeyondEndBody::of(answer),
            engagement: answer.course(),
            losses: answer.lost(),
            harmonics_inner_um,
            harmonics_outer_um,
        }
    }
}

impl SharingAnswer<'_> {
    /// Every sprag at the worst place of the turn.
    pub fn by_sprag(&self) -> Rows<(usize, &OneRow)> {
        let on = |r: &OneRow| r.bears.normal_inner_n > 0.0;
        let slips = |r: &OneRow| r.bears.required_friction() > r.sprag.friction;
        let carried = |r: &OneRow, value: f64| Cell::only_if(on(r), value);
        let needs = |r: &OneRow| match on(r) {
            true => Some(r.bears.required_friction()),
            false => Some(r.first_friction).filter(|f| *f > 0.0),
        };
        let state = |r: &OneRow| match r.idle {
            Some(idle) => idle.into(),
            None if !on(r) => "no load".into(),
            None if slips(r) => Cell::Verdict(false, "slips".to_owned()),
            None => "carries".into(),
        };
        Rows::of(self.sprags.iter().enumerate())
            .number("number", "Sprag", Unit::One, 3, |(i, _)| i + 1)
            .number("azimuth_deg", "At", Unit::Degree, 4, |(_, r)| r.sprag.azimuth_rad)
            .number("size_um", "Larger by", Unit::Micrometre, 3, |(_, r)| r.sprag.size_m)
            .number("gap_um", "Gap", Unit::Micrometre, 3, |(_, r)| r.sprag.gap_m)
            .number("friction", "μs", Unit::One, 3, |(_, r)| r.sprag.friction)
            .number("catches_nm", "Bears from", Unit::NewtonMetre, 3, |(_, r)| r.catches_nm)
            .number("normal_inner_n", "N inner", Unit::Newton, 4, |(_, r)| carried(r, r.bears.normal_inner_n))
            .number("share", "Share", Unit::One, 4, |(_, r)| r.share)
            .number("hertz_inner_mpa", "p₀ inner", Unit::Megapascal, 4, |(_, r)| {
                carried(r, r.bears.hertz_inner_pa)
            })
            .number("hertz_outer_mpa", "p₀ outer", Unit::Megapascal, 4, |(_, r)| {
                carried(r, r.bears.hertz_outer_pa)
            })
            .number("needs_friction", "Needs μ", Unit::One, 3, |(_, r)| needs(r))
            .text("state", "State", |(_, r)| state(r))
            .json("idle", |(_, r)| r.idle)
            .json_in("lag_deg", Unit::Degree, |(_, r)| r.lag_rad)
            .json("first_friction", |(_, r)| r.first_friction)
            .json("normal_outer_n", |(_, r)| r.bears.normal_outer_n)
            .json("required_friction", |(_, r)| r.bears.required_friction())
            .json_in("bent_inner_um", Unit::Micrometre, |(_, r)| r.bears.bent_m[0])
            .json_in("bent_outer_um", Unit::Micrometre, |(_, r)| r.bears.bent_m[1])
    }

    /// Every place of a turn.
    pub(super) fn places(&self) -> Rows<(&Shared, &f64, (usize, f64))> {
        Rows::of(
            self.turned
                .as_deref()
                .unwrap_or_default()
                .iter()
                .zip(&self.gaps_rad)
                .map(|(s, gap)| (s, gap, s.worst(Bears::hertz_pa))),
        )
        .number("widest_gap_deg", "Widest gap at", Unit::Degree, 4, |(_, gap, _)| **gap)
        .number("windup_deg", "Windup", Unit::Degree, 4, |(s, _, _)| s.windup_rad)
        .number("carrying", "Carry", Unit::One, 3, |(s, _, _)| s.carrying())
        .number("largest_share", "Largest share", Unit::One, 4, |(s, _, _)| largest(&s.shares()))
        .number("most_pressed", "Sprag", Unit::One, 3, |(_, _, (most, _))| most + 1)
        .number("hertz_mpa", "p₀", Unit::Megapascal, 4, |(_, _, (_, pa))| *pa)
        .number("required_friction", "Needs μ", Unit::One, 3, |(s, _, _)| {
            s.worst(Bears::required_friction).1
        })
        .number("radial_force_n", "Bearings hold", Unit::Newton, 3, |(s, _, _)| {
            s.radial_n[0].hypot(s.radial_n[1])
        })
        .number("shift_um", "Shift", Unit::Micrometre, 3, |(s, _, _)| s.shift_m[0].hypot(s.shift_m[1]))
        .json("steps", |(s, _, _)| s.steps)
        .json("shares", |(s, _, _)| s.shares())
    }

    /// As the torque rises, at the worst place.
    pub(super) fn course(&self) -> Rows<&(f64, Result<Shared, NotShared>)> {
        let of = |(_, found): &(f64, Result<Shared, NotShared>)| found.clone().ok();
        let pressed = |row: &(f64, Result<Shared, NotShared>)| Some(of(row)?.worst(Bears::hertz_pa));
        Rows::of(&self.engagement)
            .number("torque_nm", "Torque", Unit::NewtonMetre, 4, |(torque, _)| *torque)
            .number("windup_deg", "Windup", Unit::Degree, 4, |row| of(row).map(|s| s.windup_rad))
            .number("carrying", "Carry", Unit::One, 3, |row| of(row).map(|s| s.carrying()))
            .number("largest_share", "Largest share", Unit::One, 4, |row| {
                of(row).map(|s| largest(&s.shares()))
            })
            .number("most_pressed", "Sprag", Unit::One, 3, |row| pressed(row).map(|(most, _)| most + 1))
            .number("hertz_mpa", "p₀", Unit::Megapascal, 4, |row| pressed(row).map(|(_, pa)| pa))
            .text("ended", "Not carried", |(_, found)| found.as_ref().err().map(|why| why.words()))
            .json("shares", |row| of(row).map(|s| s.shares()))
    }

    /// One loss after another.
    pub(super) fn lost(&self) -> Rows<(usize, &Loss)> {
        let pressed = |l: &Loss| Some(l.left.as_ref().ok()?.worst(Bears::hertz_pa).1);
        let verdict = |l: &Loss| match &l.left {
            Err(why) => Cell::Verdict(false, why.words()),
            Ok(_) if l.slips.is_some() => Cell::Verdict(false, "slips".to_owned()),
            Ok(_) => Cell::held(pressed(l).is_none_or(|pa| self.allowed.is_none_or(|(most, _)| pa <= most))),
        };
        Rows::of(self.losses.iter().enumerate())
            .number("losses", "Lost", Unit::One, 3, |(k, _)| k + 1)
            .number("lost", "The last: sprag", Unit::One, 3, |(_, l)| l.lost + 1)
            .number("largest_share", "Largest share", Unit::One, 4, |(_, l)| {
                l.left.as_ref().ok().map(|s| largest(&s.shares()))
            })
            .number("hertz_mpa", "p₀", Unit::Megapascal, 4, |(_, l)| pressed(l))
            .text("verdict", "Verdict", |(_, l)| verdict(l))
            .json("ended", |(_, l)| l.left.as_ref().err().map(|why| why.words()))
    }

    /// Growth and harmonics of both tracks.
    pub(super) fn out_of_round(&self) -> Table {
        let [inner, outer] = &self.out_of_round_m;
        let count = self.design.clutch.sprags.count;
        let name = |k: usize| match k {
            0 => "mean, gap opens".to_owned(),
            1 => "2, a quarter of the ovality".to_owned(),
            _ if k + 1 == count => format!("{count}, the sprags"),
            _ => (k + 1).to_string(),
        };
        let shown = (0..inner.len().min(HARMONICS)).chain((count > HARMONICS).then_some(count - 1));
        Rows::of(shown.filter_map(|k| Some((k, *inner.get(k)?, *outer.get(k)?))))
            .text("harmonic", "Harmonic", |(k, ..)| name(*k))
            .number("inner_um", "Inner race", Unit::Micrometre, 3, |(_, inner, _)| *inner)
            .number("outer_um", "Outer race", Unit::Micrometre, 3, |(.., outer)| *outer)
            .table()
    }
}
