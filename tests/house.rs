//! The house: what the sources promise about themselves, read from the sources; by the standard library only, for these tests must not
//! depend on what they judge.

use std::fs;
use std::path::{Path, PathBuf};

/// Which rooms a room may use, in the order of the map in `src/lib.rs`. `lib.rs` and `main.rs` are no rooms.
const MAY_USE: &[(&str, &str)] = &[
    ("numeric", ""),
    ("ode", ""),
    // What is given to every computation from outside: it knows none.
    ("follow", ""),
    ("material", ""),
    ("profile", "material numeric"),
    ("race", "material numeric"),
    // Oils and films: a contact is two radii, a modulus and a length.
    ("lubrication", ""),
    // Values in SI and the contact laws by name; radii as run follow from those as made by a press fit.
    ("clutch", "material profile race lubrication"),
    // Values, and the units in which they are written: no TOML.
    ("design", "material clutch"),
    // TOML: no law of physics and no allowable. The narrowest working sprag is drawn where a file names no flanks.
    ("file", "numeric material profile lubrication clutch design"),
    // Strangers to one another: no law of row 2 knows another law, a design or a sprag's profile.
    ("kinematics", "numeric"),
    ("contact", "material numeric"),
    ("friction", "numeric lubrication clutch"),
    ("wedge", "numeric material profile clutch kinematics contact race"),
    ("dynamics", "follow numeric ode lubrication clutch kinematics friction wedge"),
    // Unlike sprags between the races of one clutch, on its curve.
    ("sharing", "numeric race clutch wedge"),
    // A scenario may be given another friction law; what slides on a film is at the temperature of its heat balance.
    ("scenario", "follow numeric lubrication clutch profile friction wedge dynamics"),
    // A scene of unlike sprags begins as a scene does, and draws its sprags as statics does.
    ("sprags", "clutch friction wedge dynamics sharing scenario"),
    // Begins as a scene does.
    ("element", "numeric follow clutch dynamics scenario"),
    ("fidelity", "numeric clutch profile contact wedge dynamics scenario"),
    ("accuracy", "follow numeric clutch dynamics scenario fidelity"),
    (
        "margin",
        "follow sharing numeric contact race clutch design profile kinematics wedge dynamics scenario",
    ),
    // A motion of the element and the curve that it ends on.
    ("reengage", "follow clutch wedge dynamics element"),
    // The same element, swung by a drive.
    ("feed", "follow clutch wedge dynamics element"),
    // Loads of a life on the static curve; strengths are the file's.
    ("life", "numeric profile lubrication clutch design friction wedge margin"),
    // Never a contact, a wedge or a path. Scenes run as fidelity plans them; a centroid is made real on the profile itself.
    ("optimise", "follow numeric profile clutch design file scenario fidelity margin"),
    ("journal", "optimise"),
    // Points of a box, and whatever the margins say there.
    ("sweep", "follow numeric design margin optimise"),
    // Asks for margins and static points as they are; knows no law.
    ("identify", "follow numeric clutch design file wedge margin"),
    // A first design: proportions, then whatever the margins say.
    ("size", "numeric material clutch design profile wedge scenario margin"),
    // Files beside one another, then whatever the margins say.
    ("compare", "clutch design file profile wedge scenario margin"),
    // Units and drawings: a profile to draw, no physics.
    ("report", "profile clutch"),
    // A finite-element deck is a whole clutch, and its own curve says how far to turn it.
    ("export", "numeric material profile clutch design file wedge element"),
    // An outline is a profile and flanks; races are two radii, so no design.
    ("import", "profile"),
    // What is computed is put into words, units and pages here: all but the command.
    (
        "answer",
        "numeric follow material lubrication profile clutch design file contact race wedge dynamics \
         scenario fidelity accuracy margin sharing sprags life element reengage feed optimise sweep \
         identify size compare report export import",
    ),
    // Questions about the text of a design, and their answers as a page shows them.
    ("studio", "answer follow clutch design file wedge dynamics scenario margin optimise report"),
    (
        "cli",
        "answer follow material profile clutch design file wedge dynamics scenario element accuracy \
         margin optimise journal sweep identify size report export import studio",
    ),
];

/// Outside world, for `cli` alone.
const OUTSIDE: &[&str] =
    &["std::fs", "std::env", "std::process", "print!(", "println!(", "eprint!(", "eprintln!(", "dbg!("];

