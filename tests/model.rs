//! The name of what computes, which journals carry, follows the sources by itself.

#[path = "../build.rs"]
mod build;

use std::path::{Path, PathBuf};

fn copied(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap().flatten() {
        let (path, there) = (entry.path(), to.join(entry.file_name()));
        if path.is_dir() {
            copied(&path, &there);
        } else {
            std::fs::copy(&path, &there).unwrap();
        }
    }
}

#[test]
fn a_changed_law_is_another_model_and_a_changed_page_is_not() {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let here = build::model(&root);
    assert!(sprag_design::cli::journal::model().ends_with(&here));
    let folder = std::env::temp_dir().join(format!("sprag-model-{}", std::process::id()));
    copied(&root.join("src"), &folder.join("src"));
    std::fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    assert_eq!(build::model(&folder), here);
    let change = |name: &str| {
        let path = folder.join(name);
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, text.clone() + "\n").unwrap();
        let changed = build::model(&folder) != here;
        std::fs::write(&path, text).unwrap();
        changed
    };
    for law in [
        "src/wedge/closure.rs",
        "src/numeric/root.rs",
        "src/material.rs",
        "src/margin/sprag.rs",
        "Cargo.lock",
    ] {
        assert!(change(law), "{law}");
    }
    for page in ["src/cli/check.rs", "src/answer/mod.rs", "src/report/table.rs", "src/lib.rs"] {
        assert!(!change(page), "{page}");
    }
    std::fs::remove_dir_all(&folder).unwrap();
}
