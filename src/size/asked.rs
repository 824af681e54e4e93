//! The numbers of a wish, each once: options, questions, ranges and what was taken are read from this table.

use super::requirements::{BadRequirement, NAMED, Requirements, Wish};
use crate::design::{rad_s, rpm};
use crate::numeric::rounded;

named! {
    /// Unit in which a number is typed.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum WishUnit {
        /// mm.
        Millimetre = "mm",
        /// N m.
        NewtonMetre = "Nm",
        /// rev/min.
        Rpm = "rpm",
        /// Hz.
        Hertz = "Hz",
        /// A pure number.
        One = "",
    }
    /// Its sign; empty for a pure number.
    pub fn sign;
}

impl WishUnit {
    /// `typed`, in this unit, in SI.
    pub fn si(self, typed: f64) -> f64 {
        match self {
            Self::Millimetre => typed / 1e3,
            Self::Rpm => rad_s(typed),
            Self::NewtonMetre | Self::Hertz | Self::One => typed,
        }
    }

    /// `si` in this unit.
    pub fn typed(self, si: f64) -> f64 {
        match self {
            Self::Millimetre => si * 1e3,
            Self::Rpm => rpm(si),
            Self::NewtonMetre | Self::Hertz | Self::One => si,
        }
    }

    /// A number in this unit with its sign.
    fn words(self, typed: f64, digits: usize) -> String {
        format!("{} {}", rounded(typed, digits), self.sign()).trim_end().to_owned()
    }
}

/// What holds where a number is not named.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unnamed {
    /// Nothing: it is not asked for.
    Nothing,
    /// What the purpose brings, or the other numbers.
    Follows,
    /// The same, and 0 where they bring nothing.
    FollowsOrZero,
}

/// Words for a number that was taken, and where its value comes from.
type Taken = (&'static str, fn(&Requirements) -> &'static str);

