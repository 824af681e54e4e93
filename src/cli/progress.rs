//! Progress on standard error, only for jobs that last.

use crate::follow::{Follow, News};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Shorter jobs show nothing.
const PATIENCE: Duration = Duration::from_secs(1);

/// A progress line. Shared freely between threads; it vanishes when dropped.
#[derive(Debug)]
pub struct ProgressLine {
    bar: ProgressBar,
    start: Instant,
    wanted: bool,
    shown: AtomicBool,
    /// The stretch of work that has begun.
    part: Mutex<String>,
}

impl ProgressLine {
    /// `total`: number of steps, or nothing where it is unknown. `unit`: what one step is ("evaluations").
    /// Only a terminal on standard error sees it, and only if `wanted`.
    pub fn new(wanted: bool, what: &str, unit: &str, total: Option<u64>) -> Self {
        let bar = ProgressBar::with_draw_target(total, ProgressDrawTarget::hidden());
        // No colours: NO_COLOR is honoured by never using any.
        let template = if total.is_some() {
            format!("{{msg}} [{{bar:30}}] {{human_pos}}/{{human_len}} {unit}, {{per_sec}}, {{eta}} left")
        } else {
            format!("{{msg}} {{spinner}} {{human_pos}} {unit}, {{per_sec}}, {{elapsed}}")
        };
        if let Ok(style) = ProgressStyle::with_template(&template) {
            bar.set_style(style.progress_chars("=> "));
        }
        bar.set_message(what.to_owned());
        let wanted = wanted && std::io::stderr().is_terminal();
        let part = Mutex::new(what.to_owned());
        Self { bar, start: Instant::now(), wanted, shown: AtomicBool::new(false), part }
    }

    /// `follow`, telling this line as long as there is one.
    pub fn told_by(self: &Arc<Self>, follow: &Follow) -> Follow {
        let line = Arc::downgrade(self);
        follow.telling(move |news| match (line.upgrade(), news) {
            (Some(line), News::Done) => line.advance(1),
            (Some(line), News::Begins(part)) => {
                line.describe(part);
                *line.part.lock().unwrap_or_else(PoisonError::into_inner) = part.to_owned();
            }
            (None, _) => (),
        })
    }

    /// The stretch of work that has begun.
    pub fn part(&self) -> String {
        self.part.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// `steps` more are done.
    pub fn advance(&self, steps: u64) {
        self.bar.inc(steps);
        self.show_when_due();
    }

    /// `position` steps are done.
    pub fn set(&self, position: u64) {
        self.bar.set_position(position);
        self.show_when_due();
    }

    /// Replace the text in front, e.g. with the best value so far.
    pub fn describe(&self, what: &str) {
        self.bar.set_message(what.to_owned());
        self.show_when_due();
    }

    fn show_when_due(&self) {
        if self.wanted && self.start.elapsed() > PATIENCE && !self.shown.swap(true, Ordering::Relaxed) {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
    }
}

impl Drop for ProgressLine {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_short_job_shows_nothing_and_counts() {
        let progress = ProgressLine::new(true, "search", "evaluations", Some(10));
        progress.advance(3);
        progress.set(7);
        progress.describe("search, best 0.12");
        assert!(progress.bar.is_hidden() && progress.bar.position() == 7);
    }
}
