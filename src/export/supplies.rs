//! What the instructions use up and no catalogue has: filament, glue, tape, solder, wires and cables, and the receiver.
//!
//! **Wires.** Those of motors and battery run as [`wires`](crate::frame::assembly::wires) draws them, and the cables, too. To this way come a share of
//! it, for bends and so that bundles stay slack at the plugs, and a fixed length for two ends to solder or plug. Both are a
//! choice, so a length here is good for buying, not for cutting: measure before you cut.

use crate::frame::assembly::Design;
use crate::frame::assembly::cables::{CABLES, Cable};
use crate::frame::assembly::wire::Wire;
use crate::frame::assembly::wires::wires as drawn_wires;
use crate::frame::fold::Tool;
use crate::frame::mounting::{CameraScrews, CarrierScrews, Fixing, Mount, mounts_of};
use crate::params::frame::NamedMaterial;
use crate::printing::filament::Filament;

/// What a wire is longer than its way: a share of the way, and a length, mm.
const SLACK: (f64, f64) = (0.15, 30.0);
/// Lengths are rounded up to these, mm.
const ROUNDED_MM: f64 = 5.0;
/// Wires of a motor: three phases.
const PHASES: u32 = 3;

/// Something that is used up.
#[derive(Clone, Debug, PartialEq)]
pub struct Supply {
    /// Its role in the bill.
    pub role: String,
    /// How many.
    pub quantity: u32,
    /// Length of one, mm, of wires and cables.
    pub length_mm: Option<f64>,
    /// What to search for.
    pub search: String,
    /// What it is for, and what was assumed.
    pub note: String,
}

impl Supply {
    fn one(role: &str, search: impl Into<String>, note: impl Into<String>) -> Self {
        Self { role: role.into(), quantity: 1, length_mm: None, search: search.into(), note: note.into() }
    }
}

/// All that a design uses up.
pub fn supplies(design: &Design) -> Vec<Supply> {
    let mut all = filaments(design);
    all.extend(glues(design));
    all.extend(fixings(design));
    all.extend(wires(design));
    let has = |role: &str| design.frame.bought.contains_key(role);
    if has("computer") {
        all.push(Supply::one("memory_card", "microSD card", "for the computer, where it has no memory of its own; not weighed"));
        all.push(Supply::one(
            "pin_header",
            "pin header 2.54 mm, two rows",
            "for the computer, where it is sold without pins, as a Raspberry Pi Zero W or Zero 2 W; or solder the leads of its cable on; not weighed",
        ));
    }
    let is_extra = design.frame.extras.contains_key("receiver");
    if !has("receiver") && !is_extra && (has("flight_controller") || has("motor_controller")) {
        all.push(Supply::one(
            "receiver",
            RECEIVER_SEARCH,
            "of your transmitter's protocol, with its leads; weighed with the wiring; not needed where the computer alone flies",
        ));
    }
    all
}

fn filaments(design: &Design) -> Vec<Supply> {
    let (flexible, rigid) = (&design.frame.flexible, &design.frame.rigid);
    let mut materials: Vec<&NamedMaterial> = vec![flexible];
    if rigid.name != flexible.name {
        materials.push(rigid);
    }
    let filament = Filament::of(&design.frame.printer);
    let line = |(at, material): (usize, &NamedMaterial)| {
        let of = design.printed.iter().filter(|part| design.material_of(part.name).name == material.name);
        let mm3: f64 = of.map(|part| part.volume_mm3 * f64::from(part.part.quantity())).sum();
        let (mass_g, metres) = (material.material.printed_g(mm3), filament.length_m(material.material.printed_mm3(mm3)));
        let role = ["filament_flexible", "filament_rigid"][at];
        Supply::one(
            role,
            format!("filament {} mm {}", filament.diameter_mm, material.name.replace('-', " ")),
            format!("{mass_g:.0} g or {metres:.0} m in the parts; skirt and support come on top"),
        )
    };
    materials.into_iter().enumerate().map(line).collect()
}

fn glues(design: &Design) -> Vec<Supply> {
    let glued: Vec<String> = mounts_of(design).iter().filter(|mount| takes(mount, &[Tool::Glue])).map(|mount| words(mount.title)).collect();
    let mut all = Vec::new();
    if !glued.is_empty() {
        let search = format!("two component epoxy glue for {}", design.frame.rigid.name.to_uppercase());
        all.push(Supply::one("glue", search, format!("{} steps: {}", glued.len(), glued.join("; "))));
    }
    all.push(Supply::one(
        "rod_glue",
        "cyanoacrylate glue",
        "a drop on each arm at the rings of the four motor mounts, and for a rod that is loose in its bore; never for a hinge or for the plugs in \
         the hub",
    ));
    all
}

