//! FMI 3.0.1, co-simulation: the functions of the standard (sections 2.2 and 4.2).

use crate::border::{
    DISCARD, Log, Logger, Logger3, OK, array, array_mut, ask, bytes, forget, free, instantiate, keep, kept,
    none, null, put, text, written,
};
use crate::slave::Stepped;
use sprag_design::export::fmu::VariableType;
use std::ffi::{c_char, c_int, c_uint, c_void};
use std::path::PathBuf;

macro_rules! getter {
    ($name:ident, $type:ty, $kind:expr, $of:expr) => {
        /// The standard's function of that name.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            c: *mut c_void,
            vr: *const c_uint,
            count: usize,
            value: *mut $type,
            values: usize,
        ) -> c_int {
            // SAFETY: the caller keeps the contract of the standard; null is refused.
            unsafe {
                ask(c, |i| {
                    if count != values {
                        return Err(format!(
                            "found {count} value references and {values} values: all are scalars"
                        ));
                    }
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
            values: usize,
        ) -> c_int {
            // SAFETY: the caller keeps the contract of the standard; null is refused.
            unsafe {
                ask(c, |i| {
                    if count != values {
                        return Err(format!(
                            "found {count} value references and {values} values: all are scalars"
                        ));
                    }
                    let (vr, value) =
                        (array(vr, count).ok_or_else(null)?, array(value, count).ok_or_else(null)?);
                    vr.iter().zip(value).try_for_each(|(vr, x)| i.slave.set(*vr, $kind, $of(*x)))?;
                    Ok(OK)
                })
            }
        }
    };
}

// A byte of C's bool: what is not 0 is true.
getter!(fmi3GetFloat64, f64, VariableType::Real, |x: f64| x);
getter!(fmi3GetInt32, i32, VariableType::Integer, |x: f64| x as i32);
getter!(fmi3GetBoolean, u8, VariableType::Boolean, |x: f64| u8::from(x != 0.0));
setter!(fmi3SetFloat64, f64, VariableType::Real, |x: f64| x);
setter!(fmi3SetInt32, i32, VariableType::Integer, f64::from);
setter!(fmi3SetBoolean, u8, VariableType::Boolean, |x: u8| f64::from(u8::from(x != 0)));

/// Functions of the standard.
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

/// Getters and setters of types that no variable has.
macro_rules! absent {
    ($($name:ident $what:literal;)*) => { functions! { $(
        $name(c, vr: *const c_uint, count: usize, value: *mut c_void, values: usize) |i| {
            if count == 0 { Ok(OK) } else { Err(none($what)) }
        };
    )* } };
}

absent! {
    fmi3GetFloat32 "variables of that type"; fmi3SetFloat32 "variables of that type";
    fmi3GetInt8 "variables of that type"; fmi3SetInt8 "variables of that type";
    fmi3GetUInt8 "variables of that type"; fmi3SetUInt8 "variables of that type";
    fmi3GetInt16 "variables of that type"; fmi3SetInt16 "variables of that type";
    fmi3GetUInt16 "variables of that type"; fmi3SetUInt16 "variables of that type";
    fmi3GetUInt32 "variables of that type"; fmi3SetUInt32 "variables of that type";
    fmi3GetInt64 "variables of that type"; fmi3SetInt64 "variables of that type";
    fmi3GetUInt64 "variables of that type"; fmi3SetUInt64 "variables of that type";
    fmi3GetString "variables of that type"; fmi3SetString "variables of that type";
}

functions! {
    fmi3SetDebugLogging(c, on: u8, count: usize, categories: *const *const c_char) |i| {
        // SAFETY: the caller keeps length and strings.
        let names = unsafe { array(categories, count).ok_or_else(null)?.iter().map(|name| text(*name)).collect() };
        i.log.set(on != 0, names);
        Ok(OK)
    };
    fmi3EnterInitializationMode(c, tolerance_defined: u8, tolerance: f64, start_s: f64, stop_defined: u8, stop_s: f64) |i| {
        i.slave.begin(start_s, (tolerance_defined != 0).then_some(tolerance))?;
        i.reached = (start_s, false);
        i.log.event(&format!("begins at {start_s} s"));
        Ok(OK)
    };
    fmi3ExitInitializationMode(c) |i| { i.slave.run()?; Ok(OK) };
    fmi3Terminate(c) |i| { i.slave.terminate(); Ok(OK) };
    fmi3Reset(c) |i| { i.slave.reset(); i.reached = (0.0, false); Ok(OK) };
    fmi3GetFMUState(c, state: *mut *mut c_void) |i| {
        // SAFETY: a state is one that this library has given out.
        unsafe { keep(i, state) }
    };
    fmi3SetFMUState(c, state: *mut c_void) |i| {
        // SAFETY: as above.
        i.slave.restore(unsafe { kept(state)? })?;
        Ok(OK)
    };
    fmi3FreeFMUState(c, state: *mut *mut c_void) |i| {
        // SAFETY: as above.
        unsafe { forget(state) }
    };
    fmi3SerializedFMUStateSize(c, state: *mut c_void, size: *mut usize) |i| {
        // SAFETY: as above; null is left alone.
        unsafe { put(size, bytes(kept(state)?)?.len()) };
        Ok(OK)
    };
    fmi3SerializeFMUState(c, state: *mut c_void, out: *mut u8, size: usize) |i| {
        // SAFETY: as above; `out` is as long as said.
        let (bytes, out) = unsafe { (bytes(kept(state)?)?, array_mut(out, size).ok_or_else(null)?) };
        let place = out.get_mut(..bytes.len());
        place.ok_or_else(|| format!("found room for {size} bytes, the state has {}", bytes.len()))?.copy_from_slice(&bytes);
        Ok(OK)
    };
    fmi3DeserializeFMUState(c, bytes: *const u8, size: usize, state: *mut *mut c_void) |i| {
        // SAFETY: `bytes` are as many as said, and the state as above.
        unsafe { written(array(bytes, size).ok_or_else(null)?, state) }
    };
    fmi3DoStep(
        c, t_s: f64, dt_s: f64, no_return: u8, event: *mut u8, terminate: *mut u8, early: *mut u8, reached_s: *mut f64
    ) |i| {
        let done = i.slave.step(t_s, dt_s)?;
        let (reached, ended) = match done {
            Stepped::Whole => (t_s + dt_s, false),
            Stepped::Short(reached, _, ended) => (reached, ended),
        };
        i.reached = (reached, ended);
        // SAFETY: null is left alone, the rest is the caller's to be written.
        unsafe {
            put(event, 0);
            put(terminate, u8::from(ended));
            put(early, 0);
            put(reached_s, reached);
        }
        if let Stepped::Short(_, stop, _) = done {
            i.log.discard(&format!("the step from {t_s} s by {dt_s} s ended at {reached} s: {}", stop.name()));
        }
        // What has come to its end says so by `terminate`.
        Ok(if done == Stepped::Whole || ended { OK } else { DISCARD })
    };
    fmi3EnterConfigurationMode(c) |i| Err(none("structural parameters"));
    fmi3ExitConfigurationMode(c) |i| Err(none("structural parameters"));
    fmi3EnterEventMode(c) |i| Err(none("an event mode"));
    fmi3EnterStepMode(c) |i| Err(none("an event mode"));
    fmi3EvaluateDiscreteStates(c) |i| Err(none("an event mode"));
    fmi3UpdateDiscreteStates(
        c, again: *mut u8, terminate: *mut u8, nominals: *mut u8, values: *mut u8, next: *mut u8, next_s: *mut f64
    ) |i| Err(none("an event mode"));
    fmi3GetBinary(c, vr: *const c_uint, count: usize, sizes: *mut usize, value: *mut c_void, values: usize) |i| {
        if count == 0 { Ok(OK) } else { Err(none("variables of that type")) }
    };
    fmi3SetBinary(c, vr: *const c_uint, count: usize, sizes: *const usize, value: *const c_void, values: usize) |i| {
        if count == 0 { Ok(OK) } else { Err(none("variables of that type")) }
    };
    fmi3GetClock(c, vr: *const c_uint, count: usize, value: *mut u8) |i| {
        if count == 0 { Ok(OK) } else { Err(none("clocks")) }
    };
    fmi3SetClock(c, vr: *const c_uint, count: usize, value: *const u8) |i| {
        if count == 0 { Ok(OK) } else { Err(none("clocks")) }
    };
    fmi3GetIntervalDecimal(c, vr: *const c_uint, count: usize, a: *mut f64, b: *mut c_int) |i| Err(none("clocks"));
    fmi3GetIntervalFraction(c, vr: *const c_uint, count: usize, a: *mut u64, b: *mut u64, q: *mut c_int) |i| Err(none("clocks"));
    fmi3GetShiftDecimal(c, vr: *const c_uint, count: usize, a: *mut f64) |i| Err(none("clocks"));
    fmi3GetShiftFraction(c, vr: *const c_uint, count: usize, a: *mut u64, b: *mut u64) |i| Err(none("clocks"));
    fmi3SetIntervalDecimal(c, vr: *const c_uint, count: usize, a: *const f64) |i| Err(none("clocks"));
    fmi3SetIntervalFraction(c, vr: *const c_uint, count: usize, a: *const u64, b: *const u64) |i| Err(none("clocks"));
    fmi3SetShiftDecimal(c, vr: *const c_uint, count: usize, a: *const f64) |i| Err(none("clocks"));
    fmi3SetShiftFraction(c, vr: *const c_uint, count: usize, a: *const u64, b: *const u64) |i| Err(none("clocks"));
    fmi3ActivateModelPartition(c, clock: c_uint, t_s: f64) |i| Err(none("scheduled execution"));
    fmi3GetNumberOfVariableDependencies(c, vr: c_uint, count: *mut usize) |i| Err(none("dependencies told by function"));
    fmi3GetVariableDependencies(
        c, vr: c_uint, of: *mut usize, on: *mut c_uint, elements: *mut usize, kinds: *mut c_int, count: usize
    ) |i| Err(none("dependencies told by function"));
    fmi3GetDirectionalDerivative(
        c, unknown: *const c_uint, unknowns: usize, known: *const c_uint, knowns: usize, seed: *const f64, seeds: usize,
        out: *mut f64, outs: usize
    ) |i| Err(none("directional derivatives"));
    fmi3GetAdjointDerivative(
        c, unknown: *const c_uint, unknowns: usize, known: *const c_uint, knowns: usize, seed: *const f64, seeds: usize,
        out: *mut f64, outs: usize
    ) |i| Err(none("adjoint derivatives"));
    fmi3GetOutputDerivatives(c, vr: *const c_uint, count: usize, orders: *const i32, value: *mut f64, values: usize) |i| {
        if count == 0 { Ok(OK) } else { Err(none("derivatives of outputs")) }
    };
    fmi3EnterContinuousTimeMode(c) |i| Err(none("model exchange"));
    fmi3CompletedIntegratorStep(c, no_return: u8, event: *mut u8, terminate: *mut u8) |i| Err(none("model exchange"));
    fmi3SetTime(c, t_s: f64) |i| Err(none("model exchange"));
    fmi3SetContinuousStates(c, value: *const f64, count: usize) |i| Err(none("model exchange"));
    fmi3GetContinuousStates(c, value: *mut f64, count: usize) |i| Err(none("model exchange"));
    fmi3GetContinuousStateDerivatives(c, value: *mut f64, count: usize) |i| Err(none("model exchange"));
    fmi3GetNominalsOfContinuousStates(c, value: *mut f64, count: usize) |i| Err(none("model exchange"));
    fmi3GetEventIndicators(c, value: *mut f64, count: usize) |i| Err(none("model exchange"));
    fmi3GetNumberOfEventIndicators(c, count: *mut usize) |i| Err(none("model exchange"));
    fmi3GetNumberOfContinuousStates(c, count: *mut usize) |i| Err(none("model exchange"));
}

/// `"3.0"`.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

/// The standard's function of that name. Steps do not return early by themselves, and no variable is asked for inside them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateCoSimulation(
    name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: u8,
    logging: u8,
    event_mode: u8,
    _early_return: u8,
    _intermediate: *const c_uint,
    intermediates: usize,
    environment: *mut c_void,
    logger: Option<Logger3>,
    _update: *const c_void,
) -> *mut c_void {
    // SAFETY: null, or strings as the standard says.
    let (name, token, resources) = unsafe { (text(name), text(token), text(resources)) };
    let log = Log::new(logger.map_or(Logger::Nobody, Logger::Three), environment, &name, logging != 0);
    let resources = match (event_mode, intermediates, resources.is_empty()) {
        (0, 0, false) => Ok(PathBuf::from(resources)),
        (0, 0, true) => Err("resourcePath: found none, the folder of the design is needed".to_owned()),
        (0, ..) => Err(none("variables that can be asked for inside a step")),
        _ => Err(none("an event mode")),
    };
    instantiate(log, resources, &token)
}

macro_rules! other_kinds {
    ($($name:ident($($arg:ident: $type:ty),*) $what:literal;)*) => { $(
        /// The standard's function of that name: null.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            name: *const c_char, _token: *const c_char, _resources: *const c_char, _visible: u8, logging: u8,
            environment: *mut c_void, logger: Option<Logger3> $(, $arg: $type)*
        ) -> *mut c_void {
            // SAFETY: null, or a string as the standard says.
            let name = unsafe { text(name) };
            let log = Log::new(logger.map_or(Logger::Nobody, Logger::Three), environment, &name, logging != 0);
            log.error(&none($what));
            std::ptr::null_mut()
        }
    )* };
}

other_kinds! {
    fmi3InstantiateModelExchange() "model exchange";
    fmi3InstantiateScheduledExecution(_clock: *const c_void, _lock: *const c_void, _unlock: *const c_void) "scheduled execution";
}

/// The standard's function of that name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeInstance(c: *mut c_void) {
    // SAFETY: null, or an instance that is used no more.
    unsafe { free(c) }
}
