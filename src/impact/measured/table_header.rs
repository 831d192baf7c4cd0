//! The first line of a table of drops: where each quantity stands.

use super::malformed::Fault;
use super::table_format::{Quantity, TableFormat};

/// Every column that such a table can have, in words.
const KNOWN: &str = "trial,height_m,t_s,accel_g, and x,y,z if they are there, of which z can stand for accel_g; --columns gives them other \
                     names; a file in a folder named as soft_050cm is a drop of its own, and needs neither trial nor height_m";

/// A column's place in a row, and the sign of its values.
pub(super) type Place = (usize, f64);

/// Where the quantities stand.
pub(super) struct Header {
    pub trial: Option<usize>,
    pub session: Option<usize>,
    pub height: Option<usize>,
    pub speed: Option<usize>,
    pub time: Option<usize>,
    /// Time stamps that are not used, as a sampling rate is given.
    pub unused_time: Option<usize>,
    pub axial: Place,
    /// x, y, z.
    pub axes: [Option<Place>; 3],
    /// Further columns that are kept, and where they stand.
    pub kept: Vec<(String, usize)>,
    /// Columns that hold none of them.
    pub others: Vec<String>,
}

impl Header {
    /// Reads the names. `labelled`: the file's own place says trial and height where the table does not.
    ///
    /// # Errors
    /// When a column lacks that is needed or named, when one stands there twice, or the names are no text.
    pub fn of(record: &csv::ByteRecord, format: &TableFormat, labelled: bool) -> Result<Self, Fault> {
        let names: Vec<String> = record.iter().map(|name| String::from_utf8_lossy(name).trim().trim_matches('"').to_string()).collect();
        let wanted = Quantity::ALL.map(|(quantity, ..)| format.name(quantity).0);
        if let Some(twice) = wanted.iter().find(|wanted| names.iter().filter(|name| name == *wanted).count() > 1) {
            return Err(Fault::TwoColumns { name: (*twice).into() });
        }
        let place = |quantity: Quantity| names.iter().position(|name| name == format.name(quantity).0);
        let signed = |quantity: Quantity| Some((place(quantity)?, if format.name(quantity).1 { -1.0 } else { 1.0 }));
        let is_named = |quantity: Quantity| format.columns.iter().any(|column| column.quantity == quantity);
        let speed = place(Quantity::Speed);
        // Whoever names the column of speeds means them.
        let height = place(Quantity::Height).filter(|_| speed.is_none() || !is_named(Quantity::Speed));
        let axial = signed(Quantity::Axial).or_else(|| signed(Quantity::Z));
        let needed = [
            (&[Quantity::Trial][..], place(Quantity::Trial).is_some() || labelled),
            (&[Quantity::Height, Quantity::Speed], height.is_some() || speed.is_some() || labelled),
            (&[Quantity::Time], place(Quantity::Time).is_some() || format.rate_hz.is_some()),
            (&[Quantity::Axial, Quantity::Z], axial.is_some()),
        ];
        let mut missing: Vec<String> = needed.iter().filter(|(_, there)| !there).map(|(any, _)| in_words(any, format)).collect();
        for column in format.columns.iter().filter(|column| !names.contains(&column.name)) {
            let named = format!("`{}`", column.name);
            if !missing.iter().any(|lacks| lacks.contains(&named)) {
                missing.push(named);
            }
        }
        let Some(axial) = axial.filter(|_| missing.is_empty()) else { return Err(lacking(missing, names, record)) };
        let kept: Vec<(String, usize)> =
            names.iter().enumerate().filter(|(_, name)| format.kept.contains(name)).map(|(at, name)| (name.clone(), at)).collect();
        // A comma at the end of each line makes a column without a name.
        let is_used = |name: &str| wanted.contains(&name) && (height.is_some() || name != format.name(Quantity::Height).0);
        let left_aside = |name: &&String| !name.is_empty() && !is_used(name) && !format.kept.contains(name);
        let others = names.iter().filter(left_aside).cloned().collect();
        Ok(Self {
            trial: place(Quantity::Trial),
            session: place(Quantity::Session),
            height,
            speed,
            time: place(Quantity::Time).filter(|_| format.rate_hz.is_none()),
            unused_time: place(Quantity::Time).filter(|_| format.rate_hz.is_some()),
            axial,
            axes: [Quantity::X, Quantity::Y, Quantity::Z].map(signed),
            kept,
            others,
        })
    }
}

/// Columns of which a table needs one: those that `--columns` names, or all.
fn in_words(any: &[Quantity], format: &TableFormat) -> String {
    let is_named = |quantity: &&Quantity| format.columns.iter().any(|column| column.quantity == **quantity);
    let ticked = |quantity: &Quantity| format!("`{}`", format.name(*quantity).0);
    let named: Vec<String> = any.iter().filter(is_named).map(ticked).collect();
    if named.is_empty() { any.iter().map(ticked).collect::<Vec<_>>().join(" or ") } else { named.join(" or ") }
}

/// Columns that lack, or the encoding by which their names cannot be read.
fn lacking(missing: Vec<String>, found: Vec<String>, record: &csv::ByteRecord) -> Fault {
    let is_text = record.iter().all(|name| std::str::from_utf8(name).is_ok());
    if is_text { Fault::NoColumn { missing, found, known: KNOWN } } else { Fault::Encoding { encoding: "not UTF-8" } }
}

/// What parts the columns of a table: the first of tab, semicolon and comma that its first line has, remarks after `#` aside, which tables of a scale may have.
pub(super) fn separator(bytes: &[u8]) -> u8 {
    let line = bytes
        .split(|byte| matches!(byte, b'\n' | b'\r'))
        .find(|line| !line.trim_ascii().is_empty() && !line.starts_with(b"#"))
        .unwrap_or_default();
    [b'\t', b';'].into_iter().find(|separator| line.contains(separator)).unwrap_or(b',')
}
