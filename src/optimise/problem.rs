//! The clutch as a vector and its margins.

mod slopes;
mod sprags;

use super::corner::{Corner, perturbed};
use super::evaluate::{Evaluation, NoEvaluation};
use super::goal::{Goal, Measure, measures};
use super::grid::made;
use super::side_by_side::SideBySide;
use super::smooth;
use crate::clutch::Scenario;
use crate::design::{Design, LIMIT_KEYS, LimitKey, Limits, Link, Objective, Optimize};
use crate::fidelity::{self, Effort};
use crate::file::{DesignForm, EditError, content, with_limits, with_values};
use crate::margin::{
    Ahead, Capacities, LoadRows, LoadState, Margin, NoMargins, RESOLUTION, SceneDemand, When,
    load_state_with, scene_margins, scene_rows,
};
use crate::scenario::{AtRest, Prepared, RollingTrack, Settings, demand, demand_tracked};
use std::sync::{Arc, OnceLock};

/// How an evaluation is computed.
#[derive(Debug, Clone)]
pub struct Fidelity {
    /// Of the scenarios' runs.
    pub settings: Settings,
    /// Whether scenes run without the terms that they cannot feel, as `fidelity` plans them.
    pub reduced: bool,
}

impl Default for Fidelity {
    fn default() -> Self {
        Self { settings: Settings::default(), reduced: true }
    }
}

impl Fidelity {
    /// Everything runs, at a tenth of the tolerance or of the usual one, whichever is less: what an optimum is looked at
    /// with once more.
    pub fn sharper(&self) -> Self {
        let tolerance = 0.1 * self.settings.tolerance.min(Settings::default().tolerance);
        let settings = Settings { tolerance, ..self.settings.clone() };
        Self { settings, reduced: false }
    }

    /// What of it an evaluation depends on, as text. Not who follows or stops it; the words in its place keep earlier
    /// journals valid.
    fn identity(&self) -> String {
        let Self { settings, reduced } = self;
        let Settings {
            tolerance,
            longest_step_s,
            samples,
            most_events,
            most_steps,
            energy,
            history,
            follow: _,
            // No search sets it.
            every_period: _,
            slip_heat: _,
        } = settings;
        format!(
            "Fidelity {{ settings: Settings {{ tolerance: {tolerance:?}, longest_step_s: {longest_step_s:?}, \
             samples: {samples:?}, most_events: {most_events:?}, most_steps: {most_steps:?}, energy: {energy:?}, \
             interrupt: None, history: {history:?}, clock: None }}, reduced: {reduced:?} }}"
        )
    }
}

/// A design file with some of its numbers free: make the least of its objectives better, subject to every margin.
#[derive(Debug, Clone)]
pub struct ClutchProblem {
    source: String,
    /// What of it an evaluation reads, with gaps for the variables; `None`: that is not to be had.
    form: OnceLock<Option<DesignForm>>,
    folder: std::path::PathBuf,
    histories: String,
    variables: Vec<String>,
    /// What goes with a variable of this name.
    links: Vec<(String, Link)>,
    limits: Limits,
    target: Vec<[f64; 2]>,
    scenarios: Vec<String>,
    goals: Vec<Goal>,
    corners: Vec<Corner>,
    /// What every limit of the clutch keeps of its margin.
    reserve: f64,
    fidelity: Fidelity,
    /// Whether margins may differ by less than their tolerance: see [`ClutchProblem::quickly`].
    quick: bool,
    /// Scenarios of `[check]`.
    checked: Vec<String>,
    /// Whether everything that `check` demands is a limit: see [`ClutchProblem::as_checked`].
    as_checked: bool,
    /// Of the latest evaluations.
    recent: slopes::Recent,
    /// Climbs on it and on what was made of it.
    pub(super) climbs: SideBySide,
    /// Whether the sprag has flanks.
    flanked: bool,
}

/// Rows of a scene at a corner, by its number.
type SceneRows<'a> = dyn Fn(usize, &Scenario, AtRest) -> Vec<Margin> + Sync + 'a;

/// The load state at a corner, by its number.
type StateAt<'a> = dyn Fn(usize, &Design) -> Result<Arc<LoadState>, NoMargins> + Sync + 'a;

/// The rows of a load state at a corner, by its number.
type LoadedRows<'a> = dyn Fn(usize, &Design, &LoadState) -> Vec<Margin> + Sync + 'a;

