//! What a transient says of times after its end: often milliseconds in place of seconds.

use crate::clutch::{Scenario, ScenarioKind};

/// A sentence for the step and for each history of which the scene feels no change.
pub(in crate::answer) fn notes(scenario: &Scenario) -> Vec<String> {
    let ScenarioKind::Transient { torque_step_nm, step_time_s, duration_s, .. } = scenario.kind else {
        return Vec::new();
    };
    let late = torque_step_nm != 0.0 && step_time_s >= duration_s;
    let step = late.then(|| {
        format!(
            "the torque steps at {step_time_s} s, the scene ends at {duration_s} s: the step is not felt; are these seconds?"
        )
    });
    let histories = [("torque", &scenario.torque_history), ("speed", &scenario.speed_history)];
    let histories = histories.iter().filter_map(|(of, rows)| {
        let next_s = next_row_s(rows.as_deref()?, duration_s)?;
        Some(format!(
            "the {of} history has no row between the start and the end of the scene at {duration_s} s, the next is at {next_s} s; \
             are these seconds?"
        ))
    });
    step.into_iter().chain(histories).collect()
}

/// When the next row comes, s, where none lies within the scene though the history changes.
fn next_row_s(rows: &[[f64; 2]], duration_s: f64) -> Option<f64> {
    let changes = rows.windows(2).any(|two| two[0][1] != two[1][1]);
    let within = rows.iter().any(|row| row[0] > 0.0 && row[0] <= duration_s);
    let next = rows.iter().find(|row| row[0] > duration_s)?;
    (changes && !within).then_some(next[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::Design;

    const MORE: &str = r#"
[[scenarios]]
name = "late"
kind = "transient"
preload_nm = 3.34
torque_step_nm = 1.0
step_time_s = 20.0
abutment_stiffness_nm_per_rad = 5000.0
duration_s = 0.02
"#;

    #[test]
    fn times_after_the_end_are_named_and_others_are_not() {
        let bench = std::fs::read_to_string("designs/huang2017-bench.toml").unwrap();
        let design = Design::parse(&(bench + MORE), "designs/late.toml").unwrap();
        let [late] = notes(design.scenario("late").unwrap()).try_into().unwrap();
        assert!(late.contains("steps at 20 s, the scene ends at 0.02 s"), "{late}");
        for name in ["step-up", "step-down", "in-and-out", "speed-ramp", "engagement"] {
            assert_eq!(notes(design.scenario(name).unwrap()), Vec::<String>::new(), "{name}");
        }
        let mut history = design.scenario("in-and-out").unwrap().clone();
        // Milliseconds for seconds, with and without a row at the start.
        for first in [0.0, 1.0] {
            history.torque_history = Some(vec![[first, 1.0], [5.0, 9.0], [20.0, 1.0]]);
            let [said] = notes(&history).try_into().unwrap();
            let next = if first == 0.0 { "the next is at 5 s" } else { "the next is at 1 s" };
            assert!(said.contains("torque history") && said.contains(next), "{said}");
        }
        history.torque_history = Some(vec![[0.0, 1.0], [20.0, 1.0]]);
        assert!(notes(&history).is_empty(), "nothing changes");
    }
}
