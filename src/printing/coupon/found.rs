//! What a person found on a coupon, and what that makes of a frame's clearances.
//!
//! A rod is held in every bore that comes out narrower than it, and slides in every one that comes out wider. So the widest bore that
//! holds is drawn less than a step too narrow for the printer, the narrowest that slides less than a step too wide, and the bore that would come
//! out as wide as the rod is taken to be drawn in the middle between the two ([`undersize_mm`]). A bore that just holds a rod is no press
//! fit: the frame's bores keep the interference that they are designed with, and are drawn wider by as much as holes come out too small.

use super::gauge;
use crate::params::Frame;
use crate::params::lookup::known;
use crate::params::parameter::Parameter;

/// Clearances of rods that the frame is designed with, mm, on a printer whose holes come out as they are drawn: those of the preset
/// `cognifly`. Those of the frame at hand may hold an earlier reading already, which would count twice.
const GRIP_MM: f64 = -0.3;
const SLIDE_MM: f64 = 0.2;

/// How far apart the bores in which one rod is held and slides may be, mm: a choice, five steps of the coupon.
const MOST_APART_MM: f64 = 0.5;

/// What can be found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fit {
    /// The widest bore that holds a rod, by its diameter.
    Held,
    /// The narrowest bore in which a rod slides, by its diameter.
    Slides,
    /// The narrowest window that takes the bar, by its clearance.
    Window,
    /// The narrowest boss that takes the plug, by its clearance.
    Plug,
    /// The thickest tongue that folds back without a crack.
    Hinge,
}

impl Fit {
    /// Each of them.
    pub const ALL: [Self; 5] = [Self::Held, Self::Slides, Self::Window, Self::Plug, Self::Hinge];

    /// What it is called on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Held => "held",
            Self::Slides => "slides",
            Self::Window => "window",
            Self::Plug => "plug",
            Self::Hinge => "hinge",
        }
    }

    /// What to look for.
    pub fn words(self) -> &'static str {
        match self {
            Self::Held => "the widest bore that still holds a rod when you shake it",
            Self::Slides => "the narrowest bore in which a rod slides under its own weight",
            Self::Window => "the narrowest window that takes the bar by hand",
            Self::Plug => "the narrowest boss that takes the plug by hand and keeps it",
            Self::Hinge => "the thickest tongue that folds flat onto the row without a crack",
        }
    }

    /// The keys that it sets.
    fn sets(self) -> &'static [&'static str] {
        match self {
            Self::Held => &["fit.grip_clearance_mm"],
            Self::Slides => &["fit.slide_clearance_mm"],
            Self::Window => &["knee.knee_window_clearance_depth_mm", "knee.knee_window_clearance_height_mm"],
            Self::Plug => &["fit.plug_clearance_mm"],
            Self::Hinge => &[gauge::HINGE],
        }
    }

    /// What its keys become, mm: the number on the coupon, or for rods the design's own clearance with what holes are too small by.
    fn value_mm(self, number_mm: f64, undersize_mm: f64) -> f64 {
        match self {
            Self::Held => GRIP_MM + undersize_mm,
            Self::Slides => SLIDE_MM + undersize_mm,
            Self::Window | Self::Plug | Self::Hinge => number_mm,
        }
    }

    /// Numbers that stand on the coupon, tenths of a millimetre.
    pub fn numbers(self, frame: &Frame) -> Vec<i32> {
        match self {
            Self::Held | Self::Slides => gauge::bores_tenths(frame).collect(),
            Self::Window => gauge::WINDOWS_TENTHS.collect(),
            Self::Plug => gauge::BOSSES_TENTHS.collect(),
            Self::Hinge => gauge::tongues(frame),
        }
    }
}

/// Something found: a number of the coupon, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// What.
    pub fit: Fit,
    /// The number, mm.
    pub number_mm: f64,
}