/// A title within a sentence.
fn words(title: &str) -> String {
    let mut letters = title.chars();
    letters.next().map_or(String::new(), |first| first.to_lowercase().chain(letters).collect())
}

/// What to search for where no receiver is chosen.
pub const RECEIVER_SEARCH: &str = "radio receiver serial output";

/// Role of the ties that are narrower than those of the bracket.
pub const SMALL_TIE: &str = "small_tie";

/// Role of the screws that fasten computer and cameras.
const SMALL_SCREWS: &str = "small_screws";

/// What the steps fix with: role, words of a shop's search, and whether a mount needs it.
type FixedWith = (&'static str, &'static str, fn(&Mount) -> bool);

/// Tape, small screws and ties, varnish, and solder.
const FIXED_WITH: [FixedWith; 7] = [
    ("tape", "electrical insulating tape", |mount| takes(mount, &[Tool::Tape])),
    ("double_sided_tape", "thin double sided adhesive tape", |mount| takes(mount, &[Tool::DoubleSidedTape])),
    ("foam_tape", "double sided foam tape 1 mm", |mount| takes(mount, &[Tool::FoamTape])),
    (SMALL_SCREWS, "assortment of M2 and M2.5 screws 4 to 10 mm with nuts and washers", |mount| mount.fixing == Fixing::SmallScrews),
    (SMALL_TIE, "cable tie 2 mm wide", |mount| takes(mount, &[Tool::SmallTie])),
    ("varnish", "nail varnish", |mount| takes(mount, &[Tool::Varnish])),
    ("solder", "solder wire for electronics and heat shrink tube", |mount| takes(mount, &[Tool::Solder])),
];

fn takes(mount: &Mount, any: &[Tool]) -> bool {
    any.iter().any(|tool| mount.tools.contains(tool))
}

/// How many of which screws computer and camera take, where that is known.
fn sizes_of_screws(design: &Design) -> String {
    let of_computer = CarrierScrews::new(&design.frame).map(|screws| {
        let on_board = screws.words(screws.on_board);
        match screws.on_feet {
            Some(on_feet) => format!("; the computer takes 2 x {on_board} and 2 x {}", screws.words(on_feet)),
            None => format!("; the computer takes 4 x {on_board}"),
        }
    });
    let of_camera = CameraScrews::new(&design.frame).map(|screws| format!("; the camera takes {}", screws.bill_words()));
    of_computer.into_iter().chain(of_camera).collect()
}

/// What a design's mounts fix with. Of small ties each mount takes one; of the rest one package is enough.
fn fixings(design: &Design) -> Vec<Supply> {
    let mounts = mounts_of(design);
    let line = |(role, search, needs): FixedWith| {
        let used: Vec<String> = mounts.iter().filter(|mount| needs(mount)).map(|mount| words(mount.title)).collect();
        let quantity = if role == SMALL_TIE { used.len() as u32 } else { 1 };
        let sizes = if role == SMALL_SCREWS { sizes_of_screws(design) } else { String::new() };
        (!used.is_empty()).then(|| Supply { quantity, ..Supply::one(role, search, format!("for {}{sizes}", used.join("; "))) })
    };
    FIXED_WITH.into_iter().filter_map(line).collect()
}

fn wires(design: &Design) -> Vec<Supply> {
    let drawn = drawn_wires(design);
    let longest = |role: &str| drawn.iter().filter(|wire| wire.role == role).map(Wire::length_mm).reduce(f64::max);
    let mut all = Vec::new();
    if let Some(way_mm) = longest("motor_wire") {
        let quantity = PHASES * design.frame.bought.get("motor").map_or(4, |item| item.quantity);
        let length_mm = with_slack(way_mm);
        all.push(Supply {
            role: "motor_wire".into(),
            quantity,
            length_mm: Some(length_mm),
            search: format!("silicone stranded wire {:.1} m", (1e-2 * f64::from(quantity) * length_mm).ceil() / 10.0),
            note: format!(
                "motor to controller along the arm {way_mm:.0} mm, as drawn in frame.glb; {}; as thick as the motor's own, and none where those reach",
                slack_words()
            ),
        });
    }
    if let Some(way_mm) = longest("battery_wire") {
        all.push(Supply {
            role: "battery_wire".into(),
            quantity: 2,
            length_mm: Some(with_slack(way_mm)),
            search: BATTERY_WIRE_SEARCH.into(),
            note: format!("power connector to controller {way_mm:.0} mm, as drawn in frame.glb; {}", slack_words()),
        });
    }
    let has = |role: &str| design.frame.bought.contains_key(role);
    if has("connector") && longest("battery_wire").is_none() {
        all.push(Supply {
            quantity: 2,
            ..Supply::one(
                "battery_wire",
                BATTERY_WIRE_SEARCH,
                "power connector to what drives the motors: where that is is not known, so measure how long they have to be",
            )
        });
    }
    for Cable { role, search, begins, .. } in &CABLES {
        let Some(cable) = drawn.iter().find(|wire| wire.role == *role) else { continue };
        let (way, to) = (cable.length_mm(), cable.joins.map_or_else(String::new, |[_, to]| to.replace('_', " ")));
        all.push(Supply {
            role: (*role).into(),
            quantity: 1,
            length_mm: Some(with_slack(way)),
            search: shop_words(design, cable.role, search),
            note: format!(
                "{begins} to {to} {way:.0} mm, as drawn in frame.glb; {}{}",
                slack_words(),
                if *role == RIBBON { OF_RIBBON } else { "" }
            ),
        });
    }
    all
}

