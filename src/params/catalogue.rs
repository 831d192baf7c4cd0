//! What a frame file refers to by name: materials, bought parts, printers.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::units::Density;

/// How far the holes of a board may be from those that it is screwed to, mm: an M2 screw in the usual hole of 3 mm, half of it to each side.
pub const HOLE_PLAY_MM: f64 = 0.5;

/// How a figure of mass is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum MassBasis {
    /// On a scale.
    Measured,
    /// By its maker or seller.
    Datasheet,
    /// By us.
    Estimate,
}

/// A material of printed parts or rods.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// `printed` or `rod`.
    pub kind: String,
    /// Density of the solid material, g/cm³.
    pub density_g_cm3: f64,
    /// Mass of a finished part over volume times density.
    pub print_factor: f64,
    /// Whether the dust of cut rods harms who breathes it; taken to be so where it is not stated.
    pub dust_harms: Option<bool>,
    /// Linear red, green, blue, alpha, 0 to 1.
    pub colour: [f32; 4],
    /// Where the density comes from.
    pub source: String,
    /// Elongation at break along the printed lines, %.
    pub elongation_at_break_percent: Option<f64>,
    /// Elongation at break across layers, %.
    pub elongation_across_layers_percent: Option<f64>,
    /// Where the elongations come from.
    pub elongation_source: Option<String>,
    /// Young's modulus, MPa.
    pub tensile_modulus_mpa: Option<f64>,
    /// Tensile strength, MPa.
    pub tensile_strength_mpa: Option<f64>,
    /// Where modulus and strength come from.
    pub mechanical_source: Option<String>,
    /// Most that a usual printer melts of it, mm³/s.
    pub most_flow_mm3_s: Option<f64>,
    /// Where that comes from.
    pub flow_source: Option<String>,
    /// Height of a printed layer, mm.
    pub layer_mm: Option<f64>,
    /// Walls around the infill.
    pub perimeters: Option<f64>,
    /// Printing speed, mm/s.
    pub speed_mm_s: Option<f64>,
    /// Heat of the nozzle, °C.
    pub nozzle_c: Option<f64>,
    /// Least heat of the nozzle at which it prints, °C.
    pub least_nozzle_c: Option<f64>,
    /// Heat of the bed, °C.
    pub bed_c: Option<f64>,
    /// Whether it wants warm air around it while it is printed.
    pub wants_enclosure: Option<bool>,
    /// Where a printed part softens, °C.
    pub softens_c: Option<f64>,
    /// Where the three come from.
    pub heat_source: Option<String>,
    /// Most of the fan, %.
    pub fan_percent: Option<f64>,
    /// Brim around a part, mm; 0 for none.
    pub brim_mm: Option<f64>,
    /// Steepest lean out of the vertical that prints over air without support, °.
    pub overhang_deg: Option<f64>,
    /// Farthest that something that leans more may reach out with a free edge, mm.
    pub ledge_mm: Option<f64>,
    /// Longest bridge between two supports, mm.
    pub bridge_mm: Option<f64>,
    /// Whether printed support comes off it; where not, what needs support is a violation.
    pub support_comes_off: Option<bool>,
    /// Where the four come from.
    pub support_source: Option<String>,
    /// Where the print settings come from.
    pub print_source: Option<String>,
    /// Price of a kilogram of filament; with a currency and a source, or not at all.
    pub price_per_kg: Option<f64>,
    /// Currency of the price, such as EUR.
    pub currency: Option<String>,
    /// Where the price comes from, and when.
    pub price_source: Option<String>,
}

impl Material {
    /// Whether its price comes with a currency and a source, or there is none.
    pub fn is_priced_whole(&self) -> bool {
        is_whole([self.price_per_kg.is_some(), self.currency.is_some(), self.price_source.is_some()])
    }

    /// Mass of a solid of it, g.
    pub fn solid_g(&self, volume_mm3: f64) -> f64 {
        Density::g_cm3(self.density_g_cm3).mass_g(volume_mm3)
    }

