//! What statics says of a design, as the page shows it.

use super::fields::{Field, fields};
use crate::answer::check::{Capacity, demand_cell, in_place_of_margin, is_beyond};
use crate::design::Design;
use crate::margin::{
    Capacities, LIFT_OFF_TO_RAD_S, LoadState, Margin, NoMargins, lift_off_rad_s, overrun_at, static_margins,
};
use crate::report::{Cell, Curve, Dash, Drawing, Live, Plot, SpragPose, Unit, live, significant};
use crate::wedge::{Closure, StaticPoint};
use serde::Serialize;

/// How a margin is painted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum MarginColour {
    /// Held.
    Green,
    /// Held, by less than 10 %.
    Amber,
    /// Not held.
    Red,
    /// Shown only.
    Grey,
}

/// A margin below this is painted amber: a choice, some scatter of friction and load away from the limit.
const NARROW: f64 = 0.1;

/// One margin.
#[derive(Debug, Clone, Serialize)]
pub struct MarginRow {
    /// Code of the limit.
    pub code: String,
    /// Name for people, and what the limit is.
    pub name: String,
    /// Demand and allowable as printed, with their unit.
    pub against: String,
    /// Margin as `check` prints it.
    pub text: String,
    /// Torque at which the limit would be reached, as printed; empty where it does not depend on torque.
    pub reached: String,
    /// Margin, a pure number.
    pub margin: f64,
    /// Whether it counts for the verdict.
    pub required: bool,
    /// How it is painted.
    pub tone: MarginColour,
}

/// One equilibrium under torque: where the sprag stands, and the forces on it.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Pose {
    /// Torque of the clutch, N m.
    pub torque_nm: f64,
    /// alpha, rad.
    pub alpha_rad: f64,
    /// Rotation of the body against OC_e since first contact, rad.
    pub rotation_rad: f64,
    /// OC_e, m.
    pub oc_e_m: f64,
    /// OA, m.
    pub oa_m: f64,
    /// OB, m.
    pub ob_m: f64,
    /// Azimuth of A ahead of B, rad.
    pub beta_rad: f64,
    /// Normal force at A, N.
    pub normal_inner_n: f64,
    /// Tangential force at A, N.
    pub tangential_inner_n: f64,
    /// Normal force at B, N.
    pub normal_outer_n: f64,
    /// Tangential force at B, N.
    pub tangential_outer_n: f64,
    /// Windup, rad.
    pub windup_rad: f64,
    /// tan omega.
    pub tan_omega: f64,
    /// Hertz pressure at A, Pa.
    pub hertz_inner_pa: f64,
}

impl Pose {
    fn new((p, c): &(StaticPoint, Closure)) -> Self {
        Self {
            torque_nm: p.torque_nm,
            alpha_rad: c.alpha.v,
            rotation_rad: c.rotation.v,
            oc_e_m: c.lengths.oc_e.v,
            oa_m: c.lengths.oa.v,
            ob_m: c.lengths.ob.v,
            beta_rad: c.beta.v,
            normal_inner_n: c.n_bi,
            tangential_inner_n: c.t_bi.v,
            normal_outer_n: c.n_be.v,
            tangential_outer_n: c.t_be.v,
            windup_rad: p.windup_rad,
            tan_omega: p.tan_omega,
            hertz_inner_pa: p.hertz_inner_pa,
        }
    }
}

/// A figure of the clutch, as printed.
#[derive(Debug, Clone, Serialize)]
pub struct FigureRow {
    /// What it is.
    pub name: &'static str,
    /// Now.
    pub text: String,
    /// Of the pinned design, where it differs.
    pub pinned: Option<String>,
}

