//! The stiffness curves as a page.

use super::fem::{self, Distance, Fem, distance, findings};
use super::tables::{end_text, full, junction_text, tangents, windups};
use super::{LawCurve, StiffnessStudy, junctions};
use crate::answer::Answer;
use crate::answer::page::{begun, draw, draw_sheet, drawing, half, pose_at_rest, pose_at_torque};
use crate::answer::roll_over::sentence;
use crate::design::Design;
use crate::profile::Profile;
use crate::report::plot::{Curve, Dash};
use crate::report::{Column, Page, PageHead, Plot, Table, Tone, Unit};
use crate::wedge::{PLOTTED, StaticPoint};

/// The studies, one after another; `command`: who asked for them.
pub fn page(studies: &[StiffnessStudy], command: &str) -> Page {
    let Some(first) = studies.first() else { return Page::new(PageHead::default()) };
    let mut page = begun("Stiffness", &first.design, command);
    for study in studies {
        if studies.len() > 1 {
            page.heading(&study.design.name);
        }
        section(&mut page, study);
        study.envelope(study.run_time_s).close(&mut page);
    }
    page
}

fn section(page: &mut Page, study: &StiffnessStudy) {
    let (design, profile, laws) = (&study.design, &study.profile, study.laws());
    if let Some(first) = laws.first() {
        page.verdict_in(Tone::Plain, &banner(design, first));
    }
    draw_sheet(page, design, "");
    page.list(laws.iter().skip(1).map(|law| banner(design, law)));
    page.list(laws.iter().map(|l| {
        format!(
            "{}. Curve ends {}{}.",
            l.clutch.contact.description(&l.clutch.axial),
            end_text(l),
            junction_text(l)
        )
    }));
    let up_to = laws.iter().flat_map(|l| &l.rows).map(|r| r.0).fold(0.0, f64::max);
    let curves = Curves::new(laws, up_to);
    page.heading("Torque, windup, stiffness");
    let mut windup = curves.windup();
    if let Some(fem) = &study.fem {
        let points = fem.rows.iter().map(|r| [Unit::Degree.from_si(r.windup_rad), r.torque_nm]).collect();
        let fem = Curve::new("finite elements", points).coloured(laws.len());
        windup.curves.push(Curve { dots: true, ..fem });
    }
    let mut figures = vec![
        (half(windup), "Torque over windup. Vertical lines: junctions of the first law's curve."),
        (
            half(curves.structure()),
            "Local deformation alone (dashed) and with the growth of the rings (5) and the body (6): the paper's Figure 11.",
        ),
    ];
    figures.extend(match &study.fem {
        Some(fem) => Some((
            half(curves.against(fem)),
            "Windup of each law against finite elements, at their torques. Dashed: local deformation alone.",
        )),
        None => (laws.len() > 1).then(|| {
            (
                half(curves.difference()),
                "Windup of the other laws against that of the first, at the same torque.",
            )
        }),
    });
    if let [_] = laws {
        figures.push((
            half(curves.stiffness()),
            "Secant: torque over windup. Tangent: its slope, which jumps where the radius of curvature does.",
        ));
    } else {
        let stiff = Curves { laws, points: curves.loaded() };
        let secant = stiff.plot("Secant stiffness, Nm/rad", &|p| p.k_secant_nm_per_rad);
        let tangent = stiff.plot("Tangent stiffness, Nm/rad", &|p| p.k_tangent_nm_per_rad);
        figures.extend([(half(secant), "Torque over windup."), (half(tangent), "Its slope.")]);
    }
    page.figures(&figures);
    if let Some(fem) = &study.fem {
        page.list(findings(study, fem));
        page.table("Distance to finite elements; local only: without (5) and (6).", &fem::table(study, fem));
    }
    handovers(page, laws);
    beyond(page, laws);
    page.heading("Contacts");
    let mpa = |pa: f64| Unit::Megapascal.from_si(pa);
    let inner = curves.plot("Hertz pressure at A, MPa", &|p| mpa(p.hertz_inner_pa));
    let outer = curves.plot("Hertz pressure at B, MPa", &|p| mpa(p.hertz_outer_pa));
    let friction = design.clutch.friction.static_;
    let omega = curves.plot("tan ω, inner contact", &|p| p.tan_omega).level(friction, "μs");
    let nu = curves.plot("tan ν, outer contact", &|p| p.tan_nu);
    page.figures(&[
        (half(inner), "Peak pressure on the inner race, curvature averaged over the patch."),
        (half(outer), "Peak pressure on the outer race."),
        (half(omega), "Friction that the inner contact must give."),
        (half(nu), "Friction that the outer contact must give."),
    ]);
    if let Some(map) = &study.pressure {
        page.heading("Pressure along the length");
        page.figures(&map.figures());
        page.table("A sharp end has no pressure of its own.", &map.table());
    }
    poses(page, design, profile, laws, up_to);
    page.heading("Tables");
    let each = |page: &mut Page| {
        for law in laws {
            page.table(&format!("Law: {}", law.name.facts().key), &full(law));
        }
    };
    match laws {
        [_] => each(page),
        _ => {
            page.tables(&[
                ("Windup; diff.: against the first law.", windups(laws)),
                ("Tangent stiffness.", tangents(laws)),
            ]);
            page.apart("Every column of each law", each);
        }
    }
}

