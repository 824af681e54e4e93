//! What becomes of each sprag, in words: the verdict, remarks, what is left out.

use super::SharingSceneAnswer;
use crate::answer::Answer;
use crate::answer::drawn::drawn_words;
use crate::answer::left_out::{LeftOut, left_out_of_driven_cage, one_by_one};
use crate::clutch::Carrier;
use crate::dynamics::{Axes, StaysWith, Stop};
use crate::report::{Unit, significant};
use crate::scenario::Verdict;

impl SharingSceneAnswer<'_> {
    /// The answer in a sentence.
    pub(super) fn verdict_words(&self) -> String {
        let run = &self.found.run;
        let mut said = if self.held() { "HELD: " } else { "NOT HELD: " }.to_owned();
        if let Some(why) = self.given_up() {
            said += &format!("{why}; until then ");
        } else if run.stop != Stop::Finished {
            let at = run.at_group.and_then(|g| self.found.group.iter().position(|of| *of == Some(g)));
            let whose = at.map_or(String::new(), |i| format!(" of sprag {}", i + 1));
            said += &format!("{}{whose} at {}; ", run.stop.name(), Unit::Second.show(run.t_s, 4));
        }
        said += &match self.largest_share() {
            Some((i, share, t_s)) if share > 0.0 => format!(
                "the largest share is {} of the mean, sprag {} at {}",
                significant(share, 4),
                i + 1,
                Unit::Millisecond.show(t_s, 4)
            ),
            _ => "no sprag was loaded".to_owned(),
        };
        if let Some((i, needs)) = self.most(|c| c.tan[0].max(c.tan[1])).filter(|(_, needs)| *needs > 0.0) {
            said += &format!("; friction is used most by sprag {}, {}", i + 1, significant(needs, 3));
        }
        let order = self.catching();
        let at = |i: &usize| self.course(*i).and_then(|c| c.catches_s);
        if let [first, .., last] = order.as_slice()
            && let (Some(from), Some(until)) = (at(first), at(last))
            && until > from
        {
            said += &format!(
                "; {} of {} sprags catch, the first, {}, at {}, the last, {}, at {}",
                order.len(),
                self.found.sprags.len(),
                first + 1,
                Unit::Millisecond.show(from, 4),
                last + 1,
                Unit::Millisecond.show(until, 4)
            );
        }
        let late: Vec<String> = (0..self.found.sprags.len())
            .filter(|&i| self.course(i).is_some_and(|c| c.catches_s.is_none()))
            .map(|i| (i + 1).to_string())
            .collect();
        match late.as_slice() {
            [] => {}
            [one] => said += &format!("; sprag {one} never catches"),
            several => said += &format!("; sprags {} never catch", several.join(", ")),
        }
        if self.found.axes.is_some() {
            said += &format!(
                "; the bearings hold at most {}, at {}",
                Unit::Newton.show(run.bearing_max_n, 4),
                Unit::Millisecond.show(run.bearing_max_s, 4)
            );
        }
        said += &match self.first_slip() {
            Some((i, t_s)) => format!(
                "; once caught, {} slip{}, sprag {} first, at {}",
                self.slipping(),
                if self.slipping() == 1 { "s" } else { "" },
                i + 1,
                Unit::Millisecond.show(t_s, 4)
            ),
            None if self.holds() => "; none slips once it has caught".to_owned(),
            None => "; under load none slips once it has caught".to_owned(),
        };
        said += &self.lets_go_words();
        said += &self.over_words();
        said
    }

    /// Whether the races are held, as far as the run went.
    pub(super) fn holds(&self) -> bool {
        self.found.least().is_none_or(|(_, of)| of == Verdict::Sticks)
    }

    /// What the clutch does where it does not hold, in words.
    fn lets_go_words(&self) -> String {
        let Some((g, verdict)) = self.found.least().filter(|_| self.found.run.stop == Stop::Finished) else {
            return String::new();
        };
        let towards = |sense: &str| {
            let least = self.found.group.iter().position(|of| *of == Some(g)).map_or(0, |i| i + 1);
            let net = Unit::Micrometre.show(self.found.net_m(g).abs(), 3);
            format!("no sprag holds, and sprag {least} slips least, by {net} towards {sense}")
        };
        let asked = self.design.scenario(&self.scene).is_some_and(|scene| scene.lets_go() == Some(true));
        match verdict {
            Verdict::SlipsOverrunning => format!(
                "; the clutch overruns{}: {}",
                if asked { ", as its torque has it" } else { "" },
                towards("overrunning")
            ),
            Verdict::SlipsEngaging => format!("; {}", towards("engaging")),
            Verdict::Disengages => "; every sprag loses contact".to_owned(),
            Verdict::AtThreshold => {
                "; whether it holds is nearer than two runs agree, a smaller tolerance decides".to_owned()
            }
            Verdict::Sticks | Verdict::Overloaded => String::new(),
        }
    }

    /// What becomes of sprags that come to their end, in words.
    fn over_words(&self) -> String {
        let over = self.over();
        let Some((first, t_s)) = over.first() else { return String::new() };
        let carry = self.found.group.iter().flatten().count() - self.gone();
        let lost = self.course(*first).and_then(|c| c.gone_s);
        format!(
            "; {} beyond the end of the curve, sprag {} first, at {}{}; {} over the highest place and {} no more, {carry} remain",
            if over.len() == 1 { "one goes".to_owned() } else { format!("{} go", over.len()) },
            first + 1,
            Unit::Millisecond.show(*t_s, 4),
            lost.map_or(", and comes back or stays there".to_owned(), |t_s| format!(
                ", and loses contact at {}",
                Unit::Millisecond.show(t_s, 4)
            )),
            if self.gone() == 1 { "one is".to_owned() } else { format!("{} are", self.gone()) },
            if self.gone() == 1 { "bears" } else { "bear" },
        )
    }

    /// What is said of races that bend: what is left out of them, or all of it.
    fn bending_left_out(&self) -> LeftOut {
        let Some(bends) = &self.found.bends else {
            let cost = match self.found.shares_at_rest {
                [Some(bent), Some(round), _] if self.found.counts.len() > 1 => format!(
                    "at rest under {} the largest share is {} with it, {} without",
                    Unit::NewtonMetre.show(self.found.largest_nm, 4),
                    significant(bent, 4),
                    significant(round, 4)
                ),
                _ => "0: sprags alike bend nothing beside the law".to_owned(),
            };
            return LeftOut::new(
                "races that bend",
                "sprags that are alike and in their even places leave the races round; more unlike ones than are integrated do not, \
                 nor do two under a law of contact that is stiffer than the rings (contact.law = \"elastic\" has them)",
                &cost,
            );
        };
        let [inner, outer] = bends.lowest_mode_hz.map(|hz| Unit::Hertz.show(hz, 3));
        LeftOut::new(
            "inertia of the races that bend",
            &format!(
                "they bend as at rest: alone the inner race swings at {inner}, the outer at {outer}, the scene drives \
                 them at {}; what they recede is off by the square of that over the lowest, and so where sprags shock \
                 them within one such swing",
                Unit::Hertz.show(bends.scene_hz, 3)
            ),
            &format!("{} of what they bend", Unit::Percent.show(bends.left_out(), 2)),
        )
    }

    /// What an inner track that is not round as made does beside coming out; `None`: it is round.
    fn inner_track_leans(&self) -> Option<LeftOut> {
        let waves = self.design.sharing.as_ref()?.inner_track();
        let steepest_m = waves.map(|wave| wave.lobes as f64 * wave.amplitude_m).reduce(f64::max)?;
        let clutch = &self.design.clutch;
        Some(LeftOut::new(
            "the lean of an inner track out of round",
            "it turns with its race and comes out under the sprags as it passes them; where it rises it is not taken to lean",
            &format!(
                "at most {} of the friction that holds, {}, which counts where the sprags ask for most of that",
                Unit::Percent.show(steepest_m / clutch.races.inner_radius_m / clutch.friction.static_, 2),
                significant(clutch.friction.static_, 4)
            ),
        ))
    }

    /// Lobes of the outer track that sprags pass with a driven cage, or sliding; `None`: that track is round.
    fn outer_lobes_passed(&self) -> Option<LeftOut> {
        let waves =
            self.design.sharing.as_ref()?.tracks.iter().filter(|wave| wave.outer && wave.amplitude_m > 0.0);
        let shortest = waves.map(|wave| wave.lobes).max()?.max(1) as f64;
        let lobe_m = std::f64::consts::TAU * self.design.clutch.races.outer_radius_m / shortest;
        let path_m = self.found.run.courses.iter().map(|c| c.path_m[1]).fold(0.0, f64::max);
        Some(LeftOut::new(
            "lobes of the outer track that sprags pass",
            "each keeps under it what was there when torque began, however far it slides on that track, with a driven cage or without",
            &format!(
                "B slides by {} at most, the shortest lobe is {}",
                Unit::Millimetre.show(path_m, 3),
                Unit::Millimetre.show(lobe_m, 3)
            ),
        ))
    }

    /// What is left out of a driven cage, or all of it; `None`: there is none.
    fn cage_drives(&self) -> Option<LeftOut> {
        self.design.clutch.cage?;
        if let Some(spring_nm) = self.found.carried_spring_nm {
            return Some(left_out_of_driven_cage(
                spring_nm,
                ", which stand as between races that stay round;",
            ));
        }
        let stays = |i: &usize| self.course(*i).is_none_or(|c| c.open_s == 0.0 && c.path_m == [0.0; 2]);
        let moved = (0..self.found.sprags.len()).filter(|i| !stays(i)).count();
        let cost = match moved {
            0 => "nothing here: none slides or loses contact".to_owned(),
            n => format!("not known: {n} slide or lose contact here; `simulate` has the cage"),
        };
        Some(LeftOut::new(
            "the cage that carries the sprags in overrun",
            "between axes that lie apart or give way, and on an inner track out of round, they ride with the outer race in overrun; a scene \
             that begins so is refused",
            &cost,
        ))
    }

    pub(super) fn left_out(&self) -> Vec<LeftOut> {
        let mut instead = vec![
            self.bending_left_out(),
            LeftOut::new(
                "a sprag before it touches",
                "one that lacks something to touch is turned along without a force, and joins rolling",
                "its inertia, below 1e-4 of a race's",
            ),
        ];
        if self.found.axes.is_some() {
            let [windup_rad, reach_m] = self.found.off_centre;
            instead.push(LeftOut::new(
                "a contact that run-out brings over a junction",
                "a sprag in its own gap rolls by a polynomial of the place of the axis, on the arc that its load stands for",
                &format!(
                    "up to {} of windup with the axes {} apart",
                    Unit::Degree.show(windup_rad, 2),
                    Unit::Micrometre.show(reach_m, 3)
                ),
            ));
        }
        instead.extend(self.inner_track_leans());
        instead.extend(self.outer_lobes_passed());
        instead.extend(self.cage_drives());
        one_by_one(self.design, instead)
    }

    pub(super) fn remarks(&self) -> Vec<String> {
        let mut all = self.design.sharing.as_ref().map(drawn_words).unwrap_or_default();
        let run = &self.found.run;
        let kinds = self.found.counts.len();
        if kinds == 1 {
            all.push("Those that carry are alike: one is computed for all, as `simulate` does".to_owned());
        }
        let left = if run.through_j > 0.0 { run.residual_j.abs() / run.through_j } else { 0.0 };
        let error = self.found.error.map_or("no second run was finished".to_owned(), |[theta, normal]| {
            format!(
                "two runs differ by {} rad in θ and {} of the largest N",
                significant(theta, 2),
                significant(normal, 2)
            )
        });
        all.push(format!(
            "{kinds} {} computed, {} changes, {} steps; {error}; the energy balance leaves {} of what went through",
            if kinds == 1 { "kind of sprags is" } else { "kinds of sprags are" },
            run.events,
            run.counters.steps,
            significant(left, 2)
        ));
        all.extend(self.found.axes.as_ref().map(|axes| self.axes_words(axes)));
        if kinds > 1 {
            all.push(self.bending_words());
        }
        all
    }

    /// What bending does, and what of it is left out.
    fn bending_words(&self) -> String {
        let left = self.bending_left_out();
        match (&self.found.bends, self.found.shares_at_rest) {
            (Some(bends), [Some(bent), Some(round), _]) => format!(
                "The races bend: at rest under {} the largest share is {} with it, {} without; the lowest mode of a ring \
                 is {}, the scene's {}, which leaves out {}",
                Unit::NewtonMetre.show(self.found.largest_nm, 4),
                significant(bent, 4),
                significant(round, 4),
                Unit::Hertz.show(bends.lowest_mode_hz[0].min(bends.lowest_mode_hz[1]), 3),
                Unit::Hertz.show(bends.scene_hz, 3),
                left.cost
            ),
            _ => format!("Left out: {}; {}", left.term, left.cost),
        }
    }

    /// What the axes of the races do.
    fn axes_words(&self, axes: &Axes) -> String {
        let run = &self.found.run;
        let um = |m: f64| Unit::Micrometre.show(m, 3);
        let kg = |mass: f64| format!("{} kg", significant(mass, 3));
        let stays = match axes.stays_with {
            _ if axes.offset_m == 0.0 => String::new(),
            StaysWith::Space => {
                format!(", {} of it in space, past which the clutch turns", um(axes.offset_m))
            }
            StaysWith::Race(Carrier::InnerRace) => {
                format!(", {} of it with the inner race", um(axes.offset_m))
            }
            StaysWith::Race(Carrier::OuterRace) => {
                format!(", {} of it with the outer race", um(axes.offset_m))
            }
        };
        let held = match axes.bearing {
            None => "they are held".to_owned(),
            Some(b) if b.stiffness_n_per_m == 0.0 => {
                format!("nothing but the sprags holds {}", kg(b.mass_kg))
            }
            Some(b) => format!(
                "{} swing on the bearings at {}; without inertia they would be off by (f/f₀)² of what moves at f",
                kg(b.mass_kg),
                Unit::Hertz.show(b.frequency_hz(), 3)
            ),
        };
        let beyond = match self.found.off_centre[1] {
            reach_m if run.axis_max_m > reach_m * (1.0 + 1e-9) => {
                format!("; beyond {} the gaps are extrapolated", um(reach_m))
            }
            _ => String::new(),
        };
        format!("The axes lie up to {} apart{stays}; {held}{beyond}", um(run.axis_max_m))
    }
}
