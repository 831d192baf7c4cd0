//! The bill of materials as a page in Markdown.

use std::fmt::Write;

use super::bill::{Bill, BuyLine, CutLine};
use super::cutting::{Saving, rest_words};
use super::spares::SPARE_RULES;
use crate::markdown::inert;

/// The page.
pub fn markdown(bill: &Bill) -> String {
    let mut page = format!("# Bill of materials: {}\n\n## Print\n\n", bill.frame);
    page += "| part | pieces | material | mm3 in all | g in all | time, min | cost |\n|---|---:|---|---:|---:|---:|---:|\n";
    for line in &bill.print {
        let time = line.print_min.map_or("-".into(), |minutes| format!("{minutes:.0}"));
        let all = line.price.map(|price| price * f64::from(line.quantity));
        let cost = all.zip(line.currency.as_ref()).map_or("-".into(), |(all, currency)| inert(&format!("{all:.2} {currency}")));
        let _ = writeln!(
            page,
            "| {} | {} | {} | {:.0} | {:.2} | {time} | {cost} |",
            line.part,
            line.quantity,
            inert(&line.material),
            line.volume_mm3,
            line.mass_g
        );
    }
    let time = bill.print_h.map_or(String::new(), |hours| {
        format!(", {hours:.1} h by an estimate within 15 % of PrusaSlicer's; heating, cooling and support come on top")
    });
    let sums = summed(&bill.filament_prices);
    let cost = match bill.print.iter().filter(|line| line.price.is_none()).count() {
        _ if sums.is_empty() => String::new(),
        0 => format!(", {sums}"),
        without => format!(", {sums} without that of {without} lines whose material states no price"),
    };
    let _ = writeln!(page, "\n{:.1} g of filament{cost}{time}.\n", bill.printed_g);
    buy(&mut page, bill);
    cut(&mut page, bill);
    page
}

fn buy(page: &mut String, bill: &Bill) {
    *page += "## Buy\n\n| what | part | needed | with spares | search for | price of one | note |\n|---|---|---:|---:|---|---:|---|\n";
    for line in &bill.buy {
        let (role, search) = (inert(&line.role), inert(dash(&line.search)));
        let (needed, spares) = (needed(line), line.with_spares);
        let _ =
            writeln!(page, "| {role} | {} | {needed} | {spares} | {search} | {} | {} |", name(line), price(line), inert(dash(&line.note)));
    }
    let _ = write!(page, "\nSpares: {}.", SPARE_RULES.iter().map(|rule| rule.words).collect::<Vec<_>>().join("; "));
    if bill.buy.iter().all(|line| !line.name.contains("insert")) {
        *page += " No threaded inserts are needed: screws cut their own thread in the hub, and the motors have theirs.";
    }
    *page += " Lengths of wires are estimates for buying: measure before you cut.\n";
    prices(page, bill);
    *page +=
        "### Masses of what is bought\n\n| what | part | pieces | g in all | how it is known | source |\n|---|---|---:|---:|---|---|\n";
    for line in bill.buy.iter().filter(|line| line.kind != "supply") {
        let mass = line.mass_g.map_or("-".into(), |mass| format!("{mass:.2}"));
        let basis = inert(line.mass_basis.as_deref().unwrap_or("-"));
        let (role, pieces) = (inert(&line.role), line.quantity);
        let _ = writeln!(page, "| {role} | {} | {pieces} | {mass} | {basis} | {} |", name(line), inert(&line.source));
    }
    *page += "\n";
}

/// How many, and how long where it is a wire.
fn needed(line: &BuyLine) -> String {
    line.length_mm.map_or(line.quantity.to_string(), |mm| format!("{} x {mm:.0} mm", line.quantity))
}

fn dash(text: &str) -> &str {
    if text.is_empty() { "-" } else { text }
}

fn prices(page: &mut String, bill: &Bill) {
    let range = |least: f64, most: f64| if least < most { format!("{least:.2} to {most:.2}") } else { format!("{least:.2}") };
    let sums: Vec<String> =
        bill.prices_with_spares.iter().map(|(currency, least, most)| format!("{} {currency}", range(*least, *most))).collect();
    let _ = match sums[..] {
        [] => writeln!(page, "\nThe catalogue has no price with a source for any of these.\n"),
        _ => writeln!(page, "\n{} with spares; {} lines have no price with a source.\n", sums.join(" and "), bill.without_price),
    };
}

/// Sums in words; nothing where there are none.
fn summed(sums: &[(String, f64)]) -> String {
    let one = |(currency, sum): &(String, f64)| inert(&format!("{sum:.2} {currency}"));
    sums.iter().map(one).collect::<Vec<_>>().join(" and ")
}

fn name(line: &BuyLine) -> String {
    if line.name.is_empty() {
        return "-".into();
    }
    let screw = line.screw_mm.map_or(String::new(), |[thread, length]| format!(" (M{thread} x {length} mm)"));
    inert(&format!("{}{screw}", line.name))
}

fn price(line: &BuyLine) -> String {
    let (Some(price), Some(currency), Some(source)) = (line.price, &line.currency, &line.price_source) else { return "-".into() };
    let most = line.price_most.filter(|most| *most > price).map_or(String::new(), |most| format!(" to {most:.2}"));
    let date = line.price_date.as_ref().map_or(String::new(), |date| format!(", {date}"));
    inert(&format!("{price:.2}{most} {currency} ({source}{date})"))
}

fn cut(page: &mut String, bill: &Bill) {
    *page += "## Cut\n\n| rod | pieces | saw to, mm | in the model, mm | material | g in all |\n|---|---:|---:|---:|---|---:|\n";
    for line in &bill.rods {
        let _ = writeln!(
            page,
            "| {} | {} | {:.1} | {:.2} | {} | {:.2} |",
            line.rod,
            line.quantity,
            line.sawn_mm,
            line.length_mm,
            inert(&line.material),
            line.mass_g
        );
    }
    let sold = format!("Stock lengths of {:.0} mm, saw cuts of {} mm", bill.stock_mm, bill.kerf_mm);
    if let Some(error) = &bill.cut_error {
        let _ = writeln!(page, "\n{sold}.\n\n**{error}**");
        return;
    }
    let _ = writeln!(page, "\n{sold}; no plan needs fewer.\n");
    *page += "| stock | pieces, mm | rest, mm |\n|---:|---|---:|\n";
    for (at, CutLine { pieces, rest_mm }) in bill.cut.iter().enumerate() {
        let pieces: Vec<String> = pieces.iter().map(|(role, mm)| format!("{role} {mm:.1}")).collect();
        let _ = writeln!(page, "| {} | {} | {} |", at + 1, pieces.join(" + "), rest_words(*rest_mm));
    }
    for Saving { rod, from_mm, to_mm } in &bill.savings {
        let _ = writeln!(page, "\nA stock length is saved by `{rod}` rods of {to_mm:.1} mm instead of {from_mm:.1} mm.");
    }
}
