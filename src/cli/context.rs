//! What commands share: common options, the outside world that they may use, designs read and answers handed out.

use super::command_line::command_line;
use super::exit::{Exit, Failure};
use super::interrupt;
use super::output::{self, Outputs};
use super::progress::ProgressLine;
use crate::answer::{Answer, Envelope, Provenance};
use crate::design::Design;
use crate::follow::Follow;
use crate::report::Screen;
use clap::Args;
use serde::Serialize;
use serde_json::Value;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

/// Options of every command.
#[derive(Debug, Args)]
#[command(next_help_heading = "Output")]
pub struct Common {
    /// Print one JSON object on standard output and nothing else there
    #[arg(long, global = true)]
    pub json: bool,
    /// Write the result table as CSV, units in the column names; - writes it to standard output in place of the text
    #[arg(long, global = true, value_name = "PATH")]
    pub csv: Option<PathBuf>,
    /// Write a self-contained HTML page with drawing, curves and tables; a PDF is made by printing it (A4)
    #[arg(long, global = true, value_name = "PATH.html")]
    pub report: Option<PathBuf>,
    /// Set a value of the design before anything else, as often as wanted: a dotted path of the file
    /// (`sprags.inner_arcs[0].radius_mm=4.1`, rows count from 0) or a variable's short name (`r_i1_mm=4.1`, arcs from 1);
    /// checked like the file, which stays as it is
    #[arg(long, global = true, value_name = "KEY=VALUE", value_parser = setting)]
    pub set: Vec<(String, String)>,
    /// Replace files that this tool has not written, too
    #[arg(long, global = true)]
    pub force: bool,
    /// Number of threads [default: all cores]
    #[arg(long, global = true, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// No progress and no messages, only the answer and errors
    #[arg(long, short, global = true)]
    pub quiet: bool,
}

impl Common {
    /// Which answers and changes are asked for, by the names of their options.
    pub fn answers(&self) -> [Option<&'static str>; 4] {
        [
            self.json.then_some("json"),
            self.csv.is_some().then_some("csv"),
            self.report.is_some().then_some("report"),
            (!self.set.is_empty()).then_some("set"),
        ]
    }
}

/// What every command may use of the outside world.
#[derive(Debug, Clone)]
pub struct Context {
    /// One JSON object instead of text on standard output.
    pub json: bool,
    /// No progress, no messages.
    pub quiet: bool,
    /// What the answer is printed on.
    pub screen: Screen,
    /// Files to write.
    pub outputs: Outputs,
    /// What `--set` sets: path and value as typed.
    pub set: Vec<(String, String)>,
    /// The command line as typed, for the reports.
    pub command_line: String,
    /// Stopped by Ctrl-C.
    pub follow: Follow,
}

impl Context {
    /// That of a command line.
    ///
    /// # Errors
    /// [`Failure`]: two answers for standard output, threads that cannot be had.
    pub fn new(common: Common, args: &[String]) -> Result<Self, Failure> {
        if common.json && common.csv.as_deref().is_some_and(output::is_standard_output) {
            return Err(Failure::malformed(
                "--csv - and --json both write to standard output: give --csv a file",
            ));
        }
        let follow = interrupt::install(common.quiet);
        if let Some(threads) = common.threads {
            rayon::ThreadPoolBuilder::new()
                .num_threads(usize::from(threads))
                .build_global()
                .map_err(|e| Failure::Failed(format!("--threads {threads}: {e}")))?;
        }
        // NO_COLOR counts when set to anything but nothing (no-color.org).
        let refused = std::env::var_os("NO_COLOR").is_some_and(|v| !v.is_empty());
        let out = std::io::stdout();
        let terminal = out.is_terminal();
        // A pipe or a file takes lines of any length.
        let columns =
            terminal_size::terminal_size_of(&out).filter(|_| terminal).map(|(w, _)| usize::from(w.0));
        Ok(Self {
            json: common.json,
            quiet: common.quiet,
            screen: Screen { colour: terminal && !refused, columns },
            outputs: Outputs::new(common.csv, common.report, common.force),
            set: common.set,
            command_line: command_line(args.iter().cloned()),
            follow,
        })
    }

    /// A message on standard error, unless `--quiet`.
    pub fn message(&self, text: &str) {
        if !self.quiet {
            output::note(text);
        }
    }

    /// A progress line on standard error; `unit` names the steps, `total` counts them if known.
    pub fn progress(&self, what: &str, unit: &str, total: Option<u64>) -> Arc<ProgressLine> {
        Arc::new(ProgressLine::new(!self.quiet, what, unit, total))
    }

    /// How an answer came about that took `run_time_s`, s.
    pub fn provenance(&self, run_time_s: f64) -> Provenance {
        Provenance { command: self.command_line.clone(), run_time_s }
    }

    /// The one JSON object of `--json`, with what could not be written until now; nothing without it.
    ///
    /// # Errors
    /// [`Failure::Failed`] where standard output cannot be written.
    pub fn print<B: Serialize>(&self, answer: &Envelope<'_, B>) -> Result<(), Failure> {
        if self.json { output::print_json(&answer.object(self.outputs.unwritten())) } else { Ok(()) }
    }

