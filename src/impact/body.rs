//! The bridge from the design, in millimetres and grams, to the body that falls, in SI.

use crate::checks;
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::MassTable;

/// Where a body's numbers come from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// From a model file, by its name.
    Model(String),
    /// From a frame, by its name.
    Frame(String),
}

impl std::fmt::Display for Origin {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Self::Model(name) => write!(f, "model {name}"),
            Self::Frame(name) => write!(f, "frame {name}"),
        }
    }
}

/// Where the feet stand, seen from above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Feet {
    /// At the corners of a square.
    Square {
        /// From the hub's axis to a foot, m.
        radius_m: f64,
    },
    /// At the corners of a rectangle that is longer than wide. Landings that are not level are not modelled on it: slopes along its
    /// diagonals are not independent.
    Rectangle,
}

impl Feet {
    /// A frame's feet: under the nodes of its lower ring.
    pub fn of(design: &Design) -> Self {
        let closure = &design.skeleton.closure;
        if closure.places.are_apart() {
            return Self::Rectangle;
        }
        Self::Square { radius_m: closure.ring_half_side_mm * std::f64::consts::SQRT_2 * 1e-3 }
    }

    /// From the hub's axis to each foot, m, where they stand on a square.
    pub fn square_radius_m(self) -> Option<f64> {
        match self {
            Self::Square { radius_m } => Some(radius_m),
            Self::Rectangle => None,
        }
    }
}

/// What falls.
#[derive(Clone, Debug, PartialEq)]
pub struct DropBody {
    /// Mass, kg.
    pub mass_kg: f64,
    /// Clearance of the lowest body above the ground, m; 0 where it hangs lower than the feet, so that it is down with the first touch.
    /// Book-keeping: it adds no force.
    pub gap_m: f64,
    /// How far the frame can be compressed before the arms are down at the lower ring, m; unknown without a frame.
    pub travel_m: Option<f64>,
    /// Where the feet stand; unknown without a frame.
    pub feet: Option<Feet>,
    /// Where the numbers come from.
    pub origin: Origin,
}

impl DropBody {
    /// A frame's body: mass by its table, gap as `check` measures it.
    pub fn of(design: &Design, masses: &MassTable) -> Self {
        Self::with_gap(design, masses, checks::ground_clearance(design, masses).map_or(0.0, |ground| ground.clearance_mm))
    }

    /// The same with the gap as it was measured, mm; below the feet there is none.
    pub fn with_gap(design: &Design, masses: &MassTable, gap_mm: f64) -> Self {
        Self {
            mass_kg: masses.total_g * 1e-3,
            gap_m: 1e-3 * gap_mm.max(0.0),
            travel_m: Some(design.skeleton.closure.ring_half_height_mm * 1e-3),
            feet: Some(Feet::of(design)),
            origin: Origin::Frame(design.frame.name.clone()),
        }
    }
}
