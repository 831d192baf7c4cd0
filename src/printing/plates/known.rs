//! The settings that plates have, each once: what it is, and what the programs call it.
//!
//! Names of Orca Slicer and Bambu Studio are those of the objects and regions in `src/libslic3r/PrintConfig.hpp`
//! (OrcaSlicer 0019040b, BambuStudio 024e6832), their words those of `PrintConfig.cpp` (OrcaSlicer 00063b88, BambuStudio 0015e42f).
//! Names of Cura are those of `resources/definitions/fdmprinter.def.json` (4.13) that may be set for a mesh; its layer and its brim are
//! those of the whole plate. A program passes over a name that it does not know.

/// A setting as the programs know it.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Known {
    /// What it is, with unit.
    pub words: &'static str,
    /// In PrusaSlicer.
    pub prusa: Spelled,
    /// In Orca Slicer and Bambu Studio.
    pub orca: Spelled,
    /// In Cura.
    pub cura: Spelled,
}

/// How a program spells a setting.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Spelled {
    /// Its names; all get the value. None where an object has no such setting.
    pub keys: &'static [&'static str],
    /// Values that the program writes otherwise: ours, its own.
    pub values: &'static [(&'static str, &'static str)],
}

/// No object has it.
const NONE: Spelled = Spelled { keys: &[], values: &[] };

const fn keys(keys: &'static [&'static str]) -> Spelled {
    Spelled { keys, values: &[] }
}

const fn spelled(keys: &'static [&'static str], values: &'static [(&'static str, &'static str)]) -> Spelled {
    Spelled { keys, values }
}

const fn known(words: &'static str, prusa: Spelled, orca: Spelled, cura: Spelled) -> Known {
    Known { words, prusa, orca, cura }
}

pub(super) static INFILL: Known =
    known("infill", keys(&["fill_density"]), keys(&["sparse_infill_density"]), spelled(&["infill_sparse_density"], &[("100%", "100")]));

/// Bambu's word; Orca reads it as `rectilinear`. At full density all but PrusaSlicer fill with the pattern of solid layers.
pub(super) static PATTERN: Known = known(
    "infill pattern",
    keys(&["fill_pattern"]),
    spelled(&["sparse_infill_pattern", "internal_solid_infill_pattern"], &[("rectilinear", "zig-zag")]),
    spelled(&["infill_pattern", "top_bottom_pattern"], &[("rectilinear", "lines")]),
);

/// Orca has one for top and bottom of its own, which Bambu does not know. Cura reckons its own from other lines.
pub(super) static OVERLAP: Known = known(
    "infill laid over walls, of a line",
    keys(&["infill_overlap"]),
    keys(&["infill_wall_overlap", "top_bottom_infill_wall_overlap"]),
    NONE,
);

/// Multiplies that of the spool in Orca and Bambu, and replaces it in Cura.
pub(super) static OBJECT_FLOW: Known = known(
    "flow of the object",
    NONE,
    keys(&["print_flow_ratio"]),
    spelled(
        &["material_flow", "wall_0_material_flow", "wall_x_material_flow", "skin_material_flow", "infill_material_flow"],
        &[("1", "100")],
    ),
);

pub(super) static LAYER: Known = known("layer, mm", keys(&["layer_height"]), keys(&["layer_height"]), NONE);

pub(super) static WALLS: Known = known("walls", keys(&["perimeters"]), keys(&["wall_loops"]), keys(&["wall_line_count"]));

pub(super) static SPEED: Known = known(
    "speed, mm/s",
    keys(&["perimeter_speed", "external_perimeter_speed", "infill_speed", "solid_infill_speed", "top_solid_infill_speed"]),
    keys(&["inner_wall_speed", "outer_wall_speed", "sparse_infill_speed", "internal_solid_infill_speed", "top_surface_speed"]),
    keys(&["speed_wall_x", "speed_wall_0", "speed_infill", "speed_topbottom"]),
);

pub(super) static GAP_SPEED: Known = known("speed in gaps, mm/s", keys(&["gap_fill_speed"]), keys(&["gap_infill_speed"]), NONE);

