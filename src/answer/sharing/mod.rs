//! Sprags one by one: what each carries, over a turn, through an engagement, after losses; races out of round.

mod beyond;
mod body;
mod page;
mod words;

pub use body::{BeyondEndBody, SharingBody};

use super::drawn::drawn_words;
use super::left_out::{LeftOut, one_by_one};
use super::{Finding, Said};
use crate::design::Design;
use crate::margin::{LoadState, NoMargins, load_state};
use crate::report::{Page, Screen, Table, Unit};
use crate::sharing::{Bears, Loss, NotShared, Pops, Shared, Turn};
use std::fmt;

/// Harmonics of the tracks that are shown beside that of the sprags themselves.
const HARMONICS: usize = 8;
/// What bearings may bear of the force of one sprag without a word.
const FEW: f64 = 0.1;
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
    /// One sprag lost after another, at the worst place; none where a limit is passed or one slips already.
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
                (Ok(turned), Some((allowed_pa, _)), Some(shared))
                    if turned.iter().all(|at| clutch.slipping(at).is_none()) =>
                {
                    clutch.losses(shared, allowed_pa)
                }
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

    /// How many sprags, the most pressed first, may be lost until a limit is passed or one slips; `None`: not known, since no
    /// limit is given or since no balance was found after the last of [`SharingAnswer::losses`].
    pub fn may_be_lost(&self) -> Option<usize> {
        (self.allowed.is_some() && self.turned.is_ok() && !self.loss_not_found())
            .then(|| self.losses.len().saturating_sub(1))
    }

    fn loss_not_found(&self) -> bool {
        self.losses.last().is_some_and(|last| matches!(last.left, Err(NotShared::NoBalance)))
    }
}

impl SharingAnswer<'_> {
    /// What holding the axes takes, where nothing lets them give way.
    fn axes_held(&self) -> Option<String> {
        let eccentricity = self.design.clutch.races.eccentricity.map(|e| e.stiffness_n_per_m);
        let given = self.design.sharing.as_ref()?.stiffness_n_per_m.or(eccentricity);
        let lost = self.losses.iter().filter_map(|loss| loss.left.as_ref().ok());
        let most_n = self
            .turned
            .iter()
            .flatten()
            .chain(lost)
            .map(|s| s.radial_n[0].hypot(s.radial_n[1]))
            .fold(0.0, f64::max);
        let few_n = FEW * self.sprags.iter().map(|row| row.bears.normal_inner_n).fold(0.0, f64::max);
        (given.unwrap_or(f64::INFINITY).is_infinite() && most_n > few_n).then(|| {
            format!(
                "The axes are held, whatever that takes: up to {} of their bearings, where sprags have failed too; bearings that give way \
                 (sharing.bearing_stiffness_n_per_um) leave more to the sprags beside a failed one",
                Unit::Newton.show(most_n, 3)
            )
        })
    }
}

impl Said for SharingAnswer<'_> {
    type Body<'a>
        = SharingBody<'a>
    where
        Self: 'a;

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
        self.verdict_words()
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
            all.push(
                "No Hertz pressure is limited: hertz_nominal_mpa or hertz_peak_mpa in [limits] would say how many \
                 sprags may fail"
                    .to_owned(),
            );
        }
        all.extend(self.axes_held());
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

    fn body(&self) -> SharingBody<'_> {
        SharingBody::of(self)
    }

    fn left_out(&self) -> Vec<LeftOut> {
        one_by_one(self.design, self.instead())
    }

    fn draw(&self, page: &mut Page) {
        page::draw(self, page);
    }
}

/// The largest of all.
fn largest(shares: &[f64]) -> f64 {
    shares.iter().copied().fold(0.0, f64::max)
}
