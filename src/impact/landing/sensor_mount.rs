//! A sensor on a mount that gives way: what carries it swings on the frame.
//!
//! The body under the mount accelerates with a(t). What carries the sensor follows it on a spring and a damper of its own, light enough not
//! to act back: r'' + 2 zeta w r' + w² r = -a, and the sensor reads -(w² r + 2 zeta w r'). Above the frequency it is a low pass. Source: the
//! response of a base-excited oscillator (S. S. Rao, *Mechanical Vibrations*, 3.6). *When it is wrong:* where a good part of the mass
//! is carried, it acts back on the legs.

/// The effect's id.
pub const MOUNT_LOW_PASS: &str = "mount_low_pass";

/// Frequency and damping of what carries the sensor.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct SensorMount {
    /// Its frequency, Hz.
    pub f_hz: f64,
    /// Its damping over the critical one.
    pub zeta: f64,
}

impl SensorMount {
    /// Turns proper acceleration of bodies, side by side, into that of their sensors, both at steps of the same length, s: the implicit midpoint
    /// rule, order 2.
    #[inline(always)]
    pub fn carry<const N: usize>(&self, waves_g: &mut [[f64; N]], step_s: f64) {
        let w = std::f64::consts::TAU * self.f_hz;
        let half = 0.5 * step_s;
        let damped = 2.0 * self.zeta * w;
        // The wave begins with the touch, at rest.
        let (mut way, mut rate) = ([0.0; N], [0.0; N]);
        let mut begin = waves_g.first().copied().unwrap_or([0.0; N]);
        waves_g.first_mut().iter_mut().for_each(|first| **first = [0.0; N]);
        for readings in waves_g.iter_mut().skip(1) {
            for at in 0..N {
                let reading = readings[at];
                let middle = (rate[at] - half * (0.5 * (begin[at] + reading) + w * w * way[at])) / (1.0 + half * (damped + half * w * w));
                rate[at] = 2.0 * middle - rate[at];
                way[at] += step_s * middle;
                begin[at] = reading;
                readings[at] = -(w * w * way[at] + damped * rate[at]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_step_swings_as_an_oscillator_does() {
        let mount = SensorMount { f_hz: 150.0, zeta: 0.2 };
        let step_s = 5e-5;
        let mut wave = vec![[10.0]; 600];
        mount.carry(&mut wave, step_s);
        let w = std::f64::consts::TAU * mount.f_hz;
        let swing = w * (1.0 - mount.zeta * mount.zeta).sqrt();
        for (at, [reading]) in wave.iter().enumerate() {
            // Step response of (2 zeta w s + w²) / (s² + 2 zeta w s + w²).
            let t = step_s * at as f64;
            let decay = libm::exp(-mount.zeta * w * t);
            let expected = 10.0 * (1.0 - decay * (libm::cos(swing * t) - mount.zeta * w / swing * libm::sin(swing * t)));
            assert!((reading - expected).abs() < 0.05, "{at}: {reading} {expected}");
        }
    }

    #[test]
    fn analytic_a_stiff_mount_reads_what_the_body_does() {
        let mut wave: Vec<[f64; 1]> = (0..600).map(|i| [50.0 * libm::sin(f64::from(i) * 5e-5 / 0.03 * std::f64::consts::PI)]).collect();
        let body = wave.clone();
        SensorMount { f_hz: 3000.0, zeta: 0.7 }.carry(&mut wave, 5e-5);
        assert!(wave.iter().zip(&body).skip(20).all(|([sensor], [body])| (sensor - body).abs() < 0.4));
    }
}
