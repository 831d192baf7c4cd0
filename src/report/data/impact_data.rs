//! Impacts of the frame's own model as words, JSON and CSV.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use crate::export::ExportError;
use crate::export::table::csv;
use crate::figures::{PARAMETER_DIGITS, significant};
use crate::mechanics::result::impact::{Impact, Run, sampled_peak_g};
use crate::mechanics::result::underside::{Reached, Underside};
use crate::mechanics::settings::MechanicsSettings;
use crate::paper_logger::{BANDWIDTH_HZ, STEP_MS};

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

/// Peak behind the sensor, g.
pub fn sensor_peak_g(impact: &Impact) -> f64 {
    impact.through(BANDWIDTH_HZ).into_iter().fold(0.0, f64::max)
}

/// Peak in the records of the real drops' logger, g: behind the sensor, one reading a millisecond. This is what a measured peak compares
/// with; it holds for the steps of [`Run::default`].
fn logged_peak_g(impact: &Impact) -> f64 {
    sampled_peak_g(&impact.through(BANDWIDTH_HZ), Run::default().step_ms, STEP_MS)
}

fn of_height(found: &Impacts, impact: &Impact, series: bool) -> Value {
    let [peak_g, peak_ms] = impact.peak();
    let lost: BTreeMap<_, _> = impact.lost.iter().copied().collect();
    let mut value = json!({
        "height_m": impact.height_m,
        "impact_speed_m_s": impact.speed_m_s,
        "peak_proper_g": peak_g,
        "peak_at_ms": peak_ms,
        "peak_sensor_g": sensor_peak_g(impact),
        "peak_logged_g": logged_peak_g(impact),
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
    let mut text = format!(
        "{}: {:.1} g, E {:.1} MPa at rest (band {:.1} to {:.1}), relaxation exponent {}, modulus and loss in an impact {} and {}\n",
        found.frame,
        found.mass_g,
        found.settings.young_mpa,
        found.settings.young_band_mpa[0],
        found.settings.young_band_mpa[1],
        found.settings.relaxation_exponent,
        significant(found.settings.impact_modulus, PARAMETER_DIGITS),
        significant(found.settings.impact_loss, PARAMETER_DIGITS)
    );
    if found.tilt_deg != [0.0; 2] {
        text += &format!(
            "tilted by {} and {} degrees about X and Y at first touch; peaks are along the frame's own axis\n",
            found.tilt_deg[0], found.tilt_deg[1]
        );
    }
    text.push('\n');
    text += "height  impact  ------- peak, g -------     at  travel  contact  rebound   -- lost, % --\n";
    text += "     m     m/s  proper   sensor  logged     ms      mm       ms    speed   TPU   ground\n";
    for impact in found.impacts {
        let [peak, at] = impact.peak();
        let end = &impact.energies[1];
        let input = 0.5 * found.mass_g * impact.speed_m_s * impact.speed_m_s;
        let contact = impact.contact_ms.map_or("     -".into(), |ms| format!("{ms:>6.1}"));
        let rebound = impact.restitution.map_or("-".into(), |rebound| format!("{rebound:.2}"));
        text += &format!(
            "{:>6} {:>7.3} {peak:>7.1} {:>8.1} {:>7.1} {at:>6.1} {:>7.1}   {contact} {rebound:>8} {:>5.1} {:>8.1}\n",
            impact.height_m,
            impact.speed_m_s,
            sensor_peak_g(impact),
            logged_peak_g(impact),
            impact.travel_mm(),
            100.0 * end.relaxed_mj / input,
            100.0 * end.friction_mj / input,
        );
    }
    if let Some(underside) = &found.underside {
        text.push('\n');
        let gap = underside.gap_mm;
        for impact in found.impacts {
            text += &match underside.reached(impact) {
                Some(Reached { at_ms, speed_m_s }) => format!(
                    "{} m: the lowest body reaches the ground after {at_ms:.1} ms at {speed_m_s:.2} m/s (gap {gap:.1} mm); its impact is not included in the peak\n",
                    impact.height_m
                ),
                None => {
                    format!("{} m: the gap of {gap:.1} mm is not used up, {:.1} mm are left\n", impact.height_m, underside.least_mm(impact))
                }
            };
        }
    }
    for impact in found.impacts.iter().filter(|impact| impact.contact_ms.is_none()) {
        let last_ms = impact.moments.last().map_or(0.0, |moment| moment.t_ms);
        text += &format!(
            "{} m: the feet are on the ground after {last_ms:.0} ms, where the computation ends: there is no rebound\n",
            impact.height_m
        );
    }
    let open = found.impacts.iter().map(|impact| impact.unaccounted.abs()).fold(0.0, f64::max);
    text += &format!("\nthe energies add up to within {:.1} % of that of the impact\n", 100.0 * open);
    text +=
        "proper: of the payload; sensor: behind a low-pass of 500 Hz; logged: of readings a millisecond apart, as measured peaks are\n\n";
    text
}
