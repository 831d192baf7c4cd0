//! Measured drops as data: JSON and CSV of heights and of single drops.

use serde_json::{Value, json};

use crate::export::ExportError;
use crate::export::table::{csv, number};
use crate::impact::measured::{ClockPeriod, Drop, DropGroup, DropSet, Flag, JudgedDrops, Spread, Summary};

/// A figure of a drop.
type Figure = fn(&Drop) -> Option<f64>;

/// Figures of a drop by their key; `None` where the drop does not show it.
const FIGURES: [(&str, Figure); 10] = [
    ("trigger_s", |drop| drop.impact.as_ref().map(|impact| drop.record.t_s[impact.trigger])),
    ("peak_g", |drop| drop.impact.as_ref().filter(|_| drop.record.axes_g.is_some()).map(|impact| impact.peak_g)),
    ("peak_axial_g", |drop| drop.impact.as_ref().map(|impact| impact.peak_axial_g)),
    ("to_peak_ms", |drop| drop.impact.as_ref().map(|impact| impact.to_peak_s * 1e3)),
    ("impulse_over_v0", |drop| drop.impact.as_ref().map(|impact| impact.impulse_over_v0(drop.record.height_m))),
    ("restitution", |drop| drop.impact.as_ref().map(|impact| impact.restitution(drop.record.height_m))),
    ("restitution_by_flight", |drop| drop.impact.as_ref().and_then(|impact| impact.restitution_by_flight(drop.record.height_m))),
    ("second_hit_s", |drop| drop.impact.as_ref().and_then(|impact| impact.second_hit).map(|hit| drop.record.t_s[hit])),
    ("fall_s", |drop| drop.impact.as_ref().and_then(|impact| impact.fall_s)),
    ("noise_g", |drop| drop.impact.as_ref().and_then(|impact| impact.noise_g)),
];

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
    if drop.impact.is_some() {
        FIGURES.iter().for_each(|(key, of)| value[*key] = json!(of(drop)));
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
    let keys = FIGURES.iter().map(|(key, _)| *key);
    let columns = ["frame", "height_m", "trial", "source"].into_iter().chain(keys).chain(["flags"]);
    let rows = groups.iter().flat_map(|(_, drops)| drops).map(|drop| {
        let record = drop.record;
        let flags: Vec<&str> = drop.flags.iter().map(|flag| flag.name()).collect();
        let frame = record.frame.clone().unwrap_or_default();
        let named = [frame, record.height_m.to_string(), record.trial.clone(), record.source.clone()];
        named.into_iter().chain(FIGURES.iter().map(|(_, of)| number(of(drop)))).chain([flags.join(" ")])
    });
    csv("drops.csv", columns, rows)
}
