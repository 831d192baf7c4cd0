//! The sleeve: the tube that takes the battery, glued under the bracket, with the tray of the flow sensor where the frame has one.
//!
//! Frame of reference: origin in the middle of the battery's cross section at the rear rim, y front, z up.

use nalgebra::{UnitQuaternion, Vector3};

use super::outline::{Corner, SINK_MM, along_x, along_y, arc, bore, face, mirrored, sharp, upright};
use super::record::{Fold, MaterialClass, PrintedPart, Seat, Wall, WallPlace, always};
use crate::frame::skeleton::centre::Centre;
use crate::params::{Frame, PartName};
use crate::solid::{Contour, Feature, Profile};
use crate::units::Angle;

/// The record of the part.
pub static PART: PrintedPart = PrintedPart {
    name: PartName::BatterySleeve,
    feature: |frame, _, centre| feature(frame, centre),
    material: MaterialClass::Rigid,
    seat: Seat::Centre(Centre::sleeve_pose),
    fold: Fold::Stands,
    print_turn,
    needed: always,
    walls: &[
        Wall { keys: &["sleeve.tray_pad_radius_mm", "sleeve.tray_thickness_mm"], is_at: is_on_tray },
        Wall::anywhere(&["sleeve.sleeve_side_wall_mm", "sleeve.sleeve_top_wall_mm", "sleeve.tray_pad_radius_mm"]),
    ],
};

/// Whether a wall is one of the tray, in front of the tube.
fn is_on_tray(_: &Frame, centre: &Centre, wall: &WallPlace) -> bool {
    wall.at_mm[1] > centre.sleeve_length_mm
}

/// Lugs of a side that are nearer to each other are one, mm.
const LEAST_LUG_GAP_MM: f64 = 1.0;
/// Material left between the tray's window and a hole of the sensor, mm: two lines of a usual nozzle, and a little more.
const WINDOW_RIM_MM: f64 = 1.0;

/// The sleeve of a frame.
pub fn feature(frame: &Frame, centre: &Centre) -> Feature {
    Sleeve { frame, centre }.feature()
}

/// Printed standing on its rear rim, the tray on top.
pub fn print_turn() -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::x_axis(), Angle::deg(90.0).to_rad())
}

struct Sleeve<'a> {
    frame: &'a Frame,
    centre: &'a Centre,
}