/// How an evaluation is taken; corners and scenes side by side within what shares threads.
struct Way<'a> {
    state: &'a StateAt<'a>,
    loaded: &'a LoadedRows<'a>,
    scene: &'a SceneRows<'a>,
}

/// Everything known of one clutch.
#[derive(Debug, Clone, PartialEq)]
pub struct Assessment {
    /// All required margins.
    pub rows: Vec<Margin>,
    /// What the goals raise, goal by goal.
    pub measures: Vec<Measure>,
}

/// What the optimiser's numbers stand for.
#[derive(Debug, Clone, PartialEq)]
pub struct Names {
    /// Code of each objective.
    pub objectives: Vec<String>,
    /// Margin code of each limit.
    pub limits: Vec<String>,
}

impl ClutchProblem {
    /// The task of `design`'s `[optimize]` table with `variables` free (all others stay).
    pub fn new(design: &Design, task: &Optimize, variables: Vec<String>, fidelity: Fidelity) -> Self {
        Self {
            source: design.source.clone(),
            form: OnceLock::new(),
            folder: design.folder.clone(),
            histories: design.histories(),
            variables,
            links: task
                .variables
                .iter()
                .flat_map(|v| v.links.iter().map(|l| (v.name.clone(), l.clone())))
                .collect(),
            limits: task.limits,
            target: task.target.clone(),
            scenarios: task.scenarios.clone(),
            goals: vec![Goal::plain(task.objective, &task.limits)],
            corners: vec![Corner::NOMINAL],
            reserve: task.reserve,
            fidelity,
            quick: false,
            checked: design.check_scenarios.clone(),
            as_checked: false,
            recent: slopes::Recent::default(),
            climbs: SideBySide::default(),
            flanked: design.clutch.sprags.flanks.is_some(),
        }
    }

    /// The task of `design` as other optimisers are given it: all variables free, each limit held as `check` does, without a reserve, quickly
    /// unless `full`.
    pub fn of_task(design: &Design, task: &Optimize, full: bool) -> Self {
        let variables = task.variables.iter().map(|v| v.name.clone()).collect();
        let fidelity = Fidelity { reduced: !full, ..Fidelity::default() };
        Self { reserve: 0.0, ..Self::new(design, task, variables, fidelity).quickly() }
    }

    /// The same problem with everything that `check` demands as a limit: the wanted slip margin even where slip is what is
    /// raised, the scenarios of `[check]`, the worst sprag off centre.
    pub fn as_checked(&self) -> Self {
        Self { as_checked: true, form: OnceLock::new(), ..self.clone() }
    }

    /// The same problem at a quarter of the work: quick curves and quick rolling runs, whose margins differ from those of
    /// [`Fidelity::settings`] by less than the tolerance there (by twice that with law `elastic`; test
    /// `an_evaluation_of_a_search_is_one_of_check`), and by 1e-11 or so where nothing should move them. Not for what asks whether a
    /// variable has any influence. Of no effect where everything is to run.
    pub fn quickly(&self) -> Self {
        Self { quick: self.fidelity.reduced, ..self.clone() }
    }

    /// The same problem with the whole work again: what asks whether a variable has any influence.
    pub fn fully(&self) -> Self {
        Self { quick: false, ..self.clone() }
    }

    /// What goes into the curves of an evaluation.
    fn effort(&self) -> Effort {
        if self.quick { Effort::Search } else { Effort::Full }
    }

    /// The same problem under other limits.
    pub fn under(&self, limits: Limits) -> Self {
        Self { limits, ..self.clone() }
    }

    /// The same problem with other goals.
    pub fn with_goals(&self, goals: Vec<Goal>) -> Self {
        Self { goals, ..self.clone() }
    }

    /// The same problem held at several corners of the tolerances at once: the least over all of them counts.
    pub fn at_corners(&self, corners: Vec<Corner>) -> Self {
        Self { corners, ..self.clone() }
    }

    /// The same problem with the lengths that go with a variable in steps of `step`, in their unit.
    pub fn with_links_in_steps(&self, step: f64) -> Self {
        let mut problem = Self { form: OnceLock::new(), ..self.clone() };
        for (_, link) in problem.links.iter_mut().filter(|(_, link)| made(&link.path)) {
            link.step = Some(step);
        }
        problem
    }

