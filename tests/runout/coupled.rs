//! Sprags off centre between races that bend under all of them: rows `sprag-*` beside rows `run-out-*`.

use super::ring::{off_centre, ring, row};
use sprag_design::clutch::Sharing;
use sprag_design::margin::{Capacities, load_margins, run_out_margins, unlike_margins};
use sprag_design::sharing::{Asked, Turn};
use std::f64::consts::TAU;

/// Axes on one another: the sprags carry alike to 1e-10, whatever bends.
#[test]
fn on_one_axis_the_rows_are_those_of_sprags_alike() {
    let (design, state, _) = ring("offset_mm = 0.0, turning = true");
    let even = load_margins(&design, &design.limits, Capacities::LeftOut, &state);
    let rows = unlike_margins(&design, &design.limits, &state, Capacities::LeftOut);
    assert_eq!(rows.len(), 3);
    let demand = |code: &str| row(&even, code).demand_in_unit().unwrap();
    let grip = demand("grip-inner").max(demand("grip-outer")) / design.clutch.friction.static_;
    for (code, want) in [
        ("sprag-hertz-nominal", demand("hertz-nominal-inner").max(demand("hertz-nominal-outer"))),
        ("sprag-hertz-peak", demand("hertz-peak-inner").max(demand("hertz-peak-outer"))),
        ("sprag-grip", grip),
    ] {
        let found = row(&rows, code).demand_in_unit().unwrap();
        println!("{code}: {found} {want}");
        assert!((found / want - 1.0).abs() < 1e-10, "{code}: {found} {want}");
    }
}

/// Without the table sharing the rows are those of a table that sets nothing apart.
#[test]
fn alike_sprags_need_no_table() {
    let (design, state) = off_centre("offset_mm = 0.01", &[]);
    let (told, _) = off_centre("offset_mm = 0.01", &[("[races]", "[sharing]\nseed = 1\n\n[races]")]);
    let of = |design| {
        let rows = unlike_margins(design, &told.limits, &state, Capacities::Wanted);
        let all = rows.iter().map(|r| (r.code().to_string(), r.demand_in_unit(), r.torque_capacity_nm));
        (all.collect::<Vec<_>>(), rows[0].full_name())
    };
    let (without, with) = (of(&design), of(&told));
    assert_eq!(without.0, with.0);
    assert!(without.1.contains("alike but for their gaps") && !with.1.contains("alike"), "{}", without.1);
}

/// Rings that bend by nothing but what each sprag does to them itself are those of the rows run-out-*: both ways through the statics find
/// the same forces. As stiff as they are they add to the excess of the worst sprag, and less than rings that stay round.
#[test]
fn bending_adds_to_what_each_gap_alone_gives() {
    for (keys, turning) in [("offset_mm = 0.01", false), ("offset_mm = 0.01, turning = true", true)] {
        let (design, state, ring) = ring(keys);
        let survey = ring.survey(90.0).unwrap();
        let turn = Turn::new(&design.clutch, &Sharing::default(), &state.curve);
        let unbent = turn.first().unbent();
        for round in &survey.rounds {
            let turned = -TAU * round.turned as f64 / 12.0;
            let found = unbent.carrying(Asked::Torque(90.0), turned).unwrap();
            let mean = round.loads.iter().map(|l| l.normal_n).sum::<f64>() / 12.0;
            let off = |(a, l): (&sprag_design::sharing::Bears, &sprag_design::margin::SpragLoad)| {
                (a.normal_inner_n - l.normal_n).abs() / mean
            };
            let most = found.loads.iter().zip(&round.loads).map(off).fold(0.0, f64::max);
            println!("{keys}, {}: {most:e} of the mean, share {}", round.turned, round.share().0);
            assert!(most < 3e-4, "{keys}, {}: {most}", round.turned);
        }
        let alone = survey.worst_round().share().0;
        let places = turn.at(90.0).unwrap();
        let coupled = places.iter().flat_map(|s| s.shares()).fold(0.0, f64::max);
        println!("{keys}: share {alone}, {coupled} coupled");
        if turning {
            assert!(coupled > alone + 0.02 && coupled < 1.0 + 4.0 * (alone - 1.0), "{alone} {coupled}");
        }
        let (alone, all) = (
            run_out_margins(&design, &design.limits, &ring, Capacities::LeftOut),
            unlike_margins(&design, &design.limits, &state, Capacities::LeftOut),
        );
        let pressure = |rows, code| row(rows, code).demand_in_unit().unwrap();
        let (alone, coupled) =
            (pressure(&alone, "run-out-hertz-nominal-inner"), pressure(&all, "sprag-hertz-nominal"));
        println!("  {alone} and {coupled} MPa");
        assert!(!turning || coupled > 1.005 * alone, "{alone} {coupled}");
    }
}
