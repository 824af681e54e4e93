//! A scene with its sprags one by one: who catches, who slips, what each carries over time.
//!
//! In: a scenario, `Sharing`. Out: [`EachSprag`]. Absent: allowables, units, the equations themselves (`dynamics`).
//! Equations: those of [`crate::dynamics::run_many`].
//!
//! Every sprag has its own curve (its size, and its tracks where they are out of round as made), its own friction (static and kinetic in one ratio) and its own lag (its
//! gap, or its size where a cage holds all), its own spring, drawn and given as for statics. An inner track out of round turns with its race. Where the axes of the races do not meet,
//! or give way on bearings under sprags unlike one another, each stands in its own gap ([`Axes`]), and the races bend
//! under sprags unlike one another ([`Rings`]), without inertia. A cage that the inner race drives carries them where the axes meet and are
//! held; each has its own way to the stop from where it touches both races.

mod went;

use crate::clutch::{Clutch, Scenario, ScenarioKind, Sharing, Start, TrackWave};
use crate::dynamics::{
    Axes, AxisBearing, Carried, ManyRun, ManyStart, OffCentre, Rings, RunSettings, SpragApproach, SpragGroup,
    StaysWith, Stop, run_many, settled_off_centre, settled_together,
};
use crate::friction::Stribeck;
use crate::scenario::{NoScenario, Prepared, Settings, Verdict, prepare, touch};
use crate::sharing::{Asked, Idle, OneSprag, Unlike};
use crate::wedge::{AxisTurns, NoClosure, NoCurve, OverEnd, SpragDeviation, WedgeCurve};
use rayon::prelude::*;
use std::sync::Arc;

/// Together with the first, to rounding, rad.
const TOGETHER_RAD: f64 = 1e-12;
/// Most kinds of sprags that are integrated.
const MOST_KINDS: usize = 64;
/// Damping of the axis on its bearings, of the critical: a choice, that of rolling bearings is 0.01 to 0.05.
const BEARING_DAMPING: f64 = 0.02;
/// How much further than at rest an axis on bearings is looked for: a load that comes at once swings to twice of it.
const FURTHER: f64 = 2.5;
/// What an axis may shift at least, as a part of the distance of the axes, and m.
const SHIFTS: [f64; 2] = [0.5, 1e-6];

/// Why there is no run.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoEachSprag {
    /// The scene has no start.
    #[error("{0}")]
    NoScenario(NoScenario),
    /// Nothing moves in a scene of this kind.
    #[error(
        "nothing moves in a static scenario or an overrun: allowed are torsional-excitation, engagement and \
             transient"
    )]
    Static,
    /// The mean speed changes, and each sprag has a curve of its own.
    #[error("sprags one by one need a constant mean speed: leave its history out of the scenario")]
    SpeedCourse,
    /// The scene has a drivetrain.
    #[error("sprags one by one move no drivetrain: give the scenario drivetrain = []")]
    Drivetrain,
    /// No sprag can carry.
    #[error("no sprag carries")]
    NoneCarries,
    /// One comes to its end before this torque (N m) is carried.
    #[error(
        "one sprag comes to its end before {0} Nm is carried where the scene starts; narrow the bounds of \
             [sharing], or give the scene a smaller preload"
    )]
    NotCarried(f64),
    /// The sprag of this index has no curve.
    #[error("sprag {number}: {1}", number = .0 + 1)]
    Curve(usize, NoCurve),
    /// The sprag of this index does not fit its gap everywhere that the axes may lie, up to this far apart, m.
    #[error(
        "sprag {number}: the axes may come to lie so far apart in this scene that its gap is too narrow or too wide for \
             it; bring them nearer, stiffen their bearings, or give the scene smaller torques",
        number = .0 + 1
    )]
    OffCentre(usize, f64),
    /// There are more unlike sprags than this.
    #[error(
        "more than {0} unlike sprags: leave the bounds of [sharing] at 0 and give those that matter in its list of \
             sprags"
    )]
    TooMany(usize),
}

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
    /// The verdict of each group; `None`: the run ended before it could be told.
    pub verdicts: Vec<Option<Verdict>>,
    /// Mean normal force from which on a share counts, N.
    pub loaded_n: f64,
    /// Difference to a run of steps ten times as coarse in tolerance: of theta_bi at the end, rad, and of the largest N_bi, as a part
    /// of it. `None`: one of the two met a limit of work or was stopped.
    pub error: Option<[f64; 2]>,
    /// Most steps and changes that a run was allowed.
    pub limits: [u64; 2],
    /// Largest share at rest under the scene's largest torque: as `sharing` has it, between races that do not bend
    /// unevenly, and between round concentric ones; `None` where statics does not carry it.
    pub shares_at_rest: [Option<f64>; 3],
    /// Axes that do not meet or give way; `None`: nothing in the scene feels that.
    pub axes: Option<Axes>,
    /// What the table of sprags that stand off centre leaves out, as a windup, rad, and how far off the axes were looked at, m.
    pub off_centre: [f64; 2],
    /// That torque, N m.
    pub largest_nm: f64,
    /// Races that bend; `None`: nothing in the scene feels that, there are too many sprags, or the law of contact is too stiff.
    pub bends: Option<BendingRaces>,
    /// What the springs of all sprags press with at most, N m, where a driven cage carries them; `None`: none does.
    pub carried_spring_nm: Option<f64>,
}

