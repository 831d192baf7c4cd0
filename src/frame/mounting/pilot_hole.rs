//! Holes in printed parts in which screws form their own thread.
//!
//! **Sources.** Pencom, "Installation of PF Screws for Plastics" (pencomsf.com): bosses moulded of ABS have holes of 0.80 of the thread's
//! diameter, of ASA 0.78. The maker cheatsheet of G. Saunier (github.com/gregsaun/maker_cheatsheet, `3d_printing/sizes_petg.md`): for metric
//! screws in printed PETG 1.7 mm for M2 and 2.7 mm for M3, 0.85 and 0.90. The real frame's hub has holes of 1.9 mm for M2, 0.95, as
//! drawn.
//!
//! The least is that of the sources, and that at which a metric nut's thread is complete (ISO 68-1: 0.78 of M2, 0.82 of M3): a narrower
//! hole holds no better and splits. At the most an eighth of a metric thread's depth is left, and holes print narrower than they are
//! drawn by some 0.1 mm.
//!
//! **When it is wrong.** Coarse threads for plastics and for wood are deeper than metric ones and hold in wider holes. Where the printer states
//! `hole_undersize_mm`, holes are as wide as they are drawn: then the middle of the range is the safe choice, not its wide end.

/// Least and most width of the hole, as shares of the thread's diameter.
const SHARES: [f64; 2] = [0.78, 0.975];

/// A width that misses the range by no more is within it, mm: the checks compare lengths so far, and no printer places less.
const ROUNDING_MM: f64 = 0.005;

/// Least and most width of a hole in which a thread of a diameter holds and does not split it, mm.
pub fn holds_mm(thread_mm: f64) -> [f64; 2] {
    SHARES.map(|share| share * thread_mm)
}

/// Whether a thread holds in a hole, mm both.
pub fn is_held(thread_mm: f64, hole_mm: f64) -> bool {
    let [least, most] = holds_mm(thread_mm);
    (least - ROUNDING_MM..=most + ROUNDING_MM).contains(&hole_mm)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_usual_pilot_holes_hold_and_holes_as_wide_as_the_screw_do_not() {
        let held = [(2.0, 1.6), (2.0, 1.7), (2.0, 1.9), (2.5, 2.1), (3.0, 2.5), (3.0, 2.7), (3.0, 2.9)];
        let not = [(2.0, 1.5), (2.0, 2.0), (2.0, 2.1), (2.5, 2.5), (3.0, 2.3), (3.0, 3.0)];
        for (thread_mm, hole_mm) in held {
            assert!(is_held(thread_mm, hole_mm), "M{thread_mm} in {hole_mm} mm");
        }
        for (thread_mm, hole_mm) in not {
            assert!(!is_held(thread_mm, hole_mm), "M{thread_mm} in {hole_mm} mm");
        }
    }
}
