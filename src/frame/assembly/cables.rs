//! The cables between boards: from camera, sensor, computer and accessories to the board that reads them.
//!
//! What sits on the hub leads its cable down between the two bosses of the nearest module, where the plate ends, and under the hub to the
//! controller: the flight controller, or the board that is both. Where an extra stands for it, no place is known that a cable would end at, and
//! none is drawn. The flow sensor's passes through the upper wire hole of the bracket's front upright.

use nalgebra::{Point3, Vector3};

use super::body_box::bounds_mm;
use super::design::Design;
use super::wire::{Section, Wire};
use crate::params::Frame;

/// A cable that a design may have.
pub struct Cable {
    /// Its line in the bill.
    pub role: &'static str,
    /// By which words a shop is asked for it.
    pub search: &'static str,
    /// What it begins at, in words.
    pub begins: &'static str,
    /// The body where it begins.
    from: &'static str,
    /// How it runs.
    route: Route,
    /// Radius of its wires together, mm: estimates, of 28 AWG in silicone.
    radius_mm: f64,
    /// Linear red, green, blue, alpha.
    colour: [f32; 4],
    /// That colour in a word.
    colour_word: &'static str,
    /// What is done with both its ends; see [`Wire::plugging`].
    plugging: &'static str,
}

/// How a cable runs.
#[derive(Clone, Copy)]
enum Route {
    /// From the camera's lower edge to the computer's front edge.
    Ribbon,
    /// Beside the stack, from the upper board to the lower one.
    Stack,
    /// Through the bracket's front upright.
    Upright,
    /// Down beside the hub.
    Hub,
}

/// Width and thickness of a camera's ribbon, mm: that of 22 contacts at 0.5 mm pitch.
const RIBBON_MM: [f64; 2] = [11.5, 0.3];
/// How far a cable leaves a board straight, mm.
const OUT_MM: f64 = 3.0;
/// What of a board's half width a cable stays within.
const ON_BOARD: f64 = 0.8;

/// The cables, in the order of the bill.
pub const CABLES: [Cable; 8] = [
    Cable {
        role: "board_cable",
        search: "cable between flight controller and ESC",
        begins: "flight controller",
        from: "flight_controller",
        route: Route::Stack,
        radius_mm: 1.2,
        colour: [0.5, 0.5, 0.5, 1.0],
        colour_word: "grey",
        plugging: "Plug the board cable into both boards.",
    },
    Cable {
        role: "sensor_cable",
        search: "cable for the flow sensor",
        begins: "flow sensor",
        from: "flow_sensor",
        route: Route::Upright,
        radius_mm: 1.1,
        colour: [0.02, 0.12, 0.5, 1.0],
        colour_word: "bright blue",
        plugging: "Plug the sensor cable into the flow sensor, lead it through the holes of the {front} upright, and plug it into a serial port of the {end}.",
    },
    Cable {
        role: "camera_cable",
        search: "camera ribbon cable for the computer",
        begins: "camera",
        from: "camera",
        route: Route::Ribbon,
        radius_mm: 0.0,
        colour: [0.75, 0.75, 0.72, 1.0],
        colour_word: "white",
        plugging: "Push the camera cable, a ribbon, into the sockets of camera and {end}, and close both latches.",
    },
    Cable {
        role: "computer_cable",
        search: "serial cable and 5 V supply",
        begins: "computer",
        from: "computer",
        route: Route::Hub,
        radius_mm: 1.1,
        colour: [0.02, 0.35, 0.08, 1.0],
        colour_word: "green",
        plugging: "Plug the computer cable into the computer's pins for serial data and 5 V, lead it down beside the hub, between two bosses, and plug it into a serial port and 5 V of the {end}.",
    },
    Cable {
        role: "receiver_cable",
        search: "serial cable with 5 V for a receiver",
        begins: "receiver",
        from: "receiver",
        route: Route::Hub,
        radius_mm: 1.1,
        colour: [0.6, 0.45, 0.02, 1.0],
        colour_word: "yellow",
        plugging: "Plug the receiver cable into the receiver, lead it down beside the hub, between two bosses, and plug it into a serial port and 5 V of the {end}.",
    },
    Cable {
        role: "gps_cable",
        search: "serial cable with 5 V for a GPS",
        begins: "GPS",
        from: "gps",
        route: Route::Hub,
        radius_mm: 1.1,
        colour: [0.3, 0.05, 0.4, 1.0],
        colour_word: "violet",
        plugging: "Plug the GPS cable into the GPS, lead it down beside the hub, between two bosses, and plug it into a serial port and 5 V of the {end}.",
    },
    Cable {
        role: "buzzer_cable",
        search: "two-wire cable for a buzzer",
        begins: "buzzer",
        from: "buzzer",
        route: Route::Hub,
        radius_mm: 0.9,
        colour: [0.5, 0.15, 0.02, 1.0],
        colour_word: "red-brown",
        plugging: "Plug the buzzer cable into the buzzer, lead it down beside the hub, between two bosses, and join it to the leads of the buzzer's pads of the {end}, or plug it in.",
    },
    Cable {
        role: "fpv_cable",
        search: "three-wire cable for a camera",
        begins: "camera for goggles",
        from: "fpv_camera",
        route: Route::Hub,
        radius_mm: 1.0,
        colour: [0.6, 0.55, 0.05, 1.0],
        colour_word: "yellow-green",
        plugging: "Plug the FPV cable into the camera for goggles, lead it down beside the hub, between two bosses, and join it to the leads of the camera's pads of the {end}, or plug it in.",
    },
];

