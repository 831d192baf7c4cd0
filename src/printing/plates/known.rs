//! The settings that plates have, each once: what it is, and what the programs call it.
//!
//! Names of Orca Slicer and Bambu Studio are those of the objects and regions in `src/libslic3r/PrintConfig.hpp`
//! (OrcaSlicer 0019040b, BambuStudio 024e6832), their words those of `PrintConfig.cpp` (OrcaSlicer 00063b88, BambuStudio 0015e42f).
//! A program that does not know a name passes over it.

/// A setting as the programs know it.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Known {
    /// What it is, with unit.
    pub words: &'static str,
    /// Names in PrusaSlicer; all get the value.
    pub prusa: &'static [&'static str],
    /// Names in Orca Slicer and Bambu Studio; all get the value.
    pub orca: &'static [&'static str],
    /// Values that those two write otherwise: ours, theirs.
    pub orca_words: &'static [(&'static str, &'static str)],
}

const fn known(words: &'static str, prusa: &'static [&'static str], orca: &'static [&'static str]) -> Known {
    Known { words, prusa, orca, orca_words: &[] }
}

pub(super) static INFILL: Known = known("infill", &["fill_density"], &["sparse_infill_density"]);

/// Bambu's word; Orca reads it as `rectilinear`. At full density both fill with the solid pattern.
pub(super) static PATTERN: Known = Known {
    orca_words: &[("rectilinear", "zig-zag")],
    ..known("infill pattern", &["fill_pattern"], &["sparse_infill_pattern", "internal_solid_infill_pattern"])
};

/// Orca has one for top and bottom of its own, which Bambu does not know.
pub(super) static OVERLAP: Known =
    known("infill laid over walls, of a line", &["infill_overlap"], &["infill_wall_overlap", "top_bottom_infill_wall_overlap"]);

/// Multiplies that of the spool.
pub(super) static OBJECT_FLOW: Known = known("flow of the object", &[], &["print_flow_ratio"]);

pub(super) static LAYER: Known = known("layer, mm", &["layer_height"], &["layer_height"]);

pub(super) static WALLS: Known = known("walls", &["perimeters"], &["wall_loops"]);

pub(super) static SPEED: Known = known(
    "speed, mm/s",
    &["perimeter_speed", "external_perimeter_speed", "infill_speed", "solid_infill_speed", "top_solid_infill_speed"],
    &["inner_wall_speed", "outer_wall_speed", "sparse_infill_speed", "internal_solid_infill_speed", "top_surface_speed"],
);

pub(super) static GAP_SPEED: Known = known("speed in gaps, mm/s", &["gap_fill_speed"], &["gap_infill_speed"]);

pub(super) static SHORT_LOOP_SPEED: Known = known("speed in short loops, mm/s", &["small_perimeter_speed"], &["small_perimeter_speed"]);

pub(super) static SHORT_LOOP: Known = known("radius of a short loop, mm", &[], &["small_perimeter_threshold"]);

pub(super) static BRIM: Known = known("brim, mm", &["brim_width"], &["brim_width"]);

/// A profile without brim, or with one of the slicer's choice, would pass over the width.
pub(super) static BRIM_TYPE: Known = known("kind of brim", &["brim_type"], &["brim_type"]);

/// Profiles state widths of their own for each kind of line, which the general one does not override.
pub(super) static LINE: Known = known(
    "line, mm",
    &[
        "extrusion_width",
        "perimeter_extrusion_width",
        "external_perimeter_extrusion_width",
        "infill_extrusion_width",
        "solid_infill_extrusion_width",
        "top_infill_extrusion_width",
    ],
    &[
        "line_width",
        "inner_wall_line_width",
        "outer_wall_line_width",
        "sparse_infill_line_width",
        "internal_solid_infill_line_width",
        "top_surface_line_width",
    ],
);

pub(super) static SUPPORT: Known = known("support", &["support_material"], &["enable_support"]);

/// A profile with support drawn by hand would put none.
pub(super) static SUPPORT_AUTO: Known =
    Known { orca_words: &[("1", "normal(auto)")], ..known("support wherever it is needed", &["support_material_auto"], &["support_type"]) };

pub(super) static ELEPHANT_FOOT: Known =
    known("first layer drawn in by the slicer, mm", &["elefant_foot_compensation"], &["elefant_foot_compensation"]);

pub(super) static DENSITY: Known = known("density, g/cm³", &["filament_density"], &["filament_density"]);

pub(super) static FLOW: Known = known("flow", &["extrusion_multiplier"], &["filament_flow_ratio"]);

pub(super) static NOZZLE: Known = known("nozzle, °C", &["temperature"], &["nozzle_temperature"]);

pub(super) static FIRST_NOZZLE: Known =
    known("nozzle at the first layer, °C", &["first_layer_temperature"], &["nozzle_temperature_initial_layer"]);

pub(super) static BED: Known = known("bed, °C", &["bed_temperature"], &["hot_plate_temp"]);

pub(super) static FIRST_BED: Known =
    known("bed at the first layer, °C", &["first_layer_bed_temperature"], &["hot_plate_temp_initial_layer"]);

pub(super) static MOST_FLOW: Known = known("most flow, mm³/s", &["filament_max_volumetric_speed"], &["filament_max_volumetric_speed"]);

pub(super) static FAN: Known = known("fan, %", &["max_fan_speed"], &["fan_max_speed"]);

pub(super) static COST: Known = known("price of a kilogram", &["filament_cost"], &["filament_cost"]);
