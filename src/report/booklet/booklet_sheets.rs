//! What is on each sheet of the printed instructions: a title page, a page of parts and rods, a page a sub-assembly, two mounts a page, and
//! a page a step of the fold.

use crate::frame::mounting::PartLine;
use crate::report::booklet::content::{Booklet, Page, Panel};
use crate::report::booklet::layout::{Layout, MARGIN, Mark, PAPER, PdfError, What};
use crate::report::booklet::lists::Lists;
use crate::report::booklet::screw_outline::ScrewOutline;
use crate::report::booklet::sub_assembly::SubAssembly;
use crate::report::picture::fold_scene::Picture;
use crate::report::picture::mount_scene::Held;

/// Size of the letters of headings, points; below of text and of tables.
const HEADING: f32 = 20.0;
const TEXT: f32 = 11.0;
const SMALL: f32 = 8.2;
/// Least and greatest width of the title's picture, points: the names of the parts stand in it.
const TITLE_PICTURE: [f32; 2] = [400.0, PAPER[0] - 2.0 * MARGIN];
/// The same of a step's pictures where there are two.
const STEP_PICTURE: [f32; 2] = [250.0, 385.0];
/// The same of the picture of a mount or of a sub-assembly.
const PANEL_PICTURE: [f32; 2] = [195.0, 335.0];
/// Between two mounts on a sheet, and between a picture and the parts beside it, points.
const PANEL_GAP: f32 = 14.0;
const BESIDE: f32 = 10.0;
/// Width and height of the picture of a part, and width of its cell, points.
const PART: [f32; 2] = [68.0, 51.0];
const PART_CELL: f32 = 120.0;
/// Between a picture and its caption, points.
const CAPTION_GAP: f32 = 1.5;
/// Where the columns of the table of parts begin, and how wide they are, points: how many, what, of what.
const PART_COLUMNS: [[f32; 2]; 3] = [[0.0, 26.0], [28.0, 128.0], [160.0, 120.0]];
/// Where the page's right column begins, a share of its width.
const RIGHT: f32 = 0.6;
/// Points in a millimetre.
const MM: f32 = 72.0 / 25.4;

/// All that is on the sheets of the instructions.
///
/// # Errors
/// When the typeface cannot be read.
pub fn marks(booklet: &Booklet) -> Result<Vec<Mark<'_>>, PdfError> {
    let mut sheets = Sheets { layout: Layout::new()?, booklet };
    sheets.title();
    sheets.lists(&booklet.lists);
    let [centre, module, cartridge] = &booklet.assemblies;
    sheets.sub_assembly(centre);
    sheets.panels(&booklet.before);
    sheets.sub_assembly(module);
    booklet.pages.iter().for_each(|step| sheets.step(step));
    let [wires, rest] = booklet.around_cartridge();
    sheets.panels(wires);
    sheets.sub_assembly(cartridge);
    sheets.panels(rest);
    Ok(sheets.layout.finished(|number, all| format!("{}, page {number} of {all}", booklet.frame)))
}

struct Sheets<'a> {
    layout: Layout<'a>,
    booklet: &'a Booklet,
}

impl<'a> Sheets<'a> {
    fn title(&mut self) {
        let booklet = self.booklet;
        self.layout.fitted(TITLE_PICTURE, |sheet, width| {
            sheet.words(&booklet.title(), HEADING);
            sheet.gap(6.0);
            sheet.picture(&booklet.apart, width);
            sheet.gap(4.0);
            for line in &booklet.preface {
                sheet.gap(2.0);
                sheet.words(line, SMALL + 1.0);
            }
        });
    }

    /// What to have at hand: the parts, the rods to cut, and what is used up.
    fn lists(&mut self, lists: &Lists) {
        self.layout.new_sheet();
        let (top, whole) = (self.layout.at, self.layout.width);
        let left = self.layout.column(top, [0.0, (RIGHT - 0.04) * whole], |sheet| {
            sheet.words("Parts", TEXT + 2.0);
            lists.parts.iter().for_each(|row| sheet.kept(|sheet| row_of_parts(sheet, row)));
        });
        let right = self.layout.column(top, [RIGHT * whole, (1.0 - RIGHT) * whole], |sheet| {
            listed(sheet, "Cut the rods, mm", &lists.cuts);
            sheet.gap(8.0);
            listed(sheet, "Used up", &lists.supplies);
            sheet.gap(8.0);
            listed(sheet, "Tools", &[format!("{}.", lists.tools.join(", "))]);
        });
        self.layout.below(&[left, right]);
    }

    fn sub_assembly(&mut self, of: &'a SubAssembly) {
        let booklet = self.booklet;
        self.layout.new_sheet();
        self.layout.fitted(PANEL_PICTURE, |sheet, width| {
            sheet.words(&of.heading, HEADING);
            sheet.words(&of.text, TEXT);
            sheet.gap(6.0);
            picture_beside(sheet, (&of.picture, Held::Upright.words()), width, |sheet| {
                sheet.words("Its steps", TEXT);
                of.steps.iter().for_each(|step| sheet.words(step, SMALL + 0.8));
            });
            sheet.gap(8.0);
            sheet.words("Its parts", TEXT);
            parts(sheet, booklet, of.parts.iter().map(|(words, line)| (words.clone(), line)));
        });
    }

