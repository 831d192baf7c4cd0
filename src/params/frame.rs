//! The frame as meant: every number present and within its bounds, every name resolved.

use std::collections::BTreeMap;
use std::f64::consts::SQRT_2;

use super::catalogue::{BoughtPart, Material, Printer};
use super::groups::*;
use super::parameter::Parameter;
use super::sleeve_direction::SleeveDirection;

/// A frame, checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Its name: that of its folder in `out/`.
    pub name: String,
    /// One line about it.
    pub description: String,
    /// Rods.
    pub rods: RodParameters,
    /// Clearances.
    pub fit: FitParameters,
    /// Ring corners.
    pub corner: CornerParameters,
    /// Hub joints.
    pub hub_joint: HubJointParameters,
    /// Forks.
    pub fork: ForkParameters,
    /// Knees.
    pub knee: KneeParameters,
    /// Motor mounts and propellers.
    pub motor_mount: MotorMountParameters,
    /// Hub plate.
    pub hub: HubParameters,
    /// Computer carrier.
    pub pi_carrier: CarrierParameters,
    /// Battery size and mass.
    pub battery: BatteryParameters,
    /// Battery sleeve.
    pub sleeve: SleeveParameters,
    /// How the sleeve lies.
    pub sleeve_direction: SleeveDirection,
    /// Battery bracket.
    pub bracket: BracketParameters,
    /// Battery lid.
    pub lid: LidParameters,
    /// Camera connectors.
    pub camera: CameraParameters,
    /// Accessory plate.
    pub accessories: AccessoryParameters,
    /// Limits.
    pub limits: LimitParameters,
    /// Size to solve the rod lengths for, when the file gives one instead of lengths.
    pub target: Option<TargetSize>,
    /// Material of the joints.
    pub flexible: NamedMaterial,
    /// Material of the rigid centre.
    pub rigid: NamedMaterial,
    /// Material of the rods.
    pub rod_material: NamedMaterial,
    /// The printer.
    pub printer: Printer,
    /// Its name in the catalogue, by which a frame file chooses it.
    pub printer_name: String,
    /// What is bought, by role.
    pub bought: BTreeMap<String, BoughtItem>,
    /// Masses that belong to no part in the catalogue.
    pub extras: BTreeMap<String, Extra>,
}

/// A wanted size; the rod lengths follow from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TargetSize {
    /// Width and depth, mm.
    pub width_mm: f64,
    /// Height, mm.
    pub height_mm: f64,
    /// Tilt of the struts, degrees.
    pub strut_tilt_deg: f64,
}

/// A material and its name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedMaterial {
    /// Name in the catalogue.
    pub name: String,
    /// What it is.
    pub material: Material,
}

/// A bought part in its role.
#[derive(Clone, Debug, PartialEq)]
pub struct BoughtItem {
    /// Name in the catalogue.
    pub name: String,
    /// How many the frame needs.
    pub quantity: u32,
    /// What it is.
    pub part: BoughtPart,
}

/// A mass that is no part of the catalogue.
#[derive(Clone, Debug, PartialEq, serde::Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Extra {
    /// Mass, g.
    pub mass_g: f64,
    /// How it is known.
    pub mass_basis: super::catalogue::MassBasis,
    /// Where it comes from.
    pub source: String,
    /// Where it sits, mm. When left out, its mass is at the parts that it covers, in proportion to their own masses, or else at the hub.
    #[serde(default)]
    #[schemars(with = "[f64; 3]", skip_serializing_if = "Option::is_none")]
    pub position_mm: Option<[f64; 3]>,
    /// Roles of bought parts whose masses are inside this figure and are not counted again.
    #[serde(default)]
    pub covers: Vec<String>,
}

