//! Reading a design: text, then shape, then rules, then SI.
//!
//! In: a path or a text. Out: [`Design`] or everything found wrong at the first stage that objects. Absent:
//! the rules themselves. Equations: none.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::design_file::DesignFile;
use super::diagnostic::{DesignError, Problem, TextPlace};
use super::document::Document;
use super::edit::{EditError, content, without_keys};
use super::findings::Findings;
use super::history;
use super::open;
use super::scenarios::Load;
use super::set::with_setting;
use super::tolerances_file::TolerancesFile;
use super::{check, life_file, scenarios, shape, sharing_file, task};
use crate::design::{Design, Limits, nearest};

/// Symbols that stand behind keys in the files of `new`, and those keys.
const SYMBOLS: [(&str, &str); 2] = [("r_e", "outer_radius_mm"), ("e_1", "centre_distance_mm")];

fn key_of_symbol(name: &str) -> Option<&'static str> {
    let symbol = name.strip_suffix("_mm").unwrap_or(name);
    SYMBOLS.iter().find(|(known, _)| *known == symbol).map(|(_, key)| *key)
}

const WHAT: &str = "a text file (UTF-8, TOML) that holds a clutch design";

impl Design {
    /// Read and check a design file.
    ///
    /// # Errors
    /// [`DesignError`] where the file cannot be read, is no UTF-8 or no TOML, or is refused by a rule.
    pub fn read(path: &Path) -> Result<Self, DesignError> {
        let name = path.display().to_string();
        match open::read_text(path, open::MOST_DESIGN) {
            Ok(source) => Self::parse(&source, &name),
            Err(why) if why.text.is_empty() => Err(DesignError::unreadable(&name, why.found, WHAT, why.help)),
            Err(why) => Err(one_problem(&name, &why.text, why.at, why.found, WHAT, why.help)),
        }
    }

    /// The same with values set as [`with_setting`] sets them, in this order: (path, value as typed). An error in what they
    /// make of the file points at the changed text and says what was set.
    ///
    /// # Errors
    /// As [`Design::read`], and where a path names nothing that can be set.
    pub fn read_with(path: &Path, settings: &[(String, String)]) -> Result<Self, DesignError> {
        let read = Self::read(path)?;
        if settings.is_empty() { Ok(read) } else { read.with(settings, &path.display().to_string()) }
    }

    /// This design with values set as [`with_setting`] sets them, in this order: (path, value as typed); `name_for_errors`
    /// stands for the file in messages. Histories stay where they are.
    ///
    /// # Errors
    /// As [`Design::read_with`].
    pub fn with(&self, settings: &[(String, String)], name_for_errors: &str) -> Result<Self, DesignError> {
        let mut source = self.source.clone();
        for (key, value) in settings {
            source = with_setting(&source, key, value).map_err(|why| {
                let (allowed, help) = match why {
                    EditError::UnknownName { known, .. } => {
                        let near: Vec<&str> = known.iter().map(String::as_str).collect();
                        let last = key.rsplit('.').next().unwrap_or(key);
                        // The same key in scenes of the file, else in its tables, before one that looks alike.
                        let in_scenes = |path: &String| {
                            path.starts_with("scenarios[") && path.rsplit('.').next() == Some(last)
                        };
                        let meant =
                            || (!key.contains('[') && known.iter().all(in_scenes)).then(|| known.join(" or "));
                        let joined = |paths: Vec<String>| Some(paths.join(" or ")).filter(|all| !all.is_empty());
                        let same = || joined(shape::paths_of(last)).filter(|_| last == key);
                        let near = || nearest(key, &near).map(str::to_owned);
                        let symbol = || key_of_symbol(key).map(str::to_owned);
                        let there = || joined(shape::paths_that_end_in(key));
                        let like = meant().or_else(symbol).or_else(same).or_else(near).or_else(there);
                        let help = like.unwrap_or_else(|| {
                            "`sprag-design explain` lists every name, `explain sprags` the keys of a table".to_owned()
                        });
                        let help = match help.starts_with('`') {
                            true => help,
                            false => format!("did you mean {help}?"),
                        };
                        (known.join(", "), Some(help))
                    }
                    other => (other.to_string(), None),
                };
                let help = help.unwrap_or_else(|| "name a key that the file has or may have".to_owned());
                let found = format!("the setting {key}={value}");
                let problem =
                    Problem { key: key.clone(), place: None, found, allowed, help, also: Vec::new() };
                DesignError::in_source(name_for_errors, "", vec![problem])
            })?;
        }
        Self::parse_in(&self.folder, &source, name_for_errors).map_err(|refused| {
            // A history is as it lies there.
            if refused.file() == name_for_errors { refused.with_set(settings) } else { refused }
        })
    }

