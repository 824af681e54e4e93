//! Journals of a search from outside: nobody's file is lost, no row is believed unchecked, one search at a time writes.

use crate::program::*;
use sprag_design::cli::exit::Failure as Refused;
use sprag_design::cli::journal::{JournalFile, model};
use sprag_design::optimise::{Entry, Evaluation, EvaluationPart, NoEvaluation, ProblemId};
use std::io::Write;
use std::path::Path;
use std::process::Output;

fn said(out: &Output) -> String {
    // Unfolded: long sentences are broken on standard error.
    String::from_utf8_lossy(&out.stderr).replace("\n  │ ", " ").replace('\n', " ")
}

/// A search that takes seconds: one scenario, one climb, few evaluations.
fn quick(folder: &Folder) -> String {
    folder.changed(MULTI, &[(r#"["high-6", "low-10", "rated-45", "rated-45-at-speed"]"#, r#"["rated-45"]"#)])
}

fn search(design: &str, new: &str, more: &[&str]) -> Output {
    let args = ["optimize", design, "-o", new, "--starts", "1", "--evaluations", "6", "--json"];
    run(&[&args[..], more].concat())
}

/// A journal of one row that belongs to no problem of ours.
fn written(path: &str, model: &str) -> Vec<u8> {
    let mut file = JournalFile::open(Path::new(path), model, "d").unwrap();
    let problem = ProblemId { hash: "p".into(), variables: vec!["x".into()], error: "1e-6".into() };
    file.append(&problem, &Entry { x: vec![0.5], outcome: Err(NoEvaluation::Refused("why".into())) });
    drop(file);
    std::fs::read(path).unwrap()
}

#[test]
fn a_file_that_is_no_journal_is_left_as_it_is() {
    let folder = Folder::new();
    let (new, place) = (folder.path("new.toml"), folder.path("new.toml.journal"));
    let (first, binary): (&[u8], &[u8]) = (b"caf\xe9,size\nlast line, without an end", b"\xff\x00\n\x01");
    let earlier: &[u8] =
        b"model,design,problem,hash,variables,x,outcome,objectives,limits,tie_break,error,detail\na,b";
    for (bytes, word) in [(first, "no journal"), (binary, "no journal"), (earlier, "earlier version")] {
        for more in [&["--journal", &place][..], &["--journal", &place, "--resume"], &["--resume"], &[]] {
            if more.is_empty() && word == "earlier version" {
                continue;
            }
            std::fs::write(&place, bytes).unwrap();
            let out = search(MULTI, &new, more);
            assert_eq!(out.status.code(), Some(2), "{more:?}: {}", said(&out));
            assert!(said(&out).contains(word), "{}", said(&out));
            assert_eq!(std::fs::read(&place).unwrap(), bytes, "{more:?}");
        }
    }
}

#[test]
fn without_resume_an_old_journal_is_kept_and_named() {
    let folder = Folder::new();
    let (new, place) = (folder.path("new.toml"), folder.path("new.toml.journal"));
    let design = quick(&folder);
    let earlier =
        b"model,design,problem,hash,variables,x,outcome,objectives,limits,tie_break,error,detail\na,b\n";
    let old = written(&place, &model());
    let out = search(&design, &new, &[]);
    assert!(said(&out).contains("new.toml.journal.1"), "{}", said(&out));
    assert_eq!(std::fs::read(folder.path("new.toml.journal.1")).unwrap(), old);
    std::fs::write(&place, earlier).unwrap();
    let out = search(&design, &new, &[]);
    assert!(said(&out).contains("new.toml.journal.2"), "{}", said(&out));
    assert_eq!(std::fs::read(folder.path("new.toml.journal.2")).unwrap(), earlier);
    assert_eq!(std::fs::read(folder.path("new.toml.journal.1")).unwrap(), old);
    assert!(!Path::new(&place).exists(), "the search itself is over");
}

#[test]
fn one_search_at_a_time_writes_a_journal() {
    let folder = Folder::new();
    let (new, place) = (folder.path("new.toml"), folder.path("record.csv"));
    let before = written(&place, &model());
    let held = JournalFile::open(Path::new(&place), &model(), "d").unwrap();
    let out = search(MULTI, &new, &["--journal", &place]);
    assert_eq!(out.status.code(), Some(3), "{}", said(&out));
    assert!(said(&out).contains("another search is writing this journal"), "{}", said(&out));
    assert_eq!(std::fs::read(&place).unwrap(), before);
    drop(held);
}

#[test]
fn a_row_is_believed_only_if_its_check_agrees_and_its_model_is_ours() {
    let folder = Folder::new();
    let (new, place) = (folder.path("new.toml"), folder.path("record.csv"));
    let design = quick(&folder);
    let first = json(&search(&design, &new, &["--journal", &place]));
    let text = std::fs::read_to_string(&place).unwrap();
    // Somebody makes a limit look better than it was computed.
    let row = text.lines().find(|l| l.contains(",ok,")).unwrap();
    let cells: Vec<&str> = row.split(',').collect();
    let better = row.replace(cells[7], "9.5");
    assert!(better != row && cells.len() == 13, "{row}");
    std::fs::write(&place, text.replace(row, &better)).unwrap();
    let foreign = written(&place, "sprag-design 0.1.0 of another day");
    let out = search(&design, &new, &["--journal", &place]);
    for words in ["whose check disagrees", "1 row by another version"] {
        assert!(said(&out).contains(words), "{words}: {}", said(&out));
    }
    assert_eq!(json(&out)["best"], first["best"]);
    let after = std::fs::read(&place).unwrap();
    assert!(after.starts_with(&foreign), "nothing is taken away");
    let fresh = String::from_utf8(after[foreign.len()..].to_vec()).unwrap();
    // Parts of a search look at one point more than once.
    let (lines, edited) = (fresh.lines().count(), text.lines().filter(|l| *l == row).count());
    assert!(
        fresh.lines().all(|l| l == row) && lines == edited,
        "the edited row is computed anew, no other: {fresh}"
    );
    // Rows of another version alone are nothing to go on with.
    let alone = folder.path("alone.csv");
    let kept = written(&alone, "sprag-design 0.1.0 of another day");
    let out = search(&design, &new, &["--resume", "--journal", &alone]);
    assert_eq!(out.status.code(), Some(2), "{}", said(&out));
    assert_eq!(std::fs::read(&alone).unwrap(), kept);
}

/// A kill may fall into the first line or into any other; what is left of it is not glued to what follows.
#[test]
fn half_a_line_is_dropped_and_the_next_row_stands_alone() {
    let folder = Folder::new();
    let place = folder.path("torn.csv");
    std::fs::write(&place, "model,des").unwrap();
    let whole = written(&place, "t");
    for left in ["t,d,p,h,x,0.", "t,d,p,h,x,0.5,refused,,,,1e-6,\"a, ", "t"] {
        std::fs::write(&place, [&whole, left.as_bytes()].concat()).unwrap();
        let after = written(&place, "t");
        assert_eq!(after[..whole.len()], whole, "{left}");
        let text = String::from_utf8(after).unwrap();
        assert_eq!(text.lines().count(), 3, "{text}");
        let file = JournalFile::open(Path::new(&place), "t", "d").unwrap();
        assert_eq!((file.entries(), file.unused()), (2, None), "{text}");
    }
}

/// The file of the nearest design is named after the output: that name may be the input's.
#[test]
fn a_file_beside_the_output_replaces_neither_the_input_nor_somebody_elses() {
    let folder = Folder::new();
    let (new, beside) = (folder.path("better.toml"), folder.path("better.nearest.toml"));
    std::fs::copy(MULTI, &beside).unwrap();
    let before = std::fs::read(&beside).unwrap();
    for (design, word) in
        [(beside.as_str(), "never overwritten"), (MULTI, "no design file that sprag-design has written")]
    {
        let out = search(design, &new, &[]);
        assert_eq!(out.status.code(), Some(2), "{}", said(&out));
        assert!(said(&out).contains("better.nearest.toml") && said(&out).contains(word), "{}", said(&out));
        assert_eq!(std::fs::read(&beside).unwrap(), before);
        assert_eq!(folder.names(), ["better.nearest.toml"]);
    }
}

fn problem() -> ProblemId {
    ProblemId { hash: "p".into(), variables: vec!["r_i2_mm".into(), "x".into()], error: "1e-6".into() }
}

fn entry(x: f64, outcome: Result<Evaluation, NoEvaluation>) -> Entry {
    Entry { x: vec![x, -0.1], outcome }
}

#[test]
fn a_torn_journal_gives_back_every_whole_row_to_the_bit() {
    let folder = Folder::new();
    let path = std::path::PathBuf::from(folder.path("a.toml.journal"));
    let mut file = JournalFile::open(&path, "t 1", "d").unwrap();
    let good = Evaluation { objectives: vec![0.1 + 0.2, -1e-300], limits: vec![1.0 / 3.0], tie_break: 4.2 };
    let entries = [
        entry(0.1, Ok(good)),
        entry(0.2, Err(NoEvaluation::Refused("a, \"b\";\nc".into()))),
        entry(0.3, Err(NoEvaluation::NotFinite { part: EvaluationPart::Limit, index: 3 })),
        entry(0.4, Err(NoEvaluation::Shape { expected: (1, 2), found: (3, 4) })),
    ];
    entries.iter().for_each(|e| file.append(&problem(), e));
    drop(file);
    // A kill in the middle of a number: what is left of the line would still read as a row.
    let mut torn = std::fs::OpenOptions::new().append(true).open(&path).unwrap();
    torn.write_all(b"t 1,d,p,h,r_i2_mm;x,0.5;0.1,ok,0.1,0.1,0.1,1e-6,").unwrap();
    drop(torn);
    let mut file = JournalFile::resume(&path, "t 1", "d").unwrap();
    assert_eq!(file.known(&problem()).entries(), &entries);
    let more = entry(0.6, Err(NoEvaluation::Refused("late".into())));
    file.append(&problem(), &more);
    drop(file);
    let file = JournalFile::open(&path, "t 1", "d").unwrap();
    assert_eq!(file.known(&problem()).entries().last(), Some(&more));
    let other = ProblemId { hash: "q".into(), ..problem() };
    assert!(file.known(&other).entries().is_empty());
    drop(file);
    // Another version knows nothing of it, another design has nothing to resume, another problem no entries.
    assert_eq!(JournalFile::open(&path, "t 2", "d").unwrap().entries(), 0);
    assert!(matches!(JournalFile::resume(&path, "t 1", "e"), Err(Refused::Malformed(_))));
    std::fs::write(&path, "a,b\n1,2\n").unwrap();
    assert!(matches!(JournalFile::open(&path, "t 1", "d"), Err(Refused::Malformed(_))));
}
