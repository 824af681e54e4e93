//! Overrun on a film: drag, heat, temperatures, growth of the swing, wear, over speeds and temperatures; a slip.

mod body;
mod page;
mod tables;
mod warm;
mod words;

pub use body::{OverrunBody, SlipBody};
pub use tables::OverrunPart;
pub use warm::WarmClutch;
pub(in crate::answer) use words::SHOWN_LATER;

use super::left_out::{LeftOut, left_out_of};
use super::{Finding, Said};
use crate::clutch::{Clutch, Lubrication};
use crate::design::{Design, rad_s};
use crate::life::{HourlyWear, SlipEffect, hourly_wear, slip_effect};
use crate::margin::{
    LIFT_OFF_TO_RAD_S, LoadState, NoMargins, OverrunPoint, lift_off_rad_s, load_state, overrun_at,
};
use crate::numeric::setting::{BadSetting, all_in_range};
use crate::report::{Page, Screen, Table, Tone, Unit};
use serde_json::{Value, json};

/// Which race runs; the other stands.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum RunningRace {
    /// The inner race, past sprags that stand, or with those that its cage carries.
    #[default]
    Inner,
    /// The outer race, and the sprags with it unless a cage carries them with the inner one: they feel their centrifugal force.
    Outer,
}

impl RunningRace {
    /// In a word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Inner => "inner",
            Self::Outer => "outer",
        }
    }
}

/// What is asked.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OverrunQuestion {
    /// Race that runs.
    pub race: RunningRace,
    /// Speeds, rad/s; none: 1, 2, 5 ... up to lift-off and 50 m/s, and those of the overruns and, of the outer race, of the limits
    /// that the design names.
    pub speeds_rad_s: Vec<f64>,
    /// Temperatures of the oil, C; none: that of the file.
    pub temperatures_c: Vec<f64>,
}

/// One speed at one temperature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OverrunLine {
    /// Temperature of the oil, C.
    pub oil_c: f64,
    /// Speed, rad/s.
    pub speed_rad_s: f64,
    /// On the film.
    pub point: OverrunPoint,
    /// By the friction law (12) alone, as without `[lubrication]`.
    pub dry: OverrunPoint,
    /// Wear in an hour.
    pub wear: Option<HourlyWear>,
    /// Fit and gap at the temperatures of the bodies there; `None`: without a film, or not known.
    pub warm: Option<WarmClutch>,
}

/// The overrun of a design.
#[derive(Debug, Clone)]
pub struct OverrunAnswer<'a> {
    design: &'a Design,
    lubrication: &'a Lubrication,
    state: LoadState,
    /// What was asked.
    pub question: OverrunQuestion,
    /// Those of its speeds that were asked for, or that the design names; the others are usual ones.
    named_rad_s: Vec<f64>,
    /// Whether the speeds were asked for.
    asked: bool,
    /// Temperatures one after another, speeds in each.
    pub lines: Vec<OverrunLine>,
    /// The first line at whose temperatures there is no clutch, or fit and gap are not known, and why.
    pub no_clutch: Option<(OverrunLine, String)>,
    /// Fit and gap as the file has them.
    pub filed: WarmClutch,
    /// Speed of the race that the sprags ride with at which they lift off, rad/s: it does not depend on friction, which ends with the
    /// force at the sliding contact.
    pub lift_off_rad_s: Option<f64>,
    /// The slip that the file asks for.
    pub slip: Option<SlipEffect>,
}

/// Why there is none.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoOverrun {
    /// The design has no `[lubrication]`.
    #[error(
        "the design has no [lubrication] table; add one, such as\n\n{EXAMPLE}\n\n`sprag-design explain \
         lubrication` lists its keys"
    )]
    NoLubrication,
    /// There is no clutch to speak of.
    #[error("{0}")]
    NoClutch(NoMargins),
    /// There is none at that speed.
    #[error("at {} of the {} race: {why}", Unit::Rpm.show(*speed_rad_s, 4), race.name())]
    AtSpeed {
        /// The race that runs.
        race: RunningRace,
        /// Its speed, rad/s.
        speed_rad_s: f64,
        /// Why there is none.
        why: NoMargins,
    },
    /// A speed or a temperature out of its range.
    #[error("{0}")]
    Setting(BadSetting),
}

