//! What a frame measures, by name: the vocabulary of `diff`, `explain`, `solve` and `watch`.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::peak::{PEAK_CAVEAT, predicted_peak};
use crate::checks::{
    self, CATALOGUE, CENTRE_OF_MASS, Cost, ENVELOPE, Finding, GROUND_CLEARANCE, HINGE_STRAIN, PART_CLEARANCE, PROPELLER_CLEARANCE, Rule,
    SOCKET_SEATING, THINNEST_WALL, Verdict,
};
use crate::figures::{decimals, told_apart};
use crate::frame::assembly::Design;
use crate::frame::assembly::mass;
use crate::frame::assembly::mass::{LineKind, MassTable};
use crate::impact::body::DropBody;
use crate::mechanics::result::prediction::{Prediction, PredictionError, predict};
use crate::mechanics::settings::MechanicsSettings;
use crate::memo::Memo;
use crate::params::Frame;

/// Which way is better.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Better {
    /// Less.
    Less,
    /// More.
    More,
    /// Neither as such.
    Neither,
}

impl Better {
    /// What a figure is multiplied by so that less of it is better.
    pub fn sign(self) -> f64 {
        if self == Self::More { -1.0 } else { 1.0 }
    }
}

/// Significant digits by which figures of frames are compared: rules measure no more precisely than 0.005 mm.
const COMPARED_DIGITS: i32 = 5;

/// A figure as it is compared with another frame's.
pub fn resolved(figure: f64) -> f64 {
    // Saturates: none has a logarithm without end.
    let places = (COMPARED_DIGITS - 1).saturating_sub(libm::log10(figure.abs()).floor() as i32);
    let unit = 10_f64.powi(places);
    let rounded = (figure * unit).round() / unit;
    // Of none, and of what is next to none or endless, there are no digits.
    if rounded.is_finite() { rounded } else { figure }
}

/// Whether figures, of each of which less is better, beat others: none is worse, and one is better.
pub fn beats(these: &[f64], others: &[f64]) -> bool {
    let mut pairs = these.iter().zip(others).map(|(this, other)| resolved(*this).total_cmp(&resolved(*other)));
    let mut better = false;
    pairs.all(|order| {
        better |= order.is_lt();
        order.is_le()
    }) && better
}

/// A frame, designed and checked against its limits.
pub struct Evaluation {
    /// The design.
    pub design: Design,
    /// Its masses.
    pub masses: MassTable,
    /// What the rules found.
    pub findings: Vec<Finding>,
    /// What the frame's own mechanics say, where they were asked.
    pub prediction: Option<Prediction>,
}

impl Evaluation {
    /// Every rule.
    pub fn of(design: Design) -> Self {
        Self::by(&CATALOGUE, Cost::Slow, design)
    }

    /// These rules, without the passes that cost more.
    pub fn by(rules: &[&Rule], dearest: Cost, design: Design) -> Self {
        let masses = mass::table(&design);
        let findings = checks::check_by(rules, dearest, &design, &masses);
        Self { design, masses, findings, prediction: None }
    }

    /// Every rule as far as it is quick to check.
    ///
    /// # Errors
    /// When the frame cannot be designed.
    pub fn quick(frame: Frame, memo: &Arc<Memo>) -> Result<Self, crate::frame::assembly::DesignError> {
        Ok(Self::by(&CATALOGUE, Cost::Quick, Design::with(frame, memo)?))
    }

    /// The same with what the frame's own mechanics say: a second or two.
    ///
    /// # Errors
    /// When they find no equilibrium, or lose the motion.
    pub fn strengthened(self, settings: &MechanicsSettings) -> Result<Self, PredictionError> {
        let prediction = predict(&self.design, &self.masses, settings)?;
        Ok(Self { prediction: Some(prediction), ..self })
    }

    /// Predicted peak of a drop from 1 m, g: a simulation, only for who wants to know.
    fn peak_g(&self) -> f64 {
        predicted_peak(&self.body()).peak_g
    }

    /// How fast the lowest body hits the ground in the same drop, m/s, 0 where it does not.
    fn peak_strike_m_s(&self) -> f64 {
        predicted_peak(&self.body()).strike_m_s
    }

    /// The same in the design drop.
    fn design_drop_strike_m_s(&self, prediction: &Prediction) -> f64 {
        prediction.speed_m_s(self.gap_mm()).unwrap_or(0.0)
    }

