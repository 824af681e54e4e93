//! The result of a deck as rows of `stiffness`.
//!
//! Eq. (statics of one sector): torque from the moment of the contact forces about the axis at the inner
//! contact, C = n_s M; T_bi = M/OA with OA the radius of the patch's centre, N_bi = sqrt(F^2 - T_bi^2) from the
//! whole contact force F. Windup is the turn of the rim against the bore, so it holds the torsion of the two
//! rings and the tangential give of the contacts, which the library's rigid races do not.

use super::Facts;
use crate::design::Design;
use nalgebra::{Matrix3, Vector3};

/// One converged increment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResultRow {
    /// Torque C of the clutch, N m.
    pub torque_nm: f64,
    /// N_bi per sprag, N.
    pub normal_inner_n: f64,
    /// N_be per sprag, N.
    pub normal_outer_n: f64,
    /// T_bi/N_bi.
    pub tan_omega: f64,
    /// T_be/N_be.
    pub tan_nu: f64,
    /// Turn of the rim against the bore since first contact, rad.
    pub windup_rad: f64,
    /// Largest pressure at the inner contact, Pa: normal stress across the track, mean over an element half a
    /// mesh width deep (1 % below p_0 at four elements per half width); none where the result holds no stresses.
    pub pressure_inner_pa: Option<f64>,
}

/// What a result holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// Its rows, in order of time; the starting overlap, before anything turned, is none.
    pub rows: Vec<ResultRow>,
    /// How much of the turn that the deck asks for the last row has made, 0 to 1: less than 1 where `ccx` stopped.
    pub turned: f64,
}

impl Reading {
    /// The rows at these torques, N m, but for those outside the result; all rows where none is named.
    pub fn at(&self, torques_nm: &[f64]) -> Vec<ResultRow> {
        match torques_nm {
            [] => self.rows.clone(),
            torques => torques.iter().filter_map(|t| at_torque(&self.rows, *t)).collect(),
        }
    }

    /// Whether `ccx` came to the end of the deck; times in a result have seven digits.
    pub fn is_whole(&self) -> bool {
        self.turned > 1.0 - 1e-5
    }
}

/// Time at the end of step 1, in which the overlap takes hold; step 2 turns during another unit.
const START_TIME: f64 = 1.0;

/// Why a result has no rows.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NoRows {
    /// The deck was made from another design file.
    #[error("the deck was made from another design file (hash {found}, this one {own})")]
    OtherDesign {
        /// Hash of the design in its head.
        found: String,
        /// That of the design asked.
        own: String,
    },
    /// The deck's head lacks a fact, or has it damaged.
    #[error("no deck of this tool, or its head lacks {key}")]
    Deck {
        /// Key of the fact.
        key: &'static str,
    },
    /// A line of the result that should hold numbers does not.
    #[error("line {line} does not hold the numbers expected there")]
    Line {
        /// Number of the line, from 1.
        line: usize,
    },
    /// The result holds no converged increment under load.
    #[error("no converged increment under load")]
    Empty,
}

/// Force and moment about the axis at one contact, mm and N.
#[derive(Debug, Clone, Copy)]
struct Contact {
    force_n: f64,
    moment_nmm: f64,
    radius_mm: f64,
    /// Outward radial direction at the patch's centre.
    radial: [f64; 2],
}

#[derive(Debug, Clone, Default)]
struct Increment {
    time: f64,
    control: [Option<f64>; 2],
    inner: Option<Contact>,
    outer: Option<Contact>,
    /// Mean stresses sxx, syy, sxy of the elements under the inner track, MPa.
    stresses: Vec<[f64; 3]>,
}

impl Design {
    /// What the head of a deck of this design says.
    ///
    /// # Errors
    /// [`NoRows::Deck`], [`NoRows::OtherDesign`].
    pub fn deck_facts(&self, deck: &str) -> Result<Facts, NoRows> {
        let facts = Facts::parse(deck).map_err(|key| NoRows::Deck { key })?;
        match facts.hash == self.hash {
            true => Ok(facts),
            false => Err(NoRows::OtherDesign { found: facts.hash, own: self.hash.clone() }),
        }
    }
}

