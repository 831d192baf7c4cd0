//! What the entry of a bought part states and cannot be: figures that are each allowed, but do not go together.

use super::catalogue::BoughtPart;
use crate::figures::decimals;

/// Least mean density of a part's box that is not taken for a mass in kilograms, g/cm³: propellers, the lightest for their box, have 0.03.
const LEAST_G_CM3: f64 = 0.01;

/// How far two figures of one size may be apart, mm: as sizes are rounded in data sheets.
const ROUNDED_MM: f64 = 0.1;
/// Most that a motor's box is wider than what turns, in diameters: the arms of a base that stand out of it.
const BASE_OVER_BODY: f64 = 1.5;
/// Most height of a motor's box over the motor's: the shaft above the face that carries the propeller is as long as the motor at the most.
const SHAFT_OVER_HEIGHT: f64 = 3.0;
/// How far the diameter of a propeller may be from the length of its box, as a share: nominal inches are not exact.
const NOMINAL: f64 = 0.05;
/// Least width of a round or six-sided head over the circle around it: 0.87 of a hexagon.
const FLATS_OVER_CORNERS: f64 = 0.8;
/// Mean voltage of a lithium cell, V.
const CELL_V: f64 = 3.7;
/// Energy over mass of batteries that are sold, Wh/kg: packs with protection and a case of their own have 60, those of the catalogue 120 to
/// 220, the best cells 350. Beyond, a figure is in another unit or lacks a digit.
const WH_KG: [f64; 2] = [25.0, 450.0];

