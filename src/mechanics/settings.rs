//! Numbers of the mechanics that no frame file holds, as `params/mechanics.toml` states them.

use crate::mechanics::element::relaxation::Relaxation;
use crate::mechanics::parts::section::Elastic;
use crate::params::catalogue::Material;
use crate::params::files::{Disk, Files};
use crate::params::frame::NamedMaterial;
use crate::params::refusal::{Reason, Refusal};
use crate::params::{ImpactFile, LoadError};

/// The numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MechanicsSettings {
    /// Where they come from: a file's name.
    pub name: String,
    /// Young's modulus of the flexible material at rest, MPa.
    pub young_mpa: f64,
    /// The band it is known to, MPa.
    pub young_band_mpa: [f64; 2],
    /// What the data sheet of the material that has this modulus states, MPa; none where a frame of that material was calibrated that states none.
    pub tensile_mpa: Option<f64>,
    /// Its Poisson's ratio.
    pub poisson: f64,
    /// Time at which the modulus holds, s.
    pub rest_time_s: f64,
    /// Exponent of relaxation.
    pub relaxation_exponent: f64,
    /// Modulus in an impact over what the relaxation says of it.
    pub impact_modulus: f64,
    /// Loss at the frequency of an impact beside that of relaxation, over the stiffness at rest.
    pub impact_loss: f64,
    /// Shear modulus of the rods, MPa.
    pub rod_shear_mpa: f64,
    /// Stiffness of a millimetre of bore, over E.
    pub socket_foundation: f64,
    /// Stiffness of a millimetre of plug, over E.
    pub plug_foundation: f64,
    /// Share of a limb's radius that is rigid where limbs cross.
    pub core_rigid: f64,
    /// Stiffness of a closed notch.
    pub notch_contact: f64,
    /// Friction of the feet.
    pub friction: f64,
    /// Stiffness of a foot's skin over E, mm.
    pub foot_stiffness: f64,
    /// What the design drop may do.
    pub limits: DropLimits,
    /// Length of the beams in hinges, mm.
    pub element_mm: f64,
    /// Beams in a bore.
    pub socket_elements: f64,
    /// Longest beam of a rod, mm.
    pub rod_element_mm: f64,
}

/// What the drop that a frame is designed for may do to it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DropLimits {
    /// Its height, m.
    pub drop_m: f64,
    /// Largest acceleration of the payload, g.
    pub payload_peak_g: f64,
    /// Elongation at break over the largest strain.
    pub strain_factor: f64,
    /// Buckling force over the largest compression of a rod.
    pub buckling_factor: f64,
}

/// Within which the modulus of a flexible filament lies, MPa: one beyond is doubted, and no calibration ends there.
pub const YOUNG_MPA: [f64; 2] = [10.0, 400.0];

/// Bounds of a stated modulus, MPa: as wide as data sheets of all materials ([`MechanicsSettings::for_material`]).
const STATED_MPA: [f64; 2] = [0.1, 1e6];

/// Bounds of [`MechanicsSettings::impact_modulus`].
pub const IMPACT_MODULUS: [f64; 2] = [0.1, 3.0];
/// Bounds of [`MechanicsSettings::impact_loss`].
pub const IMPACT_LOSS: [f64; 2] = [0.0, 3.0];

/// What a data sheet says of the material's modulus: its key, bounds and unit. It may be missing.
pub const TENSILE: (&str, [f64; 2], &str) = ("flexible.tensile_mpa", [0.1, 1e4], "MPa");

/// A number of the file.
pub struct Key {
    /// As it is stated, with its table.
    pub name: &'static str,
    /// Least and largest value.
    pub bounds: [f64; 2],
    /// Its unit.
    pub unit: &'static str,
    /// Where it is kept.
    of: fn(&mut MechanicsSettings) -> &mut f64,
}

const fn key(name: &'static str, bounds: [f64; 2], unit: &'static str, of: fn(&mut MechanicsSettings) -> &mut f64) -> Key {
    Key { name, bounds, unit, of }
}