    /// As [`Self::print`], of an answer that has no design.
    ///
    /// # Errors
    /// As there.
    pub fn object(&self, keys: impl FnOnce() -> Value) -> Result<(), Failure> {
        if self.json { output::print_json(&output::signed(keys())) } else { Ok(()) }
    }

    /// The answer as text on standard output; nothing with `--json` and with `--csv -`.
    ///
    /// # Errors
    /// [`Failure::Failed`] where standard output cannot be written.
    pub fn answer(&self, text: &str) -> Result<(), Failure> {
        match self.screen.columns {
            _ if self.json || self.outputs.csv_is_answer() => Ok(()),
            Some(columns) => output::print(&output::folded(text, columns)),
            None => output::print(text),
        }
    }

    /// The checked design in `path`, with what `--set` sets.
    ///
    /// # Errors
    /// [`Failure::Malformed`] with every fault of the file, or where an output is one of its histories.
    pub fn design(&self, path: &Path) -> Result<Design, Failure> {
        let design = Design::read_with(path, &self.set)?;
        let histories = design.histories.iter().map(PathBuf::as_path);
        let read: Vec<&Path> = std::iter::once(path).chain(histories).collect();
        self.outputs.check(&read, &[])?;
        self.outputs.refuse_foreign()?;
        Ok(design)
    }

    /// Refuse outputs that would do harm to what is read: `files` and what else.
    ///
    /// # Errors
    /// As [`Outputs::check`].
    pub fn reads<'p>(&self, files: impl IntoIterator<Item = &'p PathBuf>) -> Result<(), Failure> {
        let inputs: Vec<&Path> = files.into_iter().map(PathBuf::as_path).collect();
        self.outputs.check(&inputs, &[])
    }

    /// The answers to `files` one after another; the worst exit code of all. A table or page is of one file. One that fails does
    /// not keep the others from being answered.
    ///
    /// # Errors
    /// Every [`Failure`], after the answers of all.
    pub fn each(
        &self,
        files: &[PathBuf],
        mut one: impl FnMut(&Path, &Design) -> Result<Exit, Failure>,
    ) -> Result<Exit, Failure> {
        if files.len() > 1 && (self.outputs.csv.is_some() || self.outputs.report.is_some()) {
            return Err(Failure::malformed(
                "--csv and --report are of one FILE; `compare` puts several designs side by side on one page",
            ));
        }
        let (mut worst, mut failed) = (Exit::Held, Vec::new());
        for (k, file) in files.iter().enumerate() {
            if k > 0 {
                self.answer("\n")?;
            }
            match self.design(file).and_then(|design| one(file, &design)) {
                Ok(exit) => worst = if exit.code() > worst.code() { exit } else { worst },
                Err(Failure::Interrupted) => return Err(Failure::Interrupted),
                Err(why) => failed.push(why),
            }
        }
        Failure::of_all(failed).map_or(Ok(worst), Err)
    }

    /// Hand out an answer that took `run_time_s`: table to `--csv`, page to `--report`, and the object of `--json` or the text. The
    /// exit code is that of what it comes to. The table of a part of an answer says so in a last column.
    ///
    /// # Errors
    /// [`Failure::Failed`] where standard output cannot be written.
    pub fn deliver(&self, found: &impl Answer, run_time_s: f64) -> Result<Exit, Failure> {
        self.deliver_as(found, Answer::text, run_time_s)
    }

    /// The same with another text.
    ///
    /// # Errors
    /// As [`Self::deliver`].
    pub fn deliver_as<A: Answer>(
        &self,
        found: &A,
        text: impl Fn(&A, Screen) -> String,
        run_time_s: f64,
    ) -> Result<Exit, Failure> {
        if self.outputs.csv.is_some() {
            let table = found.table();
            let table = match found.part() {
                Some(why) => table.marked("partial", &why),
                None => table,
            };
            self.outputs.write_csv(&table);
        }
        self.outputs.write_report(|| found.page(&self.provenance(run_time_s)));
        self.answer(&text(found, self.screen))?;
        self.print(&found.envelope(run_time_s))?;
        Ok(found.outcome().into())
    }
}

/// What `work` finds, and the time that it took, s.
pub fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let started = Instant::now();
    let found = work();
    (found, started.elapsed().as_secs_f64())
}

/// A path and a value, for `--set`.
fn setting(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((path, value)) if !path.trim().is_empty() => match value.trim() {
            "" => Err(format!("{path} has no value; {path}=none removes it")),
            // The library takes an empty value for that.
            "none" => Ok((path.trim().to_owned(), String::new())),
            value => Ok((path.trim().to_owned(), value.to_owned())),
        },
        _ => Err("KEY=VALUE is needed, such as sprags.inner_arcs[1].radius_mm=4.1 or r_i2_mm=4.1".to_owned()),
    }
}