    /// How fast the lowest body hits the ground in the drop that a measure is a peak of, m/s, 0 where it does not: that impact is in no peak.
    /// None of a measure that is no peak.
    pub fn strike_m_s(&self, measure: &Measure) -> Option<f64> {
        match measure.name {
            "peak" => Some(self.peak_strike_m_s()),
            "design_drop.peak" => Some(self.design_drop_strike_m_s(self.prediction.as_ref()?)),
            _ => None,
        }
    }

    /// From what hangs lowest to the ground, mm.
    fn gap_mm(&self) -> f64 {
        self.extreme(&GROUND_CLEARANCE, false, |_| true).unwrap_or(0.0)
    }

    /// The body that falls, with the gap that the rule has measured already.
    fn body(&self) -> DropBody {
        DropBody::with_gap(&self.design, &self.masses, self.gap_mm())
    }

    /// The value of a finding of a rule whose subject fits, the least or the most of them.
    fn extreme(&self, rule: &Rule, most: bool, fits: impl Fn(&Finding) -> bool) -> Option<f64> {
        let found = self.findings.iter().filter(|f| f.rule == rule.id && f.verdict != Verdict::Note && fits(f));
        found.map(|f| f.value).reduce(|a, b| if most { a.max(b) } else { a.min(b) })
    }

    fn extent_mm(&self, axis: &str) -> Option<f64> {
        self.extreme(&ENVELOPE, true, |f| f.subject.starts_with(axis))
    }

    fn printed_mm3(&self) -> f64 {
        self.design.printed.iter().map(|part| part.volume_mm3 * f64::from(part.part.quantity())).sum()
    }

    fn mass_of_g(&self, kind: LineKind) -> f64 {
        self.masses.lines.iter().filter(|line| line.kind == kind).map(|line| line.total_g).sum()
    }
}

/// A figure of a frame.
pub struct Measure {
    /// What it is called.
    pub name: &'static str,
    /// Unit of its values.
    pub unit: &'static str,
    /// What it is.
    pub doc: &'static str,
    /// Which way is better.
    pub better: Better,
    /// The rules whose findings it reads.
    rules: &'static [&'static Rule],
    value: Source,
}

/// Where the value of a measure comes from.
enum Source {
    /// From the design; none where the frame has no such thing.
    Design(fn(&Evaluation) -> Option<f64>),
    /// From the frame's own mechanics, which are only asked when somebody wants to know.
    Mechanics(fn(&Evaluation, &Prediction) -> f64),
}

impl Measure {
    /// Its value of a frame; none where the frame has no such thing, or where its mechanics were not asked.
    pub fn of(&self, evaluation: &Evaluation) -> Option<f64> {
        let value = match self.value {
            Source::Design(value) => value(evaluation),
            Source::Mechanics(value) => evaluation.prediction.as_ref().map(|prediction| value(evaluation, prediction)),
        };
        value.filter(|value| value.is_finite())
    }

    /// Whether it reads the findings of a rule.
    pub fn reads(&self, rule: &str) -> bool {
        self.rules.iter().any(|read| read.id == rule)
    }

    /// Whether it is one of the frame's own mechanics.
    pub fn is_mechanics(&self) -> bool {
        matches!(self.value, Source::Mechanics(_))
    }

    /// What has to be said wherever its figures are: a name of that, and the sentence.
    fn caveat(&self) -> Option<[&'static str; 2]> {
        match self.name {
            "peak" | "peak.strike" => Some(["peak", PEAK_CAVEAT]),
            _ => self.is_mechanics().then_some(["mechanics", MECHANICS_CAVEAT]),
        }
    }

    /// How many decimals its unit is reported with.
    pub fn places(&self) -> usize {
        if self.unit == "mm3" { 0 } else { 2 }
    }

    /// A value as it is told beside a limit, with as many decimals as tell them apart.
    pub fn told_beside(&self, value: f64, limit: f64) -> String {
        let [value, _] = told_apart(value, limit, self.places());
        value
    }

    /// A value as it is reported.
    pub fn reported(&self, value: Option<f64>) -> String {
        value.map_or("-".into(), |value| decimals(value, self.places()))
    }
}

