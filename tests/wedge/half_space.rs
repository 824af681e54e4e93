//! Literature tests of the half-space reference: Hertz, the nine rows, Lundberg, free ends.

use std::f64::consts::PI;

use sprag_design::contact::half_space::{
    ConjugateSettings, HalfSpaceGrid, HalfSpaceLine, HalfSpaceLineSolution, HalfSpaceStatus, free_end_factor,
};
use sprag_design::contact::{AxialFit, ContactError, Edge, EndDrop, Flank, LineContact, Peak};
use sprag_design::material::{Material, PlaneState};

const STEEL: Material = Material { youngs_modulus_pa: 206e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };

fn contact(radius_m: f64, length_m: f64) -> LineContact {
    let contact_modulus_pa = PlaneState::Strain.contact_modulus_pa(&STEEL, &STEEL);
    LineContact { effective_radius_m: radius_m, length_m, contact_modulus_pa }
}

fn converged(status: HalfSpaceStatus) -> usize {
    let HalfSpaceStatus::Converged { iterations } = status else { panic!("{status:?}") };
    iterations
}

#[test]
fn hertz_sphere() {
    let (radius, load, e_star): (f64, f64, f64) = (10e-3, 50.0, 113e9);
    // Johnson (4.22)-(4.24)
    let a = (3.0 * load * radius / (4.0 * e_star)).cbrt();
    let (approach, p0) = (a * a / radius, 1.5 * load / (PI * a * a));
    let grid = HalfSpaceGrid::new([2.5 * a; 2], [128, 128], e_star, [0.0; 2]).unwrap();
    let gap = |x: f64, y: f64| (x * x + y * y) / (2.0 * radius);
    let found = grid.solve(load, gap, |_, _| 1.0, &ConjugateSettings::default()).unwrap();
    let peak = found.pressure_pa.iter().fold(0.0, |m: f64, p| m.max(*p));
    let iterations = converged(found.status);
    println!(
        "{iterations} iterations: approach {:e}, p0 {:e}",
        found.approach_m / approach - 1.0,
        peak / p0 - 1.0
    );
    assert!((found.approach_m / approach - 1.0).abs() < 1e-3);
    assert!((peak / p0 - 1.0).abs() < 1e-3);
    // all pressures, against p0 sqrt(1 - r^2/a^2), in the mean
    let [_, along] = grid.cells();
    let off: f64 = (0..found.pressure_pa.len())
        .map(|k| {
            let [x, y] = grid.middle_m(k / along, k % along);
            (found.pressure_pa[k] - p0 * (1.0 - (x * x + y * y) / (a * a)).max(0.0).sqrt()).abs()
        })
        .sum();
    assert!(off / found.pressure_pa.iter().sum::<f64>() < 3e-3, "{off}");
}

#[test]
fn hertz_cylinder() {
    // one row a thousand half widths long has the plane pressures in its middle
    let c = contact(3e-3, 0.1);
    let load = 26_000.0;
    let (a, p0) = (c.half_width_m(load), c.peak_pressure_pa(load));
    for across in [64, 128] {
        let found = HalfSpaceLine::new(c, across, 1).solve(load).unwrap();
        converged(found.status);
        // uniform along y, elliptical across: q/(pi E*) (ln(4 l^2/a^2) + 1) in the middle
        let q = load / c.length_m;
        let approach = q / (PI * c.contact_modulus_pa) * ((2.0 * c.length_m / a).powi(2).ln() + 1.0);
        let cell = found.patch_width_m / across as f64;
        println!(
            "{across} across: approach {:e}, p0 {:e}, half width {} of {a}, cell {cell}",
            found.approach_m / approach - 1.0,
            found.pressure_pa[0] / p0 - 1.0,
            found.half_width_m[0],
        );
        assert!((found.approach_m / approach - 1.0).abs() < 1e-3);
        assert!((found.pressure_pa[0] / p0 - 1.0).abs() < 1e-3);
        assert!((found.half_width_m[0] - a).abs() < cell);
    }
}

