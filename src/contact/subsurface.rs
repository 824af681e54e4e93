//! Shear below a line contact without friction.

/// sqrt(5)/2 - 1/2: u = z/sqrt(a^2 + z^2) where the shear on the axis is largest. Its slope,
/// 1 - 2u + u^3 = (u - 1)(u^2 + u - 1), is zero there; z/a = sqrt(u) = 0.786.
const DEEPEST: f64 = 0.618_033_988_749_894_8;

/// Largest shear of a line contact on its axis, Pa, at `depth_m` below the surface: tau_1 = (p_0/a)(z - z^2/
/// sqrt(a^2 + z^2)) (Johnson, *Contact Mechanics*, (4.46)), half the difference of the principal stresses in the
/// plane across the contact. `peak_pressure_pa` = p_0, `half_width_m` = a; 0 where one of the three is not positive.
pub fn shear_at_depth_pa(peak_pressure_pa: f64, half_width_m: f64, depth_m: f64) -> f64 {
    if !(peak_pressure_pa > 0.0 && half_width_m > 0.0 && depth_m > 0.0) {
        return 0.0;
    }
    // The difference of the formula, without cancellation far below: u/(s + z/a), s = sqrt(1 + (z/a)^2).
    let depth = depth_m / half_width_m;
    let s = depth.hypot(1.0);
    peak_pressure_pa * (depth / s) / (s + depth)
}

/// Depth of the largest shear, m: 0.786 a (Johnson, 4.2). `half_width_m` = a.
pub fn depth_of_largest_shear_m(half_width_m: f64) -> f64 {
    half_width_m * DEEPEST.sqrt()
}

/// Largest shear at or below `from_m`, Pa, and its depth, m: 0.300 p_0 at 0.786 a where that lies below.
pub fn largest_shear_below(peak_pressure_pa: f64, half_width_m: f64, from_m: f64) -> (f64, f64) {
    let depth = depth_of_largest_shear_m(half_width_m).max(from_m);
    (shear_at_depth_pa(peak_pressure_pa, half_width_m, depth), depth)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_half_the_difference_of_the_stresses_on_the_axis() {
        // sigma_x and sigma_z by the integrals of the line load over the semi-ellipse (Flamant), midpoint rule.
        let (p0, a) = (1.7e9, 0.1e-3);
        for depth in [0.3, 0.786, 2.0, 7.0] {
            let z = depth * a;
            let (mut x_stress, mut z_stress) = (0.0, 0.0);
            let cells = 200_000;
            for i in 0..cells {
                // s = a sin t takes the root away from the ends.
                let t = std::f64::consts::PI * ((i as f64 + 0.5) / cells as f64 - 0.5);
                let (s, load) =
                    (a * t.sin(), p0 * t.cos() * a * t.cos() * std::f64::consts::PI / cells as f64);
                let r4 = (s * s + z * z).powi(2);
                x_stress -= 2.0 / std::f64::consts::PI * load * z * s * s / r4;
                z_stress -= 2.0 / std::f64::consts::PI * load * z.powi(3) / r4;
            }
            let want = 0.5 * (x_stress - z_stress);
            let got = shear_at_depth_pa(p0, a, z);
            assert!((got / want - 1.0).abs() < 1e-9, "{depth}: {got} against {want}");
        }
    }

    #[test]
    fn the_largest_is_where_johnson_prints_it_and_falls_on_both_sides() {
        let (p0, a) = (1.0, 1.0);
        let (largest, depth) = largest_shear_below(p0, a, 0.0);
        assert!((largest - 0.30).abs() < 5e-4 && (depth - 0.786).abs() < 5e-4, "{largest} at {depth}");
        for other in [0.99 * depth, 1.01 * depth] {
            assert!(shear_at_depth_pa(p0, a, other) < largest);
        }
        assert_eq!(largest_shear_below(p0, a, 2.0), (shear_at_depth_pa(p0, a, 2.0), 2.0));
        assert_eq!(shear_at_depth_pa(0.0, 0.0, 1.0), 0.0);
    }
}
