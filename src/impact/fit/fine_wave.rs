//! A predicted wave between the samples of a logger.

use crate::impact::measured::TRIGGER_G;

/// Time between the points of a wave, s.
pub const FINE_S: f64 = 5e-5;
/// Points in a second.
const PER_S: f64 = 1.0 / FINE_S;
/// Longest time from first touch to the trigger that is followed, s.
pub(super) const ONSET_S: f64 = 5e-3;

/// A wave from first touch on, g, at steps of 0.05 ms.
#[derive(Debug)]
pub struct FineWave<'a> {
    wave: &'a [f64],
    /// When it first crosses the trigger, s.
    pub crossing_s: f64,
}

impl<'a> FineWave<'a> {
    /// Of readings from first touch on.
    pub fn of(wave: &'a [f64]) -> Self {
        Self { wave, crossing_s: crossing_s(wave).min(ONSET_S) }
    }

    /// Between its points; zero before first touch, g.
    pub fn at(&self, t_s: f64) -> f64 {
        if t_s <= 0.0 {
            return 0.0;
        }
        let place = t_s * PER_S;
        let at = (place as usize).min(self.wave.len() - 2);
        self.wave[at] + (place - at as f64).min(1.0) * (self.wave[at + 1] - self.wave[at])
    }

    /// Readings at many times, s, as [`Self::at`] gives them.
    #[inline(always)]
    pub fn read(&self, time_s: impl Fn(usize) -> f64, readings: &mut [f64]) {
        let last = self.wave.len() - 2;
        for (i, reading) in readings.iter_mut().enumerate() {
            let place = time_s(i) * PER_S;
            // Places lie far below 2³², and the conversion to so few bits is the faster one.
            let at = (place as u32 as usize).min(last);
            let between = self.wave[at] + (place - at as f64).min(1.0) * (self.wave[at + 1] - self.wave[at]);
            *reading = if place > 0.0 { between } else { 0.0 };
        }
    }
}

/// When the wave first crosses the trigger, s.
fn crossing_s(fine: &[f64]) -> f64 {
    let Some(at) = fine.iter().position(|reading| reading.abs() > TRIGGER_G) else { return 0.0 };
    if at == 0 {
        return 0.0;
    }
    let (left, right) = (fine[at - 1].abs(), fine[at].abs());
    FINE_S * (at as f64 - 1.0 + (TRIGGER_G - left) / (right - left))
}
