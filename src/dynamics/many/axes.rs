//! Races whose axes do not meet: what a sprag rolls, and what pushes the axes.
//!
//! The axis of the inner race lies at D = o + s against that of the outer, in the frame of the mean speed: o the offset, which stays
//! with a race, or in space while the clutch turns (-Omega t here), s what the bearings give. A sprag at azimuth u = psi + phi sees it at
//! d = R(-u) D, and rolls as on its own curve with G(alpha, d) of [`crate::wedge::AxisTurns`] added:
//!
//!   w_A = v_A/OA = theta_bi' - phi' + rho_i alpha' + G_A'      w_B = v_B/OB = theta_be' - phi' - rho_e alpha' - G_B'
//!
//! rho those of the own curve. G' = G_a alpha' + grad G . d', and with J the quarter turn, chi' the rate at which o turns,
//!
//!   d' = R(-u) s' + chi' J o_u - phi' J d      (o_u = R(-u) o),
//!
//! so that w is linear in all rates: w = c . (theta_bi', theta_be', s') + w_0 - e phi' +- rho alpha', rho now with G_a. By virtual work the
//! forces T_bi OA and -T_be OB act on every coordinate with its coefficient in w_A and w_B: on alpha, phi and the races, and as the
//! sprags' push on the axis. U'(alpha) is that of the own curve. All energy is kept but for the work of what turns o in space.
//! Left out, with the body turned by d at one normal force (some 1e-3 rad a um): what that is to the sprag's own inertia, its spring and
//! the angles in the radial equation.
//!
//! An inner track out of round as made turns with its race: a sprag at u sees it at the azimuth u - theta_bi of the race, where it comes
//! out by w(u - theta_bi), as a round one does whose axis lies by w nearer. So d has w along the radius beside, d' w' (phi' - theta_bi'),
//! and what follows from that by the same virtual work; nothing turns by itself, so no work is added. Left out, as in statics: that
//! the track leans where it rises.
//!
//! The axis on bearings of stiffness k about o, m the mass that they hold (its centre where the bearings are), damped by c from the
//! housing: m (s'' + 2 Omega J s' - Omega^2 s) + c (s' + Omega J s) + k s = F. Why the mass is kept: quasi-statically s = F/k needs
//! constraint forces that follow from s itself, and is wrong by (f/f_0)^2, f_0 = sqrt(k/m)/2 pi; f_0 lies below the sprags' own
//! frequency in slip, which steps resolve anyhow.

use super::{EACH, HEAD, SpragGroup};
use crate::clutch::{Carrier, TrackWave};
use crate::dynamics::State;
use crate::dynamics::model::{Grip, Loose, Mode, Place};
use crate::wedge::{AxisTurn, AxisTurns, WedgePoint};
use nalgebra::{Matrix2, Vector2, Vector4};
use std::sync::Arc;

/// What of an axis is integrated: s and s'.
pub(super) const AXIS: usize = 4;

/// What an offset of the axes stays with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StaysWith {
    /// Space: the clutch turns against it at its mean speed.
    Space,
    /// A race.
    Race(Carrier),
}

/// Bearings of the axis of the inner race against that of the outer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisBearing {
    /// Mass that they hold, kg.
    pub mass_kg: f64,
    /// Radial stiffness, N/m.
    pub stiffness_n_per_m: f64,
    /// Radial damping from the housing, N s/m.
    pub damping_n_s_per_m: f64,
}

impl AxisBearing {
    /// Frequency at which the mass swings on them alone, Hz.
    pub fn frequency_hz(&self) -> f64 {
        (self.stiffness_n_per_m / self.mass_kg).sqrt() / std::f64::consts::TAU
    }
}

/// Axes that do not meet, or may give way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axes {
    /// How far they lie apart without a load, m.
    pub offset_m: f64,
    /// Azimuth of the widest gap from sprag 0 when both races stand at 0, rad.
    pub phase_rad: f64,
    /// What turns it.
    pub stays_with: StaysWith,
    /// `None`: held.
    pub bearing: Option<AxisBearing>,
    /// Mean speed, rad/s.
    pub speed_rad_s: f64,
}

/// Where a sprag stands between such axes.
#[derive(Debug, Clone)]
pub struct OffCentre {
    /// Its azimuth from sprag 0's even place at first contact, rad.
    pub azimuth_rad: f64,
    /// G of its curve.
    pub turns: Arc<AxisTurns>,
    /// The inner track where it is not round as made, from sprag 0 on when both races stand at 0.
    pub inner_track: Arc<[TrackWave]>,
}