    /// Volume of it that is laid into a printed solid, mm³: prints weigh less or more than a solid by the print factor.
    pub fn printed_mm3(&self, volume_mm3: f64) -> f64 {
        self.print_factor * volume_mm3
    }

    /// Mass of a solid as it is printed, g.
    pub fn printed_g(&self, volume_mm3: f64) -> f64 {
        self.solid_g(self.printed_mm3(volume_mm3))
    }

    /// What a mass of it costs, with the currency; nothing where no price is stated.
    pub fn cost(&self, mass_g: f64) -> Option<(f64, &str)> {
        Some((1e-3 * mass_g * self.price_per_kg?, self.currency.as_deref()?))
    }
}

/// Whether all of a price is stated, or nothing.
fn is_whole(stated: [bool; 3]) -> bool {
    stated == [true; 3] || stated == [false; 3]
}

/// A part that is bought.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoughtPart {
    /// What it is: motor, propeller, battery …
    pub kind: String,
    /// Length, width, height, mm.
    pub size_mm: [f64; 3],
    /// Mass of one, g.
    pub mass_g: f64,
    /// How the mass is known.
    pub mass_basis: MassBasis,
    /// Where size and mass come from.
    pub source: String,
    /// Diameter of a rod or propeller, mm.
    pub diameter_mm: Option<f64>,
    /// Length that rods are sold in, mm.
    pub stock_length_mm: Option<f64>,
    /// What a rod is made of.
    pub material: Option<String>,
    /// Wall of a rod that is a tube, mm; a rod without one is solid.
    pub wall_mm: Option<f64>,
    /// Diameter of a motor's body, mm.
    pub body_diameter_mm: Option<f64>,
    /// Height of a motor, mm.
    pub height_mm: Option<f64>,
    /// Height of a propeller's hub, mm.
    pub hub_height_mm: Option<f64>,
    /// Diameter of the circle of a motor's screw holes, mm.
    pub hole_pcd_mm: Option<f64>,
    /// Number of a motor's screw holes.
    pub hole_count: Option<u32>,
    /// Diameter of the mounting holes, or thread of a motor's, mm.
    pub hole_diameter_mm: Option<f64>,
    /// Hole that a motor's shaft needs in what it stands on, mm; 0 for none.
    pub shaft_hole_diameter_mm: Option<f64>,
    /// Diameter of a motor's shaft, mm.
    pub shaft_diameter_mm: Option<f64>,
    /// Thickness of a board without what is soldered onto it, mm.
    pub board_thickness_mm: Option<f64>,
    /// Whether a board is flight controller and motor controllers in one.
    pub all_in_one: Option<bool>,
    /// Whether a camera for goggles is digital: its ribbon leads to a transmitter of its own maker, and no cable to the boards.
    pub digital: Option<bool>,
    /// Width and thickness of a tie's strap, mm.
    pub strap_mm: Option<[f64; 2]>,
    /// Distances of a board's mounting holes, mm.
    pub hole_pattern_mm: Option<[f64; 2]>,
    /// Distance of a sensor's two mounting holes, mm.
    pub hole_pitch_mm: Option<f64>,
    /// Cells of a battery in series.
    pub cells: Option<u32>,
    /// Stated capacity of a battery, mAh.
    pub capacity_mah: Option<f64>,
    /// Thread of a screw, or of the screw that a nut, a spacer or a damper goes onto, mm.
    pub thread_mm: Option<f64>,
    /// Length of a screw under its head, mm.
    pub length_mm: Option<f64>,
    /// Diameter of a screw's head, mm.
    pub head_diameter_mm: Option<f64>,
    /// Height of a screw's head, mm.
    pub head_height_mm: Option<f64>,
    /// Price of one; with a currency and a source, or not at all.
    pub price: Option<f64>,
    /// Currency of the price, such as EUR.
    pub currency: Option<String>,
    /// Where the price comes from.
    pub price_source: Option<String>,
    /// Highest price that was found where there are several; `price` is then the lowest.
    pub price_most: Option<f64>,
    /// When the price was found: year, month and day, such as 2026-11-23, or less of it.
    pub price_date: Option<String>,
}