/// Temperatures of the oil that may be asked for, C: those of `lubrication.temperature_c`.
pub const OIL_TEMPERATURES_C: [f64; 2] = [-60.0, 250.0];
/// Speeds of a race that may be asked for, rad/s: up to 100 000 rev/min; 0 is none.
pub const OVERRUN_SPEEDS_RAD_S: [f64; 2] = [f64::MIN_POSITIVE, 1e5 * std::f64::consts::PI / 30.0];

impl OverrunQuestion {
    /// Refuse speeds and temperatures at which no clutch runs.
    ///
    /// # Errors
    /// [`BadSetting`].
    pub fn validate(&self) -> Result<(), BadSetting> {
        all_in_range("speed (rad/s)", &self.speeds_rad_s, OVERRUN_SPEEDS_RAD_S)?;
        all_in_range("temperature (C)", &self.temperatures_c, OIL_TEMPERATURES_C)
    }
}

/// A table to begin with.
pub const EXAMPLE: &str = "[lubrication]\noil = \"ISO VG 32\"          # `sprag-design oils`\ntemperature_c = 60.0\n\
                           race_roughness_um = 0.25   # Rq\nsprag_roughness_um = 0.25  # Rq";

/// Speeds where none are asked for, rev/min.
const USUAL_RPM: [f64; 10] = [5.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 5000.0, 10_000.0];
/// Speed of the track beyond which nobody runs such a clutch unless the file says so, m/s.
const FASTEST_M_S: f64 = 50.0;

/// Usual speeds at which a race slides, rad/s, ascending.
pub(super) fn usual_speeds_rad_s() -> impl Iterator<Item = f64> {
    USUAL_RPM.iter().map(|&rpm| rad_s(rpm))
}

impl Design {
    /// The race that the sprags ride with in overrun.
    pub(super) fn sprags_ride_with(&self) -> RunningRace {
        if self.clutch.slides_outside() { RunningRace::Inner } else { RunningRace::Outer }
    }

    /// Whether the sliding ends at a speed of `race`: in a driven cage a film goes on beyond.
    fn ends_at_lift_off(&self, race: RunningRace) -> bool {
        self.sprags_ride_with() == race && !self.clutch.slides_outside()
    }

    /// Speeds of `race` in steady overruns that the design names, in scenarios and, of the race that the sprags ride with, in limits,
    /// rad/s; those of engagements, which only begin so, too.
    fn named_speeds_rad_s(&self, race: RunningRace) -> Vec<f64> {
        let of_scenes = self.scenarios.iter().filter_map(|s| match (s.kind.overrun_rad_s()?, race) {
            ([ahead, 0.0], RunningRace::Inner) => Some(ahead),
            ([_, outer], RunningRace::Outer) => (outer > 0.0).then_some(outer),
            _ => None,
        });
        let limits = [self.limits.keep_contact_to_rad_s, self.limits.lift_off_by_rad_s];
        let of_limits =
            limits.into_iter().flatten().filter(|speed| self.sprags_ride_with() == race && *speed > 0.0);
        of_scenes.chain(of_limits).collect()
    }

    /// Overrun on the film that `[lubrication]` names.
    ///
    /// # Errors
    /// [`NoOverrun`].
    pub fn overrun(&self, question: &OverrunQuestion) -> Result<OverrunAnswer<'_>, NoOverrun> {
        question.validate().map_err(NoOverrun::Setting)?;
        let lubrication = self.clutch.lubrication.as_ref().ok_or(NoOverrun::NoLubrication)?;
        let state = load_state(self).map_err(NoOverrun::NoClutch)?;
        let lift_off = lift_off_rad_s(self, &state, LIFT_OFF_TO_RAD_S);
        let mut question = question.clone();
        // Who asks for a speed names it.
        let mut named = question.speeds_rad_s.clone();
        let asked = !named.is_empty();
        if question.temperatures_c.is_empty() {
            question.temperatures_c.push(lubrication.temperature_c);
        }
        if question.speeds_rad_s.is_empty() {
            let track = self.clutch.sliding_track_m();
            let lift = lift_off.filter(|_| self.ends_at_lift_off(question.race)).unwrap_or(f64::INFINITY);
            let usual = usual_speeds_rad_s().filter(|w| *w < lift && *w * track <= FASTEST_M_S);
            named = self.named_speeds_rad_s(question.race);
            question.speeds_rad_s = usual.chain(named.iter().copied()).collect();
            question.speeds_rad_s.sort_by(f64::total_cmp);
            question.speeds_rad_s.dedup_by(|a, b| (*a - *b).abs() < 1e-9 * *b);
        }
        let (mut lines, mut no_clutch) = (Vec::new(), None);
        for &oil_c in &question.temperatures_c {
            let there = OilAt::new(self, oil_c);
            for &speed in &question.speeds_rad_s {
                let race = question.race;
                let found = there.line(&state, race, speed);
                let mut line = found.map_err(|why| NoOverrun::AtSpeed { race, speed_rad_s: speed, why })?;
                let heat = line.point.lubricated.map(|film| film.heat);
                match heat.map(|heat| WarmClutch::at(self, &heat.temperatures)) {
                    Some(Ok(warm)) => line.warm = Some(warm),
                    Some(Err(why)) if no_clutch.is_none() => no_clutch = Some((line, why)),
                    _ => {}
                }
                lines.push(line);
            }
        }
        let slip = slip_effect(self, &state);
        Ok(OverrunAnswer {
            design: self,
            lubrication,
            filed: WarmClutch::of(self, &state),
            state,
            question,
            named_rad_s: named,
            asked,
            lines,
            no_clutch,
            lift_off_rad_s: lift_off,
            slip,
        })
    }
}

