//! STEP files by a reader of our own: every entity is there, every edge is used twice, and the file's own numbers enclose the
//! volume. `tests/external/check_step.py` reads the same files by OCCT.

use crate::common;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use assert_cmd::cargo::cargo_bin;
use flexframe::export::{Made, step};
use flexframe::frame::assembly::Design;
use flexframe::params::{Frame, PartName};
use flexframe::solid::{Boundary, Contour, Feature, Mesh, MeshSolid, NotExact, Profile};
use flexframe::units::Angle;
use nalgebra::{Isometry3, Point3, Vector3};
use proptest::prelude::*;
use serde_json::Value;

/// A file's entities by number: name and arguments.
struct Step(BTreeMap<usize, (String, String)>);

impl Step {
    fn read(bytes: &[u8]) -> Self {
        let text = std::str::from_utf8(bytes).expect("ISO 646");
        assert!(text.is_ascii() && text.starts_with("ISO-10303-21;\nHEADER;\n") && text.ends_with("ENDSEC;\nEND-ISO-10303-21;\n"));
        let entities = text.lines().filter(|line| line.starts_with('#')).map(|line| {
            let (number, rest) = line[1..].split_once('=').expect("a number and an entity");
            let rest = rest.strip_suffix(';').expect("an end");
            let (name, arguments) = rest.split_once('(').expect("arguments");
            (number.parse().expect("a number"), (name.to_string(), arguments.strip_suffix(')').expect("an end").to_string()))
        });
        let step = Self(entities.collect());
        let missing = step.0.values().flat_map(|(_, arguments)| references(arguments)).find(|number| !step.0.contains_key(number));
        assert_eq!(missing, None, "no such entity");
        step
    }

