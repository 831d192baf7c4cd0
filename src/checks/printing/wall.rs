//! No wall is thinner than what the nozzle can lay, two lines side by side; no gap is narrower than a line.
//!
//! Measured on the mesh of the design, as it lies in print and without what a printer's `hole_undersize_mm` and `elephant_foot_mm` take
//! off. A warning tells of walls, not floors, that are too thin in the printed file alone.
//!
//! Walls and gaps are measured in cuts at the middle of layers, as the nozzle follows them ([`Walls`]). Floors and roofs, which no cut shows, are measured by rays from the middle of facets that lie flatter than 45°; where
//! the opposite facet faces away from the first it is a floor, and the ray's length its thickness. Facets are taken by
//! size, [`SAMPLES`] a part: a thin spot smaller than the smallest of these is not seen, nor is the edge of a wedge.

use nalgebra::{Point3, Vector3};
use rayon::prelude::*;

use crate::checks::finding::{Finding, Verdict};
use crate::checks::measure::Measure;
use crate::checks::printing::gap;
use crate::checks::rule::{Blame, Found, InSearch, Levers, Limit, Pass, Rule};
use crate::checks::scene::Scene;
use crate::figures::decimals;
use crate::frame::assembly::{Design, Printed, compensated};
use crate::frame::parts::{WallPlace, record};
use crate::params::PartName;
use crate::printing::printability::{AREA_MM2, Thin, Walls};
use crate::solid::MeshSolid;

/// The record of a rule: walls are thick enough to print.
pub static RULE: Rule = Rule {
    id: "thinnest_wall",
    title: "Wall thickness",
    requires: "no wall is thinner than the nozzle can print",
    units: &["mm"],
    limits: &[Limit::Printer],
    levers: Levers::OfPart(|part| record(part).walls.iter().map(|wall| wall.keys).collect()),
    blame: Blame::Levers,
    in_search: InSearch::Constraints { subjects: &[""], binds: true },
    found: Found::By(&[Pass::quick(check)]),
};

/// Facets looked at, a part.
const SAMPLES: usize = 500;
/// Walls thicker than this many limits are not measured.
const REACH: f64 = 4.0;
/// Least cosine between the directions of opposite facets: 25°.
const OPPOSITE: f64 = 0.9;
/// Rays start this far inside, mm.
const INSIDE_MM: f64 = 1e-4;
/// Least upward or downward part of the direction of a floor's facet.
const LYING: f64 = 0.7;

/// The thinnest wall or the narrowest gap of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct ThinnestWall {
    /// The part.
    pub part: PartName,
    /// Whether it is a gap.
    pub gap: bool,
    /// Thickness or width, mm, and where; nothing when all are beyond the reach of the measurement.
    pub thinnest: Option<Thin>,
    /// Least thickness or width, mm.
    pub limit_mm: f64,
    /// What makes it thicker or wider.
    pub levers: &'static [&'static str],
}

impl ThinnestWall {
    /// Of a part of a design: wall or floor, and gap.
    pub fn of(design: &Design, part: &Printed) -> [Self; 2] {
        let printer = &design.frame.printer;
        let limit_mm = printer.nozzle_mm * printer.min_wall_nozzles;
        let (layer_mm, reach_mm) = (printer.layer_mm(&design.material_of(part.name).material), REACH * limit_mm.max(printer.line_mm()));
        let inputs = (part.flat.key(), part.print_pose, layer_mm, reach_mm);
        let [wall, gap] = *design.memo.get("walls", part.name.slug(), &inputs, || measured(part, layer_mm, reach_mm));
        let one = |gap, thinnest, limit_mm, levers| Self { part: part.name, gap, thinnest, limit_mm, levers };
        let anywhere = record(part.name).walls.last().map_or(&[][..], |wall| wall.keys);
        let there = wall.map_or(anywhere, |thin| wall_keys(design, part, thin));
        [one(false, wall, limit_mm, there), one(true, gap, printer.line_mm(), anywhere)]
    }

