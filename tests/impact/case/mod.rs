//! The real drops diagnosed: figures for the page, and for the tests that hold them.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use flexframe::frame::assembly::{Design, mass};
use flexframe::impact::diagnose::{Diagnosis, DiagnosisOptions, Observable, diagnose, joined, observables};
use flexframe::impact::effects::{Channel, FrameCurve, Model, by_id};
use flexframe::impact::fit::{Chosen, Keep, Layout, PaperObjective, Waves, fit};
use flexframe::impact::landing::LandingAssessment;
use flexframe::impact::measured;
use flexframe::impact::measured::{DropSet, FileFormat, JudgedDrops, Session, StaticTest};
use flexframe::impact::request::{Compared, DiagnosisRequest, SeparatingExperiment};
use flexframe::mechanics;
use flexframe::mechanics::model::frame_model::{Extent, FrameModel};
use flexframe::mechanics::result::reduction::Reduction;
use flexframe::mechanics::result::static_curve::StaticCurve;
use flexframe::params::Frame;
use flexframe::report::data::landing_data;

/// Cutoffs at which the paper's damper is fitted again, Hz; the second is its notebook's 500 rad/s, the fifth its text's.
const CUTOFFS_HZ: [f64; 6] = [50.0, 79.577_471_545_947_67, 150.0, 300.0, 500.0, 1000.0];
const SEED: u64 = 1;

/// The records' folder.
pub fn folder() -> PathBuf {
    let data =
        std::env::var_os("FLEXFRAME_DATA").map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data"), PathBuf::from);
    data.join("crash_landing")
}

/// Everything that the page says.
pub struct Study {
    /// Magnitude, height by height.
    pub magnitude: Vec<Observable>,
    /// Axis, height by height.
    pub axial: Vec<Observable>,
    /// Zeros of the sensor, and what it reads while held, height by height.
    pub sessions: Vec<Session>,
    /// Cutoff, Hz, damper, N s/m, and the paper's objective there.
    pub damper_at: Vec<(f64, f64, f64)>,
    /// Cutoff, Hz, and damper, N s/m, where both are free.
    pub free_cutoff: (f64, f64, f64),
    /// All three heights.
    pub all: Diagnosis,
    /// 50 and 100 cm, judged on 150 cm.
    pub judged: Diagnosis,
    /// Both again with the real frame's own static curve among the effects.
    pub with_curve: [Diagnosis; 2],
    /// The rider that the frame's symmetric modes are equivalent to: share, and frequency, Hz.
    pub rider: Option<[f64; 2]>,
    /// Landings from 50 and 100 cm, judged on 150 cm, with the sensor's own bandwidth.
    pub landing: LandingAssessment,
    /// The same from all three heights.
    pub landing_of_all: LandingAssessment,
    /// What was compared for it: what explains the variation, and what is confounded with the height.
    pub compared: Compared,
}

fn drops() -> DropSet {
    let paths: Vec<_> = ["soft_050cm", "soft_100cm", "soft_150cm"].iter().map(|name| folder().join(name)).collect();
    measured::read(&paths, &FileFormat::default()).expect("reads")
}

fn paper(channel: Channel) -> Model {
    let mut model = Model::load("paper").expect("the paper's model");
    model.sensor.channel = channel;
    model
}

fn waves(set: &DropSet, channel: Channel) -> Waves {
    Chosen::of(set, channel, Keep::Evidence).expect("there are drops").waves().expect("they can be laid upon each other")
}

/// The real frame reduced to one coordinate, by the numbers that come with the program: the curve does not depend on the modulus.
fn reduced() -> Reduction {
    let settings = mechanics::settings::MechanicsSettings::load(None).expect("the program's own numbers are sound");
    let design = Design::new(Frame::load("cognifly-v8").expect("the preset is valid").0).expect("closes");
    let masses = mass::table(&design);
    let quarter = FrameModel::new(&design, &masses, &settings, Extent::Quarter).expect("has a model");
    let curve = StaticCurve::new(&quarter, 30.0, &[]).expect("is followed");
    Reduction::of(&quarter, &curve, masses.total_g * 1e-3, &settings).expect("has modes")
}

