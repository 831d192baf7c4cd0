//! Go and no-go gauges for the parts' tests: what a dimension must let through, and what it must stop.

use nalgebra::Point3;

use crate::frame::skeleton::centre::Centre;
use crate::params::Frame;
use crate::solid::{Feature, MeshSolid, gate};

/// Tolerance of a functional dimension, mm.
const TOLERANCE_MM: f64 = 0.05;

/// The measured frame and its centre.
pub(in crate::frame) fn v8() -> (Frame, Centre) {
    let frame = Frame::load("cognifly-v8").unwrap_or_else(|error| panic!("{error:?}")).0;
    let centre = Centre::new(&frame);
    (frame, centre)
}

/// A part's solid, gauged.
pub(in crate::frame) struct Gauged(pub(in crate::frame) MeshSolid);

impl Gauged {
    pub(in crate::frame) fn new(feature: &Feature) -> Self {
        Self(MeshSolid::build(feature))
    }

    fn lets_through(&self, gauge: &Feature) -> bool {
        self.0.intersection(&MeshSolid::build(gauge)).volume_mm3() < 1e-7
    }

    /// A round hole between two points has this diameter there.
    pub(in crate::frame) fn hole(&self, from: [f64; 3], to: [f64; 3], diameter_mm: f64) {
        let pin = |d: f64| Feature::cylinder_between(Point3::from(from), Point3::from(to), 0.5 * d);
        assert!(self.lets_through(&pin(diameter_mm - TOLERANCE_MM)), "the hole at {from:?} stops {diameter_mm} - 0.05 mm");
        assert!(!self.lets_through(&pin(diameter_mm + TOLERANCE_MM)), "the hole at {from:?} lets {diameter_mm} + 0.05 mm through");
    }

    /// A box of free space, each of whose named walls (`x` low, `X` high, …) is where it should be.
    pub(in crate::frame) fn pocket(&self, low: [f64; 3], high: [f64; 3], walls: &str) {
        let t = 0.5 * TOLERANCE_MM;
        let (go_low, go_high) = (low.map(|c| c + t), high.map(|c| c - t));
        assert!(self.lets_through(&Feature::cuboid_between(go_low, go_high)), "the pocket {low:?} to {high:?} is too small");
        for wall in walls.chars() {
            let axis = "xyz".find(wall.to_ascii_lowercase()).unwrap_or_else(|| panic!("no axis {wall}"));
            let (mut no_go_low, mut no_go_high) = (go_low, go_high);
            if wall.is_lowercase() {
                no_go_low[axis] = low[axis] - t;
            } else {
                no_go_high[axis] = high[axis] + t;
            }
            let stopped = !self.lets_through(&Feature::cuboid_between(no_go_low, no_go_high));
            assert!(stopped, "the pocket {low:?} to {high:?} has no wall {wall} there");
        }
    }

    /// The written mesh passes the gate with this many tunnels, has the size of the real part within 0.05 mm and
    /// its volume within the given percentage.
    pub(in crate::frame) fn like_the_real_one(&self, size_mm: [f64; 3], volume_mm3: f64, percent: f64, tunnels: i64) {
        let mesh = self.0.to_mesh();
        assert_eq!(gate::pass(&mesh).map(|seen| seen.euler), Ok(2 - 2 * tunnels));
        for (ours, real) in mesh.size_mm().into_iter().zip(size_mm) {
            assert!((ours - real).abs() < TOLERANCE_MM, "{:?} instead of {size_mm:?}", mesh.size_mm());
        }
        let off = 100.0 * (mesh.volume_mm3() / volume_mm3 - 1.0);
        assert!(off.abs() < percent, "{off:.2} % off the real volume");
    }
}
