//! Where surfaces touch, as a rounded edge and the faces beside it do.

use nalgebra::{Point3, Unit, Vector3};

use super::surface::{Surface, across};

/// How far lengths and directions may differ that are the same, mm or as a sine.
const SAME: f64 = 1e-9;

/// A surface that crosses two others where they touch; none of surfaces that cross, or are apart, or touch in a point only. Their own normals
/// are the same there, and do not tell where that is.
pub(super) fn contact(a: &Surface, b: &Surface) -> Option<Surface> {
    of_plane(a, b)
        .or_else(|| of_plane(b, a))
        .or_else(|| of_cylinders(a, b))
        .or_else(|| about_one_axis(a, b))
        .or_else(|| about_one_axis(b, a))
        .or_else(|| touching_tubes(a, b).or_else(|| touching_tubes(b, a)).map(|(point, normal)| Surface::Plane { point, normal }))
}

/// Of a plane and a cylinder, the plane through the axis; of a plane and a torus that lies on it, the cylinder about its axis.
fn of_plane(plane: &Surface, round: &Surface) -> Option<Surface> {
    let Surface::Plane { normal, .. } = plane else { return None };
    match round {
        Surface::Cylinder { point, axis, radius_mm } => {
            let touches = normal.dot(axis).abs() < SAME && (plane.distance_mm(point).abs() - radius_mm).abs() < SAME;
            touches.then(|| Surface::Plane { point: *point, normal: Unit::new_normalize(axis.cross(normal)) })
        }
        Surface::Torus { centre, axis, radius_mm, minor_radius_mm } => {
            let touches = normal.cross(axis).norm() < SAME && (plane.distance_mm(centre).abs() - minor_radius_mm).abs() < SAME;
            touches.then_some(Surface::Cylinder { point: *centre, axis: *axis, radius_mm: *radius_mm })
        }
        _ => None,
    }
}

/// The plane through both axes.
fn of_cylinders(one: &Surface, other: &Surface) -> Option<Surface> {
    let (Surface::Cylinder { point, axis, radius_mm }, Surface::Cylinder { point: p, axis: a, radius_mm: r }) = (one, other) else {
        return None;
    };
    let arm = across(axis, &(p - point));
    let apart = [radius_mm + r, (radius_mm - r).abs()].map(|touching_mm| (arm.norm() - touching_mm).abs());
    let touches = axis.cross(a).norm() < SAME && arm.norm() > SAME && apart.iter().any(|off| *off < SAME);
    touches.then(|| Surface::Plane { point: *point, normal: Unit::new_normalize(axis.cross(&arm)) })
}

/// Of a cylinder and a torus or a sphere about its axis that goes over into it, the plane of their circle.
fn about_one_axis(cylinder: &Surface, round: &Surface) -> Option<Surface> {
    let Surface::Cylinder { point, axis, radius_mm } = cylinder else { return None };
    let is_on_axis = |centre: &Point3<f64>| across(axis, &(centre - point)).norm() < SAME;
    let (centre, touches) = match round {
        Surface::Torus { centre, axis: about, radius_mm: middle_mm, minor_radius_mm } => {
            let reaches = [middle_mm + minor_radius_mm, middle_mm - minor_radius_mm];
            (centre, axis.cross(about).norm() < SAME && reaches.iter().any(|reach| (reach - radius_mm).abs() < SAME))
        }
        Surface::Sphere { centre, radius_mm: reach, .. } => (centre, (reach - radius_mm).abs() < SAME),
        _ => return None,
    };
    (touches && is_on_axis(centre)).then_some(Surface::Plane { point: *centre, normal: *axis })
}

