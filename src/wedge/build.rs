//! From a clutch to its wedge curve: arc after arc, each handed over at a junction by the paper's Figure 5.

use super::apart::SpragDeviation;
use super::closure::{FIRST_CONTACT_N, Statics};
use super::curve::{EndReason, NoCurve, WedgeCurve};
use super::elastic::Elastic;
use super::patch::InnerCurvature;
use super::quick::TRUSTED;
use super::table::{ArcBuilder, ArcTable};
use crate::clutch::{Carrier, Clutch};
use crate::contact::element_share;
use crate::numeric::root;
use crate::profile::Profile;
use std::sync::{Arc, OnceLock};

impl WedgeCurve {
    /// Build the curve of `clutch` at mean speed `speed_rad_s`.
    ///
    /// # Errors
    /// [`NoCurve`] where there is no first contact. A curve that ends early is a result, see [`Self::end`].
    pub fn build(clutch: &Clutch, profile: &Profile, speed_rad_s: f64) -> Result<Self, NoCurve> {
        Self::build_with(clutch, profile, speed_rad_s, InnerCurvature::Patch)
    }

    /// The same with a choice of the curvature at A; [`InnerCurvature::Pointwise`] is the paper's, for comparison.
    ///
    /// # Errors
    /// As [`Self::build`].
    pub fn build_with(
        clutch: &Clutch,
        profile: &Profile,
        speed_rad_s: f64,
        inner_curvature: InnerCurvature,
    ) -> Result<Self, NoCurve> {
        let statics = Statics::new(clutch, profile.clone(), inner_curvature).map_err(NoCurve::NoElastic)?;
        Self::march(statics, speed_rad_s, None, None)
    }

    /// As [`Self::build`], without the arcs after the one that carries `reach_nm` (N m), if that is given: the
    /// curve then ends for the reason [`EndReason::NotBuilt`]; what it has is the same.
    ///
    /// # Errors
    /// As [`Self::build`].
    pub fn build_reaching(
        clutch: &Clutch,
        profile: &Profile,
        speed_rad_s: f64,
        reach_nm: Option<f64>,
    ) -> Result<Self, NoCurve> {
        Self::build_reaching_at(clutch, profile, speed_rad_s, reach_nm, Effort::Full)
    }

    /// The same at `effort`.
    ///
    /// # Errors
    /// As [`Self::build`].
    pub fn build_reaching_at(
        clutch: &Clutch,
        profile: &Profile,
        speed_rad_s: f64,
        reach_nm: Option<f64>,
        effort: Effort,
    ) -> Result<Self, NoCurve> {
        Self::build_like(Statics::at_effort(clutch, profile, effort)?, clutch, speed_rad_s, reach_nm, None)
    }

    /// The whole curve at rest on `statics` of `clutch` ([`Statics::at_effort`]). `like`: that of a clutch next to it, next to whose ends its
    /// arcs end; it is then, to the first order, what [`Self::build_reaching_at`] builds.
    ///
    /// # Errors
    /// As [`Self::build`].
    pub fn build_on(statics: Statics, clutch: &Clutch, like: Option<&Self>) -> Result<Self, NoCurve> {
        Self::build_like(statics, clutch, 0.0, None, like)
    }

    /// The curve on `statics`, or the full one where a quick one leaves out too much. `like`: that of a clutch next to it, at the same
    /// speed and effort.
    pub(super) fn build_like(
        statics: Statics,
        clutch: &Clutch,
        speed_rad_s: f64,
        reach_nm: Option<f64>,
        like: Option<&Self>,
    ) -> Result<Self, NoCurve> {
        let (effort, profile) = (statics.effort, statics.profile.clone());
        match Self::march(statics, speed_rad_s, reach_nm, like) {
            Ok(found) if like.is_some() || found.leaves_out_less_than(effort.trusted(), None) => Ok(found),
            Err(none) if effort == Effort::Full => Err(none),
            // Or there is none: the full one decides.
            _ => {
                let full = Statics::at_effort(clutch, &profile, Effort::Full)?;
                Self::march(full, speed_rad_s, reach_nm, like)
            }
        }
    }

    /// Whether up to `reach_nm` (N m) it leaves out less than `part`: a quick one that varies more than a few panels follow does not.
    pub(super) fn leaves_out_less_than(&self, part: f64, reach_nm: Option<f64>) -> bool {
        self.effort() == Effort::Full || self.truncation_of(self.arcs_to(reach_nm)) < part
    }

