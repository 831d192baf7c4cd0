//! What a frame file refers to by name: materials, bought parts, printers.

use serde::{Deserialize, Serialize};

/// How a figure of mass is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// `printed` or `rod`.
    pub kind: String,
    /// Density of the solid material, g/cm³.
    pub density_g_cm3: f64,
    /// Mass of a finished part over volume times density.
    pub print_factor: f64,
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
}

/// A part that is bought.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
    /// Diameter of a motor's body, mm.
    pub body_diameter_mm: Option<f64>,
    /// Height of a motor, mm.
    pub height_mm: Option<f64>,
    /// Height of a propeller's hub, mm.
    pub hub_height_mm: Option<f64>,
}

/// The shape of a printer's bed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Bed {
    /// Length by width.
    Rectangular,
    /// A disc.
    Round,
}

/// A printer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Printer {
    /// What to call it.
    pub name: String,
    /// Shape of the bed.
    pub bed: Bed,
    /// Printable length and width, or twice the diameter, mm.
    pub size_mm: [f64; 2],
    /// Highest part, mm.
    pub height_mm: f64,
    /// Nozzle diameter, mm.
    pub nozzle_mm: f64,
    /// Thinnest printable wall, in nozzles.
    pub min_wall_nozzles: f64,
    /// Where the figures come from.
    pub source: String,
}
