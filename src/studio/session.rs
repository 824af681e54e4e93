//! One open file and the pages that ask about it: the newest question of each, one search for all, what is to be saved.

use super::engine::{Engine, StudioRefusal};
use super::search::Searching;
use crate::answer::{VERSION, WRITTEN_BY};
use crate::design::Design;
use crate::file::shown;
use crate::follow::Follow;
use crate::scenario::Settings;
use serde_json::{Value, json};
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// An open file. Shared between threads: each question is answered beside the others.
#[derive(Debug)]
pub struct Session {
    engine: Engine,
    text: String,
    file: String,
    save_as: String,
    searching: Mutex<Option<Searching>>,
    /// What a page asked last, by page and kind of question.
    asked: Mutex<HashMap<String, Follow>>,
}

/// A design that a page asks to be saved.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ToSave {
    /// A plain file name that ends in .toml.
    pub name: String,
    /// The file, its first line saying who wrote it.
    pub text: String,
    /// Whether a file that is there may be replaced.
    pub replace: bool,
}

/// Pages that are remembered; one that has been closed asks nothing more.
const MOST_PAGES: usize = 1000;

fn locked<T>(of: &Mutex<T>) -> MutexGuard<'_, T> {
    of.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Session {
    /// Of the design `text` in `file`, whose histories lie in `folder`; `save_as`: the name that a page offers.
    pub fn new(text: String, file: &str, folder: PathBuf, save_as: String) -> Self {
        let engine = Engine::new(file, folder);
        let (searching, asked) = <_>::default();
        Self { engine, text, file: file.to_owned(), save_as, searching, asked }
    }

    /// A question as the page puts it, saving apart: `ask` names it, `question` is an object of texts. One of a kind that the same page
    /// asked before is stopped.
    ///
    /// # Errors
    /// An object with `message` and `problems`.
    pub fn ask(&self, ask: &str, question: &Value) -> Result<Value, Value> {
        match ask {
            "open" => Ok(json!({ "text": self.text, "file": self.file, "save_as": self.save_as })),
            "optimise" => self.optimise(question).map_err(StudioRefusal::into_json),
            "progress" => Ok(self.progress()),
            "stop" => {
                locked(&self.searching).iter().for_each(Searching::stop);
                Ok(Value::Null)
            }
            _ => {
                let settings = Settings { follow: self.newest(ask, question), ..Settings::default() };
                self.engine.ask(ask, question, &settings)
            }
        }
    }

    /// What a page asks to be saved; only what is a design, only under a plain name.
    ///
    /// # Errors
    /// As [`Self::ask`].
    pub fn to_save(&self, question: &Value) -> Result<ToSave, Value> {
        let save = || {
            let design = self.design(question)?;
            let text = |key: &str| question.get(key).and_then(Value::as_str).unwrap_or("").trim();
            let name = std::path::Path::new(text("name"));
            if name.file_name().is_none_or(|own| own != name.as_os_str()) {
                return Err(StudioRefusal::new(
                    "give a plain file name; it is written into the folder of the file that is open",
                ));
            }
            if name.extension().is_none_or(|e| e != "toml") {
                return Err(StudioRefusal::new("let the name end in .toml: a design file is written there"));
            }
            let head = match design.source.starts_with(WRITTEN_BY) {
                true => String::new(),
                false => format!("{WRITTEN_BY} {VERSION} studio from {}.\n", shown(&self.file)),
            };
            let text_of = head + &design.source;
            Ok(ToSave { name: text("name").to_owned(), text: text_of, replace: text("replace") == "yes" })
        };
        save().map_err(StudioRefusal::into_json)
    }

    /// Stop whatever is computed, the search too.
    pub fn stop(&self) {
        locked(&self.searching).iter().for_each(Searching::stop);
        locked(&self.asked).values().for_each(|follow| {
            follow.stop();
        });
    }

    /// Stops the question of this kind that the same page asked before, and can be stopped by the next.
    fn newest(&self, ask: &str, question: &Value) -> Follow {
        let page = question.get("page").and_then(Value::as_str).unwrap_or("");
        let mine = Follow::new();
        let mut asked = locked(&self.asked);
        if asked.len() > MOST_PAGES {
            asked.clear();
        }
        if let Some(before) = asked.insert(format!("{page} {ask}"), mine.clone()) {
            before.stop();
        }
        mine
    }

    fn optimise(&self, question: &Value) -> Result<Value, StudioRefusal> {
        let mut searching = locked(&self.searching);
        if searching.as_ref().is_some_and(|s| s.progress().running) {
            let why = "a search is running already, from this page or another; stop it first";
            return Err(StudioRefusal::new(why));
        }
        let begun = Searching::begin(self.design(question)?);
        let said = begun.progress().told();
        *searching = Some(begun);
        Ok(said)
    }

    fn progress(&self) -> Value {
        let none = || json!({ "running": false, "said": "no search was begun", "text": null });
        locked(&self.searching).as_ref().map_or_else(none, |search| search.progress().told())
    }

    fn design(&self, question: &Value) -> Result<Design, StudioRefusal> {
        let text = question.get("text").and_then(Value::as_str);
        self.engine.design(text.ok_or_else(|| StudioRefusal::new("the question has no text"))?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DESIGN: &str = include_str!("../../designs/huang2017-multi-arc.toml");

    #[test]
    fn a_design_alone_is_saved_under_a_plain_name_and_says_who_wrote_it() {
        let session = Session::new(DESIGN.to_owned(), "a.toml", "designs".into(), "b.toml".to_owned());
        assert_eq!(session.ask("open", &Value::Null).unwrap()["save_as"], "b.toml");
        let save = |text: &str, name: &str| {
            session.to_save(&json!({ "text": text, "name": name, "replace": "yes" }))
        };
        let saved = save(DESIGN, "mine.toml").unwrap();
        assert!(saved.replace && saved.text.starts_with(WRITTEN_BY) && saved.text.ends_with(DESIGN));
        assert_eq!(save(&saved.text, "mine.toml").unwrap().text, saved.text, "no second head");
        for (text, name) in
            [("a = 1", "mine.toml"), (DESIGN, "../mine.toml"), (DESIGN, "mine.txt"), (DESIGN, "")]
        {
            assert!(save(text, name).unwrap_err()["message"].is_string(), "{name}");
        }
    }

    #[test]
    fn the_newest_question_of_a_page_stops_the_one_before() {
        let session = Session::new(DESIGN.to_owned(), "a.toml", "designs".into(), "b.toml".to_owned());
        let newest = |page: &str, ask: &str| session.newest(ask, &json!({ "page": page }));
        let (first, other, kind) = (newest("1", "scene"), newest("2", "scene"), newest("1", "check"));
        let second = newest("1", "scene");
        assert_eq!([&first, &other, &kind, &second].map(Follow::stopped), [true, false, false, false]);
        session.stop();
        assert!(other.stopped() && kind.stopped() && second.stopped());
    }
}
