//! How far an unknown can move before a statement flips.

use rayon::prelude::*;
use sprag_design::clutch::{Friction, Scenario, ScenarioKind};
use sprag_design::design::Design;
use sprag_design::scenario::{Settings, simulate};

use super::statement::{STATEMENTS, Statement};

/// Something that the paper does not give, or gives rounded.
pub struct Unknown {
    pub name: &'static str,
    pub symbol: &'static str,
    /// Value and unit in the design, for the report.
    pub value: f64,
    pub unit: &'static str,
    /// Moved by at most this factor, up and down.
    pub bound: f64,
    /// Cells it belongs to.
    pub cells: std::ops::Range<usize>,
    /// Multiply it in a scenario.
    pub scale: fn(&mut Scenario, f64),
}

fn excitation(s: &mut Scenario, change: impl Fn(&mut f64, &mut f64, &mut f64)) {
    if let ScenarioKind::TorsionalExcitation {
        frequency_hz, abutment_stiffness_nm_per_rad, duration_s, ..
    } = &mut s.kind
    {
        change(frequency_hz, abutment_stiffness_nm_per_rad, duration_s);
    }
}

/// The kinetic coefficient follows where it would exceed the static one.
fn scale_static(s: &mut Scenario, f: f64) {
    let Friction { static_, kinetic, .. } = &mut s.clutch.friction;
    *static_ *= f;
    *kinetic = kinetic.min(*static_);
}

fn scale_kinetic(s: &mut Scenario, f: f64) {
    let Friction { static_, kinetic, .. } = &mut s.clutch.friction;
    *kinetic = (*kinetic * f).min(*static_);
}

/// Both coefficients of the third row, which are one number there.
fn scale_both(s: &mut Scenario, f: f64) {
    s.clutch.friction.static_ *= f;
    s.clutch.friction.kinetic *= f;
}

fn scale_junction(s: &mut Scenario, k: usize, f: f64) {
    if let Some(arc) = s.clutch.sprags.inner_arcs.get_mut(k) {
        arc.until_rad *= f;
    }
}

/// Junctions keep their order; r_e may not close the triangle O C_i C_e; frictions stay below 0.2.
pub const UNKNOWNS: [Unknown; 13] = [
    Unknown {
        name: "excitation frequency",
        symbol: "f = Omega/(2 pi)",
        value: 100.0,
        unit: "Hz",
        bound: 2.0,
        cells: 0..9,
        scale: |s, f| excitation(s, |hz, _, _| *hz *= f),
    },
    Unknown {
        name: "abutment stiffness",
        symbol: "k_ab",
        value: 5000.0,
        unit: "Nm/rad",
        bound: 10.0,
        cells: 0..9,
        scale: |s, f| excitation(s, |_, k, _| *k *= f),
    },
    Unknown {
        name: "time simulated",
        symbol: "t",
        value: 300.0,
        unit: "ms",
        bound: 2.0,
        cells: 0..9,
        scale: |s, f| excitation(s, |_, _, t| *t *= f),
    },
    Unknown {
        name: "kinetic friction, at most mu_s",
        symbol: "mu_c",
        value: 0.09,
        unit: "",
        bound: 2.0,
        cells: 0..6,
        scale: scale_kinetic,
    },
    Unknown {
        name: "kinetic friction, mu_s = 0.082, at most mu_s",
        symbol: "mu_c",
        value: 0.082,
        unit: "",
        bound: 2.0,
        cells: 6..9,
        scale: scale_kinetic,
    },
    Unknown {
        name: "decay of friction with speed",
        symbol: "gamma_b",
        value: 5.0,
        unit: "s/m",
        bound: 100.0,
        cells: 0..9,
        scale: |s, f| s.clutch.friction.decay_s_per_m *= f,
    },
    Unknown {
        name: "centre distance",
        symbol: "e_1",
        value: 620.0,
        unit: "µm",
        bound: 2.0,
        cells: 0..9,
        scale: |s, f| s.clutch.sprags.centre_distance_m *= f,
    },
    Unknown {
        name: "outer arc radius",
        symbol: "r_e",
        value: 4680.0,
        unit: "µm",
        bound: 1.06,
        cells: 0..9,
        scale: |s, f| s.clutch.sprags.outer_radius_m *= f,
    },
    Unknown {
        name: "junction 1",
        symbol: "arc 1 until",
        value: 0.06,
        unit: "rad",
        bound: 1.95,
        cells: 0..9,
        scale: |s, f| scale_junction(s, 0, f),
    },
    Unknown {
        name: "junction 2",
        symbol: "arc 2 until",
        value: 0.12,
        unit: "rad",
        bound: 1.95,
        cells: 0..9,
        scale: |s, f| scale_junction(s, 1, f),
    },
    Unknown {
        name: "the paper's 0.082",
        symbol: "mu_s = mu_c",
        value: 0.082,
        unit: "",
        bound: 2.0,
        cells: 6..9,
        scale: scale_both,
    },
    Unknown {
        name: "the paper's upper limit",
        symbol: "mu_s",
        value: 0.12,
        unit: "",
        bound: 1.6,
        cells: 0..6,
        scale: scale_static,
    },
    Unknown {
        name: "kinetic friction, at most mu_s, were gamma_b 500 s/m",
        symbol: "mu_c at gamma_b 500",
        value: 0.09,
        unit: "",
        bound: 2.0,
        cells: 0..6,
        scale: |s, f| {
            scale_kinetic(s, f);
            s.clutch.friction.decay_s_per_m = 500.0;
        },
    },
];

