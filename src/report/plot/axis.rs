//! One axis of a figure: its range, where that lies in px, its ticks.

use super::scale::{power_text, round_step, tick};
use crate::report::svg::{Anchor, INK, SOFT, Svg, text_width};

/// Most decades an `f64` spans, with room.
const DECADES: f64 = 650.0;
/// Room in px for a decade before its inner ticks are drawn.
const DECADE_PX: f64 = 30.0;

/// Range of an axis and the px between which it runs.
#[derive(Debug, Clone, Copy)]
pub(in crate::report) struct Axis {
    /// Logarithmic: the range counts powers of ten.
    pub(in crate::report) log: bool,
    /// Begin and end, as values or as powers of ten.
    pub(in crate::report) range: [f64; 2],
    /// Begin and end in px.
    pub(in crate::report) px: [f64; 2],
}

/// A tick; one without a text is short and has no grid line.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::report) struct Tick {
    /// Place in px.
    pub(in crate::report) px: f64,
    pub(in crate::report) text: String,
}

impl Axis {
    /// Place of `value` in px.
    pub(in crate::report) fn at(&self, value: f64) -> f64 {
        let along = if self.log { value.log10() } else { value };
        let ([low, high], [from, to]) = (self.range, self.px);
        from + (to - from) * (along - low) / (high - low)
    }

    /// Ticks whose texts are `pitch_px` apart or more; the first tick of a logarithmic axis is its begin.
    pub(in crate::report) fn ticks(&self, pitch_px: f64) -> Vec<Tick> {
        if self.log { self.log_ticks(pitch_px) } else { self.linear_ticks(pitch_px) }
    }

    /// The same with its begin moved down to a tick, so that the first one is numbered.
    pub(in crate::report) fn begun(mut self, pitch_px: f64) -> Self {
        // A wider range may have wider steps: the second pass ends on one of them.
        for _ in 0..if self.log { 0 } else { 2 } {
            let step = self.step(pitch_px);
            self.range[0] = (self.range[0] / step + 1e-9).floor() * step;
        }
        self
    }

    /// Step between linear ticks.
    fn step(&self, pitch_px: f64) -> f64 {
        let room = (self.length_px() / pitch_px).floor().max(1.0);
        round_step((self.range[1] - self.range[0]) / room)
    }

    fn length_px(&self) -> f64 {
        (self.px[1] - self.px[0]).abs()
    }

    fn linear_ticks(&self, pitch_px: f64) -> Vec<Tick> {
        let [low, high] = self.range;
        let room = (self.length_px() / pitch_px).floor().max(1.0);
        let step = self.step(pitch_px);
        let first = (low / step - 1e-9).ceil();
        let values = (0..=room as usize + 1).map(|i| (first + i as f64) * step);
        values
            .take_while(|&v| v <= high + 1e-9 * step)
            .map(|v| Tick { px: self.at(v), text: tick(v, step, low.abs().max(high.abs())) })
            .collect()
    }

    /// 1, 2 and 5 of each decade are written where there is room, else the powers of ten, else every other one, ...
    fn log_ticks(&self, pitch_px: f64) -> Vec<Tick> {
        let [low, high] = self.range;
        let decades = (high - low).clamp(1.0, DECADES);
        let decade_px = self.length_px() / decades;
        let stride = (pitch_px / decade_px).ceil().max(1.0) as usize;
        let written: &[u32] = if decade_px * 2f64.log10() >= pitch_px { &[1, 2, 5] } else { &[1] };
        let inner = if stride == 1 && decade_px >= DECADE_PX { 9 } else { 1 };
        let mut ticks = Vec::new();
        for k in (0..=decades as usize).step_by(stride) {
            let power = low + k as f64;
            for digit in 1..=inner {
                let along = power + f64::from(digit).log10();
                if along > high + 1e-9 {
                    break;
                }
                let text =
                    if written.contains(&digit) { power_text(digit, power as i32) } else { String::new() };
                let share = (along - low) / (high - low);
                ticks.push(Tick { px: self.px[0] + (self.px[1] - self.px[0]) * share, text });
            }
        }
        ticks
    }
}

/// Ticks, texts and title below a line at `y_px`, within a figure `width_px` wide.
pub(in crate::report) fn draw_below(
    svg: &mut Svg,
    axis: &Axis,
    ticks: &[Tick],
    y_px: f64,
    title: &str,
    width_px: f64,
) {
    let style = format!("stroke=\"{SOFT}\" fill=\"none\"");
    for Tick { px, text } in ticks {
        let length = if text.is_empty() { 3.0 } else { 5.0 };
        svg.line([*px, y_px], [*px, y_px + length], &style);
        svg.bare_text([within(*px, text, width_px), y_px + 18.0], Anchor::Middle, SOFT, text);
    }
    let middle = 0.5 * (axis.px[0] + axis.px[1]);
    svg.bare_text([middle, y_px + 38.0], Anchor::Middle, INK, title);
}

/// Ticks, texts and title left of a line at `x_px`, within a figure `height_px` high.
pub(in crate::report) fn draw_left(
    svg: &mut Svg,
    axis: &Axis,
    ticks: &[Tick],
    x_px: f64,
    title: &str,
    height_px: f64,
) {
    let style = format!("fill=\"none\" stroke=\"{SOFT}\"");
    for Tick { px, text } in ticks {
        let length = if text.is_empty() { 3.0 } else { 5.0 };
        svg.line([x_px - length, *px], [x_px, *px], &style);
        svg.bare_text([x_px - 8.0, px + 4.0], Anchor::End, SOFT, text);
    }
    // A title longer than the frame is tall leans into the figure.
    let half = text_width(title, super::TEXT_PX) / 2.0;
    let middle = 0.5 * (axis.px[0] + axis.px[1]);
    svg.rising_text([14.0, middle.max(half + 2.0).min((height_px - half - 2.0).max(0.0))], INK, title);
}

/// Left margin that numbers and title of an upright axis need, px.
pub(in crate::report) fn left_px(ticks: &[Tick]) -> f64 {
    let widest = ticks.iter().map(|tick| text_width(&tick.text, super::TEXT_PX)).fold(0.0, f64::max);
    // Title, its distance, numbers, their distance from the line.
    super::LEFT_PX.max(18.0 + 4.0 + widest + 8.0)
}

/// Middle of a text that belongs at `px` of a figure `width_px` wide: near an edge it leans inwards.
pub(super) fn within(px: f64, text: &str, width_px: f64) -> f64 {
    let half = text_width(text, super::TEXT_PX) / 2.0;
    px.min(width_px - half - 2.0).max(half + 2.0)
}
