//! What the report says of differential-equations itself, on problems without a clutch. Where one of these fails, a newer
//! version has mended it and the help given in `src/differential.rs` can go.

use differential_equations::prelude::{ExplicitRungeKutta, IVP, ImplicitRungeKutta};
use differential_equations::solout::{CrossingDirection, Event, EventConfig};

struct Fall<F>(F);

impl<F: Fn(f64) -> f64> Event<f64, [f64; 1]> for Fall<F> {
    fn config(&self) -> EventConfig {
        EventConfig::new(CrossingDirection::Negative, Some(1))
    }

    fn event(&self, _t: f64, y: &[f64; 1]) -> f64 {
        (self.0)(y[0])
    }
}

/// Where its root finder places the zero of `g` along y = t, whose dense output is exact.
fn located(g: impl Fn(f64) -> f64) -> f64 {
    let event = Fall(g);
    let method = ExplicitRungeKutta::dop853().rtol(1e-10).atol(1e-10).h0(0.3).h_max(0.5);
    let ivp = IVP::ode_from_fn(|_t: f64, _y: &[f64; 1], d: &mut [f64; 1]| d[0] = 1.0, 0.0, 2.0, [0.0]);
    let solution = ivp.event(&event).method(method).solve().unwrap();
    *solution.t.last().unwrap()
}

#[test]
fn its_root_finder_is_right_on_straight_functions_and_wrong_on_others() {
    assert!((located(|y| 1.1 - y) - 1.1).abs() < 1e-12);
    let off = located(|y| 1.1 - y * y * y) - 1.1_f64.cbrt();
    println!("cubic: off by {off:.3}");
    assert!((0.05..0.07).contains(&off.abs()), "{off}");
}

/// Error of cos 20 by radau5, its relative tolerance given once, or once per state.
fn oscillator(tolerance: f64, per_state: bool) -> f64 {
    let rhs = |_t: f64, y: &[f64; 2], d: &mut [f64; 2]| *d = [y[1], -y[0]];
    let ivp = IVP::ode_from_fn(rhs, 0.0, 20.0, [1.0, 0.0]);
    let method = ImplicitRungeKutta::radau5().atol([tolerance; 2]);
    let method = if per_state { method.rtol([tolerance; 2]) } else { method.rtol(tolerance) };
    (ivp.method(method).solve().unwrap().y.last().unwrap()[0] - 20_f64.cos()).abs()
}

#[test]
fn its_radau5_transforms_one_tolerance_once_per_state() {
    let [once, each] = [false, true].map(|per_state| oscillator(1e-10, per_state));
    println!("radau5 at 1e-10: {once:.1e} with one relative tolerance, {each:.1e} with one per state");
    assert!(each < 0.1 * once, "{once} {each}");
}
