//! `sample`: points of the box of a design's variables.

use super::exit::{Exit, Failure};
use super::sweep::{PointArgs, Sink, Sunk};
use super::{Context, Run, Without};
use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  sprag-design sample designs/huang2017-multi-arc.toml --sobol 1000 --csv vectors.csv
  sprag-design sample designs/huang2017-multi-arc.toml --grid r_i2_mm=40,r_i3_mm=40
  sprag-design sample designs/huang2017-multi-arc.toml --sobol 1e6 --seed 7 --part 3/8 --csv part-3.csv

One line for each point, its number first, behind two lines with the design's hash and the names of the columns, units in them. Point
17 is the same in every part and on every machine, so parts joined without their first two lines are the whole, byte for byte.
Sobol points beyond 65536 begin a sequence of their own with each 65536. `evaluate --vectors` computes margins; `evaluate --sobol`
draws the same points itself.";

/// Arguments of `sample`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct SampleArgs {
    /// Design file (TOML) with an optimize table
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Which points.
    #[command(flatten)]
    pub points: PointArgs,
}

impl Run for SampleArgs {
    const WITHOUT: Without = ("its answer is a table of points", &["json", "report", "threads"]);
    const NAMES: &[&str] = &["variables"];

    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        let design = context.design(&self.file)?;
        let Some(sampling) = self.points.sampling() else {
            return Err(Failure::malformed("no points asked for: --sobol N, or --grid NAME=N,..."));
        };
        let named = |why| Failure::of(&self.file, why);
        let sample = design.sample(&sampling).map_err(named)?;
        let range = self.points.range(sample.count())?;
        let begin = sample.csv(&design, 0..0).next().unwrap_or_default();
        let last = range.clone().next_back();
        let sink = Sink::of(&context.outputs);
        let sunk = sink.fill(
            &begin,
            || Ok(last),
            |emit| {
                // Pieces of some size: a line alone is little to write.
                let mut piece = Vec::new();
                for line in sample.csv(&design, range.clone()) {
                    piece.extend(line);
                    if piece.len() > PIECE {
                        if context.follow.stopped() {
                            return Err(Failure::Interrupted);
                        }
                        if !emit(&piece)? {
                            return Ok(false);
                        }
                        piece.clear();
                    }
                }
                emit(&piece)
            },
        )?;
        match sunk {
            Sunk::Standing => context.message(&format!("{}: there already", sink.place())),
            Sunk::Written | Sunk::Unheard => {}
        }
        Ok(Exit::Held)
    }
}

/// Bytes written at once.
const PIECE: usize = 1 << 16;
