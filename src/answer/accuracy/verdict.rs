//! Which setting of each method is the cheapest below a wanted error.

use crate::accuracy::{Precision, Scheme, WorkPoint};
use crate::report::significant;

/// Error of theta_bi that is wanted, rad: the tool's default tolerance.
pub(super) const WANTED_RAD: f64 = 1e-6;
/// The published scheme as it was published: step, s.
const PUBLISHED_STEP_S: f64 = 1e-5;

/// Fastest point of `method` at and beyond which every finer setting stays below [`WANTED_RAD`] too: one that is right
/// by chance does not count.
pub(super) fn cheapest(points: &[WorkPoint]) -> Option<&WorkPoint> {
    let good = |p: &WorkPoint| p.theta_error_rad.is_some_and(|e| e <= WANTED_RAD);
    let from = points.iter().rposition(|p| !good(p)).map_or(0, |i| i + 1);
    points.get(from..)?.iter().min_by(|a, b| a.seconds.total_cmp(&b.seconds))
}

/// Cheapest point of each method; the published scheme by its best band.
pub(super) fn winners(scene: &Precision) -> Vec<(Scheme, Option<&WorkPoint>)> {
    let mut list: Vec<(Scheme, Option<&WorkPoint>)> = Vec::new();
    for (method, points) in &scene.methods {
        let found = cheapest(points);
        match list.iter_mut().find(|(m, _)| m.key() == method.key()) {
            Some(entry) => {
                let better = match (entry.1, found) {
                    (Some(a), Some(b)) => b.seconds < a.seconds,
                    (None, Some(_)) => true,
                    _ => false,
                };
                if better {
                    *entry = (*method, found);
                }
            }
            None => list.push((*method, found)),
        }
    }
    list
}

/// Setting in words.
pub(super) fn setting(method: Scheme, point: &WorkPoint) -> String {
    match method {
        Scheme::Published(band) => format!("step {:e} s, band {band:.0e} m/s", point.setting),
        _ => format!("tolerance {:e}", point.setting),
    }
}

/// Name for people.
pub(super) fn name(method: Scheme) -> String {
    match method {
        Scheme::OneRun => "event, one run".to_owned(),
        Scheme::Full => "event, whole answer, full model".to_owned(),
        Scheme::Reduced => "event, whole answer, planned".to_owned(),
        Scheme::Published(band) => format!("published, band {band:.0e} m/s"),
    }
}

/// Time of the published scheme at its own step over that of one run of the event method at its cheapest: of the fastest and
/// of the slowest band.
pub(super) fn gains_over_published(scene: &Precision) -> Option<[f64; 2]> {
    let ours = winners(scene).into_iter().find(|w| w.0 == Scheme::OneRun)?.1?.seconds;
    let at_its_step = |(m, points): &(Scheme, Vec<WorkPoint>)| {
        let point = points.iter().find(|p| (p.setting / PUBLISHED_STEP_S - 1.0).abs() < 1e-9);
        point.filter(|p| m.band_m_s().is_some() && p.theta_error_rad.is_some()).map(|p| p.seconds / ours)
    };
    let gains = || scene.methods.iter().filter_map(at_its_step);
    gains().next()?;
    Some([gains().fold(f64::INFINITY, f64::min), gains().fold(0.0, f64::max)])
}

/// The verdict on one scene in one or two sentences.
pub(super) fn sentence(scene: &Precision) -> String {
    let mut parts = Vec::new();
    let list = winners(scene);
    let ours = list.iter().find(|w| w.0 == Scheme::OneRun).and_then(|w| w.1).map(|p| p.seconds);
    for (method, point) in &list {
        let bare = if method.band_m_s().is_some() { "published".to_owned() } else { name(*method) };
        parts.push(match point {
            Some(p) => {
                let ratio = match ours {
                    Some(t) if method.band_m_s().is_some() => {
                        format!(", {} times as long as one run", significant(p.seconds / t, 2))
                    }
                    _ => String::new(),
                };
                format!("{bare} {} ms ({}{ratio})", significant(1e3 * p.seconds, 3), setting(*method, p))
            }
            None => format!("{bare} never: {}", best(scene, *method)),
        });
    }
    let gain = gains_over_published(scene).map_or(String::new(), |gains| {
        let [least, most] = gains.map(|g| significant(g, 3));
        format!(
            " One run at that setting takes 1/{least} to 1/{most} of the time of the published scheme at its own step of \
             1e-5 s, by the band, whose error is {}.",
            at_its_step(scene)
        )
    });
    format!("{}: below {WANTED_RAD:.0e} rad: {}.{gain}", scene.scene, parts.join("; "))
}

/// The least error of a method in words, or that none of its settings came to the end of the scene.
fn best(scene: &Precision, method: Scheme) -> String {
    let errors = scene.methods.iter().filter(|(m, _)| m.key() == method.key());
    let least = errors.flat_map(|(_, p)| p).filter_map(|p| p.theta_error_rad).fold(f64::INFINITY, f64::min);
    match (least.is_finite(), method) {
        (true, _) => format!("best error {least:.1e} rad"),
        (false, Scheme::Published(_)) => "no step finished".to_owned(),
        (false, _) => "no tolerance finished".to_owned(),
    }
}

fn at_its_step(scene: &Precision) -> String {
    let errors: Vec<f64> = scene
        .methods
        .iter()
        .filter(|(m, _)| m.band_m_s().is_some())
        .flat_map(|(_, p)| p)
        .filter(|p| (p.setting / PUBLISHED_STEP_S - 1.0).abs() < 1e-9)
        .filter_map(|p| p.theta_error_rad)
        .collect();
    let (low, high) = errors.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), &e| (l.min(e), h.max(e)));
    if low == high { format!("{low:.1e} rad") } else { format!("{low:.1e} to {high:.1e} rad by the band") }
}
