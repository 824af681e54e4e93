//! `[lubrication]` as written, and the same in SI.
//!
//! In: TOML text. Out: [`Lubrication`]. Absent: the oils (`lubrication`), what a film does (`friction`). Equations: none. The doc
//! comments are the schema's descriptions.

use super::design_file::DesignFile;
use super::findings::Findings;
use crate::clutch::{Lubrication, SlipCase};
use crate::design::m;
use crate::design::nearest;
use crate::lubrication::{OILS, Oil, oil};
use schemars::JsonSchema;
use serde::Deserialize;

/// Oil or grease of the clutch, surfaces of the inner contact and what leads their heat away: read by `overrun`, and by `check` and
/// scenarios of kind overrun for the friction of the inner contact where it slides.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct LubricationFile {
    /// Name of an oil or grease: `sprag-design oils` lists them.
    #[schemars(length(min = 1))]
    pub oil: String,
    /// Kinematic viscosity at 40 C from the data sheet, mm^2/s, in place of that of the name.
    #[schemars(extend("minimum" = 1, "maximum" = 5000))]
    pub nu40_mm2_s: Option<f64>,
    /// Kinematic viscosity at 100 C from the data sheet, mm^2/s.
    #[schemars(extend("minimum" = 1, "maximum" = 1000))]
    pub nu100_mm2_s: Option<f64>,
    /// Temperature of oil and housing, C.
    #[schemars(extend("minimum" = -60, "maximum" = 250))]
    pub temperature_c: f64,
    /// balance: the film is at the temperature that contact and bodies reach; given: at temperature_c.
    #[serde(default)]
    pub temperatures: TemperaturesFile,
    /// Roughness Rq of the track that sprags slide on, the inner race's, in a [cage] the outer one's, um.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 100))]
    pub race_roughness_um: f64,
    /// Roughness Rq of the sprags, um.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 100))]
    pub sprag_roughness_um: f64,
    /// Coefficient of friction where asperities carry the load; absent: friction.static.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1))]
    pub boundary_friction: Option<f64>,
    /// Archard's coefficient of the sprags, mm^3/(N m), of the load that asperities carry.
    #[serde(default = "boundary_lubricated")]
    #[schemars(extend("minimum" = 0))]
    pub sprag_wear_mm3_per_nm: f64,
    /// Archard's coefficient of the race that sprags slide on, mm^3/(N m), of the load that asperities carry.
    #[serde(default = "boundary_lubricated")]
    #[schemars(extend("minimum" = 0))]
    pub race_wear_mm3_per_nm: f64,
    /// From inner race (with its shaft) to the oil, W/K; absent: 200 W/(m^2 K) times its surface.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub inner_race_to_oil_w_per_k: Option<f64>,
    /// From all sprags to the oil, W/K; absent: as above.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub sprags_to_oil_w_per_k: Option<f64>,
    /// From outer race and housing to the oil, W/K; absent: as above.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub outer_race_to_oil_w_per_k: Option<f64>,
    /// Mean heat of slips at the inner contact beside the drag, all sprags, W: the work of a slip times how often it comes in a second.
    #[serde(default)]
    #[schemars(extend("minimum" = 0))]
    pub slip_heat_w: f64,
    /// A slip whose flash temperature and wear are asked for.
    pub slip: Option<SlipFile>,
}

/// Order of hardened steel on hardened steel with oil between, mm^3/(N m): published values run from 1e-10 to 1e-7.
fn boundary_lubricated() -> f64 {
    1e-9
}

/// Where the film's temperature comes from.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(super) enum TemperaturesFile {
    #[default]
    Balance,
    Given,
}

/// A slip under load.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SlipFile {
    /// Torque that the clutch carries, N m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub torque_nm: f64,
    /// Sliding speed of the inner contact, m/s.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub speed_m_s: f64,
    /// How far it slides, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub path_mm: f64,
}

/// `[lubrication]` in SI, `Some(None)` without the table; `None` with the reasons in `out`.
pub(super) fn lubrication(file: &DesignFile, out: &mut Findings) -> Option<Option<Lubrication>> {
    let Some(f) = &file.lubrication else { return Some(None) };
    let Some(named) = oil(&f.oil) else {
        let names: Vec<&str> = OILS.iter().map(|o| o.name).collect();
        let like = nearest(&f.oil, &names).map_or(String::new(), |name| format!("did you mean {name}? "));
        let help = format!(
            "{like}`sprag-design oils` lists them; nu40_mm2_s and nu100_mm2_s say of another what it has"
        );
        // Some have commas.
        out.refuse(&["lubrication.oil"], names.join("; "), help);
        return None;
    };
    let m2_s = |mm2_s: f64| mm2_s / 1e6;
    let oil = Oil {
        nu40_m2_s: f.nu40_mm2_s.map_or(named.nu40_m2_s, m2_s),
        nu100_m2_s: f.nu100_mm2_s.map_or(named.nu100_m2_s, m2_s),
        ..*named
    };
    if oil.nu100_m2_s >= oil.nu40_m2_s {
        let [nu40, nu100] = ["lubrication.nu40_mm2_s", "lubrication.nu100_mm2_s"];
        let (keys, allowed) = match f.nu100_mm2_s {
            Some(_) => (
                [nu100, nu40, "lubrication.oil"],
                format!("less than at 40 C, {} mm^2/s", 1e6 * oil.nu40_m2_s),
            ),
            None => (
                [nu40, nu100, "lubrication.oil"],
                format!("more than at 100 C, {} mm^2/s", 1e6 * oil.nu100_m2_s),
            ),
        };
        out.refuse(
            &keys,
            allowed,
            "give both viscosities of the data sheet: oils thin as they get warm".to_owned(),
        );
        return None;
    }
    let um = |um: f64| um / 1e6;
    Some(Some(Lubrication {
        oil,
        temperature_c: f.temperature_c,
        heat_balance: f.temperatures == TemperaturesFile::Balance,
        race_roughness_m: um(f.race_roughness_um),
        sprag_roughness_m: um(f.sprag_roughness_um),
        boundary_friction: f.boundary_friction.unwrap_or(file.friction.static_),
        sprag_wear_m2_per_n: 1e-9 * f.sprag_wear_mm3_per_nm,
        race_wear_m2_per_n: 1e-9 * f.race_wear_mm3_per_nm,
        to_oil_w_per_k: [f.inner_race_to_oil_w_per_k, f.sprags_to_oil_w_per_k, f.outer_race_to_oil_w_per_k],
        slip_heat_w: f.slip_heat_w,
        slip: f.slip.map(|s| SlipCase {
            torque_nm: s.torque_nm,
            speed_m_s: s.speed_m_s,
            path_m: m(s.path_mm),
        }),
    }))
}