/// Every measure, in the order of tables: those of the design, then those of its mechanics.
pub static MEASURES: [Measure; 22] = [
    design("mass", "g", "take-off mass", Better::Less, &[], |e| Some(e.masses.total_g)),
    design("mass.printed", "g", "mass of all printed parts", Better::Less, &[], |e| Some(e.mass_of_g(LineKind::Printed))),
    design("mass.rods", "g", "mass of all rods; none where an extra covers them", Better::Less, &[], |e| {
        Some(e.mass_of_g(LineKind::Rod)).filter(|rods_g| *rods_g > 0.0)
    }),
    design("centre_of_mass", "mm", "from the motors' centre to the centre of mass, in plan", Better::Less, &[&CENTRE_OF_MASS], |e| {
        e.extreme(&CENTRE_OF_MASS, true, |_| true)
    }),
    design("envelope.width", "mm", "width without propellers", Better::Less, &[&ENVELOPE], |e| e.extent_mm("width without")),
    design("envelope.depth", "mm", "depth without propellers", Better::Less, &[&ENVELOPE], |e| e.extent_mm("depth without")),
    design("envelope.height", "mm", "height without propellers", Better::Less, &[&ENVELOPE], |e| e.extent_mm("height without")),
    design("envelope.volume", "cm3", "width times depth times height, without propellers", Better::Less, &[&ENVELOPE], |e| {
        let sides = ["width without", "depth without", "height without"].map(|axis| e.extent_mm(axis));
        sides.into_iter().try_fold(1e-3, |all, side| side.map(|side| all * side))
    }),
    design("clearance.propeller", "mm", "from a propeller's disc to the nearest thing", Better::More, &[&PROPELLER_CLEARANCE], |e| {
        e.extreme(&PROPELLER_CLEARANCE, false, |_| true)
    }),
    design("clearance.part", "mm", "from a rod to the nearest rod, or part that does not hold it", Better::More, &[&PART_CLEARANCE], |e| {
        e.extreme(&PART_CLEARANCE, false, |_| true)
    }),
    design("clearance.ground", "mm", "from what hangs lowest to the ground", Better::More, &[&GROUND_CLEARANCE], |e| {
        e.extreme(&GROUND_CLEARANCE, false, |_| true)
    }),
    design("engagement", "mm", "least length of a rod inside a socket", Better::More, &[&SOCKET_SEATING], |e| {
        e.extreme(&SOCKET_SEATING, false, |f| f.subject.ends_with("engagement"))
    }),
    design("hinge.strain", "%", "largest strain of a folded hinge", Better::Less, &[&HINGE_STRAIN], |e| {
        e.extreme(&HINGE_STRAIN, true, |f| f.unit == "%")
    }),
    design("wall", "mm", "thinnest wall of a printed part", Better::More, &[&THINNEST_WALL], |e| {
        e.extreme(&THINNEST_WALL, false, |_| true)
    }),
    design("printed.volume", "mm3", "volume of all printed parts", Better::Less, &[], |e| Some(e.printed_mm3())),
    design("peak", "g", "predicted peak of a drop from 1 m", Better::Less, &[&GROUND_CLEARANCE], |e| Some(e.peak_g())),
    design("peak.strike", "m/s", "speed at which the lowest body hits the ground in that drop", Better::Less, &[&GROUND_CLEARANCE], |e| {
        Some(e.peak_strike_m_s())
    }),
    mechanics("stiffness", "N/mm", "force over displacement at 8 mm", Better::Neither, |_, p| p.secant_8_mm_n_mm),
    Measure {
        rules: &[&GROUND_CLEARANCE],
        ..mechanics("design_drop.peak", "g", "payload's peak in the design drop", Better::Less, |_, p| p.payload_peak_g)
    },
    Measure {
        rules: &[&GROUND_CLEARANCE],
        ..mechanics("design_drop.strike", "m/s", "speed at which the lowest body hits the ground in it", Better::Less, |e, p| {
            e.design_drop_strike_m_s(p)
        })
    },
    mechanics("design_drop.travel", "mm", "payload's way down in the design drop", Better::Less, |_, p| p.travel_mm),
    mechanics("design_drop.strain", "%", "largest strain in the design drop", Better::Less, |_, p| 100.0 * p.strain.1),
];

const fn design(
    name: &'static str,
    unit: &'static str,
    doc: &'static str,
    better: Better,
    rules: &'static [&'static Rule],
    value: fn(&Evaluation) -> Option<f64>,
) -> Measure {
    Measure { name, unit, doc, better, rules, value: Source::Design(value) }
}

const fn mechanics(
    name: &'static str,
    unit: &'static str,
    doc: &'static str,
    better: Better,
    value: fn(&Evaluation, &Prediction) -> f64,
) -> Measure {
    Measure { name, unit, doc, better, rules: &[], value: Source::Mechanics(value) }
}

/// What the measures of the mechanics are, and how far they can be trusted.
pub const MECHANICS_CAVEAT: &str = "stiffness, design_drop: by the frame's own mechanics; between frames of one material their ratios hold, as such they \
                                    are known to the band of the material's modulus, and a flexible material that states none counts as that of mechanics.toml \
                                    (docs/mechanics.md). No peak includes an impact on the ground, of which design_drop.strike is the speed";