    /// Whether the limit is kept, and what was found.
    pub fn finding(&self) -> Finding {
        let Self { part, gap: is_gap, thinnest, limit_mm, levers } = self;
        let reach_mm = REACH * limit_mm;
        let value = thinnest.map_or(reach_mm, |thin| thin.mm.min(reach_mm));
        let rule = if *is_gap { &gap::RULE } else { &RULE };
        let measure = Measure { rule: rule.id, value, limit: *limit_mm, unit: "mm", levers };
        let [size, needed] = measure.figures(2);
        let where_it_is = thinnest.map(|thin| thin.at_mm.map(|mm| decimals(mm, 1)).join(", "));
        let message = match (where_it_is.filter(|_| value < reach_mm), is_gap) {
            (Some(at), false) => format!("the thinnest wall of {part} is {size} mm (at {at} as printed), the nozzle needs {needed} mm"),
            (None, false) => format!("every wall of {part} is over {size} mm, the nozzle needs {needed} mm"),
            (Some(at), true) => format!("the narrowest gap of {part} is {size} mm (at {at} as printed), a line fills {needed} mm"),
            (None, true) => format!("every gap of {part} is over {size} mm, a line fills {needed} mm"),
        };
        measure.at_least(part.slug().into(), message)
    }
}

/// What makes a wall thicker, by the part's record.
fn wall_keys(design: &Design, part: &Printed, thin: Thin) -> &'static [&'static str] {
    let at_mm = part.print_pose.inverse_transform_point(&Point3::from(thin.at_mm)).into();
    record(part.name).wall_keys(&design.frame, &design.centre, &WallPlace { at_mm, thick_mm: thin.mm })
}

/// The thinnest wall or floor of a part, and its narrowest gap, as far as they are within reach.
fn measured(part: &Printed, layer_mm: f64, reach_mm: f64) -> [Option<Thin>; 2] {
    let Walls { wall, gap } = Walls::of(&part.mesh, layer_mm, reach_mm);
    let thinnest = [wall, floor(part, reach_mm)].into_iter().flatten().min_by(|a, b| a.mm.total_cmp(&b.mm));
    [thinnest, gap]
}

/// The thinnest floor or roof.
fn floor(part: &Printed, reach_mm: f64) -> Option<Thin> {
    let printed = part.printed();
    let mut floors: Vec<(Thin, f64)> = lying_facets(part)
        .into_iter()
        .filter_map(|facet| facet.wall_mm(&printed, reach_mm).map(|mm| (Thin { mm, at_mm: facet.middle.into() }, facet.area_mm2)))
        .collect();
    floors.sort_by(|a, b| a.0.mm.total_cmp(&b.0.mm));
    let mut area = 0.0;
    floors.into_iter().find_map(|(thin, area_mm2)| {
        area += area_mm2;
        (area >= AREA_MM2).then_some(thin)
    })
}

struct Facet {
    middle: Point3<f64>,
    normal: Vector3<f64>,
    area_mm2: f64,
}

impl Facet {
    fn wall_mm(&self, solid: &MeshSolid, reach_mm: f64) -> Option<f64> {
        let from = self.middle - self.normal * INSIDE_MM;
        let hit = solid.first_hit(from, self.middle - self.normal * reach_mm)?;
        (hit.normal.dot(&self.normal) < -OPPOSITE).then_some((hit.at - self.middle).norm())
    }
}

/// The largest facets of the printed mesh that may be of a floor or a roof.
fn lying_facets(part: &Printed) -> Vec<Facet> {
    let facet = |triangle: &[u32; 3]| {
        let [a, b, c] = part.mesh.corners(triangle);
        let cross = (b - a).cross(&(c - a));
        let middle = Point3::from((a.coords + b.coords + c.coords) / 3.0);
        Facet { middle, normal: cross.normalize(), area_mm2: 0.5 * cross.norm() }
    };
    let mut all: Vec<Facet> = part.mesh.triangles.iter().map(facet).filter(|facet| facet.normal.z.abs() >= LYING).collect();
    all.sort_by(|a, b| b.area_mm2.total_cmp(&a.area_mm2));
    all.truncate(SAMPLES);
    all
}

