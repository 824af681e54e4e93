//! Solids as STEP AP214 (ISO 10303-214), in mm: prisms on exact circles, cylinders and planes.
//!
//! # Conventions
//! z runs along the axis, 0 in the middle of the races. A sprag is a prism with square ends: the drop of an end profile,
//! micrometres, is left out, as is a tilt. The clutch is an assembly of three products; the sprag is placed n_s times.

use super::part::circle;
use super::{DrawnClutch, Part};
use crate::profile::Segment;
use nalgebra::{Vector2, Vector3};
use std::fmt::Write;

/// The solid of a part, or the assembly.
pub fn step(part: Part, subject: &DrawnClutch) -> String {
    let mut file = File { body: String::new(), last: 0 };
    let base = Base::new(&mut file);
    match part {
        Part::Sprag => drop(sprag(&mut file, &base, subject, 0.0)),
        Part::Inner => drop(inner(&mut file, &base, subject)),
        Part::Outer => drop(outer(&mut file, &base, subject)),
        Part::Clutch => assembly(&mut file, &base, subject),
    }
    let name = text(&format!("{} ({})", subject.name, part.name()));
    let tool = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));
    // No time of writing: the same design gives the same bytes.
    format!(
        "ISO-10303-21;\n/* {} */\nHEADER;\nFILE_DESCRIPTION(({name}),'2;1');\n\
         FILE_NAME({name},'1970-01-01T00:00:00',(''),(''),'{tool}','{tool}','');\n\
         FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));\nENDSEC;\nDATA;\n{}ENDSEC;\nEND-ISO-10303-21;\n",
        subject.mark(),
        file.body
    )
}

/// A string: quotes doubled, letters beyond ASCII by number.
fn text(value: &str) -> String {
    let one = |c: char| match c {
        '\'' => "''".to_owned(),
        '\\' => "\\\\".to_owned(),
        ' '..='~' => c.to_string(),
        c => format!("\\X4\\{:08X}\\X0\\", u32::from(c)),
    };
    format!("'{}'", value.chars().map(one).collect::<String>())
}

/// A number in mm (or none): twelve decimals, always with a point.
fn real(value: f64) -> String {
    let text = format!("{value:.12}");
    let text = text.trim_end_matches('0');
    if text == "-0." { "0.".to_owned() } else { text.to_owned() }
}

/// Entities by number.
struct File {
    body: String,
    last: usize,
}

/// Number of an entity.
type Id = usize;

impl File {
    fn add(&mut self, entity: &str) -> Id {
        self.last += 1;
        let _ = writeln!(self.body, "#{}={entity};", self.last);
        self.last
    }

    fn list(ids: &[Id]) -> String {
        ids.iter().map(|id| format!("#{id}")).collect::<Vec<_>>().join(",")
    }

    fn point(&mut self, p: Vector3<f64>) -> Id {
        self.add(&format!("CARTESIAN_POINT('',({},{},{}))", real(p.x), real(p.y), real(p.z)))
    }

    fn direction(&mut self, d: Vector3<f64>) -> Id {
        self.add(&format!("DIRECTION('',({},{},{}))", real(d.x), real(d.y), real(d.z)))
    }

    fn placement(&mut self, at: Vector3<f64>, axis: Vector3<f64>, x: Vector3<f64>) -> Id {
        let (at, axis, x) = (self.point(at), self.direction(axis), self.direction(x));
        self.add(&format!("AXIS2_PLACEMENT_3D('',#{at},#{axis},#{x})"))
    }

    fn vertex(&mut self, p: Vector3<f64>) -> Id {
        let point = self.point(p);
        self.add(&format!("VERTEX_POINT('',#{point})"))
    }

    /// An edge from one vertex to another on a straight line.
    fn straight(&mut self, ends: [Id; 2], from: Vector3<f64>, to: Vector3<f64>) -> Id {
        let (point, way) = (self.point(from), self.direction((to - from).normalize()));
        let vector = self.add(&format!("VECTOR('',#{way},1.)"));
        let line = self.add(&format!("LINE('',#{point},#{vector})"));
        self.add(&format!("EDGE_CURVE('',#{},#{},#{line},.T.)", ends[0], ends[1]))
    }

