//! What cutting rods asks for, by their material: of some the dust harms lungs, of others the ends are sharp alone.

use crate::params::Frame;

/// The rods' material by its name in the catalogue, and whether its dust harms.
fn material(frame: &Frame) -> (&str, bool) {
    let used = &frame.rod_material;
    (&used.name, used.material.dust_harms.unwrap_or(true))
}

/// What to take care of when the rods of a frame are cut.
pub fn when_cut(frame: &Frame) -> String {
    match material(frame) {
        (name, true) => format!(
            "The rods are of {name}. Its dust harms lungs, eyes and skin: cut the rods wet, under a mask, with glasses and gloves, and wipe them before use."
        ),
        (name, false) => format!(
            "The rods are of {name}. Their cut ends are sharp and can splinter: cut them with a fine saw, wear glasses, and sand the ends."
        ),
    }
}

/// What is worn when the rods of a frame are cut, and when they are pushed.
pub fn worn(frame: &Frame) -> &'static [&'static str] {
    if material(frame).1 { &["dust mask", "glasses", "gloves"] } else { &["glasses", "gloves"] }
}

/// What to take care of when a rod of a frame is pushed into a bore.
pub(super) fn when_pushed(frame: &Frame) -> String {
    let ends = match material(frame) {
        (name, true) => format!("Ends of cut rods of {name} splinter: wear gloves and a dust mask, wipe the ends before pushing."),
        (name, false) => format!("Ends of cut rods of {name} can splinter: wear gloves, sand the ends before pushing."),
    };
    format!("{ends} Glue only a rod that is loose.")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of rods without fibres in resin nothing warns of carbon, of dust or of lungs.
    #[test]
    fn regress_cautions_follow_the_rods_material() {
        let said = |preset: &str| {
            let frame = Frame::load(preset).expect("a preset").0;
            format!("{} {}", when_cut(&frame), when_pushed(&frame)).to_lowercase()
        };
        let (carbon, bamboo) = (said("cognifly"), said("cognifly-bamboo"));
        assert!(carbon.contains("carbon") && carbon.contains("wet") && carbon.contains("dust mask"), "{carbon}");
        assert!(bamboo.contains("bamboo") && bamboo.contains("sand the ends"), "{bamboo}");
        assert!(["carbon", "dust", "lungs", "wet"].iter().all(|word| !bamboo.contains(word)), "{bamboo}");
        for (preset, said) in [("cognifly", &carbon), ("cognifly-bamboo", &bamboo)] {
            let frame = Frame::load(preset).expect("a preset").0;
            assert!(worn(&frame).iter().all(|worn| said.contains(worn)), "{preset}: {said}");
        }
    }

    #[test]
    fn planted_dust_of_which_nothing_is_stated_harms() {
        let mut frame = Frame::load("cognifly-bamboo").expect("a preset").0;
        (frame.rod_material.name, frame.rod_material.material.dust_harms) = ("t700".into(), None);
        let said = when_cut(&frame);
        assert!(said.contains("of t700.") && said.contains("dust harms lungs"), "{said}");
    }
}
