//! `print-settings.md`: what a person sets on the slicer, and what has come along with the plates.

use std::fmt::Write;

use crate::frame::assembly::Design;
use crate::markdown::inert;
use crate::params::catalogue::{Bed, Material, Printer};
use crate::params::frame::NamedMaterial;
use crate::printing::filament::Filament;
use crate::printing::heat::{heats, sentence, unknown};
use crate::printing::plates::{Plate, PrintSetting, PrintSettings, SlicerFamily, Wanted};

/// Nozzle of the profiles that the materials' entries name as their source, mm.
const SOURCES_NOZZLE_MM: f64 = 0.4;

/// The page; `no_room` are the parts that are wanted and lie on no plate.
pub fn markdown(design: &Design, plates: &[Plate], no_room: &[Wanted]) -> String {
    let printer = &design.frame.printer;
    let [x, y] = printer.size_mm;
    let bed = match printer.bed {
        Bed::Rectangular => format!("{x} x {y} mm"),
        Bed::Round => format!("{x} mm across"),
    };
    let mut text = format!(
        "# Printing {}\n\nLaid out for {} (bed {bed}, nozzle {} mm). Open a plate's `.3mf`, choose your own printer, print. Layers, walls, infill, \
         line widths, speeds, brim and support travel with every object, for PrusaSlicer and Orca Slicer, and for Cura what an object may have \
         there. Heat, flow and fan belong to the spool and are yours to choose. Bambu Studio's window takes parts, names, colours and places, and \
         leaves the settings of files that another program wrote: set them by the names in the tables, or open the plates in Orca. A slicer \
         that asks whether to load the project may load it: no printer and no start code is in it.\n",
        inert(&design.frame.name),
        inert(&printer.name),
        printer.nozzle_mm
    );
    if !no_room.is_empty() {
        let parts: Vec<String> = no_room.iter().map(|(part, count)| format!("{count} {part}")).collect();
        let _ = write!(text, "\n**On no plate, as the bed has no room for them: {}.** Their files are in `parts/`.\n", parts.join(", "));
    }
    compensation(&mut text, printer);
    heat(&mut text, design, plates);
    let mut seen: Vec<&str> = Vec::new();
    for plate in plates {
        let name = plate.material.name.as_str();
        if !seen.contains(&name) {
            seen.push(name);
            material(&mut text, design, plates, name);
        }
    }
    text
}

/// What the files differ in from the design: what a slicer must not do again.
fn compensation(text: &mut String, printer: &Printer) {
    let [hole_mm, foot_mm] = [printer.hole_undersize_mm, printer.elephant_foot_mm].map(|mm| mm.unwrap_or(0.0));
    if hole_mm > 0.0 {
        let _ = write!(
            text,
            "\nRound holes of the STL and 3MF files are drawn {hole_mm} mm wider, as the printer's profile says: leave the slicer's own hole compensation off.\n"
        );
    }
    if foot_mm > 0.0 {
        let _ = write!(
            text,
            "\nTheir first layer is drawn in by {foot_mm} mm, by less where less than a line of a wall would be left, up to the height of the other layers: print the first layer no higher than these, and leave the slicer's own elephant foot compensation off; the plates tell the slicer so.\n"
        );
    }
}

/// What the printer lacks of the heat of the plates' materials, and what its entry does not say.
fn heat(text: &mut String, design: &Design, plates: &[Plate]) {
    let (frame, mut open) = (&design.frame, Vec::new());
    let printed = |material: &&NamedMaterial| plates.iter().any(|plate| plate.material.name == material.name);
    for material in [&frame.flexible, &frame.rigid].into_iter().filter(printed) {
        let lacking = heats(&material.material, &frame.printer).into_iter().filter(|heat| heat.wanted > heat.has);
        for heat in lacking {
            let head = if heat.too_cold { "**This printer cannot print it**" } else { "**Watch out**" };
            // Writing to a string does not fail.
            let _ = write!(text, "\n{head}: {}.\n", inert(&sentence(design, material, &heat)));
        }
        if material.material.wants_enclosure == Some(true) && frame.printer.enclosed.is_none() {
            let or = if material.name == frame.rigid.name { "; without one, print the rigid parts from PLA (`--rigid pla`)" } else { "" };
            let _ = write!(text, "\n{} wants an enclosed printer: in open air its parts warp{or}.\n", inert(&material.name));
        }
        open.extend(unknown(&material.material, &frame.printer).into_iter().map(|of| format!("{} of {}", of.words(), material.name)));
    }
    if !open.is_empty() {
        let _ = write!(text, "\nNot compared with the printer, because an entry does not say: {}.\n", inert(&open.join(", ")));
    }
}

