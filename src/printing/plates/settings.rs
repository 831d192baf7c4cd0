//! How a part is to be printed.
//!
//! What belongs to the object (layers, walls, infill, speeds, support) and what belongs to the spool (heat, flow, fan) are kept
//! apart: the first travels with each object of a plate and leaves the user's printer and its start code alone, the second
//! is chosen once on the machine.

use crate::params::catalogue::{Material, Printer};
use crate::printing::print_time::SLOW_MM_S;

/// One setting.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PrintSetting {
    /// Its name in PrusaSlicer.
    pub key: &'static str,
    /// Its value there.
    pub value: String,
    /// What it is, with unit.
    pub words: &'static str,
}

/// The names of PrusaSlicer beside those of Orca Slicer and Bambu Studio, which are one family.
const ORCA: [(&str, &str); 23] = [
    ("fill_density", "sparse_infill_density"),
    ("fill_pattern", "sparse_infill_pattern"),
    ("infill_overlap", "infill_wall_overlap"),
    ("layer_height", "layer_height"),
    ("perimeters", "wall_loops"),
    ("perimeter_speed", "inner_wall_speed"),
    ("external_perimeter_speed", "outer_wall_speed"),
    ("infill_speed", "sparse_infill_speed"),
    ("solid_infill_speed", "internal_solid_infill_speed"),
    ("top_solid_infill_speed", "top_surface_speed"),
    ("gap_fill_speed", "gap_infill_speed"),
    ("small_perimeter_speed", "small_perimeter_speed"),
    ("brim_width", "brim_width"),
    ("extrusion_width", "line_width"),
    ("support_material", "enable_support"),
    ("elefant_foot_compensation", "elefant_foot_compensation"),
    ("filament_density", "filament_density"),
    ("temperature", "nozzle_temperature"),
    ("first_layer_temperature", "nozzle_temperature_initial_layer"),
    ("bed_temperature", "hot_plate_temp"),
    ("first_layer_bed_temperature", "hot_plate_temp_initial_layer"),
    ("filament_max_volumetric_speed", "filament_max_volumetric_speed"),
    ("max_fan_speed", "fan_max_speed"),
];

impl PrintSetting {
    /// Its name in Orca Slicer and Bambu Studio.
    pub fn orca(&self) -> Option<&'static str> {
        ORCA.iter().find(|(key, _)| *key == self.key).map(|(_, name)| *name)
    }
}

/// A list of settings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PrintSettings(pub Vec<PrintSetting>);

impl PrintSettings {
    /// Of an object: layers, walls, infill, speeds, brim and support. What the material does not say is left to the slicer, and
    /// so is the first layer's squeeze unless the mesh has it taken off already.
    pub fn of_part(supported: bool, material: &Material, printer: &Printer) -> Self {
        let mut all = Self(Vec::new());
        all.put("fill_density", "100%", "infill");
        all.put("fill_pattern", "rectilinear", "infill pattern");
        all.put("infill_overlap", OVERLAP, "infill laid over walls, of a line");
        all.put_some("layer_height", material.layer_mm, "layer, mm");
        all.put_some("perimeters", material.perimeters, "walls");
        for key in SPEEDS {
            all.put_some(key, material.speed_mm_s, "speed, mm/s");
        }
        all.put("gap_fill_speed", &slow(material.speed_mm_s), "speed in gaps, mm/s");
        all.put("small_perimeter_speed", &slow(material.speed_mm_s), "speed in short loops, mm/s");
        all.put_some("brim_width", material.brim_mm, "brim, mm");
        all.put("extrusion_width", &format!("{}", printer.line_mm()), "line, mm");
        all.put("support_material", if supported { "1" } else { "0" }, "support");
        if printer.elephant_foot_mm.is_some_and(|mm| mm > 0.0) {
            all.put("elefant_foot_compensation", "0", "first layer drawn in by the slicer, mm");
        }
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

    /// As PrusaSlicer's own file of settings.
    pub fn ini(&self) -> String {
        self.0.iter().map(|one| format!("{} = {}\n", one.key, one.value)).collect()
    }

    /// Those that another list has not.
    pub fn beside(&self, other: &Self) -> Vec<&PrintSetting> {
        self.0.iter().filter(|one| !other.0.contains(one)).collect()
    }

    fn put(&mut self, key: &'static str, value: &str, words: &'static str) {
        self.0.push(PrintSetting { key, value: value.into(), words });
    }

    fn put_some(&mut self, key: &'static str, value: Option<f64>, words: &'static str) {
        if let Some(value) = value {
            self.put(key, &format!("{value}"), words);
        }
    }
}

/// How far infill reaches over walls. PrusaSlicer counts what lies there twice: at its own 25 % the thirteen parts take 2 % more
/// than their volume, up to 5 % where walls are most of a part; at 15 % 0.9 % more, -2.4 to +3.9 %; at none thin walls lack 4 %.
const OVERLAP: &str = "15%";

/// Settings of speed that are the object's.
const SPEEDS: [&str; 5] = ["perimeter_speed", "external_perimeter_speed", "infill_speed", "solid_infill_speed", "top_solid_infill_speed"];

fn slow(speed_mm_s: Option<f64>) -> String {
    format!("{}", speed_mm_s.map_or(SLOW_MM_S, |speed| speed.min(SLOW_MM_S)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::{Frame, FrameFile};

    #[test]
    fn analytic_every_setting_has_a_name_in_each_family_of_slicers() {
        let mut frame = Frame::resolve(&FrameFile::load("cognifly").expect("is a preset")).expect("resolves");
        frame.printer.elephant_foot_mm = Some(0.1);
        for material in [&frame.flexible.material, &frame.rigid.material] {
            let all = [PrintSettings::of_part(true, material, &frame.printer), PrintSettings::of_filament(material)];
            for setting in all.iter().flat_map(|list| &list.0) {
                assert!(setting.orca().is_some(), "{}", setting.key);
            }
        }
    }
}
