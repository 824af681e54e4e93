//! The README's picture is what the tool draws of the README's design, today.
//!
//! Remake it with `REMAKE=1 cargo test -r the_picture` (no long flags: an XML comment holds no double hyphen).

use sprag_design::cli::parts::{drawing, pose_at_rest, pose_at_torque};
use sprag_design::{Design, WedgeCurve};
use std::path::Path;

const DESIGN: &str = "designs/huang2017-multi-arc.toml";
const PICTURE: &str = "reports/sprag.svg";

fn draw() -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let design = Design::read(&root.join(DESIGN)).unwrap();
    let profile = design.clutch.profile().unwrap();
    let curve = WedgeCurve::build(&design.clutch, &profile, 0.0).unwrap();
    let rest = pose_at_rest("first contact", &design, &profile);
    let loaded = pose_at_torque(&rest, &curve, 110.0).unwrap();
    // White behind: a reader's page may be dark.
    let svg = drawing(&design, vec![rest, loaded]).detail_svg().replacen(
        "<svg ",
        "<svg style=\"background:#fff\" ",
        1,
    );
    format!(
        "<!-- sprag-design {}, {DESIGN} (sha256 {}), made by: REMAKE=1 cargo test -r the_picture -->\n{svg}\n",
        env!("CARGO_PKG_VERSION"),
        design.hash
    )
}

#[test]
fn the_picture_is_what_the_tool_draws() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(PICTURE);
    let now = draw();
    if std::env::var_os("REMAKE").is_some() {
        std::fs::write(&path, &now).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap();
    assert!(kept == now, "{PICTURE} is out of date: REMAKE=1 cargo test -r the_picture");
}
