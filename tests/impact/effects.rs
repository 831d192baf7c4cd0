//! Each effect against a closed form or against another integrator; off means off; energies; order of convergence.

use crate::bodies::{C, G, K, MASS_KG, Table, base, model, reference};
use flexframe::impact::effects::{CATALOGUE, Model, by_id, candidates};
use flexframe::impact::sim::{Balance, SolverOptions, Stop, System, Trace, ValidityWarning, simulate, wave};

/// Each effect that acts after first touch at a plain strength, and until when the second writing of it holds, s.
const CASES: [(&str, &[f64], f64); 13] = [
    ("linear_spring", &[K], 0.025),
    ("unilateral_contact", &[0.0], 0.025),
    ("unilateral_contact", &[0.4], 0.025),
    ("bottoming", &[9.0, 1e6, 0.3], 0.025),
    ("cubic_stiffness", &[3e7], 0.025),
    ("bilinear_stiffness", &[8.0, 2e4], 0.025),
    ("hunt_crossley_damping", &[5e3], 0.025),
    ("coulomb_friction", &[20.0], 0.025),
    ("maxwell_branch", &[1e4, 3.0], 0.025),
    ("quadratic_damping", &[10.0], 0.025),
    ("preload", &[40.0], 0.012),
    ("sensor_low_pass", &[120.0], 0.025),
    ("payload_mode", &[0.3, 120.0, 0.05], 0.025),
];

fn dropped(model: &Model, height_m: f64) -> Trace {
    simulate(&System::new(model), height_m, &SolverOptions::REPORT)
}

/// Compression and reading at a time of the series.
fn at(trace: &Trace, t_s: f64) -> [f64; 2] {
    let index = (t_s / Trace::STEP_S).round() as usize;
    [trace.x_m[index], trace.sensor_g[index]]
}

fn assert_agrees(effects: &[(&str, &[f64])], height_m: f64, t_s: f64) {
    let [x_m, reading_g] = at(&dropped(&model(effects), height_m), t_s);
    let [expected_m, expected_g] = reference(Table::new(effects), height_m, t_s);
    assert!((x_m - expected_m).abs() < 2e-9, "{effects:?}: {x_m} m, expected {expected_m} m");
    assert!((reading_g - expected_g).abs() < 2e-5, "{effects:?}: {reading_g} g, expected {expected_g} g");
}

#[test]
fn analytic_each_effect_agrees_with_another_integrator() {
    for (id, values, until_s) in CASES {
        for height_m in [0.5, 1.5] {
            assert_agrees(&[(id, values)], height_m, until_s);
        }
    }
}

#[test]
fn analytic_staggered_feet_agree_with_another_integrator() {
    // On the way down the largest compression so far is the compression.
    assert_agrees(&[("foot_stagger", &[8.0])], 1.0, 0.005);
}

#[test]
fn analytic_all_effects_together_agree_with_another_integrator() {
    let all: [(&str, &[f64]); 12] = [
        ("unilateral_contact", &[0.0]),
        ("bottoming", &[11.0, 3e5, 0.2]),
        ("cubic_stiffness", &[5e6]),
        ("bilinear_stiffness", &[6.0, 4e3]),
        ("hunt_crossley_damping", &[1e3]),
        ("coulomb_friction", &[8.0]),
        ("maxwell_branch", &[4e3, 4.0]),
        ("quadratic_damping", &[3.0]),
        ("preload", &[15.0]),
        ("sensor_low_pass", &[300.0]),
        ("payload_mode", &[0.2, 150.0, 0.1]),
        ("foot_stagger", &[4.0]),
    ];
    assert_agrees(&all, 1.5, 0.0035);
    assert_agrees(&all[..11], 1.5, 0.02);
}

