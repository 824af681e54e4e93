//! A clutch between two flanges as a Functional Mock-up Unit for co-simulation, FMI 2.0 and 3.0: what it offers, and its
//! `modelDescription.xml`. The library inside the unit reads the same table, so both agree by construction.
//!
//! Source: FMI specification 2.0.4, sections 2.2 and 4; 3.0.1, sections 2.4 and 4.

#[cfg(feature = "report")]
mod archive;
mod description;
mod units;

#[cfg(feature = "report")]
pub use archive::{HistoryReader, NoUnit, UnitArchive, archive, inertias_beyond};
pub use description::description;
pub use units::{FmiUnit, UNITS, unit};

use crate::design::Design;
use crate::file::{inputs, shape_of, variable_path};

/// Name of the library inside a unit, and of the model.
pub const MODEL: &str = "sprag_clutch";
/// Words in the library that name the version which it belongs to.
pub const MARK: &str = concat!("sprag-design-fmu library ", env!("CARGO_PKG_VERSION"), ";");

/// Version of the standard.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fmi {
    /// 2.0
    Two,
    /// 3.0
    Three,
}

/// How a variable is used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Time itself.
    Time,
    /// Set before each step.
    Input,
    /// Read after each step.
    Output,
    /// Set before the initialisation, and not afterwards.
    Fixed,
    /// Set at any time between two steps.
    Tunable,
}

/// Type of a variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VariableType {
    /// A number.
    Real,
    /// A whole number.
    Integer,
    /// Yes or no.
    Boolean,
}

/// What a variable is.
#[derive(Debug, Clone, PartialEq)]
pub enum VariableSubject {
    /// Something of every clutch.
    Own(ElementQuantity),
    /// The number at this dotted path of the design file.
    Key(String),
}

/// What every clutch has. In the order of [`QUANTITIES`], which is that of the value references.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ElementQuantity {
    /// Time, s.
    Time,
    /// Torque of the flange of race 0 (inner) or 1 (outer) on it, N m.
    Torque(usize),
    /// Angle of race 0 or 1, rad.
    Angle(usize),
    /// Speed, rad/s.
    Speed(usize),
    /// Acceleration, rad/s^2.
    Acceleration(usize),
    /// Normal force at A (0) or B (1), N.
    Normal(usize),
    /// |T|/N there.
    Friction(usize),
    /// Sign of the slip velocity there.
    Slip(usize),
    /// Path of slip there since the beginning, m.
    Path(usize),
    /// Whether the sprags stand off the inner race.
    Open,
    /// [`Beginning::speed_rad_s`](crate::element::Beginning), and so on.
    StartSpeed,
    /// Overrun.
    StartOverrun,
    /// Torque in balance.
    StartTorque,
    /// Angle.
    StartAngle,
    /// Whether the spring stays out of the balance.
    StartWithoutSpring,
    /// Abutment.
    Abutment,
    /// [`Settings::tolerance`](crate::element::Settings).
    Tolerance,
    /// Longest step, s; 0: as long as the step of communication.
    LongestStep,
}

