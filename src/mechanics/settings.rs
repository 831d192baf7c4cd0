//! Numbers of the mechanics that no frame file holds, as `params/mechanics.toml` states them.

use crate::mechanics::element::relaxation::Relaxation;
use crate::mechanics::parts::section::Elastic;
use crate::params::refusal::Refusal;
use crate::params::{ImpactFile, LoadError};

/// The numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct MechanicsSettings {
    /// Where they come from: a file's name.
    pub name: String,
    /// Young's modulus of the flexible material at rest, MPa.
    pub young_mpa: f64,
    /// The band it is known to, MPa.
    pub young_band_mpa: [f64; 2],
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
#[derive(Clone, Copy, Debug, PartialEq)]
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

/// Bounds of [`MechanicsSettings::impact_modulus`].
pub const IMPACT_MODULUS: [f64; 2] = [0.1, 3.0];
/// Bounds of [`MechanicsSettings::impact_loss`].
pub const IMPACT_LOSS: [f64; 2] = [0.0, 3.0];

/// Keys with their bounds and units, in the order of the fields; the band stands on its own.
const KEYS: [(&str, [f64; 2], &str); 22] = [
    ("flexible.young_mpa", [10.0, 400.0], "MPa"),
    ("flexible.young_low_mpa", [5.0, 400.0], "MPa"),
    ("flexible.young_high_mpa", [10.0, 800.0], "MPa"),
    ("flexible.poisson", [0.3, 0.499], "1"),
    ("flexible.rest_time_s", [0.1, 1e4], "s"),
    ("flexible.relaxation_exponent", [0.0, 0.2], "1"),
    ("flexible.impact_modulus", IMPACT_MODULUS, "1"),
    ("flexible.impact_loss", IMPACT_LOSS, "1"),
    ("rods.shear_mpa", [100.0, 5e4], "MPa"),
    ("joints.socket_foundation", [1.0, 20.0], "1"),
    ("joints.plug_foundation", [1.0, 20.0], "1"),
    ("joints.core_rigid", [0.0, 1.0], "1"),
    ("joints.notch_contact", [0.0, 2.0], "1"),
    ("ground.friction", [0.0, 1.0], "1"),
    ("ground.foot_stiffness", [1.0, 100.0], "mm"),
    ("limits.drop_m", [0.05, 20.0], "m"),
    ("limits.payload_peak_g", [5.0, 2000.0], "g"),
    ("limits.strain_factor", [1.0, 20.0], "1"),
    ("limits.buckling_factor", [1.0, 20.0], "1"),
    ("mesh.element_mm", [0.1, 3.0], "mm"),
    ("mesh.socket_elements", [1.0, 12.0], "1"),
    ("mesh.rod_element_mm", [2.0, 100.0], "mm"),
];

impl MechanicsSettings {
    /// Reads a file, or the numbers that come with the program.
    ///
    /// # Errors
    /// When it cannot be read, lacks a number, or one is out of bounds.
    pub fn load(path: Option<&str>) -> Result<Self, LoadError> {
        Ok(Self::read(&ImpactFile::mechanics(path)?)?)
    }

    /// Reads them from a file.
    ///
    /// # Errors
    /// When a number is missing or out of bounds, or a key unknown.
    pub fn read(file: &ImpactFile) -> Result<Self, Refusal> {
        let tables = ["flexible", "rods", "joints", "ground", "limits", "mesh"];
        let mut known: Vec<String> = KEYS.iter().map(|(key, ..)| key.to_string()).collect();
        known.extend(tables.map(String::from));
        file.only(&known, &[])?;
        let mut values = [0.0; KEYS.len()];
        for (value, (key, bounds, unit)) in values.iter_mut().zip(KEYS) {
            *value = file.stated(key, bounds, unit)?;
        }
        let [young_mpa, low, high, poisson, rest_time_s, relaxation_exponent, impact_modulus, impact_loss, rest @ ..] = values;
        let [rod_shear_mpa, socket_foundation, plug_foundation, core_rigid, notch_contact, friction, foot_stiffness, rest @ ..] = rest;
        let [drop_m, payload_peak_g, strain_factor, buckling_factor, element_mm, socket_elements, rod_element_mm] = rest;
        Ok(Self {
            name: file.name.clone(),
            young_mpa,
            young_band_mpa: [low.min(young_mpa), high.max(young_mpa)],
            poisson,
            rest_time_s,
            relaxation_exponent,
            impact_modulus,
            impact_loss,
            rod_shear_mpa,
            socket_foundation,
            plug_foundation,
            core_rigid,
            notch_contact,
            friction,
            foot_stiffness,
            limits: DropLimits { drop_m, payload_peak_g, strain_factor, buckling_factor },
            element_mm,
            socket_elements: socket_elements.round(),
            rod_element_mm,
        })
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
        let guesses: [(&str, &mut f64); 7] = [
            ("flexible.poisson", &mut other.poisson),
            ("joints.socket_foundation", &mut other.socket_foundation),
            ("joints.plug_foundation", &mut other.plug_foundation),
            ("joints.core_rigid", &mut other.core_rigid),
            ("joints.notch_contact", &mut other.notch_contact),
            ("ground.friction", &mut other.friction),
            ("ground.foot_stiffness", &mut other.foot_stiffness),
        ];
        for (at, (key, value)) in guesses.into_iter().enumerate() {
            let bounds = KEYS.iter().find(|(known, ..)| *known == key).map_or([f64::NEG_INFINITY, f64::INFINITY], |(_, bounds, _)| *bounds);
            *value = change(at, *value).clamp(bounds[0], bounds[1]);
        }
        other
    }

    /// The same as a file.
    pub fn to_toml(&self, remark: &str) -> String {
        let values = [
            self.young_mpa,
            self.young_band_mpa[0],
            self.young_band_mpa[1],
            self.poisson,
            self.rest_time_s,
            self.relaxation_exponent,
            self.impact_modulus,
            self.impact_loss,
            self.rod_shear_mpa,
            self.socket_foundation,
            self.plug_foundation,
            self.core_rigid,
            self.notch_contact,
            self.friction,
            self.foot_stiffness,
            self.limits.drop_m,
            self.limits.payload_peak_g,
            self.limits.strain_factor,
            self.limits.buckling_factor,
            self.element_mm,
            self.socket_elements,
            self.rod_element_mm,
        ];
        let mut text: String = remark.lines().map(|line| format!("# {line}\n")).collect();
        let mut table = "";
        for ((key, ..), value) in KEYS.iter().zip(values) {
            let (own, name) = key.split_once('.').unwrap_or(("", key));
            if own != table {
                text += &format!("\n[{own}]\n");
                table = own;
            }
            text += &format!("{name} = {value:?}\n");
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_written_numbers_are_read_again() {
        let settings = MechanicsSettings::load(None).expect("the program's own file is sound");
        let file = ImpactFile::parse(&settings.name, &settings.to_toml("as it was")).expect("is TOML");
        assert_eq!(MechanicsSettings::read(&file).expect("is sound"), settings);
    }

    #[test]
    fn planted_a_missing_and_an_unknown_number_are_refused() {
        let text = MechanicsSettings::load(None).expect("is sound").to_toml("");
        for wrong in
            [text.replace("poisson", "poison"), text.replace("friction = 0.3", "friction = 3.0"), text.replace("[ground]", "[sky]")]
        {
            let file = ImpactFile::parse("planted", &wrong).expect("is TOML");
            assert!(MechanicsSettings::read(&file).is_err());
        }
    }
}
