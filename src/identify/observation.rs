//! The table of what was measured: CSV text in, observations out.

use crate::design::nearest;
use crate::wedge::SMALLEST_TORQUE_NM;
use std::fmt;

named! {
    /// A measured or published quantity; at a torque where its name in `stiffness` is one of a static point.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum ObservedQuantity {
        /// Windup at the row's torque, deg.
        Windup = "windup_deg",
        /// N_bi at the row's torque, N per sprag.
        NormalInner = "normal_inner_n",
        /// N_be at the row's torque, N per sprag.
        NormalOuter = "normal_outer_n",
        /// tan omega at the row's torque.
        TanOmega = "tan_omega",
        /// p_0 at A at the row's torque, MPa.
        HertzInner = "hertz_inner_mpa",
        /// p_0 at B at the row's torque, MPa.
        HertzOuter = "hertz_outer_mpa",
        /// Secant stiffness at the row's torque, N m/rad.
        Secant = "k_secant_nm_per_rad",
        /// Tangent stiffness at the row's torque, N m/rad.
        Tangent = "k_tangent_nm_per_rad",
        /// Smallest torque at which a limit on nominal torque or the grip is reached, N m.
        NominalTorque = "nominal_torque_nm",
        /// Torque at which the curve ends (roll-over, end of profile), N m.
        EndTorque = "end_torque_nm",
        /// Speed of the outer race at which the sprags lift off in overrun, rev/min.
        LiftOff = "lift_off_rpm",
    }
    /// Column of the table.
    pub fn name;
}

impl ObservedQuantity {
    /// Whether the row must name the torque at which it was seen.
    pub fn needs_torque(self) -> bool {
        !matches!(self, Self::NominalTorque | Self::EndTorque | Self::LiftOff)
    }

    /// Whether a bench with a torque can see it: windup by encoders, normal forces by the hoop strain of the races.
    pub fn seen_on_a_bench(self) -> bool {
        matches!(self, Self::Windup | Self::NormalInner | Self::NormalOuter)
    }
}

/// What a row is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Use {
    /// The unknowns are fitted to it.
    Fit,
    /// It is predicted and compared, and takes no part in the fit.
    Check,
}

/// One observed number.
#[derive(Debug, Clone, PartialEq)]
pub struct Observation {
    /// Line of the table, from 1.
    pub line: usize,
    /// Label of the row, control characters escaped, or its line.
    pub label: String,
    /// Keys of the design that this row changes (dotted path, value in the key's unit).
    pub keys: Vec<(String, f64)>,
    /// What was seen.
    pub kind: ObservedQuantity,
    /// The number seen, in the unit of its column.
    pub value: f64,
    /// Torque at which it was seen, N m.
    pub torque_nm: Option<f64>,
    /// Standard error of the number; absent: in proportion to it.
    pub sigma: Option<f64>,
    /// What it is for.
    pub purpose: Use,
}

impl Observation {
    /// What a residual is divided by.
    pub fn scale(&self) -> f64 {
        self.sigma.unwrap_or(self.value.abs())
    }
}

/// What is wrong with a table: line, column, what was found, what is allowed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// Line, from 1; 0: the table as a whole.
    pub line: usize,
    /// Column, if one is at fault.
    pub column: String,
    /// What was found.
    pub found: String,
    /// What is allowed.
    pub allowed: String,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.line > 0 {
            write!(f, "line {}: ", self.line)?;
        }
        if !self.column.is_empty() {
            write!(f, "{}: ", self.column)?;
        }
        write!(f, "found {}; allowed: {}", self.found, self.allowed)
    }
}

impl std::error::Error for Fault {}

/// Words of the column `use`.
const USES: &str = "fit, check, skip, or nothing for fit";

