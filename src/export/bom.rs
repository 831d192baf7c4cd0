//! `bom.csv`: what to print, what to buy, and how to cut the rods from stock lengths.

use super::cutting::{self, Stock, TooLong};
use crate::assembly::Design;
use crate::assembly::mass::MassTable;
use crate::skeleton::RodRole;

/// Width of a saw cut, mm.
pub const KERF_MM: f64 = 1.0;

/// Cuts all rods of a design from stock lengths.
///
/// # Errors
/// When a rod is longer than the stock.
pub fn cutting_plan(design: &Design, stock_mm: f64) -> Result<Vec<Stock>, TooLong> {
    cut(design, stock_mm, KERF_MM)
}

/// The stock length that a design's rods are cut from, mm, and how, with saw cuts of a width.
pub(super) fn rod_plan(design: &Design, kerf_mm: f64) -> (f64, Result<Vec<Stock>, TooLong>) {
    let rod = design.frame.bought.get("rod");
    let stock_mm = rod.map_or(1000.0, |rod| rod.part.stock_length_mm.unwrap_or(rod.part.size_mm[0]));
    (stock_mm, cut(design, stock_mm, kerf_mm))
}

fn cut(design: &Design, stock_mm: f64, kerf_mm: f64) -> Result<Vec<Stock>, TooLong> {
    let count = |role: RodRole| u8::try_from(design.skeleton.rods_of(role).count()).unwrap_or(u8::MAX);
    cutting::plan(&RodRole::ALL.map(|role| (role, design.skeleton.length_mm(role), count(role))), stock_mm, kerf_mm)
}

/// The bill of materials as CSV (comma, quotes where needed, `\n`).
pub fn csv(design: &Design, masses: &MassTable, kerf_mm: f64) -> String {
    let mut rows = vec!["kind,name,quantity,material,length_mm,mass_each_g,mass_total_g,mass_basis,source".to_string()];
    for line in &masses.lines {
        let length =
            RodRole::ALL.iter().find(|role| line.name == format!("{}_rod", role.slug())).map(|role| design.skeleton.length_mm(*role));
        let source = design.frame.bought.get(&line.name).map(|item| item.part.source.clone());
        let source = source.or_else(|| design.frame.extras.get(&line.name).map(|extra| extra.source.clone())).unwrap_or_default();
        rows.push(format!(
            "{},{},{},{},{},{:.3},{:.3},{},{}",
            line.kind,
            quoted(&line.name),
            line.quantity,
            quoted(&line.material),
            length.map(|mm| format!("{mm:.2}")).unwrap_or_default(),
            line.each_g,
            line.total_g,
            quoted(&line.basis),
            quoted(&source)
        ));
    }
    rows.extend(cut_rows(design, kerf_mm));
    rows.join("\n") + "\n"
}

/// A row a stock length: what to cut from it.
fn cut_rows(design: &Design, kerf_mm: f64) -> Vec<String> {
    let Some(rod) = design.frame.bought.get("rod") else { return Vec::new() };
    let (stock_mm, plan) = rod_plan(design, kerf_mm);
    match plan {
        Ok(plan) => plan
            .iter()
            .enumerate()
            .map(|(index, stock)| {
                let cuts: Vec<String> = stock.pieces.iter().map(|(role, mm)| format!("{} {mm:.1}", role.slug())).collect();
                let how = format!("cut: {}; rest {:.1}", cuts.join(" + "), stock.rest_mm);
                format!("stock,{}-{},1,{},{stock_mm:.2},,,,{}", rod.name, index + 1, design.frame.rod_material.name, quoted(&how))
            })
            .collect(),
        Err(error) => {
            vec![format!("stock,{},0,{},{stock_mm:.2},,,,{}", rod.name, design.frame.rod_material.name, quoted(&error.to_string()))]
        }
    }
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_string() }
}