/// Races that bend in a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BendingRaces {
    /// Lowest mode of inner and outer race by itself, Hz.
    pub lowest_mode_hz: [f64; 2],
    /// The fastest that the scene drives them with: its excitation, or the races on the sprags under the largest torque, Hz.
    pub scene_hz: f64,
}

impl BendingRaces {
    /// The part of the bending that is left out with the rings' inertia: (f/f_2)^2.
    pub fn left_out(&self) -> f64 {
        (self.scene_hz / self.lowest_mode_hz[0].min(self.lowest_mode_hz[1])).powi(2)
    }
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
    /// Axes that do not meet or give way, or an inner track between them that is not round.
    pub axes: Option<Axes>,
    /// Races that bend.
    pub rings: Option<Rings>,
    /// The scene of sprags alike.
    pub alike: Prepared,
}

impl Many {
    /// Sprags of `scenario` as `sharing` has them between races that stay round. `apart`: sprags alike are computed one by one too.
    ///
    /// # Errors
    /// [`NoEachSprag`].
    pub fn new(scenario: &Scenario, sharing: &Sharing, apart: bool) -> Result<Self, NoEachSprag> {
        Self::made(scenario, sharing, apart, false)
    }

    /// The same between races that bend, where sprags unlike one another make them, no more than [`run_many`] takes, under a law of contact
    /// with which they [have one place](Rings::has_one_solution).
    ///
    /// # Errors
    /// [`NoEachSprag`].
    pub fn bending(scenario: &Scenario, sharing: &Sharing) -> Result<Self, NoEachSprag> {
        Self::made(scenario, sharing, false, true)
    }

