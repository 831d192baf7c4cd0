//! Readings in free fall that are not 0: gravity was taken off, or the sensor's zero is elsewhere.

use std::collections::BTreeMap;
use std::fmt;

use super::free_fall::lasting_s;
use super::record::{DropSet, Record};
use super::session::Session;
use super::spread::Spread;

/// Least offset that is told, g. Below it a session's zero is reported, and taken off what is compared.
const LEAST_G: f64 = 0.3;
/// An offset so near to -1 g is gravity that was taken off, g.
const GRAVITY_G: f64 = 0.1;
/// Sessions whose readings differ by less have one zero, g.
const SAME_G: f64 = 0.1;
/// Share of a fall, at its end, in which a hand has let go.
const END_OF_FALL: f64 = 0.5;
/// Before the largest reading the ground may touch already, s.
const TOUCH_S: f64 = 0.025;
/// Fewest samples of a fall.
const FALLING: usize = 20;
/// Samples at the begin of a record that starts shortly before the ground is touched.
const AT_BEGIN: usize = 4;
/// By how much the reading rises from there when the ground is touched, at least, g.
const TOUCHED_G: f64 = 5.0;
/// Half of the readings in a fall lie within this, g.
const QUIET_G: f64 = 0.5;

/// The reading of a session in free fall, where it is not near 0.
///
/// The fall is taken from the height and the largest reading, not from the level of the readings: that is what an offset moves.
/// *When it is wrong:* for a record whose largest reading is not of the first hit, and for a frame that spins fast.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeFallOffset {
    /// Its name.
    pub session: String,
    /// Records with a fall.
    pub records: usize,
    /// Median readings of x and y where they were measured, and along the axis, g.
    pub readings_g: [Option<f64>; 3],
    /// Whether other sessions read something else: what takes this offset off gives those one.
    pub alone: bool,
}

impl FreeFallOffset {
    /// Of every session whose offset is the same in most records, by name.
    pub fn all(set: &DropSet) -> Vec<Self> {
        let mut sessions: BTreeMap<String, Vec<&Record>> = BTreeMap::new();
        for record in set.records() {
            sessions.entry(Session::name_of(record)).or_default().push(record);
        }
        let count = sessions.len();
        let mut all: Vec<Self> = sessions.into_iter().filter_map(|(session, records)| Self::of(session, &records)).collect();
        let is_alone = all.len() < count || !all.windows(2).all(|pair| pair[0].is_like(&pair[1]));
        all.iter_mut().for_each(|offset| offset.alone = is_alone);
        all
    }

    /// Whether another session reads the same.
    fn is_like(&self, other: &Self) -> bool {
        let alike = |(a, b): (&Option<f64>, &Option<f64>)| a.zip(*b).is_none_or(|(a, b)| (a - b).abs() < SAME_G);
        self.readings_g.iter().zip(&other.readings_g).all(alike)
    }

    /// Whether gravity was taken off the readings along the axis. A record of such readings has a force law of its own: the ground's force less
    /// the weight, from before the touch on.
    pub fn is_gravity(&self) -> bool {
        self.readings_g[2].is_some_and(|reading_g| (reading_g + 1.0).abs() <= GRAVITY_G)
    }

    fn of(session: String, records: &[&Record]) -> Option<Self> {
        let spread = |axis: usize| {
            let axis_of = |record: &Record| match (&record.axes_g, axis) {
                (_, 2) => Some(in_fall_g(record, &record.accel_g).or_else(|| at_begin_g(record))),
                (Some(axes), _) => Some(in_fall_g(record, &axes[axis])),
                (None, _) => None,
            };
            Spread::of(records.iter().filter_map(|record| axis_of(record)?))
        };
        let spreads = [0, 1, 2].map(spread);
        let found = spreads[2]?.count;
        let is_offset = |spread: &Spread| spread.q1 > LEAST_G || spread.q3 < -LEAST_G;
        let told = 2 * found > records.len() && spreads.iter().flatten().any(is_offset);
        told.then(|| Self { session, records: found, readings_g: spreads.map(|spread| spread.map(|spread| spread.median)), alone: false })
    }
}

/// Mean reading of an axis at the end of the fall, g; `None` where the record has too little of it, or it is not quiet.
fn in_fall_g(record: &Record, readings_g: &[f64]) -> Option<f64> {
    let peak = (0..record.len()).max_by(|a, b| record.size_g(*a).total_cmp(&record.size_g(*b)))?;
    let fall_s = lasting_s(record.height_m);
    let at = |before_s: f64| record.t_s.partition_point(|t_s| *t_s < record.t_s[peak] - before_s);
    let falling = at(END_OF_FALL * fall_s)..at(TOUCH_S);
    let readings = readings_g.get(falling).filter(|readings| readings.len() >= FALLING)?;
    let spread = Spread::of(readings.iter().copied())?;
    // Of readings in steps of a converter the median is one of these.
    (spread.q3 - spread.q1 < QUIET_G).then(|| readings.iter().sum::<f64>() / readings.len() as f64)
}

