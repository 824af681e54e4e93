//! Two bodies side by side along the contact: where they touch, what ends there, how far apart they are.

use super::end_profile::EndDrop;
use super::line::{ContactError, LineContact, positive};

/// One body along the contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Flank {
    /// Length of the body, m.
    pub length_m: f64,
    /// Middle of the body on an axial scale common to both bodies, m.
    pub middle_m: f64,
    /// Shape along the length.
    pub profile: EndDrop,
}

impl Flank {
    /// A straight body of `length_m` about the origin.
    pub fn straight(length_m: f64) -> Self {
        Self { length_m, middle_m: 0.0, profile: EndDrop::Square }
    }
}

/// What bounds the contact at one end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactEnd {
    /// Body 0 or 1 ends here, the other goes on.
    One {
        /// Index of the body that ends.
        body: usize,
    },
    /// Both bodies end here (to 1e-6 of the contact length): two quarter-spaces.
    Flush,
}

/// The overlap of two bodies and the gap along it.
///
/// # Conventions
/// y is measured from the middle of the overlap, m, end 0 at -l/2, end 1 at +l/2. The gap is that of the rigid
/// shapes when they first touch, so its least value is 0. A positive tilt opens the gap towards +y.
#[derive(Debug, Clone, PartialEq)]
pub struct AxialFit {
    bodies: [Flank; 2],
    middle_m: f64,
    length_m: f64,
    slope: f64,
    ends: [ContactEnd; 2],
    touch_m: f64,
}

/// Ends closer than this share of the overlap count as flush, a choice.
const FLUSH: f64 = 1e-6;
/// Largest tilt, rad, a choice: far beyond what small displacements allow.
const MOST_TILT_RAD: f64 = 0.1;
/// Points at which the first touch is sought; the shapes are smooth between, so it is found to their square.
const TOUCH_POINTS: usize = 4096;

impl AxialFit {
    /// Bodies that overlap, tilted by `tilt_rad` against one another in the plane of axis and normal.
    ///
    /// Refused: lengths not positive, no overlap, tables that end within it, more than 0.1 rad.
    pub fn new(bodies: [Flank; 2], tilt_rad: f64) -> Result<Self, ContactError> {
        for body in &bodies {
            positive("body length_m", body.length_m)?;
            if !body.middle_m.is_finite() {
                return Err(ContactError::NotPositive { name: "body middle_m", value: body.middle_m });
            }
        }
        if tilt_rad.is_nan() || tilt_rad.abs() > MOST_TILT_RAD {
            return Err(ContactError::Tilt { tilt_rad });
        }
        let end = |body: &Flank, side: f64| body.middle_m + side * 0.5 * body.length_m;
        let [a, b] = &bodies;
        let (low_m, high_m) = (end(a, -1.0).max(end(b, -1.0)), end(a, 1.0).min(end(b, 1.0)));
        let length_m = positive("overlap of the bodies, m", high_m - low_m)?;
        let kind = |side: f64| {
            // how much further body 0 reaches
            let ahead = side * (end(a, side) - end(b, side));
            match ahead {
                _ if ahead.abs() <= FLUSH * length_m => ContactEnd::Flush,
                _ if ahead < 0.0 => ContactEnd::One { body: 0 },
                _ => ContactEnd::One { body: 1 },
            }
        };
        let ends = [kind(-1.0), kind(1.0)];
        for body in &bodies {
            if !body.profile.covers(low_m - body.middle_m, high_m - body.middle_m) {
                return Err(ContactError::Profile {
                    what: "profile ends within the contact",
                    value: 0.5 * length_m,
                    at: 0,
                });
            }
        }
        let middle_m = 0.5 * (low_m + high_m);
        let mut fit = Self { bodies, middle_m, length_m, slope: tilt_rad.tan(), ends, touch_m: 0.0 };
        let points = (0..=TOUCH_POINTS).map(|i| (i as f64 / TOUCH_POINTS as f64 - 0.5) * length_m);
        fit.touch_m = points.map(|y| fit.gap_m(y)).fold(f64::INFINITY, f64::min);
        Ok(fit)
    }

    /// A straight body of `length_m` within a longer one, no tilt: both ends of body 0 are square.
    pub fn square(length_m: f64) -> Result<Self, ContactError> {
        Self::shaped(length_m, EndDrop::Square, 0.0)
    }

    /// A body of `length_m` with `profile` in the middle of a straight one twice as long.
    pub fn shaped(length_m: f64, profile: EndDrop, tilt_rad: f64) -> Result<Self, ContactError> {
        let inner = Flank { length_m, middle_m: 0.0, profile };
        Self::new([inner, Flank::straight(2.0 * length_m)], tilt_rad)
    }

    /// Length of the contact l, m: the overlap.
    pub fn length_m(&self) -> f64 {
        self.length_m
    }

    /// Middle of the contact on the bodies' common scale, m.
    pub fn middle_m(&self) -> f64 {
        self.middle_m
    }

    /// What bounds the contact at -l/2 and +l/2.
    pub fn ends(&self) -> [ContactEnd; 2] {
        self.ends
    }

    /// `contact` with the length of the overlap.
    pub fn cut(&self, contact: &LineContact) -> LineContact {
        LineContact { length_m: self.length_m, ..*contact }
    }