/// All groups' parameters, table by table.
pub fn catalogue() -> impl Iterator<Item = &'static Parameter> {
    [
        RodParameters::CATALOGUE,
        FitParameters::CATALOGUE,
        CornerParameters::CATALOGUE,
        HubJointParameters::CATALOGUE,
        ForkParameters::CATALOGUE,
        KneeParameters::CATALOGUE,
        MotorMountParameters::CATALOGUE,
        HubParameters::CATALOGUE,
        CarrierParameters::CATALOGUE,
        BatteryParameters::CATALOGUE,
        SleeveParameters::CATALOGUE,
        BracketParameters::CATALOGUE,
        LidParameters::CATALOGUE,
        CameraParameters::CATALOGUE,
        AccessoryParameters::CATALOGUE,
        LimitParameters::CATALOGUE,
    ]
    .into_iter()
    .flatten()
}

/// The extra that stands for wires and small parts.
const WIRING: &str = "wiring";

/// Rows of wire holes in the bracket's front upright.
pub const WIRE_ROWS: u8 = 3;

impl Frame {
    /// Inner diameter of the rods, mm: 0 unless the bought rod is a tube.
    pub fn rod_bore_mm(&self) -> f64 {
        let wall_mm = self.bought.get("rod").and_then(|rod| rod.part.wall_mm);
        wall_mm.map_or(0.0, |wall| (self.rods.rod_diameter_mm - 2.0 * wall).max(0.0))
    }

    /// From the hub's axis to the bottoms of the fork's sockets, along the diagonal, mm: an arm that is home ends there, less its slack.
    pub fn fork_bottom_mm(&self) -> f64 {
        self.hub.hub_mouth_mm + self.rods.arm_rod_length_mm + self.rods.arm_rod_slack_mm
    }

    /// Bore that holds a rod, mm.
    pub fn grip_bore_mm(&self) -> f64 {
        self.rods.rod_diameter_mm + self.fit.grip_clearance_mm
    }

    /// Bore in which a rod slides, mm.
    pub fn slide_bore_mm(&self) -> f64 {
        self.rods.rod_diameter_mm + self.fit.slide_clearance_mm
    }

    /// Length that its rods are sold in, mm: a metre of a rod that nobody named.
    pub fn stock_mm(&self) -> f64 {
        self.bought.get("rod").map_or(1000.0, |rod| rod.part.stock_mm())
    }

    /// From the middle between a pair of arms to the outside of its plugs, mm.
    pub fn half_pair_mm(&self) -> f64 {
        0.5 * (self.hub_joint.arm_pitch_mm + self.hub_joint.hub_joint_diameter_mm)
    }

    /// Least distance of the plug bores' mouths from the hub's axis, mm: nearer, the bores of neighbouring arms would meet.
    pub fn least_mouth_mm(&self) -> f64 {
        self.half_pair_mm() + self.hub.hub_boss_wall_mm + self.hub_joint.plug_length_mm
    }

    /// Size of the bought battery as it lies in the sleeve, mm: long, wide, high. A pack may lie on its side, where it then fits better.
    pub fn battery_as_it_lies_mm(&self) -> Option<[f64; 3]> {
        let [long, wide, high] = self.bought.get("battery")?.part.size_mm;
        let b = &self.battery;
        let stated = [b.battery_length_mm, b.battery_width_mm, b.battery_height_mm];
        let missing = |lies: &[f64; 3]| stated.iter().zip(lies).map(|(stated, mm)| (mm - stated).max(0.0)).sum::<f64>();
        let off = |lies: &[f64; 3]| stated.iter().zip(lies).map(|(stated, mm)| (mm - stated).abs()).sum::<f64>();
        [[long, wide, high], [long, high, wide]]
            .into_iter()
            .min_by(|a, b| missing(a).total_cmp(&missing(b)).then(off(a).total_cmp(&off(b))))
    }

    /// From the bracket's underside to the middle of its magnet, mm: above the connector's channel and a wall.
    pub fn magnet_above_underside_mm(&self) -> f64 {
        let b = &self.bracket;
        b.bracket_floor_mm + b.connector_height_mm + b.bracket_wall_mm + 0.5 * (b.magnet_width_mm + b.magnet_clearance_mm)
    }

