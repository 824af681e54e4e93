//! `evaluate` of points that are drawn or read from a table: a line of margins for each, the same for any part and any number of threads.

use super::Context;
use super::evaluate::EvaluateArgs;
use super::exit::{Exit, Failure};
use super::sweep::{Sink, Sunk, opened_again};
use crate::answer::sweep::{SweepHead, SweepLines, Vectors};
use crate::design::Design;
use crate::sweep::{BoxSample, NextPoint, SweepEnd, SweepRow, SweepSettings};
use std::fs::File;
use std::ops::Range;
use std::path::Path;
use std::time::Instant;

type Next<'n> = NextPoint<'n, Failure>;

/// Where points come from.
enum Source<'s> {
    Drawn(BoxSample),
    Table(&'s Path),
}

/// Counts of a run.
#[derive(Default)]
struct Tally {
    points: u64,
    held: u64,
    void: u64,
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &EvaluateArgs, design: &Design, context: &Context) -> Result<Exit, Failure> {
    let settings = SweepSettings { at_rest: args.at_rest, full: args.full };
    let sweep = design.sweep(&settings).map_err(|why| Failure::of(&args.file, why))?;
    let (source, points, all) = match (&args.vectors, args.points.sampling()) {
        (Some(path), _) => {
            let inputs = [args.file.as_path(), path];
            context.outputs.check(&inputs, &[])?;
            let (points, all) = surveyed(path, design)?;
            (Source::Table(path), points, all)
        }
        (None, Some(sampling)) => {
            let sample = design.sample(&sampling).map_err(|why| Failure::of(&args.file, why))?;
            let all = sample.count();
            (Source::Drawn(sample), sampling.to_string(), all)
        }
        (None, None) => return Err(Failure::malformed("no points asked for")),
    };
    let range = args.points.range(all)?;
    let head = SweepHead::margins(design, &points, &settings);
    let lines = SweepLines::new(head, &sweep, &args.columns)
        .map_err(|why| Failure::malformed(format!("--columns: {why}")))?;
    let started = Instant::now();
    let sink = Sink::of(&context.outputs);
    let progress = context.progress("evaluate", "points", Some(range.end - range.start));
    let mut tally = Tally::default();
    let sunk = sink.fill(
        &lines.begin(),
        || last_of(&source, &range, design),
        |emit| {
            if !emit(&lines.begin())? {
                return Ok(false);
            }
            over(&source, range.clone(), design, &mut |next| {
                let made =
                    |index, row: &SweepRow| (lines.line(index, row), row.feasible(), row.found.is_err());
                let end = sweep.rows(&context.follow, next, made, |rows| {
                    for (_, held, void) in &rows {
                        tally.points += 1;
                        tally.held += u64::from(*held);
                        tally.void += u64::from(*void);
                    }
                    progress.advance(rows.len() as u64);
                    emit(&rows.into_iter().flat_map(|(line, ..)| line).collect::<Vec<u8>>())
                })?;
                if end == SweepEnd::Stopped { Err(Failure::Interrupted) } else { Ok(end == SweepEnd::Whole) }
            })
        },
    )?;
    drop(progress);
    match sunk {
        Sunk::Unheard => return Ok(Exit::Unheard),
        Sunk::Standing => context.message(&format!("{}: there already", sink.place())),
        Sunk::Written => {
            let seconds = started.elapsed().as_secs_f64();
            let Tally { points, held, void } = tally;
            context.message(&format!(
                "{}: {points} points, {held} hold every limit, {void} without a clutch; {seconds:.2} s, {:.0} points/s on {} threads",
                sink.place(),
                points as f64 / seconds.max(1e-9),
                rayon::current_num_threads()
            ));
        }
    }
    Ok(Exit::Held)
}

/// Give `then` the points of `range`, one after another.
fn over(
    source: &Source,
    range: Range<u64>,
    design: &Design,
    then: &mut dyn FnMut(&mut Next) -> Result<bool, Failure>,
) -> Result<bool, Failure> {
    match source {
        Source::Drawn(sample) => {
            let mut left = range;
            then(&mut || Ok(left.next().map(|index| (index, sample.point(index)))))
        }
        Source::Table(path) => {
            let mut vectors = opened(path, design)?;
            let mut next = || vectors.next_point().map_err(|why| Failure::of(path, why));
            for _ in 0..range.start {
                next()?;
            }
            let mut left = range;
            then(&mut || left.next().map_or(Ok(None), |_| next()))
        }
    }
}

/// Number of the last point of `range`.
fn last_of(source: &Source, range: &Range<u64>, design: &Design) -> Result<Option<u64>, Failure> {
    let Some(last) = range.clone().next_back() else { return Ok(None) };
    let mut number = None;
    over(source, last..last + 1, design, &mut |next| {
        number = next()?.map(|(index, _)| index);
        Ok(true)
    })?;
    Ok(number)
}

fn opened(path: &Path, design: &Design) -> Result<Vectors<File>, Failure> {
    Vectors::open(design, opened_again(path, "vectors")?).map_err(|why| Failure::of(path, why))
}

/// All vectors of the table read once: which points these are, and how many.
fn surveyed(path: &Path, design: &Design) -> Result<(String, u64), Failure> {
    let mut vectors = opened(path, design)?;
    while vectors.next_point().map_err(|why| Failure::of(path, why))?.is_some() {}
    Ok((vectors.points(), vectors.count()))
}