impl Sleeve<'_> {
    fn feature(&self) -> Feature {
        let length = self.centre.sleeve_length_mm;
        let tube = along_y(face(&self.outline()), [0.0, length]);
        let mut bodies = vec![tube];
        bodies.extend(self.lugs());
        let mut holes = vec![self.cavity(), self.lead_in()];
        // Without a flow sensor there is nothing that a tray would carry.
        if self.frame.bought.contains_key("flow_sensor") {
            bodies.push(self.tray());
            bodies.extend(self.wedges());
            holes.extend(self.sensor_holes());
        }
        Feature::union(bodies).minus(holes)
    }

    /// Half the width of the channel between the ribs.
    fn channel_mm(&self) -> f64 {
        0.5 * self.centre.bracket_width_mm + self.frame.sleeve.channel_clearance_mm
    }

    fn edge_mm(&self) -> f64 {
        sleeve_edge_mm(self.frame)
    }

    /// Tube and ribs in (x, z).
    fn outline(&self) -> Vec<Corner> {
        let (s, [w, h]) = (&self.frame.sleeve, self.centre.outer_mm);
        let (ci, re) = (self.channel_mm(), self.edge_mm());
        let mut rib = arc([ci + s.rib_width_mm, h], s.rib_height_mm, 0.0, 90.0);
        rib.extend([sharp(ci, h + s.rib_height_mm), sharp(ci, h)]);
        let mut outline = vec![([-w, -h], re), ([w, -h], re), ([w, h], re)];
        outline.extend(rib.iter().copied());
        outline.extend(mirrored(&rib));
        outline.push(([-w, h], re));
        outline
    }

    fn cavity(&self) -> Feature {
        let [w, h] = self.centre.inner_mm;
        along_y(Profile::new(Contour::rectangle([0.0, 0.0], [2.0 * w, 2.0 * h])), [-1.0, self.centre.sleeve_length_mm + 20.0])
    }

    /// A chamfer inside the rear rim that leads the battery in.
    fn lead_in(&self) -> Feature {
        let ([w, h], c) = (self.centre.inner_mm, self.frame.sleeve.sleeve_lead_in_mm.max(0.05));
        // 0.03 mm less at top and bottom: four planes through one corner would be one too many.
        let wide = [w + c + 0.1, h + c + 0.07];
        let rim = Feature::cuboid_between([-wide[0], -0.1, -wide[1]], [wide[0], -0.099, wide[1]]);
        let end = Feature::cuboid_between([0.1 - w, c + 0.1, 0.1 - h], [w - 0.1, c + 0.101, h - 0.1]);
        Feature::hull([rim, end])
    }

    /// Four lugs on the sides; what they hold is unknown in v8, straps fit around them.
    fn lugs(&self) -> Vec<Feature> {
        let (s, [w, h], length) = (&self.frame.sleeve, self.centre.outer_mm, self.centre.sleeve_length_mm);
        let (half, deep) = (0.5 * s.lug_height_mm.min(2.0 * h - 4.0), s.lug_depth_mm);
        let r = (0.66 * deep).min(1.0);
        let at = w + r - 2.0 * SINK_MM;
        let mut lug = vec![sharp(w - 0.4, -half - r)];
        lug.extend(arc([at, -half - r], r, 180.0, 90.0));
        lug.extend([sharp(w + deep, -half), sharp(w + deep, half)]);
        lug.extend(arc([at, half + r], r, 270.0, 180.0));
        lug.push(sharp(w - 0.4, half + r));
        let lug: Vec<Corner> = lug.into_iter().map(|([x, z], r)| ([x, z - s.lug_drop_mm], r)).collect();
        self.lug_spans(length).into_iter().flat_map(|y| [lug.clone(), mirrored(&lug)].map(|corners| along_y(face(&corners), y))).collect()
    }

    /// Where the lugs of a side lie along y; two that would meet are one.
    fn lug_spans(&self, length: f64) -> Vec<[f64; 2]> {
        let s = &self.frame.sleeve;
        let span = |y: f64| [y - 0.5 * s.lug_width_mm, y + 0.5 * s.lug_width_mm];
        let (rear, front) = (span(s.lug_rear_mm), span(length - s.lug_front_mm));
        let apart = (front[0] - rear[1]).max(rear[0] - front[1]);
        if apart > LEAST_LUG_GAP_MM { vec![rear, front] } else { vec![[rear[0].min(front[0]), rear[1].max(front[1])]] }
    }

    /// Lower and upper face of the tray.
    fn tray_z_mm(&self) -> [f64; 2] {
        let top = self.centre.outer_mm[1] + self.frame.sleeve.tray_lift_mm;
        [top - self.frame.sleeve.tray_thickness_mm, top]
    }

    /// Where the sensor's holes are, in front of the rear rim.
    fn sensor_y_mm(&self) -> f64 {
        self.centre.sleeve_length_mm + self.frame.sleeve.sensor_reach_mm
    }

    /// A plate around a window; its two wings lie on the sleeve beside the channel.
    fn tray(&self) -> Feature {
        let (s, length, yh) = (&self.frame.sleeve, self.centre.sleeve_length_mm, self.sensor_y_mm());
        let (hole, pad, wing, ci) = (0.5 * s.sensor_hole_pitch_mm, s.tray_pad_radius_mm, self.wing_mm(), self.channel_mm());
        let front = yh + 0.5 * s.tray_bar_mm;
        let (rear, rim) = (length - s.tray_overlap_mm, length + 2.0 * SINK_MM);
        let window = (self.centre.outer_mm[0] - s.tray_window_side_mm).max(ci + 2.5);
        // Where the window is as wide as the holes are apart, it ends before them.
        let around = 0.5 * s.sensor_hole_diameter_mm + WINDOW_RIM_MM;
        let behind = if window > hole - around { (front - s.tray_bar_mm).min(yh - around) } else { front - s.tray_bar_mm };
        let side = (self.centre.outer_mm[0] - 2.0 * SINK_MM).max(window + 2.5);
        let right = vec![
            sharp(wing, rear),
            sharp(side, rear),
            sharp(side, length + 3.0),
            sharp(hole + pad, yh),
            ([hole + pad, yh + pad], pad - 0.05),
            sharp(hole - 0.8, yh + pad),
            sharp(hole - 5.0, front),
        ];
        let round = (window - wing - 0.2).clamp(0.3, 2.9);
        let mut outline = right.clone();
        outline.extend(mirrored(&right));
        outline.extend([sharp(-wing, rim), ([-window, rim], round), ([-window, behind], 1.25)]);
        outline.extend([([window, behind], 1.25), ([window, rim], round), sharp(wing, rim)]);
        upright(face(&outline), self.tray_z_mm())
    }

    /// Where the tray's wings begin, inside the ribs.
    fn wing_mm(&self) -> f64 {
        self.channel_mm() + 0.3
    }

    /// The rise from the sleeve's top to the wings.
    fn wedges(&self) -> [Feature; 2] {
        let [w, h] = self.centre.outer_mm;
        let rear = self.centre.sleeve_length_mm - self.frame.sleeve.tray_overlap_mm;
        let top = self.tray_z_mm()[1] - 2.0 * SINK_MM;
        let profile =
            face(&[sharp(rear + 0.1, h - 0.3), sharp(rear + 0.1, top), sharp(rear - 1.6, h - 2.0 * SINK_MM), sharp(rear - 1.6, h - 0.3)]);
        let x = [self.wing_mm() + 0.2, w - self.edge_mm() - 0.2];
        [along_x(profile.clone(), x), along_x(profile, [-x[1], -x[0]])]
    }

    fn sensor_holes(&self) -> [Feature; 2] {
        let (s, [low, high]) = (&self.frame.sleeve, self.tray_z_mm());
        [0.5, -0.5].map(|side| bore(side * s.sensor_hole_pitch_mm, self.sensor_y_mm(), s.sensor_hole_diameter_mm, [low - 1.0, high + 1.0]))
    }
}