/// A result whose deck says `facts`.
///
/// # Errors
/// [`NoRows`].
pub fn read(facts: &Facts, dat: &str) -> Result<Reading, NoRows> {
    let found: Vec<(f64, ResultRow)> = increments(dat)?
        .iter()
        .filter(|i| i.time > START_TIME)
        .filter_map(|i| Some((i.time - START_TIME, row(facts, i)?)))
        .collect();
    let turned = found.last().ok_or(NoRows::Empty)?.0;
    Ok(Reading { rows: found.into_iter().map(|(_, row)| row).collect(), turned })
}

fn row(facts: &Facts, i: &Increment) -> Option<ResultRow> {
    let (inner, outer) = (i.inner?, i.outer?);
    let force = |c: Contact| {
        let tangential = c.moment_nmm.abs() / c.radius_mm;
        (
            facts.axial_factor * (c.force_n.powi(2) - tangential.powi(2)).max(0.0).sqrt(),
            tangential * facts.axial_factor,
        )
    };
    let ((n_bi, t_bi), (n_be, t_be)) = (force(inner), force(outer));
    // q = R [sin(theta - ahead) + sin(ahead)].
    let turn = |side: usize| {
        let (q, ahead) = (i.control[side]?, facts.ahead_rad[side]);
        Some(ahead + (q / facts.driven_mm[side] - ahead.sin()).clamp(-1.0, 1.0).asin())
    };
    let row = ResultRow {
        torque_nm: 1e-3 * facts.count as f64 * facts.axial_factor * inner.moment_nmm,
        normal_inner_n: n_bi,
        normal_outer_n: n_be,
        tan_omega: t_bi / n_bi,
        tan_nu: t_be / n_be,
        windup_rad: facts.start_rad + turn(1)? - turn(0)?,
        pressure_inner_pa: pressure_pa(&i.stresses, inner.radial),
    };
    (row.torque_nm > 0.0 && n_bi > 0.0 && n_be > 0.0 && row.windup_rad.is_finite()).then_some(row)
}

/// Largest compression across the track, Pa. The patch is so narrow that one direction serves all of it.
fn pressure_pa(stresses: &[[f64; 3]], n: [f64; 2]) -> Option<f64> {
    stresses
        .iter()
        .map(|s| -1e6 * (s[0] * n[0] * n[0] + s[1] * n[1] * n[1] + 2.0 * s[2] * n[0] * n[1]))
        .max_by(f64::total_cmp)
}

/// How far rows about a torque are taken together, as a factor either way: wide enough for a dozen rows of a deck, over which the
/// wander of a mesh, 0.1 to 0.3 % of tan omega from row to row as the patch passes its nodes, is evened out.
const TOGETHER: f64 = 1.6;
/// Rows from which on it can be.
const ENOUGH: usize = 6;

/// Torque, normal forces, tangents, windup and pressure at `torque_nm`: quadratics of their logarithms, the best through all rows
/// within a factor of 1.6 of that torque where there are six, else those through the three nearest rows (a line through two). None
/// outside the rows.
pub fn at_torque(rows: &[ResultRow], torque_nm: f64) -> Option<ResultRow> {
    let above = rows.iter().position(|r| r.torque_nm >= torque_nm)?;
    if above == 0 {
        return rows.first().filter(|r| r.torque_nm == torque_nm).copied();
    }
    let about = |r: &&ResultRow| (1.0 / TOGETHER..=TOGETHER).contains(&(r.torque_nm / torque_nm));
    let together: Vec<ResultRow> = rows.iter().filter(about).copied().collect();
    let (near, weights) = match together.len() >= ENOUGH {
        true => {
            let weights = evened(&together, torque_nm)?;
            (together.as_slice(), weights)
        }
        false => {
            let near = nearest(rows, above, torque_nm);
            (near, between(near, torque_nm)?)
        }
    };
    let mix = |value: &dyn Fn(&ResultRow) -> f64| -> f64 {
        near.iter().zip(&weights).map(|(r, w)| w * value(r).ln()).sum::<f64>().exp()
    };
    Some(ResultRow {
        torque_nm,
        normal_inner_n: mix(&|r| r.normal_inner_n),
        normal_outer_n: mix(&|r| r.normal_outer_n),
        tan_omega: mix(&|r| r.tan_omega),
        tan_nu: mix(&|r| r.tan_nu),
        windup_rad: mix(&|r| r.windup_rad),
        pressure_inner_pa: near
            .iter()
            .all(|r| r.pressure_inner_pa.is_some_and(|p| p > 0.0))
            .then(|| mix(&|r| r.pressure_inner_pa.unwrap_or(1.0))),
    })
}