    fn oriented(&mut self, edge: Id, forward: bool) -> Id {
        let sense = if forward { ".T." } else { ".F." };
        self.add(&format!("ORIENTED_EDGE('',*,*,#{edge},{sense})"))
    }

    fn bound(&mut self, kind: &str, edges: &[Id]) -> Id {
        let chain = self.add(&format!("EDGE_LOOP('',({}))", Self::list(edges)));
        self.add(&format!("{kind}('',#{chain},.T.)"))
    }

    fn face(&mut self, bounds: &[Id], surface: Id, outward: bool) -> Id {
        let sense = if outward { ".T." } else { ".F." };
        self.add(&format!("ADVANCED_FACE('',({}),#{surface},{sense})", Self::list(bounds)))
    }
}

/// What all products share.
struct Base {
    product_context: Id,
    definition_context: Id,
    /// Units and uncertainty.
    context: Id,
}

impl Base {
    fn new(f: &mut File) -> Self {
        let application =
            f.add("APPLICATION_CONTEXT('core data for automotive mechanical design processes')");
        f.add(&format!(
            "APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,#{application})"
        ));
        let product_context = f.add(&format!("PRODUCT_CONTEXT('',#{application},'mechanical')"));
        let definition_context =
            f.add(&format!("PRODUCT_DEFINITION_CONTEXT('part definition',#{application},'design')"));
        let mm = f.add("(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.))");
        let rad = f.add("(NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($,.RADIAN.))");
        let sr = f.add("(NAMED_UNIT(*) SI_UNIT($,.STERADIAN.) SOLID_ANGLE_UNIT())");
        let close = f.add(&format!(
            "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-07),#{mm},'distance_accuracy_value','')"
        ));
        let context = f.add(&format!(
            "(GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#{close})) \
             GLOBAL_UNIT_ASSIGNED_CONTEXT((#{mm},#{rad},#{sr})) REPRESENTATION_CONTEXT('',''))"
        ));
        Self { product_context, definition_context, context }
    }

    /// A product with the shape `representation`; the number of its definition.
    fn product(&self, f: &mut File, name: &str, representation: Id) -> Id {
        let name = text(name);
        let product = f.add(&format!("PRODUCT({name},{name},'',(#{}))", self.product_context));
        f.add(&format!("PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,(#{product}))"));
        let formation = f.add(&format!("PRODUCT_DEFINITION_FORMATION('','',#{product})"));
        let definition =
            f.add(&format!("PRODUCT_DEFINITION('design','',#{formation},#{})", self.definition_context));
        let shape = f.add(&format!("PRODUCT_DEFINITION_SHAPE('','',#{definition})"));
        f.add(&format!("SHAPE_DEFINITION_REPRESENTATION(#{shape},#{representation})"));
        definition
    }
}

/// A product in the file: its definition, its shape and the frame in which that stands.
struct Product {
    definition: Id,
    shape: Id,
    frame: Id,
}

fn frame(f: &mut File, at: Vector3<f64>, x: Vector3<f64>) -> Id {
    f.placement(at, Vector3::z(), x)
}

