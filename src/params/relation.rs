//! Numbers that are each allowed but cannot be together: walls that would vanish, parts that would collide.

use super::frame::Frame;
use super::refusal::Reason;
use crate::figures::told_apart;

/// A relation that does not hold.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{reason}")]
pub struct BrokenRelation {
    /// The parameter to change.
    pub key: &'static str,
    /// What is wrong.
    pub reason: Box<Reason>,
}

/// Thinnest wall that any part can be made with, mm: below, it is no wall to a slicer with the smallest common nozzle.
const THINNEST_MM: f64 = 0.4;

/// Most play of the knee between the fork's cheeks, mm: chosen; the real one has 0.2 mm.
const CHEEK_PLAY_MM: f64 = 1.0;

/// A number that follows from a frame's parameters and must not be less than another.
struct Relation {
    /// The parameter to change.
    key: &'static str,
    /// What the number is, in words.
    what: &'static str,
    /// What to do, and where it needs saying, what would happen.
    remedy: &'static str,
    /// Whether it is asked of a frame.
    of: fn(&Frame) -> bool,
    /// The number, mm.
    value_mm: fn(&Frame) -> f64,
    /// Its least, mm.
    least_mm: fn(&Frame) -> f64,
}

const ANY: fn(&Frame) -> bool = |_| true;
const WITH_COMPUTER: fn(&Frame) -> bool = |frame| frame.bought.contains_key("computer");

