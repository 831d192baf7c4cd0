//! Plates: everything on the bed, nothing upon another, as many as the frame needs, on every printer.

use crate::common;
use std::collections::BTreeSet;
use std::io::{Cursor, Read};
use std::path::Path;
use std::sync::{Mutex, OnceLock};

use flexframe::export::three_mf;
use flexframe::frame::assembly::Design;
use flexframe::frame::assembly::compensated::Compensated;
use flexframe::params::catalogue::{Bed, Printer};
use flexframe::params::{Frame, FrameFile, PartName};
use flexframe::printing::plates::{Plate, all, arrange, arrange_what_fits};
use proptest::prelude::*;

fn design() -> Design {
    let file = FrameFile::load("cognifly").expect("a preset");
    Design::with(Frame::resolve(&file).expect("resolves"), common::memo()).expect("is designed")
}

/// One design for many cases.
fn shared() -> &'static Mutex<Design> {
    static DESIGN: OnceLock<Mutex<Design>> = OnceLock::new();
    DESIGN.get_or_init(|| Mutex::new(design()))
}

/// Least room between two parts that their brims, of 3 mm each, do not touch, mm.
const APART_MM: f64 = 6.0;

fn printers() -> Vec<(String, Printer)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("params/printers");
    let mut files: Vec<_> = std::fs::read_dir(folder).expect("printers").map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    let read = |path: std::path::PathBuf| {
        let text = std::fs::read_to_string(&path).expect("reads");
        (path.file_stem().expect("a name").to_string_lossy().into_owned(), toml::from_str(&text).expect("a printer"))
    };
    files.into_iter().map(read).collect()
}

/// Boxes of a plate's parts on the bed, mm.
fn boxes(design: &Design, plate: &Plate) -> Vec<[[f64; 2]; 2]> {
    let of = |item: &flexframe::printing::plates::Item| {
        let part = design.part(item.part).expect("a part of the frame");
        let placed = part.mesh.placed(&item.pose(part));
        let [low, high] = placed.bounds_mm();
        assert!(low[2].abs() < 1e-4, "{} does not stand on the bed: {}", item.part, low[2]);
        [[low[0], low[1]], [high[0], high[1]]]
    };
    plate.items.iter().map(of).collect()
}

/// What is wrong with plates.
fn faults(design: &Design, plates: &[Plate], wanted: &[(PartName, usize)]) -> Vec<String> {
    let mut faults = Vec::new();
    let printer = &design.frame.printer;
    for plate in plates {
        let boxes = boxes(design, plate);
        for (at, [low, high]) in boxes.iter().enumerate() {
            let on = match printer.bed {
                Bed::Rectangular => (0..2).all(|axis| low[axis] >= -1e-6 && high[axis] <= printer.size_mm[axis] + 1e-6),
                Bed::Round => {
                    plate.items.len() == 1 || [low, high].iter().all(|c| libm::hypot(c[0], c[1]) <= 0.5 * printer.size_mm[0] + 1e-6)
                }
            };
            if !on {
                faults.push(format!("{} of {} is off the bed", plate.items[at].part, plate.name()));
            }
            for kept in printer.kept_clear_mm.iter().flatten() {
                if (0..2).all(|axis| low[axis] < kept[axis + 2] - 1e-6 && kept[axis] + 1e-6 < high[axis]) {
                    faults.push(format!("{} of {} lies where the bed is kept clear", plate.items[at].part, plate.name()));
                }
            }
            for [other_low, other_high] in &boxes[at + 1..] {
                if (0..2).all(|axis| low[axis] < other_high[axis] + APART_MM && other_low[axis] < high[axis] + APART_MM) {
                    faults.push(format!("{} is too near to another on {}", plate.items[at].part, plate.name()));
                }
            }
        }
    }
    for (name, count) in wanted {
        let found = plates.iter().flat_map(|plate| &plate.items).filter(|item| item.part == *name).count();
        if found != *count {
            faults.push(format!("{found} {name} instead of {count}"));
        }
    }
    faults
}

#[test]
fn analytic_every_printer_takes_the_frame() {
    let mut design = design();
    for (name, printer) in printers() {
        design.frame.printer = printer;
        let wanted = all(&design);
        let plates = arrange(&design, &wanted).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(faults(&design, &plates, &wanted), Vec::<String>::new(), "{name}");
        assert!(plates.iter().all(|plate| plate.items.iter().all(|item| design.material_of(item.part).name == plate.material.name)));
    }
}

/// Three frames on one printer fill its bed.
#[test]
fn planted_full_plates_leave_free_what_a_printer_keeps_clear() {
    let mut design = design();
    let wanted: Vec<(PartName, usize)> = all(&design).into_iter().map(|(name, count)| (name, 3 * count)).collect();
    for (name, printer) in printers().into_iter().filter(|(_, printer)| printer.kept_clear_mm.is_some()) {
        design.frame.printer = Printer { kept_clear_mm: None, ..printer.clone() };
        let blind = arrange(&design, &wanted).expect("has room");
        design.frame.printer = printer;
        assert!(!faults(&design, &blind, &wanted).is_empty(), "{name}: no plate is full");
        let plates = arrange(&design, &wanted).expect("has room");
        assert_eq!(faults(&design, &plates, &wanted), Vec::<String>::new(), "{name}");
        assert!(plates.len() <= blind.len() + 1, "{name}: {} plates instead of {}", plates.len(), blind.len());
    }
}

