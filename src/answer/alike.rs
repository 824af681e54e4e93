//! What the paper's three assumptions about the sprags cost, at the load of the limits: deviations that any clutch has, one
//! at a time, sprag by sprag.

use super::left_out::LeftOut;
use super::under_load::{AtLoad, at};
use crate::clutch::{Carrier, Clutch, Eccentricity, GivenSprag, Sharing, Standing};
use crate::design::Design;
use crate::report::{Unit, plain};
use crate::sharing::{Asked, NotShared, Shared, Unlike};
use crate::wedge::{StaticPoint, WedgeCurve};

const TOGETHER: &str = "sprags that wedge one after another";
pub(super) const UNEQUAL: &str = "unequal sharing of the load between the sprags";
pub(super) const ECCENTRIC: &str = "eccentric and tilted races";

/// Larger than the others by this, m: sprags are sorted into classes as wide.
const LARGER_M: f64 = 1e-6;
/// What one sprag lacks to touch, and how far apart the axes are, m: a track that runs out by twice that.
const APART_M: f64 = 10e-6;

/// The terms; `at_load`: curve and static state at which their cost is named.
pub(super) fn left_out_of_alike(clutch: &Clutch, at_load: Option<&AtLoad>) -> [LeftOut; 3] {
    let costs = at_load.map(|(curve, point)| {
        // One deviation at a time: axes that the design has apart are not one of these.
        let mut clutch = clutch.clone();
        clutch.races.eccentricity = None;
        let case = Case { clutch, curve, point };
        [case.late(), case.larger(), case.eccentric()]
    });
    let [late, larger, eccentric] =
        costs.unwrap_or_else(|| [(); 3].map(|()| "not estimated: no static state to start from".to_owned()));
    [
        LeftOut::new(
            TOGETHER,
            "all sprags are taken to wedge simultaneously (assumption of the paper)",
            &late,
        ),
        LeftOut::new(
            UNEQUAL,
            "all sprags are taken to carry the same force (assumption of the paper)",
            &larger,
        ),
        LeftOut::new(ECCENTRIC, "the races are taken to be concentric (assumption of the paper)", &eccentric),
    ]
}

struct Case<'a> {
    /// Its axes meet.
    clutch: Clutch,
    curve: &'a WedgeCurve,
    point: &'a StaticPoint,
}

impl Case<'_> {
    /// The first sprag otherwise than the rest; share of its normal force beside the mean less 1, and windup at which it
    /// takes load less that of the others, rad; else why not.
    fn first_sprag(&self, start: Standing, sprag: GivenSprag) -> Result<[f64; 2], String> {
        let sharing = Sharing { start, given: vec![sprag], ..Sharing::default() };
        let unlike = Unlike::new(&self.clutch, &sharing, self.curve, 0.0);
        let shared = self.shared(&unlike)?;
        let first_rad = unlike.lag_rad[0].ok_or("that sprag carries nothing")?;
        let later_rad = first_rad - unlike.lag_rad.get(1).copied().flatten().unwrap_or(0.0);
        Ok([shared.shares()[0] - 1.0, later_rad])
    }

    fn shared(&self, unlike: &Unlike) -> Result<Shared, String> {
        unlike.carrying(Asked::Torque(self.point.torque_nm), 0.0).map_err(NotShared::words)
    }

    /// What a deviation does, or why that is not known.
    fn told(&self, deviation: &str, does: Result<String, String>) -> String {
        match does {
            Ok(does) => format!("{deviation}{does}"),
            Err(why) => format!("{deviation}: not estimated {}: {why}", at(self.point)),
        }
    }

    fn late(&self) -> String {
        let sprag = GivenSprag { gap_m: Some(APART_M), ..GivenSprag::default() };
        let does = self.first_sprag(Standing::Sprung, sprag).map(|[share, later_rad]| {
            format!(
                " takes load {} of windup after the others and carries {} {}",
                Unit::Degree.show(later_rad, 2),
                more(share),
                at(self.point)
            )
        });
        self.told(&format!("a sprag that lacks {} to touch", Unit::Micrometre.show(APART_M, 2)), does)
    }

    fn larger(&self) -> String {
        let first =
            |start| self.first_sprag(start, GivenSprag { size_m: Some(LARGER_M), ..GivenSprag::default() });
        let does = first(Standing::Sprung).map(|[sprung, _]| {
            const CAGED: &str = "if a cage holds all at one angle";
            let caged = match first(Standing::Caged) {
                Ok([caged, _]) => format!("{} {CAGED}", more(caged)),
                Err(why) => format!("not estimated {CAGED} ({why})"),
            };
            format!(" carries {} {}, {caged}: [sharing] looks at each", more(sprung), at(self.point))
        });
        self.told(&format!("a sprag {} larger than the others", Unit::Micrometre.show(LARGER_M, 2)), does)
    }

    /// The sprags with the axes [`APART_M`] apart and held there.
    fn apart(&self) -> Result<Shared, NotShared> {
        let eccentricity = Eccentricity {
            offset_m: APART_M,
            turning: false,
            carrier: Carrier::default(),
            stiffness_n_per_m: f64::INFINITY,
        };
        let mut clutch = self.clutch.clone();
        clutch.races.eccentricity = Some(eccentricity);
        Unlike::new(&clutch, &Sharing::default(), self.curve, 0.0)
            .carrying(Asked::Torque(self.point.torque_nm), 0.0)
    }

    fn eccentric(&self) -> String {
        let does = self.apart().map_err(NotShared::words).map(|shared| {
            let largest = shared.shares().into_iter().fold(0.0, f64::max);
            format!(
                ": the most pressed sprag carries {} {}; tilted tracks: not estimated",
                more(largest - 1.0),
                at(self.point)
            )
        });
        self.told(&axes_apart(), does)
    }
}

