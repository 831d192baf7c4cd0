//! A plan of synthetic drops, from a file.

use super::{HeavyFeet, Hidden, Landings, ScatterLaw, Stalls};
use crate::impact::effects::{Generator, Model, Spec};
use crate::params::refusal::{Reason, Refusal, nearest};
use crate::params::{ImpactFile, LoadError};

/// How drops from the same height vary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrialVariation {
    /// Coloured noise of the readings: standard deviation over the size that the law says.
    pub share: f64,
    /// The law.
    pub law: ScatterLaw,
    /// Its correlation time, s.
    pub correlation_s: f64,
    /// Relative standard deviation of the stiffness between drops.
    pub stiffness: f64,
    /// The same of the damping.
    pub damping: f64,
    /// Standard deviation of the sensor's tilt between drops, deg.
    pub tilt_deg: f64,
}

/// A plan of synthetic drops.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The truth as far as it is in the catalogue.
    pub model: Model,
    /// The truth outside the catalogue.
    pub hidden: Option<Hidden>,
    /// Heights, m.
    pub heights_m: Vec<f64>,
    /// Drops a height.
    pub drops: usize,
    /// How they vary.
    pub scatter: TrialVariation,
    /// White noise of a reading, g.
    pub noise_g: f64,
    /// Counts of the converter to one g.
    pub counts_per_g: f64,
    /// Samples a second.
    pub rate_hz: f64,
    /// A logger that writes whole records and whose clock may stall; `None` for 52 ms around the impact.
    pub stalls: Option<Stalls>,
    /// Lateral axes, and landings that may not be level; `None` for readings along the axis alone.
    pub landings: Option<Landings>,
    /// Of all that is random.
    pub seed: u64,
}

/// Most readings of a plan: chosen, a table of some gigabyte.
const MOST_READINGS: f64 = 2e7;
/// Length of a record of the impact alone, s.
const IMPACT_S: f64 = 0.05;

/// A plain number of a plan: key, bounds, unit, and default.
pub const PLAN_NUMBERS: [(&str, [f64; 2], &str, f64); 26] = [
    ("drops.count", [2.0, 100_000.0], "1", 20.0),
    ("drops.seed", [0.0, 9e15], "1", 1.0),
    ("scatter.share", [0.0, 2.0], "1", 0.1),
    ("scatter.correlation_ms", [0.01, 1000.0], "ms", 1.5),
    ("scatter.stiffness", [0.0, 0.5], "1", 0.0),
    ("scatter.damping", [0.0, 0.5], "1", 0.0),
    ("scatter.tilt_deg", [0.0, 45.0], "deg", 0.0),
    ("logger.noise_g", [0.0, 50.0], "g", 0.17),
    ("logger.counts_per_g", [0.1, 1e6], "1/g", 8.877),
    ("logger.rate_hz", [200.0, 200_000.0], "Hz", 1000.0),
    ("logger.record_s", [0.0, 20.0], "s", 0.0),
    ("logger.stall_ms", [0.0, 1000.0], "ms", 0.0),
    ("logger.sector_samples", [50.0, 1e6], "1", 409.6),
    ("logger.catch_up", [1.1, 100.0], "1", 2.7),
    ("landing.rate_rad_s", [0.0, 3.0], "rad/s", 0.0),
    ("landing.at_release_rad", [0.0, 0.5], "rad", 0.0),
    ("landing.inertia_kg_m2", [1e-5, 0.1], "kg m2", 8e-4),
    ("landing.foot_radius_mm", [20.0, 1000.0], "mm", 144.5),
    ("landing.foot_share", [0.0, 0.6], "1", 0.0),
    ("landing.foot_f_hz", [20.0, 2000.0], "Hz", 250.0),
    ("landing.foot_zeta", [0.0, 2.0], "1", 0.05),
    ("landing.touch_g", [0.0, 500.0], "g", 0.0),
    ("landing.ringing_g", [0.0, 500.0], "g", 0.0),
    ("landing.sensor_lean_x_deg", [-30.0, 30.0], "deg", 0.0),
    ("landing.sensor_lean_y_deg", [-30.0, 30.0], "deg", 0.0),
    ("hidden.loss", [0.0, 1.0], "1", 0.5),
];
/// What a hidden truth takes: key, bounds, unit.
pub const HIDDEN_NUMBERS: [(&str, [f64; 2], &str); 7] = [
    ("hidden.x1_mm", [0.1, 60.0], "mm"),
    ("hidden.stiffness_n_m", [0.0, 1e6], "N/m"),
    ("hidden.share_1", [0.0, 0.45], "1"),
    ("hidden.share_2", [0.0, 0.45], "1"),
    ("hidden.f_1_hz", [20.0, 1000.0], "Hz"),
    ("hidden.f_2_hz", [20.0, 1000.0], "Hz"),
    ("hidden.zeta", [0.005, 1.5], "1"),
];
/// Key of the heights.
pub const HEIGHTS: &str = "drops.heights_m";
/// Least and highest drop, m.
pub const HEIGHT_BOUNDS_M: [f64; 2] = [0.01, 100.0];
/// Key of the law of the scatter.
pub const LAW: &str = "scatter.law";
/// Key of what is hidden.
pub const KIND: &str = "hidden.kind";
const OWN: [&str; 5] = ["drops.", "scatter.", "logger.", "landing.", "hidden."];