impl OffCentre {
    /// By how much the inner track comes out under the sprag that has gone on by `phi_rad`, its race by `race_rad`, m, and the derivatives
    /// of that by the difference.
    fn out_m(&self, phi_rad: f64, race_rad: f64) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for wave in self.inner_track.iter() {
            let more = wave.larger_with_slopes_m(self.azimuth_rad + phi_rad - race_rad);
            for (sum, more) in sum.iter_mut().zip(more) {
                *sum += more;
            }
        }
        sum
    }

    /// The place of an axis at `axis_m` as that sprag sees it with its track, m.
    pub(super) fn seen_m(&self, axis_m: [f64; 2], phi_rad: f64, race_rad: f64) -> [f64; 2] {
        let [x, y] = rotated(axis_m, -(self.azimuth_rad + phi_rad));
        [x + self.out_m(phi_rad, race_rad)[0], y]
    }
}

/// The curve of a sprag where the axes lie, and how they move what it rolls.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sight {
    pub(super) point: WedgePoint,
    pub(super) axes: Option<SeenAxes>,
}

/// w_A and w_B but for alpha.
#[derive(Debug, Clone, Copy)]
pub(super) struct SeenAxes {
    /// By theta_bi', theta_be', s'.
    pub(super) races: [Vector4<f64>; 2],
    /// w_0, rad/s: what turns by itself.
    still: [f64; 2],
    /// By -phi'.
    pub(super) along: [f64; 2],
    turns: [AxisTurn; 2],
    /// d and o as the sprag sees them, and s', m and m/s.
    axis_m: [f64; 2],
    offset_m: [f64; 2],
    shift_m_s: [f64; 2],
    /// First and second derivative of what the inner track comes out by phi - theta_bi, m.
    out_m: [f64; 2],
    /// chi' by the rates of the races, and by itself, rad/s.
    turned_by: [f64; 3],
}

/// A quarter turn ahead.
fn quarter([x, y]: [f64; 2]) -> [f64; 2] {
    [-y, x]
}

pub(super) fn rotated([x, y]: [f64; 2], angle_rad: f64) -> [f64; 2] {
    let (s, c) = angle_rad.sin_cos();
    [x * c - y * s, x * s + y * c]
}

/// From here on, rad from first contact, G is that of its table between races that bend; below it goes straight on.
const STRAIGHT_RAD: f64 = 1e-5;

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

impl Axes {
    /// Angle by which o has turned, rad.
    pub(super) fn turned_rad(&self, t: f64, races_rad: [f64; 2]) -> f64 {
        match self.stays_with {
            StaysWith::Space => -self.speed_rad_s * t,
            StaysWith::Race(Carrier::InnerRace) => races_rad[0],
            StaysWith::Race(Carrier::OuterRace) => races_rad[1],
        }
    }

    /// o in the frame of the mean speed, m.
    pub(super) fn offset_m(&self, t: f64, races_rad: [f64; 2]) -> [f64; 2] {
        rotated([-self.offset_m, 0.0], self.phase_rad + self.turned_rad(t, races_rad))
    }

    /// chi' by theta_bi' and theta_be', and by itself, rad/s.
    fn turned_by(&self) -> [f64; 3] {
        match self.stays_with {
            StaysWith::Space => [0.0, 0.0, -self.speed_rad_s],
            StaysWith::Race(Carrier::InnerRace) => [1.0, 0.0, 0.0],
            StaysWith::Race(Carrier::OuterRace) => [0.0, 1.0, 0.0],
        }
    }

    /// s and s' in `y` of so many groups; held axes have none.
    pub(super) fn shift(&self, y: &[f64], groups: usize) -> [[f64; 2]; 2] {
        match self.bearing {
            Some(_) => {
                let at = HEAD + EACH * groups;
                [[y[at], y[at + 1]], [y[at + 2], y[at + 3]]]
            }
            None => [[0.0; 2]; 2],
        }
    }

    /// What is to the mass: inertia by x, force without the sprags, N, of s.
    pub(super) fn pulls_n(&self, [s, rate]: [[f64; 2]; 2]) -> [f64; 2] {
        let Some(b) = self.bearing else { return [0.0; 2] };
        let speed = self.speed_rad_s;
        let (turned, turning) = (quarter(s), quarter(rate));
        std::array::from_fn(|i| {
            b.mass_kg * (speed * speed * s[i] - 2.0 * speed * turning[i])
                - b.damping_n_s_per_m * (rate[i] + speed * turned[i])
                - b.stiffness_n_per_m * s[i]
        })
    }

    /// Energy of the axis, J, and the power of its damping, W.
    pub(super) fn energy_j(&self, [s, rate]: [[f64; 2]; 2]) -> (f64, f64) {
        let Some(b) = self.bearing else { return (0.0, 0.0) };
        let speed = self.speed_rad_s;
        let turned = quarter(s);
        let moving = [rate[0] + speed * turned[0], rate[1] + speed * turned[1]];
        let stored = b.stiffness_n_per_m - b.mass_kg * speed * speed;
        (
            0.5 * b.mass_kg * dot(rate, rate) + 0.5 * stored * dot(s, s),
            -b.damping_n_s_per_m * dot(moving, rate),
        )
    }
}

