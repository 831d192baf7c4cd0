//! The instructions as one page for a browser, beside its pictures: nothing is fetched, and it prints on A4, two mounts or a step of the fold
//! a page.

use std::fmt::Write;

use crate::frame::mounting::PartLine;
use crate::report::booklet::content::{Booklet, Page, Panel};
use crate::report::booklet::lists::Lists;
use crate::report::booklet::screw_outline::ScrewOutline;
use crate::report::booklet::sub_assembly::SubAssembly;
use crate::report::page::document::escaped;
use crate::report::picture::mount_scene::Held;

const STYLE: &str = "@page { size: A4; margin: 15mm } \
p { margin: 2mm 0 } h1, h2 { margin: 3mm 0; overflow-wrap: anywhere } body { overflow-wrap: break-word; font: 11pt/1.3 sans-serif; max-width: 180mm; margin: auto; color: #000; background: #fff } \
section, section:not(.half) + section.half { break-before: page } section.half { break-before: auto; break-inside: avoid } img { width: 100%; border: 1px solid #888 } figure { margin: 1mm auto; max-width: 120mm } \
figcaption { font-size: 9pt } table { border-collapse: collapse; font-size: 8.5pt; line-height: 1.2 } td { padding: 0 3mm 0 0; vertical-align: top } \
.columns { display: grid; grid-template-columns: 3fr 2fr; gap: 8mm } ol { padding-left: 0; list-style: none; font-size: 8.5pt } .cover { max-width: none } \
.parts { columns: 3 } img.part { width: 24mm; border: 0; vertical-align: middle } .caution { border: 2px solid #000; padding: 2mm } .facts { font-weight: bold } \
.beside { display: grid; grid-template-columns: 5fr 3fr; gap: 4mm } .beside figure { margin: 1mm 0; max-width: none } \
.screw { vertical-align: middle } .screw rect { fill: none; stroke: #000; stroke-width: 0.25 } \
@media print { body { font-size: 9.5pt; max-width: none } .half h2 { font-size: 14pt } .beside { grid-template-columns: 88mm 1fr } \
figure:nth-last-of-type(3), figure:nth-last-of-type(3) ~ figure { max-width: 84mm } }";

/// Name of the picture of a sub-assembly, beside the page.
pub fn assembly_name(name: &str) -> String {
    format!("sub-assemblies/{name}.png")
}

/// Name of the picture of a part, beside the page.
pub fn part_name(part: &str) -> String {
    format!("parts/{part}.png")
}

/// A line of parts, with its picture.
fn part_line(page: &mut String, booklet: &Booklet, line: &PartLine) {
    worded_line(page, booklet, &line.words(), line);
}

/// The same in words of its own.
fn worded_line(page: &mut String, booklet: &Booklet, words: &str, line: &PartLine) {
    let picture =
        booklet.alone.get(&line.part).map(|_| format!("<img class=\"part\" src=\"{}\" alt=\"\"> ", escaped(&part_name(&line.part))));
    let outline = ScrewOutline::of(line).map(|screw| format!(" {} 1:1 on paper", screw.svg()));
    let _ = writeln!(page, "<p>{}{}{}</p>", picture.unwrap_or_default(), escaped(words), outline.unwrap_or_default());
}

/// The page.
pub fn html(booklet: &Booklet) -> String {
    let mut page = String::new();
    let frame = escaped(&booklet.frame);
    // Writing to a String cannot fail.
    let _ = write!(
        page,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width\">\n\
         <title>{frame}: instructions</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{}</h1>\n\
         <figure class=\"cover\"><img src=\"exploded.png\" alt=\"The frame taken apart\"></figure>\n",
        escaped(&booklet.title())
    );
    booklet.preface.iter().for_each(|line| page.push_str(&format!("<p>{}</p>\n", escaped(line))));
    lists(&mut page, &booklet.lists);
    let [centre, module, cartridge] = &booklet.assemblies;
    sub_assembly(&mut page, booklet, centre);
    booklet.before.iter().for_each(|step| panel(&mut page, booklet, step));
    sub_assembly(&mut page, booklet, module);
    booklet.pages.iter().for_each(|step| section(&mut page, booklet, step));
    let [wires, rest] = booklet.around_cartridge();
    wires.iter().for_each(|step| panel(&mut page, booklet, step));
    sub_assembly(&mut page, booklet, cartridge);
    rest.iter().for_each(|step| panel(&mut page, booklet, step));
    page.push_str("</body>\n</html>\n");
    page
}

