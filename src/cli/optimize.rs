//! `optimize`: a better design, and how it was found.

use super::exit::{Exit, Failure};
use super::histories::Histories;
use super::journal::{self, JournalFile};
use super::origin::FileKind;
use super::progress::ProgressLine;
use super::{Context, Run};
use crate::answer::search::{
    Hints, NEAREST, ROBUST, SearchAnswer, SearchFile, SearchReport, SearchSettings, SearchSoFar,
};
use crate::design::{Design, Objective};
use crate::follow::News;
use crate::optimise::{Entry, Iteration, Journal, NoSearch, ProblemId, Record};
use crate::sweep::NoSample;
use clap::Args;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  sprag-design optimize designs/huang2017-multi-arc.toml -o better.toml --report better.html
  sprag-design optimize designs/huang2017-multi-arc.toml -o better.toml --resume
  sprag-design optimize designs/huang2017-multi-arc.toml --json --quiet > best.json
  sprag-design optimize designs/huang2017-multi-arc.toml --objective mass -o light.toml
  sprag-design optimize designs/huang2017-multi-arc.toml --reserve 0.05 --step-mm 0.01
  sprag-design optimize designs/huang2017-multi-arc.toml --starts 8 --global 2000 --journal search.csv
  sprag-design optimize designs/huang2017-multi-arc.toml --pareto slip-margin,torque-capacity --report front.html

Every margin of `check` is a limit. Each evaluation goes into a journal at once: Ctrl-C stops the search and writes the
best design found so far, --resume goes on from NEW.toml.journal and ends where an uninterrupted search ends; without
--resume a journal that is there is kept under another name, which is told. --journal keeps the record for later searches
too, as a CSV file that only grows. A journal belongs to what the design file says: comments and layout may change, a
value or a history makes another problem. Rows by another version of the program, and rows that were edited or damaged,
are kept and not used. One search at a time writes a journal; a second is refused.

In NEW.toml each value that the search has changed says so behind it, with what it was; the design's histories are copied
beside it. The design of --robust is NEW.robust.toml. No output replaces FILE, nor without --force a file that this tool did not write.

Where the centroid is a variable, flanks that give it are sought next and searched on in its place: NEW.toml is that sprag. What
the free centroid came to is shown as a bound. Lengths are then put on multiples of --step-mm, to the side that holds every
limit; where no such point is near, that is told and the lengths stay as they are.

Evaluations are points of the clutch that the search asks for. One that is asked for twice is computed once and has one row in
the journal, so that the journal has fewer rows.

Where no design holds every limit, NEW.toml is not written: the nearest one goes to NEW.nearest.toml, whose first line says what
it does not hold.

Exit codes: 0 every limit held, with --robust at every corner of the tolerances too; 1 no such design found; 130 stopped by
Ctrl-C, the best design so far is written if it is better than FILE.";

/// What the command's reader can do about an end.
const HINTS: Hints = Hints {
    evaluation_limit: ", which --evaluations raises,",
    more_starts: "try more --starts",
    stopped: "stopped by Ctrl-C (the same command with --resume goes on)",
    further_variables: ", which `sprag-design explain variables` lists",
    one_step_further: " (check one step further with --set)",
    reserve: "; --reserve 0.05 would keep 5 % of every limit to spare",
};