    fn made(scenario: &Scenario, sharing: &Sharing, apart: bool, bends: bool) -> Result<Self, NoEachSprag> {
        if scenario.kind.duration_s().is_none() {
            return Err(NoEachSprag::Static);
        }
        if scenario.speed_history.is_some() {
            return Err(NoEachSprag::SpeedCourse);
        }
        if !scenario.drivetrain.is_empty() {
            return Err(NoEachSprag::Drivetrain);
        }
        let mut alike = prepare(scenario).map_err(NoEachSprag::NoScenario)?;
        let clutch = &scenario.clutch;
        let curve = &alike.model.curve;
        let at_rest = if curve.speed_rad_s() == 0.0 {
            curve.clone()
        } else {
            let profile = clutch.profile().map_err(|e| NoEachSprag::NoScenario(NoScenario::Profile(e)))?;
            WedgeCurve::build(clutch, &profile, 0.0)
                .map_err(|e| NoEachSprag::NoScenario(NoScenario::Curve(e)))?
        };
        let unlike = Unlike::new(clutch, sharing, &at_rest, 0.0);
        let axes = axes(clutch, &unlike, sharing, curve.speed_rad_s());
        // No cage carries there.
        let cage = if axes.is_some() { alike.model.carried.take() } else { None };
        if cage.is_some() && alike.free_run.is_some() {
            let why = NoScenario::DrivenCage("a run of sprags between axes that lie apart or give way");
            return Err(NoEachSprag::NoScenario(why));
        }
        let curve = &alike.model.curve;
        let touch = match alike.model.carried {
            None => None,
            Some(_) => {
                let profile =
                    clutch.profile().map_err(|e| NoEachSprag::NoScenario(NoScenario::Profile(e)))?;
                let touch = touch(clutch, &profile, curve.speed_rad_s());
                clutch.cage.zip(Some(touch.map_err(|e| NoEachSprag::NoScenario(NoScenario::Curve(e)))?))
            }
        };
        let first = unlike.lag_rad.iter().flatten().copied().fold(f64::INFINITY, f64::min);
        if first == f64::INFINITY {
            return Err(NoEachSprag::NoneCarries);
        }
        let lag = |i: usize| unlike.lag_rad[i].map(|lag| lag - first).filter(|lag| *lag > TOGETHER_RAD);
        let able: Vec<usize> = (0..unlike.sprags.len()).filter(|&i| unlike.lag_rad[i].is_some()).collect();
        let bends = bends && uneven(&unlike) && able.len() <= MOST_KINDS;
        let key = |i: usize| {
            (
                made_bits(&unlike, i),
                [unlike.sprags[i].friction, unlike.sprags[i].spring].map(f64::to_bits),
                lag(i).map(f64::to_bits),
                (apart || bends || axes.is_some()).then_some(i),
            )
        };
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
        let inner_track: Arc<[TrackWave]> = sharing.inner_track().copied().collect();
        let of = |(g, &i): (usize, &usize)| {
            let sprag = &unlike.sprags[i];
            let own = curve
                .of_sprag(standing_made(&unlike, i, &inner_track))
                .map_err(|why| NoEachSprag::Curve(i, why))?;
            let kinetic = law.kinetic * (sprag.friction / law.static_);
            let friction = Stribeck { static_: sprag.friction, kinetic, ..law };
            let count = group.iter().filter(|of| **of == Some(g)).count();
            let mut model = alike.model.of_sprags(count, own, friction).with_spring(sprag.spring);
            if let Some((cage, touch)) = &touch
                && made_bits(&unlike, i) != [0; 3]
            {
                let own = touch.of_sprag(unlike.as_made(i)).map_err(|why| NoEachSprag::Curve(i, why))?;
                model.carried = Some(Carried::new(clutch, cage, &own));
            }
            Ok(SpragGroup { model, lag_rad: lag(i), over: None, off_centre: None })
        };
        let built: Vec<_> = kinds.par_iter().enumerate().map(of).collect();
        let mut groups = built.into_iter().collect::<Result<Vec<_>, _>>()?;
        if let Some(axes) = &axes {
            let reach_m = reach_m(axes, &unlike, scenario, &alike, &inner_track);
            stand_off_centre(&mut groups, &unlike, &kinds, reach_m, &inner_track)?;
        }
        let rings = match bends {
            true => Some(rings(&groups, &unlike, &kinds, largest_nm(scenario, &alike.model.loads))?)
                .filter(Rings::has_one_solution),
            false => None,
        };
        // Where nothing but friction sets them apart they begin as sprags alike.
        let even = axes.is_none()
            && able.len() == unlike.sprags.len()
            && groups.iter().all(|g| g.lag_rad.is_none())
            && unlike.sprags.iter().all(|s| s.spring == 1.0)
            && (0..unlike.sprags.len()).all(|i| made_bits(&unlike, i) == [0; 3])
            && (rings.is_none()
                || (0..unlike.sprags.len()).all(|i| unlike.sprags[i].azimuth_rad == even_rad(&unlike, i)));
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
                let settled = match &axes {
                    Some(axes) => settled_off_centre(&groups, axes, rings.as_ref(), torque_nm, spring),
                    None => settled_together(&groups, rings.as_ref(), torque_nm, spring),
                };
                Some(settled.ok_or(NoEachSprag::NotCarried(torque_nm))?)
            }
        };
        let start = start.ok_or(NoEachSprag::NoneCarries)?;
        let (idle, sprags) = (unlike.idle.clone(), unlike.sprags.clone());
        Ok(Self { groups, start, group, idle, sprags, axes, rings, alike })
    }

    /// The same with the way of each sprag over its highest place; `None` where that is not known: no equilibrium is
    /// found, or the axes may lie apart. By d, at one normal force, they turn the races by d/(OA sin omega) or so
    /// ([`AxisTurns`]), and omega passes 0 at the highest place.
    pub fn going_over(&self, clutch: &Clutch) -> Option<Self> {
        if self.axes.is_some() {
            return None;
        }
        let brink = clutch.brink(&clutch.profile().ok()?);
        let over = |g: &SpragGroup| g.model.curve.beyond(brink.as_ref());
        let ways: Vec<_> = self.groups.par_iter().map(over).collect();
        let mut all = self.clone();
        for (group, way) in all.groups.iter_mut().zip(ways) {
            let way = way.filter(|way| way.end != OverEnd::NoConvergence)?;
            (group.over, group.model.curve) = (Some(way.end), way.followed_curve().clone());
        }
        if let Some(rings) = &mut all.rings {
            let new = |g: &SpragGroup| SpragApproach::new(&g.model.curve).map(Arc::new);
            rings.approaches = all.groups.par_iter().map(new).collect::<Option<Vec<_>>>()?;
        }
        Some(all)
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
        run_many(&self.groups, self.axes.as_ref(), self.rings.as_ref(), &self.start, &settings)
    }
}