/// The way over the sprags' highest place.
fn beyond(page: &mut Page, laws: &[LawCurve]) {
    let ways = || laws.iter().enumerate().filter_map(|(i, law)| Some((i, law, law.beyond.as_ref()?)));
    if ways().next().is_none() {
        return;
    }
    page.heading("Beyond the end");
    let mut plot = Plot::new("Windup, deg", "Torque, Nm");
    for (i, law, way) in ways() {
        let points = way.branch.iter().map(|p| [Unit::Degree.from_si(p.windup_rad), p.torque_nm]);
        plot.curves.push(Curve::new(law.name.facts().key, points.collect()).coloured(i));
    }
    page.list(ways().map(|(_, law, way)| format!("{}: {}", law.name.facts().key, sentence(way))));
    page.apart("Torque over windup there", |page| {
        page.figure(
            &plot.to_figure(),
            "Equilibria from the end of the curve on: none of them stays under a torque that does. Below 0 the sprags drive the \
             races on. Material linear elastic; an edge gives as the arc before it.",
        );
    });
}

/// What the stiffness is, at the torques that the design is for, else at the largest of the table.
pub(super) fn banner(design: &Design, law: &LawCurve) -> String {
    let limits = &design.limits;
    let named = [(limits.nominal_torque_nm, "nominal"), (limits.peak_torque_nm, "peak")];
    let mut asked: Vec<(f64, &str)> = named.into_iter().filter_map(|(t, name)| Some((t?, name))).collect();
    if asked.is_empty() {
        asked.extend(law.rows.iter().map(|r| r.0).max_by(f64::total_cmp).map(|t| (t, "largest")));
    }
    let each: Vec<String> = asked
        .into_iter()
        .map(|(torque, name)| {
            let at = format!("{} ({name})", Unit::NewtonMetre.show_plain(torque, 5));
            let k = |k: f64| Unit::NewtonMetrePerRadian.show(k, 4);
            match law.curve.at_torque(torque) {
                Some(p) => format!(
                    "{at}: {} tangent, {} secant, windup {}",
                    k(p.k_tangent_nm_per_rad),
                    k(p.k_secant_nm_per_rad),
                    Unit::Degree.show(p.windup_rad, 4)
                ),
                None => format!("{at}: beyond the end of the curve"),
            }
        })
        .collect();
    format!("Stiffness, {}: at {}", law.name.facts().key, each.join("; at "))
}

/// What happens where one arc hands over to the next, on every law's curve.
fn handovers(page: &mut Page, laws: &[LawCurve]) {
    let mut table = Table::new(vec![
        Column::text("law", "Law"),
        Column::text("junction", "Junction"),
        Column::number("torque_nm", "Torque", Unit::NewtonMetre, 4),
        Column::number("k_before", "K tan before", Unit::NewtonMetrePerRadian, 5),
        Column::number("k_after", "after", Unit::NewtonMetrePerRadian, 5),
        Column::number("jump", "Jump", Unit::Percent, 3),
        Column::number("shift_rad", "Shift of α", Unit::Radian, 2),
        Column::number("p0_jump", "p₀ jumps", Unit::Percent, 2),
        Column::number("p0_pointwise_jump", "with the radius at one point", Unit::Percent, 2),
        Column::text("patch", "Patch at A lies on both arcs"),
    ]);
    let mut any = false;
    for law in laws {
        let curve = &law.curve;
        for (k, junction) in junctions(curve).iter().enumerate() {
            let n = curve.arc_end_n(k);
            let Some((before, after)) =
                curve.at_normal(n * (1.0 - 1e-9)).zip(curve.at_normal(n * (1.0 + 1e-9)))
            else {
                continue;
            };
            any = true;
            let (a, b) = (before.k_tangent_nm_per_rad, after.k_tangent_nm_per_rad);
            let newton = |n: f64| Unit::Newton.show_plain(n, 4);
            let patch = curve.straddles().into_iter().find(|s| s.junction == k).map_or_else(
                || "the law does not know the radius".to_owned(),
                |s| {
                    let until = s.until_n.map_or("the curve's end".to_owned(), newton);
                    format!("{} to {until} per sprag", newton(s.from_n))
                },
            );
            table.row(vec![
                law.name.facts().key.into(),
                junction.label().as_str().into(),
                junction.torque_nm.into(),
                a.into(),
                b.into(),
                (b / a - 1.0).into(),
                (curve.shift_rad(k + 1) - curve.shift_rad(k)).into(),
                (after.hertz_inner_pa / before.hertz_inner_pa - 1.0).into(),
                (after.hertz_inner_pointwise_pa / before.hertz_inner_pointwise_pa - 1.0).into(),
                patch.as_str().into(),
            ]);
        }
    }
    if any {
        page.table("Junctions: the tangent stiffness jumps there and nowhere else.", &table);
    }
}

