//! The catalogue of mounts: one record each. Nothing here says in which order.

use super::mount::{ALL_IN_ONE, Fixing, Mount, Stage};
use super::tool::Tool;

const ABOVE: Option<[f64; 3]> = Some([0.0, 0.0, 1.0]);
const BELOW: Option<[f64; 3]> = Some([0.0, 0.0, -1.0]);
const FRONT: Option<[f64; 3]> = Some([0.0, 1.0, 0.0]);
const REAR: Option<[f64; 3]> = Some([0.0, -1.0, 0.0]);
const LEFT: Option<[f64; 3]> = Some([-1.0, 0.0, 0.0]);
const RIGHT: Option<[f64; 3]> = Some([1.0, 0.0, 0.0]);

/// What to try before the first flight, of a board with sensors.
const ALIGNMENT: &str = "Before the first flight, test the alignment. Tilt the frame by hand, to the front and to the right. The picture of it in the flight controller's settings has to tilt alike.";

/// A mount of the rigid centre, glued, by hand, before the fold.
const GLUED: Mount = Mount {
    id: "",
    brings: &[],
    with: &[],
    without: &[],
    supplies: &[],
    onto: "battery_bracket",
    from: REAR,
    turns: false,
    fixing: Fixing::Glue,
    needs: &[],
    stage: Stage::BeforeFold,
    title: "",
    text: "",
    text_across: "",
    tools: &[Tool::Glue],
    caution: None,
    minutes: 2.0,
};

