//! The profile as it wears, fed back into the clutch.
use sprag_design::answer::Answer;
use sprag_design::clutch::{PittingStrength, Service};
use sprag_design::design::Design;
use sprag_design::life::{Life, Wear, WornState, life, worn, worn_life, worn_state};
use sprag_design::margin::{Capacities, LoadState, load_margins, load_state, lowest_capacity, overrun_at};
use sprag_design::wedge::{SpragDeviation, WedgeCurve};

const OIL: &str = include_str!("../../designs/lubricated.toml");

/// The lubricated clutch with a life of `hours` of overrun and engagements at 60 N m; `by`: wear coefficients over those of the file.
fn design(single: bool, hours: f64, by: f64) -> Design {
    let mut text = OIL.replace("wear_mm3_per_nm = 1e-9", &format!("wear_mm3_per_nm = {:e}", 1e-9 * by));
    if single {
        let arcs = text.find("inner_arcs = [").unwrap();
        let end = arcs + text[arcs..].find("\n]").unwrap() + 2;
        text.replace_range(arcs..end, "inner_arcs = [ { radius_mm = 4.02, until_rad = 0.45 } ]");
    }
    text += &format!(
        "\n[life]\nloads = [ {{ torque_nm = 60.0, engagements = 1e5 }} ]\noverruns = [ {{ scenario = \"overrun\", hours = {hours:?} }} ]\n"
    );
    Design::parse(&text, "worn.toml").unwrap()
}

fn of(design: &Design) -> (Service, Life, LoadState) {
    let service = design.service.clone().unwrap();
    let life = life(design, &service).unwrap();
    (service, life, load_state(design).unwrap())
}

#[test]
fn unworn_is_the_clutch_of_today() {
    let design = design(false, 100.0, 1.0);
    let (service, life, state) = of(&design);
    let now = worn_state(&design, &service, &life, 0.0, &Wear::default()).unwrap();
    let rows = load_margins(&design, &design.limits, Capacities::Wanted, &state);
    let (row, nm) = lowest_capacity(&rows, |_| true).unwrap();
    assert_eq!(now.capacity, Some((nm, row.code().to_string())));
    assert_eq!(now.first_tan_omega, Some(state.first_tan_omega));
    assert_eq!(now.lift_off_rad_s, sprag_design::margin::lift_off_rad_s(&design, &state, 6283.185307179586));
    assert_eq!([now.flat_m, now.opened_m, now.share], [0.0; 3]);
}

/// The same with a sliding contact that has the static friction: nothing but slip ends how it bites.
fn as_static(mut design: Design) -> Design {
    design.clutch.friction.kinetic = design.clutch.friction.static_;
    design
}

/// The lubricated clutch in a longer life, with a strength of its contacts.
fn pitted(hours: f64) -> Design {
    let mut design = as_static(design(false, hours, 1.0));
    design.service.as_mut().unwrap().pitting =
        Some(PittingStrength { pressure_pa: 3e9, cycles: 1e6, exponent: 20.0 / 3.0 });
    design
}

/// As drawn what a life uses up is what it uses up without wear; worn what it uses up in the clutch that is left; in between the integral.
#[test]
fn pitting_goes_with_the_worn_profile() {
    let design = pitted(300.0);
    let (service, drawn, state) = of(&design);
    let sums = |life: &Life| -> Vec<f64> {
        let contacts = life.used.iter().filter(|used| used.place.is_contact());
        contacts.map(|used| used.sum.unwrap()).collect()
    };
    let found = worn_life(&design, &service, &drawn).unwrap().unwrap();
    let within: Vec<_> = found.states.iter().filter(|s| s.share <= 1.0).collect();
    assert_eq!(within[0].pitting.map(Option::unwrap).to_vec(), sums(&drawn));
    let last = within[within.len() - 1];
    assert!(last.share == 1.0 && last.flat_m > 5e-7, "{last:?}");
    let left = Design { clutch: worn(&design, &state, &last.wear).unwrap().clutch, ..design.clone() };
    let by_hand = sums(&life(&left, &service).unwrap());
    for (i, by_hand) in by_hand.iter().enumerate() {
        let there = last.pitting[i].unwrap();
        println!("{i}: drawn {}, worn {there}, by hand {by_hand}", sums(&drawn)[i]);
        assert!((there / by_hand - 1.0).abs() < 1e-3, "{i}: {there} {by_hand}");
        let over_life = found.pitting()[i].unwrap();
        let half = over_life - 0.5 * (sums(&drawn)[i] + there);
        assert!(
            half.abs() < 0.5 * (there - sums(&drawn)[i]).abs() && there != sums(&drawn)[i],
            "{i}: {over_life}"
        );
    }
}

