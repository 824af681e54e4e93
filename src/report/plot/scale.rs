//! Extents, axis ranges, ticks, and how many points are worth drawing.

use crate::report::number::{plain, significant};

/// `run` with no more points than the eye can tell apart: of each half pixel of index the first, the
/// lowest, the highest and the last stay, so no peak is lost.
pub(super) fn thinned(run: &[[f64; 2]], width_px: f64) -> Vec<(f64, f64)> {
    let columns = (2.0 * width_px).max(1.0) as usize;
    let pair = |p: &[f64; 2]| (p[0], p[1]);
    if run.len() <= 4 * columns {
        return run.iter().map(pair).collect();
    }
    let mut kept = Vec::with_capacity(4 * columns);
    for chunk in run.chunks(run.len().div_ceil(columns)) {
        let by_y = |a: &usize, b: &usize| chunk[*a][1].total_cmp(&chunk[*b][1]);
        let lowest = (0..chunk.len()).min_by(by_y).unwrap_or(0);
        let highest = (0..chunk.len()).max_by(by_y).unwrap_or(0);
        let mut stay = vec![0, lowest, highest, chunk.len() - 1];
        stay.sort_unstable();
        stay.dedup();
        kept.extend(stay.into_iter().map(|i| pair(&chunk[i])));
    }
    kept
}

/// A tick's text: as many decimals as the spacing of the axis needs.
pub(super) fn tick(value: f64, span: f64, largest: f64) -> String {
    if !(largest > 0.0 && span > 0.0) {
        return significant(value, 3);
    }
    if !(1e-3..1e6).contains(&largest) {
        return if value.abs() < 1e-9 * largest { "0".to_owned() } else { short_scientific(value) };
    }
    // Some five to ten ticks per axis, steps of 1, 2, 2.5 or 5: two digits below the span's power of ten.
    let decimals = (1.0 - span.log10().floor()).max(0.0) as usize;
    let text = format!("{:.*}", (decimals + 1).min(9), value);
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    let text = if text == "-0" { "0" } else { text };
    text.replace('-', "\u{2212}")
}

/// Whether an axis spans one decade at most: there is room for more than powers of ten.
pub(super) fn one_decade((low, high): (f64, f64)) -> bool {
    high <= 10.001 * low
}

/// Text of the ticks of a logarithmic axis: powers of ten, what lies between only if `all` are to be written; the
/// values of the axis are raised by `lift`.
pub(super) fn log_tick(all: bool, lift: f64) -> impl Fn(f64) -> String + Send + Sync + 'static {
    move |raised: f64| {
        let value = raised / lift;
        let power = value.log10();
        if !all && (power - power.round()).abs() > 1e-6 {
            String::new()
        } else if (1e-3..9e3).contains(&value) {
            plain(value, 3)
        } else {
            short_scientific(value)
        }
    }
}

fn short_scientific(value: f64) -> String {
    let text = format!("{value:.2e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    format!("{}e{exponent}", mantissa.trim_end_matches('0').trim_end_matches('.'))
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
    pub(super) fn ranges(&self, log_x: bool, log_y: bool) -> ((f64, f64), (f64, f64)) {
        (widened(self.x, log_x, 0.0), widened(self.y, log_y, 0.05))
    }
}

pub(super) fn widened(range: (f64, f64), log: bool, air: f64) -> (f64, f64) {
    let (low, high) = range;
    if low > high {
        return if log { (1.0, 10.0) } else { (0.0, 1.0) };
    }
    if log {
        let (low, high) = (low.log10(), high.log10());
        let low = low.floor();
        let high = if high.ceil() > low { high.ceil() } else { low + 1.0 };
        return (10f64.powf(low), 10f64.powf(high));
    }
    let span = high - low;
    if span <= 1e-12 * low.abs().max(high.abs()) || span < 1e-14 {
        // kuva takes a span below 2e-16 for none, whatever the unit.
        let half = if low == 0.0 { 1.0 } else { 0.1 * low.abs().max(1e-12) };
        return (low - half, high + half);
    }
    // A curve that begins at zero sits on the axis.
    let bottom = if low == 0.0 { 0.0 } else { low - air * span };
    let top = if high == 0.0 { 0.0 } else { high + air * span };
    (bottom, top)
}
