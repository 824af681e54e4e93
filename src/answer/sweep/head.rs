//! The first line of every file of a sweep: whose it is, and what was asked.

use crate::answer::{TOOL, VERSION};
use crate::design::Design;
use crate::sweep::SweepSettings;
use std::fmt;
use std::str::FromStr;

/// First words of the line.
const MARK: &str = "# sprag-design sweep ";

/// What stands in a file of a sweep.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Holds {
    /// Points alone.
    Vectors,
    /// Points with their margins.
    Margins {
        /// Scenes that were run, or `none`.
        scenes: String,
        /// `quick` or `full`.
        work: String,
    },
}

/// The first line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SweepHead {
    /// Version of the program.
    pub version: String,
    /// What the file holds.
    pub holds: Holds,
    /// Hash of the design.
    pub design_hash: String,
    /// Which points, in words; a sampling's are those of its display.
    pub points: String,
    /// Name of the design.
    pub design: String,
}

impl SweepHead {
    /// Of a file of vectors.
    pub fn vectors(design: &Design, points: &str) -> Self {
        Self {
            version: VERSION.to_owned(),
            holds: Holds::Vectors,
            design_hash: design.hash.clone(),
            points: points.to_owned(),
            design: one_line(&design.name),
        }
    }

    /// Of a table of margins.
    pub fn margins(design: &Design, points: &str, settings: &SweepSettings) -> Self {
        let scenes = design.optimize.as_ref().map_or(&[][..], |task| &task.scenarios);
        let scenes =
            if settings.at_rest || scenes.is_empty() { "none".to_owned() } else { scenes.join(", ") };
        let work = if settings.full { "full" } else { "quick" }.to_owned();
        let holds = Holds::Margins { scenes: one_line(&scenes).replace(';', ","), work };
        Self { holds, ..Self::vectors(design, points) }
    }

    /// Whether a line is the first of a file of a sweep, whatever its version.
    pub fn begins(line: &str) -> bool {
        line.starts_with(MARK)
    }

    /// What of it differs from `wanted`, in words.
    pub fn differs(&self, wanted: &Self) -> Option<String> {
        let both = |what: &str, found: &str, wanted: &str| {
            (found != wanted).then(|| format!("its {what}: {found}; wanted: {wanted}"))
        };
        let (a, b) = (self.holds.parts(), wanted.holds.parts());
        both("contents", a[0], b[0])
            .or_else(|| both("design", &self.design_hash, &wanted.design_hash))
            .or_else(|| both("points", &self.points, &wanted.points))
            .or_else(|| both("scenes", a[1], b[1]))
            .or_else(|| both("work", a[2], b[2]))
            .or_else(|| both(&format!("version of {TOOL}"), &self.version, &wanted.version))
    }
}

/// Control characters would end the line.
fn one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

impl Holds {
    fn parts(&self) -> [&str; 3] {
        match self {
            Self::Vectors => ["vectors", "", ""],
            Self::Margins { scenes, work } => ["margins", scenes, work],
        }
    }
}

impl fmt::Display for SweepHead {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { version, holds, design_hash, points, design } = self;
        let [holds, scenes, work] = holds.parts();
        write!(f, "{MARK}{version}; {holds}; design {design_hash}; points {points}; ")?;
        if !work.is_empty() {
            write!(f, "scenes {scenes}; work {work}; ")?;
        }
        write!(f, "name {design}")
    }
}

impl FromStr for SweepHead {
    type Err = ();

    fn from_str(line: &str) -> Result<Self, ()> {
        let said = line.trim_end_matches(['\r', '\n']).strip_prefix(MARK).ok_or(())?;
        let (said, design) = said.split_once("; name ").ok_or(())?;
        let parts: Vec<&str> = said.split("; ").collect();
        let value = |part: &str, key: &str| {
            let rest = part.strip_prefix(key).and_then(|rest| rest.strip_prefix(' '));
            rest.map(str::to_owned).ok_or(())
        };
        let (holds, version, hash, points) = match parts[..] {
            [version, "vectors", hash, points] => (Holds::Vectors, version, hash, points),
            [version, "margins", hash, points, scenes, work] => {
                let holds = Holds::Margins { scenes: value(scenes, "scenes")?, work: value(work, "work")? };
                (holds, version, hash, points)
            }
            _ => return Err(()),
        };
        Ok(Self {
            version: version.to_owned(),
            holds,
            design_hash: value(hash, "design")?,
            points: value(points, "points")?,
            design: design.to_owned(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_head_reads_back_as_it_was_written() {
        let text = include_str!("../../../designs/huang2017-multi-arc.toml");
        let design =
            Design::parse(&text.replace("name = \"Huang 2017", "name = \"a; name b, c"), "a").unwrap();
        for head in [
            SweepHead::vectors(&design, "sobol 9 seed 1"),
            SweepHead::margins(&design, "grid r_i2_mm=3", &SweepSettings { at_rest: false, full: true }),
            SweepHead::margins(&design, "file 0123", &SweepSettings { at_rest: true, full: false }),
        ] {
            let line = head.to_string();
            assert_eq!(line.lines().count(), 1);
            let back: SweepHead = format!("{line}\r\n").parse().unwrap();
            assert!(back == head && SweepHead::begins(&line), "{line}");
            assert_eq!(back.differs(&head), None);
            assert!(
                SweepHead { points: "x".into(), ..head.clone() }.differs(&head).unwrap().contains("points")
            );
        }
        assert!("# sprag-design sweep 1; vectors".parse::<SweepHead>().is_err());
    }
}
