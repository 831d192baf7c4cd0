//! The torsion constant and the shear shares of any section, holes included, by finite elements on a grid.
//!
//! Saint-Venant: turning by a rate θ', the section warps by θ' ω(y, z), and J = ∫ (y + ω_z)² + (ω_y - z)² dA is least for the true ω. A force V
//! along y is borne by stresses V/I ∇ψ, where ∇²ψ = -y and no stress leaves the outline; their energy V²/2GAκ gives κ = I² / (A ∫ y ψ dA)
//! (Poisson's ratio, which turns the stress aside, is left out: κ is 5/6 of a rectangle, 6/7 of a disc). Both functionals need no condition at
//! outlines, so cells that lie partly in the section only work with their share of it (the finite cell method of J. Parvizian, A. Düster,
//! E. Rank, Comput. Mech. 41 (2007) 121). Pieces of a section that do not touch bear what they bear alone.
//!
//! *When it is wrong:* details smaller than a cell, a thirtieth of the larger side and a tenth of the smaller one: 1.5 % for discs, rings and rectangles.
//! A slit narrower than two cells may be taken for closed, which makes a tube of an open section. Iterations end after 600.

use crate::solid::Piece;

/// Cells along the larger side.
const CELLS: f64 = 30.0;

/// Least cells along the smaller side.
const LEAST_CELLS: f64 = 10.0;

/// Lines on which a cell's share is measured.
const LINES: usize = 4;

/// A cell with a smaller share does not count.
const LEAST_SHARE: f64 = 1e-3;

/// Residual at which iterations end, relative to the start.
const EXACT: f64 = 1e-6;

/// What a section bears by its shape alone.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Warping {
    /// Torsion constant, mm⁴.
    pub torsion_mm4: f64,
    /// Share of the area that works in shear along y, and along z.
    pub shear_shares: [f64; 2],
}

impl Warping {
    /// Of what is within an outline about the origin; turning about another point changes nothing.
    pub fn of(outline: &[Piece]) -> Self {
        let Some(grid) = Grid::over(outline) else { return Self::default() };
        Self { torsion_mm4: grid.torsion(), shear_shares: [0, 1].map(|axis| grid.shear_share(axis)) }
    }
}

/// A cell that counts.
struct Cell {
    /// Its corners, row by row.
    corners: [usize; 4],
    /// How much of it lies in the section.
    share: f64,
    /// Its middle, mm.
    middle: [f64; 2],
}

struct Grid {
    low: [f64; 2],
    /// Of a cell, mm.
    size: [f64; 2],
    cells: [usize; 2],
    shares: Vec<f64>,
}

impl Grid {
    fn over(outline: &[Piece]) -> Option<Self> {
        let points = || outline.iter().flatten();
        let low = [0, 1].map(|i| points().map(|p| p[i]).fold(f64::INFINITY, f64::min));
        let high = [0, 1].map(|i| points().map(|p| p[i]).fold(f64::NEG_INFINITY, f64::max));
        let sides = [high[0] - low[0], high[1] - low[1]];
        let wanted = sides[0].max(sides[1]) / CELLS;
        if !(wanted.is_finite() && sides[0].min(sides[1]) > 1e-9) {
            return None;
        }
        // Whole cells along both sides: a rectangle fills them.
        let cells = sides.map(|side| (side / wanted - 1e-9).ceil().max(LEAST_CELLS) as usize);
        let size = [0, 1].map(|i| sides[i] / cells[i] as f64);
        let mut grid = Self { low, size, cells, shares: vec![0.0; cells[0] * cells[1]] };
        for row in 0..cells[1] {
            for line in 0..LINES {
                let v = low[1] + size[1] * (row as f64 + (line as f64 + 0.5) / LINES as f64);
                grid.add_line(row, &crossings(outline, v));
            }
        }
        Some(grid)
    }

    /// Adds to a row's shares what lies between each pair of crossings.
    fn add_line(&mut self, row: usize, crossings: &[f64]) {
        for ends in crossings.chunks_exact(2) {
            let [from, to] = [ends[0], ends[1]].map(|u| (u - self.low[0]) / self.size[0]);
            for column in from.max(0.0) as usize..self.cells[0] {
                let within = to.min(column as f64 + 1.0) - from.max(column as f64);
                if within <= 0.0 {
                    break;
                }
                self.shares[row * self.cells[0] + column] += within / LINES as f64;
            }
        }
    }

    fn corners(&self, row: usize, column: usize) -> [usize; 4] {
        let first = row * (self.cells[0] + 1) + column;
        let second = first + self.cells[0] + 1;
        [first, first + 1, second, second + 1]
    }

