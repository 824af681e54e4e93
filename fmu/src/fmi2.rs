//! FMI 2.0.4, co-simulation: the functions of the standard (sections 2.1 and 4.2).

use crate::border::{
    DISCARD, Instance, Log, Logger, Logger2, OK, array, array_mut, ask, bytes, forget, free, instantiate,
    keep, kept, none, null, put, text, written,
};
use crate::slave::{Refused, Stepped};
use sprag_design::export::fmu::VariableType;
use std::ffi::{c_char, c_int, c_uint, c_void};
use std::path::PathBuf;

/// `fmi2CallbackFunctions`. Memory of the master is not used, steps end before they return.
#[repr(C)]
pub struct Callbacks {
    logger: Option<Logger2>,
    allocate: *const c_void,
    free: *const c_void,
    finished: *const c_void,
    environment: *mut c_void,
}

/// `fmi2CoSimulation` of `fmi2Type`.
const CO_SIMULATION: c_int = 1;

/// A path out of a URI: `file:///a%20b` or `file:/a`.
fn path(uri: &str) -> Result<PathBuf, Refused> {
    let refused = || format!("fmuResourceLocation: found {uri:?}, file:///... is allowed");
    let rest = uri.strip_prefix("file:").ok_or_else(refused)?;
    let rest = rest.strip_prefix("//localhost").or_else(|| rest.strip_prefix("//")).unwrap_or(rest);
    let (mut out, mut left) = (Vec::new(), rest.as_bytes());
    while let [first, tail @ ..] = left {
        left = tail;
        if *first == b'%' {
            let code =
                tail.get(..2).and_then(|two| u8::from_str_radix(std::str::from_utf8(two).ok()?, 16).ok());
            out.push(code.ok_or_else(refused)?);
            left = &tail[2..];
        } else {
            out.push(*first);
        }
    }
    let text = String::from_utf8(out).map_err(|_| refused())?;
    // /C:/folder
    let drive = text.as_bytes().get(2) == Some(&b':') && text.starts_with('/');
    Ok(PathBuf::from(if drive { &text[1..] } else { &text }))
}

fn stepped(instance: &mut Instance, t_s: f64, dt_s: f64) -> Result<c_int, Refused> {
    let done = instance.slave.step(t_s, dt_s)?;
    Ok(match done {
        Stepped::Whole => {
            instance.reached = (t_s + dt_s, false);
            OK
        }
        Stepped::Short(reached_s, stop, ended) => {
            instance.reached = (reached_s, ended);
            instance.log.discard(&format!(
                "the step from {t_s} s by {dt_s} s ended at {reached_s} s: {}",
                stop.name()
            ));
            DISCARD
        }
    })
}

macro_rules! getter {
    ($name:ident, $type:ty, $kind:expr, $of:expr) => {
        /// The standard's function of that name.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            c: *mut c_void,
            vr: *const c_uint,
            count: usize,
            value: *mut $type,
        ) -> c_int {
            // SAFETY: the caller keeps the contract of the standard; null is refused.
            unsafe {
                ask(c, |i| {
                    let (vr, value) =
                        (array(vr, count).ok_or_else(null)?, array_mut(value, count).ok_or_else(null)?);
                    i.slave.get(vr, $kind, |at, x| value[at] = $of(x))?;
                    Ok(OK)
                })
            }
        }
    };
}

macro_rules! setter {
    ($name:ident, $type:ty, $kind:expr, $of:expr) => {
        /// The standard's function of that name.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            c: *mut c_void,
            vr: *const c_uint,
            count: usize,
            value: *const $type,
        ) -> c_int {
            // SAFETY: the caller keeps the contract of the standard; null is refused.
            unsafe {
                ask(c, |i| {
                    let (vr, value) =
                        (array(vr, count).ok_or_else(null)?, array(value, count).ok_or_else(null)?);
                    vr.iter().zip(value).try_for_each(|(vr, x)| i.slave.set(*vr, $kind, $of(*x)))?;
                    Ok(OK)
                })
            }
        }
    };
}

