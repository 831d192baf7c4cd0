//! The bill of materials as a value: what to print, what to buy, and how to cut the rods. Every form of it is made from this one.

use std::borrow::Cow;

use rayon::prelude::*;
use serde::Serialize;

use super::cutting::{KERF_MM, Saving, rod_plan, rod_savings};
use super::search_words::{ALL_IN_ONE, search_words};
use super::spares::with_spares;
use super::supplies::{RECEIVER_SEARCH, SMALL_TIE, Supply, supplies};
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::{LineKind, MassLine, MassTable};
use crate::frame::skeleton::RodRole;
use crate::params::Frame;
use crate::params::catalogue::BoughtPart;
use crate::params::frame::NamedMaterial;
use crate::printing::print_time::of_part_s;

/// A printed part.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PrintLine {
    /// Which.
    pub part: &'static str,
    /// How many.
    pub quantity: u32,
    /// Name of its material.
    pub material: String,
    /// Volume of all copies, mm³.
    pub volume_mm3: f64,
    /// Mass of all copies, g.
    pub mass_g: f64,
    /// Time to print all copies, minutes, by [`of_part_s`]; none where the material does not say its speed.
    pub print_min: Option<f64>,
    /// What the filament of one copy costs; none where the material states no price.
    #[serde(rename = "price_each")]
    pub price: Option<f64>,
    /// Currency of the price.
    pub currency: Option<String>,
    /// Where the price of a kilogram comes from.
    pub price_source: Option<String>,
}

/// Something bought.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct BuyLine {
    /// Its role.
    pub role: String,
    /// Its name in the catalogue; none of an extra mass, such as wiring, or of a supply.
    pub name: String,
    /// What it is; `extra` when it stands in no catalogue and weighs, `supply` when it is used up: glue, wires.
    pub kind: String,
    /// How many; of rods, stock lengths.
    pub quantity: u32,
    /// How many to buy, with [spares](super::spares).
    pub with_spares: u32,
    /// What to search for.
    pub search: String,
    /// Length of one, mm, of wires and cables.
    pub length_mm: Option<f64>,
    /// What it is for, and what was assumed.
    pub note: String,
    /// Thread and length under the head of a screw, mm.
    pub screw_mm: Option<[f64; 2]>,
    /// Mass of all, g; none for rods, whose cut pieces weigh.
    pub mass_g: Option<f64>,
    /// How the mass is known, or which line it is counted in; none for rods.
    pub mass_basis: Option<String>,
    /// Price of one, where the catalogue has one; the lowest of several.
    #[serde(rename = "price_each")]
    pub price: Option<f64>,
    /// The highest of several.
    #[serde(rename = "price_most_each")]
    pub price_most: Option<f64>,
    /// When the price was found.
    pub price_date: Option<String>,
    /// Currency of the price.
    pub currency: Option<String>,
    /// Where the price comes from.
    pub price_source: Option<String>,
    /// Where size and mass come from.
    pub source: String,
}

/// Rods of one length.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RodLine {
    /// Which.
    pub rod: String,
    /// How many.
    pub quantity: u32,
    /// Length of one in the model, mm.
    pub length_mm: f64,
    /// What to saw it to, mm; the bores take up the difference.
    pub sawn_mm: f64,
    /// Name of their material.
    pub material: String,
    /// Mass of all, g.
    pub mass_g: f64,
    /// What says so: `computed`, or the extra that weighs them.
    pub mass_basis: String,
}

/// A stock length and what is cut from it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CutLine {
    /// Role and length of each piece, mm.
    pub pieces: Vec<(&'static str, f64)>,
    /// What is left, mm.
    pub rest_mm: f64,
}

