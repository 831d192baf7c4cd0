//! A plate: copies of parts of one material on the bed.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use crate::frame::assembly::{Design, Printed};
use crate::params::PartName;
use crate::params::frame::NamedMaterial;
use crate::printing::print_time::of_part_s;

/// A copy of a part on the bed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Item {
    /// The part.
    pub part: PartName,
    /// Whether it is turned by a right angle.
    pub turned: bool,
    /// Middle of its box on the bed, mm.
    pub middle_mm: [f64; 2],
}

impl Item {
    /// From the axes of the part's printed mesh to those of the bed.
    pub fn pose(&self, part: &Printed) -> Isometry3<f64> {
        let [low, high] = part.mesh.bounds_mm();
        let to_middle = Translation3::new(-0.5 * (low[0] + high[0]), -0.5 * (low[1] + high[1]), -low[2]);
        let turn = if self.turned { std::f64::consts::FRAC_PI_2 } else { 0.0 };
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn);
        Isometry3::from_parts(Translation3::new(self.middle_mm[0], self.middle_mm[1], 0.0), turn) * Isometry3::from(to_middle)
    }
}

/// A plate.
#[derive(Clone, Debug, PartialEq)]
pub struct Plate {
    /// What it is printed of.
    pub material: NamedMaterial,
    /// Number among the plates whose material has the same [`short`] name, from 1.
    pub number: usize,
    /// What lies on it, in the order of [`PartName::ALL`].
    pub items: Vec<Item>,
    /// The parts of it that are printed with support.
    pub supported: Vec<PartName>,
}

impl Plate {
    /// Its name in files: `tpu_1` for the first of `tpu-95a`.
    pub fn name(&self) -> String {
        format!("{}_{}", short(&self.material.name), self.number)
    }

    /// Volume of all that lies on it, mm³.
    pub fn volume_mm3(&self, printed: &[Printed]) -> f64 {
        self.printed(printed).map(|(part, count)| part.volume_mm3 * count as f64).sum()
    }

    /// Time to print it, s, as [`of_part_s`] estimates it; nothing where the material does not say its speed.
    pub fn print_s(&self, design: &Design) -> Option<f64> {
        self.printed(&design.printed).map(|(part, count)| Some(of_part_s(design, part)? * count as f64)).sum()
    }

    fn printed<'a>(&self, printed: &'a [Printed]) -> impl Iterator<Item = (&'a Printed, usize)> {
        let find = |(name, count): (PartName, usize)| Some((printed.iter().find(|part| part.name == name)?, count));
        self.quantities().into_iter().filter_map(find)
    }

    /// Parts on it with their numbers, in the order of [`PartName::ALL`].
    pub fn quantities(&self) -> Vec<(PartName, usize)> {
        let of = |name: PartName| (name, self.items.iter().filter(|item| item.part == name).count());
        PartName::ALL.into_iter().map(of).filter(|(_, count)| *count > 0).collect()
    }
}

/// A material's name up to its grade, in small letters, digits and `_` only: the names of own materials are free texts, and this is part of files'
/// names, which some systems do not tell apart by capitals.
pub fn short(material: &str) -> String {
    let family = material.split('-').next().unwrap_or_default();
    let plain: String =
        family.chars().take(LONGEST).map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' }).collect();
    if plain.is_empty() { "plate".into() } else { plain }
}

/// Most letters of a material in a file's name.
const LONGEST: usize = 40;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planted_names_of_materials_are_no_paths() {
        for (name, wanted) in [
            ("tpu-95a", "tpu"),
            ("TPU-64d", "tpu"),
            ("../../up", "______up"),
            ("/tmp/x", "_tmp_x"),
            ("-", "plate"),
            ("", "plate"),
            ("a\\b:c", "a_b_c"),
        ] {
            assert_eq!(short(name), wanted);
        }
        assert_eq!(short(&"a".repeat(500)).len(), 40);
    }
}
