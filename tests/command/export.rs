//! `export` from outside: what it writes, what it refuses, what it reads back.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const SINGLE: &str = "designs/huang2017-single-arc.toml";

fn run(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_sprag-design")).env("NO_COLOR", "1").args(args).output().unwrap()
}

fn code(args: &[&str]) -> (Option<i32>, String) {
    let output = run(args);
    // Messages are wrapped to the terminal.
    let text = String::from_utf8(output.stderr).unwrap().replace('│', " ");
    (output.status.code(), text.split_whitespace().collect::<Vec<_>>().join(" "))
}

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&path).unwrap();
    path
}

#[test]
fn other_formats_and_senseless_flags_are_refused_with_code_2() {
    for format in ["dwg", "iges", "stl"] {
        let (code, text) = code(&["export", SINGLE, "--format", format]);
        assert_eq!(code, Some(2));
        assert!(text.contains(format) && text.contains("calculix"), "{text}");
    }
    for (flags, word) in [
        (&["--torque", "1e6"][..], "the curve ends (off-profile)"),
        (&["--mesh", "1e-6"], "nodes"),
        (&["--mesh", "5"], "too near"),
        (&["--increments", "0"], "increments"),
        (&["--json"], "--read"),
        (&["--torques", "3"], "--read"),
        (&["--read", "no-such.dat"], "no-such.dat: the result"),
        (&["-o", SINGLE], "never overwritten"),
    ] {
        let (code, text) = code(&[&["export", SINGLE, "--format", "calculix"], flags].concat());
        assert_eq!(code, Some(2), "{flags:?}");
        assert!(text.contains(word), "{flags:?}: {text}");
    }
}

/// A library of a co-simulation unit is a cdylib of its own; to be packed it need only say whose it is.
#[test]
fn a_unit_holds_description_library_and_design() {
    let folder = folder("export-fmu");
    let (library, unit) = (folder.join("library.so"), folder.join("clutch.fmu"));
    let (library_arg, unit_arg) = (library.to_str().unwrap(), unit.to_str().unwrap());
    let ours =
        format!("\x7fELF sprag-design-fmu library {}; {}", env!("CARGO_PKG_VERSION"), "code ".repeat(1000));
    let export = |design: &str, more: &[&str]| {
        let args = ["export", design, "--format", "fmu", "--library", library_arg, "-o", unit_arg];
        code(&[&args[..], more].concat())
    };
    let refused = |design: &str, more: &[&str], words: &str| {
        let (code, text) = export(design, more);
        assert!(code == Some(2) && text.contains(words), "{words}: {code:?} {text}");
    };
    // What a run before has left.
    for path in [&library, &unit] {
        let _ = std::fs::remove_file(path);
    }
    // What helps: where it is, where not, how it is built, and what to say then.
    let (_, words) = export(SINGLE, &[]);
    // Lines end where the width has them end.
    let bare = |text: &str| text.split_whitespace().collect::<String>();
    for help in
        ["found no such file", "Python's wheel has not", "`fmu/build.sh`", "`--library target/release/"]
    {
        assert!(bare(&words).contains(&bare(help)), "{help}: {words}");
    }
    std::fs::write(&library, "sprag-design-fmu library 0.0.1;").unwrap();
    refused(SINGLE, &[], "found no library of sprag-design");
    std::fs::write(&library, &ours).unwrap();
    refused(SINGLE, &["--part", "clutch"], "--part has no meaning here");
    refused(SINGLE, &["--csv", "a.csv"], "--csv and --report have no meaning here");
    assert_eq!(code(&["export", SINGLE, "--format", "fmu"]).0, Some(2));
    assert_eq!(code(&["export", SINGLE, "--format", "dxf", "--fmi", "3"]).0, Some(2));
    // Shafts are never left out in silence.
    let starter = concat!(env!("CARGO_MANIFEST_DIR"), "/designs/starter-engine.toml");
    refused(starter, &[], "--clutch-alone leaves them out");
    let alone = [
        "export",
        starter,
        "--format",
        "fmu",
        "--library",
        library_arg,
        "-o",
        unit_arg,
        "--clutch-alone",
        "--json",
    ];
    let alone = run(&alone);
    let said = String::from_utf8(alone.stdout).unwrap();
    assert!(alone.status.success() && said.contains("left out as asked: armature, crank"), "{said}");
    std::fs::remove_file(&unit).unwrap();
    std::fs::write(&unit, "somebody else's").unwrap();
    refused(SINGLE, &[], "has written; name another file");
    std::fs::remove_file(&unit).unwrap();
    // A design whose scenes have histories takes them along.
    for (fmi, place, token) in [("2", "linux64", "guid="), ("3", "x86_64-linux", "instantiationToken=")] {
        if cfg!(not(all(target_os = "linux", target_arch = "x86_64"))) {
            continue;
        }
        assert_eq!(export("designs/huang2017-bench.toml", &["--fmi", fmi]).0, Some(0));
        let bytes = std::fs::read(&unit).unwrap();
        let archive = rawzip::ZipArchive::from_slice(&bytes).unwrap();
        let mut entries = archive.entries();
        let mut files = Vec::new();
        while let Some(entry) = entries.next_entry().unwrap() {
            let name = entry.file_path().try_normalize().unwrap().as_ref().to_owned();
            let packed = archive.get_entry(entry.wayfinder()).unwrap().data().to_vec();
            let stored = entry.compression_method() == rawzip::CompressionMethod::STORE;
            let content =
                if stored { packed } else { miniz_oxide::inflate::decompress_to_vec(&packed).unwrap() };
            assert_eq!(rawzip::crc32(&content), entry.crc32(), "{name}");
            files.push((name, content));
        }
        let content =
            |name: &str| &files.iter().find(|(n, _)| n == name).unwrap_or_else(|| panic!("{name}")).1;
        assert_eq!(files[0].0, "modelDescription.xml");
        let about = String::from_utf8(files[0].1.clone()).unwrap();
        assert!(about.contains(token) && about.contains("name=\"friction.static\""), "{about}");
        assert_eq!(content(&format!("binaries/{place}/sprag_clutch.so")), ours.as_bytes());
        assert_eq!(content("resources/design.toml"), &std::fs::read("designs/huang2017-bench.toml").unwrap());
        let history = "engaging-in-and-out.csv";
        assert_eq!(
            content(&format!("resources/{history}")),
            &std::fs::read(format!("designs/{history}")).unwrap()
        );
    }
}

