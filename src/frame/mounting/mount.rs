//! What is mounted beside the fold: the electronics on the hub before it, wires and battery after it. Nothing here says in which order.

use serde::Serialize;

use crate::frame::fold::Tool;
use crate::frame::skeleton::{BatteryAxes, MODULE_NAMES};
use crate::params::Frame;

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
    /// Magnet alone.
    Magnet,
    /// Plug alone.
    Plug,
    /// What the frame file lists as extra in place of what would keep it.
    Extra,
    /// Solder.
    Solder,
    /// The motor's shaft or its screws, as the motor is sold.
    Shaft,
}

impl Fixing {
    /// In a frame, which may have bought none of what keeps it.
    pub(super) fn in_frame(self, frame: &Frame) -> Self {
        let has = |role: &str| frame.bought.contains_key(role);
        match self {
            Self::Screws(role) | Self::Ties(role) if !has(role) => Self::Extra,
            Self::MagnetAndPlug => match (has("magnet"), has("connector")) {
                (true, true) => Self::MagnetAndPlug,
                (true, false) => Self::Magnet,
                (false, true) => Self::Plug,
                (false, false) => Self::Extra,
            },
            kept => kept,
        }
    }
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
    /// It is done only where the design has one of these bodies, or `ALL_IN_ONE`; empty where any will do.
    pub with: &'static [&'static str],
    /// It is done only where the design has none of these bodies, and not `ALL_IN_ONE`.
    pub without: &'static [&'static str],
    /// Lines of the bill, used up, that its text tells of beside the cables whose ends it brings together.
    pub supplies: &'static [&'static str],
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
    /// Mounts that are done before and whose parts are out of the frame again meanwhile.
    pub taken_out: &'static [&'static str],
    /// When.
    pub stage: Stage,
    /// In a few words.
    pub title: &'static str,
    /// What a person does. Sides between braces are those of a sleeve that lies along the frame; `{cables}` stands for the sentences of
    /// the cables whose ends the step brings together, other names between braces for words that depend on what is bought and for figures of
    /// the frame.
    pub text: &'static str,
    /// A sentence more where the sleeve lies across.
    pub text_across: &'static str,
    /// What it takes.
    pub tools: &'static [Tool],
    /// What to take care of.
    pub caution: Option<&'static str>,
    /// Time of one, minutes: an estimate of ours.
    pub minutes: f64,
}

/// In a mount's conditions: the motor controller that is the flight controller, too.
pub(super) const ALL_IN_ONE: &str = "all_in_one";
/// What such a board is called in a sentence.
pub(super) const BOTH_CONTROLLERS: &str = "board of both controllers";

/// In a mount's text: the sentences about cables; where it is not in the text, they follow it.
pub(super) const PLUGGED: &str = "{cables}";

/// In a mount's text: where the battery's rear face is in its lid.
pub(super) const BATTERY_REAR: &str = "{battery_rear}";

/// The role of the ties of the bracket.
pub(super) const TIE: &str = "tie";
/// The step of a receiver that has no place of its own, and the extra that is such a receiver.
pub const RADIO: &str = "radio";
/// See [`RADIO`].
pub(super) const RECEIVER: &str = "receiver";

/// In a mount's text: the sentences about the holes that ties go through.
pub(super) const TIES: &str = "{ties}";
/// In a text: the tilt of a camera for goggles.
pub(super) const FPV_TILT: &str = "{fpv_tilt}";

/// In a mount's text: the sentence about the key of the screws that hold the boards.
pub(super) const HEX_KEY: &str = "{hex_key}";

/// In a mount's text: the sentences about what a frame file lists as extra.
pub(super) const EXTRAS: &str = "{extras}";
/// Of an extra whose leads are soldered before the stack closes.
pub(super) const EXTRA_LEADS: &str = "{extra_leads}";
/// That what lies on the hub is loose until the ties.
pub(super) const LOOSE: &str = "{loose}";

/// In a mount's text: the sentences about what lies between computer and carrier.
pub(super) const WASHERS: &str = "{washers}";
/// In a mount's text: what is done with the ribbon of a digital camera for goggles.
pub(super) const FPV_RIBBON: &str = "{fpv_ribbon}";
/// In a mount's text: the screws that hold the camera.
pub(super) const CAMERA_SCREWS: &str = "{camera_screws}";
/// In a mount's text: the sentences about the screws that hold the computer, and about those through the feet of the camera's connectors.
pub(super) const COMPUTER_SCREWS: &str = "{computer_screws}";
/// See [`COMPUTER_SCREWS`].
pub(super) const FOOT_SCREWS: &str = "{foot_screws}";

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

    /// Whether a design with certain bodies has it, as far as what it is put onto, its conditions and their opposites say.
    pub(super) fn is_for(&self, has: impl Fn(&str) -> bool) -> bool {
        has(self.onto) && (self.with.is_empty() || self.with.iter().any(|name| has(name))) && !self.without.iter().any(|name| has(name))
    }

    /// What it takes in a frame: none of its ties where none are bought.
    pub fn tools_in(&self, frame: &Frame) -> Vec<Tool> {
        let is_tie = |tool: &Tool| matches!(tool, Tool::OneTie | Tool::TwoTies);
        self.tools.iter().copied().filter(|tool| !is_tie(tool) || frame.bought.contains_key(TIE)).collect()
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