#[test]
fn planted_a_part_whose_middle_is_kept_clear_lies_at_the_edge_or_nowhere() {
    let mut design = design();
    design.frame.printer.kept_clear_mm = Some(vec![[80.0, 80.0, 100.0, 100.0]]);
    let wanted = all(&design);
    let plates = arrange(&design, &wanted).expect("has room");
    assert_eq!(faults(&design, &plates, &wanted), Vec::<String>::new());
    // As many parts lie beside that place as its edges leave room for, and not one on each plate.
    assert!(plates.len() <= 4, "{plates:?}");
    design.frame.printer.kept_clear_mm = Some(vec![[-1000.0, -1000.0, 2000.0, 2000.0]]);
    assert!(arrange(&design, &wanted).is_err() && arrange_what_fits(&design, &wanted).is_empty());
}

#[test]
fn planted_wide_brims_meet_neither_each_other_nor_the_edge() {
    const BRIM_MM: f64 = 9.0;
    let mut design = design();
    design.frame.flexible.material.brim_mm = Some(BRIM_MM);
    design.frame.rigid.material.brim_mm = Some(BRIM_MM);
    let size_mm = design.frame.printer.size_mm;
    for plate in arrange(&design, &all(&design)).expect("has room") {
        let boxes = boxes(&design, &plate);
        for (at, [low, high]) in boxes.iter().enumerate() {
            let inside = (0..2).all(|axis| low[axis] >= BRIM_MM - 0.01 && high[axis] <= size_mm[axis] - BRIM_MM + 0.01);
            assert!(inside, "a brim of {} leaves the bed: {low:?} {high:?}", plate.name());
            let apart = |axis: usize, other: &[[f64; 2]; 2]| (other[0][axis] - high[axis]).max(low[axis] - other[1][axis]);
            let meets = boxes[at + 1..].iter().any(|other| (0..2).all(|axis| apart(axis, other) < 2.0 * BRIM_MM - 0.01));
            assert!(!meets, "brims meet on {}", plate.name());
        }
    }
}

#[test]
fn analytic_a_plate_of_no_printer_lies_on_every_rectangular_bed() {
    let design = design();
    let plates = arrange(&design, &all(&design)).expect("has room");
    for (name, printer) in printers().into_iter().filter(|(_, printer)| printer.bed == Bed::Rectangular) {
        assert!(design.frame.printer.height_mm <= printer.height_mm, "{name} is lower");
        for [low, high] in plates.iter().flat_map(|plate| boxes(&design, plate)) {
            assert!((0..2).all(|axis| low[axis] >= 0.0 && high[axis] <= printer.size_mm[axis]), "off the bed of {name}: {low:?} {high:?}");
        }
    }
}

#[test]
fn analytic_every_copy_has_settings_where_each_slicer_looks_for_them() {
    let design = design();
    let meshes = Compensated::of(&design).expect("passes the gate");
    for plate in arrange(&design, &all(&design)).expect("has room") {
        let bytes = three_mf::plate(&design, &meshes, &plate, b"").expect("is made");
        let text = |name: &str| {
            let mut text = String::new();
            let mut archive = zip::ZipArchive::new(Cursor::new(&bytes)).expect("an archive");
            archive.by_name(name).expect("is there").read_to_string(&mut text).expect("is text");
            text
        };
        let model = text("3D/3dmodel.model");
        let placed: BTreeSet<&str> = model.split("<item objectid=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
        assert_eq!(placed.len(), plate.items.len(), "an object stands there twice");
        let (parts, copies) = (plate.quantities().len(), plate.items.len());
        assert_eq!(text("Metadata/Slic3r_PE_model.config").matches("key=\"fill_density\" value=\"100%\"").count(), parts);
        assert_eq!(text("Metadata/model_settings.config").matches("key=\"sparse_infill_density\" value=\"100%\"").count(), copies);
        assert_eq!(model.matches("<metadata name=\"cura:infill_sparse_density\">100</metadata>").count(), parts);
    }
}

#[test]
fn planted_a_bed_that_is_too_small_or_too_low_is_refused_with_the_part() {
    let mut design = design();
    let wanted = all(&design);
    design.frame.printer.size_mm = [60.0, 60.0];
    let refused = arrange(&design, &wanted).expect_err("has no room").to_string();
    assert!(refused.contains("has no room on the printer"), "{refused}");
    // What fits alone is laid out without the rest.
    let fit: Vec<_> = wanted.iter().copied().filter(|one| arrange(&design, &[*one]).is_ok()).collect();
    assert!(!fit.is_empty() && fit.len() < wanted.len(), "{fit:?}");
    assert_eq!(faults(&design, &arrange_what_fits(&design, &wanted), &fit), Vec::<String>::new());
    design.frame.printer.size_mm = [250.0, 250.0];
    design.frame.printer.height_mm = 1.0;
    assert!(arrange(&design, &wanted).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]
    #[test]
    fn analytic_any_bed_and_any_number(width in 150.0..400.0_f64, depth in 150.0..400.0_f64, round in any::<bool>(), count in 1_usize..30) {
        let mut design = shared().lock().expect("a design");
        let (bed, size_mm) = if round { (Bed::Round, [width.max(220.0); 2]) } else { (Bed::Rectangular, [width, depth]) };
        design.frame.printer.bed = bed;
        design.frame.printer.size_mm = size_mm;
        design.frame.printer.height_mm = 200.0;
        let wanted = [(PartName::Knee, count), (PartName::Fork, count / 2), (PartName::BatterySleeve, 1 + count / 5)];
        let plates = arrange(&design, &wanted).map_err(|error| TestCaseError::fail(error.to_string()))?;
        prop_assert_eq!(faults(&design, &plates, &wanted), Vec::<String>::new());
    }
}