/// What to have at hand.
fn lists(page: &mut String, lists: &Lists) {
    page.push_str("<section class=\"parts-and-rods\">\n<div class=\"columns\">\n<div><h2>Parts</h2>\n<table>\n");
    for row in &lists.parts {
        let cells: String = row.iter().map(|cell| format!("<td>{}</td>", escaped(cell))).collect();
        let _ = writeln!(page, "<tr>{cells}</tr>");
    }
    page.push_str("</table></div>\n<div>");
    for (heading, lines) in [("Cut the rods, mm", &lists.cuts), ("Used up", &lists.supplies)] {
        let _ = writeln!(page, "<h2>{heading}</h2>\n<ol>");
        lines.iter().for_each(|line| page.push_str(&format!("<li>{}</li>\n", escaped(line))));
        page.push_str("</ol>\n");
    }
    let _ = writeln!(page, "<h2>Tools</h2>\n<p>{}.</p>", escaped(&lists.tools.join(", ")));
    page.push_str("</div>\n</div>\n</section>\n");
}

fn sub_assembly(page: &mut String, booklet: &Booklet, of: &SubAssembly) {
    let (heading, name) = (escaped(&of.heading), escaped(&assembly_name(of.name)));
    let _ = write!(
        page,
        "<section class=\"assembly\">\n<h2>{heading}</h2>\n<p>{}</p>\n<div class=\"columns\"><figure><img src=\"{name}\" alt=\"{heading}\">\
         <figcaption>{}</figcaption></figure>\n<ol>\n",
        escaped(&of.text),
        escaped(Held::Upright.words())
    );
    of.steps.iter().for_each(|step| page.push_str(&format!("<li>{}</li>\n", escaped(step))));
    page.push_str("</ol></div>\n<div class=\"parts\">\n");
    of.parts.iter().for_each(|(words, line)| worded_line(page, booklet, words, line));
    page.push_str("</div>\n</section>\n");
}

fn panel(page: &mut String, booklet: &Booklet, step: &Panel) {
    let name = step.picture_name();
    let heading = escaped(&step.heading);
    let _ = write!(page, "<section class=\"half\">\n<h2>{heading}</h2>\n<p class=\"facts\">{}</p>\n", escaped(&step.facts));
    let _ = writeln!(
        page,
        "<div class=\"beside\"><figure><img src=\"{name}\" alt=\"{heading}\"><figcaption>{}</figcaption></figure>\n<div>",
        escaped(&step.held)
    );
    step.parts.iter().for_each(|line| part_line(page, booklet, line));
    let _ = writeln!(page, "</div></div>\n<p>{}</p>", escaped(&step.text));
    step.caution.iter().for_each(|line| page.push_str(&format!("<p class=\"caution\"><strong>Caution.</strong> {}</p>\n", escaped(line))));
    page.push_str("</section>\n");
}

fn section(page: &mut String, booklet: &Booklet, step: &Page) {
    let heading = escaped(&step.heading);
    let _ =
        write!(page, "<section>\n<h2>{heading}</h2>\n<p class=\"facts\">{}</p>\n<p>{}</p>\n", escaped(&step.facts), escaped(&step.text));
    step.parts.iter().for_each(|line| part_line(page, booklet, line));
    step.measures.iter().for_each(|line| page.push_str(&format!("<p>{}</p>\n", escaped(line))));
    step.caution.iter().for_each(|line| page.push_str(&format!("<p class=\"caution\"><strong>Caution.</strong> {}</p>\n", escaped(line))));
    for (caption, name) in step.captions().iter().zip(step.picture_names()) {
        let _ = writeln!(page, "<figure><img src=\"{name}\" alt=\"{heading}: {caption}\"><figcaption>{caption}</figcaption></figure>");
    }
    page.push_str("</section>\n");
}
