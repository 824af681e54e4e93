//! `export` of drawings, solids and tables from outside: what it writes, says and refuses.

use crate::program::{Folder, json, run, stdout};

#[test]
fn the_command_writes_says_and_refuses() {
    let folder = Folder::new();
    let design = "designs/starter.toml";
    for (format, ending) in [("dxf", "dxf"), ("step", "stp"), ("svg", "svg"), ("csv", "csv")] {
        for part in ["sprag", "inner", "outer", "clutch"] {
            let to = folder.path(&format!("{part}.{ending}"));
            let args = ["export", design, "--format", format, "--part", part, "-o", &to, "--json"];
            let answer = json(&run(&args));
            assert_eq!((answer["format"].as_str(), answer["part"].as_str()), (Some(format), Some(part)));
            let bytes = std::fs::read(&to).unwrap();
            assert_eq!(answer["bytes"].as_u64(), Some(bytes.len() as u64));
            // Its own file is replaced, with the same bytes.
            assert_eq!(run(&args).status.code(), Some(0));
            assert_eq!(std::fs::read(&to).unwrap(), bytes);
            let printed = run(&["export", design, "--format", format, "--part", part, "--quiet"]);
            assert_eq!(printed.stdout, bytes);
        }
    }
    let refused = |args: &[&str], code: i32, words: &[&str]| {
        let output = run(&[&["export"], args].concat());
        let text = String::from_utf8(output.stderr.clone()).unwrap().replace('│', " ");
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(output.status.code(), Some(code), "{args:?}: {text}");
        assert!(words.iter().all(|w| text.contains(w)), "{args:?}: {text}");
        // With --json the refusal is an object.
        assert_eq!(stdout(&output).is_empty(), !args.contains(&"--json"), "{args:?}");
    };
    let foreign = folder.path("theirs.dxf");
    std::fs::write(&foreign, "  0\nSECTION\n  2\nENTITIES\n").unwrap();
    refused(&[design, "--format", "dxf", "-o", &foreign], 2, &["no DXF drawing", "--force"]);
    refused(&[design, "--format", "dxf", "-o", &folder.path("a.step")], 2, &[".dxf"]);
    refused(&[design, "--format", "dxf", "--torque", "3"], 2, &["--torque", "calculix"]);
    refused(&[design, "--format", "calculix", "--part", "sprag"], 2, &["--part", "dxf"]);
    refused(&[design, "--format", "dxf", "--table", "points"], 2, &["--table", "csv"]);
    refused(&[design, "--format", "csv", "--deviation-mm", "0.1"], 2, &["--table points"]);
    refused(&[design, "--format", "dxf", "--json"], 2, &["-o"]);
    for deviation in ["0", "-1", "nan", "inf", "1e-9"] {
        let args = [design, "--format", "csv", "--table", "points", "--deviation-mm", deviation];
        refused(&args, 2, &["deviation-mm"]);
    }

    // No flanks and no width: what is open is said, with flanks that would do; what needs no outline is written.
    let open = folder.changed("designs/huang2017-multi-arc.toml", &[("width_mm = 5.05 ", "width_mm = 0.0 ")]);
    for format in ["dxf", "svg", "step"] {
        refused(&[&open, "--format", format], 2, &["is open", "sprags.flanks", "rear_mm = ", "optimize"]);
    }
    refused(&[&open, "--format", "csv", "--table", "points"], 2, &["is open"]);
    let arcs = stdout(&run(&["export", &open, "--format", "csv"]));
    assert_eq!(arcs.lines().count(), 5, "{arcs}");
    assert!(arcs.contains("sprag,inner arc 3,arc,") && arcs.contains("sprag,outer arc,arc,0,0,4.68,,,"));
    assert_eq!(
        run(&["export", &open, "--format", "dxf", "--part", "outer", "--quiet"]).status.code(),
        Some(0)
    );
    let note =
        run(&["export", "designs/huang2017-multi-arc.toml", "--format", "dxf", "-o", &folder.path("m.dxf")]);
    assert!(String::from_utf8(note.stderr).unwrap().contains("+3.4 %"));
}
