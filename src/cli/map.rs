//! `map`: what a table of `evaluate` shows.

use super::exit::{Exit, Failure};
use super::sweep::opened_again;
use super::{Context, Run, Without, output};
use crate::answer::sweep::{NoTable, SweepMap};
use crate::follow::Follow;
use clap::Args;
use std::fs::File;
use std::io::{self, Read};
use std::path::PathBuf;
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  sprag-design map margins.csv --report map.html
  sprag-design map part-1.csv part-2.csv --over r_i2_mm,r_i3_mm --report map.html
  sprag-design map margins.csv --by least --json

TABLE is what `evaluate` writes of points (--csv), whole or in parts. The page: planes over two variables with the best margin, what
decides, and the border of what is held; points across all variables; what decides how often. Read twice, in flat memory. Ctrl-C ends it
without a map: one of half a table would show another box.";

/// Arguments of `map`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct MapArgs {
    /// Tables of margins (CSV), parts of one sweep
    #[arg(value_name = "TABLE", required = true)]
    pub tables: Vec<PathBuf>,
    /// A plane over these two variables, to the right and upwards; as often as wanted [default: the first six pairs]
    #[arg(long, value_name = "X,Y", value_parser = pair)]
    pub over: Vec<[String; 2]>,
    /// The column whose value is mapped
    #[arg(long, value_name = "COLUMN", default_value = "margin")]
    pub by: String,
}

fn pair(text: &str) -> Result<[String; 2], String> {
    match text.split_once(',').map(|(x, y)| [x.trim(), y.trim()]) {
        Some([x, y]) if !x.is_empty() && !y.is_empty() && x != y => Ok([x.to_owned(), y.to_owned()]),
        _ => Err("two different variables are needed, such as r_i2_mm,r_i3_mm".to_owned()),
    }
}

/// A table that ends where somebody asks to stop.
struct Heard<'a> {
    file: File,
    follow: &'a Follow,
}

impl Read for Heard<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.follow.stopped() { Err(io::Error::other("stopped")) } else { self.file.read(buffer) }
    }
}

impl Run for MapArgs {
    const WITHOUT: Without = ("its tables name the design", &["set", "threads", "quiet"]);

    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        context.reads(&self.tables)?;
        context.outputs.refuse_foreign()?;
        let started = Instant::now();
        let mut map = SweepMap::of(&self.by);
        let each = |read: &mut dyn FnMut(Heard<'_>) -> Result<(), NoTable>| {
            self.tables.iter().try_for_each(|path| {
                if context.follow.stopped() {
                    return Err(Failure::Interrupted);
                }
                let table = Heard { file: opened_again(path, "tables")?, follow: &context.follow };
                read(table).map_err(|why| match context.follow.stopped() {
                    true => Failure::Interrupted,
                    false => Failure::of(path, why),
                })
            })
        };
        each(&mut |file| map.survey(file))?;
        map.lay_out(&self.over).map_err(|why| Failure::malformed(why.to_string()))?;
        each(&mut |file| map.add(file))?;
        let run_time_s = started.elapsed().as_secs_f64();
        context.outputs.write_csv(&map.variables_table());
        context.outputs.write_report(|| map.page(&context.provenance(run_time_s)));
        context.answer(&map.text(context.screen))?;
        if context.json {
            output::print_json(&map.object())?;
        }
        Ok(Exit::Held)
    }
}
