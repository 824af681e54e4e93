//! What of a layer's waves is plane stress: between the short waves of a narrow load, which are plane strain, and the long ones.

/// Share of plane stress in a wave: pure numbers, of wave number times thickness and Poisson's ratio.
pub type WaveShare = fn(f64, f64) -> f64;

/// Share S of plane stress in a wave cos(x z/l) on the edge of an elastic layer of thickness l with free faces.
///
/// The wave's displacement meets the mean pressure E k/(2 f), f = 1 - nu^2 + nu^2 S: S = 1 at long waves (plane stress), 0 at short
/// ones (plane strain). By finite elements over the layer's section (`tests/reference/layer_waves.py`), to 0.006: the short waves
/// know the corners alone, 1/x. Displacement even over the thickness, because like bodies of one length conform.
pub fn layer_share(x: f64, poisson: f64) -> f64 {
    let long = 1.0 + 0.02815 * x * x;
    long / (long + (0.0074 + 0.0093 * poisson * poisson) * x * x * x)
}

/// The same where the layer is one linear element of CalculiX (C3D8I) through half its thickness, as the decks of this
/// project have it: its thickness strain g is even, as in Kane and Mindlin's layer (*J. Appl. Mech.* 23, 1956), and its
/// incompatible modes leave z g' its mean over the element, a shear factor of 3/4. With grad^2 sigma_z = m^2 sigma_z,
/// m^2 = 32/((1 - nu) l^2), and s^2 = k^2 + m^2 its wave is f = 1/(1 + nu^2/(1 - nu^2) X), X = 2 k^2 (s - k)/(s m^2). It passes to plane
/// stress 1.46 times as deep as the body does: 0.3 % of Table 1's windup.
pub fn element_share(x: f64, poisson: f64) -> f64 {
    let m2 = 32.0 / (1.0 - poisson);
    let s = (x * x + m2).sqrt();
    // s - x = m^2/(s + x)
    let kept = 2.0 * x * x / (s * (s + x));
    // (f - (1 - nu^2))/nu^2
    (1.0 - kept) / (1.0 + poisson * poisson / (1.0 - poisson * poisson) * kept)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Finite elements over the section of a layer (tests/reference/layer_waves.py).
    #[test]
    fn shares_are_those_of_a_layers_section() {
        let table = include_str!("../../tests/reference/layer_waves.csv");
        assert_eq!(table.lines().count(), 41);
        for line in table.lines().skip(1) {
            let v: Vec<f64> = line.split(',').map(|c| c.parse().unwrap()).collect();
            let [body, deck] = [layer_share(v[1], v[0]) - v[2], element_share(v[1], v[0]) - v[3]];
            // nu^2 times 0.006 is 0.02 % of windup.
            assert!(body.abs() < 0.006 && deck.abs() < 2e-4, "{line}: {body:.4} {deck:.1e}");
        }
        for share in [layer_share, element_share] {
            assert_eq!(share(0.0, 0.3), 1.0);
            assert!((0..100).all(|i| share(0.5 * f64::from(i + 1), 0.3) < share(0.5 * f64::from(i), 0.3)));
        }
    }
}
