//! What a search knows of one set of values.

use std::cmp::Ordering;

use super::constraint::FAR;

/// Sum of violated margins where there is no frame: more than a frame that misses a dozen limits by far.
pub(super) const NOWHERE: f64 = 12.0 * FAR;

/// What is known of one set of values.
#[derive(Clone)]
pub(super) struct Point {
    /// What is made small; less is better.
    pub aim: f64,
    /// The aim's measures as shares of their values at the start; none when there is no such frame.
    pub measures: Vec<f64>,
    /// Scaled margins: every rule's tightest, then the goals'; none when there is no such frame.
    pub margins: Option<Vec<f64>>,
    /// Sum of the violated margins, scaled; zero when everything is kept.
    pub violated: f64,
    /// Why there is no such frame.
    pub why: Option<String>,
}

impl Point {
    /// Of values of which there is no frame.
    pub fn none(aim: f64, why: String) -> Self {
        Self { aim, measures: Vec::new(), margins: None, violated: NOWHERE, why: Some(why) }
    }

    /// Which of two is nearer to the answer: the one that misses less, or keeps everything with a smaller aim.
    pub fn order(&self, other: &Self) -> Ordering {
        self.violated.total_cmp(&other.violated).then(self.aim.total_cmp(&other.aim))
    }

    /// Whether it is nearer to the answer than another.
    pub fn better_than(&self, other: &Self) -> bool {
        self.order(other) == Ordering::Less
    }
}