pub(in crate::checks) fn check(scene: &Scene) -> Vec<Finding> {
    let design = scene.design;
    let found: Vec<[ThinnestWall; 2]> = design.printed.par_iter().map(|part| ThinnestWall::of(design, part)).collect();
    let in_files: Vec<Option<Finding>> = design.printed.par_iter().map(|part| in_file(design, part)).collect();
    found.iter().flatten().map(ThinnestWall::finding).chain(in_files.into_iter().flatten()).collect()
}

/// A warning of a wall that only the file which is printed has too thin: of what the profile takes off around holes and in the first layer, a slicer
/// draws what is left.
fn in_file(design: &Design, part: &Printed) -> Option<Finding> {
    let printer = &design.frame.printer;
    let (layer_mm, limit_mm) = (printer.layer_mm(&design.material_of(part.name).material), printer.nozzle_mm * printer.min_wall_nozzles);
    let taken_mm = [printer.hole_undersize_mm, printer.elephant_foot_mm].map(|mm| mm.unwrap_or(0.0));
    if taken_mm == [0.0; 2] {
        return None;
    }
    let inputs = (part.flat.key(), part.print_pose, layer_mm, limit_mm, printer.line_mm(), taken_mm);
    let wall = || compensated::mesh(part, printer, layer_mm).ok().and_then(|mesh| Walls::of(&mesh, layer_mm, limit_mm).wall);
    let thin = (*design.memo.get("walls in file", part.name.slug(), &inputs, wall))?;
    let keys = record(part.name).walls.last().map_or(&[][..], |wall| wall.keys);
    let measure = Measure { rule: RULE.id, value: thin.mm, limit: limit_mm, unit: "mm", levers: keys };
    let [size, needed] = measure.figures(2);
    let at = thin.at_mm.map(|mm| decimals(mm, 1)).join(", ");
    let message = format!(
        "the file of {} has a wall of {size} mm (at {at}), for holes are drawn {} mm wider and the first layer is drawn in by up to {} mm; the nozzle \
         needs {needed} mm",
        part.name, taken_mm[0], taken_mm[1]
    );
    let warning = Finding { verdict: Verdict::Note, ..measure.at_least(format!("{}: in its file", part.name.slug()), message) };
    warning.warns().then_some(warning)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::{Planted, violated};
    use crate::params::Frame;

    #[test]
    fn planted_walls_that_only_the_printed_file_has_too_thin() {
        let warned = |hole_mm: f64, foot_mm: f64| -> Vec<Finding> {
            let found = Planted::frame(|frame| {
                (frame.printer.hole_undersize_mm, frame.printer.elephant_foot_mm) = (Some(hole_mm), Some(foot_mm));
            });
            found.found(check).into_iter().filter(Finding::warns).collect()
        };
        assert_eq!(warned(0.0, 0.0), []);
        assert_eq!(warned(0.05, 0.0), []);
        let wide = warned(1.0, 0.0);
        let hub = wide.iter().find(|finding| finding.subject == "hub: in its file").expect("has walls between bores");
        assert!((0.4..0.6).contains(&hub.value) && hub.message.contains("holes are drawn 1 mm wider"), "{hub:?}");
        let foot = warned(0.0, 0.4);
        assert!(foot.iter().any(|finding| finding.subject == "battery_sleeve: in its file"), "{foot:?}");
    }

    #[test]
    fn measured_the_real_frame_has_two_walls_too_thin() {
        let found = Planted::preset("cognifly-v8").found(check);
        let broken: Vec<_> = violated(&found).iter().map(|f| (f.subject.clone(), (100.0 * f.value).round())).collect();
        assert_eq!(broken, [("motor_mount".to_string(), 80.0), ("battery_bracket".to_string(), 85.0)]);
    }

    #[test]
    fn planted_a_wall_as_thick_as_the_nozzle_needs() {
        let skirt = |wall_mm: f64| {
            let found = Planted::frame(|frame| {
                frame.motor_mount.motor_skirt_wall_mm = wall_mm;
                (frame.printer.nozzle_mm, frame.printer.min_wall_nozzles) = (0.4, 2.0);
            });
            violated(&found.found(check))
        };
        assert_eq!(skirt(0.8), []);
        let thin = skirt(0.78);
        assert!(thin.len() == 1 && thin[0].message.contains("is 0.78 mm") && thin[0].message.contains("needs 0.80 mm"), "{thin:?}");
    }

    /// Each lever of the hub's thinnest wall, beside the counterbore of a stack's screw or elsewhere, makes it thicker.
    #[test]
    fn planted_what_drives_the_hub_s_thinnest_wall_depends_on_where_it_is() {
        let hub = |change: &dyn Fn(&mut Frame)| {
            let found = Planted::frame(|frame| {
                frame.printer.nozzle_mm = 0.6;
                change(frame);
            });
            found.found(check).into_iter().find(|f| f.rule == RULE.id && f.subject == "hub").expect("is looked at")
        };
        let usual = hub(&|_| ());
        assert_eq!(usual.levers, ["hub.hub_mouth_mm", "hub_joint.plug_length_mm", "hub.stack_counterbore_diameter_mm"]);
        let moved: [fn(&mut Frame); 3] = [
            |frame| frame.hub.hub_mouth_mm += 0.1,
            |frame| frame.hub_joint.plug_length_mm -= 0.1,
            |frame| frame.hub.stack_counterbore_diameter_mm -= 0.2,
        ];
        for change in moved {
            assert!(hub(&change).value > usual.value + 0.09, "{usual:?}");
        }
        let thin_boss: fn(&mut Frame) = |frame| frame.hub.hub_boss_wall_mm = 0.8;
        assert_eq!(hub(&thin_boss).levers[0], "hub.hub_boss_wall_mm");
    }

    /// Beside a small battery the tray under the flow sensor is what is thin.
    #[test]
    fn planted_what_drives_the_tray_s_wall_is_the_tray_s() {
        let sleeve = |pad_mm: f64| {
            let found = Planted::frame(|frame| {
                let battery = &mut frame.battery;
                (battery.battery_length_mm, battery.battery_width_mm, battery.battery_height_mm) = (40.0, 14.0, 8.0);
                frame.sleeve.tray_pad_radius_mm += pad_mm;
            });
            found.found(check).into_iter().find(|f| f.rule == RULE.id && f.subject == "battery_sleeve").expect("is looked at")
        };
        let usual = sleeve(0.0);
        assert_eq!(usual.levers[0], "sleeve.tray_pad_radius_mm", "{usual:?}");
        assert!(sleeve(0.3).value > usual.value, "{usual:?}");
    }

    #[test]
    fn regress_the_lid_keeps_its_walls_around_a_wide_and_high_battery() {
        let found = Planted::frame(|frame| {
            let battery = &mut frame.battery;
            (battery.battery_length_mm, battery.battery_width_mm, battery.battery_height_mm) = (67.0, 37.0, 22.0);
        });
        assert_eq!(violated(&found.found(check)), []);
    }

    #[test]
    fn analytic_walls_are_held_against_the_nozzle_and_gaps_against_a_line() {
        let frame = Planted::preset("cognifly");
        let printer = &frame.design.frame.printer;
        let found = frame.found(check);
        for (rule, limit_mm) in [(&RULE, printer.nozzle_mm * printer.min_wall_nozzles), (&gap::RULE, printer.line_mm())] {
            let of_rule: Vec<_> = found.iter().filter(|finding| finding.rule == rule.id).collect();
            assert_eq!(of_rule.len(), frame.design.printed.len(), "{}", rule.id);
            assert!(of_rule.iter().all(|f| f.limit == limit_mm && f.value <= 4.0 * limit_mm), "{of_rule:?}");
        }
    }

    #[test]
    fn regress_the_default_frame_has_none() {
        assert_eq!(violated(&Planted::preset("cognifly").found(check)), []);
    }
}
