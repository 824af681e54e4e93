//! The slice method's approach as a smooth factor on the roller law.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use super::influence::{influence_m_per_pa, influence_sum};
use super::line::ContactError;
use super::slice::SliceContact;
use crate::numeric::chebyshev::Chebyshev;
use crate::numeric::toeplitz::solve_symmetric;

/// kappa = delta_slice/delta_H for square ends and a rigid approach, as a function of a/l.
///
/// With uniform Delta, (1)-(2) give delta_slice = delta_H n^2/(sum w . 1^T w^-1 1): only the number of
/// slices and a/l enter, so one table serves every contact and every load. It is a Chebyshev series in
/// ln(a/l) over [1e-7, 1], for a 6 mm contact of steel roughly 1e-6 N to 1e6 N; relative error below 1e-9
/// (5e-14 measured in the test). Outside the range the ratio is constant, slope 0.
#[derive(Debug, Clone, PartialEq)]
pub struct SliceRatio {
    slices: usize,
    series: Chebyshev,
}

/// Singularities lie at ln(a/l) = real +- i pi/2 (Phi's at c = +-i y), so over a half interval of 8.06 the
/// error falls as 1.214^-degree: 2e-12 at 140 for a coefficient of order 1, and they are far smaller.
const DEGREE: usize = 140;
/// Range of a/l tabulated, a choice; the slice method holds a/l to it. Beyond a = l there is no line contact.
pub(super) const HALF_WIDTH_PER_LENGTH: [f64; 2] = [1e-7, 1.0];

impl SliceRatio {
    /// Tabulates the ratio for `slices` slices (1..=[`SliceContact::MOST_SLICES`]): 141 Toeplitz solves.
    pub fn new(slices: usize) -> Result<Self, ContactError> {
        if !(1..=SliceContact::MOST_SLICES).contains(&slices) {
            return Err(ContactError::Slices { slices });
        }
        let [low, high] = HALF_WIDTH_PER_LENGTH.map(f64::ln);
        let series = Chebyshev::fit(low, high, DEGREE, |x| solved_ratio(slices, x.exp()));
        Ok(Self { slices, series })
    }

    /// The same, tabulated once in the life of the process: an optimiser sets a contact up thousands of times. A table
    /// depends on the number of slices alone, so it does not matter who builds it; all of them together take 5 MB.
    pub fn shared(slices: usize) -> Result<Arc<Self>, ContactError> {
        static TABLES: Mutex<BTreeMap<usize, Arc<SliceRatio>>> = Mutex::new(BTreeMap::new());
        let kept = || TABLES.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(table) = kept().get(&slices) {
            return Ok(table.clone());
        }
        // Not under the lock: others may want other tables meanwhile.
        let table = Arc::new(Self::new(slices)?);
        Ok(kept().entry(slices).or_insert(table).clone())
    }

    /// Number of slices n.
    pub fn slices(&self) -> usize {
        self.slices
    }

    /// (kappa, d kappa/d ln a) at the half width to length ratio a/l > 0.
    pub fn at(&self, half_width_per_length: f64) -> (f64, f64) {
        let (low, high) = self.series.interval();
        let x = half_width_per_length.ln();
        let inside = x.clamp(low, high);
        let slope = if inside == x { self.series.derivative(x) } else { 0.0 };
        (self.series.eval(inside), slope)
    }
}

/// n^2/(sum w . 1^T w^-1 1) by a Toeplitz solve.
fn solved_ratio(slices: usize, half_width_per_length: f64) -> f64 {
    let n = slices as f64;
    let w = influence_m_per_pa(half_width_per_length * n, 1.0, slices, 1.0);
    let ones = vec![1.0; slices];
    // w is positive definite: it is the elastic energy of the slices
    let sum = solve_symmetric(&w, [&ones]).map_or(f64::NAN, |[u]| u.iter().sum());
    n * n / (influence_sum(&w) * sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_meets_the_solves_between_its_points() {
        for slices in [1, 2, 7, 60, 150] {
            let ratio = SliceRatio::new(slices).unwrap();
            let mut worst: f64 = 0.0;
            for i in 0..=97 {
                let x = 1e-7f64.ln() * i as f64 / 97.0;
                let solved = solved_ratio(slices, x.exp());
                worst = worst.max((ratio.at(x.exp()).0 / solved - 1.0).abs());
            }
            println!("{slices} slices: worst relative error {worst:e}");
            assert!(worst < 1e-9, "{slices}: {worst}");
        }
    }

    #[test]
    fn a_narrow_contact_is_a_row_of_springs() {
        // a/l -> 0: each slice feels mostly itself (logarithmically), so kappa -> 1 from below
        let ratio = SliceRatio::new(60).unwrap();
        let at = |x: f64| ratio.at(x).0;
        assert!(at(1e-7) < 1.0 && at(1e-7) > at(1e-5) && at(1e-5) > at(1e-2));
        assert!(1.0 - at(1e-7) < 0.006, "{}", at(1e-7));
        // one slice: kappa = 1
        let (one, slope) = SliceRatio::new(1).unwrap().at(0.01);
        assert!((one - 1.0).abs() < 1e-13 && slope.abs() < 1e-11);
    }

    #[test]
    fn outside_the_table_the_ratio_is_constant() {
        let ratio = SliceRatio::new(20).unwrap();
        assert_eq!(ratio.at(1e-12), (ratio.at(1e-7).0, 0.0));
        assert_eq!(ratio.at(0.0), (ratio.at(1e-7).0, 0.0));
        assert_eq!(ratio.at(30.0), (ratio.at(1.0).0, 0.0));
    }

    #[test]
    fn a_shared_table_is_built_once_and_is_the_same() {
        let (a, b) = (SliceRatio::shared(23).unwrap(), SliceRatio::shared(23).unwrap());
        assert!(Arc::ptr_eq(&a, &b) && *a == SliceRatio::new(23).unwrap());
        assert!(SliceRatio::shared(0).is_err());
    }

    #[test]
    fn numbers_of_slices_out_of_range_are_refused() {
        assert!(matches!(SliceRatio::new(0), Err(ContactError::Slices { slices: 0 })));
        assert!(matches!(SliceRatio::new(2001), Err(ContactError::Slices { slices: 2001 })));
    }
}
