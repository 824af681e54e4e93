//! Fit and gap at the temperatures that an overrun settles at.

use crate::answer::reengagement::peak_torque_borne;
use crate::design::Design;
use crate::file::DesignError;
use crate::lubrication::Temperatures;
use crate::margin::{LoadState, load_state};

/// A clutch at some temperatures of its bodies, without load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WarmClutch {
    /// Distance of the tracks, m.
    pub gap_m: f64,
    /// tan omega at first contact.
    pub first_tan_omega: f64,
    /// Pressure at the joints of inner race and shaft, outer race and housing, Pa; 0 without a press fit and where it has come loose.
    pub joint_pa: [f64; 2],
    /// Peak torque that every limit bears, N m.
    pub bears_nm: Option<f64>,
}

impl WarmClutch {
    /// `design`, whose state is `state`, at the temperatures of its own file.
    pub fn of(design: &Design, state: &LoadState) -> Self {
        let races = &design.clutch.races;
        let joint_pa = design
            .clutch
            .running
            .map_or([0.0; 2], |running| [running.inner, running.outer].map(|track| track.joint_pressure_pa));
        Self {
            gap_m: races.outer_radius_m - races.inner_radius_m,
            first_tan_omega: state.first_tan_omega,
            joint_pa,
            bears_nm: peak_torque_borne(design, state).map(|(torque_nm, _)| torque_nm),
        }
    }

    /// `design` at `bodies`, in place of those of its `[thermal]`.
    ///
    /// # Errors
    /// Why there is none: its steels have no expansion, or warm as that it is no clutch.
    pub fn at(design: &Design, bodies: &Temperatures) -> Result<Self, String> {
        let values = [
            ("thermal.inner_race_c", bodies.inner_race),
            ("thermal.sprags_c", bodies.sprags),
            ("thermal.outer_race_c", bodies.outer_race),
        ];
        let why = |refused: DesignError| match refused.problems().first() {
            Some(problem) => format!("it takes {}; {}", problem.allowed, problem.help),
            None => refused.to_string(),
        };
        let warm = design.with_values(&values).map_err(why)?;
        let state = load_state(&warm).map_err(|none| none.to_string())?;
        Ok(Self::of(&warm, &state))
    }
}
