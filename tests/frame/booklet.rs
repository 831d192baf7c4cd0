//! The printed instructions of every frame: nothing lies on anything else, nothing leaves its sheet, and nothing is left out.

use flexframe::checks::check;
use flexframe::export::bill::bill;
use flexframe::frame::assembly::{Design, mass};
use flexframe::frame::fold::FoldSequence;
use flexframe::frame::mounting::mounts_of;
use flexframe::params::Frame;
use flexframe::report::booklet::booklet_sheets::marks;
use flexframe::report::booklet::content::Booklet;
use flexframe::report::booklet::layout::{MARGIN, Mark, PAPER, What};

use crate::common;

/// How far two things may reach into each other, points: rounding.
const TOUCHING: f32 = 0.01;
/// How far a frame stands out into the margin, points.
const FRAME: f32 = 6.0;

fn designed(name: &str) -> (Design, Booklet) {
    written(Design::with(Frame::load(name).expect("a frame").0, common::memo()).expect("designs"))
}

fn written(design: Design) -> (Design, Booklet) {
    let fold = FoldSequence::new(&design.frame, &design.skeleton).expect("can be folded");
    let masses = mass::table(&design);
    let booklet = Booklet::new(&design, &masses, &fold, &check(&design, &masses));
    (design, booklet)
}

/// Two things of a sheet that lie on each other.
fn overlapping<'m, 'b>(marks: &'m [Mark<'b>]) -> Option<[&'m Mark<'b>; 2]> {
    let filled: Vec<&Mark> = marks.iter().filter(|mark| !matches!(mark.what, What::Frame)).collect();
    let ends = |mark: &Mark, axis: usize| mark.at[axis] + mark.size[axis];
    let meet = |a: &Mark, b: &Mark| (0..2).all(|axis| ends(a, axis).min(ends(b, axis)) - a.at[axis].max(b.at[axis]) > TOUCHING);
    filled.iter().enumerate().find_map(|(at, a)| filled[..at].iter().find(|b| meet(a, b)).map(|b| [*a, *b]))
}

fn leaves_its_sheet(mark: &Mark) -> bool {
    let margin = if matches!(mark.what, What::Frame) { MARGIN - FRAME } else { MARGIN } - TOUCHING;
    // The footer is a line in the lower margin.
    let lowest = PAPER[1] - 0.6 * MARGIN;
    mark.at[0] < margin || mark.at[0] + mark.size[0] > PAPER[0] - margin || mark.at[1] < margin || mark.at[1] + mark.size[1] > lowest
}

/// A title, a page of lists and three sub-assemblies; two mounts a page in each run of them; a page a step of the fold.
fn sheets_wanted(booklet: &Booklet) -> usize {
    let [wires, rest] = booklet.around_cartridge();
    let mounts: usize = [&booklet.before[..], wires, rest].iter().map(|panels| panels.len().div_ceil(2)).sum();
    5 + mounts + booklet.pages.len()
}

#[test]
fn regress_on_the_sheets_of_every_frame_nothing_lies_on_anything_else() {
    for name in common::all_frames() {
        let (design, booklet) = designed(&name);
        let marks = marks(&booklet).expect("the typeface reads");
        let sheets: Vec<&[Mark]> = marks.chunk_by(|a, b| a.sheet == b.sheet).collect();
        assert_eq!(sheets.len(), sheets_wanted(&booklet), "{name}");
        for sheet in &sheets {
            let pair = overlapping(sheet).map(|pair| pair.map(words_of));
            assert!(pair.is_none(), "{name}, sheet {}: {pair:?}", sheet[0].sheet + 1);
            let left = sheet.iter().find(|mark| leaves_its_sheet(mark)).map(words_of);
            assert!(left.is_none(), "{name}, sheet {}: {left:?}", sheet[0].sheet + 1);
        }
        every_caution_is_printed(&booklet, &marks);
        supplies_are_listed(&name, &design, &booklet, sheets[1]);
    }
}

fn words_of(mark: &Mark) -> String {
    match &mark.what {
        What::Words(words, _) => format!("{words} {:?} {:?}", mark.at, mark.size),
        other => format!("{} {:?} {:?}", if matches!(other, What::Frame) { "frame" } else { "picture" }, mark.at, mark.size),
    }
}

