//! Words in the texts of mounts that depend on what a frame has bought.

use super::mount::{ALL_IN_ONE, BOTH_CONTROLLERS, TIE};
use crate::params::Frame;

/// Words that stand for a name between braces.
pub(super) struct Fragment {
    /// The name, with its braces.
    name: &'static str,
    /// Roles that are bought, all of them, and the words where they are: the first that fits counts.
    cases: &'static [(&'static [&'static str], &'static str)],
    /// The words where none fits.
    otherwise: &'static str,
}

const CONTROLLER: &str = "motor_controller";
const BOARD: &str = "flight_controller";
const CONNECTOR: &str = "connector";
const MAGNET: &str = "magnet";

/// Roles that a text calls by the extra that stands for them, as `{instead connector}`.
const REPLACED: [&str; 5] = [CONTROLLER, BOARD, CONNECTOR, MAGNET, TIE];

/// All of them.
pub(super) static FRAGMENTS: [Fragment; 24] = [
    Fragment {
        name: "{lid_now}",
        cases: &[(
            &[CONNECTOR],
            "The other one and the lid's power connector may be glued into the lid now, too, as later steps show: then they harden while the frame is folded.",
        )],
        otherwise: "The other one may be glued into the lid now, too, as a later step shows: then it hardens while the frame is folded.",
    },
    Fragment { name: "{rim}", cases: &[(&[MAGNET], "magnet is")], otherwise: "bracket's pocket is" },
    Fragment { name: "{to_dampers}", cases: &[(&["damper"], "the dampers or the board")], otherwise: "the board" },
    Fragment {
        name: "{nothing_bent}",
        cases: &[(&["damper"], "no damper is squeezed flat, and no board is bent")],
        otherwise: "no board is bent",
    },
    Fragment { name: "{with_dampers}", cases: &[(&["damper"], " with its dampers")], otherwise: "" },
    Fragment { name: "{or_dampers}", cases: &[(&["damper"], " or to its dampers")], otherwise: "" },
    Fragment {
        name: "{not_bent_by_it}",
        cases: &[(&["damper"], "No damper is squeezed flat by it, and no board is bent.")],
        otherwise: "No board is bent by it.",
    },
    Fragment {
        name: "{signal_cable}",
        cases: &[(&[BOARD], "")],
        otherwise: "Plug a cable for {instead flight_controller} into the board and let it hang out of the bay: the bill has none. ",
    },
    Fragment { name: "{radio_leads}", cases: &[(&[BOARD], RADIO_UNDER_HUB), (&[ALL_IN_ONE], RADIO_UNDER_HUB)], otherwise: RADIO_ELSEWHERE },
    Fragment { name: "{camera_socket}", cases: &[(&["camera"], ", its camera socket to the front")], otherwise: "" },
    Fragment { name: "{camera_side}", cases: &[(&["camera"], ", the camera to the front")], otherwise: "" },
    Fragment {
        name: "{plate_sides}",
        cases: &[
            (&["gps", "fpv_camera"], ", the mast to the rear, the cheeks to the front"),
            (&["gps"], ", the mast to the rear"),
            (&["fpv_camera"], ", the cheeks to the front"),
            (&["receiver"], ", the receiver's slots to the left"),
        ],
        otherwise: ", the buzzer's slots to the right",
    },
    Fragment {
        name: "{power_leads}",
        cases: &[(
            &[CONNECTOR],
            "Solder the connector's leads to the battery pads of the {power_board} at its {rear}, red to plus, black to minus, as the picture shows.",
        )],
        otherwise: "Solder the leads of {instead connector} to the battery pads of the {power_board} at its {rear}, red to plus, black to minus, and lead them to the {rear}, out of the bay.",
    },
    Fragment { name: "{power_board}", cases: &[(&[ALL_IN_ONE], BOTH_CONTROLLERS)], otherwise: "motor controller" },
    Fragment {
        name: "{power_lengthened}",
        cases: &[(
            &[CONNECTOR],
            "Where the connector's leads, the battery wires of the bill, are too short, lengthen them by wires as thick that reach to {instead motor_controller}, red to plus, black to minus, each joint in shrink tube. ",
        )],
        otherwise: "",
    },
    Fragment {
        name: "{signal_wires}",
        cases: &[(
            &[BOARD],
            "Solder wires for the motors' signals to the flight controller, and those that it gets its own current by, or plug them in: the bill has none. ",
        )],
        otherwise: "",
    },
    Fragment { name: "{hang_out}", cases: &[(&[CONNECTOR], HANG_OUT), (&[BOARD], HANG_OUT)], otherwise: "" },
    Fragment {
        name: "{bracket_sides}",
        cases: &[
            (&[MAGNET, CONNECTOR], "its magnet and its power connector to the {rear}"),
            (&[MAGNET], "its magnet to the {rear}"),
            (&[CONNECTOR], "its power connector to the {rear}"),
        ],
        otherwise: "its pocket for a magnet to the {rear}",
    },
    Fragment {
        name: "{tied}",
        cases: &[
            (&[TIE], ""),
            (&["computer"], " Fasten it and the carrier with {instead tie}."),
            (&["gps"], WITH_THE_PLATE),
            (&["fpv_camera"], WITH_THE_PLATE),
            (&["receiver"], WITH_THE_PLATE),
            (&["buzzer"], WITH_THE_PLATE),
        ],
        otherwise: " Fasten it with {instead tie}.",
    },
    Fragment {
        name: "{fpv_tie}",
        cases: &[(
            &[TIE],
            "Put a tie down through the plate's and the hub's hole in front now, its head in front of the plate: under the camera there is little room for it. ",
        )],
        otherwise: "What of {instead tie} goes through the plate's and the hub's hole in front goes in now: under the camera there is little room for it. ",
    },
    Fragment {
        name: "{controller_wires}",
        cases: &[
            (
                &[CONNECTOR, BOARD],
                "Solder the wires that hang out of the bay to it, too: power, red to plus, black to minus, and the signals by the motors' numbers.",
            ),
            (
                &[CONNECTOR],
                "Solder the battery's wires that hang out of the bay to it, too, red to plus, black to minus, and the motors' signals of {instead flight_controller}.",
            ),
            (
                &[BOARD],
                "Solder the leads of {instead connector} to it, too, red to plus, black to minus, and the signals that hang out of the bay, by the motors' numbers.",
            ),
        ],
        otherwise: "Solder the leads of {instead connector} to it, too, red to plus, black to minus, and the motors' signals of {instead flight_controller}.",
    },
    Fragment { name: "{hardening}", cases: &[(&[CONNECTOR], "magnet and connector")], otherwise: "the magnet" },
    Fragment {
        name: "{lid_home}",
        cases: &[
            (&[MAGNET, CONNECTOR], "until the magnets pull the lid home and the plug is in"),
            (&[MAGNET], "until the magnets pull the lid home, and connect the battery by {instead connector}"),
            (&[CONNECTOR], "until the plug is in, and hold the lid by {instead magnet}"),
        ],
        otherwise: "until the lid is home, hold it by {instead magnet}, and connect the battery by {instead connector}",
    },
    Fragment { name: "{where_joined}", cases: &[(&[CONTROLLER], " where they join along the arm")], otherwise: "" },
];

