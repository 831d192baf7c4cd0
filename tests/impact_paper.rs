//! The paper's model against the paper's figures (arXiv 2103.04423 and its notebook).

use flexframe::impact::effects::Model;
use flexframe::impact::sim::{Settings, System, Trace, simulate};

const HEIGHTS_M: [f64; 8] = [0.3, 0.5, 1.0, 1.5, 2.62, 5.0, 10.0, 20.0];

fn traces() -> Vec<Trace> {
    let system = System::new(&Model::load("paper").expect("comes with the program"));
    HEIGHTS_M.iter().map(|height_m| simulate(&system, *height_m, &Settings::REPORT)).collect()
}

#[test]
fn measured_peaks_are_the_published_ones() {
    const PUBLISHED_G: [f64; 8] = [46.2, 59.9, 85.2, 104.6, 138.5, 191.7, 271.5, 384.4];
    for (trace, published_g) in traces().iter().zip(PUBLISHED_G) {
        let ratio = trace.peak_coordinate_g / published_g;
        assert!((ratio - 1.0).abs() < 0.005, "{} m: {} g, published {published_g} g", trace.height_m, trace.peak_coordinate_g);
        assert!((trace.peak_proper_g - trace.peak_coordinate_g - 1.0).abs() < 1e-9, "proper acceleration is 1 g more");
    }
}

#[test]
fn measured_energy_shares_are_the_published_ones() {
    // Damper, spring, rigid; % of m g h.
    const PUBLISHED: [[f64; 3]; 8] = [
        [72.2, 27.9, 0.0],
        [72.4, 27.6, 0.0],
        [72.6, 27.4, 0.0],
        [72.4, 25.4, 2.2],
        [63.8, 14.6, 21.6],
        [50.9, 7.6, 41.4],
        [38.4, 3.8, 57.8],
        [28.3, 1.9, 69.8],
    ];
    for (trace, published) in traces().iter().zip(PUBLISHED) {
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
