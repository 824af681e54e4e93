//! All sprags, each in its own gap.

use super::Vector;
use super::common::{MULTI, clutch};
use sprag_design::clutch::Carrier;
use sprag_design::design::Design;
use sprag_design::margin::{
    Capacities, LoadState, Margin, RunOut, load_margins, load_state, run_out_margins,
};
use sprag_design::wedge::{StaticPoint, WedgeCurve};

const DESIGN: &str = include_str!("../../designs/huang2017-multi-arc.toml");
const LARGER: [(&str, &str); 4] = [
    ("\ninner_bore_radius_mm = 7.21", "\ninner_bore_radius_mm = 60.0"),
    ("\ninner_radius_mm = 11.11", "\ninner_radius_mm = 100.0"),
    ("\nouter_radius_mm = 19.44", "\nouter_radius_mm = 108.33"),
    ("outer_outside_radius_mm = 26.23", "outer_outside_radius_mm = 150.0"),
];

/// The design without [optimize], with each `from` replaced once and its axes apart.
pub fn off_centre(keys: &str, changes: &[(&str, &str)]) -> (Design, LoadState) {
    let mut text = DESIGN[..DESIGN.find("[optimize]").unwrap()].to_owned();
    let apart = format!("eccentricity = {{ {keys} }}\nwidth_mm = 6.0      ");
    for (from, to) in changes.iter().copied().chain([("width_mm = 6.0      ", apart.as_str())]) {
        assert!(text.contains(from), "the design no longer holds {from:?}");
        text = text.replacen(from, to, 1);
    }
    let design = Design::parse(&text, "off-centre.toml").unwrap_or_else(|e| panic!("{e}"));
    let state = load_state(&design).unwrap();
    (design, state)
}

pub fn ring(keys: &str) -> (Design, LoadState, RunOut) {
    let (design, state) = off_centre(keys, &[]);
    let ring = RunOut::new(&design, &state).unwrap();
    (design, state, ring)
}

pub fn row<'a>(rows: &'a [Margin], code: &str) -> &'a Margin {
    rows.iter().find(|r| r.code() == code).unwrap_or_else(|| panic!("no row {code}"))
}

#[test]
fn without_the_key_there_is_nothing() {
    let design = Design::parse(DESIGN, "x.toml").unwrap();
    assert!(RunOut::new(&design, &load_state(&design).unwrap()).is_none());
}

/// Axes on one another: every row is that of the even clutch, however it is asked for.
#[test]
fn no_offset_changes_nothing() {
    for keys in
        ["offset_mm = 0", "offset_mm = 0.0, turning = true", "offset_mm = 0, bearing_stiffness_n_per_um = 0"]
    {
        let (design, state, ring) = ring(keys);
        let even = load_margins(&design, &design.limits, Capacities::Wanted, &state);
        let rows = run_out_margins(&design, &design.limits, &ring, Capacities::Wanted);
        assert_eq!(rows.len(), 10);
        for r in &rows {
            let Some(code) = r.code().strip_prefix("run-out-").map(str::to_owned) else {
                panic!("{}", r.code())
            };
            let Some(of_all) = even.iter().find(|e| e.code() == code) else { continue };
            let same = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-9;
            assert!(
                same(r.demand_in_unit().unwrap(), of_all.demand_in_unit().unwrap())
                    && same(r.allowable_in_unit(), of_all.allowable_in_unit()),
                "{r:?} {of_all:?}"
            );
            assert!((r.margin() - of_all.margin()).abs() < 1e-8, "{r:?} {of_all:?}");
            let end = state.curve.end_torque_nm();
            let reached = of_all.torque_capacity_nm.filter(|t| *t < end * (1.0 - 1e-9));
            if let (Some(a), Some(b)) = (r.torque_capacity_nm, reached) {
                assert!((a - b).abs() < 1e-4 * end, "{r:?} {of_all:?}");
            } else {
                assert_eq!(r.torque_capacity_nm.is_some(), reached.is_some(), "{r:?} {of_all:?}");
            }
        }
        let survey = ring.survey(90.0).unwrap();
        let even_n = state.curve.at_torque(90.0).unwrap().normal_inner_n;
        for l in survey.rounds.iter().flat_map(|r| &r.loads) {
            assert!((l.normal_n / even_n - 1.0).abs() < 1e-9, "{l:?}");
        }
        assert!(survey.radial_n() < 1e-6 && survey.unloaded() == 0);
        assert!(
            (row(&rows, "run-out-end").allowable_in_unit() / state.curve.end_torque_nm() - 1.0).abs() < 1e-9
        );
    }
}

