//! Filling triangles into pixels: a depth buffer, four samples to a pixel, bands of rows drawn side by side.
//!
//! Corners are rounded to 1/256 of a sample, and which samples a triangle covers is decided in whole numbers, so
//! neighbours that share an edge cover each sample once. Bands do not touch each other, so the bytes do not depend on
//! how many are drawn at once.

use std::ops::Range;

use rayon::prelude::*;

/// Samples to a pixel along each axis.
const SAMPLES: usize = 2;

/// Rows of pixels to a band.
const BAND_ROWS: usize = 16;

/// Steps to a sample.
const STEPS: i64 = 256;

/// A triangle of at most so many columns of samples is scanned.
const FEW_COLUMNS: usize = 12;

/// Steps of linear intensity in the table of display values.
const TABLE: usize = 4096;

/// One triangle to fill.
#[derive(Clone, Debug)]
pub struct Fill {
    /// Picture x and y (pixels) and nearness of the corners.
    pub corners: [[f64; 3]; 3],
    /// Brightness at the corners, a factor on the colour.
    pub light: [f32; 3],
    /// Linear red, green, blue, 0 to 1.
    pub colour: [f32; 3],
    /// Share of the colour in what is then seen; below 1 the triangle hides nothing.
    pub alpha: f32,
}

impl Fill {
    /// Whether the picture can hold it.
    fn is_finite(&self) -> bool {
        self.corners.iter().flatten().all(|c| c.is_finite()) && self.light.iter().chain(&self.colour).all(|c| c.is_finite())
    }
}

/// Whether a triangle with these corners can change a picture: not when it lies between the samples.
pub fn covers_samples(corners: &[[f64; 3]; 3]) -> bool {
    Shape::new(corners).is_some_and(|shape| !shape.misses(0) && !shape.misses(1))
}

/// Draws the triangles in their order over white; red, green, blue bytes of each pixel, row by row.
pub fn rgb(fills: &[Fill], width: usize, height: usize) -> Vec<u8> {
    let whole = [0..width * SAMPLES, 0..height * SAMPLES];
    let placed: Vec<Placed> = fills.iter().filter_map(|fill| Placed::new(fill, &whole)).collect();
    let mut members: Vec<Vec<&Placed>> = vec![Vec::new(); height.div_ceil(BAND_ROWS)];
    for one in &placed {
        let [low, high] = [one.rows.start, one.rows.end - 1].map(|row| row / (BAND_ROWS * SAMPLES));
        members[low..=high].iter_mut().for_each(|m| m.push(one));
    }
    let table = display_table();
    let drawn = members.par_iter().enumerate().map_init(Samples::default, |samples, (band, placed)| {
        let rows = band * BAND_ROWS..((band + 1) * BAND_ROWS).min(height);
        if placed.is_empty() {
            return vec![u8::MAX; width * rows.len() * 3];
        }
        samples.whiten(width * SAMPLES, rows.start * SAMPLES..rows.end * SAMPLES);
        for run in placed.chunk_by(|a, b| a.shines_through() == b.shines_through()) {
            if run[0].shines_through() { run.iter().for_each(|one| samples.tint(one)) } else { samples.cover(run) }
        }
        samples.averaged(&table)
    });
    drawn.collect::<Vec<_>>().concat()
}

/// A triangle on the samples.
struct Placed<'a> {
    fill: &'a Fill,
    shape: Shape,
    /// Samples it may cover.
    columns: Range<usize>,
    rows: Range<usize>,
}

impl<'a> Placed<'a> {
    /// None where it covers nothing of the picture.
    fn new(fill: &'a Fill, [columns, rows]: &[Range<usize>; 2]) -> Option<Self> {
        let shape = if fill.is_finite() { Shape::new(&fill.corners)? } else { return None };
        let [columns, rows] = [shape.within(0, columns), shape.within(1, rows)];
        (!columns.is_empty() && !rows.is_empty()).then_some(Self { fill, shape, columns, rows })
    }

    /// Gives samples of a row their colour, from a column on.
    fn paint(&self, row: usize, column: usize, colours: &mut [[f32; 3]]) {
        let Fill { light, colour, .. } = self.fill;
        if light[0] == light[1] && light[1] == light[2] {
            return colours.fill(colour.map(|c| c * light[0]));
        }
        let line = self.shape.plane(light.map(f64::from)).along(row);
        for (column, own) in (column..).zip(colours) {
            let bright = line.at(column) as f32;
            *own = colour.map(|c| c * bright);
        }
    }

