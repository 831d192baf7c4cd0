//! A frame that is open: as typed, as meant, and as designed.

use std::sync::Arc;

use flexframe::checks::gate::{CheckedFrame, Outcome, Policy, data};
use flexframe::checks::{self, CATALOGUE, Cost};
use flexframe::export::bill;
use flexframe::frame::assembly::Design;
use flexframe::frame::assembly::mass::{self, MassTable};
use flexframe::mechanics::model::frame_model::{Extent, FrameModel};
use flexframe::mechanics::result::prediction::predict;
use flexframe::mechanics::result::static_curve::StaticCurve;
use flexframe::mechanics::settings::MechanicsSettings;
use flexframe::mechanics::solve::modes::Modes;
use flexframe::memo::Memo;
use flexframe::params::files::Files;
use flexframe::params::{Frame, FrameFile};
use flexframe::report::data::stiffness_data::{self, Stiffness};
use serde_json::Value;

use crate::answer::Refused;

/// How far the centre is pressed down, mm, where the inside is reported, mm, and how many modes: as `stiffness` does.
const DOWN_MM: f64 = 34.0;
const INSIDE_MM: [f64; 2] = [1.0, 16.0];
const MODES: usize = 8;

/// A frame.
pub struct OpenFrame {
    asked: String,
    file: FrameFile,
    /// The bodies.
    pub design: Design,
    /// Their masses.
    pub masses: MassTable,
}

impl OpenFrame {
    /// Reads and designs a frame: a preset's name, or a file among these.
    ///
    /// # Errors
    /// What the command line refuses.
    pub fn new(asked: &str, files: &dyn Files, memo: &Arc<Memo>) -> Result<Self, Refused> {
        let file = FrameFile::load_from(asked, files)?;
        let frame = Frame::resolve(&file)?;
        let design = Design::with(frame, memo).map_err(|error| Refused::of_design(&file, &error))?;
        let masses = mass::table(&design);
        Ok(Self { asked: asked.into(), file, design, masses })
    }

    /// Findings and masses, as of `check --json`.
    ///
    /// # Errors
    /// When the mechanics cannot be computed.
    pub fn findings(&self, quick: bool, strength: bool) -> Result<Value, Refused> {
        let dearest = if quick { Cost::Quick } else { Cost::Slow };
        let mut findings = checks::check_by(&CATALOGUE, dearest, &self.design, &self.masses);
        if strength {
            let settings = MechanicsSettings::load(None)?;
            let found = predict(&self.design, &self.masses, &settings).map_err(mechanics)?;
            findings.extend(checks::strength(&self.design, &settings.limits, &found));
        }
        let checked = CheckedFrame::new(&self.design.frame, &self.file, findings, self.masses.clone(), Policy::default());
        Ok(data::json(&[Outcome { asked: self.asked.clone(), result: Ok(checked) }]))
    }

    /// The bill of materials, as of `bom --json`.
    ///
    /// # Errors
    /// When it cannot be written as JSON.
    pub fn bill(&self) -> Result<Value, Refused> {
        serde_json::to_value(bill::bill(&self.design, &self.masses, None)).map_err(Refused::plain)
    }

    /// Stiffness and modes, as of `stiffness --json`.
    ///
    /// # Errors
    /// When the mechanics cannot be computed.
    pub fn stiffness(&self) -> Result<Value, Refused> {
        let settings = MechanicsSettings::load(None)?;
        let model = |extent| FrameModel::new(&self.design, &self.masses, &settings, extent).map_err(mechanics);
        let curve = StaticCurve::new(&model(Extent::Quarter)?, DOWN_MM, &INSIDE_MM).map_err(mechanics)?;
        let modes = Modes::new(&model(Extent::Whole)?, MODES).map_err(mechanics)?;
        Ok(stiffness_data::json(&Stiffness {
            frame: &self.design.frame.name,
            settings: &settings,
            curve: &curve,
            modes: Some(&modes),
            measured: &[],
            rms_n: None,
            calibrated: false,
            ratios: None,
        }))
    }
}

/// A failure of the model, as the command line says it.
fn mechanics(error: impl std::fmt::Display) -> Refused {
    Refused::plain(format!("the frame's mechanics cannot be computed: {error}"))
}