/// Median reading along the axis at the begin of a record that starts shortly before the ground is touched, g. The ground may touch already, but
/// it only pushes: no more than a reading below zero is one of free fall.
fn at_begin_g(record: &Record) -> Option<f64> {
    let readings_g = &record.accel_g;
    let peak = (0..record.len()).max_by(|a, b| readings_g[*a].total_cmp(&readings_g[*b]))?;
    let is_short = record.t_s[peak] - record.t_s[0] < TOUCH_S + FALLING as f64 * record.step_s()?;
    let spread = Spread::of(readings_g.get(..AT_BEGIN).filter(|_| is_short && peak >= AT_BEGIN)?.iter().copied())?;
    let rises = readings_g[peak] > spread.median + TOUCHED_G;
    (rises && spread.median < 0.0 && spread.q3 - spread.q1 < QUIET_G).then_some(spread.median)
}

impl fmt::Display for FreeFallOffset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { session, records, readings_g: [x, y, along], alone } = self;
        // Two places, and no -0.00.
        let [x, y, along] = [*x, *y, *along].map(|reading| reading.map(|reading| (100.0 * reading).round() / 100.0 + 0.0));
        let along = along.unwrap_or_default();
        write!(f, "{session}: the reading in free fall is {along:.2} g")?;
        if let (Some(x), Some(y)) = (x, y) {
            write!(f, " along the axis, {x:.2} and {y:.2} g in x and y")?;
        }
        let why = if self.is_gravity() { "gravity was taken off" } else { "the sensor's zero is off" };
        write!(f, " (median of {records} drops), not 0: {why}. Give --zero=")?;
        if let (Some(x), Some(y)) = (x, y) {
            write!(f, "{x:.2},{y:.2},")?;
        }
        write!(f, "{along:.2} for a table, --offset-counts for files of the logger")?;
        if *alone { write!(f, ", with the drops of this session alone: the others have another zero") } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{FileFormat, read_bytes};
    use super::*;

    /// Four drops from half a metre, held for 0.1 s before; readings are moved by an offset, x, y and along the axis, g.
    fn all(offset_g: [f64; 3]) -> Vec<FreeFallOffset> {
        all_from(0, offset_g)
    }

    /// The same, recorded from a moment on, ms; the ground touches at 419.
    fn all_from(begin_ms: i32, offset_g: [f64; 3]) -> Vec<FreeFallOffset> {
        let mut text = "trial,height_m,t_s,accel_g,x,y\n".to_string();
        let [x, y, along] = offset_g;
        for trial in 0..4 {
            for ms in begin_ms..500 {
                let since = f64::from(ms - 419) / 12.0;
                let impact_g = if (0.0..1.0).contains(&since) { 53.0 * libm::sin(since * std::f64::consts::PI) } else { 0.0 };
                let held_g = f64::from(u8::from(!(100..431).contains(&ms)));
                let noise_g = 0.2 * (f64::from(ms * 7 % 10) - 4.5) / 4.5;
                text += &format!("{trial},0.5,{},{},{x},{}\n", f64::from(ms) * 1e-3, along + impact_g + held_g + noise_g, y + noise_g);
            }
        }
        let set = read_bytes(&[("a.csv".into(), text.into_bytes())], &FileFormat::default()).expect("reads");
        FreeFallOffset::all(&set)
    }

    #[test]
    fn planted_offsets_are_measured_where_no_fall_is_found() {
        assert_eq!(all([0.0; 3]), []);
        assert_eq!(all([0.2, -0.2, 0.2]), []);
        let found = all([0.4, -0.3, 2.0]);
        let [found] = &found[..] else { panic!("one session: {found:?}") };
        assert_eq!((found.session.as_str(), found.records), ("0.5 m", 4));
        for (reading, truth) in found.readings_g.iter().zip([0.4, -0.3, 2.0]) {
            assert!((reading.expect("was measured") - truth).abs() < 0.03, "{found:?}");
        }
        let said = all([0.0, 0.0, -1.0]).first().expect("is told").to_string();
        assert!(said.contains("gravity was taken off") && said.contains("--zero=0.0"), "{said}");
    }

    #[test]
    fn planted_gravity_that_was_taken_off_of_records_that_begin_with_the_touch() {
        for begin_ms in [385, 405, 414] {
            let said = all_from(begin_ms, [0.0, 0.0, -1.0]).first().map(ToString::to_string).unwrap_or_default();
            assert!(said.contains("gravity was taken off"), "{begin_ms}: {said}");
            assert_eq!(all_from(begin_ms, [0.0; 3]), [], "{begin_ms}");
        }
        // A record that begins when the ground touches says nothing.
        assert_eq!(all_from(422, [0.0, 0.0, -1.0]), []);
    }
}
