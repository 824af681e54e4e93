//! Histories over time from a CSV file named in a scenario.
//!
//! In: the text of a file with two named columns. Out: rows in SI, or its faults with line and column, which repeat nothing
//! but numbers: it may be any file. Absent: reading files, what a history does. Equations: none.

use super::diagnostic::{Problem, TextPlace};
use crate::design::rad_s;

/// Which history a file holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum HistoryKind {
    /// Engaging torque on the inner race; two rows at one time are a jump.
    Torque,
    /// Mean speed.
    Speed,
    /// Speed of an inertia of the drivetrain, of either sign.
    Turn,
}

/// Most rows that are read.
const MOST_ROWS: usize = 100_000;
/// Faults of one file that are told one by one; the others are counted.
const MOST_PROBLEMS: usize = 5;
/// Names of other columns that are told.
const MOST_NAMES: usize = 4;

impl HistoryKind {
    fn header(self) -> String {
        format!("time_s,{}", self.column())
    }

    fn column(self) -> &'static str {
        match self {
            Self::Torque => "torque_nm",
            Self::Speed | Self::Turn => "speed_rpm",
        }
    }

    /// Largest magnitude of a value, in the file's unit.
    fn most(self) -> f64 {
        match self {
            Self::Torque => 1e6,
            Self::Speed | Self::Turn => 1e6,
        }
    }

    fn allowed(self) -> String {
        match self {
            Self::Torque => format!("a finite number of at most {:e} N m in magnitude", self.most()),
            Self::Speed => format!("a finite number from 0 to {:e} rev/min", self.most()),
            Self::Turn => format!("a finite number of at most {:e} rev/min in magnitude", self.most()),
        }
    }
}

/// What a first line is that is no header of a history. Names of columns alone are repeated: it may be that of any file.
fn first_line(cells: &[&str]) -> String {
    let is_name = |cell: &&str| {
        cell.starts_with(|c: char| c.is_ascii_alphabetic())
            && cell.chars().all(|c| c.is_ascii_alphanumeric() || "_ ".contains(c))
    };
    if cells.iter().all(|cell| cell.parse::<f64>().is_ok()) {
        return "a row of numbers without names above it".to_owned();
    }
    if cells.len() < 2 || !cells.iter().all(is_name) {
        return "another first line".to_owned();
    }
    let more = cells.len().saturating_sub(MOST_NAMES);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!("the columns {}{more}", cells[..cells.len().min(MOST_NAMES)].join(","))
}

/// Whether a text begins as a history does, comments apart.
pub fn is_history(text: &str) -> bool {
    let first = text.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with('#'));
    let first: String = first.unwrap_or("").split(',').map(str::trim).collect::<Vec<_>>().join(",");
    [HistoryKind::Torque, HistoryKind::Speed].iter().any(|kind| first == kind.header())
}

/// Rows (time in s, value in N m or rad/s) of a CSV text with the header `time_s,torque_nm` or `time_s,speed_rpm`;
/// lines that begin with # are comments.
pub(super) fn rows(text: &str, kind: HistoryKind) -> Result<Vec<[f64; 2]>, Vec<Problem>> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let mut faults = Faults { text, problems: Vec::new(), more: 0 };
    let mut rows: Vec<[f64; 2]> = Vec::new();
    let header = kind.header();
    let mut named = false;
    for record in reader.records() {
        let record = match record {
            Ok(record) => record,
            Err(e) => {
                let at = e.position().map_or(0, |p| p.byte() as usize);
                faults.add("", at..at + 1, e.to_string(), "rows of two numbers", "mend this row");
                break;
            }
        };
        let fields: Vec<&str> = record.iter().collect();
        let start = record.position().map_or(0, |p| p.byte() as usize);
        // The position may be that of a comment before the record.
        let start = start + text.get(start..).and_then(|rest| rest.find(&fields.join(","))).unwrap_or(0);
        let whole = fields.join(",");
        if !named {
            named = true;
            if whole != header {
                let semicolons = whole.contains(';') && whole.replace([';', ' '], ",") == header;
                let found =
                    if semicolons { "semicolons between the names".to_owned() } else { first_line(&fields) };
                let help = match semicolons {
                    true => "put commas between the cells, and decimals behind a point".to_owned(),
                    false => format!("begin the file with the line {header}"),
                };
                faults.add("", start..start + whole.len().max(1), found, &header, &help);
                break;
            }
            continue;
        }
        let [time, value] = fields.as_slice() else {
            let found = format!("{} fields", fields.len());
            faults.add("", start..start + whole.len().max(1), found, "two fields", "write time and value");
            continue;
        };
        let at_value = start + time.len() + 1;
        let spans = [start..start + time.len().max(1), at_value..at_value + value.len().max(1)];
        let [time_at, value_at] = spans;
        let t = time.parse::<f64>().ok().filter(|t| (0.0..=1e9).contains(t));
        let lowest = if kind == HistoryKind::Speed { 0.0 } else { -kind.most() };
        let v = value.parse::<f64>().ok().filter(|v| (lowest..=kind.most()).contains(v));
        if t.is_none() {
            faults.add(
                "time_s",
                time_at.clone(),
                number(time),
                "a finite time of at least 0 s",
                "mend the time",
            );
        }
        if v.is_none() {
            faults.add(kind.column(), value_at, number(value), &kind.allowed(), "mend the value");
        }
        let (Some(t), Some(v)) = (t, v) else { continue };
        let v = if kind == HistoryKind::Torque { v } else { rad_s(v) };
        if let Some(&[before, _]) = rows.last() {
            let jumps = rows.iter().rev().take_while(|r| r[0] == t).count() > 1;
            if kind != HistoryKind::Torque && t <= before {
                let allowed = format!("later than the row before, {before} s");
                faults.add("time_s", time_at, number(time), &allowed, "a speed cannot jump; sort the rows");
            } else if t < before || jumps {
                let allowed =
                    format!("not before the row before, {before} s, and at most two rows at one time");
                faults.add(
                    "time_s",
                    time_at,
                    number(time),
                    &allowed,
                    "sort the rows; two at one time are a jump",
                );
            }
        }
        rows.push([t, v]);
        if rows.len() > MOST_ROWS {
            faults.add(
                "",
                start..start + 1,
                "one row more".to_owned(),
                "100 000 rows",
                "thin the history out",
            );
            break;
        }
    }
    if rows.len() < 2 && faults.problems.is_empty() {
        let found = format!("{} rows of numbers", rows.len());
        let help = format!("write {header} and one row per point below it");
        faults.add("", 0..1, found, "at least two", &help);
    }
    if faults.problems.is_empty() { Ok(rows) } else { Err(faults.listed()) }
}

