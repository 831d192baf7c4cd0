//! Seams: edges along which a face that goes all the way around its axis is cut, so that it has one border instead of two.
//!
//! Around a cylinder neither of two borders is the outer one. Readers that want one cut the face themselves, and OCCT then read a tie hole
//! whose lower border has corners as two faces, one without area. A seam is an edge that its face has twice, once in each
//! direction: a straight line on a cylinder or a cone, an arc of the meridian on a sphere or a torus.

use std::f64::consts::{PI, TAU};

use nalgebra::{Point3, Unit};

use super::chart::Chart;
use super::curve::Curve;
use super::surface::Surface;
use super::topology::{Boundary, Edge, Face, Side};

/// Least angle about the axis between a seam and a corner or another border, rad.
const ROOM_RAD: f64 = 0.02;
/// Angles about the axis that are taken for the same, rad.
const SAME_RAD: f64 = 1e-9;
/// Pieces of an edge among which the one is looked for that a seam meets.
const PIECES: u32 = 48;
/// Halvings of such a piece.
const HALVINGS: usize = 60;

/// The angle from one direction about an axis to another, rad, the shorter way.
fn turn_rad(from: f64, to: f64) -> f64 {
    let turn = to - from;
    turn - TAU * (turn / TAU).round()
}

impl Boundary {
    /// The same with a seam in each face that goes all the way around its axis between two borders. Edges that a seam meets are divided
    /// there; a border without a corner begins there instead. A face stays as it is where no straight way across is clear.
    #[must_use]
    pub fn with_seams(&self) -> Self {
        let mut seamed = self.clone();
        // Borders without a corner that a seam ends in: they keep their begin.
        let mut held = vec![false; self.vertices.len()];
        for face in 0..seamed.faces.len() {
            seamed.cut_around(face, &mut held);
        }
        seamed
    }

    fn cut_around(&mut self, at: usize, held: &mut Vec<bool>) {
        let face = self.faces[at].clone();
        let Some(chart) = self.chart(&face) else { return };
        let borders = Borders(face.loops.iter().map(|sides| self.angles_along(&chart, sides)).collect());
        let Some(around) = borders.around() else { return };
        let candidates = self.begins(&face, &around, &chart, held).into_iter().chain(borders.middles());
        let Some(seam) = candidates.into_iter().find(|angle| borders.is_clear(*angle, &around)) else { return };
        let Some([from, to]) = self.ends_of(&face, around, &chart, seam, held) else { return };
        let curve = meridian(&face.surface, &chart, &self.vertices[from], &self.vertices[to]);
        let edge = self.edges.len();
        self.edges.push(Edge { from, to, curve });
        let [out, back] = [self.loop_from(at, around[0], from), self.loop_from(at, around[1], to)];
        let across = |forward| [Side { edge, forward }];
        let border = [&out[..], &across(true), &back, &across(false)].concat();
        let others = (0..face.loops.len()).filter(|one| !around.contains(one)).map(|one| self.faces[at].loops[one].clone());
        self.faces[at].loops = std::iter::once(border).chain(others).collect();
    }

    /// Angles about the axis along each side of a loop, rad.
    fn angles_along(&self, chart: &Chart, sides: &[Side]) -> Vec<Vec<f64>> {
        let along = |side: &Side| {
            let points = self.points_of(&self.edges[side.edge], PIECES);
            let mut angles: Vec<f64> = points.iter().map(|p| chart.at(p).x).collect();
            if !side.forward {
                angles.reverse();
            }
            angles
        };
        sides.iter().map(along).collect()
    }

    /// Angles at which borders without a corner begin, rad: first those that keep their begin.
    fn begins(&self, face: &Face, around: &[usize], chart: &Chart, held: &[bool]) -> Vec<f64> {
        let rings = around.iter().map(|one| &face.loops[*one]).filter(|sides| sides.len() == 1);
        let mut begins: Vec<(bool, f64)> = rings
            .map(|sides| {
                let vertex = self.edges[sides[0].edge].from;
                (!held[vertex], chart.at(&self.vertices[vertex]).x)
            })
            .collect();
        begins.sort_by_key(|(is_free, _)| *is_free);
        begins.into_iter().map(|(_, angle)| angle).collect()
    }

