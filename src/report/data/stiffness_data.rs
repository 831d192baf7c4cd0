//! Stiffness as words, JSON and CSV.

use serde_json::{Value, json};

use crate::export::ExportError;
use crate::export::table::csv;
use crate::mechanics::result::ratio::Ratio;
use crate::mechanics::result::static_curve::{Inside, StaticCurve};
use crate::mechanics::settings::MechanicsSettings;
use crate::mechanics::solve::modes::Modes;

/// What was computed and what it is compared with.
pub struct Stiffness<'a> {
    /// The frame's name.
    pub frame: &'a str,
    /// The numbers it was computed with.
    pub settings: &'a MechanicsSettings,
    /// Force over displacement.
    pub curve: &'a StaticCurve,
    /// From what hangs lowest down to the ground, mm; none where everything hangs above the feet's reach.
    pub gap_mm: Option<f64>,
    /// Modes on held feet.
    pub modes: Option<&'a Modes>,
    /// Measured displacement, mm, and force, N.
    pub measured: &'a [[f64; 2]],
    /// Misfit over the points that the curve reaches, N.
    pub rms_n: Option<f64>,
    /// Whether the modulus was fitted to what was measured.
    pub calibrated: bool,
    /// A reference's name, and ratios to it.
    pub ratios: Option<(&'a str, &'a [Ratio])>,
}

/// Displacements at which the secant is reported, mm.
const SECANTS_MM: [f64; 4] = [4.0, 8.0, 12.0, 16.0];

impl Stiffness<'_> {
    /// The band of every stiffness and force, as factors: they go with the modulus.
    pub fn band(&self) -> [f64; 2] {
        self.settings.young_band_mpa.map(|young| young / self.settings.young_mpa)
    }

    /// That the curve goes on beyond where the frame sits on flat ground, where it does.
    pub fn gap_words(&self) -> Option<String> {
        let last_mm = self.curve.points.last().map_or(0.0, |point| point.displacement_mm);
        let gap_mm = self.gap_mm.filter(|gap_mm| *gap_mm < last_mm)?;
        Some(format!("pressed down by {gap_mm:.1} mm, what hangs lowest sits on flat ground: forces beyond are those of raised feet"))
    }
}

fn inside_json(inside: &Inside) -> Value {
    let rods: Vec<Value> = inside
        .rods
        .iter()
        .map(|rod| {
            json!({ "rod": rod.rod, "role": rod.role, "compression_n": rod.compression_n, "buckling_n": rod.buckling_n, "use": rod.utilisation() })
        })
        .collect();
    json!({ "displacement_mm": inside.displacement_mm, "zones": inside.zones, "rods": rods })
}

/// Everything as JSON.
pub fn json(found: &Stiffness) -> Value {
    let curve = found.curve;
    let secants: Vec<Value> = SECANTS_MM
        .iter()
        .map(|x| json!({ "displacement_mm": x, "force_n": curve.force_n(*x), "secant_n_mm": curve.secant_n_mm(*x) }))
        .collect();
    let measured: Vec<Value> =
        found.measured.iter().map(|[x, f]| json!({ "displacement_mm": x, "measured_n": f, "force_n": curve.force_n(*x) })).collect();
    json!({
        "schema_version": 1,
        "frame": found.frame,
        "young_mpa": found.settings.young_mpa,
        "young_band_mpa": found.settings.young_band_mpa,
        "calibrated": found.calibrated,
        "gap_mm": found.gap_mm,
        "initial_n_mm": curve.initial_n_mm(),
        "band": found.band(),
        "secants": secants,
        "limit": curve.limit().map(|[x, f]| json!({ "displacement_mm": x, "force_n": f })),
        "curve": curve.points,
        "inside": curve.inside.iter().map(inside_json).collect::<Vec<_>>(),
        "modes": found.modes.map(|modes| &modes.modes),
        "measured": measured,
        "rms_n": found.rms_n,
        "ratios": found.ratios.map(|(reference, ratios)| json!({ "reference": reference, "ratios": ratios })),
    })
}

/// The curve with its band.
///
/// # Errors
/// Those of [`csv()`].
pub fn curve_csv(found: &Stiffness) -> Result<String, ExportError> {
    let [low, high] = found.band();
    let rows = found.curve.points.iter().map(|point| {
        let [x, f, low, high] = [point.displacement_mm, point.force_n, point.force_n * low, point.force_n * high].map(|v| v.to_string());
        [x, f, low, high, point.unstable.to_string()]
    });
    csv("curve.csv", ["displacement_mm", "force_n", "low_n", "high_n", "unstable"], rows)
}