/// A prism from `z[0]` to `z[1]`, mm, over chains of segments, m: the outline first, counterclockwise, then holes,
/// clockwise.
fn prism(f: &mut File, base: &Base, name: &str, chains: &[Vec<Segment>], z: [f64; 2]) -> Product {
    let mut faces = Vec::new();
    let mut bounds: [Vec<Id>; 2] = [Vec::new(), Vec::new()];
    for (c, chain) in chains.iter().enumerate() {
        let starts: Vec<Vector2<f64>> = chain.iter().map(|s| 1e3 * s.start_m()).collect();
        let n = chain.len();
        let lift = |p: Vector2<f64>, z: f64| Vector3::new(p.x, p.y, z);
        let vertices = z.map(|z| starts.iter().map(|p| f.vertex(lift(*p, z))).collect::<Vec<Id>>());
        let mut edges: [Vec<Id>; 2] = [Vec::new(), Vec::new()];
        for level in 0..2 {
            for (i, segment) in chain.iter().enumerate() {
                let next = (i + 1) % n;
                let ends = [vertices[level][i], vertices[level][next]];
                let edge = match *segment {
                    Segment::Line { .. } => {
                        f.straight(ends, lift(starts[i], z[level]), lift(starts[next], z[level]))
                    }
                    Segment::Arc { centre_m, radius_m, sweep_rad, .. } => {
                        let place = f.placement(lift(1e3 * centre_m, z[level]), Vector3::z(), Vector3::x());
                        let circle = f.add(&format!("CIRCLE('',#{place},{})", real(1e3 * radius_m)));
                        let sense = if sweep_rad < 0.0 { ".T." } else { ".F." };
                        f.add(&format!("EDGE_CURVE('',#{},#{},#{circle},{sense})", ends[0], ends[1]))
                    }
                };
                edges[level].push(edge);
            }
        }
        let posts: Vec<Id> = (0..n)
            .map(|i| {
                f.straight([vertices[0][i], vertices[1][i]], lift(starts[i], z[0]), lift(starts[i], z[1]))
            })
            .collect();
        for (i, segment) in chain.iter().enumerate() {
            let next = (i + 1) % n;
            let around = [
                f.oriented(edges[0][i], true),
                f.oriented(posts[next], true),
                f.oriented(edges[1][i], false),
                f.oriented(posts[i], false),
            ];
            let bound = f.bound("FACE_OUTER_BOUND", &around);
            // Outward is to the right of the way; a cylinder's own normal points away from its axis.
            let face = match *segment {
                Segment::Line { .. } => {
                    let way = (starts[next] - starts[i]).normalize();
                    let normal = Vector3::new(way.y, -way.x, 0.0);
                    let place = f.placement(lift(starts[i], z[0]), normal, Vector3::z());
                    let plane = f.add(&format!("PLANE('',#{place})"));
                    f.face(&[bound], plane, true)
                }
                Segment::Arc { centre_m, radius_m, sweep_rad, .. } => {
                    let place = f.placement(lift(1e3 * centre_m, z[0]), Vector3::z(), Vector3::x());
                    let radius = real(1e3 * radius_m);
                    let cylinder = f.add(&format!("CYLINDRICAL_SURFACE('',#{place},{radius})"));
                    f.face(&[bound], cylinder, sweep_rad < 0.0)
                }
            };
            faces.push(face);
        }
        let kind = if c == 0 { "FACE_OUTER_BOUND" } else { "FACE_BOUND" };
        let below: Vec<Id> = edges[0].iter().rev().map(|e| f.oriented(*e, false)).collect();
        let above: Vec<Id> = edges[1].iter().map(|e| f.oriented(*e, true)).collect();
        bounds[0].push(f.bound(kind, &below));
        bounds[1].push(f.bound(kind, &above));
    }
    for (level, up) in [(0, -1.0), (1, 1.0)] {
        let at = Vector3::new(0.0, 0.0, z[level]);
        let place = f.placement(at, up * Vector3::z(), Vector3::x());
        let plane = f.add(&format!("PLANE('',#{place})"));
        faces.push(f.face(&bounds[level], plane, true));
    }
    let shell = f.add(&format!("CLOSED_SHELL('',({}))", File::list(&faces)));
    let solid = f.add(&format!("MANIFOLD_SOLID_BREP({},#{shell})", text(name)));
    let frame = frame(f, Vector3::zeros(), Vector3::x());
    let shape = f.add(&format!(
        "ADVANCED_BREP_SHAPE_REPRESENTATION({},(#{frame},#{solid}),#{})",
        text(name),
        base.context
    ));
    let definition = base.product(f, name, shape);
    Product { definition, shape, frame }
}

