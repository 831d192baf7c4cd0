//! The mass table: what weighs how much, how that is known, and where it sits.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Matrix3, Point3, Vector3};
use serde::{Deserialize, Serialize};

use super::body::{Body, BodyKind, Shape};
use super::design::Design;
use crate::params::PartName;
use crate::params::catalogue::MassBasis;
use crate::params::frame::{BoughtItem, Extra, Frame};

/// What a line of the table is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LineKind {
    /// A printed part.
    Printed,
    /// A rod.
    Rod,
    /// A bought part.
    Bought,
    /// A mass that a frame file states.
    Extra,
}

impl LineKind {
    /// Its word in tables.
    pub fn word(self) -> &'static str {
        match self {
            Self::Printed => "printed",
            Self::Rod => "rod",
            Self::Bought => "bought",
            Self::Extra => "extra",
        }
    }
}

/// A line of the table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MassLine {
    /// What: a part, a rod, a role.
    pub name: String,
    /// What that is.
    pub kind: LineKind,
    /// Material or catalogue name.
    pub material: String,
    /// How many.
    pub quantity: u32,
    /// Mass of one, g; 0 when another line covers it.
    pub each_g: f64,
    /// Mass of all, g.
    pub total_g: f64,
    /// `computed`, `measured`, `datasheet`, `estimate`, or the line that covers it.
    pub basis: String,
}

/// Masses of a frame and where they sit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MassTable {
    /// Line by line.
    pub lines: Vec<MassLine>,
    /// All together, g.
    pub total_g: f64,
    /// The part of it that rests on estimates, g.
    pub estimated_g: f64,
    /// Centre of mass in frame axes, mm.
    pub centre_of_mass_mm: [f64; 3],
    /// Inertia about the centre of mass, frame axes, g mm².
    pub inertia_g_mm2: [[f64; 3]; 3],
}

impl MassTable {
    /// The line of a kind with a name: an extra may have that of a part.
    pub fn line(&self, kind: LineKind, name: &str) -> Option<&MassLine> {
        self.lines.iter().find(|line| line.kind == kind && line.name == name)
    }

    /// The line of a bought part, by its role.
    pub fn bought(&self, role: &str) -> Option<&MassLine> {
        self.line(LineKind::Bought, role)
    }

    /// The line of a printed part.
    pub fn printed(&self, part: PartName) -> Option<&MassLine> {
        self.line(LineKind::Printed, part.slug())
    }
}

impl MassLine {
    /// Where size and mass of a bought part come from, whose catalogue entry names this source.
    pub fn source(&self, of_entry: &str) -> String {
        if self.basis == STATED { format!("mass: the frame file; otherwise {of_entry}") } else { of_entry.into() }
    }
}

/// Some lines of the table as one lump.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lump {
    /// Mass, g.
    pub mass_g: f64,
    /// Centre of mass in frame axes, mm.
    pub centre_mm: Point3<f64>,
    /// Inertia about the centre of mass, frame axes, g mm².
    pub inertia_g_mm2: Matrix3<f64>,
}

/// Lines of the table taken together; everything at the origin when they weigh nothing.
pub fn lump(design: &Design, lines: &[MassLine]) -> Lump {
    lump_of(design, lines, &|_| true)
}

/// The part of the lines that is represented by some bodies; `None` is the mass without a body, at the hub or at an extra's position.
pub fn lump_of(design: &Design, lines: &[MassLine], carries: &dyn Fn(Option<&Body>) -> bool) -> Lump {
    let sum = moments(design, lines, carries);
    let centre = if sum.mass > 0.0 { sum.first / sum.mass } else { Vector3::zeros() };
    let inertia_g_mm2 = sum.about_origin - (Matrix3::identity() * centre.norm_squared() - centre * centre.transpose()) * sum.mass;
    Lump { mass_g: sum.mass, centre_mm: centre.into(), inertia_g_mm2 }
}

/// Sums mass, first moment and inertia about the origin.
#[derive(Default)]
struct Sum {
    mass: f64,
    first: Vector3<f64>,
    about_origin: Matrix3<f64>,
}

impl Sum {
    fn add(&mut self, mass_g: f64, centre: Point3<f64>, own_inertia: Matrix3<f64>) {
        let r = centre.coords;
        self.mass += mass_g;
        self.first += r * mass_g;
        self.about_origin += own_inertia + (Matrix3::identity() * r.norm_squared() - r * r.transpose()) * mass_g;
    }
}