/// Where a statement ceases to hold on one side.
#[derive(Debug, Clone, PartialEq)]
pub struct Flip {
    /// Factors between which it lies: the last that holds, the first that does not.
    pub between: [f64; 2],
    /// What the clutch does there instead.
    pub becomes: String,
}

/// A scene that changes its mode more often than this, 170 times as often as any of the nine, has no verdict.
const MOST_EVENTS: u64 = 20_000;

/// What the scene does with the unknown at `factor` times its value, where that contradicts the statement.
fn contradicts(design: &Design, statement: &Statement, unknown: &Unknown, factor: f64) -> Option<String> {
    let Some(scene) = design.scenario(statement.scene) else { return Some("no such scene".to_owned()) };
    let mut scene = scene.clone();
    (unknown.scale)(&mut scene, factor);
    // Verdicts differ by a µm of slip; 1e-5 rad is a tenth of that at the inner race.
    match simulate(
        &scene,
        &Settings { tolerance: 1e-5, most_events: Some(MOST_EVENTS), ..Settings::default() },
    ) {
        Ok(s) if statement.agrees(s.verdict) => None,
        Ok(s) => Some(s.verdict.map_or(s.stop.name(), |v| v.name()).to_owned()),
        Err(e) => Some(e.to_string()),
    }
}

/// First moves tried, in ln of the factor, before equal steps to the bound.
const FIRST: [f64; 6] = [1e-5, 1e-4, 1e-3, 3e-3, 1e-2, 2e-2];
const STEPS: usize = 20;
/// Bisected until the bracket is this part of the move.
const NARROW: f64 = 2e-3;

/// Outwards in small moves, the first that flips the statement bisected; `None`: none up to the bound.
pub fn flip(design: &Design, statement: &Statement, unknown: &Unknown, up: bool) -> Option<Flip> {
    let (reach, sign) = (unknown.bound.ln(), if up { 1.0 } else { -1.0 });
    let tried = |moved: f64| contradicts(design, statement, unknown, (sign * moved).exp());
    let step = reach / STEPS as f64;
    let first = FIRST.into_iter().filter(|m| *m < step);
    let mut low = 0.0;
    for mut high in first.chain((1..=STEPS).map(|i| i as f64 * step)) {
        let Some(mut becomes) = tried(high) else {
            low = high;
            continue;
        };
        while high - low > NARROW * high {
            let middle = 0.5 * (low + high);
            match tried(middle) {
                Some(other) => (high, becomes) = (middle, other),
                None => low = middle,
            }
        }
        return Some(Flip { between: [low, high].map(|m| (sign * m).exp()), becomes });
    }
    None
}

/// For each unknown, each side (down, up), each cell: where it flips. The outer `None` is a cell that the unknown does
/// not belong to.
pub type Flips = Vec<[Vec<Option<Option<Flip>>>; 2]>;

/// Every unknown, every side, every cell; the same for any number of threads.
pub fn all(design: &Design, unknowns: &[Unknown]) -> Flips {
    let tasks: Vec<(usize, bool, usize)> = (0..unknowns.len())
        .flat_map(|u| [false, true].into_iter().flat_map(move |up| (0..9).map(move |c| (u, up, c))))
        .collect();
    let found: Vec<_> = tasks
        .par_iter()
        .map(|&(u, up, c)| {
            let unknown = &unknowns[u];
            unknown.cells.contains(&c).then(|| flip(design, &STATEMENTS[c], unknown, up))
        })
        .collect();
    found.chunks(18).map(|both| [both[..9].to_vec(), both[9..].to_vec()]).collect()
}
