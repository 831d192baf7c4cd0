//! A frame's own curve in synthetic drops: the right frame's is named, a wrong one is told from it or said to be unclear.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use flexframe::impact::diagnose::{Diagnosis, DiagnosisOptions, Verdict, diagnose};
use flexframe::impact::effects::{FrameCurve, Model};
use flexframe::impact::fit::{Chosen, Keep};
use flexframe::impact::measured;
use flexframe::impact::measured::FileFormat;
use flexframe::impact::sim::{SlowWay, System};
use flexframe::params::ImpactFile;

/// φ of the real frame, which `flexframe stiffness cognifly-v8` computes, to a hundredth of a millimetre; and one that stiffens as much.
const SOFT: [[f64; 2]; 12] = [
    [0.0, 0.0],
    [1.0, 0.96],
    [3.0, 2.59],
    [6.0, 4.52],
    [9.0, 5.98],
    [12.0, 7.10],
    [15.0, 8.03],
    [18.0, 8.80],
    [21.0, 9.49],
    [24.0, 10.10],
    [27.0, 10.70],
    [30.0, 11.30],
];

fn curve(points: &[[f64; 2]]) -> Arc<FrameCurve> {
    let [x, phi] = [0, 1].map(|column| points.iter().map(|point| point[column]).collect::<Vec<f64>>());
    Arc::new(FrameCurve::new(&x, &phi).expect("is a curve"))
}

/// As much more than x as the frame's is less.
fn hard() -> Vec<[f64; 2]> {
    SOFT.iter().map(|[x, phi]| [*x, 2.0 * x - phi]).collect()
}

/// The paper's model with the frame's curve, at four heights of 20 drops.
fn synthetic_drops(folder: &Path, points: &[[f64; 2]], seed: u64) -> std::path::PathBuf {
    let list = |column: usize| points.iter().map(|point| format!("{:?}", point[column])).collect::<Vec<_>>().join(", ");
    let plan = format!(
        "mass_kg = 0.241\ngap_mm = 16.0\n[sensor]\ncutoff_hz = 500.0\norder = 1\nlimit_g = 230.0\nchannel = \"axial\"\n\
         [effects.linear_spring]\nk = 9000.0\n[effects.linear_damper]\nc = 12.0\n\
         [effects.frame_force_curve]\nshare = 1.0\nx_mm = [{}]\nphi_mm = [{}]\n\
         [drops]\nheights_m = [0.5, 1.0, 1.5, 2.0]\ncount = 20\nseed = {seed}\n[scatter]\nshare = 0.1\ncorrelation_ms = 1.5\n",
        list(0),
        list(1)
    );
    let file = folder.join("truth.toml");
    fs::write(&file, plan).expect("written");
    assert_cmd::Command::new(assert_cmd::cargo::cargo_bin("flexframe"))
        .arg("synthesize")
        .arg(&file)
        .arg("-o")
        .arg(folder)
        .assert()
        .success();
    folder.join("synthesize-truth/drops")
}

fn diagnosed(drops: &Path, candidate: Option<Arc<FrameCurve>>) -> Diagnosis {
    let set = measured::read(&[drops.to_path_buf()], &FileFormat::default()).expect("reads");
    let mut model = Model::load("paper-corrected").expect("comes with the program");
    model.sensor.channel = flexframe::impact::effects::Channel::Axial;
    model.frame_curve = candidate;
    let waves = Chosen::of(&set, model.sensor.channel, Keep::Evidence).expect("there are drops").waves().expect("can be laid");
    let (fitted, held) = (waves.only(|h| h < 1.9), waves.only(|h| h > 1.9));
    diagnose(&fitted, Some(&held), &model, &DiagnosisOptions::new(2, 1)).expect("a diagnosis")
}

#[test]
fn planted_the_right_frames_curve_is_named_with_its_share() {
    let folder = tempfile::tempdir().expect("a folder");
    let found = diagnosed(&synthetic_drops(folder.path(), &SOFT, 7), Some(curve(&SOFT)));
    assert_eq!(found.verdict, Verdict::Named, "{:?}", found.reasons);
    assert_eq!(found.chosen.ids(), ["frame_force_curve"]);
    let share = found.chosen.model().value("frame_force_curve", "share").expect("is listed");
    assert!((share - 1.0).abs() < 0.15, "{share}");
    assert!(found.after.held_out.net_g < 0.35 * found.before.held_out.net_g, "{:?} {:?}", found.after.held_out, found.before.held_out);
}

#[test]
fn planted_a_wrong_frames_curve_is_not_named_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let drops = synthetic_drops(folder.path(), &SOFT, 8);
    // A frame that stiffens where the drops soften.
    let found = diagnosed(&drops, Some(curve(&hard())));
    assert_ne!((found.verdict, found.chosen.ids()), (Verdict::Named, vec!["frame_force_curve"]), "{:?}", found.reasons);
    let with = diagnosed(&drops, Some(curve(&SOFT)));
    assert!(with.chosen.score + 10.0 < found.ranking.iter().find(|one| one.id == "frame_force_curve").expect("was looked at").score);
}

#[test]
fn analytic_energies_balance_with_the_curve_and_beyond_its_end_it_is_marked() {
    let mut model = Model::load("paper-corrected").expect("comes with the program");
    model = model.with(flexframe::impact::effects::by_id("frame_force_curve").expect("an effect"), &[1.0], 0);
    for (reach, feet) in [(12, false), (12, true), (4, false)] {
        model.frame_curve = Some(curve(&SOFT[..reach]));
        let spec = flexframe::impact::effects::by_id("foot_stagger").expect("an effect");
        let dropped = if feet { model.clone().with(spec, &[5.0], 0) } else { model.clone() };
        let trace = flexframe::impact::sim::simulate(
            &flexframe::impact::sim::System::new(&dropped),
            0.5,
            &flexframe::impact::sim::SolverOptions::REPORT,
        );
        for balance in trace.compression.iter().chain(&trace.release) {
            assert!(balance.residual().abs() < 1e-8, "{reach} {feet}: {}", balance.residual());
        }
        let marked = trace.warnings.iter().any(|mark| mark.to_string().contains("to which the frame's curve goes"));
        assert_eq!(marked, reach == 4, "{:?}", trace.warnings);
    }
}

#[test]
fn analytic_a_share_of_nothing_leaves_every_bit_and_one_is_the_frames_curve() {
    let file = |share: f64| {
        let text = Model::load("paper-corrected").expect("comes with the program").to_toml();
        let text = format!("{text}\n[effects.frame_force_curve]\nshare = {share:?}\nx_mm = [0.0, 5.0, 20.0]\nphi_mm = [0.0, 4.0, 9.0]\n");
        Model::resolve(&ImpactFile::parse("curve", &text).expect("is TOML")).expect("is a model")
    };
    let force = |model: &Model, x_m: f64| System::new(model).slow_force_n(x_m, SlowWay::Loading);
    let (base, off, on) = (Model::load("paper-corrected").expect("comes with the program"), file(0.0), file(1.0));
    let k = base.stiffness_and_damping()[0];
    for x_m in [-0.001, 0.002, 0.0137, 0.03] {
        assert_eq!(force(&off, x_m).to_bits(), force(&base, x_m).to_bits());
    }
    assert!((force(&on, 0.005) - k * 0.004).abs() < 1e-9 && (force(&on, 0.02) - k * 0.009).abs() < 1e-9);
}
