//! PrusaSlicer, run on one part after the other.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use std::{fs, io};

use rayon::prelude::*;

use super::failure::Failure;
use crate::export::stl;
use crate::frame::assembly::{Design, Printed};
use crate::params::PartName;
use crate::params::catalogue::{Material, Printer};
use crate::printing::filament::Filament;
use crate::printing::plates::{PrintSettings, SlicerFamily};
use crate::printing::weighing::Sliced;
use crate::report::page::weighing_page::SLICER_RATIO;

/// Longest that a part may take.
const PATIENCE: Duration = Duration::from_secs(600);
/// How often it is asked whether it is done.
const POLL: Duration = Duration::from_millis(20);
/// Side of a bed that holds any part that can be printed, mm: what does not fit the printer is `check`'s to say.
const BED_MM: f64 = 500.0;

/// A slicer that answers.
pub(super) struct Slicer {
    program: String,
}

impl Slicer {
    /// Looks for the program.
    ///
    /// # Errors
    /// [`Failure::Machine`] when it cannot be started.
    pub(super) fn found(program: &str) -> Result<Self, Failure> {
        let asked = Command::new(program).arg("--help").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).status();
        match asked {
            Ok(_) => Ok(Self { program: program.into() }),
            Err(error) => {
                let what = format!("cannot start {program}; install PrusaSlicer, or give its program as --slicer=PROGRAM");
                Err(Failure::Machine { what, error })
            }
        }
    }

    /// What each part takes of filament: its own print settings, without skirt, brim and support.
    ///
    /// # Errors
    /// [`Failure::Machine`] when a part cannot be sliced.
    pub(super) fn all(&self, design: &Design) -> Result<BTreeMap<PartName, Sliced>, Failure> {
        let folder = tempfile::tempdir().map_err(|error| Failure::Machine { what: "cannot make a folder to slice in".into(), error })?;
        let sliced = |part: &Printed| {
            self.one(design, part, folder.path()).map(|sliced| (part.name, sliced)).map_err(|error| {
                let what = format!("{} cannot slice {}", self.program, part.name);
                Failure::Machine { what, error }
            })
        };
        design.printed.par_iter().map(sliced).collect()
    }

    /// A part; once more without overlap where that may be why it takes more or less than its volume.
    fn one(&self, design: &Design, part: &Printed, folder: &Path) -> io::Result<Sliced> {
        let mass_g = self.mass_g(design, part, folder, &[])?;
        let solid_g = design.material_of(part.name).material.solid_g(part.volume_mm3);
        let doubtful = (mass_g / solid_g - 1.0).abs() > SLICER_RATIO;
        let without_overlap_g = doubtful.then(|| self.mass_g(design, part, folder, &["--infill-overlap", "0%"])).transpose()?;
        Ok(Sliced { mass_g, without_overlap_g })
    }

    fn mass_g(&self, design: &Design, part: &Printed, folder: &Path, instead: &[&str]) -> io::Result<f64> {
        let file = |ending: &str| folder.join(format!("{}.{ending}", part.name));
        let [solid, settings, gcode] = ["stl", "ini", "gcode"].map(file);
        fs::write(&solid, stl::binary(&part.mesh)?)?;
        fs::write(&settings, ini(&design.material_of(part.name).material, &design.frame.printer))?;
        let log = file("log");
        let said = fs::File::create(&log)?;
        let child = Command::new(&self.program)
            .arg("--load")
            .arg(&settings)
            .args(instead)
            .args([Path::new("--export-gcode"), Path::new("--output"), &gcode, &solid])
            .stdin(Stdio::null())
            .stdout(Stdio::from(said.try_clone()?))
            .stderr(Stdio::from(said))
            .spawn()?;
        ended(child, &log)?;
        let volume_mm3 = Filament::of(&design.frame.printer).volume_mm3(filament_mm(&gcode)?);
        Ok(design.material_of(part.name).material.solid_g(volume_mm3))
    }
}

/// Waits for a program, not for ever.
fn ended(mut child: Child, log: &Path) -> io::Result<()> {
    let begun = Instant::now();
    loop {
        match child.try_wait()? {
            Some(status) if status.success() => return Ok(()),
            Some(status) => {
                let said = text_of(log).unwrap_or_default();
                let said = said.trim().lines().last().map(|line| format!(": {line}")).unwrap_or_default();
                return Err(io::Error::other(format!("it ended with {status}{said}")));
            }
            None if begun.elapsed() > PATIENCE => {
                child.kill()?;
                child.wait()?;
                return Err(io::Error::new(io::ErrorKind::TimedOut, format!("no answer in {} s", PATIENCE.as_secs())));
            }
            None => std::thread::sleep(POLL),
        }
    }
}

/// The settings of a part as the slicer's own file.
fn ini(material: &Material, printer: &Printer) -> String {
    let mut own = PrintSettings::of_part(false, material, printer);
    own.0.retain(|one| !one.keys(SlicerFamily::Prusa).iter().any(|key| ["brim_width", "elefant_foot_compensation"].contains(key)));
    let mut text = own.ini();
    text += &format!(
        "brim_width = 0\nskirts = 0\nelefant_foot_compensation = 0\nnozzle_diameter = {}\nfilament_diameter = {}\n\
         bed_shape = 0x0,{BED_MM}x0,{BED_MM}x{BED_MM},0x{BED_MM}\nmax_print_height = {BED_MM}\n",
        printer.nozzle_mm,
        Filament::of(printer).diameter_mm
    );
    // A material without layers of its own has those of the printer's nozzle, as in every check.
    let layer_mm = printer.layer_mm(material);
    if material.layer_mm.is_none() {
        text += &format!("layer_height = {layer_mm}\n");
    }
    text += &format!("first_layer_height = {layer_mm}\n");
    text
}

/// Length of filament that a G-code file says it takes, mm.
fn filament_mm(gcode: &Path) -> io::Result<f64> {
    let text = text_of(gcode)?;
    let said = text.lines().rev().find_map(|line| line.strip_prefix("; filament used [mm] = "));
    said.and_then(|said| said.trim().parse().ok()).ok_or_else(|| io::Error::other("its G-code does not say what filament it takes"))
}

/// What the slicer wrote.
fn text_of(file: &Path) -> io::Result<String> {
    let mut bytes = Vec::new();
    fs::File::open(file)?.read_to_end(&mut bytes)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