/// A field as it is told: a number as it stands.
fn number(field: &str) -> String {
    match field.parse::<f64>() {
        Ok(value) if value.is_finite() => field.chars().take(40).collect(),
        Ok(_) => "a number that is not finite".to_owned(),
        Err(_) if field.is_empty() => "nothing".to_owned(),
        Err(_) => "text that is no number".to_owned(),
    }
}

struct Faults<'a> {
    text: &'a str,
    problems: Vec<Problem>,
    /// Faults beyond those.
    more: usize,
}

impl Faults<'_> {
    fn add(&mut self, key: &str, span: std::ops::Range<usize>, found: String, allowed: &str, help: &str) {
        if self.problems.len() >= MOST_PROBLEMS {
            self.more += 1;
            return;
        }
        self.problems.push(Problem {
            key: key.to_owned(),
            place: Some(TextPlace::of(self.text, span)),
            found,
            allowed: allowed.to_owned(),
            help: help.to_owned(),
            also: Vec::new(),
        });
    }

    /// Those that are listed; the last of them says how many more there are.
    fn listed(mut self) -> Vec<Problem> {
        if let (more @ 1.., Some(last)) = (self.more, self.problems.last_mut()) {
            last.help.push_str(&format!("; and {more} more such faults below"));
        }
        self.problems
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_read_in_si_and_a_torque_may_jump() {
        let text = "# ramp\ntime_s,torque_nm\n0, 0\n0.1,16.8 \n# jump\n0.1,-2\n0.2,-2\n";
        let read = rows(text, HistoryKind::Torque).unwrap();
        assert_eq!(read, [[0.0, 0.0], [0.1, 16.8], [0.1, -2.0], [0.2, -2.0]]);
        let read = rows("time_s,speed_rpm\n0,0\n1,30\n", HistoryKind::Speed).unwrap();
        assert!((read[1][1] - std::f64::consts::PI).abs() < 1e-15);
    }

    #[test]
    fn each_fault_is_told_with_line_column_found_and_allowed() {
        let torque = HistoryKind::Torque;
        for (text, kind, line, column, words) in [
            ("t,torque_nm\n0,1\n", torque, 1, 1, "time_s,torque_nm"),
            ("torque_nm,windup_deg,a,b,c\n", torque, 1, 1, "the columns torque_nm,windup_deg,a,b and 1 more"),
            ("0,1\n0.1,2\n", torque, 1, 1, "a row of numbers without names"),
            ("user:x,0:0\n0,1\n", torque, 1, 1, "found another first line"),
            ("time_s,torque_nm\n0,1\n0.5,abc\n", torque, 3, 5, "text that is no number"),
            ("# c\ntime_s,torque_nm\n0,1\n0.5,nan\n", torque, 4, 5, "finite"),
            ("time_s,torque_nm\n0,1\n-1,2\n", torque, 3, 1, "at least 0"),
            ("time_s,torque_nm\n0.5,1\n0.25,2\n", torque, 3, 1, "0.5 s"),
            ("time_s,torque_nm\n0,1\n0,2\n0,3\n", torque, 4, 1, "two rows at one time"),
            ("time_s,torque_nm\n0,1,2\n1,1\n", torque, 2, 1, "3 fields"),
            ("time_s,torque_nm\n0,1e9\n1,1\n", torque, 2, 3, "1e6"),
            ("time_s,torque_nm\n0,1\n", torque, 1, 1, "at least two"),
            ("", torque, 1, 1, "0 rows"),
            ("time_s,speed_rpm\n0,1\n0,2\n", HistoryKind::Speed, 3, 1, "cannot jump"),
            ("time_s,speed_rpm\n0,1\n1,-2\n", HistoryKind::Speed, 3, 3, "from 0"),
        ] {
            let problems = rows(text, kind).unwrap_err();
            let place = problems[0].place.as_ref().unwrap();
            assert_eq!((place.line, place.column), (line, column), "{text:?}: {problems:?}");
            assert!(problems[0].to_string().contains(words), "{text:?}: {}", problems[0]);
        }
    }

    #[test]
    fn of_many_faults_the_first_are_told_and_the_others_counted() {
        let text = format!("time_s,torque_nm\n{}", "secret\n".repeat(12));
        let problems = rows(&text, HistoryKind::Torque).unwrap_err();
        let lines: Vec<usize> = problems.iter().map(|p| p.place.as_ref().unwrap().line).collect();
        assert_eq!(lines, [2, 3, 4, 5, 6]);
        assert!(problems[4].to_string().ends_with("and 7 more such faults below"), "{}", problems[4]);
        assert!(problems.iter().all(|p| !p.to_string().contains("secret")));
    }
}