/// A number that a [`Wish`] may name.
#[derive(Debug, Clone, Copy)]
pub struct WishNumber {
    /// Its name in options and errors.
    pub key: &'static str,
    /// Another name of its option.
    pub alias: Option<&'static str>,
    /// Unit in which it is typed.
    pub unit: WishUnit,
    /// What stands for it in a line of help.
    pub place: &'static str,
    /// What it is.
    pub words: &'static str,
    /// What a line of help adds.
    pub help: &'static str,
    /// What a question adds; `None`: it is not asked one by one.
    pub question: Option<&'static str>,
    /// Whether it is asked for a purpose alone.
    pub of_purpose: bool,
    /// Whether there is no clutch without it.
    pub needed: bool,
    /// What holds without it.
    pub unnamed: Unnamed,
    /// Where a wish keeps it, SI.
    pub at: fn(&mut Wish) -> &mut Option<f64>,
    /// What comes of the wish, SI.
    value: fn(&Requirements) -> Option<f64>,
    /// Least and largest value, in its unit, with a reason that follows in words.
    range: (fn(&Requirements) -> [f64; 2], &'static str),
    /// Its name in the list of what was taken, and where the value comes from.
    taken: Option<Taken>,
}

/// What most numbers are.
const ASK: WishNumber = WishNumber {
    key: "",
    alias: None,
    unit: WishUnit::One,
    place: "N",
    words: "",
    help: "",
    question: Some(""),
    of_purpose: false,
    needed: false,
    unnamed: Unnamed::Nothing,
    at: |w| &mut w.bore_m,
    value: |_| None,
    range: (|_| [0.0, f64::INFINITY], ""),
    taken: None,
};
const LENGTH: WishNumber = WishNumber { unit: WishUnit::Millimetre, place: "MM", ..ASK };
const TORQUE: WishNumber = WishNumber { unit: WishUnit::NewtonMetre, place: "NM", ..ASK };
/// Of a race in overrun.
const SPEED: WishNumber = WishNumber {
    unit: WishUnit::Rpm,
    place: "RPM",
    unnamed: Unnamed::Follows,
    range: (|_| [0.0, MOST_RPM], ""),
    ..ASK
};
const MOST_RPM: f64 = 60_000.0;

/// All of them, in the order of the questions.
pub const ASKED: [WishNumber; 16] = [
    WishNumber {
        key: "bore",
        words: "Bore of the inner race, diameter, mm",
        needed: true,
        at: |w| &mut w.bore_m,
        value: |r| Some(r.bore_m),
        range: (|_| [1.0, 2000.0], ""),
        ..LENGTH
    },
    WishNumber {
        key: "torque",
        words: "Nominal torque, carried day by day, Nm",
        question: Some(" (none: by the peak torque)"),
        at: |w| &mut w.torque_nm,
        value: |r| Some(r.torque_nm),
        range: (|_| [1e-3, 1e7], ""),
        taken: Some(("nominal torque", |r| r.from[1])),
        ..TORQUE
    },
    WishNumber {
        key: "peak",
        words: "Peak torque, at the worst, Nm",
        help: "; in place of --torque or beside it",
        needed: true,
        unnamed: Unnamed::Follows,
        at: |w| &mut w.peak_nm,
        value: |r| Some(r.peak_nm),
        range: (|r| [r.torque_nm, 10.0 * r.torque_nm], ""),
        taken: Some(("peak torque", |r| r.from[2])),
        ..TORQUE
    },
    WishNumber {
        key: "safety",
        place: "FACTOR",
        words: "Peak torque over nominal torque, where only one of them is named",
        help: " [default: 1.3, or that of the purpose]",
        question: None,
        at: |w| &mut w.peak_over_nominal,
        range: (|_| [1.0, 10.0], ""),
        ..ASK
    },
    WishNumber {
        key: "inner-track",
        words: "Diameter of the inner track, on which the sprags stand, mm",
        help: " [default: by the bore and the race space]",
        question: None,
        at: |w| &mut w.inner_track_m,
        value: |r| r.inner_track_m,
        range: (|r| [1e3 * r.bore_m, 10_000.0], ", above the bore"),
        ..LENGTH
    },
    WishNumber {
        key: "outer-track",
        words: "Diameter of the outer track, mm",
        help: " [default: by the inner one and the race space]",
        question: None,
        at: |w| &mut w.outer_track_m,
        value: |r| r.outer_track_m,
        range: (
            |r| {
                let inner = 1e3 * r.inner_track_m.unwrap_or(r.bore_m);
                [inner + 3.0, inner + 80.0]
            },
            ", 1.5 to 40 mm outside the inner track, or the bore",
        ),
        ..LENGTH
    },
    WishNumber {
        key: "outside",
        words: "Largest outer diameter, mm",
        help: " [default: 1.4 times the outer track]",
        question: Some(" (none: 1.4 times the outer track)"),
        at: |w| &mut w.outside_m,
        value: |r| r.outside_m,
        range: (|r| [1e3 * r.bore_m, 10_000.0], ", above the bore"),
        ..LENGTH
    },
    WishNumber {
        key: "width",
        words: "Largest width of the races, mm",
        question: Some(" (none: as wide as it must)"),
        at: |w| &mut w.width_m,
        value: |r| r.width_m,
        range: (|_| [1.0, 1000.0], ""),
        ..LENGTH
    },
    WishNumber {
        key: "inner-rpm",
        words: "Speed of the inner race in overrun, rpm",
        help: ": for drag and heat",
        at: |w| &mut w.inner_rad_s,
        value: |r| Some(r.overrun_rad_s[0]),
        taken: Some(("inner race in overrun", |r| r.overrun_from[0])),
        ..SPEED
    },
    WishNumber {
        key: "outer-rpm",
        words: "Speed of the outer race in overrun, rpm, in the same sense",
        help: " [default: that of --keep-contact-rpm]",
        at: |w| &mut w.outer_rad_s,
        value: |r| Some(r.overrun_rad_s[1]),
        taken: Some(("outer race in overrun", |r| r.overrun_from[1])),
        ..SPEED
    },
    WishNumber {
        key: "keep-contact-rpm",
        alias: Some("speed"),
        words: "Speed of the outer race up to which the sprags keep contact in overrun, rpm",
        help: "; 0: not asked",
        question: Some(" (0: not asked)"),
        at: |w| &mut w.keep_contact_rad_s,
        value: |r| Some(r.keep_contact_rad_s.unwrap_or(0.0)),
        taken: Some(("contact kept up to", |r| r.contact_from[0])),
        ..SPEED
    },
    WishNumber {
        key: "lift-off-rpm",
        words: "Speed of the outer race by which the sprags must be off the inner race, rpm",
        help: "; of the inner race, off the outer one, in a cage that it drives, where the outer race stands; 0: they stay on",
        question: Some(" (0: they stay on)"),
        unnamed: Unnamed::FollowsOrZero,
        at: |w| &mut w.lift_off_rad_s,
        value: |r| r.lift_off_rad_s,
        range: (
            |r| [rpm(r.keep_contact_rad_s.unwrap_or(0.0)).max(1.0), MOST_RPM],
            ", not below the speed to which contact is kept",
        ),
        taken: Some(("sprags off by", |r| r.contact_from[1])),
        ..SPEED
    },
    WishNumber {
        key: "swing",
        words: "Amplitude by which the torque swings, Nm, up to nominal torque",
        help: "; 0: it does not [default: that of the purpose]",
        question: Some(" (0: it does not)"),
        of_purpose: true,
        unnamed: Unnamed::FollowsOrZero,
        at: |w| &mut w.swing_nm,
        value: |r| r.swing.map(|s| s.amplitude_nm),
        range: (
            |r| [0.0, 0.5 * r.torque_nm],
            ", half the nominal torque (where only the peak is named, that over the safety of the purpose): it swings up to nominal \
             torque and must not turn round",
        ),
        taken: Some(("torque swings by", |r| r.swing.map_or("", |s| s.from[0]))),
        ..TORQUE
    },
    WishNumber {
        key: "swing-hz",
        unit: WishUnit::Hertz,
        place: "HZ",
        words: "How often it swings, Hz: strokes a second, blades passing, orders of an engine",
        help: " [default: that of the purpose]",
        question: Some(" (none: it does not)"),
        of_purpose: true,
        unnamed: Unnamed::Follows,
        at: |w| &mut w.swing_hz,
        value: |r| r.swing.map(|s| s.frequency_hz),
        range: (|_| [0.1, 10_000.0], ""),
        taken: Some(("that often", |r| r.swing.map_or("", |s| s.from[1]))),
        ..ASK
    },
    WishNumber {
        key: "friction",
        place: "MU",
        words: "Static friction",
        help: " [default: 0.11, by GMN 9050]",
        unnamed: Unnamed::Follows,
        at: |w| &mut w.friction,
        value: |r| Some(r.friction),
        range: (|_| [0.03, 0.5], ""),
        taken: Some(("friction", |r| r.from[0])),
        ..ASK
    },
    WishNumber {
        key: "engagements",
        words: "Engagements in its life, at nominal torque: written into [life], for the command life",
        question: Some(" (none: not said)"),
        of_purpose: true,
        at: |w| &mut w.engagements,
        value: |r| r.engagements,
        range: (|_| [1.0, 1e15], ""),
        ..ASK
    },
];

/// The number of that key.
pub fn asked(key: &str) -> Option<&'static WishNumber> {
    static ALL: [WishNumber; ASKED.len()] = ASKED;
    ALL.iter().find(|row| row.key == key)
}

