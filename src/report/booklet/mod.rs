//! The assembly instructions: their content, and the HTML and PDF files made of it.

pub mod booklet_html;
pub mod booklet_pdf;
pub mod booklet_sheets;
pub mod content;
pub mod layout;
pub mod lists;
pub(in crate::report) mod pdf_document;
pub mod screw_outline;
pub mod sub_assembly;
