//! What a scenario says, and its course to be played.

use super::view::{MarginRow, row};
use crate::answer::check::no_friction;
use crate::clutch::{Scenario, ScenarioKind};
use crate::design::Design;
use crate::dynamics::{Grip, Overrun, Place, Sample};
use crate::margin::{LoadState, SceneDemand, scene_demand, scene_rows};
use crate::report::{Curve, Dash, Plot, Unit, significant};
use crate::scenario::{NoScenario, Prepared, Settings, Simulation, Terms, prepare, simulate_prepared};
use serde::Serialize;

/// The demand of one scenario on friction, without its course.
#[derive(Debug, Clone, Serialize)]
pub struct SceneRow {
    /// Its name.
    pub name: String,
    /// Friction from which on it sticks; none where no friction suffices.
    pub required_friction: Option<f64>,
    /// Static friction of the scenario.
    pub static_friction: f64,
    /// Its margins.
    pub margins: Vec<MarginRow>,
    /// Why it has none, or what came of it.
    pub note: Option<String>,
}

/// The course of a scenario.
#[derive(Debug, Clone, Default, Serialize)]
pub struct SceneView {
    /// Its name.
    pub name: String,
    /// Verdict, in words.
    pub verdict: String,
    /// Figures, in words.
    pub facts: Vec<(String, String)>,
    /// Times, s; one where the scene is one state.
    pub t_s: Vec<f64>,
    /// alpha, rad.
    pub alpha_rad: Vec<f64>,
    /// theta_bi - theta_be, rad.
    pub relative_rad: Vec<f64>,
    /// N_bi, T_bi, N_be, T_be, N.
    pub forces_n: Vec<[f64; 4]>,
    /// What each contact does: 0 sticks, 1 slips with the race ahead, -1 behind, 2 open, 3 taken along by the cage.
    pub modes: Vec<[i8; 2]>,
    /// Plots over time, as SVG: torque of the clutch, demand on friction, angle.
    pub plots: Vec<String>,
    /// Where time runs in the plots, as parts of their width: from and to.
    pub frame: [f64; 2],
}

/// Samples of a course: more than a plot of the page can tell apart.
const SAMPLES: usize = 900;
/// How exact a course is that is played: its plots show a hundredth, its figures three digits.
const PLAYED: f64 = 1e-4;
/// How exact a scene's demand is: the page prints four digits of it.
const ASKED: f64 = 1e-5;
/// Width of the plots, px: as wide as the page shows them, so that their letters keep theirs.
const WIDTH: f64 = 480.0;

/// Demand and margins of a scenario of `design`, whose load state is `state`.
pub fn scene_row(design: &Design, state: &LoadState, scenario: &Scenario, settings: &Settings) -> SceneRow {
    let name = scenario.name.clone();
    let static_friction = scenario.clutch.friction.static_;
    if scenario.kind.is_overrun() {
        let note = Some("steady overrun: nothing is to stick".to_owned());
        return SceneRow { name, required_friction: None, static_friction, margins: Vec::new(), note };
    }
    let settings = Settings { tolerance: settings.tolerance.max(ASKED), ..settings.clone() };
    let found: SceneDemand = scene_demand(scenario, Some(state.at_rest(design)), &settings);
    let required = design.check_scenarios.contains(&scenario.name);
    let margins =
        scene_rows(scenario, &found, &design.limits, required).iter().map(|r| row(r, None)).collect();
    let required_friction = found.demand.as_ref().ok().and_then(|d| d.required_friction);
    let lets_go =
        found.is_to_let_go && found.demand.as_ref().is_ok_and(|d| d.finished && required_friction.is_none());
    let why = found.demand.as_ref().err().map(ToString::to_string);
    let note = why.or_else(|| lets_go.then(|| no_friction(true).to_owned()));
    SceneRow { name, required_friction, static_friction, margins, note }
}