/// The three rows nearest to the torque, the row `above` the first at or beyond it; two where there are no more.
fn nearest(rows: &[ResultRow], above: usize, torque_nm: f64) -> &[ResultRow] {
    let nearer_below = above >= 2
        && (above + 1 >= rows.len()
            || torque_nm / rows[above - 2].torque_nm < rows[above + 1].torque_nm / torque_nm);
    let from = if nearer_below { above - 2 } else { above - 1 };
    &rows[from..(from + 3).min(rows.len())]
}

/// Weights of the rows in the polynomial through all of them at the torque, over its logarithm; none where they do not rise.
fn between(near: &[ResultRow], torque_nm: f64) -> Option<Vec<f64>> {
    let xs: Vec<f64> = near.iter().map(|r| r.torque_nm.ln()).collect();
    if xs.windows(2).any(|w| w[1] <= w[0]) {
        return None;
    }
    let x = torque_nm.ln();
    let others = |a: usize| (0..xs.len()).filter(move |b| *b != a);
    Some((0..xs.len()).map(|a| others(a).map(|b| (x - xs[b]) / (xs[a] - xs[b])).product()).collect())
}

/// Weights of the rows in the quadratic that is the best through them, by least squares, at the torque, over its logarithm.
fn evened(rows: &[ResultRow], torque_nm: f64) -> Option<Vec<f64>> {
    let powers = rows.iter().map(|r| (r.torque_nm / torque_nm).ln()).map(|x| Vector3::new(1.0, x, x * x));
    let powers: Vec<Vector3<f64>> = powers.collect();
    let normal: Matrix3<f64> = powers.iter().map(|p| p * p.transpose()).sum();
    let at = normal.lu().solve(&Vector3::x())?;
    Some(powers.iter().map(|p| p.dot(&at)).collect())
}

/// Increments of a `.dat`: every block names its time; blocks of one time belong together. A last block cut
/// short (the solver stopped while writing) takes its increment with it.
fn increments(dat: &str) -> Result<Vec<Increment>, NoRows> {
    // A line without its end may hold half a number.
    let dat = dat.rfind('\n').map_or("", |end| &dat[..end]);
    let mut all: Vec<Increment> = Vec::new();
    let mut lines = dat.lines().enumerate().filter(|(_, l)| !l.trim().is_empty()).peekable();
    while let Some((at, head)) = lines.next() {
        let Some((_, time)) = head.split_once(" time ") else { continue };
        // Rows of numbers; in the statistics a row of words stands above each.
        let mut body: Vec<(usize, Vec<f64>)> = Vec::new();
        while let Some((line, text)) = lines.next_if(|(_, l)| !l.contains(" time ")) {
            let numbers: Option<Vec<f64>> = text.split_whitespace().map(|w| w.parse().ok()).collect();
            if let Some(numbers) = numbers {
                body.push((line + 1, numbers));
            }
        }
        let block = time.trim().parse::<f64>().map_err(|_| NoRows::Line { line: at + 1 }).and_then(|time| {
            if all.last().is_none_or(|i| i.time != time) {
                all.push(Increment { time, ..Increment::default() });
            }
            all.last_mut().map_or(Ok(()), |current| fill(current, head, at + 1, &body))
        });
        if let Err(e) = block {
            if lines.peek().is_some() {
                return Err(e);
            }
            all.pop();
        }
    }
    // Stresses of a part of the track may miss the peak.
    if let [.., before, last] = all.as_mut_slice()
        && last.stresses.len() < before.stresses.len()
    {
        last.stresses.clear();
    }
    Ok(all)
}