/// V = k int N ds by hand: the force at the start, that falls by parts in a thousand in so short a life.
#[test]
fn the_volume_is_archards() {
    let design = design(false, 1e-3, 1.0);
    let (service, life, state) = of(&design);
    let found = worn_life(&design, &service, &life).unwrap().unwrap();
    let at = found.states.iter().find(|s| s.share == 1.0).unwrap();
    let sliding = 1036.0 * std::f64::consts::PI / 30.0;
    let point = overrun_at(&design, &state, 0.0, sliding).unwrap();
    let path_m = sliding * 11.11e-3 * 3.6;
    let rubbed = point.lubricated.unwrap().film.asperities * point.state.normal_inner_n * path_m;
    println!("{} N over {path_m} m: {} m^3", point.state.normal_inner_n, at.wear.sprag_m3);
    assert!((at.wear.sprag_m3 / (1e-18 * rubbed) - 1.0).abs() < 5e-3, "{} m^3", at.wear.sprag_m3);
    // Twelve sprags on one track; engagements apart.
    let creep = worn_life(&self::design(false, 1e-12, 1.0), &service_of(1e-12), &life).unwrap().unwrap();
    let of_engagements = creep.states.iter().find(|s| s.share == 1.0).unwrap().wear.inner_track_m;
    let track = (at.wear.inner_track_m - of_engagements) * std::f64::consts::TAU * 11.11e-3 * 6e-3;
    assert!((track / (12.0 * at.wear.sprag_m3) - 1.0).abs() < 1e-6, "{track} m^3");
}

fn service_of(hours: f64) -> Service {
    design(false, hours, 1.0).service.unwrap()
}

/// Volume that wears off from the first of the `states` to the last, m^3, `rate` by the share of the life: Simpson over each stretch, its
/// middle by the mean wear of its ends, which bends little.
pub fn worn_off_m3(states: &[&WornState], rate: impl Fn(&Wear) -> f64) -> f64 {
    let mut volume = 0.0;
    for pair in states.windows(2) {
        let (a, b) = (&pair[0].wear, &pair[1].wear);
        let middle = Wear {
            sprag_m3: 0.5 * (a.sprag_m3 + b.sprag_m3),
            inner_track_m: 0.5 * (a.inner_track_m + b.inner_track_m),
            outer_track_m: 0.5 * (a.outer_track_m + b.outer_track_m),
            inner_arcs_m: [0, 1].map(|i| 0.5 * (a.inner_arcs_m[i] + b.inner_arcs_m[i])),
            outer_arc_m: 0.5 * (a.outer_arc_m + b.outer_arc_m),
        };
        volume += (pair[1].share - pair[0].share) / 6.0 * (rate(a) + 4.0 * rate(&middle) + rate(b));
    }
    volume
}

/// int k N ds over a long life, summed here from the states of a march with other steps: the force falls as the spring relaxes.
#[test]
fn over_a_life_the_volume_is_the_integral_of_the_force() {
    let design = design(true, 200.0, 1.0);
    let (service, life, state) = of(&design);
    let found = worn_life(&design, &service, &life).unwrap().unwrap();
    let sliding = 1036.0 * std::f64::consts::PI / 30.0;
    let rate = |wear: &Wear| {
        let turned = worn(&design, &state, wear).unwrap().turned_rad;
        let relaxed = LoadState { alpha_max_rad: state.alpha_max_rad - turned, ..state.clone() };
        let p = overrun_at(&design, &relaxed, 0.0, sliding).unwrap();
        1e-18
            * p.lubricated.unwrap().film.asperities
            * p.state.normal_inner_n
            * sliding
            * 11.11e-3
            * 200.0
            * 3600.0
    };
    let states: Vec<_> = found.states.iter().filter(|s| s.share <= 1.0).collect();
    assert!(states.len() > 4, "{}", states.len());
    let volume = worn_off_m3(&states, rate);
    let last = states[states.len() - 1];
    println!(
        "{volume} m^3 by hand, {} m^3; flat {} m, turned force {} N",
        last.wear.sprag_m3, last.flat_m, last.normal_n
    );
    assert!((volume / last.wear.sprag_m3 - 1.0).abs() < 1e-3, "{volume} against {}", last.wear.sprag_m3);
    assert!(last.normal_n < 0.999 * states[0].normal_n, "the force does not fall");
    // The flat raises what first contact asks for, and opens the gap.
    assert!(last.first_tan_omega > states[0].first_tan_omega && last.opened_m > 0.0);
}

