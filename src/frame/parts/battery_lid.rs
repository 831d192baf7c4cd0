//! The lid: stays taped to the battery, closes the sleeve, and carries the plug and magnet that meet the bracket's.
//!
//! Frame of reference: origin in the middle of the battery's cross section where the lid meets the sleeve's rear
//! rim, y front, z up; the lid extends towards -y and slides away that way.

use std::f64::consts::PI;

use nalgebra::{Isometry3, Point2, Rotation2, Translation3, UnitQuaternion, Vector2, Vector3};

use super::battery_bracket::connector;
use super::battery_sleeve::sleeve_edge_mm;
use super::outline::{Pen, SINK_MM, along_x, along_y, face, sharp, upright};
use super::record::{Fold, MaterialClass, PrintedPart, Seat, Wall, always};
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
    walls: &[Wall::anywhere(&["sleeve.sleeve_side_wall_mm", "sleeve.sleeve_top_wall_mm", "lid.lid_cheek_mm"])],
};

/// Fillets in the trough between the cheeks: at its bottom and at the block, mm, where the bracket's edges leave room for them.
const TROUGH_FILLET_MM: f64 = 0.5;

/// How far above the block the slope at the tower's back begins, as a multiple of its fillet there.
const SLOPE_RISE: f64 = 1.35;

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
        let body = Feature::intersection([along_x(self.side_view(), [-w - 1.0, w + 1.0]), self.envelope(), self.behind_rim()]);
        Feature::union([body, self.tower()].into_iter().chain(self.slope())).minus(self.cuts())
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
        let mut view = vec![sharp(1.0, low), sharp(1.0, self.deck - slope), sharp(self.front - 0.05, self.top)];
        if self.overhang() > 0.3 {
            // The upper edge of a block that stands out is rounded by the envelope.
            let arch = if arch > 0.5 { arch } else { 0.0 };
            view.extend([sharp(self.front - 0.05, self.top + 1.0), sharp(self.rear - 1.0, self.top + 1.0)]);
            view.extend([sharp(self.rear, under), ([self.shell, under], arch), sharp(self.shell, low)]);
        } else {
            view.push(([self.rear, self.top], self.edge_mm()));
            if self.overhang() > -0.3 {
                view.push(sharp(self.rear, low));
            } else {
                view.extend([sharp(self.rear, oh), sharp(self.shell, oh), sharp(self.shell, low)]);
            }
        }
        face(&view)
    }

    /// Rounding of the shell's long edges and of the block's upper edge, mm.
    fn edge_mm(&self) -> f64 {
        sleeve_edge_mm(self.frame)
    }

    /// Rounding of the rear corners, seen from above, mm: further forward than the block stands out, they would cut into the shell's side walls.
    fn corner_mm(&self) -> f64 {
        self.frame.lid.lid_corner_radius_mm.min(self.overhang())
    }

    /// What the lid may fill: from the rim backwards, with rounded long edges and rear corners, and the block's upper edge rounded around
    /// them.
    fn envelope(&self) -> Feature {
        let ([w, h], e) = (self.centre.outer_mm, self.edge_mm());
        let section = face(&[([-w, -h], e), ([w, -h], e), ([w, self.top], e), ([-w, self.top], e)]);
        if self.overhang() <= 0.3 {
            return along_y(section, [self.rear.min(self.shell), 2.0]);
        }
        let r = self.corner_mm();
        let low = self.centre.inner_mm[1] - self.overhang();
        let corner = Feature::revolve(face(&[sharp(0.0, low), sharp(r, low), ([r, self.top], e.min(r)), sharp(0.0, self.top)]));
        let corners = [-1.0, 1.0].map(|side| corner.clone().at(side * (w - r), self.rear + r, 0.0));
        Feature::hull(std::iter::once(along_y(section, [self.rear + r, 2.0])).chain(corners))
    }

    /// All that is behind the sleeve's rim: cut along the axes, so that lid and rim touch and share nothing.
    fn behind_rim(&self) -> Feature {
        let ([w, h], rear) = (self.centre.outer_mm, self.rear.min(self.shell));
        Feature::cuboid_between([-w - 2.0, rear - 2.0, -h - 2.0], [w + 2.0, 0.0, self.top + 3.0])
    }

    fn tower_rear(&self) -> f64 {
        self.front - self.centre.lid_magnet_depth_mm - self.frame.lid.tower_back_mm
    }

    /// The tower that holds the magnet, rounded on its three free sides.
    fn tower(&self) -> Feature {
        let (w, r, rear) = (0.5 * self.centre.bracket_width_mm, self.frame.lid.tower_radius_mm, self.tower_rear());
        let root = self.top - 1.5;
        let top = self.magnet_z + 0.5 * self.centre.magnet_pocket_mm[1] + self.frame.bracket.magnet_wall_mm;
        let behind = face(&[sharp(-w, root), sharp(w, root), ([w, top], r), ([-w, top], r)]);
        let round = Feature::revolve(face(&[sharp(0.0, root), sharp(r, root), ([r, top], r), sharp(0.0, top)]));
        Feature::hull([
            along_y(behind, [rear + r, self.front + 0.5]),
            round.clone().at(r - w, rear + r, 0.0),
            round.at(w - r, rear + r, 0.0),
        ])
    }

    /// The slope from the tower's back to the block's rear edge, which goes on with the rounding of the tower's upright edges; none where
    /// the tower stands at the edge.
    fn slope(&self) -> Vec<Feature> {
        let (w, r, edge) = (0.5 * self.centre.bracket_width_mm, self.frame.lid.tower_radius_mm, self.edge_mm());
        let back = self.tower_rear();
        // In (y, z): the fillet's centre behind the tower, and the rounded edge's. Their common tangent passes between them.
        let fillet = Point2::new(back - r, self.top + SLOPE_RISE * r);
        let between = Point2::new(self.rear + edge, self.top - edge) - fillet;
        if between.norm() <= 1.02 * (r + edge) || back < self.rear + 0.3 {
            return Vec::new();
        }
        let off = libm::acos((r + edge) / between.norm());
        let inwards = Rotation2::new(off) * between.normalize();
        let along = Vector2::new(inwards.y, -inwards.x);
        let length = (between.norm_squared() - (r + edge).powi(2)).sqrt();
        let top = fillet + inwards * r;
        let deep = top + inwards * (1.1 * r);
        let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), libm::atan2(along.y, along.x));
        let section = face(&[([-w, 0.0], r), ([w, 0.0], r), sharp(w, 1.1 * r), sharp(-w, 1.1 * r)]);
        let flat = along_y(section, [-SINK_MM, length]).placed(Isometry3::from_parts(Translation3::new(0.0, top.x, top.y), turn));
        let (low, ahead) = (deep.y.min(self.top) - 0.3, back + 1.1 * r);
        let under = [fillet, top, deep, Point2::new(deep.x, low), Point2::new(ahead, low), Point2::new(ahead, fillet.y)];
        let under = face(&under.map(|p| sharp(p.x, p.y)));
        // Corners of the polygons of what is round along x lie where it touches the slope, and where it touches the tower.
        let touch = Angle::rad(libm::atan2(inwards.y, inwards.x));
        let hollow = hollow(w, r, [0.0, touch.to_rad()]).at(0.0, fillet.x, fillet.y);
        let half = w.min(self.centre.outer_mm[0] - self.corner_mm());
        let rim = Feature::cylinder(edge, 2.0 * half).turned_y(Angle::deg(90.0)).turned_x(touch);
        let rim = rim.at(-half, self.rear + edge, self.top - edge);
        vec![flat, rim, along_x(under, [-w, w]).minus([hollow])]
    }

    /// Fillets of the trough, mm: the bracket's edges are sharp, so a wider one would come nearer to them than the faces beside it do.
    fn trough_fillet_mm(&self) -> f64 {
        let lid = &self.frame.lid;
        TROUGH_FILLET_MM.min(lid.lid_clearance_mm).min(lid.lid_slide_clearance_mm)
    }

    /// The trough between the cheeks that the bracket slides in, with fillets at its bottom and at the block.
    fn trough(&self, top: f64) -> Feature {
        let (cheek, r) = (self.centre.outer_mm[0] - self.frame.lid.lid_cheek_mm, self.trough_fillet_mm());
        let below = face(&[([-cheek, self.deck], r), ([cheek, self.deck], r), sharp(cheek, top), sharp(-cheek, top)]);
        let beside = face(&[([self.front, self.deck], r), sharp(2.0, self.deck), sharp(2.0, top + 1.0), sharp(self.front, top + 1.0)]);
        let above = face(&[([-cheek, self.front], r), ([cheek, self.front], r), sharp(cheek, 3.0), sharp(-cheek, 3.0)]);
        Feature::intersection([along_y(below, [self.front, 2.0]), along_x(beside, [-cheek, cheek]), upright(above, [self.deck, top])])
    }

    /// The battery's cavity, the trough between the cheeks, the connector's hole and the magnet's pocket.
    fn cuts(&self) -> [Feature; 4] {
        let [iw, ih] = self.centre.inner_mm;
        let [along, up] = self.centre.magnet_pocket_mm.map(|edge| 0.5 * edge);
        let nose = connector(&self.frame.bracket, self.frame.bracket.connector_step_mm, self.connector_z);
        let bottom = self.front - self.centre.lid_magnet_depth_mm;
        [
            Feature::cuboid_between([-iw, self.rear.min(self.shell) - 5.0, -ih], [iw, 2.0, ih]),
            self.trough(self.magnet_z + up + 10.0),
            along_y(nose, [self.rear - 1.0, self.front + 1.0]),
            Feature::cuboid_between([-along, bottom, self.magnet_z - up], [along, self.front + 1.0, self.magnet_z + up]),
        ]
    }
}

