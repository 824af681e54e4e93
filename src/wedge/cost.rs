//! What a curve of many arcs costs: closures, counted.

use super::closure::CLOSURES;
use super::curve::WedgeCurve;
use crate::design::Design;
use crate::profile::Profile;

/// Curve of the paper's clutch with its profile cut into `arcs` arcs of nearly one radius.
fn cut(arcs: usize) -> WedgeCurve {
    let text = include_str!("../../designs/huang2017-multi-arc.toml");
    let [from, until] = ["inner_arcs = [", "[races]"].map(|mark| text.find(mark).unwrap());
    let rows: String = (1..=arcs)
        .map(|k| (k as f64 / arcs as f64, 0.45 * k as f64 / arcs as f64))
        .map(|(share, until)| format!("{{ radius_mm = {}, until_rad = {until} }},", 4.05 + 0.1 * share))
        .collect();
    let text = format!("{}inner_arcs = [{rows}]\n{}", &text[..from], &text[until..]);
    let text = text.replace("law = \"roller\"", "law = \"hertz\"").replace("roller_coefficient", "# ");
    let text = &text[..text.find("[optimize]").unwrap()];
    let clutch = Design::parse(text, "x.toml").unwrap().clutch;
    let (sprags, races) = (&clutch.sprags, &clutch.races);
    let each: Vec<(f64, f64)> = sprags.inner_arcs.iter().map(|a| (a.radius_m, a.until_rad)).collect();
    let profile = Profile::new(
        sprags.outer_radius_m,
        sprags.centre_distance_m,
        &each,
        races.inner_radius_m,
        races.outer_radius_m,
    );
    WedgeCurve::build(&clutch, &profile.unwrap(), 0.0).unwrap()
}

/// Closures that `work` takes.
fn closures(work: impl FnOnce()) -> usize {
    let before = CLOSURES.get();
    work();
    CLOSURES.get() - before
}

#[test]
fn the_work_of_a_curve_grows_with_its_arcs_and_that_of_a_state_does_not() {
    let of = |arcs: usize| {
        let mut curve = None;
        let build = closures(|| curve = Some(cut(arcs)));
        let curve = curve.unwrap();
        let straddles = closures(|| assert!(!curve.straddles().is_empty()));
        let state = closures(|| assert!(curve.at_torque(0.9 * curve.end_torque_nm()).is_some()));
        let reached = curve.arc_count() as f64;
        assert!(reached > 0.5 * arcs as f64);
        [build as f64 / reached, straddles as f64 / reached, state as f64]
    };
    let (few, many) = (of(10), of(40));
    for (few, many) in few.into_iter().zip(many) {
        assert!(many < 1.3 * few, "closures per arc, and of a state: {few} with 10 arcs, {many} with 40");
    }
}
