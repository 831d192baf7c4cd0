//! A part as short beams: what its own mesh shows along its load paths.
//!
//! A path is a row of stops in the flat part. Between two stops a cut through the part's mesh gives the section; the nodes lie
//! on the line through the sections' centres. Folding moves each stop rigidly, so that a web keeps its section and a row of
//! stops at one pivot, turned step by step, makes the swept web of the fold.

use nalgebra::{Isometry3, Point3, Vector3};

use super::section::Section;
use crate::solid::{CutPlane, Mesh};

/// What a node of a part meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Port {
    /// A rod in its bore.
    Rod,
    /// The hub around a plug.
    Hub,
    /// The bar in the knee's window, seen from the fork.
    Bar,
    /// The window around the bar.
    Window,
    /// The ground.
    Foot,
    /// The motor.
    Motor,
}

/// A node's share of a meeting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// With what.
    pub port: Port,
    /// The node.
    pub node: usize,
    /// Where, in the part's folded axes, mm.
    pub place: Vector3<f64>,
    /// Length of bore or plug that the node stands for, mm.
    pub length_mm: f64,
}

/// A stop of a path.
#[derive(Clone, Debug)]
pub struct Stop {
    /// In the flat part.
    pub at: Point3<f64>,
    /// Direction of the path there, for stops that share a place.
    pub along: Vector3<f64>,
    /// What folding does to it.
    pub motion: Isometry3<f64>,
    /// What the piece that follows is called.
    pub zone: &'static str,
}

/// A short beam of a part.
#[derive(Clone, Debug)]
pub struct PlannedBeam {
    /// Its nodes.
    pub nodes: [usize; 2],
    /// Its section, folded.
    pub section: Section,
    /// What it is called.
    pub zone: &'static str,
}

/// A part as beams, in its folded axes.
#[derive(Clone, Debug, Default)]
pub struct Plan {
    /// Nodes, mm.
    pub nodes: Vec<Vector3<f64>>,
    /// Beams.
    pub beams: Vec<PlannedBeam>,
    /// Pairs of nodes that stay as they are to each other.
    pub links: Vec<[usize; 2]>,
    /// Faces of a folded notch that press on each other: nodes, place, area and length of what is pressed.
    pub presses: Vec<Press>,
    /// What it meets.
    pub meetings: Vec<Meeting>,
}

/// Faces that press on each other.
#[derive(Clone, Copy, Debug)]
pub struct Press {
    /// On both sides.
    pub nodes: [usize; 2],
    /// Where, mm.
    pub place: Vector3<f64>,
    /// Area, mm².
    pub area_mm2: f64,
    /// Length that is compressed, mm.
    pub length_mm: f64,
}

/// A mesh could not be cut on a path of its part.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("the {zone} has no section at {at:?} mm of its part")]
pub struct NoSection {
    /// Which piece.
    pub zone: &'static str,
    /// Where.
    pub at: [f64; 3],
}

impl Plan {
    /// Adds a node.
    pub fn node(&mut self, place: Vector3<f64>) -> usize {
        self.nodes.push(place);
        self.nodes.len() - 1
    }

    /// Adds a path; the numbers of its nodes. `up` is the second axis of the cuts.
    ///
    /// # Errors
    /// When the mesh is not met between two stops.
    pub fn strand(&mut self, mesh: &Mesh, stops: &[Stop], up: &Vector3<f64>) -> Result<Vec<usize>, NoSection> {
        let mut sections = Vec::with_capacity(stops.len().saturating_sub(1));
        for pair in stops.windows(2) {
            let way = pair[1].at - pair[0].at;
            let along = if way.norm() > 1e-6 { way } else { pair[0].along };
            let middle = nalgebra::center(&pair[0].at, &pair[1].at);
            let none = || NoSection { zone: pair[0].zone, at: middle.coords.into() };
            let plane = CutPlane::across(middle, &along, up).ok_or_else(none)?;
            sections.push((middle, Section::cut(mesh, &plane).ok_or_else(none)?));
        }
        let offset = |at: usize| {
            let beside: Vec<Vector3<f64>> = [at.checked_sub(1), Some(at)]
                .into_iter()
                .flatten()
                .filter_map(|i| sections.get(i))
                .map(|(m, s)| s.centre - m.coords)
                .collect();
            beside.iter().sum::<Vector3<f64>>() / beside.len().max(1) as f64
        };
        let nodes: Vec<usize> = stops
            .iter()
            .enumerate()
            .map(|(at, stop)| (stop.motion * (stop.at + offset(at))).coords)
            .map(|place| self.node(place))
            .collect();
        for (at, (_, section)) in sections.iter().enumerate() {
            let motion = stops[at].motion.lerp_slerp(&stops[at + 1].motion, 0.5);
            let section = section.moved(&motion);
            self.beams.push(PlannedBeam { nodes: [nodes[at], nodes[at + 1]], section, zone: stops[at].zone });
        }
        Ok(nodes)
    }

    /// Holds nodes rigidly to each other.
    pub fn link(&mut self, a: usize, b: usize) {
        if (self.nodes[a] - self.nodes[b]).norm() > 1e-3 {
            self.links.push([a, b]);
        } else {
            // The same place: the one stands for the other.
            self.replace(b, a);
        }
    }

    fn replace(&mut self, old: usize, new: usize) {
        let swap = |node: &mut usize| {
            if *node == old {
                *node = new;
            }
        };
        self.beams.iter_mut().flat_map(|beam| &mut beam.nodes).for_each(swap);
        self.links.iter_mut().flatten().for_each(swap);
        self.presses.iter_mut().flat_map(|press| &mut press.nodes).for_each(swap);
        self.meetings.iter_mut().for_each(|meeting| swap(&mut meeting.node));
    }

    /// Nodes along a bore or plug meet something; each stands for half of the way to its neighbours.
    pub fn meet(&mut self, port: Port, nodes: &[usize], places: &[Vector3<f64>]) {
        for at in 0..nodes.len() {
            let half = |other: Option<&Vector3<f64>>| other.map_or(0.0, |p| 0.5 * (p - places[at]).norm());
            let length_mm = half(at.checked_sub(1).map(|before| &places[before])) + half(places.get(at + 1));
            self.meetings.push(Meeting { port, node: nodes[at], place: places[at], length_mm });
        }
    }
}

/// Distances from one to another in steps of at most a length, both ends among them.
pub fn steps(from: f64, to: f64, most: f64) -> Vec<f64> {
    let count = ((to - from).abs() / most - 1e-9).ceil().max(1.0) as usize;
    (0..=count).map(|at| from + (to - from) * at as f64 / count as f64).collect()
}

/// A straight path along a direction: stops at distances, in the zones that begin at given distances.
pub fn straight(
    from: Point3<f64>,
    direction: Vector3<f64>,
    distances: &[f64],
    zones: &[(f64, &'static str)],
    motion: Isometry3<f64>,
) -> Vec<Stop> {
    let zone = |d: f64| zones.iter().rev().find(|(start, _)| d + 1e-6 >= *start).or(zones.first()).map_or("", |(_, name)| name);
    distances.iter().map(|d| Stop { at: from + direction * *d, along: direction, motion, zone: zone(*d) }).collect()
}