/// Rounding of the sleeve's long edges, mm: less than its walls, or nothing would be left of them there.
pub(super) fn sleeve_edge_mm(frame: &Frame) -> f64 {
    frame.sleeve.sleeve_edge_radius_mm.min(0.97 * frame.sleeve.sleeve_side_wall_mm)
}

#[cfg(test)]
mod tests {
    use super::super::gauges::{Gauged, v8};
    use super::*;

    fn sleeve() -> Gauged {
        let (frame, centre) = v8();
        Gauged::new(&feature(&frame, &centre))
    }

    #[test]
    fn measured_sleeve_is_like_the_real_one() {
        sleeve().like_the_real_one([37.0, 58.5, 20.5], 6849.5, 2.0, 4);
    }

    #[test]
    fn measured_battery_and_bracket_fit() {
        let sleeve = sleeve();
        sleeve.pocket([-16.0, 1.0, -8.1], [16.0, 46.0, 8.1], "xXzZ");
        sleeve.pocket([-6.705, -1.0, 9.5], [6.705, 46.0, 12.0], "xXz");
    }

    #[test]
    fn measured_sensor_holes_have_their_pitch() {
        for x in [15.25, -15.25] {
            sleeve().hole([x, 55.75, 8.0], [x, 55.75, 11.0], 3.0);
        }
    }

    #[test]
    fn analytic_sleeve_without_a_sensor_has_no_tray() {
        let (mut frame, centre) = v8();
        let long = |frame: &Frame| Gauged::new(&feature(frame, &centre)).0.to_mesh().size_mm()[1];
        let with_tray = long(&frame);
        frame.bought.remove("flow_sensor");
        assert!((long(&frame) - centre.sleeve_length_mm).abs() < 1e-3 && with_tray > centre.sleeve_length_mm + 10.0);
    }

    #[test]
    fn analytic_sleeve_follows_a_larger_battery() {
        let (mut frame, _) = v8();
        (frame.battery.battery_length_mm, frame.battery.battery_width_mm, frame.battery.battery_height_mm) = (70.0, 35.0, 18.0);
        let centre = Centre::new(&frame);
        let sleeve = Gauged::new(&feature(&frame, &centre));
        sleeve.pocket([-18.0, 1.0, -9.1], [18.0, 60.0, 9.1], "xXzZ");
        assert!(crate::solid::gate::pass(&sleeve.0.to_mesh()).is_ok());
    }
}
