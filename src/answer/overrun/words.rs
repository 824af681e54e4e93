//! What the tables of an overrun do not say.

use super::{LeftOut, OverrunAnswer, OverrunLine, RunningRace};
use crate::answer::check::overrun::passing_words;
use crate::dynamics::CageFacts;
use crate::lubrication::{Film, Walther};
use crate::report::{Tone, Unit, significant};

/// Part by which lift-off may come later from which on that is said.
pub(in crate::answer) const SHOWN_LATER: f64 = 0.005;

/// What overrun on a film leaves out.
pub(super) fn left_out(answer: &OverrunAnswer<'_>) -> Vec<LeftOut> {
    let new = LeftOut::new;
    let mut all = match answer.slides_outside() {
        true => vec![
            new(
                "force along the track at the inner contact of sprags in a driven cage",
                "the cage takes them along, as fast as the race",
                "at most static friction times the normal force at A, none once that has ended",
            ),
            clearance(answer),
        ],
        false => vec![riding_inside(answer), turning_on_film(answer)],
    };
    all.extend([
        new(
            "starvation",
            "inlets are full of oil",
            "a starved or greased track has a film of a third to nearly none: look at the figures of a higher temperature",
        ),
        new(
            "drag beside the contacts",
            "churning, cage, seals and bearings have no model",
            "often more than the contacts' drag at high speed; measure it",
        ),
        new(
            "constants of oil, asperities and wear",
            "alpha by Gold and the asperities' share by Olver and Spikes are typical; Archard's k is the file's",
            "film 10 %, friction in mixed lubrication 30 %, wear a factor of ten",
        ),
        new(
            "film in engagement",
            "torsional, engaging and transient scenes keep the friction law (12)",
            "the film must be squeezed out first: some microseconds to a millisecond more of slip",
        ),
    ]);
    all
}

/// Where the pivot of a driven cage lies when the sprag presses on both races.
fn clearance(answer: &OverrunAnswer<'_>) -> LeftOut {
    let state = &answer.state;
    let facts = CageFacts::of(&answer.design.clutch, &state.curve, state.alpha_max_rad);
    let later = facts.map_or(0.0, |facts| 1e-6 * facts.lift_off_higher_per_m);
    LeftOut::new(
        "tolerance of the clearance outside the pivot of a driven cage",
        "the pivot may go outward by cage.clearance_um from where it is when the sprag touches both races, and the sprag then tilts open; a film \
         at the outer contact is part of that",
        &format!("each further µm: lift-off without oil {} later", Unit::Percent.show(later, 2)),
    )
}

/// A film at A keeps the bodies apart, which turns the sprag open about C_e by h/(OC_e sin beta).
fn turning_on_film(answer: &OverrunAnswer<'_>) -> LeftOut {
    let c = answer.state.curve.touch();
    let closing = answer.state.alpha_max_rad - c.alpha.v;
    let gaps = answer.lines.iter().filter_map(|l| Some(l.point.lubricated?.film.film.least_m()));
    let tilt = gaps.fold(0.0, f64::max) / (c.lengths.oc_e.v * c.beta.v.sin());
    LeftOut::new(
        "turning of the sprags by the film's own thickness",
        "sprags stand as at first contact without one",
        &if closing > 0.0 {
            format!(
                "the thickest film above turns them open by {}, and the spring presses {} harder",
                Unit::Degree.show(tilt, 2),
                Unit::Percent.show(tilt / closing, 2)
            )
        } else {
            "none: no spring".to_owned()
        },
    )
}

