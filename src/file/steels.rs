//! Materials of a file: by name from the library, by key, or both; and the limits that the library allows them.
//!
//! In: `[material]`. Out: [`Materials`], expansions, limits. Absent: the library itself (`material`). Equations: none.

use super::design_file::{BodyFile, MaterialFile};
use super::findings::Findings;
use super::inputs::{Input, inputs};
use crate::clutch::Materials;
use crate::design::Limits;
use crate::design::LimitsFile;
use crate::design::nearest;
use crate::material::{Material, STEELS, Steel, steel};

/// The keys that a material has; the first three make it complete where it has no name.
pub(super) const MATERIAL_KEYS: [&str; 5] =
    ["youngs_modulus_gpa", "poisson_ratio", "density_kg_m3", "name", "expansion_um_per_m_k"];
/// See [`MATERIAL_KEYS`].
pub(super) const BODIES: [&str; 3] = ["sprag", "inner_race", "outer_race"];

/// Keys of one body with the path of their table.
struct Body<'f> {
    path: String,
    keys: BodyFile,
    named: Option<&'f str>,
}

/// The bodies in the order of [`BODIES`], each with the keys that hold for it; `None` where the two ways are mixed or a
/// table is missing.
fn bodies<'f>(file: &'f MaterialFile, out: &mut Findings) -> Option<[Body<'f>; 3]> {
    let common = BodyFile {
        name: file.name.clone(),
        youngs_modulus_gpa: file.youngs_modulus_gpa,
        poisson_ratio: file.poisson_ratio,
        density_kg_m3: file.density_kg_m3,
        expansion_um_per_m_k: file.expansion_um_per_m_k,
    };
    let any_common = common.name.is_some()
        || [
            common.youngs_modulus_gpa,
            common.poisson_ratio,
            common.density_kg_m3,
            common.expansion_um_per_m_k,
        ]
        .iter()
        .any(Option::is_some);
    let given = [&file.sprag, &file.inner_race, &file.outer_race];
    if given.iter().all(|b| b.is_none()) {
        let body = || Body { path: "material".to_owned(), keys: common.clone(), named: file.name.as_deref() };
        return Some([body(), body(), body()]);
    }
    if any_common {
        refuse_mixed_material(out);
        return None;
    }
    let mut all = Vec::new();
    for (name, body) in BODIES.into_iter().zip(given) {
        let path = format!("material.{name}");
        match body {
            Some(body) => all.push(Body { path, keys: body.clone(), named: body.name.as_deref() }),
            None => {
                out.refuse(&[&path], super::shape::meaning_of(&path), format!("add the table [{path}]"));
            }
        }
    }
    all.try_into().ok()
}

/// One table holds either the keys or the bodies, so that no key is written and then without effect.
pub(super) fn refuse_mixed_material(out: &mut Findings) {
    let keys: Vec<String> = MATERIAL_KEYS.iter().chain(&BODIES).map(|k| format!("material.{k}")).collect();
    let scoped: Vec<&str> = keys.iter().map(String::as_str).filter(|k| out.has(k) || *k == keys[0]).collect();
    out.refuse(
        &scoped,
        "either keys for all bodies, or the tables sprag, inner_race and outer_race".to_owned(),
        "move the keys of [material] into the tables of the bodies".to_owned(),
    );
}

/// A steel of the library, by name.
///
/// # Errors
/// The names there are.
pub fn a_steel(name: &str) -> Result<&'static Steel, String> {
    steel(name).ok_or_else(|| {
        let names: Vec<&str> = STEELS.iter().map(|s| s.name).collect();
        let like = nearest_steel(name).map_or(String::new(), |like| format!("did you mean {like}? "));
        format!("{like}the library has {}", names.join(", "))
    })
}

/// The name of a steel that this one is misspelt for: with two digits of another it is another steel.
pub fn nearest_steel(name: &str) -> Option<&'static str> {
    let digits = |name: &str| name.chars().filter(char::is_ascii_digit).collect::<Vec<char>>();
    let own = digits(name);
    let misspelt = |known: &&str| {
        let of = digits(known);
        of.len() == own.len() && of.iter().zip(&own).filter(|(a, b)| a != b).count() <= 1
    };
    let all = STEELS.iter().flat_map(|s| std::iter::once(s.name).chain(s.also.iter().copied()));
    let alike: Vec<&str> = all.filter(misspelt).collect();
    let found = nearest(name, &alike)?;
    alike.iter().copied().find(|alike| *alike == found)
}