    fn all<'a>(&'a self, name: &'a str) -> impl Iterator<Item = (usize, &'a str)> {
        self.0.iter().filter(move |(_, (found, _))| found == name).map(|(number, (_, arguments))| (*number, arguments.as_str()))
    }

    fn of(&self, number: usize) -> (&str, &str) {
        let (name, arguments) = &self.0[&number];
        (name, arguments)
    }

    /// The numbers that an entity refers to, in order.
    fn below(&self, number: usize) -> Vec<usize> {
        references(self.of(number).1)
    }

    fn vector(&self, number: usize) -> Vector3<f64> {
        let inner = self.of(number).1.rsplit_once('(').expect("numbers").1.trim_end_matches(')');
        let values: Vec<f64> = inner.split(',').map(|value| value.parse().expect("a real")).collect();
        assert!(inner.split(',').all(|value| value.contains('.')), "a real has a point: {inner}");
        Vector3::new(values[0], values[1], values[2])
    }

    /// Origin, z and x of a placement.
    fn placement(&self, number: usize) -> [Vector3<f64>; 3] {
        let parts = self.below(number);
        [self.vector(parts[0]), self.vector(parts[1]), self.vector(parts[2])]
    }

    /// Points along an oriented edge, the last left out.
    fn points(&self, oriented: usize) -> Vec<Vector3<f64>> {
        let edge = self.below(oriented)[0];
        let parts = self.below(edge);
        let [from, to] = [parts[0], parts[1]].map(|vertex| self.vector(self.below(vertex)[0]));
        let (kind, arguments) = self.of(parts[2]);
        let mut points = match kind {
            "LINE" => vec![from, to],
            "CIRCLE" => {
                let radius: f64 = arguments.rsplit_once(',').expect("a radius").1.parse().expect("a real");
                arc(self.placement(self.below(parts[2])[0]), radius, from, to)
            }
            other => panic!("{other}"),
        };
        if self.of(oriented).1.ends_with(".F.") {
            points.reverse();
        }
        points.pop();
        points
    }

    /// Normal out of the solid, a point, area and corners of a plane face; `None` for a cylinder, with its axis checked.
    fn plane_face(&self, face: usize) -> Option<(Vector3<f64>, Vector3<f64>, f64)> {
        let mut parts = self.below(face);
        let surface = parts.pop().expect("a surface");
        let [point, axis, _] = self.placement(self.below(surface)[0]);
        if self.of(surface).0 != "PLANE" {
            assert!(axis.z.abs() > 1.0 - 1e-9, "this reader takes upright cylinders only");
            return None;
        }
        let normal = if self.of(face).1.ends_with(".T.") { axis } else { -axis };
        let mut area = 0.0;
        for bound in parts {
            let ring: Vec<_> = self.below(self.below(bound)[0]).into_iter().flat_map(|oriented| self.points(oriented)).collect();
            let beside = ring.iter().map(|p| normal.dot(&(p - point)).abs()).fold(0.0, f64::max);
            assert!(beside < 1e-4, "{beside} mm beside the plane");
            let twice: Vector3<f64> = (0..ring.len()).map(|i| (ring[i] - point).cross(&(ring[(i + 1) % ring.len()] - point))).sum();
            let own = 0.5 * normal.dot(&twice);
            assert_eq!(own > 0.0, self.of(bound).0 == "FACE_OUTER_BOUND", "outer loops run counter-clockwise, holes clockwise");
            area += own;
        }
        Some((normal, point, area))
    }

    /// Volume by the faces, mm³: of (x, y, z) / 3 through all of them, or of (0, 0, z) where cylinders stand upright.
    fn volume_mm3(&self) -> f64 {
        let faces: Vec<_> = self.all("ADVANCED_FACE").map(|(face, _)| self.plane_face(face)).collect();
        let planes = faces.iter().flatten();
        if faces.iter().all(Option::is_some) {
            planes.map(|(normal, point, area)| area * normal.dot(point) / 3.0).sum()
        } else {
            let level = |normal: &Vector3<f64>| normal.z.abs() < 1e-9 || normal.z.abs() > 1.0 - 1e-9;
            assert!(faces.iter().flatten().all(|(normal, _, _)| level(normal)));
            planes.map(|(normal, point, area)| area * normal.z * point.z).sum()
        }
    }

    /// Each edge lies in two loops, once in each direction.
    fn assert_closed(&self) {
        let mut uses: BTreeMap<usize, Vec<bool>> = BTreeMap::new();
        for (oriented, arguments) in self.all("ORIENTED_EDGE") {
            uses.entry(self.below(oriented)[0]).or_default().push(arguments.ends_with(".T."));
        }
        assert_eq!(uses.len(), self.all("EDGE_CURVE").count());
        for (edge, mut ways) in uses {
            ways.sort_unstable();
            assert_eq!(ways, [false, true], "edge #{edge}");
        }
        for (ring, _) in self.all("EDGE_LOOP") {
            let ends: Vec<[usize; 2]> = self
                .below(ring)
                .into_iter()
                .map(|oriented| {
                    let vertices = self.below(self.below(oriented)[0]);
                    if self.of(oriented).1.ends_with(".T.") { [vertices[0], vertices[1]] } else { [vertices[1], vertices[0]] }
                })
                .collect();
            assert!((0..ends.len()).all(|i| ends[i][1] == ends[(i + 1) % ends.len()][0]), "loop #{ring} is open");
        }
    }
}

fn references(arguments: &str) -> Vec<usize> {
    let outside_text = arguments.split('\'').step_by(2);
    let behind = outside_text.flat_map(|text| text.split('#').skip(1));
    behind.map(|text| text[..text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len())].parse().expect("digits")).collect()
}

/// Points of an arc, counter-clockwise about the placement's z.
fn arc([centre, z, x]: [Vector3<f64>; 3], radius: f64, from: Vector3<f64>, to: Vector3<f64>) -> Vec<Vector3<f64>> {
    let y = z.cross(&x);
    let angle = |p: Vector3<f64>| libm::atan2((p - centre).dot(&y), (p - centre).dot(&x));
    let begin = angle(from);
    let mut sweep = angle(to) - begin;
    if sweep <= 1e-12 {
        sweep += std::f64::consts::TAU;
    }
    assert!(((from - centre).norm() - radius).abs() < 1e-4 && ((to - centre).norm() - radius).abs() < 1e-4, "beside its circle");
    let at = |i: u32| {
        let (sin, cos) = libm::sincos(begin + sweep * f64::from(i) / 2000.0);
        centre + x * (radius * cos) + y * (radius * sin)
    };
    (0..=2000).map(at).collect()
}

fn exact(feature: &Feature) -> Result<Boundary, NotExact> {
    Boundary::exact(&MeshSolid::build(feature).mesh(), feature, &Isometry3::identity())
}

