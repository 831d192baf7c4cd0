//! The lid: stays taped to the battery, closes the sleeve, and carries the plug and magnet that meet the bracket's.
//!
//! Frame of reference: origin in the middle of the battery's cross section where the lid meets the sleeve's rear
//! rim, y front, z up; the lid extends towards -y and slides away that way.

use nalgebra::{UnitQuaternion, Vector3};

use super::battery_bracket::connector;
use super::outline::{SINK_MM, along_x, along_y, arc, face, sharp, upright};
use super::record::{Fold, MaterialClass, PrintedPart, Seat, always};
use crate::frame::skeleton::centre::Centre;
use crate::params::{Frame, PartName};
use crate::solid::{Feature, Profile};
use crate::units::Angle;

/// The record of the part.
pub static PART: PrintedPart = PrintedPart {
    name: PartName::BatteryLid,
    feature: |frame, _, centre| feature(frame, centre),
    material: MaterialClass::Rigid,
    seat: Seat::Centre(Centre::sleeve_pose),
    fold: Fold::Stands,
    print_turn,
    needed: always,
    walls: &["sleeve.sleeve_side_wall_mm", "sleeve.sleeve_top_wall_mm", "lid.lid_cheek_mm"],
};

/// Rounding of the block's rear upper edge, mm.
const BLOCK_ROUND_MM: f64 = 1.0;

/// The lid of a frame.
pub fn feature(frame: &Frame, centre: &Centre) -> Feature {
    Lid::new(frame, centre).feature()
}

/// Printed standing on its rear; the floor needs support.
pub fn print_turn() -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::x_axis(), Angle::deg(90.0).to_rad())
}

struct Lid<'a> {
    frame: &'a Frame,
    centre: &'a Centre,
    /// Upper face of the deck, just under the bracket.
    deck: f64,
    /// Front and rear face of the block that carries the connector, and its top.
    front: f64,
    rear: f64,
    top: f64,
    /// Rear end of the shell around the battery.
    shell: f64,
    connector_z: f64,
    magnet_z: f64,
}

impl<'a> Lid<'a> {
    fn new(frame: &'a Frame, centre: &'a Centre) -> Self {
        let (lid, bracket) = (&frame.lid, &frame.bracket);
        let connector_z = centre.connector_z_mm + centre.lid_drop_mm();
        Self {
            frame,
            centre,
            deck: centre.outer_mm[1] - lid.lid_slide_clearance_mm,
            front: -lid.lid_reach_mm,
            rear: -lid.lid_reach_mm - lid.lid_block_depth_mm,
            top: connector_z + 0.5 * bracket.connector_height_mm - bracket.connector_step_mm + lid.lid_block_above_mm,
            shell: -centre.lid_cover_mm,
            connector_z,
            magnet_z: centre.magnet_z_mm + centre.lid_drop_mm(),
        }
    }

    fn feature(&self) -> Feature {
        let [w, _] = self.centre.outer_mm;
        let body = Feature::intersection([along_x(self.side_view(), [-w - 1.0, w + 1.0]), self.envelope(), self.plan()]);
        Feature::union([body, self.tower(), self.foot()]).minus(self.cuts())
    }

    /// How far the block stands out behind the shell.
    fn overhang(&self) -> f64 {
        self.shell - self.rear
    }

    /// Floor, arch, block and the slope of the cheeks, in (y, z); cavity and trough are cut out of it.
    fn side_view(&self) -> Profile {
        let ([_, ih], [_, oh]) = (self.centre.inner_mm, self.centre.outer_mm);
        let slope = (self.top - self.deck) / -self.front;
        let (low, under) = (-oh - 1.0, ih - 0.03);
        let arch = self.frame.lid.lid_arch_radius_mm.min(self.overhang() - 1.5);
        let mut view = vec![
            sharp(1.0, low),
            sharp(1.0, self.deck - slope),
            sharp(self.front - 0.05, self.top),
            ([self.rear, self.top], BLOCK_ROUND_MM),
        ];
        if self.overhang() > 0.3 {
            view.push(sharp(self.rear, under));
            if arch > 0.5 {
                view.extend(arc([self.shell - arch, under - arch], arch, 90.0, 0.0));
            } else {
                view.push(sharp(self.shell, under));
            }
            view.push(sharp(self.shell, low));
        } else if self.overhang() > -0.3 {
            view.push(sharp(self.rear, low));
        } else {
            view.extend([sharp(self.rear, oh), sharp(self.shell, oh), sharp(self.shell, low)]);
        }
        face(&view)
    }