/// Put one block into its increment; blocks that say nothing here are passed over.
fn fill(current: &mut Increment, head: &str, line: usize, body: &[(usize, Vec<f64>)]) -> Result<(), NoRows> {
    let lost = NoRows::Line { line };
    if head.contains("displacements") && head.contains("NCONTROL") {
        for (side, slot) in current.control.iter_mut().enumerate() {
            *slot = Some(*body.get(side).and_then(|(_, n)| n.get(1)).ok_or_else(|| lost.clone())?);
        }
    } else if head.contains("statistics for slave set") {
        let (Some((_, total)), Some((_, centre))) = (body.first(), body.get(1)) else { return Err(lost) };
        let (&[x, y, _, _, _, moment_nmm], &[cx, cy, ..]) = (total.as_slice(), centre.as_slice()) else {
            return Err(lost);
        };
        let radius_mm = cx.hypot(cy);
        let radial = [cx / radius_mm, cy / radius_mm];
        let contact = Some(Contact { force_n: x.hypot(y), moment_nmm, radius_mm, radial });
        if head.contains("SSPRAGIN") {
            current.inner = contact;
        } else {
            current.outer = contact;
        }
    } else if head.contains("stresses") && head.contains("ETOUCH") {
        current.stresses = means(body)?;
    }
    Ok(())
}

