//! From drop height to impact speed.

use super::GRAVITY_M_S2;

/// The way down.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fall {
    /// Height that is not in the stated one, m.
    pub extra_m: f64,
    /// Drag over mass, 1/m.
    pub drag_1_m: f64,
}

impl Fall {
    /// The height fallen, m.
    pub fn height_m(&self, stated_m: f64) -> f64 {
        (stated_m + self.extra_m).max(0.0)
    }

    /// Speed at first touch, m/s.
    pub fn impact_speed_m_s(&self, stated_m: f64) -> f64 {
        let height_m = self.height_m(stated_m);
        if self.drag_1_m == 0.0 {
            return (2.0 * GRAVITY_M_S2 * height_m).sqrt();
        }
        (-libm::expm1(-2.0 * self.drag_1_m * height_m) * GRAVITY_M_S2 / self.drag_1_m).sqrt()
    }

    /// Time from release to first touch, s.
    pub fn duration_s(&self, stated_m: f64) -> f64 {
        let height_m = self.height_m(stated_m);
        if self.drag_1_m == 0.0 {
            return (2.0 * height_m / GRAVITY_M_S2).sqrt();
        }
        // acosh(e^a) = a + ln(1 + √(1 - e^-2a)), without overflow.
        let a = self.drag_1_m * height_m;
        (a + libm::log1p((-libm::expm1(-2.0 * a)).sqrt())) / (GRAVITY_M_S2 * self.drag_1_m).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_free_fall_and_its_limit() {
        let free = Fall::default();
        assert!((free.impact_speed_m_s(2.62) - 7.1697).abs() < 1e-4, "262 cm: about 7 m/s");
        assert!((free.duration_s(2.62) - 0.730_855).abs() < 1e-5);
        let hardly = Fall { drag_1_m: 1e-9, ..free };
        assert!((hardly.impact_speed_m_s(2.0) / free.impact_speed_m_s(2.0) - 1.0).abs() < 1e-8);
        assert!((hardly.duration_s(2.0) / free.duration_s(2.0) - 1.0).abs() < 1e-8);
        assert_eq!(Fall { extra_m: -0.4, ..free }.impact_speed_m_s(0.3), 0.0);
    }

    #[test]
    fn analytic_drag_against_many_small_steps() {
        let fall = Fall { extra_m: 0.1, drag_1_m: 0.3 };
        let (mut fallen, mut speed, mut time) = (0.0, 0.0_f64, 0.0);
        let step = 1e-6;
        while fallen < 1.6 {
            let middle = speed + 0.5 * step * (GRAVITY_M_S2 - 0.3 * speed * speed);
            speed += step * (GRAVITY_M_S2 - 0.3 * middle * middle);
            fallen += step * middle;
            time += step;
        }
        assert!((speed - fall.impact_speed_m_s(1.5)).abs() < 1e-5, "{speed}");
        assert!((time - fall.duration_s(1.5)).abs() < 1e-5, "{time}");
    }
}
