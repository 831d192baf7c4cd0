//! The frame as meant: every number present and within its bounds.

use super::groups::*;

/// A frame, checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Rods.
    pub rods: RodParameters,
    /// Clearances.
    pub fit: FitParameters,
    /// Ring corners.
    pub corner: CornerParameters,
    /// Hub joints.
    pub hub_joint: HubJointParameters,
    /// Forks.
    pub fork: ForkParameters,
    /// Knees.
    pub knee: KneeParameters,
    /// Motor mounts and propellers.
    pub motor_mount: MotorMountParameters,
    /// Hub plate.
    pub hub: HubParameters,
    /// Computer carrier.
    pub pi_carrier: CarrierParameters,
    /// Battery size.
    pub battery: BatteryParameters,
    /// Battery sleeve.
    pub sleeve: SleeveParameters,
    /// Battery bracket.
    pub bracket: BracketParameters,
    /// Battery lid.
    pub lid: LidParameters,
    /// Camera connectors.
    pub camera: CameraParameters,
    /// Limits.
    pub limits: LimitParameters,
}
