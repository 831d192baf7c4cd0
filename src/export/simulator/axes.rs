//! From the design's axes (x right, y front, z up; mm, g) to those of simulators (x front, y left, z up; SI).

use nalgebra::{Matrix3, Point3};

use super::figures::rounded;

/// One millimetre, m.
const MM: f64 = 1e-3;
/// One gram square millimetre, kg m².
const G_MM2: f64 = 1e-9;

/// The turn about z that makes the design's front x: rows are the simulator's axes in the design's.
fn turn() -> Matrix3<f64> {
    Matrix3::new(0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0)
}

/// A point of the design, mm, as one of the simulator, m.
pub(super) fn point_m(mm: Point3<f64>) -> [f64; 3] {
    <[f64; 3]>::from(turn() * mm).map(|value| rounded(value * MM))
}

/// A tensor of inertia in the design's axes, g mm², in the simulator's, kg m²: row by row.
pub(super) fn inertia_kg_m2(g_mm2: &Matrix3<f64>) -> [[f64; 3]; 3] {
    let turned = turn() * g_mm2 * turn().transpose();
    // Halves of the same number differ in the last bit after sums; a tensor is symmetric.
    std::array::from_fn(|row| std::array::from_fn(|column| rounded(turned[(row.min(column), row.max(column))] * G_MM2)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_the_front_is_x_and_the_right_is_minus_y() {
        assert_eq!(point_m(Point3::new(0.0, 1000.0, 0.0)), [1.0, 0.0, 0.0]);
        assert_eq!(point_m(Point3::new(1000.0, 0.0, 0.0)), [0.0, -1.0, 0.0]);
        assert_eq!(point_m(Point3::new(0.0, 0.0, 1000.0)), [0.0, 0.0, 1.0]);
    }

    /// A point mass of 1 g at (2, 3, 5) mm, by its definition, in both axes.
    #[test]
    fn analytic_a_point_mass_has_the_inertia_of_its_turned_place() {
        let tensor = |r: [f64; 3]| {
            let r = nalgebra::Vector3::from(r);
            Matrix3::identity() * r.norm_squared() - r * r.transpose()
        };
        let found = inertia_kg_m2(&tensor([2.0, 3.0, 5.0]));
        let expected = tensor([3.0, -2.0, 5.0]);
        for row in 0..3 {
            for column in 0..3 {
                assert!((found[row][column] - expected[(row, column)] * 1e-9).abs() < 1e-18);
            }
        }
    }
}
