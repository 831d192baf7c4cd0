//! Each hinge that folds on assembly is stretched by no more than a stated part of what its material bears.
//!
//! **Webs** (corner to strut, corner to leg). The rods fix the fold: the web turns by θ about the crossing of the rods'
//! axes, so its outer face, a socket's radius r below them, grows by r θ. The stretch starts at the notch's apex and
//! spreads at 45° to both sides into the web's thickness t: its length on the outer face is what the notch leaves open
//! on its floor (nothing, in a V) and 2 t. Strain = r θ / (2 t); θ / 2 where the web is as thick as the socket's radius.
//! Beam bending about the web's own middle, over half a thickness to both sides, gives the same θ / 2.
//!
//! **Necks** (hub joint). The leg's slope twists both necks: torsion of a rectangular bar, thickness t by arch width b,
//! over half the scallop's chord, for the scallop makes it thin only in the middle. Largest shear γ = c t θ / L with c
//! from Roark's formulas for a solid rectangle (Table 10.1, case 4); its principal stretch is γ/2 + √(1 + γ²/4). The
//! bending that comes with the arch's distance from the axis is left out.
//!
//! Both are small-strain formulas used beyond small strains, to compare frames; the factor on the elongation at break
//! covers that, creep, and the layers. The elongation is a data sheet's, its source is in the catalogue.

use super::finding::Finding;
use super::measure::Measure;
use super::rule::{Blame, Found, InSearch, Levers, Limit, Pass, Rule};
use super::scene::Scene;
use crate::frame::fold;
use crate::frame::fold::HingeLoad;
use crate::frame::skeleton::{Skeleton, strut_fold_deg};
use crate::params::Frame;
use crate::units::Angle;

const WEB: &[&str] = &["corner.corner_hinge_thickness_mm", "corner.corner_wall_mm", "materials.flexible"];
const NECKS: &[&str] = &["hub_joint.neck_thickness_mm", "hub_joint.arm_pitch_mm", "materials.flexible"];
const NOTCH: &[&str] = &["corner.notch_half_angle_deg"];

/// The record of a rule: hinges bear the strain of the fold.
pub static RULE: Rule = Rule {
    id: "hinge_strain",
    title: "Strain of folded hinges",
    requires: "the strain of a folded hinge is below the limit of its material",
    units: &["%", "deg"],
    limits: &[Limit::Key { subject: "", key: "limits.hinge_strain_factor" }, Limit::Material],
    levers: Levers::Sets(&[WEB, NECKS, NOTCH]),
    blame: Blame::Levers,
    in_search: InSearch::Constraints { subjects: &[""], binds: true },
    found: Found::By(&[Pass::quick(check)]),
};

/// The strain of a folded hinge.
#[derive(Clone, Debug, PartialEq)]
pub struct HingeStrain {
    /// Which.
    pub hinge: &'static str,
    /// Fold.
    pub fold: Angle,
    /// Length that takes the strain, mm.
    pub length_mm: f64,
    /// Largest strain, %.
    pub strain_percent: f64,
    /// Elongation at break over the factor, %.
    pub limit_percent: f64,
    /// The keys of the hinge's thickness and size, and of what it is made of.
    pub levers: &'static [&'static str],
}

impl HingeStrain {
    fn web(hinge: &'static str, frame: &Frame, fold: Angle, limit_percent: f64) -> Self {
        let HingeLoad { length_mm, strain_percent, .. } = fold::web(frame, fold);
        Self { hinge, fold, length_mm, strain_percent, limit_percent, levers: WEB }
    }

    fn neck(frame: &Frame, fold: Angle, limit_percent: f64) -> Self {
        let HingeLoad { length_mm, strain_percent, .. } = fold::necks(frame, fold);
        Self { hinge: "hub joint necks", fold, length_mm, strain_percent, limit_percent, levers: NECKS }
    }

    fn finding(&self) -> Finding {
        let Self { hinge, fold, length_mm, strain_percent: value, limit_percent: limit, levers } = self;
        let measure = Measure { rule: RULE.id, value: *value, limit: *limit, unit: "%", levers };
        let [strain, allowed] = measure.figures(0);
        let message = format!(
            "{hinge}: a fold of {:.1} deg over {length_mm:.2} mm strains the material by {strain} %, {allowed} % are allowed",
            fold.to_deg()
        );
        measure.at_most((*hinge).into(), message)
    }
}

/// How far a strut folds beyond the closing of its notch.
#[derive(Clone, Debug, PartialEq)]
pub struct NotchPreload {
    /// Fold of the strut.
    pub fold: Angle,
    /// Fold at which the notch's faces meet.
    pub closing: Angle,
}

impl NotchPreload {
    /// Of a frame's struts.
    pub(super) fn of(frame: &Frame, skeleton: &Skeleton) -> Self {
        Self {
            fold: Angle::deg(strut_fold_deg(skeleton.closure.strut_tilt.to_deg())),
            closing: Angle::deg(2.0 * frame.corner.notch_half_angle_deg),
        }
    }

    /// How far the fold is beyond the closing, deg; below 0 where the notch stays open.
    pub(super) fn beyond_deg(&self) -> f64 {
        self.fold.to_deg() - self.closing.to_deg()
    }

