//! Problems with known optima, written as margins to be maximised.
//!
//! HS: Hock and Schittkowski, *Test Examples for Nonlinear Programming Codes* (1981). CB, Madsen, Polak: Luksan and
//! Vlcek, *Test Problems for Nonsmooth Unconstrained and Linearly Constrained Optimization* (V-798, 2000).

use sprag_design::optimise::{Evaluate, Evaluation, NoEvaluation};

type Margins = fn(&[f64]) -> (Vec<f64>, Vec<f64>);

/// A problem together with its solution.
pub struct Model {
    pub name: &'static str,
    /// (objectives, limits) at x.
    pub margins: Margins,
    pub start: Vec<f64>,
    pub lo: Vec<f64>,
    pub hi: Vec<f64>,
    /// Known largest least margin.
    pub optimum: f64,
    /// Most evaluations, difference points and poll included.
    pub evaluations: usize,
}

impl Evaluate for Model {
    fn evaluate(&self, x: &[f64]) -> Result<Evaluation, NoEvaluation> {
        let (objectives, limits) = (self.margins)(x);
        Ok(Evaluation { objectives, limits, tie_break: 0.0 })
    }
}

fn cube(n: usize, lo: f64, hi: f64) -> (Vec<f64>, Vec<f64>) {
    (vec![lo; n], vec![hi; n])
}

pub fn all() -> Vec<Model> {
    let model = |name, margins: Margins, start: &[f64], (lo, hi), optimum, evaluations| Model {
        name,
        margins,
        start: start.to_vec(),
        lo,
        hi,
        optimum,
        evaluations,
    };
    vec![
        model("HS35 (Beale)", hs35, &[0.5; 3], cube(3, 0.0, 3.0), -1.0 / 9.0, 50),
        model("HS43 (Rosen-Suzuki)", hs43, &[0.0; 4], cube(4, -5.0, 5.0), 44.0, 90),
        model("HS71", hs71, &[1.0, 5.0, 5.0, 1.0], cube(4, 1.0, 5.0), -17.014017289, 55),
        model("HS100", hs100, &[1.0, 2.0, 0.0, 4.0, 0.0, 1.0, 1.0], cube(7, -5.0, 5.0), -680.6300573, 200),
        model(
            "Rosenbrock in a disc",
            rosenbrock_disc,
            &[-0.5, 0.5],
            cube(2, -1.5, 1.5),
            -disc_optimum(),
            120,
        ),
        model("CB2", cb2, &[1.0, -0.1], cube(2, -5.0, 5.0), -1.9522245, 40),
        model("CB3", cb3, &[2.0, 2.0], cube(2, -5.0, 5.0), -2.0, 35),
        model("Madsen", madsen, &[3.0, 1.0], cube(2, -5.0, 5.0), -0.6164324356, 55),
        model("Polak 6", polak6, &[0.0; 4], cube(4, -3.0, 3.0), 44.0, 145),
        model("speed reducer", speed_reducer, &REDUCER_MIDDLE, reducer_box(), 1.0 - 2994.471066 / 3000.0, 75),
    ]
}

fn hs35(x: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let f = 9.0 - 8.0 * x[0] - 6.0 * x[1] - 4.0 * x[2]
        + 2.0 * x[0] * x[0]
        + 2.0 * x[1] * x[1]
        + x[2] * x[2]
        + 2.0 * x[0] * x[1]
        + 2.0 * x[0] * x[2];
    (vec![-f], vec![3.0 - x[0] - x[1] - 2.0 * x[2]])
}

pub fn hs43(x: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let q = |a: [f64; 4]| (0..4).map(|i| a[i] * x[i] * x[i]).sum::<f64>();
    let l = |a: [f64; 4]| (0..4).map(|i| a[i] * x[i]).sum::<f64>();
    let f = q([1.0, 1.0, 2.0, 1.0]) + l([-5.0, -5.0, -21.0, 7.0]);
    (
        vec![-f],
        vec![
            8.0 - q([1.0; 4]) - l([1.0, -1.0, 1.0, -1.0]),
            10.0 - q([1.0, 2.0, 1.0, 2.0]) + l([1.0, 0.0, 0.0, 1.0]),
            5.0 - q([2.0, 1.0, 1.0, 0.0]) - l([2.0, -1.0, 0.0, -1.0]),
        ],
    )
}

/// The equality sum x^2 = 40 as the inequality that its multiplier makes active.
fn hs71(x: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let f = x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2];
    (vec![-f], vec![x.iter().product::<f64>() - 25.0, 40.0 - x.iter().map(|v| v * v).sum::<f64>()])
}

