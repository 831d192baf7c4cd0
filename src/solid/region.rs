//! Plane figures with holes: cuts of solids, and what follows from them.

use manifold_rust::cross_section::CrossSection;
use manifold_rust::linalg::Vec2;
use manifold_rust::types::{Polygons, Rect};

/// Straight pieces that a full turn is drawn with where a corner is rounded: at a radius of 0.2 mm 4 µm are lost.
const ROUND_SEGMENTS: i32 = 16;

/// A plane figure, mm; nothing of it covers itself.
#[derive(Clone)]
pub struct Region(CrossSection);

impl Region {
    /// From contours, outer ones counter-clockwise and holes clockwise; what they cover twice counts once.
    pub fn new(contours: &[Vec<[f64; 2]>]) -> Self {
        Self(CrossSection::new(contours.iter().map(|c| c.iter().map(|p| Vec2::new(p[0], p[1])).collect()).collect()))
    }

    pub(super) fn of(section: CrossSection) -> Self {
        Self(section)
    }

    /// Its contours: outer ones counter-clockwise, holes clockwise.
    pub fn contours(&self) -> Vec<Vec<[f64; 2]>> {
        self.0.to_polygons().iter().map(|c| c.iter().map(|p| [p.x, p.y]).collect()).collect()
    }

    pub(super) fn polygons(&self) -> Polygons {
        self.0.to_polygons()
    }

    /// Nothing in it.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Area, mm².
    pub fn area_mm2(&self) -> f64 {
        self.0.area()
    }

    /// Lowest and highest corner of the box around it, mm.
    pub fn bounds_mm(&self) -> [[f64; 2]; 2] {
        let bounds = self.0.bounds();
        [[bounds.min.x, bounds.min.y], [bounds.max.x, bounds.max.y]]
    }

    /// Middle of the area, mm; of nothing the origin.
    pub fn middle_mm(&self) -> [f64; 2] {
        let (mut twice_area, mut sum) = (0.0, [0.0; 2]);
        for contour in self.contours() {
            for (i, a) in contour.iter().enumerate() {
                let b = contour[(i + 1) % contour.len()];
                let cross = a[0] * b[1] - b[0] * a[1];
                twice_area += cross;
                sum = [0, 1].map(|k| sum[k] + cross * (a[k] + b[k]));
            }
        }
        if twice_area == 0.0 { [0.0; 2] } else { sum.map(|s| s / (3.0 * twice_area)) }
    }

    /// Both together.
    pub fn union(&self, other: &Self) -> Self {
        Self(self.0.union(&other.0))
    }

    /// This without the other.
    pub fn minus(&self, other: &Self) -> Self {
        Self(self.0.difference(&other.0))
    }

    /// What both share.
    pub fn intersection(&self, other: &Self) -> Self {
        Self(self.0.intersection(&other.0))
    }

    /// Every point within this distance, mm; with a negative one what lies that far inside.
    pub fn grown(&self, by_mm: f64) -> Self {
        Self(self.0.offset_with_params(by_mm, ROUND_JOIN, 2.0, ROUND_SEGMENTS))
    }

    /// The same without corners nearer than this to the line between their neighbours, mm.
    pub fn simplified(&self, within_mm: f64) -> Self {
        Self(self.0.simplify(within_mm))
    }

    /// Its separate pieces.
    pub fn bodies(&self) -> Vec<Self> {
        if self.is_empty() { Vec::new() } else { self.0.decompose().into_iter().map(Self).collect() }
    }

    /// The smallest convex figure around it.
    pub fn hull(&self) -> Self {
        Self(CrossSection::hull_cross_sections(std::slice::from_ref(&self.0)))
    }

    /// The rectangle between two corners, grown to all sides, mm.
    pub fn rectangle([low, high]: [[f64; 2]; 2], grown_mm: f64) -> Self {
        let [low, high] = [low.map(|c| c - grown_mm), high.map(|c| c + grown_mm)];
        Self(CrossSection::from_rect(&Rect { min: Vec2::new(low[0], low[1]), max: Vec2::new(high[0], high[1]) }))
    }

    /// What of it lies in a box, grown to all sides, mm.
    pub fn within(&self, [low, high]: [[f64; 2]; 2], grown_mm: f64) -> Self {
        self.intersection(&Self::rectangle([low, high], grown_mm))
    }

    /// Whether the boxes around both meet.
    pub fn may_meet(&self, other: &Self) -> bool {
        let ([low, high], [other_low, other_high]) = (self.bounds_mm(), other.bounds_mm());
        (0..2).all(|axis| low[axis] <= other_high[axis] && other_low[axis] <= high[axis])
    }

    /// Whether a point lies in it.
    pub fn contains(&self, [x, y]: [f64; 2]) -> bool {
        // Counted over all contours: a hole's border takes away what its outline gives.
        let crossings = |contour: &Vec<[f64; 2]>| {
            let edges = contour.iter().enumerate().map(|(i, a)| (a, contour[(i + 1) % contour.len()]));
            edges.filter(|(a, b)| (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])).count()
        };
        self.contours().iter().map(crossings).sum::<usize>() % 2 == 1
    }
}

/// Code of the kernel for rounded corners.
const ROUND_JOIN: i32 = 1;

#[cfg(test)]
mod tests {
    use super::*;

    fn square(low: f64, high: f64) -> Region {
        Region::new(&[vec![[low, low], [high, low], [high, high], [low, high]]])
    }

    #[test]
    fn analytic_a_square_ring() {
        let ring = square(0.0, 4.0).minus(&square(1.0, 2.0));
        assert!((ring.area_mm2() - 15.0).abs() < 1e-9 && ring.bodies().len() == 1);
        assert!(ring.contains([0.5, 0.5]) && !ring.contains([1.5, 1.5]) && !ring.contains([4.5, 1.0]));
        // 16 at (2, 2) less 1 at (1.5, 1.5).
        assert!(ring.middle_mm().iter().all(|c| (c - (32.0 - 1.5) / 15.0).abs() < 1e-9), "{:?}", ring.middle_mm());
        assert!((ring.drawn_up(1.0, 3.0).volume_mm3() - 30.0).abs() < 1e-9);
        assert!((ring.hull().area_mm2() - 16.0).abs() < 1e-9);
    }

    #[test]
    fn analytic_growing_a_square_rounds_its_corners() {
        let grown = square(0.0, 4.0).grown(0.5);
        let sixteen_gon = 8.0 * libm::sin(std::f64::consts::FRAC_PI_8);
        assert!((grown.area_mm2() - (16.0 + 8.0 + 0.25 * sixteen_gon)).abs() < 1e-3, "{}", grown.area_mm2());
        assert!((square(0.0, 4.0).grown(-1.0).area_mm2() - 4.0).abs() < 1e-6);
        assert!(square(0.0, 4.0).grown(-2.1).is_empty());
    }
}
