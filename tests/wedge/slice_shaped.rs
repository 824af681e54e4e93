//! The shaped law against the slices that it stands for, and its promises: smooth, rising, 1 for a straight contact.

use std::sync::Arc;

use sprag_design::contact::{
    Approach, AxialFit, EndDrop, HertzBody, LineContact, RollerLaw, ShapedLaw, SliceCompliance, SliceContact,
    SliceRatio, SliceStatus,
};
use sprag_design::material::Material;

const STEEL: Material = Material { youngs_modulus_pa: 206e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };
const SLICES: usize = 60;

fn contact() -> LineContact {
    LineContact::external(11.11e-3, 4.02e-3, 6e-3, 206e9 / 1.82).unwrap()
}

fn fits() -> Vec<(&'static str, AxialFit)> {
    let c = contact();
    let shaped = |profile, tilt| AxialFit::shaped(6e-3, profile, tilt).unwrap();
    vec![
        ("square", shaped(EndDrop::Square, 0.0)),
        ("Lundberg", shaped(EndDrop::lundberg(&c, 2441.0).unwrap(), 0.0)),
        ("crown", shaped(EndDrop::crown_radius(1.0, 6e-3).unwrap(), 0.0)),
        ("end relief", shaped(EndDrop::end_relief(1e-3, 50e-3).unwrap(), 0.0)),
        ("tilt 0.2 mrad", shaped(EndDrop::Square, 2e-4)),
        ("tilt 2 mrad", shaped(EndDrop::Square, 2e-3)),
        ("Lundberg, tilt 1 mrad", shaped(EndDrop::lundberg(&c, 2441.0).unwrap(), 1e-3)),
    ]
}

/// The shaped law, the straight one below it, and the slices that tell the difference.
fn laws(fit: &AxialFit, slices: usize) -> [(Approach, Approach, SliceCompliance); 2] {
    let c = contact();
    let roller = RollerLaw::new(&c, 3.944e-5).unwrap();
    let slice = Approach::slice(&c, 3.944e-5, Arc::new(SliceRatio::new(slices).unwrap())).unwrap();
    let body = |depth_m| HertzBody { material: STEEL, depth_m };
    let hertz = Approach::hertz(&c, [body(3.9e-3), body(4.165e-3)]).unwrap();
    [(slice, SliceCompliance::Roller(roller)), (hertz, SliceCompliance::HalfSpace)].map(
        |(base, compliance)| {
            let shaped = ShapedLaw::new(base.clone(), &c, compliance, slices, fit).unwrap();
            (Approach::Shaped(shaped), base, compliance)
        },
    )
}

/// Between the nodes the slices step where one more of them closes; the series runs through the steps. Where only a
/// handful bears, the slices are no reference: printed, not held.
#[test]
fn the_series_meets_the_slices() {
    for (name, fit) in fits() {
        for (law, base, compliance) in laws(&fit, SLICES) {
            let slices = SliceContact::with_compliance(contact(), compliance, SLICES).unwrap();
            // Ten slices or more closed, all closed, fewer.
            let mut worst = [0.0f64; 3];
            for i in 0..=80 {
                let n = 1e-2 * 10f64.powf(0.08 * f64::from(i));
                let found = slices.solve_along(n, &fit).unwrap();
                let wanted = base.approach_m(n) + found.approach_m - slices.solve(n).unwrap().approach_m;
                let class = match found.status {
                    SliceStatus::Closed => 0,
                    SliceStatus::PartlyOpen { open } if open + 10 <= SLICES => 1,
                    _ => 2,
                };
                worst[class] = worst[class].max((law.approach_m(n) / wanted - 1.0).abs());
            }
            let [closed, ten, few] = worst;
            println!("{name}: all closed {closed:.1e}, ten or more {ten:.1e}, fewer {few:.1e}");
            assert!(closed < 4e-3 && ten < 1.5e-2, "{name}: {worst:?}");
        }
    }
}

#[test]
fn approach_and_compliance_rise_and_agree() {
    for ((name, fit), slices) in fits().into_iter().flat_map(|f| [10, 33, 60, 200].map(|n| (f.clone(), n))) {
        for (law, base, _) in laws(&fit, slices) {
            let mut last = 0.0;
            for i in 0..=600 {
                let n = 1e-9 * 10f64.powf(0.03 * f64::from(i));
                let now = law.approach_m(n);
                assert!(
                    now > last && now >= base.approach_m(n) * (1.0 - 1e-9),
                    "{name}, {slices} slices, {n}: {now} {last}"
                );
                last = now;
            }
            // Inside the table and beyond both ends.
            for n in [1e-8, 0.02, 3.0, 150.0, 2441.0, 3e4, 1e7] {
                let h = 1e-4 * n;
                let numeric = (law.approach_m(n + h) - law.approach_m(n - h)) / (2.0 * h);
                let exact = law.compliance_m_per_n(n);
                assert!((numeric / exact - 1.0).abs() < 1e-5, "{name} {n}: {numeric} {exact}");
            }
        }
    }
}
