//! What a study looks at.

use super::axis::{Axis, Input};
use super::column::Column;
use super::recovery::Recovery;
use super::sampling::Sampling;
use crate::mechanics::settings::MechanicsSettings;
use crate::params::FrameFile;
use crate::params::frame_file::Value;

/// What the rows of a study are.
pub enum Subject {
    /// Frames that differ from one.
    Frames(Frames),
    /// Drops with something hidden in them, diagnosed.
    Recovery(Recovery),
}

/// Frames that differ from one.
pub struct Frames {
    /// The frame that all of them differ from.
    pub base: FrameFile,
    /// How it is named: a preset, or a file's path.
    pub base_name: String,
    /// Numbers of the frame's own mechanics, where a column is one of their measures.
    pub mechanics: Option<MechanicsSettings>,
}

/// Many frames, or sets of drops, one a row.
pub struct Study {
    /// The plan's name.
    pub name: String,
    /// What the rows are.
    pub subject: Subject,
    /// What differs.
    pub axes: Vec<Axis>,
    /// How it differs.
    pub sampling: Sampling,
    /// Of all that is random.
    pub seed: u32,
    /// What is said of each row.
    pub columns: Vec<Column>,
    /// Everything that the plan says, and that its files say, as text: two plans with the same text are the same study.
    pub text: String,
}

impl Study {
    /// How many rows it has.
    pub fn rows(&self) -> usize {
        self.sampling.rows(self.axes.len())
    }

    /// What the axes are in a row, in their order.
    pub fn inputs(&self, row: usize) -> Vec<Input> {
        self.sampling.inputs(&self.axes, self.seed, row)
    }

    /// The name of what is varied or diagnosed: a frame, or a model of the drop.
    pub fn base_name(&self) -> &str {
        match &self.subject {
            Subject::Frames(frames) => &frames.base_name,
            Subject::Recovery(recovery) => &recovery.base.name,
        }
    }

    /// The frame of a row of these frames as typed.
    pub fn frame_file(&self, frames: &Frames, row: usize) -> FrameFile {
        let mut file = frames.base.clone();
        for (axis, input) in self.axes.iter().zip(self.inputs(row)) {
            match input {
                Input::Number(value) => file.set_number(&axis.key(), value),
                Input::Name(name) => {
                    let words = format!("{} = {name}, row {row} of {}", axis.key(), self.name);
                    file.ask(&axis.key(), Value::Text(name), words);
                }
                Input::None => {}
            }
        }
        file
    }
}
