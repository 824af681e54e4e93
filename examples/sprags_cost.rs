//! Work of N sprags one by one, for a counter of instructions.
//!
//! ```text
//! sprags_cost N one|many|none     low-6 of the paper's clutch for 0.01 s: N sprags alike as one, N unlike ones between races that bend, or
//!                                 nothing but what both are made of
//! ```

use sprag_design::Design;
use sprag_design::clutch::{ScenarioKind, Sharing};
use sprag_design::scenario::Settings;
use sprag_design::sprags::Many;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let args: Vec<String> = std::env::args().collect();
    let count: usize = args[1].parse()?;
    let design = Design::read("designs/huang2017-multi-arc.toml".as_ref())?;
    let mut scene = design.scenario(args.get(3).map_or("low-6", |s| s)).ok_or("no scene")?.clone();
    scene.clutch.races.eccentricity = None;
    scene.clutch.sprags.count = count;
    let size = if args.len() > 4 { args[4].parse()? } else { 1e-6 };
    let ScenarioKind::TorsionalExcitation { duration_s, .. } = &mut scene.kind else {
        return Err("kind".into());
    };
    *duration_s = 0.01;
    let unlike = Sharing { seed: 1, size_within_m: size, ..Sharing::default() };
    let (one, many) = (Many::new(&scene, &Sharing::default(), false)?, Many::bending(&scene, &unlike)?);
    let many = match &args[2][..] {
        "one" => one,
        "round" => Many::new(&scene, &unlike, false)?,
        _ => many,
    };
    if args[2] != "none" {
        let run = many.run(&Settings::default(), 1e-9, 0);
        println!(
            "{:?} groups {} events {} {:?} looks {} {:?} residual {:e}",
            run.stop,
            many.groups.len(),
            run.events,
            run.counters,
            run.looks,
            run.bending,
            run.residual_j / run.through_j
        );
    }
    Ok(())
}
