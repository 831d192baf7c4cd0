//! What a coupon looks like, and how it is printed and read.

use std::fmt::Write;

use nalgebra::{Isometry3, Vector3};

use crate::export::three_mf::{self, Contents, Object};
use crate::figures::decimals;
use crate::markdown::inert;
use crate::params::Frame;
use crate::params::catalogue::Printer;
use crate::printing::coupon::{Coupon, CouponPlate, FOLDS, Fit, Hinges, Piece};
use crate::printing::plates::{PrintSettings, short};
use crate::report::picture::image as picture;
use crate::report::picture::image::{Bed, Item, View};
use crate::report::picture::plate_picture;

/// Pixels of the picture.
const SIZE: [u32; 2] = [1200, 700];
/// Pixels of the picture within a plate's file.
const PLATE_SIZE: [u32; 2] = [480, 360];
/// Between two pieces, mm.
const ROOM_MM: f64 = 10.0;

/// All pieces behind each other.
pub fn picture(coupon: &Coupon) -> Vec<u8> {
    let mut y = 0.0;
    let mut items = Vec::new();
    for piece in &coupon.pieces {
        let [low, high] = piece.mesh.bounds_mm();
        // The numbers are in front, towards the one who looks from behind the origin.
        let turned = Isometry3::rotation(std::f64::consts::PI * Vector3::z());
        let pose = Isometry3::translation(high[0], y + high[1], 0.0) * turned;
        items.push(Item { mesh: &piece.mesh, pose, colour: piece.material.material.colour });
        y += high[1] - low[1] + ROOM_MM;
    }
    picture::png(&items, View::Perspective, SIZE[0], SIZE[1])
}

/// What the files of plates are called, by their materials; two grades of one material have one name, and the second a number.
pub fn plate_files(plates: &[CouponPlate]) -> Vec<String> {
    let names = plates.iter().map(|plate| short(&plate.material.name));
    let mut seen: Vec<String> = Vec::new();
    names
        .map(|name| {
            seen.push(name.clone());
            match seen.iter().filter(|other| **other == name).count() {
                1 => format!("plate_{name}.3mf"),
                count => format!("plate_{name}_{count}.3mf"),
            }
        })
        .collect()
}

/// A plate as the bytes of a 3MF file.
///
/// # Errors
/// When the archive cannot be made; it is made in memory.
pub fn plate(frame: &Frame, plate: &CouponPlate) -> std::io::Result<Vec<u8>> {
    let (printer, material) = (&frame.printer, plate.material);
    let settings = PrintSettings::of_part(false, &material.material, printer);
    let contents = Contents {
        title: format!("coupon of {} {}", frame.name, short(&material.name)),
        printer,
        material,
        objects: plate
            .placed
            .iter()
            .map(|(piece, pose)| Object { name: &piece.name, mesh: &piece.mesh, poses: vec![*pose], settings: settings.clone() })
            .collect(),
    };
    let moved = plate_picture::from_corner(printer);
    let colour = material.material.colour;
    let items: Vec<Item> = plate.placed.iter().map(|(piece, pose)| Item { mesh: &piece.mesh, pose: moved * pose, colour }).collect();
    let thumbnail = picture::png_on_bed(&items, &Bed::of(printer), View::Perspective, PLATE_SIZE[0], PLATE_SIZE[1]);
    three_mf::archive(&contents, &thumbnail)
}

/// The table that a person fills in.
pub fn fold_table(hinges: &Hinges) -> String {
    let mut text = String::from("thickness_mm,fold_deg,folds\n");
    for thickness_mm in hinges.thicknesses_mm {
        let _ = writeln!(text, "{thickness_mm:.1},{:.0},", hinges.fold_deg);
    }
    text
}

/// Stands in a command for the page's own folder: where that is written to does not change what is written.
const FOLDER: &str = "FOLDER";

/// The table of folded hinges in the folder.
pub const FOLD_TABLE: &str = "hinges.csv";

/// A word of a command, in quotes where a shell would take it apart.
fn word(text: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "-_./+:@%".contains(c);
    if text.chars().all(is_plain) { text.into() } else { format!("'{}'", text.replace('\'', "'\\''")) }
}

/// Which pieces lie on no plate, in a sentence without full stop.
pub fn without_room(pieces: &[&Piece], printer: &Printer) -> String {
    let of = |piece: &&Piece| {
        let [x, y, z] = piece.mesh.size_mm().map(|mm| decimals(mm, 0));
        format!("{}.stl ({x} x {y} x {z} mm)", piece.name)
    };
    let all: Vec<String> = pieces.iter().map(of).collect();
    let them = if all.len() == 1 { "it" } else { "them" };
    format!("{}: on no plate, as the bed of {} has no room for {them}: print {them} on a larger one", all.join(", "), printer.name)
}

