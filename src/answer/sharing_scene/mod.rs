//! A scene with its sprags one by one: who catches, who slips, what each carries over time.

mod body;
mod words;

pub use body::{SharingSceneBody, SpragRow};

use super::page::{half, opened};
use super::sharing::NoSharing;
use super::{Answer, Envelope, Finding, Provenance};
use crate::design::Design;
use crate::dynamics::{ManySample, SpragCourse, Stop};
use crate::report::{Page, Plot, Screen, Table, Unit};
use crate::scenario::Settings;
use crate::sprags::{EachSprag, NoEachSprag, each_sprag};
use std::fmt;

/// Samples of the shares over time where nobody asks for another number.
const SAMPLES: usize = 401;

/// What became of each sprag of a design in one of its scenes.
#[derive(Debug, Clone)]
pub struct SharingSceneAnswer<'a> {
    design: &'a Design,
    /// Name of the scene.
    pub scene: String,
    /// What was found.
    pub found: EachSprag,
}

/// Why there is no answer.
#[derive(Debug, Clone, PartialEq)]
pub enum NoSharingScene {
    /// There is nothing to share.
    NoSharing(NoSharing),
    /// No scenario of this name; those that there are.
    NoSuchScene(String, Vec<String>),
    /// The scene cannot be run with its sprags one by one.
    NoRun(NoEachSprag),
}

impl fmt::Display for NoSharingScene {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSharing(why) => why.fmt(f),
            Self::NoSuchScene(name, there) if there.is_empty() => {
                write!(f, "no scenario \"{name}\": the design has no [[scenarios]]")
            }
            Self::NoSuchScene(name, there) => {
                write!(f, "no scenario \"{name}\"; allowed: {}", there.join(", "))
            }
            Self::NoRun(why @ NoEachSprag::NoneCarries) => {
                write!(f, "{why}; `sharing` without --scenario says of each why")
            }
            Self::NoRun(why @ NoEachSprag::OffCentre(_, apart_m)) => {
                write!(f, "{why} (up to {:.0} um; bearing_stiffness_n_per_um)", 1e6 * apart_m)
            }
            Self::NoRun(why) => why.fmt(f),
        }
    }
}

impl std::error::Error for NoSharingScene {}

impl Design {
    /// The scene `name` with its sprags as `[sharing]` has them; [`Settings::samples`] of 0: as many as a page shows.
    ///
    /// # Errors
    /// [`NoSharingScene`].
    pub fn sharing_in_scene(
        &self,
        name: &str,
        settings: &Settings,
    ) -> Result<SharingSceneAnswer<'_>, NoSharingScene> {
        let sharing = self.sharing.as_ref().ok_or(NoSharingScene::NoSharing(NoSharing::NoTable))?;
        let there = || self.scenarios.iter().map(|s| s.name.clone()).collect();
        let scene =
            self.scenario(name).ok_or_else(|| NoSharingScene::NoSuchScene(name.to_owned(), there()))?;
        let samples = if settings.samples == 0 { SAMPLES } else { settings.samples };
        let settings = Settings { samples, ..settings.clone() };
        let found = each_sprag(scene, sharing, &settings).map_err(NoSharingScene::NoRun)?;
        Ok(SharingSceneAnswer { design: self, scene: name.to_owned(), found })
    }
}