/// The observations of a CSV table.
///
/// Columns, each at most once, in any order: `label`; `use` (fit, check, skip); `torque_nm`; those of [`ObservedQuantity`], each
/// with, if wanted, its standard error in the same unit as `<column>_sigma`; dotted keys of the design file that the row changes, such as
/// `races.inner_radius_mm`. An empty cell says nothing. Lines that begin with # are comments.
///
/// # Errors
/// The first [`Fault`].
pub fn observations(text: &str) -> Result<Vec<Observation>, Fault> {
    let mut reader =
        csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(text.as_bytes());
    let broken = |e: csv::Error| Fault {
        line: e.position().map_or(0, |p| p.line() as usize),
        column: String::new(),
        found: e.to_string(),
        allowed: "CSV with one header line and as many cells in every row".to_owned(),
    };
    let header: Vec<String> = reader.headers().map_err(broken)?.iter().map(str::to_owned).collect();
    check_header(&header)?;
    let mut all = Vec::new();
    for record in reader.records() {
        let record = record.map_err(broken)?;
        let line = record.position().map_or(0, |p| p.line() as usize);
        row(&header, &record, line, &mut all)?;
    }
    if all.is_empty() {
        return Err(Fault {
            line: 0,
            column: String::new(),
            found: "no observation".to_owned(),
            allowed: format!("at least one number under {}", kinds()),
        });
    }
    Ok(all)
}

fn kinds() -> String {
    ObservedQuantity::ALL.map(ObservedQuantity::name).join(", ")
}

/// Whether a column has a meaning; a dotted key must look like one.
fn is_known(name: &str) -> bool {
    let of_a_key = |c: char| c.is_ascii_alphanumeric() || "_.[]".contains(c);
    ["label", "use", "torque_nm"].contains(&name)
        || name.contains('.') && name.chars().all(of_a_key)
        || ObservedQuantity::ALL.iter().any(|k| name.strip_suffix("_sigma").unwrap_or(name) == k.name())
}

fn check_header(header: &[String]) -> Result<(), Fault> {
    if header.len() == 1 && header[0].contains(';') {
        return Err(Fault {
            line: 1,
            column: "the first line".to_owned(),
            found: "semicolons between the names".to_owned(),
            allowed: "commas between cells, decimals behind a point (a spreadsheet saves so as CSV, comma-separated)"
                .to_owned(),
        });
    }
    // Where no column is known and they are no names it may be any file: nothing of it is repeated.
    let is_name =
        |name: &String| name.len() < 40 && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    let ours = header.iter().any(|name| is_known(name)) || header.len() > 1 && header.iter().all(is_name);
    for (i, name) in header.iter().enumerate() {
        let column = if ours { name.clone() } else { format!("column {}", i + 1) };
        let fault =
            |found: String, allowed: String| Fault { line: 1, column: column.clone(), found, allowed };
        if !is_known(name) {
            let known: Vec<&str> = ["label", "use", "torque_nm"]
                .into_iter()
                .chain(ObservedQuantity::ALL.map(ObservedQuantity::name))
                .collect();
            let near = nearest(name, &known).map_or(String::new(), |near| format!(" (did you mean {near}?)"));
            return Err(fault(
                format!("an unknown column{near}"),
                format!(
                    "label, use, torque_nm, {}, each of these with _sigma, or a dotted key of the design file",
                    kinds()
                ),
            ));
        }
        if header.iter().take(i).any(|other| other == name) {
            return Err(fault("the same column twice".to_owned(), "each column once".to_owned()));
        }
    }
    Ok(())
}