#[test]
fn the_nine_rows() {
    let text = include_str!("../reference/half_space_line_contact.csv");
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let mut rows = 0;
    for record in reader.records() {
        let record = record.unwrap();
        let number = |i: usize| record[i].parse::<f64>().unwrap();
        let c = contact(1e-3 * number(1), 1e-3 * number(2));
        let (load, slices) = (number(3), record[6].parse::<usize>().unwrap());
        let found = HalfSpaceLine::new(c, 64, slices).solve(load).unwrap();
        let iterations = converged(found.status);
        let p0 = c.peak_pressure_pa(load);
        let off = [
            ("approach", 1e6 * found.approach_m / number(10) - 1.0, 5e-3),
            ("centre", found.pressure_pa[slices / 2] / p0 / number(7) - 1.0, 5e-3),
            ("end pressure", found.pressure_pa[0] / p0 / number(8) - 1.0, 0.02),
            ("end load", found.load_n[0] * slices as f64 / load / number(9) - 1.0, 0.02),
        ];
        println!("{} {load} N, {slices} slices, {iterations} iterations: {off:.4?}", &record[0]);
        for (what, off, bound) in off {
            assert!(off.abs() < bound, "{what} {off}");
        }
        assert!(matches!(found.edges, [Edge::Singular { .. }, Edge::Singular { .. }]));
        assert!(matches!(found.peak, Peak::AtEnd { .. }));
        let shown = found.load_n.iter().rev().zip(&found.load_n);
        assert!(shown.clone().all(|(a, b)| (a / b - 1.0).abs() < 1e-5));
        assert!((found.load_n.iter().sum::<f64>() / load - 1.0).abs() < 1e-12);
        rows += 1;
    }
    assert_eq!(rows, 9);
}

/// "1.12-1.13 p0" in the project's notes, from grids of 5-40 um. Rows of 50 um give that; as rows get narrower the
/// peak tends to 1.135-1.138, whatever the load (tamaas on the same grid: reports/half-space-peer.md).
#[test]
fn lundbergs_profile_peaks_at_1_13_to_1_14_times_hertz_at_its_load() {
    let c = contact(2.9519e-3, 6e-3);
    let peak = |load: f64, along: usize| {
        let fit = AxialFit::shaped(6e-3, EndDrop::lundberg(&c, load).unwrap(), 0.0).unwrap();
        let found = HalfSpaceLine::new(c, 64, along).solve_along(load, &fit).unwrap();
        converged(found.status);
        let p0 = c.peak_pressure_pa(load);
        let Peak::Bounded { pressure_pa, y_m } = found.peak else { panic!("{:?}", found.peak) };
        assert!((found.pressure_pa[along / 2] / p0 - 1.0).abs() < 3e-3);
        // within a half width of the end
        assert!(3e-3 - y_m.abs() < c.half_width_m(load));
        println!("{load} N, {along} rows: peak {:.4} p0 at {:.3} mm", pressure_pa / p0, 1e3 * y_m);
        pressure_pa / p0
    };
    assert!((1.12..1.13).contains(&peak(2441.0, 120)));
    for (load, rows) in [(60.0, 3840), (1558.0, 960), (2441.0, 960)] {
        let fine = peak(load, rows);
        assert!((fine - 1.137).abs() < 3e-3, "{load}: {fine}");
        assert!((peak(load, rows / 8 * 5) / fine - 1.0).abs() < 3e-3, "{load}");
    }
}

#[test]
fn a_free_end_is_softer() {
    assert!((free_end_factor(0.3) - 1.39).abs() < 1e-12);
    let c = contact(2.9519e-3, 6e-3);
    let flush = AxialFit::new([Flank::straight(6e-3), Flank::straight(6e-3)], 0.0).unwrap();
    let end = |along: usize, free: bool, fit: &AxialFit| {
        let line = HalfSpaceLine::new(c, 64, along);
        let line = if free { line.with_free_ends([STEEL; 2]) } else { line };
        let found = line.solve_along(2441.0, fit).unwrap();
        converged(found.status);
        found
    };
    let p0 = c.peak_pressure_pa(2441.0);
    let ratio = |s: &HalfSpaceLineSolution| s.pressure_pa[0] / p0;
    // half-spaces bear most at the end, quarter-spaces least
    let (coarse, stiff) = (end(60, true, &flush), end(60, false, &flush));
    println!("flush: {} free, {} half-spaces", ratio(&coarse), ratio(&stiff));
    assert!(coarse.load_n[..30].is_sorted() && stiff.load_n[..30].is_sorted_by(|a, b| a >= b));
    assert!(ratio(&coarse) < 1.0 && ratio(&stiff) > 1.7);
    assert!(matches!(coarse.edges[0], Edge::Flush { .. }) && matches!(stiff.edges[0], Edge::Flush { .. }));
    // one body ends: between the two, still singular
    let inside = AxialFit::square(6e-3).unwrap();
    let (hard, soft) = (end(60, false, &inside), end(60, true, &inside));
    println!("inside: {} half-spaces, {} with the free face", ratio(&hard), ratio(&soft));
    assert!(ratio(&soft) < ratio(&hard) && ratio(&soft) > ratio(&coarse));
    assert!(matches!(soft.edges[0], Edge::Singular { .. }));
    assert!(coarse.approach_m > soft.approach_m && soft.approach_m > hard.approach_m);
}

