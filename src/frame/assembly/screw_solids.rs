//! Solids of screws, nuts, dampers and ties, at their catalogued sizes, where they hold something.

use nalgebra::Point3;

use super::press_fit::ring_mm3;
use crate::frame::parts::MotorMount;
use crate::frame::parts::outline::upright;
use crate::frame::skeleton::{Accessories, Centre, Stack};
use crate::params::Frame;
use crate::params::catalogue::BoughtPart;
use crate::solid::{Contour, Feature, Profile};

/// Play of a tie's strap in the slot that it leaves the bracket by, mm: it lies on the slot's lower face.
const STRAP_PLAY_MM: f64 = 0.05;
/// How far a tie reaches out of the bracket's slot, mm.
const STRAP_OUT_MM: f64 = 2.0;

/// A screw along z whose head rests on a face at this height, the thread below it; none where a size of it is not catalogued.
fn screw(part: &BoughtPart, at: [f64; 2], seat_mm: f64, way: f64) -> Option<Feature> {
    let (thread, length) = (part.thread_mm?, part.length_mm?);
    let (head, high) = (part.head_diameter_mm?, part.head_height_mm?);
    let [x, y] = at;
    let to = |z: f64| Point3::new(x, y, seat_mm + way * z);
    // The thread begins in the head: they are one body.
    let shaft = Feature::cylinder_between(to(-length), to(0.5 * high), 0.5 * thread);
    Some(Feature::union([shaft, Feature::cylinder_between(to(0.0), to(high), 0.5 * head)]))
}

/// The four screws of the stack, heads up in their counterbores; none where no board hangs there.
pub(super) fn stack_screws(part: &BoughtPart, frame: &Frame, centre: &Centre) -> Option<Feature> {
    let stack = Stack::new(frame, centre);
    stack.boards.first()?;
    let screws: Option<Vec<Feature>> = Stack::axes_mm(frame).into_iter().map(|at| screw(part, at, stack.seat_mm, 1.0)).collect();
    Some(Feature::union(screws?))
}

/// The four nuts of the stack, their upper faces on what the screws hold; none where no board hangs there or the screws have no stated
/// thread.
pub(super) fn stack_nuts(part: &BoughtPart, frame: &Frame, centre: &Centre) -> Option<Feature> {
    let top = Stack::new(frame, centre).nut_seat_mm()?;
    hexagons(part, frame, [top - part.size_mm[2], top])
}

/// The spacers above a board of the stack, counted from the hub, those of one screw as one piece; none where the way is bare, or the screws have no stated thread.
pub(super) fn stack_spacers(board: usize, frame: &Frame, centre: &Centre) -> Option<Feature> {
    let spacers = Stack::new(frame, centre).boards.get(board)?.spacers?;
    hexagons(spacers.part, frame, [spacers.bottom_mm(), spacers.top_mm])
}

/// A hexagon of a part's width on each screw of the stack, with the screw's hole.
fn hexagons(part: &BoughtPart, frame: &Frame, reach_mm: [f64; 2]) -> Option<Feature> {
    let thread = frame.bought.get("stack_screw")?.part.thread_mm?;
    let [corners, flats, _] = part.size_mm;
    let [x, y] = [0.5 * corners, 0.5 * flats];
    let hexagon = Contour::polygon(&[[x, 0.0], [0.5 * x, y], [-0.5 * x, y], [-x, 0.0], [-0.5 * x, -y], [0.5 * x, -y]]);
    let section = Profile::new(hexagon).with_holes([Contour::bore([0.0, 0.0], 0.5 * thread)]);
    let one = |[x, y]: [f64; 2]| upright(section.clone(), reach_mm).at(x, y, 0.0);
    (thread < flats).then(|| Feature::union(Stack::axes_mm(frame).map(one)))
}

/// The screws of a motor in the axes of its mount, heads down under the plate; none where a size of them is not catalogued.
pub(super) fn motor_screws(part: &BoughtPart, frame: &Frame) -> Option<Feature> {
    let mount = MotorMount::from_frame(frame);
    let under_plate = mount.top_mm - mount.plate_mm;
    let screws: Option<Vec<Feature>> = mount.screw_axes_mm().into_iter().map(|at| screw(part, at, under_plate, -1.0)).collect();
    Some(Feature::union(screws?))
}

/// Least thickness of a damper's rim in the drawing, mm.
const DAMPER_RIM_MM: f64 = 0.2;
/// Least difference of two diameters of a damper in the drawing, mm.
const DAMPER_STEP_MM: f64 = 0.2;

