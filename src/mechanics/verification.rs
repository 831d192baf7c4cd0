//! Cases with known answers: the solver against the literature.

use nalgebra::{Rotation3, Vector3};

use crate::mechanics::element::beam::{Beam, Rigidity};
use crate::mechanics::solve::statics::{Command, Path, Precision};
use crate::mechanics::system::equation_system::System;
use crate::mechanics::system::structure::{Node, Structure};

/// A chain of equal beams over points, the first node clamped.
fn chain(points: &[Vector3<f64>], aside: Vector3<f64>, rigidity: &Rigidity) -> Structure {
    let mut nodes: Vec<Node> = points.iter().map(|p| Node::at(*p)).collect();
    nodes[0].held = [true; 6];
    let beams: Vec<Beam> =
        (1..points.len()).map(|at| Beam::new([at - 1, at], [points[at - 1], points[at]], aside, rigidity).expect("has a length")).collect();
    let viscous = vec![false; beams.len()];
    Structure { nodes, beams, viscous, ..Structure::default() }
}

fn along_x(length: f64, elements: usize) -> Vec<Vector3<f64>> {
    (0..=elements).map(|at| Vector3::new(length * at as f64 / elements as f64, 0.0, 0.0)).collect()
}

/// Places of all nodes when a load, over unknowns named by node and direction, has grown to a factor of `target`.
fn loaded(structure: Structure, load: &[(usize, usize, f64)], target: f64, steps: usize) -> Vec<Vector3<f64>> {
    let system = System::new(structure).expect("is a system");
    let mut force = vec![0.0; system.unknowns.size()];
    for (node, direction, value) in load {
        force[system.unknowns.of(*node)[*direction]] = *value;
    }
    let mut state = system.rest();
    let (mut work, mut sum, bias) = (system.pattern.work(), crate::mechanics::system::equation_system::Sum::default(), system.elastic());
    for step in 1..=steps {
        let factor = target * step as f64 / steps as f64;
        for iteration in 0.. {
            assert!(iteration < 30, "step {step} does not converge");
            system.assemble(&state, &bias, &mut sum);
            let mut left: Vec<f64> = force.iter().zip(&sum.force).map(|(q, f)| factor * q - f).collect();
            if left.iter().fold(0.0_f64, |m, f| m.max(f.abs())) < 1e-9 * target.abs().max(1.0) {
                break;
            }
            system.pattern.factorise(&sum.tangent, &mut work).expect("is regular");
            system.pattern.solve(&mut work, &mut left);
            state.moved(&system.unknowns, &left);
        }
    }
    state.places
}

fn stiff_in_shear(bending: f64) -> Rigidity {
    Rigidity { axial_n: 1e6, shear_n: [1e12; 2], torsion_n_mm2: bending, bending_n_mm2: [bending; 2] }
}

#[test]
fn analytic_a_short_cantilever_gives_way_in_bending_and_shear() {
    let rigidity = Rigidity { axial_n: 1e6, shear_n: [800.0, 500.0], torsion_n_mm2: 1e4, bending_n_mm2: [3e4, 2e4] };
    for (direction, bending, shear) in [(1, 2e4, 800.0), (2, 3e4, 500.0)] {
        let places = loaded(chain(&along_x(10.0, 3), Vector3::y(), &rigidity), &[(3, direction, 1.0)], 1e-3, 1);
        let exact = 1e-3 * (1000.0 / (3.0 * bending) + 10.0 / shear);
        assert!((places[3][direction] / exact - 1.0).abs() < 1e-7, "{} {exact}", places[3][direction]);
    }
}

#[test]
fn analytic_an_end_moment_rolls_a_cantilever_into_a_circle() {
    let (length, bending) = (10.0, 100.0);
    let moment = std::f64::consts::TAU * bending / length;
    let places = loaded(chain(&along_x(length, 10), Vector3::y(), &stiff_in_shear(bending)), &[(10, 5, 1.0)], moment, 10);
    // Straight elements between nodes on a circle: each turns by a tenth of it, and the ring closes.
    assert!(places[10].norm() < 1e-9, "{}", places[10]);
    let widest = places.iter().map(|p| p.y).fold(0.0, f64::max);
    assert!((widest / (length / std::f64::consts::PI) - 1.0).abs() < 0.04, "{widest}");
}

