//! Designs side by side: what differs in their files, and what comes of it.
//!
//! In: designs. Out: [`Subject`] (statics, margins, scenes of one), [`SideBySide`] of several. Absent: which of them is better, units of
//! reports. Equations: none; every figure is that of `margin`, `wedge` and `scenario`.

mod subject;

pub use subject::{Scene, Subject};

use crate::design::Design;
use crate::file::{Input, inputs};
use crate::margin::Margin;
use crate::profile::Profile;

/// The same thing of several designs, in their order; none of a design that has no such thing.
#[derive(Debug, Clone, PartialEq)]
pub struct SideBySide<T> {
    /// What it is: path of an input, code of a limit, name of a scene.
    pub key: String,
    /// Of each design.
    pub values: Vec<Option<T>>,
}

/// Keys that say nothing of the clutch.
const NAMES: [&str; 2] = ["schema", "name"];

/// Inputs that differ: another value, or there in one file and not in another.
pub fn inputs_that_differ(designs: &[&Design]) -> Vec<SideBySide<Input>> {
    let all: Vec<Vec<(String, Input)>> = designs
        .iter()
        .map(|d| inputs(&d.source).into_iter().map(|i| (i.path.clone(), i)).collect())
        .collect();
    let mut rows = side_by_side(all);
    rows.retain(|row| !NAMES.contains(&row.key.as_str()) && differs(&row.values));
    rows
}

fn differs(values: &[Option<Input>]) -> bool {
    let Some((first, others)) = values.split_first() else { return false };
    others.iter().any(|other| match (first, other) {
        (Some(a), Some(b)) => !a.says_the_same(b),
        (None, None) => false,
        _ => true,
    })
}

/// Every margin that one of them has.
pub fn margins(subjects: &[Subject]) -> Vec<SideBySide<&Margin>> {
    side_by_side(subjects.iter().map(|s| s.margins.iter().map(|m| (m.code(), m)).collect()).collect())
}

/// Every scene that one of them has.
pub fn scenes(subjects: &[Subject]) -> Vec<SideBySide<&Scene>> {
    side_by_side(subjects.iter().map(|s| s.scenes.iter().map(|c| (c.name.clone(), c)).collect()).collect())
}

/// Keys in the order of the first list, those that it lacks behind the one that they follow in theirs.
fn side_by_side<T>(lists: Vec<Vec<(String, T)>>) -> Vec<SideBySide<T>> {
    let count = lists.len();
    let mut rows: Vec<SideBySide<T>> = Vec::new();
    for (k, list) in lists.into_iter().enumerate() {
        let mut behind = 0;
        for (key, value) in list {
            let at = rows.iter().position(|row| row.key == key).unwrap_or_else(|| {
                rows.insert(behind, SideBySide { key, values: (0..count).map(|_| None).collect() });
                behind
            });
            rows[at].values[k] = Some(value);
            behind = at + 1;
        }
    }
    rows
}

/// Points of [`proud_m`] on each arc.
const PER_ARC: usize = 40;

/// By how much the inner profile of `after` stands outside that of `before`, m, over the turn of the contact since first
/// contact of `before`, rad: measured along the direction in which the contact looks. The bodies are laid over one another by the centre of
/// the outer arc, as they stand at first contact; or by the centre of the first inner arc, too, where they then are nearer: one sprag is the
/// same between other races.
pub fn proud_m(before: &Profile, after: &Profile) -> Vec<[f64; 2]> {
    let farthest = |points: &[[f64; 2]]| points.iter().fold(0.0_f64, |most, p| most.max(p[1].abs()));
    let centre_rad = |p: &Profile| p.arcs.first().map_or(0.0, |a| a.centre_m.x.atan2(a.centre_m.y));
    let standing = laid_m(before, after, 0.0);
    let by_centres = laid_m(before, after, centre_rad(after) - centre_rad(before));
    let covers = 2 * by_centres.len() > standing.len();
    if covers && farthest(&by_centres) < farthest(&standing) { by_centres } else { standing }
}

