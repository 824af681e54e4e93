//! How far a simulation is, on standard error while it runs.

use crate::cli::Context;
use crate::follow::RunProgress;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// How often the line is renewed.
const RENEWED: Duration = Duration::from_millis(200);

/// Ends the thread that looks at the clock, also where the work panics.
struct Ended<'a>(&'a AtomicBool);

impl Drop for Ended<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Do `work`, whose runs are `duration_s` long (s) and tell `context.follow` how far they are.
pub(super) fn while_shown<T>(
    what: &str,
    duration_s: Option<f64>,
    context: &Context,
    work: impl FnOnce() -> T,
) -> T {
    let Some(duration_s) = duration_s else { return work() };
    let milliseconds = |t_s: f64| (t_s * 1e3).ceil() as u64;
    let progress = context.progress(what, "ms simulated", Some(milliseconds(duration_s).max(1)));
    let ended = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let watcher = scope.spawn(|| {
            while !ended.load(Ordering::Relaxed) {
                std::thread::park_timeout(RENEWED);
                if let Some(run) = context.follow.progress() {
                    progress.describe(&words(what, &run));
                    progress.set(milliseconds(run.t_s));
                }
            }
        });
        let found = {
            let _ended = Ended(&ended);
            work()
        };
        watcher.thread().unpark();
        found
    })
}

/// Which run it is.
fn words(what: &str, run: &RunProgress) -> String {
    if run.tolerance == 0.0 {
        return format!("{what}: run {}", run.run);
    }
    format!("{what}: pass {} (steps to {:.0e}), run {}", run.pass, run.tolerance, run.run)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::Design;
    use crate::follow::Follow;
    use crate::scenario::{Settings, simulate};

    #[test]
    fn the_clock_tells_which_run_and_how_far() {
        let design =
            Design::parse(include_str!("../../designs/huang2017-multi-arc.toml"), "multi-arc").unwrap();
        let settings = Settings { follow: Follow::new(), ..Settings::default() };
        assert_eq!(settings.follow.progress(), None, "nothing has begun");
        simulate(design.scenario("low-6").unwrap(), &settings).unwrap();
        let run = settings.follow.progress().unwrap();
        assert!(
            run.t_s > 0.29 && run.t_s <= 0.3 && run.pass >= 3 && run.run >= 1 && run.tolerance < 1e-5,
            "{run:?}"
        );
        let text = words("low-6", &RunProgress { t_s: 0.1, run: 2, pass: 3, tolerance: 1e-6 });
        assert_eq!(text, "low-6: pass 3 (steps to 1e-6), run 2");
    }
}
