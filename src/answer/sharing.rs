//! Sprags one by one: what each carries, over a turn, through an engagement, after losses; races out of round.

use super::drawn::drawn_words;
use super::left_out::{LeftOut, one_by_one};
use super::page::half;
use super::{Finding, Said};
use crate::clutch::Rim;
use crate::design::Design;
use crate::margin::{LoadState, NoMargins, load_state};
use crate::report::plot::Curve;
use crate::report::{Cell, Page, Plot, Rows, Screen, Table, Unit, significant};
use crate::sharing::{Bears, Loss, NotShared, Pops, Shared, Turn};
use serde_json::{Value, json};
use std::fmt;

/// Harmonics of the tracks that are shown beside that of the sprags themselves.
const HARMONICS: usize = 8;
/// Rows of a table of sprags that the text shows.
const MOST_ROWS: usize = 24;

/// What each sprag of a design carries.
#[derive(Debug, Clone)]
pub struct SharingAnswer<'a> {
    design: &'a Design,
    /// Torque, N m.
    pub torque_nm: f64,
    /// Hertz pressure allowed at it, Pa, and its key.
    pub allowed: Option<(f64, &'static str)>,
    /// Place after place of a turn; why the first that does not carry the torque does not.
    pub turned: Result<Vec<Shared>, NotShared>,
    /// Azimuth of the widest gap from sprag 1 at each place, rad.
    pub gaps_rad: Vec<f64>,
    /// Torque that is carried at every place, N m, where that is less, and what ends it.
    pub end: Option<(f64, NotShared)>,
    /// Sprags that go over their highest place beyond that; `None`: nothing ends it, or the axes lie apart.
    pub pops: Option<Pops>,
    /// As the torque rises, at the worst place.
    pub engagement: Vec<(f64, Result<Shared, NotShared>)>,
    /// One sprag lost after another, at the worst place.
    pub losses: Vec<Loss>,
    /// Mean growth and harmonics of inner and outer track there, m.
    pub out_of_round_m: [Vec<f64>; 2],
    sprags: Vec<OneRow>,
}

/// One sprag of the table.
#[derive(Debug, Clone)]
pub struct OneRow {
    sprag: crate::sharing::OneSprag,
    idle: Option<&'static str>,
    lag_rad: Option<f64>,
    catches_nm: Option<f64>,
    first_friction: f64,
    bears: Bears,
    share: f64,
}

/// Why there is no answer.
#[derive(Debug, Clone, PartialEq)]
pub enum NoSharing {
    /// The design has no `[sharing]` table.
    NoTable,
    /// No torque above 0 is asked for.
    NoTorque,
    /// There is no clutch to speak of.
    NoClutch(NoMargins),
}

impl fmt::Display for NoSharing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoTable => write!(
                f,
                "the design has no [sharing] table; add one with what sets its sprags apart, such as\n\n{EXAMPLE}\n\n\
                 `sprag-design explain sharing` lists its keys"
            ),
            Self::NoTorque => {
                f.write_str("allowed: a torque above 0: --torque, or nominal_torque_nm in [limits]")
            }
            Self::NoClutch(why) => why.fmt(f),
        }
    }
}

impl std::error::Error for NoSharing {}

/// A table to begin with.
pub const EXAMPLE: &str =
    "[sharing]\nseed = 1\nsize_within_um = 2.0\nsprags = [ { number = 4, gap_um = 10.0 } ]   # a weak spring";

