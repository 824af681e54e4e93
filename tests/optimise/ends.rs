use super::*;
#[test]
fn scatter() {
    for model in all() {
        let mut state = 1u64;
        let mut rnd = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let mut counts = Vec::new();
        for k in 0..40 {
            let x0: Vec<f64> = model.lo.iter().zip(&model.hi).map(|(l, h)| l + (h - l) * rnd()).collect();
            let found = maximise_least_margin(
                &model,
                &x0,
                &model.lo,
                &model.hi,
                &Settings::default(),
                Run::default(),
            )
            .unwrap();
            let err = (found.evaluation.least_margin() - model.optimum) / model.optimum.abs().max(1.0);
            if found.status != Status::Converged || err.abs() > 1e-6 {
                println!(
                    "   {} start {k}: {:?} {} evals, err {err:.2e} viol {:.1e} {:?}",
                    model.name,
                    found.status,
                    found.evaluations,
                    found.evaluation.violation(),
                    found.residuals
                );
            }
            counts.push(found.evaluations);
        }
        counts.sort();
        println!("{}: {} median {} max {}", model.name, counts[0], counts[20], counts[39]);
    }
}