    /// The curve at rest of a sprag between races whose axes do not meet: that of the inner race lies `offset_m` from that
    /// of the outer, (along OC_e outward, across it towards positive azimuth) at first contact between concentric races,
    /// m, and turns with the race `carrier` from there on. The gap is narrower by the first; the second tilts the tracks
    /// against each other by itself over R_i, which is as much of tan omega. The windup counts from the sprag's own first
    /// contact.
    ///
    /// # Errors
    /// As [`Self::build`].
    pub fn build_off_centre(
        clutch: &Clutch,
        profile: &Profile,
        offset_m: [f64; 2],
        carrier: Carrier,
    ) -> Result<Self, NoCurve> {
        let mut statics = Statics::at_effort(clutch, profile, Effort::Full)?;
        (statics.offset_m, statics.carrier) = (offset_m, carrier);
        Self::march(statics, 0.0, None, None)
    }

    /// This curve, its speed and effort kept, of a sprag that is set apart so. The windup counts from that sprag's own first contact.
    ///
    /// # Errors
    /// As [`Self::build`].
    pub fn of_sprag(&self, apart: SpragDeviation) -> Result<Self, NoCurve> {
        if apart == SpragDeviation::default() {
            return Ok(self.clone());
        }
        let mut statics = self.statics.clone();
        statics.set_apart(apart);
        Self::march(statics, self.speed_rad_s, None, None)
    }

    /// The curve at rest of sprags whose surfaces have changed by so little that their bodies still give as those of `like` do.
    ///
    /// # Errors
    /// As [`Self::build`].
    pub fn build_with_body_of(clutch: &Clutch, profile: &Profile, like: &Self) -> Result<Self, NoCurve> {
        let mut statics = Statics::at_effort(clutch, profile, Effort::Full)?;
        statics.bulk.clone_from(&like.statics.bulk);
        Self::march(statics, 0.0, None, None)
    }

    /// The curve at rest with local deformation alone: rings that do not grow (5), bodies that keep their bulk (6).
    /// The paper's Figure 11 sets it beside the whole.
    ///
    /// # Errors
    /// As [`Self::build`].
    pub fn build_local(clutch: &Clutch, profile: &Profile) -> Result<Self, NoCurve> {
        let mut statics = Statics::at_effort(clutch, profile, Effort::Full)?;
        statics.elastic = statics.elastic.local_only();
        statics.bulk = None;
        Self::march(statics, 0.0, None, None)
    }

    /// The curve at rest of a clutch whose bodies are layers of one linear element through half their length, as a deck for
    /// CalculiX has them ([`element_share`]): what law `elastic` is compared with there.
    ///
    /// # Errors
    /// As [`Self::build`].
    pub fn build_as_deck(clutch: &Clutch, profile: &Profile) -> Result<Self, NoCurve> {
        let mut statics = Statics::at_effort(clutch, profile, Effort::Full)?;
        statics.elastic = Elastic::with_layers(clutch, element_share).map_err(NoCurve::NoElastic)?;
        Self::march(statics, 0.0, None, None)
    }

