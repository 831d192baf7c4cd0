//! Words, pictures and frames on sheets, laid from the top down before any of them is written. What does not fit is laid again:
//! smaller, or on the next sheet.

use crate::report::picture::fold_scene::Picture;
use crate::report::picture::lettering::Lettering;

/// A4, points.
pub const PAPER: [f32; 2] = [595.28, 841.89];
/// Empty at each side, points.
pub const MARGIN: f32 = 45.0;
/// How far down a sheet reaches above its footer, points.
const BOTTOM: f32 = PAPER[1] - MARGIN - 4.0;
/// Distance of lines over the size of letters.
const LEADING: f32 = 1.35;
/// Size of the footer's letters, points.
const FOOT: f32 = 8.2;
/// By so much narrower a picture is tried, points.
const NARROWER: f32 = 10.0;
/// Between a frame and the words in it, sideways and upwards, points.
const IN_FRAME: [f32; 2] = [6.0, 3.0];

/// The typeface inside cannot be read, so there is no PDF.
#[derive(Debug, thiserror::Error)]
#[error("cannot make the PDF: its typeface does not read")]
pub struct PdfError;

/// Something on a sheet.
#[derive(Clone, Debug)]
pub struct Mark<'a> {
    /// On which, from 0.
    pub sheet: usize,
    /// Its upper left corner from that of the sheet, y down, points.
    pub at: [f32; 2],
    /// Its width and height, points.
    pub size: [f32; 2],
    /// What it is.
    pub what: What<'a>,
}

/// What is on a sheet.
#[derive(Clone, Debug)]
pub enum What<'a> {
    /// A line of words, with the size of its letters, points.
    Words(String, f32),
    /// A picture.
    Picture(&'a Picture),
    /// A frame around something, or the outline of a screw.
    Frame,
}

/// How far the sheets are filled; a later place is a greater one.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(super) struct Place {
    pub sheet: usize,
    pub y: f32,
}

/// Sheets that are filled from the top, in a column that reaches from margin to margin until told otherwise.
pub(super) struct Layout<'a> {
    lettering: Lettering,
    marks: Vec<Mark<'a>>,
    /// Where the next line begins.
    pub at: Place,
    left: f32,
    /// Of the column, points.
    pub width: f32,
}

impl<'a> Layout<'a> {
    /// With one empty sheet.
    ///
    /// # Errors
    /// When the typeface cannot be read.
    pub fn new() -> Result<Self, PdfError> {
        let lettering = Lettering::new().ok_or(PdfError)?;
        let at = Place { sheet: 0, y: MARGIN };
        Ok(Self { lettering, marks: Vec::new(), at, left: MARGIN, width: PAPER[0] - 2.0 * MARGIN })
    }

    pub fn new_sheet(&mut self) {
        self.at = Place { sheet: self.at.sheet + 1, y: MARGIN };
    }

    pub fn gap(&mut self, points: f32) {
        self.at.y += points;
    }

    pub fn words(&mut self, text: &str, size: f32) {
        for line in self.lettering.lines(text, f64::from(size), f64::from(self.width)) {
            let width = self.lettering.width(&line, f64::from(size)) as f32;
            self.put([0.0, 0.0], [width, LEADING * size], What::Words(line, size));
            self.gap(LEADING * size);
        }
    }

    /// A picture of a width, in the column's middle, with a frame.
    pub fn picture(&mut self, picture: &'a Picture, width: f32) {
        let size = [width, width * picture.size[1] as f32 / picture.size[0] as f32];
        let x = 0.5 * (self.width - width);
        self.put([x, 0.0], size, What::Picture(picture));
        self.put([x, 0.0], size, What::Frame);
        self.gap(size[1]);
    }

    /// Lays something with a frame around it; without one where it goes on on the next sheet.
    pub fn framed(&mut self, lay: impl FnOnce(&mut Self)) {
        let (top, [x, y]) = (self.at, IN_FRAME);
        lay(self);
        if self.at.sheet == top.sheet {
            let size = [self.width + 2.0 * x, self.at.y - top.y + 2.0 * y];
            self.marks.push(Mark { sheet: top.sheet, at: [self.left - x, top.y - y], size, what: What::Frame });
        }
    }

    /// Something beside what comes next, its corner from where that begins; on the next sheet where this one has no room for it.
    pub fn put(&mut self, [x, y]: [f32; 2], size: [f32; 2], what: What<'a>) {
        if self.at.y + y + size[1] > BOTTOM && self.at.y > MARGIN {
            self.new_sheet();
        }
        self.marks.push(Mark { sheet: self.at.sheet, at: [self.left + x, self.at.y + y], size, what });
    }

    /// Lays something into a column of its own, which begins at a place and, from the left of the present one, at `x`; gives where it ends.
    pub fn column(&mut self, from: Place, [x, width]: [f32; 2], lay: impl FnOnce(&mut Self)) -> Place {
        let whole = (self.left, self.width);
        (self.at, self.left, self.width) = (from, self.left + x, width);
        lay(self);
        (self.left, self.width) = whole;
        self.at
    }

    /// Goes on below columns.
    pub fn below(&mut self, columns: &[Place]) {
        self.at = columns.iter().copied().fold(self.at, |last, end| if end > last { end } else { last });
    }

