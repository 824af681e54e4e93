//! Whole commands under attack: mutated designs, histories, journals, data and flags are run through the program, and
//! each run must hold the promises of `hold.rs`. Every case follows from one number, its seed.
//!
//! Part of the suite is a short run. For a long one, an hour with two workers:
//!
//! ```text
//! ATTACK_SECONDS=3600 ATTACK_WORKERS=2 cargo test --release --test attack -- --ignored --nocapture
//! ```
//!
//! `ATTACK_SEED=n` begins with case n (default 1000), so that `ATTACK_SEED=n ATTACK_SECONDS=0` runs case n alone.
//! `ATTACK_BINARY=path` attacks another build. A case at fault is made smaller by leaving mutations out one by one, then
//! kept with its files and its command line in the folder `attack/n` below the target folder's `tmp`; at the end each
//! kind of fault is told with its cases.
#![cfg(unix)]

mod case;
mod hold;
mod mutate;
mod run;

use case::Case;
use rayon::prelude::*;
use run::{Files, Program};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Cases of the short run: every command has answers among them.
const SHORT: [std::ops::Range<u64>; 2] = [0..105, 100_000..100_031];

#[test]
fn whole_commands_keep_their_promises() {
    let program = Program::new(env!("CARGO_BIN_EXE_sprag-design"));
    let seeds: Vec<u64> = SHORT.into_iter().flatten().collect();
    if let Some(told) = seeds.par_iter().find_map_first(|seed| attack(&program, *seed)) {
        panic!("{told}");
    }
    let ends = program.ends();
    for command in ["check", "stiffness", "simulate", "optimize", "identify", "size", "export", "evaluate"] {
        let answered = [0, 1].iter().any(|code| ends.contains_key(&(command.to_owned(), Some(*code))));
        assert!(answered, "{command} never had an answer: the attack is stopped at the door; {ends:?}");
    }
}

#[test]
#[ignore = "as long as ATTACK_SECONDS says"]
fn attack_for_long() {
    let number = |name: &str, otherwise: u64| {
        std::env::var(name).map_or(otherwise, |text| text.parse().unwrap_or_else(|_| panic!("{name}={text}")))
    };
    let binary = std::env::var("ATTACK_BINARY").unwrap_or(env!("CARGO_BIN_EXE_sprag-design").into());
    let program = Program::new(&binary);
    let end = Instant::now() + Duration::from_secs(number("ATTACK_SECONDS", 60));
    let first = number("ATTACK_SEED", 1000);
    let next = AtomicU64::new(first);
    let found: Mutex<BTreeMap<String, Vec<u64>>> = Mutex::default();
    std::thread::scope(|scope| {
        for _ in 0..number("ATTACK_WORKERS", 1) {
            scope.spawn(|| {
                loop {
                    let seed = next.fetch_add(1, Ordering::Relaxed);
                    if let Some(told) = attack(&program, seed) {
                        eprintln!("{told}\n");
                        let fault = told.split_once(": ").map_or("", |(_, fault)| fault);
                        let kind = hold::kind(fault);
                        found
                            .lock()
                            .unwrap_or_else(PoisonError::into_inner)
                            .entry(kind)
                            .or_default()
                            .push(seed);
                    }
                    if Instant::now() >= end {
                        break;
                    }
                }
            });
        }
    });
    let found = found.into_inner().unwrap_or_else(PoisonError::into_inner);
    for ((command, code), count) in program.ends() {
        eprintln!("{command} with code {code:?}: {count} times");
    }
    eprintln!("{} cases from {first}, {} kinds of fault", next.into_inner() - first, found.len());
    for (kind, seeds) in &found {
        eprintln!("{} times: {kind}: {:?}", seeds.len(), &seeds[..seeds.len().min(8)]);
    }
    assert!(found.is_empty());
}

/// Run one case; where it is at fault: the first fault, then the command line, the rest and the folder.
fn attack(program: &Program, seed: u64) -> Option<String> {
    let first = faults(program, &Case::new(seed, 0));
    let kind = hold::kind(first.first()?);
    // Leave out each mutation that the fault does not need.
    let mut without = 0;
    for at in 0..Case::new(seed, 0).mutations {
        let fewer = without | 1 << at;
        if faults(program, &Case::new(seed, fewer)).first().is_some_and(|f| hold::kind(f) == kind) {
            without = fewer;
        }
    }
    let case = Case::new(seed, without);
    let faults = faults(program, &case);
    let folder = kept(&case, seed);
    Some(format!("case {seed}: {}\nin {}: {}", faults.join("\n  "), folder.display(), case.command_line()))
}

/// What one case does that it must not.
fn faults(program: &Program, case: &Case) -> Vec<String> {
    let folder = run::Folder::new();
    let (before, once) = run_with(program, case, folder.path(), "1");
    let after = Files::of(folder.path());
    let mut faults = hold::faults(case, &before, &once, &after);
    faults.extend(hold::unreadable(program, case, &before, &after, folder.path()));
    if case.repeats && faults.is_empty() {
        let folder = run::Folder::new();
        let (_, twice) = run_with(program, case, folder.path(), "2");
        faults.extend(hold::differences(&once, &after, &twice, &Files::of(folder.path())));
    }
    faults
}

/// Lay out the files, make the journal and spoil it, run; the files before the run and how it ended.
fn run_with(program: &Program, case: &Case, folder: &Path, threads: &str) -> (Files, run::Ran) {
    Files::write(folder, &case.files);
    if !case.prepare.is_empty() {
        program.run(folder, &case.prepare, &[], None);
        for (name, mutation) in &case.spoil {
            if let Ok(bytes) = std::fs::read(folder.join(name)) {
                std::fs::write(folder.join(name), mutate::bytes(&bytes, &mut mutation.clone())).unwrap();
            }
        }
    }
    let before = Files::of(folder);
    let mut args = case.args.clone();
    if case.repeats {
        args.extend(["--threads".to_owned(), threads.to_owned()]);
    }
    (before, program.run(folder, &args, &case.input, case.interrupt))
}

/// Files and command line of a case, kept for the person who mends it.
fn kept(case: &Case, seed: u64) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("attack").join(seed.to_string());
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    Files::write(&folder, &case.files);
    std::fs::write(folder.join("input"), &case.input).unwrap();
    std::fs::write(folder.join("command"), case.command_line()).unwrap();
    folder
}
