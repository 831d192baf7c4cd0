//! How the flexible material relaxes: a power law in time as a row of Maxwell branches, one a decade.
//!
//! E(t) = E₀ (t₀ / t)^α has the spectrum H(τ) = E₀ (t₀ / τ)^α / Γ(α) (J. D. Ferry, *Viscoelastic Properties of Polymers*,
//! ch. 4); a branch a decade stands for it between the time step and the impact's length, what is slower acts as a spring.
//!
//! *When it is wrong:* large strains, where printed TPU loses far more (Mullins effect), and temperatures away from the
//! source's.

/// Times of the branches, ms.
const TIMES_MS: [f64; 5] = [0.01, 0.1, 1.0, 10.0, 100.0];

/// Time at which branches and law agree exactly, ms: that of an impact.
const MEET_MS: f64 = 4.0;

/// Relaxation time of the loss on top, ms: that of 100 Hz.
const LOSS_MS: f64 = 1.6;

/// A branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Branch {
    /// Its stiffness over that at rest.
    pub share: f64,
    /// Its relaxation time, ms.
    pub time_ms: f64,
}

/// A spring and its branches, over the stiffness at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Relaxation {
    /// What does not relax within an impact.
    pub lasting: f64,
    /// What does.
    pub branches: Vec<Branch>,
}

impl Relaxation {
    /// The law with an exponent, whose modulus at `rest_s` is that at rest, times a factor, and a loss on top: one branch at the
    /// frequency of an impact, of so much loss there over the stiffness at rest. What it adds to the stiffness there it has from
    /// nowhere else.
    pub fn new(exponent: f64, rest_s: f64, factor: f64, loss: f64) -> Self {
        let mut law = Self::power_law(exponent, rest_s);
        law.lasting *= factor;
        law.branches.iter_mut().for_each(|branch| branch.share *= factor);
        if loss > 0.0 {
            law.branches.push(Branch { share: 2.0 * loss, time_ms: LOSS_MS });
        }
        law
    }

    /// The law alone.
    pub fn power_law(exponent: f64, rest_s: f64) -> Self {
        if exponent <= 0.0 {
            return Self { lasting: 1.0, branches: Vec::new() };
        }
        let law = |t_ms: f64| libm::pow(rest_s * 1e3 / t_ms, exponent);
        let unit = std::f64::consts::LN_10 / libm::tgamma(exponent);
        let branches: Vec<Branch> = TIMES_MS.iter().map(|time_ms| Branch { share: unit * law(*time_ms), time_ms: *time_ms }).collect();
        let relaxing: f64 = branches.iter().map(|b| b.share * libm::exp(-MEET_MS / b.time_ms)).sum();
        Self { lasting: law(MEET_MS) - relaxing, branches }
    }

    /// Modulus at a time over that at rest.
    pub fn modulus(&self, t_ms: f64) -> f64 {
        self.lasting + self.branches.iter().map(|b| b.share * libm::exp(-t_ms / b.time_ms)).sum::<f64>()
    }

    /// For a step: what of a branch's stretch is left, and what of the step's own stretch it takes.
    pub fn step(branch: &Branch, step_ms: f64) -> [f64; 2] {
        let x = step_ms / branch.time_ms;
        [libm::exp(-x), -libm::expm1(-x) / x]
    }

    /// Factor on the elastic force at the end of a step.
    pub fn scale(&self, step_ms: f64) -> f64 {
        self.lasting + self.branches.iter().map(|b| b.share * Self::step(b, step_ms)[1]).sum::<f64>()
    }

    /// Loss factor tan δ at a frequency, kHz.
    pub fn loss_factor(&self, khz: f64) -> f64 {
        let w = std::f64::consts::TAU * khz;
        let (mut stored, mut lost) = (self.lasting, 0.0);
        for b in &self.branches {
            let x = w * b.time_ms;
            stored += b.share * x * x / (1.0 + x * x);
            lost += b.share * x / (1.0 + x * x);
        }
        lost / stored
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_branches_follow_the_power_law_over_an_impact() {
        for exponent in [0.03, 0.0555, 0.13] {
            let relaxation = Relaxation::power_law(exponent, 30.0);
            assert!(relaxation.lasting > 0.0);
            for t_ms in [0.05, 0.3, 1.0, 4.0, 15.0, 30.0] {
                let law = libm::pow(30e3 / t_ms, exponent);
                let found = relaxation.modulus(t_ms);
                assert!((found / law - 1.0).abs() < 0.015, "{exponent} {t_ms}: {found} {law}");
            }
            // A power law's loss factor is tan(α π / 2) at every frequency.
            let law = libm::tan(exponent * std::f64::consts::FRAC_PI_2);
            assert!((relaxation.loss_factor(0.1) / law - 1.0).abs() < 0.15, "{exponent}: {}", relaxation.loss_factor(0.1));
        }
        assert_eq!(Relaxation::power_law(0.0, 30.0).scale(0.1), 1.0);
        // ω τ = 1: the branch stores as much as it loses.
        let lossy = Relaxation::new(0.0, 30.0, 1.0, 0.2);
        assert!((lossy.loss_factor(1.0 / (std::f64::consts::TAU * LOSS_MS)) - 0.2 / 1.2).abs() < 1e-12);
        // A factor leaves the law's loss as it is.
        let soft = Relaxation::new(0.0555, 30.0, 0.5, 0.0);
        assert!((soft.modulus(4.0) / Relaxation::power_law(0.0555, 30.0).modulus(4.0) - 0.5).abs() < 1e-12);
        assert!((soft.loss_factor(0.1) - Relaxation::power_law(0.0555, 30.0).loss_factor(0.1)).abs() < 1e-12);
    }
}
