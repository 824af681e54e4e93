//! What tables, JSON and banner of `check` say of given rows.

use super::body::*;
use super::overrun::OverrunSection;
use crate::design::Design;
use crate::margin::{BeyondEnd, Demand, Margin, OverrunCurve, limit_of};
use crate::report::Screen;
use crate::wedge::EndReason;

fn row(code: &str, demand: Demand, allowable: f64, capacity: Option<f64>) -> Margin {
    let limit = limit_of(code).unwrap();
    let scene = code.split_once(':').map(|(_, scene)| scene.to_owned());
    let name = format!("limit {code}");
    Margin { scene, name, torque_capacity_nm: capacity, ..Margin::new(limit, demand, allowable) }
}

/// A required row of a limit that is a ratio of pure numbers, with that margin.
fn margin(code: &str, margin: f64, capacity: Option<f64>) -> Margin {
    row(code, Demand::Value(1.0), 1.0 + margin, capacity)
}

fn source(lift_off_rad_s: Option<f64>) -> Source {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/designs/series-833-small.toml");
    let design = Design::read(file.as_ref()).unwrap();
    let curve = OverrunCurve { outer_race: vec![], inner_race: vec![], gamma_rad: 0.0 };
    Source {
        of_file: Vec::new(),
        end: EndReason::OffProfile,
        end_torque_nm: 50.0,
        asked_nm: 110.0,
        lift_off_rad_s,
        searched_to_rad_s: 100.0,
        overrun: OverrunSection::new(&curve, Vec::new(), &design, None, None),
        at_speed: None,
        running: None,
        run_out: None,
    }
}

#[test]
fn a_curve_that_ends_too_early_is_said() {
    let early = CheckBody::new(&[], source(None));
    assert!(early.remarks().iter().any(|r| r.contains("off-profile") && r.contains("110 Nm")));
    let late = CheckBody::new(&[], Source { end_torque_nm: 120.0, ..source(None) });
    assert!(late.remarks().iter().all(|r| !r.contains("off-profile")));
}

#[test]
fn only_required_limits_decide() {
    let rows = [
        margin("grip-inner", 0.2, Some(40.0)),
        margin("grip-outer", 0.1, Some(45.0)),
        Margin { required: false, ..row("slip:x", Demand::NoneSuffices, 0.1, None) },
    ];
    let body = CheckBody::new(&rows, source(None));
    assert!(body.pass && body.deciding.as_ref().unwrap().code == "grip-outer");
    assert_eq!(body.lowest_torque_capacity.as_ref().unwrap().code, "grip-inner");
    assert!(body.verdict().starts_with("HELD: all 2"), "{}", body.verdict());
    let broken = CheckBody::new(&[rows[0].clone(), margin("re-engagement", -0.01, None)], source(Some(1.0)));
    assert!(!broken.pass && broken.verdict().starts_with("NOT HELD: 1 of 2"), "{}", broken.verdict());
}

#[test]
fn a_demand_beyond_any_friction_is_words_null_and_an_empty_cell() {
    let rows = [row("slip:x", Demand::NoneSuffices, 0.1, None)];
    let json = serde_json::to_value(CheckBody::new(&rows, source(None))).unwrap();
    let shown = &json["margins"][0];
    assert!(shown["demand"].is_null() && shown["margin"] == -1.0 && shown["slip_margin"].is_null());
    let text = |rows: &[Margin]| people_table(rows, 200.0).to_text(Screen::default());
    assert!(text(&rows).contains(NONE_SUFFICES) && !text(&rows).contains(OVERLOADED));
    let overloaded = Demand::Overloaded { at_end: None, beyond: BeyondEnd::Lost };
    let beyond = [Margin { demand: overloaded, ..rows[0].clone() }];
    assert!(text(&beyond).contains(OVERLOADED) && !text(&beyond).contains(NONE_SUFFICES));
    let unknown = [Margin { demand: Demand::NotComputed("step limit"), ..rows[0].clone() }];
    assert!(text(&unknown).contains(NOT_COMPUTED));
    // Friction is not to blame where the torque lets the clutch go.
    let lets_go = [Margin { demand: Demand::LetsGo, ..rows[0].clone() }];
    assert!(text(&lets_go).contains(LETS_GO) && !text(&lets_go).contains(NONE_SUFFICES));
    let unknown = CheckBody::new(&unknown, source(None));
    assert_eq!(unknown.held(), None);
    assert!(unknown.verdict().contains("slip:x: step limit"), "{}", unknown.verdict());
    let csv = String::from_utf8(csv_table(&rows.map(|r| CheckRow::of(&r, 200.0))).to_csv().unwrap()).unwrap();
    assert!(csv.contains("slip:x,limit slip:x,,0,1,-1,,true,false,false,\n"), "{csv}");
}

