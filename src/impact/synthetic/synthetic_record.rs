//! A synthetic drop, and a table of them.

/// One synthetic drop.
#[derive(Clone, Debug, PartialEq)]
pub struct SyntheticRecord {
    /// Its name.
    pub trial: String,
    /// Stated height, m.
    pub height_m: f64,
    /// Sample times from the record's begin, s.
    pub t_s: Vec<f64>,
    /// Readings along the axis, g.
    pub accel_g: Vec<f64>,
    /// Readings along the other two axes, g, where the plan has them.
    pub lateral_g: Option<[Vec<f64>; 2]>,
    /// Whether the clock stalled in the impact.
    pub stalled: bool,
}

/// Drops as a table that `measure` and `diagnose` read.
pub fn table(records: &[SyntheticRecord]) -> String {
    let lateral = records.iter().any(|record| record.lateral_g.is_some());
    let mut table = format!("trial,height_m,t_s,accel_g{}\n", if lateral { ",x,y,z" } else { "" });
    for record in records {
        for (at, (t_s, accel_g)) in record.t_s.iter().zip(&record.accel_g).enumerate() {
            table += &format!("{},{},{t_s:.6},{accel_g:.5}", record.trial, record.height_m);
            if let Some([x, y]) = &record.lateral_g {
                table += &format!(",{:.5},{:.5},{accel_g:.5}", x[at], y[at]);
            }
            table.push('\n');
        }
    }
    table
}
