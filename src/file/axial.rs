//! How sprag and race lie along the axis.
//!
//! In: lengths, `[contact]`'s end profile, tilt, offset, slices. Out: [`Axial`], SI. Absent: what the shapes do to
//! the contact. Equations: none.

use super::contact_file::{EndKindFile, EndProfileFile};
use super::design_file::DesignFile;
use super::findings::Findings;
use crate::clutch::{Axial, EndProfile};
use crate::design::m;

const PROFILE: &str = "contact.end_profile";
/// Fewest slices that know a shape: of fewer, each is a step in the force.
const FEWEST_SLICES: usize = 10;

fn um(um: f64) -> f64 {
    um / 1e6
}

/// The axial arrangement of a file, or `None` with the reasons in `out`.
pub(super) fn axial(file: &DesignFile, out: &mut Findings) -> Option<Axial> {
    let contact = &file.contact;
    let before = out.problems.len();
    let offset_mm = contact.axial_offset_mm.unwrap_or(0.0);
    let reach_mm = 0.5 * (file.sprags.length_mm + file.races.width_mm);
    if offset_mm.abs() >= reach_mm {
        out.refuse(
            &["contact.axial_offset_mm", "sprags.length_mm", "races.width_mm"],
            format!("less than {reach_mm} mm either way: beyond that the sprag lies beside the races"),
            "bring the sprags back onto the races".to_owned(),
        );
    }
    let slices = contact.slices.unwrap_or(Axial::STRAIGHT.slices);
    let tilt_rad = contact.tilt_mrad.unwrap_or(0.0) / 1e3;
    let end_profile = match &contact.end_profile {
        Some(profile) => end_profile(profile, file.sprags.length_mm, out)?,
        None => EndProfile::Square,
    };
    let axial = Axial { slices, end_profile, tilt_rad, offset_m: m(offset_mm) };
    if !axial.is_straight() && slices < FEWEST_SLICES {
        out.refuse(
            &["contact.slices", PROFILE, "contact.tilt_mrad"],
            format!("at least {FEWEST_SLICES} with an end profile or a tilt"),
            "take more slices, or remove the key: 60 is the default".to_owned(),
        );
    }
    (out.problems.len() == before).then_some(axial)
}

/// Keys beside `kind` that a kind reads.
fn keys(kind: EndKindFile) -> &'static [&'static str] {
    match kind {
        EndKindFile::Square => &[],
        EndKindFile::Lundberg => &["design_load_n"],
        EndKindFile::Crown => &["radius_mm"],
        EndKindFile::EndRelief => &["length_mm", "radius_mm"],
        EndKindFile::FujiwaraKawase => &["design_load_n", "load_factor", "crowned_ratio", "end_drop_um"],
        EndKindFile::Table => &["points"],
    }
}

fn end_profile(file: &EndProfileFile, sprag_length_mm: f64, out: &mut Findings) -> Option<EndProfile> {
    let given = [
        ("design_load_n", file.design_load_n.is_some()),
        ("radius_mm", file.radius_mm.is_some()),
        ("length_mm", file.length_mm.is_some()),
        ("load_factor", file.load_factor.is_some()),
        ("crowned_ratio", file.crowned_ratio.is_some()),
        ("end_drop_um", file.end_drop_um.is_some()),
        ("points", file.points.is_some()),
    ];
    let before = out.problems.len();
    for (name, is_given) in given {
        let key = format!("{PROFILE}.{name}");
        let kind = format!("{PROFILE}.kind");
        match (is_given, keys(file.kind).contains(&name)) {
            (true, false) => out.refuse(
                &[&key, &kind],
                format!("no {name} with this kind"),
                format!("remove {name}, or name a kind that reads it"),
            ),
            (false, true) => out.refuse(
                &[&kind, &key],
                format!("together with {name}, which is missing"),
                format!("add {name} = ... to end_profile"),
            ),
            _ => {}
        }
    }
    if let Some(points) = &file.points {
        for (k, pair) in points.windows(2).enumerate() {
            if pair[1].y_mm <= pair[0].y_mm {
                out.refuse(
                    &[&format!("{PROFILE}.points[{}].y_mm", k + 1), PROFILE],
                    format!("more than that of the point before, {} mm", pair[0].y_mm),
                    "list the points from one end of the sprag to the other".to_owned(),
                );
            }
        }
        let half = 0.5 * sprag_length_mm;
        let slack = 1e-9 * half;
        if let [first, .., last] = points.as_slice()
            && (first.y_mm > -half + slack || last.y_mm < half - slack)
        {
            out.refuse(
                &[&format!("{PROFILE}.points"), "sprags.length_mm"],
                format!("points from {} to {half} mm: the whole length of the sprag", -half),
                "measure y from the middle of the sprag and add points at its ends".to_owned(),
            );
        }
    }
    let shortest = match file.kind {
        EndKindFile::Crown => Some((0.5 * sprag_length_mm, "half the sprag's length")),
        EndKindFile::EndRelief => file.length_mm.map(|l| (l, "length_mm")),
        _ => None,
    };
    if let (Some((least, what)), Some(radius)) = (shortest, file.radius_mm)
        && radius < least
    {
        out.refuse(
            &[&format!("{PROFILE}.radius_mm"), PROFILE],
            format!("at least {what}, {least} mm"),
            "give the radius in the plane of the axis; crowns of a few um have metres".to_owned(),
        );
    }
    if let Some(length) = file.length_mm
        && length > 0.5 * sprag_length_mm
    {
        out.refuse(
            &[&format!("{PROFILE}.length_mm"), "sprags.length_mm"],
            format!("at most half the sprag's length, {} mm", 0.5 * sprag_length_mm),
            "shorten the relieved part, or use kind = \"crown\"".to_owned(),
        );
    }
    if out.problems.len() > before {
        return None;
    }
    Some(match file.kind {
        EndKindFile::Square => EndProfile::Square,
        EndKindFile::Lundberg => EndProfile::Lundberg { design_load_n: file.design_load_n? },
        EndKindFile::Crown => EndProfile::Crown { radius_m: m(file.radius_mm?) },
        EndKindFile::EndRelief => {
            EndProfile::EndRelief { length_m: m(file.length_mm?), radius_m: m(file.radius_mm?) }
        }
        EndKindFile::FujiwaraKawase => EndProfile::FujiwaraKawase {
            design_load_n: file.design_load_n?,
            load_factor: file.load_factor?,
            crowned_ratio: file.crowned_ratio?,
            end_drop_m: um(file.end_drop_um?),
        },
        EndKindFile::Table => EndProfile::Table {
            points_m: file.points.as_ref()?.iter().map(|p| [m(p.y_mm), um(p.drop_um)]).collect(),
        },
    })
}
