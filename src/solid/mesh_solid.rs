//! The mesh kernel: features to closed triangle meshes, booleans, gaps.

use std::sync::{Arc, OnceLock};

use manifold_rust::linalg::{Mat3x4, Vec2, Vec3};
use manifold_rust::manifold::Manifold;
use manifold_rust::types::OpType;
use nalgebra::{Isometry3, Point3, Vector3};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::box_tree::BoxTree;
use super::facets::Facets;
use super::feature::Feature;
use super::mesh::Mesh;
use super::oriented_box::{Between, OrientedBox};
use super::profile::{Profile, circumscribed};
use super::region::Region;
use super::turn_polygon;
use crate::memo::{Key, Memo};
use crate::units::Angle;

/// Straight pieces that stand for a full circle: 0.3 % of its area is lost, 3 µm of a rod's radius.
pub const SEGMENTS_PER_TURN: u32 = 48;

/// Detail below this size (mm) is simplified away before a mesh is written; a tenth of what a printer can place.
const DETAIL_MM: f64 = 0.001;

/// Boxes that lie in each other by less than this touch: their faces have been rounded. Faces of 100 mm by 100 mm share 0.001 mm³ then, mm.
const ROUNDED_MM: f64 = 1e-7;

/// A closed solid in the mesh kernel, mm. Copies share what they hold.
#[derive(Clone)]
pub struct MeshSolid(Arc<Held>);

/// The kernel's solid, its facets, or both: each is made of the other when it is asked for, and boxes of the facets.
struct Held {
    kernel: OnceLock<Manifold>,
    facets: OnceLock<Facets>,
    boxes: OnceLock<BoxTree>,
    body_boxes: OnceLock<Vec<OrientedBox>>,
}

/// Where a line meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The point, mm.
    pub at: Point3<f64>,
    /// The surface's direction there, outwards.
    pub normal: Vector3<f64>,
}

impl MeshSolid {
    /// Builds a feature tree; an impossible one (a negative height, an empty result) comes out empty.
    pub fn build(feature: &Feature) -> Self {
        Self::build_finely(feature, SEGMENTS_PER_TURN)
    }

    /// The same with so many straight pieces in a full circle: with more of them it comes nearer to the solid that the tree means.
    pub fn build_finely(feature: &Feature, per_turn: u32) -> Self {
        Self::of(Builder { made: Vec::new(), memo: None, per_turn }.solid(feature))
    }

    /// The same with the branches of former trees that are the same.
    pub fn build_from(feature: &Feature, memo: &Memo) -> Self {
        Self::of(Builder { made: Vec::new(), memo: Some(memo), per_turn: SEGMENTS_PER_TURN }.solid(feature))
    }

    fn of(kernel: Manifold) -> Self {
        Self(Arc::new(Held { kernel: kernel.into(), facets: OnceLock::new(), boxes: OnceLock::new(), body_boxes: OnceLock::new() }))
    }

    pub(super) fn of_facets(facets: Facets) -> Self {
        Self(Arc::new(Held { kernel: OnceLock::new(), facets: facets.into(), boxes: OnceLock::new(), body_boxes: OnceLock::new() }))
    }

    fn kernel(&self) -> &Manifold {
        self.0.kernel.get_or_init(|| self.0.facets.get().map_or_else(Manifold::empty, Facets::kernel))
    }

    pub(super) fn facets_held(&self) -> &Facets {
        self.0.facets.get_or_init(|| Facets::of(self.kernel()))
    }

    /// The same as it is after it was kept on disk: the kernel's solid made of the facets. What is computed of a solid that is kept
    /// has to be computed of this one, as the kernel lists the facets of the two in different orders.
    pub fn reimported(&self) -> Self {
        Self::of_facets(self.facets_held().clone())
    }

    /// What tells it from other solids, to the last bit of its facets.
    pub fn key(&self) -> Key {
        self.facets_held().key()
    }

    /// Takes a written mesh back into the kernel; `None` when it is not closed.
    pub fn from_mesh(mesh: &Mesh) -> Option<Self> {
        let solid = Facets::of_mesh(mesh).kernel();
        (!solid.is_empty()).then_some(Self::of(solid))
    }

