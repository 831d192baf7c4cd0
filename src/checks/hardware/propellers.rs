//! Propellers stand on their motors, inside of the cage.

use std::f64::consts::FRAC_1_SQRT_2;

use super::comparison::{measure, part};
use crate::checks::finding::Finding;
use crate::checks::scene::{Placed, Scene, bounds_of};
use crate::frame::assembly::BodyKind;
use crate::params::Frame;

pub(super) const SEAT: &[&str] = &["motor_mount.propeller_height_mm"];
pub(super) const CAGE: &[&str] = &["rods.cage_rod_length_mm", "motor_mount.motor_position_mm", "bought.propeller"];

/// Most air between a motor and its propeller, mm: shafts of such motors reach some 5 mm beyond them, and the hub needs most of it.
const AIR_MM: f64 = 2.0;

/// A propeller stands on its motor, neither in it nor above it.
pub(super) fn seat(frame: &Frame) -> Vec<Finding> {
    let (Some(motor), Some(propeller)) = (part(frame, "motor"), part(frame, "propeller")) else { return Vec::new() };
    let under = frame.motor_mount.propeller_height_mm - 0.5 * propeller.hub_mm();
    let air = measure(under, motor.motor_height_mm(), "mm", SEAT);
    let [height, top] = air.figures(2);
    let message = format!("the underside of the propeller is {height} mm above the motor's seat, the motor is {top} mm high");
    let above = measure(under - motor.motor_height_mm(), AIR_MM, "mm", SEAT);
    let [gap, most] = above.figures(2);
    let reached = format!("the underside of the propeller is {gap} mm above the motor, its shaft carries it up to {most} mm");
    vec![air.at_least("propellers on the motors".into(), message), above.at_most("propellers on the motors: air".into(), reached)]
}

/// No propeller reaches out of the ring that keeps it off walls.
pub(super) fn cage(scene: &Scene) -> Option<Finding> {
    let ring = |p: &&Placed| matches!(p.shape.kind, BodyKind::Rod(role) if role.is_cage());
    let cage = bounds_of(scene.placed.iter().filter(ring))?;
    let mount = &scene.design.frame.motor_mount;
    let wide = measure(
        2.0 * (mount.motor_position_mm * FRAC_1_SQRT_2) + mount.propeller_diameter_mm,
        (cage.high[0] - cage.low[0]).min(cage.high[1] - cage.low[1]),
        "mm",
        CAGE,
    );
    let [sweep, cage_mm] = wide.figures(2);
    let message = format!("the propellers sweep {sweep} mm across, the cage that keeps them off a wall is {cage_mm} mm wide");
    Some(wide.at_most("propellers in the cage".into(), message))
}

#[cfg(test)]
mod tests {
    use crate::checks::hardware::tests::broken;

    #[test]
    fn planted_propellers_in_the_motor_and_out_of_the_cage() {
        assert_eq!(broken(|frame| frame.motor_mount.propeller_height_mm = 13.0), ["propellers on the motors"]);
        assert_eq!(broken(|frame| frame.motor_mount.propeller_height_mm = 22.0), ["propellers on the motors: air"]);
        assert_eq!(broken(|frame| frame.motor_mount.propeller_diameter_mm = 120.0), ["propellers in the cage"]);
    }
}