/// The deviation of the axes, in words.
fn axes_apart() -> String {
    format!("axes {} apart and held there", Unit::Micrometre.show(APART_M, 2))
}

/// That the largest torque of the limits, which the concentric clutch carries, is more than its sprags carry where the axes part, in words.
pub(super) fn ends_where_axes_part(design: &Design) -> Option<String> {
    let clutch = &design.clutch;
    if clutch.races.eccentricity.is_some() {
        return None;
    }
    let curve = WedgeCurve::build(clutch, &clutch.profile().ok()?, 0.0).ok()?;
    let point = curve.at_torque(design.limits.largest_torque_nm()?)?;
    let why = Case { clutch: clutch.clone(), curve: &curve, point: &point }.apart().err()?;
    matches!(why, NotShared::End(..)).then(|| {
        format!(
            "Warning: the verdict is of axes that coincide; with {} {} {}: `--set \"races.eccentricity={{offset_mm={}}}\"` asks for what is \
             held then",
            axes_apart(),
            why.words(),
            at(&point),
            plain(Unit::Millimetre.from_si(APART_M), 3)
        )
    })
}

/// A share beside the mean, in words.
fn more(share: f64) -> String {
    format!("{} {}", Unit::Percent.show(share.abs(), 2), if share < 0.0 { "less" } else { "more" })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn costs(text: &str, torque_nm: f64) -> [f64; 3] {
        let clutch = Design::parse(text, "multi-arc").unwrap().clutch;
        let curve = WedgeCurve::build(&clutch, &clutch.profile().unwrap(), 0.0).unwrap();
        let point = curve.at_torque(torque_nm).unwrap();
        let case = Case { clutch, curve: &curve, point: &point };
        let one = |sprag| case.first_sprag(Standing::Sprung, sprag).unwrap()[0];
        let size = |m| one(GivenSprag { size_m: Some(m), ..GivenSprag::default() });
        [size(1e-6), size(2e-6), one(GivenSprag { gap_m: Some(APART_M), ..GivenSprag::default() })]
    }

    /// Twice the size is twice the share; a late sprag carries less, by less at a larger torque.
    #[test]
    fn costs_go_with_the_deviation_and_fall_with_the_torque() {
        let text = include_str!("../../designs/huang2017-multi-arc.toml");
        let [one, two, late] = costs(text, 20.0);
        assert!((two / one - 2.0).abs() < 0.05, "{one} {two}");
        let [_, _, late_later] = costs(text, 60.0);
        assert!(late < late_later && late_later < 0.0, "{late} {late_later}");
    }

    /// Near the end of the curve a sprag that deviates comes to its end: that is the reason, not a state that is missing.
    #[test]
    fn a_cost_that_is_not_known_says_why() {
        let clutch = Design::parse(include_str!("../../designs/huang2017-multi-arc.toml"), "multi-arc")
            .unwrap()
            .clutch;
        let curve = WedgeCurve::build(&clutch, &clutch.profile().unwrap(), 0.0).unwrap();
        let point = curve.at_torque(curve.end_torque_nm()).unwrap();
        for term in left_out_of_alike(&clutch, Some(&(curve, point))) {
            assert!(term.cost.contains(": not estimated at ") && term.cost.contains("end first"), "{term:?}");
        }
    }
}
