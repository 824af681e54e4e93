//! The stability map, a piece of it: every case ends within its limit of work, with numbers, and half the tolerance
//! changes no verdict. `sprag-design accuracy` makes the whole.

use std::panic::catch_unwind;
use std::path::Path;

use rayon::prelude::*;
use sprag_design::accuracy::{Case, CaseEnd, Drives, Judged, WorkLimit, cases, judge, map};
use sprag_design::clutch::Clutch;
use sprag_design::fidelity::{self, Terms};
use sprag_design::{Design, Follow, Settings};

const SEED: u64 = 1;
const COUNT: usize = 150;
/// Small, so that the test takes seconds: what is tested is that limits are kept, not that they are not met.
const LIMIT: WorkLimit = WorkLimit {
    tolerance: 1e-6,
    most_steps: 2_000,
    most_events: 500,
    most_steps_again: None,
    follow: Follow::nobody(),
};
/// Right-hand sides of one case, both answers: far below what a case could take if a limit were not kept.
const MOST_RHS: u64 = 12_000_000;

fn clutch() -> Clutch {
    Design::read(Path::new("designs/huang2017-multi-arc.toml")).unwrap().clutch
}

fn judged(clutch: &Clutch, case: &Case) -> Judged {
    // A panic names its case; the library itself catches none.
    let run = || judge(clutch, case, &LIMIT);
    catch_unwind(run).unwrap_or_else(|_| panic!("case {}: {}", case.number, case.described()))
}

#[test]
fn corners_and_random_cases_end_with_a_name_and_with_numbers() {
    let clutch = clutch();
    let all: Vec<Judged> = cases(SEED, COUNT).par_iter().map(|case| judged(&clutch, case)).collect();
    for j in &all {
        let what = || format!("case {} of seed {SEED}: {}", j.case.number, j.case.described());
        assert_eq!(j.not_finite, None, "{}", what());
        assert!(!j.verdict_changes, "{:?}: {}", j.outcomes, what());
        assert!(j.events <= LIMIT.most_events + 1, "{} events: {}", j.events, what());
        assert!(j.rhs_evaluations <= MOST_RHS, "{} right-hand sides: {}", j.rhs_evaluations, what());
        // An answer without a verdict says why.
        let named = |o: &CaseEnd| !matches!(o.name(), "not-finite" | "interrupted");
        assert!(j.outcomes.iter().all(named), "{:?}: {}", j.outcomes, what());
    }
    let verdicts = all.iter().filter(|j| matches!(j.outcomes[0], CaseEnd::Verdict(_))).count();
    assert!(verdicts > COUNT / 2, "only {verdicts} verdicts");
}

#[test]
fn the_map_is_the_same_for_any_number_of_threads() {
    let (clutch, some) = (clutch(), cases(SEED, 24));
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let all = pool.install(|| map(&clutch, &some, &LIMIT));
        format!("{all:?}")
    };
    assert_eq!(with(1), with(4));
}

// A swing at 5e4 Hz on a stiff abutment that rolls throughout; a sprag that trembles on a stiff spring.
#[test]
fn what_met_its_limit_has_the_verdict_of_finer_runs_once_it_may_take_more_steps() {
    let (clutch, all) = (clutch(), cases(SEED, 2972));
    let within = |most_steps_again: Option<u64>| WorkLimit {
        tolerance: 1e-4,
        most_steps: 500,
        most_events: 250,
        most_steps_again,
        follow: Follow::nobody(),
    };
    let verdicts = [1351, 2971].into_par_iter().map(|number| {
        let case = &all[number];
        let short = judge(&clutch, case, &within(None));
        assert!(short.outcomes[0].met_a_limit() && !short.again, "{number}: {:?}", short.outcomes);
        let few = judge(&clutch, case, &within(Some(501)));
        assert!(few.outcomes[0].met_a_limit() && few.again, "{number}: {:?}", few.outcomes);
        let j = judge(&clutch, case, &within(Some(400_000)));
        let finer = Settings { tolerance: 1e-5, most_steps: Some(1_000_000), ..Settings::default() };
        let whole = fidelity::simulate(&case.scenario(&clutch), &finer, Terms::Felt).unwrap().simulation;
        assert!(j.again && j.converged && whole.tolerance_reached, "{number}: {:?}", whole.stop);
        assert_eq!(j.verdicts(), [whole.verdict; 2], "{number}");
        let off = j.theta_inner_rad.map(|theta| (theta - whole.theta_inner_rad).abs());
        assert!(off[0].max(off[1]) < 1e-4, "{number}: {off:?}");
        whole.verdict.map_or("none", |v| v.name())
    });
    assert_eq!(verdicts.collect::<Vec<_>>(), ["sticks", "slips-engaging"]);
}

#[test]
fn no_case_that_a_drive_could_have_ends_at_its_limit() {
    let (clutch, all) = (clutch(), cases(SEED, 240));
    let drives = Drives::of(&clutch).unwrap();
    // By hand: pi/2 rho w (R^4 - r^4), sqrt(E/rho)/R; a tenth of 200.44 Nm over 12 sprags at the end of the curve.
    let [inner, outer] = drives.least_inertia_kg_m2;
    for (found, wanted) in [(inner, 9.273e-7), (outer, 2.4454e-5), (drives.fastest_rad_s, 2.2434e5)] {
        assert!((found / wanted - 1.0).abs() < 1e-3, "{found:e} for {wanted:e}");
    }
    let spring = drives.most_spring_nm_per_rad;
    assert!((3.0..5.0).contains(&spring), "{spring}");
    let those: Vec<&Case> = all.iter().filter(|case| drives.have(case)).collect();
    assert!((60..180).contains(&those.len()), "{} cases", those.len());
    let limit = WorkLimit::default();
    let found: Vec<Judged> = those.par_iter().map(|case| judge(&clutch, case, &limit)).collect();
    for j in &found {
        let named = j.outcomes.iter().all(|o| !o.met_a_limit());
        assert!(named, "case {}: {:?}, {}", j.case.number, j.outcomes, j.case.described());
    }
    // The box holds others, or nothing would be tested: nine in ten that meet the limit have a stiff spring.
    let trembles = &cases(SEED, 32)[31];
    assert!(!drives.have(trembles) && judge(&clutch, trembles, &LIMIT).outcomes[0].met_a_limit());
}
