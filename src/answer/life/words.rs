//! What a life comes to, in words: the verdict, what is not known, what it rests on.

use super::{LifeAnswer, LifeKnown};
use crate::life::{INDENTING_PA, LifePlace, Used};
use crate::report::{Unit, significant};

impl LifeAnswer<'_> {
    /// What wear comes to, in a sentence.
    fn wear_remark(&self) -> Option<String> {
        let worn = self.worn.as_ref()?;
        let ends = match worn.broken() {
            Some((share, why)) => format!(
                "after {} h of overrun ({} lives) {}",
                significant(share * worn.hours, 3),
                significant(share, 3),
                why.names().1
            ),
            None => "no limit is broken within a hundred lives".to_owned(),
        };
        Some(format!(
            "Wear: {ends} (Archard; the coefficients of [lubrication] are known to a power of ten at best)"
        ))
    }

    /// What no strength is given for, and the key that would give it.
    pub(super) fn not_known(&self) -> Vec<String> {
        let any = |place: LifePlace| self.life.not_known().any(|unknown| unknown == place);
        let strength = "{ amplitude_mpa = ..., cycles = ..., exponent = ..., ultimate_mpa = ... }";
        let mut all = Vec::new();
        if any(LifePlace::SpragInside) {
            all.push(
                "pitting of sprags and races (add pitting = { pressure_mpa = ..., cycles = ... } to [life])"
                    .to_owned(),
            );
        }
        if any(LifePlace::InnerRing) {
            all.push(format!("fatigue of the races as rings (add rings = {strength} to [life])"));
        }
        if any(LifePlace::SpragBody) {
            all.push(format!("{} (add sprags = {strength} to [life])", LifePlace::SpragBody.names().1));
        }
        if let Some(expected) = self.life.slips.filter(|_| self.life.slips_allowed.is_none()) {
            let expected = significant(expected, 2);
            all.push(format!("how many of the {expected} slips expected by chance may be (add slips_allowed = ... to [life])"));
        }
        all
    }

    /// The answer in a sentence.
    pub(super) fn verdict_words(&self) -> String {
        let life = &self.life;
        let not_carried: Vec<String> = life
            .loads
            .iter()
            .filter(|l| l.state.is_none())
            .map(|l| Unit::NewtonMetre.show(l.torque_nm, 4))
            .collect();
        if !not_carried.is_empty() {
            return format!("NOT HELD: the clutch does not carry {}", not_carried.join(", "));
        }
        // What fails in the first engagement at its torque comes before what takes time.
        if let Some(load) = life.slipping() {
            return format!(
                "NOT HELD: it slips at {}: that needs a friction of {}, and {} is there in the mean",
                Unit::NewtonMetre.show(load.torque_nm, 4),
                significant(load.required_friction.unwrap_or(f64::INFINITY), 4),
                significant(life.friction, 4)
            );
        }
        let indents = life.indents().then(|| {
            format!(
                "{} indents a contact in its first engagement",
                Unit::NewtonMetre.show(life.largest_nm, 4)
            )
        });
        let first = indents.iter().map(|words| format!("{words}; ")).collect::<String>();
        if let Some((share, why)) = self.worn_out() {
            return format!(
                "NOT HELD: {first}after {} of the life {}",
                Unit::Percent.show(share, 3),
                why.names().1
            );
        }
        let else_held = !life.slips_too_often() && !life.used.iter().any(Used::is_up);
        if let Some((place, sum)) = self.pitted().filter(|_| else_held) {
            return format!(
                "NOT HELD: {first}as the clutch wears, {} uses up {} of its life",
                place.names().1,
                Unit::Percent.show(sum, 3)
            );
        }
        let mut said = Vec::new();
        if let Some((expected, allowed)) =
            life.slips.zip(life.slips_allowed).filter(|_| life.slips_too_often())
        {
            let (expected, allowed) = (significant(expected, 2), significant(allowed, 2));
            said.push(format!("{expected} slips by chance are expected in the life, {allowed} are allowed"));
        }
        if let Some(used) = life.decides() {
            let used_up = format!(
                "{}{}, {} of its life used up, most of it at {}",
                used.place.names().1,
                if life.indents() { "" } else { " decides" },
                Unit::Percent.show(used.sum.unwrap_or(0.0), 3),
                Unit::NewtonMetre.show(used.mostly_nm, 4)
            );
            // What fails comes first.
            let at = if used.is_up() { 0 } else { said.len() };
            said.insert(at, used_up);
        }
        said.splice(0..0, indents);
        let unknown = self.not_known();
        let word = match self.known() {
            LifeKnown::NotHeld => "NOT HELD: ",
            LifeKnown::Held => "HELD: ",
            LifeKnown::HeldInPart => "HELD as far as is known: ",
            LifeKnown::Nothing => "NOT KNOWN: no strength is given, so no life",
        };
        let mut all = format!("{word}{}", said.join("; "));
        if !unknown.is_empty() {
            all += &format!("; not known: {}", unknown.join(", "));
        }
        all
    }

    /// What the tables do not say, a sentence each.
    pub(super) fn remark_words(&self) -> Vec<String> {
        let life = &self.life;
        let [inner, outer] = life.indentation;
        let mut all = Vec::new();
        if inner > 0.0 {
            let pressure = Unit::Megapascal.show(INDENTING_PA, 4);
            let says = |place: &str, factor: f64| match factor >= 1.0 {
                true => format!("{place} bears {} times its load until it indents", significant(factor, 3)),
                false => {
                    format!("{place} is indented: it bears {} of its load", Unit::Percent.show(factor, 3))
                }
            };
            all.push(format!(
                "At {} the {}, the {} ({pressure}, a permanent 1e-4 of the diameter: ISO 76, line contacts, 58 HRC or more)",
                Unit::NewtonMetre.show(life.largest_nm, 4),
                says("inner contact", inner),
                says("outer contact", outer)
            ));
        }
        if let Some(slips) = life.slips {
            all.push(format!(
                "Slip by chance: {} slips are expected in {} engagements{} (μs {} ± {}, torques ± {}; lognormal, independent)",
                significant(slips, 2),
                significant(life.engagements, 4),
                life.slips_allowed.map_or(String::new(), |most| format!(", {} are allowed", significant(most, 2))),
                significant(self.design.clutch.friction.static_, 4),
                Unit::Percent.show(self.service.friction_scatter, 3),
                Unit::Percent.show(self.service.torque_scatter, 3)
            ));
        }
        if let Some(p) = &self.service.pitting {
            all.push(format!(
                "Pitting: {} cycles at {}, exponent {} of the pressure; places of a track are met {}",
                significant(p.cycles, 4),
                Unit::Megapascal.show(p.pressure_pa, 4),
                significant(p.exponent, 4),
                if self.service.same_places {
                    "in every engagement"
                } else {
                    "where a sprag happens to stand"
                }
            ));
        }
        if let Some(c) = &self.service.core {
            all.push(format!(
                "Core below the case, {} deep: {} cycles at a shear of {}, exponent {}, as drawn",
                Unit::Millimetre.show(c.depth_m, 3),
                significant(c.cycles, 4),
                Unit::Megapascal.show(c.shear_pa, 4),
                significant(c.exponent, 4)
            ));
        }
        all.extend(self.wear_remark());
        for s in &self.swung {
            all.push(format!(
                "{}: {} h at {} are {} engagements at {}, its peak as the clutch carries it (peaks above half of the \
                 largest: Tsubakimoto); the rings swing up from {}",
                s.scenario,
                significant(s.duration_s / 3600.0, 4),
                Unit::Hertz.show(s.frequency_hz, 4),
                significant(s.load.engagements, 4),
                Unit::NewtonMetre.show(s.load.torque_nm, 4),
                Unit::NewtonMetre.show(s.load.from_nm, 4),
            ));
        }
        if let Some((peak_nm, indents)) = life.peak_beyond {
            let word = if indents { ", which would indent a contact" } else { "" };
            all.push(format!(
                "Not counted: peak torque, {} by [limits]{word}: {{ torque_nm = {peak_nm:?}, engagements = ... }} among \
                 the loads of [life] counts it",
                Unit::NewtonMetre.show(peak_nm, 4)
            ));
        }
        let not_counted: Vec<&str> = self.not_counted().collect();
        if let Some(first) = not_counted.first() {
            all.push(format!(
                "Not counted: {}, which would be an engagement in each period: swings = [{{ scenario = \"{first}\", hours \
                 = ... }}] in [life] counts it, or a history",
                not_counted.join(", ")
            ));
        }
        for history in &self.service.histories {
            all.push(format!(
                "{}: peaks above half of the largest (Tsubakimoto) and what rises from below half of its own peak are an \
                 engagement each, rings by rainflow (ASTM E1049), in hundredths of the largest torque, rounded up; it \
                 begins and ends at rest",
                history.name
            ));
        }
        all
    }
}