    /// Arc after arc from first contact to the end, or to the arc that carries `reach_nm`. `like`: the curve of a clutch next to this one,
    /// at the same speed.
    pub(super) fn march(
        statics: Statics,
        speed_rad_s: f64,
        reach_nm: Option<f64>,
        like: Option<&Self>,
    ) -> Result<Self, NoCurve> {
        let profile = statics.profile.clone();
        let (effort, exponent) = (statics.effort, statics.exponent);
        let beta0 = profile.beta0_rad;
        // The arc on which first contact lies at this speed: growth of the race may already have turned it.
        let mut first = 0;
        let mut touch =
            statics.closure(0, FIRST_CONTACT_N, speed_rad_s, 0.0).map_err(|_| NoCurve::NoFirstContact)?;
        while touch.turn_rad(beta0) >= profile.arcs[first].until_rad {
            first += 1;
            if first >= profile.arcs.len() {
                return Err(NoCurve::NoFirstContact);
            }
            touch = statics
                .closure(first, FIRST_CONTACT_N, speed_rad_s, 0.0)
                .map_err(|_| NoCurve::NoFirstContact)?;
        }
        let alpha0 = touch.alpha.v;
        let like = like.filter(|like| like.first == first && like.effort() == effort);
        let mut arcs: Vec<Arc<ArcTable>> = Vec::new();
        let (mut n_from, mut shift, mut windup_from) = (0.0, 0.0, 0.0);
        let mut end = EndReason::OffProfile;
        for k in first..profile.arcs.len() {
            if let Some(last) = arcs.last() {
                // The paper's Figure 5: N stays, arc k starts where it carries N_J, the rest is added from there. Only
                // a law that is given the radius pointwise needs a shift; for all others it is rounding.
                let raw = statics.closure(k, last.n_until, speed_rad_s, 0.0);
                match raw {
                    Ok(c) => shift = last.alpha_until - c.alpha.v,
                    Err(_) => {
                        end = EndReason::RollsOver;
                        break;
                    }
                }
            }
            let until = profile.arcs[k].until_rad;
            let beside = |like: &Self| {
                let moved_rad = until - like.statics.profile.arcs[k].until_rad;
                arc_end_beside(&statics, k, speed_rad_s, shift, like.off_profile(k - first)?, moved_rad)
            };
            let reach = like
                .and_then(beside)
                .or_else(|| arc_end(&statics, k, speed_rad_s, n_from, shift, until, effort));
            let Some((n_until, reason)) = reach else {
                end = EndReason::RollsOver;
                break;
            };
            let like = like.and_then(|like| like.arcs.get(k - first)).map(AsRef::as_ref);
            let arc = ArcBuilder { statics: &statics, k, speed: speed_rad_s, shift }
                .build(n_from, n_until, windup_from, k == first, like)
                .map_err(|_| NoCurve::NoConvergence)?;
            windup_from = arc.windup_rad(arc.alpha_until, (k == first).then_some((alpha0, exponent)));
            arcs.push(Arc::new(arc));
            n_from = n_until;
            if let Some(reason) = reason {
                end = reason;
                break;
            }
            if reach_nm.is_some_and(|reach| arcs[arcs.len() - 1].torque_until_nm > reach) {
                end = EndReason::NotBuilt;
                break;
            }
        }
        if arcs.is_empty() {
            return Err(NoCurve::NoFirstContact);
        }
        let near_peak_n = like.and_then(|like| *like.peak_n.get()?);
        let (over, peak_n) = (Vec::new(), OnceLock::new());
        Ok(Self { statics, speed_rad_s, alpha0, first, arcs, over, end, touch, peak_n, near_peak_n })
    }

    /// Its arc `k`, where it ends by the turn of its contact; `None` where there is no such arc, or torque ends it.
    fn off_profile(&self, k: usize) -> Option<&Arc<ArcTable>> {
        let rolls_over = self.end == EndReason::RollsOver && k + 1 == self.arcs.len();
        self.arcs.get(k).filter(|_| !rolls_over)
    }

    /// Whether one of its arcs carries `reach_nm` (N m).
    pub(super) fn carries(&self, reach_nm: f64) -> bool {
        self.arcs.iter().any(|arc| arc.torque_until_nm > reach_nm)
    }

    /// This curve without the arcs after the one that carries `reach_nm` (N m): what [`Self::build_reaching`] builds, for who has
    /// the whole curve already.
    pub fn reaching(&self, reach_nm: Option<f64>) -> Self {
        let arcs = self.arcs_to(reach_nm);
        // The last arc ends for a reason of its own.
        if arcs.len() == self.arcs.len() {
            return self.clone();
        }
        let (arcs, end) = (arcs.to_vec(), EndReason::NotBuilt);
        Self { arcs, end, peak_n: OnceLock::new(), near_peak_n: None, ..self.clone() }
    }

    /// Its arcs up to the one that carries `reach_nm` (N m).
    fn arcs_to(&self, reach_nm: Option<f64>) -> &[Arc<ArcTable>] {
        let carries = |a: &Arc<ArcTable>| reach_nm.is_some_and(|reach| a.torque_until_nm > reach);
        let count = self.arcs.iter().position(carries).map_or(self.arcs.len(), |k| k + 1);
        &self.arcs[..count]
    }
}

/// How much goes into a curve.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Effort {
    /// To rounding.
    #[default]
    Full,
    /// A quarter of the closures and no more than 1e-7 of N and windup off (test `a_quick_curve_is_the_curve`), with panels halved
    /// where they do not follow, or the full one where that does not do either: for a search, whose answer is looked at once more.
    Search,
    /// The same, taken whatever it leaves out: for a first design, whose lengths go by tenths of a millimetre.
    Sketch,
}

impl Effort {
    /// Largest truncation with which a quick curve is taken.
    pub(super) fn trusted(self) -> f64 {
        if self == Self::Sketch { f64::INFINITY } else { TRUSTED }
    }

