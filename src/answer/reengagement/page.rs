//! The page of a slip under load: the blow, or its energy, over slip.

use super::{BLOW, ReengagementAnswer, WAY};
use crate::answer::Said;
use crate::reengage::Blow;
use crate::report::plot::{Curve, Dash};
use crate::report::{Page, Plot, Unit, significant};

pub(super) fn draw(answer: &ReengagementAnswer<'_>, page: &mut Page) {
    let points = |of: &dyn Fn(&Blow) -> Option<f64>| -> Vec<[f64; 2]> {
        answer.found.list.iter().filter_map(|b| Some([1e3 * b.path_m, of(b)?])).collect()
    };
    let mut plot = Plot::new("Slip until the friction is back, mm", "Torque, Nm");
    plot.log_x = true;
    let blow = points(&|b| Some(b.peak?.torque_nm));
    let energy = points(&|b| Some(answer.energy(b)?.0));
    // Where most blows have no torque, what they bring says by how much too much it is.
    let few = blow.len() < 3 && blow.len() < energy.len();
    let few = few.then(|| answer.energy_plot(energy)).flatten();
    let blow_is_empty = blow.is_empty();
    if !blow_is_empty {
        plot.curves.push(Curve::new("blow", blow));
    }
    let by_energy = points(&|b| b.by_energy_nm);
    let is_empty = blow_is_empty && by_energy.is_empty();
    if !by_energy.is_empty() {
        // Often beside the blow itself.
        plot.curves.push(Curve { dash: Dash::Dashed, ..Curve::new("by energy, nothing lost", by_energy) });
    }
    if let Some((most_nm, code)) = &answer.bears {
        plot.curves.push(Curve::new(&format!("allowed by {code}"), points(&|_| Some(*most_nm))));
    }
    if !answer.found.list.is_empty() {
        if let Some(energy) = few {
            page.figure(
                &energy.to_figure(),
                "Energy of the races against one another after each path of slip, and what the windup takes up: to its \
                 limits and to the end of the curve. Beyond that the blow has no torque to draw.",
            );
        } else {
            match is_empty {
                true => page.paragraph(
                    "No curve of the blow over slip: every one of them goes beyond what the clutch carries.",
                ),
                false => page.figure(&plot.to_figure(), "Largest torque when the clutch grips again."),
            };
        }
        page.table("The blow after each path of slip.", &answer.table().only(BLOW));
        page.table("The way to it.", &answer.table().only(WAY));
    }
    if !answer.over.is_empty() {
        page.heading("Over friction and inertia");
        let longest_m = answer.case.paths_m.last().copied().unwrap_or(0.0);
        let mut plot = Plot::new("Friction while it slips", "Blow, Nm");
        let mut inertias: Vec<f64> = answer.over.iter().map(|b| b.inner_inertia_kg_m2).collect();
        inertias.sort_by(f64::total_cmp);
        inertias.dedup();
        for inertia in inertias {
            let of = answer.over.iter().filter(|b| b.inner_inertia_kg_m2 == inertia && b.path_m == longest_m);
            let points: Vec<[f64; 2]> =
                of.filter_map(|b| Some([b.friction, b.blow.as_ref()?.peak?.torque_nm])).collect();
            if points.len() > 1 {
                plot.curves.push(Curve::new(&format!("{} kg m²", significant(inertia, 3)), points));
            }
        }
        if !plot.curves.is_empty() {
            let words = format!(
                "Blow after the longest path, {}; a curve ends where sprags are thrown out, where the blow is beyond what the \
                 clutch carries, and where nothing slips.",
                Unit::Millimetre.show(longest_m, 3)
            );
            page.figure(&plot.to_figure(), &words);
        }
        page.table("Each friction, inertia and path of slip.", &answer.blows_over().table());
    }
}

impl ReengagementAnswer<'_> {
    /// Energy over slip, `points` in mm and J, with what the windup takes up; `None`: that is not known, or there are too few points.
    fn energy_plot(&self, points: Vec<[f64; 2]>) -> Option<Plot> {
        let [most_j, end_j] = self.takes_up_j?;
        let mut plot = Plot::new("Slip until the friction is back, mm", "Energy, J");
        (plot.log_x, plot.log_y) = (true, true);
        if points.len() < 3 {
            return None;
        }
        plot.curves.push(Curve { dots: true, ..Curve::new("", points) });
        let limit = self.bears.as_ref().map_or("limits", |(_, code)| code);
        Some(plot.level(most_j, &format!("taken up to {limit}")).level(end_j, "to the end of the curve"))
    }
}
