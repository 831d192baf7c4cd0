//! Files as they were at a revision of a git repository, read by the `git` that is installed.

use std::io::{self, Write};
use std::path::{Component, Path, PathBuf};
use std::process::{Command, Stdio};

use super::failure::Failure;
use crate::params::files::Files;

/// A revision of the repository that holds a file.
pub(super) struct Revision {
    /// The commit, as git names it.
    commit: String,
    /// The repository's top folder.
    top: PathBuf,
    /// How the repository was found.
    found: Found,
}

/// How git finds a repository.
#[derive(Clone, Copy)]
enum Found {
    /// It lies around the folder.
    Around,
    /// The variables `GIT_DIR` and `GIT_WORK_TREE` name it.
    Named,
}

impl Revision {
    /// A revision, by any name that git knows, of the repository around a file.
    ///
    /// # Errors
    /// [`Failure::Usage`] when there is no repository, or no such revision; [`Failure::Machine`] when git cannot be run.
    pub fn of(file: &Path, name: &str) -> Result<Self, Failure> {
        let folder = file.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let usage = |what: String, reason: String| Failure::Usage { message: with_reason(what, &reason) };
        // A hook runs with GIT_DIR=.git, which means nothing in another folder: what lies around the file comes first.
        let mut found = Found::Around;
        let mut top = git(found, folder, &["rev-parse", "--show-toplevel"])?;
        if let Err(around) = top {
            found = Found::Named;
            // Why git reads none where it looked first is what a person can mend.
            top = git(found, folder, &["rev-parse", "--show-toplevel"])?.map_err(|_| around);
        }
        let top = top.map_err(|reason| usage(format!("{} lies in no git repository that git reads", file.display()), reason))?;
        // Without --end-of-options a name that begins with a dash would be taken for an option.
        let commit = git(found, folder, &["rev-parse", "--verify", "--end-of-options", &format!("{name}^{{commit}}")])?;
        let commit = commit.map_err(|reason| usage(format!("this repository has no revision `{name}`"), reason))?;
        Ok(Self { commit, top: PathBuf::from(top), found })
    }

    /// The first digits of the commit.
    pub fn short(&self) -> &str {
        self.commit.get(..9).unwrap_or(&self.commit)
    }

    /// What git calls a file of this revision; none when it lies outside the repository.
    fn object(&self, path: &Path) -> Option<String> {
        let absolute = std::path::absolute(path).ok()?;
        // The top folder is named without links; so is the part of the path that exists.
        let parent = absolute.parent().and_then(|parent| parent.canonicalize().ok());
        let absolute = match (parent, absolute.file_name()) {
            (Some(parent), Some(name)) => parent.join(name),
            _ => plain(&absolute),
        };
        let below = absolute.strip_prefix(&self.top).ok()?.to_str()?.replace('\\', "/");
        Some(format!("{}:{below}", self.commit))
    }
}

impl Revision {
    /// The content of a file of this revision, as git calls it: of a link, of what it leads to. None where there is no such file, or a link leads out
    /// of the repository.
    fn blob(&self, path: &Path) -> Option<String> {
        let object = self.object(path)?;
        let mut child = command(self.found, &self.top, &["cat-file", "--batch-check", "--follow-symlinks"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .ok()?;
        // A name with a line's end would be two of them.
        let asked = !object.contains('\n') && child.stdin.take().is_some_and(|mut to| writeln!(to, "{object}").is_ok());
        let output = child.wait_with_output().ok().filter(|_| asked)?;
        let told = String::from_utf8(output.stdout).ok()?;
        match told.split_whitespace().collect::<Vec<_>>()[..] {
            [name, "blob", _] => Some(name.into()),
            _ => None,
        }
    }
}

/// A path without `.` and `..`.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for component in path.components() {
        match component {
            Component::ParentDir => drop(plain.pop()),
            Component::CurDir => {}
            other => plain.push(other),
        }
    }
    plain
}

impl Files for Revision {
    fn is_file(&self, path: &Path) -> bool {
        self.blob(path).is_some()
    }

    fn bytes(&self, path: &Path, most: u64) -> io::Result<Vec<u8>> {
        let nowhere = || io::Error::new(io::ErrorKind::NotFound, format!("it is not in {}", self.short()));
        let blob = self.blob(path).ok_or_else(nowhere)?;
        let mut child =
            command(self.found, &self.top, &["cat-file", "blob", &blob]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn()?;
        let mut bytes = Vec::new();
        if let Some(out) = child.stdout.take() {
            io::Read::read_to_end(&mut io::Read::take(out, most), &mut bytes)?;
        }
        // A longer file leaves git with a closed pipe, which is not its failure.
        let done = child.wait_with_output()?;
        if done.status.success() || bytes.len() as u64 >= most {
            return Ok(bytes);
        }
        let what = format!("git does not read it in {}", self.short());
        Err(io::Error::other(with_reason(what, String::from_utf8_lossy(&done.stderr).trim_end())))
    }
}

fn command(found: Found, folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new("git");
    if matches!(found, Found::Around) {
        for name in ["GIT_DIR", "GIT_WORK_TREE", "GIT_COMMON_DIR"] {
            command.env_remove(name);
        }
    }
    command.arg("-C").arg(folder).args(arguments).stdin(Stdio::null()).stderr(Stdio::null());
    command
}

/// What git prints, without the line's end; when it fails, why.
fn git(found: Found, folder: &Path, arguments: &[&str]) -> Result<Result<String, String>, Failure> {
    let output = command(found, folder, arguments)
        .stderr(Stdio::piped())
        .output()
        .map_err(|error| Failure::Machine { what: "cannot run git".into(), error })?;
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).trim_end().to_string();
    Ok(if output.status.success() { Ok(text(&output.stdout)) } else { Err(text(&output.stderr)) })
}

/// A message with what git said, in one line, where it said something.
fn with_reason(what: String, reason: &str) -> String {
    let reason = reason.lines().map(str::trim).filter(|line| !line.is_empty()).collect::<Vec<_>>().join(" ");
    if reason.is_empty() { what } else { format!("{what}; git says: {reason}") }
}
