//! Pictures of a frame that is bent: pressed down, in a mode, in an impact.

use nalgebra::Isometry3;

use crate::frame::assembly::Design;
use crate::mechanics::result::deformed::DeformedBody;
use crate::report::picture::image as picture;
use crate::report::picture::image::{Item, View};

/// Width and height, pixels.
const SIZE: [u32; 2] = [1024, 768];

/// A picture of bent bodies, in the colours of the design.
pub fn picture(design: &Design, bodies: &[DeformedBody], view: View) -> Vec<u8> {
    let item = |bent: &'_ DeformedBody| design.shape(&design.bodies[bent.body]).colour;
    let items: Vec<Item> = bodies.iter().map(|bent| Item { mesh: &bent.mesh, pose: Isometry3::identity(), colour: item(bent) }).collect();
    picture::png(&items, view, SIZE[0], SIZE[1])
}
