//! Whole frames against every rule.

use super::*;
use crate::assembly::mass;
use crate::params::Frame;

#[test]
#[ignore = "prints"]
fn show_all() {
    for preset in ["cognifly", "cognifly-v8", "cognifly-1106", "cognifly-bamboo", "cognifly-mini", "cognifly-2s2000"] {
        let (frame, _) = Frame::load(preset).expect("a preset");
        let design = Design::new(frame).expect("closes");
        let masses = mass::table(&design);
        let t = std::time::Instant::now();
        let scene = Scene::new(&design, &masses);
        println!("== {preset}: scene {:?}", t.elapsed());
        for rule in RULES {
            let t = std::time::Instant::now();
            let found = rule(&scene);
            println!("   {} {:?}", found.first().map_or("", |f| f.rule), t.elapsed());
        }
        let t = std::time::Instant::now();
        let found = check(&design, &masses);
        println!("== {preset}: {:?}, {} findings", t.elapsed(), found.len());
        for f in found {
            println!(
                "{:?} {} [{}] {:.4} vs {:.4} {} margin {:.4}: {}",
                f.verdict, f.rule, f.subject, f.value, f.limit, f.unit, f.margin, f.message
            );
        }
    }
}
