//! What comes back: JSON and files, or a refusal.

use flexframe::checks::gate;
use flexframe::export::File;
use flexframe::impact::measured::Malformed;
use flexframe::params::LoadError;
use flexframe::params::refusal::Refusal;
use flexframe::workspace;
use serde_json::{Value, json};

/// An answer.
#[derive(Debug)]
pub struct Answer {
    /// The data.
    pub json: Value,
    /// Path and bytes.
    pub files: Vec<(String, Vec<u8>)>,
}

impl Answer {
    /// Data alone.
    pub fn data(json: Value) -> Self {
        Self { json, files: Vec::new() }
    }

    /// Files alone.
    pub fn of_files(files: Vec<File>) -> Self {
        Self { json: Value::Null, files: files.into_iter().map(|file| (file.path, file.bytes)).collect() }
    }

    /// The text, `answer` and the `files` with their lengths, and the files' bytes one after the other.
    pub fn written(self) -> (Vec<u8>, Vec<u8>) {
        let listed: Vec<Value> = self.files.iter().map(|(path, bytes)| json!({ "path": path, "length": bytes.len() })).collect();
        let text = json!({ "answer": self.json, "files": listed }).to_string().into_bytes();
        (text, self.files.into_iter().flat_map(|(_, bytes)| bytes).collect())
    }
}

/// Why there is no answer: what the command line says.
#[derive(Debug)]
pub struct Refused {
    message: String,
    remedy: Option<String>,
    place: Value,
}

impl Refused {
    /// A refusal without a place.
    pub fn plain(message: impl ToString) -> Self {
        Self { message: message.to_string(), remedy: None, place: Value::Null }
    }
}

impl From<gate::Refused> for Refused {
    fn from(refused: gate::Refused) -> Self {
        let place = refused.spot.map(|spot| json!({ "file": spot.file, "line": spot.line, "column": spot.column }));
        Self { message: refused.message, remedy: Some(refused.remedy), place: place.unwrap_or_default() }
    }
}

impl From<Refusal> for Refused {
    fn from(refusal: Refusal) -> Self {
        gate::Refused::of(&refusal).into()
    }
}

impl From<LoadError> for Refused {
    fn from(error: LoadError) -> Self {
        gate::Refused::of_load(&error).into()
    }
}

impl From<workspace::Refused> for Refused {
    fn from(refused: workspace::Refused) -> Self {
        match refused {
            workspace::Refused::Frame(refusal) => refusal.into(),
            workspace::Refused::Folder(_) | workspace::Refused::Ended => Self::plain(refused),
        }
    }
}

impl From<Malformed> for Refused {
    fn from(malformed: Malformed) -> Self {
        Self { message: malformed.to_string(), remedy: Some(malformed.fault.remedy().to_string()), place: Value::Null }
    }
}

impl From<Refused> for Answer {
    fn from(refused: Refused) -> Self {
        Self::data(json!({ "message": refused.message, "remedy": refused.remedy, "place": refused.place }))
    }
}
