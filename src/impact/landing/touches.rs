//! When each foot touches.

/// The opposite foot's touch is looked for in so long a time behind the trigger, s.
pub(super) const LAST_S: f64 = 15e-3;
/// The least spike of a touch that is believed, g. The real frame's have 62 to 91 g in the median; a frame whose feet push less aside shows none.
pub const SEEN_G: f64 = 20.0;
/// A spike that is surely that of a touch, g.
const SURE_G: f64 = 100.0;

/// One foot's touch.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Touch {
    /// Behind that of the first foot, s.
    pub delay_s: f64,
    /// Height of its spike, g.
    pub size_g: f64,
}

/// The touches of a drop.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct LegTouches {
    /// Which foot was first, at the positive and negative end of the first diagonal, then of the second.
    pub first: usize,
    /// Of the first spike, g.
    pub first_size_g: f64,
    /// Direction of the first spike from the sensor's x, rad.
    pub direction_rad: f64,
    /// The foot opposite to the first.
    pub opposite: Touch,
    /// The two beside it, the earlier one first.
    pub beside: [Touch; 2],
}

impl LegTouches {
    /// Touches that are read as they are, of feet that are surely seen.
    pub fn exact([opposite_s, beside_s, far_s]: [f64; 3]) -> Self {
        let touch = |delay_s: f64| Touch { delay_s, size_g: SURE_G };
        let [opposite, beside, far] = [opposite_s, beside_s, far_s].map(touch);
        Self { first: 0, first_size_g: SURE_G, direction_rad: std::f64::consts::FRAC_PI_4, opposite, beside: [beside, far] }
    }

    /// The same touches, each later by so much, the opposite foot first; none before the first foot's.
    #[must_use]
    pub fn later_by(mut self, [opposite_s, beside_s, far_s]: [f64; 3]) -> Self {
        let [beside, far] = &mut self.beside;
        for (touch, later_s) in [&mut self.opposite, beside, far].into_iter().zip([opposite_s, beside_s, far_s]) {
            touch.delay_s = (touch.delay_s + later_s).max(0.0);
        }
        self
    }

    /// The least of the four spikes, g.
    pub fn least_size_g(&self) -> f64 {
        self.beside.iter().map(|touch| touch.size_g).fold(self.first_size_g.min(self.opposite.size_g), f64::min)
    }

    /// Whether the first touch was seen.
    pub fn first_seen(&self) -> bool {
        self.first_size_g >= SEEN_G
    }

    /// Whether the touch of each foot was seen.
    pub fn all_seen(&self) -> bool {
        self.least_size_g() >= SEEN_G
    }

    /// Delays of the opposite foot and of those beside, s.
    pub fn delays_s(&self) -> [f64; 3] {
        [self.opposite.delay_s, self.beside[0].delay_s, self.beside[1].delay_s]
    }
}
