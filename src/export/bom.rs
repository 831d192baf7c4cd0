//! `bom.csv`: what to print, what to buy, and how to cut the rods from stock lengths.

use super::bill::{Bill, BuyLine, CutLine, PrintLine, RodLine};
use super::format::{ExportError, Exported, File, Format};
use super::table;

/// The bill of materials.
pub const FORMAT: Format = Format {
    extension: "csv",
    sentence: "The bill of materials: what to print, what to buy, and how to cut the rods from stock lengths.",
    always: true,
    files,
};

fn files(of: &Exported) -> Result<Vec<File>, ExportError> {
    Ok(vec![File::new("bom.csv", csv(of.bill)?.into_bytes())])
}

/// Columns of the CSV; a missing value is empty.
const COLUMNS: [&str; 22] = [
    "kind",
    "name",
    "quantity",
    "material",
    "length_mm",
    "mass_each_g",
    "mass_total_g",
    "mass_basis",
    "source",
    "volume_mm3",
    "print_min",
    "screw_thread_mm",
    "screw_length_mm",
    "price_each",
    "currency",
    "price_source",
    "cut",
    "quantity_with_spares",
    "price_most_each",
    "price_date",
    "search",
    "note",
];

/// A line of the CSV, a field for each column.
type Row = [String; COLUMNS.len()];

/// The bill of materials as CSV: lines of the kinds `printed`, `rod`, `bought`, `extra`, `supply`, and
/// `stock`, one for each stock length of rods, with how to cut it.
///
/// # Errors
/// Those of [`table::csv`].
pub fn csv(bill: &Bill) -> Result<String, ExportError> {
    let rows = bill.print.iter().map(printed_row).chain(bill.rods.iter().map(rod_row));
    let rows = rows.chain(bill.buy.iter().filter(|line| !is_rod(line)).map(bought_row)).chain(stock_rows(bill));
    table::csv("bom.csv", COLUMNS, rows)
}

/// Whether a line is of the rods' stock; an extra may be called so, too.
fn is_rod(line: &BuyLine) -> bool {
    line.role == "rod" && line.kind == "rod"
}

fn printed_row(line: &PrintLine) -> Row {
    let mut row = weighed("printed", line.part, line.quantity, &line.material, line.mass_g, "computed");
    row[9] = format!("{:.1}", line.volume_mm3);
    row[10] = line.print_min.map(|minutes| format!("{minutes:.1}")).unwrap_or_default();
    priced(row, line.price.map(|price| format!("{price:.4}")), line.currency.as_ref(), line.price_source.as_ref())
}

fn rod_row(line: &RodLine) -> Row {
    let mut row = weighed("rod", &line.rod, line.quantity, &line.material, line.mass_g, &line.mass_basis);
    row[4] = format!("{:.2}", line.length_mm);
    row[16] = format!("saw to {:.1}", line.sawn_mm);
    row
}

fn bought_row(line: &BuyLine) -> Row {
    let kind = if matches!(line.kind.as_str(), "extra" | "supply") { line.kind.as_str() } else { "bought" };
    let basis = line.mass_basis.as_deref().unwrap_or_default();
    let mut row = weighed(kind, &line.role, line.quantity, &line.name, line.mass_g.unwrap_or(0.0), basis);
    if line.mass_g.is_none() {
        (row[5], row[6]) = Default::default();
    }
    row[4] = line.length_mm.map(|mm| format!("{mm:.2}")).unwrap_or_default();
    row[8].clone_from(&line.source);
    if let Some([thread_mm, length_mm]) = line.screw_mm {
        (row[11], row[12]) = (thread_mm.to_string(), length_mm.to_string());
    }
    bought(row, line)
}

/// A row a stock length: what to cut from it.
fn stock_rows(bill: &Bill) -> Vec<Row> {
    let Some(rod) = bill.buy.iter().find(|line| is_rod(line)) else { return Vec::new() };
    let row = |name: String, quantity: &str, how: String| {
        let mut row = Row::default();
        row[0] = "stock".into();
        row[1] = name;
        row[2] = quantity.into();
        row[3] = bill.rods.first().map_or(String::new(), |line| line.material.clone());
        row[4] = format!("{:.2}", bill.stock_mm);
        row[8].clone_from(&rod.source);
        row[16] = how;
        let mut row = bought(row, rod);
        row[17] = quantity.into();
        row
    };
    if let Some(error) = &bill.cut_error {
        return vec![row(rod.name.clone(), "0", error.clone())];
    }
    let stock = |(at, stock): (usize, &CutLine)| {
        let cuts: Vec<String> = stock.pieces.iter().map(|(role, mm)| format!("{role} {mm:.1}")).collect();
        row(format!("{}-{}", rod.name, at + 1), "1", format!("cut: {}; rest {:.1}", cuts.join(" + "), stock.rest_mm))
    };
    bill.cut.iter().enumerate().map(stock).collect()
}

fn weighed(kind: &str, name: &str, quantity: u32, material: &str, mass_g: f64, basis: &str) -> Row {
    let mut row = Row::default();
    row[0] = kind.into();
    row[1] = name.into();
    row[2] = quantity.to_string();
    row[3] = material.into();
    row[5] = format!("{:.3}", mass_g / f64::from(quantity.max(1)));
    row[6] = format!("{mass_g:.3}");
    row[7] = basis.into();
    row
}

/// A row with what to search for, how many to buy, and the price of one.
fn bought(row: Row, line: &BuyLine) -> Row {
    let mut row = priced(row, line.price.map(|price| price.to_string()), line.currency.as_ref(), line.price_source.as_ref());
    row[17] = line.with_spares.to_string();
    row[18] = line.price_most.map(|price| price.to_string()).unwrap_or_default();
    row[19] = line.price_date.clone().unwrap_or_default();
    row[20].clone_from(&line.search);
    row[21].clone_from(&line.note);
    row
}

/// A row with the price of one.
fn priced(mut row: Row, price: Option<String>, currency: Option<&String>, source: Option<&String>) -> Row {
    row[13] = price.unwrap_or_default();
    row[14] = currency.cloned().unwrap_or_default();
    row[15] = source.cloned().unwrap_or_default();
    row
}