    /// The same without detail that no printer can place.
    pub fn simplified(&self) -> Self {
        self.without_detail(DETAIL_MM)
    }

    /// The same without detail below a size, mm.
    pub fn without_detail(&self, below_mm: f64) -> Self {
        Self::of(self.kernel().as_original().simplify(below_mm))
    }

    /// The same with corners within a distance, mm, made one; empty where that leaves no closed surface.
    pub fn welded(&self, within_mm: f64) -> Self {
        Self::of_facets(self.facets_held().welded(within_mm))
    }

    /// The same surface with stouter facets where several lie in a plane: slicers and other readers round slivers away.
    pub fn stout(&self) -> Self {
        Self::of_facets(self.facets_held().stout())
    }

    /// The mesh of the simplified solid.
    pub fn to_mesh(&self) -> Mesh {
        self.simplified().mesh()
    }

    /// Its mesh as it is, in canonical order.
    pub fn mesh(&self) -> Mesh {
        let facets = self.facets_held();
        let corners: Vec<Point3<f64>> = facets.corners.iter().map(|corner| Point3::from(*corner)).collect();
        Mesh::canonical(&corners, &facets.triangles)
    }

    /// Boxes around its facets.
    pub fn boxes(&self) -> &BoxTree {
        self.0.boxes.get_or_init(|| BoxTree::of(self.facets()))
    }

    /// Its facets with the kernel's own numbers, mm.
    pub(super) fn facets(&self) -> Vec<[Point3<f64>; 3]> {
        let facets = self.facets_held();
        facets.triangles.iter().map(|triangle| triangle.map(|corner| Point3::from(facets.corners[corner as usize]))).collect()
    }

    /// Nothing in it.
    pub fn is_empty(&self) -> bool {
        self.kernel().is_empty()
    }

    /// Enclosed volume, mm³.
    pub fn volume_mm3(&self) -> f64 {
        self.kernel().volume()
    }

    /// Whether facets cross each other.
    pub fn has_self_intersections(&self) -> bool {
        self.kernel().has_self_intersections()
    }

    /// Lowest and highest corner of the bounding box, mm.
    pub fn bounds_mm(&self) -> [[f64; 3]; 2] {
        match self.0.kernel.get() {
            None => self.bounds_in_mm(&Isometry3::identity()),
            Some(kernel) => {
                let b = kernel.bounding_box();
                [[b.min.x, b.min.y, b.min.z], [b.max.x, b.max.y, b.max.z]]
            }
        }
    }

    /// Lowest and highest corner of the bounding box of the solid in a pose, mm.
    pub fn bounds_in_mm(&self, pose: &Isometry3<f64>) -> [[f64; 3]; 2] {
        self.facets_held().bounds_in_mm(pose)
    }

    /// Moved rigidly.
    pub fn placed(&self, pose: &Isometry3<f64>) -> Self {
        Self::of(self.kernel().transform(&matrix(pose)))
    }

    /// Both together.
    pub fn union(&self, other: &Self) -> Self {
        Self::of(self.kernel().union(other.kernel()))
    }

    /// This without the other.
    pub fn minus(&self, other: &Self) -> Self {
        Self::of(self.kernel().difference(other.kernel()))
    }

    /// What both share.
    pub fn intersection(&self, other: &Self) -> Self {
        Self::of(self.kernel().intersection(other.kernel()))
    }

    /// Volume in common with another, in a pose relative to this one's axes, mm³.
    pub fn shared_mm3(&self, other: &Self, pose: &Isometry3<f64>) -> f64 {
        if self.is_parted_from(other, pose) {
            return 0.0;
        }
        self.intersection(&other.placed(pose)).volume_mm3()
    }

    /// What lies on the side of the plane that the normal points to; the plane is `normal · p = offset`.
    pub fn half(&self, normal: Vector3<f64>, offset_mm: f64) -> Self {
        Self::of(self.kernel().trim_by_plane(vec3(&normal), offset_mm))
    }

    /// What of it is in boxes along its axes that are apart; all of it where one of them holds it.
    pub fn in_boxes(&self, boxes: &[OrientedBox]) -> Self {
        let [low, high] = self.bounds_mm();
        let holds = |[from, to]: [[f64; 3]; 2]| (0..3).all(|axis| from[axis] <= low[axis] && high[axis] <= to[axis]);
        if boxes.iter().any(|around| holds(around.bounds_mm())) {
            return self.clone();
        }
        let cuboids = boxes.iter().map(OrientedBox::bounds_mm).map(|[from, to]| Feature::cuboid_between(from, to));
        self.intersection(&Self::build(&Feature::union(cuboids)))
    }