/// Whether the frame lands on one foot first.
fn landing(set: &DropSet, hold_out_heights_m: &[f64]) -> Compared {
    let request = DiagnosisRequest {
        model: Model::load("paper-corrected").expect("comes with the program"),
        drops: set,
        axes: None,
        hold_out_heights_m,
        static_test: None,
        covariates: &[],
        max_effects: 2,
        seed: SEED,
    };
    request.diagnosed(&|_| ()).expect("a diagnosis").1
}

impl Study {
    /// Reads, fits, diagnoses.
    pub fn made() -> Self {
        let set = drops();
        let (magnitude, axial) = (waves(&set, Channel::Magnitude), waves(&set, Channel::Axial));
        let model = paper(Channel::Axial);
        let objective = PaperObjective::of(&Chosen::of(&set, Channel::Magnitude, Keep::Every).expect("there are drops")).expect("compares");
        let cutoff = by_id("sensor_low_pass").expect("an effect");
        let damper = |cutoff_hz: f64, keys: &[&str]| {
            let model = paper(Channel::Magnitude).with(cutoff, &[cutoff_hz], 0);
            let fit = fit(&objective, &Layout::named(model, keys).expect("its keys"), 0, SEED).expect("it holds the body");
            let value = |key: &str| fit.estimates.iter().find(|one| one.key == key).map_or(cutoff_hz, |one| one.value);
            (value("cutoff_hz"), value("c"), fit.objective[1])
        };
        let settings = DiagnosisOptions::new(3, SEED);
        let reduced = reduced();
        let [x_mm, phi_mm] = [0, 1].map(|column| reduced.curve_mm.iter().map(|point| point[column]).collect::<Vec<f64>>());
        let mut bent = model.clone();
        bent.frame_curve = Some(Arc::new(FrameCurve::new(&x_mm, &phi_mm).expect("is a curve")));
        let both = |model: &Model| {
            let all = diagnose(&axial, None, model, &settings).expect("a diagnosis");
            [all, diagnose(&axial.only(|h| h < 1.2), Some(&axial.only(|h| h > 1.2)), model, &settings).expect("a diagnosis")]
        };
        let [all, judged] = both(&model);
        let mut compared = landing(&set, &[1.5]);
        let assessed = |compared: &mut Compared| compared.landing.take().expect("lateral axes were measured");
        Self {
            magnitude: observables(&magnitude, &model),
            axial: observables(&axial, &model),
            sessions: JudgedDrops::of(&set).sessions,
            damper_at: CUTOFFS_HZ.iter().map(|cutoff_hz| damper(*cutoff_hz, &["c"])).collect(),
            free_cutoff: damper(200.0, &["c", "cutoff_hz"]),
            all,
            judged,
            with_curve: both(&bent),
            rider: reduced.rider,
            landing: assessed(&mut compared),
            landing_of_all: assessed(&mut landing(&set, &[])),
            compared,
        }
    }

    /// The page.
    pub fn page(&self) -> String {
        let mut page = String::from(
            "# Case study: the real drops\n\n\
             This page compares the paper's model with the records of 50, 100 and 150 cm of arXiv 2103.04423's data set (about 70 % of them).\n\
             The records carry no licence. They are read from a local folder. The page is written by\n\n\
             ```console\n\
             FLEXFRAME_DATA=../shared/data cargo run --release --example case_study\n\
             ```\n\n\
             and checked by `tests/impact/case_study.rs`. To repeat it by hand, run `flexframe diagnose --model paper --max-effects 3\n\
             ../shared/data/crash_landing/soft_*`, the same with `--hold-out-heights 1.5`, and for what is said of landings\n\
             `--model paper-corrected --max-effects 2 --hold-out-heights 1.5`; without the held-out height it is the fit to all three.\n\
             [diagnosis.md](diagnosis.md) explains the terms.\n\n",
        );
        self.channel(&mut page);
        self.zero(&mut page);
        self.cutoff(&mut page);
        self.place(&mut page);
        self.trap(&mut page);
        self.gaps(&mut page);
        self.frame(&mut page);
        self.landings(&mut page);
        self.end(&mut page);
        page
    }

