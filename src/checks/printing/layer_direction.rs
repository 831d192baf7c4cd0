//! No hinge is strained across its layers, as its part lies on the bed.
//!
//! A web is stretched from its still side to its moving one, square to the axis of the bend. Printed flat that direction
//! lies in the layers, whichever way the part is turned on the bed; printed upright it pulls the layers apart. A neck that
//! twists is stretched by 45° to its axis in its broad faces, which lie in the xy plane of the part. Of a strain ε at an
//! angle α out of the layers ε sin² α acts across them; it may be what the material bears there over the same factor as
//! along the layers. What is not known to stretch across layers is taken not to.

use nalgebra::Vector3;

use crate::checks::finding::Finding;
use crate::checks::measure::Measure;
use crate::checks::rule::{Blame, Found, InSearch, Levers, Limit, Pass, Rule};
use crate::checks::scene::Scene;
use crate::frame::assembly::Printed;
use crate::frame::fold;
use crate::frame::fold::HingeLoad;
use crate::params::Frame;
use crate::solid::Bend;

const LEVERS: &[&str] = &["materials.flexible"];

pub static RULE: Rule = Rule {
    id: "layer_direction",
    title: "Direction of layers",
    requires: "no hinge is strained across its layers beyond the limit of its material",
    units: &["%"],
    limits: &[Limit::Material],
    levers: Levers::Sets(&[LEVERS]),
    blame: Blame::Levers,
    in_search: InSearch::Constraints { subjects: &[""], binds: true },
    found: Found::By(&[Pass::quick(check)]),
};

/// Strain that is none, %: rounding.
const NONE_PERCENT: f64 = 1e-9;

/// Directions of a hinge's largest stretch, in the part's own axes.
fn stretched(bend: &Bend) -> Vec<Vector3<f64>> {
    match bend {
        Bend::Web { outward, .. } => vec![outward.into_inner()],
        Bend::Necks { axis, .. } => {
            let across = axis.cross(&Vector3::z());
            [1.0, -1.0].map(|side| (axis.into_inner() + across * side).normalize()).to_vec()
        }
    }
}

fn strain_percent(bend: &Bend, frame: &Frame) -> f64 {
    let HingeLoad { strain_percent, .. } = match bend {
        Bend::Web { angle, .. } => fold::web(frame, *angle),
        Bend::Necks { angle, .. } => fold::necks(frame, *angle),
    };
    strain_percent
}

fn finding(part: &Printed, at: usize, bend: &Bend, frame: &Frame) -> Finding {
    let upwards = stretched(bend).iter().map(|s| (part.print_pose.rotation * s).z.abs()).fold(0.0, f64::max).min(1.0);
    let along = strain_percent(bend, frame);
    let across = along * upwards * upwards;
    let value = if across < NONE_PERCENT { 0.0 } else { across };
    let bears = frame.flexible.material.elongation_across_layers_percent.unwrap_or(0.0);
    let limit = bears / frame.limits.hinge_strain_factor;
    let measure = Measure { rule: RULE.id, value, limit, unit: "%", levers: LEVERS };
    let [strain, allowed] = measure.figures(0);
    let (name, angle) = (part.name, libm::asin(upwards).to_degrees());
    let what = match (part.bends.len(), at) {
        (1, _) => name.to_string(),
        (_, at) => format!("{name}, hinge {}", at + 1),
    };
    let message = format!(
        "{what}: its strain of {along:.0} % lies {angle:.0} deg out of the layers as printed, {strain} % pull them apart, {allowed} % are allowed; \
         printed flat, layers lie along the bend"
    );
    measure.at_most(what, message)
}

pub(in crate::checks) fn check(scene: &Scene) -> Vec<Finding> {
    let frame = &scene.design.frame;
    let of = |part: &Printed| -> Vec<Finding> { part.bends.iter().enumerate().map(|(at, bend)| finding(part, at, bend, frame)).collect() };
    scene.design.printed.iter().flat_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::{Planted, violated};
    use nalgebra::UnitQuaternion;

    /// Every part turned out of its print orientation.
    fn turned(axis: Vector3<f64>) -> Vec<Finding> {
        let mut frame = Planted::preset("cognifly");
        let turn = UnitQuaternion::from_axis_angle(&nalgebra::Unit::new_normalize(axis), std::f64::consts::FRAC_PI_2);
        for part in &mut frame.design.printed {
            part.print_pose.rotation = turn * part.print_pose.rotation;
        }
        frame.found(check)
    }

    #[test]
    fn analytic_flat_parts_are_strained_along_their_layers() {
        let found = Planted::preset("cognifly").found(check);
        assert!(found.len() == 4 && found.iter().all(|f| f.value == 0.0), "{found:?}");
        // Turned about the vertical they still are.
        assert!(turned(Vector3::z()).iter().all(|f| f.value == 0.0));
    }

    #[test]
    fn planted_parts_printed_upright_are_strained_across() {
        // The strut lies along the diagonal of x and y: upright by half of the sine's square.
        let along = Planted::preset("cognifly").found(crate::checks::hinge::check)[0].value;
        let found = turned(Vector3::x());
        assert!((found[0].value - 0.5 * along).abs() < 1e-6, "{found:?}");
        // The leg's web and the necks fold so little that even across layers they hold.
        let broken: Vec<String> = violated(&found).into_iter().map(|f| f.subject).collect();
        assert_eq!(broken, ["top_corner", "bottom_corner, hinge 1"]);
    }

    #[test]
    fn planted_a_bend_axis_along_the_vertical_is_as_good() {
        // A web's axis upright: the stretch lies in the layers.
        let axis = (Vector3::x() + Vector3::y()).normalize();
        assert!(turned(axis)[0].value < 1e-9);
    }
}
