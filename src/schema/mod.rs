//! JSON Schemas (draft 7) of input files, generated from the tables that the readers use. Editors that support `#:schema`
//! complete and check files with them. A schema describes each key. Contradictions between keys are found by the program only.

mod catalogue;
mod element;
mod frame;
mod mechanics;
mod model;
mod study;

use serde_json::{Value, json};

/// A kind of file that is read.
pub struct FileKind {
    /// Its name on the command line.
    pub name: &'static str,
    /// What it is, in the help.
    pub sentence: &'static str,
    /// The schema's title.
    title: &'static str,
    body: fn() -> Value,
}

/// Every kind of file that has a schema.
pub const CATALOGUE: [FileKind; 9] = [
    kind("frame", "A frame file", "frame of flexframe", frame::schema),
    kind("model", "An impact model", "impact model of flexframe", model::schema),
    kind("plan", "A plan of synthetic drops", "plan of synthetic drops of flexframe", model::plan),
    kind("study", "A plan of a study", "plan of a study of flexframe", study::schema),
    kind("mechanics", "The numbers of the frame's mechanics", "mechanics of flexframe", mechanics::schema),
    kind("bought", "The form of params/bought.toml", "bought parts of flexframe", catalogue::bought),
    kind("materials", "The form of params/materials.toml", "materials of flexframe", catalogue::materials),
    kind("printer", "A printer", "printer of flexframe", catalogue::printer),
    kind("baseline", "A list of accepted findings", "accepted findings of flexframe", catalogue::baseline),
];

const fn kind(name: &'static str, sentence: &'static str, title: &'static str, body: fn() -> Value) -> FileKind {
    FileKind { name, sentence, title, body }
}

impl FileKind {
    /// The schema of such a file.
    pub fn schema(&self) -> Value {
        let mut schema = json!({ "$schema": "http://json-schema.org/draft-07/schema#", "title": self.title });
        if let (Some(schema), Value::Object(body)) = (schema.as_object_mut(), (self.body)()) {
            schema.extend(body);
        }
        schema
    }
}
