//! A result of finite elements beside the design's own contact law.

use super::left_out::LeftOut;
use super::{Finding, Said};
use crate::clutch::Clutch;
use crate::design::Design;
use crate::export::calculix::{Facts, ResultRow};
use crate::race::twist_rad_per_nm;
use crate::report::{Page, Rows, Table, Unit};
use crate::wedge::{StaticPoint, WedgeCurve};
use serde::Serialize;

/// Rows of a result of CalculiX beside the curve of the design.
#[derive(Debug, Clone)]
pub struct FiniteElements<'a> {
    design: &'a Design,
    facts: &'a Facts,
    rows: &'a [ResultRow],
    /// The design's own law at the same torques.
    law: Vec<Option<StaticPoint>>,
    /// Torsion of both races, rad per N m.
    twist_rad_per_nm: f64,
    turned: f64,
}

/// A row of a result, and the state of the design's own law at its torque.
pub type ResultPoint<'a> = (&'a ResultRow, &'a Option<StaticPoint>);

/// Keys of an answer about a result of finite elements.
#[derive(Debug, Clone, Serialize)]
pub struct FiniteElementsBody<'a> {
    /// Which windups stand beside each other, and what the law is stated with.
    pub compared: String,
    /// The same of forces and tangents, percent.
    pub law_force_error_percent: f64,
    /// What the law is stated with of windup, percent.
    pub law_windup_error_percent: f64,
    /// Size of its elements at the contacts, mm.
    pub mesh_mm: f64,
    /// Each row, one of [`FiniteElements::points`].
    pub points: Rows<ResultPoint<'a>>,
    /// The solver.
    pub source: &'static str,
    /// How far the result has turned of what the deck asks for, 0 to 1.
    pub turned: f64,
    /// Variant of the deck.
    pub variant: &'a str,
}

impl<'a> FiniteElementsBody<'a> {
    fn of(answer: &'a FiniteElements<'_>) -> Self {
        let [windup, force] = answer.design.clutch.law_error().map(|error| Unit::Percent.from_si(error));
        Self {
            source: "calculix",
            variant: &answer.facts.variant,
            mesh_mm: answer.facts.mesh_mm,
            turned: answer.turned,
            compared: answer.compared(),
            law_windup_error_percent: windup,
            law_force_error_percent: force,
            points: answer.points(),
        }
    }
}

impl<'a> FiniteElements<'a> {
    /// `rows` of a result whose deck says `facts` and which has `turned` as far as that, 0 to 1.
    pub fn of(design: &'a Design, facts: &'a Facts, rows: &'a [ResultRow], turned: f64) -> Self {
        let clutch = &design.clutch;
        let curve = clutch.profile().ok().and_then(|p| match facts.variant.as_str() {
            "layer" => WedgeCurve::build_as_deck(clutch, &p).ok(),
            _ => WedgeCurve::build(clutch, &p, 0.0).ok(),
        });
        let law = rows.iter().map(|r| curve.as_ref().and_then(|c| c.at_torque(r.torque_nm))).collect();
        let twist_rad_per_nm = races_twist_rad_per_nm(facts, &design.clutch);
        Self { design, facts, rows, law, twist_rad_per_nm, turned }
    }

    /// Which windups stand beside each other, and what the law is stated with.
    pub fn compared(&self) -> String {
        let [inner, outer] = self.facts.driven_mm;
        let law = self.design.clutch.contact.facts();
        let [windup, force] = self.design.clutch.law_error();
        format!(
            "Law over FE compares rim with rim: the law's windup, track against track, and the torsion of the races out to the \
             driven circles (radii {} and {}) against the windup of finite elements there.{} The law {} is stated with {} of windup, \
             {} of forces and tangents at most.",
            Unit::Millimetre.show(1e-3 * inner, 4),
            Unit::Millimetre.show(1e-3 * outer, 4),
            match law.whole_bodies && self.facts.variant == "layer" {
                true => {
                    " The law has the deck's layers, one element through half the length, here: a body's windup is some 0.2 % larger."
                }
                false => "",
            },
            law.key,
            Unit::Percent.show(windup, 2),
            Unit::Percent.show(force, 2)
        )
    }

