use super::*;
use crate::clutch::{Clutch, ContactLaw, StressState};
use crate::design::Design;

const ELASTIC: ContactLaw = ContactLaw::Elastic { state: StressState::Layer };

fn clutch(law: ContactLaw) -> Clutch {
    let text = include_str!("../../../designs/huang2017-single-arc.toml");
    let mut clutch = Design::parse(text, "single").unwrap().clutch;
    clutch.contact = law;
    clutch
}

fn curve(law: ContactLaw) -> WedgeCurve {
    let clutch = clutch(law);
    WedgeCurve::build(&clutch, &clutch.profile().unwrap(), 0.0).unwrap()
}

/// g' of surfaces that stick, and with it s, found step by step from the two integrals of the module's head.
struct Stick {
    edges: Vec<f64>,
    gradient: Vec<f64>,
    behind: f64,
    g_behind: f64,
}

impl Stick {
    fn angle(at: f64, x: f64, a: f64) -> f64 {
        ((at - x) / a).clamp(-1.0, 1.0).asin()
    }

    /// s - T (delta_H/N) over Gamma.
    fn shift(&self, x: f64, a: f64, t: f64) -> f64 {
        // int (1 - F) dxi
        let whole = |at: f64| {
            let angle = Self::angle(at, x, a);
            a * ((0.5 - angle / PI) * angle.sin() - angle.cos() / PI)
        };
        let cells = self.edges.windows(2).zip(&self.gradient);
        self.g_behind - 0.5 * t + cells.map(|(e, g)| g * (whole(e[1]) - whole(e[0]))).sum::<f64>()
    }

    /// On to a patch that carries `t`.
    fn roll(&mut self, x: f64, a: f64, t: f64) {
        self.edges.push(x + a);
        let whole = |at: f64| {
            let angle = Self::angle(at, x, a);
            a * (angle - angle.cos())
        };
        let weights: Vec<f64> = self.edges.windows(2).map(|e| whole(e[1]) - whole(e[0])).collect();
        let held: f64 = weights.iter().zip(&self.gradient).map(|(w, g)| w * g).sum();
        self.gradient.push((PI * t - held) / weights[weights.len() - 1]);
        let left = self.edges.windows(2).zip(&self.gradient);
        self.g_behind +=
            left.map(|(e, g)| g * (e[1].min(x - a) - e[0].max(self.behind)).max(0.0)).sum::<f64>();
        self.behind = x - a;
    }
}

#[test]
fn the_shift_is_that_of_the_integral_equation() {
    // T = N, a = N^0.5, x = 2.25 N^0.9, Gamma = 1: Table 1's inner contact over that at 17 N m. Up to dx = da the patch
    // grows both ways and the traction follows the pressure.
    let (a, x) = (|n: f64| n.sqrt(), |n: f64| 2.25 * n.powf(0.9));
    let from = (0.5_f64 / (0.9 * 2.25)).powf(2.5);
    let (mid, half) = (x(from), a(from));
    let edges: Vec<f64> = (0..=200).map(|i| mid - half * (PI * f64::from(i) / 200.0).cos()).collect();
    let gradient =
        edges.windows(2).map(|e| from * (e[0] + e[1] - 2.0 * mid) / (half * half)).collect::<Vec<_>>();
    let mut stick = Stick { edges, gradient, behind: mid - half, g_behind: 0.0 };
    stick.g_behind = -stick.shift(mid, half, from);
    let (steps, last) = (1500, 10.0_f64);
    let (mut first, mut worst) = (f64::NAN, 0.0_f64);
    for i in 1..=steps {
        let n = from * (last / from).powf(f64::from(i) / f64::from(steps));
        stick.roll(x(n), a(n), n);
        let closed = -0.5 * n + 0.9 / 1.4 * 2.25 * n.powf(1.4);
        let off = (stick.shift(x(n), a(n), n) - closed) / n;
        if first.is_nan() {
            first = off;
        }
        worst = worst.max(off.abs());
    }
    let ratio = x(last) / a(last);
    println!("Gamma T off: {first:.3} where creep begins, {worst:.3} at most, up to x/a = {ratio:.2}");
    assert!(ratio > 5.5 && worst < 0.22, "{worst}");
    // Without the way rolled the half Gamma T of the patch's growth would stand alone.
    assert!((first - 0.143).abs() < 0.01, "{first}");
}

/// That torque works on approach and shift is an identity of `tests/wedge/statics.rs`; what of it goes along the tracks is that
/// of finite elements, 0.2 to 0.9 %.
#[test]
fn a_few_thousandths_of_the_work_go_along_the_tracks() {
    let curve = curve(ELASTIC);
    for n in [300.0, 1500.0, 8000.0] {
        let (_, c) = curve.closure_at_normal(n).unwrap();
        let along = c.t_bi.v * c.give_m_per_n[0] + c.t_be.v * c.give_m_per_n[1];
        let across = c.n_be.v * c.lengths.oc_e.d - n * c.lengths.oc_i.d;
        println!("N {n}: work along the tracks {:.3} % of that across", 100.0 * along / across);
        assert!((0.002..0.008).contains(&(along / across)), "{}", along / across);
    }
}

