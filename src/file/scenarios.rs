//! The scenarios of a design: keys by kind, and the clutch with each scenario's overrides.
//!
//! In: `[[scenarios]]` and the whole document as a table. Out: [`Scenario`]s, SI. Absent: the rules of the
//! clutch itself ([`super::check`], asked again for every overridden clutch). Equations: none.

use toml::{Table, Value};

use super::check;
use super::design_file::DesignFile;
use super::drivetrain;
use super::findings::Findings;
use super::history::HistoryKind;
use super::scenario_file::ScenarioFile;
use super::shape;
use super::steels::{self, BODIES, MATERIAL_KEYS};
use crate::design::rad_s;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::clutch::{Clutch, Scenario, ScenarioKind};

/// The kinds by their names in the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(super) enum KindFile {
    Static,
    TorsionalExcitation,
    Engagement,
    Overrun,
    Transient,
}

/// A kind of scenario: its name in the file, what happens, the keys that it must have and those that it may have.
#[derive(Debug, Clone, Copy)]
pub struct KindKeys {
    kind: KindFile,
    /// Name.
    pub name: &'static str,
    /// What happens.
    pub words: &'static str,
    /// Keys that it must have.
    pub required: &'static [&'static str],
    /// Keys that it may have.
    pub optional: &'static [&'static str],
}

/// All of them.
pub const SCENARIO_KINDS: [KindKeys; 5] = [
    KindKeys {
        kind: KindFile::Static,
        name: "static",
        words: "the clutch holds a torque; nothing moves",
        required: &["torque_nm"],
        optional: &["start"],
    },
    KindKeys {
        kind: KindFile::TorsionalExcitation,
        name: "torsional-excitation",
        words: "a torque on the outer race swings, beside a mean one on the inner race; an abutment holds the outer race",
        required: &[
            "preload_nm",
            "amplitude_nm",
            "frequency_hz",
            "abutment_stiffness_nm_per_rad",
            "duration_s",
        ],
        optional: &["speed_rpm", "start", "drivetrain"],
    },
    KindKeys {
        kind: KindFile::Engagement,
        name: "engagement",
        words: "the inner race runs free, a torque reverses it, the sprags grip, a stop takes the load",
        required: &[
            "free_run_rpm",
            "reversing_torque_nm",
            "stop_stiffness_nm_per_rad",
            "bench_inertia_kg_m2",
            "duration_s",
        ],
        optional: &["drivetrain"],
    },
    KindKeys {
        kind: KindFile::Overrun,
        name: "overrun",
        words: "one race runs ahead, the sprags slide or are off: steady",
        required: &["speed_rpm", "overrun_rpm"],
        optional: &[],
    },
    KindKeys {
        kind: KindFile::Transient,
        name: "transient",
        words: "torques and speeds over time: a step, a random torque, or histories from files",
        required: &["abutment_stiffness_nm_per_rad", "duration_s"],
        optional: &[
            "preload_nm",
            "torque_step_nm",
            "step_time_s",
            "torque_history_csv",
            "torque_random",
            "speed_rpm",
            "speed_history_csv",
            "overrun_rpm",
            "start",
            "drivetrain",
        ],
    },
];

impl Scenario {
    /// Names of inputs that the paper does not publish.
    pub fn assumptions(&self) -> &'static [&'static str] {
        match self.kind {
            ScenarioKind::Engagement { .. } => {
                &["free_run_rpm", "reversing_torque_nm", "stop_stiffness_nm_per_rad"]
            }
            _ => &[],
        }
    }
}

/// Keys of a transient of which at least one is needed.
const CHANGES: [&str; 5] =
    ["torque_step_nm", "torque_history_csv", "torque_random", "speed_history_csv", "overrun_rpm"];

/// Keys of a transient that give one thing twice: the one, and the other that is then to go.
const EITHER: [[&str; 2]; 8] = [
    ["torque_random", "torque_history_csv"],
    ["torque_random", "torque_step_nm"],
    ["torque_random", "step_time_s"],
    ["torque_history_csv", "preload_nm"],
    ["torque_history_csv", "torque_step_nm"],
    ["torque_history_csv", "step_time_s"],
    ["speed_history_csv", "speed_rpm"],
    ["overrun_rpm", "start"],
];

/// Reads a history named in a file; the error is what was found instead of a file.
pub(super) type Load<'l> = &'l mut dyn FnMut(&str, HistoryKind) -> Result<Vec<[f64; 2]>, Option<String>>;

