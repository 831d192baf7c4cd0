//! Time of the lines that a part is printed with.

use super::layer::{LayerShape, layers};
use crate::frame::assembly::{Design, Printed};
use crate::params::catalogue::{Material, Printer};
use crate::solid::Mesh;

/// Time of the lines over what their length and speed give: overlap of infill, bridges, the slow first layer's skirt.
const LINES: f64 = 1.045;
/// Time that a wall loses to its corners, over the time that a stop from full speed costs, for each mm.
const CORNERS: f64 = 0.345;
/// Moves without printing that a loop brings, s: travel and retraction of its walls and its infill.
const MOVES_S: f64 = 0.7;
/// Acceleration of usual printers, mm/s², and the speed that they change without it, mm/s.
const ACCELERATION_MM_S2: f64 = 1000.0;
const JERK_MM_S: f64 = 8.0;
/// Beyond this walls are printed no faster, mm/s: what a longer way to each stop costs is more than what the speed gains. It is where the
/// derivative of their time by the speed is 0.
fn fastest_wall_mm_s() -> f64 {
    (LINES * ACCELERATION_MM_S2 / CORNERS + JERK_MM_S * JERK_MM_S).sqrt()
}
/// Fastest first layer, and fastest short loop, mm/s.
pub const SLOW_MM_S: f64 = 20.0;

/// How the lines of a material are laid by a printer.
#[derive(Debug)]
struct Lines {
    layer_mm: f64,
    /// Distance of two lines beside each other, mm.
    spacing_mm: f64,
    walls: f64,
    speed_mm_s: f64,
}

impl Lines {
    /// Nothing where the material does not say how fast it is printed, or where its layers are too high for the nozzle's lines.
    fn of(material: &Material, printer: &Printer) -> Option<Self> {
        let (layer_mm, wide_mm) = (printer.layer_mm(material), printer.line_mm());
        let spacing_mm = wide_mm - layer_mm * (1.0 - std::f64::consts::FRAC_PI_4);
        if spacing_mm <= 0.0 {
            return None;
        }
        let by_flow = material.most_flow_mm3_s.map_or(f64::INFINITY, |flow| flow / (spacing_mm * layer_mm));
        Some(Self { layer_mm, spacing_mm, walls: material.perimeters.unwrap_or(2.0), speed_mm_s: material.speed_mm_s?.min(by_flow) })
    }

    /// Time of a mesh as it lies on the bed, s.
    fn mesh_s(&self, mesh: &Mesh) -> f64 {
        let first = self.speed_mm_s.min(SLOW_MM_S);
        let time = |(at, shape): (usize, &LayerShape)| self.layer_s(shape, if at == 0 { first } else { self.speed_mm_s });
        layers(mesh, self.layer_mm).iter().enumerate().map(time).sum()
    }

    /// Time of a layer, s.
    fn layer_s(&self, shape: &LayerShape, speed_mm_s: f64) -> f64 {
        if shape.outline_mm == 0.0 {
            return 0.0;
        }
        let all_mm = shape.area_mm2 / self.spacing_mm;
        let walls_mm = (self.walls * shape.outline_mm).min(all_mm);
        let short_mm = walls_mm * shape.short_mm / shape.outline_mm;
        let wall_mm_s = speed_mm_s.min(fastest_wall_mm_s());
        let laid_s = (all_mm - walls_mm) / speed_mm_s + (walls_mm - short_mm) / wall_mm_s + short_mm / speed_mm_s.min(SLOW_MM_S);
        let stop_s = (wall_mm_s - JERK_MM_S).max(0.0).powi(2) / (wall_mm_s * ACCELERATION_MM_S2);
        LINES * laid_s + CORNERS * walls_mm * stop_s + MOVES_S * shape.loops as f64
    }
}

/// Time to print a part of a design, s, as its mesh lies on the bed, computed once for all pages that say it; nothing where the material does not
/// say its speed, or where its layers are too high for the nozzle's lines.
pub fn of_part_s(design: &Design, part: &Printed) -> Option<f64> {
    let lines = Lines::of(&design.material_of(part.name).material, &design.frame.printer)?;
    Some(*design.memo.hold("print time", &(part.name, part.flat.key(), &lines), || lines.mesh_s(&part.mesh)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::{Frame, FrameFile};
    use crate::solid::{Feature, MeshSolid};

    fn part_s(mesh: &Mesh, material: &Material, printer: &Printer) -> Option<f64> {
        Lines::of(material, printer).map(|lines| lines.mesh_s(mesh))
    }

    fn default_frame() -> Frame {
        Frame::resolve(&FrameFile::load("cognifly").expect("is a preset")).expect("resolves")
    }

    fn block(side_mm: f64) -> Mesh {
        MeshSolid::build(&Feature::cuboid_between([0.0, 0.0, 0.0], [side_mm; 3])).to_mesh()
    }

    #[test]
    fn analytic_a_large_block_takes_its_volume_over_its_flow() {
        let frame = default_frame();
        for material in [&frame.flexible.material, &frame.rigid.material] {
            let lines = Lines::of(material, &frame.printer).expect("speeds are stated");
            let flow_mm3_s = lines.speed_mm_s * lines.spacing_mm * lines.layer_mm;
            let found = part_s(&block(80.0), material, &frame.printer).expect("speeds are stated") * flow_mm3_s / 80.0_f64.powi(3);
            assert!((1.045..1.09).contains(&found), "{found}");
        }
    }

    #[test]
    fn analytic_a_faster_material_never_takes_longer() {
        let mut frame = default_frame();
        let part = Design::new(frame.clone()).expect("closes").printed.iter().map(|part| part.mesh.clone()).next().expect("has parts");
        frame.rigid.material.most_flow_mm3_s = None;
        let mut time = |speed_mm_s: f64| {
            frame.rigid.material.speed_mm_s = Some(speed_mm_s);
            part_s(&part, &frame.rigid.material, &frame.printer).expect("speeds are stated")
        };
        let times: Vec<f64> = [20.0, 30.0, 45.0, 55.0, 60.0, 90.0, 150.0, 300.0].into_iter().map(&mut time).collect();
        assert!(times.windows(2).all(|pair| pair[1] < pair[0]), "{times:?}");
    }

    #[test]
    fn analytic_flow_and_speed_limit_each_other() {
        let mut frame = default_frame();
        let time = |frame: &Frame| part_s(&block(10.0), &frame.flexible.material, &frame.printer);
        let slow = time(&frame).expect("speeds are stated");
        frame.flexible.material.most_flow_mm3_s = None;
        assert!(time(&frame).expect("speeds are stated") < slow);
        let own = frame.flexible.material.layer_mm.replace(3.0);
        assert_eq!(time(&frame), None, "lines of 0.45 mm have no layers of 3 mm");
        frame.flexible.material.layer_mm = own;
        frame.flexible.material.speed_mm_s = None;
        assert_eq!(time(&frame), None);
    }
}
