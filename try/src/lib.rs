//! The studio's engine for a page without a server: texts in and out of WebAssembly's memory.
//!
//! The page writes a question (JSON: `ask` and `question`) at [`room`], calls [`answer`], and reads the answer (JSON: `found`, or
//! `refused` as the server would refuse it). One thread, one question at a time.

use serde_json::{Value, json};
use sprag_design::scenario::Settings;
use sprag_design::studio::Engine;
use std::cell::RefCell;
use std::path::PathBuf;

thread_local! {
    static ENGINE: Engine = Engine::new("design.toml", PathBuf::new());
    static TEXT: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Room for a question of `bytes` bytes of UTF-8; good until the next call of any function here.
// SAFETY: no other symbol of this name is linked.
#[unsafe(no_mangle)]
pub extern "C" fn room(bytes: usize) -> *mut u8 {
    TEXT.with_borrow_mut(|text| {
        text.clear();
        text.resize(bytes, 0);
        text.as_mut_ptr()
    })
}

/// Answers the question in the room; bytes of the answer, which [`answered`] gives.
// SAFETY: no other symbol of this name is linked.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> usize {
    let question = TEXT.take();
    let found = match serde_json::from_slice::<Value>(&question) {
        Ok(asked) => ENGINE.with(|engine| {
            let ask = asked["ask"].as_str().unwrap_or_default();
            match engine.ask(ask, &asked["question"], &Settings::default()) {
                Ok(found) => json!({ "found": found }),
                Err(refused) => json!({ "refused": refused }),
            }
        }),
        Err(why) => json!({ "refused": { "message": why.to_string(), "problems": null } }),
    };
    TEXT.set(found.to_string().into_bytes());
    TEXT.with_borrow(Vec::len)
}

/// The page itself, for who composes the file; bytes of it, which [`answered`] gives.
// SAFETY: no other symbol of this name is linked.
#[unsafe(no_mangle)]
pub extern "C" fn page() -> usize {
    TEXT.set(sprag_design::studio::page().into_bytes());
    TEXT.with_borrow(Vec::len)
}

/// Where the last answer stands.
// SAFETY: no other symbol of this name is linked.
#[unsafe(no_mangle)]
pub extern "C" fn answered() -> *const u8 {
    TEXT.with_borrow(|text| text.as_ptr())
}