impl SpragGroup {
    /// The own curve at `place` and alpha of `own`.
    /// `more_n`: what bent races press it more than on that, N; `None`: they do not bend.
    #[allow(clippy::too_many_arguments)]
    pub(super) fn sight(
        &self,
        axes: Option<&Axes>,
        groups: usize,
        place: Place,
        t: f64,
        y: &[f64],
        own: &State,
        more_n: Option<f64>,
    ) -> Sight {
        let mut point = self.model.point(place, own[0]);
        if let Some(more_n) = more_n {
            point = self.between_bent(place, own[0], point, more_n);
        }
        let (Some(axes), Some(at)) = (axes, &self.off_centre) else { return Sight { point, axes: None } };
        let arc = match place {
            Place::Arc(k) => Some(k),
            _ => None,
        };
        let [shift, rate] = axes.shift(y, groups);
        let back = -(at.azimuth_rad + own[1]);
        let offset = axes.offset_m(t, [y[0], y[1]]);
        let offset_m = rotated(offset, back);
        let axis_m = rotated([offset[0] + shift[0], offset[1] + shift[1]], back);
        let curve = &self.model.curve;
        let from = curve.first_contact_rad() + STRAIGHT_RAD;
        // Between races that bend contact is lost and found away from first contact: what the axis turns a sprag by goes on with it, or
        // rates, and energy, would jump there. Between round ones an open sprag is where it would touch.
        let (arc, alpha) = match (arc, more_n) {
            (None, Some(_)) => (Some(curve.arc_at(own[0]).min(curve.arc_count() - 1)), own[0]),
            (None, None) => (None, curve.first_contact_rad()),
            (arc, _) => (arc, own[0]),
        };
        let [out, out_slope, out_bend] = at.out_m(own[1], y[0]);
        let seen_m = [axis_m[0] + out, axis_m[1]];
        let mut turns = match arc {
            Some(0) if more_n.is_some() && alpha < from => at.turns.straight_on(from, alpha, seen_m),
            _ => at.turns.at(arc.unwrap_or(0), alpha, seen_m),
        };
        if arc.is_none() {
            for g in &mut turns {
                g.first[0] = 0.0;
                for i in 0..3 {
                    (g.second[0][i], g.second[i][0]) = (0.0, 0.0);
                }
            }
        }
        let whole = point.rho_i + point.rho_e;
        point.rho_i += turns[0].first[0];
        point.rho_e += turns[1].first[0];
        point.rho_i_slope += turns[0].second[0][0];
        point.rho_e_slope += turns[1].second[0][0];
        point.windup += turns[0].value + turns[1].value;
        // U' stays.
        point.t_static *= whole / (point.rho_i + point.rho_e);
        let turned_by = axes.turned_by();
        let (turned_offset, turned_axis) = (quarter(offset_m), quarter(axis_m));
        let mut seen = SeenAxes {
            races: [Vector4::new(1.0, 0.0, 0.0, 0.0), Vector4::new(0.0, 1.0, 0.0, 0.0)],
            still: [0.0; 2],
            along: [1.0; 2],
            turns,
            axis_m,
            offset_m,
            shift_m_s: rotated(rate, back),
            out_m: [out_slope, out_bend],
            turned_by,
        };
        for (contact, sign) in [1.0, -1.0].into_iter().enumerate() {
            let slope = [turns[contact].first[1], turns[contact].first[2]];
            let turning = dot(slope, turned_offset);
            let push = rotated(slope, -back);
            let [by_inner, by_outer, alone] = turned_by.map(|by| by * turning);
            let by_track = slope[0] * out_slope;
            seen.races[contact] += Vector4::new(by_inner - by_track, by_outer, push[0], push[1]) * sign;
            seen.still[contact] = sign * alone;
            seen.along[contact] += sign * (dot(slope, turned_axis) - by_track);
        }
        Sight { point, axes: Some(seen) }
    }

