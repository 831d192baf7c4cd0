//! The paper's model against the paper's figures (arXiv 2103.04423 and its notebook).

use flexframe::impact::effects::Model;
use flexframe::impact::sim::{SolverOptions, System, Trace, simulate};

use crate::paper::figures::{HEIGHTS_M, PEAKS_G, SHARES};

fn traces() -> Vec<Trace> {
    let system = System::new(&Model::load("paper").expect("comes with the program"));
    HEIGHTS_M.iter().map(|height_m| simulate(&system, *height_m, &SolverOptions::REPORT)).collect()
}

#[test]
fn measured_peaks_are_the_published_ones() {
    for (trace, published_g) in traces().iter().zip(PEAKS_G) {
        let peaks = trace.peaks.expect("it does not diverge");
        let ratio = peaks.coordinate_g / published_g;
        assert!((ratio - 1.0).abs() < 0.005, "{} m: {} g, published {published_g} g", trace.height_m, peaks.coordinate_g);
        assert!((peaks.proper_g - peaks.coordinate_g - 1.0).abs() < 1e-9, "proper acceleration is 1 g more");
    }
}

#[test]
fn measured_energy_shares_are_the_published_ones() {
    for (trace, published) in traces().iter().zip(SHARES) {
        let paper = trace.paper.expect("it turns or meets the gap");
        for (ours, theirs) in [paper.damper_percent, paper.spring_percent, paper.rigid_percent].into_iter().zip(published) {
            assert!((ours - theirs).abs() < 0.3, "{} m: {paper:?}, published {published:?}", trace.height_m);
        }
    }
}

#[test]
fn measured_true_damper_work_at_30_cm_is_74_6_percent() {
    let trace = &traces()[0];
    let balance = trace.compression.as_ref().expect("it turns");
    let share = 100.0 * balance.dissipated_j / (0.241 * 9.81 * 0.3);
    assert!((share - 74.6).abs() < 0.1, "{share}");
}
