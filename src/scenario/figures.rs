//! The figures of a simulation that have an error, each described once: errors, the tolerance they are compared with,
//! JSON and the lines for people are loops over [`FIGURES`].

use super::answer::Simulation;

/// What a figure measures: by what its error is divided before it is compared with the tolerance ([`super::Scales`]), and
/// the units that it is shown in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Angle, rad: by 1 rad.
    Angle,
    /// Length, m: by the radius of the inner race.
    Length,
    /// Time, s: by the duration.
    Time,
    /// Force, N: by the largest of the run.
    Force,
    /// Pressure, Pa: by the largest of the run.
    Pressure,
    /// |T|/N: by 1.
    Friction,
    /// Margin: by 1.
    Margin,
    /// Margin of a force over the static one: by the largest force over the static one.
    ContactMargin,
    /// Work of slip, J: by nothing, as what follows. They are seen beside the motion and have no say in how finely that is run.
    Work,
    /// Power of slip, W.
    Power,
    /// Heat over an area, W/m^2.
    Flux,
    /// Rise of a temperature, K.
    Rise,
    /// Depth of wear, m.
    Depth,
}

/// Where a figure stands among the lines for people.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Line {
    /// Lines that stand together.
    pub group: Group,
    /// Place within its group.
    pub place: u8,
    /// Its name there.
    pub label: &'static str,
}

/// Lines for people that stand together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Group {
    /// Where the races end, and how the contacts slip.
    Motion,
    /// Slip after a reversal.
    Reversal,
    /// Work, heat and wear of slip.
    Slip,
    /// Time without contact.
    Lost,
    /// Extremes, with their times.
    Peaks,
    /// Pressures.
    Pressures,
    /// What rolling would need.
    Demand,
}

/// One figure of a simulation.
#[derive(Debug, Clone, Copy)]
pub struct Figure {
    /// Key of its error in JSON, which ends in the unit; the figures of the inner and the outer contact may share one, side by
    /// side.
    pub key: &'static str,
    /// What it is, for messages.
    pub words: &'static str,
    /// What it measures.
    pub quantity: Quantity,
    /// Its line for people, where it has one.
    pub line: Option<Line>,
    /// The figure, SI; `None` where the simulation has none.
    pub of: fn(&Simulation) -> Option<f64>,
    /// Its error, SI.
    pub error: fn(&ErrorEstimate) -> f64,
    /// Where its error is kept.
    pub(super) error_mut: fn(&mut ErrorEstimate) -> &mut f64,
    /// Of an extreme: where its time stands in [`crate::dynamics::Peaks::at_s`].
    pub peak: Option<usize>,
    /// Of a pressure: the normal force at A that causes it, N.
    pub normal_n: Option<fn(&Simulation) -> f64>,
}

const fn line(group: Group, place: u8, label: &'static str) -> Option<Line> {
    Some(Line { group, place, label })
}