fn printed(marks: &[Mark]) -> String {
    let lines = marks.iter().filter_map(|mark| match &mark.what {
        What::Words(words, _) => Some(words.as_str()),
        _ => None,
    });
    lines.collect::<Vec<_>>().join(" ")
}

fn every_caution_is_printed(booklet: &Booklet, marks: &[Mark]) {
    let all = printed(marks);
    let mounts = booklet.before.iter().chain(&booklet.after).map(|panel| &panel.caution);
    for caution in mounts.chain(booklet.pages.iter().map(|page| &page.caution)).flatten() {
        assert!(all.contains(&caution.split_whitespace().collect::<Vec<_>>().join(" ")), "{caution}");
    }
}

/// All that the bill has for the steps, and no step fixes with something that is not listed.
fn supplies_are_listed(name: &str, design: &Design, booklet: &Booklet, sheet: &[Mark]) {
    let printed = printed(sheet);
    for line in bill(design, &mass::table(design), None).buy.iter().filter(|line| line.kind == "supply") {
        let words = format!("{} x {}", line.quantity, line.role.replace('_', " "));
        assert!(printed.contains(&words), "{name}: {words} is not in {printed}");
    }
    for tool in ["small tie", "foam tape", "nail varnish", "solder"] {
        let takes = booklet.before.iter().chain(&booklet.after).any(|panel| panel.facts.contains(tool));
        assert!(!takes || printed.contains(tool.trim_start_matches("nail ")), "{name}: {tool} is not in {printed}");
    }
}

