//! Drops of an impact model, and what a model lacks to explain measured ones.

use flexframe::impact::body::DropBody;
use flexframe::impact::diagnose::Stage;
use flexframe::impact::effects::Model;
use flexframe::impact::measured::{FileFormat, JudgedDrops, read_bytes};
use flexframe::impact::request::{DiagnosisRequest, usual_model};
use flexframe::impact::sim::{SolverOptions, System, Trace, check_heights, simulate};
use flexframe::impact::synthetic::{Plan, records, table};
use flexframe::params::ImpactFile;
use flexframe::report::data::{diagnosis_data, drop_data, measure_data};
use serde_json::Value;

use crate::answer::{Answer, Refused};
use crate::open_frame::OpenFrame;
use crate::request::Request;
use crate::tell_stage;

/// A model, with the body of a frame where one is given.
///
/// # Errors
/// What the command line refuses.
pub fn model(name: &str, request: &Request, frame: Option<&OpenFrame>) -> Result<Model, Refused> {
    let mut model = Model::load_from(name, &request.disk())?;
    if let Some(frame) = frame {
        model.body = DropBody::of(&frame.design, &frame.masses);
    }
    Ok(model)
}

/// Drops of a model: `drop.json`.
///
/// # Errors
/// When a height is out of bounds.
pub fn dropped(model: &Model, heights_m: &[f64], trace: bool) -> Result<Answer, Refused> {
    check_heights(heights_m).map_err(Refused::plain)?;
    let system = System::new(model);
    let traces: Vec<Trace> = heights_m.iter().map(|height_m| simulate(&system, *height_m, &SolverOptions::REPORT)).collect();
    Ok(with_file("drop.json", drop_data::json(model, &traces, trace)))
}

/// How a diagnosis is to be done.
pub struct Course<'a> {
    /// A model's name or attached file; without one, that which is usual for such drops.
    pub model: Option<&'a str>,
    /// The frame whose mass and gap hold instead of the model's.
    pub frame: Option<&'a OpenFrame>,
    /// How the drops are written.
    pub format: &'a FileFormat,
    /// Heights that no fit sees, m.
    pub hold_out_heights_m: &'a [f64],
    /// Most effects.
    pub max_effects: usize,
    /// Of the simulated data.
    pub seed: u64,
}

/// A diagnosis of the drops that are attached to a request: `diagnosis.json` and `model.toml`.
///
/// # Errors
/// What the command line refuses.
pub fn diagnosed(request: &Request, course: &Course) -> Result<Answer, Refused> {
    let Course { model: named, frame, format, hold_out_heights_m, max_effects, seed } = *course;
    DiagnosisRequest::bounds(max_effects).map_err(Refused::plain)?;
    let drops = read_bytes(&tables(request), format)?;
    let model = model(named.unwrap_or_else(|| usual_model(&drops)), request, frame)?;
    let asked =
        DiagnosisRequest { model, drops: &drops, axes: None, hold_out_heights_m, static_test: None, covariates: &[], max_effects, seed };
    let stage = |stage: Stage| tell_stage(stage.before(max_effects), Stage::count(max_effects), &stage.words());
    let (found, compared) = asked.diagnosed(&stage).map_err(Refused::plain)?;
    let mut answer = with_file("diagnosis.json", diagnosis_data::json(&found, &compared));
    answer.files.push(("model.toml".into(), diagnosis_data::model_file(&found, &compared).into_bytes()));
    Ok(answer)
}

/// The attached drops, judged: `measure.json`.
///
/// # Errors
/// What the command line refuses.
pub fn measured(format: &FileFormat, request: &Request) -> Result<Answer, Refused> {
    let set = read_bytes(&tables(request), format)?;
    Ok(with_file("measure.json", measure_data::json(&set, &JudgedDrops::of(&set))))
}

/// Drops with a known truth, from an attached plan: `drops.csv`.
///
/// # Errors
/// What the command line refuses.
pub fn synthesized(plan: &str, request: &Request) -> Result<Answer, Refused> {
    let plan = Plan::resolve(&ImpactFile::load_from(plan, &request.disk())?)?;
    let mut answer = Answer::data(Value::Null);
    answer.files.push(("drops.csv".into(), table(&records(&plan)).into_bytes()));
    Ok(answer)
}

/// The attached files that are no parameters.
fn tables(request: &Request) -> Vec<(String, Vec<u8>)> {
    request.attached.iter().filter(|(path, _)| !path.ends_with(".toml")).cloned().collect()
}

/// Data, and the file that the command line writes of it.
fn with_file(name: &str, json: Value) -> Answer {
    let bytes = format!("{json:#}\n").into_bytes();
    Answer { json, files: vec![(name.into(), bytes)] }
}
