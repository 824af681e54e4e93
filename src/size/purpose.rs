//! What clutches are for, and what is taken of each where nobody says: every number once, with its source or "guess".

use super::{Requirements, TorqueSwing};
use crate::design::{DraftScene, ENGAGE, OVERRUN, SWING, rad_s, rpm};
use crate::numeric::rounded;
use std::f64::consts::TAU;

/// A number and where it comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Given {
    /// Value, in the unit that its field names.
    pub value: f64,
    /// A source, or a guess that says so.
    pub from: &'static str,
}

/// A torque that swings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Excitation {
    /// Amplitude over nominal torque, which the crest reaches.
    pub share: Given,
    /// Frequency, Hz.
    pub frequency_hz: Given,
}

/// A kind of drive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Purpose {
    /// As `new --for` takes it.
    pub name: &'static str,
    /// What the clutch does there.
    pub words: &'static str,
    /// Peak over nominal torque.
    pub peak_over_nominal: Given,
    /// Static friction.
    pub friction: Given,
    /// Speeds of the inner and of the outer race in overrun, rpm.
    pub overrun_rpm: [Given; 2],
    /// Speed of the outer race up to which the sprags keep contact, rpm.
    pub keep_contact_rpm: Given,
    /// Speed of the outer race by which they are off, rpm; `None`: they stay on.
    pub lift_off_rpm: Option<Given>,
    /// How the torque swings, where it does.
    pub excitation: Option<Excitation>,
    /// How fast the inner race still runs ahead when it is reversed to engage, rpm.
    pub free_run_rpm: Given,
    /// Torque that reverses it, over nominal torque.
    pub reversing_share: Given,
    /// Commands that answer what such a drive asks next, beside those of every clutch.
    pub ask: &'static [&'static str],
}

const fn guess(value: f64) -> Given {
    Given { value, from: "guess" }
}

const GMN_FRICTION: Given = Given { value: super::FRICTION, from: "GMN 9050" };

/// All of them.
pub const PURPOSES: [Purpose; 5] = [
    Purpose {
        name: "starter",
        words: "cranks an engine, which then overruns it: the sprags are off above idle",
        peak_over_nominal: Given { value: 1.4, from: "guess: a cold engine" },
        friction: GMN_FRICTION,
        overrun_rpm: [
            Given { value: 0.0, from: "the starter rests" },
            Given { value: 900.0, from: "guess: idle" },
        ],
        keep_contact_rpm: Given { value: 250.0, from: "guess: cranking" },
        lift_off_rpm: Some(Given { value: 900.0, from: "guess: idle" }),
        excitation: Some(Excitation {
            share: Given { value: 0.4, from: "guess: compression strokes" },
            frequency_hz: Given { value: 8.0, from: "guess: four cylinders cranked at 250 rpm" },
        }),
        free_run_rpm: guess(50.0),
        reversing_share: guess(0.1),
        ask: &["simulate"],
    },
    Purpose {
        name: "backstop",
        words: "lets a shaft run one way and holds its load when the drive stops",
        peak_over_nominal: Given { value: 1.6, from: "guess: load that falls back" },
        friction: GMN_FRICTION,
        overrun_rpm: [
            Given { value: 100.0, from: "guess: the shaft" },
            Given { value: 0.0, from: "the outer race is held" },
        ],
        keep_contact_rpm: Given { value: 0.0, from: "the outer race is held" },
        lift_off_rpm: None,
        excitation: None,
        free_run_rpm: Given { value: 5.0, from: "guess: the shaft comes to rest first" },
        reversing_share: guess(0.2),
        ask: &["reengage"],
    },
    Purpose {
        name: "indexing",
        words: "feeds in steps, to and fro many times a second: the sprags never leave the race",
        peak_over_nominal: Given { value: 1.5, from: "guess" },
        friction: GMN_FRICTION,
        overrun_rpm: [
            Given { value: 200.0, from: "guess: the back stroke" },
            Given { value: 0.0, from: "the fed shaft rests meanwhile" },
        ],
        keep_contact_rpm: Given { value: 500.0, from: "guess: some reserve above the feed" },
        lift_off_rpm: None,
        excitation: Some(Excitation {
            share: Given { value: 0.45, from: "guess: from nearly nothing to nominal torque" },
            frequency_hz: Given {
                value: 10.0,
                from: "GMN 9050: garter springs follow so many strokes a second",
            },
        }),
        free_run_rpm: Given { value: 20.0, from: "guess: about the turning point" },
        reversing_share: guess(0.1),
        ask: &["feed"],
    },
    Purpose {
        name: "helicopter",
        words: "lets the rotor run on when an engine stops: keeps contact at full speed",
        peak_over_nominal: Given { value: 2.0, from: "guess" },
        friction: GMN_FRICTION,
        overrun_rpm: [
            Given { value: 6000.0, from: "guess: the rotor's side" },
            Given { value: 0.0, from: "guess: the engine has stopped" },
        ],
        keep_contact_rpm: Given { value: 6000.0, from: "guess: full speed, one engine restarted" },
        lift_off_rpm: None,
        excitation: Some(Excitation {
            share: Given { value: 0.1, from: "guess: blades passing" },
            frequency_hz: Given { value: 25.0, from: "guess: blades passing" },
        }),
        free_run_rpm: guess(100.0),
        reversing_share: guess(0.05),
        ask: &["resonance", "reengage"],
    },
    Purpose {
        name: "two-speed",
        words: "carries the lower gear and is overrun in the higher one",
        peak_over_nominal: Given { value: 1.5, from: "guess" },
        friction: GMN_FRICTION,
        overrun_rpm: [
            Given { value: 3000.0, from: "guess: the higher gear" },
            Given { value: 2000.0, from: "guess: the lower gear" },
        ],
        keep_contact_rpm: Given { value: 2000.0, from: "guess: the lower gear" },
        lift_off_rpm: None,
        excitation: Some(Excitation {
            share: Given { value: 0.26, from: "Huang, Liu, Zhao 2017: 6 of 16.8 + 6 Nm" },
            frequency_hz: Given { value: 100.0, from: "guess, as designs/huang2017-multi-arc.toml" },
        }),
        free_run_rpm: Given { value: 300.0, from: "guess, as designs/huang2017-bench.toml" },
        reversing_share: guess(0.1),
        ask: &["resonance"],
    },
];

