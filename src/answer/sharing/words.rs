//! What sprags one by one come to, in words: the verdict, and what is left out of them.

use super::{SharingAnswer, largest};
use crate::answer::Said;
use crate::answer::left_out::LeftOut;
use crate::clutch::Rim;
use crate::report::{Unit, significant};
use crate::sharing::{NotShared, Shared};

impl SharingAnswer<'_> {
    /// The answer in a sentence.
    pub(super) fn verdict_words(&self) -> String {
        let torque = Unit::NewtonMetre.show(self.torque_nm, 4);
        let turned = match &self.turned {
            Ok(turned) => turned,
            Err(why) => {
                let until = self.end.filter(|(nm, _)| *nm > 0.0).map_or(String::new(), |(nm, _)| {
                    format!("; {} is carried", Unit::NewtonMetre.show(nm, 4))
                });
                return format!(
                    "NOT HELD: {torque} is not carried: {}{until}{}",
                    why.words(),
                    self.over_words()
                );
            }
        };
        let word = if self.is_held() { "HELD" } else { "NOT HELD" };
        let share = turned.iter().map(|s| largest(&s.shares())).fold(0.0, f64::max);
        let least = turned.iter().map(Shared::carrying).min().unwrap_or(0);
        let mut said = format!(
            "{word}: at {torque} {least} of {} sprags carry, the largest share is {} of the mean",
            self.sprags.len(),
            significant(share, 4)
        );
        if let Some((i, pa)) = self.most_pressed() {
            said += &format!(", sprag {} at {}", i + 1, Unit::Megapascal.show(pa, 4));
            if let Some((most, _)) = self.allowed {
                said += &format!(" of {} allowed", Unit::Megapascal.show(most, 4));
            }
        }
        if let Some((i, needs)) = self.slipping() {
            said += &format!(
                "; sprag {} needs a friction of {} and has {}",
                i + 1,
                significant(needs, 3),
                significant(self.sprags[i].sprag.friction, 3)
            );
        }
        said += &self.losses_words();
        if let Some(peak_nm) = self.design.limits.peak_torque_nm.filter(|nm| *nm > self.torque_nm) {
            let peak = Unit::NewtonMetre.show(peak_nm, 4);
            said += &format!("; peak torque, {peak}, is not looked at here: `check` says of it what is held");
        }
        said
    }

    /// How many may fail, as the table of losses has it.
    fn losses_words(&self) -> String {
        let Some(last) = self.losses.last() else { return String::new() };
        let (after, then) = match self.losses.len() - 1 {
            0 => (String::new(), "if the most pressed one failed"),
            1 => (
                "; if the most pressed one failed, the others would still hold".to_owned(),
                "after a second one",
            ),
            many => (
                format!("; {many} may fail, each time the most pressed one, and the others still hold"),
                "after one more",
            ),
        };
        let end = match last.left {
            Ok(_) => match last.slips {
                Some(i) => format!("{then}, sprag {} would slip", i + 1),
                None => format!("{then}, the others would be pressed beyond that"),
            },
            Err(NotShared::NoBalance) => {
                format!("whether the others hold {then} is not known: no balance of their forces was found")
            }
            Err(why) => format!("{then}, the others would not carry it: {}", why.words()),
        };
        format!("{after}; {end}")
    }

    /// What is left out of sprags one by one.
    pub(super) fn instead(&self) -> Vec<LeftOut> {
        let clutch = &self.design.clutch;
        let tan = self.sprags.iter().map(|r| r.bears.tan_omega).fold(0.0, f64::max);
        let tracks = [clutch.races.inner_radius_m, clutch.races.outer_radius_m];
        let slope = self.out_of_round_m.iter().zip(tracks).map(|(race, radius)| {
            // Harmonics below that of the sprags; entry 1 is harmonic 2.
            let below =
                race.iter().enumerate().skip(1).take(clutch.sprags.count.saturating_sub(2).max(1) / 2);
            below.map(|(k, a)| (k + 1) as f64 * a / radius).fold(0.0, f64::max)
        });
        let as_made = self.design.sharing.iter().flat_map(|sharing| &sharing.tracks);
        let as_made = as_made.map(|t| t.lobes as f64 * t.amplitude_m / tracks[usize::from(t.outer)]);
        let slope = slope.chain(as_made).fold(0.0, f64::max);
        vec![
            LeftOut::new(
                "slope of a bent track in the wedge angle",
                "a track that bends or is out of round is taken to recede and to give along itself, not to lean",
                &if tan > 0.0 {
                    format!("up to {} of tan ω of a sprag", Unit::Percent.show(slope / tan, 2))
                } else {
                    "not estimated".to_owned()
                },
            ),
            LeftOut::new(
                "what holds the races",
                match [clutch.races.inner_rim, clutch.races.outer_rim].contains(&Rim::Held) {
                    false => {
                        "rings are free but for the shift of their axes: no housing, hub or flange stiffens them, and \
                         their first harmonic is the shift"
                    }
                    true => {
                        "a rim that the design holds does not yield at all, a free one is stiffened by nothing, and the \
                         first harmonic of every ring is the shift of its axis"
                    }
                },
                "not estimated; a housing round a thin race keeps it round: give its wall to the race",
            ),
            LeftOut::new(
                "rolling on between unlike tracks",
                "of the windup that a sprag's own deviation costs, what bodies yield meanwhile is that of sprags alike",
                "the deviation over the radius, some 1e-4 of the windup",
            ),
            LeftOut::new("tilted tracks", "tracks have parallel axes", "not estimated"),
            LeftOut::new(
                "inertia of the sprags that catch",
                "the torque rises slowly",
                "not estimated: races do not wait for a late sprag",
            ),
        ]
    }
}