/// Bisshopp and Drucker, Large deflection of cantilever beams, Quart. Appl. Math. 3 (1945) 272; table of K. Mattiasson, Int. J.
/// Numer. Meth. Engng 17 (1981) 145: P L²/EI = 10 gives u/L = 0.55500, w/L = 0.81061.
#[test]
fn analytic_the_elastica_under_an_end_force_and_its_refinement() {
    let error = |elements: usize| {
        let places = loaded(chain(&along_x(1.0, elements), Vector3::y(), &stiff_in_shear(1.0)), &[(elements, 1, 1.0)], 10.0, 10);
        let tip = places[elements];
        (1.0 - tip.x - 0.55500).abs().max((tip.y - 0.81061).abs())
    };
    let [coarse, middle, fine] = [8, 16, 32].map(error);
    assert!(middle < 0.3 * coarse && fine < 0.3 * middle && fine < 2e-4, "{coarse} {middle} {fine}");
}

/// K.-J. Bathe, S. Bolourchi, Int. J. Numer. Meth. Engng 14 (1979) 961: a bend of 45° and radius 100, 1 by 1, E = 1e7, ν = 0,
/// 600 at the tip. Published displacements differ in the second figure: -13.4, -23.5, 53.4 there; -13.50, -23.48, 53.37 with eight
/// elements (J. C. Simo, L. Vu-Quoc 1986); -13.72, -23.65, 53.58 by spectral elements (documentation of kynema).
#[test]
fn analytic_a_bend_of_45_degrees_under_600() {
    let rigidity =
        Rigidity { axial_n: 1e7, shear_n: [1e7 / 2.0 * 5.0 / 6.0; 2], torsion_n_mm2: 1e7 / 12.0, bending_n_mm2: [1e7 / 12.0; 2] };
    let tip = |elements: usize| {
        let point = |at: usize| {
            let angle = std::f64::consts::FRAC_PI_4 * at as f64 / elements as f64;
            Vector3::new(100.0 * (1.0 - libm::cos(angle)), 100.0 * libm::sin(angle), 0.0)
        };
        let points: Vec<_> = (0..=elements).map(point).collect();
        loaded(chain(&points, Vector3::z(), &rigidity), &[(elements, 2, 1.0)], 600.0, 6)[elements] - points[elements]
    };
    let [coarse, middle, fine] = [8, 16, 32].map(tip);
    for published in [[-13.4, -23.5, 53.4], [-13.50, -23.48, 53.37], [-13.72, -23.65, 53.58]] {
        assert!((coarse - Vector3::from(published)).amax() < 0.2, "{coarse} {published:?}");
    }
    assert!((fine - middle).norm() < 0.3 * (middle - coarse).norm(), "{coarse} {middle} {fine}");
}

/// R. von Mises 1923: two bars, half span b, rise a; P = 2 E A (l₀ - l) / l₀ · (a - w) / l with l of the moment, exact for bars
/// whose stretch is small against their length as the beam's own measure is the change of length over the length at rest.
#[test]
fn analytic_a_shallow_truss_snaps_through() {
    let (half, rise) = (100.0, 10.0);
    let rigidity = Rigidity { axial_n: 1000.0, shear_n: [1e3; 2], torsion_n_mm2: 1e-3, bending_n_mm2: [1e-3; 2] };
    let points = [Vector3::zeros(), Vector3::new(half, 0.0, rise)];
    let mut structure = chain(&points, Vector3::y(), &rigidity);
    structure.nodes[0].held = [true, true, true, true, false, true];
    structure.nodes[1].held = [true, true, false, true, true, true];
    let system = System::new(structure).expect("is a system");
    let unknown = system.unknowns.of(1)[2];
    let mut load = vec![0.0; system.unknowns.size()];
    load[unknown] = 1.0;
    let mut path = Path::new(&system, Command { load, unknown }, system.rest(), Precision::default());
    let rest = libm::hypot(half, rise);
    for at in 1..=24 {
        let w = at as f64;
        let balance = path.go(-w).expect("is found");
        let now = libm::hypot(half, rise - w);
        let exact = 1000.0 * (rest - now) / rest * (rise - w) / now;
        // The bars' ends are hinged on one side; the little bending stiffness of the other leaves 1e-6 of a newton.
        assert!((-balance.load - exact).abs() < 2e-5, "{w}: {} {exact}", -balance.load);
        assert_eq!(balance.unstable, usize::from((4.3..=15.7).contains(&w)), "{w}");
    }
}

