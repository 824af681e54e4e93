//! What a blow rests on, and what follows from one that is not borne: its energy, what would be borne, and what to change.

use super::{BorneSlip, ReengagementAnswer};
use crate::answer::Said;
use crate::answer::inertia::{InertiaFrom, inertia_from};
use crate::report::plot::Curve;
use crate::report::{Plot, Unit, significant};

impl ReengagementAnswer<'_> {
    /// Energy over slip, `points` in mm and J, with what the windup takes up; `None`: that is not known, or there are too few points.
    pub(super) fn energy_plot(&self, points: Vec<[f64; 2]>) -> Option<Plot> {
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

    /// That the outer race turns alone, where nobody has said what turns with it: it is the lightest there can be, and sets speed and blow.
    pub(super) fn bare_ring(&self) -> Option<String> {
        let nobody = !self.outer_given && !self.case.outer_held;
        (nobody && inertia_from(self.design, "outer") == InertiaFrom::Ring).then(|| {
            format!(
                "The outer race turns as a bare ring, {} kg m²: the file names nothing that turns with it (races.outer_inertia_kg_m2), and this \
                 decides the answer; --outer-inertia says what does, --outer-held that it is held",
                significant(self.case.inertia_kg_m2[1], 4)
            )
        })
    }

    /// Which number to change, and towards where, after a blow that is not borne.
    pub(super) fn next_step(&self) -> Option<String> {
        if self.is_held() || self.found.holds.is_some() {
            return None;
        }
        let needs = Some(self.found.needs).filter(|mu| mu.is_finite())?;
        let lost = self.found.list.iter().find(|b| !self.bears_it(b));
        let energy = lost.and_then(|b| Some((b, self.energy(b)?.1.filter(|share| *share > 1.0)?)));
        let blow = energy.map_or(String::new(), |(b, share)| {
            format!(
                "; to bear {} of slip its windup must take up {} times as much: less torque (--torque), or a clutch for more (`size --peak`)",
                Unit::Millimetre.show(b.path_m, 3),
                significant(share, 3)
            )
        });
        Some(format!(
            "Next: keep it from slipping at all, with sprags that need less friction than {} (`optimize --objective slip-margin`){blow}",
            significant(needs, 3)
        ))
    }

    pub(super) fn borne_words(&self, borne: &BorneSlip) -> String {
        let path = |m: f64| Unit::Millimetre.show(m, 3);
        let friction = significant(self.case.friction, 3);
        let first = match borne.path_m {
            Some(m) => format!("At a friction of {friction} slip up to {} is borne", path(m)),
            None => format!("At a friction of {friction} no slip is borne, however short"),
        };
        let shortest = self.case.paths_m.first().map_or(String::new(), |m| path(*m));
        let then = match borne.friction {
            Some(mu) if mu > self.case.friction => {
                format!("; {shortest} is borne from a friction of {} on", significant(mu, 4))
            }
            Some(_) => String::new(),
            None => format!("; {shortest} is borne at none that slips"),
        };
        first + &then
    }
}
