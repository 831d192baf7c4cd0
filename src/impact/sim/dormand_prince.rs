//! One step of the method of Dormand and Prince, order 5 with an error estimate, and its continuous extension of order 4.
//!
//! J. R. Dormand, P. J. Prince, *A family of embedded Runge-Kutta formulae*, J. Comput. Appl. Math. 6 (1980); continuous
//! extension and coefficients as in E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, II.6.

const A1: [f64; 1] = [1.0 / 5.0];
const A2: [f64; 2] = [3.0 / 40.0, 9.0 / 40.0];
const A3: [f64; 3] = [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0];
const A4: [f64; 4] = [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0];
const A5: [f64; 5] = [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0];
/// Of the first and of the third to the sixth stage; the second has none.
const A6: [f64; 5] = [35.0 / 384.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0];

/// Difference of the two formulae.
const E: [f64; 7] = [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339_200.0, 22.0 / 525.0, -1.0 / 40.0];

/// Of the continuous extension.
const D: [f64; 7] = [
    -12_715_105_075.0 / 11_282_082_432.0,
    0.0,
    87_487_479_700.0 / 32_700_410_799.0,
    -10_690_763_975.0 / 1_880_347_072.0,
    701_980_252_875.0 / 199_316_789_632.0,
    -1_453_857_185.0 / 822_651_844.0,
    69_997_945.0 / 29_380_423.0,
];

/// Weighted sum of rates; weights of zero cost nothing.
#[inline(always)]
fn weighted<const N: usize>(weights: &[f64], rates: &[[f64; N]; 7]) -> [f64; N] {
    let mut sum = [0.0; N];
    for (weight, rate) in weights.iter().zip(rates) {
        if *weight != 0.0 {
            for i in 0..N {
                sum[i] += weight * rate[i];
            }
        }
    }
    sum
}

/// A state a step further on, by the weighted sum of rates.
#[inline(always)]
fn moved<const N: usize, const STAGES: usize>(from: &[f64; N], h_s: f64, weights: &[f64; STAGES], rates: [&[f64; N]; STAGES]) -> [f64; N] {
    let mut to = *from;
    for i in 0..N {
        let mut slope = 0.0;
        for stage in 0..STAGES {
            slope += weights[stage] * rates[stage][i];
        }
        to[i] += h_s * slope;
    }
    to
}

/// What moves: states have rates. No closure, as a closure that is not inlined has narrow registers.
pub(super) trait Moving<const N: usize> {
    /// The rates of a state.
    fn rates(&self, y: &[f64; N]) -> [f64; N];
}

/// A step taken.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step<const N: usize> {
    /// Its length, s.
    pub h_s: f64,
    /// State at its begin.
    pub from: [f64; N],
    /// State at its end.
    pub to: [f64; N],
    /// Rates at its stages; the last are those at its end.
    rates: [[f64; N]; 7],
}

impl<const N: usize> Step<N> {
    /// Takes a step from a state with its rates.
    #[inline(always)]
    pub fn take(from: &[f64; N], rates_there: &[f64; N], h_s: f64, moving: &impl Moving<N>) -> Self {
        // One after the other, so that a compiler keeps rates in registers: a loop over the stages takes 1.1 to 1.3 times as long.
        let k1 = *rates_there;
        let k2 = moving.rates(&moved(from, h_s, &A1, [&k1]));
        let k3 = moving.rates(&moved(from, h_s, &A2, [&k1, &k2]));
        let k4 = moving.rates(&moved(from, h_s, &A3, [&k1, &k2, &k3]));
        let k5 = moving.rates(&moved(from, h_s, &A4, [&k1, &k2, &k3, &k4]));
        let k6 = moving.rates(&moved(from, h_s, &A5, [&k1, &k2, &k3, &k4, &k5]));
        let to = moved(from, h_s, &A6, [&k1, &k3, &k4, &k5, &k6]);
        Self { h_s, from: *from, to, rates: [k1, k2, k3, k4, k5, k6, moving.rates(&to)] }
    }