    /// The same problem on another design file.
    pub fn on(&self, source: String) -> Self {
        Self { source, form: OnceLock::new(), ..self.clone() }
    }

    /// The same problem with one of its scenarios alone.
    pub fn for_scenario(&self, name: &str) -> Self {
        Self { scenarios: vec![name.to_owned()], form: OnceLock::new(), ..self.clone() }
    }

    /// The same problem without its scenarios.
    pub fn at_rest(&self) -> Self {
        Self { scenarios: Vec::new(), form: OnceLock::new(), ..self.clone() }
    }

    /// The same problem at another fidelity.
    pub fn at_fidelity(&self, fidelity: Fidelity) -> Self {
        Self { quick: self.quick && fidelity.reduced, fidelity, ..self.clone() }
    }

    /// The same problem with other variables.
    pub fn over(&self, variables: Vec<String>) -> Self {
        Self { variables, form: OnceLock::new(), ..self.clone() }
    }

    /// Text of the design file.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// Names of the variables.
    pub fn variables(&self) -> &[String] {
        &self.variables
    }

    /// What goes with which variable.
    pub fn links(&self) -> &[(String, Link)] {
        &self.links
    }

    /// Limits.
    pub fn limits(&self) -> &Limits {
        &self.limits
    }

    /// Goals.
    pub fn goals(&self) -> &[Goal] {
        &self.goals
    }

    /// How evaluations are computed.
    pub fn fidelity(&self) -> &Fidelity {
        &self.fidelity
    }

    /// Everything that an evaluation depends on but x, as text: what a journal's entries belong to. Values of the
    /// variables are struck out, so that a file with other starts is the same problem; so is one with other comments.
    pub fn identity(&self) -> String {
        let links: Vec<_> = self.links.iter().filter(|(name, _)| self.variables.contains(name)).collect();
        let names = self.variables.iter().chain(links.iter().map(|(_, link)| &link.path));
        let zeros: Vec<(&str, f64)> = names.map(|name| (name.as_str(), 0.0)).collect();
        let source = with_values(&self.source, &zeros).unwrap_or_else(|_| self.source.clone());
        // The task's own bounds and seed do not enter a margin; what of it does follows, and the values of the histories.
        let said = content(&source, &["optimize"]).unwrap_or(source);
        let histories = &self.histories;
        let fidelity = self.fidelity.identity();
        let checked = if self.as_checked { format!("{:?}", self.checked) } else { String::new() };
        // Nothing where there is none, so that earlier journals stay valid.
        let reserve =
            if self.reserve > 0.0 { format!("reserve {:?} of loads\n", self.reserve) } else { String::new() };
        let links = if links.is_empty() { String::new() } else { format!("{links:?}\n") };
        let quick = if self.quick { "quickly\n" } else { "" };
        let flanked = if self.flanked && !self.frees_flanks() { "flanked\n" } else { "" };
        format!(
            "{quick}{links}{reserve}{flanked}{checked}{said}\n{histories}\n{:?}\n{:?}\n{:?}\n{:?}\n{:?}\n{:?}\n{fidelity}",
            self.variables, self.limits, self.target, self.scenarios, self.goals, self.corners
        )
    }

    /// The design file at `x`, in the units of the variables' names.
    ///
    /// # Errors
    /// [`EditError`] where a variable has no place in the file.
    pub fn file_at(&self, x: &[f64]) -> Result<String, EditError> {
        with_values(&self.source, &self.values_at(x))
    }

    /// Names or paths and values that `x` stands for: the variables, and what goes with them.
    fn values_at(&self, x: &[f64]) -> Vec<(&str, f64)> {
        let own: Vec<(&str, f64)> =
            self.variables.iter().map(String::as_str).zip(x.iter().copied()).collect();
        let linked = own.iter().flat_map(|&(name, value)| {
            let of_it = self.links.iter().filter(move |(variable, _)| variable == name);
            of_it.map(move |(_, link)| (link.path.as_str(), link.value(value)))
        });
        own.iter().copied().chain(linked).collect()
    }

    /// The design at `x`.
    ///
    /// # Errors
    /// [`NoEvaluation::Refused`] with the first reason where the geometry at `x` is impossible.
    pub fn design_at(&self, x: &[f64]) -> Result<Design, NoEvaluation> {
        let text = self.file_at(x).map_err(|e| NoEvaluation::Refused(e.to_string()))?;
        self.parsed(&text)
    }