impl Plan {
    /// Reads a plan: a model file with the tables `drops`, `scatter`, `logger`, `landing` and `hidden` beside it.
    ///
    /// # Errors
    /// When it cannot be read, or is refused.
    pub fn load(path: &str) -> Result<Self, LoadError> {
        Ok(Self::resolve(&ImpactFile::plan(path)?)?)
    }

    /// A plan file's meaning.
    ///
    /// # Errors
    /// What it says that cannot be, with its place.
    pub fn resolve(file: &ImpactFile) -> Result<Self, Refusal> {
        let own = |key: &str| OWN.iter().any(|table| key.starts_with(table));
        let known: Vec<String> = PLAN_NUMBERS
            .iter()
            .map(|number| number.0)
            .chain(HIDDEN_NUMBERS.iter().map(|number| number.0))
            .chain([HEIGHTS, KIND, LAW])
            .map(String::from)
            .collect();
        file.part(own).only(&known, &[])?;
        let of_model = file.part(|key| !own(key));
        // A misspelt table of the plan is none of the model, which knows the names of its own only.
        let misspelt = of_model.entries.keys().find_map(|key| {
            let (table, number) = key.split_once('.')?;
            let near = nearest(table, OWN.map(|own| own.trim_end_matches('.')));
            (!near.is_empty()).then(|| (key, near.iter().map(|table| format!("{table}.{number}")).collect()))
        });
        if let Some((key, nearest)) = misspelt {
            return Err(file.refuse(key, Reason::UnknownKey { key: key.clone(), nearest }));
        }
        let model = Model::resolve(&of_model)?;
        let number = |key: &str| -> Result<f64, Refusal> {
            let (_, bounds, unit, default) = PLAN_NUMBERS[PLAN_NUMBERS.iter().position(|known| known.0 == key).unwrap_or(0)];
            Ok(file.number(key, bounds, unit)?.unwrap_or(default))
        };
        let whole = |key: &str| -> Result<u64, Refusal> {
            let value = number(key)?;
            let reason =
                || Reason::Impossible { message: format!("`{key}` = {value} is no whole number"), remedy: "give a whole number".into() };
            if value.fract() == 0.0 { Ok(value as u64) } else { Err(file.refuse(key, reason())) }
        };
        let scatter = TrialVariation {
            share: number("scatter.share")?,
            law: if file.entries.contains_key(LAW) {
                ScatterLaw::ALL[file.word(LAW, &ScatterLaw::NAMES)?]
            } else {
                ScatterLaw::Proportional
            },
            correlation_s: number("scatter.correlation_ms")? * 1e-3,
            stiffness: number("scatter.stiffness")?,
            damping: number("scatter.damping")?,
            tilt_deg: number("scatter.tilt_deg")?,
        };
        let landings = landings(file, &number, &model)?;
        let (heights_m, drops) = (heights_m(file)?, whole("drops.count")? as usize);
        let (rate_hz, stalls) = (number("logger.rate_hz")?, stalls(file, &number)?);
        let record_s = stalls.map_or(IMPACT_S, |stalls| stalls.record_s);
        let readings = heights_m.len() as f64 * drops as f64 * rate_hz * record_s;
        if readings > MOST_READINGS {
            let message =
                format!("{} heights, {drops} drops each and {record_s} s at {rate_hz} Hz are {readings:.1e} readings", heights_m.len());
            let remedy = format!(
                "lower `drops.count`, `logger.rate_hz` or `logger.record_s`: at most {MOST_READINGS:.0e} readings are held and written"
            );
            return Err(file.refuse("drops.count", Reason::Impossible { message, remedy }));
        }
        Ok(Self {
            model,
            hidden: hidden(file, number("hidden.loss")?)?,
            heights_m,
            drops,
            scatter,
            noise_g: number("logger.noise_g")?,
            counts_per_g: number("logger.counts_per_g")?,
            rate_hz,
            stalls,
            landings,
            seed: whole("drops.seed")?,
        })
    }
}