    /// Ratio of a force to the next, and to the first force, where the end of an arc is looked for.
    fn stride(self) -> [f64; 2] {
        match self {
            Self::Full => [1.1, 1.02],
            Self::Search | Self::Sketch => [1.6, 1.2],
        }
    }

    /// Relative width to which the ends of arcs, and the places where the torque is largest, are located.
    fn end_width(self) -> [f64; 2] {
        match self {
            Self::Full => [1e-15, 1e-12],
            Self::Search | Self::Sketch => [1e-11, 1e-9],
        }
    }

    /// The same of the edges of the patch.
    pub(super) fn edge_width(self) -> f64 {
        match self {
            Self::Full => 1e-13,
            Self::Search | Self::Sketch => 1e-9,
        }
    }
}

/// Steps of Newton to the end of an arc, the largest of them, relative, and the one after which the next is less than rounding.
const STEPS_TO_END: usize = 4;
const BESIDE: f64 = 1e-3;
const ARRIVED: f64 = 1e-9;

/// As [`arc_end`] next to the arc `near`, from whose end the turn of the contact goes on by `moved_rad` (rad); `None`: that is to be
/// asked.
fn arc_end_beside(
    statics: &Statics,
    k: usize,
    speed: f64,
    shift: f64,
    near: &ArcTable,
    moved_rad: f64,
) -> Option<(f64, Option<EndReason>)> {
    let last = k + 1 == statics.profile.arcs.len();
    let mut n = near.n_until;
    for _ in 0..STEPS_TO_END {
        let c = statics.closure(k, n, speed, shift).ok()?;
        let left = moved_rad + (near.turn_until_rad - c.turn_rad(statics.profile.beta0_rad));
        let step = left / (c.rotation.d - c.beta.d);
        n += step;
        let still_beside = (n - near.n_until).abs() < BESIDE * near.n_until;
        if c.torque_nm(1).d <= 0.0 || !still_beside {
            return None;
        }
        if step.abs() < ARRIVED * n {
            return Some((n, last.then_some(EndReason::OffProfile)));
        }
    }
    None
}

/// N at which arc `k` ends and, where that ends the curve, why. `None`: nothing of this arc can be used.
pub(super) fn arc_end(
    statics: &Statics,
    k: usize,
    speed: f64,
    n_from: f64,
    shift: f64,
    until: f64,
    effort: Effort,
) -> Option<(f64, Option<EndReason>)> {
    let ([ratio, first], [width_off, width_over]) = (effort.stride(), effort.end_width());
    let beta0 = statics.profile.beta0_rad;
    let last = k + 1 == statics.profile.arcs.len();
    let state = |n: f64| statics.closure(k, n, speed, shift).ok();
    // Positive while the arc goes on: turn left over, and torque still rising; both negative where nothing is in balance.
    let both = |n: f64| state(n).map(|c| [until - c.turn_rad(beta0), c.torque_nm(1).d]);
    let left = |n: f64| both(n).map_or(-1.0, |[left, _]| left);
    let rising = |n: f64| both(n).map_or(-1.0, |[_, rising]| rising);
    let (mut a, mut n) = (n_from.max(FIRST_CONTACT_N), (first * n_from).max(1.0));
    let (mut at_a, mut at_n) = (None, both(n));
    for _ in 0..4000 {
        if at_n.is_none_or(|[left, rising]| left <= 0.0 || rising <= 0.0) {
            break;
        }
        (a, at_a) = (n, at_n);
        n *= ratio;
        at_n = both(n);
    }
    let [left_a, rising_a] = at_a.or_else(|| both(a)).unwrap_or([-1.0; 2]);
    let [left_n, rising_n] = at_n.unwrap_or([-1.0; 2]);
    let off = at_n.is_some() && left_n <= 0.0;
    let n_off = if off { root::bracketed(a, n, left_a, left_n, width_off * n, left)? } else { n };
    let rising_off = if off { rising(n_off) } else { rising_n };
    if rising_off > 0.0 && off {
        return Some((n_off, last.then_some(EndReason::OffProfile)));
    }
    let n_over = root::bracketed(a, n_off, rising_a, rising_off, width_over * n, rising)?;
    // Stay where the closure exists.
    let n_over = if state(n_over).is_some() { n_over } else { n_over * (1.0 - 1e-9) };
    state(n_over).filter(|_| n_over > n_from)?;
    Some((n_over, Some(EndReason::RollsOver)))
}