    /// A changed file as a design.
    ///
    /// # Errors
    /// As [`Self::design_at`].
    pub fn parsed(&self, text: &str) -> Result<Design, NoEvaluation> {
        Design::parse_in(&self.folder, text, "candidate").map_err(|e| {
            let first = e.problems().first().map_or(String::new(), |p| format!("{}: {}", p.key, p.allowed));
            NoEvaluation::Refused(first)
        })
    }

    /// All required margins of `design` (those of the static limits, and slip and contact of each scenario) and what
    /// the goals raise.
    ///
    /// # Errors
    /// [`NoEvaluation::Refused`] where there is no clutch to speak of.
    pub fn assess(&self, design: &Design) -> Result<Assessment, NoEvaluation> {
        let loaded = |_, design: &Design, state: &LoadState| self.loaded(design, state).rows;
        self.assess_with(
            design,
            &Way { state: &self.state(), loaded: &loaded, scene: &self.rows_of_scene() },
            0,
        )
    }

    /// Load states built at the problem's effort, with the curves at speed that its scenes ask for where these run reduced.
    fn state(&self) -> impl Fn(usize, &Design) -> Result<Arc<LoadState>, NoMargins> + Sync {
        |_, design| self.state_beside(design, None).map(Arc::new)
    }

    /// One of them; `like`: that of a clutch next to it.
    fn state_beside(&self, design: &Design, like: Option<&LoadState>) -> Result<LoadState, NoMargins> {
        let of_it = |s: &&Scenario| self.scenarios.contains(&s.name) && s.clutch == design.clutch;
        let scenes = design.scenarios.iter().filter(|_| self.fidelity.reduced).filter(of_it);
        let asked = fidelity::curves_asked(scenes);
        let ahead = Ahead { asked, side_by_side: self.climbs.spreads() };
        load_state_with(design, self.effort(), like, &ahead)
    }

    /// The required rows of a load state.
    fn loaded(&self, design: &Design, state: &LoadState) -> LoadRows {
        let raised = self.goals.iter().any(|g| g.objective == Objective::TorqueCapacity);
        let capacities = if raised { Capacities::Wanted } else { Capacities::LeftOut };
        let mut found = smooth::load_rows(design, &self.limits, capacities, state);
        found.rows.retain(|m| m.required);
        let keep = if self.frees_flanks() { smooth::ROOM } else { 0.0 };
        found.rows.extend(smooth::flank_rows(design, state, keep));
        found
    }

    /// Whether flanks are variables.
    fn frees_flanks(&self) -> bool {
        self.variables.iter().any(|v| v.starts_with("flank_") || v.starts_with("sprags.flanks."))
    }

    /// Scenes run at the problem's fidelity.
    fn rows_of_scene(&self) -> impl Fn(usize, &Scenario, AtRest) -> Vec<Margin> + Sync {
        |_, scenario, known| self.scene(scenario, known).0
    }

    /// The same at corner `k`, on its way.
    fn assess_with(&self, design: &Design, way: &Way, k: usize) -> Result<Assessment, NoEvaluation> {
        let state = (way.state)(k, design).map_err(|e| NoEvaluation::Refused(e.to_string()))?;
        let loaded = || (way.loaded)(k, design, &state);
        let scenes = |wanted: &(dyn Fn(&String) -> bool + Sync)| {
            let asked: Vec<&Scenario> = design.scenarios.iter().filter(|s| wanted(&s.name)).collect();
            let steps = |scenario: &&Scenario| self.recent.steps(k, &scenario.name);
            let rows = |(_, scenario): (usize, &&Scenario)| (way.scene)(k, scenario, state.at_rest(design));
            let rows = self.climbs.each(&asked, steps, rows).concat();
            // A run that met its limit of work says nothing of the design: no margins rather than bad ones.
            match rows.iter().find(|r| !r.computed()) {
                Some(row) => Err(NoEvaluation::Refused(row.full_name())),
                None => Ok(rows),
            }
        };
        let own = || scenes(&|name| self.scenarios.contains(name));
        let (mut rows, of_scenes) = self.climbs.both(loaded, own);
        rows.extend(of_scenes?);
        let mut measures_of_goals = Vec::new();
        for (k, goal) in self.goals.iter().enumerate() {
            let found = measures(goal.objective, design, &self.limits, &self.target, &state, &rows);
            measures_of_goals.extend(found.into_iter().map(|m| Measure { goal: k, ..m }));
        }
        if self.as_checked {
            rows.extend(scenes(&|name| self.checked.contains(name) && !self.scenarios.contains(name))?);
            rows.extend(self.rows_of_sprags(design, &state));
        }
        Ok(Assessment { rows, measures: measures_of_goals })
    }