/// Measured and computed forces, where something was measured.
fn comparison(found: &Stiffness) -> String {
    if found.measured.is_empty() {
        return String::new();
    }
    let force = |x: f64| found.curve.force_n(x);
    let reached = found.measured.iter().filter(|[x, _]| force(*x).is_some()).count();
    let rms = found.rms_n.map_or_else(String::new, |rms| format!(", rms {rms:.2} N"));
    let mut text = format!("\n measured    model   of {reached} points{rms}\n");
    for [x, f] in found.measured {
        text += &format!("{f:>9.1} {:>8}   N at {x} mm\n", force(*x).map_or_else(|| "-".into(), |model| format!("{model:.1}")));
    }
    if reached < found.measured.len() {
        let beyond = found.measured.len() - reached;
        text += &format!("{beyond} {} beyond the end of the curve\n", if beyond == 1 { "point lies" } else { "points lie" });
    }
    text
}

/// What a person reads.
pub fn table(found: &Stiffness) -> String {
    let (curve, settings) = (found.curve, found.settings);
    let [low, high] = found.band();
    let mut text = format!(
        "{}: E {:.1} MPa, known from {:.1} to {:.1}{}\n\n",
        found.frame,
        settings.young_mpa,
        settings.young_band_mpa[0],
        settings.young_band_mpa[1],
        if found.calibrated { ", calibrated" } else { "; stiffness and force go with it" }
    );
    text += "     down    force  secant         band\n       mm        N    N/mm         N/mm\n";
    let k0 = curve.initial_n_mm();
    text += &format!("        0        0 {k0:>7.2} {:>6.2} to {:.2}\n", k0 * low, k0 * high);
    for (x, force, secant) in SECANTS_MM.iter().filter_map(|x| Some((x, curve.force_n(*x)?, curve.secant_n_mm(*x)?))) {
        text += &format!("{x:>9} {force:>8.1} {secant:>7.2} {:>6.2} to {:.2}\n", secant * low, secant * high);
    }
    match curve.limit() {
        Some([x, f]) => text += &format!("limit load {f:.1} N at {x:.1} mm: beyond it the force falls\n"),
        None => text += &format!("no limit load down to {:.0} mm\n", curve.points.last().map_or(0.0, |p| p.displacement_mm)),
    }
    if let Some(words) = found.gap_words() {
        text += &format!("{words}\n");
    }
    text += &comparison(found);
    if let Some((reference, ratios)) = found.ratios {
        text += &format!("\nover {reference}, and between what when each guess is half or twice\n");
        for Ratio { displacement_mm, ratio, band: [low, high] } in ratios {
            text += &format!("{displacement_mm:>9} mm {ratio:>7.3} {low:>7.3} to {high:.3}\n");
        }
    }
    text += &insides(curve);
    if let Some(modes) = found.modes {
        text += "\nmodes on held feet\n       Hz  mass up and down\n";
        for mode in &modes.modes {
            text += &format!("{:>9.1} {:>6.1} %\n", mode.frequency_hz, 100.0 * mode.share_up);
        }
    }
    text.push('\n');
    text
}

fn insides(curve: &StaticCurve) -> String {
    let mut text = String::new();
    let (Some(first), Some(second)) = (curve.inside.first(), curve.inside.get(1)) else { return text };
    text += &format!(
        "\nenergy at {} and {} mm, largest strain at {} mm\n",
        first.displacement_mm, second.displacement_mm, second.displacement_mm
    );
    for zone in second.zones.iter().filter(|zone| zone.share > 0.004) {
        let small = first.zones.iter().find(|other| other.zone == zone.zone).map_or(0.0, |z| z.share);
        let strain = zone.strain.map_or_else(|| "-  ".into(), |strain| format!("{:.2} %", 100.0 * strain));
        text += &format!("{:>8.1} % {:>5.1} % {strain:>9}  {}\n", 100.0 * small, 100.0 * zone.share, zone.zone);
    }
    text += &format!("\nrods at {} mm: largest compression, and what buckles it between its hinges\n", second.displacement_mm);
    for rod in &second.rods {
        text += &format!("{:>9.1} N of {:>7.0} N  {}\n", rod.compression_n, rod.buckling_n, rod.rod);
    }
    text
}
