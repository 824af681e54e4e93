//! The flash of a slip: how hot the surfaces of a contact get above their bodies.
//!
//! A semi-elliptic source stands on the sprag and passes over the race. Heat goes straight in: no sideways flow, so the flash is too hot
//! where heat spreads as wide as the source, below Peclet numbers of some 5 ([`peclet`]). Alone, the sprag's middle would take 4/pi of
//! the mean flux q, T_s = (4/pi) D by Duhamel's integral
//!
//!   D(t) = 1/(e sqrt(pi)) int q(tau)/sqrt(t - tau) dtau,
//!
//! and so would the race before the source has moved away; once it has passed, the race's hottest place is at T_r = 1.11 q sqrt(2 a/v)/e
//! (Blok, Jaeger). Heat is shared so that both are equally hot (Blok's postulate), 1/T = 1/T_s + 1/T_r, T_r the smaller of the two. Of
//! conduction straight in, shared so at every instant, that is 8 % too cold to 5 % too hot: steady slips, half sines, braking and
//! speeding up from rest, under a steady load and one that grows and falls, over 0.1 to 20 times the source's width.

use super::heat::{STEEL_DIFFUSIVITY_M2_S, STEEL_EFFUSIVITY};
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_2_SQRT_PI, LN_2, PI, SQRT_2};

/// Rise of a surface that takes `flux_w_m2` for `time_s` from cold, K: 2 q sqrt(t/pi)/e.
fn steady_k(flux_w_m2: f64, time_s: f64) -> f64 {
    FRAC_2_SQRT_PI * flux_w_m2 * time_s.sqrt() / STEEL_EFFUSIVITY
}

/// Rise of the hottest place, K, where the mean flux would warm a surface to `standing_k` by now, and to `passed_k` at the flux of the
/// moment while the source passes over it.
fn shared_k(standing_k: f64, passed_k: f64) -> f64 {
    let sprag = 4.0 / PI * standing_k;
    let race = sprag.min(1.11 / FRAC_2_SQRT_PI * passed_k);
    if race > 0.0 { race * sprag / (race + sprag) } else { 0.0 }
}

/// Rise of the hottest place in a slip, K, at a steady mean flux of `flux_w_m2` and half width `half_m`, at `speed_m_s`, for `path_m`.
pub fn flash_k(flux_w_m2: f64, half_m: f64, speed_m_s: f64, path_m: f64) -> f64 {
    if speed_m_s <= 0.0 || path_m <= 0.0 {
        return 0.0;
    }
    shared_k(steady_k(flux_w_m2, path_m / speed_m_s), steady_k(flux_w_m2, 2.0 * half_m / speed_m_s))
}

/// a^2/(kappa t), t the time for which a place of the race is warmed, `time_s` or no longer than the source passes: then it is
/// v a/(2 kappa), the Peclet number. Below some 5 heat goes sideways too.
pub fn peclet(half_m: f64, speed_m_s: f64, time_s: f64) -> f64 {
    let passes_s = 2.0 * half_m / speed_m_s;
    half_m * half_m / (STEEL_DIFFUSIVITY_M2_S * passes_s.min(time_s))
}

/// For how long heat stays below a source of half width `half_m` before it has gone sideways, s: a^2/kappa.
pub fn stays_s(half_m: f64) -> f64 {
    half_m * half_m / STEEL_DIFFUSIVITY_M2_S
}

/// Decays that 1/sqrt(t) is a sum of, each twice as fast as the one before.
const DECAYS: usize = 56;
/// The slowest, 1/s.
const SLOWEST_PER_S: f64 = 1.0 / 16_384.0;

/// Two surfaces under a source that changes, from cold. D is a sum over decays, so that nothing of the past is kept but one number
/// each:
///
///   1/sqrt(t) = 1/sqrt(pi) int exp(x/2 - t e^x) dx = (ln 2)/sqrt(pi) sum sqrt(s) exp(-s t), s doubling,
///
/// the trapezoidal rule, which is wrong by 2 |Gamma(1/2 + 2 pi i/ln 2)|/sqrt(pi) = 2e-6 of it. Slower and faster decays than those kept
/// have taken all, or follow at once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flash {
    /// int q exp(-s (t - tau)) dtau of each decay, J/m^2.
    held: [f64; DECAYS],
    /// int q dtau, J/m^2.
    taken: f64,
}