    /// The rows of a scene, and what it integrated, with the model that it did that for, where that can be taken again.
    fn scene(&self, scenario: &Scenario, known: AtRest) -> (Vec<Margin>, Option<(RollingTrack, Prepared)>) {
        let Fidelity { settings, reduced } = &self.fidelity;
        let whole = || (scene_margins(scenario, &self.limits, true, Some(known), settings), None);
        if !reduced {
            return whole();
        }
        let Ok((plan, prepared)) = fidelity::plan_at(scenario, Some(known), self.effort()) else {
            return whole();
        };
        let (found, track) = match self.quick {
            true => demand_tracked(&prepared, settings),
            false => (demand(&prepared, settings), None),
        };
        // A run that needs more of the curve than was built is repeated with all of it.
        if !found.finished && plan.reduction.reach_nm.is_some() {
            return whole();
        }
        let rows = scene_rows(scenario, &SceneDemand::of(scenario, &prepared, found), &self.limits, true);
        (rows, track.map(|track| (track, prepared)))
    }

    /// The design at `x` without the scenarios that no margin is asked of; where that is refused, the whole one says why.
    fn asked_at(&self, x: &[f64]) -> Result<Design, NoEvaluation> {
        let form = self.form.get_or_init(|| {
            let asked = |name: &str| {
                let among = |names: &[String]| names.iter().any(|n| n == name);
                among(&self.scenarios) || self.as_checked && among(&self.checked)
            };
            let names: Vec<String> = self.values_at(x).iter().map(|(name, _)| (*name).to_owned()).collect();
            DesignForm::of(&self.source, &self.folder, &names, &asked)
        });
        let values: Vec<f64> = self.values_at(x).iter().map(|(_, value)| *value).collect();
        form.as_ref().and_then(|form| form.at(&values)).map_or_else(|| self.design_at(x), Ok)
    }

    /// All required margins at `x`, at every corner.
    ///
    /// # Errors
    /// [`NoEvaluation::Refused`] where there is no clutch at `x`.
    pub fn assess_at(&self, x: &[f64]) -> Result<Assessment, NoEvaluation> {
        let loaded = |_, design: &Design, state: &LoadState| self.loaded(design, state).rows;
        self.assess_at_with(x, &Way { state: &self.state(), loaded: &loaded, scene: &self.rows_of_scene() })
    }

    /// The same on its way.
    fn assess_at_with(&self, x: &[f64], way: &Way) -> Result<Assessment, NoEvaluation> {
        let design = self.asked_at(x)?;
        let at = |(k, corner): (usize, &Corner)| {
            if corner.is_nominal() {
                return self.assess_with(&design, way, k);
            }
            let there = perturbed(&design, corner).map_err(|e| NoEvaluation::Refused(e.to_string()))?;
            let mut found = self.assess_with(&there, way, k)?;
            let name = corner.name();
            found.rows.iter_mut().for_each(|r| r.corner = Some(name.clone()));
            found.measures.iter_mut().for_each(|m| m.code = format!("{} @ {name}", m.code));
            Ok(found)
        };
        let mut all = Assessment { rows: Vec::new(), measures: Vec::new() };
        for found in self.climbs.each(&self.corners, |_| 0, at) {
            let found = found?;
            all.rows.extend(found.rows);
            all.measures.extend(found.measures);
        }
        Ok(all)
    }

    /// Whether slip margins are raised, and so are no limits of a climb.
    fn raises_slip(&self) -> bool {
        !self.as_checked && self.goals.iter().all(|g| g.objective == Objective::SlipMargin)
    }

    /// Whether the row is one that is raised.
    pub fn is_raised(&self, m: &Margin) -> bool {
        self.raises_slip() && m.is_slip()
    }

    fn is_limit(&self, m: &Margin) -> bool {
        !self.is_raised(m)
    }

    /// What every limit keeps of its margin.
    pub fn reserve(&self) -> f64 {
        self.reserve
    }

    /// What a margin keeps: nothing where it is room in the outline, which strains nothing, or beside what is searched.
    pub(super) fn kept(&self, m: &Margin) -> f64 {
        if m.limit.when == When::Outline || self.is_beside(m) { 0.0 } else { self.reserve }
    }

