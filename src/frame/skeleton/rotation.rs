//! Which way each propeller turns.
//!
//! The numbering and the directions are Betaflight's default for a quadcopter in X, "props in": motor 1 rear right clockwise, 2 front
//! right counter-clockwise, 3 rear left counter-clockwise, 4 front left clockwise, seen from above. The blades of both front propellers
//! come in towards the frame's middle from the front.

use serde::Serialize;

use super::module::MODULE_NAMES;

/// A sense of rotation, seen from above.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Rotation {
    /// As a clock's hands.
    Clockwise,
    /// Against a clock's hands.
    CounterClockwise,
}

impl Rotation {
    /// Of a module's propeller, by the module's index in [`MODULE_NAMES`]: opposite corners turn alike, neighbours against each other.
    pub fn of_module(module: usize) -> Self {
        if module % 2 == 0 { Self::CounterClockwise } else { Self::Clockwise }
    }

    /// The sign of the turn about Z, up.
    pub fn sign(self) -> f64 {
        match self {
            Self::Clockwise => -1.0,
            Self::CounterClockwise => 1.0,
        }
    }

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Clockwise => "clockwise",
            Self::CounterClockwise => "counter-clockwise",
        }
    }
}

/// The number of a module's motor at the flight controller.
pub fn motor_number(module: usize) -> usize {
    match MODULE_NAMES[module % MODULE_NAMES.len()] {
        "BR" => 1,
        "FR" => 2,
        "BL" => 3,
        _ => 4,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_props_in() {
        let of = |name: &str| {
            let module = MODULE_NAMES.iter().position(|n| *n == name).expect("a module");
            (motor_number(module), Rotation::of_module(module))
        };
        assert_eq!(of("BR"), (1, Rotation::Clockwise));
        assert_eq!(of("FR"), (2, Rotation::CounterClockwise));
        assert_eq!(of("BL"), (3, Rotation::CounterClockwise));
        assert_eq!(of("FL"), (4, Rotation::Clockwise));
        // No net torque about the vertical at equal speeds.
        assert_eq!((0..4).map(|module| Rotation::of_module(module).sign()).sum::<f64>(), 0.0);
    }
}
