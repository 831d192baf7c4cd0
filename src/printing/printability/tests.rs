//! Solids whose answers are known.

use super::*;
use crate::frame::assembly::Design;
use crate::params::{Frame, PartName};
use crate::solid::{Contour, Feature, Mesh, MeshSolid, Profile};
use crate::units::Angle;

const PROCESS: Process = Process {
    brim_mm: 0.0,
    line_mm: 0.45,
    layer_mm: 0.2,
    overhang: Angle::rad(std::f64::consts::FRAC_PI_4),
    ledge_mm: 2.0,
    bridge_mm: 10.0,
    support_comes_off: true,
};

fn made(feature: &Feature) -> (MeshSolid, Mesh) {
    let solid = MeshSolid::build(feature);
    let low = solid.bounds_mm()[0][2];
    let solid = solid.placed(&nalgebra::Isometry3::translation(0.0, 0.0, -low)).simplified();
    let mesh = solid.mesh();
    (solid, mesh)
}

fn places(feature: &Feature) -> Vec<Hanging> {
    let (solid, mesh) = made(feature);
    unsupported::of(&solid, &mesh, &PROCESS)
}

fn faults(feature: &Feature) -> Vec<Fault> {
    places(feature).iter().filter_map(|place| place.fault(&PROCESS)).collect()
}

fn block(low: [f64; 3], high: [f64; 3]) -> Feature {
    Feature::cuboid_between(low, high)
}

/// A block whose side leans out by an angle over a height, mm.
fn leaning(deg: f64, height: f64) -> Feature {
    let out = height * Angle::deg(deg).tan();
    let outline = Contour::polygon(&[[0.0, 0.0], [10.0, 0.0], [10.0 + out, height], [0.0, height]]);
    Feature::extrude(Profile::new(outline), 8.0).turned_x(Angle::deg(90.0))
}

#[test]
fn analytic_a_wall_that_leans_by_less_than_the_angle_holds_itself() {
    assert_eq!(places(&leaning(40.0, 6.0)).len(), 0);
}

#[test]
fn analytic_a_wall_that_leans_by_more_hangs_by_its_whole_reach() {
    let found = places(&leaning(60.0, 6.0));
    assert_eq!(found.len(), 1);
    // From the middle of the first layer to that of the last: 29 of 30 layers' worth of 6 tan 60°, 8 mm wide.
    let reach = 29.0 / 30.0 * 6.0 * Angle::deg(60.0).tan();
    assert!((found[0].reach_mm - reach).abs() < 0.05 && (found[0].area_mm2 - 8.0 * reach).abs() < 0.5, "{reach} {}", found[0].reach_mm);
    assert_eq!(found[0].fault(&PROCESS), Some(Fault::Overhang));
    assert!((found[0].heights_mm[0] - 0.2).abs() < 1e-9 && (found[0].heights_mm[1] - 5.8).abs() < 1e-9);
}

#[test]
fn analytic_a_short_ledge_holds_and_a_long_one_does_not() {
    let ledge = |reach: f64| Feature::union([block([0.0; 3], [5.0, 10.0, 8.0]), block([4.0, 0.0, 5.0], [5.0 + reach, 10.0, 8.0])]);
    assert_eq!(faults(&ledge(1.9)), []);
    let found = places(&ledge(3.0));
    assert!(found.len() == 1 && (found[0].area_mm2 - 30.0).abs() < 0.05 && (found[0].reach_mm - 3.0).abs() < 0.01, "{}", found.len());
    assert_eq!(found[0].fault(&PROCESS), Some(Fault::Overhang));
}

/// A doorway through a wall of 4 mm, turned in plan.
fn doorway(span: f64, turned_deg: f64) -> Feature {
    let door = block([-0.5 * span, -3.0, -1.0], [0.5 * span, 3.0, 6.0]);
    block([-15.0, -2.0, 0.0], [15.0, 2.0, 10.0]).minus([door]).turned_z(Angle::deg(turned_deg))
}