/// The dampers: round, above and below the first board, and through its holes where these let a neck pass; none where the screw is wider
/// than they are.
pub(super) fn dampers(frame: &Frame, centre: &Centre) -> Option<Feature> {
    let stack = Stack::new(frame, centre);
    let (part, middle) = stack.dampers()?;
    let board = stack.boards.first()?.part;
    let thread = frame.bought.get("stack_screw").and_then(|screw| screw.part.thread_mm).unwrap_or(0.0);
    let [across, _, height] = part.size_mm;
    let (neck, thick) = (board.hole_diameter_mm.unwrap_or(0.0).min(across), board.board_mm());
    let one = |[x, y]: [f64; 2]| {
        let piece = |from: f64, to: f64, diameter: f64| {
            Feature::cylinder_between(Point3::new(x, y, middle + from), Point3::new(x, y, middle + to), 0.5 * diameter)
        };
        let half_board = 0.5 * thick;
        let half = (0.5 * height).max(half_board + DAMPER_RIM_MM);
        let bore = Feature::bore_between(Point3::new(x, y, middle - height), Point3::new(x, y, middle + height), 0.5 * thread);
        let rims = [piece(half_board, half, across), piece(-half, -half_board, across)];
        let neck = (neck > thread + DAMPER_STEP_MM).then(|| piece(-half_board - 0.1, half_board + 0.1, neck));
        let body = Feature::union(rims.into_iter().chain(neck));
        if thread > 0.0 { body.minus([bore]) } else { body }
    };
    (across > thread + DAMPER_STEP_MM).then(|| Feature::union(Stack::axes_mm(frame).map(one)))
}

/// What of the ties is in their holes, in the battery's axes: through hub and carrier, at the ends of the bracket down into it and out of its slots.
pub(super) fn ties(part: &BoughtPart, frame: &Frame, centre: &Centre) -> Option<Feature> {
    let [wide, thick] = part.strap_mm?;
    // The bracket's ties are in front and behind, the others beside it.
    let (before, half_hub) = (centre.tie_bracket_mm, centre.hub_half_height_mm);
    let beside = if centre.battery_axes.are_turned() { centre.tie_front_mm } else { centre.tie_side_mm };
    let laid_mm = match () {
        () if frame.bought.contains_key("computer") => Some(centre.carrier_top_mm()),
        () if Accessories::wanted(frame) => Some(Accessories::new(frame, centre).top_mm),
        () => None,
    };
    let top = laid_mm.unwrap_or(half_hub);
    let upright = |[x, y]: [f64; 2], low: f64| {
        // Flat towards the hub's axis.
        let [a, b] = if x == 0.0 { [0.5 * wide, 0.5 * thick] } else { [0.5 * thick, 0.5 * wide] };
        Feature::cuboid_between([x - a, y - b, low], [x + a, y + b, top])
    };
    let floor = centre.bracket_z_mm() - frame.bracket.tie_hole_depth_mm + STRAP_PLAY_MM;
    let out = centre.bracket_half_mm + STRAP_OUT_MM;
    let leg = |side: f64| {
        let [near, far] = [side * (before - 0.5 * thick), side * out];
        let low = [-0.5 * wide, near.min(far), floor];
        Feature::cuboid_between(low, [0.5 * wide, near.max(far), floor + thick])
    };
    // Where nothing lies on the hub, those beside the bracket would hold nothing.
    let through_hub = |side: f64| laid_mm.map(|_| upright([side * beside, 0.0], -half_hub));
    let sides =
        [1.0, -1.0].map(|side| Feature::union([upright([0.0, side * before], floor), leg(side)].into_iter().chain(through_hub(side))));
    Some(Feature::union(sides))
}

/// What the threads of a frame's screws are meant to share with what they are screwed into, mm³: a motor, the hub.
pub fn threads_mm3(frame: &Frame, centre: &Centre) -> [f64; 2] {
    let screw = |role: &str| frame.bought.get(role).map(|item| &item.part).and_then(|part| Some((part.thread_mm?, part.length_mm?)));
    let holes = frame.bought.get("motor").map_or(0.0, |motor| f64::from(motor.part.motor_holes()));
    let in_motor = screw("motor_screw")
        .map_or(0.0, |(thread, length)| holes * ring_mm3(thread, 0.0, (length - frame.motor_mount.motor_plate_thickness_mm).max(0.0)));
    let in_hub = screw("stack_screw").map_or(0.0, |(thread, length)| {
        let plate = Stack::new(frame, centre).seat_mm + centre.hub_half_height_mm;
        4.0 * ring_mm3(thread, frame.hub.stack_pilot_diameter_mm, plate.min(length))
    });
    [in_motor, in_hub]
}