#[test]
fn a_result_is_read_beside_its_deck_and_no_other() {
    let folder = folder("export-read");
    let (deck, dat) = (folder.join("s.inp"), folder.join("s.dat"));
    let (deck_arg, dat_arg) = (deck.to_str().unwrap(), dat.to_str().unwrap());
    let made = run(&[
        "export",
        SINGLE,
        "--format",
        "calculix",
        "--variant",
        "plane-strain",
        "--torque",
        "26.8",
        "-o",
        deck_arg,
    ]);
    assert_eq!(made.status.code(), Some(0));
    // Three increments of that very deck's result.
    std::fs::copy("tests/reference/calculix_excerpt.dat", &dat).unwrap();
    let read =
        run(&["export", SINGLE, "--format", "calculix", "--read", dat_arg, "--torques", "16.8,50", "--json"]);
    assert_eq!(read.status.code(), Some(0));
    let said = String::from_utf8(read.stderr).unwrap();
    assert!(
        said.contains("50 Nm lies outside") && said.contains("the last increments are missing"),
        "{said}"
    );
    let json: serde_json::Value = serde_json::from_slice(&read.stdout).unwrap();
    let points = json["points"].as_array().unwrap();
    assert_eq!(points.len(), 1);
    assert!((points[0]["windup_deg"].as_f64().unwrap() / 1.6407 - 1.0).abs() < 3e-3, "{json}");
    assert_eq!(json["variant"], "plane-strain");
    assert!((json["turned"].as_f64().unwrap() - 0.5625).abs() < 1e-6, "{json}");
    // Torsion of both races as long as the sprag, G = 206/2.6 GPa: 16.8/(4 pi G l) of (1/7.21^2 - 1/11.11^2) and
    // (1/19.44^2 - 1/26.23^2) per mm^2.
    let twist_deg = points[0]["races_twist_deg"].as_f64().unwrap();
    let by_hand = 16.8e3 / (4.0 * std::f64::consts::PI * 206e3 / 2.6 * 6.0) * (1.1135e-2 + 1.1926e-3);
    assert!((twist_deg.to_radians() / by_hand - 1.0).abs() < 1e-3, "{twist_deg}");

    let (code, text) =
        code(&["export", "designs/huang2017-multi-arc.toml", "--format", "calculix", "--read", dat_arg]);
    assert_eq!(code, Some(2));
    assert!(text.contains("another design"), "{text}");
}

/// Flanks of a first design stand close to its profile: the contacts come within a few columns of them.
#[test]
fn a_sized_clutch_has_a_deck_up_to_a_torque_that_is_named() {
    let folder = folder("export-sized");
    for (bore, torque) in [("10", "20"), ("40", "1000"), ("120", "20000")] {
        let file = folder.join(format!("sized-{bore}.toml"));
        let file = file.to_str().unwrap();
        let made = run(&["size", "--bore", bore, "--torque", torque, "-o", file, "--force", "--quiet"]);
        assert_eq!(made.status.code(), Some(0));
        let nominal: f64 = torque.parse().unwrap();
        let deck =
            |torque: f64| code(&["export", file, "--format", "calculix", "--torque", &torque.to_string()]);
        assert_eq!(code(&["export", file, "--format", "calculix"]).0, Some(0));
        assert_eq!(deck(1.2 * nominal), (Some(0), String::new()));
        // Up to the end of the curve, or a lower torque that the refusal names.
        let (_, beyond) = deck(9.0 * nominal);
        let end = beyond
            .split("the curve ends (")
            .nth(1)
            .and_then(|t| t.split(" at ").nth(1))
            .and_then(|t| t.split(' ').next())
            .unwrap_or_else(|| panic!("{beyond}"));
        let last = 0.999 * end.parse::<f64>().unwrap();
        let (code, text) = deck(last);
        if code == Some(0) {
            continue;
        }
        assert_eq!(code, Some(2));
        let named = text
            .split("(--torque ")
            .nth(1)
            .and_then(|t| t.split(')').next())
            .unwrap_or_else(|| panic!("{text}"));
        let most: f64 = named.parse().unwrap();
        // What is in the way, by its name.
        assert!(text.contains("contact") && (text.contains(" flank") || text.contains(" sprag ")), "{text}");
        assert!(most > 1.2 * nominal && most < last, "{most}");
        assert_eq!(deck(most).0, Some(0));
        assert_eq!(deck(1.02 * most).0, Some(2));
    }
}
