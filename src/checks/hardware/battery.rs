//! The battery of the bill of materials goes into the sleeve that is made for it.

use super::comparison::{measure, name};
use crate::checks::finding::Finding;
use crate::params::Frame;

pub(super) const LENGTH: &[&str] = &["battery.battery_length_mm", "bought.battery"];
pub(super) const WIDTH: &[&str] = &["battery.battery_width_mm", "bought.battery"];
pub(super) const HEIGHT: &[&str] = &["battery.battery_height_mm", "bought.battery"];

/// Room across beyond a pack, mm: a choice, for a pack that swells and for a pad of foam.
const LOOSE_MM: f64 = 3.0;

/// A stated size is that of the battery or more, as for a pack that swells, and across not much more; along the sleeve a warning tells of more. Where
/// none is stated there is nothing to compare.
pub(super) fn sizes(frame: &Frame) -> Vec<Finding> {
    let Some(lies_mm) = frame.battery_as_it_lies_mm() else { return Vec::new() };
    let called = name(frame, "battery");
    let b = &frame.battery;
    let stated = [("long", b.battery_length_mm, LENGTH), ("wide", b.battery_width_mm, WIDTH), ("high", b.battery_height_mm, HEIGHT)];
    let other = stated.into_iter().zip(lies_mm).filter(|((_, stated_mm, _), bought_mm)| stated_mm != bought_mm);
    let findings = |((way, stated_mm, levers), bought_mm): ((&str, f64, &'static [&'static str]), f64)| {
        let size = measure(stated_mm, bought_mm, "mm", levers);
        let [room, needed] = size.figures(1);
        let message = format!(
            "sleeve and lid are made for a battery that is {room} mm {way}, {called} in the bill of materials is {needed} mm {way}"
        );
        let loose = measure(stated_mm - bought_mm, LOOSE_MM, "mm", levers);
        let [more, most] = loose.figures(1);
        let rattles = format!(
            "sleeve and lid are made for a battery that is {more} mm more than {called} is {way}; beyond {most} mm it rattles and hits their walls"
        );
        let subject = format!("battery: how {way}, loose");
        // Along the sleeve the tape between pack and lid holds it.
        let loose = if levers != LENGTH {
            Some(loose.at_most(subject, rattles))
        } else {
            (loose.value > LOOSE_MM)
                .then(|| loose.note(subject, format!("{called} leaves {more} mm of its space empty, and nothing but tape holds it there")))
        };
        [Some(size.at_least(format!("battery: how {way}"), message)), loose].into_iter().flatten()
    };
    other.flat_map(findings).collect()
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
        let holds = |subject: &str| (subject.to_string(), Verdict::Holds);
        let violated = |subject: &str| (subject.to_string(), Verdict::Violated);
        assert_eq!(of([58.0, 31.0, 17.0]), [holds("battery: how high"), holds("battery: how high, loose")], "a pack that swells");
        assert_eq!(of([58.0, 31.0, 20.0]), [holds("battery: how high"), violated("battery: how high, loose")]);
        assert_eq!(of([60.0, 31.0, 16.0]), [holds("battery: how long")]);
        assert_eq!(of([90.0, 31.0, 16.0]), [holds("battery: how long"), ("battery: how long, loose".into(), Verdict::Note)]);
        // Too narrow for the pack as it is bought, and not made for one on its side.
        assert_eq!(of([58.0, 15.0, 16.0])[0], violated("battery: how wide"));
        let small = of([45.0, 25.0, 12.0]);
        assert_eq!(small.iter().filter(|(_, verdict)| *verdict == Verdict::Violated).count(), 3, "{small:?}");
    }
}
