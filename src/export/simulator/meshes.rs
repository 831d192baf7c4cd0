//! Convex shapes as Wavefront OBJ, m: the one form of mesh that the readers of URDF and SDF share.

use std::fmt::Write;

use super::convex_shape::ConvexShape;
use super::figures::numbers;

/// A shape as text.
pub(super) fn obj(shape: &ConvexShape) -> String {
    let mut text = format!("# {}: convex, m, x front, y left, z up\n", shape.name);
    for vertex in &shape.vertices_m {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "v {}", numbers(*vertex));
    }
    for [a, b, c] in &shape.triangles {
        let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_corners_are_counted_from_one() {
        let shape =
            ConvexShape { name: "toy".into(), file: "toy.obj".into(), vertices_m: vec![[0.0, 0.5, -1.0]], triangles: vec![[0, 0, 0]] };
        assert_eq!(obj(&shape), "# toy: convex, m, x front, y left, z up\nv 0 0.5 -1\nf 1 1 1\n");
    }
}
