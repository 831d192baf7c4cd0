//! The instructions as a PDF: A4, a title page, a page of parts and rods, a page a sub-assembly, two mounts a page, and a page a
//! step of the fold.

use super::pdf_document::{PdfDocument, PdfSheet};
use crate::frame::mounting::PartLine;
use crate::report::booklet::content::{Booklet, Page, Panel};
use crate::report::booklet::sub_assembly::SubAssembly;
use crate::report::picture::fold_scene::Picture;
use crate::report::picture::lettering::Lettering;
use crate::report::picture::mount_scene::Held;

/// A4, points.
const PAPER: [f32; 2] = [595.28, 841.89];
/// Empty at each side, points.
const MARGIN: f32 = 45.0;
/// Size of the letters of headings, points; below of text and of tables.
const HEADING: f32 = 20.0;
const TEXT: f32 = 11.0;
const SMALL: f32 = 8.2;
/// Distance of lines over the size of letters.
const LEADING: f32 = 1.35;
/// Width of a step's pictures, points.
const STEP_PICTURE: f32 = 385.0;

/// Mounts on a sheet, the width of a mount's picture, and where the column of its parts begins, points.
const PANELS: usize = 2;
const PANEL_PICTURE: f32 = 335.0;
const PANEL_PARTS: f32 = 345.0;
/// Width and height of the picture of a part, and width of its cell below a step of the fold, points.
const PART: [f32; 2] = [68.0, 51.0];
const PART_CELL: f32 = 120.0;
/// Parts beside each other on the page of a sub-assembly.
const PART_COLUMNS: usize = 4;
/// Between a picture and its caption, points.
const CAPTION_GAP: f32 = 1.5;
/// Points in a millimetre.
const MM: f32 = 72.0 / 25.4;

/// The typeface inside cannot be read, so there is no PDF.
#[derive(Debug, thiserror::Error)]
#[error("cannot make the PDF: its typeface does not read")]
pub struct PdfError;

/// The file's bytes.
///
/// # Errors
/// When the typeface cannot be read.
pub fn pdf(booklet: &Booklet) -> Result<Vec<u8>, PdfError> {
    let lettering = Lettering::new().ok_or(PdfError)?;
    let title = format!("{}: how to put it together", booklet.frame);
    let mut document = PdfDocument::new(&lettering, PAPER, &title);
    let pages = sheets(booklet);
    for (number, content) in pages.iter().enumerate() {
        let width = PAPER[0] - 2.0 * MARGIN;
        let page = document.sheet();
        let mut sheet = Sheet { document: &mut document, page, lettering: &lettering, y: MARGIN, left: MARGIN, width };
        match content {
            Content::Title => sheet.title(&title, booklet),
            Content::Lists => sheet.lists(booklet),
            Content::Assembly(of) => sheet.sub_assembly(of, booklet),
            Content::Panels(panels) => sheet.panels(panels, booklet),
            Content::Step(step) => sheet.step(step, booklet),
        }
        sheet.foot(&format!("{}, page {} of {}", booklet.frame, number + 1, pages.len()));
        let page = sheet.page;
        document.add(page);
    }
    Ok(document.bytes())
}

