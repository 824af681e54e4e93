//! What slip does to its surfaces, in words.

use crate::answer::left_out::LeftOut;
use crate::report::{Unit, significant};
use crate::scenario::Simulation;

/// Peclet number below which heat goes sideways too, and a flash by heat that goes straight in is too hot.
const FAST: f64 = 5.0;

/// A sentence for each contact that has slipped.
pub(super) fn lines(s: &Simulation) -> Vec<String> {
    let contacts = ["inner", "outer"].into_iter().enumerate();
    contacts.filter_map(|(contact, name)| line(s, contact, name)).collect()
}

fn line(s: &Simulation, contact: usize, name: &str) -> Option<String> {
    let (whole, worst) = (s.slipped(contact)?, s.slip_heat[contact]?.worst);
    let mut flash = Unit::Kelvin.show(whole.flash_k, 3);
    if whole.peclet < FAST {
        let peclet = significant(whole.peclet, 2);
        flash = format!("below {flash} (Peclet number {peclet}: heat goes sideways too)");
    }
    let wear = match s.wear_m(contact).map(|depths| depths.map(|m| Unit::Micrometre.show(m, 3))) {
        Some([sprag, race]) => format!("wears at most {sprag} off the sprag, {race} off the race under it"),
        None => "wear is not known without [lubrication]".to_owned(),
    };
    Some(format!(
        "Slip at the {name} contact, per sprag: {} of friction, {} of it in the worst slip ({} in {} from {} on), at most {} or {}; \
         flash {flash}; {wear}",
        Unit::Joule.show(whole.work_j, 3),
        Unit::Joule.show(worst.work_j, 3),
        Unit::Micrometre.show(worst.path_m, 3),
        Unit::Millisecond.show(worst.time_s, 3),
        Unit::Millisecond.show(worst.from_s, 4),
        Unit::Watt.show(whole.power_w, 3),
        Unit::WattPerSquareMillimetre.show(whole.flux_w_m2, 3),
    ))
}

/// What the motion does not feel of it, where something has slipped.
pub(super) fn left_out(s: &Simulation) -> Option<LeftOut> {
    let flash_k =
        [0, 1].into_iter().filter_map(|contact| s.slipped(contact)).map(|w| w.flash_k).reduce(f64::max)?;
    Some(LeftOut::new(
        "what heat and wear of slip do to the motion",
        "both are computed from the slip found; friction and shape stay those of cold, new surfaces",
        &format!("not estimated; the flash is {}", Unit::Kelvin.show(flash_k, 2)),
    ))
}