    fn finding(&self) -> Finding {
        let [value, limit] = [self.fold.to_deg(), self.closing.to_deg()];
        let measure = Measure { rule: RULE.id, value, limit, unit: "deg", levers: NOTCH };
        let beyond = self.beyond_deg();
        let message = if beyond > 0.0 {
            format!("the strut's notch closes at {limit:.1} deg and the fold is {value:.1} deg: its faces are preloaded by {beyond:.1} deg")
        } else {
            format!("the strut's notch closes at {limit:.1} deg and the fold is {value:.1} deg: {:.1} deg stay open", -beyond)
        };
        measure.note("corner notch".into(), message)
    }
}

/// The largest strain of a hinge against the limit of its material across layers.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerStrain {
    /// The hinge.
    pub hinge: &'static str,
    /// Its strain, %.
    pub strain_percent: f64,
    /// The material.
    pub material: String,
    /// Elongation at break when the layers are pulled apart, %.
    pub across_percent: f64,
}

impl LayerStrain {
    fn finding(&self) -> Finding {
        let Self { hinge, strain_percent: value, material, across_percent: limit } = self;
        let measure = Measure { rule: RULE.id, value: *value, limit: *limit, unit: "%", levers: &[] };
        let [strain, bears] = measure.figures(0);
        let message = if value > limit {
            format!(
                "{hinge} is strained by {strain} %, {material} bears {bears} % across layers: print corners and hub joints flat, \
                 as they lie in their files, so that the layers lie along the bend"
            )
        } else {
            format!("{hinge} is strained by {strain} %, {material} bears {bears} % even across layers")
        };
        measure.note("strain across layers".into(), message)
    }
}

pub(super) fn check(scene: &Scene) -> Vec<Finding> {
    let (frame, closure) = (&scene.design.frame, &scene.design.skeleton.closure);
    let strut = Angle::deg(strut_fold_deg(closure.strut_tilt.to_deg()));
    let notch = NotchPreload::of(frame, &scene.design.skeleton);
    // What is not known to stretch is taken not to: reading a frame file already refuses such a material.
    let elongation = frame.flexible.material.elongation_at_break_percent.unwrap_or(0.0);
    let limit = elongation / frame.limits.hinge_strain_factor;
    let hinges = [
        HingeStrain::web("top corner strut", frame, strut, limit),
        HingeStrain::web("bottom corner strut", frame, strut, limit),
        HingeStrain::web("bottom corner leg", frame, closure.leg_tilt, limit),
        HingeStrain::neck(frame, closure.leg_tilt, limit),
    ];
    let most = hinges.iter().max_by(|a, b| a.strain_percent.total_cmp(&b.strain_percent));
    let layers = most.zip(frame.flexible.material.elongation_across_layers_percent).map(|(most, across_percent)| {
        let (hinge, strain_percent, material) = (most.hinge, most.strain_percent, frame.flexible.name.clone());
        LayerStrain { hinge, strain_percent, material, across_percent }.finding()
    });
    hinges.iter().map(HingeStrain::finding).chain(layers).chain([notch.finding()]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::{Planted, violated};

    #[test]
    fn analytic_a_web_as_thick_as_the_socket_is_strained_by_half_the_fold() {
        let found = Planted::preset("cognifly-v8").found(check);
        assert!((found[0].value - 50.0 * Angle::deg(115.0).to_rad()).abs() < 0.1, "{found:?}");
        assert_eq!(violated(&found), []);
    }

    #[test]
    fn planted_webs_that_would_tear_between_layers() {
        let note = |found: Vec<Finding>| found.into_iter().find(|f| f.subject == "strain across layers").expect("is noted");
        let folded = note(Planted::preset("cognifly").found(check));
        assert!(folded.margin < 0.0 && folded.message.contains("print corners and hub joints flat"), "{folded:?}");
        let bears = Planted::frame(|frame| frame.flexible.material.elongation_across_layers_percent = Some(300.0));
        assert!(note(bears.found(check)).margin > 0.0);
    }

    #[test]
    fn planted_a_material_that_is_not_known_to_stretch() {
        let found = Planted::frame(|frame| frame.flexible.material.elongation_at_break_percent = None).found(check);
        assert_eq!(violated(&found).len(), 4, "{found:?}");
    }

    #[test]
    fn analytic_faces_that_just_meet_are_not_preloaded() {
        let told = |fold_deg: f64| NotchPreload { fold: Angle::deg(fold_deg), closing: Angle::deg(110.0) }.finding().message;
        assert!(told(110.0).ends_with("0.0 deg stay open"), "{}", told(110.0));
        assert!(told(107.5).ends_with("2.5 deg stay open"), "{}", told(107.5));
        assert!(told(111.5).ends_with("preloaded by 1.5 deg"), "{}", told(111.5));
    }

    #[test]
    fn planted_a_thin_web() {
        let found = Planted::frame(|frame| frame.corner.corner_hinge_thickness_mm = 1.6).found(check);
        let broken: Vec<_> = violated(&found).iter().map(|f| f.subject.clone()).collect();
        assert_eq!(broken, ["top corner strut", "bottom corner strut"]);
    }
}
