//! Searches: followed, stopped, kept in a journal.

use crate::design::{Design, common, stopped};
use crate::errors::{self, json};
use crate::pool::{interrupted, watched};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use serde_json::json as object;
use sprag_design::answer::search::{NEAREST, ROBUST, SearchAnswer, SearchSettings, SearchSoFar};
use sprag_design::cli::journal::JournalFile;
use sprag_design::design::Objective;
use sprag_design::journal::model;
use sprag_design::optimise::{Entry, Iteration, Journal, ProblemId, Record};
use sprag_design::{Follow, NoSearch};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// How far the search is, for the thread that waits and those that search.
#[derive(Clone, Default)]
struct Shared(Arc<Mutex<SearchSoFar>>);

impl Shared {
    fn now(&self) -> MutexGuard<'_, SearchSoFar> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Progress of climbs, and the journal.
struct Keeper {
    so_far: Shared,
    file: Option<JournalFile>,
}

impl Record for Keeper {
    fn known(&mut self, problem: &ProblemId) -> Journal {
        self.file.as_ref().map_or_else(Journal::default, |file| file.known(problem))
    }

    fn evaluated(&mut self, problem: &ProblemId, entry: &Entry) {
        if let Some(file) = &mut self.file {
            file.append(problem, entry);
        }
    }

    fn iterated(&mut self, it: &Iteration) {
        self.so_far.now().see(it);
    }
}

/// What a search tells: how far it is, as JSON.
fn told(so_far: &SearchSoFar) -> PyResult<String> {
    let last = so_far.last.as_ref();
    json(&object!({
        "part": so_far.part,
        "evaluations": so_far.evaluations,
        "best": so_far.best,
        "least_margin": last.map(|it| it.least_margin),
        "violation": last.map(|it| it.violation),
        "violated": last.map(|it| it.violated),
        "words": so_far.words(),
    }))
}

/// Common keys and figures as JSON, the design found, the robust one, what is said of the journal, and whether Ctrl-C ended it.
type Searched = (String, String, Design, Option<Design>, Vec<String>, bool);

/// Search for a better design. `by`: who asked, for the head of its file; `progress` gets how far it is as JSON, and says whether to go on.
#[pyfunction]
pub fn optimize(
    py: Python<'_>,
    design: &Bound<'_, Design>,
    evaluations: usize,
    starts: Option<usize>,
    swarm: Option<usize>,
    tolerance: f64,
    full: bool,
    step_mm: Option<f64>,
    reserve: Option<f64>,
    front: Vec<String>,
    front_steps: usize,
    robust: bool,
    draws: usize,
    journal: Option<PathBuf>,
    by: String,
    progress: Option<Py<PyAny>>,
) -> PyResult<Searched> {
    let asked = design.get();
    let aims = front.iter().map(|aim| aim.parse::<Objective>()).collect::<Result<Vec<_>, _>>();
    let aims = aims.map_err(|why| PyValueError::new_err(format!("objectives {front:?}: {why}")))?;
    let stop = Follow::new();
    let so_far = Shared::default();
    let hears = so_far.clone();
    let ask = SearchSettings {
        evaluations,
        starts,
        swarm,
        tolerance,
        full,
        step_mm,
        reserve,
        front: aims,
        front_steps,
        robust,
        draws,
        follow: stop.telling(move |news| hears.now().hear(news)),
    };
    let refused = |why: NoSearch| PyValueError::new_err(format!("{}: {why}", asked.file));
    ask.validate(&asked.design).map_err(refused)?;
    if asked.design.optimize.is_none() {
        return Err(refused(NoSearch::NoTask));
    }
    let file = journal.map(|path| {
        py.detach(|| JournalFile::open(&path, &model(), &asked.design.content_hash()))
            .map_err(|why| errors::failed(&why))
    });
    let mut keeper = Keeper { so_far: so_far.clone(), file: file.transpose()? };
    let searched = Arc::clone(&asked.design);
    let work = move || {
        let started = Instant::now();
        let found = searched.optimise_recorded(&ask, &mut keeper);
        (found, started.elapsed().as_secs_f64(), keeper.file.map_or_else(Vec::new, |file| said(&file)))
    };
    let mut last = SearchSoFar::default();
    let look = |py: Python<'_>| {
        let now = so_far.now().clone();
        let Some(progress) = progress.as_ref().filter(|_| now.evaluations > 0 && now != last) else {
            return Ok(true);
        };
        last = now;
        progress.call1(py, (told(&last)?,))?.extract(py)
    };
    let ((found, seconds, said), why) = watched(py, &stop, work, look)?;
    let found = match (found, why) {
        (Err(NoSearch::Stopped), Some(why)) => return Err(why),
        (found, why) => (found, interrupted(py, why)?),
    };
    match found {
        (Ok(found), interrupted) => {
            let common = common(seconds, &found.left_out, object!(found.body.objective_error))?;
            let (best, robust) = designs(py, asked, &found, &by)?;
            Ok((common, json(&found.body)?, best, robust, said, interrupted))
        }
        (Err(NoSearch::Stopped), _) => Err(stopped()),
        (Err(why @ (NoSearch::Start(_) | NoSearch::Outside { .. })), _) => Err(errors::no_clutch(py, &why)),
        (Err(why), _) => Err(refused(why)),
    }
}

/// What is to be said of a journal.
fn said(file: &JournalFile) -> Vec<String> {
    let failed = file.failed.as_ref().map(|why| {
        format!("{}: {why}; evaluations from there on are not in the journal", file.path().display())
    });
    file.unused().into_iter().chain(failed).collect()
}

/// The design found and the robust one: the files that the command writes, where the search is worth any.
fn designs(
    py: Python<'_>,
    asked: &Design,
    found: &SearchAnswer,
    by: &str,
) -> PyResult<(Design, Option<Design>)> {
    let own = |text: &str| asked.in_place(py, text);
    let files = found.files(&asked.design, by);
    let written = |middle: Option<&str>| {
        let file = files.iter().find(|file| file.middle == middle);
        file.and_then(|file| file.text.as_ref().ok()).map(String::as_str)
    };
    let best = written(None).or_else(|| written(Some(NEAREST))).unwrap_or_else(|| found.story.file());
    let robust = found.story.robust.as_ref().map(|robust| written(Some(ROBUST)).unwrap_or(&robust.file));
    Ok((own(best)?, robust.map(own).transpose()?))
}