fn material(text: &mut String, design: &Design, plates: &[Plate], name: &str) {
    let own: Vec<&Plate> = plates.iter().filter(|plate| plate.material.name == name).collect();
    let Some(first) = own.first() else { return };
    let Some((part, _)) = first.quantities().first().copied() else { return };
    let material = &first.material.material;
    let filament = Filament::of(&design.frame.printer);
    let common = PrintSettings::of_part(first.supported.contains(&part), material, &design.frame.printer);
    // Writing to a string does not fail.
    let _ = write!(text, "\n## {}\n\n| plate | parts | time | filament | cost |\n|---|---|---:|---:|---:|\n", inert(name));
    for plate in &own {
        let parts: Vec<String> = plate.quantities().iter().map(|(part, count)| format!("{count} {part}")).collect();
        let time = plate.print_s(design).map_or("-".into(), formatted);
        let volume_mm3: f64 = plate.volume_mm3(&design.printed);
        let (mass_g, metres) = (material.printed_g(volume_mm3), filament.length_m(material.printed_mm3(volume_mm3)));
        let cost = material.cost(mass_g).map_or("-".into(), |(cost, currency)| inert(&format!("{cost:.2} {currency}")));
        let _ = writeln!(
            text,
            "| `plates/{}.3mf` | {} | {time} | {mass_g:.1} g, {metres:.2} m | {cost} |",
            inert(&plate.name()),
            parts.join(", ")
        );
    }
    let times = match own.iter().all(|plate| plate.print_s(design).is_some()) {
        true => "Times are estimates, up to 60 mm/s within 15 % of PrusaSlicer's; heating, cooling and support come on top.",
        false => "No time is known: the material states no speed_mm_s, or layers that are too high for the nozzle's lines.",
    };
    let _ = write!(text, "\n{times} Filament is that of the parts as they weigh, {} mm thick.\n", filament.diameter_mm);
    as_filled(text, material, filament, own.iter().map(|plate| plate.volume_mm3(&design.printed)).sum());
    price(text, name, material);
    if name == design.frame.flexible.name {
        text.push_str("\nDry the spool as its maker says where it lay in open air: flexible filament takes up water, which makes strings and weak layers.\n");
    }
    let all_g: f64 = own.iter().map(|plate| material.printed_g(plate.volume_mm3(&design.printed))).sum();
    if name == design.frame.flexible.name {
        flow(text, all_g);
    }
    table(text, "of the spool", &PrintSettings::of_filament(material, &design.frame.printer).0);
    table(text, "of the object", &common.0);
    plate_of_cura(text, material);
    for (plate, part) in own.iter().flat_map(|plate| plate.quantities().into_iter().map(move |(part, _)| (plate, part))) {
        let other = PrintSettings::of_part(plate.supported.contains(&part), material, &design.frame.printer);
        let differs: Vec<String> =
            other.beside(&common).iter().map(|one| format!("{} {}", one.words(), one.value(SlicerFamily::Prusa))).collect();
        if !differs.is_empty() {
            let _ = write!(text, "\n`{part}` differs: {}.\n", differs.join(", "));
        }
    }
    if let Some(source) = &material.print_source {
        let nozzle_mm = design.frame.printer.nozzle_mm;
        let scaled = if (nozzle_mm - SOURCES_NOZZLE_MM).abs() < 1e-9 {
            String::new()
        } else {
            format!(" (its figures are for a nozzle of {SOURCES_NOZZLE_MM} mm, the tables are for {nozzle_mm} mm)")
        };
        let _ = write!(text, "\nSource{scaled}: {}.\n", inert(source));
    }
}