    /// The vertices in which a seam ends, made where there are none.
    fn ends_of(&mut self, face: &Face, around: [usize; 2], chart: &Chart, seam: f64, held: &mut Vec<bool>) -> Option<[usize; 2]> {
        let meets = around.map(|one| face.loops[one].iter().find_map(|side| self.meeting(side.edge, chart, seam)));
        let [Some(first), Some(second)] = meets else { return None };
        let ends = [self.end_of(first, held)?, self.end_of(second, held)?];
        held.resize(self.vertices.len(), false);
        ends.iter().for_each(|end| held[*end] = true);
        Some(ends)
    }

    /// The vertex after a share of an edge, made where there is none.
    fn end_of(&mut self, (edge, share): (usize, f64), held: &[bool]) -> Option<usize> {
        let Edge { from, to, .. } = self.edges[edge];
        if from == to && share == 0.0 {
            return Some(from);
        }
        if from == to && !held[from] && self.is_of_one_edge(from) {
            (self.vertices[from], self.edges[edge].curve) = self.edges[edge].curve.begun_at(&self.vertices[from], share)?;
            return Some(from);
        }
        self.divide(edge, share)
    }

    fn is_of_one_edge(&self, vertex: usize) -> bool {
        self.edges.iter().filter(|edge| edge.from == vertex || edge.to == vertex).count() == 1
    }

    /// Where a seam meets an edge: the edge, and the share of it that lies before.
    fn meeting(&self, edge: usize, chart: &Chart, seam: f64) -> Option<(usize, f64)> {
        let of = &self.edges[edge];
        let from = self.vertices[of.from];
        let angle = |share: f64| of.curve.at(&from, share).map(|p| chart.at(&p).x);
        let begins = angle(0.0)?;
        if of.from == of.to && turn_rad(begins, seam).abs() < SAME_RAD {
            return Some((edge, 0.0));
        }
        let share = |piece: u32| f64::from(piece) / f64::from(PIECES);
        let piece = (0..PIECES).find(|piece| {
            let ends = [*piece, piece + 1].map(|piece| angle(share(piece)));
            matches!(ends, [Some(low), Some(high)] if crosses(&[low, high], seam))
        })?;
        let [mut low, mut high] = [share(piece), share(piece + 1)];
        let is_before = |angle: f64| turn_rad(seam, angle) < 0.0;
        let begins_before = is_before(angle(low)?);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if is_before(angle(middle)?) == begins_before { low = middle } else { high = middle }
        }
        Some((edge, 0.5 * (low + high)))
    }

    /// Divides an edge after a share of it; the vertex there.
    fn divide(&mut self, edge: usize, share: f64) -> Option<usize> {
        let Edge { from, to, curve } = self.edges[edge].clone();
        let (point, [before, behind]) = curve.divided(&self.vertices[from], share)?;
        let (vertex, second) = (self.vertices.len(), self.edges.len());
        self.vertices.push(point);
        self.edges[edge] = Edge { from, to: vertex, curve: before };
        self.edges.push(Edge { from: vertex, to, curve: behind });
        for sides in self.faces.iter_mut().flat_map(|face| &mut face.loops) {
            *sides = sides
                .iter()
                .flat_map(|side| {
                    let halves = [Side { edge, ..*side }, Side { edge: second, ..*side }];
                    match (side.edge == edge, side.forward) {
                        (false, _) => vec![*side],
                        (true, true) => halves.to_vec(),
                        (true, false) => vec![halves[1], halves[0]],
                    }
                })
                .collect();
        }
        Some(vertex)
    }

    /// A loop from one of its corners on.
    fn loop_from(&self, face: usize, one: usize, corner: usize) -> Vec<Side> {
        let sides = &self.faces[face].loops[one];
        let start = |side: &Side| if side.forward { self.edges[side.edge].from } else { self.edges[side.edge].to };
        let first = sides.iter().position(|side| start(side) == corner).unwrap_or(0);
        sides[first..].iter().chain(&sides[..first]).copied().collect()
    }
}

