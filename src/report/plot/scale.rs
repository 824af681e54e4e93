//! Extents, axis ranges, texts of ticks, and how many points are worth drawing.

use crate::report::number::plain;

/// `run` with no more points than the eye can tell apart: of each half pixel of index the first, the
/// lowest, the highest and the last stay, so no peak is lost.
pub(super) fn thinned(run: &[[f64; 2]], width_px: f64) -> Vec<[f64; 2]> {
    let columns = (2.0 * width_px).max(1.0) as usize;
    if run.len() <= 4 * columns {
        return run.to_vec();
    }
    let mut kept = Vec::with_capacity(4 * columns);
    for chunk in run.chunks(run.len().div_ceil(columns)) {
        let by_y = |a: &usize, b: &usize| chunk[*a][1].total_cmp(&chunk[*b][1]);
        let lowest = (0..chunk.len()).min_by(by_y).unwrap_or(0);
        let highest = (0..chunk.len()).max_by(by_y).unwrap_or(0);
        let mut stay = vec![0, lowest, highest, chunk.len() - 1];
        stay.sort_unstable();
        stay.dedup();
        kept.extend(stay.into_iter().map(|i| chunk[i]));
    }
    kept
}

/// A tick's text: as many decimals as the step between ticks needs, one way of writing for all ticks of an axis whose
/// largest value is `largest`.
pub(super) fn tick(value: f64, step: f64, largest: f64) -> String {
    if value.abs() < 1e-9 * step {
        return "0".to_owned();
    }
    let place = |x: f64| x.abs().log10().floor();
    let text = if (1e-3..1e6).contains(&largest) {
        let decimals = (-place(step * 1.000001)).clamp(0.0, 12.0) as usize;
        format!("{value:.decimals$}")
    } else {
        let digits = (place(value) - place(step * 1.000001)).clamp(0.0, 12.0) as usize;
        format!("{value:.digits$e}")
    };
    text.strip_prefix('-').map_or(text.clone(), |size| format!("\u{2212}{size}"))
}

/// `digit` times ten to the `power` as a tick of a logarithmic axis.
pub(super) fn power_text(digit: u32, power: i32) -> String {
    if (-3..=3).contains(&power) {
        plain(f64::from(digit) * 10f64.powi(power), 3)
    } else {
        format!("{digit}e{power}")
    }
}

/// 1, 2 or 5 times a power of ten, the nearest above `wanted`.
pub(super) fn round_step(wanted: f64) -> f64 {
    if !(wanted.is_finite() && wanted > 0.0) {
        return 1.0;
    }
    let power = 10f64.powf(wanted.log10().floor());
    [1.0, 2.0, 5.0, 10.0].into_iter().map(|f| f * power).find(|&s| s >= wanted * 0.999).unwrap_or(power)
}

/// Smallest box around everything drawn.
pub(super) struct Extent {
    pub(super) x: (f64, f64),
    pub(super) y: (f64, f64),
}

impl Default for Extent {
    fn default() -> Self {
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        Self { x: none, y: none }
    }
}

impl Extent {
    pub(super) fn add(&mut self, [x, y]: [f64; 2]) {
        self.x = (self.x.0.min(x), self.x.1.max(x));
        self.y = (self.y.0.min(y), self.y.1.max(y));
    }

    pub(super) fn is_empty(&self) -> bool {
        self.x.0 > self.x.1
    }

    /// Axis ranges: x exactly as far as the data, y with a little air; never of zero width.
    pub(super) fn ranges(&self, log_x: bool, log_y: bool) -> [[f64; 2]; 2] {
        [widened(self.x, log_x, 0.0), widened(self.y, log_y, 0.05)]
    }
}

/// Share of the range that may be left empty to begin at zero.
const NEAR_ZERO: f64 = 0.05;

/// Range of an axis around what is drawn, with `air` of its span at both ends; whole powers of ten on a logarithmic one.
pub(super) fn widened((low, high): (f64, f64), log: bool, air: f64) -> [f64; 2] {
    if low > high {
        return [0.0, 1.0];
    }
    if log {
        let low = low.log10().floor();
        return [low, high.log10().ceil().max(low + 1.0)];
    }
    let span = high - low;
    if span <= 1e-12 * low.abs().max(high.abs()) {
        return if low == 0.0 { [0.0, 1.0] } else { [low - 0.1 * low.abs(), high + 0.1 * high.abs()] };
    }
    // A range that begins close to zero, or below it by roundings, begins there.
    let low = if low > -1e-9 * high && low < NEAR_ZERO * high { 0.0 } else { low };
    // A curve that begins at zero sits on the axis.
    let bottom = if low == 0.0 { 0.0 } else { low - air * span };
    let top = if high == 0.0 { 0.0 } else { high + air * span };
    [bottom, top]
}
