//! Words: how wide they are, how they break into lines, and how they are written into a picture.

use ab_glyph::{Font, FontRef, PxScale, ScaleFont, point};

/// The typeface of everything that is drawn, compiled in.
pub(in crate::report) const TYPEFACE: &[u8] = epaint_default_fonts::UBUNTU_LIGHT;

/// How far the letters of a typeface reach, thousandths of their size, y up from the baseline.
pub(in crate::report) struct Shape {
    /// Above the baseline.
    pub ascent: f32,
    /// Below it, negative.
    pub descent: f32,
    /// Lower left corner of a box around any letter.
    pub low: [f32; 2],
    /// Upper right corner.
    pub high: [f32; 2],
}

/// Measures and draws words.
pub(in crate::report) struct Lettering {
    font: FontRef<'static>,
}

impl Lettering {
    /// With the typeface; none if it could not be read, which it can.
    pub fn new() -> Option<Self> {
        FontRef::try_from_slice(TYPEFACE).ok().map(|font| Self { font })
    }

    /// Width of words whose letters are this high from line to line as fonts are named by, in the same unit.
    pub fn width(&self, text: &str, size: f64) -> f64 {
        let units = f64::from(self.font.units_per_em().unwrap_or(1000.0));
        text.chars().map(|c| f64::from(self.font.h_advance_unscaled(self.font.glyph_id(c)))).sum::<f64>() / units * size
    }

    /// Number of a letter's glyph in the typeface; zero for what it lacks.
    pub fn glyph(&self, letter: char) -> u16 {
        self.font.glyph_id(letter).0
    }

    /// How far its letters reach.
    pub fn shape(&self) -> Shape {
        let units = self.font.units_per_em().unwrap_or(1000.0);
        let thousandths = |value: f32| value / units * 1000.0;
        let (ascent, descent) = (thousandths(self.font.ascent_unscaled()), thousandths(self.font.descent_unscaled()));
        let widest = self.font.codepoint_ids().map(|(id, _)| thousandths(self.font.h_advance_unscaled(id))).fold(0.0, f32::max);
        Shape { ascent, descent, low: [0.0, descent], high: [widest, ascent] }
    }

    /// Lines no wider than a width, broken at spaces; a word that is wider is broken within.
    pub fn lines(&self, text: &str, size: f64, width: f64) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        for word in text.split_whitespace() {
            match lines.last_mut() {
                Some(line) if self.width(&format!("{line} {word}"), size) <= width => {
                    line.push(' ');
                    line.push_str(word);
                }
                _ => lines.extend(self.pieces(word, size, width)),
            }
        }
        lines
    }

    /// A word in pieces no wider than a width, a letter at least; after a dash, a dot or an underscore where a piece has one.
    fn pieces(&self, word: &str, size: f64, width: f64) -> Vec<String> {
        let (mut pieces, mut rest) = (Vec::new(), word);
        while self.width(rest, size) > width {
            let ends = rest.char_indices().map(|(at, letter)| at + letter.len_utf8());
            let fitting: Vec<usize> = ends.take_while(|end| self.width(&rest[..*end], size) <= width).collect();
            let first = rest.chars().next().map_or(0, char::len_utf8);
            let parted = fitting.iter().rev().find(|end| rest[..**end].ends_with(['-', '_', '.']));
            let end = *parted.or(fitting.last()).unwrap_or(&first);
            if end == rest.len() {
                break;
            }
            pieces.push(rest[..end].to_string());
            rest = &rest[end..];
        }
        pieces.push(rest.to_string());
        pieces
    }

    /// Writes black words on a white ground into a picture of this width, their middle at a place, pixels.
    pub fn write(&self, rgb: &mut [u8], width: usize, text: &str, size: f64, middle: [f64; 2]) {
        let scale =
            PxScale::from((size * f64::from(self.font.height_unscaled()) / f64::from(self.font.units_per_em().unwrap_or(1000.0))) as f32);
        let scaled = self.font.as_scaled(scale);
        let half = [0.5 * self.width(text, size) + 4.0, 0.62 * size];
        let height = rgb.len() / 3 / width.max(1);
        let middle = [
            middle[0].clamp(half[0], (width as f64 - half[0]).max(half[0])),
            middle[1].clamp(half[1], (height as f64 - half[1]).max(half[1])),
        ];
        let mut put = |x: f64, y: f64, grey: f64| {
            if (0.0..width as f64).contains(&x) && (0.0..height as f64).contains(&y) {
                let at = 3 * (y as usize * width + x as usize);
                rgb[at..at + 3].fill(grey as u8);
            }
        };
        for y in (middle[1] - half[1]) as i64..=(middle[1] + half[1]) as i64 {
            for x in (middle[0] - half[0]) as i64..=(middle[0] + half[0]) as i64 {
                put(x as f64, y as f64, 255.0);
            }
        }
        let (mut x, baseline) = (middle[0] - half[0] + 4.0, middle[1] + 0.36 * size);
        for letter in text.chars() {
            let id = self.font.glyph_id(letter);
            let glyph = id.with_scale_and_position(scale, point(x as f32, baseline as f32));
            if let Some(outline) = self.font.outline_glyph(glyph) {
                let low = outline.px_bounds().min;
                outline.draw(|dx, dy, share| {
                    if share > 0.02 {
                        put(f64::from(low.x) + f64::from(dx), f64::from(low.y) + f64::from(dy), 255.0 * (1.0 - f64::from(share.min(1.0))));
                    }
                });
            }
            x += f64::from(scaled.h_advance(id));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_lines_are_no_wider_than_asked() {
        let lettering = Lettering::new().expect("the typeface reads");
        let text = "Push a cage rod into the top corner, towards the next module, and turn the frame by a quarter.";
        let lines = lettering.lines(text, 10.0, 120.0);
        assert!(lines.len() > 2 && lines.iter().all(|line| lettering.width(line, 10.0) <= 120.0), "{lines:?}");
        assert_eq!(lines.join(" "), text);
    }

    /// Names have no spaces, and up to 100 letters.
    #[test]
    fn analytic_a_word_wider_than_its_line_is_broken_and_loses_nothing() {
        let lettering = Lettering::new().expect("the typeface reads");
        let name = "a-rather-long-name_of-a-frame.v2".repeat(3);
        for text in [name.as_str(), &"w".repeat(100)] {
            let lines = lettering.lines(text, 20.0, 180.0);
            assert!(lines.len() > 2 && lines.iter().all(|line| lettering.width(line, 20.0) <= 180.0), "{lines:?}");
            assert_eq!(lines.concat(), text);
        }
        let lines = lettering.lines(&name, 20.0, 180.0);
        assert!(lines[..lines.len() - 1].iter().all(|line| line.ends_with(['-', '_', '.'])), "{lines:?}");
        assert_eq!(lettering.lines("wide", 20.0, 1.0), ["w", "i", "d", "e"]);
    }

    #[test]
    fn analytic_words_blacken_their_place_only() {
        let mut rgb = vec![200; 3 * 100 * 40];
        Lettering::new().expect("the typeface reads").write(&mut rgb, 100, "115°", 20.0, [50.0, 20.0]);
        assert!(rgb.iter().any(|v| *v < 60) && rgb[..300].iter().all(|v| *v == 200));
    }
}