/// The steel that a body names; `Err` where there is none of that name.
fn named(body: &Body<'_>, out: &mut Findings) -> Result<Option<&'static Steel>, ()> {
    let Some(name) = body.named else { return Ok(None) };
    if let Some(found) = steel(name) {
        return Ok(Some(found));
    }
    let names: Vec<&str> = STEELS.iter().map(|s| s.name).collect();
    let help = match nearest_steel(name) {
        Some(like) => format!("did you mean {like}? `sprag-design materials` lists them"),
        None => "give youngs_modulus_gpa, poisson_ratio and density_kg_m3 instead; `sprag-design materials` lists the \
                 steels there are"
            .to_owned(),
    };
    out.refuse(&[&format!("{}.name", body.path)], names.join(", "), help);
    Err(())
}

/// Materials of the three bodies, or `None` with the reasons in `out`.
pub(super) fn materials(file: &MaterialFile, out: &mut Findings) -> Option<Materials> {
    let bodies = bodies(file, out)?;
    let alike = bodies[0].path == bodies[1].path;
    let mut found = Vec::new();
    for body in &bodies {
        let steel = named(body, out).ok()?;
        let keys = &body.keys;
        let from = steel.map(|s| s.material);
        let values = [
            keys.youngs_modulus_gpa.map(|e| e * 1e9).or(from.map(|m| m.youngs_modulus_pa)),
            keys.poisson_ratio.or(from.map(|m| m.poisson_ratio)),
            keys.density_kg_m3.or(from.map(|m| m.density_kg_m3)),
        ];
        for (name, _) in MATERIAL_KEYS.into_iter().zip(values).filter(|(_, v)| v.is_none()) {
            let path = format!("{}.{name}", body.path);
            out.refuse(
                &[&path],
                super::shape::meaning_of(&path),
                format!("add {name} = ... to [{}], or the name of a steel", body.path),
            );
        }
        let [Some(youngs_modulus_pa), Some(poisson_ratio), Some(density_kg_m3)] = values else {
            if alike { return None } else { continue }
        };
        found.push(Material { youngs_modulus_pa, poisson_ratio, density_kg_m3 });
    }
    let [sprag, inner_race, outer_race] = found.try_into().ok()?;
    Some(Materials { sprag, inner_race, outer_race })
}

/// Thermal expansion of the three bodies, 1/K, or `None` with the key that is missing in `out`.
pub(super) fn expansions(file: &MaterialFile, out: &mut Findings) -> Option<[f64; 3]> {
    let bodies = bodies(file, out)?;
    let mut found = [0.0; 3];
    for (body, expansion) in bodies.iter().zip(&mut found) {
        let steel = named(body, out).ok()?;
        let key = body.keys.expansion_um_per_m_k.map(|x| x * 1e-6).or(steel.map(|s| s.expansion_per_k));
        let Some(value) = key else {
            let path = format!("{}.expansion_um_per_m_k", body.path);
            out.refuse(
                &[&path, "thermal"],
                super::shape::meaning_of(&path),
                format!("add expansion_um_per_m_k = 12.0 (steel) to [{}], or the name of a steel", body.path),
            );
            return None;
        };
        *expansion = value;
    }
    Some(found)
}

/// Of each table of a file that names a steel beside numbers of its own: that the numbers win, a sentence each.
pub fn beside_the_name(source: &str) -> Vec<String> {
    let all = inputs(source);
    let names = all.iter().filter(|i| i.path.starts_with("material.") && i.path.ends_with(".name"));
    let told = |name: &Input| {
        let table = name.path.strip_suffix(".name")?;
        let own: Vec<&str> = MATERIAL_KEYS
            .into_iter()
            .filter(|key| *key != "name" && all.iter().any(|i| i.path == format!("{table}.{key}")))
            .collect();
        (!own.is_empty()).then(|| {
            format!(
                "Note: [{table}] names {} and gives {} by number, which win over the name; remove the numbers to take those \
                 of the steel",
                name.text,
                own.join(", ")
            )
        })
    };
    names.filter_map(told).collect()
}

/// Names of the materials of sprag, inner race and outer race as `source` gives them; none of one that is given by numbers
/// alone.
pub fn names_of_bodies(source: &str) -> [Option<String>; 3] {
    let all = inputs(source);
    let named =
        |path: String| all.iter().find(|i| i.path == path).map(|i| i.text.trim_matches('"').to_owned());
    BODIES.map(|body| named(format!("material.{body}.name")).or_else(|| named("material.name".to_owned())))
}

/// `base` with the limits that the library allows the named materials: the lower Hertz pressure of sprag and races where
/// the torque at which it is held is known, and the race stress as mean hoop stress. Nothing where the material has no
/// name: that is refused.
pub(super) fn limits(file: &LimitsFile, base: Limits, out: &mut Findings) -> Limits {
    let text = |path: &str| out.text(path).and_then(steel);
    let common = text("material.name");
    let of = |body: &str| text(&format!("material.{body}.name")).or(common);
    let [Some(sprag), Some(inner), Some(outer)] = BODIES.map(of) else {
        // A name that is not known is refused where it stands.
        let mut paths =
            BODIES.iter().map(|body| format!("material.{body}.name")).chain(["material.name".to_owned()]);
        if paths.any(|path| out.text(&path).is_some_and(|name| steel(name).is_none())) {
            return base;
        }
        out.refuse(
            &["limits.from_material", "material"],
            "true only where [material], or each of its bodies, has a name".to_owned(),
            "add name = \"100Cr6\" or another of `sprag-design materials`, or give the limits by key"
                .to_owned(),
        );
        return base;
    };
    let least =
        |value: fn(&Steel) -> f64| [sprag, inner, outer].map(value).into_iter().fold(f64::INFINITY, f64::min);
    let nominal = file.nominal_torque_nm.or(base.nominal_torque_nm).is_some();
    let peak = file.peak_torque_nm.or(base.peak_torque_nm).is_some();
    Limits {
        hertz_nominal_pa: nominal.then(|| least(|s| s.hertz_nominal_pa)).or(base.hertz_nominal_pa),
        hertz_peak_pa: peak.then(|| least(|s| s.hertz_peak_pa)).or(base.hertz_peak_pa),
        hoop_inner_pa: peak.then_some(inner.race_stress_pa).or(base.hoop_inner_pa),
        hoop_outer_pa: peak.then_some(outer.race_stress_pa).or(base.hoop_outer_pa),
        ..base
    }
}