    fn filled(&self) -> impl Iterator<Item = Cell> + '_ {
        (0..self.cells[1]).flat_map(move |row| (0..self.cells[0]).map(move |column| (row, column))).filter_map(move |(row, column)| {
            let share = self.shares[row * self.cells[0] + column];
            let middle = [self.low[0] + self.size[0] * (column as f64 + 0.5), self.low[1] + self.size[1] * (row as f64 + 0.5)];
            (share > LEAST_SHARE).then(|| Cell { corners: self.corners(row, column), share, middle })
        })
    }

    fn nodes(&self) -> usize {
        (self.cells[0] + 1) * (self.cells[1] + 1)
    }

    fn cell_mm2(&self) -> f64 {
        self.size[0] * self.size[1]
    }

    /// ∫ ∇N · ∇N over a cell: bilinear, corners row by row.
    fn stiffness(&self) -> [[f64; 4]; 4] {
        let [a, b] = self.size;
        let of = |i: usize, j: usize| {
            let along = |axis: usize| SIDES[i][axis] * SIDES[j][axis];
            // A third where both lie on one side of the other axis, a sixth where they do not.
            let across = |axis: usize| if SIDES[i][axis] == SIDES[j][axis] { 1.0 / 3.0 } else { 1.0 / 6.0 };
            b / a * along(0) * across(1) + a / b * along(1) * across(0)
        };
        [0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| of(i, j)))
    }

    /// The function whose gradients balance a load at the corners: conjugate gradients, scaled by the diagonal.
    fn solve(&self, load: &[f64]) -> Vec<f64> {
        let stiffness = self.stiffness();
        let product = |x: &[f64], y: &mut [f64]| {
            y.fill(0.0);
            for Cell { corners, share, .. } in self.filled() {
                for (row, corner) in stiffness.iter().zip(corners) {
                    let sum: f64 = row.iter().zip(corners).map(|(k, other)| k * x[other]).sum();
                    y[corner] += share * sum;
                }
            }
        };
        let count = self.nodes();
        let mut diagonal = vec![0.0; count];
        for Cell { corners, share, .. } in self.filled() {
            corners.into_iter().enumerate().for_each(|(at, corner)| diagonal[corner] += share * stiffness[at][at]);
        }
        let scaled = |r: &[f64]| -> Vec<f64> { r.iter().zip(&diagonal).map(|(r, d)| if *d > 0.0 { r / d } else { 0.0 }).collect() };
        let (mut x, mut applied, mut left) = (vec![0.0; count], vec![0.0; count], load.to_vec());
        let mut direction = scaled(&left);
        let mut size = dot(&left, &direction);
        let enough = EXACT * EXACT * size;
        for _ in 0..600 {
            if size <= enough {
                break;
            }
            product(&direction, &mut applied);
            let step = size / dot(&direction, &applied);
            x.iter_mut().zip(&direction).for_each(|(x, d)| *x += step * d);
            left.iter_mut().zip(&applied).for_each(|(r, p)| *r -= step * p);
            let next = scaled(&left);
            let new = dot(&left, &next);
            let keep = new / size;
            direction.iter_mut().zip(&next).for_each(|(d, n)| *d = n + keep * *d);
            size = new;
        }
        x
    }

    /// ∫ (y² + z²) dA minus what warping takes off.
    fn torsion(&self) -> f64 {
        let [a, b] = self.size;
        let (mut load, mut polar) = (vec![0.0; self.nodes()], 0.0);
        for Cell { corners, share, middle: [u, v] } in self.filled() {
            polar += share * self.cell_mm2() * (u * u + v * v + (a * a + b * b) / 12.0);
            for (corner, [along, across]) in corners.into_iter().zip(SIDES) {
                // ∫ (z ω_y - y ω_z) dA.
                load[corner] += share * (along * b * (0.5 * v + across * b / 12.0) - across * a * (0.5 * u + along * a / 12.0));
            }
        }
        polar - dot(&self.solve(&load), &load)
    }

    /// Of a force along an axis. Each piece that touches no other bends about its own middle.
    fn shear_share(&self, axis: usize) -> f64 {
        let piece_of = self.pieces();
        let pieces = piece_of.iter().max().map_or(0, |last| last + 1);
        let (mut areas, mut firsts) = (vec![0.0; pieces], vec![0.0; pieces]);
        for Cell { corners, share, middle } in self.filled() {
            areas[piece_of[corners[0]]] += share * self.cell_mm2();
            firsts[piece_of[corners[0]]] += share * self.cell_mm2() * middle[axis];
        }
        let size = self.size[axis];
        let (mut load, mut seconds) = (vec![0.0; self.nodes()], vec![0.0; pieces]);
        for Cell { corners, share, middle } in self.filled() {
            let piece = piece_of[corners[0]];
            let off = middle[axis] - firsts[piece] / areas[piece];
            seconds[piece] += share * self.cell_mm2() * (off * off + size * size / 12.0);
            for (corner, sides) in corners.into_iter().zip(SIDES) {
                load[corner] += share * self.cell_mm2() * (off / 4.0 + sides[axis] * size / 24.0);
            }
        }
        let potential = self.solve(&load);
        let mut bent = vec![0.0; pieces];
        for (node, piece) in piece_of.iter().enumerate() {
            bent[*piece] += potential[node] * load[node];
        }
        let works = seconds.iter().zip(&bent).filter(|(_, bent)| **bent > 0.0).map(|(second, bent)| second * second / bent);
        works.sum::<f64>() / areas.iter().sum::<f64>()
    }

    /// Which piece of the section each corner belongs to: cells that share a corner are of one.
    fn pieces(&self) -> Vec<usize> {
        let mut leads: Vec<usize> = (0..self.nodes()).collect();
        let lead = |leads: &[usize], mut node: usize| {
            while leads[node] != node {
                node = leads[node];
            }
            node
        };
        for Cell { corners, .. } in self.filled() {
            let first = corners.map(|corner| lead(&leads, corner)).into_iter().fold(usize::MAX, usize::min);
            for corner in corners {
                let other = lead(&leads, corner);
                leads[other] = first;
            }
        }
        (0..leads.len()).map(|node| lead(&leads, node)).collect()
    }
}

