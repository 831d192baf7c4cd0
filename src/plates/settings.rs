//! How a part is to be printed.
//!
//! What belongs to the object (layers, walls, infill, speeds, support) and what belongs to the spool (heat, flow, fan) are kept
//! apart: the first travels with each object of a plate and leaves the user's printer and its start code alone, the second
//! is chosen once on the machine.

use crate::params::PartName;
use crate::params::catalogue::{Material, Printer};

/// One setting.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Setting {
    /// Its name in PrusaSlicer.
    pub key: &'static str,
    /// Its value there.
    pub value: String,
    /// What it is, with unit.
    pub words: &'static str,
}

/// A list of settings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings(pub Vec<Setting>);

impl Settings {
    /// Of an object: layers, walls, infill, speeds, brim and support. What the material does not say is left to the slicer.
    pub fn of_part(part: PartName, material: &Material, printer: &Printer) -> Self {
        let mut all = Self(Vec::new());
        all.put("fill_density", "100%", "infill");
        all.put("fill_pattern", "rectilinear", "infill pattern");
        all.put_some("layer_height", material.layer_mm, "layer, mm");
        all.put_some("perimeters", material.perimeters, "walls");
        for key in SPEEDS {
            all.put_some(key, material.speed_mm_s, "speed, mm/s");
        }
        all.put("gap_fill_speed", &slow(material.speed_mm_s), "speed in gaps, mm/s");
        all.put_some("brim_width", material.brim_mm, "brim, mm");
        all.put("extrusion_width", &format!("{}", line_mm(printer)), "line, mm");
        all.put("support_material", if needs_support(part) { "1" } else { "0" }, "support");
        all
    }

    /// Of the spool: heat, flow and fan.
    pub fn of_filament(material: &Material) -> Self {
        let mut all = Self(Vec::new());
        all.put_some("filament_density", Some(material.density_g_cm3), "density, g/cm³");
        all.put_some("temperature", material.nozzle_c, "nozzle, °C");
        all.put_some("first_layer_temperature", material.nozzle_c, "nozzle at the first layer, °C");
        all.put_some("bed_temperature", material.bed_c, "bed, °C");
        all.put_some("first_layer_bed_temperature", material.bed_c, "bed at the first layer, °C");
        all.put_some("filament_max_volumetric_speed", material.most_flow_mm3_s, "most flow, mm³/s");
        all.put_some("max_fan_speed", material.fan_percent, "fan, %");
        all
    }

    /// Those that another list has not.
    pub fn beside(&self, other: &Self) -> Vec<&Setting> {
        self.0.iter().filter(|one| !other.0.contains(one)).collect()
    }

    fn put(&mut self, key: &'static str, value: &str, words: &'static str) {
        self.0.push(Setting { key, value: value.into(), words });
    }

    fn put_some(&mut self, key: &'static str, value: Option<f64>, words: &'static str) {
        if let Some(value) = value {
            self.put(key, &format!("{value}"), words);
        }
    }
}

/// Settings of speed that are the object's.
const SPEEDS: [&str; 5] = ["perimeter_speed", "external_perimeter_speed", "infill_speed", "solid_infill_speed", "top_solid_infill_speed"];

/// The lid's shelf hangs over its middle; every other part stands on its widest face.
fn needs_support(part: PartName) -> bool {
    part == PartName::BatteryLid
}

fn slow(speed_mm_s: Option<f64>) -> String {
    speed_mm_s.map_or("20".into(), |speed| format!("{}", speed.min(20.0)))
}

/// Width of a line: what `min_wall_nozzles` is reckoned with.
fn line_mm(printer: &Printer) -> f64 {
    (1.125 * printer.nozzle_mm * 1e3).round() / 1e3
}