/// The relations that hold for every frame, in the order in which they are asked.
static RELATIONS: [Relation; 19] = [
    Relation {
        key: "hub_joint.hub_joint_diameter_mm",
        what: "the wall of the hub joint's sockets",
        remedy: "raise hub_joint_diameter_mm or lower rod_diameter_mm",
        of: ANY,
        value_mm: |f| 0.5 * (f.hub_joint.hub_joint_diameter_mm - f.slide_bore_mm()),
        least_mm: |_| THINNEST_MM,
    },
    Relation {
        key: "motor_mount.motor_ring_diameter_mm",
        what: "the wall of the motor mount's rings",
        remedy: "raise motor_ring_diameter_mm or lower rod_diameter_mm",
        of: ANY,
        value_mm: |f| 0.5 * (f.motor_mount.motor_ring_diameter_mm - f.slide_bore_mm()),
        least_mm: |_| THINNEST_MM,
    },
    Relation {
        key: "hub_joint.arm_pitch_mm",
        what: "the gap between arm sockets and leg socket",
        remedy: "raise arm_pitch_mm or lower hub_joint_diameter_mm: the necks need the room",
        of: ANY,
        value_mm: |f| 0.5 * f.hub_joint.arm_pitch_mm - f.hub_joint.hub_joint_diameter_mm,
        least_mm: |_| 2.0,
    },
    Relation {
        key: "hub_joint.neck_thickness_mm",
        what: "the waist of the necks",
        remedy: "lower neck_thickness_mm or raise hub_joint_diameter_mm",
        of: ANY,
        value_mm: |f| f.hub_joint.hub_joint_diameter_mm - f.hub_joint.neck_thickness_mm,
        least_mm: |_| 0.4,
    },
    Relation {
        key: "motor_mount.motor_plate_diameter_mm",
        what: "the rim outside the motor's screw holes, both sides together,",
        remedy: "raise motor_plate_diameter_mm or lower motor_hole_circle_mm",
        of: ANY,
        value_mm: |f| f.motor_mount.motor_plate_diameter_mm - f.motor_mount.motor_hole_circle_mm - f.motor_mount.motor_hole_diameter_mm,
        least_mm: |f| 2.0 * f.motor_mount.motor_skirt_wall_mm,
    },
    Relation {
        key: "motor_mount.motor_hole_circle_mm",
        what: "the ring between shaft hole and screw holes, both sides together,",
        remedy: "raise motor_hole_circle_mm or lower motor_shaft_hole_mm",
        of: ANY,
        value_mm: |f| f.motor_mount.motor_hole_circle_mm - f.motor_mount.motor_hole_diameter_mm - f.motor_mount.motor_shaft_hole_mm,
        least_mm: |_| 2.0 * THINNEST_MM,
    },
    Relation {
        key: "motor_mount.motor_plate_diameter_mm",
        what: "the room beside the motor plate",
        remedy: "raise arm_pitch_mm or lower motor_plate_diameter_mm",
        of: ANY,
        value_mm: |f| f.hub_joint.arm_pitch_mm - f.motor_mount.motor_plate_diameter_mm,
        least_mm: |f| f.slide_bore_mm() + 1.0,
    },
    Relation {
        key: "hub_joint.hub_leg_mouth_mm",
        what: "the gap between the leg's root and the hub",
        remedy: "raise hub_leg_mouth_mm, or lower hub_leg_socket_depth_mm or hub_leg_root_mm",
        of: ANY,
        value_mm: |f| f.hub_joint.hub_leg_mouth_mm - f.hub_joint.hub_leg_socket_depth_mm - f.hub_joint.hub_leg_root_mm,
        least_mm: |_| 0.5,
    },
    Relation {
        key: "hub.hub_mouth_mm",
        what: "the distance of the plug bores' mouths from the hub axis",
        remedy: "raise hub_mouth_mm, or lower arm_pitch_mm or plug_length_mm: the bores of neighbouring arms would meet",
        of: ANY,
        value_mm: |f| f.hub.hub_mouth_mm,
        least_mm: Frame::least_mouth_mm,
    },
    Relation {
        key: "pi_carrier.carrier_bar_width_mm",
        what: "what the tie rings reach beyond the carrier's bars",
        remedy: "lower carrier_bar_width_mm or raise tie_ring_radius_mm: the bars' edges would pass the rings",
        of: WITH_COMPUTER,
        value_mm: |f| f.hub.tie_ring_radius_mm * std::f64::consts::SQRT_2 - f.pi_carrier.carrier_bar_width_mm,
        least_mm: |_| 0.05,
    },
    Relation {
        key: "pi_carrier.pi_pattern_across_mm",
        what: "the carrier's reach across",
        remedy: "choose a computer with a narrower hole pattern or raise arm_pitch_mm: no bar reaches its holes",
        of: WITH_COMPUTER,
        value_mm: |f| f.tie_side_mm() + f.hub.tie_ring_radius_mm - 0.3 - 0.5 * f.pi_carrier.carrier_strut_width_mm,
        least_mm: |f| 0.5 * f.pi_carrier.pi_pattern_across_mm,
    },
    Relation {
        key: "motor_mount.motor_position_mm",
        what: "the motor's distance from the hub axis",
        remedy: "raise motor_position_mm: the mount's rings would run into the hub joint",
        of: ANY,
        value_mm: |f| f.motor_mount.motor_position_mm,
        least_mm: |f| f.hub.hub_mouth_mm + f.hub_joint.hub_arm_socket_depth_mm + 0.5 * f.motor_mount.motor_ring_width_mm,
    },
    Relation {
        key: "fork.fork_bar_height_mm",
        what: "the wall above the fork's bores",
        remedy: "raise fork_bar_height_mm or lower rod_diameter_mm",
        of: ANY,
        value_mm: |f| 0.5 * (f.fork.fork_bar_height_mm - f.grip_bore_mm()),
        least_mm: |_| THINNEST_MM,
    },
    Relation {
        key: "fork.fork_socket_depth_mm",
        what: "the arm rod's hold in the fork",
        remedy: "raise fork_socket_depth_mm or lower arm_rod_slack_mm",
        of: ANY,
        value_mm: |f| f.fork.fork_socket_depth_mm - f.rods.arm_rod_slack_mm,
        least_mm: |_| 2.0,
    },
    Relation {
        key: "fork.fork_cheek_gap_mm",
        what: "the knee, with a millimetre of play between the fork's cheeks,",
        remedy: "lower fork_cheek_gap_mm or raise knee_side_wall_mm: nothing would guide the knee",
        of: ANY,
        value_mm: |f| f.grip_bore_mm() + 2.0 * f.knee.knee_side_wall_mm + CHEEK_PLAY_MM,
        least_mm: |f| f.fork.fork_cheek_gap_mm,
    },
    Relation {
        key: "bracket.wire_hole_pitch_up_mm",
        what: "the wall below the bracket's lowest wire holes",
        remedy: "lower wire_hole_pitch_up_mm or wire_hole_diameter_mm, or raise bracket_floor_mm or bracket_wall_mm",
        of: ANY,
        value_mm: |f| f.lowest_wire_holes_mm() - 0.5 * f.bracket.wire_hole_diameter_mm,
        least_mm: |_| 0.0,
    },
    Relation {
        key: "sleeve.lug_front_mm",
        what: "the distance of the front lugs' edges from the sleeve's rim",
        remedy: "raise lug_front_mm or lower lug_width_mm: the lugs would stand out beyond the rim",
        of: ANY,
        value_mm: |f| f.sleeve.lug_front_mm - 0.5 * f.sleeve.lug_width_mm,
        least_mm: |_| 0.0,
    },
    Relation {
        key: "sleeve.lug_rear_mm",
        what: "the distance of the rear lugs' edges from the sleeve's rim",
        remedy: "raise lug_rear_mm or lower lug_width_mm: the lugs would stand out beyond the rim",
        of: ANY,
        value_mm: |f| f.sleeve.lug_rear_mm - 0.5 * f.sleeve.lug_width_mm,
        least_mm: |_| 0.0,
    },
    Relation {
        key: "corner.corner_hinge_thickness_mm",
        what: "the notch above the hinge's web",
        remedy: "lower corner_hinge_thickness_mm: the web would fill the socket's height",
        of: ANY,
        value_mm: |f| f.corner.corner_wall_mm + 0.5 * f.grip_bore_mm() + 0.6 - f.corner.corner_hinge_thickness_mm,
        least_mm: |_| 0.0,
    },
];

