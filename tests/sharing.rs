//! Sprags one by one: alike they are the curve, unlike they are what a hand calculation says.

use sprag_design::clutch::{GivenSprag, Sharing, Standing};
use sprag_design::sharing::{Asked, Shared, Unlike};
use sprag_design::{Clutch, Design, WedgeCurve};

fn clutch(file: &str) -> Clutch {
    let path = format!("{}/designs/{file}.toml", env!("CARGO_MANIFEST_DIR"));
    Design::read(path.as_ref()).unwrap().clutch
}

fn curve(clutch: &Clutch) -> WedgeCurve {
    WedgeCurve::build(clutch, &clutch.profile().unwrap(), 0.0).unwrap()
}

fn alike() -> Sharing {
    Sharing {
        start: Standing::Sprung,
        seed: 1,
        size_within_m: 0.0,
        azimuth_within_rad: 0.0,
        friction_within: 0.0,
        gap_up_to_m: 0.0,
        stiffness_n_per_m: None,
        given: Vec::new(),
    }
}

fn larger(um: f64) -> Sharing {
    let one = GivenSprag { index: 3, size_m: Some(1e-6 * um), ..GivenSprag::default() };
    Sharing { start: Standing::Caged, given: vec![one], ..alike() }
}

fn at(clutch: &Clutch, sharing: &Sharing, curve: &WedgeCurve, torque_nm: f64) -> Shared {
    Unlike::new(clutch, sharing, curve, 0.0).carrying(Asked::Torque(torque_nm), 0.0).unwrap()
}

#[test]
fn sprags_alike_between_concentric_races_are_the_curve() {
    let mut worst: f64 = 0.0;
    for file in ["huang2017-single-arc", "huang2017-multi-arc", "huang2017-elastic", "starter", "fe-check-24"] {
        let clutch = clutch(file);
        let curve = curve(&clutch);
        for share in [1e-6, 1e-3, 0.1, 0.5, 0.9] {
            let torque = share * curve.end_torque_nm();
            let (_, exact) = curve.closure_at_torque(torque).unwrap();
            for stiffness in [f64::INFINITY, 1e8, 0.0] {
                for start in [Standing::Sprung, Standing::Caged] {
                    let sharing = Sharing { stiffness_n_per_m: Some(stiffness), start, ..alike() };
                    let found = Unlike::new(&clutch, &sharing, &curve, 0.0).carrying(Asked::Torque(torque), 0.0);
                    let Ok(shared) = found else {
                        println!("{file} {share} {stiffness} {start:?} {found:?}");
                        continue;
                    };
                    let windup = curve.at_torque(torque).unwrap().windup_rad;
                    worst = worst.max((shared.windup_rad / windup - 1.0).abs());
                    for load in &shared.loads {
                        worst = worst.max((load.normal_inner_n / exact.n_bi - 1.0).abs());
                    }
                }
            }
        }
    }
    println!("worst {worst:.1e}");
    assert!(worst < 1e-10, "{worst:e}");
}

#[test]
fn look() {
    for file in ["huang2017-elastic", "series-833-mid"] {
        let clutch = clutch(file);
        let curve = curve(&clutch);
        for share in [0.05, 0.2, 0.5] {
            for um in [5.0, 20.0, -20.0] {
                let clutch = &clutch;
                let found = Unlike::new(clutch, &larger(um), &curve, 0.0).carrying(Asked::Torque(share * curve.end_torque_nm()), 0.0);
                match found {
                    Ok(s) => println!("{file} {share} {um} steps {} windup {} carrying {} {:?}", s.steps, s.windup_rad, s.carrying(), s.shares().iter().map(|x| (x * 1e3).round() / 1e3).collect::<Vec<_>>()),
                    Err(why) => println!("{file} {share} {um} {why:?}"),
                }
            }
        }
    }
}
