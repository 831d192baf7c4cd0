//! What lies on the accessory plate, and where: receiver to the left, buzzer to the right, the GPS behind on a mast, the camera for
//! goggles in front.
//!
//! The plate lies on the hub where the computer's carrier does, on the same four tie holes. Heights are in the frame's axes, mm.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use super::Centre;
use crate::params::Frame;
use crate::params::catalogue::BoughtPart;
use crate::params::roles::ACCESSORIES;
use crate::units::Angle;

/// The accessory plate's seats.
#[derive(Clone, Debug, PartialEq)]
pub struct Accessories {
    /// From the hub's axis to the tie holes, at the sides and in front.
    pub tie_mm: [f64; 2],
    /// From the hub's axis to the plate's corners, at the sides and in front.
    pub corner_mm: [f64; 2],
    /// Radius of the rings around the tie holes, and of the plate's corners.
    pub ring_mm: f64,
    /// Height of the plate's underside.
    pub low_mm: f64,
    /// Height of its upper face.
    pub top_mm: f64,
    /// The mast's axis behind the hub's.
    pub mast_y_mm: f64,
    /// Height of the mast's upper face.
    pub shelf_mm: f64,
    /// The axis of the camera's side screws, in front of the hub's axis and above it.
    pub camera_mm: [f64; 2],
    /// From the hub's axis to receiver and buzzer, left and right.
    pub side_mm: f64,
}

impl Accessories {
    /// Whether a frame has any of them.
    pub fn wanted(frame: &Frame) -> bool {
        ACCESSORIES.iter().any(|role| frame.bought.contains_key(*role))
    }

    /// The seats of a frame.
    pub fn new(frame: &Frame, centre: &Centre) -> Self {
        let (given, ring_mm) = (&frame.accessories, frame.hub.tie_ring_radius_mm);
        let low_mm = centre.hub_half_height_mm;
        let top_mm = low_mm + given.accessory_plate_thickness_mm;
        Self {
            tie_mm: [centre.tie_side_mm, centre.tie_front_mm],
            // The edges touch the rings.
            corner_mm: [
                centre.tie_side_mm + (1.0 + (centre.tie_side_mm / centre.tie_front_mm).powi(2)).sqrt() * ring_mm,
                centre.tie_front_mm + (1.0 + (centre.tie_front_mm / centre.tie_side_mm).powi(2)).sqrt() * ring_mm,
            ],
            ring_mm,
            low_mm,
            top_mm,
            mast_y_mm: -given.mast_back_mm,
            shelf_mm: top_mm + given.mast_height_mm,
            camera_mm: [given.fpv_forward_mm, top_mm + given.fpv_above_mm],
            side_mm: given.accessory_side_mm,
        }
    }

    /// Where an accessory of a role sits: the middle of its underside, the camera its own middle. Axes are the frame's, the camera's are
    /// tilted up.
    pub fn pose(&self, role: &str, frame: &Frame) -> Option<Isometry3<f64>> {
        Some(match role {
            "receiver" => Isometry3::translation(-self.side_mm, 0.0, self.top_mm),
            "buzzer" => Isometry3::translation(self.side_mm, 0.0, self.top_mm),
            "gps" => Isometry3::translation(0.0, self.mast_y_mm, self.shelf_mm),
            "fpv_camera" => {
                let [y, z] = self.camera_mm;
                let tilt = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), Angle::deg(frame.accessories.fpv_tilt_deg).to_rad());
                Isometry3::from_parts(Translation3::new(0.0, y, z), tilt)
            }
            _ => return None,
        })
    }

    /// Where the two slots beside receiver or buzzer are along x, from the hub's axis to their middle, the inner one first, mm.
    pub fn slot_x_mm(&self, part: &BoughtPart) -> [f64; 2] {
        let beside = 0.5 * part.size_mm[1] + BESIDE_MM + 0.5 * SLOT_MM;
        [self.side_mm - beside, self.side_mm + beside]
    }

    /// Between which distances from the hub's axis both slots have to lie with their whole width, mm: clear of those of the other side,
    /// and of the tie holes.
    pub fn slot_room_mm(&self, frame: &Frame) -> [f64; 2] {
        [0.5 * WALL_MM, self.tie_mm[0] - 0.5 * frame.pi_carrier.carrier_tie_hole_diameter_mm - WALL_MM]
    }
}

/// From a part's side to the slot for its tie, mm: the strap bends there.
const BESIDE_MM: f64 = 0.8;

/// Least plate between two holes, mm.
const WALL_MM: f64 = 1.0;

/// Width of a tie's slot across its strap, mm: the usual small strap is 1.1 mm thick.
pub const SLOT_MM: f64 = 1.6;
