//! Classical Runge-Kutta of order 4 with a fixed step: the paper's method.

/// One step of length h; `k1` is f(t, y).
pub fn step<const N: usize, X>(
    rhs: &mut impl FnMut(f64, &[f64; N]) -> Result<[f64; N], X>,
    t: f64,
    y: &[f64; N],
    k1: &[f64; N],
    h: f64,
) -> Result<[f64; N], X> {
    let shifted = |k: &[f64; N], s: f64| std::array::from_fn(|i| y[i] + s * k[i]);
    let k2 = rhs(t + 0.5 * h, &shifted(k1, 0.5 * h))?;
    let k3 = rhs(t + 0.5 * h, &shifted(&k2, 0.5 * h))?;
    let k4 = rhs(t + h, &shifted(&k3, h))?;
    Ok(std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn observed_order_is_four() {
        let error = |n: usize| {
            let (mut y, h) = ([1.0], 1.0 / n as f64);
            for i in 0..n {
                let mut f = |t: f64, y: &[f64; 1]| Ok::<_, ()>([y[0] * t.cos()]);
                let t = i as f64 * h;
                let k1 = f(t, &y).unwrap();
                y = step(&mut f, t, &y, &k1, h).unwrap();
            }
            (y[0] - 1f64.sin().exp()).abs()
        };
        let order = (error(10) / error(20)).log2();
        assert!((order - 4.0).abs() < 0.2, "{order}");
    }
}