/// A body's lowest and highest corner, frame axes, mm.
type Bounds = [Point3<f64>; 2];

/// The board that reads sensors and accessories; none where an extra does.
fn reader(design: &Design) -> Option<&'static str> {
    let role = if design.frame.is_all_in_one() { "motor_controller" } else { "flight_controller" };
    bounds_mm(design, role).map(|_| role)
}

/// Bodies of a design from which a cable would lead to the board that reads them, where it has no such board.
pub fn unconnected(design: &Design) -> Vec<&'static str> {
    if reader(design).is_some() {
        return Vec::new();
    }
    let read = CABLES.iter().filter(|cable| matches!(cable.route, Route::Upright | Route::Hub));
    read.map(|cable| cable.from).filter(|from| bounds_mm(design, from).is_some()).collect()
}

/// The cables of a design whose both ends it has.
pub(super) fn cables(design: &Design) -> Vec<Wire> {
    CABLES.iter().filter(|cable| cable.is_used(&design.frame)).filter_map(|cable| cable.wire(design)).collect()
}

impl Cable {
    /// Whether what it begins at has such a cable: a digital camera's ribbon leads to its transmitter.
    fn is_used(&self, frame: &Frame) -> bool {
        frame.bought.get(self.from).is_none_or(|item| item.part.digital != Some(true))
    }

    fn wire(&self, design: &Design) -> Option<Wire> {
        let to = match self.route {
            Route::Ribbon => "computer",
            Route::Stack => "motor_controller",
            Route::Upright | Route::Hub => reader(design)?,
        };
        let (begin, end) = (bounds_mm(design, self.from)?, bounds_mm(design, to)?);
        let way = match self.route {
            Route::Ribbon => ribbon(begin, end),
            Route::Stack => beside(begin, end),
            Route::Upright => through_upright(design, begin, end, self.radius_mm),
            Route::Hub => down(design, begin, end, self.radius_mm)?,
        };
        // Up to the upright of the bracket, which moves with the sensor; else to where the cable leaves the board.
        let begins = if let Route::Upright = self.route { 4 } else { way.len() / 2 };
        let section = if let Route::Ribbon = self.route { Section::Ribbon(RIBBON_MM) } else { Section::Round(self.radius_mm) };
        Some(Wire {
            name: self.role.into(),
            role: self.role,
            way,
            begins,
            section,
            joins: Some([self.from, to]),
            plugging: self.plugging,
            colour: self.colour,
            colour_word: self.colour_word,
        })
    }
}

