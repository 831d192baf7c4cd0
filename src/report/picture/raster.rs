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

/// Draws the triangles in their order over white; red, green, blue bytes of each pixel, row by row.
pub fn rgb(fills: &[Fill], width: usize, height: usize) -> Vec<u8> {
    let bands = height.div_ceil(BAND_ROWS);
    let mut members: Vec<Vec<&Fill>> = vec![Vec::new(); bands];
    for fill in fills.iter().filter(|f| f.is_finite()) {
        let rows = fill.corners.map(|c| c[1] / BAND_ROWS as f64);
        let low = rows.into_iter().fold(f64::INFINITY, f64::min).floor().max(0.0) as usize;
        let high = rows.into_iter().fold(f64::NEG_INFINITY, f64::max).floor();
        if high >= 0.0 {
            members[low.min(bands)..(high as usize + 1).clamp(low.min(bands), bands)].iter_mut().for_each(|m| m.push(fill));
        }
    }
    let table = display_table();
    let drawn = members.par_iter().enumerate().map(|(band, fills)| {
        let rows = band * BAND_ROWS..((band + 1) * BAND_ROWS).min(height);
        if fills.is_empty() {
            return vec![u8::MAX; width * rows.len() * 3];
        }
        let mut samples = Samples::white(width * SAMPLES, rows.start * SAMPLES..rows.end * SAMPLES);
        fills.iter().for_each(|fill| samples.draw(fill));
        samples.averaged(&table)
    });
    drawn.collect::<Vec<_>>().concat()
}

/// Display value (sRGB) of evenly spaced linear intensities.
fn display_table() -> Vec<u8> {
    let display = |x: f64| if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * libm::pow(x, 1.0 / 2.4) - 0.055 };
    (0..=TABLE).map(|i| (255.0 * display(i as f64 / TABLE as f64)).round() as u8).collect()
}

/// A band of the picture while it is drawn.
struct Samples {
    width: usize,
    rows: Range<usize>,
    near: Vec<f32>,
    colour: Vec<[f32; 3]>,
    /// Samples of each row between which anything was drawn.
    touched: Vec<Range<usize>>,
}

impl Samples {
    fn white(width: usize, rows: Range<usize>) -> Self {
        let count = width * rows.len();
        let touched = vec![width..0; rows.len()];
        Self { width, rows, near: vec![f32::MIN; count], colour: vec![[1.0; 3]; count], touched }
    }

    fn draw(&mut self, fill: &Fill) {
        let Some(shape) = Shape::new(&fill.corners) else { return };
        let rows = shape.rows(&self.rows);
        if rows.is_empty() || shape.misses_columns() {
            return;
        }
        let near = shape.plane(fill.corners.map(|c| c[2]));
        let light = shape.plane(fill.light.map(f64::from));
        let mut walk = Walk::new(&shape, rows.start);
        for row in rows {
            let columns = walk.next_row(self.width);
            if columns.is_empty() {
                continue;
            }
            let touched = &mut self.touched[row - self.rows.start];
            *touched = touched.start.min(columns.start)..touched.end.max(columns.end);
            let start = (row - self.rows.start) * self.width;
            let (near, light) = (near.along(row), light.along(row));
            let span = start + columns.start..start + columns.end;
            for ((column, depth), colour) in columns.zip(&mut self.near[span.clone()]).zip(&mut self.colour[span]) {
                let here = near.at(column) as f32;
                if here > *depth {
                    let bright = light.at(column) as f32;
                    if fill.alpha < 1.0 {
                        *colour = [0, 1, 2].map(|i| colour[i] + fill.alpha * (fill.colour[i] * bright - colour[i]));
                    } else {
                        *depth = here;
                        *colour = fill.colour.map(|c| c * bright);
                    }
                }
            }
        }
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
                let mut sum = [0.0_f32; 3];
                for samples in row..row + SAMPLES {
                    for colour in &self.colour[samples * self.width + column..][..SAMPLES] {
                        (0..3).for_each(|i| sum[i] += colour[i].clamp(0.0, 1.0));
                    }
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
        let step = |c: f64| (c.clamp(-limit, limit) * (SAMPLES as i64 * STEPS) as f64).round() as i64;
        let [a, b, c] = corners.map(|p| [step(p[0]), step(p[1])]);
        let twice_area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        match twice_area.signum() {
            1 => Some(Self { corners: [a, b, c], order: [0, 1, 2], twice_area }),
            -1 => Some(Self { corners: [a, c, b], order: [0, 2, 1], twice_area: -twice_area }),
            _ => None,
        }
    }

    /// Rows of samples it may touch, of those given.
    fn rows(&self, given: &Range<usize>) -> Range<usize> {
        let low = self.corners.iter().map(|c| c[1]).fold(i64::MAX, i64::min);
        let high = self.corners.iter().map(|c| c[1]).fold(i64::MIN, i64::max);
        clamped(div_ceil(low - STEPS / 2, STEPS), (high - STEPS / 2).div_euclid(STEPS) + 1, given)
    }

    /// Whether it lies between two columns of samples.
    fn misses_columns(&self) -> bool {
        let low = self.corners.iter().map(|c| c[0]).fold(i64::MAX, i64::min);
        let high = self.corners.iter().map(|c| c[0]).fold(i64::MIN, i64::max);
        div_ceil(low - STEPS / 2, STEPS) > (high - STEPS / 2).div_euclid(STEPS)
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
    fn next_row(&mut self, width: usize) -> Range<usize> {
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
        clamped(div_ceil(low - STEPS / 2, STEPS), (high - STEPS / 2).div_euclid(STEPS) + 1, &(0..width))
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

/// Quotient rounded up, for a positive divisor.
fn div_ceil(a: i64, b: i64) -> i64 {
    -(-a).div_euclid(b)
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
