//! What the paper says of its nine scenes, and whether a run agrees.

use sprag_design::{Simulation, Verdict};

/// One cell: a preload, a friction, an amplitude.
pub struct Statement {
    /// Scenario of designs/huang2017-multi-arc.toml.
    pub scene: &'static str,
    /// The paper, section 4.1.1 (3.34 Nm) or 4.1.2 (16.8 Nm).
    pub words: &'static str,
    /// The same as a verdict.
    pub verdict: Verdict,
    /// Whether the paper's friction is the threshold itself, so that "at-threshold" agrees with it.
    pub at_threshold: bool,
}

const NO_OFFSET: &str = "no offset";
const HIGH: &str = "clear offset to the overrunning direction, contact stress close to zero";
const UPPER: &str = "no slip near the upper limit of friction";
const ENGAGING: &str = "offset to the direction of engagement";

const fn cell(scene: &'static str, words: &'static str, verdict: Verdict) -> Statement {
    Statement { scene, words, verdict, at_threshold: false }
}

/// Row by row: 3.34 Nm; 16.8 Nm; 16.8 Nm at the friction of 0.082. In each row 6, 8, 10 Nm.
pub const STATEMENTS: [Statement; 9] = [
    cell("high-6", NO_OFFSET, Verdict::Sticks),
    cell("high-8", HIGH, Verdict::SlipsOverrunning),
    cell("high-10", HIGH, Verdict::SlipsOverrunning),
    cell("low-6", UPPER, Verdict::Sticks),
    cell("low-8", UPPER, Verdict::Sticks),
    cell("low-10", UPPER, Verdict::Sticks),
    cell("low-6-mu082", NO_OFFSET, Verdict::Sticks),
    Statement { at_threshold: true, ..cell("low-8-mu082", ENGAGING, Verdict::SlipsEngaging) },
    cell("low-10-mu082", ENGAGING, Verdict::SlipsEngaging),
];

/// The cell whose friction is its threshold.
pub const AT_THRESHOLD: usize = 7;

impl Statement {
    /// Whether a verdict agrees; none is none.
    pub fn agrees(&self, verdict: Option<Verdict>) -> bool {
        verdict == Some(self.verdict) || (self.at_threshold && verdict == Some(Verdict::AtThreshold))
    }
}

/// A slip margin nearer to 0 than this, a choice, is smaller than any friction is known.
const NEAR: f64 = 1e-3;

/// What has to be said of a cell whose friction is its threshold.
pub fn remark(s: &Simulation, mu_static: f64) -> Option<String> {
    let demand = s.demand?;
    let needed = demand.required_friction?;
    let net_um = 1e6 * s.inner.net_m;
    let margin = demand.slip_margin?;
    (margin.abs() < NEAR).then(|| {
        format!(
            "within {:.3} % of its threshold: to stick takes {needed:.7}, there is {mu_static}; net slip {net_um:.3} µm, \
             where 1 µm is called slip",
            100.0 * margin.abs()
        )
    })
}
