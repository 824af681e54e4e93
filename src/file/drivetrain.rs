//! The drivetrain of a design: which inertia is joined to which, and the change to SI.
//!
//! In: `[[drivetrain]]`, every key in its own range. Out: [`DriveInertia`]s, each after what it is joined to, of the whole
//! file and of a scenario. Absent: how they move. Equations: none.

use super::drivetrain_file::{DriveFile, GasFile};
use super::findings::Findings;
use super::history::HistoryKind;
use super::scenarios::Load;
use crate::clutch::{DriveInertia, DriveTorque, GasTorque, MOST_SHAFTS, Shaft, Towards};
use crate::design::{m, nearest, pa};
use std::f64::consts::FRAC_PI_4;

/// What an inertia may be joined to beside others.
const RACES: [(&str, Towards); 2] = [("inner-race", Towards::InnerRace), ("outer-race", Towards::OuterRace)];

/// Turns of an inertia for one turn of its race, either way: more is no gearbox, and its square is to be a number.
const TURNS: std::ops::RangeInclusive<f64> = 1e-6..=1e6;

/// An inertia with what its file says of its place: by name, for a scenario picks some.
#[derive(Debug, Clone)]
pub(super) struct Named {
    to: String,
    inertia: DriveInertia,
}

/// Points of a history, or none.
type Points = Option<Vec<[f64; 2]>>;

/// All inertias, each after what it is joined to; `None` with the reasons in `out`.
pub(super) fn inertias(files: &[DriveFile], load: Load<'_>, out: &mut Findings) -> Option<Vec<Named>> {
    let before = out.problems.len();
    let names_are_right = names(files, out);
    let mut all = Vec::new();
    let mut whole = names_are_right;
    for (i, file) in files.iter().enumerate() {
        let path = format!("drivetrain[{i}]");
        let mut history = |name: &str, of: &Option<String>, kind| -> Option<Points> {
            let Some(of) = of else { return Some(None) };
            match load(of, kind) {
                Ok(rows) => Some(Some(rows)),
                Err(found) => {
                    if let Some(found) = found {
                        super::scenarios::refuse_history(&format!("{path}.{name}"), found, out);
                    }
                    None
                }
            }
        };
        let torque = history("torque_history_csv", &file.torque_history_csv, HistoryKind::Torque);
        let speed = history("speed_history_csv", &file.speed_history_csv, HistoryKind::Turn);
        keys(file, &path, out);
        match (torque, speed) {
            (Some(torque), Some(speed)) => {
                all.push(Named { to: file.to.clone(), inertia: si(file, torque, speed) })
            }
            _ => whole = false,
        }
    }
    if !whole || out.problems.len() > before {
        return None;
    }
    in_order(files, all, out)
}

/// Names: each once, none that of a race, each `to` one that exists.
fn names(files: &[DriveFile], out: &mut Findings) -> bool {
    let before = out.problems.len();
    for (i, file) in files.iter().enumerate() {
        let key = |name: &str| format!("drivetrain[{i}].{name}");
        if RACES.iter().any(|(race, _)| *race == file.name.replace(' ', "-")) {
            let allowed = "a name that is none of a race".to_owned();
            out.refuse(&[&key("name")], allowed, "rename it: the races are there already".to_owned());
        } else if let Some(first) = files[..i].iter().position(|f| f.name == file.name) {
            let other = format!("drivetrain[{first}].name");
            let allowed = "a name that no other inertia has".to_owned();
            out.refuse(&[&key("name"), &other], allowed, "rename one".to_owned());
        }
        let known: Vec<&str> =
            RACES.iter().map(|(race, _)| *race).chain(files.iter().map(|f| f.name.as_str())).collect();
        if !known.contains(&file.to.as_str()) {
            let help = nearest(&file.to, &known).map_or_else(
                || "join it to a race, or to an inertia of [[drivetrain]] by its name".to_owned(),
                |near| format!("did you mean {near}?"),
            );
            out.refuse(&[&key("to")], known.join(", "), help);
        }
    }
    out.problems.len() == before
}