/// A load with its images about both ends is as good as endless: the plane contact, alike in every row.
#[test]
fn whole_mirrors_make_the_contact_uniform() {
    let c = contact(2.9519e-3, 6e-3);
    let (a, p0) = (c.half_width_m(2441.0), c.peak_pressure_pa(2441.0));
    let grid = HalfSpaceGrid::new([3.6 * a, 6e-3], [64, 60], c.contact_modulus_pa, [1.0; 2]).unwrap();
    let gap = |x: f64, _: f64| x * x / (2.0 * c.effective_radius_m);
    let found = grid.solve(2441.0, gap, |_, _| 1.0, &ConjugateSettings::default()).unwrap();
    converged(found.status);
    for (j, p) in found.pressure_pa[..60].iter().enumerate() {
        // the images of images are missing
        assert!((p / p0 - 1.0).abs() < 0.02, "{j}: {}", p / p0);
    }
}

#[test]
fn lifted_and_extreme_contacts_are_solved() {
    let c = contact(2.9519e-3, 6e-3);
    let tilted = AxialFit::shaped(6e-3, EndDrop::Square, 1e-3).unwrap();
    let mirrored = AxialFit::shaped(6e-3, EndDrop::Square, -1e-3).unwrap();
    let mut last = 0.0;
    for load in [1e-6, 1.0, 200.0, 2441.0, 1e6] {
        let found = HalfSpaceLine::new(c, 32, 60).solve_along(load, &tilted).unwrap();
        let iterations = converged(found.status);
        println!(
            "{load} N: {iterations} iterations, approach {:e}, edges {:?}",
            found.approach_m, found.edges
        );
        assert!(found.approach_m > last);
        last = found.approach_m;
        let other = HalfSpaceLine::new(c, 32, 60).solve_along(load, &mirrored).unwrap();
        assert!((other.approach_m / last - 1.0).abs() < 1e-6);
        assert_eq!(load < 1e3, found.edges[1] == Edge::Open);
    }
    let idle = HalfSpaceLine::new(c, 32, 60).solve(0.0).unwrap();
    assert_eq!((idle.status, idle.peak, idle.approach_m), (HalfSpaceStatus::Unloaded, Peak::None, 0.0));
}

#[test]
fn what_does_not_converge_says_so() {
    let c = contact(2.9519e-3, 6e-3);
    let hasty = ConjugateSettings { most_iterations: 3, ..ConjugateSettings::default() };
    let found = HalfSpaceLine::new(c, 64, 60).with_settings(hasty).solve(2441.0).unwrap();
    let HalfSpaceStatus::NoConvergence { residual } = found.status else { panic!("{:?}", found.status) };
    assert!(residual > 1e-8 && residual.is_finite());
}

#[test]
fn bad_questions_are_refused() {
    let c = contact(2.9519e-3, 6e-3);
    for cells in [(0, 1), (3, 1), (2, 0), (2, 1 << 30)] {
        let refused = HalfSpaceLine::new(c, cells.0, cells.1).solve(1.0);
        assert!(matches!(refused, Err(ContactError::Grid { .. })), "{cells:?}");
    }
    let line = HalfSpaceLine::new(c, 8, 4);
    assert!(line.solve(f64::INFINITY).is_err());
    assert!(line.reaching(f64::NAN).solve(1.0).is_err());
    assert!(matches!(
        line.solve_along(1.0, &AxialFit::square(5e-3).unwrap()),
        Err(ContactError::Length { .. })
    ));
}