/// Means over the integration points of each element: lines of element, point, sxx, syy, szz, sxy, sxz, syz.
fn means(body: &[(usize, Vec<f64>)]) -> Result<Vec<[f64; 3]>, NoRows> {
    let mut means = Vec::new();
    for of_one in body.chunk_by(|a, b| a.1.first() == b.1.first()) {
        let mut mean = [0.0; 3];
        for (line, numbers) in of_one {
            let &[_, _, xx, yy, _, xy, ..] = numbers.as_slice() else {
                return Err(NoRows::Line { line: *line });
            };
            for (sum, value) in mean.iter_mut().zip([xx, yy, xy]) {
                *sum += value / of_one.len() as f64;
            }
        }
        means.push(mean);
    }
    Ok(means)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three increments of the single-arc clutch in plane strain, 25 um, ccx 2.20 (`export --format calculix
    /// --variant plane-strain --torque 26.8`), all but two elements of the track cut out.
    const EXCERPT: &str = include_str!("../../../tests/reference/calculix_excerpt.dat");

    fn facts() -> Facts {
        Facts {
            hash: String::new(),
            variant: "plane-strain".into(),
            mesh_mm: 0.0247,
            count: 12,
            axial_factor: 2.0,
            length_mm: 6.0,
            start_rad: 9.257588728123737e-4,
            driven_mm: [7.21, 26.23],
            ahead_rad: [-1.3259644072725127e-2, 1.3259644072725127e-2],
            track_mm: [11.11, 19.44],
        }
    }

    #[test]
    fn a_result_of_ccx_agrees_with_the_independent_model() {
        let reading = read(&facts(), EXCERPT).unwrap();
        // Cut out of the middle of a run: 1.5625 - 1 of its turn.
        assert!((reading.turned - 0.5625).abs() < 1e-6 && !reading.is_whole());
        let rows = reading.rows;
        assert_eq!(rows.len(), 3);
        let row = at_torque(&rows, 16.8).unwrap();
        // fem_single_arc.csv, plane strain, 16.8 Nm.
        assert!((row.normal_inner_n / 1567.9 - 1.0).abs() < 3e-3, "{row:?}");
        assert!((row.windup_rad.to_degrees() / 1.6407 - 1.0).abs() < 3e-3, "{row:?}");
        assert!((row.tan_omega / 0.0804 - 1.0).abs() < 3e-3, "{row:?}");
        assert!((row.pressure_inner_pa.unwrap() / 1751e6 - 1.0).abs() < 0.03, "{row:?}");
        // Moment balance of the sprag: T_bi OA = T_be OB.
        let ratio = row.tan_omega * row.normal_inner_n / (row.tan_nu * row.normal_outer_n);
        assert!((ratio / (19.44 / 11.11) - 1.0).abs() < 3e-3, "{ratio}");
        assert!(at_torque(&rows, 1.0).is_none() && at_torque(&rows, 100.0).is_none());
    }

    #[test]
    fn a_power_law_is_read_exactly_between_rows() {
        let row = |t: f64| ResultRow {
            torque_nm: t,
            normal_inner_n: 90.0 * t.powf(0.98),
            normal_outer_n: 91.0 * t,
            tan_omega: 0.07 * t.powf(0.03),
            tan_nu: 0.04,
            windup_rad: 0.002 * t.powf(0.92),
            pressure_inner_pa: None,
        };
        let rows: Vec<ResultRow> = [1.0, 3.0, 7.0, 20.0].map(row).into();
        for t in [1.0, 2.0, 5.0, 12.0, 20.0] {
            let found = at_torque(&rows, t).unwrap();
            assert!((found.windup_rad / row(t).windup_rad - 1.0).abs() < 1e-12, "{t}");
            assert!((found.normal_inner_n / row(t).normal_inner_n - 1.0).abs() < 1e-12, "{t}");
        }
    }

    /// Forces that wander about a power law by 0.3 %: read at a torque, a tenth of it is left.
    #[test]
    fn the_wander_of_a_mesh_is_evened_out() {
        let rows: Vec<ResultRow> = (1..40)
            .map(|i| {
                let t = 10.0 * f64::from(i);
                let wander = 0.003 * (2.4 * f64::from(i)).sin();
                ResultRow {
                    torque_nm: t,
                    normal_inner_n: 90.0 * t.powf(0.98) * (1.0 + wander),
                    normal_outer_n: 91.0 * t,
                    tan_omega: 0.07,
                    tan_nu: 0.04,
                    windup_rad: 0.002 * t.powf(0.92),
                    pressure_inner_pa: None,
                }
            })
            .collect();
        for t in [150.0, 233.0, 300.0] {
            let row = at_torque(&rows, t).unwrap();
            let left = row.normal_inner_n / (90.0 * t.powf(0.98)) - 1.0;
            println!("{t}: {left:.1e}");
            assert!(left.abs() < 6e-4, "{t}: {left}");
            assert!((row.windup_rad / (0.002 * t.powf(0.92)) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_result_cut_anywhere_gives_whole_increments_or_a_reason() {
        let whole = read(&facts(), EXCERPT).unwrap().rows;
        for end in (0..EXCERPT.len()).step_by(37) {
            match read(&facts(), &EXCERPT[..end]) {
                // What is there is what the whole result has, but for a pressure of which the end is missing.
                Ok(reading) => {
                    for (row, full) in reading.rows.iter().zip(&whole) {
                        let pressure_inner_pa = row.pressure_inner_pa.and(full.pressure_inner_pa);
                        assert_eq!(*row, ResultRow { pressure_inner_pa, ..*full }, "{end}");
                    }
                }
                Err(e) => assert!(matches!(e, NoRows::Empty | NoRows::Line { .. })),
            }
        }
        let damaged = EXCERPT.replacen("moment about the origin (mx,my,mz)", "time ?", 1);
        assert!(matches!(read(&facts(), &damaged), Err(NoRows::Line { .. })));
        assert_eq!(read(&facts(), "nothing"), Err(NoRows::Empty));
    }

    #[test]
    fn the_starting_overlap_is_no_row() {
        let started = EXCERPT.replace("0.1395833E+01", "0.1000000E+01");
        let (whole, rest) = (read(&facts(), EXCERPT).unwrap(), read(&facts(), &started).unwrap());
        assert_eq!(rest.rows, whole.rows[1..]);
    }
}