const BATTERY_WIRE_SEARCH: &str = "silicone stranded wire as thick as the connector's";

/// The cable that is sold in certain lengths and cannot be cut.
const RIBBON: &str = "camera_cable";
const OF_RIBBON: &str = "; a ribbon is not cut: take the next longer one, with the sockets of both";

/// The words for a cable. A ribbon has the sockets of what it joins, so that it goes by their names.
fn shop_words(design: &Design, role: &str, words: &str) -> String {
    let name = |role: &str| design.frame.bought.get(role).map(|item| item.name.replace('-', " "));
    match (name("camera"), name("computer")) {
        (Some(camera), Some(computer)) if role == RIBBON => format!("camera ribbon cable {camera} to {computer}"),
        _ => words.into(),
    }
}

fn slack_words() -> String {
    format!("{:.0} % and {:.0} mm slack", 100.0 * SLACK.0, SLACK.1)
}

/// A way with slack, rounded up, mm.
fn with_slack(way_mm: f64) -> f64 {
    (((1.0 + SLACK.0) * way_mm + SLACK.1) / ROUNDED_MM).ceil() * ROUNDED_MM
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::assembly::mass;
    use crate::frame::assembly::mass::{LineKind, MassLine};
    use crate::params::{Frame, FrameFile};

    fn frame(preset: &str) -> Frame {
        Frame::resolve(&FrameFile::load(preset).expect("is a preset")).expect("resolves")
    }

    fn line(all: &[Supply], role: &str) -> Supply {
        all.iter().find(|one| one.role == role).cloned().unwrap_or_else(|| panic!("no {role}: {all:?}"))
    }

    #[test]
    fn analytic_motor_wires_reach_from_the_motor_to_the_middle_with_slack() {
        let [short, long] = [0.0, 6.0].map(|further| {
            let mut frame = frame("cognifly");
            frame.motor_mount.motor_position_mm -= further;
            let design = Design::new(frame).expect("can be made");
            line(&supplies(&design), "motor_wire")
        });
        // The motor stands on the diagonal; the controller hangs under the hub's middle.
        let position = frame("cognifly").motor_mount.motor_position_mm;
        let length = short.length_mm.expect("a length");
        assert!(length > 1.15 * position + 30.0 && length < 1.15 * (position + 40.0) + 35.0, "{short:?}");
        assert_eq!(short.quantity, 12);
        assert!((length - long.length_mm.expect("a length") - 1.15 * 6.0).abs() <= ROUNDED_MM, "{short:?} {long:?}");
    }

    #[test]
    fn analytic_filament_is_what_the_printed_parts_weigh() {
        let mut frame = frame("cognifly");
        frame.flexible.material.print_factor = 0.9;
        let design = Design::new(frame).expect("can be made");
        let own = |line: &&MassLine| line.kind == LineKind::Printed && line.material == design.frame.flexible.name;
        let printed_g: f64 = mass::table(&design).lines.iter().filter(own).map(|line| line.total_g).sum();
        let note = line(&supplies(&design), "filament_flexible").note;
        assert!(note.starts_with(&format!("{printed_g:.0} g or ")), "{printed_g} {note}");
    }

    /// The accessories of docs/frame-files.md: a receiver on foam tape under a small tie, a buzzer under another, a GPS on foam tape, its cable taped to the mast.
    #[test]
    fn planted_accessories_ask_for_foam_tape_and_a_small_tie_each() {
        let text = "base = \"cognifly\"\n[bought]\ncomputer = \"none\"\ncamera = \"none\"\nreceiver = \"receiver-nano\"\nbuzzer = \"buzzer-9mm\"\ngps = \"gps-22x20\"\n";
        let file = FrameFile::parse("own.toml", text).expect("reads");
        let all = supplies(&Design::new(Frame::resolve(&file).expect("resolves")).expect("can be made"));
        assert_eq!(line(&all, SMALL_TIE).quantity, 2);
        let foam = line(&all, "foam_tape").note;
        assert!(foam.contains("receiver onto the plate") && foam.contains("GPS"), "{foam}");
        assert!(line(&all, "tape").note.contains("GPS"), "its cable is taped to the mast");
        assert!(all.iter().all(|one| one.role != "receiver"), "the chosen receiver is bought once: {all:?}");
    }

    /// Single controllers have their terminals where nobody knows; the connector's leads are soldered all the same.
    #[test]
    fn planted_leads_of_the_connector_are_bought_without_a_board_under_the_hub() {
        let of = |bought: &str, covers: &str| {
            let extra = format!("mass_g = 14.0\nmass_basis = \"estimate\"\nsource = \"a guess\"\ncovers = {covers}\n");
            let text = format!("base = \"cognifly\"\n[bought]\n{bought}[extras.own]\n{extra}");
            let file = FrameFile::parse("own.toml", &text).expect("reads");
            supplies(&Design::new(Frame::resolve(&file).expect("resolves")).expect("can be made"))
        };
        let wire = line(&of("motor_controller = \"none\"\n", "[\"motor_controller\"]"), "battery_wire");
        assert!(wire.quantity == 2 && wire.length_mm.is_none() && wire.note.contains("measure how long"), "{wire:?}");
        let bare = of("motor_controller = \"none\"\nconnector = \"none\"\n", "[\"motor_controller\", \"connector\"]");
        assert!(bare.iter().all(|one| one.role != "battery_wire"), "{bare:?}");
    }

    #[test]
    fn analytic_screws_of_computer_and_camera_have_numbers_and_sizes() {
        let note = line(&supplies(&Design::new(frame("cognifly")).expect("can be made")), SMALL_SCREWS).note;
        assert!(note.ends_with("the computer takes 2 x M2 x 4 and 2 x M2 x 8; the camera takes 4 x M2 x 8 with nuts"), "{note}");
    }

    #[test]
    fn planted_a_receiver_among_the_extras_is_bought_once() {
        let text = "base = \"cognifly\"\n[extras.receiver]\nmass_g = 1.5\nmass_basis = \"datasheet\"\nsource = \"its maker\"\n";
        let file = FrameFile::parse("own.toml", text).expect("reads");
        let design = Design::new(Frame::resolve(&file).expect("resolves")).expect("can be made");
        assert!(supplies(&design).iter().all(|one| one.role != "receiver"));
    }

    #[test]
    fn analytic_a_computer_has_its_card_its_pins_and_the_ribbon_of_its_camera() {
        let whole = supplies(&Design::new(frame("cognifly")).expect("can be made"));
        assert_eq!(line(&whole, "camera_cable").search, "camera ribbon cable pi camera v2 to pi zero w");
        assert!(line(&whole, "camera_cable").note.contains("a ribbon is not cut"));
        let bare = FrameFile::parse("own.toml", "base = \"cognifly\"\n[bought]\ncomputer = \"none\"\ncamera = \"none\"\n").expect("reads");
        let bare = supplies(&Design::new(Frame::resolve(&bare).expect("resolves")).expect("can be made"));
        for role in ["memory_card", "pin_header"] {
            assert_eq!(line(&whole, role).quantity, 1);
            assert!(bare.iter().all(|one| one.role != role), "{bare:?}");
        }
    }

    #[test]
    fn analytic_every_step_that_solders_is_among_those_of_the_solder() {
        let solder = line(&supplies(&Design::new(frame("cognifly")).expect("can be made")), "solder").note;
        for step in ["power connector into the bracket", "bracket under the hub", "motor wires", "power connector into the lid"] {
            assert!(solder.contains(step), "{step}: {solder}");
        }
    }

    #[test]
    fn planted_what_a_frame_lacks_is_not_supplied() {
        let whole = supplies(&Design::new(frame("cognifly")).expect("can be made"));
        let mut bare = frame("cognifly");
        for role in ["camera", "flow_sensor"] {
            bare.bought.remove(role);
        }
        let bare = supplies(&Design::new(bare).expect("can be made"));
        for role in ["camera_cable", "sensor_cable"] {
            assert!(line(&whole, role).length_mm.is_some_and(|mm| mm > 30.0));
            assert!(bare.iter().all(|one| one.role != role), "{bare:?}");
        }
        // Without a camera its connectors are not glued.
        let joints = |all: &[Supply]| line(all, "glue").note.matches(';').count() + 1;
        assert_eq!((joints(&whole), joints(&bare)), (7, 6));
        let rods = line(&whole, "rod_glue");
        assert!(rods.search.contains("cyanoacrylate") && rods.note.contains("four motor mounts"), "{rods:?}");
    }
}