    fn channel(&self, page: &mut String) {
        page.push_str("## The magnitude is physically impossible, so the axial component is used\n\n\
             The table gives the impulse of the mean wave over the impact speed. In a vertical impact it cannot exceed 2 plus gravity's part in the\n\
             window.\n\n\
             | height, m | drops | magnitude | axis | upper bound |\n|---|---|---|---|---|\n");
        for (magnitude, axial) in self.magnitude.iter().zip(&self.axial) {
            let word = if magnitude.impossible { "impossible" } else { "possible" };
            let _ = writeln!(
                page,
                "| {} | {} | {:.2} ± {:.2}: {word} | {:.2} ± {:.2} | {:.2} |",
                axial.height_m, axial.drops, magnitude.impulse_over_v0, magnitude.error, axial.impulse_over_v0, axial.error, axial.most
            );
        }
        page.push_str(
            "\nThe magnitude, which the paper fits, contains sideways motion. `diagnose` compares the axial component instead, and reports this. No\n\
             drop is left out because of its impulse. Only records whose clock stalled, or that show two hits, are left out.\n\n",
        );
    }

    fn zero(&self, page: &mut String) {
        page.push_str("## The sensor's zero\n\n\
             A falling sensor reads its zero and the drag of the air, which grows with the square of the time. The course of each fall tells the two\n\
             apart. The last column is a test of the result: it contains none of the readings from which the zero is computed.\n\n\
             | height, m | reading along the axis in free fall, g | of which zero, g | of which drag, g | magnitude while held, less the zeros, g |\n\
             |---|---|---|---|---|\n");
        for (reading, session) in self.compared.free_fall.iter().zip(&self.sessions) {
            let (read_g, drag_g) = (reading.along_g, reading.along_g - reading.zero_g);
            let held_g = session.held_g.expect("is held before it is dropped").median;
            let _ = writeln!(page, "| {} | {read_g:.3} | {:.3} | {drag_g:.3} | {held_g:.3} |", reading.height_m, reading.zero_g);
        }
        page.push_str(
            "\nThe zero is the same at all heights, and the drag grows with the height, as it should. Until 2026-11-28 the zero was not taken off what is\n\
             compared. It stood in all of each wave.\n\n",
        );
    }

    fn cutoff(&self, page: &mut String) {
        page.push_str("## The paper's damping depends on its filter\n\n\
             The table gives the minimum of the paper's own objective (magnitude, all drops, k = 7040 N/m) for other cutoff frequencies of the\n\
             first-order filter:\n\n| cutoff, Hz | c, N s/m | objective |\n|---|---|---|\n");
        for (cutoff, c, objective) in &self.damper_at {
            let _ = writeln!(page, "| {cutoff:.1} | {c:.1} | {objective:.4} |");
        }
        let (cutoff, c, objective) = self.free_cutoff;
        let _ = write!(
            page,
            "\nThe notebook's 500 rad/s is 79.6 Hz and gives c = {:.1}. The text's 500 Hz gives {:.1}. Half of the published damping is therefore an\n\
             effect of the filter. With a free cutoff, the objective decreases up to {cutoff:.0} Hz (c = {c:.1}, {objective:.4}) and hardly changes above\n\
             500 Hz. The drops do not support a filter below the sensor's declared 500 Hz. The notebook's 79.6 Hz contradicts both.\n\n",
            self.damper_at[1].1, self.damper_at[4].1
        );
    }

    fn place(&self, page: &mut String) {
        let (same, worst) = (&self.all.residual_map.same_in, &self.all.residual_map.worst);
        let _ = write!(
            page,
            "## The residual of the base model\n\n\
             With spring and damper refitted to the axial component, p = {:.4}. The residuals of neighbouring heights have a cosine of {:.2} by\n\
             time, {:.2} by displacement and {:.2} by speed: the residual keeps its *time*. It is largest from {} m, {:.1} ms after first touch:\n\
             {:.1} g measured, {:.1} g in the model.\n\n",
            self.all.base_adequacy.p, same.t, same.x, same.v, worst.height_m, worst.t_ms, worst.measured_g, worst.model_g
        );
    }