    /// The rows, the design's law beside them.
    pub fn points(&self) -> Rows<ResultPoint<'_>> {
        let twist_rad = |r: &ResultRow| self.twist_rad_per_nm * r.torque_nm;
        Rows::of(self.rows.iter().zip(&self.law))
            .number("torque_nm", "Torque", Unit::NewtonMetre, 5, |(r, _)| r.torque_nm)
            .number("normal_inner_n", "N inner", Unit::Newton, 5, |(r, _)| r.normal_inner_n)
            .number("windup_deg", "Windup", Unit::Degree, 5, |(r, _)| r.windup_rad)
            .number("hertz_inner_mpa", "Pressure inner", Unit::Megapascal, 4, |(r, _)| r.pressure_inner_pa)
            .number("tan_omega", "tan ω", Unit::One, 4, |(r, _)| r.tan_omega)
            .number("k_secant_nm_per_rad", "Secant", Unit::NewtonMetrePerRadian, 4, |(r, _)| {
                r.torque_nm / r.windup_rad
            })
            .number("law_normal_inner_n", "N, law", Unit::Newton, 5, |(_, l)| l.map(|l| l.normal_inner_n))
            .number("law_windup_deg", "Windup, law", Unit::Degree, 5, |(_, l)| l.map(|l| l.windup_rad))
            .number("races_twist_deg", "Twist of races", Unit::Degree, 3, |(r, _)| twist_rad(r))
            .number("law_over_fe_percent", "Law over FE", Unit::Percent, 3, |(r, l)| {
                l.map(|l| (l.windup_rad + twist_rad(r)) / r.windup_rad - 1.0)
            })
            .number("law_normal_over_fe_percent", "N, law over FE", Unit::Percent, 3, |(r, l)| {
                l.map(|l| l.normal_inner_n / r.normal_inner_n - 1.0)
            })
            .number("law_tan_over_fe_percent", "tan ω, law over FE", Unit::Percent, 3, |(r, l)| {
                // Both cut at one radius: of one torque they have one T there. Finite elements have theirs at the middle of the patch,
                // the law at the pitch point, 0.03 % of the radius beneath.
                l.map(|l| r.normal_inner_n / l.normal_inner_n - 1.0)
            })
            .json("normal_outer_n", |(r, _)| r.normal_outer_n)
            .json("tan_nu", |(r, _)| r.tan_nu)
            .json("law_tan_omega", |(_, l)| l.map(|l| l.tan_omega))
    }
}

impl Said for FiniteElements<'_> {
    type Body<'a>
        = FiniteElementsBody<'a>
    where
        Self: 'a;

    fn title(&self) -> &str {
        "Finite elements"
    }

    fn design(&self) -> &Design {
        self.design
    }

    fn outcome(&self) -> Finding {
        Finding::Shown
    }

    fn verdict(&self) -> String {
        self.compared()
    }

    fn remarks(&self) -> Vec<String> {
        Vec::new()
    }

    fn table(&self) -> Table {
        self.points().table()
    }

    fn body(&self) -> FiniteElementsBody<'_> {
        FiniteElementsBody::of(self)
    }

    fn left_out(&self) -> Vec<LeftOut> {
        left_out(self.facts)
    }

    fn draw(&self, page: &mut Page) {
        page.heading("CalculiX beside the design's contact law").table("", &self.table());
    }
}

/// Turn of the driven circles of a deck against the tracks by the torsion of both races, rad per N m of the whole clutch. A
/// plane deck has races as long as the sprag.
fn races_twist_rad_per_nm(facts: &Facts, clutch: &Clutch) -> f64 {
    let width_m = if facts.variant == "solid" { clutch.races.width_m } else { 1e-3 * facts.length_mm };
    let materials = [&clutch.materials.inner_race, &clutch.materials.outer_race];
    let radii = facts.driven_mm.iter().zip(facts.track_mm);
    let turn = |(material, (driven, track)): (_, (&f64, f64))| {
        twist_rad_per_nm(1e-3 * driven, 1e-3 * track, width_m, material)
    };
    materials.into_iter().zip(radii).map(turn).sum()
}

fn left_out(facts: &Facts) -> Vec<LeftOut> {
    let mut list = vec![
        LeftOut::new(
            "slip and the design's friction",
            "the deck sticks but for a narrow rim of each patch: its friction is its own",
            "none while the clutch sticks",
        ),
        LeftOut::new(
            "separation of windup and tangential give of the contacts",
            "windup of finite elements holds both; the law's has none, but for the torsion of the races, which is added",
            "not estimated",
        ),
    ];
    if facts.variant != "solid" {
        list.push(LeftOut::new(
            "width of the races",
            "a plane deck has races as long as the sprag",
            "windup 25 % smaller with races twice as wide (finite elements, clutch of Table 1)",
        ));
    }
    list
}
