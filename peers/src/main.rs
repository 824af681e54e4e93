//! Integrators of others on the clutch's own right-hand side and events: error of theta_bi at the end over time and over
//! right-hand sides, beside our event method and the published scheme.
//!
//! `sh reports/accuracy_peers.sh` writes reports/accuracy-peers.html and reports/accuracy-peers.csv. Some minutes to build
//! (the peers bring their own linear algebra), some more to run.

mod clutch;
mod differential;
mod diffsol_peer;
mod page;
mod study;

use std::error::Error;
use std::path::Path;

use sprag_design::Design;
use sprag_design::report::PageHead;

const COMMAND: &str = "sh reports/accuracy_peers.sh";
const HTML: &str = "reports/accuracy-peers.html";
const CSV: &str = "reports/accuracy-peers.csv";
/// Design, scene, what it is.
const SCENES: [(&str, &str, &str); 5] = [
    ("designs/huang2017-multi-arc.toml", "high-6", "3.34 + 6 Nm, 100 Hz: sticks throughout"),
    ("designs/huang2017-multi-arc.toml", "low-10", "16.8 + 10 Nm, 100 Hz: sticks, passes from arc to arc"),
    ("designs/huang2017-multi-arc.toml", "high-10", "3.34 + 10 Nm, 100 Hz: slips and lifts off near N = 0"),
    ("designs/huang2017-bench.toml", "engagement", "overrun, a reversing torque, an elastic stop"),
    ("designs/huang2017-bench.toml", "in-and-out", "torque in, held, out, then overrun"),
];

/// The version of a package in a lock file or manifest.
fn version<'a>(text: &'a str, package: &str) -> &'a str {
    let from = text.find(&format!("name = \"{package}\"")).unwrap_or(0);
    text[from..].split("version = \"").nth(1).and_then(|t| t.split('"').next()).unwrap_or("unknown")
}

fn main() -> Result<(), Box<dyn Error>> {
    let lock = include_str!("../Cargo.lock");
    let peers = ["diffsol", "differential-equations"].map(|name| format!("{name} {}", version(lock, name)));
    let (mut scenes, mut designs) = (Vec::new(), Vec::<Design>::new());
    for (path, name, what) in SCENES {
        let design = Design::read(Path::new(path))?;
        let scenario = design.scenario(name).ok_or_else(|| format!("{path} has no scenario {name}"))?;
        scenes.push(study::scene(scenario, what)?);
        if designs.iter().all(|d| d.hash != design.hash) {
            designs.push(design);
        }
    }
    let joined = |of: fn(&Design) -> &str| designs.iter().map(of).collect::<Vec<_>>().join(" and ");
    let head = PageHead {
        title: "Accuracy beside integrators of others".into(),
        tool: "sprag-design".into(),
        version: version(include_str!("../../Cargo.toml"), "sprag-design").into(),
        command: COMMAND.into(),
        design: joined(|d| &d.name),
        design_hash: joined(|d| &d.hash),
    };
    let csv = page::csv(&head, &scenes)?;
    std::fs::write(HTML, page::page(head, &scenes, &peers, &designs).to_html())?;
    std::fs::write(CSV, csv)?;
    println!("{HTML}\n{CSV}");
    Ok(())
}
