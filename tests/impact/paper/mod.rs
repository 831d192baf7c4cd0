//! The page that sets our figures beside those of arXiv 2103.04423 and of its notebook.

pub mod figures;
pub mod fits;
pub mod measured;
pub mod model;

use std::path::{Path, PathBuf};

/// The records' folder.
pub fn folder() -> PathBuf {
    let data =
        std::env::var_os("FLEXFRAME_DATA").map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data"), PathBuf::from);
    data.join("crash_landing")
}

/// A ratio, or nothing where there is none.
fn ratio(ours: f64, theirs: f64) -> String {
    if theirs == 0.0 { "-".into() } else { format!("{:.3}", ours / theirs) }
}

/// The whole page.
pub fn page() -> String {
    let mut page = String::from(
        "# Reproduction of the paper\n\n\
         This page compares the figures of R. de Azambuja, H. Fouad, G. Beltrame, arXiv 2103.04423, and of the notebook that made them\n\
         (github.com/thecognifly/CrashLandingExperiments), with ours. The ratio is ours / published. The page is written by\n\n\
         ```console\n\
         FLEXFRAME_DATA=../shared/data cargo run --release --example reproduction\n\
         ```\n\n\
         and checked by `tests/impact/reproduction.rs`. The records carry no licence. They are read from a local folder, which holds about 70 % of\n\
         them. Our measured figures are those of this part. The published figures are those of all drops. g = 9.81 m/s².\n\n",
    );
    model::peaks(&mut page);
    model::energies(&mut page);
    model::fall(&mut page);
    model::static_test(&mut page);
    measured::peaks(&mut page);
    measured::impulses(&mut page);
    let drops = fits::Drops::read();
    fits::objective(&mut page, &drops);
    fits::filter(&mut page, &drops);
    fits::axial(&mut page, &drops);
    page
}