#[test]
fn analytic_a_doorway_is_a_bridge_of_its_width() {
    for turned in [0.0, 30.0, 90.0] {
        let found = places(&doorway(8.0, turned));
        assert!(found.len() == 1 && found[0].bridged && (found[0].span_mm - 8.0).abs() < 0.05, "{turned}: {}", found[0].span_mm);
        assert_eq!(found[0].fault(&PROCESS), None);
        assert_eq!(faults(&doorway(12.0, turned)), [Fault::Bridge]);
    }
}

#[test]
fn analytic_a_lying_bore_is_a_bridge_over_what_is_steeper() {
    let bored = |radius: f64| {
        let bore = Feature::bore(radius, 30.0).at(0.0, 0.0, -15.0).turned_x(Angle::deg(90.0));
        block([-15.0, -6.0, 0.0], [15.0, 6.0, 24.0]).minus([bore.at(0.0, 0.0, 12.0)])
    };
    let small = places(&bored(1.5));
    assert!(small.len() == 1 && small[0].bridged, "{}", small.len());
    // Where it leans by more than 45°: the chord of a right angle, within a layer's step.
    assert!((small[0].span_mm - 1.5 * std::f64::consts::SQRT_2).abs() < 0.4, "{}", small[0].span_mm);
    assert_eq!(faults(&bored(1.5)), []);
    assert_eq!(faults(&bored(9.0)), [Fault::Bridge]);
}

#[test]
fn analytic_what_begins_in_the_air_is_an_island() {
    // A hook: its tip hangs down and is joined above.
    let hook = |tip: f64| {
        Feature::union([
            block([0.0; 3], [4.0, 6.0, 12.0]),
            block([3.0, 0.0, 9.0], [12.0, 6.0, 12.0]),
            block([9.0, 0.0, tip], [12.0, 6.0, 10.0]),
        ])
    };
    let found = places(&hook(5.0));
    let island: Vec<&Hanging> = found.iter().filter(|place| place.island).collect();
    assert!(island.len() == 1 && (island[0].area_mm2 - 18.0).abs() < 0.05 && (island[0].heights_mm[0] - 5.0).abs() < 1e-6);
    assert!(faults(&hook(5.0)).contains(&Fault::Island));
    assert_eq!(faults(&hook(0.0)), []);
}

#[test]
fn analytic_walls_and_gaps_are_as_wide_as_they_are() {
    let cell = |wall: f64, gap: f64| {
        let slot = block([2.0 + wall, -1.0, -1.0], [2.0 + wall + gap, 8.0, 20.0]);
        let hollow = block([0.0, 0.0, -1.0], [2.0, 8.0, 20.0]).at(0.0, 2.0, 0.0);
        block([-2.0, -2.0, 0.0], [12.0, 12.0, 6.0]).minus([slot, hollow])
    };
    let (_, mesh) = made(&cell(0.7, 0.3));
    let Walls { wall, gap } = Walls::of(&mesh, 0.2, 3.4);
    let (wall, gap) = (wall.expect("a wall"), gap.expect("a gap"));
    assert!((wall.mm - 0.7).abs() < 1e-4 && (gap.mm - 0.3).abs() < 1e-4, "{wall:?} {gap:?}");
    assert!(gap.at_mm[0] > 2.6 && gap.at_mm[0] < 3.1, "{gap:?}");
    // Turned by any angle, the same.
    let (_, turned) = made(&cell(0.7, 0.3).turned_z(Angle::deg(33.0)));
    let Walls { wall, gap } = Walls::of(&turned, 0.2, 3.4);
    assert!((wall.expect("a wall").mm - 0.7).abs() < 1e-3 && (gap.expect("a gap").mm - 0.3).abs() < 1e-3);
    let (_, solid) = made(&block([0.0; 3], [8.0; 3]));
    assert_eq!(Walls::of(&solid, 0.2, 3.4), Walls::default());
}

