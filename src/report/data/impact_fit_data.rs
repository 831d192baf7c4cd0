//! The frame's own model fitted to drops, as words, JSON and CSV.

use serde_json::{Value, json};

use crate::export::ExportError;
use crate::export::table::csv;
use crate::figures::{PARAMETER_DIGITS, significant};
use crate::impact::fit::LeftOut;
use crate::impact::frame_fit::{FrameFit, Height, MaterialEstimate, MeasuredHeights, Predicted};

/// What was fitted.
pub struct Fitted<'a> {
    /// The frame's name.
    pub frame: &'a str,
    /// The figures of the drops.
    pub measured: &'a MeasuredHeights,
    /// The fit.
    pub fit: &'a FrameFit,
}

impl Fitted<'_> {
    fn measured(&self, height_m: f64) -> Option<&Height> {
        self.measured.heights.iter().find(|height| height.height_m == height_m)
    }

    /// Each prediction with the word for how it came about.
    fn rows(&self) -> impl Iterator<Item = (&'static str, &Predicted)> {
        let fit = self.fit;
        let fitted = fit.fitted.iter().map(|row| ("fitted", row));
        let from_others = fit.from_others.iter().map(|row| ("from the others", row));
        fitted.chain(from_others).chain(fit.from_one.iter().map(|row| ("from one", row)))
    }
}

/// Everything as JSON.
pub fn json(found: &Fitted) -> Value {
    json!({
        "schema_version": 1,
        "frame": found.frame,
        "heights": found.measured.heights,
        "estimates": found.fit.estimates,
        "young_mpa": found.fit.settings.young_mpa,
        "relaxation_exponent": found.fit.settings.relaxation_exponent,
        "fitted": found.fit.fitted,
        "from_others": found.fit.from_others,
        "left_out": found.measured.left_out,
        "from_one": found.fit.from_one,
        "interpolation": found.fit.interpolation,
    })
}

/// Predictions, a line each.
///
/// # Errors
/// Those of [`csv()`].
pub fn predictions_csv(found: &Fitted) -> Result<String, ExportError> {
    let columns = "how,from_m,height_m,impact_modulus,impact_loss,peak_axial_g,measured_peak_axial_g,peak_off_percent,impulse_over_v0,measured_impulse_over_v0";
    let rows = found.rows().filter_map(|(how, row)| {
        let height = found.measured(row.height_m)?;
        let from: Vec<String> = row.from_m.iter().map(f64::to_string).collect();
        let numbers = [
            row.height_m,
            row.impact_modulus,
            row.impact_loss,
            row.peak_axial_g,
            height.peak_axial_g.value,
            row.peak_off_percent,
            row.impulse_over_v0,
            height.impulse_over_v0.value,
        ];
        Some([how.to_string(), from.join(" ")].into_iter().chain(numbers.map(|number| number.to_string())))
    });
    csv("predictions.csv", columns.split(','), rows)
}

/// Head of the file of numbers.
pub fn remark(found: &Fitted) -> String {
    let numbers: Vec<String> = found.fit.estimates.iter().map(in_words).collect();
    let heights: Vec<String> = found.measured.heights.iter().map(|height| height.height_m.to_string()).collect();
    format!(
        "{} from drops of {} from {} m:\n\
         median peaks and impulses along the axis. They compensate for everything that the level-landing model leaves out, and apply to this print and ground only.",
        numbers.join(" and "),
        found.frame,
        heights.join(", ")
    )
}

/// A number with its interval; at its bound the drops ask for one beyond it.
fn in_words(estimate: &MaterialEstimate) -> String {
    let ([low, high], bound) = (estimate.ci95, if estimate.at_bound { ", at its bound" } else { "" });
    format!("{} {:.3} ({low:.3} to {high:.3}{bound})", estimate.key, estimate.value)
}

/// What a person reads.
pub fn table(found: &Fitted) -> String {
    let settings = &found.fit.settings;
    let mut text = format!(
        "{}: E {:.1} MPa at rest, relaxation exponent {}; fitted to median peaks and impulses of {} heights\n\n",
        found.frame,
        settings.young_mpa,
        settings.relaxation_exponent,
        found.measured.heights.len()
    );
    text += "number              value   95 % of the medians' variation\n";
    for estimate in &found.fit.estimates {
        let bound = if estimate.at_bound { "   at its bound" } else { "" };
        let [low, high] = estimate.ci95;
        let [value, low, high] = [estimate.value, low, high].map(|value| significant(value, PARAMETER_DIGITS));
        text += &format!("{:<16} {value:>8}   {low} to {high}{bound}\n", estimate.key);
    }
    text += "\n                              ---- peak along the axis, g ----   -- impulse / v0 --\n";
    text += "how               from, m  height   measured   model   off, %   measured   model   modulus   loss\n";
    for (how, row) in found.rows() {
        let Some(height) = found.measured(row.height_m) else { continue };
        let from: Vec<String> = row.from_m.iter().map(f64::to_string).collect();
        text += &format!(
            "{how:<15} {:>9} {:>7} {:>10.1} {:>7.1} {:>+8.1} {:>10.2} {:>7.2} {:>9.3} {:>6.3}\n",
            from.join(" "),
            row.height_m,
            height.peak_axial_g.value,
            row.peak_axial_g,
            row.peak_off_percent,
            height.impulse_over_v0.value,
            row.impulse_over_v0,
            row.impact_modulus,
            row.impact_loss
        );
    }
    text.push('\n');
    text += &left_out(&found.measured.left_out);
    text
}

/// How many drops are in none of the figures, by what is wrong with them.
fn left_out(drops: &[LeftOut]) -> String {
    let each: Vec<String> = LeftOut::by_reason(drops).iter().map(|(reason, count)| format!("{reason} ({count})")).collect();
    if each.is_empty() { String::new() } else { format!("drops left out: {}\n\n", each.join(", ")) }
}
