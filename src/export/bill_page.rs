//! The bill of materials as a page in Markdown.

use std::fmt::Write;

use super::bill::{Bill, BuyLine, CutLine};
use super::cutting::Saving;
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
    *page += "## Buy\n\n| role | part | pieces | g in all | how it is known | price of one | source |\n|---|---|---:|---:|---|---:|---|\n";
    for line in &bill.buy {
        let mass = line.mass_g.map_or("-".into(), |mass| format!("{mass:.2}"));
        let basis = inert(line.mass_basis.as_deref().unwrap_or("-"));
        let (role, pieces) = (inert(&line.role), line.quantity);
        let _ = writeln!(page, "| {role} | {} | {pieces} | {mass} | {basis} | {} | {} |", name(line), price(line), inert(&line.source));
    }
    let sums = summed(&bill.prices);
    let _ = match sums.as_str() {
        "" => writeln!(page, "\nThe catalogue has no price with a source for any of these.\n"),
        _ => writeln!(page, "\n{sums} in all; {} lines have no price with a source.\n", bill.without_price),
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
    match (line.price, &line.currency, &line.price_source) {
        (Some(price), Some(currency), Some(source)) => inert(&format!("{price:.2} {currency} ({source})")),
        _ => "-".into(),
    }
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
    let _ = writeln!(page, "\nStock lengths of {:.0} mm, saw cuts of {} mm; no plan needs fewer.\n", bill.stock_mm, bill.kerf_mm);
    if let Some(error) = &bill.cut_error {
        let _ = writeln!(page, "**{error}**");
        return;
    }
    *page += "| stock | pieces, mm | rest, mm |\n|---:|---|---:|\n";
    for (at, CutLine { pieces, rest_mm }) in bill.cut.iter().enumerate() {
        let pieces: Vec<String> = pieces.iter().map(|(role, mm)| format!("{role} {mm:.1}")).collect();
        let _ = writeln!(page, "| {} | {} | {rest_mm:.1} |", at + 1, pieces.join(" + "));
    }
    for Saving { rod, from_mm, to_mm } in &bill.savings {
        let _ = writeln!(page, "\nA stock length is saved by `{rod}` rods of {to_mm:.1} mm instead of {from_mm:.1} mm.");
    }
}
