//! The history of a scene: one row per sample, and as columns by the names that the CSV has.

use super::Ran;
use crate::clutch::Clutch;
use crate::dynamics::{Grip, Mode, Place, Sample};
use crate::report::Unit;
use crate::scenario::Prepared;
use crate::wedge::{Elastic, Lengthwise, Side, along, asks_for_slices};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use std::borrow::Cow;

/// One sample with what follows from it, SI.
#[derive(Debug, Clone)]
pub struct HistoryRow {
    /// The sample.
    pub sample: Sample,
    /// alpha', phi', theta_bi', theta_be' with the rolling constraints put in.
    pub rates: [f64; 4],
    /// T/N at A and B, positive as in a clutch that carries; none where the contact is open.
    pub tan: [Option<f64>; 2],
    /// Torque of the clutch on the inner race n_s T_bi OA, N m.
    pub torque_nm: f64,
    /// p_0 at A and B, Pa.
    pub hertz_pa: [f64; 2],
    /// Largest pressure of a slice at A and B, Pa, where the design asks for slices.
    pub slice_pa: Option<[f64; 2]>,
    /// Torque from outside on the inner race, N m, engaging positive, and mean speed, rad/s.
    pub acting: [f64; 2],
    /// Arc in contact, from 0, in the profile's count.
    pub arc: usize,
}

impl Ran {
    /// All rows of the history; none for an equilibrium.
    pub fn rows(&self) -> Vec<HistoryRow> {
        let Ok((prepared, simulation)) = &self.outcome else { return Vec::new() };
        let count = self.design.clutch.sprags.count as f64;
        let most = [simulation.peaks.normal_max_n, simulation.peaks.normal_outer_max_n];
        let slices = SlicePeaks::new(prepared, &self.design.clutch, most);
        simulation.samples.iter().map(|sample| row(prepared, count, sample, slices.as_ref())).collect()
    }

    /// The history in columns; for an equilibrium its one row.
    pub fn history(&self) -> SceneHistory {
        let mut history = SceneHistory::default();
        if self.method == "equilibrium" {
            if let Ok((prepared, s)) = &self.outcome {
                let torque = s.overrun.map(|o| o.drag_torque_nm).or(self.scenario.held_torque_nm());
                let p = &s.peaks;
                let row = [
                    prepared.state[0],
                    torque.unwrap_or(f64::NAN),
                    p.normal_max_n,
                    p.normal_outer_max_n,
                    p.tan_inner,
                    p.tan_outer,
                    s.hertz_peak_pa,
                ];
                for ((name, unit), value) in EQUILIBRIUM.into_iter().zip(row) {
                    history.numbers_in(name, unit, [value]);
                }
            } else {
                EQUILIBRIUM.into_iter().for_each(|(name, unit)| history.numbers_in(name, unit, []));
            }
            return history;
        }
        let rows = self.rows();
        for column in COLUMNS {
            match column {
                Column::Number(name, unit, of) => history.numbers_in(name, *unit, rows.iter().map(of)),
                Column::Word(name, of) => {
                    history.columns.push(((*name).into(), Values::Words(rows.iter().map(of).collect())));
                }
                Column::Count(name, of) => {
                    history.columns.push(((*name).into(), Values::Counts(rows.iter().map(of).collect())));
                }
            }
        }
        if rows.first().is_some_and(|r| r.slice_pa.is_some()) {
            for (name, i) in [("slice_peak_inner_mpa", 0), ("slice_peak_outer_mpa", 1)] {
                let of = |r: &HistoryRow| r.slice_pa.map_or(f64::NAN, |p| p[i]);
                history.numbers_in(name, Unit::Megapascal, rows.iter().map(of));
            }
        }
        if let Ok((prepared, s)) = &self.outcome {
            super::train::add(&mut history, prepared, s);
        }
        history
    }
}

/// A history: columns of one length, by names that end in their unit. As JSON an object of lists.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SceneHistory {
    /// Name and values of each column.
    pub columns: Vec<(Cow<'static, str>, Values)>,
}

/// The values of a column.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Values {
    /// In the unit of the column's name; NaN where there is none.
    Numbers(Vec<f64>),
    /// Words: what a contact does ([`word`]).
    Words(Vec<&'static str>),
    /// Counted from 1; `None` where there is none.
    Counts(Vec<Option<usize>>),
}

