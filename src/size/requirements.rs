//! What is asked of a new clutch.

use super::purpose::Purpose;
use crate::design::{rad_s, rpm};
use crate::material::{STEELS, Steel};
use crate::numeric::rounded;
use std::f64::consts::PI;
use std::fmt;

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
    /// The whole question. Bore and torques that nobody has said are no numbers, which [`Requirements::check`] refuses.
    pub fn requirements(&self) -> Requirements {
        let of = |value: fn(&Purpose) -> f64| self.purpose.map(value);
        let ratio = self.peak_over_nominal.or(of(|p| p.peak_over_nominal.value)).unwrap_or(PEAK_OVER_NOMINAL);
        let [torque_nm, peak_nm] = torques_nm(self.torque_nm, self.peak_nm, ratio).unwrap_or([f64::NAN; 2]);
        let keep = self.keep_contact_rad_s.or(of(|p| p.keep_contact_rpm.value).map(rad_s));
        let lift = self.lift_off_rad_s.or(self.purpose.and_then(|p| p.lift_off_rpm).map(|g| rad_s(g.value)));
        let outer = self.outer_rad_s.or(of(|p| p.overrun_rpm[1].value).map(rad_s)).or(keep);
        let inner = self.inner_rad_s.or(of(|p| p.overrun_rpm[0].value).map(rad_s));
        let said = |value: Option<f64>, other: &'static str| value.map_or(other, |_| "asked for");
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
            outside_m: self.outside_m,
            width_m: self.width_m,
            overrun_rad_s: [inner.unwrap_or(0.0), outer.unwrap_or(0.0)],
            keep_contact_rad_s: keep.filter(|&w| w != 0.0),
            lift_off_rad_s: lift.filter(|&w| w != 0.0),
            friction: self.friction.or(of(|p| p.friction.value)).unwrap_or(FRICTION),
            from: [
                said(self.friction, self.purpose.map_or("GMN 9050", |p| p.friction.from)),
                said(self.torque_nm, by_ratio),
                said(self.peak_nm, by_ratio),
            ],
            overrun_from: [
                said(self.inner_rad_s, self.purpose.map_or("at rest", |p| p.overrun_rpm[0].from)),
                said(
                    self.outer_rad_s,
                    self.purpose.map_or("as contact is kept to", |p| p.overrun_rpm[1].from),
                ),
            ],
            contact_from: [
                said(self.keep_contact_rad_s, self.purpose.map_or("", |p| p.keep_contact_rpm.from)),
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
#[derive(Debug, Clone, PartialEq)]
pub struct BadRequirement {
    /// Which.
    pub what: &'static str,
    /// What was found, with its unit.
    pub found: String,
    /// What is allowed, with its unit.
    pub allowed: String,
}

impl fmt::Display for BadRequirement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: found {}; allowed: {}", self.what, self.found, self.allowed)
    }
}

impl std::error::Error for BadRequirement {}

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
        if self.purpose.is_none() {
            return Vec::new();
        }
        let of = |value: f64, unit: &str| format!("{} {unit}", rounded(value, 6));
        let rpm = |rad_s: f64| of(rpm(rad_s), "rpm");
        let mut rows = vec![
            ("friction", rounded(self.friction, 6).to_string(), self.from[0]),
            ("nominal torque", of(self.torque_nm, "Nm"), self.from[1]),
            ("peak torque", of(self.peak_nm, "Nm"), self.from[2]),
            ("inner race in overrun", rpm(self.overrun_rad_s[0]), self.overrun_from[0]),
            ("outer race in overrun", rpm(self.overrun_rad_s[1]), self.overrun_from[1]),
            ("contact kept up to", rpm(self.keep_contact_rad_s.unwrap_or(0.0)), self.contact_from[0]),
        ];
        rows.extend(self.lift_off_rad_s.map(|w| ("sprags off by", rpm(w), self.contact_from[1])));
        if let Some(swing) = self.swing {
            rows.push(("torque swings by", of(swing.amplitude_nm, "Nm"), swing.from[0]));
            rows.push(("that often", of(swing.frequency_hz, "Hz"), swing.from[1]));
        }
        rows.retain(|(.., from)| *from != "asked for");
        rows
    }

    /// Refuse what no clutch of this kind is asked for.
    ///
    /// # Errors
    /// The first [`BadRequirement`].
    pub fn check(&self) -> Result<(), BadRequirement> {
        self.check_where(|_| true)
    }

    /// The same of one number alone, as an error names it.
    ///
    /// # Errors
    /// [`BadRequirement`] of that number.
    pub fn check_one(&self, what: &str) -> Result<(), BadRequirement> {
        self.check_where(|name| name == what)
    }

    fn check_where(&self, asked: impl Fn(&str) -> bool) -> Result<(), BadRequirement> {
        let (mm, rpm) = (1e3, 30.0 / PI);
        let [inner, outer] = self.overrun_rad_s;
        let bore = self.bore_m * mm;
        let keep = self.keep_contact_rad_s.unwrap_or(0.0) * rpm;
        let rows = [
            ("bore", Some(self.bore_m), mm, "mm", 1.0, 2000.0),
            ("torque", Some(self.torque_nm), 1.0, "Nm", 1e-3, 1e7),
            ("peak", Some(self.peak_nm), 1.0, "Nm", self.torque_nm, 10.0 * self.torque_nm),
            ("outside", self.outside_m, mm, "mm", bore, 10_000.0),
            ("width", self.width_m, mm, "mm", 1.0, 1000.0),
            ("keep-contact-rpm", self.keep_contact_rad_s, rpm, "rpm", 0.0, 60_000.0),
            ("lift-off-rpm", self.lift_off_rad_s, rpm, "rpm", keep.max(1.0), 60_000.0),
            ("inner-rpm", Some(inner), rpm, "rpm", 0.0, 60_000.0),
            ("outer-rpm", Some(outer), rpm, "rpm", 0.0, 60_000.0),
            ("friction", Some(self.friction), 1.0, "", 0.03, 0.5),
            ("swing", self.swing.map(|s| s.amplitude_nm), 1.0, "Nm", 0.0, 0.5 * self.torque_nm),
            ("swing-hz", self.swing.map(|s| s.frequency_hz), 1.0, "Hz", 0.1, 10_000.0),
            ("engagements", self.engagements, 1.0, "", 1.0, 1e15),
        ];
        for (what, value, per_si, unit, least, most) in rows {
            let Some(value) = value.filter(|_| asked(what)) else { continue };
            let shown = value * per_si;
            // NaN is in no range; rounding of the units is.
            if !(shown >= least * (1.0 - 1e-9) && shown <= most * (1.0 + 1e-9)) {
                let space = if unit.is_empty() { "" } else { " " };
                return Err(BadRequirement {
                    what,
                    found: format!("{}{space}{unit}", rounded(shown, 12)),
                    allowed: match what {
                        "outside" => {
                            format!("above the bore, {} mm, to {} mm", rounded(bore, 12), rounded(most, 12))
                        }
                        "swing" => format!(
                            "0 to {} {unit}, half the nominal torque: it swings up to nominal torque and must not turn round",
                            rounded(most, 12)
                        ),
                        _ => format!("{} to {}{space}{unit}", rounded(least, 12), rounded(most, 12)),
                    },
                });
            }
        }
        Ok(())
    }
}
