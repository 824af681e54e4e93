//! Scenes of sprags that a driven cage carries: from overrun until they wedge, against an independent motion, a clutch without a cage,
//! momentum and energy.

use crate::program::stdout;
use sprag_design::Design;
use sprag_design::clutch::Scenario;
use sprag_design::dynamics::{Grip, Place};
use sprag_design::element::{self, Beginning, Element};
use sprag_design::scenario::{NoScenario, Settings, Simulation, Verdict, prepare, simulate};

const FILE: &str = "designs/lift-off-inner.toml";

/// The file dry, its outer race of 0.05 kg m^2, with the scene `scene`; the pivot may go outward by `clearance_um`.
fn design(clearance_um: &str, scene: &str) -> Design {
    let text = std::fs::read_to_string(FILE).unwrap();
    let oil = "[lubrication]\noil = \"ISO VG 32\"\ntemperature_c = 50.0\nrace_roughness_um = 0.3\nsprag_roughness_um = 0.3\n";
    let (cage, races) = ("[cage]\n", "width_mm = 20.0\n");
    assert!([oil, cage, races].iter().all(|part| text.contains(part)));
    let text = text
        .replace(oil, "")
        .replace(cage, &format!("[cage]\nclearance_um = {clearance_um}\n"))
        .replace(races, &format!("{races}outer_inertia_kg_m2 = 0.05\n"));
    let text = format!("{text}\n[[scenarios]]\nname = \"scene\"\n{scene}");
    Design::parse(&text, FILE).unwrap_or_else(|error| panic!("{error}"))
}

fn engagement(free_run_rpm: &str) -> String {
    format!(
        "kind = \"engagement\"\nfree_run_rpm = {free_run_rpm}\nreversing_torque_nm = 20.0\n\
         stop_stiffness_nm_per_rad = 1000.0\nbench_inertia_kg_m2 = 0.0\nduration_s = 0.2\n"
    )
}

fn run(design: &Design, settings: &Settings) -> Simulation {
    simulate(design.scenario("scene").unwrap(), settings).unwrap()
}

fn fine() -> Settings {
    Settings { tolerance: 1e-6, energy: true, samples: 400, ..Settings::default() }
}

#[test]
fn the_outer_race_catches_up_when_and_where_the_script_says() {
    let table = std::fs::read_to_string("tests/reference/carried.csv").unwrap();
    let mut rows = 0;
    for row in table.lines().skip(1) {
        let cells: Vec<&str> = row.split(',').collect();
        let wanted: Vec<f64> = cells[2..].iter().map(|cell| cell.parse().unwrap()).collect();
        let s = run(&design(cells[0], &engagement(cells[1])), &fine());
        let start = s.samples[0];
        assert_eq!(start.mode.place, Place::Carried);
        let met = s.engaged.unwrap();
        let met_by = [met.t_s, met.state[2], met.state[3], met.state[6], met.outer.distance_m];
        // A loose pivot leaves the sprag open where the races meet: it counts as engaged once it has closed.
        let allowed = if cells[0] == "0" { 1e-6 } else { 2e-3 };
        assert!((start.forces.n_be - wanted[0]).abs() <= 1e-5 * wanted[0], "{row}: {}", start.forces.n_be);
        // 20 Nm turn the outer race by 0.02 rad on its stop.
        let scales = [wanted[1], wanted[2], 0.02, start.state[6], wanted[5]];
        for ((found, wanted), scale) in met_by.iter().zip(&wanted[1..]).zip(scales) {
            assert!((found - wanted).abs() < allowed * scale, "{row}: {found} {wanted}");
        }
        assert_eq!(s.verdict, Some(Verdict::Sticks), "{row}");
        let e = s.energy.unwrap();
        assert!(e.relative().abs() < 1e-6, "{row}: {e:?}");
        rows += 1;
    }
    assert_eq!(rows, 5);
}

#[test]
fn once_they_hold_the_cage_is_no_more_than_its_inertia() {
    // A stiff stop: what the sprags drag along meanwhile hardly turns the outer race.
    let scene = engagement("300").replace("1000.0", "200000.0");
    let with = run(&design("0", &scene), &fine());
    let mut free = design("0", &scene);
    let scenario = free.scenarios.iter_mut().find(|s| s.name == "scene").unwrap();
    scenario.clutch.cage = None;
    // A spring as strong: the drag that the file gives means another without a cage.
    let spring = |scenario: &Scenario| prepare(scenario).unwrap().model.alpha_max_rad;
    let caged = design("0", &scene);
    scenario.clutch.spring.drag_torque_nm *= spring(caged.scenario("scene").unwrap()) / spring(scenario);
    let without = run(&free, &fine());
    let [with, without] = [with, without].map(|s| s.peaks.normal_max_n);
    // 20 Nm at once swing to 40 from no torque; from an overrun that drags, as without a cage, by that more.
    let drag_nm = 0.6 * 1.1;
    assert!(with < without && without < with * (1.0 + drag_nm / 40.0), "{with} {without}");
}

