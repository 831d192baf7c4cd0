//! The surfaces that a feature tree is bounded by, and which facets of the mesh stand for them.

use nalgebra::{Isometry3, Matrix3, Point2, Point3, Unit, Vector3};

use super::regions::Facet;
use super::spanned::between;
use super::surface::{Surface, across};
use crate::solid::profile::{Contour, Profile, Segment, circumscribed, sweep_angle};
use crate::solid::turn_polygon;
use crate::solid::{Feature, MeshSolid, SEGMENTS_PER_TURN};

/// A surface with what its facets look like.
#[derive(Clone, Debug)]
pub(super) struct Known {
    pub(super) surface: Surface,
    /// Of a cylinder: how far its facets' planes and their corners are from the axis, mm. Of another round surface: how far they lie inside
    /// and outside it.
    reach_mm: [f64; 2],
    /// Of a cone, a sphere or a torus: how far a facet's normal may be turned from the surface's, rad.
    turned_rad: f64,
}

/// Rotation or reflection, then a shift.
type Place = (Matrix3<f64>, Vector3<f64>);

/// How far a facet's corners may lie beside the surface that it stands for, mm: what simplifying detail away can move them.
pub(super) const BESIDE_MM: f64 = 0.0015;

/// How far a facet of a cone, a sphere or a torus may be turned from it, as a share of what its whole facets are: a facet that is cut has its
/// middle elsewhere.
const TURNED_SHARE: f64 = 1.2;

/// A facet that lies on a plane this well is not taken for a chord of a cylinder, mm.
const PLANE_FIRST_MM: f64 = 1e-4;

/// Every plane and round surface of a tree, moved by a pose. Of what a hull spans between round bodies, planes and cylinders.
pub(super) fn surfaces(feature: &Feature, pose: &Isometry3<f64>) -> Vec<Known> {
    let mut found: Vec<Known> = Vec::new();
    let place = (pose.rotation.to_rotation_matrix().into_inner(), pose.translation.vector);
    collect(feature, &place, &mut found);
    let mut distinct: Vec<Known> = Vec::new();
    for known in found {
        let same = |other: &Known| {
            let reach = (0..2).all(|i| (other.reach_mm[i] - known.reach_mm[i]).abs() < 1e-9);
            reach && other.surface.is_same(&known.surface)
        };
        if !distinct.iter().any(same) {
            distinct.push(known);
        }
    }
    distinct
}

fn collect(feature: &Feature, place: &Place, found: &mut Vec<Known>) {
    let turn = std::f64::consts::TAU / f64::from(SEGMENTS_PER_TURN);
    match feature {
        Feature::Extrude { profile, height_mm } => extruded(profile, *height_mm, place, found),
        Feature::Cylinder { radius_mm, height_mm } => {
            caps(*height_mm, place, found);
            found.push(upright([0.0, 0.0], *radius_mm, [radius_mm * libm::cos(0.5 * turn), *radius_mm], place));
        }
        Feature::Bore { radius_mm, height_mm } => {
            caps(*height_mm, place, found);
            found.push(upright([0.0, 0.0], *radius_mm, [*radius_mm, circumscribed(*radius_mm, SEGMENTS_PER_TURN)], place));
        }
        Feature::Cone { bottom_radius_mm, top_radius_mm, height_mm } => {
            caps(*height_mm, place, found);
            found.extend(cone([*bottom_radius_mm, 0.0], [*top_radius_mm, *height_mm], place));
        }
        Feature::Sphere { radius_mm } => found.push(sphere(0.0, *radius_mm, STEP_RAD, place)),
        Feature::Revolve { profile, corners } => revolved(profile, &turn_polygon::steps_rad(corners, SEGMENTS_PER_TURN), place, found),
        Feature::Hull(of) => {
            if of.iter().all(has_planes_only) {
                hull(feature, place, found);
            } else {
                let first = found.len();
                of.iter().for_each(|feature| collect(feature, place, found));
                let spans = spanned(&found[first..]);
                found.extend(spans);
            }
        }
        Feature::Union(of) | Feature::Intersection(of) => of.iter().for_each(|feature| collect(feature, place, found)),
        Feature::Difference { base, cuts } => std::iter::once(&**base).chain(cuts).for_each(|feature| collect(feature, place, found)),
        Feature::Placed { pose, of } => {
            let rotation = pose.rotation.to_rotation_matrix().into_inner();
            collect(of, &(place.0 * rotation, place.0 * pose.translation.vector + place.1), found);
        }
        Feature::Mirrored { normal, of } => {
            let n = normal.normalize();
            collect(of, &(place.0 * (Matrix3::identity() - 2.0 * n * n.transpose()), place.1), found);
        }
    }
}