/// A part without a material takes a line as the others do.
#[test]
fn regress_an_extra_has_a_line_of_its_own() {
    let (_, booklet) = designed(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/frames/whoop-aio-fpv.toml"));
    let extras: Vec<&str> = booklet.lists.parts.iter().filter(|row| row[2].is_empty()).map(|row| &*row[1]).collect();
    assert!(extras.len() > 1, "{:?}", booklet.lists.parts);
    let marks = marks(&booklet).expect("the typeface reads");
    let line = |name: &&str| {
        let is_it = |mark: &&Mark| mark.sheet == 1 && matches!(&mark.what, What::Words(words, _) if words == name);
        marks.iter().find(is_it).map(|mark| mark.at[1]).unwrap_or_else(|| panic!("{name} is not printed"))
    };
    let lines: Vec<f32> = extras.iter().map(line).collect();
    assert!(lines.windows(2).all(|two| two[1] > two[0] + 10.0), "{extras:?} {lines:?}");
}

#[test]
fn planted_each_tool_that_a_step_names_is_listed_once_and_nothing_that_is_used_up() {
    let (design, booklet) = designed("cognifly");
    let tools = &booklet.lists.tools;
    let named = mounts_of(&design).into_iter().flat_map(|mount| mount.tools).filter_map(|tool| tool.lasting());
    assert!(named.into_iter().all(|tool| tools.iter().filter(|listed| **listed == tool).count() == 1), "{tools:?}");
    assert!(["soldering iron", "multimeter", "thin pliers", "ruler or caliper"].iter().all(|tool| tools.contains(tool)), "{tools:?}");
    assert!(["hands", "solder", "tape", "washers"].iter().all(|used| !tools.contains(used)), "{tools:?}");
}

/// The whole mass of what is bought is one extra there, and the base's wiring weighs nothing.
#[test]
fn regress_an_extra_that_weighs_other_parts_is_nothing_to_have_at_hand() {
    let (design, booklet) = designed("cognifly-v8");
    let has = |name: &str| booklet.lists.parts.iter().any(|[_, part, _]| part == name);
    assert!(!has("unitemised") && has("battery") && has("motor"), "{:?}", booklet.lists.parts);
    assert_eq!(design.frame.built_in_extras().count(), 0);
    let wiring = booklet.after.iter().find(|panel| panel.heading.ends_with("Motor wires")).expect("a step of wires");
    assert!(wiring.parts.iter().all(|line| line.part != "wiring"), "{:?}", wiring.parts);
}

/// The preset has the real frame's sizes, which miss some limits: who builds it reads that first.
#[test]
fn regress_violated_limits_are_on_the_first_page() {
    let (_, booklet) = designed("cognifly-v8");
    let told = booklet.preface.iter().find(|line| line.starts_with("This frame violates limits")).expect("is told");
    assert!(told.contains("propeller clearance: propeller_FR passes ") && told.contains("more like it"), "{told}");
    assert!(booklet.pages.iter().filter_map(|page| page.caution.as_ref()).all(|caution| !caution.contains("propeller is clear")));
    let (_, good) = designed("cognifly");
    assert!(good.preface.iter().all(|line| !line.contains("violates limits")), "{:?}", good.preface);
}

/// A ring on a rod is drawn with something, at a length that is measured; so is glue at hand where a step speaks of it.
#[test]
fn regress_steps_with_a_ring_or_glue_name_what_it_takes() {
    let (_, booklet) = designed("cognifly");
    let rings: Vec<_> =
        booklet.pages.iter().filter(|page| page.measures.iter().any(|line| line.contains("mark the rod as the ring"))).collect();
    assert!(rings.len() > 5 && rings.iter().all(|page| page.facts.contains("ruler or caliper, pen for plastics")), "{}", rings.len());
    let glued = |caution: &String| caution.contains("cyanoacrylate") || caution.contains("Glue only a rod");
    let glued: Vec<_> = booklet.pages.iter().filter(|page| page.caution.as_ref().is_some_and(glued)).collect();
    assert!(glued.len() > 2 && glued.iter().all(|page| page.facts.contains("cyanoacrylate")), "{}", glued.len());
}

/// Names have no spaces to break at, and up to a hundred letters.
#[test]
fn planted_long_names_stay_in_their_columns() {
    let mut frame = Frame::load("cognifly").expect("a frame").0;
    frame.name = "w".repeat(100);
    frame.flexible.name = "a-material-with-a-rather-long-name".repeat(2);
    let (_, booklet) = written(Design::with(frame, common::memo()).expect("designs"));
    let marks = marks(&booklet).expect("the typeface reads");
    for sheet in marks.chunk_by(|a, b| a.sheet == b.sheet) {
        let pair = overlapping(sheet).map(|pair| pair.map(words_of));
        assert!(pair.is_none() && !sheet.iter().any(leaves_its_sheet), "sheet {}: {pair:?}", sheet[0].sheet + 1);
    }
    let all = printed(&marks).replace(' ', "");
    assert!(all.contains(&"w".repeat(100)) && all.contains(&"a-material-with-a-rather-long-name".repeat(2)));
}

/// Words that no sheet has room for beside a picture: each mount has a sheet of its own, and the words go on on the next.
#[test]
fn planted_a_mount_with_many_words_has_sheets_of_its_own() {
    let (_, mut booklet) = designed("cognifly-mini");
    let sheets = |booklet: &Booklet| marks(booklet).expect("the typeface reads").last().map(|mark| mark.sheet);
    let before = sheets(&booklet).expect("has sheets");
    booklet.before[0].text = "A sentence of some words. ".repeat(150);
    assert_eq!(sheets(&booklet), Some(before + 1 - booklet.before.len() % 2));
    booklet.before[0].text = "A sentence of some words. ".repeat(400);
    let all = marks(&booklet).expect("the typeface reads");
    assert!(all.chunk_by(|a, b| a.sheet == b.sheet).all(|sheet| overlapping(sheet).is_none() && !sheet.iter().any(leaves_its_sheet)));
}

/// A test that finds nothing because it looks at nothing would pass, too.
#[test]
fn planted_words_on_words_are_found() {
    let mark = |y: f32, words: &str| Mark { sheet: 0, at: [MARGIN, y], size: [100.0, 12.0], what: What::Words(words.into(), 9.0) };
    assert!(overlapping(&[mark(100.0, "one"), mark(112.0, "below")]).is_none());
    assert!(overlapping(&[mark(100.0, "one"), mark(108.0, "upon it")]).is_some());
    assert!(leaves_its_sheet(&mark(PAPER[1] - 30.0, "low")) && !leaves_its_sheet(&mark(100.0, "one")));
}