/// Centre and axis of the circle in which a torus goes over into a cylinder that continues its tube, or into a torus beside it with a tube of
/// the same radius.
pub(super) fn touching_tubes(torus: &Surface, other: &Surface) -> Option<(Point3<f64>, Unit<Vector3<f64>>)> {
    let Surface::Torus { centre, axis, radius_mm, minor_radius_mm } = torus else { return None };
    match other {
        Surface::Cylinder { point, axis: along, radius_mm: tube_mm } => {
            let arm = across(along, &(point - centre));
            let is_beside = (arm.norm() - radius_mm).abs() < SAME && arm.dot(axis).abs() < SAME;
            let continues = is_beside && along.dot(axis).abs() < SAME && (tube_mm - minor_radius_mm).abs() < SAME;
            continues.then_some((centre + arm, *along))
        }
        Surface::Torus { centre: c, axis: a, radius_mm: r, minor_radius_mm: tube_mm } => {
            let towards = Unit::try_new(c - centre, SAME)?;
            let apart_mm = (c - centre).norm();
            let is_beside = axis.cross(a).norm() < SAME && towards.dot(axis).abs() < SAME && (apart_mm - radius_mm - r).abs() < SAME;
            let touches = is_beside && (tube_mm - minor_radius_mm).abs() < SAME;
            touches.then(|| (centre + towards.into_inner() * *radius_mm, Unit::new_normalize(axis.cross(&towards))))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn torus(x: f64, radius_mm: f64) -> Surface {
        Surface::Torus { centre: Point3::new(x, 0.0, 1.0), axis: Vector3::z_axis(), radius_mm, minor_radius_mm: 1.0 }
    }

    fn cylinder(x: f64, axis: Unit<Vector3<f64>>, radius_mm: f64) -> Surface {
        Surface::Cylinder { point: Point3::new(x, 5.0, 1.0), axis, radius_mm }
    }

    fn about_z(radius_mm: f64) -> Surface {
        Surface::Cylinder { point: Point3::origin(), axis: Vector3::z_axis(), radius_mm }
    }

    #[test]
    fn analytic_contacts_lie_where_surfaces_touch() {
        let bed = Surface::Plane { point: Point3::origin(), normal: Vector3::z_axis() };
        let along = cylinder(4.0, Vector3::y_axis(), 1.0);
        let cases = [
            (bed.clone(), along.clone(), [4.0, 7.0, 0.0]),
            (bed, torus(0.0, 4.0), [0.0, 4.0, 0.0]),
            (torus(0.0, 4.0), along.clone(), [5.0, 0.0, 1.0]),
            (torus(0.0, 4.0), torus(7.0, 3.0), [4.0, 0.0, 0.0]),
            (along, cylinder(7.0, Vector3::y_axis(), 2.0), [5.0, 3.0, 1.0]),
            (torus(0.0, 4.0), about_z(5.0), [0.0, 5.0, 1.0]),
            (torus(0.0, 4.0), about_z(3.0), [3.0, 0.0, 1.0]),
            (
                about_z(2.0),
                Surface::Sphere { centre: Point3::new(0.0, 0.0, 3.0), axis: Vector3::x_axis(), radius_mm: 2.0 },
                [2.0, 0.0, 3.0],
            ),
        ];
        for (one, other, at) in cases {
            for found in [contact(&one, &other), contact(&other, &one)] {
                let found = found.expect("they touch");
                for surface in [&found, &one, &other] {
                    assert!(surface.distance_mm(&Point3::from(at)).abs() < 1e-9, "{surface:?} beside {at:?}");
                }
                let normals = [&found, &one].map(|surface| surface.normal_at(&Point3::from(at)));
                assert!(normals[0].dot(&normals[1]).abs() < 1e-9, "it crosses both");
            }
        }
    }

    #[test]
    fn analytic_what_crosses_or_is_apart_has_no_contact() {
        assert_eq!(contact(&torus(0.0, 4.0), &torus(7.0, 2.9)), None);
        assert_eq!(contact(&torus(0.0, 4.0), &about_z(4.0)), None);
        assert_eq!(contact(&cylinder(0.0, Vector3::y_axis(), 2.0), &cylinder(3.0, Vector3::y_axis(), 2.0)), None);
        assert_eq!(contact(&cylinder(0.0, Vector3::y_axis(), 2.0), &cylinder(4.0, Vector3::z_axis(), 2.0)), None);
    }
}
