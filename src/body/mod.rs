//! The bridge from the design, in millimetres and grams, to the body that falls, in SI.

use crate::assembly::Design;
use crate::assembly::mass::MassTable;
use crate::checks;

/// Where a body's numbers come from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// From a model file, by its name.
    Model(String),
    /// From a frame, by its name.
    Frame(String),
}

/// What falls.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Mass, kg.
    pub mass_kg: f64,
    /// Room under what hangs lowest, m. Book-keeping: it adds no force.
    pub gap_m: f64,
    /// How far the frame can be compressed before the arms are down at the lower ring, m; unknown without a frame.
    pub travel_m: Option<f64>,
    /// Where the numbers come from.
    pub origin: Origin,
}

impl Body {
    /// A frame's body: mass by its table, gap as `check` measures it.
    pub fn of(design: &Design, masses: &MassTable) -> Self {
        let gap_mm = checks::ground_clearance(design, masses).map_or(0.0, |ground| ground.clearance_mm);
        Self {
            mass_kg: masses.total_g * 1e-3,
            gap_m: gap_mm * 1e-3,
            travel_m: Some(design.skeleton.closure.ring_half_height_mm * 1e-3),
            origin: Origin::Frame(design.frame.name.clone()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assembly::mass;
    use crate::params::Frame;

    #[test]
    fn measured_the_real_frame_is_241_g_over_10_9_mm() {
        let (frame, _) = Frame::load("cognifly-v8").expect("a preset");
        let design = Design::new(frame).expect("closes");
        let body = Body::of(&design, &mass::table(&design));
        assert!((body.mass_kg - 0.241).abs() < 1e-4, "{body:?}");
        assert!((body.gap_m - 0.0109).abs() < 5e-5, "{body:?}");
        assert!((body.travel_m.expect("a frame has one") - 0.0533).abs() < 5e-4, "{body:?}");
    }
}