    /// How many facets it has.
    pub fn facet_count(&self) -> usize {
        self.facets_held().triangles.len()
    }

    /// Boxes along its axes around each of its separate bodies.
    pub fn body_boxes(&self) -> &[OrientedBox] {
        let around = || self.facets_held().bodies().iter().map(|corners| OrientedBox::around(corners.iter())).collect();
        self.0.body_boxes.get_or_init(around)
    }

    /// Whether boxes around the separate bodies of the two lie in each other by rounding at most, the other in a pose relative to this
    /// one's axes. Only whole bodies tell it: facets that merely touch do not, as those of a shank under a head that lies on a face.
    fn is_parted_from(&self, other: &Self, pose: &Isometry3<f64>) -> bool {
        let between = Between::of(pose);
        self.body_boxes().iter().all(|mine| other.body_boxes().iter().all(|its| mine.apart_by_edges_mm(its, &between) >= -ROUNDED_MM))
    }

    /// Its largest body alone: what is left when a cut has grazed a surface.
    pub fn largest_body(&self) -> Self {
        let bodies = self.kernel().decompose();
        Self::of(bodies.into_iter().max_by(|a, b| a.volume().total_cmp(&b.volume())).unwrap_or_else(Manifold::empty))
    }

    /// The shortest distance to the other solid, mm, at most `reach_mm`; 0 when they touch or overlap.
    pub fn gap_mm(&self, other: &Self, reach_mm: f64) -> f64 {
        self.kernel().min_gap(other.kernel(), reach_mm)
    }

    /// Where a straight line first meets the surface.
    pub fn first_hit(&self, from: Point3<f64>, to: Point3<f64>) -> Option<Hit> {
        let point = |v: Vec3| Vector3::new(v.x, v.y, v.z);
        let hits = self.kernel().ray_cast(vec3(&from.coords), vec3(&to.coords));
        hits.first().map(|hit| Hit { at: point(hit.position).into(), normal: point(hit.normal) })
    }

    /// The smallest convex solid around this and the other.
    pub fn hull_with(&self, other: &Self) -> Self {
        Self::of(Manifold::hull_manifolds(&[self.kernel().clone(), other.kernel().clone()]))
    }

    /// The smallest convex solid around points, mm; empty where they lie in a plane.
    pub fn hull_of(points: &[Point3<f64>]) -> Self {
        let points: Vec<Vec3> = points.iter().map(|p| vec3(&p.coords)).collect();
        Self::of(Manifold::hull(&points))
    }

    /// The cut at a height z, mm.
    pub fn slice(&self, z_mm: f64) -> Region {
        Region::of(self.kernel().slice(z_mm))
    }

    /// The same surface with every edge cut to at most this length, for a bend that follows.
    pub fn refined(&self, length_mm: f64) -> Self {
        Self::of(self.kernel().refine_to_length(length_mm))
    }

    /// Every point moved by the map, which must not fold the solid over itself.
    pub fn warped(&self, map: impl Fn(Point3<f64>) -> Point3<f64>) -> Self {
        Self::of(self.kernel().warp(|v| {
            let p = map(Point3::new(v.x, v.y, v.z));
            *v = Vec3::new(p.x, p.y, p.z);
        }))
    }

    /// A solid from raw contours in (r, z), turned about z through an angle from the xz plane.
    pub(super) fn revolved(contours: &[Vec<[f64; 2]>], segments: u32, degrees: f64) -> Self {
        let outlines = contours.iter().map(|c| c.iter().map(|p| Vec2::new(p[0], p[1])).collect()).collect();
        Self::of(Manifold::revolve(&outlines, segments as i32, degrees))
    }
}

/// Kept as its facets.
impl Serialize for MeshSolid {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.facets_held().serialize(serializer)
    }
}

/// As [`MeshSolid::reimported`].
impl<'de> Deserialize<'de> for MeshSolid {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Facets::deserialize(deserializer).map(Self::of_facets)
    }
}

