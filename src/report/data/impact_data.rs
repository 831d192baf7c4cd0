//! Impacts of the frame's own model as words, JSON and CSV.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use crate::export::ExportError;
use crate::export::table::csv;
use crate::figures::{PARAMETER_DIGITS, significant};
use crate::mechanics::result::impact::Impact;
use crate::mechanics::result::underside::{Reached, Underside};
use crate::mechanics::settings::MechanicsSettings;
use crate::paper_logger::BANDWIDTH_HZ;

/// What was computed.
pub struct Impacts<'a> {
    /// The frame's name.
    pub frame: &'a str,
    /// The numbers it was computed with.
    pub settings: &'a MechanicsSettings,
    /// Mass of the whole frame, g.
    pub mass_g: f64,
    /// What of the centre may hit the ground; none of a frame without corners or a centre.
    pub underside: Option<Underside>,
    /// Tilt of the frame about X and Y when it touches, degrees.
    pub tilt_deg: [f64; 2],
    /// Height by height.
    pub impacts: &'a [Impact],
}

fn of_height(found: &Impacts, impact: &Impact, series: bool) -> Value {
    let [peak_g, peak_ms] = impact.peak();
    let lost: BTreeMap<_, _> = impact.lost.iter().copied().collect();
    let mut value = json!({
        "height_m": impact.height_m,
        "impact_speed_m_s": impact.speed_m_s,
        "peak_proper_g": peak_g,
        "peak_at_ms": peak_ms,
        "peak_sensor_g": impact.sensor_peak_g(),
        "peak_logged_g": impact.logged_peak_g(),
        "travel_mm": impact.travel_mm(),
        "contact_ms": impact.contact_ms,
        "restitution": impact.restitution,
        "touches": found.underside.as_ref().map(|underside| {
            let reached = underside.reached(impact);
            json!({
                "gap_mm": underside.gap_mm,
                "touches": reached.is_some(),
                "at_ms": reached.map(|reached| reached.at_ms),
                "speed_m_s": reached.map(|reached| reached.speed_m_s),
                "least_mm": underside.least_mm(impact),
            })
        }),
        "energy_lowest": impact.energies[0],
        "energy_end": impact.energies[1],
        "lost_mj": lost,
        "zones_lowest": impact.zones,
        "rods": impact.rods,
        "unaccounted": impact.unaccounted,
    });
    if series {
        value["moments"] = json!(impact.moments);
        value["sensor_g"] = json!(impact.through(BANDWIDTH_HZ));
    }
    value
}

/// Everything as JSON; the series only when asked for.
pub fn json(found: &Impacts, series: bool) -> Value {
    json!({
        "schema_version": 1,
        "frame": found.frame,
        "model": "frame",
        "mass_g": found.mass_g,
        "young_mpa": found.settings.young_mpa,
        "young_band_mpa": found.settings.young_band_mpa,
        "relaxation_exponent": found.settings.relaxation_exponent,
        "impact_modulus": found.settings.impact_modulus,
        "impact_loss": found.settings.impact_loss,
        "tilt_deg": found.tilt_deg,
        "heights": found.impacts.iter().map(|impact| of_height(found, impact, series)).collect::<Vec<_>>(),
    })
}

/// The series of every height.
///
/// # Errors
/// Those of [`csv()`].
pub fn trace_csv(found: &Impacts) -> Result<String, ExportError> {
    let columns = ["height_m", "t_ms", "down_mm", "up_m_s", "proper_g", "sensor_g", "ground_n"];
    let rows = found.impacts.iter().flat_map(|impact| {
        impact.moments.iter().zip(impact.through(BANDWIDTH_HZ)).map(|(m, sensor_g)| {
            let t_ms = format!("{:.3}", m.t_ms);
            let [height_m, down_mm, up_m_s, proper_g, sensor_g, ground_n] =
                [impact.height_m, m.down_mm, m.up_m_s, m.proper_g, sensor_g, m.ground_n].map(|value| value.to_string());
            [height_m, t_ms, down_mm, up_m_s, proper_g, sensor_g, ground_n]
        })
    });
    csv("trace.csv", columns, rows)
}

