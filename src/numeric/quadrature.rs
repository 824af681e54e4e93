//! Gauss-Legendre quadrature.

/// Nodes and weights of the 12-point rule on [-1, 1], positive half (Abramowitz & Stegun, table 25.4).
const HALF: [(f64, f64); 6] = [
    (0.125233408511468915472, 0.249147045813402785001),
    (0.367831498998180193753, 0.233492536538354808761),
    (0.587317954286617447297, 0.203167426723065921749),
    (0.769902674194304687037, 0.160078328543346226335),
    (0.904117256370474856678, 0.106939325995318430960),
    (0.981560634246719250690, 0.047175336386511827195),
];

/// Integral of `f` over [a, b], exact for polynomials up to degree 23.
pub fn integral(a: f64, b: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    half * HALF.iter().map(|&(x, w)| w * (f(middle - half * x) + f(middle + half * x))).sum::<f64>()
}

/// The same for several functions at once.
pub fn integrals<const M: usize>(a: f64, b: f64, mut f: impl FnMut(f64) -> [f64; M]) -> [f64; M] {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let mut sum = [0.0; M];
    for (x, w) in HALF {
        let (left, right) = (f(middle - half * x), f(middle + half * x));
        for i in 0..M {
            sum[i] += half * w * (left[i] + right[i]);
        }
    }
    sum
}

/// Nodes and weights of the rule on [a, b], from a to b. Parts as long as the weights, one after the other, hold a node each
/// (Chebyshev, Markov, Stieltjes).
pub fn nodes(a: f64, b: f64) -> impl Iterator<Item = (f64, f64)> {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let before = HALF.into_iter().rev().map(move |(x, w)| (middle - half * x, half * w));
    before.chain(HALF.into_iter().map(move |(x, w)| (middle + half * x, half * w)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_come_in_order_each_in_its_own_part() {
        let mut from = 1.0;
        for (x, w) in nodes(1.0, 3.0) {
            assert!(from < x && x < from + w, "{x}");
            from += w;
        }
        assert!((from - 3.0).abs() < 1e-14);
        let s: f64 = nodes(0.0, 2.0).map(|(x, w)| w * x.powi(23)).sum();
        assert!((s / (2f64.powi(24) / 24.0) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn exact_to_degree_23() {
        let s = integral(0.0, 2.0, |x| x.powi(23));
        assert!((s / (2f64.powi(24) / 24.0) - 1.0).abs() < 1e-14);
    }
}