/// Sprags that ride with the inner race and slide on the outer one. All normal forces and the centrifugal force go through the axis,
/// so that T_A OA = T_B OB: sliding at B with mu, a sprag is carried along at A where T_A/N_A = mu OB/OA N_B/N_A is no more than the static
/// friction, with N_B = N_A to a percent.
fn riding_inside(answer: &OverrunAnswer<'_>) -> LeftOut {
    let clutch = &answer.design.clutch;
    let times = clutch.races.outer_radius_m / clutch.races.inner_radius_m;
    let frictions =
        answer.lines.iter().filter(|l| l.point.state.normal_inner_n > 0.0).map(|l| l.point.friction);
    let least = frictions.fold(f64::INFINITY, f64::min);
    let (needs, there) = (times * least, clutch.friction.static_);
    let cost = match (least.is_finite(), needs <= there) {
        (false, _) => "none: no speed at which they touch".to_owned(),
        (true, true) => format!(
            "possible: sliding outside at the least μ above, {}, they need {} inside, and {} is there; which race they follow is then \
             left to how the overrun began, and the centrifugal force is that of the inner race's speed",
            significant(least, 3),
            significant(needs, 3),
            significant(there, 3)
        ),
        (true, false) => format!(
            "none: sliding outside at the least μ above, {}, they would need {} inside, and {} is there",
            significant(least, 3),
            significant(needs, 3),
            significant(there, 3)
        ),
    };
    LeftOut::new(
        "sprags that ride with the inner race",
        &format!(
            "all ride with the outer race, which asks of B 1/{} of the friction that A slides with; to ride with the inner one, A is asked for \
             {} times that of a sliding B",
            significant(times, 3),
            significant(times, 3)
        ),
        &cost,
    )
}

fn place(l: &OverrunLine) -> String {
    format!("{} °C, {}", significant(l.oil_c, 3), Unit::Rpm.show(l.speed_rad_s, 4))
}

/// Growth of the swing, 1/s, where it grows.
fn growth(l: &OverrunLine) -> Option<f64> {
    l.point.swing.filter(|s| s.grows()).map(|s| s.growth_rate_per_s)
}