getter!(fmi2GetReal, f64, VariableType::Real, |x: f64| x);
getter!(fmi2GetInteger, c_int, VariableType::Integer, |x: f64| x as c_int);
getter!(fmi2GetBoolean, c_int, VariableType::Boolean, |x: f64| c_int::from(x != 0.0));
setter!(fmi2SetReal, f64, VariableType::Real, |x: f64| x);
setter!(fmi2SetInteger, c_int, VariableType::Integer, f64::from);
setter!(fmi2SetBoolean, c_int, VariableType::Boolean, |x: c_int| f64::from(u8::from(x != 0)));

macro_rules! functions {
    ($($name:ident($c:ident $(, $arg:ident: $type:ty)*) |$i:ident| $body:expr;)*) => { $(
        /// The standard's function of that name.
        #[unsafe(no_mangle)]
        #[allow(unused_unsafe, unused_variables, reason = "not every question has arguments that it uses")]
        pub unsafe extern "C" fn $name($c: *mut c_void $(, $arg: $type)*) -> c_int {
            // SAFETY: the caller keeps the contract of the standard; null is refused.
            unsafe { ask($c, |$i| $body) }
        }
    )* };
}

functions! {
    fmi2SetDebugLogging(c, on: c_int, count: usize, categories: *const *const c_char) |i| {
        // SAFETY: the caller keeps length and strings.
        let names = unsafe { array(categories, count).ok_or_else(null)?.iter().map(|name| text(*name)).collect() };
        i.log.set(on != 0, names);
        Ok(OK)
    };
    fmi2SetupExperiment(c, tolerance_defined: c_int, tolerance: f64, start_s: f64, stop_defined: c_int, stop_s: f64) |i| {
        i.experiment = (start_s, (tolerance_defined != 0).then_some(tolerance));
        Ok(OK)
    };
    fmi2EnterInitializationMode(c) |i| {
        let (start_s, tolerance) = i.experiment;
        i.slave.begin(start_s, tolerance)?;
        i.reached = (start_s, false);
        i.log.event(&format!("begins at {start_s} s"));
        Ok(OK)
    };
    fmi2ExitInitializationMode(c) |i| { i.slave.run()?; Ok(OK) };
    fmi2Terminate(c) |i| { i.slave.terminate(); Ok(OK) };
    fmi2Reset(c) |i| { i.slave.reset(); i.experiment = (0.0, None); i.reached = (0.0, false); Ok(OK) };
    fmi2GetString(c, vr: *const c_uint, count: usize, value: *mut *const c_char) |i| {
        if count == 0 { Ok(OK) } else { Err(none("variables that are strings")) }
    };
    fmi2SetString(c, vr: *const c_uint, count: usize, value: *const *const c_char) |i| {
        if count == 0 { Ok(OK) } else { Err(none("variables that are strings")) }
    };
    fmi2GetFMUstate(c, state: *mut *mut c_void) |i| {
        // SAFETY: a state is one that this library has given out.
        unsafe { keep(i, state) }
    };
    fmi2SetFMUstate(c, state: *mut c_void) |i| {
        // SAFETY: as above.
        i.slave.restore(unsafe { kept(state)? })?;
        Ok(OK)
    };
    fmi2FreeFMUstate(c, state: *mut *mut c_void) |i| {
        // SAFETY: as above.
        unsafe { forget(state) }
    };
    fmi2SerializedFMUstateSize(c, state: *mut c_void, size: *mut usize) |i| {
        // SAFETY: as above; null is left alone.
        unsafe { put(size, bytes(kept(state)?)?.len()) };
        Ok(OK)
    };
    fmi2SerializeFMUstate(c, state: *mut c_void, out: *mut u8, size: usize) |i| {
        // SAFETY: as above; `out` is as long as said.
        let (bytes, out) = unsafe { (bytes(kept(state)?)?, array_mut(out, size).ok_or_else(null)?) };
        let place = out.get_mut(..bytes.len());
        place.ok_or_else(|| format!("found room for {size} bytes, the state has {}", bytes.len()))?.copy_from_slice(&bytes);
        Ok(OK)
    };
    fmi2DeSerializeFMUstate(c, bytes: *const u8, size: usize, state: *mut *mut c_void) |i| {
        // SAFETY: `bytes` are as many as said, and the state as above.
        unsafe { written(array(bytes, size).ok_or_else(null)?, state) }
    };
    fmi2GetDirectionalDerivative(
        c, unknown: *const c_uint, unknowns: usize, known: *const c_uint, knowns: usize, seed: *const f64, out: *mut f64
    ) |i| Err(none("directional derivatives"));
    fmi2SetRealInputDerivatives(c, vr: *const c_uint, count: usize, order: *const c_int, value: *const f64) |i| {
        // SAFETY: arrays are as long as said.
        let (vr, order, value) = unsafe { (array(vr, count), array(order, count), array(value, count)) };
        let (vr, order, value) = (vr.ok_or_else(null)?, order.ok_or_else(null)?, value.ok_or_else(null)?);
        vr.iter().zip(order).zip(value).try_for_each(|((vr, order), x)| i.slave.set_slope(*vr, *order, *x))?;
        Ok(OK)
    };
    fmi2GetRealOutputDerivatives(c, vr: *const c_uint, count: usize, order: *const c_int, value: *mut f64) |i| {
        if count == 0 { Ok(OK) } else { Err(none("derivatives of outputs")) }
    };
    fmi2DoStep(c, t_s: f64, dt_s: f64, no_return: c_int) |i| stepped(i, t_s, dt_s);
    fmi2CancelStep(c) |i| Err(none("steps that are not over when they return"));
    fmi2GetStatus(c, kind: c_int, value: *mut c_int) |i| Err(none("steps that are not over when they return"));
    fmi2GetRealStatus(c, kind: c_int, value: *mut f64) |i| {
        // fmi2LastSuccessfulTime
        if kind != 2 {
            return Err(none("that status"));
        }
        // SAFETY: null or writable.
        unsafe { put(value, i.reached.0) };
        Ok(OK)
    };
    fmi2GetIntegerStatus(c, kind: c_int, value: *mut c_int) |i| Err(none("a status that is a whole number"));
    fmi2GetBooleanStatus(c, kind: c_int, value: *mut c_int) |i| {
        // fmi2Terminated
        if kind != 3 {
            return Err(none("that status"));
        }
        // SAFETY: null or writable.
        unsafe { put(value, c_int::from(i.reached.1)) };
        Ok(OK)
    };
    fmi2GetStringStatus(c, kind: c_int, value: *mut *const c_char) |i| Err(none("a status that is a text"));
}

