//! README and guide tell what the program does: every command in them is run, every line of output shown is printed.
//!
//! A block of text that begins with `$ sprag-design` is run, line by line, in one folder for each page, beside a copy of
//! `designs/`. Of the output shown each line must be printed, in this order; a line `...` stands for any number of lines.

#[path = "common/program.rs"]
mod program;

use std::path::{Path, PathBuf};
use std::process::Command;

struct Step {
    command: String,
    shown: Vec<String>,
}

/// The commands of a page with the output that is shown of each.
fn steps(page: &str) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    let mut inside = false;
    let mut open = false;
    for line in page.lines() {
        if line.starts_with("```") {
            inside = line == "```text" && !inside;
            open = false;
        } else if let (true, Some(command)) = (inside, line.strip_prefix("$ ")) {
            steps.push(Step { command: command.to_owned(), shown: Vec::new() });
            open = true;
        } else if let (true, Some(step)) = (inside && open, steps.last_mut()) {
            if let Some(cut) = step.command.strip_suffix('\\').map(str::to_owned) {
                step.command = format!("{cut} {}", line.trim());
            } else {
                step.shown.push(line.trim_end().to_owned());
            }
        }
    }
    steps
}

/// Hashes name a version of the program too: any stands for any.
fn without_hashes(line: &str) -> String {
    let is_hash = |word: &str| word.len() == 12 && word.chars().all(|c| matches!(c, '0'..='9' | 'a'..='f'));
    line.split(' ')
        .map(|word| if is_hash(word) { "HASH" } else { word })
        .collect::<Vec<_>>()
        .join(" ")
        .trim_end()
        .to_owned()
}

/// The first line shown that is not printed where it should be.
fn missing<'s>(shown: &'s [String], printed: &str) -> Option<&'s str> {
    let mut lines = printed.lines().map(without_hashes);
    let mut any = false;
    for wanted in shown.iter().filter(|l| !l.is_empty()) {
        if wanted == "..." {
            any = true;
            continue;
        }
        let mut rest = lines.by_ref().filter(|l| !l.is_empty());
        let meant = without_hashes(wanted);
        let found = if any { rest.any(|l| l == meant) } else { rest.next().is_some_and(|l| l == meant) };
        if !found {
            return Some(wanted);
        }
        any = false;
    }
    None
}

fn pages() -> Vec<PathBuf> {
    let mut pages = vec![PathBuf::from("README.md")];
    let guide = std::fs::read_dir("docs/src").unwrap().map(|e| e.unwrap().path());
    pages.extend(guide.filter(|p| p.extension().is_some_and(|e| e == "md")));
    pages.sort();
    pages
}

fn copied(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() {
            copied(&path, &target);
        } else {
            std::fs::copy(&path, &target).unwrap();
        }
    }
}

#[test]
fn every_command_of_readme_and_guide_prints_what_they_show() {
    let mut count = 0;
    for page in pages() {
        let text = std::fs::read_to_string(&page).unwrap();
        let folder = program::Folder::new();
        let here = PathBuf::from(folder.path(""));
        copied(Path::new("designs"), &here.join("designs"));
        copied(Path::new("tests/reference"), &here.join("tests/reference"));
        for step in steps(&text) {
            let Some(args) = step.command.strip_prefix("sprag-design ") else { continue };
            count += 1;
            let out = Command::new(env!("CARGO_BIN_EXE_sprag-design"))
                .args(args.split_whitespace().map(|a| a.trim_matches('\'')))
                .arg("--quiet")
                .current_dir(&here)
                .env("NO_COLOR", "1")
                .output()
                .unwrap();
            let printed =
                format!("{}{}", String::from_utf8_lossy(&out.stdout), String::from_utf8_lossy(&out.stderr));
            let place = format!("{}: {}", page.display(), step.command);
            assert!(matches!(out.status.code(), Some(0 | 1)), "{place}: {:?}\n{printed}", out.status.code());
            if let Some(line) = missing(&step.shown, &printed) {
                panic!("{place}\nis said to print\n{line}\nand prints\n{printed}");
            }
        }
    }
    assert!(count >= 15, "only {count} commands found");
}

#[test]
fn what_is_shown_must_stand_there_in_its_order() {
    let steps = steps("x\n```text\n$ sprag-design a \\\n   b\none\n...\nthree\n```\n```sh\nno\n```\n");
    assert_eq!(steps.len(), 1);
    assert_eq!(steps[0].command, "sprag-design a  b");
    assert_eq!(missing(&steps[0].shown, "one\ntwo\nthree\n"), None);
    assert_eq!(missing(&steps[0].shown, "one\ntwo\n"), Some("three"));
    assert_eq!(missing(&steps[0].shown, "zero\none\nthree"), Some("one"));
}
