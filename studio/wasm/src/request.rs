//! What may be asked, and the files that come with it.

use std::collections::BTreeMap;
use std::path::PathBuf;

use flexframe::impact::measured::{FileFormat, TableFormat};
use flexframe::params::files::Memory;
use flexframe::units::Angle;
use serde::Deserialize;

use crate::answer::Refused;

/// A frame that is open, by the number that `open` gave it.
pub type Handle = u32;

/// A request. Text fields are what the command line takes; a name that ends in `.toml` or `.csv` is an attached file.
#[derive(Debug, Deserialize)]
#[serde(tag = "do", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Wanted {
    /// The frames, models and printers that come with the program, with the frames' texts.
    Presets,
    /// What a frame file may say and choose, and the rules.
    Catalogue,
    /// Checks every preset, and gives the small results of doing so as a file that `use-results` takes: for whoever publishes the engine.
    CollectResults,
    /// Takes such files of this build of the engine: frames that are checked use them instead of computing the same again.
    UseResults,
    /// The text of a frame file with other values; nothing is resolved.
    Edit {
        /// The text.
        text: String,
        /// Values by key; `null` takes a key out.
        set: BTreeMap<String, Option<Setting>>,
    },
    /// Reads a frame without designing it: numbers, choices, or the refusal.
    Read {
        /// A preset's name, or an attached file with its bases.
        frame: String,
    },
    /// Opens a frame: a preset's name, or an attached file with its bases.
    Open {
        /// Which.
        frame: String,
    },
    /// Another frame, or other files, in the place of one that is open; parts that stay the same are not made again.
    Change {
        /// The open frame.
        handle: Handle,
        /// Which frame instead.
        frame: String,
    },
    /// Closes a frame.
    Close {
        /// The open frame.
        handle: Handle,
    },
    /// Findings and masses, as of `check --json`.
    Findings {
        /// The open frame.
        handle: Handle,
        /// Without the passes that take longest.
        #[serde(default)]
        quick: bool,
        /// The findings of a drop by the frame's own mechanics, too.
        #[serde(default)]
        strength: bool,
    },
    /// Files of a frame.
    Files {
        /// The open frame.
        handle: Handle,
        /// Which.
        which: Vec<Which>,
    },
    /// The bill of materials, as of `bom --json`.
    Bill {
        /// The open frame.
        handle: Handle,
    },
    /// What another frame changes of one, as of `diff --json`.
    Difference {
        /// The one.
        before: Handle,
        /// The other.
        after: Handle,
        /// Without the findings that take longest.
        #[serde(default)]
        quick: bool,
    },
    /// How the printed parts lie on the bed.
    Beds {
        /// The open frame.
        handle: Handle,
    },
    /// The steps of the fold, without the search for collisions on the way.
    FoldSteps {
        /// The open frame.
        handle: Handle,
    },
    /// Stiffness and modes by the frame's own mechanics, as of `stiffness --json`.
    Stiffness {
        /// The open frame.
        handle: Handle,
    },
    /// Drops of an impact model, as of `drop --json`.
    Drop {
        /// A model's name or attached file.
        model: String,
        /// The frame whose mass and gap hold instead of the model's.
        handle: Option<Handle>,
        /// Drop heights, m.
        heights_m: Vec<f64>,
        /// With the series: the sensor's output, compression, force of the ground.
        #[serde(default)]
        trace: bool,
    },
    /// A level drop by the frame's own mechanics, as of `drop --model frame --trace --json`.
    Impact {
        /// The open frame.
        handle: Handle,
        /// Drop height, m.
        height_m: f64,
        /// Its motion, too, as an animated GLB.
        #[serde(default)]
        motion: bool,
    },
    /// The attached drops, judged, as of `measure --json`.
    Measure {
        /// How the tables are written.
        #[serde(default)]
        written: Written,
    },
    /// Drops with a known truth.
    Synthesize {
        /// The attached plan.
        plan: String,
    },
    /// What a model lacks, as of `diagnose --json`; the attached tables and logger's files are the drops.
    Diagnose {
        /// A model's name or attached file; without one, that which is usual for such drops.
        model: Option<String>,
        /// The frame whose mass and gap hold instead of the model's.
        handle: Option<Handle>,
        /// How the tables are written.
        #[serde(default)]
        written: Written,
        /// Heights that no fit sees, m.
        #[serde(default)]
        hold_out_heights_m: Vec<f64>,
        /// Most effects, 1 to 3.
        #[serde(default = "three")]
        max_effects: usize,
        /// Of the simulated data.
        #[serde(default = "one")]
        seed: u64,
    },
}