impl OverrunAnswer<'_> {
    /// Whether the line is at a speed that was asked for or that the design names.
    fn is_named(&self, l: &OverrunLine) -> bool {
        self.named_rad_s.iter().any(|named| (l.speed_rad_s - named).abs() <= 1e-9 * named)
    }

    /// Whether a steady overrun or a limit of the design has the line's speed, or somebody asked for it.
    fn is_steady(&self, l: &OverrunLine) -> bool {
        let near = |speed: f64| (l.speed_rad_s - speed.abs()).abs() <= 1e-9 * l.speed_rad_s;
        let scenes = self.design.scenarios.iter().filter(|s| s.kind.is_overrun());
        let limits = [self.design.limits.keep_contact_to_rad_s, self.design.limits.lift_off_by_rad_s];
        let outer = self.question.race == RunningRace::Outer;
        self.asked
            || scenes
                .filter_map(|s| s.kind.overrun_rad_s())
                .any(|[ahead, outer_speed]| near(if outer { outer_speed } else { ahead }))
            || self.design.sprags_ride_with() == self.question.race && limits.into_iter().flatten().any(near)
    }

    /// Where and how fast a swing grows most, at the speeds that are named, of none at all.
    fn swings(&self) -> Option<(&OverrunLine, f64)> {
        self.fastest(true)
    }

    fn fastest(&self, named: bool) -> Option<(&OverrunLine, f64)> {
        let lines = self.lines.iter().filter(|l| (self.is_named(l) || self.named_rad_s.is_empty()) == named);
        lines.filter_map(|l| Some((l, growth(l)?))).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Lines that the headline is about. A scene that only begins in overrun counts where none stays in it.
    fn asked_about(&self) -> impl Iterator<Item = &OverrunLine> + Clone {
        let stays = self.lines.iter().any(|l| self.is_named(l) && self.is_steady(l));
        self.lines.iter().filter(move |l| self.is_named(l) && (self.is_steady(l) || !stays))
    }

    /// The line that the headline tells of: of several the one whose swing grows most, then the one with the thinnest film; `None` where no
    /// speed is named.
    fn told(&self) -> Option<&OverrunLine> {
        let lambda = |l: &OverrunLine| l.point.lubricated.map_or(f64::INFINITY, |f| f.film.lambda);
        let swinging = self.asked_about().filter_map(|l| Some((l, growth(l)?)));
        let swinging = swinging.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(l, _)| l);
        swinging.or_else(|| self.asked_about().min_by(|a, b| lambda(a).total_cmp(&lambda(b))))
    }

    /// By which speed sprags of a driven cage lift off at the latest, rad/s, whatever took them along while the drag was measured; `None`:
    /// that makes no difference that shows.
    fn off_at_latest_rad_s(&self) -> Option<f64> {
        let facts = CageFacts::of(&self.design.clutch, &self.state.curve, self.state.alpha_max_rad)?;
        Some(facts.lift_off_higher)
            .filter(|&later| later >= SHOWN_LATER)
            .and_then(|later| Some(self.lift_off_rad_s? * (1.0 + later)))
    }

    /// That the line of the headline is beyond lift-off, and may yet not be.
    fn perhaps_on(&self) -> Option<String> {
        let (speed, lift) = (self.told()?.speed_rad_s, self.lift_off_rad_s?);
        self.off_at_latest_rad_s().filter(|&latest| lift <= speed && speed < latest).map(|latest| {
            format!(
                "; beyond lift-off at {}, which is as late as {} if the inner race, not the cage, took the sprags along while the drag was \
                 measured",
                Unit::Rpm.show(lift, 4),
                Unit::Rpm.show(latest, 4)
            )
        })
    }

    /// How the headline looks.
    pub(super) fn tone(&self) -> Tone {
        match (self.is_unstable(), self.perhaps_on()) {
            (true, _) => Tone::Bad,
            (false, Some(_)) => Tone::Soft,
            (false, None) => Tone::Plain,
        }
    }

    /// Whether the headline calls the overrun not stable.
    fn is_unstable(&self) -> bool {
        match self.told() {
            Some(line) => growth(line).is_some(),
            None => self.swings().is_some(),
        }
    }

    /// The answer in a line: film, swing, drag and heat where the clutch overruns.
    pub(super) fn headline(&self) -> String {
        let race = self.question.race.name();
        let Some(line) = self.told() else { return self.over_all() };
        let others = match self.asked_about().count() {
            1 => String::new(),
            n => format!(", the worst of {n}"),
        };
        let at = format!(
            "At {} of the {race} race, oil at {} °C{others}",
            Unit::Rpm.show(line.speed_rad_s, 4),
            significant(line.oil_c, 3)
        );
        let Some(film) = line.point.lubricated else {
            let perhaps = self.perhaps_on().unwrap_or_default();
            return format!(
                "{at}: the sprags are off the {} race, no drag and no heat{perhaps}",
                self.slides_on()
            );
        };
        let swing = match growth(line) {
            Some(rate) => format!(
                "NOT STABLE, a swing of the sprags grows tenfold in {}",
                Unit::Second.show(std::f64::consts::LN_10 / rate, 2)
            ),
            None => "stable".to_owned(),
        };
        format!(
            "{at}: λ {} ({}), {swing}; drag {}, heat {}{}",
            significant(film.film.lambda, 3),
            match film.film.lambda {
                l if l < 1.0 =>
                    format!("asperities carry {} and wear", Unit::Percent.show(film.film.asperities, 3)),
                l if l < 3.0 => "asperities touch now and then".to_owned(),
                _ => "asperities hardly touch".to_owned(),
            },
            Unit::NewtonMetre.show(line.point.state.drag_torque_nm, 3),
            Unit::Watt.show(film.heat.heat_w, 3),
            self.perhaps_on().unwrap_or_default()
        )
    }

    /// Whether the sprags slide on the outer race.
    pub(super) fn slides_outside(&self) -> bool {
        self.design.clutch.slides_outside()
    }

    /// The race that they slide on.
    fn slides_on(&self) -> &'static str {
        if self.slides_outside() { "outer" } else { "inner" }
    }

    /// The same where no speed is named: from the least to the largest.
    fn over_all(&self) -> String {
        let films = || self.lines.iter().filter_map(|l| Some((l, l.point.lubricated?)));
        let span = |of: &dyn Fn(&OverrunLine) -> Option<f64>| {
            let values = self.lines.iter().filter_map(of);
            values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
        };
        if films().next().is_none() {
            return format!(
                "The sprags are off the {} race at all of these speeds: no drag and no heat",
                self.slides_on()
            );
        }
        let [slow, fast] = span(&|l| Some(l.speed_rad_s));
        let [thin, thick] = span(&|l| Some(l.point.lubricated?.film.lambda));
        let [least, most] = span(&|l| Some(l.point.state.drag_torque_nm));
        let [_, heat_w] = span(&|l| Some(l.point.lubricated?.heat.heat_w));
        format!(
            "The file names no speed of the {} race alone; from {} to {}: λ {} to {}, {}; drag {} to {}, heat up to {}",
            self.question.race.name(),
            Unit::Rpm.show(slow, 4),
            Unit::Rpm.show(fast, 4),
            significant(thin, 3),
            significant(thick, 3),
            self.swings().map_or("stable".to_owned(), |(l, _)| format!("NOT STABLE at {}", place(l))),
            significant(least, 3),
            Unit::NewtonMetre.show(most, 3),
            Unit::Watt.show(heat_w, 3)
        )
    }

    /// Race and speeds, who chose them, and how to choose others.
    pub(super) fn picked(&self) -> String {
        let (race, other) = match self.question.race {
            RunningRace::Inner => ("inner", "outer"),
            RunningRace::Outer => ("outer", "inner"),
        };
        if self.asked {
            return format!("The {race} race runs, the {other} one stands; speeds as asked");
        }
        let mut named: Vec<String> = Vec::new();
        for w in &self.named_rad_s {
            let shown = Unit::Rpm.show(*w, 4);
            if !named.contains(&shown) {
                named.push(shown);
            }
        }
        let of_file = match named.is_empty() {
            true => format!("the file names none of the {race} race alone"),
            false => format!("those of the file, {}, and", named.join(", ")),
        };
        format!(
            "The {race} race runs, the {other} one stands (--race {other}: the other way); speeds: {of_file}{} usual ones \
             up to 50 m/s of the track{}; --speeds names others",
            if named.is_empty() { ", so" } else { "" },
            if self.design.ends_at_lift_off(self.question.race) { " and lift-off" } else { "" }
        )
    }

    /// Oil, surfaces, lift-off, slip.
    pub(super) fn about(&self) -> Vec<String> {
        let l = self.lubrication;
        let mut all = Vec::new();
        for &c in &self.question.temperatures_c {
            all.push(format!(
                "{} at {} °C: {} mm²/s, {} mPa s, α {} 1/GPa; σ {} (Rq of race and sprag)",
                l.oil.name,
                significant(c, 3),
                significant(1e6 * l.oil.walther().nu_m2_s(c), 3),
                significant(1e3 * l.oil.viscosity_pa_s(c), 3),
                significant(1e9 * l.oil.pressure_coefficient_per_pa(c), 3),
                Unit::Micrometre.show(l.roughness_m(), 3),
            ));
        }
        all.push(match self.lift_off_rad_s {
            Some(w) if self.slides_outside() => format!(
                "Without oil the sprags are off the outer race from {} of the inner race{}; on oil they float off from there, on a film as \
                 long as the inlet is full: what that drags is in the table",
                Unit::Rpm.show(w, 4),
                self.off_at_latest_rad_s().map_or(String::new(), |latest| format!(
                    " (from {} at the latest, if the inner race, not the cage, took them along while the drag was measured)",
                    Unit::Rpm.show(latest, 4)
                ))
            ),
            Some(w) => format!(
                "Sprags lift off at {} of the outer race, whatever the oil: drag ends with the force at A",
                Unit::Rpm.show(w, 4)
            ),
            None => "The sprags do not lift off".to_owned(),
        });
        let (filed, heated) = (&self.filed, self.lines.iter().any(|l| l.point.lubricated.is_some()));
        all.extend(heated.then(|| match self.knows_warm() {
            true => format!(
                "As the file has it, the gap is {}, tan ω {} at first contact{}",
                Unit::Millimetre.show(filed.gap_m, 6),
                significant(filed.first_tan_omega, 4),
                filed.bears_nm.map_or(String::new(), |nm| format!(", borne are {}", Unit::NewtonMetre.show(nm, 4)))
            ),
            false => "Fit and gap at these temperatures: not known; they need expansion_um_per_m_k in [material], or the name of a \
                      steel, and a clutch that is one when warm"
                .to_owned(),
        }));
        if let Some(s) = &self.slip {
            all.push(format!(
                "A slip of {} at {} under {}: μ {}, flash {} above the bodies, {} of heat in all sprags; wears {} off each sprag, {} off the race under it",
                Unit::Millimetre.show(s.case.path_m, 3),
                Unit::MetrePerSecond.show(s.case.speed_m_s, 3),
                Unit::NewtonMetre.show(s.case.torque_nm, 4),
                significant(s.friction, 3),
                kelvin(s.flash_k),
                Unit::Joule.show(s.work_j, 3),
                Unit::Micrometre.show(s.sprag_m, 3),
                Unit::Micrometre.show(s.race_m, 3),
            ));
        } else if let Some(case) = &l.slip {
            all.push(format!(
                "No slip: {} is beyond what the clutch carries",
                Unit::NewtonMetre.show(case.torque_nm, 4)
            ));
        }
        if l.slip_heat_w > 0.0 && l.heat_balance {
            all.push(format!(
                "Of the heat {} is that of slips (lubrication.slip_heat_w), half in the inner race and half in the sprags",
                Unit::Watt.show(l.slip_heat_w, 3)
            ));
        }
        if l.to_oil_w_per_k.iter().any(Option::is_none) {
            all.push(
                "Conductances to the oil are estimated, 200 W/(m² K) of the bodies' surfaces: temperatures are good to a factor of two \
                 of their rise"
                    .to_owned(),
            );
        }
        all
    }

    /// What one should not overlook.
    pub fn warnings(&self) -> Vec<String> {
        let mut all = Vec::new();
        let told = self.told().or_else(|| self.swings().map(|(l, _)| l));
        if let Some((l, rate)) = told.and_then(|l| Some((l, growth(l)?))) {
            all.push(format!(
                "Warning: steady overrun does not stay: a small swing of the sprags grows by {} at {}",
                Unit::PerSecond.show(rate, 3),
                place(l)
            ));
        } else if let Some((l, rate)) = self.swings() {
            all.extend(passing_words(
                rate,
                &format!("at a speed at which a scene of the file only begins, {},", place(l)),
            ));
        } else if let Some((l, rate)) = self.fastest(false) {
            all.extend(passing_words(
                rate,
                &format!("at speeds that the file does not name, most at {},", place(l)),
            ));
        }
        let by_friction =
            self.lines.iter().filter(|l| growth(l).is_none()).filter_map(|l| {
                Some((l, l.point.swing_by_friction.filter(|s| s.grows())?.growth_rate_per_s))
            });
        if let Some((l, rate)) = by_friction.max_by(|a, b| a.1.total_cmp(&b.1)) {
            all.push(format!(
                "Note: what keeps the sprags from swinging at {} is that the film must be squeezed; by its friction alone a swing would \
                 grow by {}, as it may where oil is short",
                place(l),
                Unit::PerSecond.show(rate, 3)
            ));
        }
        let films = || self.lines.iter().filter_map(|l| Some((l, l.point.lubricated?.film)));
        if let Some((l, f)) =
            films().filter(|(_, f)| f.lambda < 1.0).min_by(|a, b| a.1.lambda.total_cmp(&b.1.lambda))
        {
            all.push(format!(
                "Warning: λ {} at {}: asperities carry {} of the load, and wear",
                significant(f.lambda, 3),
                place(l),
                Unit::Percent.show(f.asperities, 3)
            ));
        }
        let beyond = films().find(|(_, f)| !f.film.is_checked() && f.lambda > 0.0);
        if let Some((l, f, load)) = beyond.and_then(|(l, f)| Some((l, f, f.film.load?))) {
            let numbers = [("load number M", load), ("lubricant number L", f.film.lubricant)];
            let beyond = numbers.into_iter().zip(Film::CHECKED).filter(|((_, found), most)| found > most);
            let words = |((name, found), most): ((&str, f64), f64)| {
                format!("{name} {}, checked to {most}", significant(found, 3))
            };
            all.push(format!(
                "Warning: at {} the film formula (Moes) is used beyond where it was checked: {}. Take the film there as an estimate",
                place(l),
                beyond.map(words).collect::<Vec<_>>().join("; ")
            ));
        }
        let thick = self.lines.iter().filter_map(|l| {
            let on_film = l.point.lubricated?;
            let thickness_m = on_film.film.film.thickness_m;
            (thickness_m > Film::THIN * on_film.law.contact.radius_m).then_some((l, thickness_m))
        });
        if let Some((l, thickness_m)) = thick.max_by(|a, b| a.1.total_cmp(&b.1)) {
            all.push(format!(
                "Warning: a film of {} at {} is no thin one: the sprags float on oil too thick for them, and its figures \
                 are an order at best",
                Unit::Micrometre.show(thickness_m, 3),
                place(l)
            ));
        }
        let hottest = self.lines.iter().filter_map(|l| Some((l, l.point.lubricated?.film_c)));
        if let Some((l, film_c)) =
            hottest.filter(|(_, c)| *c > Walther::KNOWN_TO_C).max_by(|a, b| a.1.total_cmp(&b.1))
        {
            all.push(format!(
                "Warning: the film reaches {} °C at {}: no oil is known to stay one beyond {} °C, and the figures there are an order at best",
                significant(film_c, 3),
                place(l),
                Walther::KNOWN_TO_C
            ));
        }
        // Without any line of that kind it is the file that lacks something, which is said elsewhere.
        if let Some((l, why)) = self.no_clutch.as_ref().filter(|_| self.knows_warm()) {
            all.push(format!(
                "Warning: at {} the clutch is none once it is as warm as that: {why}",
                place(l)
            ));
        }
        let peak_nm = self.design.limits.peak_torque_nm;
        let short = |l: &&OverrunLine| {
            let filed = self.filed.bears_nm.zip(peak_nm).is_some_and(|(bears, peak)| bears >= peak);
            filed && l.warm.and_then(|w| w.bears_nm).zip(peak_nm).is_some_and(|(bears, peak)| bears < peak)
        };
        if let Some(l) = self.lines.iter().find(short) {
            let bears = l.warm.and_then(|w| w.bears_nm).unwrap_or(0.0);
            all.push(format!(
                "Warning: as warm as at {} the clutch bears {}, less than the {} of limits.peak_torque_nm",
                place(l),
                Unit::NewtonMetre.show(bears, 5),
                Unit::NewtonMetre.show(peak_nm.unwrap_or(0.0), 5)
            ));
        }
        if let Some(s) = self.slip.filter(|s| s.peclet < 5.0) {
            all.push(format!(
                "Note: Peclet number of the slip {}, below 5: heat goes sideways too, the flash is less than {}",
                significant(s.peclet, 2),
                kelvin(s.flash_k)
            ));
        }
        all.sort_by_key(|line: &String| line.starts_with("Note"));
        all
    }
}

fn kelvin(k: f64) -> String {
    format!("{} K", significant(k, 3))
}
