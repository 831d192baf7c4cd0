//! Masses three ways, as words and JSON.

use std::fmt::Write;

use serde_json::{Value, json};

use crate::printing::weighing::{Fitted, Row, Weighing};

/// Sliced mass over solid mass, less one, beyond which the cause is named.
pub const SLICER_RATIO: f64 = 0.03;

/// Sliced over solid mass, less one.
fn slicer_ratio(row: &Row) -> Option<f64> {
    row.sliced.map(|sliced| sliced.mass_g / row.solid_g - 1.0)
}

/// Why a slicer fills a part with so much more or less than its volume.
fn cause(row: &Row) -> Option<String> {
    let ratio = slicer_ratio(row).filter(|ratio| ratio.abs() > SLICER_RATIO)?;
    let told = format!("{}: the slicer fills it with {:+.1} % of its volume", row.part, 100.0 * ratio);
    Some(match row.sliced?.without_overlap_g.map(|mass_g| mass_g / row.solid_g - 1.0) {
        Some(bare) if bare.abs() <= SLICER_RATIO => {
            format!("{told}; the overlap of infill over walls, which it counts twice, makes it so: {:+.1} % without", 100.0 * bare)
        }
        Some(bare) => {
            format!("{told}, and {:+.1} % without the overlap of infill over walls: look at its layers in the slicer", 100.0 * bare)
        }
        None => told,
    })
}

/// The table for a terminal.
pub fn table(weighing: &Weighing) -> String {
    let mut text = format!(
        "{:<24} {:>3} {:<10} {:>8} {:>8} {:>8} {:>7} {:>8} {:>7}\n",
        "part, each in g", "", "material", "solid", "counted", "sliced", "", "weighed", ""
    );
    let shown = |mass: Option<f64>| mass.map_or("-".into(), |mass| format!("{mass:.2}"));
    let off = |mass: Option<f64>, row: &Row| mass.map_or(String::new(), |mass| format!("{:+.1} %", 100.0 * (mass / row.solid_g - 1.0)));
    // Writing to a string does not fail.
    for row in &weighing.rows {
        let _ = writeln!(
            text,
            "{:<24} {:>2}x {:<10} {:>8.2} {:>8.2} {:>8} {:>7} {:>8} {:>7}",
            row.part.slug(),
            row.quantity,
            row.material,
            row.solid_g,
            row.counted_g,
            shown(row.sliced.map(|sliced| sliced.mass_g)),
            off(row.sliced.map(|sliced| sliced.mass_g), row),
            shown(row.weighed_g),
            off(row.weighed_g, row)
        );
    }
    let all =
        |of: &dyn Fn(&Row) -> Option<f64>| weighing.rows.iter().map(|row| Some(f64::from(row.quantity) * of(row)?)).sum::<Option<f64>>();
    let [solid, counted, sliced, weighed] = [
        all(&|row| Some(row.solid_g)),
        all(&|row| Some(row.counted_g)),
        all(&|row| row.sliced.map(|sliced| sliced.mass_g)),
        all(&|row| row.weighed_g),
    ];
    let [solid, counted, sliced, weighed] = [solid, counted, sliced, weighed].map(shown);
    let _ = writeln!(text, "{:<39} {solid:>8} {counted:>8} {sliced:>8} {:>7} {weighed:>8}", "all printed parts", "");
    for cause in weighing.rows.iter().filter_map(cause) {
        let _ = writeln!(text, "{cause}");
    }
    if weighing.is_weighed() {
        text += &factors(weighing);
    }
    text
}

fn factors(weighing: &Weighing) -> String {
    let mut text = String::new();
    for Fitted { material, before, after, .. } in &weighing.fitted {
        let Some(after) = after else {
            let _ = writeln!(text, "{material}: nothing of it was weighed, its print factor stays {before:.3}");
            continue;
        };
        let within = match after.interval {
            Some([low, high]) => format!("95 % interval {low:.3} to {high:.3}, {:.1} % from part to part", 100.0 * after.scatter),
            None => "one part says nothing about scatter: weigh another one, too".into(),
        };
        let parts = if after.parts == 1 { "1 part".into() } else { format!("{} parts", after.parts) };
        let _ = writeln!(text, "{material}: print factor {:.3} by {parts} ({within}), was {before:.3}", after.value);
    }
    let (after_g, half_g) = weighing.after_g();
    let half = half_g.map_or(String::new(), |half_g| format!(" +- {half_g:.1}"));
    let Weighing { before_g, limit_g, .. } = weighing;
    let verdict = if after_g > *limit_g { "VIOLATED" } else { "holds" };
    let _ = writeln!(text, "the frame: {after_g:.1}{half} g with these factors, {before_g:.1} g before, limit {limit_g:.0} g: {verdict}");
    text
}

/// Everything as JSON; masses in g, of one part.
pub fn json(frame: &str, weighing: &Weighing) -> Value {
    let row = |row: &Row| {
        json!({
            "part": row.part.slug(), "quantity": row.quantity, "material": row.material,
            "solid_g": row.solid_g, "counted_g": row.counted_g, "sliced_g": row.sliced.map(|sliced| sliced.mass_g), "weighed_g": row.weighed_g,
            "sliced_over_solid": row.sliced.map(|sliced| sliced.mass_g / row.solid_g),
            "sliced_over_solid_without_overlap": row.sliced.and_then(|sliced| Some(sliced.without_overlap_g? / row.solid_g)),
            "weighed_over_solid": row.weighed_g.map(|mass| mass / row.solid_g),
        })
    };
    let factor = |fitted: &Fitted| {
        json!({
            "material": fitted.material, "before": fitted.before, "solid_g": fitted.solid_g,
            "print_factor": fitted.after.map(|after| after.value), "ci95": fitted.after.and_then(|after| after.interval),
            "scatter": fitted.after.map(|after| after.scatter), "parts": fitted.after.map_or(0, |after| after.parts),
        })
    };
    let (after_g, half_g) = weighing.after_g();
    json!({
        "schema_version": 1,
        "frame": frame,
        "parts": weighing.rows.iter().map(row).collect::<Vec<_>>(),
        "print_factors": weighing.fitted.iter().map(factor).collect::<Vec<_>>(),
        "total_g": { "before": weighing.before_g, "after": after_g, "half_ci95": half_g, "limit": weighing.limit_g },
    })
}