/// How tables of drops are written where they are not as this program writes them: what `--columns`, `--units`, `--zero`, `--rate` and `--turn` take.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Written {
    /// `t=Time`, `z=-Acc_Z`.
    columns: Vec<String>,
    /// `m/s2`, `ms`.
    units: Vec<String>,
    /// Readings in free fall, g: along the axis, or x, y and z.
    zero_g: Vec<f64>,
    /// Samples a second.
    rate_hz: Option<f64>,
    /// From the frame's front to the sensor's x, deg.
    turn_deg: f64,
}

impl Written {
    /// As the readers of files take it.
    ///
    /// # Errors
    /// What the command line refuses.
    pub fn format(&self) -> Result<FileFormat, Refused> {
        let table = TableFormat::new(&self.columns, &self.units, self.rate_hz).and_then(|table| table.zeroed(&self.zero_g));
        Ok(FileFormat { table: table.map_err(Refused::plain)?, turn: Angle::deg(self.turn_deg), ..FileFormat::default() })
    }
}

/// A value of a frame file.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum Setting {
    /// A number.
    Number(f64),
    /// A name.
    Text(String),
}

fn three() -> usize {
    3
}

fn one() -> u64 {
    1
}

/// Files of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Which {
    /// Every part.
    Stl,
    /// `frame.glb`.
    Glb,
    /// The plates with their pictures.
    Plates,
    /// Every part and the assembly.
    Step,
    /// `bom.csv`.
    Bill,
    /// `fold.json`.
    Fold,
    /// `fold.glb`.
    FoldMotion,
    /// `instructions.pdf`.
    Instructions,
    /// `report.md` with its pictures, and how to print.
    Report,
    /// Everything that `build --step` writes.
    Folder,
}

/// A file's name and size; its bytes follow the text.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Attachment {
    path: String,
    length: usize,
}

/// The envelope of a request.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Envelope {
    request: Wanted,
    #[serde(default)]
    attached: Vec<Attachment>,
}

/// A request with its files.
#[derive(Debug)]
pub struct Request {
    /// What is wanted.
    pub wanted: Wanted,
    /// The attached files in the order given.
    pub attached: Vec<(String, Vec<u8>)>,
}

impl Request {
    /// The attached files as a disk.
    pub fn disk(&self) -> Memory {
        let files: BTreeMap<PathBuf, Vec<u8>> = self.attached.iter().map(|(path, bytes)| (PathBuf::from(path), bytes.clone())).collect();
        Memory(files)
    }
}

/// Reads a request.
///
/// # Errors
/// When it is no request, or an attached file is cut short.
pub fn read(text: &[u8], mut bytes: &[u8]) -> Result<Request, Refused> {
    let Envelope { request, attached } =
        serde_json::from_slice(text).map_err(|error| Refused::plain(format!("this is no request: {error}")))?;
    let mut files = Vec::new();
    for Attachment { path, length } in attached {
        let Some((file, rest)) = bytes.split_at_checked(length) else {
            return Err(Refused::plain(format!("the attached file {path} is cut short: {} of {length} bytes", bytes.len())));
        };
        files.push((path, file.to_vec()));
        bytes = rest;
    }
    Ok(Request { wanted: request, attached: files })
}