/// A bill of materials.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Bill {
    /// Version of this form.
    pub schema_version: u32,
    /// Name of the frame.
    pub frame: String,
    /// What to print.
    pub print: Vec<PrintLine>,
    /// What to buy.
    pub buy: Vec<BuyLine>,
    /// Rods to cut.
    pub rods: Vec<RodLine>,
    /// Length that rods are sold in, mm.
    pub stock_mm: f64,
    /// Width of a saw cut, mm.
    pub kerf_mm: f64,
    /// How to cut the rods.
    pub cut: Vec<CutLine>,
    /// Rods that, a little shorter, save a stock length; the smallest change first.
    pub savings: Vec<Saving>,
    /// Why they cannot be cut from that stock.
    pub cut_error: Option<String>,
    /// Mass of all printed parts, g.
    pub printed_g: f64,
    /// Time to print them, hours, by [`of_part_s`]; nothing where a material does not say its speed.
    pub print_h: Option<f64>,
    /// Sum of what the filament costs where its price is stated, by currency.
    pub filament_prices: Vec<(String, f64)>,
    /// Sum of the prices of what is bought, where there are any, by currency.
    pub prices: Vec<(String, f64)>,
    /// The same of what is bought with spares: currency, at the lowest and at the highest prices.
    pub prices_with_spares: Vec<(String, f64, f64)>,
    /// Lines without a price.
    pub without_price: usize,
}

/// What a frame with a camera for goggles needs and no role has.
const NO_TRANSMITTER: &str =
    "its video transmitter and that one's antenna are in this bill only where the frame's file lists them as extras";

/// The bill of a design.
pub fn bill(design: &Design, masses: &MassTable, kerf_mm: Option<f64>) -> Bill {
    let kerf_mm = kerf_mm.unwrap_or(KERF_MM);
    let print = print_lines(design, masses);
    let (stock_mm, plan) = rod_plan(design, kerf_mm);
    let cut_error = plan.as_ref().err().map(ToString::to_string);
    let stocks = plan.unwrap_or_default();
    let piece = |(role, mm): &(RodRole, f64)| (role.slug(), *mm);
    let cut: Vec<CutLine> =
        stocks.iter().map(|stock| CutLine { pieces: stock.pieces.iter().map(piece).collect(), rest_mm: stock.rest_mm }).collect();
    let mut buy = buy_lines(design, masses, cut.len() as u32);
    buy.extend(extra_lines(design, masses));
    buy.extend(supplies(design).into_iter().map(supply_line));
    let minutes = print.iter().map(|line| line.print_min).sum::<Option<f64>>();
    Bill {
        schema_version: 2,
        frame: design.frame.name.clone(),
        printed_g: print.iter().map(|line| line.mass_g).sum(),
        print_h: minutes.map(|minutes| minutes / 60.0),
        filament_prices: sums(print.iter().map(|line| (line.price, line.quantity, &line.currency))),
        prices: sums(buy.iter().map(|line| (line.price, line.quantity, &line.currency))),
        prices_with_spares: prices_with_spares(&buy),
        without_price: buy.iter().filter(|line| line.price.is_none()).count(),
        print,
        buy,
        rods: rod_lines(design, masses),
        stock_mm,
        kerf_mm,
        cut,
        savings: rod_savings(design, stock_mm, kerf_mm),
        cut_error,
    }
}

fn print_lines(design: &Design, masses: &MassTable) -> Vec<PrintLine> {
    let line = |part: &crate::frame::assembly::Printed| {
        let NamedMaterial { name, material } = design.material_of(part.name);
        let quantity = part.part.quantity();
        let volume_mm3 = part.volume_mm3 * f64::from(quantity);
        let weighed = masses.printed(part.name);
        let mass_g = weighed.map_or(0.0, |line| line.total_g);
        let price = material.cost(mass_g / f64::from(quantity.max(1)));
        PrintLine {
            part: part.name.slug(),
            quantity,
            material: name.clone(),
            volume_mm3,
            mass_g,
            price: price.map(|(price, _)| price),
            currency: price.map(|(_, currency)| currency.into()),
            price_source: material.price_source.clone(),
            print_min: of_part_s(design, part).map(|seconds| seconds * f64::from(quantity) / 60.0),
        }
    };
    design.printed.par_iter().map(line).collect()
}