/// Where a receiver's wires go where a board under the hub flies the frame, and where an extra does.
const RADIO_UNDER_HUB: &str = "Lead its wires down beside the hub, between two bosses, and join them to the leads of a serial port and of 5 V of the board under the hub, or plug them in.";
const RADIO_ELSEWHERE: &str = "Join its wires to a serial port and to 5 V of {instead flight_controller}, or plug them in.";

/// What holds the bracket and the plate where there are no ties.
const WITH_THE_PLATE: &str = " Fasten it and the plate with {instead tie}.";

/// What the bay leaves no room for.
const HANG_OUT: &str = "Let these wires hang out to the {left} and to the {right}: in the closed bay there is no room for an iron. ";

impl Fragment {
    /// The words in a frame.
    fn words(&self, frame: &Frame) -> &'static str {
        let has = |role: &&str| frame.bought.contains_key(*role) || *role == ALL_IN_ONE && frame.is_all_in_one();
        self.cases.iter().find(|(roles, _)| roles.iter().all(has)).map_or(self.otherwise, |(_, words)| words)
    }
}

/// A text with the words for names of fragments, and with extras by their names.
pub(super) fn filled(text: &str, frame: &Frame) -> String {
    let text = FRAGMENTS.iter().fold(text.to_owned(), |text, fragment| text.replace(fragment.name, fragment.words(frame)));
    REPLACED.iter().fold(text, |text, role| text.replace(&format!("{{instead {role}}}"), &instead(frame, role)))
}

/// An extra in a sentence.
pub(super) fn extra_called(name: &str) -> String {
    format!("the extra \"{}\"", name.replace('_', " "))
}

/// What stands for a role of which nothing is bought, in a sentence.
pub(super) fn instead(frame: &Frame, role: &str) -> String {
    let names: Vec<String> = frame.stand_ins(role).map(extra_called).collect();
    if names.is_empty() { format!("what stands for the {}", role.replace('_', " ")) } else { names.join(" and ") }
}
