//! What can be said of the pressure at the ends of a contact, and of its largest value.

use super::axial::{AxialFit, ContactEnd};

/// The pressure at an end of the contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Edge {
    /// The end carries no load.
    Open,
    /// The load falls towards the end: the pressure has a value there.
    Bounded {
        /// Peak pressure of the last slice, Pa.
        pressure_pa: f64,
    },
    /// Singular at the end: a sharp end is pressed into a body that goes on. The value belongs to the slice width
    /// and grows without bound as that shrinks.
    Singular {
        /// Peak pressure of the last slice, Pa.
        value_at_slice_width_pa: f64,
        /// Width of that slice along the contact, m.
        slice_width_m: f64,
    },
    /// Both bodies end here. As quarter-spaces they are softer than half-spaces, so the true pressure is bounded
    /// and the half-space value too high; with the free-end factor it is too low in the last slices. Either way
    /// it is one of the slice width.
    Flush {
        /// Peak pressure of the last slice, Pa.
        value_at_slice_width_pa: f64,
        /// Width of that slice along the contact, m.
        slice_width_m: f64,
    },
}

/// The largest pressure and where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Peak {
    /// No load.
    None,
    /// A value that stays as slices get narrower.
    Bounded {
        /// Pressure, Pa.
        pressure_pa: f64,
        /// Place from the middle of the contact, m.
        y_m: f64,
    },
    /// At an end whose pressure has no value of its own: [`Edge::Singular`] or [`Edge::Flush`].
    AtEnd {
        /// Which end, 0 or 1.
        end: usize,
        /// What is there.
        edge: Edge,
    },
}

/// What is known of an end before the load is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum End {
    /// Sharp wherever it bears.
    Sharp,
    /// Sharp only if the load rises towards it.
    Shaped,
    Flush,
}

impl End {
    /// The two ends of a fit.
    pub(super) fn of(fit: &AxialFit) -> [Self; 2] {
        [0, 1].map(|side| match fit.ends()[side] {
            ContactEnd::Flush if fit.sharp(side) => Self::Flush,
            ContactEnd::One { .. } if fit.sharp(side) => Self::Sharp,
            _ => Self::Shaped,
        })
    }
}

/// The two ends and the largest pressure, from the slices' loads, N, peak pressures, Pa, and middles, m. At least
/// one slice.
pub(super) fn edges_and_peak(
    load_n: &[f64],
    pressure_pa: &[f64],
    y_m: &[f64],
    slice_width_m: f64,
    ends: [End; 2],
) -> ([Edge; 2], Peak) {
    let n = load_n.len();
    let edge = |end: usize| {
        let (last, next) = if end == 0 { (0, 1.min(n - 1)) } else { (n - 1, n.saturating_sub(2)) };
        let value = pressure_pa[last];
        match ends[end] {
            _ if load_n[last] == 0.0 => Edge::Open,
            End::Flush => Edge::Flush { value_at_slice_width_pa: value, slice_width_m },
            End::Shaped if load_n[last] < load_n[next] => Edge::Bounded { pressure_pa: value },
            End::Shaped | End::Sharp => Edge::Singular { value_at_slice_width_pa: value, slice_width_m },
        }
    };
    let edges = [edge(0), edge(1)];
    // The first of equals, to rounding, so that a symmetric contact names the same end at every force.
    let most = pressure_pa.iter().fold(0.0, |m: f64, p| m.max(*p));
    let largest = pressure_pa.iter().position(|p| *p >= most * (1.0 - 1e-9)).unwrap_or(0);
    let bounded = |end: usize| matches!(edges[end], Edge::Open | Edge::Bounded { .. });
    let peak = match largest {
        _ if pressure_pa[largest] == 0.0 => Peak::None,
        0 if !bounded(0) => Peak::AtEnd { end: 0, edge: edges[0] },
        last if last == n - 1 && !bounded(1) => Peak::AtEnd { end: 1, edge: edges[1] },
        slice => Peak::Bounded { pressure_pa: pressure_pa[slice], y_m: y_m[slice] },
    };
    (edges, peak)
}