/// The page; its commands name the frame as it was given.
pub fn markdown(frame: &Frame, coupon: &Coupon, no_room: &[&Piece], given: &str) -> String {
    let mut text = format!(
        "# Coupon of {}\n\nWhich clearances this printer needs, before the frame is printed. Print each piece as it lies, with the settings of the frame's \
         parts: open the `plate_` of each material, or load the `.ini` beside a piece in PrusaSlicer, and keep your own printer and spool.\n\n![The pieces](coupon.png)\n\n| piece | of | settings | mm3 |\n|---|---|---|---|\n",
        frame.name
    );
    // Writing to a string does not fail.
    for piece in &coupon.pieces {
        let _ =
            writeln!(text, "| `{0}.stl` | {1} | `{0}.ini` | {2:.0} |", piece.name, inert(&piece.material.name), piece.mesh.volume_mm3());
    }
    if !no_room.is_empty() {
        let _ = write!(text, "\n**{}.**\n", inert(&without_room(no_room, &frame.printer)));
    }
    let _ = write!(
        text,
        "\nNumbers are tenths of a millimetre: {0} beside a bore is {1:.1} mm. Try a piece of a {2:.1} mm rod, the bar, and its round end.\n\n\
         | look for | on the coupon | say |\n|---|---|---|\n",
        libm::round(10.0 * example_mm(frame, Fit::Held)),
        example_mm(frame, Fit::Held),
        frame.rods.rod_diameter_mm
    );
    for fit in Fit::ALL {
        let numbers = fit.numbers(frame);
        let formatted = |tenths: Option<&i32>| tenths.map_or(String::new(), |tenths| format!("{:.1}", 0.1 * f64::from(*tenths)));
        let (least, most) = (formatted(numbers.iter().min()), formatted(numbers.iter().max()));
        let _ = writeln!(text, "| {} | {least} to {most} | `{}=` |", fit.words(), fit.name());
    }
    let _ = write!(
        text,
        "\nThen, with what you found:\n\n```console\nflexframe coupon {0} --read held={1:.1},slides={2:.1},window=0.2,plug=0.0 --into my-printer.toml\n```\n\n\
         `my-printer.toml` is then this frame with these clearances. Where the frame is a file of your own, name that file behind `--into` instead: it \
         takes the clearances and keeps all else. `held=` and `slides=` are read together: the middle between them is the bore that comes out as wide as \
         the rod, and the frame keeps the grip of its design. The bores of the coupon lie as those of the joints do, so that they sag alike.\n",
        word(given),
        example_mm(frame, Fit::Held),
        example_mm(frame, Fit::Slides)
    );
    let tongue = " `hinge=` sets the thickness of the corners' webs. A tongue folds back on itself, which a thin one bears more easily; a web folds only as \
                  far as its rods ask, and a thinner web is then stretched over a shorter length, so that its strain by the rule `hinge_strain` is larger. \
                  Read the tongues to learn whether the print splits between its layers; what strain a web bears is found with the hinges below.\n";
    text.push('\n');
    text.push_str(tongue.trim_start());
    hinges(&mut text, frame, &coupon.hinges, given);
    text
}

/// A number that stands on the coupon beside a bore, mm: one of the narrow ones where a rod is held, one of the wide ones where it slides.
fn example_mm(frame: &Frame, fit: Fit) -> f64 {
    let numbers = fit.numbers(frame);
    let quarters = if fit == Fit::Slides { 3 } else { 1 };
    numbers.get(quarters * numbers.len() / 4).map_or(0.0, |tenths| 0.1 * f64::from(*tenths))
}

fn hinges(text: &mut String, frame: &Frame, hinges: &Hinges, given: &str) {
    let _ = write!(
        text,
        "\n## Hinges\n\nWhat strain this filament bears, printed on this printer: three hinges of the corners' own section, the middle one as thick as \
         the frame's. Their numbers are tenths of a millimetre, too. Print them as they lie, so that the layers lie along the bend.\n\n\
         1. Wait a day after printing. Fold at room temperature.\n\
         2. Hold a piece by its ends, the notch up. Fold it until the notch's faces touch: that is {fold:.0}°, the frame's largest fold. Unfold it flat. \
         One fold takes about two seconds.\n\
         3. Look at the outer side of the web every ten folds, with a light behind it. A line across the web that opens is a crack. White \
         marks and a web that stays bent are not.\n\
         4. Write into `{FOLD_TABLE}`, column `folds`: after how many folds it cracked, or `held` where it held {FOLDS}.\n\n\
         | piece | web | fold | strain | folds until it cracked, or `held` |\n|---|---:|---:|---:|---|\n",
        fold = hinges.fold_deg
    );
    for (thickness_mm, strain) in hinges.thicknesses_mm.iter().zip(hinges.strains_percent(frame)) {
        let number = Hinges::number(*thickness_mm);
        let _ = writeln!(text, "| `hinge-{number:02}.stl` | {thickness_mm:.1} mm | {:.0}° | {strain:.0} % | |", hinges.fold_deg);
    }
    let _ = write!(
        text,
        "\n```console\nflexframe coupon {} --read {FOLDER}/{FOLD_TABLE} --into my-printer.toml\n```\n\n{FOLDER} is that of this page. \
         The largest strain that held becomes the limit of the rule `hinge_strain`: `hinge_strain_factor` is set to the material's elongation at break over it. \
         A thinner web that holds while a thicker one cracks is refused: two pieces were mixed up, or one has a flaw. What the figure is \
         worth: one sample of each web, one direction of layers, one day. It knows no scatter, no cold, and no weeks under strain.\n",
        word(given)
    );
}