impl Design {
    /// What each sprag carries at `torque_nm`, N m; `None`: at the nominal torque of `[limits]`, else at its peak torque.
    ///
    /// # Errors
    /// [`NoSharing`].
    pub fn sharing(&self, torque_nm: Option<f64>) -> Result<SharingAnswer<'_>, NoSharing> {
        let sharing = self.sharing.as_ref().ok_or(NoSharing::NoTable)?;
        let limits = &self.limits;
        let torque_nm = torque_nm.or(limits.nominal_torque_nm).or(limits.peak_torque_nm);
        let torque_nm = torque_nm.filter(|t| t.is_finite() && *t > 0.0).ok_or(NoSharing::NoTorque)?;
        let at_nominal = limits.nominal_torque_nm.is_some_and(|nominal| torque_nm <= nominal * (1.0 + 1e-12));
        let nominal = limits.hertz_nominal_pa.filter(|_| at_nominal).map(|pa| (pa, "hertz_nominal_mpa"));
        let allowed = nominal.or(limits.hertz_peak_pa.map(|pa| (pa, "hertz_peak_mpa")));
        let LoadState { curve, .. } = load_state(self).map_err(NoSharing::NoClutch)?;
        let turn = Turn::new(&self.clutch, sharing, &curve);
        let turned = turn.at(torque_nm);
        let end = if turned.is_err() { turn.end(torque_nm) } else { None };
        // The worst place, at the torque or where it ends.
        let there = turned.clone().ok().or_else(|| turn.at(end.as_ref()?.0).ok()).unwrap_or_default();
        let pressed: Vec<f64> = there.iter().map(|s| s.worst(Bears::hertz_pa).1).collect();
        let worst = (0..pressed.len()).max_by(|a, b| pressed[*a].total_cmp(&pressed[*b])).unwrap_or(0);
        let (clutch, turned_rad) = &turn.places[worst];
        let shared = there.get(worst);
        let shares = shared.map(Shared::shares).unwrap_or_default();
        let catches = clutch.catches_nm(*turned_rad);
        let pops = match &end {
            Some((end_nm, NotShared::End(first, reason))) => {
                let brink = self.clutch.profile().ok().and_then(|profile| self.clutch.brink(&profile));
                let way = curve.beyond(brink.as_ref());
                way.and_then(|way| clutch.pops((*first, *reason), *end_nm, *turned_rad, &way))
            }
            _ => None,
        };
        let row = |i: usize| OneRow {
            sprag: clutch.sprags[i],
            idle: clutch.idle[i].map(|idle| idle.words()),
            lag_rad: clutch.lag_rad[i],
            catches_nm: catches[i],
            first_friction: clutch.first_friction[i],
            bears: shared.map_or_else(Bears::default, |s| s.loads[i]),
            share: shares.get(i).copied().unwrap_or(0.0),
        };
        let most = HARMONICS.max(self.clutch.sprags.count);
        Ok(SharingAnswer {
            design: self,
            torque_nm,
            allowed,
            gaps_rad: turn.places.iter().map(|(clutch, turned)| clutch.phase_rad + turned).collect(),
            end,
            pops,
            engagement: clutch.engagement(torque_nm, *turned_rad),
            losses: match (&turned, allowed, shared) {
                (Ok(_), Some((allowed_pa, _)), Some(shared)) => clutch.losses(shared, allowed_pa),
                _ => Vec::new(),
            },
            out_of_round_m: shared.map_or_else(Default::default, |s| clutch.out_of_round_m(s, most)),
            sprags: (0..self.clutch.sprags.count).map(row).collect(),
            turned,
        })
    }
}