    /// Gap at y, m.
    pub fn gap_m(&self, y_m: f64) -> f64 {
        let drop = |body: &Flank| body.profile.drop_m(self.middle_m + y_m - body.middle_m, body.length_m);
        self.bodies.iter().map(drop).sum::<f64>() + self.slope * y_m - self.touch_m
    }

    /// Gaps at the middles of `count` equal slices, m.
    pub fn gaps_m(&self, count: usize) -> Vec<f64> {
        slice_middles_m(self.length_m, count).iter().map(|y| self.gap_m(*y)).collect()
    }

    /// Whether a body that ends at the end (0 or 1) is straight up to it.
    pub(super) fn sharp(&self, end: usize) -> bool {
        let square = |body: &Flank| body.profile == EndDrop::Square;
        match self.ends[end] {
            ContactEnd::One { body } => square(&self.bodies[body]),
            ContactEnd::Flush => self.bodies.iter().all(square),
        }
    }
}

/// Middles of `count` equal slices of a length, from its middle, m.
pub(super) fn slice_middles_m(length_m: f64, count: usize) -> Vec<f64> {
    // exactly antisymmetric
    (0..count).map(|j| length_m * (2.0 * j as f64 + 1.0 - count as f64) / (2.0 * count as f64)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair(first: f64, second: f64, offset: f64) -> Result<AxialFit, ContactError> {
        AxialFit::new([Flank::straight(first), Flank { middle_m: offset, ..Flank::straight(second) }], 0.0)
    }

    #[test]
    fn the_contact_is_the_overlap() {
        let shorter = pair(6e-3, 8e-3, 0.0).unwrap();
        assert_eq!(shorter.ends(), [ContactEnd::One { body: 0 }; 2]);
        assert!((shorter.length_m() - 6e-3).abs() < 1e-18);
        let longer = pair(9e-3, 8e-3, 0.0).unwrap();
        assert_eq!(longer.ends(), [ContactEnd::One { body: 1 }; 2]);
        assert!((longer.length_m() - 8e-3).abs() < 1e-18);
        assert_eq!(pair(8e-3, 8e-3, 0.0).unwrap().ends(), [ContactEnd::Flush; 2]);
        let shifted = pair(8e-3, 8e-3, 1e-3).unwrap();
        assert_eq!(shifted.ends(), [ContactEnd::One { body: 1 }, ContactEnd::One { body: 0 }]);
        assert!((shifted.length_m() - 7e-3).abs() < 1e-18 && (shifted.middle_m() - 0.5e-3).abs() < 1e-18);
        assert!(pair(8e-3, 8e-3, 8e-3).is_err());
    }

    #[test]
    fn drops_add_tilt_opens_and_the_gap_starts_at_the_first_touch() {
        let crown = |r| EndDrop::crown_radius(r, 6e-3).unwrap();
        let bodies = [2.0, 4.0].map(|r| Flank { profile: crown(r), ..Flank::straight(6e-3) });
        let fit = AxialFit::new(bodies.clone(), 0.0).unwrap();
        assert_eq!(fit.gap_m(0.0), 0.0);
        assert!((fit.gap_m(3e-3) / (9e-6 / 4.0 + 9e-6 / 8.0) - 1.0).abs() < 1e-5);
        // a parabola y^2/2r, r = 4/3 m, tilted by t touches at -r t and is moved, not changed
        let tilted = AxialFit::new(bodies, 1e-3).unwrap();
        assert!(tilted.gap_m(-4e-3 / 3.0).abs() < 1e-12);
        assert!((tilted.gap_m(1e-3) / ((7e-3f64 / 3.0).powi(2) / (8.0 / 3.0)) - 1.0).abs() < 1e-5);
        assert!(tilted.gaps_m(7).iter().all(|g| *g >= 0.0));
        let straight = AxialFit::shaped(6e-3, EndDrop::Square, -1e-3).unwrap();
        assert!(straight.gap_m(3e-3).abs() < 1e-18 && (straight.gap_m(-3e-3) - 6e-6).abs() < 1e-11);
    }

    #[test]
    fn a_race_that_ends_first_is_the_sharp_one() {
        let crown = EndDrop::crown_radius(1.0, 10e-3).unwrap();
        let sprag = Flank { profile: crown, ..Flank::straight(10e-3) };
        let long = AxialFit::new([sprag.clone(), Flank::straight(8e-3)], 0.0).unwrap();
        assert!(long.sharp(0) && long.sharp(1));
        let short = AxialFit::new([sprag, Flank::straight(12e-3)], 0.0).unwrap();
        assert!(!short.sharp(0) && !short.sharp(1));
    }

    #[test]
    fn impossible_fits_are_refused() {
        for tilt in [f64::NAN, f64::INFINITY, 0.2, -0.2] {
            assert!(matches!(AxialFit::shaped(6e-3, EndDrop::Square, tilt), Err(ContactError::Tilt { .. })));
        }
        assert!(AxialFit::square(0.0).is_err());
        assert!(AxialFit::square(f64::NAN).is_err());
        assert!(pair(6e-3, 6e-3, f64::NAN).is_err());
        let table = EndDrop::table(vec![[-2e-3, 0.0], [2e-3, 0.0]]).unwrap();
        assert!(matches!(AxialFit::shaped(6e-3, table, 0.0), Err(ContactError::Profile { .. })));
    }
}