/// The course of a scenario, `settings` with samples or without; that of the `pinned` one as a ghost in its plots, where it has
/// one.
///
/// # Errors
/// [`NoScenario`].
pub fn scene_view(
    scenario: &Scenario,
    pinned: Option<&Scenario>,
    settings: &Settings,
) -> Result<SceneView, NoScenario> {
    let tolerance = settings.tolerance.max(PLAYED);
    let settings = Settings { samples: SAMPLES, tolerance, ..settings.clone() };
    let prepared = prepare(scenario)?;
    let s = simulate_prepared(&prepared, &settings, Terms::All);
    let mut facts = vec![("reached".to_owned(), Unit::Second.show(s.t_s, 4))];
    if let (Some(free), ScenarioKind::Overrun { speed_rad_s, overrun_rad_s }) =
        (prepared.overrun, scenario.kind)
    {
        let carried = scenario.clutch.slides_outside();
        let (track, other) =
            if carried { ("outer", free.normal_outer_n) } else { ("inner", free.normal_inner_n) };
        let normal = Unit::Newton.show(other, 3);
        let heat = Unit::Watt.show(free.drag_torque_nm * overrun_rad_s.abs(), 3);
        let on = free.sliding_n > 0.0;
        return Ok(SceneView {
            name: scenario.name.clone(),
            verdict: format!("runs free, {} the {track} race", if on { "sliding on" } else { "off" }),
            facts: [
                ("outer race", Unit::Rpm.show(speed_rad_s, 5)),
                ("inner race", Unit::Rpm.show(speed_rad_s + overrun_rad_s, 5)),
                ("drag torque", Unit::NewtonMetre.show(free.drag_torque_nm, 3)),
                ("heat", heat),
                (&format!("normal force, {track}, per sprag"), normal),
            ]
            .map(|(name, value)| (name.to_owned(), value))
            .to_vec(),
            ..SceneView::at_rest(free.alpha_rad, sliding_forces(&free), sliding_modes(&free, carried))
        });
    }
    let mut fact = |name: &str, value: String| facts.push((name.to_owned(), value));
    if let Some(d) = &s.demand {
        fact(
            "required friction μ",
            d.required_friction
                .map_or(no_friction(scenario.lets_go() == Some(true)).into(), |f| significant(f, 4)),
        );
        fact("slip margin", d.slip_margin.map_or("none".into(), |m| Unit::Percent.show(m, 3)));
        fact("contact margin", Unit::Percent.show(d.contact_margin, 3));
    }
    fact("net slip, inner", Unit::Micrometre.show(s.inner.net_m, 3));
    fact("largest normal force, inner", Unit::Newton.show(s.peaks.normal_max_n, 4));
    fact("largest Hertz pressure", Unit::Megapascal.show(s.hertz_peak_pa, 4));
    fact("contact lost", Unit::Millisecond.show(s.contact_lost_s, 3));
    let samples = &s.samples;
    let column = |f: &dyn Fn(&Sample) -> f64| samples.iter().map(f).collect::<Vec<_>>();
    let before = pinned.and_then(|pinned| {
        let prepared = prepare(pinned).ok()?;
        Some(ScenePlots::new(pinned, &prepared, &simulate_prepared(&prepared, &settings, Terms::All).samples))
    });
    let plots = match samples.is_empty() {
        true => Vec::new(),
        false => {
            ScenePlots::new(scenario, &prepared, samples).plots(before, scenario.clutch.friction.static_)
        }
    };
    let mode = |grip: Grip| match grip {
        Grip::Stick => 0,
        Grip::Slip(v) if v > 0.0 => 1,
        Grip::Slip(_) => -1,
    };
    if let (ScenarioKind::Static { .. }, Some(p)) = (scenario.kind, prepared.at_rest()) {
        let [inner, outer] = [(p.normal_inner_n, p.tan_omega), (p.normal_outer_n, p.tan_nu)];
        let forces_n = [inner.0, inner.0 * inner.1, outer.0, outer.0 * outer.1];
        return Ok(SceneView {
            name: scenario.name.clone(),
            verdict: verdict(&s),
            facts,
            ..SceneView::at_rest(p.alpha_rad, forces_n, [0, 0])
        });
    }
    Ok(SceneView {
        name: scenario.name.clone(),
        verdict: verdict(&s),
        facts,
        t_s: column(&|p| p.t),
        alpha_rad: column(&|p| p.state[0]),
        relative_rad: column(&|p| p.state[2] - p.state[3]),
        forces_n: samples
            .iter()
            .map(|p| [p.forces.n_bi, p.forces.t_bi, p.forces.n_be, p.forces.t_be])
            .collect(),
        modes: samples
            .iter()
            .map(|p| {
                let inner = match p.mode.place {
                    Place::Open => 2,
                    Place::Carried => 3,
                    Place::Arc(_) | Place::Tension => mode(p.mode.inner),
                };
                [inner, if p.mode.is_off() { 2 } else { mode(p.mode.outer) }]
            })
            .collect(),
        plots,
        frame: Plot::frame(WIDTH),
    })
}

