//! The comparison as a page.

use super::{Comparison, farthest, label, letter, proud, tables};
use crate::answer::page::{begun, draw_sheet, half};
use crate::answer::{Answer, Provenance};
use crate::compare::Subject;
use crate::report::{Curve, Dash, Drawing, Page, Plot, SpragPose, Tone, Unit};
use crate::wedge::{PLOTTED, StaticPoint};

/// The page.
pub(super) fn page(compared: &Comparison<'_>, provenance: &Provenance) -> Page {
    let mut page = begun("Comparison", compared.first, &provenance.command);
    let tone = match (
        compared.subjects.last().is_some_and(Subject::held),
        compared.subjects.iter().all(Subject::held),
    ) {
        (true, true) => Tone::Good,
        (true, false) => Tone::Soft,
        (false, _) => Tone::Bad,
    };
    page.verdict_in(tone, &compared.verdict());
    if let [before, now, ..] = compared.subjects {
        // One drawing stands for designs of the same races.
        if !alike(before, now) {
            draw_sheet(&mut page, &before.design, &format!("Drawing of {}", label(compared, 0)));
        }
        draw_sheet(&mut page, &now.design, &format!("Drawing of {}", label(compared, 1)));
    }
    page.table("", &tables::designs(compared));
    page.heading("What differs");
    match compared.inputs.as_slice() {
        [] => page.paragraph("No input differs."),
        _ => page.table("Values as the files have them.", &tables::inputs(compared)),
    };
    page.heading("Curves");
    page.figures(&[
        (
            half(curves(compared, "Windup, deg", "Torque, Nm", &|p| {
                [Unit::Degree.from_si(p.windup_rad), p.torque_nm]
            })),
            "Torque against windup; the design before is dashed in every picture.",
        ),
        (half(tangents(compared)), "Friction that the inner contact must give."),
        (
            half(curves(compared, "Torque, Nm", "Tangent stiffness, Nm/rad", &|p| {
                [p.torque_nm, p.k_tangent_nm_per_rad]
            })),
            "Slope of torque over windup.",
        ),
        (
            half(curves(compared, "Torque, Nm", "Hertz pressure at A, MPa", &|p| {
                [p.torque_nm, Unit::Megapascal.from_si(p.hertz_inner_pa)]
            })),
            "Peak pressure on the inner race.",
        ),
    ]);
    profiles(&mut page, compared);
    page.heading("Margins");
    page.table("Margin of each limit; held from 0 up.", &tables::margins(compared));
    page.heading("Figures").table("", &tables::figures(compared));
    if !compared.scenes.is_empty() {
        page.heading("Scenes").table(
            "Friction from which on each scene sticks, and its margin against the static friction of the scene.",
            &tables::scenes(compared),
        );
    }
    compared.envelope(provenance.run_time_s).close(&mut page);
    for (i, s) in compared.subjects.iter().enumerate().skip(1) {
        let (name, hash) = (&s.design.name, &s.design.hash);
        page.source(&format!("Design file {}: {name}, hash {hash}", label(compared, i)), &s.design.source);
    }
    page
}

/// Whether two designs have the same races as run.
fn alike(a: &Subject, b: &Subject) -> bool {
    let races = |s: &Subject| Drawing::of(&s.design.clutch, Vec::new()).race_radii_m;
    races(a) == races(b)
}

/// Outlines over one another, the second in full, and by how much the profiles differ.
fn profiles(page: &mut Page, compared: &Comparison<'_>) {
    let pose = |(i, s): (usize, &Subject)| {
        SpragPose::at_rest(&label(compared, i), &s.design.clutch, &s.state.profile)
    };
    let mut poses: Vec<SpragPose> = compared.subjects.iter().enumerate().map(pose).collect();
    let Some(now) = compared.subjects.get(1) else { return };
    poses.swap(0, 1);
    let other = compared.subjects.iter().any(|s| !alike(s, now));
    let words = match other {
        true => {
            "The sprag of B between its races, to scale, and the others dashed over it at the same scale, laid so that \
             all touch the inner race of B at the same point, A, in the same direction; their own races are of other \
             radii. Dimensions are those of B."
        }
        false => {
            "The sprag of B between its races, to scale, and the others dashed over it; dimensions are those of B."
        }
    };
    if let Some((first, others)) = poses.split_first_mut().filter(|_| other) {
        others.iter_mut().for_each(|pose| pose.lay_at_contact_of(first));
    }
    page.heading("Profiles");
    page.figure(&Drawing::of(&now.design.clutch, poses).detail_figure(), words);
    let mut plot = Plot::new("Turn of the contact since first contact, rad", "Outside the profile of A, µm");
    let mut apart = Vec::new();
    for (i, points) in proud(compared.subjects).enumerate() {
        apart.extend(farthest(&points).map(|words| format!("A and {}: {words}", letter(i + 1))));
        let points = points.into_iter().map(|[t, h]| [t, Unit::Micrometre.from_si(h)]).collect();
        plot.curves.push(Curve::new(&label(compared, i + 1), points).coloured(if i == 0 {
            0
        } else {
            i + 1
        }));
    }
    if apart.is_empty() {
        page.paragraph("The inner profiles are the same.");
        return;
    }
    page.figure(
        &plot.sized(720.0, 280.0).to_figure(),
        &format!("The difference of the inner profiles, magnified: {}.", apart.join("; ")),
    );
}

/// One curve of each design: the first dashed, the second in the first colour.
fn curves(compared: &Comparison<'_>, x: &str, y: &str, point: &dyn Fn(&StaticPoint) -> [f64; 2]) -> Plot {
    let mut plot = Plot::new(x, y);
    let asked = |s: &Subject| s.design.limits.largest_torque_nm();
    let up_to = compared.subjects.iter().filter_map(asked).fold(0.0, f64::max);
    let up_to = if up_to > 0.0 { 1.5 * up_to } else { f64::INFINITY };
    for (i, s) in compared.subjects.iter().enumerate() {
        let samples = s.state.curve.samples(up_to, PLOTTED);
        let points = samples.iter().map(|(p, _)| point(p)).collect();
        let curve = Curve::new(&label(compared, i), points);
        plot.curves.push(match i {
            0 => Curve { dash: Dash::Dashed, ..curve.coloured(1) },
            1 => curve.coloured(0),
            i => curve.coloured(i),
        });
    }
    plot
}

fn tangents(compared: &Comparison<'_>) -> Plot {
    let plot = curves(compared, "Torque, Nm", "tan ω, inner contact", &|p| [p.torque_nm, p.tan_omega]);
    let mut levels: Vec<f64> = compared.subjects.iter().map(|s| s.design.clutch.friction.static_).collect();
    levels.dedup();
    levels.into_iter().fold(plot, |plot, mu| plot.level(mu, "μs"))
}
