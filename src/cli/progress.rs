//! Progress on standard error, only for jobs that last.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};
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
        Self { bar, start: Instant::now(), wanted, shown: AtomicBool::new(false) }
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
