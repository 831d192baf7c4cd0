//! What a person does next with the files of a frame: buy, try the printer, print, cut, put together; each with its time, its cost and its file.

use std::fmt::Write;

use crate::export::bill::Bill;
use crate::figures::decimals;
use crate::frame::assembly::Design;
use crate::frame::fold::FoldSequence;
use crate::frame::mounting::mounts_of;
use crate::markdown::inert;
use crate::printing::plates::{self, Plate};

/// A step: what is done, how long it takes, what it costs, where it stands.
type Row = [String; 4];

/// The section of a page.
pub fn section(page: &mut String, design: &Design, bill: &Bill, plates: &[(Plate, Vec<u8>)]) {
    page.push_str("## What to do next\n\n| | what | time | cost | where it stands |\n|---|---|---:|---:|---|\n");
    let try_first: Row = [
        "try the printer: fits and hinges, on a coupon, with a piece of a bought rod".into(),
        unknown(),
        unknown(),
        "`flexframe coupon FRAME`".into(),
    ];
    let steps = [buy(design, bill), try_first, print(design, bill, plates), cut(bill), put_together(design)];
    for (at, [what, time, cost, place]) in steps.iter().enumerate() {
        // Writing to a String cannot fail.
        let _ = writeln!(page, "| {} | {what} | {time} | {cost} | {place} |", at + 1);
    }
    page.push_str(
        "\nTimes are estimates: printing without heating, cooling and support, assembly by hand without practice. What has no figure is not known. \
         FRAME is the preset or file that this folder was built from.\n\n",
    );
}

fn unknown() -> String {
    "-".into()
}

fn print(design: &Design, bill: &Bill, plates: &[(Plate, Vec<u8>)]) -> Row {
    let pieces: u32 = bill.print.iter().map(|line| line.quantity).sum();
    let time = bill.print_h.map_or_else(unknown, |hours| format!("{hours:.1} h"));
    if plates.is_empty() {
        let what = format!("print {pieces} parts, {:.0} g; not all of them lie on the printer's bed", bill.printed_g);
        return [what, time, unknown(), "`parts/`, one STL file each".into()];
    }
    let plate = |(plate, _): &(Plate, Vec<u8>)| {
        let hours = plate.print_s(design).map_or(String::new(), |seconds| format!(" {} h", decimals(seconds / 3600.0, 1)));
        format!("{}{hours}", linked(&plate.name()))
    };
    let files: Vec<String> = plates.iter().map(plate).collect();
    let bare: Vec<Plate> = plates.iter().map(|(plate, _)| plate.clone()).collect();
    let no_room = plates::without_room(&bare, &plates::all(design));
    if !no_room.is_empty() {
        let names: Vec<String> = no_room.iter().map(|(part, count)| format!("{count} {part}")).collect();
        let laid = pieces as usize - no_room.iter().map(|(_, count)| count).sum::<usize>();
        let grams: f64 = bare.iter().map(|plate| plate.material.material.printed_g(plate.volume_mm3(&design.printed))).sum();
        let time = bare.iter().map(|plate| plate.print_s(design)).sum::<Option<f64>>();
        let time = time.map_or_else(unknown, |seconds| format!("{:.1} h", seconds / 3600.0));
        let what = format!(
            "print {laid} of {pieces} parts on {}, {grams:.0} g; **the printer's bed has no room for {}**, whose files are in `parts/`",
            counted(plates.len(), "plate"),
            names.join(", ")
        );
        return [what, time, unknown(), format!("{}; [settings](print-settings.md)", files.join(", "))];
    }
    let what = format!("print {pieces} parts on {}, {:.0} g", counted(plates.len(), "plate"), bill.printed_g);
    let sums: Vec<String> = bill.filament_prices.iter().map(|(currency, sum)| price(*sum, *sum, currency)).collect();
    let without = if bill.print.iter().any(|line| line.price.is_none()) { ", without what has no price" } else { "" };
    let cost = if sums.is_empty() { unknown() } else { format!("{}{without}", sums.join(" and ")) };
    [what, time, cost, format!("{}; [settings](print-settings.md)", files.join(", "))]
}

/// A plate's name as a link to its file; a material's name that is no plain word is written without one.
fn linked(plate: &str) -> String {
    let plain = plate.chars().all(|c| c.is_ascii_alphanumeric() || "-_.".contains(c));
    if plain { format!("[{plate}](plates/{plate}.3mf)") } else { format!("{} in `plates/`", inert(plate)) }
}

fn cut(bill: &Bill) -> Row {
    let pieces: u32 = bill.rods.iter().map(|line| line.quantity).sum();
    let what = match &bill.cut_error {
        Some(error) => format!("cut {pieces} rods: **{}**", inert(error)),
        None => format!("cut {pieces} rods from {} of {:.0} mm", counted(bill.cut.len(), "stock length"), bill.stock_mm),
    };
    [what, unknown(), unknown(), "lengths below; [which from which](bom.csv)".into()]
}

fn buy(design: &Design, bill: &Bill) -> Row {
    // Of the extras those that are things; the others are masses of what has lines of its own.
    let is_thing = |name: &str| design.frame.built_in_things().any(|(thing, _)| thing == name);
    let lines = bill.buy.iter().filter(|line| line.kind != "extra" || is_thing(&line.role));
    let sums: Vec<String> = bill.prices_with_spares.iter().map(|(currency, least, most)| price(*least, *most, currency)).collect();
    let cost = if sums.is_empty() { unknown() } else { format!("{}, without what has no price", sums.join(" and ")) };
    [
        format!("buy {} things, spares, glue and wires among them", lines.count()),
        unknown(),
        cost,
        "[bill](bom.csv), `flexframe bom FRAME`".into(),
    ]
}

/// An amount of money, or from one to another.
fn price(least: f64, most: f64, currency: &str) -> String {
    let most = if most > least { format!(" to {most:.2}") } else { String::new() };
    inert(&format!("{least:.2}{most} {currency}"))
}

fn put_together(design: &Design) -> Row {
    let mounts = mounts_of(design);
    let place = String::from("`flexframe fold FRAME`");
    let Ok(fold) = FoldSequence::new(&design.frame, &design.skeleton) else {
        return ["fold it: **no order of folding was found**".into(), unknown(), unknown(), place];
    };
    let minutes = fold.steps.iter().map(|step| step.minutes).sum::<f64>()
        + mounts.iter().map(|mount| mount.minutes * mount.repeats() as f64).sum::<f64>();
    let what = format!("put it together and fold it, {}", counted(fold.steps.len() + mounts.len(), "step"));
    [what, format!("{:.1} h", minutes / 60.0), unknown(), place]
}

fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}
