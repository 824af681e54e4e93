//! Names what computes: a hash of the sources that a margin depends on, so that no number has to be kept by hand. A journal
//! of evaluations belongs to it.

use std::path::{Path, PathBuf};

/// Rooms of `src` without which a margin would be the same number.
const ANSWERS: [&str; 19] = [
    "accuracy",
    "answer",
    "cli",
    "compare",
    "element",
    "equations.md",
    "export",
    "feed",
    "identify",
    "import",
    "journal.rs",
    "lib.rs",
    "life",
    "main.rs",
    "reengage",
    "report",
    "size",
    "sprags",
    "studio",
];

#[allow(dead_code)]
fn main() {
    let root = PathBuf::from(std::env::var_os("CARGO_MANIFEST_DIR").expect("cargo names the folder"));
    println!("cargo:rerun-if-changed=src");
    println!("cargo:rerun-if-changed=Cargo.lock");
    println!("cargo:rustc-env=SPRAG_DESIGN_MODEL={}", model(&root));
}

/// 16 hex digits: FNV-1a, 64 bits, of every computing source below `root`, by name, and of the versions of all crates.
pub fn model(root: &Path) -> String {
    let mut sources = Vec::new();
    let mut open = vec![root.join("src")];
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder of sources").flatten() {
            let path = entry.path();
            let first = path.strip_prefix(root.join("src")).ok().and_then(|p| p.iter().next()?.to_str());
            match first {
                Some(room) if ANSWERS.contains(&room) => {}
                _ if path.is_dir() => open.push(path),
                _ if path.extension().is_some_and(|e| e == "rs") => sources.push(path),
                _ => {}
            }
        }
    }
    sources.sort();
    sources.push(root.join("Cargo.lock"));
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for path in sources {
        // As a package of its own the crate may come without a lock file.
        let text = std::fs::read(&path).unwrap_or_default();
        let name = path.strip_prefix(root).unwrap_or(&path).to_string_lossy().replace('\\', "/");
        // Line ends differ between systems and compute nothing.
        for byte in name.bytes().chain(text).filter(|b| *b != b'\r') {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
    format!("{hash:016x}")
}
