//! What is made to the size of a bought part has that size: the space of the propellers, the pockets of the magnets, the channel of the power
//! connector. Where a frame file states no size of its own there is nothing to compare.

use super::comparison::{measure, name, part};
use crate::checks::finding::Finding;
use crate::params::Frame;
use crate::params::catalogue::BoughtPart;
use crate::params::follows::CONNECTOR_CLEARANCE_MM;

pub(super) const PROPELLER: &[&str] = &["motor_mount.propeller_diameter_mm", "bought.propeller"];
pub(super) const MAGNET: [&[&str]; 3] = [
    &["bracket.magnet_length_mm", "bought.magnet"],
    &["bracket.magnet_width_mm", "bought.magnet"],
    &["bracket.magnet_thickness_mm", "bought.magnet"],
];
pub(super) const CONNECTOR: [&[&str]; 2] =
    [&["bracket.connector_width_mm", "bought.connector"], &["bracket.connector_height_mm", "bought.connector"]];

/// Room beyond a part that is glued in, mm: a choice. Glue does not bridge more.
const GLUED_MM: f64 = 1.0;

/// One size of a bought part, and what is made for it.
struct Size {
    role: &'static str,
    made: &'static str,
    way: &'static str,
    stated_mm: fn(&Frame) -> f64,
    part_mm: fn(&BoughtPart) -> Option<f64>,
    /// More than the part that what is made has where a file states nothing, mm.
    clearance_mm: f64,
    glued: bool,
    levers: &'static [&'static str],
}

const POCKETS: Size = Size {
    role: "magnet",
    made: "the pockets of bracket and lid are",
    way: "long",
    stated_mm: |frame| frame.bracket.magnet_length_mm,
    part_mm: |magnet| Some(magnet.size_mm[0]),
    clearance_mm: 0.0,
    glued: true,
    levers: MAGNET[0],
};
const CHANNEL: Size = Size {
    role: "connector",
    made: "the channel of bracket and lid is",
    way: "wide",
    stated_mm: |frame| frame.bracket.connector_width_mm,
    part_mm: |connector| Some(connector.size_mm[1]),
    clearance_mm: CONNECTOR_CLEARANCE_MM,
    glued: true,
    levers: CONNECTOR[0],
};

const SIZES: [Size; 6] = [
    Size {
        role: "propeller",
        made: "clearances are those of propellers that are",
        way: "wide",
        stated_mm: |frame| frame.motor_mount.propeller_diameter_mm,
        part_mm: |propeller| propeller.diameter_mm,
        clearance_mm: 0.0,
        glued: false,
        levers: PROPELLER,
    },
    POCKETS,
    Size {
        way: "high",
        stated_mm: |frame| frame.bracket.magnet_width_mm,
        part_mm: |magnet| Some(magnet.size_mm[1]),
        levers: MAGNET[1],
        ..POCKETS
    },
    Size {
        way: "deep",
        stated_mm: |frame| frame.bracket.magnet_thickness_mm,
        part_mm: |magnet| Some(magnet.size_mm[2]),
        levers: MAGNET[2],
        ..POCKETS
    },
    CHANNEL,
    Size {
        way: "high",
        stated_mm: |frame| frame.bracket.connector_height_mm,
        part_mm: |connector| Some(connector.size_mm[2]),
        levers: CONNECTOR[1],
        ..CHANNEL
    },
];

/// A stated size is that of the part or more, and of a part that is glued in, not much more.
pub(super) fn sizes(frame: &Frame) -> Vec<Finding> {
    SIZES.iter().filter_map(|size| size.findings(frame)).flatten().collect()
}

impl Size {
    fn findings(&self, frame: &Frame) -> Option<Vec<Finding>> {
        let (stated_mm, part_mm) = ((self.stated_mm)(frame), (self.part_mm)(part(frame, self.role)?)?);
        if (stated_mm - part_mm - self.clearance_mm).abs() < 1e-9 {
            return None;
        }
        let Self { role, made, way, levers, .. } = self;
        let called = name(frame, role);
        let room = measure(stated_mm, part_mm, "mm", levers);
        let [own, needed] = room.figures(2);
        let message = format!("{made} {own} mm {way}, {called} in the bill of materials is {needed} mm {way}");
        let mut found = vec![room.at_least(format!("made for the {role}: how {way}"), message)];
        if self.glued {
            let loose = measure(stated_mm - part_mm, GLUED_MM, "mm", levers);
            let [more, most] = loose.figures(2);
            let message = format!("{made} {more} mm more than {called} is {way}, glue bridges {most} mm");
            found.push(loose.at_most(format!("made for the {role}: how {way}, loose"), message));
        }
        Some(found)
    }
}

#[cfg(test)]
mod tests {
    use crate::checks::hardware::tests::{broken, own};

    /// Sizes that follow from what is bought are not compared; those of another part are told, in either direction.
    #[test]
    fn planted_pockets_of_another_part() {
        let none = Vec::<String>::new();
        assert_eq!(broken(|frame| frame.motor_mount.propeller_diameter_mm = 60.0), ["made for the propeller: how wide"]);
        assert_eq!(
            broken(|frame| own(frame, "propeller", |bought| bought.diameter_mm = Some(127.0))),
            ["made for the propeller: how wide"]
        );
        assert_eq!(broken(|frame| frame.motor_mount.propeller_diameter_mm = 76.5), none);
        assert_eq!(broken(|frame| frame.bracket.connector_width_mm = 9.0), ["made for the connector: how wide"]);
        assert_eq!(broken(|frame| frame.bracket.connector_width_mm = 18.0), ["made for the connector: how wide, loose"]);
        assert_eq!(broken(|frame| frame.bracket.magnet_thickness_mm = 1.0), ["made for the magnet: how deep"]);
        let larger = broken(|frame| own(frame, "magnet", |bought| bought.size_mm = [20.0, 10.0, 5.0]));
        assert_eq!(larger, ["long", "high", "deep"].map(|way| format!("made for the magnet: how {way}")));
    }
}
