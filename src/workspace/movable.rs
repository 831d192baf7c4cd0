//! A number of a frame that can be moved until a rule holds.

use crate::params::{Frame, parameters, target};

/// First step, as a share of the value, and of the way between the bounds where that is more.
const FIRST_STEP: [f64; 2] = [0.02, 0.01];
/// A step is twice the one before it, so many times.
const DOUBLINGS: i32 = 6;
/// Steps without effect after which a direction is given up.
const PATIENCE: usize = 5;
/// How often the last step is halved.
const HALVINGS: usize = 5;

/// A number of a frame, with its bounds.
#[derive(Clone, Debug)]
pub(super) struct Movable {
    pub(super) key: String,
    pub(super) value: f64,
    pub(super) min: f64,
    pub(super) max: f64,
}

/// What is changed in place of a key: of a rod's length that follows from a target size that size.
pub(super) fn stated_instead(frame: &Frame, key: &str) -> Vec<String> {
    if target::gives(frame, key) { target::KEYS.map(|target| target.key.into()).into() } else { vec![key.into()] }
}

impl Movable {
    /// The number of a key; none of a name.
    pub(super) fn of(frame: &Frame, key: &str) -> Option<Self> {
        if let (Some(target), Some(size)) = (target::key(key), frame.target) {
            return Some(Self { key: key.into(), value: target.of(&size), min: target.min, max: target.max });
        }
        let (table, name) = key.split_once('.')?;
        let parameter = parameters().find(|parameter| parameter.table == table && parameter.key == name)?;
        Some(Self { key: key.into(), value: frame.value(table, name)?, min: parameter.min, max: parameter.max })
    }

    /// The nearest value in one direction whose margin is none below 0, rounded away from the value now, whose margin is given.
    pub(super) fn nearest(&self, margin: &dyn Fn(f64) -> Option<f64>, margin_now: f64, way: f64) -> Option<f64> {
        let Self { value, min, max, .. } = *self;
        let first = (FIRST_STEP[0] * value.abs()).max(FIRST_STEP[1] * (max - min));
        let (mut last, mut idle) = (value, 0);
        for doubling in 0..=DOUBLINGS {
            let to = (value + way * first * libm::exp2(f64::from(doubling))).clamp(min, max);
            if to == last {
                return None;
            }
            let Some(now) = margin(to) else { return self.least(margin, between(margin, [last, to])?) };
            if now >= 0.0 {
                return self.least(margin, [last, to]);
            }
            idle = if now > margin_now + 1e-9 { 0 } else { idle + 1 };
            if idle >= PATIENCE {
                return None;
            }
            last = to;
        }
        None
    }

    /// The value nearest to the first, which does not clear a violation, that clears it as the second does.
    fn least(&self, margin: &dyn Fn(f64) -> Option<f64>, [mut bad, mut good]: [f64; 2]) -> Option<f64> {
        let clears = |to: f64| margin(to).is_some_and(|margin| margin >= 0.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (bad + good);
            if clears(middle) {
                good = middle;
            } else {
                bad = middle;
            }
        }
        let grid = if self.max - self.min > 20.0 { 10.0 } else { 100.0 };
        let away = if good > bad { (good * grid).ceil() } else { (good * grid).floor() } / grid;
        [away, good].into_iter().map(|to| to.clamp(self.min, self.max)).find(|to| clears(*to))
    }
}

/// Between a value that does not clear a violation and one with which there is no frame: the last value that does not, and the first that
/// was seen to clear it.
fn between(margin: &dyn Fn(f64) -> Option<f64>, [mut bad, mut none]: [f64; 2]) -> Option<[f64; 2]> {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (bad + none);
        match margin(middle) {
            Some(margin) if margin >= 0.0 => return Some([bad, middle]),
            Some(_) => bad = middle,
            None => none = middle,
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_between_what_does_not_clear_and_what_is_no_frame() {
        let margin = |to: f64| (to < 7.0).then_some(to - 6.0);
        let [bad, good] = between(&margin, [4.0, 8.0]).expect("is found");
        assert!(bad < 6.0 && (6.0..7.0).contains(&good), "{bad} {good}");
        assert_eq!(between(&|to: f64| (to < 5.0).then_some(to - 6.0), [4.0, 8.0]), None);
    }
}
