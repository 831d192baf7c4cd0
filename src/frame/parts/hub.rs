//! The hub: a plate with eight plug bores along the diagonals, the frame's centre. In a frame that is longer than wide its front and
//! rear halves stand apart, and a bar on each side joins them.
//!
//! Frame of reference: origin on the hub axis in the plane of the arms, x right, y front, z up.

use std::f64::consts::FRAC_1_SQRT_2;

use nalgebra::{UnitQuaternion, Vector3};

use super::outline::{Corner, SINK_MM, along_x, along_y, arc, bore, face, mirrored, sharp, upright};
use super::record::{Fold, MaterialClass, PrintedPart, Seat, always};
use crate::frame::skeleton::centre::Centre;
use crate::params::{Frame, PartName};
use crate::solid::{Contour, Feature, Profile, SEGMENTS_PER_TURN};
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
    walls: &["hub.hub_boss_wall_mm", "hub.hub_tie_wall_mm", "hub.hub_back_wall_mm"],
};

/// The fillet between the plate and a boss, and in the plate's outline, mm.
const FILLET_MM: f64 = 3.0;

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
    /// Bosses, plate and ears stand 0.01 to 0.04 mm beyond top and underside and are cut to height together,
    /// so that no two of their faces coincide. Drawn with the arms along x and y and turned when it is whole: the
    /// mesh kernel sorts facets by axis-parallel boxes, and those of long facets are thin only along the axes.
    pub fn feature(&self) -> Feature {
        let h = self.centre.hub_half_height_mm;
        let wide = 2.0 * (self.frame.hub.hub_mouth_mm + self.centre.places.forward_mm);
        let pairs = (0..4).map(|i| self.in_module(i, self.pair(h + f64::from(1 + i % 2) * SINK_MM)));
        let arms = Feature::union(pairs.chain(self.bars())).minus([quarter(self.dish(), -45.0)]);
        let body = std::iter::once(arms).chain(self.plates()).chain(self.corner_fillets()).chain(self.ears());
        let slab = Feature::cuboid_between([-wide, -wide, -h], [wide, wide, h]);
        quarter(Feature::intersection([Feature::union(body), slab]).minus(self.holes()), 45.0)
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
        let (h, re) = (self.centre.hub_half_height_mm + 6.0 * SINK_MM, self.edge_mm());
        let outer = self.centre.tie_side_mm - 2.0 * SINK_MM;
        let section = face(&[sharp(0.0, -h), ([outer, -h], re), ([outer, h], re), sharp(0.0, h)]);
        let right = along_y(section, [-apart, apart]);
        [right.clone(), right.mirrored(Vector3::x())].map(|bar| quarter(bar, -45.0)).into()
    }

    /// The two bosses of a diagonal, drawn along x, with the fillets to the plate.
    fn pair(&self, h: f64) -> Feature {
        let (tc, flank, inner) = (0.5 * self.frame.hub_joint.arm_pitch_mm, self.centre.flank_mm, self.inner_flank_mm());
        let (re, zs) = (self.edge_mm(), self.centre.plate_top_mm.min(0.0));
        let turned = 180.0 + libm::asin(-zs / self.centre.hub_half_height_mm).to_degrees();
        let mut outline = vec![([inner, -h], re), ([flank, -h], re), ([flank, h], re)];
        outline.extend(arc([tc, 0.0], h, 90.0, turned));
        // A boss ends where its neighbour on the next diagonal takes over.
        let own = face(&[
            sharp(-0.7, 0.0),
            sharp(self.frame.hub.hub_mouth_mm + 5.0, 0.0),
            sharp(self.frame.hub.hub_mouth_mm + 5.0, self.frame.hub.hub_mouth_mm + 5.7),
        ]);
        let boss = Feature::intersection([along_x(face(&outline), [0.0, self.frame.hub.hub_mouth_mm]), upright(own, [-2.0 * h, 2.0 * h])]);
        let one = Feature::union([boss, self.web()]);
        Feature::union([one.clone(), one.mirrored(Vector3::y())])
    }

    /// The fillet between the plate and the inner flank of a boss, drawn along x.
    fn web(&self) -> Feature {
        let (h, zt, tc) = (self.centre.hub_half_height_mm, self.centre.plate_top_mm, 0.5 * self.frame.hub_joint.arm_pitch_mm);
        let cz = zt + FILLET_MM - SINK_MM;
        let ct = tc - ((h + FILLET_MM).powi(2) - cz * cz).max(0.01).sqrt();
        let mut web = vec![sharp(ct, zt - 0.4)];
        web.extend(arc([ct, cz], FILLET_MM, -90.0, libm::atan2(-cz, tc - ct).to_degrees()));
        web.extend([sharp(tc - 0.5 * h, -0.2), sharp(tc - 0.5 * h, zt - 0.4)]);
        along_x(face(&web), [self.inner_flank_mm(), self.centre.plate_edge_mm - 0.05])
    }

    /// What the bosses leave free above the plate: the inner sides of the four pads.
    fn dish(&self) -> Feature {
        let (h, zt) = (self.centre.hub_half_height_mm, self.centre.plate_top_mm);
        let (r1, r2) = (self.frame.hub.hub_pad_fillet_mm, self.edge_mm());
        let (zl, zu) = (zt + r1 - SINK_MM, h + SINK_MM - r2);
        let xt = self.centre.tie_side_mm - self.frame.hub.hub_pad_depth_mm;
        let dz = zu - zl;
        let xc = xt - ((r1 + r2).powi(2) - dz * dz).max(0.04).sqrt();
        let tangent = 180.0 + libm::asin((dz / (r1 + r2)).clamp(-1.0, 1.0)).to_degrees();
        let mut right = vec![sharp(xc, zt - 0.3)];
        right.extend(arc([xc, zl], r1, -90.0, tangent - 180.0));
        right.extend(arc([xt, zu], r2, tangent, 90.0).into_iter().skip(1));
        right.push(sharp(xt, h + 1.0));
        let forward = self.centre.places.forward_mm;
        let front: Vec<Corner> = right.iter().map(|([y, z], r)| ([y + forward, *z], *r)).collect();
        let [across, along] = [right, front].map(|half| face(&[mirrored(&half), half].concat()));
        let wide = 3.0 * self.centre.flank_mm;
        Feature::intersection([along_y(across, [-wide - forward, wide + forward]), along_x(along, [-wide - 1.0, wide + 1.0])])
    }

    /// The plate of a square hub, or one in each half and what is between them.
    fn plates(&self) -> Vec<Feature> {
        let apart = self.centre.places.forward_mm;
        if !self.centre.places.are_apart() {
            return vec![self.plate()];
        }
        let (side, low) = (self.centre.tie_side_mm, -self.centre.hub_half_height_mm - 5.0 * SINK_MM);
        let between = Feature::cuboid_between([-side, -apart, low], [side, apart, self.centre.plate_top_mm - SINK_MM]);
        vec![self.moved(true, self.plate()), self.moved(false, self.plate()), quarter(between, -45.0)]
    }

    fn plate(&self) -> Feature {
        let (edge, zt, re) = (self.centre.plate_edge_mm, self.centre.plate_top_mm, self.edge_mm());
        let side = |low: f64, high: f64| face(&[([-edge, low], re), ([edge, low], re), sharp(edge, high), sharp(-edge, high)]);
        let low = -self.centre.hub_half_height_mm - 3.0 * SINK_MM;
        let reach = [-edge - 5.0, edge + 5.0];
        Feature::intersection([along_y(side(low, zt), reach), along_x(side(low - SINK_MM, zt + 1.0), reach)])
    }

    /// Fillets in the plan outline between the plate's edge and the bosses.
    fn corner_fillets(&self) -> Vec<Feature> {
        let (s, t) = (self.centre.plate_edge_mm - 2.0 * SINK_MM, self.inner_flank_mm() + 2.0 * SINK_MM);
        if s + FILLET_MM >= self.frame.hub.hub_mouth_mm - 0.5 {
            return Vec::new();
        }
        let mut outline = vec![sharp(s - 0.5, t - FILLET_MM), sharp(s, t - FILLET_MM)];
        outline.extend(arc([s + FILLET_MM, t - FILLET_MM], FILLET_MM, 180.0, 90.0).into_iter().skip(1));
        outline.extend([sharp(s + FILLET_MM, t + 0.4), sharp(s - 0.5, t + 0.4)]);
        let one = upright(face(&outline), [0.6 * self.edge_mm() - self.centre.hub_half_height_mm, self.centre.plate_top_mm - 0.05]);
        let two = Feature::union([one.clone(), one.mirrored(Vector3::y())]);
        (0..4).map(|i| self.in_module(i, two.clone())).collect()
    }

    fn ears(&self) -> Vec<Feature> {
        let (r, h, re) = (self.frame.hub.tie_ring_radius_mm, self.centre.hub_half_height_mm + 4.0 * SINK_MM, self.edge_mm());
        let ear = Feature::revolve(face(&[sharp(0.0, -h), ([r, -h], re), ([r, h], re), sharp(0.0, h)]))
            .turned_z(Angle::deg(180.0 / f64::from(SEGMENTS_PER_TURN)))
            .at(self.centre.tie_side_mm, 0.0, 0.0);
        let at = |i: u8| quarter(ear.clone(), 90.0 * f64::from(i) - 45.0);
        // Those at the sides stay, in the middle of the bars.
        (0..4).map(|i| if i % 2 == 0 { at(i) } else { self.moved(i == 1, at(i)) }).collect()
    }

    fn holes(&self) -> Vec<Feature> {
        let (h, zt, half) = (self.centre.hub_half_height_mm, self.centre.plate_top_mm, 0.5 * self.frame.hub.stack_pattern_mm);
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
        for (x, y) in [(half, half), (-half, half), (-half, -half), (half, -half)] {
            let hub = &self.frame.hub;
            let pilot = bore(x, y, hub.stack_pilot_diameter_mm, [-h - 1.0, zt + 1.0]);
            let counterbore = bore(x, y, hub.stack_counterbore_diameter_mm, [zt - hub.stack_counterbore_depth_mm, zt + 2.0 * h]);
            holes.extend([pilot, counterbore].map(|hole| quarter(hole, -45.0)));
        }
        holes
    }

    fn edge_mm(&self) -> f64 {
        self.frame.hub.hub_edge_radius_mm.min(self.frame.hub.hub_plate_thickness_mm - 0.5).min(self.centre.hub_half_height_mm - 0.3)
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