    /// Whether what is behind it is seen, too.
    fn shines_through(&self) -> bool {
        self.fill.alpha < 1.0
    }

    /// The samples that it covers of the rows, a run in each row.
    fn spans(&self, rows: &Range<usize>, mut each: impl FnMut(usize, Range<usize>)) {
        let rows = self.rows.start.max(rows.start)..self.rows.end.min(rows.end);
        if self.columns.len() <= FEW_COLUMNS {
            let mut scan = Scan::new(&self.shape, self.columns.start, rows.start);
            rows.for_each(|row| each(row, scan.next_row(&self.columns)));
        } else {
            let mut walk = Walk::new(&self.shape, rows.start);
            rows.for_each(|row| each(row, walk.next_row(&self.columns)));
        }
    }
}

/// Display value (sRGB) of evenly spaced linear intensities.
fn display_table() -> Vec<u8> {
    let display = |x: f64| if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * libm::pow(x, 1.0 / 2.4) - 0.055 };
    (0..=TABLE).map(|i| (255.0 * display(i as f64 / TABLE as f64)).round() as u8).collect()
}

/// A band of the picture while it is drawn. What the last one has left is made white by the next.
#[derive(Default)]
struct Samples {
    width: usize,
    rows: Range<usize>,
    near: Vec<f32>,
    colour: Vec<[f32; 3]>,
    /// Which triangle of a run is seen, counted from 1; 0 where none is.
    seen: Vec<u32>,
    /// Samples of each row between which anything was drawn.
    touched: Vec<Range<usize>>,
}

impl Samples {
    fn whiten(&mut self, width: usize, rows: Range<usize>) {
        for (row, touched) in self.touched.iter().enumerate().filter(|(_, touched)| !touched.is_empty()) {
            let span = row * self.width + touched.start..row * self.width + touched.end;
            self.near[span.clone()].fill(f32::MIN);
            self.colour[span].fill([1.0; 3]);
        }
        let count = width * rows.len();
        self.near.resize(count, f32::MIN);
        self.colour.resize(count, [1.0; 3]);
        self.seen.resize(count, 0);
        self.touched.clear();
        self.touched.resize(rows.len(), width..0);
        (self.width, self.rows) = (width, rows);
    }

    /// Draws triangles that hide what is behind them: first which of them is seen where, then its colour.
    fn cover(&mut self, run: &[&Placed]) {
        for (number, placed) in (1..).zip(run) {
            let near = placed.shape.plane(placed.fill.corners.map(|c| c[2]));
            placed.spans(&self.rows, |row, columns| {
                if columns.is_empty() {
                    return;
                }
                let touched = &mut self.touched[row - self.rows.start];
                *touched = touched.start.min(columns.start)..touched.end.max(columns.end);
                let (near, start) = (near.along(row), (row - self.rows.start) * self.width);
                let span = start + columns.start..start + columns.end;
                for ((column, depth), seen) in columns.zip(&mut self.near[span.clone()]).zip(&mut self.seen[span]) {
                    let here = near.at(column) as f32;
                    if here > *depth {
                        *depth = here;
                        *seen = number;
                    }
                }
            });
        }
        for (row, touched) in self.touched.iter().enumerate().filter(|(_, touched)| !touched.is_empty()) {
            let span = row * self.width + touched.start..row * self.width + touched.end;
            let (mut column, mut colours) = (touched.start, &mut self.colour[span.clone()]);
            for same in self.seen[span.clone()].chunk_by(|a, b| a == b) {
                let (own, rest) = colours.split_at_mut(same.len());
                if let Some(placed) = run.get((same[0] as usize).wrapping_sub(1)) {
                    placed.paint(self.rows.start + row, column, own);
                }
                (column, colours) = (column + same.len(), rest);
            }
            self.seen[span].fill(0);
        }
    }

    /// Draws a triangle through which others are seen.
    fn tint(&mut self, placed: &Placed) {
        let (fill, shape) = (placed.fill, &placed.shape);
        let [near, light] = [shape.plane(fill.corners.map(|c| c[2])), shape.plane(fill.light.map(f64::from))];
        placed.spans(&self.rows, |row, columns| {
            if columns.is_empty() {
                return;
            }
            let touched = &mut self.touched[row - self.rows.start];
            *touched = touched.start.min(columns.start)..touched.end.max(columns.end);
            let start = (row - self.rows.start) * self.width;
            let (near, light) = (near.along(row), light.along(row));
            for column in columns {
                if near.at(column) as f32 > self.near[start + column] {
                    let (bright, colour) = (light.at(column) as f32, &mut self.colour[start + column]);
                    *colour = [0, 1, 2].map(|i| colour[i] + fill.alpha * (fill.colour[i] * bright - colour[i]));
                }
            }
        });
    }

