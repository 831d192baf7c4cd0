//! Every printed part with its masses, and what they make of the whole.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use super::print_factor::{PrintFactor, Ratio};
use crate::frame::assembly::mass::MassTable;
use crate::frame::assembly::{Design, Printed};
use crate::params::PartName;
use crate::params::refusal::nearest;

/// Weighed over solid mass that a print can have: foamed filament and a quarter more than full.
const BELIEVED: RangeInclusive<f64> = 0.3..=1.25;

/// A reading of a scale.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// What lay on the scale, in the user's words.
    pub part: String,
    /// How many.
    pub quantity: u32,
    /// Mass of all, g.
    pub mass_g: f64,
    /// The scale's last digit, g.
    pub resolution_g: f64,
}

/// A reading that cannot be of this frame.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Misread {
    /// No printed part is called so.
    #[error("there is no printed part `{part}`{}; the parts are {}", meant(.nearest), slugs(&PartName::ALL))]
    Unknown {
        /// What was read.
        part: String,
        /// Names like it.
        nearest: Vec<String>,
    },
    /// The frame has no such part.
    #[error("the frame has no `{}`; its parts are {}", .part.slug(), slugs(.there))]
    Absent {
        /// What was read.
        part: PartName,
        /// The frame's printed parts.
        there: Vec<PartName>,
    },
    /// Too light or too heavy for what it is called.
    #[error("{quantity} x `{part}` weigh {mass_g} g, {ratio:.2} times the {solid_g:.2} g that they would weigh solid; a print has {} to {} times that: is it another part, another number of them, or are rods or support weighed with it?", BELIEVED.start(), BELIEVED.end())]
    Unbelieved {
        /// What was read.
        part: String,
        /// How many.
        quantity: u32,
        /// On the scale, g.
        mass_g: f64,
        /// Volume times density, g.
        solid_g: f64,
        /// One over the other.
        ratio: f64,
    },
}

fn meant(nearest: &[String]) -> String {
    nearest.first().map_or(String::new(), |name| format!(", did you mean `{name}`?"))
}

fn slugs(parts: &[PartName]) -> String {
    parts.iter().map(|part| part.slug()).collect::<Vec<_>>().join(", ")
}

/// What a slicer fills a part with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sliced {
    /// Mass of the filament, g.
    pub mass_g: f64,
    /// The same with infill that ends at the walls instead of reaching over them, g, where that was asked for.
    pub without_overlap_g: Option<f64>,
}

/// A part's masses; each of one.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The part.
    pub part: PartName,
    /// Its material.
    pub material: String,
    /// How many the frame has.
    pub quantity: u32,
    /// Volume times density, g.
    pub solid_g: f64,
    /// What the frame's mass counts: solid times the print factor that the frame has, g.
    pub counted_g: f64,
    /// What a slicer fills it with.
    pub sliced: Option<Sliced>,
    /// On the scale, mean of all that were weighed, g.
    pub weighed_g: Option<f64>,
}

/// A material's print factor, before and after.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// The material.
    pub material: String,
    /// What the frame has.
    pub before: f64,
    /// What the scale asks for; `None` when nothing of it was weighed.
    pub after: Option<PrintFactor>,
    /// Mass of all its parts in the frame if they were solid, g.
    pub solid_g: f64,
}

/// The table.
#[derive(Clone, Debug, PartialEq)]
pub struct Weighing {
    /// Part by part.
    pub rows: Vec<Row>,
    /// Material by material.
    pub fitted: Vec<Fitted>,
    /// The whole frame as its mass is counted now, g.
    pub before_g: f64,
    /// The limit, g.
    pub limit_g: f64,
}

