//! Work of N sprags one by one, for a counter of instructions.
//!
//! ```text
//! sprags_cost N HOW [SCENE [SIZE]]    a scene (low-6) of the paper's clutch for 0.01 s. HOW: one, N sprags alike as one; round and many, N unlike
//!                                     ones within SIZE (1e-6 m) between races that stay round and that bend; none, what these are made of
//! ```
//!
//! `RAYON_NUM_THREADS=1 valgrind --tool=callgrind`, none taken off, over right-hand sides and times: what an evaluation costs.

use sprag_design::Design;
use sprag_design::clutch::{ScenarioKind, Sharing};
use sprag_design::scenario::Settings;
use sprag_design::sprags::Many;

/// Runs of the scene: what else a process does differs by some 1e5 instructions from one to the next.
const TIMES: usize = 10;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let (count, how, name, size) = match words[..] {
        [count, how] => (count, how, "low-6", "1e-6"),
        [count, how, name] => (count, how, name, "1e-6"),
        [count, how, name, size] => (count, how, name, size),
        _ => return Err("sprags_cost N one|round|many|none [SCENE [SIZE]]".into()),
    };
    let design = Design::read("designs/huang2017-multi-arc.toml".as_ref())?;
    let mut scene = design.scenario(name).ok_or("no such scene")?.clone();
    scene.clutch.races.eccentricity = None;
    scene.clutch.sprags.count = count.parse()?;
    let ScenarioKind::TorsionalExcitation { duration_s, .. } = &mut scene.kind else {
        return Err("a scene of torsional excitation is asked for".into());
    };
    *duration_s = 0.01;
    let unlike = Sharing { seed: 1, size_within_m: size.parse()?, ..Sharing::default() };
    // Made in any case, so that what makes them is in all.
    let one = Many::new(&scene, &Sharing::default(), false)?;
    let (round, many) = (Many::new(&scene, &unlike, false)?, Many::bending(&scene, &unlike)?);
    let chosen = match how {
        "one" => one,
        "round" => round,
        "many" => many,
        _ => return Ok(()),
    };
    let mut run = chosen.run(&Settings::default(), 1e-9, 0);
    for _ in 1..TIMES {
        run = chosen.run(&Settings::default(), 1e-9, 0);
    }
    println!(
        "{TIMES} times {:?}, {} groups, {} events, {:?}, looks: {}, {:?}, energy left {:e}",
        run.stop,
        chosen.groups.len(),
        run.events,
        run.counters,
        run.looks,
        run.bending,
        run.residual_j / run.through_j
    );
    Ok(())
}
