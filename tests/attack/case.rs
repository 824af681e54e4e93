//! A case: files, a command line and what was done to them, all from one number.

mod commands;

use super::mutate;
use fastrand::Rng;
use std::time::Duration;
use toml_edit::{DocumentMut, Item, value};

/// Longest scene that is run, s.
const LONGEST_S: f64 = 0.03;
/// A file that is nobody's business.
pub const FOREIGN: (&str, &[u8]) = ("letter.txt", b"Dear Sir,\nK\xe4fig, signed\nno line end");

pub struct Case {
    /// Files in the folder before any command.
    pub files: Vec<(String, Vec<u8>)>,
    /// A command that runs first, such as the search that leaves a journal.
    pub prepare: Vec<String>,
    /// Files that `prepare` made, and what is done to them.
    pub spoil: Vec<(&'static str, Rng)>,
    pub args: Vec<String>,
    /// Standard input.
    pub input: Vec<u8>,
    /// Ctrl-C after so long.
    pub interrupt: Option<Duration>,
    /// Files that the command may write: their paths, or how those begin.
    pub outputs: Vec<String>,
    /// Whether nothing is wrong with the command line, so that a refusal is one of a file.
    pub plain_flags: bool,
    /// Whether the answer is the same for every number of threads.
    pub repeats: bool,
    /// How many mutations there were to make, those left out included.
    pub mutations: u32,
}

impl Case {
    /// The case `seed`; bit n of `without` leaves mutation n out.
    pub fn new(seed: u64, without: u32) -> Self {
        let case = Self {
            files: Vec::new(),
            prepare: Vec::new(),
            spoil: Vec::new(),
            args: Vec::new(),
            input: Vec::new(),
            interrupt: None,
            outputs: Vec::new(),
            plain_flags: true,
            repeats: true,
            mutations: 0,
        };
        let mut maker = Maker { case, rng: Rng::with_seed(seed), seed, without };
        maker.make();
        maker.case
    }

    pub fn has(&self, flag: &str) -> bool {
        self.args.iter().any(|arg| arg == flag)
    }

    pub fn command(&self) -> &str {
        &self.args[0]
    }

    /// As a shell takes it.
    pub fn command_line(&self) -> String {
        let quoted = |args: &[String]| -> String {
            args.iter().map(|arg| format!(" '{}'", arg.replace('\'', "'\\''"))).collect()
        };
        let first = if self.prepare.is_empty() {
            String::new()
        } else {
            format!("sprag-design{}; spoil {:?}; ", quoted(&self.prepare), self.spoil)
        };
        let input = if self.input.is_empty() { "" } else { " <input" };
        let stop = self.interrupt.map_or(String::new(), |after| format!(" and SIGINT after {after:?}"));
        format!("{first}sprag-design{}{input}{stop}", quoted(&self.args))
    }
}

struct Maker {
    case: Case,
    rng: Rng,
    seed: u64,
    without: u32,
}

impl Maker {
    /// The generator of the next mutation, unless it is left out. Each has its own, so that leaving one out changes no other.
    fn strike(&mut self) -> Option<Rng> {
        let number = self.case.mutations;
        self.case.mutations += 1;
        let rng = Rng::with_seed(self.seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ u64::from(number));
        (self.without >> number & 1 == 0).then_some(rng)
    }

    /// True once in `n` cases.
    fn once_in(&mut self, n: u32) -> bool {
        self.rng.u32(..n) == 0
    }

    fn one(&mut self, list: &[&str]) -> String {
        mutate::one(list, &mut self.rng).to_owned()
    }

    fn flag(&mut self, flag: &str, value: impl Into<String>) {
        let mut value = value.into();
        if self.once_in(30)
            && let Some(mut rng) = self.strike()
        {
            value = mutate::word(&mut rng);
            self.case.plain_flags = false;
        }
        self.case.args.extend([flag.to_owned(), value]);
    }

    /// The flag with one of the values, once in `n` cases.
    fn maybe(&mut self, n: u32, flag: &str, values: &[&str]) {
        if self.once_in(n) {
            let value = self.one(values);
            self.flag(flag, value);
        }
    }

    fn switch(&mut self, n: u32, flag: &str) {
        if self.once_in(n) {
            self.case.args.push(flag.to_owned());
        }
    }

    fn file(&mut self, name: &str, bytes: Vec<u8>) {
        self.case.files.push((name.to_owned(), bytes));
    }

    /// Where to write; rarely where something foreign is.
    fn output(&mut self, flag: &str, name: &str) {
        let path = match self.rng.u8(..80) {
            0 => FOREIGN.0.to_owned(),
            1 => format!("sub/{name}"),
            2 => format!("no-such/{name}"),
            3 => "design.toml".to_owned(),
            4 => "sub".to_owned(),
            _ => name.to_owned(),
        };
        self.case.plain_flags &= path == name;
        self.case.args.extend([flag.to_owned(), path.clone()]);
        let stem = path.rsplit_once('.').map_or(path.as_str(), |(stem, _)| stem);
        if path != FOREIGN.0 && path != "design.toml" {
            self.case.outputs.push(stem.to_owned());
        }
    }