/// Thickness of a circuit board that does not state its own, mm: that of usual FR-4 laminate.
const USUAL_BOARD_MM: f64 = 1.6;

impl BoughtPart {
    /// Whether its price comes with a currency and a source, or there is none.
    pub fn is_priced_whole(&self) -> bool {
        let is_stated = [self.price.is_some(), self.currency.is_some(), self.price_source.is_some()];
        let of_a_price = self.price_most.is_some() || self.price_date.is_some();
        is_whole(is_stated) && (self.price.is_some() || !of_a_price)
    }

    /// Height of a motor from its mounting face to the face that carries the propeller, mm.
    pub fn motor_height_mm(&self) -> f64 {
        self.height_mm.unwrap_or(self.size_mm[2])
    }

    /// Number of a motor's screw holes, four where none is stated.
    pub fn motor_holes(&self) -> u32 {
        self.hole_count.unwrap_or(4)
    }

    /// Height of a propeller's hub along the shaft, mm.
    pub fn hub_mm(&self) -> f64 {
        self.hub_height_mm.unwrap_or(self.size_mm[2])
    }

    /// Length that it is sold in, mm: as stated, else that of its box.
    pub fn stock_mm(&self) -> f64 {
        self.stock_length_mm.unwrap_or(self.size_mm[0])
    }

    /// Thickness of its circuit board, mm: as stated, else that of most boards, and no more than the whole is high.
    pub fn board_mm(&self) -> f64 {
        self.board_thickness_mm.unwrap_or(USUAL_BOARD_MM).min(self.size_mm[2])
    }
}

/// The shape of a printer's bed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Bed {
    /// Length by width.
    Rectangular,
    /// A disc.
    Round,
}

/// A printer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Printer {
    /// What to call it.
    pub name: String,
    /// Shape of the bed.
    pub bed: Bed,
    /// Printable length and width, or the diameter, twice, mm.
    pub size_mm: [f64; 2],
    /// Highest part, mm.
    pub height_mm: f64,
    /// Rectangles of the bed on which nothing may lie: low x, low y, high x, high y, from the front left corner, or from the middle of a round
    /// bed, mm; none without.
    pub kept_clear_mm: Option<Vec<[f64; 4]>>,
    /// Nozzle diameter, mm.
    pub nozzle_mm: f64,
    /// Thickness of the filament, mm; 1.75 without.
    pub filament_mm: Option<f64>,
    /// Thinnest printable wall, in nozzles.
    pub min_wall_nozzles: f64,
    /// By how much less than drawn the diameter of a round hole comes out, mm: printed holes are drawn wider by it; none without.
    pub hole_undersize_mm: Option<f64>,
    /// How far the first layer is pressed out of its outline, mm: it is drawn in by it; nothing without.
    pub elephant_foot_mm: Option<f64>,
    /// Least area of a part's first layer, mm².
    pub least_contact_mm2: Option<f64>,
    /// Least tilt at which a part tips over, °.
    pub least_tip_deg: Option<f64>,
    /// Greatest height over the width of the first layer.
    pub most_slender: Option<f64>,
    /// Highest heat of the hot end, °C.
    pub most_nozzle_c: Option<f64>,
    /// Highest heat of the bed, °C.
    pub most_bed_c: Option<f64>,
    /// Whether the printer is closed around the bed.
    pub enclosed: Option<bool>,
    /// Where the three come from.
    pub heat_source: Option<String>,
    /// Where the figures come from.
    pub source: String,
}

impl Printer {
    /// Width of a line, mm: what `min_wall_nozzles` is reckoned with.
    pub fn line_mm(&self) -> f64 {
        (1.125 * self.nozzle_mm * 1e3).round() / 1e3
    }

    /// Height of a layer of a material, mm; half a nozzle where it does not say.
    pub fn layer_mm(&self, material: &Material) -> f64 {
        material.layer_mm.unwrap_or(0.5 * self.nozzle_mm)
    }
}
