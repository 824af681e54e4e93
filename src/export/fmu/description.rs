//! `modelDescription.xml`.

use super::{Fmi, MODEL, Role, ScalarVariable, VariableType, token, unit, variables};
use crate::design::Design;
use std::fmt::Write;

/// Step of communication that is suggested, s: with one straight piece of torque each, a swing at 100 Hz is right to 1e-3 of
/// its amplitude.
const STEP_S: f64 = 1e-4;

/// Categories of messages, with their meaning.
const CATEGORIES: [(&str, &str); 4] = [
    ("logStatusError", "What was asked is malformed, or the clutch cannot begin so"),
    ("logStatusDiscard", "A step came to its end early: the curve's end, a limit of work"),
    ("logStatusWarning", "What was passed over"),
    ("logEvents", "Begin, changes of parameters"),
];

/// The description of `design` for one version of FMI.
pub fn description(design: &Design, fmi: Fmi) -> String {
    let all = variables(design);
    let mut out = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    let (version, binding) = match fmi {
        Fmi::Two => ("2.0", "guid"),
        Fmi::Three => ("3.0", "instantiationToken"),
    };
    let _ = write!(
        out,
        "<fmiModelDescription fmiVersion=\"{version}\" modelName=\"{MODEL}\" {binding}=\"{}\"\n  description=\"{}\"\n  \
         generationTool=\"{} {}\" variableNamingConvention=\"structured\"{}>\n",
        token(design),
        escaped(&format!("Sprag clutch between two flanges: {}", design.name)),
        env!("CARGO_PKG_NAME"),
        env!("CARGO_PKG_VERSION"),
        if fmi == Fmi::Two { " numberOfEventIndicators=\"0\"" } else { "" },
    );
    let can = match fmi {
        Fmi::Two => {
            "canInterpolateInputs=\"true\" canGetAndSetFMUstate=\"true\" canSerializeFMUstate=\"true\" \
             canNotUseMemoryManagementFunctions=\"true\""
        }
        Fmi::Three => "canGetAndSetFMUState=\"true\" canSerializeFMUState=\"true\"",
    };
    let _ = writeln!(
        out,
        "  <CoSimulation modelIdentifier=\"{MODEL}\" canHandleVariableCommunicationStepSize=\"true\" {can}/>"
    );
    units(&mut out, &all);
    out += "  <LogCategories>\n";
    for (name, meaning) in CATEGORIES {
        let _ = writeln!(out, "    <Category name=\"{name}\" description=\"{}\"/>", escaped(meaning));
    }
    out += "  </LogCategories>\n";
    let _ = writeln!(out, "  <DefaultExperiment startTime=\"0\" stopTime=\"1\" stepSize=\"{STEP_S:?}\"/>");
    out += "  <ModelVariables>\n";
    for v in &all {
        match fmi {
            Fmi::Two => variable_2(&mut out, v),
            Fmi::Three => variable_3(&mut out, v),
        }
    }
    out += "  </ModelVariables>\n  <ModelStructure>\n";
    let outputs = || all.iter().enumerate().filter(|(_, v)| v.role == Role::Output);
    match fmi {
        Fmi::Two => {
            let list = |out: &mut String, name: &str| {
                let _ = writeln!(out, "    <{name}>");
                for (i, _) in outputs() {
                    let _ = writeln!(out, "      <Unknown index=\"{}\"/>", i + 1);
                }
                let _ = writeln!(out, "    </{name}>");
            };
            list(&mut out, "Outputs");
            list(&mut out, "InitialUnknowns");
        }
        Fmi::Three => {
            for name in ["Output", "InitialUnknown"] {
                for (_, v) in outputs() {
                    let _ = writeln!(out, "    <{name} valueReference=\"{}\"/>", v.reference);
                }
            }
        }
    }
    out + "  </ModelStructure>\n</fmiModelDescription>\n"
}

/// Those that are used, each once.
fn units(out: &mut String, all: &[ScalarVariable]) {
    let mut used: Vec<_> = all.iter().filter_map(|v| unit(v.unit)).collect();
    used.sort_by_key(|unit| unit.name);
    used.dedup();
    *out += "  <UnitDefinitions>\n";
    for u in used {
        let mut base = String::new();
        for (name, exponent) in ["kg", "m", "s", "K", "rad"].iter().zip(u.exponents).filter(|(_, e)| *e != 0)
        {
            let _ = write!(base, " {name}=\"{exponent}\"");
        }
        if u.factor != 1.0 {
            let _ = write!(base, " factor=\"{:?}\"", u.factor);
        }
        if u.offset != 0.0 {
            let _ = write!(base, " offset=\"{:?}\"", u.offset);
        }
        let _ = writeln!(out, "    <Unit name=\"{}\"><BaseUnit{base}/></Unit>", u.name);
    }
    *out += "  </UnitDefinitions>\n";
}

/// Causality, variability and initial of a role.
fn usage(v: &ScalarVariable) -> (&'static str, &'static str, Option<&'static str>) {
    match v.role {
        Role::Time => ("independent", "continuous", None),
        Role::Input => ("input", "continuous", None),
        Role::Output if v.kind == VariableType::Real => ("output", "continuous", Some("calculated")),
        Role::Output => ("output", "discrete", Some("calculated")),
        Role::Fixed => ("parameter", "fixed", Some("exact")),
        Role::Tunable => ("parameter", "tunable", Some("exact")),
    }
}

/// Name, causality and so on, alike in both versions.
fn common(v: &ScalarVariable) -> String {
    let (causality, variability, initial) = usage(v);
    let initial = initial.map(|i| format!(" initial=\"{i}\"")).unwrap_or_default();
    format!(
        "name=\"{}\" valueReference=\"{}\" description=\"{}\" causality=\"{causality}\" variability=\"{variability}\"{initial}",
        escaped(&v.name),
        v.reference,
        escaped(&v.meaning),
    )
}

/// Unit and value at the start.
fn values(v: &ScalarVariable) -> String {
    let mut out = String::new();
    if let Some(unit) = unit(v.unit) {
        let _ = write!(out, " unit=\"{}\"", unit.name);
    }
    if let Some(start) = v.start {
        let _ = match v.kind {
            VariableType::Real => write!(out, " start=\"{start:?}\""),
            VariableType::Integer => write!(out, " start=\"{start:.0}\""),
            VariableType::Boolean => write!(out, " start=\"{}\"", start != 0.0),
        };
    }
    out
}

fn variable_2(out: &mut String, v: &ScalarVariable) {
    let kind = match v.kind {
        VariableType::Real => "Real",
        VariableType::Integer => "Integer",
        VariableType::Boolean => "Boolean",
    };
    let _ = writeln!(out, "    <ScalarVariable {}><{kind}{}/></ScalarVariable>", common(v), values(v));
}

fn variable_3(out: &mut String, v: &ScalarVariable) {
    let kind = match v.kind {
        VariableType::Real => "Float64",
        VariableType::Integer => "Int32",
        VariableType::Boolean => "Boolean",
    };
    let _ = writeln!(out, "    <{kind} {}{}/>", common(v), values(v));
}

fn escaped(text: &str) -> String {
    let plain = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;");
    plain.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}