fn buy_lines(design: &Design, masses: &MassTable, stocks: u32) -> Vec<BuyLine> {
    let line = |(role, item): (&String, &crate::params::frame::BoughtItem)| {
        let part = &item.part;
        let weighed = masses.bought(role);
        let quantity = if role == "rod" { stocks } else { item.quantity };
        let searched = if role == "motor_controller" && design.frame.is_all_in_one() { ALL_IN_ONE } else { role };
        BuyLine {
            role: role.clone(),
            name: item.name.clone(),
            kind: part.kind.clone(),
            quantity,
            with_spares: with_spares(&part.kind, quantity),
            search: search_words(searched, &item.name, &sought(design, role, part)),
            screw_mm: part.thread_mm.zip(part.length_mm).map(|(thread, length)| [thread, length]),
            mass_g: weighed.map(|line| line.total_g),
            mass_basis: weighed.map(|line| line.basis.clone()),
            price: part.price,
            price_most: part.price_most,
            price_date: part.price_date.clone(),
            currency: part.currency.clone(),
            price_source: part.price_source.clone(),
            source: weighed.map_or_else(|| part.source.clone(), |line| line.source(&part.source)),
            note: bought_note(&design.frame, role),
            ..BuyLine::default()
        }
    };
    let mut lines: Vec<BuyLine> = design.frame.bought.iter().map(line).collect();
    // Screws last, by thread and length.
    let screw = |line: &BuyLine| line.screw_mm.unwrap_or([-1.0, -1.0]);
    lines.sort_by(|a, b| screw(a)[0].total_cmp(&screw(b)[0]).then(screw(a)[1].total_cmp(&screw(b)[1])).then_with(|| a.role.cmp(&b.role)));
    lines
}

/// What is looked for: a battery that is as large as the frame has room for, where its file states more than the catalogue.
fn sought<'a>(design: &Design, role: &str, part: &'a BoughtPart) -> Cow<'a, BoughtPart> {
    let mut part = Cow::Borrowed(part);
    if let (true, Some(lies_mm)) = (role == "battery", design.frame.battery_as_it_lies_mm()) {
        let b = &design.frame.battery;
        let room_mm = [b.battery_length_mm, b.battery_width_mm, b.battery_height_mm];
        let size_mm = [0, 1, 2].map(|axis| room_mm[axis].max(lies_mm[axis]));
        part.to_mut().size_mm = size_mm;
    }
    part
}

/// What weighs and has to be had, but stands in no catalogue.
fn extra_lines(design: &Design, masses: &MassTable) -> Vec<BuyLine> {
    let is_thing = |name: &str| design.frame.built_in_things().any(|(thing, _)| thing == name);
    let line = |line: &MassLine| BuyLine {
        role: line.name.clone(),
        kind: "extra".into(),
        quantity: line.quantity,
        with_spares: line.quantity,
        search: match &*line.name {
            "receiver" => RECEIVER_SEARCH.into(),
            name if is_thing(name) => name.replace('_', " "),
            _ => String::new(),
        },
        note: extra_note(&line.name, is_thing(&line.name)).into(),
        mass_g: Some(line.total_g),
        mass_basis: Some(line.basis.clone()),
        source: design.frame.extras.get(&line.name).map_or(String::new(), |extra| extra.source.clone()),
        ..BuyLine::default()
    };
    masses.lines.iter().filter(|line| line.kind == LineKind::Extra).map(line).collect()
}

/// What a search for a part does not say.
fn bought_note(frame: &Frame, role: &str) -> String {
    let part = |role: &str| frame.bought.get(role).map(|item| &item.part);
    match role {
        "fpv_camera" if part(role).is_some_and(|camera| camera.digital == Some(true)) => {
            format!("{NO_TRANSMITTER}; it has to be of the camera's maker, as the ribbon between the two")
        }
        "fpv_camera" => NO_TRANSMITTER.into(),
        "propeller" => {
            let shaft_mm = part("motor").and_then(|motor| motor.shaft_diameter_mm);
            let bore = shaft_mm.map_or(String::new(), |mm| format!(", for a shaft of {mm} mm, or with the motor's own fixing"));
            format!("half of them clockwise, half counter-clockwise{bore}")
        }
        _ => String::new(),
    }
}

/// What an extra is to the buyer: a receiver, another thing, or a mass of several things.
fn extra_note(name: &str, is_thing: bool) -> &'static str {
    match name {
        "receiver" => "of your transmitter's protocol; its mass is the frame file's",
        _ if is_thing => "bought or made by what the frame's file says of it; its mass is the file's",
        _ => "a mass; what of it is bought has lines of its own where it is known",
    }
}

/// What is used up: it weighs nothing here, as extras such as wiring and the printed parts hold its mass.
fn supply_line(Supply { role, quantity, length_mm, search, note }: Supply) -> BuyLine {
    let with_spares = if role == SMALL_TIE { with_spares("other", quantity) } else { quantity };
    BuyLine { role, kind: "supply".into(), quantity, with_spares, length_mm, search, note, ..BuyLine::default() }
}

