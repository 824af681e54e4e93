//! What the sprags of a scene come to: the verdict of each by the rule of all as one, and that of the clutch.

use super::EachSprag;
use crate::clutch::Scenario;
use crate::dynamics::{ManyRun, SpragCourse, Stop};
use crate::scenario::{SLIPPED_M, Verdict, Went, engaging_m};

/// Signed slip at A of a sprag since it caught, positive towards overrunning, with the path that B slid with a driven cage, m.
fn net_m(course: &SpragCourse) -> f64 {
    course.net_m[0] - course.before_m[0] + course.carried_m
}

/// Path at A towards engaging since then, m.
fn towards_engaging_m(course: &SpragCourse) -> f64 {
    engaging_m(course.path_m[0] - course.before_m[1], course.net_m[0] - course.before_m[0])
}

fn verdict(run: &ManyRun, course: &SpragCourse, error_m: f64) -> Option<Verdict> {
    let (end_n, net_m) = (course.end_n, net_m(course));
    let went =
        Went { stop: run.stop, longest_open_s: course.longest_open_s, carried: course.carried, end_n, net_m };
    went.verdict(error_m)
}

/// The verdict of each group of `run`, another run of it beside: where they do not agree it is at the threshold.
pub(super) fn verdicts(run: &ManyRun, beside: Option<&ManyRun>) -> Vec<Option<Verdict>> {
    let one = |(g, course): (usize, &SpragCourse)| {
        let Some(beside) = beside else { return verdict(run, course, 0.0) };
        let other = &beside.courses[g];
        let error_m = (net_m(course) - net_m(other)).abs();
        let (a, b) = (verdict(run, course, error_m)?, verdict(beside, other, error_m)?);
        Some(if a == b { a } else { Verdict::AtThreshold })
    };
    run.courses.iter().enumerate().map(one).collect()
}

impl EachSprag {
    /// The group that has let go least, and its verdict, which is that of the clutch: races that one sprag holds are held. `None`: the run
    /// ended before it could be told.
    pub fn least(&self) -> Option<(usize, Verdict)> {
        let rank = |verdict: Verdict| match verdict {
            Verdict::Sticks => 0,
            Verdict::AtThreshold => 1,
            Verdict::SlipsOverrunning | Verdict::SlipsEngaging => 2,
            Verdict::Disengages => 3,
            Verdict::Overloaded => 4,
        };
        let each = self.verdicts.iter().enumerate().filter_map(|(g, verdict)| Some((g, (*verdict)?)));
        each.min_by(|(a, of_a), (b, of_b)| {
            rank(*of_a).cmp(&rank(*of_b)).then(self.net_m(*a).abs().total_cmp(&self.net_m(*b).abs()))
        })
    }

    /// Signed slip at A of group `g` since it caught, positive towards overrunning, with the path that B slid with a driven cage, m.
    pub fn net_m(&self, g: usize) -> f64 {
        net_m(&self.run.courses[g])
    }

    /// Whether group `g` slips under load once it has caught, by more than counts: where the clutch holds net, where it lets go towards
    /// engaging.
    pub fn slips(&self, g: usize) -> bool {
        let course = &self.run.courses[g];
        course.slips.is_some()
            && match self.least() {
                None | Some((_, Verdict::Sticks | Verdict::AtThreshold)) => {
                    !matches!(self.verdicts[g], Some(Verdict::Sticks | Verdict::AtThreshold))
                }
                Some(_) => towards_engaging_m(course) > SLIPPED_M,
            }
    }

    /// Whether the clutch does what `scenario` asks ([`Verdict::is_as_asked`]), and no sprag slips or goes over meanwhile.
    pub fn held(&self, scenario: &Scenario) -> bool {
        let asked = |(g, verdict): (usize, Verdict)| {
            verdict.is_as_asked(scenario, towards_engaging_m(&self.run.courses[g]))
        };
        self.run.stop == Stop::Finished
            && self.least().is_some_and(asked)
            && self.run.courses.iter().enumerate().all(|(g, c)| c.over_s.is_none() && !self.slips(g))
    }
}
