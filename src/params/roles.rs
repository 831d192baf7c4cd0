//! What is bought, by what it is for.

/// Roles of bought parts, how many of each, and the kind that fits. Of `motor_screw` and `stack_spacer` a frame has as many as its motors and boards
/// need, of `tie` those of the bracket alone where nothing lies on the hub.
pub const ROLES: [(&str, u32, &str); 21] = [
    ("motor", 4, "motor"),
    ("propeller", 4, "propeller"),
    ("battery", 1, "battery"),
    ("rod", 1, "rod"),
    ("computer", 1, "board"),
    ("flight_controller", 1, "board"),
    ("motor_controller", 1, "board"),
    ("camera", 1, "camera"),
    ("flow_sensor", 1, "sensor"),
    ("connector", 1, "connector"),
    ("magnet", 2, "magnet"),
    ("motor_screw", 16, "screw"),
    ("stack_screw", 4, "screw"),
    ("stack_nut", 4, "other"),
    ("stack_spacer", 4, "other"),
    ("tie", 4, "other"),
    ("damper", 4, "other"),
    ("receiver", 1, "receiver"),
    ("buzzer", 1, "buzzer"),
    ("gps", 1, "gps"),
    ("fpv_camera", 1, "fpv_camera"),
];

/// How many ties hold the bracket; the others hold what lies on the hub.
pub(super) const BRACKET_TIES: u32 = 2;

/// Roles that no frame can be without.
pub(super) const NEEDED: [&str; 4] = ["motor", "propeller", "battery", "rod"];

/// Roles of the boards that hang under the hub, from there down.
pub const HUNG: [&str; 2] = ["flight_controller", "motor_controller"];

/// Roles that the accessory plate carries.
pub const ACCESSORIES: [&str; 4] = ["receiver", "buzzer", "gps", "fpv_camera"];