/// Makes the table of a design.
pub fn table(design: &Design) -> MassTable {
    let mut lines = printed_lines(design);
    lines.extend(rod_lines(design));
    lines.extend(bought_lines(design));
    lines.extend(extra_lines(design));
    let total_g = lines.iter().map(|line| line.total_g).sum();
    let estimated_g = lines.iter().filter(|line| line.basis == "estimate").map(|line| line.total_g).sum();
    let Lump { centre_mm, inertia_g_mm2: about_centre, .. } = lump(design, &lines);
    let row = |i: usize| [about_centre[(i, 0)], about_centre[(i, 1)], about_centre[(i, 2)]];
    MassTable { lines, total_g, estimated_g, centre_of_mass_mm: centre_mm.into(), inertia_g_mm2: [row(0), row(1), row(2)] }
}

fn printed_lines(design: &Design) -> Vec<MassLine> {
    design
        .printed
        .iter()
        .map(|part| {
            let material = design.material_of(part.name);
            let each_g = material.material.printed_g(part.volume_mm3);
            let quantity = part.part.quantity();
            line(part.name.slug(), LineKind::Printed, &material.name, quantity, each_g, "computed")
        })
        .collect()
}

fn rod_lines(design: &Design) -> Vec<MassLine> {
    let material = &design.frame.rod_material;
    let covered = covering(design, "rod");
    let weighed = |shape: &Shape| match shape.kind {
        BodyKind::Rod(role) => {
            let each_g = rod_g(design, shape);
            let quantity = design.skeleton.rods_of(role).count() as u32;
            Some(match covered {
                Some(extra) => line(&shape.name, LineKind::Rod, &material.name, quantity, 0.0, &format!("in {extra}")),
                None => line(&shape.name, LineKind::Rod, &material.name, quantity, each_g, "computed"),
            })
        }
        _ => None,
    };
    design.shapes.iter().filter_map(weighed).collect()
}

/// Basis of a mass that the frame file states in place of the catalogue's.
const STATED: &str = "stated";

fn bought_lines(design: &Design) -> Vec<MassLine> {
    let frame = &design.frame;
    frame
        .bought
        .iter()
        .filter(|(role, _)| *role != "rod")
        .map(|(role, item)| {
            let mass_g = each_g(frame, role, item);
            let basis = if mass_g == item.part.mass_g { basis(item.part.mass_basis) } else { STATED };
            match covering(design, role) {
                Some(extra) => line(role, LineKind::Bought, &item.name, item.quantity, 0.0, &format!("in {extra}")),
                None => line(role, LineKind::Bought, &item.name, item.quantity, mass_g, basis),
            }
        })
        .collect()
}

/// Mass of one bought part, g: of the battery what the frame states, which is that of the catalogue where nothing else is stated.
fn each_g(frame: &Frame, role: &str, item: &BoughtItem) -> f64 {
    if role == "battery" { frame.battery.battery_mass_g } else { item.part.mass_g }
}

/// What the parts of a role weigh together without an extra that covers them, g: rods by their volume, others as they are weighed.
pub fn uncovered_g(design: &Design, role: &str) -> f64 {
    if role == "rod" {
        let rods = design.shapes.iter().filter_map(|shape| match shape.kind {
            BodyKind::Rod(rod) => Some(rod_g(design, shape) * design.skeleton.rods_of(rod).count() as f64),
            _ => None,
        });
        return rods.sum();
    }
    design.frame.bought.get(role).map_or(0.0, |item| each_g(&design.frame, role, item) * f64::from(item.quantity))
}

/// Mass of one rod, g.
fn rod_g(design: &Design, shape: &Shape) -> f64 {
    let volume_mm3 = shape.exact_mm3.unwrap_or_else(|| shape.solid.volume_mm3());
    design.frame.rod_material.material.solid_g(volume_mm3)
}

/// The extra in whose mass that of a role is contained.
pub fn covering<'a>(design: &'a Design, role: &str) -> Option<&'a str> {
    let covering = design.frame.extras.iter().filter(|(_, extra)| extra.covers.iter().any(|covered| covered == role));
    // One that weighs nothing, as of a base that the frame does without, has no line.
    covering.max_by_key(|(_, extra)| extra.mass_g > 0.0).map(|(name, _)| name.as_str())
}

fn extra_lines(design: &Design) -> Vec<MassLine> {
    let extras = design.frame.extras.iter().filter(|(_, extra)| extra.mass_g > 0.0);
    extras.map(|(name, extra)| line(name, LineKind::Extra, "", 1, extra.mass_g, basis(extra.mass_basis))).collect()
}

