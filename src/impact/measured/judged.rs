//! Records judged: the impact in each, what is wrong with it, and the zero of its session.

use std::collections::BTreeMap;

use super::clock_check::stalls;
use super::clock_period::ClockPeriod;
use super::clock_trace::ClockTrace;
use super::flag::{Flag, flags};
use super::impact::Impact;
use super::record::{DropGroup, DropSet, Record};
use super::session::Session;

/// A record with what was found in it.
#[derive(Clone, Debug)]
pub struct Drop<'a> {
    /// The record.
    pub record: &'a Record,
    /// Its impact.
    pub impact: Option<Impact>,
    /// What is wrong with it.
    pub flags: Vec<Flag>,
    /// Zeros of its session: readings of x, y and z in free fall without drag of the air, g. 0 where they are not known.
    pub zero_g: [f64; 3],
}

impl<'a> Drop<'a> {
    /// Its impact, if nothing is wrong with it.
    pub fn clean(&self) -> Option<&Impact> {
        self.impact.as_ref().filter(|_| self.flags.is_empty())
    }

    /// Whether its clock stalled.
    pub fn stalled(&self) -> bool {
        self.flags.iter().any(|flag| matches!(flag, Flag::ClockStall { .. }))
    }

    /// Readings along the axis less the session's zero, g.
    pub fn axial_g(&self) -> Vec<f64> {
        less(&self.record.accel_g, self.zero_g[2])
    }

    /// Magnitude of the readings less the session's zeros, g: of all axes, or of the one there is.
    pub fn sizes_g(&self) -> Vec<f64> {
        let Some(axes) = &self.record.axes_g else { return self.axial_g().into_iter().map(f64::abs).collect() };
        let square = |axis: usize, sample: usize| (axes[axis][sample] - self.zero_g[axis]).powi(2);
        (0..self.record.len()).map(|sample| (0..3).map(|axis| square(axis, sample)).sum::<f64>().sqrt()).collect()
    }

    /// Readings of x, y and along the axis in g less the session's zeros, and their times from the trigger on, s; `None` where they were
    /// not all measured, or nothing hit.
    pub fn aligned_axes(&self) -> Option<(Vec<f64>, [Vec<f64>; 3])> {
        let ([x, y, _], impact) = (self.record.axes_g.as_ref()?, self.impact.as_ref()?);
        let start_s = self.record.t_s[impact.trigger];
        let zeroed = [less(x, self.zero_g[0]), less(y, self.zero_g[1]), self.axial_g()];
        Some((self.record.t_s.iter().map(|t_s| t_s - start_s).collect(), zeroed))
    }
}

/// Every record judged.
#[derive(Clone, Debug)]
pub struct JudgedDrops<'a> {
    /// Group by group.
    pub groups: Vec<(&'a DropGroup, Vec<Drop<'a>>)>,
    /// What the records of one session share, in the order of their names.
    pub sessions: Vec<Session>,
    /// Where the clock stalls period by period, of each frame in which that shows.
    pub periods: Vec<(Option<String>, ClockPeriod)>,
}

impl<'a> JudgedDrops<'a> {
    /// Judges all records together: a clock is judged against the other records of the frame and the height.
    pub fn of(set: &'a DropSet) -> Self {
        let impacts: Vec<Vec<Option<Impact>>> = set.groups.iter().map(|group| group.records.iter().map(Impact::of).collect()).collect();
        let each = || set.groups.iter().zip(&impacts).flat_map(|(group, impacts)| group.records.iter().zip(impacts));
        let sessions = Session::all(each());
        let zeros: BTreeMap<&str, [f64; 3]> = sessions.iter().map(|session| (session.name.as_str(), session.zero_g())).collect();
        let periods: Vec<(Option<String>, ClockPeriod)> = set.frames().into_iter().filter_map(|frame| period(set, frame)).collect();
        let judged = |(group, impacts): (&'a DropGroup, &Vec<Option<Impact>>)| {
            let period = periods.iter().find(|(frame, _)| *frame == group.frame).map(|(_, period)| period);
            let traces: Vec<Option<ClockTrace>> = group
                .records
                .iter()
                .zip(impacts)
                .map(|(record, impact)| impact.as_ref().map(|impact| ClockTrace::of(record, impact)))
                .collect();
            let signs = stalls(group.height_m, &traces, period);
            let drops = group.records.iter().zip(impacts).zip(signs).map(|((record, impact), signs)| Drop {
                record,
                impact: impact.clone(),
                flags: flags(record, impact.as_ref(), signs),
                zero_g: zeros.get(Session::name_of(record).as_str()).copied().unwrap_or_default(),
            });
            (group, drops.collect())
        };
        let groups = set.groups.iter().zip(&impacts).map(judged).collect();
        Self { groups, sessions, periods }
    }
}

fn less(readings: &[f64], zero_g: f64) -> Vec<f64> {
    readings.iter().map(|reading| reading - zero_g).collect()
}

/// The period of a frame's records: one logger, one memory.
fn period(set: &DropSet, frame: Option<&str>) -> Option<(Option<String>, ClockPeriod)> {
    let records: Vec<&Record> =
        set.groups.iter().filter(|group| group.frame.as_deref() == frame).flat_map(|group| &group.records).collect();
    Some((frame.map(String::from), ClockPeriod::of(&records)?))
}
