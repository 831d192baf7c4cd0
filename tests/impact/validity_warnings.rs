//! Every effect that is used outside its range of validity gives a warning, and only there.

use crate::bodies;
use flexframe::impact::effects::Model;
use flexframe::impact::sim::{SolverOptions, System, ValidityWarning, simulate};

/// The reasons that an effect gives.
fn reasons(model: &Model, effect: &str, height_m: f64) -> Vec<String> {
    let trace = simulate(&System::new(model), height_m, &SolverOptions::REPORT);
    let of = |warning: ValidityWarning| match warning {
        ValidityWarning::Effect { effect: of, reason } if of == effect => Some(reason),
        _ => None,
    };
    trace.warnings.into_iter().filter_map(of).collect()
}

#[test]
fn planted_effects_beyond_their_validity_warn() {
    let cases: [(&str, &[f64], f64, &str); 14] = [
        ("linear_spring", &[], 3.0, "deeper than the 16 mm"),
        ("linear_damper", &[], 0.3, "at first touch"),
        ("unilateral_contact", &[0.5], 1.0, "real ground never pulls"),
        ("unilateral_contact", &[0.0], 1.0, "is released while"),
        ("bottoming", &[9.0, 3e5, 0.3], 1.0, "the stop is compressed"),
        ("cubic_stiffness", &[-1.5e7], 1.0, "the stiffness is negative"),
        ("bilinear_stiffness", &[5.0, 6e3], 1.0, "the kink at 5.0 mm is passed: real stops have none"),
        ("bilinear_stiffness", &[12.0, -6e3], 0.5, ""),
        ("hunt_crossley_damping", &[-100.0], 1.0, "feeds energy in"),
        ("quadratic_damping", &[-1.0], 1.0, "feeds energy in"),
        ("maxwell_branch", &[4e3, 0.2], 1.0, "more than a decade"),
        ("preload", &[20.0], 1.0, "above x = 0"),
        ("sensor_gain", &[1.2], 1.0, "wrong scale"),
        ("air_drag", &[0.5], 1.0, "more drag"),
    ];
    for (effect, values, height_m, says) in cases {
        let model = if values.is_empty() { bodies::base() } else { bodies::model(&[(effect, values)]) };
        let found = reasons(&model, effect, height_m);
        match says {
            "" => assert!(found.is_empty(), "{effect}: {found:?}"),
            says => assert!(found.len() == 1 && found[0].contains(says), "{effect}: {found:?}"),
        }
    }
    assert!(reasons(&bodies::model(&[("foot_stagger", &[20.0])]), "foot_stagger", 0.1)[0].contains("last foot"));
}

#[test]
fn analytic_effects_within_their_validity_do_not_warn() {
    let within: [(&str, &[f64]); 11] = [
        ("linear_spring", &[]),
        ("bottoming", &[25.0, 3e5, 0.3]),
        ("cubic_stiffness", &[1e6]),
        ("bilinear_stiffness", &[30.0, 6e3]),
        ("hunt_crossley_damping", &[100.0]),
        ("quadratic_damping", &[1.0]),
        ("maxwell_branch", &[4e3, 4.0]),
        ("coulomb_friction", &[5.0]),
        ("sensor_gain", &[0.9]),
        ("foot_stagger", &[2.0]),
        ("air_drag", &[0.05]),
    ];
    for (effect, values) in within {
        let model = if values.is_empty() { bodies::base() } else { bodies::model(&[(effect, values)]) };
        assert_eq!(reasons(&model, effect, 0.5), Vec::<String>::new(), "{effect}");
    }
}
