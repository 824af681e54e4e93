//! A scene with its sprags one by one: who catches, who slips, what each carries over time.

use super::drawn::drawn_words;
use super::left_out::{LeftOut, one_by_one};
use super::page::{half, opened};
use super::sharing::NoSharing;
use super::{Answer, Envelope, Finding, Provenance};
use crate::clutch::Carrier;
use crate::design::Design;
use crate::dynamics::{Axes, ManySample, SpragCourse, StaysWith, Stop};
use crate::report::{Page, Plot, Rows, Screen, Table, Unit, significant};
use crate::scenario::Settings;
use crate::sharing::OneSprag;
use crate::sprags::{EachSprag, NoEachSprag, each_sprag};
use serde_json::{Value, json};
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

    /// The sprag that slips first under load, and when, s.
    pub fn first_slip(&self) -> Option<(usize, f64)> {
        let each = (0..self.found.sprags.len()).filter_map(|i| Some((i, self.course(i)?.slips?.t_s)));
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

    /// What becomes of sprags that come to their end, in words.
    fn over_words(&self) -> String {
        let over = self.over();
        let Some((first, t_s)) = over.first() else { return String::new() };
        let carry = self.found.group.iter().flatten().count() - self.gone();
        let lost = self.course(*first).and_then(|c| c.gone_s);
        format!(
            "; {} beyond the end of the curve, sprag {} first, at {}{}; {} over the highest place and {} no more, {carry} remain",
            if over.len() == 1 { "one goes".to_owned() } else { format!("{} go", over.len()) },
            first + 1,
            Unit::Millisecond.show(*t_s, 4),
            lost.map_or(", and comes back or stays there".to_owned(), |t_s| format!(
                ", and loses contact at {}",
                Unit::Millisecond.show(t_s, 4)
            )),
            if self.gone() == 1 { "one is".to_owned() } else { format!("{} are", self.gone()) },
            if self.gone() == 1 { "bears" } else { "bear" },
        )
    }

    /// How many sprags slip under load after they have caught.
    pub fn slipping(&self) -> usize {
        (0..self.found.sprags.len()).filter(|&i| self.course(i).is_some_and(|c| c.slips.is_some())).count()
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

    /// One row a sprag.
    fn rows(&self) -> Rows<(usize, &OneSprag, Option<&SpragCourse>)> {
        let order = self.catching();
        let rows = self.found.sprags.iter().enumerate().map(|(i, s)| (i, s, self.course(i)));
        let um = |m: f64| Unit::Micrometre.from_si(m);
        let slips = |c: Option<&SpragCourse>| c.and_then(|c| c.slips);
        Rows::of(rows)
            .number("number", "Sprag", Unit::One, 3, |(i, ..)| i + 1)
            .number("size_um", "Larger by", Unit::Micrometre, 3, |(_, s, _)| s.size_m)
            .number("gap_um", "Gap", Unit::Micrometre, 3, |(_, s, _)| s.gap_m)
            .number("friction", "μs", Unit::One, 3, |(_, s, _)| s.friction)
            .number("catches_s", "Catches at", Unit::Second, 4, |(_, _, c)| c.and_then(|c| c.catches_s))
            .shown_in(Unit::Millisecond)
            .number("order", "Order", Unit::One, 3, |(i, ..)| {
                order.iter().position(|of| of == i).map(|k| k + 1)
            })
            .number("normal_max_n", "Largest N", Unit::Newton, 4, |(_, _, c)| c.map(|c| c.normal_max_n))
            .number("largest_share", "Largest share", Unit::One, 4, |(_, _, c)| c.map(|c| c.share))
            .number("largest_share_at_s", "At", Unit::Second, 4, |(_, _, c)| {
                c.filter(|c| c.share > 0.0).map(|c| c.share_s)
            })
            .shown_in(Unit::Millisecond)
            .number("used_friction", "Uses μ", Unit::One, 3, |(_, _, c)| c.map(|c| c.tan[0].max(c.tan[1])))
            .number("slips_at_s", "Slips at", Unit::Second, 4, |(_, _, c)| slips(*c).map(|s| s.t_s))
            .shown_in(Unit::Millisecond)
            .number("slip_inner_um", "Slip", Unit::Micrometre, 3, |(_, _, c)| c.map(|c| c.net_m[0]))
            .text("state", "State", |(i, _, c)| match (self.found.idle[*i], c) {
                (Some(idle), _) => idle.words(),
                (None, Some(c)) if c.catches_s.is_none() => "never catches",
                (None, Some(c)) if c.gone_s.is_some() => "rolled over",
                (None, Some(c)) if c.over_s.is_some() => "beyond its end",
                (None, Some(c)) if c.slips.is_some() => "slips",
                _ => "holds",
            })
            .json_in("azimuth_deg", Unit::Degree, |(_, s, _)| s.azimuth_rad)
            .json("idle", |(i, ..)| self.found.idle[*i].map(|idle| idle.words()))
            .json("normal_max_at_s", |(_, _, c)| c.map(|c| c.normal_max_s))
            .json("used_friction_inner", |(_, _, c)| c.map(|c| c.tan[0]))
            .json("used_friction_outer", |(_, _, c)| c.map(|c| c.tan[1]))
            .json("slips_inner", |(_, _, c)| slips(*c).map(|s| s.inner))
            .json("slips_normal_n", |(_, _, c)| slips(*c).map(|s| s.normal_n))
            .json("slip_outer_um", |(_, _, c)| c.map(|c| um(c.net_m[1])))
            .json("slip_path_inner_um", |(_, _, c)| c.map(|c| um(c.path_m[0])))
            .json("slip_path_outer_um", |(_, _, c)| c.map(|c| um(c.path_m[1])))
            .json("contact_lost_s", |(_, _, c)| c.map(|c| c.open_s))
            .json("over_at_s", |(_, _, c)| c.and_then(|c| c.over_s))
            .json("gone_at_s", |(_, _, c)| c.and_then(|c| c.gone_s))
    }

    /// The same as a table.
    pub fn by_sprag(&self) -> Table {
        self.rows().table()
    }

    /// One row a sample.
    fn history(&self) -> Rows<&ManySample> {
        let axes = self.found.axes.as_ref();
        let normal = |s: &ManySample| -> Vec<f64> {
            self.found.group.iter().map(|g| g.map_or(0.0, |g| s.normal_n[g])).collect()
        };
        Rows::of(&self.found.run.samples)
            .number("t_s", "Time", Unit::Second, 4, |s| s.t_s)
            .number("theta_inner_rad", "θ inner", Unit::Radian, 6, |s| s.races[0])
            .number("theta_outer_rad", "θ outer", Unit::Radian, 6, |s| s.races[1])
            .number("bearing_n", "Bearings hold", Unit::Newton, 4, |s| axes.map(|_| s.bearing_n))
            .json("axis_um", |s| axes.map(|_| s.axis_m.map(|m| Unit::Micrometre.from_si(m))))
            .json("shares", |s| self.shares(s))
            .json("normal_inner_n", |s| normal(s))
    }

    /// Normal forces over the mean of all places at `sample`, by sprag; 0 while that is not loaded.
    fn shares(&self, sample: &ManySample) -> Vec<f64> {
        let normal = |i: usize| self.found.group[i].map_or(0.0, |g| sample.normal_n[g]);
        let all: Vec<f64> = (0..self.found.sprags.len()).map(normal).collect();
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        let loaded = mean > 0.0 && mean >= self.found.loaded_n;
        all.iter().map(|n| if loaded { n / mean } else { 0.0 }).collect()
    }

    /// What is said of races that bend: what is left out of them, or all of it.
    fn bending_left_out(&self) -> LeftOut {
        let Some(bends) = &self.found.bends else {
            let cost = match self.found.shares_at_rest {
                [Some(bent), Some(round), _] if self.found.counts.len() > 1 => format!(
                    "at rest under {} the largest share is {} with it, {} without",
                    Unit::NewtonMetre.show(self.found.largest_nm, 4),
                    significant(bent, 4),
                    significant(round, 4)
                ),
                _ => "0: sprags alike bend nothing beside the law".to_owned(),
            };
            return LeftOut::new(
                "races that bend",
                "sprags that are alike and in their even places leave the races round; more unlike ones than are integrated do not",
                &cost,
            );
        };
        let [inner, outer] = bends.lowest_mode_hz.map(|hz| Unit::Hertz.show(hz, 3));
        LeftOut::new(
            "inertia of the races that bend",
            &format!(
                "they bend as at rest: alone the inner race swings at {inner}, the outer at {outer}, the scene drives them at {}; what they \
                 recede is off by the square of that over the lowest, and so where sprags shock them within one such swing",
                Unit::Hertz.show(bends.scene_hz, 3)
            ),
            &format!("{} of what they bend", Unit::Percent.show(bends.left_out(), 2)),
        )
    }

    fn left_out(&self) -> Vec<LeftOut> {
        let mut instead = vec![
            self.bending_left_out(),
            LeftOut::new(
                "a sprag before it touches",
                "one that lacks something to touch is turned along without a force, and joins rolling",
                "its inertia, below 1e-4 of a race's",
            ),
        ];
        if self.found.axes.is_some() {
            let [windup_rad, reach_m] = self.found.off_centre;
            instead.push(LeftOut::new(
                "a contact that run-out brings over a junction",
                "a sprag in its own gap rolls by a polynomial of the place of the axis, on the arc that its load stands for",
                &format!(
                    "up to {} of windup with the axes {} apart",
                    Unit::Degree.show(windup_rad, 2),
                    Unit::Micrometre.show(reach_m, 3)
                ),
            ));
        }
        one_by_one(self.design, instead)
    }

    fn remarks(&self) -> Vec<String> {
        let mut all = self.design.sharing.as_ref().map(drawn_words).unwrap_or_default();
        let run = &self.found.run;
        let kinds = self.found.counts.len();
        if kinds == 1 {
            all.push("Those that carry are alike: one is computed for all, as `simulate` does".to_owned());
        }
        let left = if run.through_j > 0.0 { run.residual_j.abs() / run.through_j } else { 0.0 };
        let error = self.found.error.map_or("no second run was finished".to_owned(), |[theta, normal]| {
            format!(
                "two runs differ by {} rad in θ and {} of the largest N",
                significant(theta, 2),
                significant(normal, 2)
            )
        });
        all.push(format!(
            "{kinds} {} computed, {} changes, {} steps; {error}; the energy balance leaves {} of what went through",
            if kinds == 1 { "kind of sprags is" } else { "kinds of sprags are" },
            run.events,
            run.counters.steps,
            significant(left, 2)
        ));
        all.extend(self.found.axes.as_ref().map(|axes| self.axes_words(axes)));
        if kinds > 1 {
            all.push(self.bending_words());
        }
        all
    }

    /// What bending does, and what of it is left out.
    fn bending_words(&self) -> String {
        let left = self.bending_left_out();
        match (&self.found.bends, self.found.shares_at_rest) {
            (Some(bends), [Some(bent), Some(round), _]) => format!(
                "The races bend: at rest under {} the largest share is {} with it, {} without; the lowest mode of a ring is {}, the scene's {}, \
                 which leaves out {}",
                Unit::NewtonMetre.show(self.found.largest_nm, 4),
                significant(bent, 4),
                significant(round, 4),
                Unit::Hertz.show(bends.lowest_mode_hz[0].min(bends.lowest_mode_hz[1]), 3),
                Unit::Hertz.show(bends.scene_hz, 3),
                left.cost
            ),
            _ => format!("Left out: {}; {}", left.term, left.cost),
        }
    }

    /// What the axes of the races do.
    fn axes_words(&self, axes: &Axes) -> String {
        let run = &self.found.run;
        let um = |m: f64| Unit::Micrometre.show(m, 3);
        let kg = |mass: f64| format!("{} kg", significant(mass, 3));
        let stays = match axes.stays_with {
            _ if axes.offset_m == 0.0 => String::new(),
            StaysWith::Space => {
                format!(", {} of it in space, past which the clutch turns", um(axes.offset_m))
            }
            StaysWith::Race(Carrier::InnerRace) => {
                format!(", {} of it with the inner race", um(axes.offset_m))
            }
            StaysWith::Race(Carrier::OuterRace) => {
                format!(", {} of it with the outer race", um(axes.offset_m))
            }
        };
        let held = match axes.bearing {
            None => "they are held".to_owned(),
            Some(b) if b.stiffness_n_per_m == 0.0 => {
                format!("nothing but the sprags holds {}", kg(b.mass_kg))
            }
            Some(b) => format!(
                "{} swing on the bearings at {}; without inertia they would be off by (f/f₀)² of what moves at f",
                kg(b.mass_kg),
                Unit::Hertz.show(b.frequency_hz(), 3)
            ),
        };
        let beyond = match self.found.off_centre[1] {
            reach_m if run.axis_max_m > reach_m * (1.0 + 1e-9) => {
                format!("; beyond {} the gaps are extrapolated", um(reach_m))
            }
            _ => String::new(),
        };
        format!("The axes lie up to {} apart{stays}; {held}{beyond}", um(run.axis_max_m))
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
        = Value
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
        self.found.run.stop == Stop::Finished && self.first_slip().is_none() && self.over().is_empty()
    }

    fn verdict(&self) -> String {
        let run = &self.found.run;
        let mut said = if self.held() { "HELD: " } else { "NOT HELD: " }.to_owned();
        if let Some(why) = self.given_up() {
            said += &format!("{why}; until then ");
        } else if run.stop != Stop::Finished {
            let at = run.at_group.and_then(|g| self.found.group.iter().position(|of| *of == Some(g)));
            let whose = at.map_or(String::new(), |i| format!(" of sprag {}", i + 1));
            said += &format!("{}{whose} at {}; ", run.stop.name(), Unit::Second.show(run.t_s, 4));
        }
        said += &match self.largest_share() {
            Some((i, share, t_s)) if share > 0.0 => format!(
                "the largest share is {} of the mean, sprag {} at {}",
                significant(share, 4),
                i + 1,
                Unit::Millisecond.show(t_s, 4)
            ),
            _ => "no sprag was loaded".to_owned(),
        };
        if let Some((i, needs)) = self.most(|c| c.tan[0].max(c.tan[1])).filter(|(_, needs)| *needs > 0.0) {
            said += &format!("; friction is used most by sprag {}, {}", i + 1, significant(needs, 3));
        }
        let order = self.catching();
        let at = |i: &usize| self.course(*i).and_then(|c| c.catches_s);
        if let [first, .., last] = order.as_slice()
            && let (Some(from), Some(until)) = (at(first), at(last))
            && until > from
        {
            said += &format!(
                "; {} of {} sprags catch, the first, {}, at {}, the last, {}, at {}",
                order.len(),
                self.found.sprags.len(),
                first + 1,
                Unit::Millisecond.show(from, 4),
                last + 1,
                Unit::Millisecond.show(until, 4)
            );
        }
        let late: Vec<String> = (0..self.found.sprags.len())
            .filter(|&i| self.course(i).is_some_and(|c| c.catches_s.is_none()))
            .map(|i| (i + 1).to_string())
            .collect();
        match late.as_slice() {
            [] => {}
            [one] => said += &format!("; sprag {one} never catches"),
            several => said += &format!("; sprags {} never catch", several.join(", ")),
        }
        if self.found.axes.is_some() {
            said += &format!(
                "; the bearings hold at most {}, at {}",
                Unit::Newton.show(run.bearing_max_n, 4),
                Unit::Millisecond.show(run.bearing_max_s, 4)
            );
        }
        said += &match self.first_slip() {
            Some((i, t_s)) => format!(
                "; once caught, {} slip{}, sprag {} first, at {}",
                self.slipping(),
                if self.slipping() == 1 { "s" } else { "" },
                i + 1,
                Unit::Millisecond.show(t_s, 4)
            ),
            None => "; none slips once it has caught".to_owned(),
        };
        said += &self.over_words();
        said
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

    fn envelope(&self, run_time_s: f64) -> Envelope<'_, Value> {
        let run = &self.found.run;
        let um = |m: f64| Unit::Micrometre.from_si(m);
        let axes = self.found.axes.as_ref();
        let bearing = axes.and_then(|axes| axes.bearing);
        let bends = self.found.bends;
        let order: Vec<usize> = self.catching().iter().map(|i| i + 1).collect();
        let most = self.largest_share();
        let body = json!({
            "held": self.held(), "verdict": self.verdict(), "scenario": self.scene, "stop": run.stop.name(), "end_s": run.t_s,
            "largest_share": most.map(|m| m.1), "largest_share_sprag": most.map(|m| m.0 + 1), "largest_share_at_s": most.map(|m| m.2),
            "seed": self.design.sharing.as_ref().map(|sharing| sharing.seed), "given_up": self.given_up(),
            "bearing_max_n": axes.map(|_| run.bearing_max_n), "bearing_max_at_s": axes.map(|_| run.bearing_max_s),
            "axes_apart_max_um": axes.map(|_| um(run.axis_max_m)), "bearing_mass_kg": bearing.map(|b| b.mass_kg),
            "bearing_frequency_hz": bearing.map(|b| b.frequency_hz()),
            "over": self.over().len(), "gone": self.gone(), "catching": order, "slipping": self.slipping(), "first_slip_sprag": self.first_slip().map(|(i, _)| i + 1), "first_slip_at_s": self.first_slip().map(|(_, t)| t),
            "theta_inner_rad": run.races[0], "theta_outer_rad": run.races[1],
            "theta_inner_error_rad": self.found.error.map(|e| e[0]), "normal_max_error": self.found.error.map(|e| e[1]),
            "energy_residual_j": run.residual_j, "energy_through_j": run.through_j, "kinds": self.found.counts.len(),
            "events": run.events, "steps": run.counters.steps, "rhs_evaluations": run.counters.rhs_evaluations,
            "lowest_mode_inner_hz": bends.map(|b| b.lowest_mode_hz[0]), "lowest_mode_outer_hz": bends.map(|b| b.lowest_mode_hz[1]),
            "share_at_rest": self.found.shares_at_rest[0], "share_at_rest_round": self.found.shares_at_rest[1],
            "scene_hz": bends.map(|b| b.scene_hz), "bending_left_out": bends.map(|b| b.left_out()),
            "sprags": self.rows().objects(), "history": self.history().objects(),
        });
        Envelope { design: self.design, run_time_s, left_out: self.left_out(), error_estimate: None, body }
    }
}
