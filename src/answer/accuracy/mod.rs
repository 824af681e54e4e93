//! What an accuracy study answers: error against work of every method and fidelity, and the stability map.

mod body;
mod map;
mod page;
mod tables;
mod verdict;

pub use body::AccuracyBody;

use super::left_out::left_out_of;
use super::{Answer, Envelope, Finding, Provenance};
use crate::accuracy::{
    CaseEnd, Drives, Judged, Precision, PrecisionSettings, WorkLimit, cases, map as stability_map, precision,
};
use crate::clutch::Scenario;
use crate::design::Design;
use crate::follow::{Follow, News};
use crate::report::{Page, Screen, Table};
use serde_json::json;
use std::time::Instant;

/// Scenes compared by default, where the design has them: sticking, repeatedly opening, high preload, last arc.
const USUAL: [&str; 4] = ["high-6", "high-10", "low-10", "rated-45"];

/// Whether all methods can run it.
pub fn is_torsional(scenario: &Scenario) -> bool {
    scenario.kind.frequency_hz().is_some()
}

/// Scenes compared where none is named: the usual ones that the design has, else every torsional one.
pub fn usual_scenarios(design: &Design) -> Vec<&Scenario> {
    let torsional = || design.scenarios.iter().filter(|s| is_torsional(s));
    let usual: Vec<_> = torsional().filter(|s| USUAL.contains(&s.name.as_str())).collect();
    if usual.is_empty() { torsional().collect() } else { usual }
}

/// What an accuracy study found.
#[derive(Debug, Clone)]
pub struct AccuracyStudy<'d> {
    /// The design.
    pub design: &'d Design,
    /// The scenes that all methods ran.
    pub scenes: Vec<Precision>,
    /// Scenes that have no start, with the reason.
    pub without_start: Vec<(String, String)>,
    /// Seed of the stability map.
    pub seed: u64,
    /// What a case of the map may cost.
    pub limit: WorkLimit,
    /// The map.
    pub cases: Vec<Judged>,
    /// Wall time of the map, s.
    pub map_time_s: f64,
    /// Whether it was stopped: scenes and cases are those that were finished.
    pub interrupted: bool,
}

impl<'d> AccuracyStudy<'d> {
    /// Every method on every scenario of `design`; [`PrecisionSettings::follow`] is told of each scenario that begins and each setting
    /// that is done.
    pub fn of(design: &'d Design, scenarios: &[&Scenario], settings: &PrecisionSettings) -> Self {
        let (mut scenes, mut without_start) = (Vec::new(), Vec::new());
        for scenario in scenarios {
            settings.follow.news(News::Begins(&scenario.name));
            match precision(scenario, settings) {
                Ok(Some(found)) => scenes.push(found),
                Ok(None) => break,
                Err(why) => without_start.push((scenario.name.clone(), why.to_string())),
            }
        }
        let interrupted = settings.follow.stopped();
        Self {
            design,
            scenes,
            without_start,
            seed: 0,
            limit: WorkLimit::default(),
            cases: Vec::new(),
            map_time_s: 0.0,
            interrupted,
        }
    }

    /// The same with a stability map of `count` cases, each made by `seed` and its number; `follow` is told of each. `most_steps_again`:
    /// as [`WorkLimit::most_steps_again`].
    pub fn with_map(self, seed: u64, count: usize, most_steps_again: Option<u64>, follow: &Follow) -> Self {
        let limit = WorkLimit { most_steps_again, follow: follow.clone(), ..WorkLimit::default() };
        let started = Instant::now();
        let cases = stability_map(&self.design.clutch, &cases(seed, count), &limit);
        let map_time_s = started.elapsed().as_secs_f64();
        Self { seed, limit, cases, map_time_s, interrupted: follow.stopped(), ..self }
    }

    /// Of the cases that a drive could have: how many start, and how many of them end without a verdict at a limit of work.
    fn of_drives(&self) -> [usize; 2] {
        let Some(drives) = Drives::of(&self.design.clutch) else { return [0; 2] };
        let count = |of: fn(CaseEnd) -> bool| {
            self.cases.iter().filter(|c| drives.have(&c.case) && of(c.outcomes[0])).count()
        };
        [count(CaseEnd::starts), count(CaseEnd::met_a_limit)]
    }
}

impl Answer for AccuracyStudy<'_> {
    type Body<'a>
        = AccuracyBody<'a>
    where
        Self: 'a;

    fn outcome(&self) -> Finding {
        if self.interrupted { Finding::Stopped } else { Finding::Shown }
    }

    fn verdict(&self) -> String {
        page::verdict(self).1
    }

    /// Every point of every scene.
    fn table(&self) -> Table {
        tables::points(self.scenes.iter().flat_map(tables::points_of)).table()
    }

    fn text(&self, screen: Screen) -> String {
        tables::text(self, screen)
    }

    fn page(&self, provenance: &Provenance) -> Page {
        page::page(self, provenance)
    }

    fn envelope(&self, run_time_s: f64) -> Envelope<'_, AccuracyBody<'_>> {
        let worst = self.scenes.iter().map(|s| s.reference_error[0]).fold(0.0, f64::max);
        Envelope {
            design: self.design,
            run_time_s,
            left_out: left_out_of(self.design),
            error_estimate: Some(json!(worst)),
            body: AccuracyBody::of(self),
        }
    }
}