/// Tables that a scenario may override.
const OVERRIDABLE: [&str; 6] = ["sprags", "races", "spring", "material", "friction", "contact"];

/// All scenarios, or `None` with the reasons in `out`. `base` is the clutch without overrides, `document`
/// the whole file as a table.
pub(super) fn scenarios(
    file: &DesignFile,
    document: &Table,
    base: Option<&Clutch>,
    load: Load<'_>,
    out: &mut Findings,
) -> Option<Vec<Scenario>> {
    let mut all = Some(Vec::new());
    let inertias = drivetrain::inertias(&file.drivetrain, load, out);
    for (i, entry) in file.scenarios.iter().enumerate() {
        let path = format!("scenarios[{i}]");
        if let Some(first) = file.scenarios.iter().take(i).position(|s| s.name == entry.name) {
            let (name, other) = (format!("{path}.name"), format!("scenarios[{first}].name"));
            out.refuse(
                &[&name, &other],
                "a name that no other scenario has".to_owned(),
                "rename one".to_owned(),
            );
            all = None;
        }
        let train = match &inertias {
            Some(inertias) if takes_part(entry.kind) => {
                drivetrain::chosen(inertias, entry.drivetrain.as_deref(), &path, out)
            }
            Some(_) => Some(Vec::new()),
            None => None,
        };
        // A drivetrain that is refused may be there for the scene.
        let joined = takes_part(entry.kind) && train.as_ref().is_none_or(|t| !t.is_empty());
        let kind = kind(entry, &path, joined, out);
        // Of a random torque its rows, or none where it is refused.
        let drawn = entry.torque_random.as_ref().zip(entry.duration_s).map(|(random, duration_s)| {
            let accepted = random.accepted(duration_s, &format!("{path}.torque_random"), out);
            accepted.then(|| Some(random.rows(entry.preload_nm.unwrap_or(0.0), duration_s)))
        });
        let mut history = |name: &str, file: &Option<String>, which| {
            let Some(file) = file else { return Some(None) };
            match load(file, which) {
                Ok(rows) => Some(Some(rows)),
                Err(found) => {
                    if let Some(found) = found {
                        refuse_history(&format!("{path}.{name}"), found, out);
                    }
                    None
                }
            }
        };
        let torque = match drawn {
            Some(rows) => rows,
            None => history("torque_history_csv", &entry.torque_history_csv, HistoryKind::Torque),
        };
        let speed = history("speed_history_csv", &entry.speed_history_csv, HistoryKind::Speed);
        let overrides: Vec<(&str, &Table)> = OVERRIDABLE
            .into_iter()
            .zip([
                &entry.sprags,
                &entry.races,
                &entry.spring,
                &entry.material,
                &entry.friction,
                &entry.contact,
            ])
            .filter_map(|(name, table)| table.as_ref().map(|t| (name, t)))
            .collect();
        let clutch = if overrides.is_empty() {
            base.cloned()
        } else {
            out.within(&path, |out| overridden(document, &overrides, out))
        };
        match (&mut all, kind, clutch, torque, speed, train) {
            (
                Some(list),
                Some(kind),
                Some(clutch),
                Some(torque_history),
                Some(speed_history),
                Some(drivetrain),
            ) => list.push(Scenario {
                name: entry.name.clone(),
                kind,
                start: entry.start.unwrap_or_default(),
                clutch,
                torque_history,
                speed_history,
                drivetrain,
                overrides: overrides.iter().map(|(name, _)| (*name).to_owned()).collect(),
            }),
            _ => all = None,
        }
    }
    all
}

/// What a key of a scene is, where its kind is known: without the kinds that it belongs to, and without what an absent one means.
fn meaning(key: &str) -> String {
    let whole = shape::meaning_of(key);
    let parts: Vec<&str> = whole.splitn(3, ": ").collect();
    let [allowed, kinds, words] = parts.as_slice() else { return whole };
    if !SCENARIO_KINDS.iter().any(|kind| kinds.contains(kind.name)) {
        return whole;
    }
    format!("{allowed}: {}", words.split(';').next().unwrap_or(words))
}

/// Refuse what `key` names as a history.
pub(super) fn refuse_history(key: &str, found: String, out: &mut Findings) {
    let allowed = "a CSV file in the folder of the design file, or below it".to_owned();
    out.refuse(&[key], allowed, format!("{found}; name such a file"));
}

/// Whether the drivetrain moves in scenarios of this kind.
fn takes_part(kind: KindFile) -> bool {
    SCENARIO_KINDS.iter().any(|known| known.kind == kind && known.optional.contains(&"drivetrain"))
}

