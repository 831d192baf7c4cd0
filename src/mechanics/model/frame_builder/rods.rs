//! Rods along their sockets.

use nalgebra::Matrix3;
use nalgebra::Vector3;

use super::Builder;
use crate::frame::skeleton::Rod;
use crate::mechanics::model::frame_model::{Extent, RodLine, Skin};
use crate::mechanics::parts::plan::{Port, steps};
use crate::mechanics::parts::section::{Elastic, Section};

/// A meeting this far off a rod's axis belongs to another, mm.
const OFF_AXIS_MM: f64 = 0.6;

impl Builder<'_> {
    /// A rod along the meetings that lie on its axis. In a quarter it ends at a plane of symmetry.
    pub(in crate::mechanics) fn add_rod(&mut self, rod: &Rod, material: &Elastic) {
        let (way, length) = ((rod.end - rod.start).normalize(), rod.length_mm());
        let start = rod.start.coords;
        let mut on_axis: Vec<(f64, usize, f64)> = Vec::new();
        for waiting in self.waiting.iter().filter(|waiting| waiting.port == Port::Rod) {
            let off = waiting.place - start;
            let along = off.dot(&way);
            let within = (-OFF_AXIS_MM..length + OFF_AXIS_MM).contains(&along);
            if within && (off - way * along).norm() < OFF_AXIS_MM {
                on_axis.push((along.clamp(0.0, length), waiting.node, waiting.length_mm));
            }
        }
        let quarter = self.extent == Extent::Quarter;
        if on_axis.is_empty() {
            return;
        }
        let cut = quarter && rod.role.is_cage();
        let (low, high) = match cut {
            false => (0.0, length),
            true if on_axis[0].0 < 0.5 * length => (0.0, 0.5 * length),
            true => (0.5 * length, length),
        };
        let stations = stations(&on_axis, low, high, self.settings.rod_element_mm);
        let nodes: Vec<usize> = stations.iter().map(|t| self.node(start + way * *t)).collect();
        if cut {
            let end = if low == 0.0 { nodes[nodes.len() - 1] } else { nodes[0] };
            let along_x = way.x.abs() > 0.5;
            self.structure.nodes[end].held = [along_x, !along_x, false, !along_x, along_x, true];
        }
        let z = if way.z.abs() < 0.9 { Vector3::z() } else { Vector3::x() };
        let y = z.cross(&way).normalize();
        let radius = 0.5 * self.design.frame.rods.rod_diameter_mm;
        let bore = 0.5 * self.design.frame.rod_bore_mm();
        let section = Section::ring(radius, bore, Vector3::zeros(), Matrix3::from_columns(&[way, y, way.cross(&y)]));
        let g_mm3 = self.weights.rod_g_mm3;
        let first = self.structure.beams.len();
        for pair in nodes.windows(2) {
            self.beam([pair[0], pair[1]], &section, material, rod.role.slug(), false, g_mm3);
        }
        let beams: Vec<usize> = (first..self.structure.beams.len()).collect();
        let bending_n_mm2 = material.young_mpa * section.second_mm4[0];
        let engaged: f64 = rod.sockets.iter().zip([&rod.start, &rod.end]).map(|(socket, end)| socket.engagement_mm(end)).sum();
        // A socket holds its rod by walls of TPU: what the rod turns about is the hinge behind the socket.
        let free_mm = self.design.skeleton.between_hinges_mm(rod.role).unwrap_or(length - engaged);
        self.rods.push(RodLine { name: rod.name.clone(), role: rod.role, beams, free_mm, bending_n_mm2 });
        let foundation = self.settings.socket_foundation * self.settings.young_mpa;
        for (along, node, length_mm) in on_axis {
            let station = stations.iter().position(|t| (t - along).abs() < 1e-6);
            let Some(rod_node) = station.map(|at| nodes[at]) else { continue };
            let k = foundation * length_mm;
            self.tie([node, rod_node], start + way * along, [k, k * radius * radius], "rods in sockets");
        }
        let body = self.design.bodies.iter().position(|body| body.name == rod.name);
        self.skins.extend(body.map(|body| Skin { body, nodes }));
    }
}

/// Where a rod has nodes: its ends, its meetings, and between them so that no beam is too long.
fn stations(meetings: &[(f64, usize, f64)], low: f64, high: f64, longest: f64) -> Vec<f64> {
    let mut fixed: Vec<f64> = meetings.iter().map(|m| m.0).chain([low, high]).collect();
    fixed.sort_by(f64::total_cmp);
    fixed.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
    let mut all = vec![fixed[0]];
    for pair in fixed.windows(2) {
        all.extend(steps(pair[0], pair[1], longest).into_iter().skip(1));
        // The meeting itself, to the last bit.
        if let Some(last) = all.last_mut() {
            *last = pair[1];
        }
    }
    all
}