pub(super) static SHORT_LOOP_SPEED: Known =
    known("speed in short loops, mm/s", keys(&["small_perimeter_speed"]), keys(&["small_perimeter_speed"]), NONE);

pub(super) static SHORT_LOOP: Known = known("radius of a short loop, mm", NONE, keys(&["small_perimeter_threshold"]), NONE);

pub(super) static BRIM: Known = known("brim, mm", keys(&["brim_width"]), keys(&["brim_width"]), NONE);

/// A profile without brim, or with one of the slicer's choice, would pass over the width.
pub(super) static BRIM_TYPE: Known = known("kind of brim", keys(&["brim_type"]), keys(&["brim_type"]), NONE);

/// Profiles state widths of their own for each kind of line, which the general one does not override.
pub(super) static LINE: Known = known(
    "line, mm",
    keys(&[
        "extrusion_width",
        "perimeter_extrusion_width",
        "external_perimeter_extrusion_width",
        "infill_extrusion_width",
        "solid_infill_extrusion_width",
        "top_infill_extrusion_width",
    ]),
    keys(&[
        "line_width",
        "inner_wall_line_width",
        "outer_wall_line_width",
        "sparse_infill_line_width",
        "internal_solid_infill_line_width",
        "top_surface_line_width",
    ]),
    keys(&["line_width", "wall_line_width_0", "wall_line_width_x", "skin_line_width", "infill_line_width"]),
);

pub(super) static SUPPORT: Known = known(
    "support",
    keys(&["support_material"]),
    keys(&["enable_support"]),
    spelled(&["support_enable"], &[("1", "True"), ("0", "False")]),
);

/// A profile with support drawn by hand would put none.
pub(super) static SUPPORT_AUTO: Known =
    known("support wherever it is needed", keys(&["support_material_auto"]), spelled(&["support_type"], &[("1", "normal(auto)")]), NONE);

/// A profile with support on the build plate only would leave out what stands on the part.
pub(super) static SUPPORT_ON_PART: Known =
    known("support on the build plate only", keys(&["support_material_buildplate_only"]), keys(&["support_on_build_plate_only"]), NONE);

pub(super) static ELEPHANT_FOOT: Known = known(
    "first layer drawn in by the slicer, mm",
    keys(&["elefant_foot_compensation"]),
    keys(&["elefant_foot_compensation"]),
    keys(&["xy_offset_layer_0"]),
);

pub(super) static DENSITY: Known = known("density, g/cm³", keys(&["filament_density"]), keys(&["filament_density"]), NONE);

pub(super) static FLOW: Known =
    known("flow", keys(&["extrusion_multiplier"]), keys(&["filament_flow_ratio"]), spelled(&["material_flow"], &[("1", "100")]));

pub(super) static NOZZLE: Known =
    known("nozzle, °C", keys(&["temperature"]), keys(&["nozzle_temperature"]), keys(&["material_print_temperature"]));

pub(super) static FIRST_NOZZLE: Known = known(
    "nozzle at the first layer, °C",
    keys(&["first_layer_temperature"]),
    keys(&["nozzle_temperature_initial_layer"]),
    keys(&["material_print_temperature_layer_0"]),
);

pub(super) static BED: Known =
    known("bed, °C", keys(&["bed_temperature"]), keys(&["hot_plate_temp", "textured_plate_temp"]), keys(&["material_bed_temperature"]));

pub(super) static FIRST_BED: Known = known(
    "bed at the first layer, °C",
    keys(&["first_layer_bed_temperature"]),
    keys(&["hot_plate_temp_initial_layer", "textured_plate_temp_initial_layer"]),
    keys(&["material_bed_temperature_layer_0"]),
);

pub(super) static MOST_FLOW: Known =
    known("most flow, mm³/s", keys(&["filament_max_volumetric_speed"]), keys(&["filament_max_volumetric_speed"]), NONE);

pub(super) static FAN: Known = known("fan, %", keys(&["max_fan_speed"]), keys(&["fan_max_speed"]), keys(&["cool_fan_speed_max"]));

pub(super) static COST: Known = known("price of a kilogram", keys(&["filament_cost"]), keys(&["filament_cost"]), NONE);
