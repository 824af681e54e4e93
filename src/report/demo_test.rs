use super::*;
#[test]
fn demo() {
    let mut page = Page::new(PageHead { title: "Margin check".into(), tool: "sprag-design".into(), version: "0.1.0".into(),
        command: "sprag-design check designs/huang-2017.toml --report reports/huang-2017.html".into(),
        design: "Huang 2017, multi-arc".into(), design_hash: "9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08".into() });
    let d = drawing::tests::table_1(0.0);
    let mut d2 = d.clone();
    let mut p = drawing::tests::table_1(0.15).poses.remove(0);
    p.label = "after 0.15 rad".into();
    d2.poses.push(p);
    page.verdict(false, "One limit of six is broken: the outer race's hoop stress at 110 Nm, by 1.3 %.");
    page.heading("The clutch");
    page.figures(&[(d.clutch_svg(), "All sprags at first contact, to scale."), (d.centres_svg(), "Arc centres and centroid in the body frame.")]);
    page.figure(&d.detail_svg(), "One sprag at first contact, to scale.");
    page.figure(&d2.detail_svg(), "Before and after.");
    page.heading("Margins");
    let mut t = Table::new(vec![Column::text("name","Limit"), Column::number("demand","Demand",Unit::One,4), Column::number("allowable","Allowable",Unit::One,4), Column::number("margin","Margin",Unit::Percent,3), Column::number("torque_capacity_nm","Torque capacity",Unit::NewtonMetre,4), Column::text("verdict","")]);
    for (n,dm,a,c) in [("Hertz pressure, nominal torque",3.91e9,4.2e9,104.2),("Hertz pressure, peak torque",4.31e9,4.6e9,126.0),("Hoop stress, outer race",7.6e8,7.5e8,108.0)] {
        t.row(vec![n.into(), Cell::In(dm,Unit::Megapascal), Cell::In(a,Unit::Megapascal), (a/dm-1.0).into(), c.into(), Cell::Verdict(a>dm, if a>dm {"held".into()} else {"broken".into()})]);
    }
    page.table("Each limit with its demand and allowable.", &t);
    page.heading("Curves");
    let f = |k: f64| (0..200).map(|i| { let x = 0.5*i as f64; [x, k*x.powf(0.9)/8.0] }).collect::<Vec<_>>();
    page.figure(&Plot::new("Torque, Nm","Windup, deg").curve("roller, K = 3.944e-5", f(1.0)).curve("DIN 26281", f(1.02)).curve("Hertz, logarithmic", f(0.93)).curve("slice, n = 60", f(0.97))
        .marker(16.8, "1|2").marker(19.0,"2|3").marker(60.0, "nominal").level(9.0, "allowed").to_svg(), "Windup over torque per contact law.");
    let mut l = Plot::new("Run time, s","Error of the end angle, rad").curve("event", (0..6).map(|i| [1e-3*3f64.powi(i), 1e-4*0.1f64.powi(i)]).collect()).curve("published", (0..6).map(|i| [1e-3*5f64.powi(i), 0.1*0.7f64.powi(i)]).collect()).sized(480.0,340.0);
    l.log_x = true; l.log_y = true; l.curves[0].dots = true; l.curves[1].dots = true;
    let s = Plot::new("Time, ms","Inner slip, µm").curve("", (0..20000).map(|i| { let t = i as f64*0.015; [t, 3.0*(t*0.6).sin()*(-t/100.0).exp()-1e-2*t] }).collect()).sized(480.0,340.0);
    page.figures(&[(l.to_svg(), "Work and precision."), (s.to_svg(), "History.")]);
    page.heading("Left out").list(["simultaneous wedging of all sprags", "equal sharing", "concentric races"]);
    page.source("The design file", "schema = 1\nname = \"Huang 2017, multi-arc\"\n");
    page.results("results", &serde_json::json!({"pass": false}));
    std::fs::write("/tmp/demo.html", page.to_html()).unwrap();
    println!("{}", t.to_text(false));
}
