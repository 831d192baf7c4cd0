//! What is known of each drop explains how drops vary, and what changes with the height is told.

use flexframe::impact::effects::Model;
use flexframe::impact::measured::{DropTable, FileFormat, TableFormat, read_bytes};
use flexframe::impact::request::{DiagnosisRequest, RequestError};
use flexframe::impact::synthetic::{Plan, records};
use flexframe::report::data::diagnosis_data;

/// Drops of which every second one fell on harder ground, each height in a session of its own, how warm each was, and how hard its ground, as a
/// spreadsheet with decimal commas writes it.
fn drops() -> (String, String, String) {
    let plan = Plan::load(concat!(env!("CARGO_MANIFEST_DIR"), "/params/synthetic/bottoming.toml")).expect("comes with the program");
    let plan = Plan { heights_m: vec![0.5, 1.0], drops: 20, ..plan };
    let mut drops = String::from("trial,height_m,t_s,accel_g,ground,session\n");
    let mut warmth = String::from("trial,warm\n");
    let mut hardness = String::from("trial;hard\n");
    for (at, record) in records(&plan).iter().enumerate() {
        let (ground, factor) = if at % 2 == 0 { ("mat", 1.0) } else { ("floor", 1.3) };
        let session = if record.height_m < 0.7 { "monday" } else { "tuesday" };
        for (t_s, accel_g) in record.t_s.iter().zip(&record.accel_g) {
            drops += &format!("{},{},{t_s:.6},{:.5},{ground},{session}\n", record.trial, record.height_m, factor * accel_g);
        }
        warmth += &format!("{},{}\n", record.trial, (at * 7) % 11);
        hardness += &format!("{};{},{:03}\n", record.trial, if at % 2 == 0 { 20 } else { 60 }, at);
    }
    (drops, warmth, hardness)
}

#[test]
fn planted_the_ground_explains_the_variation_and_the_session_is_confounded() {
    let (drops, warmth, hardness) = drops();
    let format = FileFormat { table: TableFormat { kept: vec!["ground".into()], ..TableFormat::default() }, ..FileFormat::default() };
    let mut set = read_bytes(&[("drops.csv".into(), drops.into_bytes())], &format).expect("reads");
    let table = DropTable::read_bytes("warm.csv", warmth.as_bytes()).expect("reads");
    assert_eq!(table.add_to(&mut set), 0);
    let table = DropTable::read_bytes("hard.csv", hardness.as_bytes()).expect("reads");
    assert_eq!(table.add_to(&mut set), 0);
    let request = |covariates| DiagnosisRequest {
        model: Model::load("paper").expect("comes with the program"),
        drops: &set,
        axes: None,
        hold_out_heights_m: &[],
        static_test: None,
        covariates,
        max_effects: 1,
        seed: 1,
    };
    let unknown = ["mood".to_string()];
    let refused = request(&unknown).diagnosed(&|_| ()).map(|_| ()).expect_err("no drop has it");
    assert_eq!(refused, RequestError::NoSuchColumn { name: "mood".into() });
    let asked = ["ground".to_string(), "warm".to_string(), "hard".to_string()];
    let (found, compared) = request(&asked).diagnosed(&|_| ()).expect("a diagnosis");
    let json = diagnosis_data::json(&found, &compared);
    let covariate = |id: &str| {
        let all = json["covariates"].as_array().expect("a list");
        all.iter().find(|one| one["id"] == id).unwrap_or_else(|| panic!("no {id} in {all:?}")).clone()
    };
    let number = |id: &str, key: &str| covariate(id)[key].as_f64().unwrap_or(f64::NAN);
    assert!(number("ground", "explained") > 0.3 && number("ground", "p") < 0.01, "{}", json["covariates"]);
    assert!(number("hard", "explained") > 0.3 && number("hard", "p") < 0.01, "{}", json["covariates"]);
    assert!(number("warm", "explained") < 0.1 && number("trial", "explained") < 0.1, "{}", json["covariates"]);
    assert!(covariate("session")["explained"].is_null() && covariate("session")["p"].is_null());
    assert_eq!(json["confounding"].as_array().map(Vec::len), Some(1));
    assert_eq!(json["confounding"][0]["with"], "session");
    assert!(json["separating_experiment"]["what"].as_str().is_some_and(|what| what.contains("in one session")));
}
