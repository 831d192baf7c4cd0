//! `report.md`: what a person wants to know about a frame, on one page.

use std::fmt::Write;

use super::next_steps;
use crate::checks::{Finding, Tightest, Verdict, tightest};
use crate::export::bill::Bill;
use crate::figures::decimals;
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::MassTable;
use crate::frame::skeleton::strut_fold_deg;
use crate::markdown::inert;
use crate::params::Frame;
use crate::printing::plates::Plate;

/// The report of a design, with its bill, its findings and its plates; `pictures` says whether the pictures lie beside it.
pub fn markdown(
    design: &Design,
    masses: &MassTable,
    bill: &Bill,
    findings: &[Finding],
    plates: &[(Plate, Vec<u8>)],
    pictures: bool,
) -> String {
    let mut page = String::new();
    let frame = &design.frame;
    // Writing to a String cannot fail.
    let _ = writeln!(page, "# {}\n", inert(&frame.name));
    if !frame.description.is_empty() {
        let _ = writeln!(page, "{}\n", inert(&frame.description));
    }
    verdict(&mut page, findings);
    next_steps::section(&mut page, design, bill, plates);
    page.push_str("## The frame\n\n");
    if pictures {
        page.push_str("![assembled](pictures/assembled_perspective.png)\n\n");
    }
    geometry(&mut page, design, masses);
    printed(&mut page, design, masses, pictures);
    rods(&mut page, design, bill);
    weights(&mut page, masses);
    limits(&mut page, findings);
    if pictures {
        page.push_str("## Pictures\n\n| front | right | top |\n|---|---|---|\n");
        page.push_str(
            "| ![front](pictures/assembled_front.png) | ![right](pictures/assembled_right.png) | ![top](pictures/assembled_top.png) |\n\n",
        );
        page.push_str("All parts as they are printed, plate by plate:\n\n![flat](pictures/flat_on_bed.png)\n");
    }
    page
}

fn verdict(page: &mut String, findings: &[Finding]) {
    let broken: Vec<&Finding> = findings.iter().filter(|f| f.verdict == Verdict::Violated).collect();
    let warnings: Vec<&Finding> = findings.iter().filter(|f| f.warns()).collect();
    let count = match warnings.len() {
        0 => String::new(),
        1 => ", 1 warning".into(),
        count => format!(", {count} warnings"),
    };
    if broken.is_empty() {
        let _ = writeln!(page, "Every limit holds{count}{}\n", if warnings.is_empty() { "." } else { ":" });
    } else {
        let limits = if broken.len() == 1 { "1 limit is".into() } else { format!("{} limits are", broken.len()) };
        let _ = writeln!(page, "**{limits} violated**{count}:\n");
    }
    for finding in broken.iter().chain(&warnings) {
        let word = if finding.warns() { "warning: " } else { "**violated:** " };
        let _ = writeln!(page, "- {word}{}{}", inert(&finding.message), mend(finding));
    }
    if !broken.is_empty() || !warnings.is_empty() {
        page.push('\n');
    }
    page.push_str("The design drop was not simulated for this page: `flexframe check --strength` does it.\n\n");
}

/// What changes a finding, as the end of its sentence.
fn mend(finding: &Finding) -> String {
    let keys: Vec<String> = finding.levers.iter().map(|lever| format!("`{lever}`")).collect();
    match &keys[..] {
        [] => String::new(),
        [key] => format!("; driven by {key}"),
        [first @ .., last] => format!("; driven by {} or {last}", first.join(", ")),
    }
}

fn geometry(page: &mut String, design: &Design, masses: &MassTable) {
    let c = &design.skeleton.closure;
    let [x, y, z] = masses.centre_of_mass_mm.map(|mm| decimals(mm, 1));
    let _ = writeln!(page, "| | |\n|---|---|");
    let _ = writeln!(page, "| total mass | {:.1} g, of which {:.1} g are estimates |", masses.total_g, masses.estimated_g);
    let _ = writeln!(page, "| centre of mass (X right, Y front, Z up from the arms) | {x}, {y}, {z} mm |");
    let i = masses.inertia_g_mm2;
    let _ = writeln!(page, "| inertia about it, Ixx, Iyy, Izz | {:.0}, {:.0}, {:.0} g mm² |", i[0][0], i[1][1], i[2][2]);
    let _ = writeln!(page, "| strut tilt, leg slope | {:.1}°, {:.1}° |", c.strut_tilt.to_deg(), c.leg_tilt.to_deg());
    let _ = writeln!(
        page,
        "| folds: struts at the corners, legs at both ends | {:.1}°, {:.1}° |",
        strut_fold_deg(c.strut_tilt.to_deg()),
        c.leg_tilt.to_deg()
    );
    page.push('\n');
}

