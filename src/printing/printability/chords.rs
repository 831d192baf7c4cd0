//! Straight lines across what hangs: which of them rest on something at both ends.

use crate::solid::Region;
use crate::units::Angle;

/// Directions that are tried, a step of this many degrees.
const STEP_DEG: f64 = 15.0;
/// How far beyond its end a line must find something to rest on, mm.
const BEYOND_MM: f64 = 0.1;
/// Corners nearer than this to the line between their neighbours are left out, mm.
const WITHIN_MM: f64 = 0.01;
/// Fewest lines in a direction: with fewer, what is loose depends on where they happen to lie, and so on the nozzle.
const FEWEST_LINES: f64 = 24.0;
/// Most lines in a direction.
const MOST_LINES: f64 = 40.0;

/// What hangs, laid in lines of one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Laid {
    /// Area of lines that rest at one end only, or at none, mm².
    pub loose_mm2: f64,
    /// Longest line that rests at both ends, mm.
    pub span_mm: f64,
    /// How far from all support the farthest end of a loose line is, mm; 0 without any.
    pub loose_reach_mm: f64,
}

/// The direction in which least is loose, and of those alike the one with the shortest lines.
pub(super) fn best(hanging: &Region, support: &Region, line_mm: f64) -> Laid {
    let (hanging, support) = (hanging.simplified(WITHIN_MM).contours(), support.simplified(WITHIN_MM).contours());
    let laid = (0..(180.0 / STEP_DEG) as usize).map(|step| laid(&hanging, &support, Angle::deg(step as f64 * STEP_DEG), line_mm));
    let none = Laid { loose_mm2: f64::INFINITY, span_mm: 0.0, loose_reach_mm: f64::INFINITY };
    laid.fold(none, |best, laid| {
        let slack = 0.02 * best.loose_mm2.min(laid.loose_mm2) + 0.01;
        let alike = (laid.loose_mm2 - best.loose_mm2).abs() <= slack;
        if if alike { laid.span_mm < best.span_mm } else { laid.loose_mm2 < best.loose_mm2 } { laid } else { best }
    })
}

type Contours = [Vec<[f64; 2]>];

fn laid(hanging: &Contours, support: &Contours, direction: Angle, line_mm: f64) -> Laid {
    let (sin, cos) = (direction.sin(), direction.cos());
    let turned = |contours: &Contours| -> Vec<Vec<[f64; 2]>> {
        contours.iter().map(|c| c.iter().map(|[x, y]| [x * cos + y * sin, y * cos - x * sin]).collect()).collect()
    };
    let (hanging, support) = (turned(hanging), turned(support));
    let heights = || hanging.iter().flatten().map(|p| p[1]);
    let [low, high] = [heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max)];
    let lines = ((high - low) / line_mm).ceil().clamp(FEWEST_LINES, MOST_LINES);
    let spacing = (high - low) / lines;
    let edges = edges(&support);
    let mut laid = Laid { loose_mm2: 0.0, span_mm: 0.0, loose_reach_mm: 0.0 };
    for line in 0..lines as usize {
        let y = low + (line as f64 + 0.5) * spacing;
        let under = crossings(&support, y);
        let rests = |x: f64| under.chunks_exact(2).any(|on| on[0] <= x && x <= on[1]);
        for ends in crossings(&hanging, y).chunks_exact(2) {
            let length = ends[1] - ends[0];
            if rests(ends[0] - BEYOND_MM) && rests(ends[1] + BEYOND_MM) {
                laid.span_mm = laid.span_mm.max(length);
            } else {
                laid.loose_mm2 += length * spacing;
                // Its ends: between two that are near support it is carried like a bridge.
                let reach_mm = ends.iter().map(|x| nearest_mm(&[*x, y], &edges)).fold(0.0, f64::max);
                laid.loose_reach_mm = laid.loose_reach_mm.max(reach_mm);
            }
        }
    }
    laid
}

/// The distance of the corner of what hangs that is farthest from all support, mm; endless without any.
pub(super) fn farthest_mm(hanging: &Region, support: &Region) -> f64 {
    let edges = edges(&support.contours());
    hanging.contours().iter().flatten().map(|p| nearest_mm(p, &edges)).fold(0.0, f64::max)
}

fn edges(contours: &Contours) -> Vec<[[f64; 2]; 2]> {
    contours.iter().flat_map(|c| c.iter().enumerate().map(|(i, a)| [*a, c[(i + 1) % c.len()]])).collect()
}

/// The distance of a point from the nearest edge, mm; endless without any.
fn nearest_mm(p: &[f64; 2], edges: &[[[f64; 2]; 2]]) -> f64 {
    let to_edge = |[a, b]: &[[f64; 2]; 2]| {
        let (along, from) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
        let length = along[0] * along[0] + along[1] * along[1];
        let t = if length > 0.0 { ((along[0] * from[0] + along[1] * from[1]) / length).clamp(0.0, 1.0) } else { 0.0 };
        libm::hypot(from[0] - t * along[0], from[1] - t * along[1])
    };
    edges.iter().map(to_edge).fold(f64::INFINITY, f64::min)
}

/// Where a line of the first axis at y crosses the contours, in order: in, out, in, out.
fn crossings(contours: &Contours, y: f64) -> Vec<f64> {
    let mut at = Vec::new();
    for contour in contours {
        for (i, a) in contour.iter().enumerate() {
            let b = contour[(i + 1) % contour.len()];
            if (a[1] > y) != (b[1] > y) {
                at.push(a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
            }
        }
    }
    at.sort_by(f64::total_cmp);
    at
}