impl Weighing {
    /// Sorts readings and slices to the parts of a design.
    ///
    /// # Errors
    /// The first reading that cannot be of this frame, with its place in the list.
    pub fn new(
        design: &Design,
        masses: &MassTable,
        readings: &[Reading],
        sliced: &BTreeMap<PartName, Sliced>,
    ) -> Result<Self, (usize, Misread)> {
        let mut rows: Vec<Row> = design.printed.iter().map(|part| row(design, part, sliced)).collect();
        let mut of_parts: BTreeMap<PartName, Vec<Ratio>> = BTreeMap::new();
        for (at, reading) in readings.iter().enumerate() {
            let (part, ratio) = placed(&rows, reading).map_err(|misread| (at, misread))?;
            of_parts.entry(part).or_default().push(ratio);
        }
        let ratios: BTreeMap<PartName, Ratio> = of_parts.into_iter().map(|(part, of)| (part, Ratio::joined(&of))).collect();
        for row in &mut rows {
            row.weighed_g = ratios.get(&row.part).map(|ratio| row.solid_g * ratio.value());
        }
        let fitted = [&design.frame.flexible, &design.frame.rigid].map(|material| {
            let of = || rows.iter().filter(|row| row.material == material.name);
            let weighed: Vec<Ratio> = of().filter_map(|row| ratios.get(&row.part)).copied().collect();
            let solid_g = of().map(|row| f64::from(row.quantity) * row.solid_g).sum();
            Fitted { material: material.name.clone(), before: material.material.print_factor, after: PrintFactor::fit(&weighed), solid_g }
        });
        let mut fitted = Vec::from(fitted);
        fitted.dedup_by(|a, b| a.material == b.material);
        Ok(Self { rows, fitted, before_g: masses.total_g, limit_g: design.frame.limits.mass_budget_g })
    }

    /// Mass of the whole frame with the fitted factors, g, and half of its 95 % interval where every fitted factor has one.
    /// The factors of the materials are independent of each other.
    pub fn after_g(&self) -> (f64, Option<f64>) {
        let mut total_g = self.before_g;
        let mut square = Some(0.0);
        for Fitted { before, after, solid_g, .. } in &self.fitted {
            let Some(after) = after else { continue };
            total_g += (after.value - before) * solid_g;
            square = square.zip(after.interval).map(|(sum, [low, high])| sum + (0.5 * (high - low) * solid_g).powi(2));
        }
        (total_g, square.map(f64::sqrt))
    }

    /// Whether anything was weighed.
    pub fn is_weighed(&self) -> bool {
        self.fitted.iter().any(|fitted| fitted.after.is_some())
    }
}

fn row(design: &Design, part: &Printed, sliced: &BTreeMap<PartName, Sliced>) -> Row {
    let material = design.material_of(part.name);
    let solid_g = material.material.solid_g(part.volume_mm3);
    Row {
        part: part.name,
        material: material.name.clone(),
        quantity: part.part.quantity(),
        solid_g,
        counted_g: solid_g * material.material.print_factor,
        sliced: sliced.get(&part.name).copied(),
        weighed_g: None,
    }
}

