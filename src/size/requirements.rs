//! What is asked of a new clutch.

use super::asked::{ASKED, asked};
use super::purpose::Purpose;
use crate::design::{rad_s, rpm};
use crate::material::{STEELS, Steel};
use crate::numeric::rounded;
use std::f64::consts::PI;

/// A torque that swings, its crest the nominal torque.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TorqueSwing {
    /// Amplitude, N m.
    pub amplitude_nm: f64,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Where amplitude and frequency come from, for the file's comments.
    pub from: [&'static str; 2],
}

/// What a new clutch shall do, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Requirements {
    /// Bore of the inner race, diameter, m.
    pub bore_m: f64,
    /// Torque that it carries day by day, N m: the nominal torque.
    pub torque_nm: f64,
    /// Torque at the worst, N m: the peak torque, from the nominal one up.
    pub peak_nm: f64,
    /// Diameter of the inner track, m; `None`: by the bore and the race space, or the outer track.
    pub inner_track_m: Option<f64>,
    /// Diameter of the outer track, m; `None`: by the inner one and the race space.
    pub outer_track_m: Option<f64>,
    /// Largest outer diameter, m; `None`: 1.4 times the outer track, as the maker's.
    pub outside_m: Option<f64>,
    /// Largest width of the races, m.
    pub width_m: Option<f64>,
    /// Speeds of the inner and of the outer race in overrun, rad/s, not negative; both in one sense.
    pub overrun_rad_s: [f64; 2],
    /// Speed of the outer race up to which the sprags keep contact in overrun, rad/s.
    pub keep_contact_rad_s: Option<f64>,
    /// Speed of the outer race by which the sprags have lifted off, rad/s.
    pub lift_off_rad_s: Option<f64>,
    /// Whether a cage carries the sprags with the inner race, whose speed the two before then mean: they are to lift off, and the outer race
    /// stands in overrun.
    pub carried: bool,
    /// Static friction mu_s.
    pub friction: f64,
    /// Where friction, nominal and peak torque come from, for the file's comments.
    pub from: [&'static str; 3],
    /// The same of the speeds of inner and outer race in overrun.
    pub overrun_from: [&'static str; 2],
    /// The same of the speeds up to which contact is kept and by which it is lost.
    pub contact_from: [&'static str; 2],
    /// Steel of sprags and races; it brings the allowed stresses.
    pub steel: &'static Steel,
    /// What the clutch is for: the scenes that its file has beside the two of every first design.
    pub purpose: Option<&'static Purpose>,
    /// How the torque swings, where it does: a scene of its file.
    pub swing: Option<TorqueSwing>,
    /// Engagements in its life at nominal torque, for `[life]` of the file: the size does not follow from them.
    pub engagements: Option<f64>,
}

/// Peak over nominal torque where only one of them is named: a choice, some scatter of the drive.
pub const PEAK_OVER_NOMINAL: f64 = 1.3;

/// Where a value comes from that somebody named.
pub(super) const NAMED: &str = "asked for";
/// The same of a race that overruns as fast as the sprags are to lift off.
const LIFT_OFF_SPEED: &str = "the speed of lift-off";

/// Shear of a solid shaft in the bore beyond which the bore is no shaft's, Pa: ten times what the hardest steels bear.
const NO_SHAFT_PA: f64 = 1e10;

/// Static friction that catalogues of sprag clutches reckon with (GMN 9050).
pub const FRICTION: f64 = 0.11;

/// What somebody has said of a new clutch, SI; what is not said comes of the purpose, or is not asked for.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Wish {
    /// See [`Requirements::purpose`].
    pub purpose: Option<&'static Purpose>,
    /// See [`Requirements::bore_m`]; must be said.
    pub bore_m: Option<f64>,
    /// See [`Requirements::torque_nm`]; it or the peak torque must be said.
    pub torque_nm: Option<f64>,
    /// See [`Requirements::peak_nm`].
    pub peak_nm: Option<f64>,
    /// Peak over nominal torque.
    pub peak_over_nominal: Option<f64>,
    /// See [`Requirements::inner_track_m`].
    pub inner_track_m: Option<f64>,
    /// See [`Requirements::outer_track_m`].
    pub outer_track_m: Option<f64>,
    /// See [`Requirements::outside_m`].
    pub outside_m: Option<f64>,
    /// See [`Requirements::width_m`].
    pub width_m: Option<f64>,
    /// Speed of the inner race in overrun, rad/s.
    pub inner_rad_s: Option<f64>,
    /// The same of the outer race.
    pub outer_rad_s: Option<f64>,
    /// See [`Requirements::keep_contact_rad_s`]; 0: not asked.
    pub keep_contact_rad_s: Option<f64>,
    /// See [`Requirements::lift_off_rad_s`]; 0: they stay on.
    pub lift_off_rad_s: Option<f64>,
    /// See [`Requirements::friction`].
    pub friction: Option<f64>,
    /// See [`Requirements::steel`].
    pub steel: Option<&'static Steel>,
    /// Amplitude of [`Requirements::swing`], N m; 0: it does not swing.
    pub swing_nm: Option<f64>,
    /// Its frequency, Hz.
    pub swing_hz: Option<f64>,
    /// See [`Requirements::engagements`].
    pub engagements: Option<f64>,
}

impl Wish {
    /// The whole question, refused where no clutch of this kind is asked for.
    ///
    /// # Errors
    /// The first [`BadRequirement`].
    pub fn check(&self) -> Result<Requirements, BadRequirement> {
        self.check_ratio()?;
        let wanted = self.requirements();
        self.check_swing(&wanted)?;
        self.check_contact(&wanted)?;
        self.check_lift_off(&wanted)?;
        self.check_shaft(&wanted)?;
        wanted.check().map(|()| wanted)
    }

    /// What the number `key` and those asked before it come to together, where it is the last of them; the refusal names the first number
    /// that may be put right.
    ///
    /// # Errors
    /// [`BadRequirement`].
    pub fn check_up_to(&self, key: &str) -> Result<(), BadRequirement> {
        let wanted = self.requirements();
        match key {
            "peak" => self.check_shaft(&wanted),
            "keep-contact-rpm" => self.check_contact(&wanted),
            "lift-off-rpm" => self.check_contact(&wanted).and_then(|()| self.check_lift_off(&wanted)),
            "swing-hz" => self.check_swing(&wanted),
            _ => Ok(()),
        }
    }

    /// Refuse an amplitude without a frequency.
    fn check_swing(&self, wanted: &Requirements) -> Result<(), BadRequirement> {
        match self.swing_nm.filter(|nm| *nm != 0.0 && wanted.swing.is_none()) {
            Some(nm) => Err(BadRequirement {
                what: "swing",
                found: format!("{nm} Nm alone"),
                allowed: "with swing-hz, which says how often".to_owned(),
            }),
            None => Ok(()),
        }
    }

    /// Refuse a speed to which contact is to be kept where nothing turns that would lift the sprags, and beyond that at which the purpose
    /// has them off.
    fn check_contact(&self, wanted: &Requirements) -> Result<(), BadRequirement> {
        let held = self.purpose.filter(|p| p.keep_contact_rpm.value == 0.0);
        let stands = held.is_some() && wanted.overrun_rad_s[1] == 0.0 && !wanted.carried;
        if let Some(keep) = self.keep_contact_rad_s.filter(|keep| stands && *keep > 0.0) {
            return Err(BadRequirement {
                what: "keep-contact-rpm",
                found: format!("{} of an outer race that is held", show(keep)),
                allowed: "nothing: the sprags ride with the outer race; with lift-off-rpm a cage carries them with the inner race, and both are \
                          its speeds"
                    .to_owned(),
            });
        }
        let lift = wanted.lift_off_rad_s.filter(|_| self.lift_off_rad_s.is_none());
        let Some((keep, lift)) = self.keep_contact_rad_s.zip(lift).filter(|(keep, lift)| keep > lift) else {
            return Ok(());
        };
        Err(BadRequirement {
            what: "keep-contact-rpm",
            found: show(keep),
            allowed: format!(
                "up to {}, by which sprags of this purpose are off ({}); lift-off-rpm says another speed, 0 that they stay on",
                show(lift),
                wanted.contact_from[1]
            ),
        })
    }

    /// Refuse a speed of lift-off that the outer race does not reach.
    fn check_lift_off(&self, wanted: &Requirements) -> Result<(), BadRequirement> {
        let (Some(lift), [inner, outer]) = (wanted.lift_off_rad_s, wanted.overrun_rad_s) else {
            return Ok(());
        };
        if wanted.carried && lift > inner * (1.0 + 1e-9) {
            return Err(BadRequirement {
                what: "lift-off-rpm",
                found: format!(
                    "{}, while the inner race turns at {} in overrun ({})",
                    show(lift),
                    show(inner),
                    wanted.overrun_from[0]
                ),
                allowed: "up to the speed of the inner race in overrun, inner-rpm: where the outer race stands a cage carries the sprags with \
                          the inner one; 0: they stay on"
                    .to_owned(),
            });
        }
        let outer_known = self.outer_rad_s.is_some() || self.purpose.is_some();
        if !wanted.carried && outer_known && lift > outer * (1.0 + 1e-9) {
            return Err(BadRequirement {
                what: "lift-off-rpm",
                found: format!(
                    "{}, while the outer race turns at {} in overrun ({})",
                    show(lift),
                    show(outer),
                    wanted.overrun_from[1]
                ),
                allowed: "up to the speed of the outer race in overrun, outer-rpm: these sprags ride with it, and nothing else throws them off \
                          the inner race; 0: they stay on. Where the outer race stands (outer-rpm 0) a cage carries them with the inner race, and they \
                          lift off the outer one"
                    .to_owned(),
            });
        }
        Ok(())
    }

    /// Refuse a bore whose shaft no steel would make strong enough by far: mostly one in inches.
    fn check_shaft(&self, wanted: &Requirements) -> Result<(), BadRequirement> {
        let shear_pa = 16.0 * wanted.peak_nm / (PI * wanted.bore_m.powi(3));
        if shear_pa <= NO_SHAFT_PA || !shear_pa.is_finite() {
            return Ok(());
        }
        Err(BadRequirement {
            what: "bore",
            found: format!("{} mm", rounded(1e3 * wanted.bore_m, 12)),
            allowed: format!(
                "a diameter in mm (an inch is 25.4): {} Nm would shear a shaft as thick as this by {} MPa",
                rounded(wanted.peak_nm, 6),
                rounded(shear_pa / 1e6, 2)
            ),
        })
    }

    /// Refuse a factor beside both torques that it joins, and one that makes the peak the lower.
    ///
    /// # Errors
    /// [`BadRequirement`] of `safety`.
    pub fn check_ratio(&self) -> Result<(), BadRequirement> {
        let Some(ratio) = self.peak_over_nominal else { return Ok(()) };
        if self.torque_nm.is_some() && self.peak_nm.is_some() {
            return Err(BadRequirement {
                what: "safety",
                found: format!("{ratio} beside torque and peak"),
                allowed: "one of the three left out, for it is peak over torque".to_owned(),
            });
        }
        asked("safety").map_or(Ok(()), |row| row.check_value(ratio, &self.requirements()))
    }

    /// The whole question. Bore and torques that nobody has said are no numbers, which [`Requirements::check`] refuses.
    pub fn requirements(&self) -> Requirements {
        let of = |value: fn(&Purpose) -> f64| self.purpose.map(value);
        let ratio = self.peak_over_nominal.or(of(|p| p.peak_over_nominal.value)).unwrap_or(PEAK_OVER_NOMINAL);
        let [torque_nm, peak_nm] = torques_nm(self.torque_nm, self.peak_nm, ratio).unwrap_or([f64::NAN; 2]);
        let keep = self.keep_contact_rad_s.or(of(|p| p.keep_contact_rpm.value).map(rad_s));
        let lift = self.lift_off_rad_s.or(self.purpose.and_then(|p| p.lift_off_rpm).map(|g| rad_s(g.value)));
        let outer = self.outer_rad_s.or(of(|p| p.overrun_rpm[1].value).map(rad_s)).or(keep);
        // What lifts off by a speed that somebody names is overrun by it.
        let lifts = self.lift_off_rad_s.filter(|_| self.purpose.is_some_and(|p| p.lift_off_rpm.is_some()));
        let raised =
            lifts.filter(|lift| self.outer_rad_s.is_none() && outer.is_some_and(|outer| *lift > outer));
        let outer = raised.or(outer);
        // A purpose that keeps contact keeps it at the speed that somebody names for its overrun.
        let keeps = self.purpose.is_some_and(|p| p.lift_off_rpm.is_none() && p.keep_contact_rpm.value > 0.0);
        let follows = keeps && self.keep_contact_rad_s.is_none() && lift.is_none_or(|w| w == 0.0);
        let raised_keep = self.outer_rad_s.filter(|outer| follows && keep.is_some_and(|keep| *outer > keep));
        let keep = raised_keep.or(keep);
        let inner = self.inner_rad_s.or(of(|p| p.overrun_rpm[0].value).map(rad_s));
        let carried = self.lift_off_rad_s.is_some_and(|lift| lift != 0.0) && outer == Some(0.0);
        let raised_inner = self
            .lift_off_rad_s
            .filter(|lift| carried && self.inner_rad_s.is_none() && inner.is_none_or(|inner| *lift > inner));
        let inner = raised_inner.or(inner);
        let said = |value: Option<f64>, other: &'static str| value.map_or(other, |_| NAMED);
        let usual = self.purpose.and_then(|p| p.excitation);
        let amplitude_nm = self.swing_nm.or(usual.map(|e| e.share.value * torque_nm)).filter(|nm| *nm != 0.0);
        let frequency_hz = self.swing_hz.or(usual.map(|e| e.frequency_hz.value));
        let swing = amplitude_nm.zip(frequency_hz).map(|(amplitude_nm, frequency_hz)| TorqueSwing {
            amplitude_nm,
            frequency_hz,
            from: [
                said(self.swing_nm, usual.map_or("", |e| e.share.from)),
                said(self.swing_hz, usual.map_or("", |e| e.frequency_hz.from)),
            ],
        });
        let by_ratio = match (self.peak_over_nominal, self.purpose) {
            (None, Some(p)) => p.peak_over_nominal.from,
            (None, None) => "1.3 of nominal torque: guess",
            _ => "by the factor asked for",
        };
        Requirements {
            bore_m: self.bore_m.unwrap_or(f64::NAN),
            torque_nm,
            peak_nm,
            inner_track_m: self.inner_track_m,
            outer_track_m: self.outer_track_m,
            outside_m: self.outside_m,
            width_m: self.width_m,
            overrun_rad_s: [inner.unwrap_or(0.0), outer.unwrap_or(0.0)],
            keep_contact_rad_s: keep.filter(|&w| w != 0.0),
            lift_off_rad_s: lift.filter(|&w| w != 0.0),
            carried,
            friction: self.friction.or(of(|p| p.friction.value)).unwrap_or(FRICTION),
            from: [
                said(self.friction, self.purpose.map_or("GMN 9050", |p| p.friction.from)),
                said(self.torque_nm, by_ratio),
                said(self.peak_nm, by_ratio),
            ],
            overrun_from: [
                said(
                    self.inner_rad_s,
                    match raised_inner {
                        Some(_) => LIFT_OFF_SPEED,
                        None => self.purpose.map_or("at rest", |p| p.overrun_rpm[0].from),
                    },
                ),
                said(
                    self.outer_rad_s,
                    match raised {
                        Some(_) => LIFT_OFF_SPEED,
                        None => self.purpose.map_or("as contact is kept to", |p| p.overrun_rpm[1].from),
                    },
                ),
            ],
            contact_from: [
                said(
                    self.keep_contact_rad_s,
                    match raised_keep {
                        Some(_) => "the outer race in overrun",
                        None => self.purpose.map_or("", |p| p.keep_contact_rpm.from),
                    },
                ),
                said(self.lift_off_rad_s, self.purpose.and_then(|p| p.lift_off_rpm).map_or("", |g| g.from)),
            ],
            steel: self.steel.unwrap_or(&STEELS[0]),
            purpose: self.purpose,
            swing,
            engagements: self.engagements,
        }
    }
}

/// A number out of range.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{what}: found {found}; allowed: {allowed}")]
pub struct BadRequirement {
    /// Which.
    pub what: &'static str,
    /// What was found, with its unit.
    pub found: String,
    /// What is allowed, with its unit.
    pub allowed: String,
}

/// Nominal and peak torque, N m, of whichever is named; the other by `ratio`, peak over nominal. `None`: neither is.
pub fn torques_nm(nominal: Option<f64>, peak: Option<f64>, ratio: f64) -> Option<[f64; 2]> {
    match (nominal, peak) {
        (Some(nominal), Some(peak)) => Some([nominal, peak]),
        (Some(nominal), None) => Some([nominal, ratio * nominal]),
        (None, Some(peak)) => Some([peak / ratio, peak]),
        (None, None) => None,
    }
}

impl Requirements {
    /// Speed at which the races slide past one another in overrun, rad/s.
    pub fn sliding_rad_s(&self) -> f64 {
        (self.overrun_rad_s[0] - self.overrun_rad_s[1]).abs()
    }

    /// What nobody has said and the purpose has answered: words, value with its unit, where it comes from.
    pub fn taken(&self) -> Vec<(&'static str, String, &'static str)> {
        let rows = ASKED.iter().filter(|_| self.purpose.is_some());
        rows.filter_map(|row| row.taken(self)).collect()
    }

    /// Refuse what no clutch of this kind is asked for.
    ///
    /// # Errors
    /// The first [`BadRequirement`].
    pub fn check(&self) -> Result<(), BadRequirement> {
        // The speed of contact first: that of the outer race may follow it.
        let first = ASKED.iter().filter(|row| row.key == "keep-contact-rpm");
        first.chain(&ASKED).try_for_each(|row| row.check(self))
    }
}

/// A speed as it is typed.
fn show(rad_s: f64) -> String {
    format!("{} rpm", rounded(rpm(rad_s), 6))
}
