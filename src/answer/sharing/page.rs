//! The page of sprags one by one.

use super::{SharingAnswer, largest};
use crate::answer::Said;
use crate::answer::page::half;
use crate::report::plot::Curve;
use crate::report::{Page, Plot, Unit};
use crate::sharing::Shared;

pub(super) fn draw(answer: &SharingAnswer<'_>, page: &mut Page) {
    page.figures(&[
        (
            half(answer.round()),
            "Normal force of each sprag over the mean, round the clutch, at parts of the torque.",
        ),
        (half(answer.rising()), "The largest and the smallest share as the torque rises."),
    ]);
    page.heading("Sprags")
        .table("At the place of the turn where the most pressed one is pressed most.", &answer.table());
    if answer.gaps_rad.len() > 1 {
        page.heading("Over a turn of the races").table("Azimuths from sprag 1.", &answer.places().table());
    }
    page.heading("Through an engagement").table("", &answer.course().table());
    if answer.pops.is_some() {
        page.heading("Beyond the end")
            .figure(
                &half(answer.turned_on()),
                "Torque as the races are turned on, round, held on one axis; below 0 the sprags drive them.",
            )
            .table(
                "Under the torque of the end one sprag after another goes over its highest place.",
                &answer.popped().table(),
            );
    }
    if !answer.losses.is_empty() {
        page.heading("One lost after another")
            .table("The most pressed sprag fails, the others take its share.", &answer.lost().table());
    }
    page.heading("Tracks out of round").table(
        "Amplitude of the radius in each harmonic; the mean opens the gap. The ovality, largest less smallest diameter, is four times \
         the second.",
        &answer.out_of_round(),
    );
}

impl SharingAnswer<'_> {
    /// Shares round the clutch.
    fn round(&self) -> Plot {
        let mut plot = Plot::new("Azimuth, °", "Share of the mean");
        let found: Vec<(f64, &Shared)> =
            self.engagement.iter().filter_map(|(t, s)| Some((*t, s.as_ref().ok()?))).collect();
        for part in [0.1, 0.3, 1.0] {
            let Some((torque, shared)) =
                found.iter().find(|(t, _)| *t >= part * self.torque_nm * (1.0 - 1e-9))
            else {
                continue;
            };
            let points = self
                .sprags
                .iter()
                .zip(shared.shares())
                .map(|(r, share)| [Unit::Degree.from_si(r.sprag.azimuth_rad), share]);
            plot.curves.push(Curve {
                dots: true,
                ..Curve::new(&Unit::NewtonMetre.show_plain(*torque, 4), points.collect())
            });
        }
        plot
    }

    /// Largest and smallest share over torque.
    fn rising(&self) -> Plot {
        let found = self.engagement.iter().filter_map(|(t, s)| Some((*t, s.as_ref().ok()?.shares())));
        let (mut most, mut least) = (Vec::new(), Vec::new());
        for (torque, shares) in found {
            most.push([torque, largest(&shares)]);
            least.push([torque, shares.iter().copied().fold(f64::INFINITY, f64::min)]);
        }
        Plot::new("Torque, Nm", "Share of the mean").curve("largest", most).curve("smallest", least)
    }
}