impl SharingAnswer<'_> {
    /// The most pressed sprag of the turn and its pressure, Pa.
    fn most_pressed(&self) -> Option<(usize, f64)> {
        let turned = self.turned.as_ref().ok()?;
        turned.iter().map(|s| s.worst(Bears::hertz_pa)).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// A sprag that needs more friction than it has, and what it needs.
    fn slipping(&self) -> Option<(usize, f64)> {
        let turned = self.turned.as_ref().ok()?;
        let needs = |i: usize| turned.iter().map(|s| s.loads[i].required_friction()).fold(0.0, f64::max);
        let over = (0..self.sprags.len()).map(|i| (i, needs(i) / self.sprags[i].sprag.friction, needs(i)));
        over.filter(|(_, over, _)| *over > 1.0)
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .map(|(i, _, needs)| (i, needs))
    }

    /// How many sprags, the most pressed first, may be lost until a limit is passed; `None`: not known, since no limit is given or
    /// since no balance was found after a loss.
    pub fn may_be_lost(&self) -> Option<usize> {
        (self.allowed.is_some() && self.turned.is_ok() && !self.loss_not_found())
            .then(|| self.losses.len().saturating_sub(1))
    }

    fn loss_not_found(&self) -> bool {
        self.losses.last().is_some_and(|last| matches!(last.left, Err(NotShared::NoBalance)))
    }

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
    fn places(&self) -> Rows<(&Shared, &f64, (usize, f64))> {
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
    fn course(&self) -> Rows<&(f64, Result<Shared, NotShared>)> {
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
    fn lost(&self) -> Rows<(usize, &Loss)> {
        let pressed = |l: &Loss| Some(l.left.as_ref().ok()?.worst(Bears::hertz_pa).1);
        let verdict = |l: &Loss| match &l.left {
            Err(why) => Cell::Verdict(false, why.words()),
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
    fn out_of_round(&self) -> Table {
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

    /// Shares round the clutch.
    fn round(&self) -> Plot {
        let mut plot = Plot::new("Azimuth, °", "Share of the mean");
        let found: Vec<(f64, &Shared)> =
            self.engagement.iter().filter_map(|(t, s)| Some((*t, s.as_ref().ok()?))).collect();
        for part in [0.1, 0.3, 1.0] {
            let Some((torque, shared)) =
                found.iter().find(|(t, _)| *t >= part * self.torque_nm * (1.0 - 1e-9))
            else {
                continue;
            };
            let points = self
                .sprags
                .iter()
                .zip(shared.shares())
                .map(|(r, share)| [Unit::Degree.from_si(r.sprag.azimuth_rad), share]);
            plot.curves.push(Curve {
                dots: true,
                ..Curve::new(&Unit::NewtonMetre.show_plain(*torque, 4), points.collect())
            });
        }
        plot
    }

    /// Largest and smallest share over torque.
    fn rising(&self) -> Plot {
        let found = self.engagement.iter().filter_map(|(t, s)| Some((*t, s.as_ref().ok()?.shares())));
        let (mut most, mut least) = (Vec::new(), Vec::new());
        for (torque, shares) in found {
            most.push([torque, largest(&shares)]);
            least.push([torque, shares.iter().copied().fold(f64::INFINITY, f64::min)]);
        }
        Plot::new("Torque, Nm", "Share of the mean").curve("largest", most).curve("smallest", least)
    }
}

impl Said for SharingAnswer<'_> {
    fn title(&self) -> &str {
        "Sharing"
    }

    fn design(&self) -> &Design {
        self.design
    }

    /// Whether every sprag that carries is within its limits, over the turn.
    fn outcome(&self) -> Finding {
        let within = |pa: f64| self.allowed.is_none_or(|(most, _)| pa <= most);
        let pressed = self.most_pressed().is_none_or(|(_, pa)| within(pa));
        Finding::of(self.turned.is_ok() && pressed && self.slipping().is_none())
    }

    fn verdict(&self) -> String {
        let torque = Unit::NewtonMetre.show(self.torque_nm, 4);
        let turned = match &self.turned {
            Ok(turned) => turned,
            Err(why) => {
                let until = self.end.filter(|(nm, _)| *nm > 0.0).map_or(String::new(), |(nm, _)| {
                    format!("; {} is carried", Unit::NewtonMetre.show(nm, 4))
                });
                return format!(
                    "NOT HELD: {torque} is not carried: {}{until}{}",
                    why.words(),
                    self.over_words()
                );
            }
        };
        let word = if self.is_held() { "HELD" } else { "NOT HELD" };
        let share = turned.iter().map(|s| largest(&s.shares())).fold(0.0, f64::max);
        let least = turned.iter().map(Shared::carrying).min().unwrap_or(0);
        let mut said = format!(
            "{word}: at {torque} {least} of {} sprags carry, the largest share is {} of the mean",
            self.sprags.len(),
            significant(share, 4)
        );
        if let Some((i, pa)) = self.most_pressed() {
            said += &format!(", sprag {} at {}", i + 1, Unit::Megapascal.show(pa, 4));
            if let Some((most, _)) = self.allowed {
                said += &format!(" of {} allowed", Unit::Megapascal.show(most, 4));
            }
        }
        if let Some((i, needs)) = self.slipping() {
            said += &format!(
                "; sprag {} needs a friction of {} and has {}",
                i + 1,
                significant(needs, 3),
                significant(self.sprags[i].sprag.friction, 3)
            );
        } else if let Some(count) = self.may_be_lost().filter(|_| self.is_held()) {
            said += &match count {
                0 => "; if the most pressed one failed, the others would be pressed beyond that".to_owned(),
                1 => "; if the most pressed one failed, the others would still hold, after a second one not"
                    .to_owned(),
                _ => format!("; {count} may fail, each time the most pressed one, and the others still hold"),
            };
        } else if self.is_held() && self.loss_not_found() {
            said += &format!(
                "; how many may fail is not known: without {} more the forces on the others were not found; so many fewer are held",
                if self.losses.len() == 1 { "one".to_owned() } else { self.losses.len().to_string() }
            );
        }
        if let Some(peak_nm) = self.design.limits.peak_torque_nm.filter(|nm| *nm > self.torque_nm) {
            said +=
                &format!("; at peak torque, {}, `check` holds the worst", Unit::NewtonMetre.show(peak_nm, 4));
        }
        said
    }

    fn remarks(&self) -> Vec<String> {
        let Some(sharing) = &self.design.sharing else { return Vec::new() };
        let mut all = drawn_words(sharing);
        let idle: Vec<String> = self
            .sprags
            .iter()
            .enumerate()
            .filter_map(|(i, r)| r.idle.map(|why| format!("{} {why}", i + 1)))
            .collect();
        if !idle.is_empty() {
            all.push(format!("Sprags that never carry: {}", idle.join(", ")));
        }
        if self.allowed.is_none() {
            all.push("No Hertz pressure is limited: hertz_nominal_mpa or hertz_peak_mpa in [limits] would say how many sprags may fail".to_owned());
        }
        all
    }

    fn table(&self) -> Table {
        self.by_sprag().table()
    }

    fn tables(&self, screen: Screen) -> String {
        let (sprags, more) = self.table().first(MOST_ROWS);
        let mut text = sprags.to_text(screen);
        if more > 0 {
            text += &format!("{more} more sprags: --csv, --json or --report\n");
        }
        let mut part = |title: &str, table: Table| {
            if !table.rows.is_empty() {
                text += &format!("\n{title}\n{}", table.to_text(screen));
            }
        };
        part(
            "Over a turn of the races",
            if self.gaps_rad.len() > 1 { self.places().table() } else { Table::default() },
        );
        part("Through an engagement", self.course().table());
        part("Beyond the end: sprags that go over their highest place", self.popped().table());
        part("One lost after another, the most pressed first", self.lost().table());
        part("Tracks out of round: amplitude of the radius", self.out_of_round());
        text
    }

    fn body(&self) -> Value {
        let mpa = |pa: f64| Unit::Megapascal.from_si(pa);
        let [inner, outer] = self
            .out_of_round_m
            .each_ref()
            .map(|race| race.iter().map(|m| Unit::Micrometre.from_si(*m)).collect::<Vec<_>>());
        json!({
            "held": self.is_held(), "verdict": self.verdict(), "torque_nm": self.torque_nm,
            "seed": self.design.sharing.as_ref().map(|s| s.seed),
            "allowed_mpa": self.allowed.map(|(pa, _)| mpa(pa)), "may_be_lost": self.may_be_lost(),
            "end_torque_nm": self.end.map(|(nm, _)| nm), "end_reason": self.end.map(|(_, why)| why.words()),
            "sprags": self.by_sprag().objects(), "turn": self.places().objects(),
            "beyond": self.beyond(),
            "engagement": self.course().objects(), "losses": self.lost().objects(),
            "harmonics_inner_um": inner, "harmonics_outer_um": outer,
        })
    }

    fn left_out(&self) -> Vec<LeftOut> {
        let clutch = &self.design.clutch;
        let tan = self.sprags.iter().map(|r| r.bears.tan_omega).fold(0.0, f64::max);
        let tracks = [clutch.races.inner_radius_m, clutch.races.outer_radius_m];
        let slope = self.out_of_round_m.iter().zip(tracks).map(|(race, radius)| {
            // Harmonics below that of the sprags; entry 1 is harmonic 2.
            let below =
                race.iter().enumerate().skip(1).take(clutch.sprags.count.saturating_sub(2).max(1) / 2);
            below.map(|(k, a)| (k + 1) as f64 * a / radius).fold(0.0, f64::max)
        });
        let slope = slope.fold(0.0, f64::max);
        let instead = vec![
            LeftOut::new(
                "slope of a bent track in the wedge angle",
                "a track that bends is taken to recede and to give along itself, not to lean",
                &if tan > 0.0 {
                    format!("up to {} of tan ω of a sprag", Unit::Percent.show(slope / tan, 2))
                } else {
                    "not estimated".to_owned()
                },
            ),
            LeftOut::new(
                "what holds the races",
                match [clutch.races.inner_rim, clutch.races.outer_rim].contains(&Rim::Held) {
                    false => {
                        "rings are free but for the shift of their axes: no housing, hub or flange stiffens them, and their first harmonic is the shift"
                    }
                    true => {
                        "a rim that the design holds does not yield at all, a free one is stiffened by nothing, and the first harmonic of every ring is the shift of its axis"
                    }
                },
                "not estimated; a housing round a thin race keeps it round: give its wall to the race",
            ),
            LeftOut::new(
                "rolling on between unlike tracks",
                "of the windup that a sprag's own deviation costs, what bodies yield meanwhile is that of sprags alike",
                "the deviation over the radius, some 1e-4 of the windup",
            ),
            LeftOut::new("tilted tracks", "tracks have parallel axes", "not estimated"),
            LeftOut::new(
                "inertia of the sprags that catch",
                "the torque rises slowly",
                "not estimated: races do not wait for a late sprag",
            ),
        ];
        one_by_one(self.design, instead)
    }

    fn draw(&self, page: &mut Page) {
        page.figures(&[
            (
                half(self.round()),
                "Normal force of each sprag over the mean, round the clutch, at parts of the torque.",
            ),
            (half(self.rising()), "The largest and the smallest share as the torque rises."),
        ]);
        page.heading("Sprags")
            .table("At the place of the turn where the most pressed one is pressed most.", &self.table());
        if self.gaps_rad.len() > 1 {
            page.heading("Over a turn of the races").table("Azimuths from sprag 1.", &self.places().table());
        }
        page.heading("Through an engagement").table("", &self.course().table());
        if self.pops.is_some() {
            page.heading("Beyond the end")
                .figure(&half(self.turned_on()), "Torque as the races are turned on, round, held on one axis; below 0 the sprags drive them.")
                .table("Under the torque of the end one sprag after another goes over its highest place.", &self.popped().table());
        }
        if !self.losses.is_empty() {
            page.heading("One lost after another")
                .table("The most pressed sprag fails, the others take its share.", &self.lost().table());
        }
        page.heading("Tracks out of round").table(
            "Amplitude of the radius in each harmonic; the mean opens the gap. The ovality, largest less smallest diameter, is four times \
             the second.",
            &self.out_of_round(),
        );
    }
}

/// The largest of all.
pub(super) fn largest(shares: &[f64]) -> f64 {
    shares.iter().copied().fold(0.0, f64::max)
}