/// Words that say nothing that could have been found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FindingError {
    /// Not `name=number`.
    #[error("`{words}` is no finding: write {}, each with the number on the coupon in mm, such as held=2.8", Fit::ALL.map(Fit::name).join(", "))]
    NoFinding {
        /// What was written.
        words: String,
    },
    /// One thing found twice.
    #[error("{name} is read twice: give one number of it")]
    Twice {
        /// What was found.
        name: &'static str,
    },
    /// A number that the coupon does not have.
    #[error("{name} = {number_mm} mm does not stand on the coupon: it has {}", .has.iter().map(|tenths| format!("{:.1}", 0.1 * f64::from(*tenths))).collect::<Vec<_>>().join(", "))]
    NotThere {
        /// What was found.
        name: &'static str,
        /// The number, mm.
        number_mm: f64,
        /// What it has, tenths of a millimetre.
        has: Vec<i32>,
    },
    /// The other of the two readings of a rod is missing.
    #[error("{name} says where a rod's diameter lies together with {missing} only: read both")]
    Alone {
        /// What was found.
        name: &'static str,
        /// What is missing.
        missing: &'static str,
    },
    /// Holes are off by more than the clearances of a frame.
    #[error(
        "held = {held_mm} and slides = {slides_mm} mm: holes come out {by_mm:.2} mm narrower than drawn, and {key} = {value:.2} is beyond its {min} to {max} mm: {}",
        if *by_mm > 0.0 { "mend the printer's flow, or state hole_undersize_mm of the printer and print the coupon again" } else { "they are too wide, so mend the printer's flow" }
    )]
    Undersize {
        /// Where a rod is held, mm.
        held_mm: f64,
        /// Where it slides, mm.
        slides_mm: f64,
        /// By how much holes are too narrow, mm.
        by_mm: f64,
        /// The parameter.
        key: &'static str,
        /// What it would be, mm.
        value: f64,
        /// Least, mm.
        min: f64,
        /// Most, mm.
        max: f64,
    },
    /// Between the two readings a rod would neither be held nor slide.
    #[error(
        "held = {held_mm} and slides = {slides_mm} mm are {:.1} mm apart, where more than {MOST_APART_MM} mm are none of one rod: `held` is the widest bore that holds it, `slides` the narrowest in which it slides",
        slides_mm - held_mm
    )]
    Apart {
        /// Where it is held, mm.
        held_mm: f64,
        /// Where it slides, mm.
        slides_mm: f64,
    },
    /// Slides in a bore that holds.
    #[error("a rod that is held in {held_mm} mm does not slide in {slides_mm} mm: try both again")]
    Contrary {
        /// Where it is held, mm.
        held_mm: f64,
        /// Where it slides, mm.
        slides_mm: f64,
    },
}

impl Found {
    /// Reads `held=2.8`.
    ///
    /// # Errors
    /// [`FindingError::NoFinding`].
    pub fn parse(words: &str) -> Result<Self, FindingError> {
        let wrong = || FindingError::NoFinding { words: words.into() };
        let (name, number) = words.split_once('=').ok_or_else(wrong)?;
        let fit = Fit::ALL.into_iter().find(|fit| fit.name() == name.trim()).ok_or_else(wrong)?;
        let number_mm = number.trim().parse().ok().filter(|number: &f64| number.is_finite()).ok_or_else(wrong)?;
        Ok(Self { fit, number_mm })
    }

