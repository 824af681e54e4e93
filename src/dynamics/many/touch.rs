//! When a sprag that waits touches.

use super::rhs::Rhs;

impl Rhs<'_> {
    /// How much more than at the start the races must have wound up until group `g` touches, for where the axis is now, rad.
    pub(super) fn touches_later_rad(&self, g: usize, t: f64, y: &[f64]) -> f64 {
        self.moved_touch_rad(g, t, y) + self.bent_touch_rad(g, y)
    }

    /// What bent races are to that, rad.
    fn bent_touch_rad(&self, g: usize, y: &[f64]) -> f64 {
        let Some(alpha) = self.bent(y, |bent| bent.touch_rad(g)) else { return 0.0 };
        let curve = &self.groups[g].model.curve;
        let below = curve.first_contact_rad() - alpha;
        if below < 0.0 {
            return curve.windup_rad(alpha);
        }
        let p = curve.in_arc(0, alpha);
        -(p.rho_i + p.rho_e) * below
    }

    /// What the place of the axis is to that, rad.
    fn moved_touch_rad(&self, g: usize, t: f64, y: &[f64]) -> f64 {
        let (Some(axes), Some(at)) = (self.axes, &self.groups[g].off_centre) else { return 0.0 };
        let touch = self.groups[g].model.curve.first_contact_rad();
        let costs = |axis: [f64; 2], phi: f64, race: f64| {
            let turns = at.turns.at(0, touch, at.seen_m(axis, phi, race));
            turns[0].value + turns[1].value
        };
        let offset = axes.offset_m(t, [y[0], y[1]]);
        let shift = axes.shift(y, self.groups.len())[0];
        // It has been turned along with the outer race.
        costs([offset[0] + shift[0], offset[1] + shift[1]], y[1], y[0])
            - costs(axes.offset_m(0.0, [0.0; 2]), 0.0, 0.0)
    }
}