fn plane(point: Vector3<f64>, normal: Vector3<f64>, place: &Place) -> Known {
    let surface = Surface::Plane { point: (place.0 * point + place.1).into(), normal: Unit::new_normalize(place.0 * normal) };
    Known { surface, reach_mm: [0.0; 2], turned_rad: 0.0 }
}

fn upright(centre: [f64; 2], radius_mm: f64, reach_mm: [f64; 2], place: &Place) -> Known {
    let point = place.0 * Vector3::new(centre[0], centre[1], 0.0) + place.1;
    let surface = Surface::Cylinder { point: point.into(), axis: Unit::new_normalize(place.0 * Vector3::z()), radius_mm };
    Known { surface, reach_mm, turned_rad: 0.0 }
}

/// Half the angle between neighbouring facets of a whole turn, rad.
const STEP_RAD: f64 = std::f64::consts::PI / SEGMENTS_PER_TURN as f64;

/// Of a surface that is round in two directions: chords lie inside it or outside, as it is bulged or waisted.
fn doubly_round(surface: Surface, chord_mm: f64, turned_rad: f64) -> Known {
    Known { surface, reach_mm: [-chord_mm, chord_mm], turned_rad }
}

/// Between two places (r, z).
fn cone(from: [f64; 2], to: [f64; 2], place: &Place) -> Option<Known> {
    let [low, high] = if from[0] < to[0] { [from, to] } else { [to, from] };
    let (grows, rises) = (high[0] - low[0], high[1] - low[1]);
    if grows < 1e-9 || rises.abs() < 1e-9 {
        return None;
    }
    let surface = Surface::Cone {
        point: (place.0 * Vector3::new(0.0, 0.0, high[1]) + place.1).into(),
        axis: Unit::new_normalize(place.0 * Vector3::z() * rises.signum()),
        radius_mm: high[0],
        half_angle_rad: libm::atan2(grows, rises.abs()),
    };
    Some(doubly_round(surface, high[0] * (1.0 - libm::cos(STEP_RAD)), STEP_RAD))
}

fn sphere(z_mm: f64, radius_mm: f64, step_rad: f64, place: &Place) -> Known {
    let centre = (place.0 * Vector3::new(0.0, 0.0, z_mm) + place.1).into();
    let surface = Surface::Sphere { centre, axis: Unit::new_normalize(place.0 * Vector3::z()), radius_mm };
    let turned_rad = STEP_RAD + step_rad;
    doubly_round(surface, radius_mm * (1.0 - libm::cos(turned_rad)), turned_rad)
}

/// Of an arc around a place (r, z): a sphere where that lies on the axis.
fn turned_arc(centre: [f64; 2], radius_mm: f64, step_rad: f64, place: &Place) -> Option<Known> {
    if centre[0].abs() < 1e-9 {
        return Some(sphere(centre[1], radius_mm, step_rad, place));
    }
    let surface = Surface::Torus {
        centre: (place.0 * Vector3::new(0.0, 0.0, centre[1]) + place.1).into(),
        axis: Unit::new_normalize(place.0 * Vector3::z()),
        radius_mm: centre[0],
        minor_radius_mm: radius_mm,
    };
    let chord_mm = (centre[0] + radius_mm) * (1.0 - libm::cos(STEP_RAD)) + radius_mm * (1.0 - libm::cos(step_rad));
    // Left of the axis the profile would cut itself.
    (centre[0] > 0.0).then(|| doubly_round(surface, chord_mm, STEP_RAD + step_rad))
}

fn caps(height_mm: f64, place: &Place, found: &mut Vec<Known>) {
    found.extend([0.0, height_mm].map(|z| plane(Vector3::new(0.0, 0.0, z), Vector3::z(), place)));
}

