//! Test oracle: the radial equilibrium of a rotating ring in plane stress, integrated numerically.
//!
//! u' = (1-nu^2) sigma_r/E - nu u/r, sigma_r' = (sigma_hoop - sigma_r)/r - rho omega^2 r,
//! sigma_hoop = E u/r + nu sigma_r. Knows neither Lame nor (7).

use crate::material::Material;

/// Displacement and hoop stress at one rim.
pub struct Rim {
    pub growth_m: f64,
    pub hoop_pa: f64,
}

/// Ring whose rims carry given radial stresses.
pub struct Disc {
    inside_m: f64,
    outside_m: f64,
    material: Material,
    speed_rad_s: f64,
}

impl Disc {
    pub fn new(inside_m: f64, outside_m: f64, material: Material, speed_rad_s: f64) -> Self {
        Self { inside_m, outside_m, material, speed_rad_s }
    }

    fn slope(&self, r: f64, [u, s]: [f64; 2]) -> [f64; 2] {
        let (e, nu) = (self.material.youngs_modulus_pa, self.material.poisson_ratio);
        let hoop = e * u / r + nu * s;
        [
            (1.0 - nu * nu) * s / e - nu * u / r,
            (hoop - s) / r - self.material.density_kg_m3 * self.speed_rad_s.powi(2) * r,
        ]
    }

    /// Fourth-order Runge-Kutta from the inside rim outwards.
    fn shoot(&self, start: [f64; 2]) -> [f64; 2] {
        let steps = 2000;
        let h = (self.outside_m - self.inside_m) / steps as f64;
        let add = |y: [f64; 2], k: [f64; 2], f: f64| [y[0] + f * k[0], y[1] + f * k[1]];
        (0..steps).fold(start, |y, i| {
            let r = self.inside_m + i as f64 * h;
            let k1 = self.slope(r, y);
            let k2 = self.slope(r + 0.5 * h, add(y, k1, 0.5 * h));
            let k3 = self.slope(r + 0.5 * h, add(y, k2, 0.5 * h));
            let k4 = self.slope(r + h, add(y, k3, h));
            [0, 1].map(|j| y[j] + h / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]))
        })
    }

    /// Inside and outside rim for the radial stresses given there, Pa, tension positive. The problem is
    /// linear: two shots fix the unknown displacement of the inside rim.
    pub fn rims(&self, inside_pa: f64, outside_pa: f64) -> (Rim, Rim) {
        let trial_m = 1e-5;
        let zero = self.shoot([0.0, inside_pa])[1];
        let one = self.shoot([trial_m, inside_pa])[1];
        let u = trial_m * (outside_pa - zero) / (one - zero);
        let [end, _] = self.shoot([u, inside_pa]);
        let rim = |r: f64, u: f64, s: f64| Rim {
            growth_m: u,
            hoop_pa: self.material.youngs_modulus_pa * u / r + self.material.poisson_ratio * s,
        };
        (rim(self.inside_m, u, inside_pa), rim(self.outside_m, end, outside_pa))
    }
}
