//! What comes after the end of a curve, by its keys in JSON and in words: of `stiffness`, and of a scene that goes there.

use crate::report::{Unit, significant};
use crate::scenario::{Beyond, Fate};
use crate::wedge::{OverEnd, OverPoint, RollOver};
use serde::Serialize;

/// A place on the way over the sprags' highest place.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct OverBody {
    /// Windup, deg.
    pub windup_deg: f64,
    /// Torque of equilibrium, N m; below 0 the sprags drive the races on.
    pub torque_nm: f64,
    /// Normal force of one sprag at the inner contact, N.
    pub normal_inner_n: f64,
    /// Tangential over normal force there: with less friction the contact slips before.
    pub tan_omega: f64,
    /// Energy stored in contacts, races and sprags, J.
    pub stored_j: f64,
}

/// What comes after the end of a curve.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RollOverBody {
    /// Where the torque is largest.
    pub peak: OverBody,
    /// Where the sprags stand upright, without torque and under the largest force.
    pub upright: Option<OverBody>,
    /// Where the torque is least; as much turned the other way brings them back.
    pub least: OverBody,
    /// Where the way ends.
    pub last: OverBody,
    /// `contact-lost`, `on-flank` or `no-convergence`.
    pub end: &'static str,
    /// The way from the end of the curve on.
    pub branch: Vec<OverBody>,
}

/// A scene that went beyond the end of its curve.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BeyondBody {
    /// `rolled-over`, `came-back`, `on-the-way` or `not-known`.
    pub fate: &'static str,
    /// When the run ended: contact lost, the end of the scene, s.
    pub t_s: f64,
    /// Speed of the races against one another then, rad/s; positive in the sense of the windup.
    pub speed_rad_s: f64,
    /// Torque of the sprags then, N m.
    pub torque_nm: f64,
    /// By how much a coarser run has the three; absent where it meets another fate.
    pub error_estimates: Option<[f64; 3]>,
    /// The way, as equilibria at the scene's mean speed have it.
    pub way: RollOverBody,
}

impl OverBody {
    fn of(p: &OverPoint) -> Self {
        Self {
            windup_deg: Unit::Degree.from_si(p.windup_rad),
            torque_nm: p.torque_nm,
            normal_inner_n: p.normal_inner_n,
            tan_omega: p.tan_omega,
            stored_j: p.stored_j,
        }
    }
}

impl RollOverBody {
    /// Of the way over.
    pub fn of(way: &RollOver) -> Self {
        Self {
            peak: OverBody::of(&way.peak),
            upright: way.upright.as_ref().map(OverBody::of),
            least: OverBody::of(&way.least),
            last: OverBody::of(&way.last),
            end: way.end.name(),
            branch: way.branch.iter().map(OverBody::of).collect(),
        }
    }
}

impl BeyondBody {
    /// Of a scene.
    pub fn of(beyond: &Beyond) -> Self {
        Self {
            fate: beyond.fate.name(),
            t_s: beyond.t_s,
            speed_rad_s: beyond.speed_rad_s,
            torque_nm: beyond.torque_nm,
            error_estimates: beyond.error,
            way: RollOverBody::of(&beyond.way),
        }
    }
}

/// What the sprags do after the end of the curve, in a sentence.
pub(super) fn sentence(way: &RollOver) -> String {
    let (nm, deg) = (|x: f64| Unit::NewtonMetre.show(x, 4), |x: f64| Unit::Degree.show(x, 4));
    let mut said = format!(
        "beyond it the torque is {} at most, at a windup of {} with {} stored, if there is a friction of {}",
        nm(way.peak.torque_nm),
        deg(way.peak.windup_rad),
        Unit::Joule.show(way.peak.stored_j, 3),
        significant(way.peak.tan_omega, 3)
    );
    if let Some(upright) = &way.upright {
        said += &format!(
            "; it falls to nothing at {}, where the sprags stand upright under {} each",
            deg(upright.windup_rad),
            Unit::Newton.show(upright.normal_inner_n, 4)
        );
    }
    if way.least.torque_nm < 0.0 {
        said += &format!("; from there they drive the races on, with up to {}", nm(-way.least.torque_nm));
    }
    let until = deg(way.last.windup_rad);
    said += &match way.end {
        OverEnd::ContactLost => format!(", until contact is lost at {until}"),
        OverEnd::OnFlank => format!(", until a flank lies on its race at {until}"),
        OverEnd::NoConvergence => format!("; no equilibrium was found beyond {until}"),
    };
    if way.least.torque_nm < 0.0 {
        said += &format!("; {} the other way brings them back", nm(-way.least.torque_nm));
    }
    said
}

/// What became of a scene that went there, in a sentence.
pub(super) fn followed(beyond: &Beyond) -> String {
    let at = Unit::Second.show(beyond.t_s, 4);
    match beyond.fate {
        Fate::RolledOver => {
            let torque = Unit::NewtonMetre.show(beyond.way.last.torque_nm.max(0.0), 3);
            format!(
                "the sprags roll over: at {at} {}, {torque} remain and the races run through at {} against one another; \
                 {} the other way would bring them back",
                if beyond.way.end == OverEnd::ContactLost {
                    "contact is lost"
                } else {
                    "the way ends on a flank"
                },
                Unit::Rpm.show(beyond.speed_rad_s, 4),
                Unit::NewtonMetre.show((-beyond.way.least.torque_nm).max(0.0), 4)
            )
        }
        Fate::CameBack => format!("the load falls in time: the sprags are back when the scene ends, at {at}"),
        Fate::OnTheWay => format!("the scene ends at {at} with the sprags on their way over"),
        Fate::NotKnown => format!("what becomes of the sprags is not known beyond {at}"),
    }
}
