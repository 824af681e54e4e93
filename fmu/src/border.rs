//! Where C meets the unit: strings, arrays, messages, panics.

use crate::slave::{Refused, Slave, State};
use std::any::Any;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;

/// Done.
pub const OK: c_int = 0;
/// A step came to its end early.
pub const DISCARD: c_int = 2;
/// Refused; the message says why.
pub const ERROR: c_int = 3;

/// `fmi2CallbackLogger`; what follows the message would be what its % stand for.
pub type Logger2 = unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, ...);
/// `fmi3LogMessageCallback`.
pub type Logger3 = unsafe extern "C" fn(*mut c_void, c_int, *const c_char, *const c_char);

/// The master's logger.
#[derive(Clone, Copy)]
pub enum Logger {
    Two(Logger2),
    Three(Logger3),
    Nobody,
}

/// Where messages go.
pub struct Log {
    logger: Logger,
    environment: *mut c_void,
    name: CString,
    /// Whether events are told too, and of which categories; none named: of all.
    on: bool,
    categories: Vec<String>,
}

impl Log {
    pub fn new(logger: Logger, environment: *mut c_void, name: &str, on: bool) -> Self {
        Self { logger, environment, name: string(name), on, categories: Vec::new() }
    }

    pub fn set(&mut self, on: bool, categories: Vec<String>) {
        (self.on, self.categories) = (on, categories);
    }

    pub fn error(&self, message: &str) {
        self.tell(ERROR, "logStatusError", message);
    }

    pub fn discard(&self, message: &str) {
        self.tell(DISCARD, "logStatusDiscard", message);
    }

    /// Told only to those who asked.
    pub fn event(&self, message: &str) {
        if self.on && (self.categories.is_empty() || self.categories.iter().any(|c| c == "logEvents")) {
            self.tell(OK, "logEvents", message);
        }
    }

    fn tell(&self, status: c_int, category: &str, message: &str) {
        let category = string(category);
        match self.logger {
            Logger::Two(logger) => {
                // A format: a % of our own is doubled.
                let message = string(&message.replace('%', "%%"));
                // SAFETY: the master's function, called as the standard says; strings outlive the call.
                unsafe {
                    logger(self.environment, self.name.as_ptr(), status, category.as_ptr(), message.as_ptr());
                }
            }
            Logger::Three(logger) => {
                let message = string(message);
                // SAFETY: as above.
                unsafe { logger(self.environment, status, category.as_ptr(), message.as_ptr()) }
            }
            Logger::Nobody => {}
        }
    }
}

/// One instance.
pub struct Instance {
    pub slave: Slave,
    pub log: Log,
    /// From `fmi2SetupExperiment`: start time, s, and tolerance.
    pub experiment: (f64, Option<f64>),
    /// Time that the last step has reached, s, and whether nothing leads on from there.
    pub reached: (f64, bool),
}

fn string(text: &str) -> CString {
    CString::new(text.replace('\0', " ")).unwrap_or_default()
}

/// The text at a C string; empty for null.
///
/// # Safety
/// Null, or a string that ends with NUL.
pub unsafe fn text(string: *const c_char) -> String {
    if string.is_null() {
        return String::new();
    }
    // SAFETY: not null, and the caller keeps that it ends.
    unsafe { CStr::from_ptr(string) }.to_string_lossy().into_owned()
}

/// An array of C; `None` where it is null and not empty.
///
/// # Safety
/// Null, or `count` elements that live as long as is said.
pub unsafe fn array<'a, T>(first: *const T, count: usize) -> Option<&'a [T]> {
    if count == 0 {
        return Some(&[]);
    }
    // SAFETY: not null, and the caller keeps its length and life.
    (!first.is_null()).then(|| unsafe { std::slice::from_raw_parts(first, count) })
}

/// The same, to be written.
///
/// # Safety
/// As [`array`], and nobody else has it.
pub unsafe fn array_mut<'a, T>(first: *mut T, count: usize) -> Option<&'a mut [T]> {
    if count == 0 {
        return Some(&mut []);
    }
    // SAFETY: not null, and the caller keeps its length, its life, and that it is ours.
    (!first.is_null()).then(|| unsafe { std::slice::from_raw_parts_mut(first, count) })
}

/// Write to where C wants an answer; nothing where that is null.
///
/// # Safety
/// Null, or writable.
pub unsafe fn put<T>(place: *mut T, value: T) {
    if !place.is_null() {
        // SAFETY: not null, and the caller keeps that it may be written.
        unsafe { place.write(value) }
    }
}

