//! A clutch as it may be made: every quantity with a tolerance somewhere in its range.

use crate::clutch::{Clutch, InnerArc, Tolerances};
use crate::design::Design;
use crate::profile::ProfileError;

/// Names of the tolerances, in the order of a corner's shares.
pub const TOLERANCES: [&str; 7] = [
    "inner race radius",
    "outer race radius",
    "sprag outer radius",
    "sprag inner radii",
    "run-out",
    "friction",
    "temperature",
];

/// A place in the box of the tolerances: each quantity's share of its half range, -1 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// Half ranges.
    pub of: Tolerances,
    /// Shares, in the order of [`TOLERANCES`].
    pub shares: [f64; 7],
}

impl Corner {
    /// As drawn.
    pub const NOMINAL: Self = Self {
        of: Tolerances {
            inner_race_radius_m: 0.0,
            outer_race_radius_m: 0.0,
            sprag_outer_radius_m: 0.0,
            sprag_inner_radius_m: 0.0,
            run_out_m: 0.0,
            friction: 0.0,
            temperature_k: 0.0,
            expansion_per_k: 0.0,
        },
        shares: [0.0; 7],
    };

    /// Whether nothing is off.
    pub fn is_nominal(&self) -> bool {
        self.shares.iter().all(|s| *s == 0.0)
    }

    /// Such as `+inner race radius -friction`; what has no tolerance is not named.
    pub fn name(&self) -> String {
        let named = TOLERANCES.iter().zip(self.shares).zip(half_ranges(&self.of));
        let words: Vec<String> = named
            .filter(|((_, share), half)| *share != 0.0 && *half > 0.0)
            .map(|((name, share), _)| {
                if share.abs() == 1.0 {
                    format!("{}{name}", if share > 0.0 { '+' } else { '-' })
                } else {
                    format!("{share:+.3} {name}")
                }
            })
            .collect();
        if words.is_empty() { "nominal".to_owned() } else { words.join(" ") }
    }
}

/// Half ranges in the order of [`TOLERANCES`].
pub fn half_ranges(t: &Tolerances) -> [f64; 7] {
    [
        t.inner_race_radius_m,
        t.outer_race_radius_m,
        t.sprag_outer_radius_m,
        t.sprag_inner_radius_m,
        t.run_out_m,
        t.friction,
        t.temperature_k,
    ]
}

/// Every corner of the box: each quantity with a tolerance at either end.
pub fn corners(of: &Tolerances) -> Vec<Corner> {
    let free: Vec<usize> = (0..7).filter(|&i| half_ranges(of)[i] > 0.0).collect();
    (0..1_usize << free.len())
        .map(|bits| {
            let mut shares = [0.0; 7];
            for (k, &i) in free.iter().enumerate() {
                shares[i] = if bits >> k & 1 == 0 { -1.0 } else { 1.0 };
            }
            Corner { of: *of, shares }
        })
        .collect()
}

/// The design with every clutch of its scenarios made as `corner` says.
///
/// # Errors
/// [`ProfileError`] where the sprag no longer spans the gap.
pub fn perturbed(design: &Design, corner: &Corner) -> Result<Design, ProfileError> {
    let mut made = design.clone();
    made.clutch = made_as(&design.clutch, corner)?;
    for scenario in &mut made.scenarios {
        scenario.clutch = made_as(&scenario.clutch, corner)?;
    }
    Ok(made)
}

/// The sprag keeps its body, mass and centroid; what first contact, turns and the body frame are follows from the gap.
fn made_as(clutch: &Clutch, corner: &Corner) -> Result<Clutch, ProfileError> {
    let (t, s) = (&corner.of, &corner.shares);
    let mut made = clutch.clone();
    let races = &mut made.races;
    races.inner_radius_m += s[0] * t.inner_race_radius_m;
    races.inner_radius_m *= 1.0 + s[6] * t.temperature_k * t.expansion_per_k;
    races.outer_radius_m += s[1] * t.outer_race_radius_m + s[4] * t.run_out_m;
    let (inner, outer) = (races.inner_radius_m, races.outer_radius_m);
    let body = clutch.profile()?;
    let seat = body.reseated(s[2] * t.sprag_outer_radius_m, s[3] * t.sprag_inner_radius_m, inner, outer)?;
    let sprags = &mut made.sprags;
    sprags.outer_radius_m = seat.outer_radius_m;
    sprags.centre_distance_m = seat.centre_distance_m;
    sprags.inner_arcs =
        seat.arcs.iter().map(|&(radius_m, until_rad)| InnerArc { radius_m, until_rad }).collect();
    // Other arcs than those of the spiral.
    sprags.spiral = None;
    sprags.centroid_m = seat.point_m(sprags.centroid_m);
    sprags.flanks = sprags.flanks.and_then(|f| seat.flanks(&body, &f));
    let friction = &mut made.friction;
    let factor = 1.0 + s[5] * t.friction / friction.static_;
    friction.static_ *= factor;
    friction.kinetic *= factor;
    Ok(made)
}
