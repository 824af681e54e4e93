//! A measured or drawn sprag as the parameters of this tool.
//!
//! In: the text of a DXF or of a table of points, radii of the races. Out: [`FittedSprag`]: arcs, flanks, how far they are off.
//! Absent: paths and design files (cli, design), filters for raw scans.
//! Equations: least squares over tangent arcs; triangle (9) backwards for first contact.
//!
//! The outline is cut at its four corners. The two straighter pieces are the flanks. Each of the others is fitted by
//! tangent arcs so that the squares of the distances from arc to point are least.

mod dxf;
mod fit;
mod outline;
mod place;
mod points;
mod spiral;

pub use fit::{Arc, Arcs, STANDARD_ERROR};
pub use place::FittedSprag;
pub use spiral::{FittedSpiral, SpiralKind};

use nalgebra::Vector2;

/// What a file holds that is no outline, and how to mend it.
#[derive(Debug, Clone, PartialEq)]
pub struct NoImport {
    /// Line of the file, from 1, where there is one.
    pub line: Option<usize>,
    /// What was found.
    pub found: String,
    /// What is allowed, and how to mend it; what the caller sets is named in backticks: `layer`, `unit`, `swap`, `tracks_m`.
    pub help: String,
}

impl NoImport {
    fn new(line: impl Into<Option<usize>>, found: impl Into<String>, help: &str) -> Self {
        Self { line: line.into(), found: found.into(), help: help.to_owned() }
    }
}

impl std::fmt::Display for NoImport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if let Some(line) = self.line {
            write!(f, "line {line}: ")?;
        }
        write!(f, "found {}; to mend: {}", self.found, self.help)
    }
}

impl std::error::Error for NoImport {}

/// A closed line of points, m, as drawn or measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    /// Points in order, the first not repeated, m.
    points_m: Vec<Vector2<f64>>,
    /// Joints of two true arcs: where, by which angle they miss a common tangent, rad, and the line of the second.
    kinks: Vec<(Vector2<f64>, f64, usize)>,
    /// What was taken for granted or converted, in words.
    pub remarks: Vec<String>,
}

/// What to fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wanted {
    /// Radii of the tracks between which the sprag stands, inner and outer, m.
    pub tracks_m: [f64; 2],
    /// Number of inner arcs; none: as many as the points ask for, six at most.
    pub arcs: Option<usize>,
    /// Arcs are added until no point is farther off, m.
    pub deviation_m: Option<f64>,
    /// Take the other curved side for the outer arc.
    pub swap: bool,
}

/// A unit that a drawing or table may be in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrawnUnit {
    /// Millimetre.
    Millimetre,
    /// Inch.
    Inch,
}

impl DrawnUnit {
    /// One of it, m.
    pub fn metres(self) -> f64 {
        match self {
            Self::Millimetre => 1e-3,
            Self::Inch => 25.4e-3,
        }
    }

    /// In a word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Millimetre => "mm",
            Self::Inch => "inch",
        }
    }
}

/// What is said where a file names no unit.
const TAKEN_FOR_MM: &str = "taken for millimetres; if it is in inches, say `unit` inch";

/// The outline in a DXF; only what lies on `layer`, if named, or else on SPRAG if there is such a layer. `unit`: in place of the
/// file's own.
///
/// # Errors
/// [`NoImport`].
pub fn read_dxf(text: &str, layer: Option<&str>, unit: Option<DrawnUnit>) -> Result<Drawn, NoImport> {
    dxf::read(text, layer, unit)
}

/// The outline in a table of x, y, or in a table of arcs and lines as `export` writes it. `unit` as of [`read_dxf`].
///
/// # Errors
/// [`NoImport`].
pub fn read_points(text: &str, unit: Option<DrawnUnit>) -> Result<Drawn, NoImport> {
    points::read(text, unit)
}

/// The sprag whose outline was drawn.
///
/// # Errors
/// [`NoImport`] where the outline is no sprag, or none for these races.
pub fn sprag(drawn: &Drawn, wanted: &Wanted) -> Result<FittedSprag, NoImport> {
    let sides = outline::sides(drawn)?;
    place::place(&sides, wanted)
}

/// A finite number.
fn number(text: &str, line: usize) -> Result<f64, NoImport> {
    match text.trim().parse::<f64>() {
        Ok(value) if value.is_finite() && value.abs() < 1e6 => Ok(value),
        Ok(_) => {
            Err(NoImport::new(line, format!("{:?}", text.trim()), "give a finite number below a million"))
        }
        Err(_) => {
            Err(NoImport::new(line, format!("{:?}, no number", text.trim()), "give a number with a point"))
        }
    }
}