/// What the fillet leaves free, along x: a roller that widens towards its ends as the tower's upright edges are rounded. It touches what is
/// beside it in these directions, rad from y towards z.
fn hollow(half_width_mm: f64, radius_mm: f64, touches_rad: [f64; 2]) -> Feature {
    let (w, r) = (half_width_mm, radius_mm);
    let wide = 2.0 * r + SINK_MM;
    let mut pen = Pen::new(Point2::new(0.0, w + 1.0));
    pen.line(Point2::new(0.0, -w - 1.0)).line(Point2::new(wide, -w - 1.0)).line(Point2::new(wide, -w));
    pen.arc(Point2::new(2.0 * r, r - w), Point2::new(2.0 * r, -w), Point2::new(r, r - w), false);
    pen.arc(Point2::new(2.0 * r, w - r), Point2::new(r, w - r), Point2::new(2.0 * r, w), false);
    pen.line(Point2::new(wide, w)).line(Point2::new(wide, w + 1.0));
    // Turned about z, with -z in place of x, then laid along x.
    let corners = touches_rad.map(|touch| Angle::rad(0.5 * PI + touch));
    Feature::revolve_with_corners(Profile::new(pen.close()), corners).turned_y(Angle::deg(90.0))
}

#[cfg(test)]
mod tests {
    use super::super::battery_bracket;
    use super::super::gauges::{Gauged, v8};
    use super::*;
    use crate::solid::MeshSolid;