/// A chain run the other way.
fn reversed(chain: &[Segment]) -> Vec<Segment> {
    let back = |s: &Segment| match *s {
        Segment::Line { from_m, to_m } => Segment::Line { from_m: to_m, to_m: from_m },
        Segment::Arc { centre_m, radius_m, from_azimuth_rad, sweep_rad } => Segment::Arc {
            centre_m,
            radius_m,
            from_azimuth_rad: from_azimuth_rad + sweep_rad,
            sweep_rad: -sweep_rad,
        },
    };
    chain.iter().rev().map(back).collect()
}

fn middle(length_m: f64, offset_m: f64) -> [f64; 2] {
    [1e3 * (offset_m - 0.5 * length_m), 1e3 * (offset_m + 0.5 * length_m)]
}

fn sprag(f: &mut File, base: &Base, subject: &DrawnClutch, offset_m: f64) -> Product {
    let z = middle(subject.clutch.sprags.length_m, offset_m);
    prism(f, base, "sprag", &[subject.sprag().to_vec()], z)
}

fn inner(f: &mut File, base: &Base, subject: &DrawnClutch) -> Product {
    let (bore, track) = subject.inner_radii_m();
    let chains: Vec<Vec<Segment>> =
        [circle(track)].into_iter().chain(bore.map(|r| reversed(&circle(r)))).collect();
    prism(f, base, "inner race", &chains, middle(subject.clutch.races.width_m, 0.0))
}

fn outer(f: &mut File, base: &Base, subject: &DrawnClutch) -> Product {
    let (track, outside) = subject.outer_radii_m();
    let chains = [circle(outside), reversed(&circle(track))];
    prism(f, base, "outer race", &chains, middle(subject.clutch.races.width_m, 0.0))
}

fn assembly(f: &mut File, base: &Base, subject: &DrawnClutch) {
    let inner = inner(f, base, subject);
    let outer = outer(f, base, subject);
    let sprag = sprag(f, base, subject, subject.clutch.axial.offset_m);
    let own = frame(f, Vector3::zeros(), Vector3::x());
    let mut placed = vec![
        ("inner race".to_owned(), &inner, frame(f, Vector3::zeros(), Vector3::x())),
        ("outer race".to_owned(), &outer, frame(f, Vector3::zeros(), Vector3::x())),
    ];
    for (i, azimuth) in subject.azimuths_rad().into_iter().enumerate() {
        let centre = 1e3 * subject.centre_m(azimuth);
        let x = Vector3::new(azimuth.cos(), -azimuth.sin(), 0.0);
        placed.push((format!("sprag {}", i + 1), &sprag, frame(f, Vector3::new(centre.x, centre.y, 0.0), x)));
    }
    let frames: Vec<Id> = std::iter::once(own).chain(placed.iter().map(|p| p.2)).collect();
    let whole = f.add(&format!(
        "SHAPE_REPRESENTATION({},({}),#{})",
        text(subject.name),
        File::list(&frames),
        base.context
    ));
    let definition = base.product(f, subject.name, whole);
    for (i, (name, product, to)) in placed.iter().enumerate() {
        let name = text(name);
        let use_ = f.add(&format!(
            "NEXT_ASSEMBLY_USAGE_OCCURRENCE('{}',{name},'',#{definition},#{},$)",
            i + 1,
            product.definition
        ));
        let shape = f.add(&format!("PRODUCT_DEFINITION_SHAPE({name},'',#{use_})"));
        let moved = f.add(&format!("ITEM_DEFINED_TRANSFORMATION('','',#{},#{to})", product.frame));
        let relation = f.add(&format!(
            "(REPRESENTATION_RELATIONSHIP('','',#{},#{whole}) \
             REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#{moved}) SHAPE_REPRESENTATION_RELATIONSHIP())",
            product.shape
        ));
        f.add(&format!("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#{relation},#{shape})"));
    }
}