/// From behind a camera's lower edge in a bend to the upper face of the computer's front edge.
fn ribbon([low, high]: Bounds, [edge_low, edge_high]: Bounds) -> Vec<Point3<f64>> {
    let (x, z) = (0.5 * (low.x + high.x), edge_low.z + 0.6 * (edge_high.z - edge_low.z));
    vec![
        Point3::new(x, low.y, low.z + OUT_MM),
        Point3::new(x, low.y - 0.4 * OUT_MM, low.z + OUT_MM),
        Point3::new(x, edge_high.y + 0.5 * OUT_MM, z),
        Point3::new(x, edge_high.y - OUT_MM, z),
    ]
}

/// From the right edge of a board around to that of another.
fn beside(from: Bounds, to: Bounds) -> Vec<Point3<f64>> {
    let out = from[1].x.max(to[1].x) + OUT_MM;
    let [begin, end] = [from, to].map(|[low, high]| Point3::new(high.x, 0.5 * (low.y + high.y), 0.5 * (low.z + high.z)));
    vec![begin, Point3::new(out, begin.y, begin.z), Point3::new(out, end.y, end.z), end]
}

/// From a sensor's front edge up before its tray, and to the rear through the upper wire hole on the right: of the battery's axes, with which
/// sensor and bracket turn.
fn through_upright(design: &Design, sensor: Bounds, board: Bounds, radius_mm: f64) -> Vec<Point3<f64>> {
    let (centre, bracket) = (&design.centre, &design.frame.bracket);
    let own = |[low, high]: Bounds| centre.battery_axes.box_of([low.into(), high.into()]).map(Point3::from);
    let ([low, high], [board_low, board_high]) = (own(sensor), own(board));
    let (x, z) = (0.5 * bracket.wire_hole_pitch_across_mm, centre.magnet_z_mm + centre.bracket_z_mm());
    let middle_z = 0.5 * (low.z + high.z);
    let before = high.y.max(centre.bracket_half_mm) + OUT_MM;
    let board_y = board_low.y + 0.5 * (1.0 + ON_BOARD) * (board_high.y - board_low.y);
    let way = [
        Point3::new(x, high.y, middle_z),
        Point3::new(x, before, middle_z),
        Point3::new(x, before, z - 2.0 * radius_mm),
        Point3::new(x, centre.bracket_half_mm + OUT_MM, z),
        Point3::new(x, board_high.y + OUT_MM, z),
        Point3::new(x.min(ON_BOARD * board_high.x), board_y, 0.5 * (board_low.z + board_high.z)),
    ];
    way.map(|point| centre.battery_axes.point(point)).into()
}