/// A soft shaft and ceramic sprags: torque works on the approaches and on what T gives by itself; what a softer race turns further
/// is no work, as the force lies behind the contact point for it.
#[test]
fn what_unlike_bodies_turn_further_costs_no_work() {
    let mut clutch = clutch(ELASTIC);
    clutch.sprags.flanks = None;
    clutch.materials.inner_race.youngs_modulus_pa = 110e9;
    clutch.materials.sprag.youngs_modulus_pa = 310e9;
    let curve = WedgeCurve::build(&clutch, &clutch.profile().unwrap(), 0.0).unwrap();
    for n in [300.0, 1500.0, 8000.0] {
        let (k, c) = curve.closure_at_normal(n).unwrap();
        let seats = curve.statics().seats(k, &c);
        let across = c.n_be.v * c.lengths.oc_e.d - n * c.lengths.oc_i.d;
        let along: f64 = [c.t_bi.v, c.t_be.v].iter().zip(c.give_m_per_n).map(|(t, give)| t * give).sum();
        let further =
            seats.iter().map(|s| s.tangential_n.v * s.entrainment() * s.rolled_m_per_n).sum::<f64>();
        let work = c.torque_nm(curve.statics().count).v / curve.statics().count as f64 * c.windup_slope();
        let off = (across + along - further) / work - 1.0;
        println!("N {n}: off by {off:.1e}, with {:.3} % for what turns further", 100.0 * further / work);
        assert!(off.abs() < 2e-5 && further / work > 5e-4, "{n}: {off:e}");
    }
}

/// Coupled rolling contact of unlike half-planes (tests/reference/unlike_rolling.py): half widths and radii 1.
#[test]
fn unlike_bodies_roll_as_their_integral_equations_say() {
    let table = include_str!("../../../tests/reference/unlike_rolling.csv");
    assert_eq!(table.lines().count(), 5);
    for line in table.lines().skip(1) {
        let v: Vec<f64> = line.split(',').map(|c| c.parse().unwrap()).collect();
        let [beta, ratio, behind, further] = v[..] else { panic!("{line}") };
        let contact = LineContact::external(2.0, 2.0, 1.0, 4.0 / PI).unwrap();
        let seat = Seat {
            contact,
            unlike: beta,
            normal_n: Dual::constant(1.0),
            tangential_n: Dual::constant(ratio),
            approach_m: Dual::constant(0.0),
            rolled_m_per_n: 1.0,
        };
        assert!((contact.half_width_m(1.0) - 1.0).abs() < 1e-12);
        assert!(
            (behind - ENTRAINED * beta * ratio).abs() <= 0.05 * behind.abs() + 1e-5
                && (further / seat.entrainment() - 1.0).abs() < 0.03,
            "{line}"
        );
    }
}

#[test]
fn other_laws_give_across_alone() {
    let curve = curve(ContactLaw::Roller { coefficient: 3.944e-5 });
    let (_, c) = curve.closure_at_normal(1500.0).unwrap();
    assert_eq!(c.give_m_per_n, [0.0; 2]);
    assert_eq!(curve.creep_loss(1500.0), None);
}

#[test]
fn what_creep_loses_is_the_loop_of_force_and_shift() {
    let curve = curve(ELASTIC);
    let loss = curve.creep_loss(1565.0).unwrap();
    // Work against the torque over windup, by the trapezoid rule on the table.
    let at = |i: u32| curve.at_normal(1565.0 * (f64::from(i) / 2000.0).max(1e-9)).unwrap();
    let work: f64 = (0..2000)
        .map(|i| {
            let (a, b) = (at(i), at(i + 1));
            0.5 * (a.torque_nm + b.torque_nm) * (b.windup_rad - a.windup_rad)
        })
        .sum();
    println!("{loss:?}, damping ratio {:.2e}", loss.damping_ratio());
    assert!((loss.work_j / work - 1.0).abs() < 1e-5, "{} {work}", loss.work_j);
    // The loop in torque and windup has the same area: creep leads by `lead_rad` in the end, with T to the power 2.4 or so.
    let loop_j = 2.0 * loss.lost_j;
    let box_j = at(2000).torque_nm * loss.lead_rad;
    assert!((0.5..0.65).contains(&(loop_j / box_j)), "{}", loop_j / box_j);
    assert!((1e-4..1e-3).contains(&loss.damping_ratio()), "{}", loss.damping_ratio());
}