/// tan omega and tan nu of the rigid sprag of Table 1 at first contact with the inner race moved to `offset`: two circles
/// about C_e and O_i cut in C_1; A and B lie on the normals.
fn first_tangents(offset: Vector) -> [f64; 2] {
    let (c_e, b) = (Vector::new(19.44e-3 - 4.68e-3, 0.0), Vector::new(19.44e-3, 0.0));
    let (e, reach) = (0.62e-3, 11.11e-3 + 4.02e-3);
    let base = c_e - offset;
    let along = (base.norm_squared() + reach * reach - e * e) / (2.0 * base.norm());
    let across = (reach * reach - along * along).sqrt();
    let unit = base.normalize();
    // The cut towards positive azimuth.
    let normal = (along * unit + across * Vector::new(-unit.y, unit.x)) / reach;
    let strut = b - (offset + 11.11e-3 * normal);
    [-normal.perp(&strut) / normal.dot(&strut), -strut.y / strut.x]
}

/// Logarithmic slope of N over the windup at a point of the even curve.
fn power(state: &LoadState, even: &StaticPoint) -> f64 {
    let beside = state.curve.at_normal(1.001 * even.normal_inner_n).unwrap();
    1.001_f64.ln() / (beside.windup_rad / even.windup_rad).ln()
}

/// For a small offset and a small torque by hand: the strut shortens by R_i sin omega dW where the offset stays with the
/// outer race, by R_e sin nu dW where it stays with the inner, and N goes as a power of that; omega and nu are those of
/// the rigid sprag at first contact in its own gap.
#[test]
fn the_share_of_a_small_offset_by_hand() {
    let offset = 2e-6;
    for (carrier, at) in [("outer-race", 0), ("inner-race", 1)] {
        let (_, state, ring) = ring(&format!("offset_mm = 0.002, stays_with = \"{carrier}\""));
        let torque = 0.5;
        let even = state.curve.at_torque(torque).unwrap();
        let power = power(&state, &even);
        assert!((1.05..1.15).contains(&power), "{power}");
        let by_hand = |azimuth: f64| {
            let (s, c) = azimuth.sin_cos();
            let here = first_tangents(Vector::new(-offset * c, offset * s))[at];
            power * (here / first_tangents(Vector::zeros())[at] - 1.0)
        };
        let round = &ring.survey(torque).unwrap().rounds[0];
        let mut largest = [0.0_f64; 2];
        for l in &round.loads {
            let azimuth = ring.seats[l.seat].azimuth_rad;
            let found = l.normal_n / even.normal_inner_n - 1.0;
            assert!((found - by_hand(azimuth)).abs() < 1e-4, "{azimuth}: {found} {}", by_hand(azimuth));
            largest = [largest[0].max(found), largest[1].max((found - by_hand(-azimuth)).abs())];
        }
        // Both are felt: the gap, and the tilt, by which sprags at psi and -psi differ.
        println!("{carrier}: {largest:?}");
        assert!(largest[0] > 2.5e-3 && largest[1] > 5e-4, "{largest:?}");
    }
}
/// A clutch that has turned half round against the offset: the sprag of the widest gap stands in the narrowest, wound up
/// by 2 e cos nu/(R_i sin omega) more than its neighbours at the sides, and carries most.
#[test]
fn turning_against_the_offset_is_the_hard_case() {
    let (_, state, standing) = ring("offset_mm = 0.01");
    let (_, _, turning) = ring("offset_mm = 0.01, turning = true");
    assert_eq!(turning.turns, (0..12).collect::<Vec<_>>());
    let (still, turned) = (standing.survey(90.0).unwrap(), turning.survey(90.0).unwrap());
    assert_eq!(still.rounds[0], turned.rounds[0]);
    let half = &turned.rounds[6];
    let (share, worst) = half.share();
    assert_eq!((worst.engaged, worst.seat), (0, 6));
    // By hand: dN/dW of the even curve times that windup.
    let even = state.curve.at_torque(90.0).unwrap();
    let power = power(&state, &even);
    let more = 2.0 * 10e-6 / (11.11e-3 * state.first_tan_omega);
    let want = power * more / even.windup_rad;
    let rest = still.rounds[0].share().0 - 1.0;
    assert!((share - 1.0 - want).abs() < 1.5 * rest, "{share} {want} {rest}");
    // At a light torque most sprags carry nothing.
    let light = turning.survey(1.0).unwrap();
    assert!(light.unloaded() >= 6 && light.unloaded() < 12, "{}", light.unloaded());
    for r in light.rounds.iter().chain(&turned.rounds) {
        let torque = if r.torque_nm() < 2.0 { 1.0 } else { 90.0 };
        assert!((r.torque_nm() / torque - 1.0).abs() < 1e-9);
    }
}

