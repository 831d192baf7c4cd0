//! Words beside what they name: each where the picture is white, as near as it can be, with a thin line to its thing.

use super::lettering::Lettering;

/// Distances from the named point at which a label is tried, pixels.
const DISTANCES: [f64; 12] = [14.0, 22.0, 32.0, 44.0, 60.0, 80.0, 105.0, 135.0, 170.0, 215.0, 270.0, 340.0];
/// Directions that are tried at each distance.
const DIRECTIONS: usize = 24;
/// White around the words, pixels.
const ROOM: [f64; 2] = [7.0, 3.0];
/// Height of a line of words over the height of their letters.
const LINE: f64 = 1.24;
/// Grey of the lines.
const GREY: u8 = 110;

/// A picture that takes labels.
pub(super) struct Labels<'a> {
    rgb: &'a mut [u8],
    width: usize,
    height: usize,
    lettering: Lettering,
    /// Boxes that are taken: low x, low y, high x, high y.
    taken: Vec<[f64; 4]>,
}

impl<'a> Labels<'a> {
    /// A picture of this width, pixels; none without a typeface.
    pub fn on(rgb: &'a mut [u8], width: u32) -> Option<Self> {
        let width = width.max(1) as usize;
        let height = rgb.len() / 3 / width;
        Some(Self { rgb, width, height, lettering: Lettering::new()?, taken: Vec::new() })
    }

    /// Writes words beside a point, pixels; not at all where no white is near.
    pub fn put(&mut self, words: &str, size: f64, at: [f64; 2]) {
        let half = [0.5 * self.lettering.width(words, size) + ROOM[0], 0.5 * LINE * size + ROOM[1]];
        let Some(middle) = self.free(at, half) else { return };
        self.taken.push([middle[0] - half[0], middle[1] - half[1], middle[0] + half[0], middle[1] + half[1]]);
        self.line(at, beside(at, middle, half));
        self.lettering.write(self.rgb, self.width, words, size, middle);
    }

    /// The middle of a free box as near to a point as can be: one whose line crosses nothing on its way, or else no words.
    fn free(&self, at: [f64; 2], half: [f64; 2]) -> Option<[f64; 2]> {
        let places: Vec<[f64; 2]> = around(at, half).filter(|middle| self.is_free(*middle, half)).collect();
        let crossing = |middle: &&[f64; 2]| self.crosses(at, beside(at, **middle, half));
        let clean = places.iter().find(|middle| crossing(middle) == Crossing::Nothing);
        clean.or_else(|| places.iter().find(|middle| crossing(middle) == Crossing::Things)).copied()
    }

    /// What a line crosses after it has left what it begins in.
    fn crosses(&self, from: [f64; 2], to: [f64; 2]) -> Crossing {
        let steps = libm::hypot(to[0] - from[0], to[1] - from[1]).ceil() as usize;
        let (mut outside, mut crossed) = (false, Crossing::Nothing);
        for step in 0..=steps {
            let [x, y] = [0, 1].map(|axis| from[axis] + step as f64 / steps.max(1) as f64 * (to[axis] - from[axis]));
            if self.taken.iter().any(|[x0, y0, x1, y1]| (*x0..=*x1).contains(&x) && (*y0..=*y1).contains(&y)) {
                return Crossing::Words;
            }
            let white = self.is_white(x, y);
            outside |= white;
            if outside && !white {
                crossed = Crossing::Things;
            }
        }
        crossed
    }

    fn is_white(&self, x: f64, y: f64) -> bool {
        let (x, y) = (x.max(0.0) as usize, y.max(0.0) as usize);
        x < self.width && y < self.height && self.rgb[3 * (y * self.width + x)..][..3].iter().all(|v| *v == 255)
    }