/// The design with its oil at another temperature, and without.
struct OilAt {
    oil_c: f64,
    wet: Design,
    dry: Design,
}

impl OilAt {
    fn new(design: &Design, oil_c: f64) -> Self {
        let with = |lubrication| Design {
            clutch: Clutch { lubrication, ..design.clutch.clone() },
            ..design.clone()
        };
        let wet = with(design.clutch.lubrication.map(|l| Lubrication { temperature_c: oil_c, ..l }));
        Self { oil_c, wet, dry: with(None) }
    }

    fn line(&self, state: &LoadState, race: RunningRace, speed_rad_s: f64) -> Result<OverrunLine, NoMargins> {
        let [outer, ahead] = match race {
            RunningRace::Outer => [speed_rad_s, -speed_rad_s],
            RunningRace::Inner => [0.0, speed_rad_s],
        };
        let at = |design: &Design| overrun_at(design, state, outer, ahead).map_err(NoMargins::Curve);
        let (point, dry) = (at(&self.wet)?, at(&self.dry)?);
        let wear = hourly_wear(&self.wet, &point);
        Ok(OverrunLine { oil_c: self.oil_c, speed_rad_s, point, dry, wear, warm: None })
    }
}

impl OverrunAnswer<'_> {
    /// Whether fit and gap are known at any line.
    fn knows_warm(&self) -> bool {
        self.lines.iter().any(|l| l.warm.is_some())
    }
}

impl Said for OverrunAnswer<'_> {
    type Body<'a>
        = OverrunBody<'a>
    where
        Self: 'a;

    fn title(&self) -> &str {
        "Overrun on a film of oil"
    }

    fn design(&self) -> &Design {
        self.design
    }

    fn outcome(&self) -> Finding {
        Finding::Shown
    }

    fn verdict(&self) -> String {
        self.headline()
    }

    fn banner(&self) -> (Tone, String) {
        (self.tone(), self.verdict())
    }

    fn remarks(&self) -> Vec<String> {
        [self.picked()].into_iter().chain(self.warnings()).chain(self.about()).collect()
    }

    fn table(&self) -> Table {
        self.all().table()
    }

    fn tables(&self, screen: Screen) -> String {
        let warm = self.knows_warm().then_some(OverrunPart::Warm);
        let parts =
            [OverrunPart::Film, OverrunPart::Heat].into_iter().chain(warm).chain([OverrunPart::Swing]);
        parts.map(|part| self.part(part).to_text(screen)).collect::<Vec<_>>().join("\n")
    }

    fn body(&self) -> OverrunBody<'_> {
        OverrunBody::of(self)
    }

    fn error_estimate(&self) -> Option<Value> {
        let films = self.lines.iter().filter_map(|l| l.point.lubricated.as_ref());
        Some(json!({ "heat_balance": films.map(|film| film.heat.balance_error()).fold(0.0, f64::max) }))
    }

    fn left_out(&self) -> Vec<LeftOut> {
        words::left_out(self).into_iter().chain(left_out_of(self.design)).collect()
    }

    fn draw(&self, page: &mut Page) {
        page::draw(self, page);
    }
}
