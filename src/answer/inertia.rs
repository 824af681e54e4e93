//! Where the inertia that turns with a race comes from: what rests on a guess says so.

use crate::design::Design;
use crate::file::inputs;

/// Where the inertia of a race comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum InertiaFrom {
    /// The file names none: it is that of the ring alone.
    Ring,
    /// The file names it and calls it a guess, as `new` does.
    Guess,
    /// The file names it.
    File,
}

/// Of the `race`, `inner` or `outer`.
pub(super) fn inertia_from(design: &Design, race: &str) -> InertiaFrom {
    let key = format!("{race}_inertia_kg_m2");
    if !inputs(&design.source).iter().any(|i| i.path == format!("races.{key}")) {
        return InertiaFrom::Ring;
    }
    let line = design.source.lines().map(str::trim_start).find(|line| line.starts_with(&key));
    match line.and_then(|line| line.split_once('#')) {
        Some((_, comment)) if comment.trim_start().starts_with("guess") => InertiaFrom::Guess,
        _ => InertiaFrom::File,
    }
}

/// That the drivetrain of the file is no part of an answer, and `options`, which say what turns with the races.
pub(super) fn drivetrain_apart(design: &Design, options: &str) -> Option<String> {
    let has = inputs(&design.source).iter().any(|input| input.path.starts_with("drivetrain"));
    has.then(|| {
        format!(
            "The [[drivetrain]] of the file is no part of this answer, with all its inertias: what turns with a race is said by {options}"
        )
    })
}
