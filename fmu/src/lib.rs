//! The library inside a co-simulation unit: the C interfaces of FMI 2.0 and 3.0 to a clutch between two flanges.
//!
//! `slave` is the unit, without a pointer; `border` is where C meets it: strings, arrays, messages, panics; `fmi2` and `fmi3`
//! are the functions of the standard, one line each. Nothing is global: an instance owns all that it knows.
//!
//! # Safety
//! A caller keeps the standard's contract: an instance is one that this library has returned and not yet freed, it is used by
//! one thread at a time, arrays are as long as said, strings end with NUL. Null pointers are refused wherever they come.

mod border;
mod fmi2;
mod fmi3;
mod slave;

use sprag_design::export::fmu::MARK;

/// Words by which the packing command knows the version of a library.
#[unsafe(no_mangle)]
pub extern "C" fn sprag_design_fmu_mark() -> *const u8 {
    MARK.as_ptr()
}
