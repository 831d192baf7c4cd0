//! Names of the printed parts.

use serde::{Deserialize, Serialize};

/// The parts with what each is and its name in files, in the order of the tables.
macro_rules! part_names {
    ($( $(#[doc = $doc:literal])+ $part:ident = $slug:literal, )+) => {
        /// A printed part of the frame.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
        pub enum PartName {
            $( $(#[doc = $doc])+ #[serde(rename = $slug)] $part, )+
        }

        impl PartName {
            /// Every printed part, in the order of the tables.
            pub const ALL: [Self; [$($slug),+].len()] = [$(Self::$part),+];

            /// The name in files.
            pub fn slug(self) -> &'static str {
                match self {
                    $( Self::$part => $slug, )+
                }
            }
        }
    };
}

part_names! {
    /// Corner of the top ring: two cage rods, a strut that folds.
    TopCorner = "top_corner",
    /// Corner of the bottom ring: as the top one, and the leg.
    BottomCorner = "bottom_corner",
    /// Joint of two struts, snapped onto the fork.
    Knee = "knee",
    /// End of an arm pair, with the bar that snaps into the knee.
    Fork = "fork",
    /// Slides on an arm pair and carries a motor.
    MotorMount = "motor_mount",
    /// Joint between hub, arm pair and leg.
    HubJoint = "hub_joint",
    /// The rigid centre.
    Hub = "hub",
    /// Carries the computer.
    PiCarrier = "pi_carrier",
    /// Hangs the sleeve under the hub.
    BatteryBracket = "battery_bracket",
    /// Takes the battery.
    BatterySleeve = "battery_sleeve",
    /// Stays on the battery.
    BatteryLid = "battery_lid",
    /// Left camera connector.
    CameraConnectorLeft = "camera_connector_left",
    /// Right camera connector.
    CameraConnectorRight = "camera_connector_right",
    /// Carries receiver, buzzer, GPS and a camera for goggles.
    AccessoryPlate = "accessory_plate",
}

impl std::fmt::Display for PartName {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(self.slug())
    }
}