    fn trap(&self, page: &mut String) {
        page.push_str("## An artefact: a stop near the gap\n\n\
             Each row adds one effect to the base model. A lower score is better. The parameters are those of fits to each height alone. A true\n\
             parameter is the same at every height: the slope of its logarithm over that of the impact speed is 0. A length that stands for a\n\
             fixed time has slope 1.\n\n\
             | effect and parameter | score | left-out gap, g | by height (50 / 100 / 150 cm) | slope | p-value of the difference |\n|---|---|---|---|---|---|\n");
        for one in self.all.ranking.iter().filter(|one| !one.id.contains('+')) {
            let Some(constancy) = &one.constancy else { continue };
            for by in &constancy.parameters {
                let values: Vec<String> = by.values.iter().map(|(_, value, _)| significant(*value)).collect();
                let slope = by.slope.map_or("-".into(), |slope| format!("{slope:.2}"));
                let left = one.left_out_g.map_or("-".into(), |gap| format!("{gap:.1}"));
                let _ = writeln!(
                    page,
                    "| {} {} | {:.0} | {left} | {} | {slope} | {:.0e} |",
                    one.id,
                    by.key,
                    one.score,
                    values.join(" / "),
                    constancy.p
                );
            }
        }
        page.push_str(
            "\nA stop (`bottoming`) lowers the score considerably. Fitted height by height, its kink moves with the impact speed. It is a fixed time,\n\
             not a fixed length, so it is not the gap under the battery. The constancy gate refuses it.\n\n",
        );
    }

    fn gaps(&self, page: &mut String) {
        page.push_str(
            "## The gap between model and drops\n\n\
             | | before, g | after, g | floor, g |\n|---|---|---|---|\n",
        );
        for (what, found) in [("all heights", &self.all), ("50 and 100 cm", &self.judged)] {
            let (before, after) = (&found.before, &found.after);
            let held = if found.heights_held_out { "150 cm, held out" } else { "each height, predicted from the others" };
            let _ = writeln!(
                page,
                "| {what}: {} | {:.2} | {:.2} | {:.2} |",
                joined(&found.chosen),
                before.fitted.net_g,
                after.fitted.net_g,
                before.fitted.floor_g
            );
            let _ =
                writeln!(page, "| {held} | {:.2} | {:.2} | {:.2} |", before.held_out.net_g, after.held_out.net_g, before.held_out.floor_g);
        }
        let (before, after) = (&self.judged.before.held_out, &self.judged.after.held_out);
        let _ = write!(
            page,
            "\nSingle records of 150 cm, compared with a model that was fitted to 50 and 100 cm: {:.1} g after, {:.1} g before, {:.1} g for the mean wave\n\
             of 150 cm itself. The last number is the lower bound for every curve that depends on the height alone. After over this bound: {:.3}.\n\n",
            after.records_g,
            before.records_g,
            after.template_g,
            after.records_g / after.template_g
        );
        if let Some(spring) = self.all.estimates.iter().find(|one| one.key == "k" && one.at_bound) {
            let _ = write!(
                page,
                "In the best set of all heights the linear spring itself ended at its bound ({:.0} N/m): its gap is that of a model without one.\n\n",
                spring.value
            );
        }
    }

