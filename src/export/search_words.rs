//! What to type into a shop's search for a bought part: from the catalogue's own figures and name, no maker and no shop. Of a battery it is the
//! room that the frame has for it.

use crate::params::catalogue::BoughtPart;

/// Millimetres of an inch.
const INCH_MM: f64 = 25.4;

/// Thread, head diameter and head height of socket head screws, mm (engineeringhardware.com, *Socket Head Cap Screws (ISO 4762 / DIN
/// 912)*, size table). A screw with another head is not called one.
const SOCKET_HEADS_MM: [[f64; 3]; 7] =
    [[1.4, 2.6, 1.4], [1.6, 3.0, 1.6], [2.0, 3.8, 2.0], [2.5, 4.5, 2.5], [3.0, 5.5, 3.0], [4.0, 7.0, 4.0], [5.0, 8.5, 5.0]];

/// Instead of the role of a motor controller that has no flight controller beside it: it is both.
pub const ALL_IN_ONE: &str = "all_in_one";

/// The words for a part in a role, by its name in the catalogue.
pub fn search_words(role: &str, name: &str, part: &BoughtPart) -> String {
    let own = own_name(&part.kind, name);
    let [x, y, z] = part.size_mm;
    match part.kind.as_str() {
        "motor" => motor(&own, part),
        "propeller" => {
            let across = part.diameter_mm.unwrap_or(x);
            format!("propeller {:.1} inch {across:.0} mm", across / INCH_MM)
        }
        "battery" => {
            let cells = part.cells.map_or(String::new(), |cells| format!(" {cells}S"));
            let capacity = part.capacity_mah.map_or(String::new(), |mah| format!(" {mah:.0} mAh"));
            format!("battery pack{cells}{capacity} at most {x} x {y} x {z} mm")
        }
        "board" => board(role, &own, part),
        "rod" => rod(part),
        "magnet" => format!("neodymium block magnet {x} x {y} x {z} mm"),
        "connector" => format!("{} connector pair", own.to_uppercase()),
        "screw" => screw(&own, part),
        "other" => match part.strap_mm {
            Some([width, _]) => format!("cable tie {width} x {x:.0} mm"),
            None => format!("{own} {x} x {y} x {z} mm"),
        },
        "receiver" => format!("radio receiver {own} serial output"),
        "buzzer" => format!("active buzzer 5 V {own}"),
        "gps" => format!("GPS module serial {own}"),
        "fpv_camera" => format!("FPV camera {x:.0} mm wide"),
        _ => own,
    }
}

/// A catalogue's name without its kind, as words.
fn own_name(kind: &str, name: &str) -> String {
    let short = name.strip_prefix(kind).map_or(name, |rest| rest.trim_start_matches('-'));
    short.replace(['-', '_'], " ")
}

fn motor(own: &str, part: &BoughtPart) -> String {
    let mut words = format!("brushless motor {own}");
    if let (Some(circle), Some(thread)) = (part.hole_pcd_mm, part.hole_diameter_mm) {
        words += &format!(" {} x M{thread} on {circle} mm", part.motor_holes());
    }
    words + &part.shaft_diameter_mm.map_or(String::new(), |shaft| format!(" shaft {shaft} mm"))
}

fn board(role: &str, own: &str, part: &BoughtPart) -> String {
    let pattern = part.hole_pattern_mm.map_or(String::new(), |[along, across]| format!(" {along}x{across} mm"));
    match role {
        "flight_controller" => format!("flight controller{pattern}"),
        "motor_controller" => format!("4 in 1 ESC motor controller{pattern}"),
        ALL_IN_ONE => format!("AIO flight controller with 4 in 1 ESC{pattern}"),
        _ => own.into(),
    }
}

fn rod(part: &BoughtPart) -> String {
    let across = part.diameter_mm.unwrap_or(part.size_mm[1]);
    let long = part.stock_mm();
    let of = part.material.as_deref().unwrap_or_default();
    match part.wall_mm {
        Some(wall) => format!("{of} tube {across} x {} mm {long:.0} mm", across - 2.0 * wall).trim_start().into(),
        None => format!("{of} rod {across} mm {long:.0} mm").trim_start().into(),
    }
}

fn screw(own: &str, part: &BoughtPart) -> String {
    let (Some(thread), Some(length)) = (part.thread_mm, part.length_mm) else { return format!("screw {own}") };
    let head = [thread, part.head_diameter_mm.unwrap_or(0.0), part.head_height_mm.unwrap_or(0.0)];
    let same = |known: &[f64; 3]| known.iter().zip(head).all(|(a, b)| (a - b).abs() < 1e-6);
    match part.head_diameter_mm.zip(part.head_height_mm) {
        Some(_) if SOCKET_HEADS_MM.iter().any(same) => format!("M{thread}x{length} socket head screw DIN 912"),
        Some((wide, high)) => format!("M{thread}x{length} screw head {wide} x {high} mm"),
        None => format!("M{thread}x{length} screw"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::{Frame, FrameFile};

    fn words(role: &str, change: impl Fn(&mut BoughtPart)) -> String {
        let frame = Frame::resolve(&FrameFile::load("cognifly").expect("is a preset")).expect("resolves");
        let item = &frame.bought[role];
        let mut part = item.part.clone();
        change(&mut part);
        search_words(role, &item.name, &part)
    }

    #[test]
    fn analytic_words_follow_the_catalogues_figures() {
        let as_it_is = |role: &str| words(role, |_| ());
        for (role, said) in [
            ("motor", "brushless motor 1104 4 x M2 on 9 mm shaft 1.5 mm"),
            ("propeller", "propeller 3.0 inch 76 mm"),
            ("battery", "battery pack 3S 650 mAh at most 58 x 31 x 16 mm"),
            ("rod", "carbon rod 3 mm 1000 mm"),
            ("computer", "pi zero w"),
            ("flight_controller", "flight controller 20x20 mm"),
            ("motor_controller", "4 in 1 ESC motor controller 20x20 mm"),
            ("camera", "pi camera v2"),
            ("connector", "XT30 connector pair"),
            ("magnet", "neodymium block magnet 10 x 5 x 3 mm"),
            ("motor_screw", "M2x4 socket head screw DIN 912"),
            ("tie", "cable tie 2.5 x 100 mm"),
            ("damper", "damper m2 5 x 5 x 6.6 mm"),
        ] {
            assert_eq!(as_it_is(role), said);
        }
    }

    #[test]
    fn analytic_a_board_that_is_both_controllers_is_called_so() {
        let frame = Frame::resolve(&FrameFile::load("cognifly").expect("is a preset")).expect("resolves");
        let item = &frame.bought["motor_controller"];
        let mut part = item.part.clone();
        part.hole_pattern_mm = Some([25.5, 25.5]);
        assert_eq!(search_words(ALL_IN_ONE, &item.name, &part), "AIO flight controller with 4 in 1 ESC 25.5x25.5 mm");
    }

    #[test]
    fn planted_another_head_is_not_called_a_socket_head() {
        assert_eq!(words("motor_screw", |part| part.head_height_mm = Some(1.2)), "M2x4 screw head 3.8 x 1.2 mm");
        assert_eq!(words("motor_screw", |part| part.head_height_mm = None), "M2x4 screw");
        assert_eq!(words("rod", |part| part.wall_mm = Some(0.5)), "carbon tube 3 x 2 mm 1000 mm");
    }
}
