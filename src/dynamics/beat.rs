//! The torsional excitation at cheap steps from a time at which it is known.

/// amplitude sin(omega t) near a time at which it is known: by the addition theorem and Taylor's series, at a quarter of what
/// a sine costs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Beat {
    from_s: f64,
    omega: f64,
    /// Amplitude times sine and cosine at `from_s`.
    sine: f64,
    cosine: f64,
}

impl Beat {
    /// Angle from `from_s` up to which the series are good to 1e-15, rad: 0.5^14/14!.
    const REACH: f64 = 0.5;

    pub(super) fn new(omega: f64, amplitude: f64, t: f64) -> Self {
        let (sine, cosine) = (omega * t).sin_cos();
        Self { from_s: t, omega, sine: amplitude * sine, cosine: amplitude * cosine }
    }

    #[inline(always)]
    pub(super) fn at(&self, t: f64) -> f64 {
        let x = self.omega * (t - self.from_s);
        if x.abs() > Self::REACH {
            let (sine, cosine) = x.sin_cos();
            return self.sine * cosine + self.cosine * sine;
        }
        let q = x * x;
        // Both side by side: sin x/x and cos x in powers of x^2.
        let mut sum = SERIES[SERIES.len() - 1];
        for row in SERIES[..SERIES.len() - 1].iter().rev() {
            for lane in 0..2 {
                sum[lane] = sum[lane] * q + row[lane];
            }
        }
        self.sine * sum[1] + self.cosine * (sum[0] * x)
    }
}

/// Coefficients of x^2k of sin x/x and cos x.
const SERIES: [[f64; 2]; 7] = [
    [1.0, 1.0],
    [-1.0 / 6.0, -1.0 / 2.0],
    [1.0 / 120.0, 1.0 / 24.0],
    [-1.0 / 5_040.0, -1.0 / 720.0],
    [1.0 / 362_880.0, 1.0 / 40_320.0],
    [-1.0 / 39_916_800.0, -1.0 / 3_628_800.0],
    [1.0 / 6_227_020_800.0, 1.0 / 479_001_600.0],
];
