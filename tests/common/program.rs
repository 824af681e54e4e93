//! The program run from outside, in a folder of its own.
#![allow(dead_code)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::atomic::{AtomicUsize, Ordering};

pub const MULTI: &str = "designs/huang2017-multi-arc.toml";
pub const SINGLE: &str = "designs/huang2017-single-arc.toml";

/// A folder for the outputs of one test, removed at the end.
pub struct Folder(PathBuf);

impl Folder {
    pub fn new() -> Self {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("sprag-design-cli-{}-{number}", std::process::id()));
        std::fs::create_dir(&path).unwrap();
        Self(path)
    }

    pub fn path(&self, name: &str) -> String {
        self.0.join(name).display().to_string()
    }

    /// A copy of the design at `source` with `from` replaced by `to`, which must occur.
    pub fn changed(&self, source: &str, changes: &[(&str, &str)]) -> String {
        let mut text = std::fs::read_to_string(source).unwrap();
        for (from, to) in changes {
            assert!(text.contains(from), "{from} in {source}");
            text = text.replace(from, to);
        }
        let path = self.path("changed.toml");
        std::fs::write(&path, text).unwrap();
        path
    }

    pub fn names(&self) -> Vec<String> {
        let name =
            |e: std::io::Result<std::fs::DirEntry>| e.unwrap().file_name().to_string_lossy().into_owned();
        let mut names: Vec<String> = std::fs::read_dir(&self.0).unwrap().map(name).collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

pub fn run(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_sprag-design")).args(args).env("NO_COLOR", "1").output().unwrap()
}

pub fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

/// Standard output as the one JSON object that it must be.
pub fn json(output: &Output) -> serde_json::Value {
    let text = stdout(output);
    assert_eq!(text.trim_end().lines().count(), 1, "{text}");
    serde_json::from_str(&text).unwrap()
}

/// The keys every object begins with.
pub fn has_envelope(value: &serde_json::Value) {
    assert_eq!(value["tool"], "sprag-design");
    assert_eq!(value["version"], env!("CARGO_PKG_VERSION"));
    assert!(value["design"].as_str().is_some_and(|d| d.starts_with("Huang")));
    assert_eq!(value["design_hash"].as_str().unwrap().len(), 64);
    assert!(value["run_time_s"].as_f64().unwrap() > 0.0);
    let left_out = value["left_out"].as_array().unwrap();
    for word in ["simultaneously", "same force", "concentric"] {
        assert!(left_out.iter().any(|e| e["why"].as_str().unwrap().contains(word)), "{word}");
    }
    assert!(left_out.iter().all(|e| !e["cost"].as_str().unwrap().is_empty()));
}

/// A page that needs nothing but itself.
pub fn is_self_contained(path: impl AsRef<Path>) -> String {
    let html = std::fs::read_to_string(path).unwrap();
    for bad in ["src=", "@import", "url(", "<link", "<script>", "onload", "NaN", "https:"] {
        assert!(!html.contains(bad), "{bad}");
    }
    // The name of the SVG language is no address that anything is fetched from.
    assert_eq!(html.matches("http:").count(), html.matches("xmlns=\"http://www.w3.org/2000/svg\"").count());
    assert!(html.trim_end().ends_with("</html>"));
    html
}