/// Even place of sprag `i`, rad.
fn even_rad(unlike: &Unlike<'_>, i: usize) -> f64 {
    std::f64::consts::TAU * i as f64 / unlike.sprags.len() as f64
}

/// What sets sprag `i` and its tracks apart as made, equal where they are; a deviation of -0 is none.
fn made_bits(unlike: &Unlike<'_>, i: usize) -> [u64; 3] {
    bits(unlike.as_made(i))
}

fn bits(made: SpragDeviation) -> [u64; 3] {
    [made.size_m, made.inner_m, made.outer_m].map(|m| (m + 0.0).to_bits())
}

/// Whether the sprags are unlike one another.
fn uneven(unlike: &Unlike<'_>) -> bool {
    (0..unlike.sprags.len()).any(|i| {
        let (s, first) = (&unlike.sprags[i], &unlike.sprags[0]);
        unlike.idle[i].is_some()
            || made_bits(unlike, i) != made_bits(unlike, 0)
            || s.gap_m != first.gap_m
            || s.friction != first.friction
            || s.spring != first.spring
            || s.azimuth_rad != even_rad(unlike, i)
    })
}

/// Races that bend between `groups`, of the sprags `kinds`. Along the tracks forces are the part of the normal ones that they
/// are under `largest_nm`, N m, or where the curve ends.
fn rings(
    groups: &[SpragGroup],
    unlike: &Unlike<'_>,
    kinds: &[usize],
    largest_nm: f64,
) -> Result<Rings, NoEachSprag> {
    let curve = unlike.curve();
    let end_n = curve.arc_end_n(curve.arc_count() - 1);
    let loaded = curve.closure_at_torque(largest_nm).or_else(|| curve.closure_at_normal(end_n));
    let Some((_, at)) = loaded else { return Err(NoEachSprag::NotCarried(largest_nm)) };
    let (inner, outer) = ([1.0, at.t_bi.v / at.n_bi], [at.n_be.v / at.n_bi, -at.t_be.v / at.n_bi]);
    let approach = |g: usize| {
        let of = SpragApproach::new(&groups[g].model.curve);
        of.map(Arc::new).ok_or(NoEachSprag::Curve(kinds[g], NoCurve::NoConvergence))
    };
    let approaches = one_for_each_made(groups.len(), |g| made_bits(unlike, kinds[g]), approach)?;
    let elastic = &curve.statics().elastic;
    Ok(Rings {
        opens_m_per_n: unlike.opens_m_per_n(kinds, inner, outer),
        approaches,
        lowest_mode_hz: [&elastic.inner_race, &elastic.outer_race].map(|race| race.lowest_mode_hz()),
    })
}

/// `found` of each of so many groups, once for those that are made alike.
fn one_for_each_made<T: Send + Sync>(
    groups: usize,
    made: impl Fn(usize) -> [u64; 3] + Sync,
    found: impl Fn(usize) -> Result<Arc<T>, NoEachSprag> + Sync,
) -> Result<Vec<Arc<T>>, NoEachSprag> {
    let firsts: Vec<usize> = (0..groups).filter(|&g| (0..g).all(|before| made(before) != made(g))).collect();
    let all: Vec<_> = firsts.par_iter().map(|&g| found(g)).collect();
    let all = all.into_iter().collect::<Result<Vec<_>, _>>()?;
    let of = |g: usize| {
        firsts.iter().zip(&all).find(|(first, _)| made(**first) == made(g)).map(|(_, t)| t.clone())
    };
    Ok((0..groups).filter_map(of).collect())
}