impl Flash {
    /// Nothing has slipped.
    pub const COLD: Self = Self { held: [0.0; DECAYS], taken: 0.0 };

    /// Slip for `time_s` more at a mean flux of `flux_w_m2` under a source of half width `half_m` that moves at `speed_m_s`: rise of
    /// the hottest place at its end, K.
    pub fn slip(&mut self, flux_w_m2: f64, half_m: f64, speed_m_s: f64, time_s: f64) -> f64 {
        let standing_k = self.stand(flux_w_m2, time_s);
        if speed_m_s <= 0.0 {
            return 0.0;
        }
        shared_k(standing_k, steady_k(flux_w_m2, 2.0 * half_m / speed_m_s))
    }

    /// Rest for `time_s`, without heat.
    pub fn rest(&mut self, time_s: f64) {
        self.stand(0.0, time_s);
    }

    /// D after `time_s` more under `flux_w_m2`, K.
    fn stand(&mut self, flux_w_m2: f64, time_s: f64) -> f64 {
        // 1 - exp(-s t): twice s, and it is x (2 - x) of what it was, exact however small.
        let mut decayed = -(-SLOWEST_PER_S * time_s).exp_m1();
        let (mut rate, mut root, mut sum) = (SLOWEST_PER_S, SLOWEST_PER_S.sqrt(), 0.0);
        for held in &mut self.held {
            *held += (flux_w_m2 / rate - *held) * decayed;
            sum += root * *held;
            (rate, root, decayed) = (2.0 * rate, SQRT_2 * root, decayed * (2.0 - decayed));
        }
        self.taken += flux_w_m2 * time_s;
        // sum sqrt(s) below the slowest and sum 1/sqrt(s) from the next after the fastest on.
        let beyond = 1.0 / (1.0 - FRAC_1_SQRT_2);
        sum += beyond * (SLOWEST_PER_S.sqrt() * FRAC_1_SQRT_2 * self.taken + flux_w_m2 / root);
        LN_2 / PI * sum / STEEL_EFFUSIVITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_steady_slip_in_parts_is_the_flash_of_the_whole() {
        let (flux, half, speed) = (1e8, 0.15e-3, 0.5);
        for (path, parts) in [(1e-7, 1), (1e-5, 7), (2e-4, 100), (3e-3, 40), (1.0, 1000)] {
            let mut flash = Flash::COLD;
            let mut rise = 0.0;
            for _ in 0..parts {
                rise = flash.slip(flux, half, speed, path / speed / f64::from(parts));
            }
            let whole = flash_k(flux, half, speed, path);
            assert!((rise / whole - 1.0).abs() < 5e-6, "{path}: {rise} for {whole}");
        }
        let mut cold = Flash::COLD;
        assert_eq!([cold.slip(0.0, 0.0, 1.0, 1e-3), cold.slip(flux, half, 0.0, 1.0)], [0.0; 2]);
    }

    /// Heat for t_1, rest for t_2: D = 2 q/(e sqrt(pi)) (sqrt(t_1 + t_2) - sqrt(t_2)).
    #[test]
    fn what_rests_cools_as_duhamel_says() {
        for (heated_s, rested_s) in [(1e-6, 1e-3), (1e-3, 1e-6), (1e-2, 1e-2)] {
            let mut flash = Flash::COLD;
            flash.stand(1e8, heated_s);
            let rise = flash.stand(0.0, rested_s);
            let wanted = steady_k(1e8, 1.0) * ((heated_s + rested_s).sqrt() - rested_s.sqrt());
            assert!((rise / wanted - 1.0).abs() < 1e-5, "{rise} for {wanted}");
        }
    }
}