/// Angles about the axis along the borders of a face, border by border and side by side, rad.
struct Borders(Vec<Vec<Vec<f64>>>);

impl Borders {
    /// The two that go around the axis, if there are two and they run in opposite directions.
    fn around(&self) -> Option<[usize; 2]> {
        let turns = |sides: &Vec<Vec<f64>>| {
            let sum: f64 = sides.iter().flat_map(|side| side.windows(2).map(|pair| turn_rad(pair[0], pair[1]))).sum();
            (sum / TAU).round() as i32
        };
        let turns: Vec<i32> = self.0.iter().map(turns).collect();
        let around: Vec<usize> = (0..turns.len()).filter(|one| turns[*one] != 0).collect();
        <[usize; 2]>::try_from(around).ok().filter(|[first, second]| turns[*first] + turns[*second] == 0)
    }

    /// Whether a seam at an angle meets each border that goes around once, off its corners, and no other.
    fn is_clear(&self, seam: f64, around: &[usize]) -> bool {
        let near = |angle: &f64| turn_rad(*angle, seam).abs() < ROOM_RAD;
        let crossed = |side: &Vec<f64>| side.windows(2).filter(|pair| crosses(pair, seam)).count();
        let is_met_once = |sides: &[Vec<f64>]| {
            let has_room = sides.len() == 1 || !sides.iter().any(|side| near(&side[0]));
            has_room && sides.iter().map(crossed).sum::<usize>() == 1
        };
        let is_free = |(one, sides): (usize, &Vec<Vec<f64>>)| match around.contains(&one) {
            true => is_met_once(sides),
            false => !sides.iter().flatten().any(near),
        };
        self.0.iter().enumerate().all(is_free)
    }

    /// Angles in the middle between corners, and all points of a border of one side: where most room is first.
    fn middles(&self) -> Vec<f64> {
        let (cornered, rings): (Vec<_>, Vec<_>) = self.0.iter().partition(|sides| sides.len() > 1);
        let mut all: Vec<f64> = cornered.into_iter().flatten().map(|side| side[0]).collect();
        all.extend(rings.into_iter().flatten().flatten());
        all.sort_by(f64::total_cmp);
        let Some(first) = all.first().copied() else { return Vec::new() };
        all.push(first + TAU);
        let mut gaps: Vec<[f64; 2]> = all.windows(2).map(|pair| [pair[1] - pair[0], 0.5 * (pair[0] + pair[1])]).collect();
        gaps.sort_by(|a, b| b[0].total_cmp(&a[0]));
        gaps.into_iter().map(|[_, middle]| middle).collect()
    }
}

/// Whether an angle lies between two that follow each other, rad.
fn crosses(pair: &[f64], seam: f64) -> bool {
    let before = turn_rad(seam, pair[0]);
    let behind = before + turn_rad(pair[0], pair[1]);
    before.abs() < 0.5 * PI && (before < 0.0) != (behind < 0.0)
}

/// The curve of a round surface from one of its points to another at the same angle about its axis.
fn meridian(surface: &Surface, chart: &Chart, from: &Point3<f64>, to: &Point3<f64>) -> Curve {
    let (centre_mm, radius_mm) = match surface {
        Surface::Sphere { radius_mm, .. } => (0.0, *radius_mm),
        Surface::Torus { radius_mm, minor_radius_mm, .. } => (*radius_mm, *minor_radius_mm),
        _ => return Curve::Line,
    };
    let [begin, end] = [chart.at(from), chart.at(to)];
    let direction = chart.direction(begin.x);
    let centre = chart.point + direction * centre_mm;
    let sweep_rad = end.y - begin.y;
    let upward = chart.along_meridian(begin.x);
    let axis = if sweep_rad < 0.0 { -upward } else { upward };
    let major = Unit::new_normalize(from - centre);
    Curve::Ellipse { centre, axis, major, radii_mm: [radius_mm; 2], sweep_rad: sweep_rad.abs() }
}

#[cfg(test)]
mod tests {
    use nalgebra::Isometry3;
    use proptest::prelude::*;

