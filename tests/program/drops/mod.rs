//! Drops made up for the tests: a model's waves with another phase of the clock each, noise, and trial variation.

use flexframe::impact::effects::{Channel, Model, Sensor};
use flexframe::impact::sim::{Sampler, SolverOptions, System, Trace, simulate};

/// Noise of a sample, g.
pub const NOISE_G: f64 = 0.17;
/// Trial variation of a drop's force: the largest share.
const VARIATION: f64 = 0.03;

/// The paper's body with another spring and damper.
pub fn model(k: f64, c: f64) -> Model {
    let paper = Model::load("paper-corrected").expect("comes with the program");
    Model::base(paper.body, Sensor::new(500.0, 1, 230.0, Channel::Axial), k, c)
}

/// Evenly spread numbers from 0 to 1 without a random generator, one sequence a prime (J. H. Halton, 1960).
fn even(mut at: usize, prime: usize) -> f64 {
    let (mut value, mut share) = (0.0, 1.0);
    while at > 0 {
        share /= prime as f64;
        value += share * (at % prime) as f64;
        at /= prime;
    }
    value
}

/// How a logger sees drops.
#[derive(Clone, Copy, PartialEq)]
pub enum Seen {
    /// Another phase of the clock each, noise, and forces that vary.
    Varied,
    /// A sample at first touch, and nothing but rounding.
    Aligned,
}

/// A table of so many drops from each of three heights, 10 ms before and 30 ms after first touch.
pub fn csv(model: &Model, drops: usize, seen: Seen) -> String {
    let share = if seen == Seen::Varied { 1.0 } else { 0.0 };
    let system = System::new(model);
    let mut text = "trial,height_m,t_s,accel_g\n".to_string();
    let mut draw = 0;
    for height_m in [0.5, 1.0, 1.5] {
        let wave = simulate(&system, height_m, &SolverOptions::REPORT).sensor_g;
        for drop in 0..drops {
            let phase_s = share * 1e-3 * (drop as f64 + 0.5) / drops as f64;
            let logger = Sampler { phase_s, ..Sampler::LOGGER };
            let factor =
                1.0 + share * VARIATION * (2.0 * (drop as f64 + 0.5) / drops as f64 - 1.0) * if drop % 2 == 0 { 1.0 } else { -1.0 };
            let scaled: Vec<f64> = wave.iter().map(|reading| reading * factor).collect();
            let samples = logger.samples(&scaled, Trace::STEP_S);
            let fall = (-10..0).map(|sample| (logger.time_s(sample), 0.0));
            for (t_s, accel_g) in fall.chain(samples.into_iter().take(30)) {
                draw += 1;
                let noise = share * NOISE_G * 12.0_f64.sqrt() * (even(draw, 2) - 0.5);
                text += &format!("{drop},{height_m},{t_s:.6},{:.4}\n", logger.quantised_g(accel_g + noise));
            }
        }
    }
    text
}
