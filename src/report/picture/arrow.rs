//! Arrows in a picture: along a way in space, of one width on paper, in front of everything.

use nalgebra::Point3;

use super::{camera::Camera, raster::Fill};

/// Half widths of the black line and of the white one under it, pixels.
const HALF_WIDTHS: [f64; 2] = [5.5, 3.0];
/// Length and half width of the head, pixels.
const HEAD: [f64; 2] = [24.0, 11.0];
/// How much the white head stands out, pixels.
const RIM: f64 = 4.0;
/// Nearer than anything in the picture; the black lies over the white.
const NEARNESS: [f64; 2] = [1e6, 2e6];

/// A way with a head at its end.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrow {
    /// Places along it, mm.
    pub way: Vec<Point3<f64>>,
}

impl Arrow {
    /// The triangles it is drawn by: white, then black.
    pub(in crate::report) fn fills(&self, camera: &Camera) -> Vec<Fill> {
        let seen: Vec<[f64; 2]> = self.way.iter().map(|p| camera.project(p)).map(|[x, y, _]| [x, y]).collect();
        let Some((shaft, along, tip)) = shaft(&seen) else { return Vec::new() };
        let mut fills = Vec::new();
        for (layer, half) in HALF_WIDTHS.into_iter().enumerate() {
            let (shade, near) = (if layer == 0 { 1.0 } else { 0.0 }, NEARNESS[layer]);
            let mut add = |corners: [[f64; 2]; 3]| {
                let corners = corners.map(|[x, y]| [x, y, near]);
                fills.push(Fill { corners, light: [1.0; 3], colour: [shade; 3], alpha: 1.0 });
            };
            for ends in shaft.windows(2) {
                stroke(ends[0], ends[1], half).into_iter().for_each(&mut add);
            }
            let rim = if layer == 0 { RIM } else { 0.0 };
            let at =
                |forward: f64, side: f64| [tip[0] + forward * along[0] - side * along[1], tip[1] + forward * along[1] + side * along[0]];
            add([at(1.6 * rim, 0.0), at(-HEAD[0] - rim, HEAD[1] + 1.2 * rim), at(-HEAD[0] - rim, -HEAD[1] - 1.2 * rim)]);
        }
        fills
    }
}

/// A line, the direction at its end, and where the tip is, pixels.
type Shaft = (Vec<[f64; 2]>, [f64; 2], [f64; 2]);

/// The line without what the head covers, the head's direction, and its tip; none when there is nothing to see.
fn shaft(seen: &[[f64; 2]]) -> Option<Shaft> {
    let tip = *seen.last()?;
    let from_tip = |p: &[f64; 2]| libm::hypot(p[0] - tip[0], p[1] - tip[1]);
    let last = seen.iter().rposition(|p| from_tip(p) >= 0.9 * HEAD[0])?;
    let (base, length) = (seen[last], from_tip(&seen[last]));
    let along = [(tip[0] - base[0]) / length, (tip[1] - base[1]) / length];
    let mut line = seen[..=last].to_vec();
    line.push([tip[0] - 0.8 * HEAD[0] * along[0], tip[1] - 0.8 * HEAD[0] * along[1]]);
    Some((line, along, tip))
}

/// A thick line with a little over at both ends.
fn stroke(a: [f64; 2], b: [f64; 2], half: f64) -> [[[f64; 2]; 3]; 2] {
    let length = libm::hypot(b[0] - a[0], b[1] - a[1]).max(1e-9);
    let (ux, uy) = ((b[0] - a[0]) / length * half, (b[1] - a[1]) / length * half);
    let corner = |p: [f64; 2], along: f64, across: f64| [p[0] + 0.4 * along * ux - across * uy, p[1] + 0.4 * along * uy + across * ux];
    let [p, q, r, s] = [corner(a, -1.0, -1.0), corner(b, 1.0, -1.0), corner(b, 1.0, 1.0), corner(a, -1.0, 1.0)];
    [[p, q, r], [p, r, s]]
}