#[test]
fn a_slip_row_shows_the_slip_margin_and_what_is_wanted() {
    // mu_s 0.1 over 0.08 is a slip margin of 25 %; 10 % are wanted.
    let known = Margin { reference: 0.1, ..row("slip:x", Demand::Value(0.08), 0.1 / 1.1, None) };
    let json = serde_json::to_value(CheckBody::new(std::slice::from_ref(&known), source(None))).unwrap();
    let shown = &json["margins"][0];
    let is = |key: &str, value: f64| (shown[key].as_f64().unwrap() - value).abs() < 1e-12;
    assert!(is("slip_margin", 0.25) && is("allowable", 0.1) && is("demand", 0.08), "{shown}");
    assert!(is("margin", 1.25 / 1.1 - 1.0), "{shown}");
    let text = people_table(std::slice::from_ref(&known), 200.0).to_text(Screen::default());
    assert!(text.contains("25.0") && text.contains("10.0 % wanted"), "{text}");
    let short = Margin { reference: 0.3, allowable: 0.1 / 1.3, ..known };
    let body = CheckBody::new(&[short], source(None));
    assert!(
        !body.pass && body.verdict().ends_with("slip:x decides, slip margin 25.0 %, 30.0 % wanted"),
        "{}",
        body.verdict()
    );
}

#[test]
fn what_the_curve_never_reaches_sets_no_capacity() {
    let rows = [margin("hertz-peak-inner", 0.2, Some(50.0)), margin("end-of-profile", 0.2, Some(50.0))];
    let body = CheckBody::new(&rows, source(None));
    assert_eq!(body.lowest_torque_capacity.as_ref().unwrap().code, "end-of-profile");
    assert!(body.nominal_torque_capacity.is_none());
    // Of nominal torque nothing is said where nothing is held at it.
    assert_eq!(body.capacity_lines().len(), 1);
    let nominal = [margin("hertz-nominal-inner", 0.2, None), rows[1].clone()];
    let [nominal, peak] = &CheckBody::new(&nominal, source(None)).capacity_lines()[..] else {
        panic!("no two")
    };
    assert!(nominal.contains("nominal: none of its limits is reached before"), "{nominal}");
    assert!(peak.contains("end-of-profile"), "{peak}");
}

#[test]
fn a_row_that_was_not_computed_is_neither_held_nor_broken() {
    let held = margin("grip-inner", 0.2, None);
    let unknown = row("slip:x", Demand::NotComputed("step limit"), 0.1, None);
    let body = CheckBody::new(&[held.clone(), unknown.clone()], source(None));
    assert_eq!(body.held(), None);
    assert!(body.verdict().starts_with("NOT COMPUTED: 1 of 2 required rows"), "{}", body.verdict());
    let text = people_table(std::slice::from_ref(&unknown), 50.0).to_text(Screen::default());
    assert!(text.contains("NOT COMPUTED") && !text.contains("NOT HELD"), "{text}");
    // A row that is shown only decides nothing.
    let shown = Margin { required: false, ..unknown };
    assert_eq!(CheckBody::new(&[held.clone(), shown], source(None)).held(), Some(true));
    assert_eq!(CheckBody::new(&[held, margin("grip-outer", -0.5, None)], source(None)).held(), Some(false));
}

#[test]
fn rounding_is_no_margin_and_a_capacity_beyond_the_end_is_said() {
    let rows = [margin("grip-inner", -5.77e-15, Some(50.0)), margin("grip-outer", -0.1, Some(40.0))];
    let json = serde_json::to_value(CheckBody::new(&rows, source(None))).unwrap();
    let [a, b] = [&json["margins"][0], &json["margins"][1]];
    assert!(a["held"] == true && a["capacity_beyond_end"] == true && a["margin"].as_f64().unwrap() < 0.0);
    assert!(b["held"] == false && b["capacity_beyond_end"] == false);
    let text = people_table(&rows, 50.0).to_text(Screen::default());
    assert!(!text.contains("e-1") && text.contains("> 50.00"), "{text}");
    assert_eq!(margin_text(&rows[0]), "0 %");
}

#[test]
fn a_design_without_limits_holds() {
    let body = CheckBody::new(&[], source(None));
    assert!(body.pass && body.deciding.is_none() && body.verdict().starts_with("HELD"));
}
