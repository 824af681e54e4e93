//! What tables, JSON and banner of `check` say of given rows.

use super::*;
use crate::design::Limits;
use crate::margin::OverrunCurve;
use crate::report::Screen;

fn margin(code: &str, demand: f64, margin: f64, capacity: Option<f64>, required: bool) -> Margin {
    Margin {
        code: code.into(),
        name: format!("limit {code}"),
        demand,
        allowable: 1.0,
        unit: "1",
        margin,
        torque_capacity_nm: capacity,
        required,
        computed: true,
        overloaded: false,
    }
}

fn source(lift_off_rad_s: Option<f64>) -> Source {
    let curve = OverrunCurve { outer_race: vec![], inner_race: vec![], gamma_rad: 0.0 };
    Source {
        end: EndReason::OffProfile,
        end_torque_nm: 50.0,
        asked_nm: 110.0,
        lift_off_rad_s,
        searched_to_rad_s: 100.0,
        overrun: Section::new(&curve, &Limits::default()),
        running: None,
        run_out: None,
    }
}

#[test]
fn a_curve_that_ends_too_early_is_said() {
    let early = Body::new(&[], source(None));
    assert!(early.remarks().iter().any(|r| r.contains("off-profile") && r.contains("110 Nm")));
    let late = Body::new(&[], Source { end_torque_nm: 120.0, ..source(None) });
    assert!(late.remarks().iter().all(|r| !r.contains("off-profile")));
}

#[test]
fn only_required_limits_decide() {
    let rows = [
        margin("a", 1.0, 0.2, Some(40.0), true),
        margin("b", 2.0, 0.1, Some(45.0), true),
        margin("c", f64::MAX, -1.0, None, false),
    ];
    let body = Body::new(&rows, source(None));
    assert!(body.pass && body.deciding.as_ref().unwrap().code == "b");
    assert_eq!(body.lowest_torque_capacity.as_ref().unwrap().code, "a");
    assert!(body.verdict().starts_with("HELD: all 2"), "{}", body.verdict());
    let broken = Body::new(&[rows[0].clone(), margin("d", 1.0, -0.01, None, true)], source(Some(1.0)));
    assert!(!broken.pass && broken.verdict().starts_with("NOT HELD: 1 of 2"), "{}", broken.verdict());
}

#[test]
fn a_demand_beyond_any_friction_is_words_null_and_an_empty_cell() {
    let rows = [margin("slip:x", f64::MAX, -1.0, None, true)];
    let json = serde_json::to_value(Body::new(&rows, source(None))).unwrap();
    assert!(json["margins"][0]["demand"].is_null() && json["margins"][0]["margin"] == -1.0);
    let text = |rows: &[Margin]| people_table(rows, 200.0).to_text(Screen::default());
    assert!(text(&rows).contains(NONE_SUFFICES) && !text(&rows).contains(OVERLOADED));
    let beyond = [Margin { overloaded: true, ..rows[0].clone() }];
    assert!(text(&beyond).contains(OVERLOADED) && !text(&beyond).contains(NONE_SUFFICES));
    let csv = String::from_utf8(csv_table(&rows, 200.0).to_csv().unwrap()).unwrap();
    assert!(csv.contains("slip:x,limit slip:x,,1,1,-1,,true,false,false"), "{csv}");
}

#[test]
fn what_the_curve_never_reaches_sets_no_capacity() {
    let rows = [
        margin("hertz-peak-inner", 1.0, 0.2, Some(50.0), true),
        margin("end-of-profile", 1.0, 0.2, Some(50.0), true),
    ];
    let body = Body::new(&rows, source(None));
    assert_eq!(body.lowest_torque_capacity.unwrap().code, "end-of-profile");
    assert!(body.nominal_torque_capacity.is_none());
}

#[test]
fn rounding_is_no_margin_and_a_capacity_beyond_the_end_is_said() {
    let rows = [margin("a", 1.0, -5.77e-15, Some(50.0), true), margin("b", 1.0, -0.1, Some(40.0), true)];
    let json = serde_json::to_value(Body::new(&rows, source(None))).unwrap();
    let [a, b] = [&json["margins"][0], &json["margins"][1]];
    assert!(a["held"] == true && a["capacity_beyond_end"] == true && a["margin"] == -5.77e-15);
    assert!(b["held"] == false && b["capacity_beyond_end"] == false);
    let text = people_table(&rows, 50.0).to_text(Screen::default());
    assert!(!text.contains("e-1") && text.contains("> 50.00"), "{text}");
    assert_eq!(super::super::margin_text(-5.77e-15), "0 %");
}

#[test]
fn a_design_without_limits_holds() {
    let body = Body::new(&[], source(None));
    assert!(body.pass && body.deciding.is_none() && body.verdict().starts_with("HELD"));
}
