//! README and guide tell what the program does: every command in them is run, every line of output shown is printed.
//!
//! A block of text that begins with `$ sprag-design` is run, line by line, in one folder for each page, beside a copy of
//! `designs/`; `$ echo '...' | sprag-design` gives it standard input. Of the output shown each line must be printed, in this
//! order; a line `...` stands for any number of lines. Every command has a page, and every link leads to a file.

#[path = "common/program.rs"]
mod program;

use rayon::prelude::*;
use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::{Arc, Mutex, OnceLock};

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

/// README and every page of the guide below `root`.
fn pages(root: &Path) -> Vec<PathBuf> {
    let mut pages = vec![root.join("README.md")];
    for folder in ["docs/src", "docs/src/commands"] {
        let entries = std::fs::read_dir(root.join(folder)).unwrap().map(|e| e.unwrap().path());
        pages.extend(entries.filter(|p| p.extension().is_some_and(|e| e == "md")));
    }
    pages.sort();
    pages
}

/// What `echo 'INPUT' | COMMAND` gives on standard input, and the command.
fn with_input(line: &str) -> (&str, &str) {
    line.strip_prefix("echo '").and_then(|rest| rest.split_once("' | ")).unwrap_or(("", line))
}

/// Words of a command line as a shell has them: blanks between, what stands in single quotes as it is.
fn words(line: &str) -> Vec<String> {
    let (mut all, mut quoted) = (vec![String::new()], false);
    for c in line.chars() {
        match c {
            '\'' => quoted = !quoted,
            c if c.is_whitespace() && !quoted => all.push(String::new()),
            c => all.last_mut().unwrap().push(c),
        }
    }
    all.retain(|word| !word.is_empty());
    all
}

fn run(args: &str, input: &str, here: &Path) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_sprag-design"))
        .args(words(args))
        .arg("--quiet")
        .current_dir(here)
        .env("NO_COLOR", "1")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A command that reads nothing may have ended.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

/// Files of a folder, by name.
type Files = BTreeMap<String, Vec<u8>>;

fn files(folder: &Path) -> Files {
    let paths = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let name = |path: &Path| path.file_name().unwrap().to_str().unwrap().to_owned();
    paths.filter(|path| path.is_file()).map(|path| (name(&path), std::fs::read(path).unwrap())).collect()
}

/// A command, its input, the files that it names.
type Asked = (String, String, Files);
/// What it prints, the files that it writes.
type Made = (Output, Files);