fn faceted(feature: &Feature) -> Boundary {
    Boundary::faceted(&MeshSolid::build(feature).to_mesh()).expect("closed")
}

fn read(boundary: &Boundary) -> Step {
    let step = Step::read(&step::solid("it", boundary.clone(), Made::Exact));
    step.assert_closed();
    step
}

fn assert_near(found: f64, wanted: f64, share: f64) {
    assert!((found / wanted - 1.0).abs() < share, "{found} {wanted}");
}

#[test]
fn analytic_box_has_six_faces_and_its_volume() {
    let tilted = Feature::cuboid([3.0, 4.0, 5.0]).turned_x(Angle::deg(21.0)).turned_z(Angle::deg(-77.0)).at(10.0, -20.0, 30.0);
    for boundary in [exact(&tilted).expect("planes"), faceted(&tilted)] {
        let step = read(&boundary);
        let counts = ["ADVANCED_FACE", "EDGE_CURVE", "VERTEX_POINT"].map(|name| step.all(name).count());
        assert_eq!(counts, [6, 12, 8]);
        assert_near(step.volume_mm3(), 60.0, 1e-5);
    }
}

#[test]
fn analytic_cylinder_has_one_round_face() {
    let step = read(&exact(&Feature::cylinder(1.5, 80.0)).expect("a cylinder"));
    assert_eq!((step.all("CYLINDRICAL_SURFACE").count(), step.all("PLANE").count(), step.all("CIRCLE").count()), (1, 2, 2));
    assert_near(step.volume_mm3(), std::f64::consts::PI * 2.25 * 80.0, 1e-5);
}

fn plate() -> Feature {
    let outline = Contour::rounded_rectangle([1.0, 2.0], [20.0, 12.0], 3.0);
    let profile = Profile::new(outline).with_hole(Contour::bore([4.0, 2.0], 2.0)).with_hole(Contour::circle([-4.0, 2.0], 1.0));
    Feature::extrude(profile, 2.5)
}

#[test]
fn analytic_plate_with_holes_is_exact_where_its_mesh_has_chords() {
    let pi = std::f64::consts::PI;
    let step = read(&exact(&plate()).expect("planes and cylinders"));
    assert_eq!((step.all("CYLINDRICAL_SURFACE").count(), step.all("PLANE").count()), (6, 6));
    assert_near(step.volume_mm3(), 2.5 * (240.0 - (4.0 - pi) * 9.0 - 5.0 * pi), 1e-5);
    let faceted = read(&faceted(&plate()));
    assert_eq!(faceted.all("ADVANCED_FACE").count(), 2 + 4 + 4 * 12 + 2 * 48, "coplanar facets are one face");
    assert_near(faceted.volume_mm3(), MeshSolid::build(&plate()).volume_mm3(), 1e-5);
}

#[test]
fn analytic_bores_that_cross_meet_in_a_curve_on_both() {
    let block = Feature::cuboid([10.0, 10.0, 10.0]);
    let crossing = Feature::bore(2.0, 20.0).at(0.0, 0.0, -10.0);
    let narrower = Feature::bore(1.0, 20.0).at(0.0, 0.0, -10.0).turned_x(Angle::deg(90.0));
    let boundary = exact(&block.minus([crossing, narrower])).expect("two cylinders that cross");
    let step = Step::read(&step::solid("crossing", boundary.clone(), Made::Exact));
    step.assert_closed();
    assert_eq!(step.all("B_SPLINE_CURVE_WITH_KNOTS").count(), 2);
    // Two bores less what they share: the integral of 8 z sqrt(1 - z²) sqrt(4 - z²) / z over a quarter, summed up here.
    let shared: f64 = (0..20000)
        .map(|i| {
            let z = (f64::from(i) + 0.5) / 20000.0;
            8.0 * (1.0 - z * z).sqrt() * (4.0 - z * z).sqrt() / 20000.0
        })
        .sum();
    let wanted = 1000.0 - std::f64::consts::PI * 50.0 + shared;
    assert_near(boundary.volume_mm3(), wanted, 2e-5);
}