/// What has to be said of some measures, each once: a name of that, and the sentence.
pub fn caveats<'a>(measures: impl Iterator<Item = &'a Measure>) -> Vec<[&'static str; 2]> {
    let said: BTreeSet<[&'static str; 2]> = measures.filter_map(Measure::caveat).collect();
    said.into_iter().rev().collect()
}

/// Units of measures by their names.
pub fn units<'a>(measures: impl Iterator<Item = &'a Measure>) -> BTreeMap<&'static str, &'static str> {
    measures.map(|measure| (measure.name, measure.unit)).collect()
}

/// A measure by its name.
pub fn measure(name: &str) -> Option<&'static Measure> {
    MEASURES.iter().find(|measure| measure.name == name)
}

/// The names of all measures, for a message.
pub fn measure_names() -> String {
    MEASURES.iter().map(|measure| measure.name).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    proptest::proptest! {
        /// Half of the fifth digit away at most; what has no digits stays as it is.
        #[test]
        fn analytic_compared_figures_are_near(figure in proptest::num::f64::ANY) {
            let compared = resolved(figure);
            if figure.is_finite() {
                proptest::prop_assert!((compared - figure).abs() <= 0.51e-4 * figure.abs(), "{figure} {compared}");
            } else {
                proptest::prop_assert_eq!(compared.to_bits(), figure.to_bits());
            }
        }
    }

    #[test]
    fn analytic_each_caveat_is_said_once() {
        assert_eq!(caveats(MEASURES.iter()), [["peak", PEAK_CAVEAT], ["mechanics", MECHANICS_CAVEAT]]);
        assert_eq!(caveats(MEASURES.iter().filter(|measure| measure.name == "mass")), [[""; 2]; 0]);
    }

    /// One that hangs below its own feet is down with the first touch.
    #[test]
    fn planted_a_battery_below_the_feet_hits_the_ground_at_full_speed() {
        let (mut frame, _) = Frame::load("cognifly").expect("a preset");
        (frame.battery.battery_height_mm, frame.rods.strut_rod_length_mm) = (30.0, 52.0);
        let found = Evaluation::quick(frame, &Arc::new(Memo::default())).expect("is one");
        assert!(found.gap_mm() < 0.0, "{}", found.gap_mm());
        let peak = MEASURES.iter().find(|measure| measure.name == "peak").expect("is one");
        let strike_m_s = found.strike_m_s(peak).expect("is a peak");
        assert!((strike_m_s - 4.43).abs() < 0.01, "{strike_m_s}");
    }

    #[test]
    fn analytic_the_body_is_that_of_a_drop_and_quick_is_the_same_frame() {
        let frame = || Frame::load("cognifly-mini").expect("a preset").0;
        let memo = Arc::new(Memo::default());
        let quick = Evaluation::quick(frame(), &memo).expect("is one");
        assert_eq!(quick.body(), DropBody::of(&quick.design, &quick.masses));
        // With what was computed of another frame the result is the same.
        Evaluation::quick(Frame::load("cognifly").expect("a preset").0, &memo).expect("is one");
        let again = Evaluation::quick(frame(), &memo).expect("is one");
        assert_eq!((&again.findings, &again.masses), (&quick.findings, &quick.masses));
        let whole = Evaluation::of(Design::new(frame()).expect("is one"));
        let hanging = ["overhang", "island", "bridge", "footing"];
        let is_slow =
            |f: &crate::checks::Finding| ["fold: way", "mounting: way"].contains(&&*f.subject) || hanging.contains(&f.rule.as_ref());
        let (slow, rest): (Vec<_>, Vec<_>) = whole.findings.iter().cloned().partition(is_slow);
        assert_eq!(slow.iter().filter(|f| f.subject == "fold: way").count(), 1);
        assert!(hanging.iter().all(|rule| slow.iter().any(|f| f.rule == *rule)), "{slow:?}");
        assert!(rest == quick.findings, "the other rules say something else");
        for measure in &MEASURES {
            assert_eq!(measure.of(&quick), measure.of(&whole), "{}", measure.name);
            let read: Vec<&Rule> = CATALOGUE.iter().copied().filter(|rule| measure.reads(rule.id)).collect();
            let of_its_rules = Evaluation::by(&read, Cost::Quick, Design::with(frame(), &memo).expect("is one"));
            assert_eq!(measure.of(&of_its_rules), measure.of(&quick), "{} by its own rules", measure.name);
            assert_eq!(measure.of(&quick).is_none(), measure.is_mechanics(), "{}", measure.name);
        }
    }
}