/// `"default"`: the usual types of C.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

/// `"2.0"`.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

/// The standard's function of that name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Instantiate(
    name: *const c_char,
    kind: c_int,
    guid: *const c_char,
    resources: *const c_char,
    callbacks: *const Callbacks,
    _visible: c_int,
    logging: c_int,
) -> *mut c_void {
    // SAFETY: null, or strings and callbacks as the standard says.
    let (name, guid, resources, callbacks) =
        unsafe { (text(name), text(guid), text(resources), callbacks.as_ref()) };
    let logger = callbacks.and_then(|c| c.logger).map_or(Logger::Nobody, Logger::Two);
    let environment = callbacks.map_or(std::ptr::null_mut(), |c| c.environment);
    let log = Log::new(logger, environment, &name, logging != 0);
    let resources = if kind == CO_SIMULATION { path(&resources) } else { Err(none("model exchange")) };
    instantiate(log, resources, &guid)
}

/// The standard's function of that name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(c: *mut c_void) {
    // SAFETY: null, or an instance that is used no more.
    unsafe { free(c) }
}

#[cfg(test)]
mod tests {
    use super::path;

    #[test]
    fn a_uri_is_a_path() {
        for (uri, expected) in [
            ("file:///tmp/a%20b/resources", "/tmp/a b/resources"),
            ("file:/tmp/x", "/tmp/x"),
            ("file://localhost/tmp/x", "/tmp/x"),
            ("file:///C:/x", "C:/x"),
            ("file:///tmp/%C3%BC", "/tmp/\u{fc}"),
        ] {
            assert_eq!(path(uri).unwrap().to_str(), Some(expected), "{uri}");
        }
        for bad in ["", "/tmp/x", "http://x/y", "file:///a%2", "file:///a%zz", "file:///%ff"] {
            assert!(path(bad).is_err(), "{bad}");
        }
    }
}
