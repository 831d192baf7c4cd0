//! Names of the printed parts.

use serde::{Deserialize, Serialize};

/// A printed part of the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PartName {
    /// Corner of the top ring: two cage rods, a strut that folds.
    TopCorner,
    /// Corner of the bottom ring: as the top one, and the leg.
    BottomCorner,
    /// Joint of two struts, snapped onto the fork.
    Knee,
    /// End of an arm pair, with the bar that snaps into the knee.
    Fork,
    /// Slides on an arm pair and carries a motor.
    MotorMount,
    /// Joint between hub, arm pair and leg.
    HubJoint,
    /// The rigid centre.
    Hub,
    /// Carries the computer.
    PiCarrier,
    /// Hangs the sleeve under the hub.
    BatteryBracket,
    /// Takes the battery.
    BatterySleeve,
    /// Stays on the battery.
    BatteryLid,
    /// Left camera connector.
    CameraConnectorLeft,
    /// Right camera connector.
    CameraConnectorRight,
}

impl PartName {
    /// Every printed part, in the order of the tables.
    pub const ALL: [Self; 13] = [
        Self::TopCorner,
        Self::BottomCorner,
        Self::Knee,
        Self::Fork,
        Self::MotorMount,
        Self::HubJoint,
        Self::Hub,
        Self::PiCarrier,
        Self::BatteryBracket,
        Self::BatterySleeve,
        Self::BatteryLid,
        Self::CameraConnectorLeft,
        Self::CameraConnectorRight,
    ];

    /// The name in files.
    pub fn slug(self) -> &'static str {
        match self {
            Self::TopCorner => "top_corner",
            Self::BottomCorner => "bottom_corner",
            Self::Knee => "knee",
            Self::Fork => "fork",
            Self::MotorMount => "motor_mount",
            Self::HubJoint => "hub_joint",
            Self::Hub => "hub",
            Self::PiCarrier => "pi_carrier",
            Self::BatteryBracket => "battery_bracket",
            Self::BatterySleeve => "battery_sleeve",
            Self::BatteryLid => "battery_lid",
            Self::CameraConnectorLeft => "camera_connector_left",
            Self::CameraConnectorRight => "camera_connector_right",
        }
    }

    /// How many the frame has.
    pub fn quantity(self) -> u32 {
        if self.is_flexible() { 4 } else { 1 }
    }

    /// Whether the part is printed of the flexible material.
    pub fn is_flexible(self) -> bool {
        matches!(self, Self::TopCorner | Self::BottomCorner | Self::Knee | Self::Fork | Self::MotorMount | Self::HubJoint)
    }
}

impl std::fmt::Display for PartName {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(self.slug())
    }
}
