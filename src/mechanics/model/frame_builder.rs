//! Putting a frame's structure together: parts where they sit, ties, feet, motors; rods in [`rods`].

mod rods;

use nalgebra::{Isometry3, Matrix3, Vector3};

use super::frame_model::{Extent, FrameModel, LINKS, RodLine, Skin, Tag};
use super::model_error::ModelError;
use super::weights::Weights;
use crate::frame::assembly::Design;
use crate::mechanics::element::beam::Beam;
use crate::mechanics::element::bushing::Bushing;
use crate::mechanics::element::foot::Foot;
use crate::mechanics::parts::parts_plan::PartModel;
use crate::mechanics::parts::plan::Port;
use crate::mechanics::parts::section::{Elastic, Section};
use crate::mechanics::settings::MechanicsSettings;
use crate::mechanics::system::equation_system::System;
use crate::mechanics::system::structure::{Node, Structure};

/// Stiffness of what holds nodes rigidly to each other, MPa, and its radius, mm: so many times that of the joints' material, which leaves
/// links 0.5 % of the energy, and not less than for TPU 95A.
const LINK: (Elastic, f64) = (Elastic { young_mpa: 2e4, shear_mpa: 8e3 }, 2.0);
const LINK_OVER_JOINTS: f64 = 300.0;

/// How deep the feet stand in the ground at rest, mm: enough that the contact is active.
pub(in crate::mechanics) const TOUCH_MM: f64 = 1e-5;

/// A meeting in the frame's axes that waits for its other side.
struct Waiting {
    port: Port,
    node: usize,
    place: Vector3<f64>,
    length_mm: f64,
}

/// A structure in the making.
pub(in crate::mechanics) struct Builder<'a> {
    design: &'a Design,
    settings: &'a MechanicsSettings,
    extent: Extent,
    weights: Weights,
    structure: Structure,
    ties: Vec<(Bushing, Tag, bool)>,
    tags: Vec<Tag>,
    waiting: Vec<Waiting>,
    hub: usize,
    rods: Vec<RodLine>,
    motors: Vec<usize>,
    skins: Vec<Skin>,
}

impl<'a> Builder<'a> {
    pub(in crate::mechanics) fn new(design: &'a Design, settings: &'a MechanicsSettings, extent: Extent, weights: Weights) -> Self {
        let mut structure = Structure::default();
        let centre = &weights.centre;
        let share = 1.0 / extent.copies();
        let mut hub = Node::at(if extent == Extent::Quarter { Vector3::z() * centre.centre_mm.z } else { centre.centre_mm.coords });
        hub.mass_g = centre.mass_g * share;
        hub.inertia_g_mm2 = [0, 1, 2].map(|i| centre.inertia_g_mm2[(i, i)] * share);
        if extent == Extent::Quarter {
            hub.held = [true, true, false, true, true, true];
        }
        structure.nodes.push(hub);
        let (ties, tags, waiting, rods, motors, skins) = Default::default();
        Self { design, settings, extent, weights, structure, ties, tags, waiting, hub: 0, rods, motors, skins }
    }

    fn node(&mut self, place: Vector3<f64>) -> usize {
        self.structure.nodes.push(Node::at(place));
        self.structure.nodes.len() - 1
    }

    /// Adds a beam and gives half of its mass to each end.
    fn beam(&mut self, nodes: [usize; 2], section: &Section, material: &Elastic, zone: &'static str, viscous: bool, g_mm3: f64) {
        let places = nodes.map(|node| self.structure.nodes[node].place);
        let rigidity = section.rigidity(material);
        let Some(beam) = Beam::new(nodes, places, section.axes.column(1).into_owned(), &rigidity) else { return };
        let mass_g = g_mm3 * section.area_mm2 * beam.length_mm;
        // Half of a slender bar, turning about its end, and the section's own.
        let own = g_mm3 * beam.length_mm * (section.second_mm4[0] + section.second_mm4[1]);
        let turning = mass_g * beam.length_mm * beam.length_mm / 24.0 + 0.5 * own;
        for node in nodes {
            let node = &mut self.structure.nodes[node];
            node.mass_g += 0.5 * mass_g;
            node.inertia_g_mm2.iter_mut().for_each(|inertia| *inertia += turning);
        }
        self.structure.beams.push(beam);
        self.structure.viscous.push(viscous);
        let bending = rigidity.bending_n_mm2;
        self.tags.push(Tag { zone, reach_mm: section.reach_mm, rigidity: [rigidity.axial_n, bending[0], bending[1]], flexible: viscous });
    }

    /// How much stiffer links have to be than [`LINK`].
    fn link_factor(&self) -> f64 {
        (LINK_OVER_JOINTS * self.settings.young_mpa / LINK.0.young_mpa).max(1.0)
    }

    fn link(&mut self, nodes: [usize; 2]) {
        let way = self.structure.nodes[nodes[1]].place - self.structure.nodes[nodes[0]].place;
        let Some(x) = way.try_normalize(1e-9) else { return };
        let aside = if x.z.abs() < 0.9 { Vector3::z() } else { Vector3::x() };
        let z = x.cross(&aside).normalize();
        let section = Section::disc(LINK.1, Vector3::zeros(), Matrix3::from_columns(&[x, z.cross(&x), z]));
        let more = self.link_factor();
        let material = Elastic { young_mpa: LINK.0.young_mpa * more, shear_mpa: LINK.0.shear_mpa * more };
        self.beam(nodes, &section, &material, LINKS, false, 0.0);
    }

