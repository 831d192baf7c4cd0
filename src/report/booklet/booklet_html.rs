//! The instructions as one page for a browser, beside its pictures: nothing is fetched, and it prints on A4, a step a page.

use std::fmt::Write;

use crate::frame::mounting::PartLine;
use crate::report::booklet::content::{Booklet, Page, Panel, part_words};
use crate::report::page::document::escaped;

const STYLE: &str = "@page { size: A4; margin: 15mm } \
p { margin: 2mm 0 } h1, h2 { margin: 3mm 0 } body { font: 11pt/1.3 sans-serif; max-width: 180mm; margin: auto; color: #000; background: #fff } \
section { break-before: page } section.half { break-before: auto; break-inside: avoid } img { width: 100%; border: 1px solid #888 } figure { margin: 1mm auto; max-width: 120mm } \
figcaption { font-size: 9pt } table { border-collapse: collapse; font-size: 8.5pt; line-height: 1.2 } td { padding: 0 3mm 0 0; vertical-align: top } \
.columns { display: grid; grid-template-columns: 3fr 2fr; gap: 8mm } ol { padding-left: 0; list-style: none; font-size: 8.5pt } .cover { max-width: 85mm } \
img.part { width: 24mm; border: 0; vertical-align: middle } .caution { border: 2px solid #000; padding: 2mm } .facts { font-weight: bold }";

/// Names of a step's pictures, by their order among so many, beside the page.
pub fn picture_name(step: usize, at: usize, of: usize) -> String {
    let name = match at {
        0 => "before",
        at if at + 1 == of => "after",
        _ => "between",
    };
    format!("steps/{step:02}_{name}.png")
}

/// Names of the pictures of the mounts, in their order, beside the page.
pub fn panel_name(at: usize, after: bool) -> String {
    format!("mounts/{}_{:02}.png", if after { "after" } else { "before" }, at + 1)
}

/// Name of the picture of a part, beside the page.
pub fn part_name(part: &str) -> String {
    format!("parts/{part}.png")
}

/// A line of parts, with its picture.
fn part_line(page: &mut String, booklet: &Booklet, line: &PartLine) {
    let picture =
        booklet.alone.get(&line.part).map(|_| format!("<img class=\"part\" src=\"{}\" alt=\"\"> ", escaped(&part_name(&line.part))));
    let _ = writeln!(page, "<p>{}{}</p>", picture.unwrap_or_default(), escaped(&part_words(line)));
}

/// The page.
pub fn html(booklet: &Booklet) -> String {
    let mut page = String::new();
    let frame = escaped(&booklet.frame);
    // Writing to a String cannot fail.
    let _ = write!(
        page,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width\">\n\
         <title>{frame}: instructions</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{frame}: how to put it together</h1>\n\
         <figure class=\"cover\"><img src=\"exploded.png\" alt=\"The frame taken apart\"></figure>\n"
    );
    booklet.preface.iter().for_each(|line| page.push_str(&format!("<p>{}</p>\n", escaped(line))));
    page.push_str("<div class=\"columns\">\n<div><h2>Parts</h2>\n<table>\n");
    for row in &booklet.parts {
        let cells: String = row.iter().map(|cell| format!("<td>{}</td>", escaped(cell))).collect();
        let _ = writeln!(page, "<tr>{cells}</tr>");
    }
    page.push_str("</table></div>\n<div><h2>Cut the rods, mm</h2>\n<ol>\n");
    booklet.cuts.iter().for_each(|line| page.push_str(&format!("<li>{}</li>\n", escaped(line))));
    page.push_str("</ol></div>\n</div>\n");
    booklet.before.iter().enumerate().for_each(|(at, step)| panel(&mut page, booklet, &panel_name(at, false), step));
    booklet.pages.iter().enumerate().for_each(|(index, step)| section(&mut page, booklet, index + 1, step));
    booklet.after.iter().enumerate().for_each(|(at, step)| panel(&mut page, booklet, &panel_name(at, true), step));
    page.push_str("</body>\n</html>\n");
    page
}

fn panel(page: &mut String, booklet: &Booklet, name: &str, step: &Panel) {
    let heading = escaped(&step.heading);
    let _ = write!(page, "<section class=\"half\">\n<h2>{heading}</h2>\n<p class=\"facts\">{}</p>\n", escaped(&step.facts));
    step.parts.iter().for_each(|line| part_line(page, booklet, line));
    let _ = writeln!(
        page,
        "<figure><img src=\"{name}\" alt=\"{heading}\"><figcaption>{}</figcaption></figure>\n<p>{}</p>",
        escaped(step.held),
        escaped(&step.text)
    );
    step.caution.iter().for_each(|line| page.push_str(&format!("<p class=\"caution\"><strong>Caution.</strong> {}</p>\n", escaped(line))));
    page.push_str("</section>\n");
}

fn section(page: &mut String, booklet: &Booklet, number: usize, step: &Page) {
    let heading = escaped(&step.heading);
    let _ =
        write!(page, "<section>\n<h2>{heading}</h2>\n<p class=\"facts\">{}</p>\n<p>{}</p>\n", escaped(&step.facts), escaped(&step.text));
    step.parts.iter().for_each(|line| part_line(page, booklet, line));
    step.measures.iter().for_each(|line| page.push_str(&format!("<p>{}</p>\n", escaped(line))));
    step.caution.iter().for_each(|line| page.push_str(&format!("<p class=\"caution\"><strong>Caution.</strong> {}</p>\n", escaped(line))));
    for (at, caption) in step.captions().iter().enumerate() {
        let name = picture_name(number, at, step.pictures.len());
        let _ = writeln!(page, "<figure><img src=\"{name}\" alt=\"{heading}: {caption}\"><figcaption>{caption}</figcaption></figure>");
    }
    page.push_str("</section>\n");
}