#[test]
fn analytic_linear_damped_spring() {
    let trace = dropped(&base(), 1.0);
    let (omega, decay) = ((K / MASS_KG).sqrt(), 0.5 * C / MASS_KG);
    let damped = (omega * omega - decay * decay).sqrt();
    let (rest, v0) = (MASS_KG * G / K, (2.0 * G).sqrt());
    let position = |t: f64| {
        let swing = (v0 - decay * rest) / damped * libm::sin(damped * t) - rest * libm::cos(damped * t);
        rest + libm::exp(-decay * t) * swing
    };
    for (t_s, x_m) in trace.t_s.iter().zip(&trace.x_m) {
        assert!((x_m - position(*t_s)).abs() < 1e-10, "{t_s} s: {x_m} m, expected {} m", position(*t_s));
    }
    assert!((trace.peaks.expect("it does not diverge").coordinate_g - (C * v0 / MASS_KG - G) / G).abs() < 1e-9, "largest at first touch");
    // x' = 0 and F = 0 by their own formulae.
    let slope = |t: f64| (position(t + 1e-6) - position(t - 1e-6)) / 2e-6;
    let turn_s = trace.compression.as_ref().expect("it turns").t_ms * 1e-3;
    assert!(slope(turn_s).abs() < 1e-6, "{}", slope(turn_s));
    assert!((trace.max_displacement_m.expect("it turns") - position(turn_s)).abs() < 1e-10);
    let release_s = trace.contact_s.expect("the force ends");
    assert!((K * position(release_s) + C * slope(release_s)).abs() < 1e-5);
}

/// Energy that an effect has stored at a compression, J.
type Stored = fn(f64) -> f64;

#[test]
fn analytic_springs_turn_where_energy_says() {
    let undamped = |effects: &[(&str, &[f64])]| {
        let model = effects.iter().fold(base(), |model, (id, values)| model.with(by_id(id).expect("known"), values, 0));
        model.with(by_id("linear_damper").expect("known"), &[0.0], 0)
    };
    let cases: [(&str, &[f64], Stored); 4] = [
        ("bottoming", &[9.0, 1e6, 0.0], |x| 0.4 * 1e6 * (x - 0.009_f64).max(0.0).powf(2.5)),
        ("cubic_stiffness", &[3e7], |x| 0.25 * 3e7 * x.powi(4)),
        ("bilinear_stiffness", &[8.0, 2e4], |x| 0.5 * 2e4 * (x - 0.008_f64).max(0.0).powi(2)),
        ("preload", &[40.0], |x| 40.0 * 0.2e-3 * (x / 0.2e-3).cosh().ln()),
    ];
    for (id, values, stored_j) in cases {
        let x_m = dropped(&undamped(&[(id, values)]), 0.7).max_displacement_m.expect("it turns");
        let ratio = (0.5 * K * x_m * x_m + stored_j(x_m)) / (MASS_KG * G * (0.7 + x_m));
        assert!((ratio - 1.0).abs() < 1e-9, "{id}: {ratio}");
    }
}

#[test]
fn analytic_quadratic_damping_stops_where_its_solution_does() {
    let with = model(&[("quadratic_damping", &[20.0])]).with(by_id("linear_damper").expect("known"), &[0.0], 0);
    let x_m = dropped(&with, 1.0).max_displacement_m.expect("it turns");
    // u = v² obeys u' + a u = 2 g - b x.
    let (a, b) = (2.0 * 20.0 / MASS_KG, 2.0 * K / MASS_KG);
    let (q, u0) = (-b / a, 2.0 * G);
    let p = (2.0 * G - q) / a;
    let u = p + q * x_m + (u0 - p) * libm::exp(-a * x_m);
    assert!(u.abs() < 1e-8 * u0, "{u}");
}

#[test]
fn analytic_a_drop_that_diverges_has_no_peaks() {
    // Without the damper, drag that feeds energy in outweighs everything.
    let fed = model(&[("quadratic_damping", &[-20.0])]).with(by_id("linear_damper").expect("known"), &[0.0], 0);
    let trace = dropped(&fed, 2.0);
    assert!(matches!(trace.stop, Stop::Diverges { .. }), "{:?}", trace.stop);
    assert_eq!(trace.peaks, None);
    assert!(trace.warnings.iter().any(|warning| matches!(warning, ValidityWarning::Diverges { .. })), "{:?}", trace.warnings);
}

#[test]
fn analytic_a_frame_that_is_let_go_flies_at_exactly_0_g() {
    let trace = dropped(&model(&[("unilateral_contact", &[0.0])]), 1.0);
    let release = trace.release.as_ref().expect("it leaves");
    let (t0, x0) = (release.t_ms * 1e-3, release.x_mm * 1e-3);
    let v0 = -(2.0 * release.kinetic_j / MASS_KG).sqrt();
    let mut flown = 0;
    for (i, t_s) in trace.t_s.iter().enumerate().filter(|(_, t_s)| **t_s > t0) {
        let t = t_s - t0;
        if trace.proper_g[i] != 0.0 {
            assert!(trace.x_m[i] > 0.0 && trace.x_m[i] < 1e-3 + x0, "pushed in flight at {t_s}");
            continue;
        }
        assert!((trace.x_m[i] - (x0 + v0 * t + 0.5 * G * t * t)).abs() < 1e-9);
        flown += 1;
    }
    assert!(flown > 400, "{flown}");
    // Single effects have validity warnings of their own; the drop itself has none.
    assert!(trace.warnings.iter().all(|warning| matches!(warning, ValidityWarning::Effect { .. })), "{:?}", trace.warnings);
}

