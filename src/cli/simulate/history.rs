//! Histories: one row per sample, as CSV and as curves.

use super::{Scene, SimulateArgs, duration_s};
use crate::design::{Clutch, Scenario, ScenarioKind};
use crate::dynamics::{Grip, History, Mode, Place, Sample};
use crate::report::{Cell, Column, Table, Unit};
use crate::scenario::Prepared;
use crate::wedge::{Elastic, Lengthwise, Side, along, asks_for_slices};

/// One sample with what follows from it, SI.
pub(super) struct Row {
    pub(super) sample: Sample,
    /// alpha', phi', theta_bi', theta_be' with the rolling constraints put in.
    pub(super) rates: [f64; 4],
    /// T/N at A and B, positive as in a clutch that carries; none where the contact is open.
    pub(super) tan: [Option<f64>; 2],
    /// Torque of the clutch on the inner race n_s T_bi OA, N m.
    pub(super) torque_nm: f64,
    /// p_0 at A and B, Pa.
    pub(super) hertz_pa: [f64; 2],
    /// Largest pressure of a slice at A and B, Pa, where the design asks for slices.
    pub(super) slice_pa: Option<[f64; 2]>,
    /// Torque from outside on the inner race, N m, engaging positive, and mean speed, rad/s.
    pub(super) acting: [f64; 2],
    /// Arc in contact, from 0, in the profile's count.
    pub(super) arc: usize,
}

/// Rows of the history of a short scene: one that these show well.
const ROWS: usize = 1200;
/// Rows that show a period of the excitation well.
const ROWS_A_PERIOD: f64 = 24.0;
/// Rows that show a second well: a clutch swings at some 100 Hz.
const ROWS_A_SECOND: f64 = 1000.0;
/// Rows that are not exceeded unless they are asked for.
const MOST_ROWS: usize = 400_000;

/// How many samples, and of what. Where [`ROWS`] do not show a scene well there are more, and changes of mode and extremes
/// beside them.
pub(super) fn asked(args: &SimulateArgs, scenario: &Scenario) -> (usize, History) {
    let [from, until] = args.window.unwrap_or([0.0, duration_s(scenario).unwrap_or(0.0)]);
    let frequency_hz = match scenario.kind {
        ScenarioKind::TorsionalExcitation { frequency_hz, .. } => frequency_hz,
        _ => 0.0,
    };
    let well = 1 + ((ROWS_A_PERIOD * frequency_hz).max(ROWS_A_SECOND) * (until - from)).round() as usize;
    let rows = args.samples.and_then(|n| usize::try_from(n).ok());
    let history = History { window_s: args.window, marks: rows.is_none() && well > ROWS };
    (rows.unwrap_or(well.clamp(ROWS, MOST_ROWS)), history)
}

/// A sentence where the scene is so long that its history has fewer rows than show it well.
pub(super) fn fewer(args: &SimulateArgs, scenario: &Scenario) -> Option<String> {
    let (rows, history) = asked(args, scenario);
    (history.marks && rows == MOST_ROWS).then(|| {
        format!(
            "the history has {rows} rows, too few to show every swing; --window A:B shows a part of it finely"
        )
    })
}

/// All rows of the history; none for an equilibrium.
pub(super) fn rows(scene: &Scene) -> Vec<Row> {
    let Ok((prepared, simulation)) = &scene.outcome else { return Vec::new() };
    let count = scene.own.clutch.sprags.count as f64;
    let most = [simulation.peaks.normal_max_n, simulation.peaks.normal_outer_max_n];
    let slices = SlicePeaks::new(prepared, &scene.own.clutch, most);
    simulation.samples.iter().map(|sample| row(prepared, count, sample, slices.as_ref())).collect()
}

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

fn row(prepared: &Prepared, count: f64, sample: &Sample, slices: Option<&SlicePeaks>) -> Row {
    let model = &prepared.model;
    let p = model.point(sample.mode.place, sample.state[0]);
    let f = &sample.forces;
    let closed = sample.mode.place != Place::Open;
    let tan = |t: f64, n: f64| (closed && n > 0.0).then(|| t / n);
    let elastic = &model.curve.statics().elastic;
    let arc = match sample.mode.place {
        Place::Arc(k) => model.curve.first_arc() + k,
        Place::Open | Place::Tension => 0,
    };
    Row {
        sample: *sample,
        rates: model.rates(&sample.mode, &p, &sample.state),
        tan: [tan(f.t_bi, f.n_bi), tan(f.t_be, f.n_be)],
        torque_nm: count * f.t_bi * p.oa,
        hertz_pa: [
            // The mean over the patch, as everywhere.
            Some(f.n_bi)
                .filter(|&n| n > 0.0)
                .and_then(|n| model.curve.at_normal(n))
                .map_or(0.0, |p| p.hertz_inner_pa),
            elastic.outer_contact.peak_pressure_pa(f.n_be.max(0.0)),
        ],
        slice_pa: slices.map(|s| s.at(arc, f.n_bi, f.n_be)),
        acting: [model.drive.torque_at(sample.t) - model.loads.inner_nm, model.mean_speed(sample.t).0],
        arc,
    }
}

