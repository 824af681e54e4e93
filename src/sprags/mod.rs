//! A scene with its sprags one by one: who catches, who slips, what each carries over time.
//!
//! In: a scenario, `Sharing`. Out: [`EachSprag`]. Absent: allowables, units, the equations themselves (`dynamics`).
//! Equations: those of [`crate::dynamics::run_many`].
//!
//! Every sprag has its own curve (its size), its own friction (static and kinetic in one ratio) and its own lag (its gap, or its size where a
//! cage holds all), drawn and given as for statics. Races turn about one axis and stay round, so its azimuth does not matter.

use crate::clutch::{Scenario, ScenarioKind, Sharing, Start};
use crate::dynamics::{ManyRun, ManyStart, RunSettings, SpragGroup, Stop, run_many, settled_together};
use crate::friction::Stribeck;
use crate::scenario::{NoScenario, Prepared, Settings, prepare};
use crate::sharing::{Asked, Idle, OneSprag, Unlike};
use crate::wedge::{NoCurve, WedgeCurve};
use rayon::prelude::*;

/// Together with the first, to rounding, rad.
const TOGETHER_RAD: f64 = 1e-12;
/// Most kinds of sprags that are integrated.
const MOST_KINDS: usize = 64;

/// Why there is no run.
#[derive(Debug, Clone, PartialEq)]
pub enum NoEachSprag {
    /// The scene has no start.
    NoScenario(NoScenario),
    /// Nothing moves in a scene of this kind.
    Static,
    /// The mean speed changes, and each sprag has a curve of its own.
    SpeedCourse,
    /// The scene has a drivetrain.
    Drivetrain,
    /// No sprag can carry.
    NoneCarries,
    /// One comes to its end before this torque (N m) is carried.
    NotCarried(f64),
    /// The sprag of this index has no curve.
    Curve(usize, NoCurve),
    /// There are more unlike sprags than this.
    TooMany(usize),
}

impl std::fmt::Display for NoEachSprag {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::NoScenario(why) => why.fmt(f),
            Self::Static => f.write_str(
                "nothing moves in a static scenario or an overrun: allowed are torsional-excitation, engagement and transient",
            ),
            Self::SpeedCourse => f.write_str(
                "sprags one by one need a constant mean speed: leave its history out of the scenario",
            ),
            Self::Drivetrain => {
                f.write_str("sprags one by one move no drivetrain: give the scenario drivetrain = []")
            }
            Self::NoneCarries => {
                f.write_str("no sprag carries; `sharing` without --scenario says of each why")
            }
            Self::NotCarried(nm) => write!(
                f,
                "one sprag comes to its end before {nm} Nm is carried where the scene starts; narrow the bounds of [sharing], or give the \
                 scene a smaller preload"
            ),
            Self::Curve(i, why) => write!(f, "sprag {}: {why}", i + 1),
            Self::TooMany(most) => write!(
                f,
                "more than {most} unlike sprags: leave the bounds of [sharing] at 0 and give those that matter in its list of sprags"
            ),
        }
    }
}

impl std::error::Error for NoEachSprag {}

/// A scene of unlike sprags.
#[derive(Debug, Clone)]
pub struct EachSprag {
    /// As drawn and given.
    pub sprags: Vec<OneSprag>,
    /// Why a sprag carries nothing; `None`: it can.
    pub idle: Vec<Option<Idle>>,
    /// The group in [`Self::run`] of each; `None`: idle.
    pub group: Vec<Option<usize>>,
    /// How many sprags each group has.
    pub counts: Vec<usize>,
    /// What became of them.
    pub run: ManyRun,
    /// Mean normal force from which on a share counts, N.
    pub loaded_n: f64,
    /// Difference to a run of steps ten times as coarse in tolerance: of theta_bi at the end, rad, and of the largest N_bi, as a part
    /// of it. `None`: one of the two met a limit of work or was stopped.
    pub error: Option<[f64; 2]>,
    /// Most steps and changes that a run was allowed.
    pub limits: [u64; 2],
    /// Largest share at rest under the scene's largest torque: between races that bend and shift as `sharing` has them, and round concentric
    /// ones; `None` where statics does not carry it.
    pub shares_at_rest: [Option<f64>; 2],
    /// That torque, N m.
    pub largest_nm: f64,
}