impl SceneView {
    /// A scene that is one state, without a course.
    fn at_rest(alpha_rad: f64, forces_n: [f64; 4], modes: [i8; 2]) -> Self {
        Self {
            t_s: vec![0.0],
            alpha_rad: vec![alpha_rad],
            relative_rad: vec![0.0],
            forces_n: vec![forces_n],
            modes: vec![modes],
            ..Self::default()
        }
    }
}

fn verdict(s: &Simulation) -> String {
    s.verdict.map_or("no verdict", |v| v.name()).to_owned()
}

/// As in [`SceneView::forces_n`]: the race that slides drags the sprags along.
fn sliding_forces(free: &Overrun) -> [f64; 4] {
    let [inner, outer] = [free.normal_inner_n, free.normal_outer_n];
    [inner, -free.tan_inner * inner, outer, -free.tan_outer * outer]
}

/// As in [`SceneView::modes`]; `carried`: by a cage that the inner race drives.
fn sliding_modes(free: &Overrun, carried: bool) -> [i8; 2] {
    let slides = free.sliding_n > 0.0;
    match carried {
        true => [3, if slides { -1 } else { 2 }],
        false => [if slides { 1 } else { 2 }, 0],
    }
}

/// A scene over time, ms.
struct ScenePlots {
    torque_nm: Vec<[f64; 2]>,
    ratio_inner: Vec<[f64; 2]>,
    ratio_outer: Vec<[f64; 2]>,
    windup_deg: Vec<[f64; 2]>,
}

impl ScenePlots {
    fn new(scenario: &Scenario, prepared: &Prepared, samples: &[Sample]) -> Self {
        let over = |f: &dyn Fn(&Sample) -> f64| samples.iter().map(|p| [p.t * 1e3, f(p)]).collect();
        let count = scenario.clutch.sprags.count as f64;
        let oa = |p: &Sample| prepared.model.point(p.mode.place, p.state[0]).oa;
        // What a cage bears asks no friction.
        let ratio = |p: &Sample, t: f64, n: f64| {
            let by_friction = n > 0.0 && !matches!(p.mode.place, Place::Open | Place::Carried);
            if by_friction { (t / n).abs() } else { f64::NAN }
        };
        Self {
            torque_nm: over(&|p| count * p.forces.t_bi * oa(p)),
            ratio_inner: over(&|p| ratio(p, p.forces.t_bi, p.forces.n_bi)),
            ratio_outer: over(&|p| ratio(p, p.forces.t_be, p.forces.n_be)),
            windup_deg: over(&|p| Unit::Degree.from_si(p.state[3] - p.state[2])),
        }
    }

    /// Torque, demand on friction, windup; `before`, the pinned design's, dashed.
    fn plots(self, before: Option<Self>, static_friction: f64) -> Vec<String> {
        let (torque, friction, windup) = before
            .map_or((None, None, None), |b| (Some(b.torque_nm), Some(b.ratio_inner), Some(b.windup_deg)));
        let plot = |y: &str, now: Vec<Curve>, was: &str, before: Option<Vec<[f64; 2]>>| {
            let ghost =
                before.map(|points| Curve { dash: Dash::Dashed, ..Curve::new(was, points).coloured(1) });
            let mut plot = Plot::new("Time, ms", y).sized(WIDTH, 170.0);
            plot.curves.extend(now.into_iter().chain(ghost));
            plot
        };
        let both = vec![
            Curve::new("inner", self.ratio_inner).coloured(0),
            Curve::new("outer", self.ratio_outer).coloured(2),
        ];
        let alone = |name: &str, points| vec![Curve::new(name, points).coloured(0)];
        [
            plot("Clutch torque, Nm", alone("torque", self.torque_nm), "pinned", torque),
            plot("|T|/N", both, "inner, pinned", friction).level(static_friction, "μₛ"),
            plot("Windup, deg", alone("windup", self.windup_deg), "pinned", windup),
        ]
        .map(|plot| plot.to_svg())
        .to_vec()
    }
}
