//! What a person found on a coupon, and what that makes of a frame's clearances.

use super::gauge;
use crate::params::parameter::Parameter;
use crate::params::{Frame, parameters};

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

    /// The keys that it sets, and what is added to the number on the coupon, mm.
    fn sets(self, frame: &Frame) -> (&'static [&'static str], f64) {
        match self {
            Self::Held => (&["fit.grip_clearance_mm"], -frame.rods.rod_diameter_mm),
            Self::Slides => (&["fit.slide_clearance_mm"], -frame.rods.rod_diameter_mm),
            Self::Window => (&["knee.knee_window_clearance_depth_mm", "knee.knee_window_clearance_height_mm"], 0.0),
            Self::Plug => (&["fit.plug_clearance_mm"], 0.0),
            Self::Hinge => (&["corner.corner_hinge_thickness_mm"], 0.0),
        }
    }

    /// Numbers that stand on the coupon, tenths of a millimetre.
    pub fn numbers(self, frame: &Frame) -> Vec<i32> {
        match self {
            Self::Held | Self::Slides => gauge::bores_tenths(frame).collect(),
            Self::Window => gauge::WINDOWS_TENTHS.collect(),
            Self::Plug => gauge::BOSSES_TENTHS.collect(),
            Self::Hinge => gauge::tongues(frame).to_vec(),
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
    /// What follows is no frame any more.
    #[error(
        "{name} = {number_mm} mm asks for {key} = {value:.1}, beyond its {min} to {max} mm: this printer's bores are off by more than a clearance should make good, so mend its flow or its hole compensation first"
    )]
    Beyond {
        /// What was found.
        name: &'static str,
        /// The number, mm.
        number_mm: f64,
        /// The parameter.
        key: &'static str,
        /// What it would be, mm.
        value: f64,
        /// Least, mm.
        min: f64,
        /// Most, mm.
        max: f64,
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
        if let (Some(held_mm), Some(slides_mm)) = (of(Fit::Held), of(Fit::Slides))
            && slides_mm <= held_mm
        {
            return Err(FindingError::Contrary { held_mm, slides_mm });
        }
        let mut set = Vec::new();
        for Self { fit, number_mm } in all {
            let (name, number_mm, has) = (fit.name(), *number_mm, fit.numbers(frame));
            let tenths = gauge::tenths(number_mm);
            if !has.contains(&tenths) || (0.1 * f64::from(tenths) - number_mm).abs() > 1e-6 {
                return Err(FindingError::NotThere { name, number_mm, has });
            }
            let (keys, added) = fit.sets(frame);
            for key in keys {
                let value = (1e3 * (number_mm + added)).round() / 1e3;
                if let Some(Parameter { min, max, .. }) = parameter(key).filter(|p| !(p.min..=p.max).contains(&value)) {
                    return Err(FindingError::Beyond { name, number_mm, key, value, min: *min, max: *max });
                }
                set.push((*key, value));
            }
        }
        Ok(set)
    }
}

fn parameter(key: &str) -> Option<&'static Parameter> {
    parameters().find(|p| key == format!("{}.{}", p.table, p.key))
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
            read("held=2.8,slides=3.2,window=0.1,plug=0.2,hinge=2.5").expect("reads"),
            [
                ("fit.grip_clearance_mm", -0.2),
                ("fit.slide_clearance_mm", 0.2),
                ("knee.knee_window_clearance_depth_mm", 0.1),
                ("knee.knee_window_clearance_height_mm", 0.1),
                ("fit.plug_clearance_mm", 0.2),
                ("corner.corner_hinge_thickness_mm", 2.5),
            ]
        );
        for fit in Fit::ALL {
            for key in fit.sets(&frame()).0 {
                assert!(parameter(key).is_some(), "{key}");
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
        assert!(matches!(read("held=3.2"), Err(FindingError::Beyond { key: "fit.grip_clearance_mm", .. })));
        assert!(matches!(read("slides=2.9"), Err(FindingError::Beyond { .. })));
        assert!(matches!(read("held=3.1,slides=3.0"), Err(FindingError::Contrary { .. })));
    }
}
