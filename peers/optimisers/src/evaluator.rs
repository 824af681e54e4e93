//! `sprag-design evaluate` as a function that counts and remembers.

use std::collections::{HashMap, HashSet};
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde_json::Value;

/// What one point gives: each row must be 0 or more, the least objective is maximised.
#[derive(Debug, Clone)]
pub struct Rows {
    /// Objectives.
    pub objectives: Vec<f64>,
    /// Limits.
    pub limits: Vec<f64>,
    /// No limit violated.
    pub feasible: bool,
}

/// A process that evaluates, in the unit box of the variables' bounds.
pub struct Evaluator {
    process: Child,
    to: ChildStdin,
    from: BufReader<ChildStdout>,
    lo: Vec<f64>,
    hi: Vec<f64>,
    whole: Vec<bool>,
    /// Clutches that one answer looks at: a design whose name ends in -robust is held at every corner of its tolerances.
    pub each: usize,
    /// The file's values in the unit box.
    pub start: Vec<f64>,
    /// The same at each value of a whole number, outwards from the file's.
    pub by_value: Vec<Vec<f64>>,
    known: HashMap<Vec<u64>, Option<Rows>>,
    /// Evaluations of a clutch since the last [`Evaluator::forget`]; a point asked for twice counts once.
    pub count: usize,
    /// Best objective at a point that violates no limit.
    pub best: Option<f64>,
    /// Evaluations after which it was best, and its value.
    pub course: Vec<(usize, f64)>,
}

impl Evaluator {
    /// Start the tool on a design file.
    pub fn open(tool: &str, design: &str) -> Result<Self, String> {
        let mut process = Command::new(tool)
            .args(["evaluate", design, "--describe", "--quiet"])
            .args(design.ends_with("-robust.toml").then_some("--robust"))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|e| format!("{tool}: {e}"))?;
        let to = process.stdin.take().ok_or("no standard input")?;
        let mut from = BufReader::new(process.stdout.take().ok_or("no standard output")?);
        let about = line(&mut from)?;
        let column = |key: &str| -> Result<Vec<f64>, String> {
            let rows = about["variables"].as_array().ok_or("no variables")?;
            rows.iter().map(|v| v[key].as_f64().ok_or(format!("no {key}"))).collect()
        };
        let (lo, hi, start) = (column("min")?, column("max")?, column("start")?);
        let rows = about["variables"].as_array().ok_or("no variables")?;
        let whole: Vec<bool> = rows.iter().map(|v| v["whole"] == true).collect();
        let names = about["objectives"].as_array().ok_or("no objectives")?;
        let plain = |name: &Value| name.as_str().and_then(|n| n.split(" @ ").next()).map(str::to_owned);
        let different: HashSet<_> = names.iter().map(plain).collect();
        let each = names.len() / different.len().max(1);
        let share = |i: usize, x: f64| match whole[i] {
            true => (x - lo[i] + 0.5) / (hi[i] - lo[i] + 1.0),
            false => ((x - lo[i]) / (hi[i] - lo[i])).clamp(0.0, 1.0),
        };
        let shares = |x: &[f64]| x.iter().enumerate().map(|(i, x)| share(i, *x)).collect::<Vec<_>>();
        let first = shares(&start);
        // At each value of a whole number, outwards from the file's.
        let mut by_value = Vec::new();
        if let Some(at) = whole.iter().position(|w| *w) {
            let mut values: Vec<f64> = (0..=(hi[at] - lo[at]) as usize).map(|k| lo[at] + k as f64).collect();
            values
                .sort_by(|a, b| (a - start[at]).abs().total_cmp(&(b - start[at]).abs()).then(a.total_cmp(b)));
            by_value.extend(values.into_iter().map(|value| {
                let mut there = start.clone();
                there[at] = value;
                shares(&there)
            }));
        }
        let start = first;
        let known = HashMap::new();
        Ok(Self {
            process,
            to,
            from,
            lo,
            hi,
            whole,
            each,
            start,
            by_value,
            known,
            count: 0,
            best: None,
            course: Vec::new(),
        })
    }

    /// Count anew, with nothing known.
    pub fn forget(&mut self) {
        self.known.clear();
        (self.count, self.best) = (0, None);
        self.course.clear();
    }

    /// Margins at a point of the unit box, clipped to it; `None` where there is no clutch.
    pub fn at(&mut self, unit: &[f64]) -> Option<Rows> {
        let place = |(i, u): (usize, &f64)| {
            let (u, range) = (u.clamp(0.0, 1.0), self.hi[i] - self.lo[i]);
            // Of a whole number each value has an equal share of the unit.
            self.lo[i] + if self.whole[i] { (u * (range + 1.0)).floor().min(range) } else { u * range }
        };
        let x: Vec<f64> = unit.iter().enumerate().map(place).collect();
        let key: Vec<u64> = x.iter().map(|v| v.to_bits()).collect();
        if let Some(found) = self.known.get(&key) {
            return found.clone();
        }
        let found = self.ask(&x);
        self.count += self.each;
        if let Some(rows) = &found
            && rows.feasible
        {
            let least = rows.objectives.iter().copied().fold(f64::INFINITY, f64::min);
            if self.best.is_none_or(|best| least > best) {
                self.best = Some(least);
                self.course.push((self.count, least));
            }
        }
        self.known.insert(key, found.clone());
        found
    }

    fn ask(&mut self, x: &[f64]) -> Option<Rows> {
        writeln!(self.to, "{}", Value::from(x.to_vec())).ok()?;
        self.to.flush().ok()?;
        let found = line(&mut self.from).ok()?;
        let row =
            |key: &str| -> Option<Vec<f64>> { found[key].as_array()?.iter().map(Value::as_f64).collect() };
        Some(Rows {
            objectives: row("objectives")?,
            limits: row("limits")?,
            feasible: found["feasible"].as_bool()?,
        })
    }
}

impl Drop for Evaluator {
    fn drop(&mut self) {
        // It ends by itself when its input closes; a peer that was cut off must not leave it behind.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

fn line(from: &mut BufReader<ChildStdout>) -> Result<Value, String> {
    let mut text = String::new();
    from.read_line(&mut text).map_err(|e| e.to_string())?;
    serde_json::from_str(&text).map_err(|e| format!("{e}: {text}"))
}
