//! Mass properties of an outline, exact, by Green's theorem.

use super::outline::{Outline, Segment, along};
use nalgebra::Vector2;

/// What an outline weighs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassProperties {
    /// Area inside the outline, m^2.
    pub area_m2: f64,
    /// Mass, kg.
    pub mass_kg: f64,
    /// Centroid G in the body frame, m.
    pub centroid_m: [f64; 2],
    /// Moment of inertia about the axis through G normal to the plane, kg m^2.
    pub inertia_kg_m2: f64,
}

impl Outline {
    /// Mass properties of a prism of this outline, `length_m` long, m, of density `density_kg_m3`, kg/m^3.
    pub fn mass_properties(&self, length_m: f64, density_kg_m3: f64) -> MassProperties {
        // First about a point on the outline, then about the centroid: the polar moment about a distant
        // origin would lose digits to the parallel-axis term.
        let near = self.segments().first().map_or_else(Vector2::zeros, Segment::start_m);
        let rough = near + self.moments(near).mean();
        let about_rough = self.moments(rough);
        let shift = about_rough.mean();
        let centroid = rough + shift;
        let surface_kg_m2 = density_kg_m3 * length_m;
        MassProperties {
            area_m2: about_rough.area,
            mass_kg: surface_kg_m2 * about_rough.area,
            centroid_m: [centroid.x, centroid.y],
            inertia_kg_m2: surface_kg_m2 * (about_rough.polar - about_rough.area * shift.norm_squared()),
        }
    }

    fn moments(&self, origin: Vector2<f64>) -> Moments {
        self.segments().iter().fold(Moments::default(), |sum, segment| sum.plus(&moments(segment, origin)))
    }
}

/// Integrals of 1, p and |p|^2 over the area.
#[derive(Default)]
struct Moments {
    area: f64,
    first: Vector2<f64>,
    polar: f64,
}

impl Moments {
    fn plus(self, other: &Self) -> Self {
        Self {
            area: self.area + other.area,
            first: self.first + other.first,
            polar: self.polar + other.polar,
        }
    }

    /// Mean of p; zero for an outline without area.
    fn mean(&self) -> Vector2<f64> {
        if self.area == 0.0 { Vector2::zeros() } else { self.first / self.area }
    }
}

