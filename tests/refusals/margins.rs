//! Refusals of the keys that margins read: limits of the body, materials by name, fits, temperatures, run-out.

use super::{Case, hold};

#[test]
#[rustfmt::skip] // one way per line
fn a_body_without_flanks_has_no_section() {
    let bare: &[(&str, &str)] = &[("width_mm = 5.05", "width_mm = 0"), ("hoop_inner_mpa = 900.0", "hoop_inner_mpa = 900.0\nbody_yield_mpa = 1500.0")];
    hold(&[
        Case(bare, "limits.body_yield_mpa", "body_yield_mpa", &["narrowest section", "add flanks"]),
        Case(&[("hoop_inner_mpa = 900.0", "body_yield_mpa = 0.0")], "limits.body_yield_mpa", "body_yield_mpa", &["above 0"]),
    ]);
}