fn hs100(x: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let s = |v: f64| v * v;
    let f = s(x[0] - 10.0)
        + 5.0 * s(x[1] - 12.0)
        + x[2].powi(4)
        + 3.0 * s(x[3] - 11.0)
        + 10.0 * x[4].powi(6)
        + 7.0 * s(x[5])
        + x[6].powi(4)
        - 4.0 * x[5] * x[6]
        - 10.0 * x[5]
        - 8.0 * x[6];
    (
        vec![-f],
        vec![
            127.0 - 2.0 * s(x[0]) - 3.0 * x[1].powi(4) - x[2] - 4.0 * s(x[3]) - 5.0 * x[4],
            282.0 - 7.0 * x[0] - 3.0 * x[1] - 10.0 * s(x[2]) - x[3] + x[4],
            196.0 - 23.0 * x[0] - s(x[1]) - 6.0 * s(x[5]) + 8.0 * x[6],
            -4.0 * s(x[0]) - s(x[1]) + 3.0 * x[0] * x[1] - 2.0 * s(x[2]) - 5.0 * x[5] + 11.0 * x[6],
        ],
    )
}

fn rosenbrock(x: f64, y: f64) -> f64 {
    100.0 * (y - x * x).powi(2) + (1.0 - x).powi(2)
}

fn rosenbrock_disc(x: &[f64]) -> (Vec<f64>, Vec<f64>) {
    (vec![-rosenbrock(x[0], x[1])], vec![1.0 - x[0] * x[0] - x[1] * x[1]])
}

/// Least Rosenbrock value on the unit circle, by a scan and a golden section: the disc's, as its free minimum (1, 1)
/// lies outside.
fn disc_optimum() -> f64 {
    let on = |a: f64| rosenbrock(a.cos(), a.sin());
    let (mut a, mut b) = (0.5, 0.9);
    for _ in 0..200 {
        let g = 0.381_966_011_250_105 * (b - a);
        if on(a + g) < on(b - g) { b -= g } else { a += g }
    }
    on(0.5 * (a + b))
}

fn cb2(x: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let f =
        [x[0].powi(2) + x[1].powi(4), (2.0 - x[0]).powi(2) + (2.0 - x[1]).powi(2), 2.0 * (x[1] - x[0]).exp()];
    (f.map(|v| -v).to_vec(), Vec::new())
}

fn cb3(x: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let f =
        [x[0].powi(4) + x[1].powi(2), (2.0 - x[0]).powi(2) + (2.0 - x[1]).powi(2), 2.0 * (x[1] - x[0]).exp()];
    (f.map(|v| -v).to_vec(), Vec::new())
}

/// max(|q|, |sin x1|, |cos x2|), each modulus as two margins.
fn madsen(x: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let f = [x[0] * x[0] + x[1] * x[1] + x[0] * x[1], x[0].sin(), x[1].cos()];
    (f.iter().flat_map(|v| [-v, *v]).collect(), Vec::new())
}

/// Rosen-Suzuki as a minimax problem (weight 10) in bent coordinates.
fn polak6(x: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let y0 = x[0] - (x[3] + 1.0).powi(4);
    let y1 = x[1] - y0.powi(4);
    let (f, c) = hs43(&[y0, y1, x[2], x[3]]);
    let mut margins = vec![f[0]];
    margins.extend(c.iter().map(|c| f[0] + 10.0 * c));
    (margins, Vec::new())
}

const REDUCER_MIDDLE: [f64; 7] = [3.1, 0.75, 22.5, 7.8, 7.8, 3.4, 5.25];

fn reducer_box() -> (Vec<f64>, Vec<f64>) {
    (vec![2.6, 0.7, 17.0, 7.3, 7.3, 2.9, 5.0], vec![3.6, 0.8, 28.0, 8.3, 8.3, 3.9, 5.5])
}

/// Golinski's speed reducer (weight 2994.471066), objective 1 - weight/3000.
// 0.7854 is the literature's pi/4, and the known optimum depends on its digits.
#[allow(clippy::approx_constant)]
fn speed_reducer(x: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let [b, m, z, l1, l2, d1, d2] = [x[0], x[1], x[2], x[3], x[4], x[5], x[6]];
    let weight = 0.7854 * b * m * m * (3.3333 * z * z + 14.9334 * z - 43.0934)
        - 1.508 * b * (d1 * d1 + d2 * d2)
        + 7.4777 * (d1.powi(3) + d2.powi(3))
        + 0.7854 * (l1 * d1 * d1 + l2 * d2 * d2);
    let shaft = |l: f64, load: f64, d: f64| ((745.0 * l / (m * z)).powi(2) + load).sqrt() / (0.1 * d.powi(3));
    (
        vec![1.0 - weight / 3000.0],
        vec![
            1.0 - 27.0 / (b * m * m * z),
            1.0 - 397.5 / (b * m * m * z * z),
            1.0 - 1.93 * l1.powi(3) / (m * z * d1.powi(4)),
            1.0 - 1.93 * l2.powi(3) / (m * z * d2.powi(4)),
            1.0 - shaft(l1, 16.9e6, d1) / 1100.0,
            1.0 - shaft(l2, 157.5e6, d2) / 850.0,
            1.0 - m * z / 40.0,
            1.0 - 5.0 * m / b,
            1.0 - b / (12.0 * m),
            1.0 - (1.5 * d1 + 1.9) / l1,
            1.0 - (1.1 * d2 + 1.9) / l2,
        ],
    )
}
