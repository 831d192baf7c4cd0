//! Our parts as they are exported, laid back into their own axes.

use std::sync::LazyLock;

use flexframe::export::stl;
use flexframe::frame::assembly::Printed;
use flexframe::frame::skeleton::{Centre, Skeleton};
use flexframe::memo::Memo;
use flexframe::params::{Frame, PartName};
use flexframe::solid::Mesh;
use nalgebra::{Isometry3, Translation3};

use super::figures::RealPart;
use super::scan;

/// Our part that corresponds to a real one, of the preset `cognifly-v8`.
///
/// # Panics
/// When it cannot be made.
pub fn printed(real: &RealPart) -> Printed {
    let mut frame = Frame::load("cognifly-v8").expect("the preset is valid").0;
    frame.motor_mount.motor_riser_mm = real.riser_mm;
    made(real.part, &frame)
}

/// What was made before: most measurements look at the same parts.
static MADE: LazyLock<Memo> = LazyLock::new(Memo::default);

/// A part of a frame.
///
/// # Panics
/// When it cannot be made.
pub fn made(part: PartName, frame: &Frame) -> Printed {
    let skeleton = Skeleton::new(frame).expect("the frame closes");
    Printed::make(part, frame, &skeleton, &Centre::new(frame), &MADE).expect("the part can be made")
}

/// What the written STL file holds, read back and turned from the print bed into the part's own axes.
///
/// # Panics
/// When it cannot be written or read.
pub fn exported(part: &Printed) -> Mesh {
    let bytes = stl::binary(&part.mesh).expect("memory takes it");
    scan::read(std::io::Cursor::new(bytes), &on_bed(part).inverse())
}

/// From the part's own axes to where it lies on the print bed.
pub fn on_bed(part: &Printed) -> Isometry3<f64> {
    let laid = Isometry3::from_parts(Translation3::identity(), (part.part.print_turn)());
    Isometry3::translation(0.0, 0.0, -part.flat.placed(&laid).bounds_mm()[0][2]) * laid
}