    /// A tie at a place that both nodes carry with them.
    fn tie(&mut self, nodes: [usize; 2], place: Vector3<f64>, stiffness: [f64; 2], zone: &'static str) {
        let arms = nodes.map(|node| place - self.structure.nodes[node].place);
        let bushing = Bushing { nodes, arms, stiffness_n_mm: stiffness[0], turning_n_mm: stiffness[1] };
        self.ties.push((bushing, Tag { zone, reach_mm: [0.0; 2], rigidity: [0.0; 3], flexible: true }, true));
    }

    pub(in crate::mechanics) fn add_part(&mut self, part: &PartModel, body: usize, pose: &Isometry3<f64>) {
        let first = self.structure.nodes.len();
        let place = |p: &Vector3<f64>| pose.rotation * p + pose.translation.vector;
        for node in &part.plan.nodes {
            self.structure.nodes.push(Node::at(place(node)));
        }
        let material = self.settings.flexible();
        let planned: f64 = part.plan.beams.iter().map(|beam| beam.section.area_mm2 * part.plan.length_mm(beam)).sum();
        let g_mm3 = self.weights.of_part(part.name) / planned;
        for beam in &part.plan.beams {
            self.beam(beam.nodes.map(|n| first + n), &beam.section.moved(pose), &material, beam.zone, true, g_mm3);
        }
        for link in &part.plan.links {
            self.link(link.map(|n| first + n));
        }
        let young = material.young_mpa;
        for press in &part.plan.presses {
            let k = self.settings.notch_contact * young * press.area_mm2 / press.length_mm;
            if k > 0.0 {
                self.tie(press.nodes.map(|n| first + n), place(&press.place), [k, 1e-3], "closed notches");
            }
        }
        for meeting in &part.plan.meetings {
            let (node, at) = (first + meeting.node, place(&meeting.place));
            match meeting.port {
                Port::Foot => self.foot(node, at),
                Port::Hub => {
                    let radius = 0.5 * self.design.frame.hub_joint.hub_joint_diameter_mm;
                    let k = self.settings.plug_foundation * young * meeting.length_mm;
                    self.tie([node, self.hub], at, [k, k * radius * radius], "plugs in the hub");
                }
                Port::Motor => self.motor(node, at),
                port => self.waiting.push(Waiting { port, node, place: at, length_mm: meeting.length_mm }),
            }
        }
        // Nodes that another has taken the place of carry nothing.
        let used: Vec<usize> = (first..self.structure.nodes.len()).collect();
        self.skins.push(Skin { body, nodes: used });
    }

    fn foot(&mut self, node: usize, at: Vector3<f64>) {
        let arm = at - self.structure.nodes[node].place;
        let stiffness_n_mm = self.settings.foot_stiffness * self.settings.young_mpa;
        self.structure.feet.push(Foot { node, arm, ground_mm: at.z + TOUCH_MM, stiffness_n_mm, friction: self.settings.friction });
    }

    fn motor(&mut self, node: usize, at: Vector3<f64>) {
        let motor = self.weights.motor;
        let centre = self.node(at + Vector3::z() * motor.above_seat_mm);
        let own = &mut self.structure.nodes[centre];
        own.mass_g = motor.mass_g;
        own.inertia_g_mm2 = motor.inertia_g_mm2;
        self.link([node, centre]);
        self.motors.push(centre);
    }

    /// Each bar in the window that lies around it.
    pub(in crate::mechanics) fn tie_windows(&mut self) {
        let of = |port: Port| self.waiting.iter().filter(move |w| w.port == port).map(|w| (w.node, w.place, w.length_mm));
        let bars: Vec<_> = of(Port::Bar).collect();
        let windows: Vec<_> = of(Port::Window).collect();
        for (bar, place, long) in bars {
            let near = windows.iter().min_by(|a, b| (a.1 - place).norm().total_cmp(&(b.1 - place).norm()));
            if let Some((window, _, tall)) = near {
                let k = self.settings.plug_foundation * self.settings.young_mpa * long;
                let turning = k * (long * long + tall * tall) / 24.0;
                self.tie([bar, *window], place, [k, turning], "bars in windows");
            }
        }
    }

    pub(in crate::mechanics) fn finish(mut self) -> Result<FrameModel, ModelError> {
        for (tie, tag, viscous) in std::mem::take(&mut self.ties) {
            self.structure.ties.push(tie);
            self.structure.viscous.push(viscous);
            self.tags.push(tag);
        }
        self.hold_what_carries_nothing();
        let link_factor = self.link_factor();
        let Self { structure, tags, hub, rods, motors, skins, extent, .. } = self;
        Ok(FrameModel { system: System::new(structure)?, tags, hub, rods, motors, skins, extent, link_factor })
    }

    /// A node that no element meets would move freely.
    fn hold_what_carries_nothing(&mut self) {
        let mut met = vec![false; self.structure.nodes.len()];
        let beams = self.structure.beams.iter().flat_map(|beam| beam.nodes);
        for node in beams.chain(self.structure.ties.iter().flat_map(|tie| tie.nodes)) {
            met[node] = true;
        }
        for (node, met) in self.structure.nodes.iter_mut().zip(&met) {
            if !met {
                node.held = [true; 6];
            }
        }
        self.skins.iter_mut().for_each(|skin| skin.nodes.retain(|node| met[*node]));
    }
}
