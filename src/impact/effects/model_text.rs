//! A model file to a model, and back.

use std::sync::Arc;

use super::catalogue::CATALOGUE;
use super::frame_curve::{FrameCurve, REACH_MM};
use super::model::{Listed, Model};
use super::sensor::{Channel, Sensor};
use super::spec::Spec;
use crate::impact::body::{DropBody, Origin};
use crate::params::files::Files;
use crate::params::refusal::{Reason, Refusal};
use crate::params::{ImpactFile, LoadError};

/// Most stages of the low-pass of a sensor.
pub const MOST_STAGES: usize = 3;

/// A number of a model file that belongs to no effect: key, bounds, unit.
struct Plain {
    key: &'static str,
    bounds: [f64; 2],
    unit: &'static str,
}

const MASS: Plain = Plain { key: "mass_kg", bounds: [0.01, 100.0], unit: "kg" };
const GAP: Plain = Plain { key: "gap_mm", bounds: [0.0, 1000.0], unit: "mm" };
const CUTOFF: Plain = Plain { key: "sensor.cutoff_hz", bounds: [1.0, 20_000.0], unit: "Hz" };
const ORDER: Plain = Plain { key: "sensor.order", bounds: [1.0, MOST_STAGES as f64], unit: "1" };
const LIMIT: Plain = Plain { key: "sensor.limit_g", bounds: [1.0, 100_000.0], unit: "g" };
/// Numbers of a model file that belong to no effect: key, bounds, unit, and what each is.
pub const PLAIN_NUMBERS: [(&str, [f64; 2], &str, &str); 5] = [
    (MASS.key, MASS.bounds, MASS.unit, "Mass that falls."),
    (GAP.key, GAP.bounds, GAP.unit, "Clearance of the lowest body above the ground; it adds no force."),
    (CUTOFF.key, CUTOFF.bounds, CUTOFF.unit, "Corner of the sensor's low pass."),
    (ORDER.key, ORDER.bounds, ORDER.unit, "Order of the sensor's low pass."),
    (LIMIT.key, LIMIT.bounds, LIMIT.unit, "Full scale of the sensor."),
];

/// Key of what the sensor reads.
pub const CHANNEL: &str = "sensor.channel";

/// What the sensor may read.
pub fn channel_words() -> [&'static str; 2] {
    CHANNELS.map(|(word, _)| word)
}

const CHANNELS: [(&str, Channel); 2] = [("axial", Channel::Axial), ("magnitude", Channel::Magnitude)];

impl Plain {
    fn stated(&self, file: &ImpactFile) -> Result<f64, Refusal> {
        file.stated(self.key, self.bounds, self.unit)
    }
}

/// Keys of the points of a frame's curve: compressions, and force over stiffness at rest, mm.
pub const CURVE: [&str; 2] = ["effects.frame_force_curve.x_mm", "effects.frame_force_curve.phi_mm"];

/// The frame's curve of a file that has the effect.
fn curve(file: &ImpactFile, effects: &[Listed]) -> Result<Option<Arc<FrameCurve>>, Refusal> {
    if effects.iter().all(|listed| !listed.spec.takes_frame_curve()) {
        return Ok(None);
    }
    let [x_mm, phi_mm] = [file.numbers(CURVE[0], REACH_MM, "mm")?, file.numbers(CURVE[1], [-REACH_MM[1], REACH_MM[1]], "mm")?];
    let refused = |message| Reason::Impossible {
        message,
        remedy: "give the points of one curve, the origin first; `flexframe stiffness FRAME` writes them into its model.toml".into(),
    };
    FrameCurve::new(&x_mm, &phi_mm).map(|curve| Some(Arc::new(curve))).map_err(|message| file.refuse(CURVE[0], refused(message)))
}

/// Whether the file has the effect's table with nothing in it.
fn is_empty_table(file: &ImpactFile, spec: &Spec) -> bool {
    let entry = file.entries.get(&format!("effects.{}", spec.id));
    entry.is_some_and(|entry| entry.value.is_table())
}

/// The keys that an effect's table may hold.
fn keys(spec: &Spec) -> impl Iterator<Item = String> {
    let keys = spec.parameters.iter().map(|parameter| parameter.key).chain(spec.choice.map(|choice| choice.key));
    keys.map(move |key| format!("effects.{}.{key}", spec.id))
}

