//! Each margin against a hand calculation that shares no code with it: the formula stands in a comment with its
//! source, its numbers are those of the design file. Shear below the contacts, axial load, body and crowding are in
//! `tests/wedge/capacity.rs`.

#![allow(missing_docs)]

mod contact;
mod overrun;
mod races;

use sprag_design::design::Design;
use sprag_design::margin::{Capacities, LoadState, Margin, load_margins, load_state};

pub const MULTI: &str = include_str!("../../designs/huang2017-multi-arc.toml");

/// The design with each `from` replaced once.
pub fn design(changes: &[(&str, &str)]) -> Design {
    let mut text = MULTI.to_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "the design no longer holds {from:?}");
        text = text.replacen(from, to, 1);
    }
    Design::parse(&text, "literature.toml").unwrap_or_else(|e| panic!("{e}"))
}

pub fn rows(design: &Design) -> (LoadState, Vec<Margin>) {
    let state = load_state(design).unwrap();
    let rows = load_margins(design, &design.limits, Capacities::Wanted, &state);
    (state, rows)
}

pub fn row<'a>(rows: &'a [Margin], code: &str) -> &'a Margin {
    rows.iter().find(|r| r.code() == code).unwrap_or_else(|| panic!("no row {code}"))
}

#[track_caller]
pub fn close(got: f64, want: f64, relative: f64) {
    assert!((got - want).abs() <= relative * want.abs(), "{got} against {want}");
}