    /// This design with numbers set: (path or short name, value in the unit of that name).
    ///
    /// # Errors
    /// As [`Design::read_with`].
    ///
    /// ```
    /// use sprag_design::Design;
    ///
    /// let design = Design::read("designs/huang2017-multi-arc.toml".as_ref())?;
    /// let flatter = design.with_values(&[("r_i2_mm", 4.2)])?;
    /// assert!(flatter.clutch.sprags.inner_arcs[1].radius_m > design.clutch.sprags.inner_arcs[1].radius_m);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_values(&self, values: &[(&str, f64)]) -> Result<Self, DesignError> {
        let typed: Vec<_> =
            values.iter().map(|(path, value)| (path.to_string(), format!("{value:?}"))).collect();
        self.with(&typed, &self.name)
    }

    /// Check the text of a design file; `name_for_errors` stands for the file in messages, and histories are named
    /// from its folder.
    ///
    /// # Errors
    /// As [`Design::read`].
    pub fn parse(source: &str, name_for_errors: &str) -> Result<Self, DesignError> {
        let folder = Path::new(name_for_errors).parent().unwrap_or(Path::new(""));
        Self::parse_in(folder, source, name_for_errors)
    }

    /// Check the text of a design file that would lie in `folder`.
    ///
    /// # Errors
    /// As [`Design::read`], and where a history is refused.
    pub fn parse_in(folder: &Path, source: &str, name_for_errors: &str) -> Result<Self, DesignError> {
        let refuse = |problems| DesignError::in_source(name_for_errors, source, problems);
        if source.trim_start_matches('\u{feff}').trim().is_empty() {
            let help = "let `sprag-design new` make one";
            return Err(one_problem(name_for_errors, source, 0, "an empty file".to_owned(), WHAT, help));
        }
        if let Some(kind) = foreign(source) {
            let help =
                "a design is TOML; `sprag-design import` makes one of a drawing (DXF) or of points (CSV)";
            return Err(one_problem(name_for_errors, source, 0, kind.to_owned(), WHAT, help));
        }
        let doc = Document::parse(source).map_err(refuse)?;
        let problems = shape::problems(&doc);
        if !problems.is_empty() {
            return Err(refuse(problems));
        }
        // The shape is right, so serde finds nothing more; its error is kept for a rule that only it knows.
        let odd = |error: toml::de::Error| {
            let at = error.span().map_or(0, |s| s.start);
            one_problem(name_for_errors, source, at, error.message().to_owned(), WHAT, "mend this value")
        };
        let document = doc.table().map_err(odd)?;
        // By way of the table, as a scenario's clutch is read: serde's code for the types of a file stands once in the program.
        let file: DesignFile = document.clone().try_into().map_err(odd)?;

        let mut out = Findings::new(&document, Some(&doc));
        let mut texts: BTreeMap<PathBuf, String> = BTreeMap::new();
        let mut refused = None;
        let mut load = |name: &str, kind| {
            let at = |what: String| Some(format!("{}: {what}", folder.join(name).display()));
            let path = open::history_path(folder, name).map_err(at)?;
            let text = open::read_text(&path, open::MOST_TABLE).map_err(|why| at(why.found))?;
            let rows = history::rows(&text, kind).map_err(|problems| {
                // It may be any file: nothing of it is shown.
                refused.get_or_insert(DesignError::in_source(&path.display().to_string(), "", problems));
                None
            });
            texts.insert(path, text);
            rows
        };
        let design = assembled(file, &document, &mut load, &mut out);
        let problems = out.problems;
        if let (true, Some(error)) = (problems.is_empty(), refused) {
            return Err(error);
        }
        match design {
            Some(design) if problems.is_empty() => Ok(Self {
                hash: hash(source, texts.values()),
                source: source.to_owned(),
                folder: folder.to_owned(),
                histories: texts.into_keys().collect(),
                ..design
            }),
            _ if !problems.is_empty() => Err(refuse(problems)),
            _ => {
                let found = "a design that could not be put together".to_owned();
                Err(one_problem(
                    name_for_errors,
                    source,
                    0,
                    found,
                    WHAT,
                    "report this as a fault of sprag-design",
                ))
            }
        }
    }

    /// The design that a table of its keys says, without text, folder and hash; histories come by `load`. `None` where it is
    /// refused.
    pub(super) fn of_table(table: &toml::Table, load: Load<'_>) -> Option<Self> {
        let file: DesignFile = table.clone().try_into().ok()?;
        let mut out = Findings::new(table, None);
        assembled(file, table, load, &mut out).filter(|_| out.problems.is_empty())
    }

    /// The clutch as made, for a workshop: at the reference temperature, its races not yet pressed onto shaft or into
    /// housing. [`Design::clutch`] is the one that runs.
    ///
    /// # Errors
    /// As [`Design::read`], where the races as made are no clutch.
    pub fn as_made(&self) -> Result<crate::clutch::Clutch, DesignError> {
        if self.clutch.running.is_none() {
            return Ok(self.clutch.clone());
        }
        let text = without_keys(&self.source, &["thermal", "races.press_fit"]);
        let text = text.unwrap_or_else(|_| self.source.clone());
        Ok(Self::parse_in(&self.folder, &text, &self.name)?.clutch)
    }

    /// SHA-256 (hex) of what the file says and of its histories' values: unlike `hash` the same for another comment or
    /// layout.
    pub fn content_hash(&self) -> String {
        let said = content(&self.source, &[]).unwrap_or_else(|_| self.source.clone());
        hash(&said, [self.histories()].iter())
    }

    /// Values of all histories, as text.
    pub fn histories(&self) -> String {
        let all = self.scenarios.iter().map(|s| (&s.torque_history, &s.speed_history));
        let own = format!("{:?}", all.collect::<Vec<_>>());
        let of_trains = self.scenarios.iter().flat_map(|s| &s.drivetrain);
        let trains: Vec<_> = of_trains.filter(|d| d.has_history()).map(|d| (&d.torques, &d.speed)).collect();
        if trains.is_empty() { own } else { format!("{own}{trains:?}") }
    }
}