/// The relations in which the lengths of rods are.
static OF_LENGTHS: [Relation; 2] = [
    Relation {
        key: "motor_mount.motor_position_mm",
        what: "the way left between motor mount and fork",
        remedy: "lower motor_position_mm or raise {longer}: the mount's rings would run into the fork",
        of: ANY,
        value_mm: |f| {
            let mount = &f.motor_mount;
            f.fork_bottom_mm() - f.fork.fork_socket_depth_mm - 0.5 * mount.motor_ring_width_mm - mount.motor_position_mm
        },
        least_mm: |_| 0.0,
    },
    Relation {
        key: "pi_carrier.pi_pattern_along_mm",
        what: "the reach of the computer's holes",
        remedy: "choose a computer with a longer hole pattern, or lower arm_pitch_mm or cage_side_ratio: its holes would lie inside the \
                 carrier's bars",
        of: WITH_COMPUTER,
        value_mm: |f| 0.5 * (f.pi_carrier.pi_pattern_along_mm + f.pi_carrier.pi_pattern_across_mm * tie_front_mm(f) / f.tie_side_mm()),
        least_mm: |f| tie_front_mm(f) + f.pi_carrier.carrier_bar_width_mm + f.pi_carrier.carrier_pad_radius_mm,
    },
];

/// From the hub's axis to its ties in front, mm.
fn tie_front_mm(frame: &Frame) -> f64 {
    frame.tie_side_mm() + 0.5 * frame.rods.cage_rod_length_mm * (frame.rods.cage_side_ratio - 1.0)
}

/// Checks every relation, but those of rod lengths that follow from a target size: their lengths are not known yet.
pub(super) fn hold(frame: &Frame) -> Result<(), BrokenRelation> {
    if frame.target.is_none() {
        lengths_hold(frame)?;
    }
    battery_mass(frame)?;
    RELATIONS.iter().try_for_each(|relation| relation.holds(frame))
}

/// Checks the relations in which the lengths of rods are, once these are known.
///
/// # Errors
/// The first that does not hold.
pub fn lengths_hold(frame: &Frame) -> Result<(), BrokenRelation> {
    OF_LENGTHS.iter().try_for_each(|relation| relation.holds(frame))
}

impl Relation {
    fn holds(&self, frame: &Frame) -> Result<(), BrokenRelation> {
        if !(self.of)(frame) {
            return Ok(());
        }
        // The length of the arm rods follows from a target.
        let longer = if frame.target.is_some() { "target.width_mm" } else { "arm_rod_length_mm" };
        at_least((self.value_mm)(frame), (self.least_mm)(frame), self.key, self.what, &self.remedy.replace("{longer}", longer))
    }
}

