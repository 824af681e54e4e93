//! Refusals of the optimiser's task, of leaning flanks and of tolerances.

use super::{Case, hold};

const SLIP: &str = "objective = \"slip-margin\"";
const CENTROID_X: &str = "{ name = \"centroid_x_mm\", min = -0.3, max = 0.5 }";
const COUNT: &str = "{ name = \"count\", min = 11.5, max = 13 }";
const MANY: &str = "{ name = \"count\", min = 3, max = 80 }";
const LIMIT: &str = "{ name = \"limits.hoop_inner_mpa\", min = 800, max = 900 }";

#[test]
#[rustfmt::skip] // one way per line
fn objectives_and_variables() {
    hold(&[
        Case(&[(SLIP, "objective = \"life\"")], "optimize.objective", "\"life\"", &["slip-margin", "stiffness-curve"]),
        Case(&[(SLIP, "objective = \"torque-capacity\""), ("peak_torque_nm = 110.0\n", "")], "optimize.objective", "torque-capacity\"", &["peak torque", "peak_torque_nm"]),
        Case(&[(SLIP, "objective = \"windup\""), ("nominal_torque_nm = 90.0\n", "")], "optimize.objective", "\"windup\"", &["nominal_torque_nm"]),
        Case(&[(SLIP, "objective = \"stiffness-curve\"")], "optimize.objective", "stiffness-curve", &["a target", "torque in N m"]),
        Case(&[(SLIP, "objective = \"stiffness-curve\"\ntarget = [[10.0, 1.0], [20.0, 0.0]]")], "optimize.target[1]", "target =", &["both above 0"]),
        Case(&[(SLIP, "objective = \"slip-margin\"\ntarget = [[10.0, 1.0]]")], "optimize.target", "target =", &["stiffness-curve"]),
        Case(&[(CENTROID_X, COUNT)], "optimize.variables[2].min", "11.5", &["whole"]),
        Case(&[(CENTROID_X, MANY)], "optimize.variables[2].min", "80", &["whole numbers at most 40 apart"]),
        Case(&[(CENTROID_X, LIMIT)], "optimize.variables[2].name", "limits.hoop", &["r_i2_mm"]),
    ]);
}

#[test]
#[rustfmt::skip] // one way per line
fn leaning_flanks_and_tolerances() {
    let sprags = "[sprags]\n";
    let steep = "[sprags]\nflanks = { rear_mm = 2.5, front_mm = 2.5, rear_tilt_rad = 0.6 }\n";
    let cut = "[sprags]\nflanks = { rear_mm = 2.5, front_mm = 1.0, front_tilt_rad = 0.4 }\n";
    hold(&[
        Case(&[(sprags, steep)], "sprags.flanks.rear_tilt_rad", "0.6", &["-0.5", "0.5"]),
        Case(&[(sprags, cut)], "sprags.flanks.front_mm", "front_mm = 1.0", &["front flank", "leaves a contact outside"]),
        Case(&[("[optimize]", "[tolerances]\nfriction = -0.01\n[optimize]")], "tolerances.friction", "-0.01", &["at least 0"]),
        Case(&[("[optimize]", "[tolerances]\ngap = 0.01\n[optimize]")], "tolerances.gap", "gap =", &["unknown", "run_out_mm"]),
    ]);
}