/// The heights, each once: drops are told apart by height and number.
fn heights_m(file: &ImpactFile) -> Result<Vec<f64>, Refusal> {
    let heights_m = file.numbers(HEIGHTS, HEIGHT_BOUNDS_M, "m")?;
    let again = (0..heights_m.len()).find(|at| heights_m[..*at].contains(&heights_m[*at]));
    match again {
        Some(at) => {
            let message = format!("`{HEIGHTS}` has {} m twice", heights_m[at]);
            Err(file.refuse(
                HEIGHTS,
                Reason::Impossible { message, remedy: "give each height once, and more drops a height by `drops.count`".into() },
            ))
        }
        None => Ok(heights_m),
    }
}

/// A logger of whole records; one that stalls has to write such.
fn stalls(file: &ImpactFile, number: &dyn Fn(&str) -> Result<f64, Refusal>) -> Result<Option<Stalls>, Refusal> {
    let stalls = Stalls {
        lost_s: number("logger.stall_ms")? * 1e-3,
        sector: number("logger.sector_samples")?,
        catch_up: number("logger.catch_up")?,
        record_s: number("logger.record_s")?,
    };
    if stalls.lost_s > 0.0 && stalls.record_s == 0.0 {
        let message = "`logger.stall_ms` needs whole records, and `logger.record_s` is 0".into();
        return Err(file.refuse("logger.stall_ms", Reason::Impossible { message, remedy: "give `logger.record_s`, such as 2".into() }));
    }
    let highest_m = file.numbers(HEIGHTS, HEIGHT_BOUNDS_M, "m")?.into_iter().fold(0.0, f64::max);
    let least_s = Stalls::least_record_s(highest_m);
    if stalls.record_s > 0.0 && stalls.record_s < least_s {
        let message = format!("`logger.record_s` = {} s does not hold a fall from {highest_m} m and its impact", stalls.record_s);
        let remedy = format!("give at least {least_s:.2}, or 0 for the impact alone");
        return Err(file.refuse("logger.record_s", Reason::Impossible { message, remedy }));
    }
    Ok((stalls.record_s > 0.0).then_some(stalls))
}