fn printed(page: &mut String, design: &Design, masses: &MassTable, pictures: bool) {
    page.push_str("## Print\n\n| part | pieces | material | size mm | volume mm³ | g each | file |\n|---|---|---|---|---|---|---|\n");
    for part in &design.printed {
        let [x, y, z] = part.mesh.size_mm();
        let line = masses.printed(part.name);
        let (material, each) = line.map_or((String::new(), 0.0), |line| (inert(&line.material), line.each_g));
        let picture = if pictures { format!(" [picture](pictures/part_{}.png)", part.name) } else { String::new() };
        let _ = writeln!(
            page,
            "| {} | {} | {material} | {x:.1} x {y:.1} x {z:.1} | {:.0} | {each:.2} | [stl](parts/{}.stl){picture} |",
            part.name,
            part.part.quantity(),
            part.volume_mm3,
            part.name
        );
    }
    page.push('\n');
}

/// What is cut: rods, or tubes with their wall.
fn stock_words(frame: &Frame) -> String {
    let wall_mm = frame.bought.get("rod").and_then(|rod| rod.part.wall_mm);
    let across_mm = frame.rods.rod_diameter_mm;
    wall_mm.map_or_else(|| format!("Rods of {across_mm} mm"), |wall| format!("Tubes of {across_mm} mm with walls of {wall} mm"))
}

fn rods(page: &mut String, design: &Design, bill: &Bill) {
    let _ = writeln!(page, "## Cut\n\n{}, {}:\n", stock_words(&design.frame), inert(&design.frame.rod_material.name));
    for role in design.skeleton.roles() {
        let _ = writeln!(page, "- {} x {} {:.1} mm", design.skeleton.rods_of(role).count(), role.slug(), design.skeleton.sawn_mm(role));
    }
    let _ = match &bill.cut_error {
        None => {
            writeln!(page, "\n{} stock lengths of {:.0} mm; which piece from which stands in `bom.csv`.\n", bill.cut.len(), bill.stock_mm)
        }
        Some(error) => writeln!(page, "\n**{}**\n", inert(error)),
    };
}

fn weights(page: &mut String, masses: &MassTable) {
    page.push_str("## Mass\n\n| what | pieces | g each | g | how it is known |\n|---|---|---|---|---|\n");
    for line in &masses.lines {
        let _ = writeln!(
            page,
            "| {} {} | {} | {:.2} | {:.2} | {} |",
            inert(&line.name),
            inert(&line.material),
            line.quantity,
            line.each_g,
            line.total_g,
            line.basis
        );
    }
    let _ = writeln!(page, "| **total** | | | **{:.1}** | |\n", masses.total_g);
}

fn limits(page: &mut String, findings: &[Finding]) {
    let count = findings.len();
    let _ = writeln!(page, "## Limits\n\nThe tightest of each kind; `flexframe check --all` prints all {count}.\n");
    page.push_str("| rule | of | value | limit | margin | |\n|---|---|---|---|---|---|\n");
    for Tightest { finding: f, .. } in tightest(findings) {
        let verdict = match f.verdict {
            Verdict::Holds => "holds",
            Verdict::Violated => "**violated**",
            Verdict::Note if f.warns() => "warning",
            Verdict::Note => "note",
        };
        let [value, limit, margin] = f.figures();
        let _ = writeln!(
            page,
            "| {} | {} | {value} {unit} | {limit} {unit} | {margin} | {verdict} |",
            f.rule,
            inert(&f.subject),
            unit = f.unit
        );
    }
    page.push('\n');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_tubes_are_called_so_where_they_are_cut() {
        let (mut frame, _) = Frame::load("cognifly").expect("a preset");
        assert_eq!(stock_words(&frame), "Rods of 3 mm");
        frame.bought.get_mut("rod").expect("has one").part.wall_mm = Some(0.5);
        assert_eq!(stock_words(&frame), "Tubes of 3 mm with walls of 0.5 mm");
    }
}
