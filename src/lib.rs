//! Design and optimisation of multi-arc sprag (overrunning) clutches: statics of the wedge, stick-slip dynamics,
//! margins, search.
//!
//! The model is that of Huang, Liu and Zhao (2017), with its misprints corrected and its gaps filled;
//! [`equations`] says where each numbered equation lives and which test decides that it is right.
//!
//! # The map
//!
//! Data flows down this table, imports point up it: a room may use the rooms of earlier rows, never those below.
//! `tests/house.rs` holds the exact list.
//!
//! | row | room | what it is about |
//! |---|---|---|
//! | 0 | [`numeric`] | duals, bracketed roots, quadrature, Chebyshev panels; never heard of a clutch |
//! | 0 | [`ode`] | Runge-Kutta steps with dense output and work counters |
//! | 0 | [`follow`] | one handle to follow and to stop whatever computes |
//! | 1 | [`material`] | elastic constants, density, a library of steels |
//! | 1 | [`profile`] | tangent arcs, spirals, outline, mass properties, crowding of neighbours |
//! | 1 | [`race`] | growth and hoop stress of rings, press fits, body compression |
//! | 1 | [`lubrication`] | oils, film of a line contact, its shear, heat and wear; never heard of a clutch |
//! | 1 | [`clutch`] | the nouns, SI: a clutch and its parts, radii as run, what happens to it |
//! | 1 | [`design`] | a checked design: clutch, limits, scenarios, the optimiser's task |
//! | 1 | [`file`](mod@file) | the design file, read, checked, changed; the only way in for mm, degrees, GPa |
//! | 2 | [`kinematics`] | lengths, angles, levers, rolling ratios |
//! | 2 | [`contact`] | local line contact: roller law, Hertz, slices |
//! | 2 | [`friction`] | coefficient over speed, dry and on a film |
//! | 3 | [`wedge`] | the only static iteration: the curve N(alpha) of one design at one speed, and the way beyond its end |
//! | 3 | [`dynamics`] | equations of motion; the only room that knows stick from slip |
//! | 4 | [`sharing`] | sprags one by one: what each carries where they are unlike, races bend, run out and give way |
//! | 4 | [`scenario`] | a named scene in, history and verdict out |
//! | 4 | [`sprags`] | a scene with its sprags one by one: who catches, who slips, what each carries |
//! | 4 | [`element`] | a clutch between two flanges, step by step under torques or at speeds from outside |
//! | 4 | [`fidelity`] | what a scene can leave out, and what that costs |
//! | 4 | [`accuracy`] | error against work of every method, and where runs come to an end |
//! | 4 | [`margin`] | demands against allowables; the only room that has allowables |
//! | 4 | [`reengage`] | slip under load and the blow when the clutch grips again |
//! | 4 | [`feed`] | strokes of an indexing drive: what each feeds, up to which frequency |
//! | 4 | [`life`] | pitting, fatigue of rings, indentation, wear and slip by chance in a life of loads |
//! | 4 | [`optimise`] | a vector and its margins, by SQP: starts, fronts, tolerances, flanks for a centroid |
//! | 4 | [`journal`] | the record of a search as lines of text, for a later search |
//! | 4 | [`sweep`] | the box of the variables as a whole: points by their number, margins at each |
//! | 4 | [`identify`] | unknown parameters from measured numbers, and what these cannot tell apart |
//! | 4 | [`size`] | a first design from space, torques, speeds, friction, steel and what it is for |
//! | 4 | [`compare`] | designs side by side: what differs in their files, and what comes of it |
//! | 5 | [`report`] | units, tables, plots, drawings; the only way out for mm, degrees, MPa |
//! | 5 | [`export`] | a clutch as drawing, solid, table or finite-element deck, and the solver's result read back |
//! | 5 | [`import`] | a drawn or measured outline as arcs and flanks |
//! | 5 | [`answer`] | what a library user and a program get: figures, errors, notes, tables, pages, what was left out |
//! | 5 | [`studio`] | the live page: a text in, margins, curves, pictures, a scene's course out |
//! | 5 | [`cli`] | arguments, paths, printing, journal files, progress, exit codes |
//!
//! # Conventions
//!
//! * SI in `f64` everywhere but in design files and reports. Public names end in their unit (`_m`, `_n`, `_rad`,
//!   `_nm_per_rad`); a name without one is a pure number. Symbols of the paper that are fields of one struct
//!   (`oa`, `rho_i`) have their unit in their doc comment.
//! * A is the contact on the inner race, B that on the outer; N and T are per sprag, torques C of the whole clutch.
//! * Azimuths and rotations share one positive sense, that in which A lies ahead of B. alpha, the rotation of the
//!   sprag against the line OG, is positive in engagement. theta_bi - theta_be falls in engagement by the windup
//!   W >= 0 and rises in overrunning; an offset is positive towards overrunning.
//! * gamma is signed: azimuth of C_e ahead of G.
//! * T_bi acts on the inner race in its positive sense, -T_be on the outer race; v is race minus sprag surface.
//! * A margin is allowable/demand - 1 unless its row says otherwise; 0 or more is held.
//! * What can happen to a clutch is data ([`Verdict`], [`EndReason`], [`Stop`]); an `Err` means that the question
//!   was malformed.
//!
//! # Features
//!
//! All are on by default; with `default-features = false` the library is built alone.
//!
//! * `cli`: the room [`cli`] and the command `sprag-design`; needs `report` and `validation`.
//! * `report`: the rooms [`report`], [`answer`], whose words have units, and [`studio`].
//! * `validation`: the room [`accuracy`] and the reference [`contact::half_space`], with its Fourier transform.
//! * `faer`: scattered slices of a contact are solved by the crate faer; without it by nalgebra, slower for thousands
//!   of slices and with other roundings.
//!
//! # From a file to an answer
//!
//! ```
//! use sprag_design::{Design, Settings, Verdict, margins, simulate};
//!
//! let path = concat!(env!("CARGO_MANIFEST_DIR"), "/designs/huang2017-multi-arc.toml");
//! let design = Design::read(path.as_ref())?;
//!
//! // Statics: the curve at rest, read at 16.8 Nm.
//! let curve = design.clutch.curve()?;
//! let point = curve.at_torque(16.8).ok_or("not carried")?;
//! assert!((point.windup_rad.to_degrees() - 1.975).abs() < 0.03);
//!
//! // Dynamics: one scenario of the file.
//! let scene = design.scenario("low-6").ok_or("no such scenario")?;
//! let answer = simulate(scene, &Settings::default())?;
//! assert_eq!(answer.verdict, Some(Verdict::Sticks));
//!
//! // Margins: every limit of the file, with the scenes that it is to hold in.
//! let rows = margins(&design, &design.check_scenarios, &Settings::default())?;
//! assert!(rows.iter().any(|row| row.code() == "hertz-peak-inner"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! With the feature `report` a design answers as the command does, `examples/first_steps.rs`:
//!
//! ```ignore
#![cfg_attr(feature = "report", doc = include_str!("../examples/first_steps.rs"))]
//! ```