/// A key of an entry, and what is wrong with it.
type Contradiction = (&'static str, String);

/// A length of an entry, and what others of its lengths allow.
struct Length {
    key: &'static str,
    stated_mm: Option<f64>,
    /// Lowest and highest value that goes with the others.
    allowed_mm: [f64; 2],
    /// The other key.
    with: &'static str,
    why: &'static str,
}

impl Length {
    fn contradiction(&self) -> Option<Contradiction> {
        let Self { key, with, why, allowed_mm: [least, most], .. } = *self;
        let stated = self.stated_mm.filter(|mm| !(least..=most).contains(mm))?;
        let range = match least > 0.0 {
            true => format!("{} to {}", decimals(least, 2), decimals(most, 2)),
            false => format!("at most {}", decimals(most, 2)),
        };
        Some((key, format!("`{key}` = {stated} does not go with `{with}`: {why}, {range} mm")))
    }
}

impl BoughtPart {
    /// What is stated of it and cannot be, with the key to change.
    pub fn contradiction(&self) -> Option<(&'static str, String)> {
        self.too_light()
            .or_else(|| self.lengths().iter().find_map(Length::contradiction))
            .or_else(|| self.holes_outside())
            .or_else(|| self.price())
            .or_else(|| self.energy())
            .or_else(|| self.tube())
    }

    fn too_light(&self) -> Option<Contradiction> {
        let [length, width, height] = self.size_mm;
        let g_cm3 = self.mass_g / (1e-3 * length * width * height);
        (g_cm3 > 0.0 && g_cm3 < LEAST_G_CM3).then(|| {
            let message = format!(
                "`mass_g`: {} g in {length} x {width} x {height} mm are {g_cm3:.2e} g/cm³, less than any part has: state it in grams",
                self.mass_g
            );
            ("mass_g", message)
        })
    }

    /// Lengths that have to go with the box around the part, or with each other.
    fn lengths(&self) -> Vec<Length> {
        match self.kind.as_str() {
            "motor" => self.motor_lengths().into(),
            "propeller" => self.propeller_lengths().into(),
            "rod" => vec![self.rod_diameter()],
            "screw" => self.screw_lengths().into(),
            "board" => {
                vec![self.within_height("board_thickness_mm", self.board_thickness_mm, "a circuit board is no higher than all of it")]
            }
            "sensor" => vec![Length {
                key: "hole_pitch_mm",
                stated_mm: self.hole_pitch_mm,
                allowed_mm: [0.0, self.across_mm()[1]],
                with: "size_mm",
                why: "its holes are within its length",
            }],
            _ => Vec::new(),
        }
    }

    /// The less and the more of its first two sizes, mm.
    fn across_mm(&self) -> [f64; 2] {
        let [x, y, _] = self.size_mm;
        [x.min(y), x.max(y)]
    }

    /// A length that is no more than the height of the box.
    fn within_height(&self, key: &'static str, stated_mm: Option<f64>, why: &'static str) -> Length {
        Length { key, stated_mm, allowed_mm: [0.0, self.size_mm[2] + ROUNDED_MM], with: "size_mm", why }
    }

    fn motor_lengths(&self) -> [Length; 4] {
        let ([narrow, wide], high) = (self.across_mm(), self.size_mm[2]);
        let hole_mm = self.hole_diameter_mm.unwrap_or(0.0);
        [
            Length {
                key: "body_diameter_mm",
                stated_mm: self.body_diameter_mm,
                allowed_mm: [wide / BASE_OVER_BODY, narrow + ROUNDED_MM],
                with: "size_mm",
                why: "what turns is within the box around the motor, and makes most of its width",
            },
            Length {
                key: "height_mm",
                stated_mm: self.height_mm,
                allowed_mm: [high / SHAFT_OVER_HEIGHT, high + ROUNDED_MM],
                with: "size_mm",
                why: "the box has the height of the motor, and what of the shaft is above it",
            },
            Length {
                key: "hole_pcd_mm",
                stated_mm: self.hole_pcd_mm,
                allowed_mm: [0.0, wide - hole_mm + ROUNDED_MM],
                with: "size_mm",
                why: "the screw holes are within the motor's base",
            },
            Length {
                key: "shaft_diameter_mm",
                stated_mm: self.shaft_diameter_mm,
                allowed_mm: [0.0, 0.5 * narrow],
                with: "size_mm",
                why: "a shaft is less than half as wide as its motor",
            },
        ]
    }

    fn propeller_lengths(&self) -> [Length; 2] {
        let [_, wide] = self.across_mm();
        [
            Length {
                key: "diameter_mm",
                stated_mm: self.diameter_mm,
                allowed_mm: [(1.0 - NOMINAL) * wide, (1.0 + NOMINAL) * wide],
                with: "size_mm",
                why: "the box around a propeller is as long as the disc of its tips is wide",
            },
            self.within_height("hub_height_mm", self.hub_height_mm, "the hub is within the box around the propeller"),
        ]
    }

    fn rod_diameter(&self) -> Length {
        let [_, y, z] = self.size_mm;
        Length {
            key: "diameter_mm",
            stated_mm: self.diameter_mm,
            allowed_mm: [y.max(z) - ROUNDED_MM, y.min(z) + ROUNDED_MM],
            with: "size_mm",
            why: "the box around a rod is as wide and as high as the rod",
        }
    }

    fn screw_lengths(&self) -> [Length; 4] {
        let [_, wide] = self.across_mm();
        [
            Length {
                key: "head_diameter_mm",
                stated_mm: self.head_diameter_mm,
                allowed_mm: [FLATS_OVER_CORNERS * wide, wide + ROUNDED_MM],
                with: "size_mm",
                why: "the box around a screw is as wide as its head",
            },
            Length {
                key: "thread_mm",
                stated_mm: self.thread_mm,
                allowed_mm: [0.0, self.head_diameter_mm.unwrap_or(wide)],
                with: "head_diameter_mm",
                why: "the head is wider than the thread",
            },
            self.within_height("length_mm", self.length_mm, "the thread is within the box around the screw"),
            self.within_height("head_height_mm", self.head_height_mm, "the head is within the box around the screw"),
        ]
    }

    /// A camera's pattern is stated as it hangs, a board's as it lies: both beside the first two sizes.
    fn holes_outside(&self) -> Option<Contradiction> {
        let ([length, width, _], [along, across]) = (self.size_mm, self.hole_pattern_mm?);
        (along >= length || across >= width).then(|| {
            let message = format!("`hole_pattern_mm`: holes {along} x {across} mm apart lie outside of {length} x {width} mm");
            ("hole_pattern_mm", message)
        })
    }

    fn price(&self) -> Option<Contradiction> {
        if let (Some(price), Some(most)) = (self.price, self.price_most)
            && most < price
        {
            return Some(("price_most", format!("`price_most` = {most} is less than `price` = {price}, the lowest")));
        }
        self.price_date
            .as_ref()
            .filter(|date| !is_date(date))
            .map(|_| ("price_date", "`price_date` is no date: write the year, the month and the day, such as 2026-11-23".into()))
    }

    /// Cells, capacity and mass of a battery; one without a mass is weighed with something else.
    fn energy(&self) -> Option<Contradiction> {
        let (cells, capacity_mah) = (self.cells?, self.capacity_mah?);
        let wh_kg = f64::from(cells) * CELL_V * capacity_mah / self.mass_g;
        let [least, most] = WH_KG;
        (self.mass_g > 0.0 && !(least..=most).contains(&wh_kg)).then(|| {
            let message = format!(
                "`capacity_mah` = {capacity_mah} does not go with `cells` and `mass_g`: {cells} lithium cells of {capacity_mah} mAh in {} g have \
                 {} Wh/kg, batteries have {least} to {most}",
                self.mass_g,
                decimals(wh_kg, 0)
            );
            ("capacity_mah", message)
        })
    }

    fn tube(&self) -> Option<Contradiction> {
        let (wall, diameter) = (self.wall_mm?, self.diameter_mm?);
        (2.0 * wall >= diameter)
            .then(|| ("wall_mm", format!("`wall_mm`: a tube of {diameter} mm has no wall of {wall} mm; a solid rod states none")))
    }
}

/// Whether a text is a year, a month of a year, or a day.
fn is_date(text: &str) -> bool {
    let parts: Vec<&str> = text.split('-').collect();
    let number = |part: &str, digits: usize, range: std::ops::RangeInclusive<u32>| {
        part.len() == digits && part.bytes().all(|byte| byte.is_ascii_digit()) && part.parse().is_ok_and(|number| range.contains(&number))
    };
    match parts[..] {
        [year] => number(year, 4, 1900..=9999),
        [year, month] => number(year, 4, 1900..=9999) && number(month, 2, 1..=12),
        [year, month, day] => number(year, 4, 1900..=9999) && number(month, 2, 1..=12) && number(day, 2, 1..=31),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::preset;

    /// An entry of the shipped catalogue with figures changed.
    fn entry(name: &str, changed: &[(&str, toml::Value)]) -> BoughtPart {
        let shipped: toml::Table = toml::from_str(preset::BOUGHT).expect("reads");
        let mut entry = shipped["parts"][name].as_table().expect("a table").clone();
        entry.extend(changed.iter().map(|(key, value)| (key.to_string(), value.clone())));
        entry.try_into().expect("reads")
    }

    #[test]
    fn analytic_shipped_parts_contradict_nothing() {
        let shipped: toml::Table = toml::from_str(preset::BOUGHT).expect("reads");
        for name in shipped["parts"].as_table().expect("a table").keys() {
            assert_eq!(entry(name, &[]).contradiction(), None, "{name}");
        }
    }

    #[test]
    fn planted_figures_of_one_part_that_do_not_go_together() {
        for (name, key, value) in [
            ("motor-1104", "body_diameter_mm", 30.0),
            ("motor-1104", "body_diameter_mm", 1.4),
            ("motor-1104", "height_mm", 14.0),
            ("motor-1104", "height_mm", 1.08),
            ("motor-1104", "hole_pcd_mm", 16.0),
            ("motor-1104", "shaft_diameter_mm", 15.0),
            ("propeller-3-inch", "diameter_mm", 101.6),
            ("propeller-3-inch", "hub_height_mm", 50.0),
            ("rod-carbon-3", "diameter_mm", 4.0),
            ("screw-m2x4", "head_diameter_mm", 5.5),
            ("screw-m2x4", "thread_mm", 4.0),
            ("screw-m2x4", "length_mm", 40.0),
            ("screw-m2x4", "head_height_mm", 20.0),
            ("matek-3901-l0x", "hole_pitch_mm", 305.0),
            ("pi-zero-w", "board_thickness_mm", 14.0),
            ("battery-3s-650", "capacity_mah", 6500.0),
            ("battery-3s-650", "capacity_mah", 65.0),
            ("battery-3s-650", "mass_g", 5.8),
            ("rod-carbon-3", "wall_mm", 1.5),
        ] {
            let found = entry(name, &[(key, value.into())]).contradiction();
            let told =
                found.as_ref().is_some_and(|(at, message)| message.contains(&format!("`{key}`")) && message.contains(&format!("`{at}`")));
            assert!(told, "{name} with {key} = {value}: {found:?}");
        }
    }

    #[test]
    fn analytic_a_shaft_above_the_motor_and_a_battery_that_is_weighed_elsewhere_go_together() {
        let size = |size_mm: [f64; 3]| toml::Value::Array(size_mm.into_iter().map(Into::into).collect());
        assert_eq!(entry("motor-1104", &[("size_mm", size([14.0, 14.0, 20.0]))]).contradiction(), None);
        assert_eq!(entry("motor-1104", &[("shaft_hole_diameter_mm", 0.0.into())]).contradiction(), None);
        assert_eq!(entry("battery-3s-650", &[("mass_g", 0.0.into())]).contradiction(), None);
        let (key, message) = entry("motor-1104", &[("size_mm", size([30.0, 30.0, 10.8]))]).contradiction().expect("contradicts");
        let said = "`body_diameter_mm` = 14 does not go with `size_mm`: what turns is within the box around the motor, and makes most of its \
                    width, 20.00 to 30.10 mm";
        assert_eq!((key, message.as_str()), ("body_diameter_mm", said));
    }

    #[test]
    fn analytic_dates_of_prices() {
        for date in ["1900", "2026-01", "2026-12", "2026-11-01", "2026-11-31"] {
            assert!(is_date(date), "{date}");
        }
        for date in
            ["1899", "26", "2026-00", "2026-13", "2026-1", "2026-11-00", "2026-11-32", "2026-11-1", "2026-13-01", "+202", "2026-11-23-1"]
        {
            assert!(!is_date(date), "{date}");
        }
    }
}
