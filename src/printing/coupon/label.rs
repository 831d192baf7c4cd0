//! Numbers in relief, of bars like those of a pocket calculator.

use crate::solid::Feature;

/// Width of a digit over its bars, mm.
const WIDTH_MM: f64 = 1.5;
/// Height of a digit, mm.
const HEIGHT_MM: f64 = 2.6;
/// Width of a bar: one line of a 0.4 mm nozzle, mm.
const BAR_MM: f64 = 0.5;
/// Between two digits, mm.
const SPACE_MM: f64 = 0.5;
/// How far cross bars stay within the sides, mm.
const INSET_MM: f64 = 0.05;
/// How far the bars stand out, mm: two layers.
pub(super) const RELIEF_MM: f64 = 0.4;
/// How deep they reach into what carries them, mm.
const SUNK_MM: f64 = 0.1;

/// Which bars a digit has: top, upper right, lower right, bottom, lower left, upper left, middle.
const BARS: [[bool; 7]; 10] = {
    const fn bars(of: u8) -> [bool; 7] {
        let mut bars = [false; 7];
        let mut at = 0;
        while at < 7 {
            bars[at] = of & (1 << at) != 0;
            at += 1;
        }
        bars
    }
    [
        bars(0b011_1111),
        bars(0b000_0110),
        bars(0b101_1011),
        bars(0b100_1111),
        bars(0b110_0110),
        bars(0b110_1101),
        bars(0b111_1101),
        bars(0b000_0111),
        bars(0b111_1111),
        bars(0b110_1111),
    ]
};

/// Two digits, tens first, around a point of a level face.
pub(super) fn two_digits(number: u32, [x, y]: [f64; 2], face_mm: f64) -> Vec<Feature> {
    let step = 0.5 * (WIDTH_MM + SPACE_MM);
    let digits = [number / 10 % 10, number % 10];
    digits.into_iter().zip([x - step, x + step]).flat_map(|(digit, x)| one_digit(digit as usize, [x, y], face_mm)).collect()
}

fn one_digit(digit: usize, [x, y]: [f64; 2], face_mm: f64) -> Vec<Feature> {
    let (w, h, b) = (0.5 * WIDTH_MM, 0.5 * HEIGHT_MM, BAR_MM);
    let half = 0.5 * b;
    let [top, upper_right, lower_right, bottom, lower_left, upper_left, middle] = BARS[digit];
    // Sides run through, so that no two bars lie side by side in one plane; cross bars end within them.
    let side = |upper: bool, lower: bool| (upper || lower).then(|| [if lower { -h } else { -half }, if upper { h } else { half }]);
    let across = |on: bool, low: f64| on.then_some([[INSET_MM - w, low], [w - INSET_MM, low + b]]);
    let sides = [(side(upper_left, lower_left), -w), (side(upper_right, lower_right), w - b)];
    let upright = sides.into_iter().filter_map(|(side, left)| side.map(|[low, high]| [[left, low], [left + b, high]]));
    let crossing = [across(top, h - b - INSET_MM), across(middle, -half), across(bottom, INSET_MM - h)].into_iter().flatten();
    let bar = |[[x0, y0], [x1, y1]]: [[f64; 2]; 2]| {
        Feature::cuboid_between([x + x0, y + y0, face_mm - SUNK_MM], [x + x1, y + y1, face_mm + RELIEF_MM])
    };
    upright.chain(crossing).map(bar).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::MeshSolid;

    #[test]
    fn analytic_digits_differ_and_stand_out() {
        let volume = |number| MeshSolid::build(&Feature::union(two_digits(number, [0.0, 0.0], 1.0))).volume_mm3();
        // Two eights: each two sides, and three cross bars between them.
        let [long, cross] = [HEIGHT_MM * BAR_MM, (WIDTH_MM - 2.0 * BAR_MM) * BAR_MM];
        let eight = (2.0 * long + 3.0 * cross) * (RELIEF_MM + SUNK_MM);
        assert!((volume(88) - 2.0 * eight).abs() < 1e-6, "{} {eight}", volume(88));
        let mut lit: Vec<[bool; 7]> = BARS.to_vec();
        lit.sort_unstable();
        lit.dedup();
        assert_eq!(lit.len(), 10);
    }
}