fn rod_lines(design: &Design, masses: &MassTable) -> Vec<RodLine> {
    let line = |line: &MassLine| {
        let role = RodRole::ALL.into_iter().find(|role| line.name == format!("{}_rod", role.slug()))?;
        Some(RodLine {
            rod: line.name.clone(),
            quantity: line.quantity,
            length_mm: design.skeleton.length_mm(role),
            sawn_mm: design.skeleton.sawn_mm(role),
            material: line.material.clone(),
            mass_g: line.total_g,
            mass_basis: line.basis.clone(),
        })
    };
    masses.lines.iter().filter(|line| line.kind == LineKind::Rod).filter_map(line).collect()
}

/// Sums of priced lines by currency, in the order in which the currencies come.
fn sums<'a>(lines: impl Iterator<Item = (Option<f64>, u32, &'a Option<String>)>) -> Vec<(String, f64)> {
    let mut sums: Vec<(String, f64)> = Vec::new();
    for (price, quantity, currency) in lines {
        let (Some(price), Some(currency)) = (price, currency) else { continue };
        let all = price * f64::from(quantity);
        match sums.iter_mut().find(|(known, _)| known == currency) {
            Some((_, sum)) => *sum += all,
            None => sums.push((currency.clone(), all)),
        }
    }
    sums
}

/// Sums of what is bought with spares: currency, at the lowest and at the highest prices.
fn prices_with_spares(buy: &[BuyLine]) -> Vec<(String, f64, f64)> {
    let mut sums: Vec<(String, f64, f64)> = Vec::new();
    for line in buy {
        let (Some(price), Some(currency)) = (line.price, &line.currency) else { continue };
        let [least, most] = [price, line.price_most.unwrap_or(price)].map(|one| one * f64::from(line.with_spares));
        match sums.iter_mut().find(|(known, ..)| known == currency) {
            Some((_, low, high)) => (*low, *high) = (*low + least, *high + most),
            None => sums.push((currency.clone(), least, most)),
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::assembly::mass;
    use crate::params::Frame;

    /// A transmitter and what stands for a part are bought; wires have lines of their own, and what weighs other parts is nothing.
    #[test]
    fn planted_extras_are_bought_where_they_are_things() {
        let extra = |name: &str, covers: &str| {
            format!("[extras.{name}]\nmass_g = 4.0\nmass_basis = \"estimate\"\nsource = \"a guess\"\ncovers = [{covers}]\n")
        };
        let extras = [extra("video_transmitter", ""), extra("straps", "\"tie\""), extra("weighed", "\"battery\"")].concat();
        let text = format!("base = \"cognifly\"\n[bought]\ntie = \"none\"\n{extras}");
        let file = crate::params::FrameFile::parse("own.toml", &text).expect("reads");
        let design = Design::new(Frame::resolve(&file).expect("resolves")).expect("closes");
        let lines = extra_lines(&design, &mass::table(&design));
        let of =
            |role: &str| lines.iter().find(|line| line.role == role).map(|line| (&*line.search, line.note.starts_with("bought or made")));
        assert_eq!(of("video_transmitter"), Some(("video transmitter", true)));
        assert_eq!(of("straps"), Some(("straps", true)));
        assert_eq!((of("weighed"), of("wiring")), (Some(("", false)), Some(("", false))));
    }

    #[test]
    fn analytic_the_battery_to_look_for_is_as_large_as_its_sleeve() {
        let words_of = |width_mm: f64, height_mm: f64| {
            let (mut frame, _) = Frame::load("cognifly").expect("a preset");
            (frame.battery.battery_width_mm, frame.battery.battery_height_mm) = (width_mm, height_mm);
            let design = Design::new(frame).expect("closes");
            let battery = buy_lines(&design, &mass::table(&design), 1).into_iter().find(|line| line.role == "battery");
            battery.expect("has one").search
        };
        let words = |height_mm: f64| words_of(31.0, height_mm);
        assert!(words_of(17.0, 32.0).ends_with("at most 58 x 17 x 32 mm"), "a pack on its side");
        assert!(words(17.0).ends_with("at most 58 x 31 x 17 mm"));
        assert!(words(12.0).ends_with("at most 58 x 31 x 16 mm"), "a rule says that it does not fit");
    }
}
