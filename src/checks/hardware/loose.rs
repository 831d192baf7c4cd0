//! Rods and plugs that nothing holds in their bores, and rods that do not slide where they have to.
//!
//! Most printers make a hole narrower than it is drawn by a tenth or two, and what clearances of zero hold is held by that. A printer that states
//! `hole_undersize_mm` gets its bores drawn wider by as much, so they come out as the frame means them: then only a bore that is meant
//! to be narrower than its rod holds it. Of other printers' bores it is known that they are narrower by a tenth at least.

use super::comparison::measure;
use crate::checks::finding::{Finding, Verdict};
use crate::params::Frame;

pub(super) const GRIP: &[&str] = &["fit.grip_clearance_mm"];
pub(super) const PLUGS: &[&str] = &["fit.plug_clearance_mm"];
pub(super) const SLIDE: &[&str] = &["fit.slide_clearance_mm"];

/// Most clearance with which a bore grips its rod, mm: narrower by what a printer can place.
const GRIPS_MM: f64 = -0.01;
/// Most clearance with which a plug counts as held, mm: chosen. The real frame's plugs are as wide as their bores, and the rings hold the
/// modules, too; with more play they rattle.
const STAYS_MM: f64 = 0.1;

/// Least clearance with which a rod slides, mm: wider by what a printer can place.
const SLIDES_MM: f64 = 0.01;

/// By how much a bore is narrower than it is drawn where the printer does not state it, mm: the less of a tenth or two.
const NARROWER_MM: f64 = 0.1;

/// A warning where rods, or plugs, are loose as they are printed.
pub(super) fn rods_and_plugs(frame: &Frame) -> Vec<Finding> {
    let stated_mm = frame.printer.hole_undersize_mm.filter(|mm| *mm > 0.0);
    let narrower_mm = if stated_mm.is_some() { 0.0 } else { NARROWER_MM };
    let drawn = match stated_mm {
        Some(undersize_mm) => format!("bores are drawn {undersize_mm} mm wider for this printer and come out as they are meant"),
        None => "most printers make bores a tenth or two narrower than they are drawn, and this is more than a tenth takes up".into(),
    };
    let [grip_mm, plug_mm] = [frame.fit.grip_clearance_mm, frame.fit.plug_clearance_mm];
    let rods = format!(
        "{drawn}: with grip_clearance_mm = {grip_mm} nothing grips the rods; glue each end into corner, knee and fork, or lower grip_clearance_mm"
    );
    let plugs = format!(
        "{drawn}: with plug_clearance_mm = {plug_mm} the plugs are loose in the hub; lower plug_clearance_mm, for plugs that are glued do not let go \
         in a crash"
    );
    let slide_mm = frame.fit.slide_clearance_mm;
    let narrow = match stated_mm {
        Some(_) => "bores come out as they are meant for this printer",
        None => "most printers make bores a tenth or two narrower than they are drawn",
    };
    let slides = format!(
        "{narrow}: with slide_clearance_mm = {slide_mm} hub joint and motor mount grip the rods that have to slide in them; raise slide_clearance_mm"
    );
    let found = [
        Finding {
            verdict: Verdict::Note,
            ..measure(slide_mm, SLIDES_MM + narrower_mm, "mm", SLIDE).at_least("bores in which rods slide".into(), slides)
        },
        measure(grip_mm, GRIPS_MM + narrower_mm, "mm", GRIP).note("bores of the rods: grip".into(), rods),
        measure(plug_mm, STAYS_MM + narrower_mm, "mm", PLUGS).note("bores of the plugs: grip".into(), plugs),
    ];
    found.into_iter().filter(Finding::warns).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planted_bores_in_which_nothing_slides() {
        let (sound, _) = Frame::load("cognifly").expect("a preset");
        let of = |undersize_mm: Option<f64>, slide_mm: f64| {
            let mut frame = sound.clone();
            (frame.printer.hole_undersize_mm, frame.fit.slide_clearance_mm) = (undersize_mm, slide_mm);
            rods_and_plugs(&frame).into_iter().any(|finding| finding.subject == "bores in which rods slide")
        };
        assert_eq!([0.0, 0.1, 0.2].map(|slide_mm| of(None, slide_mm)), [true, true, false], "a tenth narrower");
        assert_eq!([0.0, 0.05].map(|slide_mm| of(Some(0.2), slide_mm)), [true, false]);
    }

    #[test]
    fn planted_bores_that_hold_nothing_where_they_print_as_drawn() {
        let (sound, _) = Frame::load("cognifly").expect("a preset");
        let of = |undersize_mm: Option<f64>, grip_mm: f64, plug_mm: f64| {
            let mut frame = sound.clone();
            frame.printer.hole_undersize_mm = undersize_mm;
            (frame.fit.grip_clearance_mm, frame.fit.plug_clearance_mm) = (grip_mm, plug_mm);
            rods_and_plugs(&frame).into_iter().map(|finding| finding.subject).collect::<Vec<_>>()
        };
        let [rods, plugs] = ["bores of the rods: grip", "bores of the plugs: grip"];
        assert_eq!(of(Some(0.2), -0.3, 0.0), Vec::<String>::new());
        assert_eq!(of(Some(0.2), -0.05, 0.1), Vec::<String>::new());
        assert_eq!(of(Some(0.2), 0.0, 0.0), [rods]);
        assert_eq!(of(Some(0.2), -0.3, 0.15), [plugs]);
        assert_eq!(of(Some(0.2), 0.1, 0.4), [rods, plugs]);
        for unknown in [None, Some(0.0)] {
            assert_eq!(of(unknown, 0.0, 0.2), Vec::<String>::new(), "a tenth narrower holds both: {unknown:?}");
            assert_eq!(of(unknown, 0.1, 0.2), [rods], "{unknown:?}");
            assert_eq!(of(unknown, 0.1, 0.4), [rods, plugs], "{unknown:?}");
        }
    }
}
