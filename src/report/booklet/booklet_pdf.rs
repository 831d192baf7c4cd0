//! The instructions as a PDF.

use super::pdf_document::{PdfDocument, PdfSheet};
use crate::report::booklet::booklet_sheets::marks;
use crate::report::booklet::content::Booklet;
use crate::report::booklet::layout::{Mark, PAPER, PdfError, What};
use crate::report::picture::lettering::Lettering;

/// The file's bytes.
///
/// # Errors
/// When the typeface cannot be read.
pub fn pdf(booklet: &Booklet) -> Result<Vec<u8>, PdfError> {
    let lettering = Lettering::new().ok_or(PdfError)?;
    let mut document = PdfDocument::new(&lettering, PAPER, &booklet.title());
    for sheet in marks(booklet)?.chunk_by(|a, b| a.sheet == b.sheet) {
        let mut page = document.sheet();
        sheet.iter().for_each(|mark| write(&mut document, &mut page, mark));
        document.add(page);
    }
    Ok(document.bytes())
}

fn write(document: &mut PdfDocument, page: &mut PdfSheet, mark: &Mark) {
    match &mark.what {
        // The letters stand on a line as far below the upper edge as they are large.
        What::Words(words, size) => document.words(page, words, *size, [mark.at[0], mark.at[1] + size]),
        What::Picture(picture) => document.picture(page, picture, mark.at, mark.size),
        What::Frame => document.frame(page, mark.at, mark.size),
    }
}