fn at_least(value: f64, least: f64, key: &'static str, what: &str, remedy: &str) -> Result<(), BrokenRelation> {
    // Differences of decimals are not exact: 0.5 (4.6 - 3.8) is a little less than 0.4.
    if value >= least - 1e-9 {
        return Ok(());
    }
    let [value, least] = told_apart(value, least, 2);
    let message = format!("{what} would be {value} mm, it must be at least {least} mm");
    Err(BrokenRelation { key, reason: Box::new(Reason::Impossible { message, remedy: remedy.into() }) })
}

/// Least mean density of a battery, g/cm³: lithium cells have 1.4 to 3.
const BATTERY_G_CM3: f64 = 0.05;

/// A battery without mass is one that is weighed with something else; a lighter one than cells is stated in another unit.
fn battery_mass(frame: &Frame) -> Result<(), BrokenRelation> {
    let battery = &frame.battery;
    let cm3 = 1e-3 * battery.battery_length_mm * battery.battery_width_mm * battery.battery_height_mm;
    let g_cm3 = battery.battery_mass_g / cm3;
    if battery.battery_mass_g == 0.0 || g_cm3 >= BATTERY_G_CM3 {
        return Ok(());
    }
    let message = format!(
        "a battery of {} g in {cm3:.1} cm³ has {g_cm3:.2e} g/cm³, it must have at least {BATTERY_G_CM3} g/cm³",
        battery.battery_mass_g
    );
    let remedy = "state its mass in grams, 0 if it is weighed with something else".into();
    Err(BrokenRelation { key: "battery.battery_mass_g", reason: Box::new(Reason::Impossible { message, remedy }) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_what_is_needed_is_enough() {
        assert!(at_least(0.5 * (4.6 - 3.8), 0.4, "", "the wall", "").is_ok());
        let broken = at_least(0.3996, 0.4, "", "the wall", "").expect_err("is too thin");
        assert_eq!(broken.reason.to_string(), "the wall would be 0.3996 mm, it must be at least 0.4000 mm");
    }

    /// A number of a frame, the bound that a relation gives it, whether that is its least, and what the relation is about.
    type Bound = (fn(&mut Frame) -> &mut f64, f64, bool, &'static str);

    /// The bounds of the relations, each solved by hand for one of its numbers, mm.
    fn bounds(frame: &Frame) -> [Bound; 21] {
        let (hub, joint, mount, fork, rods) = (&frame.hub, &frame.hub_joint, &frame.motor_mount, &frame.fork, &frame.rods);
        let carrier = &frame.pi_carrier;
        let (bore_mm, grip_mm) = (rods.rod_diameter_mm + frame.fit.slide_clearance_mm, rods.rod_diameter_mm + frame.fit.grip_clearance_mm);
        let plate_mm = mount.motor_hole_circle_mm + mount.motor_hole_diameter_mm + 2.0 * mount.motor_skirt_wall_mm;
        let arms_mm = (joint.arm_pitch_mm + joint.hub_joint_diameter_mm) / 2.0;
        let side_mm = f64::sqrt(2.0) * (arms_mm + hub.hub_tie_wall_mm);
        let front_mm = side_mm + (rods.cage_side_ratio * rods.cage_rod_length_mm - rods.cage_rod_length_mm) / 2.0;
        let holes_mm = 2.0 * (front_mm + carrier.carrier_bar_width_mm + carrier.carrier_pad_radius_mm);
        let fork_mm = hub.hub_mouth_mm + rods.arm_rod_length_mm + rods.arm_rod_slack_mm - fork.fork_socket_depth_mm;
        let across_mm = 2.0 * side_mm + 2.0 * hub.tie_ring_radius_mm - 0.6 - carrier.carrier_strut_width_mm;
        let bracket = &frame.bracket;
        let channel_mm = bracket.bracket_floor_mm + bracket.connector_height_mm + bracket.bracket_wall_mm;
        let rows_mm = channel_mm + (bracket.magnet_width_mm + bracket.magnet_clearance_mm - bracket.wire_hole_diameter_mm) / 2.0;
        let leg_mm = joint.hub_leg_socket_depth_mm + joint.hub_leg_root_mm + 0.5;
        [
            (|f| &mut f.hub_joint.hub_joint_diameter_mm, bore_mm + 0.8, true, "the wall of the hub joint's sockets"),
            (|f| &mut f.motor_mount.motor_ring_diameter_mm, bore_mm + 0.8, true, "the wall of the motor mount's rings"),
            (|f| &mut f.hub_joint.arm_pitch_mm, 2.0 * joint.hub_joint_diameter_mm + 4.0, true, "the gap between arm sockets"),
            (|f| &mut f.hub_joint.neck_thickness_mm, joint.hub_joint_diameter_mm - 0.4, false, "the waist of the necks"),
            (|f| &mut f.motor_mount.motor_plate_diameter_mm, plate_mm, true, "the rim outside the motor's screw holes"),
            (
                |f| &mut f.motor_mount.motor_hole_circle_mm,
                mount.motor_shaft_hole_mm + mount.motor_hole_diameter_mm + 0.8,
                true,
                "the ring between shaft hole and screw holes",
            ),
            (|f| &mut f.motor_mount.motor_plate_diameter_mm, joint.arm_pitch_mm - bore_mm - 1.0, false, "the room beside the motor plate"),
            (|f| &mut f.hub_joint.hub_leg_mouth_mm, leg_mm, true, "the gap between the leg's root and the hub"),
            (|f| &mut f.hub.hub_mouth_mm, arms_mm + hub.hub_boss_wall_mm + joint.plug_length_mm, true, "the plug bores' mouths"),
            (
                |f| &mut f.pi_carrier.pi_pattern_along_mm,
                holes_mm - carrier.pi_pattern_across_mm * front_mm / side_mm,
                true,
                "the reach of the computer's holes",
            ),
            (|f| &mut f.hub.tie_ring_radius_mm, (carrier.carrier_bar_width_mm + 0.05) / f64::sqrt(2.0), true, "what the tie rings reach"),
            (|f| &mut f.pi_carrier.pi_pattern_across_mm, across_mm, false, "the carrier's reach across"),
            (
                |f| &mut f.motor_mount.motor_position_mm,
                hub.hub_mouth_mm + joint.hub_arm_socket_depth_mm + mount.motor_ring_width_mm / 2.0,
                true,
                "the motor's distance from the hub axis",
            ),
            (|f| &mut f.motor_mount.motor_position_mm, fork_mm - mount.motor_ring_width_mm / 2.0, false, "the way left"),
            (|f| &mut f.fork.fork_bar_height_mm, grip_mm + 0.8, true, "the wall above the fork's bores"),
            (|f| &mut f.fork.fork_socket_depth_mm, rods.arm_rod_slack_mm + 2.0, true, "the arm rod's hold in the fork"),
            (
                |f| &mut f.fork.fork_cheek_gap_mm,
                grip_mm + 2.0 * frame.knee.knee_side_wall_mm + 1.0,
                false,
                "the knee, with a millimetre of play",
            ),
            (|f| &mut f.bracket.wire_hole_pitch_up_mm, rows_mm / 2.0, false, "the wall below the bracket's lowest wire holes"),
            (|f| &mut f.sleeve.lug_front_mm, frame.sleeve.lug_width_mm / 2.0, true, "the front lugs' edges"),
            (|f| &mut f.sleeve.lug_rear_mm, frame.sleeve.lug_width_mm / 2.0, true, "the rear lugs' edges"),
            (|f| &mut f.corner.corner_hinge_thickness_mm, frame.corner.corner_wall_mm + grip_mm / 2.0 + 0.6, false, "the notch above"),
        ]
    }

    #[test]
    fn analytic_each_relation_breaks_just_beyond_its_bound() {
        let (frame, _) = Frame::load("cognifly").expect("a preset");
        for (number, bound_mm, is_least, about) in bounds(&frame) {
            let breaks = |beyond_mm: f64| {
                let mut changed = frame.clone();
                *number(&mut changed) = bound_mm + if is_least { -beyond_mm } else { beyond_mm };
                hold(&changed).is_err_and(|broken| broken.reason.to_string().contains(about))
            };
            assert_eq!([-1e-6, 1e-6].map(breaks), [false, true], "{about}");
        }
    }
}