    /// The parameters that everything that was found sets: key with its table, and value, mm.
    ///
    /// # Errors
    /// What does not stand on the coupon, leads beyond a parameter's bounds, or contradicts something else.
    pub fn parameters(frame: &Frame, all: &[Self]) -> Result<Vec<(&'static str, f64)>, FindingError> {
        if let Some(twice) = all.iter().enumerate().find(|(at, found)| all[..*at].iter().any(|former| former.fit == found.fit)) {
            return Err(FindingError::Twice { name: twice.1.fit.name() });
        }
        let of = |fit| all.iter().find(|found| found.fit == fit).map(|found| found.number_mm);
        if let (Some(held_mm), Some(slides_mm)) = (of(Fit::Held), of(Fit::Slides)) {
            if slides_mm <= held_mm {
                return Err(FindingError::Contrary { held_mm, slides_mm });
            }
            if slides_mm - held_mm > MOST_APART_MM + 1e-9 {
                return Err(FindingError::Apart { held_mm, slides_mm });
            }
        }
        for Self { fit, number_mm } in all {
            fit.on_coupon(*number_mm, frame)?;
        }
        let rods = match (of(Fit::Held), of(Fit::Slides)) {
            (Some(held_mm), Some(slides_mm)) => Some([held_mm, slides_mm]),
            (None, None) => None,
            (held, _) => {
                let [name, missing] = if held.is_some() { [Fit::Held, Fit::Slides] } else { [Fit::Slides, Fit::Held] }.map(Fit::name);
                return Err(FindingError::Alone { name, missing });
            }
        };
        let by_mm = rods.map_or(0.0, |rods| undersize_mm(rods, frame.rods.rod_diameter_mm));
        let mut set = Vec::new();
        for Self { fit, number_mm } in all {
            let value = (1e3 * fit.value_mm(*number_mm, by_mm)).round() / 1e3;
            for key in fit.sets() {
                // What else stands on a coupon is within its parameter's bounds.
                if let (Some(Parameter { min, max, .. }), Some([held_mm, slides_mm])) =
                    (known(key).filter(|p| !(p.min..=p.max).contains(&value)), rods)
                {
                    return Err(FindingError::Undersize { held_mm, slides_mm, by_mm, key, value, min: *min, max: *max });
                }
                set.push((*key, value));
            }
        }
        Ok(set)
    }
}

impl Fit {
    /// Lets a number pass that stands on the coupon.
    fn on_coupon(self, number_mm: f64, frame: &Frame) -> Result<(), FindingError> {
        let (tenths, has) = (gauge::tenths(number_mm), self.numbers(frame));
        if has.contains(&tenths) && (0.1 * f64::from(tenths) - number_mm).abs() <= 1e-6 {
            return Ok(());
        }
        Err(FindingError::NotThere { name: self.name(), number_mm, has })
    }
}

