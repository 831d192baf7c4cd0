//! Measured drops as data: JSON and CSV of heights and of single drops.

use serde_json::{Value, json};

use crate::export::ExportError;
use crate::export::table::{csv, number};
use crate::impact::measured::{ClockPeriod, Drop, DropGroup, DropSet, Flag, JudgedDrops, Spread, Summary};

/// What a group is called.
pub fn name(group: &DropGroup) -> String {
    match &group.frame {
        Some(frame) => format!("{frame} {} m", group.height_m),
        None => format!("{} m", group.height_m),
    }
}

/// Everything as JSON.
pub fn json(set: &DropSet, judged: &JudgedDrops) -> Value {
    let groups = &judged.groups;
    let period = |(frame, period): &(Option<String>, ClockPeriod)| json!({ "frame": frame, "samples": period.samples, "begin": period.begin, "stretch": period.stretch, "rise": period.rise });
    json!({
        "schema_version": 1,
        "heights": groups.iter().map(|(group, drops)| Summary::of(group, drops)).collect::<Vec<_>>(),
        "drops": groups.iter().flat_map(|(_, drops)| drops).map(of_drop).collect::<Vec<_>>(),
        "sessions": judged.sessions,
        "clock_periods": judged.periods.iter().map(period).collect::<Vec<_>>(),
        "notes": set.notes,
    })
}

fn of_drop(drop: &Drop) -> Value {
    let record = drop.record;
    let flags: Vec<Value> = drop.flags.iter().map(of_flag).collect();
    let mut value = json!({
        "trial": record.trial,
        "frame": record.frame,
        "height_m": record.height_m,
        "source": record.source,
        "samples": record.len(),
        "flags": flags,
    });
    if let Some(impact) = &drop.impact {
        value["trigger_s"] = json!(record.t_s[impact.trigger]);
        value["peak_g"] = json!(record.axes_g.as_ref().map(|_| impact.peak_g));
        value["peak_axial_g"] = json!(impact.peak_axial_g);
        value["to_peak_ms"] = json!(impact.to_peak_s * 1e3);
        value["impulse_over_v0"] = json!(impact.impulse_over_v0(record.height_m));
        value["restitution"] = json!(impact.restitution(record.height_m));
        value["restitution_by_flight"] = json!(impact.restitution_by_flight(record.height_m));
        value["second_hit_s"] = json!(impact.second_hit.map(|hit| record.t_s[hit]));
        value["fall_s"] = json!(impact.fall_s);
        value["noise_g"] = json!(impact.noise_g);
    }
    value
}

fn of_flag(flag: &Flag) -> Value {
    let mut value = json!({ "flag": flag.name(), "reason": flag.to_string() });
    if let Flag::ClockStall { signs } = flag {
        value["evidence"] = json!(signs);
    }
    value
}

/// One line a height.
///
/// # Errors
/// Those of [`csv()`].
pub fn heights_csv(groups: &[(&DropGroup, Vec<Drop>)]) -> Result<String, ExportError> {
    let kinds =
        ["peak_g", "peak_axial_g", "clean_peak_axial_g", "impulse_over_v0", "restitution", "restitution_by_flight", "fall_s", "noise_g"];
    let quartiles = kinds.iter().flat_map(|kind| ["q1", "median", "q3"].map(|quartile| format!("{kind}_{quartile}")));
    let columns = ["frame", "height_m", "drops", "clean"].map(String::from).into_iter().chain(quartiles);
    let rows = groups.iter().map(|(group, drops)| {
        let sum = Summary::of(group, drops);
        let spreads = [
            sum.peak_g,
            sum.peak_axial_g,
            sum.clean_peak_axial_g,
            sum.impulse_over_v0,
            sum.restitution,
            sum.restitution_by_flight,
            sum.fall_s,
            sum.noise_g,
        ];
        let three = |spread: Spread| [spread.q1, spread.median, spread.q3].map(Some);
        let quartiles = spreads.into_iter().flat_map(move |spread| spread.map_or([None; 3], three).map(number));
        let named = [sum.frame.unwrap_or_default(), sum.height_m.to_string(), sum.drops.to_string(), sum.clean.to_string()];
        named.into_iter().chain(quartiles)
    });
    csv("heights.csv", columns, rows)
}

/// One line a drop.
///
/// # Errors
/// Those of [`csv()`].
pub fn drops_csv(groups: &[(&DropGroup, Vec<Drop>)]) -> Result<String, ExportError> {
    let columns = "frame,height_m,trial,source,peak_g,peak_axial_g,to_peak_ms,impulse_over_v0,restitution,fall_s,noise_g,flags";
    let rows = groups.iter().flat_map(|(_, drops)| drops).map(|drop| {
        let (record, impact) = (drop.record, drop.impact.as_ref());
        let numbers = [
            impact.filter(|_| record.axes_g.is_some()).map(|impact| impact.peak_g),
            impact.map(|impact| impact.peak_axial_g),
            impact.map(|impact| impact.to_peak_s * 1e3),
            impact.map(|impact| impact.impulse_over_v0(record.height_m)),
            impact.map(|impact| impact.restitution(record.height_m)),
            impact.and_then(|impact| impact.fall_s),
            impact.and_then(|impact| impact.noise_g),
        ];
        let flags: Vec<&str> = drop.flags.iter().map(|flag| flag.name()).collect();
        let frame = record.frame.clone().unwrap_or_default();
        let named = [frame, record.height_m.to_string(), record.trial.clone(), record.source.clone()];
        named.into_iter().chain(numbers.map(number)).chain([flags.join(" ")])
    });
    csv("drops.csv", columns.split(','), rows)
}
