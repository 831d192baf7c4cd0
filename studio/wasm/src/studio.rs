//! The state: frames that are open, and the parts made for them.

use std::collections::BTreeMap;
use std::sync::Arc;

use flexframe::memo::{Memo, Prepared};
use flexframe::params::amend::{Amendment, amended};
use flexframe::params::files::Memory;
use flexframe::params::frame_file::Value as Typed;
use flexframe::params::{Frame, FrameFile, ImpactFile, preset};
use serde_json::{Map, Value, json};

use crate::answer::{Answer, Refused};
use crate::drops::{self, Course};
use crate::open_frame::{self, OpenFrame};
use crate::request::{Handle, Request, Setting, Wanted};
use crate::{beds, catalogue, files, mechanics};

/// Most frames that are open at once.
const MOST_OPEN: usize = 32;

/// Everything that is kept between requests.
#[derive(Default)]
pub struct Studio {
    frames: BTreeMap<Handle, OpenFrame>,
    last: Handle,
    /// Results that were computed ahead.
    prepared: Prepared,
}

impl Studio {
    /// Does what is asked.
    ///
    /// # Errors
    /// What the command line refuses, and frames that are not open.
    pub fn answer(&mut self, request: Request) -> Result<Answer, Refused> {
        match &request.wanted {
            Wanted::Presets => Ok(Answer::data(presets())),
            Wanted::Catalogue => Ok(Answer::data(catalogue::catalogue())),
            Wanted::CollectResults => collected(),
            Wanted::UseResults => {
                let used = request.attached.iter().map(|(_, bytes)| self.prepared.add(bytes).map_err(Refused::plain));
                Ok(Answer::data(json!({ "results": used.collect::<Result<Vec<usize>, Refused>>()? })))
            }
            Wanted::Edit { text, set } => {
                let text = edited(text, set)?;
                let stated = stated(&text);
                Ok(Answer::data(json!({ "text": text, "stated": stated })))
            }
            Wanted::Read { frame } => {
                let file = FrameFile::load_from(frame, &request.disk())?;
                Ok(Answer::data(open_frame::read(&Frame::resolve(&file)?, &file)))
            }
            Wanted::Open { frame } => {
                if self.frames.len() >= MOST_OPEN {
                    return Err(Refused::plain(format!("{MOST_OPEN} frames are open: close one")));
                }
                let open = OpenFrame::new(frame, &request.disk(), memo(&self.prepared))?;
                self.last += 1;
                self.frames.insert(self.last, open);
                self.facts(self.last)
            }
            Wanted::Change { handle, frame } => {
                self.open_to_change(*handle)?.change(frame, &request.disk())?;
                self.facts(*handle)
            }
            Wanted::Close { handle } => {
                self.open(*handle)?;
                self.frames.remove(handle);
                Ok(Answer::data(Value::Null))
            }
            Wanted::Findings { handle, quick, strength } => Ok(Answer::data(self.open_to_change(*handle)?.findings(*quick, *strength)?)),
            Wanted::Files { handle, which } => Ok(Answer::of_files(files::files(self.open(*handle)?, which)?)),
            Wanted::Bill { handle } => Ok(Answer::data(self.open(*handle)?.bill()?)),
            Wanted::Difference { before, after, quick } => Ok(Answer::data(self.open(*before)?.difference(self.open(*after)?, *quick)?)),
            Wanted::Beds { handle } => Ok(Answer::data(beds::beds(self.open(*handle)?)?)),
            Wanted::FoldSteps { handle } => Ok(Answer::data(files::fold_steps(self.open(*handle)?)?)),
            Wanted::Stiffness { handle } => Ok(Answer::data(mechanics::stiffness(self.open(*handle)?)?)),
            Wanted::Impact { handle, height_m, motion } => mechanics::impact(self.open(*handle)?, *height_m, *motion),
            Wanted::Drop { model, handle, heights_m, trace } => {
                drops::dropped(&drops::model(model, &request, self.maybe(*handle)?)?, heights_m, *trace)
            }
            Wanted::Measure { written } => drops::measured(&written.format()?, &request),
            Wanted::Synthesize { plan } => drops::synthesized(plan, &request),
            Wanted::Diagnose { model, handle, written, hold_out_heights_m, max_effects, seed } => {
                let (format, frame) = (&written.format()?, self.maybe(*handle)?);
                let course = Course { model: model.as_deref(), frame, format, hold_out_heights_m, max_effects: *max_effects, seed: *seed };
                drops::diagnosed(&request, &course)
            }
        }
    }

    fn facts(&self, handle: Handle) -> Result<Answer, Refused> {
        let mut facts = self.open(handle)?.facts();
        facts["handle"] = handle.into();
        Ok(Answer::data(facts))
    }

    fn open_to_change(&mut self, handle: Handle) -> Result<&mut OpenFrame, Refused> {
        self.frames.get_mut(&handle).ok_or_else(|| not_open(handle))
    }

    fn open(&self, handle: Handle) -> Result<&OpenFrame, Refused> {
        self.frames.get(&handle).ok_or_else(|| not_open(handle))
    }

    fn maybe(&self, handle: Option<Handle>) -> Result<Option<&OpenFrame>, Refused> {
        handle.map(|handle| self.open(handle)).transpose()
    }
}

fn not_open(handle: Handle) -> Refused {
    Refused::plain(format!("no frame is open under {handle}"))
}

/// Each frame has a memo of its own: changes of one do not push out what the other needs again.
fn memo(prepared: &Prepared) -> Arc<Memo> {
    Arc::new(Memo::on(Box::new(prepared.clone())))
}

/// The small results of all checks of every preset.
fn collected() -> Result<Answer, Refused> {
    let collecting = Prepared::collecting();
    for name in preset::names() {
        OpenFrame::new(name, &Memory::default(), memo(&collecting))?.findings(false, false)?;
    }
    let bytes = collecting.written().map_err(Refused::plain)?;
    Ok(Answer { json: Value::Null, files: vec![("prepared.bin".into(), bytes)] })
}

/// A text with other values.
fn edited(text: &str, set: &BTreeMap<String, Option<Setting>>) -> Result<String, Refused> {
    let typed = |setting: &Setting| match setting {
        Setting::Number(number) => Typed::Number(*number),
        Setting::Text(text) => Typed::Text(text.clone()),
    };
    let values: Vec<(&String, Option<Typed>)> = set.iter().map(|(key, value)| (key, value.as_ref().map(typed))).collect();
    let amendments: Vec<Amendment> = values.iter().map(|(key, value)| Amendment { key, value: value.as_ref(), why: "" }).collect();
    amended(text, &amendments).map_err(Refused::plain)
}

/// The numbers and words that a frame file states, by key, whether a frame may have them or not.
fn stated(text: &str) -> Map<String, Value> {
    let entries = ImpactFile::parse("frame", text.trim_start_matches('\u{feff}')).map(|file| file.entries).unwrap_or_default();
    let setting = |typed: Typed| match typed {
        Typed::Number(number) if number.is_finite() => Some(json!(number)),
        Typed::Text(text) => Some(json!(text)),
        _ => None,
    };
    entries.into_iter().filter_map(|(key, entry)| Some((key, setting(entry.value)?))).collect()
}

/// What comes with the program.
fn presets() -> Value {
    let frames: Vec<Value> = preset::names().map(|name| json!({ "name": name, "text": preset::text(name) })).collect();
    let models: Vec<&str> = ImpactFile::names().collect();
    let printers: Vec<&str> = preset::printer_names().collect();
    json!({ "frames": frames, "models": models, "printers": printers })
}
