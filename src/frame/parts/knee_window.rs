//! The knee's window: a slot for the fork's bar whose rims are rounded on both sides.

use nalgebra::Vector3;

use super::place::along_y;
use crate::solid::{Contour, Feature};
use crate::units::Angle;

/// The window.
#[derive(Clone, Debug, PartialEq)]
pub struct KneeWindow {
    /// From the knee's node to the window's centre, outward, mm.
    pub centre_mm: f64,
    /// Size along the frame's diagonal, mm.
    pub size_x_mm: f64,
    /// Height, mm.
    pub size_z_mm: f64,
    /// Rounding of its corners, mm.
    pub round_mm: f64,
    /// Radius of its rims, mm.
    pub flare_mm: f64,
}

/// A rim grows on one wall of the window only; the other side of its cutter stays inside the window.
#[derive(Clone, Copy, PartialEq)]
enum Wall {
    Rib,
    Plate,
}

impl KneeWindow {
    /// Inner wall, mm from the node.
    pub fn back_mm(&self) -> f64 {
        self.centre_mm - 0.5 * self.size_x_mm
    }

    /// Outer wall, mm from the node.
    pub fn front_mm(&self) -> f64 {
        self.centre_mm + 0.5 * self.size_x_mm
    }

    /// Half of the height, mm.
    pub fn half_z_mm(&self) -> f64 {
        0.5 * self.size_z_mm
    }

    /// Slot and rims. The rib's sides are at ± `half_width_mm`; the plate is wider.
    pub fn cutters(&self, half_width_mm: f64, plate_width_mm: f64) -> Vec<Feature> {
        let fl = self.flare_mm;
        let along = |angle: Angle| half_width_mm - fl + fl * angle.sin();
        let growth = |angle: Angle| fl * (1.0 - angle.cos());
        let on_arc = |degrees: &f64| (along(Angle::deg(*degrees)), growth(Angle::deg(*degrees)));
        // Towards the plate the rim goes on at 45° until just under the plate's face.
        let rib: Vec<_> = [4.0, 25.0, 45.0, 65.0, 82.0].iter().map(on_arc).collect();
        let mut plate: Vec<_> = [6.0, 28.0, 45.0].iter().map(on_arc).collect();
        let (last, end) = (plate[plate.len() - 1], 0.9 * fl);
        plate.push((last.0 + end - last.1, end));
        let reach = 2.0 * plate_width_mm;
        let slot = self.section([0.0, 0.0, 0.0], 0.95 * self.round_mm);
        let mut cutters = vec![along_y(slot, -reach, reach)];
        for (points, wall) in [(rib, Wall::Rib), (plate, Wall::Plate)] {
            for (step, ends) in points.windows(2).enumerate() {
                let frustum = self.frustum(ends[0], ends[1], wall, step, plate_width_mm);
                cutters.extend([frustum.clone().mirrored(Vector3::y()), frustum]);
            }
        }
        cutters
    }

    /// One chord of the rim: it starts inside the slot, and goes on at its last size beyond the chord.
    /// Neighbouring chords get slightly different corners, so that no edge of one runs into an edge of another.
    fn frustum(&self, from: (f64, f64), to: (f64, f64), wall: Wall, step: usize, length_mm: f64) -> Feature {
        let slope = (to.1 - from.1) / (to.0 - from.0);
        let odd = (step % 2) as f64;
        let inside = -0.15 * self.size_x_mm;
        let slab = |y: f64, thick: f64, grown: f64| {
            let (towards_rib, towards_plate, up) = match wall {
                Wall::Rib => (grown, inside, grown - 0.006 * (1.0 + odd)),
                Wall::Plate => (inside, grown, grown - 0.08 - 0.03 * odd),
            };
            let round = ((self.round_mm + up) * (1.0 - 0.03 * odd)).max(0.1);
            along_y(self.section([towards_rib, towards_plate, up], round), y, y + thick)
        };
        let back = (0.3 * self.size_x_mm).min(0.8 * self.round_mm) / slope;
        let past = 0.03;
        Feature::hull([slab(from.0 - back, 1e-3, from.1 - slope * back), slab(to.0 + past, length_mm, to.1 + slope * past)])
    }

    /// The slot's outline in (z, x), grown towards rib, plate, and up and down, mm.
    fn section(&self, grown: [f64; 3], round_mm: f64) -> Contour {
        let (x0, x1) = (self.back_mm() - grown[0], self.front_mm() + grown[1]);
        let size = [self.size_z_mm + 2.0 * grown[2], x1 - x0];
        Contour::rounded_rectangle([0.0, 0.5 * (x0 + x1)], size, round_mm)
    }
}