fn row(
    header: &[String],
    record: &csv::StringRecord,
    line: usize,
    all: &mut Vec<Observation>,
) -> Result<(), Fault> {
    let cell = |name: &str| {
        let at = header.iter().position(|h| h == name)?;
        record.get(at).filter(|text| !text.is_empty())
    };
    let number = |name: &str| -> Result<Option<f64>, Fault> {
        let Some(text) = cell(name) else { return Ok(None) };
        match text.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(Some(value)),
            _ => Err(Fault {
                line,
                column: name.to_owned(),
                found: "no finite number".to_owned(),
                allowed: "a finite number, or nothing".to_owned(),
            }),
        }
    };
    let purpose = match cell("use") {
        None | Some("fit") => Use::Fit,
        Some("check") => Use::Check,
        Some("skip") => return Ok(()),
        Some(_) => {
            return Err(Fault {
                line,
                column: "use".to_owned(),
                found: "another word".to_owned(),
                allowed: USES.to_owned(),
            });
        }
    };
    let mut keys = Vec::new();
    for name in header.iter().filter(|name| name.contains('.')) {
        keys.extend(number(name)?.map(|value| (name.clone(), value)));
    }
    let torque_nm = number("torque_nm")?;
    let needs = |column: &str, value: Option<f64>, allowed: &str| match value {
        Some(value) if value <= 0.0 => Err(Fault {
            line,
            column: column.to_owned(),
            found: value.to_string(),
            allowed: allowed.to_owned(),
        }),
        _ => Ok(()),
    };
    // Below, the curve's figures are rounding.
    if let Some(found) = torque_nm.filter(|t| *t < SMALLEST_TORQUE_NM) {
        let (column, allowed) =
            ("torque_nm".to_owned(), format!("a torque of {SMALLEST_TORQUE_NM:e} N m or more"));
        return Err(Fault { line, column, found: found.to_string(), allowed });
    }
    for kind in ObservedQuantity::ALL {
        let Some(value) = number(kind.name())? else { continue };
        needs(kind.name(), Some(value), "a number above 0")?;
        if kind.needs_torque() && torque_nm.is_none() {
            return Err(Fault {
                line,
                column: kind.name().to_owned(),
                found: "no torque_nm".to_owned(),
                allowed: "the torque at which this was seen, in the same row".to_owned(),
            });
        }
        let sigma_column = format!("{}_sigma", kind.name());
        let sigma = number(&sigma_column)?;
        needs(&sigma_column, sigma, "a standard error above 0")?;
        all.push(Observation {
            line,
            label: cell("label").map_or_else(|| format!("line {line}"), crate::file::shown),
            keys: keys.clone(),
            kind,
            value,
            torque_nm,
            sigma,
            purpose,
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_read_row_by_row() {
        let text = "# from a bench\nlabel,use,races.inner_radius_mm,torque_nm,windup_deg,windup_deg_sigma,nominal_torque_nm\n\
                    a,,20,10,1.5,0.01,\nb,skip,21,,,,7\nc,check,22,,,,8\n";
        let all = observations(text).unwrap();
        assert_eq!(all.len(), 2);
        assert_eq!(
            (all[0].kind, all[0].value, all[0].torque_nm),
            (ObservedQuantity::Windup, 1.5, Some(10.0))
        );
        assert_eq!((all[0].scale(), all[0].purpose, all[0].line), (0.01, Use::Fit, 3));
        assert_eq!((all[1].label.as_str(), all[1].purpose, all[1].scale()), ("c", Use::Check, 8.0));
        assert_eq!(all[1].keys, [("races.inner_radius_mm".to_owned(), 22.0)]);
    }

    #[test]
    fn faults_name_line_and_column() {
        for (text, line, column) in [
            ("torque_nm,windup\n1,2\n", 1, "windup"),
            ("torque_nm,torque_nm\n1,2\n", 1, "torque_nm"),
            ("torque_nm,windup_deg\n1,x\n", 2, "windup_deg"),
            ("torque_nm,windup_deg\n-1,2\n", 2, "torque_nm"),
            ("torque_nm,windup_deg\n,2\n", 2, "windup_deg"),
            ("torque_nm,windup_deg,windup_deg_sigma\n1,2,0\n", 2, "windup_deg_sigma"),
            ("torque_nm,windup_deg\n1,inf\n", 2, "windup_deg"),
            ("torque_nm,windup_deg,use\n1,2,no\n", 2, "use"),
            ("torque_nm,windup_deg\n1,0\n", 2, "windup_deg"),
            ("torque_nm,windup_deg\n1,2,3\n", 2, ""),
            ("torque_nm,windup_deg\n", 0, ""),
            ("", 0, ""),
            ("root:x:0:0:root:/root:/bin/ba.sh,b\n1,2\n", 1, "column 1"),
            ("torque_nm,windup_deg\n1,root:x\n", 2, "windup_deg"),
            ("torque_nm,windup_deg,use\n1,2,root:x\n", 2, "use"),
        ] {
            let fault = observations(text).unwrap_err();
            assert!(!fault.to_string().contains("root"), "{fault}");
            assert_eq!((fault.line, fault.column.as_str()), (line, column), "{text:?}: {fault}");
        }
    }
}
