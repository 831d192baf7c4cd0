//! The screw that a motor's holes take.

use crate::params::{Frame, preset};

/// The catalogue's screw with the thread of the motor's holes that engages nearest to a diameter of it; none where the frame's own has that
/// thread, or no screw has it.
pub fn fitting_motor_screw(frame: &Frame) -> Option<String> {
    let hole_mm = frame.bought.get("motor")?.part.hole_diameter_mm?;
    let own = frame.bought.get("motor_screw")?;
    if own.part.thread_mm == Some(hole_mm) {
        return None;
    }
    let wanted_mm = frame.motor_mount.motor_plate_thickness_mm + hole_mm;
    let off = |(name, length_mm): (String, f64)| (name, (length_mm - wanted_mm).abs());
    let screws = preset::bought_parts().into_iter().filter(|(_, part)| part.thread_mm == Some(hole_mm));
    let lengths = screws.filter_map(|(name, part)| Some((name, part.length_mm.filter(|_| part.kind == own.part.kind)?)));
    lengths.map(off).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(name, _)| name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::FrameFile;

    #[test]
    fn analytic_a_motor_of_another_thread_takes_another_screw() {
        let frame = |motor: &str| {
            let text = format!("base = \"cognifly\"\nname = \"own\"\n[bought]\nmotor = \"{motor}\"\n");
            Frame::resolve(&FrameFile::parse("own.toml", &text).expect("reads")).expect("resolves")
        };
        assert_eq!(fitting_motor_screw(&frame("motor-1103-whoop")).as_deref(), Some("screw-m1-4x4"));
        assert_eq!(fitting_motor_screw(&frame("motor-1404")), None);
    }
}
