//! The top of a function with one hump.

/// 2 over 1 + sqrt 5.
const SHARE: f64 = 0.618_033_988_749_894_9;

/// Place on [a, b] at which `f`, with one hump there, is largest, by golden sections to rounding; a smooth top is met to the root of that.
pub fn top(mut a: f64, mut b: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..60 {
        let (c, d) = (b - SHARE * (b - a), a + SHARE * (b - a));
        if f(c) > f(d) { b = d } else { a = c }
    }
    0.5 * (a + b)
}

#[cfg(test)]
mod tests {
    use super::top;

    #[test]
    fn smooth_tops_corners_and_ends_are_met() {
        assert!((top(0.0, 3.0, f64::sin) - std::f64::consts::FRAC_PI_2).abs() < 1e-7);
        assert!((top(-1.0, 4.0, |x| -(x - 0.3).abs()) - 0.3).abs() < 1e-12);
        assert!((top(-1.0, 4.0, |x| x) - 4.0).abs() < 1e-11);
    }
}
