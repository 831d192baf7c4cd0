//! Numbers and directions of rotation of the four motors.
//!
//! They are those of Betaflight's mixer QUADX with its default direction, "props in" (betaflight.com, *Reversed motor
//! direction*: reversed is outwards at the front and back, the front left counter-clockwise; so here the front left turns
//! clockwise). Other firmware counts differently: PX4's motor 1 is the front right, counter-clockwise, which is Betaflight's 2.

use serde::Serialize;

/// A direction of rotation, seen from above.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Spin {
    /// With the clock. The air's torque turns the frame against it.
    Clockwise,
    /// Against the clock.
    CounterClockwise,
}

impl Spin {
    /// Sign of the torque about the vertical, counted upwards, with which the propeller turns the frame: against its own rotation.
    pub fn reaction(self) -> f64 {
        match self {
            Self::Clockwise => 1.0,
            Self::CounterClockwise => -1.0,
        }
    }

    /// The sign of the propeller's own turn about Z, up.
    pub fn sign(self) -> f64 {
        -self.reaction()
    }

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Clockwise => "clockwise",
            Self::CounterClockwise => "counter-clockwise",
        }
    }

    /// The abbreviation that firmware uses.
    pub fn abbreviation(self) -> &'static str {
        match self {
            Self::Clockwise => "CW",
            Self::CounterClockwise => "CCW",
        }
    }
}

/// What firmware knows a motor by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rotor {
    /// Its number, from 1.
    pub number: u32,
    /// Where it turns.
    pub spin: Spin,
}

/// The motors in the order of [`MODULE_NAMES`](super::MODULE_NAMES): front right, front left, back left, back right.
pub const ROTORS: [Rotor; 4] = [
    Rotor { number: 2, spin: Spin::CounterClockwise },
    Rotor { number: 4, spin: Spin::Clockwise },
    Rotor { number: 3, spin: Spin::CounterClockwise },
    Rotor { number: 1, spin: Spin::Clockwise },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::skeleton::MODULE_NAMES;

    #[test]
    fn analytic_neighbours_turn_against_each_other_and_every_number_is_given_once() {
        for module in 0..4 {
            assert_ne!(ROTORS[module].spin, ROTORS[(module + 1) % 4].spin);
            assert_eq!(ROTORS[module].spin, ROTORS[(module + 2) % 4].spin);
        }
        let mut numbers = ROTORS.map(|rotor| rotor.number);
        numbers.sort_unstable();
        assert_eq!(numbers, [1, 2, 3, 4]);
    }

    #[test]
    fn measured_betaflight_counts_from_the_rear_right_and_its_front_left_turns_clockwise() {
        let at = |quadrant: &str| ROTORS[MODULE_NAMES.iter().position(|name| *name == quadrant).expect("a module")];
        assert_eq!(at("BR"), Rotor { number: 1, spin: Spin::Clockwise });
        assert_eq!(at("FR"), Rotor { number: 2, spin: Spin::CounterClockwise });
        assert_eq!(at("BL"), Rotor { number: 3, spin: Spin::CounterClockwise });
        assert_eq!(at("FL"), Rotor { number: 4, spin: Spin::Clockwise });
    }
}