/// Exceptions, each with its reason.
const MAY_TOUCH: &[(&str, &str)] = &[
    // A design is a file with its histories: errors name file, line and key, so the room opens these itself, here alone.
    ("src/file/open.rs", "std::fs"),
    // The platform that the program was compiled for is no environment.
    ("src/export/fmu/archive.rs", "std::env"),
];

/// Rooms where a length in mm, an angle in degrees, a pressure in MPa or a speed in rev/min is at home: files, pages, drawings.
const FACES: &[&str] = &["file", "report", "export", "import", "answer", "studio", "cli"];

/// Files elsewhere that name such a unit, each with its reason.
const UNITS_ELSEWHERE: &[(&str, &str)] = &[
    ("src/profile/mod.rs", "words of an error"),
    ("src/profile/unclosed.rs", "words of an error"),
    ("src/clutch/law.rs", "the roller law's coefficient is a number of mm and N by its definition"),
    ("src/design/units.rs", "the change of a file's units to SI"),
    ("src/design/limits.rs", "the table of a file's limits: keys and units"),
    ("src/design/objective.rs", "the table of objectives: their units, and steps of the file's variables"),
    ("src/design/mod.rs", "names of those"),
    ("src/scenario/figures.rs", "the table of figures: the keys of JSON and CSV"),
    ("src/margin/table.rs", "the table of limits: their keys and units"),
    ("src/margin/row.rs", "keys of that table"),
    ("src/margin/mod.rs", "keys of the file that decide whether there is a curve"),
    ("src/margin/limits.rs", "the name of a row, as it is printed"),
    ("src/margin/run_out/rows.rs", "the place of a sprag, as it is printed"),
    ("src/optimise/freed.rs", "keys of the file that are asked what would free a problem"),
    ("src/optimise/grid.rs", "steps in which a shop makes lengths, in mm as the variables are"),
    ("src/optimise/goal.rs", "measures of a search near 1: windup in degrees"),
    ("src/optimise/realise.rs", "unknowns near 1, flanks in mm, and the file's keys for them"),
    ("src/identify/observation.rs", "the columns of a file of observations"),
    ("src/identify/predict.rs", "predictions in the units of those columns"),
    ("src/size/asked.rs", "words and ranges of a question, as it is typed"),
    ("src/size/requirements.rs", "drives' speeds, as the table of purposes has them"),
    ("src/size/finish.rs", "words of the new file"),
    ("src/size/search.rs", "words of what was tried"),
    ("src/size/purpose.rs", "what is taken of a drive where nobody says: numbers and keys of the new file"),
    ("src/lubrication/oil.rs", "sources of the oils, in the words of data sheets"),
    ("src/wedge/elastic.rs", "words of an error"),
];

/// Rooms that may name an option of the command: a library user has none.
const HAVE_OPTIONS: &[&str] = &["answer", "studio", "cli"];

/// Files elsewhere that do, each with its reason.
const OPTIONS_ELSEWHERE: &[(&str, &str)] = &[
    ("src/export/calculix/write.rs", "a line of the deck: how its result is read back"),
    ("src/size/asked.rs", "the table that options are made of"),
];

/// Longest file, lines: beyond it, look for the second thing in it. No reason to cut one thing in two.
const LONGEST: usize = 600;

/// Names that several public types have, each with the reason.
const SHARED_NAMES: &[(&str, &str)] = &[
    ("Settings", "of a scene, of a climb, of an element: always written with the room"),
    ("Step", "of DOP853, of Radau IIA, and either: always written with the method"),
    ("Dense", "the same of dense output"),
];

