//! The stiffness curves as a page.

use super::body::Body;
use super::laws::description;
use super::tables::{full, junction_text, tangents, windups};
use super::{LawCurve, end_text};
use crate::cli::Context;
use crate::cli::parts::{self, Answer};
use crate::design::Design;
use crate::profile::Profile;
use crate::report::{Page, Plot, Unit};
use crate::wedge::StaticPoint;

pub(super) fn page(
    design: &Design,
    profile: &Profile,
    laws: &[LawCurve],
    answer: &Answer<'_, Body>,
    context: &Context,
) -> Page {
    let mut page = parts::page("Stiffness", design, context);
    page.list(laws.iter().map(|l| {
        format!(
            "{}. Curve ends {}{}.",
            description(&l.clutch.contact, &l.clutch.axial),
            end_text(l),
            junction_text(l)
        )
    }));
    let up_to = laws.iter().flat_map(|l| &l.rows).map(|r| r.0).fold(0.0, f64::max);
    let curves = Curves::new(laws, up_to);
    page.heading("Torque and windup");
    page.figure(
        &curves.windup().to_svg(),
        "Torque over windup. Vertical lines: junctions of the first law's curve.",
    );
    if laws.len() > 1 {
        page.figure(
            &curves.difference().to_svg(),
            "Windup of the other laws against that of the first, at the same torque.",
        );
    }
    page.heading("Stiffness");
    let caption =
        "Secant: torque over windup. Tangent: its slope, which jumps where the radius of curvature does.";
    match laws {
        [_] => {
            page.figure(&curves.stiffness().to_svg(), caption);
        }
        _ => {
            let stiff = Curves { laws, points: curves.loaded() };
            let secant = stiff.plot("Secant stiffness, Nm/rad", &|p| p.k_secant_nm_per_rad);
            let tangent = stiff.plot("Tangent stiffness, Nm/rad", &|p| p.k_tangent_nm_per_rad);
            page.figures(&[
                (parts::half(secant), "Torque over windup."),
                (parts::half(tangent), "Its slope."),
            ]);
        }
    }
    page.heading("Contacts");
    let mpa = |pa: f64| Unit::Megapascal.from_si(pa);
    let inner = curves.plot("Hertz pressure at A, MPa", &|p| mpa(p.hertz_inner_pa));
    let outer = curves.plot("Hertz pressure at B, MPa", &|p| mpa(p.hertz_outer_pa));
    let friction = design.clutch.friction.static_;
    let omega = curves.plot("tan ω, inner contact", &|p| p.tan_omega).level(friction, "μs");
    let nu = curves.plot("tan ν, outer contact", &|p| p.tan_nu);
    page.figures(&[
        (parts::half(inner), "Peak pressure on the inner race, radius taken at one point."),
        (parts::half(outer), "Peak pressure on the outer race."),
        (parts::half(omega), "Friction that the inner contact must give."),
        (parts::half(nu), "Friction that the outer contact must give."),
    ]);
    draw(&mut page, design, profile, laws, up_to);
    page.heading("Tables");
    if laws.len() > 1 {
        page.table("Windup; diff.: against the first law.", &windups(laws));
        page.table("Tangent stiffness.", &tangents(laws));
    }
    for law in laws {
        page.table(&format!("Law: {}", law.name.key()), &full(law));
    }
    answer.close(&mut page);
    page
}

/// First contact in full, the sprag at peak torque (or the largest of the table) dashed over it.
fn draw(page: &mut Page, design: &Design, profile: &Profile, laws: &[LawCurve], up_to_nm: f64) {
    let rest = parts::pose_at_rest("first contact, no load", design, profile);
    let torque = design.limits.peak_torque_nm.unwrap_or(up_to_nm);
    let loaded = laws.first().and_then(|l| parts::pose_at_torque(&rest, &l.curve, torque));
    parts::draw(page, &parts::drawing(design, [rest].into_iter().chain(loaded).collect()));
}

/// Points of every law for the plots.
struct Curves<'a> {
    laws: &'a [LawCurve],
    points: Vec<Vec<StaticPoint>>,
}

impl<'a> Curves<'a> {
    fn new(laws: &'a [LawCurve], up_to_nm: f64) -> Self {
        let of = |l: &LawCurve| parts::samples(&l.curve, up_to_nm).into_iter().map(|(p, _)| p).collect();
        Self { laws, points: laws.iter().map(of).collect() }
    }

    /// The points without the last of the way down to first contact, where stiffness falls to zero within a hair.
    fn loaded(&self) -> Vec<Vec<StaticPoint>> {
        let least = |points: &[StaticPoint]| 5e-3 * points.last().map_or(0.0, |p| p.torque_nm);
        let kept = |points: &Vec<StaticPoint>| {
            points.iter().filter(|p| p.torque_nm >= least(points)).copied().collect()
        };
        self.points.iter().map(kept).collect()
    }

    /// One quantity over torque, a curve per law, junctions of the first.
    fn plot(&self, title: &str, value: &dyn Fn(&StaticPoint) -> f64) -> Plot {
        let mut plot = Plot::new("Torque, Nm", title);
        for (law, points) in self.laws.iter().zip(&self.points) {
            plot = plot.curve(law.name.key(), points.iter().map(|p| [p.torque_nm, value(p)]).collect());
        }
        self.marked(plot, |j| j)
    }

    fn marked(&self, mut plot: Plot, place: impl Fn(f64) -> f64) -> Plot {
        for junction in self.laws.first().map(|l| parts::junctions(&l.curve)).unwrap_or_default() {
            plot = plot.marker(place(junction.torque_nm), &junction.label());
        }
        plot
    }

    fn windup(&self) -> Plot {
        let degrees = |p: &StaticPoint| Unit::Degree.from_si(p.windup_rad);
        let mut plot = Plot::new("Windup, deg", "Torque, Nm");
        for (law, points) in self.laws.iter().zip(&self.points) {
            let points = points.iter().map(|p| [degrees(p), p.torque_nm]);
            plot = plot.curve(law.name.key(), points.collect());
        }
        let first = self.laws.first().map(|l| &l.curve);
        self.marked(plot, |torque| first.and_then(|c| c.at_torque(torque)).map_or(f64::NAN, |p| degrees(&p)))
    }

    fn stiffness(&self) -> Plot {
        let mut plot = Plot::new("Torque, Nm", "Stiffness, Nm/rad");
        if let Some(points) = self.loaded().first() {
            plot = plot
                .curve("secant", points.iter().map(|p| [p.torque_nm, p.k_secant_nm_per_rad]).collect())
                .curve("tangent", points.iter().map(|p| [p.torque_nm, p.k_tangent_nm_per_rad]).collect());
        }
        self.marked(plot, |j| j)
    }

    /// Windup of each law over that of the first, less one, %; the first keeps its colour as the zero line.
    fn difference(&self) -> Plot {
        let Some(first) = self.laws.first() else { return Plot::new("", "") };
        let mut plot = Plot::new("Torque, Nm", &format!("Windup against {}, %", first.name.key()));
        for (law, points) in self.laws.iter().zip(self.loaded()) {
            let against = |p: &StaticPoint| {
                let reference = first.curve.at_torque(p.torque_nm)?;
                Some([p.torque_nm, Unit::Percent.from_si(p.windup_rad / reference.windup_rad - 1.0)])
            };
            plot = plot.curve(law.name.key(), points.iter().filter_map(against).collect());
        }
        self.marked(plot, |j| j)
    }
}
