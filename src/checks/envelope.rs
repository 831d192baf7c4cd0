//! The frame fits the envelope: its bounding box is no wider, deeper or higher than the frame file says.
//!
//! The limit is the user's (a class, a box, a doorway). It is the frame's without propellers; with them the size is
//! stated as a note, for a propeller may be turned out of the way.

use super::finding::{Finding, Measure};
use super::scene::{Scene, bounds_of};

/// The size of the frame along one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// `width`, `depth` or `height`.
    pub name: &'static str,
    /// Whether the discs that the propellers sweep are in it.
    pub with_propellers: bool,
    /// Size, mm.
    pub size_mm: f64,
    /// Largest, mm.
    pub limit_mm: f64,
}

impl Extent {
    fn finding(&self) -> Finding {
        let Self { name, with_propellers, size_mm, limit_mm } = *self;
        let parameter = if name == "height" { "rods.strut_rod_length_mm" } else { "rods.cage_rod_length_mm" };
        let measure = Measure { rule: "envelope", value: size_mm, limit: limit_mm, unit: "mm", parameter };
        let which = if with_propellers { "with propellers" } else { "without propellers" };
        let message = format!("the frame's {name} {which} is {size_mm:.2} mm, the envelope {limit_mm:.2} mm");
        let subject = format!("{name} {which}");
        if with_propellers { measure.note(subject, message) } else { measure.at_most(subject, message) }
    }
}

pub(super) fn check(scene: &Scene) -> Vec<Finding> {
    let limits = &scene.design.frame.limits;
    let mut found = Vec::new();
    for with_propellers in [false, true] {
        let Some(bounds) = bounds_of(scene.placed.iter().filter(|p| with_propellers || !p.is_propeller())) else { continue };
        for (axis, name) in ["width", "depth", "height"].into_iter().enumerate() {
            let limit_mm = if axis == 2 { limits.envelope_height_mm } else { limits.envelope_width_mm };
            found.push(Extent { name, with_propellers, size_mm: bounds.high[axis] - bounds.low[axis], limit_mm }.finding());
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::{Planted, violated};

    #[test]
    fn measured_the_real_frame_is_too_wide_by_1_93_mm() {
        let found = Planted::preset("cognifly-v8").found(check);
        let broken = violated(&found);
        assert_eq!(broken.iter().map(|f| f.subject.as_str()).collect::<Vec<_>>(), ["width without propellers", "depth without propellers"]);
        assert!(broken.iter().all(|f| (f.value - 211.93).abs() < 0.02 && (f.margin + 1.93).abs() < 0.02), "{broken:?}");
    }

    #[test]
    fn regress_the_default_frame_fits() {
        assert_eq!(violated(&Planted::preset("cognifly").found(check)), []);
    }

    #[test]
    fn planted_a_frame_that_is_too_high() {
        let found = Planted::frame(|frame| frame.limits.envelope_height_mm = 100.0).found(check);
        assert_eq!(violated(&found)[0].subject, "height without propellers");
    }
}