/// Arguments of `optimize`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct OptimizeArgs {
    /// Design file (TOML) with an optimize table
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Where to write the better design file [default: FILE's name with -optimized, in this folder]
    #[arg(long, short, value_name = "NEW.toml")]
    pub output: Option<PathBuf>,
    /// What is made better in place of the file's objective, as `--set optimize.objective=NAME`: one of the objectives below
    #[arg(long, value_name = "NAME")]
    pub objective: Option<Objective>,
    /// Go on from the journal of an interrupted search; the result is the same as without the break
    #[arg(long)]
    pub resume: bool,
    /// Record of every evaluation (CSV): appended to, kept, and used by later searches of the same problem
    #[arg(long, value_name = "PATH")]
    pub journal: Option<PathBuf>,
    /// Most evaluations of the clutch in each climb
    #[arg(long, value_name = "N", default_value_t = 500, allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub evaluations: u32,
    /// Climbs side by side: the first from the design, the others from scrambled Sobol points of the box [default: 8, and 8
    /// more up to 32 as long as the optima met let expect others]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub starts: Option<u32>,
    /// Global search first: a particle swarm of about N evaluations, then a climb from its best point
    #[arg(long, value_name = "N", num_args = 0..=1, default_missing_value = "2000",
          allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(80..=1_000_000))]
    pub global: Option<u32>,
    /// Front between two or three objectives, such as slip-margin,torque-capacity
    #[arg(long, value_name = "OBJECTIVES", value_delimiter = ',', num_args = 1)]
    pub pareto: Vec<Objective>,
    /// Steps of the front between any two of its ends
    #[arg(long, value_name = "N", default_value_t = 8, allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(2..=64))]
    pub points: u32,
    /// Margins within the file's tolerances at every corner and in seeded draws, and a design that holds them at every corner
    #[arg(long)]
    pub robust: bool,
    /// Draws within the tolerances
    #[arg(long, value_name = "N", default_value_t = 200, allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(10..=100_000))]
    pub draws: u32,
    /// Step in which lengths can be made, mm: those of the optimum are rounded to multiples of it that hold every limit; 0: no
    /// rounding [default: step_mm of the file, 0.005 there]
    #[arg(long, value_name = "MM", allow_negative_numbers = true, value_parser = share)]
    pub step_mm: Option<f64>,
    /// What every limit keeps of its margin: 0.05 holds each with 5 % to spare [default: reserve of the file, 0 there]
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true, value_parser = share)]
    pub reserve: Option<f64>,
    /// Run everything in the search too, and leave nothing out that a scene cannot feel
    #[arg(long)]
    pub full: bool,
    /// True error allowed of an evaluation in the search, 1e-13 to 1e-3; the optimum is looked at once more at a tenth of 1e-6
    #[arg(long, value_name = "X", default_value_t = 1e-6, allow_hyphen_values = true, value_parser = super::positive)]
    pub tolerance: f64,
}

impl Run for OptimizeArgs {
    const NAMES: &[&str] = &["objectives", "variables", "limits"];

    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        let new = output_path(self);
        let record = self.journal.clone().unwrap_or_else(|| journal::path_for(&new));
        context.outputs.check(&[&self.file], &[(&new, FileKind::Design), (&record, FileKind::Journal)])?;
        let design = with_objective(context.design(&self.file)?, self)?;
        let histories = Histories::beside(&design, &new)?;
        let at = |what: String| Failure::of(&self.file, what);
        let Some(task) = design.optimize.clone() else {
            return Err(Failure::of(&self.file, NoSample::NoTask));
        };
        let mut settings = self.settings(context);
        settings.validate(&design).map_err(|why| at(why.to_string()))?;
        let beside = beside(&new, self);
        let others: Vec<_> = beside.iter().map(|path| (path.as_path(), FileKind::Design)).collect();
        context.outputs.check(&[&self.file], &others)?;
        let (model, content) = (journal::model(), design.content_hash());
        let file = match (self.resume, self.journal.is_some()) {
            (true, _) => {
                context.message("goes on with the options of this call: a journal does not hold those of the search before");
                JournalFile::resume(&record, &model, &content)?
            }
            (false, true) => JournalFile::open(&record, &model, &content)?,
            (false, false) => {
                let (file, kept) = JournalFile::begin(&record, &model, &content)?;
                if let Some(kept) = kept {
                    context.message(&format!(
                        "{} held the record of an earlier search; it is kept as {}, and --resume --journal with that name goes on from it",
                        record.display(),
                        kept.display()
                    ));
                }
                file
            }
        };
        if let Some(what) = file.unused() {
            context.message(&format!("warning: {what}"));
        }
        let known = file.entries();
        let drawn = self.starts != Some(1) || self.global.is_some() || self.robust;
        context.message(&format!(
            "{} variables, {} scenarios, seed {}{}{}",
            task.variables.len(),
            task.scenarios.len(),
            task.seed,
            if drawn { "" } else { " (this search draws nothing at random)" },
            if known > 0 { format!("; {known} evaluations in the journal") } else { String::new() }
        ));
        let progress = context.progress("search", "evaluations", None);
        settings.follow = progress.told_by(&settings.follow);
        let mut keeper = Keeper { progress, file, so_far: SearchSoFar::default() };
        let started = Instant::now();
        let answer = design.optimise_recorded(&settings, &mut keeper);
        let run_time_s = started.elapsed().as_secs_f64();
        let Keeper { progress, file, .. } = keeper;
        drop(progress);
        if let Some(why) = &file.failed {
            context.message(&format!(
                "warning: {}: {why}; evaluations from there on are not in the journal",
                file.path().display()
            ));
        }
        let answer = match answer {
            Ok(answer) => answer,
            Err(NoSearch::Stopped) => return Err(Failure::Interrupted),
            Err(why) => {
                if self.journal.is_none() && !self.resume {
                    file.discard();
                }
                return Err(at(why.to_string()));
            }
        };
        finish(&design, &answer, (&new, &histories), (file, self.journal.is_some()), run_time_s, context)
    }
}

