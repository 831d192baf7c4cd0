//! Bought parts go together: rods with what the bill of materials says they are, screws with the holes and threads that take them,
//! boards with the holes that carry them, propellers with their motors and inside of the cage, the battery, magnets and power connector with the sizes that the frame is
//! made for. A warning is given of accessories that stand out of the cage, of a slender mast, and of rods, plugs, magnets and a connector that nothing holds.
//!
//! What is compared is what the catalogue states and what the frame has. A figure that an entry does not state is not compared.

mod above_ring;
mod battery;
mod carrier;
mod comparison;
mod connector;
mod holes;
mod loose;
mod made_for;
mod pockets;
mod propellers;
mod rods;
mod screws;

use above_ring::{FPV_CAMERA, MAST, RISER, SLENDER};
use battery::{HEIGHT, LENGTH, WIDTH};
use carrier::{CARRIER_HOLES, ON_BOARD, ON_FEET};
use comparison::ID;
use connector::HALVES;
use holes::{
    CAMERA_ALONE, CAMERA_HOLES, COMPUTER_ALONE, COMPUTER_HOLES, CONNECTOR_HOLES, FLIGHT_HOLES, MOTOR_HOLES, PLATE_HOLES, SENSOR_ALONE,
    SENSOR_HOLES, SHAFT, SLOTS, STACK_HOLES, TIED,
};
use loose::{GRIP, PLUGS, SLIDE};
use made_for::{CONNECTOR, MAGNET, PROPELLER};
use pockets::{APART, CLEARANCE, STEP};
use propellers::{CAGE, SEAT};
use rods::{ROD, ROD_ALONE, STOCK};
use screws::{MOTOR_HEAD, MOTOR_LENGTH, MOTOR_THREAD, ON_STACK, STACK_FLOOR, STACK_HEAD, STACK_LENGTH, STACK_THREAD};

use super::finding::Finding;
use super::rule::{Blame, Found, InSearch, Levers, Pass, Rule};
use super::scene::Scene;

pub static RULE: Rule = Rule {
    id: ID,
    title: "Hardware",
    requires: "bought parts fit each other and what holds them",
    units: &["mm", "%"],
    limits: &[],
    levers: Levers::Sets(&[
        ROD,
        ROD_ALONE,
        STOCK,
        MOTOR_THREAD,
        MOTOR_LENGTH,
        MOTOR_HEAD,
        SHAFT,
        STACK_THREAD,
        ON_STACK[0].2,
        ON_STACK[1].2,
        ON_STACK[2].2,
        STACK_HEAD,
        STACK_FLOOR,
        STACK_LENGTH,
        FLIGHT_HOLES,
        STACK_HOLES,
        SEAT,
        CAGE,
        MOTOR_HOLES,
        COMPUTER_HOLES,
        CAMERA_HOLES,
        SENSOR_HOLES,
        COMPUTER_ALONE,
        CAMERA_ALONE,
        SENSOR_ALONE,
        CARRIER_HOLES,
        ON_BOARD,
        ON_FEET,
        CONNECTOR_HOLES,
        PLATE_HOLES,
        TIED,
        SLOTS,
        MAST,
        SLENDER,
        FPV_CAMERA,
        RISER,
        LENGTH,
        WIDTH,
        HEIGHT,
        PROPELLER,
        MAGNET[0],
        MAGNET[1],
        MAGNET[2],
        CONNECTOR[0],
        CONNECTOR[1],
        HALVES,
        GRIP,
        PLUGS,
        SLIDE,
        CLEARANCE,
        APART,
        STEP,
    ]),
    blame: Blame::Levers,
    in_search: InSearch::Constraints {
        subjects: &[
            "rod",
            "screw",
            "holes",
            "ties",
            "propellers on",
            "propellers in",
            "battery",
            "made for",
            "connector: the shorter half",
        ],
        binds: false,
    },
    found: Found::By(&[Pass::quick(check)]),
};

pub(super) fn check(scene: &Scene) -> Vec<Finding> {
    let mut found = rods::rods(&scene.design.frame);
    found.extend(rods::stock(scene));
    found.extend(screws::motor_screws(&scene.design.frame));
    found.extend(screws::stack_screws(scene));
    found.extend(holes::stack_holes(scene));
    found.extend(holes::small_holes(&scene.design.frame));
    found.extend(holes::holes(&scene.design.frame));
    found.extend(holes::tied(scene));
    found.extend(carrier::holes(&scene.design.frame));
    found.extend(carrier::engagement(&scene.design.frame));
    found.extend(holes::small_printed_holes(&scene.design.frame));
    found.extend(propellers::seat(&scene.design.frame));
    found.extend(propellers::cage(scene));
    found.extend(above_ring::propellers(scene));
    found.extend(above_ring::accessories(scene));
    found.extend(above_ring::mast(&scene.design.frame));
    found.extend(battery::sizes(&scene.design.frame));
    found.extend(made_for::sizes(&scene.design.frame));
    found.extend(connector::halves(scene));
    found.extend(pockets::held(&scene.design.frame));
    found.extend(loose::rods_and_plugs(&scene.design.frame));
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::{Planted, violated};
    use crate::params::Frame;
    use crate::params::catalogue::BoughtPart;

    pub(super) fn broken(change: impl FnOnce(&mut Frame)) -> Vec<String> {
        violated(&Planted::frame(change).found(check)).into_iter().map(|f| f.subject).collect()
    }

    pub(super) fn own(frame: &mut Frame, role: &str, change: impl FnOnce(&mut BoughtPart)) {
        change(&mut frame.bought.get_mut(role).expect("has one").part);
    }
}