/// The same with `after` turned by `turned_rad`.
fn laid_m(before: &Profile, after: &Profile, turned_rad: f64) -> Vec<[f64; 2]> {
    let until = before.end_turn_rad();
    let ends = before.arcs.iter().map(|a| a.until_rad);
    let starts: Vec<f64> = std::iter::once(0.0).chain(ends).collect();
    let turns = starts
        .windows(2)
        .flat_map(|w| (0..=PER_ARC).map(move |i| w[0] + (w[1] - w[0]) * i as f64 / PER_ARC as f64));
    // The same direction in the other body, whose first contact may look another way.
    let ahead = after.beta0_rad - before.beta0_rad - turned_rad;
    turns
        .filter(|&t| t <= until && t + ahead <= after.end_turn_rad())
        .map(|t| [t, reach_m(after, t + ahead) - reach_m(before, t)])
        .collect()
}

/// Distance from the body frame's origin to the tangent of the profile where the contact has turned by `turn_rad`, m.
fn reach_m(profile: &Profile, turn_rad: f64) -> f64 {
    let arc = profile.arcs.iter().find(|a| turn_rad <= a.until_rad).or(profile.arcs.last());
    let direction = profile.contact_direction(turn_rad);
    arc.map_or(f64::NAN, |a| a.centre_m.dot(&direction) + a.radius_m)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::with_setting;

    const TEXT: &str = include_str!("../../designs/huang2017-multi-arc.toml");

    fn design(changes: &[(&str, &str)]) -> Design {
        let set = |text: String, (path, value): &(&str, &str)| with_setting(&text, path, value).unwrap();
        Design::parse(&changes.iter().fold(TEXT.to_owned(), set), "a.toml").unwrap()
    }

    #[test]
    fn what_differs_is_listed_and_nothing_else() {
        let (a, b) =
            (design(&[]), design(&[("r_i2_mm", "4.2"), ("name", "other"), ("sprags.mass_kg", "0.0018")]));
        let c = design(&[("limits.windup_nominal_deg", "7")]);
        let rows = inputs_that_differ(&[&a, &b, &c]);
        let found: Vec<(&str, Vec<&str>)> = rows
            .iter()
            .map(|r| (&*r.key, r.values.iter().map(|v| v.as_ref().map_or("", |i| &*i.text)).collect()))
            .collect();
        assert_eq!(
            found,
            [
                ("sprags.inner_arcs[1].radius_mm", vec!["4.08", "4.2", "4.08"]),
                ("limits.windup_nominal_deg", vec!["", "", "7"])
            ]
        );
        assert!(inputs_that_differ(&[&a, &a]).is_empty());
    }

    #[test]
    fn a_larger_second_arc_stands_proud_from_its_junction_on() {
        let place = |d: &Design| d.clutch.profile().unwrap();
        let (a, b) = (place(&design(&[])), place(&design(&[("r_i2_mm", "4.2")])));
        let proud = proud_m(&a, &b);
        assert!(proud_m(&a, &a).iter().all(|p| p[1] == 0.0));
        // Tangent arcs: (r' - r)(1 - cos(turn since the junction)) on the second arc.
        for [turn, h] in proud {
            let expected = match turn {
                t if t <= 0.06 => 0.0,
                t if t <= 0.12 => 0.12e-3 * (1.0 - (t - 0.06).cos()),
                _ => continue,
            };
            assert!((h - expected).abs() < 1e-15, "{turn}: {h} {expected}");
        }
    }

    #[test]
    fn the_same_sprag_between_other_races_is_the_same() {
        let place = |d: &Design| d.clutch.profile().unwrap();
        let (a, b) = (place(&design(&[])), place(&design(&[("races.outer_radius_mm", "19.46")])));
        let proud = proud_m(&a, &b);
        assert!(a.beta0_rad != b.beta0_rad && proud.len() > 50);
        assert!(proud.iter().filter(|p| p[0] < 0.03).all(|p| p[1].abs() < 1e-15));
    }

    #[test]
    fn rows_keep_the_order_of_every_list() {
        let list = |keys: &str| keys.chars().map(|c| (c.to_string(), c)).collect::<Vec<_>>();
        let rows = side_by_side(vec![list("abd"), list("acd"), list("xe")]);
        let keys: String = rows.iter().map(|r| r.key.as_str()).collect();
        assert_eq!(keys, "xeacbd");
        assert_eq!(rows[3].values, [None, Some('c'), None]);
    }
}