    fn make(&mut self) {
        self.file(FOREIGN.0, FOREIGN.1.to_vec());
        let command = self.one(&[
            "check",
            "check",
            "stiffness",
            "stiffness",
            "simulate",
            "simulate",
            "simulate",
            "optimize",
            "optimize",
            "identify",
            "size",
            "export",
            "evaluate",
        ]);
        self.case.args.push(command.clone());
        let design = self.design(&command);
        let scenes = scenarios(&design);
        self.file("design.toml", design.into_bytes());
        if command != "size" {
            let path = if self.once_in(60) {
                self.one(&["no-such.toml", "sub", "letter.txt", "data.csv"])
            } else {
                "design.toml".into()
            };
            self.case.args.push(path);
        }
        match command.as_str() {
            "check" => {
                if self.once_in(4) {
                    self.output("--overrun-csv", "overrun.csv");
                }
            }
            "stiffness" => self.stiffness(),
            "simulate" => self.simulate(&scenes),
            "optimize" => self.optimize(),
            "identify" => self.identify(),
            "size" => self.size(),
            "export" => self.export(),
            _ => self.evaluate(),
        }
        // A deck and the lines of `evaluate` are neither JSON nor table nor page; once in a while they are asked for all the same.
        let rarely = if ["export", "evaluate"].contains(&command.as_str()) { 20 } else { 1 };
        let plain = self.case.plain_flags;
        if self.once_in(2 * rarely) {
            self.case.args.push("--json".into());
        }
        if self.once_in(3 * rarely) {
            self.output("--csv", "out.csv");
        }
        if self.once_in(3 * rarely) {
            self.output("--report", "out.html");
        }
        self.case.plain_flags &= plain && rarely == 1;
        self.switch(3, "--quiet");
        if self.once_in(30)
            && let Some(mut rng) = self.strike()
        {
            let at = rng.usize(1..=self.case.args.len());
            self.case.args.insert(at, mutate::word(&mut rng));
            self.case.plain_flags = false;
        }
        if self.once_in(12)
            && let Some(mut rng) = self.strike()
        {
            self.case.interrupt = Some(Duration::from_millis(rng.u64(1..300)));
            self.case.repeats = false;
        }
    }

    /// One of the designs at hand, its scenes cut short, mutated; with its histories.
    fn design(&mut self, command: &str) -> String {
        // The first five have an [optimize] table.
        const DESIGNS: &[&str] = &[
            "designs/huang2017-multi-arc.toml",
            "designs/huang2017-multi-arc.toml",
            "tests/optimise/designs/a-huang-at-rest.toml",
            "tests/optimise/designs/b-huang-at-speed.toml",
            "tests/optimise/designs/c-24-sprags.toml",
            "designs/huang2017-bench.toml",
            "designs/huang2017-bench.toml",
            "designs/huang2017-single-arc.toml",
            "designs/fe-check-24.toml",
            "designs/indexing.toml",
            "designs/series-833-large.toml",
            "designs/starter.toml",
        ];
        // What a search or `evaluate` cannot do without.
        let searched = ["optimize", "evaluate"].contains(&command) && !self.once_in(30);
        let path = self.one(if searched { &DESIGNS[..5] } else { DESIGNS });
        let mut text = shortened(&read(&path));
        if text.contains("_csv") {
            for name in ["engaging-in-and-out.csv", "overrunning-torque.csv", "speed-ramp.csv"] {
                let mut bytes = read(&format!("designs/{name}")).into_bytes();
                if self.once_in(3)
                    && let Some(mut rng) = self.strike()
                {
                    bytes = mutate::table(&String::from_utf8_lossy(&bytes), &mut rng);
                }
                self.file(name, bytes);
            }
        }
        let mild = self.once_in(2);
        for _ in 0..[0, 1, 1, 1, 1, 2, 2, 4][self.rng.usize(..8)] {
            if let Some(mut rng) = self.strike() {
                text = mutate::design(&text, mild, &mut rng);
            }
        }
        text
    }
}

fn read(path: &str) -> String {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The design with scenes of at most [`LONGEST_S`].
fn shortened(text: &str) -> String {
    let mut file: DocumentMut = text.parse().unwrap();
    if let Some(scenes) = file.get_mut("scenarios").and_then(Item::as_array_of_tables_mut) {
        for scene in scenes.iter_mut() {
            let long = scene.get("duration_s").and_then(Item::as_float).is_some_and(|d| d > LONGEST_S);
            if long {
                scene["duration_s"] = value(LONGEST_S);
            }
        }
    }
    file.to_string()
}

/// Names of the scenes that a design has, as far as it can be read.
fn scenarios(text: &str) -> Vec<String> {
    let Ok(file) = text.parse::<DocumentMut>() else { return Vec::new() };
    let scenes = file.get("scenarios").and_then(Item::as_array_of_tables);
    let names =
        scenes.into_iter().flatten().filter_map(|scene| scene.get("name")?.as_str().map(str::to_owned));
    // What a shell or a system cannot pass on as an argument is no name to ask for.
    names.filter(|name| !name.contains('\0')).collect()
}