impl SharingSceneAnswer<'_> {
    fn course(&self, sprag: usize) -> Option<&SpragCourse> {
        Some(&self.found.run.courses[self.found.group[sprag]?])
    }

    /// Index of the sprag of which `of` is largest, and that; `None` where none carries.
    fn most(&self, of: impl Fn(&SpragCourse) -> f64) -> Option<(usize, f64)> {
        let each = (0..self.found.sprags.len()).filter_map(|i| Some((i, of(self.course(i)?))));
        each.reduce(|best, next| if next.1 > best.1 { next } else { best })
    }

    /// The largest share of the load, whose, and when, s.
    pub fn largest_share(&self) -> Option<(usize, f64, f64)> {
        let (i, share) = self.most(|c| c.share)?;
        Some((i, share, self.course(i)?.share_s))
    }

    /// Sprags in the order in which they catch; those of one time in that of their numbers.
    pub fn catching(&self) -> Vec<usize> {
        let at = |i: usize| self.course(i).and_then(|c| c.catches_s);
        let mut order: Vec<usize> = (0..self.found.sprags.len()).filter(|&i| at(i).is_some()).collect();
        order.sort_by(|a, b| at(*a).partial_cmp(&at(*b)).unwrap_or(std::cmp::Ordering::Equal));
        order
    }

    /// Whether sprag `i` slips under load once it has caught, by more than counts.
    fn slips(&self, i: usize) -> bool {
        self.found.group[i].is_some_and(|g| self.found.slips(g))
    }

    /// The sprag that does so first, and when, s.
    pub fn first_slip(&self) -> Option<(usize, f64)> {
        let those = (0..self.found.sprags.len()).filter(|&i| self.slips(i));
        let each = those.filter_map(|i| Some((i, self.course(i)?.slips?.t_s)));
        each.reduce(|best, next| if next.1 < best.1 { next } else { best })
    }

    /// Sprags that pass their highest place's beginning, the end of their curve, in the order in which they do, and when, s.
    pub fn over(&self) -> Vec<(usize, f64)> {
        let at = |i: usize| Some((i, self.course(i)?.over_s?));
        let mut all: Vec<(usize, f64)> = (0..self.found.sprags.len()).filter_map(at).collect();
        all.sort_by(|a, b| a.1.total_cmp(&b.1));
        all
    }

    /// How many of them have lost contact for good.
    pub fn gone(&self) -> usize {
        (0..self.found.sprags.len()).filter(|&i| self.course(i).is_some_and(|c| c.gone_s.is_some())).count()
    }

    /// How many sprags do.
    pub fn slipping(&self) -> usize {
        (0..self.found.sprags.len()).filter(|&i| self.slips(i)).count()
    }

    /// Why the run did not come to its end, and what would let it; `None`: it did, or what happened is an answer.
    pub fn given_up(&self) -> Option<String> {
        let (run, [steps, changes]) = (&self.found.run, self.found.limits);
        let at = Unit::Second.show(run.t_s, 4);
        let done = run.counters.steps + run.counters.rejections;
        match run.stop {
            Stop::StepLimit if done >= steps => Some(format!(
                "the run met its limit of {steps} steps at {at}; --max-steps with a larger number would take it further"
            )),
            Stop::StepLimit => Some(format!("steps became too short at {at}")),
            Stop::EventLimit => Some(format!(
                "the run met its limit of {changes} changes at {at}; --max-steps with a larger number would take it further"
            )),
            Stop::NotFinite => Some(format!("the equations ceased to be finite at {at}")),
            Stop::Interrupted => Some(format!("stopped by Ctrl-C at {at} of the scene")),
            _ => None,
        }
    }

    /// The same as a table.
    pub fn by_sprag(&self) -> Table {
        self.rows().table()
    }

    /// What the bearings hold over time.
    fn bearings(&self) -> Plot {
        let point = |s: &ManySample| [Unit::Millisecond.from_si(s.t_s), s.bearing_n];
        let points = self.found.run.samples.iter().map(point).collect();
        Plot::new("Time, ms", "Bearings hold, N").curve("bearings", points)
    }

    /// Shares, or forces, over time; one curve for sprags alike.
    fn over_time(&self, shares: bool) -> Plot {
        let mut plot = Plot::new("Time, ms", if shares { "Share of the mean" } else { "N inner, N" });
        for g in 0..self.found.counts.len() {
            let Some(i) = self.found.group.iter().position(|of| *of == Some(g)) else { continue };
            let point = |s: &ManySample| {
                let value = if shares { self.shares(s)[i] } else { s.normal_n[g] };
                [Unit::Millisecond.from_si(s.t_s), value]
            };
            let points = self.found.run.samples.iter().map(point).collect();
            plot = plot.curve(&format!("sprag {}", i + 1), points);
        }
        plot
    }
}

impl Answer for SharingSceneAnswer<'_> {
    type Body<'a>
        = SharingSceneBody<'a>
    where
        Self: 'a;

    fn outcome(&self) -> Finding {
        match self.found.run.stop {
            Stop::Interrupted => Finding::Stopped,
            stop if stop.gave_up() => Finding::NotKnown,
            _ => Finding::of(self.held()),
        }
    }

    fn held(&self) -> bool {
        self.design.scenario(&self.scene).is_some_and(|scenario| self.found.held(scenario))
    }

    fn verdict(&self) -> String {
        self.verdict_words()
    }

    fn part(&self) -> Option<String> {
        self.given_up()
    }

    fn table(&self) -> Table {
        self.by_sprag()
    }

    fn text(&self, screen: Screen) -> String {
        format!(
            "{}  {}  {}\n\n{}\n{}\n{}\n",
            self.design.name,
            self.design.short_hash(),
            self.scene,
            self.by_sprag().to_text(screen),
            self.remarks().join("\n"),
            self.verdict()
        )
    }

    fn page(&self, provenance: &Provenance) -> Page {
        let mut page = opened("Sharing in a scene", self.design, &provenance.command, |page| {
            page.verdict(self.held(), &self.verdict());
        });
        page.list(self.remarks());
        page.figures(&[
            (half(self.over_time(true)), "Normal force of each kind of sprag over the mean of all places."),
            (half(self.over_time(false)), "Normal force of each kind of sprag at the inner race."),
        ]);
        if self.found.axes.is_some() {
            page.figures(&[(half(self.bearings()), "What the bearings of the axes hold.")]);
        }
        page.heading("Sprags")
            .table("Forces and friction at their largest over the scene.", &self.by_sprag());
        self.envelope(provenance.run_time_s).close(&mut page);
        page
    }

    fn envelope(&self, run_time_s: f64) -> Envelope<'_, SharingSceneBody<'_>> {
        let (design, left_out) = (self.design, self.left_out());
        Envelope { design, run_time_s, left_out, error_estimate: None, body: SharingSceneBody::of(self) }
    }
}
