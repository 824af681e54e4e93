//! A search of the optimiser beside the page: begun, followed, stopped.

use crate::answer::search::{Hints, SearchSettings};
use crate::design::Design;
use crate::follow::{Follow, News};
use serde_json::{Value, json};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// How a search stands.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct SearchProgress {
    /// Whether it goes on.
    pub running: bool,
    /// In one sentence.
    pub words: String,
    /// The design file found.
    pub text: Option<String>,
}

impl SearchProgress {
    /// As the page is told.
    pub fn told(&self) -> Value {
        json!({ "running": self.running, "said": self.words, "text": self.text })
    }
}

#[derive(Debug)]
struct SearchState {
    follow: Follow,
    evaluations: AtomicUsize,
    done: Mutex<Option<SearchProgress>>,
}

/// A search that runs in a thread of its own.
#[derive(Debug, Clone)]
pub struct Searching(Arc<SearchState>);

impl Searching {
    /// Begin it.
    pub fn begin(design: Design) -> Self {
        let mine = Self(Arc::new(SearchState {
            follow: Follow::new(),
            evaluations: AtomicUsize::new(0),
            done: Mutex::default(),
        }));
        let shared = mine.0.clone();
        std::thread::spawn(move || {
            let end = tell(&design, &shared);
            *shared.done.lock().unwrap_or_else(PoisonError::into_inner) = Some(end);
        });
        mine
    }

    /// End it at the next safe point.
    pub fn stop(&self) {
        self.0.follow.stop();
    }

    /// How it stands.
    pub fn progress(&self) -> SearchProgress {
        let done = self.0.done.lock().unwrap_or_else(PoisonError::into_inner).clone();
        done.unwrap_or_else(|| {
            let words = format!("searching: {} evaluations", self.0.evaluations.load(Ordering::Relaxed));
            SearchProgress { running: true, words, text: None }
        })
    }
}

fn tell(design: &Design, shared: &Arc<SearchState>) -> SearchProgress {
    let counter = shared.clone();
    let follow = shared.follow.telling(move |news| {
        counter.evaluations.fetch_add(usize::from(news == News::Done), Ordering::Relaxed);
    });
    match design.optimise(&SearchSettings { follow, ..SearchSettings::default() }) {
        Ok(answer) => {
            let story = &answer.story;
            let words = story.verdict(&Hints::default());
            SearchProgress { running: false, words, text: Some(story.file().to_owned()) }
        }
        Err(why) => SearchProgress { running: false, words: format!("no search: {why}"), text: None },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn a_search_can_be_followed_and_stopped() {
        let text = include_str!("../../designs/huang2017-multi-arc.toml");
        let design = Design::parse(text, "a.toml").unwrap();
        let searching = Searching::begin(design);
        let mut solved = searching.progress();
        assert!(solved.running);
        while solved.running && !solved.words.contains("searching: 1") {
            std::thread::sleep(Duration::from_millis(5));
            solved = searching.progress();
        }
        searching.stop();
        while solved.running {
            std::thread::sleep(Duration::from_millis(5));
            solved = searching.progress();
        }
        assert!(solved.words.contains("evaluations") || solved.words.contains("stopped"), "{}", solved.words);
    }
}