/// The part that a reading is of, and its ratio. Blanks and hyphens in a name are as good as the underscore.
fn placed(rows: &[Row], reading: &Reading) -> Result<(PartName, Ratio), Misread> {
    let Reading { part, quantity, mass_g, resolution_g } = reading;
    let slug = part.to_ascii_lowercase().replace([' ', '-'], "_");
    let Some(row) = rows.iter().find(|row| row.part.slug() == slug) else {
        if let Some(part) = PartName::ALL.into_iter().find(|part| part.slug() == slug) {
            return Err(Misread::Absent { part, there: rows.iter().map(|row| row.part).collect() });
        }
        return Err(Misread::Unknown { part: part.clone(), nearest: nearest(&slug, PartName::ALL.iter().map(|part| part.slug())) });
    };
    let solid_g = f64::from(*quantity) * row.solid_g;
    let ratio = Ratio { weighed_g: *mass_g, solid_g, resolution_g: *resolution_g };
    if !BELIEVED.contains(&ratio.value()) {
        let (part, quantity, mass_g) = (part.clone(), *quantity, *mass_g);
        return Err(Misread::Unbelieved { part, quantity, mass_g, solid_g, ratio: ratio.value() });
    }
    Ok((row.part, ratio))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::assembly::mass;
    use crate::params::{Frame, FrameFile};

    fn design() -> Design {
        let file = FrameFile::load("cognifly").expect("is a preset");
        Design::new(Frame::resolve(&file).expect("resolves")).expect("is designed")
    }

    fn reading(part: &str, quantity: u32, mass_g: f64) -> Reading {
        Reading { part: part.into(), quantity, mass_g, resolution_g: 0.01 }
    }

    #[test]
    fn planted_factors_come_back_and_the_whole_follows_them() {
        let design = design();
        let masses = mass::table(&design);
        let plain = Weighing::new(&design, &masses, &[], &BTreeMap::new()).expect("holds");
        assert!(!plain.is_weighed() && plain.after_g() == (masses.total_g, Some(0.0)));
        let planted = |row: &Row| if row.material == design.frame.flexible.name { 0.9 } else { 0.95 };
        let readings: Vec<Reading> = plain
            .rows
            .iter()
            .map(|row| reading(&row.part.slug().replace('_', " "), 2, (200.0 * planted(row) * row.solid_g).round() / 100.0))
            .collect();
        let found = Weighing::new(&design, &masses, &readings, &BTreeMap::new()).expect("holds");
        for Fitted { material, after, .. } in &found.fitted {
            let after = after.expect("is fitted");
            let wanted = if *material == design.frame.flexible.name { 0.9 } else { 0.95 };
            assert!(
                (after.value - wanted).abs() < 2e-3 && after.interval.is_some_and(|[low, high]| low < wanted && wanted < high),
                "{after:?}"
            );
        }
        let printed =
            |factor: &dyn Fn(&Row) -> f64| found.rows.iter().map(|row| f64::from(row.quantity) * row.solid_g * factor(row)).sum::<f64>();
        let factor_of = |row: &Row| row.counted_g / row.solid_g;
        let wanted_g = masses.total_g - printed(&factor_of) + printed(&planted);
        let (after_g, half_g) = found.after_g();
        assert!((after_g - wanted_g).abs() < 0.1 && half_g.is_some_and(|half| half > 0.0 && half < 0.2), "{after_g} {wanted_g} {half_g:?}");
    }

    /// Weighed four times, one part is still one part: it tells its mean, and nothing of other parts.
    #[test]
    fn planted_one_part_weighed_again_says_nothing_about_scatter() {
        let design = design();
        let masses = mass::table(&design);
        let again = [reading("hub", 1, 9.80), reading("hub", 1, 9.81), reading("hub", 2, 19.62), reading("hub", 1, 9.80)];
        let found = Weighing::new(&design, &masses, &again, &BTreeMap::new()).expect("holds");
        let after = found.fitted[1].after.expect("is fitted");
        assert!(after.interval.is_none() && after.parts == 1 && found.after_g().1.is_none(), "{after:?}");
        let hub = found.rows.iter().find(|row| row.part == PartName::Hub).expect("has one");
        assert!(hub.weighed_g.is_some_and(|weighed_g| (weighed_g - 49.03 / 5.0).abs() < 1e-9), "{hub:?}");
    }

    #[test]
    fn analytic_readings_of_something_else_are_refused() {
        let design = design();
        let masses = mass::table(&design);
        let refused = |reading| Weighing::new(&design, &masses, &[reading], &BTreeMap::new()).expect_err("is refused");
        assert!(matches!(refused(reading("top_conrer", 1, 2.0)), (0, Misread::Unknown { nearest, .. }) if nearest[0] == "top_corner"));
        let absent = refused(reading("accessory_plate", 1, 2.0));
        assert!(matches!(absent, (0, Misread::Absent { part: PartName::AccessoryPlate, .. })));
        assert!(!absent.1.to_string().contains("did you mean"), "{}", absent.1);
        assert!(matches!(refused(reading("hub", 1, 150.0)), (0, Misread::Unbelieved { .. })));
        assert!(matches!(refused(reading("hub", 40, 7.0)), (0, Misread::Unbelieved { .. })));
    }
}