    /// A margin as a constraint, 0 or more being held: what is left of it beyond the reserve.
    pub fn left(&self, m: &Margin) -> f64 {
        m.margin() - self.kept(m)
    }

    /// Whether a margin is held with the reserve.
    pub fn held(&self, m: &Margin) -> bool {
        self.left(m) >= -RESOLUTION
    }

    /// Names in the order of [`Evaluation`].
    pub fn names(&self, assessed: &Assessment) -> Names {
        Names {
            objectives: assessed.measures.iter().map(|m| m.code.clone()).collect(),
            limits: assessed.rows.iter().filter(|m| self.is_limit(m)).map(|m| m.code()).collect(),
        }
    }

    /// The rows that are limits, in the order of [`Evaluation`].
    pub fn limit_rows<'r>(&self, rows: &'r [Margin]) -> Vec<&'r Margin> {
        rows.iter().filter(|m| self.is_limit(m)).collect()
    }

    /// Places among them of what flanks have left that are no variables.
    pub(super) fn room_places(&self, rows: &[Margin]) -> Vec<usize> {
        if self.frees_flanks() {
            return Vec::new();
        }
        let limits = self.limit_rows(rows).into_iter().enumerate();
        limits.filter(|(_, row)| row.limit.when == When::Outline).map(|(place, _)| place).collect()
    }

    /// Objectives, each (measure - from)/span of its goal; limits; and the largest Hertz pressure in GPa as the tie
    /// break.
    pub fn evaluation(&self, assessed: &Assessment) -> Evaluation {
        let pressure = assessed.rows.iter().filter(|m| m.is_static_pressure());
        let pressed = self.goals.iter().any(|g| g.objective == Objective::PeakPressure);
        Evaluation {
            objectives: assessed.measures.iter().map(|m| self.goals[m.goal].scaled(m.value)).collect(),
            limits: self.limit_rows(&assessed.rows).iter().map(|m| self.left(m)).collect(),
            // MPa to GPa.
            tie_break: match pressed {
                true => 0.0,
                false => pressure.filter_map(Margin::demand_in_unit).map(|p| p * 1e-3).fold(0.0, f64::max),
            },
        }
    }

    /// How far the worst limit of `e` is missed, or a raised slip margin that of [`Limits`], which is no limit of a climb; 0: none is.
    pub fn missed(&self, e: &Evaluation) -> f64 {
        e.violation().max(-self.wanted_left(e).unwrap_or(0.0))
    }

    /// What the least slip margin, where that is raised, leaves of the wanted one, as a row of `check` does; `None` where none is.
    pub fn wanted_left(&self, e: &Evaluation) -> Option<f64> {
        let raised = self.raises_slip() && !e.objectives.is_empty();
        let wanted = self.limits.slip_margin.unwrap_or(0.0);
        raised.then(|| (1.0 + e.least_margin()) / (1.0 + wanted) - 1.0 - self.reserve)
    }

    /// The least measure of goal `k`, in its objective's own unit ([`Objective::unit`]).
    pub fn value(&self, assessed: &Assessment, k: usize) -> f64 {
        let least =
            assessed.measures.iter().filter(|m| m.goal == k).map(|m| m.value).fold(f64::INFINITY, f64::min);
        self.goals[k].objective.sense() * least
    }

    /// The file of a design found: values and the sharper limits put in, so that `check` holds it to what was searched
    /// for.
    ///
    /// # Errors
    /// [`EditError`].
    pub fn finished_file(&self, x: &[f64]) -> Result<String, EditError> {
        let text = self.file_at(x)?;
        let said = self.parsed(&text).map_or_else(|_| Limits::default(), |design| design.limits);
        with_sharper_limits(&text, &said, &self.limits)
    }
}

/// `text`, which says `said`, with what `sharper` says otherwise written into `[limits]`: what follows from the material goes
/// on following from it.
fn with_sharper_limits(text: &str, said: &Limits, sharper: &Limits) -> Result<String, EditError> {
    let other = |key: &&LimitKey| key.value(sharper) != key.value(said);
    let values: Vec<(&str, f64)> =
        LIMIT_KEYS.iter().filter(other).filter_map(|key| Some((key.name, key.value(sharper)?))).collect();
    with_limits(text, &values)
}