#[test]
fn analytic_the_first_foot_alone_is_a_quarter_of_the_base() {
    let staggered = dropped(&model(&[("foot_stagger", &[18.0])]), 0.3);
    let quarter = base().with(by_id("linear_spring").expect("known"), &[K / 4.0], 0);
    let quarter = dropped(&quarter.with(by_id("linear_damper").expect("known"), &[C / 4.0], 0), 0.3);
    let before = staggered.x_m.iter().position(|x_m| *x_m > 0.006).expect("the second touches");
    assert!(before > 40);
    for i in 0..before {
        assert!((staggered.x_m[i] - quarter.x_m[i]).abs() < 1e-11);
    }
}

#[test]
fn analytic_sensor_and_fall_effects() {
    let plain = dropped(&base(), 1.0);
    let gained = dropped(&model(&[("sensor_gain", &[0.8])]), 1.0);
    let clipped = dropped(&model(&[("sensor_saturation", &[30.0])]), 1.0);
    for (i, reading_g) in plain.sensor_g.iter().enumerate() {
        assert!((gained.sensor_g[i] - 0.8 * reading_g).abs() < 1e-12);
        assert_eq!(clipped.sensor_g[i], reading_g.clamp(-30.0, 30.0));
    }
    assert_eq!(clipped.peaks.expect("it does not diverge").sensor_g, 30.0);
    assert_eq!(dropped(&model(&[("drop_height_error", &[0.25])]), 0.75).sensor_g, plain.sensor_g);
    let braked = dropped(&model(&[("air_drag", &[0.3])]), 1.0);
    let height_m = G / 0.3 * (1.0 - libm::exp(-0.6)) / (2.0 * G);
    let lower = dropped(&base(), height_m);
    assert!(braked.sensor_g.iter().zip(&lower.sensor_g).all(|(a, b)| (a - b).abs() < 1e-9));
    assert!((braked.compression.as_ref().expect("turns").air_j - MASS_KG * G * (1.0 - height_m)).abs() < 1e-12);
}

/// The values that switch an effect off.
fn off(id: &str) -> Vec<f64> {
    match id {
        "sensor_low_pass" => vec![500.0],
        "sensor_saturation" => vec![250.0],
        _ => {
            let parameters = by_id(id).expect("known").parameters;
            parameters.iter().map(|p| p.off.unwrap_or(0.5 * (p.min + p.max))).collect()
        }
    }
}

#[test]
fn analytic_an_effect_that_is_off_changes_no_bit() {
    let mut plain = base();
    plain.sensor.limit_g = 230.0;
    let mut all = plain.clone();
    let expected = dropped(&plain, 1.5);
    let mut expected_wave = vec![0.0; 1201];
    wave(&System::new(&plain), 1.5, 5e-5, &SolverOptions::FIT, &mut expected_wave);
    let mut cases = Vec::new();
    for spec in candidates(&CATALOGUE, &plain) {
        cases.push((spec.id, plain.clone().with(spec, &off(spec.id), 0)));
        all = all.with(spec, &off(spec.id), 0);
    }
    cases.push(("all of them", all));
    for (id, model) in cases {
        let trace = dropped(&model, 1.5);
        assert!(trace.x_m == expected.x_m && trace.v_m_s == expected.v_m_s && trace.sensor_g == expected.sensor_g, "{id}");
        assert!(trace.proper_g == expected.proper_g && trace.compression == expected.compression, "{id}");
        let mut found = vec![0.0; 1201];
        wave(&System::new(&model), 1.5, 5e-5, &SolverOptions::FIT, &mut found);
        assert!(found == expected_wave, "{id}");
    }
}

