use super::scale::{round_step, thinned, tick, widened};
use super::style::styles;
use super::*;

fn two_curves() -> Plot {
    Plot::new("Torque, Nm", "Windup, deg")
        .curve("single <arc>", (0..50).map(|i| [f64::from(i), 0.1 * f64::from(i)]).collect())
        .curve("gaps", vec![[0.0, 1.0], [1.0, f64::NAN], [2.0, 2.0], [3.0, f64::INFINITY], [4.0, 4.0]])
        .marker(12.0, "1|2")
        .marker(12.5, "2|3")
        .marker(400.0, "off the plot")
        .level(3.0, "allowed")
}

#[test]
fn gaps_and_infinities_leave_no_trace_in_the_svg() {
    let svg = two_curves().to_svg();
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    assert!(svg.contains("single &lt;arc&gt;"));
    assert!(!svg.contains("off the plot"));
    // Three lone points of the second curve, each a dot.
    assert_eq!(svg.matches("<circle").count(), 3);
}

#[test]
fn nothing_to_draw_is_said() {
    for points in [vec![], vec![[f64::NAN, 1.0]]] {
        let svg = Plot::new("x", "y").curve("empty", points).to_svg();
        assert!(svg.contains("no data") && !svg.contains("NaN"), "{svg}");
    }
}

#[test]
fn logarithmic_axes_skip_what_has_no_logarithm() {
    let mut plot =
        Plot::new("Run time, s", "Error").curve("method", vec![[0.0, 1.0], [1e-3, 1e-9], [1.0, 1e-3]]);
    (plot.log_x, plot.log_y) = (true, true);
    let svg = plot.to_svg();
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
}

#[test]
fn a_constant_curve_has_an_axis() {
    let svg = Plot::new("x", "y").curve("flat", vec![[0.0, 3.0], [1.0, 3.0]]).to_svg();
    assert!(!svg.contains("NaN"));
    let [low, high] = widened((3.0, 3.0), false, 0.05);
    assert!(low < 3.0 && high > 3.0);
}

#[test]
fn a_range_from_close_to_zero_begins_at_zero() {
    assert_eq!(widened((0.3, 200.0), false, 0.0), [0.0, 200.0]);
    assert_eq!(widened((-1e-14, 200.0), false, 0.05), [0.0, 210.0]);
    assert_eq!(widened((30.0, 200.0), false, 0.0), [30.0, 200.0]);
}

#[test]
fn the_svg_scales_and_names_no_other_place() {
    let svg = two_curves().to_svg();
    assert!(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 720 380\""));
    assert_eq!(svg.matches("http").count(), 1);
    assert!(svg.contains("role=\"img\"") && !svg.contains("<script"));
    // Ids would clash between the figures of a page.
    assert!(!svg.contains(" id="), "{svg}");
}

#[test]
fn thinning_keeps_the_ends_and_every_peak() {
    let mut run: Vec<[f64; 2]> = (0..100_000).map(|i| [f64::from(i), 0.0]).collect();
    run[31_415][1] = 5.0;
    run[27_182][1] = -3.0;
    let kept = thinned(&run, 720.0);
    assert!(kept.len() < 6000 && kept[0] == [0.0, 0.0] && kept[kept.len() - 1] == [99_999.0, 0.0]);
    assert!(kept.contains(&[31_415.0, 5.0]) && kept.contains(&[27_182.0, -3.0]));
    assert!(kept.is_sorted_by(|a, b| a[0] < b[0]));
    assert_eq!(thinned(&run[..100], 720.0).len(), 100);
}

/// Texts of the ticks of an axis 600 px long.
fn texts(log: bool, range: [f64; 2], pitch_px: f64) -> Vec<String> {
    let axis = Axis { log, range, px: [0.0, 600.0] };
    axis.ticks(pitch_px).into_iter().map(|t| t.text).filter(|t| !t.is_empty()).collect()
}

#[test]
fn ticks_of_one_axis_agree() {
    assert_eq!(tick(0.5, 0.5, 2.0), "0.5");
    assert_eq!(tick(1.0, 0.5, 2.0), "1.0");
    assert_eq!(tick(40.0, 20.0, 100.0), "40");
    assert_eq!(tick(-0.0, 20.0, 100.0), "0");
    assert_eq!(tick(2.5e-5, 5e-6, 1e-4), "2.5e-5");
    assert_eq!(tick(-0.0072, 2e-4, 0.01), "−0.0072");
    assert_eq!([0.03, 47.0, 50.0, 0.0].map(round_step), [0.05, 50.0, 50.0, 1.0]);
    assert_eq!(texts(false, [0.0, 1.2], 100.0), ["0", "0.2", "0.4", "0.6", "0.8", "1.0", "1.2"]);
    assert_eq!(texts(false, [-0.3, 0.3], 200.0), ["−0.2", "0", "0.2"]);
}

