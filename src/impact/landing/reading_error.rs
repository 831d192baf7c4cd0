//! How well touch times are read, by the drops' own touches.
//!
//! Readings of simulated landings ([`TouchErrors`]) show what the search for spikes is off where four feet in one plane touch at once with nothing else. Feet of a
//! frame bend, slide and are not in one plane: the touches of a drop fit no slope as well as that. What is left tells how well they are read.
//!
//! *When it is wrong:* where the foot that is read worst has most of the error; all feet are given one.
//!
//! [`TouchErrors`]: super::touch_errors::TouchErrors

use super::observed::HeightLandings;
use super::table::LandingTable;
use super::touched_slopes::TouchLikelihood;

/// Ratio of standard deviations that are tried one after the other: the likelihood is flat over some tenths.
const RATIO: f64 = 1.15;
/// The largest that is tried, s: two and a half steps of the slowest logger whose touches are read.
const MOST_S: f64 = 2.5e-3;

/// The standard deviation of touch times, s, with which those of all drops are likeliest, at the slopes that are then likeliest; none below that of simulated
/// landings. `None` where too few feet were seen.
pub fn likeliest_read_s(heights: &[&HeightLandings], tables: &[LandingTable], at_release: bool) -> Option<f64> {
    let simulated_s = heights.iter().map(|height| height.read_s()).fold(0.0, f64::max);
    let deviance = |least_s: f64| Some(TouchLikelihood::read_no_better(heights, tables, least_s)?.slopes(at_release).deviance);
    let mut best = (deviance(simulated_s)?, simulated_s);
    let mut tried_s = RATIO * simulated_s;
    while tried_s < MOST_S {
        let tried = (deviance(tried_s)?, tried_s);
        if tried.0 >= best.0 {
            break;
        }
        best = tried;
        tried_s *= RATIO;
    }
    Some(best.1)
}
