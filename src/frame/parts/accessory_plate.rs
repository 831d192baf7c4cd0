//! The plate for what people add: receiver and buzzer under ties, a mast for the GPS, two cheeks for a camera on side screws.
//!
//! Frame of reference: the hub's axes, z = 0 at its lower face, which lies on the hub's top, on the four tie holes. It is printed as it
//! lies. Without GPS there is no mast, without camera there are no cheeks. The cheeks stand as far apart as the camera is wide.

use nalgebra::UnitQuaternion;

use super::outline::{SINK_MM, along_x, face, sharp, upright};
use super::record::{Fold, MaterialClass, PrintedPart, Seat, Wall};
use crate::frame::skeleton::{Accessories, Centre, SLOT_MM};
use crate::params::catalogue::BoughtPart;
use crate::params::groups::AccessoryParameters;
use crate::params::{Frame, PartName};
use crate::solid::{Contour, Feature, Profile};

/// The record of the part.
pub static PART: PrintedPart = PrintedPart {
    name: PartName::AccessoryPlate,
    feature: |frame, _, centre| feature(frame, centre),
    material: MaterialClass::Rigid,
    seat: Seat::Centre(Centre::carrier_pose),
    fold: Fold::Stands,
    print_turn: UnitQuaternion::identity,
    needed: Accessories::wanted,
    walls: &[Wall::anywhere(&["accessories.accessory_plate_thickness_mm", "accessories.fpv_cheek_mm", "accessories.mast_diameter_mm"])],
};

/// How far the mast's foot and shelf reach out beyond the mast at the least, mm; both lean out at 45°, which prints without support.
const FLARE_MM: f64 = 2.5;
/// Thickness of the shelf's rim, mm.
const RIM_MM: f64 = 1.2;
/// Half the length of a cheek's foot, and the radius around its hole, mm.
const CHEEK_FOOT_MM: f64 = 6.0;
const CHEEK_EYE_MM: f64 = 4.0;
/// Plate in front of and beside the cheeks, mm.
const AROUND_CHEEKS_MM: f64 = 1.0;

/// The plate of a frame.
pub fn feature(frame: &Frame, centre: &Centre) -> Feature {
    AccessoryPlate { frame, given: &frame.accessories, seats: Accessories::new(frame, centre) }.feature()
}

struct AccessoryPlate<'a> {
    frame: &'a Frame,
    given: &'a AccessoryParameters,
    seats: Accessories,
}