impl Model {
    /// Reads a model: a path to a TOML file, or the name of one that comes with the program.
    ///
    /// # Errors
    /// When it cannot be read, or is refused.
    pub fn load(model: &str) -> Result<Self, LoadError> {
        Ok(Self::resolve(&ImpactFile::load(model)?)?)
    }

    /// The same with files from somewhere else than the disk.
    ///
    /// # Errors
    /// When it cannot be read, or is refused.
    pub fn load_from(model: &str, files: &dyn Files) -> Result<Self, LoadError> {
        Ok(Self::resolve(&ImpactFile::load_from(model, files)?)?)
    }

    /// A model file's meaning.
    ///
    /// # Errors
    /// What it says that cannot be, with its place.
    pub fn resolve(file: &ImpactFile) -> Result<Self, Refusal> {
        Self::resolve_with(&CATALOGUE, file)
    }

    /// A model file's meaning with the effects of a list.
    ///
    /// # Errors
    /// What it says that cannot be, with its place.
    pub fn resolve_with(catalogue: &[&'static Spec], file: &ImpactFile) -> Result<Self, Refusal> {
        let every = || catalogue.iter().copied();
        let plain = [&MASS, &GAP, &CUTOFF, &ORDER, &LIMIT].map(|plain| plain.key.to_string());
        let empty = every().filter(|spec| is_empty_table(file, spec)).map(|spec| format!("effects.{}", spec.id));
        let words = [CHANNEL.to_string(), "description".into()].into_iter().chain(CURVE.map(String::from));
        let known: Vec<String> = plain.into_iter().chain(words).chain(every().flat_map(keys)).chain(empty).collect();
        file.only(&known, &every().map(|spec| spec.id).collect::<Vec<_>>())?;
        let order = ORDER.stated(file)?;
        if order.fract() != 0.0 {
            let [min, max] = ORDER.bounds;
            let reason = Reason::Impossible {
                message: format!("`{}` = {order} is no whole number", ORDER.key),
                remedy: format!("give a whole number from {min} to {max}"),
            };
            return Err(file.refuse(ORDER.key, reason));
        }
        let channel = CHANNELS[file.word(CHANNEL, &CHANNELS.map(|(word, _)| word))?].1;
        let sensor = Sensor::new(CUTOFF.stated(file)?, order as usize, LIMIT.stated(file)?, channel);
        let origin = Origin::Model(file.name.clone());
        let body = DropBody { mass_kg: MASS.stated(file)?, gap_m: GAP.stated(file)? * 1e-3, travel_m: None, feet: None, origin };
        let mut effects = Vec::new();
        for spec in every() {
            let listed_empty = is_empty_table(file, spec);
            if listed_empty || spec.is_base() || keys(spec).any(|key| file.entries.contains_key(&key)) {
                effects.push(listed(file, spec)?);
            }
        }
        let frame_curve = curve(file, &effects)?;
        Ok(Self { name: file.name.clone(), body, sensor, effects, frame_curve, frame_mode: None })
    }

    /// The model as a file.
    pub fn to_toml(&self) -> String {
        let Sensor { cutoff_hz, order, limit_g, channel, .. } = self.sensor;
        let channel = CHANNELS.iter().find(|(_, known)| *known == channel).map_or("axial", |(word, _)| word);
        let (mass, gap) = (self.body.mass_kg, self.body.gap_m * 1e3);
        let mut text = format!("mass_kg = {mass:?}\ngap_mm = {gap:?}\n\n");
        text += &format!("[sensor]\ncutoff_hz = {cutoff_hz:?}\norder = {order}\nlimit_g = {limit_g:?}\nchannel = \"{channel}\"\n");
        for Listed { spec, values, word } in &self.effects {
            text += &format!("\n[effects.{}]\n", spec.id);
            for (parameter, value) in spec.parameters.iter().zip(values) {
                let unit = if parameter.unit == "1" { String::new() } else { format!("   # {}", parameter.unit) };
                text += &format!("{} = {value:?}{unit}\n", parameter.key);
            }
            if let Some(choice) = spec.choice {
                text += &format!("{} = \"{}\"\n", choice.key, choice.words[*word]);
            }
            if let Some(curve) = self.frame_curve.as_ref().filter(|_| spec.takes_frame_curve()) {
                for (key, column) in ["x_mm", "phi_mm"].into_iter().zip(0..2) {
                    let values: Vec<String> = curve.points_mm().map(|point| format!("{:?}", rounded(point[column]))).collect();
                    text += &format!("{key} = [{}]\n", values.join(", "));
                }
            }
        }
        text
    }
}

/// To a nanometre: what a curve's points are worth, and what reads back as it was written.
fn rounded(mm: f64) -> f64 {
    (mm * 1e6).round() / 1e6
}

/// An effect's values from its table.
fn listed(file: &ImpactFile, spec: &'static Spec) -> Result<Listed, Refusal> {
    let mut values = Vec::new();
    for parameter in spec.parameters {
        let (key, bounds) = (format!("effects.{}.{}", spec.id, parameter.key), [parameter.min, parameter.max]);
        values.push(match (file.number(&key, bounds, parameter.unit)?, parameter.default) {
            (Some(value), _) | (None, Some(value)) => value,
            (None, None) => file.stated(&key, bounds, parameter.unit)?,
        });
    }
    let word = spec.choice.map_or(Ok(0), |choice| file.word(&format!("effects.{}.{}", spec.id, choice.key), choice.words))?;
    Ok(Listed { spec, values, word })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paper() -> String {
        ImpactFile::names().next().map(|name| Model::load(name).expect("comes with the program").to_toml()).expect("there is one")
    }

    fn refused(text: &str) -> String {
        let file = ImpactFile::parse("model.toml", text);
        file.and_then(|file| Model::resolve(&file)).expect_err("is refused").render()
    }

    #[test]
    fn analytic_a_model_written_reads_back() {
        let mut text = paper();
        for spec in CATALOGUE.into_iter().filter(|spec| !spec.is_base()) {
            text += &format!("\n[effects.{}]\n", spec.id);
            for parameter in spec.parameters {
                text += &format!("{} = {:?}\n", parameter.key, 0.3 * parameter.min + 0.7 * parameter.max);
            }
        }
        text += "x_mm = [0.0, 1.0, 2.5, 9.0]\nphi_mm = [0.0, 0.98, 2.3, 6.123456]\n";
        let model = Model::resolve(&ImpactFile::parse("all", &text).expect("TOML")).expect("a model");
        assert_eq!(model.effects.len(), 19);
        assert!(model.arrangement().spring_curve.is_some());
        let again = Model::resolve(&ImpactFile::parse("all", &model.to_toml()).expect("TOML")).expect("a model");
        assert_eq!(again.to_toml(), model.to_toml());
    }

    #[test]
    fn planted_mistakes_in_model_files_are_named() {
        let paper = paper();
        let cases = [
            (paper.replace("k = 7040.0", "k = -1.0"), "`effects.linear_spring.k` = -1 is out of bounds"),
            (paper.replace("k = 7040.0", "k = nan"), "give a finite number"),
            (paper.replace("k = 7040.0", "k = \"stiff\""), "is a text, it must be a number in N/m"),
            (paper.replace("k = 7040.0", ""), "`effects.linear_spring.k` is not stated"),
            (paper.replace("order = 1", "order = 1.5"), "no whole number"),
            (paper.replace("mass_kg", "mass_g"), "unknown key `mass_g`"),
            (paper.replace("\"magnitude\"", "\"z\""), "it must be \"axial\" or \"magnitude\""),
            (paper.clone() + "[effects.cubic_stifness]\nk3 = 1.0\n", "there is no effect called `cubic_stifness`"),
            (paper.clone() + "[effects.wind]\nspeed = 1.0\n", "there is no effect called `wind`"),
            (paper.clone() + "[effects.bottoming]\nx_b_mm = 16.0\n", "`effects.bottoming.k_b` is not stated"),
            (paper.clone() + "[effects.bottoming]\nx_b = 16.0\n", "unknown key `effects.bottoming.x_b`"),
            (paper.clone() + "[effects.cubic_stiffness]\n", "`effects.cubic_stiffness.k3` is not stated"),
            (paper.clone() + "[effects.frame_force_curve]\nshare = 1.0\n", "`effects.frame_force_curve.x_mm` is not stated"),
            (
                paper.clone() + "[effects.frame_force_curve]\nshare = 1.0\nx_mm = [0.0, 2.0, 1.0]\nphi_mm = [0.0, 2.0, 1.0]\n",
                "1 mm does not come after 2 mm",
            ),
            (paper.clone() + "[", "this is not TOML"),
        ];
        for (text, says) in cases {
            let message = refused(&text);
            let flat = message.replace(['│', '·', '×'], " ").split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(flat.contains(says) && flat.contains("model.toml:"), "{says:?} is not in:\n{message}");
        }
    }
}