/// What a contact does, in one word; `inner` is open where A has no force.
pub(super) fn word(mode: &Mode, inner: bool) -> &'static str {
    if mode.place == Place::Open && inner {
        return "open";
    }
    match if inner { mode.inner } else { mode.outer } {
        Grip::Stick => "stick",
        Grip::Slip(s) if s > 0.0 => "slip+",
        Grip::Slip(_) => "slip-",
    }
}

/// The CSV: the history, or one row with the equilibrium.
pub(super) fn table(scene: &Scene) -> Table {
    let number = |key: &str, unit| Column::number(key, key, unit, 9);
    let contacts = [
        number("normal_inner_n", Unit::Newton),
        number("normal_outer_n", Unit::Newton),
        number("tan_inner", Unit::One),
        number("tan_outer", Unit::One),
    ];
    if scene.method == "equilibrium" {
        let lead = [number("alpha_rad", Unit::Radian), number("torque_nm", Unit::NewtonMetre)];
        let tail = [number("hertz_peak_mpa", Unit::Megapascal)];
        let mut table = Table::new(lead.into_iter().chain(contacts).chain(tail).collect());
        if let Ok((prepared, s)) = &scene.outcome {
            let torque = s.overrun.map(|o| o.drag_torque_nm).or(scene.drawn_torque_nm());
            let p = &s.peaks;
            table.row(vec![
                prepared.state[0].into(),
                torque.into(),
                p.normal_max_n.into(),
                p.normal_outer_max_n.into(),
                p.tan_inner.into(),
                p.tan_outer.into(),
                s.hertz_peak_pa.into(),
            ]);
        }
        return table;
    }
    let angles = ["theta_inner", "theta_outer", "alpha", "phi"];
    let mut columns = vec![number("time_s", Unit::Second)];
    columns.extend(angles.map(|a| number(&format!("{a}_rad"), Unit::Radian)));
    columns.extend(angles.map(|a| number(&format!("{a}_rate_rad_per_s"), Unit::RadianPerSecond)));
    columns.extend(contacts);
    columns.extend([
        number("tangential_inner_n", Unit::Newton),
        number("tangential_outer_n", Unit::Newton),
        number("slip_velocity_inner_m_per_s", Unit::MetrePerSecond),
        number("slip_velocity_outer_m_per_s", Unit::MetrePerSecond),
        number("slip_inner_mm", Unit::Millimetre),
        number("slip_outer_mm", Unit::Millimetre),
        Column::text("mode_inner", "mode_inner"),
        Column::text("mode_outer", "mode_outer"),
        Column::text("arc", "arc"),
        number("hertz_inner_mpa", Unit::Megapascal),
        number("hertz_outer_mpa", Unit::Megapascal),
        number("torque_nm", Unit::NewtonMetre),
        number("acting_torque_nm", Unit::NewtonMetre),
        number("speed_rpm", Unit::Rpm),
    ]);
    let rows = rows(scene);
    if rows.first().is_some_and(|r| r.slice_pa.is_some()) {
        columns.extend(["slice_peak_inner_mpa", "slice_peak_outer_mpa"].map(|k| number(k, Unit::Megapascal)));
    }
    let mut table = Table::new(columns);
    for row in rows {
        table.row(cells(&row));
    }
    table
}

fn cells(row: &Row) -> Vec<Cell> {
    let Row { sample, rates, tan, torque_nm, hertz_pa, .. } = row;
    let (y, f) = (&sample.state, &sample.forces);
    let arc = match sample.mode.place {
        Place::Arc(_) => Cell::Count(row.arc + 1),
        Place::Open | Place::Tension => Cell::Empty,
    };
    let numbers = |values: &[f64]| values.iter().map(|&v| Cell::Si(v)).collect::<Vec<_>>();
    let mut cells = numbers(&[sample.t, y[2], y[3], y[0], y[1], rates[2], rates[3], rates[0], rates[1]]);
    cells.extend(numbers(&[f.n_bi, f.n_be]));
    cells.extend(tan.map(|q| Cell::from(q.map(f64::abs))));
    cells.extend(numbers(&[f.t_bi, f.t_be, f.v_a, f.v_b, y[8], y[9]]));
    cells.extend([word(&sample.mode, true).into(), word(&sample.mode, false).into(), arc]);
    cells.extend(numbers(&[hertz_pa[0], hertz_pa[1], *torque_nm, row.acting[0], row.acting[1]]));
    cells.extend(row.slice_pa.iter().flat_map(|p| numbers(p)));
    cells
}
