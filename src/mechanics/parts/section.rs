//! A section: area, centre, second moments, torsion constant, from the outline that a cut through a mesh shows.

use nalgebra::{Matrix3, Point3, Vector3};

use super::warping::Warping;
use crate::mechanics::element::beam::Rigidity;
use crate::solid::{CutPlane, Mesh, Piece};

/// A cut with less area is none, mm².
const LEAST_MM2: f64 = 0.05;

/// A section about its centre and principal axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Area, mm².
    pub area_mm2: f64,
    /// Centre, in the space of what was cut, mm.
    pub centre: Vector3<f64>,
    /// x along the beam, y and z the principal axes, as columns.
    pub axes: Matrix3<f64>,
    /// Second moments of area about y and z, mm⁴.
    pub second_mm4: [f64; 2],
    /// Torsion constant (Saint-Venant), mm⁴.
    pub torsion_mm4: f64,
    /// Farthest fibre along y and z, mm.
    pub reach_mm: [f64; 2],
    /// Share of the area that works in shear along y, and along z.
    pub shear_shares: [f64; 2],
}

/// An isotropic elastic material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elastic {
    /// Young's modulus, MPa.
    pub young_mpa: f64,
    /// Shear modulus, MPa.
    pub shear_mpa: f64,
}

impl Section {
    /// The section of a mesh where a plane cuts it.
    pub fn cut(mesh: &Mesh, plane: &CutPlane) -> Option<Self> {
        Self::of(&mesh.cut(plane), plane)
    }

    /// The section within an outline.
    pub fn of(pieces: &[Piece], plane: &CutPlane) -> Option<Self> {
        let (area, centre, [uu, vv, uv]) = moments(pieces);
        if area < LEAST_MM2 {
            return None;
        }
        // Principal axes: y has the larger second moment of distance along it, so that bending about z is the stiffer one.
        let angle = if (uu - vv).abs() + uv.abs() < 1e-9 * (uu + vv) { 0.0 } else { 0.5 * libm::atan2(2.0 * uv, uu - vv) };
        let (c, s) = (libm::cos(angle), libm::sin(angle));
        let [first, second] = plane.axes;
        let (y, z) = (first * c + second * s, second * c - first * s);
        let along_y = uu * c * c + vv * s * s + 2.0 * uv * c * s;
        let along_z = uu + vv - along_y;
        let turned = |p: [f64; 2]| {
            let (du, dv) = (p[0] - centre[0], p[1] - centre[1]);
            [du * c + dv * s, dv * c - du * s]
        };
        let own: Vec<Piece> = pieces.iter().map(|ends| ends.map(turned)).collect();
        let reach = |at: usize| own.iter().flatten().map(|p| p[at].abs()).fold(0.0, f64::max);
        let Warping { torsion_mm4, shear_shares } = Warping::of(&own);
        Some(Self {
            area_mm2: area,
            centre: plane.point(centre).coords,
            axes: Matrix3::from_columns(&[y.cross(&z), y, z]),
            second_mm4: [along_z, along_y],
            torsion_mm4,
            reach_mm: [reach(0), reach(1)],
            shear_shares,
        })
    }

    /// A disc.
    pub fn disc(radius_mm: f64, centre: Vector3<f64>, axes: Matrix3<f64>) -> Self {
        Self::ring(radius_mm, 0.0, centre, axes)
    }

    /// A disc with a round hole in its middle.
    pub fn ring(radius_mm: f64, inner_radius_mm: f64, centre: Vector3<f64>, axes: Matrix3<f64>) -> Self {
        let [outer, inner] = [radius_mm, inner_radius_mm].map(|radius| radius * radius);
        let area = std::f64::consts::PI * (outer - inner);
        let second = area * (outer + inner) / 4.0;
        Self {
            area_mm2: area,
            centre,
            axes,
            second_mm4: [second; 2],
            torsion_mm4: 2.0 * second,
            reach_mm: [radius_mm; 2],
            shear_shares: [ring_shear_share(inner_radius_mm / radius_mm); 2],
        }
    }