impl OptimizeArgs {
    fn settings(&self, context: &Context) -> SearchSettings {
        SearchSettings {
            evaluations: self.evaluations as usize,
            starts: self.starts.map(|n| n as usize),
            swarm: self.global.map(|n| n as usize),
            tolerance: self.tolerance,
            full: self.full,
            front: self.pareto.clone(),
            front_steps: self.points as usize,
            robust: self.robust,
            draws: self.draws as usize,
            step_mm: self.step_mm,
            reserve: self.reserve,
            follow: context.follow.clone(),
        }
    }
}

/// The design with the objective of `--objective`, where that and a task are given.
fn with_objective(design: Design, args: &OptimizeArgs) -> Result<Design, Failure> {
    let Some(objective) = args.objective.filter(|_| design.optimize.is_some()) else { return Ok(design) };
    let setting = ("optimize.objective".to_owned(), objective.name().to_owned());
    Ok(design.with(&[setting], &args.file.display().to_string())?)
}

/// A number from 0 to 1.
fn share(text: &str) -> Result<f64, String> {
    let value: Option<f64> = text.parse().ok();
    value.filter(|v| (0.0..=1.0).contains(v)).ok_or_else(|| "a number from 0 to 1 is needed".to_owned())
}

/// Write the designs and tell the story.
fn finish(
    design: &Design,
    answer: &SearchAnswer,
    (new, histories): (&Path, &Histories),
    (file, keep): (JournalFile, bool),
    run_time_s: f64,
    context: &Context,
) -> Result<Exit, Failure> {
    let named = |path: &Path| path.display().to_string();
    let (mut written, mut beside) = (None, Vec::new());
    let files = answer.files(design, &context.command_line);
    if !files.is_empty() && histories.write(&context.outputs) {
        for SearchFile { middle, text } in files {
            let path = middle.map_or(new.to_path_buf(), |m| new.with_extension(format!("{m}.toml")));
            match text {
                Err(why) => context.outputs.lost(format!("{}: {why}", path.display())),
                Ok(text) if !context.outputs.write(&path, FileKind::Design, text.as_bytes()) => {}
                Ok(_) if middle.is_none() => written = Some(named(&path)),
                Ok(_) => beside.push(named(&path)),
            }
        }
    }
    let journal = keep.then(|| file.path().to_path_buf());
    let report = SearchReport {
        design,
        answer,
        written,
        beside,
        journal: journal.as_deref().map(named),
        hints: HINTS,
    };
    let exit = context.deliver(&report, run_time_s)?;
    let whole = file.failed.is_none() && file.unused().is_none();
    if exit != Exit::Interrupted && !keep && whole && context.outputs.unwritten().is_empty() {
        // The search is over and its answer is safe: nothing is left to resume, no row was promised to stay.
        file.discard();
    }
    Ok(exit)
}

/// `-o`, or a name of our own.
fn output_path(args: &OptimizeArgs) -> PathBuf {
    args.output.clone().unwrap_or_else(|| {
        let stem = args.file.file_stem().map_or_else(|| "design".into(), |s| s.to_string_lossy());
        PathBuf::from(format!("{stem}-optimized.toml"))
    })
}

/// Names of the further designs that this search may write.
fn beside(new: &Path, args: &OptimizeArgs) -> Vec<PathBuf> {
    let robust = args.robust.then_some(ROBUST);
    robust.into_iter().chain([NEAREST]).map(|ending| new.with_extension(format!("{ending}.toml"))).collect()
}

/// Progress of climbs, and the journal.
struct Keeper {
    progress: Arc<ProgressLine>,
    file: JournalFile,
    so_far: SearchSoFar,
}

impl Record for Keeper {
    fn known(&mut self, problem: &ProblemId) -> Journal {
        self.file.known(problem)
    }

    fn evaluated(&mut self, problem: &ProblemId, entry: &Entry) {
        self.file.append(problem, entry);
    }

    fn iterated(&mut self, it: &Iteration) {
        self.so_far.hear(News::Begins(&self.progress.part()));
        self.so_far.see(it);
        self.progress.describe(&self.so_far.words());
    }
}
