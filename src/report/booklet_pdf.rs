//! The instructions as a PDF: A4, a title page and a page a step.

use krilla::Document;
use krilla::color::rgb::Color;
use krilla::geom::{PathBuilder, Point, Rect, Size, Transform};
use krilla::image::Image;
use krilla::metadata::Metadata;
use krilla::page::PageSettings;
use krilla::paint::Stroke;
use krilla::surface::Surface;
use krilla::text::{Font, TextDirection};

use super::booklet::{Booklet, Page};
use super::fold_scene::Picture;
use super::lettering::{Lettering, TYPEFACE};

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
/// Width of a step's pictures and of the one on the title page, points.
const WIDTHS: [f32; 2] = [420.0, 270.0];

/// The PDF could not be made.
#[derive(Debug, thiserror::Error)]
#[error("cannot make the PDF: {0}")]
pub struct PdfError(String);

/// The file's bytes.
///
/// # Errors
/// When the typeface cannot be read or the file not be put together.
pub fn pdf(booklet: &Booklet) -> Result<Vec<u8>, PdfError> {
    let font = Font::new(TYPEFACE.to_vec().into(), 0).ok_or_else(|| PdfError("no typeface".into()))?;
    let lettering = Lettering::new().ok_or_else(|| PdfError("no typeface".into()))?;
    let mut document = Document::new();
    let title = format!("{}: how to put it together", booklet.frame);
    document.set_metadata(Metadata::new().title(title.clone()).language("en".into()).creator("flexframe".into()));
    let settings = || PageSettings::from_wh(PAPER[0], PAPER[1]).ok_or_else(|| PdfError("no such paper".into()));
    for number in 0..=booklet.pages.len() {
        let mut page = document.start_page_with(settings()?);
        let (mut surface, width) = (page.surface(), PAPER[0] - 2.0 * MARGIN);
        let mut sheet = Sheet { surface: &mut surface, font: &font, lettering: &lettering, y: MARGIN, left: MARGIN, width };
        match number.checked_sub(1).and_then(|index| booklet.pages.get(index)) {
            Some(step) => sheet.step(step)?,
            None => sheet.title(&title, booklet)?,
        }
        sheet.foot(&format!("{}, page {} of {}", booklet.frame, number + 1, booklet.pages.len() + 1));
        surface.finish();
        page.finish();
    }
    document.finish().map_err(|error| PdfError(format!("{error:?}")))
}

/// A sheet that is written from the top.
struct Sheet<'a, 'p> {
    surface: &'a mut Surface<'p>,
    font: &'a Font,
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
            let at = Point::from_xy(self.left, self.y - 0.35 * size);
            self.surface.draw_text(at, self.font.clone(), size, &line, false, TextDirection::LeftToRight);
        }
    }

    fn gap(&mut self, points: f32) {
        self.y += points;
    }

    fn picture(&mut self, picture: &Picture, width: f32) -> Result<(), PdfError> {
        let rgba: Vec<u8> = picture.rgb.chunks_exact(3).flat_map(|p| [p[0], p[1], p[2], 255]).collect();
        let [w, h] = picture.size;
        let height = width * h as f32 / w as f32;
        let size = Size::from_wh(width, height).ok_or_else(|| PdfError("an empty picture".into()))?;
        let x = self.left + 0.5 * (self.width - width);
        self.surface.push_transform(&Transform::from_translate(x, self.y));
        self.surface.draw_image(Image::from_rgba8(rgba, w, h), size);
        self.surface.pop();
        self.frame(x, self.y, width, height);
        self.y += height;
        Ok(())
    }

    fn frame(&mut self, x: f32, y: f32, width: f32, height: f32) {
        let mut path = PathBuilder::new();
        if let Some(edge) = Rect::from_xywh(x, y, width, height) {
            path.push_rect(edge);
        }
        if let Some(path) = path.finish() {
            let fill = self.surface.get_fill().cloned();
            self.surface.set_fill(None);
            self.surface.set_stroke(Some(Stroke { paint: Color::new(0, 0, 0).into(), width: 0.7, ..Stroke::default() }));
            self.surface.draw_path(&path);
            self.surface.set_stroke(None);
            self.surface.set_fill(fill);
        }
    }

    fn title(&mut self, title: &str, booklet: &Booklet) -> Result<(), PdfError> {
        self.words(title, HEADING);
        self.gap(6.0);
        self.picture(&booklet.apart, WIDTHS[1])?;
        self.gap(4.0);
        for line in &booklet.preface {
            self.gap(2.0);
            self.words(line, SMALL + 1.0);
        }
        self.gap(8.0);
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
        Ok(())
    }

    /// A cell in the line that begins here.
    fn column(&mut self, x: f32, y: f32, text: &str) {
        let (left, width) = (self.left, self.width);
        (self.left, self.y, self.width) = (left + x, y, width - x);
        self.words(text, SMALL);
        (self.left, self.width) = (left, width);
    }

    fn step(&mut self, step: &Page) -> Result<(), PdfError> {
        self.words(&step.heading, HEADING);
        self.words(&step.facts, TEXT);
        self.gap(5.0);
        for (picture, caption) in step.pictures.iter().zip(["Before", "After"]) {
            self.picture(picture, WIDTHS[0])?;
            self.words(caption, SMALL);
            self.gap(3.0);
        }
        self.words(&step.text, TEXT);
        for line in &step.measures {
            self.gap(2.0);
            self.words(line, TEXT - 1.0);
        }
        if let Some(caution) = &step.caution {
            self.gap(10.0);
            let top = self.y;
            self.words(&format!("Caution. {caution}"), TEXT - 1.0);
            self.frame(self.left - 6.0, top - 3.0, self.width + 12.0, self.y - top + 8.0);
        }
        Ok(())
    }

    fn foot(&mut self, text: &str) {
        self.y = PAPER[1] - MARGIN + 4.0;
        self.words(text, SMALL);
    }
}
