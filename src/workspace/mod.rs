//! Interactive changes of a frame: set a value, and request results.
//!
//! Only the steps that depend on a change are computed again, and every answer lists them. Results are those of a frame that is read and
//! built without a cache, to the last bit. Nothing here opens a file.

mod advice;
mod answer;
mod bench;
mod movable;
mod remedy;
#[cfg(test)]
mod tests;
mod wishes;

use std::sync::Arc;

pub use advice::advice;
pub use answer::{Answer, Refused};
pub use remedy::Remedy;

use crate::checks::{self, CATALOGUE, Cost, Finding};
use crate::export::File;
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::{self, MassTable};
use crate::memo::{Memo, Progress, Step};
use crate::params::frame_file::Value;
use crate::params::refusal::Refusal;
use crate::params::{Frame, FrameFile};
use crate::report::frame_folder::{self, FolderChoice};

/// A frame file, the frame that it means, and what was computed of them.
pub struct Workspace {
    file: FrameFile,
    frame: Frame,
    memo: Arc<Memo>,
    designed: Option<(Arc<Design>, Arc<MassTable>)>,
}

impl Workspace {
    /// Of a frame file, with what a memo has of former frames.
    ///
    /// # Errors
    /// When the file describes no frame.
    pub fn new(file: FrameFile, memo: Arc<Memo>) -> Result<Self, Refusal> {
        let frame = Frame::resolve(&file)?;
        Ok(Self { file, frame, memo, designed: None })
    }

    /// The frame file as it is now.
    pub fn file(&self) -> &FrameFile {
        &self.file
    }

    /// The frame as it is meant now.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Sets a value, as if the frame file stated it: a number of `table.key`, or a name such as that of `printer`.
    ///
    /// # Errors
    /// When the file with it describes no frame; then nothing has changed.
    pub fn set(&mut self, key: &str, value: Value) -> Result<(), Refusal> {
        let mut file = self.file.clone();
        file.set(key, value);
        self.replace(file)
    }

    /// Takes another file, such as an edited one.
    ///
    /// # Errors
    /// When it describes no frame; then nothing has changed.
    pub fn replace(&mut self, file: FrameFile) -> Result<(), Refusal> {
        let frame = Frame::resolve(&file)?;
        (self.file, self.frame, self.designed) = (file, frame, None);
        Ok(())
    }

    /// The design: skeleton, printed parts with their meshes, bodies.
    ///
    /// # Errors
    /// When the frame cannot be designed, or the computation was ended.
    pub fn design(&mut self, progress: &dyn Progress) -> Result<Answer<Arc<Design>>, Refused> {
        let (design, _) = self.designed(progress)?;
        Ok(self.answer(design))
    }

    /// The masses.
    ///
    /// # Errors
    /// When the frame cannot be designed, or the computation was ended.
    pub fn masses(&mut self, progress: &dyn Progress) -> Result<Answer<Arc<MassTable>>, Refused> {
        let (_, masses) = self.designed(progress)?;
        Ok(self.answer(masses))
    }

    /// The findings of all rules, without the passes that cost more.
    ///
    /// # Errors
    /// When the frame cannot be designed, or the computation was ended.
    pub fn findings(&mut self, dearest: Cost, progress: &dyn Progress) -> Result<Answer<Vec<Finding>>, Refused> {
        let (design, masses) = self.designed(progress)?;
        let found = checks::followed(&CATALOGUE, dearest, &design, &masses, progress).ok_or(Refused::Ended)?;
        Ok(self.answer(found))
    }

    /// The files that `build` writes, the manifest last.
    ///
    /// # Errors
    /// When the frame cannot be designed, a file cannot be made, or the computation was ended.
    pub fn files(&mut self, choice: FolderChoice, progress: &dyn Progress) -> Result<Answer<Vec<File>>, Refused> {
        let (design, masses) = self.designed(progress)?;
        let found = checks::followed(&CATALOGUE, Cost::Slow, &design, &masses, progress).ok_or(Refused::Ended)?;
        let begins = |name: &str, of| progress.begins(Step { name, of });
        let files = frame_folder::followed(&design, &masses, &found, choice, &begins)?.ok_or(Refused::Ended)?;
        Ok(self.answer(files))
    }

    fn designed(&mut self, progress: &dyn Progress) -> Result<(Arc<Design>, Arc<MassTable>), Refused> {
        if let Some(designed) = &self.designed {
            return Ok(designed.clone());
        }
        let design = Design::followed(self.frame.clone(), &self.memo, progress).map_err(|error| error.refusal(&self.file))?;
        let design = design.ok_or(Refused::Ended)?;
        let masses = Arc::new(mass::table(&design));
        Ok(self.designed.insert((Arc::new(design), masses)).clone())
    }

    fn answer<T>(&self, value: T) -> Answer<T> {
        Answer { value, made: self.memo.made().into_iter().collect() }
    }
}
