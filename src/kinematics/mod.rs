//! Plane geometry of one sprag between two races: lengths (8), angles (9), levers (14), rolling (A.1)-(A.6).
//!
//! In: approaches and growths. Out: lengths, angles, levers, rolling ratios, with derivatives (duals).
//! Absent: forces and elastic laws. Equations: (8), (9), (14), (A.1)-(A.6).
//!
//! # Conventions
//! Azimuths grow in the direction in which A lies ahead of B. gamma is signed: azimuth of C_e ahead of G.

use crate::numeric::dual::Dual;

/// Lengths of (8), m.
#[derive(Debug, Clone, Copy)]
pub struct Lengths {
    /// OA.
    pub oa: Dual,
    /// OB.
    pub ob: Dual,
    /// OC_i.
    pub oc_i: Dual,
    /// OC_e.
    pub oc_e: Dual,
}

/// Radii that (8) starts from, m.
#[derive(Debug, Clone, Copy)]
pub struct Radii {
    /// Inner track R_i.
    pub inner_race_m: f64,
    /// Outer track R_e.
    pub outer_race_m: f64,
    /// Inner arc r_i.
    pub inner_arc_m: f64,
    /// Outer arc r_e.
    pub outer_arc_m: f64,
}

/// Deformations of one sprag's contacts, m; all positive under load.
#[derive(Debug, Clone, Copy)]
pub struct Deformations {
    /// delta_BI, inner race shrinks.
    pub race_inner: Dual,
    /// delta_BE, outer race grows.
    pub race_outer: Dual,
    /// delta_HI.
    pub contact_inner: Dual,
    /// delta_HE.
    pub contact_outer: Dual,
    /// delta_g, body compression.
    pub body: Dual,
    /// What the sprag's outline gives under the force at A beyond the body that the law of its contacts holds
    /// (`src/wedge/bulk.rs`); 0 for laws that add none.
    pub bulk: Dual,
    /// delta_ce, centrifugal growth of the outer race.
    pub growth_m: f64,
}

/// Eq. (8), with delta_ce in OC_e as well: the race grows whether or not it is loaded (the paper prints it
/// only in OB; (A.3) has it).
#[doc(alias = "Eq. (8)")]
pub fn lengths(r: &Radii, d: &Deformations) -> Lengths {
    Lengths {
        oa: -(d.race_inner + d.contact_inner * 0.5) + r.inner_race_m,
        ob: d.race_outer + d.contact_outer * 0.5 + (r.outer_race_m + d.growth_m),
        oc_i: -(d.race_inner + d.body * 0.5 + d.contact_inner + d.bulk) + (r.inner_race_m + r.inner_arc_m),
        oc_e: d.race_outer + d.body * 0.5 + d.contact_outer + (r.outer_race_m - r.outer_arc_m + d.growth_m),
    }
}

/// OA and OB where the bodies roll on their unstrained circumferences: the pitch points, which part OC_i as R_i : r_i and
/// OC_e as R_e : r_e. `effective_m`: R of 1/R = 1/R_i + 1/r_i at A and of 1/R = 1/r_e - 1/R_e at B, m.
///
/// A surface comes to a contact unstrained but for the growth of its ring, so ds = R dtheta - r dOmega says how far
/// rolling is missed, and the work that it takes is a force times ds: its moments about the two axes are as R to r, so
/// it crosses the line of centres at a pitch point. (8) takes the middle of the approach, which would hold if the patch
/// did not give along the track (`src/wedge/rolling.rs`).
pub fn pitch_points(r: &Radii, d: &Deformations, effective_m: [Dual; 2]) -> [Dual; 2] {
    let [inner, outer] = effective_m;
    let share_inner = -(inner * r.inner_race_m.recip()) + 1.0;
    let share_outer = outer * r.outer_race_m.recip() + 1.0;
    [
        -(d.race_inner + d.contact_inner * share_inner) + r.inner_race_m,
        d.race_outer + d.contact_outer * share_outer + (r.outer_race_m + d.growth_m),
    ]
}

/// Triangle O C_i C_e: sine and cosine of beta, azimuth of C_i ahead of C_e.
///
/// Eq. (9), second line, as sin^2(beta/2) = (C_iC_e^2 - (OC_i - OC_e)^2)/(4 OC_i OC_e), which keeps the digits
/// that the printed acos loses at small beta. `None`: the centres cannot be that far apart, the sprag has
/// rolled over.
#[doc(alias = "Eq. (9)")]
pub fn beta(l: &Lengths, centre_distance_m: f64) -> Option<(Dual, Dual)> {
    let gap = l.oc_i - l.oc_e;
    let half = (-(gap * gap) + centre_distance_m * centre_distance_m) / (l.oc_i * l.oc_e * 4.0);
    if !(half.v > 0.0 && half.v < 0.5) {
        return None;
    }
    let sin = (half * (-half + 1.0)).sqrt() * 2.0;
    Some((sin, half * (-2.0) + 1.0))
}

