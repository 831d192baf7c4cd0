//! A frame file as it is written: a base, and what differs, each with the reason.

use std::io;
use std::path::{Path, PathBuf};

use toml_edit::Key;

use super::cache;
use super::failure::Failure;
use super::options::Common;
use super::output;
use super::session;
use crate::frame::assembly::Design;
use crate::params::amend::{Amendment, amended, quoted};
use crate::params::files::{Disk, Files};
use crate::params::frame_file::Value;
use crate::params::{Frame, FrameFile, frame_name, preset};

/// A line of a frame file.
pub(super) struct Line {
    /// Key with its table, as TOML writes it.
    pub key: String,
    /// Its value.
    pub value: Value,
    /// Why it stands there.
    pub why: String,
}

/// Where a frame of a name is written: in the working directory, or at a path. Nothing may be there yet, and something can be put there: a search
/// whose result has no place would be in vain.
pub(super) fn place(name: &str) -> Result<PathBuf, Failure> {
    let path = PathBuf::from(if name.ends_with(".toml") { name.to_string() } else { format!("{name}.toml") });
    let usage = |message: String| Failure::Usage { message };
    let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
    if let Some(fault) = frame_name::fault(stem) {
        return Err(usage(format!("{fault}: {}", frame_name::rule())));
    }
    if preset::text(stem).is_some() {
        return Err(usage(format!(
            "{stem} is a preset: files beside it that name it as their base would then mean this one; choose another name"
        )));
    }
    // A link that leads nowhere is something, too.
    if path.symlink_metadata().is_ok() {
        return Err(usage(format!("{} is there already: choose another name", path.display())));
    }
    output::can_be_written(&path).map_err(|error| unwritten(&path, error))?;
    Ok(path)
}

fn unwritten(place: &Path, error: io::Error) -> Failure {
    Failure::Machine { what: format!("cannot write {}", place.display()), error }
}

/// Writes a frame file on a base, which is named as [`base_for`] says.
pub(super) fn write(place: &Path, base: &str, description: &str, lines: &[Line]) -> Result<(), Failure> {
    let text = text(base, description, lines).map_err(|message| Failure::Usage { message: format!("{}: {message}", place.display()) })?;
    output::write_new(place, text.as_bytes()).map_err(|error| unwritten(place, error))
}

/// A key with its tables as TOML writes it: what is not plain is quoted.
pub(super) fn key(steps: &[&str]) -> String {
    steps.iter().map(|step| Key::new(*step).to_string()).collect::<Vec<_>>().join(".")
}

/// A frame file with further lines in it, read as a frame and not yet written.
pub(super) struct AmendedFile {
    place: PathBuf,
    is_new: bool,
    text: String,
    frame: Frame,
    file: FrameFile,
}

impl AmendedFile {
    /// Puts lines into a frame file: one that is there keeps all else, comments too; a new one has a frame as its base.
    ///
    /// # Errors
    /// When the file cannot be read, or with these lines is no frame.
    pub fn new(place: &Path, frame: &str, description: &str, lines: &[Line]) -> Result<Self, Failure> {
        if place.extension().is_none_or(|ending| ending != "toml") {
            let message = format!("{} is no frame file: its name has to end in .toml", place.display());
            return Err(Failure::Usage { message });
        }
        let usage = |message: String| Failure::Usage { message: format!("{}: {message}", place.display()) };
        let name = place.display().to_string();
        let is_new = place.symlink_metadata().is_err();
        let text = if is_new {
            let place = self::place(&name)?;
            text(&base_for(&place, frame)?, description, lines).map_err(usage)?
        } else {
            let former = FrameFile::load(&name)?;
            amended(former.files.first().map_or("", |source| &source.text), &amendments(lines)).map_err(usage)?
        };
        let file = FrameFile::load_from(&name, &Unwritten { place, text: &text })?;
        let (frame, file) = session::resolved(file)?;
        Ok(Self { place: place.to_path_buf(), is_new, text, frame, file })
    }

    /// The design of its frame.
    ///
    /// # Errors
    /// When the frame cannot be designed: it does not close, or parts collide.
    pub fn designed(&self, common: &Common) -> Result<Design, Failure> {
        session::designed(self.frame.clone(), &self.file, &cache::memo(common))
    }