impl WishNumber {
    /// What holds where it is not named, in its unit.
    pub fn default(&self, wanted: &Requirements) -> Option<f64> {
        let value = (self.value)(wanted).filter(|v| v.is_finite()).map(|si| self.unit.typed(si));
        match self.unnamed {
            Unnamed::Nothing => None,
            Unnamed::Follows => value,
            Unnamed::FollowsOrZero => value.or(Some(0.0)),
        }
    }

    /// Refuse what `wanted` has of it.
    ///
    /// # Errors
    /// [`BadRequirement`] of this number.
    pub fn check(&self, wanted: &Requirements) -> Result<(), BadRequirement> {
        (self.value)(wanted).map_or(Ok(()), |si| self.check_value(si, wanted))
    }

    /// Refuse a value, SI, beside the others of `wanted`.
    pub(super) fn check_value(&self, si: f64, wanted: &Requirements) -> Result<(), BadRequirement> {
        let ([least, most], why) = ((self.range.0)(wanted), self.range.1);
        let typed = self.unit.typed(si);
        // NaN is in no range; rounding of the units is.
        if typed >= least * (1.0 - 1e-9) && typed <= most * (1.0 + 1e-9) {
            return Ok(());
        }
        Err(BadRequirement {
            what: self.key,
            found: self.unit.words(typed, 12),
            allowed: format!("{} to {}{why}", rounded(least, 12), self.unit.words(most, 12)),
        })
    }

    /// Its words in the list of what was taken, the value and where it comes from; `None`: somebody named it, or it is not in force.
    pub(super) fn taken(&self, wanted: &Requirements) -> Option<(&'static str, String, &'static str)> {
        let (words, from) = self.taken?;
        let value = (self.value)(wanted)?;
        let from = from(wanted);
        (from != NAMED).then(|| (words, self.unit.words(self.unit.typed(value), 6), from))
    }
}