/// `run`, once for all pages that ask the same of the same files: many begin alike.
fn answered(args: &str, input: &str, here: &Path) -> Output {
    static MADE: Mutex<BTreeMap<Asked, Arc<OnceLock<Made>>>> = Mutex::new(BTreeMap::new());
    let read = |name: String| std::fs::read(here.join(&name)).ok().map(|bytes| (name, bytes));
    let asked = (args.to_owned(), input.to_owned(), words(args).into_iter().filter_map(read).collect());
    let once = MADE.lock().unwrap().entry(asked).or_default().clone();
    let making = || {
        let before = files(here);
        let out = run(args, input, here);
        let mut written = files(here);
        written.retain(|name, bytes| before.get(name) != Some(bytes));
        (out, written)
    };
    let (out, written) = once.get_or_init(making);
    for (name, bytes) in written {
        std::fs::write(here.join(name), bytes).unwrap();
    }
    out.clone()
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

/// Runs the commands of a page; their number.
fn held(page: &Path) -> usize {
    let text = std::fs::read_to_string(page).unwrap();
    let folder = program::Folder::new();
    let here = PathBuf::from(folder.path(""));
    copied(Path::new("designs"), &here.join("designs"));
    copied(Path::new("tests/reference"), &here.join("tests/reference"));
    let mut count = 0;
    for step in steps(&text) {
        let (input, command) = with_input(&step.command);
        let Some(args) = command.strip_prefix("sprag-design ") else { continue };
        count += 1;
        let out = answered(args, input, &here);
        let printed =
            format!("{}{}", String::from_utf8_lossy(&out.stdout), String::from_utf8_lossy(&out.stderr));
        let place = format!("{}: {}", page.display(), step.command);
        // What the page shows as refused is refused, all else is answered.
        let refused =
            step.shown.first().is_some_and(|line| line.starts_with("  ×") || line.starts_with("error:"));
        let code = out.status.code();
        assert!(
            matches!((refused, code), (false, Some(0 | 1)) | (true, Some(2 | 3))),
            "{place}: {code:?}\n{printed}"
        );
        if let Some(line) = missing(&step.shown, &printed) {
            panic!("{place}\nis said to print\n{line}\nand prints\n{printed}");
        }
    }
    count
}

#[test]
fn every_command_of_readme_and_guide_prints_what_they_show() {
    let count: usize = pages(Path::new("")).par_iter().map(|page| held(page)).sum();
    assert!(count >= 40, "only {count} commands found");
}

/// The names in the section `Commands:` of the help.
fn commands() -> Vec<String> {
    let help = program::stdout(&program::run(&["--help"]));
    let section = help.lines().skip_while(|l| *l != "Commands:").skip(1).take_while(|l| !l.is_empty());
    let names = section.filter(|l| !l.starts_with("   ")).filter_map(|l| l.split_whitespace().next());
    names.filter(|n| *n != "help").map(str::to_owned).collect()
}

#[test]
fn every_command_has_its_page() {
    let commands = commands();
    assert!(commands.len() >= 19, "{commands:?}");
    let contents = std::fs::read_to_string("docs/src/SUMMARY.md").unwrap();
    for name in commands {
        assert!(Path::new(&format!("docs/src/commands/{name}.md")).exists(), "no page of {name}");
        assert!(contents.contains(&format!("(commands/{name}.md)")), "{name} is not in SUMMARY.md");
    }
}

/// The targets of the links and pictures of a page that are files.
fn links(page: &str) -> Vec<&str> {
    let outside_code = page.split("```").step_by(2);
    let targets =
        outside_code.flat_map(|text| text.split("](").skip(1)).filter_map(|rest| rest.split(')').next());
    targets
        .filter(|t| !t.contains("://"))
        .map(|t| t.split('#').next().unwrap_or(t))
        .filter(|t| !t.is_empty())
        .collect()
}

/// `GUIDE_ROOT` names another folder than the source's, as `.ci/release` does with the archive unpacked.
#[test]
fn every_link_of_readme_and_guide_leads_to_a_file() {
    let root = PathBuf::from(std::env::var("GUIDE_ROOT").unwrap_or_default());
    for page in pages(&root) {
        let text = std::fs::read_to_string(&page).unwrap();
        for link in links(&text) {
            assert!(page.with_file_name(link).exists(), "{}: {link} leads nowhere", page.display());
        }
    }
}

#[test]
fn what_is_shown_must_stand_there_in_its_order() {
    let steps = steps("x\n```text\n$ sprag-design a \\\n   b\none\n...\nthree\n```\n```sh\nno\n```\n");
    assert_eq!(steps.len(), 1);
    assert_eq!(steps[0].command, "sprag-design a  b");
    assert_eq!(missing(&steps[0].shown, "one\ntwo\nthree\n"), None);
    assert_eq!(missing(&steps[0].shown, "one\ntwo\n"), Some("three"));
    assert_eq!(missing(&steps[0].shown, "zero\none\nthree"), Some("one"));
    assert_eq!(with_input("echo '[1, 2]' | sprag-design a"), ("[1, 2]", "sprag-design a"));
    assert_eq!(
        links("[a](b.md#c) ![d](e.png) [f](#g) [h](https://i)\n```\n[j](k)\n```\n"),
        ["b.md", "e.png"]
    );
}