/// The purpose of that name.
pub fn purpose(name: &str) -> Option<&'static Purpose> {
    PURPOSES.iter().find(|p| p.name.eq_ignore_ascii_case(name))
}

/// Periods of a swing that are computed.
const PERIODS: f64 = 2.0;
/// The same in time at least, s: a fast swing begins with the ringing of the races on the clutch.
const SWINGS_S: f64 = 0.02;

/// Abutment and stop over the clutch's own stiffness: a guess.
pub(super) const STOP: f64 = 10.0;

/// First resonance of the drive on the clutch, Hz: what turns with the inner race follows from it.
pub(super) const DRIVE_HZ: f64 = 25.0;

/// From a sudden torque past the crest of what follows, s: that is half a period of the resonance away.
pub(super) const CREST_S: f64 = 0.75 / DRIVE_HZ;

/// Abutment of a swing over the softer of clutch and drive: it holds the mean torque and leaves the swing to the clutch.
const SOFT: f64 = 0.02;

impl Purpose {
    /// Its scenes for a clutch that does what `wanted` says, its secant stiffness at nominal torque `stiffness_nm_per_rad`, with
    /// `inner_inertia_kg_m2` on the inner race.
    pub(super) fn scenes(
        &self,
        wanted: &Requirements,
        stiffness_nm_per_rad: f64,
        inner_inertia_kg_m2: f64,
    ) -> Vec<DraftScene> {
        let mut scenes = Vec::new();
        if let Some(TorqueSwing { amplitude_nm: amplitude, frequency_hz, from }) = wanted.swing {
            // The outer race is light: its torque C_be goes through the clutch into the drive's inertia J but for what the
            // abutment takes, C_be = T (1 + k_ab/K - k_ab/(J omega^2)).
            let omega = TAU * frequency_hz;
            let abutment = SOFT * stiffness_nm_per_rad.min(inner_inertia_kg_m2 * omega * omega);
            scenes.push(DraftScene {
                scene: SWING,
                why: SWING.words.to_owned(),
                keys: vec![
                    ("preload_nm", wanted.torque_nm - amplitude, "nominal torque less the amplitude"),
                    ("amplitude_nm", amplitude, from[0]),
                    ("frequency_hz", frequency_hz, from[1]),
                    ("abutment_stiffness_nm_per_rad", abutment, "soft: it holds the mean torque alone"),
                    ("duration_s", (PERIODS / frequency_hz).max(SWINGS_S), "two periods, 20 ms at least"),
                    ("speed_rpm", rpm(wanted.keep_contact_rad_s.unwrap_or(0.0)), ""),
                ],
                checked: true,
            });
        }
        let reversing = self.reversing_share.value * wanted.torque_nm;
        // Until the reversed drive has come to rest, then past the crest.
        let stopping_s = inner_inertia_kg_m2 * rad_s(self.free_run_rpm.value) / reversing;
        scenes.push(DraftScene {
            scene: ENGAGE,
            why: ENGAGE.words.to_owned(),
            keys: vec![
                ("free_run_rpm", self.free_run_rpm.value, self.free_run_rpm.from),
                ("reversing_torque_nm", reversing, self.reversing_share.from),
                (
                    "stop_stiffness_nm_per_rad",
                    STOP * stiffness_nm_per_rad,
                    "guess: ten times as stiff as the clutch",
                ),
                ("bench_inertia_kg_m2", 0.0, "none beside the drive's, inner_inertia_kg_m2"),
                ("duration_s", (stopping_s + CREST_S).max(0.02), ""),
            ],
            checked: false,
        });
        scenes.extend(overrun(wanted));
        scenes
    }
}

/// Steady overrun at the speeds that are asked for or taken; none where the races turn as one.
pub(super) fn overrun(wanted: &Requirements) -> Option<DraftScene> {
    let [inner, outer] = wanted.overrun_rad_s.map(rpm);
    (inner != outer).then(|| DraftScene {
        scene: OVERRUN,
        why: format!(
            "Steady overrun: inner race at {} rpm ({}), outer race at {} rpm ({}).",
            rounded(inner, 7),
            wanted.overrun_from[0],
            rounded(outer, 7),
            wanted.overrun_from[1]
        ),
        keys: vec![
            ("speed_rpm", outer, "outer race"),
            ("overrun_rpm", inner - outer, "by how much the inner race is faster; below 0 the outer one is"),
        ],
        checked: false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_has_its_source_or_is_called_a_guess() {
        for p in &PURPOSES {
            let swing = p.excitation.iter().flat_map(|e| [e.share, e.frequency_hz]);
            let given =
                [p.peak_over_nominal, p.friction, p.keep_contact_rpm, p.free_run_rpm, p.reversing_share];
            for g in given.into_iter().chain(p.overrun_rpm).chain(p.lift_off_rpm).chain(swing) {
                assert!(!g.from.is_empty() && g.value >= 0.0, "{}: {g:?}", p.name);
            }
            assert_eq!(purpose(p.name), Some(p));
            // One who takes all of them asks for nothing that contradicts itself.
            assert!(p.lift_off_rpm.is_none_or(|off| off.value > p.keep_contact_rpm.value), "{}", p.name);
        }
    }
}
