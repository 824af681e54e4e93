//! `sprag-design evaluate` as a function that counts and remembers.

use std::collections::HashMap;
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
    /// The file's values in the unit box.
    pub start: Vec<f64>,
    known: HashMap<Vec<u64>, Option<Rows>>,
    /// Evaluations since the last [`Evaluator::forget`]; a point asked for twice counts once.
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
        let start = (0..lo.len()).map(|i| ((start[i] - lo[i]) / (hi[i] - lo[i])).clamp(0.0, 1.0)).collect();
        let known = HashMap::new();
        Ok(Self { process, to, from, lo, hi, start, known, count: 0, best: None, course: Vec::new() })
    }

    /// Count anew, with nothing known.
    pub fn forget(&mut self) {
        self.known.clear();
        (self.count, self.best) = (0, None);
        self.course.clear();
    }

    /// Margins at a point of the unit box, clipped to it; `None` where there is no clutch.
    pub fn at(&mut self, unit: &[f64]) -> Option<Rows> {
        let x: Vec<f64> = unit
            .iter()
            .zip(self.lo.iter().zip(&self.hi))
            .map(|(u, (l, h))| l + u.clamp(0.0, 1.0) * (h - l))
            .collect();
        let key: Vec<u64> = x.iter().map(|v| v.to_bits()).collect();
        if let Some(found) = self.known.get(&key) {
            return found.clone();
        }
        let found = self.ask(&x);
        self.count += 1;
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