/// Lateral axes. A landing that is not level knows spring, damper and forces that depend on motion alone; a sensor that leans writes no whole records.
fn landings(file: &ImpactFile, number: &dyn Fn(&str) -> Result<f64, Refusal>, model: &Model) -> Result<Option<Landings>, Refusal> {
    let landings = Landings {
        rate_rad_s: number("landing.rate_rad_s")?,
        at_release_rad: number("landing.at_release_rad")?,
        inertia_kg_m2: number("landing.inertia_kg_m2")?,
        foot_radius_m: number("landing.foot_radius_mm")? * 1e-3,
        touch_g: number("landing.touch_g")?,
        sensor_lean_rad: [number("landing.sensor_lean_x_deg")?.to_radians(), number("landing.sensor_lean_y_deg")?.to_radians()],
        ringing_g: number("landing.ringing_g")?,
        heavy_feet: heavy_feet(number)?,
    };
    let stated = file.entries.keys().find(|key| key.starts_with("landing.")).cloned();
    let clash = |key: &str| -> Refusal {
        let message = format!("`landing` and `{key}` are both given; they cannot be combined");
        file.refuse(key, Reason::Impossible { message, remedy: format!("take `{key}` out, or the table `landing`") })
    };
    let leans = landings.sensor_lean_rad != [0.0; 2];
    if leans && number("logger.record_s")? > 0.0 {
        let key = if landings.sensor_lean_rad[0] != 0.0 { "landing.sensor_lean_x_deg" } else { "landing.sensor_lean_y_deg" };
        let message = format!("`{key}` and `logger.record_s` are both given; they cannot be combined");
        return Err(file.refuse(key, Reason::Impossible { message, remedy: format!("take `{key}` out, or `logger.record_s`") }));
    }
    if stated.is_some() && landings.is_in_space() && file.entries.contains_key(KIND) {
        return Err(clash(KIND));
    }
    if stated.is_some() && landings.is_in_space() {
        let not_in_space = model.effects.iter().map(|listed| listed.spec).find(|spec| !knows_feet(spec));
        let stated = |id: &str| file.entries.keys().find(|key| key.split('.').any(|part| part == id)).cloned();
        if let Some(key) = not_in_space.and_then(|spec| stated(spec.id)) {
            return Err(clash(&key));
        }
    }
    if let Some(feet) = landings.heavy_feet {
        let impossible =
            |message: String, remedy: &str| Err(file.refuse("landing.foot_share", Reason::Impossible { message, remedy: remedy.into() }));
        if feet.share < LEAST_FOOT_SHARE {
            let message = format!("`landing.foot_share` = {} is too little for the steps of a landing", feet.share);
            return impossible(message, "give 0 for feet without mass, or at least 0.01");
        }
        let of_feet = landings.inertia_of_feet_kg_m2(model.body.mass_kg);
        if of_feet >= landings.inertia_kg_m2 {
            let message =
                format!("the feet alone have a moment of inertia of {of_feet:.2e} kg m2, the whole has {:.2e}", landings.inertia_kg_m2);
            return impossible(message, "give a smaller `landing.foot_share`, or a larger `landing.inertia_kg_m2`");
        }
    }
    Ok(stated.map(|_| landings))
}

/// Least part of the mass that feet may have: lighter ones are thrown about by their dampers within one step of the generator.
const LEAST_FOOT_SHARE: f64 = 0.01;

/// Whether an effect acts in each foot, or on fall and sensor.
fn knows_feet(spec: &Spec) -> bool {
    match spec.generator {
        Generator::Force(_) => true,
        Generator::Branch(_) | Generator::Stop(_) => false,
        Generator::Conditions(_) => !["payload_mode", "foot_stagger", "frame_force_curve"].contains(&spec.id),
    }
}

/// Feet with mass of their own.
fn heavy_feet(number: &dyn Fn(&str) -> Result<f64, Refusal>) -> Result<Option<HeavyFeet>, Refusal> {
    let feet = HeavyFeet { share: number("landing.foot_share")?, f_hz: number("landing.foot_f_hz")?, zeta: number("landing.foot_zeta")? };
    Ok((feet.share > 0.0).then_some(feet))
}

