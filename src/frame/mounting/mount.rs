//! What is mounted beside the fold: the electronics on the hub before it, wires and battery after it. Nothing here says in which order.

use serde::Serialize;

use crate::frame::skeleton::{BatteryAxes, MODULE_NAMES};

/// What keeps a part where it was put.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case", tag = "by", content = "part")]
pub enum Fixing {
    /// Screws, by their role.
    Screws(&'static str),
    /// It is a screw itself.
    Thread,
    /// Glue for rigid plastics.
    Glue,
    /// Ties, by their role.
    Ties(&'static str),
    /// Tape: double-sided under a board, around a battery.
    Tape,
    /// Small screws through holes of the part; they are a supply of the bill.
    SmallScrews,
    /// Small ties; they are a supply of the bill.
    SmallTies,
    /// It is squeezed into its hole.
    Squeezed,
    /// Magnet and plug.
    MagnetAndPlug,
    /// Solder.
    Solder,
    /// The motor's shaft or its screws, as the motor is sold.
    Shaft,
}

/// Whether something is mounted before the fold or after it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Stage {
    /// Before the first step of the fold.
    BeforeFold,
    /// When the frame stands on its feet.
    AfterFold,
}

/// A thing to mount.
#[derive(Debug, PartialEq)]
pub struct Mount {
    /// Its name in files.
    pub id: &'static str,
    /// The bodies that it brings; those that the design lacks are left out.
    pub brings: &'static [&'static str],
    /// The body that they are put onto; where each module has one, that of the first module.
    pub onto: &'static str,
    /// Where they come from, along a straight line in the frame's axes where the sleeve lies along the frame; none when they are threaded or
    /// soldered.
    pub from: Option<[f64; 3]>,
    /// Whether it turns with the battery's sleeve: where the parts come from.
    pub turns: bool,
    /// What keeps them.
    pub fixing: Fixing,
    /// What has to be mounted before, and why.
    pub needs: &'static [(&'static str, &'static str)],
    /// When.
    pub stage: Stage,
    /// In a few words.
    pub title: &'static str,
    /// What a person does. Sides between braces are those of a sleeve that lies along the frame.
    pub text: &'static str,
    /// A sentence more where the sleeve lies across.
    pub text_across: &'static str,
    /// Sentences of the text that hold only where the design has a body: the body, the sentence.
    pub text_with: &'static [(&'static str, &'static str)],
    /// The tool.
    pub tool: &'static str,
    /// What to take care of.
    pub caution: Option<&'static str>,
    /// Time of one, minutes: an estimate of ours.
    pub minutes: f64,
}

/// How the bodies of the first module end.
const FIRST_MODULE: &str = "_FR";

impl Mount {
    /// Where the parts come from in a frame, in its axes.
    pub fn from_in(&self, battery_axes: BatteryAxes) -> Option<[f64; 3]> {
        if self.turns { self.from.map(|from| battery_axes.vector(from)) } else { self.from }
    }

    /// What a person does in a frame.
    pub fn text_in(&self, battery_axes: BatteryAxes) -> String {
        let more = if battery_axes.are_turned() { self.text_across } else { "" };
        format!("{}{more}", battery_axes.words(self.text))
    }

    /// Whether each module has what it is put onto.
    pub fn is_in_each_module(&self) -> bool {
        self.onto.ends_with(FIRST_MODULE)
    }

    /// What a body is put onto, where that of the first module is known: that of the body's own module where each has one.
    pub(super) fn onto_of(onto: &str, body: &str) -> String {
        let of_module = |module: &&&str| body.ends_with(&format!("_{module}"));
        match onto.strip_suffix(FIRST_MODULE).zip(MODULE_NAMES.iter().find(of_module)) {
            Some((onto, module)) => format!("{onto}_{module}"),
            None => onto.into(),
        }
    }

    /// How often it is done: once, or once a module.
    pub fn repeats(&self) -> usize {
        if self.is_in_each_module() { MODULE_NAMES.len() } else { 1 }
    }
}

const ABOVE: Option<[f64; 3]> = Some([0.0, 0.0, 1.0]);
const BELOW: Option<[f64; 3]> = Some([0.0, 0.0, -1.0]);
const FRONT: Option<[f64; 3]> = Some([0.0, 1.0, 0.0]);
const REAR: Option<[f64; 3]> = Some([0.0, -1.0, 0.0]);
const LEFT: Option<[f64; 3]> = Some([-1.0, 0.0, 0.0]);
const RIGHT: Option<[f64; 3]> = Some([1.0, 0.0, 0.0]);