/// Every numbered equation of the paper.
fn numbers() -> Vec<String> {
    (1..=15).map(|n| format!("({n})")).chain((1..=9).map(|n| format!("(A.{n})"))).collect()
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn files(folder: &str, endings: &[&str]) -> Vec<PathBuf> {
    let mut out = Vec::new();
    let mut open = vec![root().join(folder)];
    while let Some(folder) = open.pop() {
        let Ok(entries) = fs::read_dir(&folder) else { continue };
        for entry in entries.flatten() {
            let path = entry.path();
            let name = entry.file_name().to_string_lossy().into_owned();
            if path.is_dir() && name != "target" && name != ".git" {
                open.push(path);
            } else if path.is_file() && endings.iter().any(|e| name.ends_with(e)) {
                out.push(path);
            }
        }
    }
    out.sort();
    out
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Path from the repository's root, with slashes.
fn name(path: &Path) -> String {
    path.strip_prefix(root()).unwrap().to_string_lossy().replace('\\', "/")
}

/// Room of a file in `src`; none for `lib.rs`, `main.rs` and the macro that every room may use.
fn room(name: &str) -> Option<&str> {
    let inside = name.strip_prefix("src/")?;
    let room = inside.split('/').next()?.trim_end_matches(".rs");
    (!["lib", "main", "named"].contains(&room)).then_some(room)
}

/// Sources that ship: no tests, no comments.
fn shipped() -> Vec<(String, String)> {
    let all: Vec<(String, String)> =
        files("src", &[".rs"]).iter().map(|path| (name(path), read(path))).collect();
    let tests: Vec<String> = all.iter().flat_map(|(name, text)| test_files(name, text)).collect();
    all.into_iter()
        .filter(|(name, _)| {
            !tests.iter().any(|t| name == &format!("{t}.rs") || name.starts_with(&format!("{t}/")))
        })
        .map(|(name, text)| (name, without_tests_and_comments(&text)))
        .collect()
}

/// Files that `text` declares as `#[cfg(test)] mod name;`, without their ending.
fn test_files(name: &str, text: &str) -> Vec<String> {
    let folder = match name.strip_suffix("/mod.rs") {
        Some(folder) => folder.to_owned(),
        None => name.trim_end_matches(".rs").to_owned(),
    };
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let declared = |pair: &[&str]| {
        let module = pair[1].trim_start_matches("pub(crate) ").strip_prefix("mod ")?.strip_suffix(';')?;
        (pair[0] == "#[cfg(test)]").then(|| format!("{folder}/{module}"))
    };
    lines.windows(2).filter_map(declared).collect()
}

fn without_tests_and_comments(text: &str) -> String {
    let mut out = String::new();
    let mut lines = text.lines().peekable();
    while let Some(line) = lines.next() {
        if line.trim() == "#[cfg(test)]"
            && lines.peek().is_some_and(|l| l.contains("mod ") && l.ends_with('{'))
        {
            // rustfmt closes a module at the column where it began.
            let column = line.len() - line.trim_start().len();
            let end = format!("{}}}", " ".repeat(column));
            lines.by_ref().find(|l| *l == end);
        } else {
            out.push_str(line.split("//").next().unwrap_or(""));
            out.push('\n');
        }
    }
    out
}

fn words_after<'a>(text: &'a str, start: &'a str) -> impl Iterator<Item = &'a str> {
    text.match_indices(start)
        .filter(|&(at, _)| !text[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_'))
        .map(move |(at, _)| {
            let rest = &text[at + start.len()..];
            &rest[..rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len())]
        })
}

#[test]
fn rooms_use_only_what_they_may() {
    let mut wrong = Vec::new();
    let mut seen = 0;
    for (name, text) in shipped() {
        let Some(here) = room(&name) else { continue };
        let Some((_, allowed)) = MAY_USE.iter().find(|(room, _)| *room == here) else {
            wrong.push(format!("{name}: the room {here} is not in the table"));
            continue;
        };
        for used in words_after(&text, "crate::") {
            seen += 1;
            if used != here && !allowed.split_whitespace().any(|room| room == used) {
                wrong.push(format!("{name}: {here} may not use crate::{used}"));
            }
        }
        // `super` must not reach the root by another name.
        let depth = name.matches('/').count() - usize::from(name.ends_with("/mod.rs"));
        if text.contains(&"super::".repeat(depth)) {
            wrong.push(format!("{name}: reach other rooms by crate::, not by super::"));
        }
    }
    assert!(seen > 50, "only {seen} uses found: the scan is broken");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_table_points_up() {
    for (at, (here, allowed)) in MAY_USE.iter().enumerate() {
        for used in allowed.split_whitespace() {
            let there = MAY_USE.iter().position(|(room, _)| *room == used);
            assert!(there.is_some_and(|there| there < at), "{here} must not use {used}");
        }
    }
}

#[test]
fn the_map_names_every_room_and_no_other() {
    let lib = read(&root().join("src/lib.rs"));
    let mapped: Vec<&str> = lib
        .lines()
        .filter_map(|l| l.strip_prefix("//! | ")?.split("| [`").nth(1)?.split('`').next())
        .collect();
    let mut rooms: Vec<String> =
        files("src", &[".rs"]).iter().filter_map(|p| room(&name(p)).map(str::to_owned)).collect();
    rooms.sort();
    rooms.dedup();
    let mut sorted = mapped.clone();
    sorted.sort_unstable();
    assert_eq!(sorted, rooms);
    // The map runs down in the same order as the table here.
    let order: Vec<usize> =
        mapped.iter().map(|m| MAY_USE.iter().position(|(room, _)| room == m).unwrap()).collect();
    assert!(order.is_sorted(), "{mapped:?}");
}

#[test]
fn only_cli_touches_the_world() {
    let mut wrong = Vec::new();
    for (name, text) in shipped() {
        if room(&name).is_none_or(|room| room == "cli") {
            continue;
        }
        for word in OUTSIDE {
            if text.contains(word) && !MAY_TOUCH.contains(&(name.as_str(), *word)) {
                wrong.push(format!("{name}: {word}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    for (file, word) in MAY_TOUCH {
        assert!(read(&root().join(file)).contains(word), "{file} needs no exception for {word}");
    }
}

/// Words of `text`, in code and in strings, that are a unit of files and pages, end in one, or change to one.
fn units_of_files(text: &str) -> Vec<String> {
    let unit = |word: &str| ["mm", "um", "deg", "mpa", "gpa", "rpm"].contains(&word);
    let words = text.split(|c: char| !c.is_alphanumeric() && c != '_').map(str::to_lowercase);
    let found = words.filter(|word| {
        unit(word.rsplit('_').next().unwrap_or("")) || ["to_degrees", "to_radians"].contains(&word.as_str())
    });
    let rate = text.contains("rev/min").then(|| "rev/min".to_owned());
    found.chain(rate).collect()
}

#[test]
fn units_of_files_stay_at_the_doors() {
    let mut wrong = Vec::new();
    let mut excused = 0;
    for (name, text) in shipped() {
        if room(&name).is_none_or(|room| FACES.contains(&room)) {
            continue;
        }
        let units = units_of_files(&text);
        let reason = UNITS_ELSEWHERE.iter().find(|(file, _)| *file == name);
        match (units.is_empty(), reason) {
            (false, None) => wrong.push(format!("{name}: {}", units.join(", "))),
            (true, Some(_)) => wrong.push(format!("{name} needs no exception")),
            (false, Some(_)) => excused += 1,
            (true, None) => {}
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(excused, UNITS_ELSEWHERE.len(), "an exception names no file");
}

#[test]
fn every_room_opens_with_in_out_absent_equations() {
    let mut rooms = 0;
    for path in files("src", &[".rs"]) {
        let name = name(&path);
        let entrance = name.ends_with("/mod.rs") && name.matches('/').count() == 2;
        if !(entrance || room(&name).is_some() && name.matches('/').count() == 1) {
            continue;
        }
        rooms += 1;
        let text = read(&path);
        let head: Vec<&str> = text.lines().take_while(|l| l.starts_with("//!")).take(8).collect();
        let head = head.join("\n");
        let mut from = 0;
        for word in ["In:", "Out:", "Absent:", "Equations:"] {
            let at = head[from..].find(word);
            assert!(at.is_some(), "{name}: the first lines lack {word}");
            from += at.unwrap_or(0);
        }
    }
    assert!(rooms > 12);
}

#[test]
fn a_public_type_has_a_name_of_its_own() {
    let mut homes: std::collections::BTreeMap<String, Vec<String>> = std::collections::BTreeMap::new();
    for (file, text) in shipped() {
        for line in text.lines() {
            let kinds = ["struct", "enum", "trait", "type", "union"];
            let Some(rest) =
                kinds.iter().find_map(|kind| line.trim_start().strip_prefix(&format!("pub {kind} ")))
            else {
                continue;
            };
            let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
            homes.entry(rest[..end].to_owned()).or_default().push(file.clone());
        }
    }
    assert!(homes.len() > 300, "only {} types found: the scan is broken", homes.len());
    let excused = |name: &str| SHARED_NAMES.iter().any(|(shared, _)| *shared == name);
    for (name, files) in &homes {
        assert!(files.len() == 1 || excused(name), "{name} stands in {}", files.join(", "));
        assert!(files.len() > 1 || !excused(name), "{name} needs no exception");
    }
}

#[test]
fn the_library_names_no_option_of_the_command() {
    let excused = |file: &str| OPTIONS_ELSEWHERE.iter().any(|(path, _)| *path == file);
    let is_option = |line: &str, at: usize| {
        // A colour of CSS is `var(--name)`.
        !line[..at].ends_with("var(") && line[at + 2..].starts_with(|c: char| c.is_ascii_lowercase())
    };
    let mut found = Vec::new();
    for (file, text) in shipped() {
        let names = |l: &str| l.contains("Ctrl-C") || l.match_indices("--").any(|(at, _)| is_option(l, at));
        let named = text.lines().any(names);
        if named && room(&file).is_some_and(|room| !HAVE_OPTIONS.contains(&room)) {
            found.push(file);
        }
    }
    assert!(found.iter().all(|file| excused(file)), "{found:?}");
    assert_eq!(found.len(), OPTIONS_ELSEWHERE.len(), "an exception names no file");
}

#[test]
fn no_file_is_long() {
    for folder in ["src", "tests", "benches"] {
        for path in files(folder, &[".rs"]) {
            let lines = read(&path).lines().count();
            assert!(lines <= LONGEST, "{}: {lines} lines, more than {LONGEST}", name(&path));
        }
    }
}

#[test]
fn nothing_names_a_place_outside() {
    // Put together here, so that this file does not name them either.
    let places = [["..", "/shared"].concat(), ["/wo", "rk/"].concat(), ["/ho", "me/"].concat()];
    let endings = [
        ".rs", ".toml", ".md", ".csv", ".json", ".svg", ".html", ".css", ".lock", ".yml", ".sh", "run",
        "MIT", "APACHE",
    ];
    let all = files("", &endings);
    assert!(all.len() > 60, "{}", all.len());
    for path in all {
        let Ok(text) = fs::read_to_string(&path) else { continue };
        for place in &places {
            assert!(!text.contains(place.as_str()), "{} names {place}", name(&path));
        }
    }
}

/// What is set for a release in a manifest, without comments.
fn release(manifest: &str) -> Vec<String> {
    let text = read(&root().join(manifest));
    let mut inside = false;
    let lines = text.lines().map(str::trim).filter(|l| !l.is_empty() && !l.starts_with('#'));
    lines
        .filter(|line| {
            if line.starts_with('[') {
                inside = line.starts_with("[profile.release");
            }
            inside
        })
        .map(str::to_owned)
        .collect()
}

/// A dependency that is built for another profile, be it by a flag, is built again: minutes for each of them.
#[test]
fn what_is_built_beside_the_tool_is_built_like_it() {
    let own = release("Cargo.toml");
    assert!(own.len() > 5 && own.contains(&"strip = true".to_owned()), "{own:?}");
    // What it does not build it cannot set.
    let lock = read(&root().join("peers/Cargo.lock"));
    let builds = |line: &&String| match line.split_once(" = { opt-level") {
        Some((package, _)) => lock.contains(&format!("name = \"{package}\"\n")),
        None => true,
    };
    let wanted: Vec<&String> = own.iter().filter(builds).collect();
    assert_eq!(release("peers/Cargo.toml").iter().collect::<Vec<_>>(), wanted);
}

/// Rows of the register's table under `heading`, cell by cell.
fn rows(heading: &str) -> Vec<Vec<String>> {
    let text = read(&root().join("src/equations.md"));
    let part = text.split("\n# ").find(|part| part.starts_with(heading)).expect("heading");
    part.lines()
        .filter(|l| l.starts_with("| ("))
        .map(|l| l.trim_matches('|').split(" | ").map(|cell| cell.trim().to_owned()).collect())
        .collect()
}

/// Fails unless the cell `` `file` `test` `` names a test that exists.
fn assert_oracle(equation: &str, cell: &str) {
    let named: Vec<&str> = cell.split('`').skip(1).step_by(2).collect();
    let [file, test] = named[..] else { panic!("{equation}: `file` `test` expected, not {cell}") };
    let text = read(&root().join(file));
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let declared = lines.iter().position(|l| l.starts_with(&format!("fn {test}()")));
    let at = declared.unwrap_or_else(|| panic!("{equation}: {file} has no test {test}"));
    assert!(lines[..at].iter().rev().take(3).any(|l| *l == "#[test]"), "{equation}: {test} is no test");
    assert!(
        !lines[..at].iter().rev().take(3).any(|l| l.starts_with("#[ignore")),
        "{equation}: {test} never runs"
    );
}

#[test]
fn every_equation_has_one_row_and_an_oracle() {
    let rows = rows("Equations");
    let listed: Vec<&String> = rows.iter().map(|row| &row[0]).collect();
    assert_eq!(listed, numbers().iter().collect::<Vec<_>>());
    for row in &rows {
        assert_eq!(row.len(), 5, "{row:?}");
        assert!(row[3].contains("](crate::"), "{}: the function is no link", row[0]);
        assert_oracle(&row[0], &row[4]);
    }
}

#[test]
fn every_misprint_is_decided_by_a_test() {
    let rows = rows("Misprints");
    assert!(rows.len() >= 16);
    for row in &rows {
        assert_eq!(row.len(), 4, "{row:?}");
        assert!(numbers().contains(&row[0]), "{row:?}");
        assert_oracle(&row[0], &row[3]);
    }
}

#[test]
fn every_equation_has_its_home() {
    let sources: Vec<(String, String)> =
        files("src", &[".rs"]).iter().map(|path| (name(path), read(path))).collect();
    for number in numbers() {
        let alias = format!("#[doc(alias = \"Eq. {number}\")]");
        let mut homes = Vec::new();
        for (name, text) in &sources {
            let lines: Vec<&str> = text.lines().map(str::trim).collect();
            for at in (0..lines.len()).filter(|&at| lines[at] == alias) {
                let above =
                    lines[..at].iter().rev().take_while(|l| l.starts_with("///") || l.starts_with("#["));
                let said =
                    above.clone().any(|l| l.starts_with("///") && l.contains(&format!("Eq. {number}")));
                assert!(said, "{name}: the home of {number} does not say /// Eq. {number}");
                homes.push(name.clone());
            }
        }
        // Two for (9), which has two lines in use, and for (11), kept in its printed form beside the corrected one.
        let most = if ["(9)", "(11)"].contains(&number.as_str()) { 2 } else { 1 };
        assert!((1..=most).contains(&homes.len()), "{number}: homes {homes:?}");
    }
}

#[test]
fn every_equation_is_asked_by_what_ships() {
    let shipped = shipped();
    for (file, text) in &shipped {
        let lines: Vec<&str> = text.lines().map(str::trim).collect();
        for (at, line) in
            lines.iter().enumerate().filter(|(_, line)| line.starts_with("#[doc(alias = \"Eq. "))
        {
            let home = lines[at..].iter().find(|l| !l.is_empty() && !l.starts_with("#[")).expect("home");
            let function = home.split_once("fn ").map(|(_, rest)| rest);
            let rest = function.or(home.strip_prefix("pub ")).unwrap_or_else(|| panic!("{file}: {home}"));
            let word = &rest[..rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len())];
            let asked = |text: &str| match function {
                Some(_) => {
                    text.matches(&format!("{word}(")).count() - text.matches(&format!("fn {word}(")).count()
                }
                None => text.matches(&format!(".{word}")).count(),
            };
            assert!(shipped.iter().any(|(_, text)| asked(text) > 0), "{line}: nobody asks {word} of {file}");
        }
    }
}

#[test]
fn what_is_promised_is_what_is_run() {
    let (readme, ci) = (read(&root().join("README.md")), read(&root().join(".ci/run")));
    let manifest = read(&root().join("Cargo.toml"));
    let entry = |key: &str| {
        let line = manifest.lines().find(|l| l.starts_with(&format!("{key} = "))).expect("key");
        line.split('"').nth(1).expect("value").to_owned()
    };
    assert!(readme.contains("cargo test --release\n"));
    // With what the other two packages have of tests, and without linking the examples.
    for targets in ["--tests", "--doc"] {
        assert!(ci.contains(&format!("cargo test --release --workspace {targets}\n")), "{targets}");
    }
    assert!(readme.contains(&format!("Rust {}", entry("rust-version"))), "minimum Rust version");
    let changelog = read(&root().join("CHANGELOG.md"));
    assert!(changelog.contains(&format!("[{}]", entry("version"))), "version");
}
