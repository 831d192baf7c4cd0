//! A page of headings, sentences, tables and figures, as Markdown and as one HTML file that needs nothing else.

use std::fmt::Write;

use super::base64::base64;
use crate::markdown::inert;

/// A part of a page.
pub enum Block {
    /// A heading below the title.
    Heading(String),
    /// A paragraph.
    Text(String),
    /// Lines, each an item.
    List(Vec<String>),
    /// A head and rows.
    Table(Vec<String>, Vec<Vec<String>>),
    /// An SVG figure with its file's name and caption.
    Figure {
        /// Name of the file beside the Markdown.
        name: String,
        /// The figure.
        svg: String,
        /// What it shows.
        caption: String,
    },
    /// A PNG picture with its file's name and caption.
    Picture {
        /// Name of the file beside the Markdown.
        name: String,
        /// The bytes of the file.
        png: Vec<u8>,
        /// What it shows.
        caption: String,
    },
}

const STYLE: &str = "body{font:16px/1.5 sans-serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#111}\
table{border-collapse:collapse;margin:1rem 0;font-size:14px}td,th{border:1px solid #999;padding:.25rem .5rem;text-align:left;vertical-align:top}\
th{background:#eee}figure{margin:1rem 0}figure svg,figure img{width:100%;height:auto}figcaption{font-size:14px}\
@media print{body{margin:0;max-width:none}figure,table{break-inside:avoid}}";

/// The page as Markdown; figures are files beside it.
pub fn markdown(title: &str, blocks: &[Block]) -> String {
    format!("# {}\n{}", inert(title), markdown_part(blocks))
}

/// A part of a page as Markdown, for a page that is written by hand.
pub fn markdown_part(blocks: &[Block]) -> String {
    let mut text = String::new();
    for block in blocks {
        // Writing to a string does not fail.
        let _ = match block {
            Block::Heading(heading) => write!(text, "\n## {}\n", inert(heading)),
            Block::Text(paragraph) => write!(text, "\n{}\n", inert(paragraph)),
            Block::List(items) => {
                write!(text, "\n{}\n", items.iter().map(|item| format!("- {}", inert(item))).collect::<Vec<_>>().join("\n"))
            }
            Block::Table(head, rows) => {
                let line = |cells: &[String]| format!("| {} |\n", cells.iter().map(|cell| inert(cell)).collect::<Vec<_>>().join(" | "));
                let rule = format!("|{}\n", "---|".repeat(head.len()));
                write!(text, "\n{}{rule}{}", line(head), rows.iter().map(|row| line(row)).collect::<String>())
            }
            Block::Figure { name, caption, .. } => write!(text, "\n![{}]({name}.svg)\n", inert(caption)),
            Block::Picture { name, caption, .. } => write!(text, "\n![{}]({name}.png)\n", inert(caption)),
        };
    }
    text
}

/// The page as HTML, figures inside.
pub fn html(title: &str, blocks: &[Block]) -> String {
    let title = escaped(title);
    let mut text = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{title}</title><style>{STYLE}</style></head><body>\n<h1>{title}</h1>\n"
    );
    for block in blocks {
        text += &match block {
            Block::Heading(heading) => format!("<h2>{}</h2>\n", escaped(heading)),
            Block::Text(paragraph) => format!("<p>{}</p>\n", escaped(paragraph)),
            Block::List(items) => {
                format!("<ul>{}</ul>\n", items.iter().map(|item| format!("<li>{}</li>", escaped(item))).collect::<String>())
            }
            Block::Table(head, rows) => {
                let line = |cells: &[String], tag: &str| {
                    format!("<tr>{}</tr>\n", cells.iter().map(|cell| format!("<{tag}>{}</{tag}>", escaped(cell))).collect::<String>())
                };
                format!("<table>{}{}</table>\n", line(head, "th"), rows.iter().map(|row| line(row, "td")).collect::<String>())
            }
            Block::Figure { svg, caption, .. } => format!("<figure>{svg}<figcaption>{}</figcaption></figure>\n", escaped(caption)),
            Block::Picture { png, caption, .. } => format!(
                "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
                escaped(caption),
                base64(png)
            ),
        };
    }
    text + "</body></html>\n"
}

/// As it stands in the text of an HTML element or in an attribute between double quotes.
pub(in crate::report) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