    /// Between the bracket and the trough is the room that was asked for, in its corners, too.
    #[test]
    fn analytic_the_bracket_slides_in_the_trough_with_the_clearances_asked_for() {
        for [across_mm, slide_mm] in [[0.2, 0.1], [0.1, 0.1], [0.1, 0.05], [0.6, 0.4], [0.6, 0.05]] {
            let mut frame = v8().0;
            (frame.lid.lid_clearance_mm, frame.lid.lid_slide_clearance_mm) = (across_mm, slide_mm);
            let centre = Centre::new(&frame);
            let lid = MeshSolid::build(&feature(&frame, &centre).placed(centre.sleeve_pose()));
            let bracket = MeshSolid::build(&battery_bracket::feature(&frame, &centre).placed(centre.bracket_pose()));
            let gap_mm = bracket.gap_mm(&lid, 1.0);
            assert!((gap_mm - across_mm.min(slide_mm)).abs() < 0.005, "{across_mm} {slide_mm}: {gap_mm}");
        }
    }

    #[test]
    fn measured_lid_is_like_the_real_one() {
        let (frame, centre) = v8();
        let lid = Gauged::new(&feature(&frame, &centre));
        // The magnet's pocket is deeper and the deck lower than in v8, see the report of differences.
        lid.like_the_real_one([34.0, 20.49, 34.0], 3914.2, 4.0, 2);
        lid.pocket([-16.0, -14.0, -8.1], [16.0, 1.0, 8.1], "xXzZ");
    }
}