    /// Two on a sheet with pictures as wide as they then may be; one where even the least leave no room for two.
    fn panels(&mut self, panels: &'a [Panel]) {
        let booklet = self.booklet;
        let mut left = panels;
        while let [first, others @ ..] = left {
            self.layout.new_sheet();
            left = match others {
                [second, others @ ..]
                    if self.layout.shrunk(PANEL_PICTURE, |sheet, width| {
                        panel(sheet, booklet, first, width);
                        sheet.gap(PANEL_GAP);
                        sheet.lowered(0.5 * PAPER[1], |sheet| panel(sheet, booklet, second, width));
                    }) =>
                {
                    others
                }
                _ => {
                    self.layout.fitted(PANEL_PICTURE, |sheet, width| panel(sheet, booklet, first, width));
                    others
                }
            };
        }
    }

    fn step(&mut self, step: &'a Page) {
        let booklet = self.booklet;
        self.layout.new_sheet();
        let share = 2.0 / step.pictures.len().max(2) as f32;
        self.layout.fitted(STEP_PICTURE.map(|width| share * width), |sheet, width| {
            sheet.words(&step.heading, HEADING);
            sheet.words(&step.facts, TEXT);
            sheet.gap(5.0);
            for (picture, caption) in step.pictures.iter().zip(step.captions()) {
                sheet.picture(picture, width);
                sheet.gap(CAPTION_GAP);
                sheet.words(&caption, SMALL);
                sheet.gap(3.0);
            }
            sheet.words(&step.text, TEXT);
            parts(sheet, booklet, step.parts.iter().map(|line| (line.words(), line)));
            for line in &step.measures {
                sheet.gap(2.0);
                sheet.words(line, TEXT - 1.0);
            }
            step.caution.iter().for_each(|caution| sheet.kept(|sheet| framed_caution(sheet, caution)));
        });
    }
}

fn listed(sheet: &mut Layout, heading: &str, lines: &[String]) {
    sheet.words(heading, TEXT + 2.0);
    for line in lines {
        sheet.words(line, SMALL);
        sheet.gap(2.0);
    }
}

fn row_of_parts(sheet: &mut Layout, row: &[String; 3]) {
    let top = sheet.at;
    let cell = |(text, place): (&String, [f32; 2])| sheet.column(top, place, |sheet| sheet.words(text, SMALL));
    let ends: Vec<_> = row.iter().zip(PART_COLUMNS).map(cell).collect();
    sheet.below(&ends);
}

/// A picture with its caption, and something beside both.
fn picture_beside<'a>(sheet: &mut Layout<'a>, (picture, caption): (&'a Picture, &str), width: f32, beside: impl FnOnce(&mut Layout<'a>)) {
    let (top, whole) = (sheet.at, sheet.width);
    let left = sheet.column(top, [0.0, width], |sheet| {
        sheet.picture(picture, width);
        sheet.gap(CAPTION_GAP);
        sheet.words(caption, SMALL);
    });
    let right = sheet.column(top, [width + BESIDE, whole - width - BESIDE], beside);
    sheet.below(&[left, right]);
}

fn panel<'a>(sheet: &mut Layout<'a>, booklet: &'a Booklet, of: &'a Panel, width: f32) {
    sheet.words(&of.heading, HEADING - 4.0);
    sheet.words(&of.facts, TEXT - 1.0);
    sheet.gap(4.0);
    picture_beside(sheet, (&of.picture, &of.held), width, |sheet| {
        parts(sheet, booklet, of.parts.iter().map(|line| (line.words(), line)));
    });
    sheet.gap(2.0);
    sheet.words(&of.text, TEXT - 1.0);
    if let Some(caution) = &of.caution {
        sheet.gap(2.0);
        sheet.words(&format!("Caution. {caution}"), TEXT - 1.0);
    }
}

fn framed_caution(sheet: &mut Layout, caution: &str) {
    sheet.gap(10.0);
    sheet.framed(|sheet| sheet.words(&format!("Caution. {caution}"), TEXT - 1.0));
}

/// Parts with their pictures, as many side by side as the column is wide for.
fn parts<'a>(sheet: &mut Layout<'a>, booklet: &'a Booklet, lines: impl Iterator<Item = (String, &'a PartLine)>) {
    let lines: Vec<_> = lines.collect();
    let columns = ((sheet.width / PART_CELL) as usize).max(1);
    let width = sheet.width / columns as f32;
    for row in lines.chunks(columns) {
        sheet.gap(3.0);
        sheet.kept(|sheet| {
            let top = sheet.at;
            let cells = row.iter().enumerate();
            let cell = |(at, (words, line)): (usize, &(String, &'a PartLine))| {
                sheet.column(top, [at as f32 * width, width], |sheet| part(sheet, booklet, words, line))
            };
            let ends: Vec<_> = cells.map(cell).collect();
            sheet.below(&ends);
        });
    }
}

/// A line of parts with a picture; of a screw its outline, as large as it is.
fn part<'a>(sheet: &mut Layout<'a>, booklet: &'a Booklet, words: &str, line: &PartLine) {
    sheet.words(words, TEXT - 2.0);
    if let Some(picture) = booklet.alone.get(&line.part) {
        sheet.put([0.0, 0.0], PART, What::Picture(picture));
        sheet.gap(PART[1]);
    }
    if let Some(screw) = ScrewOutline::of(line) {
        sheet.gap(5.0);
        for [x, y, width, height] in screw.rectangles_mm().map(|all| all.map(|mm| mm as f32 * MM)) {
            sheet.put([x, y], [width, height], What::Frame);
        }
        sheet.gap(screw.high_mm() as f32 * MM);
        sheet.words("1:1", SMALL);
    }
}