/// The same where the inner race's axis O_i lies off that of the outer race, O: at `offset_m` = (along OC_e outward,
/// across it towards positive azimuth), m. OC_i counts from O_i, OC_e from O, and beta is the azimuth of the normal at A
/// ahead of that at B: the triangle O_i C_i C_e, turned by the azimuth of C_e seen from O_i.
pub fn beta_off_centre(l: &Lengths, centre_distance_m: f64, offset_m: [Dual; 2]) -> Option<(Dual, Dual)> {
    let [along, across] = offset_m;
    if along.v == 0.0 && across.v == 0.0 {
        return beta(l, centre_distance_m);
    }
    let x = l.oc_e - along;
    let reach = (x * x + across * across).sqrt();
    let (sin, cos) = beta(&Lengths { oc_e: reach, ..*l }, centre_distance_m)?;
    let (sin_t, cos_t) = (across / reach, x / reach);
    Some((sin * cos_t - cos * sin_t, cos * cos_t + sin * sin_t))
}

/// The centroid seen from O.
#[derive(Debug, Clone, Copy)]
pub struct Centroid {
    /// OC_g, m.
    pub oc_g: Dual,
    /// gamma, azimuth of C_e ahead of G, rad, signed.
    pub gamma: Dual,
}

/// OC_g and the signed gamma when the body has turned by `rotation` about C_e against the line OC_e.
///
/// Eq. (9), third line: an acos cannot give the sign, and for Table 1 gamma is -0.725 deg. Its first line,
/// theta_i - alpha = angle OC_gC_i, is not needed: alpha follows from the rotation. It prints a^2 over 2 C_iC_g OC_g;
/// a is C_iC_g.
#[doc(alias = "Eq. (9)")]
pub fn centroid(centroid_m: [f64; 2], oc_e: Dual, rotation: Dual) -> Centroid {
    centroid_from(polar(centroid_m), oc_e, rotation)
}

/// Distance from C_e, m, and azimuth there, rad, of a point of the body.
pub(crate) fn polar(point_m: [f64; 2]) -> [f64; 2] {
    [point_m[0].hypot(point_m[1]), point_m[0].atan2(point_m[1])]
}

/// [`centroid`] of one that lies so ([`polar`]).
pub(crate) fn centroid_from([reach, azimuth]: [f64; 2], oc_e: Dual, rotation: Dual) -> Centroid {
    let (s, c) = (rotation + azimuth).sin_cos();
    let (x, y) = (s * reach, c * reach + oc_e);
    Centroid { oc_g: (x * x + y * y).sqrt(), gamma: -x.atan2(y) }
}

/// Levers (14), m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Levers {
    /// b_i = OC_g cos(beta + gamma) - OA.
    pub b_i: f64,
    /// b_e = OB - OC_g cos gamma.
    pub b_e: f64,
    /// h_i = OC_g sin(beta + gamma).
    pub h_i: f64,
    /// h_e = OC_g sin gamma.
    pub h_e: f64,
}

/// Eq. (14).
#[doc(alias = "Eq. (14)")]
pub fn levers(oa: f64, ob: f64, oc_g: f64, beta_gamma: f64, gamma: f64) -> Levers {
    Levers {
        b_i: oc_g * beta_gamma.cos() - oa,
        b_e: ob - oc_g * gamma.cos(),
        h_i: oc_g * beta_gamma.sin(),
        h_e: oc_g * gamma.sin(),
    }
}

/// Rolling ratios (rho_i, rho_e), pure numbers: stick at A means d theta_bi = d phi - rho_i d alpha, at B
/// d theta_be = d phi + rho_e d alpha, so windup falls by (rho_i + rho_e) d alpha.
///
/// Eq. (A.4), Eq. (A.5), Eq. (A.6), with the radial motion OC_g' of the reference point that (A.3) drops
/// (without it a static windup would depend on where G lies), and with plus signs: A and B lie on opposite
/// sides of G, and OB grows under load. The paper prints minus signs in (A.5), (A.6) and in (A.5)'s OB.
#[doc(alias = "Eq. (A.4)")]
#[doc(alias = "Eq. (A.5)")]
#[doc(alias = "Eq. (A.6)")]
pub fn rolling_ratios(
    oa: f64,
    ob: f64,
    oc_g: f64,
    oc_g_slope: f64,
    beta_gamma: f64,
    gamma: f64,
) -> (f64, f64) {
    let l = levers(oa, ob, oc_g, beta_gamma, gamma);
    ((l.b_i + oc_g_slope * beta_gamma.sin()) / oa, (l.b_e - oc_g_slope * gamma.sin()) / ob)
}

/// Tangential velocity of the race relative to the sprag at A, m/s: zero in pure rolling.
///
/// Eq. (A.1), Eq. (A.2), Eq. (A.3): v_A = OA theta_bi' - (OA phi' - b_i* alpha') with b_i* = rho_i OA. The first
/// term of (A.3) must be OC_g phi' along x_G with G's radial velocity OC_g' alpha' beside it, not OC_e phi' along
/// x_B: only then (A.4) follows.
#[doc(alias = "Eq. (A.1)")]
#[doc(alias = "Eq. (A.2)")]
#[doc(alias = "Eq. (A.3)")]
pub fn slip_velocity_inner(oa: f64, rho_i: f64, alpha_rate: f64, phi_rate: f64, race_rate: f64) -> f64 {
    oa * (race_rate - phi_rate + rho_i * alpha_rate)
}

/// The same at B: v_B = OB theta_be' - (OB phi' + b_e* alpha').
pub fn slip_velocity_outer(ob: f64, rho_e: f64, alpha_rate: f64, phi_rate: f64, race_rate: f64) -> f64 {
    ob * (race_rate - phi_rate - rho_e * alpha_rate)
}
