//! Where a function changes its sign, and where it is largest, within a bracket.

/// Bracket below which a root counts as found.
const WIDTH: f64 = 1e-14;

/// A root of a function with different signs at both ends (Illinois' rule, with a bisection when it is slow). When the
/// signs agree the left end: rounding has put it on the far side already.
pub(super) fn root(mut left: f64, mut right: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut at_left, mut at_right) = (f(left), f(right));
    if at_left == 0.0 || (at_left > 0.0) == (at_right > 0.0) {
        return left;
    }
    for turn in 0..100 {
        if (right - left).abs() < WIDTH || at_right == 0.0 {
            break;
        }
        let secant = right - at_right * (right - left) / (at_right - at_left);
        let middle = if turn % 8 == 7 { 0.5 * (left + right) } else { secant.clamp(left.min(right), left.max(right)) };
        let there = f(middle);
        if (there > 0.0) == (at_right > 0.0) {
            at_left *= 0.5;
        } else {
            (left, at_left) = (right, at_right);
        }
        (right, at_right) = (middle, there);
    }
    right
}

/// Where a function with one maximum between the ends is largest (golden section).
pub(super) fn maximum(mut left: f64, mut right: f64, f: impl Fn(f64) -> f64) -> (f64, f64) {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let (mut a, mut b) = (right - GOLDEN * (right - left), left + GOLDEN * (right - left));
    let (mut at_a, mut at_b) = (f(a), f(b));
    for _ in 0..40 {
        if at_a > at_b {
            (right, b, at_b) = (b, a, at_a);
            a = right - GOLDEN * (right - left);
            at_a = f(a);
        } else {
            (left, a, at_a) = (a, b, at_b);
            b = left + GOLDEN * (right - left);
            at_b = f(b);
        }
    }
    [(left, f(left)), (right, f(right)), (a, at_a), (b, at_b)].into_iter().max_by(|p, q| p.1.total_cmp(&q.1)).unwrap_or((a, at_a))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_roots_and_maxima() {
        assert!((root(0.0, 2.0, |x| x * x - 2.0) - std::f64::consts::SQRT_2).abs() < 1e-13);
        assert!((root(0.0, 1.0, |x| x * x * x * 1e6 - 1.0) - 0.01).abs() < 1e-12);
        assert_eq!(root(0.25, 1.0, |x| x + 1.0), 0.25);
        let (at, value) = maximum(0.0, 1.0, |x| x * (1.0 - x));
        assert!((at - 0.5).abs() < 1e-7 && (value - 0.25).abs() < 1e-14);
        assert_eq!(maximum(0.0, 1.0, |x| x).1, 1.0);
    }

    #[test]
    fn analytic_a_slow_root_is_looked_for_within_its_bracket() {
        // So flat at its root that secants hardly move: the bisections come into play.
        for (left, right) in [(30.0, 100.0), (100.0, 30.0), (39.0, 1e3)] {
            let within = |x: f64| assert!((f64::min(left, right)..=f64::max(left, right)).contains(&x), "{x}");
            let found = root(left, right, |x| {
                within(x);
                (x - 40.0_f64).powi(9)
            });
            assert!((found - 40.0).abs() < 0.5, "{found}");
        }
    }
}