    fn frame(&self, page: &mut String) {
        page.push_str(
            "## The frame's own curve\n\n\
             The same diagnosis with `frame_force_curve` as a further candidate: the static curve that [mechanics](mechanics.md) computes from the real\n\
             frame's geometry (`diagnose --frame cognifly-v8`).\n\n\
             | | chosen | share of the curve | 150 cm or left out: before, g | after, g | single records, g |\n|---|---|---|---|---|---|\n",
        );
        for (what, found) in [
            ("all heights", &self.all),
            ("all heights, with the curve", &self.with_curve[0]),
            ("50 and 100 cm", &self.judged),
            ("50 and 100 cm, with the curve", &self.with_curve[1]),
        ] {
            let share = found.chosen.model().value("frame_force_curve", "share").map_or("-".into(), |share| format!("{share:.2}"));
            let (before, after) = (&found.before.held_out, &found.after.held_out);
            let _ = writeln!(
                page,
                "| {what} | {} | {share} | {:.2} | {:.2} | {:.1} |",
                joined(&found.chosen),
                before.net_g,
                after.net_g,
                after.records_g
            );
        }
        for (what, found) in [("all heights", &self.with_curve[0]), ("50 and 100 cm", &self.with_curve[1])] {
            let alone = found.ranking.iter().position(|one| one.id == "frame_force_curve");
            let best = found.ranking.iter().position(|one| one.id.contains("frame_force_curve"));
            let Some((alone, best)) = alone.zip(best) else { continue };
            let _ = write!(
                page,
                "\nOf the {} sets of {what}, the curve alone has rank {} (score {:.0}: {}). The best set with the curve has rank {}: {} (score {:.0}).\n",
                found.ranking.len(),
                alone + 1,
                found.ranking[alone].score,
                found.ranking[alone].reason_rejected.as_deref().unwrap_or("chosen"),
                best + 1,
                found.ranking[best].id,
                found.ranking[best].score
            );
        }
        let [without, with] = [&self.judged, &self.with_curve[1]].map(|found| &found.after.held_out);
        let word = if with.net_g < 0.98 * without.net_g {
            "shrinks further"
        } else if with.net_g > 1.02 * without.net_g {
            "grows"
        } else {
            "does not shrink further"
        };
        let _ = write!(
            page,
            "\nAfter a fit to 50 and 100 cm, the gap at 150 cm {word} with the curve: {:.2} g with it, {:.2} g without it; single records {:.1} g and {:.1} g.\n",
            with.net_g, without.net_g, with.records_g, without.records_g
        );
        if let Some([share, f_hz]) = self.rider {
            let of = |key: &str| self.all.chosen.model().value("payload_mode", key);
            let fitted = of("mu")
                .zip(of("f_hz"))
                .map_or("no payload mode is chosen".into(), |(mu, f)| format!("the fit gives mu = {mu:.2} at {f:.0} Hz"));
            let _ = writeln!(
                page,
                "The frame's own symmetric modes are equivalent to a payload mode of mu = {share:.2} at {f_hz:.0} Hz (motors and ring against the centre); {fitted}."
            );
        }
        page.push('\n');
    }