type Row = (ElementQuantity, &'static str, Role, VariableType, &'static str, Option<f64>, &'static str);

/// One row a quantity: what it is, name, role, type, unit, value at the start where it is set, meaning.
macro_rules! quantities {
    ($($quantity:expr, $name:literal, $role:ident $kind:ident $unit:literal $($start:literal)?, $meaning:literal;)+) => {
        /// Quantity, name, role, type, unit, value at the start, meaning.
        pub const QUANTITIES: [Row; [$($name),+].len()] = {
            use ElementQuantity as Q;
            [$((
                $quantity,
                $name,
                Role::$role,
                VariableType::$kind,
                $unit,
                [$(Some($start),)? None][0],
                $meaning,
            )),+]
        };
    };
}

quantities! {
    Q::Time, "time", Time Real "s", "Time";
    Q::Torque(0), "inner.torque", Input Real "Nm" 0.0, "Torque of the flange on the inner race";
    Q::Torque(1), "outer.torque", Input Real "Nm" 0.0, "Torque of the flange on the outer race";
    Q::Angle(0), "inner.angle", Output Real "rad", "Angle of the inner race";
    Q::Speed(0), "inner.speed", Output Real "rad/s", "Speed of the inner race";
    Q::Acceleration(0), "inner.acceleration", Output Real "rad/s2", "Acceleration of the inner race";
    Q::Angle(1), "outer.angle", Output Real "rad", "Angle of the outer race";
    Q::Speed(1), "outer.speed", Output Real "rad/s", "Speed of the outer race";
    Q::Acceleration(1), "outer.acceleration", Output Real "rad/s2", "Acceleration of the outer race";
    Q::Normal(0), "inner_contact.normal_force", Output Real "N", "Normal force of a sprag on the inner race";
    Q::Friction(0), "inner_contact.friction", Output Real "",
        "Tangential over normal force there: the friction that is called on";
    Q::Slip(0), "inner_contact.slip", Output Integer "",
        "Sign of the slip velocity there, race less sprag; 0: it holds or is open";
    Q::Path(0), "inner_contact.slip_path", Output Real "m", "Path of slip there under contact since the start";
    Q::Normal(1), "outer_contact.normal_force", Output Real "N", "Normal force of a sprag on the outer race";
    Q::Friction(1), "outer_contact.friction", Output Real "", "Tangential over normal force there";
    Q::Slip(1), "outer_contact.slip", Output Integer "", "Sign of the slip velocity there; 0: it holds";
    Q::Path(1), "outer_contact.slip_path", Output Real "m", "Path of slip there since the start";
    Q::Open, "open", Output Boolean "", "Whether the sprags stand off the inner race";
    Q::StartSpeed, "start.speed", Fixed Real "rad/s" 0.0,
        "Speed of the outer race at the start, and of the inner one unless it overruns";
    Q::StartOverrun, "start.overrun", Fixed Real "rad/s" 0.0,
        "How much faster the inner race is at the start; above 0: steady overrun";
    Q::StartTorque, "start.torque", Fixed Real "Nm" 0.0,
        "Engaging torque that the clutch carries in balance at the start, without overrun";
    Q::StartAngle, "start.angle", Fixed Real "rad" 0.0, "Angle of the outer race at the start";
    Q::StartWithoutSpring, "start.without_spring", Fixed Boolean "" 0.0, "Whether the spring stays out of that balance";
    Q::Abutment, "abutment.stiffness", Fixed Real "Nm/rad" 0.0,
        "Stiffness that ties the outer race to what turns at start.speed; 0: free";
    Q::Tolerance, "tolerance", Fixed Real "" 1e-8, "Relative tolerance of a step of the integrator inside";
    Q::LongestStep, "longest_step", Fixed Real "s" 0.0,
        "Longest step of the integrator inside; 0: as long as the step of communication";
}

/// Value reference of the first number of the design file.
pub const FIRST_KEY: u32 = 100;

/// One variable of a unit.
#[derive(Debug, Clone, PartialEq)]
pub struct ScalarVariable {
    /// Value reference.
    pub reference: u32,
    /// What it is.
    pub subject: VariableSubject,
    /// Name.
    pub name: String,
    /// How it is used.
    pub role: Role,
    /// Its type.
    pub kind: VariableType,
    /// Unit as design files have it; empty for a pure number.
    pub unit: &'static str,
    /// Value at the start, where the unit does not compute it; of a yes 1, of a no 0.
    pub start: Option<f64>,
    /// What it means.
    pub meaning: String,
}

/// All of them, by value reference: what every clutch has, and the numbers that the design file gives of the clutch itself.
pub fn variables(design: &Design) -> Vec<ScalarVariable> {
    let own = QUANTITIES.iter().enumerate().map(|(i, (quantity, name, role, kind, unit, start, meaning))| {
        ScalarVariable {
            reference: i as u32,
            subject: VariableSubject::Own(*quantity),
            name: (*name).to_owned(),
            role: *role,
            kind: *kind,
            unit,
            start: *start,
            meaning: (*meaning).to_owned(),
        }
    });
    let numbers = inputs(&design.source).into_iter().filter_map(|input| Some((input.number?, input)));
    let keys = numbers.filter(|(_, input)| variable_path(&input.path, 0).is_some());
    let keys = keys.enumerate().map(|(i, (number, input))| {
        let said = shape_of(&input.path).and_then(|shape| shape.get("description")?.as_str());
        ScalarVariable {
            reference: FIRST_KEY + i as u32,
            name: input.path.clone(),
            subject: VariableSubject::Key(input.path),
            role: Role::Tunable,
            kind: VariableType::Real,
            unit: input.unit,
            start: Some(number),
            meaning: said.unwrap_or_default().to_owned(),
        }
    });
    own.chain(keys).collect()
}

/// What binds library and description: version and design.
pub fn token(design: &Design) -> String {
    format!("{} {}", env!("CARGO_PKG_VERSION"), design.hash)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_of_the_clutch_can_be_set_and_has_a_known_unit() {
        for entry in std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/designs")).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_none_or(|e| e != "toml") {
                continue;
            }
            let design = Design::read(&path).unwrap();
            let all = variables(&design);
            assert!(all.len() > QUANTITIES.len() + 20, "{}", path.display());
            for v in &all {
                assert!(v.unit.is_empty() || unit(v.unit).is_some(), "{}: {}", v.name, v.unit);
                assert!(!v.meaning.is_empty(), "{}", v.name);
                if let VariableSubject::Key(key) = &v.subject {
                    let value = format!("{:?}", v.start.unwrap());
                    let value = value.strip_suffix(".0").map(str::to_owned).unwrap_or(value);
                    let again = design.with(&[(key.clone(), value)], "again").unwrap();
                    assert_eq!(again.clutch, design.clutch, "{key}");
                }
            }
        }
    }
}