fn extruded(profile: &Profile, height_mm: f64, place: &Place, found: &mut Vec<Known>) {
    caps(height_mm, place, found);
    for contour in std::iter::once(&profile.outer).chain(&profile.holes) {
        match contour {
            Contour::Circle { centre, radius_mm, bore } => {
                let half = std::f64::consts::PI / f64::from(SEGMENTS_PER_TURN);
                let outer = if *bore { circumscribed(*radius_mm, SEGMENTS_PER_TURN) } else { *radius_mm };
                found.push(upright([centre.x, centre.y], *radius_mm, [outer * libm::cos(half), outer], place));
            }
            Contour::Path { start, segments } => {
                let mut from = *start;
                for segment in segments {
                    match segment {
                        Segment::Line { to } => {
                            let along = to - from;
                            found.push(plane(Vector3::new(from.x, from.y, 0.0), Vector3::new(along.y, -along.x, 0.0), place));
                            from = *to;
                        }
                        Segment::Arc { to, centre, counter_clockwise } => {
                            let radius = (from - centre).norm();
                            let sweep = sweep_angle(from, *to, *centre, *counter_clockwise).abs();
                            let steps = (sweep / std::f64::consts::TAU * f64::from(SEGMENTS_PER_TURN)).ceil().max(1.0);
                            let inner = radius * libm::cos(0.5 * sweep / steps);
                            found.push(upright([centre.x, centre.y], radius, [inner, radius], place));
                            from = *to;
                        }
                    }
                }
            }
        }
    }
}

/// Of a profile in (r, z) that is turned in such steps.
fn revolved(profile: &Profile, steps_rad: &[f64], place: &Place, found: &mut Vec<Known>) {
    for contour in std::iter::once(&profile.outer).chain(&profile.holes) {
        match contour {
            Contour::Circle { centre, radius_mm, .. } => found.extend(turned_arc([centre.x, centre.y], *radius_mm, STEP_RAD, place)),
            Contour::Path { start, segments } => {
                let mut from = *start;
                for segment in segments {
                    match segment {
                        Segment::Line { to } if (to.x - from.x).abs() < 1e-9 => {
                            found.extend(steps_rad.iter().filter_map(|step| turned_upright(from.x, *step, place)));
                        }
                        _ => found.extend(turned(from, segment, place)),
                    }
                    from = segment.to();
                }
            }
        }
    }
}

/// The cylinder of a line along the axis, in the chords of one step.
fn turned_upright(radius_mm: f64, step_rad: f64, place: &Place) -> Option<Known> {
    (radius_mm > 1e-9).then(|| upright([0.0, 0.0], radius_mm, [radius_mm * libm::cos(0.5 * step_rad), radius_mm], place))
}

fn turned(from: Point2<f64>, segment: &Segment, place: &Place) -> Option<Known> {
    match segment {
        Segment::Line { to } if (to.y - from.y).abs() < 1e-9 => Some(plane(Vector3::new(0.0, 0.0, from.y), Vector3::z(), place)),
        Segment::Line { to } => cone([from.x, from.y], [to.x, to.y], place),
        Segment::Arc { to, centre, counter_clockwise } => {
            let sweep = sweep_angle(from, *to, *centre, *counter_clockwise).abs();
            let steps = (sweep / (2.0 * STEP_RAD)).ceil().max(1.0);
            turned_arc([centre.x, centre.y], (from - centre).norm(), 0.5 * sweep / steps, place)
        }
    }
}

fn has_planes_only(feature: &Feature) -> bool {
    match feature {
        Feature::Extrude { profile, .. } => std::iter::once(&profile.outer).chain(&profile.holes).all(|contour| match contour {
            Contour::Circle { .. } => false,
            Contour::Path { segments, .. } => segments.iter().all(|segment| matches!(segment, Segment::Line { .. })),
        }),
        Feature::Hull(of) | Feature::Union(of) | Feature::Intersection(of) => of.iter().all(has_planes_only),
        Feature::Difference { base, cuts } => has_planes_only(base) && cuts.iter().all(has_planes_only),
        Feature::Placed { of, .. } | Feature::Mirrored { of, .. } => has_planes_only(of),
        _ => false,
    }
}

/// The planes of a hull around what has planes only: the mesh kernel's facets are exact there.
fn hull(feature: &Feature, place: &Place, found: &mut Vec<Known>) {
    let facets = MeshSolid::build(feature).facets();
    for facet in facets.into_iter().map(Facet::new).filter(|facet| facet.height_mm > 0.01) {
        found.push(plane(facet.corners[0].coords, facet.normal, place));
    }
}