/// What the rules make of a file whose shape is right, without text, folder and hash; `None` with the reasons in `out`.
fn assembled(
    file: DesignFile,
    table: &toml::Table,
    load: Load<'_>,
    out: &mut Findings<'_, '_>,
) -> Option<Design> {
    let clutch = check::clutch(&file, out);
    let limits = check::limits(&file.limits, Limits::default(), out);
    check::body_yield(&file, out);
    check::along(&file, out);
    check::film(&file, out);
    check::tolerances(&file, clutch.as_ref(), out);
    check::gaps(&file.limits, &file.races, out);
    let scenarios = scenarios::scenarios(&file, table, clutch.as_ref(), load, out);
    let service = file.life.as_ref().map(|life| life_file::service(&file, life, load, out));
    let sharing = file.sharing.as_ref().map(|s| sharing_file::si(&file, s, clutch.as_ref(), out));
    let check_scenarios = task::check_scenarios(&file, out);
    let optimize = file.optimize.as_ref().map(|t| task::optimize(&file, t, limits, out));
    Some(Design {
        name: file.name,
        clutch: clutch?,
        limits,
        check_scenarios,
        scenarios: scenarios?,
        optimize,
        tolerances: file.tolerances.as_ref().map(TolerancesFile::si),
        service: service.flatten(),
        sharing,
        hash: String::new(),
        source: String::new(),
        folder: PathBuf::new(),
        histories: Vec::new(),
    })
}

fn one_problem(name: &str, source: &str, at: usize, found: String, allowed: &str, help: &str) -> DesignError {
    let problem = Problem {
        key: String::new(),
        place: Some(TextPlace::of(source, at..at + 1)),
        found,
        allowed: allowed.to_owned(),
        help: help.to_owned(),
        also: Vec::new(),
    };
    DesignError::in_source(name, source, vec![problem])
}

/// SHA-256 of the text and of the histories' texts, lower-case hex; without the mark that some editors begin a file with, and with the
/// line ends of all but Windows: who saves a file unchanged has the same design.
fn hash<'t>(source: &str, histories: impl Iterator<Item = &'t String>) -> String {
    let plain = |text: &str| text.trim_start_matches('\u{feff}').replace("\r\n", "\n");
    let mut digest = Sha256::new_with_prefix(plain(source));
    histories.for_each(|text| digest.update(plain(text)));
    digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

/// What another program's file is, by how it begins.
pub fn foreign(source: &str) -> Option<&'static str> {
    let start = source.trim_start_matches('\u{feff}').trim_start();
    let mut words = start.split_whitespace();
    match (words.next()?, words.next()) {
        ("ISO-10303-21;", _) => Some("a STEP file"),
        ("0", Some("SECTION")) | ("999", _) => Some("a DXF drawing"),
        (first, _) if first.starts_with('<') => Some("an XML, SVG or HTML file"),
        (first, _) if first.starts_with('{') => Some("a JSON file"),
        _ => None,
    }
}