/// Every number that has to be stated, in the order of the file: the only list.
pub const KEYS: [Key; 22] = [
    key("flexible.young_mpa", STATED_MPA, "MPa", |s| &mut s.young_mpa),
    key("flexible.young_low_mpa", STATED_MPA, "MPa", |s| &mut s.young_band_mpa[0]),
    key("flexible.young_high_mpa", STATED_MPA, "MPa", |s| &mut s.young_band_mpa[1]),
    key("flexible.poisson", [0.3, 0.499], "1", |s| &mut s.poisson),
    key("flexible.rest_time_s", [0.1, 1e4], "s", |s| &mut s.rest_time_s),
    key("flexible.relaxation_exponent", [0.0, 0.2], "1", |s| &mut s.relaxation_exponent),
    key("flexible.impact_modulus", IMPACT_MODULUS, "1", |s| &mut s.impact_modulus),
    key("flexible.impact_loss", IMPACT_LOSS, "1", |s| &mut s.impact_loss),
    key("rods.shear_mpa", [100.0, 5e4], "MPa", |s| &mut s.rod_shear_mpa),
    key("joints.socket_foundation", [1.0, 20.0], "1", |s| &mut s.socket_foundation),
    key("joints.plug_foundation", [1.0, 20.0], "1", |s| &mut s.plug_foundation),
    key("joints.core_rigid", [0.0, 1.0], "1", |s| &mut s.core_rigid),
    key("joints.notch_contact", [0.0, 2.0], "1", |s| &mut s.notch_contact),
    key("ground.friction", [0.0, 1.0], "1", |s| &mut s.friction),
    key("ground.foot_stiffness", [1.0, 100.0], "mm", |s| &mut s.foot_stiffness),
    key("limits.drop_m", [0.05, 20.0], "m", |s| &mut s.limits.drop_m),
    key("limits.payload_peak_g", [5.0, 2000.0], "g", |s| &mut s.limits.payload_peak_g),
    key("limits.strain_factor", [1.0, 20.0], "1", |s| &mut s.limits.strain_factor),
    key("limits.buckling_factor", [1.0, 20.0], "1", |s| &mut s.limits.buckling_factor),
    key("mesh.element_mm", [0.1, 3.0], "mm", |s| &mut s.element_mm),
    key("mesh.socket_elements", [1.0, 12.0], "1", |s| &mut s.socket_elements),
    key("mesh.rod_element_mm", [2.0, 100.0], "mm", |s| &mut s.rod_element_mm),
];

/// Numbers that nobody has measured and that a stiffness depends on.
const GUESSES: [&str; 7] = [
    "flexible.poisson",
    "joints.socket_foundation",
    "joints.plug_foundation",
    "joints.core_rigid",
    "joints.notch_contact",
    "ground.friction",
    "ground.foot_stiffness",
];

impl MechanicsSettings {
    /// Reads a file, or the numbers that come with the program.
    ///
    /// # Errors
    /// When it cannot be read, lacks a number, or one is out of bounds.
    pub fn load(path: Option<&str>) -> Result<Self, LoadError> {
        Self::load_from(path, &Disk)
    }

    /// The same with files from somewhere else than the disk.
    ///
    /// # Errors
    /// As [`Self::load`].
    pub fn load_from(path: Option<&str>, files: &dyn Files) -> Result<Self, LoadError> {
        Ok(Self::read(&ImpactFile::mechanics(path, files)?)?)
    }

    /// Reads them from a file.
    ///
    /// # Errors
    /// When a number is missing or out of bounds, or a key unknown.
    pub fn read(file: &ImpactFile) -> Result<Self, Refusal> {
        let tables = ["flexible", "rods", "joints", "ground", "limits", "mesh"];
        let mut known: Vec<String> = KEYS.iter().map(|key| key.name.into()).collect();
        known.extend(tables.map(String::from));
        known.push(TENSILE.0.into());
        file.only(&known, &[])?;
        let mut settings = Self { name: file.name.clone(), ..Self::default() };
        for Key { name, bounds, unit, of } in &KEYS {
            *of(&mut settings) = file.stated(name, *bounds, unit)?;
        }
        settings.lies_in_its_band(file)?;
        if settings.socket_elements.fract() != 0.0 {
            let message = format!("`mesh.socket_elements` = {} is no whole number", settings.socket_elements);
            return Err(file.refuse("mesh.socket_elements", Reason::Impossible { message, remedy: "give a number of beams".into() }));
        }
        settings.tensile_mpa = file.number(TENSILE.0, TENSILE.1, TENSILE.2)?;
        Ok(settings)
    }

