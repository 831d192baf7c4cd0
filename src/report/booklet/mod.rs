//! The assembly instructions: their content, and the HTML and PDF files made of it.

pub mod booklet_html;
pub mod booklet_pdf;
pub mod content;
pub(in crate::report) mod pdf_document;
pub mod sub_assembly;
