use super::*;
use std::sync::atomic::AtomicUsize;

/// A folder of its own per test, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Self {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("sprag-design-output-{}-{number}", std::process::id()));
        fs::create_dir(&path).unwrap();
        Self(path)
    }

    fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(&self.0)
            .unwrap()
            .map(|e| e.unwrap().file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn message(failure: Failure) -> String {
    match failure {
        Failure::Malformed(report) => report.to_string(),
        Failure::Failed(text) | Failure::NoClutch(text) => text,
        Failure::Interrupted => "interrupted".into(),
        Failure::Several(all) => all.into_iter().map(message).collect(),
    }
}

#[test]
fn a_written_file_is_whole_and_alone() {
    let folder = Folder::new();
    let path = folder.0.join("out.csv");
    write_whole(&path, b"first").unwrap();
    write_whole(&path, b"second").unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"second");
    assert_eq!(folder.names(), ["out.csv"]);
}

#[test]
fn a_write_that_fails_leaves_the_old_file_and_no_other() {
    let folder = Folder::new();
    let path = folder.0.join("out.csv");
    write_whole(&path, b"old").unwrap();
    // The rename fails: a folder with content cannot be replaced by a file.
    let blocked = folder.0.join("blocked");
    fs::create_dir(&blocked).unwrap();
    fs::write(blocked.join("kept"), b"").unwrap();
    let text = write_whole(&blocked, b"new").unwrap_err();
    assert!(text.contains("blocked"), "{text}");
    let text = write_whole(&folder.0.join("missing").join("out.csv"), b"new").unwrap_err();
    assert!(text.contains("missing"), "{text}");
    assert_eq!(fs::read(&path).unwrap(), b"old");
    assert_eq!(folder.names(), ["blocked", "out.csv"]);
}

#[cfg(unix)]
#[test]
fn links_stay_links_and_devices_stay_devices() {
    let folder = Folder::new();
    let (file, link) = (folder.0.join("file"), folder.0.join("link"));
    fs::write(&file, b"old").unwrap();
    std::os::unix::fs::symlink(&file, &link).unwrap();
    write_whole(&link, b"new").unwrap();
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(fs::read(&file).unwrap(), b"new");
    write_whole(Path::new("/dev/null"), b"nothing").unwrap();
    assert!(is_special(Path::new("/dev/null")));
}

#[test]
fn harmful_outputs_are_refused_before_the_work() {
    let folder = Folder::new();
    let design = folder.0.join("design.toml");
    fs::write(&design, b"schema = 1").unwrap();
    let outputs = |csv: &Path, report: &Path| Outputs::new(Some(csv.into()), Some(report.into()), false);
    let (csv, html) = (folder.0.join("a.csv"), folder.0.join("a.html"));
    let fem = folder.0.join("fem.csv");
    assert!(outputs(&csv, &html).check(&[&design], &[]).is_ok());
    let same = folder.0.join(".").join("design.toml");
    for (bad, others, want) in [
        (outputs(&same, &html), vec![], "never overwritten"),
        (outputs(&fem, &html), vec![], "is read by this command"),
        (outputs(&csv, &csv), vec![], "two outputs"),
        (outputs(&csv, &html), vec![(csv.as_path(), FileKind::Table)], "two outputs"),
        (outputs(&folder.0, &html), vec![], "folder"),
        (outputs(&folder.0.join("none").join("a.csv"), &html), vec![], "does not exist"),
    ] {
        let failure = bad.check(&[&design, &fem], &others).unwrap_err();
        assert_eq!(failure.exit(), crate::cli::exit::Exit::Malformed);
        let text = message(failure);
        assert!(text.contains(want), "{text} should say {want}");
    }
    assert_eq!(fs::read(&design).unwrap(), b"schema = 1");
}

#[test]
fn a_file_of_another_kind_is_not_overwritten() {
    let folder = Folder::new();
    let make = |name: &str| {
        let path = folder.0.join(name);
        fs::write(&path, b"old").unwrap();
        path
    };
    let (design, table, page) = (make("other.TOML"), make("old.csv"), make("old.html"));
    let none = Outputs::default();
    let csv = |path: &Path| Outputs { csv: Some(path.into()), ..Outputs::default() };
    let report = |path: &Path| Outputs { report: Some(path.into()), ..Outputs::default() };
    for (bad, others, want) in [
        (csv(&design), vec![], "is a design file already; a table does not"),
        (csv(&page), vec![], "is a page already"),
        (report(&design), vec![], "a page does not overwrite it"),
        (report(&table), vec![], "is a table already"),
        (none.clone(), vec![(design.as_path(), FileKind::Deck)], "is a design file already"),
        (none.clone(), vec![(table.as_path(), FileKind::Design)], "is a table already"),
    ] {
        let text = message(bad.check(&[], &others).unwrap_err());
        assert!(text.contains(want), "{text} should say {want}");
    }
    assert!(message(csv(&folder.0.join("new.toml")).check(&[], &[]).unwrap_err()).contains(".csv"));
    // Nor is one of its own kind that somebody else has made; with --force it is.
    for mut theirs in [csv(&table), report(&page), csv(&make("notes.txt"))] {
        let text = message(theirs.refuse_foreign().unwrap_err());
        assert!(text.contains("--force"), "{text}");
        theirs.force = true;
        assert!(theirs.check(&[], &[]).is_ok() && theirs.refuse_foreign().is_ok());
    }
    // What this tool has made gives way, as does an empty file.
    fs::write(&table, "code,name\n1,2\n").unwrap();
    fs::write(&page, "<!-- sprag-design 1 -->\n").unwrap();
    fs::write(&design, "").unwrap();
    assert!(csv(&table).check(&[], &[(&design, FileKind::Design)]).is_ok());
    assert!(csv(&table).refuse_foreign().is_ok() && report(&page).refuse_foreign().is_ok());
}

/// A temporary of a killed run whose process id has come round again, or a file of that name by somebody else.
#[test]
fn a_name_that_is_taken_is_left_alone_and_the_next_one_used() {
    let folder = Folder::new();
    let (taken, file) = Temporary::create(&folder.0).unwrap();
    drop(file);
    let name = taken.0.file_name().unwrap().to_str().unwrap();
    let number: u32 = name.rsplit(['-', '.']).nth(1).unwrap().parse().unwrap();
    let stale: Vec<PathBuf> = (number + 1..number + 40)
        .map(|n| folder.0.join(format!(".{TOOL}-{}-{n}.tmp", std::process::id())))
        .collect();
    stale.iter().for_each(|path| fs::write(path, b"stale").unwrap());
    write_whole(&folder.0.join("out.csv"), b"new").unwrap();
    assert_eq!(fs::read(folder.0.join("out.csv")).unwrap(), b"new");
    assert!(stale.iter().all(|path| fs::read(path).unwrap() == b"stale"));
}
