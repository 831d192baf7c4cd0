//! Whether a printer is hot enough for a material, and what could be printed instead.
//!
//! A material states what its profile sets and the least heat at which it prints; a printer what its hot end and its bed bear, and whether
//! it is enclosed. What one of them does not state is not judged.

use crate::frame::assembly::Design;
use crate::params::catalogue::{Material, Printer};
use crate::params::frame::NamedMaterial;
use crate::params::preset;

/// What of the printer a material wants more of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Heater {
    /// The hot end.
    Nozzle,
    /// The bed.
    Bed,
    /// Warm air around the part.
    Enclosure,
}

impl Heater {
    /// Its name.
    pub fn words(self) -> &'static str {
        match self {
            Self::Nozzle => "nozzle",
            Self::Bed => "bed",
            Self::Enclosure => "enclosure",
        }
    }
}

/// What a material asks for beside what the printer has. An enclosure is 1 or 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heat {
    /// Of which.
    pub of: Heater,
    /// What the material's profile sets, and no less than it needs.
    pub wanted: f64,
    /// What the printer has.
    pub has: f64,
    /// Whether it cannot be printed with that: not even with the least heat that the material is known to print at.
    pub too_cold: bool,
}

/// Materials that are offered instead of one that a printer cannot print.
const INSTEAD: [&str; 2] = ["pla", "petg"];

/// What is printed in place of the rigid material.
#[derive(Clone, Debug, PartialEq)]
pub struct Instead {
    /// Its name.
    pub name: &'static str,
    /// How much heavier the frame gets, g.
    pub heavier_g: f64,
    /// Where it softens, and where the other does, °C.
    pub softens_c: [Option<f64>; 2],
    /// The nozzle that it is printed at here, °C: that of its profile, or all that the printer has.
    pub nozzle_c: Option<f64>,
    /// The nozzle that its profile sets, °C.
    pub usual_c: Option<f64>,
}

/// All that can be compared of a material and a printer.
pub fn heats(material: &Material, printer: &Printer) -> Vec<Heat> {
    let least = material.least_nozzle_c.or(material.nozzle_c);
    let wanted_c = material.nozzle_c.into_iter().chain(least).reduce(f64::max);
    let [nozzle, bed] = [(wanted_c, printer.most_nozzle_c), (material.bed_c, printer.most_bed_c)].map(|(wanted, has)| wanted.zip(has));
    let nozzle = nozzle.map(|(wanted, has)| Heat { of: Heater::Nozzle, wanted, has, too_cold: least.is_some_and(|least| least > has) });
    let bed = bed.map(|(wanted, has)| Heat { of: Heater::Bed, wanted, has, too_cold: false });
    let number = |yes: bool| f64::from(u8::from(yes));
    let air = material.wants_enclosure.zip(printer.enclosed).map(|(wanted, has)| Heat {
        of: Heater::Enclosure,
        wanted: number(wanted),
        has: number(has),
        too_cold: false,
    });
    [nozzle, bed, air].into_iter().flatten().collect()
}

/// What a printer's or material's entry leaves open.
pub fn unknown(material: &Material, printer: &Printer) -> Vec<Heater> {
    let compared: Vec<Heater> = heats(material, printer).iter().map(|heat| heat.of).collect();
    [Heater::Nozzle, Heater::Bed, Heater::Enclosure].into_iter().filter(|of| !compared.contains(of)).collect()
}

/// Whether a printer gives a material all that it wants, but for a nozzle that is hot enough if not as hot.
fn suits(material: &Material, printer: &Printer) -> bool {
    heats(material, printer).iter().all(|heat| if heat.of == Heater::Nozzle { !heat.too_cold } else { heat.wanted <= heat.has })
}

/// What the rigid parts could be printed from on this printer.
pub fn instead(design: &Design) -> Vec<Instead> {
    let (frame, known) = (&design.frame, preset::materials());
    let rigid = design.printed.iter().filter(|part| design.material_of(part.name).name == frame.rigid.name);
    let cm3: f64 = rigid.map(|part| 1e-3 * part.volume_mm3 * f64::from(part.part.quantity())).sum();
    let weight = |material: &Material| material.density_g_cm3 * material.print_factor;
    let of = |name: &'static str| {
        let material = known.get(name).filter(|material| name != frame.rigid.name && suits(material, &frame.printer))?;
        let most = frame.printer.most_nozzle_c.unwrap_or(f64::INFINITY);
        Some(Instead {
            name,
            heavier_g: cm3 * (weight(material) - weight(&frame.rigid.material)),
            softens_c: [material.softens_c, frame.rigid.material.softens_c],
            nozzle_c: material.nozzle_c.map(|wanted| wanted.min(most)),
            usual_c: material.nozzle_c,
        })
    };
    INSTEAD.into_iter().filter_map(of).collect()
}

impl Instead {
    /// In words.
    pub fn words(&self) -> String {
        let Self { name, heavier_g, softens_c: [own, other], nozzle_c, usual_c } = self;
        let cold = usual_c.filter(|usual| nozzle_c.is_some_and(|c| c < *usual));
        let cold = cold.map_or(String::new(), |usual| format!(", colder than its usual {usual:.0} °C"));
        let nozzle = nozzle_c.map_or(String::new(), |c| format!(" at {c:.0} °C{cold}"));
        let softer = own.zip(*other).map_or(String::new(), |(own, other)| format!(", softens at {own:.0} instead of {other:.0} °C"));
        format!("{name}{nozzle} ({heavier_g:+.1} g{softer})")
    }
}

/// A sentence on what a printer lacks for a material; the rigid one has others offered.
pub fn sentence(design: &Design, material: &NamedMaterial, heat: &Heat) -> String {
    let (name, printer) = (&material.name, &design.frame.printer.name);
    let lacks = match heat.of {
        Heater::Enclosure => format!("{name} wants an enclosure, {printer} has {}", if heat.has > 0.0 { "one" } else { "none" }),
        of => format!("{name} is usually printed with a {} of {:.0} °C, {printer} reaches {:.0} °C", of.words(), heat.wanted, heat.has),
    };
    if heat.wanted <= heat.has {
        return lacks;
    }
    let least = material.material.least_nozzle_c.filter(|_| heat.of == Heater::Nozzle);
    let least = least.map_or(String::new(), |least| format!(", and {name} needs {least:.0} °C at least"));
    let others: Vec<String> = instead(design).iter().map(Instead::words).collect();
    let rigid = *name == design.frame.rigid.name && !others.is_empty();
    let offer = if rigid { format!("; rigid parts of {}", others.join(" or ")) } else { String::new() };
    format!("{lacks}{least}{offer}")
}