    /// Refuses a modulus beside the band in which it is known to lie.
    fn lies_in_its_band(&self, file: &ImpactFile) -> Result<(), Refusal> {
        let (young_mpa, [low_mpa, high_mpa]) = (self.young_mpa, self.young_band_mpa);
        let beside = |key: &str, bound_mpa: f64, way: &str| {
            let message = format!("`{key}` = {bound_mpa} MPa is {way} than `flexible.young_mpa` = {young_mpa} MPa");
            let remedy = "state a modulus within the band in which it is known, or another band".into();
            Err(file.refuse(key, Reason::Impossible { message, remedy }))
        };
        if low_mpa > young_mpa {
            return beside("flexible.young_low_mpa", low_mpa, "more");
        }
        if high_mpa < young_mpa {
            return beside("flexible.young_high_mpa", high_mpa, "less");
        }
        Ok(())
    }

    /// The same for the flexible material of a frame: its modulus is to that of these numbers as the data sheets' moduli are to each other. A frame
    /// is computed with the modulus as it stands where one of both is not stated ([`Self::doubt`]).
    ///
    /// *When it is wrong:* data sheets of different makers measure at different strains and rates.
    #[must_use]
    pub fn for_material(&self, material: &Material) -> Self {
        let Some((own_mpa, known_mpa)) = material.tensile_modulus_mpa.zip(self.tensile_mpa) else { return self.clone() };
        let scaled = |young_mpa: f64| young_mpa * (own_mpa / known_mpa);
        Self {
            young_mpa: scaled(self.young_mpa),
            young_band_mpa: self.young_band_mpa.map(scaled),
            tensile_mpa: Some(own_mpa),
            ..self.clone()
        }
    }

    /// What has to be said of a flexible material whose modulus nobody states, or that is no flexible filament's, in a sentence.
    pub fn doubt(&self, material: &NamedMaterial) -> Option<String> {
        let is_unknown = self.tensile_mpa.is_some() && material.material.tensile_modulus_mpa.is_none();
        if is_unknown {
            return Some(format!(
                "{} states no tensile_modulus_mpa: the frame is computed as one of the material of {}, {:.1} MPa",
                material.name, self.name, self.young_mpa
            ));
        }
        let young_mpa = self.for_material(&material.material).young_mpa;
        let [low, high] = YOUNG_MPA;
        let by = match material.material.tensile_modulus_mpa.and(self.tensile_mpa) {
            Some(_) => format!("its tensile_modulus_mpa in the ratio of {}", self.name),
            None => format!("as {} states", self.name),
        };
        (!(low..=high).contains(&young_mpa)).then(|| {
            format!(
                "{} is computed with {young_mpa:.1} MPa, {by}: beyond the {low} to {high} MPa of flexible filaments that says little",
                material.name
            )
        })
    }

    /// The same with another band of the modulus, as far as a file may state it.
    #[must_use]
    pub fn with_band(&self, band_mpa: [f64; 2]) -> Self {
        let [low, high] = ["flexible.young_low_mpa", "flexible.young_high_mpa"].map(bounds);
        let ends_mpa = [band_mpa[0].min(self.young_mpa), band_mpa[1].max(self.young_mpa)];
        Self { young_band_mpa: [ends_mpa[0].clamp(low[0], low[1]), ends_mpa[1].clamp(high[0], high[1])], ..self.clone() }
    }

    /// The flexible material at rest.
    pub fn flexible(&self) -> Elastic {
        Elastic { young_mpa: self.young_mpa, shear_mpa: self.young_mpa / (2.0 * (1.0 + self.poisson)) }
    }

    /// How the flexible material relaxes in an impact.
    pub fn relaxation(&self) -> Relaxation {
        Relaxation::new(self.relaxation_exponent, self.rest_time_s, self.impact_modulus, self.impact_loss)
    }

    /// The same with other guesses: those of its numbers that nobody has measured and that a stiffness depends on, each within
    /// its bounds. `change` gets their number, 0 to 6, and their value.
    #[must_use]
    pub fn with_guesses(&self, mut change: impl FnMut(usize, f64) -> f64) -> Self {
        let mut other = self.clone();
        for (at, name) in GUESSES.into_iter().enumerate() {
            for Key { bounds: [least, most], of, .. } in KEYS.iter().filter(|key| key.name == name) {
                let value = of(&mut other);
                *value = change(at, *value).clamp(*least, *most);
            }
        }
        other
    }