impl Values {
    /// Rows.
    pub fn len(&self) -> usize {
        match self {
            Self::Numbers(v) => v.len(),
            Self::Words(v) => v.len(),
            Self::Counts(v) => v.len(),
        }
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl SceneHistory {
    /// The numbers of a column, in the unit that its name ends in.
    pub fn numbers(&self, name: &str) -> Option<&[f64]> {
        match self.columns.iter().find(|(n, _)| *n == name) {
            Some((_, Values::Numbers(values))) => Some(values),
            _ => None,
        }
    }

    fn numbers_in(&mut self, name: &'static str, unit: Unit, si: impl IntoIterator<Item = f64>) {
        let values = si.into_iter().map(|v| unit.from_si(v)).collect();
        self.columns.push((name.into(), Values::Numbers(values)));
    }
}

impl Serialize for SceneHistory {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.columns.len()))?;
        for (name, values) in &self.columns {
            map.serialize_entry(name, values)?;
        }
        map.end()
    }
}

/// One column of a history: name, unit of the name, how it is taken from a row.
enum Column {
    /// SI, NaN where there is none.
    Number(&'static str, Unit, fn(&HistoryRow) -> f64),
    Word(&'static str, fn(&HistoryRow) -> &'static str),
    Count(&'static str, fn(&HistoryRow) -> Option<usize>),
}

/// The columns of an equilibrium.
const EQUILIBRIUM: [(&str, Unit); 7] = [
    ("alpha_rad", Unit::Radian),
    ("torque_nm", Unit::NewtonMetre),
    ("normal_inner_n", Unit::Newton),
    ("normal_outer_n", Unit::Newton),
    ("tan_inner", Unit::One),
    ("tan_outer", Unit::One),
    ("hertz_peak_mpa", Unit::Megapascal),
];

/// The columns of a motion.
const COLUMNS: &[Column] = &[
    Column::Number("time_s", Unit::Second, |r| r.sample.t),
    Column::Number("theta_inner_rad", Unit::Radian, |r| r.sample.state[2]),
    Column::Number("theta_outer_rad", Unit::Radian, |r| r.sample.state[3]),
    Column::Number("alpha_rad", Unit::Radian, |r| r.sample.state[0]),
    Column::Number("phi_rad", Unit::Radian, |r| r.sample.state[1]),
    Column::Number("theta_inner_rate_rad_per_s", Unit::RadianPerSecond, |r| r.rates[2]),
    Column::Number("theta_outer_rate_rad_per_s", Unit::RadianPerSecond, |r| r.rates[3]),
    Column::Number("alpha_rate_rad_per_s", Unit::RadianPerSecond, |r| r.rates[0]),
    Column::Number("phi_rate_rad_per_s", Unit::RadianPerSecond, |r| r.rates[1]),
    Column::Number("normal_inner_n", Unit::Newton, |r| r.sample.forces.n_bi),
    Column::Number("normal_outer_n", Unit::Newton, |r| r.sample.forces.n_be),
    Column::Number("tan_inner", Unit::One, |r| r.tan[0].map_or(f64::NAN, f64::abs)),
    Column::Number("tan_outer", Unit::One, |r| r.tan[1].map_or(f64::NAN, f64::abs)),
    Column::Number("tangential_inner_n", Unit::Newton, |r| r.sample.forces.t_bi),
    Column::Number("tangential_outer_n", Unit::Newton, |r| r.sample.forces.t_be),
    Column::Number("slip_velocity_inner_m_per_s", Unit::MetrePerSecond, |r| r.sample.forces.v_a),
    Column::Number("slip_velocity_outer_m_per_s", Unit::MetrePerSecond, |r| r.sample.forces.v_b),
    Column::Number("slip_inner_mm", Unit::Millimetre, |r| r.sample.slip_m[0]),
    Column::Number("slip_outer_mm", Unit::Millimetre, |r| r.sample.slip_m[1]),
    Column::Word("mode_inner", |r| word(&r.sample.mode, true)),
    Column::Word("mode_outer", |r| word(&r.sample.mode, false)),
    Column::Count("arc", |r| matches!(r.sample.mode.place, Place::Arc(_)).then_some(r.arc + 1)),
    Column::Number("hertz_inner_mpa", Unit::Megapascal, |r| r.hertz_pa[0]),
    Column::Number("hertz_outer_mpa", Unit::Megapascal, |r| r.hertz_pa[1]),
    Column::Number("torque_nm", Unit::NewtonMetre, |r| r.torque_nm),
    Column::Number("acting_torque_nm", Unit::NewtonMetre, |r| r.acting[0]),
    Column::Number("speed_rpm", Unit::Rpm, |r| r.acting[1]),
];

/// Largest slice pressure over Hertz's p_0 by normal force, from a few loads: it changes by per cents over decades,
/// and each load is a system of equations.
struct SlicePeaks<'p> {
    elastic: &'p Elastic,
    /// (ln N, ratio) at A on each arc, then at B.
    ratios: Vec<Vec<[f64; 2]>>,
}

/// Loads at which slices are solved for the history, a factor of 10 over three of them.
const SLICE_LOADS: usize = 16;

impl<'p> SlicePeaks<'p> {
    fn new(prepared: &'p Prepared, clutch: &Clutch, most_n: [f64; 2]) -> Option<Self> {
        let elastic = &prepared.model.curve.statics().elastic;
        if !asks_for_slices(clutch) {
            return None;
        }
        let places = (0..elastic.inner_contact.len()).map(Some).chain([None]);
        let ratios = places.map(|arc| {
            let (contact, side) = match arc {
                Some(k) => (elastic.inner_contact.get(k)?, Side::Inner),
                None => (&elastic.outer_contact, Side::Outer),
            };
            let most = most_n[usize::from(arc.is_none())].max(1.0);
            let at = |i: usize| {
                let n = most * 10f64.powf(-(i as f64) / 3.0);
                let peak = along(clutch, contact, side, n, Lengthwise::Slices)
                    .ok()?
                    .pressure_pa
                    .into_iter()
                    .fold(0.0, f64::max);
                Some([n.ln(), peak / contact.peak_pressure_pa(n)])
            };
            (0..SLICE_LOADS).rev().map(at).collect::<Option<Vec<_>>>()
        });
        Some(Self { elastic, ratios: ratios.collect::<Option<_>>()? })
    }