/// `joined`: whether a drivetrain takes part, beside which the outer race need not be tied and something changes.
fn kind(s: &ScenarioFile, path: &str, joined: bool, out: &mut Findings) -> Option<ScenarioKind> {
    let KindKeys { name: kind, required, optional, .. } =
        SCENARIO_KINDS.into_iter().find(|known| known.kind == s.kind)?;
    let values = [
        ("torque_nm", s.torque_nm),
        ("preload_nm", s.preload_nm),
        ("amplitude_nm", s.amplitude_nm),
        ("frequency_hz", s.frequency_hz),
        ("abutment_stiffness_nm_per_rad", s.abutment_stiffness_nm_per_rad),
        ("duration_s", s.duration_s),
        ("speed_rpm", s.speed_rpm),
        ("free_run_rpm", s.free_run_rpm),
        ("reversing_torque_nm", s.reversing_torque_nm),
        ("stop_stiffness_nm_per_rad", s.stop_stiffness_nm_per_rad),
        ("bench_inertia_kg_m2", s.bench_inertia_kg_m2),
        ("overrun_rpm", s.overrun_rpm),
        ("torque_step_nm", s.torque_step_nm),
        ("step_time_s", s.step_time_s),
        ("torque_history_csv", s.torque_history_csv.as_ref().map(|_| 0.0)),
        ("torque_random", s.torque_random.as_ref().map(|_| 0.0)),
        ("speed_history_csv", s.speed_history_csv.as_ref().map(|_| 0.0)),
        ("start", s.start.map(|_| 0.0)),
        ("drivetrain", s.drivetrain.as_ref().map(|_| 0.0)),
    ];
    let abutment_nm_per_rad = s.abutment_stiffness_nm_per_rad.or(joined.then_some(0.0));
    let kind_key = format!("{path}.kind");
    for (name, value) in values {
        let key = format!("{path}.{name}");
        let free = name == "abutment_stiffness_nm_per_rad" && joined;
        if value.is_none() && required.contains(&name) && !free {
            let help = format!("add {name} = ... to scenario {:?}, kind {kind}", s.name);
            out.refuse(&[&key], meaning(&key), help);
        } else if value.is_some() && !required.contains(&name) && !optional.contains(&name) {
            let keys = [required, optional].concat().join(", ");
            out.refuse(
                &[&key, &kind_key],
                format!("for kind {kind}: {keys}"),
                format!("remove {name}, or change the kind"),
            );
        }
    }
    if s.kind == KindFile::Transient {
        let given = |name: &str| values.iter().any(|(n, v)| *n == name && v.is_some());
        if !joined && !CHANGES.into_iter().any(given) {
            out.refuse(
                &[&kind_key],
                format!("transient together with one of {}", CHANGES.join(", ")),
                "say what changes, or take kind static".to_owned(),
            );
            return None;
        }
        for [one, other] in EITHER {
            if given(one) && given(other) {
                let keys = [other, one].map(|k| format!("{path}.{k}"));
                let keys = keys.each_ref().map(String::as_str);
                out.refuse(
                    &keys,
                    format!("no {other} beside {one}"),
                    format!("remove {other}: {one} says it"),
                );
            }
        }
        if given("step_time_s") && !given("torque_step_nm") {
            let key = format!("{path}.step_time_s");
            out.refuse(&[&key], "only with torque_step_nm".to_owned(), "remove step_time_s".to_owned());
        }
    }
    let ahead_key = format!("{path}.overrun_rpm");
    match (s.kind, s.overrun_rpm) {
        (KindFile::Transient, Some(ahead)) if ahead <= 0.0 => {
            let help = "give the speed by which the inner race runs ahead at the start, or leave the key out";
            out.refuse(&[&ahead_key], "a finite number above 0 in a transient".to_owned(), help.to_owned());
            return None;
        }
        (KindFile::Overrun, Some(ahead)) if ahead == 0.0 || ahead < -s.speed_rpm.unwrap_or(0.0) => {
            out.refuse(
                &[&ahead_key, &format!("{path}.speed_rpm")],
                "above 0 where the inner race runs ahead; below 0, but not below -speed_rpm, where the outer race does"
                    .to_owned(),
                "give by how much the one race is faster than the other".to_owned(),
            );
            return None;
        }
        _ => {}
    }
    Some(match s.kind {
        KindFile::Static => ScenarioKind::Static { torque_nm: s.torque_nm? },
        KindFile::TorsionalExcitation => ScenarioKind::TorsionalExcitation {
            preload_nm: s.preload_nm?,
            amplitude_nm: s.amplitude_nm?,
            frequency_hz: s.frequency_hz?,
            abutment_stiffness_nm_per_rad: abutment_nm_per_rad?,
            duration_s: s.duration_s?,
            speed_rad_s: rad_s(s.speed_rpm.unwrap_or(0.0)),
        },
        KindFile::Engagement => ScenarioKind::Engagement {
            free_run_rad_s: rad_s(s.free_run_rpm?),
            reversing_torque_nm: s.reversing_torque_nm?,
            stop_stiffness_nm_per_rad: s.stop_stiffness_nm_per_rad?,
            bench_inertia_kg_m2: s.bench_inertia_kg_m2?,
            duration_s: s.duration_s?,
        },
        KindFile::Transient => ScenarioKind::Transient {
            // A random torque has the preload in its rows.
            preload_nm: s.preload_nm.filter(|_| s.torque_random.is_none()).unwrap_or(0.0),
            torque_step_nm: s.torque_step_nm.unwrap_or(0.0),
            step_time_s: s.step_time_s.unwrap_or(0.0),
            abutment_stiffness_nm_per_rad: abutment_nm_per_rad?,
            duration_s: s.duration_s?,
            speed_rad_s: rad_s(s.speed_rpm.unwrap_or(0.0)),
            overrun_rad_s: rad_s(s.overrun_rpm.unwrap_or(0.0)),
        },
        KindFile::Overrun => {
            ScenarioKind::Overrun { speed_rad_s: rad_s(s.speed_rpm?), overrun_rad_s: rad_s(s.overrun_rpm?) }
        }
    })
}

