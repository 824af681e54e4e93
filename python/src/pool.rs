//! Threads that compute while a Python thread waits: Ctrl-C is heard, a fork makes a pool of its own.

use crate::errors;
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError};
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use sprag_design::Follow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

/// Forks of forks of forks that each get a pool that lasts; deeper ones make one for each call.
const DEEPEST: usize = 64;
/// How often a waiting thread looks for Ctrl-C.
const LOOK_EVERY: Duration = Duration::from_millis(20);

/// How many forks lie between this process and the one that loaded the module.
static DEPTH: AtomicUsize = AtomicUsize::new(0);
/// A pool for each depth: threads do not survive a fork, and neither does a lock that another thread held just then, so the
/// child never touches what its parent had.
static POOLS: [OnceLock<ThreadPool>; DEEPEST] = [const { OnceLock::new() }; DEEPEST];

/// Called in a child right after a fork.
#[pyfunction]
pub fn forked() {
    DEPTH.fetch_add(1, Ordering::SeqCst);
}

fn made() -> PyResult<ThreadPool> {
    let pool = ThreadPoolBuilder::new().thread_name(|i| format!("sprag-design-{i}")).build();
    pool.map_err(|why| PyRuntimeError::new_err(format!("no threads to compute with: {why}")))
}

/// Compute `work` on this process's pool and wait for it. Ctrl-C stops it through `follow`, and is raised once it has ended.
pub fn compute<T: Send + 'static>(
    py: Python<'_>,
    follow: &Follow,
    work: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    let (answer, asked) = watched(py, follow, work, |_| Ok(true))?;
    asked.map_or(Ok(answer), Err)
}

/// Whether what ended a computation was Ctrl-C, so that its answer is one of a stop.
///
/// # Errors
/// Whatever else ended it.
pub fn interrupted(py: Python<'_>, asked: Option<PyErr>) -> PyResult<bool> {
    match asked {
        None => Ok(false),
        Some(why) if why.is_instance_of::<PyKeyboardInterrupt>(py) => Ok(true),
        Some(why) => Err(why),
    }
}

/// The same, and the answer of what was stopped too, with what stopped it: Ctrl-C, or an exception of `look`. That is asked meanwhile, on
/// this thread, whether to go on, and once more at the end.
pub fn watched<T: Send + 'static>(
    py: Python<'_>,
    follow: &Follow,
    work: impl FnOnce() -> T + Send + 'static,
    mut look: impl FnMut(Python<'_>) -> PyResult<bool>,
) -> PyResult<(T, Option<PyErr>)> {
    let (say, mut said) = channel();
    let task = move || {
        // A panic is an exception of the caller, not the end of the process.
        let _ = say.send(catch_unwind(AssertUnwindSafe(work)));
    };
    let own;
    match POOLS.get(DEPTH.load(Ordering::SeqCst)) {
        Some(place) => {
            if place.get().is_none() {
                // Of two threads that make one the first wins; the other pool ends unused.
                let _ = place.set(made()?);
            }
            let pool = place.get().ok_or_else(|| PyRuntimeError::new_err("no pool of threads"))?;
            pool.spawn(task);
        }
        None => {
            own = made()?;
            own.spawn(task);
        }
    }
    let (mut asked, mut going) = (None, true);
    loop {
        let (back, got) = py.detach(move || wait(said));
        said = back;
        match got {
            Ok(Ok(answer)) => {
                let asked = if going { look(py).err() } else { asked };
                return Ok((answer, asked));
            }
            Ok(Err(panic)) => return Err(errors::panicked(panic.as_ref())),
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err("the computation was lost"));
            }
            Err(RecvTimeoutError::Timeout) if asked.is_none() => {
                let on = py.check_signals().and_then(|()| if going { look(py) } else { Ok(true) });
                if !matches!(on, Ok(true)) {
                    follow.stop();
                    going = false;
                    asked = on.err();
                }
            }
            Err(RecvTimeoutError::Timeout) => {}
        }
    }
}

type Said<T> = Receiver<std::thread::Result<T>>;

fn wait<T>(said: Said<T>) -> (Said<T>, Result<std::thread::Result<T>, RecvTimeoutError>) {
    let got = said.recv_timeout(LOOK_EVERY);
    (said, got)
}