/// The answer of statics.
#[derive(Debug, Clone, Serialize)]
pub struct StudioView {
    /// Name of the design.
    pub name: String,
    /// Hash of the file.
    pub hash: String,
    /// Whether all required static limits are held.
    pub held: bool,
    /// Static margins, required ones first, the least first.
    pub margins: Vec<MarginRow>,
    /// What it carries, size, mass, drag and the speed of lift-off.
    pub figures: Vec<FigureRow>,
    /// What can be changed.
    pub fields: Vec<Field>,
    /// Names of the scenarios.
    pub scenarios: Vec<String>,
    /// Whether the design has a task for the optimiser.
    pub has_task: bool,
    /// Static friction, to hold a scene's demand against.
    pub static_friction: f64,
    /// The sprag between its races, in parts that move.
    pub picture: Option<Live>,
    /// Radius of the sprag's outer arc and of the outer track, m: how far the outer race rolls.
    pub outer_radii_m: [f64; 2],
    /// Equilibria, torque ascending.
    pub poses: Vec<Pose>,
    /// The same of the pinned design.
    pub pinned_poses: Vec<Pose>,
    /// Torque at the end of the curve, N m, and why it ends.
    pub end: (f64, &'static str),
    /// Nominal torque, N m; 0: the limits name none.
    pub nominal_nm: f64,
    /// Largest torque that a limit names, N m.
    pub asked_nm: f64,
    /// Torque over windup, as SVG.
    pub windup_svg: String,
    /// Demand on friction over torque, as SVG.
    pub tangent_svg: String,
}

/// A design with its statics, kept while the page looks at it.
#[derive(Debug, Clone)]
pub struct Solved {
    /// The design.
    pub design: Design,
    /// Its load state.
    pub state: LoadState,
    rows: Vec<Margin>,
    samples: Vec<(StaticPoint, Closure)>,
    /// What it carries, size, mass, drag and the speed of lift-off: names and texts.
    figures: [(&'static str, String); 7],
}

/// Points on each arc: enough for the plots of the page.
const PER_ARC: usize = 24;
/// Width of the plots, px.
const WIDTH: f64 = 380.0;

/// States along the curve, those at nominal and at peak torque among them, so that what is read there is what the limits are held by.
fn samples(design: &Design, state: &LoadState) -> Vec<(StaticPoint, Closure)> {
    let curve = &state.curve;
    let mut samples = curve.samples(f64::INFINITY, PER_ARC);
    let limits = &design.limits;
    for torque_nm in [limits.nominal_torque_nm, limits.peak_torque_nm].into_iter().flatten() {
        if let Some(sample) = curve.sample_at_torque(torque_nm) {
            let place = samples.partition_point(|(p, _)| p.torque_nm < torque_nm);
            samples.insert(place, sample);
        }
    }
    samples
}

impl Solved {
    /// Statics of a design.
    ///
    /// # Errors
    /// [`NoMargins`].
    pub fn new(design: Design) -> Result<Self, NoMargins> {
        let (state, rows, _) = static_margins(&design, Capacities::Wanted)?;
        let samples = samples(&design, &state);
        let figures = figures(&design, &state, &rows);
        Ok(Self { design, state, rows, samples, figures })
    }

    /// The answer, with `pinned` as ghost in picture and plots.
    pub fn view(&self, pinned: Option<&Self>) -> StudioView {
        let design = &self.design;
        let mut margins: Vec<MarginRow> =
            self.rows.iter().map(|r| row(r, Some(self.state.curve.end_torque_nm()))).collect();
        sort(&mut margins);
        let limits = &design.limits;
        let sprags = [Some(self), pinned].into_iter().flatten().map(Self::pose_at_rest).collect();
        StudioView {
            name: design.name.clone(),
            hash: design.hash.clone(),
            held: self.rows.iter().filter(|r| r.required).all(Margin::held),
            margins,
            figures: self.figures(pinned),
            fields: fields(design),
            scenarios: design.scenarios.iter().map(|s| s.name.clone()).collect(),
            has_task: design.optimize.is_some(),
            static_friction: design.clutch.friction.static_,
            picture: live(&Drawing::of(&design.clutch, sprags)),
            outer_radii_m: [design.clutch.sprags.outer_radius_m, design.clutch.races.outer_radius_m],
            poses: self.samples.iter().map(Pose::new).collect(),
            pinned_poses: pinned.iter().flat_map(|p| p.samples.iter().map(Pose::new)).collect(),
            end: (self.state.curve.end_torque_nm(), self.state.curve.end().0.name()),
            nominal_nm: limits.nominal_torque_nm.unwrap_or(0.0),
            asked_nm: limits.largest_torque_nm().unwrap_or(0.0),
            windup_svg: self.windup(pinned).to_svg(),
            tangent_svg: self.tangent(pinned).to_svg(),
        }
    }

    fn figures(&self, pinned: Option<&Self>) -> Vec<FigureRow> {
        let row = |(k, (name, text)): (usize, &(&'static str, String))| {
            let pinned = pinned.map(|p| p.figures[k].1.clone()).filter(|was| was != text);
            FigureRow { name, text: text.clone(), pinned }
        };
        self.figures.iter().enumerate().map(row).collect()
    }

    fn pose_at_rest(&self) -> SpragPose {
        SpragPose::at_rest(&self.design.name, &self.design.clutch, &self.state.profile)
    }

    /// Torque to which the plots go: half as much again as is asked, or the curve's end.
    fn plotted_to_nm(&self) -> f64 {
        let limits = &self.design.limits;
        let asked = limits.largest_torque_nm();
        asked.map_or(f64::INFINITY, |t| 1.5 * t)
    }

    fn windup(&self, pinned: Option<&Self>) -> Plot {
        let up_to = self.plotted_to_nm();
        let plot = Plot::new("Windup, deg", "Torque, Nm").sized(WIDTH, 280.0);
        let over = |p: &StaticPoint| [Unit::Degree.from_si(p.windup_rad), p.torque_nm];
        self.limits_of(both(plot, self, pinned, up_to, &over), false)
    }

    fn tangent(&self, pinned: Option<&Self>) -> Plot {
        let up_to = self.plotted_to_nm();
        let plot = Plot::new("Torque, Nm", "tan ω, inner contact").sized(WIDTH, 280.0);
        let plot = both(plot, self, pinned, up_to, &|p| [p.torque_nm, p.tan_omega]);
        self.limits_of(plot.level(self.design.clutch.friction.static_, "μₛ"), true)
    }

    /// The torques of the limits, as levels or as markers.
    fn limits_of(&self, plot: Plot, torque_is_x: bool) -> Plot {
        let limits = &self.design.limits;
        let named = [(limits.nominal_torque_nm, "nominal"), (limits.peak_torque_nm, "peak")];
        named.into_iter().filter_map(|(t, name)| Some((t?, name))).fold(plot, |plot, (t, name)| {
            if torque_is_x { plot.marker(t, name) } else { plot.level(t, name) }
        })
    }
}

fn figures(design: &Design, state: &LoadState, rows: &[Margin]) -> [(&'static str, String); 7] {
    let races = &design.clutch.races;
    let slow = overrun_at(design, state, 0.0, 0.0);
    let off = lift_off_rad_s(design, state, LIFT_OFF_TO_RAD_S);
    let none = || "–".to_owned();
    let carried = |c: Option<Capacity>| {
        c.map_or_else(none, |c| format!("{} ({})", Unit::NewtonMetre.show(c.torque_capacity_nm, 4), c.code))
    };
    let end_nm = state.curve.end_torque_nm();
    let [nominal, peak] = Capacity::nominal_and_peak(rows, end_nm);
    let nominal = match nominal {
        // As in the table: not before the curve ends.
        None if Capacity::asked_at_nominal(rows) => format!("> {}", Unit::NewtonMetre.show(end_nm, 4)),
        found => carried(found),
    };
    [
        ("carries, nominal", nominal),
        ("carries, peak", carried(peak)),
        ("outside ⌀", Unit::Millimetre.show(2.0 * races.outer_outside_radius_m, 4)),
        ("width", Unit::Millimetre.show(races.width_m, 4)),
        ("mass", Unit::Gram.show(design.clutch.mass_kg(), 4)),
        ("drag, slow", slow.map_or_else(|_| none(), |p| Unit::NewtonMetre.show(p.state.drag_torque_nm, 3))),
        (
            if design.clutch.slides_outside() { "lift-off, inner race" } else { "lift-off, outer race" },
            off.map_or_else(none, |speed| Unit::Rpm.show(speed, 4)),
        ),
    ]
}

/// The curve of now, full, and the pinned one, dashed; one colour for each everywhere.
fn both(
    mut plot: Plot,
    now: &Solved,
    pinned: Option<&Solved>,
    up_to_nm: f64,
    point: &dyn Fn(&StaticPoint) -> [f64; 2],
) -> Plot {
    let points = |solved: &Solved| -> Vec<[f64; 2]> {
        solved.samples.iter().map(|s| &s.0).filter(|p| p.torque_nm <= up_to_nm).map(point).collect()
    };
    plot.curves.push(Curve::new("now", points(now)).coloured(0));
    if let Some(pinned) = pinned {
        let before = Curve::new("pinned", points(pinned)).coloured(1);
        plot.curves.push(Curve { dash: Dash::Dashed, ..before });
    }
    plot
}

/// Required ones first, the least margin first.
pub(super) fn sort(rows: &mut [MarginRow]) {
    rows.sort_by(|a, b| b.required.cmp(&a.required).then(a.margin.total_cmp(&b.margin)));
}

/// A margin for the page; `end_torque_nm`: where the static curve ends, N m, of a row that is no scene's.
pub(super) fn row(r: &Margin, end_torque_nm: Option<f64>) -> MarginRow {
    let margin = r.margin();
    let tone = match (r.required, r.held(), margin < NARROW) {
        (false, ..) => MarginColour::Grey,
        (true, false, _) => MarginColour::Red,
        (true, true, true) => MarginColour::Amber,
        (true, true, false) => MarginColour::Green,
    };
    let shown = || r.shown_margin().map_or("no demand".to_owned(), |m| Unit::Percent.show(m, 3));
    let text = in_place_of_margin(r).map_or_else(shown, str::to_owned);
    let early = end_torque_nm.filter(|_| r.is_not_reached());
    MarginRow {
        code: r.code(),
        name: format!("{}. {}", r.full_name(), r.limit.explanation),
        against: match (early, in_place_of_margin(r)) {
            (Some(end_nm), _) => format!("the curve ends at {}", Unit::NewtonMetre.show(end_nm, 4)),
            (None, Some(_)) => String::new(),
            (None, None) => against(r),
        },
        text,
        reached: if early.is_some() { String::new() } else { reached(r, end_torque_nm) },
        margin,
        required: r.required,
        tone,
    }
}

/// The torque at which the limit would be reached, as the table of `check` has it.
fn reached(r: &Margin, end_torque_nm: Option<f64>) -> String {
    let Some((capacity_nm, end_nm)) = r.torque_capacity_nm.zip(end_torque_nm) else { return String::new() };
    match is_beyond(r, capacity_nm, end_nm) {
        true => format!("> {}", Unit::NewtonMetre.show(end_nm, 4)),
        false => Unit::NewtonMetre.show(capacity_nm, 4),
    }
}

/// Demand and allowable, or the allowable alone where that is a number held by itself: a clearance, the contact margin.
fn against(r: &Margin) -> String {
    let unit = if r.limit.unit == "1" { String::new() } else { format!(" {}", r.limit.unit) };
    if r.is_slip() {
        let wanted = Unit::Percent.show(r.reference, 3);
        return r
            .demand_in_unit()
            .map_or(format!("{wanted} wanted"), |mu| format!("μ {}, {wanted} wanted", significant(mu, 3)));
    }
    let allowable = format!("{}{unit}", significant(r.allowable_in_unit(), 4));
    if let Cell::Text(instead) = demand_cell(r) {
        return format!("{instead}, of {allowable}");
    }
    match r.demand_in_unit() {
        Some(0.0) | None => allowable,
        Some(demand) => format!("{} of {allowable}", significant(demand, 4)),
    }
}