fn line(name: &str, kind: LineKind, material: &str, quantity: u32, each_g: f64, basis: &str) -> MassLine {
    let total_g = each_g * f64::from(quantity);
    MassLine { name: name.into(), kind, material: material.into(), quantity, each_g, total_g, basis: basis.into() }
}

fn basis(basis: MassBasis) -> &'static str {
    match basis {
        MassBasis::Measured => "measured",
        MassBasis::Datasheet => "datasheet",
        MassBasis::Estimate => "estimate",
    }
}

/// The extra that a line is of.
fn extra_of<'a>(design: &'a Design, line: &MassLine) -> Option<&'a Extra> {
    design.frame.extras.get(&line.name).filter(|_| line.kind == LineKind::Extra)
}

/// The bodies that stand for a line, each with its weight among them; none for a line without a body, and for an extra with a place of its own.
fn carriers<'a>(design: &'a Design, line: &MassLine) -> Vec<(&'a Body, f64)> {
    let weight = |body: &Body| design.shape(body).kind.weight(&design.frame);
    // An extra is where its file says, whatever its name is.
    match extra_of(design, line) {
        Some(Extra { position_mm: Some(_), .. }) => Vec::new(),
        Some(extra) => {
            let roles: BTreeSet<&String> = extra.covers.iter().collect();
            let mut bodies: Vec<(&Body, f64)> = roles.into_iter().flat_map(|role| carriers_of_role(design, role)).collect();
            // Of parts that are stated to weigh nothing, each is as likely to carry it.
            if bodies.iter().all(|(_, weight)| *weight == 0.0) {
                bodies.iter_mut().for_each(|(_, weight)| *weight = 1.0);
            }
            bodies
        }
        None => {
            let bodies = design.bodies.iter().filter(|body| design.shape(body).kind.bill_line() == line.name);
            bodies.map(|body| (body, weight(body))).collect()
        }
    }
}

/// The bodies of a role, each with the mass that it would have by itself, g.
fn carriers_of_role<'a>(design: &'a Design, role: &str) -> Vec<(&'a Body, f64)> {
    let is_of_role = |body: &&Body| match design.shape(body).kind {
        BodyKind::Rod(_) => role == "rod",
        BodyKind::Printed(_) => false,
        kind => kind.bill_line() == role,
    };
    let weight = |body: &&Body| match design.shape(body) {
        shape if matches!(shape.kind, BodyKind::Rod(_)) => rod_g(design, shape),
        shape => shape.kind.weight(&design.frame),
    };
    let bodies: Vec<&Body> = design.bodies.iter().filter(is_of_role).collect();
    let (all, role_g) = (bodies.iter().map(weight).sum::<f64>(), uncovered_g(design, role));
    bodies.into_iter().map(|body| (body, weight(&body) / all * role_g)).collect()
}

/// Each line's mass over the bodies that stand for it; lines without a body sit at the hub, extras at their position.
fn moments(design: &Design, lines: &[MassLine], carries: &dyn Fn(Option<&Body>) -> bool) -> Sum {
    let mut sum = Sum::default();
    // The four modules share their shapes.
    let mut known: BTreeMap<usize, (Point3<f64>, Matrix3<f64>, f64)> = BTreeMap::new();
    for line in lines {
        let bodies = carriers(design, line);
        let all: f64 = bodies.iter().map(|(_, weight)| weight).sum();
        for (body, weight) in bodies.iter().filter(|(body, weight)| *weight > 0.0 && carries(Some(body))) {
            let share = line.total_g * weight / all;
            let (centre, unit_inertia, volume_mm3) = *known.entry(body.shape).or_insert_with(|| {
                let shape = design.shape(body);
                let of_volume = || {
                    let (centre, unit_inertia) = shape.mesh.moments();
                    (centre, unit_inertia, shape.mesh.volume_mm3())
                };
                *design.memo.hold("moments of volume", &shape.solid.key(), of_volume)
            });
            let turn = body.pose.rotation.to_rotation_matrix();
            let density = share / volume_mm3;
            let own = turn.matrix() * unit_inertia * turn.matrix().transpose() * density;
            sum.add(share, body.pose * centre, own);
        }
        if all == 0.0 && carries(None) {
            let at = extra_of(design, line).and_then(|extra| extra.position_mm).unwrap_or_default();
            sum.add(line.total_g, Point3::from(at), Matrix3::zeros());
        }
    }
    sum
}