/// Ready to run.
#[derive(Debug, Clone)]
pub struct Many {
    /// Sprags alike.
    pub groups: Vec<SpragGroup>,
    /// Where they begin.
    pub start: ManyStart,
    /// The group of each sprag; `None`: idle.
    pub group: Vec<Option<usize>>,
    /// Why a sprag carries nothing.
    pub idle: Vec<Option<Idle>>,
    /// The sprags.
    pub sprags: Vec<OneSprag>,
    /// The scene of sprags alike.
    pub alike: Prepared,
}

impl Many {
    /// Sprags of `scenario` as `sharing` has them. `apart`: sprags alike are computed one by one too.
    ///
    /// # Errors
    /// [`NoEachSprag`].
    pub fn new(scenario: &Scenario, sharing: &Sharing, apart: bool) -> Result<Self, NoEachSprag> {
        if scenario.kind.duration_s().is_none() {
            return Err(NoEachSprag::Static);
        }
        if scenario.speed_history.is_some() {
            return Err(NoEachSprag::SpeedCourse);
        }
        if !scenario.drivetrain.is_empty() {
            return Err(NoEachSprag::Drivetrain);
        }
        let alike = prepare(scenario).map_err(NoEachSprag::NoScenario)?;
        let mut clutch = scenario.clutch.clone();
        clutch.races.eccentricity = None;
        let curve = &alike.model.curve;
        let at_rest = if curve.speed_rad_s() == 0.0 {
            curve.clone()
        } else {
            let profile = clutch.profile().map_err(|e| NoEachSprag::NoScenario(NoScenario::Profile(e)))?;
            WedgeCurve::build(&clutch, &profile, 0.0)
                .map_err(|e| NoEachSprag::NoScenario(NoScenario::Curve(e)))?
        };
        let unlike = Unlike::new(&clutch, sharing, &at_rest, 0.0);
        let first = unlike.lag_rad.iter().flatten().copied().fold(f64::INFINITY, f64::min);
        if first == f64::INFINITY {
            return Err(NoEachSprag::NoneCarries);
        }
        let lag = |i: usize| unlike.lag_rad[i].map(|lag| lag - first).filter(|lag| *lag > TOGETHER_RAD);
        // A deviation of -0 is none.
        let key = |i: usize| {
            let s = &unlike.sprags[i];
            ((s.size_m + 0.0).to_bits(), s.friction.to_bits(), lag(i).map(f64::to_bits), apart.then_some(i))
        };
        let able: Vec<usize> = (0..unlike.sprags.len()).filter(|&i| unlike.lag_rad[i].is_some()).collect();
        let mut kinds: Vec<usize> = Vec::new();
        let mut group = vec![None; unlike.sprags.len()];
        for &i in &able {
            let found = kinds.iter().position(|&k| key(k) == key(i));
            group[i] = Some(found.unwrap_or(kinds.len()));
            if found.is_none() {
                kinds.push(i);
            }
        }
        if kinds.len() > MOST_KINDS {
            return Err(NoEachSprag::TooMany(MOST_KINDS));
        }
        let law = Stribeck::of(&clutch.friction);
        let of = |(g, &i): (usize, &usize)| {
            let sprag = &unlike.sprags[i];
            let own = curve.of_size(sprag.size_m).map_err(|why| NoEachSprag::Curve(i, why))?;
            let kinetic = law.kinetic * (sprag.friction / law.static_);
            let friction = Stribeck { static_: sprag.friction, kinetic, ..law };
            let count = group.iter().filter(|of| **of == Some(g)).count();
            Ok(SpragGroup { model: alike.model.of_sprags(count, own, friction), lag_rad: lag(i) })
        };
        let built: Vec<_> = kinds.par_iter().enumerate().map(of).collect();
        let groups = built.into_iter().collect::<Result<Vec<_>, _>>()?;
        // Where nothing but friction sets them apart they begin as sprags alike.
        let even = able.len() == unlike.sprags.len()
            && groups.iter().all(|g| g.lag_rad.is_none())
            && unlike.sprags.iter().all(|s| s.size_m == 0.0);
        let start = match alike.free_run {
            None if even => ManyStart::of(&vec![Some((alike.state, alike.mode)); groups.len()]),
            Some(_) => {
                let touch =
                    |g: &SpragGroup| if g.lag_rad.is_some() { None } else { alike.overrun_of(&g.model) };
                ManyStart::of(&groups.iter().map(touch).collect::<Vec<_>>())
            }
            None => {
                let torque_nm = alike.model.drive.torque_at(0.0).max(0.0) - alike.model.loads.inner_nm;
                let spring = scenario.start == Start::Settled;
                Some(settled_together(&groups, torque_nm, spring).ok_or(NoEachSprag::NotCarried(torque_nm))?)
            }
        };
        let start = start.ok_or(NoEachSprag::NoneCarries)?;
        let (idle, sprags) = (unlike.idle.clone(), unlike.sprags.clone());
        Ok(Self { groups, start, group, idle, sprags, alike })
    }

