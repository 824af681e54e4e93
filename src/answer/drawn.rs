//! What sets the sprags of a design apart, in words.

use crate::clutch::{Sharing, Standing};
use crate::report::{Unit, significant};

/// What chance draws, what the file gives, and how the sprags stand when torque begins, a line each.
pub(super) fn drawn_words(sharing: &Sharing) -> Vec<String> {
    let bounds = [
        ("size ±", sharing.size_within_m, Unit::Micrometre),
        ("gap up to", sharing.gap_up_to_m, Unit::Micrometre),
        ("azimuth ±", sharing.azimuth_within_rad, Unit::Degree),
        ("friction ±", sharing.friction_within, Unit::One),
    ];
    let drawn = bounds.into_iter().filter(|(_, bound, _)| *bound > 0.0);
    let drawn: Vec<String> =
        drawn.map(|(what, bound, unit)| format!("{what} {}", unit.show(bound, 3))).collect();
    let mut all = vec![match drawn.is_empty() {
        true => "Nothing is drawn by chance".to_owned(),
        false => format!("Drawn by chance from seed {}: {}", sharing.seed, drawn.join(", ")),
    }];
    let given: Vec<String> = sharing.given.iter().map(|g| (g.index + 1).to_string()).collect();
    if !given.is_empty() {
        all.push(format!(
            "As the file gives them, not drawn: what [sharing] says of sprags {}",
            given.join(", ")
        ));
    }
    let sprung: Vec<String> = sharing
        .given
        .iter()
        .filter_map(|g| Some(format!("{} ({})", g.index + 1, significant(g.spring?, 3))))
        .collect();
    if !sprung.is_empty() {
        all.push(format!(
            "Springs over that as drawn: {}; scenes feel that; for statics set missing = true for a sprag that does not catch",
            sprung.join(", ")
        ));
    }
    all.extend(sharing.tracks.iter().map(|track| {
        format!(
            "{} track out of round as made: {} lobes of {}",
            if track.outer { "Outer" } else { "Inner" },
            track.lobes,
            Unit::Micrometre.show(track.amplitude_m, 3)
        )
    }));
    all.push(match sharing.start {
        Standing::Sprung => {
            "When torque begins, each sprag's spring has turned it until it touches both races".to_owned()
        }
        Standing::Caged => {
            "When torque begins, a cage holds all sprags at one angle: larger ones take load earlier"
                .to_owned()
        }
    });
    all
}