/// The lens between drawn profile and track, by the area that two circles share, is the volume worn.
#[test]
fn the_flat_has_the_volume_worn() {
    let design = design(true, 100.0, 1.0);
    let (.., state) = of(&design);
    for volume in [1e-13, 1e-12, 5e-12] {
        let worn = worn(&design, &state, &Wear { sprag_m3: volume, ..Wear::default() }).unwrap();
        let profile = worn.clutch.profile().unwrap();
        // The drawn arc goes on after the edge; the axis lies OC_e below C_e at first contact.
        let arc = profile.arcs[1];
        assert!((arc.radius_m - 4.02e-3).abs() < 1e-15);
        let axis_m =
            (arc.centre_m.x.powi(2) + (arc.centre_m.y + profile.outer_centre_distance_m).powi(2)).sqrt();
        let (r, big) = (4.02e-3_f64, 11.11e-3_f64);
        let deep_m = r + big - axis_m;
        // Area of a circular segment of half angle u: R^2 (u - sin u cos u), 2/3 u^3 for small u, without its cancelling digits.
        let cosine = |a: f64, b: f64| (a * a + axis_m * axis_m - b * b) / (2.0 * a * axis_m);
        let segment = |a: f64, b: f64| {
            let u = (1.0 - cosine(a, b).powi(2)).sqrt().asin();
            a * a * u.powi(3) * (2.0 / 3.0 - 2.0 / 15.0 * u * u)
        };
        let area = segment(r, big) + segment(big, r);
        println!("{volume:e} m^3: {deep_m:e} m deep ({:e} said), lens {:e} m^3", worn.flat_m[0], area * 6e-3);
        assert!((area * 6e-3 / volume - 1.0).abs() < 0.015, "{area}");
        assert!((deep_m / worn.flat_m[0] - 1.0).abs() < 0.015, "{deep_m} m against {}", worn.flat_m[0]);
    }
}

/// Parallel wear is a smaller sprag: what [`WedgeCurve::of_sprag`] computes by another way; and to first order it is linear.
#[test]
fn parallel_wear_is_a_smaller_sprag() {
    let design = design(false, 100.0, 1.0);
    let (.., state) = of(&design);
    let at = |off_m: f64| {
        let wear = Wear { inner_arcs_m: [0.5 * off_m, 0.0], outer_arc_m: 0.5 * off_m, ..Wear::default() };
        let worn = worn(&design, &state, &wear).unwrap();
        WedgeCurve::build(&worn.clutch, &worn.clutch.profile().unwrap(), 0.0).unwrap()
    };
    let drawn = state.curve.touch().t_ratio;
    let off_m = 2e-6;
    let smaller =
        state.curve.of_sprag(SpragDeviation { size_m: -off_m, ..SpragDeviation::default() }).unwrap();
    let (a, b) = (at(off_m).touch().t_ratio, smaller.touch().t_ratio);
    println!("tan omega at first contact: {drawn}, {a}, of_sprag {b}");
    assert!((a / b - 1.0).abs() < 1e-9, "{a} against {b}");
    let torque = at(off_m).at_torque(50.0).unwrap();
    let same = smaller.at_torque(50.0).unwrap();
    assert!((torque.normal_inner_n / same.normal_inner_n - 1.0).abs() < 1e-4, "{torque:?}");
    let ratio = (at(2e-8).touch().t_ratio - drawn) / (at(1e-8).touch().t_ratio - drawn);
    assert!((ratio - 2.0).abs() < 1e-3, "{ratio}");
}

/// Depths along the arcs: a profile off by h_0 + h_1 t of its support has the support of the drawn one less that, at every turn.
#[test]
fn what_a_path_takes_is_taken_where_it_says() {
    let design = design(false, 100.0, 1.0);
    let (.., state) = of(&design);
    let wear = Wear { inner_arcs_m: [1e-6, 2e-6], ..Wear::default() };
    let found = worn(&design, &state, &wear).unwrap();
    let (drawn, worn) = (&state.profile, found.clutch.profile().unwrap());
    // Both about C_e; the worn body frame is turned so that contact directions of the drawn turn t are those of t - t_0.
    let shift = drawn.arcs[2].until_rad - worn.arcs[2].until_rad;
    let support = |p: &sprag_design::profile::Profile, k: usize, t: f64| {
        p.arcs[k].centre_m.dot(&p.contact_direction(t)) + p.arcs[k].radius_m
    };
    for (k, t) in [(0, 0.03), (1, 0.09), (2, 0.2), (2, 0.4)] {
        let off = support(drawn, k, t) - support(&worn, k, t - shift);
        let want = 1e-6 + 2e-6 * t;
        println!("turn {t}: {off:e} m off, {want:e} wanted");
        assert!((off / want - 1.0).abs() < 0.02, "{off:e} against {want:e}");
    }
}