/// From the edge of what sits on the hub down between the bosses of the nearest module, under the hub, and to the controller.
fn down(design: &Design, [low, high]: Bounds, board: Bounds, radius_mm: f64) -> Option<Vec<Point3<f64>>> {
    let [hub_low, hub_high] = bounds_mm(design, "hub")?;
    let centre = &design.centre;
    let middle = nalgebra::center(&low, &high);
    // Half way from the plate's edge to the bosses' mouths, along the diagonal.
    let out = 0.5 * (centre.plate_edge_mm + design.frame.hub.hub_mouth_mm) * std::f64::consts::FRAC_1_SQRT_2;
    let (side, end) = (if middle.x > 0.5 { 1.0 } else { -1.0 }, if middle.y > 0.0 { 1.0 } else { -1.0 });
    let gap = Point3::new(side * out, end * (out + centre.places.forward_mm), 0.0);
    let begin = Point3::new(gap.x.clamp(low.x, high.x), gap.y.clamp(low.y, high.y), middle.z);
    let (top, under) = (hub_high.z.max(low.z.min(hub_high.z + OUT_MM)), hub_low.z - radius_mm);
    let board_middle = nalgebra::center(&board[0], &board[1]);
    let reach = 0.5 * ON_BOARD * (board[1] - board[0]);
    let finish = board_middle + Vector3::new(side * reach.x, end * reach.y, 0.0);
    let aside = Vector3::new(gap.x - begin.x, gap.y - begin.y, 0.0);
    let below = Point3::new(gap.x, gap.y, under);
    // What stands over the gap leads its cable straight down.
    if aside.norm() < 2.0 * OUT_MM {
        return Some(vec![begin, below, finish]);
    }
    let leave = begin + aside * (OUT_MM / aside.norm());
    Some(vec![begin, leave, Point3::new(gap.x, gap.y, top), below, finish])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Frame;
    use crate::params::sleeve_direction::SleeveDirection;
    use crate::solid::gate;

    fn design(frame: &str) -> Design {
        Design::new(Frame::load(frame).expect("is a frame").0).expect("designs")
    }

    /// How far a point is outside of a box, mm.
    fn outside_mm(point: &Point3<f64>, [low, high]: Bounds) -> f64 {
        (0..3).map(|axis| (low[axis] - point[axis]).max(point[axis] - high[axis])).fold(0.0, f64::max)
    }

    const LONG_RANGE: &str = "examples/frames/four-inch-long-range.toml";

    /// The example whose camera for goggles is digital, with one that is not.
    fn analogue() -> Design {
        let mut frame = Frame::load(LONG_RANGE).expect("is a frame").0;
        frame.bought.get_mut("fpv_camera").expect("has one").part.digital = None;
        Design::new(frame).expect("designs")
    }

    /// The same frame with its sleeve across: bracket and sensor turn with it.
    fn across(frame: &str) -> Design {
        let mut frame = Frame::load(frame).expect("is a frame").0;
        frame.sleeve_direction = SleeveDirection::Across;
        Design::new(frame).expect("designs")
    }

    #[test]
    fn analytic_cables_begin_and_end_at_what_they_join() {
        let default = ["board_cable", "sensor_cable", "camera_cable", "computer_cable"];
        let wanted = [
            ("cognifly", design("cognifly"), default.to_vec()),
            ("cognifly across", across("cognifly"), default.to_vec()),
            ("four-inch", design(LONG_RANGE), vec!["gps_cable"]),
            ("four-inch with an analogue camera", analogue(), vec!["gps_cable", "fpv_cable"]),
        ];
        for (frame, design, roles) in wanted {
            let all = cables(&design);
            assert_eq!(all.iter().map(|cable| cable.role).collect::<Vec<_>>(), roles, "{frame}");
            for cable in &all {
                let ends = cable.joins.expect("joins two bodies").map(|name| bounds_mm(&design, name).expect("is there"));
                let [first, last] = [cable.way.first(), cable.way.last()].map(|end| *end.expect("has ends"));
                assert!(outside_mm(&first, ends[0]) < 0.01 && outside_mm(&last, ends[1]) < 0.01, "{frame}: {cable:?} {ends:?}");
                assert!(cable.length_mm() >= (last - first).norm());
                gate::pass(&cable.mesh()).unwrap_or_else(|error| panic!("{frame}, {}: {error}", cable.role));
            }
        }
    }

    /// The cable of what sits on the hub has to pass the plate where there is none.
    #[test]
    fn analytic_a_cable_passes_the_hub_beside_its_plate() {
        let design = design("cognifly");
        let cable = cables(&design).into_iter().find(|cable| cable.role == "computer_cable").expect("has a computer");
        let hub = design.printed.iter().find(|part| part.name == crate::params::PartName::Hub).expect("has a hub");
        let last = cable.way.len() - 1;
        let [above, below] = [cable.way[last - 2], cable.way[last - 1]];
        assert!(above.z > 4.0 && below.z < -4.0);
        assert!(hub.flat.first_hit(above, below).is_none(), "{above} {below}");
    }

    #[test]
    fn planted_a_frame_without_sensors_has_none() {
        assert_eq!(cables(&design("examples/frames/whoop-aio-fpv.toml")), []);
    }
}
