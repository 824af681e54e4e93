//! What an identification that was stopped had found: its best design, without error bars.

use super::head;
use crate::answer::Envelope;
use crate::answer::left_out::left_out_of;
use crate::design::Design;
use crate::identify::{SoFar, Unknown};
use serde::Serialize;

/// The best design of an identification that was stopped.
#[derive(Debug, Clone, Copy)]
pub struct StoppedIdentification<'a> {
    /// The design that was given.
    pub design: &'a Design,
    /// What was sought.
    pub unknowns: &'a [Unknown],
    /// The best design so far.
    pub so_far: &'a SoFar,
}

/// An unknown with its best value, in the unit of its name.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct UnknownBody<'a> {
    /// Largest value looked at.
    pub max: f64,
    /// Least value looked at.
    pub min: f64,
    /// Name, its unit at the end.
    pub name: &'a str,
    /// The best so far.
    pub value: f64,
}

/// Keys of an identification that was stopped.
#[derive(Debug, Clone, Serialize)]
pub struct StoppedBody<'a> {
    /// False: the search has not ended.
    pub converged: bool,
    /// Designs compared with every row of the fit until then.
    pub evaluations: usize,
    /// True: it was stopped.
    pub interrupted: bool,
    /// Sum of the squared scaled residuals.
    pub sum_of_squares: f64,
    /// Each unknown.
    pub unknowns: Vec<UnknownBody<'a>>,
    /// Where the design was written.
    pub written: Option<&'a str>,
}

impl<'a> StoppedIdentification<'a> {
    fn named(&self) -> impl Iterator<Item = (&'a Unknown, &'a f64)> {
        self.unknowns.iter().zip(&self.so_far.values)
    }

    /// The design file with the best values so far, which says that it is no end.
    pub fn file(&self, command: &str) -> String {
        let values: String = self.named().map(|(u, value)| format!("#   {}: {value}\n", u.name)).collect();
        let remark = format!(
            "# stopped by Ctrl-C: the best of {} designs, not the end of the search\n",
            self.so_far.evaluations
        );
        head(self.design, command) + &remark + &values + "#\n" + &self.so_far.source
    }

    /// What was found, in a sentence.
    pub fn verdict(&self) -> String {
        format!(
            "stopped by Ctrl-C: the best of {} designs so far, sum of squared scaled residuals {:.6e}; the search has not ended, and how \
             well the values are known was not looked at",
            self.so_far.evaluations, self.so_far.sum
        )
    }

    /// The answer on a terminal; `written`: where the file is.
    pub fn text(&self, written: Option<&str>) -> String {
        let values: Vec<String> =
            self.named().map(|(u, value)| format!("  {} = {value}\n", u.name)).collect();
        let written = written.map_or(String::new(), |path| format!("Written: {path}\n"));
        format!("{}\n{}{written}", self.verdict(), values.concat())
    }

    /// The answer with the keys that all answers share.
    pub fn envelope(&self, run_time_s: f64, written: Option<&'a str>) -> Envelope<'a, StoppedBody<'a>> {
        let unknown =
            |(u, &value): (&'a Unknown, &f64)| UnknownBody { name: &u.name, min: u.min, max: u.max, value };
        let body = StoppedBody {
            interrupted: true,
            converged: false,
            unknowns: self.named().map(unknown).collect(),
            sum_of_squares: self.so_far.sum,
            evaluations: self.so_far.evaluations,
            written,
        };
        let left_out = left_out_of(self.design);
        Envelope { design: self.design, run_time_s, left_out, error_estimate: None, body }
    }
}
