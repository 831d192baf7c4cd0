//! A record that ends before the others, and the comparison of all with it.

use std::fmt;

/// Where the comparison ends, if it ends before its usual time by a few records.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct EarlyEnd {
    /// The first drop that ends there.
    pub trial: String,
    /// Its height, m.
    pub height_m: f64,
    /// From the trigger on, ms.
    pub after_ms: f64,
}

impl EarlyEnd {
    /// Of drops by name, height in m and time recorded behind the trigger in s; `usual_s` is compared where records last, in steps of `step_s`.
    /// `None` where no record ends before that, or at least half of them do.
    pub(super) fn of(drops: &[(String, f64, f64)], usual_s: f64, step_s: f64) -> Option<Self> {
        let ends = |(.., after_s): &&(String, f64, f64)| *after_s < usual_s - step_s;
        let early = drops.iter().filter(ends).count();
        let (trial, height_m, after_s) = drops.iter().filter(ends).min_by(|a, b| a.2.total_cmp(&b.2))?;
        (2 * early < drops.len()).then(|| Self { trial: trial.clone(), height_m: *height_m, after_ms: 1e3 * after_s })
    }
}

impl fmt::Display for EarlyEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { trial, height_m, after_ms } = self;
        write!(
            f,
            "all drops are compared to {after_ms:.0} ms behind the trigger, where the record of `{trial}` from {height_m} m ends; most last longer: leave \
             it out to compare more"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planted_one_record_that_ends_early_is_told_and_half_of_them_is_how_they_are() {
        let drops = |ends_ms: &[f64]| -> Vec<(String, f64, f64)> {
            ends_ms.iter().enumerate().map(|(at, ms)| (at.to_string(), 1.0, 1e-3 * ms)).collect()
        };
        let found = EarlyEnd::of(&drops(&[52.0, 22.0, 40.0, 25.0, 60.0]), 0.030, 1e-3).expect("is told");
        assert_eq!((found.trial.as_str(), found.after_ms), ("1", 22.0));
        assert!(found.to_string().contains("to 22 ms behind the trigger"), "{found}");
        assert_eq!(EarlyEnd::of(&drops(&[52.0, 29.5, 40.0]), 0.030, 1e-3), None);
        assert_eq!(EarlyEnd::of(&drops(&[22.0, 22.0, 40.0, 52.0]), 0.030, 1e-3), None);
    }
}
