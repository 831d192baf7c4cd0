//! No two bodies share volume beyond the press fits that are meant.
//!
//! Measured by the kernel's boolean intersection. What is meant is in [`press_fit`](crate::frame::assembly::press_fit).
//! Swept discs are the propeller rule's.

use rayon::prelude::*;

use super::finding::{Finding, Measure};
use super::scene::{Placed, Scene};
use crate::frame::assembly::Kind;
use crate::frame::assembly::press_fit::{ROUNDING, TOUCH_MM3, gripped_mm3, plugs_mm3};
use crate::params::PartName;

/// What two bodies share.
#[derive(Clone, Debug, PartialEq)]
pub struct SharedVolume {
    /// The two.
    pub pair: [String; 2],
    /// Shared, mm³.
    pub volume_mm3: f64,
    /// What is meant, and rounding, mm³.
    pub limit_mm3: f64,
    /// What drives the fit.
    pub levers: &'static [&'static str],
}

impl SharedVolume {
    fn finding(&self) -> Finding {
        let Self { pair: [a, b], volume_mm3: value, limit_mm3: limit, levers } = self;
        let measure = Measure { rule: "interference", value: *value, limit: *limit, unit: "mm3", levers };
        let [shared, meant] = measure.figures(3);
        measure.at_most(format!("{a} and {b}"), format!("{a} and {b} share {shared} mm3, {meant} mm3 are meant"))
    }

    fn is_press_fit(&self) -> bool {
        self.limit_mm3 > TOUCH_MM3
    }
}

fn meant(scene: &Scene, a: &Placed, b: &Placed) -> (f64, &'static [&'static str]) {
    let frame = &scene.design.frame;
    for (rod, part) in [(a, b), (b, a)] {
        let (Kind::Rod(_), Kind::Printed(name)) = (&rod.shape.kind, &part.shape.kind) else { continue };
        let rods = scene.design.skeleton.rods.iter().filter(|r| r.name == rod.body.name);
        let ring: f64 = rods.map(|r| gripped_mm3(r, frame.rods.rod_diameter_mm, *name, part.body.module)).sum();
        return (ring * ROUNDING, &["fit.grip_clearance_mm", "fit.slide_clearance_mm", "rods.rod_diameter_mm"]);
    }
    let is = |name| a.is_part(name) || b.is_part(name);
    match () {
        () if is(PartName::Hub) && is(PartName::HubJoint) => {
            (plugs_mm3(frame) * ROUNDING, &["fit.plug_clearance_mm", "hub_joint.plug_length_mm"])
        }
        () if is(PartName::Knee) && is(PartName::Fork) => {
            (0.0, &["knee.knee_window_clearance_height_mm", "knee.knee_window_clearance_depth_mm"])
        }
        () if is(PartName::BatterySleeve) => {
            (0.0, &["battery.battery_clearance_across_mm", "battery.battery_clearance_up_mm", "sleeve.channel_clearance_mm"])
        }
        () => (0.0, &["motor_mount.motor_position_mm", "hub_joint.arm_pitch_mm", "bracket.bay_height_mm"]),
    }
}

pub(super) fn check(scene: &Scene) -> Vec<Finding> {
    let near: Vec<_> = scene
        .pairs()
        .into_iter()
        .filter(|(a, b)| !a.is_propeller() && !b.is_propeller() && a.bounds.distance_mm(&b.bounds) <= 0.0)
        .collect();
    let shared: Vec<SharedVolume> = near
        .par_iter()
        .map(|(a, b)| {
            let (press_fit, levers) = meant(scene, a, b);
            let pair = [a.body.name.clone(), b.body.name.clone()];
            SharedVolume { pair, volume_mm3: a.shared_mm3(b), limit_mm3: press_fit + TOUCH_MM3, levers }
        })
        .collect();
    let (fits, rest): (Vec<_>, Vec<_>) = shared.into_iter().partition(SharedVolume::is_press_fit);
    let (clear, broken): (Vec<_>, Vec<_>) = rest.into_iter().partition(|s| s.volume_mm3 <= s.limit_mm3);
    let mut found: Vec<Finding> = broken.iter().chain(&fits).map(SharedVolume::finding).collect();
    let most = clear.iter().map(|s| s.volume_mm3).fold(0.0, f64::max);
    let measure = Measure { rule: "interference", value: most, limit: TOUCH_MM3, unit: "mm3", levers: &[] };
    let (count, [most, limit]) = (clear.len(), measure.figures(3));
    let message =
        format!("of {count} other pairs of bodies that are near each other none shares more than {most} mm3, {limit} mm3 are rounding");
    found.push(measure.at_most(format!("{count} other near pairs"), message));
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::{Planted, violated};

    #[test]
    fn planted_a_motor_in_its_mount() {
        let mut frame = Planted::preset("cognifly");
        assert_eq!(violated(&frame.found(check)), []);
        frame.move_body("motor_FR", [0.0, 0.0, -0.5]);
        let found = frame.found(check);
        let broken = violated(&found);
        assert!(broken.len() == 1 && broken[0].subject == "motor_mount_FR and motor_FR" && broken[0].value > 10.0, "{broken:?}");
    }

    #[test]
    fn planted_a_rod_pushed_too_deep() {
        let mut frame = Planted::preset("cognifly");
        frame.move_body("cage_FR_top", [-1.0, 0.0, 0.0]);
        assert!(violated(&frame.found(check)).iter().any(|f| f.subject.contains("cage_FR_top")));
    }

    #[test]
    fn analytic_the_hub_turns_with_the_modules() {
        let frame = Planted::preset("cognifly");
        let hub = &frame.design.part(PartName::Hub).expect("has a hub").folded;
        let turn = nalgebra::UnitQuaternion::from_axis_angle(&nalgebra::Vector3::z_axis(), std::f64::consts::FRAC_PI_2);
        let turned = hub.placed(&nalgebra::Isometry3::from_parts(Default::default(), turn));
        // Some of its faces are sunk by hundredths of a millimetre to keep them apart, not the same ones on all sides.
        assert!(hub.minus(&turned).volume_mm3() < 1e-3 * hub.volume_mm3(), "{}", hub.minus(&turned).volume_mm3());
    }
}