#[test]
fn an_axis_begins_with_a_number_and_a_plot_says_what_it_is_of() {
    for range in [[3.3, 10.2], [-0.37, 0.21], [101.0, 119.0], [0.0, 7.0]] {
        let axis = Axis { log: false, range, px: [0.0, 600.0] }.begun(60.0);
        let first = &axis.ticks(60.0)[0];
        assert!(first.px.abs() < 1e-6 && !first.text.is_empty(), "{range:?}: {first:?}");
        assert!(axis.range[0] <= range[0] + 1e-9 && axis.range[1] == range[1], "{:?}", axis.range);
    }
    assert!(two_curves().to_svg().contains(">Windup against torque<"));
    let of = |y: &str, x: &str| Plot::new(x, y).title();
    assert_eq!(of("tan ω, inner contact", "Torque, Nm"), "tan ω, inner contact against torque");
    assert_eq!((of("T/N", "Time, ms"), of("", "Time, ms")), ("T/N against time".into(), String::new()));
}

#[test]
fn ticks_far_from_zero_are_told_apart() {
    let told = texts(false, [1_000_000.0, 1_000_300.0], 200.0);
    assert_eq!(told, ["1.0000e6", "1.0001e6", "1.0002e6", "1.0003e6"]);
}

#[test]
fn powers_of_ten_alone_are_written_on_a_long_logarithmic_axis() {
    assert_eq!(texts(true, [2.0, 5.0], 80.0), ["100", "1000", "1e4", "1e5"]);
    assert_eq!(texts(true, [4.0, 5.0], 80.0), ["1e4", "2e4", "5e4", "1e5"]);
    // The first is written in any case.
    assert_eq!(
        texts(true, [-13.0, 2.0], 80.0),
        ["1e-13", "1e-11", "1e-9", "1e-7", "1e-5", "0.001", "0.1", "10"]
    );
    // From the smallest number to the largest.
    assert!(texts(true, [-324.0, 309.0], 80.0).len() < 9);
}

#[test]
fn the_longest_texts_stay_inside_the_figure() {
    let svg = Plot::new("x", "y").curve("c", vec![[0.0, 0.0], [100_000.0, 1.0]]).to_svg();
    let place = svg.split(">100000<").next().unwrap().rsplit("<text x=\"").next().unwrap();
    let x: f64 = place.split('"').next().unwrap().parse().unwrap();
    assert!(x + text_width("100000", TEXT_PX) / 2.0 <= 720.0, "{x}");
}

#[test]
fn no_two_curves_of_a_plot_look_alike() {
    let dashes = [Dash::Solid, Dash::Dashed, Dash::Dotted];
    let many: Vec<Curve> =
        (0..36).map(|i| Curve { dash: dashes[i % 5 % 3], ..Curve::new("c", vec![]) }).collect();
    let all = styles(&many);
    for (i, a) in all.iter().enumerate() {
        assert!(!all[..i].contains(a), "{i}: {a:?}");
    }
    // A law's colour is its own in every plot, whatever stands before it.
    let laws = [Curve::new("other", vec![]), Curve::new("law", vec![]).coloured(0)];
    let twice = [
        Curve::new("law", vec![]).coloured(0),
        Curve { dash: Dash::Dashed, ..Curve::new("law, local", vec![]).coloured(0) },
    ];
    assert_eq!(styles(&laws)[1].css(), styles(&twice)[0].css());
    assert_eq!(styles(&twice)[0].css(), styles(&twice)[1].css());
    assert_ne!(styles(&twice)[0], styles(&twice)[1]);
}

#[test]
fn errors_at_rounding_are_drawn_where_they_are() {
    let mut plot = Plot::new("Tolerance", "Error")
        .curve("method", vec![[1.0, 1e-4], [2.0, 1e-8], [3.0, 1e-12]])
        .level(1e-6, "wanted");
    (plot.log_y, plot.curves[0].dots) = (true, true);
    let svg = plot.to_svg();
    let heights: Vec<f64> =
        svg.split("cy=\"").skip(1).map(|rest| rest.split('"').next().unwrap().parse().unwrap()).collect();
    assert_eq!(heights.len(), 3);
    let [upper, lower] = [heights[1] - heights[0], heights[2] - heights[1]];
    assert!(upper > 0.0 && (upper / lower - 1.0).abs() < 1e-6, "{heights:?}");
    assert!(svg.contains(">1e-12<") && svg.contains(">1e-4<"), "{svg}");
}

#[test]
fn the_name_of_a_level_stands_where_no_curve_runs() {
    let at = |curve: Vec<[f64; 2]>| {
        let svg = Plot::new("Torque", "Force").curve("", curve).level(1.0, "peak").to_svg();
        let text = svg.split("<text").find(|t| t.contains(">peak<")).unwrap().to_owned();
        text.contains("text-anchor=\"end\"")
    };
    assert!(at(vec![[0.0, 0.0], [1.0, 0.2], [2.0, 0.3]]));
    // A curve that ends just above the line at the right.
    assert!(!at(vec![[0.0, 0.0], [1.9, 1.06], [2.0, 1.06]]));
}