#[test]
fn analytic_a_frustum_is_exact() {
    let frustum = exact(&Feature::cone(3.0, 1.0, 4.0).turned_x(Angle::deg(40.0)).at(5.0, -7.0, 9.0)).expect("a cone and two planes");
    assert_eq!(frustum.faces.len(), 3);
    assert_near(frustum.volume_mm3(), std::f64::consts::PI * 4.0 / 3.0 * (9.0 + 3.0 + 1.0), 1e-5);
    let step = Step::read(&step::solid("frustum", frustum, Made::Exact));
    step.assert_closed();
    assert_eq!((step.all("CONICAL_SURFACE").count(), step.all("CIRCLE").count()), (1, 2));
}

#[test]
fn analytic_a_disc_with_rounded_edges_is_exact() {
    let (radius, half, round) = (6.0, 2.0, 1.5);
    let corners = [([0.0, -half], 0.0), ([radius, -half], round), ([radius, half], round), ([0.0, half], 0.0)];
    let disc = exact(&Feature::revolve(Profile::new(Contour::rounded_polygon(&corners))).turned_y(Angle::deg(70.0)).at(1.0, 2.0, 3.0));
    let disc = disc.expect("two tori, a cylinder and two planes");
    assert_eq!(disc.faces.len(), 5);
    // A cylinder less what the rounding takes: the square beside a quarter of a circle, turned about the axis (Pappus).
    let pi = std::f64::consts::PI;
    let (square, quarter) = (round * round, 0.25 * pi * round * round);
    let about = square * (radius - 0.5 * round) - quarter * (radius - round + 4.0 * round / (3.0 * pi));
    assert_near(disc.volume_mm3(), pi * radius * radius * 2.0 * half - 2.0 * 2.0 * pi * about, 2e-5);
    let step = Step::read(&step::solid("disc", disc, Made::Exact));
    step.assert_closed();
    assert_eq!((step.all("TOROIDAL_SURFACE").count(), step.all("CYLINDRICAL_SURFACE").count()), (2, 1));
}

/// A plate of 12 x 9 x 10 mm in which a ball of radius 2 mm sinks.
fn ball_in_plate(below_mm: f64) -> Feature {
    let ball = Feature::sphere(2.0).at(1.0, -0.5, 7.0 - below_mm);
    Feature::union([Feature::cuboid([12.0, 9.0, 10.0]), ball]).turned_x(Angle::deg(25.0))
}

#[test]
fn analytic_a_ball_in_a_plate_is_exact_where_less_than_half_is_seen() {
    let boundary = exact(&ball_in_plate(2.5)).expect("planes and a ball");
    assert_eq!(boundary.faces.len(), 7);
    let above = 1.5;
    assert_near(boundary.volume_mm3(), 1080.0 + std::f64::consts::PI * above * above * (6.0 - above) / 3.0, 1e-5);
    let step = Step::read(&step::solid("ball", boundary, Made::Exact));
    step.assert_closed();
    assert_eq!((step.all("SPHERICAL_SURFACE").count(), step.all("CIRCLE").count()), (1, 1));
    // Of more than half a pole would lie in the face, in whose parameters it has no border.
    let more = ball_in_plate(1.5);
    assert!(matches!(exact(&more), Err(NotExact::Face { .. })));
    let mixed = Boundary::mixed(&MeshSolid::build(&more).mesh(), &more, &Isometry3::identity()).expect("the plate");
    assert!(mixed.faces.iter().filter(|face| face.is_exact).count() == 6, "its planes");
}

/// A block with two bores, and a horn that is the hull of two balls.
fn horned() -> Feature {
    let horn = Feature::hull([Feature::sphere(2.0).at(0.0, 0.0, 5.0), Feature::sphere(1.0).at(0.0, 3.0, 9.0)]);
    let bore = |x: f64, r: f64| Feature::bore(r, 30.0).at(x, 0.0, -15.0);
    Feature::union([Feature::cuboid([24.0, 14.0, 10.0]), horn]).minus([bore(8.0, 1.35), bore(-8.0, 2.5)])
}