    /// Most steps, and most changes of all sprags, of a run.
    pub fn limits(&self, settings: &Settings) -> [u64; 2] {
        let [steps, events] = settings.limits(&self.alike);
        [steps, settings.most_events.unwrap_or(events.saturating_mul(self.groups.len() as u64))]
    }

    /// Run at the tolerance `tolerance` of a step, `settings` for all else.
    pub fn run(&self, settings: &Settings, tolerance: f64, samples: usize) -> ManyRun {
        let [most_steps, most_events] = self.limits(settings);
        let duration_s = self.alike.duration_s;
        let longest = self.alike.period_s.map_or(duration_s / 200.0, |period| 0.25 * period);
        let settings = RunSettings {
            tolerance,
            duration_s,
            longest_step_s: settings.longest_step_s.unwrap_or(longest),
            most_steps,
            most_events,
            samples,
            follow: settings.follow.clone(),
            ..RunSettings::default()
        };
        run_many(&self.groups, &self.start, &settings)
    }
}

/// Run `scenario` with its sprags as `sharing` has them.
///
/// # Errors
/// [`NoEachSprag`]; whatever happens to them is a result.
pub fn each_sprag(
    scenario: &Scenario,
    sharing: &Sharing,
    settings: &Settings,
) -> Result<EachSprag, NoEachSprag> {
    let many = Many::new(scenario, sharing, false)?;
    let go = |tolerance: f64, first: bool| {
        settings.follow.begin_pass(first, tolerance);
        many.run(settings, tolerance, settings.samples)
    };
    let whole = |run: &ManyRun| !run.stop.gave_up() && run.stop != Stop::Interrupted;
    let coarse = go(settings.tolerance, true);
    let fine = if whole(&coarse) { Some(go(0.1 * settings.tolerance, false)) } else { None };
    let error = fine.as_ref().filter(|fine| whole(fine)).map(|fine| {
        let most = |run: &ManyRun| run.courses.iter().map(|c| c.normal_max_n).fold(0.0, f64::max);
        let (fine_n, coarse_n) = (most(fine), most(&coarse));
        let scale = if fine_n > 0.0 { fine_n } else { 1.0 };
        [(fine.races[0] - coarse.races[0]).abs(), (fine_n - coarse_n).abs() / scale]
    });
    let mut run = fine.unwrap_or(coarse);
    // The mean is that of all places, idle ones counted, as in statics.
    let able = many.group.iter().flatten().count();
    let places = many.group.len() as f64 / able.max(1) as f64;
    run.courses.iter_mut().for_each(|course| course.share *= places);
    let limits = many.limits(settings);
    let loads = &many.alike.model.loads;
    let largest_nm = match scenario.kind {
        ScenarioKind::Transient { preload_nm, torque_step_nm, .. } => {
            preload_nm.max(preload_nm + torque_step_nm)
        }
        _ => loads.amplitude_nm - loads.inner_nm,
    };
    let profile = scenario.clutch.profile().ok();
    let at_rest = profile.and_then(|p| WedgeCurve::build(&scenario.clutch, &p, 0.0).ok());
    let share = |round: bool| -> Option<f64> {
        let curve = at_rest.as_ref()?;
        let mut clutch = scenario.clutch.clone();
        let mut sharing = sharing.clone();
        if round {
            clutch.races.eccentricity = None;
            sharing.stiffness_n_per_m = None;
        }
        let unlike = Unlike::new(&clutch, &sharing, curve, 0.0);
        let unlike = if round { unlike.unbent() } else { unlike };
        let shared = unlike.carrying(Asked::Torque(largest_nm), 0.0).ok()?;
        Some(shared.shares().into_iter().fold(0.0, f64::max))
    };
    let shares_at_rest = [share(false), share(true)];
    let counts =
        (0..many.groups.len()).map(|g| many.group.iter().filter(|of| **of == Some(g)).count()).collect();
    let loaded_n = many.alike.model.loaded_n;
    let Many { sprags, idle, group, .. } = many;
    Ok(EachSprag { sprags, idle, group, counts, run, loaded_n, error, limits, shares_at_rest, largest_nm })
}