/// A segment's share of the integrals about `origin`. For f homogeneous of degree k, div(f p) = (k + 2) f, so
/// the integral of f over the area is 1/(k + 2) of the closed integral of f (x dy - y dx).
fn moments(segment: &Segment, origin: Vector2<f64>) -> Moments {
    match *segment {
        Segment::Line { from_m, to_m } => {
            // p = from + s (to - from): x dy - y dx = from x to ds.
            let (p, q) = (from_m - origin, to_m - origin);
            let cross = p.perp(&q);
            Moments {
                area: cross / 2.0,
                first: cross / 6.0 * (p + q),
                polar: cross / 12.0 * (p.norm_squared() + p.dot(&q) + q.norm_squared()),
            }
        }
        Segment::Arc { centre_m, radius_m: r, from_azimuth_rad, sweep_rad } => {
            // p = c + r n, n = cos(psi) m + sin(psi) t about the mid-azimuth, -h < psi < h, which leaves the
            // even terms. Azimuth runs clockwise: x dy - y dx = -r (r + c.n) dpsi, |p|^2 = |c|^2 + r^2 + 2 r c.n.
            let c = centre_m - origin;
            let h = sweep_rad / 2.0;
            let m = along(from_azimuth_rad + h);
            let t = Vector2::new(m.y, -m.x);
            let (a, b) = (c.dot(&m), c.dot(&t));
            let (sin, cos) = h.sin_cos();
            let flux = r * sweep_rad + 2.0 * a * sin; // integral of r + c.n
            let (cos2, sin2) = (h + sin * cos, h - sin * cos); // integrals of cos^2, sin^2
            let q = c.norm_squared() + r * r;
            Moments {
                area: -r / 2.0 * flux,
                first: -r / 3.0 * (c * flux + r * (m * (2.0 * r * sin + a * cos2) + t * (b * sin2))),
                polar: -r / 4.0 * (q * flux + 2.0 * r * (2.0 * r * a * sin + a * a * cos2 + b * b * sin2)),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::profile::Flanks;
    use crate::profile::properties::{moved, table_1};
    use std::f64::consts::{PI, TAU};

    fn line(from: [f64; 2], to: [f64; 2]) -> Segment {
        Segment::Line { from_m: from.into(), to_m: to.into() }
    }

    fn arc(centre: [f64; 2], radius_m: f64, from_azimuth_rad: f64, sweep_rad: f64) -> Segment {
        Segment::Arc { centre_m: centre.into(), radius_m, from_azimuth_rad, sweep_rad }
    }

    /// `polar` is the second moment of area about the centroid.
    fn expect(segments: Vec<Segment>, area: f64, centroid: [f64; 2], polar: f64) {
        let (length, density) = (6e-3, 7850.0);
        let got = Outline::planted(segments).mass_properties(length, density);
        let size = area.sqrt();
        assert!((got.area_m2 / area - 1.0).abs() < 1e-13, "area {} {area}", got.area_m2);
        assert!((got.mass_kg / (area * length * density) - 1.0).abs() < 1e-13);
        for (got, want) in got.centroid_m.iter().zip(centroid) {
            assert!((got - want).abs() < 1e-13 * size, "centroid {got} {want}");
        }
        assert!((got.inertia_kg_m2 / (polar * length * density) - 1.0).abs() < 1e-13, "polar");
    }

    #[test]
    fn circle_rectangle_half_disc_and_annulus_sector_match_closed_forms() {
        let r = 3e-3_f64;
        expect(vec![arc([1e-3, -2e-3], r, 0.3, -TAU)], PI * r * r, [1e-3, -2e-3], PI * r.powi(4) / 2.0);
        expect(
            vec![arc([1e-3, -2e-3], r, 0.3, -1.0), arc([1e-3, -2e-3], r, -0.7, 1.0 - TAU)],
            PI * r * r,
            [1e-3, -2e-3],
            PI * r.powi(4) / 2.0,
        );

        let (w, h) = (5e-3, 8e-3);
        let corners = [[1e-3, 0.0], [1e-3 + w, 0.0], [1e-3 + w, h], [1e-3, h]];
        let sides = (0..4).map(|i| line(corners[i], corners[(i + 1) % 4])).collect();
        expect(sides, w * h, [1e-3 + w / 2.0, h / 2.0], w * h * (w * w + h * h) / 12.0);

        // Upper half disc: G is 4r/3pi above the diameter, where the polar moment is pi r^4/4.
        let g = 4.0 * r / (3.0 * PI);
        let half = vec![arc([0.0, 0.0], r, PI / 2.0, -PI), line([-r, 0.0], [r, 0.0])];
        expect(half, PI * r * r / 2.0, [0.0, g], PI * r.powi(4) / 4.0 - PI * r * r / 2.0 * g * g);

        // Annulus sector of half angle a about +y; the inner arc runs the other way.
        let (r_1, r_2, a) = (2e-3_f64, 5e-3_f64, 0.4_f64);
        let at = |r: f64, azimuth: f64| [r * azimuth.sin(), r * azimuth.cos()];
        let sector = vec![
            arc([0.0, 0.0], r_2, a, -2.0 * a),
            line(at(r_2, -a), at(r_1, -a)),
            arc([0.0, 0.0], r_1, -a, 2.0 * a),
            line(at(r_1, a), at(r_2, a)),
        ];
        let area = a * (r_2 * r_2 - r_1 * r_1);
        let g = 2.0 / 3.0 * a.sin() * (r_2.powi(3) - r_1.powi(3)) / area;
        expect(sector, area, [0.0, g], a / 2.0 * (r_2.powi(4) - r_1.powi(4)) - area * g * g);
    }

    /// Shoelace of the sprag cut into strips along the strut, straight from the profile: area, centroid,
    /// polar second moment about the centroid. Never asks the outline for its segments.
    fn strips(arcs: &[(f64, f64)], half_width: f64, count: usize) -> [f64; 4] {
        let profile = table_1(arcs);
        let b = Vector2::new(0.0, profile.outer_radius_m);
        let contact = |k: usize, turn: f64| {
            profile.arcs[k].centre_m + profile.arcs[k].radius_m * profile.contact_direction(turn)
        };
        let a = contact(0, 0.0);
        let up = (b - a).normalize();
        let front = Vector2::new(up.y, -up.x);
        let circle = |centre: Vector2<f64>, radius: f64, w: f64, sign: f64| {
            let x = w - front.dot(&(centre - a));
            centre + x * front + sign * (radius * radius - x * x).sqrt() * up
        };
        let low = |w: f64| {
            let last = profile.arcs.len() - 1;
            let k = (0..last)
                .find(|&k| w < front.dot(&(contact(k, profile.arcs[k].until_rad) - a)))
                .unwrap_or(last);
            circle(profile.arcs[k].centre_m, profile.arcs[k].radius_m, w, -1.0)
        };
        let at = |i: usize| half_width * (2.0 * i as f64 / count as f64 - 1.0);
        let mut polygon: Vec<Vector2<f64>> = (0..=count).map(|i| low(at(i))).collect();
        polygon
            .extend((0..=count).rev().map(|i| circle(Vector2::zeros(), profile.outer_radius_m, at(i), 1.0)));
        shoelace(&polygon)
    }

    #[test]
    fn the_real_sprag_is_the_limit_of_polygons_at_order_two() {
        for arcs in [&[(4.02e-3, 0.45)][..], &[(4.02e-3, 0.06), (4.08e-3, 0.12), (4.15e-3, 0.45)]] {
            let exact = Outline::new(&table_1(arcs), 2.525e-3, 2.525e-3).unwrap().mass_properties(1.0, 1.0);
            let exact = [exact.area_m2, exact.centroid_m[0], exact.centroid_m[1], exact.inertia_kg_m2];
            let error = |count| {
                let got = strips(arcs, 2.525e-3, count);
                std::array::from_fn::<f64, 4, _>(|i| (got[i] / exact[i] - 1.0).abs())
            };
            let (coarse, fine) = (error(100), error(800));
            for i in 0..4 {
                let order = (coarse[i] / fine[i]).log2() / 3.0;
                println!("quantity {i}: errors {:.2e} {:.2e}, order {order:.3}", coarse[i], fine[i]);
                assert!((order - 2.0).abs() < 0.05, "quantity {i}: {order}");
                assert!(fine[i] < 2e-6, "quantity {i}: {}", fine[i]);
            }
        }
    }

    /// Shoelace over rays from the middle of the strut line, each cut short by the first of flanks, outer circle and
    /// inner arc that it meets; straight from profile and flanks, never from segments. [`strips`]'s four figures.
    fn rays(arcs: &[(f64, f64)], flanks: &Flanks, count: usize) -> [f64; 4] {
        let profile = table_1(arcs);
        let contact = |k: usize, turn: f64| {
            profile.arcs[k].centre_m + profile.arcs[k].radius_m * profile.contact_direction(turn)
        };
        let (a, b) = (contact(0, 0.0), Vector2::new(0.0, profile.outer_radius_m));
        let middle = 0.5 * (a + b);
        let up = (b - a).normalize();
        let front = Vector2::new(up.y, -up.x);
        let flank = |way: &Vector2<f64>, sign: f64, width: f64, tilt: f64| {
            let along_way = sign * way.dot(&front) - tilt.tan() * way.dot(&up);
            if along_way > 0.0 { width / along_way } else { f64::INFINITY }
        };
        let circle = |way: &Vector2<f64>, centre: Vector2<f64>, r: f64| {
            let to = centre - middle;
            let along_way = to.dot(way);
            along_way + (r * r - to.norm_squared() + along_way * along_way).sqrt()
        };
        let last = profile.arcs.len() - 1;
        let at = |i: usize| {
            let turn = TAU * i as f64 / count as f64;
            let way = turn.cos() * front + turn.sin() * up;
            let k = (0..last)
                .find(|&k| {
                    // Still before the junction k|k+1, seen from the middle: to its rear.
                    let junction = contact(k, profile.arcs[k].until_rad) - middle;
                    way.perp(&junction) > 0.0
                })
                .unwrap_or(last);
            let inner = circle(&way, profile.arcs[k].centre_m, profile.arcs[k].radius_m);
            let outer = circle(&way, Vector2::zeros(), profile.outer_radius_m);
            let curve = if way.dot(&up) > 0.0 { outer } else { inner };
            let sides = flank(&way, 1.0, flanks.front_m, flanks.front_tilt_rad).min(flank(
                &way,
                -1.0,
                flanks.rear_m,
                flanks.rear_tilt_rad,
            ));
            middle + curve.min(sides) * way
        };
        shoelace(&(0..count).map(at).collect::<Vec<_>>())
    }

    /// Area, centroid and polar second moment about it of a counterclockwise polygon.
    fn shoelace(polygon: &[Vector2<f64>]) -> [f64; 4] {
        let (mut area, mut first, mut polar) = (0.0, Vector2::zeros(), 0.0);
        for (i, p) in polygon.iter().enumerate() {
            let q = polygon[(i + 1) % polygon.len()];
            let cross = p.x * q.y - p.y * q.x;
            area += cross / 2.0;
            first += (p + q) * cross / 6.0;
            polar += cross * (p.norm_squared() + p.dot(&q) + q.norm_squared()) / 12.0;
        }
        let centroid: Vector2<f64> = first / area;
        [area, centroid.x, centroid.y, polar - area * centroid.norm_squared()]
    }

    #[test]
    fn leaning_flanks_weigh_what_rays_find() {
        let arcs = [(4.02e-3, 0.06), (4.08e-3, 0.12), (4.15e-3, 0.45)];
        for (rear_tilt_rad, front_tilt_rad) in
            [(0.0, 0.0), (0.2, 0.1), (-0.2, 0.15), (-0.15, -0.1), (0.1, -0.12)]
        {
            let flanks = Flanks { rear_tilt_rad, front_tilt_rad, ..Flanks::parallel(2.9e-3, 2.9e-3) };
            let exact = Outline::closed(&table_1(&arcs), &flanks).unwrap().mass_properties(1.0, 1.0);
            let exact = [exact.area_m2, exact.centroid_m[0], exact.centroid_m[1], exact.inertia_kg_m2];
            // The corners lie between rays, so the error falls with the square of their spacing, unevenly.
            let got = rays(&arcs, &flanks, 40_000);
            let size = [exact[0], 1e-3, 1e-3, exact[3]];
            for i in 0..4 {
                let error = (got[i] - exact[i]).abs() / size[i];
                println!("{rear_tilt_rad} {front_tilt_rad}, {i}: {:.6e}, {error:.1e} off", exact[i]);
                assert!(error < 2e-7, "{rear_tilt_rad} {front_tilt_rad}, {i}: {} {}", got[i], exact[i]);
            }
        }
    }

    #[test]
    fn table_1_comes_out_near_1_8_g() {
        // Independent estimate, two arcs joined by a slab: 1.71-1.86 g, 1.19-1.33e-8 kg m^2, G near
        // (0.19, 0.53) mm, against the 1.8 g and 1.18e-8 kg m^2 Table 1 prints. The upper ends are the slab of
        // width b of (6), the lower ends both that of 4.6 mm (inferred here, the estimate names no width).
        for (width, mass, inertia) in [(5.05e-3, 1.86e-3, 1.33e-8), (4.6e-3, 1.71e-3, 1.19e-8)] {
            let outline = Outline::new(&table_1(&[(4.02e-3, 0.45)]), width / 2.0, width / 2.0).unwrap();
            let got = outline.mass_properties(6e-3, 7850.0);
            println!("{width}: {got:?}");
            // To the digits printed.
            assert!((got.mass_kg - mass).abs() < 0.005e-3, "{}", got.mass_kg);
            assert!((got.inertia_kg_m2 - inertia).abs() < 0.005e-8, "{}", got.inertia_kg_m2);
            assert!((got.centroid_m[0] - 0.19e-3).abs() < 0.01e-3, "{:?}", got.centroid_m);
            assert!((got.centroid_m[1] - 0.53e-3).abs() < 0.01e-3, "{:?}", got.centroid_m);
        }
    }

    #[test]
    fn inertia_about_the_centroid_does_not_see_motion() {
        let outline = Outline::new(&table_1(&[(4.02e-3, 0.45)]), 2.525e-3, 2.525e-3).unwrap();
        let at_rest = outline.mass_properties(6e-3, 7850.0);
        let g = Vector2::from(at_rest.centroid_m);
        for (turn, shift) in [(0.7, [0.0, 0.0]), (0.0, [0.1, -0.2]), (-2.3, [0.03, 0.4])] {
            let got = moved(&outline, turn, shift.into()).mass_properties(6e-3, 7850.0);
            assert!((got.area_m2 / at_rest.area_m2 - 1.0).abs() < 1e-12);
            assert!((got.inertia_kg_m2 / at_rest.inertia_kg_m2 - 1.0).abs() < 1e-12);
            let (sin, cos) = f64::sin_cos(turn);
            let want = Vector2::new(g.x * cos + g.y * sin, g.y * cos - g.x * sin) + Vector2::from(shift);
            assert!((Vector2::from(got.centroid_m) - want).norm() < 1e-15);
        }
    }
}
