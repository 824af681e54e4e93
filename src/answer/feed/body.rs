//! The answer of `feed` by its keys in JSON, and its table.

use super::{FeedAnswer, SpringFeed};
use crate::answer::Said;
use crate::dynamics::Stop;
use crate::feed::Fed;
use crate::report::{Cell, Rows, Unit};
use serde::Serialize;

/// Keys of `feed`.
#[derive(Debug, Clone, Serialize)]
pub struct FeedBody<'a> {
    /// By how much a stroke may feed more or less than slow ones, deg.
    pub allowed_deg: f64,
    /// Code of the limit that sets the peak torque that is borne.
    pub bears_by: Option<&'a str>,
    /// Peak torque that every limit bears, N m.
    pub bears_nm: Option<f64>,
    /// Torque of the brake on the fed race, N m.
    pub brake_nm: f64,
    /// The race that drives, `inner` or `outer`.
    pub driver: &'static str,
    /// Each frequency, a row of [`FeedAnswer::frequencies`].
    pub frequencies: Rows<&'a Fed>,
    /// Whether every frequency feeds as slow strokes do, and the clutch bears it.
    pub held: bool,
    /// What turns with the fed race, this included, kg m^2.
    pub inertia_kg_m2: f64,
    /// The frequency at which it first ceases to feed as it should on the way up, Hz; null: nowhere, or already at the first.
    pub limit_hz: Option<f64>,
    /// How many frequencies between those that were asked for were looked at.
    pub looks: usize,
    /// The first that was met beyond `limit_hz`, Hz, where it lies between two that were asked for.
    pub lost_between_hz: Option<f64>,
    /// Each other spring, a row of [`FeedAnswer::by_spring`].
    pub springs: Rows<&'a SpringFeed>,
    /// Angle that the driving race turns by and back, deg.
    pub stroke_deg: f64,
    /// The answer in a sentence.
    pub verdict: String,
    /// What slow strokes feed less than the stroke by statics, deg.
    pub windup_deg: f64,
}

impl<'a> FeedBody<'a> {
    pub(super) fn of(answer: &'a FeedAnswer<'_>) -> Self {
        let degrees = |rad| Unit::Degree.from_si(rad);
        let (case, bears) = (&answer.case, answer.bears.as_ref());
        Self {
            held: answer.is_held(),
            verdict: answer.verdict(),
            stroke_deg: degrees(case.stroke_rad),
            brake_nm: case.brake_nm,
            inertia_kg_m2: case.inertia_kg_m2,
            driver: answer.driving_race(),
            allowed_deg: degrees(answer.allowed_rad),
            windup_deg: degrees(answer.windup_rad),
            limit_hz: answer.climb.limit_hz,
            looks: answer.climb.looks,
            lost_between_hz: answer
                .climb
                .lost
                .as_ref()
                .filter(|_| answer.climb.lost_between)
                .map(|lost| lost.frequency_hz),
            bears_nm: bears.map(|b| b.0),
            bears_by: bears.map(|b| b.1.as_str()),
            frequencies: answer.frequencies(),
            springs: answer.by_spring(),
        }
    }
}

/// A figure of strokes that came to their end.
fn known(fed: &Fed, rad: f64) -> Option<f64> {
    fed.ended.is_none().then_some(rad)
}

impl FeedAnswer<'_> {
    /// Each other spring.
    pub fn by_spring(&self) -> Rows<&SpringFeed> {
        let lost = |s: &SpringFeed, of: &dyn Fn(&Fed) -> Option<f64>| s.lost.as_ref().and_then(of);
        Rows::of(&self.springs)
            .number("factor", "Spring, times", Unit::One, 4, |s| s.factor)
            .number("drag_torque_nm", "Drag", Unit::NewtonMetre, 4, |s| s.drag_torque_nm)
            .number("limit_hz", "Held up to", Unit::Hertz, 3, |s| s.limit_hz)
            .number("lost_hz", "Lost at", Unit::Hertz, 4, move |s| lost(s, &|f| Some(f.frequency_hz)))
            .number("off_deg", "Against slow ones", Unit::Degree, 3, move |s| {
                lost(s, &|f| known(f, self.off_rad(f)))
            })
            .number("open_ms", "Open", Unit::Millisecond, 3, move |s| lost(s, &|f| Some(f.open_s)))
            .text("verdict", "Verdict", |s| match &s.lost {
                None => Cell::Verdict(true, "held".to_owned()),
                Some(fed) => Cell::Verdict(false, self.word(fed).to_owned()),
            })
    }

    /// Each frequency.
    pub fn frequencies(&self) -> Rows<&Fed> {
        Rows::of(&self.list)
            .number("frequency_hz", "Strokes", Unit::Hertz, 4, |f| f.frequency_hz)
            .number("feed_deg", "Feed", Unit::Degree, 6, |f| known(f, f.feed_rad))
            .number("error_deg", "Feed − stroke", Unit::Degree, 4, |f| known(f, f.error_rad))
            .number("off_deg", "Against slow ones", Unit::Degree, 3, |f| known(f, self.off_rad(f)))
            .number("runs_on_deg", "Runs on", Unit::Degree, 3, |f| known(f, f.runs_on_rad))
            .number("unlike_deg", "Unlike", Unit::Degree, 2, |f| known(f, f.unlike_rad))
            .number("peak_torque_nm", "Torque", Unit::NewtonMetre, 4, |f| f.peak.map(|p| p.torque_nm))
            .number("hertz_inner_mpa", "p₀ inner", Unit::Megapascal, 4, |f| {
                f.peak.map(|p| p.hertz_inner_pa)
            })
            .number("open_ms", "Open", Unit::Millisecond, 3, |f| f.open_s)
            .text("verdict", "Verdict", |f| Cell::Verdict(self.feeds(f), self.word(f).to_owned()))
            .json("strokes", |f| f.strokes)
            .json("held", |f| self.feeds(f))
            .json("ended", |f| f.ended.map(Stop::name))
    }
}