/// What a person reads.
pub fn table(found: &Impacts) -> String {
    let mut text = head(found);
    text += "height  impact  ------- peak, g -------     at  travel  contact  rebound   -- lost, % --\n";
    text += "     m     m/s  proper   sensor  logged     ms      mm       ms    speed  flex.  ground\n";
    text.extend(found.impacts.iter().map(|impact| row(impact, found.mass_g)));
    if let Some(underside) = &found.underside {
        text.push('\n');
        text.extend(found.impacts.iter().map(|impact| of_underside(underside, impact)));
    }
    text.extend(found.impacts.iter().filter(|impact| impact.contact_ms.is_none()).map(not_ended));
    let open = found.impacts.iter().map(|impact| impact.unaccounted).max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(0.0);
    text += &format!("\nthe energies add up to within {:.1} % of that of the impact\n", 100.0 * open.abs());
    if open.abs() > MOST_OPEN {
        // A motion that gains so much is refused ([`crate::mechanics::result::impact::ImpactError`]).
        text +=
            "warning: so much energy is lost by the steps of the computation: rebound, and what is left at the end, are wrong by as much\n";
    }
    text +=
        "proper: of the payload; sensor: behind a low-pass of 500 Hz; logged: of readings a millisecond apart, as measured peaks are\n\n";
    text
}

/// What was computed with which numbers.
fn head(found: &Impacts) -> String {
    let settings = found.settings;
    let tilted = match found.tilt_deg {
        [0.0, 0.0] => String::new(),
        [x, y] => format!("tilted by {x} and {y} degrees about X and Y at first touch; peaks are along the frame's own axis\n"),
    };
    format!(
        "{}: {:.1} g, E {:.1} MPa at rest (band {:.1} to {:.1}), relaxation exponent {}, modulus and loss in an impact {} and {}\n{tilted}\n",
        found.frame,
        found.mass_g,
        settings.young_mpa,
        settings.young_band_mpa[0],
        settings.young_band_mpa[1],
        settings.relaxation_exponent,
        significant(settings.impact_modulus, PARAMETER_DIGITS),
        significant(settings.impact_loss, PARAMETER_DIGITS)
    )
}

/// A height's line.
fn row(impact: &Impact, mass_g: f64) -> String {
    let [peak, at] = impact.peak();
    let end = &impact.energies[1];
    let input = 0.5 * mass_g * impact.speed_m_s * impact.speed_m_s;
    let contact = impact.contact_ms.map_or("     -".into(), |ms| format!("{ms:>6.1}"));
    let rebound = impact.restitution.map_or("-".into(), |rebound| format!("{rebound:.2}"));
    format!(
        "{:>6} {:>7.3} {peak:>7.1} {:>8.1} {:>7.1} {at:>6.1} {:>7.1}   {contact} {rebound:>8} {:>5.1} {:>8.1}\n",
        impact.height_m,
        impact.speed_m_s,
        impact.sensor_peak_g(),
        impact.logged_peak_g(),
        impact.travel_mm(),
        100.0 * end.relaxed_mj / input,
        100.0 * end.friction_mj / input,
    )
}

/// Energy that the computation loses or makes, part of that of the impact, beyond which it is told: a choice, near the 7 % that a rebound has.
const MOST_OPEN: f64 = 0.05;

/// A drop whose contact goes on where the computation ends.
fn not_ended(impact: &Impact) -> String {
    let last_ms = impact.moments.last().map_or(0.0, |moment| moment.t_ms);
    let so_far = if impact.has_turned_back() { "" } else { ", and peak and travel are those so far" };
    format!(
        "{} m: the feet are on the ground after {last_ms:.0} ms, where the computation ends: there is no rebound{so_far}\n",
        impact.height_m
    )
}

/// How near the lowest body comes to the ground.
fn of_underside(underside: &Underside, impact: &Impact) -> String {
    let (gap, height_m) = (underside.gap_mm, impact.height_m);
    match underside.reached(impact) {
        Some(Reached { at_ms, speed_m_s }) => format!(
            "{height_m} m: the lowest body reaches the ground after {at_ms:.1} ms at {speed_m_s:.2} m/s (gap {gap:.1} mm); its impact is not included in the peak\n"
        ),
        None => format!("{height_m} m: the gap of {gap:.1} mm is not used up, {:.1} mm are left\n", underside.least_mm(impact)),
    }
}