/// The planes and cylinders that a hull spans between each two of its round surfaces that are alike.
fn spanned(of: &[Known]) -> Vec<Known> {
    let pairs = (0..of.len()).flat_map(|i| of[i + 1..].iter().map(move |other| (&of[i], other)));
    pairs.flat_map(|(one, other)| between(&one.surface, &other.surface).into_iter().map(|surface| one.spanning(surface))).collect()
}

impl Known {
    /// How far a facet is from being a piece of this surface, mm; `None` when it is none.
    pub(super) fn beside_mm(&self, facet: &Facet) -> Option<f64> {
        let lean = BESIDE_MM / facet.height_mm.max(f64::MIN_POSITIVE);
        let off = match &self.surface {
            Surface::Plane { normal, .. } => {
                if facet.normal.cross(normal).norm() > 2.0 * lean + 1e-4 {
                    return None;
                }
                facet.corners.iter().map(|p| self.surface.distance_mm(p).abs()).fold(0.0, f64::max)
            }
            Surface::Cylinder { point, axis, .. } => {
                let [inner, outer] = self.reach_mm;
                let middle = facet.corners.iter().map(|p| p - point).sum::<Vector3<f64>>() / 3.0;
                let chord = (facet.normal.dot(&middle).abs() - inner).abs();
                if facet.normal.dot(axis).abs() > 2.0 * lean + 1e-4 || chord > BESIDE_MM + 2.0 * lean * outer {
                    return None;
                }
                let off = |p: &Point3<f64>| {
                    let r = across(axis, &(p - point)).norm();
                    (r - outer).max(inner - r)
                };
                // What leans a little is rather a piece of what this cylinder goes over into.
                let leans_mm = 0.5 * facet.height_mm * facet.normal.dot(axis).abs();
                facet.corners.iter().map(off).fold(leans_mm.max(PLANE_FIRST_MM), f64::max)
            }
            round => {
                let middle = nalgebra::center(&nalgebra::center(&facet.corners[0], &facet.corners[1]), &facet.corners[2]);
                let turned = facet.normal.dot(&round.normal_at(&middle)).abs();
                if turned < libm::cos((TURNED_SHARE * self.turned_rad + 2.0 * lean).min(1.0)) {
                    return None;
                }
                let off = |p: &Point3<f64>| {
                    let beside = round.distance_mm(p);
                    (beside - self.reach_mm[1]).max(self.reach_mm[0] - beside)
                };
                // A plane or a cylinder is the likelier one.
                facet.corners.iter().map(off).fold(2.0 * PLANE_FIRST_MM, f64::max)
            }
        };
        (off < BESIDE_MM).then_some(off)
    }

    /// How far a facet's corners lie beside a cone, a sphere or a torus, mm, all together; 0 of surfaces whose chords say enough.
    pub(super) fn corners_beside_mm(&self, facet: &Facet) -> f64 {
        match &self.surface {
            Surface::Plane { .. } | Surface::Cylinder { .. } => 0.0,
            round => facet.corners.iter().map(|p| round.distance_mm(p).abs()).sum(),
        }
    }

    /// A surface that a hull spans from this one to another that is alike: its chords are those of this one's meridian.
    fn spanning(&self, surface: Surface) -> Self {
        let reach_mm = match &surface {
            Surface::Cylinder { radius_mm, .. } => [radius_mm * libm::cos(self.turned_rad - STEP_RAD), *radius_mm],
            _ => [0.0; 2],
        };
        Self { surface, reach_mm, turned_rad: 0.0 }
    }

    pub(super) fn is_cylinder(&self) -> bool {
        matches!(self.surface, Surface::Cylinder { .. })
    }

    /// Whether a point lies on the surface, or between it and its facets.
    pub(super) fn is_near(&self, p: &Point3<f64>, within_mm: f64) -> bool {
        match &self.surface {
            Surface::Plane { .. } => self.surface.distance_mm(p).abs() < within_mm,
            Surface::Cylinder { point, axis, .. } => {
                let r = across(axis, &(p - point)).norm();
                self.reach_mm[0] - within_mm < r && r < self.reach_mm[1] + within_mm
            }
            round => {
                let beside = round.distance_mm(p);
                self.reach_mm[0] - within_mm < beside && beside < self.reach_mm[1] + within_mm
            }
        }
    }
}