/// On which side of a cell's middle its corners lie, along u and along v.
const SIDES: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]];

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Where a line of constant v crosses the outline, in order.
fn crossings(outline: &[Piece], v: f64) -> Vec<f64> {
    let crossed = outline.iter().filter(|[a, b]| (a[1] >= v) != (b[1] >= v));
    let mut at: Vec<f64> = crossed.map(|[a, b]| a[0] + (b[0] - a[0]) * (v - a[1]) / (b[1] - a[1])).collect();
    at.sort_by(f64::total_cmp);
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(points: &[[f64; 2]]) -> Vec<Piece> {
        (0..points.len()).map(|i| [points[i], points[(i + 1) % points.len()]]).collect()
    }

    fn circle(radius: f64, turn: f64) -> Vec<Piece> {
        let point = |i: usize| {
            let angle = turn * std::f64::consts::TAU * i as f64 / 96.0;
            [radius * libm::cos(angle), radius * libm::sin(angle)]
        };
        polygon(&(0..96).map(point).collect::<Vec<_>>())
    }

    fn rectangle(a: f64, b: f64) -> Vec<Piece> {
        polygon(&[[0.0, 0.0], [a, 0.0], [a, b], [0.0, b]])
    }

    #[test]
    fn analytic_discs_rings_and_rectangles() {
        let disc = std::f64::consts::PI / 2.0;
        let ring: Vec<Piece> = circle(2.0, 1.0).into_iter().chain(circle(1.2, -1.0)).collect();
        let half: Vec<[f64; 2]> =
            (0..=48).map(|i| std::f64::consts::PI * f64::from(i) / 48.0).map(|a| [libm::cos(a), libm::sin(a)]).collect();
        for (what, outline, exact) in [
            ("disc", circle(1.0, 1.0), disc),
            ("ring", ring, disc * (16.0 - 1.2_f64.powi(4))),
            ("square", rectangle(1.0, 1.0), 0.140577),
            // Roark's Formulas, table 10.1: a / b = 2 gives 0.2287 b³ a, 5 gives 0.2913.
            ("2 by 1", rectangle(2.0, 1.0), 2.0 * 0.2287),
            ("5 by 1", rectangle(5.0, 1.0), 5.0 * 0.2913),
            // Sides that are no multiples of each other: a b³/3 (1 - 0.63 b/a), within 0.1 % where a > 3 b.
            ("7.3 by 1", rectangle(7.3, 1.0), 7.3 / 3.0 * (1.0 - 0.63025 / 7.3)),
            ("18 by 1.5, upright", rectangle(1.5, 18.0), 1.5_f64.powi(3) * 6.0 * (1.0 - 0.63025 * 1.5 / 18.0)),
            ("28.3 by 1", rectangle(28.3, 1.0), 28.3 / 3.0 * (1.0 - 0.63025 / 28.3)),
            // The same table, half of a disc: 0.2976 r⁴ (S. Timoshenko, J. N. Goodier, art. 111: 0.296).
            ("half disc", polygon(&half), 0.297),
        ] {
            let found = Warping::of(&outline).torsion_mm4;
            assert!((found / exact - 1.0).abs() < 0.015, "{what}: {found} {exact}");
        }
    }

    #[test]
    fn analytic_shear_shares_of_rectangles_discs_and_rings() {
        let ring: Vec<Piece> = circle(2.0, 1.0).into_iter().chain(circle(1.2, -1.0)).collect();
        // G. R. Cowper (J. Appl. Mech. 33 (1966) 335) without Poisson's ratio.
        let (of_ring, m1) = (0.36, 1.36 * 1.36);
        let apart: Vec<Piece> =
            rectangle(2.0, 1.0).into_iter().chain(rectangle(2.0, 1.0).into_iter().map(|ends| ends.map(|[u, v]| [u, v + 1.5]))).collect();
        for (what, outline, exact) in [
            ("square", rectangle(1.0, 1.0), 5.0 / 6.0),
            ("3 by 1", rectangle(3.0, 1.0), 5.0 / 6.0),
            ("11.7 by 1", rectangle(11.7, 1.0), 5.0 / 6.0),
            ("two apart", apart, 5.0 / 6.0),
            ("disc", circle(1.0, 1.0), 6.0 / 7.0),
            ("ring", ring, 6.0 * m1 / (7.0 * m1 + 20.0 * of_ring)),
        ] {
            let found = Warping::of(&outline).shear_shares;
            assert!(found.iter().all(|share| (share / exact - 1.0).abs() < 0.015), "{what}: {found:?} {exact}");
        }
    }
}