/// First contact in full, the sprag at peak torque (or the largest of the table) dashed over it.
fn poses(page: &mut Page, design: &Design, profile: &Profile, laws: &[LawCurve], up_to_nm: f64) {
    let rest = pose_at_rest("first contact, no load", design, profile);
    let torque = design.limits.peak_torque_nm.unwrap_or(up_to_nm);
    let loaded = laws.first().and_then(|l| pose_at_torque(&rest, &l.curve, torque));
    draw(page, &drawing(design, [rest].into_iter().chain(loaded).collect()));
}

/// Points of every law for the plots.
struct Curves<'a> {
    laws: &'a [LawCurve],
    points: Vec<Vec<StaticPoint>>,
}

impl<'a> Curves<'a> {
    fn new(laws: &'a [LawCurve], up_to_nm: f64) -> Self {
        let of = |l: &LawCurve| l.curve.samples(up_to_nm, PLOTTED).into_iter().map(|(p, _)| p).collect();
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

    /// One quantity over torque, a curve per law in its colour of every plot, junctions of the first.
    fn plot(&self, title: &str, value: &dyn Fn(&StaticPoint) -> f64) -> Plot {
        let mut plot = Plot::new("Torque, Nm", title);
        for (law, points) in self.laws.iter().zip(&self.points) {
            plot = plot.curve(law.name.facts().key, points.iter().map(|p| [p.torque_nm, value(p)]).collect());
        }
        self.marked(plot, |j| j)
    }

    fn marked(&self, mut plot: Plot, place: impl Fn(f64) -> f64) -> Plot {
        for junction in self.laws.first().map(|l| junctions(&l.curve)).unwrap_or_default() {
            plot = plot.marker(place(junction.torque_nm), &junction.label());
        }
        plot
    }

    fn windup(&self) -> Plot {
        let degrees = |p: &StaticPoint| Unit::Degree.from_si(p.windup_rad);
        let mut plot = Plot::new("Windup, deg", "Torque, Nm");
        for (law, points) in self.laws.iter().zip(&self.points) {
            let points = points.iter().map(|p| [degrees(p), p.torque_nm]);
            plot = plot.curve(law.name.facts().key, points.collect());
        }
        let first = self.laws.first().map(|l| &l.curve);
        self.marked(plot, |torque| first.and_then(|c| c.at_torque(torque)).map_or(f64::NAN, |p| degrees(&p)))
    }

    /// Every law whole, and dashed with local deformation alone.
    fn structure(&self) -> Plot {
        let degrees = |p: &StaticPoint| Unit::Degree.from_si(p.windup_rad);
        let mut plot = Plot::new("Windup, deg", "Torque, Nm");
        for (k, (law, points)) in self.laws.iter().zip(&self.points).enumerate() {
            let whole = points.iter().map(|p| [degrees(p), p.torque_nm]).collect();
            plot.curves.push(Curve::new(law.name.facts().key, whole).coloured(k));
            let local = points.iter().filter_map(|p| law.local.at_torque(p.torque_nm));
            plot.curves.push(Curve {
                dash: Dash::Dashed,
                ..Curve::new(
                    &format!("{}, local", law.name.facts().key),
                    local.map(|p| [degrees(&p), p.torque_nm]).collect(),
                )
                .coloured(k)
            });
        }
        plot
    }

    /// Windup over that of finite elements, less one, %, whole and with local deformation alone.
    fn against(&self, fem: &Fem) -> Plot {
        let mut plot = Plot::new("Torque, Nm", "More windup than finite elements, %");
        for (k, law) in self.laws.iter().enumerate() {
            let points = |of: &dyn Fn(&Distance) -> Option<f64>| {
                let each = fem.rows.iter();
                each.filter_map(|r| Some([r.torque_nm, Unit::Percent.from_si(of(&distance(law, r))?)]))
                    .collect()
            };
            let key = law.name.facts().key;
            plot.curves.push(Curve { dots: true, ..Curve::new(key, points(&|d| d.windup)).coloured(k) });
            let local = Curve::new(&format!("{key}, local"), points(&|d| d.windup_local_only)).coloured(k);
            plot.curves.push(Curve { dots: true, dash: Dash::Dashed, ..local });
        }
        self.marked(plot, |j| j)
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
        let mut plot = Plot::new("Torque, Nm", &format!("More windup than {}, %", first.name.facts().key));
        for (law, points) in self.laws.iter().zip(self.loaded()) {
            let against = |p: &StaticPoint| {
                let reference = first.curve.at_torque(p.torque_nm)?;
                Some([p.torque_nm, Unit::Percent.from_si(p.windup_rad / reference.windup_rad - 1.0)])
            };
            plot = plot.curve(law.name.facts().key, points.iter().filter_map(against).collect());
        }
        self.marked(plot, |j| j)
    }
}
