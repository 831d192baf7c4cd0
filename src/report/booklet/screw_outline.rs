//! A screw from the side, as large as it is: its head and its shank, so that a person can lay one onto the paper.

use std::fmt::Write;

use crate::frame::mounting::PartLine;

/// Around the outline in a page for a browser, so that its strokes are seen whole, mm.
const AROUND_MM: f64 = 0.3;

/// The outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScrewOutline {
    /// Thread, and length under the head.
    shank_mm: [f64; 2],
    /// Width and height of the head.
    head_mm: [f64; 2],
}

impl ScrewOutline {
    /// That of a line of parts; none of other parts than screws.
    pub fn of(line: &PartLine) -> Option<Self> {
        line.screw_mm.zip(line.head_mm).map(|(shank_mm, head_mm)| Self { shank_mm, head_mm })
    }

    /// Head and shank, the head at the left: x, y down, width and height.
    pub fn rectangles_mm(&self) -> [[f64; 4]; 2] {
        let ([thread, length], [wide, high]) = (self.shank_mm, self.head_mm);
        [[0.0, 0.5 * (self.high_mm() - wide), high, wide], [high, 0.5 * (self.high_mm() - thread), length, thread]]
    }

    /// How high it is drawn.
    pub fn high_mm(&self) -> f64 {
        self.head_mm[0].max(self.shank_mm[0])
    }

    /// As a picture in a page for a browser.
    pub fn svg(&self) -> String {
        let [width, height] = [self.head_mm[1] + self.shank_mm[1], self.high_mm()].map(|mm| mm + 2.0 * AROUND_MM);
        let around = -AROUND_MM;
        let mut svg = format!(
            "<svg class=\"screw\" width=\"{width:.2}mm\" height=\"{height:.2}mm\" viewBox=\"{around} {around} {width:.2} {height:.2}\" \
             role=\"img\" aria-label=\"outline\">"
        );
        for [x, y, width, height] in self.rectangles_mm() {
            // Writing to a String cannot fail.
            let _ = write!(svg, "<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{width:.2}\" height=\"{height:.2}\"/>");
        }
        svg + "</svg>"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_unit_of_the_picture_is_a_millimetre() {
        let line = |screw_mm| PartLine { part: "screw".into(), count: 1.0, screw_mm, head_mm: Some([3.8, 2.0]), body: None };
        assert_eq!(ScrewOutline::of(&line(None)), None);
        let svg = ScrewOutline::of(&line(Some([2.0, 18.0]))).expect("is a screw").svg();
        assert!(svg.contains("width=\"20.60mm\" height=\"4.40mm\" viewBox=\"-0.3 -0.3 20.60 4.40\""), "{svg}");
        assert!(svg.contains("<rect x=\"0.00\" y=\"0.00\" width=\"2.00\" height=\"3.80\"/>"), "{svg}");
        assert!(svg.contains("<rect x=\"2.00\" y=\"0.90\" width=\"18.00\" height=\"2.00\"/>"), "{svg}");
    }
}
