//! The model's figures: peaks, energies, the fall, the static test.

use std::fmt::Write;

use flexframe::impact::effects::Model;
use flexframe::impact::sim::{SolverOptions, System, Trace, simulate};

use super::figures::{HEIGHTS_M, PEAKS_G, SHARES, STATIC_FITS, STATIC_TEST, WEIGHT_N};
use super::ratio;
use flexframe::units::GRAVITY_M_S2;

pub fn traces(model: &Model) -> Vec<Trace> {
    let system = System::new(model);
    HEIGHTS_M.iter().map(|height_m| simulate(&system, *height_m, &SolverOptions::REPORT)).collect()
}

pub fn paper() -> Model {
    Model::load("paper").expect("comes with the program")
}

/// Damper, spring, rigid, % of m g h.
pub fn shares(trace: &Trace) -> [f64; 3] {
    let paper = trace.paper.expect("it turns or meets the gap");
    [paper.damper_percent, paper.spring_percent, paper.rigid_percent].map(|share| share + 0.0)
}

pub fn peaks(page: &mut String) {
    page.push_str(
        "## Peaks of the model\n\n\
         `flexframe drop --model paper`: m x'' + c x' + k x = m g with 0.241 kg, 46 N s/m, 7040 N/m. The paper gives |x''|, which is\n\
         largest at first touch. A sensor measures F/m, which is 1 g more.\n\n\
         | height, m | \\|x''\\|, g | published | ratio | F/m, g |\n|---|---|---|---|---|\n",
    );
    for (trace, published) in traces(&paper()).iter().zip(PEAKS_G) {
        let (height_m, peaks) = (trace.height_m, trace.peaks.expect("it does not diverge"));
        let ours = peaks.coordinate_g;
        let _ = writeln!(page, "| {height_m} | {ours:.1} | {published} | {} | {:.1} |", ratio(ours, published), peaks.proper_g);
    }
    page.push('\n');
}

pub fn energies(page: &mut String) {
    page.push_str(
        "## Where the energy goes\n\n\
         The paper's convention: shares of m g h at the turning point, or when the gap of 16 mm is used up; spring k x²/2, rigid collision\n\
         m x'²/2 at the gap, and the damper as the remainder. Each cell: ours, published, ratio.\n\n\
         | height, m | damper, % | spring, % | rigid, % |\n|---|---|---|---|\n",
    );
    let traces = traces(&paper());
    for (trace, published) in traces.iter().zip(SHARES) {
        let cell = |(ours, theirs): (f64, f64)| format!("{ours:.1}, {theirs:.1}, {}", ratio(ours, theirs));
        let cells: Vec<String> = shares(trace).into_iter().zip(published).map(cell).collect();
        let _ = writeln!(page, "| {} | {} |", trace.height_m, cells.join(" | "));
    }
    let balance = traces[0].compression.as_ref().expect("it turns");
    let damper = 100.0 * balance.dissipated_j / (0.241 * GRAVITY_M_S2 * 0.3);
    let _ = writeln!(
        page,
        "\nThis convention leaves out the work of gravity over the stroke. The damper's work from 30 cm is {damper:.1} % of m g h (74.6 published\n\
         beside it, ratio {}). `flexframe drop` prints the full balance, of m g (h + x), beside the paper's.\n",
        ratio(damper, 74.6)
    );
}

pub fn fall(page: &mut String) {
    let speed = (2.0 * GRAVITY_M_S2 * 2.62).sqrt();
    let seconds = (2.0 * 2.62 / GRAVITY_M_S2).sqrt();
    let _ = writeln!(
        page,
        "## From 262 cm\n\n\
         The paper drops its drone from 262 cm, at about 7 m/s. Without air: {speed:.2} m/s (ratio {}) after {seconds:.4} s (0.7309 in the\n\
         notebook, ratio {}; 0.741 s measured, ratio {}).\n",
        ratio(speed, 7.0),
        ratio(seconds, 0.7309),
        ratio(seconds, 0.741)
    );
}

/// Slope, intercept and BIC (10 ln(RSS/10) + p ln 10) of a line through points, its intercept given or free.
pub fn line(points: &[[f64; 2]], intercept: Option<f64>) -> [f64; 3] {
    let n = points.len() as f64;
    let sum = |f: &dyn Fn(&[f64; 2]) -> f64| points.iter().map(f).sum::<f64>();
    let (x, y, xx, xy) = (sum(&|p| p[0]), sum(&|p| p[1]), sum(&|p| p[0] * p[0]), sum(&|p| p[0] * p[1]));
    let [slope, start] = match intercept {
        Some(intercept) => [(xy - intercept * x) / xx, intercept],
        None => {
            let slope = (n * xy - x * y) / (n * xx - x * x);
            [slope, (y - slope * x) / n]
        }
    };
    let rest = sum(&|p| (p[1] - slope * p[0] - start) * (p[1] - slope * p[0] - start));
    let free = if intercept.is_some() { 1.0 } else { 2.0 };
    [slope, start, n * (rest / n).ln() + free * n.ln()]
}

pub fn static_points() -> Vec<[f64; 2]> {
    STATIC_TEST.iter().map(|[force_n, height_cm]| [(STATIC_TEST[0][1] - height_cm) * 1e-2, *force_n]).collect()
}

pub fn static_test(page: &mut String) {
    let points = static_points();
    let ([k, _, bic], [k_free, start, bic_free]) = (line(&points, Some(WEIGHT_N)), line(&points, None));
    let [k_published, bic_published, free_published, start_published, bic_free_published] = STATIC_FITS;
    page.push_str("## Stiffness from the static test\n\nTen readings of a dynamometer between 0 and 115 N (compression 0 to 16 mm).\n\n");
    page.push_str("| line | ours | published | ratio |\n|---|---|---|---|\n");
    for (name, ours, theirs, places) in [
        ("F = k x + 2.36 N: k, N/m", k, k_published, 0),
        ("its BIC", bic, bic_published, 1),
        ("free intercept: k, N/m", k_free, free_published, 0),
        ("its intercept, N", start, start_published, 1),
        ("its BIC", bic_free, bic_free_published, 1),
    ] {
        let _ = writeln!(page, "| {name} | {ours:.places$} | {theirs} | {} |", ratio(ours, theirs));
    }
    page.push_str("\nThe line with a free intercept has the better BIC. 7040 N/m is 10 % larger, because that line is forced to start at the frame's weight.\n\n");
}