impl Region {
    /// The solid between two heights, mm.
    pub fn drawn_up(&self, low_mm: f64, high_mm: f64) -> MeshSolid {
        let solid = Manifold::extrude(&self.polygons(), high_mm - low_mm, 0, 0.0, Vec2::new(1.0, 1.0));
        MeshSolid::of(solid).placed(&Isometry3::translation(0.0, 0.0, low_mm))
    }
}

/// Makes the solids of a feature tree. What occurs in it several times is made once.
struct Builder<'a> {
    made: Vec<(&'a Feature, Manifold)>,
    /// Branches of other trees.
    memo: Option<&'a Memo>,
    /// Straight pieces that stand for a full circle.
    per_turn: u32,
}

impl<'a> Builder<'a> {
    fn solid(&mut self, feature: &'a Feature) -> Manifold {
        if let Some((_, solid)) = self.made.iter().find(|(made, _)| *made == feature) {
            return solid.clone();
        }
        let solid = match (self.memo, feature) {
            (Some(memo), Feature::Hull(_) | Feature::Union(_) | Feature::Intersection(_) | Feature::Difference { .. }) => {
                Manifold::clone(&memo.hold("branch", feature, || self.make(feature)))
            }
            _ => self.make(feature),
        };
        // Moving a copy takes as long as looking it up saves.
        if !matches!(feature, Feature::Placed { .. }) {
            self.made.push((feature, solid.clone()));
        }
        solid
    }

    fn solids(&mut self, features: &'a [Feature]) -> Vec<Manifold> {
        features.iter().map(|feature| self.solid(feature)).collect()
    }

    fn make(&mut self, feature: &'a Feature) -> Manifold {
        let n = self.per_turn as i32;
        match feature {
            Feature::Extrude { profile, height_mm } => {
                Manifold::extrude(&outlines(profile, self.per_turn), *height_mm, 0, 0.0, Vec2::new(1.0, 1.0))
            }
            Feature::Cylinder { radius_mm, height_mm } => Manifold::cylinder(*height_mm, *radius_mm, *radius_mm, n),
            Feature::Bore { radius_mm, height_mm } => {
                let radius = circumscribed(*radius_mm, self.per_turn);
                Manifold::cylinder(*height_mm, radius, radius, n)
            }
            Feature::Cone { bottom_radius_mm, top_radius_mm, height_mm } => {
                Manifold::cylinder(*height_mm, *bottom_radius_mm, *top_radius_mm, n)
            }
            Feature::Sphere { radius_mm } => Manifold::sphere(*radius_mm, n),
            Feature::Revolve { profile, corners } => revolution(profile, corners, self.per_turn),
            Feature::Hull(of) => Manifold::hull_manifolds(&self.solids(of)),
            Feature::Union(of) => union(self.solids(of)),
            Feature::Intersection(of) => pairwise(self.solids(of), OpType::Intersect),
            Feature::Difference { base, cuts } => self.solid(base).difference(&union(self.solids(cuts))),
            Feature::Placed { pose, of } => self.solid(of).transform(&matrix(pose)),
            Feature::Mirrored { normal, of } => self.solid(of).mirror(vec3(normal)),
        }
    }
}

/// A profile turned once about z, with corners of its polygon at these angles.
fn revolution(profile: &Profile, corners: &[Angle], per_turn: u32) -> Manifold {
    let angles = turn_polygon::angles_rad(corners, per_turn);
    let even = std::f64::consts::TAU / angles.len() as f64;
    let whole = Manifold::revolve(&outlines(profile, per_turn), angles.len() as i32, 360.0);
    if corners.is_empty() {
        return whole;
    }
    whole.warp(|v| {
        let at = (libm::atan2(v.y, v.x) / even).round() as i64;
        let (sin, cos) = libm::sincos(angles[at.rem_euclid(angles.len() as i64) as usize]);
        let radius = libm::hypot(v.x, v.y);
        (v.x, v.y) = (radius * cos, radius * sin);
    })
}

