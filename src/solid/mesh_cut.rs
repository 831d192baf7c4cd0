//! Cutting the facets of a mesh along planes: the surface stays, it only gets more corners.

use std::collections::BTreeMap;

use nalgebra::{Point3, Vector3};

use super::mesh::Mesh;

/// A corner this near the plane lies on it, mm.
const ON_PLANE_MM: f64 = 1e-4;

impl Mesh {
    /// The same surface with every facet cut where the plane crosses it; neighbours stay joined.
    pub fn cut_along(&self, point: &Point3<f64>, normal: &Vector3<f64>) -> Self {
        let height = |i: u32| {
            let v = self.vertices[i as usize].map(f64::from);
            let h = (Point3::from(v) - point).dot(normal);
            if h.abs() < ON_PLANE_MM { 0.0 } else { h }
        };
        let heights: Vec<f64> = (0..self.vertices.len() as u32).map(height).collect();
        let mut cut = Self { vertices: self.vertices.clone(), triangles: Vec::with_capacity(self.triangles.len()) };
        let mut crossings: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        for triangle in &self.triangles {
            cut.add_cut(triangle, &heights, &mut crossings);
        }
        cut
    }

    fn add_cut(&mut self, triangle: &[u32; 3], heights: &[f64], crossings: &mut BTreeMap<[u32; 2], u32>) {
        let side = |i: u32| heights[i as usize];
        let crosses = |a: u32, b: u32| side(a) * side(b) < 0.0;
        // Walk round the facet; each side of the plane gets its own outline.
        let (mut above, mut below): (Vec<u32>, Vec<u32>) = (Vec::new(), Vec::new());
        for k in 0..3 {
            let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
            if side(a) >= 0.0 {
                above.push(a);
            }
            if side(a) <= 0.0 {
                below.push(a);
            }
            if crosses(a, b) {
                let key = [a.min(b), a.max(b)];
                let middle = *crossings.entry(key).or_insert_with(|| {
                    let [p, q] = key.map(|i| self.vertices[i as usize].map(f64::from));
                    let [hp, hq] = key.map(side);
                    let t = hp / (hp - hq);
                    self.vertices.push([0, 1, 2].map(|i| (p[i] + t * (q[i] - p[i])) as f32));
                    self.vertices.len() as u32 - 1
                });
                above.push(middle);
                below.push(middle);
            }
        }
        for outline in [above, below] {
            let flat = outline.iter().all(|&i| heights.get(i as usize).is_some_and(|h| *h == 0.0));
            if outline.len() < 3 || (flat && heights_differ(triangle, heights)) {
                continue;
            }
            self.triangles.extend((1..outline.len() - 1).map(|i| [outline[0], outline[i], outline[i + 1]]));
            if !heights_differ(triangle, heights) {
                break; // lies in the plane: on both sides, drawn once
            }
        }
    }
}

fn heights_differ(triangle: &[u32; 3], heights: &[f64]) -> bool {
    triangle.iter().any(|&i| heights[i as usize] != 0.0)
}
