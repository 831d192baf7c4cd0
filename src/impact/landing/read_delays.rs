//! Times from the first foot to the opposite one of a table's landings, as they would be read.

use nalgebra::DVector;

use super::table::LandingTable;
use super::touch_errors::TouchErrors;
use super::touches::LAST_S;

/// Times in ascending order, each with the table's point whose landing it is of; those before [`LAST_S`].
#[derive(Clone, Debug)]
pub struct ReadDelays {
    times: Vec<(f64, usize)>,
}

impl ReadDelays {
    /// Of each landing, by how times are read where that is known, and as they are otherwise.
    pub fn of(table: &LandingTable, errors: Option<&TouchErrors>) -> Self {
        let mut times = Vec::new();
        for (point, delays_s) in table.delays_s.iter().enumerate() {
            match errors {
                Some(errors) => times.extend(errors.read_s(point, delays_s[0]).map(|time_s| (time_s, point))),
                None => times.push((delays_s[0], point)),
            }
        }
        times.retain(|(time_s, _)| *time_s < LAST_S);
        times.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self { times }
    }

    /// Quantiles, s, of ascending shares, the points being as frequent as weighed.
    pub fn quantiles_s<const N: usize>(&self, weights: &DVector<f64>, shares: [f64; N]) -> [f64; N] {
        let all: f64 = self.times.iter().map(|(_, point)| weights[*point]).sum();
        let mut found = [self.times.last().map_or(0.0, |(time_s, _)| *time_s); N];
        let (mut next, mut before, mut last) = (0, 0.0, (0.0, 0.0));
        for (time_s, point) in &self.times {
            // Half of a time's weight lies before it.
            let middle = (before + 0.5 * weights[*point]) / all;
            while next < N && middle >= shares[next] {
                let (left, left_s) = last;
                let within = middle > left;
                found[next] = if within { left_s + (time_s - left_s) * (shares[next] - left) / (middle - left) } else { *time_s };
                next += 1;
            }
            if next == N {
                break;
            }
            before += weights[*point];
            last = (middle, *time_s);
        }
        found
    }
}