    use super::*;
    use crate::solid::{Contour, Feature, MeshSolid, Profile};

    fn exact(feature: &Feature) -> Boundary {
        let mesh = MeshSolid::build(feature).to_mesh();
        Boundary::exact(&mesh, feature, &Isometry3::identity()).expect("planes and round surfaces")
    }

    /// How often each edge is passed forward and back; each border is closed.
    fn passes(boundary: &Boundary) -> Vec<[usize; 2]> {
        let mut passes = vec![[0; 2]; boundary.edges.len()];
        for sides in boundary.faces.iter().flat_map(|face| &face.loops) {
            let ends = |side: &Side| {
                let Edge { from, to, .. } = boundary.edges[side.edge];
                if side.forward { [from, to] } else { [to, from] }
            };
            for (side, next) in sides.iter().zip(sides.iter().cycle().skip(1)) {
                assert_eq!(ends(side)[1], ends(next)[0], "{sides:?}");
                passes[side.edge][usize::from(side.forward)] += 1;
            }
        }
        passes
    }

    fn assert_cut(solid: &Boundary, seams: usize) {
        let seamed = solid.with_seams();
        assert!(passes(&seamed).into_iter().all(|pass| pass == [1, 1]));
        assert_eq!(seamed.faces.iter().filter(|face| face.seam().is_some()).count(), seams);
        assert!((seamed.volume_mm3() / solid.volume_mm3() - 1.0).abs() < 1e-6, "{} {}", seamed.volume_mm3(), solid.volume_mm3());
        let on_surfaces = |face: &Face| {
            let edges = face.loops.iter().flatten().map(|side| &seamed.edges[side.edge]);
            edges.flat_map(|edge| seamed.points_of(edge, 8)).all(|p| face.surface.distance_mm(&p).abs() < 1e-4)
        };
        assert!(seamed.faces.iter().all(on_surfaces));
    }

    #[test]
    fn analytic_a_cylinder_is_cut_once_and_a_box_not() {
        assert_cut(&exact(&Feature::cylinder(2.0, 5.0)), 1);
        assert_cut(&exact(&Feature::cuboid_between([0.0; 3], [1.0, 2.0, 3.0])), 0);
    }

    /// A bore ends in the circle in which a cone begins.
    #[test]
    fn analytic_neighbours_about_one_axis_have_seams_that_meet() {
        let wider = Feature::revolve(Profile::new(Contour::polygon(&[[0.0, 5.0], [2.0, 5.0], [4.0, 9.0], [0.0, 9.0]])));
        let bowl = Feature::cylinder(5.0, 8.0).minus([wider, Feature::revolve(Profile::new(Contour::rectangle([1.0, 2.0], [2.0, 6.0])))]);
        let solid = exact(&bowl);
        assert_cut(&solid, 3);
        let seamed = solid.with_seams();
        assert_eq!(seamed.vertices.len(), solid.vertices.len(), "circles begin where a seam ends");
    }

    proptest! {
        /// A bore with a slot in its lower part, as for a tie, and a narrow one from there to the side, wherever they are.
        /// The slot ends inside the box: one that reaches the walls leaves slivers thinner than the mesh tells at some angles.
        #[test]
        fn analytic_a_bore_with_a_slot_has_one_border(slot_mm in 1.0_f64..3.5, turned_deg in 0.0_f64..360.0, across_mm in 0.5_f64..0.8) {
            let slot = Feature::cuboid_between([0.0, -0.5 * slot_mm, -1.0], [7.0, 0.5 * slot_mm, 3.0]);
            let cross = Feature::cylinder(across_mm, 6.0).turned_x(crate::units::Angle::deg(90.0)).at(0.0, 0.0, 6.0);
            let cuts = Feature::union([Feature::bore(2.0, 10.0).at(0.0, 0.0, -1.0), slot, cross]).turned_z(crate::units::Angle::deg(turned_deg));
            assert_cut(&exact(&Feature::cuboid_between([-8.0, -8.0, 0.0], [8.0, 8.0, 8.0]).minus([cuts])), 2);
        }
    }
}