    /// The pixels of the band: the mean of their samples, as display values.
    fn averaged(&self, table: &[u8]) -> Vec<u8> {
        let mut bytes = vec![u8::MAX; self.colour.len() / (SAMPLES * SAMPLES) * 3];
        for (row, line) in (0..self.rows.len()).step_by(SAMPLES).zip(bytes.chunks_exact_mut(self.width / SAMPLES * 3)) {
            let touched = &self.touched[row..row + SAMPLES];
            let low = touched.iter().map(|t| t.start).fold(self.width, usize::min) / SAMPLES;
            let high = touched.iter().map(|t| t.end).fold(0, usize::max).div_ceil(SAMPLES);
            for pixel in low..high {
                let column = pixel * SAMPLES;
                let [upper, lower] = [row, row + 1].map(|row| &self.colour[row * self.width + column..][..SAMPLES]);
                let own = [upper[0], upper[1], lower[0], lower[1]];
                if own == [[1.0; 3]; SAMPLES * SAMPLES] {
                    continue;
                }
                let mut sum = [0.0_f32; 3];
                for colour in own {
                    (0..3).for_each(|i| sum[i] += colour[i].clamp(0.0, 1.0));
                }
                let shown = sum.map(|s| table[((s / (SAMPLES * SAMPLES) as f32 * TABLE as f32 + 0.5) as usize).min(TABLE)]);
                line[pixel * 3..][..3].copy_from_slice(&shown);
            }
        }
        bytes
    }
}

/// The corners of a triangle on the grid of steps, turned so that its inside is on the positive side of each edge.
struct Shape {
    corners: [[i64; 2]; 3],
    /// Which corner of the triangle each one is.
    order: [usize; 3],
    twice_area: i64,
}

impl Shape {
    /// None when it covers nothing.
    fn new(corners: &[[f64; 3]; 3]) -> Option<Self> {
        let limit = 1e6;
        let step = |c: f64| rounded(c.clamp(-limit, limit) * (SAMPLES as i64 * STEPS) as f64);
        let [a, b, c] = corners.map(|p| [step(p[0]), step(p[1])]);
        let twice_area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        match twice_area.signum() {
            1 => Some(Self { corners: [a, b, c], order: [0, 1, 2], twice_area }),
            -1 => Some(Self { corners: [a, c, b], order: [0, 2, 1], twice_area: -twice_area }),
            _ => None,
        }
    }

    /// Columns (axis 0) or rows of samples between its ends: the first, and the one after the last.
    fn between(&self, axis: usize) -> [i64; 2] {
        let [a, b, c] = &self.corners;
        let (low, high) = (a[axis].min(b[axis]).min(c[axis]), a[axis].max(b[axis]).max(c[axis]));
        samples_between(low, high)
    }

    /// The same, of those given.
    fn within(&self, axis: usize, given: &Range<usize>) -> Range<usize> {
        let [low, high] = self.between(axis);
        clamped(low, high, given)
    }

    /// Whether it lies between two columns or rows of samples.
    fn misses(&self, axis: usize) -> bool {
        let [low, high] = self.between(axis);
        low >= high
    }

    /// The linear function of the picture that has these values at the corners.
    fn plane(&self, values: [f64; 3]) -> Plane {
        let [a, b, c] = self.corners.map(|p| p.map(|s| s as f64 / STEPS as f64));
        let [va, vb, vc] = self.order.map(|i| values[i]);
        let scale = (STEPS * STEPS) as f64 / self.twice_area as f64;
        let (du, dv) = (vb - va, vc - va);
        let slope = [(du * (c[1] - a[1]) - dv * (b[1] - a[1])) * scale, (dv * (b[0] - a[0]) - du * (c[0] - a[0])) * scale];
        Plane { origin: a, value: va, slope, range: [va.min(vb).min(vc), va.max(vb).max(vc)] }
    }
}

/// The samples that a narrow shape covers, row by row, each of them tried: takes no division.
struct Scan {
    /// Twice the area between a sample and each edge, in steps; less than 0 on the other side of the edge.
    areas: [i64; 3],
    /// How much more it is one column further, and one row.
    column: [i64; 3],
    row: [i64; 3],
}

