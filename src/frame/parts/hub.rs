//! The hub: a plate with eight plug bores along the diagonals, the frame's centre. In a frame that is longer than wide its front and
//! rear halves stand apart, and a bar on each side joins them.
//!
//! Frame of reference: origin on the hub axis in the plane of the arms, x right, y front, z up.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use nalgebra::{Point2, Rotation2, UnitQuaternion, Vector3};

use super::outline::{Pen, SINK_MM, along_x, along_y, bore, face, sharp, upright};
use super::record::{Fold, MaterialClass, PrintedPart, Seat, Wall, WallPlace, always};
use crate::frame::skeleton::Stack;
use crate::frame::skeleton::centre::Centre;
use crate::params::{Frame, PartName};
use crate::solid::{Contour, Feature, Profile};
use crate::units::Angle;

/// The record of the part.
pub static PART: PrintedPart = PrintedPart {
    name: PartName::Hub,
    feature: |frame, _, centre| feature(frame, centre),
    material: MaterialClass::Rigid,
    seat: Seat::Centre(Centre::hub_pose),
    fold: Fold::Stands,
    print_turn,
    needed: always,
    walls: &[
        Wall { keys: &["hub.hub_mouth_mm", "hub_joint.plug_length_mm", "hub.stack_counterbore_diameter_mm"], is_at: is_beside_counterbore },
        Wall::anywhere(&["hub.hub_boss_wall_mm", "hub.hub_tie_wall_mm", "hub.hub_back_wall_mm"]),
    ],
};

/// Whether a wall is between the counterbore of a stack's screw and what ends the plate beside it.
fn is_beside_counterbore(frame: &Frame, _: &Centre, wall: &WallPlace) -> bool {
    let [x, y, _] = wall.at_mm;
    let reach_mm = 0.5 * frame.hub.stack_counterbore_diameter_mm + wall.thick_mm + FACET_MM;
    Stack::axes_mm(frame).into_iter().any(|[a, b]| libm::hypot(x - a, y - b) <= reach_mm)
}

/// How far a facet of a round wall is from the circle, and a point of it from the nearest of the wall, mm.
const FACET_MM: f64 = 0.1;

/// The fillet between the plate and a boss, and in the plate's outline, mm.
const FILLET_MM: f64 = 3.0;

/// The fillet in the outline between the ring around a tie hole and a boss, mm.
const RING_FILLET_MM: f64 = 2.0;

/// What of a boss has to stand out beyond the end of a fillet along it, mm; otherwise there is no fillet.
const BEYOND_FILLET_MM: f64 = 0.5;

/// What is left flat of a ring around its tie hole, mm.
const TIE_RIM_MM: f64 = 0.1;

/// Less than half of a step between corners of a rounding, rad.
const SHORT_RAD: f64 = 0.05;

/// The hub of a frame, in the assembly's axes.
pub fn feature(frame: &Frame, centre: &Centre) -> Feature {
    Hub { frame, centre }.feature()
}

/// Printed as it stands: the flat underside on the bed, the bores lying.
pub fn print_turn() -> UnitQuaternion<f64> {
    UnitQuaternion::identity()
}

struct Hub<'a> {
    frame: &'a Frame,
    centre: &'a Centre,
}