    /// What the cross section may fill: rounded edges.
    fn envelope(&self) -> Feature {
        let (s, [w, h]) = (&self.frame.sleeve, self.centre.outer_mm);
        let r = s.sleeve_edge_radius_mm.min(0.97 * s.sleeve_side_wall_mm);
        let (low, high) = (-h, self.top + SINK_MM);
        let section = face(&[([-w, low], r), ([w, low], r), ([w, high], r), ([-w, high], r)]);
        along_y(section, [self.rear.min(self.shell) - 1.0, 2.0])
    }

    /// What the plan view may fill: from the rim backwards, rounded rear corners.
    fn plan(&self) -> Feature {
        let [w, h] = self.centre.outer_mm;
        // Rounded further forward than the block stands out, the corners would cut into the shell's side walls.
        let r = if self.overhang() > 0.3 { self.frame.lid.lid_corner_radius_mm.min(self.overhang()) } else { 0.0 };
        let (w, rear) = (w + SINK_MM, self.rear.min(self.shell) - SINK_MM);
        upright(face(&[sharp(-w, 0.0), ([-w, rear], r), ([w, rear], r), sharp(w, 0.0)]), [-h - 2.0, self.top + 1.0])
    }

    fn tower_rear(&self) -> f64 {
        self.front - self.centre.lid_magnet_depth_mm - self.frame.lid.tower_back_mm
    }

    /// The tower that holds the magnet, rounded on its three free sides.
    fn tower(&self) -> Feature {
        let (w, r, rear) = (0.5 * self.centre.bracket_width_mm, self.frame.lid.tower_radius_mm, self.tower_rear());
        let (root, e, wide) = (self.top - 1.5, SINK_MM, 0.5 * self.centre.bracket_width_mm + SINK_MM);
        let top = self.magnet_z + 0.5 * self.centre.magnet_pocket_mm[1] + self.frame.bracket.magnet_wall_mm;
        let behind = face(&[sharp(-w, root), sharp(w, root), ([w, top], r), ([-w, top], r)]);
        let above = face(&[sharp(-wide, self.front + 1.0), ([-wide, rear], r), ([wide, rear], r), sharp(wide, self.front + 1.0)]);
        let aside = face(&[
            sharp(rear - e, root - 1.5),
            sharp(self.front + 2.0, root - 1.5),
            sharp(self.front + 2.0, top + e),
            ([rear - e, top + e], r),
        ]);
        Feature::intersection([
            along_y(behind, [rear - 1.0, self.front + 0.5]),
            upright(above, [root - 0.5, top + 1.0]),
            along_x(aside, [-w - 1.0, w + 1.0]),
        ])
    }

    /// The fillet at the tower's back.
    fn foot(&self) -> Feature {
        let (rear, e) = (self.tower_rear(), 2.0 * SINK_MM);
        let r = (rear - self.rear - 1.0).clamp(0.4, 2.0);
        let (y, z, root) = (rear - r + e, self.top + r - e, self.top - 0.3);
        let mut profile = vec![sharp(rear + 0.3, root), sharp(rear + 0.3, z)];
        profile.extend(arc([y, z], r, 0.0, -90.0));
        profile.push(sharp(y, root));
        let wide = 0.5 * self.centre.bracket_width_mm - self.frame.lid.tower_radius_mm - 0.05;
        along_x(face(&profile), [-wide, wide])
    }

    /// The battery's cavity, the trough between the cheeks, the connector's hole and the magnet's pocket.
    fn cuts(&self) -> [Feature; 4] {
        let ([iw, ih], cheek) = (self.centre.inner_mm, self.centre.outer_mm[0] - self.frame.lid.lid_cheek_mm);
        let [along, up] = self.centre.magnet_pocket_mm.map(|edge| 0.5 * edge);
        let nose = connector(&self.frame.bracket, self.frame.bracket.connector_step_mm, self.connector_z);
        let bottom = self.front - self.centre.lid_magnet_depth_mm;
        [
            Feature::cuboid_between([-iw, self.rear.min(self.shell) - 5.0, -ih], [iw, 2.0, ih]),
            Feature::cuboid_between([-cheek, self.front, self.deck], [cheek, 2.0, self.magnet_z + up + 10.0]),
            along_y(nose, [self.rear - 1.0, self.front + 1.0]),
            Feature::cuboid_between([-along, bottom, self.magnet_z - up], [along, self.front + 1.0, self.magnet_z + up]),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::super::gauges::{Gauged, v8};
    use super::*;

    #[test]
    fn measured_lid_is_like_the_real_one() {
        let (frame, centre) = v8();
        let lid = Gauged::new(&feature(&frame, &centre));
        // The magnet's pocket is deeper and the deck lower than in v8, see the report of differences.
        lid.like_the_real_one([34.0, 20.49, 34.0], 3914.2, 4.0, 2);
        lid.pocket([-16.0, -14.0, -8.1], [16.0, 1.0, 8.1], "xXzZ");
    }
}