/// One row a figure: field of its error, key in JSON, quantity, words, line for people, how to take it, and what only some have.
macro_rules! figures {
    ($($(#[$doc:meta])+ $field:ident, $key:literal, $quantity:ident, $words:literal, $line:expr, $of:expr
        $(, peak: $peak:literal)? $(, normal_n: $normal_n:expr)?;)+) => {
        /// Differences between two runs of a simulation.
        #[derive(Debug, Clone, Copy, Default, PartialEq)]
        pub struct ErrorEstimate {
            $($(#[$doc])+ pub $field: f64,)+
            /// By how much the times of the extremes moved between the runs, s, in the order of
            /// [`crate::dynamics::Peaks::at_s`]. That is no bound, and compared with no tolerance: an extreme is flat, and of
            /// several that are equal within their error any may be named.
            pub extremes_at_s: [f64; 5],
        }

        /// Every figure that has an error, in the order of JSON.
        pub static FIGURES: &[Figure] = &[$(Figure {
            key: $key,
            words: $words,
            quantity: Quantity::$quantity,
            line: $line,
            of: $of,
            error: |e| e.$field,
            error_mut: |e| &mut e.$field,
            peak: [$(Some($peak),)? None][0],
            normal_n: [$(Some($normal_n as fn(&Simulation) -> f64),)? None][0],
        }),+];
    };
}

figures! {
    /// theta_bi at the end, rad.
    theta_inner_rad, "theta_inner_rad", Angle, "angle of the inner race at the end",
        line(Group::Motion, 0, "inner race at the end"), |s| Some(s.theta_inner_rad);
    /// theta_be at the end, rad.
    theta_outer_rad, "theta_outer_rad", Angle, "angle of the outer race at the end",
        line(Group::Motion, 1, "outer race at the end"), |s| Some(s.theta_outer_rad);
    /// Offset, rad.
    offset_rad, "offset_rad", Angle, "offset", line(Group::Motion, 2, "offset (+ overrunning)"), |s| Some(s.offset_rad);
    /// Net slip at A, m.
    net_slip_m, "net_slip_mm", Length, "net slip at the inner contact",
        line(Group::Motion, 3, "net slip, inner contact"), |s| Some(s.inner.net_m);
    /// Net slip at B, m.
    net_slip_outer_m, "net_slip_outer_mm", Length, "net slip at the outer contact", None, |s| Some(s.outer.net_m);
    /// Path of slip at A, m.
    slip_distance_inner_m, "slip_distance_mm", Length, "slip path at the inner contact",
        line(Group::Motion, 4, "slip path, inner contact"), |s| Some(s.inner.distance_m);
    /// Path of slip at B, m.
    slip_distance_outer_m, "slip_distance_mm", Length, "slip path at the outer contact",
        line(Group::Motion, 6, "slip path, outer contact"), |s| Some(s.outer.distance_m);
    /// Time of slip at A, s.
    slip_time_inner_s, "slip_time_s", Time, "slip time at the inner contact",
        line(Group::Motion, 5, "slip time, inner contact"), |s| Some(s.inner.time_s);
    /// Time of slip at B, s.
    slip_time_outer_s, "slip_time_s", Time, "slip time at the outer contact",
        line(Group::Motion, 7, "slip time, outer contact"), |s| Some(s.outer.time_s);
    /// Friction work of a sprag at A, J.
    slip_work_inner_j, "slip_work_j", Work, "friction work of a sprag at the inner contact",
        line(Group::Slip, 0, "friction work of a sprag, inner contact"), |s| Some(s.slipped(0)?.work_j);
    /// Friction work of a sprag at B, J.
    slip_work_outer_j, "slip_work_j", Work, "friction work of a sprag at the outer contact",
        line(Group::Slip, 20, "friction work of a sprag, outer contact"), |s| Some(s.slipped(1)?.work_j);
    /// The same in the slip with the most at A, J.
    worst_slip_work_inner_j, "worst_slip_work_j", Work, "friction work of a sprag in the worst slip at the inner contact",
        line(Group::Slip, 1, "the same in the worst slip, inner contact"), |s| Some(s.slip_heat[0]?.worst.work_j);
    /// The same in the slip with the most at B, J.
    worst_slip_work_outer_j, "worst_slip_work_j", Work, "friction work of a sprag in the worst slip at the outer contact",
        line(Group::Slip, 21, "the same in the worst slip, outer contact"), |s| Some(s.slip_heat[1]?.worst.work_j);
    /// Largest friction power of a sprag at A, W.
    slip_power_inner_w, "slip_power_w", Power, "largest friction power of a sprag at the inner contact",
        line(Group::Slip, 2, "largest friction power of a sprag, inner contact"), |s| Some(s.slipped(0)?.power_w);
    /// Largest friction power of a sprag at B, W.
    slip_power_outer_w, "slip_power_w", Power, "largest friction power of a sprag at the outer contact",
        line(Group::Slip, 22, "largest friction power of a sprag, outer contact"), |s| Some(s.slipped(1)?.power_w);
    /// Largest heat over the flat at A, W/m^2.
    slip_flux_inner_w_m2, "slip_flux_w_per_mm2", Flux, "largest heat over the flat at the inner contact",
        line(Group::Slip, 3, "largest heat over the flat, inner contact"), |s| Some(s.slipped(0)?.flux_w_m2);
    /// Largest heat over the flat at B, W/m^2.
    slip_flux_outer_w_m2, "slip_flux_w_per_mm2", Flux, "largest heat over the flat at the outer contact",
        line(Group::Slip, 23, "largest heat over the flat, outer contact"), |s| Some(s.slipped(1)?.flux_w_m2);
    /// Flash of slip at A, K.
    flash_inner_k, "flash_k", Rise, "flash of slip at the inner contact",
        line(Group::Slip, 4, "flash of slip above the bodies, inner contact"), |s| Some(s.slipped(0)?.flash_k);
    /// Flash of slip at B, K.
    flash_outer_k, "flash_k", Rise, "flash of slip at the outer contact",
        line(Group::Slip, 24, "flash of slip above the bodies, outer contact"), |s| Some(s.slipped(1)?.flash_k);
    /// Depth that slip wears off a sprag at A, m.
    sprag_wear_inner_m, "sprag_wear_um", Depth, "wear of a sprag at the inner contact",
        line(Group::Slip, 5, "wear of a sprag, inner contact"), |s| Some(s.wear_m(0)?[0]);
    /// Depth that slip wears off a sprag at B, m.
    sprag_wear_outer_m, "sprag_wear_um", Depth, "wear of a sprag at the outer contact",
        line(Group::Slip, 25, "wear of a sprag, outer contact"), |s| Some(s.wear_m(1)?[0]);
    /// Depth that slip wears off the race at A, m.
    race_wear_inner_m, "race_wear_um", Depth, "wear of the race at the inner contact",
        line(Group::Slip, 6, "wear of the race, inner contact"), |s| Some(s.wear_m(0)?[1]);
    /// Depth that slip wears off the race at B, m.
    race_wear_outer_m, "race_wear_um", Depth, "wear of the race at the outer contact",
        line(Group::Slip, 26, "wear of the race, outer contact"), |s| Some(s.wear_m(1)?[1]);
    /// Time without contact, s.
    contact_lost_s, "contact_lost_s", Time, "time without contact",
        line(Group::Lost, 0, "time without contact"), |s| Some(s.contact_lost_s);
    /// Largest |T|/N at A.
    tan_inner, "tan_inner", Friction, "largest |T|/N at the inner contact",
        line(Group::Peaks, 2, "largest |T|/N, inner"), |s| Some(s.peaks.tan_inner), peak: 0;
    /// Largest |T|/N at B.
    tan_outer, "tan_outer", Friction, "largest |T|/N at the outer contact",
        line(Group::Peaks, 3, "largest |T|/N, outer"), |s| Some(s.peaks.tan_outer), peak: 1;
    /// Smallest N_bi, N.
    normal_min_n, "normal_min_n", Force, "smallest normal force",
        line(Group::Peaks, 0, "smallest normal force, inner"), |s| Some(s.peaks.normal_min_n), peak: 2;
    /// Largest N_bi, N.
    normal_max_n, "normal_max_n", Force, "largest normal force",
        line(Group::Peaks, 1, "largest normal force, inner"), |s| Some(s.peaks.normal_max_n), peak: 3;
    /// Largest N_be, N.
    normal_outer_max_n, "normal_outer_max_n", Force, "largest normal force at the outer contact",
        None, |s| Some(s.peaks.normal_outer_max_n), peak: 4;
    /// Largest Hertz pressure, Pa.
    hertz_peak_pa, "hertz_peak_mpa", Pressure, "largest Hertz pressure",
        line(Group::Pressures, 0, "largest Hertz pressure"), |s| Some(s.hertz_peak_pa), normal_n: |s| s.peaks.normal_max_n;
    /// Hertz pressure at A at the smallest N_bi, Pa.
    hertz_least_pa, "hertz_least_mpa", Pressure, "smallest Hertz pressure",
        line(Group::Pressures, 1, "smallest Hertz pressure, inner"), |s| Some(s.hertz_least_pa), normal_n: |s| s.peaks.normal_min_n;
    /// How long A slips after an overrun has been reversed, s.
    initial_slip_s, "initial_slip_s", Time, "initial slip",
        line(Group::Reversal, 0, "initial slip after the reversal"), |s| s.initial_slip_s();
    /// Friction that rolling would need; 0 where none suffices in either run.
    required_friction, "required_static_friction", Friction, "static friction needed to stick",
        line(Group::Demand, 0, "static friction needed to stick"), |s| s.demand?.required_friction;
    /// Slip margin.
    slip_margin, "slip_margin", Margin, "slip margin",
        line(Group::Demand, 1, "slip margin"), |s| s.demand?.slip_margin;
    /// Contact margin.
    contact_margin, "contact_margin", ContactMargin, "contact margin",
        line(Group::Demand, 2, "contact margin"), |s| Some(s.demand?.contact_margin);
}

/// The figures of a group, in the order of their lines.
pub fn figures_of(group: Group) -> Vec<&'static Figure> {
    let mut found: Vec<(u8, &Figure)> =
        FIGURES.iter().filter_map(|f| f.line.filter(|l| l.group == group).map(|l| (l.place, f))).collect();
    found.sort_by_key(|(place, _)| *place);
    found.into_iter().map(|(_, figure)| figure).collect()
}

impl ErrorEstimate {
    /// `f` of each figure here and in `other`.
    fn with(mut self, other: &Self, f: impl Fn(f64, f64) -> f64) -> Self {
        for figure in FIGURES {
            let value = f((figure.error)(&self), (figure.error)(other));
            *(figure.error_mut)(&mut self) = value;
        }
        self.extremes_at_s = std::array::from_fn(|i| f(self.extremes_at_s[i], other.extremes_at_s[i]));
        self
    }

    /// Each figure's error, at least `share` of that in `other`: two runs may agree by chance.
    pub(super) fn at_least(self, share: f64, other: &Self) -> Self {
        self.with(other, |own, other| own.max(share * other))
    }
}

impl Simulation {
    /// How far every figure lies from that of `other`; a figure that a run has not counts as 0.
    pub fn off(&self, other: &Self) -> ErrorEstimate {
        let figures = |s: &Self| {
            let mut all = ErrorEstimate { extremes_at_s: s.peaks.at_s, ..ErrorEstimate::default() };
            for figure in FIGURES {
                *(figure.error_mut)(&mut all) = (figure.of)(s).unwrap_or(0.0);
            }
            all
        };
        figures(self).with(&figures(other), |a, b| (a - b).abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_figure_has_an_error_of_its_own_and_one_line() {
        for (i, figure) in FIGURES.iter().enumerate() {
            let mut e = ErrorEstimate::default();
            *(figure.error_mut)(&mut e) = 1.0;
            for (j, other) in FIGURES.iter().enumerate() {
                assert_eq!((other.error)(&e), f64::from(u8::from(i == j)), "{} {}", figure.key, other.key);
                let same_line = figure
                    .line
                    .zip(other.line)
                    .is_some_and(|(a, b)| (a.group, a.place) == (b.group, b.place));
                assert!(i == j || !same_line && figure.words != other.words, "{} {}", figure.key, other.key);
            }
            // Those that share a key stand side by side, and measure the same.
            let same: Vec<usize> = (0..FIGURES.len()).filter(|&j| FIGURES[j].key == figure.key).collect();
            assert!(same.windows(2).all(|w| w[1] == w[0] + 1) && same.len() <= 2, "{}", figure.key);
            assert!(same.iter().all(|&j| FIGURES[j].quantity == figure.quantity), "{}", figure.key);
            let suffix = match figure.quantity {
                Quantity::Angle => "_rad",
                Quantity::Length => "_mm",
                Quantity::Time => "_s",
                Quantity::Force => "_n",
                Quantity::Pressure => "_mpa",
                Quantity::Friction | Quantity::Margin | Quantity::ContactMargin => "",
                Quantity::Work => "_j",
                Quantity::Power => "_w",
                Quantity::Flux => "_w_per_mm2",
                Quantity::Rise => "_k",
                Quantity::Depth => "_um",
            };
            assert!(figure.key.ends_with(suffix), "{}", figure.key);
            assert_eq!(figure.normal_n.is_some(), figure.quantity == Quantity::Pressure, "{}", figure.key);
        }
        assert!(
            (0..5).all(|i| FIGURES.iter().filter(|f| f.peak == Some(i)).count() == 1),
            "each extreme once"
        );
    }
}