#[test]
fn analytic_beside_what_is_not_exact_bores_stay_cylinders() {
    assert!(matches!(exact(&horned()), Err(NotExact::Surface { .. })));
    let mesh = MeshSolid::build(&horned()).mesh();
    let boundary = Boundary::mixed(&mesh, &horned(), &Isometry3::identity()).expect("in part");
    let step = Step::read(&step::solid("horned", boundary.clone(), Made::Mixed));
    step.assert_closed();
    let mut radii: Vec<&str> =
        step.all("CYLINDRICAL_SURFACE").map(|(_, arguments)| arguments.rsplit_once(',').expect("a radius").1).collect();
    radii.sort_unstable();
    assert_eq!(radii, ["1.35", "2.5"]);
    // Six planes and two bores; the horn's facets are named.
    let named = step.all("ADVANCED_FACE").filter(|(_, arguments)| arguments.starts_with("'facet'")).count();
    assert!(boundary.faces.len() - named >= 8 && named > 10, "{named} of {}", boundary.faces.len());
    let pi = std::f64::consts::PI;
    // The mesh's bores are drawn around their circles; those of the solid are the circles.
    let per_turn = 48.0_f64;
    let around = 10.0 * (1.35_f64.powi(2) + 2.5_f64.powi(2)) * (per_turn * libm::tan(pi / per_turn) - pi);
    assert!((boundary.volume_mm3() - mesh.volume_mm3() - around).abs() < 0.01, "{} {} {around}", boundary.volume_mm3(), mesh.volume_mm3());
}

#[test]
fn analytic_what_a_hull_spans_between_balls_that_differ_is_declined() {
    let capsule = Feature::hull([Feature::sphere(3.0), Feature::sphere(2.0).at(5.0, 0.0, 0.0)]);
    assert!(matches!(exact(&capsule), Err(NotExact::Surface { .. })));
    let step = read(&faceted(&capsule));
    assert_near(step.volume_mm3(), MeshSolid::build(&capsule).volume_mm3(), 1e-4);
}

#[test]
fn planted_a_mesh_of_other_features_is_declined() {
    let mesh = MeshSolid::build(&plate()).mesh();
    let thicker = Feature::extrude(Profile::new(Contour::rectangle([1.0, 2.0], [20.0, 12.0])), 3.0);
    assert!(Boundary::exact(&mesh, &thicker, &Isometry3::identity()).is_err());
    let moved = Isometry3::translation(0.01, 0.0, 0.0);
    assert!(Boundary::exact(&mesh, &plate(), &moved).is_err());
}

#[test]
fn planted_text_of_the_user_stays_text() {
    let boundary = faceted(&Feature::cuboid([1.0, 1.0, 1.0]));
    let bytes = step::solid("it's\\ #1=ü;\n);ENDSEC;", boundary, Made::Faceted);
    Step::read(&bytes).assert_closed();
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Blocks and bars with bores: whichever way it is made, the solid is closed, has the mesh's volume, and the same bytes.
    #[test]
    fn analytic_random_solids_are_closed(
        size in [2.0..20.0_f64, 2.0..20.0, 2.0..20.0],
        bars in prop::collection::vec((0.3..4.0_f64, -8.0..8.0_f64, -8.0..8.0_f64, 0.0..180.0_f64, 0.0..180.0_f64), 0..3),
        bores in prop::collection::vec((0.3..3.0_f64, -8.0..8.0_f64, -8.0..8.0_f64, 0.0..180.0_f64, 0.0..180.0_f64), 0..3),
    ) {
        let laid = |feature: Feature, at: (f64, f64, f64)| feature.turned_y(Angle::deg(at.2)).turned_z(Angle::deg(at.0)).at(at.1, 0.0, 0.0);
        let bar = |(r, x, z, a, b): &(f64, f64, f64, f64, f64)| laid(Feature::cylinder(*r, 30.0).at(0.0, *z, -15.0), (*a, *x, *b));
        let bore = |(r, x, z, a, b): &(f64, f64, f64, f64, f64)| laid(Feature::bore(*r, 60.0).at(0.0, *z, -30.0), (*a, *x, *b));
        let body = std::iter::once(Feature::cuboid(size)).chain(bars.iter().map(bar));
        let feature = Feature::union(body).minus(bores.iter().map(bore));
        let mesh = MeshSolid::build(&feature).to_mesh();
        prop_assume!(mesh.volume_mm3() > 1.0 && flexframe::solid::gate::pass(&mesh).is_ok());
        // Where bores leave little, their chords are a part of it: a finer mesh has the volume, then.
        let finer = MeshSolid::build_finely(&feature, 192);
        let off = |mm3: f64| [mesh.volume_mm3(), finer.volume_mm3()].map(|of| (mm3 / of - 1.0).abs()).into_iter().fold(f64::INFINITY, f64::min);
        if let Some(mixed) = Boundary::mixed(&mesh, &feature, &Isometry3::identity()) {
            let off = off(mixed.volume_mm3());
            prop_assert!(off < 0.005, "{off}");
            Step::read(&step::solid("mixed", mixed, Made::Mixed)).assert_closed();
        }
        let boundary = exact(&feature).unwrap_or_else(|_| Boundary::faceted(&mesh).expect("closed"));
        let off = off(boundary.volume_mm3());
        prop_assert!(off < 0.005, "{off}");
        let bytes = step::solid("random", boundary.clone(), Made::Exact);
        Step::read(&bytes).assert_closed();
        let again = exact(&feature).unwrap_or_else(|_| Boundary::faceted(&mesh).expect("closed"));
        prop_assert_eq!(bytes, step::solid("random", again, Made::Exact));
    }
}