/// All of them, in the order in which they are tried.
pub static MOUNTS: [Mount; 31] = [
    Mount {
        id: "magnet_in_bracket",
        brings: &["magnet_bracket"],
        turns: true,
        title: "Magnet into the bracket",
        text: "Let the two magnets snap together and mark the two faces that touch. Glue one into the bracket's pocket from the {rear}, its mark to the {rear}.",
        caution: Some("Polarity: a magnet that is glued in the wrong way round pushes the battery out. Marked face looks at marked face."),
        ..GLUED
    },
    Mount {
        id: "connector_in_bracket",
        brings: &["connector_bracket"],
        turns: true,
        title: "Power connector into the bracket",
        text: "Push the half with the pins into the bracket's channel, its mouth to the {rear}, its two cut corners where the channel has them, and glue it. Its two leads are soldered to it before, as the picture shows: they leave it to the {front}, into the bay.",
        caution: Some(
            "Plus and minus: the cut corners are the connector's minus side. Solder and insulate its wires before it is glued in.",
        ),
        tools: &[Tool::SolderingIron, Tool::Solder, Tool::ShrinkTube, Tool::Glue],
        ..GLUED
    },
    Mount {
        id: "sleeve_on_bracket",
        brings: &["battery_sleeve"],
        from: BELOW,
        title: "Sleeve under the bracket",
        text: "Glue the bracket's base between the two ribs of the sleeve. The rim that is chamfered inside is at the {rear}, where the magnet is: the battery goes in there. A sleeve with a tray has it at the {front}.",
        ..GLUED
    },
    Mount {
        id: "flow_sensor",
        brings: &["flow_sensor"],
        onto: "battery_sleeve",
        from: BELOW,
        fixing: Fixing::Tape,
        title: "Flow sensor under the tray",
        text: "Hold the sensor under the tray, its lens down, its holes under the tray's. Fix it with thin double-sided tape.",
        text_across: " With the tray it is turned a quarter to the left: state that in the flight controller's settings.",
        tools: &[Tool::DoubleSidedTape],
        ..GLUED
    },
    Mount {
        id: "stack_screws",
        brings: &["stack_screw"],
        onto: "hub",
        from: ABOVE,
        fixing: Fixing::Thread,
        title: "Screws into the hub",
        text: "Turn the four long screws from above through the hub until their heads lie in their hollows. They cut their own thread.",
        tools: &[Tool::Screwdriver],
        ..GLUED
    },
    Mount {
        id: "spacers_under_hub",
        brings: &["stack_spacer_hub"],
        onto: "hub",
        from: BELOW,
        fixing: Fixing::Screws("stack_screw"),
        needs: &[("stack_screws", "the spacers go onto the screws")],
        title: "Spacers under the hub",
        text: "Turn the hub over. Put the spacers of this step onto the four screws, as many onto each, up to the hub. Nuts as spacers are turned on and pulled tight: they lock the screws in the hub.",
        tools: &[Tool::Hands],
        ..GLUED
    },
    Mount {
        id: "dampers",
        brings: &["damper"],
        onto: "flight_controller",
        from: BELOW,
        fixing: Fixing::Squeezed,
        title: "Dampers into the flight controller",
        text: "Squeeze one rubber damper into each corner hole of the flight controller until the board lies in its groove.",
        tools: &[Tool::Hands],
        ..GLUED
    },
    Mount {
        id: "dampers_in_motor_controller",
        brings: &["damper"],
        onto: "motor_controller",
        from: BELOW,
        fixing: Fixing::Squeezed,
        title: "Dampers into the board",
        text: "Squeeze one rubber damper into each corner hole of the board until it lies in the damper's groove.",
        tools: &[Tool::Hands],
        ..GLUED
    },
    Mount {
        id: "flight_controller",
        brings: &["flight_controller"],
        onto: "hub",
        from: BELOW,
        fixing: Fixing::Screws("stack_screw"),
        needs: &[
            ("stack_screws", "the board hangs on the screws"),
            ("spacers_under_hub", "the spacers lie between hub and board"),
            ("dampers", "the dampers sit between board and screws"),
        ],
        title: "Flight controller onto the screws",
        text: "With the hub's underside up, hold the flight controller so that the face with its arrow is towards the hub, and the arrow points to the front: in flight that face looks up. Push the board with its dampers onto the four screws. Where its plugs leave no room for that, turn the board's other face to the hub, the arrow to the front: in flight the arrow then faces the ground. Such a board needs another alignment in the flight controller's settings: roll 180 degrees.",
        tools: &[Tool::Hands],
        caution: Some(ALIGNMENT),
        ..GLUED
    },
    Mount {
        id: "spacers_between_boards",
        brings: &["stack_spacer_boards"],
        onto: "flight_controller",
        from: BELOW,
        fixing: Fixing::Screws("stack_screw"),
        needs: &[("flight_controller", "the spacers lie under the flight controller")],
        title: "Spacers under the flight controller",
        text: "Put the spacers of this step onto the four screws, as many onto each, up to the dampers or the board. Nuts as spacers are turned on finger tight: no damper is squeezed flat, and no board is bent.",
        tools: &[Tool::Hands],
        ..GLUED
    },
    Mount {
        id: "motor_controller",
        brings: &["motor_controller"],
        without: &[ALL_IN_ONE],
        onto: "hub",
        from: BELOW,
        fixing: Fixing::Screws("stack_screw"),
        needs: &[
            ("stack_screws", "the board hangs on the screws"),
            ("spacers_under_hub", "the spacers lie between hub and board"),
            ("spacers_between_boards", "the spacers lie between the two boards"),
            ("dampers_in_motor_controller", "the dampers sit between board and screws"),
        ],
        title: "Motor controller onto the screws",
        text: "{cables}Push the motor controller onto the screws, its battery pads to the {rear}.",
        text_across: " With its pads its four outputs are turned a quarter: state that in the flight controller's order of motors.",
        tools: &[Tool::Hands],
        ..GLUED
    },
    Mount {
        id: "both_controllers",
        brings: &["motor_controller"],
        with: &[ALL_IN_ONE],
        onto: "hub",
        from: BELOW,
        fixing: Fixing::Screws("stack_screw"),
        needs: &[
            ("stack_screws", "the board hangs on the screws"),
            ("spacers_under_hub", "the spacers lie between hub and board"),
            ("dampers_in_motor_controller", "the dampers sit between board and screws"),
        ],
        title: "Board of both controllers onto the screws",
        text: "With the hub's underside up, hold the board so that the face with its arrow is towards the hub, and its battery pads are at the {rear}: in flight that face looks up. Push the board onto the four screws. Where its plugs leave no room for that, turn its other face to the hub: in flight the arrow then faces the ground. Such a board needs another alignment in the flight controller's settings: roll 180 degrees. An arrow that does not point to the front needs a yaw there, too.",
        text_across: " With its pads its four outputs are turned a quarter: state that in the flight controller's order of motors.",
        tools: &[Tool::Hands],
        caution: Some(ALIGNMENT),
        ..GLUED
    },
    Mount {
        id: "stack_nuts",
        brings: &["stack_nut"],
        onto: "hub",
        from: BELOW,
        fixing: Fixing::Screws("stack_screw"),
        needs: &[
            ("stack_screws", "the nuts go onto the screws"),
            ("flight_controller", "the nuts hold the boards"),
            ("motor_controller", "the nuts hold the boards"),
            ("both_controllers", "the nuts hold the board"),
        ],
        title: "Nuts onto the screws",
        text: "Turn one nut onto each of the four screws, up to the lowest board or to its dampers, finger tight. No damper is squeezed flat by it, and no board is bent.",
        tools: &[Tool::Hands],
        ..GLUED
    },
    Mount {
        id: "radio",
        with: &["flight_controller", "motor_controller"],
        without: &["receiver"],
        supplies: &["receiver"],
        onto: "hub",
        from: None,
        fixing: Fixing::Tape,
        needs: &[
            ("flight_controller", "its wires end at the board"),
            ("motor_controller", "its wires end at the board"),
            ("both_controllers", "its wires end at the board"),
        ],
        title: "Radio receiver onto the hub",
        text: "Where the frame is flown by radio: stick the receiver flat onto the middle of the hub's plate, between the bosses, with double-sided tape. It is no higher than the bosses. Lead its wires down beside the hub, between two bosses, and connect them to a serial port and to 5 V of the board under the hub. Its antenna goes out between the bosses, away from the rods.",
        tools: &[Tool::DoubleSidedTape, Tool::SolderingIron, Tool::Solder],
        minutes: 5.0,
        ..GLUED
    },
    Mount {
        id: "computer",
        brings: &["computer"],
        onto: "pi_carrier",
        from: ABOVE,
        fixing: Fixing::SmallScrews,
        title: "Computer onto its carrier",
        text: "Lay washers on each of the carrier's four holes, together a little thicker than a tie's strap: two of the ties pass between board and carrier. A drop of glue holds them. Lay the computer on the washers, hole over hole, its camera socket to the front. {computer_screws}",
        tools: &[Tool::Glue, Tool::Screwdriver],
        ..GLUED
    },
    Mount {
        id: "camera_connectors",
        brings: &["camera_connector_left", "camera_connector_right"],
        onto: "computer",
        from: ABOVE,
        fixing: Fixing::SmallScrews,
        title: "Camera connectors onto the computer",
        text: "Put a drop of glue under the foot of each connector and set both onto the board's front holes, their posts to the front and outwards. {foot_screws}",
        tools: &[Tool::Glue, Tool::Screwdriver],
        ..GLUED
    },
    Mount {
        id: "camera",
        brings: &["camera"],
        onto: "camera_connector_left",
        from: FRONT,
        fixing: Fixing::SmallScrews,
        title: "Camera onto its connectors",
        text: "{cables}Set the camera with its back against the connectors' posts, hole over hole, lens to the front, and fix it with small screws.",
        tools: &[Tool::Screwdriver],
        caution: Some("Open and close the latch of the ribbon with a finger nail, never by force."),
        ..GLUED
    },
    Mount {
        id: "carrier",
        brings: &["pi_carrier"],
        onto: "hub",
        from: ABOVE,
        fixing: Fixing::Ties("tie"),
        needs: &[("radio", "the receiver lies under the carrier")],
        title: "Carrier onto the hub",
        text: "Lay the carrier on the hub, its four tie holes over the hub's, the camera to the front.",
        tools: &[Tool::Hands],
        ..GLUED
    },
    Mount {
        id: "accessory_plate",
        brings: &["accessory_plate"],
        onto: "hub",
        from: ABOVE,
        fixing: Fixing::Ties("tie"),
        needs: &[("radio", "the receiver lies under the plate")],
        title: "Accessory plate onto the hub",
        text: "Lay the plate on the hub, its four tie holes over the hub's, the mast to the rear, the cheeks to the front.",
        tools: &[Tool::Hands],
        ..GLUED
    },
    Mount {
        id: "receiver",
        brings: &["receiver"],
        onto: "accessory_plate",
        from: LEFT,
        fixing: Fixing::Tape,
        title: "Receiver onto the plate",
        text: "Lay the receiver on the left of the plate, a strip of foam tape under it. A small tie through the two slots beside it holds it in a crash, too. Its antenna goes to the rear, away from the rods.",
        tools: &[Tool::FoamTape, Tool::SmallTie, Tool::SideCutter],
        ..GLUED
    },
    Mount {
        id: "buzzer",
        brings: &["buzzer"],
        onto: "accessory_plate",
        from: RIGHT,
        fixing: Fixing::SmallTies,
        title: "Buzzer onto the plate",
        text: "Lay the buzzer on the right of the plate, lead a small tie through the two slots beside it and pull it tight. Its hole stays free.",
        tools: &[Tool::SmallTie, Tool::SideCutter],
        ..GLUED
    },
    Mount {
        id: "gps",
        brings: &["gps"],
        onto: "accessory_plate",
        from: ABOVE,
        fixing: Fixing::Tape,
        title: "Satellite receiver (GPS) onto its mast",
        text: "Stick the GPS onto the mast's shelf with foam tape, its antenna up, its arrow to the front. Tape its cable to the mast.",
        tools: &[Tool::FoamTape],
        ..GLUED
    },
    Mount {
        id: "fpv_camera",
        brings: &["fpv_camera"],
        onto: "accessory_plate",
        from: ABOVE,
        fixing: Fixing::SmallScrews,
        title: "Camera between the cheeks",
        text: "Put the camera between the two cheeks, its lens to the front, and fix it with its two side screws. Turn it up to the tilt that the picture shows before you tighten them. Its video transmitter and the transmitter's antenna are not part of this frame: choose them with the camera.",
        tools: &[Tool::Screwdriver],
        ..GLUED
    },
    Mount {
        id: "bracket",
        brings: &["battery_bracket"],
        onto: "hub",
        from: BELOW,
        fixing: Fixing::Ties("tie"),
        title: "Bracket under the hub",
        text: "Solder the connector's leads to the motor controller's battery pads at its {rear}, red to plus, black to minus, as the picture shows: they are the battery wires of the bill. {cables}Set the bracket under the hub, its magnet and its power connector to the {rear}. The bay stays open to the {left} and to the {right}: the motor wires come in there.",
        supplies: &["battery_wire"],
        tools: &[Tool::SolderingIron, Tool::Solder],
        caution: Some("Solder with the battery far away. Plus to plus, minus to minus: measure before the battery is ever plugged in."),
        minutes: 10.0,
        ..GLUED
    },
    Mount {
        id: "ties",
        brings: &["tie"],
        onto: "hub",
        from: None,
        fixing: Fixing::Ties("tie"),
        needs: &[
            ("carrier", "the ties pass through the carrier"),
            ("accessory_plate", "the ties pass through the accessory plate"),
            ("bracket", "the ties pass through the bracket"),
        ],
        title: "Ties",
        text: "Put two ties through the holes of hub and bracket, {in front and at the rear}, and out by the bracket's slots; two through the hub's holes {left and right}. Where there is a carrier or an accessory plate, all four go through it, too. Pull them tight and cut what is over.",
        tools: &[Tool::SideCutter],
        minutes: 4.0,
        ..GLUED
    },
    Mount {
        id: "wiring",
        supplies: &["motor_wire"],
        onto: "motor_controller",
        from: None,
        fixing: Fixing::Solder,
        stage: Stage::AfterFold,
        title: "Motor wires",
        text: "Lead each motor's three wires along its arm, under the hub and in between the bracket's uprights; tape them to the arm. Where they do not reach, lengthen them with the motor wires of the bill. Solder them to the motor controller.",
        tools: &[Tool::SolderingIron, Tool::Solder, Tool::ShrinkTube, Tool::Tape],
        caution: Some("Leave each bundle slack at the plugs: they must be free to slip out in a crash."),
        minutes: 20.0,
        ..GLUED
    },
    Mount {
        id: "connector_in_lid",
        brings: &["connector_lid"],
        onto: "battery_lid",
        stage: Stage::AfterFold,
        turns: true,
        title: "Power connector into the lid",
        text: "Solder the battery's two leads to the half with the sockets, red to plus, black to minus at the cut corners, each in shrink tube. Push it through the lid's block from the {rear}, its cut corners where the hole has them, and glue it. Its leads leave it to the {rear}.",
        tools: &[Tool::SolderingIron, Tool::Solder, Tool::ShrinkTube, Tool::Glue],
        caution: Some("The leads are the battery's: never let the two touch. Cut and solder one after the other."),
        minutes: 8.0,
        ..GLUED
    },
    Mount {
        id: "magnet_in_lid",
        brings: &["magnet_lid"],
        onto: "battery_lid",
        from: FRONT,
        stage: Stage::AfterFold,
        turns: true,
        title: "Magnet into the lid",
        text: "Glue the second magnet into the lid's tower from the {front}, its mark to the {front}.",
        caution: Some("Polarity: hold it before the bracket's magnet first. It has to pull."),
        ..GLUED
    },
    Mount {
        id: "battery",
        brings: &["battery"],
        onto: "battery_lid",
        from: FRONT,
        fixing: Fixing::Tape,
        stage: Stage::AfterFold,
        turns: true,
        title: "Battery into the lid",
        text: "Slide the battery into the lid from the {front} until its {rear} face is {battery_rear}. Tape both together: they stay together.",
        tools: &[Tool::Tape],
        ..GLUED
    },
    Mount {
        id: "cartridge",
        brings: &["battery_lid"],
        with: &[],
        without: &[],
        supplies: &[],
        onto: "battery_sleeve",
        from: REAR,
        turns: true,
        fixing: Fixing::MagnetAndPlug,
        needs: &[
            ("connector_in_lid", "the lid is closed by its plug"),
            ("magnet_in_lid", "the lid is held by its magnet"),
            ("battery", "the battery is in the lid"),
            ("wiring", "the first power tries the motors"),
        ],
        stage: Stage::AfterFold,
        title: "Battery in",
        text: "Slide battery and lid from the {rear} into the sleeve until the magnets pull the lid home and the plug is in: this is the first power, without propellers. Try each motor: does it answer to its number, and turn the way that the last step shows? One that turns the wrong way has two of its wires changed over. Tilt the frame by hand: the picture of it in the flight controller's settings has to tilt alike. Then take battery and lid out again.",
        text_across: "",
        tools: &[Tool::Hands],
        caution: Some("First power without propellers. With the battery in, the motors can start."),
        minutes: 10.0,
    },
    Mount {
        id: "propellers",
        brings: &["propeller_FR", "propeller_FL", "propeller_BL", "propeller_BR"],
        with: &[],
        without: &[],
        supplies: &[],
        onto: "motor_FR",
        from: ABOVE,
        turns: false,
        fixing: Fixing::Shaft,
        needs: &[
            ("wiring", "the directions of the motors are tried without propellers"),
            ("cartridge", "the first power is without propellers"),
        ],
        stage: Stage::AfterFold,
        title: "Propellers",
        text: "Two of the propellers turn each way, as the arrows show. Put each onto its motor, its lettering up, and fix it as the motor is sold: with two screws, or pressed onto the shaft.",
        text_across: "",
        tools: &[Tool::ScrewdriverOrHands],
        caution: Some("The battery is out while hands are at the propellers. From here on it goes in only where the frame may fly."),
        minutes: 1.0,
    },
];
