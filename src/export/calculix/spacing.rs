//! Graded spacings of a structured mesh.

/// Steps of a geometric row: `count` steps that begin with `first` and add up to `length` (all positive).
pub(super) fn growing(length: f64, first: f64, count: usize) -> Vec<f64> {
    let sum = |ratio: f64| (0..count).map(|i| first * ratio.powi(i as i32)).sum::<f64>();
    // The sum rises with the ratio; sixty halvings of [0.1, 10] leave nothing to see.
    let (mut low, mut high) = (0.1_f64, 10.0_f64);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if sum(middle) < length { low = middle } else { high = middle }
    }
    let ratio = 0.5 * (low + high);
    let scale = length / sum(ratio);
    (0..count).map(|i| scale * first * ratio.powi(i as i32)).collect()
}

/// Number of steps that grow from `first` by `ratio` > 1 and cover `length`.
pub(super) fn steps_to_cover(length: f64, first: f64, ratio: f64) -> usize {
    ((1.0 + length * (ratio - 1.0) / first).ln() / ratio.ln()).ceil().max(1.0) as usize
}

/// Positions from `from` over a fine stretch [fine.0, fine.1] of `fine_count` equal steps to `until`; the
/// rows outside have `before` and `after` steps that start with the fine step.
pub(super) fn positions(
    from: f64,
    fine: (f64, f64),
    until: f64,
    fine_count: usize,
    before: usize,
    after: usize,
) -> Vec<f64> {
    let step = (fine.1 - fine.0) / fine_count as f64;
    let mut out = vec![from];
    let mut at = from;
    for width in growing(fine.0 - from, step, before).into_iter().rev() {
        at += width;
        out.push(at);
    }
    out.extend((1..=fine_count).map(|i| fine.0 + step * i as f64));
    at = fine.1;
    for width in growing(until - fine.1, step, after) {
        at += width;
        out.push(at);
    }
    out
}

/// Depths below a loaded surface: `even` steps of `first`, then growing by `ratio`, down to `depth`.
pub(super) fn depths(depth: f64, first: f64, even: usize, ratio: f64) -> Vec<f64> {
    let even = even.min((0.3 * depth / first) as usize).max(1);
    let rest = depth - even as f64 * first;
    let mut out: Vec<f64> = (0..=even).map(|i| i as f64 * first).collect();
    let mut at = even as f64 * first;
    for width in growing(rest, first * ratio, steps_to_cover(rest, first * ratio, ratio)) {
        at += width;
        out.push(at);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_end_where_they_should_and_never_step_back() {
        let row = positions(-2.5, (-0.4, 0.9), 2.5, 52, 14, 12);
        assert_eq!(row.len(), 1 + 52 + 14 + 12);
        assert!((row[0] + 2.5).abs() < 1e-12 && (row[row.len() - 1] - 2.5).abs() < 1e-9);
        assert!(row.windows(2).all(|w| w[1] > w[0]));
        let down = depths(3.9, 0.025, 6, 1.2);
        assert!((down[down.len() - 1] - 3.9).abs() < 1e-9 && (down[1] - 0.025).abs() < 1e-15);
        let growth = down.windows(3).map(|w| (w[2] - w[1]) / (w[1] - w[0])).fold(0.0, f64::max);
        assert!(growth < 1.25, "{growth}");
    }

    #[test]
    fn a_growing_row_adds_up_and_begins_as_asked() {
        for (length, count) in [(1.0, 30), (0.2, 10), (0.05, 10)] {
            let row = growing(length, 0.01, count);
            assert!((row.iter().sum::<f64>() - length).abs() < 1e-12 && (row[0] - 0.01).abs() < 1e-9);
        }
    }
}