/// All together. Solids whose boxes are apart need no boolean: they are only listed as one.
fn union(solids: Vec<Manifold>) -> Manifold {
    let mut groups: Vec<Vec<Manifold>> = Vec::new();
    for solid in solids {
        let bounds = solid.bounding_box();
        let apart = |group: &&mut Vec<Manifold>| group.iter().all(|other| !other.bounding_box().does_overlap_box(&bounds));
        match groups.iter_mut().find(apart) {
            Some(group) => group.push(solid),
            None => groups.push(vec![solid]),
        }
    }
    pairwise(groups.iter().map(|group| Manifold::compose(group)).collect(), OpType::Add)
}

/// Joins neighbours pairwise until one is left, so that the operands stay small.
fn pairwise(mut solids: Vec<Manifold>, op: OpType) -> Manifold {
    while solids.len() > 1 {
        solids = solids
            .chunks(2)
            .map(|pair| match pair {
                [a, b] => a.boolean(b, op),
                _ => pair[0].clone(),
            })
            .collect();
    }
    solids.pop().unwrap_or_else(Manifold::empty)
}

/// Contours in the kernel's direction: outer counter-clockwise, holes clockwise.
fn outlines(profile: &Profile, per_turn: u32) -> Vec<Vec<Vec2>> {
    let oriented = |points: Vec<nalgebra::Point2<f64>>, ccw: bool| {
        let mut outline: Vec<Vec2> = points.iter().map(|p| Vec2::new(p.x, p.y)).collect();
        let twice_area: f64 = (0..outline.len())
            .map(|i| {
                let (a, b) = (outline[i], outline[(i + 1) % outline.len()]);
                a.x * b.y - b.x * a.y
            })
            .sum();
        if (twice_area > 0.0) != ccw {
            outline.reverse();
        }
        outline
    };
    let holes = profile.holes.iter().map(|hole| oriented(hole.points(per_turn), false));
    std::iter::once(oriented(profile.outer.points(per_turn), true)).chain(holes).collect()
}

fn vec3(v: &Vector3<f64>) -> Vec3 {
    Vec3::new(v.x, v.y, v.z)
}

fn matrix(pose: &Isometry3<f64>) -> Mat3x4 {
    let m = pose.rotation.to_rotation_matrix();
    let column = |i: usize| Vec3::new(m[(0, i)], m[(1, i)], m[(2, i)]);
    Mat3x4::from_cols(column(0), column(1), column(2), vec3(&pose.translation.vector))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64, y: f64, z: f64) -> Isometry3<f64> {
        Isometry3::translation(x, y, z)
    }

    #[test]
    fn analytic_blocks_that_touch_share_nothing_and_deeper_ones_what_they_share() {
        let [block, pair] = [Feature::cuboid([10.0, 10.0, 10.0]), Feature::cuboid([2.0, 2.0, 2.0])];
        let block = MeshSolid::build(&block);
        let pair = MeshSolid::build(&Feature::union([pair.clone().at(0.0, 0.0, 0.0), pair.at(20.0, 0.0, 0.0)]));
        for deg in [0.0, 35.0] {
            let turned = Isometry3::rotation(Vector3::z() * f64::to_radians(deg));
            let height = block.bounds_mm()[1][2] - pair.bounds_mm()[0][2];
            assert_eq!(block.shared_mm3(&pair, &(at(0.0, 0.0, height) * turned)), 0.0);
            let shared = block.shared_mm3(&pair, &(at(0.0, 0.0, height - 0.01) * turned));
            assert!((shared - 0.04).abs() < 1e-6, "{shared}");
        }
        // The block stands between the two of the pair: the box around both is in it, they are not.
        assert_eq!(block.shared_mm3(&pair, &at(-10.0, 0.0, 0.0)), 0.0);
    }

    #[test]
    fn analytic_a_shank_under_a_head_that_lies_on_a_plate_is_in_the_plate() {
        let plate = MeshSolid::build(&Feature::cuboid_between([-9.0, -9.0, -4.0], [9.0, 9.0, 0.0]));
        let head = Feature::cuboid_between([-2.0, -2.0, 0.0], [2.0, 2.0, 1.0]);
        let screw = MeshSolid::build(&Feature::union([head, Feature::cuboid_between([-1.0, -1.0, -3.0], [1.0, 1.0, 0.0])]));
        assert!((plate.shared_mm3(&screw, &Isometry3::identity()) - 12.0).abs() < 1e-9);
    }
}