fn hidden(file: &ImpactFile, loss: f64) -> Result<Option<Hidden>, Refusal> {
    if !file.entries.contains_key(KIND) {
        return Ok(None);
    }
    let stated = |key: &str| -> Result<f64, Refusal> {
        let (_, bounds, unit) = HIDDEN_NUMBERS[HIDDEN_NUMBERS.iter().position(|known| known.0 == key).unwrap_or(0)];
        file.stated(key, bounds, unit)
    };
    Ok(Some(match Hidden::NAMES[file.word(KIND, &Hidden::NAMES)?] {
        "two_stage" => Hidden::TwoStage { x1_m: stated("hidden.x1_mm")? * 1e-3, stiffness_n_m: stated("hidden.stiffness_n_m")?, loss },
        "two_modes" => Hidden::TwoModes {
            shares: [stated("hidden.share_1")?, stated("hidden.share_2")?],
            f_hz: [stated("hidden.f_1_hz")?, stated("hidden.f_2_hz")?],
            zeta: stated("hidden.zeta")?,
        },
        "wear" => Hidden::Wear { loss },
        _ => Hidden::Snap { x1_m: stated("hidden.x1_mm")? * 1e-3, loss },
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAN: &str = include_str!("../../../params/synthetic/bottoming.toml");

    fn refusal(text: &str) -> Refusal {
        ImpactFile::parse("plan.toml", text).and_then(|file| Plan::resolve(&file)).expect_err("is wrong")
    }

    #[test]
    fn planted_misspelt_table_is_told_with_its_name() {
        for (wrong, right) in [("landings", "landing"), ("droops", "drops"), ("loger", "logger")] {
            let refusal = refusal(&format!("{PLAN}\n[{wrong}]\nrate_hz = 3.0\n"));
            assert_eq!(refusal.reason.to_string(), format!("unknown key `{wrong}.rate_hz`"));
            assert!(refusal.reason.remedy().contains(&format!("{right}.rate_hz")), "{}", refusal.reason.remedy());
        }
    }

    /// A stop is no force of a foot; a level landing is not followed in space.
    #[test]
    fn planted_what_no_foot_has_is_refused_beside_landings_that_slope() {
        let reason = refusal(&format!("{PLAN}\n[landing]\nrate_rad_s = 0.3\n")).reason;
        assert!(reason.to_string().starts_with("`landing` and `effects.bottoming."), "{reason}");
        let reason = refusal(&format!("{PLAN}\n[landing]\nfoot_share = 0.1\n")).reason;
        assert!(reason.to_string().starts_with("`landing` and `effects.bottoming."), "{reason}");
        let free = PLAN.replace("[effects.bottoming]\nx_b_mm = 11.0\nk_b = 1.0e6\n", "");
        let reason = refusal(&format!("{free}\n[landing]\nfoot_share = 0.5\n")).reason;
        assert!(reason.to_string().starts_with("the feet alone have a moment of inertia of 1.26e-3"), "{reason}");
        let reason = refusal(&format!("{free}\n[landing]\nfoot_share = 1e-6\n")).reason;
        assert!(reason.to_string().contains("too little"), "{reason}");
        let level = ImpactFile::parse("plan.toml", &format!("{PLAN}\n[landing]\ntouch_g = 70.0\n")).expect("is TOML");
        assert!(Plan::resolve(&level).is_ok());
    }

    #[test]
    fn planted_heights_twice_and_records_that_are_too_short_are_refused() {
        let heights = PLAN.lines().find(|line| line.starts_with("heights_m")).expect("is stated");
        let reason = refusal(&PLAN.replace(heights, "heights_m = [1.0, 0.5, 1.0]")).reason;
        assert_eq!(reason.to_string(), "`drops.heights_m` has 1 m twice");
        let short = |record_s: f64| {
            let text = PLAN.replace(heights, "heights_m = [1.0]");
            assert!(text.contains("[logger]"), "{text}");
            text.replace("[logger]", &format!("[logger]\nrecord_s = {record_s}"))
        };
        let reason = refusal(&short(0.9)).reason;
        assert!(reason.remedy().starts_with("give at least 0.95"), "{}", reason.remedy());
        assert!(ImpactFile::parse("plan.toml", &short(0.96)).and_then(|file| Plan::resolve(&file)).is_ok());
    }

    #[test]
    fn planted_plain_number_out_of_bounds_is_told_without_a_unit() {
        let reason = refusal(&PLAN.replace("share = 0.1 ", "share = 5.0 ")).reason;
        assert_eq!(reason.to_string(), "`scatter.share` = 5 is out of bounds: 0 to 2");
        assert_eq!(reason.remedy(), "the nearest allowed value is 2");
    }
}
