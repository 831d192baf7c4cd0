//! The catalogue of printed parts.

use super::record::PrintedPart;
use super::{
    accessory_plate, battery_bracket, battery_lid, battery_sleeve, bottom_corner, camera_connector, fork, hub, hub_joint, knee,
    motor_mount, pi_carrier, top_corner,
};
use crate::params::PartName;

/// The record of a part.
pub fn record(name: PartName) -> &'static PrintedPart {
    match name {
        PartName::TopCorner => &top_corner::PART,
        PartName::BottomCorner => &bottom_corner::PART,
        PartName::Knee => &knee::PART,
        PartName::Fork => &fork::PART,
        PartName::MotorMount => &motor_mount::PART,
        PartName::HubJoint => &hub_joint::PART,
        PartName::Hub => &hub::PART,
        PartName::PiCarrier => &pi_carrier::PART,
        PartName::BatteryBracket => &battery_bracket::PART,
        PartName::BatterySleeve => &battery_sleeve::PART,
        PartName::BatteryLid => &battery_lid::PART,
        PartName::CameraConnectorLeft => &camera_connector::LEFT,
        PartName::CameraConnectorRight => &camera_connector::RIGHT,
        PartName::AccessoryPlate => &accessory_plate::PART,
    }
}

/// Every part, in the order of the tables.
pub fn catalogue() -> [&'static PrintedPart; PartName::ALL.len()] {
    PartName::ALL.map(record)
}