    /// The same as a file.
    pub fn to_toml(&self, remark: &str) -> String {
        let mut own = self.clone();
        let mut text: String = remark.lines().map(|line| format!("# {line}\n")).collect();
        let mut table = "";
        for Key { name, of, .. } in &KEYS {
            let (of_table, name) = name.split_once('.').unwrap_or(("", name));
            if of_table != table {
                text += &format!("\n[{of_table}]\n");
                table = of_table;
                if let Some(tensile_mpa) = self.tensile_mpa.filter(|_| TENSILE.0.starts_with(of_table)) {
                    text += &format!("tensile_mpa = {tensile_mpa:?}\n");
                }
            }
            text += &format!("{name} = {:?}\n", *of(&mut own));
        }
        text
    }
}

/// Bounds of a key.
fn bounds(key: &str) -> [f64; 2] {
    KEYS.iter().find(|known| known.name == key).map_or([f64::NEG_INFINITY, f64::INFINITY], |known| known.bounds)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Frame;

    #[test]
    fn analytic_moduli_go_as_those_of_the_data_sheets() {
        let settings = MechanicsSettings::load(None).expect("is sound");
        let (frame, _) = Frame::load("cognifly").expect("a preset");
        let known = &frame.flexible;
        assert_eq!((settings.for_material(&known.material), settings.doubt(known)), (settings.clone(), None));
        let mut soft = known.clone();
        soft.material.tensile_modulus_mpa = known.material.tensile_modulus_mpa.map(|mpa| 0.25 * mpa);
        let scaled = settings.for_material(&soft.material);
        assert!((scaled.young_mpa / settings.young_mpa - 0.25).abs() < 1e-12);
        assert!((scaled.young_band_mpa[1] / settings.young_band_mpa[1] - 0.25).abs() < 1e-12);
        // Once is enough.
        assert_eq!(scaled.for_material(&soft.material), scaled);
        soft.material.tensile_modulus_mpa = None;
        assert_eq!(settings.for_material(&soft.material), settings);
        assert!(settings.doubt(&soft).is_some_and(|told| told.contains("states no tensile_modulus_mpa")));
        // As stiff as no flexible filament: told, and a file may state it.
        let mut stiff = known.clone();
        stiff.material.tensile_modulus_mpa = known.material.tensile_modulus_mpa.map(|mpa| 40.0 * mpa);
        assert!(settings.doubt(&stiff).is_some_and(|told| told.contains("2600.0 MPa")), "{:?}", settings.doubt(&stiff));
        let written = ImpactFile::parse("stiff", &settings.for_material(&stiff.material).to_toml("")).expect("is TOML");
        assert!(MechanicsSettings::read(&written).is_ok());
        // Of a file that a frame of that material was calibrated for.
        assert_eq!(MechanicsSettings { tensile_mpa: None, ..settings }.doubt(&soft), None);
    }

    #[test]
    fn analytic_a_band_is_one_that_a_file_may_state() {
        let settings = MechanicsSettings::load(None).expect("is sound").with_band([0.1, 5000.0]);
        let file = ImpactFile::parse("wide", &settings.to_toml("")).expect("is TOML");
        assert_eq!(MechanicsSettings::read(&file).expect("is sound").young_band_mpa, [0.1, 5000.0]);
    }

    #[test]
    fn analytic_written_numbers_are_read_again() {
        let settings = MechanicsSettings::load(None).expect("the program's own file is sound");
        let file = ImpactFile::parse(&settings.name, &settings.to_toml("as it was")).expect("is TOML");
        assert_eq!(MechanicsSettings::read(&file).expect("is sound"), settings);
    }

    /// A band that begins above the modulus.
    fn other_band(text: &str) -> String {
        let line = text.lines().find(|line| line.starts_with("young_low_mpa")).expect("is stated");
        text.replace(line, "young_low_mpa = 300.0")
    }

    #[test]
    fn planted_a_missing_and_an_unknown_number_are_refused() {
        let text = MechanicsSettings::load(None).expect("is sound").to_toml("");
        for wrong in [
            text.replace("poisson", "poison"),
            text.replace("friction = 0.3", "friction = 3.0"),
            text.replace("socket_elements = 4.0", "socket_elements = 4.5"),
            text.replace("[ground]", "[sky]"),
            other_band(&text),
        ] {
            assert_ne!(wrong, text);
            let file = ImpactFile::parse("planted", &wrong).expect("is TOML");
            assert!(MechanicsSettings::read(&file).is_err());
        }
    }
}