/// A mount of the rigid centre, glued, by hand, before the fold.
const GLUED: Mount = Mount {
    id: "",
    brings: &[],
    onto: "battery_bracket",
    from: REAR,
    turns: false,
    fixing: Fixing::Glue,
    needs: &[],
    stage: Stage::BeforeFold,
    title: "",
    text: "",
    text_across: "",
    text_with: &[],
    tool: "glue for rigid plastics",
    caution: None,
    minutes: 2.0,
};

/// All of them, in the order in which they are tried.
pub static MOUNTS: [Mount; 26] = [
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
        ..GLUED
    },
    Mount {
        id: "sleeve_on_bracket",
        brings: &["battery_sleeve"],
        from: BELOW,
        title: "Sleeve under the bracket",
        text: "Glue the bracket's base between the two ribs of the sleeve. The tray looks to the {front}, away from the magnet.",
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
        tool: "double-sided tape",
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
        tool: "screwdriver",
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
        tool: "hands",
        ..GLUED
    },
    Mount {
        id: "dampers_in_motor_controller",
        brings: &["damper"],
        onto: "motor_controller",
        from: BELOW,
        fixing: Fixing::Squeezed,
        title: "Dampers into the board",
        text: "Squeeze one rubber damper into each corner hole of the board, which is flight and motor controller in one, until it lies in the damper's groove.",
        tool: "hands",
        ..GLUED
    },
    Mount {
        id: "flight_controller",
        brings: &["flight_controller"],
        onto: "hub",
        from: BELOW,
        fixing: Fixing::Screws("stack_screw"),
        needs: &[("stack_screws", "the board hangs on the screws"), ("dampers", "the dampers sit between board and screws")],
        title: "Flight controller onto the screws",
        text: "Turn the hub over. Push the flight controller with its dampers onto the four screws, the arrow on it to the front.",
        tool: "hands",
        ..GLUED
    },
    Mount {
        id: "motor_controller",
        brings: &["motor_controller"],
        onto: "hub",
        from: BELOW,
        fixing: Fixing::Screws("stack_screw"),
        needs: &[
            ("stack_screws", "the board hangs on the screws"),
            ("dampers_in_motor_controller", "the dampers sit between board and screws"),
        ],
        title: "Motor controller under it",
        text: "Plug the cable between the two boards. Push the motor controller onto the screws, its battery pads to the {rear}.",
        text_across: " With its pads its four outputs are turned a quarter: state that in the flight controller's order of motors.",
        text_with: &[("flight_controller", "Plug the cable between the two boards. ")],
        tool: "hands",
        ..GLUED
    },
    Mount {
        id: "computer",
        brings: &["computer"],
        onto: "pi_carrier",
        from: ABOVE,
        fixing: Fixing::SmallScrews,
        title: "Computer onto its carrier",
        text: "Lay the computer on the carrier, hole over hole, its camera socket to the front. Fix it with two small screws through its rear holes. The front holes stay free: the camera's connectors go onto them.",
        tool: "screwdriver",
        ..GLUED
    },
    Mount {
        id: "camera_connectors",
        brings: &["camera_connector_left", "camera_connector_right"],
        onto: "computer",
        from: ABOVE,
        fixing: Fixing::Glue,
        title: "Camera connectors onto the computer",
        text: "Put a drop of glue under the foot of each connector and set both onto the board's front holes, their posts to the front and outwards.",
        ..GLUED
    },
    Mount {
        id: "camera",
        brings: &["camera"],
        onto: "camera_connector_left",
        from: FRONT,
        fixing: Fixing::SmallScrews,
        title: "Camera onto its connectors",
        text: "Push its ribbon into the computer's socket and close the latch. Set the camera with its back against the connectors' posts, hole over hole, lens to the front, and fix it with small screws.",
        tool: "screwdriver",
        caution: Some("Open and close the latch of the ribbon with a finger nail, never by force."),
        ..GLUED
    },
    Mount {
        id: "carrier",
        brings: &["pi_carrier"],
        onto: "hub",
        from: ABOVE,
        fixing: Fixing::Ties("tie"),
        title: "Carrier onto the hub",
        text: "Lay the carrier on the hub, its four tie holes over the hub's, the camera to the front.",
        tool: "hands",
        ..GLUED
    },
    Mount {
        id: "accessory_plate",
        brings: &["accessory_plate"],
        onto: "hub",
        from: ABOVE,
        fixing: Fixing::Ties("tie"),
        title: "Accessory plate onto the hub",
        text: "Lay the plate on the hub, its four tie holes over the hub's, the mast to the rear, the cheeks to the front.",
        tool: "hands",
        ..GLUED
    },
    Mount {
        id: "receiver",
        brings: &["receiver"],
        onto: "accessory_plate",
        from: LEFT,
        fixing: Fixing::Tape,
        title: "Receiver onto the plate",
        text: "Lay the receiver on the left of the plate, a strip of foam tape under it. A small tie through the two slots beside it holds it in a crash, too. Its antenna goes to the rear, away from rods of carbon.",
        tool: "foam tape",
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
        tool: "side cutter",
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
        tool: "foam tape",
        ..GLUED
    },
    Mount {
        id: "fpv_camera",
        brings: &["fpv_camera"],
        onto: "accessory_plate",
        from: ABOVE,
        fixing: Fixing::SmallScrews,
        title: "Camera between the cheeks",
        text: "Put the camera between the two cheeks, its lens to the front, and fix it with its two side screws. Turn it up to the tilt that the picture shows before you tighten them.",
        tool: "screwdriver",
        ..GLUED
    },
    Mount {
        id: "bracket",
        brings: &["battery_bracket"],
        onto: "hub",
        from: BELOW,
        fixing: Fixing::Ties("tie"),
        title: "Bracket under the hub",
        text: "Solder the connector's leads to the motor controller's battery pads at its {rear}, red to plus, black to minus, as the picture shows. Lead the flow sensor's cable through the holes of the {front} upright. Set the bracket under the hub, the tray to the {front}. The bay stays open to the {left} and to the {right}: the motor wires come in there.",
        text_with: &[("flow_sensor", "Lead the flow sensor's cable through the holes of the {front} upright. ")],
        tool: "soldering iron",
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
        tool: "side cutter",
        minutes: 4.0,
        ..GLUED
    },
    Mount {
        id: "wiring",
        onto: "motor_controller",
        from: None,
        fixing: Fixing::Solder,
        stage: Stage::AfterFold,
        title: "Motor wires",
        text: "Lead each motor's three wires along its arm, under the hub and in between the bracket's uprights; tape them to the arm. Solder them to the motor controller.",
        tool: "soldering iron",
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
        tool: "soldering iron, glue for rigid plastics",
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
        text: "Slide the battery into the lid from the {front} and tape both together. They stay together.",
        tool: "tape",
        ..GLUED
    },
    Mount {
        id: "cartridge",
        brings: &["battery_lid"],
        onto: "battery_sleeve",
        from: REAR,
        turns: true,
        fixing: Fixing::MagnetAndPlug,
        needs: &[
            ("connector_in_lid", "the lid is closed by its plug"),
            ("magnet_in_lid", "the lid is held by its magnet"),
            ("battery", "the battery is in the lid"),
        ],
        stage: Stage::AfterFold,
        title: "Battery in",
        text: "Slide battery and lid from the {rear} into the sleeve until the magnets pull the lid home and the plug is in: this is the first power, without propellers. Try each motor: does it answer to its number, and turn the way that the last step shows? One that turns the wrong way has two of its wires changed over. Then take battery and lid out again.",
        text_across: "",
        text_with: &[],
        tool: "hands",
        caution: Some("First power without propellers. With the battery in, the motors can start."),
        minutes: 10.0,
    },
    Mount {
        id: "propellers",
        brings: &["propeller_FR", "propeller_FL", "propeller_BL", "propeller_BR"],
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
        text: "Of the four propellers two turn each way, as the arrows show. The raised edge of a blade, white in the picture, goes first: dark blades are clockwise, less dark ones counter-clockwise. Put each onto its motor, its lettering up, and fix it as the motor is sold: with two screws, or pressed onto the shaft.",
        text_across: "",
        text_with: &[],
        tool: "screwdriver or hands",
        caution: Some("The battery is out while hands are at the propellers. From here on it goes in only where the frame may fly."),
        minutes: 1.0,
    },
];