    /// From the bracket's underside to the middle of its lowest wire holes, mm; those of the first row are as high as the magnet.
    pub fn lowest_wire_holes_mm(&self) -> f64 {
        self.magnet_above_underside_mm() - f64::from(WIRE_ROWS - 1) * self.bracket.wire_hole_pitch_up_mm
    }

    /// From the hub's axis to its ties at the sides, mm: there the outer flanks of neighbouring pairs of arms meet.
    pub fn tie_side_mm(&self) -> f64 {
        (self.half_pair_mm() + self.hub.hub_tie_wall_mm) * SQRT_2
    }

    /// Its extras that are built in: those that cover nothing, and those that stand for a part that is not bought. The others state masses of
    /// what is bought. One that covers nothing and weighs nothing is a base's that the frame does without.
    pub fn built_in_extras(&self) -> impl Iterator<Item = (&String, &Extra)> {
        let is_built_in = |extra: &Extra| match extra.covers.is_empty() {
            true => extra.mass_g > 0.0,
            false => self.replaced(extra).next().is_some(),
        };
        self.extras.iter().filter(move |(_, extra)| is_built_in(extra))
    }

    /// Those of its built-in extras that are bought or made as such: wires and small parts have lines and steps of their own, and stand as one
    /// mass in the file.
    pub fn built_in_things(&self) -> impl Iterator<Item = (&String, &Extra)> {
        self.built_in_extras().filter(|(name, extra)| *name != WIRING || self.replaced(extra).next().is_some())
    }

    /// Roles that an extra stands for: of those that it covers the ones of which nothing is bought.
    pub fn replaced<'a>(&'a self, extra: &'a Extra) -> impl Iterator<Item = &'a str> {
        extra.covers.iter().map(String::as_str).filter(|role| !self.bought.contains_key(*role))
    }

    /// The names of the extras that stand for a role of which nothing is bought.
    pub fn stand_ins<'a>(&'a self, role: &'a str) -> impl Iterator<Item = &'a str> {
        self.extras.iter().filter(move |(_, extra)| self.replaced(extra).any(|covered| covered == role)).map(|(name, _)| name.as_str())
    }

    /// Whether one board under the hub is flight controller and motor controllers.
    pub fn is_all_in_one(&self) -> bool {
        let is_both = |item: &BoughtItem| item.part.all_in_one == Some(true);
        !self.bought.contains_key("flight_controller") && self.bought.get("motor_controller").is_some_and(is_both)
    }

    /// One of its numbers, by table and key.
    pub fn value(&self, table: &str, key: &str) -> Option<f64> {
        match table {
            "rods" => self.rods.value(key),
            "fit" => self.fit.value(key),
            "corner" => self.corner.value(key),
            "hub_joint" => self.hub_joint.value(key),
            "fork" => self.fork.value(key),
            "knee" => self.knee.value(key),
            "motor_mount" => self.motor_mount.value(key),
            "hub" => self.hub.value(key),
            "pi_carrier" => self.pi_carrier.value(key),
            "battery" => self.battery.value(key),
            "sleeve" => self.sleeve.value(key),
            "bracket" => self.bracket.value(key),
            "lid" => self.lid.value(key),
            "camera" => self.camera.value(key),
            "accessories" => self.accessories.value(key),
            "limits" => self.limits.value(key),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_every_parameter_has_its_number() {
        let (frame, _) = Frame::load("cognifly").expect("a preset");
        for p in catalogue() {
            let value = frame.value(p.table, p.key);
            assert!(value.is_some_and(|value| (p.min..=p.max).contains(&value)), "{}.{}: {value:?}", p.table, p.key);
        }
        assert_eq!([frame.value("rods", "hub_mouth_mm"), frame.value("wings", "hub_mouth_mm")], [None, None]);
    }
}
