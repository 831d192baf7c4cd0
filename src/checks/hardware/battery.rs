//! The battery of the bill of materials goes into the sleeve that is made for it.

use super::comparison::{measure, name, part};
use crate::checks::finding::Finding;
use crate::params::Frame;

pub(super) const LENGTH: &[&str] = &["battery.battery_length_mm", "bought.battery"];
pub(super) const WIDTH: &[&str] = &["battery.battery_width_mm", "bought.battery"];
pub(super) const HEIGHT: &[&str] = &["battery.battery_height_mm", "bought.battery"];

/// A stated size is that of the battery or more, as for a pack that swells. Where none is stated there is nothing to compare.
pub(super) fn sizes(frame: &Frame) -> Vec<Finding> {
    let Some(bought) = part(frame, "battery") else { return Vec::new() };
    let called = name(frame, "battery");
    let b = &frame.battery;
    let stated = [("long", b.battery_length_mm, LENGTH), ("wide", b.battery_width_mm, WIDTH), ("high", b.battery_height_mm, HEIGHT)];
    let [long_mm, wide_mm, high_mm] = bought.size_mm;
    // A pack may lie on its side.
    let on_its_side = (b.battery_width_mm < b.battery_height_mm) != (wide_mm < high_mm);
    let lies_mm = if on_its_side { [long_mm, high_mm, wide_mm] } else { [long_mm, wide_mm, high_mm] };
    let other = stated.into_iter().zip(lies_mm).filter(|((_, stated_mm, _), bought_mm)| stated_mm != bought_mm);
    let finding = |((way, stated_mm, levers), bought_mm): ((&str, f64, &'static [&'static str]), f64)| {
        let size = measure(stated_mm, bought_mm, "mm", levers);
        let [room, needed] = size.figures(1);
        let message = format!(
            "sleeve and lid are made for a battery that is {room} mm {way}, {called} in the bill of materials is {needed} mm {way}"
        );
        size.at_least(format!("battery: how {way}"), message)
    };
    other.map(finding).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::finding::Verdict;

    #[test]
    fn planted_a_sleeve_that_is_too_small_for_its_battery() {
        let (sound, _) = Frame::load("cognifly").expect("a preset");
        let of = |size_mm: [f64; 3]| {
            let mut frame = sound.clone();
            let battery = &mut frame.battery;
            [battery.battery_length_mm, battery.battery_width_mm, battery.battery_height_mm] = size_mm;
            sizes(&frame).into_iter().map(|found| (found.subject, found.verdict)).collect::<Vec<_>>()
        };
        assert_eq!(of([58.0, 31.0, 16.0]), []);
        assert_eq!(of([58.0, 16.0, 31.0]), [], "a pack on its side");
        assert_eq!(of([58.0, 31.0, 17.0]), [("battery: how high".to_string(), Verdict::Holds)], "a pack that swells");
        let small = of([45.0, 25.0, 12.0]);
        assert!(small.len() == 3 && small.iter().all(|(_, verdict)| *verdict == Verdict::Violated), "{small:?}");
    }
}