#[macro_use]
mod named;

#[cfg(feature = "validation")]
pub mod accuracy;
#[cfg(feature = "report")]
pub mod answer;
#[cfg(feature = "cli")]
pub mod cli;
pub mod clutch;
pub mod compare;
pub mod contact;
pub mod design;
pub mod dynamics;
pub mod element;
pub mod export;
pub mod feed;
pub mod fidelity;
pub mod file;
pub mod follow;
pub mod friction;
pub mod identify;
pub mod import;
pub mod journal;
pub mod kinematics;
pub mod life;
pub mod lubrication;
pub mod margin;
pub mod material;
pub mod numeric;
pub mod ode;
pub mod optimise;
pub mod profile;
pub mod race;
pub mod reengage;
#[cfg(feature = "report")]
pub mod report;
pub mod scenario;
pub mod sharing;
pub mod size;
pub mod sprags;
#[cfg(feature = "report")]
pub mod studio;
pub mod sweep;
pub mod wedge;

pub use clutch::{Clutch, ContactLaw, Scenario, ScenarioKind};
pub use design::{Design, Limits};
pub use dynamics::Stop;
pub use file::DesignError;
pub use follow::{Follow, News};
pub use margin::{Margin, NoMargins, margins};
pub use material::Material;
pub use optimise::{NoSearch, Search, search};
pub use profile::{Outline, Profile, ProfileError};
pub use scenario::{NoScenario, Settings, Simulation, Verdict, simulate};
pub use wedge::{EndReason, NoCurve, StaticPoint, WedgeCurve};

#[doc = include_str!("equations.md")]
pub mod equations {}
