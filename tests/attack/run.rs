//! The program run in a folder of its own, within bounds of processor time and memory.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Most processor time of a run, s, and most address space, kB. Processor time, so that a busy machine changes nothing.
const LIMITS: &str = "ulimit -t 60; ulimit -v 2097152; ulimit -c 0; exec \"$0\" \"$@\"";
/// A run that uses no processor time and does not end is waiting for something that does not come.
const PATIENCE: Duration = Duration::from_secs(600);

/// The program under attack.
pub struct Program {
    path: PathBuf,
    /// How many runs of a command ended with a code.
    ends: Mutex<BTreeMap<(String, Option<i32>), usize>>,
}

/// How a run ended.
pub struct Ran {
    pub code: Option<i32>,
    pub signal: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl Program {
    pub fn new(path: &str) -> Self {
        let path = fs::canonicalize(path).unwrap_or_else(|e| panic!("{path}: {e}"));
        Self { path, ends: Mutex::default() }
    }

    /// How many runs of a command ended with a code.
    pub fn ends(&self) -> BTreeMap<(String, Option<i32>), usize> {
        self.ends.lock().unwrap().clone()
    }

    /// Run with `args` in `folder`, `input` on standard input; Ctrl-C after `interrupt`.
    pub fn run(&self, folder: &Path, args: &[String], input: &[u8], mut interrupt: Option<Duration>) -> Ran {
        let streams = Folder::new();
        let [input_path, out, err] = ["in", "out", "err"].map(|name| streams.path().join(name));
        fs::write(&input_path, input).unwrap();
        let mut child = Command::new("sh")
            .args(["-c", LIMITS])
            .arg(&self.path)
            .args(args)
            .current_dir(folder)
            .env("NO_COLOR", "1")
            .stdin(File::open(input_path).unwrap())
            .stdout(Stdio::from(File::create(&out).unwrap()))
            .stderr(Stdio::from(File::create(&err).unwrap()))
            .spawn()
            .unwrap();
        let began = Instant::now();
        let status = loop {
            if let Some(status) = child.try_wait().unwrap() {
                break status;
            }
            if began.elapsed() > PATIENCE {
                child.kill().unwrap();
            }
            if interrupt.take_if(|after| began.elapsed() > *after).is_some() {
                Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
            }
            std::thread::sleep(Duration::from_millis(2));
        };
        let text = |path| String::from_utf8_lossy(&fs::read(path).unwrap()).into_owned();
        *self.ends.lock().unwrap().entry((args[0].clone(), status.code())).or_default() += 1;
        Ran { code: status.code(), signal: status.signal(), stdout: text(out), stderr: text(err) }
    }
}

/// A scratch folder, removed at the end.
pub struct Folder(PathBuf);

impl Folder {
    pub fn new() -> Self {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("sprag-design-attack-{}-{number}", std::process::id()));
        fs::create_dir(&path).unwrap();
        Self(path)
    }

    pub fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Every file of a folder, by its path from there.
#[derive(PartialEq, Eq)]
pub struct Files(pub BTreeMap<String, Vec<u8>>);

impl Files {
    pub fn of(folder: &Path) -> Self {
        let mut files = BTreeMap::new();
        let mut open = vec![folder.to_path_buf()];
        while let Some(here) = open.pop() {
            for entry in fs::read_dir(&here).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    open.push(path);
                } else {
                    let name = path.strip_prefix(folder).unwrap().to_string_lossy().into_owned();
                    files.insert(name, fs::read(path).unwrap());
                }
            }
        }
        Self(files)
    }

    /// Write files into a folder; a subfolder `sub` is there too.
    pub fn write(folder: &Path, files: &[(String, Vec<u8>)]) {
        fs::create_dir_all(folder.join("sub")).unwrap();
        for (name, bytes) in files {
            fs::write(folder.join(name), bytes).unwrap();
        }
    }
}
