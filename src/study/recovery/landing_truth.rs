//! Drops with lateral axes: landings that slope at random, and level ones that could be taken for them.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use crate::impact::effects::{Channel, Model, Sensor, by_id};
use crate::impact::landing::COULOMB_FRICTION;
use crate::impact::synthetic::{HeavyFeet, Landings, Plan, Stalls};

/// Drops a height.
const DROPS: usize = 40;
/// Legs of all four feet together at rest, N/m and N s/m, before they are varied by seed.
const LEGS: [f64; 2] = [20_000.0, 45.0];
/// Least and greatest moment of inertia about a horizontal axis, kg m².
const INERTIA_KG_M2: [f64; 2] = [6e-4, 1e-3];
/// From the vertical axis to each foot, m: that of CogniFly.
const FOOT_RADIUS_M: f64 = 0.1445;
/// Mean height of the spike of a touch, and of sideways ringing, g.
const TOUCH_G: f64 = 70.0;
const RINGING_G: f64 = 60.0;
/// Cutoff of the sensor of the real drops, Hz.
const CUTOFF_HZ: f64 = 500.0;
/// The real logger's clock.
const STALLS: Stalls = Stalls { lost_s: 0.060, sector: 409.6, catch_up: 2.7, record_s: 2.0 };
/// A payload on a spring of its own: its share of the mass, its frequency in Hz, and its damping ratio.
const PAYLOAD_MODE: [f64; 3] = [0.3, 110.0, 0.05];

/// Dry friction of all four legs together, N: about that of the real drops.
const FRICTION_N: f64 = 50.0;

/// Coefficient of friction of the feet on the ground, of which the model of landings knows nothing: that of plastic on wood, about.
const GROUND_FRICTION: f64 = 0.4;

/// Feet with mass of their own, about as those of the real drops.
const HEAVY_FEET: HeavyFeet = HeavyFeet { share: 0.15, f_hz: 250.0, zeta: 0.06 };

/// What the landings of a row are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LandingTruth {
    /// They turn while they fall: standard deviation of the rate about each horizontal axis, rad/s.
    Sloped(f64),
    /// The same, and the legs have dry friction.
    SlopedWithFriction(f64),
    /// The same on feet with mass of their own.
    SlopedOnHeavyFeet(f64),
    /// On legs with dry friction whose feet have friction on the ground, too, which no effect stands for.
    SlopedOnRoughGround(f64),
    /// Level, with a spike where the feet touch.
    Level,
    /// Level, and the frame rings sideways.
    Ringing,
    /// Level, with a payload on a spring of its own.
    PayloadMode,
    /// Level, by a logger whose clock stalls.
    Stalls,
}

impl LandingTruth {
    /// Landings that must not be named.
    pub const LEVEL: [Self; 4] = [Self::Level, Self::Ringing, Self::PayloadMode, Self::Stalls];

    /// Its name in the table.
    pub fn name(self) -> String {
        match self {
            Self::Sloped(rate_rad_s) => format!("landing_tilt {rate_rad_s} rad/s"),
            Self::SlopedWithFriction(rate_rad_s) => format!("landing_tilt {rate_rad_s} rad/s, coulomb_friction"),
            Self::SlopedOnHeavyFeet(rate_rad_s) => format!("landing_tilt {rate_rad_s} rad/s, coulomb_friction, foot_mode"),
            Self::SlopedOnRoughGround(rate_rad_s) => format!("landing_tilt {rate_rad_s} rad/s, coulomb_friction, rough ground"),
            Self::Level => "level".into(),
            Self::Ringing => "level, ringing".into(),
            Self::PayloadMode => "level, payload_mode".into(),
            Self::Stalls => "level, stalls".into(),
        }
    }

    /// Whether they are what `landing_tilt` means.
    pub fn is_sloped(self) -> bool {
        self.rate_rad_s() > 0.0
    }

    /// Whether legs have dry friction beside it.
    pub fn rubs(self) -> bool {
        matches!(self, Self::SlopedWithFriction(_)) || self.has_heavy_feet() || self.has_rough_ground()
    }

    /// Whether feet have mass of their own beside it.
    pub fn has_heavy_feet(self) -> bool {
        matches!(self, Self::SlopedOnHeavyFeet(_))
    }

    /// Whether feet have friction on the ground beside it.
    pub fn has_rough_ground(self) -> bool {
        matches!(self, Self::SlopedOnRoughGround(_))
    }

    /// Coefficient of friction of the feet on the ground.
    pub fn ground_friction(self) -> f64 {
        if self.has_rough_ground() { GROUND_FRICTION } else { 0.0 }
    }

    /// Dry friction of all legs together, N.
    pub fn friction_n(self) -> f64 {
        if self.rubs() { FRICTION_N } else { 0.0 }
    }

    fn rate_rad_s(self) -> f64 {
        match self {
            Self::Sloped(rate_rad_s)
            | Self::SlopedWithFriction(rate_rad_s)
            | Self::SlopedOnHeavyFeet(rate_rad_s)
            | Self::SlopedOnRoughGround(rate_rad_s) => rate_rad_s,
            Self::Level | Self::Ringing | Self::PayloadMode | Self::Stalls => 0.0,
        }
    }

    /// Its drops. Legs and inertia differ from seed to seed.
    pub(super) fn plan(self, plain: Plan, seed: u64) -> Plan {
        let mut rng = Pcg64::seed_from_u64(seed ^ 0x7117);
        let mut around_one = || rng.random_range(0.8..1.25);
        let [k, c] = LEGS.map(|value| value * around_one());
        let inertia_kg_m2 = rng.random_range(INERTIA_KG_M2[0]..INERTIA_KG_M2[1]);
        let sensor = Sensor { cutoff_hz: CUTOFF_HZ, channel: Channel::Axial, ..plain.model.sensor };
        let feet_lift = by_id("unilateral_contact").expect("is in the catalogue");
        let mut model = Model::base(plain.model.body.clone(), sensor, k, c).with(feet_lift, &[0.0], 0);
        if self == Self::PayloadMode {
            model = model.with(by_id("payload_mode").expect("is in the catalogue"), &PAYLOAD_MODE, 0);
        }
        if self.rubs() {
            model = model.with(by_id(COULOMB_FRICTION).expect("is in the catalogue"), &[self.friction_n()], 0);
        }
        let ringing = self == Self::Ringing;
        let landings = Landings {
            rate_rad_s: self.rate_rad_s(),
            at_release_rad: 0.0,
            inertia_kg_m2,
            foot_radius_m: FOOT_RADIUS_M,
            touch_g: if ringing { 0.0 } else { TOUCH_G },
            sensor_lean_rad: [0.0; 2],
            ringing_g: if ringing { RINGING_G } else { 0.0 },
            heavy_feet: self.has_heavy_feet().then_some(HEAVY_FEET),
            ground_friction: self.ground_friction(),
        };
        let stalls = (self == Self::Stalls).then_some(STALLS);
        Plan { model, drops: DROPS, landings: Some(landings), stalls, seed, ..plain }
    }

    /// The model that is diagnosed: the truth's, whose spring and damper are starting values, without what is hidden.
    pub(super) fn diagnosed(plan: &Plan) -> Model {
        let mut model = plan.model.clone();
        model.effects.retain(|listed| !["payload_mode", COULOMB_FRICTION].contains(&listed.spec.id));
        model
    }
}