    fn landings(&self, page: &mut String) {
        let LandingAssessment { gaps, gates, fit, .. } = &self.landing;
        page.push_str(
            "## The frame lands on one foot first\n\n\
             With the sensor's 500 Hz (`--model paper-corrected`), drops from 50 and 100 cm fitted and those from 150 cm held out, without\n\
             the records in which the logger's clock stalled:\n\n",
        );
        for gate in gates {
            let _ = writeln!(page, "- `{}`, {}: {}.", gate.id, gate.word(), gate.found);
        }
        for covariate in &self.compared.covariates {
            let _ = writeln!(page, "- {}.", covariate.sentence());
        }
        let _ = writeln!(
            page,
            "\nIn words: {}. At 150 cm the mean wave is missed by {:.2} g with random slopes, by {:.2} g with the slopes that the touch times from\n\
             150 cm themselves show, by {:.2} g when each drop's own touches are given (legs\n\
             of {:.0} N/m and {:.0} N s/m, an inertia of {:.1e} kg m²), and its own standard error is {:.2} g. {}\n",
            landing_data::spread(&self.landing),
            gaps.held_out.net_g,
            gaps.own_slopes.net_g,
            gaps.given_touches.net_g,
            fit.legs.stiffness_n_m,
            fit.legs.damping_n_s_m,
            fit.legs.inertia_kg_m2,
            gaps.held_out.floor_g,
            if self.landing.named() { "`landing_tilt` is named." } else { "`landing_tilt` is supported and not named: a test failed." }
        );
        let failed: Vec<String> =
            self.landing_of_all.gates.iter().filter(|gate| !gate.passed).map(|gate| format!("`{}`: {}", gate.id, gate.found)).collect();
        let _ = match failed[..] {
            [] => writeln!(page, "Fitted to all three heights, it passes every test, too.\n"),
            _ => writeln!(page, "Fitted to all three heights, it is not named, by {}.\n", failed.join("; by ")),
        };
        if let Some(friction) = self.landing.estimates.iter().find(|one| one.key == "f_c_n") {
            let test = StaticTest::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("params/static/cognifly-v8.csv")).expect("is there");
            let (line_n_m, _) = test.line_through_origin();
            let loaded: Vec<(f64, f64)> = test.points.into_iter().filter(|(x_m, _)| *x_m > 0.0).collect();
            let _ = writeln!(
                page,
                "The friction is no constant force of the frame at rest. Its static test reads {:.0} N at {:.0} mm and {:.0} N at {:.0} mm, and a frame with\n\
                 {:.0} N of dry friction ({:.0} to {:.0} N) would not move below that. It is what resists like dry friction during an impact: that of feet\n\
                 which slide under their load, or damping of another law. Nor are the legs' {:.0} N/m the stiffness of the frame at rest, of which the test says\n\
                 {line_n_m:.0} N/m: they are what an impact of a few milliseconds meets.\n",
                loaded[0].1,
                1e3 * loaded[0].0,
                loaded[1].1,
                1e3 * loaded[1].0,
                friction.value,
                friction.ci95[0],
                friction.ci95[1],
                self.landing.fit.legs.stiffness_n_m
            );
        }
        if let Some(refused) = &self.landing.refused {
            let _ = writeln!(
                page,
                "A further effect: {}. So the drops from 150 cm decided that it is left out: no fit saw them, but a choice did, and the gap at 150 cm is that of\n\
                 legs without it.\n",
                refused.sentence()
            );
        }
        let attitude = &self.landing.attitude;
        let _ = writeln!(page, "Mounting: {}. {}.\n", landing_data::lean(attitude), attitude.reason());
        for one in &self.compared.confounding {
            let _ = writeln!(page, "Not decided: {}.", one.found);
        }
        for sentence in self.compared.separating.iter().flat_map(SeparatingExperiment::sentences) {
            let _ = writeln!(page, "{}{}.", sentence[..1].to_uppercase(), &sentence[1..]);
        }
        page.push('\n');
    }

    fn end(&self, page: &mut String) {
        let _ = write!(page, "## What is supported, and what is not\n\n");
        for (what, found) in [("All heights", &self.all), ("50 and 100 cm", &self.judged)] {
            let _ = writeln!(page, "- {what}: `{}`. {}.", found.verdict.id(), found.reasons.join("; "));
        }
        let with_payload = self.all.ranking.iter().filter(|one| one.id.contains('+')).take(8);
        page.push_str("\nThe best sets of all heights:\n\n| set | score | left-out gap, g | reason for rejection |\n|---|---|---|---|\n");
        for one in with_payload {
            let left = one.left_out_g.map_or("-".into(), |gap| format!("{gap:.1}"));
            let _ = writeln!(page, "| {} | {:.0} | {left} | {} |", one.id, one.score, one.reason_rejected.as_deref().unwrap_or("best"));
        }
        page.push_str(
            "\nSupported: a linear spring and damper do not suffice. The missing effect is delayed and keeps its time over the heights.\n\n\
             Not decided: whether the effect is a payload on a spring of its own or feet that touch one after the other, and which further effects\n\
             there are. No set leaves only trial variation at all heights. The parameters of the best sets are at their bounds or change with the\n\
             height. Along the vertical alone, no effect is named.\n\n",
        );
        let _ = writeln!(
            page,
            "With the lateral axes, {}\n",
            if self.landing.named() {
                "a name is supported: the frame lands on one foot first."
            } else {
                "landings on one foot explain single drops and most of the gap at 150 cm, which no fit saw, but not all that\nthe fitted heights show: 3 to 4 ms behind the first touch the frame pushes less than legs with a spring, a damper and dry friction would, at all\nheights. The force of a leg stays unnamed. Mass of the feet, which would ring so, does not hold at 150 cm. Those drops are from another session:\nwhether that is the height or the mounting of the sensor, these drops cannot tell."
            }
        );
        if let Some(next) = self.all.experiments.first() {
            let _ = writeln!(
                page,
                "The experiment that would best distinguish the two best sets: {} (squared distance at most {:.0}, as they are fitted).",
                next.what, next.discrimination
            );
        }
        page.push_str("Two accelerometers, one on the frame and one on the payload, would show a payload mode directly. A switch under each foot would show\n\
             foot stagger.\n");
    }
}

/// Four digits.
fn significant(value: f64) -> String {
    if value.abs() >= 1e5 {
        format!("{value:.2e}")
    } else if value.abs() >= 100.0 {
        format!("{value:.0}")
    } else {
        format!("{value:.2}")
    }
}
