//! Bracketed root of a continuous function.

/// Root of `f` in [a, b] where f(a) and f(b) differ in sign (either may be zero), by inverse quadratic interpolation
/// where that is safe and bisection elsewhere (Chandrupatla 1997), begun with a secant. `tolerance` is the width in x at
/// which it stops; earlier, where f is next to nothing of what it is at either end and the secant through the last two
/// points says that the root is nearer than a twentieth of that. `None` where the ends do not bracket a root or a value is
/// not finite.
pub fn bracketed(a: f64, b: f64, fa: f64, fb: f64, tolerance: f64, f: impl FnMut(f64) -> f64) -> Option<f64> {
    bracketed_near(a, b, fa, fb, f64::NAN, tolerance, f)
}

/// The same, begun at `guess` where that lies inside.
pub fn bracketed_near(
    a: f64,
    b: f64,
    fa: f64,
    fb: f64,
    guess: f64,
    tolerance: f64,
    mut f: impl FnMut(f64) -> f64,
) -> Option<f64> {
    if fa == 0.0 {
        return Some(a);
    }
    if fb == 0.0 {
        return Some(b);
    }
    if !(fa.is_finite() && fb.is_finite()) || fa.signum() == fb.signum() {
        return None;
    }
    // The root lies between x1, the newest point, and x2; x3 is the one that was given up last.
    let (mut x1, mut f1, mut x2, mut f2) = (b, fb, a, fa);
    let guessed = (b - guess) / (b - a);
    let mut part = if guessed > 0.0 && guessed < 1.0 { guessed } else { fb / (fb - fa) };
    // A jump has no such value on either side.
    let next_to_nothing = 1e-6 * fa.abs().min(fb.abs());
    for _ in 0..MOST {
        let x = x1 + part * (x2 - x1);
        let fx = f(x);
        if !fx.is_finite() {
            return None;
        }
        if fx.abs() < next_to_nothing && (fx * (x - x1)).abs() < 0.05 * tolerance * (fx - f1).abs() {
            return Some(x);
        }
        let (x3, f3);
        if fx.signum() == f1.signum() {
            (x3, f3) = (x1, f1);
        } else {
            (x3, f3) = (x2, f2);
            (x2, f2) = (x1, f1);
        }
        (x1, f1) = (x, fx);
        let width = (x2 - x1).abs();
        let nearest = (0.5 * tolerance).max(f64::EPSILON * (x1.abs() + x2.abs())) / width;
        if fx == 0.0 || nearest > 0.5 {
            break;
        }
        let (xi, phi) = ((x1 - x2) / (x3 - x2), (f1 - f2) / (f3 - f2));
        part = if phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi {
            f1 / (f2 - f1) * f3 / (f2 - f3) + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2)
        } else {
            0.5
        };
        part = part.clamp(nearest, 1.0 - nearest);
    }
    Some(if f1.abs() < f2.abs() { x1 } else { x2 })
}

/// More halvings than there are numbers between any two.
const MOST: usize = 4200;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_planted_roots_and_refuses_a_bad_bracket() {
        let mut calls = 0;
        let f = |x: f64| (x - 0.3).powi(3) + 1e-3 * (x - 0.3);
        let x = bracketed(-1.0, 2.0, f(-1.0), f(2.0), 1e-14, |x| {
            calls += 1;
            f(x)
        })
        .unwrap();
        assert!((x - 0.3).abs() < 1e-13 && calls < 60, "{x} after {calls}");
        // Smooth: superlinear. Rough: bisection now and then, so no worse than a few times that alone.
        let count = |f: fn(f64) -> f64, root: f64, most: usize| {
            let mut calls = 0;
            let x = bracketed(0.0, 1.0, f(0.0), f(1.0), 1e-13, |x| {
                calls += 1;
                f(x)
            })
            .unwrap();
            assert!((x - root).abs() < 1e-13 && calls <= most, "{x} after {calls}");
        };
        count(|x| (2.0 * x).cos() - 0.3, 0.5 * 0.3f64.acos(), 8);
        count(|x| 0.5 * (2.0 * x).exp() - 1.0, 0.5 * 2f64.ln(), 8);
        count(|x| (x - 0.3).abs().powf(0.1).copysign(x - 0.3), 0.3, 120);
        count(|x| if x < 0.7 { -1.0 } else { 1e6 }, 0.7, 120);
        assert!(bracketed(0.5, 2.0, f(0.5), f(2.0), 1e-14, f).is_none());
        assert!(bracketed(0.0, 1.0, -1.0, f64::NAN, 1e-14, f).is_none());
    }
}
