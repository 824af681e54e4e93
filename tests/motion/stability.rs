//! The stability map, a piece of it: every case ends within its limit of work, with numbers, and half the tolerance
//! changes no verdict. `sprag-design accuracy` makes the whole.

use std::panic::catch_unwind;
use std::path::Path;

use rayon::prelude::*;
use sprag_design::accuracy::{Case, CaseEnd, Judged, WorkLimit, cases, judge, map};
use sprag_design::clutch::Clutch;
use sprag_design::{Design, Follow};

const SEED: u64 = 1;
const COUNT: usize = 150;
/// Small, so that the test takes seconds: what is tested is that limits are kept, not that they are not met.
const LIMIT: WorkLimit =
    WorkLimit { tolerance: 1e-6, most_steps: 2_000, most_events: 500, follow: Follow::nobody() };
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
