//! The boards that hang on the four screws of the stack, from the hub's underside down, and the spacers that keep them there.
//!
//! From the hub's underside down: spacers, the flight controller between rubber dampers, spacers, the motor controller, a nut on each screw. A board
//! is taken as it is catalogued: its height is that of everything on it, and its circuit board lies in the middle of it, for no entry
//! says how much is on which side. Between two things on a screw there are as many spacers as fill the way that wires and components
//! need, so that nothing slides along it. Without spacers the way is bare. Heights are above the hub's underside, mm.

use super::catalogue::BoughtPart;
use super::roles::HUNG;

/// Least air between the hub's underside and the first board, mm: chosen, for wires and solder.
const AIR_MM: f64 = 1.4;
/// A way that is longer than its spacers by this still counts as filled, mm: rounding.
const ROUNDING_MM: f64 = 1e-6;

/// Screws of the stack, each with its own spacers.
pub const SCREWS: u32 = 4;

/// The spacers on each screw between two things.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spacers<'a> {
    /// Their entry.
    pub part: &'a BoughtPart,
    /// How many on each screw.
    pub count: u32,
    /// Height of the face that the uppermost presses on.
    pub top_mm: f64,
}

/// A board of the stack with what is above it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HungBoard<'a> {
    /// Its role.
    pub role: &'static str,
    /// Its entry.
    pub part: &'a BoughtPart,
    /// The dampers that it hangs in.
    pub dampers: Option<&'a BoughtPart>,
    /// Height of the middle of its circuit board.
    pub middle_mm: f64,
    /// The spacers above it, where there are any.
    pub spacers: Option<Spacers<'a>>,
}

/// The boards of a frame with these bought parts, by role, from the hub down.
pub fn hung_boards<'a>(part: impl Fn(&str) -> Option<&'a BoughtPart>) -> Vec<HungBoard<'a>> {
    let mut hung: Vec<HungBoard> = Vec::new();
    // The lowest of what is above: of components, and of what lies on the screws.
    let (mut low_mm, mut face_mm) = (-AIR_MM, 0.0);
    for role in HUNG {
        let Some(board) = part(role) else { continue };
        let dampers = part("damper").filter(|_| hung.is_empty());
        let half_mm = 0.5 * board.size_mm[2];
        let held_mm = 0.5 * dampers.map_or(0.0, |damper| damper.size_mm[2]).max(board.board_mm());
        let highest_mm = (low_mm - half_mm).min(face_mm - held_mm);
        let spacers = part("stack_spacer").and_then(|spacer| Spacers::filling(spacer, face_mm, face_mm - held_mm - highest_mm));
        let middle_mm = spacers.map_or(highest_mm, |spacers| spacers.bottom_mm() - held_mm);
        hung.push(HungBoard { role, part: board, dampers, middle_mm, spacers });
        (low_mm, face_mm) = (middle_mm - half_mm, middle_mm - held_mm);
    }
    hung
}

/// How many spacers the boards of a frame need, on all screws.
pub fn spacers_needed<'a>(part: impl Fn(&str) -> Option<&'a BoughtPart>) -> u32 {
    SCREWS * hung_boards(part).iter().filter_map(|board| board.spacers).map(|spacers| spacers.count).sum::<u32>()
}

impl<'a> Spacers<'a> {
    /// The fewest that are as long as a way below a face; none where there is no way.
    fn filling(part: &'a BoughtPart, top_mm: f64, way_mm: f64) -> Option<Self> {
        let count = ((way_mm - ROUNDING_MM) / part.size_mm[2]).ceil();
        (count > 0.0).then_some(Self { part, count: count as u32, top_mm })
    }

    /// Height of the face that the lowest presses on what is below it.
    pub fn bottom_mm(&self) -> f64 {
        self.top_mm - f64::from(self.count) * self.part.size_mm[2]
    }
}

impl HungBoard<'_> {
    /// Height of the lower face on its screws: of its circuit board, or of its dampers.
    pub fn held_low_mm(&self) -> f64 {
        self.middle_mm - 0.5 * self.dampers.map_or(0.0, |damper| damper.size_mm[2]).max(self.part.board_mm())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Frame;

    /// Boards of 7 mm and 6 mm, circuit boards of 1.6 mm, dampers of 6.6 mm, spacers of 1.6 mm: 1.6 mm above the dampers, 2.4 mm below, where
    /// two spacers are needed.
    #[test]
    fn analytic_spacers_fill_the_ways_between_hub_and_boards() {
        let (mut frame, _) = Frame::load("cognifly").expect("is a preset");
        let of = |frame: &Frame| {
            let boards = hung_boards(|role| frame.bought.get(role).map(|item| &item.part));
            boards
                .iter()
                .map(|board| (board.spacers.map(|spacers| spacers.count), (board.middle_mm * 10.0).round() / 10.0))
                .collect::<Vec<_>>()
        };
        assert_eq!(of(&frame), [(Some(1), -4.9), (Some(2), -12.2)]);
        assert_eq!(frame.bought["stack_spacer"].quantity, 12);
        frame.bought.get_mut("stack_spacer").expect("has them").part.size_mm[2] = 2.4;
        assert_eq!(of(&frame), [(Some(1), -5.7), (Some(1), -12.2)]);
        frame.bought.remove("damper");
        assert_eq!(of(&frame), [(Some(2), -5.6), (Some(3), -14.4)]);
        frame.bought.remove("stack_spacer");
        assert_eq!(of(&frame), [(None, -4.9), (None, -11.4)]);
    }
}