/// Axes of `clutch` where its sprags can feel them: those that do not meet, or that give way under sprags unlike one another.
fn axes(clutch: &Clutch, unlike: &Unlike<'_>, sharing: &Sharing, speed_rad_s: f64) -> Option<Axes> {
    let gives = unlike.stiffness_n_per_m.is_finite();
    if unlike.offset_m == 0.0 && !(gives && uneven(unlike)) && sharing.inner_track().next().is_none() {
        return None;
    }
    let mass_kg = sharing.mass_kg.unwrap_or(clutch.masses_kg()[1]);
    let stiffness_n_per_m = unlike.stiffness_n_per_m;
    let damping_n_s_per_m = 2.0 * BEARING_DAMPING * (stiffness_n_per_m * mass_kg).sqrt();
    Some(Axes {
        offset_m: unlike.offset_m,
        phase_rad: unlike.phase_rad,
        stays_with: match clutch.races.eccentricity {
            Some(e) if !e.turning => StaysWith::Race(e.carrier),
            _ => StaysWith::Space,
        },
        bearing: gives.then_some(AxisBearing { mass_kg, stiffness_n_per_m, damping_n_s_per_m }),
        speed_rad_s,
    })
}

/// Largest torque that acts in `scenario`, N m.
fn largest_nm(scenario: &Scenario, loads: &crate::dynamics::Loads) -> f64 {
    match scenario.kind {
        ScenarioKind::Transient { preload_nm, torque_step_nm, .. } => {
            preload_nm.max(preload_nm + torque_step_nm)
        }
        _ => loads.amplitude_nm - loads.inner_nm,
    }
}

/// How far off the axes are looked at, m: as far as at rest under the largest torque they shift, and what a swing adds.
fn reach_m(
    axes: &Axes,
    unlike: &Unlike<'_>,
    scenario: &Scenario,
    alike: &Prepared,
    inner_track: &[TrackWave],
) -> f64 {
    let lobes_m: f64 = inner_track.iter().map(|wave| wave.amplitude_m).sum();
    if axes.bearing.is_none() {
        return (axes.offset_m + lobes_m).max(SHIFTS[1]);
    }
    let largest_nm = largest_nm(scenario, &alike.model.loads);
    let shift = match unlike.unbent().carrying(Asked::Torque(largest_nm), 0.0) {
        Ok(shared) => shared.shift_m[0].hypot(shared.shift_m[1]),
        Err(_) => 0.0,
    };
    axes.offset_m + lobes_m + (FURTHER * shift).max(SHIFTS[0] * axes.offset_m).max(SHIFTS[1])
}

/// What sets sprag `i` apart as made and stays with it: an inner track out of round turns on.
fn standing_made(unlike: &Unlike<'_>, i: usize, inner_track: &[TrackWave]) -> SpragDeviation {
    let made = unlike.as_made(i);
    if inner_track.is_empty() { made } else { SpragDeviation { inner_m: 0.0, ..made } }
}