/// Keys that go together.
fn keys(file: &DriveFile, path: &str, out: &mut Findings) {
    let key = |name: &str| format!("{path}.{name}");
    if file.ratio == Some(0.0) {
        let help = "give the turns of this inertia for one turn of what it is joined to".to_owned();
        out.refuse(&[&key("ratio")], "a number other than 0".to_owned(), help);
    }
    let driven = file.speed_history_csv.is_some();
    match (file.stiffness_nm_per_rad, driven) {
        (Some(_), false) if file.inertia_kg_m2 == 0.0 => out.refuse(
            &[&key("inertia_kg_m2"), &key("stiffness_nm_per_rad")],
            "above 0 on a shaft".to_owned(),
            "give its inertia, or remove stiffness_nm_per_rad: what is rigid may be without".to_owned(),
        ),
        (None, true) => out.refuse(
            &[&key("speed_history_csv")],
            "only together with stiffness_nm_per_rad".to_owned(),
            "add the stiffness of the shaft over which it drives".to_owned(),
        ),
        _ => {}
    }
    if file.damping_nm_s_per_rad.is_some() && file.stiffness_nm_per_rad.is_none() {
        out.refuse(
            &[&key("damping_nm_s_per_rad")],
            "only together with stiffness_nm_per_rad".to_owned(),
            "add the stiffness of the shaft, or remove the damping: what is rigid does not twist".to_owned(),
        );
    }
    if driven {
        let given = [
            ("inertia_kg_m2", file.inertia_kg_m2 > 0.0),
            ("drag_nm_s_per_rad", file.drag_nm_s_per_rad.is_some()),
            ("torque_nm", file.torque_nm.is_some()),
            ("torque_history_csv", file.torque_history_csv.is_some()),
            ("orders", !file.orders.is_empty()),
            ("gas", file.gas.is_some()),
        ];
        for (name, _) in given.into_iter().filter(|(_, given)| *given) {
            out.refuse(
                &[&key(name), &key("speed_history_csv")],
                format!("no {name} where the speed is given"),
                format!("remove {name}: it turns as the history says, whatever acts on it"),
            );
        }
    }
}

fn si(file: &DriveFile, torque: Points, speed: Points) -> DriveInertia {
    let shaft = file.stiffness_nm_per_rad.map(|stiffness_nm_per_rad| Shaft {
        stiffness_nm_per_rad,
        damping_nm_s_per_rad: file.damping_nm_s_per_rad.unwrap_or(0.0),
    });
    let orders = file.orders.iter().map(|o| DriveTorque::Order {
        order: o.order,
        amplitude_nm: o.amplitude_nm,
        phase_rad: o.phase_rad,
    });
    let torques = file.torque_nm.map(DriveTorque::Constant).into_iter();
    DriveInertia {
        name: file.name.clone(),
        inertia_kg_m2: file.inertia_kg_m2,
        to: Towards::InnerRace,
        ratio: file.ratio.unwrap_or(1.0),
        shaft,
        drag_nm_s_per_rad: file.drag_nm_s_per_rad.unwrap_or(0.0),
        torques: torques
            .chain(torque.map(DriveTorque::History))
            .chain(orders)
            .chain(file.gas.as_ref().map(|g| DriveTorque::Gas(gas(g))))
            .collect(),
        speed,
    }
}

fn gas(file: &GasFile) -> GasTorque {
    GasTorque {
        cylinders: file.cylinders,
        swept_volume_m3: FRAC_PI_4 * m(file.bore_mm).powi(2) * m(file.stroke_mm),
        compression_ratio: file.compression_ratio,
        rod_ratio: file.rod_ratio.unwrap_or(0.3),
        intake_pa: pa(file.intake_pressure_mpa.unwrap_or(0.1)),
        exponent: file.polytropic_exponent.unwrap_or(1.3),
        mean_pressure_pa: pa(file.mean_pressure_mpa),
        phase_rad: file.phase_rad,
    }
}