/// The default frame's folder with STEP, built by the program.
fn built() -> &'static Path {
    static BUILT: OnceLock<PathBuf> = OnceLock::new();
    BUILT.get_or_init(|| {
        let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("step");
        let run = Command::new(cargo_bin("flexframe")).args(["build", "--step", "--no-pictures", "-q", "-o"]).arg(&out).output();
        assert!(run.expect("the program starts").status.success());
        out.join("cognifly")
    })
}

#[test]
fn analytic_manifest_lists_every_solid_and_how_it_was_made() {
    let manifest: Value = serde_json::from_slice(&fs::read(built().join("manifest.json")).expect("is there")).expect("JSON");
    let solids = manifest["step"].as_array().expect("a list");
    let parts: Vec<&Value> = solids.iter().filter(|solid| solid["file"] != "frame.step").collect();
    // The default frame has all of them but an accessory plate.
    assert_eq!(parts.len(), PartName::ALL.len() - 1);
    for part in parts {
        assert_eq!(part["made"], "exact", "{}: {}", part["name"], part["because"]);
    }
    for solid in solids {
        let [own, mesh] = ["volume_mm3", "mesh_volume_mm3"].map(|key| solid[key].as_f64().expect("a number"));
        let (share, name) = (if solid["made"] == "faceted" { 1e-5 } else { 0.005 }, &solid["name"]);
        let [faces, facets] = ["faces", "facets"].map(|key| solid[key].as_u64().expect("a number"));
        let wanted = if facets == 0 {
            "exact"
        } else if facets == faces {
            "faceted"
        } else {
            "mixed"
        };
        assert_eq!(solid["made"], wanted, "{name}: {facets} of {faces}");
        assert!((own / mesh - 1.0).abs() < share, "{name}: {own} {mesh}");
        assert_eq!(solid["made"] == "exact", solid["because"].is_null(), "{name}");
        assert!(built().join(solid["file"].as_str().expect("text")).exists());
    }
    // Where truck makes a solid without booleans, ours has its volume.
    for shape in manifest["exact"].as_array().expect("a list") {
        let own = solids.iter().find(|solid| solid["file"] == "frame.step" && solid["name"] == shape["name"]).expect("the same shape");
        assert_eq!(own["made"], "exact", "{}", shape["name"]);
        assert_near(own["volume_mm3"].as_f64().expect("a number"), shape["exact_volume_mm3"].as_f64().expect("a number"), 1e-3);
    }
}

/// Chords make a tube's bore narrower and its outside, too: its volumes differ by more than those of a rod, and it is as exact.
#[test]
fn analytic_a_tube_is_exact() {
    let tube = Feature::cylinder(1.5, 100.0).minus([Feature::bore(1.0, 102.0).at(0.0, 0.0, -1.0)]);
    let step = read(&exact(&tube).expect("is exact"));
    assert_eq!(step.all("CYLINDRICAL_SURFACE").count(), 2);
    assert_near(step.volume_mm3(), std::f64::consts::PI * (2.25 - 1.0) * 100.0, 1e-5);
}