/// A race that floats: no resultant is left, the race has moved by what the engaged sprags' stiffness makes of the
/// resultant that it had, towards the narrow side; curves rebuilt there carry the same. Bearings lie between.
#[test]
fn a_floating_race_finds_its_place() {
    let torque = 90.0;
    let (_, _, held) = ring("offset_mm = 0.02");
    let (_, _, floating) = ring("offset_mm = 0.02, bearing_stiffness_n_per_um = 0");
    let (_, _, bearings) = ring("offset_mm = 0.02, bearing_stiffness_n_per_um = 100");
    let [a, b, c] = [&held, &floating, &bearings].map(|r| r.survey(torque).unwrap().rounds[0].clone());
    let sum: f64 = b.loads.iter().map(|l| l.normal_n).sum();
    assert!(Vector::from(b.radial_n()).norm() < 1e-8 * sum && (b.torque_nm() / torque - 1.0).abs() < 1e-8);
    println!("share held {:.5}, floating {:.5}, on bearings {:.5}", a.share().0, b.share().0, c.share().0);
    assert!(b.share().0 - 1.0 < 0.1 * (a.share().0 - 1.0));
    // k = dN/dl of each strut; half of the sprags' sum resists in any direction.
    let mut stiffness = 0.0;
    for l in &a.loads {
        let curve = held.seats[l.seat].curve.as_ref().unwrap();
        let [p, q] = [1.0, 1.001].map(|f| curve.at_normal(f * l.normal_n).unwrap());
        let shorter = 11.11e-3 * p.tan_omega.atan().sin() * (q.windup_rad - p.windup_rad);
        stiffness += 0.5 * 0.001 * l.normal_n / shorter;
    }
    let force = Vector::from(a.radial_n());
    let shift = Vector::from(b.shift_m);
    assert!((shift - force / stiffness).norm() < 0.05 * shift.norm(), "{shift} {force} {stiffness:e}");
    let between = Vector::from(c.radial_n());
    assert!((between - 100e6 * Vector::from(c.shift_m)).norm() < 1e-6 * force.norm());
    // The two stiffnesses share what the held race's bearings had.
    let part = 100e6 / (100e6 + stiffness);
    assert!((between.norm() / force.norm() / part - 1.0).abs() < 0.05, "{between} {force} {part}");
    // Curves of the gaps as they are after the shift.
    let (clutch, profile) = (&ring("offset_mm = 0").0.clutch, place());
    for l in &b.loads {
        let seat = &floating.seats[l.seat];
        let back = |angle: f64, v: Vector| nalgebra::Rotation2::new(-angle) * v;
        let there = Vector::from(seat.offset_m) + back(seat.azimuth_rad, shift);
        let [base, moved] = [seat.offset_m.into(), there].map(|v| back(seat.turned_rad, v).into());
        let there = WedgeCurve::build_off_centre(clutch, &profile, moved, Carrier::OuterRace).unwrap();
        let g = |o: [f64; 2]| there.statics().touch_windup_rad(o).unwrap();
        let n = there.at_windup(b.windup_rad + g(base) - g(moved)).unwrap().0.n_bi;
        // What is left out: the square of the shift, some 0.4 % of its own 3 %.
        assert!((n / l.normal_n - 1.0).abs() < 2e-4, "{} {}", l.seat, n / l.normal_n - 1.0);
    }
}

fn place() -> sprag_design::profile::Profile {
    clutch(&MULTI).1
}