    fn at(&self, arc: usize, n_bi: f64, n_be: f64) -> [f64; 2] {
        let value = |place: usize, n: f64, p0: f64| {
            let table = self.ratios.get(place).map_or(&[][..], Vec::as_slice);
            let right = table.partition_point(|r| r[0] < n.max(f64::MIN_POSITIVE).ln());
            let ratio = match (right.checked_sub(1).and_then(|i| table.get(i)), table.get(right)) {
                (Some(a), Some(b)) => a[1] + (b[1] - a[1]) * (n.ln() - a[0]) / (b[0] - a[0]),
                (Some(a), None) => a[1],
                (None, Some(b)) => b[1],
                (None, None) => return 0.0,
            };
            ratio * p0
        };
        let inner = self.elastic.inner_contact.get(arc).map_or(0.0, |c| c.peak_pressure_pa(n_bi.max(0.0)));
        let outer = self.elastic.outer_contact.peak_pressure_pa(n_be.max(0.0));
        [value(arc, n_bi, inner), value(self.ratios.len() - 1, n_be, outer)]
    }
}

fn row(prepared: &Prepared, count: f64, sample: &Sample, slices: Option<&SlicePeaks>) -> HistoryRow {
    let model = &prepared.model;
    let p = model.point(sample.mode.place, sample.state[0]);
    let f = &sample.forces;
    let closed = !matches!(sample.mode.place, Place::Open | Place::Carried);
    let tan = |t: f64, n: f64| (closed && n > 0.0).then(|| t / n);
    let elastic = &model.curve.statics().elastic;
    let arc = match sample.mode.place {
        Place::Arc(k) => model.curve.first_arc() + k,
        Place::Open | Place::Tension | Place::Carried => 0,
    };
    HistoryRow {
        sample: *sample,
        rates: model.rates(&sample.mode, &p, &sample.state),
        tan: [tan(f.t_bi, f.n_bi), tan(f.t_be, f.n_be)],
        torque_nm: count * f.t_bi * p.oa,
        hertz_pa: [
            // The mean over the patch, as everywhere.
            model.curve.hertz_inner_pa(f.n_bi),
            elastic.outer_contact.peak_pressure_pa(f.n_be.max(0.0)),
        ],
        slice_pa: slices.map(|s| s.at(arc, f.n_bi, f.n_be)),
        acting: [model.drive.torque_at(sample.t) - model.loads.inner_nm, model.mean_speed(sample.t).0],
        arc,
    }
}

/// What a contact does, in one word; `inner` is open where A has no force.
pub fn word(mode: &Mode, inner: bool) -> &'static str {
    if mode.place == Place::Open && inner {
        return "open";
    }
    if mode.place == Place::Carried && inner {
        return "cage";
    }
    if mode.is_off() {
        return "open";
    }
    match if inner { mode.inner } else { mode.outer } {
        Grip::Stick => "stick",
        Grip::Slip(s) if s > 0.0 => "slip+",
        Grip::Slip(_) => "slip-",
    }
}