    /// Estimated error of each state.
    #[inline(always)]
    pub fn error(&self) -> [f64; N] {
        let mut error = weighted(&E, &self.rates);
        for slope in &mut error {
            *slope *= self.h_s;
        }
        error
    }

    /// Rates at its end.
    #[inline(always)]
    pub fn rates_at_end(&self) -> &[f64; N] {
        &self.rates[6]
    }

    /// The step as a function of time.
    #[inline(always)]
    pub fn dense(&self, start_s: f64) -> Dense<N> {
        let curve = weighted(&D, &self.rates);
        let mut c = [[0.0; N]; 5];
        for i in 0..N {
            let difference = self.to[i] - self.from[i];
            let bend = self.h_s * self.rates[0][i] - difference;
            c[0][i] = self.from[i];
            c[1][i] = difference;
            c[2][i] = bend;
            c[3][i] = difference - self.h_s * self.rates[6][i] - bend;
            c[4][i] = self.h_s * curve[i];
        }
        Dense { start_s, h_s: self.h_s, c }
    }
}

/// A step as a function of θ from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dense<const N: usize> {
    /// Time at θ = 0, s.
    pub start_s: f64,
    /// Length, s.
    pub h_s: f64,
    c: [[f64; N]; 5],
}

impl<const N: usize> Dense<N> {
    /// One state.
    #[inline(always)]
    pub fn one(&self, i: usize, theta: f64) -> f64 {
        let rest = 1.0 - theta;
        let c = &self.c;
        c[0][i] + theta * (c[1][i] + rest * (c[2][i] + theta * (c[3][i] + rest * c[4][i])))
    }

    /// All states.
    #[inline(always)]
    pub fn at(&self, theta: f64) -> [f64; N] {
        let mut y = [0.0; N];
        for (i, state) in y.iter_mut().enumerate() {
            *state = self.one(i, theta);
        }
        y
    }

    /// Time, s.
    #[inline(always)]
    pub fn time_s(&self, theta: f64) -> f64 {
        self.start_s + theta * self.h_s
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// y'' = -y from (0, 1): after time t (sin t, cos t).
    struct Swinging;

    impl Moving<2> for Swinging {
        fn rates(&self, y: &[f64; 2]) -> [f64; 2] {
            [y[1], -y[0]]
        }
    }

    fn taken(y: &[f64; 2], h_s: f64) -> Step<2> {
        Step::take(y, &Swinging.rates(y), h_s, &Swinging)
    }

    fn error_with(steps: usize) -> f64 {
        let h = 2.0 / steps as f64;
        let mut y = [0.0, 1.0];
        for _ in 0..steps {
            y = taken(&y, h).to;
        }
        libm::hypot(y[0] - libm::sin(2.0), y[1] - libm::cos(2.0))
    }

    #[test]
    fn analytic_the_step_has_order_five() {
        for steps in [10, 20, 40] {
            let order = libm::log2(error_with(steps) / error_with(2 * steps));
            assert!((order - 5.0).abs() < 0.3, "{order} with {steps} steps");
        }
    }

    #[test]
    fn analytic_between_the_ends_the_order_is_four() {
        let worst = |h: f64| {
            let step = taken(&[0.0, 1.0], h);
            let dense = step.dense(0.0);
            (1..10).map(|i| (dense.one(0, 0.1 * f64::from(i)) - libm::sin(0.1 * f64::from(i) * h)).abs()).fold(0.0, f64::max)
        };
        // The error within one step is of order h^5 for a method of order four.
        let order = libm::log2(worst(0.4) / worst(0.2));
        assert!(order > 4.7, "{order}");
    }

    #[test]
    fn analytic_the_estimate_is_of_the_order_of_the_error() {
        let step = taken(&[0.0, 1.0], 0.3);
        let estimate = step.error()[0].abs();
        let true_error = (step.to[0] - libm::sin(0.3)).abs();
        assert!(estimate > true_error && estimate < 1e3 * true_error, "{estimate} {true_error}");
    }
}