    /// Lays something on one sheet, on the next where this one has no room for it.
    pub fn kept(&mut self, lay: impl Fn(&mut Self)) {
        if !self.tried(&lay) {
            self.new_sheet();
            lay(self);
        }
    }

    /// Lays something with a picture as wide as it may be; where a sheet has no room for it with the least picture, it goes on on the next.
    pub fn fitted(&mut self, widths: [f32; 2], lay: impl Fn(&mut Self, f32)) {
        if !self.shrunk(widths, &lay) {
            lay(self, widths[0]);
        }
    }

    /// The same, unless a sheet has no room for it: then nothing is laid.
    pub fn shrunk(&mut self, [least, widest]: [f32; 2], lay: impl Fn(&mut Self, f32)) -> bool {
        let narrower = std::iter::successors(Some(widest), |width| Some(width - NARROWER));
        narrower.take_while(|width| *width >= least).any(|width| self.tried(|sheet| lay(sheet, width)))
    }

    /// Lays something if it stays on this sheet; else nothing is laid.
    fn tried(&mut self, lay: impl Fn(&mut Self)) -> bool {
        let (marks, at) = (self.marks.len(), self.at);
        lay(self);
        let stays = self.at.sheet == at.sheet;
        if !stays {
            self.marks.truncate(marks);
            self.at = at;
        }
        stays
    }

    /// Lays something so low that it begins at a place, or as low as it still stays on the sheet.
    pub fn lowered(&mut self, to_y: f32, lay: impl Fn(&mut Self)) {
        let (from, top) = (self.marks.len(), self.at);
        lay(self);
        let by = (BOTTOM - self.at.y).min(to_y - top.y);
        if self.at.sheet == top.sheet && by > 0.0 {
            self.marks[from..].iter_mut().for_each(|mark| mark.at[1] += by);
            self.gap(by);
        }
    }

    /// Everything, with a footer on each sheet; its words follow from the sheet's number from 1 and from how many there are.
    pub fn finished(mut self, foot: impl Fn(usize, usize) -> String) -> Vec<Mark<'a>> {
        let sheets = self.at.sheet + 1;
        for sheet in 0..sheets {
            let words = foot(sheet + 1, sheets);
            let width = self.lettering.width(&words, f64::from(FOOT)) as f32;
            // A line of its own: one that is too long has smaller letters.
            let share = (self.width / width).min(1.0);
            let size = [share * width, LEADING * share * FOOT];
            self.marks.push(Mark { sheet, at: [MARGIN, PAPER[1] - MARGIN + 4.0], size, what: What::Words(words, share * FOOT) });
        }
        self.marks.sort_by_key(|mark| mark.sheet);
        self.marks
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PICTURE: Picture = Picture { rgb: Vec::new(), size: [3, 2] };

    fn sheets(layout: Layout) -> Vec<usize> {
        layout.finished(|number, all| format!("{number} of {all}")).iter().map(|mark| mark.sheet).collect()
    }

    #[test]
    fn analytic_a_picture_shrinks_until_it_stays_on_the_sheet() {
        let picture = PICTURE;
        let width_in = |used: f32| {
            let mut layout = Layout::new().expect("the typeface reads");
            layout.gap(used);
            layout.fitted([200.0, 300.0], |sheet, width| sheet.picture(&picture, width));
            (layout.at.sheet, layout.marks[0].size[0])
        };
        let room = BOTTOM - MARGIN;
        assert_eq!(width_in(room - 200.0), (0, 300.0));
        assert_eq!(width_in(room - 199.0), (0, 290.0));
        assert_eq!(width_in(room - 134.0), (0, 200.0));
        assert_eq!(width_in(room - 133.0), (1, 200.0));
    }

    #[test]
    fn analytic_words_without_end_go_on_on_the_next_sheet() {
        let mut layout = Layout::new().expect("the typeface reads");
        layout.words(&"all of them ".repeat(2000), 11.0);
        let (line, last) = (LEADING * 11.0, layout.at.sheet);
        assert!(last > 1 && layout.marks.iter().all(|mark| mark.at[1] + line <= BOTTOM));
        assert_eq!(sheets(layout).last(), Some(&last));
    }

    #[test]
    fn analytic_what_is_kept_together_is_on_one_sheet() {
        let mut layout = Layout::new().expect("the typeface reads");
        layout.gap(BOTTOM - MARGIN - 20.0);
        layout.kept(|sheet| ["one", "two"].iter().for_each(|line| sheet.words(line, 11.0)));
        assert!(layout.marks.iter().all(|mark| mark.sheet == 1) && layout.marks.len() == 2);
    }

    #[test]
    fn analytic_what_follows_columns_is_below_both() {
        let mut layout = Layout::new().expect("the typeface reads");
        let top = layout.at;
        let [empty, full] =
            [("", 0.0), ("two lines of words", 100.0)].map(|(text, x)| layout.column(top, [x, 60.0], |column| column.words(text, 11.0)));
        layout.below(&[full, empty]);
        assert_eq!((empty.y, layout.at), (top.y, full));
        assert!(full.y > top.y + 20.0);
    }
}