    /// The section's stiffness in a material.
    pub fn rigidity(&self, material: &Elastic) -> Rigidity {
        Rigidity {
            axial_n: material.young_mpa * self.area_mm2,
            shear_n: self.shear_shares.map(|share| material.shear_mpa * self.area_mm2 * share),
            torsion_n_mm2: material.shear_mpa * self.torsion_mm4,
            bending_n_mm2: self.second_mm4.map(|i| material.young_mpa * i),
        }
    }

    /// The same, moved.
    #[must_use]
    pub fn moved(&self, motion: &nalgebra::Isometry3<f64>) -> Self {
        let turn = motion.rotation.to_rotation_matrix();
        let centre = (motion * Point3::from(self.centre)).coords;
        Self { centre, axes: turn.matrix() * self.axes, ..self.clone() }
    }
}

/// Area, centre, and second moments about it (u², v², u v) within an outline: Green's theorem.
fn moments(pieces: &[Piece]) -> (f64, [f64; 2], [f64; 3]) {
    let (mut area, mut first, mut second) = (0.0, [0.0; 2], [0.0; 3]);
    for [a, b] in pieces {
        let cross = a[0] * b[1] - a[1] * b[0];
        area += cross / 2.0;
        for i in 0..2 {
            first[i] += (a[i] + b[i]) * cross / 6.0;
            second[i] += (a[i] * a[i] + a[i] * b[i] + b[i] * b[i]) * cross / 12.0;
        }
        second[2] += (a[0] * b[1] + 2.0 * a[0] * a[1] + 2.0 * b[0] * b[1] + b[0] * a[1]) * cross / 24.0;
    }
    let centre = if area > 0.0 { first.map(|f| f / area) } else { [0.0; 2] };
    let [u, v] = centre;
    (area, centre, [second[0] - area * u * u, second[1] - area * v * v, second[2] - area * u * v])
}

/// Share of the area of a ring that works in shear, by the ratio of its radii: G. R. Cowper (J. Appl. Mech. 33 (1966) 335) without Poisson's ratio, as
/// for sections that are cut.
fn ring_shear_share(inner_over_outer: f64) -> f64 {
    let m = inner_over_outer * inner_over_outer;
    let m1 = (1.0 + m) * (1.0 + m);
    6.0 * m1 / (7.0 * m1 + 20.0 * m)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::{Feature, MeshSolid};

    #[test]
    fn analytic_a_turned_bar_shows_its_rectangle() {
        let bar = MeshSolid::build(&Feature::cuboid_between([2.0, -1.0, -9.0], [8.0, 1.0, 9.0])).to_mesh();
        let up = Vector3::new(0.6, 0.8, 0.0);
        let plane = CutPlane::across(Point3::new(1.0, 1.0, 0.5), &Vector3::z(), &up).expect("is a plane");
        let section = Section::cut(&bar, &plane).expect("is cut");
        assert!((section.area_mm2 - 12.0).abs() < 1e-9);
        assert!((section.centre - Vector3::new(5.0, 0.0, 0.5)).norm() < 1e-9, "{}", section.centre);
        // y is the long side: bending about z moves it, 2 * 6³ / 12.
        assert!((section.second_mm4[1] - 36.0).abs() < 1e-9 && (section.second_mm4[0] - 4.0).abs() < 1e-9);
        assert!((section.reach_mm[0] - 3.0).abs() < 1e-9 && (section.reach_mm[1] - 1.0).abs() < 1e-9);
        assert!((section.axes.column(1).x.abs() - 1.0).abs() < 1e-9, "{}", section.axes);
        assert!((section.axes.determinant() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn analytic_shear_shares_of_a_disc_and_a_thin_ring() {
        assert!((ring_shear_share(0.0) - 6.0 / 7.0).abs() < 1e-12 && (ring_shear_share(0.999) - 0.5).abs() < 1e-3);
    }
}