/// A life that wears a sprag until it slips is not held, and says so; without oil nothing is known to wear; an overrun that is none is refused.
#[test]
fn a_life_tells_when_wear_ends_it() {
    let answer = design(false, 20_000.0, 1.0);
    let answer = answer.life().unwrap();
    let (share, why) = answer.worn.as_ref().unwrap().broken().unwrap();
    println!("{}", answer.verdict());
    assert!(share < 1.0 && why.names().0 == "re-engagement", "{share} {why:?}");
    assert!(answer.verdict().starts_with("NOT HELD") && answer.verdict().contains("bite no more"));
    let body = serde_json::to_value(answer.envelope(0.0).body).unwrap();
    assert_eq!(body["wear"]["broken_by"], "re-engagement");
    // That is where first contact asks for the kinetic friction; where that is the static one, it slips later.
    let last = answer.worn.as_ref().unwrap().states.iter().find(|s| s.share == share).unwrap();
    assert!((last.first_tan_omega.unwrap() / 0.09 - 1.0).abs() < 1e-3, "{last:?}");
    let as_static = as_static(design(false, 20_000.0, 1.0));
    let as_static = as_static.life().unwrap();
    let (later, why) = as_static.worn.as_ref().unwrap().broken().unwrap();
    assert!(share < later && later < 1.0 && why.names().0 == "friction", "{share} {later} {why:?}");
    assert!(as_static.verdict().contains("slip"));
    assert_eq!(body["wear"]["states"].as_array().unwrap().len(), answer.worn.as_ref().unwrap().states.len());
    let oil = OIL.find("[lubrication]").unwrap()..OIL.find("[[scenarios]]").unwrap();
    let mut dry = OIL.to_owned();
    dry.replace_range(oil, "");
    dry += "\n[life]\nloads = [ { torque_nm = 60.0, engagements = 1e5 } ]\noverruns = [ { scenario = \"overrun\", hours = 10.0 } ]\n";
    let dry = Design::parse(&dry, "dry.toml").unwrap();
    assert!(dry.life().unwrap().worn.is_none());
    let wrong = OIL.to_owned()
        + "\n[life]\nloads = [ { torque_nm = 60.0, engagements = 1e5 } ]\noverruns = [ { scenario = \"nowhere\", hours = 10.0 } ]\n";
    let why = Design::parse(&wrong, "wrong.toml").unwrap_err().to_string();
    assert!(why.contains("life.overruns[0].scenario"), "{why}");
}

/// Limits at nominal torque are held at the loads up to it, those at peak torque at every load.
#[test]
fn a_seldom_peak_is_held_to_the_limits_of_the_peak() {
    let held = |peak_nm: f64| {
        let text = OIL.replace("hertz_nominal_mpa = 4200.0", "hertz_nominal_mpa = 3750.0")
            + &format!(
                "\n[life]\nloads = [ {{ torque_nm = 60.0, engagements = 1e5 }}, {{ torque_nm = {peak_nm:?}, engagements = 10 }} ]\noverruns = [ {{ scenario = \"overrun\", hours = 1.0 }} ]\n"
            );
        let design = Design::parse(&text, "worn.toml").unwrap();
        let (service, life, _) = of(&design);
        worn_state(&design, &service, &life, 0.0, &Wear::default()).unwrap()
    };
    let fair = held(105.0);
    assert!(fair.broken.is_none(), "{fair:?}");
    let often = held(89.9);
    let (nominal_nm, code) = often.capacity.unwrap();
    assert!(code.ends_with("nominal-inner") && nominal_nm < 90.0, "{code} at {nominal_nm}");
    assert_eq!(often.broken, Some(sprag_design::life::Broken::Torque));
    assert_eq!(held(125.0).broken, Some(sprag_design::life::Broken::Torque));
}