impl Scan {
    fn new(shape: &Shape, column: usize, row: usize) -> Self {
        let [x, y] = [column, row].map(|at| at as i64 * STEPS + STEPS / 2);
        let mut scan = Self { areas: [0; 3], column: [0; 3], row: [0; 3] };
        for i in 0..3 {
            let ([px, py], [qx, qy]) = (shape.corners[i], shape.corners[(i + 1) % 3]);
            let (dx, dy) = (qx - px, qy - py);
            // A sample on an edge belongs to the triangle below or right of it.
            let left_out = dy > 0 || (dy == 0 && dx < 0);
            scan.areas[i] = dx * (y - py) - dy * (x - px) - i64::from(left_out);
            (scan.column[i], scan.row[i]) = (-dy * STEPS, dx * STEPS);
        }
        scan
    }

    /// The samples of the row, of those given; the scan goes on to the next.
    fn next_row(&mut self, given: &Range<usize>) -> Range<usize> {
        let [mut a, mut b, mut c] = self.areas;
        let (mut low, mut high) = (given.end, given.end);
        for column in given.clone() {
            if (a | b | c) >= 0 {
                low = low.min(column);
            } else if low < column {
                high = column;
                break;
            }
            (a, b, c) = (a + self.column[0], b + self.column[1], c + self.column[2]);
        }
        (0..3).for_each(|i| self.areas[i] += self.row[i]);
        low..high
    }
}

/// The samples that a shape covers, row by row; a sample on an edge belongs to the triangle below or right of it.
struct Walk {
    sides: [Option<Side>; 3],
    /// Row of samples, in steps.
    y: i64,
    /// Height of a level edge whose samples are the neighbour's, in steps.
    left_out: Option<i64>,
}

impl Walk {
    fn new(shape: &Shape, row: usize) -> Self {
        let y = row as i64 * STEPS + STEPS / 2;
        let ends = [0, 1, 2].map(|i| [shape.corners[i], shape.corners[(i + 1) % 3]]);
        let left_out = ends.iter().find(|[p, q]| p[1] == q[1] && q[0] < p[0]).map(|[p, _]| p[1]);
        Self { sides: ends.map(|[p, q]| Side::new(p, q, y)), y, left_out }
    }

    /// The samples of the row; the walk goes on to the next.
    fn next_row(&mut self, given: &Range<usize>) -> Range<usize> {
        let (mut low, mut high) = (i64::MIN, i64::MAX);
        for side in self.sides.iter_mut().flatten() {
            if side.right {
                high = high.min(side.from + side.quotient)
            } else {
                low = low.max(side.from - side.quotient)
            }
            side.advance();
        }
        let left_out = self.left_out == Some(self.y);
        self.y += STEPS;
        if left_out || low == i64::MIN || high == i64::MAX {
            return 0..0;
        }
        let [low, high] = samples_between(low, high);
        clamped(low, high, given)
    }
}

/// Where an edge that is not level crosses a row: `from` plus (the right side) or minus the quotient of two whole
/// numbers, which is kept with its remainder, so that the next row needs no division.
struct Side {
    from: i64,
    right: bool,
    height: i64,
    quotient: i64,
    remainder: i64,
    step: [i64; 2],
}

impl Side {
    fn new([px, py]: [i64; 2], [qx, qy]: [i64; 2], y: i64) -> Option<Self> {
        let (dx, dy) = (qx - px, qy - py);
        let height = dy.abs();
        if height == 0 {
            return None;
        }
        let (rest, more) = (dx * (y - py) - i64::from(dy > 0), dx * STEPS);
        let step = [more.div_euclid(height), more.rem_euclid(height)];
        Some(Self { from: px, right: dy > 0, height, quotient: rest.div_euclid(height), remainder: rest.rem_euclid(height), step })
    }

    fn advance(&mut self) {
        self.quotient += self.step[0];
        self.remainder += self.step[1];
        if self.remainder >= self.height {
            self.remainder -= self.height;
            self.quotient += 1;
        }
    }
}

/// A value that is linear over the picture, kept within its range at the corners.
struct Plane {
    origin: [f64; 2],
    value: f64,
    slope: [f64; 2],
    range: [f64; 2],
}