/// What is on a sheet.
enum Content<'a> {
    Title,
    Lists,
    Assembly(&'a SubAssembly),
    Panels(&'a [Panel]),
    Step(&'a Page),
}

fn sheets(booklet: &Booklet) -> Vec<Content<'_>> {
    let [centre, module, cartridge] = &booklet.assemblies;
    let mut sheets = vec![Content::Title, Content::Lists, Content::Assembly(centre)];
    sheets.extend(booklet.before.chunks(PANELS).map(Content::Panels));
    sheets.push(Content::Assembly(module));
    sheets.extend(booklet.pages.iter().map(Content::Step));
    let [wires, rest] = booklet.around_cartridge();
    sheets.extend(wires.chunks(PANELS).map(Content::Panels));
    sheets.push(Content::Assembly(cartridge));
    sheets.extend(rest.chunks(PANELS).map(Content::Panels));
    sheets
}

/// A sheet that is written from the top.
struct Sheet<'a, 'd> {
    document: &'a mut PdfDocument<'d>,
    page: PdfSheet,
    lettering: &'a Lettering,
    /// How far down, points.
    y: f32,
    left: f32,
    width: f32,
}

impl Sheet<'_, '_> {
    fn words(&mut self, text: &str, size: f32) {
        for line in self.lettering.lines(text, f64::from(size), f64::from(self.width)) {
            self.y += LEADING * size;
            self.document.words(&mut self.page, &line, size, [self.left, self.y - 0.35 * size]);
        }
    }

    fn gap(&mut self, points: f32) {
        self.y += points;
    }

    fn picture(&mut self, picture: &Picture, width: f32) {
        let height = width * picture.size[1] as f32 / picture.size[0] as f32;
        let at = [self.left + 0.5 * (self.width - width), self.y];
        self.document.picture(&mut self.page, picture, at, [width, height]);
        self.document.frame(&mut self.page, at, [width, height]);
        self.y += height;
    }

    fn title(&mut self, title: &str, booklet: &Booklet) {
        self.words(title, HEADING);
        self.gap(6.0);
        // As wide as the page: the names of the parts stand in it.
        self.picture(&booklet.apart, self.width);
        self.gap(4.0);
        for line in &booklet.preface {
            self.gap(2.0);
            self.words(line, SMALL + 1.0);
        }
    }

    /// What to have at hand: the parts, and the rods to cut.
    fn lists(&mut self, booklet: &Booklet) {
        let (top, whole) = (self.y, self.width);
        self.width = 0.56 * whole;
        self.words("Parts", TEXT + 2.0);
        for [count, name, material] in &booklet.parts {
            let y = self.y;
            self.words(count, SMALL);
            self.column(28.0, y, name);
            self.column(160.0, y, material);
        }
        (self.y, self.left, self.width) = (top, self.left + 0.6 * whole, 0.4 * whole);
        self.words("Cut the rods, mm", TEXT + 2.0);
        for line in &booklet.cuts {
            self.words(line, SMALL);
            self.gap(2.0);
        }
        (self.left, self.width) = (MARGIN, whole);
    }

    /// A cell in the line that begins here.
    fn column(&mut self, x: f32, y: f32, text: &str) {
        let (left, width) = (self.left, self.width);
        (self.left, self.y, self.width) = (left + x, y, width - x);
        self.words(text, SMALL);
        (self.left, self.width) = (left, width);
    }

    fn sub_assembly(&mut self, of: &SubAssembly, booklet: &Booklet) {
        self.words(&of.heading, HEADING);
        self.words(&of.text, TEXT);
        self.gap(6.0);
        let (top, left, width) = (self.y, self.left, self.width);
        self.width = PANEL_PICTURE;
        self.picture(&of.picture, PANEL_PICTURE);
        self.gap(CAPTION_GAP);
        self.words(Held::Upright.words(), SMALL);
        let below = self.y;
        (self.y, self.left, self.width) = (top, left + PANEL_PARTS, width - PANEL_PARTS);
        self.words("Its steps", TEXT);
        of.steps.iter().for_each(|step| self.words(step, SMALL + 0.8));
        (self.y, self.left, self.width) = (below.max(self.y) + 8.0, left, width);
        self.words("Its parts", TEXT);
        for row in of.parts.chunks(PART_COLUMNS) {
            self.gap(4.0);
            self.parts(row, booklet);
        }
    }

    fn panels(&mut self, panels: &[Panel], booklet: &Booklet) {
        for (at, panel) in panels.iter().enumerate() {
            self.y = MARGIN + at as f32 * 0.5 * (PAPER[1] - 2.0 * MARGIN);
            self.panel(panel, booklet);
        }
    }

    fn panel(&mut self, panel: &Panel, booklet: &Booklet) {
        self.words(&panel.heading, HEADING - 4.0);
        self.words(&panel.facts, TEXT - 1.0);
        self.gap(4.0);
        let (top, left, width) = (self.y, self.left, self.width);
        self.width = PANEL_PICTURE;
        self.picture(&panel.picture, PANEL_PICTURE);
        self.gap(CAPTION_GAP);
        self.words(&panel.held, SMALL);
        let below = self.y;
        (self.y, self.left, self.width) = (top, left + PANEL_PARTS, width - PANEL_PARTS);
        panel.parts.iter().for_each(|line| self.part(&line.words(), line, booklet));
        (self.y, self.left, self.width) = (below + 2.0, left, width);
        self.words(&panel.text, TEXT - 1.0);
        if let Some(caution) = &panel.caution {
            self.gap(2.0);
            self.words(&format!("Caution. {caution}"), TEXT - 1.0);
        }
    }

    /// A line of parts with a picture; of a screw its outline, as large as it is.
    fn part(&mut self, words: &str, line: &PartLine, booklet: &Booklet) {
        self.words(words, TEXT - 2.0);
        if let Some(picture) = booklet.alone.get(&line.part) {
            self.document.picture(&mut self.page, picture, [self.left, self.y], PART);
            self.y += PART[1];
        }
        let (Some([thread, length]), Some([wide, high])) = (line.screw_mm, line.head_mm) else { return };
        let [thread, length, wide, high] = [thread, length, wide, high].map(|mm| mm as f32 * MM);
        self.gap(5.0);
        let at = [self.left, self.y];
        self.document.frame(&mut self.page, at, [high, wide]);
        self.document.frame(&mut self.page, [at[0] + high, at[1] + 0.5 * (wide - thread)], [length, thread]);
        self.y += wide;
        self.words("1:1", SMALL);
    }

    /// Parts side by side.
    fn parts(&mut self, lines: &[(String, PartLine)], booklet: &Booklet) {
        let (left, width, top) = (self.left, self.width, self.y);
        let mut below = top;
        for (at, (words, line)) in lines.iter().enumerate() {
            (self.left, self.width, self.y) = (left + at as f32 * PART_CELL, PART_CELL, top);
            self.part(words, line, booklet);
            below = below.max(self.y);
        }
        (self.left, self.width, self.y) = (left, width, below);
    }

    fn step(&mut self, step: &Page, booklet: &Booklet) {
        self.words(&step.heading, HEADING);
        self.words(&step.facts, TEXT);
        self.gap(5.0);
        let width = STEP_PICTURE * 2.0 / step.pictures.len().max(2) as f32;
        for (picture, caption) in step.pictures.iter().zip(step.captions()) {
            self.picture(picture, width);
            self.gap(CAPTION_GAP);
            self.words(&caption, SMALL);
            self.gap(3.0);
        }
        self.words(&step.text, TEXT);
        self.gap(2.0);
        let parts: Vec<(String, PartLine)> = step.parts.iter().map(|line| (line.words(), line.clone())).collect();
        self.parts(&parts, booklet);
        for line in &step.measures {
            self.gap(2.0);
            self.words(line, TEXT - 1.0);
        }
        if let Some(caution) = &step.caution {
            self.gap(10.0);
            let top = self.y;
            self.words(&format!("Caution. {caution}"), TEXT - 1.0);
            self.document.frame(&mut self.page, [self.left - 6.0, top - 3.0], [self.width + 12.0, self.y - top + 8.0]);
        }
    }

    fn foot(&mut self, text: &str) {
        self.y = PAPER[1] - MARGIN + 4.0;
        self.words(text, SMALL);
    }
}