fn words(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|s| (*s).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default();
    format!("a fault of sprag-design, please report it: {text}")
}

/// A new instance, or null with the reason told.
pub fn instantiate(log: Log, resources: Result<PathBuf, Refused>, token: &str) -> *mut c_void {
    let made = catch_unwind(|| resources.and_then(|path| Slave::new(&path, token)));
    match made.unwrap_or_else(|panic| Err(words(panic.as_ref()))) {
        Ok(slave) => {
            let instance = Instance { slave, log, experiment: (0.0, None), reached: (0.0, false) };
            Box::into_raw(Box::new(instance)).cast()
        }
        Err(why) => {
            log.error(&why);
            std::ptr::null_mut()
        }
    }
}

/// Free an instance.
///
/// # Safety
/// Null, or one of [`instantiate`] that is used no more.
pub unsafe fn free(instance: *mut c_void) {
    if !instance.is_null() {
        // SAFETY: it came out of a box, and the caller gives it back once.
        drop(unsafe { Box::from_raw(instance.cast::<Instance>()) });
    }
}

/// Ask an instance. What it refuses, and what panics, is told and becomes an error.
///
/// # Safety
/// Null, or one of [`instantiate`] that nobody else uses meanwhile.
pub unsafe fn ask(
    instance: *mut c_void,
    question: impl FnOnce(&mut Instance) -> Result<c_int, Refused>,
) -> c_int {
    // SAFETY: null is none, else it is ours by the caller's word.
    let Some(instance) = (unsafe { instance.cast::<Instance>().as_mut() }) else { return ERROR };
    let answer = catch_unwind(AssertUnwindSafe(|| question(&mut *instance)));
    match answer.unwrap_or_else(|panic| Err(words(panic.as_ref()))) {
        Ok(status) => status,
        Err(why) => {
            instance.log.error(&why);
            ERROR
        }
    }
}

/// Said of an array or an answer that is null.
pub fn null() -> Refused {
    "found a null pointer where an array or an answer is to be".to_owned()
}

/// Said of what the unit has not.
pub fn none(what: &str) -> Refused {
    format!("{what}: this unit has none")
}

/// Keep the state of an instance in `place`, where one may be already.
///
/// # Safety
/// `place`: null, or holds null or a state of this library.
pub unsafe fn keep(instance: &Instance, place: *mut *mut c_void) -> Result<c_int, Refused> {
    // SAFETY: null is none, else it is as the caller says.
    let Some(place) = (unsafe { place.as_mut() }) else { return Err(null()) };
    let state = instance.slave.state();
    // SAFETY: null is none, else it is a state of ours.
    match unsafe { place.cast::<State>().as_mut() } {
        Some(kept) => *kept = state,
        None => *place = Box::into_raw(Box::new(state)).cast(),
    }
    Ok(OK)
}

/// The state at `kept`.
///
/// # Safety
/// Null, or a state of this library.
pub unsafe fn kept<'a>(kept: *mut c_void) -> Result<&'a State, Refused> {
    // SAFETY: null is none, else it is as the caller says.
    unsafe { kept.cast::<State>().as_ref() }.ok_or_else(null)
}

/// Free the state in `place`, which then holds null.
///
/// # Safety
/// As [`keep`].
pub unsafe fn forget(place: *mut *mut c_void) -> Result<c_int, Refused> {
    // SAFETY: null is none, else it is as the caller says.
    let Some(place) = (unsafe { place.as_mut() }) else { return Err(null()) };
    if !place.is_null() {
        // SAFETY: it came out of a box in `keep` or `written`, and is freed once: the place is null afterwards.
        drop(unsafe { Box::from_raw(place.cast::<State>()) });
        *place = std::ptr::null_mut();
    }
    Ok(OK)
}

/// A state as bytes.
pub fn bytes(state: &State) -> Result<Vec<u8>, Refused> {
    serde_json::to_vec(state).map_err(|why| format!("the state cannot be written: {why}"))
}

/// A state out of bytes, into `place`.
///
/// # Safety
/// As [`keep`].
pub unsafe fn written(bytes: &[u8], place: *mut *mut c_void) -> Result<c_int, Refused> {
    let state: State = serde_json::from_slice(bytes)
        .map_err(|why| format!("found bytes that are no state of this unit: {why}"))?;
    // SAFETY: as the caller says.
    unsafe { forget(place)? };
    // SAFETY: `forget` refuses null.
    unsafe { place.write(Box::into_raw(Box::new(state)).cast()) };
    Ok(OK)
}
