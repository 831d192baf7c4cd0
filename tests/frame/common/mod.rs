//! Frames for the tests: the default frame with numbers changed.

use std::sync::{Arc, LazyLock};

use flexframe::memo::Memo;
use flexframe::params::{Frame, FrameFile, LoadError};

/// A frame file's text with these keys ("table.key") on top of a preset.
pub fn toml(base: &str, changes: &[(String, f64)]) -> String {
    let mut text = format!("base = \"{base}\"\n");
    for (key, value) in changes {
        // TOML writes a whole number with a point, too, where a float is meant; both are read.
        text += &format!("{key} = {value:?}\n");
    }
    text
}

/// The frame that the text describes.
pub fn resolve(text: &str) -> Result<Frame, LoadError> {
    let file = FrameFile::parse("random", text)?;
    Ok(Frame::resolve(&file)?)
}

/// What was computed for the tests before: most of them look at frames that are alike, or at all frames that come with the program, two at a time.
pub fn memo() -> &'static Arc<Memo> {
    static MEMO: LazyLock<Arc<Memo>> = LazyLock::new(|| Arc::new(Memo::lasting(30)));
    &MEMO
}

/// Every preset, and every frame of the gallery.
pub fn all_frames() -> Vec<String> {
    let gallery = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/frames");
    let files = std::fs::read_dir(gallery).expect("is a folder").map(|entry| entry.expect("reads").path());
    let mut all: Vec<String> = files.map(|path| path.to_str().expect("is text").to_owned()).collect();
    all.sort();
    all.extend(flexframe::params::preset::names().map(String::from));
    all
}