#[test]
fn what_lets_go_is_taken_along_again() {
    let scene = "kind = \"transient\"\npreload_nm = 100.0\ntorque_step_nm = -110.0\nstep_time_s = 0.02\n\
                 abutment_stiffness_nm_per_rad = 20000.0\nduration_s = 0.06\n";
    let s = run(&design("0", scene), &fine());
    let last = s.samples.last().unwrap();
    assert_eq!(last.mode.place, Place::Carried);
    assert_eq!(last.mode.outer, Grip::Slip(-1.0));
    assert!(last.state[6] > 1.0, "{}", last.state[6]);
    assert_eq!(s.verdict, Some(Verdict::SlipsOverrunning));
    let e = s.energy.unwrap();
    assert!(e.relative().abs() < 1e-5, "{e:?}");
    // From then on alpha is that of first contact and the sprag as fast as the inner race.
    let carried = s.samples.iter().filter(|sample| sample.mode.place == Place::Carried);
    assert!(carried.clone().count() > 50);
    assert!(carried.clone().all(|sample| sample.state[0] == last.state[0]));
    assert!(carried.clone().all(|sample| sample.state[5] == sample.state[6]));
}

#[test]
fn sprags_that_are_off_let_the_outer_race_overtake_until_they_come_back() {
    // The inner race at 1200 rpm, beyond lift-off, slowed by 2 Nm; the outer one driven past it.
    let scene = "kind = \"transient\"\nspeed_rpm = 1000.0\noverrun_rpm = 200.0\npreload_nm = 5.0\ntorque_step_nm = 0.0\n\
                 step_time_s = 0.0\nabutment_stiffness_nm_per_rad = 20000.0\nduration_s = 0.6\n";
    let s = run(&design("0", scene), &fine());
    let ahead = s.samples.iter().find(|p| p.mode.place == Place::Carried && p.mode.outer == Grip::Slip(1.0));
    let ahead = ahead.expect("the outer race runs ahead of sprags that are off");
    assert_eq!((ahead.forces.n_be, ahead.forces.t_be), (0.0, 0.0));
    let met = s.engaged.expect("slower than at lift-off they touch");
    let lift_off = 826.58 * std::f64::consts::PI / 30.0;
    let cage = 1000.0 * std::f64::consts::PI / 30.0 + met.state[6];
    // Its slowing down brings them back a little earlier, at a higher speed.
    assert!((cage / lift_off - 1.0).abs() < 0.02, "{cage} {lift_off}");
}

/// Free races under equal and opposite torques: they meet, wedge, come loose and run on, and nothing of this changes the angular momentum
/// about the axis.
#[test]
fn in_co_simulation_free_races_keep_their_angular_momentum() {
    let design = design("0", &engagement("300"));
    let clutch = &design.clutch;
    let beginning = Beginning { speed_rad_s: 20.0, overrun_rad_s: 20.0, ..Beginning::default() };
    let settings = element::Settings { tolerance: 1e-9, ..element::Settings::default() };
    let mut element = Element::new(clutch, &beginning, &settings).unwrap();
    let momentum = |element: &Element| {
        let (model, y, mode) = (element.model(), element.memory().state(), element.memory().mode());
        let p = model.point(mode.place, y[0]);
        let [alpha, phi, inner, outer] = model.rates(&mode, &p, y);
        let (s, r) = (&clutch.sprags, &clutch.races);
        let sprag = s.inertia_kg_m2 * (alpha + phi) + s.mass_kg * p.oc_g * p.oc_g * (phi + 20.0);
        r.inner_inertia_kg_m2 * inner + r.outer_inertia_kg_m2 * outer + s.count as f64 * sprag
    };
    let start = momentum(&element);
    let mut places = Vec::new();
    for i in 0..300 {
        let torque_nm = if i < 150 { 20.0 } else { -20.0 };
        element.advance(2e-4, [-torque_nm, torque_nm].map(element::Torque::constant)).unwrap();
        let off = momentum(&element) - start;
        // Pressed in at once where the races meet, the sprags lie a little nearer to the axis.
        assert!(off.abs() < 1e-5 * clutch.races.inner_inertia_kg_m2 * 20.0, "{i}: {off:e}");
        places.push(element.memory().mode().place);
    }
    places.dedup_by_key(|place| matches!(place, Place::Arc(_)));
    assert_eq!(places.first(), Some(&Place::Carried));
    assert_eq!(places.last(), Some(&Place::Carried));
    assert!(places.iter().any(|place| matches!(place, Place::Arc(_))), "{places:?}");
    // Without its cage the clutch goes on with sprags that the outer race takes along.
    let free = sprag_design::clutch::Clutch { cage: None, ..clutch.clone() };
    let mut free = element.exchanged(&free).unwrap();
    free.advance(2e-4, [20.0, -20.0].map(element::Torque::constant)).unwrap();
    assert_ne!(free.memory().mode().place, Place::Carried);
}

#[test]
fn what_rides_with_the_outer_race_alone_says_so() {
    let design = design("0", &engagement("300"));
    let scenario = design.scenario("scene").unwrap();
    assert!(prepare(scenario).unwrap().model.carried.is_some());
    let published =
        crate::program::run(&["simulate", FILE, "--scenario", "runback", "--method", "published"]);
    let said = stdout(&published) + &String::from_utf8_lossy(&published.stderr);
    assert!(said.contains("the published scheme knows overrun only with sprags that ride"), "{said}");
    assert!(NoScenario::DrivenCage("a run").to_string().contains("a run knows overrun only"));
}