impl Plane {
    fn along(&self, row: usize) -> Line {
        let start = self.value + self.slope[1] * (row as f64 + 0.5 - self.origin[1]) + self.slope[0] * (0.5 - self.origin[0]);
        Line { start, slope: self.slope[0], range: self.range }
    }
}

/// The value along one row of samples.
struct Line {
    start: f64,
    slope: f64,
    range: [f64; 2],
}

impl Line {
    fn at(&self, column: usize) -> f64 {
        let value = self.start + self.slope * column as f64;
        if value < self.range[0] {
            self.range[0]
        } else if value > self.range[1] {
            self.range[1]
        } else {
            value
        }
    }
}

/// To the nearest whole number, halves away from zero.
fn rounded(value: f64) -> i64 {
    let whole = value as i64;
    let rest = value - whole as f64;
    whole + i64::from(rest >= 0.5) - i64::from(rest <= -0.5)
}

/// Columns or rows of samples from one place to another, in steps: the first, and the one after the last.
fn samples_between(low: i64, high: i64) -> [i64; 2] {
    [(low + STEPS / 2 - 1).div_euclid(STEPS), (high - STEPS / 2).div_euclid(STEPS) + 1]
}

/// The part of a range that lies within another.
fn clamped(low: i64, high: i64, within: &Range<usize>) -> Range<usize> {
    let low = low.clamp(within.start as i64, within.end as i64) as usize;
    let high = high.clamp(within.start as i64, within.end as i64) as usize;
    low..high.max(low)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn translucent(corners: [[f64; 3]; 3]) -> Fill {
        Fill { corners, light: [1.0; 3], colour: [0.0; 3], alpha: 0.5 }
    }

    #[test]
    fn analytic_neighbours_cover_each_sample_once() {
        let (a, b, c, d) = ([1.3, 2.1, 0.0], [57.2, 4.9, 0.0], [50.1, 61.7, 0.0], [3.4, 55.5, 0.0]);
        let m = [31.01, 29.37, 0.0];
        let fan: Vec<Fill> = [[a, b, m], [b, m, c], [m, c, d], [a, m, d]].map(translucent).into();
        let whole: Vec<Fill> = [[a, b, c], [a, c, d]].map(translucent).into();
        assert_eq!(rgb(&fan, 64, 64), rgb(&whole, 64, 64));
    }

    #[test]
    fn analytic_a_scan_finds_what_a_walk_finds() {
        let mut state = 1_u64;
        let mut number = |most: f64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            // Often on the middle of a sample, where the rule of edges decides.
            ((state >> 40) as f64 / 16_777_216.0 * most * 4.0).round() / 4.0
        };
        let given = [0..40, 0..40];
        for _ in 0..5000 {
            let corners = [0; 3].map(|_| [number(9.0), number(9.0), 0.0]);
            let Some(shape) = Shape::new(&corners) else { continue };
            let [columns, rows] = [shape.within(0, &given[0]), shape.within(1, &given[1])];
            let (mut scan, mut walk) = (Scan::new(&shape, columns.start, rows.start), Walk::new(&shape, rows.start));
            for row in rows {
                let [scanned, walked] = [scan.next_row(&columns), walk.next_row(&columns)];
                assert!(scanned == walked || (scanned.is_empty() && walked.is_empty()), "{corners:?} {row}");
            }
        }
    }

    #[test]
    fn analytic_what_lies_between_samples_changes_nothing() {
        let corners = [[3.26, 3.26, 0.0], [3.26, 3.7, 0.0], [3.7, 3.7, 0.0]];
        assert!(!covers_samples(&corners) && rgb(&[translucent(corners)], 8, 8).iter().all(|b| *b == 255));
        assert!(covers_samples(&[[3.2, 3.2, 0.0], [3.2, 3.7, 0.0], [3.7, 3.7, 0.0]]));
    }

    #[test]
    fn analytic_half_square_covers_half() {
        let half = Fill { alpha: 1.0, ..translucent([[0.0, 0.0, 0.0], [60.0, 0.0, 0.0], [0.0, 60.0, 0.0]]) };
        let dark = rgb(&[half], 60, 60).chunks(3).filter(|p| p[0] == 0).count();
        assert_eq!(dark, 60 * 59 / 2);
    }

    #[test]
    fn analytic_non_finite_triangles_are_left_out() {
        let bad = translucent([[f64::NAN, 0.0, 0.0], [60.0, f64::INFINITY, 0.0], [0.0, 60.0, 0.0]]);
        assert!(rgb(&[bad], 60, 60).iter().all(|&b| b == 255));
    }
}