impl Hub<'_> {
    /// The whole hub.
    ///
    /// Bosses, plate and ears share top and underside to the last bit, and their edges are rounded alike: faces that were a
    /// hundredth apart would cross in slivers. Drawn with the arms along x and y and turned when it is whole: the
    /// mesh kernel sorts facets by axis-parallel boxes, and those of long facets are thin only along the axes.
    pub fn feature(&self) -> Feature {
        let pair = self.pair();
        let pairs = (0..4).map(|i| self.in_module(i, pair.clone()));
        let arms = Feature::union(pairs.chain(self.bars())).minus([quarter(self.dish(), -45.0)]);
        let body = std::iter::once(arms).chain(self.plates()).chain(self.ears());
        quarter(Feature::union(body).minus(self.holes()), 45.0)
    }

    /// What is drawn along x, in the module with this number.
    fn in_module(&self, module: u8, feature: Feature) -> Feature {
        self.moved(module < 2, quarter(feature, 90.0 * f64::from(module)))
    }

    /// What is drawn in a square hub, in the front or the rear half of this one.
    fn moved(&self, front: bool, feature: Feature) -> Feature {
        let places = self.centre.places;
        if !places.are_apart() {
            return feature;
        }
        // The frame's y is the diagonal of the axes in which the hub is drawn.
        let along = if front { FRAC_1_SQRT_2 } else { -FRAC_1_SQRT_2 } * places.forward_mm;
        feature.at(along, along, 0.0)
    }

    /// What joins the halves where they stand apart: a bar on each side, from where the flanks of the front modules meet to where those
    /// of the rear ones do.
    fn bars(&self) -> Vec<Feature> {
        let apart = self.centre.places.forward_mm;
        if !self.centre.places.are_apart() {
            return Vec::new();
        }
        let (h, re) = (self.centre.hub_half_height_mm, self.edge_mm());
        let outer = self.centre.tie_side_mm - 2.0 * SINK_MM;
        let section = face(&[sharp(0.0, -h), ([outer, -h], re), ([outer, h], re), sharp(0.0, h)]);
        let right = along_y(section, [-apart, apart]);
        [right.clone(), right.mirrored(Vector3::x())].map(|bar| quarter(bar, -45.0)).into()
    }

    /// The two bosses of a diagonal, drawn along x, with the fillets to the plate.
    fn pair(&self) -> Feature {
        let h = self.centre.hub_half_height_mm;
        let (tc, flank, inner) = (0.5 * self.frame.hub_joint.arm_pitch_mm, self.centre.flank_mm, self.inner_flank_mm());
        let (re, zs) = (self.edge_mm(), self.centre.plate_top_mm.min(0.0));
        let mut outline = Pen::new(Point2::new(flank - re, -h));
        outline.arc(Point2::new(flank - re, re - h), Point2::new(flank - re, -h), Point2::new(flank, re - h), true);
        outline.arc(Point2::new(flank - re, h - re), Point2::new(flank, h - re), Point2::new(flank - re, h), true);
        // The circle has a corner of its polygon where the fillet touches it.
        let (middle, end) = (Point2::new(tc, 0.0), Point2::new(inner, zs));
        let touch = self.web_touch();
        outline.arc(middle, Point2::new(tc, h), touch, true);
        outline.arc(middle, touch, end, true);
        outline.arc(Point2::new(inner + re, re - h), Point2::new(inner, re - h), Point2::new(inner + re, -h), true);
        // A boss ends where its neighbour on the next diagonal takes over.
        let own = face(&[
            sharp(-0.7, 0.0),
            sharp(self.frame.hub.hub_mouth_mm + 5.0, 0.0),
            sharp(self.frame.hub.hub_mouth_mm + 5.0, self.frame.hub.hub_mouth_mm + 5.7),
        ]);
        let boss = Feature::intersection([
            along_x(Profile::new(outline.close()), [0.0, self.frame.hub.hub_mouth_mm]),
            upright(own, [-2.0 * h, 2.0 * h]),
        ]);
        let one = Feature::union([boss, self.corner()]);
        Feature::union([one.clone(), one.mirrored(Vector3::y())])
    }

    /// The fillet between the plate and the inner flank of a boss, drawn along x, and that in the outline where the plate ends, which
    /// trims it.
    fn corner(&self) -> Feature {
        let (edge, flank) = (self.centre.plate_edge_mm, self.inner_flank_mm());
        let [x, y] = [edge + FILLET_MM, flank - FILLET_MM];
        if edge + FILLET_MM >= self.frame.hub.hub_mouth_mm - BEYOND_FILLET_MM {
            return self.web(edge - 0.05);
        }
        // Where edges are rounded, plate and boss end so far inwards.
        let inwards = self.edge_mm() + 0.1;
        let outline = face(&[sharp(edge - inwards, y), sharp(x, y), sharp(x, flank + inwards), sharp(edge - inwards, flank + inwards)]);
        let low = upright(outline, [-self.centre.hub_half_height_mm, self.centre.plate_top_mm]);
        Feature::union([low, self.web(x)]).minus([self.hollow(FILLET_MM, false, &[]).at(x, y, 0.0)])
    }

    /// What a fillet in the outline leaves free, about z: a cylinder that widens where the edges at the underside are rounded, and at
    /// the top, too, where that is rounded. It touches what is beside it in these directions, rad.
    fn hollow(&self, radius_mm: f64, top: bool, touches_rad: &[f64]) -> Feature {
        let (h, re) = (self.centre.hub_half_height_mm, self.edge_mm());
        let (wide, high) = (radius_mm + re, 2.0 * h + FILLET_MM);
        let beyond = wide + SINK_MM;
        let mut outline = Pen::new(Point2::new(0.0, -high));
        outline.line(Point2::new(beyond, -high)).line(Point2::new(beyond, -h));
        outline.arc(Point2::new(wide, re - h), Point2::new(wide, -h), Point2::new(radius_mm, re - h), false);
        if top {
            outline.arc(Point2::new(wide, h - re), Point2::new(radius_mm, h - re), Point2::new(wide, h), false);
            outline.line(Point2::new(beyond, h)).line(Point2::new(beyond, high));
        } else {
            outline.line(Point2::new(radius_mm, high));
        }
        outline.line(Point2::new(0.0, high));
        Feature::revolve_with_corners(Profile::new(outline.close()), touches_rad.iter().copied().map(Angle::rad))
    }

    /// Axis of the fillet between the plate and the inner flank of a boss, drawn along x: y and z.
    fn web_centre(&self) -> Point2<f64> {
        let (h, tc) = (self.centre.hub_half_height_mm, 0.5 * self.frame.hub_joint.arm_pitch_mm);
        let z = self.centre.plate_top_mm + FILLET_MM;
        Point2::new(tc - ((h + FILLET_MM).powi(2) - z * z).max(0.01).sqrt(), z)
    }

    /// Where that fillet touches the boss.
    fn web_touch(&self) -> Point2<f64> {
        let middle = Point2::new(0.5 * self.frame.hub_joint.arm_pitch_mm, 0.0);
        middle + (self.web_centre() - middle).normalize() * self.centre.hub_half_height_mm
    }

    /// The fillet between the plate and the inner flank of a boss, drawn along x up to there.
    fn web(&self, to_mm: f64) -> Feature {
        let (h, zt, tc) = (self.centre.hub_half_height_mm, self.centre.plate_top_mm, 0.5 * self.frame.hub_joint.arm_pitch_mm);
        let (centre, touch) = (self.web_centre(), self.web_touch());
        let mut web = Pen::new(Point2::new(centre.x, zt - 0.4));
        web.arc(centre, Point2::new(centre.x, zt), touch, true);
        web.line(Point2::new(tc - 0.5 * h, -0.2)).line(Point2::new(tc - 0.5 * h, zt - 0.4));
        along_x(Profile::new(web.close()), [self.inner_flank_mm(), to_mm])
    }

    /// What the bosses leave free above the plate: the inner sides of the four pads.
    fn dish(&self) -> Feature {
        let (h, zt) = (self.centre.hub_half_height_mm, self.centre.plate_top_mm);
        let (r1, r2) = (self.frame.hub.hub_pad_fillet_mm, self.edge_mm());
        let (zl, zu) = (zt + r1, h - r2);
        let xt = self.centre.tie_side_mm - self.frame.hub.hub_pad_depth_mm;
        let dz = zu - zl;
        let xc = xt - ((r1 + r2).powi(2) - dz * dz).max(0.04).sqrt();
        let outline = |out_mm: f64| {
            let (low, high) = (Point2::new(xc + out_mm, zl), Point2::new(xt + out_mm, zu));
            let towards = (high - low).normalize();
            let left = |p: Point2<f64>| Point2::new(-p.x, p.y);
            // The first chord beyond the turn is a short one: else it could lie in one line with the last before it.
            let short = high + Rotation2::new(-SHORT_RAD) * (-towards * r2);
            let (bottom, ends, begins, top) = (Point2::new(low.x, zt), low + towards * r1, high - towards * r2, Point2::new(high.x, h));
            let mut pen = Pen::new(Point2::new(-low.x, zt - 0.3));
            pen.line(Point2::new(low.x, zt - 0.3))
                .arc(low, bottom, ends, true)
                .arc(high, begins, short, false)
                .arc(high, short, top, false);
            pen.line(Point2::new(high.x, h + 1.0)).line(Point2::new(-high.x, h + 1.0));
            pen.arc(left(high), left(top), left(short), false).arc(left(high), left(short), left(begins), false).arc(
                left(low),
                left(ends),
                left(bottom),
                true,
            );
            Profile::new(pen.close())
        };
        let forward = self.centre.places.forward_mm;
        let [across, along] = [0.0, forward].map(outline);
        let wide = 3.0 * self.centre.flank_mm;
        Feature::intersection([along_y(across, [-wide - forward, wide + forward]), along_x(along, [-wide - 1.0, wide + 1.0])])
    }

    /// The plate of a square hub, or one in each half and what is between them.
    fn plates(&self) -> Vec<Feature> {
        let apart = self.centre.places.forward_mm;
        if !self.centre.places.are_apart() {
            return vec![self.plate()];
        }
        let (side, low) = (self.centre.tie_side_mm - self.edge_mm(), -self.centre.hub_half_height_mm);
        let between = Feature::cuboid_between([-side, -apart, low], [side, apart, self.centre.plate_top_mm]);
        vec![self.moved(true, self.plate()), self.moved(false, self.plate()), quarter(between, -45.0)]
    }

    fn plate(&self) -> Feature {
        let (edge, zt, re) = (self.centre.plate_edge_mm, self.centre.plate_top_mm, self.edge_mm());
        let side = |low: f64, high: f64| face(&[([-edge, low], re), ([edge, low], re), sharp(edge, high), sharp(-edge, high)]);
        let low = -self.centre.hub_half_height_mm;
        let reach = [-edge - 5.0, edge + 5.0];
        Feature::intersection([along_y(side(low, zt), reach), along_x(side(low, zt + 1.0), reach)])
    }

    /// The rings around the tie holes, with fillets to the bosses beside them.
    fn ears(&self) -> Vec<Feature> {
        let (r, h, re) = (self.frame.hub.tie_ring_radius_mm, self.centre.hub_half_height_mm, self.edge_mm());
        let flank = self.centre.flank_mm;
        let section = face(&[sharp(0.0, -h), ([r, -h], re), ([r, h], re), sharp(0.0, h)]);
        let touches = [self.ring_touch_rad(), 0.5 * PI - self.ring_touch_rad()];
        let ring = Feature::revolve_with_corners(section, touches.map(Angle::rad)).at(flank, flank, 0.0);
        let blended = Feature::union(std::iter::once(ring.clone()).chain(self.ring_fillets()));
        let at = |i: u8, ear: &Feature| quarter(ear.clone(), 90.0 * f64::from(i) - 90.0);
        // Those at the sides stay, in the middle of the bars, where the halves stand apart.
        let stays = |i: u8| i.is_multiple_of(2) && self.centre.places.are_apart();
        (0..4).map(|i| if stays(i) { at(i, &ring) } else { self.moved(i == 1, at(i, &blended)) }).collect()
    }

    /// The fillets between a ring and the two bosses that it stands between.
    fn ring_fillets(&self) -> Vec<Feature> {
        let flank = self.centre.flank_mm;
        let [x, y] = self.ring_fillet_mm().map(|out_mm| flank + out_mm);
        if x >= self.frame.hub.hub_mouth_mm - BEYOND_FILLET_MM {
            return Vec::new();
        }
        let (h, inwards) = (self.centre.hub_half_height_mm, flank - self.edge_mm() - 0.1);
        // Begins in the middle of the ring, however much of it is rounded, and reaches a little beyond the diagonal to its mirror image.
        let outline = face(&[sharp(flank, flank), sharp(inwards - 0.3, inwards), sharp(x, inwards), sharp(x, y)]);
        let touches = [-0.5 * PI, PI + self.ring_touch_rad()];
        let one = upright(outline, [-h, h]).minus([self.hollow(RING_FILLET_MM, true, &touches).at(x, y, 0.0)]);
        vec![one.clone(), one.mirrored(Vector3::new(1.0, -1.0, 0.0))]
    }

    /// Axis of the fillet between a ring and the boss along x, from the ring's, mm: it touches both.
    fn ring_fillet_mm(&self) -> [f64; 2] {
        let r = self.frame.hub.tie_ring_radius_mm;
        [((r + RING_FILLET_MM).powi(2) - RING_FILLET_MM * RING_FILLET_MM).sqrt(), RING_FILLET_MM]
    }

    /// The direction in which that fillet touches the ring, rad.
    fn ring_touch_rad(&self) -> f64 {
        let [x, y] = self.ring_fillet_mm();
        libm::atan2(y, x)
    }

    fn holes(&self) -> Vec<Feature> {
        let (h, zt) = (self.centre.hub_half_height_mm, self.centre.plate_top_mm);
        let radius = self.centre.bore_radius_mm;
        let plug = |t: f64| {
            let profile = Profile::new(Contour::bore([t, 0.0], radius));
            along_x(profile, [self.frame.hub.hub_mouth_mm - self.frame.hub_joint.plug_length_mm, self.frame.hub.hub_mouth_mm + 1.0])
        };
        let mut holes = Vec::new();
        for i in 0..4 {
            let diagonal = 90.0 * f64::from(i);
            holes.extend([-0.5, 0.5].map(|side| self.in_module(i, plug(side * self.frame.hub_joint.arm_pitch_mm))));
            let tie_mm = if i % 2 == 0 { self.centre.tie_side_mm } else { self.centre.tie_front_mm };
            holes.push(quarter(bore(tie_mm, 0.0, self.frame.hub.hub_tie_hole_diameter_mm, [-h - 1.0, h + 1.0]), diagonal - 45.0));
        }
        for [x, y] in Stack::axes_mm(self.frame) {
            let hub = &self.frame.hub;
            let pilot = bore(x, y, hub.stack_pilot_diameter_mm, [-h - 1.0, zt + 1.0]);
            let counterbore = bore(x, y, hub.stack_counterbore_diameter_mm, [zt - hub.stack_counterbore_depth_mm, zt + 2.0 * h]);
            holes.extend([pilot, counterbore].map(|hole| quarter(hole, -45.0)));
        }
        holes
    }

    /// Rounding of all edges, mm: around a tie hole it leaves a rim, or its end would be the hole's edge.
    fn edge_mm(&self) -> f64 {
        let hub = &self.frame.hub;
        let beside_hole = hub.tie_ring_radius_mm - 0.5 * hub.hub_tie_hole_diameter_mm - TIE_RIM_MM;
        hub.hub_edge_radius_mm.min(hub.hub_plate_thickness_mm - 0.5).min(self.centre.hub_half_height_mm - 0.3).min(beside_hole)
    }

    /// From the diagonal to the inner flank of a boss, at the plate.
    fn inner_flank_mm(&self) -> f64 {
        let (h, zs) = (self.centre.hub_half_height_mm, self.centre.plate_top_mm.min(0.0));
        0.5 * self.frame.hub_joint.arm_pitch_mm - (h * h - zs * zs).sqrt()
    }
}

