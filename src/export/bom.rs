//! `bom.csv`: what to print, what to buy, and how to cut the rods from stock lengths.

use crate::assembly::Design;
use crate::assembly::mass::MassTable;
use crate::skeleton::RodRole;

/// Width of a saw cut, mm.
pub const KERF_MM: f64 = 1.0;

/// One stock length and what is cut from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Stock {
    /// Pieces in the order of cutting: role and length, mm.
    pub pieces: Vec<(RodRole, f64)>,
    /// What is left, mm.
    pub rest_mm: f64,
}

/// A piece longer than the stock.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("a {} rod of {length_mm:.1} mm is longer than the stock of {stock_mm:.0} mm", role.slug())]
pub struct TooLong {
    /// Role of the rod.
    pub role: RodRole,
    /// Its length, mm.
    pub length_mm: f64,
    /// Length that rods are sold in, mm.
    pub stock_mm: f64,
}

/// Cuts all rods from stock lengths, longest first, each from the first stock with room (first fit decreasing).
///
/// # Errors
/// When a rod is longer than the stock.
pub fn cutting_plan(design: &Design, stock_mm: f64) -> Result<Vec<Stock>, TooLong> {
    let mut pieces: Vec<(RodRole, f64)> = design.skeleton.rods.iter().map(|rod| (rod.role, rod.length_mm())).collect();
    pieces.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let mut plan: Vec<Stock> = Vec::new();
    for (role, length_mm) in pieces {
        if length_mm > stock_mm {
            return Err(TooLong { role, length_mm, stock_mm });
        }
        match plan.iter_mut().find(|stock| stock.rest_mm >= length_mm) {
            Some(stock) => {
                stock.rest_mm = (stock.rest_mm - length_mm - KERF_MM).max(0.0);
                stock.pieces.push((role, length_mm));
            }
            None => plan.push(Stock { pieces: vec![(role, length_mm)], rest_mm: (stock_mm - length_mm - KERF_MM).max(0.0) }),
        }
    }
    Ok(plan)
}

/// The bill of materials as CSV (comma, quotes where needed, `\n`).
pub fn csv(design: &Design, masses: &MassTable) -> String {
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
    rows.extend(cut_rows(design));
    rows.join("\n") + "\n"
}

/// A row a stock length: what to cut from it.
fn cut_rows(design: &Design) -> Vec<String> {
    let Some(rod) = design.frame.bought.get("rod") else { return Vec::new() };
    let stock_mm = rod.part.stock_length_mm.unwrap_or(rod.part.size_mm[0]);
    match cutting_plan(design, stock_mm) {
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
