//! A plan of synthetic drops, from a file.

use super::{HeavyFeet, Hidden, Landings, PLAN_NUMBERS, PlanNumber, ScatterLaw, Stalls};
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
        let known: Vec<String> = PLAN_NUMBERS.iter().map(|number| number.key).chain([HEIGHTS, KIND, LAW]).map(String::from).collect();
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
        let scatter = TrialVariation {
            share: PlanNumber::SCATTER_SHARE.read(file)?,
            law: if file.entries.contains_key(LAW) {
                ScatterLaw::ALL[file.word(LAW, &ScatterLaw::NAMES)?]
            } else {
                ScatterLaw::Proportional
            },
            correlation_s: PlanNumber::SCATTER_CORRELATION_MS.read(file)? * 1e-3,
            stiffness: PlanNumber::SCATTER_STIFFNESS.read(file)?,
            damping: PlanNumber::SCATTER_DAMPING.read(file)?,
            tilt_deg: PlanNumber::SCATTER_TILT_DEG.read(file)?,
        };
        let landings = landings(file, &model)?;
        let (heights_m, drops) = (heights_m(file)?, PlanNumber::DROPS_COUNT.read_whole(file)? as usize);
        let (rate_hz, stalls) = (PlanNumber::LOGGER_RATE_HZ.read(file)?, stalls(file)?);
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
            hidden: hidden(file, PlanNumber::HIDDEN_LOSS.read(file)?)?,
            heights_m,
            drops,
            scatter,
            noise_g: PlanNumber::LOGGER_NOISE_G.read(file)?,
            counts_per_g: PlanNumber::LOGGER_COUNTS_PER_G.read(file)?,
            rate_hz,
            stalls,
            landings,
            seed: PlanNumber::DROPS_SEED.read_whole(file)?,
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
fn stalls(file: &ImpactFile) -> Result<Option<Stalls>, Refusal> {
    let stalls = Stalls {
        lost_s: PlanNumber::LOGGER_STALL_MS.read(file)? * 1e-3,
        sector: PlanNumber::LOGGER_SECTOR_SAMPLES.read(file)?,
        catch_up: PlanNumber::LOGGER_CATCH_UP.read(file)?,
        record_s: PlanNumber::LOGGER_RECORD_S.read(file)?,
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
fn landings(file: &ImpactFile, model: &Model) -> Result<Option<Landings>, Refusal> {
    let landings = Landings {
        rate_rad_s: PlanNumber::LANDING_RATE_RAD_S.read(file)?,
        at_release_rad: PlanNumber::LANDING_AT_RELEASE_RAD.read(file)?,
        inertia_kg_m2: PlanNumber::LANDING_INERTIA_KG_M2.read(file)?,
        foot_radius_m: PlanNumber::LANDING_FOOT_RADIUS_MM.read(file)? * 1e-3,
        ground_friction: PlanNumber::LANDING_GROUND_FRICTION.read(file)?,
        touch_g: PlanNumber::LANDING_TOUCH_G.read(file)?,
        sensor_lean_rad: [
            PlanNumber::LANDING_SENSOR_LEAN_X_DEG.read(file)?.to_radians(),
            PlanNumber::LANDING_SENSOR_LEAN_Y_DEG.read(file)?.to_radians(),
        ],
        ringing_g: PlanNumber::LANDING_RINGING_G.read(file)?,
        heavy_feet: heavy_feet(file)?,
    };
    let stated = file.entries.keys().find(|key| key.starts_with("landing.")).cloned();
    let clash = |key: &str| -> Refusal {
        let message = format!("`landing` and `{key}` are both given; they cannot be combined");
        file.refuse(key, Reason::Impossible { message, remedy: format!("take `{key}` out, or the table `landing`") })
    };
    let leans = landings.sensor_lean_rad != [0.0; 2];
    if leans && PlanNumber::LOGGER_RECORD_S.read(file)? > 0.0 {
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
fn heavy_feet(file: &ImpactFile) -> Result<Option<HeavyFeet>, Refusal> {
    let feet = HeavyFeet {
        share: PlanNumber::LANDING_FOOT_SHARE.read(file)?,
        f_hz: PlanNumber::LANDING_FOOT_F_HZ.read(file)?,
        zeta: PlanNumber::LANDING_FOOT_ZETA.read(file)?,
    };
    Ok((feet.share > 0.0).then_some(feet))
}

fn hidden(file: &ImpactFile, loss: f64) -> Result<Option<Hidden>, Refusal> {
    if !file.entries.contains_key(KIND) {
        return Ok(None);
    }
    Ok(Some(match Hidden::NAMES[file.word(KIND, &Hidden::NAMES)?] {
        "two_stage" => Hidden::TwoStage {
            x1_m: PlanNumber::HIDDEN_X1_MM.read(file)? * 1e-3,
            stiffness_n_m: PlanNumber::HIDDEN_STIFFNESS_N_M.read(file)?,
            loss,
        },
        "two_modes" => Hidden::TwoModes {
            shares: [PlanNumber::HIDDEN_SHARE_1.read(file)?, PlanNumber::HIDDEN_SHARE_2.read(file)?],
            f_hz: [PlanNumber::HIDDEN_F_1_HZ.read(file)?, PlanNumber::HIDDEN_F_2_HZ.read(file)?],
            zeta: PlanNumber::HIDDEN_ZETA.read(file)?,
        },
        "wear" => Hidden::Wear { loss },
        _ => Hidden::Snap { x1_m: PlanNumber::HIDDEN_X1_MM.read(file)? * 1e-3, loss },
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