fn overridden(document: &Table, overrides: &[(&str, &Table)], out: &mut Findings) -> Option<Clutch> {
    let mut merged = document.clone();
    for (name, over) in overrides {
        let base = merged.entry(*name).or_insert_with(|| Value::Table(Table::new()));
        let Value::Table(base) = base else { return None };
        let mut over = (*over).clone();
        match *name {
            "material" => {
                let holds = |keys: &[&str]| keys.iter().any(|k| over.contains_key(*k));
                if holds(&MATERIAL_KEYS) && holds(&BODIES) {
                    steels::refuse_mixed_material(out);
                    return None;
                }
                if holds(&BODIES) || BODIES.iter().any(|b| base.contains_key(*b)) {
                    spread_over_bodies(base);
                    spread_over_bodies(&mut over);
                }
                forget_keys_of_the_other_steel(base, &over);
            }
            "contact" => forget_keys_of_the_other_law(base, &over),
            _ => {}
        }
        merge(base, over);
    }
    let file: DesignFile = match merged.try_into() {
        Ok(file) => file,
        Err(error) => {
            let keys: Vec<&str> = overrides.iter().map(|(name, _)| *name).collect();
            let allowed = "tables that make a clutch together with the base".to_owned();
            out.refuse(&keys, allowed, format!("mend the override: {}", error.message()));
            return None;
        }
    };
    check::clutch(&file, out)
}

/// `[material]` for all bodies, written out body by body.
fn spread_over_bodies(material: &mut Table) {
    let common: Table = MATERIAL_KEYS.iter().filter_map(|k| material.remove_entry(*k)).collect();
    if !common.is_empty() {
        for body in BODIES {
            material.insert(body.to_owned(), Value::Table(common.clone()));
        }
    }
}

/// A scenario that names another steel does not inherit values of the one before.
fn forget_keys_of_the_other_steel(base: &mut Table, over: &Table) {
    if over.contains_key("name") {
        base.retain(|key, _| !MATERIAL_KEYS.contains(&key));
    }
    for body in BODIES {
        if let (Some(Value::Table(base)), Some(Value::Table(over))) = (base.get_mut(body), over.get(body)) {
            forget_keys_of_the_other_steel(base, over);
        }
    }
}

/// A scenario that names another law does not inherit keys which that law does not read.
fn forget_keys_of_the_other_law(base: &mut Table, over: &Table) {
    if let Some(law) = over.get("law").and_then(|l| l.clone().try_into().ok()) {
        base.retain(|key, _| check::reads(law, key));
    }
}

fn merge(base: &mut Table, over: Table) {
    for (key, value) in over {
        match (base.get_mut(&key), value) {
            (Some(Value::Table(inner)), Value::Table(value)) => merge(inner, value),
            (_, value) => {
                base.insert(key, value);
            }
        }
    }
}
