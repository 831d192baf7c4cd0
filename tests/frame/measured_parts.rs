//! The real frame (CogniFly v8) is right: size, volume and every functional dimension of the printed parts of the preset
//! `cognifly-v8`, measured on what their STL files hold.
//!
//! The figures stand in `reference/parts.toml` and `reference/dimensions.toml`. The joints' fold angles and the sockets as
//! assembled are in `measured_skeleton.rs`; heights in the assembly, the battery's fit and the gap between the magnets are
//! measured next to the parts (`src/frame/assembly/centre_tests.rs`, `battery_sleeve.rs`, `battery_lid.rs`).

use crate::real::{figures, ours};
use flexframe::params::PartName;

/// Sides of the bounding box are held to this, mm.
const BOX_MM: f64 = 1.0;

/// Volumes are held to this share.
const VOLUME_SHARE: f64 = 0.10;

/// Functional dimensions are held to this, mm; angles to as many degrees.
const CLOSE: f64 = 0.05;

/// Sections were stated to 0.1 mm².
const CLOSE_MM2: f64 = 0.1;

#[test]
fn measured_boxes_and_volumes_are_those_of_the_real_parts() {
    let mut seen = std::collections::BTreeSet::new();
    for real in figures::parts() {
        seen.insert(real.part);
        // The real box is known in the axes of the real file.
        let mesh = ours::exported(&ours::printed(&real)).placed(&real.pose().inverse());
        for (ours, figure) in mesh.size_mm().into_iter().zip(real.size_mm) {
            assert!((ours - figure).abs() < BOX_MM, "{}: {:?} mm, the real one {:?}", real.name(), mesh.size_mm(), real.size_mm);
        }
        let off = mesh.volume_mm3() / real.volume_mm3 - 1.0;
        assert!(off.abs() < VOLUME_SHARE, "{}: volume off by {:.1} %", real.name(), 100.0 * off);
    }
    // The real frame has no accessory plate.
    let all: Vec<PartName> = PartName::ALL.into_iter().filter(|part| *part != PartName::AccessoryPlate).collect();
    assert_eq!(seen.into_iter().collect::<Vec<_>>(), all);
}

#[test]
fn measured_every_functional_dimension_is_the_real_one() {
    let mut off = Vec::new();
    let dimensions = figures::dimensions();
    for real in figures::parts().iter().filter(|real| real.riser_mm == 0.0) {
        let mesh = ours::exported(&ours::printed(real));
        for dimension in &dimensions[&real.part] {
            let unit = dimension.by.unit();
            let found = dimension.by.measure(&mesh).unwrap_or(f64::NAN);
            let close = if unit == "mm²" { CLOSE_MM2 } else { CLOSE };
            let holds = (found - dimension.nominal()).abs() <= close;
            if !holds {
                off.push(format!("{}, {}: {found:.3} {unit}, not {}", real.name(), dimension.name, dimension.nominal()));
            }
        }
    }
    assert!(off.is_empty(), "{}", off.join("\n"));
}

/// The probes do find what is wrong: a part of other parameters.
#[test]
fn planted_a_wider_bore_is_found() {
    let real = figures::parts().into_iter().find(|real| real.part == PartName::Fork).expect("the fork is in the table");
    let mut frame = flexframe::params::Frame::load("cognifly-v8").expect("the preset is valid").0;
    frame.fit.grip_clearance_mm += 0.12;
    let mesh = ours::exported(&ours::made(real.part, &frame));
    let bore = &figures::dimensions()[&PartName::Fork][0];
    let found = bore.by.measure(&mesh).expect("there is a bore");
    assert!((found - bore.figure - 0.12).abs() < 0.02, "{found}");
}
