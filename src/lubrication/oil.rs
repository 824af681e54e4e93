//! The oils that a design may name.

use super::viscosity::Walther;

named! {
    /// What an oil, or the oil in a grease, is made of: it decides what pressure does to the viscosity.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum BaseOil {
        /// Mineral oil.
        Mineral = "mineral",
        /// Polyalphaolefin.
        Pao = "PAO",
        /// Ester.
        Ester = "ester",
    }
    /// In a word.
    pub fn name;
}

impl BaseOil {
    /// Constants (s, t) of Gold's alpha = s nu^t 1e-9 1/Pa, nu in mm^2/s (Gold and others 2001, typical of the kind: single oils lie
    /// some 15 % about it).
    fn gold(self) -> (f64, f64) {
        match self {
            Self::Mineral => (9.904, 0.1390),
            Self::Pao => (7.382, 0.1335),
            Self::Ester => (6.605, 0.1360),
        }
    }
}

/// A lubricant. Viscosities are kinematic, as data sheets have them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oil {
    /// Name.
    pub name: &'static str,
    /// What it is made of.
    pub base: BaseOil,
    /// Kinematic viscosity at 40 C, m^2/s.
    pub nu40_m2_s: f64,
    /// The same at 100 C.
    pub nu100_m2_s: f64,
    /// Density at 15 C, kg/m^3.
    pub density_kg_m3: f64,
    /// Where the figures come from.
    pub source: &'static str,
}

/// Relative loss of density by temperature, 1/K: oils have 6 to 8e-4.
const EXPANSION_PER_K: f64 = 6.5e-4;

impl Oil {
    /// Viscosity over temperature.
    pub fn walther(&self) -> Walther {
        Walther::through(self.nu40_m2_s, self.nu100_m2_s)
    }

    /// Density at `celsius`, kg/m^3.
    pub fn density_kg_m3(&self, celsius: f64) -> f64 {
        self.density_kg_m3 * (1.0 - EXPANSION_PER_K * (celsius - 15.0))
    }

    /// Dynamic viscosity without pressure at `celsius`, Pa s.
    pub fn viscosity_pa_s(&self, celsius: f64) -> f64 {
        self.walther().nu_m2_s(celsius) * self.density_kg_m3(celsius)
    }

    /// Pressure-viscosity coefficient at `celsius`, 1/Pa: Gold, alpha = s nu^t.
    pub fn pressure_coefficient_per_pa(&self, celsius: f64) -> f64 {
        let (s, t) = self.base.gold();
        1e-9 * s * (1e6 * self.walther().nu_m2_s(celsius)).powf(t)
    }

    /// -d ln eta/dT at `celsius`, 1/K.
    pub fn thinning_per_k(&self, celsius: f64) -> f64 {
        let eta = |t: f64| self.viscosity_pa_s(t).ln();
        0.5 * (eta(celsius - 1.0) - eta(celsius + 1.0))
    }
}

const VG: &str = "40 C and grade ISO 3448; 100 C and density typical of a mineral oil of viscosity index 95 to 100; alpha Gold";

/// An oil from the numbers of data sheets: mm^2/s.
const fn from_sheet(
    name: &'static str,
    base: BaseOil,
    nu: [f64; 2],
    density: f64,
    source: &'static str,
) -> Oil {
    Oil { name, base, nu40_m2_s: 1e-6 * nu[0], nu100_m2_s: 1e-6 * nu[1], density_kg_m3: density, source }
}

/// The library: typical values of each kind, no maker's promise. A grease feeds the contact with its base oil.
pub const OILS: [Oil; 19] = [
    from_sheet("ISO VG 10", BaseOil::Mineral, [10.0, 2.6], 850.0, VG),
    from_sheet("ISO VG 15", BaseOil::Mineral, [15.0, 3.4], 855.0, VG),
    from_sheet("ISO VG 22", BaseOil::Mineral, [22.0, 4.3], 862.0, VG),
    from_sheet("ISO VG 32", BaseOil::Mineral, [32.0, 5.4], 868.0, VG),
    from_sheet("ISO VG 46", BaseOil::Mineral, [46.0, 6.8], 872.0, VG),
    from_sheet("ISO VG 68", BaseOil::Mineral, [68.0, 8.7], 877.0, VG),
    from_sheet("ISO VG 100", BaseOil::Mineral, [100.0, 11.2], 882.0, VG),
    from_sheet("ISO VG 150", BaseOil::Mineral, [150.0, 14.7], 887.0, VG),
    from_sheet("ISO VG 220", BaseOil::Mineral, [220.0, 19.0], 892.0, VG),
    from_sheet("ISO VG 320", BaseOil::Mineral, [320.0, 24.1], 897.0, VG),
    from_sheet("ISO VG 460", BaseOil::Mineral, [460.0, 30.5], 901.0, VG),
    from_sheet(
        "PAO 6",
        BaseOil::Pao,
        [30.5, 5.9],
        827.0,
        "typical of makers' sheets for polyalphaolefin, 6 mm^2/s at 100 C; alpha Gold",
    ),
    from_sheet(
        "PAO 40",
        BaseOil::Pao,
        [395.0, 40.0],
        847.0,
        "typical of makers' sheets for polyalphaolefin, 40 mm^2/s at 100 C; alpha Gold",
    ),
    from_sheet(
        "MIL-PRF-7808",
        BaseOil::Ester,
        [12.5, 3.2],
        950.0,
        "turbine oil, grade 3: at least 3.0 mm^2/s at 100 C; 40 C and density typical of makers' sheets; alpha Gold (ester)",
    ),
    from_sheet(
        "MIL-PRF-23699",
        BaseOil::Ester,
        [27.6, 5.1],
        1003.5,
        "turbine oil: 4.90 to 5.40 mm^2/s at 100 C, at least 23.0 at 40 C; values of Mobil Jet Oil II; alpha Gold (ester)",
    ),
    from_sheet(
        "ATF Dexron III",
        BaseOil::Mineral,
        [34.0, 7.3],
        865.0,
        "typical of makers' sheets; alpha Gold (mineral)",
    ),
    from_sheet(
        "grease, mineral VG 100",
        BaseOil::Mineral,
        [100.0, 11.2],
        882.0,
        "base oil of a common lithium grease NLGI 2: as ISO VG 100; a starved track has less film",
    ),
    from_sheet(
        "grease, mineral VG 220",
        BaseOil::Mineral,
        [220.0, 19.0],
        892.0,
        "base oil of a lithium complex grease for load: as ISO VG 220; a starved track has less film",
    ),
    from_sheet(
        "grease, PAO VG 32",
        BaseOil::Pao,
        [30.5, 5.9],
        827.0,
        "base oil of a grease for low temperatures: as PAO 6; a starved track has less film",
    ),
];

/// The oil of that name, whatever its capitals.
pub fn oil(name: &str) -> Option<&'static Oil> {
    OILS.iter().find(|o| o.name.eq_ignore_ascii_case(name.trim()))
}