/// A clutch of one arc with law `elastic`, as `new` makes it for a bore of 40 mm and 1000 N m.
const ELASTIC: &str = r#"schema = 1
name = "bore of 40 mm"
[sprags]
count = 25
length_mm = 17.5
outer_radius_mm = 5.5
centre_distance_mm = 0.6294
inner_arcs = [{ radius_mm = 2.915, until_rad = 0.4084 }]
flanks = { rear_mm = 2.3167, front_mm = 1.666 }
[races]
inner_bore_radius_mm = 20.0
inner_radius_mm = 28.4
outer_radius_mm = 36.73
outer_outside_radius_mm = 46.6
width_mm = 20.5
viscous_damping_nm_s_per_rad = 0.1
[spring]
stiffness_nm_per_rad = 0.01205
drag_torque_nm = 0.1065
[material]
name = "100Cr6"
[friction]
static = 0.11
kinetic = 0.099
decay_s_per_m = 5.0
[limits]
from_material = true
nominal_torque_nm = 1000.0
[lubrication]
oil = "ISO VG 32"
temperature_c = 60.0
race_roughness_um = 0.25
sprag_roughness_um = 0.25
boundary_friction = 0.11
sprag_wear_mm3_per_nm = 1e-9
race_wear_mm3_per_nm = 1e-9
[life]
loads = [ { torque_nm = 1000.0, engagements = 1e4 } ]
overruns = [ { scenario = "overrun", hours = 1000.0 } ]
[[scenarios]]
name = "overrun"
kind = "overrun"
speed_rpm = 2000.0
overrun_rpm = 1000.0
"#;

/// The edge of the first flat, a thousandth of the arc, has all the change of curvature in a hair: curves are found over it, and
/// the first wear changes little.
#[test]
fn wear_of_an_elastic_clutch_begins_where_the_drawn_one_is() {
    let design = Design::parse(ELASTIC, "elastic.toml").unwrap();
    let (service, life, state) = of(&design);
    let found = worn_life(&design, &service, &life).unwrap().unwrap();
    let at: Vec<_> = found
        .states
        .iter()
        .map(|s| (s.share, s.flat_m, s.first_tan_omega, s.capacity.clone(), s.broken))
        .collect();
    println!("{at:#?}");
    let unworn = found.states[0].capacity.clone().unwrap().0;
    for pair in found.states.windows(2) {
        assert!(pair[1].first_tan_omega.unwrap() > pair[0].first_tan_omega.unwrap());
    }
    assert_eq!(found.states[0].first_tan_omega, Some(state.first_tan_omega));
    assert!(found.states.len() > 5 && found.states[1].broken.is_none());
    let (nm, _) = found.states[1].capacity.clone().unwrap();
    assert!((nm / unworn - 1.0).abs() < 0.02, "{nm} beside {unworn}");
}

/// With a law for which both edges are found: what two blunt ones say of the sharp one, straight on.
#[test]
fn the_life_with_a_sharp_edge_follows_from_two_blunt_ones() {
    use sprag_design::life::{BLUNT, BLUNT_BY_RADIUS, worn_life_with};
    let design = design(false, 200.0, 1.0);
    let (service, life, _) = of(&design);
    let lasts =
        |blunt: f64| worn_life_with(&design, &service, &life, blunt).unwrap().unwrap().broken().unwrap();
    let [sharp, blunt, blunter] = [BLUNT, BLUNT_BY_RADIUS, 2.0 * BLUNT_BY_RADIUS].map(lasts);
    let said = blunt.0 - (blunter.0 - blunt.0) * (1.0 - BLUNT / BLUNT_BY_RADIUS);
    println!("{sharp:?}, {blunt:?}, {blunter:?}: {said}");
    assert!(sharp.1 == blunt.1 && (blunt.0 / sharp.0 - 1.0).abs() > 0.1);
    // The blunt one is 17 % off, this 4 %.
    assert!((said / sharp.0 - 1.0).abs() < 0.05, "{said} {sharp:?}");
}

#[test]
fn an_elastic_clutch_says_what_a_sharp_edge_would_be() {
    let design = Design::parse(ELASTIC, "elastic.toml").unwrap();
    let (service, life, _) = of(&design);
    let found = worn_life(&design, &service, &life).unwrap().unwrap();
    println!("{:?} {:?}", found.broken(), found.sharp_share);
    assert_eq!(found.broken().is_some(), found.sharp_share.is_some());
    if let (Some((share, _)), Some(sharp)) = (found.broken(), found.sharp_share) {
        assert!(sharp < share && sharp > 0.5 * share, "{sharp} {share}");
    }
}