/// Turned about z by degrees.
fn quarter(feature: Feature, degrees: f64) -> Feature {
    feature.turned_z(Angle::deg(degrees))
}

#[cfg(test)]
mod tests {
    use super::super::gauges::{Gauged, v8};
    use super::*;

    fn hub() -> (Frame, Centre, Gauged) {
        let (frame, centre) = v8();
        let gauged = Gauged::new(&feature(&frame, &centre));
        (frame, centre, gauged)
    }

    #[test]
    fn measured_hub_is_like_the_real_one() {
        hub().2.like_the_real_one([64.535, 64.535, 9.2], 10_252.9, 2.0, 8);
    }

    #[test]
    fn measured_hub_bores_have_place_width_and_depth() {
        let hub = Gauged::new(&{
            let (frame, centre) = v8();
            quarter(feature(&frame, &centre), -45.0)
        });
        for t in [-12.665, 12.665] {
            hub.hole([27.664 - 8.99, t, 0.0], [28.0, t, 0.0], 6.8);
            hub.pocket([27.664 - 9.0, t - 1.0, -1.0], [28.0, t + 1.0, 1.0], "x");
        }
    }

    #[test]
    fn measured_hub_holes_lie_on_their_patterns() {
        let (_, centre, hub) = hub();
        assert!((centre.tie_side_mm - 25.41).abs() < 0.05);
        for (x, y) in [(25.41, 0.0), (0.0, 25.41), (-25.41, 0.0), (0.0, -25.41)] {
            hub.hole([x, y, -5.0], [x, y, 5.0], 3.0);
        }
        for (x, y) in [(10.0, 10.0), (-10.0, 10.0), (-10.0, -10.0), (10.0, -10.0)] {
            hub.hole([x, y, -5.0], [x, y, 5.0], 1.9);
            hub.hole([x, y, -0.6 - 1.88], [x, y, 5.0], 4.2);
        }
    }

    #[test]
    fn analytic_wide_stack_pushes_the_plate_out_and_leaves_eight_tunnels() {
        let (mut frame, _) = v8();
        frame.hub.stack_pattern_mm = 30.5;
        let centre = Centre::new(&frame);
        let mesh = Gauged::new(&feature(&frame, &centre)).0.to_mesh();
        assert!(centre.plate_edge_mm > 30.5 * std::f64::consts::FRAC_1_SQRT_2 + 2.1);
        assert_eq!(crate::solid::gate::pass(&mesh).map(|seen| seen.euler), Ok(-14));
    }
}