    fn is_free(&self, [x, y]: [f64; 2], half: [f64; 2]) -> bool {
        let (low, high) = ([x - half[0], y - half[1]], [x + half[0], y + half[1]]);
        if low[0] < 1.0 || low[1] < 1.0 || high[0] > self.width as f64 - 2.0 || high[1] > self.height as f64 - 2.0 {
            return false;
        }
        let apart = |[x0, y0, x1, y1]: &[f64; 4]| high[0] < *x0 || *x1 < low[0] || high[1] < *y0 || *y1 < low[1];
        if !self.taken.iter().all(apart) {
            return false;
        }
        (low[1] as usize..=high[1] as usize).all(|row| {
            self.rgb[3 * (row * self.width + low[0] as usize)..=3 * (row * self.width + high[0] as usize)].iter().all(|v| *v == 255)
        })
    }

    /// A line of single pixels over white and over what is drawn, with a dot where it begins.
    fn line(&mut self, from: [f64; 2], to: [f64; 2]) {
        let steps = libm::hypot(to[0] - from[0], to[1] - from[1]).ceil().max(1.0) as usize;
        for step in 0..=steps {
            let share = step as f64 / steps as f64;
            self.dot([0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis])), 0);
        }
        self.dot(from, 2);
    }

    fn dot(&mut self, [x, y]: [f64; 2], reach: i64) {
        for (dx, dy) in (-reach..=reach).flat_map(|dx| (-reach..=reach).map(move |dy| (dx, dy))) {
            let (x, y) = (x.round() as i64 + dx, y.round() as i64 + dy);
            if (0..self.width as i64).contains(&x) && (0..self.height as i64).contains(&y) {
                let at = 3 * (y as usize * self.width + x as usize);
                self.rgb[at..at + 3].fill(GREY);
            }
        }
    }
}

/// What a line crosses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Crossing {
    Nothing,
    Things,
    Words,
}

/// Middles of boxes around a point, the nearest first.
fn around(at: [f64; 2], half: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    DISTANCES.into_iter().flat_map(move |distance| {
        (0..DIRECTIONS).map(move |direction| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * direction as f64 / DIRECTIONS as f64);
            // The box touches a circle around the point.
            let out = distance + half[0] * cos.abs() + half[1] * sin.abs();
            [at[0] + out * cos, at[1] + out * sin]
        })
    })
}

/// The point of the words' box that is nearest to what they name.
fn beside(at: [f64; 2], middle: [f64; 2], half: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|axis| at[axis].clamp(middle[axis] - half[axis] + ROOM[axis], middle[axis] + half[axis] - ROOM[axis]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_words_stand_on_white_and_apart() {
        // A black square in the middle, and the same point named many times.
        let (width, height) = (400_usize, 300_usize);
        let mut rgb = vec![255; 3 * width * height];
        let square = |x: usize, y: usize| (150..250).contains(&x) && (100..200).contains(&y);
        for (x, y) in (0..width).flat_map(|x| (0..height).map(move |y| (x, y))).filter(|(x, y)| square(*x, *y)) {
            rgb[3 * (y * width + x)..3 * (y * width + x) + 3].fill(0);
        }
        let mut labels = Labels::on(&mut rgb, width as u32).expect("the typeface reads");
        for words in ["hub", "knee", "fork", "a rather long name"] {
            labels.put(words, 16.0, [200.0, 150.0]);
        }
        let taken = labels.taken.clone();
        assert_eq!(taken.len(), 4);
        for (at, [x0, y0, x1, y1]) in taken.iter().enumerate() {
            assert!(*x1 < 150.0 || *x0 > 249.0 || *y1 < 100.0 || *y0 > 199.0, "{taken:?}");
            assert!(*x0 >= 0.0 && *y0 >= 0.0 && *x1 <= 400.0 && *y1 <= 300.0, "{taken:?}");
            for [a0, b0, a1, b1] in &taken[at + 1..] {
                assert!(x1 < a0 || a1 < x0 || y1 < b0 || b1 < y0, "{taken:?}");
            }
        }
    }

    #[test]
    fn planted_a_picture_without_white_takes_no_words() {
        let mut rgb = vec![90; 3 * 200 * 100];
        Labels::on(&mut rgb, 200).expect("the typeface reads").put("hub", 16.0, [100.0, 50.0]);
        assert!(rgb.iter().all(|v| *v == 90));
    }
}