/// 3 and 80 sprags, offsets larger than sprags can follow: numbers or named outcomes.
#[test]
fn extremes_are_answered() {
    let three = [three()];
    let mut eighty = vec![("count = 12 ", "count = 80 ")];
    eighty.extend(LARGER);
    for (name, changes) in [("3", &three[..]), ("12", &[]), ("80", &eighty[..])] {
        for offset in ["0.0001", "0.03", "0.1", "0.24"] {
            // Half of the cases are enough of the clutch that takes longest.
            if name == "80" && ["0.0001", "0.1"].contains(&offset) {
                continue;
            }
            for more in [
                "",
                ", turning = true",
                ", bearing_stiffness_n_per_um = 0",
                ", turning = true, bearing_stiffness_n_per_um = 200",
            ] {
                let keys = format!("offset_mm = {offset}{more}");
                let (design, state) = off_centre(&keys, changes);
                let ring = RunOut::new(&design, &state).unwrap();
                let stop = ring.end;
                assert!(stop.torque_nm.is_finite() && stop.torque_nm >= 0.0, "{name} {keys}: {stop:?}");
                let rows = run_out_margins(&design, &design.limits, &ring, Capacities::Wanted);
                assert!(rows.len() >= 8, "{name} {keys}: {}", rows.len());
                for r in &rows {
                    let all = [
                        r.demand_in_unit().unwrap(),
                        r.allowable_in_unit(),
                        r.margin(),
                        r.torque_capacity_nm.unwrap_or(0.0),
                    ];
                    assert!(all.iter().all(|x| x.is_finite()), "{name} {keys}: {r:?}");
                }
                println!(
                    "{name} sprags, {keys}: to {:.4e} Nm ({}, {:?}), {} without contact; {}",
                    stop.torque_nm,
                    stop.reason.name(),
                    stop.seat,
                    ring.empty_rad().len(),
                    match ring.survey(0.5 * stop.torque_nm) {
                        Ok(s) => format!(
                            "half way: share {:.3}, {} unloaded",
                            s.worst_round().share().0,
                            s.unloaded()
                        ),
                        Err(why) => format!("half way: {why:?}"),
                    }
                );
                // Beyond its end nothing is held.
                if stop.torque_nm < 110.0 {
                    assert!(row(&rows, "run-out-end").margin() < 0.0);
                    assert!(row(&rows, "run-out-hertz-peak-inner").margin() < 0.0, "{name} {keys}");
                }
            }
        }
    }
}

/// A profile that ends soon: sprags in the widest gaps do not touch both races and carry nothing, the others all.
#[test]
fn sprags_that_do_not_touch_are_named() {
    let short = [("radius_mm = 4.15, until_rad = 0.45", "radius_mm = 4.15, until_rad = 0.14")];
    let (design, state) = off_centre("offset_mm = 0.1", &short);
    let ring = RunOut::new(&design, &state).unwrap();
    let empty = ring.empty_rad();
    assert!(empty.len() > 1 && empty.len() < 7 && empty[0] == 0.0, "{empty:?}");
    assert!(ring.end.torque_nm > 0.0);
    let survey = ring.survey(0.5 * ring.end.torque_nm).unwrap();
    assert_eq!(survey.unloaded(), empty.len());
    let round = &survey.rounds[0];
    assert!((round.torque_nm() / survey.torque_nm - 1.0).abs() < 1e-9);
    for l in &round.loads {
        assert_eq!(l.normal_n > 0.0, !empty.contains(&ring.seats[l.seat].azimuth_rad));
    }
    // Nobody touches: the end is at no torque, and every row says so in a number.
    let none = [("radius_mm = 4.15, until_rad = 0.45", "radius_mm = 4.15, until_rad = 0.1201"), three()];
    let (design, state) = off_centre("offset_mm = 0.2, turning = true", &none);
    let ring = RunOut::new(&design, &state).unwrap();
    for row in run_out_margins(&design, &design.limits, &ring, Capacities::Wanted) {
        assert!(
            row.demand_in_unit().unwrap().is_finite()
                && row.margin().is_finite()
                && row.allowable_in_unit().is_finite(),
            "{row:?}"
        );
    }
    println!("{:?} {:?}", ring.end, ring.empty_rad());
}

fn three() -> (&'static str, &'static str) {
    ("count = 12 ", "count = 3 ")
}
