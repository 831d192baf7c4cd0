//! The state: frames that are open, and the parts made for them.

use std::collections::BTreeMap;
use std::sync::Arc;

use flexframe::memo::Memo;
use flexframe::params::{ImpactFile, preset};
use serde_json::{Value, json};

use crate::answer::{Answer, Refused};
use crate::drops::{self, Course};
use crate::files;
use crate::open_frame::OpenFrame;
use crate::request::{Handle, Request, Wanted};

/// Most frames that are open at once.
const MOST_OPEN: usize = 32;

/// Everything that is kept between requests.
#[derive(Default)]
pub struct Studio {
    memo: Arc<Memo>,
    frames: BTreeMap<Handle, OpenFrame>,
    last: Handle,
}

impl Studio {
    /// Does what is asked.
    ///
    /// # Errors
    /// What the command line refuses, and frames that are not open.
    pub fn answer(&mut self, request: Request) -> Result<Answer, Refused> {
        match &request.wanted {
            Wanted::Presets => Ok(Answer::data(presets())),
            Wanted::Open { frame } => {
                if self.frames.len() >= MOST_OPEN {
                    return Err(Refused::plain(format!("{MOST_OPEN} frames are open: close one")));
                }
                let open = OpenFrame::new(frame, &request.disk(), &self.memo)?;
                self.last += 1;
                Ok(self.keep(self.last, open))
            }
            Wanted::Change { handle, frame } => {
                self.open(*handle)?;
                let open = OpenFrame::new(frame, &request.disk(), &self.memo)?;
                Ok(self.keep(*handle, open))
            }
            Wanted::Close { handle } => {
                self.open(*handle)?;
                self.frames.remove(handle);
                Ok(Answer::data(Value::Null))
            }
            Wanted::Findings { handle, quick, strength } => Ok(Answer::data(self.open(*handle)?.findings(*quick, *strength)?)),
            Wanted::Files { handle, which } => Ok(Answer::of_files(files::files(self.open(*handle)?, which)?)),
            Wanted::Bill { handle } => Ok(Answer::data(self.open(*handle)?.bill()?)),
            Wanted::Stiffness { handle } => Ok(Answer::data(self.open(*handle)?.stiffness()?)),
            Wanted::Drop { model, handle, heights_m, trace } => {
                drops::dropped(&drops::model(model, &request, self.maybe(*handle)?)?, heights_m, *trace)
            }
            Wanted::Diagnose { model, handle, hold_out_heights_m, max_effects, seed } => {
                let course = Course { hold_out_heights_m, max_effects: *max_effects, seed: *seed };
                drops::diagnosed(drops::model(model, &request, self.maybe(*handle)?)?, &request, &course)
            }
        }
    }

    fn keep(&mut self, handle: Handle, open: OpenFrame) -> Answer {
        let answer = json!({ "handle": handle, "name": open.design.frame.name, "masses": open.masses });
        self.frames.insert(handle, open);
        Answer::data(answer)
    }

    fn open(&self, handle: Handle) -> Result<&OpenFrame, Refused> {
        self.frames.get(&handle).ok_or_else(|| Refused::plain(format!("no frame is open under {handle}")))
    }

    fn maybe(&self, handle: Option<Handle>) -> Result<Option<&OpenFrame>, Refused> {
        handle.map(|handle| self.open(handle)).transpose()
    }
}

/// What comes with the program.
fn presets() -> Value {
    let frames: Vec<Value> = preset::names().map(|name| json!({ "name": name, "text": preset::text(name) })).collect();
    let models: Vec<&str> = ImpactFile::names().collect();
    let printers: Vec<&str> = preset::printer_names().collect();
    json!({ "frames": frames, "models": models, "printers": printers })
}
