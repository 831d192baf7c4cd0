//! A PDF of sheets with words, pictures and frames, in one typeface.
//!
//! The typeface goes in whole: its program, the widths of the letters that are used, and what each of them means, so that
//! the words can be searched and copied (PDF 32000-1:2008, 9.7.4 and 9.10.3).

use std::collections::BTreeMap;

use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str, TextStr};

use crate::report::picture::fold_scene::Picture;
use crate::report::picture::lettering::{Lettering, TYPEFACE};

const FONT: Name = Name(b"Typeface");
const FONT_NAME: Name = Name(b"Ubuntu-Light");
const CID: SystemInfo = SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };
/// How hard streams are pressed: zlib's own default.
const PRESSURE: u8 = 6;
/// Width of a frame's line, points.
const LINE: f32 = 0.7;

/// A document that grows sheet by sheet.
pub(in crate::report) struct PdfDocument<'a> {
    lettering: &'a Lettering,
    paper: [f32; 2],
    pdf: Pdf,
    next: Ref,
    catalogue: Ref,
    tree: Ref,
    typeface: Ref,
    sheets: Vec<Ref>,
    /// Letters in use, by glyph.
    letters: BTreeMap<u16, char>,
}

/// A sheet that is being written. Places are from the upper left corner, points, y down.
pub(in crate::report) struct PdfSheet {
    content: Content,
    pictures: Vec<Ref>,
}

impl<'a> PdfDocument<'a> {
    /// Without sheets yet; the paper's width and height in points.
    pub fn new(lettering: &'a Lettering, paper: [f32; 2], title: &str) -> Self {
        let mut next = Ref::new(1);
        let (catalogue, tree, typeface, facts) = (next.bump(), next.bump(), next.bump(), next.bump());
        let mut pdf = Pdf::new();
        pdf.document_info(facts).title(TextStr(title)).creator(TextStr("flexframe"));
        Self { lettering, paper, pdf, next, catalogue, tree, typeface, sheets: Vec::new(), letters: BTreeMap::new() }
    }

    /// Words from a place on their baseline.
    pub fn words(&mut self, sheet: &mut PdfSheet, text: &str, size: f32, at: [f32; 2]) {
        let glyphs: Vec<u16> = text.chars().map(|letter| self.glyph(letter)).collect();
        let codes: Vec<u8> = glyphs.iter().flat_map(|glyph| glyph.to_be_bytes()).collect();
        sheet.content.begin_text().set_font(FONT, size).next_line(at[0], self.paper[1] - at[1]).show(Str(&codes)).end_text();
    }

    fn glyph(&mut self, letter: char) -> u16 {
        let glyph = self.lettering.glyph(letter);
        self.letters.insert(glyph, letter);
        glyph
    }

    /// A picture with its upper left corner at a place.
    pub fn picture(&mut self, sheet: &mut PdfSheet, picture: &Picture, at: [f32; 2], size: [f32; 2]) {
        let image = self.next.bump();
        let pixels = compress_to_vec_zlib(&picture.rgb, PRESSURE);
        let mut object = self.pdf.image_xobject(image, &pixels);
        object.width(picture.size[0] as i32).height(picture.size[1] as i32).bits_per_component(8);
        object.filter(Filter::FlateDecode);
        object.color_space().device_rgb();
        object.finish();
        let name = picture_name(sheet.pictures.len());
        let lower = self.paper[1] - at[1] - size[1];
        let content = &mut sheet.content;
        content.save_state().transform([size[0], 0.0, 0.0, size[1], at[0], lower]).x_object(Name(name.as_bytes())).restore_state();
        sheet.pictures.push(image);
    }

    /// A black frame with its upper left corner at a place.
    pub fn frame(&self, sheet: &mut PdfSheet, at: [f32; 2], size: [f32; 2]) {
        sheet.content.set_line_width(LINE).rect(at[0], self.paper[1] - at[1] - size[1], size[0], size[1]).stroke();
    }

    /// An empty sheet.
    pub fn sheet(&self) -> PdfSheet {
        PdfSheet { content: Content::new(), pictures: Vec::new() }
    }

    /// Puts a sheet behind the others.
    pub fn add(&mut self, sheet: PdfSheet) {
        let (page, content) = (self.next.bump(), self.next.bump());
        self.pdf.stream(content, &compress_to_vec_zlib(&sheet.content.finish(), PRESSURE)).filter(Filter::FlateDecode);
        let mut object = self.pdf.page(page);
        object.parent(self.tree).contents(content).media_box(Rect::new(0.0, 0.0, self.paper[0], self.paper[1]));
        let mut resources = object.resources();
        resources.fonts().pair(FONT, self.typeface);
        let mut pictures = resources.x_objects();
        for (number, picture) in sheet.pictures.iter().enumerate() {
            pictures.pair(Name(picture_name(number).as_bytes()), *picture);
        }
        self.sheets.push(page);
    }

    /// The file's bytes.
    pub fn bytes(mut self) -> Vec<u8> {
        self.pdf.catalog(self.catalogue).pages(self.tree).lang(TextStr("en"));
        self.pdf.pages(self.tree).kids(self.sheets.iter().copied()).count(self.sheets.len() as i32);
        self.write_typeface();
        self.pdf.finish()
    }

    fn write_typeface(&mut self) {
        let [letters, descriptor, program, meaning] = std::array::from_fn(|_| self.next.bump());
        let mut font = self.pdf.type0_font(self.typeface);
        font.base_font(FONT_NAME).encoding_predefined(Name(b"Identity-H")).descendant_font(letters).to_unicode(meaning);
        font.finish();
        let mut font = self.pdf.cid_font(letters);
        font.subtype(CidFontType::Type2).base_font(FONT_NAME).system_info(CID).font_descriptor(descriptor);
        font.cid_to_gid_map_predefined(Name(b"Identity"));
        let mut widths = font.widths();
        for (glyph, letter) in &self.letters {
            let width = self.lettering.width(&letter.to_string(), 1000.0) as f32;
            widths.same(*glyph, *glyph, width);
        }
        widths.finish();
        font.finish();
        let shape = self.lettering.shape();
        let mut object = self.pdf.font_descriptor(descriptor);
        object.name(FONT_NAME).flags(FontFlags::NON_SYMBOLIC).bbox(Rect::new(shape.low[0], shape.low[1], shape.high[0], shape.high[1]));
        object.italic_angle(0.0).ascent(shape.ascent).descent(shape.descent).cap_height(shape.ascent).stem_v(STEM).font_file2(program);
        object.finish();
        self.pdf
            .stream(program, &compress_to_vec_zlib(TYPEFACE, PRESSURE))
            .filter(Filter::FlateDecode)
            .pair(Name(b"Length1"), TYPEFACE.len() as i32);
        let mut map = UnicodeCmap::new(FONT_NAME, CID);
        self.letters.iter().for_each(|(glyph, letter)| map.pair(*glyph, *letter));
        self.pdf.cmap(meaning, &map.finish());
    }
}

/// Thickness of upright strokes, thousandths of a size: readers need it only where they replace the typeface.
const STEM: f32 = 60.0;

fn picture_name(number: usize) -> String {
    format!("Picture{number}")
}