/// Each after what it is joined to; what goes round in a ring is refused.
fn in_order(files: &[DriveFile], mut rest: Vec<Named>, out: &mut Findings) -> Option<Vec<Named>> {
    let mut all: Vec<Named> = Vec::new();
    while !rest.is_empty() {
        let there =
            |to: &str| RACES.iter().any(|(race, _)| *race == to) || all.iter().any(|a| a.inertia.name == to);
        let (next, left): (Vec<Named>, Vec<Named>) = rest.into_iter().partition(|one| there(&one.to));
        if next.is_empty() {
            for one in &left {
                let i = files.iter().position(|f| f.name == one.inertia.name).unwrap_or(0);
                out.refuse(
                    &[&format!("drivetrain[{i}].to")],
                    "something that leads to a race".to_owned(),
                    format!("join {} towards the clutch: it goes round in a ring", one.inertia.name),
                );
            }
            return None;
        }
        (all, rest) = (all.into_iter().chain(next).collect(), left);
    }
    for one in &all {
        let Some(driven) = all.iter().find(|a| a.inertia.name == one.to && a.inertia.speed.is_some()) else {
            continue;
        };
        let at = |name: &str| files.iter().position(|f| f.name == name).unwrap_or(0);
        let key = format!("drivetrain[{}].to", at(&one.inertia.name));
        let other = format!("drivetrain[{}].speed_history_csv", at(&driven.inertia.name));
        let allowed = "a race, or an inertia whose speed is not given".to_owned();
        let help = "remove it: beyond a given speed nothing is felt".to_owned();
        out.refuse(&[&key, &other], allowed, help);
    }
    let mut turns: Vec<f64> = Vec::new();
    for one in &all {
        let of_parent = all.iter().position(|a| a.inertia.name == one.to).map_or(1.0, |p| turns[p]);
        let total = one.inertia.ratio * of_parent;
        // Beyond it the first wrong one is told, not all that hang on it.
        let told = !TURNS.contains(&of_parent.abs());
        if !told && !TURNS.contains(&total.abs()) {
            let i = files.iter().position(|f| f.name == one.inertia.name).unwrap_or(0);
            out.refuse(
                &[&format!("drivetrain[{i}].ratio")],
                format!(
                    "{:e} to {:e} turns for one of the race in all, found {total:e}",
                    TURNS.start(),
                    TURNS.end()
                ),
                "mend the ratios on the way to the race".to_owned(),
            );
        }
        turns.push(total);
    }
    Some(all)
}

/// The drivetrain of a scenario that picks the inertias `chosen`, all where it says nothing.
pub(super) fn chosen(
    all: &[Named],
    chosen: Option<&[String]>,
    path: &str,
    out: &mut Findings,
) -> Option<Vec<DriveInertia>> {
    let before = out.problems.len();
    let key = format!("{path}.drivetrain");
    for name in chosen.unwrap_or_default() {
        let known: Vec<&str> = all.iter().map(|a| a.inertia.name.as_str()).collect();
        if !known.contains(&name.as_str()) {
            let help = nearest(name, &known).map_or_else(
                || format!("remove {name:?}"),
                |near| format!("did you mean {near} for {name:?}?"),
            );
            let known = if known.is_empty() { "no [[drivetrain]]".to_owned() } else { known.join(", ") };
            out.refuse(&[&key], format!("names of [[drivetrain]]: {known}"), help);
        }
    }
    let picked: Vec<&Named> =
        all.iter().filter(|a| chosen.is_none_or(|names| names.contains(&a.inertia.name))).collect();
    let mut train: Vec<DriveInertia> = Vec::new();
    for one in &picked {
        let race = RACES.iter().find(|(race, _)| *race == one.to).map(|(_, race)| *race);
        let place = || train.iter().position(|t| t.name == one.to).map(Towards::Inertia);
        let Some(to) = race.or_else(place) else {
            let (name, to) = (&one.inertia.name, &one.to);
            let allowed = format!("{to} too, which {name} is joined to");
            out.refuse(&[&key], allowed, format!("add {to:?}, or leave out {name:?}"));
            continue;
        };
        train.push(DriveInertia { to, ..one.inertia.clone() });
    }
    let at = if chosen.is_some() { key.as_str() } else { "drivetrain" };
    let shafts = train.iter().filter(|t| t.is_free()).count();
    if shafts > MOST_SHAFTS {
        let allowed = format!("at most {MOST_SHAFTS} inertias on shafts, found {shafts}");
        out.refuse(&[at], allowed, "join the stiffest rigidly: leave their stiffness out".to_owned());
    }
    for race in RACES {
        let driven: Vec<&str> = train
            .iter()
            .enumerate()
            .filter(|(i, t)| t.speed.is_some() && side(&train, *i) == race.1)
            .map(|(_, t)| t.name.as_str())
            .collect();
        if driven.len() > 1 {
            let allowed = format!(
                "one given speed on the side of a race, found {} at the {}",
                driven.join(", "),
                race.0
            );
            out.refuse(&[at], allowed, "leave one of them".to_owned());
        }
    }
    (out.problems.len() == before).then_some(train)
}

fn side(train: &[DriveInertia], i: usize) -> Towards {
    match train[i].to {
        Towards::Inertia(j) if j < i => side(train, j),
        race => race,
    }
}