/// A fin that begins above the last whole step of the cuts.
#[test]
fn analytic_the_top_of_a_part_is_measured_too() {
    let fin = block([0.0, 4.0, 0.8], [10.0, 4.5, 1.15]);
    let (_, mesh) = made(&Feature::union([block([0.0; 3], [10.0, 10.0, 0.8]), fin]));
    let wall = Walls::of(&mesh, 0.2, 3.4).wall.expect("a wall");
    assert!((wall.mm - 0.5).abs() < 1e-4, "{wall:?}");
}

#[test]
fn analytic_the_crown_of_a_lying_tube_is_no_wall() {
    let (_, mesh) = made(&Feature::cylinder(3.03, 10.0).turned_x(Angle::deg(90.0)));
    assert_eq!(Walls::of(&mesh, 0.2, 2.0).wall, None);
}

#[test]
fn analytic_a_block_tips_over_its_nearer_edge() {
    let (solid, mesh) = made(&block([0.0; 3], [10.0, 20.0, 30.0]));
    let Footing { contact_mm2, tip, slender } = Footing::measured(&solid, &mesh, &PROCESS, &[]);
    assert!((contact_mm2 - 200.0).abs() < 1e-6 && (slender - 3.0).abs() < 1e-6);
    assert!((tip.tan() - 5.0 / 15.0).abs() < 1e-6, "{tip:?}");
    // A brim of 3 mm widens what it stands on to 16 mm.
    let brim = Process { brim_mm: 3.0, ..PROCESS };
    let held = Footing::measured(&solid, &mesh, &brim, &[]);
    assert!((held.contact_mm2 - 200.0).abs() < 1e-6 && (held.slender - 30.0 / 16.0).abs() < 1e-6, "{held:?}");
    assert!((held.tip.tan() - 8.0 / 15.0).abs() < 1e-6, "{held:?}");
    // An upside-down L: its centre lies outside what it stands on.
    let (solid, mesh) = made(&Feature::union([block([0.0; 3], [4.0, 4.0, 20.0]), block([3.0, 0.0, 18.0], [40.0, 4.0, 22.0])]));
    assert!(Footing::measured(&solid, &mesh, &PROCESS, &[]).tip.to_deg() < 0.0);
    let held = unsupported::of(&solid, &mesh, &PROCESS);
    let plans: Vec<&crate::solid::Region> = held.iter().map(|place| &place.plan).collect();
    assert!(Footing::measured(&solid, &mesh, &PROCESS, &plans).tip.to_deg() > 0.0);
}

/// A frame of walls, and a block in its corner: the slicer lays what is at least half of a line wide.
#[test]
fn analytic_walls_thinner_than_half_a_line_are_no_first_layer() {
    let walls = |wide: f64| {
        let inner = block([wide, wide, -1.0], [20.0 - wide, 20.0 - wide, 6.0]);
        let (solid, mesh) = made(&Feature::union([block([0.0; 3], [20.0, 20.0, 5.0]).minus([inner]), block([0.0; 3], [3.0, 4.0, 5.0])]));
        Footing::measured(&solid, &mesh, &PROCESS, &[]).contact_mm2
    };
    let [thin, wide] = [0.48, 0.52].map(|share| share * PROCESS.line_mm);
    // Of the thin frame, of 17 mm², little is left: it is wider across its corners.
    assert!((walls(thin) - 12.0).abs() < 0.5, "{}", walls(thin));
    let whole = 400.0 - (20.0 - 2.0 * wide).powi(2) + 12.0 - 7.0 * wide + wide * wide;
    assert!((walls(wide) - whole).abs() < 0.1, "{} {whole}", walls(wide));
}

/// Crumbs of 0.002 mm beside a strut's bore made the top of that bore an island.
#[test]
fn regress_crumbs_of_a_cut_are_no_islands() {
    let mut frame = Frame::load("cognifly").expect("is valid").0;
    (frame.rods.arm_rod_length_mm, frame.rods.cage_rod_length_mm) = (84.0, 196.0);
    let design = Design::new(frame).expect("can be designed");
    let process = Process::of(&design.frame.flexible.material, &design.frame.printer);
    let knee = design.part(PartName::Knee).expect("is printed");
    assert!(hanging(&design, knee, &process).iter().all(|place| !place.island));
}