    /// Writes it.
    ///
    /// # Errors
    /// When the place cannot be written, or holds a read-only file.
    pub fn write(&self) -> Result<(), Failure> {
        let write = if self.is_new { output::write_new } else { output::replace_users_file };
        write(&self.place, self.text.as_bytes()).map_err(|error| unwritten(&self.place, error))
    }
}

/// The disk with a text in the place of one of its files.
struct Unwritten<'a> {
    place: &'a Path,
    text: &'a str,
}

impl Files for Unwritten<'_> {
    fn is_file(&self, path: &Path) -> bool {
        path == self.place || Disk.is_file(path)
    }

    fn bytes(&self, path: &Path, most: u64) -> io::Result<Vec<u8>> {
        if path != self.place {
            return Disk.bytes(path, most);
        }
        let most = usize::try_from(most).unwrap_or(usize::MAX);
        Ok(self.text.as_bytes()[..self.text.len().min(most)].to_vec())
    }
}

/// A base as a file in another folder names it: a preset's name, or the way from one file to the other.
pub(super) fn base_for(place: &Path, base: &str) -> Result<String, Failure> {
    if base.ends_with(".toml") {
        return Ok(named_from(place, base));
    }
    let shadow = folder(place).join(format!("{base}.toml"));
    if shadow.exists() {
        let message = format!("the preset {base} is hidden by {}: give that file, or write elsewhere", shadow.display());
        return Err(Failure::Usage { message });
    }
    Ok(base.into())
}

/// A file as another file names it: the way from that one's folder, where there is one.
pub(super) fn named_from(place: &Path, named: &str) -> String {
    let file = Path::new(named);
    let name = file.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    way(&folder(place), &folder(file)).map_or_else(|| named.to_string(), |way| way + &name)
}

/// The folder of a file.
fn folder(path: &Path) -> PathBuf {
    std::path::absolute(path).ok().and_then(|path| path.parent().map(Path::to_path_buf)).unwrap_or_default()
}

/// The way from one folder to another, with a slash at its end; none between drives. Links on the way are resolved, where
/// `..` would not lead back.
fn way(from: &Path, to: &Path) -> Option<String> {
    let real = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    let (from, to) = (real(from), real(to));
    let (from, to): (Vec<_>, Vec<_>) = (from.components().collect(), to.components().collect());
    let same = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    let up = (same > 0).then(|| "../".repeat(from.len() - same))?;
    Some(to[same..].iter().fold(up, |way, part| format!("{way}{}/", part.as_os_str().to_string_lossy())))
}

fn text(base: &str, description: &str, lines: &[Line]) -> Result<String, String> {
    let head = format!(
        "# {}.\n# What does not stand here is that of the base; `flexframe explain KEY` says what a key does.\nbase = {}\ndescription = {}\n",
        description.replace(char::is_control, " "),
        quoted(base),
        quoted(description)
    );
    amended(&head, &amendments(lines))
}

fn amendments(lines: &[Line]) -> Vec<Amendment<'_>> {
    lines.iter().map(|Line { key, value, why }| Amendment { key, value: Some(value), why }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::FrameFile;

    #[test]
    fn analytic_the_way_between_folders() {
        let way = |from: &str, to: &str| way(Path::new(from), Path::new(to)).expect("a way");
        assert_eq!([way("/a/b", "/a/b"), way("/a/b", "/a/c/d"), way("/a", "/a/c")], ["", "../c/d/", "c/"]);
    }

    #[test]
    fn analytic_what_is_written_reads() {
        let line = |key: &str, value: Value| Line { key: key.into(), value, why: "because\nof this".into() };
        let lines = [
            line("rods.arm_rod_length_mm", Value::Number(80.0)),
            line("bought.battery", Value::Text("battery-2s-850".into())),
            line("rods.cage_rod_length_mm", Value::Number(190.125)),
            line("printer", Value::Text("prusa-mk4".into())),
            line("override.printers.\"generic-0.4\".nozzle_mm", Value::Number(0.6)),
        ];
        let text = text("cognifly", "A \"quoted\" \\ description", &lines).expect("is TOML");
        let file = FrameFile::parse("mine", &text).expect(&text);
        for Line { key, value, .. } in &lines {
            assert_eq!(&file.entries[&key.replace('"', "")].value, value, "{text}");
        }
        assert_eq!(file.entries["description"].value, Value::Text("A \"quoted\" \\ description".into()));
    }
}