/// Put every group where it stands between axes that lie up to `reach_m` off; those made alike share a table.
fn stand_off_centre(
    groups: &mut [SpragGroup],
    unlike: &Unlike<'_>,
    kinds: &[usize],
    reach_m: f64,
    inner_track: &Arc<[TrackWave]>,
) -> Result<(), NoEachSprag> {
    let table = |g: usize| {
        let of = AxisTurns::new(&groups[g].model.curve, reach_m);
        of.map(Arc::new).map_err(|why| match why {
            NoClosure::RolledOver => NoEachSprag::OffCentre(kinds[g], reach_m),
            NoClosure::NoConvergence { .. } => NoEachSprag::Curve(kinds[g], NoCurve::NoConvergence),
        })
    };
    let made = |g: usize| bits(standing_made(unlike, kinds[g], inner_track));
    let tables = one_for_each_made(groups.len(), made, table)?;
    for ((group, turns), kind) in groups.iter_mut().zip(tables).zip(kinds) {
        let (azimuth_rad, inner_track) = (unlike.sprags[*kind].azimuth_rad, inner_track.clone());
        group.off_centre = Some(OffCentre { azimuth_rad, turns, inner_track });
    }
    Ok(())
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
    let many = Many::bending(scenario, sharing)?;
    let go = |many: &Many, tolerance: f64, first: bool| {
        settings.follow.begin_pass(first, tolerance);
        many.run(settings, tolerance, settings.samples)
    };
    let whole = |run: &ManyRun| !run.stop.gave_up() && run.stop != Stop::Interrupted;
    let mut many = many;
    let mut coarse = go(&many, settings.tolerance, true);
    // A sprag that comes to its end is followed over its highest place.
    let over = if coarse.stop == Stop::CurveEnd { many.going_over(&scenario.clutch) } else { None };
    if let Some(over) = over {
        // Where that is not found the scene ends where the curve does.
        let run = go(&over, settings.tolerance, false);
        if whole(&run) {
            (many, coarse) = (over, run);
        }
    }
    let fine = if whole(&coarse) { Some(go(&many, 0.1 * settings.tolerance, false)) } else { None };
    let fine_whole = fine.as_ref().filter(|fine| whole(fine));
    let verdicts = went::verdicts(fine.as_ref().unwrap_or(&coarse), fine_whole.map(|_| &coarse));
    let error = fine_whole.map(|fine| {
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
    let largest_nm = largest_nm(scenario, loads);
    let profile = scenario.clutch.profile().ok();
    let at_rest = profile.and_then(|p| WedgeCurve::build(&scenario.clutch, &p, 0.0).ok());
    let share = |bends: bool, round: bool| -> Option<f64> {
        let curve = at_rest.as_ref()?;
        let mut clutch = scenario.clutch.clone();
        let mut sharing = sharing.clone();
        if round {
            clutch.races.eccentricity = None;
            sharing.stiffness_n_per_m = None;
        }
        let unlike = Unlike::new(&clutch, &sharing, curve, 0.0);
        let unlike = if bends { unlike } else { unlike.unbent() };
        let shared = unlike.carrying(Asked::Torque(largest_nm), 0.0).ok()?;
        Some(shared.shares().into_iter().fold(0.0, f64::max))
    };
    let shares_at_rest = [share(true, false), share(false, false), share(false, true)];
    let counts =
        (0..many.groups.len()).map(|g| many.group.iter().filter(|of| **of == Some(g)).count()).collect();
    let loaded_n = many.alike.model.loaded_n;
    let turns = || many.groups.iter().filter_map(|g| g.off_centre.as_ref());
    let most = |of: &dyn Fn(&AxisTurns) -> f64| turns().map(|at| of(&at.turns)).fold(0.0, f64::max);
    let off_centre = [most(&|turns| turns.error_rad), most(&AxisTurns::reach_m)];
    let bends = many.rings.as_ref().map(|rings| BendingRaces {
        lowest_mode_hz: rings.lowest_mode_hz,
        scene_hz: scene_hz(&scenario.clutch, &many.alike, at_rest.as_ref(), largest_nm),
    });
    let alike = &many.alike.model;
    let carried_spring_nm = alike.carried.as_ref().map(|_| alike.spring_most_nm());
    let Many { sprags, idle, group, axes, .. } = many;
    // Held axes that meet are there for the inner track alone.
    let axes = axes.filter(|axes| axes.offset_m > 0.0 || axes.bearing.is_some());
    Ok(EachSprag {
        sprags,
        idle,
        group,
        counts,
        run,
        verdicts,
        loaded_n,
        error,
        limits,
        shares_at_rest,
        axes,
        off_centre,
        largest_nm,
        bends,
        carried_spring_nm,
    })
}

/// The fastest that the scene drives the rings with: its period, or the races swinging on the sprags under the largest torque, Hz.
fn scene_hz(clutch: &Clutch, alike: &Prepared, curve: Option<&WedgeCurve>, largest_nm: f64) -> f64 {
    let driven = alike.period_s.map_or(0.0, |s| 1.0 / s);
    let races = &clutch.races;
    let softness = 1.0 / races.inner_inertia_kg_m2 + 1.0 / races.outer_inertia_kg_m2;
    let point = curve.and_then(|curve| curve.at_torque(largest_nm));
    let own = point.map_or(0.0, |p| (p.k_tangent_nm_per_rad * softness).sqrt() / std::f64::consts::TAU);
    driven.max(own)
}
