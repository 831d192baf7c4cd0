//! Features put where they belong: the few placements the parts share.

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

use crate::solid::{Contour, Feature, Profile};

/// How large a half space is drawn, mm.
const FAR_MM: f64 = 60.0;

/// How deep one body sinks into another so that their faces do not coincide, mm. Far below what prints.
pub const SINK_MM: f64 = 0.01;

/// The turn that takes x, y, z to these three orthonormal, right-handed axes.
pub fn turn(x: Vector3<f64>, y: Vector3<f64>, z: Vector3<f64>) -> UnitQuaternion<f64> {
    debug_assert!(x.cross(&y).dot(&z) > 0.99);
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, z])))
}

/// The feature turned, then moved.
pub fn placed(feature: Feature, rotation: UnitQuaternion<f64>, at: Point3<f64>) -> Feature {
    feature.placed(Isometry3::from_parts(Translation3::from(at), rotation))
}

/// Some turn that takes z to a direction.
pub fn towards(direction: Vector3<f64>) -> UnitQuaternion<f64> {
    let z = direction.normalize();
    let aside = if z.z.abs() < 0.9 { Vector3::z() } else { Vector3::x() };
    let x = aside.cross(&z).normalize();
    turn(x, z.cross(&x), z)
}

/// An outline in the plane, drawn out from one height to another, mm.
pub fn plate(outer: Contour, z0_mm: f64, z1_mm: f64) -> Feature {
    Feature::extrude(Profile::new(outer), z1_mm - z0_mm).at(0.0, 0.0, z0_mm)
}

/// An outline in (y, z), drawn out along x, mm.
pub fn along_x(outline_yz: Contour, x0_mm: f64, x1_mm: f64) -> Feature {
    let rotation = turn(Vector3::y(), Vector3::z(), Vector3::x());
    placed(plate(outline_yz, x0_mm, x1_mm), rotation, Point3::origin())
}

/// An outline in (z, x), drawn out along y, mm.
pub fn along_y(outline_zx: Contour, y0_mm: f64, y1_mm: f64) -> Feature {
    let rotation = turn(Vector3::z(), Vector3::x(), Vector3::y());
    placed(plate(outline_zx, y0_mm, y1_mm), rotation, Point3::origin())
}

/// Everything near the part that lies on the side of a plane its normal points to.
pub fn half_space(point: Point3<f64>, normal: Vector3<f64>) -> Feature {
    let cube = Feature::cuboid_between([-FAR_MM, -FAR_MM, 0.0], [FAR_MM, FAR_MM, 2.0 * FAR_MM]);
    placed(cube, towards(normal), point)
}

/// The feature and its mirror image in a plane through the origin.
pub fn with_mirror(feature: Feature, normal: Vector3<f64>) -> Feature {
    Feature::union([feature.clone(), feature.mirrored(normal)])
}