/// What Cura has for the whole plate alone.
fn plate_of_cura(text: &mut String, material: &Material) {
    let layer = material.layer_mm.map(|mm| format!("`layer_height` {mm}"));
    let brim = match material.brim_mm {
        Some(mm) if mm > 0.0 => Some(format!("`adhesion_type` brim and `brim_width` {mm}")),
        Some(_) => Some("`adhesion_type` skirt or none".into()),
        None => None,
    };
    let stated: Vec<String> = [layer, brim].into_iter().flatten().collect();
    if !stated.is_empty() {
        let _ = write!(text, "\nCura has these for the whole plate alone, set them there: {}.\n", stated.join(", "));
    }
}

/// Where the price comes from, or how to state one.
fn price(text: &mut String, name: &str, material: &Material) {
    let _ = match (material.price_per_kg, &material.currency, &material.price_source) {
        (Some(price), Some(currency), Some(source)) => {
            writeln!(
                text,
                "\nCosts are those of the filament, at {} a kilogram ({}).",
                inert(&format!("{price:.2} {currency}")),
                inert(source)
            )
        }
        _ => writeln!(
            text,
            "\nNo price of {} is known: state `price_per_kg`, `currency` and `price_source` below `[override.materials.NAME]` of the frame file.",
            inert(name)
        ),
    };
}

/// What a printer lays that fills parts wholly, where the material's entry says that they weigh otherwise.
fn as_filled(text: &mut String, material: &Material, filament: Filament, volume_mm3: f64) {
    if (material.print_factor - 1.0).abs() < 1e-9 {
        return;
    }
    let (solid_g, metres) = (material.solid_g(volume_mm3), filament.length_m(volume_mm3));
    // Writing to a string does not fail.
    let _ = writeln!(
        text,
        "\nThe material's entry says that printed parts weigh {} of solid plastic (`print_factor`). A printer that fills them wholly takes {solid_g:.1} g, {metres:.2} m.",
        material.print_factor
    );
}

/// Flow of profiles for flexible filaments.
const FLEX_FLOW: f64 = 1.15;

fn flow(text: &mut String, all_g: f64) {
    let _ = write!(
        text,
        "\nMasses, times and bores are those of a flow of 1. PrusaSlicer's profiles of flexible filaments multiply the flow by {FLEX_FLOW} (`*FLEX*` in its \
         `PrusaResearch.ini`, 2.5), which lays {:.1} g more into the parts of this frame and makes bores tighter. PrusaSlicer has no flow of an \
         object, so set `extrusion_multiplier` of the spool to 1 there. Weigh a part: where it is as heavy as `bom.csv` says, the flow is right; \
         where your printer needs more to fill it, print the coupon at the flow that you use.\n",
        (FLEX_FLOW - 1.0) * all_g
    );
}

/// Hours and minutes.
fn formatted(seconds: f64) -> String {
    let minutes = (seconds / 60.0).round() as u64;
    format!("{} h {:02} min", minutes / 60, minutes % 60)
}

/// A table of settings with their names in each program.
fn table(text: &mut String, of: &str, settings: &[PrintSetting]) {
    let programs = SlicerFamily::ALL.map(SlicerFamily::words).join(" | ");
    let _ = write!(text, "\n| {of} | | {programs} |\n|---|---|{}\n", "---|".repeat(SlicerFamily::ALL.len()));
    for one in settings {
        let ours = one.value(SlicerFamily::Prusa);
        let otherwise = SlicerFamily::ALL.into_iter().filter(|slicer| !one.keys(*slicer).is_empty() && one.value(*slicer) != ours);
        let otherwise: Vec<String> = otherwise.map(|slicer| format!("{}: {}", slicer.words(), one.value(slicer))).collect();
        let value = if otherwise.is_empty() { ours.to_string() } else { format!("{ours} ({})", otherwise.join("; ")) };
        let _ = writeln!(text, "| {} | {value} | {} |", one.words(), SlicerFamily::ALL.map(|slicer| names(one.keys(slicer))).join(" | "));
    }
}

/// Names as code; a dash where there is none.
fn names(keys: &[&str]) -> String {
    if keys.is_empty() { "-".into() } else { keys.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", ") }
}
