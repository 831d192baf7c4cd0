//! Where a frame file drives a finding.
//!
//! Of a mass the largest contributors, heaviest first, of the envelope the rods, of a part what drives that part; but for
//! masses a value that the file itself states comes before one of its bases', and the limit after what it limits. A preset that comes with the program is no
//! file that anybody could change, so nothing points there.

use std::sync::Arc;

use crate::checks::Finding;
use crate::frame::assembly::mass::{MassLine, MassTable};
use crate::params::refusal::Place;
use crate::params::{FrameFile, follows, parameters};

/// How many places are named at most.
const MOST: usize = 3;
/// How many of the heaviest lines are to blame for a mass; the messages name as many.
const HEAVIEST: usize = 3;

/// A place in a file that a person can change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Spot {
    /// The file, as it was asked for.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// The key that stands there; empty for none.
    pub key: String,
}

impl Spot {
    /// Where a key was typed.
    pub fn at(key: &str, place: &Place) -> Self {
        let [line, column] = place.line_column();
        Self { file: plain(&place.source.name), line, column, key: key.into() }
    }
}

/// A path without `.` and `..` where that can be had without looking at the disk: readers of reports know files by such paths.
fn plain(name: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    let (root, rest) = name.strip_prefix('/').map_or(("", name), |rest| ("/", rest));
    for part in rest.split('/') {
        match part {
            "" | "." => {}
            ".." if parts.last().is_some_and(|last| *last != "..") => drop(parts.pop()),
            _ => parts.push(part),
        }
    }
    format!("{root}{}", parts.join("/"))
}

/// Where a frame file drives a finding, the first most. None when there is no file to change.
pub fn spots(finding: &Finding, file: &FrameFile, masses: &MassTable) -> Vec<Spot> {
    let own = |place: &Place| file.files.iter().any(|source| Arc::ptr_eq(source, &place.source));
    let mut stated: Vec<(usize, Spot)> = Vec::new();
    for key in drivers(finding, masses) {
        let Some(entry) = file.entries.get(&key).filter(|entry| own(&entry.place)) else { continue };
        let spot = Spot::at(&key, &entry.place);
        if stated.iter().all(|(_, known)| *known != spot) {
            stated.push((entry.depth, spot));
        }
    }
    if finding.rule == "mass_budget" {
        // The heaviest comes first wherever it stands, unless the limit is what the nearer file changed.
        let limit = limit_key(finding).unwrap_or_default();
        let nearest = stated.iter().filter(|(_, spot)| spot.key != limit).map(|(depth, _)| *depth).min();
        stated.sort_by_key(|(depth, spot)| spot.key != limit || nearest.is_some_and(|nearest| *depth >= nearest));
    } else {
        stated.sort_by_key(|(depth, _)| *depth);
    }
    let mut spots: Vec<Spot> = stated.into_iter().map(|(_, spot)| spot).take(MOST).collect();
    if spots.is_empty() {
        spots.extend(file.base.as_ref().filter(|place| own(place)).map(|place| Spot::at("base", place)));
    }
    if spots.is_empty() {
        spots.extend(file.files.first().map(|source| Spot { file: plain(&source.name), line: 1, column: 1, key: String::new() }));
    }
    spots
}

/// Keys that drive a finding, the first most.
fn drivers(finding: &Finding, masses: &MassTable) -> Vec<String> {
    let mut keys: Vec<String> = Vec::new();
    match &*finding.rule {
        "mass_budget" | "centre_of_mass" => keys.extend(mass_keys(masses)),
        "envelope" => keys.extend(envelope_keys(&finding.subject).iter().map(|key| key.to_string())),
        _ => {}
    }
    for lever in finding.levers.iter() {
        keys.extend(std::iter::once(lever.clone().into_owned()).chain(followed(lever, masses)));
    }
    let named = |p: &&crate::params::parameter::Parameter| p.drives.iter().any(|part| finding.subject.contains(part.slug()));
    if !matches!(&*finding.rule, "mass_budget" | "envelope") {
        keys.extend(parameters().filter(named).map(|p| format!("{}.{}", p.table, p.key)));
    }
    keys.extend(limit_key(finding).map(String::from));
    keys
}

/// Where a lever that no file states comes from: the bought part that it follows, its own figures first.
fn followed(lever: &str, masses: &MassTable) -> Vec<String> {
    let Some(role) = follows::role_of(lever.rsplit('.').next().unwrap_or(lever)) else { return Vec::new() };
    let part = masses.lines.iter().find(|line| line.kind == "bought" && line.name == role).map(|line| &line.material);
    let figures = part.map(|part| ["size_mm", "mass_g"].map(|figure| format!("override.parts.{part}.{figure}")));
    figures.into_iter().flatten().chain([format!("bought.{role}")]).collect()
}

/// Rods first, then what else makes the frame wide or high.
fn envelope_keys(subject: &str) -> [&'static str; 6] {
    let [width, height] = ["target.width_mm", "target.height_mm"];
    if subject.starts_with("height") {
        [
            height,
            "rods.strut_rod_length_mm",
            "rods.arm_rod_length_mm",
            "rods.cage_rod_length_mm",
            "target.strut_tilt_deg",
            "bracket.bay_height_mm",
        ]
    } else {
        [
            width,
            "rods.cage_rod_length_mm",
            "rods.arm_rod_length_mm",
            "rods.strut_rod_length_mm",
            "corner.corner_node_to_bottom_mm",
            "corner.corner_wall_mm",
        ]
    }
}

/// Keys of the heaviest lines first.
fn mass_keys(masses: &MassTable) -> Vec<String> {
    let mut lines: Vec<&MassLine> = masses.lines.iter().filter(|line| line.total_g > 0.0).collect();
    lines.sort_by(|a, b| b.total_g.total_cmp(&a.total_g).then_with(|| a.name.cmp(&b.name)));
    lines.truncate(HEAVIEST);
    lines.into_iter().flat_map(line_keys).collect()
}

fn line_keys(line: &MassLine) -> Vec<String> {
    let MassLine { name, material, .. } = line;
    match &*line.kind {
        "bought" if name == "battery" => {
            vec![format!("override.parts.{material}.mass_g"), "battery.battery_mass_g".into(), "bought.battery".into()]
        }
        "bought" => vec![format!("override.parts.{material}.mass_g"), format!("bought.{name}")],
        "extra" => vec![format!("extras.{name}.mass_g")],
        "rod" => vec![format!("rods.{name}_length_mm"), "bought.rod".into()],
        _ => vec![format!("override.materials.{material}.print_factor"), format!("override.materials.{material}.density_g_cm3")],
    }
}

/// The key of a finding's limit, where it is one of the frame file's.
fn limit_key(finding: &Finding) -> Option<&'static str> {
    Some(match &*finding.rule {
        "envelope" if finding.subject.starts_with("height") => "limits.envelope_height_mm",
        "envelope" => "limits.envelope_width_mm",
        "mass_budget" => "limits.mass_budget_g",
        "centre_of_mass" => "limits.centre_of_mass_offset_mm",
        "propeller_clearance" => "limits.propeller_clearance_mm",
        "part_clearance" => "limits.part_clearance_mm",
        "ground_clearance" => "limits.ground_clearance_mm",
        "socket_seating" => "limits.socket_engagement_mm",
        "hinge_strain" => "limits.hinge_strain_factor",
        "printer_bed" | "thinnest_wall" | "narrowest_gap" | "footing" => "printer",
        _ => return None,
    })
}