impl AccessoryPlate<'_> {
    fn part(&self, role: &str) -> Option<&BoughtPart> {
        self.frame.bought.get(role).map(|item| &item.part)
    }

    fn feature(&self) -> Feature {
        let plate = upright(self.profile(), [0.0, self.given.accessory_plate_thickness_mm]);
        let above = self.mast().into_iter().chain(self.cheeks());
        Feature::union(std::iter::once(plate).chain(above))
    }

    /// Outline with the tie holes and the slots.
    fn profile(&self) -> Profile {
        let [side, front] = self.seats.tie_mm;
        let hole = |at| Contour::bore(at, 0.5 * self.frame.pi_carrier.carrier_tie_hole_diameter_mm);
        let ties = [[side, 0.0], [0.0, front], [-side, 0.0], [0.0, -front]].map(hole);
        face(&self.outline()).with_holes(ties).with_holes(self.slots())
    }

    /// A square on its corner, longer where the frame is, around the tie holes, with a tongue to the front where cheeks stand.
    fn outline(&self) -> Vec<([f64; 2], f64)> {
        let ([corner, fore], ring) = (self.seats.corner_mm, self.seats.ring_mm);
        // Of an edge, forward for each millimetre towards the middle.
        let slope = fore / corner;
        let mut outline = vec![([corner, 0.0], ring)];
        match self.tongue_mm() {
            Some([half, front]) if front > fore - half * slope => {
                let edge = fore - half * slope;
                outline.extend([sharp(half, edge), ([half, front], 1.0), ([-half, front], 1.0), sharp(-half, edge)]);
            }
            _ => outline.push(([0.0, fore], ring)),
        }
        outline.extend([([-corner, 0.0], ring), ([0.0, -fore], ring)]);
        outline
    }

    /// Half the width and the front end of the tongue; it ends no earlier than the plate's front corner, whose tie hole it has to hold.
    fn tongue_mm(&self) -> Option<[f64; 2]> {
        let outer = self.cheek_mm()?[1] + AROUND_CHEEKS_MM;
        Some([outer.max(self.seats.ring_mm), (self.seats.camera_mm[0] + CHEEK_FOOT_MM + AROUND_CHEEKS_MM).max(self.seats.corner_mm[1])])
    }

    /// From the middle to a cheek's inner and outer side.
    fn cheek_mm(&self) -> Option<[f64; 2]> {
        let inner = 0.5 * (self.part("fpv_camera")?.size_mm[0] + self.given.fpv_clearance_mm);
        Some([inner, inner + self.given.fpv_cheek_mm])
    }

    /// Two slots beside each of receiver and buzzer, for a tie around it; those for which there is no room are left out, and a rule says so.
    fn slots(&self) -> Vec<Contour> {
        let sides = [("receiver", -1.0), ("buzzer", 1.0)].into_iter().filter_map(|(role, side)| Some((self.part(role)?, side)));
        let ([least, most], half) = (self.seats.slot_room_mm(self.frame), 0.5 * SLOT_MM);
        let fits = |x: &f64| x - half >= least && x + half <= most;
        let slot = |x: f64| Contour::rectangle([x, 0.0], [SLOT_MM, self.given.accessory_slot_mm]);
        sides.flat_map(|(part, side)| self.seats.slot_x_mm(part).into_iter().filter(fits).map(move |x| slot(side * x))).collect()
    }

    /// A round column that widens at the foot and under the GPS.
    fn mast(&self) -> Option<Feature> {
        let gps = self.part("gps")?;
        let (low, top) = (self.given.accessory_plate_thickness_mm - SINK_MM, self.seats.shelf_mm - self.seats.low_mm);
        let mast = 0.5 * self.given.mast_diameter_mm;
        let shelf = (0.5 * gps.size_mm[0].min(gps.size_mm[1])).max(mast + FLARE_MM);
        // A low mast is all shelf: its lower side leans out from the plate up.
        let flare = (shelf - mast).min(top - RIM_MM - low);
        let foot = FLARE_MM.min(top - RIM_MM - flare - low);
        let mut side = vec![sharp(0.0, low), sharp(mast + foot, low)];
        if foot > SINK_MM {
            side.push(sharp(mast, low + foot));
        }
        if top - RIM_MM - flare > low + foot + SINK_MM {
            side.push(sharp(mast, top - RIM_MM - flare));
        }
        side.extend([sharp(mast + flare, top - RIM_MM), sharp(mast + flare, top), sharp(0.0, top)]);
        Some(Feature::revolve(face(&side)).at(0.0, self.seats.mast_y_mm, 0.0))
    }

    /// A cheek on each side of the camera, with the hole of its screw.
    fn cheeks(&self) -> Option<Feature> {
        let ([inner, outer], [y, z]) = (self.cheek_mm()?, self.seats.camera_mm);
        let (z, low) = (z - self.seats.low_mm, self.given.accessory_plate_thickness_mm - SINK_MM);
        let eye = CHEEK_EYE_MM.min(z - low);
        let round = 0.98 * eye;
        let side = [sharp(y - CHEEK_FOOT_MM, low), sharp(y + CHEEK_FOOT_MM, low), ([y + eye, z + eye], round), ([y - eye, z + eye], round)];
        let profile = face(&side).with_hole(Contour::bore([y, z], 0.5 * self.given.fpv_hole_diameter_mm));
        Some(Feature::union([along_x(profile.clone(), [inner, outer]), along_x(profile, [-outer, -inner])]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::FrameFile;
    use crate::params::frame_file::Value;
    use crate::solid::{MeshSolid, gate};

    /// The default frame with these accessories, and changes.
    fn frame(roles: &[(&str, &str)], changes: &[(&str, f64)]) -> Frame {
        let mut file = FrameFile::load("cognifly").expect("a preset");
        for (role, name) in [("computer", "none"), ("camera", "none")].iter().chain(roles) {
            file.set(&format!("bought.{role}"), Value::Text((*name).into()));
        }
        changes.iter().for_each(|(key, value)| file.set_number(&format!("accessories.{key}"), *value));
        Frame::resolve(&file).expect("is accepted")
    }

    fn made(frame: &Frame) -> (MeshSolid, i64) {
        let solid = MeshSolid::build(&feature(frame, &Centre::new(frame)));
        let topology = gate::pass(&solid.to_mesh()).unwrap_or_else(|error| panic!("{error}"));
        (solid, topology.euler)
    }

    const ALL: [(&str, &str); 4] =
        [("receiver", "receiver-nano"), ("buzzer", "buzzer-9mm"), ("gps", "gps-22x20"), ("fpv_camera", "fpv-camera-14")];

    #[test]
    fn analytic_each_accessory_brings_what_holds_it_and_nothing_else() {
        // A hole through a part lowers Euler's number by two; four are the ties' own.
        for (roles, holes, height_mm) in [
            (&ALL[..1], 4 + 2, 1.6),
            (&ALL[..2], 4 + 4, 1.6),
            (&ALL[2..3], 4, 41.6),
            (&ALL[3..], 4 + 2, 1.6 + 14.0 + 4.0),
            (&ALL[..], 10, 41.6),
        ] {
            let (solid, euler) = made(&frame(roles, &[]));
            let [low, high] = solid.bounds_mm();
            assert_eq!(euler, 2 - 2 * holes, "{roles:?}");
            assert!((low[2].abs() + (high[2] - height_mm).abs()) < 1e-3, "{roles:?}: {low:?} {high:?}");
        }
    }

    #[test]
    fn analytic_cheeks_stand_as_far_apart_as_the_camera_is_wide() {
        for (camera, wide) in [("fpv-camera-14", 14.0), ("fpv-camera-19", 19.0)] {
            let frame = frame(&[("fpv_camera", camera)], &[]);
            let plate = feature(&frame, &Centre::new(&frame));
            let within = |half: f64| {
                let bar = Feature::cuboid_between([-half, 31.0, 5.0], [half, 33.0, 9.0]);
                MeshSolid::build(&Feature::intersection([plate.clone(), bar])).volume_mm3()
            };
            assert!(within(0.5 * (wide + 0.3) - 0.01) < 1e-6 && within(0.5 * (wide + 0.3) + 0.5) > 7.0, "{camera}");
        }
    }

    #[test]
    fn analytic_masts_of_every_height_are_one_body() {
        for height in [10.0, 12.0, 40.0, 100.0] {
            for diameter in [4.0, 12.0] {
                let changes = [("mast_height_mm", height), ("mast_diameter_mm", diameter)];
                let (solid, euler) = made(&frame(&ALL[2..3], &changes));
                assert_eq!(euler, 2 - 2 * 4, "{changes:?}");
                assert!((solid.bounds_mm()[1][2] - 1.6 - height).abs() < 1e-3, "{changes:?}");
            }
        }
    }
}