#[test]
fn analytic_the_gap_moves_nothing() {
    let wide = dropped(&base(), 1.5);
    let mut narrow = base();
    narrow.body.gap_m = 0.004;
    let narrow = dropped(&narrow, 1.5);
    assert!(wide.x_m == narrow.x_m && wide.sensor_g == narrow.sensor_g);
    let balance = narrow.compression.expect("the gap is used up");
    assert!((balance.x_mm - 4.0).abs() < 1e-9 && balance.collision_j > 0.0 && balance.kinetic_j == 0.0);
}

#[test]
fn analytic_the_ground_s_work_takes_what_fell() {
    // By the trapezoids of the series up to its last point on the way down: the speed there is what the ground's work leaves of the fall.
    for effects in [&[][..], &[("preload", &[40.0][..])], &[("payload_mode", &[0.3, 120.0, 0.05][..])]] {
        let trace = dropped(&model(effects), 1.0);
        let last = trace.v_m_s.iter().position(|v_m_s| *v_m_s < 0.0).expect("turns") - 1;
        let work_j: f64 =
            (0..last).map(|at| 0.5 * (trace.ground_n[at] + trace.ground_n[at + 1]) * (trace.x_m[at + 1] - trace.x_m[at])).sum();
        let left_j = 0.5 * MASS_KG * (trace.impact_speed_m_s.powi(2) - trace.v_m_s[last].powi(2)) + MASS_KG * G * trace.x_m[last];
        if effects.first().is_some_and(|(id, _)| *id == "payload_mode") {
            // A payload that lags behind falls farther, and moves itself.
            assert!(work_j < left_j && work_j > 0.5 * left_j, "{work_j} J of {left_j} J");
        } else {
            // A preload sets in within the first step of the series: half of its work there is what trapezoids may miss.
            let missed_j = effects.first().map_or(0.0, |(_, values)| 0.5 * values[0] * trace.x_m[1]);
            assert!((work_j - left_j).abs() < 1e-4 * left_j + missed_j, "{effects:?}: {work_j} J, expected {left_j} J");
            let most = trace.ground_n.iter().zip(&trace.proper_g).map(|(n, g)| (n - MASS_KG * G * g).abs()).fold(0.0, f64::max);
            assert!(most < 1e-9, "{effects:?}: {most} N between force and mass times acceleration");
        }
    }
}

#[test]
fn analytic_energies_balance_and_each_work_has_its_formula() {
    for (id, values, _) in CASES.into_iter().chain([("foot_stagger", &[8.0][..], 0.0), ("air_drag", &[0.2][..], 0.0)]) {
        let trace = dropped(&model(&[(id, values)]), 1.2);
        let balances: Vec<&Balance> = trace.compression.iter().chain(&trace.release).collect();
        assert!(!balances.is_empty());
        for balance in balances {
            assert!(balance.residual().abs() < 1e-8, "{id}: {}", balance.residual());
            let spring = &balance.terms[0];
            // Of a spring without a switch the work is what is stored; only the quadrature knows the one.
            assert!(spring.dissipated_j.abs() < 1e-8 || id == "foot_stagger" || id == "unilateral_contact", "{id}: {spring:?}");
        }
    }
}

#[test]
fn analytic_fits_are_as_good_as_stated() {
    let worst = |id: &str, values: &[f64]| {
        let system = System::new(&model(&[(id, values)]));
        let mut quick = vec![0.0; 1201];
        assert_eq!(wave(&system, 2.0, 5e-5, &SolverOptions::FIT, &mut quick), Stop::End);
        let exact = simulate(&system, 2.0, &SolverOptions::REPORT);
        quick.iter().zip(&exact.sensor_g).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    for (id, values, _) in CASES {
        let error_g = worst(id, values);
        assert!(error_g < 0.005, "{id}: {error_g} g");
    }
}

#[test]
fn analytic_the_order_stays_five_across_switches() {
    let switched = model(&[("unilateral_contact", &[0.0]), ("bilinear_stiffness", &[8.0, 2e4]), ("foot_stagger", &[5.0])]);
    let system = System::new(&switched);
    let position = |fixed_step_s: Option<f64>| {
        let trace = simulate(&system, 1.0, &SolverOptions { fixed_step_s, ..SolverOptions::REPORT });
        at(&trace, 0.02)[0]
    };
    let exact = position(None);
    let errors = [8e-4, 4e-4, 2e-4].map(|step_s| (position(Some(step_s)) - exact).abs());
    let order = libm::log2(errors[0] / errors[2]) / 2.0;
    assert!(order > 4.5, "{order}: {errors:?}");
}
