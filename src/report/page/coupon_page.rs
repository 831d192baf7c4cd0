//! What a coupon looks like, and how it is printed and read.

use std::fmt::Write;

use nalgebra::{Isometry3, Vector3};

use crate::markdown::inert;
use crate::params::Frame;
use crate::printing::coupon::{Coupon, Fit};
use crate::report::picture::image as picture;
use crate::report::picture::image::{Item, View};

/// Pixels of the picture.
const SIZE: [u32; 2] = [1200, 700];
/// Between two pieces, mm.
const ROOM_MM: f64 = 4.0;

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

/// The page.
pub fn markdown(frame: &Frame, coupon: &Coupon) -> String {
    let mut text = format!(
        "# Coupon of {}\n\nWhich clearances this printer needs, before the frame is printed. Print each piece as it lies, with the settings of the frame's \
         parts: load the `.ini` beside it in PrusaSlicer, and keep your own printer and spool.\n\n![The pieces](coupon.png)\n\n| piece | of | settings | mm3 |\n|---|---|---|---|\n",
        frame.name
    );
    // Writing to a string does not fail.
    for piece in &coupon.pieces {
        let _ =
            writeln!(text, "| `{0}.stl` | {1} | `{0}.ini` | {2:.0} |", piece.name, inert(&piece.material.name), piece.mesh.volume_mm3());
    }
    let _ = write!(
        text,
        "\nNumbers are tenths of a millimetre: 28 beside a bore is 2.8 mm. Try a piece of a {:.1} mm rod, the bar, and its round end.\n\n\
         | look for | on the coupon | say |\n|---|---|---|\n",
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
        "\nThen, with what you found:\n\n```console\nflexframe coupon {0} --read held=2.7,slides=3.2,window=0.2,plug=0.0 --into my-printer.toml\n```\n\n\
         and let every frame of this printer have `base = \"my-printer\"`. The bores of the coupon lie as those of the joints do, so that they sag alike.\n",
        frame.name
    );
    text
}