/// By how much holes come out narrower than they are drawn on this coupon, mm: the middle between the widest bore that holds a rod and
/// the narrowest in which it slides, less the rod's diameter. Off by half a step of the coupon, 0.05 mm, at the most, if a rod slides as soon as a bore is wider
/// than it; rods that need some play to slide make it half of that play too much.
fn undersize_mm([held_mm, slides_mm]: [f64; 2], rod_mm: f64) -> f64 {
    0.5 * (held_mm + slides_mm) - rod_mm
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::FrameFile;

    fn frame() -> Frame {
        Frame::resolve(&FrameFile::load("cognifly").expect("is a preset")).expect("resolves")
    }

    fn read(words: &str) -> Result<Vec<(&'static str, f64)>, FindingError> {
        let found: Vec<Found> = words.split(',').map(Found::parse).collect::<Result<_, _>>()?;
        Found::parameters(&frame(), &found)
    }

    #[test]
    fn analytic_findings_become_clearances() {
        assert_eq!(
            read("held=2.9,slides=3.2,window=0.1,plug=0.2,hinge=2.5").expect("reads"),
            [
                ("fit.grip_clearance_mm", -0.25),
                ("fit.slide_clearance_mm", 0.25),
                ("knee.knee_window_clearance_depth_mm", 0.1),
                ("knee.knee_window_clearance_height_mm", 0.1),
                ("fit.plug_clearance_mm", 0.2),
                ("corner.corner_hinge_thickness_mm", 2.5),
            ]
        );
        for key in Fit::ALL.iter().flat_map(|fit| fit.sets()) {
            assert!(known(key).is_some(), "{key}");
        }
        // Whatever stands on the coupon of any frame: a web is no thinner than its parameter.
        for thickness_mm in [1.5, 1.7, 2.3, 3.5] {
            let mut frame = frame();
            frame.corner.corner_hinge_thickness_mm = thickness_mm;
            for fit in [Fit::Window, Fit::Plug, Fit::Hinge] {
                assert!(!fit.numbers(&frame).is_empty());
                for number_mm in fit.numbers(&frame).into_iter().map(|tenths| 0.1 * f64::from(tenths)) {
                    for (key, value) in Found::parameters(&frame, &[Found { fit, number_mm }]).expect("stands on it") {
                        let web = known(key).expect("is known");
                        assert!((web.min..=web.max).contains(&value), "{thickness_mm} {key} {value}");
                    }
                }
            }
        }
        let fit = frame().fit;
        assert_eq!((fit.grip_clearance_mm, fit.slide_clearance_mm), (GRIP_MM, SLIDE_MM));
    }

    /// What a person reads on a coupon of a printer whose holes come out too small, and that draws bores wider by `drawn_mm`: a rod is
    /// held by what is narrower than it, and slides in what is wider by more than `play_mm`.
    fn simulated(small_mm: f64, drawn_mm: f64, play_mm: f64) -> Result<Vec<(&'static str, f64)>, FindingError> {
        let frame = frame();
        let rod_mm = frame.rods.rod_diameter_mm;
        let bores = || gauge::bores_tenths(&frame).map(|tenths| 0.1 * f64::from(tenths));
        let room_mm = |bore_mm: &f64| bore_mm + drawn_mm - small_mm - rod_mm;
        let held = bores().filter(|bore| room_mm(bore) < -1e-9).last().expect("one holds");
        let slides = bores().find(|bore| room_mm(bore) > play_mm + 1e-9).expect("one is wide enough");
        read(&format!("held={held:.1},slides={slides:.1}"))
    }

    /// Read from the coupon or stated as `hole_undersize_mm`, printed bores have the design's interference, to half a step of the coupon.
    #[test]
    fn planted_holes_too_small_leave_the_design_s_interference() {
        for small_mm in [0.0, 0.1, 0.15, 0.3] {
            for (play_mm, off_mm) in [(0.0, 0.051), (0.06, 0.1)] {
                // The second way: the coupon is drawn wider, too, and finds nothing that is left.
                for drawn_mm in [0.0, small_mm] {
                    let Ok(set) = simulated(small_mm, drawn_mm, play_mm) else {
                        // Rods with play ask for more than the most clearance of a sliding bore.
                        assert!(play_mm > 0.0 && small_mm == 0.3 && drawn_mm == 0.0);
                        continue;
                    };
                    let printed = set.iter().map(|(key, clearance_mm)| (*key, clearance_mm + drawn_mm - small_mm));
                    for ((key, printed_mm), wanted_mm) in printed.zip([GRIP_MM, SLIDE_MM]) {
                        assert!((printed_mm - wanted_mm).abs() < off_mm, "{small_mm} {drawn_mm} {play_mm} {key}: {printed_mm}");
                    }
                }
            }
        }
    }

    #[test]
    fn analytic_what_cannot_have_been_found_is_refused() {
        for words in ["held", "hold=2.8", "held=wide", "held=NaN"] {
            assert!(matches!(read(words), Err(FindingError::NoFinding { .. })), "{words}");
        }
        for words in ["held=2.85", "held=28", "plug=-0.1", "window=0.4", "hinge=1.0"] {
            assert!(matches!(read(words), Err(FindingError::NotThere { .. })), "{words}");
        }
        for (words, said) in [("held=2.8", "together with slides only"), ("slides=3.1", "together with held only")] {
            let error = read(words).expect_err("is half of it");
            assert!(matches!(error, FindingError::Alone { .. }) && error.to_string().contains(said), "{error}");
        }
        let error = read("held=3.3,slides=3.4").expect_err("is beyond");
        assert!(matches!(error, FindingError::Undersize { key: "fit.slide_clearance_mm", .. }), "{error}");
        assert!(error.to_string().contains("0.35 mm narrower than drawn") && error.to_string().contains("hole_undersize_mm"), "{error}");
        let error = read("held=2.5,slides=2.8").expect_err("is beyond");
        assert!(error.to_string().contains("too wide, so mend"), "{error}");
        assert!(matches!(read("held=3.1,slides=3.0"), Err(FindingError::Contrary { .. })));
        assert!(matches!(read("held=2.5,slides=3.1"), Err(FindingError::Apart { .. })));
    }
}
