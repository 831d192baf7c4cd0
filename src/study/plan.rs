//! What a study looks at.

use super::axis::{Axis, Input};
use super::column::Column;
use super::sampling::Sampling;
use crate::mechanics::settings::MechanicsSettings;
use crate::params::FrameFile;
use crate::params::frame_file::Value;

/// Many frames, one a row.
pub struct Study {
    /// The plan's name.
    pub name: String,
    /// The frame that all of them differ from.
    pub base: FrameFile,
    /// How the base is named: a preset, or a file's path.
    pub base_name: String,
    /// What differs.
    pub axes: Vec<Axis>,
    /// How it differs.
    pub sampling: Sampling,
    /// Of all that is random.
    pub seed: u32,
    /// What is said of each frame.
    pub columns: Vec<Column>,
    /// Numbers of the frame's own mechanics, where a column is one of their measures.
    pub mechanics: Option<MechanicsSettings>,
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

    /// The frame of a row as typed.
    pub fn frame_file(&self, row: usize) -> FrameFile {
        let mut file = self.base.clone();
        for (axis, input) in self.axes.iter().zip(self.inputs(row)) {
            match input {
                Input::Number(value) => file.set_number(&axis.key(), value),
                Input::Name(name) => {
                    let words = format!("{} = {name}, row {row} of {}", axis.key(), self.name);
                    file.ask(&axis.key(), Value::Text(name), words);
                }
            }
        }
        file
    }
}