    /// Rates as [`crate::dynamics::Model::rates`] has them, those of the races as the sprag sees them: w = race - phi' +- rho alpha'.
    pub(super) fn rates(
        &self,
        axes: Option<&Axes>,
        groups: usize,
        mode: &Mode,
        sight: &Sight,
        y: &[f64],
        own: &State,
    ) -> [f64; 4] {
        let (model, p) = (&self.model, &sight.point);
        let (Some(axes), Some(seen)) = (axes, &sight.axes) else { return model.rates(mode, p, own) };
        let [_, rate] = axes.shift(y, groups);
        let all = Vector4::new(y[2], y[3], rate[0], rate[1]);
        let [r_a, r_b] = [0, 1].map(|contact| seen.races[contact].dot(&all) + seen.still[contact]);
        let [e_a, e_b] = seen.along;
        let (mut da, mut dp) = (own[4], own[5]);
        match (mode.inner == Grip::Stick && mode.place != Place::Open, mode.outer == Grip::Stick) {
            (true, true) => {
                da = (e_a * r_b - e_b * r_a) / (p.rho_i * e_b + p.rho_e * e_a);
                dp = (r_a + p.rho_i * da) / e_a;
            }
            (true, false) => dp = (r_a + p.rho_i * da) / e_a,
            (false, true) => dp = (r_b - p.rho_e * da) / e_b,
            (false, false) => {}
        }
        [da, dp, r_a + (1.0 - e_a) * dp, r_b + (1.0 - e_b) * dp]
    }
}

impl SeenAxes {
    /// What w_A' and w_B' have without second rates and beside rho' alpha'^2 of the curve and G, rad/s^2; `rates` as
    /// of the sprag, `races` those of the races themselves.
    fn bent(&self, rates: &[f64; 4], races: [f64; 2]) -> [f64; 2] {
        let [da, dp, ..] = *rates;
        let turning = self.turned_by[0] * races[0] + self.turned_by[1] * races[1] + self.turned_by[2];
        let [shift, offset, axis] = [quarter(self.shift_m_s), quarter(self.offset_m), quarter(self.axis_m)];
        let mut moves: [f64; 2] =
            std::array::from_fn(|i| self.shift_m_s[i] + turning * offset[i] - dp * axis[i]);
        let moving = quarter(moves);
        let mut bends: [f64; 2] = std::array::from_fn(|i| {
            -dp * shift[i] - turning * (turning - dp) * self.offset_m[i] - dp * moving[i]
        });
        // Along the radius of the sprag, which turns with it.
        let passes = dp - races[0];
        moves[0] += self.out_m[0] * passes;
        bends[0] += self.out_m[1] * passes * passes;
        [1.0, -1.0].map(|sign| {
            let g = &self.turns[usize::from(sign < 0.0)];
            let mut sum = g.first[1] * bends[0] + g.first[2] * bends[1];
            for i in 0..2 {
                sum += 2.0 * da * g.second[0][1 + i] * moves[i];
                for j in 0..2 {
                    sum += g.second[1 + i][1 + j] * moves[i] * moves[j];
                }
            }
            sign * sum
        })
    }

    /// Both contacts: w' = races . x - along phi'' +- rho alpha'' + this, rad/s^2.
    fn curls(&self, p: &WedgePoint, rates: &[f64; 4], races: [f64; 2]) -> [f64; 2] {
        let [bent_a, bent_b] = self.bent(rates, races);
        [p.rho_i_slope * rates[0] * rates[0] + bent_a, -p.rho_e_slope * rates[0] * rates[0] + bent_b]
    }

    /// The rows of A T = b of contacts that hold, the races at rest.
    pub(super) fn roll(
        &self,
        mode: &Mode,
        p: &WedgePoint,
        rates: &[f64; 4],
        races: [f64; 2],
        of: &Loose,
        (a, b): (&mut Matrix2<f64>, &mut Vector2<f64>),
    ) {
        let curls = self.curls(p, rates, races);
        let holds = [mode.inner == Grip::Stick && mode.place != Place::Open, mode.outer == Grip::Stick];
        let rolls = [p.rho_i, -p.rho_e];
        for contact in (0..2).filter(|contact| holds[*contact]) {
            let row = |v: &Vector2<f64>| rolls[contact] * v[0] - self.along[contact] * v[1];
            (a[(contact, 0)], a[(contact, 1)]) = (row(&of.column_i), row(&of.column_e));
            b[contact] = -(row(&of.free) + curls[contact]);
        }
    }

    /// Accelerations of the races as the sprag sees them, so that w' is theirs - phi'' +- (rho alpha'' + rho' alpha'^2), rad/s^2.
    pub(super) fn races_rad_s2(
        &self,
        rates: &[f64; 4],
        races: [f64; 2],
        x: &Vector4<f64>,
        phi: f64,
    ) -> [f64; 2] {
        let bent = self.bent(rates, races);
        [0, 1].map(|contact| self.races[contact].dot(x) + (1.0 - self.along[contact]) * phi + bent[contact])
    }

    /// Power that what turns by itself takes, W: of contacts under `t_bi` OA and `t_be` OB, N m.
    pub(super) fn taken_w(&self, inner_nm: f64, outer_nm: f64) -> f64 {
        -(inner_nm * self.still[0] - outer_nm * self.still[1])
    }
}