/// With twice the pieces in a circle a mesh lacks a quarter of what it lacked; both say where that ends.
#[test]
fn analytic_exact_solids_have_the_volume_that_ever_finer_meshes_come_to() {
    let manifest: Value = serde_json::from_slice(&fs::read(built().join("manifest.json")).expect("is there")).expect("JSON");
    let design = Design::with(Frame::load("cognifly").expect("a preset").0, common::memo()).expect("designs");
    for part in &design.printed {
        let [coarse, fine] = [48, 96].map(|per_turn| MeshSolid::build_finely(&part.feature, per_turn).volume_mm3());
        let limit = fine + (fine - coarse) / 3.0;
        let is_own = |solid: &&Value| solid["file"] != "frame.step" && solid["name"] == part.name.slug();
        let own = manifest["step"].as_array().expect("a list").iter().find(is_own).expect("is listed")["volume_mm3"].as_f64();
        let own = own.expect("a number");
        assert!((own / limit - 1.0).abs() < 0.001, "{}: {own} of {limit}", part.name.slug());
    }
}

#[test]
fn analytic_files_are_closed_and_enclose_what_the_manifest_says() {
    let manifest: Value = serde_json::from_slice(&fs::read(built().join("manifest.json")).expect("is there")).expect("JSON");
    for solid in manifest["step"].as_array().expect("a list").iter().filter(|solid| solid["file"] != "frame.step") {
        let step = Step::read(&fs::read(built().join(solid["file"].as_str().expect("text"))).expect("is there"));
        step.assert_closed();
        assert_eq!(step.all("MANIFOLD_SOLID_BREP").count(), 1);
        if solid["made"] == "faceted" || solid["name"] == "pi_carrier" {
            assert_near(step.volume_mm3(), solid["volume_mm3"].as_f64().expect("a number"), 1e-4);
        }
    }
}

/// How many pieces a mesh has that share no corner.
fn pieces(mesh: &Mesh) -> usize {
    let mut piece: Vec<usize> = (0..mesh.vertices.len()).collect();
    loop {
        let before = piece.clone();
        for corners in &mesh.triangles {
            let least = corners.iter().map(|at| piece[*at as usize]).min().expect("three");
            corners.iter().for_each(|at| piece[*at as usize] = least);
        }
        if piece == before {
            return piece.iter().enumerate().filter(|(at, piece)| at == *piece).count();
        }
    }
}

#[test]
fn analytic_bodies_sit_in_the_assembly_as_in_the_design() {
    let (frame, _) = Frame::load("cognifly").expect("a preset");
    let design = Design::with(frame, common::memo()).expect("a design");
    let step = Step::read(&fs::read(built().join("frame.step")).expect("is there"));
    step.assert_closed();
    let used: BTreeSet<usize> = design.bodies.iter().map(|body| body.shape).collect();
    let solids: usize = used.iter().map(|shape| pieces(&design.shapes[*shape].mesh)).sum();
    assert!(solids > used.len(), "the screws of a motor are four pieces");
    assert_eq!(step.all("MANIFOLD_SOLID_BREP").count(), solids, "bodies that share a shape share its solids");
    assert_eq!(step.all("STYLED_ITEM").count(), solids);
    let places: Vec<[Vector3<f64>; 3]> =
        step.all("ITEM_DEFINED_TRANSFORMATION").map(|(number, _)| step.placement(step.below(number)[1])).collect();
    let names: Vec<&str> =
        step.all("NEXT_ASSEMBLY_USAGE_OCCURRENCE").map(|(_, arguments)| arguments.split('\'').nth(1).expect("a name")).collect();
    assert_eq!(names, design.bodies.iter().map(|body| body.name.as_str()).collect::<Vec<_>>());
    for (body, [at, z, x]) in design.bodies.iter().zip(places) {
        let wanted = [body.pose * Point3::origin(), body.pose * Point3::new(0.0, 0.0, 1.0), body.pose * Point3::new(1.0, 0.0, 0.0)];
        for (found, wanted) in [at, at + z, at + x].iter().zip(wanted) {
            assert!((found - wanted.coords).norm() < 1e-6, "{}", body.name);
        }
    }
}

#[test]
fn analytic_without_the_flag_there_is_no_step() {
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("no-step");
    let run = Command::new(cargo_bin("flexframe")).args(["build", "--no-pictures", "-q", "-o"]).arg(&out).output();
    assert!(run.expect("the program starts").status.success());
    let folder = out.join("cognifly");
    assert!(!folder.join("frame.step").exists());
    let manifest: Value = serde_json::from_slice(&fs::read(folder.join("manifest.json")).expect("is there")).expect("JSON");
    assert!(manifest["step"].is_null());
}