/// F. W. Williams, Quart. J. Mech. Appl. Math. 17 (1964) 451: clamped toggle, half span 12.943, rise 0.386, 0.753 by 0.243, E =
/// 1.03e7 (inch, pound): the load has a plateau at about 34.
#[test]
fn analytic_williams_toggle_gives_way_at_about_34() {
    let (width, height, modulus) = (0.753, 0.243, 1.03e7);
    let inertia = width * height * height * height / 12.0;
    let other = height * width * width * width / 12.0;
    let rigidity = Rigidity {
        axial_n: modulus * width * height,
        shear_n: [modulus / 2.6 * width * height * 5.0 / 6.0; 2],
        torsion_n_mm2: modulus * inertia,
        bending_n_mm2: [modulus * inertia, modulus * other],
    };
    let points: Vec<_> = (0..=10).map(|at| Vector3::new(12.943, 0.0, 0.386) * (at as f64 / 10.0)).collect();
    let mut structure = chain(&points, Vector3::y(), &rigidity);
    structure.nodes[10].held = [true, true, false, true, true, true];
    let system = System::new(structure).expect("is a system");
    let unknown = system.unknowns.of(10)[2];
    let mut load = vec![0.0; system.unknowns.size()];
    load[unknown] = 0.5;
    let mut path = Path::new(&system, Command { load, unknown }, system.rest(), Precision::default());
    let forces: Vec<f64> = (1..=30).map(|at| -path.go(-0.02 * at as f64).expect("is found").load).collect();
    let peak = forces[..20].iter().copied().fold(0.0, f64::max);
    assert!((peak - 34.3).abs() < 0.7, "{peak} {forces:?}");
    assert!(forces[29] > forces[20], "it stiffens again: {forces:?}");
}

/// A portal of two columns and a beam, feet clamped, a side force H at one top: S. Timoshenko's slope deflection. Columns h, EI;
/// beam b, EI: sway H h³ / (12 EI) · (2 + 3 k') / (1 + 6 k') · … with k' = h / b for equal sections: δ = H h³ (3 + 2 b'/…)
/// Here solved as 3 by 3 slope-deflection equations by hand, for b = h: δ = 5 H h³ / (84 EI).
#[test]
fn analytic_a_portal_frame_sways() {
    let (h, bending) = (50.0, 4e4);
    let rigid = Rigidity { axial_n: 1e7, shear_n: [1e9; 2], torsion_n_mm2: bending, bending_n_mm2: [bending; 2] };
    let points = [Vector3::zeros(), Vector3::new(0.0, 0.0, h), Vector3::new(h, 0.0, h), Vector3::new(h, 0.0, 0.0)];
    let mut structure = chain(&points, Vector3::y(), &rigid);
    structure.nodes[3].held = [true; 6];
    let places = loaded(structure, &[(1, 0, 1.0)], 1e-3, 1);
    let exact = 1e-3 * 5.0 * h * h * h / (84.0 * bending);
    assert!((places[1].x / exact - 1.0).abs() < 1e-4, "{} {exact}", places[1].x);
}

#[test]
fn analytic_turned_in_space_nothing_changes() {
    let rigidity = Rigidity { axial_n: 1e4, shear_n: [3e3; 2], torsion_n_mm2: 90.0, bending_n_mm2: [100.0, 60.0] };
    let tip = |turn: Rotation3<f64>| {
        let points: Vec<_> = along_x(10.0, 5).iter().map(|p| turn * p).collect();
        let force = turn * Vector3::new(-2.0, 3.0, 1.0);
        let load: Vec<_> = (0..3).map(|i| (5, i, force[i])).collect();
        turn.inverse() * loaded(chain(&points, turn * Vector3::y(), &rigidity), &load, 1.0, 4)[5]
    };
    let turned = tip(Rotation3::from_euler_angles(0.7, -1.1, 2.3));
    assert!((tip(Rotation3::identity()) - turned).norm() < 1e-8, "{turned}");
}
